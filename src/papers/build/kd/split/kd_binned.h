/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bins of a node: what starts and what ends in each, along all three axes. */
#ifndef CGT_KD_BINNED_H
#define CGT_KD_BINNED_H

#include "papers/build/kd/split/kd_builder.h"

#define CGT_KD_BINS 16

/* Vectors hold the three axes; the fourth element is undefined. Weights instead of counts: sums of few numbers, exact
 * in float or nearly so; only the choice depends on them. */
typedef struct cgt_kd_bins {
    cgt_float4 start[CGT_KD_BINS], end[CGT_KD_BINS];
    cgt_float4 low, high; /* of the items */
    cgt_float4 base, scale;
    uint32_t count; /* of bins */
} cgt_kd_bins;

float cgt_kd_bound_items(const cgt_kd_item *item, uint32_t count, cgt_float4 *low, cgt_float4 *high);
void cgt_kd_plan_bins(cgt_kd_bins *b, cgt_float4 low, cgt_float4 high, uint32_t count);
void cgt_kd_fill_bins(cgt_kd_bins *b, const cgt_kd_item *item, uint32_t count);
cgt_kd_plane cgt_kd_choose_binned(const cgt_kd_rules *rules, const cgt_kd_bins *b, const cgt_kd_box *box, float weight);

#endif
