/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's double precision, in integers: the same bits on every host, in any rounding mode of it.
 *
 * IEEE 754 with these differences (ISA 1.2, section 9.2): a denormal operand counts as a zero of its sign; the only NaN
 * that comes out is 0x7ff8000000000000. Denormal results are kept. Multiply-adds round once; dfnms and dfnma negate
 * what was rounded, unless it is a NaN. The rounding is that of the FPSCR, each half of the register its own. The FPSCR
 * also collects flags. (An underflow is a result that is inexact, and below the least normal number before rounding.)
 *
 * fesd and frds take and give IEEE floats, with infinities and NaN; fesd takes a denormal float for a zero of its sign.
 *
 * A register holds two doubles, high word first. rt may be any of the operands. fpscr: cgt_spu.fpscr. */
#ifndef CGT_CELL_DOUBLE_H
#define CGT_CELL_DOUBLE_H

#include "cell/spu/spu.h"

/* Flags of doubles: in word 1 of the FPSCR for the first double, in word 2 for the second. */
#define CGT_SPU_DOUBLE_OVERFLOW 0x2000u
#define CGT_SPU_DOUBLE_UNDERFLOW 0x1000u
#define CGT_SPU_DOUBLE_INEXACT 0x0800u
#define CGT_SPU_DOUBLE_INVALID 0x0400u
#define CGT_SPU_DOUBLE_NAN 0x0200u
#define CGT_SPU_DOUBLE_DENORMAL 0x0100u

/* Two bits of word 0 of the FPSCR: 0xc00 for the first double, 0x300 for the second. */
typedef enum cgt_spu_rounding {
    CGT_SPU_TO_NEAREST,
    CGT_SPU_TO_ZERO,
    CGT_SPU_UPWARD,
    CGT_SPU_DOWNWARD
} cgt_spu_rounding;

/* a * b + c, or what is left of it, rounded once; sets *flags. */
uint64_t cgt_spu_double_fused(uint64_t a, uint64_t b, uint64_t c, cgt_spu_rounding rounding, uint32_t *flags);

/* rt = ra + rb, or ra - rb. */
void cgt_spu_double_add(cgt_spu_register *rt, const cgt_spu_register *ra, const cgt_spu_register *rb, int subtract,
                        uint32_t fpscr[4]);
void cgt_spu_double_mul(cgt_spu_register *rt, const cgt_spu_register *ra, const cgt_spu_register *rb,
                        uint32_t fpscr[4]);
/* rt = ra * rb + rt, or - rt; then negated. */
void cgt_spu_double_madd(cgt_spu_register *rt, const cgt_spu_register *ra, const cgt_spu_register *rb, int subtract,
                         int negate, uint32_t fpscr[4]);
/* fesd: words 0 and 2; frds: to words 0 and 2, the others become 0. */
void cgt_spu_double_extend(cgt_spu_register *rt, const cgt_spu_register *ra, uint32_t fpscr[4]);
void cgt_spu_double_round(cgt_spu_register *rt, const cgt_spu_register *ra, uint32_t fpscr[4]);

/* fscrwr: keeps the bits that exist. */
void cgt_spu_write_fpscr(uint32_t fpscr[4], const cgt_spu_register *ra);

#endif
