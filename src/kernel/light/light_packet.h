/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A packet of rays to one light, and the frustum that all of them lie in, with its tip at the light or, of parallel
 * rays, with parallel sides: four planes and two ends, against which a node's children are tested at once, and a leaf's
 * primitives.
 *
 * The rays run mostly along one axis, the main one: w is the coordinate along it, seen from the reference (the light, or
 * the first point of parallel rays) and mirrored where they run against it, v that along another axis. Each ray's line
 * is v = slope w + offset, the offset 0 with a light at a place, the slope common without. So a plane is
 *     v - a w <= h,  a the largest slope and h the largest offset, and the like with the smallest
 * Margin. Let M be the sum of the largest coordinates, along any axis, of light, points and objects, and u = 2^-24.
 * Differences are within 2 u M. A slope is within 2 u of itself and of what v and w bring, so that the line is at most
 * 8 u M off between a point and the light, and 16 u M beyond a parallel ray's point as far as objects are, slopes being
 * at most 2. A canonical ray points past the light by u of its way, and t is rounded before it is compared with the
 * range. Of v - a w three operations round numbers below 8 M. The margin is 2^-17 M (1 + |a|), more than all of that. */
#ifndef CGT_LIGHT_PACKET_H
#define CGT_LIGHT_PACKET_H

#include "kernel/packet/ray_packet.h"
#include "kernel/tunables.h"

#define LIGHT_MAX_SLOPE 2.f

/* Rays lie between the planes v - slope[a][0] w >= offset[a][0] and v - slope[a][1] w <= offset[a][1], for both axes a,
 * and between two w. Margins are in it. */
typedef struct light_frustum {
    float slope[2][2], offset[2][2];
    float length[2][2]; /* of each plane's normal, rounded up */
    float w[2];
} light_frustum;

typedef struct light_packet {
    packet rays;
    light_frustum frustum;
    _Alignas(CGT_VECTOR_BYTES) float ray_terms[3][PACKET_MAX_RAYS]; /* x, see light_leaf.h */
    float square[PACKET_MAX_RAYS];                                  /* d.d */
    float max_component, max_sum; /* of all x: the largest component, and the largest sum of their sizes */
    bool default_ranges;          /* every range is from 0, to 1 at a light that has a place, to infinity else */
    uint64_t undecided;           /* vectors with rays that have met nothing, as bits */
    int axis[3];                  /* the main one first */
    float sign;                   /* of the way from the reference along it */
    float origin[3];
    float margin;       /* without 1 + |a| */
    uint32_t last_leaf; /* the leaf that closed the last rays of the packet before; 0: none */
    uint64_t work;
} light_packet;

static inline float light_max(float a, float b) { return a > b ? a : b; }

/* The main axis and the reference, by any ray that takes part. False where there is no common way. */
static inline bool light_init_axes(const packet *p, const float org[3], const float dir[3], light_packet *l)
{
    const bool is_point = p->to_light;
    float upper = 0;
    l->axis[0] = 0;
    for (int a = 0; a < 3; a++) {
        const float d = is_point ? org[a] - p->light[a] : dir[a];
        if (fabsf(d) > upper) {
            upper = fabsf(d);
            l->axis[0] = a;
            l->sign = d < 0 ? -1 : 1;
        }
        l->origin[a] = is_point ? p->light[a] : org[a];
    }
    l->axis[1] = (l->axis[0] + 1) % 3;
    l->axis[2] = (l->axis[0] + 2) % 3;
    return upper > 0;
}

/* farthest: lanes with the largest sizes of points along each axis. */
CGT_SPU_INLINE void light_set_margin(const cgt_committed_scene *committed_scene, const vfloat max_org[3],
                                     light_packet *l)
{
    float magnitude = 0;
    for (int a = 0; a < 3; a++)
        magnitude = light_max(magnitude, light_max(fabsf(committed_scene->low[a]), fabsf(committed_scene->high[a])) +
                                             spux_hmax(max_org[a]) + fabsf(l->origin[a]));
    l->margin = magnitude * LIGHT_MARGIN;
}

static inline void light_compute_margin(const cgt_committed_scene *committed_scene, const packet *p, light_packet *l)
{
    vfloat max_org[3];
    for (int a = 0; a < 3; a++) {
        max_org[a] = spux_vfloat(0);
        for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
            max_org[a] = spux_max(max_org[a], spux_abs(spux_load(p->org[a] + i)));
    }
    light_set_margin(committed_scene, max_org, l);
}

/* Whether all rays stay between their points and the light. */
static inline bool light_check_ranges(const packet *p, light_packet *l)
{
    const vfloat end = spux_vfloat(p->to_light ? 1 : INFINITY);
    vmask beyond = spux_mask_none(), other = spux_mask_none();
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat t_min = spux_load(p->t_min + i), t_max = spux_load(p->t_max + i);
        beyond = spu_or(beyond, spu_or(spu_cmpgt(spux_vfloat(0), t_min), spu_cmpgt(t_max, end)));
        other = spu_or(other, spu_or(spu_cmpgt(t_min, spux_vfloat(0)), spu_cmpgt(end, t_max)));
    }
    l->default_ranges = spux_none(other);
    return spux_none(beyond);
}

/* What the tests of leaves take. */
static inline void light_compute_terms(const packet *p, float scale, light_packet *l)
{
    vfloat max_component = spux_vfloat(0), max_sum = spux_vfloat(0);
    l->undecided = 0;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        vfloat sum = spux_vfloat(0), square = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat d = spux_load(p->dir[a] + i);
            const vfloat x = spu_mul(p->to_light ? d : spu_sub(spux_load(p->org[a] + i), spux_vfloat(l->origin[a])),
                                     spux_vfloat(scale));
            square = spu_madd(d, d, square);
            max_component = spux_max(max_component, spux_abs(x));
            sum = spu_add(sum, spux_abs(x));
            spux_store(l->ray_terms[a] + i, x);
        }
        max_sum = spux_max(max_sum, sum);
        spux_store(l->square + i, square);
        l->undecided |= (uint64_t)spux_any(spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY))) << i / CGT_LANES;
    }
    l->max_component = spux_hmax(max_component);
    l->max_sum = spux_hmax(max_sum);
}

#endif
