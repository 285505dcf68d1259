/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cells along a Morton curve: a box of 2^n cells along each axis, halved along its longest edge again and again, each
 * time for one bit of the cell's number. */
#ifndef CGT_MORTON_CURVE_H
#define CGT_MORTON_CURVE_H

#include <stdint.h>

#define CGT_MORTON_BITS 24u /* of a cell's number, at most */

/* Bits of a cell's coordinate along an axis that move to the cell's number together. */
typedef struct cgt_morton_bits {
    uint32_t axis, mask, shift;
} cgt_morton_bits;

typedef struct cgt_morton_curve {
    float low[3], rcell[3], last[3]; /* corner, cells per unit, the last cell's coordinate */
    uint32_t bits, runs;
    cgt_morton_bits run[CGT_MORTON_BITS];
} cgt_morton_curve;

/* Lays about 2^bits cells between low and high; fewer where nothing is left to halve. */
void cgt_morton_curve_init(const float low[3], const float high[3], uint32_t bits, cgt_morton_curve *curve);

#endif
