/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table of a tile's open groups (light_table.h), for each variant: a window that it hides overlaps no open group
 * that ends behind it, whatever the numbers; and it hides most of what can be hidden. */
#include <math.h>
#include <string.h>

#include "kernel/light/light_table.h"
#include "support/suite.h"
#include "support/test.h"
#include "support/random.h"

#define GROUPS 64u

typedef struct groups {
    _Alignas(64) float low[2][GROUPS];
    float high[2][GROUPS], end[GROUPS];
    uint64_t open;
    float lower[2], upper[2];
} groups;

/* Groups of many sizes, which often share an edge or are points. */
static void make_groups(test_random *r, groups *g)
{
    const float scale = random_log(r, 1e-30f, 1e30f), size = random_log(r, 1e-4f, 1);
    g->open = random_bits(r);
    g->open |= random_bits(r); /* three of four */
    g->open |= (uint64_t)(g->open == 0);
    for (int a = 0; a < 2; a++) {
        g->lower[a] = INFINITY;
        g->upper[a] = -INFINITY;
    }
    for (uint32_t k = 0; k < GROUPS; k++) {
        const bool is_open = g->open >> k & 1;
        for (int a = 0; a < 2; a++) {
            const float middle = random_float(r, -1, 1), half = random_below(r, 4) ? size * random_float(r, 0, 1) : 0;
            g->low[a][k] = is_open ? (middle - half) * scale : INFINITY;
            g->high[a][k] = is_open ? (middle + half) * scale : -INFINITY;
            g->lower[a] = fminf(g->lower[a], g->low[a][k]);
            g->upper[a] = fmaxf(g->upper[a], g->high[a][k]);
        }
        g->end[k] = is_open ? random_float(r, -1, 4) : -INFINITY;
    }
}

/* One end of a window: an end of a group, or its neighbour among floats, or anything. */
static float make_end(test_random *r, const groups *g, int a)
{
    const uint32_t k = random_below(r, GROUPS);
    const float near = random_below(r, 2) ? g->low[a][k] : g->high[a][k];
    switch (random_below(r, 8)) {
    case 0: return -INFINITY;
    case 1: return INFINITY;
    case 2: return random_any_float(r);
    case 3: return near;
    case 4: return nextafterf(near, INFINITY);
    case 5: return nextafterf(near, -INFINITY);
    default: return g->lower[a] + random_float(r, 0, 1) * (g->upper[a] - g->lower[a]);
    }
}

static bool is_needed(const groups *g, float low[2], float high[2], float end)
{
    for (uint32_t k = 0; k < GROUPS; k++)
        if (g->open >> k & 1 && g->end[k] >= end && high[0] >= g->low[0][k] && g->high[0][k] >= low[0] &&
            high[1] >= g->low[1][k] && g->high[1][k] >= low[1])
            return true;
    return false;
}

TEST(what_is_hidden_is_not_needed)
{
    test_random r = random_make(1);
    uint64_t hidden = 0, small_hideable = 0;
    for (uint32_t scene = 0; scene < test_scaled(3000); scene++) {
        static groups g;
        static light_table t;
        make_groups(&r, &g);
        const float *const of_low[2] = {g.low[0], g.low[1]}, *const of_high[2] = {g.high[0], g.high[1]};
        light_table_make(&t, g.lower, g.upper, of_low, of_high, g.end, g.open);
        for (uint32_t round = 0; round < 16 && t.is_set; round++) {
            _Alignas(64) float low[2][CGT_LANES], high[2][CGT_LANES], end[CGT_LANES];
            for (uint32_t k = 0; k < CGT_LANES; k++) {
                for (int a = 0; a < 2; a++) {
                    const bool tight = random_below(&r, 2);
                    low[a][k] = make_end(&r, &g, a);
                    high[a][k] = tight ? low[a][k] : make_end(&r, &g, a);
                }
                end[k] = random_below(&r, 2) ? g.end[random_below(&r, GROUPS)] : random_float(&r, -2, 5);
            }
            const vfloat first[2] = {spux_load(low[0]), spux_load(low[1])},
                         last[2] = {spux_load(high[0]), spux_load(high[1])};
            const unsigned bits = spux_mask_bits(light_table_hides(&t, first, last, spux_load(end)));
            for (uint32_t k = 0; k < CGT_LANES; k++) {
                float l[2] = {low[0][k], low[1][k]}, h[2] = {high[0][k], high[1][k]};
                const bool needed = is_needed(&g, l, h, end[k]);
                assert_false(needed && bits >> k & 1);
                hidden += bits >> k & 1;
                small_hideable += !needed && l[0] == h[0] && l[1] == h[1];
            }
        }
    }
    print_message("%llu windows hidden, %llu points that need not be seen\n", (unsigned long long)hidden,
                  (unsigned long long)small_hideable);
    assert_true(hidden * 4 > small_hideable);
}

VARIANT_SUITE("test_light_table", NULL, NULL)
