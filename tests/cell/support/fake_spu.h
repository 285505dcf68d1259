/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A processor that accesses channels from a list of steps: it stands in for a simulated SPU where a test is about the
 * MFC. Its local store has the SPU's byte order. Each step takes a cycle. */
#ifndef FAKE_SPU_H
#define FAKE_SPU_H

#include "cell/machine/machine.h"

struct fake_spu;

typedef enum fake_operation {
    FAKE_WRITE, /* value to channel */
    FAKE_SEND,  /* the last value that was read, to channel */
    FAKE_READ,
    FAKE_COUNT, /* into the last value, as a read */
    FAKE_WORK,  /* value cycles */
    FAKE_CALL,  /* call(spu): it may change the store and the next step */
    FAKE_STOP,  /* with code value */
    FAKE_HALT
} fake_operation;

typedef struct fake_step {
    fake_operation operation;
    unsigned channel;
    uint32_t value;
    void (*call)(struct fake_spu *spu);
} fake_step;

typedef struct fake_spu {
    _Alignas(128) uint8_t store[CGT_LOCAL_STORE_BYTES];
    const fake_step *steps;
    unsigned next; /* step */
    uint64_t cycle;
    uint32_t value;    /* the last one that was read or counted */
    uint32_t read[64]; /* all of them, the first 64 */
    uint64_t when[64]; /* the cycles */
    unsigned reads;
    uint32_t number; /* for calls: the SPE, and what they like */
    uint32_t counter;
} fake_spu;

/* the six channel writes of a command; size, tag and the low half of ea stand in their channels */
#define FAKE_DMA(lsa, ea, size, tag, command)                                                                          \
    {FAKE_WRITE, 16, lsa, NULL}, {FAKE_WRITE, 17, (uint32_t)((uint64_t)(ea) >> 32), NULL},                             \
        {FAKE_WRITE, 18, (uint32_t)(ea), NULL}, {FAKE_WRITE, 19, size, NULL}, {FAKE_WRITE, 20, tag, NULL},             \
    {                                                                                                                  \
        FAKE_WRITE, 21, command, NULL                                                                                  \
    }
/* the wait for all tags of a mask */
#define FAKE_WAIT(mask)                                                                                                \
    {FAKE_WRITE, 22, mask, NULL}, {FAKE_WRITE, 23, 2, NULL}, { FAKE_READ, 24, 0, NULL }

void fake_init(fake_spu *spu, const fake_step *steps);
cgt_spe_unit fake_unit(fake_spu *spu);
uint32_t fake_load32(const fake_spu *spu, uint32_t lsa);
void fake_store32(fake_spu *spu, uint32_t lsa, uint32_t value);

/* Runs the steps on one SPE with this memory at 0x10000, of 32-bit words. Returns the cell, to be destroyed. */
cgt_cell *fake_run(fake_spu *spu, uint32_t *memory, uint32_t words, const cgt_cell_options *options,
                   cgt_result *result);

#endif
