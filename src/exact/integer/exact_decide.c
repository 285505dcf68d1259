/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hit or miss, and which of two hits comes first: signs of whole numbers. */
#include "exact/integer/exact_terms.h"

#include <string.h>

bool cgt_exact_line_hits_triangle(const cgt_exact_ray *ray, const cgt_triangle *triangle)
{
    cgt_exact_three edge;
    cgt_exact_edge_terms(ray, triangle, &edge);
    bool above = false, below = false;
    for (int k = 0; k < 3; k++) {
        above |= edge.of[k].sign > 0;
        below |= edge.of[k].sign < 0;
    }
    return above != below; /* of one sign or zero; all zero is a line in the plane, or no area */
}

int cgt_exact_sphere_roots(const cgt_exact_ray *ray, cgt_sphere sphere)
{
    cgt_exact_quadratic quadratic;
    cgt_exact_sphere_terms(ray, sphere, &quadratic);
    return quadratic.discriminant.sign + 1;
}

/* ---- Order ---------------------------------------------------------------------------------------------------- */

/* Brings lengths in two units to the smaller one: the first is to be shifted by *a bits, or the second by *b. */
static void common_unit(int exponent_a, int exponent_b, uint32_t *a, uint32_t *b)
{
    *a = exponent_a > exponent_b ? (uint32_t)(exponent_a - exponent_b) : 0;
    *b = exponent_b > exponent_a ? (uint32_t)(exponent_b - exponent_a) : 0;
}

/* The sign of x + s, x at most of degree 5, where s has the given sign and the square s2. */
__attribute__((noinline)) static int sign_with_root(const cgt_exact_integer *x, int sign, const cgt_exact_integer *s2)
{
    CGT_EXACT_LOCAL(square, 10);
    if (!s2->sign)
        return x->sign;
    if (sign * x->sign >= 0)
        return sign ? sign : x->sign;
    cgt_exact_multiply(&square, x, x);
    return x->sign * cgt_exact_compare_signed(&square, s2);
}

static int compare_planes(const cgt_exact_ray *ray, const cgt_triangle *a, const cgt_triangle *b)
{
    cgt_exact_plane p, q;
    CGT_EXACT_LOCAL(left, 6);
    CGT_EXACT_LOCAL(right, 6);
    uint32_t shift_p, shift_q;
    cgt_exact_plane_terms(ray, a, &p);
    cgt_exact_plane_terms(ray, b, &q);
    common_unit(p.exponent, q.exponent, &shift_p, &shift_q);
    cgt_exact_multiply(&left, &p.number, &q.determinant);
    cgt_exact_multiply(&right, &q.number, &p.determinant);
    cgt_exact_shift_left(&left, shift_p);
    cgt_exact_shift_left(&right, shift_q);
    return cgt_exact_compare_signed(&left, &right) * p.determinant.sign * q.determinant.sign;
}

/* middle -+ sqrt(discriminant) in a unit smaller by a power of two */
static void shift_quadratic(cgt_exact_quadratic *q, uint32_t bits)
{
    cgt_exact_shift_left(&q->middle, bits);
    cgt_exact_shift_left(&q->discriminant, 2 * bits);
}

/* The next two compare what the functions after them have computed: apart, so that these have more stack.
 *
 * The sign of m + s, m the difference of the middles, s = x -+ y, x = +-sqrt(D1), y = sqrt(D2) that of the roots. Of
 * different signs: that of m^2 - s^2 decides, m^2 - D1 - D2 +- 2 sqrt(D1 D2). */
__attribute__((noinline)) static int compare_roots(cgt_exact_quadratic *p, cgt_exact_quadratic *q, bool far,
                                                   bool same_side)
{
    CGT_EXACT_LOCAL(middle, 2);
    CGT_EXACT_LOCAL(rest, 4);
    CGT_EXACT_LOCAL(product, 8);
    uint32_t shift_p, shift_q;
    common_unit(p->exponent, q->exponent, &shift_p, &shift_q);
    shift_quadratic(p, shift_p);
    shift_quadratic(q, shift_q);
    cgt_exact_subtract(&middle, &p->middle, &q->middle);

    int roots = far ? 1 : -1; /* the sign of s */
    if (same_side)
        roots *= cgt_exact_compare_signed(&p->discriminant, &q->discriminant);
    else if (!p->discriminant.sign && !q->discriminant.sign)
        roots = 0;
    if (roots * middle.sign >= 0)
        return roots ? roots : middle.sign;
    cgt_exact_multiply(&rest, &middle, &middle);
    cgt_exact_subtract(&rest, &rest, &p->discriminant);
    cgt_exact_subtract(&rest, &rest, &q->discriminant);
    cgt_exact_multiply(&product, &p->discriminant, &q->discriminant);
    cgt_exact_shift_left(&product, 2);
    return middle.sign * sign_with_root(&rest, same_side ? 1 : -1, &product);
}

/* The sign of t1 - t2 = ((middle -+ sqrt(D)) determinant - number scale) / (scale determinant). */
__attribute__((noinline)) static int compare_root_with_plane(cgt_exact_quadratic *q, cgt_exact_plane *p, bool far)
{
    CGT_EXACT_LOCAL(left, 5);
    CGT_EXACT_LOCAL(right, 6);
    CGT_EXACT_LOCAL(root, 10);
    uint32_t shift_q, shift_p;
    common_unit(q->exponent, p->exponent, &shift_q, &shift_p);
    shift_quadratic(q, shift_q);
    cgt_exact_shift_left(&p->number, shift_p);
    cgt_exact_multiply(&left, &q->middle, &p->determinant);
    cgt_exact_multiply(&right, &p->number, &q->scale);
    cgt_exact_subtract(&left, &left, &right);
    cgt_exact_multiply(&right, &p->determinant, &p->determinant);
    cgt_exact_multiply(&root, &q->discriminant, &right);
    const int side = far ? p->determinant.sign : -p->determinant.sign;
    return sign_with_root(&left, side, &root) * p->determinant.sign;
}

static int compare_quadratics(const cgt_exact_ray *ray, const cgt_exact_root *a, const cgt_exact_root *b)
{
    cgt_exact_quadratic p, q;
    cgt_exact_sphere_terms(ray, a->primitive->sphere, &p);
    cgt_exact_sphere_terms(ray, b->primitive->sphere, &q);
    return compare_roots(&p, &q, a->far, a->far == b->far);
}

static int compare_quadratic_with_plane(const cgt_exact_ray *ray, const cgt_exact_root *a, const cgt_triangle *b)
{
    cgt_exact_quadratic q;
    cgt_exact_plane p;
    cgt_exact_sphere_terms(ray, a->primitive->sphere, &q);
    cgt_exact_plane_terms(ray, b, &p);
    return compare_root_with_plane(&q, &p, a->far);
}

int cgt_exact_compare(const cgt_exact_ray *ray, const cgt_exact_root *a, const cgt_exact_root *b)
{
    if (a->far == b->far && cgt_same_primitive(a->primitive, b->primitive))
        return 0;
    if (a->primitive->kind == CGT_KIND_TRIANGLES && b->primitive->kind == CGT_KIND_TRIANGLES)
        return compare_planes(ray, &a->primitive->triangle, &b->primitive->triangle);
    if (a->primitive->kind == CGT_KIND_TRIANGLES)
        return -compare_quadratic_with_plane(ray, b, &a->primitive->triangle);
    if (b->primitive->kind == CGT_KIND_TRIANGLES)
        return compare_quadratic_with_plane(ray, a, &b->primitive->triangle);
    return compare_quadratics(ray, a, b);
}
