/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hills of cgt-bench cell --kd. */
#include "cell/kd_scenes.h"

#include <math.h>

#include "common/bench_timing.h"
#include "common/program.h"

const char *const kd_bench_rays_names[KD_BENCH_RAYS] = {"camera", "shadow", "ambient", "bounced"};

static float corner[KD_TRIANGLES][3][3];

static void place(uint32_t x, uint32_t y, float to[3])
{
    const float u = (float)x / KD_EDGE - 1, v = (float)y / KD_EDGE - 0.5f;
    to[0] = 6 * u;
    to[1] = 6 * v;
    to[2] = 0.25f * sinf(7 * u) * cosf(9 * v) + 0.1f * sinf(23 * u + 1) * sinf(19 * v) + 0.03f * sinf(61 * u + 47 * v);
}

static void make_hills(void)
{
    static const uint32_t at[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    for (uint32_t k = 0; k < KD_TRIANGLES; k++)
        for (int c = 0; c < 3; c++)
            place(k / 2 % (2 * KD_EDGE) + at[k % 2][c][0], k / 2 / (2 * KD_EDGE) + at[k % 2][c][1], corner[k][c]);
}

static cgt_result add_part(kd_bench_scene *s, const cgt_scene_options *options, uint32_t parts)
{
    const uint32_t k = s->parts, first = KD_TRIANGLES * k / parts, count = KD_TRIANGLES * (k + 1) / parts - first;
    const cgt_triangles t = {
        .count = count, .vertex_count = 3 * count, .vertices = cgt_floats(&corner[first][0][0], 0)};
    cgt_result result = cgt_scene_create(s->context, options, &s->scene[k]);
    if (result != CGT_OK)
        return result;
    s->parts++;
    result = cgt_scene_set_triangles(s->scene[k], NULL, &t);
    return result == CGT_OK ? cgt_scene_commit(s->scene[k]) : result;
}

bool kd_bench_scene_make(kd_bench_scene *s, cgt_structure structure, cgt_kd_layout layout, uint32_t parts)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    const cgt_research_scene_options research = {.kd_layout = layout};
    const cgt_scene_options options = {.structure = structure, .research = &research};
    char message[CGT_PPE_MESSAGE_BYTES] = "the hills cannot be built";
    *s = (kd_bench_scene){.parts = 0};
    make_hills();
    cgt_result result = cgt_context_create(NULL, &s->context);
    while (result == CGT_OK && s->parts < parts)
        result = add_part(s, &options, parts);
    if (result == CGT_OK)
        result = cgt_kd_scene_init(&s->image, &memory, (const cgt_scene *const *)s->scene, parts, message);
    if (result == CGT_OK)
        return true;
    program_error("%s", message);
    kd_bench_scene_release(s);
    return false;
}

void kd_bench_scene_release(kd_bench_scene *s)
{
    cgt_kd_scene_release(&s->image);
    for (uint32_t k = 0; k < s->parts; k++)
        cgt_scene_release(s->scene[k]);
    if (s->context)
        cgt_context_release(s->context);
    *s = (kd_bench_scene){.parts = 0};
}

/* ---- how long a build takes ---- */

#define BUILDS 15

static cgt_result time_builds(cgt_scene *scene, double commit[BUILDS], double image[BUILDS])
{
    const cgt_memory_hooks memory = cgt_memory_default();
    const cgt_scene *const scenes = scene;
    char message[CGT_PPE_MESSAGE_BYTES];
    static cgt_kd_scene made;
    for (int k = 0; k < BUILDS; k++) {
        const double start = bench_cpu_ms();
        cgt_result result = cgt_scene_commit(scene);
        const double middle = bench_cpu_ms();
        if (result == CGT_OK)
            result = cgt_kd_scene_init(&made, &memory, &scenes, 1, message);
        if (result != CGT_OK)
            return result;
        commit[k] = middle - start;
        image[k] = bench_cpu_ms() - middle;
        cgt_kd_scene_release(&made);
    }
    return CGT_OK;
}

bool kd_bench_build(cgt_structure structure, double *commit, double *image)
{
    double commits[BUILDS], images[BUILDS];
    const cgt_scene_options options = {.structure = structure};
    kd_bench_scene s = {.parts = 0};
    make_hills();
    cgt_result result = cgt_context_create(&(cgt_context_options){.threads = 1}, &s.context);
    if (result == CGT_OK)
        result = add_part(&s, &options, 1);
    if (result == CGT_OK)
        result = time_builds(s.scene[0], commits, images);
    if (result == CGT_OK) {
        *commit = bench_median(commits, BUILDS);
        *image = bench_median(images, BUILDS);
    } else {
        program_error("the hills cannot be built");
    }
    kd_bench_scene_release(&s);
    return result == CGT_OK;
}

cgt_camera kd_bench_camera(void)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    const float eye[3] = {0, -2.2f, 2.4f}, target[3] = {0, -0.2f, 0}, up[3] = {0, 0, 1};
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = eye[a];
        camera.target[a] = target[a];
        camera.up[a] = up[a];
    }
    camera.fov = 45;
    return camera;
}

void kd_bench_add_rays(cgt_kd_frame_options *o, kd_bench_rays rays)
{
    o->lights = rays == KD_BENCH_SHADOW;
    o->light[0][0] = -5;
    o->light[0][1] = 3;
    o->light[0][2] = 1.5f;
    o->light_t_min = 0x1p-10f;
    o->ambient = rays == KD_BENCH_AMBIENT ? 4 : 0;
    o->ambient_t_min = 0x1p-10f;
    o->ambient_t_max = 2;
    o->mirror = rays == KD_BENCH_BOUNCED;
    o->mirror_t_min = 0x1p-10f;
    o->mirror_t_max = 0x1p10f;
}
