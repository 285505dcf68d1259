/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where most primitives are; see bulk.h. */
#include "survey/bulk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Moves the first sample down to where it belongs. */
static void sift_down(bulk_sample *heap, uint32_t count)
{
    const bulk_sample moved = heap[0];
    uint32_t at = 0;
    for (;;) {
        uint32_t child = 2 * at + 1;
        if (child >= count)
            break;
        if (child + 1 < count && heap[child + 1].hash > heap[child].hash)
            child++;
        if (heap[child].hash <= moved.hash)
            break;
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = moved;
}

static void keep(bulk_sample *heap, uint32_t *count, const bulk_sample *sample)
{
    if (*count == BULK_SAMPLES) {
        if (sample->hash >= heap[0].hash)
            return;
        heap[0] = *sample;
        sift_down(heap, *count);
        return;
    }
    uint32_t at = (*count)++;
    for (; at > 0 && heap[(at - 1) / 2].hash < sample->hash; at = (at - 1) / 2)
        heap[at] = heap[(at - 1) / 2];
    heap[at] = *sample;
}

/* ---- Particles ---------------------------------------------------------------------------------------------- */

enum { SLOTS = 4 * BULK_SAMPLES, MOST_PARTICLES = 2 * BULK_SAMPLES };

/* The slot of a hash, or the free one where it would be entered. */
static uint16_t *slot_of(bulk *b, uint64_t hash)
{
    uint32_t at = (uint32_t)hash % SLOTS;
    while (b->slot[at] && b->particle[b->slot[at] - 1].hash != hash)
        at = (at + 1) % SLOTS;
    return &b->slot[at];
}

static int compare_particles(const void *a, const void *b)
{
    const uint64_t x = ((const bulk_particle *)a)->hash, y = ((const bulk_particle *)b)->hash;
    return (x > y) - (x < y);
}

/* Keeps BULK_SAMPLES particles, in the order of their hashes. Those given up never come back, because `end` only falls:
 * whoever is kept was followed from its first place on. */
static void sort_particles(bulk *b)
{
    qsort(b->particle, b->particles, sizeof b->particle[0], compare_particles);
    if (b->particles >= BULK_SAMPLES) {
        memset(b->particle + BULK_SAMPLES, 0, (b->particles - BULK_SAMPLES) * sizeof b->particle[0]);
        b->particles = BULK_SAMPLES;
        b->end = b->particle[BULK_SAMPLES - 1].hash + 1;
    }
    memset(b->slot, 0, sizeof b->slot);
    for (uint32_t i = 0; i < b->particles; i++)
        *slot_of(b, b->particle[i].hash) = (uint16_t)(i + 1);
}

/* Follows a particle that is not given up. */
static void follow(bulk *b, uint64_t hash, const float min[3], const float max[3])
{
    uint16_t *slot = slot_of(b, hash);
    if (!*slot) {
        if (b->particles == MOST_PARTICLES) {
            sort_particles(b);
            if (hash >= b->end)
                return;
            slot = slot_of(b, hash);
        }
        bulk_particle *const p = &b->particle[b->particles++];
        *slot = (uint16_t)b->particles;
        p->hash = hash;
        memcpy(p->min, min, sizeof p->min);
        memcpy(p->max, max, sizeof p->max);
        return;
    }
    bulk_particle *const p = &b->particle[*slot - 1];
    for (int c = 0; c < 3; c++) {
        p->min[c] = min[c] < p->min[c] ? min[c] : p->min[c];
        p->max[c] = max[c] > p->max[c] ? max[c] : p->max[c];
    }
}

/* ---- All ---------------------------------------------------------------------------------------------------- */

void cgt_bulk_follow(bulk *b, uint64_t hash, const float place[3]) { follow(b, hash, place, place); }

void cgt_bulk_keep(bulk *b, uint64_t hash, const float place[3], float reach)
{
    const bulk_sample sample = {hash, {{place[0], place[1], place[2], reach}}};
    keep(b->sample, &b->count, &sample);
}

static int compare_hashes(const void *a, const void *b)
{
    const uint64_t x = ((const bulk_sample *)a)->hash, y = ((const bulk_sample *)b)->hash;
    return (x < y) - (x > y);
}

void cgt_bulk_sort(bulk *b)
{
    qsort(b->sample, b->count, sizeof b->sample[0], compare_hashes);
    sort_particles(b);
}

void cgt_bulk_merge(bulk *sum, const bulk *part)
{
    sum->seen += part->seen;
    for (uint32_t i = 0; i < part->count; i++)
        keep(sum->sample, &sum->count, &part->sample[i]);
    for (uint32_t i = 0; i < part->particles; i++)
        if (bulk_follows(sum, part->particle[i].hash))
            follow(sum, part->particle[i].hash, part->particle[i].min, part->particle[i].max);
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

void cgt_bulk_sort_places(const bulk *b, int axis, float *sorted)
{
    for (uint32_t i = 0; i < b->count; i++)
        sorted[i] = b->sample[i].place[axis];
    qsort(sorted, b->count, sizeof *sorted, compare);
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

void cgt_bulk_values_add(bulk_values *v, uint64_t frame, uint32_t primitive, double value)
{
    bulk_sample sample = {bulk_mix(frame << 32 ^ primitive), {{0.0f}}}; /* the bytes beside the value, too */
    sample.value = value;
    keep(v->sample, &v->count, &sample);
}

void cgt_bulk_values_sort(bulk_values *v) { qsort(v->sample, v->count, sizeof v->sample[0], compare_hashes); }

void cgt_bulk_values_merge(bulk_values *sum, const bulk_values *part)
{
    for (uint32_t i = 0; i < part->count; i++)
        keep(sum->sample, &sum->count, &part->sample[i]);
}

static int compare_values(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int cgt_bulk_values_range(const bulk_values *v, double above, double *low, double *high)
{
    double sorted[BULK_SAMPLES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < v->count; i++)
        if (v->sample[i].value > above)
            sorted[count++] = v->sample[i].value;
    if (count == 0)
        return 0;
    qsort(sorted, count, sizeof *sorted, compare_values);
    const uint32_t rank = (count - 1) / 100;
    *low = sorted[rank];
    *high = sorted[count - 1 - rank];
    return 1;
}

/* ---- Bounds ------------------------------------------------------------------------------------------------- */

/* What is kept of a bulk: from low to high along each axis, and a margin around it. */
typedef struct bulk_ends {
    double low[3], high[3];
    double edge;  /* the longest of the places' quantiles */
    double reach; /* the largest */
} bulk_ends;

/* The quantiles of places, and of how far primitives reach. */
static void find_ends(const bulk *b, float *sorted, bulk_ends *e)
{
    const uint32_t rank = (b->count - 1) / 100;
    e->edge = 0.0;
    for (int c = 0; c < 3; c++) {
        cgt_bulk_sort_places(b, c, sorted);
        e->low[c] = (double)sorted[rank];
        e->high[c] = (double)sorted[b->count - 1 - rank];
        e->edge = e->high[c] - e->low[c] > e->edge ? e->high[c] - e->low[c] : e->edge;
    }
    cgt_bulk_sort_places(b, 3, sorted);
    e->reach = (double)sorted[b->count - 1];
}

/* Extends the ends to where all but a hundredth of the particles pass, unless that is far away. */
static void extend_ends(const bulk *b, float *sorted, bulk_ends *e)
{
    const uint32_t count = b->particles < BULK_SAMPLES ? b->particles : BULK_SAMPLES;
    const uint32_t rank = count ? (count - 1) / 100 : 0;
    for (int c = 0; c < 3 && count; c++) {
        for (uint32_t i = 0; i < count; i++)
            sorted[i] = b->particle[i].min[c];
        qsort(sorted, count, sizeof *sorted, compare);
        const double low = (double)sorted[rank];
        for (uint32_t i = 0; i < count; i++)
            sorted[i] = b->particle[i].max[c];
        qsort(sorted, count, sizeof *sorted, compare);
        const double high = (double)sorted[count - 1 - rank];
        if (low < e->low[c] && e->low[c] - low <= 2.0 * e->edge)
            e->low[c] = low;
        if (high > e->high[c] && high - e->high[c] <= 2.0 * e->edge)
            e->high[c] = high;
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

uint64_t cgt_bulk_narrow(const bulk *b, float min[3], float max[3], int *narrowed)
{
    bulk_ends ends;
    double lowest[3], highest[3]; /* rounded as bounds are, which a sphere at the end of a bulk must not exceed */
    float inner_min[3] = {0.0f}, inner_max[3] = {0.0f};
    *narrowed = 0;
    float *sorted = b->count ? malloc(BULK_SAMPLES * sizeof *sorted) : NULL;
    if (!sorted)
        return 0; /* without memory for it the bounds stay */
    find_ends(b, sorted, &ends);
    extend_ends(b, sorted, &ends);
    free(sorted);
    for (int c = 0; c < 3; c++) { /* half of the longest edge around it, so that a flat bulk is not cut */
        lowest[c] = (double)(float)(ends.low[c] - 0.5 * ends.edge - ends.reach);
        highest[c] = (double)(float)(ends.high[c] + 0.5 * ends.edge + ends.reach);
        *narrowed |= (double)min[c] < lowest[c] || (double)max[c] > highest[c];
    }
    const uint32_t inside = *narrowed ? bound_inside(b, lowest, highest, inner_min, inner_max) : 0;
    /* spread too far for a bulk to be seen; or there are no more places than samples, and none is outside */
    if (!inside || (double)inside < 0.9 * b->count || (inside == b->count && b->count == b->seen)) {
        *narrowed = 0;
        return 0;
    }
    for (int c = 0; c < 3; c++) { /* samples may miss what few particles pass: the ends count, too */
        const float low = fminf((float)(ends.low[c] - ends.reach), inner_min[c]);
        const float high = fmaxf((float)(ends.high[c] + ends.reach), inner_max[c]);
        min[c] = (double)min[c] < lowest[c] ? fmaxf(min[c], low) : min[c];
        max[c] = (double)max[c] > highest[c] ? fminf(max[c], high) : max[c];
    }
    const uint64_t outside = (uint64_t)((double)(b->count - inside) / b->count * (double)b->seen + 0.5);
    return outside ? outside : 1; /* which no sample shows */
}
