/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue grid after a commit: no reference is lost or stored twice, and a recount confirms the statistics.
 * Whether a cell is right is decided in long double, by the definition in queue_grid.h. */
#include "grid/queue_grid_check.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- one grid against its spheres ---- */

static uint32_t cell_of(const cgt_queue_grid *g, const long double p[3])
{
    uint32_t cell = 0;
    for (int a = 0; a < 3; a++) {
        const long double i = floorl((p[a] - g->org[a]) * g->rcell[a]), last = g->resolution[a] - 1;
        cell += (uint32_t)(i < 0 ? 0 : i > last ? last : i) * g->stride[a];
    }
    return cell;
}

static void expect_held(const cgt_queue_grid *g, const float sphere[4], uint32_t prim, const long double p[3])
{
    const uint32_t cell = cell_of(g, p);
    if (!cell_holds(g, cell, prim))
        fail_msg("cell %u has a point of sphere %u (%a %a %a, r %a) and no reference to it", cell, prim,
                 (double)sphere[0], (double)sphere[1], (double)sphere[2], (double)sphere[3]);
}

/* The centre, the six extremes, and random points: on the surface, which extends farthest, and inside. */
static void check_superset(const cgt_queue_grid *g, const float sphere[4], uint32_t prim, test_random *r,
                           uint32_t points)
{
    for (uint32_t k = 0; k < points + 7; k++) {
        long double p[3] = {sphere[0], sphere[1], sphere[2]};
        if (k >= 1 && k < 7)
            p[(k - 1) / 2] += k % 2 ? sphere[3] : -(long double)sphere[3];
        if (k >= 7) {
            float d[3];
            random_direction(r, d);
            const long double length =
                sqrtl((long double)d[0] * d[0] + (long double)d[1] * d[1] + (long double)d[2] * d[2]);
            const long double reach = (k % 4 ? 1 : random_float(r, 0, 1)) * (1 - 0x1p-50L) * sphere[3] / length;
            for (int a = 0; a < 3; a++)
                p[a] += reach * d[a];
        }
        expect_held(g, sphere, prim, p);
    }
}

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

static cgt_research_scene_statistics check_grid(const cgt_scene *scene, const float (*sphere)[4], uint32_t count,
                                                uint64_t stream)
{
    const cgt_research_scene_statistics s = queue_grid_check(scene);
    test_random r = random_make(stream);
    for (uint32_t i = 0; i < count; i++)
        check_superset(&scene->committed_scene.papers->grid, sphere[i], i, &r, count < 100 ? 300 : 20);
    if (count)
        check_large(&scene->committed_scene.papers->grid, sphere, count, s.large_primitives);
    return s;
}

static test_scene_options with_resolution(uint32_t x, uint32_t y, uint32_t z)
{
    return (test_scene_options){.structure = CGT_STRUCTURE_QUEUE_GRID, .resolution = {x, y, z}};
}

/* ---- tests: each runs on every variant, whose kernels fill the grid ---- */

TEST(random_clouds_lose_nothing)
{
    static const uint32_t edge[] = {0, 0, 1, 2, 9, 31, 64};
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        for (uint32_t round = 0; round < test_scaled(variant_is_outer(variant) ? 12 : 4) * CLOUD_KINDS; round++) {
            test_random r = random_make(round);
            const cloud_kind kind = (cloud_kind)(round % CLOUD_KINDS);
            cloud c = cloud_make(&r, kind, random_below(&r, 1200));
            const uint32_t n = edge[random_below(&r, TEST_COUNT(edge))];
            const test_scene_options options =
                with_resolution(n, n ? 1 + random_below(&r, 40) : 0, n ? 1 + random_below(&r, 40) : 0);
            cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])c.sphere, c.count);
            const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])c.sphere, c.count, round);
            if (n)
                assert_memory_equal(s.resolution, options.resolution, sizeof s.resolution);
            cgt_scene_release(scene);
            cloud_free(&c);
        }
    }
}

TEST(coincident_spheres_overflow)
{
    static const uint32_t counts[] = {15, 16, 17, 18, 33, 500};
    float sphere[500][4];
    for (int i = 0; i < 500; i++)
        memcpy(sphere[i], (float[4]){1, 2, 3, 0.5f}, sizeof sphere[i]);
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        const test_scene_options options = with_resolution(1, 1, 1), chosen = with_resolution(0, 0, 0);
        for (size_t k = 0; k < TEST_COUNT(counts); k++) {
            cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])sphere, counts[k]);
            cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])sphere, counts[k], k);
            assert_int_equal(s.references, counts[k]);
            assert_int_equal(s.overflow_references, counts[k] > 16 ? counts[k] - 16 : 0);
            assert_int_equal(s.overflow_cells, counts[k] > 16);
            cgt_scene_release(scene);
            scene = scene_of(context, SCENE_OPTIONS(&chosen), (const float(*)[4])sphere, counts[k]);
            check_grid(scene, (const float(*)[4])sphere, counts[k], k);
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
        const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])sphere, 64, 1);
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
            check_grid(scene, (const float(*)[4])sphere, N, n);
            cgt_scene_release(scene);
        }
    }
}

TEST(flat_and_tiny_extents)
{
    static const float place[][3] = {{0, 0, 0},      {1, 2, 3},          {1e5f, -1e5f, 7},
                                     {1e-30f, 0, 0}, {1e9f, 1e9f, 1e9f}, {-0x1p54f, 0, 0x1p54f}};
    static const float radius[] = {0, 1e-30f, 1e-3f, 1, 1e6f};
    float sphere[40][4];
    test_random r = random_make(5);
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        for (uint32_t k = 0; k < TEST_COUNT(place) * TEST_COUNT(radius) * 4; k++) {
            const float *p = place[k % TEST_COUNT(place)], q = radius[k / TEST_COUNT(place) % TEST_COUNT(radius)];
            const uint32_t flat =
                k / (uint32_t)(TEST_COUNT(place) * TEST_COUNT(radius)); /* axes without extent: 3 is a point */
            for (int i = 0; i < 40; i++) {
                for (uint32_t a = 0; a < 3; a++)
                    sphere[i][a] = p[a] + (a < flat ? 0 : (float)random_below(&r, 5) * (q + 1e-20f));
                sphere[i][3] = q;
            }
            const test_scene_options options = k % 2 ? with_resolution(16, 8, 5) : with_resolution(0, 0, 0);
            cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])sphere, 40);
            scene->is_band = true; /* a grid is looked at as it is, whatever its scale */
            assert_int_equal(cgt_scene_commit(scene), CGT_OK);
            check_grid(scene, (const float(*)[4])sphere, 40, k);
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
            const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])sphere, N, round);
            assert_true(s.large_primitives > 0);
            overflows += s.overflow_references;
            cgt_scene_release(scene);
        }
        assert_true(overflows > 0);
    }
}

/* ---- limits ---- */

/* 16 bits can refer to 65,535 primitives; with one more, references widen to 32 bits, and none is lost. */
TEST(references_widen_beyond_65535)
{
    const uint32_t most = 65535;
    float(*sphere)[4] = malloc((most + 1) * sizeof *sphere);
    assert_non_null(sphere);
    for (uint32_t i = 0; i <= most; i++)
        memcpy(sphere[i], (float[4]){(float)(i % 64), (float)(i / 64 % 64), (float)(i / 4096), 0.3f}, sizeof *sphere);
    FOR_EACH_VARIANT_CONTEXT(context, variant, 2)
    {
        const test_scene_options grid = with_resolution(0, 0, 0);
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&grid), (const float(*)[4])sphere, most);
        for (uint32_t count = most; count <= most + 1; count++) {
            const cgt_spheres spheres = spheres_of((const float(*)[4])sphere, count);
            assert_int_equal(cgt_scene_update_spheres(scene, 0, &spheres), CGT_OK);
            assert_int_equal(cgt_scene_commit(scene), CGT_OK);
            assert_int_equal(research_of(scene).reference_bits, count == most ? 16 : 32);
            for (uint32_t k = 0; k < 64; k++) { /* from inside some of the spheres, among them the last one */
                const uint32_t i = k ? (count - 1) / k : count - 1;
                const truth_ray ray = {{sphere[i][0], sphere[i][1], sphere[i][2]}, {0, 0, -1}, 0, 1};
                assert_int_equal(ray_trace(scene, ray).primitive, i);
            }
        }
        cgt_scene_release(scene);
    }
    free(sphere);
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
        const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])sphere, row[k].count, k);
        assert_int_equal(s.local_store_bytes, 32 * s.cells + 8 * s.overflow_references + 16 * row[k].count);
        assert_int_equal(s.fits_local_store, row[k].fits);
        assert_int_equal(s.fits_local_store, s.local_store_bytes <= (256 - 64) * 1024 && row[k].resolution[0] <= 16 &&
                                                 row[k].resolution[1] <= 16 && row[k].resolution[2] <= 16);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

TEST(largest_resolutions_are_accepted)
{
    static const uint32_t size[][3] = {{1024, 1, 1}, {1, 1024, 1}, {1, 1, 1024}, {1, 1, 1}, {1024, 128, 8}};
    test_random r = random_make(9);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 200);
    cgt_context *context = context_make(1, NULL);
    for (size_t k = 0; k < TEST_COUNT(size); k++) {
        const test_scene_options options = with_resolution(size[k][0], size[k][1], size[k][2]);
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])c.sphere, c.count);
        const cgt_research_scene_statistics s = check_grid(scene, (const float(*)[4])c.sphere, c.count, k);
        assert_memory_equal(s.resolution, size[k], sizeof s.resolution);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
    cloud_free(&c);
}

SEEDED_SUITE("test_queue_grid", NULL, NULL)
