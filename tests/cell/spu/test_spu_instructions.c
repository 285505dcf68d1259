/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Instructions that work on registers, in every form of the interpreter that this CPU runs. Those that are words of the
 * vocabulary meet its mappings in test_spu_words.c. Here the others follow from them: an immediate operand gives what
 * the same number in a register gives, and so do operands that share registers, while no register but rt changes. What
 * is left has a definition: controls for insertions, constants, and floats by the model in integers. And the words of
 * all instructions, there and back. Instructions on memory, branches and channels: test_spu_run.c. Doubles:
 * test_spu_double.c. */
#include "support/test.h"
#include "support/suite.h"

#include <string.h>

#include "cell/spu/execute/execute.h"
#include "cell/spu/isa/assemble.h"
#include "core/memory.h"
#include "simd/spu_reference.h"
#include "spu/spu_float_model.h"

enum { REGISTERS = 6, CASES = 1500 }; /* few registers, so that operands coincide */

/* ---- operands ---- */

static uint32_t random_word(test_random *r)
{
    static const uint32_t edges[] = {0,          1,          0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffe, 0x0000ffff,
                                     0xffff0000, 0x80008000, 0x7fff7fff, 0x00800000, 0x007fffff, 0x80800000, 0x7f7fffff,
                                     0x7f800000, 0xff800000, 0x7fc00000, 0x3f800000, 0xbf800000, 0x4f000000, 0xcf000000,
                                     0x4f800000, 0x4effffff, 0x80818283, 0xc0c1e0e1, 0x10111213};
    switch (random_below(r, 5)) {
    case 0: return edges[random_below(r, TEST_COUNT(edges))];
    case 1: return random_below(r, 140) - 70;                                                    /* counts of shifts */
    case 2: return random_below(r, 32) * 0x01010101u;                                            /* bytes to shuffle */
    case 3: return ((uint32_t)random_bits(r) & 0x807fffffu) | (100 + random_below(r, 60)) << 23; /* ordinary floats */
    default: return (uint32_t)random_bits(r);
    }
}

static void random_register(test_random *r, cgt_spu_register *to)
{
    const bool same = random_below(r, 4) == 0;
    for (int i = 0; i < 4; i++)
        to->word[i] = same && i ? to->word[0] : random_word(r);
}

static cgt_spu_operands random_operands(test_random *r, cgt_spu_op op)
{
    cgt_spu_operands o = {0};
    uint32_t word;
    do {
        const uint32_t bits = (uint32_t)random_bits(r);
        word = (uint32_t)cgt_spu_isa[op].opcode << 21 | (bits & 0x1fffffu);
        if (cgt_spu_isa[op].format == CGT_SPU_RRR)
            word = (word & 0xf0000000u) | (bits & 0x0fffffffu);
        else if (cgt_spu_isa[op].format == CGT_SPU_RI18)
            word = (word & 0xfe000000u) | (bits & 0x01ffffffu);
        else if (cgt_spu_isa[op].format == CGT_SPU_RI10)
            word = (word & 0xff000000u) | (bits & 0x00ffffffu);
        else if (cgt_spu_isa[op].format == CGT_SPU_RI16 || cgt_spu_isa[op].format == CGT_SPU_RI16S)
            word = (word & 0xff800000u) | (bits & 0x007fffffu);
        else if (cgt_spu_isa[op].format == CGT_SPU_RI8)
            word = (word & 0xffc00000u) | (bits & 0x003fffffu);
    } while (cgt_spu_disassemble(word, &o) != op);
    o.rt = random_below(r, REGISTERS);
    o.ra = o.ra ? random_below(r, REGISTERS) : 0;
    o.rb = o.rb ? random_below(r, REGISTERS) : 0;
    o.rc = o.rc ? random_below(r, REGISTERS) : 0;
    return o;
}

/* ---- immediate operands ---- */

/* The instruction that has the number in a register: as a byte, halfword or word in each element of rb, or in ra. */
typedef struct immediate {
    cgt_spu_op op, of_register;
    int bytes; /* 0: ra */
} immediate;

#define IMMEDIATE(op, of_register, bytes)                                                                              \
    {                                                                                                                  \
        cgt_spu_op_##op, cgt_spu_op_##of_register, bytes                                                               \
    }
/* clang-format off */
static const immediate immediates[] = {
    IMMEDIATE(ai, a, 4), IMMEDIATE(ahi, ah, 2), IMMEDIATE(sfi, sf, 4), IMMEDIATE(sfhi, sfh, 2),
    IMMEDIATE(mpyi, mpy, 4), IMMEDIATE(mpyui, mpyu, 4),
    IMMEDIATE(ceqbi, ceqb, 1), IMMEDIATE(ceqhi, ceqh, 2), IMMEDIATE(ceqi, ceq, 4),
    IMMEDIATE(cgtbi, cgtb, 1), IMMEDIATE(cgthi, cgth, 2), IMMEDIATE(cgti, cgt, 4),
    IMMEDIATE(clgtbi, clgtb, 1), IMMEDIATE(clgthi, clgth, 2), IMMEDIATE(clgti, clgt, 4),
    IMMEDIATE(andbi, and, 1), IMMEDIATE(andhi, and, 2), IMMEDIATE(andi, and, 4),
    IMMEDIATE(orbi, or, 1), IMMEDIATE(orhi, or, 2), IMMEDIATE(ori, or, 4),
    IMMEDIATE(xorbi, xor, 1), IMMEDIATE(xorhi, xor, 2), IMMEDIATE(xori, xor, 4),
    IMMEDIATE(shli, shl, 4), IMMEDIATE(shlhi, shlh, 2), IMMEDIATE(roti, rot, 4), IMMEDIATE(rothi, roth, 2),
    IMMEDIATE(rotmi, rotm, 4), IMMEDIATE(rothmi, rothm, 2), IMMEDIATE(rotmai, rotma, 4), IMMEDIATE(rotmahi, rotmah, 2),
    IMMEDIATE(shlqbii, shlqbi, 4), IMMEDIATE(shlqbyi, shlqby, 4), IMMEDIATE(rotqbii, rotqbi, 4),
    IMMEDIATE(rotqbyi, rotqby, 4), IMMEDIATE(rotqmbii, rotqmbi, 4), IMMEDIATE(rotqmbyi, rotqmby, 4),
    IMMEDIATE(cbd, cbx, 4), IMMEDIATE(chd, chx, 4), IMMEDIATE(cwd, cwx, 4), IMMEDIATE(cdd, cdx, 4),
    IMMEDIATE(fsmbi, fsmb, 0),
};
/* clang-format on */

static const immediate *find_immediate(cgt_spu_op op)
{
    for (size_t i = 0; i < TEST_COUNT(immediates); i++)
        if (immediates[i].op == op)
            return &immediates[i];
    return NULL;
}

static uint32_t spread(int32_t imm, int bytes)
{
    const uint32_t n = (uint32_t)imm;
    return bytes == 1 ? (n & 0xff) * 0x01010101u : bytes == 2 ? (n & 0xffff) * 0x00010001u : n;
}

/* ---- definitions ---- */

/* Bytes of the first register behind 0x10, those of the second below; `first` is the preferred slot's first byte. */
static uint32_t insertion(uint32_t address, uint32_t bytes, uint32_t first, uint32_t word)
{
    const uint32_t at = address % 16 / bytes * bytes;
    uint32_t control = 0;
    for (uint32_t k = 4 * word; k < 4 * word + 4; k++)
        control = control << 8 | (k >= at && k < at + bytes ? first + k - at : 16 + k);
    return control;
}

/* Word i of what an instruction gives that is neither a word of the vocabulary nor one of the immediate ones; false: it
 * is tested elsewhere. a, b, c: word i of ra, rb, rc; t: of rt before. address: ra and rb, added. */
static bool define(cgt_spu_op op, int32_t imm, uint32_t i, uint32_t address, uint32_t a, uint32_t b, uint32_t c,
                   uint32_t *t)
{
    const uint32_t n = (uint32_t)imm;
#define DEFINE(name, value)                                                                                            \
    case cgt_spu_op_##name: *t = value; return true
    switch (op) {
        DEFINE(il, n);
        DEFINE(ilh, spread(imm, 2));
        DEFINE(ilhu, n << 16);
        DEFINE(ila, n);
        DEFINE(iohl, *t | n);
        DEFINE(cbx, insertion(address, 1, 3, i));
        DEFINE(chx, insertion(address, 2, 2, i));
        DEFINE(cwx, insertion(address, 4, 0, i));
        DEFINE(cdx, insertion(address, 8, 0, i));
        DEFINE(mfspr, 0);
        DEFINE(fa, cgt_spu_model_add(a, b));
        DEFINE(fs, cgt_spu_model_sub(a, b));
        DEFINE(fm, cgt_spu_model_mul(a, b));
        DEFINE(fma, cgt_spu_model_madd(a, b, c));
        DEFINE(fms, cgt_spu_model_msub(a, b, c));
        DEFINE(fnms, cgt_spu_model_nmsub(a, b, c));
        DEFINE(fceq, cgt_spu_model_cmpeq(a, b));
        DEFINE(fcgt, cgt_spu_model_cmpgt(a, b));
        DEFINE(fcmeq, cgt_spu_model_cmpabseq(a, b));
        DEFINE(fcmgt, cgt_spu_model_cmpabsgt(a, b));
        DEFINE(frest, cgt_spu_model_frest(a));
        DEFINE(frsqest, cgt_spu_model_frsqest(a));
        DEFINE(fi, cgt_spu_model_fi(a, b));
        DEFINE(cflts, cgt_spu_model_convts(a, 173 - imm));
        DEFINE(cfltu, cgt_spu_model_convtu(a, 173 - imm));
        DEFINE(csflt, cgt_spu_model_convtf_s32(a, 155 - imm));
        DEFINE(cuflt, cgt_spu_model_convtf_u32(a, 155 - imm));
    default: return false;
    }
#undef DEFINE
}

/* ---- one case ---- */

static void run_one(cgt_spu *spu, cgt_spu_op op, const cgt_spu_operands *o)
{
    uint32_t word[2];
    cgt_spu_assembler p = {.word = word, .capacity = 2};
    cgt_spu_emit(&p, op, *o);
    CGT_SPU_ASM(&p, stop, .imm = 1);
    assert_true(cgt_spu_assembler_load(&p, spu));
    const cgt_spu_end end = cgt_spu_run(spu, NULL, UINT64_MAX);
    if (end.reason != CGT_SPU_STOPPED)
        fail_msg("%s: %s", cgt_spu_isa[op].name, spu->message);
}

/* What rt becomes: by definition, or by the same operands in registers of their own. */
static cgt_spu_register expected_result(cgt_spu *spu, cgt_spu_op op, const cgt_spu_operands *o)
{
    enum { A = REGISTERS, B, C, T };
    const int use = cgt_spu_isa[op].use;
    const immediate *const m = find_immediate(op);
    cgt_spu_register *const reg = spu->reg, result = reg[o->rt];
    bool is_defined = false;
    for (uint32_t i = 0; i < 4; i++)
        is_defined = define(op, o->imm, i, reg[o->ra].word[0] + reg[o->rb].word[0], reg[o->ra].word[i],
                            reg[o->rb].word[i], reg[o->rc].word[i], &result.word[i]);
    if (is_defined)
        return result;
    cgt_spu_operands apart = {.rt = T,
                              .ra = use & CGT_SPU_READS_A ? A : 0,
                              .rb = use & CGT_SPU_READS_B ? B : 0,
                              .rc = use & CGT_SPU_READS_C ? C : 0,
                              .imm = o->imm};
    reg[A] = reg[o->ra];
    reg[B] = reg[o->rb];
    reg[C] = reg[o->rc];
    reg[T] = reg[o->rt];
    if (m) {
        for (int i = 0; i < 4; i++)
            reg[m->bytes ? B : A].word[i] = spread(o->imm, m->bytes);
        apart = (cgt_spu_operands){.rt = T, .ra = A, .rb = m->bytes ? B : 0};
    }
    run_one(spu, m ? m->of_register : op, &apart);
    return reg[T];
}

static void compare(cgt_spu *spu, cgt_spu_op op, test_random *r)
{
    const cgt_spu_operands o = random_operands(r, op);
    cgt_spu_register before[REGISTERS];
    for (int i = 0; i < REGISTERS; i++)
        random_register(r, &spu->reg[i]);
    memcpy(before, spu->reg, sizeof before);
    const cgt_spu_register t = expected_result(spu, op, &o), *const found = &spu->reg[o.rt];
    assert_memory_equal(before, spu->reg, sizeof before);
    run_one(spu, op, &o);
    if (memcmp(found, &t, sizeof t) != 0)
        fail_msg("%s (%s) rt %u ra %u rb %u rc %u imm %d: %08x %08x %08x %08x, not %08x %08x %08x %08x",
                 cgt_spu_isa[op].name, spu->row->name, o.rt, o.ra, o.rb, o.rc, (int)o.imm, found->word[0],
                 found->word[1], found->word[2], found->word[3], t.word[0], t.word[1], t.word[2], t.word[3]);
    before[o.rt] = *found;
    if (memcmp(before, spu->reg, sizeof before) != 0)
        fail_msg("%s changes a register other than rt", cgt_spu_isa[op].name);
}

/* ---- tests ---- */

static bool is_of_this_test(cgt_spu_op op)
{
    uint32_t t = 0;
    return spu_reference_uses(op) || find_immediate(op) || define(op, 100, 0, 0, 0, 0, 0, &t);
}

TEST(registers)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    cgt_spu spu;
    assert_int_equal(cgt_spu_create(&spu, &memory, CGT_SPU_UNTIMED), CGT_OK);
    for (const cgt_spu_row *row = cgt_spu_rows; row->name; row++) {
        if (!row->runs())
            continue;
        spu.row = row;
        test_random r = random_make(290);
        for (unsigned op = CGT_SPU_FIRST_OP; op < CGT_SPU_OPS; op++)
            for (uint32_t k = is_of_this_test((cgt_spu_op)op) ? test_between(60, CASES) : 0; k > 0; k--)
                compare(&spu, (cgt_spu_op)op, &r);
    }
    cgt_spu_destroy(&spu);
}

/* The other instructions are those of the other tests: a new one cannot be forgotten. */
TEST(every_instruction_is_tested)
{
    static const char *const elsewhere =
        " lqd lqx lqa lqr stqd stqx stqa stqr hbr hbra hbrr br bra brsl brasl brz brnz brhz brhnz bi bisl biz binz bihz"
        " bihnz iret bisled stop stopd nop lnop sync dsync mtspr rdch rchcnt wrch heq heqi hgt hgti hlgt hlgti"
        " dfa dfs dfm dfma dfms dfnms dfnma fesd frds fscrrd fscrwr ";
    int count = 0;
    for (unsigned op = CGT_SPU_FIRST_OP; op < CGT_SPU_OPS; op++) {
        if (is_of_this_test((cgt_spu_op)op) == spu_is_word_of(cgt_spu_isa[op].name, elsewhere))
            fail_msg("%s: tested here or elsewhere, one of the two", cgt_spu_isa[op].name);
        count++;
    }
    assert_int_equal(count, 194);
}

/* No word has two meanings, and what is decoded can be encoded. */
TEST(words_there_and_back)
{
    test_random r = random_make(291);
    uint32_t undefined = 0;
    for (uint32_t opcode = 0; opcode < 2048; opcode++) {
        for (int k = 0; k < 200; k++) {
            const uint32_t word = opcode << 21 | ((uint32_t)random_bits(&r) & 0x1fffffu);
            cgt_spu_operands o, again;
            uint32_t encoded;
            const cgt_spu_op op = cgt_spu_disassemble(word, &o);
            undefined += op == CGT_SPU_OP_UNDEFINED;
            if (op == CGT_SPU_OP_UNDEFINED)
                continue;
            assert_true(cgt_spu_encode(op, &o, &encoded));
            assert_int_equal(cgt_spu_disassemble(encoded, &again), op);
            if (o.rt != again.rt || o.ra != again.ra || o.rb != again.rb || o.rc != again.rc || o.imm != again.imm ||
                o.branch != again.branch)
                fail_msg("%s: 0x%08x becomes 0x%08x", cgt_spu_isa[op].name, (unsigned)word, (unsigned)encoded);
        }
    }
    assert_true(undefined > 0);
    for (unsigned op = CGT_SPU_FIRST_OP; op < CGT_SPU_OPS; op++)
        for (unsigned other = CGT_SPU_FIRST_OP; other < op; other++)
            if (cgt_spu_isa[op].opcode == cgt_spu_isa[other].opcode)
                fail_msg("%s and %s have one opcode", cgt_spu_isa[op].name, cgt_spu_isa[other].name);
}

/* Words as GNU as makes them. */
TEST(words_of_the_assembler)
{
    static const struct {
        cgt_spu_op op;
        cgt_spu_operands o;
        uint32_t word;
    } known[] = {
        {cgt_spu_op_stop, {.imm = 0x2000}, 0x00002000},
        {cgt_spu_op_lnop, {0}, 0x00200000},
        {cgt_spu_op_nop, {.rt = 127}, 0x4020007f},
        {cgt_spu_op_bi, {0}, 0x35000000},
        {cgt_spu_op_il, {.rt = 3, .imm = -1}, 0x40ffff83},
        {cgt_spu_op_ila, {.rt = 1, .imm = 0x3ffe0}, 0x43fff001},
        {cgt_spu_op_stqd, {.ra = 1, .imm = 16}, 0x24004080},
        {cgt_spu_op_lqd, {.ra = 1, .imm = 16}, 0x34004080},
        {cgt_spu_op_ai, {.rt = 1, .ra = 1, .imm = -32}, 0x1cf80081},
    };
    for (size_t i = 0; i < TEST_COUNT(known); i++) {
        uint32_t word;
        assert_true(cgt_spu_encode(known[i].op, &known[i].o, &word));
        assert_int_equal(word, known[i].word);
    }
}

TEST(operands_that_do_not_fit)
{
    static const struct {
        cgt_spu_op op;
        cgt_spu_operands o;
    } bad[] = {
        {cgt_spu_op_ai, {.imm = 512}},      {cgt_spu_op_ai, {.imm = -513}},      {cgt_spu_op_a, {.rt = 128}},
        {cgt_spu_op_lqd, {.imm = 8}},       {cgt_spu_op_lqd, {.imm = 8192}},     {cgt_spu_op_br, {.imm = 2}},
        {cgt_spu_op_br, {.imm = 131072}},   {cgt_spu_op_hbrr, {.branch = 1024}}, {cgt_spu_op_hbrr, {.branch = 2}},
        {cgt_spu_op_ila, {.imm = 0x40000}}, {cgt_spu_op_cflts, {.imm = 174}},    {cgt_spu_op_cuflt, {.imm = 27}},
        {cgt_spu_op_a, {.imm = 1}},         {CGT_SPU_OP_UNDEFINED, {.imm = 0}},
    };
    for (size_t i = 0; i < TEST_COUNT(bad); i++) {
        uint32_t word;
        if (cgt_spu_encode(bad[i].op, &bad[i].o, &word))
            fail_msg("operands %u, of %s, are taken", (unsigned)i, cgt_spu_isa[bad[i].op].name);
    }
}

SEEDED_SUITE("test_spu_instructions", NULL, NULL)
