/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A call that traces a scene in bands: what its tasks share, and their scratch memory. */
#ifndef CGT_BAND_CALL_H
#define CGT_BAND_CALL_H

#include "core/scratch_tasks.h"
#include "dispatch/kernel.h"
#include "trace/bands/band_ray.h"

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

#endif
