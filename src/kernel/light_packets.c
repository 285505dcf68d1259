/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light, any hit: neighbours in the arrays become packets of rays from the points to the light. Such
 * rays share a direction, or where they end: large packets have much in common. */
#include "ray_packet.h"

#define LIGHT_PACKET 128u /* rays; measured: larger ones share more of spheres, smaller ones of fine meshes */

typedef struct light_call {
    const cgt_world *world;
    ray_source source;
    ray_order order;
    const cgt_trace_settings *settings;
    uint8_t *occluded;
    cgt_counts *counts;
} light_call;

static void trace_points(const light_call *c, uint32_t first, uint32_t count, packet *p)
{
    if (!ray_packet_make(c->world, &c->source, &c->order, first, count, p, c->counts)) {
        for (uint32_t k = 0; k < count; k++)
            trace_points(c, first + k, 1, p);
        return;
    }
    CGT_KERNEL(cgt_packet_trace)(c->world, p, c->settings, c->counts);
    for (uint32_t k = 0; k < count; k++) {
        const bool hit = p->object[k] != CGT_NONE;
        c->occluded[ray_at(&c->order, first + k)] = hit;
        c->counts->hits += hit;
    }
}

void CGT_KERNEL(cgt_trace_light)(const cgt_world *world, const cgt_rays *points, const cgt_light *light, uint64_t first,
                                 uint64_t end, const cgt_trace_settings *settings, uint8_t *occluded,
                                 cgt_counts *counts)
{
    packet p;
    if (settings->light_tiles) {
        CGT_KERNEL(cgt_tile_trace_light)(world, points, light, first, end, settings, occluded, counts);
        return;
    }
    if (settings->wide) {
        CGT_KERNEL(cgt_wide_trace_light)(world, points, light, first, end, settings, occluded, counts);
        return;
    }
    const light_call c = {.world = world,
                          .source = ray_source_make(points, light),
                          .order = {first, NULL},
                          .settings = settings,
                          .occluded = occluded,
                          .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    p.any_hit = true;
    p.fast = settings->precision == CGT_PRECISION_FAST;
    p.triangle_test = settings->triangle_test;
    counts->rays += count;
    for (uint32_t i = 0; i < count; i += LIGHT_PACKET)
        trace_points(&c, i, count - i < LIGHT_PACKET ? count - i : LIGHT_PACKET, &p);
}
