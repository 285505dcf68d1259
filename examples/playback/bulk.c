/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where most primitives are; see bulk.h. */
#include "playback/bulk.h"

#include <stdlib.h>

/* Moves the first sample down to where it belongs. */
static void sift_down(bulk *b)
{
    const bulk_sample moved = b->sample[0];
    uint32_t at = 0;
    for (;;) {
        uint32_t child = 2 * at + 1;
        if (child >= b->count)
            break;
        if (child + 1 < b->count && b->sample[child + 1].hash > b->sample[child].hash)
            child++;
        if (b->sample[child].hash <= moved.hash)
            break;
        b->sample[at] = b->sample[child];
        at = child;
    }
    b->sample[at] = moved;
}

static void keep(bulk *b, const bulk_sample *sample)
{
    if (b->count == BULK_SAMPLES) {
        if (sample->hash >= b->sample[0].hash)
            return;
        b->sample[0] = *sample;
        sift_down(b);
        return;
    }
    uint32_t at = b->count++;
    for (; at > 0 && b->sample[(at - 1) / 2].hash < sample->hash; at = (at - 1) / 2)
        b->sample[at] = b->sample[(at - 1) / 2];
    b->sample[at] = *sample;
}

/* The finaliser of MurmurHash3 (Austin Appleby): a bijection, so that no two primitives of a frame share a hash. */
static uint64_t mix(uint64_t x)
{
    x ^= x >> 33;
    x *= 0xff51afd7ed558ccdu;
    x ^= x >> 33;
    x *= 0xc4ceb9fe1a85ec53u;
    return x ^ x >> 33;
}

void bulk_add(bulk *b, uint64_t frame, uint32_t primitive, const float place[3], float reach)
{
    const bulk_sample sample = {mix(frame << 32 ^ primitive), {place[0], place[1], place[2], reach}};
    b->seen++;
    keep(b, &sample);
}

static int compare_hashes(const void *a, const void *b)
{
    const uint64_t x = ((const bulk_sample *)a)->hash, y = ((const bulk_sample *)b)->hash;
    return (x < y) - (x > y);
}

void bulk_sort(bulk *b) { qsort(b->sample, b->count, sizeof b->sample[0], compare_hashes); }

void bulk_merge(bulk *sum, const bulk *part)
{
    sum->seen += part->seen;
    for (uint32_t i = 0; i < part->count; i++)
        keep(sum, &part->sample[i]);
    bulk_sort(sum);
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The ends of the bulk. Half of its longest edge is left around it, so that a flat bulk is not cut, and the reach. */
static void find_ends(const bulk *b, float *sorted, double lowest[3], double highest[3])
{
    double edge = 0.0;
    const uint32_t rank = (b->count - 1) / 100;
    for (int c = 0; c < 4; c++) {
        for (uint32_t i = 0; i < b->count; i++)
            sorted[i] = b->sample[i].place[c];
        qsort(sorted, b->count, sizeof *sorted, compare);
        if (c == 3)
            break;
        lowest[c] = (double)sorted[rank];
        highest[c] = (double)sorted[b->count - 1 - rank];
        edge = highest[c] - lowest[c] > edge ? highest[c] - lowest[c] : edge;
    }
    for (int c = 0; c < 3; c++) { /* sorted: the reaches */
        lowest[c] -= 0.5 * edge + (double)sorted[b->count - 1];
        highest[c] += 0.5 * edge + (double)sorted[b->count - 1];
    }
}

/* The bounds of the samples within the ends, and their number. */
static uint32_t bound_inside(const bulk *b, const double lowest[3], const double highest[3], float min[3], float max[3])
{
    uint32_t inside = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        const float *p = b->sample[i].place;
        int is_inside = 1;
        for (int c = 0; c < 3; c++)
            is_inside &= (double)p[c] >= lowest[c] && (double)p[c] <= highest[c];
        if (!is_inside)
            continue;
        for (int c = 0; c < 3; c++) {
            min[c] = inside && min[c] < p[c] - p[3] ? min[c] : p[c] - p[3];
            max[c] = inside && max[c] > p[c] + p[3] ? max[c] : p[c] + p[3];
        }
        inside++;
    }
    return inside;
}

uint64_t bulk_narrow(const bulk *b, float min[3], float max[3], int *narrowed)
{
    double lowest[3], highest[3];
    float inner_min[3] = {0.0f}, inner_max[3] = {0.0f};
    *narrowed = 0;
    float *sorted = b->count ? malloc(b->count * sizeof *sorted) : NULL;
    if (!sorted)
        return 0; /* without memory for it the bounds stay */
    find_ends(b, sorted, lowest, highest);
    for (int c = 0; c < 3; c++)
        *narrowed |= (double)min[c] < lowest[c] || (double)max[c] > highest[c];
    free(sorted);
    const uint32_t inside = *narrowed ? bound_inside(b, lowest, highest, inner_min, inner_max) : 0;
    if (!inside || (double)inside < 0.9 * b->count) { /* spread too far for a bulk to be seen */
        *narrowed = 0;
        return 0;
    }
    for (int c = 0; c < 3; c++) {
        if ((double)min[c] < lowest[c])
            min[c] = inner_min[c];
        if ((double)max[c] > highest[c])
            max[c] = inner_max[c];
    }
    return (uint64_t)((double)(b->count - inside) / b->count * (double)b->seen + 0.5);
}
