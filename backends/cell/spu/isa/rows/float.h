/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Single precision by the library's exact words (simd/spu/spu_exact.h), double precision by execute/double.c. The
 * scales of conversions are 173 and 155 less the field. A part of rows.h. */
/* clang-format off */
CGT_SPU_ROW(fa,      RR,   0x2c4, FP6, T_OF_AB,  PUT(cgt_spu_add_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(fs,      RR,   0x2c5, FP6, T_OF_AB,  PUT(cgt_spu_sub_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(fm,      RR,   0x2c6, FP6, T_OF_AB,  PUT(cgt_spu_mul_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(fma,     RRR,  0x700, FP6, T_OF_ABC, PUT(cgt_spu_madd_f32(F32(ra), F32(rb), F32(rc))))
CGT_SPU_ROW(fms,     RRR,  0x780, FP6, T_OF_ABC, PUT(cgt_spu_msub_f32(F32(ra), F32(rb), F32(rc))))
CGT_SPU_ROW(fnms,    RRR,  0x680, FP6, T_OF_ABC, PUT(cgt_spu_nmsub_f32(F32(ra), F32(rb), F32(rc))))
CGT_SPU_ROW(fceq,    RR,   0x3c2, FX2, T_OF_AB,  PUT(cgt_spu_cmpeq_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(fcmeq,   RR,   0x3ca, FX2, T_OF_AB,  PUT(cgt_spu_cmpabseq_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(fcgt,    RR,   0x2c2, FX2, T_OF_AB,  PUT(cgt_spu_cmpgt_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(fcmgt,   RR,   0x2ca, FX2, T_OF_AB,  PUT(cgt_spu_cmpabsgt_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(frest,   RR,   0x1b8, SHUF, T_OF_A,  PUT(cgt_spu_frest_f32(F32(ra))))
CGT_SPU_ROW(frsqest, RR,   0x1b9, SHUF, T_OF_A,  PUT(cgt_spu_frsqest_f32(F32(ra))))
CGT_SPU_ROW(fi,      RR,   0x3d4, FP7, T_OF_AB,  PUT(cgt_spu_fi_f32(F32(ra), F32(rb))))
CGT_SPU_ROW(cflts,   RI8,  0x3b0, FP7, T_OF_A,   PUT(cgt_spu_convts_f32(F32(ra), 173 - imm)))
CGT_SPU_ROW(cfltu,   RI8,  0x3b2, FP7, T_OF_A,   PUT(cgt_spu_convtu_f32(F32(ra), 173 - imm)))
CGT_SPU_ROW(csflt,   RI8,  0x3b4, FP7, T_OF_A,   PUT(cgt_spu_convtf_s32(S32(ra), 155 - imm)))
CGT_SPU_ROW(cuflt,   RI8,  0x3b6, FP7, T_OF_A,   PUT(cgt_spu_convtf_u32(U32(ra), 155 - imm)))
CGT_SPU_ROW(dfa,     RR,   0x2cc, FPD, T_OF_AB,  cgt_spu_double_add(rt, ra, rb, 0, spu->fpscr))
CGT_SPU_ROW(dfs,     RR,   0x2cd, FPD, T_OF_AB,  cgt_spu_double_add(rt, ra, rb, 1, spu->fpscr))
CGT_SPU_ROW(dfm,     RR,   0x2ce, FPD, T_OF_AB,  cgt_spu_double_mul(rt, ra, rb, spu->fpscr))
CGT_SPU_ROW(dfma,    RR,   0x35c, FPD, T_OF_ABT, cgt_spu_double_madd(rt, ra, rb, 0, 0, spu->fpscr))
CGT_SPU_ROW(dfms,    RR,   0x35d, FPD, T_OF_ABT, cgt_spu_double_madd(rt, ra, rb, 1, 0, spu->fpscr))
CGT_SPU_ROW(dfnms,   RR,   0x35e, FPD, T_OF_ABT, cgt_spu_double_madd(rt, ra, rb, 1, 1, spu->fpscr))
CGT_SPU_ROW(dfnma,   RR,   0x35f, FPD, T_OF_ABT, cgt_spu_double_madd(rt, ra, rb, 0, 1, spu->fpscr))
CGT_SPU_ROW(fesd,    RR,   0x3b8, FPD, T_OF_A,   cgt_spu_double_extend(rt, ra, spu->fpscr))
CGT_SPU_ROW(frds,    RR,   0x3b9, FPD, T_OF_A,   cgt_spu_double_round(rt, ra, spu->fpscr))
CGT_SPU_ROW(fscrrd,  RR,   0x398, FPD, T_OF_NONE, memcpy(rt, spu->fpscr, sizeof spu->fpscr))
CGT_SPU_ROW(fscrwr,  RR,   0x3ba, FP7, ONLY_A,   cgt_spu_write_fpscr(spu->fpscr, ra))
