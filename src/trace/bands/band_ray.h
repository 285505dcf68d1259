/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray and the bands of a scene (scene/bands.h).
 *
 * Scaled rays. A band's coordinates are the caller's times K = 2^k. The origin is multiplied by K, the direction by a
 * power of two Q of its own, near K, that keeps its length within the range of the filters. The line is then the same
 * one, scaled, and t' = t 2^x with x = k - log2 Q. The products must be exact: no bit may fall below 2^-149. All terms
 * of a decision are homogeneous in the coordinates and in the direction, in double (no term of which leaves its range)
 * as in whole numbers. So the band decides hit or miss, and the order of its hits, as they are for the ray as given,
 * and the canonical t' is the canonical t times 2^x, bit for bit.
 *
 * Ranges. t is rounded to float before it is compared, which commutes with 2^x only while t and t' are normal floats.
 * So where x is not 0 the band gets a range that is a little too wide: the ends' boundaries of rounding, times 2^x,
 * rounded outwards. A hit that it finds is the nearest in the wider range. If its t lies in the range as given, it is
 * the nearest there, too. If not, which takes a t within an ulp of an end, the band's primitives are decided one by
 * one. Any hit would not tell its t, and is asked for only where x is 0.
 *
 * Rays as given. Where a product is not exact, the ray is tested against the band's box in double, and where it may
 * meet that, decided against each of its primitives. So are rays whose origins lie so far from the band that its
 * structure would do no better, before they go there. */
#ifndef CGT_BAND_RAY_H
#define CGT_BAND_RAY_H

#include "exact/decide.h"
#include "query/camera.h"
#include "query/trace_settings.h"
#include "scene/bands.h"

/* Origins in a band's units up to this are within what all kernels take for ordinary. */
#define CGT_BAND_MAX_ORG 0x1p54f

/* The largest exponent of a scaled direction, and the smallest one's negative. Any hit through a BVH takes more: the
 * more directions may take the coordinates' power, the more ranges stay as they are. */
#define CGT_BAND_DIR_EXPONENT 24
#define CGT_BAND_ANY_DIR_EXPONENT 50

/* A ray of the call. */
typedef struct cgt_band_ray {
    cgt_ray ray;
    uint32_t mask; /* all bits set: sees everything */
    uint32_t skip; /* a primitive of the scene that it does not find; CGT_INVALID_ID: none */
} cgt_band_ray;

/* The best hit so far. t: canonical, or within 2^-20 of itself. */
typedef struct cgt_band_best {
    uint32_t prim; /* CGT_INVALID_ID: none */
    double t;
} cgt_band_best;

typedef struct cgt_scaled_ray {
    float org[3], dir[3], t_min, t_max;
    int exponent; /* x */
} cgt_scaled_ray;

typedef enum cgt_band_state { CGT_BAND_MISSED = 0, CGT_BAND_SCALED, CGT_BAND_AS_GIVEN } cgt_band_state;

/* Whether the ray certainly meets nothing of the band at a t up to t_end. */
bool cgt_band_misses_box(const cgt_band *band, const cgt_ray *ray, double t_end);

/* Three numbers times 2^exponent. Returns whether none has lost a bit. */
bool cgt_band_scale(const float v[3], int exponent, float scaled[3]);

/* The range of a ray in a band with t' = t 2^x: where x is not 0, a little wider than the given one. */
void cgt_band_scale_range(float t_min, float t_max, int x, float *scaled_min, float *scaled_max);

/* Scales a ray. t_end: hits beyond it do not count either. */
cgt_band_state cgt_band_scale_ray(const cgt_band *band, const cgt_ray *ray, double t_end, int dir_exponent,
                                  cgt_scaled_ray *scaled);

/* The band's names of the primitive of the scene that a ray skips; CGT_INVALID_ID where the band has none such. */
void cgt_band_scale_skip(const cgt_band *band, uint32_t skip, uint32_t *primitive, uint32_t *geometry);

/* A point's ray to a scaled light: the band computes the direction, the same difference times 2^exponent, rounded to
 * the same bits: a difference of floats that is below the normal ones is exact. So t is the caller's. Returns whether
 * the point has a place in the band's units. */
bool cgt_band_scale_point(const cgt_band *band, const cgt_ray *ray, cgt_scaled_ray *scaled);

/* Returns whether a light that has a place has one in the band's units. */
bool cgt_band_scale_light(const cgt_band *band, const cgt_light *light, cgt_light *scaled);

/* Scales a camera: the caller's directions and a scaled eye. Returns whether its rays are exactly the scaled ones, and
 * no hit is lost at the range's begin. */
bool cgt_band_scale_camera(const cgt_band *band, const cgt_camera_rays *from, cgt_camera_rays *scaled);

/* The t up to which hits count. */
double cgt_band_end(const cgt_ray *ray, const cgt_band_best *best);

/* Decides a list of primitives for the ray as given, one by one; hits that beat *best replace it. any_hit: the first
 * one will do. */
void cgt_band_decide(const cgt_primitives *prims, const uint32_t *number, uint32_t count, const cgt_band_ray *ray,
                     bool any_hit, cgt_band_best *best, cgt_counts *counts);

/* Takes the hit that a band has found in a scaled range, at t', against *best. */
void cgt_band_accept(const cgt_primitives *prims, const cgt_band *band, const cgt_band_ray *ray, uint32_t prim,
                     float scaled_t, int exponent, cgt_band_best *best, cgt_counts *counts);

/* Whether t', a float, tells t within 2^-20, and that t, rounded to float, lies in the range. */
static inline bool cgt_band_t_is_plain(double scaled_t, double t, float t_min, float t_max)
{
    const double margin = (t < 0 ? -t : t) * 0x1p-20 + 0x1p-148;
    return (scaled_t >= 0x1p-120 || scaled_t <= -0x1p-120) && t - margin > (double)t_min &&
           t + margin < (double)t_max && t + margin < 0x1p127 && t - margin > -0x1p127;
}

/* 2^exponent, of which no result leaves the range of normal doubles here. */
static inline double cgt_power_of_two(int exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

#endif
