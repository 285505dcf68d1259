/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact oracle on random input: laws of its arithmetic, textbook formulas in binary128, and transformations that
 * must not affect a verdict. */
#include "support/test.h"

#include <math.h>
#include <string.h>

#include "support/oracle/oracle.h"
#include "support/oracle/dyadic.h"

#include "oracle/oracle_input.h"

/* ---- arithmetic ---- */

static float any_finite(test_random *r)
{
    float f;
    do
        f = random_any_float(r);
    while (!isfinite(f));
    return f;
}

static bool is_equal(const dyadic *a, const dyadic *b) { return dyadic_sub(a, b).sign == 0; }

/* Laws that hold for exact numbers only, on products of one to five floats. */
static void arithmetic_is_exact(void **state)
{
    (void)state;
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
    }
}

/* Numbers of 31 and 62 bits against the compiler's integers, and floats after a round trip. */
static void arithmetic_of_small_numbers(void **state)
{
    (void)state;
    test_random r = random_make(2);
    for (uint32_t round = 0; round < test_scaled(20000); round++) {
        const int32_t m = (int32_t)(random_bits(&r) >> 34) - (1 << 29),
                      n = (int32_t)(random_bits(&r) >> 40) - (1 << 23);
        const int at = (int)random_below(&r, 300) - 150;
        const dyadic x = dyadic_make(m, at), y = dyadic_make(n, -at), product = dyadic_mul(&x, &y);
        assert_true(dyadic_real(&product) == (truth_real)((int64_t)m * n));
        const dyadic z = dyadic_make(n, at), sum = dyadic_add(&x, &z), difference = dyadic_sub(&x, &z);
        assert_true(dyadic_real(&sum) == (truth_real)ldexp((double)m + n, at));
        assert_true(dyadic_real(&difference) == (truth_real)ldexp((double)m - n, at));
        assert_int_equal(difference.sign, (m > n) - (m < n));
        const float f = any_finite(&r);
        const dyadic value = dyadic_of_float(f);
        assert_true(dyadic_real(&value) == (truth_real)f);
    }
}

/* ---- textbook formulas ---- */

static double absolute(truth_real a) { return fabs((double)a); }

/* Moeller and Trumbore's formulas; returns -1 for a miss, 1 for a hit, 0 where it is too close for rounded numbers. */
static int textbook_triangle(const truth_ray *ray, const float (*v)[3], truth_real tuv[3])
{
    truth_real e[3], f[3], s[3], det = 0, size = 0;
    for (int a = 0; a < 3; a++) {
        e[a] = (truth_real)v[1][a] - v[0][a];
        f[a] = (truth_real)v[2][a] - v[0][a];
        s[a] = (truth_real)ray->org[a] - v[0][a];
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
    const double w[3] = {(double)tuv[1], (double)tuv[2], (double)(1 - tuv[1] - tuv[2])};
    const double least = fmin(w[0], fmin(w[1], w[2])), t = (double)tuv[0];
    return fabs(least) < 0x1p-30 || fabs(t) < 0x1p-30 ? 0 : least > 0 && t > 0 ? 1 : -1;
}

static void triangles_as_by_textbook(void **state)
{
    (void)state;
    test_random r = random_make(3);
    uint32_t hits = 0, misses = 0, rounds = 200 + test_scaled(10000);
    for (uint32_t round = 0; round < rounds; round++) {
        const box b = {random_float(&r, -10, 10), random_log(&r, 1e-2f, 1e2f)};
        float v[3][3];
        oracle_primitive p = {.kind = ORACLE_TRIANGLE};
        truth_real tuv[3];
        oracle_hit hit;
        for (int i = 0; i < 3; i++)
            random_point(&r, b, v[i]);
        memcpy(p.data, v, sizeof v);
        const truth_ray ray = ray_index(&r, b, (const float(*)[3])v);
        const int expected = textbook_triangle(&ray, (const float(*)[3])v, tuv);
        if (expected == 0)
            continue;
        assert_int_equal(oracle_hits(&p, &ray, &hit), expected > 0);
        misses += expected < 0;
        if (expected < 0)
            continue;
        hits++;
        assert_true(absolute(hit.t / tuv[0] - 1) < 0x1p-40);
        assert_true(absolute(hit.uv[0] - tuv[1]) < 0x1p-40 && absolute(hit.uv[1] - tuv[2]) < 0x1p-40);
        /* the ray's point equals the triangle's point, and the normal has unit length */
        for (int a = 0; a < 3; a++) {
            const truth_real u = hit.uv[0], w = hit.uv[1], along = (truth_real)ray.org[a] + hit.t * ray.dir[a];
            const truth_real at = (1 - u - w) * v[0][a] + u * v[1][a] + w * v[2][a];
            assert_true(absolute(along - at) < 0x1p-40 * (fabs((double)b.middle) + b.reach));
        }
        const truth_real *n = hit.normal;
        assert_true(absolute(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 0x1p-48);
    }
    assert_true(hits > rounds / 8 && misses > rounds / 8);
}

static void spheres_as_by_textbook(void **state)
{
    (void)state;
    test_random r = random_make(4);
    uint32_t hits = 0, misses = 0, far = 0, rounds = 200 + test_scaled(10000);
    for (uint32_t round = 0; round < rounds; round++) {
        const box b = {random_float(&r, -10, 10), 10};
        oracle_primitive p = {.kind = ORACLE_SPHERE};
        float org[3];
        double target[3];
        oracle_hit hit;
        random_point(&r, b, p.data);
        random_point(&r, b, org);
        p.data[3] = random_log(&r, 1e-2f, 20);
        for (int a = 0; a < 3; a++)
            target[a] = p.data[a] + (double)random_float(&r, -1.5f, 1.5f) * p.data[3];
        const truth_ray ray = ray_to(org, target);
        const truth_roots roots = truth_sphere(ray.org, ray.dir, p.data);
        if (truth_in_doubt(&roots) || (roots.hit && fmin(absolute(roots.near), absolute(roots.far)) < 0x1p-30))
            continue;
        const bool expected = roots.hit && roots.far > 0;
        assert_int_equal(oracle_hits(&p, &ray, &hit), expected);
        misses += !expected;
        if (!expected)
            continue;
        hits++;
        far += hit.far;
        assert_int_equal(hit.far, roots.near < 0);
        assert_true(absolute(hit.t / (hit.far ? roots.far : roots.near) - 1) < 0x1p-40);
        for (int a = 0; a < 3; a++) {
            const truth_real n = ((truth_real)ray.org[a] + hit.t * ray.dir[a] - p.data[a]) / p.data[3];
            assert_true(absolute(hit.normal[a] - n) < 0x1p-36);
        }
    }
    print_message("%u hits, %u of them far, %u misses\n", (unsigned)hits, (unsigned)far, (unsigned)misses);
    assert_true(hits > rounds / 4 && misses > rounds / 16 && far > rounds / 64);
}

/* ---- transformations that must not change the answer ---- */

static oracle_primitive renamed(const oracle_primitive *p, int shift, int vertices)
{
    oracle_primitive q = *p;
    for (int i = 0; i < (p->kind == ORACLE_TRIANGLE ? 3 : 1); i++)
        for (int a = 0; a < 3; a++)
            q.data[3 * i + (a + shift) % 3] = p->data[3 * i + a];
    for (int i = 0; i < 3 && p->kind == ORACLE_TRIANGLE;
         i++) { /* rotated by `vertices`; orientation reversed from 3 on */
        const int from = ((vertices < 3 ? i : 2 - i) + vertices) % 3;
        for (int a = 0; a < 3; a++)
            q.data[3 * i + (a + shift) % 3] = p->data[3 * from + a];
    }
    return q;
}

static oracle_primitive resized(oracle_primitive p, int k)
{
    for (int i = 0; i < 9; i++)
        p.data[i] = ldexpf(p.data[i], k);
    return p;
}

static void expect_same(const oracle_primitive *p, const truth_ray *ray, bool expected, truth_real t)
{
    oracle_hit hit;
    assert_int_equal(oracle_hits(p, ray, &hit), expected);
    assert_true(!expected || absolute(hit.t - t) <= 0x1p-45 * absolute(t));
}

/* Permutes axes and vertices, and scales all lengths by powers of two. Rays aim at edges and outlines. */
static void names_and_scales_do_not_matter(void **state)
{
    (void)state;
    test_random r = random_make(5);
    uint32_t hits = 0, rounds = 50 + test_scaled(2000);
    for (uint32_t round = 0; round < rounds; round++) {
        const box b = {0, 4};
        float v[3][3];
        oracle_primitive p = {.kind = round % 2 ? ORACLE_TRIANGLE : ORACLE_SPHERE};
        oracle_hit hit;
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 3; a++) /* 20 bits, so that small scales are exact */
                v[i][a] = (float)((int32_t)random_below(&r, 1 << 20) - (1 << 19)) * 0x1p-17f;
        memcpy(p.data, v, sizeof v);
        p.data[3] = round % 2 ? p.data[3] : fabsf(p.data[3]);
        truth_ray ray = ray_index(&r, b, (const float(*)[3])v);
        for (int a = 0; a < 3; a++) {
            ray.org[a] = rintf(ray.org[a] * 0x1p17f) * 0x1p-17f;
            ray.dir[a] = rintf(ray.dir[a] * 0x1p17f) * 0x1p-17f;
        }
        const bool is_hit = oracle_hits(&p, &ray, &hit);
        hits += is_hit;
        for (int shift = 0; shift < 3; shift++) {
            truth_ray turned = ray;
            for (int a = 0; a < 3; a++) {
                turned.org[(a + shift) % 3] = ray.org[a];
                turned.dir[(a + shift) % 3] = ray.dir[a];
            }
            for (int vertices = 0; vertices < 6; vertices++) {
                const oracle_primitive q = renamed(&p, shift, vertices);
                expect_same(&q, &turned, is_hit, hit.t);
            }
        }
        for (int k = -130; k <= 100; k += 23) {
            const oracle_primitive q = resized(p, k);
            truth_ray large = ray;
            for (int a = 0; a < 3; a++) {
                large.org[a] = ldexpf(ray.org[a], k);
                large.dir[a] = ldexpf(ray.dir[a], k);
            }
            expect_same(&q, &large, is_hit, hit.t);
        }
    }
    assert_true(hits > rounds / 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic_is_exact),
        cmocka_unit_test(arithmetic_of_small_numbers),
        cmocka_unit_test(triangles_as_by_textbook),
        cmocka_unit_test(spheres_as_by_textbook),
        cmocka_unit_test(names_and_scales_do_not_matter),
    };
    test_begin("test_oracle_random");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
