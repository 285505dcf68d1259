/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue of commands: which may begin, how long each takes, what happens when it ends; and the tag groups.
 *
 * A command takes the SPE's bus for its bytes, one after the other, and ends `latency` later. What moves, moves at the
 * end: a program that uses a buffer before it has waited finds the old bytes, natively as well. */
#include <string.h>

#include "cell/mfc/mfc_internal.h"
#include "spu_mfcio.h"

/* ---- order ---- */

/* Whether the command at `later` waits for the one at `earlier`, which is still in the queue.
 *   barrier command    all before it come before all after it
 *   fence              a command waits for all before it that have its tag
 *   barrier            and so do all after it that have the tag: for those before the barrier, not for itself
 *   eieio, sync        order all before and after that have the tag */
static bool waits_for(const cgt_mfc *mfc, unsigned later, unsigned earlier)
{
    const cgt_mfc_command *const a = &mfc->queue[earlier], *const b = &mfc->queue[later];
    const cgt_mfc_kind kind_a = a->operation->kind, kind_b = b->operation->kind;
    if (kind_a == CGT_MFC_BARRIER || kind_b == CGT_MFC_BARRIER)
        return true;
    if (a->tag != b->tag)
        return false;
    if (b->operation->fence || b->operation->barrier || kind_a == CGT_MFC_ORDER || kind_b == CGT_MFC_ORDER)
        return true;
    /* a barrier between them that has ended has waited for the earlier one, which would be gone */
    for (unsigned i = earlier + 1; i < later; i++)
        if (mfc->queue[i].operation->barrier && mfc->queue[i].tag == b->tag)
            return true;
    return false;
}

static bool may_begin(const cgt_mfc *mfc, unsigned at)
{
    for (unsigned i = 0; i < at; i++)
        if (waits_for(mfc, at, i))
            return false;
    return true;
}

/* ---- time ---- */

/* A pseudo-random number of cycles up to the jitter: a mixer of 64 bits (Steele et al., SplitMix64). */
uint64_t cgt_mfc_delay(const cgt_mfc *mfc, uint64_t number)
{
    if (mfc->timing.jitter == 0)
        return 0;
    uint64_t x = number + ((uint64_t)mfc->timing.jitter_seed << 32) + ((uint64_t)mfc->spe << 20);
    x = (x + UINT64_C(0x9e3779b97f4a7c15)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 30)) * UINT64_C(0x94d049bb133111eb);
    return (x ^ (x >> 31)) % ((uint64_t)mfc->timing.jitter + 1);
}

static uint64_t larger(uint64_t a, uint64_t b) { return a > b ? a : b; }
static uint64_t divide_up(uint64_t a, uint64_t b) { return (a + b - 1) / b; }

/* Takes the bus, and the memory's port, for so many bytes. Returns the cycle in which they have passed. */
static uint64_t take_bus(cgt_mfc *mfc, uint64_t bytes)
{
    const uint32_t memory_rate = mfc->timing.memory_bytes_per_cycle;
    uint64_t start = larger(mfc->now, mfc->bus_free);
    if (memory_rate > 0)
        start = larger(start, mfc->map->port_free);
    mfc->bus_free = start + divide_up(bytes, mfc->timing.bytes_per_cycle);
    if (memory_rate > 0)
        mfc->map->port_free = start + divide_up(bytes, memory_rate);
    return mfc->bus_free;
}

static void begin(cgt_mfc *mfc, cgt_mfc_command *c)
{
    const cgt_mfc_kind kind = c->operation->kind;
    uint64_t bytes = larger(c->size, mfc->timing.least_bytes), end = mfc->now;
    if (c->operation->list && !cgt_mfc_begin_list(mfc, c, &bytes))
        return;
    c->state = CGT_MFC_RUNS;
    c->started = mfc->now;
    if (kind == CGT_MFC_SIGNAL)
        end = mfc->now + mfc->timing.signal_latency;
    else if (kind != CGT_MFC_ORDER && kind != CGT_MFC_BARRIER && kind != CGT_MFC_CACHE)
        end = take_bus(mfc, bytes) + mfc->timing.latency;
    c->finished = end + cgt_mfc_delay(mfc, c->number + c->done);
}

void cgt_mfc_start_commands(cgt_mfc *mfc)
{
    for (unsigned i = 0; i < mfc->queued && mfc->rule == CGT_RULE_NONE; i++)
        if (mfc->queue[i].state == CGT_MFC_WAITS && may_begin(mfc, i))
            begin(mfc, &mfc->queue[i]);
}

static void count(cgt_mfc_counts *counts, const cgt_mfc_operation *operation)
{
    switch (operation->kind) {
    case CGT_MFC_GET: counts->gets++; break;
    case CGT_MFC_PUT:
    case CGT_MFC_ZERO:
    case CGT_MFC_LINE: counts->puts++; break;
    case CGT_MFC_SIGNAL: counts->signals++; break;
    case CGT_MFC_ATOMIC: counts->atomics++; break;
    case CGT_MFC_CACHE:
    case CGT_MFC_ORDER:
    case CGT_MFC_BARRIER: counts->orders++; break;
    }
    counts->lists += operation->list;
}

void cgt_mfc_enqueue(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    cgt_mfc_command *const place = &mfc->queue[mfc->queued++];
    *place = *c;
    place->state = CGT_MFC_WAITS;
    place->issued = mfc->now;
    place->list_lsa = c->lsa;
    place->number = mfc->commands++;
    count(&mfc->counts, c->operation);
    cgt_mfc_start_commands(mfc);
}

/* ---- the end of a command ---- */

static void remove_command(cgt_mfc *mfc, unsigned at)
{
    if (mfc->queued == CGT_MFC_QUEUE)
        cgt_mfc_raise(mfc, MFC_COMMAND_QUEUE_AVAILABLE_EVENT);
    mfc->queued--;
    memmove(&mfc->queue[at], &mfc->queue[at + 1], (mfc->queued - at) * sizeof mfc->queue[0]);
}

static void send_signal(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    const cgt_ea_region *const region = cgt_ea_map_find(mfc->map, c->ea);
    cgt_mfc_set_signal(region->owner, region->number, cgt_mfc_load32(mfc, c->lsa));
}

/* Does what the command is there for. Returns whether it is a list that stalls. */
static bool carry_out(cgt_mfc *mfc, cgt_mfc_command *c, cgt_mfc_record *record)
{
    if (c->operation->list)
        return cgt_mfc_end_list(mfc, c, record);
    record->bytes = c->size;
    switch (c->operation->kind) {
    case CGT_MFC_GET:
    case CGT_MFC_PUT: cgt_mfc_move(mfc, c->operation->kind == CGT_MFC_PUT, c->lsa, c->ea, c->size); break;
    case CGT_MFC_LINE: cgt_mfc_move(mfc, true, c->lsa, c->ea, CGT_LINE_BYTES); break;
    case CGT_MFC_ZERO: cgt_mfc_zero(mfc, c->ea, c->size); break;
    case CGT_MFC_SIGNAL: send_signal(mfc, c); break;
    case CGT_MFC_CACHE:
    case CGT_MFC_ORDER:
    case CGT_MFC_BARRIER:
    case CGT_MFC_ATOMIC: break;
    }
    return false;
}

static void end_command(cgt_mfc *mfc, unsigned at)
{
    cgt_mfc_command *const c = &mfc->queue[at];
    cgt_mfc_record record = {.issued = c->issued,
                             .started = c->started,
                             .finished = c->finished,
                             .spe = mfc->spe,
                             .command = c->operation->name,
                             .tag = c->tag,
                             .lsa = c->lsa,
                             .ea = c->ea};
    const bool stalls = carry_out(mfc, c, &record);
    if (mfc->rule != CGT_RULE_NONE)
        return;
    cgt_mfc_trace_add(mfc, &record);
    if (stalls) {
        c->state = CGT_MFC_STALLS;
        mfc->stalled_tags |= UINT32_C(1) << c->tag;
        cgt_mfc_raise(mfc, MFC_LIST_STALL_NOTIFY_EVENT);
    } else if (c->operation->list && c->done < c->size) {
        c->state = CGT_MFC_WAITS; /* the program took the notify bit away meanwhile: the list goes on */
    } else {
        remove_command(mfc, at);
    }
    mfc->changes++;
    cgt_mfc_start_commands(mfc);
    cgt_mfc_update_tags(mfc);
}

/* ---- tag groups ---- */

uint32_t cgt_mfc_busy_tags(const cgt_mfc *mfc)
{
    uint32_t tags = 0;
    for (unsigned i = 0; i < mfc->queued; i++)
        tags |= UINT32_C(1) << mfc->queue[i].tag;
    return tags;
}

/* Gives the status that MFC_WrTagUpdate asked for, once its condition holds. An empty mask has nothing to wait for. */
void cgt_mfc_update_tags(cgt_mfc *mfc)
{
    if (mfc->tag_update != CGT_TAG_UPDATE_WAITS)
        return;
    const uint32_t idle = mfc->tag_mask & ~cgt_mfc_busy_tags(mfc);
    const bool holds = mfc->tag_condition == MFC_TAG_UPDATE_IMMEDIATE || idle == mfc->tag_mask ||
                       (mfc->tag_condition == MFC_TAG_UPDATE_ANY && idle != 0);
    if (!holds)
        return;
    mfc->tag_status = idle;
    cgt_mfc_watch_tags(mfc, idle);
    mfc->tag_update = CGT_TAG_UPDATE_READY;
    mfc->changes++;
    cgt_mfc_raise(mfc, MFC_TAG_STATUS_UPDATE_EVENT);
}

/* ---- events by themselves ---- */

/* index of the command that ends first, the earlier one of two; queued for none */
static unsigned first_to_end(const cgt_mfc *mfc)
{
    unsigned first = mfc->queued;
    for (unsigned i = 0; i < mfc->queued; i++)
        if (mfc->queue[i].state == CGT_MFC_RUNS &&
            (first == mfc->queued || mfc->queue[i].finished < mfc->queue[first].finished))
            first = i;
    return first;
}

uint64_t cgt_mfc_next_event(const cgt_mfc *mfc)
{
    if (mfc->rule != CGT_RULE_NONE)
        return CGT_NO_CYCLE;
    const unsigned first = first_to_end(mfc);
    uint64_t cycle = mfc->decrementer_event;
    if (first < mfc->queued && mfc->queue[first].finished < cycle)
        cycle = mfc->queue[first].finished;
    if (mfc->atomic_runs && mfc->atomic.finished < cycle)
        cycle = mfc->atomic.finished;
    return cycle;
}

void cgt_mfc_advance(cgt_mfc *mfc, uint64_t cycle)
{
    for (uint64_t next = cgt_mfc_next_event(mfc); next != CGT_NO_CYCLE && next <= cycle;
         next = cgt_mfc_next_event(mfc)) {
        const unsigned first = first_to_end(mfc);
        mfc->now = larger(mfc->now, next);
        if (first < mfc->queued && mfc->queue[first].finished == next) {
            end_command(mfc, first);
        } else if (mfc->atomic_runs && mfc->atomic.finished == next) {
            cgt_mfc_end_atomic(mfc);
        } else {
            mfc->decrementer_event = CGT_NO_CYCLE;
            mfc->changes++;
            cgt_mfc_raise(mfc, MFC_DECREMENTER_EVENT);
        }
    }
    mfc->now = larger(mfc->now, cycle);
}

bool cgt_mfc_is_busy(const cgt_mfc *mfc) { return mfc->queued > 0 || mfc->atomic_runs; }
