/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The comparison of results in cgt-bench, which must find every differing bit. */
#include "support/test.h"
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sets/bench_sets.h"

enum { WIDTH = 7, HEIGHT = 5, PIXELS = WIDTH * HEIGHT, RAYS = 40 };

static bench_found make_found(void)
{
    bench_found found;
    assert_int_equal(sets_found_create(&found, WIDTH, HEIGHT), 0);
    assert_int_equal(sets_found_reset(&found, BENCH_PICTURE, PIXELS), 0);
    assert_int_equal(sets_found_reset(&found, BENCH_NEAREST, RAYS), 0);
    assert_int_equal(sets_found_reset(&found, BENCH_ANY, RAYS), 0);
    return found;
}

TEST(test_comparison)
{
    test_random random = random_make(2);
    bench_found a = make_found(), b = make_found();
    char text[400], name[64];
    const struct {
        bench_query query;
        void *memory;
        uint32_t count, bytes; /* rays, and bytes of each */
    } places[] = {{BENCH_PICTURE, b.planes.t, PIXELS, 4},         {BENCH_PICTURE, b.planes.primitive, PIXELS, 4},
                  {BENCH_PICTURE, b.planes.normal[0], PIXELS, 4}, {BENCH_PICTURE, b.planes.normal[1], PIXELS, 4},
                  {BENCH_PICTURE, b.planes.normal[2], PIXELS, 4}, {BENCH_NEAREST, b.t, RAYS, 4},
                  {BENCH_NEAREST, b.primitive, RAYS, 4},          {BENCH_ANY, b.occluded, RAYS, 1}};
    for (size_t p = 0; p < TEST_COUNT(places); p++)
        for (int round = 0; round < 20; round++) {
            unsigned char *bytes = places[p].memory;
            const uint32_t ray = random_below(&random, places[p].count);
            const size_t at = (size_t)ray * places[p].bytes + random_below(&random, places[p].bytes);
            const unsigned char bit = (unsigned char)(1u << random_below(&random, 8));
            assert_int_equal(sets_found_differ(&a, &b, places[p].query, places[p].count, text, sizeof text), 0);
            assert_string_equal(text, "");
            bytes[at] ^= bit;
            assert_int_equal(sets_found_differ(&a, &b, places[p].query, places[p].count, text, sizeof text), 1);
            snprintf(name, sizeof name, "ray %u: ", (unsigned)ray);
            assert_non_null(strstr(text, name));
            bytes[at] ^= bit;
        }
    /* Several rays: the first one is named. */
    b.t[3] = b.t[5] = 1.0f;
    b.primitive[3] = 7;
    assert_int_equal(sets_found_differ(&a, &b, BENCH_NEAREST, RAYS, text, sizeof text), 2);
    assert_non_null(strstr(text, "ray 3: t 1 (3f800000), primitive 7, not t "));
    sets_found_release(&a);
    sets_found_release(&b);
}

TEST(test_hits)
{
    bench_found found = make_found();
    for (uint32_t i = 0; i < RAYS; i++) {
        found.t[i] = i % 4 ? (float)i : INFINITY;
        found.occluded[i] = i % 4 == 0;
    }
    for (uint32_t i = 0; i < PIXELS; i++)
        found.planes.t[i] = i % 5 ? INFINITY : 2.0f;
    assert_int_equal(sets_found_hits(&found, BENCH_NEAREST, 0, RAYS), 30);
    assert_int_equal(sets_found_hits(&found, BENCH_ANY, 0, RAYS), 10);
    assert_int_equal(sets_found_hits(&found, BENCH_NEAREST, 1, RAYS), 10); /* by flags, as Embree tells */
    assert_int_equal(sets_found_hits(&found, BENCH_PICTURE, 0, PIXELS), 7);
    memset(found.t, 0, RAYS * sizeof *found.t);
    assert_int_equal(sets_found_reset(&found, BENCH_NEAREST, RAYS), 0);
    assert_false(found.t[3] == 0.0f); /* no answer of a trace's */
    sets_found_release(&found);
}

SEEDED_SUITE("test_bench_found", NULL, NULL)
