/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What simulated and native cells share: memory, events of the PPE, messages. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cell/machine/machine_internal.h"
#include "spu_channels.h"

/* ---- create and destroy ---- */

cgt_result cgt_cell_create(const cgt_cell_options *options, cgt_cell **cell)
{
    *cell = NULL;
    if (options->spes < 1 || options->spes > CGT_MAX_SPES)
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_cell *const made = calloc(1, sizeof *made);
    if (!made)
        return CGT_ERROR_OUT_OF_MEMORY;
    made->options = *options;
    made->timing = options->timing ? *options->timing : cgt_mfc_default_timing;
    if (made->options.ppe_cycles == 0)
        made->options.ppe_cycles = CGT_PPE_CYCLES;
    cgt_ea_map_init(&made->memory);
    cgt_ea_map_init(&made->map);
    *cell = made;
    return CGT_OK;
}

static void free_mfcs(cgt_cell *cell)
{
    for (unsigned i = 0; i < cell->options.spes; i++) {
        cgt_mfc_free(cell->spe[i].mfc);
        cell->spe[i].mfc = NULL;
    }
}

void cgt_cell_destroy(cgt_cell *cell)
{
    if (!cell)
        return;
    free_mfcs(cell);
    free(cell);
}

cgt_result cgt_cell_add_memory(cgt_cell *cell, uint64_t ea, void *memory, uint64_t count, uint32_t unit, bool writable)
{
    /* the places of the SPEs, none of which is in this map */
    if (ea < CGT_SPE_EA(CGT_MAX_SPES) && (count > CGT_SPE_EA(0) || ea + count * unit > CGT_SPE_EA(0)))
        return CGT_ERROR_INVALID_ARGUMENT;
    return cgt_ea_map_add_memory(&cell->memory, ea, memory, count, unit, writable);
}

cgt_result cgt_cell_set_signal_or(cgt_cell *cell, unsigned spe, unsigned number, bool gathers)
{
    if (spe >= cell->options.spes || number < 1 || number > 2)
        return CGT_ERROR_INVALID_ARGUMENT;
    cell->spe[spe].gathers[number - 1] = gathers;
    return CGT_OK;
}

const char *cgt_cell_get_message(const cgt_cell *cell) { return cell->message; }

cgt_spe_result cgt_cell_get_result(const cgt_cell *cell, unsigned spe)
{
    cgt_spe_result result = {0};
    if (spe >= cell->options.spes)
        return result;
    result = cell->spe[spe].result;
    if (!cell->spe[spe].mfc)
        return result; /* of real SPEs nothing more is known */
    result.rule = cgt_mfc_get_error(cell->spe[spe].mfc, NULL);
    result.counts = *cgt_mfc_get_counts(cell->spe[spe].mfc);
    return result;
}

/* ---- a run ---- */

static cgt_result add_spe(cgt_cell *cell, unsigned number, const cgt_local_store *store)
{
    cgt_spe *const spe = &cell->spe[number];
    cgt_result result = cgt_mfc_create(&cell->map, number, store, &cell->timing, cell->options.trace, &spe->mfc);
    if (result != CGT_OK)
        return result;
    if (cell->options.watch_buffers)
        cgt_mfc_watch_buffers(spe->mfc);
    result = cgt_ea_map_add(&cell->map, &(cgt_ea_region){.ea = CGT_SPE_EA(number),
                                                         .bytes = store->size,
                                                         .kind = CGT_EA_LOCAL_STORE,
                                                         .writable = true,
                                                         .memory = store->bytes,
                                                         .owner = spe->mfc});
    for (unsigned k = 1; k <= 2 && result == CGT_OK; k++) {
        cgt_mfc_set_signal_or(spe->mfc, k, spe->gathers[k - 1]);
        result = cgt_ea_map_add(
            &cell->map,
            &(cgt_ea_region){
                .ea = CGT_SPE_SIGNAL_EA(number, k), .bytes = 4, .kind = CGT_EA_SIGNAL, .owner = spe->mfc, .number = k});
    }
    return result;
}

void cgt_cell_reset(cgt_cell *cell, cgt_ppe_function *ppe, void *user)
{
    free_mfcs(cell);
    cell->map = cell->memory;
    cell->ppe = ppe;
    cell->user = user;
    cell->events = 0;
    cell->ppe_free = 0;
    cell->failed = false;
    cell->message[0] = '\0';
    for (unsigned i = 0; i < cell->options.spes; i++)
        memset(&cell->spe[i].result, 0, sizeof cell->spe[i].result);
}

cgt_result cgt_cell_prepare(cgt_cell *cell, const cgt_local_store *store, cgt_ppe_function *ppe, void *user)
{
    cgt_cell_reset(cell, ppe, user);
    for (unsigned i = 0; i < cell->options.spes; i++) {
        cgt_spe *const spe = &cell->spe[i];
        spe->state = CGT_SPE_RUNS;
        spe->cycle = 0;
        spe->late = false;
        const cgt_result result = add_spe(cell, i, &store[i]);
        if (result != CGT_OK) {
            cgt_cell_fail(cell, "SPE %u: no MFC: no memory, too many regions, or a local store or timing out of range",
                          i);
            return result;
        }
    }
    cgt_cell_post(cell, (cgt_ppe_event){.kind = CGT_PPE_START});
    return CGT_OK;
}

void cgt_cell_add_wait(cgt_spe *spe, unsigned channel, uint64_t cycles)
{
    cgt_spe_waits *const w = &spe->result.waits;
    uint64_t *what = &w->event;
    switch (channel) {
    case MFC_RdTagStat:
    case MFC_RdAtomicStat:
    case MFC_RdListStallStat: what = &w->dma; break;
    case MFC_Cmd: what = &w->queue; break;
    case SPU_RdInMbox:
    case SPU_WrOutMbox:
    case SPU_WrOutIntrMbox: what = &w->mailbox; break;
    case SPU_RdSigNotify1:
    case SPU_RdSigNotify2: what = &w->signal; break;
    default: break;
    }
    *what += cycles;
    cgt_mfc_add_wait(spe->mfc, cycles);
}

/* ---- failures ---- */

void cgt_cell_fail(cgt_cell *cell, const char *format, ...)
{
    if (cell->failed)
        return;
    cell->failed = true;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cell->message, sizeof cell->message, format, arguments);
    va_end(arguments);
}

void cgt_cell_fail_mfc(cgt_cell *cell, unsigned spe)
{
    const char *message;
    cgt_mfc_get_error(cell->spe[spe].mfc, &message);
    cgt_cell_fail(cell, "SPE %u: %s", spe, message);
}

void cgt_cell_fail_deadlock(cgt_cell *cell)
{
    char who[300] = "";
    size_t used = 0;
    for (unsigned i = 0; i < cell->options.spes && used < sizeof who; i++) {
        const char *const name = cgt_spu_channel_name(cell->spe[i].channel);
        if (cell->spe[i].state == CGT_SPE_WAITS)
            used += (size_t)snprintf(who + used, sizeof who - used, "%s SPE %u for %s", used ? "," : "", i,
                                     name ? name : "a channel");
    }
    cgt_cell_fail(cell, "%s: nothing can happen any more; waiting:%s", cgt_mfc_rule_name(CGT_RULE_DEADLOCK), who);
}

/* ---- the PPE ---- */

bool cgt_cell_event_of_channel(unsigned channel, cgt_ppe_event_kind *kind)
{
    *kind = channel == SPU_WrOutMbox ? CGT_PPE_MAILBOX : CGT_PPE_INTERRUPT;
    return channel == SPU_WrOutMbox || channel == SPU_WrOutIntrMbox;
}

/* Keeps them by rising cycle, equal ones in the order in which they came. */
void cgt_cell_post(cgt_cell *cell, cgt_ppe_event event)
{
    unsigned at = cell->events++;
    for (; at > 0 && cell->event[at - 1].cycle > event.cycle; at--)
        cell->event[at] = cell->event[at - 1];
    cell->event[at] = event;
}

cgt_ppe_event cgt_cell_take_event(cgt_cell *cell)
{
    const cgt_ppe_event first = cell->event[0];
    cell->events--;
    memmove(&cell->event[0], &cell->event[1], cell->events * sizeof cell->event[0]);
    return first;
}

static void lock(cgt_cell *cell)
{
    if (cell->native)
        pthread_mutex_lock(&cell->lock);
}

/* after a change that an SPE may wait for */
static void unlock(cgt_cell *cell)
{
    if (!cell->native)
        return;
    pthread_cond_broadcast(&cell->changed);
    pthread_mutex_unlock(&cell->lock);
}

/* Natively the SPEs have clocks of their own: cycle 0 leaves them alone. */
static uint64_t ppe_cycle(const cgt_cell *cell) { return cell->native ? 0 : cell->ppe_free; }

void cgt_cell_serve(cgt_cell *cell, cgt_ppe_event event)
{
    cgt_mfc *const mfc = cell->spe[event.spe].mfc;
    lock(cell);
    event.cycle = ppe_cycle(cell);
    if (event.kind == CGT_PPE_MAILBOX)
        (void)cgt_mfc_take_mailbox(mfc, event.cycle, &event.value);
    else if (event.kind == CGT_PPE_INTERRUPT)
        (void)cgt_mfc_take_interrupt_mailbox(mfc, event.cycle, &event.value);
    unlock(cell);
    if (cell->ppe)
        cell->ppe(cell->user, cell, &event);
}

bool cgt_cell_send_mailbox(cgt_cell *cell, unsigned spe, uint32_t value)
{
    if (spe >= cell->options.spes)
        return false;
    if (cell->spufs)
        return cgt_spufs_send_mailbox(cell->spufs, spe, value);
    lock(cell);
    const bool sent = cgt_mfc_send_mailbox(cell->spe[spe].mfc, ppe_cycle(cell), value);
    unlock(cell);
    return sent;
}

void cgt_cell_send_signal(cgt_cell *cell, unsigned spe, unsigned number, uint32_t value)
{
    if (spe >= cell->options.spes)
        return;
    if (cell->spufs) {
        cgt_spufs_send_signal(cell->spufs, spe, number, value);
        return;
    }
    lock(cell);
    cgt_mfc_send_signal(cell->spe[spe].mfc, ppe_cycle(cell), number, value);
    unlock(cell);
}

/* the bytes in memory, NULL where they are not all there */
static uint8_t *find_bytes(const cgt_cell *cell, uint64_t ea, size_t bytes, bool writes)
{
    const cgt_ea_region *const region = cgt_ea_map_find(&cell->map, ea);
    if (!region || region->kind != CGT_EA_MEMORY || bytes > region->bytes - (ea - region->ea) ||
        (writes && !region->writable))
        return NULL;
    return region->memory + (ea - region->ea);
}

bool cgt_cell_read(cgt_cell *cell, uint64_t ea, void *to, size_t bytes)
{
    lock(cell);
    const uint8_t *const from = find_bytes(cell, ea, bytes, false);
    if (from)
        memcpy(to, from, bytes);
    unlock(cell);
    return from != NULL;
}

bool cgt_cell_write(cgt_cell *cell, uint64_t ea, const void *from, size_t bytes)
{
    lock(cell);
    uint8_t *const to = find_bytes(cell, ea, bytes, true);
    if (to) {
        memcpy(to, from, bytes);
        cgt_ea_map_written(&cell->map, ea, bytes);
    }
    unlock(cell);
    return to != NULL;
}
