/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t and normals of the rays that hit spheres, a vector at a time. The short formula of sphere_double.h serves most
 * rays, the long one those near a silhouette, and exact arithmetic the rest, ray by ray. */
#ifndef CGT_RESOLVE_SPHERES_H
#define CGT_RESOLVE_SPHERES_H

#include "exact/decide.h"
#include "exact/sphere_double.h"
#include "spux_double.h"
#include "kernel/resolve/hit_primitives.h"

/* Half a vector of rays and their spheres. */
typedef struct resolve_half {
    vdouble t, c[3], d[3]; /* c: the centre, seen from the origin */
    vdouble square, disc;  /* the terms of cgt_sphere_double_near: d.d, and the discriminant */
} resolve_half;

CGT_SPU_INLINE void resolve_directions(const vfloat dir[3], resolve_half h[2])
{
    for (int a = 0; a < 3; a++) {
        h[0].d[a] = spux_double_low(dir[a]);
        h[1].d[a] = spux_double_high(dir[a]);
    }
}

/* Normals of the lanes in `where`, 0 in the others. k: 1 / r. */
CGT_SPU_INLINE void resolve_normals(const resolve_half h[2], const vdouble k[2], vmask where, vfloat n[3])
{
    for (int a = 0; a < 3; a++)
        n[a] =
            spux_float_where((h[0].t * h[0].d[a] - h[0].c[a]) * k[0], (h[1].t * h[1].d[a] - h[1].c[a]) * k[1], where);
}

/* ---- the short formula of sphere_double.h, in its order ---- */

/* Returns the lanes, among those in `outside`, whose t is that of cgt_canonical_sphere_t; it has the sign of the middle
 * there. Both halves' roots come before both quotients: a CPU has one slow unit for them, and the halves overlap. */
CGT_SPU_INLINE vmask resolve_near_roots(const vdouble product[2], vmask outside, vfloat t_min, resolve_half h[2],
                                        vfloat *t)
{
    vdouble middle[2], square[2], disc[2], half[2], least[2];
    for (int i = 0; i < 2; i++) {
        const vdouble *c = h[i].c, *d = h[i].d;
        const vdouble dd = spux_double_add_square(spux_double_add_square(d[0] * d[0], d[1]), d[2]);
        middle[i] = d[0] * c[0] + d[1] * c[1] + d[2] * c[2];
        square[i] = middle[i] * middle[i];
        disc[i] = square[i] - dd * product[i];
        h[i].square = dd;
        h[i].disc = disc[i];
    }
    for (int i = 0; i < 2; i++)
        half[i] = spux_double_sqrt(disc[i]);
    for (int i = 0; i < 2; i++)
        least[i] = square[i] * CGT_SPHERE_INSIDE;
    const vmask inside = spux_double_cmpgt(disc, least);
    for (int i = 0; i < 2; i++)
        h[i].t = product[i] / (middle[i] + half[i]);
    *t = spux_float_of(h[0].t, h[1].t);
    const vmask ahead = spu_and(spu_cmpgt(*t, spux_vfloat(0)), spux_cmpge(*t, t_min));
    return spu_and(spu_and(outside, ahead), inside);
}

/* ---- the long formula ---- */

#define SPHERE_SAFE_RATIO 0x1p-16 /* more than twice what cgt_sphere_double_unsafe requires */

/* Overwrites t and n in some of these lanes, and returns them: t is the near root, and safe, so that
 * cgt_sphere_double_unsafe is 0. The product, d.d times that of the roots, is so far above 0 that the middle has the
 * sign of t. Not those that the short formula serves: it has found their near root before the range. */
__attribute__((noinline, unused)) static vmask resolve_spheres_long(const vfloat org[3], const vfloat dir[3],
                                                                    const vfloat sphere[4], vfloat t_min, bool normal,
                                                                    vmask lanes, vfloat *t, vfloat n[3])
{
    resolve_half h[2];
    vdouble headroom[2], outside[2], k[2], shorter[2], from[2], disc[2], least_disc[2];
    vfloat normals[3];
    resolve_directions(dir, h);
    for (int i = 0; i < 2; i++) {
        const vdouble r = i ? spux_double_high(sphere[3]) : spux_double_low(sphere[3]), rr = r * r;
        const vdouble *d = h[i].d, *c = h[i].c, dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        for (int a = 0; a < 3; a++)
            h[i].c[a] = i ? spux_double_high(sphere[a]) - spux_double_high(org[a])
                          : spux_double_low(sphere[a]) - spux_double_low(org[a]);
        const vdouble cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2], product = cc - rr,
                      least = (cc + rr) * SPHERE_SAFE_RATIO;
        const vdouble x = c[1] * d[2] - c[2] * d[1], y = c[2] * d[0] - c[0] * d[2], z = c[0] * d[1] - c[1] * d[0];
        const vdouble middle = d[0] * c[0] + d[1] * c[1] + d[2] * c[2];
        const vdouble half = spux_double_sqrt(rr * dd - (x * x + y * y + z * z));
        h[i].t = product / (middle + half);
        headroom[i] = (middle + half) * half - least * dd;
        from[i] = cc * CGT_SPHERE_OUTSIDE;
        shorter[i] = product;
        disc[i] = middle * middle - dd * product;
        least_disc[i] = middle * middle * CGT_SPHERE_INSIDE;
        outside[i] = product - least;
        k[i] = spux_vdouble(1) / r;
    }
    const vfloat near = spux_float_of(h[0].t, h[1].t);
    const vmask ahead = spu_and(spu_cmpgt(near, spux_vfloat(0)), spux_cmpge(near, t_min));
    const vmask safe =
        spu_and(spux_double_above0(headroom[0], headroom[1]), spux_double_above0(outside[0], outside[1]));
    const vmask is_short = spu_andc(spux_double_cmpgt(disc, least_disc), spux_double_cmpgt(from, shorter));
    const vmask safe_lanes = spu_andc(spu_and(spu_and(lanes, ahead), safe), is_short);
    *t = spux_select(*t, near, safe_lanes);
    if (!normal)
        return safe_lanes;
    resolve_normals(h, k, safe_lanes, normals);
    for (int a = 0; a < 3; a++)
        n[a] = spux_select(n[a], normals[a], safe_lanes);
    return spu_and(safe_lanes, spu_cmpgt(sphere[3], spux_vfloat(0)));
}

/* ---- rays one by one ---- */

/* t and the unit normal of one sphere's hit. */
typedef struct resolved_sphere {
    float t, normal[3];
} resolved_sphere;

/* A ray whose t suffers from cancellation or is the far root, or whose sphere is a point. */
__attribute__((noinline, unused)) static resolved_sphere resolve_sphere_ray(const cgt_ray *ray, cgt_sphere q,
                                                                            cgt_counts *counts)
{
    cgt_sphere_terms e = cgt_sphere_double_terms(ray->line.org, ray->line.dir, q);
    bool far;
    const double t = cgt_canonical_sphere_t(ray, q, &far);
    resolved_sphere s = {.t = (float)t};
    cgt_canonical_sphere_normal(ray, q, t, s.normal);
    counts->exact_values +=
        cgt_sphere_double_unsafe(e, sqrt(e.disc)) &&
        (cgt_sphere_double_unsafe_sum(e, sqrt(e.disc)) || !cgt_sphere_double_refine(ray->line.org, q, &e.product));
    return s;
}

/* ---- vectors of rays ---- */

/* The long formula for the lanes of `hit` that the short one left. Returns the lanes that are safe by either; the
 * others are left to resolve_sphere_ray. */
CGT_SPU_INLINE vmask resolve_spheres_fallback(const vfloat org[3], const vfloat dir[3], const vfloat sphere[4],
                                              vfloat t_min, bool normal, vmask hit, vmask safe_lanes, vfloat *t,
                                              vfloat n[3])
{
    const vmask remaining = spu_andc(hit, safe_lanes);
    if (!spux_any(remaining))
        return safe_lanes;
    /* copies, so that the originals stay in registers */
    const vfloat o[3] = {org[0], org[1], org[2]}, d[3] = {dir[0], dir[1], dir[2]};
    const vfloat q[4] = {sphere[0], sphere[1], sphere[2], sphere[3]};
    vfloat long_t = *t, long_n[3];
    for (int a = 0; normal && a < 3; a++)
        long_n[a] = n[a];
    const vmask more = resolve_spheres_long(o, d, q, t_min, normal, remaining, &long_t, long_n);
    *t = long_t;
    for (int a = 0; normal && a < 3; a++)
        n[a] = long_n[a];
    return spu_or(safe_lanes, more);
}

/* The terms of the short formula: centres and products. Directions are in h already. Returns the lanes whose origin is
 * outside the sphere. */
CGT_SPU_INLINE vmask resolve_terms(const vfloat org[3], const vfloat sphere[4], resolve_half h[2], vdouble product[2])
{
    const vdouble r[2] = {spux_double_low(sphere[3]), spux_double_high(sphere[3])};
    vdouble least[2];
    for (int a = 0; a < 3; a++) {
        h[0].c[a] = spux_double_low(sphere[a]) - spux_double_low(org[a]);
        h[1].c[a] = spux_double_high(sphere[a]) - spux_double_high(org[a]);
    }
    for (int i = 0; i < 2; i++) {
        const vdouble *c = h[i].c, rr = r[i] * r[i], cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
        product[i] = cc - rr;
        least[i] = cc * CGT_SPHERE_OUTSIDE;
    }
    return spux_not(spux_double_cmpgt(least, product));
}

/* t of rays whose directions are in h, and normals of the lanes in `hit`, 0 in the others. The outward unit normal is
 * the vector from the centre, divided by the radius. Origin and centre may both be far away, so their difference is
 * taken first. Returns the lanes whose result is right. */
CGT_SPU_INLINE vmask resolve_spheres_vector(const vfloat org[3], const vfloat sphere[4], vfloat t_min, bool normal,
                                            vmask hit, resolve_half h[2], vfloat *t, vfloat n[3])
{
    vdouble product[2];
    const vmask outside = resolve_terms(org, sphere, h, product);
    const vmask safe_lanes = resolve_near_roots(product, outside, t_min, h, t);
    if (normal) {
        const vdouble r[2] = {spux_double_low(sphere[3]), spux_double_high(sphere[3])};
        const vdouble k[2] = {spux_vdouble(1) / r[0], spux_vdouble(1) / r[1]};
        resolve_normals(h, k, hit, n);
    }
    return safe_lanes;
}

/* The terms that rays from one origin to one sphere share. */
typedef struct prepared_sphere {
    double c[3], product, reciprocal;
    bool outside;
} prepared_sphere;

CGT_SPU_INLINE prepared_sphere prepare_sphere(const float org[3], cgt_sphere q)
{
    const double cx = (double)q.x - (double)org[0], cy = (double)q.y - (double)org[1],
                 cz = (double)q.z - (double)org[2], r = (double)q.r;
    const double rr = r * r, cc = cx * cx + cy * cy + cz * cz;
    return (prepared_sphere){
        .c = {cx, cy, cz}, .product = cc - rr, .reciprocal = 1 / r, .outside = cc - rr >= cc * CGT_SPHERE_OUTSIDE};
}

/* As resolve_spheres_vector, for one sphere. */
CGT_SPU_INLINE vmask resolve_prepared_sphere(const prepared_sphere *p, vfloat t_min, bool normal, vmask hit,
                                             resolve_half h[2], vfloat *t, vfloat n[3])
{
    const vdouble product[2] = {spux_vdouble(p->product), spux_vdouble(p->product)};
    for (int a = 0; a < 3; a++)
        h[0].c[a] = h[1].c[a] = spux_vdouble(p->c[a]);
    const vmask safe_lanes = resolve_near_roots(product, p->outside ? spux_mask_all() : spux_mask_none(), t_min, h, t);
    if (normal) {
        const vdouble k[2] = {spux_vdouble(p->reciprocal), spux_vdouble(p->reciprocal)};
        resolve_normals(h, k, hit, n);
    }
    return safe_lanes;
}

#endif
