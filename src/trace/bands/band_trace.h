/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays through the bands of a scene, in chunks, as the kernels trace those of one structure. */
#ifndef CGT_BAND_TRACE_H
#define CGT_BAND_TRACE_H

#include "trace/bands/band_call.h"

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

#endif
