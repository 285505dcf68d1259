/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where lines meet spheres. */
#include "support/oracle/truth.h"

#include <math.h>

truth_real truth_square_root(truth_real a)
{
    if (!(a > 0))
        return 0;
    truth_real x = (truth_real)sqrtl((long double)a);
    for (int i = 0; i < 2; i++)
        x = (x + a / x) / 2; /* 64 bits, or 53, to all of them */
    return x;
}

typedef struct quadratic {
    truth_real dd, dc, cc, rr, discriminant;
} quadratic;

static quadratic make_quadratic(const float org[3], const float dir[3], const float sphere[4])
{
    quadratic q = {0, 0, 0, (truth_real)sphere[3] * sphere[3], 0};
    for (int a = 0; a < 3; a++) {
        const truth_real c = (truth_real)sphere[a] - org[a], d = dir[a];
        q.dd += d * d;
        q.dc += d * c;
        q.cc += c * c;
    }
    q.discriminant = q.dc * q.dc - q.dd * (q.cc - q.rr);
    return q;
}

truth_roots truth_sphere(const float org[3], const float dir[3], const float sphere[4])
{
    const quadratic q = make_quadratic(org, dir, sphere);
    const double distance = sqrt((double)q.cc), r = sphere[3];
    truth_roots roots = {.hit = q.discriminant >= 0, .h = (double)(q.discriminant / q.dd)};
    roots.doubt_h = 0x1p-49 * (distance + r) * r + 0x1p-96 * distance * distance;
    if (!roots.hit)
        return roots;
    const truth_real root = truth_square_root(q.discriminant), sum = q.dc >= 0 ? q.dc + root : q.dc - root;
    const truth_real large = sum / q.dd, small = sum != 0 ? (q.cc - q.rr) / sum : 0;
    roots.near = q.dc >= 0 ? small : large;
    roots.far = q.dc >= 0 ? large : small;
    return roots;
}

bool truth_in_doubt(const truth_roots *roots) { return fabs(roots->h) <= roots->doubt_h; }
