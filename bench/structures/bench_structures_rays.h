/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays in arrays, made once per frame and traced by every row: the shadow and ambient-occlusion rays of bench_frame_rays.h,
 * and random ones. */
#ifndef BENCH_STRUCTURES_RAYS_H
#define BENCH_STRUCTURES_RAYS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "frame/bench_frame_rays.h"

typedef struct structures_rays {
    uint64_t count, room;
    float *org[3], *dir[3];
    float *t_max;
    uint8_t bounded; /* 1: t_max is used; else the rays do not end */
} structures_rays;

/* The rays that bench_rays_shadow and bench_rays_ao would trace, and diffuse bounces. Batches of the maker come here from then on. */
cgt_result structures_rays_shadow(structures_rays *rays, bench_rays *maker, const float light[3]);
cgt_result structures_rays_ao(structures_rays *rays, bench_rays *maker, uint32_t samples);
cgt_result structures_rays_bounce(structures_rays *rays, bench_rays *maker);

/* `count` rays from one random point of a box towards another, one after another anywhere; the same in each call. */
cgt_result structures_rays_random(structures_rays *rays, uint32_t count, const float low[3], const float high[3]);

/* Adds room for `more` rays behind the last one. */
cgt_result structures_rays_reserve(structures_rays *rays, uint64_t more);

/* As the library takes them. */
cgt_rays structures_rays_array(const structures_rays *rays);

void structures_rays_release(structures_rays *rays);

#endif
