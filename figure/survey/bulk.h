/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where most of a run's primitives are, so that a camera does not follow one that has flown off. A hash decides which
 * places are kept, in bounded memory: those with the smallest ones. So the samples do not depend on the order in which
 * places come, and those of several threads can be put together. Some particles, chosen by a hash of their ids, are
 * followed through the run: what most of them pass belongs to the picture, though they are there for a few frames only,
 * as grains that fall are. */
#ifndef BULK_H
#define BULK_H

#include <stdint.h>

enum { BULK_SAMPLES = 4096 };

typedef struct bulk_sample {
    uint64_t hash;
    union {
        float place[4]; /* x, y, z, and how far the primitive reaches around it */
        double value;   /* of a formula */
    };
} bulk_sample;

/* Samples of a run's values, chosen as those of places are. All zero: none. */
typedef struct bulk_values {
    bulk_sample sample[BULK_SAMPLES]; /* a heap: the largest hash first */
    uint32_t count;
} bulk_values;

/* The box that a particle moves in. */
typedef struct bulk_particle {
    uint64_t hash;
    float min[3], max[3];
} bulk_particle;

typedef struct bulk {
    bulk_sample sample[BULK_SAMPLES]; /* a heap: the largest hash first */
    uint32_t count, particles;
    uint64_t seen; /* places given */
    uint64_t end;  /* particles with hashes from here on are not followed; 0: all are */
    /* Those with the smallest hashes, BULK_SAMPLES of them and up to as many more that are not yet given up. */
    bulk_particle particle[2 * BULK_SAMPLES];
    uint16_t slot[4 * BULK_SAMPLES]; /* index + 1 of a particle, by its hash; 0: free */
} bulk;

/* The finaliser of MurmurHash3 (Austin Appleby): a bijection, so that no two primitives of a frame share a hash. */
static inline uint64_t bulk_mix(uint64_t x)
{
    x ^= x >> 33;
    x *= 0xff51afd7ed558ccdu;
    x ^= x >> 33;
    x *= 0xc4ceb9fe1a85ec53u;
    return x ^ x >> 33;
}

/* Whether the particle of this hash is not given up. */
static inline int bulk_follows(const bulk *b, uint64_t hash) { return b->end == 0 || hash < b->end; }

/* Of what bulk_add keeps, which is little of a large run. */
void cgt_bulk_follow(bulk *b, uint64_t hash, const float place[3]);
void cgt_bulk_keep(bulk *b, uint64_t hash, const float place[3], float reach);

/* Adds a finite place and the reach of its primitive; a bulk that is all zero is empty. frame, primitive: their
 * numbers, for the hash; id: of the particle in all frames, the number where there is none. */
static inline void bulk_add(bulk *b, uint64_t frame, uint32_t primitive, uint32_t id, const float place[3], float reach)
{
    const uint64_t particle = bulk_mix(id + UINT64_C(0x9E3779B97F4A7C15)), sample = bulk_mix(frame << 32 ^ primitive);
    b->seen++;
    if (bulk_follows(b, particle))
        cgt_bulk_follow(b, particle, place);
    if (b->count < BULK_SAMPLES || sample < b->sample[0].hash)
        cgt_bulk_keep(b, sample, place, reach);
}

/* Brings the samples into one order, whatever theirs was; more may be added. */
void cgt_bulk_sort(bulk *b);
void cgt_bulk_values_sort(bulk_values *v);

/* Adds a finite value; the numbers are those of bulk_add. */
void cgt_bulk_values_add(bulk_values *v, uint64_t frame, uint32_t primitive, double value);

/* The 1 % and the 99 % quantile of the samples above `above`; of fewer than 101 the least and the greatest. Returns 0
 * where there are none. */
int cgt_bulk_values_range(const bulk_values *v, double above, double *low, double *high);

/* Sorts the samples' coordinates along an axis, or, as axis 3, how far their primitives reach: `count` floats. */
void cgt_bulk_sort_places(const bulk *b, int axis, float *sorted);

/* Adds the samples of another one. */
void cgt_bulk_merge(bulk *sum, const bulk *part);
void cgt_bulk_values_merge(bulk_values *sum, const bulk_values *part);

/* Narrows the bounds of everything to those of the bulk. It reaches from the 1 % to the 99 % quantile of the samples
 * along each axis; further, to the 1 % quantile of the particles' lowest places and the 99 % quantile of their highest,
 * where that is not farther off than twice its longest edge; and half of that edge and the largest reach beyond. Bounds
 * within stay. Returns about how many of `seen` lie outside: at least 1, or 0 where nothing was narrowed. *narrowed
 * gets whether a bound was. */
uint64_t cgt_bulk_narrow(const bulk *b, float min[3], float max[3], int *narrowed);

#endif
