/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sort: linear, in order, and the same for any number of threads. */
#include "builders/order/cell_sort.h"

#include <string.h>

#define CHUNK_BITS 14u
#define CHUNK (UINT32_C(1) << CHUNK_BITS) /* primitives */
#define DIRECT 65536u                     /* primitives that are sorted by whole keys */
#define DIRECT_CELLS 262144u              /* at most: a megabyte of counters */
#define MAX_BINS 512u                     /* unless the lower digit would not fit into an entry */
#define MIN_BIN_CELLS 512u
#define DIGIT_BITS (32 - CHUNK_BITS)
#define NUMBER_MASK (CHUNK - 1) /* of an entry */
#define SUBCHUNKS 4u            /* of a chunk */
#define PREFETCH_CHUNKS 4u      /* chunks whose parts of a bin are on their way */

static inline uint32_t count_chunks(uint32_t count) { return (uint32_t)(((uint64_t)count + CHUNK - 1) / CHUNK); }

/* ---- plan and memory ---- */

void cgt_cell_sort_plan(cgt_cell_sort *sort, const cgt_scene *scene, const cgt_cluster *cluster, const void *plan,
                        uint32_t cells)
{
    const cgt_primitives *prims = &scene->committed_scene.prims;
    const uint32_t direct_limit = scene->context->tasks.run ? DIRECT : CGT_CELL_SORT_DIRECT_SERIAL;
    unsigned shift = 0;
    while (shift < DIGIT_BITS && (MIN_BIN_CELLS >> shift > 1 || (cells - 1) >> shift >= MAX_BINS))
        shift++;
    sort->prims = prims;
    sort->cluster = cluster;
    sort->count = cluster ? cgt_clusters(prims->count) : prims->count;
    sort->valid = cgt_size_classes_count(scene->buffer[CGT_BUFFER_SIZE_CLASSES].data);
    sort->cells = cells;
    sort->direct = sort->count <= CHUNK || (sort->count <= direct_limit && cells <= DIRECT_CELLS);
    sort->shift = shift;
    sort->bins = ((cells - 1) >> shift) + 1;
    sort->keys = (cgt_cell_keys){.plan = plan,
                                 .middle = scene->buffer[CGT_BUFFER_CELL_SORT_WORK].data,
                                 .boxed = cgt_primitives_boxed(prims),
                                 .skipped = sort->direct ? cells : sort->bins << shift};
}

static inline size_t row_words(const cgt_cell_sort *s) { return (size_t)s->bins + 1; }

static inline uint32_t *chunk_row(const cgt_cell_sort *s, uint32_t chunk)
{
    return s->bin_end + (size_t)chunk * SUBCHUNKS * row_words(s);
}

cgt_result cgt_cell_sort_reserve_work(cgt_scene *scene, bool clusters)
{
    const cgt_primitives *prims = &scene->committed_scene.prims;
    const uint64_t words =
        clusters ? cgt_clusters(prims->count) : 4 * (uint64_t)cgt_primitives_boxed(prims) + prims->count;
    if (words > SIZE_MAX / sizeof(uint32_t))
        return CGT_ERROR_TOO_LARGE;
    return cgt_buffer_reserve_scattered(&scene->context->memory, &scene->buffer[CGT_BUFFER_CELL_SORT_WORK],
                                        (size_t)words, sizeof(uint32_t));
}

cgt_result cgt_cell_sort_reserve(cgt_cell_sort *sort, cgt_scene *scene, cgt_scene_buffer start, uint64_t cells,
                                 cgt_scene_buffer prim)
{
    const cgt_memory_hooks *hooks = &scene->context->memory;
    cgt_buffer *buffer = scene->buffer, *bins = &buffer[CGT_BUFFER_CELL_SORT_BINS];
    const size_t rows = (size_t)count_chunks(sort->count) * SUBCHUNKS + 1;
    const size_t words = sort->bins < MAX_BINS ? MAX_BINS + 1 : row_words(sort);
    cgt_result result = cgt_buffer_reserve_scattered(hooks, &buffer[start], (size_t)cells + 1, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_buffer_reserve_scattered(hooks, &buffer[prim], sort->count, sizeof(uint32_t));
    if (result == CGT_OK && !sort->direct)
        result = cgt_buffer_reserve(hooks, bins, rows, words * sizeof *sort->bin_end);
    if (result != CGT_OK)
        return result;
    sort->entry = (uint32_t *)buffer[CGT_BUFFER_CELL_SORT_WORK].data +
                  (sort->cluster ? 0 : (size_t)4 * cgt_primitives_boxed(sort->prims));
    sort->bin_end = bins->data;
    sort->start = buffer[start].data;
    sort->prim = buffer[prim].data;
    sort->key = sort->direct ? sort->entry : sort->prim;
    return CGT_OK;
}

/* ---- keys ---- */

/* Finds the keys of primitives that may lie in several arrays. */
static void find_prim_keys(const cgt_cell_sort *s, uint32_t first, uint32_t end)
{
    const cgt_primitive_array *a = cgt_primitives_array(s->prims, first);
    for (uint32_t prim = first; prim < end; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        s->prim_keys(&s->keys, a, prim, stop, s->key + prim);
        prim = stop;
    }
}

static void find_chunk_keys(const cgt_cell_sort *s, uint32_t first, uint32_t count)
{
    if (s->cluster)
        s->cluster_keys(&s->keys, s->cluster + first, count, s->key + first);
    else
        find_prim_keys(s, first, first + count);
}

/* ---- chunks ---- */

/* Replaces counts by starts. As entries are placed, each start moves to its end, which is the next one's start. Returns
 * the largest count. */
static uint32_t prefix_sum(uint32_t *count, size_t counts, uint32_t first)
{
    uint32_t most = 0;
    for (size_t k = 0; k < counts; k++) {
        const uint32_t entries = count[k];
        most = entries > most ? entries : most;
        count[k] = first;
        first += entries;
    }
    return most;
}

static inline void scatter(uint32_t *bin_end, uint32_t key, unsigned shift, uint32_t number, uint32_t *entry)
{
    const uint32_t digit = key & ((UINT32_C(1) << shift) - 1);
    entry[bin_end[key >> shift]++] = digit << CHUNK_BITS | number;
}

/* Sorts a chunk's keys by bin, in four subchunks side by side with a row of places each: where neighbours share a bin,
 * a single place would serialise them. */
static void sort_chunk(const cgt_cell_sort *s, uint32_t first, uint32_t count, uint32_t *row)
{
    const uint32_t share = count / SUBCHUNKS;
    const unsigned shift = s->shift;
    const size_t words = row_words(s);
    const uint32_t *key = s->key + first;
    uint32_t *entry = s->entry + first, sum = 0;
    const uint32_t *k0 = key, *k1 = k0 + share, *k2 = k1 + share, *k3 = k2 + share;
    uint32_t *p0 = row, *p1 = p0 + words, *p2 = p1 + words, *p3 = p2 + words;
    /* count the keys of each bin */
    memset(row, 0, SUBCHUNKS * words * sizeof *row);
    for (uint32_t i = 0; i < share; i++) {
        p0[k0[i] >> shift]++;
        p1[k1[i] >> shift]++;
        p2[k2[i] >> shift]++;
        p3[k3[i] >> shift]++;
    }
    for (uint32_t i = SUBCHUNKS * share; i < count; i++)
        p3[key[i] >> shift]++;
    /* bins begin one after the other, in each the subchunks */
    for (size_t bin = 0; bin < words; bin++)
        for (size_t k = 0; k < SUBCHUNKS; k++) {
            const uint32_t entries = row[k * words + bin];
            row[k * words + bin] = sum;
            sum += entries;
        }
    /* place the entries */
    for (uint32_t i = 0; i < share; i++) {
        scatter(p0, k0[i], shift, i, entry);
        scatter(p1, k1[i], shift, share + i, entry);
        scatter(p2, k2[i], shift, 2 * share + i, entry);
        scatter(p3, k3[i], shift, 3 * share + i, entry);
    }
    for (uint32_t i = SUBCHUNKS * share; i < count; i++)
        scatter(p3, key[i], shift, i, entry);
}

static void sort_chunk_task(void *argument, uint32_t chunk)
{
    const cgt_cell_sort *s = argument;
    const uint32_t first = chunk * CHUNK, remaining = s->count - first, count = remaining < CHUNK ? remaining : CHUNK;
    find_chunk_keys(s, first, count);
    if (!s->direct) /* else there is no room for places */
        sort_chunk(s, first, count, chunk_row(s, chunk));
}

/* ---- bins ---- */

/* Adds up where bins begin, from where their parts of the chunks end. */
static void compute_bin_starts(const cgt_cell_sort *s)
{
    const uint32_t chunks = count_chunks(s->count);
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
    return (bin_part){s->entry + (size_t)chunk * CHUNK + begin, end[bin] - begin};
}

/* Parts are short and lie far apart: no hardware prefetcher predicts them. */
static inline void prefetch_part(const cgt_cell_sort *s, uint32_t chunk, uint32_t bin)
{
    const bin_part part = bin_part_of(s, chunk, bin);
    for (uint32_t i = 0; i < part.count; i += 64 / sizeof *part.entry)
        __builtin_prefetch(part.entry + i);
    __builtin_prefetch(part.entry + part.count);
}

/* Each start has moved to its cell's end, which is the next one's start: moves them back. */
static void restore_starts(uint32_t *start, uint32_t cells, uint32_t first)
{
    memmove(start + 1, start, (cells - 1) * sizeof *start);
    start[0] = first;
}

/* Gathers a bin, and sorts it by cell. */
static void sort_bin(void *argument, uint32_t bin)
{
    cgt_cell_sort *s = argument;
    const uint32_t chunks = count_chunks(s->count), begin = chunk_row(s, chunks)[bin];
    const uint32_t first = bin << s->shift, remaining = s->cells - first, bin_cells = UINT32_C(1) << s->shift;
    const uint32_t cells = remaining < bin_cells ? remaining : bin_cells;
    uint32_t *start = s->start + first, *prim = s->prim;
    /* count the entries of each cell */
    memset(start, 0, cells * sizeof *start);
    for (uint32_t chunk = 0; chunk < PREFETCH_CHUNKS && chunk < chunks; chunk++)
        prefetch_part(s, chunk, bin);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const bin_part part = bin_part_of(s, chunk, bin);
        if (chunks - chunk > PREFETCH_CHUNKS)
            prefetch_part(s, chunk + PREFETCH_CHUNKS, bin);
        for (uint32_t i = 0; i < part.count; i++)
            start[part.entry[i] >> CHUNK_BITS]++;
    }
    /* place them */
    if (prefix_sum(start, cells, begin) > CGT_CELL_SORT_CROWD)
        atomic_store_explicit(&s->is_crowded, true, memory_order_relaxed);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const bin_part part = bin_part_of(s, chunk, bin);
        const uint32_t base = chunk * CHUNK;
        for (uint32_t i = 0; i < part.count; i++)
            prim[start[part.entry[i] >> CHUNK_BITS]++] = base + (part.entry[i] & NUMBER_MASK);
    }
    restore_starts(start, cells, begin);
}

/* ---- the whole ---- */

/* Sorts by whole keys. One cell more takes the skipped ones. */
static void sort_direct(cgt_cell_sort *s)
{
    const uint32_t *key = s->key;
    uint32_t *start = s->start;
    memset(start, 0, ((size_t)s->cells + 1) * sizeof *start);
    for (uint32_t i = 0; i < s->count; i++)
        start[key[i]]++;
    const uint32_t skipped = start[s->cells];
    start[s->cells] = 0;
    if (prefix_sum(start, s->cells, 0) > CGT_CELL_SORT_CROWD)
        atomic_store_explicit(&s->is_crowded, true, memory_order_relaxed);
    start[s->cells] = s->count - skipped;
    for (uint32_t i = 0; i < s->count; i++)
        s->prim[start[key[i]]++] = i;
    restore_starts(start, s->cells + 1, 0);
}

void cgt_cell_sort_run(cgt_cell_sort *sort, const cgt_context *context)
{
    atomic_init(&sort->is_crowded, false);
    cgt_run_tasks(context, sort_chunk_task, sort, count_chunks(sort->count));
    if (sort->direct) {
        sort_direct(sort);
        return;
    }
    compute_bin_starts(sort);
    cgt_run_tasks(context, sort_bin, sort, sort->bins);
    sort->start[sort->cells] = sort->valid;
}
