/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Turned slabs. A bundle of long capsules that lean to the axes fills its box by a small part; boxes of its parts
 * overlap, and a ray passes most of them. Two slabs more, along directions u across the bundle, cut the box to what the
 * bundle fills: the box remains to bound it lengthwise. They cull; leaves and hits are the same with them and without.
 *
 * For a ray of bvh_ray.h, with O = u.o, D = u.d and planes p of a slab, t = (p - O) / D, and planes are moved outwards
 * by
 *   E = 2^-18 M + 2^-85,   M the largest |o| + P of the axes
 * Components of u are at most 1 and their 1-norm N is at most 1.75. With e = 2^-24:
 *   O is off by 4 e N |o|, and by N (e / 2 |o| + 2^-90) where the origin was moved: 8 e M
 *   D is off by 8 e N: components of d are below 2; and by 2^-59 where it was enlarged. A ray that counts is inside the
 *   root's box at t, and a component of d is 1 at least, so |t| <= M: 14 e M + 2^-59 M
 *   t loses 3 e of itself, or 3 e (|p| + |O|) as a place, where |p| and |O| are at most N M: 11 e M
 * together 33 e M, of which 64 e M are taken. The planes lie outside of what they bound (builders/bvh/bvh_turn.h). */
#ifndef CGT_BVH_TURNED_H
#define CGT_BVH_TURNED_H

#include "kernel/bvh/bvh_ray.h"

/* A vector of rays, or one, in the slabs of a node. */
typedef struct bvh_turned_rays {
    vfloat at[2], rdir[2], pad[2]; /* O, 1 / D, E / |D| */
} bvh_turned_rays;

CGT_SPU_INLINE const bvh_turned *bvh_find_turned(const bvh_call *c, const bvh_node *n)
{
    return (const bvh_turned *)c->tree->turned + (n - (const bvh_node *)c->tree->node);
}

CGT_SPU_INLINE void bvh_turned_rays_init(const bvh_call *c, const bvh_turned *n, const vfloat org[3],
                                         const vfloat dir[3], bvh_turned_rays *r)
{
    const vfloat least = spux_vfloat(BVH_MIN_DIR), minus = spux_vfloat(-0.f);
    vfloat most = spux_vfloat(0);
    for (int a = 0; a < 3; a++)
        most = spux_max(most, spu_add(spux_abs(org[a]), spux_vfloat(c->max_plane[a])));
    const vfloat error = spu_madd(most, spux_vfloat(0x1p-18f * BVH_ERROR_SCALE), spux_vfloat(0x1p-85f));
    for (int k = 0; k < 2; k++) {
        const float *u = n->across[k];
        const vfloat x = spux_vfloat(u[0]), y = spux_vfloat(u[1]), z = spux_vfloat(u[2]);
        const vfloat d = spu_madd(x, dir[0], spu_madd(y, dir[1], spu_mul(z, dir[2])));
        const vfloat enlarged = spu_or(spu_and(d, minus), least);
        r->at[k] = spu_madd(x, org[0], spu_madd(y, org[1], spu_mul(z, org[2])));
        r->rdir[k] = spux_div(spux_vfloat(1), spux_select(d, enlarged, spu_cmpgt(least, spux_abs(d))));
        r->pad[k] = spu_mul(error, spux_abs(r->rdir[k]));
    }
}

/* Clips ranges of t to a slab, with planes low and high in each lane. */
CGT_SPU_INLINE void bvh_clip_to_turned(const bvh_turned_rays *r, int k, vfloat low, vfloat high, vfloat *enter,
                                       vfloat *leave)
{
    const vfloat a = spu_mul(spu_sub(low, r->at[k]), r->rdir[k]), b = spu_mul(spu_sub(high, r->at[k]), r->rdir[k]);
    *enter = spux_max(*enter, spu_sub(spux_min(a, b), r->pad[k]));
    *leave = spux_min(*leave, spu_add(spux_max(a, b), r->pad[k]));
}

/* Clips the range of one ray to those of a node's children. Not inlined: most nodes have none. */
__attribute__((noinline, unused)) static void bvh_clip_ray_to_turned(const bvh_call *c, const bvh_node *node,
                                                                     const float org[3], const float dir[3],
                                                                     vfloat *enter, vfloat *leave)
{
    const bvh_turned *n = bvh_find_turned(c, node);
    vfloat o[3], d[3];
    bvh_turned_rays r;
    for (int a = 0; a < 3; a++) {
        o[a] = spux_vfloat(org[a]);
        d[a] = spux_vfloat(dir[a]);
    }
    bvh_turned_rays_init(c, n, o, d, &r);
    for (int k = 0; k < 2; k++)
        bvh_clip_to_turned(&r, k, spux_load(n->low[k]), spux_load(n->high[k]), enter, leave);
}

#endif
