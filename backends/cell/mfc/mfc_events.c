/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Events and the decrementer. An event is pending from the moment that its condition comes about until it is
 * acknowledged. SPU_RdEventStat has a count when an event comes that the mask wants, or is left after an
 * acknowledgement or a change of the mask; a read takes the count away, the events stay. */
#include "cell/mfc/mfc_internal.h"
#include "spu_mfcio.h"

void cgt_mfc_raise(cgt_mfc *mfc, uint32_t events)
{
    mfc->events |= events;
    if (events & mfc->event_mask) {
        mfc->event_counts = true;
        mfc->changes++;
    }
}

void cgt_mfc_write_event_mask(cgt_mfc *mfc, uint32_t mask)
{
    mfc->event_mask = mask;
    mfc->event_counts = (mfc->events & mask) != 0;
}

void cgt_mfc_acknowledge_events(cgt_mfc *mfc, uint32_t events)
{
    mfc->events &= ~events;
    mfc->event_counts = (mfc->events & mfc->event_mask) != 0;
}

/* ---- the decrementer ---- */

uint32_t cgt_mfc_read_decrementer(const cgt_mfc *mfc)
{
    const uint64_t steps = (mfc->now - mfc->decrementer_start) / mfc->timing.decrementer_cycles;
    return mfc->decrementer - (uint32_t)steps;
}

/* Its event comes when the highest bit changes from 0 to 1: after value + 1 steps. A value that has the bit comes there
 * once it has counted down to it again, which takes hours; nobody waits for that here. */
void cgt_mfc_write_decrementer(cgt_mfc *mfc, uint32_t value)
{
    mfc->decrementer = value;
    mfc->decrementer_start = mfc->now;
    mfc->decrementer_event = CGT_NO_CYCLE;
    if (value >> 31 == 0)
        mfc->decrementer_event = mfc->now + ((uint64_t)value + 1) * mfc->timing.decrementer_cycles;
}
