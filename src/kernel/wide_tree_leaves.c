/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Leaf blocks of the wide tree, and the binary tree over them. Spheres are copied as they are; triangles become what
 * src/leaf_triangle.c makes of them, bit by bit. */
#include <math.h>

#include "wide_tree_binary.h"
#include "wide_tree_fetch.h"

/* Bounds of spheres. A sum is rounded by at most 2^-24 of itself, or not at all where it is below 2^-126. What 2^-22 of
 * it comes to is rounded by 2^-150 at most, the difference once more by 2^-24: 2^-23 at least is left. */
CGT_SPU_INLINE void bound_spheres(const vfloat d[4], wide_leaf *leaf)
{
    const vfloat radius = spux_abs(d[3]), away = spux_vfloat(0x1p-22f);
    for (int a = 0; a < 3; a++) {
        const vfloat low = spu_sub(d[a], radius), high = spu_add(d[a], radius);
        leaf->low[a] = spux_hmin(spu_sub(low, spu_mul(spux_abs(low), away)));
        leaf->high[a] = spux_hmax(spu_add(high, spu_mul(spux_abs(high), away)));
    }
}

/* To a block. */
CGT_SPU_INLINE void put(float *to, vfloat v, bool stream)
{
    if (stream)
        spux_stream(to, v);
    else
        spux_store(to, v);
}

CGT_SPU_INLINE void put_numbers(uint32_t *to, vuint v, bool stream)
{
    if (stream)
        spux_stream_uint(to, v);
    else
        spux_store_uint(to, v);
}

/* Objects first to first + count - 1, as they were sorted. */
static void make_spheres(const cgt_wide_build *b, uint32_t first, uint32_t count, wide_spheres *block, wide_leaf *leaf)
{
    const wide_run run = wide_run_of(b->objects, b->object + first, count);
    wide_ask(&run, b->object, first, count, b->sorted);
    vfloat d[4];
    wide_run_spheres(&run, d);
    for (int a = 0; a < 3; a++)
        put(block->center[a], d[a], b->stream);
    put(block->radius, d[3], b->stream);
    put_numbers(block->object, run.object, b->stream);
    bound_spheres(d, leaf);
}

static void make_triangles(const cgt_wide_build *b, uint32_t first, uint32_t count, wide_triangles *block,
                           wide_leaf *leaf)
{
    const wide_run run = wide_run_of(b->objects, b->object + first, count);
    wide_ask(&run, b->object, first, count, b->sorted);
    const vfloat scale = spux_vfloat(b->scale);
    vfloat v[3][3], edge[2][3];
    wide_run_triangles(&run, v);
    for (int a = 0; a < 3; a++) {
        const vfloat vertex = spu_mul(v[0][a], scale);
        leaf->low[a] = spux_hmin(spux_min(v[0][a], spux_min(v[1][a], v[2][a])));
        leaf->high[a] = spux_hmax(spux_max(v[0][a], spux_max(v[1][a], v[2][a])));
        put(block->vertex[a], vertex, b->stream);
        for (int k = 0; k < 2; k++) {
            edge[k][a] = spu_sub(spu_mul(v[k + 1][a], scale), vertex);
            put(block->edge[k][a], edge[k][a], b->stream);
        }
    }
    for (int k = 0; k < 2; k++) {
        const vfloat sum = spu_add(spux_abs(edge[k][0]), spux_abs(edge[k][1]));
        put(block->sum[k], spu_add(sum, spux_abs(edge[k][2])), b->stream);
    }
    put_numbers(block->object, run.object, b->stream);
}

/* Block `number` of its kind. */
static void make_leaf(const cgt_wide_build *b, cgt_kind kind, uint32_t first, uint32_t count, uint32_t number,
                      wide_leaf *leaf)
{
    const uint32_t triangles = kind == CGT_KIND_TRIANGLES ? CGT_WIDE_TRIANGLES : 0;
    if (triangles)
        make_triangles(b, first, count, (wide_triangles *)b->block[kind] + number, leaf);
    else
        make_spheres(b, first, count, (wide_spheres *)b->block[kind] + number, leaf);
    leaf->code = CGT_WIDE_LEAF | triangles | (count - 1) << CGT_WIDE_COUNT_SHIFT | number;
    leaf->unused = 0;
}

static void add_leaf(wide_branches *s, const wide_leaf *leaf, uint32_t reference, uint32_t parting)
{
    wide_branch *branch = &s->branch[s->count];
    s->parting[s->count++] = parting;
    spux_store(branch->cost, spux_vfloat(0));
    for (int a = 0; a < 3; a++) {
        branch->low[a] = leaf->low[a];
        branch->high[a] = leaf->high[a];
    }
    branch->reference = reference;
    branch->leaves = 1;
}

void CGT_KERNEL(cgt_wide_tree_leaves)(const cgt_wide_build *b, uint32_t number)
{
    const cgt_wide_range *range = &b->range[number];
    const uint16_t *list = b->leaf + range->begin;
    uint32_t object = range->begin;
    wide_branches s;
    s.count = 0;
    s.next = range->first_inner;
    for (uint32_t i = 0; i < range->leaves; i++) {
        const uint32_t count = (list[i] & 0xff) + 1u, parting = list[i] >> 8;
        const uint32_t reference = CGT_WIDE_LEAF_REF | (range->first_leaf + i);
        wide_leaf *leaf = wide_leaf_at(b, reference);
        make_leaf(b, range->kind, object, count, range->first_block + i, leaf);
        if (i)
            wide_branches_part(b, &s, parting);
        add_leaf(&s, leaf, reference, parting);
        object += count;
    }
    wide_branches_finish(b, &s);
    spux_stream_end();
    ((wide_branch *)b->branch)[number] = s.branch[0];
}
