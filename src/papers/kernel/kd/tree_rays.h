/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays on their way through trees whose nodes are cut by planes: kd-trees, and bounding interval hierarchies. A vector
 * of rays of any signs, in which most rays choose the order of the children; or one ray after the other, with a stack
 * of the parts of it that wait. The trees differ in what they add to the error of a plane's t. */
#ifndef CGT_TREE_RAYS_H
#define CGT_TREE_RAYS_H

#include "papers/kernel/kd/kd_leaf.h"
#include "kernel/packet/ray_box.h"

#define TREE_MIN_DIR 0x1p-70f /* below it a component of the direction has no reciprocal, or none of use */

/* ---- a vector of rays ---- */

typedef struct tree_rays {
    vfloat org[3], rdir[3];
    vfloat first[3], last[3]; /* -org * rdir, less and more the error of a plane's t */
    vmask opposite[3];        /* lanes that reach the children of a split in the other order than most do */
    vmask flat[3];            /* lanes whose direction has no such component, or hardly any */
    vmask zero[3];            /* of those, the ones that have none */
    uint32_t mixed;           /* axes for which any lane is one of these, as bits */
    uint32_t reverse;         /* axes along which most rays start above */
} tree_rays;

/* All but first and last. */
CGT_SPU_INLINE void tree_rays_init(const packet *p, uint32_t i, tree_rays *r)
{
    const vfloat zero = spux_vfloat(0);
    r->mixed = r->reverse = 0;
    for (int a = 0; a < 3; a++) {
        const vfloat d = spux_load(p->dir[a] + i);
        const vmask above = spu_cmpgt(zero, d);
        const bool most = spux_count_bits(spux_mask_bits(above)) > CGT_LANES / 2;
        r->org[a] = spux_load(p->org[a] + i);
        r->flat[a] = spu_cmpgt(spux_vfloat(TREE_MIN_DIR), spux_abs(d));
        r->zero[a] = spu_cmpeq(d, zero);
        r->rdir[a] = spux_div(spux_vfloat(1), spux_select(d, spux_vfloat(1), r->flat[a]));
        r->opposite[a] = most ? spux_not(above) : above;
        r->mixed |= (uint32_t)spux_any(spu_or(r->opposite[a], r->flat[a])) << a;
        r->reverse |= (uint32_t)most << a;
    }
}

/* first and last of an axis; t: org * rdir. */
CGT_SPU_INLINE void tree_rays_widen(tree_rays *r, int a, vfloat t, vfloat t_error)
{
    r->first[a] = spu_sub(spu_sub(spux_vfloat(0), t_error), t);
    r->last[a] = spu_sub(t_error, t);
}

/* ---- one ray ---- */

typedef struct tree_ray {
    float org[3], rdir[3]; /* rdir: 0 where it is flat */
    uint32_t reverse;      /* axes, as bits */
    uint32_t flat, zero;
} tree_ray;

CGT_SPU_INLINE void tree_ray_init(const packet *p, uint32_t i, tree_ray *r)
{
    r->reverse = r->flat = r->zero = 0;
    for (int a = 0; a < 3; a++) {
        const float d = p->dir[a][i];
        const bool flat = fabsf(d) < TREE_MIN_DIR;
        r->org[a] = p->org[a][i];
        r->rdir[a] = flat ? 0 : 1 / d;
        r->reverse |= (uint32_t)(d < 0) << a;
        r->flat |= (uint32_t)flat << a;
        r->zero |= (uint32_t)(d == 0) << a;
    }
}

/* A part of a ray that waits, and the node that it passes. */
typedef struct tree_ray_entry {
    float near, far;
    uint32_t node;
} tree_ray_entry;

/* Takes the youngest part that does not begin beyond the closest hit; *top is its place afterwards. False: there is
 * none. */
CGT_SPU_INLINE bool tree_ray_pop(const tree_ray_entry *stack, uint32_t *top, float closest)
{
    while (*top)
        if (!(closest < stack[--*top].near))
            return true;
    return false;
}

/* Traces ray i of the packet, which is in the root's box from near to far. */
typedef void tree_ray_trace_fn(const void *tree, leaf_tests *l, uint32_t i, float near, float far);

/* Rays i to i + CGT_LANES - 1, each by itself where it meets the root's box. t_error: as of ray_box_enter. */
CGT_SPU_INLINE void tree_rays_trace_single(const void *tree, const float low[3], const float high[3], float t_error,
                                           leaf_tests *l, uint32_t i, tree_ray_trace_fn *trace)
{
    _Alignas(64) float near[CGT_LANES], far[CGT_LANES];
    vfloat first, last;
    ray_box_enter(l->p, i, low, high, t_error, &first, &last);
    spux_store(near, first);
    spux_store(far, last);
    for (unsigned remaining = spux_mask_bits(spux_cmpge(last, first)); remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        l->counts->packets++;
        if (l->p->high[i + k] >= near[k]) /* a neighbour's test may have closed it */
            trace(tree, l, i + k, near[k], far[k]);
    }
}

#endif
