/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A loose grid against its contract (loose_grid.h), decided in exact arithmetic. It is of items: primitives, or
 * clusters of triangles by their boxes. */
#include "exact/valid_primitive.h"
#include "structures/check/structure_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/triangle_cluster.h"
#include "support/oracle/dyadic.h"

/* ---- one level ---- */

static uint32_t items_of(const cgt_committed_scene *w)
{
    return w->cluster ? cgt_clusters(w->prims.count) : w->prims.count;
}

static bool is_item_valid(const cgt_committed_scene *w, uint32_t item)
{
    const cgt_primitive q = cgt_primitives_get(&w->prims, w->cluster ? 0 : item);
    return w->cluster ? w->cluster[item].valid != 0 : cgt_primitive_check(&q) == CGT_PRIMITIVE_VALID;
}

static uint32_t valid_items(const cgt_committed_scene *w)
{
    uint32_t valid = 0;
    for (uint32_t item = 0; item < items_of(w); item++)
        valid += is_item_valid(w, item);
    return valid;
}

static void bounds_of(const cgt_committed_scene *w, uint32_t item, dyadic low[3], dyadic high[3])
{
    const cgt_primitive q = cgt_primitives_get(&w->prims, w->cluster ? 0 : item);
    const bool around = w->cluster || q.kind == CGT_KIND_SPHERES;
    const float center[3] = {q.sphere.x, q.sphere.y, q.sphere.z};
    for (int a = 0; a < 3; a++) {
        if (around) {
            const dyadic c = dyadic_of_float(w->cluster ? w->cluster[item].middle[a] : center[a]);
            const dyadic r = dyadic_of_float(w->cluster ? w->cluster[item].half[a] : q.sphere.r);
            low[a] = dyadic_sub(&c, &r);
            high[a] = dyadic_add(&c, &r);
        } else if (q.kind == CGT_KIND_CAPSULES) {
            const dyadic least = dyadic_of_float(fminf(q.capsule.p[a], q.capsule.q[a])),
                         most = dyadic_of_float(fmaxf(q.capsule.p[a], q.capsule.q[a])),
                         r = dyadic_of_float(q.capsule.r);
            low[a] = dyadic_sub(&least, &r);
            high[a] = dyadic_add(&most, &r);
        } else {
            const float s = q.triangle.v[0][a], t = q.triangle.v[1][a], u = q.triangle.v[2][a];
            low[a] = dyadic_of_float(fminf(s, fminf(t, u)));
            high[a] = dyadic_of_float(fmaxf(s, fmaxf(t, u)));
        }
    }
}

/* Returns the largest half extent; half gets all three, rounded. */
static double halves_of(const cgt_committed_scene *w, uint32_t item, double half[3])
{
    dyadic low[3], high[3];
    double size = 0;
    bounds_of(w, item, low, high);
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
        assert_true(begin <= end);
        for (uint32_t i = begin; i < end; i++) {
            const uint32_t prim = w->loose.prim[i];
            dyadic low[3], high[3];
            double half[3];
            assert_true(prim < items_of(w) && (i == begin || prim > w->loose.prim[i - 1]));
            assert_int_equal(seen[prim]++, 0);
            bounds_of(w, prim, low, high);
            if (!within_reach(level, cell, low, high))
                fail_msg("primitive %u is out of reach of cell %u %u %u", prim, cell[0], cell[1], cell[2]);
            const double size = halves_of(w, prim, half);
            f->largest = fmax(f->largest, size);
            f->smallest = fmin(f->smallest, size);
            for (int a = 0; a < 3; a++)
                f->half[a] = fmax(f->half[a], half[a]);
            f->prims++;
        }
    }
    for (uint32_t i = w->loose.start[level->first]; i < w->loose.start[level->first + cells]; i++) {
        double half[3];
        f->guests += halves_of(w, w->loose.prim[i], half) + rounding_of(w) < f->largest * (0.25 - 0x1p-20);
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

/* ---- the grid ---- */

static void check_grid(const cgt_scene *scene)
{
    const cgt_committed_scene *w = &scene->committed_scene;
    const cgt_loose_grid *g = &w->loose;
    uint8_t *seen = calloc(items_of(w) + 1, 1);
    level_found found[CGT_LOOSE_LEVELS];
    uint32_t cells = 0;
    double most = INFINITY;
    const bool requested = scene->options.research->resolution[0]; /* one level, however good */
    assert_non_null(seen);
    assert_int_equal(w->structure, CGT_STRUCTURE_LOOSE_GRID);
    assert_true(g->levels >= 1 && g->levels <= CGT_LOOSE_LEVELS);
    assert_int_equal(g->start[0], 0);
    assert_int_equal(g->start[g->cells], valid_items(w));
    for (uint32_t k = 0; k < g->levels; k++) {
        const cgt_loose_level *level = &g->level[k];
        assert_int_equal(level->first, cells);
        cells += level->size[0] * level->size[1] * level->size[2];
        find_level(w, level, seen, &found[k]);
        if (!requested)
            check_level(level, &found[k], k + 1 == g->levels, rounding_of(w));
        assert_true(k + 1 < g->levels || level->least == 0);
        assert_true(found[k].largest <= most * (1 + 0x1p-20) + rounding_of(w));
        most = level->has_region ? most : level->least; /* others take what a region's level leaves */
    }
    assert_int_equal(cells, g->cells);
    assert_true(cells <= valid_items(w) / 2 + 64 || requested);
    for (uint32_t item = 0; item < items_of(w); item++)
        assert_int_equal(seen[item], is_item_valid(w, item));
    free(seen);
}

static void check_statistics(const cgt_scene *scene)
{
    const cgt_loose_grid *g = &scene->committed_scene.loose;
    const uint32_t valid = valid_items(&scene->committed_scene);
    const cgt_research_scene_statistics research = research_of(scene);
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(st.structure, CGT_STRUCTURE_LOOSE_GRID);
    assert_int_equal(research.cells, g->cells);
    assert_int_equal(research.levels, g->levels);
    assert_int_equal(research.references, valid);
    const uint64_t clusters = scene->committed_scene.cluster ? items_of(&scene->committed_scene) : 0;
    assert_int_equal(st.structure_bytes, 4 * ((uint64_t)g->cells + 1 + valid) + clusters * sizeof(cgt_cluster));
    assert_memory_equal(research.resolution, g->level[g->levels - 1].size, sizeof research.resolution);
    assert_non_null(strstr(st.reason, "loose grid"));
    assert_true(st.bytes >= st.structure_bytes);
}

void loose_grid_check(const cgt_scene *scene)
{
    check_grid(scene);
    check_statistics(scene);
}

uint32_t loose_level_check(const cgt_committed_scene *committed_scene, const cgt_loose_level *level)
{
    uint8_t *seen = calloc(items_of(committed_scene) + 1, 1);
    level_found found;
    assert_non_null(seen);
    find_level(committed_scene, level, seen, &found);
    free(seen);
    return found.prims;
}
