/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Answers in memory, compared bit by bit. */
#include "structures/structures_found.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* No trace writes this byte, so that answers left unwritten do not pass for a trace's own. */
enum { UNTOUCHED = 0xfe };

int structures_found_create(structures_found *found, uint32_t width, uint32_t height)
{
    memset(found, 0, sizeof *found);
    return bench_planes_create(&found->planes, width, height);
}

static void release_arrays(structures_found *found)
{
    free(found->t);
    free(found->primitive);
    free(found->occluded);
    found->t = NULL;
    found->primitive = NULL;
    found->occluded = NULL;
    found->room = 0;
}

void structures_found_release(structures_found *found)
{
    release_arrays(found);
    bench_planes_release(&found->planes);
}

static int reserve(structures_found *found, uint64_t count)
{
    if (count <= found->room)
        return 0;
    release_arrays(found);
    if (count > SIZE_MAX / sizeof(uint32_t))
        return -1;
    found->t = malloc((size_t)count * sizeof *found->t);
    found->primitive = malloc((size_t)count * sizeof *found->primitive);
    found->occluded = malloc((size_t)count);
    if (!found->t || !found->primitive || !found->occluded) {
        release_arrays(found);
        return -1;
    }
    found->room = count;
    return 0;
}

int structures_found_reset(structures_found *found, found_form form, uint64_t count)
{
    const size_t words = (size_t)count * sizeof(uint32_t);
    if (form == FOUND_FRAME) {
        memset(found->planes.t, UNTOUCHED, words);
        memset(found->planes.primitive, UNTOUCHED, words);
        for (int a = 0; a < 3; a++)
            memset(found->planes.normal[a], UNTOUCHED, words);
        return 0;
    }
    if (reserve(found, count))
        return -1;
    if (count && form == FOUND_HITS) {
        memset(found->t, UNTOUCHED, words);
        memset(found->primitive, UNTOUCHED, words);
    } else if (count)
        memset(found->occluded, UNTOUCHED, (size_t)count);
    return 0;
}

uint64_t structures_found_hits(const structures_found *found, found_form form, uint64_t count)
{
    const float *t = form == FOUND_FRAME ? found->planes.t : found->t;
    uint64_t hits = 0;
    for (uint64_t i = 0; i < count; i++)
        hits += form == FOUND_OCCLUDED ? found->occluded[i] : t[i] < INFINITY;
    return hits;
}

/* ---- Comparison ---------------------------------------------------------------------------------------------- */

/* The words of a ray's answer: t, primitive, normal. Returns their number. */
static int words_of(const structures_found *found, found_form form, uint64_t i, uint32_t word[5])
{
    if (form == FOUND_OCCLUDED) {
        word[0] = found->occluded[i];
        return 1;
    }
    memcpy(&word[0], (form == FOUND_FRAME ? found->planes.t : found->t) + i, sizeof word[0]);
    word[1] = (form == FOUND_FRAME ? found->planes.primitive : found->primitive)[i];
    if (form == FOUND_HITS)
        return 2;
    for (int a = 0; a < 3; a++)
        memcpy(&word[2 + a], found->planes.normal[a] + i, sizeof word[0]);
    return 5;
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

uint64_t structures_found_differ(const structures_found *expected, const structures_found *found, found_form form,
                                 uint64_t count, char *text, size_t size)
{
    uint64_t different = 0;
    text[0] = '\0';
    for (uint64_t i = 0; i < count; i++) {
        uint32_t a[5], b[5];
        const int words = words_of(expected, form, i, a);
        words_of(found, form, i, b);
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
