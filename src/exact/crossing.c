/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Crossings in double, then exactly. */
#include "exact/crossing.h"

#include <math.h>

#include "exact/triangle_double.h"

int cgt_decide_crossing(const cgt_ray *ray, const cgt_triangle *triangle, uint64_t *exact)
{
    int side;
    if (cgt_triangle_double_side(ray->line.org, ray->line.dir, triangle, &side))
        return side;
    ++*exact;
    return cgt_exact_crossing(&ray->line, triangle);
}

/* The signs of d.c, and of c.c - r^2 of the moved origin: where c.c = r^2 it moves along e, inwards if e.c > 0. All
 * terms of e.c come before e.e. */
static void sphere_signs(const cgt_ray *ray, cgt_sphere sphere, int *middle, int *product)
{
    const float center[3] = {sphere.x, sphere.y, sphere.z};
    cgt_exact_sphere_signs(&ray->line, sphere, middle, product);
    for (int a = 0; a < 3 && !*product; a++)
        *product = (center[a] < ray->line.org[a]) - (center[a] > ray->line.org[a]);
    if (!*product)
        *product = 1; /* a point, by e.e */
}

bool cgt_decide_sphere_contains(const cgt_ray *ray, cgt_sphere sphere, uint64_t *exact)
{
    const float center[3] = {sphere.x, sphere.y, sphere.z};
    double cc = 0;
    for (int a = 0; a < 3; a++) {
        const double c = (double)center[a] - (double)ray->line.org[a];
        cc += c * c;
    }
    const double rr = (double)sphere.r * (double)sphere.r, error = 6 * CGT_DOUBLE_U * (cc + rr);
    if (fabs(cc - rr) > error)
        return cc < rr;
    int middle, product;
    ++*exact;
    sphere_signs(ray, sphere, &middle, &product);
    return product < 0;
}

/* The sign of the moved ray's t at a crossing. Outside of a sphere both roots have the sign of d.c. */
static int t_sign(const cgt_ray *ray, const cgt_decided_hit *hit)
{
    int middle, product;
    if (hit->primitive.kind == CGT_KIND_TRIANGLES)
        return cgt_exact_crossing_t_sign(&ray->line, &hit->primitive.triangle);
    sphere_signs(ray, hit->primitive.sphere, &middle, &product);
    return product > 0 ? middle : hit->far ? 1 : -1;
}

static bool is_touched(const cgt_decided_hit *hit, int roots)
{
    return hit->primitive.kind == CGT_KIND_SPHERES && roots == 1;
}

bool cgt_decide_hit_crosses(const cgt_ray *ray, const cgt_decided_hit *hit, int roots, uint64_t *exact)
{
    if (hit->primitive.kind == CGT_KIND_TRIANGLES && !cgt_decide_crossing(ray, &hit->primitive.triangle, exact))
        return false;
    if (ray->t_min != 0 || (float)hit->t != 0)
        return !is_touched(hit, roots);
    if (is_touched(hit, roots))
        return cgt_decide_sphere_contains(ray, hit->primitive.sphere, exact);
    ++*exact;
    return t_sign(ray, hit) > 0;
}

int cgt_decide_crossing_side(const cgt_ray *ray, const cgt_decided_hit *hit, uint64_t *exact)
{
    if (hit->primitive.kind == CGT_KIND_TRIANGLES)
        return cgt_decide_crossing(ray, &hit->primitive.triangle, exact);
    if (hit->far)
        return 1;
    const bool may_touch = ray->t_min == 0 && (float)hit->t == 0;
    return may_touch && is_touched(hit, cgt_decide_sphere_roots(ray, hit->primitive.sphere, exact)) ? 1 : -1;
}
