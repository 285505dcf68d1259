/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Products of vectors of three components, a lane each. */
#ifndef VECTOR_MATH_H
#define VECTOR_MATH_H

#include "vector.h"

CGT_SPU_INLINE vfloat vector_dot(const vfloat p[3], const vfloat q[3])
{
    return spu_madd(p[0], q[0], spu_madd(p[1], q[1], spu_mul(p[2], q[2])));
}

CGT_SPU_INLINE void vector_cross(const vfloat p[3], const vfloat q[3], vfloat cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        cross[a] = spu_msub(p[b], q[c], spu_mul(p[c], q[b]));
    }
}

#endif
