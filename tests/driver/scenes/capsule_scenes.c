/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A few capsules of many kinds, one row each, among them spheres at their ends and triangles from their ends. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"

#define MOST 12u

static uint32_t below(scene_heap *h, uint32_t n) { return random_below(h->r, n); }
static float whole(scene_heap *h, uint32_t n) { return (float)random_below(h->r, n); }
static float real(scene_heap *h, float low, float high) { return random_float(h->r, low, high); }

/* ---- kinds: what becomes of capsule i, which is evenly spread and small at first ---- */

typedef void change(scene_heap *h, uint32_t i, float *c);

static const float *capsule(const scene_heap *h, uint32_t i) { return h->data[ORACLE_CAPSULE][i]; }

static void scale(float *c, float by)
{
    for (int k = 0; k < 7; k++)
        c[k] *= by;
}

static void even(scene_heap *h, uint32_t i, float *c) { (void)h, (void)i, (void)c; }

static void lattice(scene_heap *h, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 6; k++)
        c[k] = whole(h, 4);
    c[6] = 0.5f;
}

/* Along an axis, so that lines along it, and across it, are exact tangents. */
static void upright(scene_heap *h, uint32_t i, float *c)
{
    const uint32_t axis = below(h, 3);
    (void)i;
    for (uint32_t k = 0; k < 3; k++)
        c[k] = c[3 + k] = whole(h, 3);
    c[3 + axis] += 1 + whole(h, 3);
    c[6] = 0.25f * (1 + whole(h, 4));
}

static void chain(scene_heap *h, uint32_t i, float *c)
{
    if (i)
        memcpy(c, capsule(h, i - 1) + 3, 3 * sizeof *c);
    c[6] = i % 4 ? capsule(h, 0)[6] : i ? c[6] : 0.125f;
}

/* Bonds of one atom. */
static void star(scene_heap *h, uint32_t i, float *c)
{
    memmove(c + (i % 2 ? 3 : 0), capsule(h, 0), 3 * sizeof *c);
    c[6] = capsule(h, 0)[6];
}

static void coincident(scene_heap *h, uint32_t i, float *c)
{
    const float *const from = capsule(h, i / 2);
    if (!i)
        return;
    memcpy(c, from, 7 * sizeof *c);
    if (i % 3 == 1) { /* the ends exchanged */
        memcpy(c, from + 3, 3 * sizeof *c);
        memcpy(c + 3, from, 3 * sizeof *c);
    }
    if (i % 4 == 3) {
        const uint32_t k = below(h, 7);
        c[k] = nextafterf(c[k], INFINITY);
    }
}

/* On one line, one in the other. */
static void nested(scene_heap *h, uint32_t i, float *c)
{
    (void)h;
    memset(c, 0, 6 * sizeof *c);
    c[3] = (float)(1 + i % 3);
    c[0] = -(float)(i / 6);
    c[6] = (float)(1 + i % 2) / 4;
}

static void long_ones(scene_heap *h, uint32_t i, float *c)
{
    (void)i;
    c[6] = ldexpf(c[6], -(int)below(h, 60));
}

static void thick_ones(scene_heap *h, uint32_t i, float *c)
{
    const int exponent = (int)below(h, 30);
    (void)i;
    for (int k = 3; k < 6; k++)
        c[k] = c[k - 3] + ldexpf(c[k], -exponent);
}

static void spheres(scene_heap *h, uint32_t i, float *c)
{
    (void)h;
    memcpy(c + 3, c, 3 * sizeof *c);
    c[3] *= i % 3 ? 1 : 1 + 0x1p-23f;
}

static void lines(scene_heap *h, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 6; k++)
        c[k] = whole(h, 5) / 2;
    c[6] = 0;
}

static void scales(scene_heap *h, uint32_t i, float *c)
{
    (void)i;
    scale(c, ldexpf(1, (int)below(h, 201) - 100));
}

static void far_away(scene_heap *h, uint32_t i, float *c)
{
    (void)h, (void)i;
    for (int k = 0; k < 6; k++)
        c[k] += 0x1p16f * (float)(1 + k % 3);
}

static void denormal(scene_heap *h, uint32_t i, float *c)
{
    (void)h, (void)i;
    scale(c, 0x1p-140f);
}

static void near_limit(scene_heap *h, uint32_t i, float *c)
{
    (void)h, (void)i;
    scale(c, 0x1.8p126f);
}

static void odd_coordinates(scene_heap *h, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 7; k++)
        if (below(h, 4) == 0)
            c[k] = ldexpf(c[k], (int)below(h, 221) - 110);
}

static void any_bits(scene_heap *h, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 7; k++)
        c[k] = random_any_float(h->r);
    c[6] = fabsf(c[6]);
}

static const struct {
    const char *name;
    change *change;
} kinds[] = {{"even capsules", even},
             {"capsules on a lattice", lattice},
             {"upright capsules", upright},
             {"a chain", chain},
             {"bonds of one atom", star},
             {"coincident capsules", coincident},
             {"nested capsules", nested},
             {"long capsules", long_ones},
             {"thick capsules", thick_ones},
             {"capsules like spheres", spheres},
             {"capsules like lines", lines},
             {"capsules of any size", scales},
             {"capsules far from the origin", far_away},
             {"denormal capsules", denormal},
             {"capsules near 2^127", near_limit},
             {"capsules of odd coordinates", odd_coordinates},
             {"capsules of any bits", any_bits}};

static const char *kind_name(uint32_t kind) { return kinds[kind].name; }

static void make(scene_heap *h, uint32_t kind)
{
    const uint32_t count = 1 + below(h, MOST);
    for (uint32_t i = 0; i < count; i++) {
        float *const c = scene_heap_add(h, ORACLE_CAPSULE);
        for (int k = 0; k < 3; k++) {
            c[k] = real(h, -1, 1);
            c[3 + k] = c[k] + real(h, -0.6f, 0.6f);
        }
        c[6] = real(h, 0.02f, 0.2f);
        kinds[kind].change(h, i, c);
        const float sphere[4] = {c[3], c[4], c[5], c[6] * (below(h, 2) ? 1 : 1.25f)};
        const float triangle[9] = {c[0], c[1], c[2], c[3], c[4], c[5], c[0] + c[6], c[1], c[2] - c[6]};
        if (below(h, 8) == 0)
            memcpy(scene_heap_add(h, ORACLE_SPHERE), sphere, sizeof sphere);
        if (below(h, 8) == 0)
            memcpy(scene_heap_add(h, ORACLE_TRIANGLE), triangle, sizeof triangle);
    }
    h->scene->scale = 0; /* of any magnitude */
}

const scene_group capsule_scenes = {sizeof kinds / sizeof kinds[0], kind_name, make};
