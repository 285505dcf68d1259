/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What single precision leaves undecided about triangles, a vector of tests at a time in double: many rays against one
 * triangle, or one ray against many. Rays that run along a mesh, or meet faces that lie on each other, leave all their
 * tests undecided; one by one each would take as long as a vector of them. The arithmetic is that of triangle_double.h
 * in its order, so what is certain here is what decide.h would find, and all else is left to it.
 *
 * Three things are exact without any bound. They hold by comparisons of the given floats alone:
 *   a ray that does not move along an axis, and a triangle all of whose vertices have one coordinate along it: the ray
 *   is parallel to the triangle's plane, and misses it
 *   two triangles whose six vertices have one coordinate along an axis, or that have the same three vertices: they lie
 *   in one plane, so that the lower number wins wherever both are hit
 * They are cgt_triangle_is_parallel and cgt_triangles_share_plane; bounds are derived in triangle_double.h, too. */
#ifndef CGT_DECIDE_LANES_H
#define CGT_DECIDE_LANES_H

#include "kernel/primitive/filter.h"
#include "kernel/primitive/gather_primitives.h"

/* Fewer lanes are decided one by one. */
#define DECIDE_MIN_LANES 3u

typedef struct decide_triangles {
    _Alignas(CGT_VECTOR_BYTES) float v[3][3][CGT_LANES]; /* as cgt_triangle */
} decide_triangles;

/* The tests of the lanes. Those that are not asked for have any finite numbers. */
typedef struct decide_tests {
    bool any_hit;   /* t is of no interest */
    unsigned lanes; /* that are asked for, as bits, and so are the others below */
    _Alignas(CGT_VECTOR_BYTES) float org[3][CGT_LANES];
    float dir[3][CGT_LANES], t_min[CGT_LANES], t_max[CGT_LANES]; /* as the caller described the rays */
    decide_triangles triangle, best; /* best: the closest hits so far, in the lanes of has_rival */
    unsigned is_free, has_rival;     /* whose rays have hit nothing; that have hit a triangle */
    unsigned is_first;               /* where the triangle has the lower number */
} decide_tests;

/* Lanes as bits: the triangle certainly is the closest hit; it certainly is not; it took double to tell. t: of the
 * first, rounded. */
typedef struct decide_results {
    unsigned hit, missed, in_double;
    _Alignas(CGT_VECTOR_BYTES) float t[CGT_LANES];
} decide_results;

void CGT_KERNEL(cgt_decide_lanes)(const decide_tests *q, decide_results *r);

/* Sets the ray of lane k. */
CGT_SPU_INLINE void decide_set_ray(decide_tests *q, uint32_t k, const cgt_ray *ray)
{
    for (int a = 0; a < 3; a++) {
        q->org[a][k] = ray->line.org[a];
        q->dir[a][k] = ray->line.dir[a];
    }
    q->t_min[k] = ray->t_min;
    q->t_max[k] = ray->t_max;
}

/* Sets one triangle in all lanes. Returns false for another kind. */
CGT_SPU_INLINE bool decide_set_triangle(const cgt_primitives *prims, uint32_t prim, decide_triangles *to)
{
    const cgt_primitive p = cgt_primitives_get(prims, prim);
    if (p.kind != CGT_KIND_TRIANGLES)
        return false;
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            spux_store(to->v[k][a], spux_vfloat(p.triangle.v[k][a]));
    return true;
}

/* Sets the triangles of all lanes. */
CGT_SPU_INLINE void decide_gather_triangles(const cgt_primitives *prims, const uint32_t prim[CGT_LANES],
                                            decide_triangles *to)
{
    vfloat v[3][3];
    gather_scene_triangles(prims, prim, v);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            spux_store(to->v[k][a], v[k][a]);
}

/* Lanes whose rays do not move along an axis across which their triangles have no extent; still: rays, by axis. */
CGT_SPU_INLINE unsigned decide_find_parallel(const decide_triangles *triangle, const unsigned still[3])
{
    unsigned parallel = 0;
    for (int a = 0; a < 3; a++) {
        const vfloat first = spux_load(triangle->v[0][a]);
        const vmask flat =
            spu_and(spu_cmpeq(first, spux_load(triangle->v[1][a])), spu_cmpeq(first, spux_load(triangle->v[2][a])));
        parallel |= spux_mask_bits(flat) & still[a];
    }
    return parallel;
}

/* Spheres of a scene without triangles. Returns `lanes` without those where prim is a copy of the closest hit so far,
 * best, and has the higher number; best may be CGT_INVALID_ID. */
unsigned CGT_KERNEL(cgt_decide_copies)(const cgt_primitives *prims, vuint best, vuint prim, unsigned lanes);

/* One ray against the primitives of `lanes`. Returns the lanes that are left to decide: any hit: one of those that are
 * hit, if any; nearest: without those that do not beat `best`. */
unsigned CGT_KERNEL(cgt_decide_ray)(const cgt_primitives *prims, const cgt_ray *ray, uint32_t best, bool any_hit,
                                    const uint32_t prim[CGT_LANES], unsigned lanes, cgt_counts *counts);

#endif
