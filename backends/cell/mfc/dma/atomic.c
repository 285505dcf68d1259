/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Atomic lines of 128 bytes. getllar reads one and reserves it; putllc writes it if nobody has written to it since;
 * putlluc writes it in any case. Any write to the line, by DMA or by the PPE, takes the reservations of it away. One
 * command at a time is under way, outside of the queue. */
#include "cell/mfc/mfc_internal.h"
#include "spu_mfcio.h"

void cgt_mfc_begin_atomic(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    mfc->atomic = *c;
    mfc->atomic.issued = mfc->atomic.started = mfc->now;
    mfc->atomic.number = mfc->commands++;
    mfc->atomic.finished = mfc->now + mfc->timing.atomic_latency + cgt_mfc_delay(mfc, mfc->atomic.number);
    mfc->atomic_runs = true;
    mfc->atomic_ready = false;
    mfc->counts.atomics++;
}

static uint32_t get_line(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    cgt_mfc_move(mfc, false, c->lsa, c->ea, CGT_LINE_BYTES);
    mfc->reservation.ea = c->ea;
    mfc->reservation.valid = true;
    return MFC_GETLLAR_STATUS;
}

/* The reservation ends in either case, its own write included. */
static uint32_t put_line_if_reserved(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    const bool reserved = mfc->reservation.valid && mfc->reservation.ea == c->ea;
    mfc->reservation.valid = false;
    if (!reserved) {
        mfc->counts.lost_lines++;
        return MFC_PUTLLC_STATUS; /* set where it failed */
    }
    cgt_mfc_move(mfc, true, c->lsa, c->ea, CGT_LINE_BYTES);
    return 0;
}

void cgt_mfc_end_atomic(cgt_mfc *mfc)
{
    const cgt_mfc_command *const c = &mfc->atomic;
    mfc->atomic_runs = false;
    switch (c->operation->opcode) {
    case MFC_GETLLAR_CMD: mfc->atomic_status = get_line(mfc, c); break;
    case MFC_PUTLLC_CMD: mfc->atomic_status = put_line_if_reserved(mfc, c); break;
    default:
        cgt_mfc_move(mfc, true, c->lsa, c->ea, CGT_LINE_BYTES);
        mfc->atomic_status = MFC_PUTLLUC_STATUS;
        break;
    }
    mfc->atomic_ready = true;
    mfc->changes++;
    cgt_mfc_trace_add(mfc, &(cgt_mfc_record){.issued = c->issued,
                                             .started = c->started,
                                             .finished = c->finished,
                                             .spe = mfc->spe,
                                             .command = c->operation->name,
                                             .tag = c->tag,
                                             .lsa = c->lsa,
                                             .ea = c->ea,
                                             .bytes = CGT_LINE_BYTES});
}

void cgt_mfc_lose_reservation(cgt_mfc *mfc)
{
    mfc->reservation.valid = false;
    mfc->changes++;
    cgt_mfc_raise(mfc, MFC_LLR_LOST_EVENT);
}
