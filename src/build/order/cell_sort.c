/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Objects sorted by their cells: linear, in order, and the same for any number of threads. */
#include "build/grid/loose_grid_build.h"

#include <string.h>

#define DIGIT_BITS (32 - CGT_LOOSE_CHUNK_BITS)
#define NUMBER (CGT_LOOSE_CHUNK - 1) /* of an entry */
#define STREAMS 4u                   /* of a chunk */
#define AHEAD 4u                     /* chunks whose parts of a bin are on their way */

uint32_t cgt_loose_sort_plan(cgt_loose_sort *sort, const cgt_context *context, uint32_t objects, uint32_t valid,
                             uint32_t cells)
{
    const uint32_t few = context->tasks.run ? CGT_LOOSE_FEW : CGT_LOOSE_FEW_ALONE;
    unsigned shift = 0;
    while (shift < DIGIT_BITS && (CGT_LOOSE_BIN_CELLS >> shift > 1 || (cells - 1) >> shift >= CGT_LOOSE_BINS))
        shift++;
    sort->objects = objects;
    sort->valid = valid;
    sort->cells = cells;
    sort->direct = objects <= CGT_LOOSE_CHUNK || (objects <= few && cells <= CGT_LOOSE_FEW_CELLS);
    sort->shift = shift;
    sort->bins = ((cells - 1) >> shift) + 1;
    return sort->direct ? cells : sort->bins << shift;
}

static inline size_t row_words(const cgt_loose_sort *s) { return (size_t)s->bins + 1; }

static inline uint32_t *chunk_row(const cgt_loose_sort *s, uint32_t chunk)
{
    return s->place + (size_t)chunk * STREAMS * row_words(s);
}

cgt_result cgt_loose_sort_reserve(const cgt_memory_hooks *hooks, cgt_buffer *place, const cgt_loose_sort *s)
{
    const size_t rows = (size_t)cgt_loose_chunks(s->objects) * STREAMS + 1;
    const size_t words = s->bins < CGT_LOOSE_BINS ? CGT_LOOSE_BINS + 1 : row_words(s);
    return s->direct ? CGT_OK : cgt_buffer_reserve(hooks, place, rows, words * sizeof *s->place);
}

/* ---- chunks ---- */

/* Turns counts to starts. Each start is moved to its end, the next one's start, as what is counted moves. */
static uint32_t start_of_counts(uint32_t *count, size_t counts, uint32_t first)
{
    for (size_t k = 0; k < counts; k++) {
        const uint32_t here = count[k];
        count[k] = first;
        first += here;
    }
    return first;
}

static inline void move(uint32_t *place, uint32_t key, unsigned shift, uint32_t number, uint32_t *entry)
{
    const uint32_t digit = key & ((UINT32_C(1) << shift) - 1);
    entry[place[key >> shift]++] = digit << CGT_LOOSE_CHUNK_BITS | number;
}

/* A chunk's keys run as four streams side by side, each with a row of places of its own: where neighbours share a bin,
 * its one place would be waited for. */
void cgt_loose_sort_chunk(const cgt_loose_sort *s, uint32_t chunk)
{
    const uint32_t first = chunk * CGT_LOOSE_CHUNK, left = s->objects - first;
    const uint32_t count = left < CGT_LOOSE_CHUNK ? left : CGT_LOOSE_CHUNK, share = count / STREAMS;
    const unsigned shift = s->shift;
    const size_t words = row_words(s);
    const uint32_t *key = s->key + first;
    if (s->direct)
        return; /* and there is no room for places */
    uint32_t *row = chunk_row(s, chunk), *entry = s->entry + first, sum = 0;
    const uint32_t *k0 = key, *k1 = k0 + share, *k2 = k1 + share, *k3 = k2 + share;
    uint32_t *p0 = row, *p1 = p0 + words, *p2 = p1 + words, *p3 = p2 + words;
    memset(row, 0, STREAMS * words * sizeof *row);
    for (uint32_t i = 0; i < share; i++) {
        p0[k0[i] >> shift]++;
        p1[k1[i] >> shift]++;
        p2[k2[i] >> shift]++;
        p3[k3[i] >> shift]++;
    }
    for (uint32_t i = STREAMS * share; i < count; i++)
        p3[key[i] >> shift]++;
    for (size_t bin = 0; bin < words; bin++)
        for (size_t k = 0; k < STREAMS; k++) {
            const uint32_t here = row[k * words + bin];
            row[k * words + bin] = sum;
            sum += here;
        }
    for (uint32_t i = 0; i < share; i++) {
        move(p0, k0[i], shift, i, entry);
        move(p1, k1[i], shift, share + i, entry);
        move(p2, k2[i], shift, 2 * share + i, entry);
        move(p3, k3[i], shift, 3 * share + i, entry);
    }
    for (uint32_t i = STREAMS * share; i < count; i++)
        move(p3, key[i], shift, i, entry);
}

/* ---- bins ---- */

/* Where bins begin, from where their parts of the chunks end. */
static void place_bins(const cgt_loose_sort *s)
{
    const uint32_t chunks = cgt_loose_chunks(s->objects);
    const size_t words = row_words(s);
    uint32_t *begin = chunk_row(s, chunks);
    memset(begin, 0, words * sizeof *begin);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const uint32_t *end = chunk_row(s, chunk) + (STREAMS - 1) * words;
        for (size_t bin = 0; bin + 1 < words; bin++)
            begin[bin + 1] += end[bin];
    }
}

/* A bin's part of a chunk. */
typedef struct bin_part {
    const uint32_t *entry;
    uint32_t count;
} bin_part;

static inline bin_part part_of(const cgt_loose_sort *s, uint32_t chunk, uint32_t bin)
{
    const uint32_t *end = chunk_row(s, chunk) + (STREAMS - 1) * row_words(s), begin = bin ? end[bin - 1] : 0;
    return (bin_part){s->entry + (size_t)chunk * CGT_LOOSE_CHUNK + begin, end[bin] - begin};
}

/* Parts are short, and come after each other from afar: no cache would foresee them. */
static inline void prefetch_part(const cgt_loose_sort *s, uint32_t chunk, uint32_t bin)
{
    const bin_part part = part_of(s, chunk, bin);
    for (uint32_t i = 0; i < part.count; i += 64 / sizeof *part.entry)
        __builtin_prefetch(part.entry + i);
    __builtin_prefetch(part.entry + part.count);
}

/* Each start was moved to its cell's end, which is the next one's start. */
static void restore_starts(uint32_t *start, uint32_t cells, uint32_t first)
{
    memmove(start + 1, start, (cells - 1) * sizeof *start);
    start[0] = first;
}

/* Gathers a bin, and sorts it by cell. */
static void sort_bin(void *argument, uint32_t bin)
{
    const cgt_loose_sort *s = argument;
    const uint32_t chunks = cgt_loose_chunks(s->objects), begin = chunk_row(s, chunks)[bin];
    const uint32_t first = bin << s->shift, left = s->cells - first, most = UINT32_C(1) << s->shift;
    const uint32_t cells = left < most ? left : most;
    uint32_t *start = s->start + first, *object = s->object;
    memset(start, 0, cells * sizeof *start);
    for (uint32_t chunk = 0; chunk < AHEAD && chunk < chunks; chunk++)
        prefetch_part(s, chunk, bin);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const bin_part part = part_of(s, chunk, bin);
        if (chunks - chunk > AHEAD)
            prefetch_part(s, chunk + AHEAD, bin);
        for (uint32_t i = 0; i < part.count; i++)
            start[part.entry[i] >> CGT_LOOSE_CHUNK_BITS]++;
    }
    start_of_counts(start, cells, begin);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const bin_part part = part_of(s, chunk, bin);
        const uint32_t base = chunk * CGT_LOOSE_CHUNK;
        for (uint32_t i = 0; i < part.count; i++)
            object[start[part.entry[i] >> CGT_LOOSE_CHUNK_BITS]++] = base + (part.entry[i] & NUMBER);
    }
    restore_starts(start, cells, begin);
}

/* ---- the whole ---- */

/* By whole keys. A cell more takes what is skipped. */
static void sort_all(const cgt_loose_sort *s)
{
    const uint32_t *key = s->key;
    uint32_t *start = s->start;
    memset(start, 0, ((size_t)s->cells + 1) * sizeof *start);
    for (uint32_t i = 0; i < s->objects; i++)
        start[key[i]]++;
    start_of_counts(start, (size_t)s->cells + 1, 0);
    for (uint32_t i = 0; i < s->objects; i++)
        s->object[start[key[i]]++] = i;
    restore_starts(start, s->cells + 1, 0);
}

void cgt_loose_sort_run(cgt_loose_sort *sort, const cgt_context *context)
{
    if (sort->direct) {
        sort_all(sort);
        return;
    }
    place_bins(sort);
    cgt_run_tasks(context, sort_bin, sort, sort->bins);
    sort->start[sort->cells] = sort->valid;
}
