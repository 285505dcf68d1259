/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a tile's winners to the caller's planes. Objects of one array go from a vector of pixels straight to them; all
 * else some whole rows at a time as a packet of rays, which lie in it as their pixels do in the planes. */
#ifndef CGT_TILE_RESOLVE_H
#define CGT_TILE_RESOLVE_H

#include "camera_packet.h"
#include "object_fetch.h"
#include "resolve_fast_vectors.h"
#include "resolve_spheres.h"
#include "resolve_triangles.h"
#include "tile_mesh.h"
#include "tile_met.h"

#define TILE_LINE 16u                            /* pixels of a line of the cache */
#define TILE_STRIP (PACKET_MAX_RAYS / TILE_EDGE) /* rows; even */

/* Of pixels i and on. */
CGT_SPU_INLINE void tile_directions_at(const tile *t, bool parallel, uint32_t i, vfloat dir[3])
{
    const float *px = t->px + (i & (TILE_PAIR - 1));
    tile_directions(t, parallel, spux_load_unaligned(px), spux_load(t->py[i / TILE_PAIR]), dir);
}

/* ---- objects of one array ---- */

/* A row of a vector's columns of a plane; a region less wide than a tile ends among them. */
CGT_SPU_INLINE void tile_put_row(uint32_t *to, const cgt_region *r, bool stream, uint32_t x, vuint v)
{
    if (stream)
        spux_stream_uint(to, v);
    else if (x + CGT_LANES <= r->width)
        spux_store_unaligned_uint(to, v);
    else
        spux_store_mask_uint(to, v, spux_mask_first(r->width - x));
}

CGT_SPU_INLINE bool tile_on_lines(const void *plane) { return (uintptr_t)plane % (4 * TILE_LINE) == 0; }

/* Whether whole lines may go past the caches. */
CGT_SPU_INLINE bool tile_streams(const cgt_region *r)
{
    return SPUX_STREAMS && r->stream && r->width == TILE_EDGE && r->height % 2 == 0 && r->row_stride % TILE_LINE == 0 &&
           tile_on_lines(r->t) && tile_on_lines(r->primitive) && tile_on_lines(r->geometry) &&
           tile_on_lines(r->normal[0]) && tile_on_lines(r->normal[1]) && tile_on_lines(r->normal[2]) &&
           tile_on_lines(r->u) && tile_on_lines(r->v);
}

/* What a vector of pixels gets. */
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
    bool parallel;   /* rays: tile_directions are their origins */
    uint32_t fields; /* t, u v and normals */
} tile_wish;

/* The objects of a vector, `number`, lanes without a hit having that of one that has, `some`. */
CGT_SPU_INLINE vmask tile_resolve_spheres(const cgt_world *world, const tile *t, tile_wish wish, vuint number,
                                          uint32_t some, bool alone, vmask missed, const vfloat dir[3],
                                          tile_prepared_sphere *kept, tile_hits *h)
{
    const cgt_object_array *array = world->objects.array;
    const float *eye = t->rays->eye;
    const vfloat t_min = spux_vfloat(t->rays->t_min), zero = spux_vfloat(0);
    const bool normals = wish.fields & CGT_FIELD_NORMAL;
    vfloat n[3] = {zero, zero, zero}, found;
    vmask known;
    if (!wish.fast && alone) {
        if (some != kept->number) {
            kept->number = some;
            kept->sphere = prepare_sphere(eye, cgt_array_sphere(array, some));
        }
        known = resolve_prepared_sphere(&kept->sphere, dir, t_min, normals, &found, n);
    } else {
        const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
        vfloat sphere[4];
        fetch_spheres_at(array, number, sphere);
        known = wish.fast ? resolve_fast_spheres(org, dir, sphere, t_min, normals, &found, n)
                          : resolve_spheres_vector(org, dir, sphere, t_min, normals, &found, n);
    }
    h->t = spux_select(found, h->t, missed);
    if (normals)
        for (int a = 0; a < 3; a++)
            h->normal[a] = spux_select(n[a], zero, missed);
    return known;
}

CGT_SPU_INLINE vmask tile_resolve_triangles(const cgt_world *world, const tile *t, tile_wish wish, uint32_t i,
                                            vuint number, bool alone, vmask missed, const vfloat dir[3],
                                            const tile_mesh *mesh, tile_hits *h)
{
    const cgt_object_array *array = world->objects.array;
    const float *eye = t->rays->eye;
    const vfloat zero = spux_vfloat(0);
    const uint32_t fields = wish.fields;
    const bool exact = wish.exact;
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    vmask known;
    if (wish.mesh)
        known = tile_mesh_resolve(t, mesh, i, alone, missed, dir, fields, exact, &found);
    else {
        const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
        vfloat vertex[3][3];
        fetch_triangles_at(array, number, vertex);
        known = resolve_triangles_vector(org, dir, vertex, fields, exact, &found);
    }
    h->t = spux_select(found.t, h->t, missed);
    h->u = spux_select(found.u, zero, missed);
    h->v = spux_select(found.v, zero, missed);
    for (int a = 0; a < 3; a++)
        h->normal[a] = spux_select(found.normal[a], zero, missed);
    return known;
}

/* What is kept from vector to vector. */
typedef struct tile_kept {
    const tile_met *met;
    tile_prepared_sphere *sphere;
    const tile_mesh *mesh;
} tile_kept;

/* A vector of parallel rays, from these origins. */
CGT_SPU_INLINE vmask tile_resolve_parallel(const cgt_world *world, const tile *t, tile_wish wish, vuint number,
                                           uint32_t some, bool alone, vmask missed, const vfloat org[3], tile_hits *h)
{
    const cgt_object_array *array = world->objects.array;
    const float *fwd = t->rays->fwd;
    const vfloat zero = spux_vfloat(0), dir[3] = {spux_vfloat(fwd[0]), spux_vfloat(fwd[1]), spux_vfloat(fwd[2])};
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    vmask known;
    if (wish.triangles) {
        vfloat vertex[3][3];
        fetch_triangles_at(array, number, vertex);
        known = resolve_triangles_vector(org, dir, vertex, wish.fields, wish.exact, &found);
    } else {
        const cgt_sphere q = cgt_array_sphere(array, some);
        vfloat sphere[4] = {spux_vfloat(q.x), spux_vfloat(q.y), spux_vfloat(q.z), spux_vfloat(q.r)};
        if (!alone)
            fetch_spheres_at(array, number, sphere);
        known = resolve_spheres_vector(org, dir, sphere, spux_vfloat(t->rays->t_min), wish.fields & CGT_FIELD_NORMAL,
                                       &found.t, found.normal);
    }
    h->t = spux_select(found.t, h->t, missed);
    h->u = spux_select(found.u, zero, missed);
    h->v = spux_select(found.v, zero, missed);
    for (int a = 0; a < 3; a++)
        h->normal[a] = spux_select(found.normal[a], zero, missed);
    return known;
}

CGT_SPU_INLINE tile_hits tile_resolve_vector(const cgt_world *world, const tile *t, tile_wish wish, uint32_t i,
                                             tile_kept kept)
{
    const vfloat zero = spux_vfloat(0);
    tile_hits h = {spux_load_uint(t->object + i), spux_vfloat(INFINITY), zero, zero, {zero, zero, zero}, 0};
    const vmask missed = spu_cmpeq(h.object, spux_vuint(CGT_NONE));
    const uint32_t some = kept.met->some[i / CGT_LANES];
    if (some == CGT_NONE || !wish.fields)
        return h;
    const vuint number = spux_select(h.object, spux_vuint(some), missed);
    vfloat dir[3];
    tile_directions_at(t, wish.parallel, i, dir);
    const bool alone = kept.met->alone[i / CGT_LANES];
    vmask known;
    if (wish.parallel)
        known = tile_resolve_parallel(world, t, wish, number, some, alone, missed, dir, &h);
    else if (wish.triangles)
        known = tile_resolve_triangles(world, t, wish, i, number, alone, missed, dir, kept.mesh, &h);
    else
        known = tile_resolve_spheres(world, t, wish, number, some, alone, missed, dir, kept.sphere, &h);
    h.left = spux_mask_bits(spux_not(spu_or(missed, known)));
    return h;
}

/* The lanes that are left: the long way of spheres by vectors, then ray by ray. */
CGT_SPU_INLINE void tile_mend(const cgt_world *world, const tile *t, tile_wish wish, uint32_t i, tile_hits *h,
                              cgt_counts *counts)
{
    unsigned left = h->left;
    if (left && !wish.triangles) {
        const cgt_camera_rays *c = t->rays;
        const uint32_t some = h->object[__builtin_ctz(left)];
        const vmask mine = spux_mask_from_bits(left);
        vfloat line[2][3], sphere[4];
        for (int a = 0; a < 3; a++)
            line[wish.parallel][a] = spux_vfloat(wish.parallel ? c->fwd[a] : c->eye[a]);
        tile_directions_at(t, wish.parallel, i, line[!wish.parallel]);
        fetch_spheres_at(world->objects.array, spux_select(spux_vuint(some), h->object, mine), sphere);
        left &= ~spux_mask_bits(resolve_spheres_long(line[0], line[1], sphere, spux_vfloat(c->t_min),
                                                     wish.fields & CGT_FIELD_NORMAL, mine, &h->t, h->normal));
    }
    for (; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const cgt_ray ray = tile_ray(t, i + (uint32_t)k);
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

/* Where two vectors of pixels go: columns x and on of rows y and y + 1, which begin at `at` in the planes. */
typedef struct tile_place {
    const cgt_region *region;
    bool stream;
    uint32_t x, y;
    size_t at;
} tile_place;

/* Two vectors of pixels, as a tile has them, to a plane. */
CGT_SPU_INLINE void tile_put(void *plane, tile_place to, vuint a, vuint b)
{
    const cgt_region *r = to.region;
    vuint row[2] = {a, b};
    if (!plane)
        return;
    uint32_t *p = (uint32_t *)plane + to.at;
    spux_unzip(row);
    tile_put_row(p, r, to.stream, to.x, row[0]);
    if (to.stream || to.y + 1 < r->height)
        tile_put_row(p + r->row_stride, r, to.stream, to.x, row[1]);
}

CGT_SPU_INLINE void tile_put_hits(tile_place to, uint32_t geometry, tile_hits a, tile_hits b)
{
    const vuint none = spux_vuint(CGT_NONE), it = spux_vuint(geometry);
    const cgt_region *r = to.region;
    tile_put(r->t, to, (vuint)a.t, (vuint)b.t);
    tile_put(r->primitive, to, a.object, b.object);
    tile_put(r->geometry, to, spux_select(it, none, spu_cmpeq(a.object, none)),
             spux_select(it, none, spu_cmpeq(b.object, none)));
    tile_put(r->normal[0], to, (vuint)a.normal[0], (vuint)b.normal[0]);
    tile_put(r->normal[1], to, (vuint)a.normal[1], (vuint)b.normal[1]);
    tile_put(r->normal[2], to, (vuint)a.normal[2], (vuint)b.normal[2]);
    tile_put(r->u, to, (vuint)a.u, (vuint)b.u);
    tile_put(r->v, to, (vuint)a.v, (vuint)b.v);
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
                                                              tile_place to, tile_hits h[2], cgt_counts *counts)
{
    for (uint32_t k = 0; k < 2; k++)
        tile_mend(world, t, wish, tile_index(to.x, to.y) + k * CGT_LANES, &h[k], counts);
    tile_put_hits(to, world->objects.array->geometry, h[0], h[1]);
}

CGT_SPU_INLINE void tile_resolve_to(const cgt_world *world, const tile *t, const cgt_region *region, tile_wish wish,
                                    tile_kept kept, cgt_counts *counts)
{
    const uint32_t geometry = world->objects.array->geometry;
    const bool by_lines = wish.stream && CGT_LANES < TILE_LINE;
    const cgt_region r = *region; /* a copy: nothing that is stored changes it */
    tile_lines lines;
    const cgt_region q = by_lines ? tile_lines_region(&r, &lines) : r;
    for (uint32_t y = 0; y < r.height; y += 2)
        for (uint32_t x = 0; x < r.width; x += CGT_LANES) {
            const uint32_t i = tile_index(x, y);
            const size_t at = by_lines ? x % TILE_LINE : (size_t)y * r.row_stride + x;
            const tile_place to = {&q, wish.stream && !by_lines, x, y, at};
            const tile_hits a = tile_resolve_vector(world, t, wish, i, kept);
            const tile_hits b = tile_resolve_vector(world, t, wish, i + CGT_LANES, kept);
            if (__builtin_expect((a.left | b.left) != 0, 0)) { /* of copies: the hits stay in registers */
                tile_hits left[2] = {a, b};
                tile_put_mended(world, t, wish, to, left, counts);
            } else
                tile_put_hits(to, geometry, a, b);
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
                                                                        const tile_met *met, cgt_counts *counts)
{
    tile_prepared_sphere prepared = {.number = CGT_NONE};
    const tile_kept kept = {.met = met, .sphere = &prepared};
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
                                                                          const tile_met *met, cgt_counts *counts)
{
    tile_mesh mesh;
    const tile_kept kept = {.met = met, .mesh = &mesh};
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
                                                                          const tile_met *met, cgt_counts *counts)
{
    const tile_kept kept = {.met = met};
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
    tile_meet(t, r, &met, counts);
    if (t->parallel)
        tile_resolve_parallel_array(world, t, r, wish, &met, counts);
    else if (world->objects.triangles)
        tile_resolve_triangle_array(world, t, r, wish, &met, counts);
    else
        tile_resolve_sphere_array(world, t, r, wish, &met, counts);
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
                if (spux_all(spu_cmpeq(object[k], spux_vuint(CGT_NONE))))
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
