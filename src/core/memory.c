/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory through the caller's hooks, and buffers that keep their capacity. */
#define _DEFAULT_SOURCE /* madvise */
#include "core/memory.h"

#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <malloc.h>
#else
#include <sys/mman.h>
#endif

#define HUGE_PAGE ((size_t)1 << 21)

static void *default_allocate(void *user, size_t bytes, size_t alignment)
{
    (void)user;
#ifdef _WIN32
    return _aligned_malloc(bytes, alignment);
#else
    void *memory = NULL;
    return posix_memalign(&memory, alignment < sizeof(void *) ? sizeof(void *) : alignment, bytes) == 0 ? memory : NULL;
#endif
}

static void default_release(void *user, void *memory, size_t bytes)
{
    (void)user;
    (void)bytes;
#ifdef _WIN32
    _aligned_free(memory);
#else
    free(memory);
#endif
}

cgt_memory_hooks cgt_memory_default(void)
{
    return (cgt_memory_hooks){.user = NULL, .allocate = default_allocate, .release = default_release};
}

void *cgt_allocate(const cgt_memory_hooks *hooks, size_t bytes)
{
    return hooks->allocate(hooks->user, bytes ? bytes : 1, CGT_ALIGNMENT);
}

void cgt_free(const cgt_memory_hooks *hooks, void *memory, size_t bytes)
{
    if (memory)
        hooks->release(hooks->user, memory, bytes ? bytes : 1);
}

static cgt_result resize(const cgt_memory_hooks *hooks, cgt_buffer *buffer, size_t bytes, size_t copied)
{
    void *memory = cgt_allocate(hooks, bytes);
    if (!memory)
        return CGT_ERROR_OUT_OF_MEMORY;
    if (copied)
        memcpy(memory, buffer->data, copied);
    cgt_free(hooks, buffer->data, buffer->bytes);
    *buffer = (cgt_buffer){memory, bytes};
    return CGT_OK;
}

/* Returns half more than the buffer has, or the size requested if that is more. */
static size_t grown_capacity(const cgt_buffer *buffer, size_t bytes)
{
    const size_t increment = buffer->bytes / 2;
    return buffer->bytes <= SIZE_MAX - increment && buffer->bytes + increment > bytes ? buffer->bytes + increment
                                                                                      : bytes;
}

cgt_result cgt_buffer_reserve(const cgt_memory_hooks *hooks, cgt_buffer *buffer, size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size)
        return CGT_ERROR_TOO_LARGE;
    return count * size <= buffer->bytes ? CGT_OK : resize(hooks, buffer, grown_capacity(buffer, count * size), 0);
}

cgt_result cgt_buffer_reserve_scattered(const cgt_memory_hooks *hooks, cgt_buffer *buffer, size_t count, size_t size)
{
    const void *old_data = buffer->data;
    const cgt_result result = cgt_buffer_reserve(hooks, buffer, count, size);
#ifdef MADV_HUGEPAGE
    if (buffer->data != old_data) {
        char *data = buffer->data;
        const size_t skipped = (HUGE_PAGE - (uintptr_t)data % HUGE_PAGE) % HUGE_PAGE;
        if (buffer->bytes >= skipped + HUGE_PAGE) /* advice: a refusal loses nothing */
            (void)madvise(data + skipped, (buffer->bytes - skipped) / HUGE_PAGE * HUGE_PAGE, MADV_HUGEPAGE);
    }
#else
    (void)old_data;
#endif
    return result;
}

cgt_result cgt_buffer_grow(const cgt_memory_hooks *hooks, cgt_buffer *buffer, size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size)
        return CGT_ERROR_TOO_LARGE;
    if (count * size <= buffer->bytes)
        return CGT_OK;
    return resize(hooks, buffer, grown_capacity(buffer, count * size), buffer->bytes);
}

void cgt_buffer_release(const cgt_memory_hooks *hooks, cgt_buffer *buffer)
{
    cgt_free(hooks, buffer->data, buffer->bytes);
    *buffer = (cgt_buffer){NULL, 0};
}
