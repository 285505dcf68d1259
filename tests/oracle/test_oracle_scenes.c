/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact oracle in whole scenes: closed meshes have no holes, the filter in double changes no result, and it agrees
 * with the binary128 oracle that reports doubts. */
#include "support/test.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "support/oracle/oracle.h"
#include "support/oracle/oracle_line.h"

#include "oracle/oracle_input.h"

/* ---- meshes without a hole ---- */

/* Whether p lies strictly inside the tetrahedron: on the same side of all faces. */
static bool is_inside(const float (*v)[3], const uint32_t (*face)[3], const float p[3])
{
    int sign = 0;
    for (int f = 0; f < 4; f++) {
        dyadic corner[3][3], normal[3];
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 3; a++) {
                const dyadic x = dyadic_of_float(v[face[f][i]][a]), y = dyadic_of_float(p[a]);
                corner[i][a] = dyadic_sub(&x, &y);
            }
        dyadic_cross(corner[0], corner[1], normal);
        const int side = dyadic_dot(normal, corner[2]).sign;
        if (side == 0 || side == -sign)
            return false;
        sign = side;
    }
    return true;
}

/* From inside a tetrahedron every ray hits: through faces, edges and vertices alike. */
static void closed_meshes_have_no_holes(void **state)
{
    (void)state;
    static const uint32_t face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    test_random r = random_make(6);
    uint32_t rays = 0, shared = 0, rounds = 20 + test_scaled(1000);
    for (uint32_t round = 0; round < rounds; round++) {
        const box b = {round % 2 ? 0 : 1e5f, random_log(&r, 1e-1f, 1e2f)};
        float v[4][3], inside[3];
        for (int i = 0; i < 4; i++)
            random_point(&r, b, v[i]);
        const double weight = random_float(&r, 0.1f, 0.4f);
        for (int a = 0; a < 3; a++)
            inside[a] = (float)(weight * v[0][a] + 0.1 * v[1][a] + 0.2 * v[2][a] + (0.7 - weight) * v[3][a]);
        if (!is_inside((const float(*)[3])v, face, inside))
            continue; /* flat, degenerate after rounding */
        oracle_scene scene = {0};
        oracle_scene_add_triangles(&scene, 7, (const float(*)[3])v, 4, face, 4);
        for (int i = 0; i < 24; i++) {
            const float *from = v[i % 4], *to = v[(i + 1 + i / 4 % 3) % 4];
            const double k = i % 3 ? random_float(&r, 0, 1) : 0;
            double target[3];
            for (int a = 0; a < 3; a++)
                target[a] = from[a] + k * ((double)to[a] - from[a]);
            const truth_ray ray = ray_to(inside, target);
            uint32_t faces = 0;
            oracle_hit hit;
            for (uint32_t j = 0; j < 4; j++)
                faces += oracle_hits(&scene.primitive[j], &ray, &hit);
            assert_in_range(faces, 1, 3);
            assert_int_equal(oracle_judge(&scene, &ray, ORACLE_NONE, ORACLE_NONE, &hit), ORACLE_MISSED);
            rays++;
            shared += faces > 1;
        }
        oracle_scene_free(&scene);
    }
    print_message("%u of %u rays hit two faces or more at once\n", (unsigned)shared, (unsigned)rays);
    assert_true(rays > 20 * rounds && shared > 0);
}

/* ---- scenes ---- */

/* Spheres and triangles in one place, many equal or touching, a few of them invalid; more than fill a block. */
static oracle_scene random_scene(test_random *r, box b)
{
    enum { MOST = 100 };
    oracle_scene scene = {0};
    float sphere[MOST][4], vertex[MOST][3];
    uint32_t index[MOST][3];
    for (uint32_t g = 0; g < 3; g++) {
        const uint32_t count = 1 + random_below(r, MOST);
        for (uint32_t i = 0; i < count; i++) {
            random_point(r, b, sphere[i]);
            sphere[i][3] = random_log(r, 1e-2f, 0.5f) * b.reach;
            if (i > 0 && random_below(r, 4) == 0)
                memcpy(sphere[i], sphere[random_below(r, i)], sizeof sphere[i]);
            if (random_below(r, 30) == 0)
                sphere[i][random_below(r, 4)] = random_below(r, 2) ? NAN : -INFINITY;
            random_point(r, b, vertex[i]);
            for (int k = 0; k < 3; k++)
                index[i][k] = random_below(r, count); /* sometimes two equal vertices: no area */
        }
        if (g == 1)
            oracle_scene_add_triangles(&scene, g, (const float(*)[3])vertex, count, (const uint32_t(*)[3])index, count);
        else
            oracle_scene_add_spheres(&scene, g, (const float(*)[4])sphere, count);
    }
    return scene;
}

/* Towards a primitive's vertex, edge, inside or outline. */
static truth_ray random_ray(test_random *r, box b, const oracle_scene *scene)
{
    float v[3][3];
    const oracle_primitive *p = &scene->primitive[random_below(r, scene->count)];
    memcpy(v, p->data, sizeof v);
    if (p->kind == ORACLE_SPHERE)
        for (int i = 1; i < 3; i++) {
            random_direction(r, v[i]);
            for (int a = 0; a < 3; a++)
                v[i][a] = p->data[a] + p->data[3] * v[i][a];
        }
    truth_ray ray = ray_index(r, b, (const float(*)[3])v);
    if (random_below(r, 4) == 0) {
        ray.t_min = random_float(r, -1, 1);
        ray.t_max = random_below(r, 2) ? ray.t_min + random_float(r, 0, 1) : INFINITY;
    }
    return ray;
}

/* The closest hit by exact arithmetic, without the filter. */
static uint32_t nearest_unfiltered(const oracle_scene *scene, const truth_ray *ray)
{
    oracle_line line;
    uint32_t best = ORACLE_NONE;
    if (!oracle_line_make(ray, &line))
        return best;
    const oracle_range range = oracle_range_make(ray->t_min, ray->t_max, 0);
    oracle_root nearest, root;
    for (uint32_t i = 0; i < scene->count; i++) {
        if (oracle_first_root(&line, &scene->primitive[i], &range, &root) < 0)
            continue;
        if (best == ORACLE_NONE || oracle_compare(&root, &nearest) < 0) { /* ids ascend */
            nearest = root;
            best = i;
        }
    }
    return best;
}

static void first_look_changes_nothing(void **state)
{
    (void)state;
    test_random r = random_make(7);
    uint32_t hits = 0, rays = 0, rounds = 5 + test_scaled(40);
    for (uint32_t round = 0; round < rounds; round++) {
        const int k = (int)random_below(&r, 200) - 120;
        const box b = {round % 3 ? 0 : ldexpf(random_float(&r, -1e4f, 1e4f), k), ldexpf(1, k)};
        oracle_scene scene = random_scene(&r, b);
        const oracle_scene bare = {.primitive = scene.primitive, .count = scene.count};
        for (int i = 0; i < 20; i++) {
            const truth_ray ray = random_ray(&r, b, &scene);
            const uint32_t expected = nearest_unfiltered(&scene, &ray);
            assert_int_equal(oracle_trace(&scene, &ray).index, expected);
            assert_int_equal(oracle_trace(&bare, &ray).index, expected);
            hits += expected != ORACLE_NONE;
            rays++;
        }
        oracle_scene_free(&scene);
    }
    print_message("%u of %u rays hit\n", (unsigned)hits, (unsigned)rays);
    assert_true(hits > rays / 4 && hits < rays);
}

/* ---- the ends of float ---- */

static float extreme(test_random *r)
{
    static const float end[] = {FLT_MAX, -FLT_MAX, 0x1p-149f, -0x1.8p-148f, 0x1.fffffep-126f, 0x1.fffffep+64f};
    float f;
    do
        f = random_any_float(r);
    while (!isfinite(f));
    return random_below(r, 2) ? end[random_below(r, TEST_COUNT(end))] : f;
}

/* A triangle around the z axis, with corners and slopes of any size. */
static oracle_primitive extreme_primitive(test_random *r)
{
    oracle_primitive p = {.kind = random_below(r, 2) ? ORACLE_SPHERE : ORACLE_TRIANGLE};
    for (int i = 0; i < 9; i++)
        p.data[i] = extreme(r);
    if (p.kind == ORACLE_SPHERE) {
        for (int a = 0; a < 2; a++)
            p.data[a] *= 0.25f;
        p.data[3] = random_below(r, 2) ? FLT_MAX : fabsf(p.data[3]);
    } else if (random_below(r, 4)) {
        const float size = fabsf(p.data[0]);
        const float corner[3][2] = {{-size, -size}, {size, -size}, {0, size}};
        for (int i = 0; i < 3; i++)
            memcpy(&p.data[3 * i], corner[i], sizeof corner[i]);
    }
    return p;
}

/* Input over the full range of float: the numbers are wide enough, and the order of roots is a total order. */
static void any_float_will_do(void **state)
{
    (void)state;
    enum { MOST = 24 };
    test_random r = random_make(9);
    uint32_t pairs = 0, mixed = 0, rounds = 10 + test_scaled(300);
    static oracle_root root[MOST + 1];
    for (uint32_t round = 0; round < rounds; round++) {
        truth_ray ray = {.t_min = -INFINITY, .t_max = INFINITY};
        oracle_line line;
        int count = 0;
        for (int a = 0; a < 3; a++) {
            ray.org[a] = random_below(&r, 3) ? extreme(&r) * (a < 2 ? 0x1p-60f : 1) : 0;
            ray.dir[a] = extreme(&r) * (a < 2 && random_below(&r, 3) ? 0x1p-90f : 1);
        }
        if (!oracle_line_make(&ray, &line))
            continue; /* no direction */
        for (int i = 0; i < MOST && count < MOST; i++) {
            const oracle_primitive p = extreme_primitive(&r);
            count += oracle_roots(&line, &p, root + count);
        }
        for (int i = 0; i < count; i++)
            for (int j = 0; j < count; j++) {
                const int order = oracle_compare(&root[i], &root[j]);
                const double a = (double)root[i].t, b = (double)root[j].t, apart = a - b;
                assert_int_equal(order, -oracle_compare(&root[j], &root[i]));
                assert_true(i != j || order == 0);
                if (isfinite(apart) && fabs(apart) > 0x1p-40 * (fabs(a) + fabs(b)))
                    assert_int_equal(order, apart < 0 ? -1 : 1);
                pairs += i != j;
                mixed += (root[i].sigma != 0) != (root[j].sigma != 0);
            }
    }
    print_message("%u pairs of roots, %u of a sphere and a triangle\n", (unsigned)pairs, (unsigned)mixed);
    assert_true(pairs > 10 * rounds && mixed > rounds);
}

/* The binary128 oracle that reports doubts finds no wrong answer in this oracle's. */
static void both_oracles_agree(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    test_random r = random_make(8);
    uint64_t doubts = 0;
    uint32_t hits = 0, rays = 0, rounds = 2 + test_scaled(20);
    for (uint32_t round = 0; round < rounds; round++) {
        const box b = {round % 2 ? 0 : 1e3f, 10};
        float sphere[COUNT][4];
        oracle_scene scene = {0};
        for (int i = 0; i < COUNT; i++) {
            random_point(&r, b, sphere[i]);
            sphere[i][3] = random_log(&r, 1e-2f, 4);
        }
        oracle_scene_add_spheres(&scene, 0, (const float(*)[4])sphere, COUNT);
        for (int i = 0; i < 100; i++) {
            const truth_ray ray = random_ray(&r, b, &scene);
            const oracle_hit hit = oracle_trace(&scene, &ray);
            const float t = hit.index == ORACLE_NONE ? INFINITY : (float)hit.t;
            const truth_scene plain = {(const float(*)[4])sphere, COUNT};
            const char *wrong = truth_judge(&plain, &ray, hit.index, t, &doubts);
            if (wrong)
                fail_msg("%s: sphere %u, t %a", wrong, (unsigned)hit.index, (double)t);
            hits += hit.index != ORACLE_NONE;
            rays++;
        }
        oracle_scene_free(&scene);
    }
    print_message("%llu doubts in %u rays\n", (unsigned long long)doubts, (unsigned)rays);
    assert_true(hits > rays / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_meshes_have_no_holes),
        cmocka_unit_test(first_look_changes_nothing),
        cmocka_unit_test(any_float_will_do),
        cmocka_unit_test(both_oracles_agree),
    };
    test_begin("test_oracle_scenes");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
