/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hills of cgt-bench cell --kd. */
#include "cell/kd_scenes.h"

#include <math.h>

#include "common/program.h"

const char *const kd_bench_rays_names[KD_BENCH_RAYS] = {"camera", "shadow", "ambient"};

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
    const cgt_triangles t = {.count = count, .vertex_count = 3 * count, .vertices = &corner[first][0][0]};
    cgt_result result = cgt_scene_create(s->context, options, &s->scene[k]);
    if (result != CGT_OK)
        return result;
    s->parts++;
    result = cgt_scene_add_triangles(s->scene[k], &t, NULL);
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
}
