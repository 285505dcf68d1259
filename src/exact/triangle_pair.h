/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The determinants of triangle_double.h where double precision leaves nothing of them: an origin that is 2^-50 of a
 * triangle's size above its plane, a ray as near to an edge. Numbers are pairs of doubles whose sum counts, of 106 bits
 * (Dekker, "A floating-point technique for extending the available precision", 1971), whose lower number is at most
 * 4 e of the largest number that went into a sum, with e = 2^-53.
 *
 * Bounds: a difference of two floats is exact. A product errs by 8 e^2 of what its factors were summed from, a sum by
 * 8 e^2 of the magnitudes of its terms. Each product of three factors passes two products and three sums: 40 e^2 and
 * what is of second order, of the sum of the magnitudes of the determinant's products. That sum is at most a tenth of
 * the error in double over e, so that 2^-48 of that error, 320 e^2 of the sum, is more than enough. */
#ifndef CGT_TRIANGLE_PAIR_H
#define CGT_TRIANGLE_PAIR_H

#include "exact/triangle_double.h"

/* Of a determinant, times its error in double. */
#define CGT_PAIR_ERROR 0x1p-48

typedef struct cgt_pair {
    double high, low;
} cgt_pair;

static inline cgt_pair cgt_pair_add(cgt_pair p, cgt_pair q)
{
    const double sum = p.high + q.high, back = sum - p.high;
    return (cgt_pair){sum, (p.high - (sum - back)) + (q.high - back) + (p.low + q.low)};
}

static inline cgt_pair cgt_pair_difference(float a, float b)
{
    return cgt_pair_add((cgt_pair){(double)a, 0}, (cgt_pair){-(double)b, 0});
}

/* The first 26 bits of a number. */
static inline double cgt_pair_cut(double x)
{
    const double scaled = x * 0x1.0000002p27;
    return scaled - (scaled - x);
}

static inline cgt_pair cgt_pair_mul(cgt_pair p, cgt_pair q)
{
    const double product = p.high * q.high, a = cgt_pair_cut(p.high), b = cgt_pair_cut(q.high);
    const double a_rest = p.high - a, b_rest = q.high - b;
    const double lost = ((a * b - product) + a * b_rest + a_rest * b) + a_rest * b_rest;
    return (cgt_pair){product, lost + (p.high * q.low + p.low * q.high)};
}

/* (p x q).r */
static inline double cgt_pair_determinant(const cgt_pair p[3], const cgt_pair q[3], const cgt_pair r[3])
{
    cgt_pair sum = {0, 0};
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const cgt_pair turned = cgt_pair_mul(p[j], q[i]), minus = {-turned.high, -turned.low};
        sum = cgt_pair_add(sum, cgt_pair_mul(cgt_pair_add(cgt_pair_mul(p[i], q[j]), minus), r[k]));
    }
    return sum.high + sum.low;
}

static inline void cgt_pair_between(const float from[3], const float to[3], cgt_pair d[3])
{
    for (int a = 0; a < 3; a++)
        d[a] = cgt_pair_difference(to[a], from[a]);
}

/* Sets p->num and its error anew. */
static inline void cgt_triangle_refine_num(const float org[3], const cgt_triangle *q, cgt_triangle_plane *p)
{
    cgt_pair a[3], e1[3], e2[3];
    cgt_pair_between(org, q->v[0], a);
    cgt_pair_between(q->v[0], q->v[1], e1);
    cgt_pair_between(q->v[0], q->v[2], e2);
    p->num = cgt_pair_determinant(e1, e2, a);
    p->num_error *= CGT_PAIR_ERROR;
}

/* As cgt_triangle_double_side, which has left the side open. */
static inline bool cgt_triangle_refine_side(const float org[3], const float dir[3], const cgt_triangle *q, int *side)
{
    const cgt_pair d[3] = {{(double)dir[0], 0}, {(double)dir[1], 0}, {(double)dir[2], 0}};
    cgt_triangle_sides s = cgt_triangle_double_sides(org, dir, q);
    for (int k = 0; k < 3; k++) {
        if (fabs(s.w[k]) > s.error[k])
            continue;
        const float *from = q->v[(k + 1) % 3], *to = q->v[(k + 2) % 3];
        cgt_pair b[3], e[3];
        cgt_pair_between(org, from, b);
        cgt_pair_between(from, to, e);
        s.w[k] = cgt_pair_determinant(b, e, d);
        s.error[k] *= CGT_PAIR_ERROR;
    }
    return cgt_triangle_sides_tell(&s, side);
}

#endif
