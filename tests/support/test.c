/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Seed, scale and random numbers of the tests. */
#define _POSIX_C_SOURCE 200809L
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_SEED UINT64_C(20260117)

static uint64_t seed = DEFAULT_SEED;
static double scale = 1;

void test_begin(const char *name)
{
    const char *seed_text = getenv("CGT_TEST_SEED"), *scale_text = getenv("CGT_TEST_SCALE");
    if (seed_text && *seed_text)
        seed = strtoull(seed_text, NULL, 0);
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
        printf("%s: %s\n", name, cgt_result_string(result));
    if (result == CGT_OK || result == CGT_ERROR_UNSUPPORTED)
        return result == CGT_OK;
    exit(1);
}

uint32_t test_scaled(uint32_t n)
{
    const double scaled = n * scale;
    return scaled < 1 ? 1 : scaled > 1e9 ? 1000000000u : (uint32_t)scaled;
}

/* splitmix64: any state is a good one */
static uint64_t mix(uint64_t z)
{
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

test_random random_make(uint64_t stream) { return (test_random){mix(seed + mix(stream + 1))}; }

uint64_t random_bits(test_random *r) { return mix(r->state += UINT64_C(0x9e3779b97f4a7c15)); }

uint32_t random_below(test_random *r, uint32_t count)
{
    return (uint32_t)((random_bits(r) >> 32) * (uint64_t)count >> 32);
}

static double unit(test_random *r) { return (double)(random_bits(r) >> 11) * 0x1p-53; }

float random_float(test_random *r, float low, float high) { return (float)(low + unit(r) * ((double)high - low)); }

float random_log(test_random *r, float low, float high)
{
    return (float)(low * exp(unit(r) * log((double)high / low)));
}

float random_any_float(test_random *r)
{
    const uint32_t bits = (uint32_t)(random_bits(r) >> 32);
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

void random_direction(test_random *r, float d[3])
{
    double length;
    do {
        length = 0;
        for (int a = 0; a < 3; a++) {
            d[a] = random_float(r, -1, 1);
            length += (double)d[a] * d[a];
        }
    } while (length > 1 || length < 1e-4);
    for (int a = 0; a < 3; a++)
        d[a] = (float)(d[a] / sqrt(length));
}

/* Floats in their order as integers. */
static int64_t ordered(float a)
{
    int32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits >= 0 ? bits : -(int64_t)(bits & INT32_MAX);
}

uint32_t ulp_distance(float a, float b)
{
    if (isnan(a) || isnan(b))
        return UINT32_MAX;
    const int64_t d = ordered(a) - ordered(b);
    return (uint32_t)(d < 0 ? -d : d);
}

bool same_bits(float a, float b) { return memcmp(&a, &b, sizeof a) == 0; }
