/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shifts of words and halfwords. Right shifts take the negative count. Counts have six bits, of halfwords five:
 * all bits may be shifted out. A part of rows.h. */
/* clang-format off */
CGT_SPU_ROW(shl,     RR,   0x05b, FX3, T_OF_AB,  PUT(cgt_spu_left32(U32(ra), U32(rb))))
CGT_SPU_ROW(shli,    RI7,  0x07b, FX3, T_OF_A,   PUT(cgt_spu_left32(U32(ra), SPLAT(imm))))
CGT_SPU_ROW(rot,     RR,   0x058, FX3, T_OF_AB,  PUT(cgt_spu_rotate32(U32(ra), U32(rb))))
CGT_SPU_ROW(roti,    RI7,  0x078, FX3, T_OF_A,   PUT(cgt_spu_rotate32(U32(ra), SPLAT(imm))))
CGT_SPU_ROW(rotm,    RR,   0x059, FX3, T_OF_AB,  PUT(cgt_spu_right32(U32(ra), -U32(rb))))
CGT_SPU_ROW(rotmi,   RI7,  0x079, FX3, T_OF_A,   PUT(cgt_spu_right32(U32(ra), -SPLAT(imm))))
CGT_SPU_ROW(rotma,   RR,   0x05a, FX3, T_OF_AB,  PUT(cgt_spu_arithmetic32(S32(ra), -U32(rb))))
CGT_SPU_ROW(rotmai,  RI7,  0x07a, FX3, T_OF_A,   PUT(cgt_spu_arithmetic32(S32(ra), -SPLAT(imm))))
CGT_SPU_ROW(shlh,    RR,   0x05f, FX3, T_OF_AB,  PUT(cgt_spu_left16(U16(ra), U16(rb))))
CGT_SPU_ROW(shlhi,   RI7,  0x07f, FX3, T_OF_A,   PUT(cgt_spu_left16(U16(ra), SPLAT16(imm))))
CGT_SPU_ROW(roth,    RR,   0x05c, FX3, T_OF_AB,  PUT(cgt_spu_rotate16(U16(ra), U16(rb))))
CGT_SPU_ROW(rothi,   RI7,  0x07c, FX3, T_OF_A,   PUT(cgt_spu_rotate16(U16(ra), SPLAT16(imm))))
CGT_SPU_ROW(rothm,   RR,   0x05d, FX3, T_OF_AB,  PUT(cgt_spu_right16(U16(ra), -U16(rb))))
CGT_SPU_ROW(rothmi,  RI7,  0x07d, FX3, T_OF_A,   PUT(cgt_spu_right16(U16(ra), -SPLAT16(imm))))
CGT_SPU_ROW(rotmah,  RR,   0x05e, FX3, T_OF_AB,  PUT(cgt_spu_arithmetic16(S16(ra), -U16(rb))))
CGT_SPU_ROW(rotmahi, RI7,  0x07e, FX3, T_OF_A,   PUT(cgt_spu_arithmetic16(S16(ra), -SPLAT16(imm))))
