/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The channels of a simulated SPU, as whoever plays the rest of the SPE (the MFC, the mailboxes, the decrementer)
 * offers them. The SPU calls these three functions when rdch, wrch and rchcnt issue.
 *
 *   user      passed to all
 *   channel   0 to 127
 *   cycle     the cycle in which the instruction issues; with an untimed SPU the number of instructions before it
 *
 * DONE    the access has happened; read has set *value.
 * STALL   it cannot happen yet, and nothing has changed. cgt_spu_run returns CGT_SPU_STALLED with the program counter
 *         at the instruction, which is issued again by the next cgt_spu_run. Whoever knows how long it takes raises
 *         cgt_spu.cycle first: the SPU counts the difference as time that it waited for a channel.
 * ERROR   the access breaks a rule. cgt_spu_run returns CGT_SPU_ERROR; the sentence that says why is the channels' own
 *         to keep.
 *
 * count returns what rchcnt reads, and how many accesses would be done without a stall at that cycle.
 *
 * The SPU keeps the channels of its own state: 13 (machine status), 14 and 15 (SRR0). bisled asks for the count of
 * channel 0, the events. The functions run in the caller's floating-point environment. They may write to the local
 * store through cgt_spu_copy_in (spu.h). */
#ifndef CGT_CELL_CHANNELS_H
#define CGT_CELL_CHANNELS_H

#include <stdint.h>

typedef enum { CGT_CHANNEL_DONE, CGT_CHANNEL_STALL, CGT_CHANNEL_ERROR } cgt_channel_status;

typedef struct cgt_spu_channels {
    void *user;
    cgt_channel_status (*read)(void *user, unsigned channel, uint64_t cycle, uint32_t *value);
    cgt_channel_status (*write)(void *user, unsigned channel, uint64_t cycle, uint32_t value);
    uint32_t (*count)(void *user, unsigned channel, uint64_t cycle);
} cgt_spu_channels;

#endif
