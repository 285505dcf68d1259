/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sums rounded to nearest, ties to even, from an SPU's floats, which truncate. Its doubles would do, too, but block the
 * pipelines for seven cycles each.
 *
 * With |a| >= |b|, s = trunc(a + b), r = a + b - s, h half a unit of s in its last place: the sum rounded to nearest is
 * s, or the next float away from zero where r is beyond h, or where r = h and s is odd. Signs apart:
 *
 *   z = s - a is exact (Fast2Sum, for any faithful rounding), and r = b - z.
 *   d = b - (z + h) has the sign of r - h:
 *     - a and b of one sign: s has a's unit g or 2 g. If g, z <= b < 2^23 g and h = g / 2; if 2 g, z <= b < 2^24 g, a
 *       multiple of g as h = g is. Either way z + h is a float, at most 2^24 units.
 *     - of opposite signs, |b| >= |a| / 2: s is exact (Sterbenz), z = b, and z + h, even truncated, lies on s's side
 *       of b: d has not the sign of s.
 *     - else s has a's unit g or g / 2. If g, |z + h| < 2^23 g. If g / 2, h = g / 4: z + h is a float up to 2^22 g;
 *       beyond it b has at least 2^22 g, or the float before it, and so is a multiple of g / 2, or of g / 4 with z + h
 *       <= 2^22 g; a multiple of g / 2 makes r = 0, z = b, as above.
 *   The last difference is truncated, which keeps its sign, unless it underflows.
 *
 * That takes b or z + h below 2^-102, for a float's unit of them to be below 2^-126. With |a| at least 2^-70, or 0, h
 * is at least 2^-96 unless s is exact. Who calls sees to that. tests/cell/ppe/test_cell_nearest.c compares with
 * doubles. */
#ifndef GRID_NEAREST_H
#define GRID_NEAREST_H

#include "vector.h"

#define GRID_NEAREST_LEAST 0x1p-70f /* operands are 0 or at least that */

CGT_SPU_INLINE vec_float4 grid_add_nearest(vec_float4 x, vec_float4 y)
{
    const vec_float4 zero = spu_splats(0.f);
    const vec_uint4 swap = spu_cmpabsgt(y, x);
    const vec_float4 a = spu_sel(x, y, swap), b = spu_sel(y, x, swap);
    const vec_float4 sum = spu_add(a, b);
    const vec_uint4 bits = (vec_uint4)sum;
    const vec_float4 h = spu_mul((vec_float4)spu_and(bits, 0xff800000u), spu_splats(0x1p-24f));
    const vec_float4 d = spu_sub(b, spu_add(spu_sub(sum, a), h));
    const vec_float4 beyond = (vec_float4)spu_xor((vec_uint4)d, spu_and(bits, 0x80000000u));
    const vec_uint4 tie = spu_and(spu_cmpeq(d, zero), bits), up = spu_or(spu_cmpgt(beyond, zero), tie);
    return (vec_float4)spu_add(bits, spu_and(up, 1));
}

#endif
