/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One line and one capsule, exactly: the union of two balls and of the cylinder between them, which is cut off by two
 * planes. All roots of the spheres, and those roots of the unbounded cylinder that lie between the planes, are points
 * of the capsule, and the line enters and leaves it at such points: at the first and the last of them. With n = q - p
 * and c = p - org:
 *   cylinder  |d x n|^2 t^2 - 2 (d x n).(c x n) t + |c x n|^2 - r^2 n.n = 0
 *   planes    0 <= t d.n - c.n <= n.n */
#include "support/oracle/oracle_line.h"

typedef struct axis {
    dyadic c[3], n[3], nn, dn, cn;
} axis;

static axis axis_of(const oracle_line *line, const float capsule[7])
{
    axis x;
    dyadic q[3];
    oracle_from_origin(line, capsule, x.c);
    oracle_from_origin(line, capsule + 3, q);
    for (int a = 0; a < 3; a++)
        x.n[a] = dyadic_sub(&q[a], &x.c[a]);
    x.nn = dyadic_dot(x.n, x.n);
    x.dn = dyadic_dot(line->dir, x.n);
    x.cn = dyadic_dot(x.c, x.n);
    return x;
}

/* (t d.n - from) q as x + sigma sqrt(d). */
static void height(const axis *x, const oracle_root *root, const dyadic *from, dyadic *rational, int *sigma, dyadic *d)
{
    const dyadic up = dyadic_mul(&root->p, &x->dn), down = dyadic_mul(from, &root->q);
    const dyadic square = dyadic_mul(&x->dn, &x->dn);
    *rational = dyadic_sub(&up, &down);
    *sigma = root->sigma * x->dn.sign;
    *d = dyadic_mul(&square, &root->disc);
}

static int side_of_plane(const axis *x, const oracle_root *root, const dyadic *from)
{
    dyadic rational, d;
    int sigma;
    height(x, root, from, &rational, &sigma, &d);
    return oracle_sign_of_surd(&rational, sigma, &d);
}

static int cylinder_roots(const oracle_line *line, const axis *x, float radius, oracle_root roots[2])
{
    dyadic m[3], w[3];
    dyadic_cross(line->dir, x->n, m);
    dyadic_cross(x->c, x->n, w);
    const dyadic mm = dyadic_dot(m, m), mw = dyadic_dot(m, w), ww = dyadic_dot(w, w), r = dyadic_of_float(radius);
    const dyadic rr = dyadic_mul(&r, &r), reach = dyadic_mul(&rr, &x->nn), power = dyadic_sub(&ww, &reach);
    return mm.sign ? oracle_quadratic_roots(&mw, &mm, &power, roots) : 0;
}

/* Takes a root of the given surface as the first or the last one, if it is. */
static void take(const oracle_root *root, uint32_t surface, int *count, oracle_root roots[2])
{
    if (!*count || oracle_compare(root, &roots[0]) < 0) {
        roots[0] = *root;
        roots[0].surface = surface;
    }
    if (!*count || oracle_compare(root, &roots[1]) > 0) {
        roots[1] = *root;
        roots[1].surface = surface;
    }
    *count = 1;
}

int oracle_capsule_roots(const oracle_line *line, const float capsule[7], oracle_root roots[2])
{
    const axis x = axis_of(line, capsule);
    const dyadic end = dyadic_add(&x.cn, &x.nn);
    oracle_root of_one[2];
    int count = 0;
    if (dyadic_of_float(capsule[6]).sign < 0)
        return 0;
    for (uint32_t k = 0; k < 2; k++) {
        const float sphere[4] = {capsule[3 * k], capsule[3 * k + 1], capsule[3 * k + 2], capsule[6]};
        for (int i = oracle_sphere_roots(line, sphere, of_one) - 1; i >= 0; i--)
            take(&of_one[i], 1 + k, &count, roots);
    }
    for (int i = cylinder_roots(line, &x, capsule[6], of_one) - 1; i >= 0; i--)
        if (side_of_plane(&x, &of_one[i], &x.cn) >= 0 && side_of_plane(&x, &of_one[i], &end) <= 0)
            take(&of_one[i], 0, &count, roots);
    return count ? 1 + (oracle_compare(&roots[0], &roots[1]) < 0) : 0;
}

/* Where u = (x + sigma sqrt(d)) / (q n.n) cancels, (x^2 - d) / ((x - sigma sqrt(d)) q n.n). */
static truth_real along_axis(const axis *x, const oracle_root *root)
{
    dyadic rational, d;
    int sigma;
    height(x, root, &x->cn, &rational, &sigma, &d);
    const truth_real scale = dyadic_real(&root->q) * dyadic_real(&x->nn);
    const truth_real a = dyadic_real(&rational), b = sigma * truth_square_root(dyadic_real(&d));
    if (sigma * d.sign * rational.sign >= 0)
        return (a + b) / scale;
    const dyadic square = dyadic_mul(&rational, &rational), rest = dyadic_sub(&square, &d);
    return dyadic_real(&rest) / (a - b) / scale;
}

/* The component of v across the axis, times n.n. */
static void across_axis(const axis *x, const dyadic v[3], dyadic result[3])
{
    const dyadic vn = dyadic_dot(v, x->n);
    for (int a = 0; a < 3; a++) {
        const dyadic whole = dyadic_mul(&x->nn, &v[a]), along = dyadic_mul(&x->n[a], &vn);
        result[a] = dyadic_sub(&whole, &along);
    }
}

/* Across the axis, the place is p d - q c + sigma sqrt(disc) d, over q: the first two and the last one are
 * perpendicular there, so that nothing cancels. */
static void normal_of_side(const oracle_line *line, const axis *x, const oracle_root *root, truth_real normal[3])
{
    dyadic aside[3], middle[3], chord[3];
    for (int a = 0; a < 3; a++) {
        const dyadic plus = dyadic_mul(&root->p, &line->dir[a]), minus = dyadic_mul(&root->q, &x->c[a]);
        aside[a] = dyadic_sub(&plus, &minus);
    }
    across_axis(x, aside, middle);
    across_axis(x, line->dir, chord);
    const truth_real s = root->sigma * truth_square_root(dyadic_real(&root->disc));
    for (int a = 0; a < 3; a++)
        normal[a] = dyadic_real(&middle[a]) + s * dyadic_real(&chord[a]);
    oracle_make_unit(normal);
}

void oracle_describe_capsule(const oracle_line *line, const float capsule[7], const oracle_root *root, oracle_hit *hit)
{
    const uint32_t k = root->surface == 2;
    const float sphere[4] = {capsule[3 * k], capsule[3 * k + 1], capsule[3 * k + 2], capsule[6]};
    const axis x = axis_of(line, capsule);
    hit->uv[0] = root->surface ? (truth_real)k : along_axis(&x, root);
    if (root->surface || dyadic_of_float(capsule[6]).sign == 0)
        oracle_describe_sphere(line, sphere, root, hit);
    else
        normal_of_side(line, &x, root, hit->normal);
}
