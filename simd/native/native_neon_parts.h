/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: types and helpers shared by the forms of
 * native_neon.h. */
#ifndef CGT_NATIVE_NEON_PARTS_H
#define CGT_NATIVE_NEON_PARTS_H

typedef uint8x16_t SIMD_TYPE_u8;
typedef int8x16_t SIMD_TYPE_s8;
typedef uint16x8_t SIMD_TYPE_u16;
typedef int16x8_t SIMD_TYPE_s16;
typedef uint32x4_t SIMD_TYPE_u32;
typedef int32x4_t SIMD_TYPE_s32;
typedef uint64x2_t SIMD_TYPE_u64;
typedef int64x2_t SIMD_TYPE_s64;
typedef float32x4_t SIMD_TYPE_f32;
typedef float64x2_t SIMD_TYPE_f64;

/* Indices of a table look-up: sixteen bytes from simd_bytes + 16 + n on move
 * the elements n bytes towards element 0, from simd_bytes + 16 - n on the other
 * way; from simd_around + n on they rotate. */
#define OUT 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255
#define IN 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
static const unsigned char simd_bytes[48] = {OUT, IN, OUT}, simd_around[32] = {IN, IN};

static inline uint8x16_t simd_towards(uint8x16_t a, int n) { return vqtbl1q_u8(a, vld1q_u8(simd_bytes + 16 + n)); }
static inline uint8x16_t simd_around_by(uint8x16_t a, int n) { return vqtbl1q_u8(a, vld1q_u8(simd_around + n)); }
static inline uint8x16_t simd_shuffle(uint8x16_t a, uint8x16_t b, uint8x16_t c)
{
    const uint8x16x2_t table = {{a, b}};
    return vqtbl2q_u8(table, c);
}

/* ---- carries ---- */

static inline uint32x4_t simd_genc(uint32x4_t a, uint32x4_t b)
{
    return vshrq_n_u32(vcgtq_u32(a, vaddq_u32(a, b)), 31);
}
static inline uint32x4_t simd_genb(uint32x4_t a, uint32x4_t b) { return vshrq_n_u32(vcgeq_u32(a, b), 31); }
static inline uint32x4_t simd_genbx(uint32x4_t a, uint32x4_t b, uint32x4_t c)
{
    const uint32x4_t equal = vandq_u32(vceqq_u32(a, b), c);
    return vandq_u32(vorrq_u32(vcgtq_u32(a, b), equal), vdupq_n_u32(1));
}
static inline uint32x4_t simd_gencx(uint32x4_t a, uint32x4_t b, uint32x4_t c) { return simd_genbx(b, vmvnq_u32(a), c); }

/* ---- the quadword by bits: each element takes the bits shifted out of the next
 * or the previous one ---- */

#define SIMD_QUAD_BITS(bits, lanes)                                                                                    \
    static inline uint##bits##x##lanes##_t simd_slqw##bits(uint##bits##x##lanes##_t a, int n)                          \
    {                                                                                                                  \
        const uint##bits##x##lanes##_t next = vextq_u##bits(a, vdupq_n_u##bits(0), 1);                                 \
        return vorrq_u##bits(vshlq_u##bits(a, vdupq_n_s##bits((int##bits##_t)n)),                                      \
                             vshlq_u##bits(next, vdupq_n_s##bits((int##bits##_t)(n - bits))));                         \
    }                                                                                                                  \
    static inline uint##bits##x##lanes##_t simd_srqw##bits(uint##bits##x##lanes##_t a, int n)                          \
    {                                                                                                                  \
        const uint##bits##x##lanes##_t before = vextq_u##bits(vdupq_n_u##bits(0), a, lanes - 1);                       \
        return vorrq_u##bits(vshlq_u##bits(a, vdupq_n_s##bits((int##bits##_t) - n)),                                   \
                             vshlq_u##bits(before, vdupq_n_s##bits((int##bits##_t)(bits - n))));                       \
    }                                                                                                                  \
    static inline uint##bits##x##lanes##_t simd_rlqw##bits(uint##bits##x##lanes##_t a, int n)                          \
    {                                                                                                                  \
        const uint##bits##x##lanes##_t next = vextq_u##bits(a, a, 1);                                                  \
        return vorrq_u##bits(vshlq_u##bits(a, vdupq_n_s##bits((int##bits##_t)n)),                                      \
                             vshlq_u##bits(next, vdupq_n_s##bits((int##bits##_t)(n - bits))));                         \
    }
SIMD_QUAD_BITS(8, 16)
SIMD_QUAD_BITS(16, 8)
SIMD_QUAD_BITS(32, 4)
SIMD_QUAD_BITS(64, 2)

/* ---- masks from bits ---- */

static inline uint8x16_t simd_maskb(unsigned a)
{
    static const unsigned char bit[16] = {128, 64, 32, 16, 8, 4, 2, 1, 128, 64, 32, 16, 8, 4, 2, 1};
    return vtstq_u8(vcombine_u8(vdup_n_u8((unsigned char)(a >> 8)), vdup_n_u8((unsigned char)a)), vld1q_u8(bit));
}
static inline uint16x8_t simd_maskh(unsigned a)
{
    static const unsigned short bit[8] = {128, 64, 32, 16, 8, 4, 2, 1};
    return vtstq_u16(vdupq_n_u16((unsigned short)a), vld1q_u16(bit));
}
static inline uint32x4_t simd_maskw(unsigned a)
{
    static const unsigned bit[4] = {8, 4, 2, 1};
    return vtstq_u32(vdupq_n_u32(a), vld1q_u32(bit));
}

/* ---- products of halfwords: the even one is the lower half of its word ----
 */

#define ODD_S16(a) vshrn_n_s32(vreinterpretq_s32_s16(a), 16)
#define ODD_U16(a) vshrn_n_u32(vreinterpretq_u32_u16(a), 16)
#define EVEN_S16(a) vmovn_s32(vreinterpretq_s32_s16(a))
#define EVEN_U16(a) vmovn_u32(vreinterpretq_u32_u16(a))

/* classes: all but finite numbers */
static inline uint64x2_t simd_not_finite(float64x2_t a)
{
    const uint64x2_t bits = vreinterpretq_u64_f64(vabsq_f64(a));
    return vcgeq_u64(bits, vdupq_n_u64(0x7ff0000000000000u));
}

#endif
