/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The two forms take turns, sample by sample, so that a slow moment of the machine affects both. A sample takes about
 * ten microseconds over arrays in the first cache. The first quartile of a form's samples counts: disturbances on a
 * shared machine only add time. */
#include "simd/simd_measure.h"

#include <string.h>

#include "common/bench_timing.h"

#define SAMPLE_NS 10000.0
#define MOST_PASSES ((size_t)1 << 20)
#define WARM_UP_MS 200.0

const simd_row *simd_find(const simd_table *table, const simd_row *row)
{
    for (size_t i = 0; table && i < table->count; i++) {
        const simd_row *found = &table->row[i];
        if (found->count == row->count && strcmp(found->word, row->word) == 0 &&
            memcmp(found->operand, row->operand, sizeof row->operand) == 0)
            return found;
    }
    return NULL;
}

bool simd_agrees(simd_memory *memory, const simd_pair *pair)
{
    const simd_row *const mapped = pair->mapped, *const native = pair->native;
    unsigned char result[SIMD_BYTES];
    const size_t size = simd_kind_bytes(mapped->result, pair->lanes) * (size_t)simd_row_vectors(mapped, pair->lanes);
    if (!native || !native->is_same || !pair->are_alike)
        return true;
    simd_fill(memory, mapped, pair->lanes);
    mapped->run(memory, 1);
    memcpy(result, memory->result, sizeof result);
    memset(memory->result, 0, sizeof memory->result);
    native->run(memory, 1);
    return memcmp(result, memory->result, size) == 0;
}

static double sample(simd_memory *memory, const simd_row *row, size_t passes)
{
    const double start = bench_now_ms();
    row->run(memory, passes);
    return (bench_now_ms() - start) * 1e6;
}

/* One long sample may be a disturbance: the shortest of three decides. */
static size_t enough_passes(simd_memory *memory, const simd_row *row)
{
    size_t passes = 1;
    for (; passes < MOST_PASSES; passes *= 2) {
        double shortest = sample(memory, row, passes);
        for (int i = 0; i < 2 && shortest >= SAMPLE_NS; i++) {
            const double again = sample(memory, row, passes);
            shortest = again < shortest ? again : shortest;
        }
        if (shortest >= SAMPLE_NS)
            break;
    }
    return passes;
}

void simd_warm_up(simd_memory *memory, const simd_row *row, int lanes)
{
    const double start = bench_now_ms();
    simd_fill(memory, row, lanes);
    while (bench_now_ms() - start < WARM_UP_MS)
        row->run(memory, 100);
}

simd_times simd_measure(simd_memory *memory, const simd_pair *pair, uint32_t repeat, double *samples[2])
{
    const simd_row *const form[2] = {pair->mapped, pair->native};
    const double words = simd_row_vectors(pair->mapped, pair->lanes) * (double)SIMD_APPLIED;
    const size_t most = SIMD_MOST_SAMPLES(repeat);
    size_t passes[2] = {0, 0}, count = 0;
    simd_times times = {0, 0};

    simd_fill(memory, pair->mapped, pair->lanes);
    for (int f = 0; f < 2; f++)
        if (form[f])
            passes[f] = enough_passes(memory, form[f]);
    do {
        for (size_t end = count + repeat; count < end; count++)
            for (size_t turn = 0; turn < 2; turn++) {
                const size_t f = (turn + count) & 1;
                if (form[f])
                    samples[f][count] = sample(memory, form[f], passes[f]) / ((double)passes[f] * words);
            }
        times.mapped_ns = bench_spread_of(samples[0], count).low;
        times.native_ns = form[1] ? bench_spread_of(samples[1], count).low : 0;
        /* rows that seem slow are measured longer */
    } while (form[1] && count < most && times.mapped_ns > SIMD_TOLERANCE * times.native_ns);
    return times;
}
