/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tests one ray against one primitive in each lane, in single precision with derived bounds. Leaves of trees hold few
 * primitives and are reached by few rays, so nothing is prepared per packet, only per commit (leaf_triangle.h). The
 * rays, or the primitives, of all lanes may be the same. The formula for spheres is that of sphere_filter.h.
 *
 * Triangles (Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997): let s be the ray's origin
 * seen from the first vertex, e_1 and e_2 the edges from there, all times the scene's scale, u = 2^-24, |x| the largest
 * component and [x] the 1-norm. P(p, q, r) of triangle_filter.h is at most |p| [q] [r] in any order. So
 *   U = s.(d x e_2)   within 9 u |d| [s] [e_2]        V = d.(s x e_1)   within 9 u |d| [s] [e_1]
 *   D = e_1.(d x e_2) within 9 u |d| [e_1] [e_2]      T = e_2.(s x e_1) within 9 u [s] [e_1] [e_2]
 *   W = D - U - V     within the errors of all three, and 2 u of their sizes
 * each enlarged by 2^-7 for second order terms. The signs of U, V and W tell on which side of each edge the line
 * passes: they are the sides of triangle_double.h, times scale^2. t = T / D, divided by the scale.
 *
 * Underflow in a vertex, a product or a sum is below 2^-124, and may be multiplied by |d|, by [s] or by both:
 * 2^-118 (|d| + 1) ([s] + 1) is added to the bounds of U, V and W, 2^-118 ([s] + 1) to that of T, and 2^-118 (|d| + 1)
 * to that of D. If [s] exceeds 2^124, products may overflow: then this addend is infinite and no sign is certain.
 * Comparisons with infinities and NaN are false, so such lanes are undecided. If |D| is not above four times its error,
 * the interval of t is unbounded. */
#ifndef CGT_LANE_TESTS_H
#define CGT_LANE_TESTS_H

#include "kernel/primitive/filter.h"

/* Error bounds of triangles, see above. */
#define LANE_EPS_UV (9 * FILTER_ROUNDOFF * (1 + 0x1p-7f))
#define LANE_EPS_W (11 * FILTER_ROUNDOFF * (1 + 0x1p-7f))
#define LANE_EPS_PLANE (10 * FILTER_ROUNDOFF * (1 + 0x1p-7f))

/* The rays of the lanes, all the same or different ones. Of moved rays (query/moved_ray.h) the origin is off,
 * by u org_error at most in the 1-norm. All errors above grow with the distance from the origin to the primitive, and
 * have u of it for the origin's rounding alone: so org_error is added to that distance. */
typedef struct lane_rays {
    vfloat org[3], dir[3];
    vfloat t_min;
    vfloat rdd;                /* 1 / d.d; this and the next one only for spheres */
    vfloat rlength;            /* 1 / |d|, rounded up */
    vfloat max_dir, underflow; /* these and the next ones only for triangles */
    vfloat scaled_org[3];
    vfloat unscale;   /* 1 over the scene's scale */
    vfloat org_error; /* of moved rays alone */
} lane_rays;

/* The result of a test: certain hits, with an interval of t; and undecided lanes, which do not hit before `low`. */
typedef struct lane_hits {
    vfloat low, high;
    vmask certain_hit, undecided;
} lane_hits;

/* 1 over a power of two from 2^-126 to 2^126: the exponents of both add up to twice the bias. A quotient of an SPU need
 * not be exact. */
CGT_SPU_INLINE float lane_power_reciprocal(float power)
{
    uint32_t bits;
    memcpy(&bits, &power, sizeof bits);
    bits = 0x7f000000u - bits;
    memcpy(&power, &bits, sizeof bits);
    return power;
}

CGT_SPU_INLINE vfloat lane_length_reciprocal(vfloat rdd) { return spu_mul(spux_sqrt(rdd), spux_vfloat(1 + 0x1p-18f)); }

CGT_SPU_INLINE void lane_rays_derive(lane_rays *r, float scale)
{
    r->rlength = lane_length_reciprocal(r->rdd);
    r->max_dir = spux_max(spux_abs(r->dir[0]), spux_max(spux_abs(r->dir[1]), spux_abs(r->dir[2])));
    r->underflow = spu_madd(r->max_dir, spux_vfloat(0x1p-118f), spux_vfloat(0x1p-118f));
    for (int a = 0; a < 3; a++)
        r->scaled_org[a] = spu_mul(r->org[a], spux_vfloat(scale));
    r->unscale = spux_vfloat(lane_power_reciprocal(scale));
}

/* Rays i to i + CGT_LANES - 1 of a packet. */
CGT_SPU_INLINE void lane_rays_of_packet(const packet *p, uint32_t i, float scale, lane_rays *r)
{
    for (int a = 0; a < 3; a++) {
        r->org[a] = spux_load(p->org[a] + i);
        r->dir[a] = spux_load(p->dir[a] + i);
    }
    r->t_min = spux_load(p->t_min + i);
    r->rdd = spux_load(p->rdd + i);
    lane_rays_derive(r, scale);
}

/* Ray i of a packet in every lane. */
CGT_SPU_INLINE void lane_rays_of_one(const packet *p, uint32_t i, float scale, lane_rays *r)
{
    for (int a = 0; a < 3; a++) {
        r->org[a] = spux_vfloat(p->org[a][i]);
        r->dir[a] = spux_vfloat(p->dir[a][i]);
    }
    r->t_min = spux_vfloat(p->t_min[i]);
    r->rdd = spux_vfloat(p->rdd[i]);
    lane_rays_derive(r, scale);
}

/* How far away primitives are, p seen from the origins. */
CGT_SPU_INLINE vfloat lane_distance(const lane_rays *r, const vfloat p[3], bool moved)
{
    return moved ? spu_add(lane_sum(p), r->org_error) : lane_sum(p);
}

/* The points of lines that are nearest to centres, by the terms of sphere_filter.h: t, the vector from there to the
 * centre and its square; and the errors of the discriminant, of that vector and of t. */
typedef struct lane_feet {
    vfloat mid, l[3], square, eps, eps_c, t_error;
} lane_feet;

/* c: the centres seen from the origins. Their errors are at most u times the distance. */
CGT_SPU_INLINE void lane_find_feet(const lane_rays *r, const vfloat c[3], vfloat radius, vfloat distance, lane_feet *q)
{
    const vfloat reach = spu_add(distance, radius);
    const vfloat underflow = spu_madd(spu_mul(r->rlength, r->rlength), spux_vfloat(0x1p-122f), spux_vfloat(0x1p-62f));
    q->eps_c = spu_mul(distance, spux_vfloat(26 * FILTER_ROUNDOFF));
    q->eps = spu_madd(spu_mul(radius, spux_vfloat(9 * FILTER_ROUNDOFF)), reach,
                      spu_madd(q->eps_c, q->eps_c, spux_vfloat(0x1p-120f)));
    q->t_error = spu_madd(spu_mul(reach, spux_vfloat(18 * FILTER_ROUNDOFF)), r->rlength, underflow);
    q->mid = spu_mul(lane_dot(r->dir, c), r->rdd);
    for (int a = 0; a < 3; a++)
        q->l[a] = spu_nmsub(q->mid, r->dir[a], c[a]);
    q->square = lane_dot(q->l, q->l);
}

/* The length of the interval of t where a line certainly meets a sphere. */
CGT_SPU_INLINE vfloat lane_chord_width(const lane_rays *r, const lane_feet *q)
{
    return spu_madd(q->t_error, spux_vfloat(2), spu_mul(spux_sqrt(q->eps), spu_mul(r->rlength, spux_vfloat(0.27f))));
}

/* Where lines pass spheres: the near roots are in [near, near + width], the far ones in [far - width, far], where a
 * line is `inside`, which has both for certain. */
typedef struct lane_chords {
    vfloat near, far, width;
    vmask missed, inside;
} lane_chords;

/* Returns false if all certainly miss. */
CGT_SPU_INLINE bool lane_pass_sphere(const lane_rays *r, const vfloat center[3], vfloat radius, bool moved,
                                     lane_chords *q)
{
    const vfloat zero = spux_vfloat(0);
    vfloat c[3];
    lane_feet foot;
    for (int a = 0; a < 3; a++)
        c[a] = spu_sub(center[a], r->org[a]);
    lane_find_feet(r, c, radius, lane_distance(r, c, moved), &foot);
    const vfloat h = spu_sub(spu_madd(radius, radius, foot.eps), foot.square);
    q->missed = spu_cmpgt(zero, h);
    if (spux_all(q->missed))
        return false;
    const vfloat half = spux_sqrt(spu_mul(spux_select(h, zero, q->missed), r->rdd));
    q->width = lane_chord_width(r, &foot);
    q->near = spu_sub(spu_sub(foot.mid, half), foot.t_error);
    q->far = spu_add(spu_add(foot.mid, half), foot.t_error);
    q->inside = spu_cmpgt(h, spu_mul(foot.eps, spux_vfloat(17)));
    return true;
}

/* Returns false if all certainly miss. */
CGT_SPU_INLINE bool lane_test_sphere_from(const lane_rays *r, const vfloat center[3], vfloat radius, bool moved,
                                          lane_hits *q)
{
    lane_chords chord;
    if (!lane_pass_sphere(r, center, radius, moved, &chord))
        return false;
    q->low = chord.near;
    q->high = spu_add(q->low, chord.width);
    /* both roots lie before the range */
    const vmask behind = spu_cmpgt(r->t_min, chord.far);
    q->certain_hit = spu_and(chord.inside, spu_cmpgt(q->low, r->t_min));
    q->undecided = spux_not(spu_or(spu_or(chord.missed, behind), q->certain_hit));
    if (__builtin_expect(spux_any(q->undecided), 0)) {
        const vmask second = filter_second_root(spu_and(chord.inside, q->undecided), r->t_min, chord.far, chord.width,
                                                &q->low, &q->high);
        q->certain_hit = spu_or(q->certain_hit, spu_and(second, spu_cmpgt(q->low, r->t_min)));
        q->undecided = spu_andc(q->undecided, q->certain_hit);
    }
    return true;
}

CGT_SPU_INLINE bool lane_test_sphere(const lane_rays *r, const vfloat center[3], vfloat radius, lane_hits *q)
{
    return lane_test_sphere_from(r, center, radius, false, q);
}

/* Triangles in the form of leaf_triangle.h. */
typedef struct lane_triangles {
    vfloat vertex[3], edge[2][3], sum[2];
} lane_triangles;

/* Adds one edge: lanes on the upper [0] or the lower [1] side of all edges, and of any edge, for certain. */
CGT_SPU_INLINE void lane_test_side(vfloat w, vfloat eps, vmask inside_sides[2], vmask outside_sides[2])
{
    const vmask above = spu_cmpgt(w, eps), below = spu_cmpgt(spu_xor(eps, spux_vfloat(-0.f)), w);
    inside_sides[0] = spu_and(inside_sides[0], above);
    inside_sides[1] = spu_and(inside_sides[1], below);
    outside_sides[0] = spu_or(outside_sides[0], above);
    outside_sides[1] = spu_or(outside_sides[1], below);
}

/* Where lines pass triangles: on which side of the edges, and what t is made of. */
typedef struct lane_passes {
    vmask inside, outside;
    vfloat qvec[3], den, distance, edges, eps_den;
} lane_passes;

CGT_SPU_INLINE void lane_pass_triangle(const lane_rays *r, const lane_triangles *triangle, bool moved, lane_passes *q)
{
    const vfloat *e1 = triangle->edge[0], *e2 = triangle->edge[1];
    vmask inside_sides[2] = {spux_mask_all(), spux_mask_all()}, outside_sides[2] = {spux_mask_none(), spux_mask_none()};
    vfloat tvec[3], pvec[3];
    for (int a = 0; a < 3; a++)
        tvec[a] = spu_sub(r->scaled_org[a], triangle->vertex[a]);
    lane_cross(r->dir, e2, pvec);
    lane_cross(tvec, e1, q->qvec);
    const vfloat u = lane_dot(tvec, pvec), v = lane_dot(r->dir, q->qvec), den = lane_dot(e1, pvec);
    const vfloat distance = lane_distance(r, tvec, moved), size = spu_mul(r->max_dir, distance),
                 edges = spu_mul(triangle->sum[0], triangle->sum[1]);
    const vfloat eps_u = spu_mul(size, triangle->sum[1]), eps_v = spu_mul(size, triangle->sum[0]);
    const vfloat eps_den = spu_mul(r->max_dir, edges);
    const vfloat underflow =
        spu_madd(spu_mul(distance, spux_vfloat(16)), spu_mul(r->underflow, spux_vfloat(0x1p-4f)), r->underflow);
    lane_test_side(u, spu_madd(eps_u, spux_vfloat(LANE_EPS_UV), underflow), inside_sides, outside_sides);
    lane_test_side(v, spu_madd(eps_v, spux_vfloat(LANE_EPS_UV), underflow), inside_sides, outside_sides);
    lane_test_side(spu_sub(spu_sub(den, u), v),
                   spu_madd(spu_add(spu_add(eps_u, eps_v), eps_den), spux_vfloat(LANE_EPS_W), underflow), inside_sides,
                   outside_sides);
    q->inside = spu_or(inside_sides[0], inside_sides[1]);
    q->outside = spu_and(outside_sides[0], outside_sides[1]);
    q->den = den;
    q->distance = distance;
    q->edges = edges;
    q->eps_den = eps_den;
}

/* Returns false if all certainly miss. */
CGT_SPU_INLINE bool lane_test_triangle_from(const lane_rays *r, const lane_triangles *triangle, bool moved,
                                            lane_hits *q)
{
    lane_passes passes;
    lane_pass_triangle(r, triangle, moved, &passes);
    if (spux_all(passes.outside))
        return false;
    /* t and its interval */
    const vfloat den = passes.den, distance = passes.distance, edges = passes.edges, eps_den = passes.eps_den;
    const vfloat delta = spu_madd(eps_den, spux_vfloat(LANE_EPS_PLANE), r->underflow);
    const vfloat num_error = spu_madd(spu_madd(edges, spux_vfloat(LANE_EPS_PLANE), spux_vfloat(0x1p-118f)), distance,
                                      spux_vfloat(0x1p-118f));
    const vfloat num = lane_dot(triangle->edge[1], passes.qvec), rden = spux_div(spux_vfloat(1), den);
    const vfloat t = spu_mul(num, rden), reach = spux_abs(t), tiny = spux_vfloat(0x1p-126f);
    const vfloat error = spu_mul(spu_madd(reach, delta, num_error), spu_mul(spux_abs(rden), spux_vfloat(1.34f)));
    const vfloat width = spu_madd(reach, spux_vfloat(0x1p-20f), spu_add(error, spux_vfloat(0x1p-124f)));
    const vmask steep = spu_cmpgt(spux_abs(den), spu_mul(delta, spux_vfloat(4)));
    /* 1 / den is of ordinary size at any scale of the scene: unscale last */
    q->low = spux_select(spux_vfloat(-INFINITY), spu_msub(spu_sub(t, width), r->unscale, tiny), steep);
    q->high = spux_select(spux_vfloat(INFINITY), spu_madd(spu_add(t, width), r->unscale, tiny), steep);
    const vmask behind = spu_and(steep, spu_cmpgt(r->t_min, q->high));
    q->certain_hit = spu_and(spu_and(passes.inside, steep), spu_cmpgt(q->low, r->t_min));
    q->undecided = spux_not(spu_or(spu_or(passes.outside, behind), q->certain_hit));
    return true;
}

CGT_SPU_INLINE bool lane_test_triangle(const lane_rays *r, const lane_triangles *triangle, lane_hits *q)
{
    return lane_test_triangle_from(r, triangle, false, q);
}

/* ---- one ray and a list ---- */

/* The number of primitives, from the first of a list on and at most a vector, that are of one kind. */
CGT_SPU_INLINE uint32_t leaf_same_kind_run(const cgt_primitives *prims, const uint32_t *reference, uint32_t count,
                                           cgt_kind *kind)
{
    const uint32_t max_count = count < CGT_LANES ? count : CGT_LANES;
    uint32_t same_kind = 1;
    *kind = cgt_primitives_first_kind(prims);
    if (cgt_primitives_kinds(prims) == 1)
        return max_count;
    *kind = cgt_primitives_array(prims, reference[0])->kind;
    while (same_kind < max_count && cgt_primitives_array(prims, reference[same_kind])->kind == *kind)
        same_kind++;
    return same_kind;
}

#endif
