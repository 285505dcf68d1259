/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random numbers of cgt-bench: the same on every machine. */
#ifndef BENCH_RANDOM_H
#define BENCH_RANDOM_H

#include <stdint.h>

static const uint64_t bench_random_start = 88172645463325252u;

/* Marsaglia's 64-bit xorshift; the upper 24 bits as a number in [0, 1). */
static inline float bench_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (float)(*state >> 40) * 0x1p-24f;
}

#endif
