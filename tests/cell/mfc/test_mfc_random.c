/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random commands, good ones and now and then a bad one, given by a simulated and by a native program: the same
 * message, memory, local store and counts, with and without jitter. */
#include <string.h>

#include "cell/machine/spe_program.h"
#include "support/suite.h"
#include "cell/support/fake_spu.h"
#include "support/test.h"

#define MEMORY_EA 0x10000u
#define WORDS 1024u
#define STORE_BYTES 0x3000u /* of local store that takes part */
#define LIST_LSA 0x2000u    /* up to STORE_BYTES: lists, which no command overwrites */
#define MAX_COMMANDS 60

typedef struct given {
    uint32_t lsa, eal, size, tag, command;
} given;

typedef struct program {
    given command[MAX_COMMANDS];
    unsigned count;
    uint32_t store[STORE_BYTES / 4]; /* at first */
} program;

typedef struct outcome {
    uint32_t memory[WORDS], store[STORE_BYTES / 4];
    char message[CGT_CELL_MESSAGE_BYTES];
    cgt_mfc_counts counts;
} outcome;

/* ---- commands ---- */

static bool is_list(uint32_t command) { return (command & 0x84) == 0x04; }

/* an atomic command: no tag waits for it */
static bool is_atomic(uint32_t command)
{
    return command == MFC_GETLLAR_CMD || command == MFC_PUTLLC_CMD || command == MFC_PUTLLUC_CMD;
}

static bool has_atomic(const program *p)
{
    for (unsigned i = 0; i < p->count; i++)
        if (is_atomic(p->command[i].command))
            return true;
    return false;
}

static void make_element(test_random *r, uint32_t element[2], uint32_t *room)
{
    uint32_t size = 16 * random_below(r, 6);
    if (size > *room)
        size = 0;
    *room -= size;
    element[0] = size;
    element[1] = MEMORY_EA + 16 * random_below(r, (4 * WORDS - size) / 16);
    if (random_below(r, 400) == 0)
        element[random_below(r, 2)] += 4;
}

static given make_command(test_random *r)
{
    static const uint32_t commands[] = {
        MFC_GET_CMD,   MFC_GETF_CMD,  MFC_GETB_CMD,    MFC_PUT_CMD,    MFC_PUTF_CMD,    MFC_PUTB_CMD,     MFC_GETL_CMD,
        MFC_GETLF_CMD, MFC_PUTL_CMD,  MFC_PUTLB_CMD,   MFC_PUTR_CMD,   MFC_SDCRZ_CMD,   MFC_BARRIER_CMD,  MFC_SYNC_CMD,
        MFC_EIEIO_CMD, MFC_SDCRT_CMD, MFC_GETLLAR_CMD, MFC_PUTLLC_CMD, MFC_PUTLLUC_CMD, MFC_PUTQLLUC_CMD,
    };
    static const uint32_t sizes[] = {4, 8, 16, 32, 128, 240, 1024, 2048};
    given g = {.command = commands[random_below(r, TEST_COUNT(commands))], .tag = random_below(r, 4)};
    g.size = sizes[random_below(r, TEST_COUNT(sizes))];
    const bool line = g.command >= MFC_PUTLLUC_CMD && g.command != MFC_BARRIER_CMD && g.command != MFC_SYNC_CMD &&
                      g.command != MFC_EIEIO_CMD;
    const uint32_t step = line ? 128 : g.size < 16 ? g.size : 16, place = line ? 128 : 16;
    g.eal = MEMORY_EA + step * random_below(r, (4 * WORDS - g.size) / step);
    g.lsa = place * random_below(r, (LIST_LSA - 2048) / place) + (line ? 0 : g.eal % 16);
    if (is_list(g.command)) {
        g.size = 8 * (1 + random_below(r, 20));
        g.eal = LIST_LSA + 8 * random_below(r, (STORE_BYTES - LIST_LSA - g.size) / 8);
    }
    switch (random_below(r, 300)) { /* mostly nothing */
    case 0: g.size += 4; break;
    case 1: g.eal += 4; break;
    case 2: g.lsa += 0x40000; break;
    case 3: g.tag += 32; break;
    case 4: g.command ^= 1u << random_below(r, 8); break;
    case 5: g.eal -= 0x1000; break;
    }
    return g;
}

static void make_program(test_random *r, program *p)
{
    p->count = 1 + random_below(r, MAX_COMMANDS);
    for (unsigned i = 0; i < LIST_LSA / 4; i++)
        p->store[i] = (uint32_t)random_bits(r);
    for (unsigned i = LIST_LSA / 4; i < STORE_BYTES / 4; i += 2) {
        uint32_t room = 96; /* twenty elements stay below the lists */
        make_element(r, &p->store[i], &room);
    }
    for (unsigned i = 0; i < p->count; i++)
        p->command[i] = make_command(r);
}

/* ---- runs ---- */

static program given_program;

static cgt_cell *make_cell(outcome *o, uint32_t jitter)
{
    cgt_cell *cell;
    cgt_mfc_timing timing = cgt_mfc_default_timing;
    timing.jitter = jitter;
    for (uint32_t i = 0; i < WORDS; i++)
        o->memory[i] = i * 0x9e3779b9u;
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = 1, .timing = &timing}, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, MEMORY_EA, o->memory, WORDS, 4, true), CGT_OK);
    return cell;
}

static void end_run(cgt_cell *cell, outcome *o)
{
    snprintf(o->message, sizeof o->message, "%s", cgt_cell_get_message(cell));
    o->counts = cgt_cell_get_result(cell, 0).counts;
    o->counts.wait_cycles = 0;
    cgt_cell_destroy(cell);
}

static void run_simulated(outcome *o, uint32_t jitter)
{
    static fake_spu spu;
    static fake_step steps[6 * MAX_COMMANDS + 5];
    unsigned n = 0;
    for (unsigned i = 0; i < given_program.count; i++) {
        const given *const g = &given_program.command[i];
        const fake_step dma[] = {FAKE_DMA(g->lsa, g->eal, g->size, g->tag, g->command)};
        memcpy(&steps[n], dma, sizeof dma);
        n += TEST_COUNT(dma);
    }
    if (has_atomic(&given_program))
        steps[n++] = (fake_step){FAKE_READ, MFC_RdAtomicStat, 0, NULL};
    const fake_step wait[] = {FAKE_WAIT(0xffffffffu), {FAKE_STOP, 0, 0, NULL}};
    memcpy(&steps[n], wait, sizeof wait);
    fake_init(&spu, steps);
    for (uint32_t i = 0; i < STORE_BYTES / 4; i++)
        fake_store32(&spu, 4 * i, given_program.store[i]);
    cgt_cell *const cell = make_cell(o, jitter);
    const cgt_spe_unit unit = fake_unit(&spu);
    (void)cgt_cell_run_simulated(cell, &unit, NULL, NULL);
    for (uint32_t i = 0; i < STORE_BYTES / 4; i++)
        o->store[i] = fake_load32(&spu, 4 * i);
    end_run(cell, o);
}

static outcome *native_outcome;

/* The store is looked at while it is there. */
static int give_commands(unsigned long long spe, unsigned long long argument, unsigned long long environment)
{
    uint8_t *const arena = cgt_spe_arena();
    (void)spe;
    (void)argument;
    (void)environment;
    memcpy(arena, given_program.store, sizeof given_program.store);
    for (unsigned i = 0; i < given_program.count; i++) {
        const given *const g = &given_program.command[i];
        spu_mfcdma64(arena + g->lsa, 0, g->eal + (is_list(g->command) ? (uint32_t)(uintptr_t)arena : 0), g->size,
                     g->tag, g->command);
    }
    if (has_atomic(&given_program))
        (void)mfc_read_atomic_status();
    mfc_write_tag_mask(-1);
    mfc_read_tag_status_all();
    memcpy(native_outcome->store, arena, sizeof native_outcome->store);
    return 0;
}

static void run_native(outcome *o, uint32_t jitter)
{
    cgt_cell *const cell = make_cell(o, jitter);
    const cgt_spe_program p = {.function = give_commands};
    native_outcome = o;
    (void)cgt_cell_run_native(cell, &p, NULL, NULL);
    end_run(cell, o);
}

TEST(both_ways)
{
    static outcome simulated, native;
    test_random r = random_make(7301);
    const uint32_t runs = test_scaled(400);
    unsigned failed = 0;
    for (uint32_t i = 0; i < runs; i++) {
        const uint32_t jitter = i % 2 ? random_below(&r, 2000) : 0;
        make_program(&r, &given_program);
        run_simulated(&simulated, jitter);
        run_native(&native, jitter);
        if (strcmp(simulated.message, native.message) != 0)
            fail_msg("run %u: simulated \"%s\", native \"%s\"", i, simulated.message, native.message);
        assert_memory_equal(simulated.memory, native.memory, sizeof native.memory);
        assert_memory_equal(&simulated.counts, &native.counts, sizeof native.counts);
        if (!simulated.message[0])
            assert_memory_equal(simulated.store, native.store, sizeof native.store);
        failed += simulated.message[0] != '\0';
    }
    print_message("%u of %u runs broke a rule\n", failed, runs);
    if (runs >= 100)
        assert_true(failed > runs / 10 && failed < 9 * runs / 10);
}

SEEDED_SUITE("test_mfc_random", NULL, NULL)
