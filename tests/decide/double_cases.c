/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays at one primitive. */
#include "decide/double_cases.h"

#include <math.h>
#include <string.h>

const char *double_family_name(double_family f)
{
    static const char *const name[DOUBLE_FAMILIES] = {"anywhere", "at edges",     "far away", "slivers",
                                                      "lattice",  "huge or tiny", "grazing"};
    return name[f];
}

void double_case_shape(test_random *r, double_family f, bool sphere, oracle_primitive *q)
{
    const float size = f == LATTICE ? 4 : random_log(r, 1e-2f, 1e2f), offset = f == FAR_AWAY ? 1e4f : 1;
    float middle[3];
    *q = (oracle_primitive){.kind = sphere ? ORACLE_SPHERE : ORACLE_TRIANGLE};
    for (int a = 0; a < 3; a++)
        middle[a] = f == LATTICE ? 0 : random_float(r, -offset, offset);
    for (int i = 0; i < (sphere ? 3 : 9); i++)
        q->data[i] = middle[i % 3] + random_float(r, -1, 1) * size;
    if (sphere)
        q->data[3] = size * random_float(r, 0, 1);
    if (!sphere && f == SLIVERS)
        for (int a = 0; a < 3; a++)
            q->data[6 + a] = 0.25f * q->data[a] + 0.75f * q->data[3 + a];
    for (int i = 0; i < 9 && f == LATTICE; i++)
        q->data[i] = rintf(q->data[i]);
}

static void make_target(test_random *r, double_family f, const oracle_primitive *q, double point[3])
{
    float d[3];
    double share[3];
    random_direction(r, d);
    for (int i = 0; i < 3; i++)
        share[i] = random_float(r, -0.1f, 1);
    if (f == AT_EDGES || random_below(r, 4) == 0)
        share[random_below(r, 3)] = random_below(r, 2) ? 0 : (double)random_log(r, 1e-16f, 1e-6f);
    const double sum = share[0] + share[1] + share[2] != 0 ? share[0] + share[1] + share[2] : 1;
    const double reach = f == AT_EDGES ? 1 : (double)random_float(r, 0, 1.2f);
    for (int a = 0; a < 3; a++)
        point[a] = q->kind == ORACLE_SPHERE
                       ? q->data[a] + reach * q->data[3] * d[a]
                       : (share[0] * q->data[a] + share[1] * q->data[3 + a] + share[2] * q->data[6 + a]) / sum;
    for (int a = 0; a < 3 && f == LATTICE; a++)
        point[a] = rint(2 * point[a]) / 2;
}

truth_ray double_case_ray(test_random *r, double_family f, const oracle_primitive *q)
{
    truth_ray ray = {.t_min = random_below(r, 2) ? 0 : -INFINITY, .t_max = INFINITY};
    const float reach = f == LATTICE ? 6 : random_log(r, 1, f == FAR_AWAY ? 1e6f : 1e2f);
    double point[3];
    make_target(r, f, q, point);
    for (int a = 0; a < 3; a++) {
        ray.org[a] = random_float(r, -1, 1) * reach + (f == FAR_AWAY ? 0 : q->data[a]);
        if (f == LATTICE)
            ray.org[a] = rintf(ray.org[a]);
        ray.dir[a] = (float)(point[a] - ray.org[a]);
    }
    if (ray.dir[0] == 0 && ray.dir[1] == 0 && ray.dir[2] == 0)
        ray.dir[random_below(r, 3)] = -1;
    return ray;
}

/* Scales the case by one power of two and the direction by another. */
static void scale_all(test_random *r, oracle_primitive *q, truth_ray *ray)
{
    const int all = (int)random_below(r, 110) - 60, more = (int)random_below(r, 60) - 30;
    for (int i = 0; i < 9; i++)
        q->data[i] = ldexpf(q->data[i], all);
    for (int a = 0; a < 3; a++) {
        ray->org[a] = ldexpf(ray->org[a], all);
        ray->dir[a] = ldexpf(ray->dir[a], all + more);
    }
}

/* r^2 = y^2 + z^2 in whole numbers: the x axis is a tangent. A ray that is hardly turned from it hits or misses. */
static void graze(test_random *r, oracle_primitive *q, truth_ray *ray)
{
    const float a = (float)(1 + random_below(r, 1000)), b = a + (float)(1 + random_below(r, 1000));
    const float turn = random_log(r, 0x1p-60f, 0x1p-40f);
    q->data[0] = random_float(r, 0.25f, 4) * b * b;
    q->data[1] = b * b - a * a;
    q->data[2] = 2 * a * b;
    q->data[3] = a * a + b * b;
    *ray = (truth_ray){.dir = {1, random_below(r, 4) ? turn : -turn, 0}, .t_max = INFINITY};
}

void double_case_make(test_random *r, double_family f, bool sphere, oracle_primitive *q, truth_ray *ray)
{
    double_case_shape(r, f, sphere, q);
    *ray = double_case_ray(r, f, q);
    if (f == GRAZING && sphere)
        graze(r, q, ray);
    if (f == HUGE_OR_TINY)
        scale_all(r, q, ray);
}

cgt_primitive double_case_shape_of(const oracle_primitive *q)
{
    cgt_primitive primitive = {.kind = q->kind == ORACLE_SPHERE    ? CGT_KIND_SPHERES
                                       : q->kind == ORACLE_CAPSULE ? CGT_KIND_CAPSULES
                                                                   : CGT_KIND_TRIANGLES};
    memcpy(&primitive.triangle, q->data, (size_t)oracle_floats(q->kind) * sizeof *q->data);
    return primitive;
}

cgt_ray double_case_ray_of(const truth_ray *ray)
{
    cgt_ray of = {.t_min = ray->t_min, .t_max = ray->t_max};
    memcpy(of.line.org, ray->org, sizeof of.line.org);
    memcpy(of.line.dir, ray->dir, sizeof of.line.dir);
    return of;
}
