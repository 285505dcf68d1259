/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Primitives and rays for the tests of the exact oracle: made by hand, or random and aimed to be hard to decide. */
#ifndef ORACLE_INPUT_H
#define ORACLE_INPUT_H

#include "support/oracle/oracle.h"
#include "support/random.h"

#include <math.h>
#include <string.h>

/* ---- by hand ---- */

static inline oracle_primitive sphere_of(uint32_t geometry, float x, float y, float z, float r)
{
    return (oracle_primitive){ORACLE_SPHERE, geometry, 0, {x, y, z, r}};
}

static inline oracle_primitive triangle_of(uint32_t geometry, const float (*v)[3])
{
    oracle_primitive p = {.kind = ORACLE_TRIANGLE, .geometry = geometry};
    memcpy(p.data, v, sizeof p.data);
    return p;
}

/* A right-angled triangle at height z that surrounds the z axis. */
static inline oracle_primitive plane_at(uint32_t geometry, float z)
{
    const float v[3][3] = {{-4, -4, z}, {12, -4, z}, {-4, 12, z}};
    return triangle_of(geometry, v);
}

static inline truth_ray ray_of(float ox, float oy, float oz, float dx, float dy, float dz)
{
    return (truth_ray){{ox, oy, oz}, {dx, dy, dz}, 0, INFINITY};
}

static inline bool is_hit(oracle_primitive p, truth_ray ray)
{
    oracle_hit hit;
    return oracle_hits(&p, &ray, &hit);
}

/* ---- at random ---- */

typedef struct box {
    float middle, reach; /* typical magnitude of coordinates */
} box;

static inline void random_point(test_random *r, box b, float p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = b.middle + random_float(r, -b.reach, b.reach);
}

static inline truth_ray ray_to(const float org[3], const double target[3])
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    for (int a = 0; a < 3; a++) {
        ray.org[a] = org[a];
        ray.dir[a] = (float)(target[a] - org[a]);
    }
    return ray;
}

/* From a random point to a point of the triangle's plane: on an edge, at a vertex, or anywhere. */
static inline truth_ray ray_index(test_random *r, box b, const float (*v)[3])
{
    float org[3];
    double target[3];
    const uint32_t kind = random_below(r, 4);
    const double k = kind == 0 ? 0 : random_float(r, -0.2f, 1.2f), m = kind <= 2 ? 0 : random_float(r, -0.2f, 1.2f);
    random_point(r, b, org);
    for (int a = 0; a < 3; a++)
        target[a] = v[0][a] + k * ((double)v[1][a] - v[0][a]) + m * ((double)v[2][a] - v[0][a]);
    return ray_to(org, target);
}

#endif
