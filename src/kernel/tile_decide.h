/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue of what single precision leaves open in a tile: pairs of a pixel and an object that may be its nearest. They
 * are decided later, together. That is right, since a pixel's best hit is replaced only by one that is certainly nearer:
 * the nearest is the best of the end, or in the queue.
 *
 * Where rays have one origin, spheres of one array go a vector at a time (tile_decide_spheres.h). Entries of one triangle
 * follow each other, often against one winner: layers near to each other, or faces in one plane. So what double takes of
 * the two triangles is kept from entry to entry then. It is the arithmetic of triangle_double.h in its order, so what it
 * is certain of is what decide.h would say.
 *
 * Which of two hits is nearer: t_a < t_b where num_a den_b - num_b den_a has the sign opposite to that of den_a den_b.
 * The products are off by what their factors are, and what is rounded by 2^-51 of their magnitudes. Where that leaves it
 * open, it is asked exactly on which side of one triangle's plane the other one's vertices are. Of a ray that passes
 * between a triangle's edges the hit is a sum of all three vertices with factors above 0: in the plane where they all are,
 * and else beyond it or before it where none of them is on the other side. Num is the eye's side. */
#ifndef CGT_TILE_DECIDE_H
#define CGT_TILE_DECIDE_H

#include "../exact_terms.h"
#include "../triangle_double.h"
#include "tile_decide_spheres.h"

/* ---- two triangles, seen from the eye ---- */

/* A triangle's plane; den_error is over the 1-norm of a direction, den of none. */
typedef struct tile_seen_plane {
    uint32_t object; /* CGT_NONE: none yet */
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
    s->object = CGT_NONE;
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
    if (winner == CGT_NONE)
        return TILE_BEATS;
    if (!tile_see_winner(objects, line->org, winner, s))
        return TILE_OPEN;
    const cgt_triangle_plane b = tile_plane_along(&s->winner, line, size);
    return cgt_triangle_double_t_safe(&b) ? tile_decide_order(s, &a, &b, counts) : TILE_OPEN;
}

/* ---- deciding ---- */

/* The bits of a shape that is as good as the winner make it a hit; the lower object wins. */
CGT_SPU_INLINE bool tile_same_shape(const cgt_objects *objects, uint32_t a, uint32_t b)
{
    const cgt_shape p = cgt_objects_shape(objects, a), q = cgt_objects_shape(objects, b);
    if (p.kind != q.kind)
        return false;
    return p.kind == CGT_KIND_SPHERES ? !memcmp(&p.sphere, &q.sphere, sizeof p.sphere)
                                      : !memcmp(&p.triangle, &q.triangle, sizeof p.triangle);
}

/* Of any two objects. */
CGT_SPU_INLINE void tile_decide(const cgt_objects *objects, tile *t, uint32_t i, uint32_t object, cgt_counts *counts)
{
    const uint32_t winner = t->object[i];
    double hit_t;
    if (winner == object || t->z[i] == -INFINITY)
        return;
    if (winner != CGT_NONE && tile_same_shape(objects, object, winner)) {
        tile_win(t, i, object < winner ? object : winner);
        return;
    }
    const cgt_ray ray = tile_ray(t, i);
    if (!filter_beats(objects, &ray, winner, object, &hit_t, counts))
        return;
    tile_win(t, i, object);
    t->z[i] = tile_depth(t, i, hit_t);
}

/* Where rays have one origin, and there are triangles. */
__attribute__((noinline, unused)) static void tile_flush_pairs(const cgt_objects *objects, tile *t, const tile_queue *q,
                                                               cgt_counts *counts)
{
    tile_pair_seen s; /* large: not all of it is set */
    s.object.object = s.winner.object = CGT_NONE;
    s.planes = TILE_PLANES_UNKNOWN;
    for (uint32_t k = 0; k < q->entries; k++) {
        const uint32_t i = q->pixel[k], object = q->object[k], winner = t->object[i];
        double hit_t = 0;
        if (winner == object || t->z[i] == -INFINITY)
            continue;
        const cgt_ray ray = tile_ray(t, i);
        const tile_answer answer = tile_decide_pair(objects, &ray, winner, object, &s, &hit_t, counts);
        if (answer == TILE_OPEN) {
            tile_decide(objects, t, i, object, counts);
            continue;
        }
        counts->double_tests++;
        if (answer == TILE_BEATS) {
            tile_win(t, i, object);
            t->z[i] = tile_depth(t, i, hit_t);
        }
    }
}

/* Where rays have one origin, and there are spheres of one array. */
__attribute__((noinline, unused)) static void tile_flush_spheres(const cgt_objects *objects, tile *t,
                                                                 const tile_queue *q, cgt_counts *counts)
{
    tile_verdicts v;
    for (uint32_t first = 0; first < q->entries; first += CGT_LANES) {
        tile_judge_spheres(objects->array, t, q, first, &v);
        for (uint32_t k = 0; k < CGT_LANES && first + k < q->entries; k++) {
            const uint32_t i = q->pixel[first + k], object = q->object[first + k];
            if (!((v.beats | v.loses) >> k & 1) || t->object[i] != v.winner[k] || t->z[i] == -INFINITY) {
                tile_decide(objects, t, i, object, counts); /* another entry of the vector may have won the pixel */
                continue;
            }
            counts->double_tests++;
            if (v.beats >> k & 1) {
                tile_win(t, i, object);
                t->z[i] = tile_depth(t, i, v.t[k]);
            }
        }
    }
}

__attribute__((noinline, unused)) static void tile_flush(const cgt_objects *objects, tile *t, tile_queue *q,
                                                         cgt_counts *counts)
{
    if (objects->triangles && !t->parallel)
        tile_flush_pairs(objects, t, q, counts);
    else if (objects->arrays == 1 && !t->parallel)
        tile_flush_spheres(objects, t, q, counts);
    else
        for (uint32_t k = 0; k < q->entries; k++)
            tile_decide(objects, t, q->pixel[k], q->object[k], counts);
    q->entries = 0;
}

CGT_SPU_INLINE void tile_queue_push(const cgt_objects *objects, tile *t, tile_queue *q, uint32_t pixel, uint32_t object,
                                    cgt_counts *counts)
{
    if (q->entries == TILE_QUEUE)
        tile_flush(objects, t, q, counts);
    q->pixel[q->entries] = (uint16_t)pixel;
    q->object[q->entries++] = object;
}

#endif
