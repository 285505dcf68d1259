/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table of instructions, and both ways between words and operands. */
#include "cell/spu/isa/isa.h"

const cgt_spu_info cgt_spu_isa[CGT_SPU_OPS] = {
    {"undecoded", 0, 0, 0, 0},
    {"undefined", 0, 0, 0, 0},
    {"end", 0, 0, 0, 0},
#define CGT_SPU_ROW(name, format, opcode, class, use, ...)                                                             \
    {#name, opcode, CGT_SPU_##format, CGT_SPU_##class, CGT_SPU_##use},
#include "cell/spu/isa/rows.h"
#undef CGT_SPU_ROW
};

/* Bits of the opcode. */
static unsigned opcode_bits(unsigned format)
{
    switch (format) {
    case CGT_SPU_RRR: return 4;
    case CGT_SPU_RI8: return 10;
    case CGT_SPU_RI10:
    case CGT_SPU_RI10Q: return 8;
    case CGT_SPU_RI16:
    case CGT_SPU_RI16S:
    case CGT_SPU_RI16W: return 9;
    case CGT_SPU_RI18:
    case CGT_SPU_LBT: return 7;
    default: return 11;
    }
}

/* The bits from position low on, and the same with the highest one as sign. */
static uint32_t field(uint32_t word, unsigned low, unsigned bits) { return word >> low & ((1u << bits) - 1); }
static int32_t signed_field(uint32_t word, unsigned low, unsigned bits)
{
    const uint32_t sign = 1u << (bits - 1);
    return (int32_t)(field(word, low, bits) ^ sign) - (int32_t)sign;
}

static int32_t immediate(unsigned format, uint32_t word)
{
    switch (format) {
    case CGT_SPU_RI7: return signed_field(word, 14, 7);
    case CGT_SPU_RI8: return (int32_t)field(word, 14, 8);
    case CGT_SPU_RI10: return signed_field(word, 14, 10);
    case CGT_SPU_RI10Q: return signed_field(word, 14, 10) * 16;
    case CGT_SPU_RI16: return (int32_t)field(word, 7, 16);
    case CGT_SPU_RI16S: return signed_field(word, 7, 16);
    case CGT_SPU_RI16W:
    case CGT_SPU_LBT: return signed_field(word, 7, 16) * 4;
    case CGT_SPU_RI18: return (int32_t)field(word, 7, 18);
    case CGT_SPU_CODE: return (int32_t)field(word, 0, 14);
    default: return 0;
    }
}

/* A hint's nine bits stand in two places. */
static int32_t hint_distance(unsigned format, uint32_t word)
{
    if (format == CGT_SPU_LBT)
        return signed_field(field(word, 23, 2) << 7 | field(word, 0, 7), 0, 9) * 4;
    if (format == CGT_SPU_LBTI)
        return signed_field(field(word, 14, 2) << 7 | field(word, 0, 7), 0, 9) * 4;
    return 0;
}

static bool is_scaled(cgt_spu_op op)
{
    return op == cgt_spu_op_cflts || op == cgt_spu_op_cfltu || op == cgt_spu_op_csflt || op == cgt_spu_op_cuflt;
}

static bool scale_is_defined(cgt_spu_op op, int32_t imm)
{
    const int32_t scale = (op == cgt_spu_op_cflts || op == cgt_spu_op_cfltu ? 173 : 155) - imm;
    return scale >= 0 && scale <= 127;
}

static cgt_spu_op find_op(uint32_t word)
{
    for (unsigned op = CGT_SPU_FIRST_OP; op < CGT_SPU_OPS; op++) {
        const unsigned bits = opcode_bits(cgt_spu_isa[op].format);
        if (word >> (32 - bits) == (unsigned)cgt_spu_isa[op].opcode >> (11 - bits))
            return (cgt_spu_op)op;
    }
    return CGT_SPU_OP_UNDEFINED;
}

cgt_spu_op cgt_spu_disassemble(uint32_t word, cgt_spu_operands *operands)
{
    const cgt_spu_op op = find_op(word);
    const unsigned format = cgt_spu_isa[op].format;
    *operands = (cgt_spu_operands){0};
    if (op == CGT_SPU_OP_UNDEFINED)
        return op;
    operands->imm = immediate(format, word);
    operands->branch = hint_distance(format, word);
    if (is_scaled(op) && !scale_is_defined(op, operands->imm))
        return CGT_SPU_OP_UNDEFINED;
    const uint32_t last = field(word, 0, 7);
    if (format == CGT_SPU_RRR) {
        operands->rt = field(word, 21, 7);
        operands->rc = last;
    } else if (format != CGT_SPU_LBT && format != CGT_SPU_LBTI && format != CGT_SPU_CODE) {
        operands->rt = last;
    }
    if (format <= CGT_SPU_RI10Q || format == CGT_SPU_LBTI)
        operands->ra = field(word, 7, 7);
    if (format == CGT_SPU_RR || format == CGT_SPU_RRR)
        operands->rb = field(word, 14, 7);
    if (format == CGT_SPU_LBTI)
        operands->rb = field(word, 14, 7) & CGT_SPU_FEATURE_PREFETCH;
    return op;
}

/* ---- the other way ---- */

/* Moves units * unit to a field of that many bits. */
static bool put(uint32_t *word, int32_t value, int32_t unit, unsigned low, unsigned bits)
{
    if (value % unit)
        return false;
    *word |= ((uint32_t)(value / unit) & ((1u << bits) - 1)) << low;
    return true;
}

static bool put_immediate(unsigned format, int32_t imm, uint32_t *word)
{
    switch (format) {
    case CGT_SPU_RI7: return put(word, imm, 1, 14, 7);
    case CGT_SPU_RI8: return put(word, imm, 1, 14, 8);
    case CGT_SPU_RI10: return put(word, imm, 1, 14, 10);
    case CGT_SPU_RI10Q: return put(word, imm, 16, 14, 10);
    case CGT_SPU_RI16:
    case CGT_SPU_RI16S: return put(word, imm, 1, 7, 16);
    case CGT_SPU_RI16W:
    case CGT_SPU_LBT: return put(word, imm, 4, 7, 16);
    case CGT_SPU_RI18: return put(word, imm, 1, 7, 18);
    case CGT_SPU_CODE: return put(word, imm, 1, 0, 14);
    default: return true;
    }
}

static void put_registers(unsigned format, const cgt_spu_operands *o, uint32_t *word)
{
    if (format == CGT_SPU_RRR)
        *word |= o->rt << 21 | o->rc;
    else if (format != CGT_SPU_LBT && format != CGT_SPU_LBTI && format != CGT_SPU_CODE)
        *word |= o->rt;
    if (format <= CGT_SPU_RI10Q || format == CGT_SPU_LBTI)
        *word |= o->ra << 7;
    if (format == CGT_SPU_RR || format == CGT_SPU_RRR || format == CGT_SPU_LBTI)
        *word |= o->rb << 14;
}

static void put_distance(unsigned format, int32_t branch, uint32_t *word)
{
    const uint32_t distance = (uint32_t)(branch / 4);
    if (format == CGT_SPU_LBT)
        *word |= (distance >> 7 & 3) << 23 | (distance & 127);
    if (format == CGT_SPU_LBTI)
        *word |= (distance >> 7 & 3) << 14 | (distance & 127);
}

static bool same_operands(const cgt_spu_operands *a, const cgt_spu_operands *b)
{
    return a->rt == b->rt && a->ra == b->ra && a->rb == b->rb && a->rc == b->rc && a->imm == b->imm &&
           a->branch == b->branch;
}

/* Whatever does not fit comes back as another operand. */
bool cgt_spu_encode(cgt_spu_op op, const cgt_spu_operands *operands, uint32_t *word)
{
    cgt_spu_operands again;
    *word = 0;
    if (op < CGT_SPU_FIRST_OP || op >= CGT_SPU_OPS || operands->branch % 4)
        return false;
    if ((operands->rt | operands->ra | operands->rb | operands->rc) >= 128)
        return false;
    const unsigned format = cgt_spu_isa[op].format;
    *word = (uint32_t)cgt_spu_isa[op].opcode << 21;
    put_registers(format, operands, word);
    put_distance(format, operands->branch, word);
    return put_immediate(format, operands->imm, word) && cgt_spu_disassemble(*word, &again) == op &&
           same_operands(operands, &again);
}
