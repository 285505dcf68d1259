/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a tile of points against a light still waits for, as a table: the rectangle of its groups' slopes (offsets, for
 * parallel rays) in 8x8 parts, each with the farthest end of the groups that overlap it and have rays without a hit. A
 * primitive whose parts are all nearer to the light than it is occludes nothing new: the idea of hierarchical depth
 * buffers (Greene and others 1993), as the camera's tiles have it.
 *
 * Conservative, whatever the arithmetic: the part of a slope is found by operations that are all monotonic (a
 * difference, a product with a factor above 0, clamping, truncation), the same for groups and windows. Where the range
 * of a group and a window overlap, they have a slope in common, and its part lies between the parts of both ends of
 * either. So the window sees the group's end in it. A group is compared with a window's end as it would be alone
 * (light_overlapping_groups). Groups lose rays until the table is made again, which only makes its ends too far. */
#ifndef CGT_LIGHT_TABLE_H
#define CGT_LIGHT_TABLE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "vector.h"

#define LIGHT_PARTS 8u /* along each axis */

typedef struct light_table {
    _Alignas(64) float far[LIGHT_PARTS * LIGHT_PARTS]; /* -infinity: no group */
    float lower[2], scale[2];                          /* part = (slope - lower) scale */
    bool is_set;
} light_table;

/* The part of slopes along an axis, as floats from 0 to 7. NaN may give any of them. */
CGT_SPU_INLINE vfloat light_table_part(const light_table *t, int a, vfloat slope)
{
    const vfloat part = spu_mul(spu_sub(slope, spux_vfloat(t->lower[a])), spux_vfloat(t->scale[a]));
    return spux_min(spux_max(part, spux_vfloat(0)), spux_vfloat(LIGHT_PARTS - 1));
}

/* The ends of the parts in a row, times LIGHT_PARTS, and a column. */
CGT_SPU_INLINE vfloat light_table_far(const light_table *t, vuint row, vuint column)
{
    const vuint part = spu_or(row, column);
#if CGT_LANES == 16 /* four vectors, by the two bits of a part beyond a lane's number: half of what a gather takes */
    const vmask second = spu_cmpeq(spu_and(row, spux_vuint(16)), spux_vuint(16)),
                third = spu_cmpeq(spu_and(row, spux_vuint(32)), spux_vuint(32));
    const vfloat low =
        spux_select(spux_permute(spux_load(t->far), part), spux_permute(spux_load(t->far + 16), part), second);
    const vfloat high =
        spux_select(spux_permute(spux_load(t->far + 32), part), spux_permute(spux_load(t->far + 48), part), second);
    return spux_select(low, high, third);
#else
    return spux_gather(t->far, (vint)part);
#endif
}

/* The lanes whose windows see no group whose end is at `end` or beyond. A window of more than two parts along an axis
 * is not looked up, and one with a NaN is never hidden. */
CGT_SPU_INLINE vmask light_table_hides(const light_table *t, const vfloat low[2], const vfloat high[2], vfloat end)
{
    const vuint last = spux_vuint(LIGHT_PARTS - 1), one = spux_vuint(1);
    vuint first[2], second[2];
    vmask large = spux_mask_none();
    for (int a = 0; a < 2; a++) {
        first[a] = spu_and((vuint)spux_truncate(light_table_part(t, a, low[a])), last);
        second[a] = spu_and((vuint)spux_truncate(light_table_part(t, a, high[a])), last);
        large = spu_or(large, spu_cmpgt(second[a], spu_add(first[a], one)));
        large = spu_or(large, spux_not(spux_cmpge(high[a], low[a])));
    }
    const vuint top = spu_sl(first[1], 3), bottom = spu_sl(second[1], 3);
    const vfloat above = spux_max(light_table_far(t, top, first[0]), light_table_far(t, top, second[0]));
    const vfloat below = spux_max(light_table_far(t, bottom, first[0]), light_table_far(t, bottom, second[0]));
    return spu_andc(spu_cmpgt(end, spux_max(above, below)), large);
}

/* Makes the table of up to 64 groups, those with a bit of `open`: their ranges low to high, and ends. lower, upper:
 * over all of them. There is none where the rectangle has no area. */
__attribute__((unused)) static void light_table_make(light_table *t, const float lower[2], const float upper[2],
                                                     const float *const low[2], const float *const high[2],
                                                     const float *end, uint64_t open)
{
    _Alignas(64) uint32_t first[2][64], last[2][64];
    t->is_set = true;
    for (int a = 0; a < 2; a++) {
        const float length = upper[a] - lower[a];
        t->is_set = t->is_set && length > 0x1p-60f && length < 0x1p60f;
        t->lower[a] = lower[a];
        t->scale[a] = t->is_set ? LIGHT_PARTS / length : 0;
        for (uint32_t g = 0; g < 64 && t->is_set; g += CGT_LANES) {
            spux_store_uint(first[a] + g, (vuint)spux_truncate(light_table_part(t, a, spux_load(low[a] + g))));
            spux_store_uint(last[a] + g, (vuint)spux_truncate(light_table_part(t, a, spux_load(high[a] + g))));
        }
    }
    for (uint32_t i = 0; i < LIGHT_PARTS * LIGHT_PARTS; i += CGT_LANES)
        spux_store(t->far + i, spux_vfloat(-INFINITY));
    for (; open && t->is_set; open &= open - 1) {
        const uint32_t g = (uint32_t)__builtin_ctzll(open);
        for (uint32_t y = first[1][g]; y <= last[1][g]; y++)
            for (uint32_t x = first[0][g]; x <= last[0][g]; x++) {
                float *far = &t->far[y * LIGHT_PARTS + x];
                *far = *far > end[g] ? *far : end[g];
            }
    }
}

#endif
