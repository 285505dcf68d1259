/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shadows of a frame, light by light: cut into tiles, each a task. The hits of a tile are packed and go to the light
 * together, as those of cgt_occluded_points do. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/float_environment.h"
#include "query/camera.h"
#include "trace/bands/band_trace.h"
#include "trace/trace_light.h"

#define TILE_EDGE 64u
#define SAMPLED_TILES 8u /* that are looked at before tiles of the grid or a tree are chosen */

_Static_assert(TILE_EDGE *TILE_EDGE <= CGT_RAYS_CHUNK, "a tile is a batch");

typedef struct shadow_job {
    const cgt_scene *scene;
    const cgt_frame *frame;
    const cgt_light *light;
    cgt_shadow_options shadows;
    uint8_t *occluded; /* the light's plane */
    cgt_camera_rays camera;
    bool has_masks; /* the camera's mask leaves something out */
    cgt_trace_settings settings;
    size_t row_stride;
    uint32_t tiles_across, tiles;
    cgt_trace_counter *counter;
    const cgt_band_call *bands; /* NULL: the scene has none */
    cgt_light_progress progress;
} shadow_job;

/* A tile's hits. */
typedef struct tile_batch {
    cgt_point_batch points;
    uint32_t live, invalid;
    uint16_t pixel[TILE_EDGE * TILE_EDGE]; /* of each live point: y * TILE_EDGE + x */
} tile_batch;

/* ---- the points of a tile ---- */

/* A row of a tile: its points, and the columns of those that are live. */
typedef struct tile_row {
    float position[3][TILE_EDGE];
    uint32_t live, column[TILE_EDGE];
} tile_row;

/* The points of pixels x0 to x0 + width - 1 of row y, by the arithmetic of cgt_camera_pixel: loops that compilers
 * vectorise. */
static void compute_positions(const shadow_job *job, uint32_t x0, uint32_t y, uint32_t width, tile_row *row)
{
    const cgt_camera_rays *c = &job->camera;
    const float *t = job->frame->t + (size_t)y * job->row_stride + x0;
    const float py = 1 - ((float)y + 0.5f) * c->pixel[1];
    for (int a = 0; a < 3; a++) {
        const float from = c->orthographic ? c->eye[a] : c->fwd[a], right = c->right[a], up = py * c->up[a];
        float *position = row->position[a];
        for (uint32_t k = 0; k < width; k++) {
            const float px = ((float)(int32_t)(x0 + k) + 0.5f) * c->pixel[0] - 1, sum = (from + px * right) + up;
            position[k] = c->orthographic ? sum + t[k] * c->fwd[a] : c->eye[a] + t[k] * sum;
        }
    }
}

/* Lists the live points of a row, as cgt_find_point_state says it, in loops that compilers vectorise; t_min and t_max are
 * the same for all. Returns how many are invalid. */
static uint32_t list_live(const shadow_job *job, const float *t, uint32_t width, tile_row *row)
{
    const bool is_point = job->light->kind == CGT_LIGHT_POINT;
    const bool off = job->shadows.t_min > (is_point ? 1 : INFINITY);
    uint32_t bad[TILE_EDGE] = {0}, away[TILE_EDGE] = {0}, live[TILE_EDGE], invalid = 0;
    for (int a = 0; a < 3; a++) {
        const float light = job->light->position[a], *position = row->position[a];
        for (uint32_t k = 0; k < width; k++) {
            const float d = is_point ? light - position[k] : light;
            bad[k] |= (uint32_t) !(fabsf(position[k]) <= FLT_MAX) | (uint32_t) !(fabsf(d) <= FLT_MAX);
            away[k] |= d != 0;
        }
    }
    for (uint32_t k = 0; k < width; k++) {
        const uint32_t hit = fabsf(t[k]) != INFINITY, good = (bad[k] == 0) & (away[k] | (uint32_t)!is_point);
        live[k] = hit & good & (uint32_t)!off;
        invalid += hit & (good ^ 1);
    }
    row->live = 0;
    for (uint32_t k = 0; k < width; k++) { /* what is written counts only where the point is live */
        row->column[row->live] = k;
        row->live += live[k];
    }
    return invalid;
}

/* Both take what belongs to the live points of a row. */
static void take_floats(const tile_row *row, const float *from, uint32_t width, float *to)
{
    if (row->live == width)
        memcpy(to, from, width * sizeof *to);
    else
        for (uint32_t k = 0; k < row->live; k++)
            to[k] = from[row->column[k]];
}

static void take_ids(const tile_row *row, const uint32_t *from, uint32_t width, uint32_t *to)
{
    if (row->live == width)
        memcpy(to, from, width * sizeof *to);
    else
        for (uint32_t k = 0; k < row->live; k++)
            to[k] = from[row->column[k]];
}

/* Whether no pixel of a row was hit: then nothing else is read. */
static bool row_is_empty(const float *t, uint32_t width)
{
    uint32_t hits = 0;
    for (uint32_t k = 0; k < width; k++)
        hits += fabsf(t[k]) != INFINITY;
    return !hits;
}

/* Appends the hits of a tile's row. */
static void append_row(const shadow_job *job, uint32_t x0, uint32_t y, uint32_t width, uint32_t pixel, tile_batch *b)
{
    const cgt_frame *f = job->frame;
    const size_t element = (size_t)y * job->row_stride + x0;
    const uint32_t first = b->live;
    tile_row row;
    if (row_is_empty(f->t + element, width))
        return;
    compute_positions(job, x0, y, width, &row);
    b->invalid += list_live(job, f->t + element, width, &row);
    for (int a = 0; a < 3; a++)
        take_floats(&row, row.position[a], width, b->points.position[a] + first);
    if (f->primitive && f->geometry) {
        take_ids(&row, f->primitive + element, width, b->points.primitive + first);
        take_ids(&row, f->geometry + element, width, b->points.geometry + first);
    }
    for (uint32_t k = 0; k < row.live; k++)
        b->pixel[first + k] = (uint16_t)(pixel + row.column[k]);
    b->live = first + row.live;
}

static void fill_batch(const shadow_job *job, uint32_t index, tile_batch *b)
{
    const cgt_frame *f = job->frame;
    const bool skips = f->primitive && f->geometry;
    const uint32_t x0 = index % job->tiles_across * TILE_EDGE, y0 = index / job->tiles_across * TILE_EDGE;
    const uint32_t width = f->width - x0 < TILE_EDGE ? f->width - x0 : TILE_EDGE;
    b->live = b->invalid = 0;
    for (uint32_t y = 0; y < TILE_EDGE && y0 + y < f->height; y++)
        append_row(job, x0, y0 + y, width, y * TILE_EDGE, b);
    for (uint32_t k = 0; k < b->live && job->shadows.t_min != 0; k++)
        b->points.t_min[k] = job->shadows.t_min;
    for (uint32_t k = 0; k < b->live && job->has_masks; k++)
        b->points.mask[k] = job->camera.mask;
    cgt_point_batch *p = &b->points;
    p->rays = (cgt_rays){.count = b->live,
                         .org = {p->position[0], p->position[1], p->position[2]},
                         .t_min = job->shadows.t_min != 0 ? p->t_min : NULL,
                         .mask = job->has_masks ? p->mask : NULL,
                         .skip_primitive = skips ? p->primitive : NULL,
                         .skip_geometry = skips ? p->geometry : NULL};
}

/* ---- a light ---- */

static uint8_t *tile_results(const shadow_job *job, uint32_t index)
{
    const size_t x0 = index % job->tiles_across * TILE_EDGE, y0 = index / job->tiles_across * TILE_EDGE;
    return job->occluded + y0 * job->row_stride + x0;
}

static void store_batch(const shadow_job *job, uint32_t index, const tile_batch *b)
{
    const cgt_frame *f = job->frame;
    const uint32_t x0 = index % job->tiles_across * TILE_EDGE, y0 = index / job->tiles_across * TILE_EDGE;
    const uint32_t width = f->width - x0 < TILE_EDGE ? f->width - x0 : TILE_EDGE;
    uint8_t *to = tile_results(job, index);
    for (uint32_t y = 0; y < TILE_EDGE && y0 + y < f->height; y++)
        memset(to + y * job->row_stride, 0, width);
    for (uint32_t k = 0; k < b->live; k++)
        to[b->pixel[k] / TILE_EDGE * job->row_stride + b->pixel[k] % TILE_EDGE] = b->points.occluded[k];
}

/* Returns whether the loose grid's tiles did not give the points up. */
static bool trace_batch(const shadow_job *job, uint32_t index, tile_batch *b, cgt_counts *counts)
{
    const cgt_scene *s = job->scene;
    if (job->bands)
        return cgt_bands_trace(job->bands, index % job->bands->slots, &b->points.rays, job->light, 0, b->live, NULL,
                               b->points.occluded, counts);
    return s->context->kernel->trace_light(&s->committed_scene, &b->points.rays, job->light, 0, b->live, &job->settings,
                                           b->points.occluded, counts);
}

static void trace_shadow_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    shadow_job *job = argument;
    cgt_counts counts = {.scratch = scratch};
    tile_batch *b = cgt_scratch_take(scratch, sizeof *b);
    fill_batch(job, index, b);
    const bool tries = b->live && !cgt_light_is_hopeless(&job->progress);
    const bool done = !b->live || (tries && trace_batch(job, index, b, &counts));
    if (tries)
        cgt_light_remember(&job->progress, job->scene, &counts, b->live, done);
    if (!done) {
        counts.given_up = b->live;
        *tile_results(job, index) = CGT_LIGHT_GIVEN_UP;
        atomic_fetch_add_explicit(&job->progress.given_up, b->live, memory_order_relaxed);
    } else {
        counts.rays += b->invalid;
        counts.invalid_rays += b->invalid;
        store_batch(job, index, b);
    }
    cgt_scratch_return(scratch, b);
    cgt_trace_counter_add(job->counter, &counts);
}

static void trace_given_up_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    if (*tile_results(argument, index) == CGT_LIGHT_GIVEN_UP)
        trace_shadow_tile(argument, index, scratch);
}

/* Looks at some tiles. Returns about how many points the frame has. */
static uint64_t look(const shadow_job *job, cgt_light_estimate *estimate, cgt_scratch *scratch)
{
    const uint32_t sampled = job->tiles < SAMPLED_TILES ? job->tiles : SAMPLED_TILES;
    uint64_t live = 0;
    tile_batch *b = cgt_scratch_take(scratch, sizeof *b);
    cgt_float_environment callers;
    *estimate = (cgt_light_estimate){0};
    cgt_float_environment_enter(&callers);
    for (uint32_t k = 0; k < sampled; k++) {
        fill_batch(job, (uint32_t)(((uint64_t)job->tiles * (2 * k + 1)) / (2 * sampled)), b);
        live += b->live;
        cgt_light_estimate_add(estimate, job->scene, job->light, &b->points.rays, 0, b->live);
    }
    cgt_float_environment_leave(&callers);
    cgt_scratch_return(scratch, b);
    return sampled ? live * job->tiles / sampled : 0;
}

static cgt_light_tasks tasks_of(shadow_job *job)
{
    return (cgt_light_tasks){.scene = job->scene,
                             .light = job->light,
                             .trace = trace_shadow_tile,
                             .trace_given_up = trace_given_up_tile,
                             .argument = job,
                             .tasks = job->tiles,
                             .progress = &job->progress,
                             .bands = &job->bands};
}

static cgt_result trace_light_in_bands(shadow_job *job)
{
    atomic_store_explicit(&job->progress.given_up, 0, memory_order_relaxed);
    job->progress.budget = 0;
    const cgt_light_tasks tasks = tasks_of(job);
    const uint64_t points = (uint64_t)job->tiles * (TILE_EDGE * TILE_EDGE);
    return cgt_light_run_bands(&tasks, &job->settings, points, TILE_EDGE * TILE_EDGE);
}

/* Traces all tiles to the light. */
static cgt_result trace_light(shadow_job *job)
{
    const cgt_scene *s = job->scene;
    cgt_trace_settings *settings = &job->settings;
    cgt_light_estimate estimate;
    cgt_scratch *scratch = cgt_scratch_borrow(s->context, 1);
    if (!scratch)
        return CGT_ERROR_OUT_OF_MEMORY;
    const uint64_t points = look(job, &estimate, scratch);
    cgt_scratch_give_back(s->context, scratch);
    const cgt_result result = cgt_light_choose(s, job->light, &estimate, points, settings, &job->progress);
    if (result != CGT_OK)
        return result;
    const cgt_light_tasks tasks = tasks_of(job);
    return cgt_light_run_structure(&tasks, settings);
}

/* ---- the call ---- */

void cgt_shadow_options_init(cgt_shadow_options *shadows) { *shadows = (cgt_shadow_options){0}; }

static cgt_result check_shadows(cgt_context *c, const shadow_job *job, const cgt_light *lights, uint32_t count)
{
    const cgt_frame *f = job->frame;
    if (!f->t)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "shadows: the frame needs its plane t");
    if (!(job->shadows.t_min >= 0))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "shadows: t_min %g: 0 or more", (double)job->shadows.t_min);
    if (count && job->row_stride > SIZE_MAX / f->height / count)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "shadows: the planes of %u lights leave the address space", count);
    cgt_result result = CGT_OK;
    for (uint32_t k = 0; k < count && result == CGT_OK; k++)
        result = cgt_check_light(c, &lights[k]);
    return result;
}

/* Checks all arguments and makes the camera's rays. */
static cgt_result prepare_job(shadow_job *job, const cgt_camera *camera, const cgt_light *lights, uint32_t count,
                              const cgt_trace_options *options)
{
    const cgt_frame *f = job->frame;
    cgt_context *c = job->scene->context;
    cgt_result result = cgt_trace_prepare(job->scene, options, false, &job->settings, job->counter);
    if (result == CGT_OK)
        result = cgt_check_frame(c, f);
    if (result != CGT_OK)
        return result;
    job->row_stride = f->row_stride ? f->row_stride : f->width;
    job->tiles_across = (f->width + TILE_EDGE - 1) / TILE_EDGE;
    job->tiles = job->tiles_across * ((f->height + TILE_EDGE - 1) / TILE_EDGE);
    result = check_shadows(c, job, lights, count);
    return result == CGT_OK ? cgt_prepare_camera(c, camera, f, &job->camera) : result;
}

cgt_result cgt_occluded_frame(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                              const cgt_light *lights, uint32_t count, const cgt_shadow_options *shadows,
                              uint8_t *occluded, const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    if (!scene || !camera || !frame || (count && (!lights || !occluded)))
        return CGT_ERROR_INVALID_ARGUMENT;
    shadow_job job = {.scene = scene, .frame = frame, .counter = &counter};
    job.shadows.t_min = shadows ? shadows->t_min : 0;
    cgt_result result = prepare_job(&job, camera, lights, count, options);
    if (result != CGT_OK)
        return result;
    job.has_masks = cgt_primitives_masked_out(&scene->committed_scene.prims, job.camera.mask);
    for (uint32_t k = 0; k < count && result == CGT_OK; k++) {
        job.light = &lights[k];
        job.occluded = occluded + k * job.row_stride * frame->height;
        result = scene->in_bands ? trace_light_in_bands(&job) : trace_light(&job);
    }
    if (result == CGT_OK)
        cgt_trace_store_statistics(options, &job.settings, &counter);
    return result;
}
