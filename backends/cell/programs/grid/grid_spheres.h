/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres of a list against a packet: eight at a time are culled against the frustum, each that remains is tested
 * against the 16 rays, four vectors side by side. Formulas and bounds are those of packet/sphere_filter.h,
 * with an SPU's unit of 2^-23; what they leave open goes to the PPE. The bounds of a sphere are computed where it is
 * tested, in all lanes, which hides their latency behind the rays'.
 *
 * No min_t is kept: a sphere that lies beyond all hits is culled by w_far, and one that lies beyond a ray's hit by the
 * start of its interval. */
#ifndef GRID_SPHERES_H
#define GRID_SPHERES_H

#include "cell/programs/grid/grid_doubts.h"
#include "cell/programs/grid/grid_frustum.h"

/* What the rays of a packet are: constants where code is laid out for them. */
typedef enum grid_rays { GRID_CAMERA, GRID_LIGHT } grid_rays;

/* ---- a sphere and its bounds ---- */

/* In all lanes. */
typedef struct grid_sphere {
    vec_float4 center[3]; /* a camera's rays: seen from the eye */
    vec_float4 r2, certain_hit, t_error, t_width;
    vec_uint4 number;
} grid_sphere;

CGT_SPU_INLINE grid_sphere grid_bound_sphere(const grid_frustum *f, vec_float4 q, uint32_t number, grid_rays kind)
{
    grid_sphere b = {.number = spu_splats(number)};
    vec_float4 distance = f->org_reach;
    const vec_float4 center[3] = {GRID_LANE(q, 0), GRID_LANE(q, 1), GRID_LANE(q, 2)}, r = GRID_LANE(q, 3);
    for (int a = 0; a < 3; a++) {
        const vec_float4 c = spu_sub(center[a], f->org[a]);
        b.center[a] = kind == GRID_CAMERA ? c : center[a];
        distance = spu_add(distance, spux_abs(c));
    }
    const vec_float4 eps_c = spu_mul(distance, spu_splats(26 * GRID_ROUNDOFF)); /* 26^2 > 640 */
    const vec_float4 reach = spu_add(distance, r);
    const vec_float4 eps =
        spu_madd(spu_mul(r, spu_splats(9 * GRID_ROUNDOFF)), reach, spu_madd(eps_c, eps_c, spu_splats(0x1p-120f)));
    b.r2 = spu_madd(r, r, eps);
    b.certain_hit = spu_mul(eps, spu_splats(17.f));
    b.t_error = spu_madd(reach, f->t_unit, f->t_underflow);
    b.t_width = spu_madd(b.t_error, spu_splats(2.f), spu_mul(spux_sqrt(eps), f->t_root));
    return b;
}

/* What a packet's directions bring to the bounds. */
CGT_SPU_INLINE void grid_bound_lengths(const grid_packet *p, grid_frustum *f)
{
    const vec_float4 most = grid_greatest(spux_max(spux_max(p->rdd[0], p->rdd[1]), spux_max(p->rdd[2], p->rdd[3])));
    const vec_float4 rlength = spu_mul(spux_sqrt(most), spu_splats(1 + 0x1p-18f));
    f->t_unit = spu_mul(rlength, spu_splats(18 * GRID_ROUNDOFF));
    f->t_root = spu_mul(rlength, spu_splats(0x1.148p-2f));
    f->t_underflow = spu_madd(spu_mul(rlength, rlength), spu_splats(0x1p-122f), spu_splats(0x1p-62f));
}

/* ---- a vector of rays ---- */

/* From the nearest point of a line to the centre. */
typedef struct grid_near {
    vec_float4 mid, h; /* its t; r^2 + eps less the square of the distance */
} grid_near;

CGT_SPU_INLINE grid_near grid_find_near(const grid_packet *p, int i, const grid_sphere *b, grid_rays kind)
{
    vec_float4 c[3], l[3];
    for (int a = 0; a < 3; a++)
        c[a] = kind == GRID_CAMERA ? b->center[a] : spu_sub(b->center[a], p->org[a][i]);
    const vec_float4 dot = spu_madd(p->dir[0][i], c[0], spu_madd(p->dir[1][i], c[1], spu_mul(p->dir[2][i], c[2])));
    const vec_float4 mid = spu_mul(dot, p->rdd[i]);
    for (int a = 0; a < 3; a++)
        l[a] = spu_nmsub(mid, p->dir[a][i], c[a]);
    const vec_float4 l2 = spu_madd(l[0], l[0], spu_madd(l[1], l[1], spu_mul(l[2], l[2])));
    return (grid_near){mid, spu_sub(b->r2, l2)};
}

/* Takes what is certain, and returns the lanes that stay open. second: looks at second roots, too. */
CGT_SPU_INLINE vec_uint4 grid_take_hits(grid_packet *p, int i, const grid_sphere *b, grid_near n, vec_float4 t_min,
                                        grid_rays kind, bool second, vec_uint4 *taken)
{
    const vec_float4 zero = spu_splats(0.f), best_low = p->low[i], best_high = p->high[i];
    const vec_float4 half = spux_sqrt(spu_mul(n.h, p->rdd[i]));
    vec_float4 low = spu_sub(spu_sub(n.mid, half), b->t_error), high = spu_add(low, b->t_width);
    const vec_float4 end = spu_add(spu_add(n.mid, half), b->t_error);
    const vec_uint4 same = spu_cmpeq(p->prim[i], b->number), inside = spu_cmpgt(n.h, b->certain_hit);
    vec_uint4 out =
        spu_or(spu_or(spu_cmpgt(zero, n.h), spu_cmpgt(low, best_high)), spu_or(spu_cmpgt(t_min, end), same));
    vec_uint4 hit = spu_and(inside, spu_and(spu_cmpgt(best_low, high), spu_cmpgt(low, t_min)));
    if (kind == GRID_LIGHT)
        hit = spu_andc(hit, same);
    if (second) { /* where the first root certainly lies before the range, the second one counts */
        const vec_uint4 later = spu_and(spu_andc(inside, spu_or(out, hit)), spu_cmpgt(t_min, high));
        low = spu_sel(low, spu_sub(end, b->t_width), later);
        high = spu_sel(high, end, later);
        const vec_uint4 counts = spu_and(spu_cmpgt(best_low, high), spu_cmpgt(low, t_min));
        hit = spu_or(hit, spu_and(later, counts));
        out = spu_or(out, spu_and(later, spu_cmpgt(low, best_high)));
    }
    const vec_float4 closed = spu_splats(GRID_CLOSED);
    p->low[i] = spu_sel(best_low, kind == GRID_LIGHT ? closed : low, hit);
    p->high[i] = spu_sel(best_high, kind == GRID_LIGHT ? closed : high, hit);
    if (kind == GRID_CAMERA)
        p->prim[i] = spu_sel(p->prim[i], b->number, hit);
    *taken = spu_or(*taken, hit);
    return spu_nor(out, hit);
}

/* Rays that the first test leaves open: looks at their second roots, and tells the PPE of what stays open. Returns
 * lanes with hits. */
CGT_SPU_INLINE vec_uint4 grid_settle(grid_packet *p, const grid_sphere *b, vec_float4 t_min, grid_rays kind)
{
    vec_uint4 taken = spu_splats(0u);
    for (int i = 0; i < 4; i++) {
        const grid_near n = grid_find_near(p, i, b, kind);
        uint32_t open = spu_extract(spu_gather(grid_take_hits(p, i, b, n, t_min, kind, true, &taken)), 0);
        for (; open; open &= open - 1)
            grid_add_doubt(4 * (uint32_t)i + 3 - (uint32_t)__builtin_ctz(open), spu_extract(b->number, 0));
    }
    return taken;
}

static __attribute__((noinline)) vec_uint4 grid_settle_camera(grid_packet *p, const grid_sphere *b, vec_float4 t_min)
{
    return grid_settle(p, b, t_min, GRID_CAMERA);
}
static __attribute__((noinline)) vec_uint4 grid_settle_light(grid_packet *p, const grid_sphere *b, vec_float4 t_min)
{
    return grid_settle(p, b, t_min, GRID_LIGHT);
}

/* Tests one sphere against all rays; returns lanes that have got a hit. */
CGT_SPU_INLINE vec_uint4 grid_test_sphere(grid_packet *p, const grid_frustum *f, uint32_t number, grid_rays kind)
{
    const vec_float4 q = GRID_LOAD(vec_float4, s()->sphere, number * 16), zero = spu_splats(0.f);
    const vec_float4 t_min = spu_splats(kind == GRID_CAMERA ? s()->camera.t_min : 0.f);
    const grid_sphere b = grid_bound_sphere(f, q, number, kind);
    vec_uint4 taken = spu_splats(0u), open = taken;
    grid_near n[4];
    for (int i = 0; i < 4; i++)
        n[i] = grid_find_near(p, i, &b, kind);
    const vec_uint4 missed = spu_and(spu_and(spu_cmpgt(zero, n[0].h), spu_cmpgt(zero, n[1].h)),
                                     spu_and(spu_cmpgt(zero, n[2].h), spu_cmpgt(zero, n[3].h)));
    if (spu_extract(spu_gather(missed), 0) == 15)
        return taken;
    for (int i = 0; i < 4; i++)
        open = spu_or(open, grid_take_hits(p, i, &b, n[i], t_min, kind, false, &taken));
    if (GRID_RARELY(spu_extract(spu_gather(open), 0)))
        taken = spu_or(taken, kind == GRID_CAMERA ? grid_settle_camera(p, &b, t_min) : grid_settle_light(p, &b, t_min));
    return taken;
}

/* ---- culling ---- */

/* Spheres in grid space: u, v, w, radius. */
CGT_SPU_INLINE vec_uint4 grid_find_inside(const grid_axes *x, const grid_frustum *f, vec_float4 q[4])
{
    const vec_float4 r = q[3];
    const vec_float4 u = spu_mul(spu_sub(q[0], x->org[0]), x->rcell[0]);
    const vec_float4 v = spu_mul(spu_sub(q[1], x->org[1]), x->rcell[1]);
    const vec_float4 w = spu_madd(spu_sub(q[2], x->org[2]), x->rcell[2], x->w_offset);
    const vec_float4 along = spu_sub(w, f->w0), reach = spu_madd(r, f->w_reach, f->error);
    const vec_float4 at[4] = {u, grid_negative(u), v, grid_negative(v)};
    vec_uint4 outside = spu_or(spu_cmpgt(spu_sub(w, reach), f->w_far), spu_cmpgt(f->w_near, spu_add(w, reach)));
    for (int k = 0; k < 4; k++) {
        const vec_float4 distance = spu_madd(r, f->reach[k], spu_nmsub(f->step[k], along, at[k]));
        outside = spu_or(outside, spu_cmpgt(f->inside[k], distance));
    }
    return outside;
}

/* Eight spheres of the list: a bit for each that may be hit, those with even places first, the first one highest. */
CGT_SPU_INLINE uint32_t grid_cull_eight(const grid_axes *x, const grid_frustum *f, vec_ushort8 list, vec_uint4 culls)
{
    const vec_ushort8 bytes = spu_splats((unsigned short)16);
    const vec_uint4 offset[2] = {spu_mule(list, bytes), spu_mulo(list, bytes)};
    const vec_float4 zero = spu_splats(0.f);
    vec_uint4 outside[2];
    for (int k = 0; k < 2; k++) {
        vec_float4 q[4], sphere[4];
        for (int j = 0; j < 4; j++) {
            q[j] = GRID_LOAD(vec_float4, s()->sphere, spu_extract(offset[k], j));
            q[j] = spu_shuffle(q[j], q[j], x->order);
        }
        GRID_TRANSPOSE(q[0], q[1], q[2], q[3], sphere);
        outside[k] = spu_or(spu_and(grid_find_inside(x, f, sphere), culls), spu_cmpgt(zero, sphere[3]));
    }
    const uint32_t bits = spu_extract(spu_gather(outside[0]), 0) << 4 | spu_extract(spu_gather(outside[1]), 0);
    return bits ^ 0xff;
}

/* Tests the list, and takes hits into account. */
CGT_SPU_INLINE void grid_test_list(const grid_axes *x, grid_packet *p, grid_frustum *f, uint32_t bytes, grid_rays kind)
{
    const bool culled = s()->control.flags >> CGT_CONTROL_CULL_SHIFT != CGT_CULL_NONE;
    const vec_uint4 culls = spu_splats(culled ? 0xffffffffu : 0u);
    const bool remembers = s()->control.flags & CGT_CONTROL_REMEMBER;
    vec_uint4 taken = spu_splats(0u);
    uint32_t tests = 0, remembered = 0;
    for (uint32_t at = 0; at < bytes; at += 16) {
        const vec_ushort8 list = GRID_LOAD(vec_ushort8, s()->list, at);
        uint32_t inside = grid_cull_eight(x, f, list, culls);
        while (inside) {
            const uint32_t bit = (uint32_t)__builtin_clz(inside) - 24, place = (bit & 3) * 4 + (bit >> 2) * 2;
            const uint32_t number = spu_extract(spu_rlqwbyte(list, (int)place), 0);
            inside ^= 0x80u >> bit;
            if (remembers) {
                const vec_ushort8 all = spu_splats((unsigned short)number);
                const vec_uchar16 shift = {16, 17, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
                if (spu_extract(spu_gather(spu_cmpeq(s()->tested, all)), 0)) {
                    remembered++;
                    continue;
                }
                s()->tested = spu_shuffle(s()->tested, all, shift);
            }
            tests++;
            taken = spu_or(taken, grid_test_sphere(p, f, number, kind));
        }
    }
    if (spu_extract(spu_gather(taken), 0))
        f->w_far = grid_max_w(x, p, kind == GRID_CAMERA);
    s()->counts[COUNT_LISTED] = spu_add(s()->counts[COUNT_LISTED], spu_splats(bytes / 2));
    s()->counts[COUNT_TESTS] = spu_add(s()->counts[COUNT_TESTS], spu_splats(tests));
    s()->counts[COUNT_REMEMBERED] = spu_add(s()->counts[COUNT_REMEMBERED], spu_splats(remembered));
}

static __attribute__((noinline)) void grid_test_camera(const grid_axes *x, grid_packet *p, grid_frustum *f,
                                                       uint32_t bytes)
{
    grid_test_list(x, p, f, bytes, GRID_CAMERA);
}
static __attribute__((noinline)) void grid_test_light(const grid_axes *x, grid_packet *p, grid_frustum *f,
                                                      uint32_t bytes)
{
    grid_test_list(x, p, f, bytes, GRID_LIGHT);
}

#endif
