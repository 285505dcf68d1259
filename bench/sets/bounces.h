/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The waves of Whitted's tracing, and orders of their rays. */
#ifndef BENCH_BOUNCES_H
#define BENCH_BOUNCES_H

#include <stdint.h>

#include "common/bench.h"

enum {
    BOUNCES = 4,                 /* that are measured, 1 to 4; the camera's rays are measured elsewhere */
    BOUNCES_MOST_RAYS = 1 << 20, /* of a wave; what comes later is left out */
    BOUNCES_CALL = 4096          /* rays that picture/whitted traces in a call */
};

typedef struct bounces_ray {
    float org[3], dir[3], t_min, t_max;
    float offset;  /* Embree's t_min: it has no primitive to ignore */
    uint32_t skip; /* the primitive that the ray leaves; CGT_INVALID_ID: none */
} bounces_ray;

typedef struct bounces_wave {
    bounces_ray *ray; /* BOUNCES_MOST_RAYS; NULL before the first */
    uint64_t count, left_out;
} bounces_wave;

typedef enum bounces_order {
    BOUNCES_WAVES,         /* as made, in calls of BOUNCES_CALL rays: as picture/whitted traces them */
    BOUNCES_MADE,          /* as made, in one call */
    BOUNCES_OCTANT,        /* within each call of BOUNCES_CALL by the octant of the direction */
    BOUNCES_WAVE_MORTON,   /* within each call by octant, then by Morton code of the origin */
    BOUNCES_ORIGIN,        /* by Morton code of the origin, then by octant, in one call */
    BOUNCES_OCTANT_MORTON, /* by octant, then by Morton code of the origin, in one call */
    BOUNCES_ORDERS
} bounces_order;

/* Rays in arrays. */
typedef struct bounces_rays {
    uint64_t count;
    float *org[3], *dir[3], *t_min, *t_max, *offset;
    uint32_t *skip;
    double ms; /* what ordering them took, one thread */
    void *memory;
} bounces_rays;

/* 0, or -1 where memory is refused. */
int bounces_rays_make(const bounces_wave *wave, bounces_order order, bounces_rays *rays);
void bounces_rays_release(bounces_rays *rays);

#endif
