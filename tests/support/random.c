/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random numbers. */
#include "support/random.h"

#include <math.h>
#include <string.h>

static uint64_t seed = RANDOM_DEFAULT_SEED;

/* splitmix64: any state is a good one */
static uint64_t mix(uint64_t z)
{
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

void random_seed(uint64_t of_all) { seed = of_all; }

test_random random_make(uint64_t stream) { return (test_random){.state = mix(seed + mix(stream + 1))}; }

test_random random_of_bytes(const uint8_t *bytes, size_t count) { return (test_random){.bytes = bytes, .left = count}; }

uint64_t random_bits(test_random *r)
{
    const uint64_t bits = mix(r->state += UINT64_C(0x9e3779b97f4a7c15));
    if (r->left < 2)
        return bits;
    const uint64_t first = (uint64_t)r->bytes[0] << 8 | r->bytes[1];
    r->bytes += 2;
    r->left -= 2;
    return first << 48 | bits >> 16;
}

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

bool same_bits(float a, float b) { return memcmp(&a, &b, sizeof a) == 0; }
