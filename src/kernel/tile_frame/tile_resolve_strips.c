/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hits of a tile in a scene of several arrays, or of capsules: some whole rows at a time become a packet of rays,
 * which lie in it as their pixels do in the planes, and cgt_packet_resolve computes their fields. */
#include "kernel/packet/camera_packet.h"
#include "kernel/tile_frame/tile_rows.h"

#define TILE_STRIP_ROWS (PACKET_MAX_RAYS / TILE_EDGE) /* even */

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

CGT_SPU_INLINE void tile_store_strip(const packet_hits *h, const cgt_region *r, uint32_t y)
{
    const uint32_t rows = r->height - y < TILE_STRIP_ROWS ? r->height - y : TILE_STRIP_ROWS;
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t row = 0; r->plane[k] && row < rows; row++) {
            uint32_t *to = r->plane[k] + (y + row) * r->row_stride;
            if (tile_needs_rows(r))
                tile_stream_row(to, h->plane[k] + row * TILE_EDGE, r->width, false, NULL);
            else
                memcpy(to, h->plane[k] + row * TILE_EDGE, r->width * sizeof *to);
        }
}

void CGT_KERNEL(cgt_tile_resolve_strips)(const cgt_committed_scene *committed_scene, const tile *t,
                                         const cgt_trace_settings *settings, const cgt_region *region,
                                         cgt_counts *counts)
{
    packet *p = cgt_scratch_take(counts->scratch, sizeof *p);
    packet_hits *hits = cgt_scratch_take(counts->scratch, sizeof *hits);
    camera_packet_init(t->rays, settings, PACKET_MAX_EDGE, false, p);
    p->extreme = false;
    for (uint32_t y = 0; y < region->height; y += TILE_STRIP_ROWS) {
        tile_load_strip(t, y, p);
        CGT_KERNEL(cgt_packet_resolve)(committed_scene, p, settings, hits, counts);
        tile_store_strip(hits, region, y);
    }
    cgt_scratch_return(counts->scratch, p);
    if (region->nontemporal)
        spux_stream_end();
}
