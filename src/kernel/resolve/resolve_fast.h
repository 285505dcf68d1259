/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * FAST precision. The fields of a packet's hits: t, u and v as the tests left them, normals in single precision. And t
 * and normals of spheres for tiles. */
#ifndef CGT_RESOLVE_FAST_H
#define CGT_RESOLVE_FAST_H

#include "kernel/primitive/lane_vectors.h"
#include "kernel/resolve/hit_primitives.h"

/* A sphere of radius 0 has no normal of its own: it gets the direction towards the ray's origin. */
CGT_SPU_INLINE void fast_normal_of_point(const packet *p, uint32_t i, packet_hits *hits)
{
    const double x = (double)p->dir[0][i], y = (double)p->dir[1][i], z = (double)p->dir[2][i];
    const double k = -1 / sqrt(x * x + y * y + z * z);
    hits->normal[0][i] = (float)(x * k);
    hits->normal[1][i] = (float)(y * k);
    hits->normal[2][i] = (float)(z * k);
}

CGT_SPU_INLINE void fast_normal_of_sphere(const packet *p, uint32_t i, const hit_primitives *w, packet_hits *hits)
{
    if (w->sphere[3][i] == 0) {
        fast_normal_of_point(p, i, hits);
        return;
    }
    const double k = 1 / (double)w->sphere[3][i]; /* finite for denormal radii too */
    for (int a = 0; a < 3; a++)
        hits->normal[a][i] = (float)((double)((p->org[a][i] - w->sphere[a][i]) + p->high[i] * p->dir[a][i]) * k);
}

/* Edges are scaled to keep their products in range. */
CGT_SPU_INLINE void fast_normal_of_triangle(float scale, uint32_t i, const hit_primitives *w, packet_hits *hits)
{
    float e1[3], e2[3], n[3], square = 0;
    for (int a = 0; a < 3; a++) {
        e1[a] = (w->vertex[1][a][i] - w->vertex[0][a][i]) * scale;
        e2[a] = (w->vertex[2][a][i] - w->vertex[0][a][i]) * scale;
    }
    for (int a = 0; a < 3; a++) {
        n[a] = e1[(a + 1) % 3] * e2[(a + 2) % 3] - e1[(a + 2) % 3] * e2[(a + 1) % 3];
        square += n[a] * n[a];
    }
    const float k = square > 0 ? 1 / __builtin_sqrtf(square) : 0;
    for (int a = 0; a < 3; a++)
        hits->normal[a][i] = n[a] * k;
}

__attribute__((unused)) static void fast_normals(const cgt_committed_scene *committed_scene, const packet *p,
                                                 const hit_primitives *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        if (p->prim[i] == CGT_INVALID_ID)
            hits->normal[0][i] = hits->normal[1][i] = hits->normal[2][i] = 0;
        else if (!committed_scene->prims.triangles || w->is_sphere[i])
            fast_normal_of_sphere(p, i, w, hits);
        else
            fast_normal_of_triangle(committed_scene->scale, i, w, hits);
    }
}

__attribute__((unused)) static void resolve_fast(const cgt_committed_scene *committed_scene, const packet *p,
                                                 uint32_t fields, const hit_primitives *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++)
        hits->t[i] = p->prim[i] != CGT_INVALID_ID ? p->high[i] : INFINITY;
    if (fields & CGT_FIELD_UV)
        for (uint32_t i = 0; i < p->lanes; i++) {
            const bool triangle = p->prim[i] != CGT_INVALID_ID && committed_scene->prims.triangles && !w->is_sphere[i];
            hits->u[i] = triangle ? p->u[i] : 0;
            hits->v[i] = triangle ? p->v[i] : 0;
        }
    if (fields & CGT_FIELD_NORMAL)
        fast_normals(committed_scene, p, w, hits);
}

/* ---- spheres, for tiles ---- */

/* t and normals of spheres for tiles in FAST precision: single precision has twice the lanes of double. Which sphere is
 * hit was decided exactly. Lanes that would lose much are left to resolve_sphere_ray. Triangles are not worth it: they
 * wait for their vertices.
 *
 * With u = 2^-24, D = r^2 d.d - |c x d|^2 errs by about 2^3 u r |c| d.d at the silhouette: t |d| is right to some u of
 * the distance in a sphere's middle, and to sqrt(2^3 u r |c|) at its edge. */

CGT_SPU_INLINE void fast_cross(const vfloat p[3], const vfloat q[3], vfloat cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int i = (a + 1) % 3, j = (a + 2) % 3;
        cross[a] = spu_sub(spu_mul(p[i], q[j]), spu_mul(p[j], q[i]));
    }
}

/* Returns the lanes whose sphere is hit from outside, not before t_min. The spheres are hit: a discriminant that
 * rounding made negative counts as 0. */
CGT_SPU_INLINE vmask resolve_fast_spheres(const vfloat org[3], const vfloat dir[3], const vfloat sphere[4],
                                          vfloat t_min, bool normal, vfloat *t, vfloat n[3])
{
    const vfloat zero = spux_vfloat(0), r = sphere[3], rr = spu_mul(r, r);
    vfloat c[3], x[3];
    for (int a = 0; a < 3; a++)
        c[a] = spu_sub(sphere[a], org[a]);
    fast_cross(c, dir, x);
    const vfloat cc = lane_dot(c, c), middle = lane_dot(c, dir), product = spu_sub(cc, rr);
    const vfloat disc = spu_sub(spu_mul(rr, lane_dot(dir, dir)), lane_dot(x, x));
    const vfloat sum = spu_add(middle, spux_sqrt(spux_max(disc, zero)));
    *t = spux_div(product, sum);
    const vmask outside = spu_cmpgt(product, spu_mul(spu_add(cc, rr), spux_vfloat(0x1p-10f)));
    const vmask safe_lanes = spu_and(outside, spu_and(spu_cmpgt(middle, zero), spu_cmpgt(r, spux_vfloat(0x1p-56f))));
    if (normal) {
        const vfloat k = spux_div(spux_vfloat(1), r);
        for (int a = 0; a < 3; a++)
            n[a] = spu_mul(spu_sub(spu_mul(*t, dir[a]), c[a]), k);
    }
    return spu_and(spu_and(safe_lanes, spux_cmpge(*t, t_min)), spu_cmpgt(spux_vfloat(0x1p100f), spu_add(cc, rr)));
}

#endif
