/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The leaves of a range: runs of at most CGT_LANES primitives, or of the triangles of one or two clusters. Cells are
 * halved by the bits of their keys until a run is short enough. A crowded cell is divided into cells of its own, along
 * a curve through the middles of its primitives, and so on; primitives that lie at one place, or are still together
 * after some rounds, are halved in their present order.
 *
 * Depth. Above a run there are as many binary nodes as halvings with primitives on both sides: at most
 * CGT_BVH_PART_DEPTH over parts and CGT_BVH_KEY_BITS over a part's cells. The bits of a cell's own cells are limited so
 * that its primitives could still be halved in their present order within CGT_BVH_MAX_DEPTH: that takes at most 30
 * halvings, for 2^32 primitives and leaves of 4. 6 + 24 + 30 is below 64, so that there is always room for these. A
 * path in the BVH has at most as many nodes as the binary nodes that it passes.
 *
 * Time. A round visits each primitive of a crowded cell a few times and has no more cells than primitives; there are at
 * most MAX_ROUNDS, and each cell that a key can name is visited once. */
#include <math.h>

#include "dispatch/bvh_builder.h"
#include "kernel/builders/bvh/bvh_fetch.h"
#include "kernel/builders/bvh/morton_cells.h"

#define MAX_ROUNDS 8
#define ROUND_BITS 10u
#define PRIMS_PER_CELL 4u /* of a round, at most, were they evenly spread */

_Static_assert(CGT_BVH_PART_DEPTH + CGT_BVH_KEY_BITS + 30 <= CGT_BVH_MAX_DEPTH, "leaves need depth");

/* A run of primitives: those of cells, or in their present order. */
typedef struct split_run {
    const uint32_t *start; /* of the cells; NULL: in the present order */
    uint32_t cell, bits;   /* 2^bits of them */
    uint32_t begin, end;
    uint8_t depth, parting, round;
} split_run;

/* The runs on the stack are adjacent; each but the first lies under a binary node of its own, and the deepest may have
 * both its halves there. */
typedef struct split_work {
    const cgt_bvh_build *build;
    cgt_bvh_range *range;
    split_run run[CGT_BVH_MAX_DEPTH + 2];
    uint32_t runs;
    uint32_t start[MAX_ROUNDS][(1u << ROUND_BITS) + 1];
} split_work;

static void push_run(split_work *w, const split_run *of, uint32_t cell, uint32_t bits, uint32_t begin, uint32_t end,
                     uint32_t depth, uint32_t parting)
{
    if (begin < end)
        w->run[w->runs++] = (split_run){.start = of->start,
                                        .cell = cell,
                                        .bits = bits,
                                        .begin = begin,
                                        .end = end,
                                        .depth = (uint8_t)depth,
                                        .parting = (uint8_t)parting,
                                        .round = of->round};
}

/* Pushes both halves, the latter first, so that it is visited last. */
static void push_halves(split_work *w, const split_run *r, uint32_t middle)
{
    const bool splits = r->begin < middle && middle < r->end;
    const uint32_t half = (UINT32_C(1) << r->bits) / 2, bits = r->bits - 1, depth = r->depth + splits;
    push_run(w, r, r->cell + half, bits, middle, r->end, depth, splits ? r->depth : r->parting);
    push_run(w, r, r->cell, bits, r->begin, middle, depth, r->parting);
}

static void append_leaf(split_work *w, uint32_t count, uint32_t parting)
{
    const cgt_bvh_build *b = w->build;
    cgt_bvh_range *range = w->range;
    b->leaf[range->begin * b->leaves_each + range->leaves++] = (uint16_t)((count - 1) | parting << 8);
}

/* Appends a run as a leaf; or, where a cluster is too large for one, as two leaves with a binary node above. */
static void append_leaves(split_work *w, const split_run *r)
{
    const cgt_bvh_build *b = w->build;
    uint32_t count = r->end - r->begin, parting = r->parting;
    if (b->cluster) {
        count = 0;
        for (uint32_t i = r->begin; i < r->end; i++)
            count += (uint32_t)__builtin_popcount(b->cluster[b->prim[i]].valid);
    }
    if (count > CGT_LANES) {
        append_leaf(w, CGT_LANES, parting);
        count -= CGT_LANES;
        parting = r->depth;
    }
    append_leaf(w, count, parting);
}

/* Returns how many primitives or clusters a run of leaves may have. */
static uint32_t max_run(const cgt_bvh_build *b)
{
    return !b->cluster ? CGT_LANES : CGT_LANES > CGT_CLUSTER ? CGT_LANES / CGT_CLUSTER : 1;
}

/* Returns how many such runs there are, if full. */
static uint32_t count_full_runs(const cgt_bvh_build *b, const split_run *r)
{
    return (r->end - r->begin - 1) / max_run(b) + 1;
}

/* Returns the bits that number `count` items: halvings until one remains. */
static uint32_t bits_for(uint32_t count) { return count > 1 ? 32 - (uint32_t)__builtin_clz(count - 1) : 0; }

/* ---- crowded cells ---- */

/* Loads the middles of primitives or clusters i to i + count - 1. */
CGT_SPU_INLINE void load_centroids(const cgt_bvh_build *b, const cgt_bvh_range *range, uint32_t i, uint32_t count,
                                   vfloat middle[3])
{
    if (b->cluster) {
        vfloat d[8];
        gather_cluster_list(b->cluster, b->prim + i, count, d);
        for (int a = 0; a < 3; a++)
            middle[a] = d[a];
        return;
    }
    const prim_run run = prim_run_load(b->prims, b->prim + i, count);
    prefetch_run(&run, b->prim, i, CGT_LANES, range->end); /* another thread may be moving those beyond */
    prim_run_centroids(&run, range->kind, middle);
}

/* Lays a curve through a run's primitives, and stores their middles. Returns false where all lie at one place. */
static bool make_curve(const cgt_bvh_build *b, const cgt_bvh_range *range, const split_run *r, cgt_morton_curve *curve)
{
    const uint32_t depth = r->depth + bits_for(count_full_runs(b, r) * b->leaves_each),
                   max_bits = CGT_BVH_MAX_DEPTH - depth;
    const uint32_t wanted_bits = bits_for((r->end - r->begin + PRIMS_PER_CELL - 1) / PRIMS_PER_CELL);
    const uint32_t bits = wanted_bits < ROUND_BITS ? wanted_bits : ROUND_BITS;
    vfloat low[3], high[3];
    float from[3], to[3];
    for (int a = 0; a < 3; a++) {
        low[a] = spux_vfloat(INFINITY);
        high[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t i = r->begin; i < r->end; i += CGT_LANES) {
        const uint32_t remaining = r->end - i;
        vfloat middle[3];
        load_centroids(b, range, i, remaining < CGT_LANES ? remaining : CGT_LANES, middle);
        for (int a = 0; a < 3; a++) {
            low[a] = spux_min(low[a], middle[a]);
            high[a] = spux_max(high[a], middle[a]);
            spux_store_mask(b->middle[a] + i, middle[a], spux_mask_first(remaining));
        }
        if (remaining <= CGT_LANES)
            break;
    }
    for (int a = 0; a < 3; a++) {
        from[a] = spux_hmin(low[a]);
        to[a] = spux_hmax(high[a]);
    }
    cgt_morton_curve_init(from, to, bits < max_bits ? bits : max_bits, curve);
    return curve->bits > 0;
}

/* Counts the primitives of each cell to start[cell + 1]. */
static void count_cells(const cgt_bvh_build *b, const split_run *r, const cgt_morton_curve *curve, uint32_t *start)
{
    for (uint32_t i = r->begin; i < r->end; i += CGT_LANES) {
        const uint32_t remaining = r->end - i, count = remaining < CGT_LANES ? remaining : CGT_LANES;
        vfloat middle[3];
        for (int a = 0; a < 3; a++)
            middle[a] = spux_load_mask(b->middle[a] + i, spux_mask_first(count));
        spux_store_mask_uint(b->key + i, morton_cells(curve, middle), spux_mask_first(count));
        for (uint32_t k = 0; k < count; k++)
            start[b->key[i + k] + 1]++;
        if (remaining <= CGT_LANES)
            break;
    }
}

/* Sorts a run's primitives by cells of its own, whose starts are stored in `start`. */
static void sort_by_cells(const cgt_bvh_build *b, const split_run *r, const cgt_morton_curve *curve, uint32_t *start)
{
    const uint32_t cells = UINT32_C(1) << curve->bits;
    memset(start, 0, (cells + 1) * sizeof *start);
    count_cells(b, r, curve, start);
    start[0] = r->begin;
    for (uint32_t c = 0; c < cells; c++)
        start[c + 1] += start[c];
    memcpy(b->scratch + r->begin, b->prim + r->begin, (r->end - r->begin) * sizeof *b->prim);
    for (uint32_t i = r->begin; i < r->end; i++)
        b->prim[start[b->key[i]]++] = b->scratch[i];
    memmove(start + 1, start, cells * sizeof *start); /* each has moved to its cell's end */
    start[0] = r->begin;
}

/* Splits a run that cells cannot part. */
static void split_crowded(split_work *w, const split_run *r)
{
    cgt_morton_curve curve;
    if (r->start && r->round < MAX_ROUNDS && make_curve(w->build, w->range, r, &curve)) {
        split_run cells = *r;
        cells.start = w->start[r->round];
        cells.round++;
        sort_by_cells(w->build, r, &curve, w->start[r->round]);
        push_run(w, &cells, 0, curve.bits, r->begin, r->end, r->depth, r->parting);
        return;
    }
    split_run unsorted = *r;
    unsorted.start = NULL;
    unsorted.bits = 1; /* it has halves */
    push_halves(w, &unsorted, r->begin + (count_full_runs(w->build, r) + 1) / 2 * max_run(w->build));
}

void CGT_KERNEL(cgt_bvh_split_range)(const cgt_bvh_build *build, cgt_bvh_range *range)
{
    split_work w;
    w.build = build;
    w.range = range;
    w.runs = 0;
    range->leaves = 0;
    const split_run all = {.start = build->start};
    push_run(&w, &all, range->cell, range->bits, range->begin, range->end, range->depth, range->parting);
    while (w.runs) {
        const split_run r = w.run[--w.runs];
        if (r.end - r.begin <= max_run(build))
            append_leaves(&w, &r);
        else if (r.start && r.bits)
            push_halves(&w, &r, r.start[r.cell + (UINT32_C(1) << r.bits) / 2]);
        else
            split_crowded(&w, &r);
    }
}
