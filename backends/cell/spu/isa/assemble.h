/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small programs without an assembler: words are made from the table that decodes them.
 *
 *   uint32_t word[64];
 *   cgt_spu_assembler p = {word, 64};
 *   CGT_SPU_ASM(&p, il, .rt = 3, .imm = 10);
 *   const uint32_t loop = cgt_spu_here(&p);
 *   CGT_SPU_ASM(&p, ai, .rt = 3, .ra = 3, .imm = -1);
 *   CGT_SPU_ASM(&p, brnz, .rt = 3, .imm = cgt_spu_distance(&p, loop));
 *   CGT_SPU_ASM(&p, stop, .imm = 0x2000);
 *   if (!cgt_spu_assembler_load(&p, spu)) ... */
#ifndef CGT_CELL_ASSEMBLE_H
#define CGT_CELL_ASSEMBLE_H

#include "cell/spu/isa/isa.h"
#include "cell/spu/spu.h"

typedef struct cgt_spu_assembler {
    uint32_t *word; /* room for capacity words */
    uint32_t capacity;
    uint32_t count;   /* words so far */
    uint32_t address; /* of the first word in local store */
    bool failed;      /* no room, or an operand did not fit */
} cgt_spu_assembler;

/* Adds an instruction, or a word of any kind. A failure is kept: test it once, at the end. */
void cgt_spu_emit(cgt_spu_assembler *p, cgt_spu_op op, cgt_spu_operands operands);
void cgt_spu_emit_word(cgt_spu_assembler *p, uint32_t word);

/* CGT_SPU_ASM(assembler, mnemonic, .field = value, ...): the fields of cgt_spu_operands. */
#define CGT_SPU_ASM(p, name, ...) cgt_spu_emit(p, cgt_spu_op_##name, (cgt_spu_operands){__VA_ARGS__})

/* The address of the next instruction, and how far it is from there to an address: imm of relative branches. */
uint32_t cgt_spu_here(const cgt_spu_assembler *p);
int32_t cgt_spu_distance(const cgt_spu_assembler *p, uint32_t address);

/* Copies the program to its address and sets the program counter there. Returns false where the assembler failed, or
 * the program does not fit the local store. */
bool cgt_spu_assembler_load(const cgt_spu_assembler *p, cgt_spu *spu);

#endif
