/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ray and capsule in double precision on the float input, in one order of operations, unfused, with error bounds.
 *
 * With n = q - p the axis, c = p seen from the origin, m = d x n and k = d x c, a line meets the unbounded cylinder
 * where
 *   m.m t^2 - 2 m.w t + P = 0,   w = c x n,  P = w.w - r^2 n.n,  discriminant n.n E,  E = r^2 m.m - (n.k)^2
 * and the part of the capsule that it enters or leaves at follows from the signs of d.n and, at each end, of
 *   X = -k.m    the middle of the chord along the axis from there, times m.m
 *   Q = |n x k|^2 - r^2 (d.n)^2    below 0 where the line passes the plane across the axis inside the cylinder
 * as exact_decide.c derives. Neither E nor X and Q cancel for an axis that is far away: near the silhouette n.k is about
 * r |m|, however far it is. E is the same from both ends.
 *
 * Bounds, with e = 2^-53, capitals for 1-norms, and G = D N (r + C):
 *   n, c     1 e each
 *   m        4 e D N        k      4 e D C         w     6 e C N
 *   m.m      2 |m| 4 e D N + 3 e m.m: 12 e M D N
 *   n.k      |n| 4 e D C + 5 e |n| |k|: 9 e D C N; r^2 m.m and (n.k)^2 are rounded twice each, their difference once
 *   E        24 e G (r M + |n.k| + 4.25 e G): the last term is what is of second order
 *   d.n      4 e D N; n x k: 9 e D C N, as a vector
 *   Q        24 e G (|n x k| + r |d.n| + 4.25 e G), likewise
 *   X        |k| 4 e D N + |m| 4 e D C + 3 e |k| |m|: 8 e D (C M + N K + 4 e D C N)
 *   m.w      13 e D C N^2
 *   P        16 e N^2 (r + C)^2
 * The root h of E errs by its error over the computed h, which is 24 e G s / h with s = r M + |n.k| + 4.25 e G >= h. A t
 * that is a sum, (m.w + |n| h) / m.m, has in its numerator at most 48 e G N s / h. It is safe where that and the error
 * of m.m are at most 2^-32 of their sizes, and errs by 2^-31 of itself at most. The other one, P / (m.w + |n| h), has
 * the error of P instead of that of m.m.
 *   u = (X +- d.n h / |n|) / m.m, or Q / (n.n (X -+ d.n h / |n|)) where that cancels, since (X n.n)^2 - (d.n)^2 n.n E =
 * n.n m.m Q: in the same way, d.n h / |n| within (6 e D N h + 24 e |d.n| G s / h) / |n|.
 * No term leaves the range of double: roots of n.n and E are taken apart. */
#ifndef CGT_CAPSULE_DOUBLE_H
#define CGT_CAPSULE_DOUBLE_H

#include "exact/integer/exact.h"
#include "exact/triangle_double.h"

/* 2^32 times the bounds above, which are to be below what they bound. */
#define CGT_CAPSULE_SUM_LOSS (48 * CGT_DOUBLE_U * 0x1p32)
#define CGT_CAPSULE_SCALE_LOSS (16 * CGT_DOUBLE_U * 0x1p32)
#define CGT_CAPSULE_PRODUCT_LOSS (16 * CGT_DOUBLE_U * 0x1p32)

typedef struct cgt_capsule_terms {
    double d[3], n[3], c[3], m[3];
    double nn, dn, mm, middle, product, disc;      /* middle: m.w, product: P, disc: E */
    double length_d, length_n, length_c, length_m; /* 1-norms */
    double r, reach, size;                         /* reach: r + C, size: s */
} cgt_capsule_terms;

#define CGT_DOT3(p, q) ((p)[0] * (q)[0] + (p)[1] * (q)[1] + (p)[2] * (q)[2])
#define CGT_NORM1(p) (fabs((p)[0]) + fabs((p)[1]) + fabs((p)[2]))

static inline cgt_capsule_terms cgt_capsule_double_terms(const float org[3], const float dir[3], const cgt_capsule *q)
{
    cgt_capsule_terms e = {.r = q->r};
    for (int a = 0; a < 3; a++) {
        e.d[a] = dir[a];
        e.n[a] = (double)q->q[a] - (double)q->p[a];
        e.c[a] = (double)q->p[a] - (double)org[a];
    }
    const double w[3] = {CGT_CROSS(e.c, e.n, 1, 2), CGT_CROSS(e.c, e.n, 2, 0), CGT_CROSS(e.c, e.n, 0, 1)};
    const double k[3] = {CGT_CROSS(e.d, e.c, 1, 2), CGT_CROSS(e.d, e.c, 2, 0), CGT_CROSS(e.d, e.c, 0, 1)};
    e.m[0] = CGT_CROSS(e.d, e.n, 1, 2);
    e.m[1] = CGT_CROSS(e.d, e.n, 2, 0);
    e.m[2] = CGT_CROSS(e.d, e.n, 0, 1);
    const double volume = CGT_DOT3(e.n, k), rr = e.r * e.r;
    e.nn = CGT_DOT3(e.n, e.n);
    e.dn = CGT_DOT3(e.d, e.n);
    e.mm = CGT_DOT3(e.m, e.m);
    e.middle = CGT_DOT3(e.m, w);
    e.product = CGT_DOT3(w, w) - rr * e.nn;
    e.disc = rr * e.mm - volume * volume;
    e.length_d = CGT_NORM1(e.d);
    e.length_n = CGT_NORM1(e.n);
    e.length_c = CGT_NORM1(e.c);
    e.length_m = CGT_NORM1(e.m);
    e.reach = e.r + e.length_c;
    e.size = e.r * e.length_m + fabs(volume) + 4.25 * CGT_DOUBLE_U * (e.length_d * e.length_n * e.reach);
    return e;
}

static inline double cgt_capsule_double_disc_error(const cgt_capsule_terms *e)
{
    return 24 * CGT_DOUBLE_U * (e->length_d * e->length_n * e->reach) * e->size;
}

/* X and Q at an end, with their bounds. */
typedef struct cgt_capsule_end_terms {
    double x, q, x_error, q_error;
} cgt_capsule_end_terms;

/* c: the end, seen from the origin. */
static inline cgt_capsule_end_terms cgt_capsule_double_end(const cgt_capsule_terms *e, const double c[3])
{
    const double k[3] = {CGT_CROSS(e->d, c, 1, 2), CGT_CROSS(e->d, c, 2, 0), CGT_CROSS(e->d, c, 0, 1)};
    const double g[3] = {CGT_CROSS(e->n, k, 1, 2), CGT_CROSS(e->n, k, 2, 0), CGT_CROSS(e->n, k, 0, 1)};
    const double length_c = CGT_NORM1(c), all = e->length_d * e->length_n * (e->r + length_c);
    return (cgt_capsule_end_terms){.x = -CGT_DOT3(k, e->m),
                                   .q = CGT_DOT3(g, g) - e->r * e->r * (e->dn * e->dn),
                                   .x_error = 8 * CGT_DOUBLE_U * e->length_d *
                                              (length_c * e->length_m + e->length_n * CGT_NORM1(k) +
                                               4 * CGT_DOUBLE_U * (e->length_d * length_c * e->length_n)),
                                   .q_error = 24 * CGT_DOUBLE_U * all *
                                              (CGT_NORM1(g) + e->r * fabs(e->dn) + 4.25 * CGT_DOUBLE_U * all)};
}

/* A root of the cylinder; false where it is not safe. */
static inline bool cgt_capsule_double_root(const cgt_capsule_terms *e, bool far, double *t)
{
    const double half = sqrt(e->disc), root = sqrt(e->nn) * half, large = fabs(e->middle) + root;
    const double extent = e->length_n * e->reach, loss = e->size / half;
    if (!(extent * e->length_d * e->length_n * loss * CGT_CAPSULE_SUM_LOSS <= large))
        return false;
    if ((e->middle > 0) == far) {
        *t = (far ? large : -large) / e->mm;
        return e->length_m * (e->length_d * e->length_n) * CGT_CAPSULE_SCALE_LOSS <= e->mm;
    }
    *t = e->product / (far ? -large : large);
    return extent * extent * CGT_CAPSULE_PRODUCT_LOSS <= fabs(e->product);
}

/* u of a root of the cylinder; false where it is not safe. */
static inline bool cgt_capsule_double_u(const cgt_capsule_terms *e, bool far, double *u)
{
    const cgt_capsule_end_terms p = cgt_capsule_double_end(e, e->c);
    const double half = sqrt(e->disc), length = sqrt(e->nn), lean = (far ? e->dn : -e->dn) * half / length;
    const double all = e->length_d * e->length_n * e->reach, loss = e->size / half;
    const double error =
        p.x_error + CGT_DOUBLE_U * (6 * (e->length_d * e->length_n) * half + 24 * fabs(e->dn) * all * loss) / length;
    const double large = fabs(p.x) + fabs(lean);
    if (!(error * 0x1p32 <= large))
        return false;
    if ((p.x > 0) == (lean > 0)) {
        *u = (p.x + lean) / e->mm;
        return e->length_m * (e->length_d * e->length_n) * CGT_CAPSULE_SCALE_LOSS <= e->mm;
    }
    *u = p.q / (e->nn * (p.x - lean));
    return p.q_error * 0x1p32 <= fabs(p.q);
}

#endif
