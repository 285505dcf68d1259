/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres against a tile of parallel rays. Let z, x, y be a centre in camera space (tile.h), rho and upsilon the
 * lengths of right and up, X = x / rho, Y = y / upsilon, dx = px - X and dy = py - Y. The discriminant of pixel (px,
 * py) and its depth are
 *   D = r^2 - (rho dx)^2 - (upsilon dy)^2     q = t = z - sqrt(D)
 * which is what tile_sphere_draw.h computes with the perspective terms set to 0.
 *
 * Error bounds. u = 2^-24, c is the distance from the eye to the centre, S = 2 |eye| + 3 rho + 2 upsilon
 * (tile_init_parallel). They hold for fused and unfused arithmetic:
 *   origin      the canonical one is off by u S
 *   direction   exact: it is the camera's own
 *   centre      u c from subtracting the eye, 4 u c in each coordinate: 7 u c across the ray, 5 u c along it
 *   X, Y        X is rounded twice, rho once, dx once: 3 u c and u b of (rho dx, upsilon dy)
 *   b           the distance from the centre to the ray, off by the sum of these: s = u S + 10 u c. At the
 *               silhouette b = r, this moves D by 2 r s + s^2; further out D falls faster than this grows
 *   metric      products of the axes are within 4 u of 1 and 0: b^2 by 4 u b^2, |d|^2 by 4 u; 8 u r^2
 *   evaluation  at the silhouette r^2 and (rho dx)^2 + (upsilon dy)^2 are at most r^2, each rounded at most 9 times,
 *               including the rounding of dx and of rho^2: 18 u r^2
 *   eps         2 r s + s^2 + 26 u r^2 + 2^-116
 *   depth       centre 5 u c, origin u S, metric 4 u (|x'| + |y'|) + 2 u r <= 8 u r, sums 3 u (c + r), the estimate of
 *               1 / sqrt(D) as in tile_spheres.h
 *   e0          u S + 8 u c + (11 u + TILE_RSQRT_ERROR) r + 2^-10 sqrt(eps) + 2^-100
 * tile_compute_sphere_errors has 34 u r c + 112 u r^2 + (20 u c)^2 and 44 u c + (18 u + TILE_RSQRT_ERROR) r. With
 * 0.6 c + S / 17 in place of c that is 20.4 u r c + 2 u r S + 112 u r^2 + (12 u c + 1.17 u S)^2 and more than
 * 26 u c + 2.5 u S, both above the bounds here. So its bounds serve, with that distance and N0 = 1.
 *
 * Windows and least distances are widened by 2^-18 (c + r) + 2 u S. A sphere that, widened, ends before the range is
 * culled; one that may begin before it goes to tile_double.c.
 *
 * A test checks the bounds against wide arithmetic, and tightens them until it sees them break. */
#ifndef CGT_TILE_PARALLEL_SPHERES_H
#define CGT_TILE_PARALLEL_SPHERES_H

#include "kernel/tile_draw/tile_spheres.h"

/* The distance to pass to tile_compute_sphere_errors for a centre at distance c. */
CGT_SPU_INLINE vfloat tile_parallel_distance(const tile *t, vfloat c)
{
    return spu_madd(c, spux_vfloat(0.6f), spux_vfloat(t->origin_error * (1 / 17.f * (1 + 0x1p-20f))));
}

CGT_SPU_INLINE void tile_init_parallel_depth_error(tile *t, float c, float r, float far_t)
{
    tile_init_sphere_depth_error(t, tile_parallel_distance(t, spux_vfloat(c))[0], r, far_t);
}

/* As for perspective, except for the least distance; windows hold for all lanes. */
CGT_SPU_INLINE tile_projected_spheres tile_project_parallel_spheres(const tile *t, const vfloat q[4])
{
    tile_projected_spheres v = tile_project_spheres(t, q);
    v.min_distance = spu_sub(v.z, v.padded_radius);
    v.in_front = spux_mask_all();
    return v;
}

CGT_SPU_INLINE vmask tile_cull_parallel_by_depth(const tile *t, const tile_projected_spheres *v)
{
    const float begin = t->rays->t_min * (1 - TILE_LENGTH_ERROR) - 0x1p-60f;
    const vmask occluded = spu_cmpgt(v->min_distance, spux_vfloat(t->max_far_distance));
    return spu_or(occluded, spu_cmpgt(spux_vfloat(begin), spu_add(v->z, v->padded_radius)));
}

CGT_SPU_INLINE unsigned tile_setup_parallel_spheres(const tile *t, const tile_projected_spheres *v, tile_spheres *s)
{
    const vfloat zero = spux_vfloat(0), one = spux_vfloat(1), distance = tile_parallel_distance(t, v->distance);
    const tile_sphere_errors errors = tile_compute_sphere_errors(t, distance, v->r, one);
    const vmask fits = tile_store_sphere_certain(t, v, errors, s);
    const vmask past_t_min = spu_cmpgt(v->min_distance, spux_vfloat(t->rays->t_min * (1 + TILE_LENGTH_ERROR)));
    spux_store(s->X, spu_mul(v->x, spux_vfloat(t->camera.rright)));
    spux_store(s->Y, spu_mul(v->y, spux_vfloat(t->camera.rup)));
    spux_store(s->a, spux_vfloat(t->camera.right * t->camera.right));
    spux_store(s->c, spux_vfloat(t->camera.up * t->camera.up));
    spux_store(s->d0, spu_add(v->r2, errors.eps));
    spux_store(s->q0, spu_sub(v->z, errors.e0));
    spux_store(s->b, zero);
    spux_store(s->dx, zero);
    spux_store(s->dy, zero);
    spux_store(s->qx, zero);
    spux_store(s->qy, zero);
    spux_store(s->min_distance, v->min_distance);
    return spux_mask_bits(spu_and(fits, past_t_min));
}

/* tile_cull_spheres and tile_init_spheres for parallel rays. */
CGT_SPU_INLINE void tile_cull_parallel_spheres(const tile *t, const vfloat sphere[4], vuint prim, uint32_t count,
                                               tile_visible_spheres *f)
{
    vfloat q[4];
    tile_windows w;
    tile_transform_spheres(t, sphere, q);
    const tile_projected_spheres v = tile_project_parallel_spheres(t, q);
    const vmask out_of_range = tile_cull_parallel_by_depth(t, &v);
    const vmask outside = tile_compute_parallel_windows(t, v.x, v.y, v.padded_radius, v.padded_radius, &w);
    const vmask out = spu_or(spu_or(out_of_range, outside), tile_cull_occluded_spheres(t, &v, &w));
    tile_append_visible(f, q, prim, &w, first_lanes(count) & ~spux_mask_bits(out));
}

CGT_SPU_INLINE void tile_init_parallel_spheres(const tile *t, const tile_visible_spheres *f, uint32_t first,
                                               tile_spheres *s)
{
    const unsigned lanes = first_lanes(f->count - first);
    vfloat q[4];
    tile_load_visible(f, first, q, s);
    const tile_projected_spheres v = tile_project_parallel_spheres(t, q);
    s->single_lanes = lanes & tile_setup_parallel_spheres(t, &v, s);
    s->double_lanes = lanes & ~s->single_lanes;
    tile_classify_small_spheres(s);
}

#endif
