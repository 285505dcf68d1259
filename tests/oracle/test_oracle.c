/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact oracle where the answer is known: tangents, edges, vertices, ties, the ends of the range and of float. */
#include "support/test.h"

#include <float.h>
#include <math.h>

#include "support/oracle/oracle.h"

#include "oracle/oracle_input.h"

static oracle_primitive scaled(oracle_primitive p, int k)
{
    for (int i = 0; i < 9; i++)
        p.data[i] = ldexpf(p.data[i], k);
    return p;
}

/* ---- answers ---- */

/* The exact t as a double; NaN for none. */
static double t_of(oracle_primitive p, truth_ray ray)
{
    oracle_hit hit;
    return oracle_hits(&p, &ray, &hit) ? (double)hit.t : (double)NAN;
}

static bool misses(oracle_primitive p, truth_ray ray) { return !is_hit(p, ray); }

static bool in_range(oracle_primitive p, truth_ray ray, float t_min, float t_max)
{
    ray.t_min = t_min;
    ray.t_max = t_max;
    return is_hit(p, ray);
}

static uint32_t nearest_of_two(oracle_primitive a, oracle_primitive b, truth_ray ray)
{
    const oracle_primitive both[2] = {a, b};
    return oracle_trace(&(oracle_scene){.primitive = both, .count = 2}, &ray).index;
}

/* ---- spheres ---- */

static void sphere_in_closed_form(void **state)
{
    (void)state;
    const truth_ray ray = ray_of(0, 0, -10, 0, 0, 2);
    for (int k = -140; k <= 100; k += 20) {
        const oracle_primitive s = scaled(sphere_of(0, 0, 0, 0, 5), k);
        const float one = ldexpf(1, k);
        oracle_hit hit;
        assert_true(oracle_hits(&s, &(truth_ray){{0, 0, -10 * one}, {0, 0, 2 * one}, 0, INFINITY}, &hit));
        assert_true(hit.t == 2.5 && !hit.far && hit.uv[0] == 0 && hit.uv[1] == 0);
        assert_true(hit.normal[0] == 0 && hit.normal[1] == 0 && hit.normal[2] == -1);
        assert_true(oracle_hits(&s, &(truth_ray){{0, 0, -10 * one}, {0, 0, 2 * one}, 3, INFINITY}, &hit));
        assert_true(hit.t == 7.5 && hit.far && hit.normal[2] == 1);
        assert_true(t_of(s, (truth_ray){{0, 0, 0}, {0, one, 0}, 0, INFINITY}) == 5);
        assert_true(t_of(s, (truth_ray){{3 * one, 4 * one, 0}, {one, 7 * one, one}, 0, INFINITY}) == 0);
        assert_true(t_of(s, (truth_ray){{3 * one, 4 * one, 0}, {0, -one, 0}, 0, INFINITY}) == 0);
        assert_true(misses(s, (truth_ray){{0, 0, 6 * one}, {0, 0, one}, 0, INFINITY}));
        assert_true(t_of(s, (truth_ray){{0, 0, 6 * one}, {0, 0, one}, -3, INFINITY}) == -1);
    }
    oracle_hit hit;
    const oracle_primitive off = sphere_of(0, 1, 0, 8, 1.5f);
    assert_true(oracle_hits(&off, &(truth_ray){{0, 0, 0}, {0, 0, 1}, 0, INFINITY}, &hit));
    const truth_real error = hit.t - (8 - truth_square_root(1.25));
    assert_true(fabs((double)error) < 0x1p-49 && (sizeof error < 16 || fabs((double)error) < 0x1p-96));
    assert_true(ray.t_min == 0 && t_of(sphere_of(0, 0, 0, 0, 5), ray) == 2.5);
}

static void tangent_spheres(void **state)
{
    (void)state;
    for (int k = -120; k <= 100; k += 4) {
        const float one = ldexpf(1, k), above = nextafterf(one, INFINITY), below = nextafterf(one, 0);
        for (int axis = 0; axis < 3; axis++) {
            truth_ray ray = {.t_min = 0, .t_max = INFINITY};
            float center[3];
            ray.dir[axis] = 1;
            center[axis] = 8 * one;
            center[(axis + 1) % 3] = one;
            center[(axis + 2) % 3] = 0;
            oracle_hit hit;
            const oracle_primitive s = sphere_of(0, center[0], center[1], center[2], one);
            assert_true(oracle_hits(&s, &ray, &hit) && hit.t == 8 * one && !hit.far);
            assert_true(hit.normal[(axis + 1) % 3] == -1);
            assert_true(misses(sphere_of(0, center[0], center[1], center[2], below), ray));
            assert_true(t_of(sphere_of(0, center[0], center[1], center[2], above), ray) < 8 * one);
        }
    }
    /* 3-4-5: a slanted line that touches the sphere of radius 5 around the origin at (3, 4, 0) */
    const truth_ray slanted = ray_of(3 + 8, 4 - 6, 0, -4, 3, 0);
    assert_true(t_of(sphere_of(0, 0, 0, 0, 5), slanted) == 2);
    assert_true(misses(sphere_of(0, 0, 0, 0, nextafterf(5, 0)), slanted));
    assert_true(misses(sphere_of(0, -0x1p-149f, 0, 0, 5), slanted));
    assert_true(is_hit(sphere_of(0, 0x1p-149f, 0, 0, 5), slanted));
}

/* Input on both sides of the smallest normal float. */
static void denormal_spheres(void **state)
{
    (void)state;
    const float unit = 0x1p-126f;
    const oracle_primitive s = sphere_of(0, 1.5f * unit, 0, 0, 0.875f * unit);
    assert_true(is_hit(s, ray_of(0.875f * unit, 0, -2 * unit, 0, 0, 1)));
    assert_true(is_hit(s, ray_of(0.625f * unit, 0, -2 * unit, 0, 0, 1)));
    assert_true(misses(s, ray_of(0.625f * unit - 0x1p-149f, 0, -2 * unit, 0, 0, 1)));
}

static void points(void **state)
{
    (void)state;
    const oracle_primitive point = sphere_of(0, 3, -2, 7, 0);
    oracle_hit hit;
    assert_true(oracle_hits(&point, &(truth_ray){{0, 0, 0}, {3, -2, 7}, 0, INFINITY}, &hit) && hit.t == 1);
    assert_true(fabs((double)hit.normal[2] + 7 / sqrt(62)) < 1e-15);
    assert_true(t_of(point, ray_of(3, -2, 7, 0, 1, 0)) == 0);
    assert_true(misses(point, ray_of(0x1p-149f, 0, 0, 3, -2, 7)));
    assert_true(misses(point, ray_of(0, 0, 0, 3, -2, nextafterf(7, 8))));
}

/* ---- triangles ---- */

static void triangle_in_closed_form(void **state)
{
    (void)state;
    const float v[3][3] = {{0, 0, 0}, {4, 0, 0}, {0, 8, 0}};
    for (int k = -140; k <= 100; k += 20) {
        const oracle_primitive p = scaled(triangle_of(0, v), k);
        const float one = ldexpf(1, k);
        for (float side = -1; side <= 1; side += 2) {
            const truth_ray ray = {{one, 2 * one, side * 3 * one}, {0, 0, -side * 2 * one}, 0, INFINITY};
            oracle_hit hit;
            assert_true(oracle_hits(&p, &ray, &hit));
            assert_true(hit.t == 1.5 && hit.uv[0] == 0.25 && hit.uv[1] == 0.25 && !hit.far);
            assert_true(hit.normal[0] == 0 && hit.normal[1] == 0 && hit.normal[2] == 1);
            assert_true(misses(p, (truth_ray){{one, 2 * one, side * one}, {0, 0, side * one}, 0, INFINITY}));
        }
        assert_true(t_of(p, (truth_ray){{one, one, 0}, {0, 0, one}, 0, INFINITY}) == 0); /* origin in the triangle */
        assert_true(misses(p, (truth_ray){{-one, one, 0}, {one, 0, 0}, 0, INFINITY}));   /* ray in its plane */
        assert_true(misses(p, (truth_ray){{-one, one, one}, {one, 0, 0}, 0, INFINITY})); /* ray parallel to its plane */
        assert_true(is_hit(p, (truth_ray){{-one, one, one}, {one, 0, -0.5f * one}, 0, INFINITY}));
    }
    /* as nearly parallel as float allows */
    assert_true(t_of(triangle_of(0, v), ray_of(-1, 1, 0x1p-149f, 1, 0, -0x1p-149f)) == 1);
    assert_true(
        misses(triangle_of(0, v), ray_of(-1, 1, 0x1p-149f, 1, 0, -0x1p-148f))); /* crosses the plane before the edge */
}

/* Edges and vertices belong to the triangle; a point off by the smallest float does not. */
static void edges_and_vertices(void **state)
{
    (void)state;
    static const float v[3][3] = {{1, 0, 5}, {7, 2, 3}, {3, 8, 9}};
    const float tiny = 0x1p-149f, middle[2] = {3.5f, 3.5f};
    const oracle_primitive p = triangle_of(0, v);
    for (int i = 0; i < 3; i++) {
        const float *a = v[i], *b = v[(i + 1) % 3];
        for (int step = 0; step < 8; step++) { /* eighths of an edge are exact */
            const float k = (float)step / 8, x = a[0] + k * (b[0] - a[0]), y = a[1] + k * (b[1] - a[1]);
            const float z = a[2] + k * (b[2] - a[2]);
            oracle_hit hit;
            truth_ray ray = ray_of(x, y, -1, 0, 0, 0.5f);
            assert_true(oracle_hits(&p, &ray, &hit) && hit.t == 2 * (z + 1));
            const truth_real weight[3] = {1 - hit.uv[0] - hit.uv[1], hit.uv[0], hit.uv[1]};
            assert_true(fabs((double)(weight[i] - (1 - k))) < 0x1p-50 && weight[(i + 2) % 3] == 0);
            ray.dir[0] = x < middle[0] ? -tiny : tiny; /* leans outwards by a tiny amount */
            ray.dir[1] = y < middle[1] ? -tiny : tiny;
            assert_true(misses(p, ray));
        }
    }
    for (int i = 0; i < 3; i++) /* from the origin exactly through a vertex, and just outside of it */
        assert_true(t_of(p, ray_of(0, 0, 0, v[i][0], v[i][1], v[i][2])) == 1);
    assert_true(misses(p, ray_of(0, 0, 0, 1, -tiny, 5)));
    assert_true(misses(p, ray_of(0, 0, 0, nextafterf(7, 8), 2, 3)));
    assert_true(misses(p, ray_of(0, 0, 0, 3, nextafterf(8, 9), 9)));
}

static void what_takes_no_part(void **state)
{
    (void)state;
    const float line[3][3] = {{-1, -1, 2}, {0, 0, 2}, {3, 3, 2}}, dot[3][3] = {{0, 0, 2}, {0, 0, 2}, {0, 0, 2}};
    const truth_ray ray = ray_of(0, 0, 0, 0, 0, 1);
    const oracle_primitive good = plane_at(0, 2);
    const float bad[] = {NAN, INFINITY, -INFINITY};
    assert_true(misses(triangle_of(0, line), ray) && misses(triangle_of(0, dot), ray));
    assert_true(misses(sphere_of(0, 0, 0, 2, -0x1p-149f), ray) && is_hit(sphere_of(0, 0, 0, 2, -0.0f), ray));
    assert_true(is_hit(good, ray));
    for (size_t i = 0; i < TEST_COUNT(bad); i++) {
        for (int k = 0; k < 9; k++) {
            oracle_primitive p = good;
            p.data[k] = bad[i];
            assert_true(misses(p, ray));
        }
        for (int k = 0; k < 4; k++) {
            oracle_primitive p = sphere_of(0, 0, 0, 2, 1);
            assert_true(is_hit(p, ray));
            p.data[k] = bad[i];
            assert_true(misses(p, ray));
        }
        for (int a = 0; a < 3; a++) {
            truth_ray other = ray;
            other.org[a] = bad[i];
            assert_true(misses(good, other));
            other = ray;
            other.dir[a] = bad[i];
            assert_true(misses(good, other));
        }
    }
    assert_true(misses(good, ray_of(0, 0, 0, 0, -0.0f, 0)));
    assert_true(!in_range(good, ray, NAN, INFINITY) && !in_range(good, ray, 0, NAN));
    assert_true(!in_range(good, ray, 3, 1) && !in_range(good, ray, 2, 1) && in_range(good, ray, 2, 2));
    assert_true(!in_range(good, ray, INFINITY, INFINITY) && !in_range(good, ray, -INFINITY, -INFINITY));
    assert_true(in_range(good, ray, -INFINITY, INFINITY));
}

/* ---- order ---- */

static void ties_go_to_the_lowest_ids(void **state)
{
    (void)state;
    const truth_ray ray = ray_of(0, 0, 0, 0, 0, 1);
    const oracle_primitive pairs[][2] = {
        {plane_at(1, 7), plane_at(2, 7)},
        {sphere_of(1, 0, 0, 8, 1), plane_at(2, 7)},
        {plane_at(1, 7), sphere_of(2, 0, 0, 9, 2)},
        {sphere_of(1, 0, 0, 8, 1), sphere_of(2, 0, 0, 9, 2)},
        {sphere_of(1, 1, 0, 8, 1), plane_at(2, 8)},                 /* tangent */
        {sphere_of(1, 1, 0, 8, 1.5f), sphere_of(2, 0, 1, 8, 1.5f)}, /* 8 - sqrt(1.25) */
        {sphere_of(1, -1, 0, 8, 1.5f), sphere_of(2, 0.6f, -0.8f, 8, 1.5f)},
    };
    for (size_t i = 0; i < TEST_COUNT(pairs); i++) {
        const bool tie = i + 1 < TEST_COUNT(pairs); /* last: 0.6f and 0.8f are not exact, so it is farther */
        assert_int_equal(nearest_of_two(pairs[i][0], pairs[i][1], ray), 0);
        assert_int_equal(nearest_of_two(pairs[i][1], pairs[i][0], ray), 1);
        oracle_primitive renamed[2] = {pairs[i][0], pairs[i][1]};
        renamed[0].geometry = 3;
        assert_int_equal(nearest_of_two(renamed[0], renamed[1], ray), tie ? 1 : 0);
        renamed[0].geometry = renamed[1].geometry = 1; /* the primitive id decides */
        renamed[0].primitive = 5;
        renamed[1].primitive = 4;
        assert_int_equal(nearest_of_two(renamed[0], renamed[1], ray), tie ? 1 : 0);
    }
}

/* Planes at the two floats around sphere roots that are irrational: the order is that of the numbers, not of floats. */
static void near_ties(void **state)
{
    (void)state;
    const truth_ray ray = ray_of(0, 0, 0, 0, 0, 1);
    for (int k = 1; k < 40; k++) {
        const float x = (float)k / 32;
        const oracle_primitive s = sphere_of(0, x, 0, 8, 1.5f);
        const double root = 8 - sqrt(2.25 - (double)x * x);
        float before = (float)root, after = before;
        if (before > root)
            before = nextafterf(before, 0);
        else
            after = nextafterf(after, 9);
        if (before == root || after == root)
            continue;
        assert_int_equal(nearest_of_two(s, plane_at(1, before), ray), 1);
        assert_int_equal(nearest_of_two(s, plane_at(1, after), ray), 0);
        /* and spheres whose roots differ by about 2^-52 t */
        assert_int_equal(nearest_of_two(s, sphere_of(1, x, 0x1p-26f, 8, 1.5f), ray), 0);
        assert_int_equal(nearest_of_two(sphere_of(0, x, 0x1p-80f, 8, 1.5f), sphere_of(1, x, 0, 8, 1.5f), ray), 1);
    }
}

/* ---- the ends of the range ---- */

static void range_is_by_rounded_t(void **state)
{
    (void)state;
    const oracle_primitive p = plane_at(0, 0x1p24f), s = sphere_of(0, 0, 0, 0x1p24f + 2, 2);
    truth_ray ray = ray_of(0, 0, -1, 0, 0, 1); /* t = 2^24 + 1, which rounds to 2^24 */
    const float at = 0x1p24f, next = at + 2, before = at - 1, more = at + 4;
    assert_true(in_range(p, ray, 0, at) && !in_range(p, ray, 0, before));
    assert_true(in_range(p, ray, at, INFINITY) && !in_range(p, ray, next, INFINITY));
    assert_true(in_range(s, ray, at, at) && !in_range(s, ray, before, before) && !in_range(s, ray, next, next));
    ray.org[2] = -3; /* t = 2^24 + 3, which rounds to 2^24 + 4 */
    assert_true(in_range(p, ray, more, more) && !in_range(p, ray, 0, next));
    assert_true(in_range(s, ray, more, more) && !in_range(s, ray, 0, next));
    ray.org[0] = 0x1p-60f; /* the sphere is now farther by a tiny amount, and t still rounds up */
    ray.org[2] = -1;
    assert_true(in_range(s, ray, next, next) && !in_range(s, ray, 0, at));
    /* below a power of two floats are twice as close */
    const oracle_primitive one = plane_at(0, 1);
    assert_true(in_range(one, ray_of(0, 0, 0x1p-25f, 0, 0, 1), 1, 1));
    assert_true(!in_range(one, ray_of(0, 0, 0x1.0002p-25f, 0, 0, 1), 1, 1));
    assert_true(in_range(one, ray_of(0, 0, 0x1.0002p-25f, 0, 0, 1), 0, nextafterf(1, 0)));
    ray.dir[2] = -1;
    assert_true(in_range(p, (truth_ray){{0, 0, -1}, {0, 0, -1}, 0, 0}, -at, -at));
    assert_true(!in_range(p, ray, -INFINITY, -next) && in_range(p, ray, -INFINITY, -at));
}

static void range_ends_at_float(void **state)
{
    (void)state;
    const oracle_primitive far = plane_at(0, FLT_MAX), here = plane_at(0, 0);
    assert_true(is_hit(far, ray_of(0, 0, 0, 0, 0, 1)));
    assert_true(misses(far, ray_of(0, 0, -0x1p103f, 0, 0, 1))); /* t = 2^128 - 2^103 rounds to infinity */
    assert_true(is_hit(far, ray_of(0, 0, -nextafterf(0x1p103f, 0), 0, 0, 1)));
    assert_true(misses(far, ray_of(0, 0, 0, 0, 0, 0.5f)));
    assert_true(in_range(far, ray_of(0, 0, 0, 0, 0, -1), -INFINITY, 0));
    assert_true(!in_range(far, ray_of(0, 0, -0x1p103f, 0, 0, -1), -INFINITY, 0));
    const oracle_primitive around = sphere_of(0, 0, 0, 0, FLT_MAX);
    assert_true(in_range(around, ray_of(0, 0, 0, 1, 0, 0), -INFINITY, INFINITY));
    assert_true(!in_range(around, ray_of(0, 0, 0, 0.5f, 0, 0), -INFINITY, INFINITY));
    /* t = 2^-150 rounds to 0, and so does its negative */
    assert_true(in_range(here, ray_of(0, 0, -0x1p-149f, 0, 0, 2), 0, 0));
    assert_true(in_range(here, ray_of(0, 0, -0x1p-149f, 0, 0, -2), 0, 0));
    assert_true(!in_range(here, ray_of(0, 0, -0x1p-149f, 0, 0, 2), 0x1p-149f, 1));
    assert_true(in_range(here, ray_of(0, 0, -0x1p-149f, 0, 0, 1.5f), 0x1p-149f, 1));
    assert_true(misses(here, ray_of(0, 0, -0x1p-149f, 0, 0, -1)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_in_closed_form),
        cmocka_unit_test(tangent_spheres),
        cmocka_unit_test(denormal_spheres),
        cmocka_unit_test(points),
        cmocka_unit_test(triangle_in_closed_form),
        cmocka_unit_test(edges_and_vertices),
        cmocka_unit_test(what_takes_no_part),
        cmocka_unit_test(ties_go_to_the_lowest_ids),
        cmocka_unit_test(near_ties),
        cmocka_unit_test(range_is_by_rounded_t),
        cmocka_unit_test(range_ends_at_float),
    };
    test_begin("test_oracle");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
