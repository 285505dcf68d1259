/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: hand-written forms for AArch64 NEON. bench/simd/simd_native.c explains the lines and includes this
 * file twice. */

/* clang-format off */

#define AS_U8(t, a) vreinterpretq_u8_##t(a)
#define OF_U8(t, a) vreinterpretq_##t##_u8(a)
/* for all types; t stands for the type's name */
#define INTS(EACH) EACH(u8) EACH(s8) EACH(u16) EACH(s16) EACH(u32) EACH(s32)
#define FLOATS_TOO(EACH) EACH(u64) EACH(s64) EACH(f32) EACH(f64)

/* ---- scalars ---- */

#define EACH(t) N1(SAME, spu_splats, t, x_##t, vdupq_n_##t(a))
INTS(EACH) FLOATS_TOO(EACH)
#undef EACH
/* a literal position is 1 */
#define EACH(t) K2(SAME, spu_extract, x_##t, t, x_s32, vgetq_lane_##t(a, 1))
INTS(EACH) FLOATS_TOO(EACH)
#undef EACH
#define EACH(t) K3(SAME, spu_insert, t, x_##t, t, x_s32, vsetq_lane_##t(a, b, 1))
INTS(EACH) FLOATS_TOO(EACH)
#undef EACH
#define EACH(t)                                                                                                        \
    V2(SAME, spu_promote, t, x_##t, x_s32, vdupq_n_##t(a)) K2(SAME, spu_promote, t, x_##t, x_s32, vdupq_n_##t(a))
INTS(EACH) FLOATS_TOO(EACH)
#undef EACH
V2(SAME, spu_extract, x_u8, u8, x_s32, vgetq_lane_u8(simd_towards(a, b), 0))
V2(SAME, spu_extract, x_s8, s8, x_s32, vgetq_lane_s8(OF_U8(s8, simd_towards(AS_U8(s8, a), b)), 0))
V2(SAME, spu_extract, x_u16, u16, x_s32, vgetq_lane_u16(OF_U8(u16, simd_towards(AS_U8(u16, a), 2 * b)), 0))
V2(SAME, spu_extract, x_s16, s16, x_s32, vgetq_lane_s16(OF_U8(s16, simd_towards(AS_U8(s16, a), 2 * b)), 0))
V2(SAME, spu_extract, x_u32, u32, x_s32, vgetq_lane_u32(OF_U8(u32, simd_towards(AS_U8(u32, a), 4 * b)), 0))
V2(SAME, spu_extract, x_s32, s32, x_s32, vgetq_lane_s32(OF_U8(s32, simd_towards(AS_U8(s32, a), 4 * b)), 0))
V2(SAME, spu_extract, x_u64, u64, x_s32, vgetq_lane_u64(OF_U8(u64, simd_towards(AS_U8(u64, a), 8 * b)), 0))
V2(SAME, spu_extract, x_s64, s64, x_s32, vgetq_lane_s64(OF_U8(s64, simd_towards(AS_U8(s64, a), 8 * b)), 0))
V2(SAME, spu_extract, x_f32, f32, x_s32, vgetq_lane_f32(OF_U8(f32, simd_towards(AS_U8(f32, a), 4 * b)), 0))
V2(SAME, spu_extract, x_f64, f64, x_s32, vgetq_lane_f64(OF_U8(f64, simd_towards(AS_U8(f64, a), 8 * b)), 0))

/* ---- conversion; by a scale of 8 ---- */

N2(SAME, spu_convtf, f32, s32, n_scale, vcvtq_n_f32_s32(a, 8))
N2(SAME, spu_convtf, f32, u32, n_scale, vcvtq_n_f32_u32(a, 8))
N2(SAME, spu_convts, s32, f32, n_scale, vcvtq_n_s32_f32(a, 8))
N2(SAME, spu_convtu, u32, f32, n_scale, vcvtq_n_u32_f32(a, 8))
N1(SAME, spu_extend, s16, s8, vshrq_n_s16(vreinterpretq_s16_s8(a), 8))
N1(SAME, spu_extend, s32, s16, vshrq_n_s32(vreinterpretq_s32_s16(a), 16))
N1(SAME, spu_extend, s64, s32, vshrq_n_s64(vreinterpretq_s64_s32(a), 32))
N1(SAME, spu_extend, f64, f32, vcvt_f64_f32(vget_low_f32(vuzp1q_f32(a, a))))
N1(SAME, spu_roundtf, f32, f64, vreinterpretq_f32_u64(vmovl_u32(vreinterpret_u32_f32(vcvt_f32_f64(a)))))

/* ---- arithmetic ---- */

#define EACH(t)                                                                                                        \
    N2(SAME, spu_add, t, t, t, vaddq_##t(a, b)) N2(SAME, spu_sub, t, t, t, vsubq_##t(a, b))
EACH(u16) EACH(s16) EACH(u32) EACH(s32) EACH(f32) EACH(f64)
#undef EACH
#define EACH(t)                                                                                                        \
    N2(SAME, spu_add, t, t, x_##t, vaddq_##t(a, vdupq_n_##t(b)))                                                       \
    N2(SAME, spu_sub, t, x_##t, t, vsubq_##t(vdupq_n_##t(a), b))
EACH(u16) EACH(s16) EACH(u32) EACH(s32)
#undef EACH
#define EACH(t)                                                                                                        \
    N3(SAME, spu_addx, t, t, t, t, vaddq_##t(vaddq_##t(a, b), vandq_##t(c, vdupq_n_##t(1))))                           \
    N3(SAME, spu_subx, t, t, t, t, vsubq_##t(vsubq_##t(a, b), vbicq_##t(vdupq_n_##t(1), c)))
EACH(u32) EACH(s32)
#undef EACH
#define WORDS2(word, f)                                                                                                \
    N2(SAME, word, u32, u32, u32, f(a, b))                                                                             \
    N2(SAME, word, s32, s32, s32, vreinterpretq_s32_u32(f(vreinterpretq_u32_s32(a), vreinterpretq_u32_s32(b))))
#define WORDS3(word, f)                                                                                                \
    N3(SAME, word, u32, u32, u32, u32, f(a, b, c))                                                                     \
    N3(SAME, word, s32, s32, s32, s32, vreinterpretq_s32_u32(f(vreinterpretq_u32_s32(a),                               \
        vreinterpretq_u32_s32(b), vreinterpretq_u32_s32(c))))
WORDS2(spu_genc, simd_genc)
WORDS2(spu_genb, simd_genb)
WORDS3(spu_gencx, simd_gencx)
WORDS3(spu_genbx, simd_genbx)
#undef WORDS2
#undef WORDS3
N2(SAME, spu_mul, f32, f32, f32, vmulq_f32(a, b))
N2(SAME, spu_mul, f64, f64, f64, vmulq_f64(a, b))
N3(SAME, spu_madd, f32, f32, f32, f32, vfmaq_f32(c, a, b))
N3(SAME, spu_madd, f64, f64, f64, f64, vfmaq_f64(c, a, b))
N3(SAME, spu_msub, f32, f32, f32, f32, vfmaq_f32(vnegq_f32(c), a, b))
N3(SAME, spu_msub, f64, f64, f64, f64, vfmaq_f64(vnegq_f64(c), a, b))
N3(SAME, spu_nmsub, f32, f32, f32, f32, vfmsq_f32(c, a, b))
N3(SAME, spu_nmsub, f64, f64, f64, f64, vfmsq_f64(c, a, b))
N3(SAME, spu_nmadd, f64, f64, f64, f64, vnegq_f64(vfmaq_f64(c, a, b)))
N3(SAME, spu_madd, s32, s16, s16, s32, vmlal_s16(c, ODD_S16(a), ODD_S16(b)))
N3(SAME, spu_mhhadd, s32, s16, s16, s32, vmlal_s16(c, EVEN_S16(a), EVEN_S16(b)))
N3(SAME, spu_mhhadd, u32, u16, u16, u32, vmlal_u16(c, EVEN_U16(a), EVEN_U16(b)))
N2(SAME, spu_mule, s32, s16, s16, vmull_s16(EVEN_S16(a), EVEN_S16(b)))
N2(SAME, spu_mule, u32, u16, u16, vmull_u16(EVEN_U16(a), EVEN_U16(b)))
N2(SAME, spu_mulo, s32, s16, s16, vmull_s16(ODD_S16(a), ODD_S16(b)))
N2(SAME, spu_mulo, u32, u16, u16, vmull_u16(ODD_U16(a), ODD_U16(b)))
N2(SAME, spu_mulo, s32, s16, x_s16, vmull_n_s16(ODD_S16(a), b))
N2(SAME, spu_mulo, u32, u16, x_u16, vmull_n_u16(ODD_U16(a), b))
N2(SAME, spu_mulh, s32, s16, s16, vshll_n_s16(vmul_s16(EVEN_S16(a), ODD_S16(b)), 16))
N2(SAME, spu_mulsr, s32, s16, s16, vshrq_n_s32(vmull_s16(ODD_S16(a), ODD_S16(b)), 16))
/* estimates: of eight bits */
N1(OTHER, spu_re, f32, f32, vrecpeq_f32(a))
N1(OTHER, spu_rsqrte, f32, f32, vrsqrteq_f32(a))

/* ---- bytes ---- */

N2(SAME, spu_absd, u8, u8, u8, vabdq_u8(a, b))
N2(SAME, spu_avg, u8, u8, u8, vrhaddq_u8(a, b))
N2(SAME, spu_sumb, u16, u8, u8, vreinterpretq_u16_u32(vsliq_n_u32(vpaddlq_u16(vpaddlq_u8(b)),
    vpaddlq_u16(vpaddlq_u8(a)), 16)))

/* ---- comparison ---- */

#define EACH(t, m)                                                                                                     \
    N2(SAME, spu_cmpeq, m, t, t, vceqq_##t(a, b)) N2(SAME, spu_cmpgt, m, t, t, vcgtq_##t(a, b))
EACH(u8, u8) EACH(s8, u8) EACH(u16, u16) EACH(s16, u16) EACH(u32, u32) EACH(s32, u32) EACH(f32, u32) EACH(f64, u64)
#undef EACH
#define EACH(t, m)                                                                                                     \
    N2(SAME, spu_cmpeq, m, t, x_##t, vceqq_##t(a, vdupq_n_##t(b)))                                                     \
    N2(SAME, spu_cmpgt, m, t, x_##t, vcgtq_##t(a, vdupq_n_##t(b)))
EACH(u8, u8) EACH(s8, u8) EACH(u16, u16) EACH(s16, u16) EACH(u32, u32) EACH(s32, u32)
#undef EACH
N2(SAME, spu_cmpabseq, u32, f32, f32, vceqq_f32(vabsq_f32(a), vabsq_f32(b)))
N2(SAME, spu_cmpabseq, u64, f64, f64, vceqq_f64(vabsq_f64(a), vabsq_f64(b)))
N2(SAME, spu_cmpabsgt, u32, f32, f32, vcagtq_f32(a, b))
N2(SAME, spu_cmpabsgt, u64, f64, f64, vcagtq_f64(a, b))
N2(SAME, spu_testsv, u64, f64, n_special, simd_not_finite(a))

/* ---- bits and masks ---- */

N1(SAME, spu_cntb, u8, u8, vcntq_u8(a))
N1(SAME, spu_cntb, u8, s8, vcntq_u8(vreinterpretq_u8_s8(a)))
N1(SAME, spu_cntlz, u32, u32, vclzq_u32(a))
N1(SAME, spu_cntlz, u32, s32, vclzq_u32(vreinterpretq_u32_s32(a)))
N1(SAME, spu_cntlz, u32, f32, vclzq_u32(vreinterpretq_u32_f32(a)))
/* of a comparison's result, element 0 lowest, as a scalar; of bytes four bits each */
N1(OTHER, spu_gather, x_u64, u8, vget_lane_u64(vreinterpret_u64_u8(vshrn_n_u16(vreinterpretq_u16_u8(a), 4)), 0))
N1(OTHER, spu_gather, x_u64, s8, vget_lane_u64(vreinterpret_u64_u8(vshrn_n_u16(vreinterpretq_u16_s8(a), 4)), 0))
N1(OTHER, spu_gather, x_u32, u16, vaddvq_u16(vandq_u16(a, ((const uint16x8_t){1, 2, 4, 8, 16, 32, 64, 128}))))
N1(OTHER, spu_gather, x_u32, s16, vaddvq_u16(vandq_u16(vreinterpretq_u16_s16(a), ((const uint16x8_t){1, 2, 4,
    8, 16, 32, 64, 128}))))
N1(OTHER, spu_gather, x_u32, u32, vaddvq_u32(vandq_u32(a, ((const uint32x4_t){1, 2, 4, 8}))))
N1(OTHER, spu_gather, x_u32, s32, vaddvq_u32(vandq_u32(vreinterpretq_u32_s32(a), ((const uint32x4_t){1, 2, 4, 8}))))
N1(OTHER, spu_gather, x_u32, f32, vaddvq_u32(vandq_u32(vreinterpretq_u32_f32(a), ((const uint32x4_t){1, 2, 4, 8}))))
#define MASK(word, R, function)                                                                                        \
    N1(SAME, word, R, x_u16, function(a)) N1(SAME, word, R, x_s16, function((unsigned)a))                              \
    N1(SAME, word, R, x_u32, function(a)) N1(SAME, word, R, x_s32, function((unsigned)a))
MASK(spu_maskb, u8, simd_maskb)
MASK(spu_maskh, u16, simd_maskh)
MASK(spu_maskw, u32, simd_maskw)
#undef MASK
N1(SAME, spu_maskh, u16, x_u8, simd_maskh(a))
N1(SAME, spu_maskh, u16, x_s8, simd_maskh((unsigned)a))
N1(SAME, spu_maskw, u32, x_u8, simd_maskw(a))
N1(SAME, spu_maskw, u32, x_s8, simd_maskw((unsigned)a))
#define EACH(t, m) N3(SAME, spu_sel, t, t, t, m, vbslq_##t(c, b, a))
EACH(u8, u8) EACH(s8, u8) EACH(u16, u16) EACH(s16, u16) EACH(u32, u32) EACH(s32, u32) EACH(u64, u64) EACH(s64, u64)
EACH(f32, u32) EACH(f64, u64)
#undef EACH
/* a pattern of the host's own bytes, without constants */
V3(SAME, spu_shuffle, u8, u8, u8, u8, simd_shuffle(a, b, c))
V3(SAME, spu_shuffle, s8, s8, s8, u8, OF_U8(s8, simd_shuffle(AS_U8(s8, a), AS_U8(s8, b), c)))
#define EACH(t) V3(OTHER, spu_shuffle, t, t, t, u8, OF_U8(t, simd_shuffle(AS_U8(t, a), AS_U8(t, b), c)))
EACH(u16) EACH(s16) EACH(u32) EACH(s32) EACH(u64) EACH(s64) EACH(f32) EACH(f64)
#undef EACH
/* the literal pattern: a0 b0 a1 b1 in words, a0 b1 in doublewords */
#define EACH(t)                                                                                                        \
    K3(SAME, spu_shuffle, t, t, t, u8, vreinterpretq_##t##_u32(vzip1q_u32(vreinterpretq_u32_##t(a),                    \
        vreinterpretq_u32_##t(b))))
EACH(u8) EACH(s8) EACH(u16) EACH(s16) EACH(s32)
#undef EACH
K3(SAME, spu_shuffle, u32, u32, u32, u8, vzip1q_u32(a, b))
K3(SAME, spu_shuffle, f32, f32, f32, u8, vzip1q_f32(a, b))
K3(SAME, spu_shuffle, u64, u64, u64, u8, vcombine_u64(vget_low_u64(a), vget_high_u64(b)))
K3(SAME, spu_shuffle, s64, s64, s64, u8, vcombine_s64(vget_low_s64(a), vget_high_s64(b)))
K3(SAME, spu_shuffle, f64, f64, f64, u8, vcombine_f64(vget_low_f64(a), vget_high_f64(b)))

/* ---- logic ---- */

#define LOGIC(t)                                                                                                       \
    N2(SAME, spu_and, t, t, t, vandq_##t(a, b)) N2(SAME, spu_or, t, t, t, vorrq_##t(a, b))                             \
    N2(SAME, spu_xor, t, t, t, veorq_##t(a, b)) N2(SAME, spu_andc, t, t, t, vbicq_##t(a, b))                           \
    N2(SAME, spu_orc, t, t, t, vornq_##t(a, b))
LOGIC(u8) LOGIC(s8) LOGIC(u16) LOGIC(s16) LOGIC(u32) LOGIC(s32) LOGIC(u64) LOGIC(s64)
#undef LOGIC
#define LOGIC(t)                                                                                                       \
    N2(SAME, spu_nand, t, t, t, vmvnq_##t(vandq_##t(a, b))) N2(SAME, spu_nor, t, t, t, vmvnq_##t(vorrq_##t(a, b)))     \
    N2(SAME, spu_eqv, t, t, t, vmvnq_##t(veorq_##t(a, b)))                                                             \
    N2(SAME, spu_and, t, t, x_##t, vandq_##t(a, vdupq_n_##t(b)))                                                       \
    N2(SAME, spu_or, t, t, x_##t, vorrq_##t(a, vdupq_n_##t(b)))                                                        \
    N2(SAME, spu_xor, t, t, x_##t, veorq_##t(a, vdupq_n_##t(b)))
LOGIC(u8) LOGIC(s8) LOGIC(u16) LOGIC(s16) LOGIC(u32) LOGIC(s32)
#undef LOGIC
/* through words */
#define LOGIC(word, t, expression)                                                                                     \
    N2(SAME, word, t, t, t, vreinterpretq_##t##_u32(expression(vreinterpretq_u32_##t(a), vreinterpretq_u32_##t(b))))
#define NAND(a, b) vmvnq_u32(vandq_u32(a, b))
#define NOR4(a, b) vmvnq_u32(vorrq_u32(a, b))
#define EQV(a, b) vmvnq_u32(veorq_u32(a, b))
#define EACH(t) LOGIC(spu_nand, t, NAND) LOGIC(spu_nor, t, NOR4) LOGIC(spu_eqv, t, EQV)
EACH(u64) EACH(s64) EACH(f32) EACH(f64)
#undef EACH
#define EACH(t)                                                                                                        \
    LOGIC(spu_and, t, vandq_u32) LOGIC(spu_or, t, vorrq_u32) LOGIC(spu_xor, t, veorq_u32)                              \
    LOGIC(spu_andc, t, vbicq_u32)                                                                                      \
    LOGIC(spu_orc, t, vornq_u32)
EACH(f32) EACH(f64)
#undef EACH
#undef LOGIC
#undef NAND
#undef NOR4
#undef EQV

/* ---- shifts of elements, counts within the element; the literal count is 5 ---- */

#define SHIFTS(t, u, s, w)                                                                                             \
    V2(SAME, spu_sl, t, t, u, vshlq_##t(a, vreinterpretq_##s##_##u(b)))                                                \
    V2(SAME, spu_sl, t, t, x_u32, vshlq_##t(a, vdupq_n_##s((w)b)))                                                     \
    K2(SAME, spu_sl, t, t, x_u32, vshlq_n_##t(a, 5))
SHIFTS(u16, u16, s16, short) SHIFTS(s16, u16, s16, short) SHIFTS(u32, u32, s32, int) SHIFTS(s32, u32, s32, int)
#undef SHIFTS
/* right shifts: by the negative count; the type decides whether the sign is kept */
#define SHIFTS(word, t, k, u, s, w, to, from)                                                                          \
    V2(SAME, word, t, t, u, from(vshlq_##k(to(a), vnegq_##s(vreinterpretq_##s##_##u(b)))))                             \
    V2(SAME, word, t, t, x_u32, from(vshlq_##k(to(a), vdupq_n_##s((w)(0 - b)))))                                       \
    K2(SAME, word, t, t, x_u32, from(vshrq_n_##k(to(a), 5)))
#define MASKS(word, t, k, s, w, to, from)                                                                              \
    V2(SAME, word, t, t, s, from(vshlq_##k(to(a), b)))                                                                 \
    V2(SAME, word, t, t, x_s32, from(vshlq_##k(to(a), vdupq_n_##s((w)b))))                                             \
    K2(SAME, word, t, t, x_s32, from(vshrq_n_##k(to(a), 5)))
#define ITSELF(a) a
SHIFTS(spu_sr, u16, u16, u16, s16, short, ITSELF, ITSELF)
SHIFTS(spu_sr, s16, u16, u16, s16, short, vreinterpretq_u16_s16, vreinterpretq_s16_u16)
SHIFTS(spu_sr, u32, u32, u32, s32, int, ITSELF, ITSELF)
SHIFTS(spu_sr, s32, u32, u32, s32, int, vreinterpretq_u32_s32, vreinterpretq_s32_u32)
SHIFTS(spu_sra, u16, s16, u16, s16, short, vreinterpretq_s16_u16, vreinterpretq_u16_s16)
SHIFTS(spu_sra, s16, s16, u16, s16, short, ITSELF, ITSELF)
SHIFTS(spu_sra, u32, s32, u32, s32, int, vreinterpretq_s32_u32, vreinterpretq_u32_s32)
SHIFTS(spu_sra, s32, s32, u32, s32, int, ITSELF, ITSELF)
MASKS(spu_rlmask, u16, u16, s16, short, ITSELF, ITSELF)
MASKS(spu_rlmask, s16, u16, s16, short, vreinterpretq_u16_s16, vreinterpretq_s16_u16)
MASKS(spu_rlmask, u32, u32, s32, int, ITSELF, ITSELF)
MASKS(spu_rlmask, s32, u32, s32, int, vreinterpretq_u32_s32, vreinterpretq_s32_u32)
MASKS(spu_rlmaska, u16, s16, s16, short, vreinterpretq_s16_u16, vreinterpretq_u16_s16)
MASKS(spu_rlmaska, s16, s16, s16, short, ITSELF, ITSELF)
MASKS(spu_rlmaska, u32, s32, s32, int, vreinterpretq_s32_u32, vreinterpretq_u32_s32)
MASKS(spu_rlmaska, s32, s32, s32, int, ITSELF, ITSELF)
#undef SHIFTS
#undef MASKS
#define ROTATE(t, s, w, x, bits, u, to, from)                                                                          \
    V2(SAME, spu_rl, t, t, s, from(vorrq_##u(vshlq_##u(to(a), b), vshlq_##u(to(a), vsubq_##s(b, vdupq_n_##s(bits)))))) \
    V2(SAME, spu_rl, t, t, x, from(vorrq_##u(vshlq_##u(to(a), vdupq_n_##s(b)), vshlq_##u(to(a),                        \
        vdupq_n_##s((w)(b - bits))))))                                                                                 \
    K2(SAME, spu_rl, t, t, x, from(vsliq_n_##u(vshrq_n_##u(to(a), bits - 5), to(a), 5)))
ROTATE(u16, s16, short, x_s16, 16, u16, ITSELF, ITSELF)
ROTATE(s16, s16, short, x_s16, 16, u16, vreinterpretq_u16_s16, vreinterpretq_s16_u16)
ROTATE(u32, s32, int, x_s32, 32, u32, ITSELF, ITSELF)
ROTATE(s32, s32, int, x_s32, 32, u32, vreinterpretq_u32_s32, vreinterpretq_s32_u32)
#undef ROTATE
#undef ITSELF

/* ---- shifts of the quadword ---- */

/* by bits; the literal count is 3 */
#define EACH(word, f, t, u, K, count)                                                                                  \
    V2(SAME, word, t, t, K, vreinterpretq_##t##_##u(f(vreinterpretq_##u##_##t(a), count)))                             \
    K2(SAME, word, t, t, K, vreinterpretq_##t##_##u(f(vreinterpretq_##u##_##t(a), 3)))
#define BITS(word, function, K, count)                                                                                 \
    V2(SAME, word, u8, u8, K, function##8(a, count)) K2(SAME, word, u8, u8, K, function##8(a, 3))                      \
    V2(SAME, word, u16, u16, K, function##16(a, count)) K2(SAME, word, u16, u16, K, function##16(a, 3))                \
    V2(SAME, word, u32, u32, K, function##32(a, count)) K2(SAME, word, u32, u32, K, function##32(a, 3))                \
    V2(SAME, word, u64, u64, K, function##64(a, count)) K2(SAME, word, u64, u64, K, function##64(a, 3))                \
    EACH(word, function##8, s8, u8, K, count) EACH(word, function##16, s16, u16, K, count)                             \
    EACH(word, function##32, s32, u32, K, count) EACH(word, function##64, s64, u64, K, count)                          \
    EACH(word, function##32, f32, u32, K, count) EACH(word, function##64, f64, u64, K, count)
BITS(spu_slqw, simd_slqw, x_u32, (int)b)
BITS(spu_srqw, simd_srqw, x_u32, (int)b)
BITS(spu_rlqw, simd_rlqw, x_s32, b)
BITS(spu_rlmaskqw, simd_srqw, x_s32, -b)
#undef BITS
#undef EACH
/* by bytes, whole elements: all types alike; the literal count is 8 */
#define BYTES(word, K, function, count, literal)                                                                       \
    V2(SAME, word, u8, u8, K, function(a, count)) K2(SAME, word, u8, u8, K, literal(a))                                \
    EACH(word, s8, K, function, count, literal) EACH(word, u16, K, function, count, literal)                           \
    EACH(word, s16, K, function, count, literal) EACH(word, u32, K, function, count, literal)                          \
    EACH(word, s32, K, function, count, literal) EACH(word, u64, K, function, count, literal)                          \
    EACH(word, s64, K, function, count, literal) EACH(word, f32, K, function, count, literal)                          \
    EACH(word, f64, K, function, count, literal)
#define EACH(word, t, K, function, count, literal)                                                                     \
    V2(SAME, word, t, t, K, OF_U8(t, function(AS_U8(t, a), count)))                                                    \
    K2(SAME, word, t, t, K, OF_U8(t, literal(AS_U8(t, a))))
#define LEFT8(a) vextq_u8(a, vdupq_n_u8(0), 8)
#define RIGHT8(a) vextq_u8(vdupq_n_u8(0), a, 8)
#define ROUND8(a) vextq_u8(a, a, 8)
BYTES(spu_slqwbyte, x_u32, simd_towards, (int)b, LEFT8)
BYTES(spu_srqwbyte, x_u32, simd_towards, -(int)b, RIGHT8)
BYTES(spu_rlqwbyte, x_s32, simd_around_by, b, ROUND8)
BYTES(spu_rlmaskqwbyte, x_s32, simd_towards, b, RIGHT8)
BYTES(spu_slqwbytebc, x_u32, simd_towards, (int)(b >> 3), LEFT8)
BYTES(spu_srqwbytebc, x_u32, simd_towards, -(int)(b >> 3), RIGHT8)
BYTES(spu_rlqwbytebc, x_s32, simd_around_by, b >> 3, ROUND8)
BYTES(spu_rlmaskqwbytebc, x_s32, simd_towards, b >> 3, RIGHT8)
#undef BYTES
#undef EACH
#undef LEFT8
#undef RIGHT8
#undef ROUND8
#undef INTS
#undef FLOATS_TOO
#undef AS_U8
#undef OF_U8

    /* clang-format on */
