/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Mailboxes of 32-bit values between the PPE and the SPU (four in, one out, one out with an interrupt) and the two
 * signal notification registers, from both sides. */
#include <string.h>

#include "cell/mfc/mfc_internal.h"
#include "spu_mfcio.h"

static uint32_t take_first(cgt_mfc_mailbox *box)
{
    const uint32_t value = box->value[0];
    box->count--;
    memmove(&box->value[0], &box->value[1], box->count * sizeof box->value[0]);
    return value;
}

static void tell_time(cgt_mfc *mfc, uint64_t cycle)
{
    cgt_mfc_advance(mfc, cycle);
    mfc->changes++;
}

/* ---- the SPU's side ---- */

cgt_channel_status cgt_mfc_read_mailbox(cgt_mfc *mfc, uint32_t *value)
{
    if (mfc->in.count == 0)
        return CGT_CHANNEL_STALL;
    *value = take_first(&mfc->in);
    return CGT_CHANNEL_DONE;
}

cgt_channel_status cgt_mfc_write_mailbox(cgt_mfc *mfc, cgt_mfc_mailbox *box, uint32_t value)
{
    (void)mfc;
    if (box->count > 0)
        return CGT_CHANNEL_STALL;
    box->value[box->count++] = value;
    return CGT_CHANNEL_DONE;
}

cgt_channel_status cgt_mfc_read_signal(cgt_mfc *mfc, unsigned number, uint32_t *value)
{
    cgt_mfc_signal *const signal = &mfc->signal[number - 1];
    if (!signal->pending)
        return CGT_CHANNEL_STALL;
    *value = signal->value;
    signal->value = 0;
    signal->pending = false;
    return CGT_CHANNEL_DONE;
}

/* ---- the PPE's side ---- */

bool cgt_mfc_send_mailbox(cgt_mfc *mfc, uint64_t cycle, uint32_t value)
{
    tell_time(mfc, cycle);
    if (mfc->in.count == CGT_IN_MAILBOX)
        return false;
    mfc->in.value[mfc->in.count++] = value;
    if (mfc->in.count == 1)
        cgt_mfc_raise(mfc, MFC_IN_MBOX_AVAILABLE_EVENT);
    return true;
}

static bool take(cgt_mfc *mfc, cgt_mfc_mailbox *box, uint64_t cycle, uint32_t event, uint32_t *value)
{
    tell_time(mfc, cycle);
    if (box->count == 0)
        return false;
    *value = take_first(box);
    cgt_mfc_raise(mfc, event);
    return true;
}

bool cgt_mfc_take_mailbox(cgt_mfc *mfc, uint64_t cycle, uint32_t *value)
{
    return take(mfc, &mfc->out, cycle, MFC_OUT_MBOX_AVAILABLE_EVENT, value);
}

bool cgt_mfc_take_interrupt_mailbox(cgt_mfc *mfc, uint64_t cycle, uint32_t *value)
{
    return take(mfc, &mfc->interrupt, cycle, MFC_OUT_INTR_MBOX_AVAILABLE_EVENT, value);
}

void cgt_mfc_set_signal(cgt_mfc *mfc, unsigned number, uint32_t value)
{
    cgt_mfc_signal *const signal = &mfc->signal[number - 1];
    mfc->changes++;
    signal->value = signal->gathers ? signal->value | value : value;
    if (!signal->pending)
        cgt_mfc_raise(mfc, number == 1 ? MFC_SIGNAL_NOTIFY_1_EVENT : MFC_SIGNAL_NOTIFY_2_EVENT);
    signal->pending = true;
}

void cgt_mfc_send_signal(cgt_mfc *mfc, uint64_t cycle, unsigned number, uint32_t value)
{
    if (number != 1 && number != 2)
        return;
    tell_time(mfc, cycle);
    cgt_mfc_set_signal(mfc, number, value);
}

void cgt_mfc_set_signal_or(cgt_mfc *mfc, unsigned number, bool gathers)
{
    if (number == 1 || number == 2)
        mfc->signal[number - 1].gathers = gathers;
}
