/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What makes a ray to a point of a small scene hard. */
#ifndef HARD_RAYS_H
#define HARD_RAYS_H

#include "support/oracle/truth.h"
#include "support/random.h"

/* Turns the ray so that it runs to a point along an axis of coordinates: a tangent, or in a plane, of what is aligned
 * with it. */
void hard_ray_align(test_random *random, const float at[3], truth_ray *ray);

/* Gives one ray of three a direction of any length. */
void hard_ray_stretch(test_random *random, truth_ray *ray);

/* The ray of a hit at t again, with a range that begins or ends there. */
truth_ray hard_ray_cut(test_random *random, truth_ray ray, float t);

#endif
