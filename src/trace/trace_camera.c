/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame: cut into tiles, each a task. A tile is traced straight into the caller's planes, or into a buffer
 * on the stack that goes to the visitor and from there, row by row, to the planes. */
#include <math.h>
#include <string.h>

#include "core/float_environment.h"
#include "scene/scene.h"
#include "trace/trace_call.h"

#define SQUARE_EDGE 64u
#define STRIP_HEIGHT 4u
#define STRIP_WIDTH 1280u /* Chapman's 720p line; wider frames take several side by side */
#define TILE_PIXELS (STRIP_WIDTH * STRIP_HEIGHT)

typedef struct frame_job {
    const cgt_scene *scene;
    const cgt_frame *frame;
    cgt_camera_rays camera;
    cgt_trace_settings settings;
    uint32_t tile_width, tile_height, tiles_across;
    size_t row_stride;
    bool buffered; /* tiles go through a buffer */
    atomic_bool stopped;
    cgt_trace_counter *counter;
    cgt_float_environment callers; /* the visitor's, too */
} frame_job;

static uint32_t plane_fields(const cgt_frame *f)
{
    return (f->t ? CGT_FIELD_T : 0u) | (f->primitive ? CGT_FIELD_PRIMITIVE : 0u) |
           (f->geometry ? CGT_FIELD_GEOMETRY : 0u) | (f->normal[0] ? CGT_FIELD_NORMAL : 0u) |
           (f->u ? CGT_FIELD_UV : 0u);
}

/* The whole frame, in the caller's planes. */
static cgt_region frame_region(const frame_job *job)
{
    const cgt_frame *f = job->frame;
    void *const plane[CGT_PLANES] = {f->t,         f->primitive, f->geometry, f->normal[0],
                                     f->normal[1], f->normal[2], f->u,        f->v};
    cgt_region r = {.width = f->width, .height = f->height, .row_stride = job->row_stride, .nontemporal = !f->visitor};
    for (int k = 0; k < CGT_PLANES; k++)
        r.plane[k] = plane[k];
    return r;
}

static cgt_region region_in_buffer(const frame_job *job, const cgt_region *planes,
                                   uint32_t buffer[CGT_PLANES][TILE_PIXELS])
{
    cgt_region r = *planes;
    r.row_stride = planes->width;
    r.nontemporal = false;
    for (int k = 0; k < CGT_PLANES; k++)
        r.plane[k] = job->settings.fields & cgt_plane_field[k] ? buffer[k] : NULL;
    return r;
}

static void copy_to_planes(const cgt_region *planes, const cgt_region *tile)
{
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t y = 0; planes->plane[k] && y < tile->height; y++)
            memcpy(planes->plane[k] + y * planes->row_stride, tile->plane[k] + y * tile->row_stride,
                   tile->width * sizeof(uint32_t));
}

/* Tasks run in the library's floating-point environment, the visitor in that of the call. */
static int call_visitor(const frame_job *job, const cgt_region *r)
{
    const cgt_frame *f = job->frame;
    cgt_float_environment visitors;
    void *plane[CGT_PLANES];
    for (int k = 0; k < CGT_PLANES; k++)
        plane[k] = f->visitor_fields & cgt_plane_field[k] ? r->plane[k] : NULL;
    const cgt_tile tile = {
        .x = r->x,
        .y = r->y,
        .width = r->width,
        .height = r->height,
        .row_stride = r->row_stride,
        .t = plane[CGT_PLANE_T],
        .primitive = plane[CGT_PLANE_PRIMITIVE],
        .geometry = plane[CGT_PLANE_GEOMETRY],
        .normal = {plane[CGT_PLANE_NORMAL], plane[CGT_PLANE_NORMAL + 1], plane[CGT_PLANE_NORMAL + 2]},
        .u = plane[CGT_PLANE_U],
        .v = plane[CGT_PLANE_V]};
    cgt_float_environment_leave(&job->callers);
    const int stop = f->visitor(f->visitor_user, &tile);
    cgt_float_environment_enter(&visitors);
    return stop;
}

static void trace_region_into(const frame_job *job, const cgt_region *r)
{
    const cgt_scene *s = job->scene;
    cgt_counts counts = {0};
    if (s->committed_scene.structure == CGT_STRUCTURE_LOOSE_GRID && job->settings.tiled)
        s->context->kernel->trace_tile(&s->committed_scene, &job->camera, &job->settings, r, &counts);
    else
        s->context->kernel->trace_region(&s->committed_scene, &job->camera, &job->settings, r, &counts);
    cgt_trace_counter_add(job->counter, &counts);
}

/* A function of its own: its stack is taken only where it is needed. */
__attribute__((noinline)) static int trace_buffered(const frame_job *job, const cgt_region *planes)
{
    uint32_t buffer[CGT_PLANES][TILE_PIXELS];
    const cgt_region tile = region_in_buffer(job, planes, buffer);
    trace_region_into(job, &tile);
    const int stop = job->frame->visitor ? call_visitor(job, &tile) : 0;
    copy_to_planes(planes, &tile);
    return stop;
}

static void trace_frame_tile(void *argument, uint32_t index)
{
    frame_job *job = argument;
    const cgt_frame *f = job->frame;
    const uint32_t x = index % job->tiles_across * job->tile_width, y = index / job->tiles_across * job->tile_height;
    const cgt_region frame = frame_region(job);
    int stop = 0;
    if (atomic_load_explicit(&job->stopped, memory_order_relaxed))
        return;
    const cgt_region planes = cgt_region_part(&frame, x, y, job->tile_width, job->tile_height);
    if (job->buffered)
        stop = trace_buffered(job, &planes);
    else {
        trace_region_into(job, &planes);
        if (f->visitor)
            stop = call_visitor(job, &planes);
    }
    if (stop)
        atomic_store_explicit(&job->stopped, true, memory_order_relaxed);
}

cgt_result cgt_check_frame(cgt_context *c, const cgt_frame *f)
{
    const uint32_t all_fields =
        CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV;
    if (!f->width || !f->height)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: %u x %u pixels: at least 1 x 1", f->width, f->height);
    if (f->width > 65536 || f->height > 65536)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "frame: %u x %u pixels: at most 65,536 a side", f->width, f->height);
    if (f->row_stride && f->row_stride < f->width)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: row_stride is less than width");
    if (f->row_stride > SIZE_MAX / sizeof(float) / f->height)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "frame: row_stride times height leaves the address space");
    if (!f->normal[0] != !f->normal[1] || !f->normal[0] != !f->normal[2])
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: normal: all three planes or none");
    if (!f->u != !f->v)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: u and v: both planes or none");
    if (f->visitor_fields & ~all_fields)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: visitor_fields has unknown bits");
    return CGT_OK;
}

void cgt_frame_init(cgt_frame *frame, uint32_t width, uint32_t height)
{
    *frame = (cgt_frame){.width = width, .height = height};
}

static void compute_tiling(frame_job *job)
{
    const cgt_frame *f = job->frame;
    const uint32_t visitor_fields = f->visitor ? f->visitor_fields : 0;
    job->tile_width = job->settings.strip ? STRIP_WIDTH : SQUARE_EDGE;
    job->tile_height = job->settings.strip ? STRIP_HEIGHT : SQUARE_EDGE;
    job->tiles_across = (f->width + job->tile_width - 1) / job->tile_width;
    job->row_stride = f->row_stride ? f->row_stride : f->width;
    job->settings.fields = plane_fields(f) | visitor_fields;
    job->buffered = job->settings.strip || (visitor_fields & ~plane_fields(f));
}

cgt_result cgt_trace_camera(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                            const cgt_trace_options *options)
{
    frame_job job = {.scene = scene, .frame = frame};
    cgt_trace_counter counter;
    char message[160];
    if (!scene || !camera || !frame)
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_context *c = scene->context;
    cgt_result result = cgt_trace_prepare(scene, options, true, &job.settings, &counter);
    if (result == CGT_OK)
        result = cgt_check_frame(c, frame);
    if (result != CGT_OK)
        return result;
    cgt_float_environment_enter(&job.callers);
    result = cgt_camera_prepare(camera, frame->width, frame->height, &job.camera, message);
    cgt_float_environment_leave(&job.callers);
    if (result != CGT_OK)
        return cgt_fail(c, result, "%s", message);
    if (!cgt_primitives_masked_out(&scene->committed_scene.prims, job.camera.mask))
        job.camera.mask = UINT32_MAX;
    job.settings.tiled &= job.camera.mask == UINT32_MAX;
    compute_tiling(&job);
    job.counter = options && options->statistics ? &counter : NULL;
    atomic_init(&job.stopped, false);
    cgt_run_tasks(c, trace_frame_tile, &job,
                  job.tiles_across * ((frame->height + job.tile_height - 1) / job.tile_height));
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return atomic_load(&job.stopped) ? cgt_fail(c, CGT_ERROR_STOPPED, "the visitor stopped the frame") : CGT_OK;
}
