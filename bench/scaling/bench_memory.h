/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory hooks that count the library's allocations. */
#ifndef BENCH_MEMORY_H
#define BENCH_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/cgt.h>

typedef struct bench_memory {
    uint64_t allocations; /* so far */
    size_t held, most;    /* bytes: current, and the peak */
} bench_memory;

/* memory starts at zero and outlives the context that gets the hooks. */
void bench_memory_hooks(bench_memory *memory, cgt_memory_hooks *hooks);

#endif
