/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The BVH beside a loose grid: AUTO builds it when rays need it. */
#ifndef CGT_BVH_ON_DEMAND_H
#define CGT_BVH_ON_DEMAND_H

#include "scene/scene.h"

#define CGT_RAY_WORK 64u /* references that a ray reads in an even grid: who reads more counts as several rays */

/* Announces incoherent rays of a committed scene; any thread may. is_built: gets whether they may traverse the scene's
 * BVH; where it is false, another thread may be building that. Where AUTO chose a loose grid, and enough rays have come
 * since the commit, the tree is built first, by the context's threads. Fails with OUT_OF_MEMORY or TOO_LARGE, with a
 * message; the scene is as it was. */
cgt_result cgt_bvh_build_on_demand(const cgt_scene *scene, uint64_t rays, bool *is_built);

/* Rays that have still to come for a BVH to be built: 0 if it is built, UINT32_MAX if it cannot be. */
uint64_t cgt_bvh_rays_left(const cgt_scene *scene);

#endif
