/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The few rays of a packet against a list of objects, a vector of them at a time and a ray in all lanes, by the tests
 * of lane_tests.h. */
#ifndef CGT_LANE_OBJECTS_H
#define CGT_LANE_OBJECTS_H

#include "kernel/primitive/lane_tests.h"
#include "kernel/primitive/sphere_filter.h"
#include "kernel/primitive/triangle_filter.h"

#define LANE_MOST_RAYS (CGT_LANES / 4) /* a vector of objects against more of them costs more than vectors of rays */

typedef struct lane_objects {
    const cgt_objects *objects;
    packet *p;
    cgt_counts *counts;
    float scale;
    uint32_t rays, number[LANE_MOST_RAYS]; /* in the packet */
    lane_rays ray[LANE_MOST_RAYS];         /* each in every lane */
    /* of the vector in work: lanes beyond its count hold what they held before */
    filter_spheres spheres;
    filter_triangles triangles;
} lane_objects;

/* For the rays that take part, at most LANE_MOST_RAYS. */
CGT_SPU_INLINE void lane_objects_make(const cgt_world *world, packet *p, cgt_counts *counts, lane_objects *l)
{
    l->objects = &world->objects;
    l->p = p;
    l->counts = counts;
    l->scale = world->scale;
    l->rays = 0;
    for (uint32_t i = 0; i < p->lanes; i++)
        if (p->high[i] != -INFINITY) {
            lane_rays_of_one(p, i, world->scale, &l->ray[l->rays]);
            l->number[l->rays++] = i;
        }
    if (world->objects.spheres) {
        memset(l->spheres.center, 0, sizeof l->spheres.center);
        memset(l->spheres.radius, 0, sizeof l->spheres.radius);
    }
    if (world->objects.triangles)
        memset(l->triangles.vertex, 0, sizeof l->triangles.vertex);
}

/* The fields of leaf_triangle.h, by the same arithmetic. */
CGT_SPU_INLINE void lane_triangles_make(const filter_triangles *s, float scale, lane_triangles *q)
{
    for (int a = 0; a < 3; a++) {
        q->vertex[a] = spu_mul(spux_load(s->vertex[0][a]), spux_vfloat(scale));
        for (int k = 0; k < 2; k++)
            q->edge[k][a] = spu_sub(spu_mul(spux_load(s->vertex[k + 1][a]), spux_vfloat(scale)), q->vertex[a]);
    }
    for (int k = 0; k < 2; k++)
        q->sum[k] = lane_sum(q->edge[k]);
}

static void lane_objects_spheres(lane_objects *l, const uint32_t *reference, uint32_t count)
{
    filter_spheres *s = &l->spheres;
    lane_hits q;
    filter_spheres_fetch(l->objects, reference, count, count, s);
    const vfloat center[3] = {spux_load(s->center[0]), spux_load(s->center[1]), spux_load(s->center[2])};
    for (uint32_t k = 0; k < l->rays; k++)
        if (lane_sphere(&l->ray[k], center, spux_load(s->radius), &q))
            leaf_keep_ray(l->objects, l->p, l->number[k], &q, reference, count, l->counts);
}

static void lane_objects_triangles(lane_objects *l, const uint32_t *reference, uint32_t count)
{
    lane_triangles triangles;
    lane_hits q;
    filter_triangles_fetch(l->objects, reference, count, count, &l->triangles);
    lane_triangles_make(&l->triangles, l->scale, &triangles);
    for (uint32_t k = 0; k < l->rays; k++)
        if (lane_triangle(&l->ray[k], &triangles, &q))
            leaf_keep_ray(l->objects, l->p, l->number[k], &q, reference, count, l->counts);
}

/* Rays that any hit has closed need no more. */
static void lane_objects_leave_closed(lane_objects *l)
{
    uint32_t kept = 0;
    for (uint32_t k = 0; k < l->rays; k++)
        if (l->p->high[l->number[k]] != -INFINITY) {
            l->number[kept] = l->number[k];
            l->ray[kept++] = l->ray[k];
        }
    l->rays = kept;
}

static void lane_objects_test(lane_objects *l, const uint32_t *reference, uint32_t count)
{
    while (count && l->rays) {
        cgt_kind kind;
        const uint32_t run = leaf_run(l->objects, reference, count, &kind);
        l->counts->packet_tests += run;
        l->counts->ray_tests += (uint64_t)run * l->rays;
        if (kind == CGT_KIND_SPHERES)
            lane_objects_spheres(l, reference, run);
        else
            lane_objects_triangles(l, reference, run);
        if (l->p->any_hit)
            lane_objects_leave_closed(l);
        reference += run;
        count -= run;
    }
}

#endif
