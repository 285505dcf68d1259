/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules against a tile. A vector of capsules at a time is culled by windows; each visible one is then tested over
 * the pixels of its window by lane_capsules.h, with a ray in each lane. The bounds there hold for any ray and capsule,
 * also around and behind the eye. So double precision is left to the queue.
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
 * The strip: a window holds far more pixels than a thin capsule that crosses it. Let m be p x q, the normal of the
 * plane through the eye and the axis in camera space, p and q of length 1. A ray d that meets the capsule passes within
 * r of the axis, at z = t no nearer than the nearer end minus r, so
 *   |m.d| <= r |m| / (min(z_p, z_q) - r)
 * which is linear in the pixel's coordinates. Ends are off by 10 u (tile_spheres.h, and the division), a canonical
 * direction by 3.5 u, products and sums by 7 u: 31 u |d| together, of which 64 u are taken; the widened radius covers
 * the metric. Rays that are parallel stay within r |m| of the line through both ends, for n = (q - p) / V across the
 * rays with m = (n_y p_x - n_x p_y, -n_y, n_x). With V the largest distance from the eye of an end, plus that of an
 * origin, this is off by 45 u V, of which 64 u V are taken. Neither suffers from underflow.
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
    const float depth_error = c * t->max_dir_length * 0x1p-15f;
    t->depth_error = t->depth_error > depth_error ? t->depth_error : depth_error;
    t->padded_depth_error = t->depth_error * (1 + 0x1p-20f);
}

/* A vector of capsules. */
typedef struct tile_capsules {
    tile_windows window;
    _Alignas(64) float d[7][CGT_LANES]; /* the numbers of cgt_capsule */
    _Alignas(64) float min_distance[CGT_LANES];
    _Alignas(64) float strip[3][CGT_LANES], strip_width[CGT_LANES]; /* 1, px and py times these; no more in the strip */
    unsigned visible;                                               /* lanes, as bits */
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
    return spu_sub(spu_sub(nearer, sag), spu_madd(spu_add(length, nearer), spux_vfloat(0x1p-19f), pad));
}

/* pad: what the radii are widened to. */
CGT_SPU_INLINE void tile_store_strips(const tile *t, const tile_projected_spheres v[2], vfloat pad, vmask in_front,
                                      tile_capsules *s)
{
    const vfloat one = spux_vfloat(1), zero = spux_vfloat(0);
    vfloat m[3], lead = pad, most = spux_vfloat(t->max_dir_length), square = zero;
    if (t->parallel) {
        most = spu_add(spux_max(v[0].distance, v[1].distance), spux_vfloat(t->origin_offset));
        const vfloat scale = spux_div(one, most);
        m[1] = spu_mul(spu_sub(v[0].y, v[1].y), scale);
        m[2] = spu_mul(spu_sub(v[1].x, v[0].x), scale);
        m[0] = spu_sub(zero, spu_madd(m[1], v[0].x, spu_mul(m[2], v[0].y)));
    } else {
        vfloat end[2][3];
        for (int k = 0; k < 2; k++) {
            const vfloat scale = spux_div(one, v[k].distance), x[3] = {v[k].z, v[k].x, v[k].y};
            for (int a = 0; a < 3; a++)
                end[k][a] = spu_mul(x[a], scale);
        }
        lane_cross(end[0], end[1], m);
        square = spu_mul(m[0], m[0]);
        lead = spux_div(pad, spu_sub(spux_min(v[0].z, v[1].z), pad));
    }
    const vfloat length = spux_sqrt(spu_madd(m[1], m[1], spu_madd(m[2], m[2], square)));
    const vfloat width = spu_madd(length, lead, spu_mul(most, spux_vfloat(0x1p-18f)));
    spux_store(s->strip[0], m[0]);
    spux_store(s->strip[1], spu_mul(m[1], spux_vfloat(t->camera.right)));
    spux_store(s->strip[2], spu_mul(m[2], spux_vfloat(t->camera.up)));
    spux_store(s->strip_width, spux_select(spux_vfloat(INFINITY), width, in_front));
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
    spux_store(s->min_distance, min_distance);
    tile_store_strips(t, v, spux_max(v[0].padded_radius, v[1].padded_radius), in_front, s);
    const vfloat far_distance = tile_window_far_distance(t, &s->window, &large_windows);
    const vmask occluded = spu_or(spu_cmpgt(min_distance, spux_vfloat(t->max_far_distance)),
                                  spu_andc(spu_and(in_front, spu_cmpgt(min_distance, far_distance)), large_windows));
    s->visible = first_lanes(count) & ~spux_mask_bits(spu_or(outside, occluded));
    const unsigned around = s->visible & ~spux_mask_bits(in_front);
    if (!around)
        return;
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
    vfloat rlength; /* at least 1 / |d| of any ray of the tile */
    vuint prim;
} tile_capsule;

CGT_SPU_INLINE tile_capsule tile_broadcast_capsule(const tile *t, const tile_capsules *s, int k, uint32_t prim)
{
    tile_capsule q = {.radius = spux_vfloat(s->d[6][k]),
                      .strip_width = spux_vfloat(s->strip_width[k]),
                      .rlength = spux_vfloat(1 / sqrtf(t->min_norm) * (1 + 0x1p-17f)),
                      .prim = spux_vuint(prim)};
    for (int a = 0; a < 3; a++) {
        q.strip[a] = spux_vfloat(s->strip[a][k]);
        q.p[a] = spux_vfloat(s->d[a][k]);
        q.q[a] = spux_vfloat(s->d[3 + a][k]);
    }
    const float nearest = s->min_distance[k] * tile_min_distance_scale(t);
    q.nearest = spux_vfloat((nearest > 0 ? nearest : 0) - t->padded_depth_error);
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

/* A vector of pixels from i on. Returns the lanes that are undecided. */
CGT_SPU_INLINE unsigned tile_test_capsule(tile *t, bool parallel, const tile_capsule *q, uint32_t column, uint32_t pair,
                                          cgt_counts *counts)
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
    if (!lane_test_capsule(&ray, q->p, q->q, q->radius, &h))
        return 0;
    const tile_pixel_test f = tile_test_depths(t, px, py, best, &h);
    tile_store_certain(t, i, &f, q->prim);
    return spux_mask_bits(spu_andc(f.possible, f.certain));
}

/* `parallel` is a constant: where it is false, what depends on the eye and the capsule is computed once. */
CGT_SPU_INLINE void tile_rasterise_capsule(const cgt_primitives *prims, tile *t, bool parallel, const tile_capsules *s,
                                           int k, uint32_t prim, tile_rect rect, tile_queue *queue, cgt_counts *counts)
{
    const tile_capsule q = tile_broadcast_capsule(t, s, k, prim);
    for (uint32_t pair = rect.y0 / 2; pair <= rect.y1 / 2; pair++)
        for (uint32_t column = 2 * rect.x0; column <= 2 * rect.x1; column += CGT_LANES)
            for (unsigned undecided = tile_test_capsule(t, parallel, &q, column, pair, counts); undecided;
                 undecided &= undecided - 1)
                tile_queue_push(prims, t, queue, pair * TILE_ROW_PAIR + column + (uint32_t)__builtin_ctz(undecided),
                                prim, counts);
    counts->packet_tests++;
}

#endif
