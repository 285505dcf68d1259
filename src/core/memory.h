/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All memory of the library is allocated here, so that the caller's hooks see every byte. */
#ifndef CGT_MEMORY_H
#define CGT_MEMORY_H

#include <cgt/cgt.h>

#define CGT_ALIGNMENT 64 /* a cache line, and the widest vector */

/* Memory that grows and is never shrunk, so that a steady state allocates nothing. */
typedef struct cgt_buffer {
    void *data;   /* NULL where capacity is 0 */
    size_t bytes; /* capacity */
} cgt_buffer;

/* The C library's functions as hooks. */
cgt_memory_hooks cgt_memory_default(void);

/* Returns bytes (at least 1) of memory aligned to CGT_ALIGNMENT, or NULL. */
void *cgt_allocate(const cgt_memory_hooks *hooks, size_t bytes);
void cgt_free(const cgt_memory_hooks *hooks, void *memory, size_t bytes);

/* Makes room for count elements of a size, growing by half at least; what the buffer held is lost (reserve) or kept
 * (grow). CGT_ERROR_TOO_LARGE where the product overflows, CGT_ERROR_OUT_OF_MEMORY: then the buffer is unchanged. */
cgt_result cgt_buffer_reserve(const cgt_memory_hooks *hooks, cgt_buffer *buffer, size_t count, size_t size);
/* As reserve, for data with scattered reads: requests huge pages, so that reads rarely wait for page tables. */
cgt_result cgt_buffer_reserve_scattered(const cgt_memory_hooks *hooks, cgt_buffer *buffer, size_t count, size_t size);
cgt_result cgt_buffer_grow(const cgt_memory_hooks *hooks, cgt_buffer *buffer, size_t count, size_t size);
void cgt_buffer_release(const cgt_memory_hooks *hooks, cgt_buffer *buffer);

#endif
