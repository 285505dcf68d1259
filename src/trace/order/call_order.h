/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The order in which a call's points against a light are traced. Chunks of them must lie close together as the light
 * sees them: so all points of a call are sorted at once by the cells of its view, on all threads. Points that are off
 * or invalid (query/ray_intake.h) are left out. */
#ifndef CGT_CALL_ORDER_H
#define CGT_CALL_ORDER_H

#include "dispatch/kernel.h"
#include "scene/scene.h"

#define CGT_ORDERED_POINTS (1u << 20) /* at most: bounds the memory that a call takes */

typedef struct cgt_call_order {
    cgt_buffer memory;      /* of the context */
    const uint32_t *number; /* of the live points, in their order */
    uint32_t live, invalid;
    bool as_given; /* all are live, and chunks of them lie close together as they are */
} cgt_call_order;

/* Orders the points, at most CGT_ORDERED_POINTS. OUT_OF_MEMORY, with a message: then there is nothing to release. */
cgt_result cgt_call_order_init(cgt_call_order *o, const cgt_scene *scene, const cgt_rays *points,
                               const cgt_light *light);
void cgt_call_order_release(cgt_call_order *o, const cgt_scene *scene);

#endif
