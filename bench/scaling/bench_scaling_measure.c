/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One point of cgt-bench scaling: a scene in memory moves, is committed and traced, first in frames that warm up, then
 * in frames that count. Memory hooks count what the library allocates in the latter. */
#include <stdlib.h>
#include <string.h>

#include "scaling/bench_memory.h"
#include "rays/bench_planes.h"
#include "make/bench_procedural.h"
#include "scaling/bench_scaling.h"
#include "common/bench_timing.h"

enum { WARM_FRAMES = 2 };

typedef struct point_job {
    const scaling_settings *settings;
    scaling_point *point;
    bench_memory memory;
    cgt_context *context;
    bench_procedural moving;
    bench_scene scene;
    bench_planes planes;
    cgt_trace_options trace;
    cgt_research_trace_options research;
    double *ms[SCALING_COLUMNS];
    size_t frames;
} point_job;

static int prepare(point_job *job)
{
    const scaling_point *point = job->point;
    const bench_settings *shared = &job->settings->shared;
    job->frames = (size_t)shared->frames * shared->repeat;
    int complete = !(point->kind == SCALING_SPHERES ? bench_procedural_cloud(&job->moving, point->primitives, 0)
                                                    : bench_procedural_mesh(&job->moving, point->primitives));
    complete = complete && !bench_planes_create(&job->planes, point->width, point->height);
    for (int c = 0; complete && c < SCALING_COLUMNS; c++)
        complete = (job->ms[c] = calloc(job->frames, sizeof(double))) != NULL;
    if (complete)
        return PROGRAM_OK;
    program_error("out of memory for %u primitives and %ux%u pixels", (unsigned)point->primitives,
                  (unsigned)point->width, (unsigned)point->height);
    return PROGRAM_FAILED;
}

static cgt_result open_scene(point_job *job, const bench_choice *choice)
{
    const bench_settings *shared = &job->settings->shared;
    cgt_memory_hooks hooks;
    bench_memory_hooks(&job->memory, &hooks);
    cgt_result result = bench_context_create_with(job->point->threads, shared->variant, &hooks, &job->context);
    if (result == CGT_OK)
        result = bench_scene_create(&job->scene, job->context, job->moving.now, shared->resolution);
    if (result == CGT_OK)
        result = bench_scene_structure(&job->scene, job->settings->structure.requested[0], CGT_RAY_KIND_COHERENT,
                                       &choice->kd, shared->resolution);
    if (result == CGT_OK)
        bench_scene_set_triangles(&job->scene, job->moving.index, job->moving.triangles);
    bench_choice_options(choice, NULL, &job->trace, &job->research);
    return result;
}

static cgt_result measure_frame(point_job *job, uint32_t number, double ms[SCALING_COLUMNS])
{
    cgt_frame frame;
    bench_planes_frame(&job->planes, &frame);
    bench_procedural_move(&job->moving, number);
    const double begin = bench_now_ms();
    cgt_result result = bench_scene_commit(&job->scene, job->moving.count);
    const double built = bench_now_ms();
    if (result == CGT_OK)
        result = cgt_trace_camera(job->scene.scene, &job->settings->shared.camera, &frame, &job->trace);
    const double end = bench_now_ms();
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(job->scene.scene, &job->point->built);
    ms[SCALING_BOUNDS] = job->point->built.bounds_ms;
    ms[SCALING_BUILD] = job->point->built.build_ms;
    ms[SCALING_PRIMARY] = end - built;
    ms[SCALING_FRAME] = end - begin;
    return result;
}

static cgt_result measure_frames(point_job *job)
{
    uint64_t before = 0;
    for (size_t i = 0; i < WARM_FRAMES + job->frames; i++) {
        double ms[SCALING_COLUMNS];
        if (i == WARM_FRAMES)
            before = job->memory.allocations;
        const cgt_result result = measure_frame(job, (uint32_t)i, ms);
        if (result != CGT_OK)
            return result;
        for (int c = 0; i >= WARM_FRAMES && c < SCALING_COLUMNS; c++)
            job->ms[c][i - WARM_FRAMES] = ms[c];
    }
    job->point->allocations = job->memory.allocations;
    job->point->steady_allocations = job->memory.allocations - before;
    return CGT_OK;
}

static void keep(point_job *job, const bench_choice *choice)
{
    scaling_point *point = job->point;
    point->threads = cgt_context_get_threads(job->context);
    point->hits = bench_planes_hits(&job->planes);
    bench_choice_name(choice, point->built.structure, point->config);
    for (int c = 0; c < SCALING_COLUMNS; c++) {
        point->median[c] = bench_median(job->ms[c], job->frames);
        point->low[c] = job->ms[c][0]; /* sorted now */
    }
}

static void release(point_job *job)
{
    for (int c = 0; c < SCALING_COLUMNS; c++)
        free(job->ms[c]);
    bench_planes_release(&job->planes);
    bench_scene_release(&job->scene);
    cgt_context_release(job->context);
    bench_procedural_release(&job->moving);
}

int scaling_measure(const scaling_settings *settings, scaling_point *point)
{
    const bench_choice choice = bench_choice_of(&settings->shared, &settings->structure, &settings->precision);
    point_job job = {.settings = settings, .point = point};
    int code = prepare(&job);
    if (code == PROGRAM_OK) {
        cgt_result result = open_scene(&job, &choice);
        if (result == CGT_OK)
            result = measure_frames(&job);
        if (result == CGT_OK)
            keep(&job, &choice);
        else
            code = bench_scene_failed(job.context, "scaling", result);
    }
    release(&job);
    return code;
}
