/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vectors of three components, one in each lane. */
#ifndef CGT_LANE_VECTORS_H
#define CGT_LANE_VECTORS_H

#include "vector.h"

CGT_SPU_INLINE vfloat lane_dot(const vfloat p[3], const vfloat q[3])
{
    return spu_madd(p[0], q[0], spu_madd(p[1], q[1], spu_mul(p[2], q[2])));
}

CGT_SPU_INLINE void lane_cross(const vfloat p[3], const vfloat q[3], vfloat cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        cross[a] = spu_msub(p[b], q[c], spu_mul(p[c], q[b]));
    }
}

/* The same from single operations, in one order: the same bits in every variant. */
CGT_SPU_INLINE vfloat lane_dot_unfused(const vfloat p[3], const vfloat q[3])
{
    return spu_add(spu_add(spu_mul(p[0], q[0]), spu_mul(p[1], q[1])), spu_mul(p[2], q[2]));
}

CGT_SPU_INLINE void lane_cross_unfused(const vfloat p[3], const vfloat q[3], vfloat cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        cross[a] = spu_sub(spu_mul(p[b], q[c]), spu_mul(p[c], q[b]));
    }
}

/* The 1-norm. */
CGT_SPU_INLINE vfloat lane_sum(const vfloat v[3])
{
    return spu_add(spux_abs(v[0]), spu_add(spux_abs(v[1]), spux_abs(v[2])));
}

/* The powers of two whose multiples from 1 to below 2 these positive numbers are; 0 for denormals. */
CGT_SPU_INLINE vfloat lane_power(vfloat x) { return (vfloat)spu_and((vuint)x, spux_vuint(0x7f800000)); }

/* 1 over them, 2^127 for 0: the exponents of both add up to twice the bias. */
CGT_SPU_INLINE vfloat lane_inverse_power(vfloat power) { return (vfloat)spu_sub(spux_vuint(0x7f000000), (vuint)power); }

#endif
