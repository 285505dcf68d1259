/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through a kd-tree with a stack: a vector of rays of a packet at a time, each with its own interval [near, far]
 * of t inside the node (Wald 2004; thesis, section 4.1), or one ray at a time.
 *
 * Directions of any signs may be mixed: a ray's part below and above a split is the same whatever the others do; only
 * the order in which the children are visited is common, that of most rays that go to both. A ray whose order is the
 * other one loses nothing but a chance to stop early.
 *
 * Exactness: a child is left out for a ray only where the ray surely does not pass its closed box at a t that still
 * counts. The t of a plane is (split - org) * (1 / dir), within 2^-20 of its size and 2^-126 (a difference, a reciprocal
 * within 2^-21, a product), and intervals are widened by that on both sides. A component of the direction that is 0 leaves
 * a ray on the side of its origin, on both where the origin lies in the plane; below 2^-70 of it, where reciprocals
 * leave the range, a ray counts as on both. */
#include "kd_leaf.h"
#include "ray_box.h"

#define PLANE_WIDE 0x1p-20f
#define PLANE_FLAT 0x1p-70f

/* ---- a vector of rays ---- */

typedef struct kd_rays {
    vfloat org[3], rdir[3];
    vmask reverse[3];      /* lanes that come from above */
    vmask flat[3];         /* lanes whose direction has no such component, or hardly any */
    vmask zero[3];         /* of those, the ones that have none */
    unsigned some_flat;    /* axes, as bits */
    unsigned most_reverse; /* axes along which most rays come from above */
} kd_rays;

typedef struct kd_entry {
    vfloat near, far;
    uint32_t node;
} kd_entry;

CGT_SPU_INLINE void kd_rays_make(const packet *p, uint32_t i, kd_rays *r)
{
    const vfloat zero = spux_vfloat(0);
    r->some_flat = r->most_reverse = 0;
    for (int a = 0; a < 3; a++) {
        const vfloat d = spux_load(p->dir[a] + i);
        r->org[a] = spux_load(p->org[a] + i);
        r->reverse[a] = spu_cmpgt(zero, d);
        r->flat[a] = spu_cmpgt(spux_vfloat(PLANE_FLAT), spux_abs(d));
        r->zero[a] = spu_cmpeq(d, zero);
        r->rdir[a] = spux_div(spux_vfloat(1), spux_select(d, spux_vfloat(1), r->flat[a]));
        r->some_flat |= (unsigned)spux_any(r->flat[a]) << a;
        r->most_reverse |= (unsigned)(spux_count_bits(spux_mask_bits(r->reverse[a])) > CGT_LANES / 2) << a;
    }
}

/* When the rays cross a split, widened. */
CGT_SPU_INLINE void kd_plane_times(const kd_rays *r, uint32_t axis, float split, vfloat *low, vfloat *high)
{
    const vfloat delta = spu_sub(spux_vfloat(split), r->org[axis]), t = spu_mul(delta, r->rdir[axis]);
    const vfloat wide = spu_madd(spux_abs(t), spux_vfloat(PLANE_WIDE), spux_vfloat(0x1p-126f));
    *low = spu_sub(t, wide);
    *high = spu_add(t, wide);
    if (!(r->some_flat >> axis & 1))
        return;
    /* below the plane for ever, or above, or both; `reverse` is false where there is no component */
    const vfloat zero = spux_vfloat(0), never = spux_vfloat(INFINITY), ever = spux_vfloat(-INFINITY);
    const vmask below = spu_and(r->zero[axis], spu_cmpgt(delta, zero));
    const vmask above = spu_and(r->zero[axis], spu_cmpgt(zero, delta));
    *low = spux_select(*low, spux_select(ever, never, below), r->flat[axis]);
    *high = spux_select(*high, spux_select(never, ever, above), r->flat[axis]);
}

/* The rays' parts on either side of a split. */
typedef struct kd_parts {
    vfloat near[2], far[2]; /* below, above */
    unsigned some[2];       /* lanes, as bits */
} kd_parts;

CGT_SPU_INLINE void kd_cut(const kd_rays *r, uint32_t axis, vfloat low, vfloat high, vfloat near, vfloat far,
                           kd_parts *q)
{
    const vfloat first_far = spux_min(high, far), second_near = spux_max(low, near);
    const vmask reverse = r->reverse[axis];
    q->near[0] = spux_select(near, second_near, reverse);
    q->far[0] = spux_select(first_far, far, reverse);
    q->near[1] = spux_select(second_near, near, reverse);
    q->far[1] = spux_select(far, first_far, reverse);
    for (int side = 0; side < 2; side++)
        q->some[side] = spux_mask_bits(spux_cmpge(q->far[side], q->near[side]));
}

/* The rays' intervals in the box of the root. Rays that take no part get an empty one. */
CGT_SPU_INLINE void kd_enter(const packet *p, const cgt_kd_tree *tree, uint32_t i, vfloat *near, vfloat *far)
{
    vmask outside = spux_mask_none();
    const vfloat t_min = spux_load(p->t_min + i), t_max = spux_load(p->t_max + i), wide = spux_vfloat(PLANE_WIDE);
    /* t is rounded before it is compared with the range */
    *near = spu_sub(t_min, spu_mul(spux_abs(t_min), wide));
    *far = spu_add(t_max, spu_mul(spux_abs(t_max), wide));
    for (int a = 0; a < 3; a++)
        ray_box_slab(p, i, a, tree->low[a], tree->high[a], near, far, &outside);
    outside = spu_or(outside, spu_cmpeq(spux_load(p->high + i), spux_vfloat(-INFINITY)));
    *far = spux_select(*far, spux_vfloat(-INFINITY), outside);
    *near = spux_select(*near, spux_vfloat(INFINITY), outside);
}

static void traverse_vector(const cgt_kd_tree *tree, leaf_tests *l, uint32_t i)
{
    packet *p = l->p;
    kd_entry stack[CGT_KD_MAX_DEPTH];
    uint32_t top = 0, at = 0, nodes = 0;
    kd_rays r;
    lane_rays of_leaves;
    vfloat near, far;
    kd_rays_make(p, i, &r);
    kd_enter(p, tree, i, &near, &far);
    if (spux_none(spux_cmpge(far, near)))
        return;
    leaf_mailbox_clear(l);
    lane_rays_of_packet(p, i, l->scale, &of_leaves);
    l->counts->packets++;
    for (;;) {
        const cgt_kd_node n = tree->node[at];
        if (!cgt_kd_is_leaf(n)) {
            const uint32_t axis = cgt_kd_axis(n), lower = n.word[1];
            kd_parts q;
            vfloat low, high;
            nodes++;
            kd_plane_times(&r, axis, cgt_kd_split(n), &low, &high);
            kd_cut(&r, axis, low, high, near, far, &q);
            const uint32_t first = q.some[0] && q.some[1] ? r.most_reverse >> axis & 1 : q.some[0] == 0;
            if (q.some[0] && q.some[1])
                stack[top++] = (kd_entry){q.near[!first], q.far[!first], lower + !first};
            near = q.near[first];
            far = q.far[first];
            at = lower + first;
            continue;
        }
        l->counts->leaves++;
        if (cgt_kd_count(n))
            leaf_test_vector(l, &of_leaves, cgt_kd_references(tree, &tree->node[at]), cgt_kd_count(n), i);
        const vfloat best = spux_load(p->high + i);
        do {
            if (!top) {
                l->counts->nodes += nodes;
                return;
            }
            top--;
            near = stack[top].near;
            far = spux_min(stack[top].far, best);
        } while (spux_none(spux_cmpge(far, near)));
        at = stack[top].node;
    }
}

/* ---- one ray ---- */

typedef struct kd_ray {
    float org[3], rdir[3];
    unsigned reverse; /* axes, as bits */
    unsigned flat, zero;
} kd_ray;

typedef struct kd_ray_entry {
    float near, far;
    uint32_t node;
} kd_ray_entry;

CGT_SPU_INLINE void kd_ray_make(const packet *p, uint32_t i, kd_ray *r)
{
    r->reverse = r->flat = r->zero = 0;
    for (int a = 0; a < 3; a++) {
        const float d = p->dir[a][i];
        const bool flat = fabsf(d) < PLANE_FLAT;
        r->org[a] = p->org[a][i];
        r->rdir[a] = flat ? 0 : 1 / d;
        r->reverse |= (unsigned)(d < 0) << a;
        r->flat |= (unsigned)flat << a;
        r->zero |= (unsigned)(d == 0) << a;
    }
}

/* The children of a node that a ray passes: 1 the lower, 2 the upper, 3 both, cut at [low, high]. */
CGT_SPU_INLINE unsigned kd_ray_sides(const kd_ray *r, uint32_t axis, float split, float near, float far, float *low,
                                     float *high)
{
    const float delta = split - r->org[axis], t = delta * r->rdir[axis], wide = fabsf(t) * PLANE_WIDE + 0x1p-126f;
    *low = t - wide;
    *high = t + wide;
    if (r->flat >> axis & 1) {
        *low = -INFINITY;
        *high = INFINITY;
        return !(r->zero >> axis & 1) || delta == 0 ? 3 : delta > 0 ? 1 : 2;
    }
    const unsigned second = far < *low, first = *high < near; /* only the first; only the second */
    const unsigned sides = second ? 1 : first ? 2 : 3;
    return sides == 3 || !(r->reverse >> axis & 1) ? sides : 3 - sides;
}

static void traverse_ray(const cgt_kd_tree *tree, leaf_tests *l, uint32_t i, float near, float far)
{
    packet *p = l->p;
    kd_ray_entry stack[CGT_KD_MAX_DEPTH];
    uint32_t top = 0, at = 0, nodes = 0, leaves = 0;
    kd_ray r;
    lane_rays of_leaves;
    kd_ray_make(p, i, &r);
    leaf_mailbox_clear(l);
    lane_rays_of_one(p, i, l->scale, &of_leaves);
    for (;;) {
        cgt_kd_node n = tree->node[at];
        while (!cgt_kd_is_leaf(n)) {
            const uint32_t axis = cgt_kd_axis(n), reverse = r.reverse >> axis & 1;
            float low, high;
            const unsigned sides = kd_ray_sides(&r, axis, cgt_kd_split(n), near, far, &low, &high);
            nodes++;
            at = n.word[1];
            if (sides == 3) {
                stack[top++] = (kd_ray_entry){low > near ? low : near, far, at + !reverse};
                far = high < far ? high : far;
                at += reverse;
            } else
                at += sides == 2;
            n = tree->node[at];
        }
        leaves++;
        if (cgt_kd_count(n))
            leaf_test_ray(l, &of_leaves, cgt_kd_references(tree, &tree->node[at]), cgt_kd_count(n), i);
        do {
            if (!top) {
                l->counts->nodes += nodes;
                l->counts->leaves += leaves;
                return;
            }
            top--;
            near = stack[top].near;
        } while (p->high[i] < near);
        far = stack[top].far;
        at = stack[top].node;
    }
}

static void traverse_rays(const cgt_kd_tree *tree, leaf_tests *l, uint32_t i)
{
    _Alignas(64) float near[CGT_LANES], far[CGT_LANES];
    vfloat first, last;
    kd_enter(l->p, tree, i, &first, &last);
    spux_store(near, first);
    spux_store(far, last);
    for (unsigned left = spux_mask_bits(spux_cmpge(last, first)); left; left &= left - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(left);
        l->counts->packets++;
        if (l->p->high[i + k] >= near[k]) /* a neighbour's test may have closed it */
            traverse_ray(tree, l, i + k, near[k], far[k]);
    }
}

void CGT_KERNEL(cgt_kd_trace)(const cgt_world *world, packet *p, const cgt_trace_settings *settings, cgt_counts *counts)
{
    leaf_tests l;
    leaf_tests_make(world, p, settings, counts, &l);
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        if (settings->kd_traversal == CGT_KD_TRAVERSAL_SINGLE)
            traverse_rays(&world->kd, &l, i);
        else
            traverse_vector(&world->kd, &l, i);
    }
}
