/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres against a tile. A vector of spheres at a time is projected to camera space and culled by its windows; each
 * visible sphere is then tested over the pixels of its window, without branches (tile_sphere_draw.h).
 *
 * Let z, x, y be a centre in camera space (tile.h), rho and upsilon the lengths of right and up, X = x / (z rho),
 * Y = y / (z upsilon), dx = px - X, dy = py - Y and N = 1 + rho^2 px^2 + upsilon^2 py^2. The discriminant of pixel
 * (px, py) is
 *   D = N (r^2 - b^2) = r^2 N - (A dx^2 + B dx dy + C dy^2)
 * where b is the distance from the centre to the ray, A = rho^2 (z^2 + y^2), B = -2 rho upsilon x y and
 * C = upsilon^2 (z^2 + x^2). Expanding N about (X, Y), too, leaves a polynomial in dx and dy, and a depth (tile.h)
 *   D = r^2 N0 + dy (2 r^2 upsilon^2 Y - C' dy) + dx (2 r^2 rho^2 X - B dy - A' dx)
 *   N0 = 1 + (x^2 + y^2) / z^2,  A' = A - rho^2 r^2,  C' = C - upsilon^2 r^2
 *   q = z + rho x px + upsilon y py - sqrt(D)
 *
 * Error bounds, for spheres with z >= 1.5 r. u = 2^-24, c is the distance from the eye to the centre, |d|^2 the tile's
 * largest N. They hold for fused and unfused arithmetic, and for divisions and roots within 2^-21 = 8 u:
 *   direction   the canonical one is off by u (|px right| + |fwd + px right| + |py up| + |d|) <= 3.5 u |d|
 *   centre      u c from subtracting the eye, 4 u c in each coordinate: sqrt(3) 4 u c + u c = 8 u c
 *   X, Y        10 u relative: 10 u sin cos of the angle to the axis, at most 5 u of the direction
 *   b           the sum of these: at most 16.5 u c. At the silhouette b = r, this moves D by
 *               N (2 r 16.5 u c + (16.5 u c)^2); further out D falls faster than this grows
 *   metric      products of the axes are within 2^-22 = 4 u of 1 and 0, and a square is rounded: no norm or product of
 *               two vectors in these axes is off by more than 12 u of the norms. D: (4 + 1) 12 u r^2 N N0
 *   evaluation  at the silhouette |(rho dx, upsilon dy)| <= r |d| / z, so the terms, r^2 N0 included, are at most
 *               r^2 N N0 times 1, 1/2, 1, 4/3, 1/2: 4.4 in total, each rounded at most 11 times: 49 u r^2 N N0
 *   eps         |d|^2 (34 u r c + 112 u r^2 N0 + (20 u c)^2) + 2^-116; the last term covers underflow
 * eps is added to D. A result below 0 is a certain miss. A result above 3 eps is a certain hit, whose exact D is at
 * least the result minus 2 eps. Above a threshold `certain` >= 3 eps, the computed and the exact root differ by at most
 *   root        2 eps / (sqrt(certain) + sqrt(certain - 2 eps)); 0.74 sqrt(eps) for 3 eps; eps / sqrt(certain - 2 eps)
 * The other errors of the depth, against the exact t times N:
 *   centre 8 u c |d|, direction 3.5 u c |d|, metric 24 u c |d| and 10 u r |d|, sums 5 u (c + r) |d|, and the estimate
 *   of 1 / sqrt(D): TILE_RSQRT_ERROR times (r |d| + sqrt(2 eps))
 *   e0          |d| (44 u c + (18 u + TILE_RSQRT_ERROR) r) + 2^-10 sqrt(eps) + 2^-100
 * So the exact depth lies in [q - e0, q - e0 + depth_error] if depth_error >= 2 e0 + root. The tile has one
 * depth_error. A sphere for which it makes `certain` too large goes to tile_double.c, like all for which these bounds
 * do not hold.
 *
 * The window: a tangent to the silhouette in the plane of forward and right has
 *   px rho = (x z -+ r sqrt(x^2 + z^2 - r^2)) / (z^2 - r^2)
 * A radius enlarged by 2^-18 (c + r) covers the rounding of this and the error of b. Columns are widened by another
 * 1/32: their px is rounded to 2^-23, at most 2^-8 of a column.
 *
 * A test checks the bounds against wide arithmetic, and tightens them until it sees them break. */
#ifndef CGT_TILE_SPHERES_H
#define CGT_TILE_SPHERES_H

#include "kernel/primitive/gather_primitives.h"
#include "kernel/tile/tile_window.h"

#define TILE_EPS_ANGLE (34 * FILTER_ROUNDOFF)
#define TILE_EPS_SUMS (112 * FILTER_ROUNDOFF)
#define TILE_EPS_SECOND (20 * FILTER_ROUNDOFF)
#define TILE_EPS_DEPTH (44 * FILTER_ROUNDOFF)
#define TILE_LENGTH_ERROR (64 * FILTER_ROUNDOFF) /* 2^-18: what windows, strips and cones are widened by */

/* ---- bounds ---- */

/* The errors of D and q. */
typedef struct tile_sphere_errors {
    vfloat eps, e0;
} tile_sphere_errors;

CGT_SPU_INLINE tile_sphere_errors tile_compute_sphere_errors(const tile *t, vfloat c, vfloat r, vfloat n0)
{
    const vfloat second = spu_mul(c, spux_vfloat(TILE_EPS_SECOND));
    const vfloat first = spu_madd(c, spux_vfloat(TILE_EPS_ANGLE), spu_mul(spu_mul(r, n0), spux_vfloat(TILE_EPS_SUMS)));
    const vfloat eps =
        spu_madd(spu_madd(r, first, spu_mul(second, second)), spux_vfloat(t->max_norm), spux_vfloat(0x1p-116f));
    const vfloat depth =
        spu_madd(c, spux_vfloat(TILE_EPS_DEPTH), spu_mul(r, spux_vfloat(18 * FILTER_ROUNDOFF + TILE_RSQRT_ERROR)));
    const vfloat rest = spu_madd(spux_sqrt(eps), spux_vfloat(0x1p-10f), spux_vfloat(0x1p-100f));
    return (tile_sphere_errors){eps, spu_madd(depth, spux_vfloat(t->max_dir_length), rest)};
}

/* Sets the tile's depth error: large enough for spheres of radius r up to distance c, the scene's farthest point, and
 * for the rounding of any depth in the scene and of the range's end. far_t: no hit has a larger t. */
CGT_SPU_INLINE void tile_init_sphere_depth_error(tile *t, float c, float r, float far_t)
{
    const tile_sphere_errors b =
        tile_compute_sphere_errors(t, spux_vfloat(c), spux_vfloat(r), spux_vfloat(t->max_norm));
    const float end = t->rays->t_max < far_t ? t->rays->t_max : 0;
    const float end_error = end * t->max_norm * 0x1p-18f, depth_error = 2 * b.e0[0] + 0.75f * sqrtf(b.eps[0]);
    t->depth_error = (end_error > depth_error ? end_error : depth_error) + c * t->max_dir_length * 0x1p-19f;
    t->padded_depth_error = t->depth_error * (1 + 0x1p-20f);
}

/* ---- a vector of spheres ---- */

/* What the loops over pixels need of each sphere. */
typedef struct tile_spheres {
    _Alignas(64) float X[CGT_LANES], Y[CGT_LANES];
    _Alignas(64) float a[CGT_LANES], b[CGT_LANES], c[CGT_LANES];    /* A', -B, C' */
    _Alignas(64) float d0[CGT_LANES], dx[CGT_LANES], dy[CGT_LANES]; /* of D: r^2 N0 + eps; 2 r^2 rho^2 X, and for Y */
    _Alignas(64) float q0[CGT_LANES], qx[CGT_LANES], qy[CGT_LANES]; /* of q: z - e0, rho x, upsilon y */
    _Alignas(64) float certain[CGT_LANES], min_distance[CGT_LANES]; /* nothing is hit at a smaller distance */
    tile_windows window;
    _Alignas(64) uint32_t prim[CGT_LANES];
    unsigned single_lanes, double_lanes; /* as bits: for tile_rasterise_sphere, for tile_double.c */
    unsigned small_lanes[2];             /* windows one vector wide, and at most 3 or 4 pairs of rows high */
} tile_spheres;

/* The visible spheres of several vectors, in camera space and compacted: culling appends without a branch, and the
 * steps after it have full vectors. */
#define TILE_MAX_VISIBLE 128u
typedef struct tile_visible_spheres {
    _Alignas(64) float z[TILE_MAX_VISIBLE + CGT_LANES], x[TILE_MAX_VISIBLE + CGT_LANES];
    _Alignas(64) float y[TILE_MAX_VISIBLE + CGT_LANES], r[TILE_MAX_VISIBLE + CGT_LANES];
    _Alignas(64) uint32_t prim[TILE_MAX_VISIBLE + CGT_LANES];
    _Alignas(64) uint32_t window[TILE_MAX_VISIBLE + CGT_LANES]; /* x0, x1, y0, y1 from the lowest byte up */
    uint32_t count;
} tile_visible_spheres;

/* The columns (or rows) of the silhouette's two tangents. low <= high if the span's scale is positive, else the
 * reverse. r2: r^2. unit: the scale over z^2 - r^2. */
CGT_SPU_INLINE void tile_compute_tangents(const tile_span *span, vfloat x, vfloat z, vfloat r, vfloat r2, vfloat unit,
                                          vfloat *low, vfloat *high)
{
    const vfloat square = spu_sub(spu_madd(x, x, spu_mul(z, z)), r2), middle = spu_mul(x, z);
    const vfloat root = spu_mul(r, spux_sqrt(square)), first = spux_vfloat(span->first);
    *low = spu_msub(spu_sub(middle, root), unit, first);
    *high = spu_msub(spu_add(middle, root), unit, first);
}

/* Lanes outside the cone of all rays. */
CGT_SPU_INLINE vmask tile_cull_by_cone(const tile *t, vfloat z, vfloat x, vfloat y, vfloat c, vfloat r)
{
    if (t->secant == 0)
        return spux_mask_none();
    const vfloat az = spux_vfloat(t->axis[0]), ax = spux_vfloat(t->axis[1]), ay = spux_vfloat(t->axis[2]);
    const vfloat s = spu_madd(z, az, spu_madd(x, ax, spu_mul(y, ay)));
    const vfloat pz = spu_nmsub(s, az, z), px = spu_nmsub(s, ax, x), py = spu_nmsub(s, ay, y);
    const vfloat p2 = spu_madd(pz, pz, spu_madd(px, px, spu_mul(py, py)));
    const vfloat error = spu_madd(spu_add(c, r), spux_vfloat(TILE_LENGTH_ERROR), spux_vfloat(0x1p-60f));
    const vfloat reach = spu_add(spu_madd(r, spux_vfloat(t->secant), spu_mul(s, spux_vfloat(t->tangent))), error);
    return spu_or(spu_cmpgt(spux_vfloat(0), reach), spu_cmpgt(p2, spu_mul(reach, reach)));
}

/* Lanes that are occluded, or lie before the range. A distance and t |d| are each off by 20 u at most: 8 u for a
 * centre, 10 u for the metric and the rounding of a direction, 2 u for t and the root. */
CGT_SPU_INLINE vmask tile_cull_spheres_by_depth(const tile *t, vfloat c, vfloat r, vfloat min_distance)
{
    const vmask occluded = spu_cmpgt(min_distance, spux_vfloat(t->max_far_distance));
    if (t->rays->t_min == 0)
        return occluded;
    const vfloat end = spu_mul(spu_add(c, r), spux_vfloat(1 + TILE_LENGTH_ERROR));
    const float begin = t->rays->t_min * sqrtf(t->min_norm) * (1 - TILE_LENGTH_ERROR) - 0x1p-60f;
    return spu_or(occluded, spu_cmpgt(spux_vfloat(begin), end));
}

/* A vector of spheres as the camera sees them. */
typedef struct tile_projected_spheres {
    vfloat z, x, y, r, z2, x2, y2, r2;
    vfloat distance;
    vfloat min_distance;  /* nothing is hit at a smaller distance */
    vfloat padded_radius; /* the radius, and more than all that the window may be off by */
    vmask in_front;       /* as far in front of the eye as the bounds ask, and not far beside what it sees */
} tile_projected_spheres;

/* Spheres to camera space: z, x, y and r. */
CGT_SPU_INLINE void tile_transform_spheres(const tile *t, const vfloat sphere[4], vfloat q[4])
{
    const float(*dual)[3] = t->camera.dual;
    vfloat p[3];
    for (int a = 0; a < 3; a++)
        p[a] = spu_sub(sphere[a], spux_vfloat(t->rays->eye[a]));
    for (int k = 0; k < 3; k++)
        q[k] = spu_madd(p[0], spux_vfloat(dual[k][0]),
                        spu_madd(p[1], spux_vfloat(dual[k][1]), spu_mul(p[2], spux_vfloat(dual[k][2]))));
    q[3] = sphere[3];
}

/* q: from tile_transform_spheres. */
CGT_SPU_INLINE tile_projected_spheres tile_project_spheres(const tile *t, const vfloat q[4])
{
    tile_projected_spheres v = {.z = q[0], .x = q[1], .y = q[2], .r = q[3]};
    v.z2 = spu_mul(v.z, v.z);
    v.x2 = spu_mul(v.x, v.x);
    v.y2 = spu_mul(v.y, v.y);
    v.r2 = spu_mul(v.r, v.r);
    const vfloat lateral2 = spu_add(v.x2, v.y2);
    v.distance = spux_sqrt(spu_add(v.z2, lateral2));
    const vfloat length_error =
        spu_madd(spu_add(v.distance, v.r), spux_vfloat(TILE_LENGTH_ERROR), spux_vfloat(t->length_error));
    v.padded_radius = spu_add(v.r, length_error);
    /* from the eye to the surface: from outside, or from inside */
    v.min_distance = spux_max(spu_sub(v.distance, v.padded_radius), spu_sub(spu_sub(v.r, v.distance), length_error));
    v.in_front = spu_and(spu_cmpgt(v.z, spu_madd(v.padded_radius, spux_vfloat(1.5f), spux_vfloat(0x1p-48f))),
                         spu_cmpgt(spu_mul(v.z2, spux_vfloat(256)), lateral2));
    return v;
}

/* Windows of the spheres in front. Returns those of them that are outside the tile. */
CGT_SPU_INLINE vmask tile_cull_spheres_by_window(const tile *t, const tile_projected_spheres *v, tile_windows *s)
{
    const vfloat r2 = spu_mul(v->padded_radius, v->padded_radius), column_span = spux_vfloat(t->column_span.scale);
    const vfloat unit = spux_div(column_span, spu_sub(v->z2, r2));
    vfloat low, high;
    tile_compute_tangents(&t->column_span, v->x, v->z, v->padded_radius, r2, unit, &low, &high);
    const vmask outside_x = tile_compute_window(low, high, &t->column_span, s->x0, s->x1);
    const vfloat row_span = spu_mul(unit, spux_vfloat(t->span_ratio));
    tile_compute_tangents(&t->row_span, v->y, v->z, v->padded_radius, r2, row_span, &high, &low);
    const vmask outside_y = tile_compute_window(low, high, &t->row_span, s->y0, s->y1);
    return spu_and(v->in_front, spu_or(outside_x, outside_y));
}

/* Spheres that are occluded in all parts under their window, as far as its corners tell. */
CGT_SPU_INLINE vmask tile_cull_occluded_spheres(const tile *t, const tile_projected_spheres *v, const tile_windows *s)
{
    vmask large_windows;
    const vfloat far_distance = tile_window_far_distance(t, s, &large_windows);
    return spu_andc(spu_and(v->in_front, spu_cmpgt(v->min_distance, far_distance)), large_windows);
}

/* Stores the coefficients of D and q. */
CGT_SPU_INLINE void tile_store_spheres(const tile *t, const tile_projected_spheres *v, vfloat gx, vfloat gy, vfloat n0,
                                       tile_sphere_errors errors, tile_spheres *s)
{
    const tile_camera *m = &t->camera;
    const vfloat two_r2 = spu_add(v->r2, v->r2), right = spux_vfloat(m->right), up = spux_vfloat(m->up);
    spux_store(s->X, spu_mul(gx, spux_vfloat(m->rright)));
    spux_store(s->Y, spu_mul(gy, spux_vfloat(m->rup)));
    spux_store(s->a, spu_mul(spu_sub(spu_add(v->z2, v->y2), v->r2), spux_vfloat(m->a)));
    spux_store(s->b, spu_mul(spu_mul(v->x, v->y), spux_vfloat(2 * m->right * m->up)));
    spux_store(s->c, spu_mul(spu_sub(spu_add(v->z2, v->x2), v->r2), spux_vfloat(m->b)));
    spux_store(s->d0, spu_madd(v->r2, n0, errors.eps));
    spux_store(s->dx, spu_mul(spu_mul(two_r2, gx), right));
    spux_store(s->dy, spu_mul(spu_mul(two_r2, gy), up));
    spux_store(s->q0, spu_sub(v->z, errors.e0));
    spux_store(s->qx, spu_mul(v->x, right));
    spux_store(s->qy, spu_mul(v->y, up));
    spux_store(s->min_distance, v->min_distance);
}

/* Stores `certain`. Returns the lanes most of whose pixels are beyond it. */
CGT_SPU_INLINE vmask tile_store_sphere_certain(const tile *t, const tile_projected_spheres *v,
                                               tile_sphere_errors errors, tile_spheres *s)
{
    /* D that far beyond 2 eps makes `root` fit into the depth error */
    const vfloat room = spu_nmsub(errors.e0, spux_vfloat(2), spux_vfloat(t->depth_error));
    const vfloat beyond = spux_div(spu_mul(errors.eps, spux_vfloat(1 + 0x1p-18f)), room);
    const vfloat beyond2 = spu_mul(beyond, beyond), upper = spux_max(spu_mul(v->r2, spux_vfloat(0.25f)), errors.eps);
    spux_store(s->certain, spu_madd(errors.eps, spux_vfloat(2), spux_max(beyond2, errors.eps)));
    return spu_and(spu_cmpgt(room, spu_mul(errors.e0, spux_vfloat(0.25f))), spu_cmpgt(upper, beyond2));
}

/* Stores coefficients and `certain`. Returns the lanes for which the bounds hold, as bits: in front, after the range's
 * begin, and most of their pixels beyond `certain`. */
CGT_SPU_INLINE unsigned tile_setup_spheres(const tile *t, const tile_projected_spheres *v, tile_spheres *s)
{
    const vfloat rz = spux_div(spux_vfloat(1), v->z), gx = spu_mul(v->x, rz), gy = spu_mul(v->y, rz);
    const vfloat n0 = spu_madd(gx, gx, spu_madd(gy, gy, spux_vfloat(1)));
    const tile_sphere_errors errors = tile_compute_sphere_errors(t, v->distance, v->r, n0);
    const vmask fits = tile_store_sphere_certain(t, v, errors, s);
    const vmask past_t_min =
        spu_cmpgt(v->min_distance, spux_vfloat(t->rays->t_min * t->max_dir_length * (1 + TILE_LENGTH_ERROR)));
    tile_store_spheres(t, v, gx, gy, n0, errors, s);
    return spux_mask_bits(spu_and(v->in_front, spu_and(fits, past_t_min)));
}

/* For the spheres that go to tile_double.c: drops those outside the cone; those without a window get the whole tile. */
CGT_SPU_INLINE void tile_setup_double_spheres(const tile *t, const tile_projected_spheres *v, tile_spheres *s)
{
    s->double_lanes &= ~spux_mask_bits(tile_cull_by_cone(t, v->z, v->x, v->y, v->distance, v->r));
    tile_set_full_windows(t, s->double_lanes & ~spux_mask_bits(v->in_front), &s->window);
}

/* Finds the windows that are one vector wide and few pairs of rows high. */
CGT_SPU_INLINE void tile_classify_small_spheres(tile_spheres *s)
{
    const tile_windows *window = &s->window;
    const vuint width = spu_sub(spux_load_uint(window->x1), spux_load_uint(window->x0));
    const vuint height = spu_sub(spu_sr(spux_load_uint(window->y1), 1), spu_sr(spux_load_uint(window->y0), 1));
    const vmask narrow = spu_cmpgt(spux_vuint(CGT_LANES / 2), width);
    s->small_lanes[0] = spux_mask_bits(spu_and(narrow, spu_cmpgt(spux_vuint(3), height)));
    s->small_lanes[1] = spux_mask_bits(spu_and(narrow, spu_cmpgt(spux_vuint(4), height)));
}

/* Appends these lanes, as bits, of a vector of spheres. */
CGT_SPU_INLINE void tile_append_visible(tile_visible_spheres *f, const vfloat q[4], vuint prim, const tile_windows *s,
                                        unsigned lanes)
{
    const vuint columns = spu_or(spux_load_uint(s->x0), spu_sl(spux_load_uint(s->x1), 8));
    const vuint rows = spu_or(spu_sl(spux_load_uint(s->y0), 16), spu_sl(spux_load_uint(s->y1), 24));
    const vmask mask = spux_mask_from_bits(lanes);
    spux_store_unaligned(f->z + f->count, spux_compress(q[0], mask));
    spux_store_unaligned(f->x + f->count, spux_compress(q[1], mask));
    spux_store_unaligned(f->y + f->count, spux_compress(q[2], mask));
    spux_store_unaligned(f->r + f->count, spux_compress(q[3], mask));
    spux_store_unaligned_uint(f->prim + f->count, spux_compress(prim, mask));
    spux_store_unaligned_uint(f->window + f->count, spux_compress(spu_or(columns, rows), mask));
    f->count += spux_count_bits(lanes);
}

/* Loads a vector of visible spheres, from number `first` on. */
CGT_SPU_INLINE void tile_load_visible(const tile_visible_spheres *f, uint32_t first, vfloat q[4], tile_spheres *s)
{
    const vuint window = spux_load_uint(f->window + first), byte = spux_vuint(255);
    q[0] = spux_load(f->z + first);
    q[1] = spux_load(f->x + first);
    q[2] = spux_load(f->y + first);
    q[3] = spux_load(f->r + first);
    spux_store_uint(s->prim, spux_load_uint(f->prim + first));
    spux_store_uint(s->window.x0, spu_and(window, byte));
    spux_store_uint(s->window.x1, spu_and(spu_sr(window, 8), byte));
    spux_store_uint(s->window.y0, spu_and(spu_sr(window, 16), byte));
    spux_store_uint(s->window.y1, spu_sr(window, 24));
}

/* Culls the first `count` lanes of a vector of spheres, and appends the visible ones. */
CGT_SPU_INLINE void tile_cull_spheres(const tile *t, const vfloat sphere[4], vuint prim, uint32_t count,
                                      tile_visible_spheres *f)
{
    vfloat q[4];
    tile_windows w;
    tile_transform_spheres(t, sphere, q);
    const tile_projected_spheres v = tile_project_spheres(t, q);
    const vmask out_of_range = tile_cull_spheres_by_depth(t, v.distance, v.r, v.min_distance);
    const vmask out = spu_or(out_of_range, tile_cull_spheres_by_window(t, &v, &w));
    const unsigned culled = spux_mask_bits(spu_or(out, tile_cull_occluded_spheres(t, &v, &w)));
    tile_append_visible(f, q, prim, &w, first_lanes(count) & ~culled);
}

/* Coefficients of a vector of visible spheres, from number `first` on. */
CGT_SPU_INLINE void tile_init_spheres(const tile *t, const tile_visible_spheres *f, uint32_t first, tile_spheres *s)
{
    const unsigned lanes = first_lanes(f->count - first);
    vfloat q[4];
    tile_load_visible(f, first, q, s);
    const tile_projected_spheres v = tile_project_spheres(t, q);
    const unsigned single_lanes = tile_setup_spheres(t, &v, s);
    s->single_lanes = lanes & single_lanes;
    s->double_lanes = lanes & ~single_lanes;
    tile_classify_small_spheres(s);
    if (s->double_lanes)
        tile_setup_double_spheres(t, &v, s);
}

#endif
