/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes and flattened kd-trees for tests. */
#include "kd/kd_trees.h"

#include <math.h>
#include <stdlib.h>

#include "scene/scene.h"
#include "primitive/triangle_scenes.h"

static cloud spheres; /* of the current scene */
static triangle *triangles;

cgt_scene *mixed_scene(cgt_context *context, cloud_kind kind, uint64_t stream, uint32_t prims)
{
    test_random r = random_make(stream);
    const uint32_t half = prims / 2;
    spheres = cloud_make(&r, kind, prims - half);
    triangles = calloc(half + 1, sizeof *triangles);
    assert_non_null(triangles);
    for (uint32_t i = 0; i < half; i++) {
        const float *q = spheres.sphere[i];
        const float size = random_below(&r, 8) ? 2 * q[3] : spheres.reach / 4;
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                triangles[i][k][a] = random_below(&r, 4) ? q[a] + random_float(&r, -size, size) : q[a];
        if (i % 16 == 5) /* without an area */
            for (int a = 0; a < 3; a++)
                triangles[i][2][a] = triangles[i][1][a];
    }
    for (uint32_t i = 3; i < spheres.count; i += 16)
        spheres.sphere[i][3] = i % 3 ? -1 : 0; /* negative radii are skipped, points are not */
    cgt_scene *scene = scene_begin(context);
    scene_add_spheres(scene, (const float(*)[4])spheres.sphere, spheres.count);
    if (half)
        scene_add_triangles(scene, (const triangle *)triangles, half);
    scene_commit(context, scene);
    assert_true(committed_of(scene)->valid > 0);
    return scene;
}

const cgt_committed_scene *committed_of(const cgt_scene *scene) { return &scene->committed_scene; }

void mixed_scene_free(cgt_scene *scene)
{
    cgt_scene_release(scene);
    cloud_free(&spheres);
    free(triangles);
    triangles = NULL;
}

cgt_result flatten(flat_tree *flat, cgt_context *context, const cgt_kd_raw *raw, cgt_kd_layout layout,
                   uint32_t break_level, bool ropes)
{
    const cgt_kd_memory memory = {&flat->nodes, &flat->references, &flat->leaves};
    flat->context = context;
    return cgt_kd_flatten(context, &memory, raw, layout, break_level, ropes, &flat->tree);
}

void flat_tree_free(flat_tree *flat)
{
    cgt_buffer_release(&flat->context->memory, &flat->nodes);
    cgt_buffer_release(&flat->context->memory, &flat->references);
    cgt_buffer_release(&flat->context->memory, &flat->leaves);
}

const char *layout_name(cgt_kd_layout layout)
{
    static const char *const name[] = {"auto", "depth first", "breadth first", "mixed"};
    return name[layout];
}
