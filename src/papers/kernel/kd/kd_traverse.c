/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through a kd-tree: along ropes (kd_rope.h), or with a stack: a vector of rays of a packet at a time, each with
 * its own interval [near, far] of t inside the node (Wald 2004; thesis, section 4.1), or one ray at a time.
 *
 * Directions of any signs may be mixed: a ray's part below and above a split is the same whatever the others do; only
 * the order in which the children are visited is common: that of most rays that visit both. A ray with the opposite
 * order only loses a chance to stop early.
 *
 * Exactness: a child is culled for a ray only where the ray certainly does not pass its closed box at a t that still
 * counts. With r = 1 / dir, within 2^-21, the t of a plane is
 *   one ray:   (split - org) * r, within 2^-20 of its size and 2^-126
 *   a vector:  split * r - org * r, within 2^-20 of (|split| + |org|) |r| and 2^-120, fused or not, since products and
 *              sums lose four times 2^-24 of that; on an SPU, which loses four times 2^-23, within 2^-19. Of the
 *              root's largest split this is one number for a ray and an axis, so that both ends of the interval cost
 *              one operation, and depend on the split alone
 * and intervals are widened by that on both sides. A component of the direction that is 0 leaves a ray on the side of
 * its origin, on both where the origin lies in the plane; below 2^-70, where reciprocals leave the range, a ray counts
 * as on both. */
#include "papers/kernel/kd/kd_rope_packet.h"
#include "papers/kernel/kd/kd_rope_single.h"
#include "papers/kernel/kd/tree_rays.h"

#define PLANE_REL_ERROR (16 * SPUX_ROUNDOFF)

/* ---- a vector of rays ---- */

typedef struct kd_entry {
    vfloat near, far;
    cgt_kd_node node;
} kd_entry;

CGT_SPU_INLINE void kd_rays_init(const packet *p, const cgt_kd_tree *tree, uint32_t i, tree_rays *r)
{
    tree_rays_init(p, i, r);
    for (int a = 0; a < 3; a++) {
        const vfloat largest = spux_max(spux_abs(spux_vfloat(tree->low[a])), spux_abs(spux_vfloat(tree->high[a])));
        const vfloat to_plane = spu_mul(spu_add(spux_abs(r->org[a]), largest), spux_abs(r->rdir[a]));
        const vfloat t_error = spu_madd(to_plane, spux_vfloat(PLANE_REL_ERROR), spux_vfloat(0x1p-120f));
        tree_rays_widen(r, a, spu_mul(r->org[a], r->rdir[a]), t_error);
    }
}

/* The rays' parts in the child that most rays reach first, and in the other one. */
typedef struct kd_parts {
    vfloat near[2], far[2];
} kd_parts;

/* Lanes that differ from most, or run along the split. */
CGT_SPU_INLINE void kd_split_mixed(const tree_rays *r, uint32_t axis, float split, vfloat near, vfloat far, vfloat low,
                                   vfloat high, kd_parts *q)
{
    /* below the plane for ever, or above, or both; what counts as from below */
    const vfloat zero = spux_vfloat(0), t_never = spux_vfloat(INFINITY), t_always = spux_vfloat(-INFINITY);
    const vfloat delta = spu_sub(spux_vfloat(split), r->org[axis]);
    const vmask below = spu_and(r->zero[axis], spu_cmpgt(delta, zero)), opposite = r->opposite[axis];
    const vmask above = spu_and(r->zero[axis], spu_cmpgt(zero, delta));
    low = spux_select(low, spux_select(t_always, t_never, below), r->flat[axis]);
    high = spux_select(high, spux_select(t_never, t_always, above), r->flat[axis]);
    const vfloat first_far = spux_min(high, far), second_near = spux_max(low, near);
    q->near[0] = spux_select(near, second_near, opposite);
    q->far[0] = spux_select(first_far, far, opposite);
    q->near[1] = spux_select(second_near, near, opposite);
    q->far[1] = spux_select(far, first_far, opposite);
}

CGT_SPU_INLINE void kd_split_intervals(const tree_rays *r, uint32_t axis, float split, vfloat near, vfloat far,
                                       kd_parts *q)
{
    const vfloat plane = spux_vfloat(split);
    const vfloat low = spu_madd(plane, r->rdir[axis], r->first[axis]);
    const vfloat high = spu_madd(plane, r->rdir[axis], r->last[axis]);
    if (r->mixed >> axis & 1) {
        kd_split_mixed(r, axis, split, near, far, low, high, q);
        return;
    }
    q->near[0] = near;
    q->far[0] = spux_min(high, far);
    q->near[1] = spux_max(low, near);
    q->far[1] = far;
}

static void traverse_vector(const cgt_kd_tree *tree, leaf_tests *l, uint32_t i)
{
    packet *p = l->p;
    kd_entry stack[KD_STACK];
    const uint32_t most = tree->nodes;
    uint32_t top = 0, nodes = 0;
    cgt_kd_node n = *KD_NODES(tree, 0);
    tree_rays r;
    lane_rays test_rays;
    vfloat near, far;
    kd_rays_init(p, tree, i, &r);
    ray_box_enter(p, i, tree->low, tree->high, PLANE_REL_ERROR, &near, &far);
    if (spux_none(spux_cmpge(far, near)))
        return;
    leaf_mailbox_clear(l);
    lane_rays_of_packet(p, i, l->scale, &test_rays);
    l->counts->packets++;
    for (;;) {
        if (!cgt_kd_is_leaf(n)) {
            const uint32_t axis = cgt_kd_axis(n), first = r.reverse >> axis & 1;
            /* load both children before it is known which one is next: the loads overlap with the arithmetic below */
            const cgt_kd_node *const child = KD_NODES(tree, n.word[1]);
            const cgt_kd_node nearer = child[first], farther = child[1 - first];
            kd_parts q;
            nodes++;
            kd_split_intervals(&r, axis, cgt_kd_split(n), near, far, &q);
            if (spux_none(spux_cmpge(q.far[0], q.near[0]))) {
                near = q.near[1];
                far = q.far[1];
                n = farther;
                continue;
            }
            if (spux_any(spux_cmpge(q.far[1], q.near[1]))) {
                KD_AHEAD(farther);
                stack[KD_PLACE(top++)] = (kd_entry){q.near[1], q.far[1], farther};
            }
            near = q.near[0];
            far = q.far[0];
            n = nearer;
            continue;
        }
        if (KD_IS_BROKEN(nodes, most, top))
            return;
        l->counts->leaves++;
        if (cgt_kd_count(n))
            KD_TEST_NODE(tree, l, &test_rays, n, i);
        const vfloat best = spux_load(p->high + i);
        do {
            if (!top) {
                l->counts->nodes += nodes;
                return;
            }
            top--;
            near = stack[KD_PLACE(top)].near;
            far = spux_min(stack[KD_PLACE(top)].far, best);
        } while (spux_none(spux_cmpge(far, near)));
        n = stack[KD_PLACE(top)].node;
    }
}

/* ---- one ray ---- */

/* The children of a node that a ray passes: 1 the lower, 2 the upper, 3 both, cut at [low, high]. */
CGT_SPU_INLINE unsigned kd_ray_sides(const tree_ray *r, uint32_t axis, float split, float near, float far, float *low,
                                     float *high)
{
    const float delta = split - r->org[axis], t = delta * r->rdir[axis],
                t_error = fabsf(t) * PLANE_REL_ERROR + 0x1p-126f;
    *low = t - t_error;
    *high = t + t_error;
    if (r->flat >> axis & 1) {
        *low = -INFINITY;
        *high = INFINITY;
        return !(r->zero >> axis & 1) || delta == 0 ? 3 : delta > 0 ? 1 : 2;
    }
    const unsigned second = far < *low, first = *high < near; /* only the first; only the second */
    const unsigned sides = second ? 1 : first ? 2 : 3;
    return sides == 3 || !(r->reverse >> axis & 1) ? sides : 3 - sides;
}

static void traverse_ray(const void *of, leaf_tests *l, uint32_t i, float near, float far)
{
    const cgt_kd_tree *tree = of;
    packet *p = l->p;
    tree_ray_entry stack[CGT_KD_MAX_DEPTH];
    uint32_t top = 0, node_index = 0, nodes = 0, leaves = 0;
    tree_ray r;
    lane_rays test_rays;
    tree_ray_init(p, i, &r);
    leaf_mailbox_clear(l);
    lane_rays_of_one(p, i, l->scale, &test_rays);
    for (;;) {
        cgt_kd_node n = tree->node[node_index];
        while (!cgt_kd_is_leaf(n)) {
            const uint32_t axis = cgt_kd_axis(n), reverse = r.reverse >> axis & 1;
            float low, high;
            const unsigned sides = kd_ray_sides(&r, axis, cgt_kd_split(n), near, far, &low, &high);
            nodes++;
            node_index = n.word[1];
            if (sides == 3) {
                stack[top++] = (tree_ray_entry){low > near ? low : near, far, node_index + !reverse};
                far = high < far ? high : far;
                node_index += reverse;
            } else
                node_index += sides == 2;
            n = tree->node[node_index];
        }
        leaves++;
        if (cgt_kd_count(n))
            leaf_test_ray(l, &test_rays, cgt_kd_references(tree, &tree->node[node_index]), cgt_kd_count(n), i);
        if (!tree_ray_pop(stack, &top, p->high[i]))
            break;
        near = stack[top].near;
        far = stack[top].far;
        node_index = stack[top].node;
    }
    l->counts->nodes += nodes;
    l->counts->leaves += leaves;
}

void CGT_KERNEL(cgt_kd_trace)(const cgt_committed_scene *committed_scene, packet *p, const cgt_trace_settings *settings,
                              cgt_counts *counts)
{
    leaf_tests l;
    const cgt_kd_tree *tree = &committed_scene->papers->kd;
    leaf_tests_init(committed_scene, p, settings, counts, &l);
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        if (KD_SINGLE_RAYS && settings->kd_traversal == CGT_KD_TRAVERSAL_SINGLE)
            tree_rays_trace_single(tree, tree->low, tree->high, PLANE_REL_ERROR, &l, i, traverse_ray);
        else
            traverse_vector(tree, &l, i);
    }
}

/* ---- ropes ---- */

void CGT_KERNEL(cgt_kd_ropes_trace)(const cgt_committed_scene *committed_scene, packet *p,
                                    const cgt_trace_settings *settings, cgt_counts *counts)
{
    leaf_tests l;
    leaf_tests_init(committed_scene, p, settings, counts, &l);
    if (KD_SINGLE_RAYS && settings->kd_traversal == CGT_KD_TRAVERSAL_SINGLE) {
        for (uint32_t i = 0; i < p->lanes; i++)
            rope_trace_ray(&committed_scene->papers->kd, &l, i);
        return;
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
        rope_trace_vector(&committed_scene->papers->kd, &l, i);
}
