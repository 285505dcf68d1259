/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The commit of a scene in bands: 1 classes of magnitudes   2 the plan   3 copies   4 a scene for each band, by the
 * ordinary commit. A band's scene has a geometry for each array of the whole one, in the same order, so that masks and
 * the order of primitives stay. All memory is kept for the next commit. */
#include "builders/bands/bands_commit.h"

#include <math.h>
#include <stdio.h>

#include "core/error.h"

static cgt_result fail_memory(const cgt_scene *scene, cgt_result result)
{
    return cgt_fail(scene->context, result, "commit: out of memory for bands of %u primitives",
                    scene->committed_scene.prims.count);
}

static cgt_result reserve(const cgt_scene *scene, cgt_buffer *buffer, size_t count, size_t size)
{
    const cgt_result result = cgt_buffer_reserve(&scene->context->memory, buffer, count ? count : 1, size);
    return result == CGT_OK ? CGT_OK : fail_memory(scene, result);
}

static uint32_t chunks_of(const cgt_scene *scene)
{
    return (uint32_t)(((uint64_t)scene->committed_scene.prims.count + CGT_BANDS_CHUNK - 1) / CGT_BANDS_CHUNK);
}

static cgt_result prepare(cgt_scene *scene, cgt_bands_job *job)
{
    if (!scene->bands) {
        scene->bands = cgt_allocate(&scene->context->memory, sizeof *scene->bands);
        if (!scene->bands)
            return fail_memory(scene, CGT_ERROR_OUT_OF_MEMORY);
        memset(scene->bands, 0, sizeof *scene->bands);
    }
    job->prims = &scene->committed_scene.prims;
    job->bands = scene->bands;
    cgt_result result = reserve(scene, &scene->bands->work_exponents, job->prims->count, sizeof *job->class_of);
    if (result == CGT_OK)
        result = reserve(scene, &scene->bands->work_offsets, chunks_of(scene), sizeof *job->offset);
    job->class_of = scene->bands->work_exponents.data;
    job->offset = scene->bands->work_offsets.data;
    return result;
}

static void plan_bands(cgt_scene *scene, cgt_bands_job *job)
{
    uint32_t count[CGT_MAGNITUDES + 1] = {0};
    cgt_run_tasks(scene->context, cgt_bands_classify, job, chunks_of(scene));
    for (uint32_t i = 0; i < job->prims->count; i++)
        count[job->class_of[i]]++;
    cgt_plan_bands(count, &job->plan);
    job->bands->count = job->plan.bands;
    for (uint32_t b = 0; b < job->plan.bands; b++)
        job->factor[b] = ldexp(1, job->plan.exponent[b]);
}

/* Counts to offsets; reserves memory for the copies. */
static cgt_result place_chunks(cgt_scene *scene, cgt_bands_job *job)
{
    struct cgt_bands *bands = job->bands;
    cgt_result result = CGT_OK;
    for (uint32_t b = 0; b <= CGT_MAX_BANDS && result == CGT_OK; b++) {
        cgt_band_offset next = {0};
        for (uint32_t i = 0; i < chunks_of(scene); i++) {
            const cgt_band_offset count = job->offset[i][b];
            job->offset[i][b] = next;
            next.prims += count.prims;
            next.floats += count.floats;
        }
        if (b == CGT_BAND_OF_REST) {
            bands->rest = next.prims;
            result = reserve(scene, &bands->rest_number, next.prims, sizeof(uint32_t));
        } else if (b < bands->count) {
            bands->band[b].exponent = job->plan.exponent[b];
            bands->band[b].count = next.prims;
            result = reserve(scene, &bands->band[b].points, next.floats, sizeof(float));
            if (result == CGT_OK)
                result = reserve(scene, &bands->band[b].number, next.prims, sizeof(uint32_t));
        }
    }
    return result;
}

/* The first of the ascending numbers that is not below `prim`. */
static uint32_t lower_bound(const uint32_t *number, uint32_t count, uint32_t prim)
{
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (number[middle] < prim)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static cgt_geometry describe_copies(const cgt_primitive_array *a, const float *point, uint32_t count)
{
    if (a->kind == CGT_KIND_SPHERES)
        return (cgt_geometry){.used = true,
                              .kind = a->kind,
                              .spheres = {.count = count,
                                          .centers = cgt_floats(point, 4 * sizeof(float)),
                                          .radii = cgt_floats(point + 3, 4 * sizeof(float)),
                                          .mask = a->mask}};
    if (a->kind == CGT_KIND_CAPSULES)
        return (cgt_geometry){.used = true,
                              .kind = a->kind,
                              .capsules = {.count = count,
                                           .vertex_count = 2 * count,
                                           .vertices = cgt_floats(point, 4 * sizeof(float)),
                                           .radii = cgt_floats(point + 3, 8 * sizeof(float)),
                                           .mask = a->mask}};
    return (cgt_geometry){.used = true,
                          .kind = a->kind,
                          .triangles = {.count = count,
                                        .vertex_count = 3 * count,
                                        .vertices = cgt_floats(point, 3 * sizeof(float)),
                                        .mask = a->mask}};
}

/* Geometry i of the band is what it has of array i. */
static cgt_result describe_band(const cgt_scene *scene, cgt_band *band)
{
    const cgt_primitives *prims = &scene->committed_scene.prims;
    cgt_buffer *buffer = &band->scene->buffer[CGT_BUFFER_GEOMETRY];
    const uint32_t *number = band->number.data;
    const float *point = band->points.data;
    uint32_t first = 0;
    const cgt_result result = reserve(scene, buffer, prims->arrays, sizeof(cgt_geometry));
    band->scene->geometries = result == CGT_OK ? prims->arrays : 0;
    for (uint32_t i = 0; i < band->scene->geometries; i++) {
        const cgt_primitive_array *a = &prims->array[i];
        const uint32_t end =
            i + 1 == prims->arrays ? band->count : lower_bound(number, band->count, prims->array[i + 1].first);
        const uint32_t count = end - first;
        if (a->kind == CGT_KIND_TRIANGLES && count > UINT32_MAX / 3)
            return cgt_fail(scene->context, CGT_ERROR_TOO_LARGE,
                            "commit: %u triangles of geometry %u in one band of magnitudes: at most %u", count,
                            a->geometry, UINT32_MAX / 3);
        ((cgt_geometry *)buffer->data)[i] = describe_copies(a, point, count);
        point += (size_t)count * cgt_band_floats(a->kind);
        first = end;
    }
    return result;
}

static void store_bounds(cgt_band *band)
{
    const cgt_committed_scene *c = &band->scene->committed_scene;
    for (int a = 0; a < 3; a++) { /* exact: double holds all of it */
        band->low[a] = ldexp((double)c->low[a], -band->exponent);
        band->high[a] = ldexp((double)c->high[a], -band->exponent);
    }
}

static cgt_result commit_band(cgt_scene *scene, cgt_band *band)
{
    cgt_result result = CGT_OK;
    if (!band->scene)
        result = cgt_scene_create(scene->context, NULL, &band->scene);
    if (result != CGT_OK)
        return result;
    band->scene->is_band = true;
    band->scene->band_of = scene;
    band->scene->research_options = scene->research_options;
    band->scene->options = scene->options;
    band->scene->options.research = &band->scene->research_options;
    result = describe_band(scene, band);
    if (result == CGT_OK)
        result = cgt_scene_commit(band->scene);
    if (result == CGT_OK)
        store_bounds(band);
    return result;
}

/* The structure is that of the most populous band; its bytes are those of all. */
static void set_statistics(cgt_scene *scene)
{
    const struct cgt_bands *bands = scene->bands;
    cgt_scene_statistics *st = &scene->statistics;
    const cgt_scene *main = bands->band[0].scene;
    scene->committed_scene.structure = main->committed_scene.structure;
    scene->research_statistics = main->research_statistics;
    for (uint32_t b = 0; b < bands->count; b++) {
        st->structure_bytes += bands->band[b].scene->statistics.structure_bytes;
        st->bvh_bytes += bands->band[b].scene->statistics.bvh_bytes;
        st->bvh_build_ms += bands->band[b].scene->statistics.bvh_build_ms;
    }
    char rest[48] = "";
    if (bands->rest)
        snprintf(rest, sizeof rest, ", %u primitives apart", bands->rest);
    snprintf(st->reason, sizeof st->reason, "%u band%s of magnitudes%s; %.48s", bands->count,
             bands->count == 1 ? "" : "s", rest, main->statistics.reason);
}

cgt_result cgt_bands_commit(cgt_scene *scene)
{
    cgt_bands_job job;
    cgt_result result = prepare(scene, &job);
    if (result != CGT_OK)
        return result;
    plan_bands(scene, &job);
    cgt_run_tasks(scene->context, cgt_bands_count, &job, chunks_of(scene));
    result = place_chunks(scene, &job);
    if (result != CGT_OK)
        return result;
    cgt_run_tasks(scene->context, cgt_bands_copy, &job, chunks_of(scene));
    for (uint32_t b = 0; b < job.bands->count && result == CGT_OK; b++)
        result = commit_band(scene, &job.bands->band[b]);
    if (result != CGT_OK)
        return result;
    set_statistics(scene);
    scene->in_bands = true;
    return CGT_OK;
}
