/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame: cut into tiles, each a task. A tile is traced straight into the caller's planes, or into a buffer
 * of the task's that goes to the visitor and from there, row by row, to the planes; so do normals of which pixels are
 * apart. */
#include <math.h>
#include <string.h>

#include "core/float_environment.h"
#include "core/scratch_tasks.h"
#include "dispatch/kernel.h"
#include "query/tile_limits.h"
#include "trace/bands/band_trace.h"
#include "trace/trace_call.h"

#define SQUARE_EDGE 64u
#define STRIP_HEIGHT 4u
#define STRIP_WIDTH 1280u   /* Chapman's 720p line; wider frames take several side by side */
#define MAX_TASK_TILES 8u   /* side by side, so that they share the lines of planes that do not begin at lines */
#define TASKS_PER_THREAD 8u /* at least, if a task takes several tiles */
#define TILE_PIXELS (STRIP_WIDTH * STRIP_HEIGHT)

typedef struct frame_job {
    const cgt_scene *scene;
    const cgt_frame *frame;
    cgt_camera_rays camera;
    cgt_trace_settings settings;
    bool by_tiles;               /* whole tiles go through a loose grid, no packets */
    cgt_region planes;           /* the whole frame; without normals of which pixels are apart */
    size_t vector_stride;        /* of the frame's normals and positions */
    const cgt_band_frame *bands; /* NULL: the scene has none */
    uint32_t tile_width, tile_height, tiles_across;
    uint32_t first_width;   /* of the tiles in the first column */
    bool buffered;          /* tiles go through a buffer */
    bool positions;         /* somebody asked for them */
    bool visited_positions; /* the visitor did */
    cgt_trace_counter *counter;
    cgt_visits visits;
} frame_job;

static cgt_region region_in_buffer(const frame_job *job, const cgt_region *planes, uint32_t buffer[][TILE_PIXELS])
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

/* Where a tile's positions go: to the frame's planes, or to a buffer that the visitor sees. */
typedef struct tile_positions {
    float *plane[3];
    size_t row_stride, vector_stride;
} tile_positions;

/* The first of a tile's elements in the frame's planes of vectors. */
static size_t first_vector(const frame_job *job, const cgt_region *r)
{
    return (r->y * job->planes.row_stride + r->x) * job->vector_stride;
}

static tile_positions positions_in_planes(const frame_job *job, const cgt_region *r)
{
    tile_positions p = {.row_stride = job->planes.row_stride, .vector_stride = job->vector_stride};
    for (int a = 0; a < 3; a++)
        p.plane[a] = job->frame->position[a] ? job->frame->position[a] + first_vector(job, r) : NULL;
    return p;
}

/* Copies a tile's vectors from a buffer to the frame's planes. */
static void copy_vectors(const frame_job *job, const cgt_region *r, float *const from[3], float *const to[3])
{
    for (uint32_t y = 0; y < r->height; y++) {
        const size_t row = first_vector(job, r) + y * job->planes.row_stride * job->vector_stride;
        for (uint32_t x = 0; x < r->width; x++)
            for (int a = 0; a < 3; a++)
                to[a][row + x * job->vector_stride] = from[a][(size_t)y * r->width + x];
    }
}

/* Computes the positions of a tile's hits, from their t. */
static void compute_positions(const frame_job *job, const cgt_region *r, const tile_positions *p)
{
    for (uint32_t y = 0; y < r->height; y++)
        for (uint32_t x = 0; x < r->width; x++) {
            const float t = r->t[y * r->row_stride + x];
            float org[3], dir[3];
            cgt_camera_pixel(&job->camera, r->x + x, r->y + y, org, dir);
            for (int a = 0; a < 3; a++)
                if (p->plane[a])
                    p->plane[a][(y * p->row_stride + x) * p->vector_stride] = isinf(t) ? INFINITY : org[a] + t * dir[a];
        }
}

static void call_visitor(frame_job *job, const cgt_region *r, const tile_positions *p)
{
    const cgt_frame *f = job->frame;
    cgt_region q = *r;
    for (int k = 0; k < CGT_PLANES; k++)
        q.plane[k] = f->visitor_fields & cgt_plane_field[k] ? q.plane[k] : NULL;
    float *const *const position = job->visited_positions ? p->plane : (float *[3]){NULL, NULL, NULL};
    const cgt_tile tile = {.x = q.x,
                           .y = q.y,
                           .width = q.width,
                           .height = q.height,
                           .row_stride = q.row_stride,
                           .t = q.t,
                           .primitive = q.primitive,
                           .geometry = q.geometry,
                           .normal = {q.normal[0], q.normal[1], q.normal[2]},
                           .u = q.u,
                           .v = q.v,
                           .position = {position[0], position[1], position[2]}};
    cgt_visits_enter(&job->visits);
    cgt_visits_leave(&job->visits, f->visitor(f->visitor_user, &tile));
}

static void trace_region(const frame_job *job, uint32_t index, const cgt_region *r, cgt_scratch *scratch)
{
    const cgt_scene *s = job->scene;
    const cgt_kernel *kernel = s->context->kernel;
    cgt_counts counts = {.scratch = scratch};
    if (job->bands)
        cgt_band_trace_region(job->bands, index % job->bands->call.slots, r, &counts);
    else
        (job->by_tiles ? kernel->trace_tile : kernel->trace_region)(&s->committed_scene, &job->camera, &job->settings,
                                                                    r, &counts);
    cgt_trace_counter_add(job->counter, &counts);
}

static void trace_buffered(frame_job *job, uint32_t index, const cgt_region *planes, const tile_positions *positions,
                           cgt_scratch *scratch)
{
    uint32_t(*buffer)[TILE_PIXELS] = cgt_scratch_take(scratch, CGT_PLANES * sizeof *buffer);
    const cgt_region tile = region_in_buffer(job, planes, buffer);
    trace_region(job, index, &tile, scratch);
    if (job->positions)
        compute_positions(job, &tile, positions);
    if (job->frame->visitor)
        call_visitor(job, &tile, positions);
    copy_to_planes(planes, &tile);
    if (job->frame->normal[0] && !job->planes.normal[0])
        copy_vectors(job, planes, tile.normal, job->frame->normal);
    cgt_scratch_return(scratch, buffer);
}

static void trace_for_visitor(frame_job *job, uint32_t index, const cgt_region *planes, cgt_scratch *scratch)
{
    float(*buffer)[TILE_PIXELS] = cgt_scratch_take(scratch, 3 * sizeof *buffer);
    const tile_positions positions = {{buffer[0], buffer[1], buffer[2]}, planes->width, 1};
    trace_buffered(job, index, planes, &positions, scratch);
    if (job->frame->position[0])
        copy_vectors(job, planes, positions.plane, job->frame->position);
    cgt_scratch_return(scratch, buffer);
}

static void trace_to_planes(frame_job *job, uint32_t index, const cgt_region *planes, const tile_positions *positions,
                            cgt_scratch *scratch)
{
    trace_region(job, index, planes, scratch);
    if (job->positions)
        compute_positions(job, planes, positions);
    if (job->frame->visitor)
        call_visitor(job, planes, positions);
}

static void trace_frame_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    frame_job *job = argument;
    const uint32_t column = index % job->tiles_across;
    const uint32_t y = job->frame->first_row + index / job->tiles_across * job->tile_height;
    const uint32_t x = column ? job->first_width + (column - 1) * job->tile_width : 0;
    if (cgt_visits_stopped(&job->visits))
        return;
    const cgt_region part =
        cgt_region_part(&job->planes, x, y, column ? job->tile_width : job->first_width, job->tile_height);
    const tile_positions positions = positions_in_planes(job, &part);
    if (job->visited_positions && (!positions.plane[0] || job->buffered || job->vector_stride > 1))
        trace_for_visitor(job, index, &part, scratch);
    else if (job->buffered)
        trace_buffered(job, index, &part, &positions, scratch);
    else
        trace_to_planes(job, index, &part, &positions, scratch);
}

void cgt_frame_init(cgt_frame *frame, uint32_t width, uint32_t height)
{
    *frame = (cgt_frame){.width = width, .height = height};
}

#define LINE_WORDS 16u /* of a cache line */

/* Words from each row's begin to the first cache line, LINE_WORDS or more where planes or rows differ. */
static uint32_t words_before_lines(const cgt_region *planes)
{
    uint32_t words = LINE_WORDS;
    for (int k = 0; k < CGT_PLANES; k++) {
        const uint32_t own = (uint32_t)(-(uintptr_t)planes->plane[k] / sizeof(uint32_t) % LINE_WORDS);
        if (planes->plane[k] && words != LINE_WORDS && words != own)
            return LINE_WORDS;
        words = planes->plane[k] ? own : words;
    }
    return planes->row_stride % LINE_WORDS ? LINE_WORDS : words;
}

/* Several tiles where lines are shared, as long as there are enough tasks. A caller's runner counts as 64 threads. */
static uint32_t choose_task_tiles(const frame_job *job)
{
    const uint32_t threads = job->scene->context->threads ? job->scene->context->threads : 64;
    const uint64_t across = (job->frame->width + SQUARE_EDGE - 1) / SQUARE_EDGE;
    const uint64_t down = (job->frame->row_count + SQUARE_EDGE - 1) / SQUARE_EDGE;
    uint32_t tiles = MAX_TASK_TILES;
    while (tiles > 1 && (across + tiles - 1) / tiles * down < (uint64_t)threads * TASKS_PER_THREAD)
        tiles /= 2;
    return tiles;
}

/* Makes tiles begin at cache lines: the first column of them is narrower. Where planes or rows begin at different
 * places in their lines, a task takes several tiles side by side, which share lines. */
static void align_tiles(frame_job *job)
{
    job->first_width = job->tile_width;
    if (!job->by_tiles || !job->planes.nontemporal)
        return;
    const uint32_t words = words_before_lines(&job->planes);
    if (words == LINE_WORDS)
        job->first_width = job->tile_width = SQUARE_EDGE * choose_task_tiles(job);
    else if (words)
        job->first_width = SQUARE_EDGE - LINE_WORDS + words;
}

/* Chooses tiles and whether they are traced as a whole. */
static void plan_frame(frame_job *job, const cgt_trace_options *options)
{
    const cgt_frame *f = job->frame;
    const cgt_committed_scene *committed_scene = &job->scene->committed_scene;
    const uint32_t visitor_fields = f->visitor ? f->visitor_fields : 0;
    void *const plane[CGT_PLANES] = CGT_PLANES_OF(f);
    job->vector_stride = f->vector_stride ? f->vector_stride : 1;
    const bool normals_apart = f->normal[0] && job->vector_stride > 1;
    job->visited_positions = visitor_fields & CGT_FIELD_POSITION;
    job->positions = f->position[0] || job->visited_positions;
    if (!cgt_primitives_masked_out(&committed_scene->prims, job->camera.mask))
        job->camera.mask = UINT32_MAX;
    job->by_tiles = !cgt_requires_packets(options) && cgt_tile_supports(committed_scene, &job->camera);
    job->planes = (cgt_region){.width = f->width,
                               .height = f->height,
                               .row_stride = f->row_stride ? f->row_stride : f->width,
                               .nontemporal = !f->visitor && !job->positions && !normals_apart}; /* t is read again */
    for (int k = 0; k < CGT_PLANES; k++)
        job->planes.plane[k] = normals_apart && cgt_plane_field[k] == CGT_FIELD_NORMAL ? NULL : plane[k];
    const uint32_t plane_fields = cgt_planes_fields(plane);
    job->settings.fields =
        (plane_fields | visitor_fields | (job->positions ? CGT_FIELD_T : 0u)) & ~(uint32_t)CGT_FIELD_POSITION;
    job->buffered = job->settings.strip || normals_apart || (job->settings.fields & ~plane_fields);
    job->tile_width = job->settings.strip ? STRIP_WIDTH : SQUARE_EDGE;
    job->tile_height = job->settings.strip ? STRIP_HEIGHT : SQUARE_EDGE;
    align_tiles(job);
    job->tiles_across = 1;
    if (f->width > job->first_width)
        job->tiles_across += (f->width - job->first_width + job->tile_width - 1) / job->tile_width;
}

/* A frame that asks for nothing is a mistake, and not a fast frame. */
static cgt_result check_asks_for_something(cgt_context *c, const cgt_frame *f)
{
    void *const plane[CGT_PLANES] = CGT_PLANES_OF(f);
    return f->visitor || f->position[0] || cgt_planes_fields(plane)
               ? CGT_OK
               : cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: neither a plane nor a visitor: it asks for nothing");
}

/* Traces all tiles of a scene in bands. */
static cgt_result trace_bands(frame_job *job, const cgt_trace_options *options, uint32_t tiles)
{
    cgt_band_frame frame;
    cgt_result result = cgt_band_frame_begin(job->scene, &job->camera, &job->settings, cgt_requires_packets(options),
                                             tiles, job->tile_width * job->tile_height, &frame);
    if (result != CGT_OK)
        return result;
    job->bands = &frame;
    result = cgt_bands_run(&frame.call, trace_frame_tile, job, tiles);
    cgt_bands_end(&frame.call);
    job->bands = NULL;
    return result;
}

cgt_result cgt_trace_camera(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                            const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    frame_job job = {.scene = scene, .counter = &counter};
    if (!scene || !camera || !frame)
        return cgt_fail_null(scene, __func__);
    cgt_context *c = scene->context;
    cgt_result result = cgt_trace_prepare(scene, options, true, &job.settings, &counter);
    if (result == CGT_OK)
        result = cgt_check_frame(c, frame);
    if (result == CGT_OK)
        result = check_asks_for_something(c, frame);
    if (result == CGT_OK)
        result = cgt_prepare_camera(c, camera, frame, &job.camera);
    if (result != CGT_OK)
        return result;
    const cgt_frame cut = cgt_cut_frame(frame);
    job.frame = &cut;
    plan_frame(&job, options);
    cgt_set_flag(&scene->mutable_scene->record.camera);
    if (!job.by_tiles && !cgt_requires_packets(options)) /* pixels are rays then */
        result = cgt_ready_structures(scene, (uint64_t)cut.width * cut.row_count, &job.settings);
    if (result != CGT_OK)
        return result;
    cgt_visits_begin(&job.visits);
    const uint32_t tiles = job.tiles_across * ((cut.row_count + job.tile_height - 1) / job.tile_height);
    if (scene->in_bands)
        result = trace_bands(&job, options, tiles);
    else
        result = cgt_run_scratch_tasks(c, trace_frame_tile, &job, tiles);
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return cgt_visits_end(c, &job.visits, "the visitor stopped the frame");
}

/* Whether the elements of a rectangle of rays have addresses. */
static bool fits_arrays(uint32_t columns, uint32_t rows, size_t stride)
{
    return stride % sizeof(float) == 0 && stride <= SIZE_MAX / 2 / ((uint64_t)columns * rows + 1);
}

static void write_rays(const cgt_camera_rays *rays, uint32_t x, uint32_t y, uint32_t columns, uint32_t rows,
                       size_t stride, float *const org[3], float *const dir[3])
{
    size_t offset = 0;
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < columns; i++, offset += stride) {
            float o[3], d[3];
            cgt_camera_pixel(rays, x + i, y + j, o, d);
            for (int a = 0; a < 3; a++) {
                memcpy((char *)org[a] + offset, &o[a], sizeof o[a]);
                memcpy((char *)dir[a] + offset, &d[a], sizeof d[a]);
            }
        }
}

cgt_result cgt_camera_get_rays(const cgt_camera *camera, uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                               uint32_t columns, uint32_t rows, size_t stride, float *const org[3], float *const dir[3])
{
    char message[CGT_CAMERA_MESSAGE_BYTES];
    cgt_camera_rays rays;
    cgt_float_environment callers;
    if (!camera || !org || !dir || !width || !height || x > width || y > height || columns > width - x ||
        rows > height - y)
        return CGT_ERROR_INVALID_ARGUMENT;
    for (int a = 0; a < 3; a++)
        if (!org[a] || !dir[a])
            return CGT_ERROR_INVALID_ARGUMENT;
    if (width > 65536 || height > 65536 || !fits_arrays(columns, rows, stride))
        return stride % sizeof(float) ? CGT_ERROR_INVALID_ARGUMENT : CGT_ERROR_TOO_LARGE;
    cgt_float_environment_enter(&callers);
    const cgt_result result = cgt_camera_prepare(camera, width, height, &rays, message);
    if (result == CGT_OK)
        write_rays(&rays, x, y, columns, rows, stride ? stride : sizeof(float), org, dir);
    cgt_float_environment_leave(&callers);
    return result;
}

cgt_result cgt_camera_get_ray(const cgt_camera *camera, uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                              float org[3], float dir[3])
{
    if (!org || !dir || x >= width || y >= height)
        return CGT_ERROR_INVALID_ARGUMENT;
    float *const to_org[3] = {&org[0], &org[1], &org[2]}, *const to_dir[3] = {&dir[0], &dir[1], &dir[2]};
    return cgt_camera_get_rays(camera, width, height, x, y, 1, 1, 0, to_org, to_dir);
}
