/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree on the same arrays of rays as the library: one ray at a time, neighbours as packets, or streams. */
#include "ways/embree.h"

#include <math.h>
#include <string.h>

#include "common/bench_clones.h"
#include "float_mode.h"

enum { PIECE = 1024 }; /* rays of a task */

typedef struct array_packet {
    _Alignas(64) float word[EMBREE_WORDS * 16];
    _Alignas(64) int valid[16];
} array_packet;

/* Rays first to first + count - 1, as a structure of arrays. Callers pass n as a constant, and count, too, for whole
 * packets: then what Embree loads as a vector has been stored as one, and no load waits for narrower stores. */
BENCH_INLINE void fill_packet(const embree_arrays *a, uint64_t first, uint32_t count, uint32_t n, array_packet *p)
{
    const cgt_rays *rays = a->batch;
    for (uint32_t k = 0; k < 3; k++) {
        memcpy(p->word + (EMBREE_ORG + k) * n, rays->org[k] + first, count * sizeof(float));
        memcpy(p->word + (EMBREE_DIR + k) * n, rays->dir[k] + first, count * sizeof(float));
    }
    if (rays->t_min)
        memcpy(p->word + EMBREE_NEAR * n, rays->t_min + first, count * sizeof(float));
    if (rays->t_max)
        memcpy(p->word + EMBREE_FAR * n, rays->t_max + first, count * sizeof(float));
    else
        for (uint32_t k = 0; k < n; k++)
            p->word[EMBREE_FAR * n + k] = INFINITY;
    for (uint32_t k = 0; k < n; k++)
        p->valid[k] = k < count ? -1 : 0;
    if (!a->nearest)
        return;
    memset(p->word + EMBREE_PRIMITIVE * n, 0xff, n * sizeof(float));
    memset(p->word + EMBREE_GEOMETRY * n, 0xff, n * sizeof(float));
}

/* The first hits of a packet's rays so far, in order. */
typedef struct first_hits {
    struct RTCIntersectContext context; /* first: Embree hands out its address */
    uint32_t count[16], primitive[16][BENCH_FOUR_HITS];
    float t[16][BENCH_FOUR_HITS];
} first_hits;

/* Keeps a hit. Until there are four it is refused, so that the ray goes on; then the ray ends at the fourth. */
static void keep_hit(const struct RTCFilterFunctionNArguments *f)
{
    first_hits *h = (first_hits *)(void *)f->context;
    for (uint32_t k = 0; k < f->N; k++) {
        float *far = (float *)(void *)f->ray + EMBREE_FAR * f->N + k;
        const uint32_t ray = ((const uint32_t *)(const void *)f->ray)[EMBREE_ID * f->N + k];
        const uint32_t primitive = ((const uint32_t *)(const void *)f->hit)[5 * f->N + k];
        uint32_t i = h->count[ray];
        float *t = h->t[ray];
        if (!f->valid[k])
            continue;
        if (i == BENCH_FOUR_HITS && *far >= t[i - 1]) {
            f->valid[k] = 0;
            continue;
        }
        h->count[ray] = i < BENCH_FOUR_HITS ? i + 1 : i;
        for (i = h->count[ray] - 1; i && t[i - 1] > *far; i--) {
            t[i] = t[i - 1];
            h->primitive[ray][i] = h->primitive[ray][i - 1];
        }
        t[i] = *far;
        h->primitive[ray][i] = primitive;
        if (h->count[ray] == BENCH_FOUR_HITS)
            *far = t[BENCH_FOUR_HITS - 1];
        else
            f->valid[k] = 0;
    }
}

static void occlude_packet(const embree_arrays *a, struct RTCIntersectContext *context, array_packet *p)
{
    switch (a->packet) {
    case 16: rtcOccluded16(p->valid, a->scene, context, (struct RTCRay16 *)(void *)p->word); break;
    case 8: rtcOccluded8(p->valid, a->scene, context, (struct RTCRay8 *)(void *)p->word); break;
    case 4: rtcOccluded4(p->valid, a->scene, context, (struct RTCRay4 *)(void *)p->word); break;
    default: rtcOccluded1(a->scene, context, (struct RTCRay *)(void *)p->word); break;
    }
}

static void intersect_packet(const embree_arrays *a, struct RTCIntersectContext *context, array_packet *p)
{
    switch (a->packet) {
    case 16: rtcIntersect16(p->valid, a->scene, context, (struct RTCRayHit16 *)(void *)p->word); break;
    case 8: rtcIntersect8(p->valid, a->scene, context, (struct RTCRayHit8 *)(void *)p->word); break;
    case 4: rtcIntersect4(p->valid, a->scene, context, (struct RTCRayHit4 *)(void *)p->word); break;
    default: rtcIntersect1(a->scene, context, (struct RTCRayHit *)(void *)p->word); break;
    }
}

BENCH_INLINE void trace_packets(const embree_arrays *a, uint64_t first, uint64_t end, uint32_t n)
{
    const cgt_rays *rays = a->batch;
    first_hits hits;
    array_packet p;
    memset(&p, 0, sizeof p);
    for (uint32_t k = 0; k < n; k++)
        memcpy(p.word + EMBREE_ID * n + k, &k, sizeof k);
    memset(p.word + EMBREE_MASK * n, 0xff, n * sizeof(float));
    memset(p.word + EMBREE_INSTANCE * n, 0xff, n * sizeof(float));
    rtcInitIntersectContext(&hits.context);
    hits.context.filter = a->four ? keep_hit : NULL;
    hits.context.flags = a->coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (uint64_t i = first; i < end; i += n) {
        const uint32_t count = end - i < n ? (uint32_t)(end - i) : n;
        if (count == n)
            fill_packet(a, i, n, n, &p);
        else
            fill_packet(a, i, count, n, &p);
        memset(hits.count, 0, sizeof hits.count);
        if (a->nearest)
            intersect_packet(a, &hits.context, &p);
        else
            occlude_packet(a, &hits.context, &p);
        for (uint32_t k = 0; k < count && a->four; k++)
            memset(a->occluded + BENCH_FOUR_HITS * (i + k), 1, hits.count[k]);
        for (uint32_t k = 0; k < count && !a->four;
             k++) /* closer than its far end, which Embree sets to -infinity for an occluded ray */
            a->occluded[i + k] = p.word[EMBREE_FAR * n + k] < (rays->t_max ? rays->t_max[i + k] : INFINITY);
    }
}

BENCH_CLONES
static void trace_piece(const embree_arrays *a, uint64_t first, uint64_t end)
{
    switch (a->packet) {
    case 16: trace_packets(a, first, end, 16); break;
    case 8: trace_packets(a, first, end, 8); break;
    case 4: trace_packets(a, first, end, 4); break;
    default: trace_packets(a, first, end, 1); break;
    }
}

/* A stream, for any hit. */
static void trace_stream(const embree_arrays *a, uint64_t first, uint32_t count)
{
    const cgt_rays *rays = a->batch;
    struct RTCRay stream[PIECE];
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = a->coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (uint32_t k = 0; k < count; k++)
        stream[k] = (struct RTCRay){.org_x = rays->org[0][first + k],
                                    .org_y = rays->org[1][first + k],
                                    .org_z = rays->org[2][first + k],
                                    .tnear = rays->t_min ? rays->t_min[first + k] : 0,
                                    .dir_x = rays->dir[0][first + k],
                                    .dir_y = rays->dir[1][first + k],
                                    .dir_z = rays->dir[2][first + k],
                                    .tfar = rays->t_max ? rays->t_max[first + k] : INFINITY,
                                    .mask = UINT32_MAX};
    rtcOccluded1M(a->scene, &context, stream, count, sizeof stream[0]);
    for (uint32_t k = 0; k < count; k++)
        a->occluded[first + k] = stream[k].tfar < 0;
}

static void trace_task(void *argument, uint32_t index)
{
    const embree_arrays *a = argument;
    const uint64_t first = (uint64_t)index * PIECE, left = a->batch->count - first;
    const uint32_t count = left < PIECE ? (uint32_t)left : PIECE;
    const float_mode callers = float_mode_flush();
    if (a->packet)
        trace_piece(a, first, first + count);
    else
        trace_stream(a, first, count);
    float_mode_restore(callers);
}

/* A ray as a program casts it that has one: by Embree's call, without tasks. */
static void trace_one(const embree_arrays *a, const cgt_rays *ray, uint8_t *occluded)
{
    struct RTCIntersectContext context;
    const float far = ray->t_max ? *ray->t_max : INFINITY;
    struct RTCRayHit h = {.ray = {.org_x = *ray->org[0],
                                  .org_y = *ray->org[1],
                                  .org_z = *ray->org[2],
                                  .tnear = ray->t_min ? *ray->t_min : 0,
                                  .dir_x = *ray->dir[0],
                                  .dir_y = *ray->dir[1],
                                  .dir_z = *ray->dir[2],
                                  .tfar = far,
                                  .mask = UINT32_MAX},
                          .hit = {.primID = UINT32_MAX, .geomID = UINT32_MAX, .instID = {UINT32_MAX}}};
    rtcInitIntersectContext(&context);
    if (a->nearest)
        rtcIntersect1(a->scene, &context, &h);
    else
        rtcOccluded1(a->scene, &context, &h.ray);
    *occluded = h.ray.tfar < far;
}

void embree_arrays_trace(embree_arrays *a, const cgt_rays *batch, uint8_t *occluded)
{
    if (batch->count == 1 && !a->four) {
        trace_one(a, batch, occluded);
        return;
    }
    a->batch = batch;
    a->occluded = occluded;
    cgt_context_run_tasks(a->context, trace_task, a, (uint32_t)((batch->count + PIECE - 1) / PIECE));
}

void embree_arrays_trace_here(const embree_arrays *arrays, const cgt_rays *batch, uint8_t *occluded)
{
    embree_arrays own = *arrays; /* other threads are still working */
    const float_mode callers = float_mode_flush();
    own.batch = batch;
    own.occluded = occluded;
    trace_piece(&own, 0, batch->count);
    float_mode_restore(callers);
}
