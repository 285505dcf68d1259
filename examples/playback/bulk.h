/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where most of a run's primitives are, so that a camera does not follow one that has flown off. A hash decides which
 * places are kept, in bounded memory: those with the smallest ones. So the samples do not depend on the order in which
 * places come, and those of several processes can be put together. */
#ifndef BULK_H
#define BULK_H

#include <stdint.h>

enum { BULK_SAMPLES = 4096 };

typedef struct bulk_sample {
    uint64_t hash;
    float place[4]; /* x, y, z, and how far the primitive reaches around it */
} bulk_sample;

typedef struct bulk {
    bulk_sample sample[BULK_SAMPLES]; /* a heap: the largest hash first */
    uint32_t count;
    uint64_t seen; /* places given */
} bulk;

/* Adds a finite place and the reach of its primitive; a bulk that is all zero is empty. frame, primitive: their numbers,
 * for the hash. */
void bulk_add(bulk *b, uint64_t frame, uint32_t primitive, const float place[3], float reach);

/* Brings the samples into one order, whatever theirs was; more may be added. */
void bulk_sort(bulk *b);

/* Adds the samples of another bulk, and sorts them. */
void bulk_merge(bulk *sum, const bulk *part);

/* Narrows the bounds of everything to those of the bulk. It reaches from the 1 % to the 99 % quantile of the samples along
 * each axis, and half of its longest edge and the largest reach beyond; bounds within that stay as they are. Returns about
 * how many of `seen` lie outside, 0 where nothing was narrowed. *narrowed gets whether a bound was. */
uint64_t bulk_narrow(const bulk *b, float min[3], float max[3], int *narrowed);

#endif
