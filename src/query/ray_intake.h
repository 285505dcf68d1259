/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How rays come in: what the callers' arrays hold, and what a ray is worth. No other text decides that: arrays,
 * packets, streams, single rays, points against a light and bands ask here, one ray at a time or, in kernels, a vector
 * of them.
 *
 *   invalid   a number is not finite, the direction is zero, or an end of the range is not a number; such rays count
 *   off       no float t is in the range
 *   unusual   valid, but beyond the limits of the caller's bounds: such a ray goes its own way (kernel/moved)
 *   plain     all others */
#ifndef CGT_RAY_INTAKE_H
#define CGT_RAY_INTAKE_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include <cgt/cgt.h>

#include "exact/decide.h"
#include "model/primitives.h"

/* ---- arrays ---- */

/* The source of rays. With a light, the arrays' directions are not read: rays run from their origins to it. */
typedef struct ray_source {
    const cgt_rays *rays;
    size_t stride, vector_stride;
    const cgt_light *light; /* NULL: none */
    float t_max;            /* of rays without one of their own */
} ray_source;

/* The t at which rays end that have no end of their own: at a point's light it is 1. */
static inline float ray_end(const cgt_light *light) { return light && light->kind == CGT_LIGHT_POINT ? 1 : INFINITY; }

/* Strides of the caller's with the defaults in place of zeros. */
static inline size_t ray_stride(size_t stride) { return stride ? stride : sizeof(float); }
static inline size_t ray_vector_stride(size_t vector_stride, size_t stride)
{
    return vector_stride ? vector_stride : ray_stride(stride);
}

static inline ray_source ray_source_init(const cgt_rays *rays, const cgt_light *light)
{
    return (ray_source){rays, ray_stride(rays->stride), ray_vector_stride(rays->vector_stride, rays->stride), light,
                        ray_end(light)};
}

/* Whether all arrays are without gaps. */
static inline bool ray_source_is_dense(const ray_source *s)
{
    return s->stride == sizeof(float) && s->vector_stride == sizeof(float);
}

static inline float ray_element(const float *array, size_t stride, uint64_t i)
{
    return *(const float *)(const void *)((const char *)array + i * stride);
}

/* Of origins and directions. */
static inline float ray_component(const ray_source *s, const float *array, uint64_t i)
{
    return ray_element(array, s->vector_stride, i);
}

static inline uint32_t ray_number(const ray_source *s, const uint32_t *array, uint64_t i)
{
    return *(const uint32_t *)(const void *)((const char *)array + i * s->stride);
}

/* The direction's component along an axis. Towards a point it is one difference, rounded once. */
static inline float ray_direction(const ray_source *s, uint64_t i, int a, float o)
{
    if (!s->light)
        return ray_component(s, s->rays->dir[a], i);
    return s->light->kind == CGT_LIGHT_POINT ? s->light->position[a] - o : s->light->position[a];
}

/* A t of minus infinity is no hit: where a sphere's first root is one, its second may still be a hit. */
static inline float ray_begin(float t_min) { return t_min < -FLT_MAX ? -FLT_MAX : t_min; }

static inline cgt_ray ray_read(const ray_source *s, uint64_t i)
{
    const cgt_rays *r = s->rays;
    cgt_ray ray = {.t_min = r->t_min ? ray_begin(ray_element(r->t_min, s->stride, i)) : 0,
                   .t_max = r->t_max ? ray_element(r->t_max, s->stride, i) : s->t_max};
    for (int a = 0; a < 3; a++) {
        ray.line.org[a] = ray_component(s, r->org[a], i);
        ray.line.dir[a] = ray_direction(s, i, a, ray.line.org[a]);
    }
    return ray;
}

/* The mask of a ray: 0 stands for all bits. */
static inline uint32_t ray_read_mask(const ray_source *s, uint64_t i)
{
    const uint32_t mask = s->rays->mask ? ray_number(s, s->rays->mask, i) : 0;
    return mask ? mask : UINT32_MAX;
}

/* The primitive that a ray skips; CGT_INVALID_ID: none. */
static inline uint32_t ray_read_skip(const cgt_primitives *prims, const ray_source *s, uint64_t i)
{
    const cgt_rays *r = s->rays;
    const uint32_t primitive = r->skip_primitive ? ray_number(s, r->skip_primitive, i) : CGT_INVALID_ID;
    if (primitive == CGT_INVALID_ID)
        return CGT_INVALID_ID;
    return cgt_primitives_number(prims, r->skip_geometry ? ray_number(s, r->skip_geometry, i) : 0, primitive);
}

static inline cgt_ray ray_of_single(const cgt_single_ray *from)
{
    cgt_ray ray = {.t_min = ray_begin(from->t_min), .t_max = from->t_max == 0 ? INFINITY : from->t_max};
    for (int a = 0; a < 3; a++) {
        ray.line.org[a] = from->org[a];
        ray.line.dir[a] = from->dir[a];
    }
    return ray;
}

/* ---- worth ---- */

typedef enum ray_state { RAY_PLAIN, RAY_UNUSUAL, RAY_OFF, RAY_INVALID } ray_state;

/* Within these a ray is plain: the size of each coordinate of its origin, and its direction's largest component. */
typedef struct ray_limits {
    float max_org, min_dir, max_dir;
} ray_limits;

#define RAY_NO_LIMITS ((ray_limits){INFINITY, 0, INFINITY})

/* The bits of |x|, in the order of the magnitudes; from RAY_NOT_FINITE on x is infinite or not a number. */
#define RAY_NOT_FINITE 0x7f800000u

static inline uint32_t ray_magnitude(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits & 0x7fffffffu;
}

static inline uint32_t ray_larger(uint32_t a, uint32_t b) { return a > b ? a : b; }

/* Whether a ray's origin and direction are valid. Without branches: loops over it become vectors. */
static inline uint32_t ray_line_is_valid(const float org[3], const float dir[3])
{
    uint32_t farthest = 0, longest = 0;
    for (int a = 0; a < 3; a++) {
        farthest = ray_larger(farthest, ray_magnitude(org[a]));
        longest = ray_larger(longest, ray_magnitude(dir[a]));
    }
    return (ray_larger(farthest, longest) < RAY_NOT_FINITE) & (longest > 0);
}

/* PLAIN, OFF or INVALID */
static inline ray_state ray_classify_range(float t_min, float t_max)
{
    if (t_min != t_min || t_max != t_max)
        return RAY_INVALID;
    return t_min > t_max || t_min > FLT_MAX || t_max < -FLT_MAX ? RAY_OFF : RAY_PLAIN;
}

static inline ray_state ray_classify(const cgt_ray *ray, const ray_limits *limits)
{
    const ray_state range = ray_classify_range(ray->t_min, ray->t_max);
    float farthest = 0, longest = 0;
    for (int a = 0; a < 3; a++) {
        const float o = fabsf(ray->line.org[a]), d = fabsf(ray->line.dir[a]);
        /* selections, not fmaxf: that is a call */
        farthest = o > farthest ? o : farthest;
        longest = d > longest ? d : longest;
    }
    if (!ray_line_is_valid(ray->line.org, ray->line.dir))
        return RAY_INVALID;
    if (range != RAY_PLAIN)
        return range;
    return farthest > limits->max_org || longest > limits->max_dir || longest < limits->min_dir ? RAY_UNUSUAL
                                                                                                : RAY_PLAIN;
}

/* ---- a vector of rays ---- */

#ifdef CGT_LANES /* in kernels */
#include "vector.h"

typedef struct ray_lanes {
    vfloat org[3], dir[3], t_min, t_max;
} ray_lanes;

/* Elements i to i + count - 1 of an array; 0 beyond. */
CGT_SPU_INLINE vfloat ray_load_elements(const float *array, size_t stride, uint64_t i, uint32_t count)
{
    _Alignas(CGT_VECTOR_BYTES) float row[CGT_LANES];
    if (stride == sizeof(float))
        return count == CGT_LANES ? spux_load_unaligned(array + i) : spux_load_mask(array + i, spux_mask_first(count));
    for (uint32_t k = 0; k < CGT_LANES; k++)
        row[k] = k < count ? ray_element(array, stride, i + k) : 0;
    return spux_load(row);
}

/* Rays i to i + count - 1 of arrays that are not towards a light. */
CGT_SPU_INLINE void ray_lanes_load(const ray_source *s, uint64_t i, uint32_t count, ray_lanes *q)
{
    const cgt_rays *r = s->rays;
    for (int a = 0; a < 3; a++) {
        q->org[a] = ray_load_elements(r->org[a], s->vector_stride, i, count);
        q->dir[a] = ray_load_elements(r->dir[a], s->vector_stride, i, count);
    }
    q->t_min = r->t_min ? ray_load_elements(r->t_min, s->stride, i, count) : spux_vfloat(0);
    q->t_max = r->t_max ? ray_load_elements(r->t_max, s->stride, i, count) : spux_vfloat(INFINITY);
}

/* ray_direction towards a light */
CGT_SPU_INLINE vfloat ray_direction_lanes(const cgt_light *light, bool is_point, int a, vfloat o)
{
    const vfloat position = spux_vfloat(light->position[a]);
    return is_point ? spu_sub(position, o) : position;
}

/* As ray_classify finds them; the other lanes are plain. */
typedef struct ray_lane_states {
    vmask invalid;
    vmask off;     /* or invalid */
    vmask unusual; /* or off, or invalid */
} ray_lane_states;

CGT_SPU_INLINE vfloat ray_largest(const vfloat v[3])
{
    return spux_max(spux_abs(v[0]), spux_max(spux_abs(v[1]), spux_abs(v[2])));
}

CGT_SPU_INLINE ray_lane_states ray_classify_lanes(const ray_lanes *q, const ray_limits *limits)
{
    const vfloat zeros = spux_vfloat(0), farthest = ray_largest(q->org), longest = ray_largest(q->dir);
    ray_lane_states s;
    vfloat zero = zeros;
    for (int a = 0; a < 3; a++)
        zero = spu_madd(q->org[a], zeros, spu_madd(q->dir[a], zeros, zero)); /* NaN where one is not finite */
    const vmask ordered = spu_and(spu_cmpeq(q->t_min, q->t_min), spu_cmpeq(q->t_max, q->t_max));
    s.invalid = spux_not(spu_and(spu_and(spu_cmpeq(zero, zeros), ordered), spu_cmpgt(longest, zeros)));
    const vmask beyond = spu_or(spu_cmpgt(q->t_min, spux_vfloat(FLT_MAX)), spu_cmpgt(spux_vfloat(-FLT_MAX), q->t_max));
    s.off = spu_or(s.invalid, spu_or(spu_cmpgt(q->t_min, q->t_max), beyond));
    const vmask odd_dir =
        spu_or(spu_cmpgt(longest, spux_vfloat(limits->max_dir)), spu_cmpgt(spux_vfloat(limits->min_dir), longest));
    s.unusual = spu_or(s.off, spu_or(odd_dir, spu_cmpgt(farthest, spux_vfloat(limits->max_org))));
    return s;
}

/* What a set of rays spans, to ask once whether all are plain. */
typedef struct ray_extent {
    vfloat farthest, shortest, longest; /* coordinates of origins, largest components of directions */
    vfloat sum;                         /* not a number where any component is none */
} ray_extent;

CGT_SPU_INLINE ray_extent ray_extent_init(void)
{
    return (ray_extent){spux_vfloat(0), spux_vfloat(INFINITY), spux_vfloat(0), spux_vfloat(0)};
}

CGT_SPU_INLINE void ray_extent_add(ray_extent *e, const vfloat org[3], const vfloat dir[3])
{
    const vfloat length = ray_largest(dir);
    e->farthest = spux_max(e->farthest, ray_largest(org));
    e->shortest = spux_min(e->shortest, length);
    e->longest = spux_max(e->longest, length);
    for (int a = 0; a < 3; a++)
        e->sum = spu_add(e->sum, spu_add(org[a], dir[a]));
}

/* Whether all rays are plain, if their ranges are. The limits must be finite: a sum that overflows is beyond them. */
CGT_SPU_INLINE bool ray_extent_is_plain(const ray_extent *e, const ray_limits *limits)
{
    const vmask lengths = spu_and(spux_cmpge(e->shortest, spux_vfloat(limits->min_dir)),
                                  spux_cmpge(spux_vfloat(limits->max_dir), e->longest));
    return spux_all(
        spu_and(spu_and(lengths, spu_cmpeq(e->sum, e->sum)), spux_cmpge(spux_vfloat(limits->max_org), e->farthest)));
}
#endif

#endif
