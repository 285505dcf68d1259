/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light as packets of rays. */
#ifndef CGT_LIGHT_POINTS_H
#define CGT_LIGHT_POINTS_H

#include "kernel/packet/ray_packet.h"
#include "query/tile_limits.h"

typedef struct light_call {
    const cgt_committed_scene *committed_scene;
    ray_source source;
    cgt_light light; /* the source's */
    ray_order order;
    const cgt_trace_settings *settings;
    uint8_t *occluded;
    cgt_counts *counts;
} light_call;

/* Sorts points that the light sees side by side into the same groups, along a Hilbert curve: from[i] is the number of
 * the i-th (light_order.c). */
void CGT_KERNEL(cgt_light_sort_points)(const light_call *c, uint32_t count, uint32_t from[CGT_RAYS_CHUNK]);

/* Whether neighbours in the arrays mostly lie far apart: on average a third of what the light sees of the chunk. */
bool CGT_KERNEL(cgt_light_is_scattered)(const light_call *c, uint32_t count);

/* Whether one sphere is found that the light is in and all of the first `count` points are outside of: it occludes
 * them. */
bool CGT_KERNEL(cgt_light_is_enclosed)(const light_call *c, uint32_t count);

/* Whether the light is near enough for tests by shared terms. */
CGT_SPU_INLINE bool light_is_near(const light_call *c)
{
    float farthest = 0;
    for (int a = 0; a < 3; a++)
        farthest += c->light.kind == CGT_LIGHT_POINT ? fabsf(c->light.position[a]) * c->committed_scene->scale : 0;
    return farthest <= CGT_LIGHT_MAX_DISTANCE;
}

/* Elements i to i + CGT_LANES - 1 of an array, in the order. */
CGT_SPU_INLINE vfloat light_gather_points(const ray_order *order, const float *array, uint32_t i)
{
    const float *from = array + order->first;
    return order->from ? spux_gather(from, (vint)spux_load_unaligned_uint(order->from + i))
                       : spux_load_unaligned(from + i);
}

/* Loads whole vectors of points. Returns false if one is not a plain ray: then they are read one by one. */
CGT_SPU_INLINE bool light_load_packet(const light_call *c, uint32_t first, uint32_t count, packet *p)
{
    const cgt_rays *points = c->source.rays;
    const ray_order *order = &c->order;
    const bool is_point = c->light.kind == CGT_LIGHT_POINT;
    const ray_limits limits = ray_packet_limits(c->committed_scene, &c->source);
    vmask others = spux_mask_none();
    p->lanes = p->rays = count;
    p->common_origin = p->from_origin = p->extreme = false;
    p->to_light = is_point;
    ray_packet_select(c->committed_scene, &c->source, order, first, count, p);
    for (uint32_t i = 0; i < count; i += CGT_LANES) {
        ray_lanes q;
        vfloat dd = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            q.org[a] = light_gather_points(order, points->org[a], first + i);
            q.dir[a] = ray_direction_lanes(&c->light, is_point, a, q.org[a]);
            dd = spu_add(dd, spu_mul(q.dir[a], q.dir[a]));
            spux_store(p->org[a] + i, q.org[a]);
            spux_store(p->dir[a] + i, q.dir[a]);
        }
        q.t_min = points->t_min ? light_gather_points(order, points->t_min, first + i) : spux_vfloat(0);
        q.t_max = points->t_max ? light_gather_points(order, points->t_max, first + i) : spux_vfloat(c->source.t_max);
        /* one by one where a range begins before the point: ray_begin bounds it */
        others = spu_or(others, spu_cmpgt(spux_vfloat(0), q.t_min));
        others = spu_or(others, ray_classify_lanes(&q, &limits).unusual);
        spux_store(p->rdd + i, spux_div(spux_vfloat(1), dd));
        spux_store(p->t_min + i, q.t_min);
        spux_store(p->t_max + i, q.t_max);
        spux_store(p->low + i, q.t_max);
        spux_store(p->high + i, q.t_max);
        spux_store_uint(p->prim + i, spux_vuint(CGT_INVALID_ID));
    }
    for (int a = 0; a < 3; a++)
        p->light[a] = c->light.position[a];
    return spux_none(others);
}

/* Whether the points are dense arrays. */
CGT_SPU_INLINE bool light_points_are_dense(const light_call *c) { return ray_source_is_dense(&c->source); }

/* Reads points first to first + count - 1 of the order, at most a packet. Returns false if one of several is extreme:
 * then they must be read one by one. */
CGT_SPU_INLINE bool light_read_packet(const light_call *c, uint32_t first, uint32_t count, packet *p)
{
    const bool dense = count % CGT_LANES == 0 && light_points_are_dense(c);
    return (dense && light_load_packet(c, first, count, p)) ||
           ray_packet_init(c->committed_scene, &c->source, &c->order, first, count, p, c->counts);
}

/* Stores whether points first to first + count - 1 of the order are occluded. */
CGT_SPU_INLINE void light_store_occluded(const light_call *c, const packet *p, uint32_t first, uint32_t count)
{
    const uint32_t *restrict from = c->order.from ? c->order.from + first : NULL, *restrict prim = p->prim;
    uint8_t *restrict occluded = c->occluded + c->order.first; /* restrict: bytes may alias anything */
    if (!from)
        for (size_t k = 0; k < count; k++) /* size_t cannot wrap: compilers vectorise this */
            occluded[(size_t)first + k] = prim[k] != CGT_INVALID_ID;
    else
        for (size_t k = 0; k < count; k++)
            occluded[from[k]] = prim[k] != CGT_INVALID_ID;
}

/* Counts the occluded ones of the first `count` points. */
CGT_SPU_INLINE void light_count_hits(const light_call *c, uint32_t count)
{
    const uint8_t *occluded = c->occluded + c->order.first;
    uint32_t hits = 0;
    for (uint32_t k = 0; k < count; k++)
        hits += occluded[k];
    c->counts->hits += hits;
}

/* Traces points first to first + count - 1 of the order, at most a packet, through any structure. */
__attribute__((unused)) static void light_trace_packet(const light_call *c, uint32_t first, uint32_t count, packet *p)
{
    if (!ray_packet_init(c->committed_scene, &c->source, &c->order, first, count, p, c->counts)) {
        for (uint32_t k = 0; k < count; k++)
            light_trace_packet(c, first + k, 1, p);
        return;
    }
    p->fast = c->settings->triangle_test != CGT_TRIANGLE_TEST_AUTO; /* a packet of unusual rays resets it */
    CGT_KERNEL(cgt_packet_trace)(c->committed_scene, p, c->settings, c->counts);
    light_store_occluded(c, p, first, count);
}

#endif
