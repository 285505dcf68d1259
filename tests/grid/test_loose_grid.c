/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The loose grid after a commit against its contract (loose_grid.h). Every valid primitive lies in one cell, in
 * ascending order, and within reach of the cell's box, as exact arithmetic decides. Levels hold similar sizes, and
 * the number of cells is as specified. All of it is the same for each variant and any number of threads. */
#include "exact/valid_primitive.h"
#include "support/suite.h"
#include "grid/loose_scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "builders/order/cell_sort.h"
#include "scene/scene.h"
#include "support/oracle/dyadic.h"

static const test_scene_options loose_options = {.structure = CGT_STRUCTURE_LOOSE_GRID};

/* ---- one grid against its primitives ---- */

static void bounds_of(const cgt_primitives *prims, uint32_t prim, dyadic low[3], dyadic high[3])
{
    const cgt_primitive q = cgt_primitives_get(prims, prim);
    const float center[3] = {q.sphere.x, q.sphere.y, q.sphere.z};
    for (int a = 0; a < 3; a++) {
        if (q.kind == CGT_KIND_SPHERES) {
            const dyadic c = dyadic_of_float(center[a]), r = dyadic_of_float(q.sphere.r);
            low[a] = dyadic_sub(&c, &r);
            high[a] = dyadic_add(&c, &r);
        } else {
            const float s = q.triangle.v[0][a], t = q.triangle.v[1][a], u = q.triangle.v[2][a];
            low[a] = dyadic_of_float(fminf(s, fminf(t, u)));
            high[a] = dyadic_of_float(fmaxf(s, fmaxf(t, u)));
        }
    }
}

/* Returns the largest half extent; half gets all three, rounded. */
static double halves_of(const cgt_primitives *prims, uint32_t prim, double half[3])
{
    dyadic low[3], high[3];
    double size = 0;
    bounds_of(prims, prim, low, high);
    for (int a = 0; a < 3; a++) {
        const dyadic extent = dyadic_sub(&high[a], &low[a]);
        half[a] = (double)dyadic_real(&extent) / 2;
        size = fmax(size, half[a]);
    }
    return size;
}

/* Whether bounds lie within low + i cell - reach and low + (i + 1) cell + reach, exactly. */
static bool within_reach(const cgt_loose_level *level, const uint32_t cell[3], const dyadic low[3],
                         const dyadic high[3])
{
    bool within = true;
    for (int a = 0; a < 3; a++) {
        const dyadic first = dyadic_of_float(level->low[a]), edge = dyadic_of_float(level->cell[a]);
        const dyadic reach = dyadic_of_float(level->reach[a]);
        const dyadic i = dyadic_make((int32_t)cell[a], 0), after = dyadic_make((int32_t)cell[a] + 1, 0);
        const dyadic to_low = dyadic_mul(&i, &edge), to_high = dyadic_mul(&after, &edge);
        dyadic begin = dyadic_add(&first, &to_low), end = dyadic_add(&first, &to_high);
        begin = dyadic_sub(&begin, &reach);
        end = dyadic_add(&end, &reach);
        const dyadic below = dyadic_sub(&low[a], &begin), above = dyadic_sub(&end, &high[a]);
        within &= below.sign >= 0 && above.sign >= 0;
    }
    return within;
}

/* The maximum that rounding the centre adds to a half extent. */
static double rounding_of(const cgt_committed_scene *w)
{
    double magnitude = 0;
    for (int a = 0; a < 3; a++)
        magnitude = fmax(magnitude, fmax(fabs((double)w->low[a]), fabs((double)w->high[a])));
    return magnitude * 0x1p-24;
}

/* The primitives of a level, and how many of them are smaller than its class. */
typedef struct level_found {
    uint32_t prims;
    double largest, smallest, half[3];
    uint32_t guests; /* smaller than a quarter of the largest */
} level_found;

static void find_level(const cgt_committed_scene *w, const cgt_loose_level *level, uint8_t *seen, level_found *f)
{
    const uint32_t cells = level->size[0] * level->size[1] * level->size[2];
    *f = (level_found){.smallest = INFINITY};
    for (uint32_t c = 0; c < cells; c++) {
        const uint32_t begin = w->loose.start[level->first + c], end = w->loose.start[level->first + c + 1];
        const uint32_t row = c / level->size[0];
        const uint32_t cell[3] = {c % level->size[0], row % level->size[1], row / level->size[1]};
        assert_true(begin <= end && end <= w->valid);
        for (uint32_t i = begin; i < end; i++) {
            const uint32_t prim = w->loose.prim[i];
            dyadic low[3], high[3];
            double half[3];
            assert_true(prim < w->prims.count && (i == begin || prim > w->loose.prim[i - 1]));
            assert_int_equal(seen[prim]++, 0);
            bounds_of(&w->prims, prim, low, high);
            if (!within_reach(level, cell, low, high))
                fail_msg("primitive %u is out of reach of cell %u %u %u", prim, cell[0], cell[1], cell[2]);
            const double size = halves_of(&w->prims, prim, half);
            f->largest = fmax(f->largest, size);
            f->smallest = fmin(f->smallest, size);
            for (int a = 0; a < 3; a++)
                f->half[a] = fmax(f->half[a], half[a]);
            f->prims++;
        }
    }
    for (uint32_t i = w->loose.start[level->first]; i < w->loose.start[level->first + cells]; i++) {
        double half[3];
        f->guests += halves_of(&w->prims, w->loose.prim[i], half) + rounding_of(w) < f->largest * (0.25 - 0x1p-20);
    }
}

static void check_level(const cgt_loose_level *level, const level_found *f, bool last, double rounding)
{
    const uint32_t hosts = f->prims - f->guests;
    assert_int_equal(f->prims, level->prims);
    assert_true(f->prims > 0 && f->smallest + rounding >= level->least * (1 - 0x1p-20));
    assert_true(last || f->guests <= hosts / 8 + 8);
    for (int a = 0; a < 3; a++) {
        assert_true(level->size[a] >= 1 && level->size[a] <= 1024 && level->cell[a] > 0);
        /* and no wider than necessary */
        assert_true(level->reach[a] <=
                    f->half[a] * (1 + 0x1p-18) + level->cell[a] * (double)level->size[a] * 0x1p-20 + rounding);
        if (level->size[a] > 1)
            assert_true(level->cell[a] >= f->half[a] * 0.49);
    }
}

static void check_grid(const cgt_scene *scene)
{
    const cgt_committed_scene *w = &scene->committed_scene;
    const cgt_loose_grid *g = &w->loose;
    uint8_t *seen = calloc(w->prims.count + 1, 1);
    level_found found[CGT_LOOSE_LEVELS];
    uint32_t cells = 0;
    double most = INFINITY;
    assert_non_null(seen);
    assert_int_equal(w->structure, CGT_STRUCTURE_LOOSE_GRID);
    assert_true(g->levels >= 1 && g->levels <= CGT_LOOSE_LEVELS);
    assert_int_equal(g->start[0], 0);
    assert_int_equal(g->start[g->cells], w->valid);
    for (uint32_t k = 0; k < g->levels; k++) {
        const cgt_loose_level *level = &g->level[k];
        assert_int_equal(level->first, cells);
        cells += level->size[0] * level->size[1] * level->size[2];
        find_level(w, level, seen, &found[k]);
        check_level(level, &found[k], k + 1 == g->levels, rounding_of(w));
        assert_true(k + 1 < g->levels || level->least == 0);
        assert_true(found[k].largest <= most * (1 + 0x1p-20) + rounding_of(w));
        most = level->has_region ? most : level->least; /* others take what a region's level leaves */
    }
    assert_int_equal(cells, g->cells);
    assert_true(cells <= w->valid / 2 + 64);
    for (uint32_t prim = 0; prim < w->prims.count; prim++) {
        const cgt_primitive q = cgt_primitives_get(&w->prims, prim);
        assert_int_equal(seen[prim], cgt_primitive_check(&q) == CGT_PRIMITIVE_VALID);
    }
    free(seen);
}

static void check_statistics(const cgt_scene *scene)
{
    const cgt_loose_grid *g = &scene->committed_scene.loose;
    const cgt_research_scene_statistics research = research_of(scene);
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(st.structure, CGT_STRUCTURE_LOOSE_GRID);
    assert_int_equal(research.cells, g->cells);
    assert_int_equal(research.levels, g->levels);
    assert_int_equal(research.references, scene->committed_scene.valid);
    assert_int_equal(st.structure_bytes, 4 * ((uint64_t)g->cells + 1 + scene->committed_scene.valid));
    assert_memory_equal(research.resolution, g->level[g->levels - 1].size, sizeof research.resolution);
    assert_non_null(strstr(st.reason, "loose grid"));
    assert_true(st.bytes >= st.structure_bytes);
}

static void compare_grids(const cgt_loose_grid *a, const cgt_loose_grid *b, uint32_t prims)
{
    assert_int_equal(a->levels, b->levels);
    assert_int_equal(a->cells, b->cells);
    assert_memory_equal(a->level, b->level, a->levels * sizeof a->level[0]);
    assert_memory_equal(a->start, b->start, (a->cells + 1) * sizeof a->start[0]);
    assert_memory_equal(a->prim, b->prim, prims * sizeof a->prim[0]);
}

/* ---- scenes of every kind ---- */

static cgt_scene *commit(const loose_scene *s, cgt_context *context)
{
    cgt_scene *scene = loose_add(s, context, SCENE_OPTIONS(&loose_options));
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* The grid of the widest variant on one thread is right, and all others are equal. */
static void check_everywhere(const loose_scene *s)
{
    cgt_context *context = context_make(1, NULL);
    cgt_scene *first = commit(s, context);
    const bool built = first->committed_scene.valid > 0;
    assert_false(first->committed_scene.brute_force);
    if (built) {
        check_grid(first);
        check_statistics(first);
    }
    FOR_EACH_VARIANT(variant)
    for (uint32_t threads = 1; threads <= 5; threads += threads) {
        cgt_context *other = context_make(threads == 4 ? 5 : threads, variant);
        cgt_scene *scene = commit(s, other);
        if (built)
            compare_grids(&first->committed_scene.loose, &scene->committed_scene.loose, first->committed_scene.valid);
        cgt_scene_release(scene);
        cgt_context_release(other);
    }
    cgt_scene_release(first);
    cgt_context_release(context);
}

TEST(every_kind_is_in_reach)
{
    test_random r = random_make(1);
    for (int kind = 0; kind < LOOSE_KINDS; kind++)
        for (int what = LOOSE_SPHERES; what <= LOOSE_BOTH; what++) {
            loose_scene s = loose_make(&r, (loose_kind)kind, (loose_what)what, test_scaled(600) + random_below(&r, 40));
            check_everywhere(&s);
            loose_free(&s);
        }
}

TEST(few_and_none)
{
    test_random r = random_make(2);
    for (uint32_t count = 0; count < 12; count++)
        for (int kind = 0; kind < LOOSE_KINDS; kind++) {
            loose_scene s = loose_make(&r, (loose_kind)kind, LOOSE_BOTH, count);
            check_everywhere(&s);
            loose_free(&s);
        }
}

/* On one thread and on three; with an explicit resolution, too. */
static void compare_sorts(const loose_scene *s, const test_scene_options *options, bool check)
{
    static const uint32_t threads[] = {1, 3};
    cgt_context *context[TEST_COUNT(threads)];
    cgt_scene *scene[TEST_COUNT(threads)];
    for (size_t i = 0; i < TEST_COUNT(threads); i++) {
        context[i] = context_make(threads[i], NULL);
        scene[i] = loose_add(s, context[i], SCENE_OPTIONS(options));
        assert_int_equal(cgt_scene_commit(scene[i]), CGT_OK);
        if (i)
            compare_grids(&scene[0]->committed_scene.loose, &scene[i]->committed_scene.loose,
                          scene[0]->committed_scene.valid);
        if (i && check)
            check_grid(scene[i]);
    }
    for (size_t i = 0; i < TEST_COUNT(threads); i++) {
        cgt_scene_release(scene[i]);
        cgt_context_release(context[i]);
    }
}

/* More primitives than one thread counts at once, and than one bin holds. */
TEST(many_are_sorted)
{
    static const loose_kind kind[] = {LOOSE_UNIFORM, LOOSE_CLUSTERED, LOOSE_COINCIDENT, LOOSE_SPOILED, LOOSE_ORDERS};
    test_random r = random_make(3);
    for (size_t k = 0; k < TEST_COUNT(kind); k++) {
        const uint32_t count =
            k < 2 ? CGT_CELL_SORT_DIRECT_SERIAL + 5003 : 17000 + test_scaled(40000); /* with bins and without */
        loose_scene s = loose_make(&r, kind[k], k % 2 ? LOOSE_BOTH : LOOSE_SPHERES, count);
        test_scene_options options = loose_options;
        compare_sorts(&s, &options, k == 0 || k == 3);
        for (int a = 0; a < 3; a++)
            options.resolution[a] = k % 2 ? 64 : 40;
        compare_sorts(&s, &options, false);
        loose_free(&s);
    }
}

/* Points on the planes between cells and a few ulps off them: rounding puts some of them into the wrong cell, and the
 * reach, which is nothing but rounding error here, must cover that. */
TEST(points_between_cells_are_in_reach)
{
    enum { CELLS = 1024, COUNT = 3 * CELLS };
    static float point[COUNT][4];
    const test_scene_options options = {.structure = CGT_STRUCTURE_LOOSE_GRID, .resolution = {CELLS, 1, 1}};
    test_random r = random_make(9);
    cgt_context *context = context_make(1, NULL);
    uint32_t wrong = 0;
    for (uint32_t round = 0; round < test_scaled(12); round++) {
        const float first = round % 2 ? random_float(&r, -1, 1) : 0, last = first + random_float(&r, 0.01f, 100);
        memset(point, 0, sizeof point);
        for (int i = 0; i < COUNT; i++)
            point[i][0] = i ? last : first;
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])point, COUNT);
        const cgt_loose_level level = scene->committed_scene.loose.level[0];
        for (int i = 1; i < COUNT - 1; i++) {
            float x = (float)(level.low[0] + (double)(i / 3) * level.cell[0]);
            for (uint32_t steps = random_below(&r, 4); steps; steps--)
                x = nextafterf(x, i % 3 ? INFINITY : -INFINITY);
            point[i][0] = fminf(fmaxf(x, first), last);
        }
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_memory_equal(&scene->committed_scene.loose.level[0], &level, sizeof level);
        uint8_t *seen = calloc(COUNT, 1);
        level_found found;
        assert_non_null(seen);
        find_level(&scene->committed_scene, &level, seen, &found);
        assert_int_equal(found.prims, COUNT);
        for (uint32_t c = 0; c < CELLS; c++)
            for (uint32_t i = scene->committed_scene.loose.start[c]; i < scene->committed_scene.loose.start[c + 1];
                 i++) {
                const double g =
                    ((double)point[scene->committed_scene.loose.prim[i]][0] - level.low[0]) / level.cell[0];
                wrong += g < c || g > c + 1.0;
            }
        free(seen);
        cgt_scene_release(scene);
    }
    assert_true(wrong > 0);
    cgt_context_release(context);
}

/* ---- shapes of grids ---- */

/* Clusters that stand apart have levels of their own: see below. */
TEST(cells_follow_the_axes)
{
    test_random r = random_make(4);
    cgt_context *context = context_make(1, NULL);
    const uint32_t count = 4000;
    for (int kind = 0; kind <= LOOSE_LINE; kind++) {
        loose_scene s = loose_make(&r, (loose_kind)kind, LOOSE_SPHERES, count);
        cgt_scene *scene = commit(&s, context);
        const cgt_loose_grid *g = &scene->committed_scene.loose;
        const cgt_loose_level *level = &g->level[0];
        assert_int_equal(g->regions > 0, kind == LOOSE_CLUSTERED);
        if (kind == LOOSE_UNIFORM)
            assert_in_range(g->cells, count / 16, count / 4);
        if (kind != LOOSE_CLUSTERED) {
            assert_int_equal(g->levels, 1);
            assert_int_equal(level->size[0] > 1, kind != LOOSE_LINE);
            assert_true(level->size[1] > 1);
            assert_int_equal(level->size[2] > 1, kind == LOOSE_UNIFORM);
        }
        cgt_scene_release(scene);
        loose_free(&s);
    }
    cgt_context_release(context);
}

/* Points along a line, more than one axis has cells for: the other axes get the rest. */
TEST(a_full_axis_leaves_cells_to_the_others)
{
    enum { COUNT = 20000 };
    test_random r = random_make(5);
    float(*sphere)[4] = malloc(COUNT * sizeof *sphere);
    assert_non_null(sphere);
    for (int i = 0; i < COUNT; i++) {
        sphere[i][0] = random_float(&r, 0, 1e6f);
        sphere[i][1] = random_float(&r, 0, 2e3f);
        sphere[i][2] = 0;
        sphere[i][3] = 0;
    }
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    const cgt_loose_level *level = &scene->committed_scene.loose.level[0];
    assert_int_equal(level->size[0], 1024);
    assert_true(level->size[1] > 1 && scene->committed_scene.loose.cells >= COUNT / 16);
    cgt_scene_release(scene);
    cgt_context_release(context);
    free(sphere);
}

TEST(sizes_share_levels)
{
    enum { COUNT = 900 };
    static float sphere[COUNT][4];
    test_random r = random_make(6);
    cgt_context *context = context_make(1, NULL);
    for (int i = 0; i < COUNT; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, -1, 1);
        sphere[i][3] = i < 300 ? 0.3f : i < 600 ? 1e-3f : 1e-30f; /* three sizes, far apart */
    }
    cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    assert_int_equal(scene->committed_scene.loose.levels, 3);
    cgt_scene_release(scene);
    for (int i = 0; i < COUNT; i++)
        sphere[i][3] = i < 850 ? random_float(&r, 0.3f, 0.59f) : 1e-3f; /* few small spheres: guests */
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    assert_int_equal(scene->committed_scene.loose.levels, 1);
    check_grid(scene);
    cgt_scene_release(scene);
    for (int i = 0; i < COUNT; i++)
        sphere[i][3] = ldexpf(1, -4 * (i % 30)); /* more sizes than levels */
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    assert_int_equal(scene->committed_scene.loose.levels, CGT_LOOSE_SIZE_LEVELS);
    check_grid(scene);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* How many primitives share a cell, as the mean over all of them. */
static double mean_crowd(const cgt_loose_grid *g, uint32_t valid)
{
    double squares = 0;
    for (uint32_t c = 0; c < g->cells; c++)
        squares += pow((double)g->start[c + 1] - g->start[c], 2);
    return squares / valid;
}

/* Moves spheres of an even cloud far away. */
typedef struct crowded_case {
    const char *name;
    uint32_t clusters; /* which stand apart */
    uint32_t strays;
    float distance;
} crowded_case;

static void move_spheres(const crowded_case *c, test_random *r, float (*sphere)[4], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            sphere[i][a] = random_float(r, -1, 1);
            sphere[i][a] += c->clusters && i % c->clusters >> a & 1 ? c->distance : 0;
            sphere[i][a] *= i < c->strays ? c->distance : 1;
        }
    for (uint32_t i = 0; i < count; i++)
        sphere[i][3] = 0.02f;
}

/* A scene whose cells would be crowded, had its grid one size of cells: each crowd gets a level of its own. */
TEST(crowded_regions_get_levels)
{
    enum { COUNT = 3000 };
    static const crowded_case cases[] = {
        {"one stray", 0, 1, 1e3f},
        {"one stray, farther", 0, 1, 1e9f},
        {"one stray, farthest", 0, 1, 1e16f},
        {"many strays", 0, COUNT / 50, 1e5f},
        {"two clusters", 2, 0, 1e4f},
        {"eight clusters", 8, 0, 1e6f},
        {"clusters and strays", 4, 9, 1e5f},
    };
    static float sphere[COUNT][4];
    cgt_context *context = context_make(2, NULL);
    test_random r = random_make(7);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        move_spheres(&cases[i], &r, sphere, COUNT);
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
        const cgt_loose_grid *g = &scene->committed_scene.loose;
        scene->is_band = true; /* the farthest would be put apart */
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        check_grid(scene);
        if (!g->regions || mean_crowd(g, COUNT) > 100)
            fail_msg("%s: %u regions, %g primitives share a cell", cases[i].name, g->regions, mean_crowd(g, COUNT));
        cgt_scene_release(scene);
    }
    memset(sphere, 0, sizeof sphere); /* cells cannot tell these apart */
    cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    scene->is_band = true; /* as small as it is */
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(scene->committed_scene.loose.levels, 1);
    check_grid(scene);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(a_requested_resolution_is_used)
{
    test_random r = random_make(7);
    cgt_context *context = context_make(2, NULL);
    for (int kind = 0; kind < LOOSE_KINDS; kind++) {
        const test_scene_options options = {
            .structure = CGT_STRUCTURE_LOOSE_GRID,
            .resolution = {1 + random_below(&r, 40), 1 + random_below(&r, 40), kind ? 1 + random_below(&r, 9) : 1024}};
        loose_scene s = loose_make(&r, (loose_kind)kind, LOOSE_BOTH, 200);
        cgt_scene *scene = loose_add(&s, context, SCENE_OPTIONS(&options));
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        const cgt_loose_grid *g = &scene->committed_scene.loose;
        assert_int_equal(g->levels, 1);
        assert_memory_equal(g->level[0].size, options.resolution, sizeof options.resolution);
        check_statistics(scene);
        uint8_t *seen = calloc(scene->committed_scene.prims.count, 1);
        level_found found;
        assert_non_null(seen);
        find_level(&scene->committed_scene, &g->level[0], seen, &found);
        assert_int_equal(found.prims, scene->committed_scene.valid);
        free(seen);
        cgt_scene_release(scene);
        loose_free(&s);
    }
    cgt_context_release(context);
}

/* ---- through the interface ---- */

TEST(it_is_used_when_requested)
{
    const float far_off[2][4] = {{0x1p60f, 0, 0, 1}, {0, 0, 0, 1}};
    cgt_context *context = context_make(1, NULL);
    test_scene_options options = {.structure = (cgt_structure)(CGT_STRUCTURE_BIH + 1)};
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&options), &scene), CGT_ERROR_INVALID_ARGUMENT);
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), far_off, 2); /* too far for a structure */
    assert_true(scene->committed_scene.brute_force && !scene->committed_scene.loose.levels);
    cgt_scene_release(scene);
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), far_off, 0);
    assert_false(scene->committed_scene.valid || scene->committed_scene.loose.levels);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_loose_grid", NULL, NULL)
