/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frustum of a packet in grid space (Wald et al. 2006, section 3).
 *
 * All rays of the packet run along the same main axis w, in the same direction; u and v are the other two axes. Seen
 * as functions of w the rays are straight lines u(w), v(w). The greatest of several lines at a w between w0 and w1 is
 * at most what the straight line through their greatest values at w0 and at w1 gives there (it is convex): four such
 * lines bound the packet between the two planes, whether its rays share an origin, a direction, or nothing. Each is
 * kept as a lower bound (of u, -u, v, -v), so that one vector of four holds the frustum: as a line over w it gives the
 * cells of a slice, as a plane it culls spheres.
 *
 * Errors, in roundings of SPUX_ROUNDOFF, which is 2^-24, and 2^-23 where results are truncated; E is what they are
 * relative to. Quotients and roots lose 2 there, or 4 by the words of an SPU, at most 2^-21.
 *   FRUSTUM_W      of w's ends: two of t dw, one of the sum, all of E = |o| + |end|; and cell_error, of o
 *   FRUSTUM_LINE   of a line at a plane: the slope 1 (cells) + 4 (ratio) + 4 (1 / dw) + 1, its product with a
 *   difference
 *                  of planes 2, the sum 1: 13; on the way to a slice, where the steps' differences cancel, 3 of the
 *                  line's value at either end. E = |o| + (|ow| + w1) |slope|, which is larger than all of them
 *   FRUSTUM_PLANE  of a centre's distance to a plane: its line 16, as above, and coordinates, a product and two sums
 *   FRUSTUM_RADIUS of the cells that a unit of radius reaches: k 1 + 4, so 1 + k^2 12, its root 6 + 4, two products 2
 *   */
#ifndef CGT_FRUSTUM_H
#define CGT_FRUSTUM_H

#include "kernel/packet/packet.h"
#include "papers/kernel/paper_tunables.h"
#include "papers/kernel/spu_programs.h"

#define FRUSTUM_W (FRUSTUM_ERROR_SCALE * 0x1p-20f)
#define FRUSTUM_LINE (FRUSTUM_ERROR_SCALE * 16 * SPUX_ROUNDOFF)
#define FRUSTUM_PLANE (FRUSTUM_ERROR_SCALE * 32 * SPUX_ROUNDOFF)
#define FRUSTUM_RADIUS (FRUSTUM_ERROR_SCALE * 16 * SPUX_ROUNDOFF)

/* The space of a frustum: a box in world coordinates, divided along each axis. Point p has coordinates
 * (p - org) * rcell, in real arithmetic on these floats. Single precision computes them within `cell_error`, for any
 * point of any primitive. */
typedef struct frustum_space {
    float org[3], rcell[3], cell_error[3];
    uint32_t resolution[3];
} frustum_space;

typedef struct frustum {
    int w, u, v;           /* axes */
    bool reverse;          /* the rays run towards lower coordinates; slices are counted along the rays */
    float last[3];         /* resolution - 1 of w, u, v */
    vec_float4 bound;      /* least u, -u, v, -v at w0, widened by all rounding */
    vec_float4 step;       /* their change from slice to slice */
    float w0;              /* plane of the first slice */
    uint32_t first, end;   /* slices */
    float w_near;          /* no ray starts before */
    float plane_error;     /* cells: of the distance from a sphere's centre to a plane */
    float radius_scale[4]; /* cells that a unit of radius reaches beyond each plane */
} frustum;

/* Coordinates of grid space along the rays; reverse turns them around. */
CGT_SPU_INLINE float grid_coordinate(const frustum_space *g, int axis, bool reverse, float p)
{
    const float c = (p - g->org[axis]) * g->rcell[axis];
    return reverse ? (float)g->resolution[axis] - c : c;
}
CGT_SPU_INLINE vfloat grid_coordinates(const frustum_space *g, int axis, bool reverse, vfloat p)
{
    const vfloat c = spu_mul(spu_sub(p, spux_vfloat(g->org[axis])), spux_vfloat(g->rcell[axis]));
    return reverse ? spu_sub(spux_vfloat((float)g->resolution[axis]), c) : c;
}

/* Least and greatest u (or v) of all rays at the planes w0 and w1, and the largest number met on the way. */
typedef struct frustum_span {
    float low[2], high[2], magnitude;
} frustum_span;

/* Slope of ray i: cells of an axis per cell of w. */
CGT_SPU_INLINE vfloat frustum_slope(const packet *p, uint32_t i, int axis, vfloat ratio, vfloat rdw)
{
    return spu_mul(spu_mul(spux_load(p->dir[axis] + i), ratio), rdw);
}
CGT_SPU_INLINE vfloat frustum_rdw(const frustum *f, const packet *p, uint32_t i)
{
    return spux_div(spux_vfloat(1), spux_abs(spux_load(p->dir[f->w] + i)));
}

/* From a common origin u(w) grows with the slope beyond the origin's w and falls before it: the least and the greatest
 * slope are enough. */
CGT_SPU_INLINE frustum_span frustum_span_of_slopes(float low, float high, float o, float ow, float w0, float w1)
{
    const float plane[2] = {w0 - ow, w1 - ow};
    const float steepest = -low > high ? -low : high;
    frustum_span s;
    for (int k = 0; k < 2; k++) {
        const float a = o + plane[k] * low, b = o + plane[k] * high;
        s.low[k] = a < b ? a : b;
        s.high[k] = a < b ? b : a;
    }
    s.magnitude = __builtin_fabsf(o) + (__builtin_fabsf(ow) + w1) * steepest;
    return s;
}

CGT_SPU_INLINE void frustum_bound_common(const frustum_space *g, const frustum *f, const packet *p, float w1,
                                         frustum_span span[2])
{
    const int axis[2] = {f->u, f->v};
    vfloat low[2], high[2], ratio[2];
    for (int k = 0; k < 2; k++) {
        low[k] = spux_vfloat(INFINITY);
        high[k] = spux_vfloat(-INFINITY);
        ratio[k] = spux_vfloat(SCALAR_DIVIDE(g->rcell[axis[k]], g->rcell[f->w]));
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat rdw = frustum_rdw(f, p, i);
        for (int k = 0; k < 2; k++) {
            const vfloat slope = frustum_slope(p, i, axis[k], ratio[k], rdw);
            low[k] = spux_min(low[k], slope);
            high[k] = spux_max(high[k], slope);
        }
    }
    const float ow = grid_coordinate(g, f->w, f->reverse, p->org[f->w][0]);
    for (int k = 0; k < 2; k++)
        span[k] = frustum_span_of_slopes(spux_hmin(low[k]), spux_hmax(high[k]),
                                         grid_coordinate(g, axis[k], false, p->org[axis[k]][0]), ow, f->w0, w1);
}

CGT_SPU_INLINE frustum_span frustum_bound_axis(const frustum_space *g, const frustum *f, const packet *p, int axis,
                                               float w1)
{
    vfloat low[2], high[2], magnitude = spux_vfloat(0);
    const vfloat plane[2] = {spux_vfloat(f->w0), spux_vfloat(w1)},
                 ratio = spux_vfloat(SCALAR_DIVIDE(g->rcell[axis], g->rcell[f->w]));
    for (int k = 0; k < 2; k++) {
        low[k] = spux_vfloat(INFINITY);
        high[k] = spux_vfloat(-INFINITY);
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat o = grid_coordinates(g, axis, false, spux_load(p->org[axis] + i));
        const vfloat ow = grid_coordinates(g, f->w, f->reverse, spux_load(p->org[f->w] + i));
        const vfloat slope = frustum_slope(p, i, axis, ratio, frustum_rdw(f, p, i));
        const vfloat reach = spu_mul(spu_add(spux_abs(ow), plane[1]), spux_abs(slope));
        magnitude = spux_max(magnitude, spu_add(spux_abs(o), reach));
        for (int k = 0; k < 2; k++) {
            const vfloat x = spu_madd(spu_sub(plane[k], ow), slope, o);
            low[k] = spux_min(low[k], x);
            high[k] = spux_max(high[k], x);
        }
    }
    return (frustum_span){
        {spux_hmin(low[0]), spux_hmin(low[1])}, {spux_hmax(high[0]), spux_hmax(high[1])}, spux_hmax(magnitude)};
}

/* The coordinate w at which the first ray starts. */
CGT_SPU_INLINE float frustum_min_w(const frustum_space *g, const frustum *f, const packet *p)
{
    vfloat least = spux_vfloat(INFINITY);
    if (p->from_origin) {
        const float o = grid_coordinate(g, f->w, f->reverse, p->org[f->w][0]);
        return o - __builtin_fabsf(o) * FRUSTUM_W;
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat o = grid_coordinates(g, f->w, f->reverse, spux_load(p->org[f->w] + i));
        const vfloat dw = spu_mul(spux_abs(spux_load(p->dir[f->w] + i)), spux_vfloat(g->rcell[f->w]));
        const vfloat start = spu_madd(spux_load(p->t_min + i), dw, o);
        const vfloat rounding =
            spu_mul(spux_abs(o), spux_vfloat(FRUSTUM_W)); /* rounding of o, and of the sum where t_min > 0 */
        least = spux_min(spu_sub(start, spu_add(rounding, spu_mul(spux_abs(start), spux_vfloat(FRUSTUM_W)))), least);
    }
    return spux_hmin(least);
}

/* Returns the coordinate w beyond which a hit counts for no ray; -inf where all are done. */
CGT_SPU_INLINE float frustum_max_w(const frustum_space *g, const frustum *f, const packet *p)
{
    vfloat most = spux_vfloat(-INFINITY);
    const vfloat rcell = spux_vfloat(g->rcell[f->w]);
    vfloat o = grid_coordinates(g, f->w, f->reverse, spux_vfloat(p->org[f->w][0]));
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        if (!p->common_origin)
            o = grid_coordinates(g, f->w, f->reverse, spux_load(p->org[f->w] + i));
        const vfloat dw = spu_mul(spux_abs(spux_load(p->dir[f->w] + i)), rcell);
        const vfloat end = spu_madd(spux_load(p->high + i), dw, o);
        const vfloat rounding = spu_mul(spu_add(spux_abs(o), spux_abs(end)), spux_vfloat(FRUSTUM_W));
        /* a closed ray's end is -inf and its width +inf: their sum is not a number, and max keeps `most` */
        most = spux_max(spu_add(end, rounding), most);
    }
    return spux_hmax(most) + g->cell_error[f->w];
}

/* The same for rays that start at a common origin, from the farthest end of any, in cells from there. */
CGT_SPU_INLINE float frustum_max_w_from_origin(const frustum_space *g, const frustum *f, const packet *p, float reach)
{
    const float o = grid_coordinate(g, f->w, f->reverse, p->org[f->w][0]), end = o + reach;
    return reach == -INFINITY ? reach
                              : end + (__builtin_fabsf(o) + __builtin_fabsf(end)) * FRUSTUM_W + g->cell_error[f->w];
}

/* A line of bounds as a plane in world space: how far, in cells of `axis`, a sphere of radius 1 reaches over it. */
CGT_SPU_INLINE float frustum_radius_scale(const frustum_space *g, const frustum *f, int axis, float step)
{
    const float k = SCALAR_DIVIDE(step * g->rcell[f->w], g->rcell[axis]);
    return g->rcell[axis] * SCALAR_SQRT(1 + k * k) * (1 + FRUSTUM_RADIUS);
}

/* Drops slices at both ends in which the frustum passes outside the grid: the lower bound of k, a line over w, must not
 * be above its limit. One slice more at each end covers the rounding. */
CGT_SPU_INLINE void frustum_clip(frustum *f)
{
    const float limit[4] = {f->last[1] + 1, 0, f->last[2] + 1, 0};
    float from = 0, to = (float)f->end;
    for (int k = 0; k < 4; k++) {
        const float margin = limit[k] - f->bound[k], w = f->w0 + SCALAR_DIVIDE(margin, f->step[k]);
        if (f->step[k] > 0 && w < to)
            to = w;
        if (f->step[k] < 0 && w > from)
            from = w;
        if (!(f->step[k] > 0) && !(f->step[k] < 0) && margin < 0)
            to = -1;
    }
    const float end = to + 2, first = from - 2;
    if (!(end > 0))
        f->end = 0;
    else if (end < (float)f->end)
        f->end = (uint32_t)end;
    if (first > (float)f->first)
        f->first = first < (float)f->end ? (uint32_t)first : f->end;
}

/* Returns false where the packet does not meet the grid. */
CGT_SPU_INLINE bool frustum_init(const frustum_space *g, const packet *p, int w, bool reverse, frustum *f)
{
    f->w = w;
    f->u = w == 0 ? 1 : 0; /* x fastest: cells of a row lie side by side where they can */
    f->v = w == 2 ? 1 : 2;
    f->reverse = reverse;
    const int axis[3] = {f->w, f->u, f->v};
    for (int a = 0; a < 3; a++)
        f->last[a] = (float)(g->resolution[axis[a]] - 1);
    f->end = g->resolution[w];
    f->w_near = frustum_min_w(g, f, p) - g->cell_error[w];
    if (!(f->w_near < (float)f->end))
        return false;
    /* rays that end within the grid spread no further: those to a light have crossed there */
    const float w_far = p->from_origin ? INFINITY : frustum_max_w(g, f, p);
    if (!(w_far >= 0))
        return false;
    if (w_far < (float)f->end)
        f->end = (uint32_t)w_far + 1;
    f->first = f->w_near > 0 ? (uint32_t)f->w_near : 0;
    if (f->first >= f->end)
        return false;
    f->w0 = (float)f->first;
    const float w1 = (float)f->end, rlength = SCALAR_DIVIDE(1, w1 - f->w0);
    frustum_span span[2];
    if (p->common_origin)
        frustum_bound_common(g, f, p, w1, span);
    else {
        span[0] = frustum_bound_axis(g, f, p, f->u, w1);
        span[1] = frustum_bound_axis(g, f, p, f->v, w1);
    }
    const frustum_span u = span[0], v = span[1];
    const float error_u = u.magnitude * FRUSTUM_LINE + g->cell_error[f->u],
                error_v = v.magnitude * FRUSTUM_LINE + g->cell_error[f->v];
    f->bound = (vec_float4){u.low[0] - error_u, -u.high[0] - error_u, v.low[0] - error_v, -v.high[0] - error_v};
    const vec_float4 at_end = {u.low[1] - error_u, -u.high[1] - error_u, v.low[1] - error_v, -v.high[1] - error_v};
    f->step = spu_mul(spu_sub(at_end, f->bound), spu_splats(rlength));
    float steepest = 0;
    for (int k = 0; k < 4; k++) {
        const float step = spu_extract(f->step, k);
        f->radius_scale[k] = frustum_radius_scale(g, f, k < 2 ? f->u : f->v, step);
        steepest = step > steepest ? step : -step > steepest ? -step : steepest;
    }
    f->plane_error = (u.magnitude + v.magnitude + (steepest + 1) * (w1 + 1)) * FRUSTUM_PLANE;
    frustum_clip(f);
    return f->first < f->end;
}

/* The cells between the lower bounds of u, -u, v, -v at two planes, or the lower of them where the bounds are lines
 * between: low and high of u, low and high of v; none where low > high. most: those of the axes, see
 * frustum_max_cells. */
CGT_SPU_INLINE vec_int4 frustum_cells(vec_float4 near, vec_float4 far, vec_float4 most)
{
    const vec_float4 sign = {1, -1, 1, -1};
    const vec_float4 least = {0, -1, 0, -1};
    vec_float4 b = spu_mul(spu_sel(near, far, spu_cmpgt(near, far)), sign);
    b = spu_sel(b, least, spu_cmpgt(least, b));
    b = spu_sel(b, most, spu_cmpgt(b, most));
    /* down to a whole number, from -1 up: towards zero after a shift by one */
    return spu_sub(spu_convts(spu_add(b, spu_splats(1.f)), 0), spu_splats((int32_t)1));
}

/* The last cells of the axes u and v as frustum_cells takes them. */
CGT_SPU_INLINE vec_float4 frustum_max_cells(float last_u, float last_v)
{
    return (vec_float4){last_u + 1, last_u, last_v + 1, last_v};
}

/* Cells of a slice that the frustum may touch. */
CGT_SPU_INLINE vec_int4 frustum_slice(const frustum *f, uint32_t slice)
{
    const vec_float4 near = spu_madd(f->step, spu_splats((float)slice - f->w0), f->bound), far = spu_add(near, f->step);
    return frustum_cells(near, far, frustum_max_cells(f->last[1], f->last[2]));
}

#endif
