/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A packet of 4x4 rays with the best hit of each so far, and what a march needs of the grid, seen along an axis. */
#ifndef GRID_PACKET_H
#define GRID_PACKET_H

#include "cell/programs/grid/grid_words.h"

/* Vector y holds row y of the pixels. As kernel/packet/packet.h has it, the best hit is an interval of t: a ray starts
 * with [t_max, t_max], one that takes no part has GRID_CLOSED twice. */
typedef struct grid_packet {
    vec_float4 org[3][4]; /* a camera's have none: theirs is the camera's */
    vec_float4 dir[3][4];
    vec_float4 rdd[4]; /* 1 / dir.dir */
    vec_float4 low[4], high[4];
    vec_uint4 prim[4]; /* a camera's: the best so far, CGT_INVALID_ID: none; else the one that the ray ignores */
} grid_packet;

#define GRID_CLOSED -0x1p45f /* below the t of all hits and ranges, and products with it still are numbers */

/* Rays of one main axis w and direction, 2 * w + reverse: u and v are the other axes, x before y before z, and w counts
 * along the rays. */
#define GRID_CLASSES 6u

/* Grid space of a class, each number in all lanes; "four" are those of the lower bounds of u, -u, v, -v. */
typedef struct grid_axes {
    vec_uchar16 order;                      /* shuffles x, y, z, r to u, v, w, r */
    vec_float4 org[3], rcell[3], w_offset;  /* of u, v, w: p is at (p - org) * rcell, plus w_offset */
    vec_float4 w_rcell, w_unit;             /* without sign; rounded up */
    vec_float4 ratio[2];                    /* u, v: cells of them per cell of w, where slopes are 1 */
    vec_float4 error_four, w_error;         /* cell_error */
    vec_float4 rcell_four, slope_four;      /* of u, u, v, v; cells of w per cell of them */
    vec_float4 limit_four;                  /* a bound above it is outside */
    vec_float4 last[2];                     /* cells of u, v */
    vec_int4 first_cell, w_step, stride[2]; /* cells: of slice 0; to the next slice, to the next of u, v */
    vec_uint4 w_sign;                       /* that makes directions positive */
    uint32_t u, v, w, slices;
    /* of the camera */
    vec_float4 eye[3], eye_four;              /* u, v, w; u, -u, v, -v */
    vec_float4 w0, along[2], rlength, w_near; /* the planes from the eye; 1 / their distance */
    vec_float4 w_reach;                       /* |eye's w| + w1 */
    uint32_t first;                           /* slice; `slices` where the eye lies beyond the grid */
} grid_axes;

/* The frustum of a packet (papers/kernel/packet/frustum.h), all lanes alike: bound and step are lines over w. */
typedef struct grid_frustum {
    vec_float4 bound[4], step[4];           /* of u, -u, v, -v, at w0 and per slice */
    vec_float4 inside[4];                   /* bound less the error of a sphere's distance */
    vec_float4 reach[4], w_reach;           /* cells that a unit of radius takes */
    vec_float4 error;                       /* plane_error */
    vec_float4 t_unit, t_root, t_underflow; /* of spheres' intervals: 18 u, sqrt and 2^-62, over |d| */
    vec_float4 org[3], org_reach;           /* of the rays: one, and how far the others are, in the 1-norm */
    vec_float4 w0, w_near, w_far;           /* no ray starts before, or has a use for hits beyond */
    uint32_t first, end;                    /* slices */
} grid_frustum;

#endif
