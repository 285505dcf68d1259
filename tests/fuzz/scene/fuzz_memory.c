/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A memory hook that fails on demand. Each block stores its size in the 64 bytes before it, so that the sanitizer's
 * red zone begins right after the library's last byte. */
#define _POSIX_C_SOURCE 200809L
#include "fuzz/scene/fuzz_memory.h"

#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"

#define FRONT 64u
#define FILLED 4096u /* bytes filled with garbage; filling all would make large grids slow */

static void *allocate(void *user, size_t bytes, size_t alignment)
{
    fuzz_memory *const m = user;
    void *block = NULL;
    FUZZ_CHECK(pthread_equal(pthread_self(), m->caller), "allocate is called from a worker");
    FUZZ_CHECK(alignment && !(alignment & (alignment - 1)) && alignment <= FRONT, "alignment %zu", alignment);
    FUZZ_CHECK(bytes && bytes < SIZE_MAX / 2, "%zu bytes are requested", bytes);
    if (m->fail_after && --m->fail_after == 0) {
        m->failed = true;
        return NULL;
    }
    FUZZ_CHECK(!posix_memalign(&block, FRONT, FRONT + bytes), "out of memory for %zu bytes", bytes);
    memcpy(block, &bytes, sizeof bytes);
    m->blocks++;
    m->bytes += bytes;
    return memset((char *)block + FRONT, 0xa5, bytes < FILLED ? bytes : FILLED);
}

static void release(void *user, void *memory, size_t bytes)
{
    fuzz_memory *const m = user;
    size_t given;
    FUZZ_CHECK(pthread_equal(pthread_self(), m->caller), "release is called from a worker");
    FUZZ_CHECK(memory, "release gets NULL");
    memcpy(&given, (char *)memory - FRONT, sizeof given);
    FUZZ_CHECK(given == bytes, "release gets %zu bytes, allocate gave %zu", bytes, given);
    m->blocks--;
    m->bytes -= bytes;
    free((char *)memory - FRONT);
}

cgt_memory_hooks fuzz_memory_hooks(fuzz_memory *memory)
{
    memory->caller = pthread_self();
    return (cgt_memory_hooks){.user = memory, .allocate = allocate, .release = release};
}
