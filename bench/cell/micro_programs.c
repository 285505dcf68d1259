/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The programs, see micro_programs.h. "a@8: 5" says: the instruction a, at address 8, issues in cycle 5. The first
 * cycle is 0. A program's cycles are those up to and with the one in which it stops. */
#include "cell/micro_programs.h"

enum { STOP_CODE = 0x2000, CHAIN = 4, PAIRS = 8, ROUNDS = 10 };

static void stop(cgt_spu_assembler *p) { CGT_SPU_ASM(p, stop, .imm = STOP_CODE); }

/* stopd waits for register 3 */
static void stop_behind(cgt_spu_assembler *p) { CGT_SPU_ASM(p, stopd, .rt = 3, .ra = 3, .rb = 3); }

/* ---- pairs ---- */

/* a@0: 0, lnop@4: 0, a@8: 1, ... The eighth pair issues in 7, the stop in 8: 9 cycles. */
static void pairs(cgt_spu_assembler *p)
{
    for (unsigned i = 0; i < PAIRS; i++) {
        CGT_SPU_ASM(p, a, .rt = 10 + i, .ra = 3, .rb = 4);
        CGT_SPU_ASM(p, lnop, 0);
    }
    stop(p);
}

/* Odd before even: each of the 16 takes a cycle, the stop is the 17th. */
static void swapped(cgt_spu_assembler *p)
{
    for (unsigned i = 0; i < PAIRS; i++) {
        CGT_SPU_ASM(p, lnop, 0);
        CGT_SPU_ASM(p, a, .rt = 10 + i, .ra = 3, .rb = 4);
    }
    stop(p);
}

/* Even and odd, but the pairs lie across multiples of 8: nop@0: 0, then 8 times a@4: +1, lnop@8: +1, stop: 17. The
 * stop lies at 68: 18 cycles. */
static void crossing(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, nop, 0);
    for (unsigned i = 0; i < PAIRS; i++) {
        CGT_SPU_ASM(p, a, .rt = 10 + i, .ra = 3, .rb = 4);
        CGT_SPU_ASM(p, lnop, 0);
    }
    stop(p);
}

/* ai@0: 0; stqd@4 needs the sum: 2; ai@8: 3; stqd: 5; ... the eighth instruction in 11, the stop in 12: 13 cycles. */
static void dependent_pairs(cgt_spu_assembler *p)
{
    for (unsigned i = 0; i < CHAIN; i++) {
        CGT_SPU_ASM(p, ai, .rt = 3, .ra = 3, .imm = 1);
        CGT_SPU_ASM(p, stqd, .rt = 3, .ra = 4, .imm = 1024);
    }
    stop(p);
}

/* ---- latencies: four in a chain and stopd behind them, in cycle 4 * latency ---- */

#define CHAIN_OF(name, ...)                                                                                            \
    static void chain_##name(cgt_spu_assembler *p)                                                                     \
    {                                                                                                                  \
        for (unsigned i = 0; i < CHAIN; i++)                                                                           \
            CGT_SPU_ASM(p, name, .rt = 3, .ra = 3, __VA_ARGS__);                                                       \
        stop_behind(p);                                                                                                \
    }
CHAIN_OF(ai, .imm = 1)
CHAIN_OF(roti, .imm = 1)
CHAIN_OF(cntb, .rb = 0)
CHAIN_OF(fa, .rb = 3)
CHAIN_OF(mpyi, .imm = 3)
CHAIN_OF(dfa, .rb = 3)
CHAIN_OF(lqd, .imm = 1024)
CHAIN_OF(rotqbyi, .imm = 1)
CHAIN_OF(orx, .rb = 0)

/* rchcnt@0 of the SPU's own channel 15: 0; stopd: 6. */
static void count_channel(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, rchcnt, .rt = 3, .ra = 15);
    stop_behind(p);
}

/* brsl@0: 0, not predicted: ori@8: 18, for the link is ready in 4; stopd needs it: 20. */
static void link_register(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, brsl, .rt = 3, .imm = 8);
    stop(p);
    CGT_SPU_ASM(p, ori, .rt = 3, .ra = 3);
    stop_behind(p);
}

/* dfa@0: 0, then 7, 14, 21, for nothing issues in the six cycles behind each; the stop in 28. */
static void doubles(cgt_spu_assembler *p)
{
    for (unsigned i = 0; i < CHAIN; i++)
        CGT_SPU_ASM(p, dfa, .rt = 10 + i, .ra = 3, .rb = 4);
    stop(p);
}

/* dfa@0: 0; lnop@4 could pair with another instruction of the even pipe, but waits until 7; the stop in 8. */
static void double_alone(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, dfa, .rt = 10, .ra = 3, .rb = 4);
    CGT_SPU_ASM(p, lnop, 0);
    stop(p);
}

/* ---- branches ---- */

static void count_down(cgt_spu_assembler *p, uint32_t loop)
{
    CGT_SPU_ASM(p, ai, .rt = 3, .ra = 3, .imm = -1);
    CGT_SPU_ASM(p, brnz, .rt = 3, .imm = cgt_spu_distance(p, loop));
}

/* il@0: 0; ai@4: 2; brnz@8: 4, taken, not predicted; ai: 22; brnz: 24; ... 20 cycles a round; the tenth brnz in 184 is
 * not taken, as predicted; the stop in 185. */
static void unhinted_loop(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, il, .rt = 3, .imm = ROUNDS);
    count_down(p, cgt_spu_here(p));
    stop(p);
}

/* A hint, 10 instructions, and the loop, whose branch stands at 44. hbrr@0: 0; il@4: 1; four pairs: 2 to 5; ai@40: 6;
 * brnz@44: ready in 8, but waits for the hint until 11; ai: 12; brnz: 14; ... 3 cycles a round; the tenth brnz in 38 is
 * not taken, against the hint; the stop 18 later, in 56. */
static void hinted_loop(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, hbrr, .branch = 44, .imm = 40);
    CGT_SPU_ASM(p, il, .rt = 3, .imm = ROUNDS);
    for (int i = 0; i < 4; i++) {
        CGT_SPU_ASM(p, nop, 0);
        CGT_SPU_ASM(p, lnop, 0);
    }
    count_down(p, cgt_spu_here(p));
    stop(p);
}

/* The same without the pairs. hbrr@0: 0; il@4: 1; ai@8: 3; brnz@12: 5. The hint is two instructions before it, too
 * near; so it is in the second round (25, four instructions between) and in the third (45, six). In the fourth there
 * are eight: ai: 63; brnz: 65, and 3 cycles a round from there. The tenth in 83 is not taken; the stop in 101. */
static void near_hint(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, hbrr, .branch = 12, .imm = 8);
    CGT_SPU_ASM(p, il, .rt = 3, .imm = ROUNDS);
    count_down(p, cgt_spu_here(p));
    stop(p);
}

/* Through a register, the hint too: ila@0: 0; hbr@4 needs it: 2; six pairs from 8 to 52, cycles 3 to 8; bi@56: ready,
 * but waits for the hint until 13; the stop at 64 in 14: 15 cycles. */
static void hinted_jump(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, ila, .rt = 5, .imm = 64);
    CGT_SPU_ASM(p, hbr, .ra = 5, .branch = 52);
    for (int i = 0; i < 6; i++) {
        CGT_SPU_ASM(p, nop, 0);
        CGT_SPU_ASM(p, lnop, 0);
    }
    CGT_SPU_ASM(p, bi, .ra = 5);
    CGT_SPU_ASM(p, nop, 0);
    stop(p);
}

/* ---- channels ---- */

/* rdch@0 stalls from 0 to 100; stopd needs what it reads: 106. */
static void channel_stall(cgt_spu_assembler *p)
{
    CGT_SPU_ASM(p, rdch, .rt = 3, .ra = 29);
    stop_behind(p);
}

/* ---- the list ---- */

const micro_program micro_programs[] = {
    {"pairs", "even and odd instructions issue together", pairs, 9},
    {"swapped", "odd before even: one a cycle", swapped, 17},
    {"crossing", "pairs across a multiple of 8: one a cycle", crossing, 18},
    {"dependent-pairs", "the second waits for the first", dependent_pairs, 13},
    {"chain-ai", "latency of sums: 2", chain_ai, 9},
    {"chain-roti", "latency of shifts: 4", chain_roti, 17},
    {"chain-cntb", "latency of bytes: 4", chain_cntb, 17},
    {"chain-fa", "latency of single precision: 6", chain_fa, 25},
    {"chain-mpyi", "latency of integer products: 7", chain_mpyi, 29},
    {"chain-dfa", "latency of double precision: 13", chain_dfa, 53},
    {"chain-lqd", "latency of loads: 6", chain_lqd, 25},
    {"chain-rotqbyi", "latency of shuffles: 4", chain_rotqbyi, 17},
    {"chain-orx", "latency of orx, in the pipe of branches: 4", chain_orx, 17},
    {"count-channel", "latency of channels: 6", count_channel, 7},
    {"link-register", "a call that was not predicted", link_register, 21},
    {"doubles", "one double-precision instruction in 7 cycles", doubles, 29},
    {"double-alone", "nothing pairs with double precision", double_alone, 9},
    {"unhinted-loop", "a mispredict a round", unhinted_loop, 186},
    {"hinted-loop", "a hint in time, with a wait for it", hinted_loop, 57},
    {"near-hint", "a hint that is ignored as long as it is near", near_hint, 102},
    {"hinted-jump", "a hint whose target is in a register", hinted_jump, 15},
    {"channel-stall", "a channel that stalls", channel_stall, 107},
};
const uint32_t micro_program_count = sizeof micro_programs / sizeof micro_programs[0];

/* ---- running ---- */

static cgt_channel_status read_late(void *user, unsigned channel, uint64_t cycle, uint32_t *value)
{
    (void)user;
    *value = 7;
    return channel != 29 ? CGT_CHANNEL_ERROR : cycle < MICRO_CHANNEL_READY ? CGT_CHANNEL_STALL : CGT_CHANNEL_DONE;
}
static cgt_channel_status write_nothing(void *user, unsigned channel, uint64_t cycle, uint32_t value)
{
    (void)user, (void)channel, (void)cycle, (void)value;
    return CGT_CHANNEL_ERROR;
}
static uint32_t count_late(void *user, unsigned channel, uint64_t cycle)
{
    (void)user;
    return channel == 29 && cycle >= MICRO_CHANNEL_READY;
}

bool micro_program_run(cgt_spu *spu, const micro_program *program, uint64_t slice, micro_result *result)
{
    const cgt_spu_channels channels = {NULL, read_late, write_nothing, count_late};
    uint32_t word[64];
    cgt_spu_assembler p = {.word = word, .capacity = 64};
    program->write(&p);
    if (!cgt_spu_assembler_load(&p, spu))
        return false;
    cgt_spu_end end;
    do {
        const uint64_t until = slice < UINT64_MAX - spu->cycle ? spu->cycle + slice : UINT64_MAX;
        end = cgt_spu_run(spu, &channels, until);
        if (end.reason == CGT_SPU_STALLED && spu->cycle < MICRO_CHANNEL_READY)
            spu->cycle = MICRO_CHANNEL_READY;
    } while (end.reason == CGT_SPU_CYCLES || end.reason == CGT_SPU_STALLED);
    *result = (micro_result){spu->cycle, cgt_spu_timing_total(spu->timing)};
    return end.reason == CGT_SPU_STOPPED;
}

/* ---- speed ---- */

static void kernel_body(cgt_spu_assembler *p)
{
    for (unsigned i = 0; i < 3; i++) {
        CGT_SPU_ASM(p, lqd, .rt = 10 + i, .ra = 4, .imm = 1024 + 16 * (int32_t)i);
        CGT_SPU_ASM(p, fma, .rt = 20 + i, .ra = 10 + i, .rb = 11, .rc = 20 + i);
        CGT_SPU_ASM(p, fcgt, .rt = 30 + i, .ra = 20 + i, .rb = 12);
        CGT_SPU_ASM(p, selb, .rt = 40 + i, .ra = 20 + i, .rb = 11, .rc = 30 + i);
        CGT_SPU_ASM(p, shufb, .rt = 50 + i, .ra = 40 + i, .rb = 10, .rc = 5);
        CGT_SPU_ASM(p, a, .rt = 60 + i, .ra = 50 + i, .rb = 40);
        CGT_SPU_ASM(p, stqd, .rt = 60 + i, .ra = 4, .imm = 2048 + 16 * (int32_t)i);
    }
    CGT_SPU_ASM(p, nop, 0);
    CGT_SPU_ASM(p, ai, .rt = 3, .ra = 3, .imm = -1);
}

bool micro_kernel_run(cgt_spu *spu)
{
    uint32_t word[64];
    cgt_spu_assembler p = {.word = word, .capacity = 64};
    CGT_SPU_ASM(&p, ilhu, .rt = 3, .imm = 20); /* 20 * 65536 rounds */
    CGT_SPU_ASM(&p, hbrr, .branch = 24 * 4, .imm = 4);
    const uint32_t loop = cgt_spu_here(&p);
    kernel_body(&p);
    CGT_SPU_ASM(&p, brnz, .rt = 3, .imm = cgt_spu_distance(&p, loop));
    stop(&p);
    return cgt_spu_assembler_load(&p, spu) && cgt_spu_run(spu, NULL, UINT64_MAX).reason == CGT_SPU_STOPPED;
}
