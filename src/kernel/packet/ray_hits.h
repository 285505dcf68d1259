/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hits to the caller's arrays. */
#ifndef CGT_RAY_HITS_H
#define CGT_RAY_HITS_H

#include "kernel/packet/ray_packet.h"

CGT_SPU_INLINE void ray_store_hits(const packet_hits *h, const ray_order *order, uint32_t first, uint32_t count,
                                   const cgt_hits *hits)
{
    const size_t stride = hits->stride ? hits->stride : sizeof(float);
    for (uint32_t k = 0; k < count; k++) {
        const size_t offset = (size_t)ray_index(order, first + k) * stride;
        if (hits->t)
            memcpy((char *)hits->t + offset, &h->t[k], sizeof(float));
        if (hits->primitive)
            memcpy((char *)hits->primitive + offset, &h->primitive[k], sizeof(uint32_t));
        if (hits->geometry)
            memcpy((char *)hits->geometry + offset, &h->geometry[k], sizeof(uint32_t));
        for (int a = 0; a < 3; a++)
            if (hits->normal[a])
                memcpy((char *)hits->normal[a] + offset, &h->normal[a][k], sizeof(float));
        if (hits->u)
            memcpy((char *)hits->u + offset, &h->u[k], sizeof(float));
        if (hits->v)
            memcpy((char *)hits->v + offset, &h->v[k], sizeof(float));
    }
}

#endif
