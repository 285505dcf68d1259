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
 * that glass refracts is below a half. A body missed beyond is one that the ray touches less deep than that rounding. */
static const double reach_per_coordinate = 0x1p-24 * 16.0;

/* Of the place that a ray leaves, as a share of reach: double is 2^29 times as exact as float. */
static const double double_error = 0x1p-26;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static const float *element(const float *first, size_t stride, size_t usual, uint32_t i)
{
    return (const float *)(const void *)((const char *)first + (size_t)i * (stride ? stride : usual));
}

static const float *center_of(const cgt_spheres *s, uint32_t i)
{
    return element(s->centers, s->center_stride, 3 * sizeof(float), i);
}

static double radius_of(const cgt_spheres *s, uint32_t i)
{
    return (double)(s->radii ? *element(s->radii, s->radius_stride, sizeof(float), i) : s->radius);
}

/* Three corners of a triangle. */
static void corners_of(const cgt_triangles *t, uint32_t i, const float *corner[3])
{
    const size_t stride = t->index_stride ? t->index_stride : 3 * sizeof(uint32_t);
    const uint32_t own[3] = {3 * i, 3 * i + 1, 3 * i + 2};
    const uint32_t *index =
        t->indices ? (const uint32_t *)(const void *)((const char *)t->indices + (size_t)i * stride) : own;
    for (int k = 0; k < 3; k++)
        corner[k] = element(t->vertices, t->vertex_stride, 3 * sizeof(float), index[k]);
}

const whitted_material *whitted_material_of(const whitted *w, uint32_t geometry, uint32_t primitive)
{
    const whitted_geometry *g = &w->geometry[geometry];
    return &w->material[g->material ? g->material[primitive] : g->material_of_all];
}

float whitted_reach(const double position[3])
{
    const double largest = fmax(fabs(position[0]), fmax(fabs(position[1]), fabs(position[2])));
    return (float)(largest * reach_per_coordinate) + 0x1p-120f;
}

/* The next float above or below a finite one, or from infinity towards 0: as nextafterf, whose call costs more than all
 * else in whitted_round. */
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

void whitted_round(const double place[3], const float ray_org[3], float out[3])
{
    for (int a = 0; a < 3; a++) {
        out[a] = (float)place[a];
        if ((double)out[a] > place[a] && (double)ray_org[a] <= place[a])
            out[a] = next_float(out[a], false);
        else if ((double)out[a] < place[a] && (double)ray_org[a] >= place[a])
            out[a] = next_float(out[a], true);
    }
}

int whitted_find(const whitted_ray *ray, whitted_body body)
{
    for (int i = 0; i < ray->nested; i++)
        if (ray->inside[i].geometry == body.geometry && ray->inside[i].number == body.number)
            return i;
    return -1;
}

/* The roots of a line and a sphere: middle - half and middle + half, half 0 where rounding leaves none. */
static void roots(const double org[3], const double dir[3], const float center[3], double radius, double *middle,
                  double *half)
{
    double from[3], nearest[3];
    for (int a = 0; a < 3; a++)
        from[a] = org[a] - (double)center[a];
    const double square = dot(dir, dir);
    *middle = -dot(from, dir) / square;
    for (int a = 0; a < 3; a++)
        nearest[a] = from[a] + *middle * dir[a];
    const double rest = radius * radius - dot(nearest, nearest);
    *half = rest > 0.0 ? sqrt(rest / square) : 0.0;
}

static double far_root(const cgt_spheres *spheres, const whitted_ray *ray)
{
    const double org[3] = {(double)ray->org[0], (double)ray->org[1], (double)ray->org[2]};
    const double dir[3] = {(double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2]};
    double middle, half;
    roots(org, dir, center_of(spheres, ray->skip_primitive), radius_of(spheres, ray->skip_primitive), &middle, &half);
    const double far = middle + half;
    return far > 0.0 ? far : 0.0;
}

float whitted_far_root(const cgt_spheres *spheres, const whitted_ray *ray) { return (float)far_root(spheres, ray); }

/* The t of a hit in double: of a sphere the root that the float belongs to, of a triangle that of its plane. Sets an
 * outward normal of any length. */
static double resolve_sphere(const cgt_spheres *s, const whitted_hit *hit, const double org[3], const double dir[3],
                             double normal[3])
{
    const float *center = center_of(s, hit->primitive);
    double middle, half;
    roots(org, dir, center, radius_of(s, hit->primitive), &middle, &half);
    const double t = (double)hit->t < middle ? middle - half : middle + half;
    for (int a = 0; a < 3; a++)
        normal[a] = org[a] + t * dir[a] - (double)center[a];
    return t;
}

static double resolve_triangle(const cgt_triangles *triangles, const whitted_hit *hit, const double org[3],
                               const double dir[3], double slack, double normal[3])
{
    const float *corner[3];
    double e[2][3], to[3];
    corners_of(triangles, hit->primitive, corner);
    for (int a = 0; a < 3; a++) {
        e[0][a] = (double)corner[1][a] - (double)corner[0][a];
        e[1][a] = (double)corner[2][a] - (double)corner[0][a];
        to[a] = (double)corner[0][a] - org[a];
    }
    for (int a = 0; a < 3; a++)
        normal[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
    const double along = dot(normal, dir), t = dot(normal, to) / along;
    /* A plane nearly along the ray: the library's t, which is exact but for its rounding, is the better one. */
    return fabs(t - (double)hit->t) <= 0x1p-20 * fabs((double)hit->t) + slack ? t : (double)hit->t;
}

void whitted_resolve(const whitted *w, const whitted_ray *ray, const whitted_hit *hit, whitted_surface *surface)
{
    const whitted_geometry *g = &w->geometry[hit->geometry];
    const double org[3] = {(double)ray->org[0], (double)ray->org[1], (double)ray->org[2]};
    const double dir[3] = {(double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2]};
    double *n = surface->normal;
    const double t = g->spheres ? resolve_sphere(g->spheres, hit, org, dir, n)
                                : resolve_triangle(g->triangles, hit, org, dir, 0.0, n);
    const double length = sqrt(dot(n, n));
    for (int a = 0; a < 3; a++) {
        surface->position[a] = org[a] + t * dir[a];
        n[a] = length > 0.0 ? n[a] / length : 0.0;
    }
    surface->length = t > 0.0 ? t * sqrt(dot(dir, dir)) : 0.0;
    surface->front = dot(n, dir) < 0.0;
    surface->body.geometry = hit->geometry;
    surface->body.primitive = hit->primitive;
    surface->body.number = g->spheres ? hit->primitive : g->body ? g->body[hit->primitive] : 0;
    surface->material = whitted_material_of(w, hit->geometry, hit->primitive);
}

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

/* Whether a surface that was met within reach of the start lies behind the place that the ray leaves, or beside its way,
 * as double tells. */
static bool is_passed(const whitted *w, const whitted_ray *ray, const whitted_hit *hit)
{
    const whitted_geometry *g = &w->geometry[hit->geometry];
    const double dir[3] = {(double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2]};
    double normal[3];
    if (fabsf(hit->t) > ray->reach)
        return false;
    if (g->triangles && passes_beside(g->triangles, hit->primitive, ray->from, dir))
        return true;
    const double t = g->spheres ? resolve_sphere(g->spheres, hit, ray->from, dir, normal)
                                : resolve_triangle(g->triangles, hit, ray->from, dir, 2.0 * (double)ray->reach, normal);
    return t < (double)ray->reach * -double_error;
}

/* A hit that cannot be, since the ray is known to be on the other side; see whitted.h. The camera knows nothing. */
static bool is_ghost(const whitted *w, const whitted_ray *ray, const whitted_hit *hit)
{
    whitted_surface s;
    if (ray->side == WHITTED_CAMERA)
        return false;
    if (is_passed(w, ray, hit))
        return true;
    const whitted_geometry *g = &w->geometry[hit->geometry];
    if (whitted_material_of(w, hit->geometry, hit->primitive)->kind == WHITTED_GLASS) {
        whitted_resolve(w, ray, hit, &s);
        return s.front == (whitted_find(ray, s.body) >= 0);
    }
    /* Of what is opaque only a surface near the start can be a ghost: most hits need no more. */
    if (g->spheres ? !starts_at_sphere(g->spheres, hit->primitive, ray) : fabsf(hit->t) > ray->reach)
        return false;
    whitted_resolve(w, ray, hit, &s);
    if (g->spheres)
        return !s.front;
    /* Of its own mesh, the neighbours of the triangle that it leaves, from the other side; of another closed one its
     * inside, where it lies beyond their common edge. */
    return leaves_body(g, ray, hit, &s) ? s.front != (ray->side == WHITTED_OUTSIDE) : !s.front && !g->sheet;
}

static cgt_result trace(const whitted *w, const whitted_ray *ray, uint32_t count, whitted_hit *hit)
{
    const cgt_rays rays = {.count = count,
                           .stride = sizeof *ray,
                           .org = {&ray->org[0], &ray->org[1], &ray->org[2]},
                           .dir = {&ray->dir[0], &ray->dir[1], &ray->dir[2]},
                           .t_min = &ray->t_min,
                           .t_max = &ray->t_max,
                           .mask = &ray->mask,
                           .skip_primitive = &ray->skip_primitive,
                           .skip_geometry = &ray->skip_geometry};
    const cgt_hits hits = {
        .stride = sizeof *hit, .t = &hit->t, .primitive = &hit->primitive, .geometry = &hit->geometry};
    return cgt_trace_rays(w->scene, &rays, &hits, NULL);
}

/* Whether a ray inside its sphere meets that before what was found: floats may be equal where the roots are not. */
static bool meets_own(const whitted *w, const whitted_ray *ray, const whitted_hit *hit)
{
    const whitted_geometry *g = &w->geometry[hit->geometry];
    const double org[3] = {(double)ray->org[0], (double)ray->org[1], (double)ray->org[2]};
    const double dir[3] = {(double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2]};
    double normal[3];
    if (!ray->far_root || hit->t < ray->t_max)
        return false;
    const double t = g->spheres ? resolve_sphere(g->spheres, hit, org, dir, normal)
                                : resolve_triangle(g->triangles, hit, org, dir, 0.0, normal);
    return far_root(w->geometry[ray->skip_geometry].spheres, ray) < t;
}

/* Where nothing else was hit, a ray inside its sphere meets that; collects rays whose hits are ghosts. */
static uint32_t sort_out(const whitted *w, whitted_memory *m, whitted_ray *ray, const uint32_t *index, uint32_t count,
                         const whitted_hit *found, whitted_hit *hit)
{
    uint32_t again = 0;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = index ? index[k] : k;
        hit[i] = found[k];
        if (found[k].primitive == CGT_INVALID_ID || meets_own(w, &ray[i], &found[k])) {
            if (ray[i].far_root)
                hit[i] = (whitted_hit){ray[i].t_max, ray[i].skip_primitive, ray[i].skip_geometry};
        } else if (is_ghost(w, &ray[i], &hit[i])) {
            ray[i].t_min = nextafterf(hit[i].t, INFINITY);
            m->again_index[again] = i;
            m->again[again++] = ray[i];
        }
    }
    return again;
}

cgt_result whitted_nearest(const whitted *w, whitted_memory *m, whitted_ray *ray, uint32_t count, whitted_hit *hit)
{
    enum { MOST_GHOSTS = 100 };
    cgt_result result = trace(w, ray, count, hit);
    uint32_t again = result ? 0 : sort_out(w, m, ray, NULL, count, hit, hit);
    for (int round = 0; result == CGT_OK && again > 0; round++) {
        WHITTED_COUNT(w, ghosts, again);
        if (round == MOST_GHOSTS) {
            WHITTED_COUNT(w, too_deep, again);
            for (uint32_t k = 0; k < again; k++)
                hit[m->again_index[k]].primitive = CGT_INVALID_ID;
            break;
        }
        result = trace(w, m->again, again, m->again_hit);
        if (result == CGT_OK)
            again = sort_out(w, m, ray, m->again_index, again, m->again_hit, hit);
    }
    return result;
}
