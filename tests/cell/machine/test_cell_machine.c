/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Programs on one to sixteen SPEs, simulated and native: the same bits and as many DMAs both ways; simulated runs that
 * are the same in each cycle; a PPE that hands out work. What is simulated are instructions by hand; where SPU_PROGRAMS
 * names the folder of the programs as the SPU's own compiler made them, those. */
#include <stdio.h>
#include <string.h>

#include "cell/machine/spe_programs.h"
#include "support/suite.h"
#include "cell/spu/elf.h"
#include "core/memory.h"
#include "support/test.h"

#ifndef SPU_PROGRAMS
#define SPU_PROGRAMS NULL
#endif

#define MEMORY_EA 0x100000u
#define MEMORY_WORDS 8192u
#define ROWS 97u

typedef struct program {
    const char *name;
    cgt_spe_function *native;
    void (*assemble)(cgt_spu_assembler *p); /* NULL: simulated only where it is compiled */
    cgt_ppe_function *ppe;
} program;

static const char *const folder = SPU_PROGRAMS;

/* what a run leaves behind */
typedef struct outcome {
    uint32_t memory[MEMORY_WORDS];
    cgt_spe_result spe[CGT_MAX_SPES];
    cgt_mfc_trace trace;
} outcome;

/* ---- the PPE: rows to whoever is free ---- */

typedef struct work {
    uint32_t next, done;
    unsigned spes, stopped, started;
    uint32_t seen[ROWS];
} work;

static void hand_out(work *w, cgt_cell *cell, unsigned spe)
{
    const uint32_t row = w->next < ROWS ? w->next++ : STRIPS_END;
    assert_true(cgt_cell_send_mailbox(cell, spe, row));
}

static void hand_out_rows(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    work *const w = user;
    switch (event->kind) {
    case CGT_PPE_START:
        w->started++;
        for (unsigned i = 0; i < w->spes; i++) {
            hand_out(w, cell, i);
            hand_out(w, cell, i);
        }
        break;
    case CGT_PPE_MAILBOX:
        assert_true(event->value < ROWS);
        w->seen[event->value]++;
        w->done++;
        hand_out(w, cell, event->spe);
        break;
    case CGT_PPE_STOPPED: w->stopped++; break;
    case CGT_PPE_INTERRUPT: fail_msg("an interrupt"); break;
    }
}

/* ---- runs ---- */

static void fill(uint32_t *memory, uint64_t stream)
{
    test_random r = random_make(stream);
    for (unsigned i = 0; i < MEMORY_WORDS; i++)
        memory[i] = (uint32_t)random_bits(&r);
}

static cgt_cell *make_cell(unsigned spes, outcome *o)
{
    cgt_cell *cell;
    cgt_mfc_trace_init(&o->trace);
    const cgt_cell_options options = {.spes = spes, .trace = &o->trace, .cycle_limit = UINT64_C(1) << 40};
    assert_int_equal(cgt_cell_create(&options, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, MEMORY_EA, o->memory, MEMORY_WORDS, 4, true), CGT_OK);
    return cell;
}

static void end_run(cgt_cell *cell, cgt_result result, unsigned spes, outcome *o)
{
    if (result != CGT_OK)
        fail_msg("%s", cgt_cell_get_message(cell));
    for (unsigned i = 0; i < spes; i++)
        o->spe[i] = cgt_cell_get_result(cell, i);
    cgt_cell_destroy(cell);
}

static void load(const program *p, cgt_spu *spu)
{
    static char bytes[1 << 20];
    char path[1024];
    uint32_t word[256];
    cgt_spu_assembler a = {.word = word, .capacity = TEST_COUNT(word)};
    if (!folder) {
        p->assemble(&a);
        assert_true(cgt_spu_assembler_load(&a, spu));
        return;
    }
    snprintf(path, sizeof path, "%s/spe_%s.elf", folder, p->name);
    FILE *const file = fopen(path, "rb");
    if (!file)
        fail_msg("%s: cannot be opened", path);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    if (cgt_spu_load_elf(spu, bytes, size, path) != CGT_OK)
        fail_msg("%s", spu->message);
}

static void run_simulated(const program *p, unsigned spes, uint64_t argument, cgt_spu_mode mode, void *user, outcome *o)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    static cgt_spu spu[CGT_MAX_SPES];
    cgt_spe_unit unit[CGT_MAX_SPES];
    for (unsigned i = 0; i < spes; i++) {
        assert_int_equal(cgt_spu_create(&spu[i], &memory, mode), CGT_OK);
        load(p, &spu[i]);
        unit[i] = cgt_cell_unit_of(&spu[i], i, argument, 0);
    }
    cgt_cell *const cell = make_cell(spes, o);
    const cgt_result result = cgt_cell_run_simulated(cell, unit, p->ppe, user);
    for (unsigned i = 0; i < spes; i++)
        cgt_spu_destroy(&spu[i]);
    end_run(cell, result, spes, o);
}

static void run_native(const program *p, unsigned spes, uint64_t argument, void *user, outcome *o)
{
    cgt_spe_program programs[CGT_MAX_SPES];
    for (unsigned i = 0; i < spes; i++)
        programs[i] = (cgt_spe_program){.function = p->native, .argument = argument};
    cgt_cell *const cell = make_cell(spes, o);
    end_run(cell, cgt_cell_run_native(cell, programs, p->ppe, user), spes, o);
}

static void expect_same_traces(const cgt_mfc_trace *a, const cgt_mfc_trace *b)
{
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        const cgt_mfc_record *const x = &a->record[i], *const y = &b->record[i];
        assert_true(x->issued == y->issued && x->started == y->started && x->finished == y->finished &&
                    x->spe == y->spe && x->command == y->command && x->tag == y->tag && x->lsa == y->lsa &&
                    x->ea == y->ea && x->bytes == y->bytes && x->elements == y->elements);
    }
}

/* DMA ends in the order of simulated time, whoever gave it */
static void expect_rising(const cgt_mfc_trace *trace)
{
    for (size_t i = 1; i < trace->count; i++)
        assert_true(trace->record[i].finished >= trace->record[i - 1].finished);
}

static outcome simulated, again, native;

static void free_traces(void)
{
    cgt_mfc_trace_free(&simulated.trace);
    cgt_mfc_trace_free(&again.trace);
    cgt_mfc_trace_free(&native.trace);
}

/* ---- tests ---- */

static const unsigned spe_counts[] = {1, 2, 3, 6, 16};

/* floats of all kinds, in the SPU's arithmetic; every SPE by itself: everything is the same */
TEST(same_bits_both_ways)
{
    const program p = {"squares", squares, assemble_squares, NULL};
    for (unsigned k = 0; k < TEST_COUNT(spe_counts); k++) {
        const unsigned spes = spe_counts[k];
        fill(simulated.memory, 7101);
        fill(again.memory, 7101);
        fill(native.memory, 7101);
        run_simulated(&p, spes, MEMORY_EA, CGT_SPU_TIMED, NULL, &simulated);
        run_simulated(&p, spes, MEMORY_EA, CGT_SPU_TIMED, NULL, &again);
        run_native(&p, spes, MEMORY_EA, NULL, &native);
        assert_memory_equal(simulated.memory, native.memory, sizeof native.memory);
        assert_memory_equal(simulated.memory, again.memory, sizeof again.memory);
        expect_same_traces(&simulated.trace, &again.trace);
        expect_rising(&simulated.trace);
        for (unsigned i = 0; i < spes; i++) {
            cgt_mfc_counts a = simulated.spe[i].counts, b = native.spe[i].counts;
            assert_true(a.gets == 1 && a.puts == 1 && a.bytes_in == 1024 && a.bytes_out == 1024 && a.wait_cycles > 300);
            a.wait_cycles = b.wait_cycles = 0;
            assert_memory_equal(&a, &b, sizeof a);
            assert_true(simulated.spe[i].stopped && native.spe[i].stopped);
            assert_int_equal(simulated.spe[i].code, 0x2007);
            assert_int_equal(native.spe[i].code, 0x2007);
            assert_true(simulated.spe[i].cycle == again.spe[i].cycle);
        }
        free_traces();
    }
}

/* a word that all SPEs raise; with more than one, some putllc fail */
TEST(contention)
{
    const program p = {"counter", counter, assemble_counter, NULL};
    for (unsigned k = 0; k < TEST_COUNT(spe_counts); k++) {
        const unsigned spes = spe_counts[k];
        uint64_t lost = 0;
        memset(simulated.memory, 0, sizeof simulated.memory);
        memset(again.memory, 0, sizeof again.memory);
        memset(native.memory, 0, sizeof native.memory);
        run_simulated(&p, spes, MEMORY_EA, CGT_SPU_TIMED, NULL, &simulated);
        run_simulated(&p, spes, MEMORY_EA, CGT_SPU_TIMED, NULL, &again);
        run_native(&p, spes, MEMORY_EA, NULL, &native);
        assert_int_equal(simulated.memory[0], spes * COUNTER_ROUNDS);
        assert_int_equal(native.memory[0], spes * COUNTER_ROUNDS);
        expect_same_traces(&simulated.trace, &again.trace);
        expect_rising(&simulated.trace);
        for (unsigned i = 0; i < spes; i++) {
            const cgt_mfc_counts *const c = &simulated.spe[i].counts;
            assert_int_equal(c->atomics, 2 * (COUNTER_ROUNDS + c->lost_lines));
            lost += c->lost_lines;
        }
        assert_true(spes == 1 ? lost == 0 : lost > 0);
        free_traces();
    }
}

static void check_rows(const outcome *o, const work *w, unsigned spes)
{
    static uint32_t want[MEMORY_WORDS];
    uint64_t gets = 0;
    fill(want, 7102);
    for (unsigned i = 0; i < 32 * ROWS; i++)
        want[i] += i / 32;
    assert_memory_equal(o->memory, want, sizeof want);
    assert_int_equal(w->started, 1);
    assert_int_equal(w->done, ROWS);
    assert_int_equal(w->stopped, spes);
    for (unsigned i = 0; i < ROWS; i++)
        assert_int_equal(w->seen[i], 1);
    for (unsigned i = 0; i < spes; i++)
        gets += o->spe[i].counts.gets;
    assert_int_equal(gets, ROWS);
}

/* Work that goes to whoever is free: who does what differs natively, the rows do not. Timed or not. */
TEST(rows_from_a_ppe)
{
    const program p = {"strips", strips, assemble_strips, hand_out_rows};
    for (unsigned k = 0; k < TEST_COUNT(spe_counts); k++) {
        const unsigned spes = spe_counts[k];
        work ppe[4] = {{.spes = spes}, {.spes = spes}, {.spes = spes}, {.spes = spes}};
        fill(simulated.memory, 7102);
        run_simulated(&p, spes, MEMORY_EA, CGT_SPU_TIMED, &ppe[0], &simulated);
        check_rows(&simulated, &ppe[0], spes);
        fill(again.memory, 7102);
        run_simulated(&p, spes, MEMORY_EA, CGT_SPU_TIMED, &ppe[1], &again);
        check_rows(&again, &ppe[1], spes);
        expect_same_traces(&simulated.trace, &again.trace);
        expect_rising(&simulated.trace);
        cgt_mfc_trace_free(&again.trace);
        fill(again.memory, 7102);
        run_simulated(&p, spes, MEMORY_EA, CGT_SPU_UNTIMED, &ppe[2], &again);
        check_rows(&again, &ppe[2], spes);
        fill(native.memory, 7102);
        run_native(&p, spes, MEMORY_EA, &ppe[3], &native);
        check_rows(&native, &ppe[3], spes);
        free_traces();
    }
}

/* signals, and DMA from one local store to another's */
TEST(token_in_a_ring)
{
    const program p = {"ring", ring, NULL, NULL};
    for (unsigned k = 0; k < 10; k++) {
        const unsigned spes = 1 + k / 2;
        if (k % 2 && !folder)
            continue;
        if (k % 2)
            run_simulated(&p, spes, spes, CGT_SPU_TIMED, NULL, &native);
        else
            run_native(&p, spes, spes, NULL, &native);
        for (unsigned i = 0; i < spes; i++) {
            assert_int_equal(native.spe[i].counts.signals, RING_ROUNDS);
            assert_int_equal(native.spe[i].counts.bytes_out, 16 * RING_ROUNDS);
        }
        assert_int_equal(native.spe[0].code, 0x2000 + spes * RING_ROUNDS);
        cgt_mfc_trace_free(&native.trace);
    }
}

SEEDED_SUITE("test_cell_machine", NULL, NULL)
