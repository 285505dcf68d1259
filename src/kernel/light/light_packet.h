/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A packet of rays to one light. All of them lie in a frustum with its apex at the light or, for parallel rays, with
 * parallel sides: four planes and two ends.
 *
 * The rays run mostly along one axis, the main one. w is the coordinate along it, seen from the origin of the packet
 * (the light, or the first point of parallel rays), and mirrored if the rays run against it; v is the coordinate along
 * another axis. Each ray's line is v = slope w + offset. With a point light the offset is 0, with parallel rays the
 * slope is common. So a plane of the frustum is
 *     v - a w <= h,  a the largest slope and h the largest offset, and likewise with the smallest
 * Margin. Let M be the sum of the largest coordinates, along any axis, of light, points and primitives, and u = 2^-24.
 * Differences are within 2 u M. A slope is within a relative 2 u plus the errors of v and w, so a line is off by at
 * most 8 u M between a point and the light, and by 16 u M beyond a parallel ray's point as far as the primitives, for
 * slopes of at most 2. A canonical ray misses the light by u of its length, and t is rounded before it is compared with
 * the range. The three operations of v - a w round numbers below 8 M. The margin is 2^-17 M (1 + |a|), more than the
 * sum of these.
 * Underflow. Parallel rays may start at the world's origin, where M of a wide scene is 0, and meet primitives whose
 * coordinates are a few of the least floats. Each product is off by 2^-150 then, as much as they are apart; 2^-100 is
 * added to the margin. Rays to a point are at least as long as PACKET_MIN_DIR, and so is M.
 * Wide scenes. Where the scene reaches far beyond light and points, a margin for all of it would exceed what most
 * primitives need. M is then split: the packet's margin has the coordinates of light and points alone, and each
 * primitive, box or level adds 2^-17 (1 + |a|) of its own largest coordinate. */
#ifndef CGT_LIGHT_PACKET_H
#define CGT_LIGHT_PACKET_H

#include "kernel/packet/ray_packet.h"
#include "kernel/tunables.h"

#define LIGHT_MAX_SLOPE 2.f
#define LIGHT_DECISION_WORK 8u /* of a ray and a primitive that single precision leaves undecided */
#define LIGHT_MIN_WIDE 4.f     /* a scene that reaches as many times as far as light and points is wide */

/* Rays lie between the planes v - slope[a][0] w >= offset[a][0] and v - slope[a][1] w <= offset[a][1], for both axes a,
 * and between two w. Margins are included. */
typedef struct light_frustum {
    float slope[2][2], offset[2][2];
    float length[2][2]; /* of each plane's normal, rounded up */
    float w[2];
} light_frustum;

typedef struct light_packet {
    packet rays;
    light_frustum frustum;
    _Alignas(CGT_VECTOR_BYTES) float ray_terms[3][PACKET_MAX_RAYS]; /* x of light_leaf.h */
    float square[PACKET_MAX_RAYS];                                  /* d.d */
    float max_component, max_sum; /* over all x: the largest component, and the largest 1-norm */
    bool default_ranges;          /* every range is [0, 1], or [0, infinity] for parallel rays */
    uint64_t undecided;           /* vectors with rays that have hit nothing, as bits */
    int axis[3];                  /* the main one first */
    float sign;                   /* of the rays' origins along it, seen from `origin` */
    float origin[3];
    float margin;       /* without the factor 1 + |a| */
    float size_offset;  /* added to r^2 of spheres in bounds: infinite where products of any sphere may overflow */
    bool is_wide;       /* primitives add margins of their own */
    uint32_t still;     /* axes along which no ray moves, as bits */
    uint32_t last_leaf; /* the leaf that occluded the last rays of the previous packet; 0: none */
    uint64_t work;
} light_packet;

static inline float light_max(float a, float b) { return a > b ? a : b; }

/* Chooses the main axis and the origin by any ray of the packet. Returns false if the ray has no direction. */
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

/* max_org: in its lanes, the largest size of points' coordinates along each axis. */
CGT_SPU_INLINE void light_set_margin(const cgt_committed_scene *committed_scene, const vfloat max_org[3],
                                     light_packet *l)
{
    float magnitude = 0, of_rays = 0;
    for (int a = 0; a < 3; a++) {
        const float rays = spux_hmax(max_org[a]) + fabsf(l->origin[a]);
        of_rays = light_max(of_rays, rays);
        magnitude =
            light_max(magnitude, light_max(fabsf(committed_scene->low[a]), fabsf(committed_scene->high[a])) + rays);
    }
    l->is_wide = magnitude > of_rays * LIGHT_MIN_WIDE;
    magnitude = l->is_wide ? of_rays : magnitude;
    l->margin = magnitude * LIGHT_MARGIN + LIGHT_UNDERFLOW;
}

/* The margin that a primitive or box adds in a wide scene, by its largest coordinate, for any slope. */
CGT_SPU_INLINE vfloat light_own_margin(vfloat magnitude)
{
    return spu_mul(magnitude, spux_vfloat(LIGHT_MARGIN * (1 + LIGHT_MAX_SLOPE)));
}

/* Sets size_offset, after the terms. A sphere's centre is seen from a ray's origin within S along each axis, and r <=
 * S. So |d|^2 (c.c + r^2) is below 12 (S max |d_a|)^2, here below 2^124. */
static inline void light_compute_size_offset(const cgt_committed_scene *committed_scene, light_packet *l)
{
    const float of_terms = l->max_component / committed_scene->scale;
    float max_dir = of_terms, reach = 0;
    for (int a = 0; a < 3; a++) {
        reach = light_max(reach, light_max(fabsf(committed_scene->low[a]), fabsf(committed_scene->high[a])) +
                                     fabsf(l->origin[a]));
        max_dir = light_max(max_dir, fabsf(l->rays.dir[a][0])); /* of parallel rays */
    }
    l->size_offset = (reach + of_terms) * max_dir < 0x1p60f ? 0x1p-97f : INFINITY;
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

/* Whether all rays end at the light or before. */
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

/* Finds the axes along which no ray moves: those across the plane that light and points lie in. */
static inline void light_find_still_axes(light_packet *l)
{
    const packet *p = &l->rays;
    l->still = 0;
    for (int a = 0; a < 3; a++) {
        bool still = true;
        for (uint32_t i = 0; i < p->lanes && still; i += CGT_LANES)
            still = spux_all(spu_cmpeq(spux_load(p->dir[a] + i), spux_vfloat(0)));
        l->still |= (uint32_t)still << a;
    }
}

/* The terms of the rays that the tests of leaves need. */
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
