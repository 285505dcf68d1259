/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light, any hit: neighbours in the arrays become packets of rays from the points to the light. Such
 * rays share a direction, or their end: large packets share much work. */
#include "kernel/light/light_points.h"

#define LIGHT_PACKET_RAYS 128u /* rays; measured: larger ones share more of spheres, smaller ones of fine meshes */

bool CGT_KERNEL(cgt_trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                 const cgt_light *light, uint64_t first, uint64_t end,
                                 const cgt_trace_settings *settings, uint8_t *occluded, cgt_counts *counts)
{
    if (settings->light_tiles)
        return CGT_KERNEL(cgt_tile_trace_light)(committed_scene, points, light, first, end, settings, occluded, counts);
    if (settings->use_bvh)
        return CGT_KERNEL(cgt_bvh_trace_light)(committed_scene, points, light, first, end, settings, occluded, counts);
    packet *p = cgt_scratch_take(counts->scratch, sizeof *p);
    const light_call c = {.committed_scene = committed_scene,
                          .source = ray_source_init(points, light),
                          .light = *light,
                          .order = {first, NULL},
                          .settings = settings,
                          .occluded = occluded,
                          .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    p->any_hit = true;
    p->triangle_test = settings->triangle_test;
    counts->rays += count;
    for (uint32_t i = 0; i < count; i += LIGHT_PACKET_RAYS)
        light_trace_packet(&c, i, count - i < LIGHT_PACKET_RAYS ? count - i : LIGHT_PACKET_RAYS, p);
    light_count_hits(&c, count);
    cgt_scratch_return(counts->scratch, p);
    return true;
}
