/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One line and one primitive, exactly.
 *   sphere    with c = centre - org:  d.d t^2 - 2 d.c t + c.c - r^2 = 0
 *   triangle  with p_i = v_i - org and t d = sum b_i p_i, sum b_i = 1 (Cramer's rule):
 *             w0 = d.(p1 x p2), w1 = d.(p2 x p0), w2 = d.(p0 x p1),  b_i = w_i / sum w,  t = p0.(p1 x p2) / sum w
 *             sum w = d.n, which is 0 where the ray is parallel or the triangle has no area */
#include "support/oracle/oracle_line.h"

#include <math.h>
#include <string.h>

/* ---- order of roots ---- */

int oracle_sign_of_surd(const dyadic *x, int sigma, const dyadic *d)
{
    const int s = sigma * d->sign;
    if (s == 0 || s == x->sign)
        return x->sign;
    if (x->sign == 0)
        return s;
    const dyadic xx = dyadic_mul(x, x), difference = dyadic_sub(&xx, d);
    return x->sign * difference.sign;
}

/* Sign of x + s1 sqrt(d1) + s2 sqrt(d2). The roots' sum S has the sign of s1 d1 + s2 d2; where x has the opposite sign,
 * x^2 - S^2 = x^2 - d1 - d2 - 2 s1 s2 sqrt(d1 d2) decides. */
static int sign_of_two_surds(const dyadic *x, int s1, const dyadic *d1, int s2, const dyadic *d2)
{
    const dyadic signed1 = dyadic_signed(d1, s1), signed2 = dyadic_signed(d2, s2);
    const int sum = dyadic_add(&signed1, &signed2).sign;
    if (sum == 0 || sum == x->sign)
        return x->sign;
    if (x->sign == 0)
        return sum;
    const dyadic four = dyadic_make(4, 0), xx = dyadic_mul(x, x);
    const dyadic less = dyadic_sub(&xx, d1), rest = dyadic_sub(&less, d2);
    const dyadic product = dyadic_mul(d1, d2), inside = dyadic_mul(&four, &product);
    return x->sign * oracle_sign_of_surd(&rest, -s1 * s2, &inside);
}

static dyadic times_square(const dyadic *a, const dyadic *b)
{
    const dyadic product = dyadic_mul(a, b);
    return dyadic_mul(&product, b);
}

int oracle_compare(const oracle_root *a, const oracle_root *b)
{
    if (dyadic_sub(&a->q, &b->q).sign == 0) { /* as of two spheres: it cancels */
        const dyadic x = dyadic_sub(&a->p, &b->p);
        return sign_of_two_surds(&x, a->sigma, &a->disc, -b->sigma, &b->disc);
    }
    const dyadic left = dyadic_mul(&a->p, &b->q), right = dyadic_mul(&b->p, &a->q);
    const dyadic x = dyadic_sub(&left, &right);
    const dyadic da = times_square(&a->disc, &b->q), db = times_square(&b->disc, &a->q);
    return sign_of_two_surds(&x, a->sigma, &da, -b->sigma, &db);
}

/* ---- ranges ---- */

static oracle_root rational(dyadic p, dyadic q)
{
    oracle_root root = {.sigma = 0};
    const bool negative = q.sign < 0;
    root.p = dyadic_signed(&p, negative ? -1 : 1);
    root.q = dyadic_signed(&q, negative ? -1 : 1);
    root.disc = dyadic_make(0, 0);
    root.t = dyadic_real(&p) / dyadic_real(&q);
    return root;
}

/* The point from which rounding to nearest gives f rather than the float below, moved up by at most 31/64 of their
 * distance. A tie goes to an even f. */
static dyadic lower_end(float f, int above, bool *inside)
{
    uint32_t bits;
    const dyadic value = dyadic_of_float(f);
    memcpy(&bits, &f, sizeof bits);
    const int field = (int)(bits >> 23 & 255), exponent = field ? field - 150 : -149;
    const bool power_of_two = value.sign > 0 && (bits & 0x7fffff) == 0 && field > 1; /* the next binade is below */
    const dyadic down = dyadic_make(above - 32, exponent - power_of_two - 6);
    *inside = above > 0 || (above == 0 && (bits & 1) == 0);
    return dyadic_add(&value, &down);
}

oracle_range oracle_range_make(float t_min, float t_max, int inwards)
{
    const float largest = 0x1.fffffep127f;
    oracle_range range;
    const dyadic one = dyadic_make(1, 0);
    const bool empty = t_min == INFINITY || t_max == -INFINITY;
    const dyadic low = lower_end(t_min == -INFINITY || empty ? -largest : t_min, inwards, &range.low_inside);
    const dyadic below = lower_end(t_max == INFINITY || empty ? -largest : -t_max, inwards, &range.high_inside);
    const dyadic high = dyadic_signed(&below, empty ? 1 : -1);
    range.low = rational(low, one);
    range.high = rational(high, one);
    return range;
}

bool oracle_is_in(const oracle_root *root, const oracle_range *range)
{
    const int low = oracle_compare(root, &range->low);
    if (low < 0 || (low == 0 && !range->low_inside))
        return false;
    const int high = oracle_compare(root, &range->high);
    return high < 0 || (high == 0 && range->high_inside);
}

/* ---- roots ---- */

static bool is_finite(const float *f, int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(f[i]))
            return false;
    return true;
}

bool oracle_line_make(const truth_ray *ray, oracle_line *line)
{
    if (!is_finite(ray->org, 3) || !is_finite(ray->dir, 3) || isnan(ray->t_min) || isnan(ray->t_max))
        return false;
    for (int a = 0; a < 3; a++) {
        line->org[a] = dyadic_of_float(ray->org[a]);
        line->dir[a] = dyadic_of_float(ray->dir[a]);
    }
    line->dd = dyadic_dot(line->dir, line->dir);
    return line->dd.sign != 0;
}

void oracle_from_origin(const oracle_line *line, const float point[3], dyadic result[3])
{
    for (int a = 0; a < 3; a++) {
        const dyadic x = dyadic_of_float(point[a]);
        result[a] = dyadic_sub(&x, &line->org[a]);
    }
}

/* The larger root by a sum, the other by their product: nothing cancels. */
static void values_of_roots(const dyadic *p, const dyadic *product, oracle_root roots[2])
{
    const truth_real b = dyadic_real(p), s = truth_square_root(dyadic_real(&roots[0].disc));
    const truth_real sum = p->sign >= 0 ? b + s : b - s;
    const truth_real large = sum / dyadic_real(&roots[0].q), small = sum != 0 ? dyadic_real(product) / sum : 0;
    roots[0].t = p->sign >= 0 ? small : large;
    roots[1].t = p->sign >= 0 ? large : small;
}

int oracle_quadratic_roots(const dyadic *p, const dyadic *q, const dyadic *product, oracle_root roots[2])
{
    const dyadic square = dyadic_mul(p, p), both = dyadic_mul(q, product), disc = dyadic_sub(&square, &both);
    if (disc.sign < 0)
        return 0;
    for (int i = 0; i < 2; i++)
        roots[i] = (oracle_root){.p = *p, .q = *q, .disc = disc, .sigma = 2 * i - 1};
    values_of_roots(p, product, roots);
    return disc.sign > 0 ? 2 : 1; /* a tangent line meets it once */
}

int oracle_sphere_roots(const oracle_line *line, const float sphere[4], oracle_root roots[2])
{
    dyadic c[3];
    const dyadic r = dyadic_of_float(sphere[3]);
    if (r.sign < 0)
        return 0;
    oracle_from_origin(line, sphere, c);
    const dyadic rr = dyadic_mul(&r, &r), cc = dyadic_dot(c, c);
    const dyadic power = dyadic_sub(&cc, &rr), dc = dyadic_dot(line->dir, c);
    return oracle_quadratic_roots(&dc, &line->dd, &power, roots);
}

typedef struct barycentric {
    dyadic w[3], sum; /* weights of the vertices times sum, sum = d . n */
    dyadic volume;    /* p0 . (p1 x p2) */
} barycentric;

static barycentric make_barycentric(const oracle_line *line, const float vertex[9])
{
    barycentric b;
    dyadic p[3][3], cross[3];
    for (int i = 0; i < 3; i++)
        oracle_from_origin(line, vertex + 3 * i, p[i]);
    for (int i = 2; i >= 0; i--) {
        dyadic_cross(p[(i + 1) % 3], p[(i + 2) % 3], cross);
        b.w[i] = dyadic_dot(line->dir, cross);
    }
    b.volume = dyadic_dot(p[0], cross);
    const dyadic first = dyadic_add(&b.w[0], &b.w[1]);
    b.sum = dyadic_add(&first, &b.w[2]);
    return b;
}

int oracle_triangle_side(const oracle_line *line, const float vertex[9])
{
    return make_barycentric(line, vertex).sum.sign;
}

static int roots_of_triangle(const oracle_line *line, const float vertex[9], oracle_root *root)
{
    const barycentric b = make_barycentric(line, vertex);
    if (b.sum.sign == 0)
        return 0;
    for (int i = 0; i < 3; i++)
        if (b.w[i].sign == -b.sum.sign)
            return 0;
    *root = rational(b.volume, b.sum);
    return 1;
}

int oracle_roots(const oracle_line *line, const oracle_primitive *primitive, oracle_root roots[2])
{
    if (!is_finite(primitive->data, oracle_floats(primitive->kind)))
        return 0;
    switch (primitive->kind) {
    case ORACLE_SPHERE: return oracle_sphere_roots(line, primitive->data, roots);
    case ORACLE_CAPSULE: return oracle_capsule_roots(line, primitive->data, roots);
    case ORACLE_TRIANGLE: break;
    }
    return roots_of_triangle(line, primitive->data, roots);
}

int oracle_first_root(const oracle_line *line, const oracle_primitive *primitive, const oracle_range *range,
                      oracle_root *first)
{
    oracle_root roots[2];
    const int count = oracle_roots(line, primitive, roots);
    for (int i = 0; i < count; i++)
        if (oracle_is_in(&roots[i], range)) {
            *first = roots[i];
            return i;
        }
    return -1;
}

/* ---- what a hit carries ---- */

void oracle_make_unit(truth_real v[3])
{
    truth_real largest = 0;
    for (int a = 0; a < 3; a++)
        if (largest < (v[a] < 0 ? -v[a] : v[a]))
            largest = v[a] < 0 ? -v[a] : v[a];
    for (int a = 0; a < 3; a++)
        v[a] /= largest;
    const truth_real length = truth_square_root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int a = 0; a < 3; a++)
        v[a] /= length;
}

/* With s = sqrt(disc), the point minus the centre is (dc d - dd c + sigma s d) / dd; the first two terms cancel, and
 * are exact. */
void oracle_describe_sphere(const oracle_line *line, const float sphere[4], const oracle_root *root, oracle_hit *hit)
{
    dyadic c[3];
    oracle_from_origin(line, sphere, c);
    const bool is_point = dyadic_of_float(sphere[3]).sign == 0;
    const truth_real s = truth_square_root(dyadic_real(&root->disc));
    for (int a = 0; a < 3; a++) {
        const dyadic plus = dyadic_mul(&root->p, &line->dir[a]), minus = dyadic_mul(&line->dd, &c[a]);
        const dyadic aside = dyadic_sub(&plus, &minus);
        const truth_real d = dyadic_real(&line->dir[a]);
        hit->normal[a] = is_point ? -d : dyadic_real(&aside) + root->sigma * s * d;
    }
    oracle_make_unit(hit->normal);
}

static void describe_triangle(const oracle_line *line, const float vertex[9], oracle_hit *hit)
{
    dyadic v[3][3], edge[2][3], n[3];
    for (int i = 0; i < 9; i++)
        v[i / 3][i % 3] = dyadic_of_float(vertex[i]);
    for (int a = 0; a < 3; a++) {
        edge[0][a] = dyadic_sub(&v[1][a], &v[0][a]);
        edge[1][a] = dyadic_sub(&v[2][a], &v[0][a]);
    }
    dyadic_cross(edge[0], edge[1], n);
    for (int a = 0; a < 3; a++)
        hit->normal[a] = dyadic_real(&n[a]);
    oracle_make_unit(hit->normal);
    const barycentric b = make_barycentric(line, vertex);
    for (int i = 0; i < 2; i++)
        hit->uv[i] = dyadic_real(&b.w[i + 1]) / dyadic_real(&b.sum);
}

void oracle_describe(const oracle_line *line, const oracle_primitive *primitive, const oracle_root *root,
                     oracle_hit *hit)
{
    hit->t = root->t;
    hit->uv[0] = hit->uv[1] = 0;
    switch (primitive->kind) {
    case ORACLE_SPHERE: oracle_describe_sphere(line, primitive->data, root, hit); break;
    case ORACLE_TRIANGLE: describe_triangle(line, primitive->data, hit); break;
    case ORACLE_CAPSULE: oracle_describe_capsule(line, primitive->data, root, hit); break;
    }
}
