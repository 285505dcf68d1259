/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact words on a host whose floating-point unit truncates and flushes in the mode of spu_arithmetic_mode.h. A
 * part of spu_exact.h, which explains the corrections and why values are held. A host provides, in that mode:
 *
 *   CGT_SPU_HOLD(v)                   an empty volatile asm that claims to change v
 *   cgt_spu_exact_is_outside(r)       an element is at or beyond the host's largest number, or NaN
 *   cgt_spu_exact_is_unordered(a, b)  an element of a or b is NaN
 *   cgt_spu_exact_fused_madd, _msub, _nmsub(a, b, c)
 *   cgt_spu_exact_to_float_s32, _u32(a)     truncated
 *   cgt_spu_exact_to_int(p, sign), _to_uint the integer part of p, saturated; sign, all ones or zero, is its sign
 *                                           where p is NaN */
#ifndef CGT_SPU_EXACT_FAST_H
#define CGT_SPU_EXACT_FAST_H

#define CGT_SPU_EXACT_RARELY(condition) __builtin_expect((condition), 0)

/* ---- arithmetic ---- */

/* Turns -0 into +0 and keeps all else. The zero is held so that the addition is not optimised away. */
CGT_SPU_INLINE vec_float4 cgt_spu_exact_positive_zero(vec_float4 r)
{
    vec_float4 zero = {0, 0, 0, 0};
    CGT_SPU_HOLD(zero);
    r = r + zero;
    CGT_SPU_HOLD(r);
    return r;
}

/* Completes an operation of two or three held operands with the result r. */
CGT_SPU_INLINE vec_float4 cgt_spu_exact_end2(vec_float4 r, uint32_t (*word)(uint32_t, uint32_t), vec_float4 a,
                                             vec_float4 b)
{
    CGT_SPU_HOLD(r);
    if (CGT_SPU_EXACT_RARELY(cgt_spu_exact_is_outside(r)))
        return (vec_float4)cgt_spu_exact_each2(word, (vec_uint4)a, (vec_uint4)b);
    return cgt_spu_exact_positive_zero(r);
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_end3(vec_float4 r, uint32_t (*word)(uint32_t, uint32_t, uint32_t), vec_float4 a,
                                             vec_float4 b, vec_float4 c)
{
    CGT_SPU_HOLD(r);
    if (CGT_SPU_EXACT_RARELY(cgt_spu_exact_is_outside(r)))
        return (vec_float4)cgt_spu_exact_each3(word, (vec_uint4)a, (vec_uint4)b, (vec_uint4)c);
    return cgt_spu_exact_positive_zero(r);
}

CGT_SPU_INLINE vec_float4 cgt_spu_add_f32(vec_float4 a, vec_float4 b)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    return cgt_spu_exact_end2(a + b, cgt_spu_model_add, a, b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_sub_f32(vec_float4 a, vec_float4 b)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    return cgt_spu_exact_end2(a - b, cgt_spu_model_sub, a, b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_mul_f32(vec_float4 a, vec_float4 b)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    return cgt_spu_exact_end2(a * b, cgt_spu_model_mul, a, b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_madd_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    CGT_SPU_HOLD(c);
    return cgt_spu_exact_end3(cgt_spu_exact_fused_madd(a, b, c), cgt_spu_model_madd, a, b, c);
}
CGT_SPU_INLINE vec_float4 cgt_spu_msub_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    CGT_SPU_HOLD(c);
    return cgt_spu_exact_end3(cgt_spu_exact_fused_msub(a, b, c), cgt_spu_model_msub, a, b, c);
}
CGT_SPU_INLINE vec_float4 cgt_spu_nmsub_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    CGT_SPU_HOLD(c);
    return cgt_spu_exact_end3(cgt_spu_exact_fused_nmsub(a, b, c), cgt_spu_model_nmsub, a, b, c);
}

/* ---- comparison ----
 *
 * In the mode a denormal compares as zero, and an infinity compares as exponent 255 with fraction 0 should. Only the
 * host's NaN goes to the model. */

CGT_SPU_INLINE vec_uint4 cgt_spu_cmpgt_f32(vec_float4 a, vec_float4 b)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    vec_uint4 r = (vec_uint4)(a > b);
    CGT_SPU_HOLD(r);
    if (CGT_SPU_EXACT_RARELY(cgt_spu_exact_is_unordered(a, b)))
        return cgt_spu_exact_each2(cgt_spu_model_cmpgt, (vec_uint4)a, (vec_uint4)b);
    return r;
}
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpeq_f32(vec_float4 a, vec_float4 b)
{
    CGT_SPU_HOLD(a);
    CGT_SPU_HOLD(b);
    vec_uint4 r = (vec_uint4)(a == b);
    CGT_SPU_HOLD(r);
    if (CGT_SPU_EXACT_RARELY(cgt_spu_exact_is_unordered(a, b)))
        return cgt_spu_exact_each2(cgt_spu_model_cmpeq, (vec_uint4)a, (vec_uint4)b);
    return r;
}

CGT_SPU_INLINE vec_float4 cgt_spu_exact_abs(vec_float4 a) { return (vec_float4)((vec_uint4)a & CGT_SPU_MODEL_LARGEST); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpabsgt_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_cmpgt_f32(cgt_spu_exact_abs(a), cgt_spu_exact_abs(b));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpabseq_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_cmpeq_f32(cgt_spu_exact_abs(a), cgt_spu_exact_abs(b));
}

/* ---- conversion ---- */

/* r / 2^n for r = 0 or |r| >= 1, by its exponent: 2^-127 is not a normal number. */
CGT_SPU_INLINE vec_float4 cgt_spu_exact_scale_down(vec_float4 r, int n)
{
    CGT_SPU_HOLD(r);
    const int32_t down = n * 0x00800000; /* n is at most 127 */
    const vec_int4 bits = (vec_int4)r, magnitude = bits & INT32_MAX;
    return (vec_float4)((bits - down) & (vec_int4)(magnitude > down + 0x007fffff));
}
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_s32(vec_int4 a, int n)
{
    CGT_SPU_HOLD(a);
    return cgt_spu_exact_scale_down(cgt_spu_exact_to_float_s32(a), n);
}
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_u32(vec_uint4 a, int n)
{
    CGT_SPU_HOLD(a);
    return cgt_spu_exact_scale_down(cgt_spu_exact_to_float_u32(a), n);
}

/* a * 2^n; exact unless it stops at the host's largest number, which does not matter: it is beyond all integers. */
CGT_SPU_INLINE vec_float4 cgt_spu_exact_scale_up(vec_float4 a, int n)
{
    const int32_t power = (n + 127) * 0x00800000;
    vec_float4 p = a * (vec_float4)(vec_int4){power, power, power, power};
    CGT_SPU_HOLD(p);
    return p;
}
CGT_SPU_INLINE vec_int4 cgt_spu_convts_f32(vec_float4 a, int n)
{
    CGT_SPU_HOLD(a);
    return cgt_spu_exact_to_int(cgt_spu_exact_scale_up(a, n), (vec_int4)a >> 31);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_convtu_f32(vec_float4 a, int n)
{
    CGT_SPU_HOLD(a);
    return cgt_spu_exact_to_uint(cgt_spu_exact_scale_up(a, n), (vec_int4)a >> 31);
}

#endif
