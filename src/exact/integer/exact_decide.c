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

int cgt_exact_triangle_side(const cgt_exact_ray *ray, const cgt_triangle *triangle)
{
    cgt_exact_plane plane;
    cgt_exact_plane_terms(ray, triangle, &plane);
    return plane.determinant.sign;
}

int cgt_exact_sphere_roots(const cgt_exact_ray *ray, cgt_sphere sphere)
{
    cgt_exact_quadratic quadratic;
    cgt_exact_sphere_terms(ray, sphere, &quadratic);
    return quadratic.discriminant.sign + 1;
}

/* ---- Capsules ----------------------------------------------------------------------------------------------------
 *
 * Let a and b be the ends of the axis, in the order in which the line passes them: d.n >= 0 with n from a to b. Where
 * the line enters the unbounded cylinder before it passes the plane across a, the capsule there is the sphere around a,
 * and so is all of it that the line can meet before that plane: it enters at that sphere or not at all. Likewise behind
 * the plane across b; between them it enters at the side. The planes are passed at t_a = c.n / d.n and t_b, where the
 * cylinder's quadratic is Q_a and Q_b, times positive numbers, and the middle of the chord is X / m.m along the axis:
 *   enters before t_a   Q_a < 0, or X_a < 0             leaves behind t_b   Q_b < 0, or X_b > 0
 *   enters behind t_b   Q_b > 0 and X_b > 0             leaves before t_a   Q_a > 0 and X_a < 0
 * A line across the axis, d.n = 0, has Q >= 0 and the same rules. One along it, m.m = 0, meets both spheres or none. */

/* Signs of X and Q at an end. */
typedef struct end_signs {
    int x, q;
} end_signs;

__attribute__((noinline)) static end_signs signs_at_end(const cgt_exact_dots *dots)
{
    CGT_EXACT_LOCAL(x, 4);
    CGT_EXACT_LOCAL(q, 6);
    cgt_exact_capsule_middle(dots, &x);
    cgt_exact_capsule_plane(dots, &q);
    return (end_signs){x.sign, q.sign};
}

/* In how many places the line meets the cylinder; 1 where it is along the axis. *along: it is. */
__attribute__((noinline)) static int cylinder_roots(const cgt_exact_dots *dots, bool *along)
{
    cgt_exact_quadratic quadratic;
    cgt_exact_cylinder_terms(dots, &quadratic);
    *along = !quadratic.scale.sign;
    return 1 + quadratic.discriminant.sign;
}

/* Whether the line leaves the sphere that it enters at. */
static bool same_end(const cgt_capsule *capsule, const cgt_capsule_part part[2])
{
    const cgt_primitive a = {.kind = CGT_KIND_SPHERES, .sphere = cgt_capsule_end(capsule, part[0])};
    const cgt_primitive b = {.kind = CGT_KIND_SPHERES, .sphere = cgt_capsule_end(capsule, part[1])};
    return part[1] != CGT_CAPSULE_SIDE && cgt_same_surface(&a, &b);
}

int cgt_exact_capsule_roots(const cgt_exact_ray *ray, const cgt_capsule *capsule, cgt_capsule_part part[2])
{
    cgt_exact_dots dots;
    bool along;
    cgt_exact_capsule_dots(ray, capsule, false, &dots);
    const bool from_q = dots.dn.sign < 0;
    if (from_q)
        cgt_exact_capsule_dots(ray, capsule, true, &dots);
    const int roots = cylinder_roots(&dots, &along);
    if (!roots)
        return 0;
    const end_signs a = signs_at_end(&dots);
    cgt_exact_capsule_dots(ray, capsule, !from_q, &dots);
    const end_signs q = signs_at_end(&dots), b = {-q.x, q.q}; /* the axis is turned */
    const cgt_capsule_part first = from_q ? CGT_CAPSULE_Q : CGT_CAPSULE_P,
                           last = from_q ? CGT_CAPSULE_P : CGT_CAPSULE_Q;
    part[0] = along || a.q < 0 || a.x < 0 ? first : b.q > 0 && b.x > 0 ? last : CGT_CAPSULE_SIDE;
    part[1] = along || b.q < 0 || b.x > 0 ? last : a.q > 0 && a.x < 0 ? first : CGT_CAPSULE_SIDE;
    if (part[0] == CGT_CAPSULE_SIDE)
        return part[1] == CGT_CAPSULE_SIDE ? roots : 2;
    const int of_end = cgt_exact_sphere_roots(ray, cgt_capsule_end(capsule, part[0]));
    return of_end && !same_end(capsule, part) ? 2 : of_end;
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

/* Any root as one of a quadratic: that of a triangle has a discriminant of 0. */
__attribute__((noinline)) static void root_terms(const cgt_exact_ray *ray, const cgt_exact_root *root,
                                                 cgt_exact_quadratic *q)
{
    cgt_exact_dots dots;
    cgt_exact_plane plane;
    switch (root->primitive->kind) {
    case CGT_KIND_SPHERES: cgt_exact_sphere_terms(ray, root->primitive->sphere, q); return;
    case CGT_KIND_CAPSULES:
        cgt_exact_capsule_dots(ray, &root->primitive->capsule, false, &dots);
        cgt_exact_cylinder_terms(&dots, q);
        return;
    case CGT_KIND_TRIANGLES: break;
    }
    cgt_exact_plane_terms(ray, &root->primitive->triangle, &plane);
    *q = (cgt_exact_quadratic){.exponent = plane.exponent};
    q->middle.limb = q->limb[0];
    q->scale.limb = q->limb[1];
    q->discriminant.limb = q->discriminant_limb;
    cgt_exact_copy(&q->middle, &plane.number);
    cgt_exact_copy(&q->scale, &plane.determinant);
    q->middle.sign *= plane.determinant.sign;
    q->scale.sign = 1;
}

/* The sign of x + s, x of degree 8, where s = y - z, and y and z are roots of the squares y2 and z2, with the sign of
 * y or, if they have opposite ones, both added. As in compare_roots. */
__attribute__((noinline)) static int sign_with_two_roots(const cgt_exact_integer *x, const cgt_exact_integer *y2,
                                                         const cgt_exact_integer *z2, bool far, bool same_side)
{
    CGT_EXACT_LOCAL(rest, 16);
    CGT_EXACT_LOCAL(square, 32);
    CGT_EXACT_LOCAL(product, 32);
    int roots = far ? 1 : -1;
    if (same_side)
        roots *= cgt_exact_compare_signed(y2, z2);
    else if (!y2->sign && !z2->sign)
        roots = 0;
    if (roots * x->sign >= 0)
        return roots ? roots : x->sign;
    cgt_exact_multiply(&rest, x, x);
    cgt_exact_subtract(&rest, &rest, y2);
    cgt_exact_subtract(&rest, &rest, z2);
    cgt_exact_multiply(&product, y2, z2);
    cgt_exact_shift_left(&product, 2);
    const int side = same_side ? 1 : -1; /* x^2 - s^2 = rest + side sqrt(product) */
    if (!product.sign || side * rest.sign >= 0)
        return x->sign * (product.sign ? side : rest.sign);
    cgt_exact_multiply(&square, &rest, &rest);
    return x->sign * rest.sign * cgt_exact_compare_signed(&square, &product);
}

/* The sign of t1 - t2 = (middle1 +- sqrt(D1)) / scale1 - (middle2 +- sqrt(D2)) / scale2, with scales above 0. */
__attribute__((noinline)) static int compare_any(cgt_exact_quadratic *p, cgt_exact_quadratic *q, bool far,
                                                 bool same_side)
{
    CGT_EXACT_LOCAL(middle, 8);
    CGT_EXACT_LOCAL(square, 8);
    CGT_EXACT_LOCAL(root_p, 16);
    CGT_EXACT_LOCAL(root_q, 16);
    uint32_t shift_p, shift_q;
    common_unit(p->exponent, q->exponent, &shift_p, &shift_q);
    shift_quadratic(p, shift_p);
    shift_quadratic(q, shift_q);
    cgt_exact_multiply(&square, &q->scale, &q->scale);
    cgt_exact_multiply(&root_p, &p->discriminant, &square);
    cgt_exact_multiply(&square, &p->scale, &p->scale);
    cgt_exact_multiply(&root_q, &q->discriminant, &square);
    cgt_exact_multiply(&middle, &p->middle, &q->scale);
    cgt_exact_multiply(&square, &q->middle, &p->scale);
    cgt_exact_subtract(&middle, &middle, &square);
    return sign_with_two_roots(&middle, &root_p, &root_q, far, same_side);
}

static int compare_with_cylinder(const cgt_exact_ray *ray, const cgt_exact_root *a, const cgt_exact_root *b)
{
    cgt_exact_quadratic p, q;
    root_terms(ray, a, &p);
    root_terms(ray, b, &q);
    return compare_any(&p, &q, a->far, a->far == b->far);
}

int cgt_exact_compare(const cgt_exact_ray *ray, const cgt_exact_root *a, const cgt_exact_root *b)
{
    if (a->far == b->far && cgt_same_surface(a->primitive, b->primitive))
        return 0;
    if (a->primitive->kind == CGT_KIND_CAPSULES || b->primitive->kind == CGT_KIND_CAPSULES)
        return compare_with_cylinder(ray, a, b);
    if (a->primitive->kind == CGT_KIND_TRIANGLES && b->primitive->kind == CGT_KIND_TRIANGLES)
        return compare_planes(ray, &a->primitive->triangle, &b->primitive->triangle);
    if (a->primitive->kind == CGT_KIND_TRIANGLES)
        return -compare_quadratic_with_plane(ray, b, &a->primitive->triangle);
    if (b->primitive->kind == CGT_KIND_TRIANGLES)
        return compare_quadratic_with_plane(ray, a, &b->primitive->triangle);
    return compare_quadratics(ray, a, b);
}
