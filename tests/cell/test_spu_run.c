/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Instructions on memory, branches, halts and channels; how runs end and go on; every error by its sentence. */
#include "support/test.h"

#include <fenv.h>
#include <string.h>

#include "cell/spu/isa/assemble.h"
#include "core/memory.h"

#define PROGRAM 0x400 /* where the programs of this file stand */
#define WORDS 64

typedef struct fixture {
    cgt_spu spu;
    uint32_t word[WORDS];
    cgt_spu_assembler p;
} fixture;

static fixture *begin(void **state)
{
    fixture *f = *state;
    memset(f->spu.reg, 0, sizeof f->spu.reg);
    memset(f->spu.local_store, 0, CGT_SPU_LOCAL_STORE);
    cgt_spu_forget(&f->spu, 0, CGT_SPU_LOCAL_STORE);
    f->spu.cycle = f->spu.instructions = 0;
    f->spu.srr0 = 0;
    f->spu.interrupts = false;
    f->p = (cgt_spu_assembler){.word = f->word, .capacity = WORDS, .address = PROGRAM};
    return f;
}

static void load(fixture *f) { assert_true(cgt_spu_assembler_load(&f->p, &f->spu)); }

static cgt_spu_end run(fixture *f, const cgt_spu_channels *channels)
{
    load(f);
    return cgt_spu_run(&f->spu, channels, UINT64_MAX);
}

static void expect_stop(fixture *f, cgt_spu_end end, uint32_t code)
{
    if (end.reason != CGT_SPU_STOPPED)
        fail_msg("no stop, but reason %d: %s", (int)end.reason, f->spu.message);
    assert_int_equal(end.value, code);
}

static void expect_error(fixture *f, cgt_spu_end end, uint32_t pc, const char *text)
{
    assert_int_equal(end.reason, CGT_SPU_ERROR);
    assert_int_equal(f->spu.pc, pc);
    if (!strstr(f->spu.message, text))
        fail_msg("\"%s\" does not say \"%s\"", f->spu.message, text);
}

/* ---- memory ---- */

static void fill(fixture *f, uint32_t address)
{
    for (uint32_t i = 0; i < 16; i++)
        f->spu.local_store[address + i] = (uint8_t)(0xa0 + i);
}

static void expect_filled(const cgt_spu_register *r)
{
    for (uint32_t i = 0; i < 4; i++)
        assert_int_equal(r->word[i], 0xa0a1a2a3u + 0x04040404u * i);
}

static void loads(void **state)
{
    fixture *f = begin(state);
    fill(f, 0x2010);
    fill(f, 0x3fff0);
    f->spu.reg[4].word[0] = 0x2000 + 7; /* the low four bits are dropped */
    f->spu.reg[5].word[0] = 0x15;
    f->spu.reg[6].word[0] = 0xffff2010; /* wraps around */
    CGT_SPU_ASM(&f->p, lqd, .rt = 10, .ra = 4, .imm = 16);
    CGT_SPU_ASM(&f->p, lqx, .rt = 11, .ra = 4, .rb = 5);
    CGT_SPU_ASM(&f->p, lqa, .rt = 12, .imm = 0x2014);
    CGT_SPU_ASM(&f->p, lqr, .rt = 13, .imm = cgt_spu_distance(&f->p, 0x2018));
    CGT_SPU_ASM(&f->p, lqd, .rt = 14, .ra = 6);
    CGT_SPU_ASM(&f->p, lqa, .rt = 15, .imm = -4);
    CGT_SPU_ASM(&f->p, lqd, .rt = 16, .ra = 0, .imm = -16);
    CGT_SPU_ASM(&f->p, stop, .imm = 5);
    fill(f, 0xffff2010 & 0x3fff0);
    expect_stop(f, run(f, NULL), 5);
    for (int i = 10; i <= 16; i++)
        expect_filled(&f->spu.reg[i]);
}

static void stores(void **state)
{
    fixture *f = begin(state);
    f->spu.reg[3] = (cgt_spu_register){{0x00010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f}};
    f->spu.reg[4].word[0] = 0x2000;
    f->spu.reg[5].word[0] = 0x3f;
    CGT_SPU_ASM(&f->p, stqd, .rt = 3, .ra = 4, .imm = -16);
    CGT_SPU_ASM(&f->p, stqx, .rt = 3, .ra = 4, .rb = 5);
    CGT_SPU_ASM(&f->p, stqa, .rt = 3, .imm = 0x3000);
    CGT_SPU_ASM(&f->p, stqr, .rt = 3, .imm = cgt_spu_distance(&f->p, 0x3104));
    CGT_SPU_ASM(&f->p, stop, .imm = 5);
    expect_stop(f, run(f, NULL), 5);
    static const uint32_t at[] = {0x1ff0, 0x2030, 0x3000, 0x3100};
    for (size_t k = 0; k < TEST_COUNT(at); k++)
        for (uint32_t i = 0; i < 16; i++) /* byte 0 first, on every host */
            assert_int_equal(f->spu.local_store[at[k] + i], i);
    assert_int_equal(cgt_spu_load32(&f->spu, 0x2034), 0x04050607);
    assert_int_equal(cgt_spu_load32(&f->spu, 0xfffc2037), 0x04050607);
}

/* What is decoded is forgotten when it is overwritten: by a store, and from outside. */
static void code_that_changes(void **state)
{
    fixture *f = begin(state);
    uint32_t changed;
    assert_true(cgt_spu_encode(cgt_spu_op_il, &(cgt_spu_operands){.rt = 9, .imm = 2}, &changed));
    f->spu.reg[3].word[0] = changed;
    CGT_SPU_ASM(&f->p, brsl, .rt = 20, .imm = 16); /* once, so that it is decoded */
    CGT_SPU_ASM(&f->p, stqa, .rt = 3, .imm = PROGRAM + 16);
    CGT_SPU_ASM(&f->p, br, .imm = 8);
    CGT_SPU_ASM(&f->p, stop, .imm = 9);
    CGT_SPU_ASM(&f->p, il, .rt = 9, .imm = 1); /* the quadword that is overwritten: il 2, stop 0, ... */
    CGT_SPU_ASM(&f->p, bi, .ra = 20);
    expect_stop(f, run(f, NULL), 0);
    assert_int_equal(f->spu.reg[9].word[0], 2);
    assert_true(cgt_spu_encode(cgt_spu_op_il, &(cgt_spu_operands){.rt = 9, .imm = 3}, &changed));
    cgt_spu_store32(&f->spu, PROGRAM + 16, changed);
    f->spu.pc = PROGRAM + 16;
    expect_stop(f, cgt_spu_run(&f->spu, NULL, UINT64_MAX), 0);
    assert_int_equal(f->spu.reg[9].word[0], 3);
    assert_true(cgt_spu_encode(cgt_spu_op_il, &(cgt_spu_operands){.rt = 9, .imm = 4}, &changed));
    assert_true(cgt_spu_copy_in(&f->spu, PROGRAM + 16, &changed, 4));
    f->spu.pc = PROGRAM + 16;
    expect_stop(f, cgt_spu_run(&f->spu, NULL, UINT64_MAX), 0);
    assert_int_equal(f->spu.reg[9].word[0], 4);
}

static void copies(void **state)
{
    fixture *f = begin(state);
    const uint32_t words[3] = {0x01020304, 0x05060708, 0x090a0b0c};
    const uint16_t half = 0x0102;
    const uint8_t byte = 0x5a;
    uint32_t back[3] = {0};
    uint16_t half_back = 0;
    uint8_t byte_back = 0;
    assert_true(cgt_spu_copy_in(&f->spu, 0x1000, words, sizeof words));
    for (uint32_t i = 0; i < 12; i++)
        assert_int_equal(f->spu.local_store[0x1000 + i], i + 1);
    assert_true(cgt_spu_copy_out(&f->spu, 0x1000, back, sizeof back));
    assert_memory_equal(words, back, sizeof words);
    assert_true(cgt_spu_copy_in(&f->spu, 0x1022, &half, 2));
    assert_int_equal(cgt_spu_load32(&f->spu, 0x1020), 0x00000102);
    assert_true(cgt_spu_copy_out(&f->spu, 0x1022, &half_back, 2));
    assert_int_equal(half_back, half);
    assert_true(cgt_spu_copy_in(&f->spu, 0x1031, &byte, 1));
    assert_int_equal(cgt_spu_load32(&f->spu, 0x1030), 0x005a0000);
    assert_true(cgt_spu_copy_out(&f->spu, 0x1031, &byte_back, 1));
    assert_int_equal(byte_back, byte);
    assert_true(cgt_spu_copy_in(&f->spu, CGT_SPU_LOCAL_STORE, words, 0));
    assert_true(cgt_spu_copy_in(&f->spu, CGT_SPU_LOCAL_STORE - 12, words, 12));
    assert_false(cgt_spu_copy_in(&f->spu, CGT_SPU_LOCAL_STORE - 8, words, 12));
    assert_false(cgt_spu_copy_in(&f->spu, 0xfffffffc, words, 12));
    assert_false(cgt_spu_copy_in(&f->spu, 0, words, 6));
    assert_false(cgt_spu_copy_out(&f->spu, CGT_SPU_LOCAL_STORE - 8, back, 12));
    assert_false(cgt_spu_copy_out(&f->spu, 0, back, SIZE_MAX - 3));
}

/* ---- branches ---- */

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

static void direct_branches(void **state)
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

static void calls(void **state)
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

static void indirect_branches(void **state)
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
static void interrupt_bits(void **state)
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

static void halts(void **state)
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

/* ---- channels ---- */

typedef struct log {
    unsigned reads, writes, counts, stalls;
    uint32_t written, events;
    uint64_t cycle;
    int rounding;
} log;

static cgt_channel_status read_channel(void *user, unsigned channel, uint64_t cycle, uint32_t *value)
{
    log *l = user;
    l->cycle = cycle;
    l->rounding = fegetround();
    if (channel == 100)
        return CGT_CHANNEL_ERROR;
    if (l->stalls && l->stalls--)
        return CGT_CHANNEL_STALL;
    l->reads++;
    *value = 1000 + channel;
    return CGT_CHANNEL_DONE;
}
static cgt_channel_status write_channel(void *user, unsigned channel, uint64_t cycle, uint32_t value)
{
    log *l = user;
    l->cycle = cycle;
    if (l->stalls && l->stalls--)
        return CGT_CHANNEL_STALL;
    l->writes++;
    l->written = value + channel;
    return CGT_CHANNEL_DONE;
}
static uint32_t count_channel(void *user, unsigned channel, uint64_t cycle)
{
    log *l = user;
    (void)cycle;
    l->counts++;
    return channel == 0 ? l->events : 2000 + channel;
}

static void channels(void **state)
{
    fixture *f = begin(state);
    log l = {.stalls = 2};
    const cgt_spu_channels c = {&l, read_channel, write_channel, count_channel};
    f->spu.reg[3].word[0] = 50;
    CGT_SPU_ASM(&f->p, nop, 0);
    CGT_SPU_ASM(&f->p, wrch, .rt = 3, .ra = 21);
    CGT_SPU_ASM(&f->p, rdch, .rt = 4, .ra = 24);
    CGT_SPU_ASM(&f->p, rchcnt, .rt = 5, .ra = 29);
    CGT_SPU_ASM(&f->p, stop, .imm = 1);
    load(f);
    for (int i = 0; i < 2; i++) {
        const cgt_spu_end end = cgt_spu_run(&f->spu, &c, UINT64_MAX);
        assert_int_equal(end.reason, CGT_SPU_STALLED);
        assert_int_equal(end.value, 21);
        assert_int_equal(f->spu.pc, PROGRAM + 4);
        assert_int_equal(f->spu.instructions, 1);
        assert_int_equal(l.cycle, i ? 501 : 1);
        f->spu.cycle = 501;
    }
    expect_stop(f, cgt_spu_run(&f->spu, &c, UINT64_MAX), 1);
    assert_int_equal(l.writes, 1);
    assert_int_equal(l.written, 71);
    const cgt_spu_register read = {{1024, 0, 0, 0}}, count = {{2029, 0, 0, 0}};
    assert_memory_equal(&f->spu.reg[4], &read, 16);
    assert_memory_equal(&f->spu.reg[5], &count, 16);
    assert_int_equal(l.cycle, 502);
}

static void own_channels(void **state)
{
    fixture *f = begin(state);
    f->spu.reg[3].word[0] = 0xfff81237;
    f->spu.interrupts = true;
    CGT_SPU_ASM(&f->p, wrch, .rt = 3, .ra = 14);
    CGT_SPU_ASM(&f->p, rdch, .rt = 4, .ra = 15);
    CGT_SPU_ASM(&f->p, rdch, .rt = 5, .ra = 13);
    CGT_SPU_ASM(&f->p, rchcnt, .rt = 6, .ra = 15);
    CGT_SPU_ASM(&f->p, stop, .imm = 1);
    expect_stop(f, run(f, NULL), 1);
    assert_int_equal(f->spu.reg[4].word[0], 0x01234);
    assert_int_equal(f->spu.reg[5].word[0], 1);
    assert_int_equal(f->spu.reg[6].word[0], 1);
}

static void calls_by_event(void **state)
{
    fixture *f = begin(state);
    log l = {.events = 0};
    const cgt_spu_channels c = {&l, read_channel, write_channel, count_channel};
    for (uint32_t events = 0; events < 2; events++) {
        l.events = events;
        f->spu.reg[4].word[0] = PROGRAM + 32;
        assert_int_equal(branch(f, cgt_spu_op_bisled, (cgt_spu_operands){.rt = 3, .ra = 4}, &c), 1 + events);
        assert_int_equal(f->spu.reg[3].word[0], PROGRAM + 4); /* the link, either way */
    }
}

/* The caller's rounding holds while its functions run, and afterwards. */
static void floating_point_environment(void **state)
{
    fixture *f = begin(state);
    log l = {0};
    const cgt_spu_channels c = {&l, read_channel, write_channel, count_channel};
    f->spu.reg[3] = (cgt_spu_register){{0x3f800000, 0x3f800000, 0x3f800000, 0x3f800000}};
    f->spu.reg[4] = (cgt_spu_register){{0x33ffffff, 0x33ffffff, 0x33ffffff, 0x33ffffff}}; /* nearly an ulp of 1 */
    CGT_SPU_ASM(&f->p, rdch, .rt = 9, .ra = 24);
    CGT_SPU_ASM(&f->p, fa, .rt = 5, .ra = 3, .rb = 4);
    CGT_SPU_ASM(&f->p, stop, .imm = 1);
    fesetround(FE_UPWARD);
    const cgt_spu_end end = run(f, &c);
    const int rounding = fegetround();
    fesetround(FE_TONEAREST);
    expect_stop(f, end, 1);
    assert_int_equal(rounding, FE_UPWARD);
    assert_int_equal(l.rounding, FE_UPWARD);
    assert_int_equal(f->spu.reg[5].word[0], 0x3f800000); /* truncated */
}

/* ---- how runs end ---- */

static void stops(void **state)
{
    fixture *f = begin(state);
    CGT_SPU_ASM(&f->p, stop, .imm = 0x2000);
    CGT_SPU_ASM(&f->p, stopd, .rt = 1, .ra = 2, .rb = 3);
    CGT_SPU_ASM(&f->p, stop, .imm = 0x3abc);
    expect_stop(f, run(f, NULL), 0x2000);
    assert_int_equal(f->spu.pc, PROGRAM + 4);
    expect_stop(f, cgt_spu_run(&f->spu, NULL, UINT64_MAX), 0x3fff);
    expect_stop(f, cgt_spu_run(&f->spu, NULL, UINT64_MAX), 0x3abc);
    assert_int_equal(f->spu.instructions, 3);
}

static void limits(void **state)
{
    fixture *f = begin(state);
    for (int i = 0; i < 10; i++)
        CGT_SPU_ASM(&f->p, ai, .rt = 3, .ra = 3, .imm = 1);
    CGT_SPU_ASM(&f->p, stop, .imm = 1);
    load(f);
    assert_int_equal(cgt_spu_run(&f->spu, NULL, 0).reason, CGT_SPU_CYCLES);
    assert_int_equal(f->spu.reg[3].word[0], 0);
    assert_int_equal(cgt_spu_run(&f->spu, NULL, 4).reason, CGT_SPU_CYCLES);
    assert_int_equal(f->spu.reg[3].word[0], 4);
    assert_int_equal(f->spu.pc, PROGRAM + 16);
    assert_int_equal(cgt_spu_run(&f->spu, NULL, 10).reason, CGT_SPU_CYCLES);
    assert_int_equal(f->spu.reg[3].word[0], 10);
    expect_stop(f, cgt_spu_run(&f->spu, NULL, 11), 1);
}

static void errors(void **state)
{
    fixture *f = begin(state);
    cgt_spu_emit_word(&f->p, 0x3c3u << 21); /* dfceq, of later chips */
    expect_error(f, run(f, NULL), PROGRAM, "at 0x00400: instruction 0x78600000 (undefined): there is no such");

    f->p.count = 0;
    cgt_spu_emit_word(&f->p, 0x3b0u << 21); /* cflts with a scale of 173 */
    expect_error(f, run(f, NULL), PROGRAM, "there is no such");

    f->p = (cgt_spu_assembler){.word = f->word, .capacity = WORDS, .address = CGT_SPU_LOCAL_STORE - 4};
    CGT_SPU_ASM(&f->p, nop, 0);
    expect_error(f, run(f, NULL), CGT_SPU_LOCAL_STORE, "runs off the end of the local store");
    expect_error(f, cgt_spu_run(&f->spu, NULL, UINT64_MAX), CGT_SPU_LOCAL_STORE, "runs off the end");

    f->p = (cgt_spu_assembler){.word = f->word, .capacity = WORDS, .address = PROGRAM};
    CGT_SPU_ASM(&f->p, bi, .ra = 3);
    f->spu.reg[3].word[0] = 0x402;
    expect_error(f, run(f, NULL), PROGRAM, "(bi): it jumps to an address that is no multiple of 4");
    f->spu.reg[3].word[0] = CGT_SPU_LOCAL_STORE;
    expect_error(f, run(f, NULL), PROGRAM, "(bi): it jumps beyond the local store");

    f->spu.pc = 0x401;
    expect_error(f, cgt_spu_run(&f->spu, NULL, UINT64_MAX), 0x401, "no address of an instruction");
    f->spu.pc = CGT_SPU_LOCAL_STORE + 4;
    expect_error(f, cgt_spu_run(&f->spu, NULL, UINT64_MAX), CGT_SPU_LOCAL_STORE + 4, "no address");

    f->p.count = 0;
    CGT_SPU_ASM(&f->p, rdch, .rt = 3, .ra = 100);
    expect_error(f, run(f, NULL), PROGRAM, "(rdch): there are no channels");
    log l = {0};
    const cgt_spu_channels c = {&l, read_channel, write_channel, count_channel};
    expect_error(f, run(f, &c), PROGRAM, "(rdch): the channel does not allow it");
    f->p.count = 0;
    CGT_SPU_ASM(&f->p, wrch, .rt = 3, .ra = 15);
    expect_error(f, run(f, &c), PROGRAM, "(wrch): the channel does not allow it");
}

static void assembler_without_room(void **state)
{
    fixture *f = begin(state);
    f->p.capacity = 1;
    CGT_SPU_ASM(&f->p, nop, 0);
    assert_false(f->p.failed);
    CGT_SPU_ASM(&f->p, nop, 0);
    assert_true(f->p.failed);
    assert_false(cgt_spu_assembler_load(&f->p, &f->spu));
    f->p = (cgt_spu_assembler){.word = f->word, .capacity = WORDS, .address = CGT_SPU_LOCAL_STORE - 4};
    CGT_SPU_ASM(&f->p, nop, 0);
    CGT_SPU_ASM(&f->p, nop, 0);
    assert_false(cgt_spu_assembler_load(&f->p, &f->spu));
}

/* ---- memory refused ---- */

typedef struct scarce {
    cgt_memory_hooks memory;
    int left, used;
} scarce;

static void *allocate(void *user, size_t bytes, size_t alignment)
{
    scarce *s = user;
    if (s->left-- <= 0)
        return NULL;
    s->used++;
    return s->memory.allocate(s->memory.user, bytes, alignment);
}
static void release(void *user, void *memory, size_t bytes)
{
    scarce *s = user;
    s->used--;
    s->memory.release(s->memory.user, memory, bytes);
}

static void without_memory(void **state)
{
    (void)state;
    for (int left = 0; left <= 3; left++) {
        scarce s = {cgt_memory_default(), left, 0};
        const cgt_memory_hooks hooks = {&s, allocate, release};
        cgt_spu spu;
        const cgt_result result = cgt_spu_create(&spu, &hooks, CGT_SPU_TIMED);
        assert_int_equal(result, left < 3 ? CGT_ERROR_OUT_OF_MEMORY : CGT_OK);
        cgt_spu_destroy(&spu);
        assert_int_equal(s.used, 0);
    }
}

static int set_up(void **state)
{
    static fixture f;
    const cgt_memory_hooks memory = cgt_memory_default();
    *state = &f;
    return cgt_spu_create(&f.spu, &memory, CGT_SPU_UNTIMED) == CGT_OK ? 0 : -1;
}
static int tear_down(void **state)
{
    fixture *f = *state;
    cgt_spu_destroy(&f->spu);
    return 0;
}

int main(void)
{
    test_begin("test_spu_run");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads),
        cmocka_unit_test(stores),
        cmocka_unit_test(code_that_changes),
        cmocka_unit_test(copies),
        cmocka_unit_test(direct_branches),
        cmocka_unit_test(calls),
        cmocka_unit_test(indirect_branches),
        cmocka_unit_test(interrupt_bits),
        cmocka_unit_test(halts),
        cmocka_unit_test(channels),
        cmocka_unit_test(own_channels),
        cmocka_unit_test(calls_by_event),
        cmocka_unit_test(floating_point_environment),
        cmocka_unit_test(stops),
        cmocka_unit_test(limits),
        cmocka_unit_test(errors),
        cmocka_unit_test(assembler_without_room),
        cmocka_unit_test(without_memory),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
