/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Undisturbed scenes, and what is done to one primitive. */
#include "support/cliffs/cliffs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE_OF_SPACING 0.35f /* so that few rays pass through a cloud */
#define SQUARES_PER_ROW 2u    /* as often as rows: a ball's equator is twice as long as the way between its poles */
#define PI 3.14159265358979323846

uint32_t cliff_floats(const cliff_scene *scene)
{
    return scene->base == CLIFF_CLOUD ? 4 : scene->base == CLIFF_STICKS ? 8 : 9;
}

void cliff_middle(const cliff_scene *scene, uint32_t i, float middle[3])
{
    const float *p = scene->data + (size_t)i * cliff_floats(scene);
    for (int a = 0; a < 3; a++)
        switch (scene->base) {
        case CLIFF_CLOUD: middle[a] = p[a]; break;
        case CLIFF_STICKS: middle[a] = (float)(((double)p[a] + (double)p[4 + a]) / 2); break;
        default: middle[a] = (float)(((double)p[a] + (double)p[3 + a] + (double)p[6 + a]) / 3); break;
        }
}

void cliff_place(cliff_scene *scene, uint32_t i, const float middle[3], float factor)
{
    float *p = scene->data + (size_t)i * cliff_floats(scene);
    float from[3];
    cliff_middle(scene, i, from);
    if (scene->base == CLIFF_CLOUD) {
        memcpy(p, middle, sizeof from);
        p[3] *= factor;
        return;
    }
    for (uint32_t k = 0; k < cliff_floats(scene); k++) {
        const uint32_t a = scene->base == CLIFF_STICKS ? k % 4 : k % 3;
        p[k] = a == 3 ? p[k] * factor : (float)((double)middle[a] + ((double)p[k] - (double)from[a]) * (double)factor);
    }
}

void cliff_look(cliff_scene *scene, const float middle[3], float reach)
{
    static const float eye[3] = {0.3f, 0.4f, -2.4f}, light[3] = {0.8f, 1.9f, -0.9f};
    cgt_camera_init(&scene->camera);
    scene->camera.fov = 60;
    for (int a = 0; a < 3; a++) {
        scene->camera.eye[a] = middle[a] + reach * eye[a];
        scene->camera.target[a] = middle[a];
        scene->light[a] = middle[a] + reach * light[a];
        scene->middle[a] = middle[a];
    }
    scene->reach = reach;
}

static void make_cloud(cliff_scene *scene, test_random *r)
{
    scene->size = SIZE_OF_SPACING * 2 / cbrtf((float)scene->count);
    for (uint32_t i = 0; i < scene->count; i++) {
        float *p = scene->data + (size_t)4 * i;
        for (int a = 0; a < 3; a++)
            p[a] = random_float(r, -1, 1);
        p[3] = random_float(r, 0.8f, 1.2f) * scene->size;
    }
}

static void make_soup(cliff_scene *scene, test_random *r)
{
    scene->size = SIZE_OF_SPACING * 3 / cbrtf((float)scene->count);
    for (uint32_t i = 0; i < scene->count; i++) {
        float middle[3], *p = scene->data + (size_t)9 * i;
        for (int a = 0; a < 3; a++)
            middle[a] = random_float(r, -1, 1);
        for (int k = 0; k < 9; k++)
            p[k] = middle[k % 3] + random_float(r, -1, 1) * scene->size;
    }
}

static void make_sticks(cliff_scene *scene, test_random *r)
{
    scene->size = SIZE_OF_SPACING * 3 / cbrtf((float)scene->count);
    for (uint32_t i = 0; i < scene->count; i++) {
        float d[3], *p = scene->data + (size_t)8 * i;
        random_direction(r, d);
        for (int a = 0; a < 3; a++) {
            const float middle = random_float(r, -1, 1);
            p[a] = middle - d[a] * scene->size;
            p[4 + a] = middle + d[a] * scene->size;
        }
        p[3] = p[7] = random_float(r, 0.8f, 1.2f) * 0.3f * scene->size;
    }
}

/* u, v in 0..1 to a point of the bumpy ball */
static void ball_point(double u, double v, float p[3])
{
    const double longitude = 2 * PI * u, latitude = PI * v;
    const double radius = 0.85 + 0.1 * sin(7 * longitude) * sin(5 * latitude);
    p[0] = (float)(radius * sin(latitude) * cos(longitude));
    p[1] = (float)(radius * cos(latitude));
    p[2] = (float)(radius * sin(latitude) * sin(longitude));
}

static void make_mesh(cliff_scene *scene)
{
    const uint32_t rows = (uint32_t)ceil(sqrt((double)scene->count / (2 * SQUARES_PER_ROW)));
    const uint32_t columns = (scene->count / 2 + rows) / rows;
    scene->size = (float)(PI / 2 / rows);
    for (uint32_t i = 0; i < scene->count; i++) {
        const uint32_t square = i / 2, row = square / columns, column = square % columns;
        float *p = scene->data + (size_t)9 * i;
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = i % 2 + k; /* of a square: 0, 1, 2 and 1, 2, 3 */
            ball_point((double)(column + corner % 2) / columns, (double)(row + corner / 2) / rows, p + (size_t)3 * k);
        }
    }
}

/* Not by the tests' seed: bounds of work are of these scenes. */
test_random cliff_random(uint32_t stream) { return (test_random){.state = UINT64_C(0x51afd7ed558ccd) * (stream + 1)}; }

bool cliff_make(cliff_scene *scene, const cliff *c, bool disturbed, uint32_t count)
{
    static const float origin[3] = {0, 0, 0};
    test_random base = cliff_random(c->base == CLIFF_STICKS ? CLIFF_STREAM_STICKS : (uint32_t)c->base),
                trouble = cliff_random(CLIFF_STREAM_TROUBLE);
    memset(scene, 0, sizeof *scene);
    scene->base = c->base;
    scene->count = count;
    scene->data =
        calloc((size_t)count * cliff_floats(scene) + 1, sizeof(float)); /* a float may be read past a sphere */
    if (!scene->data)
        return false;
    switch (c->base) {
    case CLIFF_CLOUD: make_cloud(scene, &base); break;
    case CLIFF_SOUP: make_soup(scene, &base); break;
    case CLIFF_STICKS: make_sticks(scene, &base); break;
    default: make_mesh(scene); break;
    }
    cliff_look(scene, origin, 1);
    if (disturbed && c->disturb)
        c->disturb(scene, &trouble, c->amount);
    return true;
}

void cliff_free(cliff_scene *scene)
{
    free(scene->data);
    memset(scene, 0, sizeof *scene);
}

cgt_result cliff_add(const cliff_scene *scene, cgt_scene *to)
{
    if (scene->base == CLIFF_CLOUD)
        return cgt_scene_set_spheres(to, NULL,
                                     &(cgt_spheres){.count = scene->count,
                                                    .centers = cgt_floats(scene->data, 16),
                                                    .radii = cgt_floats(scene->data + 3, 16)});
    if (scene->base == CLIFF_STICKS)
        return cgt_scene_set_capsules(to, NULL,
                                      &(cgt_capsules){.count = scene->count,
                                                      .vertex_count = 2 * scene->count,
                                                      .vertices = cgt_floats(scene->data, 16),
                                                      .radii = cgt_floats(scene->data + 3, 32)});
    return cgt_scene_set_triangles(to, NULL,
                                   &(cgt_triangles){.count = scene->count,
                                                    .vertex_count = 3 * scene->count,
                                                    .vertices = cgt_floats(scene->data, 0)});
}
