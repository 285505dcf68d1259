/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the winning object of each ray to the fields of its hit: once per ray, in double, in the order of
 * sphere_exact.h, so that no choice made on the way shows in the bits. Plain loops over the packet: the compiler makes
 * vectors of them, and unfused double arithmetic has one result at any width. */
#include "kernel.h"

#include "../sphere_exact.h"
#include "packet.h"

/* The winning spheres, as structure of arrays; a ray without one gets a sphere of radius 0 at the origin. */
typedef struct winners {
    _Alignas(64) float x[PACKET_MAX_RAYS], y[PACKET_MAX_RAYS], z[PACKET_MAX_RAYS], r[PACKET_MAX_RAYS];
    _Alignas(64) double t[PACKET_MAX_RAYS];
    uint32_t hits;
    bool points; /* some sphere has radius 0 */
} winners;

/* Neighbours mostly hit the same sphere: lanes are filled four at a time. Lanes come in fours at any width. */
static void find_spheres(const cgt_queue_grid *grid, const packet *p, winners *w)
{
    w->hits = 0;
    w->points = false;
    for (uint32_t i = 0; i < p->lanes;) {
        const uint32_t object = p->object[i], *o = p->object + i;
        const bool hit = object != CGT_NONE, four = i % 4 == 0 && o[1] == object && o[2] == object && o[3] == object;
        const cgt_sphere q = hit ? cgt_objects_sphere(&grid->objects, object) : (cgt_sphere){0, 0, 0, 0};
        const uint32_t count = four ? 4 : 1;
        for (uint32_t k = 0; k < count; k++) {
            w->x[i + k] = q.x;
            w->y[i + k] = q.y;
            w->z[i + k] = q.z;
            w->r[i + k] = q.r;
        }
        w->points |= hit && q.r == 0;
        w->hits += hit ? count : 0;
        i += count;
    }
}

static void find_ids(const cgt_queue_grid *grid, const packet *p, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes;) {
        const uint32_t object = p->object[i], *o = p->object + i;
        const uint32_t count = i % 4 == 0 && o[1] == object && o[2] == object && o[3] == object ? 4 : 1;
        const cgt_sphere_array *a = object == CGT_NONE ? NULL : cgt_objects_array(&grid->objects, object);
        for (uint32_t k = 0; k < count; k++) {
            hits->primitive[i + k] = a ? object - a->first : CGT_NONE;
            hits->geometry[i + k] = a ? a->geometry : CGT_NONE;
        }
        i += count;
    }
}

static void resolve_t(const packet *p, winners *w, packet_hits *hits)
{
    _Alignas(64) double middle[PACKET_MAX_RAYS], product[PACKET_MAX_RAYS], half2[PACKET_MAX_RAYS];
    /* two loops: all of it at once has more numbers than a machine has registers */
    for (uint32_t i = 0; i < p->lanes; i++) {
        const float org[3] = {p->org[0][i], p->org[1][i], p->org[2][i]};
        const float dir[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
        const cgt_sphere_terms e = cgt_sphere_exact_terms(org, dir, (cgt_sphere){w->x[i], w->y[i], w->z[i], w->r[i]});
        middle[i] = e.middle;
        product[i] = e.product;
        half2[i] = e.half2;
    }
    for (uint32_t i = 0; i < p->lanes; i++)
        w->t[i] = cgt_sphere_exact_root(middle[i], product[i], half2[i], p->t_min[i]);
    for (uint32_t i = 0; i < p->lanes; i++)
        hits->t[i] = p->object[i] != CGT_NONE ? (float)w->t[i] : INFINITY;
}

/* The outward unit normal is the vector from the centre over the radius. */
static void resolve_normal(const packet *p, const winners *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        const double t = w->t[i], k = 1 / (double)w->r[i];
        const double x = (double)p->org[0][i] + t * (double)p->dir[0][i] - (double)w->x[i];
        const double y = (double)p->org[1][i] + t * (double)p->dir[1][i] - (double)w->y[i];
        const double z = (double)p->org[2][i] + t * (double)p->dir[2][i] - (double)w->z[i];
        const bool hit = p->object[i] != CGT_NONE;
        hits->normal[0][i] = hit ? (float)(x * k) : 0;
        hits->normal[1][i] = hit ? (float)(y * k) : 0;
        hits->normal[2][i] = hit ? (float)(z * k) : 0;
    }
}

/* A sphere of radius 0 has no normal of its own: it gets the direction back to the ray's origin. */
static void resolve_points(const packet *p, const winners *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        if (p->object[i] == CGT_NONE || w->r[i] != 0)
            continue;
        const double x = (double)p->dir[0][i], y = (double)p->dir[1][i], z = (double)p->dir[2][i];
        const double k = -1 / sqrt(x * x + y * y + z * z);
        hits->normal[0][i] = (float)(x * k);
        hits->normal[1][i] = (float)(y * k);
        hits->normal[2][i] = (float)(z * k);
    }
}

static void fill_none(const packet *p, packet_hits *hits)
{
    const size_t bytes = p->lanes * sizeof(float);
    for (uint32_t i = 0; i < p->lanes; i++)
        hits->t[i] = INFINITY;
    memset(hits->primitive, 0xff, bytes); /* CGT_NONE */
    memset(hits->geometry, 0xff, bytes);
    for (int a = 0; a < 3; a++)
        memset(hits->normal[a], 0, bytes);
}

uint32_t CGT_KERNEL(cgt_packet_resolve)(const cgt_queue_grid *grid, const packet *p, uint32_t fields, packet_hits *hits)
{
    winners w;
    find_spheres(grid, p, &w);
    if (!w.hits) {
        fill_none(p, hits);
        return 0;
    }
    if (fields & (CGT_FIELD_T | CGT_FIELD_NORMAL))
        resolve_t(p, &w, hits);
    if (fields & CGT_FIELD_NORMAL)
        resolve_normal(p, &w, hits);
    if (fields & CGT_FIELD_NORMAL && w.points)
        resolve_points(p, &w, hits);
    if (fields & (CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY))
        find_ids(grid, p, hits);
    return w.hits;
}
