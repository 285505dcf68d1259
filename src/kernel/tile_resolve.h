/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a tile's winners to the caller's planes. Spheres of one array go from a vector of pixels straight to them; all
 * else some whole rows at a time as a packet of rays, which lie in it as their pixels do in the planes. */
#ifndef CGT_TILE_RESOLVE_H
#define CGT_TILE_RESOLVE_H

#include "camera_packet.h"
#include "object_fetch.h"
#include "resolve_spheres.h"
#include "tile.h"

#define TILE_STRIP (PACKET_MAX_RAYS / TILE_EDGE) /* rows; even */

/* The winners of a vector of columns, in both rows of a pair. */
CGT_SPU_INLINE void tile_pair_winners(const tile *t, uint32_t x, uint32_t y, vuint row[2])
{
    const vuint even = spu_sl(spux_lane_index(), 1), odd = spu_or(even, spux_vuint(1));
    const vmask front = spux_mask_first(CGT_LANES / 2);
    const uint32_t *from = t->object + tile_index(x, y);
    const vuint a = spux_load_uint(from), b = spux_load_uint(from + CGT_LANES);
    row[0] = spux_select(spux_permute(b, even), spux_permute(a, even), front);
    row[1] = spux_select(spux_permute(b, odd), spux_permute(a, odd), front);
}

/* The canonical directions of a vector of columns, in the order of camera.h. */
CGT_SPU_INLINE void tile_directions(const tile *t, uint32_t x, uint32_t y, vfloat dir[3])
{
    const cgt_camera_rays *c = t->rays;
    const vfloat px = spux_load_unaligned(t->column + x), py = spux_vfloat(t->row[y]);
    for (int a = 0; a < 3; a++) {
        const vfloat across = spu_add(spux_vfloat(c->fwd[a]), spu_mul(px, spux_vfloat(c->right[a])));
        dir[a] = spu_add(across, spu_mul(py, spux_vfloat(c->up[a])));
    }
}

/* ---- spheres of one array ---- */

/* Columns x and on of row y of a plane; a region less wide than a tile ends in the vector, or before. */
CGT_SPU_INLINE void tile_put(uint32_t *plane, const cgt_region *r, bool stream, uint32_t x, uint32_t y, vuint v)
{
    if (!plane)
        return;
    uint32_t *to = plane + (size_t)y * r->row_stride + x;
    if (stream)
        spux_stream_uint(to, v);
    else if (x + CGT_LANES <= r->width)
        spux_store_unaligned_uint(to, v);
    else
        spux_store_mask_uint(to, v, spux_mask_first(r->width > x ? r->width - x : 0));
}

CGT_SPU_INLINE bool tile_on_lines(const void *plane) { return (uintptr_t)plane % CGT_VECTOR_BYTES == 0; }

/* Whether whole vectors may go past the caches. */
CGT_SPU_INLINE bool tile_streams(const cgt_region *r)
{
    return r->stream && r->width == TILE_EDGE && r->row_stride % CGT_LANES == 0 && tile_on_lines(r->t) &&
           tile_on_lines(r->primitive) && tile_on_lines(r->geometry) && tile_on_lines(r->normal[0]) &&
           tile_on_lines(r->normal[1]) && tile_on_lines(r->normal[2]) && tile_on_lines(r->u) && tile_on_lines(r->v);
}

/* The rays of some lanes, one by one. */
__attribute__((noinline, unused)) static void tile_resolve_rays(const cgt_world *world, const tile *t, unsigned lanes,
                                                                vuint object, const vfloat dir[3], vfloat *distance,
                                                                vfloat normal[3], cgt_counts *counts)
{
    const cgt_camera_rays *c = t->rays;
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        const cgt_ray ray = {
            .line = {.org = {c->eye[0], c->eye[1], c->eye[2]}, .dir = {dir[0][k], dir[1][k], dir[2][k]}},
            .t_min = c->t_min};
        const resolved_sphere s = resolve_sphere_ray(&ray, cgt_objects_sphere(&world->objects, object[k]), counts);
        (*distance)[k] = s.t;
        for (int a = 0; a < 3; a++)
            normal[a][k] = s.normal[a];
    }
}

/* A vector of pixels of a row. wants: t or normals are asked for. */
CGT_SPU_INLINE void tile_resolve_vector(const cgt_world *world, const tile *t, const cgt_region *r, bool wants,
                                        bool normals, bool stream, uint32_t x, uint32_t y, vuint object,
                                        cgt_counts *counts)
{
    const cgt_object_array *array = world->objects.array;
    const vuint none = spux_vuint(CGT_NONE);
    const vmask missed = spu_cmpeq(object, none);
    const unsigned hit = ~spux_mask_bits(missed) & CGT_ALL_LANES;
    const vfloat zero = spux_vfloat(0);
    vfloat distance = spux_vfloat(INFINITY), normal[3] = {zero, zero, zero};
    if (hit && wants) {
        _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
        vfloat sphere[4], org[3], dir[3], n[3] = {zero, zero, zero}, found;
        spux_store_uint(number, object);
        spux_store_uint(number, spux_select(object, spux_vuint(number[__builtin_ctz(hit)]), missed));
        fetch_spheres_at(array, number, sphere);
        tile_directions(t, x, y, dir);
        for (int a = 0; a < 3; a++)
            org[a] = spux_vfloat(t->rays->eye[a]);
        const vmask known = resolve_spheres_vector(org, dir, sphere, spux_vfloat(t->rays->t_min), normals, &found, n);
        const unsigned rest = hit & ~spux_mask_bits(known);
        if (rest)
            tile_resolve_rays(world, t, rest, object, dir, &found, n, counts);
        distance = spux_select(found, distance, missed);
        for (int a = 0; a < 3; a++)
            normal[a] = spux_select(n[a], zero, missed);
    }
    counts->hits += spux_count_bits(hit);
    tile_put((uint32_t *)r->t, r, stream, x, y, (vuint)distance);
    tile_put(r->primitive, r, stream, x, y, object);
    tile_put(r->geometry, r, stream, x, y, spux_select(spux_vuint(array->geometry), none, missed));
    for (int a = 0; a < 3; a++)
        tile_put((uint32_t *)r->normal[a], r, stream, x, y, (vuint)normal[a]);
    tile_put((uint32_t *)r->u, r, stream, x, y, (vuint)zero);
    tile_put((uint32_t *)r->v, r, stream, x, y, (vuint)zero);
}

CGT_SPU_INLINE void tile_resolve_spheres_to(const cgt_world *world, const tile *t, const cgt_region *r, bool wants,
                                            bool normals, bool stream, cgt_counts *counts)
{
    for (uint32_t y = 0; y < r->height; y += 2)
        for (uint32_t x = 0; x < r->width; x += CGT_LANES) {
            vuint row[2];
            tile_pair_winners(t, x, y, row);
            tile_resolve_vector(world, t, r, wants, normals, stream, x, y, row[0], counts);
            if (y + 1 < r->height)
                tile_resolve_vector(world, t, r, wants, normals, stream, x, y + 1, row[1], counts);
        }
}

__attribute__((noinline, unused)) static void tile_resolve_spheres(const cgt_world *world, const tile *t,
                                                                   const cgt_region *r, cgt_counts *counts)
{
    const bool stream = tile_streams(r), normals = r->normal[0] != NULL;
    if (normals)
        tile_resolve_spheres_to(world, t, r, true, true, stream, counts);
    else
        tile_resolve_spheres_to(world, t, r, r->t != NULL, false, stream, counts);
    if (stream)
        spux_stream_end();
}

/* ---- anything, by rows ---- */

CGT_SPU_INLINE void tile_strip_rays(const tile *t, uint32_t y, packet *p)
{
    for (uint32_t row = 0; row < TILE_STRIP; row += 2)
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES) {
            vuint object[2];
            tile_pair_winners(t, x, y + row, object);
            for (uint32_t k = 0; k < 2; k++) {
                const uint32_t i = (row + k) * TILE_EDGE + x;
                spux_store_uint(p->object + i, object[k]);
                if (spux_all(spu_cmpeq(object[k], spux_vuint(CGT_NONE))))
                    continue;
                vfloat dir[3];
                tile_directions(t, x, y + row + k, dir);
                for (int a = 0; a < 3; a++)
                    spux_store(p->dir[a] + i, dir[a]);
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
    if (!world->objects.triangles && world->objects.arrays == 1) {
        tile_resolve_spheres(world, t, region, counts);
        return;
    }
    camera_packet_begin(t->rays, settings, PACKET_MAX_EDGE, &p);
    p.extreme = false;
    for (uint32_t y = 0; y < region->height; y += TILE_STRIP) {
        tile_strip_rays(t, y, &p);
        CGT_KERNEL(cgt_packet_resolve)(world, &p, settings, &hits, counts);
        tile_strip_store(&hits, region, y);
    }
    if (region->stream)
        spux_stream_end();
}

#endif
