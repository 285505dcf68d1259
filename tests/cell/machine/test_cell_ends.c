/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How programs meet the PPE, and how they end: stops, halts, broken rules while others wait, deadlocks, limits; and bad
 * arguments. */
#include <string.h>

#include "cell/machine/spe_program.h"
#include "support/suite.h"
#include "cell/support/fake_spu.h"
#include "support/test.h"

#define MEMORY_EA 0x10000u

typedef struct store {
    _Alignas(128) uint32_t line[32];
} store;
CGT_SPE_STORE(store, s)

static uint32_t memory[1024];
static fake_spu fake[CGT_MAX_SPES];

static cgt_cell *make_cell(unsigned spes)
{
    cgt_cell *cell;
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = spes}, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, MEMORY_EA, memory, 1024, 4, true), CGT_OK);
    return cell;
}

static cgt_result run_fakes(cgt_cell *cell, unsigned spes, const fake_step *const *steps, cgt_ppe_function *ppe,
                            void *user)
{
    cgt_spe_unit unit[CGT_MAX_SPES];
    for (unsigned i = 0; i < spes; i++) {
        fake_init(&fake[i], steps[i]);
        fake[i].number = i;
        unit[i] = fake_unit(&fake[i]);
    }
    return cgt_cell_run_simulated(cell, unit, ppe, user);
}

/* ---- the PPE ---- */

/* Each word of the program asks for something else; the PPE answers with what it saw. */
static void answer(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    unsigned *const interrupts = user;
    static const uint32_t words[4] = {41, 42, 43, 44};
    uint32_t seen = 0;
    if (event->kind == CGT_PPE_MAILBOX) {
        assert_true(cgt_cell_read(cell, MEMORY_EA + 4 * event->value, &seen, sizeof seen));
        assert_true(cgt_cell_send_mailbox(cell, event->spe, seen));
    } else if (event->kind == CGT_PPE_INTERRUPT) {
        ++*interrupts;
        assert_true(cgt_cell_write(cell, MEMORY_EA + 128, words, sizeof words));
        cgt_cell_send_signal(cell, event->spe, 1, event->value);
        cgt_cell_send_signal(cell, event->spe, 1, event->value << 4);
        cgt_cell_send_signal(cell, event->spe, 2, event->value << 8);
    }
    assert_false(cgt_cell_read(cell, 0x500, &seen, 4));
    assert_false(cgt_cell_write(cell, MEMORY_EA + 4092, words, 8));
    assert_false(cgt_cell_send_mailbox(cell, CGT_MAX_SPES, 1));
    cgt_cell_send_signal(cell, CGT_MAX_SPES, 1, 1);
}

/* A reservation that the PPE's write takes away: the mailbox gives the value before it, the signals gather. */
CGT_SPE_MAIN(ask)
{
    mfc_getllar(s()->line, argument + 128, 0, 0);
    if (mfc_read_atomic_status() != MFC_GETLLAR_STATUS)
        return 1;
    spu_write_out_mbox(5);
    const unsigned seen = spu_read_in_mbox();
    spu_write_out_intr_mbox(3);
    const unsigned second = spu_read_signal2(); /* is sent last: both values of the other are there then */
    const unsigned gathered = spu_read_signal1();
    mfc_putllc(s()->line, argument + 128, 0, 0);
    if (mfc_read_atomic_status() != MFC_PUTLLC_STATUS)
        return 2;
    s()->line[0] = seen;
    s()->line[1] = second;
    s()->line[2] = gathered;
    s()->line[3] = 0;
    mfc_put(s()->line, argument + 256, 16, 0, 0, 0);
    spu_stop(0x123); /* the put ends all the same */
    return 3;
}

static void gather_answers(fake_spu *spu)
{
    for (unsigned i = 0; i < 3; i++)
        fake_store32(spu, 0x1000 + 4 * i, spu->read[1 + i]);
    fake_store32(spu, 0x100c, 0);
}

TEST(questions_to_the_ppe)
{
    const fake_step steps[] = {
        FAKE_DMA(0x1000, MEMORY_EA + 128, 128, 0, MFC_GETLLAR_CMD),
        {FAKE_READ, MFC_RdAtomicStat, 0, NULL},
        {FAKE_WRITE, SPU_WrOutMbox, 5, NULL},
        {FAKE_READ, SPU_RdInMbox, 0, NULL},
        {FAKE_WRITE, SPU_WrOutIntrMbox, 3, NULL},
        {FAKE_READ, SPU_RdSigNotify2, 0, NULL},
        {FAKE_READ, SPU_RdSigNotify1, 0, NULL},
        FAKE_DMA(0x1000, MEMORY_EA + 128, 128, 0, MFC_PUTLLC_CMD),
        {FAKE_READ, MFC_RdAtomicStat, 0, NULL},
        {FAKE_CALL, 0, 0, gather_answers},
        FAKE_DMA(0x1000, MEMORY_EA + 256, 16, 0, MFC_PUT_CMD),
        {FAKE_STOP, 0, 0x123, NULL},
    };
    for (unsigned native = 0; native < 2; native++) {
        unsigned interrupts = 0;
        cgt_cell *const cell = make_cell(1);
        memset(memory, 0, sizeof memory);
        memory[5] = 55;
        assert_int_equal(cgt_cell_set_signal_or(cell, 0, 1, true), CGT_OK);
        const cgt_spe_program program = {.function = ask, .argument = MEMORY_EA};
        const cgt_result result = native ? cgt_cell_run_native(cell, &program, answer, &interrupts)
                                         : run_fakes(cell, 1, (const fake_step *const[]){steps}, answer, &interrupts);
        assert_string_equal(cgt_cell_get_message(cell), "");
        assert_int_equal(result, CGT_OK);
        assert_int_equal(interrupts, 1);
        assert_int_equal(cgt_cell_get_result(cell, 0).code, 0x123);
        assert_int_equal(cgt_cell_get_result(cell, 0).counts.lost_lines, 1);
        assert_int_equal(memory[32], 41);
        assert_int_equal(memory[64], 55);
        assert_int_equal(memory[65], 0x300);
        assert_int_equal(memory[66], 0x33);
        cgt_cell_destroy(cell);
    }
}

/* What the PPE takes: a mailbox value of cycle 0 is served at 2,000, one that came meanwhile at 4,000. */
TEST(time_of_the_ppe)
{
    static const fake_step ask_twice[] = {{FAKE_WRITE, SPU_WrOutMbox, 0, NULL},
                                          {FAKE_READ, SPU_RdInMbox, 0, NULL},
                                          {FAKE_WRITE, SPU_WrOutMbox, 0, NULL},
                                          {FAKE_READ, SPU_RdInMbox, 0, NULL},
                                          {FAKE_STOP, 0, 0, NULL}};
    unsigned interrupts = 0;
    cgt_cell *const cell = make_cell(2);
    assert_int_equal(run_fakes(cell, 2, (const fake_step *const[]){ask_twice, ask_twice}, answer, &interrupts), CGT_OK);
    /* the start takes the first 2,000 */
    assert_int_equal(fake[0].when[0], 4000);
    assert_int_equal(fake[1].when[0], 6000);
    assert_int_equal(fake[0].when[1], 8000);
    assert_int_equal(fake[1].when[1], 10000);
    assert_int_equal(cgt_cell_get_result(cell, 0).counts.wait_cycles, 3999 + 3998);
    assert_int_equal(cgt_cell_get_result(cell, 0).waits.mailbox, 3999 + 3998);
    assert_int_equal(cgt_cell_get_result(cell, 0).waits.dma, 0);
    cgt_cell_destroy(cell);
}

/* An SPE that asks for counts instead of waiting sees the value no later than the next cycle that it asks in. */
static void ask_again(fake_spu *spu)
{
    if (spu->value == 0)
        spu->next -= 2;
}

TEST(polling)
{
    static const fake_step polls[] = {{FAKE_WRITE, SPU_WrOutMbox, 0, NULL},
                                      {FAKE_COUNT, SPU_RdInMbox, 0, NULL},
                                      {FAKE_CALL, 0, 0, ask_again},
                                      {FAKE_READ, SPU_RdInMbox, 0, NULL},
                                      {FAKE_STOP, 0, 0, NULL}};
    static const fake_step works[] = {{FAKE_WORK, 0, 100000, NULL}, {FAKE_STOP, 0, 0, NULL}};
    unsigned interrupts = 0;
    cgt_cell *const cell = make_cell(2);
    assert_int_equal(run_fakes(cell, 2, (const fake_step *const[]){polls, works}, answer, &interrupts), CGT_OK);
    assert_true(cgt_cell_get_result(cell, 0).cycle >= 4000 && cgt_cell_get_result(cell, 0).cycle < 10000);
    cgt_cell_destroy(cell);
}

/* An SPE that computes first gives its command later than the other, though it has the lower number: the memory's port
 * is free for the other until then. */
TEST(order_of_time)
{
    static const fake_step late[] = {
        {FAKE_WORK, 0, 3000, NULL}, FAKE_DMA(0, MEMORY_EA, 128, 0, MFC_PUT_CMD), {FAKE_STOP, 0, 0, NULL}};
    static const fake_step early[] = {FAKE_DMA(0, MEMORY_EA, 128, 0, MFC_PUT_CMD), {FAKE_STOP, 0, 0, NULL}};
    cgt_mfc_trace trace;
    cgt_cell *cell;
    cgt_mfc_trace_init(&trace);
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = 2, .trace = &trace}, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, MEMORY_EA, memory, 1024, 4, true), CGT_OK);
    assert_int_equal(run_fakes(cell, 2, (const fake_step *const[]){late, early}, NULL, NULL), CGT_OK);
    assert_int_equal(trace.count, 2);
    assert_true(trace.record[0].spe == 1 && trace.record[0].issued == 5 && trace.record[0].finished == 5 + 16 + 300);
    assert_true(trace.record[1].spe == 0 && trace.record[1].issued == 3005 && trace.record[1].finished == 3321);
    cgt_cell_destroy(cell);
    cgt_mfc_trace_free(&trace);
}

/* ---- ends ---- */

CGT_SPE_MAIN(wait_for_mail)
{
    if (spe == argument)
        mfc_get(s()->line, 0, 16, 0, 0, 0); /* no memory there */
    return (int)spu_read_in_mbox();
}

TEST(one_breaks_a_rule)
{
    static const fake_step waits[] = {{FAKE_READ, SPU_RdInMbox, 0, NULL}, {FAKE_STOP, 0, 0, NULL}};
    static const fake_step breaks[] = {FAKE_DMA(0, 0, 16, 0, MFC_GET_CMD), {FAKE_STOP, 0, 0, NULL}};
    const fake_step *const steps[] = {waits, waits, breaks, waits};
    const char *const want = "SPE 2: address: mfc_get(lsa 0x0, ea 0x0, size 16, tag 0): no memory at ea 0x0";
    cgt_spe_program programs[4];
    for (unsigned i = 0; i < 4; i++)
        programs[i] = (cgt_spe_program){.function = wait_for_mail, .argument = 2};
    cgt_cell *const cell = make_cell(4);
    assert_int_equal(run_fakes(cell, 4, steps, NULL, NULL), CGT_ERROR_STOPPED);
    assert_string_equal(cgt_cell_get_message(cell), want);
    assert_int_equal(cgt_cell_run_native(cell, programs, NULL, NULL), CGT_ERROR_STOPPED);
    assert_string_equal(cgt_cell_get_message(cell), want);
    for (unsigned i = 0; i < 4; i++) {
        assert_int_equal(cgt_cell_get_result(cell, i).rule, i == 2 ? CGT_RULE_ADDRESS : CGT_RULE_NONE);
        assert_false(cgt_cell_get_result(cell, i).stopped);
    }
    cgt_cell_destroy(cell);
}

/* some stop, the rest wait for mail that nobody sends */
TEST(some_wait_for_ever)
{
    static const fake_step waits[] = {{FAKE_READ, SPU_RdInMbox, 0, NULL}, {FAKE_STOP, 0, 0, NULL}};
    static const fake_step stops[] = {{FAKE_WORK, 0, 500, NULL}, {FAKE_STOP, 0, 0, NULL}};
    const char *const want = "deadlock: nothing can happen any more; waiting: SPE 0 for SPU_RdInMbox, SPE 1 for "
                             "SPU_RdInMbox";
    cgt_spe_program programs[2] = {{.function = wait_for_mail, .argument = 9},
                                   {.function = wait_for_mail, .argument = 9}};
    cgt_cell *const cell = make_cell(3);
    assert_int_equal(run_fakes(cell, 3, (const fake_step *const[]){waits, waits, stops}, NULL, NULL),
                     CGT_ERROR_STOPPED);
    assert_string_equal(cgt_cell_get_message(cell), want);
    cgt_cell_destroy(cell);
    cgt_cell *const two = make_cell(2);
    for (unsigned i = 0; i < test_scaled(50); i++) {
        assert_int_equal(cgt_cell_run_native(two, programs, NULL, NULL), CGT_ERROR_STOPPED);
        assert_string_equal(cgt_cell_get_message(two), want);
    }
    cgt_cell_destroy(two);
}

static void go_round(fake_spu *spu) { spu->next = 0; }

TEST(endless)
{
    static const fake_step steps[] = {{FAKE_WORK, 0, 10, NULL}, {FAKE_CALL, 0, 0, go_round}};
    fake_spu *const spu = &fake[0];
    cgt_result result;
    fake_init(spu, steps);
    cgt_cell *const cell = fake_run(spu, memory, 32, &(cgt_cell_options){.spes = 1, .cycle_limit = 100000}, &result);
    assert_int_equal(result, CGT_ERROR_STOPPED);
    assert_string_equal(cgt_cell_get_message(cell), "the limit of 100000 cycles is reached");
    cgt_cell_destroy(cell);
}

/* A decrementer that still runs when its program has ended keeps nobody. */
TEST(forgotten_decrementer)
{
    static const fake_step steps[] = {{FAKE_WRITE, SPU_WrDec, 0x7fffffff, NULL}, {FAKE_STOP, 0, 1, NULL}};
    cgt_result result;
    fake_init(&fake[0], steps);
    cgt_cell *const cell =
        fake_run(&fake[0], memory, 32, &(cgt_cell_options){.spes = 1, .cycle_limit = 100000}, &result);
    assert_int_equal(result, CGT_OK);
    cgt_cell_destroy(cell);
}

/* a wait for the decrementer's event, natively too */
CGT_SPE_MAIN(wait_for_time)
{
    spu_write_event_mask(MFC_DECREMENTER_EVENT);
    spu_write_decrementer(1000);
    const unsigned event = spu_read_event_status();
    return event == MFC_DECREMENTER_EVENT && spu_read_decrementer() == 0xffffffffu && mfc_tag_reserve() == 0 ? 1 : 2;
}

TEST(native_time)
{
    const cgt_spe_program program = {.function = wait_for_time};
    cgt_cell *const cell = make_cell(1);
    assert_int_equal(cgt_cell_run_native(cell, &program, NULL, NULL), CGT_OK);
    assert_int_equal(cgt_cell_get_result(cell, 0).code, 0x2001);
    assert_true(cgt_cell_get_result(cell, 0).cycle >= 1001 * 40);
    cgt_cell_destroy(cell);
}

/* ---- arguments ---- */

TEST(bad_arguments)
{
    cgt_cell *cell;
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = 0}, &cell), CGT_ERROR_INVALID_ARGUMENT);
    assert_null(cell);
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = 17}, &cell), CGT_ERROR_INVALID_ARGUMENT);
    cgt_cell_destroy(NULL);
    cell = make_cell(2);
    assert_int_equal(cgt_cell_add_memory(cell, CGT_SPE_EA(3), memory, 4, 4, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_cell_add_memory(cell, CGT_SPE_EA(0) - 128, memory, 64, 4, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_cell_add_memory(cell, CGT_SPE_EA(0) - 128, memory, 32, 4, true), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, CGT_SPE_EA(CGT_MAX_SPES), memory, 64, 4, true), CGT_OK);
    assert_int_equal(cgt_cell_set_signal_or(cell, 2, 1, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_cell_set_signal_or(cell, 0, 3, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_false(cgt_cell_get_result(cell, 0).stopped); /* nothing has run */
    assert_false(cgt_cell_get_result(cell, 99).stopped);
    const cgt_spe_unit none[2] = {{0}};
    assert_int_equal(cgt_cell_run_simulated(cell, none, NULL, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_string_not_equal(cgt_cell_get_message(cell), "");
    cgt_cell_destroy(cell);
    const cgt_mfc_timing timing = {.latency = 1};
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = 1, .timing = &timing}, &cell), CGT_OK);
    const cgt_spe_program program = {.function = wait_for_time};
    assert_int_equal(cgt_cell_run_native(cell, &program, NULL, NULL), CGT_ERROR_INVALID_ARGUMENT);
    cgt_cell_destroy(cell);
}

SEEDED_SUITE("test_cell_ends", NULL, NULL)
