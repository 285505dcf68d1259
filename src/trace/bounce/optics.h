/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What light does at a smooth surface, in double: reflection, refraction (Snell), Fresnel's reflectance. Directions and
 * normals are unit vectors; the normal points to the side that the light comes from: dot(direction, normal) <= 0. */
#ifndef CGT_OPTICS_H
#define CGT_OPTICS_H

#include <math.h>
#include <stdbool.h>

static inline double optics_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The squared sine of the angle to the normal: 1 - cos^2 would cancel near the normal. */
static inline double optics_squared_sine(const double d[3], const double n[3])
{
    const double x = d[1] * n[2] - d[2] * n[1], y = d[2] * n[0] - d[0] * n[2], z = d[0] * n[1] - d[1] * n[0];
    return x * x + y * y + z * z;
}

/* out = d mirrored at the surface. */
static inline void optics_reflect(const double d[3], const double n[3], double out[3])
{
    const double twice = 2.0 * optics_dot(d, n);
    for (int a = 0; a < 3; a++)
        out[a] = d[a] - twice * n[a];
}

/* Indices so far apart are no matter's; a sum that is right for those of matter loses as many bits as they have. */
#define OPTICS_LARGE 1024.0

/* Refracts d, and finds the share of unpolarised light that is reflected, 0 to 1. eta: index of the medium that it
 * leaves over that of the one that it enters. Returns whether any light goes on; where none does, out is not set, and
 * the share is 1. */
static inline bool optics_refract(const double d[3], const double n[3], double eta, double out[3], double *share)
{
    const double squared = eta * eta * optics_squared_sine(d, n);
    *share = 1.0;
    if (!(squared < 1.0))
        return false;
    const double towards = optics_dot(d, n), in = fabs(towards), beyond = sqrt(1.0 - squared);
    const double across = (eta * in - beyond) / (eta * in + beyond), along = (eta * beyond - in) / (eta * beyond + in);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = eta * d[a] + (-eta * towards - beyond) * n[a];
        if (eta > OPTICS_LARGE) /* d and n cancel; the part along the surface, n x (d x n), does not */
            out[a] = eta * (n[b] * (d[a] * n[b] - d[b] * n[a]) - n[c] * (d[c] * n[a] - d[a] * n[c])) - beyond * n[a];
    }
    *share = 0.5 * (across * across + along * along);
    return true;
}

#endif
