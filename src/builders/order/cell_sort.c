/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Objects sorted by their cells: linear, in order, and the same for any number of threads. */
#include "builders/grid/loose_grid_build.h"

#include <string.h>

#define DIGIT_BITS (32 - CGT_CELL_SORT_CHUNK_BITS)
#define NUMBER_MASK (CGT_CELL_SORT_CHUNK - 1) /* of an entry */
#define SUBCHUNKS 4u                          /* of a chunk */
#define PREFETCH_CHUNKS 4u                    /* chunks whose parts of a bin are on their way */

uint32_t cgt_cell_sort_plan(cgt_cell_sort *sort, const cgt_context *context, uint32_t prims, uint32_t valid,
                            uint32_t cells)
{
    const uint32_t direct_limit = context->tasks.run ? CGT_CELL_SORT_DIRECT : CGT_CELL_SORT_DIRECT_SERIAL;
    unsigned shift = 0;
    while (shift < DIGIT_BITS && (CGT_CELL_SORT_BIN_CELLS >> shift > 1 || (cells - 1) >> shift >= CGT_CELL_SORT_BINS))
        shift++;
    sort->prims = prims;
    sort->valid = valid;
    sort->cells = cells;
    sort->direct = prims <= CGT_CELL_SORT_CHUNK || (prims <= direct_limit && cells <= CGT_CELL_SORT_DIRECT_CELLS);
    sort->shift = shift;
    sort->bins = ((cells - 1) >> shift) + 1;
    return sort->direct ? cells : sort->bins << shift;
}

static inline size_t row_words(const cgt_cell_sort *s) { return (size_t)s->bins + 1; }

static inline uint32_t *chunk_row(const cgt_cell_sort *s, uint32_t chunk)
{
    return s->bin_end + (size_t)chunk * SUBCHUNKS * row_words(s);
}

cgt_result cgt_cell_sort_reserve(const cgt_memory_hooks *hooks, cgt_buffer *bin_end, const cgt_cell_sort *s)
{
    const size_t rows = (size_t)cgt_cell_sort_chunks(s->prims) * SUBCHUNKS + 1;
    const size_t words = s->bins < CGT_CELL_SORT_BINS ? CGT_CELL_SORT_BINS + 1 : row_words(s);
    return s->direct ? CGT_OK : cgt_buffer_reserve(hooks, bin_end, rows, words * sizeof *s->bin_end);
}

/* ---- chunks ---- */

/* Turns counts to starts. Each start is moved to its end, the next one's start, as what is counted moves. */
static uint32_t prefix_sum(uint32_t *count, size_t counts, uint32_t first)
{
    for (size_t k = 0; k < counts; k++) {
        const uint32_t entries = count[k];
        count[k] = first;
        first += entries;
    }
    return first;
}

static inline void scatter(uint32_t *bin_end, uint32_t key, unsigned shift, uint32_t number, uint32_t *entry)
{
    const uint32_t digit = key & ((UINT32_C(1) << shift) - 1);
    entry[bin_end[key >> shift]++] = digit << CGT_CELL_SORT_CHUNK_BITS | number;
}

/* A chunk's keys run as four streams side by side, each with a row of places of its own: where neighbours share a bin,
 * its one place would be waited for. */
void cgt_cell_sort_chunk(const cgt_cell_sort *s, uint32_t chunk)
{
    const uint32_t first = chunk * CGT_CELL_SORT_CHUNK, remaining = s->prims - first;
    const uint32_t count = remaining < CGT_CELL_SORT_CHUNK ? remaining : CGT_CELL_SORT_CHUNK, share = count / SUBCHUNKS;
    const unsigned shift = s->shift;
    const size_t words = row_words(s);
    const uint32_t *key = s->key + first;
    if (s->direct)
        return; /* and there is no room for places */
    uint32_t *row = chunk_row(s, chunk), *entry = s->entry + first, sum = 0;
    const uint32_t *k0 = key, *k1 = k0 + share, *k2 = k1 + share, *k3 = k2 + share;
    uint32_t *p0 = row, *p1 = p0 + words, *p2 = p1 + words, *p3 = p2 + words;
    memset(row, 0, SUBCHUNKS * words * sizeof *row);
    for (uint32_t i = 0; i < share; i++) {
        p0[k0[i] >> shift]++;
        p1[k1[i] >> shift]++;
        p2[k2[i] >> shift]++;
        p3[k3[i] >> shift]++;
    }
    for (uint32_t i = SUBCHUNKS * share; i < count; i++)
        p3[key[i] >> shift]++;
    for (size_t bin = 0; bin < words; bin++)
        for (size_t k = 0; k < SUBCHUNKS; k++) {
            const uint32_t entries = row[k * words + bin];
            row[k * words + bin] = sum;
            sum += entries;
        }
    for (uint32_t i = 0; i < share; i++) {
        scatter(p0, k0[i], shift, i, entry);
        scatter(p1, k1[i], shift, share + i, entry);
        scatter(p2, k2[i], shift, 2 * share + i, entry);
        scatter(p3, k3[i], shift, 3 * share + i, entry);
    }
    for (uint32_t i = SUBCHUNKS * share; i < count; i++)
        scatter(p3, key[i], shift, i, entry);
}

/* ---- bins ---- */

/* Where bins begin, from where their parts of the chunks end. */
static void compute_bin_starts(const cgt_cell_sort *s)
{
    const uint32_t chunks = cgt_cell_sort_chunks(s->prims);
    const size_t words = row_words(s);
    uint32_t *begin = chunk_row(s, chunks);
    memset(begin, 0, words * sizeof *begin);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const uint32_t *end = chunk_row(s, chunk) + (SUBCHUNKS - 1) * words;
        for (size_t bin = 0; bin + 1 < words; bin++)
            begin[bin + 1] += end[bin];
    }
}

/* A bin's part of a chunk. */
typedef struct bin_part {
    const uint32_t *entry;
    uint32_t count;
} bin_part;

static inline bin_part bin_part_of(const cgt_cell_sort *s, uint32_t chunk, uint32_t bin)
{
    const uint32_t *end = chunk_row(s, chunk) + (SUBCHUNKS - 1) * row_words(s), begin = bin ? end[bin - 1] : 0;
    return (bin_part){s->entry + (size_t)chunk * CGT_CELL_SORT_CHUNK + begin, end[bin] - begin};
}

/* Parts are short, and come after each other from afar: no cache would foresee them. */
static inline void prefetch_part(const cgt_cell_sort *s, uint32_t chunk, uint32_t bin)
{
    const bin_part part = bin_part_of(s, chunk, bin);
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
    const cgt_cell_sort *s = argument;
    const uint32_t chunks = cgt_cell_sort_chunks(s->prims), begin = chunk_row(s, chunks)[bin];
    const uint32_t first = bin << s->shift, remaining = s->cells - first, bin_cells = UINT32_C(1) << s->shift;
    const uint32_t cells = remaining < bin_cells ? remaining : bin_cells;
    uint32_t *start = s->start + first, *prim = s->prim;
    memset(start, 0, cells * sizeof *start);
    for (uint32_t chunk = 0; chunk < PREFETCH_CHUNKS && chunk < chunks; chunk++)
        prefetch_part(s, chunk, bin);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const bin_part part = bin_part_of(s, chunk, bin);
        if (chunks - chunk > PREFETCH_CHUNKS)
            prefetch_part(s, chunk + PREFETCH_CHUNKS, bin);
        for (uint32_t i = 0; i < part.count; i++)
            start[part.entry[i] >> CGT_CELL_SORT_CHUNK_BITS]++;
    }
    prefix_sum(start, cells, begin);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const bin_part part = bin_part_of(s, chunk, bin);
        const uint32_t base = chunk * CGT_CELL_SORT_CHUNK;
        for (uint32_t i = 0; i < part.count; i++)
            prim[start[part.entry[i] >> CGT_CELL_SORT_CHUNK_BITS]++] = base + (part.entry[i] & NUMBER_MASK);
    }
    restore_starts(start, cells, begin);
}

/* ---- the whole ---- */

/* By whole keys. A cell more takes what is skipped. */
static void sort_direct(const cgt_cell_sort *s)
{
    const uint32_t *key = s->key;
    uint32_t *start = s->start;
    memset(start, 0, ((size_t)s->cells + 1) * sizeof *start);
    for (uint32_t i = 0; i < s->prims; i++)
        start[key[i]]++;
    prefix_sum(start, (size_t)s->cells + 1, 0);
    for (uint32_t i = 0; i < s->prims; i++)
        s->prim[start[key[i]]++] = i;
    restore_starts(start, s->cells + 1, 0);
}

void cgt_cell_sort_run(cgt_cell_sort *sort, const cgt_context *context)
{
    if (sort->direct) {
        sort_direct(sort);
        return;
    }
    compute_bin_starts(sort);
    cgt_run_tasks(context, sort_bin, sort, sort->bins);
    sort->start[sort->cells] = sort->valid;
}
