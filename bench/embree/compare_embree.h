/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * compare-embree: Embree 3 on the files and cameras of cgt-bench frame, timed in the same way.
 *   command line, rows                       compare_embree.c
 *   scenes, packets of the camera's rays     compare_embree_trace.c
 *   arrays of rays                           compare_embree_rays.c
 *   spheres as user geometry, by vectors     compare_embree_spheres.c, once per row of the variant table */
#ifndef COMPARE_EMBREE_H
#define COMPARE_EMBREE_H

#include <embree3/rtcore.h>

#include "common/bench.h"
#include "common/bench_input.h"
#include "rays/bench_planes.h"
#include "rays/bench_rays.h"
#include "rays/bench_shade.h"
#include "common/bench_threads.h"

/* Where the fields of N rays and their hits lie in Embree's structures: field * N + ray. */
enum {
    EMBREE_ORG = 0, /* x, y, z */
    EMBREE_NEAR = 3,
    EMBREE_DIR = 4, /* x, y, z */
    EMBREE_FAR = 8,
    EMBREE_MASK = 9,
    EMBREE_NORMAL = 12, /* x, y, z, not of unit length */
    EMBREE_PRIMITIVE = 17,
    EMBREE_GEOMETRY = 18,
    EMBREE_INSTANCE = 19,
    EMBREE_WORDS = 20
};

typedef enum embree_quality { EMBREE_LOW, EMBREE_MEDIUM, EMBREE_REFIT, EMBREE_QUALITIES } embree_quality;

/* The hits of a frame. Those of a packet are neighbours, packets go row by row: Embree's own layout is stored as it is.
 * */
typedef struct embree_hits {
    float *t;
    uint32_t *primitive;
    float *normal[3];
    void *memory; /* of all of them */
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
int embree_view_create(embree_view *view, const bench_settings *settings, uint32_t packet);
void embree_view_release(embree_view *view);

/* All primary rays, on all threads. */
void embree_view_trace(embree_view *view, RTCScene scene, bench_threads *threads);

/* The hits in row order. */
void embree_view_planes(const embree_view *view, bench_planes *planes);

/* Traces arrays of shadow and ambient-occlusion rays instead of the library, see bench_rays_set_sink. */
typedef struct embree_arrays {
    RTCScene scene;
    bench_threads *threads;
    uint32_t packet; /* rays: 1, 4, 8 or 16 */
    int coherent;    /* as Embree is told */
    int nearest;     /* else any hit */
    const cgt_rays *batch;
    uint8_t *occluded;
} embree_arrays;

cgt_result embree_arrays_trace(void *arrays, const cgt_rays *batch, uint8_t *occluded);

/* The same on the calling thread alone, see bench_rays_set_tile_sink. */
cgt_result embree_arrays_trace_tile(void *arrays, const cgt_rays *batch, uint8_t *occluded);

/* The callbacks of spheres as user geometry, for one width of vectors. */
typedef struct embree_callbacks {
    RTCIntersectFunctionN intersect;
    RTCOccludedFunctionN occluded;
} embree_callbacks;

/* One scene over moving spheres or triangles. */
typedef struct embree_moving {
    RTCScene scene;
    RTCGeometry geometry;
    const bench_input *input;
    float *moving; /* padded, since Embree reads whole vectors */
    int user;
    uint32_t held; /* elements that the geometry has */
} embree_moving;

/* user: spheres by the callbacks below, not by Embree's own type. -1 where memory is refused, or Embree does. */
int embree_moving_create(embree_moving *moving, RTCDevice device, const bench_input *input, embree_quality quality,
                         int user, int robust, const embree_callbacks *callbacks);
void embree_moving_release(embree_moving *moving);

/* Moves, not timed; then tells Embree and commits. */
void embree_moving_move(embree_moving *moving, size_t frame);
void embree_moving_commit(embree_moving *moving, size_t frame);

/* Any number of rays against one sphere; the user data are spheres as x, y, z, r. Each with the vectors of a row of the
 * variant table. */
typedef void embree_sphere_intersect(const struct RTCIntersectFunctionNArguments *arguments);
typedef void embree_sphere_occluded(const struct RTCOccludedFunctionNArguments *arguments);
embree_sphere_intersect embree_sphere_intersect_portable, embree_sphere_intersect_sse, embree_sphere_intersect_neon,
    embree_sphere_intersect_avx2, embree_sphere_intersect_avx512;
embree_sphere_occluded embree_sphere_occluded_portable, embree_sphere_occluded_sse, embree_sphere_occluded_neon,
    embree_sphere_occluded_avx2, embree_sphere_occluded_avx512;

#endif
