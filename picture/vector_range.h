/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vectors whose squares leave the range of float: a lamp 1e20 away, normals of tiny triangles. */
#ifndef PICTURE_VECTOR_RANGE_H
#define PICTURE_VECTOR_RANGE_H

#include <math.h>

static inline float picture_square(const float v[3]) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/* Brings a vector near 1 by a power of two, if need be. Returns how many powers were taken out of it; what is not
 * finite stays. */
static inline int picture_bring_near(float v[3])
{
    const float square = picture_square(v);
    int exponent = 0;
    if ((square > 0x1p-80f && square < 0x1p120f) || isnan(square))
        return 0;
    const float largest = fmaxf(fabsf(v[0]), fmaxf(fabsf(v[1]), fabsf(v[2])));
    if (largest > 0.0f && isfinite(largest))
        frexpf(largest, &exponent);
    for (int c = 0; c < 3 && exponent; c++)
        v[c] = ldexpf(v[c], -exponent);
    return exponent;
}

#endif
