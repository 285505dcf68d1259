/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Each rule of the MFC, broken by a simulated and by a native program: the same name, the same sentence. */
#include <string.h>

#include "cell/machine/spe_program.h"
#include "support/suite.h"
#include "cell/support/fake_spu.h"
#include "support/test.h"

#define MEMORY_EA 0x10000   /* 64 words, writable */
#define FIXED_EA 0x20000    /* 64 words, not writable */
#define DOUBLES_EA 0x30000  /* 16 elements of 8 bytes */
#define LIST_LSA 0x1000     /* two elements; the second word of each is in the table */
#define HIGH_EA 0xfffff000u /* up to 4 GB */

/* one command, with the elements of its list, and what its message begins with; NULL: it breaks no rule */
typedef struct broken {
    uint32_t lsa;
    uint64_t ea;
    uint32_t size, tag, command;
    uint32_t element[2][2];
    const char *message;
} broken;

static const broken table[] = {
    {0x100, MEMORY_EA, 16, 0, 0x43, {{0}}, "command: MFC_Cmd(0x43, lsa 0x100, ea 0x10000, size 16, tag 0)"},
    {0x100, MEMORY_EA, 16, 32, MFC_GET_CMD, {{0}}, "tag: mfc_get(lsa 0x100, ea 0x10000, size 16, tag 32)"},
    {0, 0, 0, 99, MFC_BARRIER_CMD, {{0}}, "tag: mfc_barrier("},
    {0x100, MEMORY_EA, 0, 0, MFC_GET_CMD, {{0}}, "size: mfc_get(lsa 0x100, ea 0x10000, size 0, tag 0): 0 bytes"},
    {0x100, MEMORY_EA, 24, 3, MFC_PUTF_CMD, {{0}}, "size: mfc_putf(lsa 0x100, ea 0x10000, size 24, tag 3): 24 bytes"},
    {0x100, MEMORY_EA, 3, 0, MFC_GETB_CMD, {{0}}, "size: mfc_getb"},
    {0x100, MEMORY_EA, 16400, 0, MFC_GET_CMD, {{0}}, "size: mfc_get"},
    {0x10c, CGT_SPE_SIGNAL_EA(0, 1), 8, 0, MFC_SNDSIG_CMD, {{0}}, "size: mfc_sndsig"},
    {0x108, MEMORY_EA + 8, 16, 0, MFC_GET_CMD, {{0}}, "alignment: mfc_get"},
    {0x102, MEMORY_EA + 2, 4, 0, MFC_PUT_CMD, {{0}}, "alignment: mfc_put"},
    {0x140, MEMORY_EA, 128, 0, MFC_GETLLAR_CMD, {{0}}, "alignment: mfc_getllar"},
    {0x100, MEMORY_EA + 64, 128, 0, MFC_PUTLLC_CMD, {{0}}, "alignment: mfc_putllc"},
    {0x104, MEMORY_EA + 8, 4, 0, MFC_GET_CMD, {{0}}, "low bits: mfc_get"},
    {0x3fff0, MEMORY_EA, 32, 0, MFC_GET_CMD, {{0}}, "local store: mfc_get"},
    {0x40000, MEMORY_EA, 16, 0, MFC_PUT_CMD, {{0}}, "local store: mfc_put"},
    {0x100, 0x0fff0, 16, 0, MFC_GET_CMD, {{0}}, "address: mfc_get(lsa 0x100, ea 0xfff0, size 16, tag 0)"},
    {0x100, UINT64_C(0x700000000), 16, 0, MFC_GET_CMD, {{0}}, "address: mfc_get(lsa 0x100, ea 0x700000000"},
    {0x100, MEMORY_EA + 240, 32, 0, MFC_PUT_CMD, {{0}}, "bounds: mfc_put"},
    {0x100, FIXED_EA, 16, 0, MFC_PUTB_CMD, {{0}}, "read only: mfc_putb"},
    {0x100, FIXED_EA, 128, 0, MFC_PUTLLUC_CMD, {{0}}, "read only: mfc_putlluc"},
    {0, FIXED_EA, 16, 0, MFC_SDCRZ_CMD, {{0}}, "read only: mfc_sdcrz"},
    {0x100, MEMORY_EA, 2, 0, MFC_GET_CMD, {{0}}, "unit: mfc_get"},
    {0x100, DOUBLES_EA, 4, 0, MFC_GET_CMD, {{0}}, "unit: mfc_get"},
    {0x10c, CGT_SPE_SIGNAL_EA(0, 1), 4, 0, MFC_PUT_CMD, {{0}}, "register: mfc_put"},
    {0x100, MEMORY_EA, 4, 0, MFC_SNDSIG_CMD, {{0}}, "register: mfc_sndsig"},
    {0x100,
     LIST_LSA,
     12,
     5,
     MFC_GETL_CMD,
     {{0}},
     "list size: mfc_getl(lsa 0x100, eah 0x0, list 0x1000, size 12, tag 5)"},
    {0x100, LIST_LSA, 0, 0, MFC_GETL_CMD, {{0}}, "list size: mfc_getl"},
    {0x100, LIST_LSA, 16392, 0, MFC_PUTL_CMD, {{0}}, "list size: mfc_putl"},
    {0x100, LIST_LSA + 4, 8, 0, MFC_PUTLF_CMD, {{0}}, "list address: mfc_putlf"},
    {0x100, 0x3fff8, 16, 0, MFC_PUTLB_CMD, {{0}}, "list address: mfc_putlb"},
    {0x100, LIST_LSA, 16, 2, MFC_GETL_CMD, {{16, MEMORY_EA}, {48, HIGH_EA + 0xfe0}}, "list crossing: mfc_getl"},
    {0x100,
     LIST_LSA,
     16,
     2,
     MFC_GETL_CMD,
     {{16, MEMORY_EA}, {20, MEMORY_EA}},
     "size: mfc_getl(lsa 0x100, eah 0x0, list "
     "0x1000, size 16, tag 2): element 1: 20"},
    {0x100, LIST_LSA, 16, 2, MFC_PUTL_CMD, {{16, MEMORY_EA}, {16, FIXED_EA}}, "read only: mfc_putl"},
    {0x3ffe0, LIST_LSA, 16, 2, MFC_GETL_CMD, {{32, MEMORY_EA}, {16, MEMORY_EA}}, "local store: mfc_getl"},
    {0x100, LIST_LSA, 16, 2, MFC_GETL_CMD, {{16, MEMORY_EA}, {32, MEMORY_EA + 240}}, "bounds: mfc_getl"},
    {0x100, LIST_LSA, 8, 2, MFC_GETL_CMD, {{16, MEMORY_EA + 8}}, "alignment: mfc_getl"},
    /* what is allowed */
    {0x104, MEMORY_EA + 4, 4, 31, MFC_GET_CMD, {{0}}, NULL},
    {0x108, DOUBLES_EA + 8, 8, 0, MFC_PUT_CMD, {{0}}, NULL},
    {0x3fff0, MEMORY_EA + 240, 16, 0, MFC_GET_CMD, {{0}}, NULL},
    {0x10c, CGT_SPE_SIGNAL_EA(0, 1), 4, 0, MFC_SNDSIG_CMD, {{0}}, NULL},
    {0x100, MEMORY_EA, 128, 77, MFC_GETLLAR_CMD, {{0}}, NULL}, /* its tag does not count */
    {0x100, LIST_LSA, 16, 2, MFC_GETL_CMD, {{0, 1}, {16, HIGH_EA + 0xff0}}, NULL},
    {0, MEMORY_EA, 128, 1, MFC_SDCRT_CMD, {{0}}, NULL},
    {0, MEMORY_EA, 128, 1, MFC_SDCRZ_CMD, {{0}}, NULL},
};

/* ---- a cell to break ---- */

static uint32_t words[64], fixed[64], high[1024];
static uint64_t doubles[16];
static bool watches_buffers;

static cgt_cell *make_cell(void)
{
    cgt_cell *cell;
    const cgt_cell_options options = {.spes = 1, .cycle_limit = 1000000, .watch_buffers = watches_buffers};
    assert_int_equal(cgt_cell_create(&options, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, MEMORY_EA, words, 64, 4, true), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, FIXED_EA, fixed, 64, 4, false), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, DOUBLES_EA, doubles, 16, 8, true), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, HIGH_EA, high, 1024, 4, true), CGT_OK);
    return cell;
}

/* the message of a run, without its "SPE 0: "; "" where it went well */
static void end_run(cgt_cell *cell, cgt_result result, char message[256])
{
    const char *const text = cgt_cell_get_message(cell);
    assert_int_equal(result, text[0] ? CGT_ERROR_STOPPED : CGT_OK);
    if (text[0])
        assert_memory_equal(text, "SPE 0: ", 7);
    snprintf(message, 256, "%s", text[0] ? text + 7 : "");
    cgt_cell_destroy(cell);
}

static void run_steps(const fake_step *steps, const broken *b, char message[256])
{
    static fake_spu spu;
    cgt_cell *const cell = make_cell();
    fake_init(&spu, steps);
    for (unsigned i = 0; b && i < 4; i++)
        fake_store32(&spu, LIST_LSA + 4 * i, b->element[i / 2][i % 2]);
    const cgt_spe_unit unit = fake_unit(&spu);
    end_run(cell, cgt_cell_run_simulated(cell, &unit, NULL, NULL), message);
}

static void run_function(cgt_spe_function *function, uint64_t argument, char message[256])
{
    cgt_cell *const cell = make_cell();
    const cgt_spe_program program = {.function = function, .argument = argument};
    end_run(cell, cgt_cell_run_native(cell, &program, NULL, NULL), message);
}

/* ---- commands ---- */

static int give_command(unsigned long long spe, unsigned long long argument, unsigned long long environment)
{
    (void)spe;
    (void)environment;
    const broken *const b = &table[argument];
    uint8_t *const arena = cgt_spe_arena();
    const bool list = (b->command & 0x84) == 0x04;
    memcpy(arena + LIST_LSA, b->element, sizeof b->element);
    spu_mfcdma64(arena + b->lsa, mfc_ea2h(b->ea), mfc_ea2l(b->ea) + (list ? (uint32_t)(uintptr_t)arena : 0), b->size,
                 b->tag, b->command);
    mfc_write_tag_mask(-1);
    mfc_read_tag_status_all();
    return 0;
}

TEST(broken_commands)
{
    for (unsigned i = 0; i < TEST_COUNT(table); i++) {
        const broken *const b = &table[i];
        const fake_step steps[] = {
            FAKE_DMA(b->lsa, b->ea, b->size, b->tag, b->command), FAKE_WAIT(0xffffffffu), {FAKE_STOP, 0, 0, NULL}};
        char simulated[256], native[256];
        run_steps(steps, b, simulated);
        run_function(give_command, i, native);
        const char *const want = b->message ? b->message : "";
        if (strncmp(simulated, want, strlen(want)) != 0 || (!b->message && simulated[0]))
            fail_msg("case %u: \"%s\" instead of \"%s...\"", i, simulated, want);
        if (strcmp(simulated, native) != 0)
            fail_msg("case %u: natively \"%s\", simulated \"%s\"", i, native, simulated);
    }
}

/* ---- channels ---- */

typedef struct access {
    bool writes;
    unsigned channel;
    uint32_t value;
    const char *message;
} access;

static const access accesses[] = {
    {true, MFC_WrTagUpdate, 3, "tag update: MFC_WrTagUpdate(3)"},
    {false, MFC_RdTagStat, 0, "tag status: MFC_RdTagStat"},
    {false, MFC_RdAtomicStat, 0, "atomic status: MFC_RdAtomicStat"},
    {true, MFC_WrListStallAck, 4, "list acknowledge: MFC_WrListStallAck(tag 4)"},
    {true, SPU_RdInMbox, 4, "channel: wrch(29): SPU_RdInMbox"},
    {false, SPU_WrOutMbox, 4, "channel: rdch(28): SPU_WrOutMbox"},
    {false, 6, 0, "channel: rdch(6): there is no such channel"},
    {true, 127, 0, "channel: wrch(127): there is no such channel"},
    {false, SPU_RdInMbox, 0, NULL}, /* a deadlock, whose message names no SPE first */
};

static int access_channel(unsigned long long spe, unsigned long long argument, unsigned long long environment)
{
    (void)spe;
    (void)environment;
    const access *const a = &accesses[argument];
    if (a->writes)
        spu_writech(a->channel, a->value);
    else
        (void)spu_readch(a->channel);
    return 0;
}

TEST(broken_channels)
{
    for (unsigned i = 0; i < TEST_COUNT(accesses) - 1; i++) {
        const access *const a = &accesses[i];
        const fake_step steps[] = {{a->writes ? FAKE_WRITE : FAKE_READ, a->channel, a->value, NULL},
                                   {FAKE_STOP, 0, 0, NULL}};
        char simulated[256], native[256];
        run_steps(steps, NULL, simulated);
        run_function(access_channel, i, native);
        if (strncmp(simulated, a->message, strlen(a->message)) != 0 || strcmp(simulated, native) != 0)
            fail_msg("case %u: natively \"%s\", simulated \"%s\"", i, native, simulated);
    }
}

TEST(deadlock)
{
    static fake_spu spu;
    const fake_step steps[] = {{FAKE_READ, SPU_RdInMbox, 0, NULL}, {FAKE_STOP, 0, 0, NULL}};
    const char *const want = "deadlock: nothing can happen any more; waiting: SPE 0 for SPU_RdInMbox";
    const cgt_spe_program program = {.function = access_channel, .argument = TEST_COUNT(accesses) - 1};
    cgt_cell *const cell = make_cell();
    fake_init(&spu, steps);
    const cgt_spe_unit unit = fake_unit(&spu);
    assert_int_equal(cgt_cell_run_simulated(cell, &unit, NULL, NULL), CGT_ERROR_STOPPED);
    assert_string_equal(cgt_cell_get_message(cell), want);
    assert_int_equal(cgt_cell_run_native(cell, &program, NULL, NULL), CGT_ERROR_STOPPED);
    assert_string_equal(cgt_cell_get_message(cell), want);
    cgt_cell_destroy(cell);
}

/* ---- buffers that are used again too early ---- */

#define BUFFER_LSA 0x100u

/* What a program does: a put of 32 bytes with tag 3, another one of the last 16, a get into these, with a fence, with
 * tag 4; a barrier for all; a store; waits for tags 3 and 4. */
typedef enum use { END, PUT, PUT_AGAIN, GET, GET_FENCED, GET_OTHER, BARRIER, STORE, WAIT, WAIT_OTHER } use;

static const struct {
    use use[6];
    const char *message; /* NULL: none */
} uses[] = {
    {{PUT, STORE, WAIT},
     "buffer: mfc_put(lsa 0x100, ea 0x10000, size 32, tag 3): the program wrote to these bytes before it had waited "
     "for "
     "tag 3"},
    {{PUT, WAIT, STORE, PUT, WAIT}, NULL},
    {{PUT, WAIT_OTHER, STORE, WAIT}, "buffer: mfc_put("},
    {{PUT, STORE, PUT_AGAIN}, "buffer: mfc_put("},
    {{PUT, PUT_AGAIN, WAIT}, NULL},
    {{PUT, PUT, WAIT, STORE, WAIT}, NULL},
    {{PUT, GET, WAIT},
     "buffer: mfc_get(lsa 0x110, ea 0x10040, size 16, tag 3): mfc_put of tag 3 may still send these bytes: no wait and "
     "no "
     "fence between"},
    {{PUT, GET_OTHER, WAIT}, "buffer: mfc_get("},
    {{PUT, GET_FENCED, WAIT}, NULL},
    {{PUT, BARRIER, GET_OTHER, WAIT, WAIT_OTHER}, NULL},
    {{PUT, WAIT, GET_OTHER, WAIT_OTHER}, NULL},
};

static const struct {
    uint32_t lsa, ea, size, tag, command;
} use_commands[] = {[PUT] = {BUFFER_LSA, MEMORY_EA, 32, 3, MFC_PUT_CMD},
                    [PUT_AGAIN] = {BUFFER_LSA + 16, MEMORY_EA + 64, 16, 3, MFC_PUT_CMD},
                    [GET] = {BUFFER_LSA + 16, MEMORY_EA + 64, 16, 3, MFC_GET_CMD},
                    [GET_FENCED] = {BUFFER_LSA + 16, MEMORY_EA + 64, 16, 3, MFC_GETF_CMD},
                    [GET_OTHER] = {BUFFER_LSA + 16, MEMORY_EA + 64, 16, 4, MFC_GET_CMD},
                    [BARRIER] = {0, 0, 0, 5, MFC_BARRIER_CMD}};

static void store_to_buffer(fake_spu *spu) { fake_store32(spu, BUFFER_LSA + 24, ++spu->counter); }

static void use_simulated(unsigned i, char message[256])
{
    fake_step steps[64];
    unsigned n = 0;
    for (const use *u = uses[i].use; *u != END; u++) {
        if (*u == STORE) {
            steps[n++] = (fake_step){FAKE_CALL, 0, 0, store_to_buffer};
        } else if (*u >= WAIT) {
            const fake_step wait[] = {FAKE_WAIT(*u == WAIT ? 8u : 16u)};
            memcpy(steps + n, wait, sizeof wait);
            n += 3;
        } else {
            const fake_step dma[] = {FAKE_DMA(use_commands[*u].lsa, use_commands[*u].ea, use_commands[*u].size,
                                              use_commands[*u].tag, use_commands[*u].command)};
            memcpy(steps + n, dma, sizeof dma);
            n += 6;
        }
    }
    steps[n] = (fake_step){FAKE_STOP, 0, 0, NULL};
    run_steps(steps, NULL, message);
}

static int use_native(unsigned long long spe, unsigned long long argument, unsigned long long environment)
{
    uint8_t *const arena = cgt_spe_arena();
    (void)spe;
    (void)environment;
    for (const use *u = uses[argument].use; *u != END; u++) {
        if (*u == STORE) {
            arena[BUFFER_LSA + 24]++;
        } else if (*u >= WAIT) {
            mfc_write_tag_mask(*u == WAIT ? 8 : 16);
            mfc_read_tag_status_all();
        } else {
            spu_mfcdma64(arena + use_commands[*u].lsa, 0, use_commands[*u].ea, use_commands[*u].size,
                         use_commands[*u].tag, use_commands[*u].command);
        }
    }
    return 0;
}

TEST(buffers)
{
    for (unsigned i = 0; i < 2 * TEST_COUNT(uses); i++) {
        char simulated[256], native[256];
        watches_buffers = i % 2;
        use_simulated(i / 2, simulated);
        run_function(use_native, i / 2, native);
        const char *const want = watches_buffers && uses[i / 2].message ? uses[i / 2].message : "";
        if (strncmp(simulated, want, strlen(want)) != 0 || (!*want && simulated[0]) || strcmp(simulated, native) != 0)
            fail_msg("case %u: natively \"%s\", simulated \"%s\", not \"%s...\"", i, native, simulated, want);
    }
    watches_buffers = false;
}

/* ---- what is native only ---- */

static int leave_local_store(unsigned long long spe, unsigned long long argument, unsigned long long environment)
{
    _Alignas(16) char on_the_stack[16];
    (void)spe;
    (void)environment;
    if (argument == 0)
        mfc_get(on_the_stack, MEMORY_EA, 16, 1, 0, 0);
    else if (argument == 1)
        (void)spu_mfspr(3);
    else if (argument == 2)
        spu_mtspr(3, 7);
    else
        spu_hcmpeq(argument == 3 ? 1 : 2, 1);
    return 0;
}

TEST(native_rules)
{
    char message[256];
    run_function(leave_local_store, 0, message);
    assert_string_equal(message, "local store: command 0x40(ea 0x10000, size 16, tag 1): the address is none of the "
                                 "local store (cgt_spe_arena)");
    run_function(leave_local_store, 1, message);
    assert_string_equal(message, "word: spu_mfspr(3): there are no special registers");
    run_function(leave_local_store, 2, message);
    assert_string_equal(message, "word: spu_mtspr(3, 0x7): there are no special registers");
    run_function(leave_local_store, 3, message);
    assert_string_equal(message, "halt: the program halted");
    run_function(leave_local_store, 4, message);
    assert_string_equal(message, "");
}

TEST(halted)
{
    char message[256];
    run_steps((const fake_step[]){{FAKE_HALT, 0, 0, NULL}}, NULL, message);
    assert_string_equal(message, "halt: the program halted");
}

/* every rule has a name of its own */
TEST(rule_names)
{
    for (unsigned i = 0; i < CGT_RULES; i++) {
        assert_non_null(cgt_mfc_rule_name((cgt_mfc_rule)i));
        for (unsigned k = 0; k < i; k++)
            assert_string_not_equal(cgt_mfc_rule_name((cgt_mfc_rule)i), cgt_mfc_rule_name((cgt_mfc_rule)k));
    }
}

SEEDED_SUITE("test_mfc_rules", NULL, NULL)
