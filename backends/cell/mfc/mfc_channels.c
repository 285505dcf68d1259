/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The MFC as an SPU sees it: its channels, and the life of an MFC. */
#include <stdlib.h>
#include <string.h>

#include "cell/mfc/mfc_internal.h"
#include "spu_mfcio.h"

/* ---- create and free ---- */

static bool settings_are_valid(unsigned spe, const cgt_local_store *store, const cgt_mfc_timing *timing)
{
    return spe < CGT_MAX_SPES && store->bytes && store->size > 0 && store->size % 16 == 0 &&
           store->size <= CGT_LOCAL_STORE_BYTES && timing->bytes_per_cycle > 0 && timing->decrementer_cycles > 0;
}

cgt_result cgt_mfc_create(cgt_ea_map *map, unsigned spe, const cgt_local_store *store, const cgt_mfc_timing *timing,
                          cgt_mfc_trace *trace, cgt_mfc **mfc)
{
    *mfc = NULL;
    if (!timing)
        timing = &cgt_mfc_default_timing;
    if (!settings_are_valid(spe, store, timing))
        return CGT_ERROR_INVALID_ARGUMENT;
    if (map->mfcs == CGT_MAX_SPES)
        return CGT_ERROR_TOO_LARGE;
    cgt_mfc *const made = calloc(1, sizeof *made);
    if (!made)
        return CGT_ERROR_OUT_OF_MEMORY;
    made->map = map;
    made->spe = spe;
    made->store = *store;
    made->timing = *timing;
    made->trace = trace;
    made->decrementer_event = CGT_NO_CYCLE;
    map->mfc[map->mfcs++] = made;
    *mfc = made;
    return CGT_OK;
}

void cgt_mfc_free(cgt_mfc *mfc)
{
    if (!mfc)
        return;
    cgt_ea_map *const map = mfc->map;
    unsigned kept = 0;
    for (unsigned i = 0; i < map->mfcs; i++)
        if (map->mfc[i] != mfc)
            map->mfc[kept++] = map->mfc[i];
    map->mfcs = kept;
    free(mfc);
}

cgt_mfc_rule cgt_mfc_get_error(const cgt_mfc *mfc, const char **message)
{
    if (message)
        *message = mfc->message;
    return mfc->rule;
}

const cgt_mfc_counts *cgt_mfc_get_counts(const cgt_mfc *mfc) { return &mfc->counts; }
void cgt_mfc_add_wait(cgt_mfc *mfc, uint64_t cycles) { mfc->counts.wait_cycles += cycles; }
uint64_t cgt_mfc_get_changes(const cgt_mfc *mfc) { return mfc->changes; }

/* ---- commands ---- */

/* The parameters start at zero again with each command, as spu_mfcdma32, which writes no upper half, expects. */
static cgt_channel_status give_command(cgt_mfc *mfc, uint32_t word)
{
    cgt_mfc_command c = mfc->parameters;
    c.operation = cgt_mfc_find_operation(word & 0xffff);
    if (!c.operation) {
        cgt_mfc_fail(mfc, CGT_RULE_COMMAND, "MFC_Cmd(0x%x, lsa 0x%x, ea 0x%llx, size %u, tag %u): no such command",
                     word, c.lsa, (unsigned long long)c.ea, c.size, c.tag);
        return CGT_CHANNEL_ERROR;
    }
    const bool atomic = c.operation->kind == CGT_MFC_ATOMIC;
    if (atomic ? mfc->atomic_runs : mfc->queued == CGT_MFC_QUEUE) {
        mfc->counts.queue_stalls += !atomic && !mfc->queue_was_full;
        mfc->queue_was_full |= !atomic;
        return CGT_CHANNEL_STALL;
    }
    mfc->queue_was_full = false;
    c.list = (uint32_t)c.ea; /* a list's address comes in the place of the lower half */
    if (!cgt_mfc_check_command(mfc, &c) || !cgt_mfc_watch_command(mfc, &c))
        return CGT_CHANNEL_ERROR;
    if (atomic || c.operation->kind == CGT_MFC_LINE)
        c.size = CGT_LINE_BYTES; /* MFC_Size does not count */
    memset(&mfc->parameters, 0, sizeof mfc->parameters);
    if (atomic)
        cgt_mfc_begin_atomic(mfc, &c);
    else
        cgt_mfc_enqueue(mfc, &c);
    return mfc->rule == CGT_RULE_NONE ? CGT_CHANNEL_DONE : CGT_CHANNEL_ERROR;
}

static cgt_channel_status ask_tags(cgt_mfc *mfc, uint32_t condition)
{
    if (condition > MFC_TAG_UPDATE_ALL) {
        cgt_mfc_fail(mfc, CGT_RULE_TAG_UPDATE, "MFC_WrTagUpdate(%u): none of 0 (immediate), 1 (any), 2 (all)",
                     condition);
        return CGT_CHANNEL_ERROR;
    }
    mfc->tag_condition = condition;
    mfc->tag_update = CGT_TAG_UPDATE_WAITS;
    cgt_mfc_update_tags(mfc);
    return CGT_CHANNEL_DONE;
}

static cgt_channel_status read_tags(cgt_mfc *mfc, uint32_t *value)
{
    if (mfc->tag_update == CGT_TAG_UPDATE_NONE) {
        cgt_mfc_fail(mfc, CGT_RULE_TAG_STATUS, "MFC_RdTagStat: read without MFC_WrTagUpdate before it");
        return CGT_CHANNEL_ERROR;
    }
    if (mfc->tag_update == CGT_TAG_UPDATE_WAITS)
        return CGT_CHANNEL_STALL;
    *value = mfc->tag_status;
    mfc->tag_update = CGT_TAG_UPDATE_NONE;
    return cgt_mfc_watch_status(mfc) ? CGT_CHANNEL_DONE : CGT_CHANNEL_ERROR;
}

static cgt_channel_status read_atomic(cgt_mfc *mfc, uint32_t *value)
{
    if (mfc->atomic_runs)
        return CGT_CHANNEL_STALL;
    if (!mfc->atomic_ready) {
        cgt_mfc_fail(mfc, CGT_RULE_ATOMIC_STATUS, "MFC_RdAtomicStat: read without an atomic command before it");
        return CGT_CHANNEL_ERROR;
    }
    *value = mfc->atomic_status;
    mfc->atomic_ready = false;
    return CGT_CHANNEL_DONE;
}

/* a status that a read empties */
static cgt_channel_status read_list_stalls(cgt_mfc *mfc, uint32_t *value)
{
    if (mfc->stalled_tags == 0)
        return CGT_CHANNEL_STALL;
    *value = mfc->stalled_tags;
    mfc->stalled_tags = 0;
    return CGT_CHANNEL_DONE;
}

static cgt_channel_status read_events(cgt_mfc *mfc, uint32_t *value)
{
    if (!mfc->event_counts)
        return CGT_CHANNEL_STALL;
    *value = mfc->events & mfc->event_mask;
    mfc->event_counts = false;
    return CGT_CHANNEL_DONE;
}

/* ---- the channels ---- */

static cgt_channel_status wrong_channel(cgt_mfc *mfc, const char *access, unsigned channel)
{
    const char *const name = cgt_spu_channel_name(channel);
    cgt_mfc_fail(mfc, CGT_RULE_CHANNEL, "%s(%u): %s", access, channel, name ? name : "there is no such channel");
    return CGT_CHANNEL_ERROR;
}

static cgt_channel_status give(uint32_t *value, uint32_t is)
{
    *value = is;
    return CGT_CHANNEL_DONE;
}

static cgt_channel_status read_channel(void *user, unsigned channel, uint64_t cycle, uint32_t *value)
{
    cgt_mfc *const mfc = user;
    cgt_mfc_advance(mfc, cycle);
    if (mfc->rule != CGT_RULE_NONE)
        return CGT_CHANNEL_ERROR;
    switch (channel) {
    case SPU_RdEventStat: return read_events(mfc, value);
    case SPU_RdSigNotify1: return cgt_mfc_read_signal(mfc, 1, value);
    case SPU_RdSigNotify2: return cgt_mfc_read_signal(mfc, 2, value);
    case SPU_RdDec: return give(value, cgt_mfc_read_decrementer(mfc));
    case SPU_RdEventMask: return give(value, mfc->event_mask);
    case MFC_RdTagMask: return give(value, mfc->tag_mask);
    case SPU_RdMachStat: return give(value, 0);
    case SPU_RdSRR0: return give(value, mfc->srr0);
    case MFC_RdTagStat: return read_tags(mfc, value);
    case MFC_RdListStallStat: return read_list_stalls(mfc, value);
    case MFC_RdAtomicStat: return read_atomic(mfc, value);
    case SPU_RdInMbox: return cgt_mfc_read_mailbox(mfc, value);
    default: return wrong_channel(mfc, "rdch", channel);
    }
}

/* sets a register of the MFC */
static cgt_channel_status set(uint32_t *to, uint32_t value)
{
    *to = value;
    return CGT_CHANNEL_DONE;
}

static cgt_channel_status write_parameter(cgt_mfc *mfc, unsigned channel, uint32_t value)
{
    cgt_mfc_command *const p = &mfc->parameters;
    switch (channel) {
    case MFC_LSA: return set(&p->lsa, value);
    case MFC_Size: return set(&p->size, value);
    case MFC_TagID: return set(&p->tag, value);
    case MFC_EAH: p->ea = (p->ea & 0xffffffffu) | (uint64_t)value << 32; break;
    default: p->ea = (p->ea >> 32 << 32) | value; break; /* MFC_EAL */
    }
    return CGT_CHANNEL_DONE;
}

static cgt_channel_status write_channel(void *user, unsigned channel, uint64_t cycle, uint32_t value)
{
    cgt_mfc *const mfc = user;
    cgt_mfc_advance(mfc, cycle);
    if (mfc->rule != CGT_RULE_NONE)
        return CGT_CHANNEL_ERROR;
    switch (channel) {
    case SPU_WrEventMask: cgt_mfc_write_event_mask(mfc, value); return CGT_CHANNEL_DONE;
    case SPU_WrEventAck: cgt_mfc_acknowledge_events(mfc, value); return CGT_CHANNEL_DONE;
    case SPU_WrDec: cgt_mfc_write_decrementer(mfc, value); return CGT_CHANNEL_DONE;
    case MFC_WrMSSyncReq: return CGT_CHANNEL_DONE;
    case SPU_WrSRR0: return set(&mfc->srr0, value);
    case MFC_LSA:
    case MFC_EAH:
    case MFC_EAL:
    case MFC_Size:
    case MFC_TagID: return write_parameter(mfc, channel, value);
    case MFC_Cmd: return give_command(mfc, value);
    case MFC_WrTagMask: return set(&mfc->tag_mask, value);
    case MFC_WrTagUpdate: return ask_tags(mfc, value);
    case MFC_WrListStallAck: return cgt_mfc_acknowledge_list(mfc, value);
    case SPU_WrOutMbox: return cgt_mfc_write_mailbox(mfc, &mfc->out, value);
    case SPU_WrOutIntrMbox: return cgt_mfc_write_mailbox(mfc, &mfc->interrupt, value);
    default: return wrong_channel(mfc, "wrch", channel);
    }
}

static uint32_t count_channel(void *user, unsigned channel, uint64_t cycle)
{
    cgt_mfc *const mfc = user;
    cgt_mfc_advance(mfc, cycle);
    if (mfc->rule != CGT_RULE_NONE)
        return 0;
    switch (channel) {
    case SPU_RdEventStat: return mfc->event_counts;
    case SPU_RdSigNotify1: return mfc->signal[0].pending;
    case SPU_RdSigNotify2: return mfc->signal[1].pending;
    case MFC_Cmd: return CGT_MFC_QUEUE - mfc->queued;
    case MFC_RdTagStat: return mfc->tag_update == CGT_TAG_UPDATE_READY;
    case MFC_RdListStallStat: return mfc->stalled_tags != 0;
    case MFC_RdAtomicStat: return mfc->atomic_ready;
    case SPU_RdInMbox: return mfc->in.count;
    case SPU_WrOutMbox: return 1 - mfc->out.count;
    case SPU_WrOutIntrMbox: return 1 - mfc->interrupt.count;
    default: return cgt_spu_channel_name(channel) != NULL; /* never stall; 0 for what is no channel */
    }
}

cgt_spu_channels cgt_mfc_get_channels(cgt_mfc *mfc)
{
    return (cgt_spu_channels){.user = mfc, .read = read_channel, .write = write_channel, .count = count_channel};
}
