/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a frame's planes to pixels. Surfaces are matt (Lambert); light adds up linearly and is encoded at the end. What
 * was sampled with few rays is averaged over a window of 4x4 rays, among those that hit the same surface. */
#include <math.h>
#include <string.h>

#include "picture/draw/draw.h"

enum { WINDOW = 4, SMOOTHED = 1 + DRAW_MAX_LIGHTS };

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* ---- Averaging over neighbours ------------------------------------------------------------------------------ */

/* The planes to average: the sky and soft lights; hard shadows stay sharp. */
typedef struct smoothed_planes {
    const float *plane[SMOOTHED];
    uint32_t count;
} smoothed_planes;

static smoothed_planes planes_to_smooth(const drawing *d)
{
    const draw_settings *s = &d->settings;
    smoothed_planes p = {{NULL}, 0};
    if (d->sky)
        p.plane[p.count++] = d->sky;
    for (uint32_t i = 0; i < s->light_count; i++)
        if (d->reach[i])
            p.plane[p.count++] = d->reach[i];
    return p;
}

/* What the window's rays are compared with: the hit in its middle. */
typedef struct window_center {
    uint32_t geometry, primitive;
    float n[3], t;
    int triangle;
} window_center;

/* For `count` rays of a row of the window, 1 where they hit the same primitive, or a neighbour in the same plane, else 0.
 * Without branches, which would go either way at each rim. */
static inline void weigh(const drawing *d, const window_center *c, size_t first, uint32_t count, float weight[WINDOW])
{
    for (uint32_t i = 0; i < count; i++) {
        const size_t k = first + i;
        const float cosine = fabsf(c->n[0] * d->normal[0][k] + c->n[1] * d->normal[1][k] + c->n[2] * d->normal[2][k]);
        const int same = (d->geometry[k] == c->geometry) & (c->triangle | (d->primitive[k] == c->primitive));
        const int far = c->triangle & (fabsf(d->t[k] - c->t) > 0.02f * c->t);
        weight[i] = same & !(cosine < 0.8f) & !far ? 1.0f : 0.0f;
    }
}

/* Means over the window around (x, y). The centre itself counts, so that no mean is without a ray. */
static void smooth(const drawing *d, const smoothed_planes *p, uint32_t x, uint32_t y, float mean[SMOOTHED])
{
    const size_t k = (size_t)y * d->ray_width + x;
    const uint32_t x0 = x >= 2 ? x - 2 : 0, x1 = x + 2 < d->ray_width ? x + 2 : d->ray_width;
    const uint32_t y0 = y >= 2 ? y - 2 : 0, y1 = y + 2 < d->ray_height ? y + 2 : d->ray_height;
    const window_center c = {d->geometry[k],
                             d->primitive[k],
                             {d->normal[0][k], d->normal[1][k], d->normal[2][k]},
                             d->t[k],
                             d->surfaces[d->geometry[k]].triangle != NULL};
    float sum[SMOOTHED] = {0.0f}, total = 0.0f, weight[WINDOW];
    for (uint32_t j = y0; j < y1; j++) {
        const size_t first = (size_t)j * d->ray_width + x0;
        if (x1 - x0 == WINDOW)
            weigh(d, &c, first, WINDOW, weight);
        else
            weigh(d, &c, first, x1 - x0, weight);
        for (uint32_t i = 0; i < x1 - x0; i++) {
            total += weight[i];
            for (uint32_t m = 0; m < p->count; m++) /* 0 times a share of light is 0: it adds nothing */
                sum[m] += weight[i] * p->plane[m][first + i];
        }
    }
    for (uint32_t m = 0; m < p->count; m++)
        mean[m] = sum[m] / total;
}

/* ---- A hit -------------------------------------------------------------------------------------------------- */

/* The normal for shading; of a triangle on the eye's side. */
static void shading_normal(const drawing *d, const surface *s, size_t k, const float dir[3], float n[3])
{
    float mixed[3];
    for (int c = 0; c < 3; c++)
        n[c] = d->normal[c][k];
    if (!s->triangle)
        return;
    int flip = dot(n, dir) > 0.0f;
    if (s->vertex_normal && surface_mix_normal(s, d->primitive[k], d->u[k], d->v[k], mixed)) {
        flip = (dot(n, mixed) < 0.0f) != flip;
        memcpy(n, mixed, sizeof mixed);
    }
    for (int c = 0; c < 3; c++)
        n[c] = flip ? -n[c] : n[c];
}

/* Light from the lamp `l` on a hit: 0 to 1 by Lambert's law. */
static float lambert(const draw_light *l, const float n[3], const float position[3])
{
    float towards[3];
    if (l->light.kind == CGT_LIGHT_DIRECTIONAL)
        return fmaxf(0.0f, dot(n, l->light.position));
    for (int c = 0; c < 3; c++)
        towards[c] = l->light.position[c] - position[c];
    const float length = sqrtf(dot(towards, towards));
    return length > 0.0f ? fmaxf(0.0f, dot(n, towards) / length) : 0.0f;
}

/* All light that a hit sends to the eye where its surface is white. */
static void light_at(const drawing *d, const smoothed_planes *planes, uint32_t x, uint32_t y, const float n[3],
                     float light[3])
{
    const draw_settings *s = &d->settings;
    const size_t k = (size_t)y * d->ray_width + x;
    float org[3], dir[3], mean[SMOOTHED];
    uint32_t m = 0;
    draw_ray(d, x, y, org, dir);
    if (planes->count)
        smooth(d, planes, x, y, mean);
    const float sky = d->sky ? mean[m++] : 1.0f, facing = fabsf(dot(n, dir)) / sqrtf(dot(dir, dir));
    /* Light from the eye reaches into corners less, too, or they would look lit from inside. */
    light[0] = light[1] = light[2] = s->sky * sky + s->head * facing * (0.4f + 0.6f * sky);
    for (int c = 0; c < 3; c++)
        org[c] += d->t[k] * dir[c];
    for (uint32_t i = 0; i < s->light_count; i++) {
        const draw_light *l = &s->lights[i];
        const float reach = d->reach[i] ? mean[m++] : d->occluded[i] && d->occluded[i][k] ? 0.0f : 1.0f;
        const float share = reach * lambert(l, n, org);
        for (int c = 0; c < 3; c++)
            light[c] += share * l->color[c];
    }
}

/* The linear colour of a ray with a hit. */
static void shade_hit(const drawing *d, const smoothed_planes *planes, uint32_t x, uint32_t y, float out[3])
{
    const draw_settings *s = &d->settings;
    const size_t k = (size_t)y * d->ray_width + x;
    const surface *look = &d->surfaces[d->geometry[k]];
    float org[3], dir[3], n[3], light[3];
    draw_ray(d, x, y, org, dir);
    shading_normal(d, look, k, dir, n);
    light_at(d, planes, x, y, n, light);
    const uint32_t entry = look->mix && look->triangle ? surface_entry(look, d->primitive[k], d->u[k], d->v[k])
                                                       : look->index[d->primitive[k]];
    const float line = s->outline > 0.0f ? draw_outline_at(d, x, y) : 0.0f;
    float far_share = s->cue > 0.0f ? (d->t[k] - s->cue_near) / (s->cue_far - s->cue_near) : 0.0f;
    far_share = s->cue * (far_share > 0.0f ? far_share < 1.0f ? far_share : 1.0f : 0.0f);
    for (int c = 0; c < 3; c++) {
        const float lit = look->palette[entry][c] * light[c];
        const float drawn = lit + line * (s->outline_color[c] - lit);
        out[c] = drawn + far_share * (s->background[c] - drawn);
    }
}

/* ---- A row -------------------------------------------------------------------------------------------------- */

typedef struct pixel_sum {
    float hits[3]; /* light of the rays with a hit */
    uint32_t count;
    float depth;
    uint32_t id;
} pixel_sum;

static void add_rays(const drawing *d, const smoothed_planes *planes, uint32_t px, uint32_t py, pixel_sum *sum)
{
    const uint32_t n = d->settings.samples;
    *sum = (pixel_sum){.depth = INFINITY, .id = CGT_INVALID_ID};
    for (uint32_t j = 0; j < n; j++)
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t x = px * n + i, y = py * n + j;
            const size_t k = (size_t)y * d->ray_width + x;
            float color[3];
            if (d->primitive[k] == CGT_INVALID_ID)
                continue;
            shade_hit(d, planes, x, y, color);
            for (int c = 0; c < 3; c++)
                sum->hits[c] += color[c];
            sum->count++;
            if (d->t[k] < sum->depth) {
                const uint32_t *source = d->surfaces[d->geometry[k]].source;
                sum->depth = d->t[k];
                sum->id = source ? source[d->primitive[k]] : d->primitive[k];
            }
        }
}

/* Of a transparent picture: the light of the hits alone, premultiplied by their share. */
static void store_linear(const drawing *d, const pixel_sum *sum, const float color[3], image_pixel *to)
{
    const float rays = (float)(d->settings.samples * d->settings.samples);
    *to = (image_pixel){color[0], color[1], color[2], sum->depth, sum->id, 1.0f};
    if (!d->settings.transparent)
        return;
    to->r = sum->hits[0] / rays;
    to->g = sum->hits[1] / rays;
    to->b = sum->hits[2] / rays;
    to->a = (float)sum->count / rays;
}

static void store(const drawing *d, const pixel_sum *sum, size_t pixel)
{
    const draw_settings *s = &d->settings;
    const float rays = (float)(s->samples * s->samples), count = (float)sum->count;
    float color[3];
    uint8_t *rgb = d->rgb + 3 * pixel;
    for (int c = 0; c < 3; c++) {
        color[c] = (sum->hits[c] + (rays - count) * s->background[c]) / rays;
        /* Alpha is not premultiplied: the colour of a transparent pixel is that of its hits. */
        const float shown = s->transparent && sum->count ? sum->hits[c] / count : color[c];
        rgb[c] = srgb_encode(d->tables, shown);
    }
    if (d->alpha)
        d->alpha[pixel] = (uint8_t)(255.0f * count / rays + 0.5f);
    if (d->pixels)
        store_linear(d, sum, color, &d->pixels[pixel]);
}

uint32_t draw_shade_row(const drawing *d, uint32_t y)
{
    const smoothed_planes planes = planes_to_smooth(d);
    uint32_t hits = 0;
    for (uint32_t x = 0; x < d->settings.width; x++) {
        pixel_sum sum;
        add_rays(d, &planes, x, y, &sum);
        store(d, &sum, (size_t)y * d->settings.width + x);
        hits += sum.count;
    }
    return hits;
}
