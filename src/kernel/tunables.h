/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Constants that tests replace, by defining them before they include a kernel: bounds are tightened until they break,
 * room is made as small as it may be, and a choice is forced. The library is built with the values below. */
#ifndef CGT_TUNABLES_H
#define CGT_TUNABLES_H

/* ---- bounds ---- */

#ifndef FILTER_ROUNDOFF /* unit roundoff u of float */
#define FILTER_ROUNDOFF 0x1p-24f
#endif

#ifndef BVH_ERROR_SCALE /* factor of the slabs' error E (bvh_ray.h) */
#define BVH_ERROR_SCALE 1.f
#endif

#ifndef LIGHT_MARGIN /* of a light frustum's planes, as a share of its size (light_frustum.h) */
#define LIGHT_MARGIN 0x1p-17f
#endif

/* ---- room ---- */

#ifndef STREAM_ARENA_USED /* words of a stream's arena that lists may take */
#define STREAM_ARENA_USED CGT_STREAM_ARENA
#endif

#ifndef INTERLEAVED_STACK_USED /* entries of an interleaved ray's stack that it may take */
#define INTERLEAVED_STACK_USED INTERLEAVED_STACK
#endif

/* ---- choices ---- */

/* A call's rays are interleaved where streams would be short: where an octant has fewer rays than the first number, or
 * than more of them if they start far apart, up to a limit. Measured, with the rays of `cgt-bench rays`. Closest hits:
 * half the growth, half the limit. */
#ifndef INTERLEAVE_MIN_RAYS
#define INTERLEAVE_MIN_RAYS 8.f
#define INTERLEAVE_SPREAD_RAYS (CGT_LANES == 16 ? 300.f : CGT_LANES == 8 ? 600.f : 1000.f)
#define INTERLEAVE_MAX_RAYS (CGT_LANES == 16 ? 160.f : CGT_LANES == 8 ? 320.f : 640.f)
#endif

/* ---- observation ---- */

/* Called for each leaf that a ray along ropes visits: lanes are those of a vector whose first ray is `first` of the
 * packet. */
#ifndef ROPE_VISIT
#define ROPE_VISIT(first, lanes, leaf) ((void)0)
#endif

#endif
