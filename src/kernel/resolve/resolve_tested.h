/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hits that were tested in single precision, without bounds: research alone asks for it (cgt_triangle_test). Rays that
 * slip through an edge have no values in exact arithmetic: t, u and v are what the tests left, normals are computed in
 * single precision. */
#ifndef CGT_RESOLVE_TESTED_H
#define CGT_RESOLVE_TESTED_H

#include "kernel/primitive/lane_vectors.h"
#include "kernel/resolve/hit_primitives.h"

/* A sphere of radius 0 has no normal of its own: it gets the direction towards the ray's origin. */
CGT_SPU_INLINE void tested_normal_of_point(const packet *p, uint32_t i, packet_hits *hits)
{
    const double x = (double)p->dir[0][i], y = (double)p->dir[1][i], z = (double)p->dir[2][i];
    const double k = -1 / sqrt(x * x + y * y + z * z);
    hits->normal[0][i] = (float)(x * k);
    hits->normal[1][i] = (float)(y * k);
    hits->normal[2][i] = (float)(z * k);
}

CGT_SPU_INLINE void tested_normal_of_sphere(const packet *p, uint32_t i, const hit_primitives *w, packet_hits *hits)
{
    if (w->sphere[3][i] == 0) {
        tested_normal_of_point(p, i, hits);
        return;
    }
    const double k = 1 / (double)w->sphere[3][i]; /* finite for denormal radii too */
    for (int a = 0; a < 3; a++)
        hits->normal[a][i] = (float)((double)((p->org[a][i] - w->sphere[a][i]) + p->high[i] * p->dir[a][i]) * k);
}

/* Edges are scaled to keep their products in range. */
CGT_SPU_INLINE void tested_normal_of_triangle(float scale, uint32_t i, const hit_primitives *w, packet_hits *hits)
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

__attribute__((unused)) static void tested_normals(const cgt_committed_scene *committed_scene, const packet *p,
                                                   const hit_primitives *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        if (p->prim[i] == CGT_INVALID_ID)
            hits->normal[0][i] = hits->normal[1][i] = hits->normal[2][i] = 0;
        else if (!committed_scene->prims.triangles || w->kind[i] == CGT_KIND_SPHERES)
            tested_normal_of_sphere(p, i, w, hits);
        else
            tested_normal_of_triangle(committed_scene->scale, i, w, hits);
    }
}

__attribute__((unused)) static void resolve_tested(const cgt_committed_scene *committed_scene, const packet *p,
                                                   uint32_t fields, const hit_primitives *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++)
        hits->t[i] = p->prim[i] != CGT_INVALID_ID ? p->high[i] : INFINITY;
    if (fields & CGT_FIELD_UV)
        for (uint32_t i = 0; i < p->lanes; i++) {
            const bool triangle =
                p->prim[i] != CGT_INVALID_ID && committed_scene->prims.triangles && w->kind[i] == CGT_KIND_TRIANGLES;
            hits->u[i] = triangle ? p->u[i] : 0;
            hits->v[i] = triangle ? p->v[i] : 0;
        }
    if (fields & CGT_FIELD_NORMAL)
        tested_normals(committed_scene, p, w, hits);
}

#endif
