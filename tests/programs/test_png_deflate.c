/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Compression by the library that this program was compiled with: the streams hold what was given. */
#include "support/inflate.h"
#include "support/suite.h"
#include "support/test.h"

#include <stdlib.h>
#include <string.h>

#include "picture/files/png_deflate.h"

/* ---- What is compressed ------------------------------------------------------------------------------------- */

typedef struct given {
    const uint8_t *bytes;
    size_t left;
    size_t most; /* of a band */
} given;

static size_t give(void *user, uint8_t *bytes)
{
    given *const g = user;
    const size_t size = g->left < g->most ? g->left : g->most;
    memcpy(bytes, g->bytes, size);
    g->bytes += size;
    g->left -= size;
    return size;
}

enum { NOISE, ZEROS, RAMP, WORDS, CONTENTS };

static void fill(uint8_t *bytes, size_t size, int content)
{
    uint64_t seed = size;
    for (size_t i = 0; i < size; i++) {
        seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
        const uint8_t noise = (uint8_t)(seed >> 56);
        bytes[i] = content == NOISE   ? noise
                   : content == ZEROS ? 0
                   : content == RAMP  ? (uint8_t)(i / 7)
                                      : (uint8_t) "libcgt casts rays "[(i + (noise > 250)) % 18];
    }
}

TEST(streams_hold_what_was_given)
{
    static const size_t sizes[] = {1, 2, 100, PNG_BAND - 1, PNG_BAND, PNG_BAND + 1, 300000};
    static const size_t bands[] = {PNG_BAND, 1000};
    png_deflate *const deflate = png_deflate_create();
    assert_non_null(deflate);
    for (size_t s = 0; s < TEST_COUNT(bands) * CONTENTS * TEST_COUNT(sizes); s++) {
        const size_t size = sizes[s % TEST_COUNT(sizes)], most = bands[s / TEST_COUNT(sizes) / CONTENTS];
        const int content = (int)(s / TEST_COUNT(sizes) % CONTENTS);
        const size_t bound = png_deflate_bound(size);
        uint8_t *const bytes = malloc(size), *const stream = malloc(bound), *const again = malloc(size);
        assert_true(bytes && stream && again);
        fill(bytes, size, content);
        given g = {bytes, size, most};
        const size_t got = png_deflate_run(deflate, give, &g, size, stream);
        assert_true(got > 0 && got <= bound);
        assert_true(size < 1000 || content == NOISE || got < size / 2);
        assert_int_equal(inflate_all(stream, got, again, size), size);
        assert_memory_equal(again, bytes, size);
        free(bytes);
        free(stream);
        free(again);
    }
    png_deflate_release(deflate);
}

/* A source that ends too soon is a failure, and the next picture is none the worse. */
TEST(short_sources_fail)
{
    static uint8_t bytes[200000], stream[210000], again[200000];
    png_deflate *const deflate = png_deflate_create();
    assert_non_null(deflate);
    fill(bytes, sizeof bytes, WORDS);
    for (int round = 0; round < 2; round++) {
        given g = {bytes, sizeof bytes - 1, PNG_BAND};
        assert_int_equal(png_deflate_run(deflate, give, &g, sizeof bytes, stream), 0);
        g = (given){bytes, sizeof bytes, PNG_BAND};
        const size_t got = png_deflate_run(deflate, give, &g, sizeof bytes, stream);
        assert_int_equal(inflate_all(stream, got, again, sizeof again), sizeof again);
        assert_memory_equal(again, bytes, sizeof again);
    }
    png_deflate_release(deflate);
    png_deflate_release(NULL);
}

TEST(names_are_those_of_the_libraries) { assert_string_equal(png_deflate_name(), DEFLATE_NAME); }

SEEDED_SUITE("test_png_deflate", NULL, NULL)
