/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vectors of doubles, half as many as a vfloat has lanes, for what is computed once per hit. Arithmetic is that of C's
 * operators, which no variant fuses: the same bits at every width.
 *
 *   spux_double_low, high(a)       the first and the other half of a vfloat's lanes, exactly
 *   spux_float_of(low, high)       the reverse, rounded to nearest
 *   spux_vdouble(x)                x in every lane
 *   spux_double_sqrt(a)            correctly rounded
 *   spux_double_abs(a)
 *   spux_double_select(a, b, x)    b where x is above 0, else a
 *   spux_double_above0(low, high)  the vmask of what is above 0; where it is so small that a float of it is 0,
 *                                  either way */
#ifndef CGT_SPUX_DOUBLE_H
#define CGT_SPUX_DOUBLE_H

#include "vector.h"

#define CGT_DOUBLES (CGT_LANES / 2)

typedef double vdouble __attribute__((vector_size(4 * CGT_LANES)));
typedef int64_t cgt_spux_long_w __attribute__((vector_size(4 * CGT_LANES)));

CGT_SPU_INLINE vdouble spux_vdouble(double x) { return x - (vdouble){0}; }

#if CGT_LANES == 16
CGT_SPU_INLINE vdouble spux_double_low(vfloat a) { return (vdouble)_mm512_cvtps_pd(cgt_spux_half_w(a, 0)); }
CGT_SPU_INLINE vdouble spux_double_high(vfloat a) { return (vdouble)_mm512_cvtps_pd(cgt_spux_half_w(a, 1)); }
CGT_SPU_INLINE vfloat spux_float_of(vdouble low, vdouble high)
{
    const __m256 l = _mm512_cvtpd_ps((__m512d)low), h = _mm512_cvtpd_ps((__m512d)high);
    return (vfloat)_mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_castps_pd(l)), _mm256_castps_pd(h), 1);
}
CGT_SPU_INLINE vdouble spux_double_sqrt(vdouble a) { return (vdouble)_mm512_sqrt_pd((__m512d)a); }
#elif CGT_LANES == 8
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
#else
CGT_SPU_INLINE vdouble spux_double_low(vfloat a) { return (vdouble){(double)a[0], (double)a[1]}; }
CGT_SPU_INLINE vdouble spux_double_high(vfloat a) { return (vdouble){(double)a[2], (double)a[3]}; }
CGT_SPU_INLINE vfloat spux_float_of(vdouble low, vdouble high)
{
    return (vfloat){(float)low[0], (float)low[1], (float)high[0], (float)high[1]};
}
CGT_SPU_INLINE vdouble spux_double_sqrt(vdouble a) { return (vdouble){__builtin_sqrt(a[0]), __builtin_sqrt(a[1])}; }
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

#if CGT_LANES == 16
CGT_SPU_INLINE vmask spux_double_above0(vdouble low, vdouble high)
{
    const __m512d zero = _mm512_setzero_pd();
    return (vmask){_mm512_kunpackb(_mm512_cmp_pd_mask((__m512d)high, zero, _CMP_GT_OQ),
                                   _mm512_cmp_pd_mask((__m512d)low, zero, _CMP_GT_OQ))};
}
#else
CGT_SPU_INLINE vmask spux_double_above0(vdouble low, vdouble high)
{
    return spu_cmpgt(spux_float_of(low, high), spux_vfloat(0));
}
#endif

#endif
