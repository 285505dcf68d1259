/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The library against a light: a commit, the camera's frame, and then what is timed, as a renderer would call it. */
#include "light/bench_light.h"

#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

typedef struct library_job {
    const light_scene *scene;
    const light_place *place;
    const light_points *points;
    bench_scene library;
    uint8_t *occluded;
    bench_counts counts;
    uint64_t rays, tree_rays, references, tests; /* of all calls of a round */
} library_job;

static void add_counts(library_job *job)
{
    job->rays += job->counts.trace.rays;
    job->tree_rays += job->counts.trace.bvh_rays;
    job->references += job->counts.research.references;
    job->tests += job->counts.trace.ray_tests;
}

static cgt_result trace_frame(library_job *job, const cgt_trace_options *options)
{
    const light_scene *s = job->scene;
    cgt_frame frame;
    light_scene_frame(s, &frame);
    const cgt_result result = cgt_occluded_frame(job->library.scene, &s->camera, &frame, job->place->light,
                                                 job->place->count, NULL, job->occluded, options);
    add_counts(job);
    return result;
}

cgt_result light_scene_library(const light_scene *scene, cgt_context *context, bench_scene *library)
{
    static const uint32_t automatic[3];
    const bench_kd_choice kd = {0};
    cgt_result result = bench_scene_create(library, context, scene->input.moving, automatic);
    if (result != CGT_OK)
        return result;
    bench_scene_set_triangles(library, scene->input.index, scene->input.triangles);
    return bench_scene_structure(library, CGT_STRUCTURE_AUTO, CGT_RAY_KIND_COHERENT, &kd, automatic);
}

void light_scene_frame(const light_scene *scene, cgt_frame *frame)
{
    bench_planes_frame(&scene->planes, frame);
    frame->geometry = scene->geometry; /* so that no surface shadows itself */
}

/* The calls of one light after the other. */
static cgt_result trace_points(library_job *job, const cgt_trace_options *options)
{
    const light_points *p = job->points;
    cgt_result result = CGT_OK;
    for (uint32_t k = 0; k < job->place->count; k++)
        for (uint32_t call = 0; call < p->calls && result == CGT_OK; call++) {
            const uint64_t first = call ? p->end[call - 1] : 0;
            const cgt_points points = {
                .count = p->end[call] - first,
                .position = {p->position[0] + first, p->position[1] + first, p->position[2] + first},
                .skip_primitive = p->primitive ? p->primitive + first : NULL,
                .skip_geometry = p->geometry ? p->geometry + first : NULL};
            result = cgt_occluded_points(job->library.scene, &job->place->light[k], &points,
                                         job->occluded + k * p->count + first, options);
            add_counts(job);
        }
    return result;
}

/* commit_ms, ms: what the commit and the light's calls take. */
static cgt_result run_round(library_job *job, double *commit_ms, double *ms)
{
    const bench_choice choice = {0};
    cgt_trace_options options;
    cgt_research_trace_options research;
    cgt_frame frame;
    light_scene_frame(job->scene, &frame);
    bench_choice_options(&choice, &job->counts, &options, &research);
    const double commit_begin = bench_now_ms();
    cgt_result result = bench_scene_commit(&job->library, job->scene->count);
    *commit_ms = bench_now_ms() - commit_begin;
    if (result == CGT_OK)
        result = cgt_trace_camera(job->library.scene, &job->scene->camera, &frame, NULL);
    if (result != CGT_OK)
        return result;
    job->rays = job->tree_rays = job->references = job->tests = 0;
    const double begin = bench_now_ms();
    result = job->points->order == LIGHT_FRAME ? trace_frame(job, &options) : trace_points(job, &options);
    *ms = bench_now_ms() - begin;
    return result;
}

static void fill_result(const library_job *job, size_t bytes, light_result *result)
{
    const double rays = (double)(job->rays ? job->rays : 1);
    result->occluded = 0;
    for (size_t i = 0; i < bytes; i++)
        result->occluded += job->occluded[i];
    result->references = (double)job->references / rays;
    result->tests = (double)job->tests / rays;
    result->tree_share = (double)job->tree_rays / rays;
}

cgt_result light_measure_library(cgt_context *context, const light_scene *scene, const light_place *place,
                                 const light_points *points, uint32_t rounds, light_result *result)
{
    library_job job = {.scene = scene, .place = place, .points = points};
    const uint64_t of_light =
        points->order == LIGHT_FRAME ? (uint64_t)scene->axes.width * scene->axes.height : points->count;
    double *ms = calloc((size_t)rounds + 1, sizeof(double[2])); /* of calls, then of commits */
    memset(result, 0, sizeof *result);
    job.occluded = calloc(1, of_light * place->count + 1);
    cgt_result status = job.occluded && ms ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
    if (status == CGT_OK)
        status = light_scene_library(scene, context, &job.library);
    for (uint32_t k = 0; k <= rounds && status == CGT_OK; k++)
        status = run_round(&job, &ms[rounds + 1 + k], &ms[k]);
    bench_scene_release(&job.library);
    if (status == CGT_OK) {
        result->ms = bench_median(ms + 1, rounds);
        result->build_ms = bench_median(ms + rounds + 2, rounds);
        fill_result(&job, of_light * place->count, result);
    }
    free(job.occluded);
    free(ms);
    return status;
}
