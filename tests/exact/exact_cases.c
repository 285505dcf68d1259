/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The families of exact_cases.h. */
#include "exact/exact_cases.h"

#include <math.h>
#include <string.h>

const char *exact_family_name(exact_family family)
{
    static const char *const name[EXACT_FAMILIES] = {"ordinary", "far",      "grid",   "places", "aimed",
                                                     "alike",    "close",    "spread", "scales", "any",
                                                     "ends",     "denormal", "least"};
    return name[family];
}

bool exact_meets(const cgt_exact_ray *ray, const cgt_primitive *primitive)
{
    cgt_capsule_part part[2];
    return primitive->kind == CGT_KIND_SPHERES    ? cgt_exact_sphere_roots(ray, primitive->sphere) > 0
           : primitive->kind == CGT_KIND_CAPSULES ? cgt_exact_capsule_roots(ray, &primitive->capsule, part) > 0
                                                  : cgt_exact_line_hits_triangle(ray, &primitive->triangle);
}

/* ---- Numbers ---- */

static float signed_log(test_random *r, float low, float high)
{
    const float size = random_log(r, low, high);
    return random_below(r, 2) ? -size : size;
}

static float with_exponent(test_random *r, uint32_t exponent)
{
    const uint32_t bits = ((uint32_t)random_bits(r) & 0x807fffff) | exponent << 23;
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static float position(test_random *r, exact_family family)
{
    switch (family) {
    case EXACT_GRID:
    case EXACT_PLACES: return (float)random_below(r, 33) / 4 - 4;
    case EXACT_SPREAD: return signed_log(r, 1e-3f, 1e6f);
    case EXACT_SCALES: return signed_log(r, 0x1p-60f, 0x1p60f);
    case EXACT_ANY: return with_exponent(r, random_below(r, 255));
    case EXACT_ENDS: return with_exponent(r, random_below(r, 2) * 254);
    case EXACT_DENORMAL: return with_exponent(r, random_below(r, 4));
    case EXACT_LEAST: return ldexpf((float)random_below(r, 33) - 16, -149);
    default: return random_float(r, -100, 100);
    }
}

static void fill(test_random *r, exact_family family, float *f, int count)
{
    for (int i = 0; i < count; i++)
        f[i] = random_below(r, 16) ? position(r, family) : 0;
}

/* The float nearest to a number, pulled back into the range. */
static float narrow(double x) { return (float)fmax(-0x1.fffffep127, fmin(0x1.fffffep127, x)); }

/* ---- Rays ---- */

/* A point of the triangle: inside, on an edge or at a vertex. */
static void point_of(test_random *r, const cgt_triangle *triangle, double p[3])
{
    double share[3] = {random_float(r, 0, 1), random_float(r, 0, 1), random_float(r, 0, 1)};
    for (uint32_t i = random_below(r, 3); i > 0; i--)
        share[random_below(r, 3)] = 0;
    const double sum = share[0] + share[1] + share[2];
    for (int a = 0; a < 3; a++) {
        p[a] = 0;
        for (int k = 0; k < 3; k++)
            p[a] += (sum > 0 ? share[k] / sum : 1.0 / 3) * triangle->v[k][a];
    }
}

static void aim(cgt_exact_ray *ray, const double p[3], double length)
{
    for (int a = 0; a < 3; a++)
        ray->dir[a] = narrow((p[a] - ray->org[a]) * length);
}

static void make_ray(test_random *r, exact_family family, exact_case *c)
{
    const bool quarters = family == EXACT_GRID || family == EXACT_PLACES || family == EXACT_LEAST,
               as_is = quarters || family == EXACT_DENORMAL;
    double p[3];
    fill(r, family, c->ray.org, 3);
    if (family == EXACT_ORDINARY)
        for (int a = 0; a < 3; a++)
            c->ray.org[a] /= 10;
    if (family == EXACT_FAR) {
        random_direction(r, c->ray.org);
        for (int a = 0; a < 3; a++)
            c->ray.org[a] *= 1e5f;
    }
    fill(r, family, c->ray.dir, 3);
    point_of(r, &c->primitive[0].triangle, p);
    if (quarters && random_below(r, 2))
        for (int a = 0; a < 3; a++) /* exactly at a vertex: the difference is a float */
            p[a] = c->primitive[0].triangle.v[0][a];
    if (quarters && !random_below(r, 3)) { /* along an axis */
        memset(c->ray.dir, 0, sizeof c->ray.dir);
        c->ray.dir[random_below(r, 3)] = random_below(r, 2) ? -2 : 1;
    } else if (random_below(r, 4) || family == EXACT_AIMED)
        aim(&c->ray, p, as_is ? 1 : random_log(r, 1e-2f, 1));
    if (c->ray.dir[0] == 0 && c->ray.dir[1] == 0 && c->ray.dir[2] == 0)
        c->ray.dir[random_below(r, 3)] = random_below(r, 2) ? 1 : -0x1p-149f;
}

/* ---- Primitives ---- */

/* The radius that makes a sphere touch the line, rounded. */
static float touching(const cgt_exact_ray *ray, cgt_sphere q)
{
    const double c[3] = {(double)q.x - ray->org[0], (double)q.y - ray->org[1], (double)q.z - ray->org[2]};
    double dd = 0, dc = 0, ll = 0;
    for (int a = 0; a < 3; a++) {
        dd += (double)ray->dir[a] * ray->dir[a];
        dc += ray->dir[a] * c[a];
    }
    for (int a = 0; a < 3; a++)
        ll += pow(c[a] - dc / dd * ray->dir[a], 2);
    return (float)sqrt(ll);
}

static float one_ulp_off(test_random *r, float f) { return nextafterf(f, random_below(r, 2) ? INFINITY : -INFINITY); }

static void make_alike(test_random *r, exact_case *c)
{
    c->primitive[1] = c->primitive[0];
    c->primitive[3] = c->primitive[2];
    float(*v)[3] = c->primitive[1].triangle.v;
    const uint32_t turn = random_below(r, 3);
    for (uint32_t k = 0; k < 3; k++)
        memcpy(v[k], c->primitive[0].triangle.v[(k + turn) % 3], sizeof v[k]);
    if (random_below(r, 2)) {
        const uint32_t k = random_below(r, 3), a = random_below(r, 3);
        v[k][a] = one_ulp_off(r, v[k][a]);
    }
    cgt_sphere *q = &c->primitive[3].sphere;
    float *const field[4] = {&q->x, &q->y, &q->z, &q->r};
    float *const f = field[random_below(r, 4)];
    if (random_below(r, 4))
        *f = fabsf(one_ulp_off(r, fabsf(*f)));
}

/* Moves each triangle so that its first vertex or its centre lies at a root of the first sphere. */
static void make_close(test_random *r, exact_case *c)
{
    for (int i = 0; i < 2; i++) {
        const double t = cgt_exact_t(&c->ray, &(cgt_exact_root){&c->primitive[2], i > 0});
        const bool vertex = !random_below(r, 4);
        float(*v)[3] = c->primitive[i].triangle.v;
        for (int a = 0; a < 3; a++) {
            const double at = vertex ? v[0][a] : ((double)v[0][a] + v[1][a] + v[2][a]) / 3;
            for (int k = 0; k < 3; k++)
                v[k][a] = narrow(v[k][a] + c->ray.org[a] + t * c->ray.dir[a] - at);
        }
    }
    c->primitive[3] = c->primitive[2];
    if (random_below(r, 2))
        c->primitive[3].sphere.r = one_ulp_off(r, c->primitive[3].sphere.r);
}

static void make_sphere(test_random *r, exact_family family, cgt_primitive *primitive)
{
    float f[4];
    primitive->kind = CGT_KIND_SPHERES;
    fill(r, family, f, 4);
    primitive->sphere = (cgt_sphere){f[0], f[1], f[2], fabsf(f[3])};
}

/* Touches the line exactly where the line is parallel to an axis: the centre is displaced along another axis. */
static void make_tangent(test_random *r, const cgt_exact_ray *ray, cgt_sphere *q)
{
    float *const centre[3] = {&q->x, &q->y, &q->z};
    const uint32_t same = random_below(r, 3);
    if (ray->dir[same] == 0)
        *centre[same] = ray->org[same];
    q->r = touching(ray, *q);
}

/* A triangle spanning many orders of magnitude, and a second triangle in the same place. */
static void make_places(test_random *r, exact_case *c)
{
    float *const vertex = c->primitive[0].triangle.v[2];
    const int power = random_below(r, 2) ? -32 : -70;
    for (int a = 0; a < 3; a++)
        vertex[a] = ldexpf(vertex[a], power);
    const int step = random_below(r, 2) ? 1 : 2; /* vertices rotated, or flipped */
    for (int k = 0; k < 3; k++)
        memcpy(c->primitive[1].triangle.v[k], c->primitive[0].triangle.v[(step * k + 1) % 3],
               sizeof c->primitive[1].triangle.v[k]);
}

/* Between two points of the first triangle, or from a sphere, so that rays that aim at those hit it; the second one is
 * often the first with its ends exchanged, or goes on from its end. */
static void make_capsules(test_random *r, exact_family family, exact_case *c)
{
    for (int i = 4; i < 6; i++) {
        const cgt_sphere s = c->primitive[random_below(r, 2) ? 2 : 3].sphere;
        const float centre[3] = {s.x, s.y, s.z};
        cgt_capsule q;
        memcpy(q.p, random_below(r, 2) ? centre : c->primitive[0].triangle.v[0], sizeof q.p);
        memcpy(q.q, c->primitive[0].triangle.v[1 + random_below(r, 2)], sizeof q.q);
        q.r = random_below(r, 8) ? s.r : 0;
        if (random_below(r, 16) == 0)
            memcpy(q.q, q.p, sizeof q.q);
        if (i == 5 && random_below(r, 2)) {
            memcpy(q.p, c->primitive[4].capsule.q, sizeof q.p);
            if (random_below(r, 2))
                memcpy(q.q, c->primitive[4].capsule.p, sizeof q.q);
            q.r = c->primitive[4].capsule.r;
        }
        if (family == EXACT_ALIKE && i == 5 && random_below(r, 2)) {
            q = c->primitive[4].capsule;
            q.r = fabsf(one_ulp_off(r, q.r));
        }
        c->primitive[i] = (cgt_primitive){.kind = CGT_KIND_CAPSULES, .capsule = q};
    }
}

exact_case exact_case_make(test_random *r, exact_family family)
{
    exact_case c;
    memset(&c, 0, sizeof c);
    for (int i = 0; i < 2; i++) {
        c.primitive[i].kind = CGT_KIND_TRIANGLES;
        for (int k = 0; k < 3; k++)
            fill(r, family, c.primitive[i].triangle.v[k], 3);
        make_sphere(r, family, &c.primitive[i + 2]);
    }
    make_ray(r, family, &c);
    for (int i = 2; i < 4; i++)
        if (family == EXACT_AIMED || (family == EXACT_GRID && random_below(r, 2)))
            make_tangent(r, &c.ray, &c.primitive[i].sphere);
    if (family == EXACT_PLACES)
        make_places(r, &c);
    if (family == EXACT_ALIKE)
        make_alike(r, &c);
    if (family == EXACT_CLOSE) {
        c.primitive[2].sphere.r = touching(&c.ray, c.primitive[2].sphere) * random_float(r, 1.1f, 3) + 0.125f;
        make_close(r, &c);
    }
    make_capsules(r, family, &c);
    return c;
}
