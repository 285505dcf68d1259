/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the winning object of each ray to the fields of its hit: once per ray, in double, in the order of
 * sphere_exact.h, so that no choice made on the way shows in the bits. Plain loops over the packet: the compiler makes
 * vectors of them, and unfused double arithmetic has one result at any width. */
#include "kernel.h"

#include "../sphere_exact.h"
#include "packet.h"

typedef struct winners {
    cgt_sphere sphere[PACKET_MAX_RAYS];
} winners;

static uint32_t find_spheres(const cgt_queue_grid *grid, const packet *p, winners *w, bool *all)
{
    uint32_t hits = 0;
    for (uint32_t i = 0; i < p->lanes; i++) {
        const bool hit = p->object[i] != CGT_NONE;
        w->sphere[i] = hit ? cgt_objects_sphere(&grid->objects, p->object[i]) : (cgt_sphere){0, 0, 0, 0};
        hits += hit;
    }
    *all = hits == p->lanes;
    return hits;
}

static void find_ids(const cgt_queue_grid *grid, const packet *p, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        const uint32_t object = p->object[i];
        const cgt_sphere_array *a = object == CGT_NONE ? NULL : cgt_objects_array(&grid->objects, object);
        hits->primitive[i] = a ? object - a->first : CGT_NONE;
        hits->geometry[i] = a ? a->geometry : CGT_NONE;
    }
}

/* One ray: t where wanted is NULL or not; the unit normal points out of the sphere. A sphere of radius zero has none:
 * it gets the direction back to the origin. */
static inline double resolve_ray(const packet *p, uint32_t i, cgt_sphere q, bool normal, float n[3])
{
    const float org[3] = {p->org[0][i], p->org[1][i], p->org[2][i]};
    const float dir[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
    const double t = cgt_sphere_exact_t(org, dir, p->t_min[i], q);
    if (!normal) return t;
    const double x = org[0] + t * dir[0] - q.x, y = org[1] + t * dir[1] - q.y, z = org[2] + t * dir[2] - q.z;
    const double point = q.r == 0, k = 1 / (q.r + point);
    const double length = sqrt((double)dir[0] * dir[0] + (double)dir[1] * dir[1] + (double)dir[2] * dir[2]);
    n[0] = (float)(point ? -dir[0] / length : x * k);
    n[1] = (float)(point ? -dir[1] / length : y * k);
    n[2] = (float)(point ? -dir[2] / length : z * k);
    return t;
}

static void resolve_t(const packet *p, const winners *w, packet_hits *hits)
{
    float none[3];
    for (uint32_t i = 0; i < p->lanes; i++) {
        const float t = (float)resolve_ray(p, i, w->sphere[i], false, none);
        hits->t[i] = p->object[i] != CGT_NONE ? t : INFINITY;
    }
}

static void resolve_t_and_normal(const packet *p, const winners *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        float n[3];
        const float t = (float)resolve_ray(p, i, w->sphere[i], true, n);
        const bool hit = p->object[i] != CGT_NONE;
        hits->t[i] = hit ? t : INFINITY;
        for (int a = 0; a < 3; a++) hits->normal[a][i] = hit ? n[a] : 0;
    }
}

uint32_t CGT_KERNEL(cgt_packet_resolve)(const cgt_queue_grid *grid, const packet *p, uint32_t fields, packet_hits *hits)
{
    winners w;
    bool all;
    const uint32_t count = find_spheres(grid, p, &w, &all);
    if (fields & CGT_FIELD_NORMAL) resolve_t_and_normal(p, &w, hits);
    else if (fields & CGT_FIELD_T) resolve_t(p, &w, hits);
    if (fields & (CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY)) find_ids(grid, p, hits);
    return count;
}
