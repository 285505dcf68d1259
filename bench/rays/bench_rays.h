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
 * A pass finds the hit pixels, tile by tile as renderers trace them (bench_tile_pixels), makes their rays and hands
 * them to a sink. Shadow rays, of the library the origins alone, are made and traced for each tile by itself, by
 * whichever of the context's threads takes it. Others are made and traced batch by batch: the same threads fill the
 * arrays of a batch and then trace it. */
#ifndef BENCH_RAYS_H
#define BENCH_RAYS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "rays/bench_planes.h"
#include "rays/bench_tiles.h"

typedef struct bench_rays bench_rays;

/* context, axes and planes are referred to, not copied. most_ao: the largest `samples` of bench_rays_ao. NULL where
 * memory is refused. */
bench_rays *bench_rays_create(cgt_context *context, const bench_camera_axes *axes, const bench_planes *planes,
                              uint32_t most_ao);

/* NULL: does nothing. */
void bench_rays_release(bench_rays *rays);

/* What rays are handed to; the functions set occluded[i] to 0 or 1 for each ray. */
typedef struct bench_rays_sink {
    /* A batch, from the calling thread. scratch: room for t and primitive of each ray. */
    cgt_result (*batch)(void *user, const cgt_rays *batch, const cgt_hits *scratch, uint8_t *occluded);
    /* A tile's shadow rays, from all threads at the same time; NULL: they come as batches. */
    cgt_result (*tile)(void *user, const float light[3], const cgt_rays *tile, uint8_t *occluded);
    int wants_dir; /* 0: a tile's origins are enough */
    void *user;
} bench_rays_sink;

/* One shadow ray per hit pixel; hidden gets the number of those that hit something. */
cgt_result bench_rays_shadow(bench_rays *rays, const bench_rays_sink *sink, const float light[3], uint64_t *hidden);

/* `samples` ambient-occlusion rays per hit pixel; open gets the number of those that hit nothing. */
cgt_result bench_rays_ao(bench_rays *rays, const bench_rays_sink *sink, uint32_t samples, uint64_t *open);

/* One diffuse bounce per hit pixel. */
cgt_result bench_rays_bounce(bench_rays *rays, const bench_rays_sink *sink);

/* The pixel of a ray of the last pass, which had `samples` rays per hit: x + 65536 y. */
uint32_t bench_rays_pixel(const bench_rays *rays, uint64_t ray, uint32_t samples);

#endif
