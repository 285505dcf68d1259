/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays from the hits of a camera's rays, in words: the PPE makes the same ones for pixels that it decides. So where a
 * hit lies, and to which side its normal looks, is what these operations give; it depends on the pixel's canonical ray
 * and its sphere alone. */
#ifndef CGT_LIGHT_RAYS_H
#define CGT_LIGHT_RAYS_H

#include "vector.h"

#define CGT_LIGHT_LEAST 0x1p-70f         /* coordinates of hits are 0 or at least that */
#define CGT_LIGHT_MIN_DIRECTION 0x1p-20f /* limits of a direction's largest component: */
#define CGT_LIGHT_MAX_DIRECTION 0x1p20f  /* docs/reports/cell_sizes.md; the PPE traces what is beyond */

/* 1 / dir.dir, as all filters take it. */
CGT_SPU_INLINE vec_float4 cgt_light_rdd(const vec_float4 dir[3])
{
    const vec_float4 dd = spu_madd(dir[0], dir[0], spu_madd(dir[1], dir[1], spu_mul(dir[2], dir[2])));
    return spux_div(spu_splats(1.f), dd);
}

/* Where rays from the eye hit spheres that they are known to hit, and the normals there, of the radius' length.
 * rdd: cgt_light_rdd(dir). Beyond t_min: the second root where the first one lies before it. */
CGT_SPU_INLINE void cgt_light_find_hits(const vec_float4 eye[3], const vec_float4 dir[3], vec_float4 rdd,
                                        vec_float4 t_min, const vec_float4 center[3], vec_float4 radius,
                                        vec_float4 point[3], vec_float4 normal[3])
{
    const vec_float4 zero = spu_splats(0.f);
    vec_float4 c[3], l[3];
    for (int a = 0; a < 3; a++)
        c[a] = spu_sub(center[a], eye[a]);
    const vec_float4 mid = spu_mul(spu_madd(dir[0], c[0], spu_madd(dir[1], c[1], spu_mul(dir[2], c[2]))), rdd);
    for (int a = 0; a < 3; a++)
        l[a] = spu_nmsub(mid, dir[a], c[a]);
    const vec_float4 l2 = spu_madd(l[0], l[0], spu_madd(l[1], l[1], spu_mul(l[2], l[2])));
    const vec_float4 h = spu_sub(spu_mul(radius, radius), l2);
    const vec_float4 half = spux_sqrt(spu_mul(spu_sel(h, zero, spu_cmpgt(zero, h)), rdd)), near = spu_sub(mid, half);
    const vec_float4 t = spu_sel(near, spu_add(mid, half), spu_cmpgt(t_min, near));
    for (int a = 0; a < 3; a++) {
        const vec_float4 p = spu_madd(t, dir[a], eye[a]);
        point[a] = spu_sel(p, zero, spu_cmpgt(spu_splats(CGT_LIGHT_LEAST), spux_abs(p)));
        normal[a] = spu_sub(point[a], center[a]);
    }
}

/* Lanes whose normal looks away from a direction. */
CGT_SPU_INLINE vec_uint4 cgt_light_looks_away(const vec_float4 normal[3], const vec_float4 dir[3])
{
    const vec_float4 dot = spu_madd(normal[0], dir[0], spu_madd(normal[1], dir[1], spu_mul(normal[2], dir[2])));
    return spu_cmpgt(spu_splats(0.f), dot);
}

/* Lanes whose direction is within the limits. */
CGT_SPU_INLINE vec_uint4 cgt_light_is_usual(const vec_float4 dir[3])
{
    const vec_float4 most = spux_max(spux_max(spux_abs(dir[0]), spux_abs(dir[1])), spux_abs(dir[2]));
    return spu_and(spu_cmpgt(most, spu_splats(CGT_LIGHT_MIN_DIRECTION)),
                   spu_cmpgt(spu_splats(CGT_LIGHT_MAX_DIRECTION), most));
}

#endif
