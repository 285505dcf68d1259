/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * SPE programs compiled for the host, each on its own thread; the PPE on the calling one. One lock guards MFCs, main
 * memory and events: it is held for each access of a channel, the DMA that ends meanwhile included, and not while
 * programs compute. A program that waits for its own DMA moves its clock on; one that waits for others sleeps.
 *
 * It is a deadlock when all programs sleep or have ended, nothing has changed since, and the PPE has nothing to do. */
#define _POSIX_C_SOURCE 200809L
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cell/machine/native_internal.h"
#include "core/memory.h"
#include "spu_channels.h"

static bool sleeps(const cgt_spe *spe)
{
    return spe->state == CGT_SPE_ENDED ||
           (spe->state == CGT_SPE_WAITS && cgt_mfc_get_changes(spe->mfc) == spe->changes);
}

/* under the lock */
static bool all_sleep(const cgt_cell *cell)
{
    for (unsigned i = 0; i < cell->options.spes; i++)
        if (!sleeps(&cell->spe[i]))
            return false;
    return cell->events == 0;
}

static bool all_ended(const cgt_cell *cell)
{
    for (unsigned i = 0; i < cell->options.spes; i++)
        if (cell->spe[i].state != CGT_SPE_ENDED)
            return false;
    return true;
}

/* ---- the end of a program ---- */

__attribute__((noreturn)) static void leave(cgt_native *native) { longjmp(native->end, 1); }

void cgt_native_stop(cgt_native *native, uint32_t code)
{
    native->code = code;
    native->stopped = true;
    leave(native);
}

static void fail(cgt_native *native)
{
    cgt_cell_fail_mfc(native->cell, native->spe);
    pthread_cond_broadcast(&native->cell->changed);
}

void cgt_native_fail(cgt_native *native, cgt_mfc_rule rule, const char *format, ...)
{
    char message[CGT_MFC_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    pthread_mutex_lock(&native->cell->lock);
    cgt_mfc_fail(native->cell->spe[native->spe].mfc, rule, "%s", message);
    fail(native);
    pthread_mutex_unlock(&native->cell->lock);
    leave(native);
}

/* ---- channels ---- */

/* After an access, and before a wait: others may have waited for what was done. */
static void wake_others(cgt_cell *cell, bool posted)
{
    for (unsigned i = 0; i < cell->options.spes && !posted; i++)
        posted = cell->spe[i].state == CGT_SPE_WAITS && !sleeps(&cell->spe[i]);
    if (posted)
        pthread_cond_broadcast(&cell->changed);
}

/* Sleeps until another program, or the PPE, has changed something. Under the lock. */
static void wait_for_others(cgt_native *native, unsigned channel)
{
    cgt_cell *const cell = native->cell;
    cgt_spe *const spe = &cell->spe[native->spe];
    spe->state = CGT_SPE_WAITS;
    spe->channel = channel;
    spe->changes = cgt_mfc_get_changes(spe->mfc);
    if (cell->ppe_waits && all_sleep(cell)) {
        cgt_cell_fail_deadlock(cell);
        pthread_cond_broadcast(&cell->changed);
    }
    wake_others(cell, false);
    while (!cell->failed && cgt_mfc_get_changes(spe->mfc) == spe->changes)
        pthread_cond_wait(&cell->changed, &cell->lock);
    spe->state = CGT_SPE_RUNS;
}

/* A stall: by the program's own commands, or for others. The decrementer moves on for those alone who wait for events:
 * what others take has no length here. */
static void stall(cgt_native *native, unsigned channel)
{
    cgt_spe *const spe = &native->cell->spe[native->spe];
    cgt_mfc *const mfc = spe->mfc;
    const uint64_t next = cgt_mfc_next_event(mfc);
    if (next == CGT_NO_CYCLE || (channel != SPU_RdEventStat && !cgt_mfc_is_busy(mfc))) {
        wait_for_others(native, channel);
    } else if (next > native->clock) {
        cgt_cell_add_wait(spe, channel, next - native->clock);
        native->clock = next;
    }
}

static cgt_channel_status try_access(cgt_native *native, unsigned channel, bool writes, uint32_t *value)
{
    const cgt_spu_channels *const c = &native->channels;
    return writes ? c->write(c->user, channel, native->clock, *value) : c->read(c->user, channel, native->clock, value);
}

void cgt_native_access(cgt_native *native, unsigned channel, bool writes, uint32_t *value)
{
    cgt_cell *const cell = native->cell;
    cgt_ppe_event event = {.spe = native->spe};
    cgt_channel_status status = CGT_CHANNEL_STALL;
    pthread_mutex_lock(&cell->lock);
    native->clock++;
    while (!cell->failed && status == CGT_CHANNEL_STALL) {
        status = try_access(native, channel, writes, value);
        if (status == CGT_CHANNEL_STALL)
            stall(native, channel);
    }
    if (status == CGT_CHANNEL_ERROR)
        fail(native);
    const bool posts = status == CGT_CHANNEL_DONE && writes && cgt_cell_event_of_channel(channel, &event.kind);
    if (posts)
        cgt_cell_post(cell, event);
    wake_others(cell, posts);
    pthread_mutex_unlock(&cell->lock);
    if (status != CGT_CHANNEL_DONE)
        leave(native);
}

uint32_t cgt_native_count(cgt_native *native, unsigned channel)
{
    cgt_cell *const cell = native->cell;
    pthread_mutex_lock(&cell->lock);
    const uint32_t count = native->channels.count(native->channels.user, channel, ++native->clock);
    const bool failed = cell->failed || cgt_mfc_get_error(cell->spe[native->spe].mfc, NULL) != CGT_RULE_NONE;
    if (failed)
        fail(native);
    wake_others(cell, false);
    pthread_mutex_unlock(&cell->lock);
    if (failed)
        leave(native);
    return count;
}

/* ---- threads ---- */

/* Its commands end, as they do on a Cell. Under the lock. */
static void end_commands(cgt_native *native)
{
    cgt_mfc *const mfc = native->cell->spe[native->spe].mfc;
    while (cgt_mfc_is_busy(mfc) && cgt_mfc_next_event(mfc) != CGT_NO_CYCLE)
        cgt_mfc_advance(mfc, cgt_mfc_next_event(mfc));
    if (cgt_mfc_get_error(mfc, NULL) != CGT_RULE_NONE)
        fail(native);
}

static void end_program(cgt_native *native)
{
    cgt_cell *const cell = native->cell;
    cgt_spe *const spe = &cell->spe[native->spe];
    pthread_mutex_lock(&cell->lock);
    spe->state = CGT_SPE_ENDED;
    spe->result.stopped = native->stopped;
    spe->result.code = native->code;
    spe->result.cycle = native->clock;
    if (native->stopped) {
        end_commands(native);
        cgt_cell_post(cell, (cgt_ppe_event){.kind = CGT_PPE_STOPPED, .spe = native->spe, .value = native->code});
    }
    pthread_cond_broadcast(&cell->changed);
    pthread_mutex_unlock(&cell->lock);
}

static void *run_program(void *argument)
{
    cgt_native *const native = argument;
    const cgt_spe_program *const program = native->program;
    (void)cgt_spu_set_host(&native->host);
    if (setjmp(native->end) == 0) {
        const int value = program->function(native->spe, program->argument, program->environment);
        native->code = 0x2000u | ((unsigned)value & 0xff); /* as newlib's exit stops */
        native->stopped = true;
    }
    (void)cgt_spu_set_host(NULL);
    end_program(native);
    return NULL;
}

/* Serves the PPE's events until all programs have ended or one has failed. */
static void run_ppe(cgt_cell *cell)
{
    pthread_mutex_lock(&cell->lock);
    while (!cell->failed && !(cell->events == 0 && all_ended(cell))) {
        if (cell->events > 0) {
            const cgt_ppe_event event = cgt_cell_take_event(cell);
            pthread_mutex_unlock(&cell->lock);
            cgt_cell_serve(cell, event);
            pthread_mutex_lock(&cell->lock);
            continue;
        }
        if (all_sleep(cell)) {
            cgt_cell_fail_deadlock(cell);
            pthread_cond_broadcast(&cell->changed);
            break;
        }
        cell->ppe_waits = true;
        pthread_cond_wait(&cell->changed, &cell->lock);
        cell->ppe_waits = false;
    }
    pthread_mutex_unlock(&cell->lock);
}

/* Starts the threads, runs the PPE, waits for all. */
static cgt_result run_threads(cgt_cell *cell, cgt_native *native)
{
    unsigned started = 0;
    while (started < cell->options.spes &&
           !pthread_create(&native[started].thread, NULL, run_program, &native[started]))
        started++;
    if (started < cell->options.spes) {
        pthread_mutex_lock(&cell->lock);
        cgt_cell_fail(cell, "SPE %u: the system refused a thread", started);
        pthread_cond_broadcast(&cell->changed);
        pthread_mutex_unlock(&cell->lock);
    } else {
        run_ppe(cell);
    }
    for (unsigned i = 0; i < started; i++)
        pthread_join(native[i].thread, NULL);
    if (started < cell->options.spes)
        return CGT_ERROR_THREADS;
    return cell->failed ? CGT_ERROR_STOPPED : CGT_OK;
}

/* ---- a run ---- */

static cgt_result prepare(cgt_cell *cell, cgt_native *native, uint8_t *arenas, const cgt_spe_program *program,
                          cgt_ppe_function *ppe, void *user)
{
    cgt_local_store store[CGT_MAX_SPES];
    for (unsigned i = 0; i < cell->options.spes; i++)
        store[i] = (cgt_local_store){.bytes = arenas + (size_t)i * CGT_LOCAL_STORE_BYTES,
                                     .size = CGT_LOCAL_STORE_BYTES,
                                     .order = CGT_STORE_HOST};
    cell->timing.memory_bytes_per_cycle = 0; /* a shared port has no meaning where there is no common time */
    const cgt_result result = cgt_cell_prepare(cell, store, ppe, user);
    for (unsigned i = 0; i < cell->options.spes && result == CGT_OK; i++) {
        native[i] = (cgt_native){.arena = store[i].bytes,
                                 .cell = cell,
                                 .spe = i,
                                 .program = &program[i],
                                 .channels = cgt_mfc_get_channels(cell->spe[i].mfc)};
        native[i].host = cgt_native_host(&native[i]);
    }
    return result;
}

static bool init_lock(cgt_cell *cell)
{
    if (pthread_mutex_init(&cell->lock, NULL))
        return false;
    if (!pthread_cond_init(&cell->changed, NULL))
        return true;
    pthread_mutex_destroy(&cell->lock);
    return false;
}

/* with memory and lock */
static cgt_result run(cgt_cell *cell, cgt_native *native, uint8_t *arenas, const cgt_spe_program *program,
                      cgt_ppe_function *ppe, void *user)
{
    const cgt_mfc_timing timing = cell->timing;
    cell->ppe_waits = false;
    cell->native = true;
    cgt_result result = prepare(cell, native, arenas, program, ppe, user);
    if (result == CGT_OK)
        result = run_threads(cell, native);
    cell->native = false;
    cell->timing = timing;
    return result;
}

cgt_result cgt_cell_run_native(cgt_cell *cell, const cgt_spe_program *program, cgt_ppe_function *ppe, void *user)
{
    const size_t spes = cell->options.spes;
    cgt_native *const native = calloc(spes, sizeof *native);
    /* a line's alignment, so that an address and its offset have the same low bits */
    const cgt_memory_hooks memory = cgt_memory_default();
    const size_t bytes = spes * CGT_LOCAL_STORE_BYTES;
    uint8_t *const arenas = memory.allocate(memory.user, bytes, CGT_LINE_BYTES);
    cgt_result result = native && arenas ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
    cgt_cell_reset(cell, ppe, user);
    if (result != CGT_OK) {
        cgt_cell_fail(cell, "out of memory for %zu native SPEs", spes);
    } else {
        memset(arenas, 0, bytes); /* as a simulated one begins */
        result = init_lock(cell) ? CGT_OK : CGT_ERROR_THREADS;
        if (result != CGT_OK)
            cgt_cell_fail(cell, "the system refused a lock for native SPEs");
    }
    if (result == CGT_OK) {
        result = run(cell, native, arenas, program, ppe, user);
        pthread_cond_destroy(&cell->changed);
        pthread_mutex_destroy(&cell->lock);
    }
    cgt_free(&memory, arenas, bytes);
    free(native);
    return result;
}
