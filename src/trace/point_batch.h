/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against a light, packed: those that are live lie side by side in dense arrays, so that the others cost nothing.
 * Others are off (an empty range), or invalid (a NaN, an infinity, or the light's own place). And the order in which
 * points are packed: a picture's rows lie close together only where many of them are cut into pieces together. */
#ifndef CGT_POINT_BATCH_H
#define CGT_POINT_BATCH_H

#include <float.h>
#include <math.h>

#include "dispatch/frame_points.h"
#include "dispatch/kernel.h"

#define CGT_MAX_TASK_POINTS (8u * CGT_RAYS_CHUNK) /* that are ordered together */

/* The live points of a task, as numbers from its first point on. */
typedef struct cgt_point_order {
    uint16_t number[CGT_MAX_TASK_POINTS], listed[CGT_MAX_TASK_POINTS];
    uint32_t live, invalid;
    bool as_given; /* all are live, and chunks of them lie close together as they are */
} cgt_point_order;

typedef enum cgt_point_state { CGT_POINT_LIVE, CGT_POINT_OFF, CGT_POINT_INVALID } cgt_point_state;

/* Without a branch on any point: they would be mispredicted at every edge of a picture. */
static inline cgt_point_state cgt_find_point_state(const float position[3], float t_min, float t_max,
                                                   const cgt_light *light)
{
    const bool is_point = light->kind == CGT_LIGHT_POINT;
    unsigned finite = 1, at_light = is_point;
    for (int a = 0; a < 3; a++) {
        const float d = is_point ? light->position[a] - position[a] : light->position[a];
        finite &= (unsigned)(fabsf(position[a]) <= FLT_MAX) & (unsigned)(fabsf(d) <= FLT_MAX);
        at_light &= (unsigned)(d == 0);
    }
    const unsigned invalid = (finite ^ 1) | at_light | (unsigned)(t_min != t_min) | (unsigned)(t_max != t_max);
    return invalid ? CGT_POINT_INVALID : t_min > t_max ? CGT_POINT_OFF : CGT_POINT_LIVE;
}

/* Whether the arrays are dense and all points live, as cgt_find_point_state says it. */
bool cgt_points_are_live(const cgt_rays *points, const cgt_light *light);

/* Finds which of points first to end - 1, at most CGT_MAX_TASK_POINTS, are live, and orders them. */
void cgt_point_order_init(cgt_point_order *o, const cgt_rays *points, const cgt_light *light, uint64_t first,
                          uint64_t end, cgt_scratch *scratch);

/* Packs `count` points, at most CGT_RAYS_CHUNK, by their numbers from `first` on. */
void cgt_point_batch_fill(cgt_point_batch *b, const cgt_rays *points, uint64_t first, const uint16_t *number,
                          uint32_t count);

#endif
