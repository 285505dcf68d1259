/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Undecided pairs of pixel and object on their way to the PPE (cell/image/control_block.h): lines of sixteen, two in local
 * store, so that one is filled while the other goes out; a ring of two halves in main memory. */
#ifndef GRID_DOUBTS_H
#define GRID_DOUBTS_H

#include "cell/programs/grid/grid_store.h"

/* Sends the line that holds the last of the half's doubts. */
static void grid_put_doubts(void)
{
    const cgt_control_block *c = &s()->control;
    const uint32_t line = (s()->half_doubts - 1) / CGT_DOUBTS_LINE, buffer = line & 1;
    const uint64_t at = grid_ea(c->doubts) + sizeof(cgt_doubt) * (s()->half * c->half + line * CGT_DOUBTS_LINE);
    mfc_put(s()->doubt[buffer], at, sizeof s()->doubt[buffer], TAG_DOUBT0 + buffer, 0, 0);
}

/* Hands a full half over, and waits until the other one has been read. */
static void grid_hand_over(void)
{
    mfc_write_tag_mask(3u << TAG_DOUBT0);
    mfc_read_tag_status_all();
    spu_write_out_intr_mbox(s()->half << 16 | s()->half_doubts);
    s()->unread |= 1u << s()->half;
    s()->half ^= 1;
    s()->half_doubts = 0;
    while (s()->unread >> s()->half & 1)
        s()->unread &= ~spu_read_signal1();
}

/* Ray i of the current packet and an object. The packet's number of a set, 0 for a camera's, says whose rays they are. */
static __attribute__((noinline)) void grid_add_doubt(uint32_t i, uint32_t object)
{
    const uint32_t line = s()->half_doubts / CGT_DOUBTS_LINE, place = s()->half_doubts % CGT_DOUBTS_LINE;
    if (!place) /* the line's buffer may still be on its way out */
        grid_wait(TAG_DOUBT0 + (line & 1));
    s()->doubt[line & 1][place] = (cgt_doubt){(s()->y + i / 4) << 16 | (s()->x + i % 4), object | s()->origin[i]};
    s()->doubts++;
    s()->half_doubts++;
    if (place == CGT_DOUBTS_LINE - 1)
        grid_put_doubts();
    if (s()->half_doubts == s()->control.half)
        grid_hand_over();
}

/* Sends what is left, and tells of it in the report. */
static void grid_end_doubts(void)
{
    if (s()->half_doubts % CGT_DOUBTS_LINE)
        grid_put_doubts();
    mfc_write_tag_mask(3u << TAG_DOUBT0);
    mfc_read_tag_status_all();
    s()->report.doubts = s()->doubts;
    s()->report.rest_half = s()->half;
    s()->report.rest = s()->half_doubts;
}

#endif
