/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sorts primitives into bands: first their magnitudes, then how many each chunk of them has in each band, then the
 * copies. By chunks of fixed size, which are tasks. */
#ifndef CGT_BANDS_FILL_H
#define CGT_BANDS_FILL_H

#include "builders/bands/bands_plan.h"
#include "scene/bands.h"

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

/* Tasks for each chunk. */
void cgt_bands_classify(void *argument, uint32_t index);
void cgt_bands_count(void *argument, uint32_t index);
void cgt_bands_copy(void *argument, uint32_t index);

#endif
