/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The triangles that a tile's pixels have hit, each fetched and prepared once (resolve_triangles.h), a vector of them at
 * a time. That pays where a triangle has some pixels: fetching nine numbers for each lane of a vector of pixels takes
 * longer than all that is then computed of them. */
#ifndef CGT_TILE_MESH_H
#define CGT_TILE_MESH_H

#include "object_fetch.h"
#include "resolve_triangles.h"
#include "tile_met.h"

#define TILE_MESH 1024u /* triangles, a power of two */

_Static_assert(2 * PREPARED_RECORD == 1 << 4, "places in `record` are shifted");

typedef struct tile_mesh {
    _Alignas(64) double record[TILE_MESH + CGT_LANES][2 * PREPARED_RECORD];
    _Alignas(64) uint32_t number[TILE_MESH + CGT_LANES]; /* of each; the first is nobody */
    _Alignas(64) uint32_t find[TILE_MESH]; /* by the low bits of a number: its high bits, its place below */
    _Alignas(64) uint32_t at[TILE_PIXELS]; /* of each pixel with a hit: its triangle's place in `record` */
    uint32_t count;
} tile_mesh;

/* A new triangle. What `find` had there may be listed, and prepared, once more. */
CGT_SPU_INLINE uint32_t tile_mesh_new(tile_mesh *m, uint32_t number)
{
    m->find[number & (TILE_MESH - 1)] = (number & ~(TILE_MESH - 1)) | m->count;
    m->number[m->count] = number;
    return m->count++;
}

/* Lists what a vector of pixels has hit, while there is room. */
CGT_SPU_INLINE void tile_mesh_add(const tile *t, const tile_met *met, uint32_t i, tile_mesh *m)
{
    const uint32_t low = TILE_MESH - 1, first = met->some[i / CGT_LANES];
    if (first == CGT_NONE)
        return;
    if (met->alone[i / CGT_LANES]) {
        uint32_t at = m->find[first & low] - (first & ~low);
        if (at - 1 >= low && m->count < TILE_MESH)
            at = tile_mesh_new(m, first);
        spux_store_uint(m->at + i, spux_vuint(at));
        return;
    }
    const vuint number = spux_load_uint(t->object + i);
    const unsigned hit = ~spux_mask_bits(spu_cmpeq(number, spux_vuint(CGT_NONE))) & CGT_ALL_LANES;
    vuint at =
        spu_sub(spux_gather_uint(m->find, (vint)spu_and(number, spux_vuint(low))), spu_and(number, spux_vuint(~low)));
    unsigned left = ~spux_mask_bits(spu_cmpgt(spux_vuint(low), spu_sub(at, spux_vuint(1)))) & hit;
    while (left && m->count < TILE_MESH) {
        const uint32_t some = t->object[i + (uint32_t)__builtin_ctz(left)];
        const vmask mine = spu_cmpeq(number, spux_vuint(some));
        at = spux_select(at, spux_vuint(tile_mesh_new(m, some)), mine);
        left &= ~spux_mask_bits(mine);
    }
    spux_store_uint(m->at + i, at);
}

/* Lists the triangles of a region's pixels. False where they are too many; then hardly any has pixels to share. */
CGT_SPU_INLINE bool tile_mesh_list(const tile *t, const tile_met *met, const cgt_region *r, tile_mesh *m)
{
    memset(m->find, 0, sizeof m->find);
    m->number[0] = CGT_NONE;
    m->count = 1;
    for (uint32_t y = 0; y < r->height && m->count < TILE_MESH; y += 2)
        for (uint32_t x = 0; x < r->width; x += CGT_LANES)
            for (uint32_t k = 0; k < 2; k++)
                tile_mesh_add(t, met, tile_index(x, y) + k * CGT_LANES, m);
    return m->count < TILE_MESH;
}

CGT_SPU_INLINE void tile_mesh_prepare(const cgt_world *world, const tile *t, uint32_t fields, bool exact, tile_mesh *m)
{
    for (uint32_t k = 0; k < CGT_LANES; k++)
        m->number[m->count + k] = m->number[m->count - 1];
    for (uint32_t i = 1; i < m->count; i += CGT_LANES) {
        vfloat vertex[3][3];
        fetch_triangles_at(world->objects.array, spux_load_unaligned_uint(m->number + i), vertex);
        prepare_triangles(t->rays->eye, vertex, fields, exact, m->record[i], 2 * PREPARED_RECORD);
    }
}

/* Pixels i and on, of which some have hit something, `alone`: the same. Returns the lanes that are right. */
CGT_SPU_INLINE vmask tile_mesh_resolve(const tile_mesh *m, uint32_t i, bool alone, vmask missed, const vfloat dir[3],
                                       uint32_t fields, bool exact, resolved_triangles *to)
{
    const unsigned hit = ~spux_mask_bits(missed) & CGT_ALL_LANES;
    const uint32_t some = m->at[i + (uint32_t)__builtin_ctz(hit)];
    if (alone)
        return resolve_prepared(m->record[some], NULL, dir, fields, exact, to);
    _Alignas(CGT_VECTOR_BYTES) uint32_t from[CGT_LANES];
    spux_store_uint(from, spu_sl(spux_select(spux_load_uint(m->at + i), spux_vuint(some), missed), 4)); /* the record */
    return resolve_prepared(m->record[0], from, dir, fields, exact, to);
}

#endif
