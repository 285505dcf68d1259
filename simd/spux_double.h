/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vectors of doubles, half as many as a vfloat has lanes, for values computed once per hit. Arithmetic uses C's
 * operators, which no variant fuses: the same bits at every width.
 *
 *   spux_double_low, high(a)       the first and the other half of a vfloat's lanes, exactly
 *   spux_double_sum(a, b)          the sums of CGT_DOUBLES floats at a, aligned to them, and of b, rounded to float
 *   spux_float_of(low, high)       the reverse of low and high, rounded to nearest
 *   spux_float_where(low, high, m) the same, and 0 outside the mask m
 *   spux_vdouble(x)                x in every lane
 *   spux_double_sqrt(a)            correctly rounded
 *   spux_double_abs(a)
 *   spux_double_add_square(s, a)   s + a a, a converted from float: the square is exact, so fusing changes no bit
 *   spux_double_select(a, b, x)    b where x is above 0, else a
 *   spux_double_above0(low, high)  the vmask of what is above 0; where it is so small that a float of it is 0,
 *                                  either way
 *   spux_double_cmpgt(a, b)        the vmask of a[0] > b[0], low lanes, and a[1] > b[1], high ones
 *   spux_double_load8_at(base, at, d)        records of 8 doubles, number k at base + at[k], to the vectors d[8]
 *   spux_double_store8(base, stride, d)      the reverse, record k to base + k stride */
#ifndef CGT_SPUX_DOUBLE_H
#define CGT_SPUX_DOUBLE_H

#include "vector.h"

#define CGT_DOUBLES (CGT_LANES / 2)

typedef double vdouble __attribute__((vector_size(4 * CGT_LANES)));
typedef int64_t cgt_spux_long_w __attribute__((vector_size(4 * CGT_LANES)));

CGT_SPU_INLINE vdouble spux_vdouble(double x) { return x - (vdouble){0}; }

#if CGT_LANES == 16
CGT_SPU_INLINE vdouble spux_double_sum(const float *a, float b)
{
    return (vdouble)_mm512_cvtps_pd(_mm256_add_ps(_mm256_load_ps(a), _mm256_set1_ps(b)));
}
CGT_SPU_INLINE vdouble spux_double_low(vfloat a) { return (vdouble)_mm512_cvtps_pd(cgt_spux_half_w(a, 0)); }
CGT_SPU_INLINE vdouble spux_double_high(vfloat a) { return (vdouble)_mm512_cvtps_pd(cgt_spux_half_w(a, 1)); }
CGT_SPU_INLINE vfloat spux_float_of(vdouble low, vdouble high)
{
    const __m256 l = _mm512_cvtpd_ps((__m512d)low), h = _mm512_cvtpd_ps((__m512d)high);
    return (vfloat)_mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_castps_pd(l)), _mm256_castps_pd(h), 1);
}
CGT_SPU_INLINE vdouble spux_double_sqrt(vdouble a) { return (vdouble)_mm512_sqrt_pd((__m512d)a); }
CGT_SPU_INLINE vfloat spux_float_where(vdouble low, vdouble high, vmask m)
{
    const __mmask8 first = (__mmask8)m.bits, second = (__mmask8)(m.bits >> 8);
    const __m256 l = _mm512_maskz_cvtpd_ps(first, (__m512d)low), h = _mm512_maskz_cvtpd_ps(second, (__m512d)high);
    return (vfloat)_mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_castps_pd(l)), _mm256_castps_pd(h), 1);
}
#elif CGT_LANES == 8
CGT_SPU_INLINE vdouble spux_double_sum(const float *a, float b)
{
    return (vdouble)_mm256_cvtps_pd(_mm_add_ps(_mm_load_ps(a), _mm_set1_ps(b)));
}
CGT_SPU_INLINE vdouble spux_double_low(vfloat a) { return (vdouble)_mm256_cvtps_pd(_mm256_castps256_ps128((__m256)a)); }
CGT_SPU_INLINE vdouble spux_double_high(vfloat a)
{
    return (vdouble)_mm256_cvtps_pd(_mm256_extractf128_ps((__m256)a, 1));
}
CGT_SPU_INLINE vfloat spux_float_of(vdouble low, vdouble high)
{
    const __m128 l = _mm256_cvtpd_ps((__m256d)low), h = _mm256_cvtpd_ps((__m256d)high);
    return (vfloat)_mm256_insertf128_ps(_mm256_castps128_ps256(l), h, 1);
}
CGT_SPU_INLINE vdouble spux_double_sqrt(vdouble a) { return (vdouble)_mm256_sqrt_pd((__m256d)a); }
#elif defined(CGT_SPUX_WASM_H)
CGT_SPU_INLINE vdouble spux_double_sum(const float *a, float b)
{
    return (vdouble)wasm_f64x2_promote_low_f32x4(wasm_f32x4_add(wasm_v128_load64_zero(a), wasm_f32x4_splat(b)));
}
CGT_SPU_INLINE vdouble spux_double_low(vfloat a) { return (vdouble)wasm_f64x2_promote_low_f32x4((v128_t)a); }
CGT_SPU_INLINE vdouble spux_double_high(vfloat a)
{
    return (vdouble)wasm_f64x2_promote_low_f32x4(wasm_i64x2_shuffle((v128_t)a, (v128_t)a, 1, 1));
}
CGT_SPU_INLINE vfloat spux_float_of(vdouble low, vdouble high)
{
    return (vfloat)wasm_i64x2_shuffle(wasm_f32x4_demote_f64x2_zero((v128_t)low),
                                      wasm_f32x4_demote_f64x2_zero((v128_t)high), 0, 2);
}
CGT_SPU_INLINE vdouble spux_double_sqrt(vdouble a) { return (vdouble)wasm_f64x2_sqrt((v128_t)a); }
#else
CGT_SPU_INLINE vdouble spux_double_sum(const float *a, float b)
{
    return (vdouble){(double)(a[0] + b), (double)(a[1] + b)};
}
CGT_SPU_INLINE vdouble spux_double_low(vfloat a) { return (vdouble){(double)a[0], (double)a[1]}; }
CGT_SPU_INLINE vdouble spux_double_high(vfloat a) { return (vdouble){(double)a[2], (double)a[3]}; }
CGT_SPU_INLINE vfloat spux_float_of(vdouble low, vdouble high)
{
    return (vfloat){(float)low[0], (float)low[1], (float)high[0], (float)high[1]};
}
#if defined(__SPU__) && !defined(CGT_SPU_HOST)
/* The root of newlib is a unit off now and then. In units of the last place let s be the computed root, m as an
 * integer. The exact root rounds to m + 1 where a is above (m + 1/2)^2, and since a is an integer of those units
 * squared that is where r = a - m^2 is above m; likewise it rounds to m - 1 where r is at most -m. Below a power of two
 * the unit is half, and the same holds in it. r is exact, since it is rounded once; so are the products, by powers of
 * two, as long as nothing underflows: for a of at least 2^-900. */
CGT_SPU_INLINE double cgt_spux_round_root(double a, double s)
{
    const vec_double2 root = spu_promote(s, 0);
    const double r = spu_extract(spu_nmsub(root, root, spu_promote(a, 0)), 0);
    const vec_ullong2 bits = (vec_ullong2)root;
    const double above = spu_extract((vec_double2)(bits + 1), 0), below = spu_extract((vec_double2)(bits - 1), 0);
    return !(s > 0) ? s : r > s * (above - s) ? above : r <= s * (below - s) ? below : s;
}
CGT_SPU_INLINE vdouble spux_double_sqrt(vdouble a)
{
    return (vdouble){cgt_spux_round_root(a[0], __builtin_sqrt(a[0])), cgt_spux_round_root(a[1], __builtin_sqrt(a[1]))};
}
#else
CGT_SPU_INLINE vdouble spux_double_sqrt(vdouble a) { return (vdouble){__builtin_sqrt(a[0]), __builtin_sqrt(a[1])}; }
#endif
#endif

#if CGT_LANES != 16
CGT_SPU_INLINE vfloat spux_float_where(vdouble low, vdouble high, vmask m)
{
    return spux_select(spux_vfloat(0), spux_float_of(low, high), m);
}
#endif

CGT_SPU_INLINE vdouble spux_double_abs(vdouble a)
{
    return (vdouble)((cgt_spux_long_w)a & ~(cgt_spux_long_w)spux_vdouble(-0.));
}
CGT_SPU_INLINE vdouble spux_double_select(vdouble a, vdouble b, vdouble x)
{
    const cgt_spux_long_w m = (cgt_spux_long_w)(x > spux_vdouble(0));
    return (vdouble)(((cgt_spux_long_w)a & ~m) | ((cgt_spux_long_w)b & m));
}

CGT_SPU_INLINE vdouble spux_double_add_square(vdouble s, vdouble a)
{
#if CGT_LANES == 16
    return (vdouble)_mm512_fmadd_pd((__m512d)a, (__m512d)a, (__m512d)s);
#elif CGT_LANES == 8
    return (vdouble)_mm256_fmadd_pd((__m256d)a, (__m256d)a, (__m256d)s);
#else
    return s + a * a;
#endif
}

#if CGT_LANES == 16
/* 8 vectors of 8. Masked forms, since gcc 12 warns of undefined values in the others. */
CGT_SPU_INLINE void cgt_spux_double_transpose(__m512d r[8])
{
    __m512d p[8], q[8];
    for (int k = 0; k < 8; k += 2) {
        p[k] = _mm512_maskz_unpacklo_pd(0xff, r[k], r[k + 1]);
        p[k + 1] = _mm512_maskz_unpackhi_pd(0xff, r[k], r[k + 1]);
    }
    for (int k = 0; k < 8; k += 4)
        for (int j = 0; j < 2; j++) {
            q[k + j] = _mm512_maskz_shuffle_f64x2(0xff, p[k + j], p[k + j + 2], 0x88);
            q[k + j + 2] = _mm512_maskz_shuffle_f64x2(0xff, p[k + j], p[k + j + 2], 0xdd);
        }
    for (int k = 0; k < 4; k++) {
        r[k] = _mm512_maskz_shuffle_f64x2(0xff, q[k], q[k + 4], 0x88);
        r[k + 4] = _mm512_maskz_shuffle_f64x2(0xff, q[k], q[k + 4], 0xdd);
    }
}
CGT_SPU_INLINE void spux_double_load8_at(const double *base, const uint32_t at[8], vdouble d[8])
{
    __m512d r[8];
    for (int k = 0; k < 8; k++)
        r[k] = _mm512_loadu_pd(base + at[k]);
    cgt_spux_double_transpose(r);
    for (int k = 0; k < 8; k++)
        d[k] = (vdouble)r[k];
}
CGT_SPU_INLINE void spux_double_store8(double *base, size_t stride, const vdouble d[8])
{
    __m512d r[8];
    for (int k = 0; k < 8; k++)
        r[k] = (__m512d)d[k];
    cgt_spux_double_transpose(r);
    for (int k = 0; k < 8; k++)
        _mm512_storeu_pd(base + (size_t)k * stride, r[k]);
}
#else
#if CGT_LANES == 8
/* 4 vectors of 4. */
CGT_SPU_INLINE void cgt_spux_double_transpose(__m256d r[4])
{
    const __m256d p0 = _mm256_unpacklo_pd(r[0], r[1]), p1 = _mm256_unpackhi_pd(r[0], r[1]);
    const __m256d p2 = _mm256_unpacklo_pd(r[2], r[3]), p3 = _mm256_unpackhi_pd(r[2], r[3]);
    r[0] = _mm256_permute2f128_pd(p0, p2, 0x20);
    r[1] = _mm256_permute2f128_pd(p1, p3, 0x20);
    r[2] = _mm256_permute2f128_pd(p0, p2, 0x31);
    r[3] = _mm256_permute2f128_pd(p1, p3, 0x31);
}
CGT_SPU_INLINE void cgt_spux_double_load4_at(const double *base, const uint32_t at[4], vdouble d[4])
{
    __m256d r[4];
    for (int k = 0; k < 4; k++)
        r[k] = _mm256_loadu_pd(base + at[k]);
    cgt_spux_double_transpose(r);
    for (int k = 0; k < 4; k++)
        d[k] = (vdouble)r[k];
}
CGT_SPU_INLINE void cgt_spux_double_store4(double *base, size_t stride, const vdouble d[4])
{
    __m256d r[4];
    for (int k = 0; k < 4; k++)
        r[k] = (__m256d)d[k];
    cgt_spux_double_transpose(r);
    for (int k = 0; k < 4; k++)
        _mm256_storeu_pd(base + (size_t)k * stride, r[k]);
}
#else
CGT_SPU_INLINE void cgt_spux_double_load4_at(const double *base, const uint32_t at[2], vdouble d[4])
{
    for (int i = 0; i < 4; i++)
        d[i] = (vdouble){base[at[0] + (uint32_t)i], base[at[1] + (uint32_t)i]};
}
CGT_SPU_INLINE void cgt_spux_double_store4(double *base, size_t stride, const vdouble d[4])
{
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < 4; i++)
            base[k * stride + i] = d[i][k];
}
#endif
CGT_SPU_INLINE void spux_double_load8_at(const double *base, const uint32_t at[CGT_DOUBLES], vdouble d[8])
{
    cgt_spux_double_load4_at(base, at, d);
    cgt_spux_double_load4_at(base + 4, at, d + 4);
}
CGT_SPU_INLINE void spux_double_store8(double *base, size_t stride, const vdouble d[8])
{
    cgt_spux_double_store4(base, stride, d);
    cgt_spux_double_store4(base + 4, stride, d + 4);
}
#endif

#if CGT_LANES == 16
CGT_SPU_INLINE vmask spux_double_cmpgt(const vdouble a[2], const vdouble b[2])
{
    return (vmask){_mm512_kunpackb(_mm512_cmp_pd_mask((__m512d)a[1], (__m512d)b[1], _CMP_GT_OQ),
                                   _mm512_cmp_pd_mask((__m512d)a[0], (__m512d)b[0], _CMP_GT_OQ))};
}
CGT_SPU_INLINE vmask spux_double_above0(vdouble low, vdouble high)
{
    const vdouble a[2] = {low, high}, zero[2] = {spux_vdouble(0), spux_vdouble(0)};
    return spux_double_cmpgt(a, zero);
}
#else
CGT_SPU_INLINE vmask spux_double_cmpgt(const vdouble a[2], const vdouble b[2])
{
#if CGT_LANES == 8
    const __m256 low = _mm256_castpd_ps(_mm256_cmp_pd((__m256d)a[0], (__m256d)b[0], _CMP_GT_OQ)),
                 high = _mm256_castpd_ps(_mm256_cmp_pd((__m256d)a[1], (__m256d)b[1], _CMP_GT_OQ));
    return (vmask)_mm256_permute4x64_epi64(_mm256_castps_si256(_mm256_shuffle_ps(low, high, 0x88)), 0xd8);
#else
    const cgt_spux_long_w low = (cgt_spux_long_w)(a[0] > b[0]), high = (cgt_spux_long_w)(a[1] > b[1]);
    return (vmask){(uint32_t)low[0], (uint32_t)low[1], (uint32_t)high[0], (uint32_t)high[1]};
#endif
}
CGT_SPU_INLINE vmask spux_double_above0(vdouble low, vdouble high)
{
    return spu_cmpgt(spux_float_of(low, high), spux_vfloat(0));
}
#endif

#endif
