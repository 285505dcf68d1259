/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Surfaces of hits; see surface.h.
 *
 * Bounds, with e = 2^-53, c the distance from the origin to a sphere's centre, r its radius, h half the chord. The
 * nearest point of the line errs by 8 e c, h^2 = r^2 - |nearest|^2 by 16 e c r + 3 e r^2, so h and the place by 10 e c
 * (r / h + 1), and the normal by that over r: below 2^-30 where c / h and c / r are below 2^18. A triangle's normal is
 * a cross product of edges that err by e: within 6 e of the product of their lengths, over twice the area below 2^-31
 * where that quotient is below 2^18. A capsule is met at the sphere around the nearest point of its axis, whose place
 * errs by some e of the distance to the farther end: so the bounds are a sphere's with that for c. All of this is
 * computed from the ray's origin on: far from that of the world, c is still the distance of the two. A mirrored
 * direction errs by four times as much, and a rounding to float adds 2^-25. */
#include "trace/bounce/surface.h"

#include <math.h>

#include "exact/integer/exact.h"
#include "exact/triangle_double.h"

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

static double clamp_share(double s) { return s > 0.0 ? (s < 1.0 ? s : 1.0) : 0.0; }

/* The middle of the sphere on a capsule's axis that the line enters first, side -1, or leaves last, side 1, from the
 * origin of the ray on, as in kernel/primitive/lane_capsules.h. Roots depend on an error of that place in second order
 * alone. */
static void find_middle(const cgt_capsule *q, const cgt_double_ray *ray, double side, double middle[3])
{
    const double r = (double)q->r, square = dot(ray->dir, ray->dir);
    double c[3], n[3], l[3], g[3], s = 0;
    for (int a = 0; a < 3; a++) {
        c[a] = (double)q->p[a] - ray->org[a];
        n[a] = (double)q->q[a] - (double)q->p[a];
    }
    const double start = dot(ray->dir, c) / square, along = dot(ray->dir, n) / square, nn = dot(n, n);
    for (int a = 0; a < 3; a++) { /* what is across the line */
        l[a] = c[a] - start * ray->dir[a];
        g[a] = n[a] - along * ray->dir[a];
    }
    if (nn > 0.0) {
        const double gg = fmax(dot(g, g), nn * 0x1p-80), lg = dot(l, g), rest = r * r - dot(l, l) + lg * lg / gg;
        const double lean = rest > 0.0 ? along * sqrt(rest / gg * (square / nn)) : 0.0;
        s = clamp_share(side * lean - lg / gg);
    }
    for (int a = 0; a < 3; a++)
        middle[a] = c[a] + s * n[a];
}

/* The point of a capsule's axis that is nearest to a place, both from the origin of the ray on. Returns where it is. */
static double find_nearest(const cgt_capsule *q, const cgt_double_ray *ray, const double place[3], double nearest[3])
{
    double c[3], n[3], from[3];
    for (int a = 0; a < 3; a++) {
        c[a] = (double)q->p[a] - ray->org[a];
        n[a] = (double)q->q[a] - (double)q->p[a];
        from[a] = place[a] - c[a];
    }
    const double nn = dot(n, n), s = nn > 0.0 ? clamp_share(dot(from, n) / nn) : 0.0;
    for (int a = 0; a < 3; a++)
        nearest[a] = c[a] + s * n[a];
    return s;
}

/* The middle of a sphere, or of the one that stands for a capsule on that side, from the origin of the ray on; *r: its
 * radius. */
static void find_sphere(const cgt_primitive *q, const cgt_double_ray *ray, double side, double middle[3], double *r)
{
    const bool sphere = q->kind == CGT_KIND_SPHERES;
    *r = (double)(sphere ? q->sphere.r : q->capsule.r);
    middle[0] = (double)q->sphere.x - ray->org[0];
    middle[1] = (double)q->sphere.y - ray->org[1];
    middle[2] = (double)q->sphere.z - ray->org[2];
    if (!sphere)
        find_middle(&q->capsule, ray, side, middle);
}

/* The roots of a line and a sphere: middle - half and middle + half, half 0 where rounding leaves none. */
static void find_roots(const double center[3], double r, const cgt_double_ray *ray, double *middle, double *half)
{
    double nearest[3];
    const double square = dot(ray->dir, ray->dir);
    *middle = dot(center, ray->dir) / square;
    for (int a = 0; a < 3; a++)
        nearest[a] = *middle * ray->dir[a] - center[a];
    const double rest = r * r - dot(nearest, nearest);
    *half = rest > 0.0 ? sqrt(rest / square) : 0.0;
}

/* Of a sphere or a capsule: the root on a side. */
static double find_root(const cgt_primitive *q, const cgt_double_ray *ray, double side, double *middle)
{
    double center[3], r, half;
    find_sphere(q, ray, side, center, &r);
    find_roots(center, r, ray, middle, &half);
    return *middle + side * half;
}

double cgt_far_root(const cgt_primitive *q, const cgt_double_ray *ray)
{
    double middle;
    const double far = find_root(q, ray, 1, &middle);
    return far > 0.0 ? far : 0.0;
}

static double round_t(const cgt_primitive *q, const cgt_double_ray *ray, float t, bounce_surface *surface)
{
    double middle, center[3], place[3], r;
    double root = find_root(q, ray, -1, &middle), far_middle;
    if (q->kind == CGT_KIND_CAPSULES)
        middle = 0.5 * (root + find_root(q, ray, 1, &far_middle));
    surface->front = (double)t < middle;
    if (!surface->front)
        root = find_root(q, ray, 1, &far_middle);
    for (int a = 0; a < 3; a++)
        place[a] = root * ray->dir[a];
    surface->u = 0;
    if (q->kind == CGT_KIND_CAPSULES)
        surface->u = find_nearest(&q->capsule, ray, place, center);
    else
        find_sphere(q, ray, 0, center, &r);
    for (int a = 0; a < 3; a++)
        surface->normal[a] = place[a] - center[a];
    return root;
}

/* Whether a ray comes from where a triangle's normal points to, `along` being its direction times the normal, which
 * errs by 10 e of the product of all lengths (triangle_double.h). */
static bool is_front(const cgt_triangle *q, const cgt_double_ray *ray, double along, const double e[2][3])
{
    double size[3] = {0, 0, 0};
    cgt_exact_ray line;
    for (int a = 0; a < 3; a++) {
        size[0] += fabs(e[0][a]);
        size[1] += fabs(e[1][a]);
        size[2] += fabs(ray->dir[a]);
        line.org[a] = (float)ray->org[a];
        line.dir[a] = (float)ray->dir[a];
    }
    if (fabs(along) > CGT_TRIANGLE_DOUBLE_ERROR * size[0] * size[1] * size[2])
        return along < 0;
    return cgt_exact_triangle_side(&line, q) < 0;
}

static double triangle_t(const cgt_triangle *q, const cgt_double_ray *ray, float t, bounce_surface *surface)
{
    double e[2][3], to[3], *normal = surface->normal;
    for (int a = 0; a < 3; a++) {
        e[0][a] = (double)q->v[1][a] - (double)q->v[0][a];
        e[1][a] = (double)q->v[2][a] - (double)q->v[0][a];
        to[a] = (double)q->v[0][a] - ray->org[a];
    }
    for (int a = 0; a < 3; a++)
        normal[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
    const double along = dot(normal, ray->dir), plane = dot(normal, to) / along;
    surface->front = is_front(q, ray, along, (const double(*)[3])e);
    surface->u = 0;
    /* A plane nearly along the ray: t, which is exact but for its rounding, is the better one. */
    return fabs(plane - (double)t) <= 0x1p-20 * fabs((double)t) ? plane : (double)t;
}

double cgt_surface_t(const cgt_primitive *q, const cgt_double_ray *ray, float t, bounce_surface *surface)
{
    return q->kind == CGT_KIND_TRIANGLES ? triangle_t(&q->triangle, ray, t, surface) : round_t(q, ray, t, surface);
}

bool cgt_find_surface(const cgt_primitive *q, const cgt_double_ray *ray, float t, bounce_surface *surface)
{
    double *n = surface->normal;
    const double at = cgt_surface_t(q, ray, t, surface), length = sqrt(dot(n, n));
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
