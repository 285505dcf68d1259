/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The definitions of instructions, see spu_definitions.h. */
#include "cell/spu/spu_definitions.h"

#include <string.h>

#include "spu_float_model.h"

/* ---- elements ---- */

static uint32_t get(const uint8_t *q, int element, int bytes)
{
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++)
        value = value << 8 | q[element * bytes + i];
    return value;
}
static void put(uint8_t *q, int element, int bytes, uint64_t value)
{
    for (int i = 0; i < bytes; i++)
        q[element * bytes + i] = (uint8_t)(value >> 8 * (bytes - 1 - i));
}
static int64_t with_sign(uint64_t value, int bits)
{
    const uint64_t sign = UINT64_C(1) << (bits - 1), field = value & (2 * sign - 1);
    return (int64_t)(field ^ sign) - (int64_t)sign;
}
static uint64_t ones(int holds) { return holds ? UINT64_MAX : 0; }

/* a, b, c, t: elements without sign; sa, sb: with it; i: imm as it is, ui: cut to the element */
#define ELEMENTS(name, bytes, result)                                                                                  \
    static void define_##name(int32_t imm, const uint8_t *ra, const uint8_t *rb, const uint8_t *rc, uint8_t *rt)       \
    {                                                                                                                  \
        for (int k = 0; k < 16 / (bytes); k++) {                                                                       \
            const uint64_t a = get(ra, k, bytes), b = get(rb, k, bytes), c = get(rc, k, bytes), t = get(rt, k, bytes); \
            const int64_t sa = with_sign(a, 8 * (bytes)), sb = with_sign(b, 8 * (bytes)), i = imm;                     \
            const uint64_t ui = (uint64_t)i & (UINT64_MAX >> (64 - 8 * (bytes)));                                      \
            const int64_t si = with_sign(ui, 8 * (bytes));                                                             \
            (void)a, (void)b, (void)c, (void)t, (void)sa, (void)sb, (void)i, (void)ui, (void)si;                       \
            put(rt, k, bytes, (uint64_t)(result));                                                                     \
        }                                                                                                              \
    }
#define W(name, result) ELEMENTS(name, 4, result)
#define H(name, result) ELEMENTS(name, 2, result)
#define B(name, result) ELEMENTS(name, 1, result)

static int64_t low(uint64_t a) { return with_sign(a, 16); }
static int64_t high(uint64_t a) { return with_sign(a >> 16, 16); }

/* clang-format off */
W(a, a + b) H(ah, a + b) W(ai, a + ui) H(ahi, a + ui)
W(sf, b - a) H(sfh, b - a) W(sfi, ui - a) H(sfhi, ui - a)
W(addx, a + b + (t & 1)) W(sfx, b - a - (1 - (t & 1)))
W(cg, (a + b) >> 32) W(cgx, (a + b + (t & 1)) >> 32)
W(bg, b >= a) W(bgx, (int64_t)b - (int64_t)a - 1 + (int64_t)(t & 1) >= 0)
W(mpy, low(a) * low(b)) W(mpyu, (a & 0xffff) * (b & 0xffff))
W(mpyi, low(a) * i) W(mpyui, (a & 0xffff) * (uint64_t)(i & 0xffff))
W(mpyh, ((a >> 16) * (b & 0xffff)) << 16) W(mpys, (low(a) * low(b)) >> 16)
W(mpyhh, high(a) * high(b)) W(mpyhhu, (a >> 16) * (b >> 16))
W(mpyhha, (uint64_t)(high(a) * high(b)) + t) W(mpyhhau, (a >> 16) * (b >> 16) + t)
W(mpya, (uint64_t)(low(a) * low(b)) + c)

static uint64_t leading_zeros(uint64_t a)
{
    uint64_t n = 0;
    while (n < 32 && !(a >> (31 - n) & 1))
        n++;
    return n;
}
static uint64_t count_ones(uint64_t a)
{
    uint64_t n = 0;
    for (; a; a >>= 1)
        n += a & 1;
    return n;
}
static uint64_t sum_bytes(uint64_t a) { return (a & 255) + (a >> 8 & 255) + (a >> 16 & 255) + (a >> 24 & 255); }

W(clz, leading_zeros(a)) B(cntb, count_ones(a))
B(absdb, a > b ? a - b : b - a) B(avgb, (a + b + 1) / 2)
W(sumb, sum_bytes(b) << 16 | sum_bytes(a))
H(xsbh, with_sign(a, 8)) W(xshw, with_sign(a, 16))

B(ceqb, ones(a == b)) H(ceqh, ones(a == b)) W(ceq, ones(a == b))
B(ceqbi, ones(a == ui)) H(ceqhi, ones(a == ui)) W(ceqi, ones(a == ui))
B(cgtb, ones(sa > sb)) H(cgth, ones(sa > sb)) W(cgt, ones(sa > sb))
B(cgtbi, ones(sa > si)) H(cgthi, ones(sa > si)) W(cgti, ones(sa > si))
B(clgtb, ones(a > b)) H(clgth, ones(a > b)) W(clgt, ones(a > b))
B(clgtbi, ones(a > ui)) H(clgthi, ones(a > ui)) W(clgti, ones(a > ui))

W(and, a & b) W(andc, a & ~b) B(andbi, a & ui) H(andhi, a & ui) W(andi, a & ui)
W(or, a | b) W(orc, a | ~b) B(orbi, a | ui) H(orhi, a | ui) W(ori, a | ui)
W(xor, a ^ b) B(xorbi, a ^ ui) H(xorhi, a ^ ui) W(xori, a ^ ui)
W(nand, ~(a & b)) W(nor, ~(a | b)) W(eqv, ~(a ^ b)) B(selb, (a & ~c) | (b & c))
W(il, i) H(ilh, i) W(ilhu, i * 65536) W(ila, i) W(iohl, t | (uint64_t)i)

/* by single steps, so that no count is too large */
static uint64_t shifted_left(uint64_t a, uint64_t n)
{
    for (; n; n--)
        a *= 2;
    return a;
}
static uint64_t shifted_right(uint64_t a, uint64_t n)
{
    for (; n; n--)
        a /= 2;
    return a;
}
static uint64_t rotated(uint64_t a, uint64_t n, int bits)
{
    for (; n; n--)
        a = (a << 1 | a >> (bits - 1)) & (UINT64_MAX >> (64 - bits));
    return a;
}
static uint64_t arithmetic(int64_t a, uint64_t n)
{
    for (; n; n--)
        a = a < 0 ? -((1 - a) / 2) : a / 2; /* towards minus infinity */
    return (uint64_t)a;
}

W(shl, shifted_left(a, b & 63)) W(shli, shifted_left(a, ui & 63))
W(rot, rotated(a, b & 31, 32)) W(roti, rotated(a, ui & 31, 32))
W(rotm, shifted_right(a, (0 - b) & 63)) W(rotmi, shifted_right(a, (0 - ui) & 63))
W(rotma, arithmetic(sa, (0 - b) & 63)) W(rotmai, arithmetic(sa, (0 - ui) & 63))
H(shlh, shifted_left(a, b & 31)) H(shlhi, shifted_left(a, ui & 31))
H(roth, rotated(a, b & 15, 16)) H(rothi, rotated(a, ui & 15, 16))
H(rothm, shifted_right(a, (0 - b) & 31)) H(rothmi, shifted_right(a, (0 - ui) & 31))
H(rotmah, arithmetic(sa, (0 - b) & 31)) H(rotmahi, arithmetic(sa, (0 - ui) & 31))

/* ---- quadwords ---- */

#define QUAD(name, statements)                                                                                         \
    static void define_##name(int32_t imm, const uint8_t *ra, const uint8_t *rb, const uint8_t *rc, uint8_t *rt)       \
    {                                                                                                                  \
        const uint32_t i = (uint32_t)imm, a = get(ra, 0, 4), b = get(rb, 0, 4);                                        \
        (void)i, (void)a, (void)b, (void)rc;                                                                           \
        statements;                                                                                                    \
    }

static int get_bit(const uint8_t *q, int at) { return q[at / 8] >> (7 - at % 8) & 1; }

/* Bit k becomes bit k + by of the source; outside: zero, or the bit at the other end. */
static void move_bits(uint8_t *rt, const uint8_t *ra, int by, int around)
{
    uint8_t result[16] = {0};
    for (int k = 0; k < 128; k++) {
        int from = k + by;
        if (around)
            from = (from + 256) % 128;
        if (from >= 0 && from < 128 && get_bit(ra, from))
            result[k / 8] |= (uint8_t)(0x80 >> k % 8);
    }
    memcpy(rt, result, 16);
}

QUAD(shlqbi, move_bits(rt, ra, b & 7, 0)) QUAD(shlqbii, move_bits(rt, ra, i & 7, 0))
QUAD(shlqby, move_bits(rt, ra, 8 * (b & 31), 0)) QUAD(shlqbyi, move_bits(rt, ra, 8 * (i & 31), 0))
QUAD(shlqbybi, move_bits(rt, ra, 8 * (b >> 3 & 31), 0))
QUAD(rotqbi, move_bits(rt, ra, b & 7, 1)) QUAD(rotqbii, move_bits(rt, ra, i & 7, 1))
QUAD(rotqby, move_bits(rt, ra, 8 * (b & 15), 1)) QUAD(rotqbyi, move_bits(rt, ra, 8 * (i & 15), 1))
QUAD(rotqbybi, move_bits(rt, ra, 8 * (b >> 3 & 15), 1))
QUAD(rotqmbi, move_bits(rt, ra, -(int)((0 - b) & 7), 0)) QUAD(rotqmbii, move_bits(rt, ra, -(int)((0 - i) & 7), 0))
QUAD(rotqmby, move_bits(rt, ra, -8 * (int)((0 - b) & 31), 0))
QUAD(rotqmbyi, move_bits(rt, ra, -8 * (int)((0 - i) & 31), 0))
QUAD(rotqmbybi, move_bits(rt, ra, -8 * (int)((0 - (b >> 3)) & 31), 0))

static uint8_t shuffled(const uint8_t *ra, const uint8_t *rb, uint8_t control)
{
    if ((control & 0xc0) == 0x80)
        return 0;
    if ((control & 0xe0) == 0xc0)
        return 0xff;
    if ((control & 0xe0) == 0xe0)
        return 0x80;
    return control & 16 ? rb[control & 15] : ra[control & 15];
}
QUAD(shufb, uint8_t result[16]; for (int k = 0; k < 16; k++) result[k] = shuffled(ra, rb, rc[k]);
     memcpy(rt, result, 16))

/* Bytes of the first register behind 0x10, those of the second below; `first` is the preferred slot's first byte. */
static void insertion(uint8_t *rt, uint32_t address, int bytes, int first)
{
    const int at = (int)(address % 16) / bytes * bytes;
    for (int k = 0; k < 16; k++)
        rt[k] = (uint8_t)(k >= at && k < at + bytes ? first + k - at : 16 + k);
}
QUAD(cbd, insertion(rt, a + i, 1, 3)) QUAD(cbx, insertion(rt, a + b, 1, 3))
QUAD(chd, insertion(rt, a + i, 2, 2)) QUAD(chx, insertion(rt, a + b, 2, 2))
QUAD(cwd, insertion(rt, a + i, 4, 0)) QUAD(cwx, insertion(rt, a + b, 4, 0))
QUAD(cdd, insertion(rt, a + i, 8, 0)) QUAD(cdx, insertion(rt, a + b, 8, 0))

static void form(uint8_t *rt, uint32_t bits, int bytes)
{
    for (int k = 0; k < 16; k++)
        rt[k] = bits >> (16 / bytes - 1 - k / bytes) & 1 ? 0xff : 0;
}
QUAD(fsm, form(rt, a, 4)) QUAD(fsmh, form(rt, a, 2)) QUAD(fsmb, form(rt, a, 1)) QUAD(fsmbi, form(rt, i, 1))

static void first_word(uint8_t *rt, uint32_t value)
{
    memset(rt, 0, 16);
    put(rt, 0, 4, value);
}
static uint32_t gathered(const uint8_t *ra, int bytes)
{
    uint32_t bits = 0;
    for (int k = 0; k < 16 / bytes; k++)
        bits = bits * 2 + (ra[k * bytes + bytes - 1] & 1);
    return bits;
}
QUAD(gb, first_word(rt, gathered(ra, 4))) QUAD(gbh, first_word(rt, gathered(ra, 2)))
QUAD(gbb, first_word(rt, gathered(ra, 1)))
QUAD(orx, first_word(rt, get(ra, 0, 4) | get(ra, 1, 4) | get(ra, 2, 4) | get(ra, 3, 4)))

static void extend_words(uint8_t *rt, const uint8_t *ra)
{
    for (int k = 0; k < 2; k++) {
        const uint32_t word = get(ra, 2 * k + 1, 4);
        put(rt, 2 * k, 4, word >> 31 ? UINT32_MAX : 0);
        put(rt, 2 * k + 1, 4, word);
    }
}
QUAD(xswd, extend_words(rt, ra))
QUAD(mfspr, memset(rt, 0, 16))

/* ---- single precision: the model in integers, which tests/simd compares with exact results ---- */

#define F1(name, word) W(name, word((uint32_t)a))
#define F2(name, word) W(name, word((uint32_t)a, (uint32_t)b))
#define F3(name, word) W(name, word((uint32_t)a, (uint32_t)b, (uint32_t)c))
#define FN(name, word, least) W(name, word((uint32_t)a, (least) - (int)i))
F2(fa, cgt_spu_model_add) F2(fs, cgt_spu_model_sub) F2(fm, cgt_spu_model_mul)
F3(fma, cgt_spu_model_madd) F3(fms, cgt_spu_model_msub) F3(fnms, cgt_spu_model_nmsub)
F2(fceq, cgt_spu_model_cmpeq) F2(fcgt, cgt_spu_model_cmpgt)
F2(fcmeq, cgt_spu_model_cmpabseq) F2(fcmgt, cgt_spu_model_cmpabsgt)
F1(frest, cgt_spu_model_frest) F1(frsqest, cgt_spu_model_frsqest) F2(fi, cgt_spu_model_fi)
FN(cflts, cgt_spu_model_convts, 173) FN(cfltu, cgt_spu_model_convtu, 173)
FN(csflt, cgt_spu_model_convtf_s32, 155) FN(cuflt, cgt_spu_model_convtf_u32, 155)

/* ---- the list ---- */

#define D(name) [cgt_spu_op_##name] = define_##name
static spu_definition *const definitions[CGT_SPU_OPS] = {
    D(a), D(ah), D(ai), D(ahi), D(sf), D(sfh), D(sfi), D(sfhi), D(addx), D(sfx), D(cg), D(cgx), D(bg), D(bgx),
    D(mpy), D(mpyu), D(mpyi), D(mpyui), D(mpyh), D(mpys), D(mpyhh), D(mpyhhu), D(mpyhha), D(mpyhhau), D(mpya),
    D(clz), D(cntb), D(absdb), D(avgb), D(sumb), D(xsbh), D(xshw), D(xswd),
    D(ceqb), D(ceqh), D(ceq), D(ceqbi), D(ceqhi), D(ceqi), D(cgtb), D(cgth), D(cgt), D(cgtbi), D(cgthi), D(cgti),
    D(clgtb), D(clgth), D(clgt), D(clgtbi), D(clgthi), D(clgti),
    D(and), D(andc), D(andbi), D(andhi), D(andi), D(or), D(orc), D(orbi), D(orhi), D(ori), D(xor), D(xorbi),
    D(xorhi), D(xori), D(nand), D(nor), D(eqv), D(selb), D(il), D(ilh), D(ilhu), D(ila), D(iohl),
    D(shl), D(shli), D(rot), D(roti), D(rotm), D(rotmi), D(rotma), D(rotmai), D(shlh), D(shlhi), D(roth), D(rothi),
    D(rothm), D(rothmi), D(rotmah), D(rotmahi),
    D(shlqbi), D(shlqbii), D(shlqby), D(shlqbyi), D(shlqbybi), D(rotqbi), D(rotqbii), D(rotqby), D(rotqbyi),
    D(rotqbybi), D(rotqmbi), D(rotqmbii), D(rotqmby), D(rotqmbyi), D(rotqmbybi),
    D(shufb), D(cbd), D(chd), D(cwd), D(cdd), D(cbx), D(chx), D(cwx), D(cdx), D(fsm), D(fsmh), D(fsmb), D(fsmbi),
    D(gb), D(gbh), D(gbb), D(orx), D(mfspr),
    D(fa), D(fs), D(fm), D(fma), D(fms), D(fnms), D(fceq), D(fcgt), D(fcmeq), D(fcmgt), D(frest), D(frsqest), D(fi),
    D(cflts), D(cfltu), D(csflt), D(cuflt),
};

spu_definition *spu_definition_of(cgt_spu_op op) { return definitions[op]; }
