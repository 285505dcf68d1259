/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the binary tree to BVH nodes. First the inner records that become BVH nodes are chosen, from the root down:
 * those above the ranges by one thread, then those of each range. Their children are listed node by node, and nodes
 * have the order of that list. Then the nodes are written. */
#include <math.h>

#include "kernel/builders/bvh/bvh_turn.h"

/* ---- choosing ---- */

static bool is_inner(uint32_t reference) { return !(reference & CGT_BVH_LEAF_REF); }

/* Lists the children of a BVH node. Returns how many. */
static uint32_t list_children(const cgt_bvh_build *b, const bvh_inner_record *root, uint32_t *child)
{
    const bvh_inner_record *first = bvh_inner_records(b);
    uint32_t reference[CGT_LANES], slots[CGT_LANES], count = 0, children = 0;
    reference[count] = root->child[1];
    slots[count++] = CGT_LANES - root->slots[CGT_LANES - 1];
    reference[count] = root->child[0];
    slots[count++] = root->slots[CGT_LANES - 1];
    while (count) {
        const uint32_t r = reference[--count], k = slots[count];
        if (!is_inner(r) || !first[r].slots[k - 1]) {
            child[children++] = r;
            continue;
        }
        const bvh_inner_record *n = &first[r];
        reference[count] = n->child[1];
        slots[count++] = k - n->slots[k - 1];
        reference[count] = n->child[0];
        slots[count++] = n->slots[k - 1];
    }
    return children;
}

/* Returns the number of the range that holds an inner record, or b->ranges for the top. Ranges of one leaf hold none:
 * of several that start at a record, the last one holds it. */
static uint32_t find_range(const cgt_bvh_build *b, uint32_t inner)
{
    uint32_t low = 0, high = b->ranges;
    if (inner >= b->top.first_inner)
        return b->ranges;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (b->range[middle].first_inner <= inner)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Lists a child as a root of its range, where it is a node of one. */
static void append_root(cgt_bvh_build *b, uint32_t inner, uint32_t depth)
{
    const uint32_t number = find_range(b, inner);
    bvh_inner_record *n = bvh_inner_records(b) + inner;
    n->depth = depth;
    if (number == b->ranges)
        return;
    cgt_bvh_range *range = &b->range[number];
    n->number = range->roots;
    bvh_child_list(b, range)[range->roots++] = inner;
}

/* Chooses the BVH nodes of a range whose roots are listed. */
CGT_SPU_INLINE void choose_range_nodes(cgt_bvh_build *top, const cgt_bvh_build *b, cgt_bvh_range *range)
{
    bvh_inner_record *first = bvh_inner_records(b);
    uint32_t *list = bvh_child_list(b, range);
    range->list_length = range->roots;
    for (uint32_t i = 0; i < range->list_length; i++) {
        if (!is_inner(list[i]) || (top && list[i] < range->first_inner))
            continue;
        bvh_inner_record *n = &first[list[i]];
        uint32_t *child = list + range->list_length;
        const uint32_t depth = n->depth + 1, children = list_children(b, n, child);
        for (uint32_t k = 0; k < children; k++) {
            if (!is_inner(child[k]))
                continue;
            if (top)
                append_root(top, child[k], depth);
            else
                first[child[k]].depth = depth;
        }
        n->slots[0] = (uint8_t)children;
        range->list_length += children;
        range->nodes++;
        range->deepest = depth > range->deepest ? depth : range->deepest;
    }
}

void CGT_KERNEL(cgt_bvh_join_ranges)(cgt_bvh_build *b)
{
    const bvh_branch *branch = b->branch;
    bvh_branch_stack s;
    s.branch[0] = branch[0];
    s.count = 1;
    s.next = b->top.first_inner;
    for (uint32_t i = 1; i < b->ranges; i++) {
        bvh_branch_merge_deeper(b, &s, b->range[i].parting);
        s.parting[s.count] = b->range[i].parting;
        s.branch[s.count++] = branch[i];
    }
    bvh_branch_merge_all(b, &s);
    b->root = s.branch[0].reference;
    for (int a = 0; a < 3; a++) {
        b->low[a] = s.branch[0].low[a];
        b->high[a] = s.branch[0].high[a];
    }
    if (!is_inner(b->root))
        return;
    append_root(b, b->root, 0);
    if (find_range(b, b->root) < b->ranges)
        return;
    bvh_child_list(b, &b->top)[b->top.roots++] = b->root;
    choose_range_nodes(b, b, &b->top);
}

/* Prefetches memory that is about to be read in random order. */
CGT_SPU_INLINE void prefetch_span(const void *first, const void *end)
{
    for (const char *p = first; p < (const char *)end; p += CGT_ALIGNMENT)
        __builtin_prefetch(p);
}

CGT_SPU_INLINE void prefetch_inner(const cgt_bvh_build *b, const cgt_bvh_range *range)
{
    const bvh_inner_record *inner = bvh_inner_records(b) + range->first_inner;
    if (range != &b->top && range->leaves)
        prefetch_span(inner, inner + range->leaves - 1);
}

CGT_SPU_INLINE void prefetch_leaves(const cgt_bvh_build *b, const cgt_bvh_range *range)
{
    const bvh_leaf_record *leaf = (const bvh_leaf_record *)b->record + range->first_leaf;
    prefetch_span(leaf, leaf + range->leaves);
}

void CGT_KERNEL(cgt_bvh_choose_nodes)(const cgt_bvh_build *b, cgt_bvh_range *range)
{
    prefetch_inner(b, range);
    choose_range_nodes(NULL, b, range);
}

/* ---- writing ---- */

/* Lanes in ascending order of keys, equal ones by number. A NaN is last: of floats that changed since the commit, whose
 * lanes must be numbers of children all the same. */
CGT_SPU_INLINE void order_lanes(vfloat given, uint8_t order[CGT_LANES])
{
    const vfloat key = spux_select(spux_vfloat(INFINITY), given, spu_cmpeq(given, given));
    const vuint lane = spux_lane_index(), one = spux_vuint(1), zero = spux_vuint(0);
    _Alignas(CGT_VECTOR_BYTES) float keys[CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) uint32_t ranks[CGT_LANES];
    vuint rank = zero;
    spux_store(keys, key);
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const vfloat key_k = spux_vfloat(keys[k]);
        const vmask precedes =
            spu_or(spu_cmpgt(key, key_k), spu_and(spu_cmpeq(key, key_k), spu_cmpgt(lane, spux_vuint(k))));
        rank = spu_add(rank, spux_select(zero, one, precedes));
    }
    spux_store_uint(ranks, rank);
    for (uint32_t k = 0; k < CGT_LANES; k++)
        order[ranks[k]] = (uint8_t)k;
}

/* Orders children by twice the coordinate of their middles along the diagonal of an octant. Sums are finite: a scene
 * that has a structure is within CGT_MAX_COORDINATE. */
CGT_SPU_INLINE void order_children(const vfloat low[3], const vfloat high[3], vmask present, bvh_node *node)
{
    const vfloat x = spu_add(low[0], high[0]), y = spu_add(low[1], high[1]), z = spu_add(low[2], high[2]);
    const vfloat sum = spu_add(x, y), difference = spu_sub(y, x), none = spux_vfloat(INFINITY);
    order_lanes(spux_select(none, spu_add(sum, z), present), node->order[0]);
    order_lanes(spux_select(none, spu_add(difference, z), present), node->order[1]);
    order_lanes(spux_select(none, spu_sub(z, difference), present), node->order[2]);
    order_lanes(spux_select(none, spu_sub(z, sum), present), node->order[3]);
}

/* Loads the boxes of records. */
CGT_SPU_INLINE void load_boxes(const cgt_bvh_build *b, const uint32_t reference[CGT_LANES], vfloat low[3],
                               vfloat high[3])
{
    const uint32_t inner = (uint32_t)((const char *)bvh_inner_records(b) - (const char *)b->record) / sizeof(float);
    uint32_t offset[CGT_LANES];
    vfloat d[4];
    for (int k = 0; k < CGT_LANES; k++) {
        const uint32_t r = reference[k];
        offset[k] = is_inner(r) ? inner + r * (uint32_t)(sizeof(bvh_inner_record) / sizeof(float))
                                : (r & ~CGT_BVH_LEAF_REF) * (uint32_t)(sizeof(bvh_leaf_record) / sizeof(float));
    }
    spux_load_records4_at(b->record, offset, d);
    for (int a = 0; a < 3; a++)
        low[a] = d[a];
    spux_load_records4_at((const float *)b->record + 4, offset, d);
    for (int a = 0; a < 3; a++)
        high[a] = d[a];
}

/* Returns the code of a child. next: the number of the range's next node that is a child. */
CGT_SPU_INLINE uint32_t child_code(const cgt_bvh_build *b, const cgt_bvh_range *range, uint32_t child, uint32_t *next)
{
    if (!is_inner(child))
        return bvh_leaf_at(b, child)->code;
    if (range != &b->top || child >= range->first_inner)
        return range->first_node + (*next)++;
    return b->range[find_range(b, child)].first_node + bvh_inner_records(b)[child].number;
}

/* Planes lie outside by what single precision loses of them: see kernel/bvh/bvh_ray.h. */
#define PLANE_MARGIN 0x1p-20f

static void build_node(const cgt_bvh_build *b, const cgt_bvh_range *range, const uint32_t *child, uint32_t children,
                       uint32_t *next, bvh_node *node)
{
    const vmask present = spux_mask_first(children);
    uint32_t reference[CGT_LANES];
    vfloat low[3], high[3];
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        reference[k] = child[k < children ? k : 0];
        node->child[k] = k < children ? child_code(b, range, reference[k], next) : CGT_BVH_NO_CHILD;
    }
    load_boxes(b, reference, low, high);
    for (int a = 0; a < 3; a++) {
        const vfloat margin = spux_vfloat(PLANE_MARGIN);
        const vfloat lower = spu_nmsub(spux_abs(low[a]), margin, low[a]);
        const vfloat upper = spu_madd(spux_abs(high[a]), margin, high[a]);
        spux_store(node->low[a], spux_select(spux_vfloat(INFINITY), lower, present));
        spux_store(node->high[a], spux_select(spux_vfloat(-INFINITY), upper, present));
        node->flat[a] = spux_mask_bits(spu_and(spu_cmpeq(low[a], high[a]), present)); /* spheres: bvh_leaves.c */
    }
    order_children(low, high, present, node);
    node->children = children;
    if (b->turned)
        bvh_turn_node(b, child, children, low, high, node);
}

void CGT_KERNEL(cgt_bvh_build_nodes)(const cgt_bvh_build *b, const cgt_bvh_range *range)
{
    const bvh_inner_record *first = bvh_inner_records(b);
    const uint32_t *list = bvh_child_list(b, range), *child = list + range->roots, *end = list + range->list_length;
    bvh_node *node = (bvh_node *)b->node + range->first_node;
    uint32_t next = range->roots;
    prefetch_inner(b, range);
    prefetch_leaves(b, range);
    if (range == &b->top && !is_inner(b->root)) { /* a leaf is all there is */
        build_node(b, range, &b->root, 1, &next, node);
        return;
    }
    for (; list < end; list++) {
        if (!is_inner(*list) || (range == &b->top && *list < range->first_inner))
            continue;
        const uint32_t children = first[*list].slots[0];
        build_node(b, range, child, children, &next, node++);
        child += children;
    }
}

/* ---- the table ---- */

cgt_prim_keys_fn CGT_KERNEL(cgt_bvh_keys);
cgt_cluster_keys_fn CGT_KERNEL(cgt_bvh_cluster_keys);
cgt_bvh_split_fn CGT_KERNEL(cgt_bvh_split_range);
cgt_bvh_leaves_fn CGT_KERNEL(cgt_bvh_build_leaves);

const cgt_bvh_builder CGT_KERNEL(cgt_bvh_builder) = {
    .node_bytes = sizeof(bvh_node),
    .turned_bytes = sizeof(bvh_turned),
    .block_bytes = {sizeof(sphere_block), sizeof(triangle_block), sizeof(capsule_block)},
    .leaf_bytes = sizeof(bvh_leaf_record),
    .inner_bytes = sizeof(bvh_inner_record),
    .branch_bytes = sizeof(bvh_branch),
    .lanes = CGT_LANES,
    .keys = CGT_KERNEL(cgt_bvh_keys),
    .cluster_keys = CGT_KERNEL(cgt_bvh_cluster_keys),
    .split = CGT_KERNEL(cgt_bvh_split_range),
    .leaves = CGT_KERNEL(cgt_bvh_build_leaves),
    .join = CGT_KERNEL(cgt_bvh_join_ranges),
    .choose = CGT_KERNEL(cgt_bvh_choose_nodes),
    .nodes = CGT_KERNEL(cgt_bvh_build_nodes),
};
