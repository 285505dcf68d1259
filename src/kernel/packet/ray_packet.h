/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Packets from the caller's arrays. */
#ifndef CGT_RAY_PACKET_H
#define CGT_RAY_PACKET_H

#include "dispatch/kernel.h"
#include "kernel/packet/ray_box.h"
#include "query/ray_intake.h"

/* Rays in the order in which packets take them: `from` of the array's, counted from its `first`. */
typedef struct ray_order {
    uint64_t first;
    const uint32_t *from; /* NULL: in the order of the arrays */
} ray_order;

CGT_SPU_INLINE uint64_t ray_index(const ray_order *o, uint32_t i) { return o->first + (o->from ? o->from[i] : i); }

/* Errors of filters grow with the distance: rays from afar are unusual, where that is not a light's. */
CGT_SPU_INLINE ray_limits ray_packet_limits(const cgt_committed_scene *committed_scene, const ray_source *s)
{
    const float far = PACKET_MAX_DISTANCE / committed_scene->scale;
    return (ray_limits){s->light || far > PACKET_MAX_COORDINATE ? PACKET_MAX_COORDINATE : far, PACKET_MIN_DIR,
                        PACKET_MAX_COORDINATE};
}

/* Reads ray i of the arrays to k of the packet. */
static ray_state ray_packet_read(const ray_source *s, uint64_t i, const ray_limits *limits, packet *p, uint32_t k)
{
    const cgt_ray ray = ray_read(s, i);
    float dd = 0;
    for (int a = 0; a < 3; a++) {
        p->org[a][k] = ray.line.org[a];
        p->dir[a][k] = ray.line.dir[a];
        dd += ray.line.dir[a] * ray.line.dir[a];
    }
    p->rdd[k] = 1 / dd;
    p->t_min[k] = ray.t_min;
    p->t_max[k] = ray.t_max;
    return ray_classify(&ray, limits);
}

/* Elements first + i to first + i + CGT_LANES - 1 of a dense array, in the order. */
CGT_SPU_INLINE vuint ray_gather_numbers(const ray_order *order, const uint32_t *array, uint32_t i)
{
    const uint32_t *from = array + order->first;
    return order->from ? spux_gather_uint(from, (vint)spux_load_unaligned_uint(order->from + i))
                       : spux_load_unaligned_uint(from + i);
}

/* Sets the skipped primitives of rays of dense arrays without masks, whole vectors of them that all name the same
 * geometry, as neighbours mostly do. Returns false if they do not. */
CGT_SPU_INLINE bool ray_packet_skip_vectors(const cgt_primitives *prims, const ray_source *s, const ray_order *order,
                                            uint32_t first, uint32_t count, packet *p)
{
    const uint32_t *primitives = s->rays->skip_primitive, *geometries = s->rays->skip_geometry;
    const uint32_t geometry = geometries ? ray_number(s, geometries, ray_index(order, first)) : 0;
    const uint32_t base = cgt_primitives_number(prims, geometry, 0);
    const bool exists = base != CGT_INVALID_ID;
    const vuint none = spux_vuint(CGT_INVALID_ID);
    /* of primitives that there are: numbers below `count` */
    const vuint end = spux_vuint(exists ? cgt_primitives_array(prims, base)->count : 0);
    vmask same = spux_mask_all(), any = spux_mask_none();
    for (uint32_t i = 0; i < count; i += CGT_LANES) {
        const vuint primitive = ray_gather_numbers(order, primitives, first + i);
        const vmask known = spu_cmpgt(end, primitive);
        if (geometries)
            same = spu_and(same, spu_cmpeq(ray_gather_numbers(order, geometries, first + i), spux_vuint(geometry)));
        any = spu_or(any, known);
        spux_store_uint(p->mask + i, spux_vuint(UINT32_MAX));
        spux_store_uint(p->skip_prim + i, spux_select(none, spu_add(primitive, spux_vuint(base)), known));
    }
    p->skips_prims = spux_any(any);
    return spux_all(same);
}

/* Sets masks and skipped primitives of a packet's rays, where the arrays have them. */
static void ray_packet_select(const cgt_committed_scene *committed_scene, const ray_source *s, const ray_order *order,
                              uint32_t first, uint32_t count, packet *p)
{
    const cgt_primitives *prims = &committed_scene->prims;
    uint32_t common_mask = UINT32_MAX;
    p->skips_prims = p->has_masks = false;
    if (!s->rays->mask && !s->rays->skip_primitive)
        return;
    if (!s->rays->mask && s->stride == sizeof(uint32_t) && count % CGT_LANES == 0 &&
        ray_packet_skip_vectors(prims, s, order, first, count, p))
        return;
    p->skips_prims = false;
    for (uint32_t k = 0; k < count; k++) {
        const uint64_t i = ray_index(order, first + k);
        p->mask[k] = ray_read_mask(s, i);
        p->skip_prim[k] = ray_read_skip(prims, s, i);
        p->skips_prims |= p->skip_prim[k] != CGT_INVALID_ID;
        common_mask &= p->mask[k];
    }
    p->has_masks = committed_scene->has_masks && common_mask != UINT32_MAX;
    p->skips_prims |= p->has_masks;
}

/* A lane that takes no part repeats one that does, so that it widens no bound. */
static void ray_packet_disable_lane(packet *p, uint32_t k, uint32_t valid_lane)
{
    for (int a = 0; a < 3; a++) {
        p->org[a][k] = p->org[a][valid_lane];
        p->dir[a][k] = p->dir[a][valid_lane];
    }
    p->rdd[k] = p->rdd[valid_lane];
    p->t_min[k] = p->t_min[valid_lane];
    p->t_max[k] = p->t_max[valid_lane];
    p->low[k] = p->high[k] = -INFINITY;
    p->skip_prim[k] = CGT_INVALID_ID;
    p->mask[k] = 0;
}

/* Rays that miss the bounds of all primitives take no part. */
static void ray_packet_cull_outside(const cgt_committed_scene *committed_scene, const packet *p, uint32_t count,
                                    ray_state *state)
{
    for (uint32_t i = 0; i < count; i += CGT_LANES) {
        const unsigned missed = spux_mask_bits(ray_box_missed(p, i, committed_scene->low, committed_scene->high));
        for (uint32_t k = i; k < count && k < i + CGT_LANES; k++)
            if (state[k] == RAY_PLAIN && missed >> (k - i) & 1)
                state[k] = RAY_OFF;
    }
}

/* Finds the rays that take part, and makes the others repeat one of them. */
static void ray_packet_init_lanes(packet *p, uint32_t count, const ray_state *state)
{
    uint32_t valid_lane = 0;
    for (uint32_t k = 0; k < count; k++)
        if (state[k] <= RAY_UNUSUAL)
            valid_lane = k;
    p->rays = 0;
    p->common_origin = true;
    for (uint32_t k = 0; k < p->lanes; k++) {
        p->prim[k] = CGT_INVALID_ID;
        if (k < count && state[k] <= RAY_UNUSUAL)
            p->low[k] = p->high[k] = p->t_max[k], p->rays++;
        else
            ray_packet_disable_lane(p, k, valid_lane);
        for (int a = 0; a < 3; a++)
            p->common_origin &= p->org[a][k] == p->org[a][valid_lane];
    }
}

/* Reads rays first to first + count - 1 of the order. Returns false where one of several is unusual: read them
 * apart then. */
__attribute__((unused)) static bool ray_packet_init(const cgt_committed_scene *committed_scene, const ray_source *s,
                                                    const ray_order *order, uint32_t first, uint32_t count, packet *p,
                                                    cgt_counts *counts)
{
    const ray_limits limits = ray_packet_limits(committed_scene, s);
    ray_state state[PACKET_MAX_RAYS];
    uint32_t invalid = 0;
    p->lanes = (count + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    p->from_origin = false;
    p->to_light = s->light && s->light->kind == CGT_LIGHT_POINT;
    for (int a = 0; a < 3 && p->to_light; a++)
        p->light[a] = s->light->position[a];
    p->extreme = false;
    for (uint32_t k = 0; k < count; k++) {
        state[k] = ray_packet_read(s, ray_index(order, first + k), &limits, p, k);
        if (state[k] == RAY_UNUSUAL && count > 1)
            return false;
        p->extreme |= state[k] == RAY_UNUSUAL;
        invalid += state[k] == RAY_INVALID;
    }
    ray_packet_select(committed_scene, s, order, first, count, p);
    if (!p->extreme && !committed_scene->brute_force) {
        for (uint32_t k = count; k < p->lanes; k++)
            ray_packet_disable_lane(p, k, 0);
        ray_packet_cull_outside(committed_scene, p, count, state);
    }
    ray_packet_init_lanes(p, count, state);
    counts->invalid_rays += invalid;
    return true;
}

/* ---- hits ---- */

/* Rays first to first + count - 1 of the arrays with the primitives that they hit, ready for the values of the hits.
 * Rays without a hit may hold anything: harmless ones replace them. */
__attribute__((unused)) static void ray_packet_of_hits(const ray_source *s, uint64_t first, uint32_t count,
                                                       const uint32_t *prim, packet *p)
{
    p->rays = p->lanes = (count + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    p->common_origin = p->from_origin = p->to_light = p->any_hit = p->fast = p->extreme = false;
    p->skips_prims = p->has_masks = false;
    p->triangle_test = CGT_TRIANGLE_TEST_AUTO;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const uint32_t remaining = count - i;
        ray_lanes q;
        _Alignas(CGT_VECTOR_BYTES) uint32_t known[CGT_LANES];
        ray_lanes_load(s, first + i, remaining < CGT_LANES ? remaining : CGT_LANES, &q);
        for (uint32_t k = 0; k < CGT_LANES; k++)
            known[k] = k < remaining ? prim[i + k] : CGT_INVALID_ID;
        const vuint hit = spux_load_uint(known);
        const vmask none = spu_cmpeq(hit, spux_vuint(CGT_INVALID_ID));
        vfloat dd = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat d = spux_select(q.dir[a], spux_vfloat(1), none);
            spux_store(p->org[a] + i, spux_select(q.org[a], spux_vfloat(0), none));
            spux_store(p->dir[a] + i, d);
            dd = spu_add(dd, spu_mul(d, d));
        }
        spux_store(p->rdd + i, spux_div(spux_vfloat(1), dd));
        spux_store(p->t_min + i, spux_max(spux_select(q.t_min, spux_vfloat(0), none), spux_vfloat(-FLT_MAX)));
        spux_store(p->t_max + i, q.t_max);
        spux_store_uint(p->prim + i, hit);
    }
}

/* Stores a packet's hits in the caller's arrays. */
CGT_SPU_INLINE void ray_store_hits(const packet_hits *h, const ray_order *order, uint32_t first, uint32_t count,
                                   const cgt_hits *hits)
{
    const size_t stride = ray_stride(hits->stride),
                 vector_stride = ray_vector_stride(hits->vector_stride, hits->stride);
    for (uint32_t k = 0; k < count; k++) {
        const size_t i = (size_t)ray_index(order, first + k), offset = i * stride;
        if (hits->t)
            memcpy((char *)hits->t + offset, &h->t[k], sizeof(float));
        if (hits->primitive)
            memcpy((char *)hits->primitive + offset, &h->primitive[k], sizeof(uint32_t));
        if (hits->geometry)
            memcpy((char *)hits->geometry + offset, &h->geometry[k], sizeof(uint32_t));
        for (int a = 0; a < 3; a++)
            if (hits->normal[a])
                memcpy((char *)hits->normal[a] + i * vector_stride, &h->normal[a][k], sizeof(float));
        if (hits->u)
            memcpy((char *)hits->u + offset, &h->u[k], sizeof(float));
        if (hits->v)
            memcpy((char *)hits->v + offset, &h->v[k], sizeof(float));
    }
}

#endif
