/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shades tiles while their hits are in cache: a visitor for cgt_trace_camera. Surfaces are matt (Lambert) under a
 * directional light, with a headlight at the eye that brightens the shadowed side; triangles are lit on the side that
 * the eye sees. A tile is processed in runs of up to RUN hits of one row: first the brightness of each, in plain loops
 * that a compiler vectorises, then colour and sRGB codes through tables. */
#include <math.h>
#include <string.h>

#include "draw/draw_store.h"

enum { RUN = 16 }; /* hits; a multiple of the samples. Short, so that many runs contain background only */

/* Shares of the light. The side of a sphere that faces light and eye reaches 1: no colour is clipped. */
static const float share_light = 0.85f, share_head = 0.35f, share_ambient = 0.05f;

uint32_t cgt_draw_tile_fields(const drawing *d)
{
    uint32_t fields = (uint32_t)CGT_FIELD_PRIMITIVE | (uint32_t)CGT_FIELD_GEOMETRY | (uint32_t)CGT_FIELD_NORMAL;
    fields |= d->image.linear ? (uint32_t)CGT_FIELD_T : 0u;
    for (uint32_t i = 0; i < d->last_look; i++)
        fields |= d->looks[i].of.vertex_normals || d->looks[i].of.per_vertex || d->looks[i].of.halves
                      ? (uint32_t)CGT_FIELD_UV
                      : 0u;
    return fields;
}

/* The look of a tile's hit; tiles from elsewhere may be of geometry 0 alone. */
static inline const picture_look *look_at(const drawing *d, const cgt_tile *tile, size_t k)
{
    return draw_look(d, tile->geometry ? tile->geometry[k] : 0);
}

/* Ray directions of a run: of the first ray, and the step from each to the next. */
typedef struct run_rays {
    float first[3], step[3];
} run_rays;

/* The rays of row y of the frame, from x on. The headlight of an orthographic camera shines along the view
 * everywhere. */
static run_rays rays_from(const drawing *d, uint32_t x, uint32_t y)
{
    run_rays rays;
    const float half = d->camera.projection == CGT_PROJECTION_PERSPECTIVE ? 1.0f : 0.0f;
    const float step = half * 2.0f / (float)d->ray_width;
    const float v = half * (1.0f - 2.0f * ((float)y + 0.5f) / (float)d->ray_height);
    const float u = half * (((float)x + 0.5f) * step - 1.0f);
    for (int c = 0; c < 3; c++) {
        rays.first[c] = d->forward[c] + v * d->up[c] + u * d->right[c];
        rays.step[c] = d->right[c] * step;
    }
    return rays;
}

/* Shading normals of a run of triangles, from element `offset` of the tile on, all turned to the eye's side. */
static void triangle_normals(const drawing *d, const cgt_tile *tile, size_t offset, uint32_t count,
                             const run_rays *rays, float out[3][RUN])
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t primitive = tile->primitive[offset + i];
        float n[3] = {0.0f, 0.0f, 0.0f}, dir[3];
        if (primitive != CGT_INVALID_ID) {
            const picture_look *const look = look_at(d, tile, offset + i);
            for (int c = 0; c < 3; c++) {
                n[c] = tile->normal[c][offset + i];
                dir[c] = rays->first[c] + (float)i * rays->step[c];
            }
            if (look->is_triangles)
                cgt_look_turn_normal(look, primitive, tile->u, tile->v, offset + i, dir, n);
        }
        for (int c = 0; c < 3; c++)
            out[c][i] = n[c];
    }
}

/* Brightness of `count` hits; n are their normals, zero where nothing was hit. */
static void brightness(const drawing *d, const run_rays *rays, uint32_t count, const float *const n[3], float out[RUN])
{
    const float *const light = d->options->lighting.lights[0].light.position;
    const float *const base = rays->first;
    const float rx = rays->step[0], ry = rays->step[1], rz = rays->step[2];
    const float lx = light[0], ly = light[1], lz = light[2];
    const float *const nx = n[0], *const ny = n[1], *const nz = n[2];
    for (uint32_t i = 0; i < count; i++) {
        const float k = (float)(int32_t)i;
        const float dx = base[0] + k * rx, dy = base[1] + k * ry, dz = base[2] + k * rz;
        const float lambert = nx[i] * lx + ny[i] * ly + nz[i] * lz;
        /* Inside a sphere the normal points away from the eye; the headlight is the same on both sides. */
        const float head = fabsf(nx[i] * dx + ny[i] * dy + nz[i] * dz) / sqrtf(dx * dx + dy * dy + dz * dz);
        out[i] = share_ambient + share_head * head + share_light * (lambert > 0.0f ? lambert : 0.0f);
    }
}

/* Adds the light of hits from element `offset` on to their pixels, n to each, which have three floats; row: of n, the
 * first of which begins. Returns the number of hits. */
static inline uint32_t gather(const drawing *d, const cgt_tile *tile, size_t offset, uint32_t pixels, uint32_t n,
                              uint32_t row, const float *bright, float light[3 * RUN])
{
    const uint32_t *primitive = tile->primitive + offset;
    uint32_t hits = 0, geometry = 0;
    const picture_look *look = draw_look(d, geometry); /* neighbours are mostly of one geometry */
    float mixed[3];
    for (uint32_t p = 0, i = 0; p < pixels; p++) {
        float sum[3] = {0.0f, 0.0f, 0.0f};
        for (int c = 0; c < 3 && row; c++)
            sum[c] = light[3 * p + (uint32_t)c];
        for (const uint32_t end = i + n; i < end; i++) {
            const float *color = d->options->style.background;
            float factor = 1.0f;
            if (primitive[i] != CGT_INVALID_ID) {
                const size_t k = offset + i;
                if (tile->geometry && tile->geometry[k] != geometry) {
                    geometry = tile->geometry[k];
                    look = draw_look(d, geometry);
                }
                color = look_color(look, primitive[i], tile->u, tile->v, k, mixed);
                factor = bright[i];
                hits++;
            }
            for (int c = 0; c < 3; c++)
                sum[c] += color[c] * factor;
        }
        for (int c = 0; c < 3; c++)
            light[3 * p + (uint32_t)c] = sum[c];
    }
    return hits;
}

/* The bytes of a run of pixels from their light: draw_store's, by loops that a compiler vectorises. */
static void store_bytes(const drawing *d, const float light[3 * RUN], uint32_t x, uint32_t y, uint32_t pixels)
{
    const uint8_t *const encode = d->srgb->code;
    const float share = d->share;
    const size_t channels = d->image.channels;
    uint8_t *to = draw_bytes(d, x, y);
    int step[3 * RUN];
    for (uint32_t i = 0; i < 3 * pixels; i++)
        step[i] = srgb_step(light[i] * share);
    for (uint32_t k = 0; k < pixels; k++, to += channels) {
        for (uint32_t c = 0; c < 3; c++)
            to[c] = encode[step[3 * k + c]];
        if (channels == 4)
            to[3] = 255;
    }
}

/* Depth and primitive of a pixel: those of its closest hit. offset: element of the block's first hit. */
static void set_closest(const drawing *d, const cgt_tile *tile, size_t offset, cgt_linear_pixel *to)
{
    const uint32_t n = d->options->antialias;
    for (uint32_t row = 0; row < n; row++)
        for (uint32_t i = 0; i < n; i++) {
            const size_t k = offset + row * tile->row_stride + i;
            const uint32_t primitive = tile->primitive[k];
            if (primitive == CGT_INVALID_ID || tile->t[k] >= to->depth)
                continue;
            const uint32_t *const ids = look_at(d, tile, k)->of.ids;
            to->depth = tile->t[k];
            to->id = ids ? ids[primitive] : primitive;
        }
}

/* Asks for the colours of hits, which lie anywhere in memory, before their brightness is computed. */
static inline void prefetch_colors(const drawing *d, const cgt_tile *tile, size_t offset, uint32_t count)
{
    for (size_t k = offset; k < offset + count; k++) {
        if (tile->primitive[k] == CGT_INVALID_ID)
            continue;
        const cgt_look *const l = &look_at(d, tile, k)->of;
        if (l->index && !l->per_vertex)
            __builtin_prefetch(l->index + tile->primitive[k]);
        else if (l->colors && !l->per_vertex)
            __builtin_prefetch(l->colors + 3 * (size_t)tile->primitive[k]);
    }
}

/* One run of a row of pixels: `count` hits wide and `samples` hits high, from element (i, j) of the tile. */
static uint32_t shade_run(const drawing *d, const cgt_tile *tile, uint32_t i, uint32_t j, uint32_t count)
{
    float bright[RUN], light[3 * RUN], shading[3][RUN];
    uint32_t hits = 0;
    const uint32_t n = d->options->antialias;
    const uint32_t px = (tile->x + i) / n, py = (tile->y + j) / n;
    if (draw_is_background(tile->primitive + j * tile->row_stride + i, tile->row_stride, count, n)) {
        draw_fill_background(d, px, py, count / n);
        return 0;
    }
    for (uint32_t row = 0; row < n; row++) {
        const size_t offset = (j + row) * tile->row_stride + i;
        const run_rays rays = rays_from(d, tile->x + i, tile->y + j + row);
        const float *const sphere[3] = {tile->normal[0] + offset, tile->normal[1] + offset, tile->normal[2] + offset};
        const float *const triangle[3] = {shading[0], shading[1], shading[2]};
        prefetch_colors(d, tile, offset, count);
        if (d->has_triangles)
            triangle_normals(d, tile, offset, count, &rays, shading);
        brightness(d, &rays, count, d->has_triangles ? triangle : sphere, bright);
        /* a copy without antialiasing, whose inner loops are gone */
        hits += n == 1 ? gather(d, tile, offset, count, 1, 0, bright, light)
                       : gather(d, tile, offset, count / n, n, row, bright, light);
    }
    if (d->image.bytes)
        store_bytes(d, light, px, py, count / n);
    if (d->image.alpha)
        memset(d->image.alpha + (size_t)py * d->options->width + px, 255, count / n);
    for (uint32_t k = 0; k < count / n && d->image.linear; k++) {
        cgt_linear_pixel *const to = &d->image.linear[(size_t)py * d->options->width + px + k];
        const float *const sum = light + 3 * (size_t)k;
        *to =
            (cgt_linear_pixel){sum[0] * d->share, sum[1] * d->share, sum[2] * d->share, INFINITY, CGT_INVALID_ID, 1.0f};
        set_closest(d, tile, j * tile->row_stride + i + k * n, to);
    }
    return hits;
}

cgt_visit cgt_draw_tile(void *user, const cgt_tile *tile)
{
    drawing *d = user;
    const uint32_t n = d->options->antialias;
    uint64_t hits = 0;
    /* Tiles of 64 pixels or 4 scanlines hold whole blocks; others cannot be shaded. */
    if (tile->x % n || tile->y % n || tile->width % n || tile->height % n || draw_is_stopped(d))
        return CGT_VISIT_STOP;
    for (uint32_t j = 0; j < tile->height; j += n)
        for (uint32_t i = 0; i < tile->width; i += RUN) {
            const uint32_t remaining = tile->width - i;
            hits += shade_run(d, tile, i, j, remaining < RUN ? remaining : RUN);
        }
    atomic_fetch_add_explicit(&d->hits, hits, memory_order_relaxed);
    return CGT_VISIT_CONTINUE;
}
