/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Branches, control, channels. A part of rows.h, and its last: the interpreter knows the three that
 * access channels by their place behind all others. */
/* clang-format off */
CGT_SPU_ROW(br,     RI16W, 0x190, BR, NONE,      GO(pc + (uint32_t)imm))
CGT_SPU_ROW(bra,    RI16W, 0x180, BR, NONE,      GO((uint32_t)imm))
CGT_SPU_ROW(brsl,   RI16W, 0x198, BR, T_OF_NONE, PUT_FIRST(LINK); GO(pc + (uint32_t)imm))
CGT_SPU_ROW(brasl,  RI16W, 0x188, BR, T_OF_NONE, PUT_FIRST(LINK); GO((uint32_t)imm))
CGT_SPU_ROW(brz,    RI16W, 0x100, BR, ONLY_T,    GO_IF(rt->word[0] == 0, pc + (uint32_t)imm))
CGT_SPU_ROW(brnz,   RI16W, 0x108, BR, ONLY_T,    GO_IF(rt->word[0] != 0, pc + (uint32_t)imm))
CGT_SPU_ROW(brhz,   RI16W, 0x110, BR, ONLY_T,    GO_IF((rt->word[0] & 0xffff) == 0, pc + (uint32_t)imm))
CGT_SPU_ROW(brhnz,  RI16W, 0x118, BR, ONLY_T,    GO_IF((rt->word[0] & 0xffff) != 0, pc + (uint32_t)imm))
CGT_SPU_ROW(bi,     RR,    0x1a8, BR, ONLY_A,    JUMP_IF(1, ra->word[0]))
CGT_SPU_ROW(bisl,   RR,    0x1a9, BR, T_OF_A,    const uint32_t to = ra->word[0]; JUMP_IF(1, to); PUT_FIRST(LINK))
CGT_SPU_ROW(biz,    RR,    0x128, BR, ONLY_AT,   JUMP_IF(rt->word[0] == 0, ra->word[0]))
CGT_SPU_ROW(binz,   RR,    0x129, BR, ONLY_AT,   JUMP_IF(rt->word[0] != 0, ra->word[0]))
CGT_SPU_ROW(bihz,   RR,    0x12a, BR, ONLY_AT,   JUMP_IF((rt->word[0] & 0xffff) == 0, ra->word[0]))
CGT_SPU_ROW(bihnz,  RR,    0x12b, BR, ONLY_AT,   JUMP_IF((rt->word[0] & 0xffff) != 0, ra->word[0]))
CGT_SPU_ROW(iret,   RR,    0x1aa, BR, ONLY_A,    JUMP_IF(1, spu->srr0))
CGT_SPU_ROW(bisled, RR,    0x1ab, BR, T_OF_A,    CALL_IF_EVENT(ra->word[0]))
CGT_SPU_ROW(stop,   CODE,  0x000, BR, NONE,      STOP((uint32_t)imm))
CGT_SPU_ROW(stopd,  RR,    0x140, BR, ONLY_ABT,  STOP(0x3fff))
CGT_SPU_ROW(nop,    RR,    0x201, NOP, NONE,     (void)0)
CGT_SPU_ROW(lnop,   RR,    0x001, LNOP, NONE,    (void)0)
CGT_SPU_ROW(sync,   RR,    0x002, BR, NONE,      (void)0)
CGT_SPU_ROW(dsync,  RR,    0x003, BR, NONE,      (void)0)
CGT_SPU_ROW(mfspr,  RR,    0x00c, SPR, T_OF_NONE, PUT(SPLAT(0)))
CGT_SPU_ROW(mtspr,  RR,    0x10c, SPR, ONLY_T,   (void)0)
CGT_SPU_ROW(rdch,   RR,    0x00d, SPR, T_OF_NONE, READ_CHANNEL)
CGT_SPU_ROW(rchcnt, RR,    0x00f, SPR, T_OF_NONE, COUNT_CHANNEL)
CGT_SPU_ROW(wrch,   RR,    0x10d, SPR, ONLY_T,   WRITE_CHANNEL)
