/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's instructions: one row each, in the folder rows. A row is
 *
 *   CGT_SPU_ROW(name, format, opcode, class, registers, meaning)
 *
 *   format      where the fields lie: cgt_spu_format
 *   opcode      the leading 11 bits; formats with shorter opcodes have zeros behind them
 *   class       pipe and latency: cgt_spu_class
 *   registers   what is read and written: cgt_spu_use
 *   meaning     C, in the words of execute/execute.c
 *
 * The numbers are those of the Synergistic Processor Unit Instruction Set Architecture, version 1.2 (2007), compared
 * with the table of GNU binutils (include/opcode/spu-insns.h). These are the instructions of the Cell of 2006: the five
 * comparisons of doubles that came with the PowerXCell 8i (dfceq, dfcmeq, dfcgt, dfcmgt, dftsv) are undefined here. */
#ifndef CGT_CELL_ISA_H
#define CGT_CELL_ISA_H

#include <stdbool.h>
#include <stdint.h>

/* Fields of an instruction, from the most significant bit on; the opcode comes first.
 *   rt, ra, rb, rc   registers; imm: signed unless it says otherwise */
typedef enum cgt_spu_format {
    CGT_SPU_RR,    /* 11 bits of opcode, rb, ra, rt; in branches rb holds the bits CGT_SPU_FEATURE_* */
    CGT_SPU_RRR,   /* 4, rt, rb, ra, rc */
    CGT_SPU_RI7,   /* 11, 7 bits of imm, ra, rt */
    CGT_SPU_RI8,   /* 10, 8 bits of imm, unsigned, ra, rt */
    CGT_SPU_RI10,  /* 8, 10 bits of imm, ra, rt */
    CGT_SPU_RI10Q, /* the same in quadwords: imm is 16 times the field */
    CGT_SPU_RI16,  /* 9, 16 bits of imm, unsigned, rt */
    CGT_SPU_RI16S, /* 9, 16 bits of imm, rt */
    CGT_SPU_RI16W, /* the same in words: imm is 4 times the field */
    CGT_SPU_RI18,  /* 7, 18 bits of imm, unsigned, rt */
    CGT_SPU_LBT,   /* hints: 7, 2 high bits of the branch's distance, 16 bits of imm in words, 7 low bits */
    CGT_SPU_LBTI,  /* hints: 11, features and the 2 high bits, ra, 7 low bits */
    CGT_SPU_CODE   /* 11, 7 unused, 14 bits of imm, unsigned */
} cgt_spu_format;

/* Pipe and latency: timing/timing.h has the numbers. */
typedef enum cgt_spu_class {
    CGT_SPU_FX2,  /* even: logic, sums, comparisons */
    CGT_SPU_FX3,  /* even: shifts of elements */
    CGT_SPU_FXB,  /* even: bytes */
    CGT_SPU_FP6,  /* even: single precision */
    CGT_SPU_FP7,  /* even: products of integers, conversions, fi */
    CGT_SPU_FPD,  /* even: double precision */
    CGT_SPU_NOP,  /* even */
    CGT_SPU_LS,   /* odd: loads, stores, hints */
    CGT_SPU_SHUF, /* odd: shuffles, shifts of quadwords, estimates */
    CGT_SPU_BR,   /* odd: branches, orx, stop, sync */
    CGT_SPU_SPR,  /* odd: channels */
    CGT_SPU_LNOP, /* odd */
    CGT_SPU_CLASSES
} cgt_spu_class;

/* Registers that an instruction reads and writes. */
typedef enum cgt_spu_use {
    CGT_SPU_READS_A = 1,
    CGT_SPU_READS_B = 2,
    CGT_SPU_READS_C = 4,
    CGT_SPU_READS_T = 8,
    CGT_SPU_WRITES_T = 16,
    CGT_SPU_NONE = 0,
    CGT_SPU_ONLY_A = CGT_SPU_READS_A,
    CGT_SPU_ONLY_T = CGT_SPU_READS_T,
    CGT_SPU_ONLY_AB = CGT_SPU_READS_A | CGT_SPU_READS_B,
    CGT_SPU_ONLY_AT = CGT_SPU_READS_A | CGT_SPU_READS_T,
    CGT_SPU_ONLY_ABT = CGT_SPU_ONLY_AB | CGT_SPU_READS_T,
    CGT_SPU_T_OF_NONE = CGT_SPU_WRITES_T,
    CGT_SPU_T_OF_T = CGT_SPU_WRITES_T | CGT_SPU_READS_T,
    CGT_SPU_T_OF_A = CGT_SPU_WRITES_T | CGT_SPU_READS_A,
    CGT_SPU_T_OF_AB = CGT_SPU_WRITES_T | CGT_SPU_ONLY_AB,
    CGT_SPU_T_OF_ABC = CGT_SPU_T_OF_AB | CGT_SPU_READS_C,
    CGT_SPU_T_OF_ABT = CGT_SPU_T_OF_AB | CGT_SPU_READS_T
} cgt_spu_use;

/* Bits of rb in branches and hints. */
#define CGT_SPU_FEATURE_PREFETCH 0x40 /* of hbr: hbrp, no hint but a prefetch */
#define CGT_SPU_FEATURE_DISABLE 0x20  /* bid, irete and the like: disables interrupts where the branch is taken */
#define CGT_SPU_FEATURE_ENABLE 0x10

/* cgt_spu_op_a and so on. */
typedef enum cgt_spu_op {
    CGT_SPU_OP_UNDECODED, /* in the cache: not yet looked at */
    CGT_SPU_OP_UNDEFINED, /* no instruction */
    CGT_SPU_OP_END,       /* in the cache: behind the local store */
#define CGT_SPU_ROW(name, format, opcode, class, use, ...) cgt_spu_op_##name,
#include "cell/spu/isa/rows.h"
#undef CGT_SPU_ROW
    CGT_SPU_OPS
} cgt_spu_op;

#define CGT_SPU_FIRST_OP (CGT_SPU_OP_END + 1)

typedef struct cgt_spu_info {
    const char *name;
    uint16_t opcode; /* 11 bits */
    uint8_t format, class, use;
} cgt_spu_info;

/* By cgt_spu_op, from CGT_SPU_FIRST_OP on. */
extern const cgt_spu_info cgt_spu_isa[CGT_SPU_OPS];

/* Operands that a format lacks are 0. */
typedef struct cgt_spu_operands {
    unsigned rt, ra, rb, rc; /* below 128; in rdch, wrch, rchcnt, mfspr and mtspr ra is the channel or register */
    int32_t imm;             /* in bytes where the format counts words or quadwords */
    int32_t branch;          /* of hints: where the branch lies, in bytes from the hint */
} cgt_spu_operands;

/* The instruction of a word: UNDEFINED where it is none. cflts, cfltu, csflt and cuflt with a scale outside 0 to 127,
 * whose results the architecture leaves undefined, are none. */
cgt_spu_op cgt_spu_disassemble(uint32_t word, cgt_spu_operands *operands);

/* Makes the word of an instruction. Returns false where an operand does not fit its field. */
bool cgt_spu_encode(cgt_spu_op op, const cgt_spu_operands *operands, uint32_t *word);

#endif
