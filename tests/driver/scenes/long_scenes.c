/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes whose rays hit more than a list, or a band's, holds, at many equal places; in any unit of length. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"

#define COUNT 90u

static void sphere(scene_heap *h, float unit, float x, float r)
{
    memcpy(scene_heap_add(h, ORACLE_SPHERE), (float[]){unit * x, 0, 0, unit * r}, 4 * sizeof(float));
}

static void triangle(scene_heap *h, float unit, const float v[9])
{
    float *const to = scene_heap_add(h, ORACLE_TRIANGLE);
    for (int k = 0; k < 9; k++)
        to[k] = unit * v[k];
}

/* Triangles around a vertex. */
static void fan(scene_heap *h, float unit)
{
    for (uint32_t i = 0; i < COUNT; i++) {
        const float x = 8 * ((float)i - 45), z = (float)(i % 3) - 1;
        triangle(h, unit, (float[]){0, 0, 0, x, 300, z, x + 8, 300, 1});
    }
}

static void copies(scene_heap *h, float unit)
{
    for (uint32_t i = 0; i < COUNT; i++) {
        triangle(h, unit, (float[]){-4, -4, 1, 8, -4, 1, -4, 8, 1});
        sphere(h, unit, 0, 2);
    }
}

/* Rays touch them in one point; one of them is a point. */
static void concentric(scene_heap *h, float unit)
{
    for (uint32_t i = 0; i < COUNT; i++)
        sphere(h, unit, 0, (float)i);
}

/* Spheres that touch one another. */
static void row(scene_heap *h, float unit)
{
    for (uint32_t i = 0; i < COUNT; i++)
        sphere(h, unit, 2 * (float)i, 1);
    h->scene->axis = 0;
}

static const struct {
    const char *name;
    void (*make)(scene_heap *h, float unit);
} families[] = {
    {"a fan of blades", fan}, {"copies of two", copies}, {"concentric spheres", concentric}, {"a row of spheres", row}};

static const char *family_name(uint32_t family) { return families[family].name; }

static void make(scene_heap *h, uint32_t family)
{
    static const float units[] = {1, 0x1p-30f, 0x1p-100f, 0x1p50f};
    h->scene->scale = units[random_below(h->r, 4)];
    h->scene->axis = 2;
    families[family].make(h, h->scene->scale);
}

const scene_group long_scenes = {sizeof families / sizeof families[0], family_name, make};
