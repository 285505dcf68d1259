/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A packet: up to 256 rays as structure of arrays, with the best hit of each so far.
 *
 * Filter, then decide. Single precision finds for a ray and a primitive an interval that certainly holds the exact t,
 * or that there certainly is no hit. So a ray's best hit is an interval too, [low, high] with the primitive that it
 * belongs to:
 *   a hit whose interval ends before `low`    is certainly nearer: it replaces the best at once
 *   a hit whose interval starts after `high`  is certainly not
 *   anything else                             is decided (decide.h) by the exact t, then by the lower primitive
 * The closest hit's t is computed once, at the end. A fast packet decides nothing (cgt_triangle_test): low and high are
 * the t that single precision gives, and u and v are stored with it. An active ray starts with [t_max, t_max] and no
 * primitive; one that takes no part has [-inf, -inf]. */
#ifndef CGT_PACKET_H
#define CGT_PACKET_H

#include <math.h>
#include <stdbool.h>

#include "dispatch/kernel.h"
#include "kernel/tunables.h"
#include "vector.h"

/* A packet of 256 rays takes 24 KB. Programs for a small local store define less, in multiples of 16, a block. */
#ifndef PACKET_MAX_RAYS
#define PACKET_MAX_RAYS 256
#endif

typedef struct packet {
    _Alignas(64) float org[3][PACKET_MAX_RAYS];
    _Alignas(64) float dir[3][PACKET_MAX_RAYS];
    _Alignas(64) float rdd[PACKET_MAX_RAYS]; /* 1 / dir.dir */
    _Alignas(64) float t_min[PACKET_MAX_RAYS];
    _Alignas(64) float t_max[PACKET_MAX_RAYS];
    _Alignas(64) float low[PACKET_MAX_RAYS];
    _Alignas(64) float high[PACKET_MAX_RAYS];
    _Alignas(64) uint32_t prim[PACKET_MAX_RAYS];               /* CGT_INVALID_ID: none yet */
    _Alignas(64) float u[PACKET_MAX_RAYS], v[PACKET_MAX_RAYS]; /* of a triangle, where fast */
    _Alignas(64)
        uint32_t skip_prim[PACKET_MAX_RAYS]; /* where selective: a primitive that the ray does not find, CGT_INVALID_ID:
                                                       none; and its mask */
    _Alignas(64) uint32_t mask[PACKET_MAX_RAYS];
    /* only for triangles of packets without a common origin: */
    _Alignas(64) float length[PACKET_MAX_RAYS];    /* of dir, rounded up */
    _Alignas(64) float from[3][PACKET_MAX_RAYS];   /* org seen from the filter's origin */
    _Alignas(64) float moment[3][PACKET_MAX_RAYS]; /* from x dir, times the grid's scale */
    uint32_t rays;                                 /* that take part; they need not come first */
    uint32_t lanes;     /* a multiple of CGT_LANES; the rest is padding that repeats a ray of the packet */
    bool common_origin; /* org[.][0] is the origin of all */
    bool from_origin;   /* and all start there: t_min is 0 */
    bool to_light;      /* all run from their origins to `light`, where t is 1, but for rounding */
    float light[3];
    bool skips_prims;                /* some ray ignores a primitive, or has a mask that leaves one out */
    bool has_masks;                  /* selective, by masks too */
    bool any_hit;                    /* the first hit found closes a ray */
    bool fast;                       /* single precision decides */
    cgt_triangle_test triangle_test; /* AUTO unless fast */
    bool extreme;                    /* some number is beyond these limits: rays one by one */
} packet;

/* Largest coordinate and the range of direction lengths for which the bounds of the filter hold. */
#define PACKET_MAX_COORDINATE 0x1p55f
#define PACKET_MIN_DIR 0x1p-55f
#define PACKET_MAX_DISTANCE 0x1p12f /* of origins, where the scene's coordinates are at most 2 */

/* The entries of cgt_kernel that kernels call, too. */
cgt_trace_region_fn CGT_KERNEL(cgt_trace_region), CGT_KERNEL(cgt_trace_tile);

/* Finds the hits of all rays of the packet: through the committed structure, or through a given one. */
typedef void cgt_trace_packet_fn(const cgt_committed_scene *committed_scene, packet *p,
                                 const cgt_trace_settings *settings, cgt_counts *counts);
cgt_trace_packet_fn CGT_KERNEL(cgt_packet_trace), CGT_KERNEL(cgt_papers_trace);

/* Finds the hit of one ray of any finite numbers, as the caller described it: one that the bounds of packets and
 * streams do not cover. Returns its primitive; CGT_INVALID_ID: none. use_bvh: through the BVH, else the commit's
 * structure. skip_prim: a primitive that it ignores, or CGT_INVALID_ID. mask: all bits hide nothing. */
typedef struct cgt_ray cgt_ray;
uint32_t CGT_KERNEL(cgt_trace_unusual)(const cgt_committed_scene *committed_scene, const cgt_ray *ray, bool use_bvh,
                                       uint32_t skip_prim, uint32_t mask, bool any_hit, cgt_counts *counts);

/* Lists the hits of such rays. */
cgt_list_hits_fn CGT_KERNEL(cgt_list_unusual);

/* The same of any ray at all: a plain one takes the way of single precision through the BVH, if use_bvh is set. Counts
 * it where it is invalid. */
uint32_t CGT_KERNEL(cgt_ray_trace)(const cgt_committed_scene *committed_scene, const cgt_ray *ray, bool use_bvh,
                                   uint32_t skip_prim, uint32_t mask, bool any_hit, cgt_counts *counts);

/* Points against a light, through a loose grid and through the BVH. */
cgt_trace_light_fn CGT_KERNEL(cgt_tile_trace_light), CGT_KERNEL(cgt_bvh_trace_light);

/* Arrays of rays through the BVH. */
cgt_trace_rays_fn CGT_KERNEL(cgt_bvh_trace_rays);

/* The hits of a packet, ready to be handed out, by their names or plane by plane. */
typedef union packet_hits {
    struct {
        _Alignas(64) float t[PACKET_MAX_RAYS];
        uint32_t primitive[PACKET_MAX_RAYS], geometry[PACKET_MAX_RAYS];
        float normal[3][PACKET_MAX_RAYS];
        float u[PACKET_MAX_RAYS], v[PACKET_MAX_RAYS];
    };
    uint32_t plane[CGT_PLANES][PACKET_MAX_RAYS];
} packet_hits;

/* Computes the requested fields of the closest hits, canonically. Counts the hits and returns how many. */
uint32_t CGT_KERNEL(cgt_packet_resolve)(const cgt_committed_scene *committed_scene, const packet *p,
                                        const cgt_trace_settings *settings, packet_hits *hits, cgt_counts *counts);

#endif
