/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t, u, v and normals of the rays that hit triangles. The functions work on some rays at a time, first to
 * first + count - 1; `alone` says that the scene has nothing but triangles. */
#ifndef CGT_RESOLVE_TRIANGLES_H
#define CGT_RESOLVE_TRIANGLES_H

#include "../decide.h"
#include "../triangle_double.h"
#include "winners.h"

CGT_SPU_INLINE bool hits_triangle(const packet *p, const winners *w, size_t i, bool alone)
{
    return (p->object[i] != CGT_NONE) & (alone | (w->is_sphere[i] == 0));
}

/* What the values of some rays have lost more of than they may: they are computed exactly then. */
typedef struct resolve_unsafe {
    uint32_t t[RESOLVE_RAYS], uv[RESOLVE_RAYS], normal[RESOLVE_RAYS]; /* 0 or 1 */
} resolve_unsafe;

CGT_SPU_INLINE uint32_t any_unsafe(const uint32_t unsafe[RESOLVE_RAYS], size_t count)
{
    uint32_t any = 0;
    for (size_t k = 0; k < count; k++)
        any |= unsafe[k];
    return any;
}

/* Between 0 and 1, where the exact value is: rounding may have left it. */
CGT_SPU_INLINE float share_of(double u)
{
    const float rounded = (float)u, low = rounded > 0 ? rounded : 0;
    return low < 1 ? low : 1;
}

CGT_SPU_INLINE void unit_normal(const double n[3], float normal[3])
{
    const double k = 1 / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int a = 0; a < 3; a++)
        normal[a] = (float)(n[a] * k);
}

__attribute__((noinline)) static void resolve_triangles_exactly(const packet *p, size_t first, size_t count,
                                                                uint32_t fields, const resolve_unsafe *unsafe,
                                                                const winners *w, packet_hits *hits, cgt_counts *counts)
{
    for (size_t k = 0; k < count; k++) {
        const size_t i = first + k;
        const cgt_triangle q = winner_triangle(w, i);
        const cgt_ray ray = {.line = {.org = {p->org[0][i], p->org[1][i], p->org[2][i]},
                                      .dir = {p->dir[0][i], p->dir[1][i], p->dir[2][i]}}};
        const bool t = fields & CGT_FIELD_T && unsafe->t[k], uv = fields & CGT_FIELD_UV && unsafe->uv[k];
        counts->exact_values += t || uv;
        if (t)
            hits->t[i] = (float)cgt_canonical_triangle_t(&ray, &q);
        if (uv) {
            double share[2];
            cgt_exact_uv(&ray.line, &q, share);
            hits->u[i] = share_of(share[0]);
            hits->v[i] = share_of(share[1]);
        }
        if (fields & CGT_FIELD_NORMAL && unsafe->normal[k]) {
            double n[3];
            float unit[3];
            cgt_exact_normal(&q, n);
            unit_normal(n, unit);
            for (int a = 0; a < 3; a++)
                hits->normal[a][i] = unit[a];
        }
    }
}

/* The plane of each ray's triangle, as structure of arrays. */
typedef struct resolve_planes {
    _Alignas(64) double num[RESOLVE_RAYS], den[RESOLVE_RAYS], num_error[RESOLVE_RAYS], den_error[RESOLVE_RAYS];
    _Alignas(64) double n[3][RESOLVE_RAYS];
} resolve_planes;

CGT_SPU_INLINE void resolve_triangles_planes(const packet *p, size_t first, size_t count, const winners *w,
                                             resolve_planes *planes)
{
    for (size_t k = 0; k < count; k++) {
        const size_t i = first + k;
        const float org[3] = {p->org[0][i], p->org[1][i], p->org[2][i]};
        const float dir[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
        const cgt_triangle q = winner_triangle(w, i);
        const cgt_triangle_plane e = cgt_triangle_double_plane(org, dir, &q);
        planes->num[k] = e.num;
        planes->den[k] = e.den;
        planes->num_error[k] = e.num_error;
        planes->den_error[k] = e.den_error;
        planes->n[0][k] = e.n[0];
        planes->n[1][k] = e.n[1];
        planes->n[2][k] = e.n[2];
    }
}

CGT_SPU_INLINE void resolve_triangles_t(const packet *p, size_t first, size_t count, bool alone, const winners *w,
                                        const resolve_planes *planes, packet_hits *hits, resolve_unsafe *unsafe)
{
    for (size_t k = 0; k < count; k++) {
        const size_t i = first + k;
        const bool hit = hits_triangle(p, w, i, alone);
        const cgt_triangle_plane e = {planes->num[k], planes->den[k], planes->num_error[k], planes->den_error[k], {0}};
        hits->t[i] = hit ? (float)(planes->num[k] / planes->den[k]) : hits->t[i];
        unsafe->t[k] = hit & !cgt_triangle_double_t_safe(&e);
    }
}

CGT_SPU_INLINE void resolve_triangles_uv(const packet *p, size_t first, size_t count, bool alone, bool exact,
                                         const winners *w, const resolve_planes *planes, packet_hits *hits,
                                         resolve_unsafe *unsafe)
{
    _Alignas(64) double side[2][RESOLVE_RAYS], error[2][RESOLVE_RAYS];
    /* ROBUST does not ask how much of a share is left: any error is below infinity */
    const double more = exact ? 0 : INFINITY;
    for (size_t k = 0; k < count; k++) {
        const size_t i = first + k;
        const float org[3] = {p->org[0][i], p->org[1][i], p->org[2][i]};
        const float dir[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
        const cgt_triangle q = winner_triangle(w, i);
        const cgt_triangle_sides s = cgt_triangle_double_sides(org, dir, &q);
        side[0][k] = s.w[1];
        side[1][k] = s.w[2];
        error[0][k] = s.error[1];
        error[1][k] = s.error[2];
    }
    for (size_t k = 0; k < count; k++) {
        const size_t i = first + k;
        const double r = 1 / planes->den[k];
        const float u = share_of(side[0][k] * r), v = share_of(side[1][k] * r);
        const bool hit = hits_triangle(p, w, i, alone);
        hits->u[i] = hit ? u : 0;
        hits->v[i] = hit ? v : 0;
    }
    for (size_t k = 0; k < count; k++) {
        const uint32_t den = planes->den_error[k] <= CGT_DOUBLE_SAFE * fabs(planes->den[k]) ? 0 : 1;
        const uint32_t u = error[0][k] <= CGT_DOUBLE_SAFE * fabs(side[0][k]) + more ? 0 : 1;
        const uint32_t v = error[1][k] <= CGT_DOUBLE_SAFE * fabs(side[1][k]) + more ? 0 : 1;
        unsafe->uv[k] = hits_triangle(p, w, first + k, alone) ? den | u | v : 0;
    }
}

/* |e1|_1 |e2|_1, which bounds what the components of their cross product are made of. */
CGT_SPU_INLINE double edge_product(const winners *w, size_t i)
{
    double size[2] = {0, 0};
    for (int k = 0; k < 2; k++)
        for (int a = 0; a < 3; a++)
            size[k] += fabs((double)w->vertex[k + 1][a][i] - (double)w->vertex[0][a][i]);
    return size[0] * size[1];
}

CGT_SPU_INLINE void resolve_triangles_normal(const packet *p, size_t first, size_t count, bool alone, bool exact,
                                             const winners *w, const resolve_planes *planes, packet_hits *hits,
                                             resolve_unsafe *unsafe)
{
    for (size_t k = 0; k < count; k++) {
        const size_t i = first + k;
        const double x = planes->n[0][k], y = planes->n[1][k], z = planes->n[2][k];
        const double r = 1 / sqrt(x * x + y * y + z * z);
        const bool hit = hits_triangle(p, w, i, alone);
        hits->normal[0][i] = hit ? (float)(x * r) : hits->normal[0][i];
        hits->normal[1][i] = hit ? (float)(y * r) : hits->normal[1][i];
        hits->normal[2][i] = hit ? (float)(z * r) : hits->normal[2][i];
        /* a component that is exactly 0 is as good as it gets where its products are too */
        const double error = CGT_TRIANGLE_DOUBLE_ERROR * edge_product(w, i), least = CGT_DOUBLE_SAFE * fabs(x),
                     least_y = CGT_DOUBLE_SAFE * fabs(y), least_z = CGT_DOUBLE_SAFE * fabs(z);
        const bool each = (error <= least) & (error <= least_y) & (error <= least_z);
        unsafe->normal[k] = hit & (exact ? !each : !(error <= least + least_y + least_z));
    }
}

CGT_SPU_INLINE void resolve_triangles(const packet *p, size_t first, size_t count, const cgt_trace_settings *settings,
                                      bool alone, const winners *w, packet_hits *hits, cgt_counts *counts)
{
    const uint32_t fields = settings->fields;
    const bool exact = settings->precision == CGT_PRECISION_EXACT;
    resolve_planes planes;
    resolve_unsafe unsafe;
    uint32_t any = 0;
    if (!(fields & (CGT_FIELD_T | CGT_FIELD_NORMAL | CGT_FIELD_UV)))
        return;
    resolve_triangles_planes(p, first, count, w, &planes);
    if (fields & CGT_FIELD_T) {
        resolve_triangles_t(p, first, count, alone, w, &planes, hits, &unsafe);
        any |= any_unsafe(unsafe.t, count);
    }
    if (fields & CGT_FIELD_UV) {
        resolve_triangles_uv(p, first, count, alone, exact, w, &planes, hits, &unsafe);
        any |= any_unsafe(unsafe.uv, count);
    }
    if (fields & CGT_FIELD_NORMAL) {
        resolve_triangles_normal(p, first, count, alone, exact, w, &planes, hits, &unsafe);
        any |= any_unsafe(unsafe.normal, count);
    }
    if (any)
        resolve_triangles_exactly(p, first, count, fields, &unsafe, w, hits, counts);
}

#endif
