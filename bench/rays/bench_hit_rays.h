/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Makes the secondary rays that bench_rays.h defines, of lists of hit pixels, x + 65536 y and t. Any thread may call
 * the functions. */
#ifndef BENCH_HIT_RAYS_H
#define BENCH_HIT_RAYS_H

#include <stdint.h>

#include "rays/bench_planes.h"
#include "rays/bench_tiles.h"

enum {
    BENCH_BLOCK = 4,                        /* pixels along a block's edge */
    BENCH_GROUP = BENCH_BLOCK * BENCH_BLOCK /* hit pixels whose rays lie together */
};

/* Makes the shadow rays of `count` hit pixels. dir: NULL where only origins are needed. */
void bench_make_shadow_rays(const bench_camera_axes *axes, const float light[3], const uint32_t *hit, const float *t,
                            uint32_t count, float *const org[3], float *const dir[3]);

/* Ambient-occlusion rays, or diffuse bounces, of hit pixels. */
typedef struct bench_sky_rays {
    const bench_camera_axes *axes;
    const bench_planes *planes;
    const uint32_t *hit; /* hits of them */
    const float *t;
    uint64_t hits;
    uint32_t samples;       /* rays of a pixel */
    int diffuse;            /* 1: bounces */
    float *org[3], *dir[3]; /* hits * samples rays: all of a group lie together, sample by sample */
} bench_sky_rays;

/* Makes the rays of hits first to end - 1; first: a multiple of BENCH_GROUP. */
void bench_make_sky_rays(const bench_sky_rays *s, uint64_t first, uint64_t end);

#endif
