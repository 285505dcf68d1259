/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Portable mapping: floating point, in IEEE arithmetic. A part of spu_portable.h. (The SPU's own single precision is
 * spu_exact.h.) */
#ifndef CGT_SPU_PORTABLE_FLOAT_H
#define CGT_SPU_PORTABLE_FLOAT_H

/* madd, msub, nmsub, nmadd: 1 where the mapping has an instruction that rounds once, as an SPU does */
#ifndef CGT_SPU_OWN_MADD
#ifndef CGT_SPU_FUSED
#define CGT_SPU_FUSED 0
#endif
#define CGT_SPU_FUSED_DOUBLE 0
/* A product that the compiler must not fuse with later operations, as it does by default on machines that can. */
#if !defined(__FP_FAST_FMAF)
#define CGT_SPU_ROUNDED(product)
#elif defined(__x86_64__)
#define CGT_SPU_ROUNDED(product) __asm__("" : "+x"(product))
#elif defined(__aarch64__)
#define CGT_SPU_ROUNDED(product) __asm__("" : "+w"(product))
#else
#define CGT_SPU_ROUNDED(product) __asm__("" : "+m"(product))
#endif
#define CGT_SPU_X(word, type, vec, sum)                                                                                \
    CGT_SPU_INLINE vec cgt_spu_##word##_##type(vec a, vec b, vec c)                                                    \
    {                                                                                                                  \
        vec ab = a * b;                                                                                                \
        CGT_SPU_ROUNDED(ab);                                                                                           \
        return sum;                                                                                                    \
    }
#ifndef CGT_SPU_OWN_FLOAT
CGT_SPU_X(madd, f32, vec_float4, ab + c)
CGT_SPU_X(msub, f32, vec_float4, ab - c)
CGT_SPU_X(nmsub, f32, vec_float4, c - ab)
#endif
CGT_SPU_X(madd, f64, vec_double2, ab + c)
CGT_SPU_X(msub, f64, vec_double2, ab - c)
/* the SPU's doubles are rounded, then negated: so a zero has another sign than that of c - a * b */
CGT_SPU_X(nmsub, f64, vec_double2, -(ab - c))
CGT_SPU_X(nmadd, f64, vec_double2, -(ab + c))
#undef CGT_SPU_X
#endif

/* ---- single precision ---- */

#ifndef CGT_SPU_OWN_FLOAT
CGT_SPU_INLINE vec_float4 cgt_spu_add_f32(vec_float4 a, vec_float4 b) { return a + b; }
CGT_SPU_INLINE vec_float4 cgt_spu_sub_f32(vec_float4 a, vec_float4 b) { return a - b; }
CGT_SPU_INLINE vec_float4 cgt_spu_mul_f32(vec_float4 a, vec_float4 b) { return a * b; }

CGT_SPU_INLINE vec_float4 cgt_spu_abs_f32(vec_float4 a) { return cgt_spu_andc_f32(a, cgt_spu_splats_f32(-0.f)); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpeq_f32(vec_float4 a, vec_float4 b) { return (vec_uint4)(a == b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpgt_f32(vec_float4 a, vec_float4 b) { return (vec_uint4)(a > b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpabseq_f32(vec_float4 a, vec_float4 b)
{
    return (vec_uint4)(cgt_spu_abs_f32(a) == cgt_spu_abs_f32(b));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpabsgt_f32(vec_float4 a, vec_float4 b)
{
    return (vec_uint4)(cgt_spu_abs_f32(a) > cgt_spu_abs_f32(b));
}

/* estimates: the SPU's have a relative error of 2^-12, these are the quotient and the root; rsqrte ignores the sign */
#ifndef CGT_SPU_OWN_ESTIMATE
CGT_SPU_INLINE vec_float4 cgt_spu_re_f32(vec_float4 a) { return 1.f / a; }
CGT_SPU_INLINE vec_float4 cgt_spu_rsqrte_f32(vec_float4 a)
{
    a = cgt_spu_abs_f32(a);
    const vec_float4 root = {__builtin_sqrtf(a[0]), __builtin_sqrtf(a[1]), __builtin_sqrtf(a[2]),
                             __builtin_sqrtf(a[3])};
    return 1.f / root;
}
#endif
/* frest, frsqest and fi are the SPU's two steps to an estimate; here the first does all of it */
CGT_SPU_INLINE vec_float4 cgt_spu_frest_f32(vec_float4 a) { return cgt_spu_re_f32(a); }
CGT_SPU_INLINE vec_float4 cgt_spu_frsqest_f32(vec_float4 a) { return cgt_spu_rsqrte_f32(a); }
CGT_SPU_INLINE vec_float4 cgt_spu_fi_f32(vec_float4 a, vec_float4 b)
{
    (void)a;
    return b;
}

/* Conversions with a scale: 2^n is made from its bits; 2^-127 is a denormal. The product is exact unless it leaves the
 * range of normal numbers. */
CGT_SPU_INLINE vec_float4 cgt_spu_power_of_two(int n)
{
    return (vec_float4)cgt_spu_splats_u32(n > -127 ? (unsigned)(n + 127) << 23 : 0x00400000u);
}
#ifndef CGT_SPU_OWN_CONVTF
CGT_SPU_INLINE vec_float4 cgt_spu_to_float_s32(vec_int4 a) { return __builtin_convertvector(a, vec_float4); }
CGT_SPU_INLINE vec_float4 cgt_spu_to_float_u32(vec_uint4 a) { return __builtin_convertvector(a, vec_float4); }
#endif
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_s32(vec_int4 a, int n)
{
    return cgt_spu_to_float_s32(a) * cgt_spu_power_of_two(-n);
}
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_u32(vec_uint4 a, int n)
{
    return cgt_spu_to_float_u32(a) * cgt_spu_power_of_two(-n);
}

/* towards zero, saturated; NaN, which an SPU does not have, gives 0 here */
#ifndef CGT_SPU_OWN_CONVTS
CGT_SPU_INLINE vec_int4 cgt_spu_to_int_f32(vec_float4 a)
{
    /* only values in range are converted: C leaves others undefined */
    const vec_int4 large = (vec_int4)(a >= 2147483648.f), small = (vec_int4)(a < -2147483648.f);
    const vec_int4 fits = (vec_int4)(a >= -2147483648.f) & ~large; /* no NaN */
    const vec_int4 d = __builtin_convertvector((vec_float4)((vec_int4)a & fits), vec_int4);
    return d | (large & INT32_MAX) | (small & INT32_MIN);
}
/* from 2^31 on, 2^31 is subtracted and restored as the top bit */
CGT_SPU_INLINE vec_uint4 cgt_spu_to_uint_f32(vec_float4 a)
{
    const vec_int4 positive = (vec_int4)(a > 0.f), upper = (vec_int4)(a >= 2147483648.f);
    const vec_int4 large = (vec_int4)(a >= 4294967296.f);
    const vec_float4 rest = (vec_float4)((vec_int4)a & positive & ~large) - (vec_float4)(upper & ~large & 0x4f000000);
    const vec_int4 d = __builtin_convertvector(rest, vec_int4);
    return (vec_uint4)((d ^ (upper & INT32_MIN)) | large);
}
#endif
CGT_SPU_INLINE vec_int4 cgt_spu_convts_f32(vec_float4 a, int n)
{
    return cgt_spu_to_int_f32(a * cgt_spu_power_of_two(n));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_convtu_f32(vec_float4 a, int n)
{
    return cgt_spu_to_uint_f32(a * cgt_spu_power_of_two(n));
}
#endif

/* ---- double precision ---- */

CGT_SPU_INLINE vec_double2 cgt_spu_add_f64(vec_double2 a, vec_double2 b) { return a + b; }
CGT_SPU_INLINE vec_double2 cgt_spu_sub_f64(vec_double2 a, vec_double2 b) { return a - b; }
CGT_SPU_INLINE vec_double2 cgt_spu_mul_f64(vec_double2 a, vec_double2 b) { return a * b; }

CGT_SPU_INLINE vec_double2 cgt_spu_abs_f64(vec_double2 a) { return cgt_spu_andc_f64(a, cgt_spu_splats_f64(-0.)); }
CGT_SPU_INLINE vec_ullong2 cgt_spu_cmpeq_f64(vec_double2 a, vec_double2 b) { return (vec_ullong2)(a == b); }
CGT_SPU_INLINE vec_ullong2 cgt_spu_cmpgt_f64(vec_double2 a, vec_double2 b) { return (vec_ullong2)(a > b); }
CGT_SPU_INLINE vec_ullong2 cgt_spu_cmpabseq_f64(vec_double2 a, vec_double2 b)
{
    return (vec_ullong2)(cgt_spu_abs_f64(a) == cgt_spu_abs_f64(b));
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_cmpabsgt_f64(vec_double2 a, vec_double2 b)
{
    return (vec_ullong2)(cgt_spu_abs_f64(a) > cgt_spu_abs_f64(b));
}

/* testsv: all ones where the number is of one of the classes in the sum of SPU_SV_* */
CGT_SPU_INLINE vec_ullong2 cgt_spu_testsv_f64(vec_double2 a, int classes)
{
    const vec_ullong2 bits = (vec_ullong2)a, magnitude = bits << 1, zero = {0, 0};
    const vec_ullong2 infinity = cgt_spu_splats_u64(0xffe0000000000000u);
    const vec_ullong2 least_normal = cgt_spu_splats_u64(0x0020000000000000u);
    const vec_ullong2 negative = (vec_ullong2)((vec_llong2)bits < (vec_llong2)zero);
    const vec_ullong2 is_zero = (vec_ullong2)(magnitude == zero), is_infinite = (vec_ullong2)(magnitude == infinity);
    const vec_ullong2 is_denormal = (vec_ullong2)(magnitude < least_normal) & ~is_zero;
    vec_ullong2 d = zero;
#define CGT_SPU_CLASS(bit, mask) d |= (mask)&cgt_spu_splats_u64(classes & (bit) ? ~0ull : 0)
    CGT_SPU_CLASS(SPU_SV_NEG_DENORM, is_denormal & negative);
    CGT_SPU_CLASS(SPU_SV_POS_DENORM, is_denormal & ~negative);
    CGT_SPU_CLASS(SPU_SV_NEG_ZERO, is_zero & negative);
    CGT_SPU_CLASS(SPU_SV_POS_ZERO, is_zero & ~negative);
    CGT_SPU_CLASS(SPU_SV_NEG_INFINITY, is_infinite & negative);
    CGT_SPU_CLASS(SPU_SV_POS_INFINITY, is_infinite & ~negative);
    CGT_SPU_CLASS(SPU_SV_NAN, (vec_ullong2)(magnitude > infinity));
#undef CGT_SPU_CLASS
    return d;
}

/* ---- between the two: the floats are those of elements 0 and 2 ---- */

CGT_SPU_INLINE vec_double2 cgt_spu_extend_f32(vec_float4 a) { return (vec_double2){(double)a[0], (double)a[2]}; }
#ifndef CGT_SPU_OWN_ROUNDTF
CGT_SPU_INLINE vec_float4 cgt_spu_roundtf_f64(vec_double2 a) { return (vec_float4){(float)a[0], 0, (float)a[1], 0}; }
#endif

#endif
