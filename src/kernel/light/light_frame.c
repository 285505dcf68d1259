/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The points of a frame's tile (dispatch/frame_points.h). They are computed by rows of a square, in loops that
 * compilers vectorise, and then moved block by block: most blocks are live as a whole or not at all. */
#include "dispatch/frame_points.h"

#include <math.h>
#include <string.h>

#include "dispatch/kernel.h"
#include "query/ray_intake.h"

#define SQUARE CGT_SHADOW_SQUARE
#define BLOCK CGT_SHADOW_BLOCK
#define WHOLE_BLOCK 0xffffu

/* ---- the points of a square, row by row ---- */

/* A row of a square. */
typedef struct square_row {
    const float *t, *px; /* of each pixel: its t, and where it is across the picture */
    float py;
    uint32_t width, number;
} square_row;

/* The points of a row by the arithmetic of cgt_camera_pixel, and which of them are live. Returns how many are
 * invalid. */
static inline __attribute__((always_inline)) uint32_t
fill_row(const cgt_frame_source *s, const square_row *row, bool orthographic, bool is_point, cgt_frame_square *square)
{
    const cgt_camera_rays c = *s->camera; /* copies: bytes may alias anything */
    const cgt_light light = *s->light;
    const uint32_t on = ray_classify_range(s->t_min, ray_end(s->light)) == RAY_PLAIN, width = row->width;
    const float *restrict px = row->px, *restrict t = row->t;
    float *restrict x = square->position[0][row->number], *restrict y = square->position[1][row->number],
                    *restrict z = square->position[2][row->number];
    uint8_t *restrict lives = square->live[row->number];
    float from[3], up[3];
    uint32_t points = 0, invalid = 0;
    for (int a = 0; a < 3; a++) {
        from[a] = orthographic ? c.eye[a] : c.fwd[a];
        up[a] = row->py * c.up[a];
    }
    for (uint32_t k = 0; k < width; k++) {
        float position[3], dir[3];
        for (int a = 0; a < 3; a++) {
            const float sum = (from[a] + px[k] * c.right[a]) + up[a];
            position[a] = orthographic ? sum + t[k] * c.fwd[a] : c.eye[a] + t[k] * sum;
            dir[a] = is_point ? light.position[a] - position[a] : light.position[a];
        }
        /* a light's numbers are finite: where the direction to its place is, the point is */
        const uint32_t hit = fabsf(t[k]) != INFINITY,
                       good = ray_line_is_valid(is_point ? light.position : position, dir);
        x[k] = position[0];
        y[k] = position[1];
        z[k] = position[2];
        lives[k] = (uint8_t)(hit & good & on);
        points += hit & good & on;
        invalid += hit & (good ^ 1);
    }
    square->points += points;
    return invalid;
}

#define AHEAD 6u /* rows: from the second-level cache to the first */

/* Beyond the plane's end it does nothing. */
static inline void prefetch_row(const void *plane, size_t first)
{
    const uintptr_t from = (uintptr_t)plane + first * sizeof(uint32_t);
    __builtin_prefetch((const void *)from);
    __builtin_prefetch((const void *)(from + CGT_ALIGNMENT));
    __builtin_prefetch((const void *)(from + sizeof(uint32_t[SQUARE]) - 1));
}

/* Rows of a plane lie pages apart, and frames are larger than caches: the processor foresees none of these reads. */
static void prefetch_tile(const cgt_frame_source *s, const void *plane, uint32_t x0, uint32_t y0)
{
    const cgt_frame *f = s->frame;
    const uint32_t width = f->width - x0 < CGT_SHADOW_TILE ? f->width - x0 : CGT_SHADOW_TILE;
    for (uint32_t row = 0; row < CGT_SHADOW_TILE && y0 + row < f->height; row++) {
        const char *from = (const char *)plane + ((size_t)(y0 + row) * s->row_stride + x0) * sizeof(uint32_t);
        for (size_t k = 0; k < width * sizeof(uint32_t); k += CGT_ALIGNMENT)
            __builtin_prefetch(from + k, 0, 2);
        __builtin_prefetch(from + width * sizeof(uint32_t) - 1, 0, 2);
    }
}

/* Whether no pixel of a row was hit: then nothing else is read. */
static bool row_is_empty(const float *t, uint32_t width)
{
    uint32_t hits = 0;
    for (uint32_t k = 0; k < width; k++)
        hits += fabsf(t[k]) != INFINITY;
    return !hits;
}

static void copy_row(const uint32_t *from, uint32_t width, uint32_t to[SQUARE])
{
    if (width == SQUARE)
        memcpy(to, from, sizeof(uint32_t[SQUARE]));
    else
        memcpy(to, from, width * sizeof(uint32_t));
}

/* Returns how many points are invalid. */
static uint32_t fill_square(const cgt_frame_source *s, uint32_t x0, uint32_t y0, cgt_frame_square *square)
{
    const cgt_frame *f = s->frame;
    const cgt_camera_rays *c = s->camera;
    const bool is_point = s->light->kind == CGT_LIGHT_POINT, skips = f->primitive && f->geometry;
    float px[SQUARE];
    square_row row = {.px = px, .width = f->width - x0 < SQUARE ? f->width - x0 : SQUARE};
    uint32_t invalid = 0;
    for (uint32_t k = 0; k < SQUARE; k++)
        px[k] = ((float)(int32_t)(x0 + k) + 0.5f) * c->pixel[0] - 1;
    square->points = 0;
    memset(square->live, 0, sizeof square->live);
    for (; row.number < SQUARE && y0 + row.number < f->height; row.number++) {
        const size_t first = (size_t)(y0 + row.number) * s->row_stride + x0;
        row.t = f->t + first;
        prefetch_row(f->t, first + AHEAD * s->row_stride);
        if (skips) {
            prefetch_row(f->primitive, first + AHEAD * s->row_stride);
            prefetch_row(f->geometry, first + AHEAD * s->row_stride);
        }
        row.py = 1 - ((float)(y0 + row.number) + 0.5f) * c->pixel[1];
        if (row_is_empty(row.t, row.width))
            continue;
        if (skips) { /* whole rows: blocks would read each line of the planes four times, from as many pages as rows */
            copy_row(f->primitive + first, row.width, square->id[0][row.number]);
            copy_row(f->geometry + first, row.width, square->id[1][row.number]);
        }
        if (c->orthographic)
            invalid += is_point ? fill_row(s, &row, true, true, square) : fill_row(s, &row, true, false, square);
        else
            invalid += is_point ? fill_row(s, &row, false, true, square) : fill_row(s, &row, false, false, square);
    }
    return invalid;
}

/* ---- block by block ---- */

/* The live pixels of a block, as bits. */
static uint32_t find_live(const cgt_frame_square *square, uint32_t x, uint32_t y)
{
    static const uint8_t all[BLOCK] = {1, 1, 1, 1};
    uint32_t whole, every, any = 0, live = 0;
    memcpy(&whole, all, sizeof whole);
    every = whole;
    for (uint32_t row = 0; row < BLOCK; row++) {
        uint32_t word;
        memcpy(&word, &square->live[y + row][x], sizeof word);
        every &= word;
        any |= word;
    }
    if (!any || every == whole)
        return any ? WHOLE_BLOCK : 0;
    for (uint32_t k = 0; k < BLOCK * BLOCK; k++)
        live |= (uint32_t)square->live[y + k / BLOCK][x + k % BLOCK] << k;
    return live;
}

/* Moves the live elements of a block of a square. */
static void take_words(const void *from, uint32_t live, void *to)
{
    const char *source = from;
    char *target = to;
    if (live == WHOLE_BLOCK) {
        for (uint32_t row = 0; row < BLOCK; row++)
            memcpy(target + row * sizeof(uint32_t[BLOCK]), source + row * SQUARE * sizeof(uint32_t),
                   sizeof(uint32_t[BLOCK]));
        return;
    }
    for (; live; live &= live - 1, target += sizeof(uint32_t)) {
        const uint32_t k = (uint32_t)__builtin_ctz(live);
        memcpy(target, source + (k / BLOCK * SQUARE + k % BLOCK) * sizeof(uint32_t), sizeof(uint32_t));
    }
}

/* Bits 0, 2 and 4. */
static uint32_t even_bits(uint32_t i) { return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4); }

/* Appends the blocks of the square at (x, y) of its tile. */
static void append_square(const cgt_frame_source *s, uint32_t x, uint32_t y, cgt_frame_points *p)
{
    const cgt_frame *f = s->frame;
    const cgt_frame_square *square = &p->square;
    for (uint32_t k = 0; k < SQUARE * SQUARE / (BLOCK * BLOCK); k++) {
        const uint32_t column = even_bits(k) * BLOCK, row = even_bits(k >> 1) * BLOCK;
        const uint32_t live = find_live(square, column, row);
        if (!live)
            continue;
        for (int a = 0; a < 3; a++)
            take_words(&square->position[a][row][column], live, p->batch.position[a] + p->live);
        if (f->primitive && f->geometry) {
            take_words(&square->id[0][row][column], live, p->batch.primitive + p->live);
            take_words(&square->id[1][row][column], live, p->batch.geometry + p->live);
        }
        p->block[p->blocks++] = (cgt_frame_block){(uint16_t)((y + row) * CGT_SHADOW_TILE + x + column), (uint16_t)live};
        p->live += (uint32_t)__builtin_popcount(live);
    }
}

void CGT_KERNEL(cgt_list_frame_points)(const cgt_frame_source *s, uint32_t x0, uint32_t y0, cgt_frame_points *p)
{
    const cgt_frame *f = s->frame;
    const bool skips = f->primitive && f->geometry;
    cgt_point_batch *b = &p->batch;
    p->live = p->invalid = p->blocks = 0;
    prefetch_tile(s, f->t, x0, y0);
    if (skips) {
        prefetch_tile(s, f->primitive, x0, y0);
        prefetch_tile(s, f->geometry, x0, y0);
    }
    for (uint32_t y = 0; y < CGT_SHADOW_TILE && y0 + y < f->height; y += SQUARE)
        for (uint32_t x = 0; x < CGT_SHADOW_TILE && x0 + x < f->width; x += SQUARE) {
            p->invalid += fill_square(s, x0 + x, y0 + y, &p->square);
            if (p->square.points)
                append_square(s, x, y, p);
        }
    for (uint32_t k = 0; k < p->live && s->t_min != 0; k++)
        b->t_min[k] = s->t_min;
    for (uint32_t k = 0; k < p->live && s->has_masks; k++)
        b->mask[k] = s->camera->mask;
    b->rays = (cgt_rays){.count = p->live,
                         .org = {b->position[0], b->position[1], b->position[2]},
                         .t_min = s->t_min != 0 ? b->t_min : NULL,
                         .mask = s->has_masks ? b->mask : NULL,
                         .skip_primitive = skips ? b->primitive : NULL,
                         .skip_geometry = skips ? b->geometry : NULL};
}
