/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What vectors of a tile's pixels have met, looked up before anything is computed of them: so branches on it do not wait
 * for arithmetic, and what a CPU guessed wrong it knows early. */
#ifndef CGT_TILE_MET_H
#define CGT_TILE_MET_H

#include "kernel/tile/tile.h"

typedef struct tile_pixel_runs {
    uint32_t first_prim[TILE_PIXELS / CGT_LANES]; /* an object, CGT_INVALID_ID where there is none */
    bool uniform[TILE_PIXELS / CGT_LANES];        /* and no other */
} tile_pixel_runs;

/* What the tile has of columns x and on, of rows y and y + 1. */
CGT_SPU_INLINE void tile_load_rows(const uint32_t *of, uint32_t x, uint32_t y, vuint row[2])
{
    row[0] = spux_load_uint(of + tile_index(x, y));
    row[1] = spux_load_uint(of + tile_index(x, y) + CGT_LANES);
    spux_unzip(row);
}

/* Where that is in a tile_pixel_runs. */
CGT_SPU_INLINE uint32_t tile_pixel_run_index(uint32_t x, uint32_t row) { return (row * TILE_EDGE + x) / CGT_LANES; }

/* Those of a region; counts its hits. Returns whether there is any. */
CGT_SPU_INLINE bool tile_compute_pixel_runs(const tile *t, const cgt_region *r, tile_pixel_runs *m, cgt_counts *counts)
{
    uint64_t hits = 0;
    for (uint32_t y = 0; y < r->height; y += 2)
        for (uint32_t x = 0; x < r->width; x += CGT_LANES) {
            vuint prim[2];
            tile_load_rows(t->prim, x, y, prim);
            for (uint32_t k = 0; k < 2; k++) {
                const unsigned missed = spux_mask_bits(spu_cmpeq(prim[k], spux_vuint(CGT_INVALID_ID)));
                const unsigned hit = ~missed & CGT_ALL_LANES;
                const uint32_t lane = (uint32_t)__builtin_ctz(hit | 1u << (CGT_LANES - 1));
                const uint32_t first_prim = t->prim[tile_index(x, y) + 2 * lane + k];
                const unsigned same = spux_mask_bits(spu_cmpeq(prim[k], spux_vuint(first_prim)));
                const uint32_t i = tile_pixel_run_index(x, y + k);
                m->first_prim[i] = first_prim;
                m->uniform[i] = (same | missed) == CGT_ALL_LANES;
                hits += spux_count_bits(hit);
            }
        }
    counts->hits += hits;
    return hits != 0;
}

#endif
