/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The commit of a scene in bands (scene/bands.h), and its steps, which tests see: which magnitudes form a band, then
 * which band each primitive is in, by chunks of fixed size, which are tasks. */
#ifndef CGT_BANDS_COMMIT_H
#define CGT_BANDS_COMMIT_H

#include "scene/bands.h"

/* Cuts the valid primitives of scene->committed_scene, of which there is at least one, into bands, commits these, and
 * sets scene->in_bands and the statistics of structures. Indices are in range. Fails with a message. */
cgt_result cgt_bands_commit(cgt_scene *scene);

/* ---- which magnitudes form a band ---- */

/* Magnitude classes: class k holds the magnitudes of at least 2^(k - 150) and below 2^(k - 149), class 0 those below.
 * Coordinates and radii are floats, their sums below 2^129. */
#define CGT_MAGNITUDES 280u
#define CGT_MAGNITUDE_ZERO 149 /* the exponent of frexp and this make the class */

/* The largest coordinate of a whole scene between these, it has no bands. Within, the bounds of single precision hold
 * with a wide margin: squares of what lies near to each other do not underflow, products of four do not overflow. */
#define CGT_COMFORTABLE_MIN 0x1p-36f
#define CGT_COMFORTABLE_MAX 0x1p40f

/* A band reaches so many powers of two below and above its peak, the most populous class that is left. */
#define CGT_BAND_BELOW 40
#define CGT_BAND_ABOVE 16

/* Peaks are moved no farther than into this range of exponents: what is far out is brought in only as far as it must,
 * since multiplying by a small power may lose the last bits of coordinates near 0. */
#define CGT_BAND_MIN_PEAK 0
#define CGT_BAND_MAX_PEAK 30

#define CGT_NO_BAND 0xffu

typedef struct cgt_bands_plan {
    uint32_t bands;
    int exponent[CGT_MAGNITUDES];    /* of each band: what its coordinates are multiplied by, as a power of two */
    uint8_t band_of[CGT_MAGNITUDES]; /* the band of each class, CGT_NO_BAND where there are no primitives */
} cgt_bands_plan;

/* Whether a scene with this largest coordinate, maybe infinite, is cut into bands. */
static inline bool cgt_bands_needed(float magnitude)
{
    return !(magnitude >= CGT_COMFORTABLE_MIN && magnitude <= CGT_COMFORTABLE_MAX);
}

/* Plans bands for so many primitives of each class. */
void cgt_plan_bands(const uint32_t count[CGT_MAGNITUDES], cgt_bands_plan *plan);

/* ---- which band a primitive is in ---- */

#define CGT_BANDS_CHUNK 8192u
#define CGT_BAND_OF_REST CGT_MAX_BANDS

/* What a chunk has in each band, or what all chunks before it have. */
typedef struct cgt_band_offset {
    uint32_t prims;
    size_t floats;
} cgt_band_offset;

typedef struct cgt_bands_job {
    const cgt_primitives *prims;
    struct cgt_bands *bands;
    cgt_bands_plan plan;
    double factor[CGT_MAX_BANDS]; /* of each band */
    uint16_t *class_of; /* of each primitive: its magnitude, or CGT_MAGNITUDES: skipped. Counting makes that its band,
                           CGT_BAND_OF_REST, or CGT_MAGNITUDES */
    cgt_band_offset (*offset)[CGT_MAX_BANDS + 1]; /* of each chunk; the last one is that of the rest */
} cgt_bands_job;

/* Numbers of a copy of a primitive: x, y, z, r; p, r, q and 0; or three vertices. */
#define CGT_BAND_MAX_FLOATS 9u

static inline uint32_t cgt_band_floats(cgt_kind kind)
{
    return kind == CGT_KIND_SPHERES ? 4 : kind == CGT_KIND_CAPSULES ? 8 : CGT_BAND_MAX_FLOATS;
}

/* Tasks for each chunk. */
void cgt_bands_classify(void *argument, uint32_t index);
void cgt_bands_count(void *argument, uint32_t index);
void cgt_bands_copy(void *argument, uint32_t index);

#endif
