/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact stage where the answer is known in closed form: edges, vertices, needles, tangents, points, equal t. */
#include "support/test.h"

#include <math.h>
#include <string.h>

#include "exact/exact_cases.h"

static cgt_primitive triangle_of(const float v[9])
{
    cgt_primitive primitive = {.kind = CGT_KIND_TRIANGLES};
    memcpy(&primitive.triangle, v, sizeof primitive.triangle);
    return primitive;
}

static cgt_primitive sphere_of(float x, float y, float z, float r)
{
    return (cgt_primitive){.kind = CGT_KIND_SPHERES, .sphere = {x, y, z, r}};
}

static int compare(const cgt_exact_ray *ray, const cgt_primitive *a, bool far_a, const cgt_primitive *b, bool far_b)
{
    const cgt_exact_root p = {a, far_a}, q = {b, far_b};
    const int order = cgt_exact_compare(ray, &p, &q);
    assert_int_equal(cgt_exact_compare(ray, &q, &p), -order);
    return order;
}

static double t_of(const cgt_exact_ray *ray, const cgt_primitive *primitive, bool far)
{
    return cgt_exact_t(ray, &(cgt_exact_root){primitive, far});
}

/* ---- Triangles ---- */

static const float corner[9] = {0, 0, 1, 4, 0, 1, 0, 4, 1};

static cgt_exact_ray upwards(float x, float y) { return (cgt_exact_ray){{x, y, -1}, {0, 0, 2}}; }

static void edges_and_vertices_belong(void **state)
{
    (void)state;
    const cgt_primitive primitive = triangle_of(corner);
    static const float inside[][2] = {{0, 0},
                                      {4, 0},
                                      {0, 4},
                                      {2, 0},
                                      {0, 3},
                                      {1, 3},
                                      {3.5f, 0.5f},
                                      {1, 1},
                                      {-0.0f, 2},
                                      {0x1p-149f, 1},
                                      {0x1p-149f, 0x1p-149f},
                                      {0x1p-100f, 0}};
    static const float outside[][2] = {{-0x1p-149f, 1}, {1, -0x1p-149f}, {4, 0x1p-149f},  {0x1p-149f, 4}, {5, 0},
                                       {0, -1},         {2, 2.0000002f}, {3.0000002f, 1}, {-1e38f, 2},    {3e38f, 0}};
    for (size_t i = 0; i < TEST_COUNT(inside); i++) {
        const cgt_exact_ray ray = upwards(inside[i][0], inside[i][1]);
        double uv[2];
        assert_true(exact_meets(&ray, &primitive));
        assert_true(t_of(&ray, &primitive, false) == 1);
        cgt_exact_uv(&ray, &primitive.triangle, uv);
        assert_true(uv[0] == inside[i][0] / 4.0 && uv[1] == inside[i][1] / 4.0);
    }
    for (size_t i = 0; i < TEST_COUNT(outside); i++) {
        const cgt_exact_ray ray = upwards(outside[i][0], outside[i][1]);
        assert_false(exact_meets(&ray, &primitive));
    }
}

static void parallel_lines_and_no_area(void **state)
{
    (void)state;
    const cgt_primitive primitive = triangle_of(corner);
    static const float flat[][9] = {{0, 0, 1, 2, 0, 1, 4, 0, 1},  /* three collinear vertices */
                                    {1, 1, 1, 1, 1, 1, 4, 0, 1},  /* two equal vertices */
                                    {1, 1, 1, 1, 1, 1, 1, 1, 1}}; /* all three equal */
    const cgt_exact_ray in_plane = {{-1, 1, 1}, {1, 0, 0}}, above = {{-1, 1, 2}, {1, 0, 0}};
    assert_false(exact_meets(&in_plane, &primitive));
    assert_false(exact_meets(&above, &primitive));
    const cgt_exact_ray hardly = {{-1, 1, 1}, {1, 0, 0x1p-149f}}; /* meets the plane at its origin */
    assert_false(exact_meets(&hardly, &primitive));
    const cgt_exact_ray within = {{1, 1, 1}, {1, 0, 0x1p-149f}};
    assert_true(exact_meets(&within, &primitive) && t_of(&within, &primitive, false) == 0);
    for (size_t i = 0; i < TEST_COUNT(flat); i++) {
        const cgt_primitive degenerate = triangle_of(flat[i]);
        const cgt_exact_ray through = upwards(1, i ? 1 : 0);
        double normal[3];
        assert_false(exact_meets(&through, &degenerate));
        cgt_exact_normal(&degenerate.triangle, normal);
        assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == 0);
    }
}

/* Moving one vertex by one ulp moves a needle's edge across a point on it. */
static void needles(void **state)
{
    (void)state;
    const float long_edge[9] = {0, 0, 1, 0x1p20f, 0x1p20f, 1, 0x1p20f, 0x1.000002p20f, 1};
    cgt_primitive primitive = triangle_of(long_edge);
    const float next = nextafterf(3, 4); /* 3 + 2^-22; the upper edge is at 3 + 1.5 2^-22 */
    const cgt_exact_ray ray = upwards(3, 3), inside = upwards(3, next), over = upwards(3, nextafterf(next, 4)),
                        under = upwards(3, nextafterf(3, 2));
    assert_true(exact_meets(&ray, &primitive));
    assert_true(exact_meets(&inside, &primitive));
    assert_false(exact_meets(&over, &primitive));
    assert_false(exact_meets(&under, &primitive));
    primitive.triangle.v[1][0] = nextafterf(0x1p20f, 0);
    assert_false(exact_meets(&ray, &primitive));
    double normal[3];
    cgt_exact_normal(&primitive.triangle, normal);
    assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] >= 0.5 && normal[2] <= 4);
}

/* 2^120 + 2^67 lies half-way between two doubles: one bit far below decides. */
static void one_bit_decides_rounding(void **state)
{
    (void)state;
    static const struct {
        float factor;
        double rounded;
    } cases[] = {{0x1p33f, 0.5}, {0x1.000004p33f, 0x1.0000000000001p-1}, {0x1.fffffcp32f, 0.5}};
    for (size_t i = 0; i < TEST_COUNT(cases); i++) {
        const float edges[9] = {0, 0, 0, 0x1p60f, -cases[i].factor, 0, 0x1p34f, 0x1p60f, 0};
        const cgt_primitive shape = triangle_of(edges);
        double normal[3];
        cgt_exact_normal(&shape.triangle, normal);
        assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == cases[i].rounded);
    }
}

/* ---- Spheres ---- */

/* Tangent lines: a right angle in integers. */
static void tangents(void **state)
{
    (void)state;
    static const struct {
        cgt_exact_ray ray;
        float centre[3], r, t;
    } touch[] = {{{{0, 5, 7}, {1, 0, 0}}, {9, 2, 3}, 5, 9},                   /* 3, 4, 5 */
                 {{{0, 0, 0}, {2, 2, 1}}, {35, 26, 22}, 9, 16},               /* 16 (2, 2, 1) + 3 (1, -2, 2) */
                 {{{1, 0, 0}, {0, 0, 4}}, {1, 0x1p-149f, 8}, 0x1p-149f, 2},   /* the smallest float */
                 {{{0, 0, 0}, {0, 0x1p-149f, 0}}, {3, 0x1p-140f, 4}, 5, 512}, /* along the smallest float */
                 {{{0, 0, 0}, {1, 0, 0}}, {0x1p127f, 0x1p127f, 0}, 0x1p127f, 0x1p127f}};
    for (size_t i = 0; i < TEST_COUNT(touch); i++) {
        const float *c = touch[i].centre;
        const float r = touch[i].r, smaller = nextafterf(r, 0), larger = nextafterf(r, INFINITY);
        const cgt_exact_ray *ray = &touch[i].ray;
        const cgt_primitive exact = sphere_of(c[0], c[1], c[2], r), less = sphere_of(c[0], c[1], c[2], smaller),
                            more = sphere_of(c[0], c[1], c[2], larger);
        assert_true(exact_meets(ray, &exact));
        assert_false(exact_meets(ray, &less));
        assert_true(exact_meets(ray, &more));
        assert_true(t_of(ray, &exact, false) == touch[i].t && t_of(ray, &exact, true) == touch[i].t);
        assert_int_equal(compare(ray, &exact, false, &exact, true), 0);
        assert_int_equal(compare(ray, &more, false, &exact, true), -1);
        assert_int_equal(compare(ray, &more, true, &exact, false), 1);
        assert_int_equal(compare(ray, &more, false, &more, true), -1);
    }
}

static void points(void **state)
{
    (void)state;
    const cgt_exact_ray ray = {{1, 1, 1}, {1, 2, 3}};
    const cgt_primitive on = sphere_of(3, 5, 7, 0), beside = sphere_of(3, 5, nextafterf(7, 8), 0),
                        at_origin = sphere_of(1, 1, 1, 0);
    assert_true(exact_meets(&ray, &on) && t_of(&ray, &on, false) == 2 && t_of(&ray, &on, true) == 2);
    assert_false(exact_meets(&ray, &beside));
    assert_true(exact_meets(&ray, &at_origin) && t_of(&ray, &at_origin, true) == 0);
    assert_int_equal(compare(&ray, &on, false, &at_origin, false), 1);
    assert_int_equal(compare(&ray, &on, false, &on, true), 0);
}

/* An origin on the surface has t = 0, and one an ulp off has that ulp as its t: nothing cancels. */
static void origins_at_the_surface(void **state)
{
    (void)state;
    const cgt_primitive s = sphere_of(0, 0, 0, 5);
    const cgt_exact_ray along = {{3, 4, 0}, {1, 0, 0}}, back = {{3, 4, 0}, {-1, 0, 0}};
    assert_true(t_of(&along, &s, true) == 0 && t_of(&along, &s, false) == -6);
    assert_true(t_of(&back, &s, false) == 0 && t_of(&back, &s, true) == 6);
    const float off = nextafterf(5, 6);
    const cgt_exact_ray down = {{off, 0, 0}, {-1, 0, 0}};
    assert_true(t_of(&down, &s, false) == (double)off - 5);
    const cgt_exact_ray up = {{nextafterf(5, 0), 0, 0}, {0x1p-30f, 0, 0}};
    assert_true(t_of(&up, &s, true) == (5 - (double)nextafterf(5, 0)) * 0x1p30);
    const cgt_primitive ground = sphere_of(0, -0x1p100f, 0, 0x1p100f); /* the origin lies on it, to the last bit */
    const cgt_exact_ray from_ground = {{0, 0x1p-149f, 0}, {0, -1, 0}};
    assert_true(t_of(&from_ground, &ground, false) == 0x1p-149);
}

/* ---- Order ---- */

static void equal_by_construction(void **state)
{
    (void)state;
    const cgt_exact_ray ray = {{0, 0, 0}, {0, 0, 1}};
    const float plane[9] = {-9, -9, 6, 9, -9, 6, 0, 9, 6}, tilted[9] = {-1, -1, 5, 1, -1, 6, 0, 2, 7};
    const struct {
        cgt_primitive primitive;
        bool far;
    } six[] = {{triangle_of(plane), false},    {triangle_of(tilted), false},     {sphere_of(3, 0, 10, 5), false},
               {sphere_of(0, 4, 9, 5), false}, {sphere_of(0, 0, 11, 5), false},  {sphere_of(3, 4, 6, 5), false},
               {sphere_of(3, 4, 6, 5), true},  {sphere_of(0, 3, 2, 5), true},    {sphere_of(10, 0, 30, 26), false},
               {sphere_of(0, 0, 6, 0), false}, {sphere_of(0, -7, -18, 25), true}},
      root3[] = {{sphere_of(1, 0, 10, 2), false},
                 {sphere_of(3, 2, 10, 4), false},
                 {sphere_of(5, 6, 10, 8), false},
                 {sphere_of(1, 1, 10, 0x1.1e377ap1f), false}}; /* a little above sqrt(5) */
    for (size_t i = 0; i < TEST_COUNT(six); i++) {
        assert_true(exact_meets(&ray, &six[i].primitive) && t_of(&ray, &six[i].primitive, six[i].far) == 6);
        for (size_t j = 0; j < TEST_COUNT(six); j++)
            assert_int_equal(compare(&ray, &six[i].primitive, six[i].far, &six[j].primitive, six[j].far), 0);
    }
    for (size_t i = 0; i < 3; i++) { /* 10 -+ sqrt(3) */
        for (size_t j = 0; j < 3; j++) {
            assert_int_equal(compare(&ray, &root3[i].primitive, false, &root3[j].primitive, false), 0);
            assert_int_equal(compare(&ray, &root3[i].primitive, true, &root3[j].primitive, true), 0);
            assert_int_equal(compare(&ray, &root3[i].primitive, false, &root3[j].primitive, true), -1);
        }
        assert_int_equal(compare(&ray, &root3[i].primitive, false, &root3[3].primitive, false), 1);
    }
}

/* A plane moves through the irrational root 10 -+ sqrt(3): comparing squares decides whether it comes first. */
static void irrational_roots(void **state)
{
    (void)state;
    const cgt_exact_ray ray = {{0, 0, 0}, {0, 0, 1}};
    const cgt_primitive sphere = sphere_of(1, 0, 10, 2);
    for (int far = 0; far < 2; far++) {
        const double root = far ? 10 + sqrt(3) : 10 - sqrt(3);
        float z = (float)root;
        int before = 0;
        for (int i = 0; i < 8; i++)
            z = nextafterf(z, 0);
        for (int i = 0; i < 16; i++, z = nextafterf(z, 100)) {
            const cgt_primitive plane = triangle_of((const float[9]){-1, -1, z, 1, -1, z, 0, 1, z});
            const double from_middle = z - 10.0; /* 24 bits; its square is exact */
            const int order = (from_middle * from_middle > 3) != (far != 0) ? -1 : 1;
            assert_int_equal(compare(&ray, &plane, false, &sphere, far), order);
            before += order < 0;
        }
        assert_true(before > 4 && before < 12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_and_vertices_belong),
        cmocka_unit_test(parallel_lines_and_no_area),
        cmocka_unit_test(needles),
        cmocka_unit_test(one_bit_decides_rounding),
        cmocka_unit_test(tangents),
        cmocka_unit_test(points),
        cmocka_unit_test(origins_at_the_surface),
        cmocka_unit_test(equal_by_construction),
        cmocka_unit_test(irrational_roots),
    };
    test_begin("test_exact");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
