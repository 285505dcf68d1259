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
 * as exact_decide.c derives. Neither E nor X and Q cancel for an axis that is far away: near the silhouette n.k is
 * about r |m|, however far it is. E is the same from both ends.
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
 * The root h of E errs by its error over the computed h, which is 24 e G s / h with s = r M + |n.k| + 4.25 e G >= h. A
 * t that is a sum, (m.w + |n| h) / m.m, has in its numerator at most 48 e G N s / h. It is safe where that and the
 * error of m.m are at most 2^-32 of their sizes, and errs by 2^-31 of itself at most. The other one, P / (m.w + |n| h),
 * has the error of P instead of that of m.m.
 * A normal is across the axis, over r: an error of t counts |m| / |n| times there. From afar that asks for more than t
 * itself does. That of the numerator, over m.m, is at most 2^-26 of r where it is at most 2^-27 r |n| M, since M is
 * below 2 |m|; that of P, over the denominator, where it is at most 2^-27 r |n| / M of that. An error of m.m counts
 * 12 e c / r at most.
 *   u = (X +- d.n h / |n|) / m.m, or Q / (n.n (X -+ d.n h / |n|)) where that cancels, since (X n.n)^2 - (d.n)^2 n.n E =
 * n.n m.m Q: in the same way, d.n h / |n| within (6 e D N h + 24 e |d.n| G s / h) / |n|.
 * No term leaves the range of double: roots of n.n and E are taken apart.
 *
 * The functions are in capsule_terms.h, for a double here and for vectors of them in kernel/resolve/resolve_capsules.h,
 * so that both have the same bits. */
#ifndef CGT_CAPSULE_DOUBLE_H
#define CGT_CAPSULE_DOUBLE_H

#include "exact/integer/exact.h"
#include "exact/triangle_double.h"

/* 2^32 times the bounds above, which are to be below what they bound. */
#define CGT_CAPSULE_SUM_LOSS (48 * CGT_DOUBLE_U * 0x1p32)
#define CGT_CAPSULE_SCALE_LOSS (16 * CGT_DOUBLE_U * 0x1p32)
#define CGT_CAPSULE_PRODUCT_LOSS (16 * CGT_DOUBLE_U * 0x1p32)

#define CGT_CAPSULE_PLACE_SHARE 0x1p5

#define CGT_CAPSULE_U_LOSS 0x1p32

#define CAPSULE_NAME(name) cgt_capsule_double_##name
#define CAPSULE_REAL double
#define CAPSULE_ABS(x) fabs(x)
#define CAPSULE_ROOT(x) sqrt(x)
#define CAPSULE_LESS(x, y) ((x) < (y) ? (x) : (y))
#include "exact/capsule_terms.h"
#undef CAPSULE_NAME
#undef CAPSULE_REAL
#undef CAPSULE_ABS
#undef CAPSULE_ROOT
#undef CAPSULE_LESS

#endif
