/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a tile's winners to the caller's planes. Objects of one array go from a vector of pixels straight to them; all
 * else some whole rows at a time as a packet of rays, which lie in it as their pixels do in the planes. */
#ifndef CGT_TILE_RESOLVE_H
#define CGT_TILE_RESOLVE_H

#include "kernel/packet/camera_packet.h"
#include "kernel/primitive/gather_primitives.h"
#include "kernel/resolve/resolve_fast_vectors.h"
#include "kernel/resolve/resolve_spheres.h"
#include "kernel/resolve/resolve_triangles.h"
#include "kernel/tile_frame/tile_prepared_triangles.h"
#include "kernel/tile_frame/tile_pixel_runs.h"

#define TILE_CACHE_LINE 16u                           /* pixels of a line of the cache */
#define TILE_STRIP_ROWS (PACKET_MAX_RAYS / TILE_EDGE) /* rows; even */

/* What the canonical directions of a tile's pixels are the sums of, or the origins of parallel rays: the forward axis and
 * a column's share of the right one, and a row's share of the upward one, in the order of tile_compute_directions. */
typedef struct tile_ray_table {
    _Alignas(CGT_VECTOR_BYTES) float column_sum[3][TILE_EDGE];
    float up[TILE_EDGE][4];
} tile_ray_table;

CGT_SPU_INLINE void tile_init_ray_table(const tile *t, tile_ray_table *s)
{
    const cgt_camera_rays *c = t->rays;
    const float *from = t->parallel ? c->eye : c->fwd;
    for (int a = 0; a < 3; a++)
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES)
            spux_store(s->column_sum[a] + x, spu_add(spux_vfloat(from[a]), spu_mul(spux_load_unaligned(t->column + x),
                                                                                   spux_vfloat(c->right[a]))));
    for (uint32_t y = 0; y < TILE_EDGE; y++)
        for (int a = 0; a < 3; a++)
            s->up[y][a] = t->row[y] * c->up[a];
}

/* Of columns x and on. */
CGT_SPU_INLINE void tile_load_directions(const tile_ray_table *s, uint32_t x, uint32_t row, vfloat dir[3])
{
    for (int a = 0; a < 3; a++)
        dir[a] = spu_add(spux_load(s->column_sum[a] + x), spux_vfloat(s->up[row][a]));
}
CGT_SPU_INLINE void tile_load_double_directions(const tile_ray_table *s, uint32_t x, uint32_t row, resolve_half h[2])
{
    for (int a = 0; a < 3; a++)
        for (uint32_t i = 0; i < 2; i++)
            h[i].d[a] = spux_double_sum(s->column_sum[a] + x + i * CGT_DOUBLES, s->up[row][a]);
}

/* ---- objects of one array ---- */

CGT_SPU_INLINE bool tile_is_line_aligned(const void *plane) { return (uintptr_t)plane % (4 * TILE_CACHE_LINE) == 0; }

/* Whether whole lines may go past the caches. */
CGT_SPU_INLINE bool tile_can_stream(const cgt_region *r)
{
    return SPUX_STREAMS && r->nontemporal && r->width == TILE_EDGE && r->height % 2 == 0 &&
           r->row_stride % TILE_CACHE_LINE == 0 && tile_is_line_aligned(r->t) && tile_is_line_aligned(r->primitive) &&
           tile_is_line_aligned(r->geometry) && tile_is_line_aligned(r->normal[0]) &&
           tile_is_line_aligned(r->normal[1]) && tile_is_line_aligned(r->normal[2]) && tile_is_line_aligned(r->u) &&
           tile_is_line_aligned(r->v);
}

/* A vector of pixels side by side in a row of a tile. */
typedef struct tile_pixel_vector {
    uint32_t x, row; /* of the first one */
    vuint prim;
    vmask missed;
    uint32_t first_prim; /* an object that one of them has met, CGT_INVALID_ID where there is none */
    bool uniform;        /* and no other */
} tile_pixel_vector;

/* What they get. */
typedef struct tile_hits {
    vuint prim;
    vfloat t, u, v, normal[3];
    unsigned unresolved; /* lanes that are for tile_resolve_remaining */
} tile_hits;

/* What the last vector of pixels has met: the next one has mostly met the same. */
typedef struct tile_prepared_sphere {
    uint32_t number;
    prepared_sphere sphere;
} tile_prepared_sphere;

/* What is constant over a frame; inlined with constants where that makes loops shorter. */
typedef struct tile_resolve_mode {
    bool triangles, nontemporal, exact, fast;
    bool prepared;   /* triangles are prepared */
    bool parallel;   /* rays: tile_load_directions tells their origins */
    uint32_t fields; /* t, u v and normals */
} tile_resolve_mode;

/* What is kept from vector to vector. */
typedef struct tile_resolve_cache {
    const tile_pixel_runs *pixel_runs;
    const tile_ray_table *ray_table;
    tile_prepared_sphere *sphere;
    const tile_prepared_triangles *prepared;
} tile_resolve_cache;

/* Objects of lanes, those without a hit having one that another lane has met. */
CGT_SPU_INLINE vuint tile_pixel_prims(const tile_pixel_vector *p)
{
    return spux_select(p->prim, spux_vuint(p->first_prim), p->missed);
}

CGT_SPU_INLINE void tile_store_normals(const vfloat normal[3], vmask missed, tile_hits *h)
{
    for (int a = 0; a < 3; a++)
        h->normal[a] = spux_select(normal[a], spux_vfloat(0), missed);
}

/* These three return the lanes that are right. */
CGT_SPU_INLINE vmask tile_resolve_spheres(const cgt_committed_scene *committed_scene, const tile *t,
                                          tile_resolve_mode mode, const tile_pixel_vector *p, tile_resolve_cache cache,
                                          tile_hits *h)
{
    const cgt_primitive_array *array = committed_scene->prims.array;
    const float *eye = t->rays->eye;
    const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
    const vfloat t_min = spux_vfloat(t->rays->t_min);
    const vmask hit = spux_not(p->missed);
    const bool normals = mode.fields & CGT_FIELD_NORMAL;
    vfloat sphere[4], found;
    vmask resolved;
    if (mode.fast) {
        vfloat dir[3], n[3];
        tile_load_directions(cache.ray_table, p->x, p->row, dir);
        gather_spheres(array, tile_pixel_prims(p), sphere);
        resolved = resolve_fast_spheres(org, dir, sphere, t_min, normals, &found, n);
        if (normals)
            tile_store_normals(n, p->missed, h);
    } else {
        resolve_half half[2];
        tile_load_double_directions(cache.ray_table, p->x, p->row, half);
        if (p->uniform) {
            if (p->first_prim != cache.sphere->number) {
                cache.sphere->number = p->first_prim;
                cache.sphere->sphere = prepare_sphere(eye, cgt_array_sphere(array, p->first_prim));
            }
            resolved = resolve_prepared_sphere(&cache.sphere->sphere, t_min, normals, hit, half, &found, h->normal);
        } else {
            gather_spheres(array, tile_pixel_prims(p), sphere);
            resolved = resolve_spheres_vector(org, sphere, t_min, normals, hit, half, &found, h->normal);
        }
    }
    h->t = spux_select(found, h->t, p->missed);
    return resolved;
}

CGT_SPU_INLINE vmask tile_resolve_triangles(const cgt_committed_scene *committed_scene, const tile *t,
                                            tile_resolve_mode mode, const tile_pixel_vector *p, const vfloat dir[3],
                                            tile_resolve_cache cache, tile_hits *h)
{
    const float *eye = t->rays->eye;
    const vfloat zero = spux_vfloat(0);
    const uint32_t fields = mode.fields;
    const bool exact = mode.exact;
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    vmask resolved;
    if (mode.prepared) {
        const unsigned hit = ~spux_mask_bits(p->missed) & CGT_ALL_LANES;
        const uint32_t first_slot = t->slot[tile_index(p->x + (uint32_t)__builtin_ctz(hit), p->row)];
        vuint slot[2] = {spux_vuint(first_slot), spux_vuint(first_slot)};
        if (!p->uniform)
            tile_load_rows(t->slot, p->x, p->row & ~1u, slot);
        resolved = tile_resolve_prepared(cache.prepared, slot[p->row & 1], first_slot, p->uniform, p->missed, dir,
                                         fields, exact, &found);
    } else {
        const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
        vfloat vertex[3][3];
        gather_triangles(committed_scene->prims.array, tile_pixel_prims(p), vertex);
        resolved = resolve_triangles_vector(org, dir, vertex, fields, exact, &found);
    }
    h->t = spux_select(found.t, h->t, p->missed);
    h->u = spux_select(found.u, zero, p->missed);
    h->v = spux_select(found.v, zero, p->missed);
    tile_store_normals(found.normal, p->missed, h);
    return resolved;
}

/* Parallel rays, from these origins. */
CGT_SPU_INLINE vmask tile_resolve_parallel(const cgt_committed_scene *committed_scene, const tile *t,
                                           tile_resolve_mode mode, const tile_pixel_vector *p, const vfloat org[3],
                                           tile_hits *h)
{
    const cgt_primitive_array *array = committed_scene->prims.array;
    const float *fwd = t->rays->fwd;
    const vfloat zero = spux_vfloat(0), dir[3] = {spux_vfloat(fwd[0]), spux_vfloat(fwd[1]), spux_vfloat(fwd[2])};
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    resolve_half half[2];
    vmask resolved;
    if (mode.triangles) {
        vfloat vertex[3][3];
        gather_triangles(array, tile_pixel_prims(p), vertex);
        resolved = resolve_triangles_vector(org, dir, vertex, mode.fields, mode.exact, &found);
    } else {
        const cgt_sphere q = cgt_array_sphere(array, p->first_prim);
        vfloat sphere[4] = {spux_vfloat(q.x), spux_vfloat(q.y), spux_vfloat(q.z), spux_vfloat(q.r)};
        if (!p->uniform)
            gather_spheres(array, tile_pixel_prims(p), sphere);
        resolve_directions(dir, half);
        resolved = resolve_spheres_vector(org, sphere, spux_vfloat(t->rays->t_min), mode.fields & CGT_FIELD_NORMAL,
                                          spux_not(p->missed), half, &found.t, found.normal);
    }
    h->t = spux_select(found.t, h->t, p->missed);
    h->u = spux_select(found.u, zero, p->missed);
    h->v = spux_select(found.v, zero, p->missed);
    tile_store_normals(found.normal, p->missed, h);
    return resolved;
}

/* Columns x and on of a row, which have met `object`. */
CGT_SPU_INLINE tile_hits tile_resolve_vector(const cgt_committed_scene *committed_scene, const tile *t,
                                             tile_resolve_mode mode, uint32_t x, uint32_t row, vuint prim,
                                             tile_resolve_cache cache)
{
    const vfloat zero = spux_vfloat(0);
    const uint32_t i = tile_pixel_run_index(x, row);
    const tile_pixel_vector p = {x,
                                 row,
                                 prim,
                                 spu_cmpeq(prim, spux_vuint(CGT_INVALID_ID)),
                                 cache.pixel_runs->first_prim[i],
                                 cache.pixel_runs->uniform[i]};
    tile_hits h = {prim, spux_vfloat(INFINITY), zero, zero, {zero, zero, zero}, 0};
    if (p.first_prim == CGT_INVALID_ID || !mode.fields)
        return h;
    vfloat dir[3];
    tile_load_directions(cache.ray_table, x, row, dir);
    vmask resolved;
    if (mode.parallel)
        resolved = tile_resolve_parallel(committed_scene, t, mode, &p, dir, &h);
    else if (mode.triangles)
        resolved = tile_resolve_triangles(committed_scene, t, mode, &p, dir, cache, &h);
    else
        resolved = tile_resolve_spheres(committed_scene, t, mode, &p, cache, &h);
    h.unresolved = spux_mask_bits(spux_not(spu_or(p.missed, resolved)));
    return h;
}

/* The lanes that are left: the long way of spheres by vectors, then ray by ray. */
CGT_SPU_INLINE void tile_resolve_remaining(const cgt_committed_scene *committed_scene, const tile *t,
                                           tile_resolve_mode mode, const tile_ray_table *ray_table, uint32_t x,
                                           uint32_t row, tile_hits *h, cgt_counts *counts)
{
    unsigned unresolved = h->unresolved;
    if (unresolved && !mode.triangles) {
        const cgt_camera_rays *c = t->rays;
        const uint32_t first_prim = h->prim[__builtin_ctz(unresolved)];
        const vmask lanes = spux_mask_from_bits(unresolved);
        vfloat org_dir[2][3], sphere[4];
        for (int a = 0; a < 3; a++)
            org_dir[mode.parallel][a] = spux_vfloat(mode.parallel ? c->fwd[a] : c->eye[a]);
        tile_load_directions(ray_table, x, row, org_dir[!mode.parallel]);
        gather_spheres(committed_scene->prims.array, spux_select(spux_vuint(first_prim), h->prim, lanes), sphere);
        unresolved &= ~spux_mask_bits(resolve_spheres_long(org_dir[0], org_dir[1], sphere, spux_vfloat(c->t_min),
                                                           mode.fields & CGT_FIELD_NORMAL, lanes, &h->t, h->normal));
    }
    for (; unresolved; unresolved &= unresolved - 1) {
        const int k = __builtin_ctz(unresolved);
        const cgt_ray ray = tile_pixel_ray(t, tile_index(x + (uint32_t)k, row));
        if (mode.triangles) {
            const cgt_triangle q = cgt_primitives_triangle(&committed_scene->prims, h->prim[k]);
            const resolved_triangle s = resolve_triangle_ray(&ray, &q, mode.fields, mode.exact, counts);
            h->t[k] = s.t;
            h->u[k] = s.u;
            h->v[k] = s.v;
            for (int a = 0; a < 3; a++)
                h->normal[a][k] = s.normal[a];
        } else {
            const cgt_sphere q = cgt_primitives_sphere(&committed_scene->prims, h->prim[k]);
            const resolved_sphere s = resolve_sphere_ray(&ray, q, counts);
            h->t[k] = s.t;
            for (int a = 0; a < 3; a++)
                h->normal[a][k] = s.normal[a];
        }
    }
}

/* Where a vector of pixels goes: columns x and on of a row, which begin at `at` in the planes. */
typedef struct tile_store_target {
    const cgt_region *region;
    bool nontemporal;
    uint32_t x, row;
    size_t offset;
} tile_store_target;

/* A region less wide than a tile ends among a vector's columns. */
CGT_SPU_INLINE void tile_store_plane(void *plane, tile_store_target to, vuint v)
{
    const cgt_region *r = to.region;
    uint32_t *p = (uint32_t *)plane + to.offset;
    if (!plane)
        return;
    if (to.nontemporal)
        spux_stream_uint(p, v);
    else if (to.x + CGT_LANES <= r->width)
        spux_store_unaligned_uint(p, v);
    else
        spux_store_mask_uint(p, v, spux_mask_first(r->width - to.x));
}

CGT_SPU_INLINE void tile_store_hits(tile_store_target to, uint32_t geometry, tile_hits h)
{
    const vuint none = spux_vuint(CGT_INVALID_ID);
    const cgt_region *r = to.region;
    tile_store_plane(r->t, to, (vuint)h.t);
    tile_store_plane(r->primitive, to, h.prim);
    tile_store_plane(r->geometry, to, spux_select(spux_vuint(geometry), none, spu_cmpeq(h.prim, none)));
    for (int a = 0; a < 3; a++)
        tile_store_plane(r->normal[a], to, (vuint)h.normal[a]);
    tile_store_plane(r->u, to, (vuint)h.u);
    tile_store_plane(r->v, to, (vuint)h.v);
}

/* A line of the cache of each plane, and of two rows: narrow vectors fill it before it goes past the caches. */
typedef struct tile_cache_lines {
    _Alignas(4 * TILE_CACHE_LINE) uint32_t plane[8][2 * TILE_CACHE_LINE];
} tile_cache_lines;

CGT_SPU_INLINE cgt_region tile_cache_lines_region(const cgt_region *r, tile_cache_lines *lines)
{
    cgt_region q = *r;
    void *line[8];
    for (int k = 0; k < 8; k++)
        line[k] = lines->plane[k];
    q.t = r->t ? line[0] : NULL;
    q.primitive = r->primitive ? line[1] : NULL;
    q.geometry = r->geometry ? line[2] : NULL;
    for (int a = 0; a < 3; a++)
        q.normal[a] = r->normal[a] ? line[3 + a] : NULL;
    q.u = r->u ? line[6] : NULL;
    q.v = r->v ? line[7] : NULL;
    q.row_stride = TILE_CACHE_LINE;
    return q;
}

CGT_SPU_INLINE void tile_stream_plane(void *to, size_t offset, size_t row_stride, const void *from)
{
    if (!to)
        return;
    spux_stream_line((uint32_t *)to + offset, from);
    spux_stream_line((uint32_t *)to + offset + row_stride, (const uint32_t *)from + TILE_CACHE_LINE);
}

/* What is in the lines: columns x and on of rows y and y + 1. */
CGT_SPU_INLINE void tile_stream_lines(const cgt_region *r, const cgt_region *lines, uint32_t x, uint32_t y)
{
    const size_t offset = (size_t)y * r->row_stride + x;
    tile_stream_plane(r->t, offset, r->row_stride, lines->t);
    tile_stream_plane(r->primitive, offset, r->row_stride, lines->primitive);
    tile_stream_plane(r->geometry, offset, r->row_stride, lines->geometry);
    for (int a = 0; a < 3; a++)
        tile_stream_plane(r->normal[a], offset, r->row_stride, lines->normal[a]);
    tile_stream_plane(r->u, offset, r->row_stride, lines->u);
    tile_stream_plane(r->v, offset, r->row_stride, lines->v);
}

__attribute__((noinline, unused)) static void
tile_store_remaining_hits(const cgt_committed_scene *committed_scene, const tile *t, tile_resolve_mode mode,
                          const tile_ray_table *ray_table, tile_store_target to, tile_hits *h, cgt_counts *counts)
{
    tile_resolve_remaining(committed_scene, t, mode, ray_table, to.x, to.row, h, counts);
    tile_store_hits(to, committed_scene->prims.array->geometry, *h);
}

CGT_SPU_INLINE void tile_resolve_row(const cgt_committed_scene *committed_scene, const tile *t, tile_resolve_mode mode,
                                     tile_resolve_cache cache, tile_store_target to, vuint prim, cgt_counts *counts)
{
    const tile_hits h = tile_resolve_vector(committed_scene, t, mode, to.x, to.row, prim, cache);
    if (__builtin_expect(h.unresolved != 0, 0)) { /* of a copy: the hits stay in registers */
        tile_hits unresolved = h;
        tile_store_remaining_hits(committed_scene, t, mode, cache.ray_table, to, &unresolved, counts);
    } else
        tile_store_hits(to, committed_scene->prims.array->geometry, h);
}

CGT_SPU_INLINE void tile_resolve_region(const cgt_committed_scene *committed_scene, const tile *t,
                                        const cgt_region *region, tile_resolve_mode mode, tile_resolve_cache cache,
                                        cgt_counts *counts)
{
    const bool by_lines = mode.nontemporal && CGT_LANES < TILE_CACHE_LINE;
    const cgt_region r = *region; /* a copy: nothing that is stored changes it */
    tile_cache_lines lines;
    const cgt_region q = by_lines ? tile_cache_lines_region(&r, &lines) : r;
    for (uint32_t y = 0; y < r.height; y += 2)
        for (uint32_t x = 0; x < r.width; x += CGT_LANES) {
            const size_t offset = by_lines ? x % TILE_CACHE_LINE : (size_t)y * r.row_stride + x;
            const tile_store_target to = {&q, mode.nontemporal && !by_lines, x, y, offset};
            const tile_store_target next_row = {&q, mode.nontemporal && !by_lines, x, y + 1, offset + q.row_stride};
            vuint prim[2];
            tile_load_rows(t->prim, x, y, prim);
            tile_resolve_row(committed_scene, t, mode, cache, to, prim[0], counts);
            if (mode.nontemporal || y + 1 < r.height)
                tile_resolve_row(committed_scene, t, mode, cache, next_row, prim[1], counts);
            if (by_lines && (x + CGT_LANES) % TILE_CACHE_LINE == 0)
                tile_stream_lines(&r, &q, x + CGT_LANES - TILE_CACHE_LINE, y);
        }
}

/* Constants make the loops shorter. */
CGT_SPU_INLINE void tile_resolve_streamed(const cgt_committed_scene *committed_scene, const tile *t,
                                          const cgt_region *r, tile_resolve_mode mode, tile_resolve_cache cache,
                                          cgt_counts *counts)
{
    mode.nontemporal = tile_can_stream(r);
    if (mode.nontemporal) {
        mode.nontemporal = true;
        tile_resolve_region(committed_scene, t, r, mode, cache, counts);
        spux_stream_end();
    } else {
        mode.nontemporal = false;
        tile_resolve_region(committed_scene, t, r, mode, cache, counts);
    }
}

__attribute__((noinline, unused)) static void tile_resolve_sphere_array(const cgt_committed_scene *committed_scene,
                                                                        const tile *t, const cgt_region *r,
                                                                        tile_resolve_mode mode,
                                                                        tile_resolve_cache cache, cgt_counts *counts)
{
    tile_prepared_sphere prepared = {.number = CGT_INVALID_ID};
    cache.sphere = &prepared;
    mode.triangles = mode.parallel = false;
    if (!(mode.fields & CGT_FIELD_NORMAL))
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
    else {
        mode.fields = CGT_FIELD_T | CGT_FIELD_NORMAL;
        if (mode.fast) {
            mode.fast = true;
            tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
        } else {
            mode.fast = false;
            tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
        }
    }
}

__attribute__((noinline, unused)) static void tile_resolve_triangle_array(const cgt_committed_scene *committed_scene,
                                                                          const tile *t, const cgt_region *r,
                                                                          tile_resolve_mode mode,
                                                                          tile_resolve_cache cache, cgt_counts *counts)
{
    tile_prepared_triangles prepared;
    cache.prepared = &prepared;
    mode.triangles = true;
    mode.parallel = false;
    mode.prepared = mode.fields && t->triangle_count < TILE_MAX_TRIANGLES;
    if (mode.prepared)
        tile_prepare_triangles(committed_scene, t, mode.fields, mode.exact, &prepared);
    if (mode.fields & CGT_FIELD_UV)
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
    else {
        mode.fields &= CGT_FIELD_T | CGT_FIELD_NORMAL;
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
    }
}

__attribute__((noinline, unused)) static void tile_resolve_parallel_array(const cgt_committed_scene *committed_scene,
                                                                          const tile *t, const cgt_region *r,
                                                                          tile_resolve_mode mode,
                                                                          tile_resolve_cache cache, cgt_counts *counts)
{
    mode.parallel = true;
    if (mode.triangles) {
        mode.triangles = true;
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
    } else {
        mode.triangles = false;
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
    }
}

CGT_SPU_INLINE void tile_resolve_array(const cgt_committed_scene *committed_scene, const tile *t,
                                       const cgt_trace_settings *settings, const cgt_region *r, cgt_counts *counts)
{
    const tile_resolve_mode mode = {.triangles = committed_scene->prims.triangles != 0,
                                    .exact = settings->precision == CGT_PRECISION_EXACT,
                                    .fast = settings->precision == CGT_PRECISION_FAST,
                                    .fields = (r->t ? CGT_FIELD_T : 0u) | (r->normal[0] ? CGT_FIELD_NORMAL : 0u) |
                                              (r->u && committed_scene->prims.triangles ? CGT_FIELD_UV : 0u)};
    tile_pixel_runs pixel_runs;
    tile_ray_table ray_table;
    const tile_resolve_cache cache = {.pixel_runs = &pixel_runs, .ray_table = &ray_table};
    if (tile_compute_pixel_runs(t, r, &pixel_runs, counts) && mode.fields) /* else no vector asks for it */
        tile_init_ray_table(t, &ray_table);
    if (t->parallel)
        tile_resolve_parallel_array(committed_scene, t, r, mode, cache, counts);
    else if (committed_scene->prims.triangles)
        tile_resolve_triangle_array(committed_scene, t, r, mode, cache, counts);
    else
        tile_resolve_sphere_array(committed_scene, t, r, mode, cache, counts);
}

/* ---- nothing ---- */

/* A region that no object has come to. */
__attribute__((noinline, unused)) static void tile_resolve_empty(const cgt_region *r)
{
    const vfloat zero = spux_vfloat(0);
    const tile_hits none = {spux_vuint(CGT_INVALID_ID), spux_vfloat(INFINITY), zero, zero, {zero, zero, zero}, 0};
    if (!tile_can_stream(r)) {
        for (uint32_t y = 0; y < r->height; y++)
            for (uint32_t x = 0; x < r->width; x += CGT_LANES)
                tile_store_hits((tile_store_target){r, false, x, y, (size_t)y * r->row_stride + x}, CGT_INVALID_ID,
                                none);
        return;
    }
    tile_cache_lines lines;
    const cgt_region q = tile_cache_lines_region(r, &lines);
    for (uint32_t k = 0; k < 2 * TILE_CACHE_LINE; k += CGT_LANES)
        tile_store_hits((tile_store_target){&q, false, 0, 0, k}, CGT_INVALID_ID, none);
    for (uint32_t y = 0; y < r->height; y += 2)
        for (uint32_t x = 0; x < r->width; x += TILE_CACHE_LINE)
            tile_stream_lines(r, &q, x, y);
    spux_stream_end();
}

/* ---- anything, by rows ---- */

CGT_SPU_INLINE void tile_load_strip(const tile *t, uint32_t y, packet *p)
{
    for (uint32_t row = 0; row < TILE_STRIP_ROWS; row += 2)
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES) {
            const uint32_t *from = t->prim + tile_index(x, y + row);
            vuint prim[2] = {spux_load_uint(from), spux_load_uint(from + CGT_LANES)};
            spux_unzip(prim);
            for (uint32_t k = 0; k < 2; k++) {
                const uint32_t i = (row + k) * TILE_EDGE + x;
                spux_store_uint(p->prim + i, prim[k]);
                if (spux_all(spu_cmpeq(prim[k], spux_vuint(CGT_INVALID_ID))))
                    continue;
                vfloat dir[3];
                tile_compute_directions(t, t->parallel, spux_load_unaligned(t->column + x),
                                        spux_vfloat(t->row[y + row + k]), dir);
                for (int a = 0; a < 3; a++)
                    spux_store((t->parallel ? p->org : p->dir)[a] + i, dir[a]);
            }
        }
}

/* Whole vectors between the row's ends past the caches, wherever it begins. */
CGT_SPU_INLINE void tile_stream_row(uint32_t *to, const uint32_t *from, uint32_t count)
{
    const uint32_t unaligned = (uint32_t)(-(uintptr_t)to % CGT_VECTOR_BYTES / sizeof *to);
    uint32_t x = unaligned < count ? unaligned : count;
    memcpy(to, from, x * sizeof *to);
    for (; x + CGT_LANES <= count; x += CGT_LANES)
        spux_stream_uint(to + x, spux_load_unaligned_uint(from + x));
    memcpy(to + x, from + x, (count - x) * sizeof *to);
}

CGT_SPU_INLINE void tile_store_strip_plane(void *plane, const void *from, const cgt_region *r, uint32_t y,
                                           uint32_t rows)
{
    if (!plane)
        return;
    for (uint32_t k = 0; k < rows; k++) {
        uint32_t *to = (uint32_t *)plane + (y + k) * r->row_stride;
        const uint32_t *row = (const uint32_t *)from + k * TILE_EDGE;
        if (r->nontemporal)
            tile_stream_row(to, row, r->width);
        else
            memcpy(to, row, r->width * sizeof *to);
    }
}

CGT_SPU_INLINE void tile_store_strip(const packet_hits *h, const cgt_region *r, uint32_t y)
{
    const uint32_t rows = r->height - y < TILE_STRIP_ROWS ? r->height - y : TILE_STRIP_ROWS;
    tile_store_strip_plane(r->t, h->t, r, y, rows);
    tile_store_strip_plane(r->primitive, h->primitive, r, y, rows);
    tile_store_strip_plane(r->geometry, h->geometry, r, y, rows);
    for (int a = 0; a < 3; a++)
        tile_store_strip_plane(r->normal[a], h->normal[a], r, y, rows);
    tile_store_strip_plane(r->u, h->u, r, y, rows);
    tile_store_strip_plane(r->v, h->v, r, y, rows);
}

__attribute__((noinline, unused)) static void tile_resolve(const cgt_committed_scene *committed_scene, const tile *t,
                                                           const cgt_trace_settings *settings, const cgt_region *region,
                                                           cgt_counts *counts)
{
    packet p;
    packet_hits hits;
    cgt_trace_settings robust_settings = *settings;
    if (!t->initialised) {
        tile_resolve_empty(region);
        return;
    }
    if (committed_scene->prims.arrays == 1) {
        tile_resolve_array(committed_scene, t, settings, region, counts);
        return;
    }
    if (settings->precision == CGT_PRECISION_FAST) /* takes what its tests leave in a packet */
        robust_settings.precision = CGT_PRECISION_ROBUST;
    camera_packet_init(t->rays, &robust_settings, PACKET_MAX_EDGE, false, &p);
    p.extreme = false;
    for (uint32_t y = 0; y < region->height; y += TILE_STRIP_ROWS) {
        tile_load_strip(t, y, &p);
        CGT_KERNEL(cgt_packet_resolve)(committed_scene, &p, &robust_settings, &hits, counts);
        tile_store_strip(&hits, region, y);
    }
    if (region->nontemporal)
        spux_stream_end();
}

#endif
