/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A Cell's pictures, native and simulated, without memory, locks or threads: whichever request the system refuses, the
 * picture fails with that error and a sentence, nothing is lost, and the next one succeeds. */
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "cell/ppe/grid/grid_picture.h"
#include "support/suite.h"
#include "cell/programs/grid/spe_grid.h"
#include "support/test.h"

/* ---- the system ---- */

/* Requests until one is refused; negative: none is. Those of the machine come here by the linker, all others by
 * hooks. */
static int refuse_after = -1;
static unsigned requests, memory_requests;
static size_t held; /* bytes by the hooks */

static bool refuses(void)
{
    requests++;
    return refuse_after >= 0 && refuse_after-- == 0;
}

void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size) { return refuses() ? NULL : __real_calloc(count, size); }

void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return refuses() ? NULL : __real_aligned_alloc(alignment, size);
}

int __real_pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attributes);
int __wrap_pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attributes);
int __wrap_pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attributes)
{
    return refuses() ? EAGAIN : __real_pthread_mutex_init(mutex, attributes);
}

int __real_pthread_cond_init(pthread_cond_t *condition, const pthread_condattr_t *attributes);
int __wrap_pthread_cond_init(pthread_cond_t *condition, const pthread_condattr_t *attributes);
int __wrap_pthread_cond_init(pthread_cond_t *condition, const pthread_condattr_t *attributes)
{
    return refuses() ? ENOMEM : __real_pthread_cond_init(condition, attributes);
}

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument)
{
    return refuses() ? EAGAIN : __real_pthread_create(thread, attributes, start, argument);
}

static void *allocate(void *user, size_t bytes, size_t alignment)
{
    (void)user;
    memory_requests++;
    void *const memory =
        refuses() ? NULL : __real_aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory) {
        memset(memory, 0x5a, bytes); /* what is not set before it is used shows */
        held += bytes;
    }
    return memory;
}

static void release(void *user, void *memory, size_t bytes)
{
    (void)user;
    held -= bytes;
    free(memory);
}

/* ---- pictures ---- */

/* lnop, stop 0x2000: a program that reports nothing. */
static const unsigned char tiny[] = {0x7f, 'E', 'L',  'F',  1, 2,    1, 0, 0, 0,    0, 0, 0,    0, 0,    0, 0, 2, 0,
                                     0x17, 0,   0,    0,    1, 0,    0, 0, 0, 0,    0, 0, 0x34, 0, 0,    0, 0, 0, 0,
                                     0,    0,   0,    0x34, 0, 0x20, 0, 1, 0, 0x28, 0, 0, 0,    0, 0,    0, 0, 1, 0,
                                     0,    0,   0x54, 0,    0, 0,    0, 0, 0, 0,    0, 0, 0,    0, 8,    0, 0, 0, 8,
                                     0,    0,   0,    5,    0, 0,    0, 4, 0, 0x20, 0, 0, 0,    0, 0x20, 0};

static cgt_cell_frame_result result;

static cgt_visit ignore(void *user, const cgt_tile *tile)
{
    (void)user, (void)tile;
    return CGT_VISIT_CONTINUE;
}

static cgt_result trace(bool simulated)
{
    static const float sphere[2][4] = {{0, 0, 0, 1}, {1, 0, 0, 1}};
    const cgt_memory_hooks hooks = {.allocate = allocate, .release = release};
    cgt_grid_picture p = {.sphere = sphere[0],
                          .count = 2,
                          .width = 9,
                          .height = 5,
                          .options = {.cell = {.spes = 3, .assignment = CGT_ASSIGN_DYNAMIC}},
                          .visitor = ignore,
                          .memory = &hooks};
    cgt_camera_init(&p.camera);
    if (simulated) {
        p.options.cell.elf = tiny;
        p.options.cell.elf_bytes = sizeof tiny;
    } else {
        p.options.cell.function = spe_grid;
    }
    return cgt_grid_picture_trace(&p, &result);
}

static void refuse_each(bool simulated, cgt_result at_last)
{
    unsigned refused = 0, threads = 0;
    requests = memory_requests = 0;
    refuse_after = -1;
    assert_int_equal(trace(simulated), at_last);
    const unsigned all = requests;
    for (unsigned k = 0; k < all; k++) {
        refuse_after = (int)k;
        const cgt_result code = trace(simulated);
        assert_true(refuse_after < 0);
        assert_int_equal(held, 0);
        refused += code == CGT_ERROR_OUT_OF_MEMORY;
        threads += code == CGT_ERROR_THREADS;
        if (code != CGT_ERROR_OUT_OF_MEMORY && code != CGT_ERROR_THREADS)
            fail_msg("request %u of %u refused: %d, \"%s\"", k, all, (int)code, result.message);
        if (!*result.message)
            fail_msg("request %u of %u refused: %d, and no sentence", k, all, (int)code);
    }
    refuse_after = -1;
    assert_int_equal(trace(simulated), at_last);
    print_message("%u requests refused, %u as memory, %u as locks and threads\n", all, refused, threads);
    assert_true(refused > 8 && (simulated || threads == 5));
}

TEST(native) { refuse_each(false, CGT_OK); }

TEST(simulated)
{
    refuse_each(true, CGT_ERROR_STOPPED);
    assert_non_null(strstr(result.message, "without a report"));
}

SEEDED_SUITE("test_cell_memory", NULL, NULL)
