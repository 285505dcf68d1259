/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random programs: words of any kind and random instructions, with branches, stores into the program itself and
 * channels that stall and fail. All forms of the interpreter, timed or not, do the same; slices change nothing; nothing
 * crashes. */
#include "support/test.h"
#include "support/suite.h"

#include <string.h>

#include "cell/spu/execute/execute.h"
#include "cell/spu/isa/assemble.h"
#include "cell/spu/timing/timing.h"
#include "core/memory.h"

enum { PROGRAMS = 150, INSTRUCTIONS = 2000, CODE = 1024 };
enum { ENOUGH = 100 }; /* programs, for a statement about most of them */

/* What channels answer depends on how often they were used, and on nothing else. */
typedef struct replay {
    uint32_t used, sum;
} replay;

static cgt_channel_status next_status(replay *p)
{
    p->used++;
    return p->used % 7 == 3 ? CGT_CHANNEL_STALL : p->used % 97 == 96 ? CGT_CHANNEL_ERROR : CGT_CHANNEL_DONE;
}
static cgt_channel_status read_channel(void *user, unsigned channel, uint64_t cycle, uint32_t *value)
{
    replay *p = user;
    (void)cycle;
    *value = p->sum = p->sum * 1664525 + channel;
    return next_status(p);
}
static cgt_channel_status write_channel(void *user, unsigned channel, uint64_t cycle, uint32_t value)
{
    replay *p = user;
    (void)cycle;
    p->sum += value * 31 + channel;
    return next_status(p);
}
static uint32_t count_channel(void *user, unsigned channel, uint64_t cycle)
{
    (void)cycle;
    return ((replay *)user)->sum >> channel % 32 & 1;
}

/* ---- programs ---- */

static uint32_t random_instruction(test_random *r)
{
    const uint32_t any = (uint32_t)random_bits(r);
    cgt_spu_operands o;
    uint32_t word;
    if (random_below(r, 200) == 0)
        return any;
    do
        word = (uint32_t)cgt_spu_isa[CGT_SPU_FIRST_OP + random_below(r, CGT_SPU_OPS - CGT_SPU_FIRST_OP)].opcode << 21 |
               ((uint32_t)random_bits(r) & 0x1fffffu);
    while (cgt_spu_disassemble(word, &o) < CGT_SPU_FIRST_OP || cgt_spu_disassemble(word, &o) == cgt_spu_op_stop ||
           cgt_spu_disassemble(word, &o) == cgt_spu_op_stopd);
    if (o.imm > -CODE && o.imm < CODE)
        return word;
    o.imm = (int32_t)(random_below(r, 64) * 16) - 256; /* branches and stores near the program */
    return cgt_spu_encode(cgt_spu_disassemble(word, &(cgt_spu_operands){0}), &o, &word) ? word : 0x40200000u;
}

static void load(cgt_spu *spu, uint32_t number)
{
    test_random r = random_make(29600 + number);
    memset(spu->local_store, 0, CGT_SPU_LOCAL_STORE);
    for (uint32_t at = 0; at < CODE; at += 4)
        cgt_spu_store32(spu, at, random_instruction(&r));
    for (uint32_t at = CODE; at < 2 * CODE; at += 4)
        cgt_spu_store32(spu, at, (uint32_t)random_bits(&r));
    for (int i = 0; i < CGT_SPU_REGISTERS; i++)
        for (int k = 0; k < 4; k++)
            spu->reg[i].word[k] = random_below(&r, 3) ? (uint32_t)random_bits(&r) : random_below(&r, CODE / 4) * 4;
}

/* ---- runs ---- */

/* Until an error, or so many instructions. A halt, a stop or a stall is no end. */
static cgt_spu_end run(cgt_spu *spu, replay *p, uint64_t slice)
{
    const cgt_spu_channels channels = {p, read_channel, write_channel, count_channel};
    cgt_spu_end end;
    do
        end = cgt_spu_run(spu, &channels, spu->cycle + slice);
    while (end.reason != CGT_SPU_ERROR && spu->instructions < INSTRUCTIONS);
    return end;
}

static void expect_same(const cgt_spu *a, const cgt_spu *b, uint32_t number, const char *what)
{
    if (a->pc != b->pc || a->instructions != b->instructions || strcmp(a->message, b->message) != 0)
        fail_msg("program %u, %s: at 0x%x after %llu (%s), at 0x%x after %llu (%s)", (unsigned)number, what,
                 (unsigned)a->pc, (unsigned long long)a->instructions, a->message, (unsigned)b->pc,
                 (unsigned long long)b->instructions, b->message);
    for (int i = 0; i < CGT_SPU_REGISTERS; i++)
        if (memcmp(&a->reg[i], &b->reg[i], 16) != 0)
            fail_msg("program %u, %s: register %d differs", (unsigned)number, what, i);
    if (memcmp(a->local_store, b->local_store, CGT_SPU_LOCAL_STORE) != 0 || memcmp(a->fpscr, b->fpscr, 16) != 0)
        fail_msg("program %u, %s: local store or FPSCR differs", (unsigned)number, what);
}

static void make(cgt_spu *spu, cgt_spu_mode mode, const cgt_spu_row *row, uint32_t number)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    assert_int_equal(cgt_spu_create(spu, &memory, mode), CGT_OK);
    spu->row = row;
    load(spu, number);
}

/* One instruction at a time, without timing, is the reference. */
TEST(all_forms_agree)
{
    uint64_t instructions = 0;
    const uint32_t programs = test_between(4, PROGRAMS);
    for (uint32_t number = 0; number < programs; number++) {
        cgt_spu one, other;
        replay first = {0, 1};
        make(&one, CGT_SPU_UNTIMED, &cgt_spu_rows[0], number);
        run(&one, &first, 1);
        instructions += one.instructions;
        for (const cgt_spu_row *row = cgt_spu_rows; row->name; row++) {
            if (!row->runs())
                continue;
            replay p = {0, 1};
            make(&other, CGT_SPU_UNTIMED, row, number);
            run(&other, &p, 1);
            expect_same(&one, &other, number, row->name);
            assert_int_equal(p.sum, first.sum);
            cgt_spu_destroy(&other);
        }
        cgt_spu_destroy(&one);
    }
    if (programs >= ENOUGH) /* programs do more than fail at once */
        assert_true(instructions > (uint64_t)programs * 40);
}

/* Timed, in slices: the same cycles and causes as in longer ones; the same work as untimed where both end by an
 * error. */
TEST(slices_change_nothing)
{
    const uint32_t programs = test_between(4, PROGRAMS);
    uint32_t compared = 0;
    for (uint32_t number = 0; number < programs; number++) {
        cgt_spu spu[3];
        replay p[3] = {{0, 1}, {0, 1}, {0, 1}};
        cgt_spu_end end[3];
        for (int i = 0; i < 3; i++) {
            make(&spu[i], i ? CGT_SPU_TIMED : CGT_SPU_UNTIMED, NULL, number);
            end[i] = run(&spu[i], &p[i], i == 1 ? 1 : 1000);
        }
        if (end[0].reason == CGT_SPU_ERROR && end[1].reason == CGT_SPU_ERROR && end[2].reason == CGT_SPU_ERROR) {
            compared++;
            expect_same(&spu[0], &spu[1], number, "timed");
            expect_same(&spu[1], &spu[2], number, "slices");
            const cgt_spu_counts a = cgt_spu_timing_total(spu[1].timing), b = cgt_spu_timing_total(spu[2].timing);
            assert_memory_equal(&a, &b, sizeof a);
            assert_int_equal(spu[1].cycle, spu[2].cycle);
        }
        for (int i = 1; i < 3; i++) {
            const cgt_spu_counts counts = cgt_spu_timing_total(spu[i].timing);
            assert_int_equal(cgt_spu_counts_cycles(&counts), spu[i].cycle);
        }
        for (int i = 0; i < 3; i++)
            cgt_spu_destroy(&spu[i]);
    }
    if (programs >= ENOUGH)
        assert_true(compared * 8 > programs);
}

/* The sum of all that the first programs leave, with the default seed: the same number on every host. */
TEST(every_host_agrees)
{
    uint64_t hash = 0;
    random_seed(RANDOM_DEFAULT_SEED);
    for (uint32_t number = 0; number < 8; number++) {
        cgt_spu spu;
        replay p = {0, 1};
        make(&spu, CGT_SPU_TIMED, NULL, number);
        run(&spu, &p, 1000);
        for (int i = 0; i < CGT_SPU_REGISTERS * 4; i++)
            hash = (hash ^ spu.reg[i / 4].word[i % 4]) * 0x100000001b3u;
        for (uint32_t at = 0; at < CGT_SPU_LOCAL_STORE; at++)
            hash = (hash ^ spu.local_store[at]) * 0x100000001b3u;
        hash = (hash ^ spu.cycle ^ spu.pc) * 0x100000001b3u;
        cgt_spu_destroy(&spu);
    }
    if (hash != UINT64_C(0x546a9e60f8aa06df))
        fail_msg("the programs leave %016llx", (unsigned long long)hash);
}

/* every_host_agrees is the last: it sets the seed. */
SEEDED_SUITE("test_spu_random", NULL, NULL)
