/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What vectors of a tile's pixels have met, looked up before anything is computed of them: so branches on it do not wait
 * for arithmetic, and what a CPU guessed wrong it knows early. */
#ifndef CGT_TILE_MET_H
#define CGT_TILE_MET_H

#include "tile.h"

typedef struct tile_met {
    uint32_t some[TILE_PIXELS / CGT_LANES]; /* an object, CGT_NONE where there is none */
    bool alone[TILE_PIXELS / CGT_LANES];    /* and no other */
} tile_met;

/* Those of a region; counts its hits. */
CGT_SPU_INLINE void tile_meet(const tile *t, const cgt_region *r, tile_met *m, cgt_counts *counts)
{
    uint64_t hits = 0;
    for (uint32_t y = 0; y < r->height; y += 2)
        for (uint32_t x = 0; x < r->width; x += CGT_LANES)
            for (uint32_t k = 0; k < 2; k++) {
                const uint32_t i = tile_index(x, y) + k * CGT_LANES;
                const vuint object = spux_load_uint(t->object + i);
                const unsigned missed = spux_mask_bits(spu_cmpeq(object, spux_vuint(CGT_NONE)));
                const unsigned hit = ~missed & CGT_ALL_LANES;
                const uint32_t some = t->object[i + (uint32_t)__builtin_ctz(hit | 1u << (CGT_LANES - 1))];
                const unsigned same = spux_mask_bits(spu_cmpeq(object, spux_vuint(some)));
                m->some[i / CGT_LANES] = some;
                m->alone[i / CGT_LANES] = (same | missed) == CGT_ALL_LANES;
                hits += spux_count_bits(hit);
            }
    counts->hits += hits;
}

#endif
