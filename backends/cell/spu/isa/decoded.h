/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cache of decoded instructions: one entry per word of the local store and one behind it, so that an instruction is
 * decoded once, and running off the end needs no test. Whatever writes to the local store forgets the entries it
 * covers (cgt_spu_forget). */
#ifndef CGT_CELL_DECODED_H
#define CGT_CELL_DECODED_H

#include "cell/spu/isa/isa.h"
#include "cell/spu/spu.h"

#define CGT_SPU_WORDS (CGT_SPU_LOCAL_STORE / 4)

/* Registers of the timing alone: what is written nowhere, what is always ready. */
#define CGT_SPU_REGISTER_SINK 128
#define CGT_SPU_REGISTER_READY 129

typedef struct cgt_spu_decoded {
    int32_t imm;             /* of hints: the target's */
    uint8_t op;              /* cgt_spu_op */
    uint8_t class;           /* cgt_spu_class */
    uint8_t rt, ra, rb, rc;  /* operands */
    uint8_t writes, read[3]; /* registers for the timing; SINK and READY where there are fewer */
    int16_t branch;          /* of hints: distance of the branch in bytes */
} cgt_spu_decoded;

/* Decodes the instruction at an address, a multiple of 4 below CGT_SPU_LOCAL_STORE. */
void cgt_spu_decode(cgt_spu *spu, uint32_t address);

#endif
