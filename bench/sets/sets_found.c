/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Results in memory, compared bit by bit. */
#include "sets/bench_sets.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* No trace writes this byte, so that answers left unwritten do not pass for a trace's own. */
enum { UNTOUCHED = 0xfe, NO_HIT = 0xff /* not a number */ };

int sets_found_create(bench_found *found, uint32_t width, uint32_t height)
{
    memset(found, 0, sizeof *found);
    return bench_planes_create(&found->planes, width, height);
}

static void release_arrays(bench_found *found)
{
    free(found->t);
    free(found->primitive);
    free(found->occluded);
    found->t = NULL;
    found->primitive = NULL;
    found->occluded = NULL;
    found->room = 0;
}

void sets_found_release(bench_found *found)
{
    release_arrays(found);
    bench_planes_release(&found->planes);
}

static int reserve(bench_found *found, uint64_t count)
{
    if (count <= found->room)
        return 0;
    release_arrays(found);
    if (count > SIZE_MAX / sizeof(uint32_t))
        return -1;
    found->t = malloc((size_t)count * sizeof *found->t);
    found->primitive = malloc((size_t)count * sizeof *found->primitive);
    found->occluded = malloc((size_t)count);
    if (found->t && found->primitive && found->occluded) {
        found->room = count;
        return 0;
    }
    release_arrays(found);
    return -1;
}

int sets_found_reset(bench_found *found, bench_query query, uint64_t count)
{
    const size_t words = (size_t)count * sizeof(uint32_t);
    if (query == BENCH_PICTURE) {
        memset(found->planes.t, UNTOUCHED, words);
        memset(found->planes.primitive, UNTOUCHED, words);
        for (int a = 0; a < 3; a++)
            memset(found->planes.normal[a], UNTOUCHED, words);
        return 0;
    }
    if (reserve(found, count))
        return -1;
    if (count && (query == BENCH_NEAREST || query == BENCH_FOUR)) {
        const int pattern = query == BENCH_FOUR ? NO_HIT : UNTOUCHED; /* rows are not filled */
        memset(found->t, pattern, words);
        memset(found->primitive, pattern, words);
        memset(found->occluded, 0, (size_t)count);
    } else if (count)
        memset(found->occluded, query == BENCH_LIT_PICTURE ? 0 : UNTOUCHED, (size_t)count);
    return 0;
}

uint64_t sets_found_hits(const bench_found *found, bench_query query, int is_flags, uint64_t count)
{
    const float *t = query == BENCH_PICTURE ? found->planes.t : found->t;
    const int has_t = query == BENCH_PICTURE || ((query == BENCH_NEAREST || query == BENCH_FOUR) && !is_flags);
    uint64_t hits = 0;
    for (uint64_t i = 0; i < count; i++)
        hits += has_t ? t[i] < INFINITY : found->occluded[i];
    return hits;
}

/* ---- comparison ---- */

/* The words of a result: t, primitive, normal. Returns their number. */
static int words_of(const bench_found *found, bench_query query, uint64_t i, uint32_t word[5])
{
    const int is_picture = query == BENCH_PICTURE;
    if (!is_picture && query != BENCH_NEAREST && query != BENCH_FOUR) {
        word[0] = found->occluded[i];
        return 1;
    }
    memcpy(&word[0], (is_picture ? found->planes.t : found->t) + i, sizeof word[0]);
    word[1] = (is_picture ? found->planes.primitive : found->primitive)[i];
    for (int a = 0; a < 3 && is_picture; a++)
        memcpy(&word[2 + a], found->planes.normal[a] + i, sizeof word[0]);
    return is_picture ? 5 : 2;
}

/* t is shown with its bits, since two values may look alike. */
static int describe(const uint32_t word[5], int words, char *text, size_t size)
{
    float t;
    memcpy(&t, &word[0], sizeof t);
    if (words == 1)
        return snprintf(text, size, "occluded %" PRIu32, word[0]);
    if (words == 2)
        return snprintf(text, size, "t %.9g (%08" PRIx32 "), primitive %" PRIu32, (double)t, word[0], word[1]);
    return snprintf(text, size,
                    "t %.9g (%08" PRIx32 "), primitive %" PRIu32 ", normal %08" PRIx32 " %08" PRIx32 " %08" PRIx32,
                    (double)t, word[0], word[1], word[2], word[3], word[4]);
}

uint64_t sets_found_differ(const bench_found *expected, const bench_found *found, bench_query query, uint64_t count,
                           char *text, size_t size)
{
    uint64_t different = 0;
    text[0] = '\0';
    for (uint64_t i = 0; i < count; i++) {
        uint32_t a[5], b[5];
        const int words = words_of(expected, query, i, a);
        words_of(found, query, i, b);
        if (!memcmp(a, b, (size_t)words * sizeof a[0]))
            continue;
        if (different++ == 0) {
            char is[160], should_be[160];
            describe(b, words, is, sizeof is);
            describe(a, words, should_be, sizeof should_be);
            snprintf(text, size, "ray %" PRIu64 ": %s, not %s", i, is, should_be);
        }
    }
    return different;
}
