/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray through bands, without a task or scratch memory: what a chunk of band_trace.c does for each of its rays. */
#include <float.h>

#include "query/ray_intake.h"
#include "trace/bands/band_trace.h"

/* The scaled ray as a band's kernel takes it; skip: room for what it names. Its range may end at 0, which stands for no
 * end there: it ends at the next float, and a hit there is dropped as others are that lie in the scaled range alone. */
static cgt_single_ray single_of(const cgt_band *band, const cgt_band_ray *ray, const cgt_scaled_ray *scaled,
                                cgt_hit *skip)
{
    cgt_single_ray single = {
        .t_min = scaled->t_min, .t_max = scaled->t_max == 0 ? FLT_TRUE_MIN : scaled->t_max, .mask = ray->mask};
    memcpy(single.org, scaled->org, sizeof single.org);
    memcpy(single.dir, scaled->dir, sizeof single.dir);
    if (ray->skip != CGT_INVALID_ID) {
        cgt_band_scale_skip(band, ray->skip, &skip->primitive, &skip->geometry);
        single.skip = skip;
    }
    return single;
}

/* The t that a band's kernel tells of a hit. */
static float scaled_t(const cgt_band *band, const cgt_scaled_ray *scaled, uint32_t prim)
{
    cgt_ray ray = {.t_min = scaled->t_min, .t_max = scaled->t_max};
    cgt_decided_hit hit = {.primitive = cgt_primitives_get(&band->scene->committed_scene.prims, prim)};
    memcpy(ray.line.org, scaled->org, sizeof ray.line.org);
    memcpy(ray.line.dir, scaled->dir, sizeof ray.line.dir);
    cgt_decide_t(&ray, &hit);
    return (float)hit.t;
}

static void trace_band(const cgt_scene *scene, const cgt_band *band, const cgt_band_ray *ray, bool use_bvh,
                       bool any_hit, cgt_band_best *best, cgt_counts *counts)
{
    const cgt_primitives *prims = &scene->committed_scene.prims;
    const cgt_committed_scene *committed_scene = &band->scene->committed_scene;
    const uint32_t *number = band->number.data;
    const bool bvh = use_bvh || committed_scene->structure == CGT_STRUCTURE_BVH;
    const double t_end = cgt_band_end(&ray->ray, best);
    cgt_scaled_ray scaled;
    cgt_counts own = {0};
    if (!committed_scene->valid ||
        (scene->bands->count + scene->bands->rest > 1 && cgt_band_misses_box(band, &ray->ray, t_end)))
        return;
    switch (cgt_band_scale_ray(band, &ray->ray, t_end,
                               any_hit && bvh ? CGT_BAND_ANY_DIR_EXPONENT : CGT_BAND_DIR_EXPONENT, &scaled)) {
    case CGT_BAND_MISSED: return;
    case CGT_BAND_AS_GIVEN: cgt_band_decide(prims, number, band->count, ray, any_hit, best, counts); return;
    case CGT_BAND_SCALED: break;
    }
    const bool is_any = any_hit && !scaled.exponent;
    cgt_hit skip;
    const cgt_single_ray single = single_of(band, ray, &scaled, &skip);
    const uint32_t prim = scene->context->kernel->trace_one_ray(committed_scene, &single, use_bvh, is_any, &own);
    cgt_band_add_counts(counts, &own);
    if (prim == CGT_INVALID_ID)
        return;
    if (is_any)
        best->prim = number[prim];
    else
        cgt_band_accept(prims, band, ray, number[prim], scaled_t(band, &scaled, prim), scaled.exponent, best, counts);
}

uint32_t cgt_bands_trace_one(const cgt_scene *scene, const cgt_single_ray *from, const bool *use_bvh, bool any_hit,
                             cgt_counts *counts)
{
    const struct cgt_bands *bands = scene->bands;
    const cgt_primitives *prims = &scene->committed_scene.prims;
    cgt_band_ray ray = {
        .ray = ray_of_single(from), .mask = from->mask ? from->mask : UINT32_MAX, .skip = CGT_INVALID_ID};
    cgt_band_best best = {CGT_INVALID_ID, INFINITY};
    const ray_state state = ray_classify(&ray.ray, &RAY_NO_LIMITS);
    if (from->skip && from->skip->primitive != CGT_INVALID_ID)
        ray.skip = cgt_primitives_number(prims, from->skip->geometry, from->skip->primitive);
    counts->rays++;
    counts->invalid_rays += state == RAY_INVALID;
    if (state != RAY_PLAIN)
        return CGT_INVALID_ID;
    for (uint32_t b = 0; b < bands->count && !(any_hit && best.prim != CGT_INVALID_ID); b++)
        trace_band(scene, &bands->band[b], &ray, use_bvh[b], any_hit, &best, counts);
    if (!(any_hit && best.prim != CGT_INVALID_ID))
        cgt_band_decide(prims, bands->rest_number.data, bands->rest, &ray, any_hit, &best, counts);
    counts->hits += best.prim != CGT_INVALID_ID;
    return best.prim;
}
