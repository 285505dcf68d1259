/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Blocks of a packet: 16 rays that lie side by side, 4x4 pixels of a camera. A large packet shares the work of the
 * grid; its blocks then spare a sphere the rays that it cannot reach. Each block of rays from one origin has a cone,
 * and the lanes of a vector are blocks.
 *
 * A cone with unit axis a and half angle alpha, a sphere with centre c (from the apex) and radius r, s = c.a and
 * p = |c - s a|: the centre is p cos(alpha) - s sin(alpha) away from the cone's surface, so the sphere surely misses
 * where p > r / cos(alpha) + s tan(alpha). The right side is widened by 2^-18 of the distance, more than all rounding,
 * and by 2^-72, where squares underflow. In roundings of 2^-23 (truncated; else 2^-24) of the distance, with 4 for a
 * root or quotient: the axis, 12 from unit length, moves s by 16 and tilts nothing; the sine has 6, so s tan(alpha) 12
 * and r / cos(alpha) 12 at most, since alpha is below 45 degrees; p has 5. That is 29 of the 32.
 *
 * Rays to a light have cones too, with the light as apex, and axes against the rays. A ray that starts at p has the
 * direction light - p, each component rounded to within 2^-24 of it, and so passes the light within 2^-24 |d|; up to
 * there, t = 1, it lies in a cone of the opposite direction that is so much wider. 2^-22 |d| is taken. */
#ifndef CGT_BLOCK_CONES_H
#define CGT_BLOCK_CONES_H

#include "kernel/packet/packet.h"
#include "papers/kernel/paper_tunables.h"
#include "papers/kernel/spu_programs.h"

#define CONE_REL_ERROR (CONE_ERROR_SCALE * 0x1p-18f)
#define BLOCK_RAYS 16u
#define PACKET_MAX_BLOCKS ((PACKET_MAX_RAYS / BLOCK_RAYS + CGT_LANES - 1) / CGT_LANES * CGT_LANES) /* whole vectors */
_Static_assert(PACKET_MAX_RAYS % BLOCK_RAYS == 0 && PACKET_MAX_RAYS <= 256, "a packet has whole blocks, at most 16");

typedef struct block_cones {
    _Alignas(64) float axis[3][PACKET_MAX_BLOCKS];
    _Alignas(64) float tangent[PACKET_MAX_BLOCKS];
    _Alignas(64) float secant[PACKET_MAX_BLOCKS];
    _Alignas(
        64) float apex_error[PACKET_MAX_BLOCKS]; /* 0, or how far rays pass from the light; infinity where they are too
                                                    wide for a cone: never culled */
    _Alignas(64) float far_t[PACKET_MAX_BLOCKS]; /* hits beyond this t count for no ray of the block */
    _Alignas(64) float speed[PACKET_MAX_BLOCKS]; /* cells of the main axis per t of the fastest ray */
    float apex[3];
    uint32_t blocks;
    bool cull; /* false: all blocks count as reached */
    bool has_cones;
} block_cones;

CGT_SPU_INLINE uint32_t block_end(const packet *p, uint32_t block)
{
    const uint32_t end = (block + 1) * BLOCK_RAYS;
    return end < p->lanes ? end : p->lanes;
}

CGT_SPU_INLINE void block_update_far_t(const packet *p, block_cones *b, uint32_t block)
{
    vfloat far_t = spux_vfloat(-INFINITY);
    for (uint32_t i = block * BLOCK_RAYS; i < block_end(p, block); i += CGT_LANES)
        far_t = spux_max(far_t, spux_load(p->high + i));
    b->far_t[block] = spux_hmax(far_t);
}

/* Square of the largest sine of the angle between the axis and a ray of the block. */
CGT_SPU_INLINE float block_max_sine2(const packet *p, uint32_t block, const float a[3])
{
    const vfloat ax = spux_vfloat(a[0]), ay = spux_vfloat(a[1]), az = spux_vfloat(a[2]);
    vfloat upper = spux_vfloat(0);
    for (uint32_t i = block * BLOCK_RAYS; i < block_end(p, block); i += CGT_LANES) {
        const vfloat x = spux_load(p->dir[0] + i), y = spux_load(p->dir[1] + i), z = spux_load(p->dir[2] + i);
        const vfloat k = spu_madd(x, ax, spu_madd(y, ay, spu_mul(z, az)));
        const vfloat ex = spu_nmsub(k, ax, x), ey = spu_nmsub(k, ay, y), ez = spu_nmsub(k, az, z);
        const vfloat sine2 = spu_mul(spu_madd(ex, ex, spu_madd(ey, ey, spu_mul(ez, ez))), spux_load(p->rdd + i));
        /* a ray that turns back has the sine of its opposite: give it more than any limit */
        upper = spux_max(upper, spux_select(sine2, spux_vfloat(2), spu_cmpgt(spux_vfloat(0), k)));
    }
    return spux_hmax(upper);
}

/* At least the length of the longest direction of a block. */
CGT_SPU_INLINE float block_max_length(const packet *p, uint32_t block)
{
    vfloat lower = spux_vfloat(INFINITY);
    for (uint32_t i = block * BLOCK_RAYS; i < block_end(p, block); i += CGT_LANES)
        lower = spux_min(lower, spux_load(p->rdd + i));
    return SCALAR_DIVIDE(1 + 0x1p-18f, SCALAR_SQRT(spux_hmin(lower)));
}

CGT_SPU_INLINE void block_init_cone(const packet *p, block_cones *b, uint32_t block)
{
    const uint32_t first = block * BLOCK_RAYS, last = block_end(p, block) - 1;
    float a[3], square = 0;
    for (int k = 0; k < 3; k++) {
        a[k] = p->dir[k][first] + p->dir[k][last];
        square += a[k] * a[k];
    }
    const float scale = SCALAR_DIVIDE(1, SCALAR_SQRT(square));
    for (int k = 0; k < 3; k++) {
        a[k] *= scale;
        b->axis[k][block] = p->to_light ? -a[k] : a[k];
    }
    /* comparisons that fail for what is not a number: such a block is not culled */
    const float sine2 = block_max_sine2(p, block, a) * (1 + CONE_REL_ERROR) + CONE_ERROR_SCALE * 0x1p-40f;
    const bool narrow = sine2 < 0.5f && square > 0x1p-100f && square < 0x1p100f;
    b->secant[block] = narrow ? SCALAR_DIVIDE(1, SCALAR_SQRT(1 - sine2)) * (1 + CONE_REL_ERROR) : 1;
    b->tangent[block] = narrow ? SCALAR_SQRT(sine2) * b->secant[block] : 0;
    b->apex_error[block] = !narrow ? INFINITY : p->to_light ? block_max_length(p, block) * 0x1p-22f : 0;
}

/* Whether hits behind an origin count, which a cone does not hold. */
CGT_SPU_INLINE bool block_has_negative_t(const packet *p)
{
    vfloat lower = spux_vfloat(0);
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
        lower = spux_min(lower, spux_load(p->t_min + i));
    return spux_hmin(lower) < 0;
}

/* Whether hits beyond the light count, which a cone that ends there does not hold. */
CGT_SPU_INLINE bool block_passes_light(const packet *p)
{
    vfloat upper = spux_vfloat(0);
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
        upper = spux_max(upper, spux_load(p->t_max + i));
    return spux_hmax(upper) > 1;
}

CGT_SPU_INLINE void block_init_speed(const packet *p, block_cones *b, uint32_t block, int main_axis, float rcell)
{
    vfloat upper = spux_vfloat(0);
    for (uint32_t i = block * BLOCK_RAYS; i < block_end(p, block); i += CGT_LANES)
        upper = spux_max(upper, spux_abs(spux_load(p->dir[main_axis] + i)));
    b->speed[block] = spux_hmax(upper) * rcell;
}

/* Cones where the rays share their origin and run forwards, or end at a light; without them only hidden spheres are
 * culled. */
CGT_SPU_INLINE void block_cones_init(const packet *p, bool cull, int main_axis, float rcell, block_cones *b)
{
    b->cull = cull;
    b->has_cones = cull && (p->to_light ? !block_passes_light(p) : p->common_origin && !block_has_negative_t(p));
    for (int k = 0; k < 3; k++)
        b->apex[k] = p->to_light ? p->light[k] : p->org[k][0];
    b->blocks = (p->lanes + BLOCK_RAYS - 1) / BLOCK_RAYS;
    for (uint32_t block = 0; block < b->blocks; block++) {
        block_update_far_t(p, b, block);
        block_init_speed(p, b, block, main_axis, rcell);
        if (b->has_cones)
            block_init_cone(p, b, block);
    }
    /* vectors read to their end */
    for (uint32_t block = b->blocks; block % CGT_LANES; block++) {
        for (int k = 0; k < 3; k++)
            b->axis[k][block] = 0;
        b->tangent[block] = b->secant[block] = b->apex_error[block] = 0;
        b->far_t[block] = -INFINITY;
        b->speed[block] = 1;
    }
}

/* Blocks, as bits, that a sphere may reach before they have nearer hits. nearest: no ray meets the sphere before this
 * t. */
CGT_SPU_INLINE uint32_t block_cones_test_sphere(const block_cones *b, const float center[3], float radius,
                                                float nearest)
{
    const float c[3] = {center[0] - b->apex[0], center[1] - b->apex[1], center[2] - b->apex[2]};
    const vfloat x = spux_vfloat(c[0]), y = spux_vfloat(c[1]), z = spux_vfloat(c[2]);
    const float distance = __builtin_fabsf(c[0]) + __builtin_fabsf(c[1]) + __builtin_fabsf(c[2]);
    const vfloat r = spux_vfloat(radius), error = spux_vfloat((distance + radius) * CONE_REL_ERROR + 0x1p-72f);
    uint32_t reached = 0;
    if (!b->cull)
        return (1u << b->blocks) - 1;
    for (uint32_t i = 0; i < b->blocks; i += CGT_LANES) {
        vmask missed = spu_cmpgt(spux_vfloat(nearest), spux_load(b->far_t + i));
        if (b->has_cones) {
            const vfloat ax = spux_load(b->axis[0] + i), ay = spux_load(b->axis[1] + i), az = spux_load(b->axis[2] + i);
            const vfloat s = spu_madd(x, ax, spu_madd(y, ay, spu_mul(z, az)));
            const vfloat px = spu_nmsub(s, ax, x), py = spu_nmsub(s, ay, y), pz = spu_nmsub(s, az, z);
            const vfloat p2 = spu_madd(px, px, spu_madd(py, py, spu_mul(pz, pz)));
            const vfloat sine_part = spu_mul(s, spux_load(b->tangent + i));
            const vfloat reach =
                spu_add(spu_add(spu_madd(r, spux_load(b->secant + i), sine_part), error), spux_load(b->apex_error + i));
            missed = spu_or(missed, spu_or(spu_cmpgt(spux_vfloat(0), reach), spu_cmpgt(p2, spu_mul(reach, reach))));
        }
        reached |= (~spux_mask_bits(missed) & CGT_ALL_LANES) << i;
    }
    return reached & ((1u << b->blocks) - 1);
}

#endif
