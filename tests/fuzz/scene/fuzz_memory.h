/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A memory hook that fails on demand and checks every release. */
#ifndef FUZZ_MEMORY_H
#define FUZZ_MEMORY_H

#include <pthread.h>
#include <stdbool.h>

#include "support/research_options.h"

typedef struct fuzz_memory {
    size_t blocks, bytes; /* allocated and not yet released */
    uint32_t fail_after;  /* the call that returns NULL, counted from 1; 0: none. Only that call fails. */
    bool failed;          /* set when a call has failed */
    pthread_t caller;     /* the only thread that may call */
} fuzz_memory;

cgt_memory_hooks fuzz_memory_hooks(fuzz_memory *memory);

#endif
