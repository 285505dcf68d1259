/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words by the SPU's instructions, and words of floats in C; the comparison of results. */
#include "simd/spu_reference.h"

#include <math.h>

#include "cell/spu/isa/assemble.h"
#include "core/memory.h"
#include "support/test.h"

/* ---- the instruction of a word ---- */

enum {
    SWAP = 1,   /* the instruction has the operands a and b the other way round */
    NEGATE = 2, /* it takes -b: shifts to the right are rotations to the left */
    SEVEN = 4,  /* it takes 7 - b, whose bytes are those of -b, rounded up */
    USES_T = 8, /* the third operand lies in rt */
    SLOT = 16   /* scalars go to the preferred slot; else to all elements */
};

/* bits: of an element of the first operand, 0: any. sign: its type is signed, unsigned, either. */
enum { SIGNED = 's', UNSIGNED = 'u', EITHER = 0 };
typedef struct row {
    const char *word;
    int bits, sign;
    cgt_spu_op op;
    int how;
} row;

/* clang-format off */
#define ROW(word, bits, sign, op, how) {#word, bits, sign, cgt_spu_op_##op, how}
#define SHIFT(word, of_32, of_16, how) ROW(word, 32, EITHER, of_32, how), ROW(word, 16, EITHER, of_16, how)
static const row rows[] = {
    ROW(add, 32, EITHER, a, 0), ROW(add, 16, EITHER, ah, 0),
    ROW(sub, 32, EITHER, sf, SWAP), ROW(sub, 16, EITHER, sfh, SWAP),
    ROW(addx, 32, EITHER, addx, USES_T), ROW(subx, 32, EITHER, sfx, SWAP | USES_T),
    ROW(genc, 32, EITHER, cg, 0), ROW(gencx, 32, EITHER, cgx, USES_T),
    ROW(genb, 32, EITHER, bg, SWAP), ROW(genbx, 32, EITHER, bgx, SWAP | USES_T),
    ROW(madd, 16, SIGNED, mpya, 0), ROW(mulh, 16, SIGNED, mpyh, 0), ROW(mulsr, 16, SIGNED, mpys, 0),
    ROW(mule, 16, SIGNED, mpyhh, 0), ROW(mule, 16, UNSIGNED, mpyhhu, 0),
    ROW(mulo, 16, SIGNED, mpy, 0), ROW(mulo, 16, UNSIGNED, mpyu, 0),
    ROW(mhhadd, 16, SIGNED, mpyhha, USES_T), ROW(mhhadd, 16, UNSIGNED, mpyhhau, USES_T),
    ROW(absd, 8, UNSIGNED, absdb, 0), ROW(avg, 8, UNSIGNED, avgb, 0), ROW(sumb, 8, UNSIGNED, sumb, 0),
    ROW(extend, 8, SIGNED, xsbh, 0), ROW(extend, 16, SIGNED, xshw, 0), ROW(extend, 32, SIGNED, xswd, 0),
    ROW(cmpeq, 8, EITHER, ceqb, 0), ROW(cmpeq, 16, EITHER, ceqh, 0), ROW(cmpeq, 32, EITHER, ceq, 0),
    ROW(cmpgt, 8, SIGNED, cgtb, 0), ROW(cmpgt, 16, SIGNED, cgth, 0), ROW(cmpgt, 32, SIGNED, cgt, 0),
    ROW(cmpgt, 8, UNSIGNED, clgtb, 0), ROW(cmpgt, 16, UNSIGNED, clgth, 0), ROW(cmpgt, 32, UNSIGNED, clgt, 0),
    ROW(cntb, 8, EITHER, cntb, 0), ROW(cntlz, 32, EITHER, clz, 0),
    ROW(gather, 8, EITHER, gbb, 0), ROW(gather, 16, EITHER, gbh, 0), ROW(gather, 32, EITHER, gb, 0),
    ROW(maskb, 0, EITHER, fsmb, SLOT), ROW(maskh, 0, EITHER, fsmh, SLOT), ROW(maskw, 0, EITHER, fsm, SLOT),
    ROW(sel, 0, EITHER, selb, 0), ROW(shuffle, 0, EITHER, shufb, 0), ROW(orx, 0, EITHER, orx, 0),
    ROW(and, 0, EITHER, and, 0), ROW(or, 0, EITHER, or, 0), ROW(xor, 0, EITHER, xor, 0),
    ROW(andc, 0, EITHER, andc, 0), ROW(orc, 0, EITHER, orc, 0), ROW(nand, 0, EITHER, nand, 0),
    ROW(nor, 0, EITHER, nor, 0), ROW(eqv, 0, EITHER, eqv, 0),
    SHIFT(sl, shl, shlh, 0), SHIFT(rl, rot, roth, 0), SHIFT(rlmask, rotm, rothm, 0), SHIFT(rlmaska, rotma, rotmah, 0),
    SHIFT(sr, rotm, rothm, NEGATE), SHIFT(sra, rotma, rotmah, NEGATE),
    ROW(slqw, 0, EITHER, shlqbi, SLOT), ROW(slqwbyte, 0, EITHER, shlqby, SLOT),
    ROW(slqwbytebc, 0, EITHER, shlqbybi, SLOT),
    ROW(rlqw, 0, EITHER, rotqbi, SLOT), ROW(rlqwbyte, 0, EITHER, rotqby, SLOT),
    ROW(rlqwbytebc, 0, EITHER, rotqbybi, SLOT),
    ROW(rlmaskqw, 0, EITHER, rotqmbi, SLOT), ROW(rlmaskqwbyte, 0, EITHER, rotqmby, SLOT),
    ROW(rlmaskqwbytebc, 0, EITHER, rotqmbybi, SLOT),
    ROW(srqw, 0, EITHER, rotqmbi, SLOT | NEGATE), ROW(srqwbyte, 0, EITHER, rotqmby, SLOT | NEGATE),
    ROW(srqwbytebc, 0, EITHER, rotqmbybi, SLOT | SEVEN),
};
/* clang-format on */

static bool is_signed(spu_type type) { return type == SPU_s8 || type == SPU_s16 || type == SPU_s32 || type == SPU_s64; }

static const row *find_row(const spu_form *form)
{
    const spu_type type = form->operand[0].type;
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        const row *const r = &rows[i];
        if (!strcmp(r->word, form->word) && (r->bits == 0 || r->bits == spu_bits(type)) &&
            (!spu_is_float(type) || !spu_is_word_of(r->word, " add sub madd extend cmpeq cmpgt ")) &&
            (r->sign == EITHER || (r->sign == SIGNED) == is_signed(type)))
            return r;
    }
    return NULL;
}

bool spu_reference_uses(cgt_spu_op op)
{
    for (size_t i = 0; i < TEST_COUNT(rows); i++)
        if (rows[i].op == op)
            return true;
    return false;
}

/* ---- its operands and its result ---- */

static spu_quad splat(spu_type type, uint64_t value)
{
    spu_quad quad;
    for (int i = 0; i < spu_elements(type); i++)
        spu_set(&quad, type, i, value);
    return quad;
}

/* A quad as the instruction takes it. Elements are those of the first operand. */
static spu_quad prepare(const row *r, const spu_form *form, const spu_quad in[3], int k)
{
    const spu_kind kind = form->operand[k];
    const spu_type type = r->how & SLOT ? SPU_u32 : form->operand[0].type;
    spu_quad quad = in[k];
    if (kind.is_scalar)
        quad = splat(type, spu_get(&quad, kind.type, 0));
    for (int i = 0; k == 1 && r->how & (NEGATE | SEVEN) && i < spu_elements(type); i++)
        spu_set(&quad, type, i, (r->how & SEVEN ? 7u : 0) - spu_get(&quad, type, i));
    return quad;
}

static void set_register(cgt_spu_register *reg, const spu_quad *quad)
{
    for (int i = 0; i < 4; i++)
        reg->word[i] = (uint32_t)spu_get(quad, SPU_u32, i);
}

static spu_quad by_instruction(const row *r, const spu_form *form, const spu_quad in[3])
{
    enum { A = 1, B, C, T };
    static cgt_spu spu;
    static cgt_spu_op loaded; /* the program in local store is this instruction, and a stop */
    spu_quad quad[3] = {in[0], in[1], in[2]}, result;
    for (int k = 0; k < form->operands; k++)
        quad[k] = prepare(r, form, in, k);
    if (!spu.local_store) {
        const cgt_memory_hooks memory = cgt_memory_default();
        assert_int_equal(cgt_spu_create(&spu, &memory, CGT_SPU_UNTIMED), CGT_OK);
    }
    if (loaded != r->op) {
        uint32_t word[2];
        cgt_spu_assembler p = {.word = word, .capacity = 2};
        const int use = cgt_spu_isa[r->op].use;
        cgt_spu_emit(&p, r->op,
                     (cgt_spu_operands){.rt = T,
                                        .ra = use & CGT_SPU_READS_A ? A : 0,
                                        .rb = use & CGT_SPU_READS_B ? B : 0,
                                        .rc = use & CGT_SPU_READS_C ? C : 0});
        CGT_SPU_ASM(&p, stop, .imm = 1);
        assert_true(cgt_spu_assembler_load(&p, &spu));
        loaded = r->op;
    }
    spu.pc = 0;
    set_register(&spu.reg[A], &quad[r->how & SWAP ? 1 : 0]);
    set_register(&spu.reg[B], &quad[r->how & SWAP ? 0 : 1]);
    set_register(&spu.reg[C], &quad[2]);
    set_register(&spu.reg[T], &quad[2]);
    assert_int_equal(cgt_spu_run(&spu, NULL, UINT64_MAX).reason, CGT_SPU_STOPPED);
    for (int i = 0; i < 4; i++)
        spu_set(&result, SPU_u32, i, spu.reg[T].word[i]);
    return result;
}

/* ---- floats ---- */

static double number_of(uint64_t bits, spu_type type)
{
    const uint32_t word = (uint32_t)bits;
    float single;
    double value;
    memcpy(&single, &word, sizeof single);
    memcpy(&value, &bits, sizeof value);
    return type == SPU_f32 ? (double)single : value;
}

/* Rounded to the type. */
static uint64_t bits_of(double value, spu_type type)
{
    const float single = (float)value;
    uint32_t word;
    uint64_t bits;
    memcpy(&word, &single, sizeof word);
    memcpy(&bits, &value, sizeof bits);
    return type == SPU_f32 ? word : bits;
}

#ifdef _WIN32 /* MinGW-w64's fma and fmaf round twice; fused words are of processors that have the instruction */
#define FUSED_TARGET __attribute__((target("fma")))
#else
#define FUSED_TARGET
#endif
FUSED_TARGET static double fused_double(double a, double b, double c) { return fma(a, b, c); }
FUSED_TARGET static float fused_float(float a, float b, float c) { return fmaf(a, b, c); }

/* a * b + c. Products and sums of floats, computed in double, are rounded as if once. */
static double multiply_add(const spu_form *form, double a, double b, double c)
{
    const double product = a * b;
    if (form->result.type == SPU_f64)
        return form->is_fused ? fused_double(a, b, c) : product + c;
    return form->is_fused ? (double)fused_float((float)a, (float)b, (float)c) : (double)((float)product + (float)c);
}

/* The classes are bits of the mask: NaN, +infinity, -infinity, +0, -0, +denormal, -denormal from 0x40 down to 1. */
static bool has_class(uint64_t bits, uint64_t mask)
{
    const bool negative = bits >> 63;
    const uint64_t exponent = bits >> 52 & 0x7ff, fraction = bits & UINT64_C(0xfffffffffffff);
    unsigned class = 0;
    if (exponent == 0x7ff)
        class = fraction ? 0x40 : negative ? 0x10 : 0x20;
    else if (exponent == 0)
        class = fraction ? (negative ? 0x01 : 0x02) : (negative ? 0x04 : 0x08);
    return mask & class;
}

static uint64_t convert_to_int(double value, double least, double most)
{
    return isnan(value) ? 0 : (uint64_t)(int64_t)(value >= most ? most : value <= least ? least : trunc(value));
}

/* gcc would fuse the negation with a sum that is rounded before, and give a zero the other sign. */
static double negated(double rounded)
{
    const volatile double sum = rounded;
    return -sum;
}

/* An element of a word of floats: bits of the operands' elements; false where there is no such word. */
static bool float_element(const spu_form *form, const uint64_t bits[3], uint64_t *result)
{
    const spu_type type = form->operand[0].type, to = form->result.type;
    const double a = number_of(bits[0], type), b = number_of(bits[1], type), c = number_of(bits[2], type);
    const char *const word = form->word;
    const bool single = type == SPU_f32;
#define IS(name) (!strcmp(word, #name))
    if (IS(add) || IS(sub) || IS(mul))
        *result = bits_of(IS(add) ? a + b : IS(sub) ? a - b : a * b, to);
    else if (IS(madd) || IS(msub))
        *result = bits_of(multiply_add(form, a, b, IS(madd) ? c : -c), to);
    /* c - a * b in single precision (fnms); in double the machine negates a * b - c after rounding it (dfnms), so that
     * where they are equal the zero is negative */
    else if (IS(nmsub))
        *result = bits_of(single ? multiply_add(form, -a, b, c) : negated(multiply_add(form, a, b, -c)), to);
    else if (IS(nmadd))
        *result = bits_of(negated(multiply_add(form, a, b, c)), to);
    else if (IS(cmpeq) || IS(cmpgt))
        *result = (IS(cmpeq) ? a == b : a > b) ? UINT64_MAX : 0;
    else if (IS(cmpabseq) || IS(cmpabsgt))
        *result = (IS(cmpabseq) ? fabs(a) == fabs(b) : fabs(a) > fabs(b)) ? UINT64_MAX : 0;
    else if (IS(testsv))
        *result = has_class(bits[0], bits[1]) ? UINT64_MAX : 0;
    else if (IS(re) || IS(rsqrte))
        *result = bits_of(1 / (IS(re) ? a : sqrt(fabs(a))), to);
    else if (IS(convtf)) /* the nearest float of the integer, then an exact division */
        *result = bits_of(ldexp((double)(float)(type == SPU_u32 ? (double)bits[0] : (double)(int32_t)(uint32_t)bits[0]),
                                -(int)bits[1]),
                          to);
    else if (IS(convts) || IS(convtu))
        *result = IS(convts) ? convert_to_int(ldexp(a, (int)bits[1]), -2147483648.0, 2147483647.0)
                             : convert_to_int(ldexp(a, (int)bits[1]), 0, 4294967295.0);
    else
        return false;
    return true;
#undef IS
}

static spu_quad by_elements(const spu_form *form, const spu_quad in[3])
{
    spu_quad result = {{0}};
    for (int i = 0; i < spu_elements(form->result.type); i++) {
        uint64_t bits[3] = {0}, value = 0;
        for (int k = 0; k < form->operands; k++)
            bits[k] = spu_get(&in[k], form->operand[k].type, form->operand[k].is_scalar ? 0 : i);
        if (!float_element(form, bits, &value))
            fail_msg("spu_%s has no definition", form->text);
        spu_set(&result, form->result.type, i, value);
    }
    return result;
}

/* ---- words that move elements ---- */

static int index_of(const spu_form *form, const spu_quad in[3])
{
    const int last = form->operands - 1;
    return (int)(spu_get(&in[last], form->operand[last].type, 0) & ((unsigned)spu_elements(form->result.type) - 1));
}

/* Floats that become doubles, and the reverse, lie in the left half of a doubleword. */
static spu_quad change_precision(const spu_form *form, const spu_quad *in)
{
    const spu_type from = form->operand[0].type, to = form->result.type;
    spu_quad result = {{0}};
    for (int i = 0; i < 2; i++)
        spu_set(&result, to, to == SPU_f32 ? 2 * i : i,
                bits_of(number_of(spu_get(in, from, from == SPU_f32 ? 2 * i : i), from), to));
    return result;
}

spu_quad spu_reference_result(const spu_form *form, const spu_quad in[3])
{
    const row *const r = find_row(form);
    const spu_type type = form->result.type;
    if (r)
        return by_instruction(r, form, in);
    spu_quad result = !strcmp(form->word, "insert") ? in[1] : (spu_quad){{0}};
    if (!strcmp(form->word, "splats"))
        return splat(type, spu_get(&in[0], type, 0));
    if (!strcmp(form->word, "extract"))
        spu_set(&result, type, 0, spu_get(&in[0], type, index_of(form, in)));
    else if (spu_is_word_of(form->word, " insert promote "))
        spu_set(&result, type, index_of(form, in), spu_get(&in[0], type, 0));
    else if (spu_is_word_of(form->word, " extend roundtf "))
        return change_precision(form, &in[0]);
    else
        return by_elements(form, in);
    return result;
}

/* ---- comparison ---- */

static bool is_near(double operand, double got, double expected)
{
    if (!isnormal((float)operand) || !isnormal((float)expected))
        return true; /* nothing is said of these */
    return fabs(got / expected - 1) <= 0x1p-11;
}

int spu_reference_mismatch(const spu_form *form, const spu_quad operand[3], const spu_quad *got,
                           const spu_quad *expected)
{
    const spu_type type = form->result.type;
    const int count = form->result.is_scalar ? 1 : spu_elements(type);
    const bool computes =
        spu_is_float(type) && spu_is_word_of(form->word, " convtf extend roundtf add sub mul madd msub "
                                                         "nmsub nmadd ");
    const bool estimates = spu_is_word_of(form->word, " re rsqrte "), promotes = !strcmp(form->word, "promote");
    for (int i = 0; i < count; i++) {
        const uint64_t g = spu_get(got, type, i), e = spu_get(expected, type, i);
        const double x = number_of(g, type), y = number_of(e, type);
        bool good = g == e || (computes && isnan(x) && isnan(y)) || (promotes && i != index_of(form, operand));
        if (estimates)
            good = is_near(number_of(spu_get(&operand[0], type, i), type), x, y);
        if (!good)
            return i;
    }
    return -1;
}
