/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where most of a run's primitives are, so that a camera does not follow one that has flown off. Places are sampled
 * evenly in bounded memory: when it is full, every second one goes, and from then on every second one comes. */
#ifndef BULK_H
#define BULK_H

#include <stdint.h>

enum { BULK_SAMPLES = 16384 };

typedef struct bulk {
    float place[BULK_SAMPLES][4]; /* x, y, z, and how far the primitive reaches around it */
    uint32_t count;
    uint64_t seen, every; /* places given; one in so many is kept, 0 counts as 1 */
} bulk;

/* Adds a finite place and the reach of its primitive; a bulk that is all zero is empty. */
void bulk_add(bulk *b, const float place[3], float reach);

/* Narrows the bounds of everything to those of the bulk. Along each axis lo and hi are the 1 % and 99 % quantiles of the
 * samples, and the bulk ends (hi - lo) / 2 beyond them; bounds within that stay as they are.
 * Returns how many of `seen` lie outside, as far as the samples tell, and 0 where nothing was narrowed. *narrowed gets
 * whether a bound was. */
uint64_t bulk_narrow(bulk *b, float min[3], float max[3], int *narrowed);

#endif
