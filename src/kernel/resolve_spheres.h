/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t and normals of the rays that hit spheres. The functions work on some rays at a time, first to first + count - 1;
 * `alone` says that the scene has nothing but spheres. */
#ifndef CGT_RESOLVE_SPHERES_H
#define CGT_RESOLVE_SPHERES_H

#include "../decide.h"
#include "../sphere_double.h"
#include "winners.h"

CGT_SPU_INLINE bool hits_sphere(const packet *p, const winners *w, size_t i, bool alone)
{
    return alone ? p->object[i] != CGT_NONE : w->is_sphere[i] != 0;
}

/* Rays whose t cancels; they are rare. */
__attribute__((noinline)) static void resolve_spheres_exactly(const packet *p, size_t first, size_t count,
                                                              const uint64_t unsafe[RESOLVE_RAYS], bool alone,
                                                              winners *w, cgt_counts *counts)
{
    for (size_t i = first; i < first + count; i++) {
        const cgt_ray ray = {.line = {.org = {p->org[0][i], p->org[1][i], p->org[2][i]},
                                      .dir = {p->dir[0][i], p->dir[1][i], p->dir[2][i]}},
                             .t_min = p->t_min[i]};
        if (!unsafe[i - first] || !hits_sphere(p, w, i, alone))
            continue;
        bool far;
        w->t[i] = cgt_canonical_sphere_t(&ray, winner_sphere(w, i), &far);
        counts->exact_values++;
    }
}

CGT_SPU_INLINE void resolve_spheres_t(const packet *p, size_t first, size_t count, bool alone, winners *w,
                                      cgt_counts *counts)
{
    _Alignas(64) double middle[RESOLVE_RAYS], product[RESOLVE_RAYS], half2[RESOLVE_RAYS], size[RESOLVE_RAYS];
    _Alignas(64) double near[RESOLVE_RAYS], far[RESOLVE_RAYS];
    uint64_t unsafe[RESOLVE_RAYS], any = 0;
    /* loops of a few numbers: all of it at once has more than a machine has registers */
    for (size_t k = 0; k < count; k++) {
        const size_t i = first + k;
        const float org[3] = {p->org[0][i], p->org[1][i], p->org[2][i]};
        const float dir[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
        const cgt_sphere_terms e = cgt_sphere_double_terms(org, dir, winner_sphere(w, i));
        middle[k] = e.middle;
        product[k] = e.product;
        half2[k] = e.half2;
        size[k] = e.size;
    }
    for (size_t k = 0; k < count; k++) {
        const cgt_sphere_roots root = cgt_sphere_double_roots(middle[k], product[k], half2[k]);
        near[k] = root.near;
        far[k] = root.far;
    }
    for (size_t k = 0; k < count; k++)
        w->t[first + k] = (float)near[k] >= p->t_min[first + k] ? near[k] : far[k];
    for (size_t k = 0; k < count; k++)
        unsafe[k] = cgt_sphere_double_unsafe((cgt_sphere_terms){middle[k], product[k], half2[k], size[k]});
    for (size_t k = 0; k < count; k++)
        any |= hits_sphere(p, w, first + k, alone) ? unsafe[k] : 0;
    if (any)
        resolve_spheres_exactly(p, first, count, unsafe, alone, w, counts);
}

/* The outward unit normal is the vector from the centre over the radius. Origin and centre may both be far away: their
 * difference comes first. */
CGT_SPU_INLINE void resolve_spheres_normal(const packet *p, size_t first, size_t count, bool alone, const winners *w,
                                           packet_hits *hits)
{
    for (size_t i = first; i < first + count; i++) {
        const double t = w->t[i], k = 1 / (double)w->sphere[3][i];
        const double x = ((double)p->org[0][i] - (double)w->sphere[0][i]) + t * (double)p->dir[0][i];
        const double y = ((double)p->org[1][i] - (double)w->sphere[1][i]) + t * (double)p->dir[1][i];
        const double z = ((double)p->org[2][i] - (double)w->sphere[2][i]) + t * (double)p->dir[2][i];
        const bool hit = hits_sphere(p, w, i, alone);
        hits->normal[0][i] = hit ? (float)(x * k) : alone ? 0 : hits->normal[0][i];
        hits->normal[1][i] = hit ? (float)(y * k) : alone ? 0 : hits->normal[1][i];
        hits->normal[2][i] = hit ? (float)(z * k) : alone ? 0 : hits->normal[2][i];
    }
}

CGT_SPU_INLINE void resolve_spheres(const packet *p, size_t first, size_t count, const cgt_trace_settings *settings,
                                    bool alone, winners *w, packet_hits *hits, cgt_counts *counts)
{
    if (!(settings->fields & (CGT_FIELD_T | CGT_FIELD_NORMAL)))
        return;
    resolve_spheres_t(p, first, count, alone, w, counts);
    for (size_t i = first; i < first + count; i++)
        hits->t[i] = hits_sphere(p, w, i, alone) ? (float)w->t[i] : alone ? INFINITY : hits->t[i];
    if (settings->fields & CGT_FIELD_NORMAL)
        resolve_spheres_normal(p, first, count, alone, w, hits);
}

/* A sphere of radius 0 has no normal of its own: it gets the direction back to the ray's origin. */
static void resolve_points(const packet *p, bool alone, const winners *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        if (!hits_sphere(p, w, i, alone) || w->sphere[3][i] != 0)
            continue;
        const double x = (double)p->dir[0][i], y = (double)p->dir[1][i], z = (double)p->dir[2][i];
        const double k = -1 / sqrt(x * x + y * y + z * z);
        hits->normal[0][i] = (float)(x * k);
        hits->normal[1][i] = (float)(y * k);
        hits->normal[2][i] = (float)(z * k);
    }
}

#endif
