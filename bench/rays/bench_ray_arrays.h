/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays that are made once and traced many times: the secondary rays of bench_rays.h, and random ones. */
#ifndef BENCH_RAY_ARRAYS_H
#define BENCH_RAY_ARRAYS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "rays/bench_rays.h"

typedef struct bench_ray_array {
    uint64_t count, room;
    float *org[3], *dir[3];
    float *t_max;
    uint8_t bounded; /* 1: t_max holds; 0: the rays do not end */
} bench_ray_array;

/* The rays that bench_rays_shadow, bench_rays_ao and bench_rays_bounce make. */
cgt_result bench_ray_array_shadow(bench_ray_array *rays, bench_rays *maker, const float light[3]);
cgt_result bench_ray_array_ao(bench_ray_array *rays, bench_rays *maker, uint32_t samples);
cgt_result bench_ray_array_bounce(bench_ray_array *rays, bench_rays *maker);

/* `count` rays from a random point of a box towards another, in no order; the same in each call. */
cgt_result bench_ray_array_random(bench_ray_array *rays, uint32_t count, const float low[3], const float high[3]);

/* Makes room for `more` rays behind the last one. */
cgt_result bench_ray_array_reserve(bench_ray_array *rays, uint64_t more);

/* The array in the form that the library takes. */
cgt_rays bench_ray_array_view(const bench_ray_array *rays);

void bench_ray_array_release(bench_ray_array *rays);

#endif
