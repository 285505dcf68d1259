/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A recount of queue grids: no reference is lost or stored twice. */
#include "exact/valid_primitive.h"
#include "structures/check/structure_check.h"

#include <math.h>
#include <string.h>

/* ---- cells ---- */

static uint32_t reference_at(const cgt_queue_grid *g, uint32_t cell, int i)
{
    if (g->refs_are_32_bits)
        return g->voxel32[cell].reference[i];
    const uint32_t reference = g->voxel[cell].reference[i];
    return reference == CGT_QUEUE_NONE ? CGT_INVALID_ID : reference;
}

/* Whether the cell refers to the primitive; fails the test if it does so twice. */
static bool cell_holds(const cgt_queue_grid *g, uint32_t cell, uint32_t prim)
{
    unsigned found = 0;
    for (int i = 0; i < CGT_QUEUE_LENGTH; i++)
        found += reference_at(g, cell, i) == prim;
    for (uint32_t i = cgt_queue_grid_overflow(g, cell); i < g->overflows && g->overflow[i].cell == cell; i++)
        found += g->overflow[i].reference == prim;
    if (found > 1)
        fail_msg("cell %u holds primitive %u %u times", cell, prim, found);
    return found == 1;
}

/* Queues fill from the front, newest first. Returns how many references a cell's has. */
static int check_queue(const cgt_queue_grid *g, uint32_t cell)
{
    int used = 0;
    while (used < CGT_QUEUE_LENGTH && reference_at(g, cell, used) != CGT_INVALID_ID)
        used++;
    for (int i = 0; i < used; i++)
        assert_true(reference_at(g, cell, i) < (i ? reference_at(g, cell, i - 1) : g->prims->count));
    for (int i = used; i < CGT_QUEUE_LENGTH; i++)
        assert_int_equal(reference_at(g, cell, i), CGT_INVALID_ID);
    return used;
}

/* The overflow list is sorted by cell and holds older references. Returns all references. */
static uint64_t check_order(const cgt_queue_grid *g, uint32_t *overflow_cells)
{
    uint64_t references = g->overflows;
    *overflow_cells = 0;
    for (uint32_t cell = 0; cell < g->cells; cell++) {
        const int used = check_queue(g, cell);
        const uint32_t first = cgt_queue_grid_overflow(g, cell);
        references += (uint64_t)used;
        if (first == g->overflows)
            continue;
        assert_int_equal(used, CGT_QUEUE_LENGTH);
        ++*overflow_cells;
        for (uint32_t i = first; i < g->overflows && g->overflow[i].cell == cell; i++)
            assert_true(g->overflow[i].reference < reference_at(g, cell, CGT_QUEUE_LENGTH - 1));
    }
    for (uint32_t i = 1; i < g->overflows; i++)
        assert_true(g->overflow[i].cell >= g->overflow[i - 1].cell);
    return references;
}

/* ---- spheres, by the definition in queue_grid.h ---- */

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
static void check_sphere(const cgt_queue_grid *g, const cgt_sphere *q, uint32_t prim, test_random *r, uint32_t points)
{
    const float sphere[4] = {q->x, q->y, q->z, q->r};
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

/* ---- triangles, in grid space ---- */

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

void queue_grid_corners(const cgt_queue_grid *grid, const float corner[3][3], double at[3][3])
{
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            at[k][a] = ((double)corner[k][a] - (double)grid->org[a]) * (double)grid->rcell[a];
}

static int32_t clamped(double g, uint32_t resolution)
{
    return (int32_t)fmin(fmax(floor(g), 0), (double)resolution - 1);
}

/* Returns how many cells the triangle touches, or nearly touches within the grid's error bound. */
static uint64_t check_triangle(const cgt_queue_grid *g, const cgt_triangle *t, uint32_t prim)
{
    polygon q = {.count = 3};
    int32_t low[3], high[3], cell[3];
    uint64_t near = 0;
    queue_grid_corners(g, t->v, q.p);
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

/* ---- the grid ---- */

static uint64_t check_primitives(const cgt_committed_scene *w, uint32_t step)
{
    const cgt_queue_grid *g = &w->papers->grid;
    test_random r = random_make(w->prims.count);
    uint64_t near = 0;
    for (uint32_t prim = 0; prim < w->prims.count; prim += step) {
        const cgt_primitive q = cgt_primitives_get(&w->prims, prim);
        if (cgt_primitive_check(&q) != CGT_PRIMITIVE_VALID)
            continue;
        if (q.kind == CGT_KIND_SPHERES)
            check_sphere(g, &q.sphere, prim, &r, w->prims.count < 100 ? 300 : 20);
        else
            near += check_triangle(g, &q.triangle, prim);
    }
    return near;
}

cgt_research_scene_statistics queue_grid_check(const cgt_scene *scene, uint32_t step, uint64_t *near)
{
    const cgt_research_scene_statistics s = research_of(scene);
    const cgt_paper_structures *papers = scene->committed_scene.papers;
    uint64_t references = 0;
    uint32_t overflow_cells = 0;
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(st.structure, CGT_STRUCTURE_QUEUE_GRID);
    assert_int_equal((uint64_t)s.resolution[0] * s.resolution[1] * s.resolution[2], s.cells);
    *near = papers ? check_primitives(&scene->committed_scene, step) : 0;
    if (papers) {
        references = check_order(&papers->grid, &overflow_cells);
        assert_int_equal(s.reference_bits, st.primitives > CGT_QUEUE_MAX_REFS16 ? 32 : 16);
    }
    assert_int_equal(s.references, references);
    assert_int_equal(s.overflow_references, papers ? papers->grid.overflows : 0);
    assert_int_equal(s.overflow_cells, overflow_cells);
    return s;
}
