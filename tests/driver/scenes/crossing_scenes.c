/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Closed meshes on lattices of whole numbers, with rays aimed exactly at their edges and vertices
 * (all_hits/crossing_cases.h), and spheres on that lattice; a second mesh, with rays of its own, may be a geometry of
 * its own. */
#include <math.h>
#include <string.h>

#include "all_hits/crossing_cases.h"
#include "driver/rays/lines.h"
#include "driver/scenes/scene_heap.h"
#include "support/test.h"

#define RAYS 1024u

static truth_ray own[RAYS]; /* of the last scene */

static const char *family_name(uint32_t family)
{
    static const char *const name[CROSSING_SHAPES] = {"a fine mesh", "a thin mesh", "a coarse mesh", "a tangled mesh"};
    return name[family];
}

static int add_mesh(scene_heap *h, crossing_shape shape, int exponent, truth_ray *ray, uint32_t rays)
{
    crossing_mesh mesh;
    assert_true(crossing_mesh_make(&mesh, (closed_kind)random_below(h->r, CLOSED_KINDS), shape, h->r));
    for (uint32_t i = 0; i < mesh.triangles; i++) {
        float *const v = scene_heap_add(h, ORACLE_TRIANGLE);
        for (int k = 0; k < 9; k++)
            v[k] = ldexpf((float)mesh.corner[i][k / 3][k % 3], exponent);
    }
    for (uint32_t i = 0; i < rays; i++) {
        const crossing_ray aimed = crossing_ray_make(&mesh, h->r);
        ray[i] = (truth_ray){.t_min = random_below(h->r, 4) ? 0 : -INFINITY, .t_max = INFINITY};
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = ldexpf((float)aimed.org[a], exponent);
            ray[i].dir[a] = (float)aimed.dir[a];
        }
    }
    const int reach = mesh.reach;
    crossing_mesh_free(&mesh);
    return reach;
}

/* A few of them around a far one, so that some scenes are cut into bands. */
static void add_balls(scene_heap *h, int reach, int exponent)
{
    for (uint32_t i = random_below(h->r, 40); i > 0; i--) {
        float *const s = scene_heap_add(h, ORACLE_SPHERE);
        for (int a = 0; a < 3; a++)
            s[a] = ldexpf((float)random_below(h->r, (uint32_t)(2 * reach + 1)) - (float)reach, exponent);
        s[3] = ldexpf((float)random_below(h->r, 4), exponent);
    }
    if (random_below(h->r, 5) == 0)
        memcpy(scene_heap_add(h, ORACLE_SPHERE), (float[]){0x1p90f, 0, 0, 1}, 4 * sizeof(float));
}

static void make(scene_heap *h, uint32_t family)
{
    static const int exponents[] = {0, 0, 0, 100, -100, -140, -149};
    const crossing_shape shape = (crossing_shape)family;
    const int exponent = exponents[random_below(h->r, TEST_COUNT(exponents))];
    int reach = add_mesh(h, shape, exponent, own, RAYS);
    h->seam = h->count[ORACLE_TRIANGLE];
    if (random_below(h->r, 2))
        reach = add_mesh(h, shape, exponent, own + RAYS / 2, RAYS / 2);
    if (random_below(h->r, 2))
        add_balls(h, reach, exponent);
    h->scene->closed = true;
    h->scene->step = ldexpf(1, exponent);
    h->scene->scale = ldexpf((float)reach, exponent);
}

const scene_group crossing_scenes = {CROSSING_SHAPES, family_name, make};

void crossing_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    const uint32_t from = random_below(&s->random, RAYS);
    for (uint32_t i = 0; i < count; i++)
        ray[i].line = own[(from + i * (RAYS / 2 + 1)) % RAYS];
}
