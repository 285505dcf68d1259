/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The stage in double precision (triangle_double.h, sphere_double.h): errors stay within the derived bounds, the bounds
 * are not orders of magnitude too wide, and values reported as safe are safe. */
#include "support/test.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "decide/double_cases.h"
#include "support/oracle/oracle_line.h"
#include "exact/triangle_pair.h"

/* ---- exact values ---- */

static dyadic dyadic_of_double(double x)
{
    int exponent;
    const double m = frexp(x, &exponent), high = trunc(ldexp(m, 27)), low = ldexp(ldexp(m, 27) - high, 27);
    const dyadic h = dyadic_make((int32_t)high, exponent - 27), l = dyadic_make((int32_t)low, exponent - 54);
    return dyadic_add(&h, &l);
}

/* |computed * times - exact| */
static double error_of(double computed, const dyadic *times, const dyadic *exact)
{
    const dyadic x = dyadic_of_double(computed), product = dyadic_mul(&x, times);
    const dyadic difference = dyadic_sub(&product, exact);
    return fabs((double)dyadic_real(&difference));
}

static void difference_of(const float p[3], const float q[3], dyadic result[3])
{
    for (int a = 0; a < 3; a++) {
        const dyadic x = dyadic_of_float(p[a]), y = dyadic_of_float(q[a]);
        result[a] = dyadic_sub(&x, &y);
    }
}

/* Largest ratio of error to bound, and how often values are exact. */
typedef struct nearness {
    double most;
    uint64_t beyond, exact, values;
} nearness;

static void note_error(nearness *n, double error, double bound)
{
    n->values++;
    n->exact += error == 0;
    n->beyond += !(error <= bound);
    if (bound > 0)
        n->most = fmax(n->most, error / bound);
}

static void expect_near(const char *what, const nearness *n, double least)
{
    print_message("%s: %llu values, %llu of them exact, errors up to %.3g of the bound\n", what,
                  (unsigned long long)n->values, (unsigned long long)n->exact, n->most);
    assert_int_equal(n->beyond, 0);
    assert_true(n->most > least);
}

/* ---- bounds ---- */

static void judge_triangle(const oracle_primitive *q, const truth_ray *ray, nearness *sides, nearness *num,
                           nearness *den, nearness pairs[2])
{
    const cgt_primitive primitive = double_case_shape_of(q);
    const cgt_triangle *t = &primitive.triangle;
    const cgt_triangle_sides s = cgt_triangle_double_sides(ray->org, ray->dir, t);
    const cgt_triangle_plane p = cgt_triangle_double_plane(ray->org, ray->dir, t);
    const dyadic one = dyadic_make(1, 0);
    dyadic d[3], from[3], e[3], f[3], cross[3];
    for (int a = 0; a < 3; a++)
        d[a] = dyadic_of_float(ray->dir[a]);
    for (int k = 0; k < 3; k++) {
        difference_of(t->v[(k + 1) % 3], ray->org, from);
        difference_of(t->v[(k + 2) % 3], ray->org, e);
        dyadic_cross(from, e, cross);
        const dyadic w = dyadic_dot(d, cross);
        note_error(sides, error_of(s.w[k], &one, &w), s.error[k]);
        cgt_pair b[3], edge[3];
        const cgt_pair dir[3] = {{(double)ray->dir[0], 0}, {(double)ray->dir[1], 0}, {(double)ray->dir[2], 0}};
        cgt_pair_between(ray->org, t->v[(k + 1) % 3], b);
        cgt_pair_between(t->v[(k + 1) % 3], t->v[(k + 2) % 3], edge);
        const double by_pairs = cgt_pair_determinant(b, edge, dir); /* rounded to a double at the end */
        note_error(&pairs[0], error_of(by_pairs, &one, &w), s.error[k] * CGT_PAIR_ERROR + fabs(by_pairs) * 0x1p-53);
    }
    difference_of(t->v[0], ray->org, from);
    difference_of(t->v[1], t->v[0], e);
    difference_of(t->v[2], t->v[0], f);
    dyadic_cross(e, f, cross);
    const dyadic exact_num = dyadic_dot(cross, from), exact_den = dyadic_dot(cross, d);
    note_error(num, error_of(p.num, &one, &exact_num), p.num_error);
    cgt_triangle_plane refined = p;
    cgt_triangle_refine_num(ray->org, t, &refined);
    note_error(&pairs[1], error_of(refined.num, &one, &exact_num), refined.num_error + fabs(refined.num) * 0x1p-53);
    note_error(den, error_of(p.den, &one, &exact_den), p.den_error);
}

TEST(triangles_err_within_bounds)
{
    nearness sides = {0}, num = {0}, den = {0}, pairs[2] = {{0}};
    for (int f = 0; f < DOUBLE_FAMILIES; f++) {
        test_random r = random_make((uint64_t)f);
        for (uint32_t round = 100 + test_scaled(15000); round; round--) {
            oracle_primitive q;
            truth_ray ray;
            double_case_make(&r, (double_family)f, false, &q, &ray);
            judge_triangle(&q, &ray, &sides, &num, &den, pairs);
        }
    }
    expect_near("side of an edge", &sides, 0x1p-6);
    expect_near("n.a", &num, 0x1p-6);
    expect_near("d.n", &den, 0x1p-6);
    expect_near("side of an edge, by pairs", &pairs[0], 0x1p-12);
    expect_near("n.a, by pairs", &pairs[1], 0x1p-12);
}

/* The bounds that sphere_double.h states for its terms. The tight bound of the discriminant holds where the line meets
 * the sphere. Elsewhere larger terms may swamp it, and the result only has to be a miss. */
static void judge_sphere(const oracle_primitive *q, const truth_ray *ray, nearness *tight_disc, nearness *rest)
{
    const cgt_sphere sphere = double_case_shape_of(q).sphere;
    const cgt_sphere_terms e = cgt_sphere_double_terms(ray->org, ray->dir, sphere);
    const dyadic one = dyadic_make(1, 0);
    dyadic c[3], d[3];
    difference_of(q->data, ray->org, c);
    for (int a = 0; a < 3; a++)
        d[a] = dyadic_of_float(ray->dir[a]);
    const dyadic r = dyadic_of_float(sphere.r), rr = dyadic_mul(&r, &r), cc = dyadic_dot(c, c), dd = dyadic_dot(d, d);
    const dyadic dc = dyadic_dot(d, c), power = dyadic_sub(&cc, &rr), square = dyadic_mul(&dc, &dc);
    const dyadic product = dyadic_mul(&dd, &power), disc = dyadic_sub(&square, &product);
    const double length2 = (double)dyadic_real(&dd), distance2 = (double)dyadic_real(&cc);
    const double both = distance2 + (double)sphere.r * sphere.r;
    const double tight = cgt_sphere_double_disc_error(ray->org, ray->dir, sphere);
    if (disc.sign >= 0)
        note_error(tight_disc, error_of(e.disc, &one, &disc), tight);
    else
        assert_true(e.disc <= tight);
    double refined_error;
    const double refined = cgt_sphere_double_refine_disc(ray->org, ray->dir, sphere, &refined_error);
    note_error(&rest[3], error_of(refined, &one, &disc), refined_error);
    note_error(&rest[0], error_of(e.middle, &one, &dc), 4 * CGT_DOUBLE_U * sqrt(distance2 * length2));
    note_error(&rest[1], error_of(e.product, &one, &power), 6 * CGT_DOUBLE_U * both);
    note_error(&rest[2], error_of(e.disc, &one, &disc), 14 * CGT_DOUBLE_U * both * length2);
}

TEST(spheres_err_within_bounds)
{
    nearness disc = {0}, rest[4] = {{0}};
    for (int f = 0; f < DOUBLE_FAMILIES; f++) {
        test_random r = random_make(10 + (uint64_t)f);
        for (uint32_t round = 100 + test_scaled(15000); round; round--) {
            oracle_primitive q;
            truth_ray ray;
            double_case_make(&r, (double_family)f, true, &q, &ray);
            judge_sphere(&q, &ray, &disc, rest);
        }
    }
    expect_near("discriminant, tight bound", &disc, 0x1p-7);
    expect_near("middle", &rest[0], 0x1p-6);
    expect_near("product", &rest[1], 0x1p-6);
    expect_near("discriminant, any line", &rest[2], 0x1p-6);
    expect_near("discriminant, refined", &rest[3], 0x1p-6);
}

/* ---- values reported as safe ---- */

/* Errors of the values that are used directly, relative to 2^-30 of their magnitude; the number of values not used. */
TEST(safe_values_are)
{
    nearness safe[2] = {{0}};
    uint64_t ordinary = 0, unsafe = 0;
    for (int f = 0; f < DOUBLE_FAMILIES; f++) {
        test_random r = random_make(20 + (uint64_t)f);
        for (uint32_t round = 100 + test_scaled(8000); round; round--) {
            const bool sphere = round % 2;
            oracle_primitive q;
            oracle_root roots[2];
            oracle_line line;
            truth_ray ray;
            double_case_make(&r, (double_family)f, sphere, &q, &ray);
            if (!oracle_line_make(&ray, &line) || !oracle_roots(&line, &q, roots))
                continue;
            const cgt_primitive primitive = double_case_shape_of(&q);
            const cgt_sphere_terms e = cgt_sphere_double_terms(ray.org, ray.dir, primitive.sphere);
            const cgt_triangle_plane p = cgt_triangle_double_plane(ray.org, ray.dir, &primitive.triangle);
            const bool is_safe = sphere ? !cgt_sphere_double_unsafe(e, sqrt(e.disc)) : cgt_triangle_double_t_safe(&p);
            ordinary += f == ANYWHERE;
            unsafe += f == ANYWHERE && !is_safe;
            if (!is_safe)
                continue;
            const cgt_sphere_roots both = cgt_sphere_double_roots(e, sqrt(e.disc));
            const double t[2] = {sphere ? both.near : p.num / p.den, both.far};
            for (int i = 0; i < (sphere ? 2 : 1); i++) /* the bounds of t's numerator and denominator add up */
                note_error(&safe[sphere], fabs((double)(t[i] - roots[i].t)),
                           fabs((double)roots[i].t) * (sphere ? 0x1p-31 : 2.01 * CGT_DOUBLE_SAFE));
        }
    }
    print_message("of %llu ordinary hits %llu are not safe in double\n", (unsigned long long)ordinary,
                  (unsigned long long)unsafe);
    expect_near("t of triangles", &safe[0], 0);
    expect_near("t of spheres", &safe[1], 0);
    assert_true(unsafe * 100 < ordinary);
}

/* An origin above a sphere's surface, at a height of 2 to 2^-24 radii, and a ray that goes down from there. */
static void start_above(test_random *r, const oracle_primitive *q, truth_ray *ray)
{
    const float height = ldexpf(q->data[3], 1 - (int)random_below(r, 26));
    float up[3];
    random_direction(r, up);
    for (int a = 0; a < 3; a++) {
        ray->org[a] = q->data[a] + up[a] * (q->data[3] + height);
        ray->dir[a] = random_float(r, -0.5f, 0.5f) - up[a];
    }
}

/* c.c - r^2 where little or nothing is left of it: origins above surfaces, on them and, by rounding, within. */
TEST(refined_products_are_precise)
{
    nearness n = {0};
    uint64_t all = 0, refined = 0;
    for (int f = 0; f < DOUBLE_FAMILIES; f++) {
        test_random r = random_make(40 + (uint64_t)f);
        for (uint32_t round = 100 + test_scaled(15000); round; round--) {
            const dyadic one = dyadic_make(1, 0);
            oracle_primitive q;
            truth_ray ray;
            dyadic c[3];
            double product;
            double_case_make(&r, (double_family)f, true, &q, &ray);
            if (round % 3 == 0)
                start_above(&r, &q, &ray);
            if (round % 3 == 1) {
                memcpy(ray.org, q.data, sizeof ray.org);
                ray.org[round / 3 % 3] -= q.data[3];
            }
            const cgt_sphere sphere = double_case_shape_of(&q).sphere;
            const bool is_refined = cgt_sphere_double_refine(ray.org, sphere, &product);
            all++;
            refined += is_refined;
            if (!is_refined)
                continue;
            difference_of(q.data, ray.org, c);
            const dyadic radius = dyadic_of_float(sphere.r), rr = dyadic_mul(&radius, &radius), cc = dyadic_dot(c, c);
            const dyadic power = dyadic_sub(&cc, &rr);
            note_error(&n, error_of(product, &one, &power), fabs((double)dyadic_real(&power)) * 0x1p-34);
        }
    }
    expect_near("refined c.c - r^2", &n, 0x1p-24);
    assert_true(refined * 10 > all * 9);
}

/* Error of the root on the short path relative to 2^-32 of the root, error of the hit point relative to 2^-25 of the
 * radius, and how many hits take that path. */
TEST(short_ways_are_safe)
{
    nearness root = {0}, point = {0};
    uint64_t ordinary = 0, longer = 0;
    for (int f = 0; f < DOUBLE_FAMILIES; f++) {
        test_random r = random_make(30 + (uint64_t)f);
        for (uint32_t round = 100 + test_scaled(15000); round; round--) {
            oracle_primitive q;
            oracle_root roots[2];
            oracle_line line;
            truth_ray ray;
            double near;
            double_case_make(&r, (double_family)f, true, &q, &ray);
            const bool above = f != HUGE_OR_TINY && round % 4 == 0;
            if (above)
                start_above(&r, &q, &ray);
            if (!oracle_line_make(&ray, &line) || !oracle_roots(&line, &q, roots) || !(roots[0].t > 0))
                continue;
            const cgt_sphere sphere = double_case_shape_of(&q).sphere;
            const cgt_sphere_terms e = cgt_sphere_double_terms(ray.org, ray.dir, sphere);
            const bool is_short = cgt_sphere_double_near(e, &near);
            ordinary += f == ANYWHERE && !above;
            longer += f == ANYWHERE && !above && !is_short;
            if (!is_short)
                continue;
            const double error = fabs((double)(near - roots[0].t));
            note_error(&root, error, (double)roots[0].t * 0x1p-32);
            note_error(&point, error * sqrt(e.square), (double)sphere.r * 0x1p-25);
        }
    }
    print_message("of %llu ordinary hits %llu take the long path\n", (unsigned long long)ordinary,
                  (unsigned long long)longer);
    expect_near("t by the short path", &root, 0);
    expect_near("point by the short path", &point, 0x1p-10);
    assert_true(longer * 4 < ordinary);
}

SEEDED_SUITE("test_double_stage", NULL, NULL)
