/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Logic, selection of bits, constants. A part of rows.h. */
/* clang-format off */
CGT_SPU_ROW(and,     RR,   0x0c1, FX2, T_OF_AB,  PUT(U32(ra) & U32(rb)))
CGT_SPU_ROW(andc,    RR,   0x2c1, FX2, T_OF_AB,  PUT(U32(ra) & ~U32(rb)))
CGT_SPU_ROW(andbi,   RI10, 0x0b0, FX2, T_OF_A,   PUT(U8(ra) & (uint8_t)imm))
CGT_SPU_ROW(andhi,   RI10, 0x0a8, FX2, T_OF_A,   PUT(U16(ra) & (uint16_t)imm))
CGT_SPU_ROW(andi,    RI10, 0x0a0, FX2, T_OF_A,   PUT(U32(ra) & (uint32_t)imm))
CGT_SPU_ROW(or,      RR,   0x041, FX2, T_OF_AB,  PUT(U32(ra) | U32(rb)))
CGT_SPU_ROW(orc,     RR,   0x2c9, FX2, T_OF_AB,  PUT(U32(ra) | ~U32(rb)))
CGT_SPU_ROW(orbi,    RI10, 0x030, FX2, T_OF_A,   PUT(U8(ra) | (uint8_t)imm))
CGT_SPU_ROW(orhi,    RI10, 0x028, FX2, T_OF_A,   PUT(U16(ra) | (uint16_t)imm))
CGT_SPU_ROW(ori,     RI10, 0x020, FX2, T_OF_A,   PUT(U32(ra) | (uint32_t)imm))
CGT_SPU_ROW(xor,     RR,   0x241, FX2, T_OF_AB,  PUT(U32(ra) ^ U32(rb)))
CGT_SPU_ROW(xorbi,   RI10, 0x230, FX2, T_OF_A,   PUT(U8(ra) ^ (uint8_t)imm))
CGT_SPU_ROW(xorhi,   RI10, 0x228, FX2, T_OF_A,   PUT(U16(ra) ^ (uint16_t)imm))
CGT_SPU_ROW(xori,    RI10, 0x220, FX2, T_OF_A,   PUT(U32(ra) ^ (uint32_t)imm))
CGT_SPU_ROW(nand,    RR,   0x0c9, FX2, T_OF_AB,  PUT(~(U32(ra) & U32(rb))))
CGT_SPU_ROW(nor,     RR,   0x049, FX2, T_OF_AB,  PUT(~(U32(ra) | U32(rb))))
CGT_SPU_ROW(eqv,     RR,   0x249, FX2, T_OF_AB,  PUT(~(U32(ra) ^ U32(rb))))
CGT_SPU_ROW(selb,    RRR,  0x400, FX2, T_OF_ABC, PUT((U32(rc) & U32(rb)) | (~U32(rc) & U32(ra))))
CGT_SPU_ROW(il,      RI16S, 0x204, FX2, T_OF_NONE, PUT(SPLAT(imm)))
CGT_SPU_ROW(ilh,     RI16, 0x20c, FX2, T_OF_NONE, PUT(SPLAT((uint32_t)imm * 0x10001u)))
CGT_SPU_ROW(ilhu,    RI16, 0x208, FX2, T_OF_NONE, PUT(SPLAT((uint32_t)imm << 16)))
CGT_SPU_ROW(ila,     RI18, 0x210, FX2, T_OF_NONE, PUT(SPLAT(imm)))
CGT_SPU_ROW(iohl,    RI16, 0x304, FX2, T_OF_T,   PUT(U32(rt) | (uint32_t)imm))
