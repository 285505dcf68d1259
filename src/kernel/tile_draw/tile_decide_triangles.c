/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides the entries of a tile's queue about triangles, seen from one eye. Entries of one triangle follow each other,
 * often against the same closest one: layers close to each other, or faces in one plane. So the terms of both triangles
 * in double are cached from entry to entry, and runs of one pair are decided a vector at a time. The arithmetic is that
 * of triangle_double.h in its order, so a certain result here is what decide.h would find.
 *
 * Which of two hits is nearer: cgt_triangle_double_order. If that does not decide, exact arithmetic finds on which side
 * of one triangle's plane the other one's vertices are. The hit of a ray that passes inside a triangle's edges is a sum
 * of its three vertices with positive factors. So it lies in the plane if all vertices do; otherwise it lies on the
 * side of those that do not, if no vertex is on the other side. The sign of num tells the eye's side. */
#include "exact/integer/exact_terms.h"
#include "exact/triangle_double.h"
#include "spux_double.h"
#include "kernel/tile_draw/tile_queue.h"

/* ---- two triangles, seen from the eye ---- */

/* A triangle's plane. den is not set; den_error is divided by the 1-norm of a direction. */
typedef struct tile_plane_cache {
    uint32_t prim; /* CGT_INVALID_ID: none yet */
    cgt_triangle triangle;
    cgt_triangle_plane plane;
} tile_plane_cache;

/* The order of two triangles, as far as their vertices tell. */
typedef enum tile_plane_order {
    TILE_PLANES_UNKNOWN,
    TILE_PLANES_CROSS, /* they do not tell */
    TILE_PLANES_SAME,
    TILE_PLANES_NEARER, /* the entry's primitive is nearer than the closest one */
    TILE_PLANES_FARTHER
} tile_plane_order;

/* The terms of the last pair. */
typedef struct tile_pair_cache {
    tile_plane_cache prim, closest;
    double side[3][3], side_error[3]; /* edges of the entry's primitive: factors of d; errors over its 1-norm */
    tile_plane_order planes;
} tile_pair_cache;

/* Returns false for what is not a triangle. */
CGT_SPU_INLINE bool tile_cache_plane(const cgt_primitives *prims, const float eye[3], uint32_t prim,
                                     tile_plane_cache *s)
{
    static const float one[3] = {1, 0, 0}; /* of norm 1 */
    const cgt_primitive primitive = cgt_primitives_get(prims, prim);
    s->prim = CGT_INVALID_ID;
    if (primitive.kind != CGT_KIND_TRIANGLES)
        return false;
    s->prim = prim;
    s->triangle = primitive.triangle;
    s->plane = cgt_triangle_double_plane(eye, one, &s->triangle);
    return true;
}

CGT_SPU_INLINE bool tile_cache_prim(const cgt_primitives *prims, const float eye[3], uint32_t prim, tile_pair_cache *s)
{
    if (s->prim.prim == prim)
        return true;
    s->planes = TILE_PLANES_UNKNOWN;
    if (!tile_cache_plane(prims, eye, prim, &s->prim))
        return false;
    for (int k = 0; k < 3; k++)
        s->side_error[k] = cgt_triangle_double_edge(eye, &s->prim.triangle, (k + 1) % 3, (k + 2) % 3, s->side[k]);
    return true;
}

CGT_SPU_INLINE bool tile_cache_closest(const cgt_primitives *prims, const float eye[3], uint32_t closest,
                                       tile_pair_cache *s)
{
    if (s->closest.prim == closest)
        return true;
    s->planes = TILE_PLANES_UNKNOWN;
    return tile_cache_plane(prims, eye, closest, &s->closest);
}

CGT_SPU_INLINE double tile_dot(const double v[3], const cgt_exact_ray *line)
{
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): a cached number comes with its terms */
    return (double)line->dir[0] * v[0] + (double)line->dir[1] * v[1] + (double)line->dir[2] * v[2];
}

CGT_SPU_INLINE cgt_triangle_plane tile_plane_for_line(const tile_plane_cache *s, const cgt_exact_ray *line, double size)
{
    cgt_triangle_plane p = s->plane;
    p.den = tile_dot(p.n, line);
    p.den_error *= size;
    return p;
}

/* Counts the vertices v of b on each side of the plane of a: those with n.(v_0 - v) above 0 and those below. Exact. */
CGT_SPU_INLINE void tile_count_plane_sides(const cgt_triangle *a, const cgt_triangle *b, int *above, int *below)
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

/* Which triangle is nearer on all rays that pass inside the edges of `prim` and hit `closest`. */
__attribute__((noinline, unused)) static tile_plane_order
tile_compare_planes(const tile_plane_cache *prim, const tile_plane_cache *closest, cgt_counts *counts)
{
    int above, below;
    if (cgt_triangles_share_plane(&prim->triangle, &closest->triangle) ||
        cgt_triangles_share_lattice_plane(&prim->triangle, &closest->triangle))
        return TILE_PLANES_SAME;
    counts->exact_tests++;
    tile_count_plane_sides(&closest->triangle, &prim->triangle, &above, &below);
    if (!above && !below)
        return TILE_PLANES_SAME;
    if (!above || !below)
        return (above != 0) == (closest->plane.num > 0) ? TILE_PLANES_NEARER : TILE_PLANES_FARTHER;
    tile_count_plane_sides(&prim->triangle, &closest->triangle, &above,
                           &below); /* the hit of `closest` may be on an edge */
    if (above == 3 || below == 3)
        return (above != 0) == (prim->plane.num > 0) ? TILE_PLANES_FARTHER : TILE_PLANES_NEARER;
    return TILE_PLANES_CROSS;
}

/* What is decided about an entry. */
typedef enum tile_decision { TILE_UNDECIDED, TILE_REJECTED, TILE_ACCEPTED } tile_decision;

/* Whether the line passes inside the primitive's edges: TILE_ACCEPTED if it does. */
CGT_SPU_INLINE tile_decision tile_decide_sides(const tile_pair_cache *s, const cgt_exact_ray *line, double size)
{
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; k++) {
        const double w = tile_dot(s->side[k], line), error = s->side_error[k] * size;
        positive += w > error;
        negative += w < -error;
    }
    return positive && negative ? TILE_REJECTED : positive == 3 || negative == 3 ? TILE_ACCEPTED : TILE_UNDECIDED;
}

/* Which one is nearer if both are hit, by their vertices. */
CGT_SPU_INLINE tile_decision tile_decide_planes(tile_pair_cache *s, cgt_counts *counts)
{
    if (s->planes == TILE_PLANES_UNKNOWN) {
        s->planes = tile_compare_planes(&s->prim, &s->closest, counts);
    }
    switch (s->planes) {
    case TILE_PLANES_SAME: return s->prim.prim < s->closest.prim ? TILE_ACCEPTED : TILE_REJECTED;
    case TILE_PLANES_NEARER: return TILE_ACCEPTED;
    case TILE_PLANES_FARTHER: return TILE_REJECTED;
    default: return TILE_UNDECIDED;
    }
}

/* Whether the hit of a, the entry's primitive, is nearer than that of b, the closest one. */
CGT_SPU_INLINE tile_decision tile_decide_order(tile_pair_cache *s, const cgt_triangle_plane *a,
                                               const cgt_triangle_plane *b, cgt_counts *counts)
{
    const int order = cgt_triangle_double_order(a, b);
    if (order)
        return order < 0 ? TILE_ACCEPTED : TILE_REJECTED;
    return tile_decide_planes(s, counts);
}

/* As filter_is_closer, for two triangles, or one if there is no closest one. */
CGT_SPU_INLINE tile_decision tile_decide_pair(const cgt_primitives *prims, const cgt_ray *ray, uint32_t closest,
                                              uint32_t prim, tile_pair_cache *s, double *hit_t, cgt_counts *counts)
{
    const cgt_exact_ray *line = &ray->line;
    const double size = fabs((double)line->dir[0]) + fabs((double)line->dir[1]) + fabs((double)line->dir[2]);
    if (!tile_cache_prim(prims, line->org, prim, s))
        return TILE_UNDECIDED;
    const tile_decision inside = tile_decide_sides(s, line, size);
    if (inside != TILE_ACCEPTED)
        return inside;
    const cgt_triangle_plane a = tile_plane_for_line(&s->prim, line, size);
    if (!cgt_triangle_double_t_safe(&a))
        return TILE_UNDECIDED;
    *hit_t = a.num / a.den;
    const float rounded = (float)*hit_t;
    if (!(rounded >= ray->t_min && rounded <= ray->t_max && rounded < INFINITY))
        return TILE_REJECTED;
    if (closest == CGT_INVALID_ID)
        return TILE_ACCEPTED;
    if (!tile_cache_closest(prims, line->org, closest, s))
        return TILE_UNDECIDED;
    const cgt_triangle_plane b = tile_plane_for_line(&s->closest, line, size);
    return cgt_triangle_double_t_safe(&b) ? tile_decide_order(s, &a, &b, counts) : TILE_UNDECIDED;
}

/* ---- runs of one pair ---- */

#define TILE_MIN_RUN 4u /* shorter runs are decided entry by entry */

/* The directions of a vector of entries, and their 1-norms. */
typedef struct tile_run_lines {
    vdouble d[3][2], size[2];
} tile_run_lines;

CGT_SPU_INLINE tile_run_lines tile_gather_run_lines(const tile *t, const uint16_t *pixel, uint32_t count)
{
    tile_run_lines l;
    vfloat dir[3];
    tile_gather_directions(t, pixel, count, dir);
    for (int a = 0; a < 3; a++) {
        l.d[a][0] = spux_double_low(dir[a]);
        l.d[a][1] = spux_double_high(dir[a]);
    }
    for (int h = 0; h < 2; h++)
        l.size[h] = spux_double_abs(l.d[0][h]) + spux_double_abs(l.d[1][h]) + spux_double_abs(l.d[2][h]);
    return l;
}

CGT_SPU_INLINE vdouble tile_run_dot(const double v[3], const tile_run_lines *l, int h)
{
    return l->d[0][h] * v[0] + l->d[1][h] * v[1] + l->d[2][h] * v[2];
}

/* Lanes that certainly pass outside the primitive's edges, and that certainly pass inside. */
CGT_SPU_INLINE void tile_test_run_sides(const tile_pair_cache *s, const tile_run_lines *l, vmask *outside,
                                        vmask *inside)
{
    vmask positive[3], negative[3];
    for (int k = 0; k < 3; k++) {
        vdouble w[2], minus[2], error[2];
        for (int h = 0; h < 2; h++) {
            w[h] = tile_run_dot(s->side[k], l, h);
            minus[h] = -w[h];
            error[h] = l->size[h] * s->side_error[k];
        }
        positive[k] = spux_double_cmpgt(w, error);
        negative[k] = spux_double_cmpgt(minus, error);
    }
    *outside = spu_and(spu_or(positive[0], spu_or(positive[1], positive[2])),
                       spu_or(negative[0], spu_or(negative[1], negative[2])));
    *inside = spu_or(spu_and(positive[0], spu_and(positive[1], positive[2])),
                     spu_and(negative[0], spu_and(negative[1], negative[2])));
}

/* A plane along a vector of lines. */
typedef struct tile_run_plane {
    vdouble den[2], den_error[2];
    vmask safe;
} tile_run_plane;

CGT_SPU_INLINE tile_run_plane tile_compute_run_plane(const cgt_triangle_plane *p, const tile_run_lines *l)
{
    /* NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): a cached number comes with its terms */
    const bool num_safe = p->num_error <= CGT_DOUBLE_SAFE * fabs(p->num);
    tile_run_plane r;
    vdouble min_den[2];
    for (int h = 0; h < 2; h++) {
        r.den[h] = tile_run_dot(p->n, l, h);
        r.den_error[h] = l->size[h] * p->den_error;
        min_den[h] = spux_double_abs(r.den[h]) * CGT_DOUBLE_SAFE;
    }
    r.safe = num_safe ? spux_double_cmpgt(min_den, r.den_error) : spux_mask_none();
    return r;
}

/* Lanes where the hit of a is certainly nearer than that of b, and where it is certainly farther. */
CGT_SPU_INLINE void tile_compare_run_depths(const cgt_triangle_plane *p, const cgt_triangle_plane *q,
                                            const tile_run_plane *a, const tile_run_plane *b, vmask *nearer,
                                            vmask *farther)
{
    vdouble difference[2], minus[2], margin[2];
    for (int h = 0; h < 2; h++) {
        const vdouble lhs = b->den[h] * p->num, rhs = a->den[h] * q->num;
        const vdouble den_a = spux_double_abs(a->den[h]), den_b = spux_double_abs(b->den[h]);
        const vdouble error = b->den_error[h] * fabs(p->num) + den_b * p->num_error + a->den_error[h] * fabs(q->num) +
                              den_a * q->num_error;
        const vdouble size = spux_double_abs(lhs) + spux_double_abs(rhs), rhs_minus_lhs = rhs - lhs;
        const vdouble signed_difference = spux_double_select(-rhs_minus_lhs, rhs_minus_lhs, a->den[h]);
        difference[h] =
            spux_double_select(-signed_difference, signed_difference, b->den[h]); /* above 0 where a is nearer */
        minus[h] = -difference[h];
        margin[h] = error * (1 + 0x1p-20) + size * 0x1p-51;
    }
    *nearer = spux_double_cmpgt(difference, margin);
    *farther = spux_double_cmpgt(minus, margin);
}

/* The decisions about a vector of entries of one pair. */
typedef struct tile_run_result {
    double t[CGT_LANES];         /* of the primitive, where it is accepted */
    unsigned accepted, rejected; /* lanes as bits */
} tile_run_result;

/* Decides `count` entries, at most a vector, of the pair in s. closest: CGT_INVALID_ID if the pixels have none. */
CGT_SPU_INLINE void tile_decide_run(const tile *t, tile_pair_cache *s, uint32_t closest, const uint16_t *pixel,
                                    uint32_t count, tile_run_result *r, cgt_counts *counts)
{
    const tile_run_lines l = tile_gather_run_lines(t, pixel, count);
    const vfloat t_min = spux_vfloat(t->rays->t_min), t_max = spux_vfloat(t->rays->t_max);
    const cgt_triangle_plane *p = &s->prim.plane, *q = &s->closest.plane;
    vmask outside, inside, nearer = spux_mask_all(), farther = spux_mask_none();
    vdouble hit[2];
    /* is the primitive hit, and within the range? */
    tile_test_run_sides(s, &l, &outside, &inside);
    const tile_run_plane a = tile_compute_run_plane(p, &l);
    for (int h = 0; h < 2; h++) {
        hit[h] = spux_vdouble(p->num) / a.den[h];
        memcpy(r->t + (size_t)h * CGT_DOUBLES, &hit[h], sizeof hit[h]);
    }
    const vfloat rounded = spux_float_of(hit[0], hit[1]);
    const vmask within = spu_and(spu_and(spux_cmpge(rounded, t_min), spux_cmpge(t_max, rounded)),
                                 spu_cmpgt(spux_vfloat(INFINITY), rounded));
    const vmask hits = spu_and(inside, a.safe);
    vmask comparable = spu_and(hits, within);
    /* is it nearer? */
    if (closest != CGT_INVALID_ID) {
        const tile_run_plane b = tile_compute_run_plane(q, &l);
        tile_compare_run_depths(p, q, &a, &b, &nearer, &farther);
        comparable = spu_and(comparable, b.safe);
        const vmask undecided = spu_andc(comparable, spu_or(nearer, farther));
        const tile_decision shared_decision = spux_any(undecided) ? tile_decide_planes(s, counts) : TILE_UNDECIDED;
        nearer = shared_decision == TILE_ACCEPTED ? spu_or(nearer, undecided) : nearer;
        farther = shared_decision == TILE_REJECTED ? spu_or(farther, undecided) : farther;
    }
    r->accepted = spux_mask_bits(spu_and(comparable, nearer));
    r->rejected = spux_mask_bits(spu_or(outside, spu_or(spu_andc(hits, within), spu_and(comparable, farther))));
}

/* ---- the queue ---- */

/* Decides one entry with the cached terms. */
CGT_SPU_INLINE void tile_flush_entry(const cgt_primitives *prims, tile *t, const tile_queue *q, uint32_t k,
                                     tile_pair_cache *s, cgt_counts *counts)
{
    const uint32_t i = q->pixel[k], prim = q->prim[k], closest = t->prim[i];
    double hit_t = 0;
    if (closest == prim || t->z[i] == -INFINITY)
        return;
    const cgt_ray ray = tile_pixel_ray(t, i);
    const tile_decision decision = tile_decide_pair(prims, &ray, closest, prim, s, &hit_t, counts);
    if (decision == TILE_UNDECIDED) {
        CGT_KERNEL(cgt_tile_decide)(prims, t, i, prim, counts);
        return;
    }
    counts->double_tests++;
    if (decision == TILE_ACCEPTED) {
        tile_set_closest(t, i, prim);
        t->z[i] = tile_compute_depth(t, i, hit_t);
    }
}

/* The number of entries from k on, at most a vector, with the same primitive and the same closest one. */
CGT_SPU_INLINE uint32_t tile_run_length(const tile *t, const tile_queue *q, uint32_t k)
{
    const uint32_t prim = q->prim[k], closest = t->prim[q->pixel[k]];
    const uint32_t limit = q->entries - k < CGT_LANES ? q->entries - k : CGT_LANES;
    uint32_t length = 1;
    while (length < limit && q->prim[k + length] == prim && t->prim[q->pixel[k + length]] == closest)
        length++;
    return length;
}

/* Decides such a run. */
CGT_SPU_INLINE void tile_flush_run(const cgt_primitives *prims, tile *t, const tile_queue *q, uint32_t first,
                                   uint32_t count, tile_pair_cache *s, cgt_counts *counts)
{
    const uint32_t prim = q->prim[first], closest = t->prim[q->pixel[first]];
    const float *eye = t->rays->eye;
    tile_run_result r = {.accepted = 0};
    if (closest == prim)
        return;
    if (tile_cache_prim(prims, eye, prim, s) &&
        (closest == CGT_INVALID_ID || tile_cache_closest(prims, eye, closest, s)))
        tile_decide_run(t, s, closest, q->pixel + first, count, &r, counts);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = q->pixel[first + k];
        if (!((r.accepted | r.rejected) >> k & 1) || t->z[i] == -INFINITY) {
            tile_flush_entry(prims, t, q, first + k, s, counts);
            continue;
        }
        counts->double_tests++;
        if (r.accepted >> k & 1) {
            tile_set_closest(t, i, prim);
            t->z[i] = tile_compute_depth(t, i, r.t[k]);
        }
    }
}

void CGT_KERNEL(cgt_tile_flush_triangles)(const cgt_primitives *prims, tile *t, const tile_queue *q, cgt_counts *counts)
{
    tile_pair_cache s; /* large: not all of it is set */
    s.prim.prim = s.closest.prim = CGT_INVALID_ID;
    s.planes = TILE_PLANES_UNKNOWN;
    for (uint32_t k = 0, run; k < q->entries; k += run) {
        run = tile_run_length(t, q, k);
        if (run >= TILE_MIN_RUN)
            tile_flush_run(prims, t, q, k, run, &s, counts);
        else
            for (uint32_t i = k; i < k + run; i++)
                tile_flush_entry(prims, t, q, i, &s, counts);
    }
}
