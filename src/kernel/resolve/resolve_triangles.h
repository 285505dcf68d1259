/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t, u, v and normals of the rays that hit triangles, a vector at a time; values that suffer from cancellation in exact
 * arithmetic, ray by ray. */
#ifndef CGT_RESOLVE_TRIANGLES_H
#define CGT_RESOLVE_TRIANGLES_H

#include "exact/decide.h"
#include "exact/triangle_pair.h"
#include "spux_double.h"
#include "kernel/resolve/hit_primitives.h"

/* ---- a ray ---- */

/* Clamps a share to [0, 1], where the exact value is. */
CGT_SPU_INLINE float share_of(double u)
{
    const float rounded = (float)u, low = rounded > 0 ? rounded : 0;
    return low < 1 ? low : 1;
}

/* The shares of the second and third vertex. Returns whether they had to be computed exactly. */
static bool resolve_ray_uv(const cgt_ray *ray, const cgt_triangle *q, const cgt_triangle_plane *plane, double share[2])
{
    const cgt_triangle_sides s = cgt_triangle_double_sides(ray->line.org, ray->line.dir, q);
    bool safe = plane->den_error <= CGT_DOUBLE_SAFE * fabs(plane->den);
    const double r = 1 / plane->den;
    for (int k = 1; k < 3; k++) {
        share[k - 1] = s.w[k] * r;
        safe = safe && s.error[k] <= CGT_DOUBLE_SAFE * fabs(s.w[k]);
    }
    if (!safe)
        cgt_exact_uv(&ray->line, q, share);
    return !safe;
}

/* A component of the normal is a difference of two products, each within 3 u of the exact one: two edges, one product.
 * With the difference, it errs by at most 4 u of the sum of their sizes. The products are 0 where the triangle lies
 * along an axis: then 0 is exact. Over CGT_DOUBLE_SAFE, with u^2 in it: */
#define RESOLVE_NORMAL_ERROR (5 * CGT_DOUBLE_U / CGT_DOUBLE_SAFE)

/* The unit normal of a triangle's plane, whose normal in double is n. */
static void resolve_unit_normal(const cgt_triangle *q, const double in_double[3], double unit[3])
{
    double n[3];
    bool safe = true;
    for (int a = 0; a < 3; a++) {
        const int j = (a + 1) % 3, k = (a + 2) % 3;
        const double e1[2] = {(double)q->v[1][j] - (double)q->v[0][j], (double)q->v[1][k] - (double)q->v[0][k]};
        const double e2[2] = {(double)q->v[2][j] - (double)q->v[0][j], (double)q->v[2][k] - (double)q->v[0][k]};
        n[a] = in_double[a];
        safe = safe && (fabs(e1[0] * e2[1]) + fabs(e1[1] * e2[0])) * RESOLVE_NORMAL_ERROR <= fabs(n[a]);
    }
    if (!safe) {
        cgt_exact_normal(q, n);
        for (int a = 0; a < 3; a++) /* whole numbers have no -0, and double, where it is right, too, may have it */
            n[a] = n[a] == 0 && in_double[a] == 0 ? in_double[a] : n[a];
    }
    const double r = 1 / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int a = 0; a < 3; a++)
        unit[a] = n[a] * r;
}

/* The fields of one triangle's hit. */
typedef struct resolved_triangle {
    float t, u, v, normal[3];
} resolved_triangle;

/* A ray with a value that suffers from cancellation. */
__attribute__((noinline, unused)) static resolved_triangle
resolve_triangle_ray(const cgt_ray *ray, const cgt_triangle *q, uint32_t fields, cgt_counts *counts)
{
    const cgt_triangle_plane plane = cgt_triangle_double_plane(ray->line.org, ray->line.dir, q);
    resolved_triangle h = {0};
    bool was_exact = false;
    if (fields & CGT_FIELD_T) {
        cgt_triangle_plane refined = plane;
        h.t = (float)cgt_canonical_triangle_t(ray, q);
        if (!cgt_triangle_double_t_safe(&plane))
            cgt_triangle_refine_num(ray->line.org, q, &refined);
        was_exact = !cgt_triangle_double_t_safe(&refined);
    }
    if (fields & CGT_FIELD_UV) {
        double share[2];
        was_exact |= resolve_ray_uv(ray, q, &plane, share);
        h.u = share_of(share[0]);
        h.v = share_of(share[1]);
    }
    counts->exact_values += was_exact;
    if (fields & CGT_FIELD_NORMAL) {
        double unit[3];
        resolve_unit_normal(q, plane.n, unit);
        for (int a = 0; a < 3; a++)
            h.normal[a] = (float)unit[a];
    }
    return h;
}

/* ---- a vector of rays ---- */

/* Half a vector of rays and their triangles: the steps of cgt_triangle_double_plane, in its order. */
typedef struct resolve_half_plane {
    vdouble d[3], org[3], v[3][3];
    vdouble n[3], num, den, edges, t_margin, den_margin; /* margins: above 0 if t, or den, is safe */
    vdouble normal_error[3];                             /* a component of n is safe if it is not smaller */
} resolve_half_plane;

#define NORM1(x) (spux_double_abs((x)[0]) + spux_double_abs((x)[1]) + spux_double_abs((x)[2]))
#define DOT(p, q) ((p)[0] * (q)[0] + (p)[1] * (q)[1] + (p)[2] * (q)[2])

/* Splits rays and the triangles that they hit into halves. */
CGT_SPU_INLINE void resolve_half_load(const vfloat org[3], const vfloat dir[3], const vfloat vertex[3][3],
                                      resolve_half_plane h[2])
{
    for (int a = 0; a < 3; a++) {
        h[0].d[a] = spux_double_low(dir[a]);
        h[1].d[a] = spux_double_high(dir[a]);
        h[0].org[a] = spux_double_low(org[a]);
        h[1].org[a] = spux_double_high(org[a]);
        for (int k = 0; k < 3; k++) {
            h[0].v[k][a] = spux_double_low(vertex[k][a]);
            h[1].v[k][a] = spux_double_high(vertex[k][a]);
        }
    }
}

/* The terms that do not depend on the rays' directions. */
CGT_SPU_INLINE void resolve_half_normal(resolve_half_plane *h)
{
    vdouble a[3], e1[3], e2[3];
    for (int k = 0; k < 3; k++) {
        a[k] = h->v[0][k] - h->org[k];
        e1[k] = h->v[1][k] - h->v[0][k];
        e2[k] = h->v[2][k] - h->v[0][k];
    }
    for (int k = 0; k < 3; k++) { /* as CGT_CROSS */
        const vdouble p = e1[(k + 1) % 3] * e2[(k + 2) % 3], q = e1[(k + 2) % 3] * e2[(k + 1) % 3];
        h->n[k] = p - q;
        h->normal_error[k] = (spux_double_abs(p) + spux_double_abs(q)) * RESOLVE_NORMAL_ERROR;
    }
    h->edges = NORM1(e1) * NORM1(e2) * CGT_TRIANGLE_DOUBLE_ERROR;
    h->num = DOT(h->n, a);
    h->t_margin = spux_double_abs(h->num) * CGT_DOUBLE_SAFE - h->edges * NORM1(a);
}

/* The lanes with a component whose bound is too large. */
CGT_SPU_INLINE vmask resolve_doubtful_normals(const resolve_half_plane h[2])
{
    vmask lanes = spux_mask_none();
    for (int a = 0; a < 3; a++) {
        const vdouble size[2] = {spux_double_abs(h[0].n[a]), spux_double_abs(h[1].n[a])};
        const vdouble error[2] = {h[0].normal_error[a], h[1].normal_error[a]};
        lanes = spu_or(lanes, spux_double_cmpgt(error, size));
    }
    return lanes;
}

/* 0 if both edges are exact and of at most 26 bits. Then their products are exact, and n is the exact normal, rounded
 * once, as whole numbers give it. Of v - v0 and v0 + e, the one with the larger v is exact, so both tests together
 * tell whether the edge e is. Times 2^27 + 1, a number is rounded to its first 26 bits (Veltkamp). */
CGT_SPU_INLINE vdouble resolve_half_lost_bits(const resolve_half_plane *h)
{
    vdouble lost = spux_vdouble(0);
    for (int k = 1; k < 3; k++)
        for (int a = 0; a < 3; a++) {
            const vdouble v0 = h->v[0][a], v = h->v[k][a], e = v - v0, wide = e * spux_vdouble(0x1p27 + 1);
            lost = lost + spux_double_abs(v - e - v0) + spux_double_abs(v0 + e - v) +
                   spux_double_abs(wide - (wide - e) - e);
        }
    return lost;
}

/* The lanes whose normal takes whole numbers. On a roof, where components are differences of equal products, small
 * triangles seldom do. */
CGT_SPU_INLINE vmask resolve_unsafe_normals(const resolve_half_plane h[2])
{
    const vmask doubtful = resolve_doubtful_normals(h);
    if (spux_none(doubtful))
        return doubtful;
    const vdouble lost[2] = {resolve_half_lost_bits(&h[0]), resolve_half_lost_bits(&h[1])};
    const vdouble zero[2] = {spux_vdouble(0), spux_vdouble(0)};
    return spu_and(doubtful, spux_double_cmpgt(lost, zero));
}

CGT_SPU_INLINE void resolve_half_plane_init(resolve_half_plane *h)
{
    resolve_half_normal(h);
    h->den = DOT(h->d, h->n);
    h->den_margin = spux_double_abs(h->den) * CGT_DOUBLE_SAFE - h->edges * NORM1(h->d);
}

/* The cross product of the edge from vertex `from` to `to`, as in cgt_triangle_double_edge. Returns its error bound. */
CGT_SPU_INLINE vdouble resolve_half_edge(const resolve_half_plane *h, int from, int to, vdouble cross[3])
{
    vdouble b[3], e[3];
    for (int a = 0; a < 3; a++) {
        b[a] = h->v[from][a] - h->org[a];
        e[a] = h->v[to][a] - h->v[from][a];
    }
    for (int a = 0; a < 3; a++)
        cross[a] = CGT_CROSS(b, e, (a + 1) % 3, (a + 2) % 3);
    return CGT_TRIANGLE_DOUBLE_ERROR * NORM1(b) * NORM1(e);
}

/* w1 or w2: the side of the edge, as in cgt_triangle_double_sides. margin: above 0 if it is safe. */
CGT_SPU_INLINE vdouble resolve_half_side(const resolve_half_plane *h, int from, int to, vdouble *margin)
{
    vdouble cross[3];
    const vdouble error = resolve_half_edge(h, from, to, cross), side = DOT(h->d, cross);
    *margin = spux_double_abs(side) * CGT_DOUBLE_SAFE - NORM1(h->d) * error;
    return side;
}

/* The results of a vector of rays. */
typedef struct resolved_triangles {
    vfloat t, u, v, normal[3];
} resolved_triangles;

/* Those of b in the lanes of m, those of a in the others. */
CGT_SPU_INLINE resolved_triangles resolved_triangles_select(const resolved_triangles *a, const resolved_triangles *b,
                                                            vmask m)
{
    resolved_triangles s = *a;
    s.t = spux_select(a->t, b->t, m);
    s.u = spux_select(a->u, b->u, m);
    s.v = spux_select(a->v, b->v, m);
    for (int k = 0; k < 3; k++)
        s.normal[k] = spux_select(a->normal[k], b->normal[k], m);
    return s;
}

CGT_SPU_INLINE vfloat shares_of(vdouble low, vdouble high)
{
    const vfloat share = spux_float_of(low, high), zero = spux_vfloat(0), one = spux_vfloat(1);
    const vfloat above = spux_select(zero, share, spu_cmpgt(share, zero));
    return spux_select(one, above, spu_cmpgt(one, above));
}

CGT_SPU_INLINE vmask resolve_vector_uv(const resolve_half_plane h[2], resolved_triangles *to)
{
    const vdouble r[2] = {spux_vdouble(1) / h[0].den, spux_vdouble(1) / h[1].den};
    vmask safe_lanes = spux_double_above0(h[0].den_margin, h[1].den_margin);
    for (int k = 0; k < 2; k++) { /* w1: the edge from v2 to v0, w2: from v0 to v1 */
        const int from = k ? 0 : 2, end = k ? 1 : 0;
        vdouble margin[2];
        const vdouble low = resolve_half_side(&h[0], from, end, &margin[0]);
        const vdouble high = resolve_half_side(&h[1], from, end, &margin[1]);
        *(k ? &to->v : &to->u) = shares_of(low * r[0], high * r[1]);
        safe_lanes = spu_and(safe_lanes, spux_double_above0(margin[0], margin[1]));
    }
    return safe_lanes;
}

CGT_SPU_INLINE vmask resolve_vector_normal(const resolve_half_plane h[2], resolved_triangles *to)
{
    const vdouble low = spux_vdouble(1) / spux_double_sqrt(DOT(h[0].n, h[0].n));
    const vdouble high = spux_vdouble(1) / spux_double_sqrt(DOT(h[1].n, h[1].n));
    for (int a = 0; a < 3; a++)
        to->normal[a] = spux_float_of(h[0].n[a] * low, h[1].n[a] * high);
    return spux_not(resolve_unsafe_normals(h));
}

/* Returns the lanes whose result is right; the others are left to resolve_triangle_ray. */
CGT_SPU_INLINE vmask resolve_triangles_vector(const vfloat org[3], const vfloat dir[3], const vfloat vertex[3][3],
                                              uint32_t fields, resolved_triangles *to)
{
    resolve_half_plane h[2];
    vmask safe_lanes = spux_mask_all();
    resolve_half_load(org, dir, vertex, h);
    resolve_half_plane_init(&h[0]);
    resolve_half_plane_init(&h[1]);
    if (fields & CGT_FIELD_T) {
        to->t = spux_float_of(h[0].num / h[0].den, h[1].num / h[1].den);
        safe_lanes = spu_and(spux_double_above0(h[0].t_margin, h[1].t_margin),
                             spux_double_above0(h[0].den_margin, h[1].den_margin));
    }
    if (fields & CGT_FIELD_UV)
        safe_lanes = spu_and(safe_lanes, resolve_vector_uv(h, to));
    if (fields & CGT_FIELD_NORMAL)
        safe_lanes = spu_and(safe_lanes, resolve_vector_normal(h, to));
    return safe_lanes;
}

/* ---- triangles seen from one origin ---- */

/* The terms that all rays from one origin to a triangle share, as one record of 8 doubles, or two if u and v are asked
 * for:
 *
 *   0    1    2    3    4                5    6    7
 *   n_x  n_y  n_z  num  error of den     unit normal          error over |d|; +infinity if t is not safe
 *   cross product of w1 and of w2 ...        error  error     over |d|
 *
 * n, num and den are those of cgt_triangle_double_plane. */
enum { PREPARED_N = 0, PREPARED_NUM = 3, PREPARED_ERROR = 4, PREPARED_NORMAL = 5 };
enum { PREPARED_SIDE = 0, PREPARED_SIDE_ERROR = 6 };
#define PREPARED_RECORD 8u

/* |d| is summed in another order than for a single ray: the bound allows for its rounding. */
#define PREPARED_ERROR_SCALE 1.01

CGT_SPU_INLINE void prepare_half_plane(resolve_half_plane *h, uint32_t fields, vdouble record[8])
{
    const vdouble margin = fields & CGT_FIELD_T ? h->t_margin : spux_vdouble(1);
    vdouble r = spux_vdouble(0);
    if (fields & CGT_FIELD_NORMAL)
        r = spux_vdouble(1) / spux_double_sqrt(DOT(h->n, h->n));
    for (int a = 0; a < 3; a++) {
        record[PREPARED_N + a] = h->n[a];
        record[PREPARED_NORMAL + a] = h->n[a] * r;
    }
    record[PREPARED_NUM] = h->num;
    record[PREPARED_ERROR] =
        spux_double_select(spux_vdouble(INFINITY), h->edges * spux_vdouble(PREPARED_ERROR_SCALE), margin);
}

CGT_SPU_INLINE void prepare_half_sides(const resolve_half_plane *h, vdouble record[8])
{
    for (int k = 0; k < 2; k++) {
        vdouble cross[3];
        const vdouble error = resolve_half_edge(h, k ? 0 : 2, k ? 1 : 0, cross);
        for (int a = 0; a < 3; a++)
            record[PREPARED_SIDE + 3 * k + a] = cross[a];
        record[PREPARED_SIDE_ERROR + k] = error * spux_vdouble(PREPARED_ERROR_SCALE);
    }
}

/* The normal of one lane, once for all its rays, where double is not safe. */
__attribute__((noinline, unused)) static void prepare_exact_normal(const vfloat vertex[3][3], int lane, double *record)
{
    cgt_triangle q;
    for (int k = 0; k < 9; k++)
        q.v[k / 3][k % 3] = vertex[k / 3][k % 3][lane];
    resolve_unit_normal(&q, record + PREPARED_N, record + PREPARED_NORMAL);
}

/* Prepares a vector of triangles: the first record of each is stored `stride` doubles after that of the one before, a
 * second one right behind the first. */
CGT_SPU_INLINE void prepare_triangles(const float eye[3], const vfloat vertex[3][3], uint32_t fields, double *to,
                                      size_t stride)
{
    const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
    resolve_half_plane h[2];
    resolve_half_load(org, org, vertex, h); /* directions are not used */
    for (size_t half = 0; half < 2; half++) {
        vdouble record[8];
        resolve_half_normal(&h[half]);
        prepare_half_plane(&h[half], fields, record);
        spux_double_store8(to + half * CGT_DOUBLES * stride, stride, record);
        if (fields & CGT_FIELD_UV) {
            prepare_half_sides(&h[half], record);
            spux_double_store8(to + half * CGT_DOUBLES * stride + PREPARED_RECORD, stride, record);
        }
    }
    unsigned unsafe = fields & CGT_FIELD_NORMAL ? spux_mask_bits(resolve_unsafe_normals(h)) : 0;
    for (; unsafe; unsafe &= unsafe - 1) {
        const int lane = __builtin_ctz(unsafe);
        prepare_exact_normal(vertex, lane, to + (size_t)lane * stride);
    }
}

/* The results of half a vector of rays. */
typedef struct prepared_half {
    vdouble t, den, margin;
    vdouble normal[3];
    vdouble side[2], side_margin[2];
} prepared_half;

CGT_SPU_INLINE void resolve_prepared_half(const vdouble d[3], const vdouble record[8], prepared_half *h)
{
    h->den = DOT(d, record + PREPARED_N);
    h->t = record[PREPARED_NUM] / h->den;
    h->margin = spux_double_abs(h->den) * CGT_DOUBLE_SAFE - NORM1(d) * record[PREPARED_ERROR];
    for (int a = 0; a < 3; a++)
        h->normal[a] = record[PREPARED_NORMAL + a];
}

CGT_SPU_INLINE void resolve_prepared_sides(const vdouble d[3], const vdouble record[8], prepared_half *h)
{
    const vdouble r = spux_vdouble(1) / h->den;
    for (int k = 0; k < 2; k++) {
        const vdouble w = DOT(d, record + PREPARED_SIDE + 3 * k);
        h->side[k] = w * r;
        h->side_margin[k] = spux_double_abs(w) * CGT_DOUBLE_SAFE - NORM1(d) * record[PREPARED_SIDE_ERROR + k];
    }
}

/* Returns the lanes whose result is right. */
CGT_SPU_INLINE vmask resolve_prepared_halves(const prepared_half h[2], uint32_t fields, resolved_triangles *to)
{
    vmask safe_lanes = spux_double_above0(h[0].margin, h[1].margin);
    to->t = spux_float_of(h[0].t, h[1].t);
    if (fields & CGT_FIELD_UV) {
        to->u = shares_of(h[0].side[0], h[1].side[0]);
        to->v = shares_of(h[0].side[1], h[1].side[1]);
        for (int k = 0; k < 2; k++)
            safe_lanes = spu_and(safe_lanes, spux_double_above0(h[0].side_margin[k], h[1].side_margin[k]));
    }
    if (fields & CGT_FIELD_NORMAL)
        for (int a = 0; a < 3; a++)
            to->normal[a] = spux_float_of(h[0].normal[a], h[1].normal[a]);
    return safe_lanes;
}

/* Loads the records of half a vector: offset[k] doubles from `record` on, or `record` itself in all lanes if offset is
 * NULL. */
CGT_SPU_INLINE void prepared_load(const double *record, const uint32_t *offset, vdouble q[8])
{
    if (offset)
        spux_double_load8_at(record, offset, q);
    else
        for (uint32_t k = 0; k < 8; k++)
            q[k] = spux_vdouble(record[k]);
}

/* Resolves rays from the prepared origin, each with its own record. */
CGT_SPU_INLINE vmask resolve_prepared(const double *record, const uint32_t *offset, const vfloat dir[3],
                                      uint32_t fields, resolved_triangles *to)
{
    prepared_half h[2];
    for (uint32_t half = 0; half < 2; half++) {
        const uint32_t *half_offset = offset ? offset + half * CGT_DOUBLES : NULL;
        vdouble d[3], q[8];
        for (int a = 0; a < 3; a++)
            d[a] = half ? spux_double_high(dir[a]) : spux_double_low(dir[a]);
        prepared_load(record, half_offset, q);
        resolve_prepared_half(d, q, &h[half]);
        if (fields & CGT_FIELD_UV) {
            prepared_load(record + PREPARED_RECORD, half_offset, q);
            resolve_prepared_sides(d, q, &h[half]);
        }
    }
    return resolve_prepared_halves(h, fields, to);
}

#undef DOT
#undef NORM1

#endif
