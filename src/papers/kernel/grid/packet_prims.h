/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Primitives of a grid against a packet: a list of them is fetched a vector at a time, culled against the packet's
 * frustum, and what is left is tested against the rays. */
#ifndef CGT_PACKET_PRIMS_H
#define CGT_PACKET_PRIMS_H

#include "papers/kernel/packet/frustum.h"
#include "papers/kernel/packet/sphere_filter.h"
#include "papers/kernel/packet/triangle_fast.h"

#define PACKET_MAX_PRIMS 144u /* references of a packet's list in a grid */

typedef struct packet_prims {
    const cgt_committed_scene *committed_scene;
    packet *p;
    cgt_counts *counts;
    frustum_space space;
    frustum frustum;
    filter_packet filter;
    block_cones blocks;
    float w_far; /* hits beyond count for no ray */
    cgt_cull cull;
} packet_prims;

/* ---- culling ---- */

/* Points of a vector in grid space, along the frustum's axes: w along the rays, then u and v. */
typedef struct frustum_points {
    vfloat w, uv[2];
} frustum_points;

CGT_SPU_INLINE frustum_points frustum_coordinates(const packet_prims *v, const float p[3][CGT_LANES])
{
    const frustum *f = &v->frustum;
    return (frustum_points){grid_coordinates(&v->space, f->w, f->reverse, spux_load(p[f->w])),
                            {grid_coordinates(&v->space, f->u, false, spux_load(p[f->u])),
                             grid_coordinates(&v->space, f->v, false, spux_load(p[f->v]))}};
}

/* How far inside bound k of the frustum points are, in cells; the errors of both are in `error` of the callers. */
CGT_SPU_INLINE vfloat frustum_bound_distance(const packet_prims *v, const frustum_points *p, int k)
{
    const frustum *f = &v->frustum;
    const vfloat along = spu_sub(p->w, spux_vfloat(f->w0));
    const vfloat x = k & 1 ? spu_xor(p->uv[k >> 1], spux_vfloat(-0.f)) : p->uv[k >> 1];
    return spu_sub(x, spu_madd(spux_vfloat(f->step[k]), along, spux_vfloat(f->bound[k])));
}

/* Returns the lanes whose sphere lies outside the frustum, or before or beyond the ranges of its rays. */
static unsigned spheres_outside(const packet_prims *v, const filter_spheres *s)
{
    const frustum *f = &v->frustum;
    const vfloat r = spux_load(s->radius), error = spux_vfloat(f->plane_error);
    const frustum_points p = frustum_coordinates(v, (const float(*)[CGT_LANES])s->center);
    const vfloat reach = spu_madd(r, spux_vfloat(v->space.rcell[f->w] * (1 + FRUSTUM_RADIUS)), error);
    vmask outside = spu_or(spu_cmpgt(spu_sub(p.w, reach), spux_vfloat(v->w_far)),
                           spu_cmpgt(spux_vfloat(f->w_near), spu_add(p.w, reach)));
    for (int k = 0; k < 4; k++) {
        const vfloat most = spu_madd(r, spux_vfloat(f->radius_scale[k]), error);
        outside = spu_or(outside, spu_cmpgt(spux_vfloat(0), spu_add(frustum_bound_distance(v, &p, k), most)));
    }
    return spux_mask_bits(outside);
}

/* Lanes whose triangle has all three vertices outside the same bound of the frustum, or before or beyond. */
static unsigned triangles_outside(const packet_prims *v, const filter_triangles *s)
{
    const frustum *f = &v->frustum;
    const vfloat error = spux_vfloat(f->plane_error);
    vfloat near, far, inside[4];
    for (int i = 0; i < 3; i++) {
        const frustum_points p = frustum_coordinates(v, (const float(*)[CGT_LANES])s->vertex[i]);
        near = i ? spux_min(near, p.w) : p.w;
        far = i ? spux_max(far, p.w) : p.w;
        for (int k = 0; k < 4; k++) {
            const vfloat d = frustum_bound_distance(v, &p, k);
            inside[k] = i ? spux_max(inside[k], d) : d;
        }
    }
    vmask outside = spu_or(spu_cmpgt(spu_sub(near, error), spux_vfloat(v->w_far)),
                           spu_cmpgt(spux_vfloat(f->w_near), spu_add(far, error)));
    for (int k = 0; k < 4; k++)
        outside = spu_or(outside, spu_cmpgt(spux_vfloat(0), spu_add(inside[k], error)));
    return spux_mask_bits(outside);
}

/* ---- testing ---- */

static void test_spheres(packet_prims *v, filter_spheres *s, unsigned lanes)
{
    filter_spheres_bound(&v->filter, s);
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        v->counts->packet_tests++;
#define CALL(mode) filter_test_sphere(&v->committed_scene->prims, v->p, s, k, &v->blocks, mode, v->counts)
        FILTER_FOR_MODE(v->p, false, CALL)
#undef CALL
    }
}

static void test_triangles(packet_prims *v, filter_triangles *s, unsigned lanes)
{
    if (v->p->fast)
        filter_triangles_prepare_fast(&v->filter, s);
    else
        filter_triangles_bound(&v->filter, s);
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        v->counts->packet_tests++;
#define CALL(mode) filter_test_triangle(&v->committed_scene->prims, v->p, &v->filter, s, k, &v->blocks, mode, v->counts)
        FILTER_FOR_MODE(v->p, true, CALL)
#undef CALL
    }
}

/* Counts what culling left, and returns it. */
static unsigned count_culled(packet_prims *v, unsigned lanes, unsigned outside, uint32_t count)
{
    lanes &= ~outside;
    v->counts->cull_tests += count;
    v->counts->culled += count - spux_count_bits(lanes);
    return lanes;
}

static void packet_test_spheres(packet_prims *v, const uint32_t *reference, uint32_t length)
{
    filter_spheres s;
    for (uint32_t i = 0; i < length; i += CGT_LANES) {
        const uint32_t count = length - i < CGT_LANES ? length - i : CGT_LANES;
        unsigned lanes = CGT_ALL_LANES >> (CGT_LANES - count);
        filter_gather_spheres(&v->committed_scene->prims, reference + i, count, CGT_LANES, &s);
        if (v->cull != CGT_CULL_NONE)
            lanes = count_culled(v, lanes, spheres_outside(v, &s), count);
        if (lanes)
            test_spheres(v, &s, lanes);
    }
}

static void packet_test_triangles(packet_prims *v, const uint32_t *reference, uint32_t length)
{
    filter_triangles s;
    for (uint32_t i = 0; i < length; i += CGT_LANES) {
        const uint32_t count = length - i < CGT_LANES ? length - i : CGT_LANES;
        unsigned lanes = CGT_ALL_LANES >> (CGT_LANES - count);
        filter_gather_triangles(&v->committed_scene->prims, reference + i, count, CGT_LANES, &s);
        if (v->cull != CGT_CULL_NONE)
            lanes = count_culled(v, lanes, triangles_outside(v, &s), count);
        if (lanes)
            test_triangles(v, &s, lanes);
    }
}

/* Moves spheres to the front and triangles to a separate list; for scenes of both kinds. */
static void packet_test_mixed(packet_prims *v, uint32_t *reference, uint32_t length)
{
    uint32_t triangle[PACKET_MAX_PRIMS], spheres = 0, triangles = 0;
    for (uint32_t i = 0; i < length; i++) {
        const uint32_t prim = reference[i];
        const bool sphere = cgt_primitives_array(&v->committed_scene->prims, prim)->kind == CGT_KIND_SPHERES;
        reference[spheres] = prim;
        triangle[triangles] = prim;
        spheres += sphere;
        triangles += !sphere;
    }
    packet_test_spheres(v, reference, spheres);
    packet_test_triangles(v, triangle, triangles);
}

/* Tests a list of at most PACKET_MAX_PRIMS; reorders it. */
static void packet_test_prims(packet_prims *v, uint32_t *reference, uint32_t length)
{
    if (!v->committed_scene->prims.triangles)
        packet_test_spheres(v, reference, length);
    else if (!v->committed_scene->prims.spheres)
        packet_test_triangles(v, reference, length);
    else
        packet_test_mixed(v, reference, length);
}

/* Returns the coordinate w beyond which a hit counts for no ray: by blocks where rays share an origin and start
 * there. */
CGT_SPU_INLINE float packet_max_w(const packet_prims *v)
{
    const packet *p = v->p;
    vfloat most = spux_vfloat(-INFINITY);
    if (!p->from_origin)
        return frustum_max_w(&v->space, &v->frustum, p);
    for (uint32_t i = 0; i < v->blocks.blocks; i += CGT_LANES)
        most = spux_max(spu_mul(spux_load(v->blocks.far_t + i), spux_load(v->blocks.speed + i)), most);
    return frustum_max_w_from_origin(&v->space, &v->frustum, p, spux_hmax(most));
}

/* Sets what tests need of a packet that has a frustum. */
CGT_SPU_INLINE void packet_prims_init(packet_prims *v)
{
    packet *p = v->p;
    filter_packet_init(p, v->committed_scene->scale, &v->filter);
    if (v->committed_scene->prims.triangles && !p->common_origin)
        filter_moments_init(p, &v->filter);
    block_cones_init(p, v->cull == CGT_CULL_BLOCKS, v->frustum.w, v->space.rcell[v->frustum.w], &v->blocks);
    v->w_far = packet_max_w(v);
}

#endif
