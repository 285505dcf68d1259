/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of one committed scene by the fields that they request, into planes or to a visitor, which reads one number of
 * each cache line that it gets. All ways take turns, so that a slow moment affects all alike. */
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "floor/bench_floor.h"
#include "common/bench_scene.h"
#include "common/bench_timing.h"

static const struct {
    const char *name;
    uint32_t fields;
} sets[FLOOR_FIELDS] = {
    {"t", CGT_FIELD_T},
    {"t,id", CGT_FIELD_T | CGT_FIELD_PRIMITIVE},
    {"t,id,normal", CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_NORMAL},
    {"t,id,uv", CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_UV},
    {"t,id,normal,uv", CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_NORMAL | CGT_FIELD_UV},
};

static uint32_t touch(const void *plane, const cgt_tile *tile)
{
    const uint32_t *words = plane;
    uint32_t sum = 0;
    for (uint32_t y = 0; words && y < tile->height; y++)
        for (uint32_t x = 0; x < tile->width; x += 16)
            sum += words[y * tile->row_stride + x];
    return sum;
}

/* Tiles come from several threads at the same time. The sum is stored, or compilers would remove the reads. */
static cgt_visit visit(void *user, const cgt_tile *tile)
{
    uint32_t sum = touch(tile->t, tile) + touch(tile->primitive, tile) + touch(tile->u, tile) + touch(tile->v, tile);
    for (int a = 0; a < 3; a++)
        sum += touch(tile->normal[a], tile);
    atomic_fetch_add_explicit((atomic_uint *)user, sum, memory_order_relaxed);
    return CGT_VISIT_CONTINUE;
}

static void make_frame(const floor_job *job, floor_fields set, floor_target target, atomic_uint *seen, cgt_frame *frame)
{
    const uint32_t fields = sets[set].fields;
    cgt_frame planes;
    bench_planes_frame(&job->planes, &planes);
    cgt_frame_init(frame, planes.width, planes.height);
    if (target == FLOOR_VISITOR) {
        frame->visitor = visit;
        frame->visitor_user = seen;
        frame->visitor_fields = fields;
        return;
    }
    frame->t = planes.t;
    frame->primitive = fields & CGT_FIELD_PRIMITIVE ? planes.primitive : NULL;
    for (int a = 0; a < 3; a++)
        frame->normal[a] = fields & CGT_FIELD_NORMAL ? planes.normal[a] : NULL;
    frame->u = fields & CGT_FIELD_UV ? job->planes.uv[0] : NULL;
    frame->v = fields & CGT_FIELD_UV ? job->planes.uv[1] : NULL;
}

static cgt_result run_rounds(floor_job *job, const bench_scene *scene, double *ms)
{
    const uint32_t rounds = job->settings->shared.repeat;
    atomic_uint seen;
    cgt_trace_options trace;
    cgt_research_trace_options research;
    atomic_init(&seen, 0);
    bench_choice_options(&job->choice, NULL, &trace, &research);
    for (uint32_t round = 0; round < rounds + 1; round++) /* the first one warms up */
        for (int way = 0; way < FLOOR_FIELDS * FLOOR_TARGETS; way++) {
            cgt_frame frame;
            make_frame(job, (floor_fields)(way / FLOOR_TARGETS), (floor_target)(way % FLOOR_TARGETS), &seen, &frame);
            const double begin = bench_now_ms();
            const cgt_result result = cgt_trace_camera(scene->scene, &job->settings->shared.camera, &frame, &trace);
            if (result != CGT_OK)
                return result;
            if (round)
                ms[(size_t)way * rounds + round - 1] = bench_now_ms() - begin;
        }
    return CGT_OK;
}

int floor_measure_fields(floor_job *job, const bench_scene *scene, const char *part, const char *name,
                         double low[FLOOR_FIELDS])
{
    const uint32_t rounds = job->settings->shared.repeat;
    double *ms = calloc(rounds, FLOOR_FIELDS * FLOOR_TARGETS * sizeof *ms);
    if (!ms) {
        program_error("out of memory for %u rounds", (unsigned)rounds);
        return PROGRAM_FAILED;
    }
    const cgt_result result = run_rounds(job, scene, ms);
    for (int way = 0; result == CGT_OK && way < FLOOR_FIELDS * FLOOR_TARGETS; way++) {
        char item[64];
        double *times = ms + (size_t)way * rounds;
        const double median = bench_median(times, rounds);
        const char *target = way % FLOOR_TARGETS == FLOOR_VISITOR ? "visitor" : "planes";
        const uint32_t threads = cgt_context_get_threads(job->context);
        snprintf(item, sizeof item, "%s:%s", target, sets[way / FLOOR_TARGETS].name);
        floor_row(job, part, name, item, threads, times[0], "ms");
        snprintf(item, sizeof item, "%s:%s:median", target, sets[way / FLOOR_TARGETS].name);
        floor_row(job, part, name, item, threads, median, "ms");
        if (low && way % FLOOR_TARGETS == FLOOR_PLANES)
            low[way / FLOOR_TARGETS] = times[0];
    }
    free(ms);
    return result == CGT_OK ? PROGRAM_OK : bench_scene_failed(job->context, name, result);
}

/* The only sphere is behind the eye. */
int floor_measure_empty(floor_job *job)
{
    const cgt_camera *camera = &job->settings->shared.camera;
    cgt_scene_statistics built;
    bench_scene scene;
    float sphere[4];
    for (int a = 0; a < 3; a++)
        sphere[a] = camera->eye[a] + 10.0f * (camera->eye[a] - camera->target[a]);
    sphere[3] = 0.5f * (fabsf(camera->eye[0] - camera->target[0]) + fabsf(camera->eye[1] - camera->target[1]) +
                        fabsf(camera->eye[2] - camera->target[2]));
    cgt_result result = floor_open_scene(job, &scene, job->context, sphere, NULL, 0);
    if (result == CGT_OK)
        result = bench_scene_commit(&scene, 1);
    int code = PROGRAM_OK;
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(scene.scene, &built);
    if (result == CGT_OK)
        bench_choice_name(&job->choice, built.structure, job->config);
    if (result != CGT_OK)
        code = bench_scene_failed(job->context, "the empty frame", result);
    else
        code = floor_measure_fields(job, &scene, "empty", "-", job->empty_ms);
    bench_scene_release(&scene);
    return code;
}
