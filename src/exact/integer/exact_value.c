/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t, u, v and the normal in double, from whole numbers in which nothing has been lost: each is rounded once, and what
 * follows does not cancel. */
#include "exact/integer/exact_terms.h"

#include <math.h>

/* number * 2^exponent, the number 0 or between 2^31 and 2^65 in size: the range of double is no limit on the way. */
typedef struct real {
    double number;
    int exponent;
} real;

static real real_of(const cgt_exact_integer *x)
{
    real r = {0, 0};
    if (x->sign)
        r.number = x->sign * (double)cgt_exact_top(x, &r.exponent);
    return r;
}

static real square_root(real x)
{
    const int odd = x.exponent & 1;
    return (real){sqrt(odd ? 2 * x.number : x.number), (x.exponent - odd) / 2};
}

static double at_exponent(real x, int exponent)
{
    const int up = x.exponent - exponent;
    return ldexp(x.number, up < -1000 ? -1000 : up); /* so far below a sum that it does not count */
}

static real add_reals(real a, real b)
{
    if (a.number == 0 || b.number == 0)
        return a.number == 0 ? b : a;
    const int exponent = a.exponent > b.exponent ? a.exponent : b.exponent;
    return (real){at_exponent(a, exponent) + at_exponent(b, exponent), exponent};
}

/* a / b * 2^exponent */
static double quotient(real a, real b, int exponent)
{
    return a.number == 0 ? 0 : ldexp(a.number / b.number, a.exponent - b.exponent + exponent);
}

static double plane_t(const cgt_exact_ray *ray, const cgt_triangle *triangle)
{
    cgt_exact_plane p;
    cgt_exact_plane_terms(ray, triangle, &p);
    return quotient(real_of(&p.number), real_of(&p.determinant), p.exponent);
}

/* The root whose sum has terms of one sign by its formula; the other from the product of the two. */
static double quadratic_t(const cgt_exact_quadratic *q, bool far)
{
    const int side = far ? 1 : -1;
    const real middle = real_of(&q->middle);
    real root = square_root(real_of(&q->discriminant));
    const bool cancels = q->discriminant.sign && side * q->middle.sign < 0;
    root.number *= cancels ? -side : side;
    const real large = add_reals(middle, root);
    return cancels ? quotient(real_of(&q->product), large, q->exponent)
                   : quotient(large, real_of(&q->scale), q->exponent);
}

static double sphere_t(const cgt_exact_ray *ray, cgt_sphere sphere, bool far)
{
    cgt_exact_quadratic q;
    cgt_exact_sphere_terms(ray, sphere, &q);
    return quadratic_t(&q, far);
}

static double cylinder_t(const cgt_exact_ray *ray, const cgt_capsule *capsule, bool far)
{
    cgt_exact_dots dots;
    cgt_exact_quadratic q;
    cgt_exact_capsule_dots(ray, capsule, false, &dots);
    cgt_exact_cylinder_terms(&dots, &q);
    return quadratic_t(&q, far);
}

double cgt_exact_t(const cgt_exact_ray *ray, const cgt_exact_root *root)
{
    switch (root->primitive->kind) {
    case CGT_KIND_SPHERES: return sphere_t(ray, root->primitive->sphere, root->far);
    case CGT_KIND_CAPSULES: return cylinder_t(ray, &root->primitive->capsule, root->far);
    case CGT_KIND_TRIANGLES: break;
    }
    return plane_t(ray, &root->primitive->triangle);
}

/* u = (t d.n - c.n) / n.n = (n.n X +- d.n sqrt(D)) / (n.n m.m), or, where these cancel, Q / (n.n X -+ d.n sqrt(D)),
 * since (n.n X)^2 - (d.n)^2 D = n.n m.m Q. */
double cgt_exact_capsule_u(const cgt_exact_ray *ray, const cgt_capsule *capsule, bool far)
{
    cgt_exact_dots dots;
    cgt_exact_quadratic quadratic;
    CGT_EXACT_LOCAL(x, 4);
    CGT_EXACT_LOCAL(product, 6);
    cgt_exact_capsule_dots(ray, capsule, false, &dots);
    cgt_exact_cylinder_terms(&dots, &quadratic);
    cgt_exact_capsule_middle(&dots, &x);
    cgt_exact_multiply(&product, &dots.nn, &x);
    const real middle = real_of(&product), dn = real_of(&dots.dn);
    real root = square_root(real_of(&quadratic.discriminant));
    const int side = far ? 1 : -1;
    const bool cancels = quadratic.discriminant.sign && side * dots.dn.sign * x.sign < 0;
    root = (real){root.number * dn.number * 0x1p-32 * (cancels ? -side : side), root.exponent + dn.exponent + 32};
    const real large = add_reals(middle, root);
    if (cancels)
        cgt_exact_capsule_plane(&dots, &product);
    else
        cgt_exact_multiply(&product, &dots.nn, &quadratic.scale);
    return cancels ? quotient(real_of(&product), large, 0) : quotient(large, real_of(&product), 0);
}

void cgt_exact_uv(const cgt_exact_ray *ray, const cgt_triangle *triangle, double uv[2])
{
    cgt_exact_three edge;
    CGT_EXACT_LOCAL(determinant, 3);
    cgt_exact_edge_terms(ray, triangle, &edge);
    cgt_exact_add(&determinant, &edge.of[0], &edge.of[1]);
    cgt_exact_add(&determinant, &determinant, &edge.of[2]);
    for (int k = 0; k < 2; k++)
        uv[k] = quotient(real_of(&edge.of[k + 1]), real_of(&determinant), 0);
}

void cgt_exact_normal(const cgt_triangle *triangle, double normal[3])
{
    cgt_exact_three component;
    real n[3];
    int largest = 0;
    cgt_exact_normal_terms(triangle, &component);
    for (int a = 0; a < 3; a++) {
        n[a] = real_of(&component.of[a]);
        if (n[a].number != 0 && (n[largest].number == 0 || n[a].exponent > n[largest].exponent))
            largest = a;
    }
    for (int a = 0; a < 3; a++)
        normal[a] = ldexp(n[a].number, n[a].exponent - n[largest].exponent - 64);
}
