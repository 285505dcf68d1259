/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPE programs, compiled from one source twice: by the SPU's own compiler, simulated, and by the host's, native.
 * The same bits in main memory, the same codes, as many DMAs. */
#include <stdio.h>
#include <string.h>

#include "cell/machine/spe_programs.h"
#include "cell/spu/elf.h"
#include "core/memory.h"
#include "support/test.h"

#define MEMORY_EA 0x100000u
#define MEMORY_WORDS 8192u
#define ROWS 97u

typedef struct outcome {
    uint32_t memory[MEMORY_WORDS];
    cgt_spe_result spe[CGT_MAX_SPES];
} outcome;

static outcome simulated, native;
static cgt_spu spu[CGT_MAX_SPES];

/* every row to one SPE after the other, so that the counts of DMA are the same both ways */
static void hand_out(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    uint32_t *const next = user; /* per SPE */
    const unsigned spes = next[CGT_MAX_SPES];
    if (event->kind == CGT_PPE_START)
        for (unsigned i = 0; i < spes; i++) {
            next[i] = i + spes;
            assert_true(cgt_cell_send_mailbox(cell, i, i));
        }
    if (event->kind == CGT_PPE_MAILBOX) {
        const uint32_t row = next[event->spe];
        next[event->spe] += spes;
        assert_true(cgt_cell_send_mailbox(cell, event->spe, row < ROWS ? row : STRIPS_END));
    }
}

static size_t read_file(const char *path, char *bytes, size_t capacity)
{
    FILE *const file = fopen(path, "rb");
    if (!file)
        fail_msg("%s: cannot be opened", path);
    const size_t size = fread(bytes, 1, capacity, file);
    fclose(file);
    return size;
}

static void load(const char *name, unsigned spes, uint64_t argument, cgt_spe_unit *unit)
{
    static char bytes[1 << 20];
    char path[1024];
    const cgt_memory_hooks memory = cgt_memory_default();
    snprintf(path, sizeof path, "%s/spe_%s.elf", SPU_PROGRAMS, name);
    const size_t size = read_file(path, bytes, sizeof bytes);
    for (unsigned i = 0; i < spes; i++) {
        assert_int_equal(cgt_spu_create(&spu[i], &memory, CGT_SPU_TIMED), CGT_OK);
        if (cgt_spu_load_elf(&spu[i], bytes, size, path) != CGT_OK)
            fail_msg("%s", spu[i].message);
        unit[i] = cgt_cell_unit_of(&spu[i], i, argument, 0);
    }
}

static void end_run(cgt_cell *cell, cgt_result result, unsigned spes, outcome *o)
{
    if (result != CGT_OK)
        fail_msg("%s", cgt_cell_get_message(cell));
    for (unsigned i = 0; i < spes; i++)
        o->spe[i] = cgt_cell_get_result(cell, i);
    cgt_cell_destroy(cell);
}

static cgt_cell *make_cell(unsigned spes, outcome *o)
{
    cgt_cell *cell;
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = spes, .cycle_limit = UINT64_C(1) << 32}, &cell),
                     CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, MEMORY_EA, o->memory, MEMORY_WORDS, 4, true), CGT_OK);
    return cell;
}

/* counts: whether those of DMA depend on nothing but the program */
static void compare(const char *name, cgt_spe_function *function, unsigned spes, uint64_t argument, bool counts)
{
    cgt_spe_unit unit[CGT_MAX_SPES];
    cgt_spe_program program[CGT_MAX_SPES];
    uint32_t next[CGT_MAX_SPES + 1] = {[CGT_MAX_SPES] = spes};
    test_random r = random_make(7201);
    for (unsigned i = 0; i < MEMORY_WORDS; i++)
        simulated.memory[i] = native.memory[i] = (uint32_t)random_bits(&r);
    load(name, spes, argument, unit);
    cgt_cell *cell = make_cell(spes, &simulated);
    end_run(cell, cgt_cell_run_simulated(cell, unit, hand_out, next), spes, &simulated);
    for (unsigned i = 0; i < spes; i++) {
        cgt_spu_destroy(&spu[i]);
        program[i] = (cgt_spe_program){.function = function, .argument = argument};
    }
    cell = make_cell(spes, &native);
    end_run(cell, cgt_cell_run_native(cell, program, hand_out, next), spes, &native);
    assert_memory_equal(simulated.memory, native.memory, sizeof native.memory);
    for (unsigned i = 0; i < spes; i++) {
        cgt_mfc_counts *const a = &simulated.spe[i].counts, *const b = &native.spe[i].counts;
        assert_int_equal(simulated.spe[i].code, native.spe[i].code);
        a->wait_cycles = b->wait_cycles = 0;
        if (counts)
            assert_memory_equal(a, b, sizeof *a);
    }
}

/* the PPE's rows go to programs that read no mailbox as well: one value waits there */
static void same_source_both_ways(void **state)
{
    (void)state;
    static const unsigned spe_counts[] = {1, 2, 6, 16};
    for (unsigned k = 0; k < TEST_COUNT(spe_counts); k++) {
        const unsigned spes = spe_counts[k];
        compare("squares", squares, spes, MEMORY_EA, true);
        compare("counter", counter, spes, MEMORY_EA, spes == 1);
        compare("strips", strips, spes, MEMORY_EA, true);
        compare("ring", ring, spes, spes, true);
    }
}

int main(void)
{
    test_begin("test_cell_compiled");
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_source_both_ways)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
