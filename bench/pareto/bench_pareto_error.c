/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The comparison of two frames, see bench_pareto_error.h. */
#include "pareto/bench_pareto_error.h"

#include <string.h>

/* Whole numbers in the order of the floats. */
static int64_t order_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int64_t size = (int64_t)(bits & 0x7fffffffu);
    return bits >> 31 ? -size : size;
}

uint32_t pareto_ulp(float a, float b)
{
    const int64_t distance = order_of(a) - order_of(b);
    return (uint32_t)(distance < 0 ? -distance : distance);
}

/* Above PARETO_SINGLE a distance falls to its power of two and the six bits after the leading one. */
static uint32_t bin_of(uint32_t distance)
{
    uint32_t octave = 10;
    if (distance < PARETO_SINGLE)
        return distance;
    while (distance >> octave > 1)
        octave++;
    return PARETO_SINGLE + (octave - 10) * PARETO_PER_OCTAVE + ((distance >> (octave - 6)) & (PARETO_PER_OCTAVE - 1));
}

/* The largest distance that falls into a bin. */
static uint32_t end_of(uint32_t bin)
{
    if (bin < PARETO_SINGLE)
        return bin;
    const uint32_t octave = 10 + (bin - PARETO_SINGLE) / PARETO_PER_OCTAVE;
    const uint64_t step = (bin - PARETO_SINGLE) % PARETO_PER_OCTAVE + PARETO_PER_OCTAVE + 1;
    return (uint32_t)((step << (octave - 6)) - 1);
}

void pareto_error_ray(pareto_error *error, int hit, int found, int same, float truth, float t)
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
    const uint32_t distance = pareto_ulp(truth, t);
    error->same++;
    error->t_bins[bin_of(distance)]++;
    if (distance > error->t_worst)
        error->t_worst = distance;
}

void pareto_error_add(pareto_error *error, const bench_planes *truth, const bench_planes *frame)
{
    const size_t pixels = (size_t)truth->width * truth->height;
    for (size_t i = 0; i < pixels; i++)
        pareto_error_ray(error, truth->primitive[i] != CGT_INVALID_ID, frame->primitive[i] != CGT_INVALID_ID,
                         truth->primitive[i] == frame->primitive[i], truth->t[i], frame->t[i]);
}

uint32_t pareto_error_t(const pareto_error *error, double share)
{
    uint64_t below = 0;
    for (uint32_t bin = 0; bin < PARETO_BINS; bin++) {
        below += error->t_bins[bin];
        if (below && (double)below >= share * (double)error->same)
            return end_of(bin) < error->t_worst ? end_of(bin) : error->t_worst;
    }
    return 0;
}

double pareto_error_share(const pareto_error *error)
{
    return error->rays ? (double)(error->missed + error->invented + error->wrong) / (double)error->rays : 0.0;
}
