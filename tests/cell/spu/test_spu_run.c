/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Channels; how runs end and go on; every error by its sentence. */
#include <fenv.h>

#include "cell/spu/spu_fixture.h"
#include "support/suite.h"

/* ---- channels ---- */

typedef struct run_log {
    unsigned reads, writes, counts, stalls;
    uint32_t written, events;
    uint64_t cycle;
    int rounding;
} run_log;

static cgt_channel_status read_channel(void *user, unsigned channel, uint64_t cycle, uint32_t *value)
{
    run_log *l = user;
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
    run_log *l = user;
    l->cycle = cycle;
    if (l->stalls && l->stalls--)
        return CGT_CHANNEL_STALL;
    l->writes++;
    l->written = value + channel;
    return CGT_CHANNEL_DONE;
}
static uint32_t count_channel(void *user, unsigned channel, uint64_t cycle)
{
    run_log *l = user;
    (void)cycle;
    l->counts++;
    return channel == 0 ? l->events : 2000 + channel;
}

TEST(channels)
{
    fixture *f = begin(state);
    run_log l = {.stalls = 2};
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

TEST(own_channels)
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

TEST(calls_by_event)
{
    fixture *f = begin(state);
    run_log l = {.events = 0};
    const cgt_spu_channels c = {&l, read_channel, write_channel, count_channel};
    for (uint32_t events = 0; events < 2; events++) {
        l.events = events;
        f->spu.reg[4].word[0] = PROGRAM + 8;
        f->p.count = 0;
        CGT_SPU_ASM(&f->p, bisled, .rt = 3, .ra = 4);
        CGT_SPU_ASM(&f->p, stop, .imm = 1);
        CGT_SPU_ASM(&f->p, stop, .imm = 2);
        expect_stop(f, run(f, &c), 1 + events);
        assert_int_equal(f->spu.reg[3].word[0], PROGRAM + 4); /* the link, either way */
    }
}

/* The caller's rounding holds while its functions run, and afterwards. */
TEST(floating_point_environment)
{
    fixture *f = begin(state);
    run_log l = {0};
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

TEST(stops)
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

TEST(limits)
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

TEST(errors)
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
    run_log l = {0};
    const cgt_spu_channels c = {&l, read_channel, write_channel, count_channel};
    expect_error(f, run(f, &c), PROGRAM, "(rdch): the channel does not allow it");
    f->p.count = 0;
    CGT_SPU_ASM(&f->p, wrch, .rt = 3, .ra = 15);
    expect_error(f, run(f, &c), PROGRAM, "(wrch): the channel does not allow it");
}

TEST(assembler_without_room)
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

TEST(without_memory)
{
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

SEEDED_SUITE("test_spu_run", set_up, tear_down)
