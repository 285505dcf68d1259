/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which primitives count for the rays of a selective packet: those whose geometry's mask has a bit in common with the
 * ray's, except the one that the ray skips. Others are dropped where a candidate becomes a hit, so that all earlier
 * steps are the same for all packets. */
#ifndef CGT_RAY_MASK_H
#define CGT_RAY_MASK_H

#include "kernel/packet/packet.h"

/* The mask of a primitive's geometry, where it matters. */
CGT_SPU_INLINE uint32_t skip_mask_of(const cgt_primitives *prims, const packet *p, uint32_t prim)
{
    return p->has_masks ? cgt_primitives_array(prims, prim)->mask : UINT32_MAX;
}

/* Whether the primitive, of that mask, does not count for ray i. */
CGT_SPU_INLINE bool ray_skips(const packet *p, uint32_t i, uint32_t prim, uint32_t mask)
{
    return p->skip_prim[i] == prim || !(p->mask[i] & mask);
}

/* The same of rays i to i + CGT_LANES - 1. */
CGT_SPU_INLINE vmask rays_skipping(const packet *p, uint32_t i, vuint prim, vuint mask)
{
    const vmask no_bit = spu_cmpeq(spu_and(spux_load_uint(p->mask + i), mask), spux_vuint(0));
    return spu_or(no_bit, spu_cmpeq(spux_load_uint(p->skip_prim + i), prim));
}

/* The same, where the primitive's mask is not known yet. */
CGT_SPU_INLINE vmask rays_skipping_one(const cgt_primitives *prims, const packet *p, uint32_t i, uint32_t prim)
{
    return rays_skipping(p, i, spux_vuint(prim), spux_vuint(skip_mask_of(prims, p, prim)));
}

#endif
