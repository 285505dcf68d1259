/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random DMA against a reference: a list of the commands given, from which the definitions of fence, barrier and tag
 * say which must have ended before which begins; and main memory and local store as they become when the commands'
 * bytes move in the order in which the trace says that they ended. A jitter lets commands overtake each other where
 * they may. That they do is checked, too: a queue that keeps everything in order would pass the rest. */
#include <string.h>

#include "cell/support/mfc_world.h"
#include "support/suite.h"

#define WORDS 64u /* of main memory, and of the part of local store that takes part */
#define MAX_COMMANDS 400

typedef struct given {
    uint32_t command, tag, lsa, ea, size;
} given;

/* ---- a run ---- */

static uint64_t cycle;

static void begin(uint32_t jitter, uint32_t seed)
{
    cgt_mfc_timing timing = cgt_mfc_default_timing;
    timing.jitter = jitter;
    timing.jitter_seed = seed;
    cycle = 0;
    mfc_world_begin(&timing);
}

/* Each write takes a cycle; one that stalls waits for the next event. */
static void write_channel(unsigned channel, uint32_t value)
{
    cgt_channel_status status;
    while ((status = world.c.write(world.mfc, channel, cycle++, value)) == CGT_CHANNEL_STALL)
        cycle = cgt_mfc_next_event(world.mfc);
    assert_int_equal(status, CGT_CHANNEL_DONE);
}

static void give_command(const given *g)
{
    write_channel(MFC_LSA, g->lsa);
    write_channel(MFC_EAL, g->ea);
    write_channel(MFC_Size, g->size);
    write_channel(MFC_TagID, g->tag);
    write_channel(MFC_Cmd, g->command);
}

static given random_command(test_random *r)
{
    static const uint32_t commands[] = {
        MFC_GET_CMD,  MFC_GET_CMD,  MFC_GET_CMD,  MFC_PUT_CMD,  MFC_PUT_CMD,   MFC_PUT_CMD,     MFC_GETF_CMD,
        MFC_GETB_CMD, MFC_PUTF_CMD, MFC_PUTB_CMD, MFC_SYNC_CMD, MFC_EIEIO_CMD, MFC_BARRIER_CMD,
    };
    static const uint32_t sizes[] = {4, 8, 16, 16, 32, 48, 128};
    given g = {.command = commands[random_below(r, TEST_COUNT(commands))], .tag = random_below(r, 3)};
    if (g.command >= MFC_BARRIER_CMD)
        return g;
    g.size = sizes[random_below(r, TEST_COUNT(sizes))];
    const uint32_t step = g.size < 16 ? g.size : 16;
    g.ea = random_below(r, (4 * WORDS - g.size) / step + 1) * step;
    /* the same low four bits on both sides */
    g.lsa = random_below(r, (4 * WORDS - g.size - g.ea % 16) / 16 + 1) * 16 + g.ea % 16;
    g.ea += MEMORY_EA;
    return g;
}

/* ---- the reference ---- */

static bool is_fenced(uint32_t command) { return command == MFC_GETF_CMD || command == MFC_PUTF_CMD; }
static bool is_barrier(uint32_t command) { return command == MFC_GETB_CMD || command == MFC_PUTB_CMD; }
static bool is_sync(uint32_t command) { return command == MFC_SYNC_CMD || command == MFC_EIEIO_CMD; }

/* whether command i must end before command j > i begins */
static bool must_precede(const given *g, unsigned i, unsigned j)
{
    if (g[i].command == MFC_BARRIER_CMD || g[j].command == MFC_BARRIER_CMD)
        return true;
    if (g[i].tag != g[j].tag)
        return false;
    if (is_fenced(g[j].command) || is_sync(g[i].command) || is_sync(g[j].command))
        return true;
    for (unsigned k = i + 1; k <= j; k++)
        if (g[k].tag == g[j].tag && is_barrier(g[k].command))
            return true;
    return false;
}

/* The record of each command. The trace is in the order of ends; each command was issued in a cycle of its own. */
static void find_records(const given *g, unsigned count, const cgt_mfc_record **record)
{
    assert_int_equal(world.trace.count, count);
    for (unsigned k = 0; k < count; k++) {
        const cgt_mfc_record *const r = &world.trace.record[k];
        unsigned earlier = 0;
        for (unsigned i = 0; i < count; i++)
            earlier += world.trace.record[i].issued < r->issued;
        record[earlier] = r;
        assert_int_equal(r->tag, g[earlier].tag);
        assert_int_equal(r->bytes, g[earlier].size);
    }
}

/* checks the order; returns how many pairs, free to do so, ended in the other order */
static unsigned check_order(const given *g, unsigned count, const cgt_mfc_record *const *record)
{
    unsigned overtakes = 0;
    for (unsigned j = 0; j < count; j++)
        for (unsigned i = 0; i < j; i++) {
            if (must_precede(g, i, j) && record[i]->finished > record[j]->started)
                fail_msg("command %u (0x%x, tag %u) begins in %llu, before command %u (0x%x, tag %u) ends in %llu", j,
                         g[j].command, g[j].tag, (unsigned long long)record[j]->started, i, g[i].command, g[i].tag,
                         (unsigned long long)record[i]->finished);
            overtakes += record[i]->finished > record[j]->finished;
        }
    return overtakes;
}

static uint32_t load(const uint8_t *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static void store(uint8_t *b, uint32_t value)
{
    for (unsigned i = 0; i < 4; i++)
        b[i] = (uint8_t)(value >> (24 - 8 * i));
}

/* the same moves, word by word, in the order of the trace */
static void replay(const cgt_mfc_trace *trace, uint8_t *local, uint32_t *memory)
{
    for (size_t i = 0; i < trace->count; i++) {
        const cgt_mfc_record *const r = &trace->record[i];
        for (uint32_t k = 0; k < r->bytes; k += 4) {
            uint32_t *const word = &memory[(r->ea - MEMORY_EA + k) / 4];
            if (strncmp(r->command, "mfc_get", 7) == 0)
                store(local + r->lsa + k, *word);
            else
                *word = load(local + r->lsa + k);
        }
    }
}

static unsigned run_random(test_random *r, unsigned count, uint32_t jitter)
{
    static given g[MAX_COMMANDS];
    static const cgt_mfc_record *record[MAX_COMMANDS];
    static uint8_t local[sizeof world.store];
    uint32_t memory[WORDS];
    begin(jitter, (uint32_t)random_bits(r));
    for (unsigned i = 0; i < WORDS; i++) {
        memory[i] = world.memory[i] = (uint32_t)random_bits(r);
        store(world.store + 4 * (size_t)i, (uint32_t)random_bits(r));
    }
    memcpy(local, world.store, sizeof local);
    for (unsigned i = 0; i < count; i++) {
        g[i] = random_command(r);
        give_command(&g[i]);
        cycle += random_below(r, 4) == 0 ? random_below(r, 1000) : 0;
    }
    while (cgt_mfc_is_busy(world.mfc))
        cgt_mfc_advance(world.mfc, cgt_mfc_next_event(world.mfc));
    assert_int_equal(cgt_mfc_get_error(world.mfc, NULL), CGT_RULE_NONE);
    find_records(g, count, record);
    const unsigned overtakes = check_order(g, count, record);
    replay(&world.trace, local, memory);
    assert_memory_equal(memory, world.memory, sizeof memory);
    assert_memory_equal(local, world.store, sizeof local);
    mfc_world_end();
    return overtakes;
}

TEST(random_orders)
{
    test_random r = random_make(7001);
    unsigned overtakes = 0;
    const uint32_t runs = test_scaled(200);
    for (uint32_t i = 0; i < runs; i++)
        overtakes += run_random(&r, 1 + random_below(&r, MAX_COMMANDS), random_below(&r, 2000));
    print_message("%u overtakes in %u runs\n", overtakes, runs);
    assert_true(overtakes > 10 * runs);
}

/* without jitter, too */
TEST(orders_without_jitter)
{
    test_random r = random_make(7002);
    for (uint32_t i = 0; i < test_scaled(20); i++)
        (void)run_random(&r, 100, 0);
}

/* the same seed gives the same trace; another one another */
TEST(jitter_repeats)
{
    uint64_t finished[3][50];
    for (unsigned k = 0; k < 3; k++) {
        test_random r = random_make(7003);
        begin(500, k == 2);
        for (unsigned i = 0; i < 50; i++) {
            const given g = random_command(&r);
            give_command(&g);
        }
        cgt_mfc_advance(world.mfc, 1000000);
        assert_int_equal(world.trace.count, 50);
        for (unsigned i = 0; i < 50; i++)
            finished[k][i] = world.trace.record[i].finished;
        mfc_world_end();
    }
    assert_memory_equal(finished[0], finished[1], sizeof finished[0]);
    assert_int_not_equal(memcmp(finished[0], finished[2], sizeof finished[0]), 0);
}

SEEDED_SUITE("test_mfc_order", NULL, NULL)
