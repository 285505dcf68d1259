/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Precision FAST: t, u, v and normals of the triangles that rays hit, in single precision, a vector at a time, after
 * Moeller and Trumbore (1997) with the terms that rays from one origin share taken out. As in fast_spheres.h the hit
 * was decided before, any build gives the same bits, and lanes that the bounds do not cover are left to
 * resolve_triangles.h.
 *
 * With s = v0 - org, e1 = v1 - v0, e2 = v2 - v0 and n = e1 x e2:
 * t = n.s / n.d, u = d.(e2 x s) / n.d, v = d.(s x e1) / n.d. Let u = 2^-24, |.| the 1-norm, E = |e1| |e2|, S and D the
 * largest components of s and d, F = 2 S max(|e1|, |e2|), R the largest component of a vertex seen from org. The errors
 * of
 *
 *   n        each component: of both products 2 u by the edges and 1 u, by their difference 1 u: as a vector, 4 u E
 *   n.d      4 u E D, by products and sums 3 u E D: 7 u E D
 *   n.s      the same by S, and by s itself: 8 u E S
 *   d.(e2 x s), d.(s x e1)   as n.d, of edge and s: 7 u F D
 *
 * |n.d| >= 2^-8 E D and |n.d| >= 2^-14 F D are required. Then, with the reciprocal and its product 2 u, and D |t| <= R,
 * since the hit lies in the triangle:
 *
 *   t        D t is within 15 u R E D / |n.d| + 2 u R: within 2^-12 R at most, 2^-17 R for a triangle of good shape
 *            seen at 45 degrees or steeper
 *   u, v     are within 7 u (F + E) D / |n.d| + 2 u: within 2^-7 at most, and in space the point that they tell within
 *            some u S, as for t
 *   normal   as a vector within 4 u E / |n|, and |n| >= |n.d| / (D sqrt(3)): within 2^-13, and 4 u by the root
 *
 * A share beyond 0 or 1, or a t beyond its range, is cut to it, which brings it nearer to the exact one. */
#ifndef CGT_FAST_TRIANGLES_H
#define CGT_FAST_TRIANGLES_H

#include <math.h>

#include "kernel/primitive/lane_vectors.h"
#include "kernel/resolve/resolve_triangles.h"

/* Where the bounds hold. The limits of sizes keep all terms far from the ends of float. */
#define FAST_TRIANGLE_SHAPE 0x1p-8f  /* |n.d| over E D, at least */
#define FAST_TRIANGLE_SHARE 0x1p-13f /* over S max(|e1|, |e2|) D */
#define FAST_TRIANGLE_MIN_EDGES 0x1p-50f
#define FAST_TRIANGLE_MAX_EDGES 0x1p60f
#define FAST_TRIANGLE_MAX_DISTANCE 0x1p40f
#define FAST_TRIANGLE_MAX_SIDES 0x1p80f
#define FAST_TRIANGLE_MIN_D 0x1p-20f
#define FAST_TRIANGLE_MAX_D 0x1p20f

/* What rays from one origin to a triangle share. */
typedef struct fast_triangle {
    vfloat n[3], num;
    vfloat unit[3], limit; /* the normal; |n.d| over D must not be below the limit, NaN where nothing is covered */
    vfloat side[2][3];     /* e2 x s, s x e1 */
} fast_triangle;

CGT_SPU_INLINE vfloat fast_largest(const vfloat v[3])
{
    return spux_max(spux_abs(v[0]), spux_max(spux_abs(v[1]), spux_abs(v[2])));
}

CGT_SPU_INLINE vfloat fast_sum(const vfloat v[3])
{
    return spu_add(spu_add(spux_abs(v[0]), spux_abs(v[1])), spux_abs(v[2]));
}

CGT_SPU_INLINE fast_triangle fast_triangle_prepare(const vfloat org[3], const vfloat vertex[3][3])
{
    fast_triangle q;
    vfloat s[3], e1[3], e2[3];
    for (int a = 0; a < 3; a++) {
        s[a] = spu_sub(vertex[0][a], org[a]);
        e1[a] = spu_sub(vertex[1][a], vertex[0][a]);
        e2[a] = spu_sub(vertex[2][a], vertex[0][a]);
    }
    lane_cross_unfused(e1, e2, q.n);
    lane_cross_unfused(e2, s, q.side[0]);
    lane_cross_unfused(s, e1, q.side[1]);
    q.num = lane_dot_unfused(q.n, s);
    const vfloat k = spux_div(spux_vfloat(1), spux_sqrt(lane_dot_unfused(q.n, q.n)));
    for (int a = 0; a < 3; a++)
        q.unit[a] = spu_mul(q.n[a], k);
    const vfloat sum1 = fast_sum(e1), sum2 = fast_sum(e2), distance = fast_largest(s);
    const vfloat edges = spu_mul(sum1, sum2), sides = spu_mul(distance, spux_max(sum1, sum2));
    const vmask edges_fit = spu_and(spu_cmpgt(edges, spux_vfloat(FAST_TRIANGLE_MIN_EDGES)),
                                    spu_cmpgt(spux_vfloat(FAST_TRIANGLE_MAX_EDGES), edges));
    const vmask sides_fit = spu_and(spu_cmpgt(spux_vfloat(FAST_TRIANGLE_MAX_DISTANCE), distance),
                                    spu_cmpgt(spux_vfloat(FAST_TRIANGLE_MAX_SIDES), sides));
    const vfloat limit =
        spux_max(spu_mul(edges, spux_vfloat(FAST_TRIANGLE_SHAPE)), spu_mul(sides, spux_vfloat(FAST_TRIANGLE_SHARE)));
    q.limit = spux_select(spux_vfloat(NAN), limit, spu_and(edges_fit, sides_fit));
    return q;
}

/* As records of floats: normal, num, unit normal and limit in one, the sides in a second one, right behind it, if u and
 * v are asked for. */
#define FAST_RECORD 8u

/* Stores a vector of them, each `stride` floats after the one before. */
CGT_SPU_INLINE void fast_triangle_store(const fast_triangle *q, uint32_t fields, float *to, size_t stride)
{
    spux_store_records4(to, stride, (const vfloat[4]){q->n[0], q->n[1], q->n[2], q->num});
    spux_store_records4(to + 4, stride, (const vfloat[4]){q->unit[0], q->unit[1], q->unit[2], q->limit});
    if (fields & CGT_FIELD_UV) {
        const vfloat *u = q->side[0], *v = q->side[1];
        spux_store_records4(to + FAST_RECORD, stride, (const vfloat[4]){u[0], u[1], u[2], v[0]});
        spux_store_records4(to + FAST_RECORD + 4, stride, (const vfloat[4]){v[1], v[2], v[2], v[2]});
    }
}

CGT_SPU_INLINE void fast_record_load(const float *record, const uint32_t *offset, vfloat d[8])
{
    if (offset)
        spux_load_records8_at(record, offset, d);
    else
        for (uint32_t k = 0; k < 8; k++)
            d[k] = spux_vfloat(record[k]);
}

/* Loads one in each lane: that at offset[k] from `record`, or `record` itself in all lanes if offset is NULL. */
CGT_SPU_INLINE fast_triangle fast_triangle_load(const float *record, const uint32_t *offset, uint32_t fields)
{
    vfloat d[8];
    fast_record_load(record, offset, d);
    fast_triangle q = {{d[0], d[1], d[2]}, d[3], {d[4], d[5], d[6]}, d[7], {{d[0], d[0], d[0]}, {d[0], d[0], d[0]}}};
    if (fields & CGT_FIELD_UV) {
        fast_record_load(record + FAST_RECORD, offset, d);
        for (int k = 0; k < 6; k++)
            q.side[k / 3][k % 3] = d[k];
    }
    return q;
}

CGT_SPU_INLINE vfloat fast_clamp(vfloat x, vfloat low, vfloat high)
{
    const vfloat above = spux_select(low, x, spu_cmpgt(x, low));
    return spux_select(high, above, spu_cmpgt(high, above));
}

/* The fields of rays that hit the triangles, t in [t_min, t_max]. Returns the lanes that the bounds cover. */
CGT_SPU_INLINE vmask fast_triangle_resolve(const fast_triangle *q, const vfloat dir[3], vfloat t_min, vfloat t_max,
                                           uint32_t fields, resolved_triangles *to)
{
    const vfloat den = lane_dot_unfused(q->n, dir), r = spux_div(spux_vfloat(1), den), size = fast_largest(dir);
    const vfloat zero = spux_vfloat(0), one = spux_vfloat(1);
    to->t = fast_clamp(spu_mul(q->num, r), t_min, t_max);
    if (fields & CGT_FIELD_UV) {
        to->u = fast_clamp(spu_mul(lane_dot_unfused(q->side[0], dir), r), zero, one);
        to->v = fast_clamp(spu_mul(lane_dot_unfused(q->side[1], dir), r), zero, one);
    }
    for (int a = 0; fields & CGT_FIELD_NORMAL && a < 3; a++)
        to->normal[a] = q->unit[a];
    const vmask in_range =
        spu_and(spu_cmpgt(size, spux_vfloat(FAST_TRIANGLE_MIN_D)), spu_cmpgt(spux_vfloat(FAST_TRIANGLE_MAX_D), size));
    return spu_and(spux_cmpge(spux_abs(den), spu_mul(q->limit, size)), in_range);
}

#endif
