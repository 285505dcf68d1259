/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue grid after a commit, of scenes made for it: overflow of queues, primitives larger than cells or on their
 * planes, wide references, and the budget of a local store. structure_check.h recounts it. */
#include "structures/check/structure_check.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "primitive/triangle_scenes.h"

/* A context of each variant in turn, while the block runs. */
#define FOR_EACH_VARIANT_CONTEXT(context, variant, threads)                                                            \
    FOR_EACH_VARIANT(variant)                                                                                          \
    for (cgt_context *context = context_make(threads, variant); context; cgt_context_release(context), context = NULL)

/* ---- one grid against its primitives ---- */

/* A sphere larger than two cells along any axis is certainly large; one smaller than a cell along all axes is not. */
static void check_large(const cgt_queue_grid *g, const float (*sphere)[4], uint32_t count, uint32_t large)
{
    uint32_t surely = 0, perhaps = 0;
    for (uint32_t i = 0; i < count; i++) {
        bool wide = false, narrow = true;
        if (!(sphere[i][3] >= 0))
            continue;
        for (int a = 0; a < 3; a++) {
            const double cells = 2.0 * sphere[i][3] * g->rcell[a];
            wide |= cells > 2 && g->resolution[a] > 2;
            narrow &= cells + 2 * g->cell_error[a] < 0.99 || g->resolution[a] <= 2;
        }
        /* at the boundary of the grid a part may be cut off */
        bool inside = true;
        for (int a = 0; a < 3; a++) {
            const double low = ((double)sphere[i][a] - sphere[i][3] - g->org[a]) * g->rcell[a];
            inside &= low >= 0 && low + 2.0 * sphere[i][3] * g->rcell[a] < g->resolution[a];
        }
        surely += wide && inside;
        perhaps += !narrow;
    }
    assert_in_range(large, surely, perhaps);
}

static cgt_research_scene_statistics check_grid(const cgt_scene *scene, const float (*sphere)[4], uint32_t count)
{
    uint64_t near;
    const cgt_research_scene_statistics s = queue_grid_check(scene, 1, &near);
    if (count)
        check_large(&scene->committed_scene.papers->grid, sphere, count, s.large_primitives);
    return s;
}

static test_scene_options with_resolution(uint32_t x, uint32_t y, uint32_t z)
{
    return (test_scene_options){.structure = CGT_STRUCTURE_QUEUE_GRID, .resolution = {x, y, z}};
}

/* ---- spheres: each test runs on every variant, whose kernels fill the grid ---- */

/* Spheres, and triangles, at one place. */
TEST(coincident_primitives_overflow)
{
    static const uint32_t counts[] = {15, 16, 17, 18, 33, 500};
    static float sphere[500][4];
    static triangle t[500];
    for (int i = 0; i < 500; i++) {
        memcpy(sphere[i], (float[4]){1, 2, 3, 0.5f}, sizeof sphere[i]);
        memcpy(t[i], (const triangle){{0, 0, 0}, {3, 1, 0.5f}, {1, 4, 2}}, sizeof t[i]);
    }
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        const test_scene_options one = with_resolution(1, 1, 1), many = with_resolution(5, 7, 6);
        for (size_t k = 0; k < 2 * TEST_COUNT(counts); k++) {
            const uint32_t count = counts[k / 2], more = count > 16 ? count - 16 : 0;
            uint64_t near;
            cgt_scene *scene = k % 2 ? scene_of_triangles(context, SCENE_OPTIONS(&one), (const triangle *)t, count)
                                     : scene_of(context, SCENE_OPTIONS(&one), (const float(*)[4])sphere, count);
            cgt_research_scene_statistics s = queue_grid_check(scene, 1, &near);
            assert_int_equal(s.references, count);
            assert_int_equal(s.overflow_references, more);
            assert_int_equal(s.overflow_cells, more > 0);
            cgt_scene_release(scene);
            if (k % 2 == 0)
                continue;
            scene = scene_of_triangles(context, SCENE_OPTIONS(&many), (const triangle *)t, count);
            s = queue_grid_check(scene, 1, &near);
            assert_int_equal(s.large_primitives, count);
            assert_int_equal(s.overflow_references % (more ? more : 1), 0);
            assert_true((s.overflow_references > 0) == (more > 0));
            cgt_scene_release(scene);
        }
    }
}

TEST(one_sphere_covers_the_grid)
{
    float sphere[64][4];
    test_random r = random_make(3);
    for (int i = 0; i < 64; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, -1, 1);
        sphere[i][3] = 0.01f;
    }
    memcpy(sphere[20], (float[4]){0, 0, 0, 50}, sizeof sphere[20]);
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        const test_scene_options options = with_resolution(40, 24, 16);
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])sphere, 64);
        const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])sphere, 64);
        assert_int_equal(s.large_primitives, 1);
        /* the ball's part of its box is 0.52; cells along its surface come on top */
        assert_in_range(s.references, s.cells / 2, s.cells * 7 / 10);
        cgt_scene_release(scene);
    }
}

TEST(spheres_on_cell_boundaries)
{
    enum { N = 512 };
    float sphere[N][4];
    for (int i = 0; i < N; i++) {
        sphere[i][0] = (float)(i % 8);
        sphere[i][1] = (float)(i / 8 % 8);
        sphere[i][2] = (float)(i / 64);
        sphere[i][3] = (const float[]){0, 0.5f, 1, 0.25f}[i % 4];
    }
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        for (uint32_t n = 1; n <= 36; n += n < 12 ? 1 : 3) {
            const test_scene_options options = with_resolution(n, n, n);
            cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])sphere, N);
            check_grid(scene, (const float(*)[4])sphere, N);
            cgt_scene_release(scene);
        }
    }
}

TEST(radii_of_six_orders)
{
    enum { N = 700 };
    float sphere[N][4];
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        uint64_t overflows = 0;
        for (uint32_t round = 0; round < 6; round++) {
            test_random r = random_make(round);
            const uint32_t n = 8 + 7 * round;
            for (int i = 0; i < N; i++) {
                for (int a = 0; a < 3; a++)
                    sphere[i][a] = random_float(&r, -1000, 1000);
                sphere[i][3] = random_log(&r, 1e-3f, 1e3f);
            }
            const test_scene_options options = round % 2 ? with_resolution(n, n, n) : with_resolution(0, 0, 0);
            cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])sphere, N);
            const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])sphere, N);
            assert_true(s.large_primitives > 0);
            overflows += s.overflow_references;
            cgt_scene_release(scene);
        }
        assert_true(overflows > 0);
    }
}

/* ---- triangles ---- */

/* The cells of the bounding box would be tens of times as many. */
TEST(large_triangles_take_few_unneeded_cells)
{
    enum { COUNT = 24 };
    static triangle t[COUNT];
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        uint64_t references = 0, touched = 0, boxes = 0;
        for (uint32_t round = 0; round < 1 + test_scaled(4); round++) {
            test_random r = random_make(100 + round);
            const test_scene_options options = with_resolution(24, 40, 32);
            uint64_t near;
            for (uint32_t i = 0; i < COUNT; i++)
                for (int k = 0; k < 9; k++)
                    t[i][k / 3][k % 3] = random_float(&r, -10, 10);
            cgt_scene *scene = scene_of_triangles(context, SCENE_OPTIONS(&options), (const triangle *)t, COUNT);
            const cgt_research_scene_statistics s = queue_grid_check(scene, 1, &near);
            assert_true(s.large_primitives >= COUNT - 2);
            references += s.references;
            touched += near;
            for (uint32_t i = 0; i < COUNT; i++) {
                double p[3][3], cells = 1;
                queue_grid_corners(&scene->committed_scene.papers->grid, (const float(*)[3])t[i], p);
                for (int a = 0; a < 3; a++)
                    cells *= 1 + fmax(p[0][a], fmax(p[1][a], p[2][a])) - fmin(p[0][a], fmin(p[1][a], p[2][a]));
                boxes += (uint64_t)cells;
            }
            cgt_scene_release(scene);
        }
        print_message("%s: %llu references, %llu cells touched, %llu in boxes\n", variant,
                      (unsigned long long)references, (unsigned long long)touched, (unsigned long long)boxes);
        assert_true(references <= touched + touched / 50);
        assert_true(boxes > 4 * touched);
    }
}

/* Cell boundaries at integers: triangles that lie in them, and triangles with vertices on them. */
TEST(triangles_in_cell_boundaries)
{
    enum { COUNT = 200 };
    static triangle t[COUNT];
    test_random r = random_make(300);
    for (uint32_t i = 0; i < COUNT; i++) {
        const int a = (int)(i / 3 % 3), b = (a + 1) % 3;
        float corner[3];
        for (int k = 0; k < 9; k++) {
            corner[k % 3] = k < 3 ? (float)random_below(&r, 9) - 4 : corner[k % 3];
            t[i][k / 3][k % 3] = corner[k % 3] + (float)random_below(&r, 4);
        }
        for (int k = 0; i % 3 == 0 && k < 9; k++) /* half of a square in a plane */
            t[i][k / 3][k % 3] = t[i][0][k % 3] + (float)((k / 3 == 1 && k % 3 == a) || (k / 3 == 2 && k % 3 == b));
    }
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        for (uint32_t n = 1; n <= 40; n += n < 14 ? 1 : 5) {
            const test_scene_options options = with_resolution(n, n, n);
            uint64_t near;
            cgt_scene *scene = scene_of_triangles(context, SCENE_OPTIONS(&options), (const triangle *)t, COUNT);
            queue_grid_check(scene, 1, &near);
            cgt_scene_release(scene);
        }
    }
}

/* ---- limits ---- */

/* 16 bits can refer to 65,535 primitives; with one more, references widen to 32 bits, and none is lost. Some of the
 * highest numbers share a place, so that wide queues overflow. */
/* Rays that start next to primitives from all over the array find what they find in another structure. */
static void check_rays(const cgt_scene *scene, const cgt_scene *other, const triangle *t, uint32_t count)
{
    uint32_t hits = 0;
    for (uint32_t i = 0; i < 64; i++) {
        const triangle *q = &t[i ? (count - 1) / i : count - 1];
        truth_ray ray = {.dir = {1, 2, 3}, .t_max = INFINITY};
        for (int a = 0; a < 3; a++)
            ray.org[a] = ((*q)[0][a] + (*q)[1][a] + (*q)[2][a]) / 3 - 0.001f * ray.dir[a];
        const uint32_t primitive = ray_trace(scene, ray).primitive;
        assert_int_equal(primitive, ray_trace(other, ray).primitive);
        hits += primitive > 65535 && primitive != CGT_INVALID_ID;
    }
    assert_true(hits > 0 || count <= 65536);
}

TEST(references_widen_beyond_65535)
{
    const uint32_t most = 65535;
    triangle *t = malloc((size_t)(most + 4000) * sizeof *t);
    test_random r = random_make(200);
    assert_non_null(t);
    random_triangles(&r, 0.05f, t, most + 4000);
    for (uint32_t i = 0; i < 40; i++)
        memcpy(t[i % 2 ? most + 3999 - i : 100 * i], t[7], sizeof *t);
    FOR_EACH_VARIANT_CONTEXT(context, variant, 2)
    {
        const test_scene_options grid = with_resolution(0, 0, 0);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t count = k == 2 ? most + 4000 : most + k;
            uint64_t near;
            cgt_scene *scene = scene_of_triangles(context, SCENE_OPTIONS(&grid), (const triangle *)t, count);
            const cgt_research_scene_statistics s = queue_grid_check(scene, test_samples() ? 997 : k ? 7 : 61, &near);
            assert_int_equal(s.reference_bits, k ? 32 : 16);
            assert_true(s.overflow_references > 0);
            cgt_scene *other = scene_of_triangles(context, NULL, (const triangle *)t, count);
            check_rays(scene, other, (const triangle *)t, count);
            cgt_scene_release(other);
            cgt_scene_release(scene);
        }
    }
    free(t);
}

TEST(local_store_budget)
{
    enum { N = 2000 };
    static const struct {
        uint32_t resolution[3], count;
        int fits;
    } row[] = {{{16, 16, 16}, N, 1}, {{17, 16, 16}, N, 0}, {{16, 17, 16}, N, 0},   {{16, 16, 17}, N, 0},
               {{17, 1, 1}, 10, 0},  {{8, 8, 8}, N, 1},    {{16, 16, 16}, 5000, 0}};
    float sphere[5000][4];
    test_random r = random_make(8);
    for (int i = 0; i < 5000; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, 0, 16);
        sphere[i][3] = 0.1f;
    }
    cgt_context *context = context_make(1, NULL);
    for (size_t k = 0; k < TEST_COUNT(row); k++) {
        const test_scene_options options =
            with_resolution(row[k].resolution[0], row[k].resolution[1], row[k].resolution[2]);
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])sphere, row[k].count);
        const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])sphere, row[k].count);
        assert_int_equal(s.local_store_bytes, 32 * s.cells + 8 * s.overflow_references + 16 * row[k].count);
        assert_int_equal(s.fits_local_store, row[k].fits);
        assert_int_equal(s.fits_local_store, s.local_store_bytes <= (256 - 64) * 1024 && row[k].resolution[0] <= 16 &&
                                                 row[k].resolution[1] <= 16 && row[k].resolution[2] <= 16);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

SEEDED_SUITE("test_queue_grid", NULL, NULL)
