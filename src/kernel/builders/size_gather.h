/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Gathers size classes of vectors of primitives: each class keeps a vector of every bound, which is narrowed to one
 * number at the end. */
#ifndef CGT_SIZE_GATHER_H
#define CGT_SIZE_GATHER_H

#include <math.h>

#include "dispatch/kernel.h"
#include "vector.h"

#define SIZE_GATHER_LIST 8u

/* Middles and half extents of boxes. The middle is rounded; what is measured from there holds all the same. Where a
 * difference is rounded, it is above 2^-125, and 2^-22 of it covers that. */
CGT_SPU_INLINE void center_and_half(const vfloat low[3], const vfloat high[3], vfloat middle[3], vfloat half[3])
{
    for (int a = 0; a < 3; a++) {
        middle[a] = spu_add(spu_mul(low[a], spux_vfloat(0.5f)), spu_mul(high[a], spux_vfloat(0.5f)));
        const vfloat most = spux_max(spu_sub(high[a], middle[a]), spu_sub(middle[a], low[a]));
        half[a] = spux_abs(spu_mul(most, spux_vfloat(1 + 0x1p-22f)));
    }
}

typedef struct size_gather {
    uint32_t used_classes[CGT_SIZE_CLASSES / 32];
    uint32_t list[SIZE_GATHER_LIST]; /* the first classes that came */
    uint32_t list_length;
    uint32_t count[CGT_SIZE_CLASSES]; /* this and the next only where used */
    vfloat low[CGT_SIZE_CLASSES][3], high[CGT_SIZE_CLASSES][3], half[CGT_SIZE_CLASSES][3];
} size_gather;

CGT_SPU_INLINE void size_gather_clear(size_gather *g)
{
    memset(g->used_classes, 0, sizeof g->used_classes);
    g->list_length = 0;
}

static void size_gather_open_class(size_gather *g, uint32_t k)
{
    if (g->used_classes[k / 32] >> k % 32 & 1)
        return;
    g->used_classes[k / 32] |= UINT32_C(1) << k % 32;
    g->count[k] = 0;
    for (int a = 0; a < 3; a++) {
        g->low[k][a] = spux_vfloat(INFINITY);
        g->high[k][a] = spux_vfloat(-INFINITY);
        g->half[k][a] = spux_vfloat(0);
    }
    if (g->list_length < SIZE_GATHER_LIST)
        g->list[g->list_length++] = k;
}

/* Adds the lanes of a mask to class k; returns them as bits. axes: 1 where all halves are alike. */
CGT_SPU_INLINE unsigned size_gather_class(size_gather *g, uint32_t k, const vfloat middle[3], const vfloat half[],
                                          int axes, vmask in)
{
    const unsigned bits = spux_mask_bits(in);
    g->count[k] += spux_count_bits(bits);
    for (int a = 0; a < 3; a++) {
        g->low[k][a] = spux_select(g->low[k][a], spux_min(g->low[k][a], middle[a]), in);
        g->high[k][a] = spux_select(g->high[k][a], spux_max(g->high[k][a], middle[a]), in);
    }
    for (int a = 0; a < axes; a++)
        g->half[k][a] = spux_select(g->half[k][a], spux_max(g->half[k][a], half[a]), in);
    return bits;
}

/* Adds the lanes of a mask; half is not negative, not even -0; size is the largest of half. The listed classes are
 * tried in the order of the list: where the next one lies must not depend on the vector, or memory waits for it. */
CGT_SPU_INLINE void size_gather_add(size_gather *g, const vfloat middle[3], const vfloat half[], int axes, vfloat size,
                                    vmask valid)
{
    const vuint exponent = spu_sr((vuint)size, 23);
    unsigned remaining = spux_mask_bits(valid);
    for (uint32_t i = 0; i < g->list_length && remaining; i++) {
        const vmask in = spu_and(valid, spu_cmpeq(exponent, spux_vuint(g->list[i])));
        if (spux_any(in))
            remaining &= ~size_gather_class(g, g->list[i], middle, half, axes, in);
    }
    if (!remaining)
        return;
    _Alignas(CGT_VECTOR_BYTES) uint32_t class[CGT_LANES];
    spux_store_uint(class, exponent);
    while (remaining) {
        const uint32_t k = class[__builtin_ctz(remaining)];
        size_gather_open_class(g, k);
        remaining &= ~size_gather_class(g, k, middle, half, axes, spu_and(valid, spu_cmpeq(exponent, spux_vuint(k))));
    }
}

/* Adds what was gathered to classes that may have some already. */
static void size_gather_store(const size_gather *g, int axes, cgt_size_classes *to)
{
    for (uint32_t word = 0; word < CGT_SIZE_CLASSES / 32; word++)
        for (uint32_t remaining = g->used_classes[word]; remaining; remaining &= remaining - 1) {
            const uint32_t k = 32 * word + (uint32_t)__builtin_ctz(remaining);
            cgt_size_class c = {.count = g->count[k]};
            for (int a = 0; a < 3; a++) {
                c.low[a] = spux_hmin(g->low[k][a]);
                c.high[a] = spux_hmax(g->high[k][a]);
                c.half[a] = spux_hmax(g->half[k][axes == 1 ? 0 : a]);
            }
            cgt_size_classes_add(to, k, &c);
        }
}

#endif
