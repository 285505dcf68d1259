/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through a bounding interval hierarchy with a stack: a vector of rays of a packet at a time, each with its own
 * interval of t, or one ray at a time. Directions of any signs may be mixed, as in a kd-tree
 * (kd_traverse.c): only the order of the children is common. Children may overlap, so a hit in the first one ends
 * nothing: the second is left out where it begins beyond the closest hit. Each primitive is in one leaf, so no mailbox
 * is needed. */
#include "papers/kernel/bih/bih_rays.h"

/* ---- a vector of rays ---- */

typedef struct bih_entry {
    bih_part part;
    uint32_t node;
} bih_entry;

/* Descends from an inner node to a child that any ray passes; the other one may go to the stack. Returns the child, or
 * CGT_INVALID_ID where no ray passes either. */
CGT_SPU_INLINE uint32_t bih_descend(const tree_rays *r, const cgt_bih_node *n, bih_part *part, bih_entry *stack,
                                    uint32_t *top)
{
    const uint32_t child = n->word[3], first = r->reverse >> cgt_bih_axis(n) & 1;
    bih_part q[2];
    if (cgt_bih_is_clip(n)) {
        *part = bih_clip(r, n, *part);
        return spux_any(spux_cmpge(part->far, part->near)) ? child : CGT_INVALID_ID;
    }
    bih_split(r, n, *part, q);
    const bool passes_second = spux_any(spux_cmpge(q[1].far, q[1].near));
    if (spux_any(spux_cmpge(q[0].far, q[0].near))) {
        *part = q[0];
        if (passes_second) {
            stack[*top].part = q[1];
            stack[*top].node = child + !first;
            ++*top;
        }
        return child + first;
    }
    *part = q[1];
    return passes_second ? child + !first : CGT_INVALID_ID;
}

static void bih_traverse_vector(const cgt_bih *tree, leaf_tests *l, uint32_t i)
{
    packet *p = l->p;
    bih_entry stack[CGT_BIH_MAX_DEPTH];
    uint32_t top = 0, node = 0, nodes = 0;
    tree_rays r;
    bih_part part;
    lane_rays test_rays;
    ray_box_enter(p, i, tree->low, tree->high, BIH_RANGE_ERROR, &part.near, &part.far);
    if (spux_none(spux_cmpge(part.far, part.near)))
        return;
    bih_rays_init(p, i, &r);
    lane_rays_of_packet(p, i, l->scale, &test_rays);
    l->counts->packets++;
    for (;;) {
        const cgt_bih_node *n = &tree->node[node];
        if (!cgt_bih_is_leaf(n)) {
            nodes++;
            node = bih_descend(&r, n, &part, stack, &top);
            if (node != CGT_INVALID_ID)
                continue;
        } else {
            l->counts->leaves++;
            leaf_test_vector(l, &test_rays, cgt_bih_references(tree, n), cgt_bih_count(n), i);
        }
        const vfloat best = spux_load(p->high + i);
        do {
            if (!top) {
                l->counts->nodes += nodes;
                return;
            }
            top--;
            part.near = stack[top].part.near;
            part.far = spux_min(stack[top].part.far, best);
        } while (spux_none(spux_cmpge(part.far, part.near)));
        node = stack[top].node;
    }
}

/* ---- one ray ---- */

/* As bih_descend. */
CGT_SPU_INLINE uint32_t bih_ray_descend(const bih_ray *r, const cgt_bih_node *n, float *near, float *far,
                                        tree_ray_entry *stack, uint32_t *top)
{
    const uint32_t axis = cgt_bih_axis(n), child = n->word[3], first = r->ray.reverse >> axis & 1;
    const float plane[2] = {cgt_bih_plane(n, 0), cgt_bih_plane(n, 1)};
    const bool flat = r->ray.flat >> axis & 1;
    if (cgt_bih_is_clip(n)) {
        const float enter = plane[first] * r->ray.rdir[axis] + r->first[axis],
                    leave = plane[!first] * r->ray.rdir[axis] + r->last[axis];
        if (flat)
            return bih_flat_passes(&r->ray, axis, plane[0], plane[1]) ? child : CGT_INVALID_ID;
        *near = enter > *near ? enter : *near;
        *far = leave < *far ? leave : *far;
        return *near <= *far ? child : CGT_INVALID_ID;
    }
    float leave = plane[first] * r->ray.rdir[axis] + r->last[axis],
          enter = plane[!first] * r->ray.rdir[axis] + r->first[axis];
    leave = leave < *far ? leave : *far;
    enter = enter > *near ? enter : *near;
    bool passes_first = *near <= leave, passes_second = enter <= *far;
    if (flat) { /* not reversed, or of a component below TREE_MIN_DIR, which passes both */
        leave = *far;
        enter = *near;
        passes_first = bih_flat_passes(&r->ray, axis, -INFINITY, plane[0]);
        passes_second = bih_flat_passes(&r->ray, axis, plane[1], INFINITY);
    }
    if (passes_first && passes_second)
        stack[(*top)++] = (tree_ray_entry){enter, *far, child + !first};
    if (passes_first)
        *far = leave;
    else
        *near = enter;
    return passes_first ? child + first : passes_second ? child + !first : CGT_INVALID_ID;
}

static void bih_traverse_ray(const void *of, leaf_tests *l, uint32_t i, float near, float far)
{
    const cgt_bih *tree = of;
    packet *p = l->p;
    tree_ray_entry stack[CGT_BIH_MAX_DEPTH];
    uint32_t top = 0, node = 0, nodes = 0, leaves = 0;
    bih_ray r;
    lane_rays test_rays;
    bih_ray_init(p, i, &r);
    lane_rays_of_one(p, i, l->scale, &test_rays);
    for (;;) {
        const cgt_bih_node *n = &tree->node[node];
        while (!cgt_bih_is_leaf(n)) {
            nodes++;
            node = bih_ray_descend(&r, n, &near, &far, stack, &top);
            if (node == CGT_INVALID_ID)
                break;
            n = &tree->node[node];
        }
        if (node != CGT_INVALID_ID) {
            leaves++;
            leaf_test_ray(l, &test_rays, cgt_bih_references(tree, n), cgt_bih_count(n), i);
        }
        if (!tree_ray_pop(stack, &top, p->high[i]))
            break;
        near = stack[top].near;
        far = stack[top].far < p->high[i] ? stack[top].far : p->high[i];
        node = stack[top].node;
    }
    l->counts->nodes += nodes;
    l->counts->leaves += leaves;
}

void CGT_KERNEL(cgt_bih_trace)(const cgt_committed_scene *committed_scene, packet *p,
                               const cgt_trace_settings *settings, cgt_counts *counts)
{
    leaf_tests l;
    const cgt_bih *tree = &committed_scene->papers->bih;
    leaf_tests_init(committed_scene, p, settings, counts, &l);
    l.mailbox = false;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        if (settings->kd_traversal == CGT_KD_TRAVERSAL_SINGLE)
            tree_rays_trace_single(tree, tree->low, tree->high, BIH_RANGE_ERROR, &l, i, bih_traverse_ray);
        else
            bih_traverse_vector(tree, &l, i);
    }
}
