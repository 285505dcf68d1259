/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bands around peaks. A scene's magnitudes thin out towards its middle, and its strays are few: a band that begins at
 * the most populous class holds the scene whole, where bands of fixed limits might cut through it. */
#include "builders/bands/bands_plan.h"

#include <string.h>

/* The most populous class without a band; CGT_MAGNITUDES where none is left. */
static uint32_t find_peak(const uint32_t count[CGT_MAGNITUDES], const cgt_bands_plan *plan)
{
    uint32_t peak = CGT_MAGNITUDES;
    for (uint32_t k = 0; k < CGT_MAGNITUDES; k++)
        if (plan->band_of[k] == CGT_NO_BAND && count[k] && (peak == CGT_MAGNITUDES || count[k] > count[peak]))
            peak = k;
    return peak;
}

void cgt_plan_bands(const uint32_t count[CGT_MAGNITUDES], cgt_bands_plan *plan)
{
    uint32_t peak;
    plan->bands = 0;
    memset(plan->band_of, CGT_NO_BAND, sizeof plan->band_of);
    while ((peak = find_peak(count, plan)) < CGT_MAGNITUDES) {
        const int exponent = (int)peak - CGT_MAGNITUDE_ZERO;
        plan->exponent[plan->bands] = exponent > CGT_BAND_MAX_PEAK   ? CGT_BAND_MAX_PEAK - exponent
                                      : exponent < CGT_BAND_MIN_PEAK ? CGT_BAND_MIN_PEAK - exponent
                                                                     : 0;
        const int first = (int)peak - CGT_BAND_BELOW, last = (int)peak + CGT_BAND_ABOVE;
        for (int k = first < 0 ? 0 : first; k <= last && k < (int)CGT_MAGNITUDES; k++)
            if (plan->band_of[k] == CGT_NO_BAND && count[k])
                plan->band_of[k] = (uint8_t)plan->bands;
        plan->bands++;
    }
}
