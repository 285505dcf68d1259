/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Crossings of the moved line (exact/crossing.h): the sign of a polynomial in the shift is that of its first term that
 * is not 0. */
#include "exact/integer/exact_terms.h"

/* The sign of e.x, e the shift. */
static int sign_along_shift(const cgt_exact_three *x)
{
    for (int a = 0; a < 3; a++)
        if (x->of[a].sign)
            return x->of[a].sign;
    return 0;
}

int cgt_exact_crossing(const cgt_exact_ray *ray, const cgt_triangle *triangle)
{
    cgt_exact_three edge, shift;
    int sides = 0;
    cgt_exact_edge_terms(ray, triangle, &edge);
    for (int k = 0; k < 3; k++) {
        int side = edge.of[k].sign;
        if (!side) {
            cgt_exact_shift_terms(ray, triangle->v[(k + 1) % 3], triangle->v[(k + 2) % 3], &shift);
            side = sign_along_shift(&shift);
        }
        sides += side;
    }
    return sides / 3;
}

int cgt_exact_crossing_t_sign(const cgt_exact_ray *ray, const cgt_triangle *triangle)
{
    cgt_exact_plane plane;
    cgt_exact_three normal;
    cgt_exact_plane_terms(ray, triangle, &plane);
    int number = plane.number.sign;
    if (!number) {
        cgt_exact_normal_terms(triangle, &normal);
        number = -sign_along_shift(&normal);
    }
    return number * plane.determinant.sign;
}

void cgt_exact_sphere_signs(const cgt_exact_ray *ray, cgt_sphere sphere, int *middle, int *product)
{
    cgt_exact_quadratic quadratic;
    cgt_exact_sphere_terms(ray, sphere, &quadratic);
    *middle = quadratic.middle.sign;
    *product = quadratic.product.sign;
}
