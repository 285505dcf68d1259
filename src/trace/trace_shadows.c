/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shadows of a frame, light by light: cut into tiles, each a task. The hits of a tile are packed and go to the light
 * together, as those of cgt_occluded_points do. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "dispatch/frame_points.h"
#include "trace/light_tasks.h"

#define BLOCK CGT_SHADOW_BLOCK
#define WHOLE_BLOCK 0xffffu

typedef struct shadow_job {
    const cgt_scene *scene;
    cgt_frame_source source; /* with the light */
    uint8_t *occluded;       /* the light's plane */
    cgt_camera_rays camera;
    cgt_trace_settings settings;
    uint32_t tiles_across, tiles;
    uint64_t points; /* about, of the frame */
    cgt_trace_counter *counter;
    bool visits_tiles;                 /* there is a visitor, and this is the last light */
    const cgt_shadow_options *shadows; /* NULL: the defaults */
    cgt_visits visits;
} shadow_job;

/* The first pixel of a tile. */
static uint32_t tile_x(const shadow_job *job, uint32_t index) { return index % job->tiles_across * CGT_SHADOW_TILE; }
static uint32_t tile_y(const shadow_job *job, uint32_t index)
{
    return job->source.frame->first_row + index / job->tiles_across * CGT_SHADOW_TILE;
}

/* ---- a light ---- */

static uint8_t *first_result(const void *owner, uint32_t index)
{
    const shadow_job *job = owner;
    return job->occluded + tile_y(job, index) * job->source.row_stride + tile_x(job, index);
}

/* Stores the batch's results to the plane of a light: 0 for pixels without a live point. */
static void store_points(const cgt_frame_source *s, uint32_t x0, uint32_t y0, const cgt_frame_points *p, uint8_t *plane)
{
    const cgt_frame *f = s->frame;
    const uint32_t width = f->width - x0 < CGT_SHADOW_TILE ? f->width - x0 : CGT_SHADOW_TILE;
    const uint8_t *from = p->batch.occluded;
    uint8_t *to = plane + (size_t)y0 * s->row_stride + x0;
    for (uint32_t y = 0; y < CGT_SHADOW_TILE && y0 + y < f->height; y++)
        memset(to + y * s->row_stride, 0, width);
    for (uint32_t k = 0; k < p->blocks; k++) {
        const uint32_t corner = p->block[k].corner;
        uint8_t *pixel = to + corner / CGT_SHADOW_TILE * s->row_stride + corner % CGT_SHADOW_TILE;
        uint32_t live = p->block[k].live;
        for (uint32_t row = 0; live == WHOLE_BLOCK && row < BLOCK; row++, from += BLOCK)
            memcpy(pixel + row * s->row_stride, from, BLOCK);
        for (live = live == WHOLE_BLOCK ? 0 : live; live; live &= live - 1) {
            const uint32_t i = (uint32_t)__builtin_ctz(live);
            pixel[i / BLOCK * s->row_stride + i % BLOCK] = *from++;
        }
    }
}

static void visit_tile(shadow_job *job, uint32_t index)
{
    const cgt_frame *f = job->source.frame;
    const uint32_t x = tile_x(job, index), y = tile_y(job, index);
    const uint32_t width = f->width - x < CGT_SHADOW_TILE ? f->width - x : CGT_SHADOW_TILE;
    const uint32_t height = f->height - y < CGT_SHADOW_TILE ? f->height - y : CGT_SHADOW_TILE;
    cgt_visits_enter(&job->visits);
    cgt_visits_leave(&job->visits, job->shadows->visitor(job->shadows->visitor_user, x, y, width, height));
}

static bool trace_tile(void *owner, cgt_light_tasks *tasks, uint32_t index, cgt_counts *counts)
{
    shadow_job *job = owner;
    const uint32_t x = tile_x(job, index), y = tile_y(job, index);
    if (cgt_visits_stopped(&job->visits))
        return true;
    cgt_frame_points *p = cgt_scratch_take(counts->scratch, sizeof *p);
    job->scene->context->kernel->list_frame_points(&job->source, x, y, p);
    const bool done =
        !p->live || cgt_light_trace_points(tasks, index, &p->batch.rays, 0, p->live, p->batch.occluded, counts);
    if (done) {
        counts->rays += p->invalid;
        counts->invalid_rays += p->invalid;
        store_points(&job->source, x, y, p, job->occluded);
    }
    cgt_scratch_return(counts->scratch, p);
    if (done && job->visits_tiles)
        visit_tile(job, index);
    return done;
}

/* Without a light nothing is traced. */
static void visit_unlit(void *argument, uint32_t index)
{
    shadow_job *job = argument;
    if (!cgt_visits_stopped(&job->visits))
        visit_tile(job, index);
}

#define SAMPLED_EDGE 16u /* of pixels across and down, one is sampled */

/* About how many pixels of the frame have a hit. */
static uint64_t count_points(const shadow_job *job)
{
    const cgt_frame *f = job->source.frame;
    uint64_t hits = 0;
    for (uint32_t y = f->first_row + SAMPLED_EDGE / 2; y < f->height; y += SAMPLED_EDGE)
        for (uint32_t x = SAMPLED_EDGE / 2; x < f->width; x += SAMPLED_EDGE)
            hits += fabsf(f->t[y * job->source.row_stride + x]) <= FLT_MAX;
    return hits * SAMPLED_EDGE * SAMPLED_EDGE;
}

/* Traces all tiles to the light. */
static cgt_result trace_light(shadow_job *job)
{
    cgt_light_tasks tasks = {.scene = job->scene,
                             .light = job->source.light,
                             .settings = &job->settings,
                             .counter = job->counter,
                             .count = job->tiles,
                             .points = job->points,
                             .most = CGT_SHADOW_TILE * CGT_SHADOW_TILE,
                             .owner = job,
                             .trace = trace_tile,
                             .first_result = first_result};
    return cgt_light_run(&tasks);
}

/* ---- the call ---- */

void cgt_shadow_options_init(cgt_shadow_options *shadows) { *shadows = (cgt_shadow_options){0}; }

static cgt_result check_shadows(cgt_context *c, const shadow_job *job, const cgt_frame *f, const cgt_light *lights,
                                uint32_t count)
{
    if (!f->t)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "shadows: the frame needs its plane t");
    if (!(job->source.t_min >= 0))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "shadows: t_min %g: 0 or more", (double)job->source.t_min);
    if (count && job->source.row_stride > SIZE_MAX / f->height / count)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "shadows: the planes of %u lights leave the address space", count);
    cgt_result result = CGT_OK;
    for (uint32_t k = 0; k < count && result == CGT_OK; k++)
        result = cgt_check_light(c, &lights[k]);
    return result;
}

/* Checks all arguments and makes the camera's rays. */
static cgt_result prepare_job(shadow_job *job, const cgt_camera *camera, const cgt_frame *f, cgt_frame *cut,
                              const cgt_light *lights, uint32_t count, const cgt_trace_options *options)
{
    cgt_context *c = job->scene->context;
    cgt_result result = cgt_trace_prepare(job->scene, options, false, &job->settings, job->counter);
    if (result == CGT_OK)
        result = cgt_check_frame(c, f);
    if (result != CGT_OK)
        return result;
    *cut = cgt_cut_frame(f);
    job->source.frame = cut;
    job->source.row_stride = f->row_stride ? f->row_stride : f->width;
    job->tiles_across = (f->width + CGT_SHADOW_TILE - 1) / CGT_SHADOW_TILE;
    job->tiles = job->tiles_across * ((cut->row_count + CGT_SHADOW_TILE - 1) / CGT_SHADOW_TILE);
    result = check_shadows(c, job, f, lights, count);
    return result == CGT_OK ? cgt_prepare_camera(c, camera, f, &job->camera) : result;
}

cgt_result cgt_occluded_frame(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                              const cgt_light *lights, uint32_t count, const cgt_shadow_options *shadows,
                              uint8_t *occluded, const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    cgt_frame cut;
    if (!scene || !camera || !frame || (count && (!lights || !occluded)))
        return cgt_fail_null(scene, __func__);
    const bool visits = shadows && shadows->visitor;
    shadow_job job = {.scene = scene, .counter = &counter, .shadows = shadows};
    job.source.camera = &job.camera;
    job.source.t_min = shadows ? shadows->t_min : 0;
    cgt_result result = prepare_job(&job, camera, frame, &cut, lights, count, options);
    if (result != CGT_OK)
        return result;
    job.source.has_masks = cgt_primitives_masked_out(&scene->committed_scene.prims, job.camera.mask);
    job.points = count_points(&job);
    cgt_visits_begin(&job.visits);
    if (!count && visits)
        cgt_run_tasks(scene->context, visit_unlit, &job, job.tiles);
    for (uint32_t k = 0; k < count && result == CGT_OK; k++) {
        job.source.light = &lights[k];
        job.visits_tiles = visits && k + 1 == count;
        job.occluded = occluded + k * job.source.row_stride * frame->height;
        result = trace_light(&job);
    }
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return cgt_visits_end(scene->context, &job.visits, "the visitor stopped the frame");
}
