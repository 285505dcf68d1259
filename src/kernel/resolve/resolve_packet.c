/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The fields of each ray's hit, from its closest primitive: once per ray, in double, in the order of sphere_double.h
 * and triangle_double.h. So the bits do not depend on the structure or the tests that found the hit, and unfused double
 * arithmetic has the same result at any width. Rays whose values suffer from cancellation are computed again in exact
 * arithmetic. Precision FAST computes in single precision what its bounds allow, in one order, too (fast_spheres.h,
 * fast_triangles.h). */
#include "kernel/primitive/gather_primitives.h"
#include "kernel/resolve/packet_lanes.h"
#include "kernel/resolve/resolve_tested.h"

/* ---- the primitives ---- */

/* A sphere or a capsule: centre or p, q, radius. */
CGT_SPU_INLINE void round_numbers(const cgt_primitive_array *a, uint32_t i, float number[7])
{
    if (a->kind == CGT_KIND_SPHERES) {
        const cgt_sphere q = cgt_array_sphere(a, i);
        number[0] = q.x;
        number[1] = q.y;
        number[2] = q.z;
        number[6] = q.r;
        return;
    }
    const cgt_capsule q = cgt_array_capsule(a, i);
    for (int k = 0; k < 3; k++) {
        number[k] = q.p[k];
        number[3 + k] = q.q[k];
    }
    number[6] = q.r;
}

/* Spheres and capsules of any arrays, for a vector of rays from i on. Neighbours mostly hit the same one: each distinct
 * one is looked up once. What one kind does not have are numbers of others, which its loop does not use. *a: the array
 * of the last one, which neighbours mostly have in common. capsules: a constant; there are some. */
CGT_SPU_INLINE void resolve_lookup_round(const cgt_primitives *prims, const packet *p, uint32_t i, bool capsules,
                                         const cgt_primitive_array **a, hit_primitives *w, packet_hits *hits)
{
    const vuint prim = spux_load_uint(p->prim + i), none = spux_vuint(CGT_INVALID_ID);
    vuint primitive = none, geometry = none, kind = spux_vuint(CGT_KIND_TRIANGLES);
    unsigned remaining = ~spux_mask_bits(spu_cmpeq(prim, none)) & CGT_ALL_LANES;
    vfloat d[7];
    for (int k = 0; k < 7; k++)
        d[k] = spux_vfloat(0);
    while (remaining) {
        const uint32_t hit_prim = p->prim[i + (uint32_t)__builtin_ctz(remaining)];
        const vmask same = spu_cmpeq(prim, spux_vuint(hit_prim));
        if (hit_prim - (*a)->first >= (*a)->count)
            *a = cgt_primitives_array(prims, hit_prim);
        float number[7] = {0};
        round_numbers(*a, hit_prim - (*a)->first, number);
        for (int k = 0; k < 7; k++)
            d[k] = spux_select(d[k], spux_vfloat(number[k]), same);
        primitive = spux_select(primitive, spux_vuint(hit_prim - (*a)->first), same);
        geometry = spux_select(geometry, spux_vuint((*a)->geometry), same);
        kind = spux_select(kind, spux_vuint((*a)->kind), same);
        remaining &= ~spux_mask_bits(same);
    }
    for (int k = 0; k < 3; k++)
        spux_store(w->sphere[k] + i, d[k]);
    spux_store(w->sphere[3] + i, d[6]);
    for (int k = 0; k < 3 && capsules; k++) {
        spux_store(w->vertex[0][k] + i, d[k]);
        spux_store(w->vertex[1][k] + i, d[3 + k]);
    }
    if (capsules)
        spux_store_uint(w->kind + i, kind);
    spux_store_uint(hits->primitive + i, primitive);
    spux_store_uint(hits->geometry + i, geometry);
}

/* Spheres of one array, for a vector with a hit: lanes without one take that of another lane. */
CGT_SPU_INLINE void resolve_load_spheres(const cgt_primitive_array *array, const packet *p, uint32_t i, unsigned hit,
                                         hit_primitives *w, packet_hits *hits)
{
    const vuint prim = spux_load_uint(p->prim + i), none = spux_vuint(CGT_INVALID_ID);
    const vmask missed = spu_cmpeq(prim, none);
    const vuint number = spux_select(prim, spux_vuint(p->prim[i + (uint32_t)__builtin_ctz(hit)]), missed);
    vfloat d[4];
    gather_spheres(array, number, d);
    for (int a = 0; a < 4; a++)
        spux_store(w->sphere[a] + i, d[a]);
    spux_store_uint(hits->primitive + i, prim);
    spux_store_uint(hits->geometry + i, spux_select(spux_vuint(array->geometry), none, missed));
}

/* Spheres, and capsules where there are any. */
CGT_SPU_INLINE void resolve_find_round(const cgt_primitives *prims, const packet *p, uint32_t first, uint32_t count,
                                       bool capsules, hit_primitives *w, packet_hits *hits)
{
    const vuint none = spux_vuint(CGT_INVALID_ID);
    const cgt_primitive_array *a = prims->array;
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        const unsigned hit = ~spux_mask_bits(spu_cmpeq(spux_load_uint(p->prim + i), none)) & CGT_ALL_LANES;
        if (!capsules && prims->arrays == 1 && hit)
            resolve_load_spheres(prims->array, p, i, hit, w, hits);
        else
            resolve_lookup_round(prims, p, i, capsules, &a, w, hits);
        w->hits += spux_count_bits(hit);
    }
}

/* The points of a triangle or a capsule; of a sphere a dummy. */
static cgt_triangle points_of(const cgt_primitive *q)
{
    cgt_triangle t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    if (q->kind == CGT_KIND_TRIANGLES)
        return q->triangle;
    if (q->kind == CGT_KIND_CAPSULES) {
        memcpy(t.v[0], q->capsule.p, sizeof t.v[0]);
        memcpy(t.v[1], q->capsule.q, sizeof t.v[1]);
    }
    return t;
}

/* A sphere; of a capsule its radius. */
static cgt_sphere sphere_of(const cgt_primitive *q)
{
    return q->kind == CGT_KIND_SPHERES ? q->sphere : (cgt_sphere){.r = q->kind == CGT_KIND_CAPSULES ? q->capsule.r : 0};
}

/* Sets the lanes of a vector, from i on, that hit one primitive; all of them first. */
CGT_SPU_INLINE void set_lanes(uint32_t *to, uint32_t value, vmask lanes, bool all)
{
    const vuint v = spux_vuint(value);
    spux_store_uint(to, all ? v : spux_select(spux_load_uint(to), v, lanes));
}

CGT_SPU_INLINE void set_float_lanes(float *to, float value, vmask lanes, bool all)
{
    const vfloat v = spux_vfloat(value);
    spux_store(to, all ? v : spux_select(spux_load(to), v, lanes));
}

CGT_SPU_INLINE void set_primitive(hit_primitives *w, uint32_t i, const cgt_primitive *q, vmask lanes, bool all)
{
    const cgt_triangle points = points_of(q);
    const cgt_sphere sphere = sphere_of(q);
    const float part[4] = {sphere.x, sphere.y, sphere.z, sphere.r};
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            set_float_lanes(w->vertex[k][a] + i, points.v[k][a], lanes, all);
    for (int k = 0; k < 4; k++)
        set_float_lanes(w->sphere[k] + i, part[k], lanes, all);
    set_lanes(w->kind + i, q->kind, lanes, all);
}

/* Triangles of several arrays, or several kinds: each distinct primitive of a vector is looked up once. Lanes without a
 * hit, or of another kind, get a dummy. */
CGT_SPU_INLINE void resolve_lookup_mixed(const cgt_primitives *prims, const packet *p, uint32_t first, uint32_t count,
                                         hit_primitives *w, packet_hits *hits)
{
    static const cgt_primitive dummy = {.kind = CGT_KIND_TRIANGLES, .triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    const vuint none = spux_vuint(CGT_INVALID_ID);
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        const vuint prim = spux_load_uint(p->prim + i);
        const vmask missed = spu_cmpeq(prim, none);
        unsigned remaining = ~spux_mask_bits(missed) & CGT_ALL_LANES;
        bool all = remaining == CGT_ALL_LANES; /* the first one goes to all lanes */
        w->hits += spux_count_bits(remaining);
        if (!all) {
            set_primitive(w, i, &dummy, missed, true);
            set_lanes(hits->primitive + i, CGT_INVALID_ID, missed, true);
            set_lanes(hits->geometry + i, CGT_INVALID_ID, missed, true);
        }
        for (; remaining; all = false) {
            const uint32_t hit_prim = p->prim[i + (uint32_t)__builtin_ctz(remaining)];
            const cgt_primitive_array *a = cgt_primitives_array(prims, hit_prim);
            const cgt_primitive q = cgt_array_primitive(a, hit_prim - a->first);
            const vmask same = spu_cmpeq(prim, spux_vuint(hit_prim));
            set_primitive(w, i, &q, same, all);
            set_lanes(hits->primitive + i, hit_prim - a->first, same, all);
            set_lanes(hits->geometry + i, a->geometry, same, all);
            remaining &= ~spux_mask_bits(same);
        }
    }
}

/* A vector of triangles of one array. Lanes without a hit take the triangle `fallback`. */
CGT_SPU_INLINE void resolve_load_triangles(const cgt_primitive_array *array, vuint prim, vmask missed,
                                           uint32_t fallback, uint32_t i, hit_primitives *w)
{
    const vuint number = spux_select(prim, spux_vuint(fallback), missed);
    vfloat vertex[3][3];
    if (spux_all(spu_cmpeq(number, spux_vuint(fallback)))) { /* neighbours mostly hit the same one */
        const cgt_triangle q = cgt_array_triangle(array, fallback);
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                spux_store(w->vertex[k][a] + i, spux_vfloat(q.v[k][a]));
        return;
    }
    gather_triangles(array, number, vertex);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            spux_store(w->vertex[k][a] + i, vertex[k][a]);
}

/* Triangles of one array. */
CGT_SPU_INLINE void resolve_find_triangles(const cgt_primitive_array *array, const packet *p, uint32_t first,
                                           uint32_t count, hit_primitives *w, packet_hits *hits)
{
    const vuint none = spux_vuint(CGT_INVALID_ID);
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        const vuint prim = spux_load_uint(p->prim + i);
        const vmask missed = spu_cmpeq(prim, none);
        const unsigned hit = ~spux_mask_bits(missed) & CGT_ALL_LANES;
        spux_store_uint(w->kind + i, spux_vuint(CGT_KIND_TRIANGLES));
        spux_store_uint(hits->primitive + i, prim);
        spux_store_uint(hits->geometry + i, spux_select(spux_vuint(array->geometry), none, missed));
        resolve_load_triangles(array, prim, missed, hit ? p->prim[i + (uint32_t)__builtin_ctz(hit)] : 0, i, w);
        w->hits += spux_count_bits(hit);
    }
}

CGT_SPU_INLINE bool has_spheres_alone(const cgt_primitives *prims) { return !prims->triangles && !prims->capsules; }

CGT_SPU_INLINE void resolve_load_hits(const cgt_primitives *prims, const packet *p, uint32_t first, uint32_t count,
                                      hit_primitives *w, packet_hits *hits)
{
    if (has_spheres_alone(prims))
        resolve_find_round(prims, p, first, count, false, w, hits);
    else if (prims->arrays == 1 && prims->triangles)
        resolve_find_triangles(prims->array, p, first, count, w, hits);
    else if (!prims->triangles)
        resolve_find_round(prims, p, first, count, true, w, hits);
    else
        resolve_lookup_mixed(prims, p, first, count, w, hits);
}

/* ---- the fields ---- */

CGT_SPU_INLINE void fill_no_hit(uint32_t first, uint32_t count, uint32_t fields, packet_hits *hits)
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

CGT_SPU_INLINE void fill_no_primitive(uint32_t first, uint32_t count, packet_hits *hits)
{
    for (uint32_t i = first; i < first + count; i += CGT_LANES) {
        spux_store_uint(hits->primitive + i, spux_vuint(CGT_INVALID_ID));
        spux_store_uint(hits->geometry + i, spux_vuint(CGT_INVALID_ID));
    }
}

/* Rays first to first + count - 1. The loop of each kind writes the rays that hit it. */
CGT_SPU_INLINE void resolve_rays(const cgt_primitives *prims, const packet *p, uint32_t first, uint32_t count,
                                 const cgt_trace_settings *settings, hit_primitives *w, packet_hits *hits,
                                 cgt_counts *counts)
{
    vuint hit_bits = spux_vuint(0);
    for (uint32_t i = first; i < first + count; i += CGT_LANES)
        hit_bits = spu_or(hit_bits, spu_xor(spux_load_uint(p->prim + i), spux_vuint(CGT_INVALID_ID)));
    const bool none = spux_all(spu_cmpeq(hit_bits, spux_vuint(0)));
    if (none || !has_spheres_alone(prims) || settings->fields & CGT_FIELD_UV)
        fill_no_hit(first, count, settings->fields, hits);
    if (none) {
        fill_no_primitive(first, count, hits);
        return;
    }
    /* gather the primitives, then compute */
    resolve_load_hits(prims, p, first, count, w, hits);
    if (prims->spheres)
        resolve_spheres(p, first, count, settings, has_spheres_alone(prims), w, hits, counts);
    if (prims->triangles)
        resolve_triangles(p, first, count, settings, !prims->spheres && !prims->capsules, w, hits, counts);
    if (prims->capsules)
        resolve_capsules(p, first, count, settings, w, hits);
}

static void resolve_all(const cgt_primitives *prims, const packet *p, const cgt_trace_settings *settings,
                        hit_primitives *w, packet_hits *hits, cgt_counts *counts)
{
    const uint32_t lanes = p->lanes;
    uint32_t i = 0;
    for (; i + RESOLVE_RAYS <= lanes; i += RESOLVE_RAYS) /* a constant length */
        resolve_rays(prims, p, i, RESOLVE_RAYS, settings, w, hits, counts);
    if (i < lanes)
        resolve_rays(prims, p, i, lanes - i, settings, w, hits, counts);
}

uint32_t CGT_KERNEL(cgt_packet_resolve)(const cgt_committed_scene *committed_scene, const packet *p,
                                        const cgt_trace_settings *settings, packet_hits *hits, cgt_counts *counts)
{
    const cgt_primitives *prims = &committed_scene->prims;
    hit_primitives w;
    w.hits = 0;
    if (p->fast && !p->extreme && !committed_scene->brute_force) {
        resolve_load_hits(prims, p, 0, p->lanes, &w, hits);
        resolve_tested(committed_scene, p, settings->fields, &w, hits);
    } else
        resolve_all(prims, p, settings, &w, hits, counts);
    counts->hits += w.hits;
    return w.hits;
}
