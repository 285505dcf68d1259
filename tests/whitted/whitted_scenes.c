/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes of spheres and boxes; see whitted_scenes.h. */
#include "whitted/whitted_scenes.h"

#include <string.h>

void whitted_scene_begin(whitted_scene *s, const cgt_material *material, uint32_t materials)
{
    memset(s, 0, sizeof *s);
    s->w.material = material;
    s->w.materials = materials;
    s->w.bounces = 8;
    s->w.up[1] = 1.0f;
}

void whitted_scene_add_sphere(whitted_scene *s, float x, float y, float z, float radius, uint8_t material)
{
    assert_true(s->spheres < WHITTED_MOST);
    const float sphere[4] = {x, y, z, radius};
    memcpy(s->sphere[s->spheres], sphere, sizeof sphere);
    s->sphere_material[s->spheres++] = material;
}

void whitted_scene_add_box(whitted_scene *s, const float corner[8][3], bool inward, uint8_t material)
{
    /* outward, counterclockwise */
    static const uint8_t face[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    assert_true(s->boxes < WHITTED_MOST);
    memcpy(s->corner[8 * s->boxes], corner, 8 * sizeof corner[0]);
    for (uint32_t i = 0; i < 12; i++) {
        const uint32_t t = 12 * s->boxes + i;
        for (uint32_t k = 0; k < 3; k++)
            s->index[t][k] = 8 * s->boxes + face[i][inward ? 2 - k : k];
        s->body[t] = s->boxes;
        s->box_material[t] = material;
    }
    s->boxes++;
}

void whitted_scene_add_cube(whitted_scene *s, const float low[3], const float high[3], bool inward, uint8_t material)
{
    float corner[8][3];
    for (uint32_t k = 0; k < 8; k++)
        for (uint32_t a = 0; a < 3; a++)
            corner[k][a] = k >> a & 1 ? high[a] : low[a];
    whitted_scene_add_box(s, corner, inward, material);
}

void whitted_scene_commit(whitted_scene *s, const char *variant, uint32_t threads)
{
    const cgt_context_options options = {.threads = threads ? threads : 1, .variant = variant};
    assert_int_equal(cgt_context_create(&options, &s->context), CGT_OK);
    assert_int_equal(cgt_scene_create(s->context, NULL, &s->scene), CGT_OK);
    s->as_spheres = (cgt_spheres){.count = s->spheres,
                                  .centers = cgt_floats(s->sphere[0], sizeof s->sphere[0]),
                                  .radii = cgt_floats(&s->sphere[0][3], sizeof s->sphere[0])};
    s->as_triangles = (cgt_triangles){.count = 12 * s->boxes,
                                      .indices = cgt_uint32s(s->index[0], 0),
                                      .vertex_count = 8 * s->boxes,
                                      .vertices = cgt_floats(s->corner[0], 0)};
    uint32_t spheres_id = CGT_INVALID_ID;
    assert_int_equal(cgt_scene_set_spheres(s->scene, &spheres_id, &s->as_spheres), CGT_OK);
    assert_int_equal(spheres_id, WHITTED_SPHERES);
    uint32_t triangles_id = CGT_INVALID_ID;
    assert_int_equal(cgt_scene_set_triangles(s->scene, &triangles_id, &s->as_triangles), CGT_OK);
    assert_int_equal(triangles_id, WHITTED_BOXES);
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
    s->geometry[WHITTED_SPHERES] = (whitted_geometry){.spheres = &s->as_spheres, .material = s->sphere_material};
    s->geometry[WHITTED_BOXES] =
        (whitted_geometry){.triangles = &s->as_triangles, .material = s->box_material, .body = s->body};
    s->w.scene = s->scene;
    s->w.geometry = s->geometry;
    s->w.geometries = 2;
    const char *wrong = cgt_whitted_check(&s->w);
    if (wrong)
        fail_msg("%s", wrong);
}

void whitted_scene_end(whitted_scene *s)
{
    cgt_scene_release(s->scene);
    cgt_context_release(s->context);
}

void whitted_scene_trace(const whitted_scene *s, uint32_t count, const float (*org)[3], const float (*dir)[3],
                         float (*light)[3])
{
    whitted_memory *memory = cgt_whitted_memory_create(s->w.bounces);
    assert_non_null(memory);
    for (uint32_t first = 0; first < count; first += WHITTED_WAVE) {
        const uint32_t n = count - first < WHITTED_WAVE ? count - first : WHITTED_WAVE;
        assert_int_equal(cgt_whitted_trace(&s->w, memory, n, org + first, dir + first, light + first), CGT_OK);
    }
    cgt_whitted_memory_free(memory);
}
