/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which of two planes across axes a ray meets first: the exact order of two times t = (plane - org) / dir, each of the
 * component of the ray along the plane's axis. A bound t of a ray's range is {t, 0, 1}.
 *
 * t(a) - t(b) has the sign of (a.plane - a.org) b.dir - (b.plane - b.org) a.dir where a.dir and b.dir are of one sign,
 * the opposite one elsewhere. In double, e = 2^-53: the difference of two floats errs by e of itself, its product with
 * a float by another, and nothing leaves the range, since it lies between 2^-298 and 2^257. Each of the two products is
 * right within 2.01 e of itself, so their order is certain where they are further apart than 4 e of their sum; the
 * rounding of that comparison takes less than the 1.99 e that are left. Other pairs are compared in whole numbers. */
#ifndef CGT_PLANE_ORDER_H
#define CGT_PLANE_ORDER_H

#include <math.h>

typedef struct cgt_plane_time {
    float plane, org, dir; /* finite; dir is not 0 */
} cgt_plane_time;

/* The same as cgt_plane_order, in whole numbers alone. */
int cgt_plane_order_exact(const cgt_plane_time *a, const cgt_plane_time *b);

/* Sign of t(a) - t(b): -1, 0 or 1. */
static inline int cgt_plane_order(const cgt_plane_time *a, const cgt_plane_time *b)
{
    const double left = ((double)a->plane - (double)a->org) * (double)b->dir;
    const double right = ((double)b->plane - (double)b->org) * (double)a->dir;
    const double difference = left - right;
    if (fabs(difference) > (fabs(left) + fabs(right)) * 0x1p-51)
        return (difference > 0) == ((a->dir > 0) == (b->dir > 0)) ? 1 : -1;
    return cgt_plane_order_exact(a, b);
}

#endif
