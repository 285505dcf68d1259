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

/* Sets the discriminant from the other terms. */
static void quadratic_discriminant(cgt_exact_quadratic *q)
{
    CGT_EXACT_LOCAL(square, 8);
    CGT_EXACT_LOCAL(product, 8);
    cgt_exact_multiply(&square, &q->middle, &q->middle);
    cgt_exact_multiply(&product, &q->scale, &q->product);
    cgt_exact_subtract(&q->discriminant, &square, &product);
}

static void quadratic_init(cgt_exact_quadratic *q)
{
    q->middle.limb = q->limb[0];
    q->scale.limb = q->limb[1];
    q->product.limb = q->limb[2];
    q->discriminant.limb = q->discriminant_limb;
}

void cgt_exact_sphere_terms(const cgt_exact_ray *ray, cgt_sphere sphere, cgt_exact_quadratic *quadratic)
{
    quadratic_init(quadratic);
    sphere_products(ray, sphere, quadratic);
    quadratic_discriminant(quadratic);
}

/* ---- Capsules ---- */

__attribute__((noinline)) void cgt_exact_capsule_dots(const cgt_exact_ray *ray, const cgt_capsule *capsule, bool from_q,
                                                      cgt_exact_dots *dots)
{
    const float *p = from_q ? capsule->q : capsule->p, *q = from_q ? capsule->p : capsule->q,
                length[3] = {capsule->r, 0, 0};
    ray_frame w;
    cgt_exact_vector c, n, radius;
    CGT_EXACT_LOCAL(square, 2);
    cgt_exact_integer *const all[6] = {&dots->dd, &dots->dn, &dots->nn, &dots->dc, &dots->cn, &dots->cc_rr};
    for (int k = 0; k < 6; k++)
        all[k]->limb = dots->limb[k];
    load_ray(&w, ray,
             cgt_exact_range_extend(cgt_exact_range_extend(cgt_exact_range_extend(CGT_EXACT_NO_RANGE, p), q), length));
    cgt_exact_load_relative(&c, p, &w.org, w.length);
    cgt_exact_load_relative(&n, q, &w.org, w.length);
    cgt_exact_vector_subtract(&n, &n, &c);
    cgt_exact_load(&radius, length, w.length, w.narrow);
    cgt_exact_dot_product(&dots->dd, &w.dir, &w.dir);
    cgt_exact_dot_product(&dots->dn, &w.dir, &n);
    cgt_exact_dot_product(&dots->nn, &n, &n);
    cgt_exact_dot_product(&dots->dc, &w.dir, &c);
    cgt_exact_dot_product(&dots->cn, &c, &n);
    cgt_exact_dot_product(&dots->cc_rr, &c, &c);
    cgt_exact_dot_product(&square, &radius, &radius);
    cgt_exact_subtract(&dots->cc_rr, &dots->cc_rr, &square);
    dots->exponent = w.length.low - w.direction.low;
}

/* out = a b - c d, of degree 4 */
static void subtract_products(cgt_exact_integer *out, const cgt_exact_integer *a, const cgt_exact_integer *b,
                              const cgt_exact_integer *c, const cgt_exact_integer *d)
{
    CGT_EXACT_LOCAL(product, 4);
    cgt_exact_multiply(out, a, b);
    cgt_exact_multiply(&product, c, d);
    cgt_exact_subtract(out, out, &product);
}

/* By Lagrange's identity: m.w = d.c n.n - d.n c.n, m.m = d.d n.n - (d.n)^2, w.w = c.c n.n - (c.n)^2. */
void cgt_exact_cylinder_terms(const cgt_exact_dots *dots, cgt_exact_quadratic *quadratic)
{
    quadratic_init(quadratic);
    subtract_products(&quadratic->middle, &dots->dc, &dots->nn, &dots->dn, &dots->cn);
    subtract_products(&quadratic->scale, &dots->dd, &dots->nn, &dots->dn, &dots->dn);
    subtract_products(&quadratic->product, &dots->cc_rr, &dots->nn, &dots->cn, &dots->cn);
    quadratic_discriminant(quadratic);
    quadratic->exponent = dots->exponent;
}

void cgt_exact_capsule_middle(const cgt_exact_dots *dots, cgt_exact_integer *x)
{
    subtract_products(x, &dots->dc, &dots->dn, &dots->dd, &dots->cn);
}

/* d.n ((c.c - r^2) d.n - d.c c.n) - c.n X */
void cgt_exact_capsule_plane(const cgt_exact_dots *dots, cgt_exact_integer *q)
{
    CGT_EXACT_LOCAL(x, 4);
    CGT_EXACT_LOCAL(product, 6);
    subtract_products(&x, &dots->cc_rr, &dots->dn, &dots->dc, &dots->cn);
    cgt_exact_multiply(q, &dots->dn, &x);
    cgt_exact_capsule_middle(dots, &x);
    cgt_exact_multiply(&product, &dots->cn, &x);
    cgt_exact_subtract(q, q, &product);
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
