/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Leaf blocks of the BVH, and the binary tree over them. Spheres are copied as they are; capsules are scaled; triangles
 * are prepared as in src/papers/model/leaf_triangle.c, with the same bits. */
#include <math.h>

#include "kernel/builders/bvh/bvh_binary.h"
#include "kernel/builders/bvh/bvh_fetch.h"
#include "kernel/builders/bvh/bvh_turn.h"

#define MAX_LISTED_PRIMS 512u /* of clusters that are listed together */
#define PREFETCH_CLUSTERS 32u /* prefetch distance */

/* Bounds of all within a radius of boxes. A sum is rounded by at most 2^-24 of itself, or not at all where it is below
 * 2^-126. 2^-22 of it is rounded by 2^-150 at most, and the difference once more by 2^-24: a margin of 2^-23 at least
 * remains. Only triangles may be flat (bvh_node.flat): what is in a plane through the origin gets the least extent. */
CGT_SPU_INLINE void bound_rounded(const vfloat from[3], const vfloat to[3], vfloat r, bvh_leaf_record *leaf)
{
    const vfloat radius = spux_abs(r), rel_error = spux_vfloat(0x1p-22f);
    for (int a = 0; a < 3; a++) {
        const vfloat low = spu_sub(from[a], radius), high = spu_add(to[a], radius);
        leaf->low[a] = spux_hmin(spu_sub(low, spu_mul(spux_abs(low), rel_error)));
        leaf->high[a] = spux_hmax(spu_add(high, spu_mul(spux_abs(high), rel_error)));
        if (leaf->low[a] == leaf->high[a])
            leaf->high[a] = nextafterf(leaf->high[a], INFINITY);
    }
}

/* Stores to a block. */
CGT_SPU_INLINE void store_block(float *to, vfloat v, bool nontemporal)
{
    if (nontemporal)
        spux_stream(to, v);
    else
        spux_store(to, v);
}

CGT_SPU_INLINE void store_block_uint(uint32_t *to, vuint v, bool nontemporal)
{
    if (nontemporal)
        spux_stream_uint(to, v);
    else
        spux_store_uint(to, v);
}

/* Primitives in the order of leaves: sorted ones, or those of sorted clusters, of which some are listed ahead. */
typedef struct leaf_prims {
    const uint32_t *prim;
    uint32_t next, end;         /* prefetched ones may be those of another range */
    uint32_t cluster, clusters; /* not listed yet */
    uint32_t cluster_prims[MAX_LISTED_PRIMS + CGT_CLUSTER];
} leaf_prims;

static void leaf_prims_init(const cgt_bvh_build *b, const cgt_bvh_range *range, leaf_prims *o)
{
    o->prim = b->cluster ? o->cluster_prims : b->prim;
    o->next = b->cluster ? 0 : range->begin;
    o->end = b->cluster ? 0 : b->sorted;
    o->cluster = b->cluster ? range->begin : range->end;
    o->clusters = range->end;
    if (b->cluster) /* for analysers, which do not see that it is filled before it is read */
        memset(o->cluster_prims, 0, sizeof o->cluster_prims);
}

/* Lists the triangles of as many clusters as there is room for, where there are too few for a leaf. */
CGT_SPU_INLINE void leaf_prims_refill(const cgt_bvh_build *b, leaf_prims *o)
{
    if (o->cluster == o->clusters || o->end - o->next >= CGT_LANES)
        return;
    memmove(o->cluster_prims, o->cluster_prims + o->next, (o->end - o->next) * sizeof *o->cluster_prims);
    o->end -= o->next;
    o->next = 0;
    for (; o->cluster < o->clusters && o->end <= MAX_LISTED_PRIMS - CGT_CLUSTER; o->cluster++) {
        const uint32_t number = b->prim[o->cluster], valid = b->cluster[number].valid;
        const uint32_t prefetched = o->cluster + PREFETCH_CLUSTERS;
        __builtin_prefetch(&b->cluster[b->prim[prefetched < o->clusters ? prefetched : o->cluster]]);
        if (valid == (1u << CGT_CLUSTER) - 1) { /* most are */
            for (uint32_t k = 0; k < CGT_CLUSTER; k++)
                o->cluster_prims[o->end + k] = number * CGT_CLUSTER + k;
            o->end += CGT_CLUSTER;
            continue;
        }
        for (uint32_t k = 0; k < CGT_CLUSTER; k++) {
            o->cluster_prims[o->end] = number * CGT_CLUSTER + k; /* overwritten where it is not valid */
            o->end += valid >> k & 1;
        }
    }
}

static void build_sphere_block(const cgt_bvh_build *b, const leaf_prims *o, uint32_t count, sphere_block *block,
                               bvh_leaf_record *leaf)
{
    const prim_run run = prim_run_load(b->prims, o->prim + o->next, count);
    prefetch_run(&run, o->prim, o->next, count, o->end);
    vfloat d[4];
    prim_run_gather_spheres(&run, d);
    for (int a = 0; a < 3; a++)
        store_block(block->center[a], d[a], b->nontemporal);
    store_block(block->radius, d[3], b->nontemporal);
    store_block_uint(block->prim, run.prim, b->nontemporal);
    bound_rounded(d, d, d[3], leaf);
}

static void build_triangle_block(const cgt_bvh_build *b, const leaf_prims *o, uint32_t count, triangle_block *block,
                                 bvh_leaf_record *leaf)
{
    const prim_run run = prim_run_load(b->prims, o->prim + o->next, count);
    prefetch_run(&run, o->prim, o->next, count, o->end);
    const vfloat scale = spux_vfloat(b->scale);
    vfloat v[3][3], edge[2][3];
    prim_run_gather_triangles(&run, v);
    for (int a = 0; a < 3; a++) {
        const vfloat vertex = spu_mul(v[0][a], scale);
        leaf->low[a] = spux_hmin(spux_min(v[0][a], spux_min(v[1][a], v[2][a])));
        leaf->high[a] = spux_hmax(spux_max(v[0][a], spux_max(v[1][a], v[2][a])));
        store_block(block->vertex[a], vertex, b->nontemporal);
        for (int k = 0; k < 2; k++) {
            edge[k][a] = spu_sub(spu_mul(v[k + 1][a], scale), vertex);
            store_block(block->edge[k][a], edge[k][a], b->nontemporal);
        }
    }
    for (int k = 0; k < 2; k++) {
        const vfloat sum = spu_add(spux_abs(edge[k][0]), spux_abs(edge[k][1]));
        store_block(block->sum[k], spu_add(sum, spux_abs(edge[k][2])), b->nontemporal);
    }
    store_block_uint(block->prim, run.prim, b->nontemporal);
}

static void build_capsule_block(const cgt_bvh_build *b, const leaf_prims *o, uint32_t count, capsule_block *block,
                                bvh_leaf_record *leaf)
{
    const prim_run run = prim_run_load(b->prims, o->prim + o->next, count);
    prefetch_run(&run, o->prim, o->next, count, o->end);
    const vfloat scale = spux_vfloat(b->scale);
    vfloat d[7], low[3], high[3];
    prim_run_gather_capsules(&run, d);
    for (int a = 0; a < 3; a++) {
        low[a] = spux_min(d[a], d[3 + a]);
        high[a] = spux_max(d[a], d[3 + a]);
        store_block(block->end[0][a], spu_mul(d[a], scale), b->nontemporal);
        store_block(block->end[1][a], spu_mul(d[3 + a], scale), b->nontemporal);
    }
    store_block(block->radius, spu_mul(d[6], scale), b->nontemporal);
    store_block_uint(block->prim, run.prim, b->nontemporal);
    bound_rounded(low, high, d[6], leaf);
    leaf->is_bundle = bvh_is_bundle(d, leaf);
}

/* Block `number` of its kind, of the next `count` primitives. */
static void build_leaf(const cgt_bvh_build *b, cgt_kind kind, leaf_prims *o, uint32_t count, uint32_t number,
                       bvh_leaf_record *leaf)
{
    uint32_t code = CGT_BVH_LEAF | (count - 1) << CGT_BVH_COUNT_SHIFT | number;
    leaf->is_bundle = 0;
    switch (kind) {
    case CGT_KIND_SPHERES: build_sphere_block(b, o, count, (sphere_block *)b->block[kind] + number, leaf); break;
    case CGT_KIND_TRIANGLES:
        build_triangle_block(b, o, count, (triangle_block *)b->block[kind] + number, leaf);
        code |= CGT_BVH_BOXED_LEAF;
        break;
    case CGT_KIND_CAPSULES:
        build_capsule_block(b, o, count, (capsule_block *)b->block[kind] + number, leaf);
        code = (code | CGT_BVH_BOXED_LEAF) + b->triangle_blocks;
        break;
    }
    o->next += count;
    leaf->code = code;
}

static void push_leaf(bvh_branch_stack *s, const bvh_leaf_record *leaf, uint32_t reference, uint32_t parting)
{
    bvh_branch *branch = &s->branch[s->count];
    s->parting[s->count++] = parting;
    spux_store(branch->cost, spux_vfloat(0));
    for (int a = 0; a < 3; a++) {
        branch->low[a] = leaf->low[a];
        branch->high[a] = leaf->high[a];
    }
    branch->reference = reference;
    branch->leaves = 1;
}

void CGT_KERNEL(cgt_bvh_build_leaves)(const cgt_bvh_build *b, uint32_t number)
{
    cgt_bvh_range *range = &b->range[number];
    const uint16_t *list = b->leaf + range->begin * b->leaves_each;
    leaf_prims o;
    bvh_branch_stack s;
    leaf_prims_init(b, range, &o);
    s.count = 0;
    s.next = range->first_inner;
    for (uint32_t i = 0; i < range->leaves; i++) {
        const uint32_t count = (list[i] & 0xff) + 1u, parting = list[i] >> 8;
        const uint32_t reference = CGT_BVH_LEAF_REF | (range->first_leaf + i);
        bvh_leaf_record *leaf = bvh_leaf_at(b, reference);
        leaf_prims_refill(b, &o);
        build_leaf(b, range->kind, &o, count, range->first_block + i, leaf);
        range->has_bundles |= leaf->is_bundle != 0;
        if (i)
            bvh_branch_merge_deeper(b, &s, parting);
        push_leaf(&s, leaf, reference, parting);
    }
    bvh_branch_merge_all(b, &s);
    spux_stream_end();
    ((bvh_branch *)b->branch)[number] = s.branch[0];
}
