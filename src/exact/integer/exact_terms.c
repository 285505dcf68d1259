/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From floats to the whole numbers of exact_terms.h. */
#include "exact/integer/exact_terms.h"

#include "exact/integer/exact_vector.h"

/* The input of all terms: the direction, and a primitive's points relative to the origin. */
typedef struct ray_frame {
    cgt_exact_unit length, direction;
    bool narrow;
    cgt_exact_vector dir, org;
} ray_frame;

static cgt_exact_range range_of_triangle(const cgt_triangle *triangle)
{
    cgt_exact_range range = CGT_EXACT_NO_RANGE;
    for (int k = 0; k < 3; k++)
        range = cgt_exact_range_extend(range, triangle->v[k]);
    return range;
}

/* The range is that of the primitive's positions and lengths. */
static void load_ray(ray_frame *w, const cgt_exact_ray *ray, cgt_exact_range primitive)
{
    w->length = cgt_exact_unit_of(cgt_exact_range_extend(primitive, ray->org));
    w->direction = cgt_exact_unit_of(cgt_exact_range_extend(CGT_EXACT_NO_RANGE, ray->dir));
    w->narrow = cgt_exact_is_narrow(w->length, w->direction);
    cgt_exact_load(&w->dir, ray->dir, w->direction, w->narrow);
    cgt_exact_load(&w->org, ray->org, w->length, w->narrow);
}

static void three_init(cgt_exact_three *t)
{
    for (int k = 0; k < 3; k++)
        t->of[k].limb = t->limb[k];
}

void cgt_exact_edge_terms(const cgt_exact_ray *ray, const cgt_triangle *triangle, cgt_exact_three *edge)
{
    ray_frame w;
    cgt_exact_vector v[3];
    cgt_exact_cross cross;
    three_init(edge);
    load_ray(&w, ray, range_of_triangle(triangle));
    for (int k = 0; k < 3; k++)
        cgt_exact_load_relative(&v[k], triangle->v[k], &w.org, w.length);
    for (int k = 0; k < 3; k++) {
        cgt_exact_cross_product(&cross, &v[(k + 1) % 3], &v[(k + 2) % 3]);
        cgt_exact_triple_product(&edge->of[k], &cross, &w.dir);
    }
}

void cgt_exact_plane_terms(const cgt_exact_ray *ray, const cgt_triangle *triangle, cgt_exact_plane *plane)
{
    ray_frame w;
    cgt_exact_vector v[3];
    cgt_exact_cross normal;
    plane->number.limb = plane->limb[0];
    plane->determinant.limb = plane->limb[1];
    load_ray(&w, ray, range_of_triangle(triangle));
    for (int k = 0; k < 3; k++)
        cgt_exact_load_relative(&v[k], triangle->v[k], &w.org, w.length);
    for (int k = 1; k < 3; k++)
        cgt_exact_vector_subtract(&v[k], &v[k], &v[0]);
    cgt_exact_cross_product(&normal, &v[1], &v[2]);
    cgt_exact_triple_product(&plane->number, &normal, &v[0]);
    cgt_exact_triple_product(&plane->determinant, &normal, &w.dir);
    plane->exponent = w.length.low - w.direction.low;
}

/* A function of its own: the vectors leave the stack before the discriminant is computed. */
__attribute__((noinline)) static void sphere_products(const cgt_exact_ray *ray, cgt_sphere sphere,
                                                      cgt_exact_quadratic *quadratic)
{
    const float position[3] = {sphere.x, sphere.y, sphere.z}, length[3] = {sphere.r, 0, 0};
    ray_frame w;
    cgt_exact_vector centre, radius;
    CGT_EXACT_LOCAL(square, 2);
    load_ray(&w, ray, cgt_exact_range_extend(cgt_exact_range_extend(CGT_EXACT_NO_RANGE, position), length));
    cgt_exact_load_relative(&centre, position, &w.org, w.length);
    cgt_exact_load(&radius, length, w.length, w.narrow);
    cgt_exact_dot_product(&quadratic->middle, &w.dir, &centre);
    cgt_exact_dot_product(&quadratic->scale, &w.dir, &w.dir);
    cgt_exact_dot_product(&quadratic->product, &centre, &centre);
    cgt_exact_dot_product(&square, &radius, &radius);
    cgt_exact_subtract(&quadratic->product, &quadratic->product, &square);
    quadratic->exponent = w.length.low - w.direction.low;
}

void cgt_exact_sphere_terms(const cgt_exact_ray *ray, cgt_sphere sphere, cgt_exact_quadratic *quadratic)
{
    CGT_EXACT_LOCAL(square, 4);
    CGT_EXACT_LOCAL(product, 4);
    quadratic->middle.limb = quadratic->limb[0];
    quadratic->scale.limb = quadratic->limb[1];
    quadratic->product.limb = quadratic->limb[2];
    quadratic->discriminant.limb = quadratic->discriminant_limb;
    sphere_products(ray, sphere, quadratic);
    cgt_exact_multiply(&square, &quadratic->middle, &quadratic->middle);
    cgt_exact_multiply(&product, &quadratic->scale, &quadratic->product);
    cgt_exact_subtract(&quadratic->discriminant, &square, &product);
}

void cgt_exact_shift_terms(const cgt_exact_ray *ray, const float from[3], const float to[3], cgt_exact_three *shift)
{
    ray_frame w;
    cgt_exact_vector start, edge;
    cgt_exact_cross cross;
    three_init(shift);
    load_ray(&w, ray, cgt_exact_range_extend(cgt_exact_range_extend(CGT_EXACT_NO_RANGE, from), to));
    cgt_exact_load(&start, from, w.length, w.narrow);
    cgt_exact_load_relative(&edge, to, &start, w.length);
    cgt_exact_cross_product(&cross, &w.dir, &edge);
    cgt_exact_cross_components(&cross, shift->of);
}

void cgt_exact_normal_terms(const cgt_triangle *triangle, cgt_exact_three *normal)
{
    const cgt_exact_unit unit = cgt_exact_unit_of(range_of_triangle(triangle));
    const bool narrow = cgt_exact_is_narrow(unit, unit);
    cgt_exact_vector v[3];
    cgt_exact_cross cross;
    three_init(normal);
    for (int k = 0; k < 3; k++)
        cgt_exact_load(&v[k], triangle->v[k], unit, narrow);
    for (int k = 1; k < 3; k++)
        cgt_exact_vector_subtract(&v[k], &v[k], &v[0]);
    cgt_exact_cross_product(&cross, &v[1], &v[2]);
    cgt_exact_cross_components(&cross, normal->of);
}
