/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray a call, without packets and streams. The hit and its values are those of arrays of rays. */
#include "kernel/packet/packet.h"
#include "kernel/resolve/fast_spheres.h"
#include "kernel/resolve/fast_triangles.h"
#include "kernel/resolve/resolve_capsules.h"
#include "query/ray_intake.h"

uint32_t CGT_KERNEL(cgt_trace_one_ray)(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                       bool use_bvh, bool any_hit, cgt_counts *counts)
{
    const cgt_primitives *prims = &committed_scene->prims;
    const cgt_ray ray = ray_of_single(from);
    const uint32_t mask = from->mask ? from->mask : UINT32_MAX;
    uint32_t skip = CGT_INVALID_ID;
    if (from->skip && from->skip->primitive != CGT_INVALID_ID)
        skip = cgt_primitives_number(prims, from->skip->geometry, from->skip->primitive);
    counts->rays++;
    const uint32_t prim = CGT_KERNEL(cgt_ray_trace)(committed_scene, &ray, use_bvh, skip, mask, any_hit, counts);
    counts->hits += prim != CGT_INVALID_ID;
    return prim;
}

/* ---- the hit ---- */

/* The ray in every lane. */
typedef struct one_ray_lanes {
    vfloat org[3], dir[3], t_min, t_max;
} one_ray_lanes;

CGT_SPU_INLINE one_ray_lanes one_ray_splat(const cgt_ray *ray)
{
    one_ray_lanes r = {.t_min = spux_vfloat(ray->t_min), .t_max = spux_vfloat(ray->t_max)};
    for (int a = 0; a < 3; a++) {
        r.org[a] = spux_vfloat(ray->line.org[a]);
        r.dir[a] = spux_vfloat(ray->line.dir[a]);
    }
    return r;
}

/* The next two compute a hit's values in single precision, the same bits as in a vector of rays. They return whether
 * the bounds cover it; else t and normal hold anything. */
static bool one_ray_fast_sphere(const cgt_ray *ray, cgt_sphere q, cgt_hit *hit)
{
    const one_ray_lanes r = one_ray_splat(ray);
    const vfloat sphere[4] = {spux_vfloat(q.x), spux_vfloat(q.y), spux_vfloat(q.z), spux_vfloat(q.r)};
    const fast_sphere s = fast_sphere_prepare(r.org, sphere);
    vfloat t, n[3];
    const vmask covered = fast_sphere_resolve(&s, r.dir, fast_inverse_square(r.dir), r.t_min, r.t_max, true, &t, n);
    hit->t = t[0];
    for (int a = 0; a < 3; a++)
        hit->normal[a] = n[a][0];
    return spux_any(covered);
}

static bool one_ray_fast_triangle(const cgt_ray *ray, const cgt_triangle *q, uint32_t fields, cgt_hit *hit)
{
    const one_ray_lanes r = one_ray_splat(ray);
    vfloat vertex[3][3];
    resolved_triangles h;
    h.u = h.v = spux_vfloat(0); /* compilers do not see that the fields ask for them */
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            vertex[k][a] = spux_vfloat(q->v[k][a]);
    const fast_triangle s = fast_triangle_prepare(r.org, vertex);
    const vmask covered = fast_triangle_resolve(&s, r.dir, r.t_min, r.t_max, fields, &h);
    hit->t = h.t[0];
    hit->u = h.u[0];
    hit->v = h.v[0];
    for (int a = 0; a < 3; a++)
        hit->normal[a] = h.normal[a][0];
    return spux_any(covered);
}

static double one_ray_square(const float a[3], const float b[3])
{
    const double x = (double)a[0] - (double)b[0], y = (double)a[1] - (double)b[1], z = (double)a[2] - (double)b[2];
    return x * x + y * y + z * z;
}

/* Whether a normal is within an eighth of right: its error is 2^-48 c / r beside a rounding, c the distance of the
 * ray's origin to the sphere, or to the farther end of the capsule. */
static bool one_ray_has_normal(const cgt_ray *ray, const cgt_primitive *q)
{
    const float *org = ray->line.org;
    const float center[3] = {q->sphere.x, q->sphere.y, q->sphere.z};
    if (q->kind == CGT_KIND_SPHERES)
        return one_ray_square(org, center) <= 0x1p90 * (double)q->sphere.r * (double)q->sphere.r;
    const double most = 0x1p90 * (double)q->capsule.r * (double)q->capsule.r;
    return one_ray_square(org, q->capsule.p) <= most && one_ray_square(org, q->capsule.q) <= most;
}

/* The surface of a sphere or a capsule that is hit. A ray that goes in runs against the normal there; where it is too
 * flat to tell by a normal whose error may be an eighth, as those of FAST, exact arithmetic decides. */
static uint32_t one_ray_surface(const cgt_ray *ray, const cgt_primitive *primitive, const float normal[3])
{
    const float *dir = ray->line.dir;
    const double d[3] = {(double)dir[0], (double)dir[1], (double)dir[2]};
    const double along = d[0] * (double)normal[0] + d[1] * (double)normal[1] + d[2] * (double)normal[2];
    const double length_squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (along * along > 0.25 * length_squared && one_ray_has_normal(ray, primitive))
        return along < 0 ? CGT_SURFACE_NEAR : CGT_SURFACE_FAR;
    cgt_decided_hit hit = {.primitive = *primitive};
    uint64_t exact = 0;
    return cgt_decide_hit(ray, &hit, &exact) && hit.far ? CGT_SURFACE_FAR : CGT_SURFACE_NEAR;
}

static void one_ray_values(const cgt_ray *ray, const cgt_primitive *q, bool fast, cgt_hit *hit, cgt_counts *counts)
{
    const uint32_t fields = CGT_FIELD_T | CGT_FIELD_NORMAL | CGT_FIELD_UV;
    switch (q->kind) {
    case CGT_KIND_SPHERES: {
        if (fast && one_ray_fast_sphere(ray, q->sphere, hit))
            return;
        const resolved_sphere s = resolve_sphere_ray(ray, q->sphere, counts);
        hit->t = s.t;
        memcpy(hit->normal, s.normal, sizeof hit->normal);
        return;
    }
    case CGT_KIND_TRIANGLES: {
        if (fast && one_ray_fast_triangle(ray, &q->triangle, fields, hit))
            return;
        const resolved_triangle s = resolve_triangle_ray(ray, &q->triangle, fields, counts);
        hit->t = s.t;
        hit->u = s.u;
        hit->v = s.v;
        memcpy(hit->normal, s.normal, sizeof hit->normal);
        return;
    }
    case CGT_KIND_CAPSULES: {
        const resolved_capsule s = resolve_capsule_ray(ray, &q->capsule);
        hit->t = s.t;
        hit->u = s.u;
        memcpy(hit->normal, s.normal, sizeof hit->normal);
    }
    }
}

void CGT_KERNEL(cgt_resolve_one_ray)(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                     uint32_t prim, cgt_precision precision, cgt_hit *hit, cgt_counts *counts)
{
    const cgt_ray ray = ray_of_single(from);
    const cgt_primitive_array *array = cgt_primitives_array(&committed_scene->prims, prim);
    *hit = (cgt_hit){.primitive = prim - array->first, .geometry = array->geometry};
    const cgt_primitive q = cgt_array_primitive(array, hit->primitive);
    one_ray_values(&ray, &q, precision == CGT_PRECISION_FAST, hit, counts);
    if (q.kind != CGT_KIND_TRIANGLES)
        hit->surface = one_ray_surface(&ray, &q, hit->normal);
}
