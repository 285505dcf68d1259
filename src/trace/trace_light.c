/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light: cut into chunks, each a task. */
#include <math.h>

#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "trace/trace_call.h"
#include "builders/bvh/bvh_on_demand.h"

/* How tiles or a tree are chosen: the chunks of a call that are sampled, and the primitives that a tile may test for each
 * point; with more of them a tree is faster. Measured. */
#define SAMPLED_CHUNKS 8u
#define PRIMS_PER_POINT 16u

/* Where a BVH may take over: the work for each point, in references and tests of groups, after which tiles give a chunk
 * up. The estimate takes primitives for evenly spread over the bounds of the scene; one far away makes it too small. The
 * work is bounded by a few times what the BVH takes. */
#define MAX_LIGHT_WORK 128u
/* Points of such a chunk share little: each counts as so many rays for the BVH's building. */
#define SCATTERED_POINTS 4u

#define CHUNK_GIVEN_UP 0xffu /* the first result of a chunk that tiles gave up, until it is traced otherwise */

#define FEW_POINTS 256u /* fewer go through a BVH where there is one */

typedef struct light_job {
    const cgt_scene *scene;
    const cgt_light *light;
    cgt_rays points; /* without directions */
    uint8_t *occluded;
    cgt_trace_settings settings;
    cgt_trace_counter *counter;
    _Atomic uint64_t given_up; /* points of chunks that tiles gave up */
} light_job;

static uint64_t chunk_end(const light_job *job, uint64_t first)
{
    const uint64_t remaining = job->points.count - first;
    return first + (remaining < CGT_RAYS_CHUNK ? remaining : CGT_RAYS_CHUNK);
}

static void trace_chunk(void *argument, uint32_t index)
{
    light_job *job = argument;
    const cgt_scene *s = job->scene;
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK, end = chunk_end(job, first);
    cgt_counts counts = {0};
    if (!s->context->kernel->trace_light(&s->committed_scene, &job->points, job->light, first, end, &job->settings,
                                         job->occluded, &counts)) {
        job->occluded[first] = CHUNK_GIVEN_UP;
        atomic_fetch_add_explicit(&job->given_up, end - first, memory_order_relaxed);
    }
    cgt_trace_counter_add(job->counter, &counts);
}

static void trace_given_up_chunk(void *argument, uint32_t index)
{
    const light_job *job = argument;
    if (job->occluded[(uint64_t)index * CGT_RAYS_CHUNK] == CHUNK_GIVEN_UP)
        trace_chunk(argument, index);
}

/* Traces all chunks, and those that tiles gave up once more: through the BVH, or by tiles with any work where there is
 * none yet. */
static cgt_result trace_chunks(light_job *job)
{
    const cgt_scene *s = job->scene;
    const uint32_t chunks = (uint32_t)((job->points.count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK);
    cgt_trace_settings *settings = &job->settings;
    if (settings->light_tiles && s->options.structure == CGT_STRUCTURE_AUTO)
        settings->max_light_work = MAX_LIGHT_WORK;
    cgt_run_tasks(s->context, trace_chunk, job, chunks);
    const uint64_t given_up = atomic_load_explicit(&job->given_up, memory_order_relaxed);
    if (!given_up)
        return CGT_OK;
    const cgt_result result = cgt_bvh_build_on_demand(s, given_up * SCATTERED_POINTS, &settings->use_bvh);
    if (result != CGT_OK)
        return result;
    settings->light_tiles = !settings->use_bvh;
    settings->max_light_work = 0;
    cgt_run_tasks(s->context, trace_given_up_chunk, job, chunks);
    return CGT_OK;
}

/* Whether, in most chunks, neighbouring points are near enough to each other for tiles, as the light sees them. */
static bool choose_tiles(const light_job *job)
{
    const cgt_scene *s = job->scene;
    const cgt_committed_scene *committed_scene = &s->committed_scene;
    const uint64_t chunks = (job->points.count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK;
    const uint64_t sampled = chunks < SAMPLED_CHUNKS ? chunks : SAMPLED_CHUNKS;
    uint64_t coherent = 0;
    cgt_float_environment callers;
    if (!committed_scene->loose.levels || !committed_scene->valid || committed_scene->brute_force ||
        committed_scene->scale > 0x1p60f || committed_scene->scale < 0x1p-60f)
        return false;
    cgt_float_environment_enter(&callers);
    for (uint64_t k = 0; k < sampled; k++) {
        const uint64_t first = chunks * k / sampled * CGT_RAYS_CHUNK, end = chunk_end(job, first);
        coherent += s->context->kernel->light_prims(committed_scene, &job->points, job->light, first, end) <=
                    PRIMS_PER_POINT * (end - first);
    }
    cgt_float_environment_leave(&callers);
    return 2 * coherent > sampled;
}

static cgt_result check_light(cgt_context *c, const cgt_light *light)
{
    bool zero = true;
    for (int a = 0; a < 3; a++) {
        if (!isfinite(light->position[a]))
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: its position is not finite");
        zero = zero && light->position[a] == 0;
    }
    if ((unsigned)light->kind > CGT_LIGHT_DIRECTIONAL)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: kind %d is unknown", (int)light->kind);
    if (light->kind == CGT_LIGHT_DIRECTIONAL && zero)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: a direction of length zero");
    return CGT_OK;
}

static cgt_result check_points(cgt_context *c, const cgt_points *p)
{
    for (int a = 0; a < 3 && p->count; a++)
        if (!p->position[a])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "points: position must not be NULL");
    return cgt_check_stride(c, "points", p->stride, p->count);
}

cgt_result cgt_occluded_points(const cgt_scene *scene, const cgt_light *light, const cgt_points *points,
                               uint8_t *occluded, const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    if (!scene || !light || !points || (!occluded && points->count))
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_context *c = scene->context;
    light_job job = {.scene = scene, .light = light, .occluded = occluded, .counter = &counter};
    cgt_result result = cgt_trace_prepare(scene, options, false, &job.settings, &counter);
    if (result == CGT_OK)
        result = check_light(c, light);
    if (result == CGT_OK)
        result = check_points(c, points);
    if (result != CGT_OK)
        return result;
    job.points = (cgt_rays){.count = points->count,
                            .stride = points->stride,
                            .org = {points->position[0], points->position[1], points->position[2]},
                            .t_min = points->t_min,
                            .t_max = points->t_max,
                            .mask = points->mask,
                            .skip_primitive = points->skip_primitive,
                            .skip_geometry = points->skip_geometry};
    const bool tiles = choose_tiles(&job);
    if (points->count >= FEW_POINTS) /* by tiles, where there is a grid */
        cgt_set_flag(&scene->mutable_scene->had_frames);
    result = cgt_bvh_build_on_demand(scene, tiles ? 0 : points->count, &job.settings.use_bvh);
    if (result != CGT_OK)
        return result;
    job.settings.light_tiles = tiles && !(job.settings.use_bvh && points->count < FEW_POINTS);
    result = trace_chunks(&job);
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return CGT_OK;
}
