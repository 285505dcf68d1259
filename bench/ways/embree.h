/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree 3 as a tracer, where it is installed. The library itself never uses it.
 *   scenes, and the interface of tracers     embree_tracer.c
 *   the camera's rays in packets             embree_view.c
 *   arrays of rays                           embree_arrays.c
 *   spheres as user geometry, by vectors     embree_spheres.c, once per row of the variant table */
#ifndef BENCH_EMBREE_H
#define BENCH_EMBREE_H

#include <embree3/rtcore.h>

#include "ways/bench_tracer.h"

/* Where the fields of N rays and their hits lie in Embree's structures: field * N + ray. */
enum {
    EMBREE_ORG = 0, /* x, y, z */
    EMBREE_NEAR = 3,
    EMBREE_DIR = 4, /* x, y, z */
    EMBREE_FAR = 8,
    EMBREE_MASK = 9,
    EMBREE_ID = 10,
    EMBREE_NORMAL = 12, /* x, y, z, not of unit length */
    EMBREE_PRIMITIVE = 17,
    EMBREE_GEOMETRY = 18,
    EMBREE_INSTANCE = 19,
    EMBREE_WORDS = 20
};

/* The hits of a frame. Those of a packet are neighbours, packets go row by row: Embree's own layout is stored as it
 * is. */
typedef struct embree_hits {
    float *t;
    uint32_t *primitive;
    float *normal[3];
    void *memory; /* of all of them; NULL: there is no view */
    size_t count; /* including the part of packets at the right and lower edge that is outside the picture */
} embree_hits;

typedef struct embree_view {
    bench_camera_axes axes;
    uint32_t packet;        /* rays: 1, 4, 8 or 16 */
    uint32_t width, height; /* pixels of a packet */
    uint32_t across, down;  /* packets */
    embree_hits hits;
    bench_picture *picture; /* is shaded in place of hits that are stored; NULL: hits are stored */
} embree_view;

/* 0, or -1 where memory is refused. */
int embree_view_create(embree_view *view, const bench_camera_axes *axes, uint32_t packet);
void embree_view_release(embree_view *view);

/* All primary rays, on all threads. */
void embree_view_trace(embree_view *view, RTCScene scene, cgt_context *context);

/* The hits in row order. */
void embree_view_planes(const embree_view *view, const bench_planes *planes);

/* How arrays of rays are traced. */
typedef struct embree_arrays {
    RTCScene scene;
    cgt_context *context;
    uint32_t packet; /* rays: 1, 4, 8 or 16; 0: streams, for any hit alone */
    int coherent;    /* as Embree is told */
    int nearest;     /* else any hit */
    int four;        /* the first four hits, by a filter */
    const cgt_rays *batch;
    uint8_t *occluded; /* 1: a hit; BENCH_FOUR_HITS of each ray where four */
} embree_arrays;

/* On all threads; on the calling thread alone, which leaves `arrays` as it is. */
void embree_arrays_trace(embree_arrays *arrays, const cgt_rays *batch, uint8_t *occluded);
void embree_arrays_trace_here(const embree_arrays *arrays, const cgt_rays *batch, uint8_t *occluded);

/* The callbacks of spheres as user geometry, for one width of vectors. */
typedef struct embree_callbacks {
    RTCIntersectFunctionN intersect;
    RTCOccludedFunctionN occluded;
} embree_callbacks;

/* Any number of rays against one sphere; the user data are spheres as x, y, z, r. Each with the vectors of a row of the
 * variant table. */
typedef void embree_sphere_intersect(const struct RTCIntersectFunctionNArguments *arguments);
typedef void embree_sphere_occluded(const struct RTCOccludedFunctionNArguments *arguments);
embree_sphere_intersect embree_sphere_intersect_portable, embree_sphere_intersect_sse, embree_sphere_intersect_neon,
    embree_sphere_intersect_avx2, embree_sphere_intersect_avx512;
embree_sphere_occluded embree_sphere_occluded_portable, embree_sphere_occluded_sse, embree_sphere_occluded_neon,
    embree_sphere_occluded_avx2, embree_sphere_occluded_avx512;

#endif
