/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where most primitives are; see bulk.h. */
#include "playback/bulk.h"

#include <stdlib.h>
#include <string.h>

void bulk_add(bulk *b, const float place[3], float reach)
{
    if (!b->every)
        b->every = 1;
    if (b->seen++ % b->every)
        return;
    if (b->count == BULK_SAMPLES) {
        for (uint32_t i = 0; i < BULK_SAMPLES / 2; i++)
            memcpy(b->place[i], b->place[2 * i], sizeof b->place[i]);
        b->count = BULK_SAMPLES / 2;
        b->every *= 2;
        if ((b->seen - 1) % b->every)
            return;
    }
    memcpy(b->place[b->count], place, 3 * sizeof(float));
    b->place[b->count++][3] = reach;
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The ends of the bulk along an axis, from its sorted coordinates. */
static void find_ends(const float *sorted, uint32_t count, double *lowest, double *highest)
{
    const double lo = (double)sorted[(count - 1) / 100], hi = (double)sorted[count - 1 - (count - 1) / 100];
    *lowest = lo - 0.5 * (hi - lo);
    *highest = hi + 0.5 * (hi - lo);
}

/* The bounds of the samples within the ends, and their number. */
static uint32_t bound_inside(const bulk *b, const double lowest[3], const double highest[3], float min[3], float max[3])
{
    uint32_t inside = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        const float *p = b->place[i];
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

uint64_t bulk_narrow(bulk *b, float min[3], float max[3], int *narrowed)
{
    double lowest[3], highest[3];
    float inner_min[3] = {0.0f}, inner_max[3] = {0.0f};
    *narrowed = 0;
    float *sorted = b->count ? malloc(b->count * sizeof *sorted) : NULL;
    if (!sorted)
        return 0; /* without memory for it the bounds stay */
    for (int c = 0; c < 3; c++) {
        for (uint32_t i = 0; i < b->count; i++)
            sorted[i] = b->place[i][c];
        qsort(sorted, b->count, sizeof *sorted, compare);
        find_ends(sorted, b->count, &lowest[c], &highest[c]);
        *narrowed |= (double)min[c] < lowest[c] || (double)max[c] > highest[c];
    }
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
    return (b->count - inside) * (b->every ? b->every : 1);
}
