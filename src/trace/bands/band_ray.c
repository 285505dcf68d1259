/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays, points, lights and cameras to a band's units, hits back, and decisions for rays as given. */
#include "trace/bands/band_ray.h"

#include <float.h>
#include <math.h>

#include "exact/triangle_double.h"

/* ---- the box ---- */

/* Slabs in double. Differences of doubles that are floats times powers of two are below 2^131 and err by 2^-53 of
 * themselves; a quotient by as much again: 2^-51 covers both. Quotients are at most 2^280. t is rounded to float before
 * it counts, which the margins of the range cover: half an ulp, at least 2^-150. */
bool cgt_band_misses_box(const cgt_band *band, const cgt_ray *ray, double t_end)
{
    const double begin = (double)ray->t_min;
    double near = begin - fabs(begin) * 0x1p-20 - 0x1p-149, far = t_end + fabs(t_end) * 0x1p-20 + 0x1p-149;
    for (int a = 0; a < 3; a++) {
        const double o = (double)ray->line.org[a], d = (double)ray->line.dir[a];
        const double low = band->low[a], high = band->high[a];
        if (d == 0) {
            if (o < low || o > high)
                return true;
            continue;
        }
        const double first = (d > 0 ? low - o : high - o) / d, last = (d > 0 ? high - o : low - o) / d;
        near = fmax(near, first - fabs(first) * 0x1p-51);
        far = fmin(far, last + fabs(last) * 0x1p-51);
    }
    return near > far;
}

/* ---- scaling ---- */

bool cgt_band_scale(const float v[3], int exponent, float scaled[3])
{
    const double factor = cgt_power_of_two(exponent);
    bool exact = true;
    for (int a = 0; a < 3; a++) {
        const double product = (double)v[a] * factor;
        scaled[a] = (float)product; /* infinite where it leaves the range: not exact then */
        exact &= (double)scaled[a] == product;
    }
    return exact;
}

static float round_down(double v)
{
    const float f = v < -(double)FLT_MAX ? -FLT_MAX : v > (double)FLT_MAX ? FLT_MAX : (float)v;
    return (double)f > v ? nextafterf(f, -INFINITY) : f;
}

static float round_up(double v) { return -round_down(-v); }

void cgt_band_scale_range(float t_min, float t_max, int x, float *scaled_min, float *scaled_max)
{
    const double factor = cgt_power_of_two(x);
    *scaled_min = t_min;
    *scaled_max = t_max;
    if (!x)
        return;
    /* t that rounds to an end is within half an ulp of it, or 2^-150. Larger powers take 0 with them: below, a t' that
     * rounds to 0 does so although its t does not, which only widens the range. */
    const double low = (double)t_min, high = t_max > FLT_MAX ? (double)FLT_MAX : (double)t_max;
    if (x > 0 || t_min != 0)
        *scaled_min = round_down((low - fabs(low) * 0x1p-24 - 0x1p-150) * factor);
    if (x < 0 || t_max <= FLT_MAX)
        *scaled_max = round_up((high + fabs(high) * 0x1p-24 + 0x1p-150) * factor);
}

static int exponent_of(const float v[3])
{
    float longest = 0;
    int exponent;
    for (int a = 0; a < 3; a++)
        longest = fabsf(v[a]) > longest ? fabsf(v[a]) : longest;
    frexpf(longest, &exponent);
    return exponent;
}

static bool scale_direction(const float dir[3], int k, int dir_exponent, float scaled[3], int *q)
{
    const int length = exponent_of(dir), least = -dir_exponent - length, most = dir_exponent - length;
    *q = k < least ? least : k > most ? most : k;
    if (cgt_band_scale(dir, *q, scaled))
        return true;
    *q = most; /* components far smaller than the longest may fit if all are larger */
    return cgt_band_scale(dir, *q, scaled);
}

cgt_band_state cgt_band_scale_ray(const cgt_band *band, const cgt_ray *ray, double t_end, int dir_exponent,
                                  cgt_scaled_ray *s)
{
    int q = 0;
    bool near = true;
    const bool fits = cgt_band_scale(ray->line.org, band->exponent, s->org) &&
                      scale_direction(ray->line.dir, band->exponent, dir_exponent, s->dir, &q);
    for (int a = 0; a < 3; a++)
        near &= fabsf(s->org[a]) <= CGT_BAND_MAX_ORG;
    /* what is slow is worth a test in double before */
    if (!(fits && near) && cgt_band_misses_box(band, ray, t_end))
        return CGT_BAND_MISSED;
    if (!fits)
        return CGT_BAND_AS_GIVEN;
    s->exponent = band->exponent - q;
    cgt_band_scale_range(ray->t_min, ray->t_max, s->exponent, &s->t_min, &s->t_max);
    if (t_end < (double)ray->t_max) {
        const float end = round_up(t_end * cgt_power_of_two(s->exponent));
        s->t_max = end < s->t_max ? end : s->t_max;
    }
    return s->t_min <= s->t_max ? CGT_BAND_SCALED : CGT_BAND_MISSED;
}

/* ---- what a ray skips ---- */

void cgt_band_scale_skip(const cgt_band *band, uint32_t skip, uint32_t *primitive, uint32_t *geometry)
{
    const cgt_primitives *prims = &band->scene->committed_scene.prims;
    const uint32_t *from = band->number.data;
    /* a primitive's place is at most its number, and near that where few are in other bands */
    uint32_t low = 0, high = skip < band->count ? skip + 1 : band->count, step = 1;
    *primitive = *geometry = CGT_INVALID_ID;
    while (high > step && from[high - step] > skip) {
        high -= step;
        step *= 2;
    }
    low = high > step ? high - step : 0;
    while (skip != CGT_INVALID_ID && low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (from[middle] < skip)
            low = middle + 1;
        else
            high = middle;
    }
    if (skip == CGT_INVALID_ID || low == band->count || from[low] != skip)
        return;
    const cgt_primitive_array *a = cgt_primitives_array(prims, low);
    *primitive = low - a->first;
    *geometry = a->geometry;
}

/* ---- points against a light ---- */

bool cgt_band_scale_point(const cgt_band *band, const cgt_ray *ray, cgt_scaled_ray *r)
{
    if (!cgt_band_scale(ray->line.org, band->exponent, r->org))
        return false;
    for (int a = 0; a < 3; a++) {
        if (fabsf(r->org[a]) > CGT_BAND_MAX_ORG)
            return false;
        r->dir[a] = 0;
    }
    r->t_min = ray->t_min;
    r->t_max = ray->t_max;
    r->exponent = 0;
    return true;
}

bool cgt_band_scale_light(const cgt_band *band, const cgt_light *light, cgt_light *scaled)
{
    if (!light || light->kind != CGT_LIGHT_POINT)
        return false;
    *scaled = *light;
    bool fits = cgt_band_scale(light->position, band->exponent, scaled->position);
    for (int a = 0; a < 3; a++)
        fits &= fabsf(scaled->position[a]) <= CGT_BAND_MAX_ORG;
    return fits;
}

/* ---- cameras ---- */

/* Whether the products and sums that make an orthographic camera's origins round alike in both units: no product of a
 * component and a pixel's coordinate, which is 0 or at least 2^-24 and at most 1, leaves the normal floats. Sums of
 * floats are exact where they are small. */
static bool component_commutes(float v) { return v == 0 || (fabsf(v) >= 0x1p-100f && fabsf(v) <= 0x1p100f); }

static bool scale_axis(const float v[3], int exponent, float scaled[3])
{
    bool fits = cgt_band_scale(v, exponent, scaled);
    for (int a = 0; a < 3; a++)
        fits &= component_commutes(v[a]) && component_commutes(scaled[a]);
    return fits;
}

/* The distance between a point and the axis of a sphere or a capsule, and what bounds its error: in double, by far less
 * than 2^-40 of that. */
static double axis_distance(const cgt_capsule *q, const float point[3], double *length)
{
    double c[3], n[3], nn = 0, cn = 0, square = 0;
    *length = (double)q->r;
    for (int a = 0; a < 3; a++) {
        c[a] = (double)point[a] - (double)q->p[a];
        n[a] = (double)q->q[a] - (double)q->p[a];
        nn += n[a] * n[a];
        cn += c[a] * n[a];
        *length += fabs(c[a]) + fabs(n[a]);
    }
    const double s = cn > 0 ? (cn < nn ? cn / nn : 1) : 0;
    for (int a = 0; a < 3; a++)
        square += (c[a] - s * n[a]) * (c[a] - s * n[a]);
    return sqrt(square);
}

/* Whether no surface of the band is so near to the eye that a t below 0, which the band would not report, might still
 * round to 0 in the caller's units: -2^-150 and more, times 2^k. zone: that distance. Surfaces are bounded in double,
 * by far less than the 2^-40 of lengths that are left for it here. */
static bool eye_is_clear(const cgt_band *band, const float eye[3], double zone)
{
    static const float axes[3] = {1, 1, 1};
    const cgt_committed_scene *c = &band->scene->committed_scene;
    bool outside = false;
    for (int a = 0; a < 3; a++)
        outside |= (double)eye[a] + zone < (double)c->low[a] || (double)eye[a] - zone > (double)c->high[a];
    for (uint32_t i = 0; !outside && i < c->prims.arrays; i++) {
        const cgt_primitive_array *array = &c->prims.array[i];
        for (uint32_t k = 0; k < array->count; k++) {
            const cgt_primitive q = cgt_array_primitive(array, k);
            const cgt_sphere s = q.sphere;
            if (q.kind != CGT_KIND_TRIANGLES) {
                const cgt_capsule round =
                    q.kind == CGT_KIND_CAPSULES ? q.capsule : (cgt_capsule){{s.x, s.y, s.z}, {s.x, s.y, s.z}, s.r};
                double length;
                const double distance = axis_distance(&round, eye, &length);
                if (!(fabs(distance - (double)round.r) > zone + length * 0x1p-40))
                    return false;
            } else {
                const cgt_triangle_plane p = cgt_triangle_double_plane(eye, axes, &q.triangle);
                const double normal = fabs(p.n[0]) + fabs(p.n[1]) + fabs(p.n[2]) + p.den_error;
                if (!(fabs(p.num) - p.num_error > zone * normal))
                    return false;
            }
        }
    }
    return true;
}

/* The same for the origins of an orthographic camera: whether all lie outside the band's bounds. */
static bool origins_are_clear(const cgt_band *band, const cgt_camera_rays *c, double zone)
{
    const cgt_committed_scene *scene = &band->scene->committed_scene;
    for (int a = 0; a < 3; a++) {
        const double reach = (fabs((double)c->right[a]) + fabs((double)c->up[a])) * (1 + 0x1p-20) + zone +
                             fabs((double)c->eye[a]) * 0x1p-20;
        if ((double)c->eye[a] + reach < (double)scene->low[a] || (double)c->eye[a] - reach > (double)scene->high[a])
            return true;
    }
    return false;
}

static bool range_is_clear(const cgt_band *band, const cgt_camera_rays *c)
{
    double length = 0;
    if (c->t_min != 0 || band->exponent <= 0)
        return true;
    for (int a = 0; a < 3; a++)
        length += fabs((double)c->fwd[a]) + (c->orthographic ? 0 : fabs((double)c->right[a]) + fabs((double)c->up[a]));
    const double zone = cgt_power_of_two(band->exponent - 149) * length;
    return c->orthographic ? origins_are_clear(band, c, zone) : eye_is_clear(band, c->eye, zone);
}

bool cgt_band_scale_camera(const cgt_band *band, const cgt_camera_rays *from, cgt_camera_rays *c)
{
    *c = *from;
    bool fits = cgt_band_scale(from->eye, band->exponent, c->eye);
    if (from->orthographic)
        fits = fits && scale_axis(from->right, band->exponent, c->right) && scale_axis(from->up, band->exponent, c->up);
    for (int a = 0; a < 3; a++)
        fits = fits && fabsf(c->eye[a]) <= CGT_BAND_MAX_ORG;
    cgt_band_scale_range(from->t_min, from->t_max, band->exponent, &c->t_min, &c->t_max);
    if (from->t_min == 0)
        c->t_min = 0;
    return fits && range_is_clear(band, c);
}

/* ---- deciding ---- */

double cgt_band_end(const cgt_ray *ray, const cgt_band_best *best)
{
    const double end = (double)ray->t_max;
    if (best->prim == CGT_INVALID_ID)
        return end;
    const double t = best->t + fabs(best->t) * 0x1p-18 + 0x1p-148;
    return t < end ? t : end;
}

/* Whether a ray must not find a primitive. */
static bool skips(const cgt_primitives *prims, const cgt_band_ray *ray, uint32_t prim)
{
    return prim == ray->skip || (ray->mask != UINT32_MAX && !(ray->mask & cgt_primitives_array(prims, prim)->mask));
}

/* Whether a hit, canonical or within 2^-20, beats the best one: by its t, then by the lower number. */
static bool is_closer(const cgt_primitives *prims, const cgt_ray *ray, uint32_t prim, double t,
                      const cgt_band_best *best, cgt_counts *counts)
{
    if (best->prim == CGT_INVALID_ID)
        return true;
    if (fabs(t - best->t) > 0x1p-19 * (fabs(t) + fabs(best->t)))
        return t < best->t;
    cgt_decided_hit a = {.primitive = cgt_primitives_get(prims, prim)},
                    b = {.primitive = cgt_primitives_get(prims, best->prim)};
    uint64_t exact = 0;
    cgt_decide_t(ray, &a);
    const bool is_before = cgt_decide_is_closer(ray, prim, &a, best->prim, &b, &exact);
    counts->ray_tests++; /* the order of two hits counts as a test */
    counts->double_tests++;
    counts->exact_tests += exact != 0;
    return is_before;
}

void cgt_band_decide(const cgt_primitives *prims, const uint32_t *number, uint32_t count, const cgt_band_ray *ray,
                     bool any_hit, cgt_band_best *best, cgt_counts *counts)
{
    for (uint32_t i = 0; i < count; i++) {
        if (skips(prims, ray, number[i]))
            continue;
        cgt_decided_hit hit = {.primitive = cgt_primitives_get(prims, number[i])};
        uint64_t exact = 0;
        const bool is_hit = cgt_decide_hit(&ray->ray, &hit, &exact);
        counts->ray_tests++;
        counts->double_tests++;
        counts->exact_tests += exact != 0;
        if (!is_hit || !is_closer(prims, &ray->ray, number[i], hit.t, best, counts))
            continue;
        *best = (cgt_band_best){number[i], hit.t};
        if (any_hit)
            return;
    }
}

void cgt_band_accept(const cgt_primitives *prims, const cgt_band *band, const cgt_band_ray *ray, uint32_t prim,
                     float scaled_t, int exponent, cgt_band_best *best, cgt_counts *counts)
{
    double t = (double)scaled_t * cgt_power_of_two(-exponent);
    if (!cgt_band_t_is_plain((double)scaled_t, t, ray->ray.t_min, ray->ray.t_max)) {
        cgt_decided_hit hit = {.primitive = cgt_primitives_get(prims, prim)};
        cgt_decide_t(&ray->ray, &hit);
        const float rounded = (float)hit.t;
        /* where it is a sphere's second root, the band may have found the first one, before another hit */
        if (hit.far || !(rounded >= ray->ray.t_min && rounded <= ray->ray.t_max && fabsf(rounded) < INFINITY)) {
            cgt_band_decide(prims, band->number.data, band->count, ray, false, best, counts);
            return;
        }
        t = hit.t;
    }
    if (is_closer(prims, &ray->ray, prim, t, best, counts))
        *best = (cgt_band_best){prim, t};
}
