/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a tile's hits to the caller's planes. */
#ifndef CGT_TILE_PLANES_H
#define CGT_TILE_PLANES_H

#include "kernel/tile/tile.h"

#define TILE_CACHE_LINE 16u /* pixels of a cache line */

/* Makes a tile of a region, at most TILE_EDGE wide and high. */
void CGT_KERNEL(cgt_tile_init)(tile *t, const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                               const cgt_region *r);

/* Lines of the planes that two tiles side by side share: the left one leaves its words here, the right one sends the
 * whole line. `words` are those of each row's last line, from its begin on. */
typedef struct tile_seam {
    _Alignas(4 * TILE_CACHE_LINE) uint32_t words[CGT_PLANES][TILE_EDGE][TILE_CACHE_LINE];
    bool left, right; /* whether the tile has such a neighbour; the one to the left comes first */
} tile_seam;

/* Whether a tile's hits go straight to the planes: those of one array, and not of capsules. */
CGT_SPU_INLINE bool tile_resolves_array(const cgt_primitives *prims) { return prims->arrays == 1 && !prims->capsules; }

/* Writes the fields of a tile's closest hits to the region. */
void CGT_KERNEL(cgt_tile_resolve)(const cgt_committed_scene *committed_scene, const tile *t,
                                  const cgt_trace_settings *settings, const cgt_region *region, tile_seam *seam,
                                  cgt_counts *counts);

/* The same for all other scenes, a strip of rows at a time, without a seam (tile_resolve_strips.c). */
void CGT_KERNEL(cgt_tile_resolve_strips)(const cgt_committed_scene *committed_scene, const tile *t,
                                         const cgt_trace_settings *settings, const cgt_region *region,
                                         cgt_counts *counts);

/* Whether whole cache lines may go past the caches: the region is as wide as a tile and every plane's rows begin at a
 * line. */
CGT_SPU_INLINE bool tile_can_stream(const cgt_region *r)
{
    bool aligned = SPUX_STREAMS && r->nontemporal && r->width == TILE_EDGE && r->height % 2 == 0 &&
                   r->row_stride % TILE_CACHE_LINE == 0;
    for (int k = 0; k < CGT_PLANES; k++)
        aligned = aligned && (uintptr_t)r->plane[k] % (4 * TILE_CACHE_LINE) == 0;
    return aligned;
}

/* The hits of a vector of pixels. */
typedef struct tile_hits {
    vuint prim;
    vfloat t, u, v, normal[3];
    unsigned unresolved; /* lanes that are left to tile_resolve_remaining, as bits */
} tile_hits;

CGT_SPU_INLINE tile_hits tile_no_hits(void)
{
    const vfloat zero = spux_vfloat(0);
    return (tile_hits){spux_vuint(CGT_INVALID_ID), spux_vfloat(INFINITY), zero, zero, {zero, zero, zero}, 0};
}

/* Where a vector of pixels goes: columns x and on of a row, from `offset` on in the planes. */
typedef struct tile_store_target {
    const cgt_region *region;
    bool nontemporal;
    uint32_t x;
    size_t offset;
} tile_store_target;

CGT_SPU_INLINE void tile_store_plane(tile_store_target to, int k, vuint v)
{
    const cgt_region *r = to.region;
    if (!r->plane[k])
        return;
    uint32_t *plane = r->plane[k] + to.offset;
    if (to.nontemporal)
        spux_stream_uint(plane, v);
    else if (to.x + CGT_LANES <= r->width)
        spux_store_unaligned_uint(plane, v);
    else /* the region ends among the vector's columns */
        spux_store_mask_uint(plane, v, spux_mask_first(r->width - to.x));
}

/* geometry: the only one of the scene. */
CGT_SPU_INLINE void tile_store_hits(tile_store_target to, uint32_t geometry, const tile_hits *h)
{
    const vuint none = spux_vuint(CGT_INVALID_ID);
    tile_store_plane(to, CGT_PLANE_T, (vuint)h->t);
    tile_store_plane(to, CGT_PLANE_PRIMITIVE, h->prim);
    tile_store_plane(to, CGT_PLANE_GEOMETRY, spux_select(spux_vuint(geometry), none, spu_cmpeq(h->prim, none)));
    for (int a = 0; a < 3; a++)
        tile_store_plane(to, CGT_PLANE_NORMAL + a, (vuint)h->normal[a]);
    tile_store_plane(to, CGT_PLANE_U, (vuint)h->u);
    tile_store_plane(to, CGT_PLANE_V, (vuint)h->v);
}

/* ---- past the caches ---- */

/* A cache line of each plane and of two rows. Vectors narrower than a line fill it before it goes past the caches. */
typedef struct tile_cache_lines {
    _Alignas(4 * TILE_CACHE_LINE) uint32_t plane[CGT_PLANES][2 * TILE_CACHE_LINE];
} tile_cache_lines;

/* The region with the lines in place of its planes. */
CGT_SPU_INLINE cgt_region tile_cache_lines_region(const cgt_region *r, tile_cache_lines *lines)
{
    cgt_region q = *r;
    for (int k = 0; k < CGT_PLANES; k++)
        q.plane[k] = r->plane[k] ? lines->plane[k] : NULL;
    q.row_stride = TILE_CACHE_LINE;
    return q;
}

/* Sends the lines to columns x and on of rows y and y + 1. */
CGT_SPU_INLINE void tile_stream_lines(const cgt_region *r, const tile_cache_lines *lines, uint32_t x, uint32_t y)
{
    const size_t offset = (size_t)y * r->row_stride + x;
    for (int k = 0; k < CGT_PLANES; k++) {
        if (!r->plane[k])
            continue;
        spux_stream_line(r->plane[k] + offset, lines->plane[k]);
        spux_stream_line(r->plane[k] + offset + r->row_stride, lines->plane[k] + TILE_CACHE_LINE);
    }
}

#endif
