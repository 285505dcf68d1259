/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Surfaces of hits; see surface.h.
 *
 * Bounds, with e = 2^-53, c the distance from the origin to a sphere's centre, r its radius, h half the chord. The
 * nearest point of the line errs by 8 e c, h^2 = r^2 - |nearest|^2 by 16 e c r + 3 e r^2, so h and the place by 10 e c
 * (r / h + 1), and the normal by that over r: below 2^-30 where c / h and c / r are below 2^18. A triangle's normal is
 * a cross product of edges that err by e: within 6 e of the product of their lengths, over twice the area below 2^-31
 * where that quotient is below 2^18. A mirrored direction errs by four times as much, and a rounding to float adds
 * 2^-25. */
#include "trace/bounce/surface.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool cgt_double_ray_init(const float org[3], const float dir[3], cgt_double_ray *ray)
{
    double zero = 0;
    for (int a = 0; a < 3; a++) {
        ray->org[a] = (double)org[a];
        ray->dir[a] = (double)dir[a];
        zero += ray->org[a] * 0 + ray->dir[a] * 0; /* NaN where one is not finite */
    }
    ray->length = sqrt(dot(ray->dir, ray->dir)); /* squares of denormal floats are normal doubles */
    return zero == 0 && ray->length > 0;
}

/* The roots of a line and a sphere: middle - half and middle + half, half 0 where rounding leaves none. */
static void find_roots(const cgt_sphere *q, const cgt_double_ray *ray, double *middle, double *half)
{
    const double center[3] = {(double)q->x, (double)q->y, (double)q->z}, r = (double)q->r;
    double from[3], nearest[3];
    for (int a = 0; a < 3; a++)
        from[a] = ray->org[a] - center[a];
    const double square = dot(ray->dir, ray->dir);
    *middle = -dot(from, ray->dir) / square;
    for (int a = 0; a < 3; a++)
        nearest[a] = from[a] + *middle * ray->dir[a];
    const double rest = r * r - dot(nearest, nearest);
    *half = rest > 0.0 ? sqrt(rest / square) : 0.0;
}

double cgt_far_root(const cgt_sphere *q, const cgt_double_ray *ray)
{
    double middle, half;
    find_roots(q, ray, &middle, &half);
    const double far = middle + half;
    return far > 0.0 ? far : 0.0;
}

static double sphere_t(const cgt_sphere *q, const cgt_double_ray *ray, float t, double normal[3], bool *front)
{
    const double center[3] = {(double)q->x, (double)q->y, (double)q->z};
    double middle, half;
    find_roots(q, ray, &middle, &half);
    *front = (double)t < middle;
    const double root = *front ? middle - half : middle + half;
    for (int a = 0; a < 3; a++)
        normal[a] = ray->org[a] + root * ray->dir[a] - center[a];
    return root;
}

static double triangle_t(const cgt_triangle *q, const cgt_double_ray *ray, float t, double normal[3], bool *front)
{
    double e[2][3], to[3];
    for (int a = 0; a < 3; a++) {
        e[0][a] = (double)q->v[1][a] - (double)q->v[0][a];
        e[1][a] = (double)q->v[2][a] - (double)q->v[0][a];
        to[a] = (double)q->v[0][a] - ray->org[a];
    }
    for (int a = 0; a < 3; a++)
        normal[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
    const double along = dot(normal, ray->dir), plane = dot(normal, to) / along;
    *front = along < 0.0;
    /* A plane nearly along the ray: t, which is exact but for its rounding, is the better one. */
    return fabs(plane - (double)t) <= 0x1p-20 * fabs((double)t) ? plane : (double)t;
}

double cgt_surface_t(const cgt_primitive *q, const cgt_double_ray *ray, float t, double normal[3], bool *front)
{
    return q->kind == CGT_KIND_SPHERES ? sphere_t(&q->sphere, ray, t, normal, front)
                                       : triangle_t(&q->triangle, ray, t, normal, front);
}

bool cgt_find_surface(const cgt_primitive *q, const cgt_double_ray *ray, float t, cgt_surface *surface)
{
    double *n = surface->normal;
    const double at = cgt_surface_t(q, ray, t, n, &surface->front), length = sqrt(dot(n, n));
    double zero = 0;
    for (int a = 0; a < 3; a++) {
        surface->position[a] = ray->org[a] + at * ray->dir[a];
        n[a] /= length;
        zero += surface->position[a] * 0 + n[a] * 0; /* NaN where one is not finite */
    }
    surface->length = at > 0.0 ? at * ray->length : 0.0;
    return zero == 0;
}

/* The next float above or below a finite one, or from infinity towards 0: as nextafterf, whose call costs more than all
 * else in cgt_round_place. */
static float next_float(float x, bool up)
{
    uint32_t bits;
    if (x == 0.0f)
        return up ? 0x1p-149f : -0x1p-149f;
    memcpy(&bits, &x, sizeof bits);
    bits += (x > 0.0f) == up ? 1u : UINT32_MAX;
    memcpy(&x, &bits, sizeof x);
    return x;
}

void cgt_round_place(const double place[3], const double from[3], float out[3])
{
    for (int a = 0; a < 3; a++) {
        out[a] = (float)place[a];
        if ((double)out[a] > place[a] && from[a] <= place[a])
            out[a] = next_float(out[a], false);
        else if ((double)out[a] < place[a] && from[a] >= place[a])
            out[a] = next_float(out[a], true);
    }
}
