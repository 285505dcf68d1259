/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles against a tile. A vector of triangles at a time is projected to camera space and culled; edges and planes
 * of the visible ones become linear forms of px and py (tile_triangle_draw.h).
 *
 * Let v_0, v_1, v_2 be the vertices in camera space (tile.h), e_k the edge opposite vertex k, starting at v_k+1, and
 * d = (1, rho px, upsilon py) the direction of a pixel in the same coordinates. The side of an edge and the plane are
 *   c_k.d   c_k = v_k+1 x e_k        1/t = n.d / det   n = e_1 x e_2, det = v_0.n
 * all linear in px and py; n may be made from any two edges. The ray hits the triangle in front of the eye where no
 * c_k.d has the sign opposite to that of det. This does not require any vertex to be in front of the eye. Camera space
 * is a linear map of the world's, so a lack of orthogonality of its axes does not matter.
 *
 * Error bounds. u = 2^-24, V is the largest |v_k|, T the least distance of the triangle from the eye, |d| the tile's
 * largest. A sum of products of three vectors' components is at most 1.16 times the product of their lengths:
 *   vertex     off by delta = 8 u V: u V from subtracting the eye, 4 u V in each coordinate
 *   direction  the canonical one is off by 3.5 u |d|
 *   inside     (necessary) A point P = t d of the exact triangle is a convex combination of its vertices, so it is
 *              within delta of a point of the moved (computed) triangle, for which no c_k.P has the sign opposite to
 *              that of det. So the moved c_k.d is at least -|c_k| delta / t >= -|c_k| |d| delta / T.
 *              (sufficient) If all moved c_k.d are above 1.03 times that, d is in the exact cone. Otherwise there were
 *              a plane through the eye with a normal m, m.d < 0 and all m.v_k >= 0. The moved plane's point Q of d,
 *              shifted by 1.03 delta against m, were still in the moved cone, with m.Q < -1.03 delta; but Q is a sum of
 *              moved vertices with m.v'_k >= -delta, whose factors sum to at most 1 + 1.03 delta / h. h is the distance
 *              from the eye to the plane, above 40 delta as required below
 *   edges      e 1, c_k 3, scale and rho 4, three fused or unfused sums 4: 12 roundings of 1.16 V |e_k| |d|
 *   together   |c_k| <= V |e_k|: u |e_k| |d| V (14 + 3.5 + 8.3 V / T); B = u |e_k| |d| V (18 + 9 V / T) is taken
 * Edges are divided by B, with the sign of det, and 1 is added: a value below 0 is a certain miss, three values above 2
 * are a certain hit of the cone.
 *   plane      n and det are divided by the lengths of n's two edges; kappa = V / |det|. The error of n is the same for
 *              any two edges, and so is that of v_0.n, since the exact v_k.n are all equal. The two shorter edges
 *              enclose the largest sine, so long thin triangles do not make kappa large. det is off by 11 u V,
 *              n.d / det by 12 u |d| t kappa / V <= 12 u kappa relative, by 3.5 u kappa for the direction, and by
 *              8 u |n| V / det = 8 u kappa for the moved vertices; plus divisions within 2^-21 and second order terms
 *   share      u (40 kappa + 32): the relative error of 1/t
 * kappa is at least 1. A triangle goes to tile_double.c if its share is above 1/8 or NaN, if an edge is shorter than
 * 2^-45, or if it may reach before the range's begin. Otherwise |det| is above 320 u V, and h >= |det| above 40 delta.
 * The depth that is stored is that of 1/t (1 + share), as -1/t or N / (1/t) (tile.h). If 2.2 shares exceed the tile's
 * depth error, no hit is certain: small windows are queued, larger ones go to tile_double.c.
 *
 * The window: for vertices not far to the side, V <= 64 z, X = x / z is off by 12 u |d| V / z, including 5 u |d|^2 for
 * the direction. 2^-19 |d| V / z is taken, and 1/16 of a column (tile_spheres.h).
 *
 * Culling by the tile's sides, wherever the eye's plane is: let m be the normal of a side plane, (-rho px, 1, 0) or its
 * like, |m| <= |d|. A ray of the tile has m.d >= 0 except for the error of its direction, and so has m.P for the point
 * P = t d that it hits, |P| <= V: at least -3.5 u V |d|. P is a convex combination of the vertices, so not all of them
 * are below that. m.v_k is off by 8 u |d| V for the vertex and by 5 u |d| V for its rounding, m included. 32 u |d| V is
 * taken.
 *
 * The range's begin: t is the z of the point P that is hit but for 3.5 u |d| t, or for 3 u V more of a parallel ray's
 * origin, |P| <= V; and z of vertices is off by 8 u V. 16 u V is taken.
 *
 * A test checks the bounds against wide arithmetic, and tightens them until it sees them break. */
#ifndef CGT_TILE_TRIANGLES_H
#define CGT_TILE_TRIANGLES_H

#include "kernel/primitive/gather_primitives.h"
#include "kernel/tile/tile_window.h"

#define TILE_EPS_SIDES (18 * FILTER_ROUNDOFF)
#define TILE_EPS_SIDES_NEAR (9 * FILTER_ROUNDOFF)
#define TILE_EPS_PLANE (40 * FILTER_ROUNDOFF)
#define TILE_EPS_PLANE_MIN (32 * FILTER_ROUNDOFF)
#define TILE_EPS_OUTSIDE (32 * FILTER_ROUNDOFF)
#define TILE_EPS_WINDOW (32 * FILTER_ROUNDOFF) /* 2^-19 */
#define TILE_LARGE_WINDOW 16u                  /* columns and rows together */

/* What the loops over pixels need of each triangle. A linear form is a constant and the factors of px and py. */
typedef struct tile_triangles {
    _Alignas(64) float side[3][3][CGT_LANES];
    _Alignas(64) float plane[3][CGT_LANES];     /* -1/t; t of parallel rays */
    _Alignas(64) float certain[CGT_LANES];      /* 2; infinite where no hit is certain */
    _Alignas(64) float min_distance[CGT_LANES]; /* nothing is hit before; counted as far_distance */
    tile_windows window;
    _Alignas(64) uint32_t prim[CGT_LANES];
    unsigned single_lanes, double_lanes; /* as bits: for tile_rasterise_triangle, for tile_double.c */
} tile_triangles;

/* Makes the depth error large enough for triangles up to distance c with kappa <= 25; for nearer ones it may be
 * more. */
CGT_SPU_INLINE void tile_widen_depth_error(tile *t, float c)
{
    const float depth_error = c * t->max_dir_length * 0x1p-13f;
    t->depth_error = t->depth_error > depth_error ? t->depth_error : depth_error;
    t->padded_depth_error = t->depth_error * (1 + 0x1p-20f);
}

/* ---- camera space and culling ---- */

/* A vector of triangles as the camera sees them: v[k] is z, x, y of vertex k. */
typedef struct tile_projected_triangles {
    vfloat v[3][3];
    vfloat max_length;                 /* V */
    vfloat min_z;                      /* at most the smallest z */
    vfloat min_distance;               /* nothing is hit before; counted as far_distance */
    vmask in_front;                    /* all vertices are in front of the eye, and not far to its side */
    vmask crosses_t_min, before_t_min; /* may reach before the range's begin; ends before it, or behind the eye */
} tile_projected_triangles;

CGT_SPU_INLINE vfloat tile_min3(vfloat a, vfloat b, vfloat c) { return spux_min(a, spux_min(b, c)); }
CGT_SPU_INLINE vfloat tile_max3(vfloat a, vfloat b, vfloat c) { return spux_max(a, spux_max(b, c)); }

CGT_SPU_INLINE tile_projected_triangles tile_project_triangles(const tile *t, vfloat vertex[3][3])
{
    const float(*dual)[3] = t->camera.dual;
    tile_projected_triangles s;
    vfloat square[3];
    for (int k = 0; k < 3; k++) {
        vfloat p[3];
        for (int a = 0; a < 3; a++)
            p[a] = spu_sub(vertex[k][a], spux_vfloat(t->rays->eye[a]));
        for (int a = 0; a < 3; a++)
            s.v[k][a] = spu_madd(p[0], spux_vfloat(dual[a][0]),
                                 spu_madd(p[1], spux_vfloat(dual[a][1]), spu_mul(p[2], spux_vfloat(dual[a][2]))));
        square[k] = lane_dot(s.v[k], s.v[k]);
    }
    s.max_length = spu_mul(spux_sqrt(tile_max3(square[0], square[1], square[2])), spux_vfloat(1 + 0x1p-18f));
    const vfloat lower_z = tile_min3(s.v[0][0], s.v[1][0], s.v[2][0]),
                 upper_z = tile_max3(s.v[0][0], s.v[1][0], s.v[2][0]);
    const vfloat length_error = spu_madd(s.max_length, spux_vfloat(TILE_EPS_WINDOW / 2), spux_vfloat(t->length_error));
    const vfloat near = spux_max(spu_sub(lower_z, length_error), spux_vfloat(0)), end = spu_add(upper_z, length_error);
    const float begin = t->rays->t_min;
    s.min_z = near;
    s.min_distance = spu_mul(near, spux_vfloat(tile_min_distance_scale(t)));
    s.in_front = spu_cmpgt(spu_mul(lower_z, spux_vfloat(64)), spu_add(s.max_length, spux_vfloat(0x1p-48f)));
    s.crosses_t_min = spux_mask_none();
    if (begin > 0)
        s.crosses_t_min = spux_not(spu_cmpgt(near, spux_vfloat(begin)));
    s.before_t_min = spu_cmpgt(spux_vfloat(begin), end);
    return s;
}

/* Windows of the triangles in front. Returns those of them that are outside the tile. */
CGT_SPU_INLINE vmask tile_cull_triangles_by_window(const tile *t, const tile_projected_triangles *v, tile_windows *w)
{
    const float column_span = t->column_span.scale, row_span = t->row_span.scale;
    const float share = TILE_EPS_WINDOW * t->max_dir_length;
    vfloat x[3], y[3], most_r = spux_vfloat(0);
    for (int k = 0; k < 3; k++) {
        const vfloat r = spux_div(spux_vfloat(1), v->v[k][0]);
        most_r = spux_max(most_r, r);
        x[k] = spu_mul(spu_mul(v->v[k][1], r), spux_vfloat(column_span));
        y[k] = spu_mul(spu_mul(v->v[k][2], r), spux_vfloat(row_span));
    }
    const vfloat slant = spu_mul(v->max_length, most_r);
    const vfloat x_error = spu_mul(slant, spux_vfloat(share * column_span));
    const vfloat y_error = spu_mul(slant, spux_vfloat(share * -row_span));
    const vfloat x0 = spux_vfloat(t->column_span.first), y0 = spux_vfloat(t->row_span.first);
    const vmask outside_x =
        tile_compute_window(spu_sub(spu_sub(tile_min3(x[0], x[1], x[2]), x_error), x0),
                            spu_sub(spu_add(tile_max3(x[0], x[1], x[2]), x_error), x0), &t->column_span, w->x0, w->x1);
    const vmask outside_y =
        tile_compute_window(spu_sub(spu_sub(tile_min3(y[0], y[1], y[2]), y_error), y0),
                            spu_sub(spu_add(tile_max3(y[0], y[1], y[2]), y_error), y0), &t->row_span, w->y0, w->y1);
    return spu_and(v->in_front, spu_or(outside_x, outside_y));
}

/* Triangles that are occluded in all parts under their window. large_windows: see tile_window_far_distance. */
CGT_SPU_INLINE vmask tile_cull_occluded_triangles(const tile *t, const tile_projected_triangles *v,
                                                  const tile_windows *w, vmask *large_windows)
{
    const vfloat far_distance = tile_window_far_distance(t, w, large_windows);
    return spu_andc(spu_and(v->in_front, spu_cmpgt(v->min_distance, far_distance)), *large_windows);
}

/* Triangles all of whose vertices lie beyond one side of the tile, wherever the eye's plane is. */
CGT_SPU_INLINE vmask tile_cull_triangles_by_sides(const tile *t, const tile_projected_triangles *v)
{
    const uint32_t last = TILE_EDGE - 1;
    const vfloat left = spux_vfloat(t->column[0] * t->camera.right);
    const vfloat right = spux_vfloat(t->column[last] * t->camera.right);
    const vfloat top = spux_vfloat(t->row[0] * t->camera.up), bottom = spux_vfloat(t->row[last] * t->camera.up);
    const vfloat length_error =
        spu_madd(v->max_length, spux_vfloat(t->max_dir_length * TILE_EPS_OUTSIDE), spux_vfloat(t->length_error));
    vfloat upper[4];
    for (int k = 0; k < 3; k++) {
        const vfloat *p = v->v[k];
        const vfloat inside[4] = {spu_nmsub(left, p[0], p[1]), spu_msub(right, p[0], p[1]), spu_msub(top, p[0], p[2]),
                                  spu_nmsub(bottom, p[0], p[2])};
        for (int i = 0; i < 4; i++)
            upper[i] = k ? spux_max(upper[i], inside[i]) : inside[i];
    }
    const vfloat lower = spux_min(spux_min(upper[0], upper[1]), spux_min(upper[2], upper[3]));
    return spu_cmpgt(spu_sub(spux_vfloat(0), length_error), lower);
}

/* ---- edges and planes ---- */

/* Stores v.d times k, plus `more`, as a linear form of px and py. */
CGT_SPU_INLINE void tile_store_form(const tile *t, const vfloat v[3], vfloat k, vfloat more, float form[3][CGT_LANES])
{
    spux_store(form[0], spu_madd(v[0], k, more));
    spux_store(form[1], spu_mul(v[1], spu_mul(k, spux_vfloat(t->camera.right))));
    spux_store(form[2], spu_mul(v[2], spu_mul(k, spux_vfloat(t->camera.up))));
}

/* Windows that are cheaper to test in double precision than to queue. */
CGT_SPU_INLINE vmask tile_large_windows(const tile_windows *w)
{
    const vuint width = spu_sub(spux_load_uint(w->x1), spux_load_uint(w->x0));
    const vuint height = spu_sub(spux_load_uint(w->y1), spux_load_uint(w->y0));
    return spu_cmpgt(spu_add(width, height), spux_vuint(TILE_LARGE_WINDOW));
}

/* The normal, divided by the lengths of the two shorter edges. e_1 x e_2 = e_2 x e_0 = e_0 x e_1. */
CGT_SPU_INLINE void tile_compute_normals(vfloat e[3][3], const vfloat square[3], const vfloat rlength[3], vfloat n[3])
{
    const vmask first = spu_andc(spu_cmpgt(square[1], square[0]), spu_cmpgt(square[2], square[1]));
    const vmask second = spu_andc(spu_cmpgt(square[2], square[0]), first);
    const vfloat sign = spux_select(spux_vfloat(0), spux_vfloat(-0.f), spu_or(first, second));
    const vfloat lengths =
        spu_mul(spux_select(rlength[1], rlength[0], first), spux_select(rlength[2], rlength[0], second));
    const vfloat normalise = spu_or(lengths, sign);
    vfloat a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = spux_select(e[1][k], e[0][k], first);
        b[k] = spux_select(e[2][k], e[0][k], second);
    }
    lane_cross(a, b, n);
    for (int k = 0; k < 3; k++)
        n[k] = spu_mul(n[k], normalise);
}

/* Stores linear forms and `certain`. Returns the lanes for which the bounds hold, as bits. */
CGT_SPU_INLINE unsigned tile_setup_triangles(const tile *t, const tile_projected_triangles *v, tile_triangles *s)
{
    const vfloat one = spux_vfloat(1), max_length = v->max_length;
    vfloat e[3][3], c[3], n[3], square[3], rlength[3];
    for (int k = 0; k < 3; k++) {
        for (int a = 0; a < 3; a++)
            e[k][a] = spu_sub(v->v[(k + 2) % 3][a], v->v[(k + 1) % 3][a]);
        square[k] = lane_dot(e[k], e[k]);
        rlength[k] = spu_mul(spu_rsqrte(square[k]), spux_vfloat(1 - 0x1p-9f)); /* at most the exact one */
    }
    /* plane: determinant, kappa and the relative error of 1/t */
    tile_compute_normals(e, square, rlength, n);
    const vfloat det = lane_dot(n, v->v[0]), size = spux_abs(det), rdet = spux_div(one, det);
    const vfloat kappa = spu_mul(max_length, spux_abs(rdet));
    const vfloat share = spu_madd(kappa, spux_vfloat(TILE_EPS_PLANE), spux_vfloat(TILE_EPS_PLANE_MIN));
    /* edges: divided by their bound, with the sign of the determinant */
    const vfloat near = spux_max(v->min_z, spu_mul(size, spux_vfloat(0.875f)));
    const vfloat error = spu_mul(max_length, spu_madd(spux_div(max_length, near), spux_vfloat(TILE_EPS_SIDES_NEAR),
                                                      spux_vfloat(TILE_EPS_SIDES)));
    const vfloat sign = spu_and(det, spux_vfloat(-0.f));
    const vfloat unit = spu_or(spux_div(spux_vfloat(1 / t->max_dir_length), error), sign);
    for (int k = 0; k < 3; k++) {
        lane_cross(v->v[(k + 1) % 3], e[k], c);
        tile_store_form(t, c, spu_mul(unit, rlength[k]), one, s->side[k]);
    }
    tile_store_form(t, n, spu_mul(rdet, spu_sub(spux_vfloat(-1), share)), spux_vfloat(0), s->plane);
    /* whether the error fits into the tile's depth error */
    const vfloat depth_share = spu_mul(share, spux_vfloat(2.2f));
    const vmask within_depth_error =
        t->linear ? spu_cmpgt(spux_vfloat((float)TILE_LINEAR_ERROR - 0x1p-20f), depth_share)
                  : spu_cmpgt(spux_vfloat(t->depth_error),
                              spu_mul(depth_share, spu_mul(max_length, spux_vfloat(t->max_dir_length))));
    spux_store(s->certain, spux_select(spux_vfloat(INFINITY), spux_vfloat(2), within_depth_error));
    spux_store(s->min_distance, v->min_distance);
    /* edges of 2^-45 and more: underflow is negligible */
    const vmask normal = spu_cmpgt(tile_min3(square[0], square[1], square[2]), spux_vfloat(0x1p-90f));
    const vmask valid = spu_andc(spu_and(normal, spu_cmpgt(spux_vfloat(0.125f), share)), v->crosses_t_min);
    return spux_mask_bits(spu_and(valid, spu_or(within_depth_error, spux_not(tile_large_windows(&s->window)))));
}

/* Triangles with all of the tile on the outer side of an edge, or whose plane is occluded everywhere. 2^-21 of the
 * magnitudes covers the six roundings here: |px| and |py| are at most 1. */
CGT_SPU_INLINE vmask tile_cull_triangles_by_forms(const tile *t, const tile_triangles *s)
{
    const float *column = t->column, *row = t->row;
    const uint32_t last = TILE_EDGE - 1;
    const vfloat x = spux_vfloat(0.5f * (column[0] + column[last])), y = spux_vfloat(0.5f * (row[0] + row[last]));
    const vfloat half_width = spux_vfloat(0.5f * fabsf(column[last] - column[0]) + 0x1p-22f);
    const vfloat half_height = spux_vfloat(0.5f * fabsf(row[last] - row[0]) + 0x1p-22f);
    vfloat upper[4];
    for (int k = 0; k < 4; k++) {
        const float(*form)[CGT_LANES] = k < 3 ? s->side[k] : s->plane;
        const vfloat constant = spux_load(form[0]), slope_x = spux_load(form[1]), slope_y = spux_load(form[2]);
        const vfloat middle = spu_madd(x, slope_x, spu_madd(y, slope_y, constant));
        const vfloat size = spu_add(spux_abs(constant), spu_add(spux_abs(slope_x), spux_abs(slope_y)));
        const vfloat extent =
            spu_madd(half_width, spux_abs(slope_x),
                     spu_madd(half_height, spux_abs(slope_y), spu_mul(size, spux_vfloat(TILE_EPS_WINDOW / 4))));
        upper[k] = k < 3 ? spu_add(middle, extent) : spu_sub(extent, middle);
    }
    const vmask outside = spu_cmpgt(spux_vfloat(-1), tile_min3(upper[0], upper[1], upper[2]));
    const vfloat far_t = spux_vfloat(t->max_far_t * (1 + 0x1p-16f));
    const vmask occluded = t->parallel ? spu_cmpgt(spu_sub(spux_vfloat(0), upper[3]), spux_vfloat(t->max_far_t))
                                       : spu_cmpgt(spux_vfloat(1), spu_mul(upper[3], far_t));
    return spu_or(outside, occluded);
}

/* Projects, culls and sets up a vector of triangles. active: the lanes in use, as bits. */
CGT_SPU_INLINE void tile_init_triangles(const tile *t, vfloat vertex[3][3], unsigned active, tile_triangles *s)
{
    const tile_projected_triangles v = tile_project_triangles(t, vertex);
    vmask large_windows;
    const vmask out_of_range = spu_or(v.before_t_min, spu_cmpgt(v.min_distance, spux_vfloat(t->max_far_distance)));
    const vmask out = spu_or(out_of_range, tile_cull_triangles_by_window(t, &v, &s->window));
    const unsigned in_front = spux_mask_bits(v.in_front);
    unsigned remaining = active &
                         ~spux_mask_bits(spu_or(out, tile_cull_occluded_triangles(t, &v, &s->window, &large_windows))) &
                         CGT_ALL_LANES;
    s->single_lanes = s->double_lanes = 0;
    if (remaining & ~in_front)
        remaining &= ~spux_mask_bits(tile_cull_triangles_by_sides(t, &v));
    if (!remaining)
        return;
    tile_set_full_windows(t, remaining & ~in_front, &s->window);
    const unsigned single_lanes = remaining & tile_setup_triangles(t, &v, s);
    s->double_lanes = remaining & ~single_lanes;
    s->single_lanes = single_lanes;
    if (single_lanes & (spux_mask_bits(large_windows) | ~in_front))
        s->single_lanes &= ~spux_mask_bits(tile_cull_triangles_by_forms(t, s));
}

#endif
