/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Included by every test of the core: cmocka, the public headers, the seed, random numbers.
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

#include "support/random.h"
#include "support/research_options.h"

#define TEST_COUNT(a) (sizeof(a) / sizeof((a)[0]))
#define TEST_SKIPPED 77 /* exit code: cannot run on this machine */

/* Prints the program's name, seed and scale. Call it first in main. */
void test_begin(const char *name);

/* Whether this CPU runs a variant; prints a message if not. CGT_VARIANT_NAME is the variant that the file is compiled
 * for. */
bool test_variant_runs(const char *name);
#define TEST_TEXT_(x) #x
#define TEST_TEXT(x) TEST_TEXT_(x)
#define CGT_VARIANT_NAME TEST_TEXT(CGT_VARIANT)

/* n times the scale, at least 1. */
uint32_t test_scaled(uint32_t n);

/* The same, clamped to [least, n]. */
uint32_t test_between(uint32_t least, uint32_t n);

/* Whether to run a sample of the cases instead of all: below a scale of 0.1. */
bool test_samples(void);

/* First case, below `step`, of a sample of every step-th case. number: distinguishes samples, which begin at different
 * cases. All begin elsewhere with another seed, so that other seeds run the other cases. */
uint32_t test_sample_start(uint32_t number, uint32_t step);

#endif
