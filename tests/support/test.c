/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Seed and scale of the tests. */
#define _POSIX_C_SOURCE 200809L
#include "support/test.h"

#include <stdio.h>
#include <stdlib.h>

static double scale = 1;
static uint64_t seed = RANDOM_DEFAULT_SEED;

void test_begin(const char *name)
{
    const char *seed_text = getenv("CGT_TEST_SEED"), *scale_text = getenv("CGT_TEST_SCALE");
    if (seed_text && *seed_text)
        seed = strtoull(seed_text, NULL, 0);
    random_seed(seed);
    if (scale_text && *scale_text)
        scale = strtod(scale_text, NULL);
    if (!(scale > 0)) {
        fprintf(stderr, "%s: CGT_TEST_SCALE=%s: must be above 0\n", name, scale_text);
        exit(2);
    }
    printf("%s: CGT_TEST_SEED=%llu CGT_TEST_SCALE=%g\n", name, (unsigned long long)seed, scale);
    fflush(stdout);
}

bool test_variant_runs(const char *name)
{
    cgt_context_options options;
    cgt_context *context;
    cgt_context_options_init(&options);
    options.variant = name;
    options.threads = 1;
    const cgt_result result = cgt_context_create(&options, &context);
    if (result == CGT_OK)
        cgt_context_release(context);
    else
        printf("%s: %s\n", name, cgt_get_result_string(result));
    if (result == CGT_OK || result == CGT_ERROR_UNSUPPORTED)
        return result == CGT_OK;
    exit(1);
}

uint32_t test_scaled(uint32_t n)
{
    const double scaled = n * scale;
    return scaled < 1 ? 1 : scaled > 1e9 ? 1000000000u : (uint32_t)scaled;
}

uint32_t test_between(uint32_t least, uint32_t n)
{
    const uint32_t scaled = test_scaled(n);
    return scaled > n ? n : scaled < least ? least : scaled;
}

bool test_samples(void) { return scale < 0.1; }

uint32_t test_sample_start(uint32_t number, uint32_t step) { return (uint32_t)((seed + number) % step); }
