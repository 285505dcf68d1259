/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through a bounding interval hierarchy, a vector of a packet at a time, as the library's traversal does
 * (bih/bih_traverse.c), whose arithmetic of planes this shares. It differs in what is at hand: one look at the
 * cache of nodes brings both children, which lie side by side, so nodes themselves are kept and pushed, and the looking
 * up and loading overlap with the arithmetic of their parent. On a host, whose memory needs no looking up, numbers on
 * the stack are faster.
 *
 * Trees come from elsewhere, so they are watched (kd_store.h): children come after their parents, inner nodes that a
 * vector visits are counted, and no more is pushed than the deepest tree pushes. */
#ifndef KD_HIERARCHIES_H
#define KD_HIERARCHIES_H

#include "cell/programs/kd/kd_triangles.h"
#include "papers/kernel/bih/bih_rays.h"

typedef struct kd_bih_entry {
    bih_part part;
    cgt_bih_node node;
} kd_bih_entry;

#define KD_BIH_STACK 64u /* more than CGT_BIH_MAX_DEPTH; a power of two, so that no damaged tree reaches beyond it */

static inline bool kd_any_passes(const bih_part *part) { return spux_any(spux_cmpge(part->far, part->near)); }

/* Descends from an inner node to a child that any ray passes; the other one may go to the stack. Returns false where no
 * ray passes either. */
static inline bool kd_bih_descend(const tree_rays *r, cgt_bih_node *node, bih_part *part, kd_bih_entry *stack,
                                  uint32_t *top)
{
    const cgt_bih_node n = *node;
    const uint32_t first = r->reverse >> cgt_bih_axis(&n) & 1;
    const cgt_bih_node *const child = kd_get_nodes(n.word[3]);
    bih_part q[2];
    if (cgt_bih_is_clip(&n)) {
        *node = child[0];
        *part = bih_clip(r, &n, *part);
        return kd_any_passes(part);
    }
    /* load both children before it is known which one is next: the loads overlap with the arithmetic below */
    const cgt_bih_node nearer = child[first], farther = child[1 - first];
    bih_split(r, &n, *part, q);
    const bool passes_second = kd_any_passes(&q[1]);
    if (kd_any_passes(&q[0])) {
        *node = nearer;
        *part = q[0];
        if (passes_second) {
            kd_fetch_ahead(farther);
            stack[(*top)++ % KD_BIH_STACK] = (kd_bih_entry){q[1], farther};
        }
        return true;
    }
    *node = farther;
    *part = q[1];
    return passes_second;
}

static void kd_bih_traverse(const cgt_bih *tree, leaf_tests *l, uint32_t i)
{
    packet *const p = l->p;
    kd_bih_entry stack[KD_BIH_STACK];
    uint32_t top = 0, nodes = 0;
    cgt_bih_node n = *kd_get_nodes(0);
    tree_rays r;
    bih_part part;
    lane_rays test_rays;
    ray_box_enter(p, i, tree->low, tree->high, BIH_RANGE_ERROR, &part.near, &part.far);
    if (!kd_any_passes(&part))
        return;
    bih_rays_init(p, i, &r);
    lane_rays_of_packet(p, i, l->scale, &test_rays);
    for (;;) {
        if (!cgt_bih_is_leaf(&n)) {
            nodes++;
            if (kd_bih_descend(&r, &n, &part, stack, &top))
                continue;
        } else {
            l->counts->leaves++;
            kd_test_node(l, &test_rays, n, i);
        }
        if (__builtin_expect((nodes > tree->nodes) | (top > CGT_BIH_MAX_DEPTH), 0) && kd_break())
            return;
        const vfloat best = spux_load(p->high + i);
        do {
            if (!top) {
                l->counts->nodes += nodes;
                return;
            }
            const kd_bih_entry *const entry = &stack[--top % KD_BIH_STACK];
            part.near = entry->part.near;
            part.far = spux_min(entry->part.far, best);
        } while (!kd_any_passes(&part));
        n = stack[top % KD_BIH_STACK].node;
    }
}

static void kd_bih_trace(const cgt_committed_scene *scene, packet *p, const cgt_trace_settings *settings,
                         cgt_counts *counts)
{
    leaf_tests l;
    leaf_tests_init(scene, p, settings, counts, &l);
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
        kd_bih_traverse(&scene->papers->bih, &l, i);
}

#endif
