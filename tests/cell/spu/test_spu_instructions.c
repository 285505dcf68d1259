/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every instruction that works on registers against its definition (spu_definitions.c), on random and edge operands, in
 * every form of the interpreter that this CPU runs; and the words of all instructions, there and back. Instructions on
 * memory, branches and channels: test_spu_run.c. Doubles: test_spu_double.c. */
#include "support/test.h"

#include <stdio.h>
#include <string.h>

#include "cell/spu/execute/execute.h"
#include "cell/spu/isa/assemble.h"
#include "cell/spu/spu_definitions.h"
#include "core/memory.h"

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

static void to_bytes(const cgt_spu_register *r, uint8_t *bytes)
{
    for (int i = 0; i < 16; i++)
        bytes[i] = (uint8_t)(r->word[i / 4] >> (24 - 8 * (i % 4)));
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

static void compare(cgt_spu *spu, cgt_spu_op op, test_random *r)
{
    const cgt_spu_operands o = random_operands(r, op);
    cgt_spu_register before[CGT_SPU_REGISTERS];
    uint8_t a[16], b[16], c[16], t[16], found[16];
    for (int i = 0; i < REGISTERS; i++)
        random_register(r, &spu->reg[i]);
    memcpy(before, spu->reg, sizeof before);
    to_bytes(&before[o.ra], a);
    to_bytes(&before[o.rb], b);
    to_bytes(&before[o.rc], c);
    to_bytes(&before[o.rt], t);
    spu_definition_of(op)(o.imm, a, b, c, t);
    run_one(spu, op, &o);
    to_bytes(&spu->reg[o.rt], found);
    if (memcmp(found, t, 16) != 0) {
        const cgt_spu_register *const g = &spu->reg[o.rt], *const x = &before[o.ra], *const y = &before[o.rb];
        fail_msg("%s (%s) rt %u ra %u rb %u rc %u imm %d: %08x %08x %08x %08x of a %08x %08x %08x %08x "
                 "b %08x %08x %08x %08x; defined %02x%02x%02x%02x %02x%02x%02x%02x ...",
                 cgt_spu_isa[op].name, spu->row->name, o.rt, o.ra, o.rb, o.rc, (int)o.imm, g->word[0], g->word[1],
                 g->word[2], g->word[3], x->word[0], x->word[1], x->word[2], x->word[3], y->word[0], y->word[1],
                 y->word[2], y->word[3], t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7]);
    }
    before[o.rt] = spu->reg[o.rt];
    if (memcmp(before, spu->reg, sizeof before) != 0)
        fail_msg("%s changes a register other than rt", cgt_spu_isa[op].name);
}

/* ---- tests ---- */

static void registers(void **state)
{
    (void)state;
    const cgt_memory_hooks memory = cgt_memory_default();
    cgt_spu spu;
    assert_int_equal(cgt_spu_create(&spu, &memory, CGT_SPU_UNTIMED), CGT_OK);
    for (const cgt_spu_row *row = cgt_spu_rows; row->name; row++) {
        if (!row->runs())
            continue;
        spu.row = row;
        test_random r = random_make(290);
        for (unsigned op = CGT_SPU_FIRST_OP; op < CGT_SPU_OPS; op++)
            if (spu_definition_of((cgt_spu_op)op))
                for (uint32_t k = test_between(60, CASES); k > 0; k--)
                    compare(&spu, (cgt_spu_op)op, &r);
    }
    cgt_spu_destroy(&spu);
}

/* The instructions that have no definition are those of the other tests: a new one cannot be forgotten. */
static void every_instruction_is_tested(void **state)
{
    (void)state;
    static const char *const elsewhere =
        " lqd lqx lqa lqr stqd stqx stqa stqr hbr hbra hbrr br bra brsl brasl brz brnz brhz brhnz bi bisl biz binz bihz"
        " bihnz iret bisled stop stopd nop lnop sync dsync mtspr rdch rchcnt wrch heq heqi hgt hgti hlgt hlgti"
        " dfa dfs dfm dfma dfms dfnms dfnma fesd frds fscrrd fscrwr ";
    int count = 0;
    for (unsigned op = CGT_SPU_FIRST_OP; op < CGT_SPU_OPS; op++) {
        char name[32];
        snprintf(name, sizeof name, " %s ", cgt_spu_isa[op].name);
        if (!spu_definition_of((cgt_spu_op)op) != (strstr(elsewhere, name) != NULL))
            fail_msg("%s: defined here or tested elsewhere, one of the two", cgt_spu_isa[op].name);
        count++;
    }
    assert_int_equal(count, 194);
}

/* No word has two meanings, and what is decoded can be encoded. */
static void words_there_and_back(void **state)
{
    (void)state;
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
static void words_of_the_assembler(void **state)
{
    (void)state;
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

static void operands_that_do_not_fit(void **state)
{
    (void)state;
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

int main(void)
{
    test_begin("test_spu_instructions");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(registers),
        cmocka_unit_test(every_instruction_is_tested),
        cmocka_unit_test(words_there_and_back),
        cmocka_unit_test(words_of_the_assembler),
        cmocka_unit_test(operands_that_do_not_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
