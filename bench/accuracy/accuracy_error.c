/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The comparison of two frames, see accuracy_error.h. */
#include "accuracy/accuracy_error.h"

#include <string.h>

/* Maps floats to integers in the same order. */
static int64_t order_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int64_t size = (int64_t)(bits & 0x7fffffffu);
    return bits >> 31 ? -size : size;
}

/* Steps of float from a to b; +0 and -0 are one. Neither is a NaN. */
static uint32_t ulp_between(float a, float b)
{
    const int64_t distance = order_of(a) - order_of(b);
    return (uint32_t)(distance < 0 ? -distance : distance);
}

/* Above ACCURACY_SINGLE a distance falls to its power of two and the six bits after the leading one. */
static uint32_t bin_of(uint32_t distance)
{
    uint32_t octave = 10;
    if (distance < ACCURACY_SINGLE)
        return distance;
    while (distance >> octave > 1)
        octave++;
    return ACCURACY_SINGLE + (octave - 10) * ACCURACY_PER_OCTAVE +
           ((distance >> (octave - 6)) & (ACCURACY_PER_OCTAVE - 1));
}

/* The largest distance that falls into a bin. */
static uint32_t end_of(uint32_t bin)
{
    if (bin < ACCURACY_SINGLE)
        return bin;
    const uint32_t octave = 10 + (bin - ACCURACY_SINGLE) / ACCURACY_PER_OCTAVE;
    const uint64_t step = (bin - ACCURACY_SINGLE) % ACCURACY_PER_OCTAVE + ACCURACY_PER_OCTAVE + 1;
    return (uint32_t)((step << (octave - 6)) - 1);
}

void accuracy_error_ray(accuracy_error *error, int hit, int found, int same, float truth, float t)
{
    error->rays++;
    error->hits += (uint64_t)hit;
    error->missed += (uint64_t)(hit && !found);
    error->invented += (uint64_t)(!hit && found);
    if (!hit || !found)
        return;
    if (!same) {
        error->wrong++;
        return;
    }
    const uint32_t distance = ulp_between(truth, t);
    error->same++;
    error->t_bins[bin_of(distance)]++;
    if (distance > error->t_worst)
        error->t_worst = distance;
}

void accuracy_error_add(accuracy_error *error, const bench_planes *truth, const bench_planes *frame)
{
    const size_t pixels = (size_t)truth->width * truth->height;
    for (size_t i = 0; i < pixels; i++)
        accuracy_error_ray(error, truth->primitive[i] != CGT_INVALID_ID, frame->primitive[i] != CGT_INVALID_ID,
                           truth->primitive[i] == frame->primitive[i], truth->t[i], frame->t[i]);
}

/* The distance that `share` of the t compared do not exceed, at most 1/64 too large; 0 where none was compared. */
static uint32_t distance_at(const accuracy_error *error, double share)
{
    uint64_t below = 0;
    for (uint32_t bin = 0; bin < ACCURACY_BINS; bin++) {
        below += error->t_bins[bin];
        if (below && (double)below >= share * (double)error->same)
            return end_of(bin) < error->t_worst ? end_of(bin) : error->t_worst;
    }
    return 0;
}

void accuracy_error_cells(const accuracy_error *error, bench_table *table)
{
    const double bad = (double)(error->missed + error->invented + error->wrong);
    bench_table_count(table, "rays", error->rays);
    bench_table_count(table, "hits", error->hits);
    bench_table_count(table, "missed", error->missed);
    bench_table_count(table, "invented", error->invented);
    bench_table_count(table, "wrong", error->wrong);
    bench_table_real(table, "wrong_share", error->rays ? bad / (double)error->rays : 0.0);
    bench_table_count(table, "t_ulp_median", distance_at(error, 0.5));
    bench_table_count(table, "t_ulp_p99", distance_at(error, 0.99));
    bench_table_count(table, "t_ulp_worst", error->t_worst);
}
