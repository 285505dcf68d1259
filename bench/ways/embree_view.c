/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree on the camera's rays, in packets of neighbours. */
#include "ways/embree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_clones.h"
#include "float_mode.h"

enum { TASK_PACKETS = 8 }; /* packets along the edge of a task's square */

/* ---- View ---------------------------------------------------------------------------------------------------- */

int embree_view_create(embree_view *view, const bench_camera_axes *axes, uint32_t packet)
{
    size_t stride;
    memset(view, 0, sizeof *view);
    view->axes = *axes;
    view->packet = packet;
    view->width = packet == 1 ? 1 : packet == 4 ? 2 : 4;
    view->height = packet / view->width;
    view->across = (axes->width + view->width - 1) / view->width;
    view->down = (axes->height + view->height - 1) / view->height;
    view->hits.count = (size_t)view->across * view->down * packet;
    char *memory = bench_planes_memory(view->hits.count, 5, &stride);
    if (!memory)
        return -1;
    view->hits.memory = memory;
    view->hits.t = (float *)(void *)memory;
    view->hits.primitive = (uint32_t *)(void *)(memory + stride);
    for (size_t a = 0; a < 3; a++)
        view->hits.normal[a] = (float *)(void *)(memory + (2 + a) * stride);
    return 0;
}

void embree_view_release(embree_view *view)
{
    free(view->hits.memory);
    memset(view, 0, sizeof *view);
}

/* The element of pixel (x, y). */
static size_t element_of(const embree_view *view, uint32_t x, uint32_t y)
{
    const size_t packet = (size_t)(y / view->height) * view->across + x / view->width;
    return packet * view->packet + y % view->height * view->width + x % view->width;
}

void embree_view_planes(const embree_view *view, const bench_planes *planes)
{
    for (uint32_t y = 0; y < planes->height; y++)
        for (uint32_t x = 0; x < planes->width; x++) {
            const size_t from = element_of(view, x, y), to = (size_t)y * planes->width + x;
            planes->t[to] = view->hits.t[from];
            planes->primitive[to] = view->hits.primitive[from];
            for (int a = 0; a < 3 && planes->normal[a]; a++)
                planes->normal[a][to] = view->hits.normal[a][from];
        }
}

/* ---- Packets ------------------------------------------------------------------------------------------------- */

/* A packet in Embree's form. The widest one holds the others. */
typedef struct packet {
    _Alignas(64) float word[EMBREE_WORDS * 16];
    _Alignas(64) int valid[16];
} packet;

BENCH_INLINE void fill(float *words, float value, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        words[i] = value;
}

/* What is the same for all rays of a view. */
BENCH_INLINE void packet_init(packet *p, const embree_view *view)
{
    const uint32_t n = view->packet;
    memset(p, 0, sizeof *p);
    for (uint32_t a = 0; a < 3; a++)
        fill(p->word + (EMBREE_ORG + a) * n, view->axes.eye[a], n);
    memset(p->word + EMBREE_MASK * n, 0xff, n * sizeof(float));
    memset(p->word + EMBREE_INSTANCE * n, 0xff, n * sizeof(float));
}

/* The rays of a packet of n, `columns` side by side, whose first pixel is (x, y). Callers pass both as constants: then
 * what Embree loads as a vector has been stored as one, and no load waits for narrower stores. */
BENCH_INLINE void packet_rays(packet *p, const bench_camera_axes *axes, uint32_t x, uint32_t y, uint32_t n,
                              uint32_t columns)
{
    const float sx = 2.0f / (float)axes->width, sy = 2.0f / (float)axes->height;
    float px[16], py[16];
    for (uint32_t k = 0; k < n; k++) {
        px[k] = ((float)(int32_t)(x + k % columns) + 0.5f) * sx - 1.0f;
        py[k] = 1.0f - ((float)(int32_t)(y + k / columns) + 0.5f) * sy;
    }
    for (uint32_t a = 0; a < 3; a++) {
        const float fwd = axes->fwd[a], right = axes->right[a], up = axes->up[a];
        for (uint32_t k = 0; k < n; k++)
            p->word[(EMBREE_DIR + a) * n + k] = fwd + px[k] * right + py[k] * up;
    }
    fill(p->word + EMBREE_FAR * n, INFINITY, n);
    memset(p->word + EMBREE_PRIMITIVE * n, 0xff, n * sizeof(float));
    memset(p->word + EMBREE_GEOMETRY * n, 0xff, n * sizeof(float));
}

/* Which of them are in the picture. */
BENCH_INLINE void packet_valid(packet *p, const embree_view *view, uint32_t x, uint32_t y)
{
    if (x + view->width <= view->axes.width && y + view->height <= view->axes.height) {
        memset(p->valid, 0xff, sizeof p->valid);
        return;
    }
    for (uint32_t k = 0; k < view->packet; k++) {
        const int inside = x + k % view->width < view->axes.width && y + k / view->width < view->axes.height;
        p->valid[k] = inside ? -1 : 0;
    }
}

BENCH_INLINE void packet_trace(packet *p, RTCScene scene, uint32_t n)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    switch (n) {
    case 16: rtcIntersect16(p->valid, scene, &context, (struct RTCRayHit16 *)(void *)p->word); break;
    case 8: rtcIntersect8(p->valid, scene, &context, (struct RTCRayHit8 *)(void *)p->word); break;
    case 4: rtcIntersect4(p->valid, scene, &context, (struct RTCRayHit4 *)(void *)p->word); break;
    default: rtcIntersect1(scene, &context, (struct RTCRayHit *)(void *)p->word); break;
    }
}

BENCH_INLINE void packet_store(const packet *p, const embree_view *view, size_t first, uint32_t n)
{
    const size_t bytes = n * sizeof(float);
    memcpy(view->hits.t + first, p->word + EMBREE_FAR * n, bytes);
    memcpy(view->hits.primitive + first, p->word + EMBREE_PRIMITIVE * n, bytes);
    for (uint32_t a = 0; a < 3; a++)
        memcpy(view->hits.normal[a] + first, p->word + (EMBREE_NORMAL + a) * n, bytes);
}

/* Shades the packet at (x, y) into the picture. Embree's normals are not of unit length. */
BENCH_INLINE void packet_shade(const packet *p, const bench_picture *picture, uint32_t x, uint32_t y, uint32_t n,
                               uint32_t columns)
{
    const float *nx = p->word + EMBREE_NORMAL * n, *ny = nx + n, *nz = ny + n;
    uint32_t primitive[16], color[16];
    memcpy(primitive, p->word + EMBREE_PRIMITIVE * n, n * sizeof(float));
    for (uint32_t k = 0; k < n; k++) {
        const float scale = 1 / sqrtf(nx[k] * nx[k] + ny[k] * ny[k] + nz[k] * nz[k]);
        color[k] = bench_shade(primitive[k], nx[k] * scale, ny[k] * scale, nz[k] * scale);
    }
    const uint32_t width = picture->width - x < columns ? picture->width - x : columns;
    for (uint32_t j = 0; j < n / columns && y + j < picture->height; j++) {
        uint32_t *to = picture->rgba + (size_t)(y + j) * picture->width + x;
        if (width == columns)
            memcpy(to, color + j * columns, columns * sizeof *to); /* of constant length */
        else
            memcpy(to, color + j * columns, width * sizeof *to);
    }
}

typedef struct trace_job {
    const embree_view *view;
    RTCScene scene;
    uint32_t tasks_across;
} trace_job;

BENCH_INLINE void trace_packets(const trace_job *job, uint32_t column, uint32_t row, uint32_t n, uint32_t columns)
{
    const embree_view *view = job->view;
    packet p;
    packet_init(&p, view);
    for (uint32_t j = row; j < row + TASK_PACKETS && j < view->down; j++)
        for (uint32_t i = column; i < column + TASK_PACKETS && i < view->across; i++) {
            const uint32_t x = i * columns, y = j * (n / columns);
            packet_valid(&p, view, x, y);
            packet_rays(&p, &view->axes, x, y, n, columns);
            packet_trace(&p, job->scene, n);
            if (view->picture)
                packet_shade(&p, view->picture, x, y, n, columns);
            else
                packet_store(&p, view, ((size_t)j * view->across + i) * n, n);
        }
}

BENCH_CLONES
static void trace_square(const trace_job *job, uint32_t column, uint32_t row)
{
    switch (job->view->packet) { /* as embree_view_create has them */
    case 16: trace_packets(job, column, row, 16, 4); break;
    case 8: trace_packets(job, column, row, 8, 4); break;
    case 4: trace_packets(job, column, row, 4, 2); break;
    default: trace_packets(job, column, row, 1, 1); break;
    }
}

static void trace_task(void *argument, uint32_t index)
{
    const trace_job *job = argument;
    const uint32_t column = index % job->tasks_across * TASK_PACKETS, row = index / job->tasks_across * TASK_PACKETS;
    const float_mode callers = float_mode_flush();
    trace_square(job, column, row);
    float_mode_restore(callers);
}

void embree_view_trace(embree_view *view, RTCScene scene, cgt_context *context)
{
    trace_job job = {view, scene, (view->across + TASK_PACKETS - 1) / TASK_PACKETS};
    const uint32_t tasks_down = (view->down + TASK_PACKETS - 1) / TASK_PACKETS;
    cgt_context_run_tasks(context, trace_task, &job, job.tasks_across * tasks_down);
}
