/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The shading of pictures that are measured, the same for the library and for Embree: Lambert's law for one sun, a
 * little light everywhere, and a colour that follows from the primitive, as 8 bits each of red, green, blue and alpha.
 * It is written without branches: compilers make vectors of a row of pixels. */
#ifndef BENCH_SHADE_H
#define BENCH_SHADE_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "common/bench_clones.h"

typedef struct bench_picture {
    uint32_t width, height;
    uint32_t *rgba; /* row by row; NULL: no picture */
} bench_picture;

/* 0, or -1 where memory is refused. */
int bench_picture_create(bench_picture *picture, uint32_t width, uint32_t height);
void bench_picture_release(bench_picture *picture);

/* A visitor that shades a tile into a bench_picture, from primitives and normals. */
cgt_visit bench_shade_tile(void *picture, const cgt_tile *tile);

/* The colour of a primitive, the low bits red. */
BENCH_INLINE uint32_t bench_shade_channel(uint32_t hash, int shift, float light)
{
    const float share = 0.4f + 0.6f / 255 * (float)(int32_t)(hash >> shift & 255);
    return (uint32_t)(int32_t)(255 * light * share) << shift;
}

/* x, y, z: the unit normal, anything where nothing is hit. */
BENCH_INLINE uint32_t bench_shade(uint32_t primitive, float x, float y, float z)
{
    const uint32_t hash = primitive * 0x9e3779b1u >> 4;
    const float dot = 0.48f * x + 0.8f * y - 0.36f * z;
    const float light = 0.15f + 0.8f * (dot > 0 ? dot : 0);
    const uint32_t color = bench_shade_channel(hash, 0, light) | bench_shade_channel(hash, 8, light) |
                           bench_shade_channel(hash, 16, light) | 255u << 24;
    return primitive == UINT32_MAX ? 0 : color;
}

#endif
