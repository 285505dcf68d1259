/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words on eight or sixteen lanes that are alike at either width: expressions of the compiler's vectors, and words of
 * one type by those of another. A part of spu_avx2.h and spu_avx512.h, which define the types, sel and the shifts. */
#ifndef CGT_SPU_WIDE_WORDS_H
#define CGT_SPU_WIDE_WORDS_H

/* clang-format off */
#define CGT_SPU_WIDE_F(word) vfloat : cgt_spu_##word##_f32w,
#define CGT_SPU_WIDE_SU(word) vint : cgt_spu_##word##_s32w, vuint : cgt_spu_##word##_u32w,
#define CGT_SPU_WIDE_FSU(word) CGT_SPU_WIDE_F(word) CGT_SPU_WIDE_SU(word)
/* clang-format on */

/* ---- arithmetic ---- */
CGT_SPU_INLINE vfloat cgt_spu_add_f32w(vfloat a, vfloat b) { return a + b; }
CGT_SPU_INLINE vint cgt_spu_add_s32w(vint a, vint b) { return (vint)((vuint)a + (vuint)b); }
CGT_SPU_INLINE vuint cgt_spu_add_u32w(vuint a, vuint b) { return a + b; }
CGT_SPU_INLINE vfloat cgt_spu_sub_f32w(vfloat a, vfloat b) { return a - b; }
CGT_SPU_INLINE vint cgt_spu_sub_s32w(vint a, vint b) { return (vint)((vuint)a - (vuint)b); }
CGT_SPU_INLINE vuint cgt_spu_sub_u32w(vuint a, vuint b) { return a - b; }
CGT_SPU_INLINE vfloat cgt_spu_mul_f32w(vfloat a, vfloat b) { return a * b; }

/* ---- bits ---- */
CGT_SPU_INLINE vuint cgt_spu_and_u32w(vuint a, vuint b) { return a & b; }
CGT_SPU_INLINE vuint cgt_spu_or_u32w(vuint a, vuint b) { return a | b; }
CGT_SPU_INLINE vuint cgt_spu_xor_u32w(vuint a, vuint b) { return a ^ b; }
CGT_SPU_INLINE vuint cgt_spu_andc_u32w(vuint a, vuint b) { return a & ~b; }
CGT_SPU_INLINE vuint cgt_spu_nor_u32w(vuint a, vuint b) { return ~(a | b); }
CGT_SPU_INLINE vint cgt_spu_and_s32w(vint a, vint b) { return a & b; }
CGT_SPU_INLINE vint cgt_spu_or_s32w(vint a, vint b) { return a | b; }
CGT_SPU_INLINE vint cgt_spu_xor_s32w(vint a, vint b) { return a ^ b; }
CGT_SPU_INLINE vint cgt_spu_andc_s32w(vint a, vint b) { return a & ~b; }
CGT_SPU_INLINE vint cgt_spu_nor_s32w(vint a, vint b) { return ~(a | b); }
CGT_SPU_INLINE vfloat cgt_spu_and_f32w(vfloat a, vfloat b) { return (vfloat)((vuint)a & (vuint)b); }
CGT_SPU_INLINE vfloat cgt_spu_or_f32w(vfloat a, vfloat b) { return (vfloat)((vuint)a | (vuint)b); }
CGT_SPU_INLINE vfloat cgt_spu_xor_f32w(vfloat a, vfloat b) { return (vfloat)((vuint)a ^ (vuint)b); }
CGT_SPU_INLINE vfloat cgt_spu_andc_f32w(vfloat a, vfloat b) { return (vfloat)((vuint)a & ~(vuint)b); }
CGT_SPU_INLINE vfloat cgt_spu_nor_f32w(vfloat a, vfloat b) { return (vfloat)(~((vuint)a | (vuint)b)); }
CGT_SPU_INLINE vint cgt_spu_sel_s32w(vint a, vint b, vuint m) { return (vint)cgt_spu_sel_u32w((vuint)a, (vuint)b, m); }
CGT_SPU_INLINE vfloat cgt_spu_sel_f32w(vfloat a, vfloat b, vuint m)
{
    return (vfloat)cgt_spu_sel_u32w((vuint)a, (vuint)b, m);
}

/* ---- shifts ---- */
CGT_SPU_INLINE vint cgt_spu_sl_s32w(vint a, unsigned n) { return (vint)cgt_spu_sl_u32w((vuint)a, n); }
CGT_SPU_INLINE vint cgt_spu_sr_s32w(vint a, unsigned n) { return (vint)cgt_spu_sr_u32w((vuint)a, n); }
CGT_SPU_INLINE vuint cgt_spu_sra_u32w(vuint a, unsigned n) { return (vuint)cgt_spu_sra_s32w((vint)a, n); }

/* ---- convert ---- */

/* 2^n for n from -127 to 127, from its bits */
CGT_SPU_INLINE vfloat cgt_spu_power_w(int n)
{
    const uint32_t bits = n > -127 ? (uint32_t)(n + 127) << 23 : UINT32_C(1) << 22;
    return (vfloat)((vuint){0} + bits);
}

#endif
