/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See hit_lists.h. */
#include "trace/hit_lists.h"

cgt_result cgt_check_crossings(const cgt_scene *scene)
{
    if (!scene->committed_scene.prims.capsules)
        return CGT_OK;
    return cgt_fail(scene->context, CGT_ERROR_UNSUPPORTED, "crossings: the scene has capsules, which have none");
}

cgt_result cgt_ready_lists(const cgt_scene *scene, uint64_t rays, cgt_trace_settings *settings, cgt_band_call *bands)
{
    if (!scene->in_bands)
        return cgt_ready_structures(scene, rays, settings);
    bands->scene = scene;
    return cgt_bands_build_bvh(bands, rays);
}

bool cgt_lists_use_bvh(const cgt_scene *scene, const cgt_trace_settings *settings, const cgt_band_call *bands)
{
    bool uses = !scene->in_bands && settings->use_bvh;
    for (uint32_t b = 0; scene->in_bands && b < scene->bands->count; b++)
        uses |= bands->use_bvh[b];
    return uses;
}

void cgt_list_rays(const cgt_scene *scene, const cgt_trace_settings *settings, const cgt_band_call *bands,
                   cgt_hit_list *lists, uint32_t count, cgt_counts *counts)
{
    if (!scene->in_bands)
        scene->context->kernel->list_hits(&scene->committed_scene, settings->use_bvh, lists, count, counts);
    for (uint32_t k = 0; k < count && scene->in_bands; k++)
        cgt_bands_list(scene, bands->use_bvh, &lists[k], counts);
}
