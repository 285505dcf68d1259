/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Results of a row in memory, and their comparison bit by bit. */
#include "structures/bench_structures_results.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What no trace writes: results that a trace left alone must not pass for its own. */
enum { UNTOUCHED = 0xfe };

int structures_results_create(structures_results *results, uint32_t width, uint32_t height)
{
    memset(results, 0, sizeof *results);
    if (bench_planes_create(&results->planes, width, height))
        return -1;
    results->geometry = calloc((size_t)width * height, sizeof *results->geometry);
    return results->geometry ? 0 : -1;
}

void structures_results_release(structures_results *results)
{
    if (results->planes.t)
        bench_planes_release(&results->planes);
    free(results->geometry);
    free(results->shadow.occluded);
    free(results->ao.occluded);
    structures_hits_release(&results->random);
    memset(results, 0, sizeof *results);
}

void structures_hits_release(structures_hits *hits)
{
    free(hits->t);
    free(hits->primitive);
    free(hits->geometry);
    memset(hits, 0, sizeof *hits);
}

int structures_hits_reset(structures_hits *hits, uint64_t count)
{
    if (count > hits->room) {
        structures_hits_release(hits);
        if (count > SIZE_MAX / sizeof(uint32_t))
            return -1;
        hits->t = malloc((size_t)count * sizeof *hits->t);
        hits->primitive = malloc((size_t)count * sizeof *hits->primitive);
        hits->geometry = malloc((size_t)count * sizeof *hits->geometry);
        if (!hits->t || !hits->primitive || !hits->geometry) {
            structures_hits_release(hits);
            return -1;
        }
        hits->room = count;
    }
    hits->count = count;
    if (count) {
        memset(hits->t, UNTOUCHED, (size_t)count * sizeof *hits->t);
        memset(hits->primitive, UNTOUCHED, (size_t)count * sizeof *hits->primitive);
        memset(hits->geometry, UNTOUCHED, (size_t)count * sizeof *hits->geometry);
    }
    return 0;
}

int structures_occluded_reset(structures_occluded *occluded, uint64_t count)
{
    if (count > occluded->room) {
        free(occluded->occluded);
        memset(occluded, 0, sizeof *occluded);
        if (count > SIZE_MAX || !(occluded->occluded = malloc((size_t)count)))
            return -1;
        occluded->room = count;
    }
    occluded->count = count;
    if (count)
        memset(occluded->occluded, UNTOUCHED, (size_t)count);
    return 0;
}

void structures_planes_reset(structures_results *results)
{
    const size_t pixels = (size_t)results->planes.width * results->planes.height;
    memset(results->planes.t, UNTOUCHED, pixels * sizeof(float));
    memset(results->planes.primitive, UNTOUCHED, pixels * sizeof(uint32_t));
    memset(results->geometry, UNTOUCHED, pixels * sizeof(uint32_t));
    for (int a = 0; a < 3; a++)
        memset(results->planes.normal[a], UNTOUCHED, pixels * sizeof(float));
}

/* ---- Comparison ---------------------------------------------------------------------------------------------- */

/* The values of one kind of ray side by side; NULL where a kind has none. */
typedef struct outcome {
    const void *plane[6]; /* t, primitive, geometry, normal */
} outcome;

static uint32_t word_at(const void *plane, uint64_t i)
{
    uint32_t word;
    memcpy(&word, (const unsigned char *)plane + i * sizeof word, sizeof word);
    return word;
}

/* Index of the first ray of which a word differs; count where there is none. */
static uint64_t first_difference(const outcome *a, const outcome *b, uint64_t count)
{
    uint64_t first = count;
    for (size_t p = 0; p < sizeof a->plane / sizeof a->plane[0]; p++) {
        if (!a->plane[p] || !memcmp(a->plane[p], b->plane[p], (size_t)first * sizeof(uint32_t)))
            continue;
        for (uint64_t i = 0; i < first; i++)
            if (word_at(a->plane[p], i) != word_at(b->plane[p], i))
                first = i;
    }
    return first;
}

/* A hit in words; t is shown with its bits, since two values may look alike. */
static void describe_hit(const outcome *o, uint64_t i, char *text, size_t size)
{
    const uint32_t bits = word_at(o->plane[0], i);
    float t;
    memcpy(&t, &bits, sizeof t);
    int length = snprintf(text, size, "t %.9g (%08" PRIx32 "), primitive %" PRIu32 ", geometry %" PRIu32, (double)t,
                          bits, word_at(o->plane[1], i), word_at(o->plane[2], i));
    if (o->plane[3] && length > 0 && (size_t)length < size)
        snprintf(text + length, size - (size_t)length, ", normal %08" PRIx32 " %08" PRIx32 " %08" PRIx32,
                 word_at(o->plane[3], i), word_at(o->plane[4], i), word_at(o->plane[5], i));
}

/* Appends a sentence to text. */
static void say(char *text, size_t size, const char *what, const char *found, const char *expected)
{
    const size_t length = strlen(text);
    if (length < size)
        snprintf(text + length, size - length, "%s%s: %s, not %s", length ? "; " : "", what, found, expected);
}

static int hits_differ(const outcome *expected, const outcome *found, uint64_t count, const char *kind, uint32_t width,
                       char *text, size_t size)
{
    char what[96], is[192], should_be[192];
    const uint64_t i = first_difference(expected, found, count);
    if (i == count)
        return 0;
    if (width)
        snprintf(what, sizeof what, "%s ray %" PRIu64 " (pixel %" PRIu64 ",%" PRIu64 ")", kind, i, i % width,
                 i / width);
    else
        snprintf(what, sizeof what, "%s ray %" PRIu64, kind, i);
    describe_hit(found, i, is, sizeof is);
    describe_hit(expected, i, should_be, sizeof should_be);
    say(text, size, what, is, should_be);
    return 1;
}

static int occlusion_differs(const structures_occluded *expected, const structures_occluded *found, const char *kind,
                             char *text, size_t size)
{
    char what[96], is[8], should_be[8];
    if (!expected->count || !memcmp(expected->occluded, found->occluded, (size_t)expected->count))
        return 0;
    uint64_t i = 0;
    while (expected->occluded[i] == found->occluded[i])
        i++;
    snprintf(what, sizeof what, "%s ray %" PRIu64 ": occluded", kind, i);
    snprintf(is, sizeof is, "%u", found->occluded[i]);
    snprintf(should_be, sizeof should_be, "%u", expected->occluded[i]);
    say(text, size, what, is, should_be);
    return 1;
}

static outcome outcome_of_planes(const structures_results *r)
{
    const bench_planes *p = &r->planes;
    return (outcome){{p->t, p->primitive, r->geometry, p->normal[0], p->normal[1], p->normal[2]}};
}

static outcome outcome_of_hits(const structures_hits *h) { return (outcome){{h->t, h->primitive, h->geometry}}; }

int structures_results_differ(const structures_results *expected, const structures_results *found, char *text,
                              size_t size)
{
    const uint64_t pixels = (uint64_t)expected->planes.width * expected->planes.height;
    outcome a = outcome_of_planes(expected), b = outcome_of_planes(found);
    text[0] = '\0';
    int differs = hits_differ(&a, &b, pixels, "primary", expected->planes.width, text, size);
    differs |= occlusion_differs(&expected->shadow, &found->shadow, "shadow", text, size);
    differs |= occlusion_differs(&expected->ao, &found->ao, "ambient-occlusion", text, size);
    a = outcome_of_hits(&expected->random);
    b = outcome_of_hits(&found->random);
    if (expected->random.count)
        differs |= hits_differ(&a, &b, expected->random.count, "random", 0, text, size);
    return differs;
}
