/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The channel, control and DMA words against a host that records what reaches it, the tag manager against a plain list,
 * and the words' messages without a host. */
#define _POSIX_C_SOURCE 200809L

#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "spu_mfcio.h"

#define SUITE_TEARDOWN stop_recording
#include "support/suite.h"

#include "simd/channels/spu_channel_calls.h"
#include "simd/channels/spu_channels_unit.h"
#include "support/test.h"

/* ---- a host that records ---- */

typedef enum event_kind {
    READ,
    COUNT,
    WRITE,
    READ_QUADWORD,
    WRITE_QUADWORD,
    INTERRUPTS,
    READ_REGISTER,
    WRITE_REGISTER,
    READ_FPSCR,
    WRITE_FPSCR,
    SYNCHRONIZE,
    STOP,
    HALT,
    CALLED
} event_kind;

typedef struct event {
    event_kind kind;
    uint32_t number; /* of the channel or register; type of the stop */
    uint32_t value;
} event;

typedef struct recorder {
    event events[16];
    unsigned count;
    cgt_spu_dma dma;
    unsigned dma_count;
    uint32_t answer; /* results of reads and counts */
    uint32_t quadword[4];
} recorder;

static recorder record;

static void note(void *self, event_kind kind, uint32_t number, uint32_t value)
{
    assert_ptr_equal(self, &record);
    assert_true(record.count < TEST_COUNT(record.events));
    record.events[record.count++] = (event){kind, number, value};
}

static uint32_t host_read(void *self, unsigned channel)
{
    note(self, READ, channel, 0);
    return record.answer;
}

static uint32_t host_count(void *self, unsigned channel)
{
    note(self, COUNT, channel, 0);
    return record.answer;
}

static void host_write(void *self, unsigned channel, uint32_t value) { note(self, WRITE, channel, value); }

static void host_read_quadword(void *self, unsigned channel, uint32_t value[4])
{
    note(self, READ_QUADWORD, channel, 0);
    memcpy(value, record.quadword, sizeof record.quadword);
}

static void host_write_quadword(void *self, unsigned channel, const uint32_t value[4])
{
    note(self, WRITE_QUADWORD, channel, 0);
    memcpy(record.quadword, value, sizeof record.quadword);
}

static void host_dma(void *self, const cgt_spu_dma *command)
{
    assert_ptr_equal(self, &record);
    record.dma = *command;
    record.dma_count++;
}

static void host_set_interrupts(void *self, bool enabled) { note(self, INTERRUPTS, 0, enabled); }

static uint32_t host_read_register(void *self, unsigned number)
{
    note(self, READ_REGISTER, number, 0);
    return record.answer;
}

static void host_write_register(void *self, unsigned number, uint32_t value)
{
    note(self, WRITE_REGISTER, number, value);
}

static void host_read_fpscr(void *self, uint32_t value[4])
{
    note(self, READ_FPSCR, 0, 0);
    memcpy(value, record.quadword, sizeof record.quadword);
}

static void host_write_fpscr(void *self, const uint32_t value[4])
{
    note(self, WRITE_FPSCR, 0, 0);
    memcpy(record.quadword, value, sizeof record.quadword);
}

static void host_synchronize(void *self, cgt_spu_barrier kind) { note(self, SYNCHRONIZE, (uint32_t)kind, 0); }
static void host_stop(void *self, unsigned type) { note(self, STOP, type, 0); }
static void host_halt(void *self) { note(self, HALT, 0, 0); }

static const cgt_spu_host full_host = {
    .self = &record,
    .read_channel = host_read,
    .write_channel = host_write,
    .channel_count = host_count,
    .read_channel_quadword = host_read_quadword,
    .write_channel_quadword = host_write_quadword,
    .dma = host_dma,
    .set_interrupts = host_set_interrupts,
    .read_register = host_read_register,
    .write_register = host_write_register,
    .read_fpscr = host_read_fpscr,
    .write_fpscr = host_write_fpscr,
    .synchronize = host_synchronize,
    .stop = host_stop,
    .halt = host_halt,
};

/* channels of 32 bits and nothing else */
static const cgt_spu_host channel_host = {
    .self = &record, .read_channel = host_read, .write_channel = host_write, .channel_count = host_count};

static void start(const cgt_spu_host *host)
{
    memset(&record, 0, sizeof record);
    cgt_spu_set_host(host);
}

static int stop_recording(void **state)
{
    (void)state;
    cgt_spu_set_host(NULL);
    return 0;
}

/* fails the calling test unless exactly these events were recorded */
static void expect(const char *call, const event *events, unsigned count)
{
    if (record.count != count)
        fail_msg("%s: %u events instead of %u", call, record.count, count);
    for (unsigned i = 0; i < count; i++) {
        const event got = record.events[i], want = events[i];
        if (got.kind != want.kind || got.number != want.number || got.value != want.value)
            fail_msg("%s: event %u is (%d, %u, %#x) instead of (%d, %u, %#x)", call, i, (int)got.kind, got.number,
                     got.value, (int)want.kind, want.number, want.value);
    }
    record.count = 0;
}
#define EXPECT(call, ...) expect(call, (const event[]){__VA_ARGS__}, TEST_COUNT(((const event[]){__VA_ARGS__})))

/* ---- constants ---- */

TEST(constants)
{
    static const struct {
        const char *name;
        uint64_t is, must_be;
    } table[] = {
#define X(name, value) {#name, (uint64_t)(name), value},
        SPU_CHANNEL_NUMBERS(X) SPU_SPECIAL_VALUES(X) SPU_MFCIO_CONSTANTS(X)
#undef X
    };
    for (size_t i = 0; i < TEST_COUNT(table); i++)
        if (table[i].is != table[i].must_be)
            fail_msg("%s is %#llx instead of %#llx", table[i].name, (unsigned long long)table[i].is,
                     (unsigned long long)table[i].must_be);
    assert_true(mfc_hl2ea(0x01234567u, 0x89abcdefu) == 0x0123456789abcdefull);
    assert_true(mfc_hl2ea(0, -1) == 0xffffffffull);
}

/* the names that a failure gives are those of the numbers */
TEST(channel_names)
{
#define X(name, value) assert_string_equal(cgt_spu_channel_name(value), #name);
    SPU_CHANNEL_NUMBERS(X)
#undef X
    unsigned named = 0;
    for (unsigned i = 0; i < 1000; i++)
        named += cgt_spu_channel_name(i) != NULL;
    assert_int_equal(named, 28);
}

/* ---- channels ---- */

TEST(channel_reads)
{
    start(&full_host);
#define X(name, call, channel)                                                                                         \
    record.answer = 0x80000000u + channel;                                                                             \
    assert_int_equal(call, 0x80000000u + channel);                                                                     \
    EXPECT(#call, {READ, channel, 0});
    SPU_CHANNEL_READS(X)
#undef X
#define X(name, call, channel)                                                                                         \
    record.answer = channel + 1;                                                                                       \
    assert_int_equal(call, channel + 1);                                                                               \
    EXPECT(#call, {COUNT, channel, 0});
    SPU_CHANNEL_COUNTS(X)
#undef X
#define X(name, call, update)                                                                                          \
    record.answer = 0xf0f0f0f0u;                                                                                       \
    assert_int_equal(call, 0xf0f0f0f0u);                                                                               \
    EXPECT(#call, {WRITE, 23, update}, {READ, 24, 0});
    SPU_CHANNEL_STATUSES(X)
#undef X
}

TEST(channel_writes)
{
    start(&full_host);
#define X(name, call, channel, value)                                                                                  \
    call;                                                                                                              \
    EXPECT(#call, {WRITE, channel, value});
    SPU_CHANNEL_WRITES(X)
#undef X
}

TEST(quadword_channels)
{
    const vec_float4 ones = {1.f, 1.f, 1.f, 1.f};
    start(&full_host);
    spu_writechqw(MFC_LSA, ((vec_uint4){1, 2, 3, 0xffffffff}));
    EXPECT("spu_writechqw", {WRITE_QUADWORD, 16, 0});
    const vec_uint4 back = spu_readchqw(SPU_RdInMbox);
    EXPECT("spu_readchqw", {READ_QUADWORD, 29, 0});
    assert_true(back[0] == 1 && back[1] == 2 && back[2] == 3 && back[3] == 0xffffffff);
    spu_writechqw(28, ones);
    assert_int_equal(record.quadword[3], 0x3f800000);

    /* element 0 where the host knows words only */
    start(&channel_host);
    record.answer = 77;
    spu_writechqw(SPU_WrOutMbox, ((vec_int4){-5, 2, 3, 4}));
    EXPECT("spu_writechqw by words", {WRITE, 28, 0xfffffffbu});
    const vec_uint4 word = spu_readchqw(SPU_RdInMbox);
    EXPECT("spu_readchqw by words", {READ, 29, 0});
    assert_true(word[0] == 77 && word[1] == 0 && word[2] == 0 && word[3] == 0);
}

/* ---- MFC commands ---- */

static void expect_dma(const char *call, const volatile void *ls, const volatile void *list, cgt_spu_dma want)
{
    const cgt_spu_dma *const got = &record.dma;
    if (record.dma_count != 1 || record.count != 0)
        fail_msg("%s: %u commands and %u other events", call, record.dma_count, record.count);
    if (got->ls != ls || got->list != list || got->has_eah != want.has_eah || got->eah != want.eah ||
        got->eal != want.eal || got->size != want.size || got->tag != want.tag || got->command != want.command)
        fail_msg("%s: has_eah %d eah %#x eal %#x size %u tag %u command %#x%s%s", call, got->has_eah, got->eah,
                 got->eal, got->size, got->tag, got->command, got->ls == ls ? "" : ", other ls",
                 got->list == list ? "" : ", other list");
    record.dma_count = 0;
}

/* whole pointers, for any upper bits */
TEST(mfc_commands)
{
    static char buffer[256];
    static mfc_list_element_t list[2];
    const uint64_t ea = 0x1122334455667788u;
    start(&full_host);
#define X(name, call, lsa, eah_, eal_, size_, tag_, command_)                                                          \
    call;                                                                                                              \
    expect_dma(                                                                                                        \
        #call, lsa, (command_ & 0x84) == 0x04 ? list : NULL,                                                           \
        (cgt_spu_dma){.eah = eah_, .eal = eal_, .size = size_, .tag = tag_, .command = command_, .has_eah = true});
    SPU_MFC_CALLS(X, buffer, ea, list, NULL, 0x11223344u, 0x55667788u, (uint32_t)(uintptr_t)list)
#undef X
#define X(name, call, lsa, eal_, size_, tag_, command_)                                                                \
    call;                                                                                                              \
    expect_dma(#call, lsa, NULL, (cgt_spu_dma){.eal = eal_, .size = size_, .tag = tag_, .command = command_});
    SPU_MFC_CALLS_32(X, buffer, 0x55667788u, NULL)
#undef X
}

/* without a member for it a command goes through the channels as an SPU's does */
TEST(mfc_commands_by_channels)
{
    volatile void *const ls = (volatile void *)(uintptr_t)0x3f000, *const list = (volatile void *)(uintptr_t)0x12348;
    const uint64_t ea = 0x1122334455667788u;
    start(&channel_host);
#define X(name, call, lsa, eah, eal, size, tag, command)                                                               \
    call;                                                                                                              \
    EXPECT(#call, {WRITE, 16, lsa ? 0x3f000u : 0u}, {WRITE, 17, eah}, {WRITE, 18, eal}, {WRITE, 19, size},             \
           {WRITE, 20, tag}, {WRITE, 21, command});
    SPU_MFC_CALLS(X, ls, ea, list, NULL, 0x11223344u, 0x55667788u, 0x12348u)
#undef X
#define X(name, call, lsa, eal, size, tag, command)                                                                    \
    call;                                                                                                              \
    EXPECT(#call, {WRITE, 16, lsa ? 0x3f000u : 0u}, {WRITE, 18, eal}, {WRITE, 19, size}, {WRITE, 20, tag},             \
           {WRITE, 21, command});
    SPU_MFC_CALLS_32(X, ls, 0x55667788u, NULL)
#undef X
}

TEST(operands_are_evaluated_once)
{
    char buffer[16];
    uint64_t ea = 0x100000000u;
    unsigned tag = 4, ls = 0;
    start(&full_host);
    mfc_get(&buffer[ls++], ea++, 16, tag++, 0, 0);
    assert_true(ls == 1 && ea == 0x100000001u && tag == 5);
    assert_true(record.dma.eah == 1 && record.dma.eal == 0 && record.dma.tag == 4);
}

/* two words in memory, as the MFC reads them on an SPU */
TEST(list_elements)
{
    mfc_list_element_t element = {.notify = 1, .reserved = 0, .size = 0x4000, .eal = 0x89abcdef};
    uint32_t word[2];
    assert_int_equal(sizeof element, 8);
    memcpy(word, &element, sizeof word);
    assert_int_equal(word[0], 0x80004000u);
    assert_int_equal(word[1], 0x89abcdefu);
    element = (mfc_list_element_t){.reserved = 0xffff};
    memcpy(word, &element, sizeof word);
    assert_int_equal(word[0], 0x7fff8000u);
    assert_int_equal(word[1], 0);
    word[0] = 0x00000010u;
    word[1] = 0x80;
    memcpy(&element, word, sizeof word);
    assert_true(!element.notify && element.size == 16 && element.eal == 0x80);
}

/* ---- control ---- */

static void on_event(void) { note(&record, CALLED, 0, 0); }

TEST(events_and_interrupts)
{
    start(&full_host);
    spu_idisable();
    EXPECT("spu_idisable", {INTERRUPTS, 0, 0});
    spu_ienable();
    EXPECT("spu_ienable", {INTERRUPTS, 0, 1});

    record.answer = 0; /* no event waits */
    spu_bisled(on_event);
    spu_bisled_d(on_event);
    spu_bisled_e(on_event);
    EXPECT("spu_bisled without event", {COUNT, 0, 0}, {COUNT, 0, 0}, {COUNT, 0, 0});
    record.answer = 1;
    spu_bisled(on_event);
    EXPECT("spu_bisled", {COUNT, 0, 0}, {CALLED, 0, 0});
    spu_bisled_d(on_event);
    EXPECT("spu_bisled_d", {COUNT, 0, 0}, {INTERRUPTS, 0, 0}, {CALLED, 0, 0});
    spu_bisled_e(on_event);
    EXPECT("spu_bisled_e", {COUNT, 0, 0}, {INTERRUPTS, 0, 1}, {CALLED, 0, 0});
}

TEST(critical_sections)
{
    start(&full_host);
    mfc_end_critical_section(mfc_begin_critical_section()); /* not declared safe: nothing */
    assert_int_equal(record.count, 0);
    record.answer = 1; /* interrupts are on */
    unit_end_critical_section(unit_begin_critical_section());
    EXPECT("critical section", {READ, 13, 0}, {INTERRUPTS, 0, 0}, {INTERRUPTS, 0, 1});
    record.answer = 2; /* they are off, and stay so */
    unit_end_critical_section(unit_begin_critical_section());
    EXPECT("critical section without interrupts", {READ, 13, 0}, {INTERRUPTS, 0, 0});
}

TEST(registers_and_barriers)
{
    start(&full_host);
    record.answer = 0xabcdu;
    assert_int_equal(spu_mfspr(3), 0xabcdu);
    EXPECT("spu_mfspr", {READ_REGISTER, 3, 0});
    spu_mtspr(127, 0xffffffffu);
    EXPECT("spu_mtspr", {WRITE_REGISTER, 127, 0xffffffffu});
    spu_dsync();
    spu_sync();
    spu_sync_c();
    EXPECT("barriers", {SYNCHRONIZE, 0, 0}, {SYNCHRONIZE, 1, 0}, {SYNCHRONIZE, 2, 0});
    start(NULL); /* they need no host */
    spu_dsync();
    spu_sync();
    spu_sync_c();
    int bytes = 0;
    __align_hint(&bytes, 16, 0);
}

TEST(stop_and_halt)
{
    const int minus = -1;
    start(&full_host);
    spu_stop(0x2101);
    EXPECT("spu_stop", {STOP, 0x2101, 0});
    spu_stop(0x7fff);
    EXPECT("spu_stop of 14 bits", {STOP, 0x3fff, 0});
    /* the type of the first operand says how they compare */
    spu_hcmpgt(minus, 0);
    spu_hcmpgt(1u, minus);
    spu_hcmpgt(5, 5);
    spu_hcmpeq(minus, 1);
    spu_hcmpeq(2u, 3u);
    assert_int_equal(record.count, 0);
    spu_hcmpgt((unsigned)minus, 0);
    EXPECT("spu_hcmpgt unsigned", {HALT, 0, 0});
    spu_hcmpgt(1, minus);
    EXPECT("spu_hcmpgt signed", {HALT, 0, 0});
    spu_hcmpeq(minus, 0xffffffffu);
    EXPECT("spu_hcmpeq signed", {HALT, 0, 0});
    spu_hcmpeq(7u, 7u);
    EXPECT("spu_hcmpeq unsigned", {HALT, 0, 0});
}

/* ---- the status and control register of floating point ---- */

TEST(fpscr_reads_back_what_exists)
{
    uint32_t other[4];
    start(NULL);
    spu_mtfpscr(((vec_uint4){0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}));
    const vec_uint4 all = spu_mffpscr();
    assert_true(all[0] == 0xf07 && all[1] == 0x3f07 && all[2] == 0x3f07 && all[3] == 0xf07);
    spu_mtfpscr(((vec_float4){0.f, 0.f, 0.f, 0.f}));
    spu_mtfpscr(((vec_uint4){0x00000d02, 0x00002a05, 0x00001503, 0x00000504}));
    unit_read_fpscr(other); /* the same register in another source file */
    assert_true(other[0] == 0xd02 && other[1] == 0x2a05 && other[2] == 0x1503 && other[3] == 0x504);

    start(&full_host);
    spu_mtfpscr(((vec_uint4){0x1f, 0x1f, 0x1f, 0x1f}));
    EXPECT("spu_mtfpscr", {WRITE_FPSCR, 0, 0});
    assert_true(record.quadword[0] == 7 && record.quadword[3] == 7);
    record.quadword[2] = 0x100;
    const vec_uint4 of_host = spu_mffpscr();
    EXPECT("spu_mffpscr", {READ_FPSCR, 0, 0});
    assert_true(of_host[0] == 7 && of_host[2] == 0x100);
    start(NULL);
    spu_mtfpscr(((vec_uint4){0, 0, 0, 0}));
}

/* ---- tag manager ---- */

/* a run of free places by looking at each */
static unsigned first_run(const bool reserved[32], unsigned count)
{
    for (unsigned first = 0; first + count <= 32; first++) {
        unsigned free = 0;
        while (free < count && !reserved[first + free])
            free++;
        if (free == count)
            return first;
    }
    return MFC_TAG_INVALID;
}

TEST(tags_against_a_list)
{
    bool reserved[32] = {false};
    test_random r = random_make(1);
    assert_int_equal(mfc_tag_reserve(), 0);
    assert_int_equal(unit_reserve_tag(), 1); /* one manager for all source files */
    assert_int_equal(mfc_multi_tag_release(0, 2), MFC_TAG_VALID);
    assert_int_equal(mfc_multi_tag_reserve(0), 0);
    assert_int_equal(mfc_multi_tag_release(0xffffffffu, 2), MFC_TAG_INVALID);
    for (uint32_t turn = test_scaled(200000); turn > 0; turn--) {
        const unsigned count = 1 + random_below(&r, random_below(&r, 4) ? 5 : 34), first = random_below(&r, 34);
        if (random_below(&r, 2)) {
            const unsigned want = first_run(reserved, count);
            assert_int_equal(count == 1 ? mfc_tag_reserve() : mfc_multi_tag_reserve(count), want);
            for (unsigned i = 0; want != MFC_TAG_INVALID && i < count; i++)
                reserved[want + i] = true;
        } else {
            bool all = first + count <= 32;
            for (unsigned i = 0; all && i < count; i++)
                all = reserved[first + i];
            assert_int_equal(count == 1 ? mfc_tag_release(first) : mfc_multi_tag_release(first, count),
                             all ? MFC_TAG_VALID : MFC_TAG_INVALID);
            for (unsigned i = 0; all && i < count; i++)
                reserved[first + i] = false;
        }
    }
    for (unsigned i = 0; i < 32; i++)
        assert_int_equal(mfc_tag_release(i), reserved[i] ? MFC_TAG_VALID : MFC_TAG_INVALID);
}

/* ---- threads and source files ---- */

static void *in_a_new_thread(void *result)
{
    bool *const good = result;
    const vec_uint4 fpscr = spu_mffpscr();
    *good = !cgt_spu_get_host() && fpscr[0] == 0 && mfc_tag_reserve() == 0;
    cgt_spu_set_host(&channel_host); /* must not show in the other thread */
    return NULL;
}

TEST(state_is_per_thread)
{
    bool good = false;
    pthread_t thread;
    start(&full_host);
    assert_ptr_equal(cgt_spu_set_host(NULL), &full_host);
    start(&full_host);
    spu_mtfpscr(((vec_uint4){1, 1, 1, 1}));
    assert_int_equal(mfc_tag_reserve(), 0);
    assert_int_equal(pthread_create(&thread, NULL, in_a_new_thread, &good), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_true(good);
    assert_ptr_equal(cgt_spu_get_host(), &full_host);
    assert_int_equal(mfc_tag_release(0), MFC_TAG_VALID);
    start(NULL);
    spu_mtfpscr(((vec_uint4){0, 0, 0, 0}));
}

/* ---- failure ---- */

static int child_pipe[2];
static pid_t child;

/* True in a new process whose stderr the parent reads. */
static bool in_child(void)
{
    assert_int_equal(pipe(child_pipe), 0);
    fflush(NULL);
    child = fork();
    assert_true(child >= 0);
    if (child > 0)
        return false;
    const struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    dup2(child_pipe[1], STDERR_FILENO);
    close(child_pipe[0]);
    return true;
}

static void expect_abort(const char *call, const char *text)
{
    char said[1000];
    size_t length = 0;
    ssize_t more;
    int status = 0;
    close(child_pipe[1]);
    while (length < sizeof said - 1 && (more = read(child_pipe[0], said + length, sizeof said - 1 - length)) > 0)
        length += (size_t)more;
    said[length] = '\0';
    close(child_pipe[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    if (!WIFSIGNALED(status) || WTERMSIG(status) != SIGABRT)
        fail_msg("%s: did not abort", call);
    if (strncmp(said, text, strlen(text)) != 0)
        fail_msg("%s: said \"%s\" instead of \"%s...\"", call, said, text);
}
#define IN_CHILD(call)                                                                                                 \
    do {                                                                                                               \
        if (in_child()) {                                                                                              \
            call;                                                                                                      \
            _exit(0);                                                                                                  \
        }                                                                                                              \
    } while (0)
#define EXPECT_ABORT(call, text)                                                                                       \
    do {                                                                                                               \
        IN_CHILD(call);                                                                                                \
        expect_abort(#call, text);                                                                                     \
    } while (0)

TEST(words_fail_loudly)
{
    char buffer[16];
    start(NULL);
    EXPECT_ABORT((void)spu_read_in_mbox(),
                 "spu_readch(SPU_RdInMbox): this processor is no SPU and nothing stands in for "
                 "one in this thread");
    EXPECT_ABORT((void)spu_readch(74), "spu_readch(channel 74): this processor is no SPU");
    EXPECT_ABORT((void)mfc_stat_cmd_queue(), "spu_readchcnt(MFC_Cmd): this processor is no SPU");
    EXPECT_ABORT(spu_write_out_mbox(1), "spu_writech(SPU_WrOutMbox): this processor is no SPU");
    EXPECT_ABORT((void)spu_readchqw(SPU_RdInMbox), "spu_readchqw(SPU_RdInMbox): this processor is no SPU");
    EXPECT_ABORT(spu_writechqw(MFC_EAH, ((vec_uint4){0, 0, 0, 0})), "spu_writechqw(MFC_EAH): this processor is no SPU");
    EXPECT_ABORT(mfc_get(buffer, 0x10000, 16, 0, 0, 0), "mfc_get(MFC_Cmd): this processor is no SPU");
    EXPECT_ABORT(mfc_barrier(1), "mfc_barrier(MFC_Cmd): this processor is no SPU");
    EXPECT_ABORT(spu_idisable(), "spu_idisable(): this processor is no SPU");
    EXPECT_ABORT(spu_ienable(), "spu_ienable(): this processor is no SPU");
    EXPECT_ABORT(spu_bisled(on_event), "spu_bisled(SPU_RdEventStat): this processor is no SPU");
    EXPECT_ABORT(spu_bisled_d(on_event), "spu_bisled_d(SPU_RdEventStat): this processor is no SPU");
    EXPECT_ABORT(spu_bisled_e(on_event), "spu_bisled_e(SPU_RdEventStat): this processor is no SPU");
    EXPECT_ABORT((void)spu_mfspr(1), "spu_mfspr(): this processor is no SPU");
    EXPECT_ABORT(spu_mtspr(1, 2), "spu_mtspr(): this processor is no SPU");
    EXPECT_ABORT(spu_stop(1), "spu_stop(): this processor is no SPU");
    EXPECT_ABORT(spu_hcmpeq(1, 1), "spu_hcmpeq: the comparison holds");
    EXPECT_ABORT(spu_hcmpgt(2u, 1u), "spu_hcmpgt: the comparison holds");
    spu_hcmpeq(1, 2); /* conditions that do not hold */
    spu_hcmpgt(1u, 1u);
    EXPECT_ABORT(unit_begin_critical_section(), "spu_readch(SPU_RdMachStat): this processor is no SPU");
}

TEST(missing_members_fail_loudly)
{
    static const cgt_spu_host empty_host = {.self = NULL};
    start(&empty_host);
    EXPECT_ABORT((void)spu_read_signal1(),
                 "spu_readch(SPU_RdSigNotify1): the cgt_spu_host of this thread has no member read_channel");
    EXPECT_ABORT(spu_stop(1), "spu_stop(): the cgt_spu_host of this thread has no member stop");
    EXPECT_ABORT(spu_hcmpeq(1, 1), "spu_hcmpeq: the comparison holds");
    EXPECT_ABORT(mfc_sync(3), "mfc_sync(MFC_Cmd): the cgt_spu_host of this thread has no member dma");
    spu_dsync();
    spu_mtfpscr(((vec_uint4){7, 0, 0, 0}));
    const vec_uint4 fpscr = spu_mffpscr();
    assert_int_equal(fpscr[0], 7);
    spu_mtfpscr(((vec_uint4){0, 0, 0, 0}));
#if UINTPTR_MAX > 0xffffffff
    /* no bit of an address is lost silently */
    start(&channel_host);
    volatile void *const high = (volatile void *)(UINTPTR_MAX - 0xffff);
    EXPECT_ABORT(mfc_get(high, 0, 16, 0, 0, 0), "mfc_get(MFC_LSA): the cgt_spu_host of this thread has no member dma, "
                                                "and the address in local storage exceeds 32 bits");
    EXPECT_ABORT(mfc_getl(0, 0, high, 8, 0, 0, 0), "mfc_getl(MFC_LSA): the cgt_spu_host of this thread has no member");
#endif
}

SEEDED_SUITE("test_spu_channels", NULL, NULL)
