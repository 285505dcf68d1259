/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What every test of the core includes: cmocka, the public header, the seed, random numbers.
 *
 *   CGT_TEST_SEED   seed of all random numbers; each program prints the one it used
 *   CGT_TEST_SCALE  factor for the length of heavy loops, default 1; emulators and sanitizers take less */
#ifndef TEST_H
#define TEST_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdbool.h>

#include <cgt/cgt.h>

#define TEST_COUNT(a) (sizeof(a) / sizeof((a)[0]))
#define TEST_SKIPPED 77 /* exit code: what is tested does not exist here */

/* Prints the program's name, seed and scale. Call it first in main. */
void test_begin(const char *name);

/* Whether this CPU runs a variant; says so where it does not. CGT_VARIANT_NAME is that of the file's own row. */
bool test_variant_runs(const char *name);
#define TEST_TEXT_(x) #x
#define TEST_TEXT(x) TEST_TEXT_(x)
#define CGT_VARIANT_NAME TEST_TEXT(CGT_VARIANT)

/* n times the scale, at least 1. */
uint32_t test_scaled(uint32_t n);

/* Random numbers: one stream per use, so that a test's numbers do not depend on the others'. */
typedef struct test_random {
    uint64_t state;
} test_random;

test_random random_make(uint64_t stream);
uint64_t random_bits(test_random *r);
uint32_t random_below(test_random *r, uint32_t count); /* 0 .. count - 1 */
float random_float(test_random *r, float low, float high);
float random_log(test_random *r, float low, float high); /* evenly over the orders of magnitude; low above 0 */
float random_any_float(test_random *r);                  /* any 32 bits, NaN and infinities included */
void random_direction(test_random *r, float d[3]);       /* about unit length, no preferred direction */

/* Steps of float from a to b, 0 for equal values (+0 and -0 are equal); UINT32_MAX where one is NaN. */
uint32_t ulp_distance(float a, float b);

/* The same bits, so that NaN equals itself. */
bool same_bits(float a, float b);

#endif
