/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles in the queue grid after a commit: every cell that a triangle touches refers to it once, as clipping the
 * triangle to the cell's closed box decides, and few other cells do. A recount confirms 32-bit references, overflow
 * and statistics. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/valid_primitive.h"
#include "support/suite.h"
#include "grid/queue_grid_check.h"
#include "primitive/triangle_scenes.h"

/* ---- a triangle and a cell, in grid space ---- */

typedef struct polygon {
    int count;
    double p[12][3];
} polygon;

/* Clips a polygon to sign * p[axis] >= sign * plane (Sutherland and Hodgman). */
static void clip(polygon *q, int axis, double sign, double plane)
{
    polygon clipped = {0};
    for (int i = 0; i < q->count; i++) {
        const double *a = q->p[i], *b = q->p[(i + 1) % q->count];
        const double da = sign * (a[axis] - plane), db = sign * (b[axis] - plane);
        if (da >= 0)
            memcpy(clipped.p[clipped.count++], a, sizeof clipped.p[0]);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            double *p = clipped.p[clipped.count++];
            for (int k = 0; k < 3; k++)
                p[k] = a[k] + (b[k] - a[k]) * (da / (da - db));
            p[axis] = plane;
        }
    }
    *q = clipped;
}

/* Cells at the boundary of the grid extend beyond it. */
static bool touches(const cgt_queue_grid *g, const polygon *of, const int32_t cell[3], double wider)
{
    polygon q = *of;
    for (int a = 0; a < 3; a++) {
        if (cell[a] > 0)
            clip(&q, a, 1, cell[a] - wider);
        if (cell[a] + 1 < (int32_t)g->resolution[a])
            clip(&q, a, -1, cell[a] + 1 + wider);
    }
    return q.count > 0;
}

static polygon in_grid_space(const cgt_queue_grid *g, const triangle t)
{
    polygon q = {.count = 3};
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            q.p[k][a] = ((double)t[k][a] - (double)g->org[a]) * (double)g->rcell[a];
    return q;
}

static int32_t clamped(double g, uint32_t resolution)
{
    return (int32_t)fmin(fmax(floor(g), 0), (double)resolution - 1);
}

/* Every cell that the triangle touches refers to it once, and no cell refers to it twice. Returns how many cells it
 * touches, or nearly touches within the grid's error bound. */
static uint64_t check_triangle(const cgt_queue_grid *g, const triangle t, uint32_t prim)
{
    const polygon q = in_grid_space(g, t);
    int32_t low[3], high[3], cell[3];
    uint64_t near = 0;
    for (int a = 0; a < 3; a++) { /* one more cell on each side, for vertices on a boundary */
        low[a] = clamped(fmin(q.p[0][a], fmin(q.p[1][a], q.p[2][a])) - 1, g->resolution[a]);
        high[a] = clamped(fmax(q.p[0][a], fmax(q.p[1][a], q.p[2][a])) + 1, g->resolution[a]);
    }
    for (cell[2] = low[2]; cell[2] <= high[2]; cell[2]++)
        for (cell[1] = low[1]; cell[1] <= high[1]; cell[1]++)
            for (cell[0] = low[0]; cell[0] <= high[0]; cell[0]++) {
                const uint32_t at =
                    (uint32_t)cell[0] + (uint32_t)cell[1] * g->stride[1] + (uint32_t)cell[2] * g->stride[2];
                if (!cell_holds(g, at, prim) && touches(g, &q, cell, 0))
                    fail_msg("cell %d %d %d does not refer to triangle %u", cell[0], cell[1], cell[2], prim);
                near +=
                    touches(g, &q, cell, 0x1p-18 + 2 * g->cell_error[0] + 2 * g->cell_error[1] + 2 * g->cell_error[2]);
            }
    return near;
}

/* ---- scenes ---- */

static cgt_scene *gridded(cgt_context *context, const uint32_t resolution[3], const triangle *t, uint32_t count)
{
    test_scene_options options = {0};
    options.structure = CGT_STRUCTURE_QUEUE_GRID;
    if (resolution)
        memcpy(options.resolution, resolution, sizeof options.resolution);
    return scene_of_triangles(context, SCENE_OPTIONS(&options), t, count);
}

/* Checks all triangles, which must have an area, or every step-th one; *near gets the number of cells that they nearly
 * touch. */
static cgt_research_scene_statistics check_scene(const cgt_scene *scene, const triangle *t, uint32_t count,
                                                 uint32_t step, uint64_t *near)
{
    const cgt_research_scene_statistics s = queue_grid_check(scene);
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(st.triangles, count);
    assert_int_equal(st.skipped_not_finite + st.skipped_degenerate, 0);
    *near = 0;
    for (uint32_t i = 0; i < count; i += step)
        *near += check_triangle(&scene->committed_scene.papers->grid, t[i], i);
    return s;
}

typedef enum soup { SMALL, MIXED, NEEDLES, FLAT, LATTICE, FAR_OFF, SOUPS } soup;

/* Random triangles in a box of edge 8. */
static void make_soup(test_random *r, soup kind, uint32_t count, triangle *t)
{
    const float offset = kind == FAR_OFF ? 1e5f : 0;
    for (uint32_t i = 0; i < count; i++) {
        const float size = kind == SMALL ? 0.2f : kind == LATTICE ? 2 : random_log(r, 1e-2f, 10);
        float middle[3], along[3];
        random_direction(r, along);
        for (int a = 0; a < 3; a++)
            middle[a] = random_float(r, -4, 4) + offset;
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++) {
                t[i][k][a] = middle[a] + random_float(r, -1, 1) * size;
                if (kind == NEEDLES)
                    t[i][k][a] = middle[a] + along[a] * size * (float)(k - 1) + random_float(r, -1e-3f, 1e-3f);
                if (kind == LATTICE)
                    t[i][k][a] = rintf(t[i][k][a]);
            }
        for (int k = 0; k < 3 && kind == FLAT; k++)
            t[i][k][i % 3] = rintf(middle[i % 3]);
        const cgt_triangle q = {{{t[i][0][0], t[i][0][1], t[i][0][2]},
                                 {t[i][1][0], t[i][1][1], t[i][1][2]},
                                 {t[i][2][0], t[i][2][1], t[i][2][2]}}};
        if (!cgt_triangle_has_area(&q))
            i--;
    }
}

/* ---- tests: each runs on every variant, whose kernels fill the grid ---- */

TEST(random_soups_lose_nothing)
{
    static const uint32_t edge[] = {0, 0, 1, 2, 8, 16, 31};
    enum { MOST = 600 };
    static triangle t[MOST];
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        for (uint32_t round = 0; round < (1 + test_scaled(variant_is_outer(variant) ? 4 : 1)) * SOUPS; round++) {
            test_random r = random_make(round);
            const uint32_t count = 1 + random_below(&r, MOST), n = edge[random_below(&r, TEST_COUNT(edge))];
            const uint32_t across = 1 + random_below(&r, 32), resolution[3] = {n, n ? across : 0, n ? n : 0};
            uint64_t near;
            make_soup(&r, (soup)(round % SOUPS), count, t);
            cgt_scene *scene = gridded(context, resolution, (const triangle *)t, count);
            const cgt_research_scene_statistics s = check_scene(scene, (const triangle *)t, count, 1, &near);
            assert_true(s.references >= count);
            cgt_scene_release(scene);
        }
    }
}

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
            const uint32_t resolution[3] = {24, 40, 32};
            uint64_t near;
            for (uint32_t i = 0; i < COUNT; i++)
                for (int k = 0; k < 9; k++)
                    t[i][k / 3][k % 3] = random_float(&r, -10, 10);
            cgt_scene *scene = gridded(context, resolution, (const triangle *)t, COUNT);
            const cgt_research_scene_statistics s = check_scene(scene, (const triangle *)t, COUNT, 1, &near);
            assert_true(s.large_primitives >= COUNT - 2);
            references += s.references;
            touched += near;
            for (uint32_t i = 0; i < COUNT; i++) {
                const polygon q = in_grid_space(&scene->committed_scene.papers->grid, (const float(*)[3])t[i]);
                double cells = 1;
                for (int a = 0; a < 3; a++)
                    cells *=
                        1 + fmax(q.p[0][a], fmax(q.p[1][a], q.p[2][a])) - fmin(q.p[0][a], fmin(q.p[1][a], q.p[2][a]));
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

TEST(coincident_triangles_overflow)
{
    static const uint32_t counts[] = {16, 17, 18, 40, 300}, one[3] = {1, 1, 1}, many[3] = {5, 7, 6};
    static triangle t[300];
    for (int i = 0; i < 300; i++)
        memcpy(t[i], (const triangle){{0, 0, 0}, {3, 1, 0.5f}, {1, 4, 2}}, sizeof t[i]);
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        for (size_t k = 0; k < TEST_COUNT(counts); k++) {
            uint64_t near;
            cgt_scene *scene = gridded(context, one, (const triangle *)t, counts[k]);
            cgt_research_scene_statistics s = check_scene(scene, (const triangle *)t, counts[k], 1, &near);
            assert_int_equal(s.references, counts[k]);
            assert_int_equal(s.overflow_references, counts[k] - 16);
            assert_int_equal(s.overflow_cells, counts[k] > 16);
            cgt_scene_release(scene);
            scene = gridded(context, many, (const triangle *)t, counts[k]);
            s = check_scene(scene, (const triangle *)t, counts[k], 1, &near);
            assert_true(s.large_primitives == counts[k]);
            assert_int_equal(s.overflow_references % (counts[k] > 16 ? counts[k] - 16 : 1), 0);
            assert_true((s.overflow_references > 0) == (counts[k] > 16));
            cgt_scene_release(scene);
        }
    }
}

TEST(references_widen_beyond_65535)
{
    const uint32_t most = 65535, counts[] = {most, most + 1, most + 4000};
    triangle *t = malloc((size_t)(most + 4000) * sizeof *t);
    test_random r = random_make(200);
    assert_non_null(t);
    make_soup(&r, SMALL, most + 4000, t);
    for (uint32_t i = 0; i < 40; i++) /* at one position, with some of the highest numbers: wide queues overflow */
        memcpy(t[i % 2 ? most + 3999 - i : 100 * i], t[7], sizeof *t);
    FOR_EACH_VARIANT_CONTEXT(context, variant, 2)
    {
        for (size_t k = 0; k < TEST_COUNT(counts); k++) {
            uint64_t near;
            cgt_scene *scene = gridded(context, NULL, (const triangle *)t, counts[k]);
            const cgt_research_scene_statistics s =
                check_scene(scene, (const triangle *)t, counts[k], k ? 7 : 61, &near);
            check_triangle(&scene->committed_scene.papers->grid, (const float(*)[3])t[counts[k] - 1], counts[k] - 1);
            assert_true(s.overflow_references > 0);
            cgt_scene_release(scene);
        }
    }
    free(t);
}

/* Cell boundaries at integers: triangles that lie in them, and triangles with vertices on them. */
TEST(triangles_in_cell_boundaries)
{
    enum { COUNT = 200 };
    static triangle t[COUNT];
    test_random r = random_make(300);
    make_soup(&r, LATTICE, COUNT, t);
    for (uint32_t i = 0; i < COUNT; i += 3) { /* half of a square in a plane */
        const int a = (int)(i / 3 % 3), b = (a + 1) % 3;
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                t[i][k][axis] = t[i][0][axis] + (float)((k == 1 && axis == a) || (k == 2 && axis == b));
    }
    FOR_EACH_VARIANT_CONTEXT(context, variant, 1)
    {
        for (uint32_t n = 1; n <= 40; n += n < 14 ? 1 : 5) {
            const uint32_t resolution[3] = {n, n, n};
            uint64_t near;
            cgt_scene *scene = gridded(context, resolution, (const triangle *)t, COUNT);
            check_scene(scene, (const triangle *)t, COUNT, 1, &near);
            cgt_scene_release(scene);
        }
    }
}

SEEDED_SUITE("test_triangle_grid", NULL, NULL)
