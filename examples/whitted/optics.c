/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reflection, refraction and Fresnel's equations; see optics.h. */
#include "whitted/optics.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The squared sine of the angle to the normal: 1 - cos^2 would cancel near the normal. */
static double squared_sine(const double d[3], const double n[3])
{
    const double x = d[1] * n[2] - d[2] * n[1], y = d[2] * n[0] - d[0] * n[2], z = d[0] * n[1] - d[1] * n[0];
    return x * x + y * y + z * z;
}

void optics_reflect(const double d[3], const double n[3], double out[3])
{
    const double twice = 2.0 * dot(d, n);
    for (int a = 0; a < 3; a++)
        out[a] = d[a] - twice * n[a];
}

int optics_refract(const double d[3], const double n[3], double eta, double out[3])
{
    const double squared = eta * eta * squared_sine(d, n);
    if (!(squared < 1.0))
        return 0;
    const double along = -eta * dot(d, n) - sqrt(1.0 - squared);
    for (int a = 0; a < 3; a++)
        out[a] = eta * d[a] + along * n[a];
    return 1;
}

double optics_reflectance(const double d[3], const double n[3], double eta)
{
    const double squared = eta * eta * squared_sine(d, n);
    if (!(squared < 1.0))
        return 1.0;
    const double in = fabs(dot(d, n)), out = sqrt(1.0 - squared);
    const double across = (eta * in - out) / (eta * in + out), along = (eta * out - in) / (eta * out + in);
    return 0.5 * (across * across + along * along);
}
