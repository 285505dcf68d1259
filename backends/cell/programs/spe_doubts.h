/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Undecided pairs of ray and object on their way to the PPE (cell/image/control_block.h): lines of sixteen, two in
 * local store, so that one is filled while the other goes out; a ring of two halves in main memory. */
#ifndef CGT_SPE_DOUBTS_H
#define CGT_SPE_DOUBTS_H

#include "cell/image/control_block.h"
#include "cell/machine/spe_program.h"

/* Part of a program's store, aligned to 128; zero at the start but for the last two. */
typedef struct spe_doubts {
    cgt_doubt line[2][CGT_DOUBTS_LINE];
    uint32_t doubts, half_doubts, half, unread; /* in all; in the current half; which; halves unread, as bits */
    uint32_t ea[2], capacity;                   /* of the ring; of half a ring */
    uint32_t tag;                               /* of DMA; the next one is taken, too */
} spe_doubts;

static inline void spe_doubts_wait(uint32_t mask)
{
    mfc_write_tag_mask(mask);
    mfc_read_tag_status_all();
}

/* Sends the line that holds the last of the half's doubts. */
static void spe_doubts_put(spe_doubts *d)
{
    const uint32_t line = (d->half_doubts - 1) / CGT_DOUBTS_LINE, buffer = line & 1;
    const uint64_t ring = (uint64_t)d->ea[0] << 32 | d->ea[1];
    const uint64_t at = ring + sizeof(cgt_doubt) * (d->half * d->capacity + line * CGT_DOUBTS_LINE);
    mfc_put(d->line[buffer], at, sizeof d->line[buffer], d->tag + buffer, 0, 0);
}

/* Hands a full half over, and waits until the other one has been read. */
static void spe_doubts_hand_over(spe_doubts *d)
{
    spe_doubts_wait(3u << d->tag);
    spu_write_out_intr_mbox(d->half << 16 | d->half_doubts);
    d->unread |= 1u << d->half;
    d->half ^= 1;
    d->half_doubts = 0;
    while (d->unread >> d->half & 1)
        d->unread &= ~spu_read_signal1();
}

static __attribute__((noinline)) void spe_doubts_add(spe_doubts *d, uint32_t ray, uint32_t object)
{
    const uint32_t line = d->half_doubts / CGT_DOUBTS_LINE, place = d->half_doubts % CGT_DOUBTS_LINE;
    if (!place) /* the line's buffer may still be on its way out */
        spe_doubts_wait(1u << (d->tag + (line & 1)));
    d->line[line & 1][place] = (cgt_doubt){ray, object};
    d->doubts++;
    d->half_doubts++;
    if (place == CGT_DOUBTS_LINE - 1)
        spe_doubts_put(d);
    if (d->half_doubts == d->capacity)
        spe_doubts_hand_over(d);
}

/* Sends what is left. */
static void spe_doubts_end(spe_doubts *d)
{
    if (d->half_doubts % CGT_DOUBTS_LINE)
        spe_doubts_put(d);
    spe_doubts_wait(3u << d->tag);
}

#endif
