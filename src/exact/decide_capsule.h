/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decisions about capsules, and the canonical values of their hits; see decide.h. */
#ifndef CGT_DECIDE_CAPSULE_H
#define CGT_DECIDE_CAPSULE_H

#include "exact/decide.h"

/* In how many places the line of the ray meets the capsule's surface, up to 2. */
int cgt_decide_capsule_roots(const cgt_ray *ray, const cgt_capsule *capsule, uint64_t *exact);

/* Whether the line of the ray meets hit->primitive, a capsule; if so, t, far and part as cgt_canonical_capsule_t. */
bool cgt_decide_capsule_hit(const cgt_ray *ray, cgt_decided_hit *hit, uint64_t *exact);

/* The first t at or after t_min where the ray, whose line meets the capsule, enters or leaves it. *far: it leaves;
 * *part: where. */
double cgt_canonical_capsule_t(const cgt_ray *ray, const cgt_capsule *capsule, bool *far, cgt_capsule_part *part);

/* The t where the line of the ray, which meets the capsule, leaves it. */
double cgt_canonical_capsule_far(const cgt_ray *ray, const cgt_capsule *capsule, cgt_capsule_part *part);

/* u along the axis, 0 at p and 1 at q, where the ray enters or leaves the part: at most 0.51 ulp off. */
float cgt_canonical_capsule_u(const cgt_ray *ray, const cgt_capsule *capsule, bool far, cgt_capsule_part part);

/* The outward unit normal there. A capsule of radius 0 has none: it gets the direction towards the ray's origin. */
void cgt_canonical_capsule_normal(const cgt_ray *ray, const cgt_capsule *capsule, double t, cgt_capsule_part part,
                                  float normal[3]);

#endif
