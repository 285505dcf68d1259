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

#define TILE_LINE 16u                            /* pixels of a line of the cache */
#define TILE_STRIP (PACKET_MAX_RAYS / TILE_EDGE) /* rows; even */

/* What the canonical directions of a tile's pixels are the sums of, or the origins of parallel rays: the forward axis and
 * a column's share of the right one, and a row's share of the upward one, in the order of tile_directions. */
typedef struct tile_sight {
    _Alignas(CGT_VECTOR_BYTES) float across[3][TILE_EDGE];
    float up[TILE_EDGE][4];
} tile_sight;

CGT_SPU_INLINE void tile_sight_make(const tile *t, tile_sight *s)
{
    const cgt_camera_rays *c = t->rays;
    const float *from = t->parallel ? c->eye : c->fwd;
    for (int a = 0; a < 3; a++)
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES)
            spux_store(s->across[a] + x, spu_add(spux_vfloat(from[a]), spu_mul(spux_load_unaligned(t->column + x),
                                                                               spux_vfloat(c->right[a]))));
    for (uint32_t y = 0; y < TILE_EDGE; y++)
        for (int a = 0; a < 3; a++)
            s->up[y][a] = t->row[y] * c->up[a];
}

/* Of columns x and on. */
CGT_SPU_INLINE void tile_sight_at(const tile_sight *s, uint32_t x, uint32_t row, vfloat dir[3])
{
    for (int a = 0; a < 3; a++)
        dir[a] = spu_add(spux_load(s->across[a] + x), spux_vfloat(s->up[row][a]));
}
CGT_SPU_INLINE void tile_sight_double_at(const tile_sight *s, uint32_t x, uint32_t row, resolve_half h[2])
{
    for (int a = 0; a < 3; a++)
        for (uint32_t i = 0; i < 2; i++)
            h[i].d[a] = spux_double_sum(s->across[a] + x + i * CGT_DOUBLES, s->up[row][a]);
}

/* ---- objects of one array ---- */

CGT_SPU_INLINE bool tile_on_lines(const void *plane) { return (uintptr_t)plane % (4 * TILE_LINE) == 0; }

/* Whether whole lines may go past the caches. */
CGT_SPU_INLINE bool tile_streams(const cgt_region *r)
{
    return SPUX_STREAMS && r->stream && r->width == TILE_EDGE && r->height % 2 == 0 && r->row_stride % TILE_LINE == 0 &&
           tile_on_lines(r->t) && tile_on_lines(r->primitive) && tile_on_lines(r->geometry) &&
           tile_on_lines(r->normal[0]) && tile_on_lines(r->normal[1]) && tile_on_lines(r->normal[2]) &&
           tile_on_lines(r->u) && tile_on_lines(r->v);
}

/* A vector of pixels side by side in a row of a tile. */
typedef struct tile_pixels {
    uint32_t x, row; /* of the first one */
    vuint object;
    vmask missed;
    uint32_t some; /* an object that one of them has met, CGT_INVALID_ID where there is none */
    bool alone;    /* and no other */
} tile_pixels;

/* What they get. */
typedef struct tile_hits {
    vuint object;
    vfloat t, u, v, normal[3];
    unsigned left; /* lanes that are for tile_mend */
} tile_hits;

/* What the last vector of pixels has met: the next one has mostly met the same. */
typedef struct tile_prepared_sphere {
    uint32_t number;
    prepared_sphere sphere;
} tile_prepared_sphere;

/* What is constant over a frame; inlined with constants where that makes loops shorter. */
typedef struct tile_wish {
    bool triangles, stream, exact, fast;
    bool mesh;       /* triangles are prepared */
    bool parallel;   /* rays: tile_sight_at tells their origins */
    uint32_t fields; /* t, u v and normals */
} tile_wish;

/* What is kept from vector to vector. */
typedef struct tile_kept {
    const tile_met *met;
    const tile_sight *sight;
    tile_prepared_sphere *sphere;
    const tile_mesh *mesh;
} tile_kept;

/* Objects of lanes, those without a hit having one that another lane has met. */
CGT_SPU_INLINE vuint tile_numbers(const tile_pixels *p)
{
    return spux_select(p->object, spux_vuint(p->some), p->missed);
}

CGT_SPU_INLINE void tile_keep_normals(const vfloat normal[3], vmask missed, tile_hits *h)
{
    for (int a = 0; a < 3; a++)
        h->normal[a] = spux_select(normal[a], spux_vfloat(0), missed);
}

/* These three return the lanes that are right. */
CGT_SPU_INLINE vmask tile_resolve_spheres(const cgt_world *world, const tile *t, tile_wish wish, const tile_pixels *p,
                                          tile_kept kept, tile_hits *h)
{
    const cgt_object_array *array = world->objects.array;
    const float *eye = t->rays->eye;
    const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
    const vfloat t_min = spux_vfloat(t->rays->t_min);
    const vmask hit = spux_not(p->missed);
    const bool normals = wish.fields & CGT_FIELD_NORMAL;
    vfloat sphere[4], found;
    vmask known;
    if (wish.fast) {
        vfloat dir[3], n[3];
        tile_sight_at(kept.sight, p->x, p->row, dir);
        fetch_spheres_at(array, tile_numbers(p), sphere);
        known = resolve_fast_spheres(org, dir, sphere, t_min, normals, &found, n);
        if (normals)
            tile_keep_normals(n, p->missed, h);
    } else {
        resolve_half half[2];
        tile_sight_double_at(kept.sight, p->x, p->row, half);
        if (p->alone) {
            if (p->some != kept.sphere->number) {
                kept.sphere->number = p->some;
                kept.sphere->sphere = prepare_sphere(eye, cgt_array_sphere(array, p->some));
            }
            known = resolve_prepared_sphere(&kept.sphere->sphere, t_min, normals, hit, half, &found, h->normal);
        } else {
            fetch_spheres_at(array, tile_numbers(p), sphere);
            known = resolve_spheres_vector(org, sphere, t_min, normals, hit, half, &found, h->normal);
        }
    }
    h->t = spux_select(found, h->t, p->missed);
    return known;
}

CGT_SPU_INLINE vmask tile_resolve_triangles(const cgt_world *world, const tile *t, tile_wish wish, const tile_pixels *p,
                                            const vfloat dir[3], tile_kept kept, tile_hits *h)
{
    const float *eye = t->rays->eye;
    const vfloat zero = spux_vfloat(0);
    const uint32_t fields = wish.fields;
    const bool exact = wish.exact;
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    vmask known;
    if (wish.mesh) {
        const unsigned hit = ~spux_mask_bits(p->missed) & CGT_ALL_LANES;
        const uint32_t some = t->slot[tile_index(p->x + (uint32_t)__builtin_ctz(hit), p->row)];
        vuint slot[2] = {spux_vuint(some), spux_vuint(some)};
        if (!p->alone)
            tile_rows(t->slot, p->x, p->row & ~1u, slot);
        known = tile_mesh_resolve(kept.mesh, slot[p->row & 1], some, p->alone, p->missed, dir, fields, exact, &found);
    } else {
        const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
        vfloat vertex[3][3];
        fetch_triangles_at(world->objects.array, tile_numbers(p), vertex);
        known = resolve_triangles_vector(org, dir, vertex, fields, exact, &found);
    }
    h->t = spux_select(found.t, h->t, p->missed);
    h->u = spux_select(found.u, zero, p->missed);
    h->v = spux_select(found.v, zero, p->missed);
    tile_keep_normals(found.normal, p->missed, h);
    return known;
}

/* Parallel rays, from these origins. */
CGT_SPU_INLINE vmask tile_resolve_parallel(const cgt_world *world, const tile *t, tile_wish wish, const tile_pixels *p,
                                           const vfloat org[3], tile_hits *h)
{
    const cgt_object_array *array = world->objects.array;
    const float *fwd = t->rays->fwd;
    const vfloat zero = spux_vfloat(0), dir[3] = {spux_vfloat(fwd[0]), spux_vfloat(fwd[1]), spux_vfloat(fwd[2])};
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    resolve_half half[2];
    vmask known;
    if (wish.triangles) {
        vfloat vertex[3][3];
        fetch_triangles_at(array, tile_numbers(p), vertex);
        known = resolve_triangles_vector(org, dir, vertex, wish.fields, wish.exact, &found);
    } else {
        const cgt_sphere q = cgt_array_sphere(array, p->some);
        vfloat sphere[4] = {spux_vfloat(q.x), spux_vfloat(q.y), spux_vfloat(q.z), spux_vfloat(q.r)};
        if (!p->alone)
            fetch_spheres_at(array, tile_numbers(p), sphere);
        resolve_directions(dir, half);
        known = resolve_spheres_vector(org, sphere, spux_vfloat(t->rays->t_min), wish.fields & CGT_FIELD_NORMAL,
                                       spux_not(p->missed), half, &found.t, found.normal);
    }
    h->t = spux_select(found.t, h->t, p->missed);
    h->u = spux_select(found.u, zero, p->missed);
    h->v = spux_select(found.v, zero, p->missed);
    tile_keep_normals(found.normal, p->missed, h);
    return known;
}

/* Columns x and on of a row, which have met `object`. */
CGT_SPU_INLINE tile_hits tile_resolve_vector(const cgt_world *world, const tile *t, tile_wish wish, uint32_t x,
                                             uint32_t row, vuint object, tile_kept kept)
{
    const vfloat zero = spux_vfloat(0);
    const uint32_t i = tile_met_index(x, row);
    const tile_pixels p = {
        x, row, object, spu_cmpeq(object, spux_vuint(CGT_INVALID_ID)), kept.met->some[i], kept.met->alone[i]};
    tile_hits h = {object, spux_vfloat(INFINITY), zero, zero, {zero, zero, zero}, 0};
    if (p.some == CGT_INVALID_ID || !wish.fields)
        return h;
    vfloat dir[3];
    tile_sight_at(kept.sight, x, row, dir);
    vmask known;
    if (wish.parallel)
        known = tile_resolve_parallel(world, t, wish, &p, dir, &h);
    else if (wish.triangles)
        known = tile_resolve_triangles(world, t, wish, &p, dir, kept, &h);
    else
        known = tile_resolve_spheres(world, t, wish, &p, kept, &h);
    h.left = spux_mask_bits(spux_not(spu_or(p.missed, known)));
    return h;
}

/* The lanes that are left: the long way of spheres by vectors, then ray by ray. */
CGT_SPU_INLINE void tile_mend(const cgt_world *world, const tile *t, tile_wish wish, const tile_sight *sight,
                              uint32_t x, uint32_t row, tile_hits *h, cgt_counts *counts)
{
    unsigned left = h->left;
    if (left && !wish.triangles) {
        const cgt_camera_rays *c = t->rays;
        const uint32_t some = h->object[__builtin_ctz(left)];
        const vmask mine = spux_mask_from_bits(left);
        vfloat line[2][3], sphere[4];
        for (int a = 0; a < 3; a++)
            line[wish.parallel][a] = spux_vfloat(wish.parallel ? c->fwd[a] : c->eye[a]);
        tile_sight_at(sight, x, row, line[!wish.parallel]);
        fetch_spheres_at(world->objects.array, spux_select(spux_vuint(some), h->object, mine), sphere);
        left &= ~spux_mask_bits(resolve_spheres_long(line[0], line[1], sphere, spux_vfloat(c->t_min),
                                                     wish.fields & CGT_FIELD_NORMAL, mine, &h->t, h->normal));
    }
    for (; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const cgt_ray ray = tile_ray(t, tile_index(x + (uint32_t)k, row));
        if (wish.triangles) {
            const cgt_triangle q = cgt_objects_triangle(&world->objects, h->object[k]);
            const resolved_triangle s = resolve_triangle_ray(&ray, &q, wish.fields, wish.exact, counts);
            h->t[k] = s.t;
            h->u[k] = s.u;
            h->v[k] = s.v;
            for (int a = 0; a < 3; a++)
                h->normal[a][k] = s.normal[a];
        } else {
            const cgt_sphere q = cgt_objects_sphere(&world->objects, h->object[k]);
            const resolved_sphere s = resolve_sphere_ray(&ray, q, counts);
            h->t[k] = s.t;
            for (int a = 0; a < 3; a++)
                h->normal[a][k] = s.normal[a];
        }
    }
}

/* Where a vector of pixels goes: columns x and on of a row, which begin at `at` in the planes. */
typedef struct tile_place {
    const cgt_region *region;
    bool stream;
    uint32_t x, row;
    size_t at;
} tile_place;

/* A region less wide than a tile ends among a vector's columns. */
CGT_SPU_INLINE void tile_put(void *plane, tile_place to, vuint v)
{
    const cgt_region *r = to.region;
    uint32_t *p = (uint32_t *)plane + to.at;
    if (!plane)
        return;
    if (to.stream)
        spux_stream_uint(p, v);
    else if (to.x + CGT_LANES <= r->width)
        spux_store_unaligned_uint(p, v);
    else
        spux_store_mask_uint(p, v, spux_mask_first(r->width - to.x));
}

CGT_SPU_INLINE void tile_put_hits(tile_place to, uint32_t geometry, tile_hits h)
{
    const vuint none = spux_vuint(CGT_INVALID_ID);
    const cgt_region *r = to.region;
    tile_put(r->t, to, (vuint)h.t);
    tile_put(r->primitive, to, h.object);
    tile_put(r->geometry, to, spux_select(spux_vuint(geometry), none, spu_cmpeq(h.object, none)));
    for (int a = 0; a < 3; a++)
        tile_put(r->normal[a], to, (vuint)h.normal[a]);
    tile_put(r->u, to, (vuint)h.u);
    tile_put(r->v, to, (vuint)h.v);
}

/* A line of the cache of each plane, and of two rows: narrow vectors fill it before it goes past the caches. */
typedef struct tile_lines {
    _Alignas(4 * TILE_LINE) uint32_t plane[8][2 * TILE_LINE];
} tile_lines;

CGT_SPU_INLINE cgt_region tile_lines_region(const cgt_region *r, tile_lines *lines)
{
    cgt_region q = *r;
    void *of[8];
    for (int k = 0; k < 8; k++)
        of[k] = lines->plane[k];
    q.t = r->t ? of[0] : NULL;
    q.primitive = r->primitive ? of[1] : NULL;
    q.geometry = r->geometry ? of[2] : NULL;
    for (int a = 0; a < 3; a++)
        q.normal[a] = r->normal[a] ? of[3 + a] : NULL;
    q.u = r->u ? of[6] : NULL;
    q.v = r->v ? of[7] : NULL;
    q.row_stride = TILE_LINE;
    return q;
}

CGT_SPU_INLINE void tile_stream_plane(void *to, size_t at, size_t row_stride, const void *from)
{
    if (!to)
        return;
    spux_stream_line((uint32_t *)to + at, from);
    spux_stream_line((uint32_t *)to + at + row_stride, (const uint32_t *)from + TILE_LINE);
}

/* What is in the lines: columns x and on of rows y and y + 1. */
CGT_SPU_INLINE void tile_stream_lines(const cgt_region *r, const cgt_region *lines, uint32_t x, uint32_t y)
{
    const size_t at = (size_t)y * r->row_stride + x;
    tile_stream_plane(r->t, at, r->row_stride, lines->t);
    tile_stream_plane(r->primitive, at, r->row_stride, lines->primitive);
    tile_stream_plane(r->geometry, at, r->row_stride, lines->geometry);
    for (int a = 0; a < 3; a++)
        tile_stream_plane(r->normal[a], at, r->row_stride, lines->normal[a]);
    tile_stream_plane(r->u, at, r->row_stride, lines->u);
    tile_stream_plane(r->v, at, r->row_stride, lines->v);
}

__attribute__((noinline, unused)) static void tile_put_mended(const cgt_world *world, const tile *t, tile_wish wish,
                                                              const tile_sight *sight, tile_place to, tile_hits *h,
                                                              cgt_counts *counts)
{
    tile_mend(world, t, wish, sight, to.x, to.row, h, counts);
    tile_put_hits(to, world->objects.array->geometry, *h);
}

CGT_SPU_INLINE void tile_resolve_row(const cgt_world *world, const tile *t, tile_wish wish, tile_kept kept,
                                     tile_place to, vuint object, cgt_counts *counts)
{
    const tile_hits h = tile_resolve_vector(world, t, wish, to.x, to.row, object, kept);
    if (__builtin_expect(h.left != 0, 0)) { /* of a copy: the hits stay in registers */
        tile_hits left = h;
        tile_put_mended(world, t, wish, kept.sight, to, &left, counts);
    } else
        tile_put_hits(to, world->objects.array->geometry, h);
}

CGT_SPU_INLINE void tile_resolve_to(const cgt_world *world, const tile *t, const cgt_region *region, tile_wish wish,
                                    tile_kept kept, cgt_counts *counts)
{
    const bool by_lines = wish.stream && CGT_LANES < TILE_LINE;
    const cgt_region r = *region; /* a copy: nothing that is stored changes it */
    tile_lines lines;
    const cgt_region q = by_lines ? tile_lines_region(&r, &lines) : r;
    for (uint32_t y = 0; y < r.height; y += 2)
        for (uint32_t x = 0; x < r.width; x += CGT_LANES) {
            const size_t at = by_lines ? x % TILE_LINE : (size_t)y * r.row_stride + x;
            const tile_place to = {&q, wish.stream && !by_lines, x, y, at};
            const tile_place below = {&q, wish.stream && !by_lines, x, y + 1, at + q.row_stride};
            vuint object[2];
            tile_rows(t->object, x, y, object);
            tile_resolve_row(world, t, wish, kept, to, object[0], counts);
            if (wish.stream || y + 1 < r.height)
                tile_resolve_row(world, t, wish, kept, below, object[1], counts);
            if (by_lines && (x + CGT_LANES) % TILE_LINE == 0)
                tile_stream_lines(&r, &q, x + CGT_LANES - TILE_LINE, y);
        }
}

/* Constants make the loops shorter. */
CGT_SPU_INLINE void tile_resolve_streamed(const cgt_world *world, const tile *t, const cgt_region *r, tile_wish wish,
                                          tile_kept kept, cgt_counts *counts)
{
    wish.stream = tile_streams(r);
    if (wish.stream) {
        wish.stream = true;
        tile_resolve_to(world, t, r, wish, kept, counts);
        spux_stream_end();
    } else {
        wish.stream = false;
        tile_resolve_to(world, t, r, wish, kept, counts);
    }
}

__attribute__((noinline, unused)) static void tile_resolve_sphere_array(const cgt_world *world, const tile *t,
                                                                        const cgt_region *r, tile_wish wish,
                                                                        tile_kept kept, cgt_counts *counts)
{
    tile_prepared_sphere prepared = {.number = CGT_INVALID_ID};
    kept.sphere = &prepared;
    wish.triangles = wish.parallel = false;
    if (!(wish.fields & CGT_FIELD_NORMAL))
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    else {
        wish.fields = CGT_FIELD_T | CGT_FIELD_NORMAL;
        if (wish.fast) {
            wish.fast = true;
            tile_resolve_streamed(world, t, r, wish, kept, counts);
        } else {
            wish.fast = false;
            tile_resolve_streamed(world, t, r, wish, kept, counts);
        }
    }
}

__attribute__((noinline, unused)) static void tile_resolve_triangle_array(const cgt_world *world, const tile *t,
                                                                          const cgt_region *r, tile_wish wish,
                                                                          tile_kept kept, cgt_counts *counts)
{
    tile_mesh mesh;
    kept.mesh = &mesh;
    wish.triangles = true;
    wish.parallel = false;
    wish.mesh = wish.fields && t->lists < TILE_LIST;
    if (wish.mesh)
        tile_mesh_prepare(world, t, wish.fields, wish.exact, &mesh);
    if (wish.fields & CGT_FIELD_UV)
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    else {
        wish.fields &= CGT_FIELD_T | CGT_FIELD_NORMAL;
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    }
}

__attribute__((noinline, unused)) static void tile_resolve_parallel_array(const cgt_world *world, const tile *t,
                                                                          const cgt_region *r, tile_wish wish,
                                                                          tile_kept kept, cgt_counts *counts)
{
    wish.parallel = true;
    if (wish.triangles) {
        wish.triangles = true;
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    } else {
        wish.triangles = false;
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    }
}

CGT_SPU_INLINE void tile_resolve_array(const cgt_world *world, const tile *t, const cgt_trace_settings *settings,
                                       const cgt_region *r, cgt_counts *counts)
{
    const tile_wish wish = {.triangles = world->objects.triangles != 0,
                            .exact = settings->precision == CGT_PRECISION_EXACT,
                            .fast = settings->precision == CGT_PRECISION_FAST,
                            .fields = (r->t ? CGT_FIELD_T : 0u) | (r->normal[0] ? CGT_FIELD_NORMAL : 0u) |
                                      (r->u && world->objects.triangles ? CGT_FIELD_UV : 0u)};
    tile_met met;
    tile_sight sight;
    const tile_kept kept = {.met = &met, .sight = &sight};
    if (tile_meet(t, r, &met, counts) && wish.fields) /* else no vector asks for it */
        tile_sight_make(t, &sight);
    if (t->parallel)
        tile_resolve_parallel_array(world, t, r, wish, kept, counts);
    else if (world->objects.triangles)
        tile_resolve_triangle_array(world, t, r, wish, kept, counts);
    else
        tile_resolve_sphere_array(world, t, r, wish, kept, counts);
}

/* ---- nothing ---- */

/* A region that no object has come to. */
__attribute__((noinline, unused)) static void tile_resolve_nothing(const cgt_region *r)
{
    const vfloat zero = spux_vfloat(0);
    const tile_hits none = {spux_vuint(CGT_INVALID_ID), spux_vfloat(INFINITY), zero, zero, {zero, zero, zero}, 0};
    if (!tile_streams(r)) {
        for (uint32_t y = 0; y < r->height; y++)
            for (uint32_t x = 0; x < r->width; x += CGT_LANES)
                tile_put_hits((tile_place){r, false, x, y, (size_t)y * r->row_stride + x}, CGT_INVALID_ID, none);
        return;
    }
    tile_lines lines;
    const cgt_region q = tile_lines_region(r, &lines);
    for (uint32_t k = 0; k < 2 * TILE_LINE; k += CGT_LANES)
        tile_put_hits((tile_place){&q, false, 0, 0, k}, CGT_INVALID_ID, none);
    for (uint32_t y = 0; y < r->height; y += 2)
        for (uint32_t x = 0; x < r->width; x += TILE_LINE)
            tile_stream_lines(r, &q, x, y);
    spux_stream_end();
}

/* ---- anything, by rows ---- */

CGT_SPU_INLINE void tile_strip_rays(const tile *t, uint32_t y, packet *p)
{
    for (uint32_t row = 0; row < TILE_STRIP; row += 2)
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES) {
            const uint32_t *from = t->object + tile_index(x, y + row);
            vuint object[2] = {spux_load_uint(from), spux_load_uint(from + CGT_LANES)};
            spux_unzip(object);
            for (uint32_t k = 0; k < 2; k++) {
                const uint32_t i = (row + k) * TILE_EDGE + x;
                spux_store_uint(p->object + i, object[k]);
                if (spux_all(spu_cmpeq(object[k], spux_vuint(CGT_INVALID_ID))))
                    continue;
                vfloat dir[3];
                tile_directions(t, t->parallel, spux_load_unaligned(t->column + x), spux_vfloat(t->row[y + row + k]),
                                dir);
                for (int a = 0; a < 3; a++)
                    spux_store((t->parallel ? p->org : p->dir)[a] + i, dir[a]);
            }
        }
}

/* Whole vectors between the row's ends past the caches, wherever it begins. */
CGT_SPU_INLINE void tile_strip_stream(uint32_t *to, const uint32_t *from, uint32_t count)
{
    const uint32_t before = (uint32_t)(-(uintptr_t)to % CGT_VECTOR_BYTES / sizeof *to);
    uint32_t x = before < count ? before : count;
    memcpy(to, from, x * sizeof *to);
    for (; x + CGT_LANES <= count; x += CGT_LANES)
        spux_stream_uint(to + x, spux_load_unaligned_uint(from + x));
    memcpy(to + x, from + x, (count - x) * sizeof *to);
}

CGT_SPU_INLINE void tile_strip_plane(void *plane, const void *from, const cgt_region *r, uint32_t y, uint32_t rows)
{
    if (!plane)
        return;
    for (uint32_t k = 0; k < rows; k++) {
        uint32_t *to = (uint32_t *)plane + (y + k) * r->row_stride;
        const uint32_t *row = (const uint32_t *)from + k * TILE_EDGE;
        if (r->stream)
            tile_strip_stream(to, row, r->width);
        else
            memcpy(to, row, r->width * sizeof *to);
    }
}

CGT_SPU_INLINE void tile_strip_store(const packet_hits *h, const cgt_region *r, uint32_t y)
{
    const uint32_t rows = r->height - y < TILE_STRIP ? r->height - y : TILE_STRIP;
    tile_strip_plane(r->t, h->t, r, y, rows);
    tile_strip_plane(r->primitive, h->primitive, r, y, rows);
    tile_strip_plane(r->geometry, h->geometry, r, y, rows);
    for (int a = 0; a < 3; a++)
        tile_strip_plane(r->normal[a], h->normal[a], r, y, rows);
    tile_strip_plane(r->u, h->u, r, y, rows);
    tile_strip_plane(r->v, h->v, r, y, rows);
}

__attribute__((noinline, unused)) static void tile_resolve(const cgt_world *world, const tile *t,
                                                           const cgt_trace_settings *settings, const cgt_region *region,
                                                           cgt_counts *counts)
{
    packet p;
    packet_hits hits;
    cgt_trace_settings exactly = *settings;
    if (!t->open) {
        tile_resolve_nothing(region);
        return;
    }
    if (world->objects.arrays == 1) {
        tile_resolve_array(world, t, settings, region, counts);
        return;
    }
    if (settings->precision == CGT_PRECISION_FAST) /* takes what its tests leave in a packet */
        exactly.precision = CGT_PRECISION_ROBUST;
    camera_packet_begin(t->rays, &exactly, PACKET_MAX_EDGE, false, &p);
    p.extreme = false;
    for (uint32_t y = 0; y < region->height; y += TILE_STRIP) {
        tile_strip_rays(t, y, &p);
        CGT_KERNEL(cgt_packet_resolve)(world, &p, &exactly, &hits, counts);
        tile_strip_store(&hits, region, y);
    }
    if (region->stream)
        spux_stream_end();
}

#endif
