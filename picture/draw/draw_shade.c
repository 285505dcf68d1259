/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a frame's planes to pixels. Surfaces are matt (Lambert); light adds up linearly and is encoded at the end. */
#include <math.h>
#include <string.h>

#include "draw/draw_store.h"
#include "vector_range.h"

enum { RUN = DRAW_BLOCK / 4 }; /* pixels, of up to four rays along the row; short, so that many runs hit nothing */

/* ---- Light -------------------------------------------------------------------------------------------------- */

/* Rays of a row side by side, for loops that a compiler vectorises: those without a hit go along. */
typedef struct ray_row {
    const drawing *drawing;
    size_t first; /* in planes */
    uint32_t count;
    const float *normal[3]; /* that light sees */
    float dir[3][DRAW_BLOCK], turned[3][DRAW_BLOCK], light[3][DRAW_BLOCK], share[DRAW_BLOCK];
    draw_means means;
} ray_row;

/* draw_ray's directions. */
static void aim(ray_row *r, uint32_t x, uint32_t y)
{
    const drawing *const d = r->drawing;
    const float down = 1.0f - 2.0f * ((float)y + 0.5f) / (float)d->ray_height;
    const int perspective = d->camera.projection == CGT_PROJECTION_PERSPECTIVE;
    for (int c = 0; c < 3; c++) {
        const float right = d->right[c], up = down * d->up[c], forward = d->forward[c], width = (float)d->ray_width;
        for (uint32_t i = 0; i < r->count; i++) {
            const float across = 2.0f * ((float)(int32_t)(x + i) + 0.5f) / width - 1.0f;
            r->dir[c][i] = perspective ? forward + (across * right + up) : forward;
        }
    }
}

/* Normals of triangles are turned to the eye, and interpolated. */
static void find_normals(ray_row *r)
{
    const drawing *const d = r->drawing;
    for (int c = 0; c < 3; c++)
        r->normal[c] = d->normal[c] + r->first;
    if (!d->has_triangles)
        return;
    for (uint32_t i = 0; i < r->count; i++) {
        const size_t k = r->first + i;
        const picture_look *const look = draw_look(d, d->geometry[k]);
        const float dir[3] = {r->dir[0][i], r->dir[1][i], r->dir[2][i]};
        float n[3] = {d->normal[0][k], d->normal[1][k], d->normal[2][k]};
        if (d->primitive[k] != CGT_INVALID_ID && look->is_triangles)
            cgt_look_turn_normal(look, d->primitive[k], d->u, d->v, k, dir, n);
        for (int c = 0; c < 3; c++)
            r->turned[c][i] = n[c];
    }
    for (int c = 0; c < 3; c++)
        r->normal[c] = r->turned[c];
}

/* Light of the sky and from the eye; that reaches into corners less, too, or they would look lit from inside. */
static void add_sky_light(ray_row *r, const float *sky)
{
    const drawing *const d = r->drawing;
    const float *const nx = r->normal[0], *const ny = r->normal[1], *const nz = r->normal[2];
    const float of_sky = d->options->lighting.sky, of_head = d->options->lighting.head;
    for (uint32_t i = 0; i < r->count; i++) {
        const float dx = r->dir[0][i], dy = r->dir[1][i], dz = r->dir[2][i], seen = sky ? sky[i] : 1.0f;
        const float facing = fabsf(nx[i] * dx + ny[i] * dy + nz[i] * dz) / sqrtf(dx * dx + dy * dy + dz * dz);
        const float light = of_sky * seen + of_head * facing * (0.4f + 0.6f * seen);
        r->light[0][i] = r->light[1][i] = r->light[2][i] = light;
    }
}

/* Lambert's law for light from one side, or from a place. */
static void find_lambert(ray_row *r, const float direction[3])
{
    const float *const nx = r->normal[0], *const ny = r->normal[1], *const nz = r->normal[2];
    const float x = direction[0], y = direction[1], z = direction[2];
    for (uint32_t i = 0; i < r->count; i++) {
        const float cosine = nx[i] * x + ny[i] * y + nz[i] * z;
        r->share[i] = cosine > 0.0f ? cosine : 0.0f;
    }
}

static void find_lambert_of_point(ray_row *r, const float light[3], uint32_t x, uint32_t y)
{
    const drawing *const d = r->drawing;
    const float *const t = d->t + r->first;
    for (uint32_t i = 0; i < r->count; i++) {
        float org[3], dir[3], towards[3], cosine = 0.0f;
        draw_ray(d, x + i, y, org, dir);
        for (int c = 0; c < 3; c++)
            towards[c] = light[c] - (org[c] + t[i] * dir[c]);
        picture_bring_near(towards);
        for (int c = 0; c < 3; c++)
            cosine += r->normal[c][i] * towards[c];
        const float square = picture_square(towards);
        cosine = square > 0.0f ? cosine / sqrtf(square) : 0.0f;
        r->share[i] = cosine > 0.0f ? cosine : 0.0f;
    }
}

/* Adds what arrives of a light: `mean`: of its rays, NULL: it is hard. */
static void add_light(ray_row *r, uint32_t index, const float *mean)
{
    const drawing *const d = r->drawing;
    const uint8_t *const occluded = mean || !d->occluded[index] ? NULL : d->occluded[index] + r->first;
    const float *const color = d->options->lighting.lights[index].color;
    for (uint32_t i = 0; mean && i < r->count; i++)
        r->share[i] = mean[i] * r->share[i];
    for (uint32_t i = 0; occluded && i < r->count; i++)
        r->share[i] = occluded[i] ? 0.0f : r->share[i];
    for (int c = 0; c < 3; c++)
        for (uint32_t i = 0; i < r->count; i++)
            r->light[c][i] += r->share[i] * color[c];
}

/* All light that hits send to the eye where their surface is white. */
static void find_light(ray_row *r, uint32_t x, uint32_t y)
{
    const drawing *const d = r->drawing;
    const cgt_picture_lighting *const of = &d->options->lighting;
    uint32_t m = 0;
    cgt_draw_smooth(d, x, y, r->count, &r->means);
    aim(r, x, y);
    find_normals(r);
    add_sky_light(r, d->sky ? r->means.mean[m++] : NULL);
    for (uint32_t i = 0; i < of->light_count; i++) {
        const cgt_light *const light = &of->lights[i].light;
        if (light->kind == CGT_LIGHT_DIRECTIONAL)
            find_lambert(r, light->position);
        else
            find_lambert_of_point(r, light->position, x, y);
        add_light(r, i, d->reach[i] ? r->means.mean[m++] : NULL);
    }
}

/* ---- Colour ------------------------------------------------------------------------------------------------- */

/* The linear colour of ray i, which has a hit. */
static void color_hit(const ray_row *r, uint32_t i, uint32_t x, uint32_t y, float out[3])
{
    const drawing *const d = r->drawing;
    const cgt_picture_style *const s = &d->options->style;
    const size_t k = r->first + i;
    float mixed[3];
    const float *const color = look_color(draw_look(d, d->geometry[k]), d->primitive[k], d->u, d->v, k, mixed);
    const float line = s->outline > 0.0f ? cgt_draw_outline_at(d, x + i, y) : 0.0f;
    float far_share = s->cue > 0.0f ? (d->t[k] - s->cue_range[0]) / (s->cue_range[1] - s->cue_range[0]) : 0.0f;
    far_share = s->cue * (far_share > 0.0f ? far_share < 1.0f ? far_share : 1.0f : 0.0f);
    for (int c = 0; c < 3; c++) {
        const float lit = color[c] * r->light[c][i];
        const float drawn = lit + line * (s->outline_color[c] - lit);
        out[c] = drawn + far_share * (s->background[c] - drawn);
    }
}

void cgt_draw_shade_rays(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_ray_light *light)
{
    ray_row r;
    r.drawing = d;
    r.first = (size_t)y * d->ray_width + x;
    r.count = count;
    for (uint32_t i = 0; i < count; i++)
        light[i] = (draw_ray_light){.depth = INFINITY, .id = CGT_INVALID_ID};
    if (draw_is_background(d->primitive + r.first, 0, count, 1))
        return;
    find_light(&r, x, y);
    for (uint32_t i = 0; i < count; i++) {
        const size_t k = r.first + i;
        if (d->primitive[k] == CGT_INVALID_ID)
            continue;
        const uint32_t *const ids = draw_look(d, d->geometry[k])->of.ids;
        color_hit(&r, i, x, y, light[i].color);
        light[i].cover = 1.0f;
        light[i].depth = d->t[k];
        light[i].id = ids ? ids[d->primitive[k]] : d->primitive[k];
    }
}

/* ---- A row -------------------------------------------------------------------------------------------------- */

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

/* Adds whole pixels among those of a row, each as all of its rays. */
static void add_whole(const drawing *d, uint32_t px, uint32_t py, uint32_t pixels, pixel_sum *sum)
{
    const drawing *const w = d->whole;
    const uint32_t n = d->options->antialias, rays = n * n, *const primitive = w->primitive + (size_t)py * w->ray_width;
    draw_ray_light light[RUN];
    cgt_draw_shade_rays(w, px, py, pixels, light);
    for (uint32_t i = 0; i < pixels; i++) {
        if (primitive[px + i] == CGT_INVALID_ID)
            continue;
        for (int c = 0; c < 3; c++)
            sum[i].hits[c] = (float)rays * light[i].color[c];
        sum[i].count = rays;
        sum[i].cover = (float)rays;
        sum[i].id = light[i].id;
        const float *const t = d->t + (size_t)py * n * d->ray_width + (size_t)(px + i) * n;
        for (uint32_t k = 0; k < rays && d->image.linear; k++)
            sum[i].depth = fminf(sum[i].depth, t[k / n * d->ray_width + k % n]);
    }
}

/* Adds the rays of `pixels` pixels of a row, from px on, ray row by ray row. */
static void add_rays(const drawing *d, uint32_t px, uint32_t py, uint32_t pixels, pixel_sum *sum)
{
    const uint32_t n = d->options->antialias;
    draw_ray_light light[DRAW_BLOCK];
    for (uint32_t y = py * n; y < (py + 1) * n; y++) {
        cgt_draw_shade_rays(d, px * n, y, pixels * n, light);
        if (d->layers)
            cgt_draw_mix_layers(d, px * n, y, pixels * n, light);
        for (uint32_t i = 0; i < pixels * n; i++)
            if (light[i].cover > 0.0f)
                add_ray(&light[i], &sum[i / n]);
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

/* Pixels of one ray each: there is nothing to add up. */
static void take_rays(const drawing *d, uint32_t x, uint32_t y, uint32_t pixels, pixel_sum *sum)
{
    draw_ray_light light[RUN];
    cgt_draw_shade_rays(d, x, y, pixels, light);
    for (uint32_t i = 0; i < pixels; i++) {
        const draw_ray_light *const l = &light[i];
        sum[i] = (pixel_sum){.hits = {l->color[0], l->color[1], l->color[2]},
                             .count = l->cover > 0.0f,
                             .cover = l->cover,
                             .depth = l->depth,
                             .id = l->id};
    }
}

/* The rays of pixels of a row, which do not all miss. */
static void add_up(const drawing *d, uint32_t x, uint32_t y, uint32_t pixels, pixel_sum *sum)
{
    for (uint32_t i = 0; i < pixels; i++)
        sum[i] = (pixel_sum){.depth = INFINITY, .id = CGT_INVALID_ID};
    if (d->whole) {
        add_whole(d, x, y, pixels, sum);
        add_rest(d, x, y, pixels, sum);
    } else
        add_rays(d, x, y, pixels, sum);
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
        if (!d->whole && !d->layers && d->options->antialias == 1)
            take_rays(d, x, y, pixels, sums);
        else
            add_up(d, x, y, pixels, sums);
        for (uint32_t i = 0; i < pixels; i++) {
            add_background(d, &sums[i]);
            draw_store(d, &sums[i], x + i, y);
            hits += sums[i].count;
        }
    }
    return hits;
}
