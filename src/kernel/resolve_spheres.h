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

/* What half a vector of rays takes of its quadratics (sphere_double.h), and the vector from the sphere's centre to the
 * hit. The steps are those of sphere_double.h, in its order. */
typedef struct resolve_half {
    vdouble t, half, large, product, middle, square, size;
    vdouble c[3], d[3];
} resolve_half;

CGT_SPU_INLINE void resolve_half_t(const vdouble org[3], const vdouble centre[3], vdouble r, resolve_half *h)
{
    const vdouble *d = h->d, *c = h->c;
    for (int a = 0; a < 3; a++)
        h->c[a] = centre[a] - org[a];
    const vdouble dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    const vdouble x = c[1] * d[2] - c[2] * d[1], y = c[2] * d[0] - c[0] * d[2], z = c[0] * d[1] - c[1] * d[0];
    const vdouble rr = r * r;
    h->square = dd;
    h->middle = d[0] * c[0] + d[1] * c[1] + d[2] * c[2];
    h->product = cc - rr;
    h->size = cc + rr;
    h->half = spux_double_sqrt(rr * dd - (x * x + y * y + z * z));
    h->large = h->middle + h->half;
    h->t = h->product / h->large;
}

/* Above 0 in all lanes whose t is the near root, and safe: cgt_sphere_double_unsafe is 0 there. The rest is looked at
 * ray by ray. A number too small for float makes 0 of what is above it, which is as good as not knowing. */
CGT_SPU_INLINE vmask resolve_halves_known(const resolve_half h[2], vfloat t, vfloat t_min)
{
    vdouble sum[2], other[2];
    for (int k = 0; k < 2; k++) {
        sum[k] = h[k].large * h[k].half - h[k].size * h[k].square * (14 * CGT_DOUBLE_U * 0x1p32);
        other[k] = spux_double_abs(h[k].product) - h[k].size * (8 * CGT_DOUBLE_U * 0x1p32);
    }
    const vfloat zero = spux_vfloat(0), margin = spux_float_of(sum[0], sum[1]);
    const vmask safe = spu_and(spu_cmpgt(margin, zero), spu_cmpgt(spux_float_of(other[0], other[1]), zero));
    const vmask outside = spu_cmpgt(spux_float_of(h[0].middle, h[1].middle), zero);
    return spu_and(spu_and(safe, outside), spux_cmpge(t, t_min));
}

/* A ray whose t cancels, or is the far root. */
__attribute__((noinline)) static void resolve_sphere_ray(const packet *p, size_t i, const winners *w, bool normal,
                                                         packet_hits *hits, cgt_counts *counts)
{
    const cgt_sphere q = winner_sphere(w, i);
    const double k = 1 / (double)q.r, centre[3] = {q.x, q.y, q.z};
    const cgt_ray ray = {
        .line = {.org = {p->org[0][i], p->org[1][i], p->org[2][i]}, .dir = {p->dir[0][i], p->dir[1][i], p->dir[2][i]}},
        .t_min = p->t_min[i]};
    const cgt_sphere_terms e = cgt_sphere_double_terms(ray.line.org, ray.line.dir, q);
    bool far;
    const double t = cgt_canonical_sphere_t(&ray, q, &far);
    counts->exact_values += cgt_sphere_double_unsafe(e, sqrt(e.disc));
    hits->t[i] = (float)t;
    for (int a = 0; normal && a < 3; a++)
        hits->normal[a][i] = (float)((((double)ray.line.org[a] - centre[a]) + t * (double)ray.line.dir[a]) * k);
}

/* A vector of rays. The outward unit normal is the vector from the centre over the radius. Origin and centre may both be
 * far away: their difference comes first. */
CGT_SPU_INLINE void resolve_spheres_vector(const packet *p, size_t i, bool normal, bool alone, const winners *w,
                                           packet_hits *hits, cgt_counts *counts)
{
    const vmask nobody = spu_cmpeq(spux_load_uint(p->object + i), spux_vuint(CGT_NONE));
    const vmask hit = alone ? spux_not(nobody) : spu_cmpeq(spux_load_uint(w->is_sphere + i), spux_vuint(1));
    vfloat centre[4], org[3], dir[3];
    resolve_half h[2];
    for (int a = 0; a < 4; a++)
        centre[a] = spux_load(w->sphere[a] + i);
    for (int a = 0; a < 3; a++) {
        org[a] = spux_load(p->org[a] + i);
        dir[a] = spux_load(p->dir[a] + i);
        h[0].d[a] = spux_double_low(dir[a]);
        h[1].d[a] = spux_double_high(dir[a]);
    }
    const vdouble r[2] = {spux_double_low(centre[3]), spux_double_high(centre[3])};
    const vdouble o[2][3] = {{spux_double_low(org[0]), spux_double_low(org[1]), spux_double_low(org[2])},
                             {spux_double_high(org[0]), spux_double_high(org[1]), spux_double_high(org[2])}};
    const vdouble c[2][3] = {{spux_double_low(centre[0]), spux_double_low(centre[1]), spux_double_low(centre[2])},
                             {spux_double_high(centre[0]), spux_double_high(centre[1]), spux_double_high(centre[2])}};
    for (int k = 0; k < 2; k++)
        resolve_half_t(o[k], c[k], r[k], &h[k]);
    const vfloat t = spux_float_of(h[0].t, h[1].t);
    spux_store(hits->t + i, spux_select(alone ? spux_vfloat(INFINITY) : spux_load(hits->t + i), t, hit));
    if (normal) {
        const vdouble k[2] = {spux_vdouble(1) / r[0], spux_vdouble(1) / r[1]};
        for (int a = 0; a < 3; a++) {
            const vdouble low = (h[0].t * h[0].d[a] - h[0].c[a]) * k[0], high = (h[1].t * h[1].d[a] - h[1].c[a]) * k[1];
            const vfloat other = alone ? spux_vfloat(0) : spux_load(hits->normal[a] + i);
            spux_store(hits->normal[a] + i, spux_select(other, spux_float_of(low, high), hit));
        }
    }
    const vmask known = resolve_halves_known(h, t, spux_load(p->t_min + i));
    for (unsigned left = spux_mask_bits(spu_andc(hit, known)); left; left &= left - 1)
        resolve_sphere_ray(p, i + (size_t)__builtin_ctz(left), w, normal, hits, counts);
}

CGT_SPU_INLINE void resolve_spheres(const packet *p, size_t first, size_t count, const cgt_trace_settings *settings,
                                    bool alone, const winners *w, packet_hits *hits, cgt_counts *counts)
{
    if (settings->fields & CGT_FIELD_NORMAL)
        for (size_t i = first; i < first + count; i += CGT_LANES)
            resolve_spheres_vector(p, i, true, alone, w, hits, counts);
    else if (settings->fields & CGT_FIELD_T)
        for (size_t i = first; i < first + count; i += CGT_LANES)
            resolve_spheres_vector(p, i, false, alone, w, hits, counts);
}

/* A sphere of radius 0 has no normal of its own: it gets the direction back to the ray's origin. */
static void resolve_points(const cgt_objects *objects, const packet *p, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        if (p->object[i] == CGT_NONE)
            continue;
        const cgt_shape shape = cgt_objects_shape(objects, p->object[i]);
        if (shape.kind != CGT_KIND_SPHERES || shape.sphere.r != 0)
            continue;
        const double x = (double)p->dir[0][i], y = (double)p->dir[1][i], z = (double)p->dir[2][i];
        const double k = -1 / sqrt(x * x + y * y + z * z);
        hits->normal[0][i] = (float)(x * k);
        hits->normal[1][i] = (float)(y * k);
        hits->normal[2][i] = (float)(z * k);
    }
}

#endif
