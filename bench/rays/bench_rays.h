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
 * A pass finds the hit pixels, tile by tile as renderers trace them (bench_tile_pixels). Shadow rays, of the library
 * the origins alone, are made and traced for each tile by itself, by whichever of the benchmark's threads takes it.
 * Others are made and traced batch by batch: the benchmark's threads fill the arrays of a batch, the library's threads
 * trace it, each as many as the context has. */
#ifndef BENCH_RAYS_H
#define BENCH_RAYS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "rays/bench_planes.h"
#include "common/bench_threads.h"
#include "rays/bench_tiles.h"

#define BENCH_MOST_AO_RAYS 1024u

typedef struct bench_rays bench_rays;

/* threads, axes and planes are referred to, not copied. most_ao: the largest `samples` of bench_rays_ao. NULL where
 * memory is refused. */
bench_rays *bench_rays_create(bench_threads *threads, const bench_camera_axes *axes, const bench_planes *planes,
                              uint32_t most_ao);

/* NULL: does nothing. */
void bench_rays_release(bench_rays *rays);

/* Gets each batch instead of the library, and sets occluded[i] to 0 or 1 for each ray. */
typedef cgt_result bench_rays_sink(void *user, const cgt_rays *batch, uint8_t *occluded);

/* Sends the batches of later passes to a sink, which does not use scene and options; NULL: to the library. */
void bench_rays_set_sink(bench_rays *rays, bench_rays_sink *sink, void *user);

/* Until the next bench_rays_set_sink, shadow rays go to this sink with the same user: a tile per call, from all threads
 * at the same time. */
void bench_rays_set_tile_sink(bench_rays *rays, bench_rays_sink *sink);

/* Traces one shadow ray per hit pixel; hidden gets the number of those that hit something. options: NULL for the
 * library's. */
cgt_result bench_rays_shadow(bench_rays *rays, const cgt_scene *scene, const cgt_trace_options *options,
                             const float light[3], uint64_t *hidden);

/* 1: ambient-occlusion rays of later passes search for the closest hit, t and primitive; 0 (default): for any hit. */
void bench_rays_nearest(bench_rays *rays, int nearest);

/* Traces `samples` ambient-occlusion rays per hit pixel; open gets the number of those that hit nothing. */
cgt_result bench_rays_ao(bench_rays *rays, const cgt_scene *scene, const cgt_trace_options *options, uint32_t samples,
                         uint64_t *open);

/* Makes one diffuse bounce per hit pixel, for a sink. */
cgt_result bench_rays_bounce(bench_rays *rays);

/* The pixel of a ray of the last pass, which had `samples` rays per hit: x + 65536 y. */
uint32_t bench_rays_pixel(const bench_rays *rays, uint64_t ray, uint32_t samples);

#endif
