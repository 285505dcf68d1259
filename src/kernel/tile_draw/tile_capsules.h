/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules against a tile. A vector of capsules at a time is culled by windows; each visible one is then tested over
 * the pixels of its window by lane_capsules.h, with a ray in each lane; thin ones together (tile_capsule_pairs.h). The
 * bounds there hold for any ray and capsule, also around and behind the eye. So double precision is left to the queue.
 *
 * The window: a capsule is the convex hull of the spheres around its ends. Where both are in front of the eye, it is
 * seen in the hull of what is seen of them, whose columns and rows are those from the first of both windows to the
 * last. The spheres are widened as those of tile_spheres.h: what that covers at a point between the ends is at most the
 * larger of both. Others have the whole tile for a window, unless the sphere around them is outside the cone of all
 * rays.
 *
 * The least distance from the eye: let D be that of the nearer end, n the axis, f the distance of the axis' nearest
 * point, if that lies between the ends. The nearer end is at most |n| / 2 from it, and D^2 - f^2 at most |n|^2 / 4. So
 *   D - f <= |n|^2 / (4 (D + f)) <= |n|^2 / (4 D),   and D - f <= |n| / 2
 * Its rounding is below 2^-20 (D + |n|), which is part of what the radius is widened by.
 *
 * The strip: a window holds far more pixels than a thin capsule that crosses it. In camera space, let p and q be the
 * computed ends, a = (1 - s) p + s q, and m the normal of the plane through the eye and both, of unit vectors towards
 * them, so that m.a = 0. A ray d = (1, x, y) that meets the capsule next to a passes t d with
 *   |t d - a| <= w(s),  t >= z(s) - w(s),   so   |m.d| <= |m| w(s) / (z(s) - w(s))
 * where w covers the radius, metric, the rounding of the ends and of the canonical direction: of tile_spheres.h 8 u and
 * 3.5 u of the distance of a, and 12 u r, below what a radius is widened by there. As z, that is linear in s, so the
 * quotient is monotonous: at most the larger of its values at the ends. Each end has its own width and its own z: with
 * the width of the far end of a long capsule and the z of the near one the divisor may be 0 or below. Both ends are in
 * front, so z > 1.5 w. Unit vectors are off by 1 u, 2 u together, m by 3 u more, its length by that times the quotient,
 * which is at most 2; coefficients and sums by 7 u |d|: 22 u |d| together, of which 64 u are taken.
 *
 * Rays that are parallel stay within r |m| of the line through both ends, for n = (q - p) / V across the rays with
 * m = (n_y p_x - n_x p_y, -n_y, n_x). With V the largest distance from the eye of an end, plus that of an origin, this
 * is off by 45 u V, of which 64 u V are taken. Neither suffers from underflow.
 *
 * Around the eye: where a capsule holds the eye, every ray leaves it, at the surface's least distance or farther, and
 * its near root is before the range, since a camera's begins at 0 or later. The far root is where the reversed ray,
 * from the same origin, enters: the test of lane_capsules.h tells it, with signs exchanged. The distance to the surface
 * is r minus that to any point of the axis; the point next to the eye is found within rounding, and lengths are off by
 * less than 2^-18 of the numbers that they come from.
 *
 * The depth: with N of the pixel (tile.h), off by 4 u in single precision, q is in [low N, high N], widened by 2^-20 of
 * either. A certain hit counts as such if that interval fits into the tile's depth error. */
#ifndef CGT_TILE_CAPSULES_H
#define CGT_TILE_CAPSULES_H

#include "kernel/primitive/lane_capsules.h"
#include "kernel/tile_draw/tile_parallel_spheres.h"
#include "kernel/tile_draw/tile_queue.h"

/* Both intervals of t of lane_capsules.h as depths, for capsules up to distance c: 2 t_error of 36 u times at most
 * 4 c, |d| times as long as depths, and as much for the chord's width. */
CGT_SPU_INLINE void tile_widen_capsule_error(tile *t, float c)
{
    const float depth_error = c * t->max_dir_length * (512 * FILTER_ROUNDOFF);
    t->depth_error = t->depth_error > depth_error ? t->depth_error : depth_error;
    t->padded_depth_error = t->depth_error * (1 + 0x1p-20f);
}

/* A vector of capsules. */
typedef struct tile_capsules {
    tile_windows window;
    _Alignas(64) float d[7][CGT_LANES]; /* the numbers of cgt_capsule */
    _Alignas(64) float min_distance[CGT_LANES];
    _Alignas(64) float strip[3][CGT_LANES], strip_width[CGT_LANES]; /* 1, px and py times these; no more in the strip */
    float rlength;                                                  /* at least 1 / |d| of any ray of the tile */
    unsigned visible;                                               /* lanes, as bits */
    unsigned enclosing;                                             /* those that hold the eye */
} tile_capsules;

/* The columns (or rows) of both silhouettes. */
CGT_SPU_INLINE vmask tile_compute_hull(const tile_span *span, int axis, const tile_projected_spheres v[2],
                                       uint32_t *from, uint32_t *to)
{
    vfloat low[2], high[2];
    for (int k = 0; k < 2; k++) {
        const vfloat r2 = spu_mul(v[k].padded_radius, v[k].padded_radius);
        const vfloat unit = spux_div(spux_vfloat(span->scale), spu_sub(v[k].z2, r2));
        vfloat a, b;
        tile_compute_tangents(span, axis ? v[k].y : v[k].x, v[k].z, v[k].padded_radius, r2, unit, &a, &b);
        low[k] = spux_min(a, b);
        high[k] = spux_max(a, b);
    }
    return tile_compute_window(spux_min(low[0], low[1]), spux_max(high[0], high[1]), span, from, to);
}

/* Those of parallel rays. */
CGT_SPU_INLINE vmask tile_compute_parallel_hull(const tile *t, const tile_projected_spheres v[2], tile_windows *w)
{
    const vfloat half = spux_vfloat(0.5f), pad = spux_max(v[0].padded_radius, v[1].padded_radius);
    const vfloat x = spu_mul(spu_add(v[0].x, v[1].x), half), y = spu_mul(spu_add(v[0].y, v[1].y), half);
    return tile_compute_parallel_windows(t, x, y, spu_madd(spux_abs(spu_sub(v[0].x, v[1].x)), half, pad),
                                         spu_madd(spux_abs(spu_sub(v[0].y, v[1].y)), half, pad), w);
}

/* |n| */
CGT_SPU_INLINE vfloat tile_capsule_length(const vfloat d[7])
{
    const vfloat n[3] = {spu_sub(d[3], d[0]), spu_sub(d[4], d[1]), spu_sub(d[5], d[2])};
    return spux_sqrt(lane_dot(n, n));
}

CGT_SPU_INLINE vfloat tile_capsule_min_distance(const tile_projected_spheres v[2], vfloat length)
{
    const vfloat nearer = spux_min(v[0].distance, v[1].distance);
    const vfloat half = spu_mul(length, spux_vfloat(0.5f));
    const vfloat sag = spux_min(spux_div(spu_mul(half, half), nearer), half); /* a NaN: the eye at an end; half */
    const vfloat pad = spux_max(v[0].padded_radius, v[1].padded_radius);
    return spu_sub(spu_sub(nearer, sag), spu_madd(spu_add(length, nearer), spux_vfloat(TILE_LENGTH_ERROR / 2), pad));
}

CGT_SPU_INLINE void tile_store_strips(const tile *t, const tile_projected_spheres v[2], vmask in_front,
                                      tile_capsules *s)
{
    const vfloat one = spux_vfloat(1), zero = spux_vfloat(0);
    vfloat m[3], lead, most = spux_vfloat(t->max_dir_length), square = zero;
    if (t->parallel) {
        lead = spux_max(v[0].padded_radius, v[1].padded_radius);
        most = spu_add(spux_max(v[0].distance, v[1].distance), spux_vfloat(t->origin_offset));
        const vfloat scale = spux_div(one, most);
        m[1] = spu_mul(spu_sub(v[0].y, v[1].y), scale);
        m[2] = spu_mul(spu_sub(v[1].x, v[0].x), scale);
        m[0] = spu_sub(zero, spu_madd(m[1], v[0].x, spu_mul(m[2], v[0].y)));
    } else {
        vfloat end[2][3], quotient[2];
        for (int k = 0; k < 2; k++) {
            const vfloat scale = spux_div(one, v[k].distance), x[3] = {v[k].z, v[k].x, v[k].y};
            for (int a = 0; a < 3; a++)
                end[k][a] = spu_mul(x[a], scale);
            quotient[k] = spux_div(v[k].padded_radius, spu_sub(v[k].z, v[k].padded_radius));
        }
        lane_cross(end[0], end[1], m);
        square = spu_mul(m[0], m[0]);
        lead = spux_max(quotient[0], quotient[1]);
    }
    const vfloat length = spux_sqrt(spu_madd(m[1], m[1], spu_madd(m[2], m[2], square)));
    const vfloat width = spu_madd(length, lead, spu_mul(most, spux_vfloat(TILE_LENGTH_ERROR)));
    spux_store(s->strip[0], m[0]);
    spux_store(s->strip[1], spu_mul(m[1], spux_vfloat(t->camera.right)));
    spux_store(s->strip[2], spu_mul(m[2], spux_vfloat(t->camera.up)));
    spux_store(s->strip_width, spux_select(spux_vfloat(INFINITY), width, in_front));
}

/* From the eye to a point of the axis, about the nearest one. */
CGT_SPU_INLINE vfloat tile_axis_distance(const tile *t, const vfloat d[7])
{
    vfloat c[3], n[3];
    for (int a = 0; a < 3; a++) {
        c[a] = spu_sub(spux_vfloat(t->rays->eye[a]), d[a]);
        n[a] = spu_sub(d[3 + a], d[a]);
    }
    const vfloat s = lane_clamp_share(spux_div(lane_dot(c, n), lane_dot(n, n)));
    for (int a = 0; a < 3; a++)
        c[a] = spu_nmsub(s, n[a], c[a]);
    return spux_sqrt(lane_dot(c, c));
}

/* About how far capsules are from the eye, from outside or inside. It decides nothing but an order. */
CGT_SPU_INLINE vfloat tile_order_capsules(const tile *t, const vfloat d[7])
{
    vfloat end[2][4];
    if (!t->parallel)
        return spux_abs(spu_sub(tile_axis_distance(t, d), d[6]));
    for (int k = 0; k < 2; k++) {
        const vfloat sphere[4] = {d[3 * k], d[3 * k + 1], d[3 * k + 2], d[6]};
        tile_transform_spheres(t, sphere, end[k]);
    }
    return spu_sub(spux_min(end[0][0], end[1][0]), d[6]);
}

/* Which of these lanes, as bits, hold the eye: their least distance is that to the surface. */
__attribute__((noinline)) static unsigned tile_find_enclosing(const tile *t, const vfloat d[7],
                                                              const tile_projected_spheres v[2], unsigned lanes,
                                                              tile_capsules *s)
{
    if (t->parallel)
        return 0;
    const vfloat error = spu_madd(spu_add(spu_add(v[0].distance, v[1].distance), d[6]), spux_vfloat(TILE_LENGTH_ERROR),
                                  spux_vfloat(t->length_error));
    const vfloat depth = spu_sub(spu_sub(d[6], tile_axis_distance(t, d)), error);
    lanes &= spux_mask_bits(spu_cmpgt(depth, spux_vfloat(0)));
    spux_store(s->min_distance, spux_select(spux_load(s->min_distance), depth, spux_mask_from_bits(lanes)));
    return lanes;
}

/* Windows, strips and least distances of the first `count` lanes, and which of them are visible. */
CGT_SPU_INLINE void tile_cull_capsules(const tile *t, const uint32_t *reference, uint32_t count,
                                       const cgt_primitives *prims, tile_capsules *s)
{
    tile_projected_spheres v[2];
    vfloat d[7], q[4];
    vmask outside, large_windows, in_front = spux_mask_all();
    gather_scene_capsules(prims, reference, count, d);
    for (int k = 0; k < 7; k++)
        spux_store(s->d[k], d[k]);
    for (int k = 0; k < 2; k++) {
        const vfloat end[4] = {d[3 * k], d[3 * k + 1], d[3 * k + 2], d[6]};
        tile_transform_spheres(t, end, q);
        v[k] = tile_project_spheres(t, q);
    }
    const vfloat length = tile_capsule_length(d);
    vfloat min_distance;
    if (t->parallel) {
        min_distance = spu_sub(spux_min(v[0].z, v[1].z), spux_max(v[0].padded_radius, v[1].padded_radius));
        outside = tile_compute_parallel_hull(t, v, &s->window);
    } else {
        min_distance = tile_capsule_min_distance(v, length);
        in_front = spu_and(v[0].in_front, v[1].in_front);
        outside = tile_compute_hull(&t->column_span, 0, v, s->window.x0, s->window.x1);
        outside = spu_and(in_front, spu_or(outside, tile_compute_hull(&t->row_span, 1, v, s->window.y0, s->window.y1)));
    }
    s->rlength = 1 / sqrtf(t->min_norm) * (1 + 0x1p-17f);
    spux_store(s->min_distance, min_distance);
    tile_store_strips(t, v, in_front, s);
    const vfloat far_distance = tile_window_far_distance(t, &s->window, &large_windows);
    const vmask occluded = spu_or(spu_cmpgt(min_distance, spux_vfloat(t->max_far_distance)),
                                  spu_andc(spu_and(in_front, spu_cmpgt(min_distance, far_distance)), large_windows));
    s->visible = first_lanes(count) & ~spux_mask_bits(spu_or(outside, occluded));
    const unsigned around = s->visible & ~spux_mask_bits(in_front);
    s->enclosing = 0;
    if (!around)
        return;
    s->enclosing = tile_find_enclosing(t, d, v, around, s);
    const vfloat half = spux_vfloat(0.5f), z = spu_mul(spu_add(v[0].z, v[1].z), half),
                 x = spu_mul(spu_add(v[0].x, v[1].x), half), y = spu_mul(spu_add(v[0].y, v[1].y), half);
    const vmask beside = tile_cull_by_cone(
        t, z, x, y, spux_max(v[0].distance, v[1].distance),
        spu_madd(length, spux_vfloat(0.5f * (1 + 0x1p-20f)), spux_max(v[0].padded_radius, v[1].padded_radius)));
    s->visible &= ~(around & spux_mask_bits(beside));
    tile_set_full_windows(t, around, &s->window);
}

/* ---- pixels ---- */

/* One capsule in all lanes. */
typedef struct tile_capsule {
    vfloat p[3], q[3], radius;
    vfloat strip[3], strip_width;
    vfloat nearest; /* no depth is less */
    vfloat rlength;
    vuint prim;
} tile_capsule;

/* No pixel's depth at capsule k is less, as the tile's error is. */
CGT_SPU_INLINE float tile_nearest_depth(const tile *t, const tile_capsules *s, int k)
{
    const float nearest = s->min_distance[k] * tile_min_distance_scale(t);
    return (nearest > 0 ? nearest : 0) - t->padded_depth_error;
}

CGT_SPU_INLINE tile_capsule tile_broadcast_capsule(const tile *t, const tile_capsules *s, int k, uint32_t prim)
{
    tile_capsule q = {.radius = spux_vfloat(s->d[6][k]),
                      .strip_width = spux_vfloat(s->strip_width[k]),
                      .nearest = spux_vfloat(tile_nearest_depth(t, s, k)),
                      .rlength = spux_vfloat(s->rlength),
                      .prim = spux_vuint(prim)};
    for (int a = 0; a < 3; a++) {
        q.strip[a] = spux_vfloat(s->strip[a][k]);
        q.p[a] = spux_vfloat(s->d[a][k]);
        q.q[a] = spux_vfloat(s->d[3 + a][k]);
    }
    return q;
}

/* The rays of a vector of pixels, but for rlength. */
CGT_SPU_INLINE void tile_load_lane_rays(const tile *t, bool parallel, vfloat px, vfloat py, lane_rays *r)
{
    const cgt_camera_rays *c = t->rays;
    tile_compute_directions(t, parallel, px, py, parallel ? r->org : r->dir);
    for (int a = 0; a < 3; a++)
        (parallel ? r->dir : r->org)[a] = spux_vfloat(parallel ? c->fwd[a] : c->eye[a]);
    r->t_min = spux_vfloat(c->t_min);
    r->rdd = spux_div(spux_vfloat(1), lane_dot(r->dir, r->dir));
}

/* What a lane test says of depths. enabled: pixels that can be hit. */
CGT_SPU_INLINE tile_pixel_test tile_test_depths(const tile *t, vfloat px, vfloat py, vfloat best, const lane_hits *h)
{
    const vfloat norm = spu_madd(spu_mul(px, spux_vfloat(t->camera.a)), px,
                                 spu_madd(spu_mul(py, spux_vfloat(t->camera.b)), py, spux_vfloat(1)));
    const vfloat depth = spu_mul(spu_mul(h->low, norm), spux_vfloat(1 - 0x1p-20f)),
                 end = spu_mul(spu_mul(h->high, norm), spux_vfloat(1 + 0x1p-20f));
    const vfloat difference = spu_sub(depth, best), most = spux_vfloat(t->padded_depth_error);
    const vmask enabled = spu_and(spu_cmpgt(best, spux_vfloat(-INFINITY)), spu_cmpeq(px, px));
    const vmask fits = spu_cmpgt(spux_vfloat(t->depth_error), spu_sub(end, depth));
    const vmask candidate = spu_and(enabled, spu_or(h->certain_hit, h->undecided));
    return (tile_pixel_test){.depth = depth,
                             .certain = spu_and(spu_and(spu_and(enabled, h->certain_hit), fits),
                                                spu_cmpgt(spux_vfloat(-t->padded_depth_error), difference)),
                             .possible = spu_andc(candidate, spu_cmpgt(difference, most))};
}

/* The same from inside: the near root is before the range, and the ray leaves where the reversed one enters. */
CGT_SPU_INLINE bool tile_test_from_inside(const lane_rays *r, const tile_capsule *q, lane_hits *h)
{
    if (!lane_test_capsule_exit(r, q->p, q->q, q->radius, false, h))
        return false;
    const vmask certain = spu_and(h->certain_hit, spu_cmpgt(h->low, r->t_min));
    h->undecided = spu_andc(spu_or(h->undecided, h->certain_hit), certain);
    h->certain_hit = certain;
    h->low = spux_select(spux_vfloat(0), h->low, certain);
    return true;
}

/* A vector of pixels from i on. Returns the lanes that are undecided. */
CGT_SPU_INLINE unsigned tile_test_capsule(tile *t, bool parallel, bool encloses, const tile_capsule *q, uint32_t column,
                                          uint32_t pair, cgt_counts *counts)
{
    const uint32_t i = pair * TILE_ROW_PAIR + column;
    const vfloat best = spux_load_unaligned(t->z + i);
    lane_rays ray;
    lane_hits h;
    const vfloat px = spux_load_unaligned(t->px + column), py = spux_load(t->py[pair]);
    const vfloat from_axis = spux_abs(spu_madd(px, q->strip[1], spu_madd(py, q->strip[2], q->strip[0])));
    if (spux_all(spu_or(spu_cmpgt(q->nearest, best), spu_cmpgt(from_axis, q->strip_width))))
        return 0;
    counts->ray_tests += CGT_LANES;
    tile_load_lane_rays(t, parallel, px, py, &ray);
    ray.rlength = q->rlength;
    if (!(encloses ? tile_test_from_inside(&ray, q, &h) : lane_test_capsule(&ray, q->p, q->q, q->radius, &h)))
        return 0;
    const tile_pixel_test f = tile_test_depths(t, px, py, best, &h);
    tile_store_certain(t, i, &f, q->prim);
    return spux_mask_bits(spu_andc(f.possible, f.certain));
}

/* Which columns of a pair of rows the strip crosses, counted from the window's first one: from + slope py +- half. */
typedef struct tile_strip_columns {
    float from, slope, half, most;
} tile_strip_columns;

/* Returns false where all columns are to be asked, as the strip is nearly a row, is as wide as the window, where
 * numbers may have overflown, or there is none. So roundings stay below 2^-15 of the screen's half, and of a column, of
 * which one more is taken at either side. */
CGT_SPU_INLINE bool tile_init_strip_columns(const tile *t, const tile_capsules *s, int k, tile_rect rect,
                                            tile_strip_columns *c)
{
    if (!(s->strip_width[k] < INFINITY))
        return false;
    const float m[3] = {s->strip[0][k], s->strip[1][k], s->strip[2][k]}, first = t->column[rect.x0];
    const float y0 = fabsf(t->row[rect.y0]), y1 = fabsf(t->row[rect.y1]), y = y0 > y1 ? y0 : y1;
    if (!(fabsf(m[0]) + fabsf(m[2]) * y < 64 * fabsf(m[1])))
        return false;
    const float scale = (float)(rect.x1 - rect.x0) / (t->column[rect.x1] - first), unit = -scale / m[1];
    *c = (tile_strip_columns){.from = m[0] * unit - first * scale,
                              .slope = m[2] * unit,
                              .half = s->strip_width[k] * fabsf(unit) + 1,
                              .most = (float)(rect.x1 - rect.x0 + 1)};
    return c->half < c->most;
}

/* Places of a pair of rows from *column to *end: whole vectors from the window's first column on. */
CGT_SPU_INLINE void tile_cross_strip(const tile *t, const tile_strip_columns *c, uint32_t pair, tile_rect rect,
                                     uint32_t *column, uint32_t *end)
{
    const float a = c->from + c->slope * t->row[2 * pair], b = c->from + c->slope * t->row[2 * pair + 1];
    const float low = (a < b ? a : b) - c->half, high = (a < b ? b : a) + c->half + 1;
    const float from = low < c->most ? low : c->most, to = high < c->most ? high : c->most;
    *column = 2 * rect.x0 + 2 * (uint32_t)(from > 0 ? from : 0) / CGT_LANES * CGT_LANES;
    *end = 2 * rect.x0 + 2 * (uint32_t)(to > 0 ? to : 0);
}

/* What is drawn of each pair of rows: NULL: all of the window. `parallel` and `encloses` are constants: where they are
 * false, what depends on the eye and the capsule is computed once. */
CGT_SPU_INLINE void tile_rasterise_capsule_by(const cgt_primitives *prims, tile *t, bool parallel, bool encloses,
                                              const tile_strip_columns *crossed, const tile_capsules *s, int k,
                                              uint32_t prim, tile_rect rect, tile_queue *queue, cgt_counts *counts)
{
    const tile_capsule q = tile_broadcast_capsule(t, s, k, prim);
    for (uint32_t pair = rect.y0 / 2; pair <= rect.y1 / 2; pair++) {
        uint32_t column = 2 * rect.x0, end = 2 * rect.x1 + 1;
        if (crossed)
            tile_cross_strip(t, crossed, pair, rect, &column, &end);
        for (; column < end; column += CGT_LANES)
            for (unsigned undecided = tile_test_capsule(t, parallel, encloses, &q, column, pair, counts); undecided;
                 undecided &= undecided - 1)
                tile_queue_push(prims, t, queue, pair * TILE_ROW_PAIR + column + (uint32_t)__builtin_ctz(undecided),
                                prim, counts);
    }
    counts->packet_tests++;
}

#endif
