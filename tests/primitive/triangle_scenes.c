/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles, scenes of triangles, and rays towards them. */
#include "primitive/triangle_scenes.h"

#include <math.h>
#include <string.h>

cgt_triangles triangles_of(const triangle *t, uint32_t count)
{
    return (cgt_triangles){
        .count = count, .vertex_count = 3 * count, .vertices = cgt_floats(count ? t[0][0] : NULL, 0)};
}

cgt_scene *scene_begin(cgt_context *context)
{
    static uint32_t turn;
    const cgt_scene_options made = structure_in_turn(turn++);
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, &made, &scene), CGT_OK);
    return scene;
}

uint32_t scene_add_triangles(cgt_scene *scene, const triangle *t, uint32_t count)
{
    const cgt_triangles triangles = triangles_of(t, count);
    uint32_t id = CGT_INVALID_ID;
    assert_int_equal(cgt_scene_set_triangles(scene, &id, &triangles), CGT_OK);
    return id;
}

uint32_t scene_add_spheres(cgt_scene *scene, const float (*sphere)[4], uint32_t count)
{
    const cgt_spheres spheres = spheres_of(sphere, count);
    uint32_t id = CGT_INVALID_ID;
    assert_int_equal(cgt_scene_set_spheres(scene, &id, &spheres), CGT_OK);
    return id;
}

void scene_commit(cgt_context *context, cgt_scene *scene)
{
    if (cgt_scene_commit(scene) != CGT_OK)
        fail_msg("%s", context_message(context));
}

cgt_scene *scene_of_triangles(cgt_context *context, const cgt_scene_options *options, const triangle *t, uint32_t count)
{
    cgt_scene *scene = scene_begin(context);
    if (options)
        assert_int_equal(cgt_scene_set_options(scene, options), CGT_OK);
    assert_int_equal(scene_add_triangles(scene, t, count), 0);
    scene_commit(context, scene);
    return scene;
}

void random_triangles(test_random *r, float size, triangle *t, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        float middle[3];
        for (int a = 0; a < 3; a++)
            middle[a] = random_float(r, -1, 1);
        for (int k = 0; k < 9; k++)
            t[i][k / 3][k % 3] = middle[k % 3] + random_float(r, -size, size);
    }
}

void random_rays(test_random *r, truth_ray *ray, uint32_t count)
{
    float length = 1;
    for (uint32_t i = 0; i < count; i++) {
        const bool fan = i / 64 % 2 && i % 64;
        if (!fan)
            length = random_below(r, 2) ? 1 : random_log(r, 1e-6f, 1e6f);
        ray[i] = (truth_ray){.t_min = 0, .t_max = INFINITY};
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = fan ? ray[i - 1].org[a] : random_float(r, -4, 4);
            ray[i].dir[a] = (random_float(r, -1, 1) - ray[i].org[a]) * length;
        }
    }
}

void trace_all(const cgt_scene *scene, const truth_ray *ray, uint32_t count, full_hit *hit,
               const cgt_trace_options *options)
{
    memset(hit, 0x77, count * sizeof *hit);
    assert_int_equal(trace_array(scene, ray, count, hit, options), CGT_OK);
}

cgt_trace_options with_precision(cgt_precision precision)
{
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    options.precision = precision;
    return options;
}

uint32_t hits_in(const full_hit *of, uint32_t count)
{
    uint32_t hits = 0;
    for (uint32_t i = 0; i < count; i++)
        hits += of[i].geometry != CGT_INVALID_ID;
    return hits;
}
