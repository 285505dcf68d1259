/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree 3 against a light: rays that are made beforehand, traced one by one, in packets, and as streams. CLIFFS_EMBREE:
 * it is installed. */
#include "light/bench_light.h"

#ifdef CLIFFS_EMBREE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"
#include "embree/embree_scenes.h"
#include "float_mode.h"

enum { PIECE = 1024 }; /* rays of a stream */

/* Ways to trace; 0 rays: a stream. */
static const struct {
    const char *name;
    uint32_t rays;
    int coherent;
} ways[] = {{"single", 1, 0},         {"packets of 8", 8, 1},
            {"packets of 16", 16, 1}, {"packets of 16, incoherent", 16, 0},
            {"stream", 0, 1},         {"stream, incoherent", 0, 0}};
enum { WAYS = sizeof ways / sizeof ways[0] };

/* ---- streams ---- */

typedef struct stream_job {
    RTCScene scene;
    int coherent;
    const cgt_rays *batch;
    uint8_t *occluded;
} stream_job;

static void trace_stream(void *argument, uint32_t index)
{
    const stream_job *job = argument;
    const cgt_rays *rays = job->batch;
    const uint64_t first = (uint64_t)index * PIECE, left = rays->count - first;
    const uint32_t count = left < PIECE ? (uint32_t)left : PIECE;
    struct RTCRay stream[PIECE];
    struct RTCIntersectContext context;
    const float_mode callers = float_mode_flush();
    rtcInitIntersectContext(&context);
    context.flags = job->coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (uint32_t k = 0; k < count; k++)
        stream[k] = (struct RTCRay){.org_x = rays->org[0][first + k],
                                    .org_y = rays->org[1][first + k],
                                    .org_z = rays->org[2][first + k],
                                    .dir_x = rays->dir[0][first + k],
                                    .dir_y = rays->dir[1][first + k],
                                    .dir_z = rays->dir[2][first + k],
                                    .tfar = rays->t_max[first + k],
                                    .mask = UINT32_MAX};
    rtcOccluded1M(job->scene, &context, stream, count, sizeof stream[0]);
    for (uint32_t k = 0; k < count; k++)
        job->occluded[first + k] = stream[k].tfar < 0;
    float_mode_restore(callers);
}

/* ---- measuring ---- */

/* Rays of one light, and their results. */
typedef struct embree_light {
    cgt_rays rays;
    float *dir[3], *t_max;
    uint8_t *occluded;
} embree_light;

static int make_rays(const light_points *points, embree_light *l)
{
    const size_t count = (size_t)points->count + 1;
    float *memory = calloc(count, sizeof(float[4]));
    l->occluded = calloc(count, 1);
    l->rays.count = points->count;
    for (int a = 0; a < 3; a++) {
        l->rays.org[a] = points->position[a];
        l->rays.dir[a] = l->dir[a] = memory + (size_t)a * count;
    }
    l->rays.t_max = l->t_max = memory + 3 * count;
    return memory && l->occluded ? 0 : -1;
}

static void aim_rays(const light_points *points, const cgt_light *light, embree_light *l)
{
    const bool is_point = light->kind == CGT_LIGHT_POINT;
    for (int a = 0; a < 3; a++)
        for (uint64_t i = 0; i < points->count; i++)
            l->dir[a][i] = light->position[a] - (is_point ? points->position[a][i] : 0);
    for (uint64_t i = 0; i < points->count; i++)
        l->t_max[i] = is_point ? 1 : INFINITY;
}

static double trace_once(const embree_scenes *e, int kind, int way, const embree_light *l)
{
    embree_arrays arrays = {.scene = e->moving[kind].scene,
                            .threads = e->threads,
                            .packet = ways[way].rays,
                            .coherent = ways[way].coherent};
    stream_job stream = {e->moving[kind].scene, ways[way].coherent, &l->rays, l->occluded};
    const double begin = bench_now_ms();
    if (ways[way].rays)
        embree_arrays_trace(&arrays, &l->rays, l->occluded);
    else
        bench_threads_run(e->threads, trace_stream, &stream, (uint32_t)((l->rays.count + PIECE - 1) / PIECE));
    return bench_now_ms() - begin;
}

/* One way, all lights: the median of some rounds; occluded gets the sum over lights. */
static int measure_way(const embree_scenes *e, int kind, int way, const light_place *place, const light_points *points,
                       embree_light *l, uint32_t rounds, double *median, uint64_t *occluded)
{
    double *ms = calloc(rounds + 1, sizeof *ms);
    *occluded = 0;
    if (!ms)
        return -1;
    for (uint32_t k = 0; k < place->count; k++) {
        aim_rays(points, &place->light[k], l);
        for (uint32_t round = 0; round <= rounds; round++)
            ms[round] += trace_once(e, kind, way, l);
        for (uint64_t i = 0; i < points->count; i++)
            *occluded += l->occluded[i];
    }
    *median = bench_median(ms + 1, rounds);
    free(ms);
    return 0;
}

int light_measure_embree(embree_scenes *e, const light_place *place, const light_points *points, uint32_t rounds,
                         light_result *result)
{
    embree_light l = {0};
    *result = (light_result){.ms = INFINITY, .way = ""};
    int failed = make_rays(points, &l);
    for (int kind = 0; kind < e->kinds && !failed; kind++)
        for (int way = 0; way < WAYS && !failed; way++) {
            double ms;
            uint64_t occluded;
            failed = measure_way(e, kind, way, place, points, &l, rounds, &ms, &occluded);
            if (failed || !(ms < result->ms))
                continue;
            result->ms = ms;
            result->occluded = occluded;
            result->way = ways[way].name;
            result->build_ms = e->build_ms[kind];
        }
    free(l.dir[0]);
    free(l.occluded);
    return failed;
}

#else

int light_measure_embree(embree_scenes *embree, const light_place *place, const light_points *points, uint32_t rounds,
                         light_result *result)
{
    (void)embree;
    (void)place;
    (void)points;
    (void)rounds;
    *result = (light_result){.way = ""};
    return 0;
}

#endif
