/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides vectors of tests in double; see decide_lanes.h. */
#include "kernel/primitive/decide_lanes.h"

#include "exact/triangle_double.h"
#include "spux_double.h"

/* Half a vector, as doubles. */
CGT_SPU_INLINE void double_points(const float from[3][CGT_LANES], int h, vdouble p[3])
{
    for (int a = 0; a < 3; a++) {
        const vfloat v = spux_load(from[a]);
        p[a] = h ? spux_double_high(v) : spux_double_low(v);
    }
}

CGT_SPU_INLINE void double_subtract(const vdouble p[3], const vdouble q[3], vdouble d[3])
{
    for (int a = 0; a < 3; a++)
        d[a] = p[a] - q[a];
}

CGT_SPU_INLINE vdouble double_sum(const vdouble v[3])
{
    return spux_double_abs(v[0]) + spux_double_abs(v[1]) + spux_double_abs(v[2]);
}

/* ---- hit or miss ---- */

/* Where lines pass triangles; lanes that are in neither mask are undecided. */
typedef struct lanes_sides {
    vmask inside, outside;
} lanes_sides;

CGT_SPU_INLINE lanes_sides compute_sides(const decide_tests *q)
{
    vdouble w[3][2], minus[3][2], error[3][2];
    vmask above[3], below[3];
    for (int h = 0; h < 2; h++) {
        vdouble org[3], d[3], v[3][3], b[3][3];
        double_points(q->org, h, org);
        double_points(q->dir, h, d);
        for (int k = 0; k < 3; k++) {
            double_points(q->triangle.v[k], h, v[k]);
            double_subtract(v[k], org, b[k]);
        }
        const vdouble length = double_sum(d) * CGT_TRIANGLE_DOUBLE_ERROR;
        for (int k = 0; k < 3; k++) {
            const vdouble *from = b[(k + 1) % 3];
            vdouble e[3];
            double_subtract(v[(k + 2) % 3], v[(k + 1) % 3], e);
            w[k][h] =
                d[0] * CGT_CROSS(from, e, 1, 2) + d[1] * CGT_CROSS(from, e, 2, 0) + d[2] * CGT_CROSS(from, e, 0, 1);
            error[k][h] = length * double_sum(from) * double_sum(e);
            minus[k][h] = -w[k][h];
        }
    }
    for (int k = 0; k < 3; k++) {
        above[k] = spux_double_cmpgt(w[k], error[k]);
        below[k] = spux_double_cmpgt(minus[k], error[k]);
    }
    return (lanes_sides){
        .inside =
            spu_or(spu_and(above[0], spu_and(above[1], above[2])), spu_and(below[0], spu_and(below[1], below[2]))),
        .outside = spu_and(spu_or(above[0], spu_or(above[1], above[2])), spu_or(below[0], spu_or(below[1], below[2])))};
}

/* The planes of triangles on lines, as cgt_triangle_plane; safe: cgt_triangle_double_t_safe. */
typedef struct lanes_planes {
    vdouble num[2], den[2], num_error[2], den_error[2];
    vmask safe;
} lanes_planes;

static void compute_planes(const decide_tests *q, const decide_triangles *triangle, lanes_planes *p)
{
    vdouble num_share[2], den_share[2];
    for (int h = 0; h < 2; h++) {
        vdouble org[3], d[3], v[3][3], a[3], e1[3], e2[3];
        double_points(q->org, h, org);
        double_points(q->dir, h, d);
        for (int k = 0; k < 3; k++)
            double_points(triangle->v[k], h, v[k]);
        double_subtract(v[0], org, a);
        double_subtract(v[1], v[0], e1);
        double_subtract(v[2], v[0], e2);
        const vdouble n[3] = {CGT_CROSS(e1, e2, 1, 2), CGT_CROSS(e1, e2, 2, 0), CGT_CROSS(e1, e2, 0, 1)};
        const vdouble edges = double_sum(e1) * double_sum(e2) * CGT_TRIANGLE_DOUBLE_ERROR;
        p->num[h] = n[0] * a[0] + n[1] * a[1] + n[2] * a[2];
        p->den[h] = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
        p->num_error[h] = edges * double_sum(a);
        p->den_error[h] = edges * double_sum(d);
        num_share[h] = spux_double_abs(p->num[h]) * CGT_DOUBLE_SAFE;
        den_share[h] = spux_double_abs(p->den[h]) * CGT_DOUBLE_SAFE;
    }
    p->safe = spu_and(spux_double_cmpgt(num_share, p->num_error), spux_double_cmpgt(den_share, p->den_error));
}

/* Where the canonical t of lanes certainly is in the range, and where it certainly is not. */
typedef struct lanes_depths {
    vfloat t;
    vmask within, beyond;
} lanes_depths;

/* Where |den| is above four times its error, num / den is within 4/3 (num_error + |t| den_error) / |den| of the exact
 * t, and the canonical one is within 2^-50 of that. Rounding to float keeps the order. */
CGT_SPU_INLINE lanes_depths compute_depths(const decide_tests *q, const lanes_planes *p)
{
    vdouble t[2], low[2], high[2], size[2], least[2];
    for (int h = 0; h < 2; h++) {
        t[h] = p->num[h] / p->den[h];
        size[h] = spux_double_abs(p->den[h]);
        least[h] = p->den_error[h] * 4;
        const vdouble reach = spux_double_abs(t[h]);
        const vdouble error = (p->num_error[h] + reach * p->den_error[h]) / size[h] * 1.34 + reach * 0x1p-48;
        low[h] = t[h] - error;
        high[h] = t[h] + error;
    }
    const vmask steep = spux_double_cmpgt(size, least);
    const vfloat first = spux_float_of(low[0], low[1]), last = spux_float_of(high[0], high[1]);
    const vfloat t_min = spux_load(q->t_min), t_max = spux_load(q->t_max), end = spux_vfloat(INFINITY);
    const vmask finite = spu_and(spu_cmpgt(end, spux_abs(first)), spu_cmpgt(end, spux_abs(last)));
    return (lanes_depths){
        .t = spux_float_of(t[0], t[1]),
        .within = spu_and(spu_and(steep, finite), spu_and(spux_cmpge(first, t_min), spux_cmpge(t_max, last))),
        .beyond = spu_and(steep, spu_or(spu_cmpgt(t_min, last), spu_cmpgt(first, t_max)))};
}

/* ---- which is nearer ---- */

/* Lanes whose two triangles certainly lie in one plane. */
static vmask find_same_planes(const decide_tests *q)
{
    vmask same = spux_mask_none(), shared = spux_mask_all();
    for (int a = 0; a < 3; a++) {
        const vfloat first = spux_load(q->triangle.v[0][a]);
        vmask flat = spux_mask_all();
        for (int k = 0; k < 3; k++)
            flat = spu_and(flat, spu_and(spu_cmpeq(first, spux_load(q->triangle.v[k][a])),
                                         spu_cmpeq(first, spux_load(q->best.v[k][a]))));
        same = spu_or(same, flat);
    }
    for (int k = 0; k < 3; k++) { /* each vertex of the one is one of the other: triangles have areas */
        vmask found = spux_mask_none();
        for (int j = 0; j < 3; j++) {
            vmask equal = spux_mask_all();
            for (int a = 0; a < 3; a++)
                equal = spu_and(equal, spu_cmpeq(spux_load(q->triangle.v[k][a]), spux_load(q->best.v[j][a])));
            found = spu_or(found, equal);
        }
        shared = spu_and(shared, found);
    }
    return spu_or(same, shared);
}

/* Lanes where the hit in plane p is certainly nearer than that in plane b, and where it is certainly farther, if both
 * planes are safe. */
static void compare_planes(const lanes_planes *p, const lanes_planes *b, vmask *nearer, vmask *farther)
{
    vdouble difference[2], minus[2], margin[2];
    for (int h = 0; h < 2; h++) {
        const vdouble lhs = p->num[h] * b->den[h], rhs = b->num[h] * p->den[h], plain = rhs - lhs;
        const vdouble error =
            spux_double_abs(p->num[h]) * b->den_error[h] + spux_double_abs(b->den[h]) * p->num_error[h] +
            spux_double_abs(b->num[h]) * p->den_error[h] + spux_double_abs(p->den[h]) * b->num_error[h];
        const vdouble turned = spux_double_select(-plain, plain, p->den[h]);
        difference[h] = spux_double_select(-turned, turned, b->den[h]); /* above 0 where p is nearer */
        minus[h] = -difference[h];
        margin[h] = error * (1 + 0x1p-20) + (spux_double_abs(lhs) + spux_double_abs(rhs)) * 0x1p-51;
    }
    const vmask safe = spu_and(p->safe, b->safe);
    *nearer = spu_and(safe, spux_double_cmpgt(difference, margin));
    *farther = spu_and(safe, spux_double_cmpgt(minus, margin));
}

void CGT_KERNEL(cgt_decide_lanes)(const decide_tests *q, decide_results *r)
{
    lanes_planes p;
    unsigned still[3];
    for (int a = 0; a < 3; a++)
        still[a] = spux_mask_bits(spu_cmpeq(spux_load(q->dir[a]), spux_vfloat(0)));
    unsigned missed = decide_find_parallel(&q->triangle, still);
    *r = (decide_results){.missed = missed, .in_double = CGT_ALL_LANES & ~missed};
    if (!(q->lanes & ~missed))
        return;
    const lanes_sides sides = compute_sides(q);
    r->missed = missed |= spux_mask_bits(sides.outside);
    if (!(q->lanes & ~missed))
        return;
    compute_planes(q, &q->triangle, &p);
    const lanes_depths depths = compute_depths(q, &p);
    unsigned closer = q->is_free, beaten = 0;
    if (q->has_rival) {
        lanes_planes b;
        vmask nearer, farther;
        compute_planes(q, &q->best, &b);
        compare_planes(&p, &b, &nearer, &farther);
        const unsigned same = spux_mask_bits(find_same_planes(q));
        closer |=
            q->has_rival & (same ? (spux_mask_bits(nearer) & ~same) | (same & q->is_first) : spux_mask_bits(nearer));
        beaten = q->has_rival & ((spux_mask_bits(farther) & ~same) | (same & ~q->is_first));
    }
    /* what is to become a closest hit is to have a t that is good for an interval */
    const vmask good = q->any_hit ? depths.within : spu_and(depths.within, p.safe);
    r->missed = missed | beaten | spux_mask_bits(depths.beyond);
    r->hit = spux_mask_bits(spu_and(sides.inside, good)) & closer & ~r->missed;
    spux_store(r->t, depths.t);
}

unsigned CGT_KERNEL(cgt_decide_copies)(const cgt_primitives *prims, vuint best, vuint prim, unsigned lanes)
{
    vmask copies = spu_and(spu_cmpgt(prim, best), spux_mask_from_bits(lanes));
    vfloat sphere[4], other[4];
    if (spux_none(copies))
        return lanes;
    gather_scene_spheres(prims, prim, sphere);
    gather_scene_spheres(prims, spux_select(prim, best, copies), other);
    for (int k = 0; k < 4; k++)
        copies = spu_and(copies, spu_cmpeq(sphere[k], other[k]));
    return lanes & ~spux_mask_bits(copies);
}

unsigned CGT_KERNEL(cgt_decide_ray)(const cgt_primitives *prims, const cgt_ray *ray, uint32_t best, bool any_hit,
                                    const uint32_t prim[CGT_LANES], unsigned lanes, cgt_counts *counts)
{
    decide_tests q;
    decide_results r;
    const bool is_free = any_hit || best == CGT_INVALID_ID;
    const cgt_kind kind = cgt_primitives_array(prims, prim[0])->kind;
    if (kind == CGT_KIND_SPHERES && !is_free && cgt_primitives_kinds(prims) == 1)
        return CGT_KERNEL(cgt_decide_copies)(prims, spux_vuint(best), spux_load_uint(prim), lanes);
    if (kind != CGT_KIND_TRIANGLES)
        return lanes;
    for (int a = 0; a < 3; a++) {
        spux_store(q.org[a], spux_vfloat(ray->line.org[a]));
        spux_store(q.dir[a], spux_vfloat(ray->line.dir[a]));
    }
    spux_store(q.t_min, spux_vfloat(ray->t_min));
    spux_store(q.t_max, spux_vfloat(ray->t_max));
    q.lanes = lanes;
    q.any_hit = any_hit;
    decide_gather_triangles(prims, prim, &q.triangle);
    q.is_free = is_free ? CGT_ALL_LANES : 0;
    q.has_rival = !is_free && decide_set_triangle(prims, best, &q.best) ? CGT_ALL_LANES : 0;
    q.is_first = spux_mask_bits(spu_cmpgt(spux_vuint(best), spux_load_uint(prim)));
    CGT_KERNEL(cgt_decide_lanes)(&q, &r);
    unsigned left = lanes & ~r.missed;
    if (any_hit && left & r.hit) /* one is enough */
        left &= r.hit & -(left & r.hit);
    counts->double_tests += spux_count_bits(lanes & ~left & r.in_double);
    return left;
}
