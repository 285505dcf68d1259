/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Branches, calls and halts: where they go, and what they leave. */
#include "cell/spu/spu_fixture.h"
#include "support/suite.h"

/* A program that is one branch: falling through stops with 1, taking it with 2, 32 bytes further. */
static uint32_t branch(fixture *f, cgt_spu_op op, cgt_spu_operands o, const cgt_spu_channels *channels)
{
    f->p.count = 0;
    cgt_spu_emit(&f->p, op, o);
    CGT_SPU_ASM(&f->p, stop, .imm = 1);
    while (f->p.count < 8)
        CGT_SPU_ASM(&f->p, stop, .imm = 3);
    CGT_SPU_ASM(&f->p, stop, .imm = 2);
    const cgt_spu_end end = run(f, channels);
    if (end.reason != CGT_SPU_STOPPED)
        fail_msg("%s: %s", cgt_spu_isa[op].name, f->spu.message);
    return end.value;
}

TEST(direct_branches)
{
    fixture *f = begin(state);
    static const struct {
        cgt_spu_op op;
        uint32_t condition, code;
    } cases[] = {
        {cgt_spu_op_br, 0, 2},         {cgt_spu_op_brz, 0, 2},
        {cgt_spu_op_brz, 0x10000, 1},  {cgt_spu_op_brnz, 0, 1},
        {cgt_spu_op_brnz, 0x10000, 2}, {cgt_spu_op_brhz, 0xffff0000, 2},
        {cgt_spu_op_brhz, 1, 1},       {cgt_spu_op_brhnz, 0xffff0000, 1},
        {cgt_spu_op_brhnz, 1, 2},
    };
    for (size_t i = 0; i < TEST_COUNT(cases); i++) {
        f->spu.reg[3] = (cgt_spu_register){{cases[i].condition, 0xffffffff, 0, 0xffffffff}};
        const cgt_spu_operands o = {.rt = cases[i].op == cgt_spu_op_br ? 0 : 3, .imm = 32};
        assert_int_equal(branch(f, cases[i].op, o, NULL), cases[i].code);
    }
    assert_int_equal(branch(f, cgt_spu_op_bra, (cgt_spu_operands){.imm = PROGRAM + 32}, NULL), 2);
    /* distances wrap around the local store */
    const int32_t to_end = PROGRAM - 0x20000;
    assert_true(to_end < 0);
    cgt_spu_store32(&f->spu, (PROGRAM + 0x20000) & 0x3ffff, 0x00000007);
    f->p.count = 0;
    CGT_SPU_ASM(&f->p, br, .imm = -0x20000);
    expect_stop(f, run(f, NULL), 7);
}

TEST(calls)
{
    fixture *f = begin(state);
    static const cgt_spu_op ops[] = {cgt_spu_op_brsl, cgt_spu_op_brasl, cgt_spu_op_bisl};
    for (size_t i = 0; i < TEST_COUNT(ops); i++) {
        const bool is_indirect = ops[i] == cgt_spu_op_bisl;
        f->spu.reg[3] = (cgt_spu_register){{PROGRAM + 32, 1, 2, 3}}; /* the target, and the link */
        const cgt_spu_operands o = {.rt = 3,
                                    .ra = is_indirect ? 3 : 0,
                                    .imm = is_indirect                  ? 0
                                           : ops[i] == cgt_spu_op_brasl ? PROGRAM + 32
                                                                        : 32};
        assert_int_equal(branch(f, ops[i], o, NULL), 2);
        const cgt_spu_register link = {{PROGRAM + 4, 0, 0, 0}};
        assert_memory_equal(&f->spu.reg[3], &link, sizeof link);
    }
}

TEST(indirect_branches)
{
    fixture *f = begin(state);
    static const struct {
        cgt_spu_op op;
        uint32_t condition, code;
    } cases[] = {
        {cgt_spu_op_bi, 0, 2},         {cgt_spu_op_biz, 0, 2},
        {cgt_spu_op_biz, 0x10000, 1},  {cgt_spu_op_binz, 0, 1},
        {cgt_spu_op_binz, 0x10000, 2}, {cgt_spu_op_bihz, 0xffff0000, 2},
        {cgt_spu_op_bihz, 1, 1},       {cgt_spu_op_bihnz, 0xffff0000, 1},
        {cgt_spu_op_bihnz, 1, 2},
    };
    f->spu.reg[4].word[0] = PROGRAM + 32;
    for (size_t i = 0; i < TEST_COUNT(cases); i++) {
        f->spu.reg[3].word[0] = cases[i].condition;
        const cgt_spu_operands o = {.rt = cases[i].op == cgt_spu_op_bi ? 0 : 3, .ra = 4};
        assert_int_equal(branch(f, cases[i].op, o, NULL), cases[i].code);
    }
    f->spu.srr0 = PROGRAM + 32;
    assert_int_equal(branch(f, cgt_spu_op_iret, (cgt_spu_operands){0}, NULL), 2);
}

/* Interrupts are switched where the branch is taken. */
TEST(interrupt_bits)
{
    fixture *f = begin(state);
    f->spu.reg[4].word[0] = PROGRAM + 32;
    f->spu.reg[3].word[0] = 1;
    branch(f, cgt_spu_op_biz, (cgt_spu_operands){.rt = 3, .ra = 4, .rb = CGT_SPU_FEATURE_ENABLE}, NULL);
    assert_false(f->spu.interrupts);
    branch(f, cgt_spu_op_bi, (cgt_spu_operands){.ra = 4, .rb = CGT_SPU_FEATURE_ENABLE}, NULL);
    assert_true(f->spu.interrupts);
    branch(f, cgt_spu_op_binz, (cgt_spu_operands){.rt = 3, .ra = 4, .rb = CGT_SPU_FEATURE_DISABLE}, NULL);
    assert_false(f->spu.interrupts);
}

TEST(halts)
{
    fixture *f = begin(state);
    static const struct {
        cgt_spu_op op;
        uint32_t a, b;
        bool halts;
    } cases[] = {
        {cgt_spu_op_heq, 5, 5, true},
        {cgt_spu_op_heq, 5, 6, false},
        {cgt_spu_op_hgt, 5, 0xffffffff, true},
        {cgt_spu_op_hgt, 0xffffffff, 5, false},
        {cgt_spu_op_hlgt, 0xffffffff, 5, true},
        {cgt_spu_op_hlgt, 5, 0xffffffff, false},
        {cgt_spu_op_heqi, 0xfffffffd, 3, true},
        {cgt_spu_op_heqi, 3, 3, false},
        {cgt_spu_op_hgti, 0xfffffffe, 3, true},
        {cgt_spu_op_hgti, 0xfffffffd, 3, false},
        {cgt_spu_op_hlgti, 0xfffffffe, 3, true},
        {cgt_spu_op_hlgti, 5, 3, false},
    };
    for (size_t i = 0; i < TEST_COUNT(cases); i++) {
        f->spu.reg[3].word[0] = cases[i].a;
        f->spu.reg[4].word[0] = cases[i].b;
        const bool has_rb = cgt_spu_isa[cases[i].op].format == CGT_SPU_RR;
        f->p.count = 0;
        cgt_spu_emit(&f->p, cases[i].op,
                     (cgt_spu_operands){.ra = 3, .rb = has_rb ? 4 : 0, .imm = has_rb ? 0 : -(int32_t)cases[i].b});
        CGT_SPU_ASM(&f->p, stop, .imm = 1);
        const cgt_spu_end end = run(f, NULL);
        assert_int_equal(end.reason, cases[i].halts ? CGT_SPU_HALTED : CGT_SPU_STOPPED);
        assert_int_equal(f->spu.pc, cases[i].halts ? PROGRAM + 4 : PROGRAM + 8);
    }
}

SEEDED_SUITE("test_spu_branches", set_up, tear_down)
