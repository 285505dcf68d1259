/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Comparisons: all ones where they hold. And the halts. A part of rows.h. */
/* clang-format off */
CGT_SPU_ROW(ceqb,    RR,   0x3d0, FX2, T_OF_AB,  PUT(U8(ra) == U8(rb)))
CGT_SPU_ROW(ceqh,    RR,   0x3c8, FX2, T_OF_AB,  PUT(U16(ra) == U16(rb)))
CGT_SPU_ROW(ceq,     RR,   0x3c0, FX2, T_OF_AB,  PUT(U32(ra) == U32(rb)))
CGT_SPU_ROW(ceqbi,   RI10, 0x3f0, FX2, T_OF_A,   PUT(U8(ra) == (uint8_t)imm))
CGT_SPU_ROW(ceqhi,   RI10, 0x3e8, FX2, T_OF_A,   PUT(U16(ra) == (uint16_t)imm))
CGT_SPU_ROW(ceqi,    RI10, 0x3e0, FX2, T_OF_A,   PUT(U32(ra) == (uint32_t)imm))
CGT_SPU_ROW(cgtb,    RR,   0x250, FX2, T_OF_AB,  PUT(S8(ra) > S8(rb)))
CGT_SPU_ROW(cgth,    RR,   0x248, FX2, T_OF_AB,  PUT(S16(ra) > S16(rb)))
CGT_SPU_ROW(cgt,     RR,   0x240, FX2, T_OF_AB,  PUT(S32(ra) > S32(rb)))
CGT_SPU_ROW(cgtbi,   RI10, 0x270, FX2, T_OF_A,   PUT(S8(ra) > (int8_t)imm))
CGT_SPU_ROW(cgthi,   RI10, 0x268, FX2, T_OF_A,   PUT(S16(ra) > (int16_t)imm))
CGT_SPU_ROW(cgti,    RI10, 0x260, FX2, T_OF_A,   PUT(S32(ra) > imm))
CGT_SPU_ROW(clgtb,   RR,   0x2d0, FX2, T_OF_AB,  PUT(U8(ra) > U8(rb)))
CGT_SPU_ROW(clgth,   RR,   0x2c8, FX2, T_OF_AB,  PUT(U16(ra) > U16(rb)))
CGT_SPU_ROW(clgt,    RR,   0x2c0, FX2, T_OF_AB,  PUT(U32(ra) > U32(rb)))
CGT_SPU_ROW(clgtbi,  RI10, 0x2f0, FX2, T_OF_A,   PUT(U8(ra) > (uint8_t)imm))
CGT_SPU_ROW(clgthi,  RI10, 0x2e8, FX2, T_OF_A,   PUT(U16(ra) > (uint16_t)imm))
CGT_SPU_ROW(clgti,   RI10, 0x2e0, FX2, T_OF_A,   PUT(U32(ra) > (uint32_t)imm))
CGT_SPU_ROW(heq,     RR,   0x3d8, FX2, ONLY_AB,  HALT_IF(ra->word[0] == rb->word[0]))
CGT_SPU_ROW(heqi,    RI10, 0x3f8, FX2, ONLY_A,   HALT_IF(ra->word[0] == (uint32_t)imm))
CGT_SPU_ROW(hgt,     RR,   0x258, FX2, ONLY_AB,  HALT_IF((int32_t)ra->word[0] > (int32_t)rb->word[0]))
CGT_SPU_ROW(hgti,    RI10, 0x278, FX2, ONLY_A,   HALT_IF((int32_t)ra->word[0] > imm))
CGT_SPU_ROW(hlgt,    RR,   0x2d8, FX2, ONLY_AB,  HALT_IF(ra->word[0] > rb->word[0]))
CGT_SPU_ROW(hlgti,   RI10, 0x2f8, FX2, ONLY_A,   HALT_IF(ra->word[0] > (uint32_t)imm))
