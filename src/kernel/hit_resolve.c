/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the winning object of each ray to the fields of its hit: once per ray, in double, in the order of
 * sphere_exact.h, so that no choice made on the way shows in the bits. Plain loops over the packet: the compiler makes
 * vectors of them, and unfused double arithmetic has one result at any width. */
#include "kernel.h"

#include "../sphere_exact.h"
#include "packet.h"

#define RESOLVE_RAYS 16u

/* The winning spheres, as structure of arrays; a ray without one gets a sphere of radius 0 at the origin. */
typedef struct winners {
    _Alignas(64) float x[PACKET_MAX_RAYS], y[PACKET_MAX_RAYS], z[PACKET_MAX_RAYS], r[PACKET_MAX_RAYS];
    _Alignas(64) double t[PACKET_MAX_RAYS];
    uint32_t hits;
    bool points; /* some sphere has radius 0 */
} winners;

/* Neighbours mostly hit the same sphere: each different one of a vector is looked up once. */
static void find_spheres(const cgt_queue_grid *grid, const packet *p, winners *w, packet_hits *hits)
{
    w->hits = 0;
    w->points = false;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vuint object = spux_load_uint(p->object + i), none = spux_vuint(CGT_NONE);
        vfloat x = spux_vfloat(0), y = x, z = x, r = x;
        vuint primitive = none, geometry = none;
        unsigned left = ~spux_mask_bits(spu_cmpeq(object, none)) & CGT_ALL_LANES;
        w->hits += spux_count_bits(left);
        while (left) {
            const uint32_t winner = p->object[i + (uint32_t)__builtin_ctz(left)];
            const cgt_sphere_array *a = cgt_objects_array(&grid->objects, winner);
            const cgt_sphere q = cgt_objects_sphere(&grid->objects, winner);
            const vmask same = spu_cmpeq(object, spux_vuint(winner));
            x = spux_select(x, spux_vfloat(q.x), same);
            y = spux_select(y, spux_vfloat(q.y), same);
            z = spux_select(z, spux_vfloat(q.z), same);
            r = spux_select(r, spux_vfloat(q.r), same);
            primitive = spux_select(primitive, spux_vuint(winner - a->first), same);
            geometry = spux_select(geometry, spux_vuint(a->geometry), same);
            w->points |= q.r == 0;
            left &= ~spux_mask_bits(same);
        }
        spux_store(w->x + i, x);
        spux_store(w->y + i, y);
        spux_store(w->z + i, z);
        spux_store(w->r + i, r);
        spux_store_uint(hits->primitive + i, primitive);
        spux_store_uint(hits->geometry + i, geometry);
    }
}

/* The steps below work on some rays at a time, first to first + count - 1. */

CGT_SPU_INLINE void resolve_t(const packet *p, uint32_t first, uint32_t count, winners *w, packet_hits *hits)
{
    _Alignas(64) double middle[RESOLVE_RAYS], product[RESOLVE_RAYS], half2[RESOLVE_RAYS];
    /* two loops: all of it at once has more numbers than a machine has registers */
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = first + k;
        const float org[3] = {p->org[0][i], p->org[1][i], p->org[2][i]};
        const float dir[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
        const cgt_sphere_terms e = cgt_sphere_exact_terms(org, dir, (cgt_sphere){w->x[i], w->y[i], w->z[i], w->r[i]});
        middle[k] = e.middle;
        product[k] = e.product;
        half2[k] = e.half2;
    }
    for (uint32_t k = 0; k < count; k++)
        w->t[first + k] = cgt_sphere_exact_root(middle[k], product[k], half2[k], p->t_min[first + k]);
    for (uint32_t i = first; i < first + count; i++)
        hits->t[i] = p->object[i] != CGT_NONE ? (float)w->t[i] : INFINITY;
}

/* The outward unit normal is the vector from the centre over the radius. */
CGT_SPU_INLINE void resolve_normal(const packet *p, uint32_t first, uint32_t count, const winners *w, packet_hits *hits)
{
    for (uint32_t i = first; i < first + count; i++) {
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

CGT_SPU_INLINE void resolve_none(uint32_t first, uint32_t count, packet_hits *hits)
{
    for (uint32_t i = first; i < first + count; i++) {
        hits->t[i] = INFINITY;
        for (int a = 0; a < 3; a++)
            hits->normal[a][i] = 0;
    }
}

CGT_SPU_INLINE void resolve_rays(const packet *p, uint32_t first, uint32_t count, uint32_t fields, winners *w,
                                 packet_hits *hits)
{
    uint32_t any = 0;
    for (uint32_t i = first; i < first + count; i++)
        any |= p->object[i] ^ CGT_NONE;
    if (!any) {
        resolve_none(first, count, hits);
        return;
    }
    if (fields & (CGT_FIELD_T | CGT_FIELD_NORMAL))
        resolve_t(p, first, count, w, hits);
    if (fields & CGT_FIELD_NORMAL)
        resolve_normal(p, first, count, w, hits);
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
    find_spheres(grid, p, &w, hits);
    if (!w.hits) {
        fill_none(p, hits);
        return 0;
    }
    uint32_t i = 0;
    for (; i + RESOLVE_RAYS <= p->lanes; i += RESOLVE_RAYS) /* a length that the compiler knows */
        resolve_rays(p, i, RESOLVE_RAYS, fields, &w, hits);
    if (i < p->lanes)
        resolve_rays(p, i, p->lanes - i, fields, &w, hits);
    if (fields & CGT_FIELD_NORMAL && w.points)
        resolve_points(p, &w, hits);
    return w.hits;
}
