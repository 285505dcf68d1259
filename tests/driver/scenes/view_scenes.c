/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes that are hard for the tiles of a frame: more triangles than a tile lists, or than are drawn between two looks
 * at the farthest depth, floors far larger than what lies on them, far things at like depths, walls one float apart,
 * vertices on the rays of pixels. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"

static uint32_t below(scene_heap *h, uint32_t n) { return random_below(h->r, n); }
static float real(scene_heap *h, float low, float high) { return random_float(h->r, low, high); }

static void sphere(scene_heap *h, const float p[3], float r)
{
    memcpy(scene_heap_add(h, ORACLE_SPHERE), (float[]){p[0], p[1], p[2], r}, 4 * sizeof(float));
}

static void capsule(scene_heap *h, const float p[3], const float q[3], float r)
{
    memcpy(scene_heap_add(h, ORACLE_CAPSULE), (float[]){p[0], p[1], p[2], q[0], q[1], q[2], r}, 7 * sizeof(float));
}

static void triangle(scene_heap *h, const float p[3], const float q[3], const float v[3])
{
    float *const t = scene_heap_add(h, ORACLE_TRIANGLE);
    memcpy(t, p, 3 * sizeof *t);
    memcpy(t + 3, q, 3 * sizeof *t);
    memcpy(t + 6, v, 3 * sizeof *t);
}

static void square(scene_heap *h, float corner[4][3])
{
    triangle(h, corner[0], corner[1], corner[2]);
    triangle(h, corner[1], corner[3], corner[2]);
}

/* ---- meshes before the eye ---- */

/* Waves of n x n squares, which a tile sees as a whole. */
static void fine_sheet(scene_heap *h)
{
    const uint32_t n = below(h, 3) ? 30 + below(h, 5) : 8 + below(h, 40);
    for (uint32_t i = 0; i < n * n; i++) {
        float corner[4][3];
        for (uint32_t k = 0; k < 4; k++) {
            corner[k][0] = 2 * (float)(i % n + k % 2) / (float)n - 1;
            corner[k][1] = 2 * (float)(i / n + k / 2) / (float)n - 1;
            corner[k][2] = 1.1f + 0.1f * sinf(7 * corner[k][0]) * cosf(5 * corner[k][1]);
        }
        square(h, corner);
    }
    h->scene->aims = SCENE_AIMS_CONE;
}

/* All larger than a picture, and close in depth. */
static void large_layers(scene_heap *h)
{
    const float apart = random_log(h->r, 1e-3f, 1);
    for (uint32_t i = 0; i < 280; i++) {
        float v[3][3];
        for (int k = 0; k < 3; k++) {
            const float angle = 2.0943951f * (float)k + real(h, 0, 1), size = real(h, 5, 40);
            v[k][0] = size * cosf(angle);
            v[k][1] = size * sinf(angle);
            v[k][2] = apart * real(h, -1, 1);
        }
        triangle(h, v[0], v[1], v[2]);
    }
}

/* Three height fields, one of them doubled, with vertices on the rays of every fourth of 64x64 pixels that a camera at
 * the origin sees along z, exactly or but for rounding. */
static void vertices_on_rays(scene_heap *h)
{
    static float vertex[2][17][17][3];
    const bool exact = below(h, 2), parallel = below(h, 3) == 0;
    for (uint32_t i = 0; i < 2 * 17 * 17; i++) {
        const uint32_t x = i % 17, y = i / 17 % 17;
        const float t = exact ? 1 + (float)below(h, 4) : real(h, 1, 2), wide = parallel ? 1 : t;
        float *const v = vertex[i / 289][y][x];
        v[0] = wide * (((float)(4 * x) + 0.5f) / 32 - 1);
        v[1] = wide * (1 - ((float)(4 * y) + 0.5f) / 32);
        v[2] = t;
    }
    for (uint32_t i = 0; i < 3 * 16 * 16; i++) {
        float corner[4][3];
        for (uint32_t k = 0; k < 4; k++)
            memcpy(corner[k], vertex[i / 512][i / 16 % 16 + k / 2][i % 16 + k % 2], sizeof corner[k]);
        square(h, corner);
    }
    h->scene->aims = parallel ? SCENE_AIMS_PARALLEL : SCENE_AIMS_CONE;
}

/* The nearer one has the higher numbers. */
static void walls(scene_heap *h)
{
    for (int w = 0; w < 2; w++) {
        float corner[4][3];
        for (int k = 0; k < 4; k++) {
            corner[k][0] = k & 1 ? 5.f : -5.f;
            corner[k][1] = k & 2 ? 5.f : -5.f;
            corner[k][2] = w ? 3 : nextafterf(3, 4);
        }
        square(h, corner);
    }
    h->scene->aims = SCENE_AIMS_CONE;
}

/* Many pixels in a row hit the same one; nothing else is there. */
static void large_balls(scene_heap *h)
{
    for (uint32_t i = 2 + below(h, 60); i > 0; i--) {
        const float p[3] = {real(h, -1, 1), real(h, -1, 1), real(h, -1, 1)};
        sphere(h, p, real(h, 0.2f, 0.7f));
    }
}

/* ---- far floors, far things ---- */

static void things(scene_heap *h, uint32_t count)
{
    const uint32_t sorts = 1 + below(h, 7);
    for (uint32_t i = 0; i < count; i++) {
        float p[3][3];
        for (int a = 0; a < 3; a++) {
            p[0][a] = real(h, -1, 1);
            p[1][a] = p[0][a] + real(h, -0.1f, 0.1f);
            p[2][a] = p[0][a] + real(h, -0.1f, 0.1f);
        }
        if (sorts & 1)
            sphere(h, p[0], 0.04f);
        if (sorts & 2)
            triangle(h, p[0], p[1], p[2]);
        if (sorts & 4)
            capsule(h, p[0], p[1], 0.02f);
    }
}

static void far_floor(scene_heap *h)
{
    const float size = random_log(h->r, 3, 1e13f);
    things(h, 20 + below(h, 400));
    float corner[4][3];
    for (uint32_t k = 0; k < 4; k++) {
        corner[k][0] = k % 2 ? size : -size;
        corner[k][1] = -1.1f;
        corner[k][2] = k / 2 ? size : -size;
    }
    const float lowest[3] = {0, -1.1f - size, 0}, ends[2][3] = {{-size, lowest[1], 0}, {size, lowest[1], 0}};
    switch (below(h, 3)) {
    case 0: square(h, corner); break;
    case 1: sphere(h, lowest, size); break;
    default: capsule(h, ends[0], ends[1], size); break;
    }
}

/* A point at about this distance; some are moved by as little as a float. */
static void far_place(scene_heap *h, float distance, float place[3])
{
    static const float middle[3] = {-0.2f, -0.3f, 1};
    const float apart = below(h, 3) ? random_log(h->r, 1e-8f, 1e-3f) : 0.2f;
    for (int a = 0; a < 3; a++)
        place[a] = distance * (middle[a] + apart * real(h, -1, 1));
}

/* They cover each other at like depths, whose rounding may exceed the depth error of what is in front of them. */
static void far_things(scene_heap *h)
{
    const float distance = random_log(h->r, 10, 1e9f);
    const uint32_t sorts = 1 + below(h, 7);
    things(h, 20 + below(h, 300));
    for (uint32_t i = 1 + below(h, 4); i > 0; i--) {
        float p[4][3];
        const float radius = distance * (below(h, 2) ? 0.3f : random_log(h->r, 1e-3f, 0.9f));
        for (int k = 0; k < 4; k++)
            far_place(h, distance, p[k]);
        if (sorts & 1)
            sphere(h, p[0], radius);
        if (sorts & 4)
            capsule(h, p[0], p[1], radius);
        for (int k = 1; k < 4; k++)
            p[k][k % 2] += distance * (k > 1 ? 1.5f : -1.5f) * real(h, 0.5f, 1);
        if (sorts & 2)
            triangle(h, p[1], p[2], p[3]);
    }
}

static const struct {
    const char *name;
    void (*make)(scene_heap *h);
} families[] = {{"a fine sheet", fine_sheet},
                {"large layers", large_layers},
                {"vertices on rays", vertices_on_rays},
                {"walls", walls},
                {"large balls", large_balls},
                {"a far floor", far_floor},
                {"far things", far_things}};

static const char *family_name(uint32_t family) { return families[family].name; }
static void make(scene_heap *h, uint32_t family) { families[family].make(h); }

const scene_group view_scenes = {sizeof families / sizeof families[0], family_name, make};
