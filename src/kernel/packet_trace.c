/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hits of a packet, through the structure that the commit built. */
#include "leaf_lanes.h"

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

/* Rays of a vector that an object may be the nearest hit of. */
static unsigned rays_to_decide(const packet *p, uint32_t i, const lane_rays *rays, const cgt_shape *shape)
{
    const vfloat center[3] = {spux_vfloat(shape->sphere.x), spux_vfloat(shape->sphere.y), spux_vfloat(shape->sphere.z)};
    lane_hits hits;
    if (shape->kind != CGT_KIND_SPHERES)
        return CGT_ALL_LANES;
    if (!lane_sphere(rays, center, spux_vfloat(shape->sphere.r), &hits))
        return 0;
    return spux_mask_bits(spu_andc(spu_or(hits.certain, hits.open), spu_cmpgt(hits.low, spux_load(p->high + i))));
}

/* Every ray against every object: nothing walks the loose grid yet. What a sphere's bounds leave is decided in
 * double. */
static void trace_loose_grid(const cgt_world *world, packet *p, cgt_counts *counts)
{
    const cgt_objects *o = &world->objects;
    for (uint32_t object = 0; object < o->count; object++) {
        const cgt_shape shape = cgt_objects_shape(o, object);
        if (cgt_shape_check(&shape) != CGT_OBJECT_VALID)
            continue;
        counts->packet_tests++;
        counts->ray_tests += p->lanes;
        for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
            lane_rays rays;
            lane_rays_of_packet(p, i, world->scale, &rays);
            for (unsigned left = rays_to_decide(p, i, &rays, &shape); left; left &= left - 1)
                filter_decide(o, p, i + (uint32_t)__builtin_ctz(left), object, counts);
        }
    }
    p->extreme |= p->fast; /* the winners' values come from double, as those of extreme packets do */
}

void CGT_KERNEL(cgt_packet_trace)(const cgt_world *world, packet *p, const cgt_trace_settings *settings,
                                  cgt_counts *counts)
{
    if (!p->rays || !world->valid)
        return;
    if (p->extreme || world->everything)
        trace_extreme(world, p, counts);
    else if (world->structure == CGT_STRUCTURE_LOOSE_GRID)
        trace_loose_grid(world, p, counts);
    else if (world->structure == CGT_STRUCTURE_KD)
        CGT_KERNEL(cgt_kd_trace)(world, p, settings, counts);
    else if (world->structure == CGT_STRUCTURE_KD_ROPES)
        CGT_KERNEL(cgt_kd_ropes_trace)(world, p, settings, counts);
    else
        CGT_KERNEL(cgt_queue_grid_trace)(world, p, settings, counts);
}
