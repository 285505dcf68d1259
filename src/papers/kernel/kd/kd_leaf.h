/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The primitives of a leaf of a tree against rays of a packet: a vector of rays and one primitive after the other, or
 * one ray and a vector of primitives. Fast packets take the filters of the grid, whose tests they share. */
#ifndef CGT_KD_LEAF_H
#define CGT_KD_LEAF_H

#include "kernel/primitive/lane_tests.h"
#include "papers/kernel/packet/sphere_filter.h"
#include "papers/kernel/packet/triangle_fast.h"
#include "papers/model/paper_structures.h"

#define LEAF_TRIANGLE 11  /* fields of a leaf triangle */
#define LEAF_MAILBOX 256u /* direct mapped by the low bits of the primitive */

/* The state of leaf tests, initialised once per packet. */
typedef struct leaf_tests {
    const cgt_primitives *prims;
    packet *p;
    cgt_counts *counts;
    const cgt_leaf_triangle *triangle;
    float scale;
    bool mailbox;
    uint32_t visited[LEAF_MAILBOX]; /* primitives that the current rays were tested against lately */
    filter_packet filter;           /* where fast */
    /* of the current leaf: lanes beyond its count keep their old contents */
    filter_spheres spheres;
    filter_triangles triangles;                       /* where fast */
    _Alignas(64) float row[LEAF_TRIANGLE][CGT_LANES]; /* else: fields of leaf triangles */
} leaf_tests;

CGT_SPU_INLINE void leaf_tests_init(const cgt_committed_scene *committed_scene, packet *p,
                                    const cgt_trace_settings *settings, cgt_counts *counts, leaf_tests *l)
{
    l->prims = &committed_scene->prims;
    l->p = p;
    l->counts = counts;
    l->triangle = committed_scene->papers->triangle;
    l->scale = committed_scene->scale;
    l->mailbox = settings->mailbox;
    if (committed_scene->prims.spheres) {
        memset(l->spheres.center, 0, sizeof l->spheres.center);
        memset(l->spheres.radius, 0, sizeof l->spheres.radius);
    }
    if (committed_scene->prims.triangles) {
        memset(l->triangles.vertex, 0, sizeof l->triangles.vertex);
        memset(l->row, 0, sizeof l->row);
    }
    if (!PACKET_IS_FAST(p))
        return;
    filter_packet_init(p, committed_scene->scale, &l->filter);
    if (committed_scene->prims.triangles && !p->common_origin)
        filter_moments_init(p, &l->filter);
}

/* The same triangle in every lane. */
CGT_SPU_INLINE void lane_triangles_of_one(const cgt_leaf_triangle *t, lane_triangles *q)
{
    for (int a = 0; a < 3; a++)
        q->vertex[a] = spux_vfloat(t->vertex[a]);
    for (int k = 0; k < 2; k++) {
        for (int a = 0; a < 3; a++)
            q->edge[k][a] = spux_vfloat(t->edge[k][a]);
        q->sum[k] = spux_vfloat(t->sum[k]);
    }
}

/* Before other rays. */
CGT_SPU_INLINE void leaf_mailbox_clear(leaf_tests *l)
{
    if (l->mailbox)
        memset(l->visited, 0xff, sizeof l->visited);
}

/* Whether the current rays were tested against the primitive; remembers it. */
CGT_SPU_INLINE bool leaf_mailbox_has(leaf_tests *l, uint32_t prim)
{
    uint32_t *visited = &l->visited[prim % LEAF_MAILBOX];
    const bool has = *visited == prim;
    *visited = prim;
    l->counts->mailbox_skipped += has;
    return has;
}

/* ---- a vector of rays ---- */

/* Keeps what lanes found out about the primitive that all of them tested. */
CGT_SPU_INLINE void leaf_update_vector(leaf_tests *l, uint32_t prim, uint32_t i, const lane_hits *q)
{
    packet *p = l->p;
    const vfloat low = spux_load(p->low + i), high = spux_load(p->high + i);
    const vuint best_prim = spux_load_uint(p->prim + i), number = spux_vuint(prim);
    vmask nearer = spu_and(q->certain_hit, spu_cmpgt(low, q->high));
    vmask decided = spu_or(spu_or(nearer, spu_cmpgt(q->low, high)), spu_cmpeq(best_prim, number));
    if (p->skips_prims) {
        const vmask left_out = rays_skipping_one(l->prims, p, i, prim);
        nearer = spu_andc(nearer, left_out);
        decided = spu_or(decided, left_out);
    }
    const vfloat closed = spux_vfloat(-INFINITY);
    spux_store(p->low + i, spux_select(low, p->any_hit ? closed : q->low, nearer));
    spux_store(p->high + i, spux_select(high, p->any_hit ? closed : q->high, nearer));
    spux_store_uint(p->prim + i, spux_select(best_prim, number, nearer));
    for (unsigned remaining = spux_mask_bits(spu_andc(spu_or(q->certain_hit, q->undecided), decided)); remaining;
         remaining &= remaining - 1)
        packet_decide(l->prims, p, i + (uint32_t)__builtin_ctz(remaining), prim, l->counts);
}

/* Tests the rays of all lanes against a primitive. Returns false if all certainly miss. */
CGT_SPU_INLINE bool leaf_test_lanes(const leaf_tests *l, const lane_rays *r, uint32_t prim, lane_hits *q)
{
    const cgt_primitive_array *a = cgt_primitives_array(l->prims, prim);
    if (a->kind == CGT_KIND_SPHERES) {
        const cgt_sphere s = cgt_array_sphere(a, prim - a->first);
        const vfloat center[3] = {spux_vfloat(s.x), spux_vfloat(s.y), spux_vfloat(s.z)};
        return lane_test_sphere(r, center, spux_vfloat(s.r), q);
    }
    lane_triangles triangle;
    lane_triangles_of_one(&l->triangle[cgt_array_boxed_number(a, prim)], &triangle);
    return lane_test_triangle(r, &triangle, q);
}

static void leaf_test_one(leaf_tests *l, const lane_rays *r, uint32_t prim, uint32_t i)
{
    lane_hits q;
    if (leaf_test_lanes(l, r, prim, &q))
        leaf_update_vector(l, prim, i, &q);
}

/* ---- a vector of rays of a fast packet ---- */

static void leaf_fast_spheres(leaf_tests *l, const uint32_t *reference, uint32_t count, uint32_t i)
{
    filter_spheres *s = &l->spheres;
    filter_gather_spheres(l->prims, reference, count, count, s);
    filter_spheres_bound(&l->filter, s);
    for (uint32_t k = 0; k < count; k++) {
#define CALL(mode)                                                                                                     \
    {                                                                                                                  \
        filter_sphere q = filter_sphere_get(l->p, s, (int)k, (mode).common_origin);                                    \
        q.r2 = spux_vfloat(s->radius[k] * s->radius[k]);                                                               \
        filter_vector(l->prims, l->p, filter_sphere_rays_fast, filter_sphere_rays_fast, &q, s->prim[k], i, mode,       \
                      l->counts);                                                                                      \
    }
        FILTER_FOR_MODE(l->p, false, CALL)
#undef CALL
    }
}

static void leaf_fast_triangles(leaf_tests *l, const uint32_t *reference, uint32_t count, uint32_t i)
{
    filter_triangles *s = &l->triangles;
    filter_gather_triangles(l->prims, reference, count, count, s);
    filter_triangles_prepare_fast(&l->filter, s);
    for (uint32_t k = 0; k < count; k++) {
#define CHOSEN(test, q) filter_vector(l->prims, l->p, test, test, q, s->prim[k], i, chosen, l->counts)
#define CALL(mode)                                                                                                     \
    {                                                                                                                  \
        const filter_mode chosen = mode;                                                                               \
        FILTER_WITH_TRIANGLE(l->p, &l->filter, s, (int)k, chosen, CHOSEN)                                              \
    }
        FILTER_FOR_MODE(l->p, true, CALL)
#undef CALL
#undef CHOSEN
    }
}

static void leaf_test_fast(leaf_tests *l, const uint32_t *reference, uint32_t count, uint32_t i)
{
    l->counts->packet_tests += count;
    while (count) {
        cgt_kind kind;
        const uint32_t run = leaf_same_kind_run(l->prims, reference, count, &kind);
        if (kind == CGT_KIND_SPHERES)
            leaf_fast_spheres(l, reference, run, i);
        else
            leaf_fast_triangles(l, reference, run, i);
        reference += run;
        count -= run;
    }
}

/* Primitives of a leaf are scattered: all are prefetched before the first is tested. With several arrays none is:
 * finding the right one takes as long. */
CGT_SPU_INLINE void leaf_prefetch(const leaf_tests *l, const uint32_t *reference, uint32_t count)
{
    const cgt_primitive_array *a = l->prims->array;
    if (l->prims->arrays != 1)
        return;
    for (uint32_t k = 0; k < count; k++)
        __builtin_prefetch(l->triangle ? (const void *)&l->triangle[reference[k]] : cgt_array_point(a, reference[k]));
}

/* Tests rays i to i + CGT_LANES - 1 against all primitives of a leaf. r: these rays. Some that do not pass the leaf may
 * be among them: what they meet, they meet. */
CGT_SPU_INLINE void leaf_test_vector(leaf_tests *l, const lane_rays *r, const uint32_t *reference, uint32_t count,
                                     uint32_t i)
{
    l->counts->references += count;
    if (PACKET_IS_FAST(l->p)) {
        leaf_test_fast(l, reference, count, i);
        return;
    }
    leaf_prefetch(l, reference, count);
    for (uint32_t k = 0; k < count; k++) {
        if (l->mailbox && leaf_mailbox_has(l, reference[k]))
            continue;
        l->counts->packet_tests++;
        l->counts->ray_tests += CGT_LANES;
        leaf_test_one(l, r, reference[k], i);
    }
}

/* ---- one ray ---- */

/* Loads at most a vector of triangles to the first lanes; the others keep their old contents. */
CGT_SPU_INLINE void leaf_gather_triangles(leaf_tests *l, const uint32_t *reference, uint32_t count, lane_triangles *q)
{
    for (uint32_t k = 0; k < count; k++) {
        const cgt_primitive_array *a = cgt_primitives_array(l->prims, reference[k]);
        const cgt_leaf_triangle *t = &l->triangle[cgt_array_boxed_number(a, reference[k])];
        for (int c = 0; c < 3; c++) {
            l->row[c][k] = t->vertex[c];
            l->row[3 + c][k] = t->edge[0][c];
            l->row[6 + c][k] = t->edge[1][c];
        }
        l->row[9][k] = t->sum[0];
        l->row[10][k] = t->sum[1];
    }
    for (int a = 0; a < 3; a++) {
        q->vertex[a] = spux_load(l->row[a]);
        q->edge[0][a] = spux_load(l->row[3 + a]);
        q->edge[1][a] = spux_load(l->row[6 + a]);
    }
    q->sum[0] = spux_load(l->row[9]);
    q->sum[1] = spux_load(l->row[10]);
}

/* Tests ray i of the packet against all primitives of a leaf. r: this ray in every lane. In a fast packet its
 * neighbours are tested too. */
CGT_SPU_INLINE void leaf_test_ray(leaf_tests *l, const lane_rays *r, const uint32_t *reference, uint32_t count,
                                  uint32_t i)
{
    l->counts->references += count;
    if (PACKET_IS_FAST(l->p)) {
        leaf_test_fast(l, reference, count, i - i % CGT_LANES);
        return;
    }
    if (l->mailbox && count == 1 && leaf_mailbox_has(l, reference[0]))
        return;
    l->counts->packet_tests += count;
    l->counts->ray_tests += count;
    while (count) {
        cgt_kind kind;
        lane_hits q;
        bool may_hit;
        const uint32_t run = leaf_same_kind_run(l->prims, reference, count, &kind);
        if (kind == CGT_KIND_SPHERES) {
            filter_spheres *s = &l->spheres;
            filter_gather_spheres(l->prims, reference, run, run, s);
            const vfloat center[3] = {spux_load(s->center[0]), spux_load(s->center[1]), spux_load(s->center[2])};
            may_hit = lane_test_sphere(r, center, spux_load(s->radius), &q);
        } else {
            lane_triangles triangles;
            leaf_gather_triangles(l, reference, run, &triangles);
            may_hit = lane_test_triangle(r, &triangles, &q);
        }
        if (may_hit)
            leaf_update_ray(l->prims, l->p, i, &q, reference, run, l->counts);
        reference += run;
        count -= run;
    }
}

#endif
