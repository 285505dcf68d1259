/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench bounces: the waves of a frame whose primitives are all mirrors, or glass. picture/whitted makes them, its
 * `watch` records them, in its order. One thread: `watch` is called in that order only then. Rays ignore the primitive
 * that they leave; Embree's begin an offset farther on, as renderers do it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sets/bench_sets.h"
#include "sets/bounces.h"
#include "whitted/whitted_internal.h"

enum { MIRROR, GLASS, MATERIALS };
const char *const bench_materials[] = {"mirror", "glass", NULL};
static const char *const kinds[MATERIALS][BOUNCES] = {{"mirror-1", "mirror-2", "mirror-3", "mirror-4"},
                                                      {"glass-1", "glass-2", "glass-3", "glass-4"}};

static const cgt_material materials[MATERIALS] = {
    [MIRROR] = {.kind = CGT_MATERIAL_MIRROR, .color = {1, 1, 1}},
    [GLASS] = {.kind = CGT_MATERIAL_GLASS, .index = 1.5f},
};

/* A renderer's offset is some of the units in the last place of the origin, so that few rays meet what they leave. */
static const float offset_of_reach = 4.0f;

typedef struct bounces_waves {
    bounces_wave bounce[BOUNCES + 1]; /* 0 stays empty */
    int failed;                       /* memory was refused */
} bounces_waves;

static void record(void *user, uint32_t bounce, const whitted_ray *ray, const whitted_hit *hit)
{
    bounces_waves *waves = user;
    (void)hit;
    if (bounce == 0 || bounce > BOUNCES)
        return;
    bounces_wave *wave = &waves->bounce[bounce];
    if (!wave->ray)
        wave->ray = malloc(BOUNCES_MOST_RAYS * sizeof *wave->ray);
    if (!wave->ray) {
        waves->failed = 1;
        return;
    }
    if (wave->count == BOUNCES_MOST_RAYS) {
        wave->left_out++;
        return;
    }
    bounces_ray *to = &wave->ray[wave->count++];
    memcpy(to->org, ray->org, sizeof to->org);
    memcpy(to->dir, ray->dir, sizeof to->dir);
    to->t_min = -ray->reach; /* ghosts have moved the ray's own */
    to->t_max = ray->t_max;
    to->offset = offset_of_reach * ray->reach;
    to->skip = ray->skip_primitive;
}

static cgt_result trace_frame(bounces_waves *waves, const sets_job *job, cgt_scene *scene, const cgt_spheres *spheres,
                              const cgt_triangles *triangles, int material)
{
    const bench_settings *s = job->settings;
    const whitted_geometry geometry = {
        .spheres = spheres, .triangles = triangles, .material_of_all = (uint8_t)material};
    const whitted w = {.scene = scene,
                       .geometry = &geometry,
                       .geometries = 1,
                       .material = materials,
                       .materials = MATERIALS,
                       .up = {0, 1, 0},
                       .bounces = BOUNCES,
                       .faintest = 1.0f / 512,
                       .watch = record,
                       .watch_user = waves};
    float(*light)[3] = malloc((size_t)s->width * s->height * sizeof *light);
    const cgt_result result =
        light ? cgt_whitted_frame(&w, &s->camera, s->width, s->height, NULL, light) : CGT_ERROR_OUT_OF_MEMORY;
    free(light);
    return waves->failed ? CGT_ERROR_OUT_OF_MEMORY : result;
}

/* Traces a frame of primitives of one material, and keeps the rays of each bounce. */
static int make_waves(bounces_waves *waves, const sets_job *job, int material)
{
    const bench_input *input = &job->session.input;
    const cgt_spheres spheres = {.count = job->session.count,
                                 .centers = cgt_floats(input->moving, 4 * sizeof(float)),
                                 .radii = cgt_floats(input->moving + 3, 4 * sizeof(float))};
    const cgt_triangles triangles = {.count = input->triangles,
                                     .indices = cgt_uint32s(input->index, 0),
                                     .vertex_count = job->session.count,
                                     .vertices = cgt_floats(input->moving, 0)};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    memset(waves, 0, sizeof *waves);
    if (bench_context_create(1, job->settings->choice.variant, &context))
        return PROGRAM_FAILED;
    cgt_result result = cgt_scene_create(context, NULL, &scene);
    if (result == CGT_OK)
        result = input->index ? cgt_scene_set_triangles(scene, NULL, &triangles)
                              : cgt_scene_set_spheres(scene, NULL, &spheres);
    if (result == CGT_OK)
        result = cgt_scene_commit(scene);
    if (result == CGT_OK)
        result =
            trace_frame(waves, job, scene, input->index ? NULL : &spheres, input->index ? &triangles : NULL, material);
    const int code = result == CGT_OK ? PROGRAM_OK : bench_failed(context, job->session.path, result);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return code;
}

static int run_order(sets_job *job, const bounces_wave *wave, const char *kind, bounces_order order)
{
    const int is_cut = order == BOUNCES_WAVES || order == BOUNCES_OCTANT || order == BOUNCES_WAVE_MORTON;
    const uint64_t batch = is_cut ? BOUNCES_CALL : UINT64_MAX;
    bounces_rays rays;
    if (bounces_rays_make(wave, order, &rays))
        return sets_out_of_memory();
    const cgt_rays embree = {.count = rays.count,
                             .org = {rays.org[0], rays.org[1], rays.org[2]},
                             .dir = {rays.dir[0], rays.dir[1], rays.dir[2]},
                             .t_min = rays.offset,
                             .t_max = rays.t_max};
    const bench_set set = {.kind = kind,
                           .order = bench_wave_orders[order],
                           .query = BENCH_NEAREST,
                           .rays = {.count = rays.count,
                                    .org = {rays.org[0], rays.org[1], rays.org[2]},
                                    .dir = {rays.dir[0], rays.dir[1], rays.dir[2]},
                                    .t_min = rays.t_min,
                                    .t_max = rays.t_max,
                                    .skip_primitive = rays.skip},
                           .embree = &embree,
                           .order_ms = rays.ms};
    const int code = sets_measure(job, &set, &batch, 1, 0);
    bounces_rays_release(&rays);
    return code;
}

static int run_wave(sets_job *job, const bounces_wave *wave, const char *kind)
{
    int code = PROGRAM_OK;
    if (wave->left_out)
        program_error("%s: %s: %llu rays beyond %d are left out", job->session.scene, kind,
                      (unsigned long long)wave->left_out, BOUNCES_MOST_RAYS);
    for (int order = 0; order < BOUNCES_ORDERS && code == PROGRAM_OK; order++)
        if (bench_is_chosen(job->settings->order, BOUNCES_ORDERS, order))
            code = run_order(job, wave, kind, (bounces_order)order);
    return code;
}

static int run_file(sets_job *job)
{
    int code = PROGRAM_OK;
    for (int material = 0; material < MATERIALS && code == PROGRAM_OK; material++) {
        bounces_waves waves;
        if (!bench_is_chosen(job->settings->kind, MATERIALS, material))
            continue;
        code = make_waves(&waves, job, material);
        for (int bounce = 1; bounce <= BOUNCES && code == PROGRAM_OK; bounce++)
            code = run_wave(job, &waves.bounce[bounce], kinds[material][bounce - 1]);
        for (int bounce = 0; bounce <= BOUNCES; bounce++)
            free(waves.bounce[bounce].ray);
    }
    return code;
}

int bench_bounces(const bench_settings *settings) { return sets_run(settings, run_file); }
