/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Objects sorted by their cells: linear, in order, and the same for any number of threads, since which chunk goes where
 * is settled before anything moves. */
#include "loose_grid_build.h"

#include <string.h>

static inline uint32_t chunks_of(const cgt_loose_sort *s)
{
    return (uint32_t)(((uint64_t)s->objects + CGT_LOOSE_CHUNK - 1) / CGT_LOOSE_CHUNK);
}

void cgt_loose_sort_plan(cgt_loose_sort *sort)
{
    sort->shift = 0;
    while (CGT_LOOSE_BIN_CELLS >> sort->shift > 1 || (sort->cells - 1) >> sort->shift >= CGT_LOOSE_BINS)
        sort->shift++;
    sort->bins = ((sort->cells - 1) >> sort->shift) + 1;
}

void cgt_loose_sort_count(const cgt_loose_sort *s, uint32_t chunk)
{
    const uint32_t first = chunk * CGT_LOOSE_CHUNK, left = s->objects - first;
    const uint32_t *key = s->key + first, count = left < CGT_LOOSE_CHUNK ? left : CGT_LOOSE_CHUNK;
    uint32_t *place = s->place + (size_t)chunk * (s->bins + 1);
    if (s->direct)
        return;
    memset(place, 0, (s->bins + 1) * sizeof *place);
    for (uint32_t i = 0; i < count; i++)
        place[key[i] >> s->shift]++;
}

/* From counts to places: bin by bin, in each the chunks in order. */
static void place_chunks(const cgt_loose_sort *s)
{
    const uint32_t chunks = chunks_of(s);
    uint32_t sum = 0;
    for (uint32_t bin = 0; bin <= s->bins; bin++)
        for (uint32_t chunk = 0; chunk < chunks; chunk++) {
            uint32_t *place = &s->place[(size_t)chunk * (s->bins + 1) + bin];
            const uint32_t count = *place;
            *place = sum;
            sum += count;
        }
}

/* Moves the objects of a chunk to their bins. */
static void move_chunk(void *argument, uint32_t chunk)
{
    const cgt_loose_sort *s = argument;
    const uint32_t first = chunk * CGT_LOOSE_CHUNK, left = s->objects - first;
    const uint32_t end = left < CGT_LOOSE_CHUNK ? s->objects : first + CGT_LOOSE_CHUNK;
    uint32_t *place = s->place + (size_t)chunk * (s->bins + 1);
    for (uint32_t i = first; i < end; i++) {
        const uint32_t key = s->key[i];
        s->pair[place[key >> s->shift]++] = (cgt_loose_pair){key, i};
    }
}

/* Turns counts of cells to their starts. */
static void start_cells(uint32_t *start, uint32_t cells, uint32_t first)
{
    for (uint32_t c = 0; c < cells; c++) {
        const uint32_t count = start[c];
        start[c] = first;
        first += count;
    }
}

/* Each start was moved to its cell's end, which is the next one's start. */
static void restore_starts(uint32_t *start, uint32_t cells, uint32_t first)
{
    memmove(start + 1, start, (cells - 1) * sizeof *start);
    start[0] = first;
}

/* Sorts a bin by cell. Where its chunks' places began, the bin begins; where the last one's ended, it ends. */
static void sort_bin(void *argument, uint32_t bin)
{
    const cgt_loose_sort *s = argument;
    const uint32_t *ends = s->place + (size_t)(chunks_of(s) - 1) * (s->bins + 1);
    const uint32_t begin = bin ? ends[bin - 1] : 0, end = ends[bin], first = bin << s->shift, left = s->cells - first;
    const uint32_t cells = left < UINT32_C(1) << s->shift ? left : UINT32_C(1) << s->shift;
    uint32_t *start = s->start;
    memset(start + first, 0, cells * sizeof *start);
    for (uint32_t i = begin; i < end; i++)
        start[s->pair[i].key]++;
    start_cells(start + first, cells, begin);
    for (uint32_t i = begin; i < end; i++)
        s->object[start[s->pair[i].key]++] = s->pair[i].object;
    restore_starts(start + first, cells, begin);
}

/* The same for all at once, straight from the keys. A cell more takes what is skipped. */
static void sort_all(const cgt_loose_sort *s)
{
    const uint32_t *key = s->key;
    uint32_t *start = s->start;
    memset(start, 0, ((size_t)s->cells + 1) * sizeof *start);
    for (uint32_t i = 0; i < s->objects; i++)
        start[key[i]]++;
    start_cells(start, s->cells + 1, 0);
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
    place_chunks(sort);
    cgt_run_tasks(context, move_chunk, sort, chunks_of(sort));
    cgt_run_tasks(context, sort_bin, sort, sort->bins);
    sort->start[sort->cells] = sort->valid;
}
