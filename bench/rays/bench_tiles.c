/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera's rays, and the pixels of tiles. Lists hits with vectors and few branches: making rays must cost little
 * compared with tracing them. */
#include "rays/bench_tiles.h"

#include <math.h>
#include <string.h>

#include "common/bench_clones.h"

enum {
    BLOCK = 4,             /* pixels along a block's edge */
    GROUP = BLOCK * BLOCK, /* pixels of a block */
    SQUARE = 2 * BLOCK,    /* pixels along the edge of four successive blocks */
    SQUARE_BLOCKS = 4,
    TILE = BENCH_TILE_EDGE
};

/* ---- The camera's rays --------------------------------------------------------------------------------------- */

static float length3(const float v[3]) { return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void cross3(const float a[3], const float b[3], float c[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = a[j] * b[k] - a[k] * b[j];
    }
}

void bench_camera_axes_init(bench_camera_axes *axes, const cgt_camera *camera, uint32_t width, uint32_t height)
{
    const float half = tanf(camera->fov * 0.5f * 3.14159265f / 180.0f);
    float fwd[3], right[3], up[3];

    for (int i = 0; i < 3; i++)
        fwd[i] = camera->target[i] - camera->eye[i];
    const float distance = length3(fwd);
    for (int i = 0; i < 3; i++)
        fwd[i] /= distance;
    cross3(fwd, camera->up, right);
    const float across = length3(right);
    for (int i = 0; i < 3; i++)
        right[i] /= across;
    cross3(right, fwd, up);
    for (int i = 0; i < 3; i++) {
        axes->eye[i] = camera->eye[i];
        axes->fwd[i] = fwd[i];
        axes->right[i] = right[i] * half * (float)width / (float)height;
        axes->up[i] = up[i] * half;
    }
    axes->width = width;
    axes->height = height;
    axes->step[0] = 2.0f / (float)width;
    axes->step[1] = 2.0f / (float)height;
}

void bench_camera_direction(const bench_camera_axes *axes, uint32_t x, uint32_t y, float dir[3])
{
    const float px = ((float)x + 0.5f) * axes->step[0] - 1.0f;
    const float py = 1.0f - ((float)y + 0.5f) * axes->step[1];
    for (int i = 0; i < 3; i++)
        dir[i] = axes->fwd[i] + px * axes->right[i] + py * axes->up[i];
}

/* ---- Tiles --------------------------------------------------------------------------------------------------- */

uint32_t bench_tiles(const bench_camera_axes *axes)
{
    return ((axes->width + TILE - 1) / TILE) * ((axes->height + TILE - 1) / TILE);
}

/* Every second bit of a block's place along the curve. */
static uint32_t even_bits(uint32_t i) { return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8); }

uint32_t bench_tile_pixels(const bench_camera_axes *axes, uint32_t tile, uint32_t pixel[BENCH_TILE_PIXELS])
{
    const uint32_t columns = (axes->width + TILE - 1) / TILE;
    const uint32_t left = tile % columns * TILE, top = tile / columns * TILE;
    const int whole = axes->width - left >= TILE && axes->height - top >= TILE;
    uint32_t count = 0;
    for (uint32_t block = 0; block < BENCH_TILE_PIXELS / GROUP; block++) {
        const uint32_t x0 = left + even_bits(block) * BLOCK, y0 = top + even_bits(block >> 1) * BLOCK;
        for (uint32_t i = 0; i < GROUP; i++)
            pixel[block * GROUP + i] = (x0 + i % BLOCK) | (y0 + i / BLOCK) << 16;
    }
    for (uint32_t i = 0; i < BENCH_TILE_PIXELS && !whole; i++) {
        const uint32_t p = pixel[i];
        pixel[count] = p;
        count += (p & 0xffff) < axes->width && p >> 16 < axes->height;
    }
    return whole ? BENCH_TILE_PIXELS : count;
}

/* Vectors for a row of a block, and of a square of four blocks. Compilers do not vectorise the loops with two
 * subscripts. */
typedef float block_floats __attribute__((vector_size(sizeof(float[BLOCK]))));
typedef int32_t block_words __attribute__((vector_size(sizeof(int32_t[BLOCK]))));
typedef float square_floats __attribute__((vector_size(sizeof(float[SQUARE]))));
typedef int32_t square_words __attribute__((vector_size(sizeof(int32_t[SQUARE]))));

/* Lists all pixels of a block, and their t. */
static inline void list_whole_block(const float *t, uint32_t width, uint32_t x0, uint32_t y0, uint32_t *to, float *to_t)
{
    const int32_t corner = (int32_t)(x0 | y0 << 16);
    const block_words columns = {corner, corner + 1, corner + 2, corner + 3};
    for (int32_t row = 0; row < BLOCK; row++) {
        const block_words pixels = columns + (row << 16);
        memcpy(to + row * BLOCK, &pixels, sizeof pixels);
        memcpy(to_t + row * BLOCK, t + (size_t)row * width, sizeof(float[BLOCK]));
    }
}

/* Lists the pixels of a block that hit, and their t. In most blocks all or none hit. Few branches: at the edge of a
 * surface they would be mispredicted. */
static inline uint32_t list_block(const float *t, uint32_t width, uint32_t x0, uint32_t y0, uint32_t *to, float *to_t)
{
    block_floats at[BLOCK];
    block_words is[BLOCK], found = {0};
    uint32_t hits = 0, listed = 0;
    for (uint32_t row = 0; row < BLOCK; row++) {
        memcpy(&at[row], t + (size_t)row * width, sizeof at[row]);
        is[row] = at[row] < INFINITY;
        found -= is[row];
    }
    for (uint32_t i = 0; i < BLOCK; i++)
        hits += (uint32_t)found[i];
    if (!hits)
        return 0;
    if (hits == GROUP) {
        list_whole_block(t, width, x0, y0, to, to_t);
        return GROUP;
    }
    for (uint32_t row = 0; row < BLOCK; row++)
        for (uint32_t i = 0; i < BLOCK; i++) {
            to[listed] = (x0 + i) | (y0 + row) << 16;
            to_t[listed] = at[row][i];
            listed -= (uint32_t)is[row][i];
        }
    return listed;
}

/* How many pixels hit in the square of four blocks that begins at t. */
static inline uint32_t square_hits(const float *t, uint32_t width)
{
    square_words found = {0};
    uint32_t hits = 0;
    for (uint32_t row = 0; row < SQUARE; row++) {
        square_floats at;
        memcpy(&at, t + (size_t)row * width, sizeof at);
        found -= at < INFINITY;
    }
    for (uint32_t i = 0; i < SQUARE; i++)
        hits += (uint32_t)found[i];
    return hits;
}

/* list_block for a block that the picture's edge cuts. */
static uint32_t list_part_block(const float *t, const bench_camera_axes *axes, uint32_t x0, uint32_t y0, uint32_t *to,
                                float *to_t)
{
    uint32_t listed = 0;
    for (uint32_t y = y0; y < y0 + BLOCK && y < axes->height; y++)
        for (uint32_t x = x0; x < x0 + BLOCK && x < axes->width; x++) {
            to[listed] = x | y << 16;
            to_t[listed] = t[(size_t)y * axes->width + x];
            listed += to_t[listed] < INFINITY;
        }
    return listed;
}

/* Prefetches one cache line of the next tile per block. A tile is scattered over memory, a piece per row, and hardware
 * prefetchers do not follow that many streams. */
static inline void prefetch_line(const bench_camera_axes *axes, const float *t, uint32_t left, uint32_t top,
                                 uint32_t block)
{
    const uint32_t x = left + block % (TILE / GROUP) * GROUP, y = top + block / (TILE / GROUP);
    if (x < axes->width && y < axes->height)
        __builtin_prefetch(t + (size_t)y * axes->width + x);
}

BENCH_CLONES
uint32_t bench_tile_hits(const bench_camera_axes *axes, const float *t, uint32_t tile, uint32_t *to, float *to_t)
{
    const uint32_t width = axes->width, height = axes->height, columns = (width + TILE - 1) / TILE;
    const uint32_t left = tile % columns * TILE, top = tile / columns * TILE;
    uint32_t hits = 0;
    for (uint32_t block = 0; block < BENCH_TILE_PIXELS / GROUP; block++) {
        const uint32_t x0 = left + even_bits(block) * BLOCK, y0 = top + even_bits(block >> 1) * BLOCK;
        prefetch_line(axes, t, left + TILE, top, block);
        if (block % SQUARE_BLOCKS == 0 && x0 + SQUARE <= width && y0 + SQUARE <= height) {
            const uint32_t found = square_hits(t + (size_t)y0 * width + x0, width);
            if (found == 0 || found == SQUARE * SQUARE) {
                for (uint32_t k = 0; k < SQUARE_BLOCKS && found; k++, hits += GROUP) {
                    const uint32_t x = x0 + k % 2 * BLOCK, y = y0 + k / 2 * BLOCK;
                    list_whole_block(t + (size_t)y * width + x, width, x, y, to + hits, to_t + hits);
                }
                for (uint32_t k = 1; k < SQUARE_BLOCKS; k++)
                    prefetch_line(axes, t, left + TILE, top, ++block);
                continue;
            }
        }
        if (x0 + BLOCK <= width && y0 + BLOCK <= height)
            hits += list_block(t + (size_t)y0 * width + x0, width, x0, y0, to + hits, to_t + hits);
        else
            hits += list_part_block(t, axes, x0, y0, to + hits, to_t + hits);
    }
    return hits;
}
