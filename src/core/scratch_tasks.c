/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tasks in lanes: a call starts as many lanes as it has blocks of scratch memory, and each lane runs one task after the
 * other in its block. How many threads a caller's runner has is not known: its lanes double as long as all of them were
 * seen at work at once. */
#include "core/scratch_tasks.h"

#include "core/float_environment.h"

#define MAX_LANES 1024u

/* ---- blocks ---- */

/* Takes up to `count` of the blocks that the context keeps, those first that were used last: their pages are warm. */
static uint32_t take_kept(cgt_context *c, uint32_t count, cgt_scratch **list)
{
    uint32_t taken = 0;
    cgt_scratch **end = list;
    pthread_mutex_lock(&c->scratch_lock);
    *list = c->scratch;
    while (*end && taken < count) {
        end = &(*end)->next;
        taken++;
    }
    c->scratch = *end;
    *end = NULL;
    pthread_mutex_unlock(&c->scratch_lock);
    return taken;
}

cgt_scratch *cgt_scratch_borrow(cgt_context *c, uint32_t count)
{
    cgt_scratch *list, **end = &list;
    for (uint32_t taken = take_kept(c, count, &list); taken < count; taken++) {
        void *memory = cgt_allocate(&c->memory, CGT_SCRATCH_BYTES);
        if (!memory)
            break;
        while (*end)
            end = &(*end)->next;
        *end = cgt_scratch_init(memory);
    }
    if (!list)
        cgt_fail(c, CGT_ERROR_OUT_OF_MEMORY, "out of memory for the scratch of a task: %zu bytes", CGT_SCRATCH_BYTES);
    return list;
}

void cgt_scratch_give_back(cgt_context *c, cgt_scratch *list)
{
    cgt_scratch *last = list;
    if (!list)
        return;
    while (last->next)
        last = last->next;
    pthread_mutex_lock(&c->scratch_lock);
    last->next = c->scratch;
    c->scratch = list;
    pthread_mutex_unlock(&c->scratch_lock);
}

cgt_buffer cgt_buffer_borrow(cgt_context *c)
{
    pthread_mutex_lock(&c->scratch_lock);
    const cgt_buffer buffer = c->spare;
    c->spare = (cgt_buffer){0};
    pthread_mutex_unlock(&c->scratch_lock);
    return buffer;
}

void cgt_buffer_give_back(cgt_context *c, cgt_buffer buffer)
{
    pthread_mutex_lock(&c->scratch_lock);
    if (buffer.bytes > c->spare.bytes) {
        const cgt_buffer smaller = c->spare;
        c->spare = buffer;
        buffer = smaller;
    }
    pthread_mutex_unlock(&c->scratch_lock);
    cgt_buffer_release(&c->memory, &buffer);
}

/* ---- lanes ---- */

typedef struct lane_batch {
    cgt_scratch_task *task;
    void *argument;
    cgt_scratch *blocks; /* one for each lane */
    uint32_t count;
    atomic_uint next;          /* the first index not taken; may run past count by one for each lane */
    atomic_uint working, most; /* lanes that are at work, and the most that were */
} lane_batch;

static bool take_index(lane_batch *b, uint32_t *index)
{
    if (atomic_load_explicit(&b->next, memory_order_relaxed) >= b->count)
        return false;
    *index = atomic_fetch_add_explicit(&b->next, 1, memory_order_relaxed);
    return *index < b->count;
}

static void raise_most(lane_batch *b, unsigned working)
{
    unsigned most = atomic_load_explicit(&b->most, memory_order_relaxed);
    while (most < working &&
           !atomic_compare_exchange_weak_explicit(&b->most, &most, working, memory_order_relaxed, memory_order_relaxed))
        continue;
}

static void run_lane(void *argument, uint32_t lane)
{
    lane_batch *b = argument;
    cgt_scratch *scratch = b->blocks;
    cgt_float_environment runners;
    uint32_t index;
    if (!take_index(b, &index))
        return;
    raise_most(b, atomic_fetch_add_explicit(&b->working, 1, memory_order_relaxed) + 1);
    for (uint32_t k = 0; k < lane; k++)
        scratch = scratch->next;
    cgt_float_environment_enter(&runners);
    do {
        b->task(b->argument, index, scratch);
    } while (take_index(b, &index));
    cgt_float_environment_leave(&runners);
    atomic_fetch_sub_explicit(&b->working, 1, memory_order_relaxed);
}

static uint32_t choose_lanes(const cgt_context *c, uint32_t count)
{
    const uint32_t lanes = !c->tasks.run ? 1
                           : c->threads  ? c->threads
                                         : atomic_load_explicit(&c->runner_lanes, memory_order_relaxed);
    return count < lanes ? count : lanes;
}

/* A caller's runner that has kept all lanes busy gets twice as many from the next call on. */
static void learn_lanes(cgt_context *c, uint32_t lanes, uint32_t most)
{
    unsigned known = atomic_load_explicit(&c->runner_lanes, memory_order_relaxed);
    if (!c->threads && most == lanes && known == lanes && lanes < MAX_LANES)
        atomic_compare_exchange_strong(&c->runner_lanes, &known, 2 * lanes);
}

cgt_result cgt_run_scratch_tasks(cgt_context *c, cgt_scratch_task *task, void *argument, uint32_t count)
{
    lane_batch batch = {.task = task, .argument = argument, .count = count};
    uint32_t lanes = 0;
    if (!count)
        return CGT_OK;
    batch.blocks = cgt_scratch_borrow(c, choose_lanes(c, count));
    for (const cgt_scratch *s = batch.blocks; s; s = s->next)
        lanes++;
    if (!lanes)
        return CGT_ERROR_OUT_OF_MEMORY;
    atomic_init(&batch.next, 0);
    atomic_init(&batch.working, 0);
    atomic_init(&batch.most, 0);
    if (lanes > 1)
        c->tasks.run(c->tasks.user, run_lane, &batch, lanes);
    else
        run_lane(&batch, 0);
    learn_lanes(c, lanes, atomic_load_explicit(&batch.most, memory_order_relaxed));
    cgt_scratch_give_back(c, batch.blocks);
    return CGT_OK;
}
