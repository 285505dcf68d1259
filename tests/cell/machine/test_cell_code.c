/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Simulated SPUs in a machine: code that comes by DMA, polling, halts, and instructions that do not exist. */
#include <string.h>

#include "cell/machine/machine.h"
#include "support/suite.h"
#include "cell/spu/isa/assemble.h"
#include "core/memory.h"
#include "spu_mfcio.h"
#include "support/test.h"

#define MEMORY_EA 0x10000
#define CODE 0x800 /* local address of the piece of code that is replaced */

static uint32_t memory[64];
static cgt_spu spu;

typedef void assemble(cgt_spu_assembler *p);

static void write_constant(cgt_spu_assembler *p, unsigned channel, int32_t value)
{
    CGT_SPU_ASM(p, ila, .rt = 13, .imm = value);
    CGT_SPU_ASM(p, wrch, .rt = 13, .ra = channel);
}

static void give(cgt_spu_assembler *p, int32_t lsa, int32_t ea, int32_t size, int32_t command)
{
    write_constant(p, MFC_LSA, lsa);
    write_constant(p, MFC_EAH, 0);
    write_constant(p, MFC_EAL, ea);
    write_constant(p, MFC_Size, size);
    write_constant(p, MFC_TagID, 0);
    write_constant(p, MFC_Cmd, command);
}

static void wait_for_all(cgt_spu_assembler *p)
{
    write_constant(p, MFC_WrTagMask, 1);
    write_constant(p, MFC_WrTagUpdate, MFC_TAG_UPDATE_ALL);
    CGT_SPU_ASM(p, rdch, .rt = 12, .ra = MFC_RdTagStat);
}

/* Runs a program from address 0, with other code at CODE. */
static cgt_cell *run(assemble *program, assemble *code, cgt_result *result)
{
    const cgt_memory_hooks hooks = cgt_memory_default();
    uint32_t word[128];
    cgt_cell *cell;
    cgt_spu_assembler a = {.word = word, .capacity = TEST_COUNT(word)};
    assert_int_equal(cgt_spu_create(&spu, &hooks, CGT_SPU_TIMED), CGT_OK);
    if (code) {
        cgt_spu_assembler c = {.word = word, .capacity = TEST_COUNT(word), .address = CODE};
        code(&c);
        assert_true(cgt_spu_assembler_load(&c, &spu));
    }
    program(&a);
    assert_true(cgt_spu_assembler_load(&a, &spu));
    const cgt_spe_unit unit = cgt_cell_unit_of(&spu, 0, 0, 0);
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = 1, .cycle_limit = 1000000}, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, MEMORY_EA, memory, 64, 4, true), CGT_OK);
    *result = cgt_cell_run_simulated(cell, &unit, NULL, NULL);
    return cell;
}

/* ---- code by DMA ---- */

static void adds_one(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, ai, .rt = 20, .ra = 20, .imm = 1);
    CGT_SPU_ASM(p, bi, .ra = 0);
    CGT_SPU_ASM(p, nop, 0);
    CGT_SPU_ASM(p, nop, 0);
}

static void adds_hundred(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, ai, .rt = 20, .ra = 20, .imm = 100);
    CGT_SPU_ASM(p, bi, .ra = 0);
    CGT_SPU_ASM(p, nop, 0);
    CGT_SPU_ASM(p, nop, 0);
}

/* calls the code, gets other code to its place, calls it again; gets its own store to see another way, too */
static void calls_twice(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, il, .rt = 20, .imm = 0);
    CGT_SPU_ASM(p, brsl, .rt = 0, .imm = cgt_spu_distance(p, CODE));
    give(p, CODE, MEMORY_EA, 16, MFC_GET_CMD);
    wait_for_all(p);
    CGT_SPU_ASM(p, brsl, .rt = 0, .imm = cgt_spu_distance(p, CODE));
    write_constant(p, SPU_WrEventMask, 0); /* any access: 101 is in register 20 now */
    CGT_SPU_ASM(p, stop, .imm = 0x55);
}

TEST(code_by_dma)
{
    uint32_t word[4];
    cgt_result result;
    cgt_spu_assembler c = {.word = word, .capacity = 4};
    adds_hundred(&c);
    memcpy(memory, word, sizeof word);
    cgt_cell *const cell = run(calls_twice, adds_one, &result);
    assert_string_equal(cgt_cell_get_message(cell), "");
    assert_int_equal(cgt_cell_get_result(cell, 0).code, 0x55);
    assert_int_equal(spu.reg[20].word[0], 101);
    cgt_cell_destroy(cell);
    cgt_spu_destroy(&spu);
}

/* the same through the address that the store has for all SPEs: the SPE puts new code into itself */
static void puts_to_itself(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, il, .rt = 20, .imm = 0);
    CGT_SPU_ASM(p, brsl, .rt = 0, .imm = cgt_spu_distance(p, CODE));
    give(p, 0x1000, MEMORY_EA, 16, MFC_GET_CMD);
    write_constant(p, MFC_LSA, 0x1000);
    CGT_SPU_ASM(p, ilhu, .rt = 13, .imm = (int32_t)(CGT_SPE_EA(0) >> 16));
    CGT_SPU_ASM(p, iohl, .rt = 13, .imm = CODE);
    CGT_SPU_ASM(p, wrch, .rt = 13, .ra = MFC_EAL);
    write_constant(p, MFC_Size, 16);
    write_constant(p, MFC_TagID, 0);
    write_constant(p, MFC_Cmd, MFC_PUTF_CMD);
    wait_for_all(p);
    CGT_SPU_ASM(p, brsl, .rt = 0, .imm = cgt_spu_distance(p, CODE));
    CGT_SPU_ASM(p, stop, .imm = 0x56);
}

TEST(code_from_store_to_store)
{
    cgt_result result;
    uint32_t word[4];
    cgt_spu_assembler c = {.word = word, .capacity = 4};
    adds_hundred(&c);
    memcpy(memory, word, sizeof word);
    cgt_cell *const cell = run(puts_to_itself, adds_one, &result);
    assert_string_equal(cgt_cell_get_message(cell), "");
    assert_int_equal(cgt_cell_get_result(cell, 0).code, 0x56);
    assert_int_equal(spu.reg[20].word[0], 101);
    cgt_cell_destroy(cell);
    cgt_spu_destroy(&spu);
}

/* ---- polling ---- */

/* asks for the count of the tag status until it is there */
static void polls_tags(cgt_spu_assembler *p)
{
    give(p, 0x1000, MEMORY_EA, 128, MFC_GET_CMD);
    write_constant(p, MFC_WrTagMask, 1);
    write_constant(p, MFC_WrTagUpdate, MFC_TAG_UPDATE_ALL);
    const uint32_t loop = cgt_spu_here(p);
    CGT_SPU_ASM(p, rchcnt, .rt = 14, .ra = MFC_RdTagStat);
    CGT_SPU_ASM(p, brz, .rt = 14, .imm = cgt_spu_distance(p, loop));
    CGT_SPU_ASM(p, rdch, .rt = 12, .ra = MFC_RdTagStat);
    CGT_SPU_ASM(p, stop, .imm = 0x57);
}

TEST(polling)
{
    cgt_result result;
    cgt_cell *const cell = run(polls_tags, NULL, &result);
    assert_int_equal(result, CGT_OK);
    assert_int_equal(spu.reg[12].word[0], 1);
    /* the transfer ends some 316 cycles after the command; a wait takes no longer than the poll runs ahead once */
    assert_true(cgt_cell_get_result(cell, 0).cycle > 316 && cgt_cell_get_result(cell, 0).cycle < 316 + 4096 + 100);
    assert_int_equal(cgt_cell_get_result(cell, 0).counts.wait_cycles, 0);
    cgt_cell_destroy(cell);
    cgt_spu_destroy(&spu);
}

/* ---- ends ---- */

static void halts(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, il, .rt = 4, .imm = 1);
    CGT_SPU_ASM(p, heq, .ra = 4, .rb = 4);
    CGT_SPU_ASM(p, stop, .imm = 0);
}

static void no_instruction(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, il, .rt = 4, .imm = 1);
    cgt_spu_emit_word(p, 0x01c00000);
}

static void breaks_a_rule(cgt_spu_assembler *p)
{
    give(p, 0x1008, MEMORY_EA, 128, MFC_GET_CMD);
    CGT_SPU_ASM(p, stop, .imm = 0);
}

static void expect_end(assemble *program, const char *begins, cgt_mfc_rule rule)
{
    cgt_result result;
    cgt_cell *const cell = run(program, NULL, &result);
    const char *const message = cgt_cell_get_message(cell);
    assert_int_equal(result, CGT_ERROR_STOPPED);
    if (strncmp(message, begins, strlen(begins)) != 0)
        fail_msg("\"%s\" instead of \"%s...\"", message, begins);
    assert_int_equal(cgt_cell_get_result(cell, 0).rule, rule);
    cgt_cell_destroy(cell);
    cgt_spu_destroy(&spu);
}

TEST(bad_ends)
{
    expect_end(halts, "SPE 0: halt: the program halted", CGT_RULE_HALT);
    expect_end(no_instruction, "SPE 0: at 0x00004", CGT_RULE_NONE);
    expect_end(breaks_a_rule, "SPE 0: alignment: mfc_get(lsa 0x1008, ea 0x10000, size 128, tag 0)", CGT_RULE_ALIGNMENT);
}

SEEDED_SUITE("test_cell_code", NULL, NULL)
