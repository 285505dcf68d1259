/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a tile's winners to the caller's planes: some whole rows at a time as a packet of rays, which lie in it as their
 * pixels do in the planes. */
#ifndef CGT_TILE_RESOLVE_H
#define CGT_TILE_RESOLVE_H

#include "camera_packet.h"
#include "tile.h"

#define TILE_STRIP (PACKET_MAX_RAYS / TILE_EDGE) /* rows; even */

/* Rows from pairs of them. */
CGT_SPU_INLINE void tile_strip_winners(const tile *t, uint32_t y, packet *p)
{
    const vuint even = spu_sl(spux_lane_index(), 1), odd = spu_or(even, spux_vuint(1));
    const vmask front = spux_mask_first(CGT_LANES / 2);
    for (uint32_t row = 0; row < TILE_STRIP; row += 2) {
        const uint32_t *from = t->object + tile_index(0, y + row);
        uint32_t *to = p->object + row * TILE_EDGE;
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES) {
            const vuint a = spux_load_uint(from + 2 * x), b = spux_load_uint(from + 2 * x + CGT_LANES);
            spux_store_uint(to + x, spux_select(spux_permute(b, even), spux_permute(a, even), front));
            spux_store_uint(to + TILE_EDGE + x, spux_select(spux_permute(b, odd), spux_permute(a, odd), front));
        }
    }
}

/* The canonical directions, in the order of camera.h, of vectors that have a winner. */
CGT_SPU_INLINE void tile_strip_directions(const tile *t, uint32_t y, packet *p)
{
    const cgt_camera_rays *c = t->rays;
    for (uint32_t row = 0; row < TILE_STRIP; row++) {
        const vfloat py = spux_vfloat(t->row[y + row]);
        vfloat down[3];
        for (int a = 0; a < 3; a++)
            down[a] = spu_mul(py, spux_vfloat(c->up[a]));
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES) {
            const uint32_t i = row * TILE_EDGE + x;
            if (spux_all(spu_cmpeq(spux_load_uint(p->object + i), spux_vuint(CGT_NONE))))
                continue;
            const vfloat px = spux_load_unaligned(t->column + x);
            for (int a = 0; a < 3; a++) {
                const vfloat across = spu_add(spux_vfloat(c->fwd[a]), spu_mul(px, spux_vfloat(c->right[a])));
                spux_store(p->dir[a] + i, spu_add(across, down[a]));
            }
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
    camera_packet_begin(t->rays, settings, PACKET_MAX_EDGE, &p);
    p.extreme = false;
    for (uint32_t y = 0; y < region->height; y += TILE_STRIP) {
        tile_strip_winners(t, y, &p);
        tile_strip_directions(t, y, &p);
        CGT_KERNEL(cgt_packet_resolve)(world, &p, settings, &hits, counts);
        tile_strip_store(&hits, region, y);
    }
    if (region->stream)
        spux_stream_end();
}

#endif
