/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The last step of any sort of primitives into cells, in isolation: keys and the cells' offsets are known, each
 * primitive's number is stored. Either directly into the cells, or first into slabs of cells that fit in a cache; the
 * faster one counts. The order of keys is the scene's own: neighbours of a mesh are close in memory, those of a cloud
 * are not. For meshes, vertices stand for triangles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "floor/bench_floor.h"
#include "common/bench_timing.h"

enum { ROUNDS = 5, OBJECTS_A_CELL = 8, SLABS = 256 };

typedef struct scatter_job {
    uint32_t count, cells, parts;
    uint32_t slab_cells; /* of a slab; the last one may have fewer */
    uint32_t *key;       /* cell of each primitive */
    uint32_t *start;     /* of each part, of each cell: where its next primitive goes */
    uint32_t *first;     /* of each cell, and one past the last: its first primitive */
    uint32_t *slab;      /* of each part, of each slab: where its next pair goes */
    uint64_t *pair;      /* key and number, slab by slab */
    uint32_t *primitive;
} scatter_job;

static uint32_t first_of(const scatter_job *job, uint32_t part)
{
    return (uint32_t)((uint64_t)job->count * part / job->parts);
}

static void scatter_part(void *argument, uint32_t part)
{
    const scatter_job *job = argument;
    uint32_t *start = job->start + (size_t)part * job->cells;
    const uint32_t end = first_of(job, part + 1);
    for (uint32_t i = first_of(job, part); i < end; i++)
        job->primitive[start[job->key[i]]++] = i;
}

static void pair_part(void *argument, uint32_t part)
{
    const scatter_job *job = argument;
    uint32_t *slab = job->slab + (size_t)part * SLABS;
    const uint32_t end = first_of(job, part + 1);
    for (uint32_t i = first_of(job, part); i < end; i++)
        job->pair[slab[job->key[i] / job->slab_cells]++] = (uint64_t)job->key[i] << 32 | i;
}

/* Uses the offsets of the first part for all: one thread has the cells of a slab for itself. */
static void scatter_slab(void *argument, uint32_t slab)
{
    const scatter_job *job = argument;
    const uint64_t low = (uint64_t)slab * job->slab_cells, high = low + job->slab_cells;
    const uint32_t end = job->first[high < job->cells ? high : job->cells];
    for (uint32_t i = job->first[low < job->cells ? low : job->cells]; i < end; i++)
        job->primitive[job->start[job->pair[i] >> 32]++] = (uint32_t)job->pair[i];
}

/* Counts, then prefix sums: cells in order, within each the parts in order; the same for slabs. */
static void find_starts(const scatter_job *job)
{
    uint32_t at = 0;
    memset(job->start, 0, (size_t)job->parts * job->cells * sizeof *job->start);
    for (uint32_t part = 0; part < job->parts; part++)
        for (uint32_t i = first_of(job, part); i < first_of(job, part + 1); i++)
            job->start[(size_t)part * job->cells + job->key[i]]++;
    for (uint32_t cell = 0; cell < job->cells; cell++) {
        job->first[cell] = at;
        for (uint32_t part = 0; part < job->parts; part++) {
            uint32_t *start = &job->start[(size_t)part * job->cells + cell];
            const uint32_t primitives = *start;
            *start = at;
            at += primitives;
        }
    }
    job->first[job->cells] = at;
}

static void find_slabs(const scatter_job *job)
{
    uint32_t at = 0;
    memset(job->slab, 0, (size_t)job->parts * SLABS * sizeof *job->slab);
    for (uint32_t part = 0; part < job->parts; part++)
        for (uint32_t i = first_of(job, part); i < first_of(job, part + 1); i++)
            job->slab[(size_t)part * SLABS + job->key[i] / job->slab_cells]++;
    for (uint32_t slab = 0; slab < SLABS; slab++)
        for (uint32_t part = 0; part < job->parts; part++) {
            uint32_t *start = &job->slab[(size_t)part * SLABS + slab];
            const uint32_t primitives = *start;
            *start = at;
            at += primitives;
        }
}

/* At most `cells` cubes over the bounds. Values that are not finite go to the first or the last. */
static void find_keys(scatter_job *job, const float *position, uint32_t width)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    uint32_t size[3];
    double volume = 1.0;
    for (uint32_t i = 0; i < job->count; i++)
        for (int a = 0; a < 3; a++) {
            const double x = (double)position[(size_t)i * width + a];
            low[a] = isfinite(x) && x < low[a] ? x : low[a];
            high[a] = isfinite(x) && x > high[a] ? x : high[a];
        }
    for (int a = 0; a < 3; a++)
        volume *= high[a] > low[a] ? high[a] - low[a] : 1e-6;
    const double edge = cbrt(volume / job->cells);
    uint32_t cells = 1;
    for (int a = 0; a < 3; a++) {
        const double wanted = (high[a] - low[a]) / edge;
        const uint32_t room = job->cells / cells;
        size[a] = wanted >= 1.0 ? wanted < room ? (uint32_t)wanted : room : 1;
        cells *= size[a];
    }
    for (uint32_t i = 0; i < job->count; i++) {
        uint32_t key = 0;
        for (int a = 2; a >= 0; a--) {
            const double x = ((double)position[(size_t)i * width + a] - low[a]) / (high[a] - low[a]) * size[a];
            const uint32_t cell = x >= 1.0 ? x < size[a] ? (uint32_t)x : size[a] - 1 : 0;
            key = key * size[a] + cell;
        }
        job->key[i] = key;
    }
}

/* The shortest time of both ways, in ms. */
static double time_rounds(const floor_job *job, scatter_job *scatter)
{
    double best = INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        find_starts(scatter);
        double begin = bench_now_ms();
        bench_threads_run(job->threads, scatter_part, scatter, scatter->parts);
        best = fmin(best, bench_now_ms() - begin);
        find_starts(scatter);
        find_slabs(scatter);
        begin = bench_now_ms();
        bench_threads_run(job->threads, pair_part, scatter, scatter->parts);
        bench_threads_run(job->threads, scatter_slab, scatter, SLABS);
        best = fmin(best, bench_now_ms() - begin);
    }
    return best;
}

double floor_measure_scatter(const floor_job *job, const float *position, uint32_t width, uint32_t count)
{
    scatter_job scatter = {
        .count = count, .cells = count / OBJECTS_A_CELL + 1, .parts = cgt_context_get_threads(job->context)};
    double ns = -1.0;
    if (count == 0)
        return 0.0;
    scatter.slab_cells = (scatter.cells - 1) / SLABS + 1;
    scatter.key = calloc(count, sizeof *scatter.key);
    scatter.primitive = calloc(count, sizeof *scatter.primitive);
    scatter.pair = calloc(count, sizeof *scatter.pair);
    scatter.start = calloc((size_t)scatter.parts * scatter.cells, sizeof *scatter.start);
    scatter.first = calloc((size_t)scatter.cells + 1, sizeof *scatter.first);
    scatter.slab = calloc((size_t)scatter.parts * SLABS, sizeof *scatter.slab);
    if (scatter.key && scatter.primitive && scatter.pair && scatter.start && scatter.first && scatter.slab) {
        find_keys(&scatter, position, width);
        ns = 1e6 * time_rounds(job, &scatter) / count;
    }
    free(scatter.key);
    free(scatter.primitive);
    free(scatter.pair);
    free(scatter.start);
    free(scatter.first);
    free(scatter.slab);
    return ns;
}
