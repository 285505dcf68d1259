/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which primitives are valid: whether a triangle has an area, decided exactly. */
#include "exact/valid_primitive.h"

#include "exact/integer/exact.h"
#include "exact/triangle_double.h"

/* Products of two differences of floats, rounded three times each, and their difference: 4 roundings. */
#define AREA_ERROR (5 * CGT_DOUBLE_U)

bool cgt_triangle_has_area(const cgt_triangle *q)
{
    double e1[3], e2[3], normal[3];
    for (int k = 0; k < 3; k++) {
        e1[k] = (double)q->v[1][k] - (double)q->v[0][k];
        e2[k] = (double)q->v[2][k] - (double)q->v[0][k];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const double a = e1[i] * e2[j], b = e1[j] * e2[i];
        if (fabs(a - b) > AREA_ERROR * (fabs(a) + fabs(b)))
            return true;
    }
    cgt_exact_normal(q, normal);
    return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
}
