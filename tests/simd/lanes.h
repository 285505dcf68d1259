/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vectors of the variant that a test is compiled for, lane by lane: operands and comparisons. */
#ifndef LANES_H
#define LANES_H

#include "support/test.h"

#include <math.h>

#include "vector.h"

#define ROUNDS 20000
#define BLOCK_ROWS (CGT_LANES / 4)

/* One vector, as a whole, as vectors of four and as elements. */
typedef union lanes {
    vfloat f;
    vint s;
    vuint u;
    vec_float4 f4[BLOCK_ROWS];
    vec_int4 s4[BLOCK_ROWS];
    vec_uint4 u4[BLOCK_ROWS];
    float ef[CGT_LANES];
    int32_t es[CGT_LANES];
    uint32_t eu[CGT_LANES];
} lanes;

/* ---- operands ---- */

static const float edge[] = {0.f,
                             -0.f,
                             0x1p-149f,
                             -0x1p-149f,
                             0x1.fffffcp-127f,
                             0x1p-126f,
                             -0x1p-126f,
                             0.5f,
                             -0.5f,
                             1.f,
                             -1.f,
                             1.5f,
                             0x1.fffffep-1f,
                             0x1.000002p23f,
                             -0x1p24f,
                             0x1p31f,
                             -0x1p31f,
                             0x1.fffffep30f,
                             -0x1.000002p31f,
                             0x1p32f,
                             0x1.fffffep127f,
                             -0x1.fffffep127f,
                             INFINITY,
                             -INFINITY,
                             NAN,
                             -NAN};
static const uint32_t edge_bits[] = {0,          1,          2,          0x7fffffff, 0x80000000,
                                     0x80000001, 0xffffffff, 0xfffffffe, 0x0000ffff, 0xaaaaaaaa};

static inline lanes any_floats(test_random *r)
{
    lanes a;
    for (int i = 0; i < CGT_LANES; i++)
        switch (random_below(r, 4)) {
        case 0: a.ef[i] = edge[random_below(r, TEST_COUNT(edge))]; break;
        case 1: a.ef[i] = random_any_float(r); break;
        default: a.ef[i] = random_float(r, -100, 100);
        }
    return a;
}
static inline lanes any_words(test_random *r)
{
    lanes a;
    for (int i = 0; i < CGT_LANES; i++)
        a.eu[i] = random_below(r, 3) ? (uint32_t)random_bits(r) : edge_bits[random_below(r, TEST_COUNT(edge_bits))];
    return a;
}
/* Lane i holds edge number first + i: over all of `first`, every edge meets every lane. */
static inline lanes edges(size_t first)
{
    lanes a;
    for (size_t i = 0; i < CGT_LANES; i++)
        a.ef[i] = edge[(first + i) % TEST_COUNT(edge)];
    return a;
}
static inline unsigned any_bits(test_random *r) { return (unsigned)random_bits(r) & CGT_ALL_LANES; }

/* ---- comparison ---- */

static inline void check_bits(const char *word, const lanes *got, const lanes *expected)
{
    for (int i = 0; i < CGT_LANES; i++)
        if (got->eu[i] != expected->eu[i])
            fail_msg("%s, lane %d: 0x%08x, expected 0x%08x", word, i, got->eu[i], expected->eu[i]);
}
/* As results of arithmetic: all NaN are equal. */
static inline void check_floats(const char *word, const lanes *got, const lanes *expected)
{
    for (int i = 0; i < CGT_LANES; i++)
        if (got->eu[i] != expected->eu[i] && !(isnan(got->ef[i]) && isnan(expected->ef[i])))
            fail_msg("%s, lane %d: %a, expected %a", word, i, (double)got->ef[i], (double)expected->ef[i]);
}
static inline void check_mask(const char *word, vmask got, const lanes *expected)
{
    const unsigned bits = spux_mask_bits(got);
    for (int i = 0; i < CGT_LANES; i++)
        if (expected->eu[i] != (bits >> i & 1 ? UINT32_MAX : 0))
            fail_msg("%s, lane %d: %u, expected 0x%08x", word, i, bits >> i & 1, expected->eu[i]);
    assert_int_equal(bits >> (CGT_LANES - 1) >> 1, 0);
}
static inline void check_number(const char *word, uint32_t got, uint32_t expected)
{
    if (got != expected)
        fail_msg("%s: 0x%x, expected 0x%x", word, got, expected);
}

#endif
