/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words whose result depends on the order of elements, bytes or bits, and the ends of the conversions, on literal
 * operands. The results are worked out by hand from the definition of the SPU's instruction, given next to each, so
 * that this text and no second program is the witness. */
#include "support/test.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "spu_intrinsics.h"

#include "simd/spu_quad.h"

/* The value of a word must be the literal in braces. The literal is in memory and, next to the word, among the values
 * that the compiler handles: one that is wrong about what a word gives may take the word's register for it. */
#define EXPECT(token, type, text, call, ...)                                                                           \
    do {                                                                                                               \
        static const type expected_ = __VA_ARGS__;                                                                     \
        const type got_ = (call), adjacent_ = __VA_ARGS__;                                                             \
        check_literal(text, SPU_##token, &got_, &expected_);                                                           \
        check_literal("the literal next to " text, SPU_##token, &adjacent_, &expected_);                               \
    } while (0)
#define EXPECT_U8(call, ...) EXPECT(u8, vec_uchar16, #call, call, __VA_ARGS__)
#define EXPECT_U16(call, ...) EXPECT(u16, vec_ushort8, #call, call, __VA_ARGS__)
#define EXPECT_S16(call, ...) EXPECT(s16, vec_short8, #call, call, __VA_ARGS__)
#define EXPECT_U32(call, ...) EXPECT(u32, vec_uint4, #call, call, __VA_ARGS__)
#define EXPECT_S32(call, ...) EXPECT(s32, vec_int4, #call, call, __VA_ARGS__)
#define EXPECT_U64(call, ...) EXPECT(u64, vec_ullong2, #call, call, __VA_ARGS__)
#define EXPECT_S64(call, ...) EXPECT(s64, vec_llong2, #call, call, __VA_ARGS__)
#define EXPECT_F32(call, ...) EXPECT(f32, vec_float4, #call, call, __VA_ARGS__)
#define EXPECT_F64(call, ...) EXPECT(f64, vec_double2, #call, call, __VA_ARGS__)

static void check_literal(const char *call, spu_type type, const void *got, const void *expected)
{
    char text[48];
    if (memcmp(got, expected, 16) == 0)
        return;
    const spu_quad g = spu_from_host(got, type), e = spu_from_host(expected, type);
    print_error("%s\n    got        %s\n", call, spu_text(&g, type, 16, text));
    fail_msg("    expected   %s", spu_text(&e, type, 16, text));
}

/* The bytes 0 to 15 of a register in order, as elements of each size; and 16 to 31. */
static const vec_uchar16 bytes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
static const vec_uchar16 more_bytes = {16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
static const vec_ushort8 halves = {0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0a0b, 0x0c0d, 0x0e0f};
static const vec_ushort8 more_halves = {0x1011, 0x1213, 0x1415, 0x1617, 0x1819, 0x1a1b, 0x1c1d, 0x1e1f};
static const vec_uint4 words = {0x00010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f};
static const vec_uint4 more_words = {0x10111213, 0x14151617, 0x18191a1b, 0x1c1d1e1f};
static const vec_uint4 signed_words = {0x80010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f};
static const vec_ullong2 longs = {0x0001020304050607, 0x08090a0b0c0d0e0f};

/* ---- elements ---- */

TEST(element_0_is_the_first)
{
    const vec_float4 floats = {1, 2, 3, 4};
    const vec_double2 doubles = {1, 2};
    float memory[4];
    memcpy(memory, &floats, sizeof memory);
    assert_true(memory[0] == 1 && memory[3] == 4);
    assert_true(spu_extract(floats, 0) == 1 && spu_extract(floats, 3) == 4 && spu_extract(doubles, 1) == 2);
    assert_true(spu_extract(bytes, 0) == 0 && spu_extract(bytes, 15) == 15 && spu_extract(halves, 7) == 0x0e0f);
    assert_true(spu_extract(words, 1) == 0x04050607 && spu_extract(longs, 1) == 0x08090a0b0c0d0e0f);
    /* the index counts modulo the elements: lqx and rotqby use four bits of the byte address */
    assert_true(spu_extract(floats, 5) == 2 && spu_extract(floats, -1) == 4 && spu_extract(bytes, 18) == 2);
    EXPECT_F32(spu_insert(9.f, floats, 2), {1, 2, 9, 4});
    EXPECT_F32(spu_insert(9.f, floats, 7), {1, 2, 3, 9});
    EXPECT_U8(spu_insert((unsigned char)99, bytes, 1), {0, 99, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    EXPECT_F64(spu_insert(9., doubles, 0), {9, 2});
    assert_true(spu_extract(spu_promote(7.f, 3), 3) == 7);
    assert_true(spu_extract(spu_promote((unsigned short)7, 5), 5) == 7);
    EXPECT_U32(spu_splats(0xdeadbeefu), {0xdeadbeef, 0xdeadbeef, 0xdeadbeef, 0xdeadbeef});
    EXPECT_F32(spu_splats(-0.f), {-0.f, -0.f, -0.f, -0.f});
    EXPECT_S64(spu_splats(-2ll), {-2, -2});
}

/* ---- bits to masks and back ---- */

/* spux_cast: the bytes of a register as elements of another size, in the order of the SPU on every host */
TEST(casts_keep_the_register)
{
    EXPECT_U8(spux_cast(vec_uchar16, halves), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    EXPECT_U8(spux_cast(vec_uchar16, words), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    EXPECT_U8(spux_cast(vec_uchar16, longs), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    EXPECT_U16(spux_cast(vec_ushort8, bytes), {0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0a0b, 0x0c0d, 0x0e0f});
    EXPECT_U16(spux_cast(vec_ushort8, longs), {0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0a0b, 0x0c0d, 0x0e0f});
    EXPECT_U32(spux_cast(vec_uint4, bytes), {0x00010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f});
    EXPECT_U32(spux_cast(vec_uint4, halves), {0x00010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f});
    EXPECT_U64(spux_cast(vec_ullong2, bytes), {0x0001020304050607, 0x08090a0b0c0d0e0f});
    EXPECT_U64(spux_cast(vec_ullong2, words), {0x0001020304050607, 0x08090a0b0c0d0e0f});
    EXPECT_U32(spux_cast(vec_uint4, ((vec_double2){1, -2})), {0x3ff00000, 0, 0xc0000000, 0});
    EXPECT_F32(spux_cast(vec_float4, ((vec_ushort8){0x3f80, 0, 0xc000, 0, 0, 0, 0x8000, 0})), {1, -2, 0, -0.f});
    EXPECT_F32(spux_cast(vec_float4, ((vec_uint4){0x3f800000, 0, 0, 0})), {1, 0, 0, 0});
}

TEST(gather_takes_the_lowest_bits) /* gbb, gbh, gb */
{
    const vec_uchar16 b = {1, 0xfe, 0, 0xff, 2, 4, 8, 16, 0x80, 0x7e, 0, 0, 0, 0, 3, 0xff};
    const vec_ushort8 h = {0x0101, 0xfffe, 0x8000, 1, 0, 0, 0x00ff, 2};
    const vec_uint4 w = {0xffffffff, 0x12345678, 1, 0x80000000};
    EXPECT_U32(spu_gather(b), {0x9003, 0, 0, 0});
    EXPECT_U32(spu_gather((vec_char16)b), {0x9003, 0, 0, 0});
    EXPECT_U32(spu_gather(h), {0x92, 0, 0, 0});
    EXPECT_U32(spu_gather((vec_short8)h), {0x92, 0, 0, 0});
    EXPECT_U32(spu_gather(w), {0xa, 0, 0, 0});
    EXPECT_U32(spu_gather((vec_int4)w), {0xa, 0, 0, 0});
    EXPECT_U32(spu_gather((vec_float4)w), {0xa, 0, 0, 0});
}

TEST(mask_spreads_bits) /* fsmb, fsmh, fsm */
{
    EXPECT_U8(spu_maskb(0x9003u), {0xff, 0, 0, 0xff, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff});
    EXPECT_U8(spu_maskb(0x12348001), {0xff, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff});
    EXPECT_U16(spu_maskh((unsigned char)0x92), {0xffff, 0, 0, 0xffff, 0, 0, 0xffff, 0});
    EXPECT_U16(spu_maskh(0x7ff01), {0, 0, 0, 0, 0, 0, 0, 0xffff});
    EXPECT_U32(spu_maskw((signed char)-6), {0xffffffff, 0, 0xffffffff, 0});
    EXPECT_U32(spu_maskw((short)0x0ff4), {0, 0xffffffff, 0, 0});
    EXPECT_U32(spu_sel(words, more_words, spu_maskw(5u)), {0x00010203, 0x14151617, 0x08090a0b, 0x1c1d1e1f});
}

/* ---- bytes ---- */

TEST(shuffle_counts_bytes_from_the_left) /* shufb */
{
    const vec_uchar16 mixed = {3, 2, 1, 0, 16, 17, 31, 15, 0x80, 0xbf, 0xc0, 0xdf, 0xe0, 0xff, 0x9f, 0x60};
    const vec_uchar16 high_bits_ignored = {0x20, 0x41, 0x7f, 0x33, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    EXPECT_U8(spu_shuffle(bytes, more_bytes, mixed), {3, 2, 1, 0, 16, 17, 31, 15, 0, 0, 0xff, 0xff, 0x80, 0x80, 0, 0});
    EXPECT_U16(spu_shuffle(halves, more_halves, mixed),
               {0x0302, 0x0100, 0x1011, 0x1f0f, 0x0000, 0xffff, 0x8080, 0x0000});
    EXPECT_U32(spu_shuffle(words, more_words, mixed), {0x03020100, 0x10111f0f, 0x0000ffff, 0x80800000});
    EXPECT_U64(spu_shuffle(longs, ((vec_ullong2){0x1011121314151617, 0x18191a1b1c1d1e1f}), mixed),
               {0x0302010010111f0f, 0x0000ffff80800000});
    EXPECT_U32(spu_shuffle(words, more_words, high_bits_ignored), {0x00011f13, 0x00010203, 0x04050607, 0x08090a0b});
    /* the sign byte of each float is its first */
    EXPECT_F32(spu_shuffle(((vec_float4){1, -2, 3, -4}), ((vec_float4){5, 6, 7, 8}),
                           ((vec_uchar16){12, 13, 14, 15, 16, 17, 18, 19, 0xe0, 0x80, 0x80, 0x80, 0, 1, 2, 3})),
               {-4, 5, -0.f, 1});
    EXPECT_F64(spu_shuffle(((vec_double2){1, -2}), ((vec_double2){3, 4}),
                           ((vec_uchar16){8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23})),
               {-2, 3});
}

TEST(bytes_shift_towards_element_0) /* shlqbyi, rotqbyi, rotqmbyi */
{
    EXPECT_U32(spu_slqwbyte(words, 1), {0x01020304, 0x05060708, 0x090a0b0c, 0x0d0e0f00});
    EXPECT_U32(spu_slqwbyte(words, 5), {0x05060708, 0x090a0b0c, 0x0d0e0f00, 0});
    EXPECT_U32(spu_slqwbyte(words, 16), {0, 0, 0, 0});
    EXPECT_U32(spu_slqwbyte(words, 31), {0, 0, 0, 0});
    EXPECT_U32(spu_slqwbyte(words, 33), {0x01020304, 0x05060708, 0x090a0b0c, 0x0d0e0f00});
    EXPECT_U8(spu_slqwbyte(bytes, 14), {14, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_U16(spu_slqwbyte(halves, 3), {0x0304, 0x0506, 0x0708, 0x090a, 0x0b0c, 0x0d0e, 0x0f00, 0});
    EXPECT_U64(spu_slqwbyte(longs, 3), {0x030405060708090a, 0x0b0c0d0e0f000000});
    EXPECT_U32(spu_slqwbytebc(words, 0x2f), {0x05060708, 0x090a0b0c, 0x0d0e0f00, 0});
    EXPECT_U32(spu_rlqwbyte(words, 3), {0x03040506, 0x0708090a, 0x0b0c0d0e, 0x0f000102});
    EXPECT_U32(spu_rlqwbyte(words, -1), {0x0f000102, 0x03040506, 0x0708090a, 0x0b0c0d0e});
    EXPECT_F32(spu_rlqwbyte(((vec_float4){1, 2, 3, 4}), 4), {2, 3, 4, 1});
    EXPECT_U32(spu_rlqwbytebc(words, 0x1f), {0x03040506, 0x0708090a, 0x0b0c0d0e, 0x0f000102});
    EXPECT_U32(spu_rlmaskqwbyte(words, -3), {0x00000000, 0x01020304, 0x05060708, 0x090a0b0c});
    EXPECT_U32(spu_rlmaskqwbyte(words, -16), {0, 0, 0, 0});
    EXPECT_U32(spu_rlmaskqwbyte(words, 1), {0, 0, 0, 0}); /* -1 in five bits is 31 */
    EXPECT_F64(spu_rlmaskqwbyte(((vec_double2){1, -2}), -8), {0, 1});
    EXPECT_U32(spu_srqwbyte(words, 3), {0x00000000, 0x01020304, 0x05060708, 0x090a0b0c});
    EXPECT_U32(spu_srqwbytebc(words, 0x1f), {0x00000000, 0x01020304, 0x05060708, 0x090a0b0c});
}

TEST(bits_shift_across_elements) /* shlqbii, rotqbii, rotqmbii */
{
    EXPECT_U32(spu_slqw(words, 4), {0x00102030, 0x40506070, 0x8090a0b0, 0xc0d0e0f0});
    EXPECT_U32(spu_slqw(words, 12), {0x00102030, 0x40506070, 0x8090a0b0, 0xc0d0e0f0}); /* three bits of the count */
    EXPECT_U32(spu_rlqw(signed_words, 1), {0x00020406, 0x080a0c0e, 0x10121416, 0x181a1c1f});
    EXPECT_U32(spu_rlmaskqw(words, -4), {0x00001020, 0x30405060, 0x708090a0, 0xb0c0d0e0});
    EXPECT_U32(spu_srqw(words, 4), {0x00001020, 0x30405060, 0x708090a0, 0xb0c0d0e0});
    EXPECT_U16(spu_slqw(halves, 4), {0x0010, 0x2030, 0x4050, 0x6070, 0x8090, 0xa0b0, 0xc0d0, 0xe0f0});
    EXPECT_U8(spu_srqw(bytes, 1), {0, 0, 0x81, 1, 0x82, 2, 0x83, 3, 0x84, 4, 0x85, 5, 0x86, 6, 0x87, 7});
    EXPECT_U64(spu_slqw(longs, 4), {0x0010203040506070, 0x8090a0b0c0d0e0f0});
}

/* The idioms by which SPU code shifts a register by any number of bits: bytes by the count in bits, then bits. */
static vec_uint4 shift_left(vec_uint4 a, unsigned n) { return spu_slqw(spu_slqwbytebc(a, n), n); }
static vec_uint4 shift_right(vec_uint4 a, int n) { return spu_rlmaskqw(spu_rlmaskqwbytebc(a, 7 - n), -n); }

TEST(whole_registers_shift)
{
    EXPECT_U32(shift_left(signed_words, 12), {0x10203040, 0x50607080, 0x90a0b0c0, 0xd0e0f000});
    EXPECT_U32(shift_right(signed_words, 12), {0x00080010, 0x20304050, 0x60708090, 0xa0b0c0d0});
    EXPECT_U32(shift_right(signed_words, 5), {0x04000810, 0x18202830, 0x38404850, 0x58606870});
    EXPECT_U32(shift_right(signed_words, 8), {0x00800102, 0x03040506, 0x0708090a, 0x0b0c0d0e});
    EXPECT_U32(shift_right(signed_words, 127), {0, 0, 0, 1});
    EXPECT_U32(shift_right(signed_words, 0), {0x80010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f});
    /* 12 bits are one byte to the right: 7 - 12 is -5, shifted by 3 it is -1 */
    EXPECT_U32(spu_rlmaskqwbytebc(words, 7 - 12), {0x00000102, 0x03040506, 0x0708090a, 0x0b0c0d0e});
    /* without the 7 the count rounds up */
    EXPECT_U32(spu_rlmaskqwbytebc(words, -12), {0x00000001, 0x02030405, 0x06070809, 0x0a0b0c0d});
}

TEST(byte_words) /* sumb, absdb, avgb, cntb */
{
    /* 16 + 17 + 18 + 19 = 70 of b on the left, 0 + 1 + 2 + 3 = 6 of a on the right */
    EXPECT_U16(spu_sumb(bytes, more_bytes), {70, 6, 86, 22, 102, 38, 118, 54});
    EXPECT_U8(spu_absd(bytes, ((vec_uchar16){255, 0, 2, 4, 1, 5, 9})),
              {255, 1, 0, 1, 3, 0, 3, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    EXPECT_U8(spu_avg(bytes, ((vec_uchar16){255, 0, 2, 4, 1, 255})),
              {128, 1, 2, 4, 3, 130, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8});
    EXPECT_U8(spu_cntb(((vec_uchar16){0, 1, 0x80, 0xff, 0x55, 0xfe, 7})), {0, 1, 1, 8, 4, 7, 3});
}

/* ---- halves of elements ---- */

TEST(products_of_halves) /* mpyhh, mpy, mpyh, mpys, mpyhha, mpya */
{
    const vec_short8 a = {2, 3, -4, 5, 0x7fff, -0x8000, 1, -1}, b = {10, 100, 1000, -7, 0x7fff, -0x8000, -1, 2};
    const vec_int4 c = {1, 2, 3, 4};
    EXPECT_S32(spu_mule(a, b), {20, -4000, 0x3fff0001, -1});
    EXPECT_S32(spu_mulo(a, b), {300, -35, 0x40000000, -2});
    EXPECT_S32(spu_mulo(a, (short)-3), {-9, -15, 98304, 3});
    EXPECT_U32(spu_mule((vec_ushort8)a, (vec_ushort8)b), {20, 65532000, 0x3fff0001, 65535});
    EXPECT_U32(spu_mulo((vec_ushort8)a, (vec_ushort8)b), {300, 5 * 65529, 0x40000000, 131070});
    /* left half of a times right half of b, in the left half of the result */
    EXPECT_S32(spu_mulh(a, b), {200 << 16, 28 << 16, (int)0x80000000, 2 << 16});
    EXPECT_S32(spu_mulsr(a, b), {0, -1, 0x4000, -1});
    EXPECT_S32(spu_mhhadd(a, b, c), {21, -3998, 0x3fff0004, 3});
    EXPECT_S32(spu_madd(a, b, c), {301, -33, 0x40000003, 2});
    /* 32-bit products in three: 0x12345678 * 0x9abcdef0, -1 * -1, 65537 * 65537, 0x80000001 * 3 */
    const vec_short8 xh = (vec_short8)(vec_ushort8){0x1234, 0x5678, 0xffff, 0xffff, 1, 1, 0x8000, 1};
    const vec_short8 yh = (vec_short8)(vec_ushort8){0x9abc, 0xdef0, 0xffff, 0xffff, 1, 1, 0, 3};
    EXPECT_U32(spu_add(spu_add((vec_uint4)spu_mulh(xh, yh), (vec_uint4)spu_mulh(yh, xh)),
                       spu_mulo((vec_ushort8)xh, (vec_ushort8)yh)),
               {0x242d2080, 1, 0x00020001, 0x80000003});
}

TEST(extend_and_round) /* xsbh, xshw, xswd, fesd, frds */
{
    EXPECT_S16(spu_extend(((vec_char16){1, -2, 3, 4, 5, -128, 7, 127, 9, 0, 11, -1, 13, 14, 15, 16})),
               {-2, 4, -128, 127, 0, -1, 14, 16});
    EXPECT_S32(spu_extend(((vec_short8){1, -2, 3, 0x7fff, 5, -0x8000, 7, 0})), {-2, 0x7fff, -0x8000, 0});
    EXPECT_S64(spu_extend(((vec_int4){1, -2, 3, 4})), {-2, 4});
    EXPECT_F64(spu_extend(((vec_float4){1.5f, -2, -3, 4})), {1.5, -3});
    EXPECT_F32(spu_roundtf(((vec_double2){1.5, -0x1.000001p0})), {1.5f, 0, -1, 0});
    EXPECT_F32(spu_roundtf(((vec_double2){0x1p-149, 1e39})), {0x1p-149f, 0, INFINITY, 0});
}

TEST(leading_zeros_and_or_across) /* clz, orx */
{
    EXPECT_U32(spu_cntlz(((vec_uint4){0, 1, 0x80000000, 0x0000ffff})), {32, 31, 0, 16});
    EXPECT_U32(spu_cntlz(((vec_float4){0.f, -0.f, 1.f, 0x1p-149f})), {32, 0, 2, 31});
    EXPECT_U32(spu_orx(((vec_uint4){1, 0x10, 0x80000000, 0x300})), {0x80000311, 0, 0, 0});
}

/* ---- carries ---- */

/* 128-bit numbers, word 0 the most significant. The carry of each word belongs to the next one on its left; into the
 * last word goes 1 for a difference, 0 for a sum. Three rounds carry through three words. */
static const vec_uchar16 carry_left = {4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0x80, 0x80, 0x80, 0x80};
static const vec_uchar16 borrow_left = {4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0xc0, 0xc0, 0xc0, 0xc0};

static vec_uint4 add128(vec_uint4 a, vec_uint4 b)
{
    vec_uint4 carry = spu_shuffle(spu_genc(a, b), spu_genc(a, b), carry_left);
    for (int i = 0; i < 3; i++)
        carry = spu_shuffle(spu_gencx(a, b, carry), carry, carry_left);
    return spu_addx(a, b, carry);
}

static vec_uint4 sub128(vec_uint4 a, vec_uint4 b)
{
    vec_uint4 borrow = spu_shuffle(spu_genb(a, b), spu_genb(a, b), borrow_left);
    for (int i = 0; i < 3; i++)
        borrow = spu_shuffle(spu_genbx(a, b, borrow), borrow, borrow_left);
    return spu_subx(a, b, borrow);
}

TEST(carries_run_through_words) /* cg, cgx, addx, bg, bgx, sfx */
{
    const vec_uint4 a = {0x12345678, 0x9abcdef0, 0xfedcba98, 0x76543210}, ones = spu_splats(0xffffffffu);
    const vec_uint4 b = {0x0fedcba9, 0x87654321, 0x12345671, 0x89abcdef}, one = {0, 0, 0, 1}, zero = {0, 0, 0, 0};
    EXPECT_U32(add128(a, b), {0x22222222, 0x22222212, 0x11111109, 0xffffffff});
    EXPECT_U32(sub128(a, b), {0x02468acf, 0x13579bcf, 0xeca86426, 0xeca86421});
    EXPECT_U32(sub128(b, a), {0xfdb97530, 0xeca86430, 0x13579bd9, 0x13579bdf});
    EXPECT_U32(add128(ones, one), {0, 0, 0, 0});
    EXPECT_U32(sub128(zero, one), {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff});
    EXPECT_U32(sub128(((vec_uint4){1, 0, 0, 0}), one), {0, 0xffffffff, 0xffffffff, 0xffffffff});
    EXPECT_U32(spu_genc(((vec_uint4){1, 0xffffffff, 0x80000000, 0}), ((vec_uint4){1, 1, 0x80000000, 0})), {0, 1, 1, 0});
    EXPECT_U32(spu_genb(((vec_uint4){1, 1, 0, 0xffffffff}), ((vec_uint4){1, 2, 0, 0})), {1, 0, 1, 1});
    EXPECT_U32(spu_genbx(((vec_uint4){5, 5, 5, 4}), ((vec_uint4){5, 5, 4, 5}), ((vec_uint4){1, 2, 0, 1})),
               {1, 0, 1, 0});
    EXPECT_U32(spu_subx(((vec_uint4){5, 5, 0, 0}), ((vec_uint4){3, 3, 0, 0}), ((vec_uint4){1, 0, 0xfffffffe, 3})),
               {2, 1, 0xffffffff, 0});
    EXPECT_U32(spu_addx(((vec_uint4){5, 5, 0, 0xffffffff}), ((vec_uint4){3, 3, 0, 0}), ((vec_uint4){1, 0, 2, 1})),
               {9, 8, 0, 0});
}

/* ---- shifts of elements ---- */

TEST(counts_beyond_the_element) /* shlh, shl, rothm, rotm, rotmah, rotma, roth, rot */
{
    const vec_ushort8 h = {0x8001, 0x8001, 0x8001, 0x8001, 0x8001, 0x8001, 0x8001, 0x8001};
    const vec_short8 down = {0, -1, -15, -16, -31, -32, 1, 16};
    const vec_uint4 w = {0x80000001, 0x80000001, 0x80000001, 0x80000001};
    EXPECT_U16(spu_sl(h, ((vec_ushort8){0, 1, 15, 16, 31, 32, 33, 0xffff})), {0x8001, 2, 0x8000, 0, 0, 0x8001, 2, 0});
    EXPECT_U32(spu_sl(w, ((vec_uint4){1, 31, 32, 64})), {2, 0x80000000, 0, 0x80000001});
    EXPECT_U16(spu_rlmask(h, down), {0x8001, 0x4000, 1, 0, 0, 0x8001, 0, 0});
    EXPECT_S16(spu_rlmaska((vec_short8)h, down), {-0x7fff, -0x4000, -1, -1, -1, -0x7fff, -1, -1});
    EXPECT_U16(spu_rlmaska(h, down), {0x8001, 0xc000, 0xffff, 0xffff, 0xffff, 0x8001, 0xffff, 0xffff});
    EXPECT_U32(spu_rlmask(w, ((vec_int4){-1, -31, -32, -64})), {0x40000000, 1, 0, 0x80000001});
    EXPECT_U32(spu_rlmaska(w, ((vec_int4){-1, -31, -63, 1})), {0xc0000000, 0xffffffff, 0xffffffff, 0xffffffff});
    EXPECT_U32(spu_sr(w, ((vec_uint4){1, 31, 32, 64})), {0x40000000, 1, 0, 0x80000001});
    EXPECT_U32(spu_sra(w, ((vec_uint4){1, 31, 32, 64})), {0xc0000000, 0xffffffff, 0xffffffff, 0x80000001});
    EXPECT_U16(spu_rl(h, ((vec_short8){1, -1, 16, 17, 4, -4, 0, 15})),
               {3, 0xc000, 0x8001, 3, 0x18, 0x1800, 0x8001, 0xc000});
    EXPECT_U32(spu_rl(w, ((vec_int4){1, -1, 32, 36})), {3, 0xc0000000, 0x80000001, 0x18});
    EXPECT_U32(spu_sl(w, 4), {16, 16, 16, 16});
    EXPECT_U32(spu_rlmask(w, -4), {0x08000000, 0x08000000, 0x08000000, 0x08000000});
    EXPECT_U32(spu_rlmaska(w, -40), {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff});
}

/* ---- floats ---- */

TEST(conversions_saturate) /* cflts, cfltu, csflt, cuflt */
{
#ifndef CGT_SPU_EXACT
    const vec_float4 ends = {0x1.fffffep30f, 0x1p31f, -0x1.000002p31f, -0x1p31f};
    EXPECT_S32(spu_convts(ends, 0), {0x7fffff80, 0x7fffffff, -0x7fffffff - 1, -0x7fffffff - 1});
    EXPECT_U32(spu_convtu(((vec_float4){0x1.fffffep31f, 0x1p32f, -0.5f, -0x1p40f}), 0), {0xffffff00, 0xffffffff, 0, 0});
    EXPECT_S32(spu_convts(((vec_float4){2.9f, -2.9f, 0x1p127f, NAN}), 0), {2, -2, 0x7fffffff, 0});
    EXPECT_S32(spu_convts(((vec_float4){INFINITY, -INFINITY, 0x1p-149f, -0.9f}), 0),
               {0x7fffffff, -0x7fffffff - 1, 0, 0});
    EXPECT_S32(spu_convts(((vec_float4){1.75f, -1.75f, 0x1p-127f, 0x1p-140f}), 2), {7, -7, 0, 0});
    EXPECT_S32(spu_convts(((vec_float4){0x1p-127f, -0x1p-126f, 0x1p-97f, 0x1p-96f}), 127),
               {1, -2, 0x40000000, 0x7fffffff});
    EXPECT_U32(spu_convtu(((vec_float4){0.5f, 0x1p-1f, 1.f, -1.f}), 32), {0x80000000, 0x80000000, 0xffffffff, 0});
    EXPECT_F32(spu_convtf(((vec_int4){1, -1, 0x7fffffff, -0x7fffffff - 1}), 0), {1, -1, 0x1p31f, -0x1p31f});
    EXPECT_F32(spu_convtf(((vec_uint4){1, 0xffffffff, 0x80000000, 0xffffff7f}), 0),
               {1, 0x1p32f, 0x1p31f, 0x1.fffffep31f});
    EXPECT_F32(spu_convtf(((vec_int4){1, -3, 0x1000001, 0x1000003}), 4), {0x1p-4f, -0x3p-4f, 0x1p20f, 0x1.000004p20f});
    EXPECT_F32(spu_convtf(((vec_uint4){1, 3, 0, 0x80000000}), 127), {0x1p-127f, 0x1.8p-126f, 0, 0x1p-96f});
#endif
}

TEST(special_values_are_told_apart) /* dftsv */
{
    const vec_double2 nan_infinity = {NAN, -INFINITY}, zeros = {0., -0.}, denormals = {0x1p-1074, -0x1p-1023};
    const vec_double2 others = {0x1p-1022, -1};
    EXPECT_U64(spu_testsv(nan_infinity, SPU_SV_NAN), {UINT64_MAX, 0});
    EXPECT_U64(spu_testsv(nan_infinity, SPU_SV_NEG_INFINITY), {0, UINT64_MAX});
    EXPECT_U64(spu_testsv(nan_infinity, SPU_SV_POS_INFINITY), {0, 0});
    EXPECT_U64(spu_testsv(zeros, SPU_SV_POS_ZERO), {UINT64_MAX, 0});
    EXPECT_U64(spu_testsv(zeros, SPU_SV_NEG_ZERO), {0, UINT64_MAX});
    EXPECT_U64(spu_testsv(denormals, SPU_SV_POS_DENORM), {UINT64_MAX, 0});
    EXPECT_U64(spu_testsv(denormals, SPU_SV_NEG_DENORM), {0, UINT64_MAX});
    EXPECT_U64(spu_testsv(others, 0x7f), {0, 0});
    assert_int_equal(SPU_SV_NEG_DENORM, 0x01);
    assert_int_equal(SPU_SV_NAN, 0x40);
}

/* (1 + e)^2 - (1 + 2 e) is e^2, which a product that is rounded first loses. */
#define FUSED_REST (CGT_SPU_FUSED ? 0x1p-46f : 0.f)
#define FUSED_REST_DOUBLE (CGT_SPU_FUSED_DOUBLE ? 0x1p-104 : 0.)
TEST(fused_is_what_the_mapping_says)
{
#ifndef CGT_SPU_EXACT
    const vec_float4 a = spu_splats(0x1.000002p0f), c = spu_splats(0x1.000004p0f);
    EXPECT_F32(spu_msub(a, a, c), {FUSED_REST, FUSED_REST, FUSED_REST, FUSED_REST});
    EXPECT_F32(spu_madd(a, a, spu_splats(-0x1.000004p0f)), {FUSED_REST, FUSED_REST, FUSED_REST, FUSED_REST});
    assert_true(spu_extract(spu_nmsub(a, a, c), 0) == -FUSED_REST);
#endif
    const vec_double2 b = spu_splats(0x1.0000000000001p0), d = spu_splats(0x1.0000000000002p0);
    EXPECT_F64(spu_msub(b, b, d), {FUSED_REST_DOUBLE, FUSED_REST_DOUBLE});
    EXPECT_F64(spu_nmsub(b, b, d),
               {-FUSED_REST_DOUBLE, -FUSED_REST_DOUBLE}); /* dfnms negates the difference, a zero too */
    EXPECT_F64(spu_nmsub(((vec_double2){2, 2}), ((vec_double2){3, 3}), ((vec_double2){6, 7})), {-0., 1});
    EXPECT_F64(spu_nmadd(b, b, spu_splats(-0x1.0000000000002p0)), {-FUSED_REST_DOUBLE, -FUSED_REST_DOUBLE});
}

/* ---- scalars as SPU code writes them: plain int constants for any element ---- */

TEST(plain_constants_are_scalars)
{
    const vec_char16 signed_bytes = (vec_char16)more_bytes;
    EXPECT_U16(spu_add(halves, 1), {2, 0x0204, 0x0406, 0x0608, 0x080a, 0x0a0c, 0x0c0e, 0x0e10});
    EXPECT_S16(spu_sub(5, ((vec_short8){1, 2, 3, 4, 5, 6, 7, 8})), {4, 3, 2, 1, 0, -1, -2, -3});
    EXPECT_U8(spu_cmpeq(bytes, 3), {0, 0, 0, 0xff});
    EXPECT_U8(spu_cmpgt(bytes, -1), {0}); /* 255 as an unsigned byte */
    EXPECT_U8(spu_cmpgt((vec_char16)bytes, 13), {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff});
    EXPECT_U8((vec_uchar16)spu_and(signed_bytes, 0x0f), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    EXPECT_U32(spu_or(words, 1), {0x00010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f});
    EXPECT_U16(spu_sl(halves, 8), {0x0100, 0x0300, 0x0500, 0x0700, 0x0900, 0x0b00, 0x0d00, 0x0f00});
    EXPECT_U16(spu_rl(halves, -8), {0x0100, 0x0302, 0x0504, 0x0706, 0x0908, 0x0b0a, 0x0d0c, 0x0f0e});
    EXPECT_U32(spu_mulo(halves, 2), {0x0406, 0x0c0e, 0x1416, 0x1c1e});
    EXPECT_F32(spu_insert(1, ((vec_float4){5, 6, 7, 8}), 2), {5, 6, 1, 8});
    EXPECT_U8(spu_insert(200, bytes, 0), {200, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
}

VARIANT_SUITE("test_spu_literals", NULL, NULL)
