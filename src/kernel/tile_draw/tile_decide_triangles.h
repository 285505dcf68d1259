/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Entries of a tile's queue that are about triangles, seen from one eye. Entries of one triangle follow each other, often
 * against one winner: layers near to each other, or faces in one plane. So what double takes of the two triangles is kept
 * from entry to entry, and runs of one pair go a vector at a time. It is the arithmetic of triangle_double.h in its order,
 * so what it is certain of is what decide.h would say.
 *
 * Which of two hits is nearer: t_a < t_b where num_a den_b - num_b den_a has the sign opposite to that of den_a den_b.
 * The products are off by what their factors are, and what is rounded by 2^-51 of their magnitudes. Where that leaves it
 * open, it is asked exactly on which side of one triangle's plane the other one's vertices are. Of a ray that passes
 * between a triangle's edges the hit is a sum of all three vertices with factors above 0: in the plane where they all are,
 * and else beyond it or before it where none of them is on the other side. Num is the eye's side. */
#ifndef CGT_TILE_DECIDE_TRIANGLES_H
#define CGT_TILE_DECIDE_TRIANGLES_H

#include "exact/integer/exact_terms.h"
#include "exact/triangle_double.h"
#include "spux_double.h"
#include "kernel/tile/tile.h"

/* ---- two triangles, seen from the eye ---- */

/* A triangle's plane; den_error is over the 1-norm of a direction, den of none. */
typedef struct tile_seen_plane {
    uint32_t object; /* CGT_INVALID_ID: none yet */
    cgt_triangle triangle;
    cgt_triangle_plane plane;
} tile_seen_plane;

/* What the vertices of two triangles tell of their order. */
typedef enum tile_planes {
    TILE_PLANES_UNKNOWN,
    TILE_PLANES_CROSS, /* nothing */
    TILE_PLANES_SAME,
    TILE_PLANES_NEARER, /* the object is */
    TILE_PLANES_FARTHER
} tile_planes;

/* What is kept from entry to entry. */
typedef struct tile_pair_seen {
    tile_seen_plane object, winner;
    double side[3][3], side_error[3]; /* of the object: as products with d, errors over its 1-norm */
    tile_planes planes;
} tile_pair_seen;

/* False for spheres. */
CGT_SPU_INLINE bool tile_see_plane(const cgt_objects *objects, const float eye[3], uint32_t object, tile_seen_plane *s)
{
    static const float one[3] = {1, 0, 0}; /* of norm 1 */
    const cgt_shape shape = cgt_objects_shape(objects, object);
    s->object = CGT_INVALID_ID;
    if (shape.kind == CGT_KIND_SPHERES)
        return false;
    s->object = object;
    s->triangle = shape.triangle;
    s->plane = cgt_triangle_double_plane(eye, one, &s->triangle);
    return true;
}

CGT_SPU_INLINE bool tile_see_object(const cgt_objects *objects, const float eye[3], uint32_t object, tile_pair_seen *s)
{
    if (s->object.object == object)
        return true;
    s->planes = TILE_PLANES_UNKNOWN;
    if (!tile_see_plane(objects, eye, object, &s->object))
        return false;
    for (int k = 0; k < 3; k++)
        s->side_error[k] = cgt_triangle_double_edge(eye, &s->object.triangle, (k + 1) % 3, (k + 2) % 3, s->side[k]);
    return true;
}

CGT_SPU_INLINE bool tile_see_winner(const cgt_objects *objects, const float eye[3], uint32_t winner, tile_pair_seen *s)
{
    if (s->winner.object == winner)
        return true;
    s->planes = TILE_PLANES_UNKNOWN;
    return tile_see_plane(objects, eye, winner, &s->winner);
}

CGT_SPU_INLINE double tile_product(const double v[3], const cgt_exact_ray *line)
{
    return (double)line->dir[0] * v[0] + (double)line->dir[1] * v[1] + (double)line->dir[2] * v[2];
}

CGT_SPU_INLINE cgt_triangle_plane tile_plane_along(const tile_seen_plane *s, const cgt_exact_ray *line, double size)
{
    cgt_triangle_plane p = s->plane;
    p.den = tile_product(p.n, line);
    p.den_error *= size;
    return p;
}

/* On which sides of the plane of a the vertices of b are: how many are on that of a number above 0, n.(v_0 - v), and of
 * one below. */
CGT_SPU_INLINE void tile_plane_sides(const cgt_triangle *a, const cgt_triangle *b, int *above, int *below)
{
    *above = *below = 0;
    for (int k = 0; k < 3; k++) {
        const cgt_exact_ray from = {.org = {b->v[k][0], b->v[k][1], b->v[k][2]}, .dir = {1, 0, 0}};
        cgt_exact_plane plane;
        cgt_exact_plane_terms(&from, a, &plane);
        *above += plane.number.sign > 0;
        *below += plane.number.sign < 0;
    }
}

/* Which of two triangles is nearer on all rays that pass between the object's edges and meet the winner. */
__attribute__((noinline, unused)) static tile_planes tile_order_planes(const tile_seen_plane *object,
                                                                       const tile_seen_plane *winner)
{
    int above, below;
    tile_plane_sides(&winner->triangle, &object->triangle, &above, &below);
    if (!above && !below)
        return TILE_PLANES_SAME;
    if (!above || !below)
        return (above != 0) == (winner->plane.num > 0) ? TILE_PLANES_NEARER : TILE_PLANES_FARTHER;
    tile_plane_sides(&object->triangle, &winner->triangle, &above, &below); /* the winner's hit may be on an edge */
    if (above == 3 || below == 3)
        return (above != 0) == (object->plane.num > 0) ? TILE_PLANES_FARTHER : TILE_PLANES_NEARER;
    return TILE_PLANES_CROSS;
}

/* What a decision comes to. */
typedef enum tile_answer { TILE_OPEN, TILE_LOSES, TILE_BEATS } tile_answer;

/* Whether the line passes within the object's edges: TILE_BEATS where it does. */
CGT_SPU_INLINE tile_answer tile_decide_sides(const tile_pair_seen *s, const cgt_exact_ray *line, double size)
{
    int left = 0, right = 0;
    for (int k = 0; k < 3; k++) {
        const double w = tile_product(s->side[k], line), error = s->side_error[k] * size;
        left += w > error;
        right += w < -error;
    }
    return left && right ? TILE_LOSES : left == 3 || right == 3 ? TILE_BEATS : TILE_OPEN;
}

/* Which of the two is nearer where both are hit, as far as their vertices tell. */
CGT_SPU_INLINE tile_answer tile_decide_planes(tile_pair_seen *s, cgt_counts *counts)
{
    if (s->planes == TILE_PLANES_UNKNOWN) {
        s->planes = tile_order_planes(&s->object, &s->winner);
        counts->exact_tests++;
    }
    switch (s->planes) {
    case TILE_PLANES_SAME: return s->object.object < s->winner.object ? TILE_BEATS : TILE_LOSES;
    case TILE_PLANES_NEARER: return TILE_BEATS;
    case TILE_PLANES_FARTHER: return TILE_LOSES;
    default: return TILE_OPEN;
    }
}

/* Of two hits, whether the object's is the nearer one. */
CGT_SPU_INLINE tile_answer tile_decide_order(tile_pair_seen *s, const cgt_triangle_plane *a,
                                             const cgt_triangle_plane *b, cgt_counts *counts)
{
    const double left = a->num * b->den, right = b->num * a->den, size = fabs(left) + fabs(right);
    const double error = fabs(a->num) * b->den_error + fabs(b->den) * a->num_error + fabs(b->num) * a->den_error +
                         fabs(a->den) * b->num_error;
    const bool same_sign = (a->den > 0) == (b->den > 0);
    if (fabs(left - right) > error * (1 + 0x1p-20) + size * 0x1p-51)
        return (left < right) == same_sign ? TILE_BEATS : TILE_LOSES;
    return tile_decide_planes(s, counts);
}

/* As filter_beats, of two triangles, or one and none. */
CGT_SPU_INLINE tile_answer tile_decide_pair(const cgt_objects *objects, const cgt_ray *ray, uint32_t winner,
                                            uint32_t object, tile_pair_seen *s, double *hit_t, cgt_counts *counts)
{
    const cgt_exact_ray *line = &ray->line;
    const double size = fabs((double)line->dir[0]) + fabs((double)line->dir[1]) + fabs((double)line->dir[2]);
    if (!tile_see_object(objects, line->org, object, s))
        return TILE_OPEN;
    const tile_answer inside = tile_decide_sides(s, line, size);
    if (inside != TILE_BEATS)
        return inside;
    const cgt_triangle_plane a = tile_plane_along(&s->object, line, size);
    if (!cgt_triangle_double_t_safe(&a))
        return TILE_OPEN;
    *hit_t = a.num / a.den;
    const float rounded = (float)*hit_t;
    if (!(rounded >= ray->t_min && rounded <= ray->t_max && rounded < INFINITY))
        return TILE_LOSES;
    if (winner == CGT_INVALID_ID)
        return TILE_BEATS;
    if (!tile_see_winner(objects, line->org, winner, s))
        return TILE_OPEN;
    const cgt_triangle_plane b = tile_plane_along(&s->winner, line, size);
    return cgt_triangle_double_t_safe(&b) ? tile_decide_order(s, &a, &b, counts) : TILE_OPEN;
}

/* ---- runs of one pair ---- */

#define TILE_RUN 4u /* entries of a pair that are worth a vector */

/* The directions of a vector of entries, and their 1-norms. */
typedef struct tile_run_lines {
    vdouble d[3][2], size[2];
} tile_run_lines;

CGT_SPU_INLINE tile_run_lines tile_run_lines_of(const tile *t, const uint16_t *pixel, uint32_t count)
{
    tile_run_lines l;
    vfloat dir[3];
    tile_directions_of(t, pixel, count, dir);
    for (int a = 0; a < 3; a++) {
        l.d[a][0] = spux_double_low(dir[a]);
        l.d[a][1] = spux_double_high(dir[a]);
    }
    for (int h = 0; h < 2; h++)
        l.size[h] = spux_double_abs(l.d[0][h]) + spux_double_abs(l.d[1][h]) + spux_double_abs(l.d[2][h]);
    return l;
}

CGT_SPU_INLINE vdouble tile_run_product(const double v[3], const tile_run_lines *l, int h)
{
    return l->d[0][h] * v[0] + l->d[1][h] * v[1] + l->d[2][h] * v[2];
}

/* Lanes that surely pass beside the object, and that surely pass between its edges. */
CGT_SPU_INLINE void tile_run_sides(const tile_pair_seen *s, const tile_run_lines *l, vmask *beside, vmask *between)
{
    vmask left[3], right[3];
    for (int k = 0; k < 3; k++) {
        vdouble w[2], minus[2], error[2];
        for (int h = 0; h < 2; h++) {
            w[h] = tile_run_product(s->side[k], l, h);
            minus[h] = -w[h];
            error[h] = l->size[h] * s->side_error[k];
        }
        left[k] = spux_double_cmpgt(w, error);
        right[k] = spux_double_cmpgt(minus, error);
    }
    *beside = spu_and(spu_or(left[0], spu_or(left[1], left[2])), spu_or(right[0], spu_or(right[1], right[2])));
    *between = spu_or(spu_and(left[0], spu_and(left[1], left[2])), spu_and(right[0], spu_and(right[1], right[2])));
}

/* A plane along a vector of lines. */
typedef struct tile_run_plane {
    vdouble den[2], den_error[2];
    vmask safe;
} tile_run_plane;

CGT_SPU_INLINE tile_run_plane tile_run_plane_of(const cgt_triangle_plane *p, const tile_run_lines *l)
{
    const bool num_safe = p->num_error <= CGT_DOUBLE_SAFE * fabs(p->num);
    tile_run_plane r;
    vdouble least[2];
    for (int h = 0; h < 2; h++) {
        r.den[h] = tile_run_product(p->n, l, h);
        r.den_error[h] = l->size[h] * p->den_error;
        least[h] = spux_double_abs(r.den[h]) * CGT_DOUBLE_SAFE;
    }
    r.safe = num_safe ? spux_double_cmpgt(least, r.den_error) : spux_mask_none();
    return r;
}

/* Lanes where the object's hit is surely nearer than the winner's, and surely not. */
CGT_SPU_INLINE void tile_run_order(const cgt_triangle_plane *p, const cgt_triangle_plane *q, const tile_run_plane *a,
                                   const tile_run_plane *b, vmask *nearer, vmask *farther)
{
    vdouble apart[2], minus[2], margin[2];
    for (int h = 0; h < 2; h++) {
        const vdouble left = b->den[h] * p->num, right = a->den[h] * q->num;
        const vdouble den_a = spux_double_abs(a->den[h]), den_b = spux_double_abs(b->den[h]);
        const vdouble error = b->den_error[h] * fabs(p->num) + den_b * p->num_error + a->den_error[h] * fabs(q->num) +
                              den_a * q->num_error;
        const vdouble size = spux_double_abs(left) + spux_double_abs(right), less = right - left;
        const vdouble turned = spux_double_select(-less, less, a->den[h]);
        apart[h] = spux_double_select(-turned, turned, b->den[h]); /* above 0 where the object is nearer */
        minus[h] = -apart[h];
        margin[h] = error * (1 + 0x1p-20) + size * 0x1p-51;
    }
    *nearer = spux_double_cmpgt(apart, margin);
    *farther = spux_double_cmpgt(minus, margin);
}

/* What is known of a vector of entries of one pair. */
typedef struct tile_run {
    double t[CGT_LANES];   /* of the object, where it beats the winner */
    unsigned beats, loses; /* lanes as bits */
} tile_run;

/* So many entries, at most a vector, of what s has seen; winner: CGT_INVALID_ID where they have none. */
CGT_SPU_INLINE void tile_judge_run(const tile *t, tile_pair_seen *s, uint32_t winner, const uint16_t *pixel,
                                   uint32_t count, tile_run *r, cgt_counts *counts)
{
    const tile_run_lines l = tile_run_lines_of(t, pixel, count);
    const vfloat t_min = spux_vfloat(t->rays->t_min), t_max = spux_vfloat(t->rays->t_max);
    const cgt_triangle_plane *p = &s->object.plane, *q = &s->winner.plane;
    vmask beside, between, nearer = spux_mask_all(), farther = spux_mask_none();
    vdouble hit[2];
    tile_run_sides(s, &l, &beside, &between);
    const tile_run_plane a = tile_run_plane_of(p, &l);
    for (int h = 0; h < 2; h++) {
        hit[h] = spux_vdouble(p->num) / a.den[h];
        memcpy(r->t + (size_t)h * CGT_DOUBLES, &hit[h], sizeof hit[h]);
    }
    const vfloat rounded = spux_float_of(hit[0], hit[1]);
    const vmask within = spu_and(spu_and(spux_cmpge(rounded, t_min), spux_cmpge(t_max, rounded)),
                                 spu_cmpgt(spux_vfloat(INFINITY), rounded));
    const vmask hits = spu_and(between, a.safe);
    vmask ordered = spu_and(hits, within);
    if (winner != CGT_INVALID_ID) {
        const tile_run_plane b = tile_run_plane_of(q, &l);
        tile_run_order(p, q, &a, &b, &nearer, &farther);
        ordered = spu_and(ordered, b.safe);
        const vmask near = spu_andc(ordered, spu_or(nearer, farther));
        const tile_answer all = spux_any(near) ? tile_decide_planes(s, counts) : TILE_OPEN;
        nearer = all == TILE_BEATS ? spu_or(nearer, near) : nearer;
        farther = all == TILE_LOSES ? spu_or(farther, near) : farther;
    }
    r->beats = spux_mask_bits(spu_and(ordered, nearer));
    r->loses = spux_mask_bits(spu_or(beside, spu_or(spu_andc(hits, within), spu_and(ordered, farther))));
}

#endif
