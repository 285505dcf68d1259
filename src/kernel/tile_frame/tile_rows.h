/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Planes at any address. Storing past the caches takes whole lines; parts of lines stored so are several times slower,
 * and stored through the caches each costs a read of memory. Two rows of a tile are filled first. Their whole lines are
 * then streamed, wherever they begin, and what is left over goes to the tile at the right (tile_seam), which streams
 * the shared line. Only the ends of a region take the caches. */
#ifndef CGT_TILE_ROWS_H
#define CGT_TILE_ROWS_H

#include "kernel/tile_frame/tile_planes.h"

#define TILE_ROW_WORDS (TILE_EDGE + 2 * TILE_CACHE_LINE) /* a line before the row, and one behind it */
#define TILE_PREFETCH_ROWS 8u                            /* ahead of those that are stored */

/* Two rows of a tile and of each plane. */
typedef struct tile_rows {
    _Alignas(4 * TILE_CACHE_LINE) uint32_t plane[CGT_PLANES][2 * TILE_ROW_WORDS];
} tile_rows;

/* Whether rows go to the planes by way of tile_rows. */
CGT_SPU_INLINE bool tile_needs_rows(const cgt_region *r) { return SPUX_STREAMS && r->nontemporal; }

/* The region with the rows in place of its planes, whole vectors wide. */
CGT_SPU_INLINE cgt_region tile_rows_region(const cgt_region *r, tile_rows *rows)
{
    cgt_region q = *r;
    for (int k = 0; k < CGT_PLANES; k++)
        q.plane[k] = r->plane[k] ? rows->plane[k] + TILE_CACHE_LINE : NULL;
    q.row_stride = TILE_ROW_WORDS;
    q.width = TILE_EDGE;
    return q;
}

/* Copies less than a line. Moves of constant size, which may overlap each other: no call and no loop of single ones. */
CGT_SPU_INLINE void tile_copy_part(uint32_t *to, const uint32_t *from, uint32_t count)
{
    if (count >= 8) {
        memcpy(to, from, 8 * sizeof *to);
        memcpy(to + count - 8, from + count - 8, 8 * sizeof *to);
    } else if (count >= 4) {
        memcpy(to, from, 4 * sizeof *to);
        memcpy(to + count - 4, from + count - 4, 4 * sizeof *to);
    } else if (count >= 2) {
        memcpy(to, from, 2 * sizeof *to);
        memcpy(to + count - 2, from + count - 2, 2 * sizeof *to);
    } else if (count)
        *to = *from;
}

/* Words from the begin of the line to an address. */
CGT_SPU_INLINE uint32_t tile_line_offset(const uint32_t *to)
{
    return (uint32_t)((uintptr_t)to / sizeof *to % TILE_CACHE_LINE);
}

/* Sends a row. left: the words before it, from the begin of their line on, lie before `from` already; right: gets the
 * words of the last line, where it is not whole; NULL: there is no such neighbour. */
CGT_SPU_INLINE void tile_stream_row(uint32_t *to, const uint32_t *from, uint32_t count, bool left, uint32_t *right)
{
    const uint32_t offset = tile_line_offset(to);
    if (offset && left) {
        to -= offset;
        from -= offset;
        count += offset;
    } else if (offset) {
        const uint32_t part = TILE_CACHE_LINE - offset < count ? TILE_CACHE_LINE - offset : count;
        tile_copy_part(to, from, part);
        to += part;
        from += part;
        count -= part;
    }
    for (; count >= TILE_CACHE_LINE; count -= TILE_CACHE_LINE) {
        spux_stream_line_unaligned(to, from);
        to += TILE_CACHE_LINE;
        from += TILE_CACHE_LINE;
    }
    tile_copy_part(right ? right : to, from, count);
}

/* Puts the words that the left neighbour has left before rows y and y + 1. Early: reading words back soon after they
 * were stored one by one takes long. */
CGT_SPU_INLINE void tile_begin_rows(const cgt_region *r, const tile_seam *seam, tile_rows *rows, uint32_t y)
{
    if (!seam || !seam->left)
        return;
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t row = 0; r->plane[k] && row < 2 && y + row < r->height; row++) {
            const uint32_t offset = tile_line_offset(r->plane[k] + (size_t)(y + row) * r->row_stride);
            tile_copy_part(rows->plane[k] + row * TILE_ROW_WORDS + TILE_CACHE_LINE - offset, seam->words[k][y + row],
                           offset);
        }
}

/* Fetches the lines that the ends of rows y and y + 1 share with other regions. Stores leave in order: one that waits
 * for memory would hold up all that are streamed after it. */
CGT_SPU_INLINE void tile_prefetch_ends(const cgt_region *r, const tile_seam *seam, uint32_t y)
{
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t row = y; r->plane[k] && row < y + 2 && row < r->height; row++) {
            const uint32_t *to = r->plane[k] + (size_t)row * r->row_stride;
            if (!seam || !seam->left)
                __builtin_prefetch(to, 1);
            if (!seam || !seam->right)
                __builtin_prefetch(to + r->width - 1, 1);
        }
}

/* Sends rows y and y + 1, as far as the region has them. */
CGT_SPU_INLINE void tile_stream_rows(const cgt_region *r, tile_seam *seam, const tile_rows *rows, uint32_t y)
{
    tile_prefetch_ends(r, seam, y + TILE_PREFETCH_ROWS);
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t row = 0; r->plane[k] && row < 2 && y + row < r->height; row++)
            tile_stream_row(r->plane[k] + (size_t)(y + row) * r->row_stride,
                            rows->plane[k] + row * TILE_ROW_WORDS + TILE_CACHE_LINE, r->width, seam && seam->left,
                            seam && seam->right ? seam->words[k][y + row] : NULL);
}

#endif
