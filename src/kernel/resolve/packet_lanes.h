/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The fields of a vector of a packet's rays: in precision FAST in single precision first, what that does not cover, and
 * all else, in double, and the rest ray by ray. single_kind: the scene has no other kind. */
#ifndef CGT_PACKET_LANES_H
#define CGT_PACKET_LANES_H

#include "kernel/resolve/fast_spheres.h"
#include "kernel/resolve/fast_triangles.h"
#include "kernel/resolve/hit_primitives.h"
#include "kernel/resolve/resolve_capsules.h"
#include "kernel/resolve/resolve_spheres.h"

/* The rays of a vector: the first is i. */
typedef struct packet_rays {
    vfloat org[3], dir[3], t_min, t_max;
} packet_rays;

CGT_SPU_INLINE packet_rays packet_load_rays(const packet *p, size_t i)
{
    packet_rays r = {.t_min = spux_load(p->t_min + i), .t_max = spux_load(p->t_max + i)};
    for (int a = 0; a < 3; a++) {
        r.org[a] = spux_load(p->org[a] + i);
        r.dir[a] = spux_load(p->dir[a] + i);
    }
    return r;
}

CGT_SPU_INLINE cgt_ray packet_ray(const packet *p, size_t i)
{
    return (cgt_ray){
        .line = {.org = {p->org[0][i], p->org[1][i], p->org[2][i]}, .dir = {p->dir[0][i], p->dir[1][i], p->dir[2][i]}},
        .t_min = p->t_min[i]};
}

/* ---- spheres ---- */

/* In double, by the short formula, then by the long one. Returns the lanes whose result is right. */
CGT_SPU_INLINE vmask packet_spheres_double(const packet_rays *r, const vfloat sphere[4], bool normal, vmask hit,
                                           vfloat *t, vfloat n[3])
{
    resolve_half h[2];
    resolve_directions(r->dir, h);
    const vmask safe_lanes = resolve_spheres_vector(r->org, sphere, r->t_min, normal, hit, h, t, n);
    return resolve_spheres_fallback(r->org, r->dir, sphere, r->t_min, normal, hit, safe_lanes, t, n);
}

CGT_SPU_INLINE vmask packet_spheres_fast(const packet_rays *r, const vfloat sphere[4], bool normal, vmask hit,
                                         vfloat *t, vfloat n[3])
{
    const fast_sphere s = fast_sphere_prepare(r->org, sphere);
    const vmask covered =
        fast_sphere_resolve(&s, r->dir, fast_inverse_square(r->dir), r->t_min, r->t_max, normal, t, n);
    const vmask left = spu_andc(hit, covered);
    if (!spux_any(left))
        return covered;
    vfloat double_t, double_n[3];
    const vmask safe_lanes = packet_spheres_double(r, sphere, normal, left, &double_t, double_n);
    *t = spux_select(double_t, *t, covered);
    for (int a = 0; normal && a < 3; a++)
        n[a] = spux_select(double_n[a], n[a], covered);
    return spu_or(covered, safe_lanes);
}

/* Rays i to i + CGT_LANES - 1 of a packet. */
CGT_SPU_INLINE void packet_resolve_spheres(const packet *p, size_t i, bool normal, bool fast, bool single_kind,
                                           const hit_primitives *w, packet_hits *hits, cgt_counts *counts)
{
    const vmask no_hit = spu_cmpeq(spux_load_uint(p->prim + i), spux_vuint(CGT_INVALID_ID));
    const vmask hit =
        single_kind ? spux_not(no_hit) : spu_cmpeq(spux_load_uint(w->kind + i), spux_vuint(CGT_KIND_SPHERES));
    const packet_rays r = packet_load_rays(p, i);
    vfloat sphere[4], n[3], t;
    for (int a = 0; a < 4; a++)
        sphere[a] = spux_load(w->sphere[a] + i);
    const vmask safe_lanes = fast ? packet_spheres_fast(&r, sphere, normal, hit, &t, n)
                                  : packet_spheres_double(&r, sphere, normal, hit, &t, n);
    spux_store(hits->t + i, spux_select(single_kind ? spux_vfloat(INFINITY) : spux_load(hits->t + i), t, hit));
    for (int a = 0; normal && a < 3; a++) {
        const vfloat previous = single_kind ? spux_vfloat(0) : spux_load(hits->normal[a] + i);
        spux_store(hits->normal[a] + i, spux_select(previous, n[a], hit));
    }
    /* what is left, ray by ray */
    for (unsigned remaining = spux_mask_bits(spu_andc(hit, safe_lanes)); remaining; remaining &= remaining - 1) {
        const size_t lane = i + (size_t)__builtin_ctz(remaining);
        const cgt_ray ray = packet_ray(p, lane);
        const resolved_sphere s = resolve_sphere_ray(&ray, hit_primitive_sphere(w, lane), counts);
        hits->t[lane] = s.t;
        for (int a = 0; normal && a < 3; a++)
            hits->normal[a][lane] = s.normal[a];
    }
}

CGT_SPU_INLINE void resolve_spheres(const packet *p, size_t first, size_t count, const cgt_trace_settings *settings,
                                    bool single_kind, const hit_primitives *w, packet_hits *hits, cgt_counts *counts)
{
    const bool fast = settings->precision == CGT_PRECISION_FAST;
    if (settings->fields & CGT_FIELD_NORMAL)
        for (size_t i = first; i < first + count; i += CGT_LANES)
            packet_resolve_spheres(p, i, true, fast, single_kind, w, hits, counts);
    else if (settings->fields & CGT_FIELD_T)
        for (size_t i = first; i < first + count; i += CGT_LANES)
            packet_resolve_spheres(p, i, false, fast, single_kind, w, hits, counts);
}

/* ---- triangles ---- */

__attribute__((noinline)) static void resolve_triangle_lane(const packet *p, size_t i, uint32_t fields,
                                                            const hit_primitives *w, packet_hits *hits,
                                                            cgt_counts *counts)
{
    const cgt_triangle q = hit_primitive_triangle(w, i);
    const cgt_ray ray = packet_ray(p, i);
    const resolved_triangle h = resolve_triangle_ray(&ray, &q, fields, counts);
    if (fields & CGT_FIELD_T)
        hits->t[i] = h.t;
    if (fields & CGT_FIELD_UV) {
        hits->u[i] = h.u;
        hits->v[i] = h.v;
    }
    for (int a = 0; fields & CGT_FIELD_NORMAL && a < 3; a++)
        hits->normal[a][i] = h.normal[a];
}

CGT_SPU_INLINE vmask packet_triangles_fast(const packet_rays *r, const vfloat vertex[3][3], uint32_t fields, vmask hit,
                                           resolved_triangles *h)
{
    const fast_triangle q = fast_triangle_prepare(r->org, vertex);
    const vmask covered = fast_triangle_resolve(&q, r->dir, r->t_min, r->t_max, fields, h);
    if (spux_none(spu_andc(hit, covered)))
        return covered;
    resolved_triangles g = *h;
    const vmask safe_lanes = resolve_triangles_vector(r->org, r->dir, vertex, fields, &g);
    *h = resolved_triangles_select(&g, h, covered);
    return spu_or(covered, safe_lanes);
}

/* Rays i to i + CGT_LANES - 1 of a packet. */
CGT_SPU_INLINE void packet_resolve_triangles(const packet *p, size_t i, uint32_t fields, bool fast, bool single_kind,
                                             const hit_primitives *w, packet_hits *hits, cgt_counts *counts)
{
    const vmask no_hit = spu_cmpeq(spux_load_uint(p->prim + i), spux_vuint(CGT_INVALID_ID));
    const vmask hit = single_kind
                          ? spux_not(no_hit)
                          : spu_andc(spu_cmpeq(spux_load_uint(w->kind + i), spux_vuint(CGT_KIND_TRIANGLES)), no_hit);
    const packet_rays r = packet_load_rays(p, i);
    const vfloat zero = spux_vfloat(0);
    vfloat vertex[3][3];
    resolved_triangles h = {zero, zero, zero, {zero, zero, zero}};
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < 3; k++)
            vertex[k][a] = spux_load(w->vertex[k][a] + i);
    const vmask safe_lanes = fast ? packet_triangles_fast(&r, vertex, fields, hit, &h)
                                  : resolve_triangles_vector(r.org, r.dir, vertex, fields, &h);
    if (fields & CGT_FIELD_T)
        spux_store(hits->t + i, spux_select(spux_load(hits->t + i), h.t, hit));
    if (fields & CGT_FIELD_UV) {
        spux_store(hits->u + i, spux_select(spux_load(hits->u + i), h.u, hit));
        spux_store(hits->v + i, spux_select(spux_load(hits->v + i), h.v, hit));
    }
    for (int a = 0; fields & CGT_FIELD_NORMAL && a < 3; a++)
        spux_store(hits->normal[a] + i, spux_select(spux_load(hits->normal[a] + i), h.normal[a], hit));
    for (unsigned remaining = spux_mask_bits(spu_andc(hit, safe_lanes)); remaining; remaining &= remaining - 1)
        resolve_triangle_lane(p, i + (size_t)__builtin_ctz(remaining), fields, w, hits, counts);
}

CGT_SPU_INLINE void resolve_triangles(const packet *p, size_t first, size_t count, const cgt_trace_settings *settings,
                                      bool single_kind, const hit_primitives *w, packet_hits *hits, cgt_counts *counts)
{
    const uint32_t fields = settings->fields;
    const bool fast = settings->precision == CGT_PRECISION_FAST;
    if (!(fields & (CGT_FIELD_T | CGT_FIELD_NORMAL | CGT_FIELD_UV)))
        return;
    for (size_t i = first; i < first + count; i += CGT_LANES)
        packet_resolve_triangles(p, i, fields, fast, single_kind, w, hits, counts);
}

/* ---- capsules ---- */

CGT_SPU_INLINE void resolve_capsule_lane(const packet *p, size_t i, uint32_t fields, const hit_primitives *w,
                                         packet_hits *hits)
{
    const cgt_capsule q = hit_primitive_capsule(w, i);
    const cgt_ray ray = packet_ray(p, i);
    const resolved_capsule h = resolve_capsule_ray(&ray, &q);
    hits->t[i] = h.t;
    if (fields & CGT_FIELD_UV)
        hits->u[i] = h.u;
    for (int a = 0; fields & CGT_FIELD_NORMAL && a < 3; a++)
        hits->normal[a][i] = h.normal[a];
}

/* Rays i to i + CGT_LANES - 1 of a packet. Not inlined: scenes without capsules do not pay for its registers. */
__attribute__((noinline, unused)) static void packet_resolve_capsules(const packet *p, size_t i, uint32_t fields,
                                                                      const hit_primitives *w, packet_hits *hits)
{
    const vmask hit = spu_cmpeq(spux_load_uint(w->kind + i), spux_vuint(CGT_KIND_CAPSULES));
    const packet_rays r = packet_load_rays(p, i);
    const vfloat zero = spux_vfloat(0);
    vfloat end[2][3];
    resolved_capsules h = {zero, zero, {zero, zero, zero}};
    if (!spux_any(hit))
        return;
    for (int k = 0; k < 2; k++)
        for (int a = 0; a < 3; a++)
            end[k][a] = spux_load(w->vertex[k][a] + i);
    const vmask safe_lanes =
        resolve_capsules_vector(r.org, r.dir, end[0], end[1], spux_load(w->sphere[3] + i), r.t_min, fields, hit, &h);
    spux_store(hits->t + i, spux_select(spux_load(hits->t + i), h.t, hit));
    if (fields & CGT_FIELD_UV)
        spux_store(hits->u + i, spux_select(spux_load(hits->u + i), h.u, hit));
    for (int a = 0; fields & CGT_FIELD_NORMAL && a < 3; a++)
        spux_store(hits->normal[a] + i, spux_select(spux_load(hits->normal[a] + i), h.normal[a], hit));
    for (unsigned remaining = spux_mask_bits(spu_andc(hit, safe_lanes)); remaining; remaining &= remaining - 1)
        resolve_capsule_lane(p, i + (size_t)__builtin_ctz(remaining), fields, w, hits);
}

CGT_SPU_INLINE void resolve_capsules(const packet *p, size_t first, size_t count, const cgt_trace_settings *settings,
                                     const hit_primitives *w, packet_hits *hits)
{
    if (settings->fields & (CGT_FIELD_T | CGT_FIELD_NORMAL | CGT_FIELD_UV))
        for (size_t i = first; i < first + count; i += CGT_LANES)
            packet_resolve_capsules(p, i, settings->fields, w, hits);
}

#endif
