/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Primitives of a leaf against a packet of rays to one light (light_packet.h). Lanes are rays; what does not depend on
 * the ray is computed once for all primitives of the leaf. Single precision with derived bounds: u = 2^-24, |x| is the
 * largest component and [x] the 1-norm; P(p, q, r) of triangle_filter.h is at most |p| [q] [r] in any order.
 *
 * Triangles. As in lane_tests.h, s is a ray's origin seen from the first vertex, e_1 and e_2 the edges from there, d
 * its direction, all times the scene's scale, and
 *   U = s.(d x e_2)   V = d.(s x e_1)   D = e_1.(d x e_2)   T = e_2.(s x e_1)   W = D - U - V   t = T / D
 * Point light at L: s = G - d - q, where G leads from the first vertex to L, and q is the rounding error of d, at most
 * u |d| along each axis. Products with d twice are 0, so with x = d
 *   U = x.(e_2 x G)   V = x.(G x e_1)   D = x.(e_2 x e_1)   T = D - G.(e_2 x e_1)
 * U and V are within 9 u |x| [G] [e] of that, counted as there, and q adds u |x| [x] [e]. W is within the errors of all
 * three plus 2 u of their sizes. T is within 10 u of D's part and 8 u of G's part, plus u for the difference and u for
 * q: 12 u (|x| + [G]) [e_1] [e_2].
 * Parallel rays: d is common, x is the ray's origin seen from the packet's, H the packet's seen from the first vertex:
 *   U = (x + H).(d x e_2)   V = (x + H).(e_1 x d)   T = (x + H).(e_1 x e_2)   D the same for all
 * U and V are within 9 u |d| ([x] + [H]) [e], T within 12 u (|x| + [H]) [e_1] [e_2].
 * Underflow is below 2^-124, and may be multiplied by |x|, by [G] or by both: 2^-118 (1 + |x|) (1 + [G]). Comparisons
 * with infinities and NaN are false, so such rays are undecided.
 *
 * Spheres. Let c be the centre seen from the ray's origin, A = d.d, B = d.c and C = c.c - r^2. The ray has a root if
 * B^2 - A C >= 0. C is within 7 u (c.c + r^2), B within 4 u |d||c|, so B^2 - A C is within 26 u A (c.c + r^2). From
 * outside, C > 0, no root lies ahead if B < 0. B is certainly not 0 if B^2 exceeds 2 u times the bound of B^2 - A C,
 * which is more than the square of its own error. With ranges [0, 1] or [0, infinity) and a light outside the sphere,
 * this suffices: from inside, C < 0, there is one root ahead; from outside there are two if B > 0, and they are
 * before the light if B < A (the middle of the roots is certainly there if B / A < 1 - 16 u and c.c < 4 A). With a
 * light inside the sphere, and with it the ends of all rays, one root of a ray from outside is before the light.
 * Other spheres and uncertain rays go to the test of lane_tests.h. Squares lose 2^-124 to underflow: 2^-97 is added
 * to r^2 in bounds, and 2^-118 where A is a factor. B^2 and A C may overflow, to an infinite difference of either
 * sign. Where those of any primitive of the scene may, infinity is added to r^2 in bounds: no comparison holds, and
 * the rays are undecided. */
#ifndef CGT_LIGHT_LEAF_H
#define CGT_LIGHT_LEAF_H

#include "kernel/light/light_packet.h"
#include "kernel/primitive/decide_lanes.h"
#include "kernel/primitive/lane_tests.h"
#include "kernel/primitive/primitive_block.h"

#define LIGHT_EPS_NUM (12 * FILTER_ROUNDOFF * (1 + 0x1p-7f))
#define LIGHT_EPS_ROUNDING (1.125f * FILTER_ROUNDOFF) /* q */
#define LIGHT_DEPTH_FACTOR (1 + 0x1p-10f)             /* covers second order terms where t is compared with a range */
#define LIGHT_EPS_DISC (26 * FILTER_ROUNDOFF)
#define LIGHT_EPS_INNER (8 * FILTER_ROUNDOFF)
#define LIGHT_MIDDLE_FACTOR (1 - 16 * FILTER_ROUNDOFF)

/* ---- hits ---- */

/* Lanes whose triangles have no extent along an axis of `still`, as bits: rays that do not move along it are parallel
 * to them (cgt_triangle_is_parallel). */
CGT_SPU_INLINE unsigned light_find_flat(vfloat vertex[3][3], uint32_t still)
{
    unsigned flat = 0;
    for (int a = 0; a < 3; a++)
        if (still >> a & 1)
            flat |=
                spux_mask_bits(spu_and(spu_cmpeq(vertex[0][a], vertex[1][a]), spu_cmpeq(vertex[0][a], vertex[2][a])));
    return flat;
}

/* Decides a triangle for several rays of a vector at once. Returns the lanes that are left to decide. */
__attribute__((noinline, unused)) static unsigned light_decide_lanes(const cgt_primitives *prims, packet *p, uint32_t i,
                                                                     uint32_t prim, unsigned lanes, cgt_counts *counts)
{
    decide_tests q;
    decide_results r;
    lanes &= spux_mask_bits(spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY)));
    q.lanes = lanes;
    q.any_hit = true;
    q.is_free = CGT_ALL_LANES;
    q.has_rival = 0;
    if (!decide_set_triangle(prims, prim, &q.triangle))
        return lanes;
    for (int a = 0; a < 3; a++) {
        spux_store(q.org[a], spux_load(p->org[a] + i));
        spux_store(q.dir[a], spux_load(p->dir[a] + i));
    }
    spux_store(q.t_min, spux_load(p->t_min + i));
    spux_store(q.t_max, spux_load(p->t_max + i));
    CGT_KERNEL(cgt_decide_lanes)(&q, &r);
    const vmask hit = spux_mask_from_bits(r.hit & lanes);
    spux_store_uint(p->prim + i, spux_select(spux_load_uint(p->prim + i), spux_vuint(prim), hit));
    spux_store(p->high + i, spux_select(spux_load(p->high + i), spux_vfloat(-INFINITY), hit));
    counts->double_tests += spux_count_bits(lanes & (r.hit | r.missed) & r.in_double);
    return lanes & ~(r.hit | r.missed);
}

/* Stores the certain hits of a vector of rays, and decides the undecided ones. */
CGT_SPU_INLINE void light_store_hits(const cgt_primitives *prims, light_packet *l, uint32_t i, uint32_t prim,
                                     vmask certain_hit, vmask undecided, cgt_counts *counts)
{
    packet *p = &l->rays;
    const vfloat high = spux_load(p->high + i), closed = spux_vfloat(-INFINITY);
    certain_hit = spu_and(certain_hit, spu_cmpgt(high, closed));
    if (p->skips_prims) {
        const vmask skipping = rays_skipping_one(prims, p, i, prim);
        certain_hit = spu_andc(certain_hit, skipping);
        undecided = spu_andc(undecided, skipping);
    }
    spux_store_uint(p->prim + i, spux_select(spux_load_uint(p->prim + i), spux_vuint(prim), certain_hit));
    spux_store(p->high + i, spux_select(high, closed, certain_hit));
    unsigned remaining = spux_mask_bits(undecided);
    if (__builtin_expect(spux_count_bits(remaining) >= DECIDE_MIN_LANES, 0))
        remaining = light_decide_lanes(prims, p, i, prim, remaining, counts);
    for (; remaining; remaining &= remaining - 1)
        filter_decide(prims, p, i + (uint32_t)__builtin_ctz(remaining), prim, counts);
    if (spux_none(spu_cmpgt(spux_load(p->high + i), closed)))
        l->undecided &= ~((uint64_t)1 << i / CGT_LANES);
}

/* ---- triangles ---- */

typedef struct light_triangles {
    _Alignas(CGT_VECTOR_BYTES) float u[3][CGT_LANES]; /* factors of x in U, V and T, or D */
    float v[3][CGT_LANES];
    float n[3][CGT_LANES];
    float offset_u[CGT_LANES], offset_v[CGT_LANES]; /* added to U and V; parallel rays only */
    float offset_n[CGT_LANES];                      /* added to T */
    float den[CGT_LANES];                           /* D of parallel rays */
    float side[CGT_LANES], den_error[CGT_LANES], num_error[CGT_LANES];
    float error_t_min[CGT_LANES], error_t_max[CGT_LANES]; /* errors of T - t D at t = 0 and 1 */
} light_triangles;

CGT_SPU_INLINE void light_init_triangles(const light_packet *l, const triangle_block *leaf, float scale, bool is_point,
                                         light_triangles *q)
{
    vfloat e[2][3], g[3], d[3], u[3], v[3], n[3];
    const vfloat zero = spux_vfloat(0);
    float max_component = is_point ? l->max_component : 0;
    for (int a = 0; a < 3; a++) {
        e[0][a] = spux_load(leaf->edge[0][a]);
        e[1][a] = spux_load(leaf->edge[1][a]);
        g[a] = spu_sub(spux_vfloat(l->origin[a] * scale), spux_load(leaf->vertex[a]));
        d[a] = is_point ? zero : spux_vfloat(l->rays.dir[a][0] * scale);
        if (!is_point)
            max_component = light_max(max_component, fabsf(l->rays.dir[a][0] * scale));
    }
    const vfloat max_offset = spu_add(lane_sum(g), spux_vfloat(is_point ? 0 : l->max_sum));
    if (is_point) {
        lane_cross(e[1], g, u);
        lane_cross(g, e[0], v);
        lane_cross(e[1], e[0], n);
    } else {
        lane_cross(d, e[1], u);
        lane_cross(e[0], d, v);
        lane_cross(e[0], e[1], n);
        spux_store(q->den, lane_dot(e[0], u));
        spux_store(q->offset_u, lane_dot(g, u));
        spux_store(q->offset_v, lane_dot(g, v));
    }
    spux_store(q->offset_n, spu_xor(lane_dot(g, n), spux_vfloat(is_point ? -0.f : 0.f)));
    for (int a = 0; a < 3; a++) {
        spux_store(q->u[a], u[a]);
        spux_store(q->v[a], v[a]);
        spux_store(q->n[a], n[a]);
    }
    const vfloat sum0 = spux_load(leaf->sum[0]), sum1 = spux_load(leaf->sum[1]);
    const vfloat product = spu_mul(sum0, sum1), max_x = spux_vfloat(max_component);
    const vfloat underflow = spu_mul(spu_madd(max_offset, spux_vfloat(0x1p-118f), spux_vfloat(0x1p-118f)),
                                     spux_vfloat(1 + light_max(max_component, l->max_component)));
    const vfloat rounding = spux_vfloat(is_point ? LIGHT_EPS_ROUNDING * l->max_sum : 0);
    const vfloat edges = spu_mul(spu_add(sum0, sum1), spu_madd(max_offset, spux_vfloat(LANE_EPS_W), rounding));
    spux_store(q->side, spu_madd(max_x, spu_madd(product, spux_vfloat(LANE_EPS_W), edges), underflow));
    const vfloat den_error = spu_madd(spu_mul(max_x, product), spux_vfloat(LANE_EPS_PLANE), underflow);
    const vfloat num_error = spu_madd(spu_mul(product, spux_vfloat(LIGHT_EPS_NUM)),
                                      spu_add(max_offset, spux_vfloat(l->max_component)), underflow);
    spux_store(q->den_error, den_error);
    spux_store(q->num_error, num_error);
    spux_store(q->error_t_min, spu_mul(num_error, spux_vfloat(LIGHT_DEPTH_FACTOR)));
    spux_store(q->error_t_max, spu_mul(spu_add(den_error, num_error), spux_vfloat(LIGHT_DEPTH_FACTOR)));
}

CGT_SPU_INLINE vfloat light_dot(const vfloat x[3], const float n[3][CGT_LANES], uint32_t k)
{
    return spu_madd(x[0], spux_vfloat(n[0][k]),
                    spu_madd(x[1], spux_vfloat(n[1][k]), spu_mul(x[2], spux_vfloat(n[2][k]))));
}

typedef struct light_sides {
    vfloat lower, upper;        /* the least and the largest of U, V and W */
    vfloat den, num;            /* |D|, and T with D's sign */
    vmask outside, den_certain; /* the line passes outside of an edge; the sign of D is certain */
} light_sides;

CGT_SPU_INLINE void light_compute_sides(const light_packet *l, const light_triangles *q, uint32_t k, uint32_t i,
                                        bool is_point, light_sides *f)
{
    vfloat x[3];
    for (int a = 0; a < 3; a++)
        x[a] = spux_load(l->ray_terms[a] + i);
    vfloat u = light_dot(x, q->u, k), v = light_dot(x, q->v, k);
    if (!is_point) {
        u = spu_add(u, spux_vfloat(q->offset_u[k]));
        v = spu_add(v, spux_vfloat(q->offset_v[k]));
    }
    const vfloat along = light_dot(x, q->n, k), den = is_point ? along : spux_vfloat(q->den[k]);
    const vfloat w = spu_sub(spu_sub(den, u), v), sign = spu_and(den, spux_vfloat(-0.f));
    f->lower = spux_min(u, spux_min(v, w));
    f->upper = spux_max(u, spux_max(v, w));
    f->den = spu_xor(den, sign);
    f->num = spu_xor(spu_add(along, spux_vfloat(q->offset_n[k])), sign);
    f->outside = spu_and(spu_cmpgt(f->upper, spux_vfloat(q->side[k])), spu_cmpgt(spux_vfloat(-q->side[k]), f->lower));
    f->den_certain = spu_cmpgt(f->den, spux_vfloat(q->den_error[k]));
}

/* Whether any ray of a vector may pass inside all edges of a triangle that is not certainly behind it. The surface that
 * a ray leaves towards the light mostly is. */
CGT_SPU_INLINE bool light_triangle_may_hit(const light_packet *l, const light_triangles *q, uint32_t k, uint32_t i,
                                           bool is_point)
{
    light_sides f;
    light_compute_sides(l, q, k, i, is_point, &f);
    return !spux_all(spu_or(f.outside, spu_and(f.den_certain, spu_cmpgt(spux_vfloat(-q->error_t_min[k]), f.num))));
}

/* Rays whose t is certainly outside their range, and certainly inside, if the sign of den is certain. */
typedef struct light_range_test {
    vmask out, in;
} light_range_test;

CGT_SPU_INLINE light_range_test light_test_ranges(const packet *p, const light_triangles *q, uint32_t k, uint32_t i,
                                                  vfloat den, vfloat num)
{
    const vfloat t_min = spux_load(p->t_min + i), t_max = spux_load(p->t_max + i);
    const vfloat den_error = spux_vfloat(q->den_error[k]), num_error = spux_vfloat(q->num_error[k]);
    const vfloat enlarge = spux_vfloat(LIGHT_DEPTH_FACTOR), infinity = spux_vfloat(INFINITY);
    const vfloat error_t_min = spu_mul(spu_madd(t_min, den_error, num_error), enlarge);
    const vfloat error_t_max = spu_mul(spu_madd(t_max, den_error, num_error), enlarge);
    const vmask before = spu_or(spu_cmpeq(t_max, infinity), spu_cmpgt(spu_msub(t_max, den, num), error_t_max));
    return (light_range_test){.out = spu_or(spu_cmpgt(spu_msub(t_min, den, error_t_min), num),
                                            spu_cmpgt(num, spu_madd(t_max, den, error_t_max))),
                              .in = spu_and(spu_cmpgt(spu_nmsub(t_min, den, num), error_t_min), before)};
}

/* The same for ranges [0, 1], or [0, infinity] for parallel rays. */
CGT_SPU_INLINE light_range_test light_test_default_range(const light_triangles *q, uint32_t k, vfloat den, vfloat num,
                                                         bool is_point)
{
    const vfloat error_t_min = spux_vfloat(q->error_t_min[k]), error_t_max = spux_vfloat(q->error_t_max[k]);
    light_range_test d = {.out = spu_cmpgt(spux_vfloat(-q->error_t_min[k]), num), .in = spu_cmpgt(num, error_t_min)};
    if (is_point) {
        d.out = spu_or(d.out, spu_cmpgt(num, spu_add(den, error_t_max)));
        d.in = spu_and(d.in, spu_cmpgt(spu_sub(den, num), error_t_max));
    }
    return d;
}

CGT_SPU_INLINE void light_test_triangle(const cgt_primitives *prims, light_packet *l, const light_triangles *q,
                                        uint32_t k, uint32_t i, uint32_t prim, bool is_point, cgt_counts *counts)
{
    const packet *p = &l->rays;
    light_sides f;
    light_compute_sides(l, q, k, i, is_point, &f);
    const light_range_test depth = l->default_ranges ? light_test_default_range(q, k, f.den, f.num, is_point)
                                                     : light_test_ranges(p, q, k, i, f.den, f.num);
    const vmask possible = spux_not(spu_or(f.outside, spu_and(depth.out, f.den_certain)));
    if (spux_none(possible))
        return;
    const vmask inside =
        spu_or(spu_cmpgt(f.lower, spux_vfloat(q->side[k])), spu_cmpgt(spux_vfloat(-q->side[k]), f.upper));
    const vmask certain_hit = spu_and(spu_and(inside, f.den_certain), depth.in);
    light_store_hits(prims, l, i, prim, certain_hit, spu_andc(possible, certain_hit), counts);
}

/* ---- spheres ---- */

/* How far off the distance between the light, or the end of any ray, and a sphere's centre may be, squared as the
 * radius is: [0] times the sum of both squares, plus [1]. max_component: of the directions; q is a share of it. */
CGT_SPU_INLINE void light_end_error(float max_component, float error[2])
{
    error[0] = 12 * FILTER_ROUNDOFF;
    error[1] = 12 * FILTER_ROUNDOFF * max_component * max_component + 0x1p-118f;
}

/* The spheres of a leaf that certainly do not contain the light, as bits. */
CGT_SPU_INLINE unsigned light_outside_spheres(const light_packet *l, const sphere_block *leaf, float scale)
{
    float bound[2];
    const vfloat radius = spux_load(leaf->radius), square = spu_mul(radius, radius);
    vfloat distance = spux_vfloat(0);
    if (!l->rays.to_light)
        return CGT_ALL_LANES;
    for (int a = 0; a < 3; a++) {
        const vfloat c = spu_sub(spux_load(leaf->center[a]), spux_vfloat(l->origin[a]));
        distance = spu_madd(c, c, distance);
    }
    light_end_error(l->max_component / scale, bound);
    const vfloat error = spu_madd(spu_add(distance, square), spux_vfloat(bound[0]), spux_vfloat(bound[1]));
    return spux_mask_bits(spu_cmpgt(spu_sub(distance, square), error));
}

typedef struct light_roots {
    vfloat dd, distance;           /* A, c.c */
    vfloat inner, inner_error;     /* C */
    vfloat middle, disc, error;    /* B, and B^2 - A C */
    vmask middle_certain, outside; /* B is certainly not 0; C is certainly above 0 */
    vmask missed;                  /* the line passes outside, or the sphere is behind the origin */
} light_roots;

CGT_SPU_INLINE void light_compute_roots(const light_packet *l, const sphere_block *leaf, uint32_t k, float square,
                                        float size_offset, uint32_t i, light_roots *f)
{
    const vfloat zero = spux_vfloat(0);
    vfloat c[3], d[3];
    for (int a = 0; a < 3; a++) {
        c[a] = spu_sub(spux_vfloat(leaf->center[a][k]), spux_load(l->rays.org[a] + i));
        d[a] = spux_load(l->rays.dir[a] + i);
    }
    f->dd = spux_load(l->square + i);
    f->distance = lane_dot(c, c);
    f->middle = lane_dot(d, c);
    f->inner = spu_sub(f->distance, spux_vfloat(square));
    const vfloat size = spu_add(f->distance, spux_vfloat(square + size_offset));
    f->inner_error = spu_mul(size, spux_vfloat(LIGHT_EPS_INNER));
    f->error = spu_madd(spu_mul(f->dd, spux_vfloat(LIGHT_EPS_DISC)), size, spux_vfloat(0x1p-118f));
    f->disc = spu_msub(f->middle, f->middle, spu_mul(f->dd, f->inner));
    f->middle_certain = spu_cmpgt(spu_mul(f->middle, f->middle), spu_mul(f->error, spux_vfloat(2 * FILTER_ROUNDOFF)));
    f->outside = spu_cmpgt(f->inner, f->inner_error);
    const vmask behind = spu_and(f->outside, spu_and(f->middle_certain, spu_cmpgt(zero, f->middle)));
    f->missed = spu_or(spu_cmpgt(spu_sub(zero, f->error), f->disc), behind);
}

/* What does not depend on the ray, for all spheres of a leaf. */
typedef struct light_spheres {
    _Alignas(CGT_VECTOR_BYTES) float square[CGT_LANES]; /* r^2 */
    float size_offset;                                  /* of the packet */
    unsigned plain_rule;                                /* spheres for which the rule above suffices, as bits */
} light_spheres;

CGT_SPU_INLINE void light_init_spheres(const light_packet *l, const sphere_block *leaf, float scale, light_spheres *q)
{
    const vfloat radius = spux_load(leaf->radius);
    spux_store(q->square, spu_mul(radius, radius));
    q->size_offset = l->size_offset;
    q->plain_rule = l->default_ranges ? light_outside_spheres(l, leaf, scale) : 0;
}

/* Whether any ray of a vector may hit the sphere. */
CGT_SPU_INLINE bool light_sphere_may_hit(const light_packet *l, const light_spheres *q, const sphere_block *leaf,
                                         uint32_t k, uint32_t i)
{
    light_roots f;
    light_compute_roots(l, leaf, k, q->square[k], q->size_offset, i, &f);
    return !spux_all(f.missed);
}

/* Whether the light and the ends of all rays certainly lie in a sphere. square: r^2; light: the square of the light's
 * distance from its centre. */
CGT_SPU_INLINE bool light_ends_inside(float square, float light, float max_component)
{
    float bound[2];
    light_end_error(max_component, bound);
    return square - light > (square + light) * bound[0] + bound[1];
}

/* Points that certainly lie outside of a sphere. */
CGT_SPU_INLINE vmask light_begins_outside(const float center[3], float square, const vfloat org[3])
{
    vfloat distance = spux_vfloat(0);
    for (int a = 0; a < 3; a++) {
        const vfloat c = spu_sub(spux_vfloat(center[a]), org[a]);
        distance = spu_madd(c, c, distance);
    }
    const vfloat size = spu_add(distance, spux_vfloat(square + 0x1p-97f));
    return spu_cmpgt(spu_sub(distance, spux_vfloat(square)), spu_mul(size, spux_vfloat(LIGHT_EPS_INNER)));
}

/* The square of a light's distance from a centre. */
CGT_SPU_INLINE float light_square_distance(const float center[3], const float light[3])
{
    float sum = 0;
    for (int a = 0; a < 3; a++)
        sum += (center[a] - light[a]) * (center[a] - light[a]);
    return sum;
}

/* Rays with default ranges from outside of a sphere that the light is in: they certainly enter it. */
CGT_SPU_INLINE vmask light_find_entering(const light_packet *l, const sphere_block *leaf, uint32_t k, uint32_t i,
                                         float scale)
{
    const float center[3] = {leaf->center[0][k], leaf->center[1][k], leaf->center[2][k]};
    const float square = leaf->radius[k] * leaf->radius[k];
    vfloat org[3];
    if (!(l->rays.to_light && l->default_ranges &&
          light_ends_inside(square, light_square_distance(center, l->origin), l->max_component / scale)))
        return spux_mask_none();
    for (int a = 0; a < 3; a++)
        org[a] = spux_load(l->rays.org[a] + i);
    return light_begins_outside(center, square, org);
}

/* Rays that the rule above does not decide. */
__attribute__((noinline)) static void light_test_undecided_sphere(const cgt_committed_scene *committed_scene,
                                                                  light_packet *l, const sphere_block *leaf, uint32_t k,
                                                                  uint32_t i, const vmask *lanes, cgt_counts *counts)
{
    packet *p = &l->rays;
    const vfloat center[3] = {spux_vfloat(leaf->center[0][k]), spux_vfloat(leaf->center[1][k]),
                              spux_vfloat(leaf->center[2][k])};
    lane_rays r;
    lane_hits q;
    const vmask entering = spu_and(light_find_entering(l, leaf, k, i, committed_scene->scale), *lanes),
                others = spu_andc(*lanes, entering);
    if (spux_any(entering))
        light_store_hits(&committed_scene->prims, l, i, leaf->prim[k], entering, spux_mask_none(), counts);
    if (spux_none(others))
        return;
    spux_store(p->rdd + i, spux_div(spux_vfloat(1), spux_load(l->square + i))); /* few rays come here */
    lane_rays_of_packet(p, i, committed_scene->scale, &r);
    if (!lane_test_sphere(&r, center, spux_vfloat(leaf->radius[k]), &q))
        return;
    const vfloat t_max = spux_load(p->t_max + i);
    const vmask possible = spu_andc(spu_and(spu_or(q.certain_hit, q.undecided), others), spu_cmpgt(q.low, t_max));
    const vmask certain_hit = spu_and(spu_and(q.certain_hit, others),
                                      spu_or(spu_cmpgt(t_max, q.high), spu_cmpeq(t_max, spux_vfloat(INFINITY))));
    light_store_hits(&committed_scene->prims, l, i, leaf->prim[k], certain_hit, spu_andc(possible, certain_hit),
                     counts);
}

CGT_SPU_INLINE void light_test_sphere(const cgt_committed_scene *committed_scene, light_packet *l,
                                      const sphere_block *leaf, uint32_t k, const light_spheres *q, uint32_t i,
                                      cgt_counts *counts)
{
    light_roots f;
    light_compute_roots(l, leaf, k, q->square[k], q->size_offset, i, &f);
    vmask undecided = spu_andc(spu_cmpgt(spux_load(l->rays.high + i), spux_vfloat(-INFINITY)), f.missed);
    vmask certain_hit = spux_mask_none();
    if (l->rays.skips_prims) /* the surface that a point lies on would be undecided for most */
        undecided = spu_andc(undecided, rays_skipping_one(&committed_scene->prims, &l->rays, i, leaf->prim[k]));
    if (q->plain_rule >> k & 1) {
        const vfloat zero = spux_vfloat(0);
        const vmask inside = spu_cmpgt(spu_sub(zero, f.inner_error), f.inner);
        vmask ahead = spu_and(f.middle_certain, spu_cmpgt(f.middle, zero));
        if (l->rays.to_light)
            ahead = spu_and(ahead, spu_and(spu_cmpgt(spu_mul(f.dd, spux_vfloat(LIGHT_MIDDLE_FACTOR)), f.middle),
                                           spu_cmpgt(spu_mul(f.dd, spux_vfloat(4)), f.distance)));
        certain_hit =
            spu_and(undecided, spu_or(inside, spu_and(spu_and(f.outside, ahead), spu_cmpgt(f.disc, f.error))));
        undecided = spu_andc(undecided, certain_hit);
    }
    if (spux_any(certain_hit))
        light_store_hits(&committed_scene->prims, l, i, leaf->prim[k], certain_hit, spux_mask_none(), counts);
    if (spux_any(undecided))
        light_test_undecided_sphere(committed_scene, l, leaf, k, i, &undecided, counts);
}

/* ---- leaves ---- */

/* Which tests a leaf takes; a constant where functions are called. */
typedef enum light_kind { LIGHT_SPHERES, LIGHT_TRIANGLES_TO_POINT, LIGHT_TRIANGLES_PARALLEL } light_kind;

/* A leaf's primitives, of one kind, as the tests take them. */
typedef struct light_leaf {
    const sphere_block *sphere;
    const triangle_block *triangle;
    light_spheres spheres;
    light_triangles triangles;
} light_leaf;

/* Fills in what does not depend on the ray; the leaf has its block. */
CGT_SPU_INLINE void light_init_leaf(const light_packet *l, float scale, light_kind kind, light_leaf *leaf)
{
    if (kind == LIGHT_SPHERES)
        light_init_spheres(l, leaf->sphere, scale, &leaf->spheres);
    else
        light_init_triangles(l, leaf->triangle, scale, kind == LIGHT_TRIANGLES_TO_POINT, &leaf->triangles);
}

/* Whether any of the rays i to i + CGT_LANES - 1 may hit primitive k. */
CGT_SPU_INLINE bool light_may_hit(const light_packet *l, const light_leaf *leaf, light_kind kind, uint32_t k,
                                  uint32_t i)
{
    return kind == LIGHT_SPHERES ? light_sphere_may_hit(l, &leaf->spheres, leaf->sphere, k, i)
                                 : light_triangle_may_hit(l, &leaf->triangles, k, i, kind == LIGHT_TRIANGLES_TO_POINT);
}

CGT_SPU_INLINE void light_test_primitive(const cgt_committed_scene *committed_scene, light_packet *l,
                                         const light_leaf *leaf, light_kind kind, uint32_t k, uint32_t i,
                                         cgt_counts *counts)
{
    if (kind == LIGHT_SPHERES)
        light_test_sphere(committed_scene, l, leaf->sphere, k, &leaf->spheres, i, counts);
    else
        light_test_triangle(&committed_scene->prims, l, &leaf->triangles, k, i, leaf->triangle->prim[k],
                            kind == LIGHT_TRIANGLES_TO_POINT, counts);
}

/* A leaf's primitives, those of `remaining`, against the whole packet. */
CGT_SPU_INLINE void light_test_primitives(const cgt_committed_scene *committed_scene, light_packet *l, light_leaf *leaf,
                                          light_kind kind, unsigned remaining, cgt_counts *counts)
{
    light_init_leaf(l, committed_scene->scale, kind, leaf);
    for (; remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        uint64_t reached = 0;
        /* vectors of rays that may hit it: no branch on each, since most do not */
        for (uint32_t i = 0; i < l->rays.lanes; i += CGT_LANES)
            reached |= (uint64_t)light_may_hit(l, leaf, kind, k, i) << i / CGT_LANES;
        for (reached &= l->undecided; reached; reached &= reached - 1)
            light_test_primitive(committed_scene, l, leaf, kind, k, (uint32_t)__builtin_ctzll(reached) * CGT_LANES,
                                 counts);
    }
}

#endif
