/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the winning object of each ray to the fields of its hit: once per ray, in double, in the order of
 * sphere_double.h and triangle_double.h, so that no choice made on the way shows in the bits. Plain loops over the
 * packet: the compiler makes vectors of them, and unfused double arithmetic has one result at any width. Rays whose
 * values cancel too much are found on the way, and computed once more in exact arithmetic.
 * FAST precision hands out what the tests found. */
#include "kernel/primitive/gather_primitives.h"
#include "kernel/resolve/resolve_fast.h"
#include "kernel/resolve/resolve_spheres.h"
#include "kernel/resolve/resolve_triangles.h"

/* ---- the winners ---- */

/* Neighbours mostly hit the same sphere: each different one of a vector is looked up once. */
CGT_SPU_INLINE void look_up_spheres(const cgt_objects *objects, const packet *p, uint32_t i, winners *w,
                                    packet_hits *hits)
{
    const vuint object = spux_load_uint(p->object + i), none = spux_vuint(CGT_INVALID_ID);
    vfloat d[4] = {spux_vfloat(0), spux_vfloat(0), spux_vfloat(0), spux_vfloat(0)};
    vuint primitive = none, geometry = none;
    unsigned left = ~spux_mask_bits(spu_cmpeq(object, none)) & CGT_ALL_LANES;
    while (left) {
        const uint32_t winner = p->object[i + (uint32_t)__builtin_ctz(left)];
        const cgt_object_array *a = cgt_objects_array(objects, winner);
        const cgt_sphere q = cgt_array_sphere(a, winner - a->first);
        const vmask same = spu_cmpeq(object, spux_vuint(winner));
        d[0] = spux_select(d[0], spux_vfloat(q.x), same);
        d[1] = spux_select(d[1], spux_vfloat(q.y), same);
        d[2] = spux_select(d[2], spux_vfloat(q.z), same);
        d[3] = spux_select(d[3], spux_vfloat(q.r), same);
        primitive = spux_select(primitive, spux_vuint(winner - a->first), same);
        geometry = spux_select(geometry, spux_vuint(a->geometry), same);
        left &= ~spux_mask_bits(same);
    }
    for (int a = 0; a < 4; a++)
        spux_store(w->sphere[a] + i, d[a]);
    spux_store_uint(hits->primitive + i, primitive);
    spux_store_uint(hits->geometry + i, geometry);
}

/* Spheres of one array, of a vector that has a winner: its other lanes take that one's. */
CGT_SPU_INLINE void load_spheres(const cgt_object_array *array, const packet *p, uint32_t i, unsigned hit, winners *w,
                                 packet_hits *hits)
{
    const vuint object = spux_load_uint(p->object + i), none = spux_vuint(CGT_INVALID_ID);
    const vmask missed = spu_cmpeq(object, none);
    const vuint number = spux_select(object, spux_vuint(p->object[i + (uint32_t)__builtin_ctz(hit)]), missed);
    vfloat d[4];
    fetch_spheres_at(array, number, d);
    for (int a = 0; a < 4; a++)
        spux_store(w->sphere[a] + i, d[a]);
    spux_store_uint(hits->primitive + i, object);
    spux_store_uint(hits->geometry + i, spux_select(spux_vuint(array->geometry), none, missed));
}

CGT_SPU_INLINE void find_spheres(const cgt_objects *objects, const packet *p, uint32_t first, uint32_t count,
                                 winners *w, packet_hits *hits)
{
    const vuint none = spux_vuint(CGT_INVALID_ID);
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        const unsigned hit = ~spux_mask_bits(spu_cmpeq(spux_load_uint(p->object + i), none)) & CGT_ALL_LANES;
        if (objects->arrays == 1 && hit)
            load_spheres(objects->array, p, i, hit, w, hits);
        else
            look_up_spheres(objects, p, i, w, hits);
        w->hits += spux_count_bits(hit);
    }
}

static void set_triangle(winners *w, uint32_t i, const cgt_triangle *q)
{
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            w->vertex[k][a][i] = q->v[k][a];
}

/* Triangles, or both kinds; what is not hit, or is of the other kind, gets a shape that computes to something. */
CGT_SPU_INLINE void look_up_shapes(const cgt_objects *objects, const packet *p, uint32_t first, uint32_t count,
                                   winners *w, packet_hits *hits)
{
    static const cgt_triangle nothing = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    uint32_t last = CGT_INVALID_ID;
    cgt_shape shape = {.kind = CGT_KIND_TRIANGLES, .triangle = nothing};
    const cgt_object_array *a = NULL;
    for (uint32_t i = first; i < first + count; i++) {
        const uint32_t object = p->object[i];
        const bool hit = object != CGT_INVALID_ID;
        if (hit && object != last) {
            a = cgt_objects_array(objects, object);
            shape = cgt_array_shape(a, object - a->first);
            last = object;
        }
        const bool sphere = hit && shape.kind == CGT_KIND_SPHERES;
        hits->primitive[i] = hit ? object - a->first : CGT_INVALID_ID;
        hits->geometry[i] = hit ? a->geometry : CGT_INVALID_ID;
        w->is_sphere[i] = sphere;
        w->hits += hit;
        set_triangle(w, i, hit && !sphere ? &shape.triangle : &nothing);
        w->sphere[0][i] = sphere ? shape.sphere.x : 0;
        w->sphere[1][i] = sphere ? shape.sphere.y : 0;
        w->sphere[2][i] = sphere ? shape.sphere.z : 0;
        w->sphere[3][i] = sphere ? shape.sphere.r : 0;
    }
}

/* A vector of triangles of one array, of which some lane, `some`, has a winner: the others take that one. */
CGT_SPU_INLINE void load_triangles(const cgt_object_array *array, vuint object, vmask missed, uint32_t some, uint32_t i,
                                   winners *w)
{
    const vuint number = spux_select(object, spux_vuint(some), missed);
    vfloat vertex[3][3];
    if (spux_all(spu_cmpeq(number, spux_vuint(some)))) { /* neighbours mostly hit the same */
        const cgt_triangle q = cgt_array_triangle(array, some);
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                spux_store(w->vertex[k][a] + i, spux_vfloat(q.v[k][a]));
        return;
    }
    fetch_triangles_at(array, number, vertex);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            spux_store(w->vertex[k][a] + i, vertex[k][a]);
}

/* Triangles of one array alone. */
CGT_SPU_INLINE void find_triangles(const cgt_object_array *array, const packet *p, uint32_t first, uint32_t count,
                                   winners *w, packet_hits *hits)
{
    const vuint none = spux_vuint(CGT_INVALID_ID);
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        const vuint object = spux_load_uint(p->object + i);
        const vmask missed = spu_cmpeq(object, none);
        const unsigned hit = ~spux_mask_bits(missed) & CGT_ALL_LANES;
        spux_store_uint(w->is_sphere + i, spux_vuint(0));
        spux_store_uint(hits->primitive + i, object);
        spux_store_uint(hits->geometry + i, spux_select(spux_vuint(array->geometry), none, missed));
        load_triangles(array, object, missed, hit ? p->object[i + (uint32_t)__builtin_ctz(hit)] : 0, i, w);
        w->hits += spux_count_bits(hit);
    }
}

CGT_SPU_INLINE void find_winners(const cgt_objects *objects, const packet *p, uint32_t first, uint32_t count,
                                 winners *w, packet_hits *hits)
{
    if (!objects->triangles)
        find_spheres(objects, p, first, count, w, hits);
    else if (objects->arrays == 1)
        find_triangles(objects->array, p, first, count, w, hits);
    else
        look_up_shapes(objects, p, first, count, w, hits);
}

/* ---- the fields ---- */

CGT_SPU_INLINE void fill_none(uint32_t first, uint32_t count, uint32_t fields, packet_hits *hits)
{
    const vfloat zero = spux_vfloat(0);
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        spux_store(hits->t + i, spux_vfloat(INFINITY));
        if (fields & CGT_FIELD_NORMAL)
            for (int a = 0; a < 3; a++)
                spux_store(hits->normal[a] + i, zero);
        if (fields & CGT_FIELD_UV) {
            spux_store(hits->u + i, zero);
            spux_store(hits->v + i, zero);
        }
    }
}

CGT_SPU_INLINE void fill_nobody(uint32_t first, uint32_t count, packet_hits *hits)
{
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        spux_store_uint(hits->primitive + i, spux_vuint(CGT_INVALID_ID));
        spux_store_uint(hits->geometry + i, spux_vuint(CGT_INVALID_ID));
    }
}

/* Rays first to first + count - 1. Each kind's loop writes the rays of its kind. */
CGT_SPU_INLINE void resolve_rays(const cgt_objects *objects, const packet *p, uint32_t first, uint32_t count,
                                 const cgt_trace_settings *settings, winners *w, packet_hits *hits, cgt_counts *counts)
{
    vuint any = spux_vuint(0);
    for (uint32_t i = first; i < first + count; i += CGT_LANES)
        any = spu_or(any, spu_xor(spux_load_uint(p->object + i), spux_vuint(CGT_INVALID_ID)));
    const bool none = spux_all(spu_cmpeq(any, spux_vuint(0)));
    if (none || objects->triangles || settings->fields & CGT_FIELD_UV)
        fill_none(first, count, settings->fields, hits);
    if (none) {
        fill_nobody(first, count, hits);
        return;
    }
    find_winners(objects, p, first, count, w, hits);
    if (objects->spheres)
        resolve_spheres(p, first, count, settings, !objects->triangles, w, hits, counts);
    if (objects->triangles)
        resolve_triangles(p, first, count, settings, !objects->spheres, w, hits, counts);
}

static void resolve_all(const cgt_objects *objects, const packet *p, const cgt_trace_settings *settings, winners *w,
                        packet_hits *hits, cgt_counts *counts)
{
    const uint32_t lanes = p->lanes;
    uint32_t i = 0;
    for (; i + RESOLVE_RAYS <= lanes; i += RESOLVE_RAYS) /* a length that the compiler knows */
        resolve_rays(objects, p, i, RESOLVE_RAYS, settings, w, hits, counts);
    if (i < lanes)
        resolve_rays(objects, p, i, lanes - i, settings, w, hits, counts);
}

uint32_t CGT_KERNEL(cgt_packet_resolve)(const cgt_world *world, const packet *p, const cgt_trace_settings *settings,
                                        packet_hits *hits, cgt_counts *counts)
{
    const cgt_objects *objects = &world->objects;
    winners w;
    w.hits = 0;
    if (p->fast && !p->extreme && !world->everything) {
        find_winners(objects, p, 0, p->lanes, &w, hits);
        resolve_fast(world, p, settings->fields, &w, hits);
    } else
        resolve_all(objects, p, settings, &w, hits, counts);
    counts->hits += w.hits;
    return w.hits;
}
