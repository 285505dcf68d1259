/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The triangles that a tile has listed (tile.h), each fetched and prepared once (resolve_triangles.h), a vector of them
 * at a time. That pays where a triangle has some pixels: fetching nine numbers for each lane of a vector of pixels takes
 * longer than all that is then computed of them. Pixels know their triangle's slot from when it won them: to look it up
 * by the triangle's number took as long as the rest. Some that are listed have lost all their pixels since, a twelfth of
 * them in ordinary scenes. */
#ifndef CGT_TILE_MESH_H
#define CGT_TILE_MESH_H

#include "kernel/primitive/gather_primitives.h"
#include "kernel/resolve/resolve_triangles.h"
#include "kernel/tile/tile.h"

_Static_assert(2 * PREPARED_RECORD == 1 << 4, "places in `record` are shifted");

typedef struct tile_prepared_triangles {
    _Alignas(64) double record[TILE_MAX_TRIANGLES + CGT_LANES][2 * PREPARED_RECORD]; /* by slots */
} tile_prepared_triangles;

/* Prepares what the tile has listed. */
CGT_SPU_INLINE void tile_prepare_triangles(const cgt_committed_scene *committed_scene, const tile *t, uint32_t fields,
                                           bool exact, tile_prepared_triangles *m)
{
    for (uint32_t i = 0; i < t->triangle_count; i += CGT_LANES) {
        const vmask valid = spux_mask_first(t->triangle_count - i < CGT_LANES ? t->triangle_count - i : CGT_LANES);
        const vuint number = spux_select(spux_vuint(t->triangles[i]), spux_load_uint(t->triangles + i), valid);
        vfloat vertex[3][3];
        gather_triangles(committed_scene->prims.array, number, vertex);
        prepare_triangles(t->rays->eye, vertex, fields, exact, m->record[i], 2 * PREPARED_RECORD);
    }
}

/* A vector of pixels and their slots, of which one that has hit something has `some`, and all such, if `alone`. Returns the
 * lanes that are right. */
CGT_SPU_INLINE vmask tile_resolve_prepared(const tile_prepared_triangles *m, vuint slot, uint32_t first_slot,
                                           bool uniform, vmask missed, const vfloat dir[3], uint32_t fields, bool exact,
                                           resolved_triangles *to)
{
    if (uniform)
        return resolve_prepared(m->record[first_slot], NULL, dir, fields, exact, to);
    _Alignas(CGT_VECTOR_BYTES) uint32_t from[CGT_LANES];
    spux_store_uint(from, spu_sl(spux_select(slot, spux_vuint(first_slot), missed), 4)); /* the record */
    return resolve_prepared(m->record[0], from, dir, fields, exact, to);
}

#endif
