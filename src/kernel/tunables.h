/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Constants that tests replace, by defining them before they include a kernel: bounds are tightened until they break,
 * buffers made as small as they may be, and choices forced. The library is built with the values below. */
#ifndef CGT_TUNABLES_H
#define CGT_TUNABLES_H

#include "vector.h"

/* ---- bounds ---- */

/* The unit roundoff u of single precision, in every bound of a filter. The bounds are derived with 2^-24; they are of
 * first order in u, hold for reciprocals and roots within 2^-21, which is 8 u or 4 u, and so hold for either value. */
#ifndef FILTER_ROUNDOFF
#define FILTER_ROUNDOFF SPUX_ROUNDOFF
#endif

/* The relative error of spu_rsqrte. */
#if CGT_LANES == 16
#define TILE_RSQRT_ERROR 0x1p-14f
#else
#define TILE_RSQRT_ERROR 0x1.8p-12f
#endif

/* Factor of the slabs' error E (bvh/bvh_ray.h). */
#ifndef BVH_ERROR_SCALE
#define BVH_ERROR_SCALE 1.f
#endif

/* The error of forms between the corners of a part, in errors of the forms: derived in tile_draw/tile_double.c. */
#ifndef TILE_DOUBLE_ERROR_SCALE
#define TILE_DOUBLE_ERROR_SCALE 0x1p30
#endif

/* The margin of a light's frustum, as a share of the largest coordinates: derived in light/light_packet.h. */
#ifndef LIGHT_MARGIN
#define LIGHT_MARGIN 0x1p-17f
#endif

/* What is added to it for products that underflow. */
#ifndef LIGHT_UNDERFLOW
#define LIGHT_UNDERFLOW 0x1p-100f
#endif

/* ---- buffers ---- */

/* Words of a stream's arena that lists may take. */
#ifndef STREAM_ARENA_USED
#define STREAM_ARENA_USED CGT_STREAM_ARENA
#endif

/* Entries of an interleaved ray's stack that it may take. */
#ifndef INTERLEAVED_STACK_USED
#define INTERLEAVED_STACK_USED INTERLEAVED_STACK
#endif

/* ---- choices ---- */

/* A call's rays are interleaved where streams would be short: where an octant has fewer rays than the first number, or
 * than more of them if they start far apart, up to a limit. Measured, with the rays of `cgt-bench rays`. Closest
 * hits: half the growth, half the limit. */
#ifndef INTERLEAVE_MIN_RAYS
#define INTERLEAVE_MIN_RAYS 8.f
#define INTERLEAVE_SPREAD_RAYS (CGT_LANES == 16 ? 300.f : CGT_LANES == 8 ? 600.f : 1000.f)
#define INTERLEAVE_MAX_RAYS (CGT_LANES == 16 ? 160.f : CGT_LANES == 8 ? 320.f : 640.f)
#endif

/* So are a call's last octants where streams of its first ones, of as many rays, have fallen apart: where more than
 * this share of what nodes handed on went ray by ray, and the rest in lists to leaves. Measured: half or more of random
 * rays in large scenes, a third at most of shuffled rays from surfaces (16 lanes); fewer fall apart sooner. */
#ifndef INTERLEAVE_SHARE
#define INTERLEAVE_SHARE(any_hit) ((any_hit) || CGT_LANES == 4 ? 0.5f : CGT_LANES == 8 ? 0.7f : 0.8f)
#define INTERLEAVE_JUDGED_RAYS 512u
#endif

/* Work, in nodes visited and primitives tested, that a packet of a light's rays may take in the BVH before its chunk is
 * traced ray by ray. Measured. */
#ifndef LIGHT_PACKET_WORK
#define LIGHT_PACKET_WORK 160u
#endif

#endif
