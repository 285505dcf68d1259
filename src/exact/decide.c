/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decisions in double, then exactly. */
#include "exact/decide.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "exact/decide_capsule.h"
#include "exact/triangle_pair.h"

/* ---- canonical t ---- */

static double exact_root(const cgt_ray *ray, const cgt_primitive *primitive, bool far)
{
    const cgt_exact_root root = {primitive, far};
    return cgt_exact_t(&ray->line, &root);
}

/* Both roots in double. Returns whether they are safe. */
static bool find_safe_roots(const cgt_ray *ray, cgt_sphere sphere, cgt_sphere_terms e, cgt_sphere_roots *root)
{
    const double half = sqrt(e.disc);
    bool safe = !cgt_sphere_double_unsafe_sum(e, half);
    if (safe && cgt_sphere_double_unsafe_product(e))
        safe = cgt_sphere_double_refine(ray->line.org, sphere, &e.product);
    *root = cgt_sphere_double_roots(e, half);
    return safe;
}

double cgt_canonical_sphere_t(const cgt_ray *ray, cgt_sphere sphere, bool *far)
{
    const cgt_sphere_terms e = cgt_sphere_double_terms(ray->line.org, ray->line.dir, sphere);
    double near;
    *far = false;
    if (cgt_sphere_double_near(e, &near)) { /* a root has one t, whatever the range is */
        *far = (float)near < ray->t_min;
        return *far ? cgt_canonical_sphere_far(ray, sphere) : near;
    }
    const cgt_primitive primitive = {.kind = CGT_KIND_SPHERES, .sphere = sphere};
    cgt_sphere_roots root;
    const bool safe = find_safe_roots(ray, sphere, e, &root);
    if (!safe)
        root.near = exact_root(ray, &primitive, false);
    *far = !((float)root.near >= fmaxf(ray->t_min, -FLT_MAX));
    if (!safe && *far)
        root.far = exact_root(ray, &primitive, true);
    return *far ? root.far : root.near;
}

double cgt_canonical_sphere_far(const cgt_ray *ray, cgt_sphere sphere)
{
    const cgt_sphere_terms e = cgt_sphere_double_terms(ray->line.org, ray->line.dir, sphere);
    const cgt_primitive primitive = {.kind = CGT_KIND_SPHERES, .sphere = sphere};
    cgt_sphere_roots root;
    return find_safe_roots(ray, sphere, e, &root) ? root.far : exact_root(ray, &primitive, true);
}

double cgt_canonical_triangle_t(const cgt_ray *ray, const cgt_triangle *triangle)
{
    cgt_triangle_plane p = cgt_triangle_double_plane(ray->line.org, ray->line.dir, triangle);
    if (!cgt_triangle_double_t_safe(&p))
        cgt_triangle_refine_num(ray->line.org, triangle, &p);
    if (cgt_triangle_double_t_safe(&p))
        return p.num / p.den;
    const cgt_primitive primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = *triangle};
    return exact_root(ray, &primitive, false);
}

void cgt_canonical_sphere_normal(const cgt_ray *ray, cgt_sphere sphere, double t, float normal[3])
{
    const double centre[3] = {sphere.x, sphere.y, sphere.z}, r = sphere.r;
    const double d[3] = {ray->line.dir[0], ray->line.dir[1], ray->line.dir[2]};
    const double k = r > 0 ? 1 / r : -1 / sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int a = 0; a < 3; a++) {
        const double c = centre[a] - (double)ray->line.org[a];
        normal[a] = (float)((r > 0 ? t * d[a] - c : d[a]) * k);
    }
}

void cgt_decide_t(const cgt_ray *ray, cgt_decided_hit *hit)
{
    hit->far = false;
    switch (hit->primitive.kind) {
    case CGT_KIND_SPHERES: hit->t = cgt_canonical_sphere_t(ray, hit->primitive.sphere, &hit->far); break;
    case CGT_KIND_TRIANGLES: hit->t = cgt_canonical_triangle_t(ray, &hit->primitive.triangle); break;
    case CGT_KIND_CAPSULES:
        hit->t = cgt_canonical_capsule_t(ray, &hit->primitive.capsule, &hit->far, &hit->part);
        break;
    }
}

/* ---- hit or miss ---- */

int cgt_decide_sphere_roots(const cgt_ray *ray, cgt_sphere sphere, uint64_t *exact)
{
    double disc = cgt_sphere_double_terms(ray->line.org, ray->line.dir, sphere).disc;
    double error = cgt_sphere_double_disc_error(ray->line.org, ray->line.dir, sphere);
    if (!(fabs(disc) > error))
        disc = cgt_sphere_double_refine_disc(ray->line.org, ray->line.dir, sphere, &error);
    if (fabs(disc) > error)
        return disc > 0 ? 2 : 0;
    ++*exact;
    return cgt_exact_sphere_roots(&ray->line, sphere);
}

static bool line_hits_triangle(const cgt_ray *ray, const cgt_triangle *triangle, uint64_t *exact)
{
    int side;
    if (cgt_triangle_double_side(ray->line.org, ray->line.dir, triangle, &side) ||
        cgt_triangle_refine_side(ray->line.org, ray->line.dir, triangle, &side))
        return side != 0;
    ++*exact;
    return cgt_exact_line_hits_triangle(&ray->line, triangle);
}

/* Spares the exact t of triangles that the ray leaves, or ends at. */
static bool triangle_is_beyond(const cgt_ray *ray, const cgt_primitive *primitive)
{
    if (primitive->kind != CGT_KIND_TRIANGLES)
        return false;
    const cgt_triangle_plane p = cgt_triangle_double_plane(ray->line.org, ray->line.dir, &primitive->triangle);
    return cgt_triangle_double_t_beyond(&p, ray->t_min, ray->t_max);
}

int cgt_decide_roots(const cgt_ray *ray, const cgt_primitive *primitive, uint64_t *exact)
{
    switch (primitive->kind) {
    case CGT_KIND_SPHERES: return cgt_decide_sphere_roots(ray, primitive->sphere, exact);
    case CGT_KIND_CAPSULES: return cgt_decide_capsule_roots(ray, &primitive->capsule, exact);
    case CGT_KIND_TRIANGLES: break;
    }
    return line_hits_triangle(ray, &primitive->triangle, exact);
}

static bool is_in_range(const cgt_ray *ray, double t)
{
    const float rounded = (float)t;
    return rounded >= ray->t_min && rounded <= ray->t_max && fabsf(rounded) < INFINITY;
}

bool cgt_decide_hit(const cgt_ray *ray, cgt_decided_hit *hit, uint64_t *exact)
{
    if (hit->primitive.kind == CGT_KIND_CAPSULES) /* its terms serve both decisions */
        return cgt_decide_capsule_hit(ray, hit, exact) && is_in_range(ray, hit->t);
    if (!cgt_decide_roots(ray, &hit->primitive, exact) || triangle_is_beyond(ray, &hit->primitive))
        return false;
    cgt_decide_t(ray, hit);
    return is_in_range(ray, hit->t);
}

bool cgt_decide_root(const cgt_ray *ray, cgt_decided_hit *hit)
{
    const bool far = hit->far;
    if (triangle_is_beyond(ray, &hit->primitive))
        return false;
    if (far && hit->primitive.kind == CGT_KIND_CAPSULES)
        hit->t = cgt_canonical_capsule_far(ray, &hit->primitive.capsule, &hit->part);
    else if (far)
        hit->t = cgt_canonical_sphere_far(ray, hit->primitive.sphere);
    else
        cgt_decide_t(ray, hit); /* the far root if the near one lies before the range */
    return hit->far == far && is_in_range(ray, hit->t);
}

/* ---- order ---- */

/* Of two triangles; *order: as far as comparisons of floats and double precision tell. */
static bool order_triangles(const cgt_ray *ray, const cgt_triangle *a, const cgt_triangle *b, int *order)
{
    *order = 0;
    if (cgt_triangles_share_plane(a, b))
        return true;
    const cgt_triangle_plane p = cgt_triangle_double_plane(ray->line.org, ray->line.dir, a);
    const cgt_triangle_plane q = cgt_triangle_double_plane(ray->line.org, ray->line.dir, b);
    if (cgt_triangle_double_t_safe(&p) && cgt_triangle_double_t_safe(&q))
        *order = cgt_triangle_double_order(&p, &q);
    return *order != 0 || cgt_triangles_share_lattice_plane(a, b);
}

/* The surface that is hit: at the end of a capsule, the sphere there. */
static const cgt_primitive *surface_of(const cgt_decided_hit *hit, cgt_primitive *end)
{
    if (hit->primitive.kind != CGT_KIND_CAPSULES || hit->part == CGT_CAPSULE_SIDE)
        return &hit->primitive;
    *end = (cgt_primitive){.kind = CGT_KIND_SPHERES, .sphere = cgt_capsule_end(&hit->primitive.capsule, hit->part)};
    return end;
}

int cgt_decide_order(const cgt_ray *ray, const cgt_decided_hit *a, const cgt_decided_hit *b, uint64_t *exact)
{
    if (fabs(a->t - b->t) > CGT_ORDER_ERROR * (fabs(a->t) + fabs(b->t)))
        return a->t < b->t ? -1 : 1;
    cgt_primitive ends[2];
    const cgt_primitive *surface_a = surface_of(a, &ends[0]), *surface_b = surface_of(b, &ends[1]);
    if (a->far == b->far && cgt_same_surface(surface_a, surface_b))
        return 0;
    int order;
    if (surface_a->kind == CGT_KIND_TRIANGLES && surface_b->kind == CGT_KIND_TRIANGLES &&
        order_triangles(ray, &surface_a->triangle, &surface_b->triangle, &order))
        return order;
    const cgt_exact_root root_a = {surface_a, a->far}, root_b = {surface_b, b->far};
    ++*exact;
    return cgt_exact_compare(&ray->line, &root_a, &root_b);
}

bool cgt_decide_is_closer(const cgt_ray *ray, uint32_t prim, const cgt_decided_hit *hit, uint32_t best_prim,
                          cgt_decided_hit *best, uint64_t *exact)
{
    cgt_decide_t(ray, best);
    const int order = cgt_decide_order(ray, hit, best, exact);
    return order < 0 || (order == 0 && prim < best_prim);
}
