/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hits of a packet, through the structure that the commit built. */
#include "kernel/primitive/filter.h"

/* Numbers too large or too small for the bounds of single precision: every ray against every object in double. */
static void trace_extreme(const cgt_world *world, packet *p, cgt_counts *counts)
{
    for (uint32_t object = 0; object < world->objects.count; object++) {
        const cgt_shape shape = cgt_objects_shape(&world->objects, object);
        if (cgt_shape_check(&shape) != CGT_OBJECT_VALID)
            continue;
        counts->packet_tests++;
        counts->ray_tests += p->rays;
        for (uint32_t i = 0; i < p->lanes; i++)
            filter_decide(&world->objects, p, i, object, counts);
    }
}

void CGT_KERNEL(cgt_packet_trace)(const cgt_world *world, packet *p, const cgt_trace_settings *settings,
                                  cgt_counts *counts)
{
    if (!p->rays || !world->valid)
        return;
    if (p->extreme || world->everything)
        trace_extreme(world, p, counts);
    else if (world->structure == CGT_STRUCTURE_LOOSE_GRID)
        CGT_KERNEL(cgt_loose_grid_trace)(world, p, settings, counts);
    else if (world->structure == CGT_STRUCTURE_BVH)
        CGT_KERNEL(cgt_wide_trace)(world, p, settings, counts);
    else if (world->structure == CGT_STRUCTURE_KD)
        CGT_KERNEL(cgt_kd_trace)(world, p, settings, counts);
    else if (world->structure == CGT_STRUCTURE_KD_ROPES)
        CGT_KERNEL(cgt_kd_ropes_trace)(world, p, settings, counts);
    else
        CGT_KERNEL(cgt_queue_grid_trace)(world, p, settings, counts);
}
