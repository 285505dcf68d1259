/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Loads and stores; programs that change themselves; copies to and from main memory. */
#include "cell/spu/spu_fixture.h"
#include "support/suite.h"

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

TEST(loads)
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

TEST(stores)
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
TEST(code_that_changes)
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

TEST(copies)
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

SEEDED_SUITE("test_spu_memory", set_up, tear_down)
