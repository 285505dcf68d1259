/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Builds and changes the meshes of cluster_meshes.h. */
#include "clusters/cluster_meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COLUMNS 64u /* squares per row */

const uint32_t uneven[PARTS] = {1, 7, 9, 4099, 6003};

const cgt_scene_options automatic = {.structure = CGT_STRUCTURE_AUTO};
const cgt_scene_options loose_grid = {.structure = CGT_STRUCTURE_LOOSE_GRID};
const cgt_scene_options bvh = {.structure = CGT_STRUCTURE_BVH};
const cgt_scene_options kd_tree = {.structure = CGT_STRUCTURE_KD};

/* ---- meshes ---- */

/* A wavy sheet, rolled up, so that it shows several layers from any direction; rows run along the roll, and squares
 * grow from row to row and along each row. */
static void point_at(uint32_t column, uint32_t row, uint32_t rows, double phase, float p[3])
{
    const double s = (double)row / rows, t = (double)column / COLUMNS;
    const double angle = 9 * s * (0.2 + 0.8 * s) + phase, radius = 0.35 + 0.07 * angle + 0.03 * sin(20 * t + phase);
    p[0] = (float)(radius * cos(angle));
    p[1] = (float)(radius * sin(angle));
    p[2] = (float)(2 * t * (0.1 + 0.9 * t) - 1 + 0.05 * sin(7 * angle - phase));
}

/* All triangles, row by row. */
void mesh_place(mesh *m, double phase)
{
    static const uint32_t corner[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {0, 1}, {1, 0}}};
    const uint32_t rows = (m->count + 2 * COLUMNS - 1) / (2 * COLUMNS);
    for (uint32_t i = 0; i < m->count; i++)
        for (uint32_t k = 0; k < 3; k++)
            point_at(i / 2 % COLUMNS + corner[i % 2][k][0], i / 2 / COLUMNS + corner[i % 2][k][1], rows, phase,
                     m->triangle[i][k]);
}

/* form: with or without indices, with or without gaps in the arrays. */
static void part_make(part *p, uint32_t first, uint32_t count, uint32_t beyond, uint32_t form)
{
    const bool indexed = form % 2, gaps = form / 2 % 2;
    const size_t vertex = gaps ? 20 : 12, index = gaps ? 16 : 12;
    p->first = first;
    p->held = count + beyond;
    p->vertex = malloc((3 * p->held - 1) * vertex + 3 * sizeof(float));
    p->index = indexed ? malloc((p->held - 1) * index + 3 * sizeof(uint32_t)) : NULL;
    assert_true(p->vertex && (p->index || !indexed));
    p->triangles = (cgt_triangles){.count = count,
                                   .indices = p->index,
                                   .index_stride = indexed ? index : 0,
                                   .vertex_count = 3 * p->held,
                                   .vertices = p->vertex,
                                   .vertex_stride = vertex};
}

mesh mesh_make(const uint32_t *counts, uint32_t parts, uint32_t beyond, uint32_t form)
{
    mesh m = {.parts = parts};
    for (uint32_t k = 0; k < parts; k++) {
        part_make(&m.part[k], m.count, counts[k], beyond, form + k);
        m.count += counts[k];
    }
    m.triangle = malloc(m.count * sizeof *m.triangle);
    assert_non_null(m.triangle);
    mesh_place(&m, 0);
    return m;
}

mesh mesh_of(uint32_t count, uint32_t form) { return mesh_make(&count, 1, 0, form); }

void mesh_free(mesh *m)
{
    for (uint32_t k = 0; k < m->parts; k++) {
        free(m->part[k].vertex);
        free(m->part[k].index);
    }
    free(m->triangle);
}

uint32_t *index_at(const part *p, uint32_t i)
{
    return (uint32_t *)(void *)((char *)p->index + i * p->triangles.index_stride);
}

/* Stores the triangles in the arrays, with indices from the last vertex to the first. Triangles beyond the last one cut
 * through the centre. */
void mesh_store(const mesh *m)
{
    static const float beyond[3][3] = {{-3, -3, 0.1f}, {3, -3, 0.2f}, {0, 4, -0.3f}};
    for (const part *p = m->part; p < m->part + m->parts; p++)
        for (uint32_t i = 0; i < p->held; i++)
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t at = p->index ? 3 * (p->held - i) - 1 - k : 3 * i + k;
                const float *from = i < p->triangles.count ? m->triangle[p->first + i][k] : beyond[k];
                memcpy((char *)p->vertex + at * p->triangles.vertex_stride, from, 3 * sizeof(float));
                if (p->index)
                    index_at(p, i)[k] = at;
            }
}

/* Makes triangles that are skipped: all or every other one of some clusters, and single ones. Some lie far away, where
 * boxes must not reach. Those and NaNs are few, since their clusters do not count as neighbours. */
void mesh_spoil(const mesh *m)
{
    for (uint32_t i = 0; i < m->count; i++) {
        const uint32_t c = i / CGT_CLUSTER;
        float(*v)[3] = m->triangle[i];
        if (c % 41 == 5 || i % 11 == 7)
            memcpy(v[2], v[1], sizeof v[2]);
        if (c % 82 == 46 || (c % 37 == 3 && i % 2))
            v[i % 3][i / 3 % 3] = i % 5 ? NAN : -INFINITY;
        if (c % 53 == 4 && i % 3 == 0)
            for (int a = 0; a < 3; a++)
                v[0][a] = v[1][a] = v[2][a] = i % 2 ? 1.5f : -1.5f;
    }
}

/* Sets coordinates to +0 or -0, of which neither is less. */
void mesh_flatten(const mesh *m)
{
    for (uint32_t i = 0; i < m->count; i++)
        for (uint32_t k = 0; k < 3; k++)
            m->triangle[i][k][2] = (i + i / 5 + k) % 3 ? 0.f : -0.f;
}

void mesh_loosen(const mesh *m)
{
    enum { CLUSTERS = 8, BLOCK = CLUSTERS * CGT_CLUSTER };
    for (uint32_t first = 0; first + BLOCK <= m->count; first += BLOCK) {
        float block[BLOCK][3][3];
        memcpy(block, m->triangle[first], sizeof block);
        for (uint32_t k = 0; k < BLOCK; k++)
            memcpy(m->triangle[first + k], block[k % CGT_CLUSTER * CLUSTERS + k / CGT_CLUSTER], sizeof block[0]);
    }
}

void mesh_shuffle(const mesh *m, test_random *r)
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

/* Returns an uncommitted scene. */
cgt_scene *scene_with(cgt_context *context, const cgt_scene_options *options, const mesh *m)
{
    cgt_scene *scene = NULL;
    uint32_t id;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    for (uint32_t k = 0; k < m->parts; k++) {
        cgt_triangles t = m->part[k].triangles;
        t.mask = k == HIDDEN_PART ? ~VISIBLE_MASK : 0;
        assert_int_equal(cgt_scene_add_triangles(scene, &t, &id), CGT_OK);
    }
    return scene;
}

void commit(cgt_scene *scene)
{
    if (cgt_scene_commit(scene) != CGT_OK)
        fail_msg("%s", context_message(scene->context));
}

cgt_scene *committed(cgt_context *context, const cgt_scene_options *options, const mesh *m)
{
    cgt_scene *scene = scene_with(context, options, m);
    commit(scene);
    return scene;
}
