/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's rays, and the order of a picture's pixels by tiles. */
#ifndef BENCH_TILES_H
#define BENCH_TILES_H

#include <stdint.h>

#include <cgt/cgt.h>

#define BENCH_TILE_EDGE 64u
#define BENCH_TILE_PIXELS (BENCH_TILE_EDGE * BENCH_TILE_EDGE)

/* The axes of a perspective camera; right and up are scaled to half the picture. */
typedef struct bench_camera_axes {
    float eye[3], fwd[3], right[3], up[3];
    uint32_t width, height;
    float step[2]; /* 2 / width, 2 / height */
} bench_camera_axes;

void bench_camera_axes_init(bench_camera_axes *axes, const cgt_camera *camera, uint32_t width, uint32_t height);

/* Of a pixel's camera ray. */
void bench_camera_direction(const bench_camera_axes *axes, uint32_t x, uint32_t y, float dir[3]);

/* Tiles of a picture, row by row. */
uint32_t bench_tiles(const bench_camera_axes *axes);

/* The pixels of a tile, x + 65536 y: blocks of 4x4 along a Morton curve, pixels row by row within a block. Returns how
 * many they are: less than BENCH_TILE_PIXELS at the picture's right and lower edge. */
uint32_t bench_tile_pixels(const bench_camera_axes *axes, uint32_t tile, uint32_t pixel[BENCH_TILE_PIXELS]);

/* The same for the pixels of a tile that hit, and their t; t: of the picture, +infinity for a miss. Both arrays have
 * room for one element more. */
uint32_t bench_tile_hits(const bench_camera_axes *axes, const float *t, uint32_t tile, uint32_t *pixel, float *pixel_t);

#endif
