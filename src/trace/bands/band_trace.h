/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Calls that trace a scene in bands: arrays of rays, points against a light, and frames of a camera. What the tasks of
 * a call share, and their scratch memory. */
#ifndef CGT_BAND_TRACE_H
#define CGT_BAND_TRACE_H

#include "core/scratch_tasks.h"
#include "dispatch/kernel.h"
#include "query/region.h"
#include "trace/bands/band_ray.h"

/* ---- calls ---- */

/* What one task needs for its rays: planes of `capacity` elements. */
typedef struct cgt_band_scratch {
    uint32_t capacity;
    float *org[3], *dir[3], *t_min, *t_max; /* of scaled rays */
    uint32_t *mask, *skip_primitive, *skip_geometry;
    uint32_t *ray; /* of the chunk, for each scaled ray */
    int32_t *exponent;
    float *t; /* of hits */
    uint32_t *primitive, *geometry;
    uint8_t *occluded;   /* of frames: pixels that are marked (band_frame.c) */
    cgt_band_best *best; /* of each ray of the chunk */
} cgt_band_scratch;

/* 16 planes of four bytes, one of one byte and one of best hits, for each ray. */
#define CGT_BAND_SCRATCH_BYTES(rays) ((rays) * (16 * sizeof(uint32_t) + sizeof(cgt_band_best) + 1))

/* The state of a call, common to its tasks. */
typedef struct cgt_band_call {
    const cgt_scene *scene;
    const cgt_trace_settings *settings;
    bool use_bvh[CGT_MAX_BANDS]; /* rays go through the band's bvh, and it may be read */
    bool by_tiles;               /* points against a light that tiles of a loose grid do not serve wait for a BVH */
    uint32_t slots;              /* tasks that may run at once */
    uint32_t slot_rays;
    void *memory; /* scratch of each slot */
    size_t bytes;
} cgt_band_call;

/* Allocates scratch for so many rays, in chunks of at most max_chunk. Fails with a message. */
cgt_result cgt_bands_begin(const cgt_scene *scene, const cgt_trace_settings *settings, uint64_t rays,
                           uint32_t max_chunk, cgt_band_call *call);

/* Builds the BVHs that so many rays pay for. Fails with a message. */
cgt_result cgt_bands_build_bvh(cgt_band_call *call, uint64_t rays);
void cgt_bands_end(cgt_band_call *call);
cgt_band_scratch cgt_band_slot(const cgt_band_call *call, uint32_t slot);

/* Runs tasks as cgt_run_scratch_tasks does, at most call->slots at once: task i may use slot i % call->slots. */
cgt_result cgt_bands_run(const cgt_band_call *call, cgt_scratch_task *task, void *argument, uint32_t count);

/* Adds what a band's kernel has counted, without rays and hits: these are the call's. */
void cgt_band_add_counts(cgt_counts *to, const cgt_counts *counts);

/* What the call asks of a band's kernel: exact hits, by number and t. */
cgt_trace_settings cgt_band_settings(const cgt_trace_settings *settings);

/* ---- arrays, in chunks, as the kernels trace those of one structure ---- */

/* Traces rays first to end - 1 as cgt_trace_rays_fn does, or, with a light, points against it as cgt_trace_light_fn
 * does. Returns false where points wait for a BVH (call->by_tiles): then what `occluded` has of them is undefined. */
bool cgt_bands_trace(const cgt_band_call *call, uint32_t slot, const cgt_rays *rays, const cgt_light *light,
                     uint64_t first, uint64_t end, const cgt_hits *hits, uint8_t *occluded, cgt_counts *counts);

/* Rays of one band of the call: those of a chunk as the caller gave them. */
typedef struct cgt_band_chunk {
    const cgt_band_call *call;
    const cgt_band_scratch *scratch;
    const cgt_rays *rays;
    const cgt_light *light; /* NULL: none */
    uint64_t first;
    uint32_t count;
    bool any_hit;
    bool *waits; /* set where points wait for a BVH; NULL: they do not */
    cgt_counts *counts;
} cgt_band_chunk;

/* Finds the hits of a chunk in band b, against scratch->best; any hit ends a ray. */
void cgt_band_trace_chunk(const cgt_band_chunk *chunk, uint32_t b);

/* Tests the primitives of no band. */
void cgt_band_trace_rest(const cgt_band_chunk *chunk);

/* ---- one ray ---- */

/* Finds what a ray of the scene hits first, or with any_hit something, CGT_INVALID_ID for nothing, as
 * cgt_trace_one_ray_fn does. use_bvh: as in cgt_band_call. */
uint32_t cgt_bands_trace_one(const cgt_scene *scene, const cgt_single_ray *from, const bool *use_bvh, bool any_hit,
                             cgt_counts *counts);

/* ---- all hits of a ray ---- */

/* Lists the first hits of the list's ray, as cgt_list_hits_fn does. use_bvh: as in cgt_band_call. */
struct cgt_hit_list;
void cgt_bands_list(const cgt_scene *scene, const bool *use_bvh, struct cgt_hit_list *list, cgt_counts *counts);

/* ---- frames ---- */

/* A band's camera has the caller's directions and a scaled eye, so that t' = t 2^k (band_ray.h), and frames go through
 * the band's structure as any frame does. Where the scaled camera's rays are not exactly the scaled rays of the camera,
 * these go one by one. */
typedef struct cgt_band_camera {
    cgt_camera_rays camera;
    bool is_scaled; /* its rays are the caller's, scaled */
    bool by_tiles;  /* whole tiles go through the band's loose grid */
} cgt_band_camera;

typedef struct cgt_band_frame {
    cgt_band_call call; /* slots for regions of max_pixels */
    const cgt_camera_rays *camera;
    cgt_band_camera band[CGT_MAX_BANDS];
} cgt_band_frame;

/* Scales a camera for each band and allocates scratch for `regions` regions of at most max_pixels. packets: the caller
 * has asked for packets. Settings, camera and scene stay in use. Fails with a message; else release with
 * cgt_bands_end. */
cgt_result cgt_band_frame_begin(const cgt_scene *scene, const cgt_camera_rays *camera,
                                const cgt_trace_settings *settings, bool packets, uint32_t regions, uint32_t max_pixels,
                                cgt_band_frame *frame);

/* Traces a region of the frame as cgt_trace_region_fn does. */
void cgt_band_trace_region(const cgt_band_frame *frame, uint32_t slot, const cgt_region *region, cgt_counts *counts);

#endif
