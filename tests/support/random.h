/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Streams of random numbers, for the tests and for cgt-bench. */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Random numbers: one stream per purpose, so that the numbers of a test do not depend on other tests. */
typedef struct test_random {
    uint64_t state;
    const uint8_t *bytes; /* that say the first bits of the next numbers: a fuzzer's */
    size_t left;
} test_random;

/* Sets the seed of all streams made later; the default is RANDOM_DEFAULT_SEED. */
#define RANDOM_DEFAULT_SEED UINT64_C(20260117)
void random_seed(uint64_t of_all);

test_random random_make(uint64_t stream);

/* Two bytes of an input say the first 16 bits of each number, as long as there are any. */
test_random random_of_bytes(const uint8_t *bytes, size_t count);
uint64_t random_bits(test_random *r);
uint32_t random_below(test_random *r, uint32_t count); /* 0 .. count - 1 */
float random_float(test_random *r, float low, float high);
float random_log(test_random *r, float low, float high); /* evenly over the orders of magnitude; low above 0 */
float random_any_float(test_random *r);                  /* any 32 bits, NaN and infinities included */
void random_direction(test_random *r, float d[3]);       /* about unit length, no preferred direction */

/* Whether the bits are equal, so that a NaN equals itself. */
bool same_bits(float a, float b);

#endif
