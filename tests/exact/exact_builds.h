/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The library's exact stage, compiled again so that ordinary input takes otherwise rare paths. */
#ifndef EXACT_BUILDS_H
#define EXACT_BUILDS_H

#include "exact/integer/exact.h"

typedef struct exact_build {
    const char *name;
    bool (*line_meets_triangle)(const cgt_exact_ray *ray, const cgt_triangle *triangle);
    int (*triangle_side)(const cgt_exact_ray *ray, const cgt_triangle *triangle);
    int (*sphere_roots)(const cgt_exact_ray *ray, cgt_sphere sphere);
    int (*capsule_roots)(const cgt_exact_ray *ray, const cgt_capsule *capsule, cgt_capsule_part part[2]);
    double (*capsule_u)(const cgt_exact_ray *ray, const cgt_capsule *capsule, bool far);
    int (*compare)(const cgt_exact_ray *ray, const cgt_exact_root *a, const cgt_exact_root *b);
    double (*t)(const cgt_exact_ray *ray, const cgt_exact_root *root);
    void (*uv)(const cgt_exact_ray *ray, const cgt_triangle *triangle, double uv[2]);
    void (*normal)(const cgt_triangle *triangle, double normal[3]);
    int (*crossing)(const cgt_exact_ray *ray, const cgt_triangle *triangle);
    int (*crossing_t_sign)(const cgt_exact_ray *ray, const cgt_triangle *triangle);
} exact_build;

extern const exact_build exact_counted; /* same as the library's; counts the tiers that it reaches */
extern const exact_build exact_wide;    /* without the narrow tier */
extern const exact_build exact_halves;  /* without 128-bit integers: limbs of 32 bits */

typedef enum exact_tier {
    EXACT_TIER_128,  /* triple products in 128 bits */
    EXACT_TIER_192,  /* in 192 bits */
    EXACT_TIER_wide, /* in as many bits as needed */
    EXACT_TIER_dot,  /* dot products in 128 bits */
    EXACT_TIER_wide_dot,
    EXACT_TIERS
} exact_tier;

extern uint64_t exact_reached[EXACT_TIERS];

#endif
