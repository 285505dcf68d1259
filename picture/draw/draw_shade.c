/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a frame's planes to pixels. Surfaces are matt (Lambert); light adds up linearly and is encoded at the end. */
#include <math.h>
#include <string.h>

#include "draw/draw_store.h"

enum { RUN = DRAW_BLOCK / 4 }; /* pixels, of up to four rays along the row; short, so that many runs hit nothing */

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* ---- A hit -------------------------------------------------------------------------------------------------- */

/* Light from the lamp `l` on a hit: 0 to 1 by Lambert's law. */
static float lambert(const cgt_picture_light *l, const float n[3], const float position[3])
{
    float towards[3];
    if (l->light.kind == CGT_LIGHT_DIRECTIONAL)
        return fmaxf(0.0f, dot(n, l->light.position));
    for (int c = 0; c < 3; c++)
        towards[c] = l->light.position[c] - position[c];
    const float length = sqrtf(dot(towards, towards));
    return length > 0.0f ? fmaxf(0.0f, dot(n, towards) / length) : 0.0f;
}

/* A ray of the row that is shaded. */
typedef struct ray_place {
    uint32_t x, y;
    float org[3], dir[3];
    const draw_means *means; /* of the rays from x - i on */
    uint32_t i;
} ray_place;

/* All light that a hit sends to the eye where its surface is white. */
static void light_at(const drawing *d, const ray_place *at, const float n[3], float light[3])
{
    const cgt_picture_options *s = d->options;
    const size_t k = (size_t)at->y * d->ray_width + at->x;
    const float *const dir = at->dir;
    float place[3];
    uint32_t m = 0;
    const float sky = d->sky ? at->means->mean[m++][at->i] : 1.0f, facing = fabsf(dot(n, dir)) / sqrtf(dot(dir, dir));
    /* Light from the eye reaches into corners less, too, or they would look lit from inside. */
    light[0] = light[1] = light[2] = s->lighting.sky * sky + s->lighting.head * facing * (0.4f + 0.6f * sky);
    for (int c = 0; c < 3; c++)
        place[c] = at->org[c] + d->t[k] * dir[c];
    for (uint32_t i = 0; i < s->lighting.light_count; i++) {
        const cgt_picture_light *l = &s->lighting.lights[i];
        const float reach = d->reach[i]                           ? at->means->mean[m++][at->i]
                            : d->occluded[i] && d->occluded[i][k] ? 0.0f
                                                                  : 1.0f;
        const float share = reach * lambert(l, n, place);
        for (int c = 0; c < 3; c++)
            light[c] += share * l->color[c];
    }
}

/* The linear colour of a ray with a hit. */
static void shade_hit(const drawing *d, const ray_place *at, float out[3])
{
    const cgt_picture_options *s = d->options;
    const size_t k = (size_t)at->y * d->ray_width + at->x;
    const picture_look *look = draw_look(d, d->geometry[k]);
    float n[3], light[3], mixed[3];
    for (int c = 0; c < 3; c++)
        n[c] = d->normal[c][k];
    if (look->is_triangles)
        cgt_look_turn_normal(look, d->primitive[k], d->u, d->v, k, at->dir, n);
    light_at(d, at, n, light);
    const float *const color = look_color(look, d->primitive[k], d->u, d->v, k, mixed);
    const float line = s->style.outline > 0.0f ? cgt_draw_outline_at(d, at->x, at->y) : 0.0f;
    float far_share = s->style.cue > 0.0f
                          ? (d->t[k] - s->style.cue_range[0]) / (s->style.cue_range[1] - s->style.cue_range[0])
                          : 0.0f;
    far_share = s->style.cue * (far_share > 0.0f ? far_share < 1.0f ? far_share : 1.0f : 0.0f);
    for (int c = 0; c < 3; c++) {
        const float lit = color[c] * light[c];
        const float drawn = lit + line * (s->style.outline_color[c] - lit);
        out[c] = drawn + far_share * (s->style.background[c] - drawn);
    }
}

/* ---- A row -------------------------------------------------------------------------------------------------- */

void cgt_draw_shade_ray(const drawing *d, uint32_t x, uint32_t y, const draw_means *means, uint32_t i,
                        draw_ray_light *light)
{
    ray_place at = {.x = x + i, .y = y, .means = means, .i = i};
    const size_t k = (size_t)y * d->ray_width + at.x;
    const uint32_t *ids = draw_look(d, d->geometry[k])->of.ids;
    draw_ray(d, at.x, at.y, at.org, at.dir);
    shade_hit(d, &at, light->color);
    light->cover = 1.0f;
    light->depth = d->t[k];
    light->id = ids ? ids[d->primitive[k]] : d->primitive[k];
}

static void add_ray(const draw_ray_light *light, pixel_sum *sum)
{
    for (int c = 0; c < 3; c++)
        sum->hits[c] += light->color[c];
    sum->count++;
    sum->cover += light->cover;
    if (light->depth < sum->depth) {
        sum->depth = light->depth;
        sum->id = light->id;
    }
}

/* Adds the rays of a row that go through layers, `count` from ray x on, n to a pixel. */
static void add_layered_rays(const drawing *d, uint32_t x, uint32_t y, uint32_t count, const draw_means *means,
                             uint32_t n, pixel_sum *sum)
{
    const uint32_t *const primitive = d->primitive + (size_t)y * d->ray_width + x;
    draw_ray_light light[DRAW_BLOCK];
    for (uint32_t i = 0; i < count; i++)
        if (primitive[i] != CGT_INVALID_ID)
            cgt_draw_shade_ray(d, x, y, means, i, &light[i]);
        else
            light[i] = (draw_ray_light){.depth = INFINITY, .id = CGT_INVALID_ID};
    cgt_draw_mix_layers(d, x, y, count, light);
    for (uint32_t i = 0; i < count; i++)
        if (light[i].cover > 0.0f)
            add_ray(&light[i], &sum[i / n]);
}

/* Adds whole pixels among those of a row, each as all of its rays. */
static void add_whole(const drawing *d, uint32_t px, uint32_t py, uint32_t pixels, pixel_sum *sum)
{
    const drawing *const w = d->whole;
    const uint32_t n = d->options->antialias, rays = n * n, *const primitive = w->primitive + (size_t)py * w->ray_width;
    draw_means means;
    cgt_draw_smooth(w, px, py, pixels, &means);
    for (uint32_t i = 0; i < pixels; i++) {
        draw_ray_light light;
        if (primitive[px + i] == CGT_INVALID_ID)
            continue;
        cgt_draw_shade_ray(w, px, py, &means, i, &light);
        for (int c = 0; c < 3; c++)
            sum[i].hits[c] = (float)rays * light.color[c];
        sum[i].count = rays;
        sum[i].cover = (float)rays;
        sum[i].id = light.id;
        const float *const t = d->t + (size_t)py * n * d->ray_width + (size_t)(px + i) * n;
        for (uint32_t k = 0; k < rays && d->image.linear; k++)
            sum[i].depth = fminf(sum[i].depth, t[k / n * d->ray_width + k % n]);
    }
}

/* Adds the rays of `pixels` pixels of a row, from px on, ray row by ray row. */
static void add_rays(const drawing *d, uint32_t px, uint32_t py, uint32_t pixels, pixel_sum *sum)
{
    const uint32_t n = d->options->antialias;
    draw_means means;
    for (uint32_t y = py * n; y < (py + 1) * n; y++) {
        const uint32_t *primitive = d->primitive + (size_t)y * d->ray_width + (size_t)px * n;
        cgt_draw_smooth(d, px * n, y, pixels * n, &means);
        if (d->layers) {
            add_layered_rays(d, px * n, y, pixels * n, &means, n, sum);
            continue;
        }
        for (uint32_t i = 0; i < pixels * n; i++)
            if (primitive[i] != CGT_INVALID_ID) {
                draw_ray_light light;
                cgt_draw_shade_ray(d, px * n, y, &means, i, &light);
                add_ray(&light, &sum[i / n]);
            }
    }
}

/* Whether no ray of some pixels of a row hits anything. */
static int is_background(const drawing *d, uint32_t x, uint32_t y, uint32_t pixels)
{
    const uint32_t n = d->options->antialias;
    const size_t first = (size_t)y * n * d->ray_width + (size_t)x * n;
    int is_empty = draw_is_background(d->primitive + first, d->ray_width, pixels * n, n);
    for (uint32_t l = 0; l < d->layers && is_empty; l++)
        is_empty = draw_is_background(d->layer[l].primitive + first, d->ray_width, pixels * n, n);
    return is_empty;
}

/* The pixels of a row, from px on, that are not whole: cut where some in a row are, or background. */
static void add_rest(const drawing *d, uint32_t px, uint32_t py, uint32_t pixels, pixel_sum *sum)
{
    const uint32_t *const whole = d->whole->primitive + (size_t)py * d->whole->ray_width + px;
    for (uint32_t i = 0, end; i < pixels; i = end) {
        for (end = i; end < pixels && whole[end] == CGT_INVALID_ID && !is_background(d, px + end, py, 1);)
            end++;
        if (end > i)
            add_rays(d, px + i, py, end - i, sum + i);
        else
            end++;
    }
}

static void add_background(const drawing *d, pixel_sum *sum)
{
    const uint32_t n = d->options->antialias;
    for (int c = 0; c < 3; c++)
        sum->all[c] = sum->hits[c] + ((float)(n * n) - sum->cover) * d->options->style.background[c];
}

uint32_t cgt_draw_shade_row(const drawing *d, uint32_t y)
{
    const uint32_t width = d->options->width;
    pixel_sum sums[RUN];
    uint32_t hits = 0;
    for (uint32_t x = 0; x < width; x += RUN) {
        const uint32_t pixels = width - x < RUN ? width - x : RUN;
        if (is_background(d, x, y, pixels)) {
            draw_fill_background(d, x, y, pixels);
            continue;
        }
        for (uint32_t i = 0; i < pixels; i++)
            sums[i] = (pixel_sum){.depth = INFINITY, .id = CGT_INVALID_ID};
        if (d->whole) {
            add_whole(d, x, y, pixels, sums);
            add_rest(d, x, y, pixels, sums);
        } else
            add_rays(d, x, y, pixels, sums);
        for (uint32_t i = 0; i < pixels; i++) {
            add_background(d, &sums[i]);
            draw_store(d, &sums[i], x + i, y);
            hits += sums[i].count;
        }
    }
    return hits;
}
