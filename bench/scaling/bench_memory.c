/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Counts calls on their way to the C library. The hooks are called by the thread that calls the library, so there is no
 * lock. */
#define _POSIX_C_SOURCE 200809L

#include "scaling/bench_memory.h"

#include <stdlib.h>
#include <string.h>

static void *allocate(void *user, size_t bytes, size_t alignment)
{
    bench_memory *memory = user;
    void *block = NULL;
    if (posix_memalign(&block, alignment < sizeof block ? sizeof block : alignment, bytes))
        return NULL;
    memory->allocations++;
    memory->held += bytes;
    if (memory->held > memory->most)
        memory->most = memory->held;
    return block;
}

static void release(void *user, void *block, size_t bytes)
{
    bench_memory *memory = user;
    memory->held -= bytes;
    free(block);
}

void bench_memory_hooks(bench_memory *memory, cgt_memory_hooks *hooks)
{
    memset(memory, 0, sizeof *memory);
    *hooks = (cgt_memory_hooks){.user = memory, .allocate = allocate, .release = release};
}
