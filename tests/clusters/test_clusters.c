/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Clusters of a mesh's triangles (triangle_cluster.h): which scenes get them, and that their boxes bound the triangles
 * tightly. What structures make of them test_structure_contracts checks, as test_structure_contracts_clusters; hits are
 * those of tests/driver, profile `sheets`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exact/valid_primitive.h"
#include "model/triangle_cluster.h"
#include "scene/scene.h"
#include "structures/scenes/rolled_sheet.h"
#include "support/scenes.h"
#include "support/suite.h"

#define LEAST 8192u /* fewest triangles that get clusters */
#define PARTS 5u    /* maximum number of geometries */

/* A geometry, in separate memory that ends where its arrays do. */
typedef struct part {
    cgt_triangles triangles;
    uint32_t first; /* triangle */
    float *vertex;
    uint32_t *index;
} part;

typedef struct mesh {
    uint32_t count, parts;
    float (*triangle)[3][3]; /* of all parts */
    part part[PARTS];
} mesh;

static const uint32_t uneven[PARTS] = {1, 7, 9, 4099, 6003};

static const cgt_scene_options automatic = {.structure = CGT_STRUCTURE_AUTO};
static const cgt_scene_options loose_grid = {.structure = CGT_STRUCTURE_LOOSE_GRID};
static const cgt_scene_options bvh = {.structure = CGT_STRUCTURE_BVH};
static const cgt_scene_options kd_tree = {.structure = CGT_STRUCTURE_KD};

/* ---- meshes ---- */

/* form: with or without indices, with or without gaps in the arrays. */
static void part_make(part *p, uint32_t first, uint32_t count, uint32_t form)
{
    const bool indexed = form % 2, gaps = form / 2 % 2;
    const size_t vertex = gaps ? 20 : 12, index = gaps ? 16 : 12;
    p->first = first;
    p->vertex = malloc((3 * count - 1) * vertex + 3 * sizeof(float));
    p->index = indexed ? malloc((count - 1) * index + 3 * sizeof(uint32_t)) : NULL;
    assert_true(p->vertex && (p->index || !indexed));
    p->triangles = (cgt_triangles){.count = count,
                                   .indices = cgt_uint32s(p->index, indexed ? index : 0),
                                   .vertex_count = 3 * count,
                                   .vertices = cgt_floats(p->vertex, vertex)};
}

static mesh mesh_make(const uint32_t *counts, uint32_t parts, uint32_t form)
{
    mesh m = {.parts = parts};
    for (uint32_t k = 0; k < parts; k++) {
        part_make(&m.part[k], m.count, counts[k], form + k);
        m.count += counts[k];
    }
    m.triangle = malloc(m.count * sizeof *m.triangle);
    assert_non_null(m.triangle);
    rolled_sheet(m.triangle, m.count, 0);
    return m;
}

static mesh mesh_of(uint32_t count, uint32_t form) { return mesh_make(&count, 1, form); }

static void mesh_free(mesh *m)
{
    for (uint32_t k = 0; k < m->parts; k++) {
        free(m->part[k].vertex);
        free(m->part[k].index);
    }
    free(m->triangle);
}

static uint32_t *index_at(const part *p, uint32_t i)
{
    return (uint32_t *)(void *)((char *)p->index + i * p->triangles.indices.stride);
}

/* Stores the triangles in the arrays, with indices from the last vertex to the first. */
static void mesh_store(const mesh *m)
{
    for (const part *p = m->part; p < m->part + m->parts; p++)
        for (uint32_t i = 0; i < p->triangles.count; i++)
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t at = p->index ? 3 * (p->triangles.count - i) - 1 - k : 3 * i + k;
                memcpy((char *)p->vertex + at * p->triangles.vertices.stride, m->triangle[p->first + i][k],
                       3 * sizeof(float));
                if (p->index)
                    index_at(p, i)[k] = at;
            }
}

static void mesh_shuffle(const mesh *m, test_random *r)
{
    for (uint32_t i = m->count - 1; i > 0; i--) {
        const uint32_t k = random_below(r, i + 1);
        float v[3][3];
        memcpy(v, m->triangle[i], sizeof v);
        memcpy(m->triangle[i], m->triangle[k], sizeof v);
        memcpy(m->triangle[k], v, sizeof v);
    }
}

/* ---- scenes ---- */

static void commit(cgt_scene *scene)
{
    if (cgt_scene_commit(scene) != CGT_OK)
        fail_msg("%s", context_message(scene->context));
}

static cgt_scene *committed(cgt_context *context, const cgt_scene_options *options, const mesh *m)
{
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    for (uint32_t k = 0; k < m->parts; k++)
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &m->part[k].triangles), CGT_OK);
    commit(scene);
    return scene;
}

static cgt_scene_statistics statistics_of(const cgt_scene *scene)
{
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    return st;
}

/* The valid triangles of cluster c, one bit each. */
static uint32_t valid_of(const cgt_primitives *o, uint32_t c)
{
    uint32_t valid = 0;
    for (uint32_t k = 0; k < CGT_CLUSTER && c * CGT_CLUSTER + k < o->count; k++) {
        const cgt_triangle q = cgt_primitives_triangle(o, c * CGT_CLUSTER + k);
        valid |= (uint32_t)(cgt_triangle_check(&q) == CGT_PRIMITIVE_VALID) << k;
    }
    return valid;
}

static uint32_t count_used(const cgt_primitives *o)
{
    uint32_t used = 0;
    for (uint32_t c = 0; c < cgt_clusters(o->count); c++)
        used += valid_of(o, c) != 0;
    return used;
}

/* ---- which scenes get clusters ---- */

static cgt_cluster_use use_of(cgt_context *context, const cgt_scene_options *options, const mesh *m)
{
    cgt_scene *scene = committed(context, options, m);
    const cgt_committed_scene *w = &scene->committed_scene;
    const cgt_cluster_use use = !w->cluster          ? CGT_CLUSTERS_NONE
                                : w->bvh_of_clusters ? CGT_CLUSTERS_ALL
                                                     : CGT_CLUSTERS_GRID;
    cgt_scene_release(scene);
    return use;
}

static bool gets_clusters(cgt_context *context, const cgt_scene_options *options, const mesh *m)
{
    return use_of(context, options, m) != CGT_CLUSTERS_NONE;
}

TEST(neighbours_get_clusters)
{
    const cgt_scene_options incoherent = {.rays = CGT_RAY_KIND_INCOHERENT};
    cgt_context *context = context_make(2, NULL);
    mesh m = mesh_of(LEAST, 1);
    for (uint32_t spoiled = 0; spoiled < 2; spoiled++) {
        if (spoiled)
            rolled_sheet_spoil(m.triangle, m.count);
        mesh_store(&m);
        cgt_scene *scene = committed(context, &automatic, &m);
        const cgt_scene_statistics st = statistics_of(scene);
        const uint32_t used = count_used(&scene->committed_scene.prims);
        assert_non_null(scene->committed_scene.cluster);
        assert_int_equal(research_of(scene).references, used);
        assert_int_equal(used == LEAST / CGT_CLUSTER, !spoiled);
        assert_int_equal(st.skipped_not_finite > 0 && st.skipped_degenerate > 0, spoiled);
        assert_non_null(strstr(st.reason, "runs of 8 neighbouring triangles"));
        cgt_scene_release(scene);
        assert_true(gets_clusters(context, &loose_grid, &m));
        assert_true(gets_clusters(context, &bvh, &m));
        assert_true(gets_clusters(context, &incoherent, &m));
    }
    mesh_free(&m);
    cgt_context_release(context);
}

TEST(others_get_no_clusters)
{
    const cgt_research_scene_options resolution = {.resolution = {20, 20, 20}};
    const cgt_scene_options cells = {.structure = CGT_STRUCTURE_LOOSE_GRID, .research = &resolution};
    const cgt_scene_options voxels = {.structure = CGT_STRUCTURE_QUEUE_GRID};
    cgt_context *context = context_make(2, NULL);
    mesh m = mesh_of(LEAST, 0), few = mesh_of(LEAST - 1, 0);
    mesh_store(&m);
    mesh_store(&few);
    assert_false(gets_clusters(context, &automatic, &few));
    assert_false(gets_clusters(context, &bvh, &few));
    assert_false(gets_clusters(context, &cells, &m));
    assert_false(gets_clusters(context, &voxels, &m));
    assert_false(gets_clusters(context, &kd_tree, &m));
    mesh_free(&few);
    mesh_free(&m);
    cgt_context_release(context);
}

/* Loose clusters are used only in grids. */
TEST(loose_clusters_serve_grids)
{
    cgt_context *context = context_make(2, NULL);
    mesh m = mesh_of(LEAST, 0);
    mesh_store(&m);
    assert_int_equal(use_of(context, &automatic, &m), CGT_CLUSTERS_ALL);
    rolled_sheet_loosen(m.triangle, m.count);
    mesh_store(&m);
    assert_int_equal(use_of(context, &automatic, &m), CGT_CLUSTERS_GRID);
    assert_int_equal(use_of(context, &bvh, &m), CGT_CLUSTERS_NONE);
    mesh_free(&m);
    cgt_context_release(context);
}

/* Triangles in random order but for those that the sample takes: the areas of all clusters tell. */
TEST(a_lucky_sample_is_found_out)
{
    enum { COUNT = 8 * LEAST };
    test_random r = random_make(2);
    cgt_context *context = context_make(2, NULL);
    mesh m = mesh_of(COUNT, 0), ordered = mesh_of(COUNT, 0);
    mesh_shuffle(&m, &r);
    for (uint32_t k = 1; k <= 64; k++) { /* as choose_clusters.c does */
        const uint32_t c = (uint32_t)((uint64_t)(k * 0x9e3779b9u) * (COUNT / CGT_CLUSTER) >> 32);
        memcpy(m.triangle[c * CGT_CLUSTER], ordered.triangle[c * CGT_CLUSTER], CGT_CLUSTER * sizeof *m.triangle);
    }
    mesh_store(&m);
    mesh_store(&ordered);
    assert_true(gets_clusters(context, &automatic, &ordered));
    assert_int_equal(use_of(context, &automatic, &m), CGT_CLUSTERS_NONE);
    assert_int_equal(use_of(context, &bvh, &m), CGT_CLUSTERS_NONE);
    mesh_free(&m);
    mesh_free(&ordered);
    cgt_context_release(context);
}

/* One scene whose order is lost and restored, with a sphere for a while: each commit decides anew. */
TEST(each_commit_decides)
{
    const float ball[1][4] = {{0, 0, 0, 0.1f}};
    const cgt_spheres sphere = spheres_of(ball, 1), none = spheres_of(NULL, 0);
    test_random r = random_make(1);
    cgt_context *context = context_make(2, NULL);
    mesh m = mesh_of(LEAST + 5, 0);
    mesh_store(&m);
    cgt_scene *scene = committed(context, &automatic, &m);
    uint32_t id = CGT_INVALID_ID;
    assert_non_null(scene->committed_scene.cluster);
    mesh_shuffle(&m, &r);
    mesh_store(&m);
    commit(scene);
    assert_null(scene->committed_scene.cluster);
    assert_int_equal(research_of(scene).references, LEAST + 5);
    assert_null(strstr(statistics_of(scene).reason, "runs of 8"));
    rolled_sheet(m.triangle, m.count, 0.5);
    mesh_store(&m);
    commit(scene);
    assert_non_null(scene->committed_scene.cluster);
    assert_int_equal(cgt_scene_set_spheres(scene, &id, &sphere), CGT_OK);
    commit(scene);
    assert_null(scene->committed_scene.cluster);
    assert_int_equal(cgt_scene_set_spheres(scene, &id, &none), CGT_OK);
    commit(scene);
    assert_non_null(scene->committed_scene.cluster);
    cgt_scene_release(scene);
    mesh_free(&m);
    cgt_context_release(context);
}

/* In clusters that the decision samples, the first among them, and in others; also in one that is not full. */
TEST(an_index_out_of_range_is_reported)
{
    static const uint32_t at[] = {0, 7, 9, LEAST / 2, LEAST - 1, LEAST + 4};
    cgt_context *context = context_make(2, NULL);
    mesh m = mesh_of(LEAST + 5, 1);
    mesh_store(&m);
    cgt_scene *scene = committed(context, &automatic, &m);
    for (size_t i = 0; i < TEST_COUNT(at); i++) {
        uint32_t *index = index_at(&m.part[0], at[i]) + i % 3;
        const uint32_t before = *index;
        char text[64];
        *index = i % 2 ? UINT32_MAX : m.part[0].triangles.vertex_count;
        assert_int_equal(cgt_scene_commit(scene), CGT_ERROR_INVALID_ARGUMENT);
        snprintf(text, sizeof text, "triangle %u has index %u", at[i], *index);
        assert_non_null(strstr(context_message(context), text));
        *index = before;
        commit(scene);
        assert_non_null(scene->committed_scene.cluster);
    }
    cgt_scene_release(scene);
    mesh_free(&m);
    cgt_context_release(context);
}

/* ---- boxes ---- */

/* Every number is a difference of floats, exact in double up to an error below the rounding of the box itself. */
static void check_box(const cgt_primitives *o, const cgt_cluster *box, uint32_t c)
{
    const uint32_t valid = valid_of(o, c);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    assert_int_equal(box->valid, valid);
    for (uint32_t k = 0; k < CGT_CLUSTER; k++) {
        if (!(valid >> k & 1))
            continue;
        const cgt_triangle q = cgt_primitives_triangle(o, c * CGT_CLUSTER + k);
        for (int i = 0; i < 9; i++) {
            const int a = i % 3;
            const double at = (double)q.v[i / 3][a];
            if (!(fabs(at - (double)box->middle[a]) <= (double)box->half[a]))
                fail_msg("cluster %u: %a along axis %d is not within %a of %a", c, at, a, (double)box->half[a],
                         (double)box->middle[a]);
            low[a] = fmin(low[a], at);
            high[a] = fmax(high[a], at);
        }
    }
    float size = -1;
    for (int a = 0; a < 3 && valid; a++) {
        const double half = (high[a] - low[a]) / 2, rounding = fmax(fabs(low[a]), fabs(high[a])) * 0x1p-24;
        assert_true((double)box->half[a] <= half * (1 + 0x1p-20) + rounding);
        size = fmaxf(size, box->half[a]);
    }
    assert_true(same_bits(box->size, size));
}

TEST(boxes_bound_valid_triangles)
{
    cgt_context *context = context_make(1, NULL);
    for (uint32_t form = 0; form < 4; form++) {
        mesh m = mesh_make(uneven, PARTS, form);
        uint32_t empty = 0;
        rolled_sheet_spoil(m.triangle, m.count);
        mesh_store(&m);
        cgt_scene *scene = committed(context, &automatic, &m);
        const cgt_committed_scene *w = &scene->committed_scene;
        assert_non_null(w->cluster);
        for (uint32_t c = 0; c < cgt_clusters(w->prims.count); c++) {
            check_box(&w->prims, &w->cluster[c], c);
            empty += !w->cluster[c].valid;
        }
        assert_true(empty > 20);
        cgt_scene_release(scene);
        mesh_free(&m);
    }
    cgt_context_release(context);
}

SEEDED_SUITE("test_clusters", NULL, NULL)
