/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The waves of a frame: programs/whitted makes them, its `watch` records them, in its order. One thread: `watch` is
 * called in that order only then. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bounces/bench_bounces.h"
#include "whitted/whitted_internal.h"

const char *const bounces_material_names[BOUNCES_MATERIALS] = {"mirror", "glass"};

static const whitted_material materials[BOUNCES_MATERIALS] = {
    [BOUNCES_MIRROR] = {.kind = WHITTED_MIRROR, .color = {1, 1, 1}},
    [BOUNCES_GLASS] = {.kind = WHITTED_GLASS, .index = 1.5f},
};

/* A renderer's offset is some of the units in the last place of the origin, so that few rays meet what they leave. */
static const float offset_of_reach = 4.0f;

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

static cgt_result trace_frame(bounces_waves *waves, const bench_scene *scene, const cgt_spheres *spheres,
                              const cgt_triangles *triangles, int material, const bench_settings *settings)
{
    const whitted_geometry geometry = {
        .spheres = spheres, .triangles = triangles, .material_of_all = (uint8_t)material};
    const whitted w = {.scene = scene->scene,
                       .geometry = &geometry,
                       .geometries = 1,
                       .material = materials,
                       .materials = BOUNCES_MATERIALS,
                       .up = {0, 1, 0},
                       .bounces = BOUNCES,
                       .faintest = 1.0f / 512,
                       .watch = record,
                       .watch_user = waves};
    float(*light)[3] = malloc((size_t)settings->width * settings->height * sizeof *light);
    const cgt_result result = light
                                  ? whitted_frame(&w, &settings->camera, settings->width, settings->height, NULL, light)
                                  : CGT_ERROR_OUT_OF_MEMORY;
    free(light);
    return waves->failed ? CGT_ERROR_OUT_OF_MEMORY : result;
}

cgt_result bounces_waves_make(bounces_waves *waves, const bench_input *input, uint32_t count, int material,
                              const bench_settings *settings)
{
    static const uint32_t own[3] = {0, 0, 0};
    static const bench_kd_choice kd = {0};
    const cgt_spheres spheres = {.count = count,
                                 .centers = input->moving,
                                 .center_stride = 4 * sizeof(float),
                                 .radii = input->moving + 3,
                                 .radius_stride = 4 * sizeof(float)};
    const cgt_triangles triangles = {
        .count = input->triangles, .indices = input->index, .vertex_count = count, .vertices = input->moving};
    cgt_context *context = NULL;
    bench_scene scene = {0};
    memset(waves, 0, sizeof *waves);
    cgt_result result = bench_context_create(1, settings->variant, &context);
    if (result == CGT_OK)
        result = bench_scene_create(&scene, context, input->moving, own);
    if (result == CGT_OK) {
        if (input->index)
            bench_scene_set_triangles(&scene, input->index, input->triangles);
        result = bench_scene_structure(&scene, CGT_STRUCTURE_AUTO, CGT_RAY_KIND_COHERENT, &kd, own);
    }
    if (result == CGT_OK)
        result = bench_scene_commit(&scene, count);
    if (result == CGT_OK)
        result = trace_frame(waves, &scene, input->index ? NULL : &spheres, input->index ? &triangles : NULL, material,
                             settings);
    bench_scene_release(&scene);
    cgt_context_release(context);
    return result;
}

void bounces_waves_release(bounces_waves *waves)
{
    for (int bounce = 0; bounce <= BOUNCES; bounce++)
        free(waves->bounce[bounce].ray);
    memset(waves, 0, sizeof *waves);
}
