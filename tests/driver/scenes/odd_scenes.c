/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A few primitives at odds with single precision: long, thin, huge, far apart, equal; at any scale, and maybe far from
 * the origin. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"

/* ---- primitives ---- */

/* A number, often a power of ten. */
static float any_power(test_random *r, float low, float high)
{
    return random_below(r, 3) ? random_log(r, low, high) : powf(10, rintf(log10f(random_log(r, low, high))));
}

static void random_point(test_random *r, float reach, float p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = random_below(r, 4) ? random_float(r, -reach, reach) : rintf(random_float(r, -2, 2)) * reach / 2;
}

/* A point so far away from another in any direction, now and then along an axis. */
static void beside(test_random *r, const float from[3], float way, float p[3])
{
    float d[3];
    random_direction(r, d);
    if (random_below(r, 4) == 0)
        for (uint32_t a = 0, axis = random_below(r, 3); a < 3; a++)
            d[a] = a == axis ? (random_below(r, 2) ? 1.f : -1.f) : 0;
    for (int a = 0; a < 3; a++)
        p[a] = from[a] + way * d[a];
}

static void add_sphere(scene_heap *h, const float p[3], float radius)
{
    memcpy(scene_heap_add(h, ORACLE_SPHERE), (float[]){p[0], p[1], p[2], radius}, 4 * sizeof(float));
}

static void add_capsule(scene_heap *h, const float p[3], const float q[3], float radius)
{
    float *const c = scene_heap_add(h, ORACLE_CAPSULE);
    memcpy(c, p, 3 * sizeof *c);
    memcpy(c + 3, q, 3 * sizeof *c);
    c[6] = radius;
}

static void add_triangle(scene_heap *h, const float p[3], const float q[3], const float v[3])
{
    float *const t = scene_heap_add(h, ORACLE_TRIANGLE);
    memcpy(t, p, 3 * sizeof *t);
    memcpy(t + 3, q, 3 * sizeof *t);
    memcpy(t + 6, v, 3 * sizeof *t);
}

/* A primitive of any kind, of about that size. */
static void add_usual(scene_heap *h, uint32_t kinds, float reach, float size)
{
    test_random *const r = h->r;
    float p[3], q[3], v[3];
    random_point(r, reach, p);
    beside(r, p, size, q);
    beside(r, p, size, v);
    switch (kinds >> random_below(r, 3) & 1 ? random_below(r, 3) : kinds % 3) {
    case 0: add_sphere(h, p, size / 2); break;
    case 1: add_triangle(h, p, q, v); break;
    default: add_capsule(h, p, q, random_below(r, 8) ? size / 8 : 0); break;
    }
}

static void add_some(scene_heap *h)
{
    test_random *const r = h->r;
    const uint32_t kinds = random_below(r, 8);
    for (uint32_t k = random_below(r, 24); k; k--)
        add_usual(h, kinds, 1, random_log(r, 0.01f, 0.5f));
}

static void place_rods(scene_heap *h)
{
    test_random *const r = h->r;
    const uint32_t count = 1 + random_below(r, 10);
    const float thick = any_power(r, 1e-3f, 1), along = any_power(r, 1, 1e9f);
    float way[3], zero[3] = {0, 0, 0};
    beside(r, zero, 1, way);
    for (uint32_t k = 0; k < count; k++) {
        const float length = random_below(r, 3) ? along : any_power(r, 1, 1e15f);
        float p[3], q[3];
        random_point(r, random_below(r, 2) ? 1 : 10 * thick, p);
        beside(r, p, length * thick, q);
        for (int a = 0; a < 3 && k % 3 == 2; a++)
            q[a] = p[a] + way[a] * length * thick;
        add_capsule(h, p, q, random_below(r, 10) ? thick * (random_below(r, 3) ? 1 : random_float(r, 0, 1)) : 0);
        if (random_below(r, 5) == 0)
            add_sphere(h, random_below(r, 2) ? p : q, thick);
    }
    if (random_below(r, 3) == 0)
        add_some(h);
}

static void place_slivers(scene_heap *h)
{
    test_random *const r = h->r;
    const uint32_t count = 1 + random_below(r, 16);
    const float width = any_power(r, 1e-6f, 1), aspect = any_power(r, 10, 1e9f);
    for (uint32_t k = 0; k < count; k++) {
        const float length = width * (random_below(r, 3) ? aspect : any_power(r, 10, 1e15f));
        float p[3], q[3], v[3];
        random_point(r, random_below(r, 2) ? 1 : 10 * width, p);
        beside(r, p, length, q);
        const float at = random_below(r, 3) ? (float)random_below(r, 2) : random_float(r, 0, 1);
        for (int a = 0; a < 3; a++)
            v[a] = p[a] + (q[a] - p[a]) * at;
        beside(r, v, width, v);
        add_triangle(h, p, q, v);
        if (random_below(r, 4) == 0)
            add_triangle(h, q, p, v);
    }
    if (random_below(r, 3) == 0)
        add_some(h);
}

static void place_giants(scene_heap *h)
{
    test_random *const r = h->r;
    add_some(h);
    for (uint32_t k = 1 + random_below(r, 3); k; k--) {
        const float size = any_power(r, 10, random_below(r, 2) ? 1e4f : 1e15f);
        float p[3], q[3], v[3], near[3];
        random_point(r, 1, near);
        beside(r, near, size, p);
        beside(r, p, size, q);
        beside(r, p, size, v);
        switch (random_below(r, 5)) {
        case 0: add_sphere(h, p, size); break;
        case 1: add_sphere(h, p, size * random_float(r, 0.9f, 1.1f)); break;
        case 2: add_capsule(h, p, q, size * random_float(r, 0, 1)); break;
        case 3: add_triangle(h, p, q, v); break;
        default:
            for (int a = 0; a < 3; a++) /* a floor */
                p[a] = a == 1 ? -1 : -size,
                q[a] = a == 0   ? size
                       : a == 1 ? -1
                                : -size,
                v[a] = a == 1 ? -1
                       : a    ? size
                              : 0;
            add_triangle(h, p, q, v);
        }
    }
}

static void place_strays(scene_heap *h)
{
    test_random *const r = h->r;
    for (uint32_t k = 1 + random_below(r, 20), kinds = random_below(r, 8); k; k--)
        add_usual(h, kinds, 1, random_log(r, 0.01f, 0.5f));
    for (uint32_t k = 1 + random_below(r, 3); k; k--) {
        const float far = any_power(r, 1e2f, random_below(r, 2) ? 1e9f : random_below(r, 2) ? 1e15f : 1e32f);
        const float size = random_below(r, 2) ? random_log(r, 0.01f, 1) : far * random_log(r, 1e-6f, 1);
        float p[3], q[3], v[3], zero[3] = {0, 0, 0};
        beside(r, zero, far, p);
        beside(r, p, size, q);
        beside(r, p, size, v);
        switch (random_below(r, 6)) {
        case 0: add_sphere(h, p, size); break;
        case 1: add_triangle(h, p, q, v); break;
        case 2: add_capsule(h, p, q, size / 4); break;
        case 3:
            random_point(r, 1, q);
            add_capsule(h, q, p, random_below(r, 2) ? 0.1f : far * 1e-3f);
            break;
        case 4:
            random_point(r, 1, q);
            random_point(r, 1, v);
            add_triangle(h, q, random_below(r, 2) ? v : q, p);
            break;
        default:
            random_point(r, 1, q);
            beside(r, q, far, v);
            add_triangle(h, q, v, p);
        }
    }
}

static void place_sizes(scene_heap *h)
{
    test_random *const r = h->r;
    const float low = any_power(r, 1e-12f, 1), high = any_power(r, 1, 1e12f);
    for (uint32_t k = 1 + random_below(r, 30), kinds = random_below(r, 8); k; k--) {
        const float size = random_log(r, low, high);
        add_usual(h, kinds, size, size * random_log(r, 0.01f, 1));
    }
}

static void place_equals(scene_heap *h)
{
    test_random *const r = h->r;
    for (uint32_t k = 1 + random_below(r, 20); k; k--) {
        float p[3], q[3], v[3];
        for (int a = 0; a < 3; a++) {
            p[a] = (float)random_below(r, 3) - 1;
            q[a] = random_below(r, 2) ? p[a] : (float)random_below(r, 3) - 1;
            v[a] = random_below(r, 2) ? p[a] : (float)random_below(r, 3) - 1;
        }
        const float radius = random_below(r, 4) ? 0.5f : random_below(r, 2) ? 0.25f : 0;
        switch (random_below(r, 3)) {
        case 0: add_sphere(h, p, radius); break;
        case 1: add_triangle(h, p, q, v); break;
        default: add_capsule(h, p, q, radius);
        }
    }
}

static void place_usual(scene_heap *h)
{
    test_random *const r = h->r;
    const uint32_t kinds = random_below(r, 8);
    const float most = random_below(r, 2) ? 0.1f : 1;
    for (uint32_t k = 1 + random_below(r, 40); k; k--)
        add_usual(h, kinds, 1, random_log(r, 0.01f, most));
}

static void place_crowds(scene_heap *h)
{
    test_random *const r = h->r;
    const uint32_t kinds = random_below(r, 8), clumps = 1 + random_below(r, 4);
    const float spread = random_below(r, 2) ? 1 : any_power(r, 1, 1e5f);
    float middle[4][3];
    for (uint32_t k = 0; k < clumps; k++)
        random_point(r, spread, middle[k]);
    for (uint32_t k = 300 + random_below(r, 1500); k; k--) {
        float p[3], q[3], v[3];
        const float size = random_log(r, 1e-3f, 0.1f);
        beside(r, middle[random_below(r, clumps)], random_float(r, 0, 1), p);
        beside(r, p, size, q);
        beside(r, p, size, v);
        switch (kinds < 3 ? kinds : kinds < 6 ? random_below(r, 3) : 1 + random_below(r, 2)) {
        case 0: add_sphere(h, p, size / 2); break;
        case 1: add_triangle(h, p, q, v); break;
        default: add_capsule(h, p, q, size / 8);
        }
    }
    for (uint32_t k = random_below(r, 4); k; k--)
        add_usual(h, kinds, any_power(r, 1, 1e9f), any_power(r, 0.01f, 1e9f));
}

/* Spheres whose squares are denormal next to what is far away, in magnitudes that stay in one piece. */
static void place_underflows(scene_heap *h)
{
    test_random *const r = h->r;
    const float far = random_log(r, 1e9f, 1e12f), size = random_log(r, 0x1p-35f, 1e-9f);
    for (uint32_t k = 1 + random_below(r, 30); k; k--) {
        float p[3];
        random_point(r, size, p);
        add_sphere(h, p, size * random_log(r, 0.05f, 0.5f));
    }
    add_usual(h, random_below(r, 8), far, far * random_log(r, 1e-12f, 1));
    h->scene->scale = size;
}

/* The same of any kind, and smaller. */
static void place_specks(scene_heap *h)
{
    test_random *const r = h->r;
    const float far = any_power(r, random_below(r, 2) ? 1e-8f : 1, 1e12f);
    const float size = far * (random_below(r, 3) ? random_log(r, 1e-23f, 1e-19f) : any_power(r, 1e-36f, 1e-12f));
    const uint32_t kinds = random_below(r, 8);
    const bool alike = random_below(r, 2);
    for (uint32_t k = 1 + random_below(r, 30); k; k--) {
        float p[3];
        random_point(r, size, p);
        if (alike)
            add_sphere(h, p, size * random_log(r, 0.05f, 0.5f));
        else
            add_usual(h, kinds, size, size * random_log(r, 0.01f, 0.5f));
    }
    for (uint32_t k = 1 + random_below(r, 3); k; k--)
        add_usual(h, random_below(r, 8), far, far * random_log(r, 1e-12f, 1));
    h->scene->scale = size;
}

static const struct {
    const char *name;
    void (*place)(scene_heap *h);
    bool has_size; /* and a place where floats tell its primitives apart */
} families[] = {{"rods", place_rods, false},     {"slivers", place_slivers, false},
                {"giants", place_giants, false}, {"far strays", place_strays, false},
                {"sizes", place_sizes, false},   {"equals", place_equals, false},
                {"usual", place_usual, false},   {"crowds", place_crowds, false},
                {"specks", place_specks, true},  {"underflows", place_underflows, true}};

static const char *family_name(uint32_t family) { return families[family].name; }

static void scale_and_move(scene_heap *h, float scale, const float by[3])
{
    static const int places[JUDGE_KINDS] = {[ORACLE_SPHERE] = 3, [ORACLE_TRIANGLE] = 9, [ORACLE_CAPSULE] = 6};
    for (uint32_t kind = 0; kind < JUDGE_KINDS; kind++)
        for (uint32_t i = 0; i < h->count[kind]; i++)
            for (int k = 0; k < oracle_floats((oracle_kind)kind); k++)
                h->data[kind][i][k] = h->data[kind][i][k] * scale + (k < places[kind] ? by[k % 3] : 0);
}

static void make(scene_heap *h, uint32_t family)
{
    test_random *const r = h->r;
    float by[3] = {0, 0, 0}, unit = 1;
    families[family].place(h);
    if (families[family].has_size)
        return;
    if (random_below(r, 4) == 0)
        unit = any_power(r, 1e-30f, 1e30f);
    else if (random_below(r, 6) == 0)
        unit = any_power(r, 1e-9f, 1e9f);
    if (random_below(r, 6) == 0)
        beside(r, by, unit * any_power(r, 1, 1e6f), by);
    scale_and_move(h, unit, by);
    memcpy(h->scene->middle, by, sizeof by);
    h->scene->scale = unit;
}

const scene_group odd_scenes = {sizeof families / sizeof families[0], family_name, make};
