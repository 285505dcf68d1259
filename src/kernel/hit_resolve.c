/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the winning object of each ray to the fields of its hit: once per ray, in double, in the order of
 * sphere_double.h and triangle_double.h, so that no choice made on the way shows in the bits. Plain loops over the
 * packet: the compiler makes vectors of them, and unfused double arithmetic has one result at any width. Rays whose
 * values cancel too much are found on the way, and computed once more in exact arithmetic.
 * FAST precision hands out what the tests found. */
#include "resolve_fast.h"
#include "resolve_spheres.h"
#include "resolve_triangles.h"

/* ---- the winners ---- */

/* Neighbours mostly hit the same sphere: each different one of a vector is looked up once. */
static void find_spheres(const cgt_world *world, const packet *p, winners *w, packet_hits *hits)
{
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vuint object = spux_load_uint(p->object + i), none = spux_vuint(CGT_NONE);
        vfloat x = spux_vfloat(0), y = x, z = x, r = x;
        vuint primitive = none, geometry = none;
        unsigned left = ~spux_mask_bits(spu_cmpeq(object, none)) & CGT_ALL_LANES;
        w->hits += spux_count_bits(left);
        while (left) {
            const uint32_t winner = p->object[i + (uint32_t)__builtin_ctz(left)];
            const cgt_object_array *a = cgt_objects_array(&world->objects, winner);
            const cgt_sphere q = cgt_array_sphere(a, winner - a->first);
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
        spux_store(w->sphere[0] + i, x);
        spux_store(w->sphere[1] + i, y);
        spux_store(w->sphere[2] + i, z);
        spux_store(w->sphere[3] + i, r);
        spux_store_uint(hits->primitive + i, primitive);
        spux_store_uint(hits->geometry + i, geometry);
    }
}

static void set_triangle(winners *w, uint32_t i, const cgt_triangle *q)
{
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            w->vertex[k][a][i] = q->v[k][a];
}

/* Triangles, or both kinds; what is not hit, or is of the other kind, gets a shape that computes to something. */
static void find_shapes(const cgt_world *world, const packet *p, winners *w, packet_hits *hits)
{
    static const cgt_triangle nothing = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    uint32_t last = CGT_NONE;
    cgt_shape shape = {.kind = CGT_KIND_TRIANGLES, .triangle = nothing};
    const cgt_object_array *a = NULL;
    for (uint32_t i = 0; i < p->lanes; i++) {
        const uint32_t object = p->object[i];
        const bool hit = object != CGT_NONE;
        if (hit && object != last) {
            a = cgt_objects_array(&world->objects, object);
            shape = cgt_array_shape(a, object - a->first);
            last = object;
        }
        const bool sphere = hit && shape.kind == CGT_KIND_SPHERES;
        hits->primitive[i] = hit ? object - a->first : CGT_NONE;
        hits->geometry[i] = hit ? a->geometry : CGT_NONE;
        w->is_sphere[i] = sphere;
        w->hits += hit;
        set_triangle(w, i, hit && !sphere ? &shape.triangle : &nothing);
        w->sphere[0][i] = sphere ? shape.sphere.x : 0;
        w->sphere[1][i] = sphere ? shape.sphere.y : 0;
        w->sphere[2][i] = sphere ? shape.sphere.z : 0;
        w->sphere[3][i] = sphere ? shape.sphere.r : 0;
        w->points |= sphere && shape.sphere.r == 0;
    }
}

/* ---- the fields ---- */

static void fill_none(size_t first, size_t count, uint32_t fields, packet_hits *hits)
{
    for (size_t i = first; i < first + count; i++)
        hits->t[i] = INFINITY;
    if (fields & CGT_FIELD_NORMAL)
        for (int a = 0; a < 3; a++)
            memset(hits->normal[a] + first, 0, count * sizeof(float));
    if (fields & CGT_FIELD_UV) {
        memset(hits->u + first, 0, count * sizeof(float));
        memset(hits->v + first, 0, count * sizeof(float));
    }
}

/* Rays first to first + count - 1. Each kind's loop writes the rays of its kind. */
CGT_SPU_INLINE void resolve_rays(const cgt_objects *objects, const packet *p, size_t first, size_t count,
                                 const cgt_trace_settings *settings, winners *w, packet_hits *hits, cgt_counts *counts)
{
    uint32_t any = 0;
    for (size_t i = first; i < first + count; i++)
        any |= p->object[i] ^ CGT_NONE;
    if (!any || objects->triangles || settings->fields & CGT_FIELD_UV)
        fill_none(first, count, settings->fields, hits);
    if (!any)
        return;
    if (objects->spheres)
        resolve_spheres(p, first, count, settings, !objects->triangles, w, hits, counts);
    if (objects->triangles)
        resolve_triangles(p, first, count, settings, !objects->spheres, w, hits, counts);
}

static void resolve_all(const cgt_objects *objects, const packet *p, const cgt_trace_settings *settings, winners *w,
                        packet_hits *hits, cgt_counts *counts)
{
    const size_t lanes = p->lanes;
    size_t i = 0;
    for (; i + RESOLVE_RAYS <= lanes; i += RESOLVE_RAYS) /* a length that the compiler knows */
        resolve_rays(objects, p, i, RESOLVE_RAYS, settings, w, hits, counts);
    if (i < lanes)
        resolve_rays(objects, p, i, lanes - i, settings, w, hits, counts);
}

uint32_t CGT_KERNEL(cgt_packet_resolve)(const cgt_world *world, const packet *p, const cgt_trace_settings *settings,
                                        packet_hits *hits, cgt_counts *counts)
{
    winners w;
    w.hits = 0;
    w.points = false;
    if (world->objects.triangles)
        find_shapes(world, p, &w, hits);
    else
        find_spheres(world, p, &w, hits);
    counts->hits += w.hits;
    if (!w.hits)
        fill_none(0, p->lanes, settings->fields, hits);
    else if (p->fast && !p->extreme && !world->everything)
        resolve_fast(world, p, settings->fields, &w, hits);
    else
        resolve_all(&world->objects, p, settings, &w, hits, counts);
    if (settings->fields & CGT_FIELD_NORMAL && w.points)
        resolve_points(p, !world->objects.triangles, &w, hits);
    return w.hits;
}
