/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frustum of a packet in grid space, as packet/frustum.h derives it, in vectors: lanes are rays until their
 * least values are found, then the four bounds. Steps that packet/frustum.h rounds one by one are fused here,
 * which makes their errors no larger. */
#ifndef GRID_FRUSTUM_H
#define GRID_FRUSTUM_H

#include "cell/programs/grid/grid_store.h"

CGT_SPU_INLINE vec_float4 grid_negative(vec_float4 a) { return (vec_float4)spu_xor((vec_uint4)a, 0x80000000u); }

/* Least of all lanes, in all lanes. */
CGT_SPU_INLINE vec_float4 grid_least(vec_float4 a)
{
    const vec_float4 two = spux_min(a, spu_rlqwbyte(a, 8));
    return spux_min(two, spu_rlqwbyte(two, 4));
}
CGT_SPU_INLINE vec_float4 grid_greatest(vec_float4 a)
{
    const vec_float4 two = spux_max(a, spu_rlqwbyte(a, 8));
    return spux_max(two, spu_rlqwbyte(two, 4));
}

/* Least lane of each of four vectors, side by side. */
CGT_SPU_INLINE vec_float4 grid_least_four(const vec_float4 v[4])
{
    vec_float4 t[4];
    GRID_TRANSPOSE(v[0], v[1], v[2], v[3], t);
    return spux_min(spux_min(t[0], t[1]), spux_min(t[2], t[3]));
}

/* ---- a class, once a frame ---- */

static vec_float4 grid_pairs(vec_float4 u, vec_float4 v)
{
    const vec_uchar16 pairs = {GRID_WORD(0), GRID_WORD(1), GRID_WORD(6), GRID_WORD(7)};
    return spu_shuffle(u, v, pairs);
}

/* The camera's share: planes w0 and w1, seen from the eye. */
static void grid_axes_see(grid_axes *x)
{
    const cgt_camera_image *const c = &s()->camera;
    const vec_float4 zero = spu_splats(0.f), small = spu_splats(0x1p-20f);
    const uint32_t axis[3] = {x->u, x->v, x->w};
    for (int k = 0; k < 3; k++)
        x->eye[k] = spu_mul(spu_sub(spu_splats(c->eye[axis[k]]), x->org[k]), x->rcell[k]);
    x->eye[2] = spu_add(x->eye[2], x->w_offset);
    const vec_float4 w = x->eye[2], end = spu_splats((float)x->slices);
    const vec_float4 near = spu_sub(spu_nmsub(spux_abs(w), small, w), x->w_error);
    const vec_uint4 behind = spu_cmpgt(zero, spu_splats(c->t_min)); /* rays that start behind the eye */
    const vec_uint4 even = {0xffffffffu, 0, 0xffffffffu, 0};
    const vec_float4 four = grid_pairs(x->eye[0], x->eye[1]);
    x->w_near = spu_sel(near, spu_splats(GRID_CLOSED), behind);
    const vec_float4 first = spux_min(spux_max(x->w_near, zero), end);
    x->first = (uint32_t)spu_extract(spu_convts(first, 0), 0);
    x->w0 = spu_splats((float)x->first);
    x->along[0] = spu_sub(x->w0, w);
    x->along[1] = spu_sub(end, w);
    x->rlength = spux_div(spu_splats(1.f), spu_sub(end, x->w0));
    x->eye_four = spu_sel(grid_negative(four), four, even);
    x->w_reach = spu_add(spux_abs(w), end);
}

static void grid_axes_init(uint32_t class, grid_axes *x)
{
    const cgt_grid_image *const g = &s()->scene;
    const uint32_t w = class >> 1, u = w == 0 ? 1 : 0, v = w == 2 ? 1 : 2, axis[3] = {u, v, w};
    const bool reverse = class & 1;
    const uint32_t stride[3] = {1, g->resolution[0], g->resolution[0] * g->resolution[1]};
    static const uint8_t order[3][16] = {{GRID_WORD(1), GRID_WORD(2), GRID_WORD(0), GRID_WORD(3)},
                                         {GRID_WORD(0), GRID_WORD(2), GRID_WORD(1), GRID_WORD(3)},
                                         {GRID_WORD(0), GRID_WORD(1), GRID_WORD(2), GRID_WORD(3)}};
    /* of the reach of a unit of radius: a slope 5 roundings, so 1 + slope^2 12, its root 6 + 4, two products 2 */
    const vec_float4 one = spu_splats(1 + 16 * GRID_ROUNDOFF);
    x->u = u, x->v = v, x->w = w;
    x->slices = g->resolution[w];
    for (int k = 0; k < 16; k++)
        x->order = spu_insert(order[w][k], x->order, k);
    for (int k = 0; k < 3; k++) {
        x->org[k] = spu_splats(g->org[axis[k]]);
        x->rcell[k] = spu_splats(g->rcell[axis[k]]);
    }
    x->w_rcell = x->rcell[2];
    x->w_sign = spu_splats(reverse ? 0x80000000u : 0u);
    x->w_offset = spu_splats(reverse ? (float)x->slices : 0.f);
    x->rcell[2] = reverse ? grid_negative(x->rcell[2]) : x->rcell[2];
    x->ratio[0] = spux_div(x->rcell[0], x->w_rcell);
    x->ratio[1] = spux_div(x->rcell[1], x->w_rcell);
    x->error_four = grid_pairs(spu_splats(g->cell_error[u]), spu_splats(g->cell_error[v]));
    x->w_error = spu_splats(g->cell_error[w]);
    x->rcell_four = grid_pairs(x->rcell[0], x->rcell[1]);
    x->slope_four = spux_div(x->w_rcell, x->rcell_four);
    x->rcell_four = spu_mul(x->rcell_four, one);
    x->w_unit = spu_mul(x->w_rcell, one);
    for (int k = 0; k < 2; k++) {
        x->last[k] = spu_splats((float)(g->resolution[axis[k]] - 1));
        x->stride[k] = spu_splats((int32_t)stride[axis[k]]);
    }
    const vec_uint4 even = {0xffffffffu, 0, 0xffffffffu, 0};
    const vec_float4 cells = grid_pairs(spu_add(x->last[0], one), spu_add(x->last[1], one));
    x->limit_four = (vec_float4)spu_and((vec_uint4)cells, even);
    x->first_cell = spu_splats(reverse ? (int32_t)((x->slices - 1) * stride[w]) : 0);
    x->w_step = spu_splats(reverse ? -(int32_t)stride[w] : (int32_t)stride[w]);
    grid_axes_see(x);
}

/* ---- a packet ---- */

/* From the four least values at w0 and w1, and the largest numbers met on the way: u, u, v, v. Returns false where the
 * packet passes outside the grid. */
CGT_SPU_INLINE bool grid_frustum_finish(const grid_axes *x, vec_float4 at0, vec_float4 at1, vec_float4 magnitude,
                                        vec_float4 w1, vec_float4 rlength, grid_frustum *f)
{
    const vec_float4 one = spu_splats(1.f), roundoff = spu_splats(16 * GRID_ROUNDOFF);
    /* 13 roundings to a line's value at a plane, quotients having 4; 3 more on the way to a slice */
    const vec_float4 error = spu_madd(magnitude, roundoff, x->error_four);
    const vec_float4 bound = spu_sub(at0, error), end = spu_sub(at1, error);
    const vec_float4 step = spu_mul(spu_sub(end, bound), rlength), slope = spu_mul(step, x->slope_four);
    const vec_float4 reach = spu_mul(spux_sqrt(spu_madd(slope, slope, one)), x->rcell_four);
    const vec_float4 sum = spu_add(magnitude, spu_rlqwbyte(magnitude, 8));
    const vec_float4 steepest = spu_add(grid_greatest(spux_abs(step)), one);
    f->error = spu_mul(spu_madd(steepest, spu_add(w1, one), sum), spu_splats(32 * GRID_ROUNDOFF));
    for (int k = 0; k < 4; k++) {
        f->bound[k] = GRID_LANE(bound, k);
        f->step[k] = GRID_LANE(step, k);
        f->reach[k] = GRID_LANE(reach, k);
        f->inside[k] = spu_sub(f->bound[k], f->error);
    }
    f->w_reach = x->w_unit;
    const vec_uint4 outside = spu_and(spu_cmpgt(bound, x->limit_four), spu_cmpgt(end, x->limit_four));
    return GRID_MOSTLY(spu_extract(spu_gather(outside), 0) == 0);
}

/* Slopes of a vector of rays, cells of u and v per cell of w. */
CGT_SPU_INLINE void grid_slopes(const grid_axes *x, const grid_packet *p, int i, vec_float4 slope[2])
{
    const vec_float4 rdw = spux_div(spu_splats(1.f), (vec_float4)spu_xor((vec_uint4)p->dir[x->w][i], x->w_sign));
    slope[0] = spu_mul(spu_mul(p->dir[x->u][i], x->ratio[0]), rdw);
    slope[1] = spu_mul(spu_mul(p->dir[x->v][i], x->ratio[1]), rdw);
}

/* A camera's rays: from a common origin the least and the greatest slope are enough; before the eye they change
 * places. Returns false where they miss the grid. */
CGT_SPU_INLINE bool grid_frustum_of_camera(const grid_axes *x, const grid_packet *p, grid_frustum *f)
{
    const vec_uchar16 partner = {GRID_WORD(1), GRID_WORD(0), GRID_WORD(3), GRID_WORD(2)};
    vec_float4 slope[4][2], least[4];
    for (int i = 0; i < 4; i++)
        grid_slopes(x, p, i, slope[i]);
    for (int k = 0; k < 2; k++) {
        least[2 * k] = spux_min(spux_min(slope[0][k], slope[1][k]), spux_min(slope[2][k], slope[3][k]));
        least[2 * k + 1] =
            grid_negative(spux_max(spux_max(slope[0][k], slope[1][k]), spux_max(slope[2][k], slope[3][k])));
    }
    const vec_float4 low = grid_least_four(least), high = grid_negative(spu_shuffle(low, low, partner));
    const vec_float4 at0 = spux_min(spu_madd(x->along[0], low, x->eye_four), spu_madd(x->along[0], high, x->eye_four));
    const vec_float4 at1 = spux_min(spu_madd(x->along[1], low, x->eye_four), spu_madd(x->along[1], high, x->eye_four));
    const vec_float4 steepest = spux_max(spux_abs(low), spux_abs(high));
    f->first = x->first;
    f->end = x->slices;
    f->w0 = x->w0;
    f->w_near = x->w_near;
    return grid_frustum_finish(x, at0, at1, spu_madd(x->w_reach, steepest, spux_abs(x->eye_four)),
                               spu_splats((float)x->slices), x->rlength, f);
}

/* w beyond which a hit counts for no ray. */
CGT_SPU_INLINE vec_float4 grid_max_w(const grid_axes *x, const grid_packet *p, bool camera)
{
    const vec_float4 small = spu_splats(0x1p-20f);
    vec_float4 end[4];
    for (int i = 0; i < 4; i++) {
        const vec_float4 o =
            camera ? x->eye[2] : spu_madd(spu_sub(p->org[x->w][i], x->org[2]), x->rcell[2], x->w_offset);
        const vec_float4 w = spu_madd(p->high[i], spu_mul(p->dir[x->w][i], x->rcell[2]), o);
        end[i] = spu_madd(spu_add(spux_abs(o), spux_abs(w)), small, w);
    }
    return spu_add(grid_greatest(spux_max(spux_max(end[0], end[1]), spux_max(end[2], end[3]))), x->w_error);
}

/* Rays that start anywhere, their t from 0 up to p->high, those that are closed from where others start: the lines'
 * least values at two planes. Returns false where they miss the grid. */
CGT_SPU_INLINE bool grid_frustum_of_lines(const grid_axes *x, const grid_packet *p, grid_frustum *f)
{
    const vec_float4 zero = spu_splats(0.f), small = spu_splats(0x1p-20f), cells = spu_splats((float)x->slices);
    vec_float4 slope[4][2], o[3][4], near[4], least[4];
    for (int i = 0; i < 4; i++) {
        o[0][i] = spu_mul(spu_sub(p->org[x->u][i], x->org[0]), x->rcell[0]);
        o[1][i] = spu_mul(spu_sub(p->org[x->v][i], x->org[1]), x->rcell[1]);
        o[2][i] = spu_madd(spu_sub(p->org[x->w][i], x->org[2]), x->rcell[2], x->w_offset);
        near[i] = spu_nmsub(spux_abs(o[2][i]), small, o[2][i]);
        grid_slopes(x, p, i, slope[i]);
    }
    f->w_near = spu_sub(grid_least(spux_min(spux_min(near[0], near[1]), spux_min(near[2], near[3]))), x->w_error);
    f->w_far = grid_max_w(x, p, false);
    if (spu_extract(spu_or(spu_cmpgt(zero, f->w_far), spu_cmpgt(f->w_near, cells)), 0))
        return false;
    const vec_int4 end = spu_convts(spux_min(f->w_far, spu_sub(cells, spu_splats(1.f))), 0);
    const vec_int4 first = spu_convts(spux_min(spux_max(f->w_near, zero), cells), 0);
    f->first = (uint32_t)spu_extract(first, 0);
    f->end = (uint32_t)spu_extract(end, 0) + 1;
    if (f->first >= f->end)
        return false;
    f->w0 = spu_convtf(first, 0);
    const vec_float4 w1 = spu_splats((float)f->end), plane[2] = {f->w0, w1};
    vec_float4 at[2], reach[2] = {zero, zero};
    for (int m = 0; m < 2; m++) {
        for (int k = 0; k < 2; k++) {
            vec_float4 most = spu_splats(-GRID_MOST);
            least[2 * k] = spu_splats(GRID_MOST);
            for (int i = 0; i < 4; i++) {
                const vec_float4 value = spu_madd(spu_sub(plane[m], o[2][i]), slope[i][k], o[k][i]);
                least[2 * k] = spux_min(least[2 * k], value);
                most = spux_max(most, value);
            }
            least[2 * k + 1] = grid_negative(most);
        }
        at[m] = grid_least_four(least);
    }
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++)
            reach[k] =
                spux_max(reach[k], spu_madd(spu_add(spux_abs(o[2][i]), w1), spux_abs(slope[i][k]), spux_abs(o[k][i])));
    const vec_float4 magnitude = grid_pairs(grid_greatest(reach[0]), grid_greatest(reach[1]));
    return grid_frustum_finish(x, at[0], at[1], magnitude, w1, spux_div(spu_splats(1.f), spu_sub(w1, f->w0)), f);
}

#endif
