/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which magnitudes form a band. A header, so that tests see it. */
#ifndef CGT_BANDS_PLAN_H
#define CGT_BANDS_PLAN_H

#include <stdbool.h>
#include <stdint.h>

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

#endif
