/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Secondary rays of a finished frame: one shadow ray per hit pixel to a point light, and any number of
 * ambient-occlusion rays. They are functions of the frame alone, written here in the order of operations that other
 * programs can repeat, so that two ray tracers can be compared ray by ray.
 *
 *   direction of pixel (x, y)   fwd + px right + py up, px = (x + 0.5) (2 / width) - 1,
 *                               py = 1 - (y + 0.5) (2 / height)
 *   origin                      eye + 0.9999 t direction: just before the hit
 *   shadow ray                  towards light - origin, t from 0 to 1
 *   ambient-occlusion ray s     a hashed point of the octahedron, turned to the side of the surface that the eye sees,
 *                               t from 0 to infinity; the hash is of 64 o + s, where o numbers the pixels in blocks of
 *                               4x4, blocks row by row and pixels row by row within a block
 *   diffuse bounce              the normal on that side and the hashed point, moved to the unit sphere, added up; the
 *                               same range
 *
 * A pass finds the hit pixels, tile by tile as renderers trace them (bench_tile_pixels). Shadow rays, of the library the
 * origins alone, are made and traced for each tile by itself, by whichever of the benchmark's threads takes it. Others are
 * made and traced batch by batch: the benchmark's threads fill the arrays of a batch, the library's threads trace it,
 * each as many as the context has. */
#ifndef BENCH_RAYS_H
#define BENCH_RAYS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "common/bench_planes.h"
#include "common/bench_threads.h"

#define BENCH_MOST_AO_RAYS 1024u
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

typedef struct bench_rays bench_rays;

/* threads, axes and planes are used, not copied; most_ao: the largest number that bench_rays_ao will be asked for.
 * NULL where memory is refused. */
bench_rays *bench_rays_create(bench_threads *threads, const bench_camera_axes *axes, const bench_planes *planes,
                              uint32_t most_ao);

/* NULL is ignored. */
void bench_rays_release(bench_rays *rays);

/* Takes each batch in place of the library, and sets occluded[i] to 0 or 1 for each ray of it. */
typedef cgt_result bench_rays_taker(void *user, const cgt_rays *batch, uint8_t *occluded);

/* Batches of the passes to come go to a taker; NULL: to the library. scene and options are not used then. */
void bench_rays_give(bench_rays *rays, bench_rays_taker *taker, void *user);

/* Until the next bench_rays_give shadow rays go to this one, with the same user: a tile's at a time, from all threads at
 * once. */
void bench_rays_give_tiles(bench_rays *rays, bench_rays_taker *taker);

/* Traces one shadow ray per hit pixel; hidden gets the number of those that met something.
 * options: of the traces; NULL for the library's. */
cgt_result bench_rays_shadow(bench_rays *rays, const cgt_scene *scene, const cgt_trace_options *options,
                             const float light[3], uint64_t *hidden);

/* 1: ambient-occlusion rays of the passes to come ask for their nearest hits, t and primitive; 0 (default): for any. */
void bench_rays_nearest(bench_rays *rays, int nearest);

/* Traces `samples` ambient-occlusion rays per hit pixel; open gets the number of those that met nothing. */
cgt_result bench_rays_ao(bench_rays *rays, const cgt_scene *scene, const cgt_trace_options *options, uint32_t samples,
                         uint64_t *open);

/* Makes one diffuse bounce per hit pixel, for a taker. */
cgt_result bench_rays_bounce(bench_rays *rays);

/* The pixel of a ray of the last pass, which had `samples` rays per hit: x + 65536 y. */
uint32_t bench_rays_pixel(const bench_rays *rays, uint64_t ray, uint32_t samples);

#endif
