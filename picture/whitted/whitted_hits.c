/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The surfaces that rays hit, and ghosts; see whitted.h. */
#include <math.h>
#include <string.h>

#include "whitted/whitted_internal.h"

/* Rounding a place to floats moves it by 2^-23 of its largest coordinate along each axis, its computation in double by
 * next to nothing: the square root of 3 times that in all. A surface that lies as far behind the start is met 1 / cos
 * of the angle to its normal farther along the ray: this allows for angles up to 77 degrees, where the share of light
 * that glass refracts is below a half. A body missed beyond is one that the ray touches less deep than that
 * rounding. */
static const double reach_per_coordinate = 0x1p-24 * 16.0;

/* Of the place that a ray leaves, as a share of reach: double is 2^29 times as exact as float. */
static const double double_error = 0x1p-26;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Element i of an array of floats, of `width` numbers each. */
static const float *element(const cgt_array *a, size_t width, uint32_t i)
{
    const size_t stride = a->stride ? a->stride : width * sizeof(float);
    return (const float *)(const void *)((const char *)a->data + i * stride);
}

static const float *center_of(const cgt_spheres *s, uint32_t i) { return element(&s->centers, 3, i); }

static double radius_of(const cgt_spheres *s, uint32_t i)
{
    return (double)(s->radii.data ? *element(&s->radii, 1, i) : s->radius);
}

/* Three corners of a triangle. */
static void corners_of(const cgt_triangles *t, uint32_t i, const float *corner[3])
{
    for (uint32_t k = 0; k < 3; k++)
        corner[k] =
            element(&t->vertices, 3, t->indices.data ? (uint32_t)cgt_array_get_whole(&t->indices, i, 3, k) : 3 * i + k);
}

const cgt_material *cgt_whitted_material_of(const whitted *w, uint32_t geometry, uint32_t primitive)
{
    const whitted_geometry *g = &w->geometry[geometry];
    return &w->material[g->material ? g->material[primitive] : g->material_of_all];
}

float cgt_whitted_reach(const double position[3])
{
    const double largest = fmax(fabs(position[0]), fmax(fabs(position[1]), fabs(position[2])));
    return (float)(largest * reach_per_coordinate) + 0x1p-120f;
}

int cgt_whitted_find(const whitted_ray *ray, whitted_body body)
{
    for (int i = 0; i < ray->nested; i++)
        if (ray->inside[i].geometry == body.geometry && ray->inside[i].number == body.number)
            return i;
    return -1;
}

/* ---- What the library reads and writes ---------------------------------------------------------------------- */

#define THREE(array)                                                                                                   \
    {                                                                                                                  \
        &(array)[0], &(array)[1], &(array)[2]                                                                          \
    }

static cgt_rays rays_of(const whitted_ray *ray, uint32_t count)
{
    return (cgt_rays){.count = count,
                      .stride = sizeof *ray,
                      .org = THREE(ray->org),
                      .dir = THREE(ray->dir),
                      .t_min = &ray->t_min,
                      .t_max = &ray->t_max,
                      .mask = &ray->mask,
                      .skip_primitive = &ray->skip_primitive,
                      .skip_geometry = &ray->skip_geometry};
}

static cgt_bounced_rays bounced_of(whitted_leaving *leaving)
{
    return (cgt_bounced_rays){.stride = sizeof(whitted_surface),
                              .org = THREE(leaving->org),
                              .dir = THREE(leaving->dir),
                              .t_max = &leaving->t_max,
                              .share = &leaving->share};
}

static cgt_hits hits_of(whitted_hit *hit)
{
    return (cgt_hits){.stride = sizeof *hit, .t = &hit->t, .primitive = &hit->primitive, .geometry = &hit->geometry};
}

/* ---- Surfaces ----------------------------------------------------------------------------------------------- */

const whitted_body *cgt_whitted_medium(const whitted *w, const whitted_body *inside, int nested, int without)
{
    const whitted_body *medium = NULL;
    uint32_t most = 0;
    for (int i = 0; i < nested; i++) {
        const uint32_t priority = cgt_whitted_material_of(w, inside[i].geometry, inside[i].primitive)->priority;
        if (i == without || (medium && priority < most))
            continue;
        medium = &inside[i];
        most = priority;
    }
    return medium;
}

/* Sets the indices of refraction on both sides of a surface: a ray that is in the body leaves it, any other enters. */
static void set_media(const whitted *w, const whitted_ray *ray, whitted_surface *s)
{
    const int at = cgt_whitted_find(ray, s->body);
    const whitted_body *around = cgt_whitted_medium(w, ray->inside, ray->nested, at);
    const cgt_material *outside = around ? cgt_whitted_material_of(w, around->geometry, around->primitive) : NULL;
    const cgt_material *inside = s->material;
    if (at >= 0) {
        const whitted_body *here = cgt_whitted_medium(w, ray->inside, ray->nested, -1);
        inside = cgt_whitted_material_of(w, here->geometry, here->primitive);
    } else if (outside && outside->priority > inside->priority)
        inside = outside;
    s->inside = inside->index;
    s->outside = outside ? outside->index : 1.0f;
}

cgt_result cgt_whitted_surfaces(const whitted *w, const whitted_ray *ray, whitted_hit *hit, uint32_t count,
                                whitted_surface *s)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t primitive = hit[i].primitive;
        s[i].inside = s[i].outside = 0.0f;
        if (primitive == CGT_INVALID_ID)
            continue;
        const whitted_geometry *g = &w->geometry[hit[i].geometry];
        s[i].body = (whitted_body){hit[i].geometry,
                                   g->spheres ? primitive
                                   : g->body  ? g->body[primitive]
                                              : 0,
                                   primitive};
        s[i].material = cgt_whitted_material_of(w, hit[i].geometry, primitive);
        if (s[i].material->kind == CGT_MATERIAL_GLASS)
            set_media(w, &ray[i], &s[i]);
    }
    const cgt_rays rays = rays_of(ray, count);
    const cgt_media media = {.stride = sizeof *s, .inside_of_ray = &s->inside, .outside_of_ray = &s->outside};
    const cgt_surfaces surfaces = {.stride = sizeof *s,
                                   .position = THREE(s->position),
                                   .normal = THREE(s->normal),
                                   .start = THREE(s->start),
                                   .length = &s->length,
                                   .front = &s->front};
    const cgt_bounced_rays reflected = bounced_of(&s->reflected), refracted = bounced_of(&s->refracted);
    const cgt_hits hits = hits_of(hit);
    return cgt_bounce_rays(w->scene, &rays, &hits, &media, &surfaces, &reflected, &refracted, NULL);
}

/* ---- Ghosts ------------------------------------------------------------------------------------------------- */

/* Whether the ray starts at the surface of a sphere, but for rounding. */
static bool starts_at_sphere(const cgt_spheres *s, uint32_t primitive, const whitted_ray *ray)
{
    const float *center = center_of(s, primitive);
    double from[3], square = 0.0;
    for (int a = 0; a < 3; a++) {
        from[a] = (double)ray->org[a] - (double)center[a];
        square += (double)ray->dir[a] * (double)ray->dir[a];
    }
    const double depth = radius_of(s, primitive) - sqrt(dot(from, from));
    return fabs(depth) <= (double)ray->reach * sqrt(square);
}

/* Whether the ray leaves the mesh that it hits. */
static bool leaves_body(const whitted_geometry *g, const whitted_ray *ray, const whitted_hit *hit,
                        const whitted_surface *s)
{
    return ray->skip_geometry == hit->geometry && (g->body ? g->body[ray->skip_primitive] : 0) == s->body.number;
}

/* The t of a sphere that a ray meets at about `at`, from the place that it leaves. */
static double t_of_sphere(const cgt_spheres *s, uint32_t primitive, const double place[3], const double dir[3],
                          double at)
{
    const float *center = center_of(s, primitive);
    const double radius = radius_of(s, primitive), square = dot(dir, dir);
    double from[3], nearest[3];
    for (int a = 0; a < 3; a++)
        from[a] = place[a] - (double)center[a];
    const double middle = -dot(from, dir) / square;
    for (int a = 0; a < 3; a++)
        nearest[a] = from[a] + middle * dir[a];
    const double rest = radius * radius - dot(nearest, nearest), half = rest > 0.0 ? sqrt(rest / square) : 0.0;
    return at < middle ? middle - half : middle + half;
}

/* The same of a triangle's plane; `at` where that is nearly along the ray. */
static double t_of_triangle(const cgt_triangles *triangles, uint32_t primitive, const double place[3],
                            const double dir[3], double at, double slack)
{
    const float *corner[3];
    double e[2][3], to[3], normal[3];
    corners_of(triangles, primitive, corner);
    for (int a = 0; a < 3; a++) {
        e[0][a] = (double)corner[1][a] - (double)corner[0][a];
        e[1][a] = (double)corner[2][a] - (double)corner[0][a];
        to[a] = (double)corner[0][a] - place[a];
    }
    for (int a = 0; a < 3; a++)
        normal[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
    const double t = dot(normal, to) / dot(normal, dir);
    return fabs(t - at) <= 0x1p-20 * fabs(at) + slack ? t : at;
}

/* Whether the line through the place that a ray leaves passes beside a triangle that the ray itself meets. */
static bool passes_beside(const cgt_triangles *triangles, uint32_t primitive, const double from[3], const double dir[3])
{
    const float *corner[3];
    double to[3][3], side[3];
    corners_of(triangles, primitive, corner);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            to[k][a] = (double)corner[k][a] - from[a];
    for (int k = 0; k < 3; k++) { /* volumes of direction and edges: of one sign where it passes inside */
        const double *p = to[k], *q = to[(k + 1) % 3];
        side[k] = dir[0] * (p[1] * q[2] - p[2] * q[1]) + dir[1] * (p[2] * q[0] - p[0] * q[2]) +
                  dir[2] * (p[0] * q[1] - p[1] * q[0]);
    }
    return fmin(side[0], fmin(side[1], side[2])) < 0.0 && fmax(side[0], fmax(side[1], side[2])) > 0.0;
}

/* Whether a surface that was met within reach of the start lies behind the place that the ray leaves, or beside its
 * way, as double tells. */
static bool is_passed(const whitted *w, const whitted_ray *ray, const whitted_hit *hit)
{
    const whitted_geometry *g = &w->geometry[hit->geometry];
    const double dir[3] = {(double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2]};
    const double at = (double)hit->t, reach = (double)ray->reach;
    if (fabsf(hit->t) > ray->reach)
        return false;
    if (g->triangles && passes_beside(g->triangles, hit->primitive, ray->from, dir))
        return true;
    const double t = g->spheres ? t_of_sphere(g->spheres, hit->primitive, ray->from, dir, at)
                                : t_of_triangle(g->triangles, hit->primitive, ray->from, dir, at, 2.0 * reach);
    return t < reach * -double_error;
}

/* A hit that cannot be, since the ray is known to be on the other side; see whitted.h. The camera knows nothing, and a
 * sphere that the ray left from inside is met at its far root. */
static bool is_ghost(const whitted *w, const whitted_ray *ray, const whitted_hit *hit, const whitted_surface *s)
{
    if (ray->side == WHITTED_CAMERA || hit->primitive == CGT_INVALID_ID ||
        (hit->primitive == ray->skip_primitive && hit->geometry == ray->skip_geometry))
        return false;
    if (is_passed(w, ray, hit))
        return true;
    const whitted_geometry *g = &w->geometry[hit->geometry];
    if (s->material->kind == CGT_MATERIAL_GLASS)
        return s->front == (cgt_whitted_find(ray, s->body) >= 0);
    /* Of what is opaque only a surface near the start can be a ghost: most hits need no more. */
    if (g->spheres)
        return !s->front && starts_at_sphere(g->spheres, hit->primitive, ray);
    if (fabsf(hit->t) > ray->reach)
        return false;
    /* Of its own mesh, the neighbours of the triangle that it leaves, from the other side; of another closed one its
     * inside, where it lies beyond their common edge. */
    return leaves_body(g, ray, hit, s) ? s->front != (ray->side == WHITTED_OUTSIDE) : !s->front && !g->sheet;
}

static cgt_result trace(const whitted *w, const whitted_ray *ray, uint32_t count, whitted_hit *hit)
{
    const cgt_rays rays = rays_of(ray, count);
    const cgt_hits hits = hits_of(hit);
    return cgt_trace_bounced_rays(w->scene, &rays, &hits, NULL);
}

/* Keeps a ray whose hit is a ghost, to be traced from there on. */
static uint32_t keep_ghost(const whitted *w, whitted_memory *m, whitted_ray *ray, uint32_t i, const whitted_hit *hit,
                           const whitted_surface *s, uint32_t again)
{
    if (!is_ghost(w, &ray[i], &hit[i], &s[i]))
        return again;
    ray[i].t_min = nextafterf(hit[i].t, INFINITY);
    m->again_index[again] = i;
    m->again[again] = ray[i];
    return again + 1;
}

/* Traces rays on that have passed ghosts; returns how many have met another one. */
static cgt_result trace_again(const whitted *w, whitted_memory *m, whitted_ray *ray, whitted_hit *hit,
                              whitted_surface *s, uint32_t *again)
{
    const uint32_t count = *again;
    cgt_result result = trace(w, m->again, count, m->again_hit);
    *again = 0;
    for (uint32_t k = 0; k < count && result == CGT_OK; k++) {
        const uint32_t i = m->again_index[k];
        hit[i] = m->again_hit[k];
        result = cgt_whitted_surfaces(w, &ray[i], &hit[i], 1, &s[i]);
        *again = keep_ghost(w, m, ray, i, hit, s, *again);
    }
    return result;
}

cgt_result cgt_whitted_nearest(const whitted *w, whitted_memory *m, whitted_ray *ray, uint32_t count, whitted_hit *hit,
                               whitted_surface *s)
{
    enum { MOST_GHOSTS = 100 };
    uint32_t again = 0;
    cgt_result result = trace(w, ray, count, hit);
    if (result == CGT_OK)
        result = cgt_whitted_surfaces(w, ray, hit, count, s);
    for (uint32_t i = 0; i < count && result == CGT_OK; i++)
        again = keep_ghost(w, m, ray, i, hit, s, again);
    for (int round = 0; result == CGT_OK && again > 0; round++) {
        WHITTED_COUNT(w, ghosts, again);
        if (round < MOST_GHOSTS) {
            result = trace_again(w, m, ray, hit, s, &again);
            continue;
        }
        WHITTED_COUNT(w, too_deep, again);
        for (uint32_t k = 0; k < again; k++)
            hit[m->again_index[k]].primitive = CGT_INVALID_ID;
        break;
    }
    return result;
}
