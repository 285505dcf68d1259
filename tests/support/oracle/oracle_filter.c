/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The filter in double precision, u = 2^-53. */
#include "support/oracle/oracle_filter.h"

#include <math.h>
#include <string.h>

#define MARGIN 0x1p-40

/* A float's value, from its bits. */
static double widen(float f)
{
    uint32_t bits;
    double power;
    memcpy(&bits, &f, sizeof bits);
    const uint32_t field = bits >> 23 & 255;
    const int32_t m = (int32_t)(bits & 0x7fffff) | (field ? 0x800000 : 0);
    const uint64_t power_bits = (uint64_t)((field ? field : 1) + 1023 - 150) << 52;
    memcpy(&power, &power_bits, sizeof power);
    return (bits >> 31 ? -m : m) * power;
}

static bool widen_all(const float *f, int count, double *result)
{
    for (int i = 0; i < count; i++) {
        if (!isfinite(f[i]))
            return false;
        result[i] = widen(f[i]);
    }
    return true;
}

/* ---- balls ---- */

typedef struct ball {
    double center[3], rr;
} ball;

static double lesser(double a, double b) { return a < b ? a : b; }

static double greater(double a, double b) { return a > b ? a : b; }

/* Around the middle of the triangle's box. */
static ball ball_around(const double v[9])
{
    ball b = {.rr = 0};
    for (int a = 0; a < 3; a++) {
        const double low = lesser(v[a], lesser(v[3 + a], v[6 + a]));
        b.center[a] = (low + greater(v[a], greater(v[3 + a], v[6 + a]))) / 2;
    }
    for (int i = 0; i < 9; i += 3) {
        const double x = v[i] - b.center[0], y = v[i + 1] - b.center[1], z = v[i + 2] - b.center[2];
        b.rr = greater(b.rr, x * x + y * y + z * z);
    }
    return b;
}

/* Around the middle of the axis. */
static ball ball_around_ends(const double v[7])
{
    ball b;
    double square = 0;
    for (int a = 0; a < 3; a++) {
        const double half = (v[3 + a] - v[a]) / 2;
        b.center[a] = v[a] + half;
        square += half * half;
    }
    const double reach = (sqrt(square) + v[6]) * (1 + MARGIN);
    b.rr = v[6] < 0 ? -INFINITY : reach * reach;
    return b;
}

static ball ball_of(const oracle_primitive *primitive)
{
    const ball nothing = {.rr = -INFINITY};
    ball b;
    double v[9];
    if (!widen_all(primitive->data, oracle_floats(primitive->kind), v))
        return nothing;
    if (primitive->kind == ORACLE_TRIANGLE)
        b = ball_around(v);
    else if (primitive->kind == ORACLE_CAPSULE)
        b = ball_around_ends(v);
    else
        b = (ball){{v[0], v[1], v[2]}, v[3] * v[3]};
    b.rr *= 1 + MARGIN;
    return b;
}

void oracle_bound(const oracle_primitive *primitive, uint32_t count, oracle_bounds *bounds)
{
    for (uint32_t i = 0; i < ORACLE_BLOCK; i++) {
        const ball b = i < count ? ball_of(&primitive[i]) : (ball){.rr = -INFINITY};
        bounds->x[i] = b.center[0];
        bounds->y[i] = b.center[1];
        bounds->z[i] = b.center[2];
        bounds->rr[i] = b.rr;
    }
}

/* ---- rays ---- */

/* Values of t that round into the range are at most an ulp outside of it: 2^-22 of the end, or 2^-148. */
oracle_filter oracle_filter_make(const truth_ray *ray)
{
    oracle_filter f;
    f.dd = 0;
    for (int a = 0; a < 3; a++) {
        f.org[a] = widen(ray->org[a]);
        f.dir[a] = widen(ray->dir[a]);
        f.dd += f.dir[a] * f.dir[a];
    }
    f.length = sqrt(f.dd);
    const double low = isfinite(ray->t_min) ? widen(ray->t_min) : (double)ray->t_min;
    const double high = isfinite(ray->t_max) ? widen(ray->t_max) : (double)ray->t_max;
    f.t_min = low - 0x1p-22 * fabs(low) - 0x1p-148;
    f.t_max = high + 0x1p-22 * fabs(high) + 0x1p-148;
    return f;
}

void oracle_filter_cut(oracle_filter *filter, truth_real t)
{
    const double d = (double)t;
    filter->t_max = fmin(filter->t_max, d + MARGIN * fabs(d));
}

/* The line misses the ball where |c x d|^2 > r^2 d.d. Each difference has a relative error of u, each component of the
 * product an error of 3 u |c| |d|, so |c x d| an error below e |c| |d|, e = 8 u. For a line that meets the ball, the
 * computed square is at most (r + e |c|)^2 d.d <= (r^2 (1 + e) + (e + e^2) c.c) d.d: 2^-40 is 2^10 times that e. */
void oracle_filter_line(const oracle_filter *filter, const oracle_bounds *bounds, double margin[ORACLE_BLOCK])
{
    const double *o = filter->org, *d = filter->dir;
    for (int i = 0; i < ORACLE_BLOCK; i++) {
        const double cx = bounds->x[i] - o[0], cy = bounds->y[i] - o[1], cz = bounds->z[i] - o[2];
        const double x = cy * d[2] - cz * d[1], y = cz * d[0] - cx * d[2], z = cx * d[1] - cy * d[0];
        const double cc = cx * cx + cy * cy + cz * cz;
        margin[i] = (bounds->rr[i] + MARGIN * cc) * filter->dd - (x * x + y * y + z * z);
    }
}

/* d . (p x q), and a bound of its error: 2^-48 is 32 u, three times the accumulated rounding of three products. */
static double edge(const double d[3], const double p[3], const double q[3], double *error)
{
    const double x = p[1] * q[2] - p[2] * q[1], y = p[2] * q[0] - p[0] * q[2], z = p[0] * q[1] - p[1] * q[0];
    *error = 0x1p-48 * (fabs(d[0]) + fabs(d[1]) + fabs(d[2])) * (fabs(p[0]) + fabs(p[1]) + fabs(p[2])) *
             (fabs(q[0]) + fabs(q[1]) + fabs(q[2]));
    return d[0] * x + d[1] * y + d[2] * z;
}

/* The weights of two vertices certainly have opposite signs. */
static bool passes_beside(const oracle_filter *filter, const float vertex[9])
{
    double p[3][3], error;
    bool positive = false, negative = false;
    for (int i = 0; i < 9; i++)
        p[i / 3][i % 3] = widen(vertex[i]) - filter->org[i % 3];
    for (int i = 0; i < 3; i++) {
        const double w = edge(filter->dir, p[(i + 1) % 3], p[(i + 2) % 3], &error);
        positive |= w > error;
        negative |= w < -error;
    }
    return positive && negative;
}

bool oracle_filter_keeps(const oracle_filter *filter, const oracle_bounds *bounds, uint32_t i,
                         const oracle_primitive *primitive)
{
    const double c[3] = {bounds->x[i] - filter->org[0], bounds->y[i] - filter->org[1], bounds->z[i] - filter->org[2]};
    const double dc = c[0] * filter->dir[0] + c[1] * filter->dir[1] + c[2] * filter->dir[2];
    const double r = sqrt(bounds->rr[i]), distance = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    const double middle = dc / filter->dd, reach = (r + MARGIN * (r + distance)) / filter->length;
    if (middle - reach > filter->t_max || middle + reach < filter->t_min)
        return false;
    return primitive->kind != ORACLE_TRIANGLE || !passes_beside(filter, primitive->data);
}
