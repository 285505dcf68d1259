/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Exact hits of rays and spheres, and verdicts by them. */
#include "support/oracle/truth.h"

#include <math.h>
#include <string.h>

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

static double magnitude(truth_real a) { return fabs((double)a); }

truth_roots truth_sphere(const float org[3], const float dir[3], const float sphere[4])
{
    const quadratic q = make_quadratic(org, dir, sphere);
    const double distance = sqrt((double)q.cc), length = sqrt((double)q.dd), r = sphere[3];
    truth_roots roots = {.hit = q.discriminant >= 0, .h = (double)(q.discriminant / q.dd)};
    roots.doubt_h = 0x1p-49 * (distance + r) * r + 0x1p-96 * distance * distance;
    if (!roots.hit)
        return roots;
    const truth_real root = truth_square_root(q.discriminant), sum = q.dc >= 0 ? q.dc + root : q.dc - root;
    const truth_real large = sum / q.dd, small = sum != 0 ? (q.cc - q.rr) / sum : 0;
    roots.near = q.dc >= 0 ? small : large;
    roots.far = q.dc >= 0 ? large : small;
    /* near the silhouette an error e of h moves the roots by e / (2 sqrt(h)), at most by sqrt(e) */
    const double grazing = roots.doubt_h / fmax(sqrt(roots.h), sqrt(roots.doubt_h));
    const double from_product = 0x1p-51 * (distance * distance + r * r) / fmax(magnitude(sum) / length, 1e-300);
    roots.doubt_t = (0x1p-50 * distance + grazing + fmin(from_product, 0x1p-24 * (distance + r))) / length;
    return roots;
}

bool truth_in_doubt(const truth_roots *roots) { return fabs(roots->h) <= roots->doubt_h; }

static double ulp(float t)
{
    const float a = fabsf(t);
    return a >= 0x1.fffffep127f ? 0x1p104 : (double)nextafterf(a, INFINITY) - a;
}

bool truth_accepts(const truth_roots *roots, truth_real exact, float t)
{
    return magnitude((truth_real)t - exact) <= ulp(t) + roots->doubt_t;
}

bool truth_accepts_strictly(const float org[3], const float dir[3], const float sphere[4], truth_real exact, float t)
{
    const quadratic q = make_quadratic(org, dir, sphere);
    return magnitude((truth_real)t - exact) <= fmax(ulp(t), 0x1p-50 * sqrt((double)(q.cc / q.dd)));
}

/* ---- scenes ---- */

typedef enum answer { NO, PERHAPS, YES } answer;

typedef struct judgement {
    answer hit;
    truth_real t;
    truth_roots roots;
} judgement;

/* A filter in double that rejects clear misses, with a margin of 2^-30 of all operands. */
static bool surely_missed(const truth_ray *ray, const float sphere[4])
{
    const double c[3] = {(double)sphere[0] - ray->org[0], (double)sphere[1] - ray->org[1],
                         (double)sphere[2] - ray->org[2]};
    const double d[3] = {ray->dir[0], ray->dir[1], ray->dir[2]}, r = sphere[3];
    const double x = c[1] * d[2] - c[2] * d[1], y = c[2] * d[0] - c[0] * d[2], z = c[0] * d[1] - c[1] * d[0];
    const double dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    return x * x + y * y + z * z > (r * r + 0x1p-30 * (r * r + cc)) * dd;
}

static bool near_to(truth_real t, float bound, double doubt)
{
    return isfinite(bound) && magnitude(t - (truth_real)bound) <= ulp(bound) + doubt;
}

static bool is_valid(const float sphere[4])
{
    return isfinite(sphere[0]) && isfinite(sphere[1]) && isfinite(sphere[2]) && isfinite(sphere[3]) && sphere[3] >= 0;
}

/* The contract for one sphere: the first root at or after t_min, if it is not beyond t_max, all compared as floats. */
static judgement judge_sphere(const truth_ray *ray, const float sphere[4])
{
    judgement j = {.hit = NO, .t = 0};
    if (!is_valid(sphere) || surely_missed(ray, sphere))
        return j;
    j.roots = truth_sphere(ray->org, ray->dir, sphere);
    const bool doubt = truth_in_doubt(&j.roots);
    if (!j.roots.hit) {
        /* if double finds a hit, it finds a double root at the closest point of the line */
        const quadratic q = make_quadratic(ray->org, ray->dir, sphere);
        j.t = q.dc / q.dd;
        j.roots.doubt_t = sqrt((j.roots.doubt_h + fabs(j.roots.h)) / (double)q.dd) + 0x1p-48 * magnitude(j.t);
        j.hit = doubt ? PERHAPS : NO;
        return j;
    }
    j.t = (float)j.roots.near >= ray->t_min ? j.roots.near : j.roots.far;
    const bool inside = (float)j.t >= ray->t_min && (float)j.t <= ray->t_max;
    const double e = j.roots.doubt_t;
    const bool at_edge = near_to(j.roots.near, ray->t_min, e) || near_to(j.roots.far, ray->t_min, e) ||
                         near_to(j.roots.near, ray->t_max, e) || near_to(j.roots.far, ray->t_max, e);
    j.hit = doubt || at_edge ? PERHAPS : inside ? YES : NO;
    return j;
}

const char *truth_judge(const truth_scene *scene, const truth_ray *ray, uint32_t prim, float t, uint64_t *doubts)
{
    judgement mine = {.hit = NO, .t = INFINITY};
    if (prim != TRUTH_NONE) {
        if (prim >= scene->count)
            return "the sphere does not exist";
        mine = judge_sphere(ray, scene->sphere[prim]);
        if (mine.hit == NO)
            return "the sphere is not hit";
        const bool accepted = truth_accepts(&mine.roots, mine.t, t) ||
                              (mine.hit == PERHAPS && (truth_accepts(&mine.roots, mine.roots.near, t) ||
                                                       truth_accepts(&mine.roots, mine.roots.far, t)));
        if (!accepted)
            return "t is off";
        if (!(t >= ray->t_min && t <= ray->t_max))
            return "t is outside the range";
        *doubts += mine.hit == PERHAPS;
    } else if (t != INFINITY)
        return "no sphere, but a t";
    for (uint32_t i = 0; i < scene->count; i++) {
        if (i == prim)
            continue;
        const judgement other = judge_sphere(ray, scene->sphere[i]);
        if (other.hit == NO)
            continue;
        if (prim == TRUTH_NONE) {
            if (other.hit == YES)
                return "a hit is missed";
            ++*doubts;
        } else if (memcmp(scene->sphere[i], scene->sphere[prim], sizeof scene->sphere[i]) == 0) {
            if (i < prim)
                return "an equal sphere of a lower id wins";
        } else {
            const truth_real nearer = mine.t - other.t;
            if (nearer > 0 && magnitude(nearer) > other.roots.doubt_t + mine.roots.doubt_t) {
                if (other.hit == YES && mine.hit == YES)
                    return "another sphere is closer";
                ++*doubts;
            }
        }
    }
    return NULL;
}
