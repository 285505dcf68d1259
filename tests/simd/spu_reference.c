/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words that work on the whole quad, the table of all words, and the comparison of results. */
#include "simd/spu_reference.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "simd/spu_reference_parts.h"

/* ---- on the whole quad ---- */

typedef spu_quad quad_definition(const spu_form *form, const spu_quad in[3]);

/* The value of an operand's element, of a scalar operand its value. */
static uint64_t operand_element(const spu_form *form, const spu_quad in[3], int k, int i)
{
    const spu_kind kind = form->operand[k];
    return spu_get(&in[k], kind.type, kind.is_scalar ? 0 : i);
}

static int operand_index(const spu_form *form, const spu_quad in[3], int k, spu_type type)
{
    return (int)(operand_element(form, in, k, 0) & ((unsigned)spu_elements(type) - 1));
}

static spu_quad word_extract(const spu_form *form, const spu_quad in[3])
{
    const spu_type type = form->result.type;
    spu_quad result = {{0}};
    spu_set(&result, type, 0, spu_get(&in[0], type, operand_index(form, in, 1, type)));
    return result;
}

static spu_quad word_insert(const spu_form *form, const spu_quad in[3])
{
    const spu_type type = form->result.type;
    spu_quad result = in[1];
    spu_set(&result, type, operand_index(form, in, 2, type), spu_get(&in[0], type, 0));
    return result;
}

static spu_quad word_promote(const spu_form *form, const spu_quad in[3])
{
    const spu_type type = form->result.type;
    spu_quad result = {{0}};
    spu_set(&result, type, operand_index(form, in, 1, type), spu_get(&in[0], type, 0));
    return result;
}

/* Integers: the right half of each wider element. Floats: the left one. */
static spu_quad word_extend(const spu_form *form, const spu_quad in[3])
{
    const spu_type to = form->result.type, from = form->operand[0].type;
    spu_quad result;
    for (int i = 0; i < spu_elements(to); i++) {
        if (from == SPU_f32)
            spu_set(&result, to, i, double_bits((double)float_of(spu_get(&in[0], from, 2 * i))));
        else
            spu_set(&result, to, i, (uint64_t)signed_value(spu_get(&in[0], from, 2 * i + 1), spu_bits(from)));
    }
    return result;
}

static spu_quad word_roundtf(const spu_form *form, const spu_quad in[3])
{
    (void)form;
    spu_quad result = {{0}};
    for (int i = 0; i < 2; i++)
        spu_set(&result, SPU_f32, 2 * i, float_bits((float)double_of(spu_get(&in[0], SPU_f64, i))));
    return result;
}

/* Halfword of a word: 0 the left (even) one, 1 the right (odd) one, signed as the operand is. */
static int64_t half(const spu_form *form, const spu_quad in[3], int k, int word, int which)
{
    const uint64_t value = operand_element(form, in, k, 2 * word + which);
    return form->operand[k].type == SPU_s16 ? signed_value(value, 16) : (int64_t)value;
}

/* For each word: the product of a halfword of a and one of b, shifted, plus the word of c where there is one. */
static spu_quad multiply_halves(const spu_form *form, const spu_quad in[3], int which_a, int which_b, int shift)
{
    spu_quad result;
    for (int i = 0; i < 4; i++) {
        const int64_t product = half(form, in, 0, i, which_a) * half(form, in, 1, i, which_b);
        uint64_t value = (uint64_t)product;
        if (shift > 0)
            value <<= shift;
        if (shift < 0)
            for (int n = 0; n < -shift; n++)
                value = value >> 1 | (value & UINT64_C(1) << 63);
        if (form->operands == 3)
            value += spu_get(&in[2], SPU_u32, i);
        spu_set(&result, SPU_u32, i, value);
    }
    return result;
}

static spu_quad word_mule(const spu_form *form, const spu_quad in[3]) { return multiply_halves(form, in, 0, 0, 0); }
static spu_quad word_mulo(const spu_form *form, const spu_quad in[3]) { return multiply_halves(form, in, 1, 1, 0); }
static spu_quad word_mulh(const spu_form *form, const spu_quad in[3]) { return multiply_halves(form, in, 0, 1, 16); }
static spu_quad word_mulsr(const spu_form *form, const spu_quad in[3]) { return multiply_halves(form, in, 1, 1, -16); }
static spu_quad word_mhhadd(const spu_form *form, const spu_quad in[3]) { return multiply_halves(form, in, 0, 0, 0); }

static spu_quad by_elements(const spu_form *form, const spu_quad in[3], element_definition *define);

static spu_quad word_madd(const spu_form *form, const spu_quad in[3])
{
    if (form->operand[0].type == SPU_s16)
        return multiply_halves(form, in, 1, 1, 0);
    return by_elements(form, in, element_madd);
}

static spu_quad word_sumb(const spu_form *form, const spu_quad in[3])
{
    (void)form;
    spu_quad result;
    for (int j = 0; j < 4; j++) {
        unsigned sum_a = 0, sum_b = 0;
        for (int k = 0; k < 4; k++) {
            sum_a += in[0].byte[4 * j + k];
            sum_b += in[1].byte[4 * j + k];
        }
        spu_set(&result, SPU_u16, 2 * j, sum_b);
        spu_set(&result, SPU_u16, 2 * j + 1, sum_a);
    }
    return result;
}

static spu_quad word_gather(const spu_form *form, const spu_quad in[3])
{
    const spu_type type = form->operand[0].type;
    uint64_t bits = 0;
    spu_quad result = {{0}};
    for (int i = 0; i < spu_elements(type); i++)
        bits = bits << 1 | (spu_get(&in[0], type, i) & 1);
    spu_set(&result, SPU_u32, 0, bits);
    return result;
}

/* maskb, maskh, maskw: as many low bits as there are elements, the most significant one for element 0 */
static spu_quad word_mask(const spu_form *form, const spu_quad in[3])
{
    const int count = spu_elements(form->result.type);
    const uint64_t value = spu_get(&in[0], form->operand[0].type, 0);
    spu_quad result;
    for (int i = 0; i < count; i++)
        spu_set(&result, form->result.type, i, value >> (count - 1 - i) & 1 ? UINT64_MAX : 0);
    return result;
}

static spu_quad word_shuffle(const spu_form *form, const spu_quad in[3])
{
    (void)form;
    spu_quad result;
    for (int k = 0; k < 16; k++) {
        const uint8_t c = in[2].byte[k];
        if ((c & 0xc0) == 0x80)
            result.byte[k] = 0x00;
        else if ((c & 0xe0) == 0xc0)
            result.byte[k] = 0xff;
        else if ((c & 0xe0) == 0xe0)
            result.byte[k] = 0x80;
        else
            result.byte[k] = in[c >> 4 & 1].byte[c & 15];
    }
    return result;
}

static spu_quad word_orx(const spu_form *form, const spu_quad in[3])
{
    (void)form;
    spu_quad result = {{0}};
    for (int k = 0; k < 16; k++)
        result.byte[k & 3] |= in[0].byte[k];
    return result;
}

/* Byte k comes from k + n, which is to the right; n below 0 moves to the right. */
static spu_quad move_bytes(const spu_quad *quad, int n, bool around)
{
    spu_quad result = {{0}};
    for (int k = 0; k < 16; k++) {
        const int from = k + n;
        if (around || (from >= 0 && from < 16))
            result.byte[k] = quad->byte[from & 15];
    }
    return result;
}

/* The same for bits, of which bit 0 is the most significant one of byte 0. */
static spu_quad move_bits(const spu_quad *quad, int n, bool around)
{
    spu_quad result = {{0}};
    for (int k = 0; k < 128; k++) {
        const int from = k + n;
        if ((around || (from >= 0 && from < 128)) && (quad->byte[(from & 127) / 8] >> (7 - (from & 7)) & 1))
            result.byte[k / 8] |= (uint8_t)(0x80 >> (k & 7));
    }
    return result;
}

static uint32_t quad_count(const spu_form *form, const spu_quad in[3])
{
    return (uint32_t)operand_element(form, in, 1, 0);
}

#define QUAD_WORD(name, move, n, around)                                                                               \
    static spu_quad word_##name(const spu_form *form, const spu_quad in[3])                                            \
    {                                                                                                                  \
        const uint32_t count = quad_count(form, in);                                                                   \
        return move(&in[0], n, around);                                                                                \
    }
QUAD_WORD(slqw, move_bits, (int)(count & 7), false)
QUAD_WORD(slqwbyte, move_bytes, (int)(count & 31), false)
QUAD_WORD(slqwbytebc, move_bytes, (int)(count >> 3 & 31), false)
QUAD_WORD(rlqw, move_bits, (int)(count & 7), true)
QUAD_WORD(rlqwbyte, move_bytes, (int)(count & 15), true)
QUAD_WORD(rlqwbytebc, move_bytes, (int)(count >> 3 & 15), true)
QUAD_WORD(srqw, move_bits, -(int)(count & 7), false)
QUAD_WORD(srqwbyte, move_bytes, -(int)(count & 31), false)
QUAD_WORD(srqwbytebc, move_bytes, -(int)(count >> 3 & 31), false)
QUAD_WORD(rlmaskqw, move_bits, -(int)((0 - count) & 7), false)
QUAD_WORD(rlmaskqwbyte, move_bytes, -(int)((0 - count) & 31), false)
QUAD_WORD(rlmaskqwbytebc, move_bytes, -(int)((0 - (count >> 3)) & 31), false)

/* ---- the table ---- */

typedef enum match { MATCH_BITS, MATCH_ARITHMETIC, MATCH_ONE_ELEMENT, MATCH_ESTIMATE } match;

struct spu_reference {
    const char *word;
    element_definition *by_element; /* one of the two */
    quad_definition *by_quad;
    match match;
};

#define ELEMENT(word, match)                                                                                           \
    {                                                                                                                  \
#word, word_##word, NULL, match                                                                                \
    }
#define QUAD(word, match)                                                                                              \
    {                                                                                                                  \
#word, NULL, word_##word, match                                                                                \
    }
static const spu_reference references[] = {
    ELEMENT(splats, MATCH_BITS),
    QUAD(extract, MATCH_BITS),
    QUAD(insert, MATCH_BITS),
    QUAD(promote, MATCH_ONE_ELEMENT),
    ELEMENT(convtf, MATCH_ARITHMETIC),
    ELEMENT(convts, MATCH_BITS),
    ELEMENT(convtu, MATCH_BITS),
    QUAD(extend, MATCH_ARITHMETIC),
    QUAD(roundtf, MATCH_ARITHMETIC),
    ELEMENT(add, MATCH_ARITHMETIC),
    ELEMENT(sub, MATCH_ARITHMETIC),
    ELEMENT(addx, MATCH_BITS),
    ELEMENT(subx, MATCH_BITS),
    ELEMENT(genc, MATCH_BITS),
    ELEMENT(gencx, MATCH_BITS),
    ELEMENT(genb, MATCH_BITS),
    ELEMENT(genbx, MATCH_BITS),
    ELEMENT(mul, MATCH_ARITHMETIC),
    QUAD(madd, MATCH_ARITHMETIC),
    ELEMENT(msub, MATCH_ARITHMETIC),
    ELEMENT(nmsub, MATCH_ARITHMETIC),
    ELEMENT(nmadd, MATCH_ARITHMETIC),
    QUAD(mule, MATCH_BITS),
    QUAD(mulo, MATCH_BITS),
    QUAD(mulh, MATCH_BITS),
    QUAD(mulsr, MATCH_BITS),
    QUAD(mhhadd, MATCH_BITS),
    ELEMENT(re, MATCH_ESTIMATE),
    ELEMENT(rsqrte, MATCH_ESTIMATE),
    ELEMENT(absd, MATCH_BITS),
    ELEMENT(avg, MATCH_BITS),
    QUAD(sumb, MATCH_BITS),
    ELEMENT(cmpeq, MATCH_BITS),
    ELEMENT(cmpgt, MATCH_BITS),
    ELEMENT(cmpabseq, MATCH_BITS),
    ELEMENT(cmpabsgt, MATCH_BITS),
    ELEMENT(testsv, MATCH_BITS),
    ELEMENT(cntb, MATCH_BITS),
    ELEMENT(cntlz, MATCH_BITS),
    QUAD(gather, MATCH_BITS),
    {"maskb", NULL, word_mask, MATCH_BITS},
    {"maskh", NULL, word_mask, MATCH_BITS},
    {"maskw", NULL, word_mask, MATCH_BITS},
    ELEMENT(sel, MATCH_BITS),
    QUAD(shuffle, MATCH_BITS),
    ELEMENT(and, MATCH_BITS),
    ELEMENT(or, MATCH_BITS),
    ELEMENT(xor, MATCH_BITS),
    ELEMENT(andc, MATCH_BITS),
    ELEMENT(orc, MATCH_BITS),
    ELEMENT(nand, MATCH_BITS),
    ELEMENT(nor, MATCH_BITS),
    ELEMENT(eqv, MATCH_BITS),
    QUAD(orx, MATCH_BITS),
    ELEMENT(sl, MATCH_BITS),
    ELEMENT(sr, MATCH_BITS),
    ELEMENT(sra, MATCH_BITS),
    ELEMENT(rl, MATCH_BITS),
    ELEMENT(rlmask, MATCH_BITS),
    ELEMENT(rlmaska, MATCH_BITS),
    QUAD(slqw, MATCH_BITS),
    QUAD(slqwbyte, MATCH_BITS),
    QUAD(slqwbytebc, MATCH_BITS),
    QUAD(srqw, MATCH_BITS),
    QUAD(srqwbyte, MATCH_BITS),
    QUAD(srqwbytebc, MATCH_BITS),
    QUAD(rlqw, MATCH_BITS),
    QUAD(rlqwbyte, MATCH_BITS),
    QUAD(rlqwbytebc, MATCH_BITS),
    QUAD(rlmaskqw, MATCH_BITS),
    QUAD(rlmaskqwbyte, MATCH_BITS),
    QUAD(rlmaskqwbytebc, MATCH_BITS),
};

int spu_reference_count(void) { return (int)(sizeof references / sizeof references[0]); }

const spu_reference *spu_reference_find(const char *word)
{
    for (int i = 0; i < spu_reference_count(); i++)
        if (strcmp(references[i].word, word) == 0)
            return &references[i];
    return NULL;
}

static spu_quad by_elements(const spu_form *form, const spu_quad in[3], element_definition *define)
{
    element e = {.type = form->operand[0].type, .bits = spu_bits(form->operand[0].type), .is_fused = form->is_fused};
    spu_quad result;
    for (int i = 0; i < spu_elements(form->result.type); i++) {
        e.a = operand_element(form, in, 0, i);
        e.b = form->operands > 1 ? operand_element(form, in, 1, i) : 0;
        e.c = form->operands > 2 ? operand_element(form, in, 2, i) : 0;
        spu_set(&result, form->result.type, i, define(&e));
    }
    return result;
}

spu_quad spu_reference_result(const spu_reference *reference, const spu_form *form, const spu_quad operand[3])
{
    if (reference->by_element)
        return by_elements(form, operand, reference->by_element);
    return reference->by_quad(form, operand);
}

/* ---- comparison ---- */

static bool is_near(uint64_t operand, uint64_t got, uint64_t expected)
{
    if (!isnormal(float_of(operand)) || !isnormal(float_of(expected)))
        return true; /* nothing is said of these */
    return fabs((double)float_of(got) / (double)float_of(expected) - 1) <= 0x1p-11;
}

int spu_reference_mismatch(const spu_reference *reference, const spu_form *form, const spu_quad operand[3],
                           const spu_quad *got, const spu_quad *expected)
{
    const spu_type type = form->result.type;
    const int count = form->result.is_scalar ? 1 : spu_elements(type);
    for (int i = 0; i < count; i++) {
        const uint64_t g = spu_get(got, type, i), e = spu_get(expected, type, i);
        bool good = g == e;
        switch (reference->match) {
        case MATCH_BITS: break;
        case MATCH_ARITHMETIC:
            good |= spu_is_float(type) && isnan(number_of(g, type)) && isnan(number_of(e, type));
            break;
        case MATCH_ONE_ELEMENT: good |= i != operand_index(form, operand, 1, type); break;
        case MATCH_ESTIMATE: good = is_near(spu_get(&operand[0], type, i), g, e); break;
        }
        if (!good)
            return i;
    }
    return -1;
}
