/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Leaf blocks of the wide tree, and the binary tree over them. Spheres are copied as they are; triangles become what
 * src/model/leaf_triangle.c makes of them, bit by bit. */
#include <math.h>

#include "kernel/build_bvh/bvh_binary.h"
#include "kernel/build_bvh/bvh_fetch.h"

#define OBJECTS 512u       /* of clusters, listed together */
#define CLUSTERS_AHEAD 32u /* that are on their way */

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

/* Objects in the order of leaves: as they were sorted, or those of clusters, some of which were taken from there. */
typedef struct leaf_objects {
    const uint32_t *object;
    uint32_t next, end;         /* those that are asked for ahead may be another range's */
    uint32_t cluster, clusters; /* that are still to come */
    uint32_t own[OBJECTS + CGT_CLUSTER];
} leaf_objects;

static void objects_begin(const cgt_wide_build *b, const cgt_wide_range *range, leaf_objects *o)
{
    o->object = b->cluster ? o->own : b->object;
    o->next = b->cluster ? 0 : range->begin;
    o->end = b->cluster ? 0 : b->sorted;
    o->cluster = b->cluster ? range->begin : range->end;
    o->clusters = range->end;
    if (b->cluster) /* it is filled before it is read, which analysers do not see */
        memset(o->own, 0, sizeof o->own);
}

/* Takes triangles of as many clusters as there is room for, where there are not enough for a leaf. */
CGT_SPU_INLINE void objects_renew(const cgt_wide_build *b, leaf_objects *o)
{
    if (o->cluster == o->clusters || o->end - o->next >= CGT_LANES)
        return;
    memmove(o->own, o->own + o->next, (o->end - o->next) * sizeof *o->own);
    o->end -= o->next;
    o->next = 0;
    for (; o->cluster < o->clusters && o->end <= OBJECTS - CGT_CLUSTER; o->cluster++) {
        const uint32_t number = b->object[o->cluster], valid = b->cluster[number].valid;
        const uint32_t ahead = o->cluster + CLUSTERS_AHEAD;
        __builtin_prefetch(&b->cluster[b->object[ahead < o->clusters ? ahead : o->cluster]]);
        if (valid == (1u << CGT_CLUSTER) - 1) { /* most are */
            for (uint32_t k = 0; k < CGT_CLUSTER; k++)
                o->own[o->end + k] = number * CGT_CLUSTER + k;
            o->end += CGT_CLUSTER;
            continue;
        }
        for (uint32_t k = 0; k < CGT_CLUSTER; k++) {
            o->own[o->end] = number * CGT_CLUSTER + k; /* written over where it is not valid */
            o->end += valid >> k & 1;
        }
    }
}

static void make_spheres(const cgt_wide_build *b, const leaf_objects *o, uint32_t count, wide_spheres *block,
                         wide_leaf *leaf)
{
    const wide_run run = wide_run_of(b->objects, o->object + o->next, count);
    wide_ask(&run, o->object, o->next, count, o->end);
    vfloat d[4];
    wide_run_spheres(&run, d);
    for (int a = 0; a < 3; a++)
        put(block->center[a], d[a], b->stream);
    put(block->radius, d[3], b->stream);
    put_numbers(block->object, run.object, b->stream);
    bound_spheres(d, leaf);
}

static void make_triangles(const cgt_wide_build *b, const leaf_objects *o, uint32_t count, wide_triangles *block,
                           wide_leaf *leaf)
{
    const wide_run run = wide_run_of(b->objects, o->object + o->next, count);
    wide_ask(&run, o->object, o->next, count, o->end);
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

/* Block `number` of its kind, of the next `count` objects. */
static void make_leaf(const cgt_wide_build *b, cgt_kind kind, leaf_objects *o, uint32_t count, uint32_t number,
                      wide_leaf *leaf)
{
    const uint32_t triangles = kind == CGT_KIND_TRIANGLES ? CGT_WIDE_TRIANGLES : 0;
    if (triangles)
        make_triangles(b, o, count, (wide_triangles *)b->block[kind] + number, leaf);
    else
        make_spheres(b, o, count, (wide_spheres *)b->block[kind] + number, leaf);
    o->next += count;
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
    const uint16_t *list = b->leaf + range->begin * b->leaves_each;
    leaf_objects o;
    wide_branches s;
    objects_begin(b, range, &o);
    s.count = 0;
    s.next = range->first_inner;
    for (uint32_t i = 0; i < range->leaves; i++) {
        const uint32_t count = (list[i] & 0xff) + 1u, parting = list[i] >> 8;
        const uint32_t reference = CGT_WIDE_LEAF_REF | (range->first_leaf + i);
        wide_leaf *leaf = wide_leaf_at(b, reference);
        objects_renew(b, &o);
        make_leaf(b, range->kind, &o, count, range->first_block + i, leaf);
        if (i)
            wide_branches_part(b, &s, parting);
        add_leaf(&s, leaf, reference, parting);
    }
    wide_branches_finish(b, &s);
    spux_stream_end();
    ((wide_branch *)b->branch)[number] = s.branch[0];
}
