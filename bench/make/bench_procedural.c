/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Clouds of spheres, balls and a bowl of triangles; see bench_procedural.h. At the poles of a ball lie triangles
 * without an area. */
#include "make/bench_procedural.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"

enum { CLUSTERS = 64, BOWL_MERIDIANS = 40, BOWL_PARALLELS = 25 };

/* Allocates `count` elements and, for meshes, `triangles` triangles. */
static int reserve(bench_procedural *scene, uint64_t count, uint64_t triangles, uint32_t width)
{
    memset(scene, 0, sizeof *scene);
    scene->width = width;
    if (count == 0 || count > UINT32_MAX / 4 || triangles > UINT32_MAX / 3)
        return -1;
    scene->rest = calloc((size_t)count, width * sizeof(float));
    scene->now = calloc((size_t)count, width * sizeof(float));
    scene->phase = calloc((size_t)count, sizeof(float));
    if (triangles)
        scene->index = calloc((size_t)triangles, 3 * sizeof *scene->index);
    if (scene->rest && scene->now && scene->phase && (scene->index || !triangles))
        return 0;
    bench_procedural_release(scene);
    return -1;
}

void bench_procedural_release(bench_procedural *scene)
{
    free(scene->rest);
    free(scene->now);
    free(scene->phase);
    free(scene->index);
    memset(scene, 0, sizeof *scene);
}

void bench_procedural_move(bench_procedural *scene, uint32_t frame)
{
    const uint32_t width = scene->width;
    const float reach = scene->reach;
    for (uint32_t i = 0; i < scene->count; i++) {
        const float *q = scene->rest + width * (size_t)i, p = scene->phase[i] + 0.35f * (float)frame;
        float *d = scene->now + width * (size_t)i;
        d[0] = q[0] + reach * sinf(p);
        d[1] = q[1] + reach * cosf(p * 1.3f);
        d[2] = q[2] + reach * sinf(p * 0.7f + 1);
        if (width == 4)
            d[3] = q[3];
    }
}

/* ---- Spheres ------------------------------------------------------------------------------------------------- */

/* A random number around 0 of variance 1, nearly Gaussian. */
static float bell(uint64_t *state)
{
    float sum = -6;
    for (int i = 0; i < 12; i++)
        sum += bench_random(state);
    return sum;
}

/* Places the spheres and their phases. The first numbers of the random sequence are for the clusters. */
static void place_spheres(bench_procedural *scene, uint32_t spheres, int clustered, float spacing)
{
    static const float half[3] = {1.78f, 1, 1}, half_of_middles[3] = {1.5f, 0.8f, 0.9f};
    float cluster[CLUSTERS][4]; /* middle and spread */
    uint64_t state = bench_random_start;
    for (int k = 0; k < CLUSTERS; k++) {
        for (int a = 0; a < 3; a++)
            cluster[k][a] = (bench_random(&state) * 2 - 1) * half_of_middles[a];
        cluster[k][3] = 0.02f + 0.2f * bench_random(&state);
    }
    for (uint32_t i = 0; i < spheres; i++) {
        float *q = scene->rest + 4 * (size_t)i;
        q[3] = 0.5f * spacing * (0.6f + 0.4f * bench_random(&state)) * (clustered ? 0.6f : 1.0f);
        const float *c = clustered ? cluster[(int)(bench_random(&state) * CLUSTERS)] : NULL;
        for (int a = 0; a < 3; a++)
            q[a] = c ? c[a] + c[3] * bell(&state) : (bench_random(&state) * 2 - 1) * half[a];
        scene->phase[i] = 6.28f * bench_random(&state);
    }
}

int bench_procedural_cloud(bench_procedural *scene, uint32_t spheres, int clustered)
{
    const float spacing = cbrtf(14.2f / (float)spheres);
    if (reserve(scene, spheres, 0, 4))
        return -1;
    scene->count = spheres;
    scene->reach = 0.3f * spacing;
    place_spheres(scene, spheres, clustered, spacing);
    bench_procedural_move(scene, 0);
    return 0;
}

/* ---- Triangles ----------------------------------------------------------------------------------------------- */

/* The points of one ball, parallel by parallel from the pole at +y. */
static void add_points(bench_procedural *scene, const bench_balls *balls, const float centre[3])
{
    for (uint32_t j = 0; j <= balls->parallels; j++)
        for (uint32_t i = 0; i < balls->meridians; i++) {
            const float theta = 3.14159265f * (float)j / (float)balls->parallels;
            const float phi = 6.2831853f * (float)i / (float)balls->meridians;
            const float bumps =
                1 + 0.08f * sinf(5 * phi) * sinf(4 * theta) + 0.03f * sinf(17 * phi + 3) * sinf(13 * theta);
            const float r = balls->radius * bumps;
            float *q = scene->rest + 3 * (size_t)scene->count;
            q[0] = centre[0] + r * sinf(theta) * cosf(phi);
            q[1] = centre[1] + r * cosf(theta);
            q[2] = centre[2] + r * sinf(theta) * sinf(phi);
            scene->phase[scene->count++] = theta * 4;
        }
}

/* The triangles of one ball over the points from `first` on: two for each mesh of meridians and parallels. */
static void add_triangles(bench_procedural *scene, uint32_t meridians, uint32_t parallels, uint32_t first)
{
    for (uint32_t j = 0; j < parallels; j++)
        for (uint32_t i = 0; i < meridians; i++) {
            const uint32_t a = first + j * meridians + i;
            const uint32_t b = first + j * meridians + (i + 1) % meridians;
            const uint32_t c = a + meridians, d = b + meridians;
            uint32_t *q = scene->index + 3 * (size_t)scene->triangles;
            memcpy(q, (const uint32_t[]){a, c, b, b, c, d}, 6 * sizeof *q);
            scene->triangles += 2;
        }
}

/* A bowl below the balls, which rises towards its rim. */
static void add_bowl(bench_procedural *scene, const bench_balls *balls)
{
    const uint32_t first = scene->count;
    for (uint32_t j = 0; j <= BOWL_PARALLELS; j++)
        for (uint32_t i = 0; i < BOWL_MERIDIANS; i++) {
            const float share = (float)j / (float)BOWL_PARALLELS;
            const float phi = 6.2831853f * (float)i / (float)BOWL_MERIDIANS;
            float *q = scene->rest + 3 * (size_t)scene->count;
            q[0] = balls->bowl * share * cosf(phi);
            q[1] = balls->bowl * 0.3f * share * share - 1.2f * balls->radius;
            q[2] = balls->bowl * share * sinf(phi);
            scene->phase[scene->count++] = share * 4;
        }
    add_triangles(scene, BOWL_MERIDIANS, BOWL_PARALLELS, first);
}

int bench_procedural_balls(bench_procedural *scene, const bench_balls *balls)
{
    const uint64_t bowl_points = balls->bowl > 0.0f ? (BOWL_PARALLELS + 1) * BOWL_MERIDIANS : 0;
    const uint64_t bowl_triangles = balls->bowl > 0.0f ? 2 * BOWL_PARALLELS * BOWL_MERIDIANS : 0;
    const uint64_t points = bowl_points + (uint64_t)balls->balls * (balls->parallels + 1) * balls->meridians;
    const uint64_t triangles = bowl_triangles + (uint64_t)balls->balls * balls->parallels * balls->meridians * 2;
    uint64_t state = bench_random_start;
    if (reserve(scene, points, triangles, 3))
        return -1;
    scene->reach = 0.02f;
    for (uint32_t k = 0; k < balls->balls; k++) {
        float centre[3];
        for (int c = 0; c < 3; c++)
            centre[c] = (bench_random(&state) * 2 - 1) * balls->extent[c];
        const uint32_t first = scene->count;
        add_points(scene, balls, centre);
        add_triangles(scene, balls->meridians, balls->parallels, first);
    }
    if (balls->bowl > 0.0f)
        add_bowl(scene, balls);
    bench_procedural_move(scene, 0);
    return 0;
}
