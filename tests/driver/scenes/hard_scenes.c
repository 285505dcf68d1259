/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Families of scenes, one row each, hard in its own way; behind them the kinds of kind_scenes.c. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"

/* ---- primitives ---- */

static uint32_t below(scene_heap *h, uint32_t n) { return random_below(h->r, n); }
static float whole(scene_heap *h, uint32_t n) { return (float)random_below(h->r, n); }
static float real(scene_heap *h, float low, float high) { return random_float(h->r, low, high); }

/* 2 to a power between low and high. */
static float power(scene_heap *h, float low, float high) { return exp2f(real(h, low, high)); }

static void sphere(scene_heap *h, float x, float y, float z, float r)
{
    memcpy(scene_heap_add(h, ORACLE_SPHERE), (float[]){x, y, z, r}, 4 * sizeof(float));
}

static float *capsule(scene_heap *h, const float p[3], const float q[3], float r)
{
    float *c = scene_heap_add(h, ORACLE_CAPSULE);
    memcpy(c, p, 3 * sizeof *c);
    memcpy(c + 3, q, 3 * sizeof *c);
    c[6] = r;
    return c;
}

static float *any_capsule(scene_heap *h, float reach, float length, float r)
{
    float p[3], q[3];
    for (int a = 0; a < 3; a++) {
        p[a] = real(h, -reach, reach);
        q[a] = p[a] + real(h, -length, length);
    }
    return capsule(h, p, q, r);
}

static void any_sphere(scene_heap *h, float reach, float r)
{
    const float x = real(h, -reach, reach), y = real(h, -reach, reach), z = real(h, -reach, reach);
    sphere(h, x, y, z, r);
}

static void any_triangle(scene_heap *h, float reach, float size)
{
    float *const v = scene_heap_add(h, ORACLE_TRIANGLE), at[3];
    for (int a = 0; a < 3; a++)
        at[a] = real(h, -reach, reach);
    for (int k = 0; k < 9; k++)
        v[k] = at[k % 3] + real(h, -size, size);
}

static void triangle(scene_heap *h, const float a[3], const float b[3], const float c[3])
{
    float *const v = scene_heap_add(h, ORACLE_TRIANGLE);
    memcpy(v, a, 3 * sizeof *v);
    memcpy(v + 3, b, 3 * sizeof *v);
    memcpy(v + 6, c, 3 * sizeof *v);
}

static void box(scene_heap *h, const float low[3], const float high[3])
{
    static const int face[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    float corner[8][3];
    for (int i = 0; i < 24; i++)
        corner[i / 3][i % 3] = i / 3 >> i % 3 & 1 ? high[i % 3] : low[i % 3];
    for (int f = 0; f < 12; f++)
        triangle(h, corner[face[f][0]], corner[face[f][1]], corner[face[f][2]]);
}

/* Oriented outwards. */
static void tetrahedron(scene_heap *h, float v[4][3])
{
    static const int face[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    double e[3][3];
    for (int k = 0; k < 9; k++)
        e[k / 3][k % 3] = (double)v[k / 3 + 1][k % 3] - (double)v[0][k % 3];
    const double volume = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                          e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    for (int f = 0; f < 4; f++)
        triangle(h, v[face[f][0]], v[face[f][volume < 0 ? 2 : 1]], v[face[f][volume < 0 ? 1 : 2]]);
}

/* ---- families ---- */

static void lattice_capsules(scene_heap *h)
{
    static const float radius[] = {0.5f, 1, 0.25f};
    const uint32_t m = 2 + below(h, 4);
    for (uint32_t i = 0; i < h->n; i++) {
        float p[3], q[3];
        for (int a = 0; a < 3; a++) {
            p[a] = whole(h, m);
            q[a] = below(h, 2) ? p[a] : whole(h, m);
        }
        capsule(h, p, q, radius[below(h, 3)]);
    }
    h->scene->scale = (float)m;
}

static void any_capsules(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++)
        any_capsule(h, 1, 0.5f, real(h, 0, 0.2f));
}

static void long_thin(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        const float length = power(h, 3, 13);
        any_capsule(h, 1, length, power(h, -16, -3));
    }
}

static void equal_ends(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        float *c = any_capsule(h, 1, 0.3f, real(h, 0, 0.4f));
        memcpy(c + 3, c, 3 * sizeof *c);
        if (below(h, 2))
            sphere(h, c[0], c[1], c[2], c[6]);
    }
}

static void no_radius(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        const float p[3] = {whole(h, 4), whole(h, 4), whole(h, 4)}, q[3] = {whole(h, 4), whole(h, 4), whole(h, 4)};
        capsule(h, p, q, below(h, 4) ? 0 : 0x1p-149f);
        if (below(h, 3) == 0)
            sphere(h, p[0], p[1], p[2], below(h, 2) ? 0 : 0x1p-149f);
    }
    h->scene->scale = 4;
}

static void end_inside(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        const float r = real(h, 0.1f, 0.5f);
        any_capsule(h, 1, r * real(h, 0, 1), r);
    }
}

static void coaxial(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        const float p[3] = {whole(h, 5), 0, 0}, q[3] = {whole(h, 9), 0, 0}, r = 1 / (float)(1u << below(h, 4));
        capsule(h, p, q, r);
        if (below(h, 3) == 0)
            sphere(h, p[0], 0, 0, r);
    }
    h->scene->scale = 4;
}

static void star(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        float *c = any_capsule(h, 1, 1, below(h, 2) ? 0.125f : real(h, 0, 0.1f));
        memset(c, 0, 3 * sizeof *c);
        for (int a = 3; a < 6 && i % 2; a++)
            c[a] = whole(h, 5) - 2;
    }
}

static void chain(scene_heap *h)
{
    float at[3] = {0, 0, 0}, next[3];
    for (uint32_t i = 0; i < h->n; i++) {
        memcpy(next, at, sizeof next);
        next[below(h, 3)] += below(h, 2) ? 1 : -1;
        next[below(h, 3)] += below(h, 3) ? 0 : 0.5f;
        capsule(h, at, next, 0.25f);
        memcpy(at, next, sizeof at);
    }
    h->scene->scale = 3;
}

static void scales(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        const float e = ldexpf(1, (int)below(h, 121) - 60);
        any_capsule(h, e, e, e * real(h, 0, 0.5f));
        if (below(h, 4) == 0)
            any_sphere(h, e, e * real(h, 0, 0.5f));
    }
    h->scene->scale = ldexpf(1, (int)below(h, 121) - 60);
}

static void strays(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++)
        any_capsule(h, 1, 0.3f, real(h, 0, 0.1f));
    for (uint32_t i = 0; i < 1 + below(h, 3); i++) {
        const float far = power(h, 7, 106);
        float *c = any_capsule(h, 1, 1, below(h, 2) ? 0.1f : far * 1e-3f);
        c[3 + below(h, 3)] = far;
        if (below(h, 2))
            c[below(h, 3)] = -far;
    }
}

static void broken(scene_heap *h)
{
    static const float odd[] = {NAN, INFINITY, -INFINITY};
    for (uint32_t i = 0; i < h->n; i++) {
        float *c = any_capsule(h, 1, 0.5f, real(h, -0.3f, 0.5f));
        if (below(h, 2) == 0)
            c[below(h, 7)] = odd[below(h, 3)];
        if (below(h, 3) == 0)
            any_sphere(h, 1, below(h, 2) ? -0.1f : odd[below(h, 3)]);
        if (below(h, 3) == 0) {
            any_triangle(h, 1, 0.5f);
            h->data[ORACLE_TRIANGLE][h->count[ORACLE_TRIANGLE] - 1][below(h, 9)] = odd[below(h, 3)];
        }
    }
}

static void offsets(scene_heap *h)
{
    const float at[3] = {real(h, -1e6f, 1e6f), real(h, -1e6f, 1e6f), real(h, -1e6f, 1e6f)};
    for (uint32_t i = 0; i < h->n; i++) {
        float *c = any_capsule(h, 2, 1, real(h, 0, 0.5f));
        for (int a = 0; a < 6; a++)
            c[a] += at[a % 3];
    }
}

static void mixed(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        any_capsule(h, 1, 0.5f, real(h, 0, 0.2f));
        any_sphere(h, 1, real(h, 0, 0.3f));
        any_triangle(h, 1, 0.5f);
    }
}

static void boxes(scene_heap *h)
{
    for (uint32_t i = 0; i < 1 + h->n % 5; i++) {
        float low[3], high[3];
        for (int a = 0; a < 3; a++) {
            low[a] = real(h, -1, 0.5f);
            high[a] = low[a] + real(h, 0.1f, 1);
        }
        box(h, low, high);
    }
    for (uint32_t i = below(h, 6); i > 0; i--)
        any_sphere(h, 1, real(h, 0, 0.4f));
}

static void lattice_bodies(scene_heap *h)
{
    for (uint32_t i = 0; i < 1 + h->n % 6; i++) {
        const float low[3] = {whole(h, 3), whole(h, 3), whole(h, 3)},
                    high[3] = {low[0] + 1 + whole(h, 2), low[1] + 1 + whole(h, 2), low[2] + 1 + whole(h, 2)};
        box(h, low, high);
    }
    for (uint32_t i = below(h, 7); i > 0; i--) {
        const float x = whole(h, 4), y = whole(h, 4), z = whole(h, 4);
        sphere(h, x, y, z, below(h, 3) ? 1 : below(h, 2) ? 0.5f : 3);
    }
    h->scene->scale = 3;
}

static void tetrahedra(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        float v[4][3];
        const bool on_lattice = below(h, 2);
        for (int k = 0; k < 12; k++)
            v[k / 3][k % 3] = on_lattice ? whole(h, 5) : real(h, -2, 2);
        tetrahedron(h, v);
    }
    h->scene->scale = 3;
}

static void dense(scene_heap *h)
{
    for (uint32_t i = 0; i < 2 * h->n; i++)
        any_capsule(h, 0.3f, 0.5f, real(h, 0.1f, 0.3f));
}

static void balls_and_sticks(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        const float p[3] = {whole(h, 4), whole(h, 4), whole(h, 4)};
        float q[3] = {p[0], p[1], p[2]};
        q[below(h, 3)] += 1;
        sphere(h, p[0], p[1], p[2], 0.25f);
        capsule(h, p, q, below(h, 2) ? 0.25f : 0.125f);
    }
    h->scene->scale = 4;
}

static void all_one(scene_heap *h)
{
    const float *first = any_capsule(h, 1, 1, 0.5f);
    for (uint32_t i = 0; i < h->n; i++) {
        const uint32_t ends = below(h, 4); /* that are those of the first one, in order */
        capsule(h, ends ? first : first + 3, ends > 1 ? first + 3 : first, 0.5f);
    }
}

static void nearly_equal_ends(scene_heap *h)
{
    for (uint32_t i = 0; i < h->n; i++) {
        float *c = any_capsule(h, 1, 0.5f, below(h, 3) ? real(h, 0, 0.2f) : 0);
        const uint32_t axis = below(h, 3);
        memcpy(c + 3, c, 3 * sizeof *c);
        c[3 + axis] = nextafterf(c[axis], 9);
    }
}

static void flat_boxes(scene_heap *h)
{
    for (uint32_t i = 0; i < 1 + h->n % 4; i++) {
        const float low[3] = {whole(h, 3), whole(h, 3), whole(h, 3)},
                    high[3] = {low[0] + whole(h, 2), low[1] + whole(h, 2), low[2] + whole(h, 2)};
        box(h, low, high);
    }
    h->scene->scale = 3;
}

/* One lattice for all: 3, 4, 5 and 5, 12, 13 on spheres, boxes with corners on them, in any unit of length. */
static void spheres_on_boxes(scene_heap *h)
{
    static const float radius[] = {1, 2, 3, 5, 5, 13};
    const float unit = ldexpf(1, (int)below(h, 60) - 30);
    for (uint32_t i = 0; i < 1 + h->n % 12; i++) {
        const float c[3] = {whole(h, 9), whole(h, 9), whole(h, 9)};
        sphere(h, unit * c[0], unit * c[1], unit * c[2], unit * radius[below(h, 6)]);
    }
    for (uint32_t i = below(h, 5); i > 0; i--) {
        const float low[3] = {unit * whole(h, 6), unit * whole(h, 6), unit * whole(h, 6)},
                    high[3] = {low[0] + unit * (1 + whole(h, 4)), low[1] + unit * (1 + whole(h, 4)),
                               low[2] + unit * (1 + whole(h, 4))};
        box(h, low, high);
    }
    h->scene->scale = 6 * unit;
}

/* All sorts, so small next to the scene that their squares underflow there. */
static void specks(scene_heap *h)
{
    const float far = power(h, 10, 40), size = far * power(h, -77, below(h, 2) ? -62 : -20);
    any_sphere(h, far, far * 0.1f);
    for (uint32_t i = 0; i < h->n; i++) {
        any_sphere(h, 8 * size, size * real(h, 0, 1));
        if (below(h, 3) == 0)
            any_capsule(h, 8 * size, size, size * real(h, 0, 1));
        if (below(h, 3) == 0)
            any_triangle(h, 8 * size, size);
    }
    h->scene->scale = 4 * size;
}

static const struct {
    const char *name;
    void (*make)(scene_heap *h);
    bool closed;
} families[] = {{"lattice capsules", lattice_capsules, false},
                {"any capsules", any_capsules, false},
                {"long and thin", long_thin, false},
                {"equal ends", equal_ends, false},
                {"no radius", no_radius, false},
                {"one end inside the other", end_inside, false},
                {"coaxial", coaxial, false},
                {"star", star, false},
                {"chain", chain, false},
                {"scales", scales, false},
                {"strays", strays, false},
                {"broken", broken, false},
                {"offsets", offsets, false},
                {"mixed", mixed, false},
                {"boxes", boxes, true},
                {"lattice bodies", lattice_bodies, true},
                {"tetrahedra", tetrahedra, true},
                {"dense", dense, false},
                {"balls and sticks", balls_and_sticks, false},
                {"all one", all_one, false},
                {"nearly equal ends", nearly_equal_ends, false},
                {"flat boxes", flat_boxes, true},
                {"spheres on boxes", spheres_on_boxes, true},
                {"specks", specks, false}};

static const char *family_name(uint32_t family) { return families[family].name; }

static void make(scene_heap *h, uint32_t family)
{
    h->scene->closed = families[family].closed;
    families[family].make(h);
}

const scene_group hard_scenes = {sizeof families / sizeof families[0], family_name, make};
