/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact oracle: laws of its arithmetic, textbook formulas in binary128, the same answers with and without its
 * filter, and answers that are known: tangents, edges, ties, the ends of the range and of float. */
#include "support/test.h"
#include "support/suite.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "support/oracle/oracle.h"
#include "support/oracle/oracle_line.h"

/* ---- input ---- */

static oracle_primitive sphere_of(uint32_t geometry, float x, float y, float z, float r)
{
    return (oracle_primitive){ORACLE_SPHERE, geometry, 0, {x, y, z, r}};
}

static oracle_primitive triangle_of(uint32_t geometry, const float (*v)[3])
{
    oracle_primitive p = {.kind = ORACLE_TRIANGLE, .geometry = geometry};
    memcpy(p.data, v, sizeof p.data);
    return p;
}

/* A right-angled triangle at height z that surrounds the z axis. */
static oracle_primitive plane_at(uint32_t geometry, float z)
{
    const float v[3][3] = {{-4, -4, z}, {12, -4, z}, {-4, 12, z}};
    return triangle_of(geometry, v);
}

static truth_ray ray_of(float ox, float oy, float oz, float dx, float dy, float dz)
{
    return (truth_ray){{ox, oy, oz}, {dx, dy, dz}, 0, INFINITY};
}

static bool is_hit(oracle_primitive p, truth_ray ray)
{
    oracle_hit hit;
    return oracle_hits(&p, &ray, &hit);
}

/* The exact t as a double; NaN for none. */
static double t_of(oracle_primitive p, truth_ray ray)
{
    oracle_hit hit;
    return oracle_hits(&p, &ray, &hit) ? (double)hit.t : (double)NAN;
}

static bool in_range(oracle_primitive p, truth_ray ray, float t_min, float t_max)
{
    ray.t_min = t_min;
    ray.t_max = t_max;
    return is_hit(p, ray);
}

static float any_finite(test_random *r)
{
    float f;
    do
        f = random_any_float(r);
    while (!isfinite(f));
    return f;
}

/* A point about `reach` around `middle`. */
static void random_point(test_random *r, float middle, float reach, float p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = middle + random_float(r, -reach, reach);
}

/* Towards a triangle's vertex, edge, inside or outside; towards the inside or the outline of a sphere. */
static truth_ray random_ray(test_random *r, float middle, float reach, const oracle_primitive *p)
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    float v[3][3], d[3];
    memcpy(v, p->data, sizeof v);
    for (int i = 1; i < 3 && p->kind == ORACLE_SPHERE; i++) {
        random_direction(r, d);
        for (int a = 0; a < 3; a++)
            v[i][a] = v[0][a] + p->data[3] * d[a];
    }
    const uint32_t kind = random_below(r, 4);
    const double k = kind == 0 ? 0 : random_float(r, -0.2f, 1.2f), m = kind <= 2 ? 0 : random_float(r, -0.2f, 1.2f);
    random_point(r, middle, reach, ray.org);
    for (int a = 0; a < 3; a++)
        ray.dir[a] = (float)(v[0][a] + k * ((double)v[1][a] - v[0][a]) + m * ((double)v[2][a] - v[0][a]) - ray.org[a]);
    return ray;
}

/* ---- arithmetic ---- */

static bool is_equal(const dyadic *a, const dyadic *b) { return dyadic_sub(a, b).sign == 0; }

/* Laws that hold for exact numbers only, on products of one to five floats; small numbers against the compiler's. */
TEST(arithmetic_is_exact)
{
    test_random r = random_make(1);
    for (uint32_t round = 0; round < test_scaled(3000); round++) {
        dyadic x[3];
        for (int i = 0; i < 3; i++) {
            x[i] = dyadic_of_float(any_finite(&r));
            for (uint32_t more = random_below(&r, 5); more > 0; more--) {
                const dyadic f = dyadic_of_float(any_finite(&r)), g = dyadic_of_float(random_float(&r, -2, 2));
                const dyadic product = dyadic_mul(&x[i], &f);
                x[i] = more == 1 ? dyadic_add(&product, &g) : product;
            }
        }
        const dyadic sum = dyadic_add(&x[0], &x[1]), difference = dyadic_sub(&x[0], &x[1]);
        const dyadic back = dyadic_sub(&sum, &x[1]);
        assert_true(is_equal(&back, &x[0]));
        const dyadic squares = dyadic_mul(&sum, &difference), aa = dyadic_mul(&x[0], &x[0]);
        const dyadic bb = dyadic_mul(&x[1], &x[1]), expected = dyadic_sub(&aa, &bb);
        assert_true(is_equal(&squares, &expected));
        const dyadic whole = dyadic_mul(&sum, &x[2]), left = dyadic_mul(&x[0], &x[2]);
        const dyadic right = dyadic_mul(&x[2], &x[1]), parts = dyadic_add(&right, &left);
        assert_true(is_equal(&whole, &parts));
        assert_true(squares.count <= DYADIC_LIMBS && (sum.sign == 0 || sum.limb[0] != 0));

        const int32_t m = (int32_t)(random_bits(&r) >> 34) - (1 << 29),
                      n = (int32_t)(random_bits(&r) >> 40) - (1 << 23);
        const int at = (int)random_below(&r, 300) - 150;
        const dyadic y = dyadic_make(m, at), z = dyadic_make(n, at), up = dyadic_make(n, -at);
        const dyadic product = dyadic_mul(&y, &up), total = dyadic_add(&y, &z), rest = dyadic_sub(&y, &z);
        assert_true(dyadic_real(&product) == (truth_real)((int64_t)m * n));
        assert_true(dyadic_real(&total) == (truth_real)ldexp((double)m + n, at));
        assert_true(dyadic_real(&rest) == (truth_real)ldexp((double)m - n, at) && rest.sign == (m > n) - (m < n));
        const float f = any_finite(&r);
        const dyadic value = dyadic_of_float(f);
        assert_true(dyadic_real(&value) == (truth_real)f);
    }
}

/* Shifts of the judge's lines go far below any float. */
TEST(powers_of_any_size)
{
    static const int exponents[] = {-5000, -4097, -4096, -4095, -1025, -1024, -33, -32, -31, 0, 1, 31, 32, 33, 4000};
    for (size_t i = 0; i < TEST_COUNT(exponents); i++) {
        const int e = exponents[i];
        const dyadic a = dyadic_make(-3, e), b = dyadic_make(5, 7 - e), product = dyadic_mul(&a, &b),
                     expected = dyadic_make(-15, 7), half = dyadic_make(-3, e - 1), twice = dyadic_add(&half, &half);
        assert_true(is_equal(&product, &expected));
        assert_true(is_equal(&twice, &a));
    }
}

/* ---- textbook formulas ---- */

static double absolute(truth_real a) { return fabs((double)a); }

/* Moeller and Trumbore's formulas; returns -1 for a miss, 1 for a hit, 0 where it is too close for rounded numbers. */
static int textbook_triangle(const truth_ray *ray, const float *v, truth_real tuv[3])
{
    truth_real e[3], f[3], s[3], det = 0, size = 0;
    for (int a = 0; a < 3; a++) {
        e[a] = (truth_real)v[3 + a] - v[a];
        f[a] = (truth_real)v[6 + a] - v[a];
        s[a] = (truth_real)ray->org[a] - v[a];
    }
    tuv[0] = tuv[1] = tuv[2] = 0;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const truth_real p = (truth_real)ray->dir[b] * f[c] - (truth_real)ray->dir[c] * f[b];
        const truth_real q = s[b] * e[c] - s[c] * e[b];
        det += e[a] * p;
        size += absolute(e[a]) * absolute(p);
        tuv[0] += f[a] * q;
        tuv[1] += s[a] * p;
        tuv[2] += ray->dir[a] * q;
    }
    if (absolute(det) < 0x1p-40 * (double)size)
        return 0;
    for (int i = 0; i < 3; i++)
        tuv[i] /= det;
    const double least = fmin(fmin((double)tuv[1], (double)tuv[2]), (double)(1 - tuv[1] - tuv[2]));
    return fabs(least) < 0x1p-30 || absolute(tuv[0]) < 0x1p-30 ? 0 : least > 0 && tuv[0] > 0 ? 1 : -1;
}

/* Likewise; tuv[1]: 1 for the far root. */
static int textbook_sphere(const truth_ray *ray, const float *sphere, truth_real tuv[3])
{
    const truth_roots roots = truth_sphere(ray->org, ray->dir, sphere);
    if (truth_in_doubt(&roots) || (roots.hit && fmin(absolute(roots.near), absolute(roots.far)) < 0x1p-30))
        return 0;
    tuv[1] = roots.near < 0;
    tuv[0] = roots.near < 0 ? roots.far : roots.near;
    return roots.hit && roots.far > 0 ? 1 : -1;
}

/* The hit's point, by t, is the triangle's point, by u and v, or the sphere's point, by the normal, of unit length. */
static void check_point(const oracle_primitive *p, const truth_ray *ray, const oracle_hit *hit, double size)
{
    const truth_real *n = hit->normal, u = hit->uv[0], v = hit->uv[1];
    for (int a = 0; a < 3; a++) {
        const float *x = p->data + a;
        const truth_real along = (truth_real)ray->org[a] + hit->t * ray->dir[a];
        const truth_real at =
            p->kind == ORACLE_SPHERE ? x[0] + n[a] * p->data[3] : (1 - u - v) * x[0] + u * x[3] + v * x[6];
        assert_true(absolute(along - at) < 0x1p-36 * size);
    }
    assert_true(absolute(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 0x1p-48);
}

TEST(hits_as_by_textbook)
{
    test_random r = random_make(3);
    uint32_t hits[2] = {0, 0}, misses[2] = {0, 0}, far = 0, rounds = 400 + test_scaled(20000);
    for (uint32_t round = 0; round < rounds; round++) {
        const float middle = random_float(&r, -10, 10), reach = random_log(&r, 1, 1e2f);
        const bool sphere = round % 2;
        oracle_primitive p = {.kind = sphere ? ORACLE_SPHERE : ORACLE_TRIANGLE};
        oracle_hit hit;
        truth_real tuv[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++)
            random_point(&r, middle, reach, p.data + 3 * i);
        p.data[3] = sphere ? random_log(&r, 1e-2f, 2) * reach : p.data[3];
        const truth_ray ray = random_ray(&r, middle, reach, &p);
        const int expected = sphere ? textbook_sphere(&ray, p.data, tuv) : textbook_triangle(&ray, p.data, tuv);
        if (expected == 0)
            continue;
        assert_int_equal(oracle_hits(&p, &ray, &hit), expected > 0);
        ++*(expected > 0 ? &hits[sphere] : &misses[sphere]);
        if (expected < 0)
            continue;
        assert_true(absolute(hit.t / tuv[0] - 1) < 0x1p-40);
        check_point(&p, &ray, &hit, fabs((double)middle) + 10 * (double)reach);
        if (sphere)
            assert_true(hit.far == (tuv[1] != 0));
        else
            assert_true(absolute(hit.uv[0] - tuv[1]) < 0x1p-40 && absolute(hit.uv[1] - tuv[2]) < 0x1p-40);
        far += hit.far;
    }
    print_message("%u and %u hits, %u of them far, %u and %u misses\n", hits[0], hits[1], far, misses[0], misses[1]);
    for (int i = 0; i < 2; i++)
        assert_true(hits[i] > rounds / 20 && misses[i] > rounds / 40);
    assert_true(far > rounds / 200);
}

/* ---- scenes ---- */

/* The closest hit by exact arithmetic, without the filter. */
static uint32_t nearest_unfiltered(const oracle_scene *scene, const truth_ray *ray)
{
    oracle_line line;
    oracle_root nearest, root;
    uint32_t best = ORACLE_NONE;
    const oracle_range range = oracle_range_make(ray->t_min, ray->t_max, 0);
    if (!oracle_line_make(ray, &line))
        return best;
    for (uint32_t i = 0; i < scene->count; i++) { /* ids ascend */
        if (oracle_first_root(&line, &scene->primitive[i], &range, &root) < 0 ||
            (best != ORACLE_NONE && oracle_compare(&root, &nearest) >= 0))
            continue;
        nearest = root;
        best = i;
    }
    return best;
}

/* Spheres and triangles in one place, many equal, a few invalid; more than fill a block. */
TEST(the_filter_changes_nothing)
{
    enum { MOST = 100 };
    test_random r = random_make(7);
    uint32_t hits = 0, rays = 0, rounds = 5 + test_scaled(40);
    for (uint32_t round = 0; round < rounds; round++) {
        const int k = (int)random_below(&r, 200) - 120;
        const float reach = ldexpf(1, k), middle = round % 3 ? 0 : ldexpf(random_float(&r, -1e4f, 1e4f), k);
        oracle_scene scene = {0};
        float sphere[MOST][4], vertex[3 * MOST][3];
        for (uint32_t i = 0; i < MOST; i++) {
            random_point(&r, middle, reach, sphere[i]);
            sphere[i][3] = random_log(&r, 1e-2f, 0.5f) * reach;
            if (i > 0 && random_below(&r, 4) == 0)
                memcpy(sphere[i], sphere[random_below(&r, i)], sizeof sphere[i]);
            if (random_below(&r, 30) == 0)
                sphere[i][random_below(&r, 4)] = random_below(&r, 2) ? NAN : -INFINITY;
            for (uint32_t j = 3 * i; j < 3 * i + 3; j++)
                random_point(&r, middle, reach, vertex[j]);
        }
        oracle_scene_add_spheres(&scene, 0, (const float(*)[4])sphere, MOST);
        oracle_scene_add_triangles(&scene, 1, (const float(*)[3])vertex, 3 * MOST, NULL, MOST);
        const oracle_scene bare = {.primitive = scene.primitive, .count = scene.count};
        for (int i = 0; i < 20; i++, rays++) {
            truth_ray ray = random_ray(&r, middle, reach, &scene.primitive[random_below(&r, scene.count)]);
            ray.t_min = i % 4 ? 0 : random_float(&r, -1, 1);
            ray.t_max = i % 8 ? INFINITY : ray.t_min + random_float(&r, 0, 1);
            const uint32_t expected = nearest_unfiltered(&scene, &ray);
            assert_int_equal(oracle_trace(&scene, &ray).index, expected);
            assert_int_equal(oracle_trace(&bare, &ray).index, expected);
            hits += expected != ORACLE_NONE;
        }
        oracle_scene_free(&scene);
    }
    assert_true(hits > rays / 4 && hits < rays);
}

/* ---- known answers ---- */

/* At any scale: hits in closed form, tangents that one ulp decides, edges and vertices that belong. */
TEST(known_hits)
{
    static const float flat[3][3] = {{0, 0, 0}, {4, 0, 0}, {0, 8, 0}};
    for (int k = -120; k <= 100; k += 20) {
        const float one = ldexpf(1, k), above = nextafterf(one, INFINITY), below = nextafterf(one, 0);
        const oracle_primitive s = sphere_of(0, 0, 0, 0, 5 * one);
        oracle_primitive p = triangle_of(0, flat);
        oracle_hit hit;
        for (int i = 0; i < 9; i++)
            p.data[i] *= one;
        assert_true(oracle_hits(&s, &(truth_ray){{0, 0, -10 * one}, {0, 0, 2 * one}, 0, INFINITY}, &hit));
        assert_true(hit.t == 2.5 && !hit.far && hit.normal[0] == 0 && hit.normal[2] == -1 && hit.uv[0] == 0);
        assert_true(oracle_hits(&s, &(truth_ray){{0, 0, -10 * one}, {0, 0, 2 * one}, 3, INFINITY}, &hit));
        assert_true(hit.t == 7.5 && hit.far && hit.normal[2] == 1);
        assert_true(t_of(s, ray_of(0, 0, 0, 0, one, 0)) == 5 && t_of(s, ray_of(3 * one, 4 * one, 0, 0, -one, 0)) == 0);
        assert_false(is_hit(s, ray_of(0, 0, 6 * one, 0, 0, one)));
        assert_true(t_of(sphere_of(0, one, 0, 8 * one, one), ray_of(0, 0, 0, 0, 0, 1)) == 8 * one); /* tangents */
        assert_true(t_of(sphere_of(0, one, 0, 8 * one, above), ray_of(0, 0, 0, 0, 0, 1)) < 8 * one);
        assert_false(is_hit(sphere_of(0, one, 0, 8 * one, below), ray_of(0, 0, 0, 0, 0, 1)));
        assert_true(oracle_hits(&p, &(truth_ray){{one, 2 * one, 3 * one}, {0, 0, -2 * one}, 0, INFINITY}, &hit));
        assert_true(hit.t == 1.5 && hit.uv[0] == 0.25 && hit.uv[1] == 0.25 && hit.normal[2] == 1);
        assert_true(t_of(p, ray_of(one, one, 0, 0, 0, one)) == 0);         /* the origin in the triangle */
        assert_true(is_hit(p, ray_of(0, 0, one, 0, 0, -one)));             /* a vertex */
        assert_true(is_hit(p, ray_of(2 * one, 4 * one, one, 0, 0, -1)));   /* an edge */
        assert_false(is_hit(p, ray_of(-0x1p-149f, one, one, 0, 0, -one))); /* next to an edge */
        assert_false(is_hit(p, ray_of(-one, one, 0, one, 0, 0)));          /* in its plane */
        assert_false(is_hit(p, ray_of(-one, one, one, one, 0, 0)));        /* parallel to it */
    }
    /* 3-4-5: a slanted line that touches the sphere at (3, 4, 0) */
    const truth_ray slanted = ray_of(3 + 8, 4 - 6, 0, -4, 3, 0);
    assert_true(t_of(sphere_of(0, 0, 0, 0, 5), slanted) == 2);
    assert_false(is_hit(sphere_of(0, 0, 0, 0, nextafterf(5, 0)), slanted));
    assert_false(is_hit(sphere_of(0, -0x1p-149f, 0, 0, 5), slanted));
    assert_true(t_of(sphere_of(0, 3, -2, 7, 0), ray_of(0, 0, 0, 3, -2, 7)) == 1); /* a point */
    assert_false(is_hit(sphere_of(0, 3, -2, 7, 0), ray_of(0x1p-149f, 0, 0, 3, -2, 7)));
}

TEST(what_takes_no_part)
{
    const float line[3][3] = {{-1, -1, 2}, {0, 0, 2}, {3, 3, 2}}, bad[] = {NAN, INFINITY, -INFINITY};
    const truth_ray ray = ray_of(0, 0, 0, 0, 0, 1);
    const oracle_primitive good = plane_at(0, 2), ball = sphere_of(0, 0, 0, 2, 1);
    assert_true(is_hit(good, ray) && is_hit(ball, ray) && is_hit(sphere_of(0, 0, 0, 2, -0.0f), ray));
    assert_false(is_hit(triangle_of(0, line), ray) || is_hit(sphere_of(0, 0, 0, 2, -0x1p-149f), ray));
    assert_false(is_hit(good, ray_of(0, 0, 0, 0, -0.0f, 0)));
    for (int i = 0; i < 27; i++) {
        oracle_primitive p = i < 12 ? ball : good;
        truth_ray other = ray;
        p.data[i / 3 % (i < 12 ? 4 : 9)] = bad[i % 3];
        (i % 2 ? other.org : other.dir)[i / 3 % 3] = bad[i % 3];
        assert_false(is_hit(p, ray) || is_hit(good, other));
    }
    assert_false(in_range(good, ray, NAN, INFINITY) || in_range(good, ray, 0, NAN) || in_range(good, ray, 2, 1));
    assert_false(in_range(good, ray, INFINITY, INFINITY) || in_range(good, ray, -INFINITY, -INFINITY));
    assert_true(in_range(good, ray, 2, 2) && in_range(good, ray, -INFINITY, INFINITY));
}

static uint32_t nearest_of(oracle_primitive a, oracle_primitive b)
{
    const oracle_primitive both[2] = {a, b};
    const truth_ray ray = ray_of(0, 0, 0, 0, 0, 1);
    return oracle_trace(&(oracle_scene){.primitive = both, .count = 2}, &ray).index;
}

/* Ties go to the lowest ids; near ties are ordered by the numbers, not by floats. */
TEST(order_is_exact)
{
    const oracle_primitive ties[][2] = {
        {plane_at(1, 7), plane_at(2, 7)},
        {sphere_of(1, 0, 0, 8, 1), plane_at(2, 7)},
        {sphere_of(1, 0, 0, 8, 1), sphere_of(2, 0, 0, 9, 2)},
        {sphere_of(1, 1, 0, 8, 1), plane_at(2, 8)},                  /* tangent */
        {sphere_of(1, 1, 0, 8, 1.5f), sphere_of(2, 0, 1, 8, 1.5f)}}; /* 8 - sqrt(1.25) */
    for (size_t i = 0; i < TEST_COUNT(ties); i++) {
        oracle_primitive first = ties[i][0];
        assert_int_equal(nearest_of(first, ties[i][1]), 0);
        assert_int_equal(nearest_of(ties[i][1], first), 1);
        first.geometry = 3;
        assert_int_equal(nearest_of(first, ties[i][1]), 1);
        first.geometry = 2, first.primitive = 5;
        assert_int_equal(nearest_of(first, ties[i][1]), 1);
    }
    for (int k = 1; k < 40; k++) { /* planes at the two floats around an irrational root */
        const float x = (float)k / 32;
        const oracle_primitive s = sphere_of(0, x, 0, 8, 1.5f);
        const double root = 8 - sqrt(2.25 - (double)x * x);
        const float near = (float)root, before = near > root ? nextafterf(near, 0) : near;
        if (before == root)
            continue;
        assert_int_equal(nearest_of(s, plane_at(1, before)), 1);
        assert_int_equal(nearest_of(s, plane_at(1, nextafterf(before, 9))), 0);
        assert_int_equal(nearest_of(s, sphere_of(1, x, 0x1p-26f, 8, 1.5f)), 0); /* roots that differ by 2^-52 t */
        assert_int_equal(nearest_of(sphere_of(0, x, 0x1p-80f, 8, 1.5f), sphere_of(1, x, 0, 8, 1.5f)), 1);
    }
}

/* What counts is the t that rounds to a float in the range. */
TEST(ranges_are_of_rounded_t)
{
    const oracle_primitive p = plane_at(0, 0x1p24f), s = sphere_of(0, 0, 0, 0x1p24f + 2, 2), one = plane_at(0, 1);
    const oracle_primitive far = plane_at(0, FLT_MAX), here = plane_at(0, 0);
    truth_ray ray = ray_of(0, 0, -1, 0, 0, 1); /* t = 2^24 + 1, which rounds to 2^24 */
    const float at = 0x1p24f, next = at + 2, before = at - 1;
    assert_true(in_range(p, ray, at, at) && in_range(s, ray, at, at));
    assert_false(in_range(p, ray, 0, before) || in_range(p, ray, next, INFINITY) || in_range(s, ray, next, next));
    ray.org[0] = 0x1p-60f; /* the sphere is now farther by a tiny amount, and t rounds up */
    assert_true(in_range(s, ray, next, next) && !in_range(s, ray, 0, at));
    assert_true(in_range(one, ray_of(0, 0, 0x1p-25f, 0, 0, 1), 1, 1)); /* floats are closer below a power of two */
    assert_false(in_range(one, ray_of(0, 0, 0x1.0002p-25f, 0, 0, 1), 1, 1));
    assert_true(is_hit(far, ray_of(0, 0, -nextafterf(0x1p103f, 0), 0, 0, 1)));
    assert_false(is_hit(far, ray_of(0, 0, -0x1p103f, 0, 0, 1))); /* t = 2^128 - 2^103 rounds to infinity */
    assert_false(in_range(far, ray_of(0, 0, -0x1p103f, 0, 0, -1), -INFINITY, 0));
    assert_true(in_range(here, ray_of(0, 0, -0x1p-149f, 0, 0, 2), 0, 0)); /* t = 2^-150 rounds to 0 */
    assert_true(in_range(here, ray_of(0, 0, -0x1p-149f, 0, 0, 1.5f), 0x1p-149f, 1));
}

/* ---- verdicts ---- */

static oracle_verdict judge_id(const oracle_scene *scene, truth_ray ray, uint32_t id, oracle_hit *truth)
{
    return oracle_judge(scene, &ray, id, id == ORACLE_NONE ? ORACLE_NONE : 0, truth);
}

TEST(wrong_answers_are_told)
{
    const oracle_primitive all[] = {sphere_of(0, 0, 0, 9, 1), plane_at(1, 7), plane_at(2, 7),
                                    sphere_of(3, 0, 50, 0, 1)};
    const oracle_scene scene = {.primitive = all, .count = TEST_COUNT(all)};
    const truth_ray hit = ray_of(0, 0, 0, 0, 0, 1), miss = ray_of(0, 0, 0, 0, 0, -1);
    oracle_hit truth;
    assert_int_equal(judge_id(&scene, hit, 1, &truth), ORACLE_RIGHT);
    assert_int_equal(judge_id(&scene, hit, ORACLE_NONE, &truth), ORACLE_MISSED);
    assert_true(truth.index == 1 && truth.t == 7);
    for (uint32_t id = 0; id < 10; id++) /* farther, at the same t with a higher id, not hit, not there */
        assert_int_equal(judge_id(&scene, hit, id, &truth), id == 1 ? ORACLE_RIGHT : ORACLE_WRONG);
    assert_int_equal(oracle_judge(&scene, &hit, 1, 1, &truth), ORACLE_WRONG);
    assert_int_equal(judge_id(&scene, miss, ORACLE_NONE, &truth), ORACLE_RIGHT);
    for (uint32_t id = 0; id < 5; id++)
        assert_int_equal(judge_id(&scene, miss, id, &truth), ORACLE_INVENTED);
    assert_int_equal(judge_id(&scene, ray_of(0, 0, 0, 0, NAN, 1), ORACLE_NONE, &truth), ORACLE_RIGHT);
}

/* Both answers are right within 2^-6 ulp of the point where the end of the range rounds, but no further away. */
TEST(doubt_at_the_ends)
{
    const oracle_primitive all[] = {plane_at(0, 1), plane_at(1, 1.5f)};
    const oracle_scene scene = {.primitive = all, .count = 2};
    for (int sign = -1; sign <= 1; sign += 2)
        for (int bits = 27; bits <= 33; bits++) { /* 1 + 2^-24 is where t_max = 1 ends; its ulp is 2^-23 */
            truth_ray ray = ray_of(0, 0, -(0x1p-24f + (float)sign * ldexpf(1, -bits)), 0, 0, 1);
            oracle_hit truth;
            const bool doubt = bits > 29, inside = sign < 0;
            ray.t_max = 1;
            assert_true(is_hit(all[0], ray) == inside);
            assert_int_equal(judge_id(&scene, ray, 0, &truth), inside || doubt ? ORACLE_RIGHT : ORACLE_INVENTED);
            assert_int_equal(judge_id(&scene, ray, ORACLE_NONE, &truth),
                             !inside || doubt ? ORACLE_RIGHT : ORACLE_MISSED);
            assert_int_equal(judge_id(&scene, ray, 1, &truth), inside ? ORACLE_WRONG : ORACLE_INVENTED);
            ray.t_max = INFINITY; /* the same at the beginning of a range that contains a second hit */
            ray.t_min = nextafterf(1, 2);
            assert_int_equal(judge_id(&scene, ray, 0, &truth), !inside || doubt ? ORACLE_RIGHT : ORACLE_WRONG);
            assert_int_equal(judge_id(&scene, ray, 1, &truth), inside || doubt ? ORACLE_RIGHT : ORACLE_WRONG);
            assert_int_equal(judge_id(&scene, ray, ORACLE_NONE, &truth), ORACLE_MISSED);
        }
}

/* A range that begins at the rounded t of a sphere's near root, half an ulp off: either root of it is right. */
TEST(doubt_between_two_roots)
{
    const oracle_primitive one = sphere_of(0, 0x1.2f24eap-3f, 0, 0, 0x1.23d068p-5f);
    const oracle_scene scene = {.primitive = &one, .count = 1};
    truth_ray ray = ray_of(-0x1.687e7p+1f, 0, 0, 1, 0, 0);
    ray.t_min = 0x1.76e17ep+1f; /* 0x1.76e17d is hit */
    oracle_hit far;
    assert_int_equal(judge_id(&scene, ray, 0, &far), ORACLE_RIGHT);
    assert_true(far.far);
    assert_null(oracle_check(&scene, &ray, 0, 0, ray.t_min));
    assert_null(oracle_check(&scene, &ray, 0, 0, (float)far.t));
    assert_non_null(oracle_check(&scene, &ray, 0, 0, nextafterf(ray.t_min, 4)));
}

TEST(errors_are_measured)
{
    const truth_real z[3] = {0, 0, 1};
    assert_true(oracle_ulp(1, 1) == 0 && oracle_ulp(1, nextafterf(1, 2)) == 1);
    assert_true(oracle_ulp(1, nextafterf(1, 0)) == 0.5 && oracle_ulp((truth_real)1 + 0x1p-25, 1) == 0.25);
    assert_true(oracle_ulp((truth_real)0x1p-150, 0) == 0.5 && oracle_ulp(FLT_MAX, nextafterf(FLT_MAX, 0)) == 1);
    assert_true(oracle_ulp(1, INFINITY) == INFINITY && oracle_ulp(1, NAN) == INFINITY);
    assert_true(oracle_angle(z, (float[3]){0, 0, 3}) == 0 && oracle_angle(z, (float[3]){0, NAN, 1}) == INFINITY);
    assert_true(fabs(oracle_angle(z, (float[3]){0, 0, -1}) - acos(-1)) < 1e-15);
    assert_true(fabs(oracle_angle(z, (float[3]){0x1p-24f, 0, 1}) - 0x1p-24) < 1e-20);
}

SEEDED_SUITE("test_oracle", NULL, NULL)
