/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that the bounds of single precision do not cover, moved to where they do: origins from afar, directions of any
 * length. With o and d the ray's, S the scene's scale, a power of two that brings coordinates to at most 2, and 2^k <=
 * the largest |d_a| < 2^(k+1),
 *   O = S o   D = 2^-k d   T = s t, s = 2^k S   and then   O' = O + M D   T' = T - M
 * the same line, its origin moved to where it passes the middle of the scene's bounds, or to where it is at a given t,
 * M = s t. Hits are decided on the ray as it was given; this one finds what there is to decide.
 *
 * Exactness. O, D and s are exact in double: exponents are within -277 and 189. M is a sum of numbers of 24 bits: each
 * times D is exact, 48 bits, and so is the sum of two doubles as a pair of them (Knuth, "The Art of Computer
 * Programming", volume 2, 4.2.2; Moeller 1965). A pair's lower part loses a rounding in rare cases, which is computed
 * and added up in `lost`. An M of 24 bits leaves 2^-23 of the way, so that a few steps lead from any float to within 1
 * of the foot of the middle. Where |O'| is large after that, the ray misses the scene.
 *
 * Origins are rounded to float for vectors: off by what that and `lost` sum up to in the 1-norm, E. E / u is added to
 * the distance that errors of primitives grow with (lane_tests.h), since these may lie at the origin; components of D
 * below the range of float lose 2^-126 |T'| of it, which 2^-90 covers, with |T'| below 2^8 where there is anything.
 * Boxes need nothing: each component is off by u / 2 of itself and 2^-90, which their slack holds (bvh_ray.h). A pair's
 * lower part is at most 2^-53 of the upper one. Sums of long steps have fewer bits than a pair, so that hardly anything
 * is ever lost.
 *
 * Ranges. t is rounded to float before it is compared: by 2^-24 |t| and 2^-149, and by 2^-30 |t| before. So t counts
 * surely from t_min + m on and surely not before t_min - m, m = 2^-21 |t_min| + 2^-147; likewise t_max, which is at
 * most the largest float. Sums of M lose 2^-49 |M| at most. Ends are rounded outwards, or inwards, to float. */
#ifndef CGT_MOVED_RAY_H
#define CGT_MOVED_RAY_H

#include <float.h>
#include <math.h>
#include <string.h>

#include "exact/decide.h"
#include "model/committed_scene.h"

#define MOVED_NEAR 16. /* origins up to here stay where they are */
#define MOVED_STEPS 16 /* more than enough, from any float */
#define MOVED_MAX_LOST 0x1p-90
#define MOVED_END 0x1p100 /* no ray meets anything beyond */

typedef struct moved_ray {
    double org[3], dir[3]; /* O', D */
    double rdir[3];        /* 1 / D */
    double org_error[3];   /* of org, as doubles */
    double speed, way;     /* s, M */
    double near, far;      /* T', where the ray may be within the scene's bounds */
    float start[3];        /* org as floats */
    float start_error;     /* E, the sum over the axes */
    float near_out, near_in, far_in, far_out;
} moved_ray;

typedef enum moved_state {
    MOVED_MISS, /* certainly */
    MOVED_READY,
    MOVED_TOO_FAR /* the origin is not known well enough */
} moved_state;

/* ---- origin ---- */

/* *sum + x as a rounded sum, and returns what that lost, exactly. */
static inline double moved_add(double *sum, double x)
{
    const double a = *sum, rounded = a + x, back = rounded - a;
    *sum = rounded;
    return (a - (rounded - back)) + (x - back);
}

/* Cuts a number to its first 24 bits. */
static inline double moved_cut(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits &= ~(((uint64_t)1 << 29) - 1);
    memcpy(&x, &bits, sizeof bits);
    return x;
}

/* Moves the origin by a way of at most 24 bits. */
static inline void moved_ray_step(moved_ray *r, double step, double lower[3], double lost[3])
{
    for (int a = 0; a < 3; a++) {
        const double rest = moved_add(&r->org[a], step * r->dir[a]);
        lost[a] += fabs(moved_add(&lower[a], rest));
        lower[a] = moved_add(&r->org[a], lower[a]);
    }
    r->way += step;
}

/* Moves the origin next to `middle`. */
static inline void moved_ray_approach(moved_ray *r, const double middle[3], double lower[3], double lost[3])
{
    const double rsquare = 1 / (r->dir[0] * r->dir[0] + r->dir[1] * r->dir[1] + r->dir[2] * r->dir[2]);
    for (int i = 0; i < MOVED_STEPS; i++) {
        double along = 0;
        for (int a = 0; a < 3; a++)
            along += (middle[a] - r->org[a]) * r->dir[a];
        const double step = moved_cut(along * rsquare);
        if (fabs(step) < 1)
            return;
        moved_ray_step(r, step, lower, lost);
    }
}

/* Sets origin and direction, and their errors. at: the t to which the origin is moved, or NULL. */
static inline void moved_ray_set_line(moved_ray *r, const cgt_ray *ray, const double low[3], const double high[3],
                                      double scale, const float *at)
{
    double lower[3] = {0, 0, 0}, lost[3] = {0, 0, 0}, middle[3];
    float longest = 0;
    int exponent;
    bool far = false;
    for (int a = 0; a < 3; a++)
        longest = fabsf(ray->line.dir[a]) > longest ? fabsf(ray->line.dir[a]) : longest;
    frexp((double)longest, &exponent); /* 2^exponent is twice 2^k */
    const double unit = ldexp(1, 1 - exponent);
    for (int a = 0; a < 3; a++) {
        r->org[a] = (double)ray->line.org[a] * scale;
        r->dir[a] = (double)ray->line.dir[a] * unit;
        r->rdir[a] = r->dir[a] == 0 ? 0 : 1 / r->dir[a];
        middle[a] = 0.5 * (low[a] + high[a]);
        far |= !(fabs(r->org[a]) <= MOVED_NEAR);
    }
    r->speed = scale / unit;
    r->way = 0;
    if (at)
        moved_ray_step(r, (double)*at * r->speed, lower, lost);
    else if (far)
        moved_ray_approach(r, middle, lower, lost);
    for (int a = 0; a < 3; a++)
        r->org_error[a] = (fabs(lower[a]) + lost[a]) * (1 + 0x1p-20);
}

/* The origin in float. */
static inline void moved_ray_round(moved_ray *r)
{
    double sum = 0;
    for (int a = 0; a < 3; a++) {
        r->start[a] = (float)r->org[a];
        sum += fabs(r->org[a] - (double)r->start[a]) + r->org_error[a];
    }
    r->start_error = (float)(sum * (1 + 0x1p-20)) + 0x1p-114f;
}

/* ---- range ---- */

/* An end of the range, moved by its error and by `sign` of it, so that it stays on that side in float. */
static inline float moved_end(double end, double error, double sign)
{
    const double wide = end + sign * (error + fabs(end) * 0x1p-22 + 0x1p-120);
    return (float)(wide > MOVED_END ? MOVED_END : wide < -MOVED_END ? -MOVED_END : wide);
}

static inline void moved_ray_set_range(moved_ray *r, float t_min, float t_max)
{
    const double first = t_min < -FLT_MAX ? -FLT_MAX : (double)t_min, last = t_max > FLT_MAX ? FLT_MAX : (double)t_max;
    const double way_error = fabs(r->way) * 0x1p-48;
    const double first_error = (fabs(first) * 0x1p-21 + 0x1p-147) * r->speed + way_error;
    const double last_error = (fabs(last) * 0x1p-21 + 0x1p-147) * r->speed + way_error;
    const double begin = first * r->speed - r->way, end = last * r->speed - r->way;
    r->near_out = moved_end(begin, first_error, -1);
    r->near_in = moved_end(begin, first_error, 1);
    r->far_in = moved_end(end, last_error, -1);
    r->far_out = moved_end(end, last_error, 1);
}

/* ---- bounds ---- */

/* Narrows [near, far] to where the ray may be between two planes across an axis; false: nowhere. Planes are moved
 * outwards by the origin's error and by more than a difference of them loses, T' by more than a reciprocal and a
 * product do. */
static inline bool moved_ray_clip(const moved_ray *r, int a, double low, double high, double *near, double *far)
{
    const double pad = r->org_error[a] + (fabs(r->org[a]) + fabs(low) + fabs(high)) * 0x1p-50;
    const double to_low = low - pad - r->org[a], to_high = high + pad - r->org[a];
    if (r->dir[a] == 0)
        return to_low <= 0 && to_high >= 0;
    const double t0 = to_low * r->rdir[a], t1 = to_high * r->rdir[a], first = t0 < t1 ? t0 : t1,
                 last = t0 < t1 ? t1 : t0;
    const double enter = first - fabs(first) * 0x1p-50, leave = last + fabs(last) * 0x1p-50;
    *near = enter > *near ? enter : *near;
    *far = leave < *far ? leave : *far;
    return *near <= *far;
}

/* Whether the origin is near the scene, and known well enough. */
static inline bool moved_ray_is_known(const moved_ray *r)
{
    bool known = true;
    for (int a = 0; a < 3; a++)
        known =
            known && fabs(r->org[a]) <= 2 * MOVED_NEAR && r->org_error[a] <= fabs(r->org[a]) * 0x1p-52 + MOVED_MAX_LOST;
    return known;
}

/* Moves a valid ray's origin to where it is at a t; NULL: next to the scene, if it is far from there. */
static inline moved_state moved_ray_init_at(moved_ray *r, const cgt_committed_scene *committed_scene,
                                            const cgt_ray *ray, const float *at)
{
    const double scale = (double)committed_scene->scale;
    double low[3], high[3];
    for (int a = 0; a < 3; a++) {
        low[a] = (double)committed_scene->low[a] * scale;
        high[a] = (double)committed_scene->high[a] * scale;
    }
    if (ray->t_min > FLT_MAX || ray->t_max < -FLT_MAX || !(ray->t_min <= ray->t_max))
        return MOVED_MISS;
    moved_ray_set_line(r, ray, low, high, scale, at);
    moved_ray_set_range(r, ray->t_min, ray->t_max);
    r->near = r->near_out;
    r->far = r->far_out;
    const bool is_known = moved_ray_is_known(r);
    if (at && !is_known) /* far from the scene, which may lie beyond MOVED_END of there */
        return MOVED_TOO_FAR;
    for (int a = 0; a < 3; a++)
        if (!moved_ray_clip(r, a, low[a], high[a], &r->near, &r->far))
            return MOVED_MISS;
    if (!is_known)
        return MOVED_TOO_FAR;
    moved_ray_round(r);
    return MOVED_READY;
}

static inline moved_state moved_ray_init(moved_ray *r, const cgt_committed_scene *committed_scene, const cgt_ray *ray)
{
    return moved_ray_init_at(r, committed_scene, ray, NULL);
}

#endif
