/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The first hits of one ray through bands: each band lists its own, some at a time, of the scaled ray. They are decided
 * again for the ray as given, which drops those of the scaled range alone, and listed with those of the other bands. */
#include "query/hit_list.h"
#include "trace/bands/band_trace.h"

#define OWN_HITS 16u /* of a band, at a time */

/* A t that no hit to be found is beyond. */
static double end_of(const cgt_hit_list *list)
{
    const cgt_band_best none = {.prim = CGT_INVALID_ID};
    if (!cgt_hit_list_is_bounded(list))
        return cgt_band_end(list->ray, &none);
    return cgt_band_end(list->ray, &(cgt_band_best){.t = list->hit[list->count - 1].t});
}

static void decide_all(cgt_hit_list *list, const uint32_t *number, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (!cgt_hit_list_skips(list, number[i]))
            cgt_hit_list_decide(list, number[i], CGT_BOTH_SIDES);
}

/* Whether the list needs no hit that comes after this one. */
static bool is_last(cgt_hit_list *list, uint32_t prim, bool far)
{
    cgt_hit_list at = *list;
    return cgt_hit_list_is_bounded(list) && cgt_hit_list_set_after(&at, prim, far) &&
           cgt_hit_list_compare(list, &at.after, &list->hit[list->count - 1]) >= 0;
}

/* Lists the hits of the scaled ray. */
static void list_scaled(const cgt_band *band, const cgt_kernel *kernel, bool use_bvh, const cgt_scaled_ray *scaled,
                        cgt_hit_list *list, cgt_counts *counts)
{
    const cgt_committed_scene *scene = &band->scene->committed_scene;
    const uint32_t *number = band->number.data;
    cgt_ray ray = {.t_min = scaled->t_min, .t_max = scaled->t_max};
    cgt_listed_hit hit[OWN_HITS];
    cgt_hit_list own = {.prims = &scene->prims,
                        .ray = &ray,
                        .skip = CGT_INVALID_ID, /* of the scene's numbers */
                        .mask = list->mask,
                        .hit = hit,
                        .capacity = OWN_HITS,
                        .wants_more = true};
    memcpy(ray.line.org, scaled->org, sizeof ray.line.org);
    memcpy(ray.line.dir, scaled->dir, sizeof ray.line.dir);
    do {
        own.count = 0;
        own.more = false;
        kernel->list_hits(scene, use_bvh, &own, 1, counts);
        for (uint32_t i = 0; i < own.count; i++)
            if (number[hit[i].prim] != list->skip)
                cgt_hit_list_decide(list, number[hit[i].prim], hit[i].far ? CGT_FAR_SIDE : CGT_NEAR_SIDE);
    } while (own.more && !is_last(list, number[hit[own.count - 1].prim], hit[own.count - 1].far) &&
             cgt_hit_list_set_after(&own, hit[own.count - 1].prim, hit[own.count - 1].far));
    list->double_tests += own.double_tests;
    list->exact_tests += own.exact_tests;
}

void cgt_bands_list(const cgt_scene *scene, const bool *use_bvh, cgt_hit_list *list, cgt_counts *counts)
{
    const struct cgt_bands *bands = scene->bands;
    cgt_ray ray = *list->ray; /* from `after` on */
    cgt_hit_list_set_units(list, 1, 0);
    if (list->has_after) {
        const float first = nextafterf((float)list->after.t, -INFINITY);
        ray.t_min = first > ray.t_min ? first : ray.t_min;
    }
    for (uint32_t b = 0; b < bands->count && ray.t_min <= ray.t_max; b++) {
        const cgt_band *band = &bands->band[b];
        const double t_end = end_of(list);
        cgt_scaled_ray scaled;
        cgt_counts own = {.scratch = counts->scratch};
        if (!band->scene->committed_scene.valid ||
            (bands->count + bands->rest > 1 && cgt_band_misses_box(band, &ray, t_end)))
            continue;
        const cgt_band_state state = cgt_band_scale_ray(band, &ray, t_end, CGT_BAND_DIR_EXPONENT, &scaled);
        if (state == CGT_BAND_SCALED)
            list_scaled(band, scene->context->kernel, use_bvh[b], &scaled, list, &own);
        else if (state == CGT_BAND_AS_GIVEN)
            decide_all(list, band->number.data, band->count);
        cgt_band_add_counts(counts, &own);
    }
    if (bands->rest)
        decide_all(list, bands->rest_number.data, bands->rest);
}
