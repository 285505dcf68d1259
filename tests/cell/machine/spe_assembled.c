/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPE programs by hand. Registers: 3 the number of the SPE and 4 the argument, each in 64 bits; 10 the number, 11
 * the argument's lower half; 12 and 13 for whatever comes. */
#include "cell/machine/spe_programs.h"
#include "spu_mfcio.h"

#define DATA 0x1000 /* local address of what is transferred */

static void start(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, rotqbyi, .rt = 10, .ra = 3, .imm = 4);
    CGT_SPU_ASM(p, rotqbyi, .rt = 11, .ra = 4, .imm = 4);
}

static void write_constant(cgt_spu_assembler *p, unsigned channel, int32_t value)
{
    CGT_SPU_ASM(p, il, .rt = 13, .imm = value);
    CGT_SPU_ASM(p, wrch, .rt = 13, .ra = channel);
}

/* the address of main memory is in a register, its upper half 0 */
static void give(cgt_spu_assembler *p, unsigned ea, int32_t size, int32_t tag, int32_t command)
{
    write_constant(p, MFC_LSA, DATA);
    write_constant(p, MFC_EAH, 0);
    CGT_SPU_ASM(p, wrch, .rt = ea, .ra = MFC_EAL);
    write_constant(p, MFC_Size, size);
    write_constant(p, MFC_TagID, tag);
    write_constant(p, MFC_Cmd, command);
}

static void wait_for(cgt_spu_assembler *p, int32_t tag)
{
    write_constant(p, MFC_WrTagMask, 1 << tag);
    write_constant(p, MFC_WrTagUpdate, MFC_TAG_UPDATE_ALL);
    CGT_SPU_ASM(p, rdch, .rt = 12, .ra = MFC_RdTagStat);
}

void assemble_squares(cgt_spu_assembler *p)
{
    start(p);
    CGT_SPU_ASM(p, shli, .rt = 12, .ra = 10, .imm = 10);
    CGT_SPU_ASM(p, a, .rt = 11, .ra = 11, .rb = 12);
    give(p, 11, 4 * SQUARES_FLOATS, 3, MFC_GET_CMD);
    wait_for(p, 3);
    CGT_SPU_ASM(p, il, .rt = 20, .imm = DATA);
    CGT_SPU_ASM(p, il, .rt = 21, .imm = SQUARES_FLOATS / 4);
    const uint32_t loop = cgt_spu_here(p);
    CGT_SPU_ASM(p, lqd, .rt = 22, .ra = 20, .imm = 0);
    CGT_SPU_ASM(p, fm, .rt = 22, .ra = 22, .rb = 22);
    CGT_SPU_ASM(p, stqd, .rt = 22, .ra = 20, .imm = 0);
    CGT_SPU_ASM(p, ai, .rt = 20, .ra = 20, .imm = 16);
    CGT_SPU_ASM(p, ai, .rt = 21, .ra = 21, .imm = -1);
    CGT_SPU_ASM(p, brnz, .rt = 21, .imm = cgt_spu_distance(p, loop));
    give(p, 11, 4 * SQUARES_FLOATS, 3, MFC_PUTF_CMD);
    wait_for(p, 3);
    CGT_SPU_ASM(p, wrch, .rt = 10, .ra = SPU_WrOutMbox);
    CGT_SPU_ASM(p, stop, .imm = 0x2007);
}

void assemble_counter(cgt_spu_assembler *p)
{
    start(p);
    CGT_SPU_ASM(p, il, .rt = 20, .imm = DATA);
    CGT_SPU_ASM(p, il, .rt = 21, .imm = COUNTER_ROUNDS);
    CGT_SPU_ASM(p, fsmbi, .rt = 23, .imm = 0xf000); /* the first word alone */
    CGT_SPU_ASM(p, il, .rt = 24, .imm = 1);
    CGT_SPU_ASM(p, and, .rt = 24, .ra = 24, .rb = 23);
    const uint32_t loop = cgt_spu_here(p);
    give(p, 11, 128, 0, MFC_GETLLAR_CMD);
    CGT_SPU_ASM(p, rdch, .rt = 12, .ra = MFC_RdAtomicStat);
    CGT_SPU_ASM(p, lqd, .rt = 22, .ra = 20, .imm = 0);
    CGT_SPU_ASM(p, a, .rt = 22, .ra = 22, .rb = 24);
    CGT_SPU_ASM(p, stqd, .rt = 22, .ra = 20, .imm = 0);
    give(p, 11, 128, 0, MFC_PUTLLC_CMD);
    CGT_SPU_ASM(p, rdch, .rt = 12, .ra = MFC_RdAtomicStat);
    CGT_SPU_ASM(p, brnz, .rt = 12, .imm = cgt_spu_distance(p, loop));
    CGT_SPU_ASM(p, ai, .rt = 21, .ra = 21, .imm = -1);
    CGT_SPU_ASM(p, brnz, .rt = 21, .imm = cgt_spu_distance(p, loop));
    CGT_SPU_ASM(p, stop, .imm = 0x2000);
}

/* the row's number is in the first word of register 14, in all words of 15 */
void assemble_strips(cgt_spu_assembler *p)
{
    start(p);
    CGT_SPU_ASM(p, ila, .rt = 16, .imm = 0x10203);
    const uint32_t loop = cgt_spu_here(p);
    CGT_SPU_ASM(p, rdch, .rt = 14, .ra = SPU_RdInMbox);
    CGT_SPU_ASM(p, ai, .rt = 12, .ra = 14, .imm = 1);
    CGT_SPU_ASM(p, brnz, .rt = 12, .imm = 8); /* over the stop */
    CGT_SPU_ASM(p, stop, .imm = 0x2000);
    CGT_SPU_ASM(p, shufb, .rt = 15, .ra = 14, .rb = 14, .rc = 16);
    CGT_SPU_ASM(p, shli, .rt = 12, .ra = 14, .imm = 7);
    CGT_SPU_ASM(p, a, .rt = 17, .ra = 11, .rb = 12);
    give(p, 17, 128, 1, MFC_GET_CMD);
    wait_for(p, 1);
    CGT_SPU_ASM(p, il, .rt = 20, .imm = DATA);
    CGT_SPU_ASM(p, il, .rt = 21, .imm = 8);
    const uint32_t inner = cgt_spu_here(p);
    CGT_SPU_ASM(p, lqd, .rt = 22, .ra = 20, .imm = 0);
    CGT_SPU_ASM(p, a, .rt = 22, .ra = 22, .rb = 15);
    CGT_SPU_ASM(p, stqd, .rt = 22, .ra = 20, .imm = 0);
    CGT_SPU_ASM(p, ai, .rt = 20, .ra = 20, .imm = 16);
    CGT_SPU_ASM(p, ai, .rt = 21, .ra = 21, .imm = -1);
    CGT_SPU_ASM(p, brnz, .rt = 21, .imm = cgt_spu_distance(p, inner));
    give(p, 17, 128, 1, MFC_PUTF_CMD);
    wait_for(p, 1);
    CGT_SPU_ASM(p, wrch, .rt = 14, .ra = SPU_WrOutMbox);
    CGT_SPU_ASM(p, br, .imm = cgt_spu_distance(p, loop));
}
