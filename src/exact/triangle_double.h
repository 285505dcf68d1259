/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ray and triangle in double precision on the float input, in one order of operations, unfused, with error bounds.
 *
 * With a, b, c the vertices seen from the origin, the line's side of each edge is a determinant (Pluecker coordinates):
 *   w0 = d.(b x c)   w1 = d.(c x a)   w2 = d.(a x b)
 * The line meets the closed triangle where none of them differs in sign from the others, and their sum d.n, with
 * n = (v1 - v0) x (v2 - v0), is not zero. t = n.a / d.n, u = w1 / d.n, v = w2 / d.n. A cross product of two vertices is
 * that of one of them with the edge between: it cancels less.
 *
 * Bounds, with e = 2^-53: every product of three factors passes at most 8 roundings (two differences, two products, one
 * difference, two sums; 9 for n.a), and the sum of the magnitudes of a determinant's products is at most the product of
 * the 1-norms of its vectors. So each is within 9 e of that; 10 e covers what is of second order. */
#ifndef CGT_TRIANGLE_DOUBLE_H
#define CGT_TRIANGLE_DOUBLE_H

#include "exact/sphere_double.h"

#define CGT_TRIANGLE_DOUBLE_ERROR (10 * CGT_DOUBLE_U)

typedef struct cgt_triangle_plane {
    double num, den; /* t = num / den */
    double num_error, den_error;
    double n[3];
} cgt_triangle_plane;

/* A product of two numbers and one of two others, subtracted. */
#define CGT_CROSS(p, q, i, j) ((p)[i] * (q)[j] - (p)[j] * (q)[i])

static inline cgt_triangle_plane cgt_triangle_double_plane(const float org[3], const float dir[3],
                                                           const cgt_triangle *q)
{
    const double d[3] = {dir[0], dir[1], dir[2]};
    double a[3], e1[3], e2[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)q->v[0][k] - (double)org[k];
        e1[k] = (double)q->v[1][k] - (double)q->v[0][k];
        e2[k] = (double)q->v[2][k] - (double)q->v[0][k];
    }
    const double n[3] = {CGT_CROSS(e1, e2, 1, 2), CGT_CROSS(e1, e2, 2, 0), CGT_CROSS(e1, e2, 0, 1)};
    const double edges = (fabs(e1[0]) + fabs(e1[1]) + fabs(e1[2])) * (fabs(e2[0]) + fabs(e2[1]) + fabs(e2[2])) *
                         CGT_TRIANGLE_DOUBLE_ERROR;
    return (cgt_triangle_plane){.num = n[0] * a[0] + n[1] * a[1] + n[2] * a[2],
                                .den = d[0] * n[0] + d[1] * n[1] + d[2] * n[2],
                                .num_error = edges * (fabs(a[0]) + fabs(a[1]) + fabs(a[2])),
                                .den_error = edges * (fabs(d[0]) + fabs(d[1]) + fabs(d[2])),
                                .n = {n[0], n[1], n[2]}};
}

static inline bool cgt_triangle_double_t_safe(const cgt_triangle_plane *p)
{
    return (p->num_error <= CGT_DOUBLE_SAFE * fabs(p->num)) & (p->den_error <= CGT_DOUBLE_SAFE * fabs(p->den));
}

/* Whether t is certainly beyond a range, rounded to float as canonical ones are, which keeps the order. Where |den| is
 * above four times its error, num / den is within 4/3 (num_error + |t| den_error) / |den| of the exact t, and the
 * canonical one is within 2^-50 of that. */
static inline bool cgt_triangle_double_t_beyond(const cgt_triangle_plane *p, float t_min, float t_max)
{
    const double t = p->num / p->den, size = fabs(p->den);
    const double error = (p->num_error + fabs(t) * p->den_error) / size * 1.34 + fabs(t) * 0x1p-48;
    return size > 4 * p->den_error && ((float)(t + error) < t_min || (float)(t - error) > t_max);
}

/* Whether a line is parallel to the triangle's plane because it does not move along an axis across which the triangle
 * has no extent: exact, and true wherever all products of the determinants vanish in an axis plane. */
static inline bool cgt_triangle_is_parallel(const float dir[3], const cgt_triangle *q)
{
    bool parallel = false;
    for (int a = 0; a < 3; a++)
        parallel |= dir[a] == 0 && q->v[0][a] == q->v[1][a] && q->v[0][a] == q->v[2][a];
    return parallel;
}

/* Whether two triangles certainly lie in one plane: they have one coordinate along an axis, or the same vertices. */
static inline bool cgt_triangles_share_plane(const cgt_triangle *p, const cgt_triangle *q)
{
    int shared = 0;
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            shared += p->v[k][0] == q->v[j][0] && p->v[k][1] == q->v[j][1] && p->v[k][2] == q->v[j][2];
    bool flat = false;
    for (int a = 0; a < 3; a++) {
        const float at = p->v[0][a];
        flat |= p->v[1][a] == at && p->v[2][a] == at && q->v[0][a] == at && q->v[1][a] == at && q->v[2][a] == at;
    }
    return flat || shared == 3; /* their vertices are three different ones, since they have areas */
}

/* Whether two triangles lie in one plane, told for certain where all coordinates are multiples of 2^(e - 15), 2^e above
 * the largest: in such units they are at most 2^15, differences 2^16, components of the normal 2^33, and sums of three
 * products are below 2^51, so that nothing is rounded. Adding 1.5 2^52 units rounds to a multiple. */
static inline bool cgt_triangles_share_lattice_plane(const cgt_triangle *p, const cgt_triangle *q)
{
    const float *const of[2] = {p->v[0], q->v[0]};
    double most = 0, e1[3], e2[3];
    int exponent;
    for (int i = 0; i < 18; i++)
        most = fmax(most, fabs((double)of[i / 9][i % 9]));
    frexp(most, &exponent);
    const double round = ldexp(0x1.8p52, exponent - 15);
    bool share = true;
    for (int i = 0; i < 18; i++) {
        const double x = of[i / 9][i % 9];
        share &= (x + round) - round == x;
    }
    for (int a = 0; a < 3; a++) {
        e1[a] = (double)p->v[1][a] - (double)p->v[0][a];
        e2[a] = (double)p->v[2][a] - (double)p->v[0][a];
    }
    for (int k = 0; k < 3; k++) {
        double height = 0;
        for (int a = 0; a < 3; a++)
            height += CGT_CROSS(e1, e2, (a + 1) % 3, (a + 2) % 3) * ((double)q->v[k][a] - (double)p->v[0][a]);
        share &= height == 0;
    }
    return share;
}

/* The order of t of two safe planes on one line: -1 where a is certainly nearer, 1 where it is certainly farther, 0
 * where double cannot tell. t_a < t_b if num_a den_b - num_b den_a has the sign opposite to that of den_a den_b. The
 * products are off by the errors of their factors, and by 2^-51 of their magnitudes for rounding and terms of second
 * order, since each factor of a safe plane is within 2^-30. */
static inline int cgt_triangle_double_order(const cgt_triangle_plane *a, const cgt_triangle_plane *b)
{
    const double lhs = a->num * b->den, rhs = b->num * a->den, size = fabs(lhs) + fabs(rhs);
    const double error = fabs(a->num) * b->den_error + fabs(b->den) * a->num_error + fabs(b->num) * a->den_error +
                         fabs(a->den) * b->num_error;
    if (!(fabs(lhs - rhs) > error * (1 + 0x1p-20) + size * 0x1p-51))
        return 0;
    return (lhs < rhs) == ((a->den > 0) == (b->den > 0)) ? -1 : 1;
}

/* The side of the edge between two vertices as a product with d, and a bound for its error over the 1-norm of d. */
static inline double cgt_triangle_double_edge(const float org[3], const cgt_triangle *q, int from, int to,
                                              double cross[3])
{
    double b[3], e[3], size[2] = {0, 0};
    for (int a = 0; a < 3; a++) {
        b[a] = (double)q->v[from][a] - (double)org[a];
        e[a] = (double)q->v[to][a] - (double)q->v[from][a];
        size[0] += fabs(b[a]);
        size[1] += fabs(e[a]);
    }
    for (int a = 0; a < 3; a++)
        cross[a] = CGT_CROSS(b, e, (a + 1) % 3, (a + 2) % 3);
    return CGT_TRIANGLE_DOUBLE_ERROR * size[0] * size[1];
}

/* w0, w1, w2, and a bound for the error of each. */
typedef struct cgt_triangle_sides {
    double w[3], error[3];
} cgt_triangle_sides;

static inline cgt_triangle_sides cgt_triangle_double_sides(const float org[3], const float dir[3],
                                                           const cgt_triangle *q)
{
    const double d[3] = {dir[0], dir[1], dir[2]};
    const double length = (fabs(d[0]) + fabs(d[1]) + fabs(d[2])) * CGT_TRIANGLE_DOUBLE_ERROR;
    cgt_triangle_sides s;
    for (int k = 0; k < 3; k++) {
        const float *from = q->v[(k + 1) % 3], *to = q->v[(k + 2) % 3];
        const double b[3] = {(double)from[0] - (double)org[0], (double)from[1] - (double)org[1],
                             (double)from[2] - (double)org[2]};
        const double e[3] = {(double)to[0] - (double)from[0], (double)to[1] - (double)from[1],
                             (double)to[2] - (double)from[2]};
        s.w[k] = d[0] * CGT_CROSS(b, e, 1, 2) + d[1] * CGT_CROSS(b, e, 2, 0) + d[2] * CGT_CROSS(b, e, 0, 1);
        s.error[k] = length * (fabs(b[0]) + fabs(b[1]) + fabs(b[2])) * (fabs(e[0]) + fabs(e[1]) + fabs(e[2]));
    }
    return s;
}

/* On which side of all edges a line passes, where that is certain: 1 or -1, which is the sign of d.n, or 0 where it
 * passes outside of the triangle. Returns whether it is. */
static inline bool cgt_triangle_sides_tell(const cgt_triangle_sides *s, int *side)
{
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; k++) {
        positive += s->w[k] > s->error[k];
        negative += s->w[k] < -s->error[k];
    }
    *side = (positive == 3) - (negative == 3);
    return *side || (positive && negative);
}

/* The same in double, and 0 where the line is parallel to the triangle's plane for certain. */
static inline bool cgt_triangle_double_side(const float org[3], const float dir[3], const cgt_triangle *q, int *side)
{
    const cgt_triangle_sides s = cgt_triangle_double_sides(org, dir, q);
    return cgt_triangle_sides_tell(&s, side) || cgt_triangle_is_parallel(dir, q);
}

#endif
