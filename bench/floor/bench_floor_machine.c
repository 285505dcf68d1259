/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory bandwidth: all threads read or write an array that is larger than any cache, each its own part. Streaming
 * stores bypass the caches; they are measured where the compiler has them. */
#include <stdlib.h>
#include <string.h>

#include "floor/bench_floor.h"
#include "common/bench_timing.h"
#include "native/native_stream.h"

enum { ROUNDS = 7 };

typedef struct memory_job {
    uint64_t *words;
    size_t count; /* a multiple of 8 */
    uint32_t parts;
    uint64_t seed;
    uint64_t *sums; /* of each part; keeps the compiler from removing the reads */
} memory_job;

/* Words of a part, from *first up to the end that is returned. */
static size_t part_of(const memory_job *job, uint32_t index, size_t *first)
{
    *first = job->count / 8 * index / job->parts * 8;
    return job->count / 8 * (index + 1) / job->parts * 8;
}

static void read_part(void *argument, uint32_t index)
{
    const memory_job *job = argument;
    const uint64_t *words = job->words;
    uint64_t sum[8] = {0};
    size_t i, end = part_of(job, index, &i);
    for (; i < end; i += 8)
        for (int k = 0; k < 8; k++)
            sum[k] += words[i + k];
    for (int k = 1; k < 8; k++)
        sum[0] += sum[k];
    job->sums[index] = sum[0];
}

static void write_part(void *argument, uint32_t index)
{
    const memory_job *job = argument;
    size_t i, end = part_of(job, index, &i);
    for (; i < end; i++)
        job->words[i] = job->seed + i;
}

#if NATIVE_HAS_STREAM
static void stream_part(void *argument, uint32_t index)
{
    const memory_job *job = argument;
    size_t i, end = part_of(job, index, &i);
    for (; i < end; i += 2)
        native_stream_pair(job->words + i, job->seed + i);
    native_stream_end();
}
#endif

/* Bytes per nanosecond, the best of several rounds. */
static double measure(floor_job *job, memory_job *memory, bench_task *task)
{
    double best = 0.0;
    for (int round = 0; round < ROUNDS; round++) {
        memory->seed += 0x9e3779b97f4a7c15u;
        const double begin = bench_now_ms();
        bench_threads_run(job->threads, task, memory, memory->parts);
        const double ns = 1e6 * (bench_now_ms() - begin);
        const double rate = ns > 0.0 ? (double)memory->count * sizeof(uint64_t) / ns : 0.0;
        best = rate > best ? rate : best;
    }
    return best;
}

int floor_measure_memory(floor_job *job)
{
    const uint32_t threads = cgt_context_get_threads(job->context);
    memory_job memory = {.count = (size_t)job->settings->megabytes * 1048576 / sizeof(uint64_t), .parts = threads};
    memory.words = aligned_alloc(64, memory.count * sizeof *memory.words);
    memory.sums = calloc(threads, sizeof *memory.sums);
    const int complete = memory.words && memory.sums;
    if (complete) {
        memset(memory.words, 1, memory.count * sizeof *memory.words); /* pages are touched here */
        job->read = measure(job, &memory, read_part);
        job->write = measure(job, &memory, write_part);
        floor_row(job, "memory", "-", "read", threads, job->read, "GB/s");
        floor_row(job, "memory", "-", "write", threads, job->write, "GB/s");
#if NATIVE_HAS_STREAM
        job->stream = measure(job, &memory, stream_part);
        floor_row(job, "memory", "-", "write,streaming", threads, job->stream, "GB/s");
#endif
    } else {
        program_error("out of memory for %u MB", (unsigned)job->settings->megabytes);
    }
    free(memory.words);
    free(memory.sums);
    return complete ? PROGRAM_OK : PROGRAM_FAILED;
}
