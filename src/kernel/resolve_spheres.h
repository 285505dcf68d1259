/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t and normals of the rays that hit spheres. The functions work on some rays at a time, first to first + count - 1;
 * `alone` says that the scene has nothing but spheres. */
#ifndef CGT_RESOLVE_SPHERES_H
#define CGT_RESOLVE_SPHERES_H

#include "../decide.h"
#include "../sphere_double.h"
#include "spux_double.h"
#include "winners.h"

/* What half a vector of rays takes of its quadratics (sphere_double.h). The steps are those of sphere_double.h, in its
 * order. */
typedef struct resolve_half {
    vdouble t, half, product, middle, square, size;
    vdouble c[3], d[3];
} resolve_half;

/* product: c.c - r^2; rr: r^2 */
CGT_SPU_INLINE void resolve_half_of(const vdouble c[3], vdouble product, vdouble rr, resolve_half *h)
{
    const vdouble *d = h->d, dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const vdouble x = c[1] * d[2] - c[2] * d[1], y = c[2] * d[0] - c[0] * d[2], z = c[0] * d[1] - c[1] * d[0];
    h->middle = d[0] * c[0] + d[1] * c[1] + d[2] * c[2];
    h->product = product;
    h->square = dd;
    h->half = spux_double_sqrt(rr * dd - (x * x + y * y + z * z));
    h->t = product / (h->middle + h->half);
}

CGT_SPU_INLINE void resolve_half_t(const vdouble org[3], const vdouble centre[3], vdouble r, resolve_half *h)
{
    const vdouble *c = h->c, rr = r * r;
    for (int a = 0; a < 3; a++)
        h->c[a] = centre[a] - org[a];
    const vdouble cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    h->size = cc + rr;
    resolve_half_of(c, cc - rr, rr, h);
}

#define SPHERE_ROOM 0x1p-16 /* twice what cgt_sphere_double_unsafe asks for, and more */

/* Lanes whose t is the near root, and safe: cgt_sphere_double_unsafe is 0 there; the rest is looked at ray by ray. least
 * is SPHERE_ROOM (c.c + r^2). The product, d.d times that of the roots, is above it besides, by `outside`: so the origin
 * is outside by so much that where t is above 0 the middle is. */
CGT_SPU_INLINE vmask resolve_halves_known(const resolve_half h[2], const vdouble least[2], vmask outside, vfloat t,
                                          vfloat t_min)
{
    vdouble room[2];
    for (int i = 0; i < 2; i++)
        room[i] = (h[i].middle + h[i].half) * h[i].half - least[i] * h[i].square;
    const vmask ahead = spu_and(spu_cmpgt(t, spux_vfloat(0)), spux_cmpge(t, t_min));
    return spu_and(spu_and(outside, ahead), spux_double_above0(room[0], room[1]));
}

/* t and the unit normal of one sphere's hit. */
typedef struct resolved_sphere {
    float t, normal[3];
} resolved_sphere;

/* A ray whose t cancels, or is the far root, or whose sphere is a point: that has no normal of its own, and gets the
 * direction back to the ray's origin. */
__attribute__((noinline, unused)) static resolved_sphere resolve_sphere_ray(const cgt_ray *ray, cgt_sphere q,
                                                                            cgt_counts *counts)
{
    const double centre[3] = {q.x, q.y, q.z}, d[3] = {ray->line.dir[0], ray->line.dir[1], ray->line.dir[2]};
    const cgt_sphere_terms e = cgt_sphere_double_terms(ray->line.org, ray->line.dir, q);
    bool far;
    const double t = cgt_canonical_sphere_t(ray, q, &far);
    const double k = q.r > 0 ? 1 / (double)q.r : -1 / sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    resolved_sphere s = {.t = (float)t};
    counts->exact_values += cgt_sphere_double_unsafe(e, sqrt(e.disc));
    for (int a = 0; a < 3; a++)
        s.normal[a] = (float)((q.r > 0 ? ((double)ray->line.org[a] - centre[a]) + t * d[a] : d[a]) * k);
    return s;
}

/* A vector of rays and the spheres that they hit. The outward unit normal is the vector from the centre over the radius.
 * Origin and centre may both be far away: their difference comes first. Returns the lanes that are right; the others
 * are for resolve_sphere_ray. */
CGT_SPU_INLINE vmask resolve_spheres_vector(const vfloat org[3], const vfloat dir[3], const vfloat sphere[4],
                                            vfloat t_min, bool normal, vfloat *t, vfloat n[3])
{
    resolve_half h[2];
    vdouble o[2][3], c[2][3];
    for (int a = 0; a < 3; a++) {
        h[0].d[a] = spux_double_low(dir[a]);
        h[1].d[a] = spux_double_high(dir[a]);
        o[0][a] = spux_double_low(org[a]);
        o[1][a] = spux_double_high(org[a]);
        c[0][a] = spux_double_low(sphere[a]);
        c[1][a] = spux_double_high(sphere[a]);
    }
    const vdouble r[2] = {spux_double_low(sphere[3]), spux_double_high(sphere[3])};
    resolve_half_t(o[0], c[0], r[0], &h[0]);
    resolve_half_t(o[1], c[1], r[1], &h[1]);
    *t = spux_float_of(h[0].t, h[1].t);
    const vdouble least[2] = {h[0].size * SPHERE_ROOM, h[1].size * SPHERE_ROOM};
    const vmask outside = spux_double_above0(h[0].product - least[0], h[1].product - least[1]);
    const vmask known = resolve_halves_known(h, least, outside, *t, t_min);
    if (!normal)
        return known;
    const vdouble k[2] = {spux_vdouble(1) / r[0], spux_vdouble(1) / r[1]};
    for (int a = 0; a < 3; a++)
        n[a] = spux_float_of((h[0].t * h[0].d[a] - h[0].c[a]) * k[0], (h[1].t * h[1].d[a] - h[1].c[a]) * k[1]);
    return spu_and(known, spu_cmpgt(sphere[3], spux_vfloat(0)));
}

/* What rays from one origin to one sphere have in common. */
typedef struct prepared_sphere {
    double c[3], product, rr, least, reciprocal;
    bool outside;
} prepared_sphere;

CGT_SPU_INLINE prepared_sphere prepare_sphere(const float org[3], cgt_sphere q)
{
    const double cx = (double)q.x - (double)org[0], cy = (double)q.y - (double)org[1],
                 cz = (double)q.z - (double)org[2], r = (double)q.r;
    const double rr = r * r, cc = cx * cx + cy * cy + cz * cz, least = (cc + rr) * SPHERE_ROOM;
    return (prepared_sphere){.c = {cx, cy, cz},
                             .product = cc - rr,
                             .rr = rr,
                             .least = least,
                             .reciprocal = 1 / r,
                             .outside = (cc - rr > least) & (r > 0)};
}

/* As resolve_spheres_vector; a point is never known. */
CGT_SPU_INLINE vmask resolve_prepared_sphere(const prepared_sphere *p, const vfloat dir[3], vfloat t_min, bool normal,
                                             vfloat *t, vfloat n[3])
{
    const vdouble c[3] = {spux_vdouble(p->c[0]), spux_vdouble(p->c[1]), spux_vdouble(p->c[2])};
    const vdouble least[2] = {spux_vdouble(p->least), spux_vdouble(p->least)}, k = spux_vdouble(p->reciprocal);
    resolve_half h[2];
    for (int i = 0; i < 2; i++) {
        for (int a = 0; a < 3; a++)
            h[i].d[a] = i ? spux_double_high(dir[a]) : spux_double_low(dir[a]);
        resolve_half_of(c, spux_vdouble(p->product), spux_vdouble(p->rr), &h[i]);
    }
    *t = spux_float_of(h[0].t, h[1].t);
    for (int a = 0; normal && a < 3; a++)
        n[a] = spux_float_of((h[0].t * h[0].d[a] - c[a]) * k, (h[1].t * h[1].d[a] - c[a]) * k);
    return resolve_halves_known(h, least, p->outside ? spux_mask_all() : spux_mask_none(), *t, t_min);
}

/* Lanes of a packet. */
CGT_SPU_INLINE void resolve_spheres_lanes(const packet *p, size_t i, bool normal, bool alone, const winners *w,
                                          packet_hits *hits, cgt_counts *counts)
{
    const vmask nobody = spu_cmpeq(spux_load_uint(p->object + i), spux_vuint(CGT_NONE));
    const vmask hit = alone ? spux_not(nobody) : spu_cmpeq(spux_load_uint(w->is_sphere + i), spux_vuint(1));
    vfloat sphere[4], org[3], dir[3], n[3], t;
    for (int a = 0; a < 4; a++)
        sphere[a] = spux_load(w->sphere[a] + i);
    for (int a = 0; a < 3; a++) {
        org[a] = spux_load(p->org[a] + i);
        dir[a] = spux_load(p->dir[a] + i);
    }
    const vmask known = resolve_spheres_vector(org, dir, sphere, spux_load(p->t_min + i), normal, &t, n);
    spux_store(hits->t + i, spux_select(alone ? spux_vfloat(INFINITY) : spux_load(hits->t + i), t, hit));
    for (int a = 0; normal && a < 3; a++) {
        const vfloat other = alone ? spux_vfloat(0) : spux_load(hits->normal[a] + i);
        spux_store(hits->normal[a] + i, spux_select(other, n[a], hit));
    }
    for (unsigned left = spux_mask_bits(spu_andc(hit, known)); left; left &= left - 1) {
        const size_t lane = i + (size_t)__builtin_ctz(left);
        const cgt_ray ray = {.line = {.org = {p->org[0][lane], p->org[1][lane], p->org[2][lane]},
                                      .dir = {p->dir[0][lane], p->dir[1][lane], p->dir[2][lane]}},
                             .t_min = p->t_min[lane]};
        const resolved_sphere s = resolve_sphere_ray(&ray, winner_sphere(w, lane), counts);
        hits->t[lane] = s.t;
        for (int a = 0; normal && a < 3; a++)
            hits->normal[a][lane] = s.normal[a];
    }
}

CGT_SPU_INLINE void resolve_spheres(const packet *p, size_t first, size_t count, const cgt_trace_settings *settings,
                                    bool alone, const winners *w, packet_hits *hits, cgt_counts *counts)
{
    if (settings->fields & CGT_FIELD_NORMAL)
        for (size_t i = first; i < first + count; i += CGT_LANES)
            resolve_spheres_lanes(p, i, true, alone, w, hits, counts);
    else if (settings->fields & CGT_FIELD_T)
        for (size_t i = first; i < first + count; i += CGT_LANES)
            resolve_spheres_lanes(p, i, false, alone, w, hits, counts);
}

#endif
