/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The few rays of a packet against a list of primitives, a vector of them at a time and a ray in all lanes, by the
 * tests of lane_tests.h. */
#ifndef CGT_LANE_PRIMS_H
#define CGT_LANE_PRIMS_H

#include "kernel/primitive/lane_tests.h"
#include "papers/kernel/packet/sphere_filter.h"
#include "papers/kernel/packet/triangle_filter.h"

#define LANE_MAX_RAYS (CGT_LANES / 4) /* a vector of primitives against more of them costs more than vectors of rays */

typedef struct lane_prims {
    const cgt_primitives *prims;
    packet *p;
    cgt_counts *counts;
    float scale;
    uint32_t rays, number[LANE_MAX_RAYS]; /* in the packet */
    lane_rays ray[LANE_MAX_RAYS];         /* each in every lane */
    /* of the current vector: lanes beyond its count keep their old contents */
    filter_spheres spheres;
    filter_triangles triangles;
} lane_prims;

/* For the rays that take part, at most LANE_MAX_RAYS. */
CGT_SPU_INLINE void lane_prims_init(const cgt_committed_scene *committed_scene, packet *p, cgt_counts *counts,
                                    lane_prims *l)
{
    l->prims = &committed_scene->prims;
    l->p = p;
    l->counts = counts;
    l->scale = committed_scene->scale;
    l->rays = 0;
    for (uint32_t i = 0; i < p->lanes; i++)
        if (p->high[i] != -INFINITY) {
            lane_rays_of_one(p, i, committed_scene->scale, &l->ray[l->rays]);
            l->number[l->rays++] = i;
        }
    if (committed_scene->prims.spheres) {
        memset(l->spheres.center, 0, sizeof l->spheres.center);
        memset(l->spheres.radius, 0, sizeof l->spheres.radius);
    }
    if (committed_scene->prims.triangles)
        memset(l->triangles.vertex, 0, sizeof l->triangles.vertex);
}

/* The fields of leaf_triangle.h, by the same arithmetic. */
CGT_SPU_INLINE void lane_triangles_init(const filter_triangles *s, float scale, lane_triangles *q)
{
    for (int a = 0; a < 3; a++) {
        q->vertex[a] = spu_mul(spux_load(s->vertex[0][a]), spux_vfloat(scale));
        for (int k = 0; k < 2; k++)
            q->edge[k][a] = spu_sub(spu_mul(spux_load(s->vertex[k + 1][a]), spux_vfloat(scale)), q->vertex[a]);
    }
    for (int k = 0; k < 2; k++)
        q->sum[k] = lane_sum(q->edge[k]);
}

static void lane_prims_test_spheres(lane_prims *l, const uint32_t *reference, uint32_t count)
{
    filter_spheres *s = &l->spheres;
    lane_hits q;
    filter_gather_spheres(l->prims, reference, count, count, s);
    const vfloat center[3] = {spux_load(s->center[0]), spux_load(s->center[1]), spux_load(s->center[2])};
    for (uint32_t k = 0; k < l->rays; k++)
        if (lane_test_sphere(&l->ray[k], center, spux_load(s->radius), &q))
            leaf_update_ray(l->prims, l->p, l->number[k], &q, reference, count, l->counts);
}

static void lane_prims_test_triangles(lane_prims *l, const uint32_t *reference, uint32_t count)
{
    lane_triangles triangles;
    lane_hits q;
    filter_gather_triangles(l->prims, reference, count, count, &l->triangles);
    lane_triangles_init(&l->triangles, l->scale, &triangles);
    for (uint32_t k = 0; k < l->rays; k++)
        if (lane_test_triangle(&l->ray[k], &triangles, &q))
            leaf_update_ray(l->prims, l->p, l->number[k], &q, reference, count, l->counts);
}

/* Rays that any hit has closed need no more. */
static void lane_prims_drop_closed(lane_prims *l)
{
    uint32_t open_rays = 0;
    for (uint32_t k = 0; k < l->rays; k++)
        if (l->p->high[l->number[k]] != -INFINITY) {
            l->number[open_rays] = l->number[k];
            l->ray[open_rays++] = l->ray[k];
        }
    l->rays = open_rays;
}

static void lane_prims_test(lane_prims *l, const uint32_t *reference, uint32_t count)
{
    while (count && l->rays) {
        cgt_kind kind;
        const uint32_t run = leaf_same_kind_run(l->prims, reference, count, &kind);
        l->counts->packet_tests += run;
        l->counts->ray_tests += (uint64_t)run * l->rays;
        if (kind == CGT_KIND_SPHERES)
            lane_prims_test_spheres(l, reference, run);
        else
            lane_prims_test_triangles(l, reference, run);
        if (l->p->any_hit)
            lane_prims_drop_closed(l);
        reference += run;
        count -= run;
    }
}

#endif
