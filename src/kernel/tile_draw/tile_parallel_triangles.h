/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles against a tile of parallel rays. Let v_0, v_1, v_2 be the vertices in camera space (tile.h), as z, x, y,
 * w_k their x and y, e_k the edge opposite vertex k, starting at v_k+1, and p = (rho px, upsilon py) a pixel's point.
 * The side of an edge and the depth are
 *   c_k(p) = (w_k+1 - p) x e_k   of x and y alone: twice an area
 *   t = (n.v_0 - n_x p_x - n_y p_y) / n_z   n = e_1 x e_2
 * all linear in px and py. Camera space is a linear map of the world's that takes the rays' direction exactly to z. So
 * a lack of orthogonality of its axes does not matter, and t is z.
 *
 * Error bounds. u = 2^-24, V is the largest |v_k|, P the frame's largest |p|, S as in tile_parallel_spheres.h:
 *   vertex     off by delta = 8 u V: u V from subtracting the eye, 4 u V in each coordinate
 *   origin     the canonical one is off by o = u S
 *   inside     (necessary) A point of the exact triangle is a convex combination of its vertices, so it is within delta
 *              of a point of the moved (computed) triangle, and the table's p is within delta + o of that. So with the
 *              moved triangle's orientation no c_k(p) is below -|e_k| (delta + o).
 *              (sufficient) If all c_k(p) are above |e_k| (delta + o), the disc of that radius around p is in the moved
 *              triangle, and the canonical p is in the exact one. Otherwise a line would separate it from the exact
 *              vertices; moved by delta + o it would separate a point of the disc from the moved ones
 *   sides      w x e 4, e among them, scale and rho 3, sums 3: 10 roundings of (V + |p|) |e_k|
 *   together   B = u |e_k| (18 V + 10 P + S); 20 V + 12 P + 1.1 S is taken
 * Edges are divided by B, with the sign of n_z, and 1 is added: a value below 0 is a certain miss, three values above 2
 * are a certain hit.
 *   normal     divided by |e_1| |e_2| it is off by 8 u; kappa = |e_1| |e_2| / |n_z|, at least 1
 *   depth      at a point of the triangle |t| and |p| are at most V, except for the move: 8 u kappa (2 V + V) for
 *              the normal; n.v_0 3, scales 5, sums 8 roundings of kappa V; a common factor 8 u V; moved vertices and
 *              origin, by a slope of at most kappa, (1 + kappa) (delta + o)
 *   together   u kappa (64 V + 2 S); E = u kappa (72 V + 8 P + 2.2 S) is taken: the rest covers the
 *              rounding of tile_visible_triangle_parts
 * The depth that is stored is t - E. If 2.2 E exceeds the tile's depth error, no hit is certain: small windows are
 * queued, larger ones go to tile_double.c. Triangles with 40 u kappa above 1/8 or NaN go there, too: otherwise |n_z| is
 * above 320 u |e_1| |e_2| and its sign is right. So do those with an edge below 2^-45, seen along the rays, and those
 * that may reach before the range's begin.
 *
 * The window: vertices are off by delta + o, and rounded 4 times. 2^-19 V + 2 o is taken, and 1/16 of a column.
 *
 * A test checks the bounds against wide arithmetic, and tightens them until it sees them break. */
#ifndef CGT_TILE_PARALLEL_TRIANGLES_H
#define CGT_TILE_PARALLEL_TRIANGLES_H

#include "kernel/tile_draw/tile_parallel_spheres.h"
#include "kernel/tile_draw/tile_triangles.h"

#define TILE_EPS_PARALLEL_SIDES (20 * FILTER_ROUNDOFF)
#define TILE_EPS_PARALLEL_OFFSET (12 * FILTER_ROUNDOFF)
#define TILE_EPS_PARALLEL_ORIGIN (1.1f * FILTER_ROUNDOFF)
#define TILE_EPS_PARALLEL_DEPTH (72 * FILTER_ROUNDOFF)
#define TILE_EPS_PARALLEL_DEPTH_OFFSET (8 * FILTER_ROUNDOFF)
#define TILE_EPS_PARALLEL_DEPTH_ORIGIN (2.2f * FILTER_ROUNDOFF)

/* Makes the depth error large enough for triangles up to distance c. Without spheres it is that of linear tiles at half
 * that distance. */
CGT_SPU_INLINE void tile_widen_parallel_error(tile *t, float c, bool spheres)
{
    const float depth_error = spheres ? c * 0x1p-13f : c * 0x1p-10f;
    t->depth_error = t->depth_error > depth_error ? t->depth_error : depth_error;
    t->padded_depth_error = t->depth_error * (1 + 0x1p-20f);
}

/* As for perspective; windows hold for all lanes. */
CGT_SPU_INLINE tile_projected_triangles tile_project_parallel_triangles(const tile *t, vfloat vertex[3][3])
{
    tile_projected_triangles v = tile_project_triangles(t, vertex);
    v.in_front = spux_mask_all();
    v.crosses_t_min = spux_not(spu_cmpgt(v.min_z, spux_vfloat(t->rays->t_min)));
    return v;
}

/* Windows. Returns the lanes without one. */
CGT_SPU_INLINE vmask tile_cull_parallel_triangles(const tile *t, const tile_projected_triangles *v, tile_windows *w)
{
    const vfloat half = spux_vfloat(0.5f);
    const vfloat length_error = spu_madd(v->max_length, spux_vfloat(TILE_EPS_WINDOW), spux_vfloat(t->length_error));
    vfloat middle[2], half_width[2];
    for (int a = 0; a < 2; a++) {
        const vfloat lower = tile_min3(v->v[0][a + 1], v->v[1][a + 1], v->v[2][a + 1]);
        const vfloat upper = tile_max3(v->v[0][a + 1], v->v[1][a + 1], v->v[2][a + 1]);
        middle[a] = spu_mul(spu_add(lower, upper), half);
        half_width[a] = spu_madd(spu_sub(upper, lower), half, length_error);
    }
    return tile_compute_parallel_windows(t, middle[0], middle[1], half_width[0], half_width[1], w);
}

/* Edges, their squared lengths seen along the rays, and the normal over the lengths of two edges. */
typedef struct tile_parallel_edges {
    vfloat e[3][3], square[3], rlength[3], n[3];
} tile_parallel_edges;

CGT_SPU_INLINE vfloat tile_estimate_rlength(vfloat square) /* at most 1 over the length */
{
    return spu_mul(spu_rsqrte(square), spux_vfloat(1 - 0x1p-9f));
}

CGT_SPU_INLINE tile_parallel_edges tile_compute_parallel_edges(const tile_projected_triangles *v)
{
    tile_parallel_edges g;
    for (int k = 0; k < 3; k++) {
        for (int a = 0; a < 3; a++)
            g.e[k][a] = spu_sub(v->v[(k + 2) % 3][a], v->v[(k + 1) % 3][a]);
        g.square[k] = spu_madd(g.e[k][1], g.e[k][1], spu_mul(g.e[k][2], g.e[k][2]));
        g.rlength[k] = tile_estimate_rlength(g.square[k]);
    }
    lane_cross(g.e[1], g.e[2], g.n);
    for (int k = 1; k < 3; k++) {
        const vfloat r = tile_estimate_rlength(spu_madd(g.e[k][0], g.e[k][0], g.square[k]));
        for (int a = 0; a < 3; a++)
            g.n[a] = spu_mul(g.n[a], r);
    }
    return g;
}

CGT_SPU_INLINE void tile_store_parallel_sides(const tile *t, const tile_projected_triangles *v,
                                              const tile_parallel_edges *g, tile_triangles *s)
{
    const vfloat one = spux_vfloat(1), zero = spux_vfloat(0);
    const float rest = t->origin_offset * TILE_EPS_PARALLEL_OFFSET + t->origin_error * TILE_EPS_PARALLEL_ORIGIN;
    const vfloat error = spu_madd(v->max_length, spux_vfloat(TILE_EPS_PARALLEL_SIDES), spux_vfloat(rest));
    const vfloat unit = spu_or(spux_div(one, error), spu_and(g->n[0], spux_vfloat(-0.f)));
    for (int k = 0; k < 3; k++) {
        const vfloat *w = v->v[(k + 1) % 3], *e = g->e[k];
        const vfloat c[3] = {spu_sub(spu_mul(w[1], e[2]), spu_mul(w[2], e[1])), spu_sub(zero, e[2]), e[1]};
        tile_store_form(t, c, spu_mul(unit, g->rlength[k]), one, s->side[k]);
    }
}

/* Stores linear forms and `certain`. Returns the lanes for which the bounds hold, as bits. */
CGT_SPU_INLINE unsigned tile_setup_parallel_triangles(const tile *t, const tile_projected_triangles *v,
                                                      tile_triangles *s)
{
    const vfloat zero = spux_vfloat(0);
    const tile_parallel_edges g = tile_compute_parallel_edges(v);
    const vfloat rz = spux_div(spux_vfloat(1), g.n[0]), kappa = spux_abs(rz);
    const float rest =
        t->origin_offset * TILE_EPS_PARALLEL_DEPTH_OFFSET + t->origin_error * TILE_EPS_PARALLEL_DEPTH_ORIGIN;
    const vfloat error =
        spu_mul(kappa, spu_madd(v->max_length, spux_vfloat(TILE_EPS_PARALLEL_DEPTH), spux_vfloat(rest)));
    const vfloat plane[3] = {lane_dot(g.n, v->v[0]), spu_sub(zero, g.n[1]), spu_sub(zero, g.n[2])};
    tile_store_parallel_sides(t, v, &g, s);
    tile_store_form(t, plane, rz, spu_sub(zero, error), s->plane);
    const vmask within_depth_error = spu_cmpgt(spux_vfloat(t->depth_error), spu_mul(error, spux_vfloat(2.2f)));
    spux_store(s->certain, spux_select(spux_vfloat(INFINITY), spux_vfloat(2), within_depth_error));
    spux_store(s->min_distance, v->min_distance);
    /* edges of 2^-45 and more: underflow is negligible */
    const vmask normal = spu_cmpgt(tile_min3(g.square[0], g.square[1], g.square[2]), spux_vfloat(0x1p-90f));
    const vmask level = spu_cmpgt(spux_vfloat(0.125f), spu_mul(kappa, spux_vfloat(TILE_EPS_PLANE)));
    const vmask valid = spu_andc(spu_and(normal, level), v->crosses_t_min);
    return spux_mask_bits(spu_and(valid, spu_or(within_depth_error, spux_not(tile_large_windows(&s->window)))));
}

/* tile_init_triangles for parallel rays. */
CGT_SPU_INLINE void tile_init_parallel_triangles(const tile *t, vfloat vertex[3][3], unsigned active, tile_triangles *s)
{
    const tile_projected_triangles v = tile_project_parallel_triangles(t, vertex);
    vmask large_windows;
    const vmask out_of_range = spu_or(v.before_t_min, spu_cmpgt(v.min_distance, spux_vfloat(t->max_far_distance)));
    const vmask out = spu_or(out_of_range, tile_cull_parallel_triangles(t, &v, &s->window));
    const unsigned remaining =
        active & ~spux_mask_bits(spu_or(out, tile_cull_occluded_triangles(t, &v, &s->window, &large_windows))) &
        CGT_ALL_LANES;
    s->single_lanes = s->double_lanes = 0;
    if (!remaining)
        return;
    s->single_lanes = remaining & tile_setup_parallel_triangles(t, &v, s);
    s->double_lanes = remaining & ~s->single_lanes;
    if (s->single_lanes & spux_mask_bits(large_windows))
        s->single_lanes &= ~spux_mask_bits(tile_cull_triangles_by_forms(t, s));
}

#endif
