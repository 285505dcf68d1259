/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points as a light sees them: projected along an axis, or all around it. */
#ifndef CGT_LIGHT_PROJECTION_H
#define CGT_LIGHT_PROJECTION_H

#include "kernel/light/light_points.h"

/* Projects points as the light sees them, along two axes and in any unit. */
typedef struct light_projection {
    bool is_point;
    uint32_t main;
    float origin[3], slope[2];
    float sign; /* of the middle point's way along the main axis */
} light_projection;

CGT_SPU_INLINE void light_apply_projection(const light_projection *v, const vfloat point[3], vfloat coord[2])
{
    vfloat from[3];
    for (int a = 0; a < 3; a++)
        from[a] = spu_sub(point[a], spux_vfloat(v->origin[a]));
    const vfloat w = from[v->main], rw = v->is_point ? spux_div(spux_vfloat(1), w) : spux_vfloat(1);
    for (uint32_t a = 0; a < 2; a++)
        coord[a] = spu_mul(spu_nmsub(spux_vfloat(v->slope[a]), w, from[(v->main + 1 + a) % 3]), rw);
}

/* Points all around a light: directions as the octahedron unfolds onto a square, the main one in its middle. Neighbours
 * stay neighbours but for the edges of the square, which lie behind the light. */
CGT_SPU_INLINE void light_unfold(const light_projection *v, const vfloat point[3], vfloat coord[2])
{
    const vfloat minus = spux_vfloat(-0.f), one = spux_vfloat(1);
    vfloat from[3], sum = spux_vfloat(0x1p-100f);
    for (int a = 0; a < 3; a++) {
        from[a] = spu_sub(point[a], spux_vfloat(v->origin[a]));
        sum = spu_add(sum, spux_abs(from[a]));
    }
    const vfloat rsum = spux_div(one, sum);
    const vmask behind = spu_cmpgt(spux_vfloat(0), spu_mul(from[v->main], spux_vfloat(v->sign)));
    for (uint32_t a = 0; a < 2; a++) {
        const vfloat own = spu_mul(from[(v->main + 1 + a) % 3], rsum),
                     other = spu_mul(from[(v->main + 2 - a) % 3], rsum);
        const vfloat folded = spu_or(spux_abs(spu_sub(one, spux_abs(other))), spu_and(own, minus));
        coord[a] = spux_select(own, folded, behind);
    }
}

/* Points k to k + CGT_LANES - 1 of a chunk; lanes beyond its end repeat the last one. */
CGT_SPU_INLINE void light_load_points(const light_call *c, uint32_t k, uint32_t count, vfloat point[3])
{
    for (int a = 0; a < 3; a++) {
        const float *org = c->source.rays->org[a];
        _Alignas(CGT_VECTOR_BYTES) float o[CGT_LANES];
        if (c->source.stride == sizeof(float) && k + CGT_LANES <= count) {
            point[a] = spux_load_unaligned(org + c->order.first + k);
            continue;
        }
        for (uint32_t i = 0; i < CGT_LANES; i++)
            o[i] = ray_element(&c->source, org, c->order.first + (k + i < count ? k + i : count - 1));
        point[a] = spux_load(o);
    }
}

/* The place of a cell, below 2^bits along each axis, on a Hilbert curve: unlike a Morton curve it never jumps, so any
 * run of points on it lies close together. From the largest squares on, each is turned as its parent demands. */
CGT_SPU_INLINE vuint light_curve_place(vuint x, vuint y, uint32_t bits)
{
    vuint place = spux_vuint(0);
    for (uint32_t k = bits; k--;) {
        const vuint one = spux_vuint(1), zero = spux_vuint(0);
        const vuint right = spu_and(spu_sr(x, k), one), upper = spu_and(spu_sr(y, k), one);
        place = spu_or(spu_sl(place, 2), spu_xor(spu_add(right, right), spu_xor(spu_and(right, one), upper)));
        const vmask low = spu_cmpeq(upper, zero), flips = spu_and(low, spu_cmpeq(right, one));
        const vuint fx = spux_select(x, spu_xor(x, spux_vuint((1u << bits) - 1)), flips);
        const vuint fy = spux_select(y, spu_xor(y, spux_vuint((1u << bits) - 1)), flips);
        x = spux_select(fx, fy, low);
        y = spux_select(fy, fx, low);
    }
    return place;
}

#endif
