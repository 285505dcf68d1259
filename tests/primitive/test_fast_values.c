/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The values of precision FAST with one variant, against wide arithmetic: t, normals, u and v are within the bounds
 * that fast_spheres.h and fast_triangles.h derive; the bounds are tightened until they break, since one that never
 * breaks is too wide to be useful; and all bits are those that any other variant and machine finds. */
#include "support/oracle/truth.h"
#include "support/suite.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tightened.h"

#include <math.h>
#include <string.h>

#include "kernel/resolve/fast_spheres.h"
#include "kernel/resolve/fast_triangles.h"

#define U 0x1p-24

enum { SPHERE_T, SPHERE_T_EDGE, SPHERE_NORMAL, SPHERE_NORMAL_EDGE, TRIANGLE_T, TRIANGLE_UV, TRIANGLE_NORMAL, BOUNDS };

static const char *const bound_name[BOUNDS] = {"t of spheres",        "t of spheres at silhouettes",
                                               "normals of spheres",  "normals of spheres at silhouettes",
                                               "t of triangles",      "u and v",
                                               "normals of triangles"};

/* Values beyond a bound, at each step of tightening. */
static uint64_t beyond[BOUNDS][STEPS];

static void count_beyond(int which, double error, double bound)
{
    double scale = 1;
    for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678)
        beyond[which][step] += !(error <= bound * scale);
}

/* A sum of bits that any order of operations but the canonical one would change. */
static void add_bits(uint64_t *sum, float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    *sum = (*sum ^ bits) * 0x100000001b3u;
}

static truth_real dot(const truth_real a[3], const truth_real b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const truth_real a[3], const truth_real b[3], truth_real c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double length_of(const truth_real a[3]) { return sqrt((double)dot(a, a)); }

/* From 2^low on, below 2^high, evenly over the orders of magnitude: without functions that differ between machines. */
static float magnitude(test_random *r, int low, int high)
{
    const int exponent = low + (int)random_below(r, (uint32_t)(high - low)); /* in this order with any compiler */
    return ldexpf(random_float(r, 1, 2), exponent);
}

static void random_unit(test_random *r, double d[3])
{
    double dd;
    do {
        dd = 0;
        for (int a = 0; a < 3; a++) {
            d[a] = random_float(r, -1, 1);
            dd += d[a] * d[a];
        }
    } while (dd > 1 || dd < 0.01);
    for (int a = 0; a < 3; a++)
        d[a] /= sqrt(dd);
}

/* ---- spheres ---- */

/* Rays and what they meet, one in each lane. */
typedef struct lanes {
    _Alignas(CGT_VECTOR_BYTES) float org[3][CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) float dir[3][CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) float data[9][CGT_LANES];
} lanes;

/* A ray at a sphere; one in two near its silhouette. */
static void aim_at_sphere(test_random *r, lanes *l, int k)
{
    double d[3], side[3], along = 0, ss = 0;
    const float radius = magnitude(r, -10, 7), ratio = 1 + magnitude(r, -6, 12);
    const double edge = random_below(r, 2) ? 1 - (double)magnitude(r, -26, -3) : (double)random_float(r, 0, 1);
    random_unit(r, d);
    random_unit(r, side);
    for (int a = 0; a < 3; a++)
        along += side[a] * d[a];
    for (int a = 0; a < 3; a++) {
        side[a] -= along * d[a];
        ss += side[a] * side[a];
    }
    const float length = magnitude(r, -7, 7);
    for (int a = 0; a < 3; a++) {
        l->org[a][k] = random_float(r, -1, 1) * radius * ratio;
        l->dir[a][k] = (float)(d[a] * (double)length);
        l->data[a][k] =
            (float)((double)l->org[a][k] + d[a] * (double)radius * sqrt((double)ratio * (double)ratio - edge * edge) +
                    side[a] / sqrt(ss) * edge * (double)radius);
    }
    l->data[3][k] = radius;
}

/* Judges lane k. Returns whether the ray hits. */
static bool judge_sphere(const lanes *l, int k, float t, const float n[3])
{
    truth_real c[3], d[3], x[3], exact[3];
    const truth_real r = l->data[3][k];
    for (int a = 0; a < 3; a++) {
        c[a] = (truth_real)l->data[a][k] - l->org[a][k];
        d[a] = l->dir[a][k];
    }
    cross(c, d, x);
    const truth_real dd = dot(d, d), disc = r * r * dd - dot(x, x);
    if (!((double)disc > 1e-12 * (double)(r * r * dd)))
        return false;
    const double size = length_of(d), far = length_of(c), radius = (double)r, h = sqrt((double)disc) / size;
    const truth_real near = (dot(c, c) - r * r) / (dot(c, d) + (truth_real)sqrt((double)disc));
    const double error = fabs((double)(t - near)) * size;
    count_beyond(SPHERE_T, error, 0x1p-19 * far * radius / h);
    count_beyond(SPHERE_T_EDGE, error, 0x1p-9 * sqrt(radius * far));
    for (int a = 0; a < 3; a++)
        exact[a] = (near * d[a] - c[a]) / r - n[a];
    count_beyond(SPHERE_NORMAL, length_of(exact), 0x1p-18 * far / h);
    count_beyond(SPHERE_NORMAL_EDGE, length_of(exact), 0x1p-9 * sqrt(far / radius));
    return true;
}

static uint64_t trace_spheres(test_random *r, uint32_t *hits, uint64_t *sum)
{
    lanes l;
    uint64_t covered_lanes = 0;
    vfloat org[3], dir[3], sphere[4], t, n[3];
    for (int k = 0; k < CGT_LANES; k++)
        aim_at_sphere(r, &l, k);
    for (int a = 0; a < 4; a++) {
        sphere[a] = spux_load(l.data[a]);
        org[a % 3] = spux_load(l.org[a % 3]);
        dir[a % 3] = spux_load(l.dir[a % 3]);
    }
    const fast_sphere s = fast_sphere_prepare(org, sphere);
    const vmask covered =
        fast_sphere_resolve(&s, dir, fast_inverse_square(dir), spux_vfloat(0), spux_vfloat(INFINITY), true, &t, n);
    for (int k = 0; k < CGT_LANES; k++) {
        const float normal[3] = {n[0][k], n[1][k], n[2][k]};
        if (!(spux_mask_bits(covered) >> k & 1))
            continue;
        covered_lanes++;
        *hits += judge_sphere(&l, k, t[k], normal);
        add_bits(sum, t[k]);
        for (int a = 0; a < 3; a++)
            add_bits(sum, normal[a]);
    }
    return covered_lanes;
}

/* ---- triangles ---- */

/* A triangle of any size, shape and distance, and a ray at it. */
static void aim_at_triangle(test_random *r, lanes *l, int k)
{
    double e[2][3], eye[3], point[3], share[2];
    const double size = (double)magnitude(r, -10, 10), far = size * (double)magnitude(r, -3, 13);
    random_unit(r, e[0]);
    random_unit(r, e[1]);
    random_unit(r, eye);
    share[0] = (double)random_float(r, 0, 1);
    share[1] = (1 - share[0]) * (double)random_float(r, 0, 1);
    const double needle = random_below(r, 2) ? 1 : (double)magnitude(r, -10, 0);
    const float length = magnitude(r, -7, 7);
    for (int a = 0; a < 3; a++) {
        const float v0 = random_float(r, -1, 1) * (float)size;
        l->data[a][k] = v0;
        l->data[3 + a][k] = v0 + (float)(e[0][a] * size);
        l->data[6 + a][k] = v0 + (float)(e[1][a] * size * needle);
        point[a] = (double)v0;
        for (int i = 0; i < 2; i++)
            point[a] += share[i] * ((double)l->data[3 * i + 3 + a][k] - (double)v0);
        l->org[a][k] = (float)(point[a] + eye[a] * far);
        l->dir[a][k] = (float)((point[a] - (double)l->org[a][k]) / far) * length;
    }
}

static double largest_of(const truth_real a[3])
{
    return fmax(fabs((double)a[0]), fmax(fabs((double)a[1]), fabs((double)a[2])));
}

static double sum_of(const truth_real a[3]) { return fabs((double)a[0]) + fabs((double)a[1]) + fabs((double)a[2]); }

static bool judge_triangle(const lanes *l, int k, const resolved_triangles *h)
{
    truth_real s[3], e[2][3], d[3], n[3], x[3], y[3], off[3];
    double reach = 0;
    for (int a = 0; a < 3; a++) {
        s[a] = (truth_real)l->data[a][k] - l->org[a][k];
        d[a] = l->dir[a][k];
        for (int i = 0; i < 2; i++)
            e[i][a] = (truth_real)l->data[3 * i + 3 + a][k] - l->data[a][k];
        for (int i = 0; i < 3; i++)
            reach = fmax(reach, fabs((double)l->data[3 * i + a][k] - (double)l->org[a][k]));
    }
    cross(e[0], e[1], n);
    cross(e[1], s, x);
    cross(s, e[0], y);
    const truth_real den = dot(n, d), t = dot(n, s) / den, u = dot(x, d) / den, v = dot(y, d) / den;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0))
        return false;
    const double edges = sum_of(e[0]) * sum_of(e[1]), size = largest_of(d);
    const double sides = 2 * largest_of(s) * fmax(sum_of(e[0]), sum_of(e[1])), part = size / fabs((double)den);
    count_beyond(TRIANGLE_T, fabs((double)(h->t[k] - t)) * size, U * reach * (15.5 * edges * part + 2.5));
    count_beyond(TRIANGLE_UV, fmax(fabs((double)(h->u[k] - u)), fabs((double)(h->v[k] - v))),
                 U * (7.5 * (sides + edges) * part + 2.5));
    const double unit = length_of(n);
    for (int a = 0; a < 3; a++)
        off[a] = n[a] / (truth_real)unit - h->normal[a][k];
    count_beyond(TRIANGLE_NORMAL, length_of(off), U * (4.2 * edges / unit + 5));
    assert_true(fabs((double)(h->t[k] - t)) * size <= 0x1p-12 * reach && fabs((double)(h->u[k] - u)) <= 0x1p-7 &&
                fabs((double)(h->v[k] - v)) <= 0x1p-7 && length_of(off) <= 0x1p-13);
    return true;
}

static uint64_t trace_triangles(test_random *r, uint32_t *hits, uint64_t *sum)
{
    const uint32_t fields = CGT_FIELD_T | CGT_FIELD_UV | CGT_FIELD_NORMAL;
    lanes l;
    uint64_t covered_lanes = 0;
    vfloat org[3], dir[3], vertex[3][3];
    resolved_triangles h;
    for (int k = 0; k < CGT_LANES; k++)
        aim_at_triangle(r, &l, k);
    for (int a = 0; a < 3; a++) {
        org[a] = spux_load(l.org[a]);
        dir[a] = spux_load(l.dir[a]);
        for (int i = 0; i < 3; i++)
            vertex[i][a] = spux_load(l.data[3 * i + a]);
    }
    const fast_triangle q = fast_triangle_prepare(org, vertex);
    const vmask covered = fast_triangle_resolve(&q, dir, spux_vfloat(0), spux_vfloat(INFINITY), fields, &h);
    for (int k = 0; k < CGT_LANES; k++) {
        if (!(spux_mask_bits(covered) >> k & 1))
            continue;
        covered_lanes++;
        *hits += judge_triangle(&l, k, &h);
        add_bits(sum, h.t[k]);
        add_bits(sum, h.u[k]);
        add_bits(sum, h.v[k]);
        for (int a = 0; a < 3; a++)
            add_bits(sum, h.normal[a][k]);
    }
    return covered_lanes;
}

/* ---- tests ---- */

#define RAYS 65536u /* a multiple of the lanes of any variant: all see the same rays */
#define RAYS_OF_SUM 8192u
#define SUM_OF_BITS 0xdee06edf301f2a21u

typedef struct totals {
    uint64_t covered[2], sum; /* of spheres and triangles */
    uint32_t hits[2];
} totals;

static totals trace_both(uint32_t rays)
{
    test_random r = random_make(31);
    totals sum = {.sum = 0xcbf29ce484222325u};
    for (uint32_t i = 0; i < rays; i += CGT_LANES)
        sum.covered[0] += trace_spheres(&r, &sum.hits[0], &sum.sum);
    for (uint32_t i = 0; i < rays; i += CGT_LANES)
        sum.covered[1] += trace_triangles(&r, &sum.hits[1], &sum.sum);
    return sum;
}

TEST(values_are_within_bounds)
{
    memset(beyond, 0, sizeof beyond);
    const totals sum = trace_both(RAYS);
    print_message("of %u rays each, %llu at spheres and %llu at triangles are covered\n", RAYS,
                  (unsigned long long)sum.covered[0], (unsigned long long)sum.covered[1]);
    assert_true(sum.hits[0] > RAYS / 2 && sum.hits[1] > RAYS / 2);
    for (int which = 0; which < BOUNDS; which++)
        check_break(bound_name[which], beyond[which], sizeof beyond[which][0], 0, 0.02);
}

/* Where bounds do not hold, no lane is covered: too far, too near, inside, behind, before t_min, and odd magnitudes. */
TEST(other_spheres_are_left)
{
    static const struct {
        float sphere[4], dir[3], t_min;
        bool covered;
    } rows[] = {{{0, 0, 4, 1}, {0, 0, 1}, 0, true},
                {{0, 0, 4, 1}, {0, 0, 1}, 3, false},
                {{0, 0, 4, 1}, {0, 0, 1}, 2.5f, true},
                {{0, 0, 4, 1}, {0, 0, 1}, -9, true},
                {{0, 0, -4, 1}, {0, 0, 1}, -9, false},
                {{0, 0, 0.5f, 1}, {0, 0, 1}, 0, false},
                {{0, 0, 1.001f, 1}, {0, 0, 1}, 0, false},
                {{0, 0, 5000, 1}, {0, 0, 1}, 0, false},
                {{0, 0, 4, 0}, {0, 0, 1}, 0, false},
                {{0, 0, 0x1p-60f, 0x1p-62f}, {0, 0, 1}, 0, false},
                {{0, 0, 0x1p60f, 0x1p58f}, {0, 0, 1}, 0, false},
                {{0, 0, 4, 1}, {0, 0, 0x1p30f}, 0, false},
                {{0, 0, 4, 1}, {0, 0, 0x1p-30f}, 0, false},
                {{0, 0, 4, 1}, {0, 0, 0x1p15f}, 0, true}};
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        const vfloat zero = spux_vfloat(0), org[3] = {zero, zero, zero};
        vfloat sphere[4], dir[3], t, n[3];
        for (int a = 0; a < 4; a++)
            sphere[a] = spux_vfloat(rows[i].sphere[a]);
        for (int a = 0; a < 3; a++)
            dir[a] = spux_vfloat(rows[i].dir[a]);
        const fast_sphere s = fast_sphere_prepare(org, sphere);
        const vmask covered = fast_sphere_resolve(&s, dir, fast_inverse_square(dir), spux_vfloat(rows[i].t_min),
                                                  spux_vfloat(INFINITY), true, &t, n);
        if (spux_any(covered) != rows[i].covered)
            fail_msg("row %zu: covered %d", i, spux_any(covered));
    }
}

/* The sum was computed once, by the portable variant; the rays of any other seed have another one. It is the
 * last, for it sets the seed. */
TEST(bits_are_those_of_any_machine)
{
    random_seed(RANDOM_DEFAULT_SEED);
    const totals sum = trace_both(RAYS_OF_SUM);
    if (sum.sum != SUM_OF_BITS)
        fail_msg("the bits sum up to %#llx", (unsigned long long)sum.sum);
}

VARIANT_SUITE("test_fast_values", NULL, NULL)
