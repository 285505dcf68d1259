/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays and primitives for the tests of leaves. */
#include "exact/valid_primitive.h"
#include "primitive/lane_cases.h"

#include <math.h>
#include <string.h>

#include "model/primitives.h"

#define LARGEST 0x1p54 /* largest coordinate of an origin: a tree gets none beyond 2^55 */

static const char *const names[CASE_FAMILIES] = {"interior", "edges", "vertices",   "lattice", "coplanar",
                                                 "needles",  "tiny",  "far",        "inside",  "ranges",
                                                 "axes",     "flat",  "any numbers"};

const char *case_name(case_family f) { return names[f]; }

static float sign(test_random *r) { return random_below(r, 2) ? 1.f : -1.f; }

/* ---- primitives ---- */

/* A primitive in double, exact enough to aim at. */
typedef struct subject {
    double middle[3], size, normal[3]; /* of unit length */
} subject;

/* of a capsule: the sphere around a place of its axis */
static subject describe_at(const oracle_primitive *q, double share)
{
    subject s = {.size = 0};
    double e[2][3], square = 0;
    if (q->kind == ORACLE_CAPSULE) {
        for (int a = 0; a < 3; a++)
            s.middle[a] = (double)q->data[a] + share * ((double)q->data[3 + a] - (double)q->data[a]);
        s.size = (double)q->data[6];
        return s;
    }
    if (q->kind == ORACLE_SPHERE) {
        for (int a = 0; a < 3; a++)
            s.middle[a] = (double)q->data[a];
        s.size = (double)q->data[3];
        return s;
    }
    for (int a = 0; a < 3; a++) {
        s.middle[a] = ((double)q->data[a] + q->data[3 + a] + q->data[6 + a]) / 3;
        for (int k = 0; k < 3; k++)
            s.size = fmax(s.size, fabs(q->data[3 * k + a] - s.middle[a]));
        for (int k = 0; k < 2; k++)
            e[k][a] = (double)q->data[3 * k + 3 + a] - q->data[a];
    }
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        s.normal[a] = e[0][b] * e[1][c] - e[0][c] * e[1][b];
        square += s.normal[a] * s.normal[a];
    }
    for (int a = 0; a < 3; a++)
        s.normal[a] /= square > 0 ? sqrt(square) : 1;
    return s;
}

static subject describe(const oracle_primitive *q) { return describe_at(q, 0.5); }

static bool is_valid(const oracle_primitive *q)
{
    cgt_triangle t;
    memcpy(t.v, q->data, sizeof t.v);
    return q->kind == ORACLE_SPHERE    ? q->data[3] >= 0
           : q->kind == ORACLE_CAPSULE ? q->data[6] >= 0
                                       : cgt_triangle_has_area(&t);
}

static uint32_t numbers_of(oracle_kind kind) { return (uint32_t)oracle_floats(kind); }

/* Triangles and spheres around the origin or away from it, of size about 1. */
static void place_primitive(test_random *r, case_family f, oracle_primitive *q)
{
    const bool sphere = q->kind == ORACLE_SPHERE;
    const float size = f == CASE_TINY ? ldexpf(1, -1 - (int)random_below(r, 22)) : random_log(r, 1e-3f, 1);
    const float offset = f == CASE_FLAT || random_below(r, 2) ? 0 : f == CASE_TINY ? 1 : size * random_log(r, 1, 1e4f);
    for (int a = 0; a < 3; a++) {
        const float middle = random_float(r, -1, 1) * offset;
        for (int k = 0; k < (sphere ? 1 : 3); k++)
            q->data[3 * k + a] = middle + random_float(r, -1, 1) * size;
    }
    if (q->kind == ORACLE_CAPSULE) {
        q->data[6] = f != CASE_NEEDLES    ? size * random_log(r, 1e-2f, 2)
                     : random_below(r, 8) ? size * random_log(r, 1e-7f, 1e-2f)
                                          : 0;
        return;
    }
    if (sphere)
        q->data[3] = f != CASE_NEEDLES ? size : random_below(r, 8) ? size * random_log(r, 1e-7f, 1e-2f) : 0;
    if (f == CASE_FLAT)
        memset(q->data, 0, 3 * sizeof *q->data); /* near this corner floats are dense */
    if (sphere || f != CASE_NEEDLES)
        return;
    /* the third vertex close to the edge of the other two, or beyond its end */
    const float along = random_float(r, -0.2f, 1.2f), width = random_log(r, 1e-7f, 1e-2f) * size;
    for (int a = 0; a < 3; a++)
        q->data[6 + a] = q->data[a] + along * (q->data[3 + a] - q->data[a]) + random_float(r, -1, 1) * width;
}

/* With integer coordinates, around the origin or through it. */
static void place_on_lattice(test_random *r, oracle_primitive *q)
{
    for (uint32_t i = 0; i < 9; i++)
        q->data[i] = 2 * ((float)random_below(r, 9) - 4);
    if (q->kind != ORACLE_TRIANGLE)
        q->data[numbers_of(q->kind) - 1] = fabsf(q->data[numbers_of(q->kind) - 1]);
    else if (random_below(r, 2))
        for (int a = 0; a < 3; a++) /* the origin in the middle of the first edge, or of the triangle's plane */
            q->data[3 + a] = -q->data[a];
    else
        for (int a = 0; a < 3; a++)
            q->data[6 + a] = -q->data[a] - q->data[3 + a];
}

static bool is_lattice(case_family f) { return f == CASE_LATTICE || f == CASE_ANY; }

static void scale_primitive(oracle_primitive *q, int exponent)
{
    for (uint32_t i = 0; i < numbers_of(q->kind); i++)
        q->data[i] = ldexpf(q->data[i], exponent);
}

/* A copy of the first primitive, with another corner first or moved a little; or a neighbour of it. */
static void vary_primitive(test_random *r, lane_case *c, int k, double size)
{
    oracle_primitive *q = &c->prim[k];
    const uint32_t numbers = numbers_of(q->kind);
    *q = c->prim[0];
    switch (random_below(r, 4)) {
    case 0:
        if (q->kind == ORACLE_TRIANGLE)
            for (uint32_t i = 0; i < 9; i++)
                q->data[i] = c->prim[0].data[(i + 3 * (uint32_t)k) % 9];
        if (q->kind == ORACLE_CAPSULE)
            for (uint32_t i = 0; i < 6; i++)
                q->data[i] = c->prim[0].data[(i + 3) % 6];
        break;
    case 1:
        for (uint32_t i = 0; i < numbers; i++)
            q->data[i] += (float)size * random_float(r, -1, 1);
        break;
    default: q->data[random_below(r, numbers)] += (float)size * random_log(r, 1e-9f, 1e-1f) * sign(r); break;
    }
    if (!is_valid(q))
        *q = c->prim[0];
}

static void make_primitives(test_random *r, oracle_kind kind, lane_case *c)
{
    static const int worlds[] = {-100, -20, 0, 0, 0, 40};
    const bool any = c->family == CASE_ANY;
    const int exponent = any ? (int)random_below(r, 185) - 135 : worlds[random_below(r, TEST_COUNT(worlds))];
    do {
        c->prim[0] = (oracle_primitive){.kind = kind};
        if (is_lattice(c->family))
            place_on_lattice(r, &c->prim[0]);
        else
            place_primitive(r, c->family, &c->prim[0]);
        scale_primitive(&c->prim[0], exponent);
    } while (!is_valid(&c->prim[0]));
    const subject s = describe(&c->prim[0]);
    for (int k = 1; k < CASE_LANES; k++)
        vary_primitive(r, c, k, s.size);
    c->magnitude = 0;
    for (int k = 0; k < CASE_LANES; k++)
        for (uint32_t i = 0; i < numbers_of(kind); i++)
            c->magnitude = fmaxf(c->magnitude, fabsf(c->prim[k].data[i]));
    if (c->family == CASE_TINY)
        c->magnitude *= ldexpf(1, (int)random_below(r, 14));
    if (any) {
        const int room = 54 - ilogbf(fmaxf(c->magnitude, 0x1p-149f));
        c->magnitude = ldexpf(c->magnitude, room > 0 && random_below(r, 2) ? (int)random_below(r, (uint32_t)room) : 0);
    }
}

/* ---- origins and targets ---- */

/* A weighted sum of the vertices. */
static void aim_triangle(test_random *r, case_family f, const oracle_primitive *q, double point[3])
{
    double share[3], sum = 0;
    const uint32_t k = random_below(r, 3);
    const double fine = (double)random_log(r, 1e-9f, 1e-3f) * (double)sign(r);
    const bool edge = f == CASE_EDGES || (f != CASE_INTERIOR && random_below(r, 4) == 0);
    for (uint32_t i = 0; i < 3; i++) {
        share[i] = (double)random_float(r, f == CASE_INTERIOR ? 0.1f : -0.1f, 1);
        if (f == CASE_VERTICES)
            share[i] = i == k ? 1 : share[i] * fine;
    }
    if (edge)
        share[k] = random_below(r, 4) ? fine : 0;
    for (int i = 0; i < 3; i++)
        sum += share[i];
    for (int a = 0; a < 3; a++) {
        point[a] = 0;
        for (int i = 0; i < 3; i++)
            point[a] += share[i] / sum * q->data[3 * i + a];
    }
}

/* A point some radii from the centre, farther out for tangents. */
static void aim_sphere(test_random *r, case_family f, const subject *s, const float org[3], double point[3])
{
    const double fine = 1 + (double)(random_float(r, -1, 1) * random_log(r, 1e-8f, 1e-2f));
    const bool rim = f == CASE_EDGES || f == CASE_COPLANAR || random_below(r, 4) == 0;
    const double offset = s->size * (rim ? fine : (double)random_float(r, 0, 1.1f));
    float d[3];
    double cc = 0, dc = 0, square = 0, side[3];
    random_direction(r, d);
    for (int a = 0; a < 3; a++) {
        cc += (s->middle[a] - org[a]) * (s->middle[a] - org[a]);
        dc += d[a] * (s->middle[a] - org[a]);
    }
    for (int a = 0; a < 3; a++) {
        side[a] = d[a] - (cc > 0 ? dc / cc * (s->middle[a] - org[a]) : 0);
        square += side[a] * side[a];
    }
    const double slant = offset * offset < cc * 0.999999 ? sqrt(1 - offset * offset / cc) : 1;
    for (int a = 0; a < 3; a++)
        point[a] = s->middle[a] + offset / slant * side[a] / sqrt(square > 1e-12 ? square : 1);
}

static double away(test_random *r, case_family f, oracle_kind kind)
{
    if (f == CASE_FAR || (f == CASE_COPLANAR && kind != ORACLE_TRIANGLE))
        return (double)random_log(r, 0x1p6f, 0x1p20f);
    if (f == CASE_VERTICES && kind != ORACLE_TRIANGLE)
        return 1 + (double)(random_log(r, 1e-7f, 1e-2f) * sign(r));
    return f == CASE_INSIDE ? (double)random_float(r, 0, 1) : (double)random_log(r, 0.1f, 300);
}

static void make_origin(test_random *r, case_family f, oracle_kind kind, const subject *s, float org[3])
{
    const bool flat = f == CASE_COPLANAR && kind == ORACLE_TRIANGLE;
    const double lift = flat ? random_below(r, 4) ? (double)random_log(r, 1e-9f, 1e-1f) : 0 : 1;
    double reach = away(r, f, kind) * s->size, in_plane = 0;
    float d[3];
    random_direction(r, d);
    for (int a = 0; a < 3; a++)
        in_plane += d[a] * s->normal[a];
    reach = fmin(reach, LARGEST / 2);
    for (int a = 0; a < 3; a++)
        org[a] = (float)(s->middle[a] + reach * (d[a] - in_plane * s->normal[a] * (1 - lift)));
}

/* ---- rays ---- */

/* The begin of a range: some lie near the hit, at t, or beyond it. */
static float range_from(test_random *r, case_family f, double t)
{
    const float near_t = (float)(t * (1 + (double)(random_log(r, 1e-9f, 1) * sign(r))));
    switch (random_below(r, f == CASE_RANGES || f == CASE_COPLANAR || f == CASE_ANY ? 5 : 32)) {
    case 0: return near_t;
    case 1: return (float)(2 * fabs(t));
    case 2: return -INFINITY;
    case 3: return -(float)(2 * fabs(t));
    default: return 0;
    }
}

/* Zeroes one or two components of the direction: the origin gets the target's coordinate. */
static void flatten(test_random *r, const double point[3], float org[3], double to[3])
{
    const uint32_t first = random_below(r, 3), axes = 1 + random_below(r, 2);
    double length = 0;
    for (int a = 0; a < 3; a++)
        length = fmax(length, fabs(to[a]));
    for (uint32_t k = 0; k < axes; k++) {
        const uint32_t a = (first + k) % 3;
        org[a] = (float)point[a];
        to[a] = random_below(r, 2) ? (double)(0 * sign(r)) : length * (double)(random_log(r, 1e-30f, 1e-8f) * sign(r));
    }
}

static void make_ray(test_random *r, const lane_case *c, const subject *s, const float from[3], double length,
                     truth_ray *ray)
{
    const oracle_primitive *q = &c->prim[0];
    double point[3], to[3], square = 0;
    memcpy(ray->org, from, sizeof ray->org);
    if (q->kind == ORACLE_CAPSULE) {
        const double share = random_below(r, 4) ? (double)random_float(r, 0, 1) : (double)random_below(r, 2);
        const subject at = describe_at(q, share);
        aim_sphere(r, c->family, &at, ray->org, point);
    } else if (q->kind == ORACLE_SPHERE)
        aim_sphere(r, c->family, s, ray->org, point);
    else
        aim_triangle(r, c->family, q, point);
    for (int a = 0; a < 3; a++)
        to[a] = point[a] - ray->org[a];
    if (c->family == CASE_AXES)
        flatten(r, point, ray->org, to);
    for (int a = 0; a < 3; a++)
        square += to[a] * to[a];
    if (!(square > 0)) { /* the origin equals the target */
        to[0] = s->size > 0 ? s->size : 1;
        square = to[0] * to[0];
    }
    const double reach = c->family == CASE_RANGES && random_below(r, 2) ? -sqrt(square) : sqrt(square);
    for (int a = 0; a < 3; a++)
        ray->dir[a] = (float)(to[a] / reach * length);
    ray->t_min = range_from(r, c->family, reach / length);
}

/* Through a corner, the midpoint of an edge or the origin; exact in float except far from the origin. */
static void make_lattice_ray(test_random *r, const lane_case *c, truth_ray *ray)
{
    const float *v = c->prim[0].data;
    const bool any = c->family == CASE_ANY;
    const uint32_t to = random_below(r, 3), points = c->prim[0].kind == ORACLE_CAPSULE ? 2 : 3,
                   k = 3 * random_below(r, points), l = 3 * random_below(r, points);
    const float unit = c->prim[0].kind == ORACLE_SPHERE ? v[3] : fmaxf(fabsf(v[0]), fmaxf(fabsf(v[1]), fabsf(v[3])));
    const int size = unit > 0 ? ilogbf(unit) : -135, most = 53 - size - 3;
    const int far = any ? (int)random_below(r, (uint32_t)(most > 1 ? most : 1)) : (int)random_below(r, 8);
    const int length = (int)random_below(r, 99) - 50;
    float d[3];
    do
        for (int a = 0; a < 3; a++)
            d[a] = (float)random_below(r, 9) - 4;
    while (d[0] == 0 && d[1] == 0 && d[2] == 0);
    for (int a = 0; a < 3; a++) {
        const bool corners = to && c->prim[0].kind != ORACLE_SPHERE;
        const float aim = corners ? 0.5f * v[(int)k + a] + 0.5f * v[(int)l + a] : 0;
        ray->org[a] = aim - ldexpf(d[a], size + far);
        ray->dir[a] = ldexpf(d[a], any ? length : (int)random_below(r, 2));
    }
    ray->t_min = range_from(r, c->family, ldexp(1, size + far - length));
}

/* d.n for n = e1 x e2, of a triangle whose first corner is the origin: exact except for the last bits of truth_real. */
static truth_real steepness(const float *v, const float d[3])
{
    truth_real sum = 0;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        sum += ((truth_real)v[3 + b] * v[6 + c] - (truth_real)v[3 + c] * v[6 + b]) * d[a];
    }
    return sum;
}

/* Of the directions within a few ulps, the one closest to the plane but not in it. */
static double flattest(const float *v, float d[3])
{
    enum { WIDE = 9 };
    float best[3] = {0};
    truth_real least = 0;
    for (int i = 0; i < WIDE * WIDE * WIDE; i++) {
        const int steps[3] = {i % WIDE - WIDE / 2, i / WIDE % WIDE - WIDE / 2, i / (WIDE * WIDE) - WIDE / 2};
        float to[3];
        for (int a = 0; a < 3; a++)
            to[a] = d[a] + (float)steps[a] * (fabsf(d[a]) * 0x1p-23f);
        const truth_real s = steepness(v, to), size = s < 0 ? -s : s;
        if (size == 0 || (least != 0 && size >= least))
            continue;
        least = size;
        memcpy(best, to, sizeof best);
    }
    memcpy(d, best, sizeof best);
    return (double)steepness(v, d);
}

/* From next to the first corner across the triangle towards the opposite edge, or back from there. The origin's offset
 * along the normal puts the hit at t = -1: single precision does not resolve it. */
static void make_flat_rays(test_random *r, lane_case *c, const subject *s)
{
    const float *v = c->prim[0].data;
    const double share = (double)random_float(r, 0.3f, 0.7f), size = s->size;
    double square = 0;
    float d[3];
    for (int a = 0; a < 3; a++)
        d[a] = (float)(-share * v[3 + a] - (0.95 - share) * v[6 + a]);
    const double den = flattest(v, d);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, k = (a + 2) % 3;
        const double n = (double)v[3 + b] * v[6 + k] - (double)v[3 + k] * v[6 + b];
        square += n * n;
    }
    for (int i = 0; i < CASE_LANES; i++) {
        const double offset = (double)(random_log(r, 1e-5f, 1e-1f) * sign(r));
        for (int a = 0; a < 3; a++) {
            c->ray[i].org[a] = (float)(offset * v[3 + a] + s->normal[a] * (den / sqrt(square)));
            c->ray[i].dir[a] = i % 4 ? d[a] : -d[a];
        }
        c->ray[i].t_min = i % 8 ? -INFINITY : -(float)size;
    }
}

void case_make(test_random *r, oracle_kind kind, case_family f, lane_case *c)
{
    float origin[3];
    c->family = f;
    make_primitives(r, kind, c);
    const subject s = describe(&c->prim[0]);
    make_origin(r, f, kind, &s, origin);
    const int exponent = random_below(r, 2) ? (int)random_below(r, 101) - 50 : 0;
    const bool fan = random_below(r, 2);
    for (int i = 0; i < CASE_LANES && f != CASE_FLAT; i++) {
        if (is_lattice(f))
            make_lattice_ray(r, c, &c->ray[i]);
        else {
            if (!fan)
                make_origin(r, f, kind, &s, origin);
            make_ray(r, c, &s, origin, ldexp((double)random_float(r, 1, 2), exponent), &c->ray[i]);
        }
    }
    if (f == CASE_FLAT)
        make_flat_rays(r, c, &s);
    for (int i = 0; i < CASE_LANES; i++)
        c->ray[i].t_max = INFINITY;
}

/* ---- truth ---- */

void case_judge(const lane_case *c, case_truth *truth)
{
    for (int i = 0; i < CASE_LANES; i++) {
        oracle_hit hit;
        truth->hit[0][i] = oracle_hits(&c->prim[0], &c->ray[i], &hit);
        truth->t[0][i] = hit.t;
        truth->hit[1][i] = oracle_hits(&c->prim[i], &c->ray[0], &hit);
        truth->t[1][i] = hit.t;
    }
}
