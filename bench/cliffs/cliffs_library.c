/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The library's calls on a cliff, through one structure. */
#include "cliffs/bench_cliffs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

typedef struct library {
    const cliffs_settings *settings;
    cgt_context *context;
    cgt_scene *scene;
    cliffs_input *input;
    float *t; /* answers of the last step */
    uint32_t *primitive;
    uint8_t *occluded;
} library;

static uint64_t rays_of(uint32_t step) { return (uint64_t)CLIFFS_RAYS << 2 * step; }

static cgt_rays rays_from(const library *l, uint64_t first, uint64_t count)
{
    const truth_ray *ray = l->input->rays + first;
    return (cgt_rays){.count = count,
                      .stride = sizeof *ray,
                      .org = {&ray->org[0], &ray->org[1], &ray->org[2]},
                      .dir = {&ray->dir[0], &ray->dir[1], &ray->dir[2]},
                      .t_min = &ray->t_min,
                      .t_max = &ray->t_max};
}

/* Makes AUTO build its BVH, by rays that are off and cost nothing. */
static cgt_result announce_rays(const library *l)
{
    static const float place = 1, off = -1;
    const uint32_t count = l->input->scene.count / 32 + 1;
    float *t_max = malloc(count * sizeof *t_max), *any = malloc(count * sizeof *any);
    uint8_t *occluded = malloc(count);
    cgt_result result = CGT_ERROR_OUT_OF_MEMORY;
    for (uint32_t i = 0; t_max && any && i < count; i++) {
        t_max[i] = off;
        any[i] = place;
    }
    if (t_max && any && occluded) {
        const cgt_rays rays = {.count = count, .org = {any, any, any}, .dir = {any, any, any}, .t_max = t_max};
        result = cgt_occluded_rays(l->scene, &rays, occluded, NULL);
    }
    free(t_max);
    free(any);
    free(occluded);
    return result;
}

/* The points that are visible in each step's picture, up to the first picture that takes too long. */
static int make_points(library *l)
{
    cliffs_input *input = l->input;
    for (uint32_t k = 0; k < input->steps && !input->points[k].point; k++) {
        const double begin = bench_now_ms();
        if (!cliff_make_points(&input->scene, l->scene, CLIFFS_WIDTH << k, CLIFFS_HEIGHT << k, &input->points[k])) {
            program_error("cliffs: no points to be lit");
            return -1;
        }
        if (4 * (bench_now_ms() - begin) > l->settings->limit_ms)
            break;
    }
    return 0;
}

static int failed(const library *l, const char *what, cgt_result result)
{
    if (result == CGT_OK)
        return 0;
    bench_scene_failed(l->context, what, result);
    return -1;
}

/* Single rays come first after a commit; AUTO may have a BVH for what follows. */
static int prepare(void *self, cliff_call call, uint32_t step)
{
    library *l = self;
    if (call == CLIFF_LIGHT)
        return make_points(l) ? -1 : !l->input->points[step].point;
    if (call == CLIFF_SINGLE)
        return failed(l, "commit", cgt_scene_commit(l->scene));
    if (call == CLIFF_RAYS || call == CLIFF_OCCLUDED)
        return failed(l, "rays", announce_rays(l));
    return 0;
}

static cgt_result trace_camera(library *l, uint32_t step)
{
    cgt_frame frame;
    cgt_frame_init(&frame, CLIFFS_WIDTH << step, CLIFFS_HEIGHT << step);
    frame.t = l->t;
    frame.primitive = l->primitive;
    return cgt_trace_camera(l->scene, &l->input->scene.camera, &frame, NULL);
}

static cgt_result trace_light(library *l, uint32_t step)
{
    const cgt_points points = cliff_points_array(&l->input->points[step]);
    cgt_light light = {.kind = CGT_LIGHT_POINT};
    memcpy(light.position, l->input->scene.light, sizeof light.position);
    return cgt_occluded_points(l->scene, &light, &points, l->occluded, NULL);
}

static cgt_result trace_single(library *l, uint32_t step)
{
    cgt_result result = CGT_OK;
    for (uint64_t i = 0; i < rays_of(step) && result == CGT_OK; i++) {
        const cgt_rays ray = rays_from(l, i, 1);
        const cgt_hits hit = {.t = l->t + i, .primitive = l->primitive + i};
        result = cgt_trace_rays(l->scene, &ray, &hit, NULL);
    }
    return result;
}

static cgt_result trace_rays(library *l, uint32_t step)
{
    const cgt_rays rays = rays_from(l, 0, rays_of(step));
    const cgt_hits hits = {.t = l->t, .primitive = l->primitive};
    return cgt_trace_rays(l->scene, &rays, &hits, NULL);
}

static uint64_t count_hits(const void *self, cliff_call call, uint32_t step)
{
    const library *l = self;
    const uint64_t rays = call == CLIFF_LIGHT ? l->input->points[step].count : rays_of(step);
    uint64_t hits = 0;
    if (call == CLIFF_COMMIT)
        return 0;
    for (uint64_t i = 0; i < rays; i++)
        hits += call == CLIFF_LIGHT || call == CLIFF_OCCLUDED ? l->occluded[i] : l->primitive[i] != CGT_INVALID_ID;
    return hits;
}

static int run(void *self, cliff_call call, uint32_t step)
{
    library *l = self;
    switch (call) {
    case CLIFF_COMMIT: return failed(l, "commit", cgt_scene_commit(l->scene));
    case CLIFF_CAMERA: return failed(l, "camera", trace_camera(l, step));
    case CLIFF_LIGHT: return failed(l, "light", trace_light(l, step));
    case CLIFF_SINGLE: return failed(l, "single rays", trace_single(l, step));
    case CLIFF_RAYS: return failed(l, "rays", trace_rays(l, step));
    default: {
        const cgt_rays rays = rays_from(l, 0, rays_of(step));
        return failed(l, "occluded rays", cgt_occluded_rays(l->scene, &rays, l->occluded, NULL));
    }
    }
}

int cliffs_measure_library(const cliffs_settings *settings, cgt_context *context, cliffs_input *input,
                           cliff_structure structure, cliffs_result *result)
{
    const size_t most = (size_t)rays_of(input->steps - 1);
    const cgt_scene_options options = cliff_structure_options(structure);
    library l = {.settings = settings,
                 .context = context,
                 .input = input,
                 .t = calloc(most, sizeof(float)),
                 .primitive = calloc(most, sizeof(uint32_t)),
                 .occluded = calloc(most, 1)};
    const cliffs_program program = {prepare, run, count_hits, &l};
    int code = l.t && l.primitive && l.occluded ? 0 : -1;
    if (code)
        program_error("out of memory for %zu rays", most);
    if (!code)
        code = failed(&l, "scene", cgt_scene_create(context, &options, &l.scene));
    if (!code)
        code = failed(&l, "geometry", cliff_add(&input->scene, l.scene));
    if (!code)
        code = failed(&l, "commit", cgt_scene_commit(l.scene));
    if (!code)
        code = cliffs_measure(settings, input, &program, result);
    cgt_scene_release(l.scene);
    free(l.t);
    free(l.primitive);
    free(l.occluded);
    return code;
}
