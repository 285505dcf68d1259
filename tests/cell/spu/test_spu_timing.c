/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The timing model against cycles counted by hand (bench/cell/micro_programs.c), in one run and in slices of any
 * length; and where the cycles are said to have gone. */
#include "support/test.h"
#include "support/suite.h"

#include <string.h>

#include "cell/micro_programs.h"
#include "core/memory.h"

static micro_result run(const micro_program *program, uint64_t slice)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    micro_result result = {0};
    cgt_spu spu;
    assert_int_equal(cgt_spu_create(&spu, &memory, CGT_SPU_TIMED), CGT_OK);
    if (!micro_program_run(&spu, program, slice, &result))
        fail_msg("%s: does not stop: %s", program->name, spu.message);
    cgt_spu_destroy(&spu);
    return result;
}

static const micro_program *find(const char *name)
{
    for (uint32_t i = 0; i < micro_program_count; i++)
        if (!strcmp(micro_programs[i].name, name))
            return &micro_programs[i];
    fail_msg("no program %s", name);
    return NULL;
}

TEST(by_hand)
{
    for (uint32_t i = 0; i < micro_program_count; i++) {
        const micro_result result = run(&micro_programs[i], UINT64_MAX);
        if (result.cycles != micro_programs[i].cycles)
            fail_msg("%s: %llu cycles, by hand %llu", micro_programs[i].name, (unsigned long long)result.cycles,
                     (unsigned long long)micro_programs[i].cycles);
    }
}

/* A run that is cut into pieces goes on where it was: same cycles, same causes. */
TEST(in_slices)
{
    for (uint32_t i = 0; i < micro_program_count; i++) {
        const micro_result whole = run(&micro_programs[i], UINT64_MAX);
        for (uint64_t slice = 1; slice <= 25; slice++) {
            const micro_result sliced = run(&micro_programs[i], slice);
            if (sliced.cycles != whole.cycles || memcmp(&sliced.counts, &whole.counts, sizeof whole.counts) != 0)
                fail_msg("%s in slices of %llu: %llu cycles instead of %llu, or other causes", micro_programs[i].name,
                         (unsigned long long)slice, (unsigned long long)sliced.cycles,
                         (unsigned long long)whole.cycles);
        }
    }
}

TEST(every_cycle_has_a_cause)
{
    for (uint32_t i = 0; i < micro_program_count; i++) {
        const micro_result result = run(&micro_programs[i], UINT64_MAX);
        assert_int_equal(cgt_spu_counts_cycles(&result.counts), result.cycles);
    }
}

typedef struct expectation {
    const char *program;
    cgt_spu_cause cause;
    uint64_t cycles;
} expectation;

TEST(causes)
{
    static const expectation expected[] = {
        {"pairs", CGT_SPU_DUAL, 8},
        {"pairs", CGT_SPU_SINGLE, 1},
        {"swapped", CGT_SPU_DUAL, 0},
        {"chain-ai", CGT_SPU_DEPENDENCY, 4},   /* one in each of four gaps */
        {"chain-dfa", CGT_SPU_DOUBLE, 24},     /* six behind each */
        {"chain-dfa", CGT_SPU_DEPENDENCY, 24}, /* and six more until the result is there */
        {"doubles", CGT_SPU_DOUBLE, 24},
        {"unhinted-loop", CGT_SPU_MISPREDICT, 153}, /* 17 in nine rounds */
        {"unhinted-loop", CGT_SPU_DEPENDENCY, 11},  /* before the first ai, and before each brnz */
        {"hinted-loop", CGT_SPU_MISPREDICT, 17},    /* once, at the end */
        {"hinted-loop", CGT_SPU_HINT_WAIT, 3},
        {"near-hint", CGT_SPU_MISPREDICT, 68}, /* three rounds, and the end */
        {"channel-stall", CGT_SPU_CHANNEL, 100},
        {"channel-stall", CGT_SPU_DEPENDENCY, 5},
    };
    for (size_t i = 0; i < TEST_COUNT(expected); i++) {
        const micro_result result = run(find(expected[i].program), UINT64_MAX);
        if (result.counts.cycles[expected[i].cause] != expected[i].cycles)
            fail_msg("%s: %llu cycles of %s, by hand %llu", expected[i].program,
                     (unsigned long long)result.counts.cycles[expected[i].cause],
                     cgt_spu_cause_names[expected[i].cause], (unsigned long long)expected[i].cycles);
    }
}

/* Counts go to the function at whose address an instruction stands; the smaller of two that overlap is dropped. */
TEST(by_function)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    static const cgt_spu_function functions[] = {{.name = "loop", .address = 4, .size = 8},
                                                 {.name = "start", .address = 0, .size = 4},
                                                 {.name = "inner", .address = 8, .size = 4}};
    micro_result result;
    cgt_spu spu;
    assert_int_equal(cgt_spu_create(&spu, &memory, CGT_SPU_TIMED), CGT_OK);
    assert_int_equal(cgt_spu_timing_set_functions(spu.timing, &memory, functions, 3), CGT_OK);
    assert_true(micro_program_run(&spu, find("unhinted-loop"), UINT64_MAX, &result));
    assert_int_equal(result.counts.instructions, 1 + 2 * 10 + 1);
    assert_string_equal(spu.timing->function[0].name, "start");
    assert_int_equal(spu.timing->function[0].counts.instructions, 1);
    assert_string_equal(spu.timing->function[1].name, "loop");
    assert_int_equal(spu.timing->function[1].counts.instructions, 20);
    assert_int_equal(spu.timing->function[1].counts.mispredicts, 9);
    assert_int_equal(spu.timing->function[2].counts.instructions, 0);
    assert_int_equal(spu.timing->other.instructions, 1);
    assert_int_equal(cgt_spu_counts_cycles(&result.counts), 186);
    cgt_spu_destroy(&spu);
}

SEEDED_SUITE("test_spu_timing", NULL, NULL)
