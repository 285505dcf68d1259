/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points that lights may reach. */
#ifndef LIGHT_POINTS_H
#define LIGHT_POINTS_H

#include "sets/bench_sets.h"

#define LIGHT_SCATTERED_POINTS 100000u

/* A frame as the camera sees it. */
typedef struct light_scene {
    const sets_job *job;
    float low[3], high[3]; /* of centres or vertices */
} light_scene;

typedef enum light_order {
    LIGHT_TILES,     /* what the camera sees: a call for each tile of 64x64 pixels */
    LIGHT_SKIPPING,  /* the same on the very hits, each skipping its primitive, as those of a frame do */
    LIGHT_FRAME,     /* these by cgt_occluded_frame */
    LIGHT_SHUFFLED,  /* the first ones in no order, in one call */
    LIGHT_SCATTERED, /* random points of the scene's box, in one call */
    LIGHT_SORTED,    /* the same along a Morton curve */
    LIGHT_ORDERS
} light_order;

typedef struct light_points {
    light_order order;
    uint64_t count;
    float *position[3];
    uint32_t *primitive; /* SKIPPING alone: that they skip, */
    float *offset;       /* and where Embree's rays begin in place of that */
    uint64_t *end;       /* of each call */
    uint32_t calls;
    void *memory;
} light_points;

/* 0, or -1 where memory is refused. */
int light_points_make(const light_scene *scene, light_order order, light_points *points);
void light_points_release(light_points *points);

#endif
