/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The channels of the MFC, one by one: what each gives, when it stalls, and when the stall ends, by cycles counted from
 * the constants of the model. */
#include <string.h>

#include "cell/mfc/mfc.h"
#include "spu_mfcio.h"
#include "support/test.h"

#define MEMORY_EA 0x10000u
#define LATENCY 300u /* of cgt_mfc_default_timing; a transfer of up to 128 bytes takes 16 cycles of the bus before it */

typedef struct world {
    _Alignas(16) uint8_t store[65536];
    uint32_t memory[8192]; /* 32 KB */
    uint8_t bytes[128];
    uint16_t halfwords[64];
    uint64_t doubles[16];
    cgt_ea_map map;
    cgt_mfc_trace trace;
    cgt_mfc *mfc;
    cgt_spu_channels c;
} world;

#define BYTES_EA 0x20000u
#define HALFWORDS_EA 0x20080u
#define DOUBLES_EA 0x20100u

static world w;

static int create(void **state)
{
    (void)state;
    const cgt_local_store store = {.bytes = w.store, .size = sizeof w.store, .order = CGT_STORE_BIG_ENDIAN};
    memset(&w, 0, sizeof w);
    cgt_ea_map_init(&w.map);
    cgt_mfc_trace_init(&w.trace);
    assert_int_equal(cgt_ea_map_add_memory(&w.map, MEMORY_EA, w.memory, 8192, 4, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&w.map, BYTES_EA, w.bytes, 128, 1, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&w.map, HALFWORDS_EA, w.halfwords, 64, 2, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&w.map, DOUBLES_EA, w.doubles, 16, 8, true), CGT_OK);
    assert_int_equal(cgt_mfc_create(&w.map, 3, &store, NULL, &w.trace, &w.mfc), CGT_OK);
    w.c = cgt_mfc_get_channels(w.mfc);
    return 0;
}

static int destroy(void **state)
{
    (void)state;
    cgt_mfc_free(w.mfc);
    cgt_mfc_trace_free(&w.trace);
    return 0;
}

/* ---- short forms ---- */

static void put(unsigned channel, uint64_t cycle, uint32_t value)
{
    assert_int_equal(w.c.write(w.mfc, channel, cycle, value), CGT_CHANNEL_DONE);
}

static cgt_channel_status give(uint64_t cycle, uint32_t lsa, uint64_t ea, uint32_t size, uint32_t tag, uint32_t command)
{
    put(MFC_LSA, cycle, lsa);
    put(MFC_EAH, cycle, mfc_ea2h(ea));
    put(MFC_EAL, cycle, mfc_ea2l(ea));
    put(MFC_Size, cycle, size);
    put(MFC_TagID, cycle, tag);
    return w.c.write(w.mfc, MFC_Cmd, cycle, command);
}

static void must_give(uint64_t cycle, uint32_t lsa, uint64_t ea, uint32_t size, uint32_t tag, uint32_t command)
{
    assert_int_equal(give(cycle, lsa, ea, size, tag, command), CGT_CHANNEL_DONE);
}

static void expect_stall(unsigned channel, uint64_t cycle)
{
    uint32_t value = 0;
    assert_int_equal(w.c.read(w.mfc, channel, cycle, &value), CGT_CHANNEL_STALL);
    assert_int_equal(w.c.count(w.mfc, channel, cycle), 0);
}

static void expect(unsigned channel, uint64_t cycle, uint32_t want)
{
    uint32_t value = ~want;
    assert_int_equal(w.c.read(w.mfc, channel, cycle, &value), CGT_CHANNEL_DONE);
    assert_int_equal(value, want);
}

static uint32_t count(unsigned channel, uint64_t cycle) { return w.c.count(w.mfc, channel, cycle); }

static void store32(uint32_t lsa, uint32_t value)
{
    for (unsigned i = 0; i < 4; i++)
        w.store[lsa + i] = (uint8_t)(value >> (24 - 8 * i));
}

static uint32_t load32(uint32_t lsa)
{
    const uint8_t *const b = w.store + lsa;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* ---- queue ---- */

/* Sixteen commands fit; the seventeenth stalls until the first has ended. The bus carries one after the other. */
static void full_queue(void **state)
{
    (void)state;
    assert_int_equal(count(MFC_Cmd, 0), 16);
    for (uint32_t i = 0; i < 16; i++) {
        must_give(0, 128 * i, MEMORY_EA + 128 * i, 128, i, MFC_GET_CMD);
        assert_int_equal(count(MFC_Cmd, 0), 15 - i);
    }
    const uint32_t first_end = 16 + LATENCY;
    assert_int_equal(give(1, 0x1000, MEMORY_EA, 128, 16, MFC_GET_CMD), CGT_CHANNEL_STALL);
    assert_int_equal(w.c.write(w.mfc, MFC_Cmd, first_end - 1, MFC_GET_CMD), CGT_CHANNEL_STALL);
    assert_int_equal(cgt_mfc_next_event(w.mfc), first_end);
    assert_int_equal(w.c.write(w.mfc, MFC_Cmd, first_end, MFC_GET_CMD), CGT_CHANNEL_DONE);
    assert_int_equal(cgt_mfc_get_counts(w.mfc)->queue_stalls, 1);
    assert_int_equal(cgt_mfc_get_counts(w.mfc)->gets, 17);
    cgt_mfc_advance(w.mfc, 10000);
    assert_false(cgt_mfc_is_busy(w.mfc));
    assert_int_equal(count(MFC_Cmd, 10000), 16);
    assert_int_equal(w.trace.record[15].finished, 16 * 16 + LATENCY);
    assert_int_equal(w.trace.record[16].finished, first_end + 16 + LATENCY);
}

/* bytes_per_cycle, and nothing moves before the end */
static void bandwidth(void **state)
{
    (void)state;
    const uint32_t end = 16384 / 8 + LATENCY;
    w.memory[4095] = 0x01020304;
    must_give(0, 0x4000, MEMORY_EA, 16384, 0, MFC_GET_CMD);
    cgt_mfc_advance(w.mfc, end - 1);
    assert_int_equal(load32(0x7ffc), 0);
    cgt_mfc_advance(w.mfc, end);
    assert_int_equal(load32(0x7ffc), 0x01020304);
    assert_int_equal(cgt_mfc_get_counts(w.mfc)->bytes_in, 16384);
}

/* ---- tags ---- */

static void tag_status(void **state)
{
    (void)state;
    const uint32_t first = 16 + LATENCY, second = 32 + LATENCY;
    must_give(0, 0, MEMORY_EA, 16, 3, MFC_GET_CMD);
    must_give(0, 16, MEMORY_EA, 16, 7, MFC_PUT_CMD);
    put(MFC_WrTagMask, 1, 1u << 3 | 1u << 7 | 1u << 9);
    expect(MFC_RdTagMask, 1, 1u << 3 | 1u << 7 | 1u << 9);
    put(MFC_WrTagUpdate, 2, MFC_TAG_UPDATE_IMMEDIATE);
    assert_int_equal(count(MFC_RdTagStat, 2), 1);
    expect(MFC_RdTagStat, 2, 1u << 9);
    assert_int_equal(count(MFC_RdTagStat, 2), 0);
    put(MFC_WrTagUpdate, 3, MFC_TAG_UPDATE_ANY); /* tag 9 has nothing to wait for */
    expect(MFC_RdTagStat, 3, 1u << 9);
    put(MFC_WrTagMask, 4, 1u << 3 | 1u << 7);
    put(MFC_WrTagUpdate, 4, MFC_TAG_UPDATE_ANY);
    expect_stall(MFC_RdTagStat, first - 1);
    expect(MFC_RdTagStat, first, 1u << 3);
    put(MFC_WrTagUpdate, first, MFC_TAG_UPDATE_ALL);
    expect_stall(MFC_RdTagStat, second - 1);
    expect(MFC_RdTagStat, second, 1u << 3 | 1u << 7);
    put(MFC_WrTagMask, second, 0);
    put(MFC_WrTagUpdate, second, MFC_TAG_UPDATE_ANY);
    expect(MFC_RdTagStat, second, 0);
}

/* ---- elements ---- */

/* Each unit keeps its numbers between the host's memory and a store in the SPU's order. */
static void byte_order(void **state)
{
    (void)state;
    w.bytes[5] = 0x51;
    w.halfwords[3] = 0x6162;
    w.memory[1] = 0x71727374;
    w.doubles[1] = UINT64_C(0x8182838485868788);
    must_give(0, 0x105, BYTES_EA + 5, 1, 0, MFC_GET_CMD);
    must_give(0, 0x206, HALFWORDS_EA + 6, 2, 0, MFC_GET_CMD);
    must_give(0, 0x304, MEMORY_EA + 4, 4, 0, MFC_GET_CMD);
    must_give(0, 0x408, DOUBLES_EA + 8, 8, 0, MFC_GET_CMD);
    must_give(0, 0x500, HALFWORDS_EA, 16, 0, MFC_GET_CMD);
    cgt_mfc_advance(w.mfc, 1000);
    assert_int_equal(w.store[0x105], 0x51);
    assert_memory_equal(w.store + 0x206, "\x61\x62", 2);
    assert_memory_equal(w.store + 0x304, "\x71\x72\x73\x74", 4);
    assert_memory_equal(w.store + 0x408, "\x81\x82\x83\x84\x85\x86\x87\x88", 8);
    assert_memory_equal(w.store + 0x500, "\0\0\0\0\0\0\x61\x62\0", 9);
    must_give(1000, 0x105, BYTES_EA + 21, 1, 0, MFC_PUT_CMD);
    must_give(1000, 0x206, HALFWORDS_EA + 22, 2, 0, MFC_PUT_CMD);
    must_give(1000, 0x304, MEMORY_EA + 20, 4, 0, MFC_PUT_CMD);
    must_give(1000, 0x408, DOUBLES_EA + 24, 8, 0, MFC_PUT_CMD);
    cgt_mfc_advance(w.mfc, 2000);
    assert_int_equal(w.bytes[21], 0x51);
    assert_int_equal(w.halfwords[11], 0x6162);
    assert_int_equal(w.memory[5], 0x71727374);
    assert_true(w.doubles[3] == UINT64_C(0x8182838485868788));
}

/* sdcrz */
static void zeros(void **state)
{
    (void)state;
    memset(w.memory, 0xff, sizeof w.memory);
    must_give(0, 0, MEMORY_EA + 128, 256, 0, MFC_SDCRZ_CMD);
    must_give(0, 0, MEMORY_EA + 4096, 256, 0, MFC_SDCRF_CMD);
    cgt_mfc_advance(w.mfc, 1000);
    for (unsigned i = 0; i < 8192; i++)
        assert_int_equal(w.memory[i], i >= 32 && i < 96 ? 0 : 0xffffffff);
}

/* ---- lists ---- */

static void set_element(uint32_t lsa, bool notify, uint32_t size, uint32_t eal)
{
    store32(lsa, (uint32_t)notify << 31 | size);
    store32(lsa + 4, eal);
}

/* The data of each element begins at the next quadword, with the low four bits of its effective address. */
static void list_of_pieces(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 8192; i++)
        w.memory[i] = i;
    set_element(0x800, false, 48, MEMORY_EA + 4 * 100);
    set_element(0x808, false, 4, MEMORY_EA + 4 * 203);
    set_element(0x810, false, 0, 1);
    set_element(0x818, false, 8, MEMORY_EA + 4 * 302);
    set_element(0x820, false, 16, MEMORY_EA + 4 * 400);
    must_give(0, 0x1000, 0x800, 40, 2, MFC_GETL_CMD);
    cgt_mfc_advance(w.mfc, 1000);
    for (uint32_t i = 0; i < 12; i++)
        assert_int_equal(load32(0x1000 + 4 * i), 100 + i);
    assert_int_equal(load32(0x103c), 203);
    assert_int_equal(load32(0x1048), 302);
    assert_int_equal(load32(0x104c), 303);
    assert_int_equal(load32(0x1050), 400);
    assert_int_equal(load32(0x105c), 403);
    assert_int_equal(load32(0x1030) | load32(0x1034) | load32(0x1038) | load32(0x1040) | load32(0x1044), 0);
    const cgt_mfc_counts *const counts = cgt_mfc_get_counts(w.mfc);
    assert_true(counts->gets == 1 && counts->lists == 1 && counts->elements == 5 && counts->bytes_in == 76);
    /* five elements occupy the bus as a line each */
    assert_int_equal(w.trace.record[0].finished, 5 * 16 + LATENCY);
    assert_int_equal(w.trace.record[0].bytes, 76);
    assert_int_equal(w.trace.record[0].elements, 5);
    assert_int_equal(w.trace.record[0].ea, MEMORY_EA + 400);
}

/* 2,048 elements of one quadword, there and back */
static void longest_list(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 2048; i++) {
        w.memory[4 * i] = i;
        set_element(0x8000 + 8 * i, false, 16, MEMORY_EA + 16 * (2047 - i));
    }
    must_give(0, 0, 0x8000, 16384, 0, MFC_GETL_CMD);
    must_give(0, 0, 0x8000, 16384, 0, MFC_PUTLB_CMD);
    cgt_mfc_advance(w.mfc, 1000000);
    for (uint32_t i = 0; i < 2048; i++) {
        assert_int_equal(load32(16 * i), 2047 - i);
        assert_int_equal(w.memory[4 * i], i);
    }
    assert_int_equal(cgt_mfc_get_counts(w.mfc)->elements, 4096);
}

/* A list stops behind an element that notifies, and takes the rest as it is when it goes on. */
static void stall_and_notify(void **state)
{
    (void)state;
    const uint32_t end = 16 + LATENCY;
    w.memory[0] = 10;
    w.memory[32] = 20;
    set_element(0x800, true, 16, MEMORY_EA);
    set_element(0x808, false, 16, 0xdead0000); /* wrong as yet */
    must_give(0, 0x1000, 0x800, 16, 5, MFC_GETL_CMD);
    must_give(0, 0x2000, MEMORY_EA, 16, 6, MFC_GET_CMD);
    expect_stall(MFC_RdListStallStat, end - 1);
    assert_int_equal(count(MFC_RdListStallStat, end), 1);
    expect(MFC_RdListStallStat, end, 1u << 5);
    expect_stall(MFC_RdListStallStat, end + 100); /* read once */
    put(MFC_WrTagMask, end + 100, 1u << 5 | 1u << 6);
    put(MFC_WrTagUpdate, end + 100, MFC_TAG_UPDATE_IMMEDIATE);
    expect(MFC_RdTagStat, end + 100, 1u << 6); /* others go on */
    assert_int_equal(load32(0x1000), 10);
    set_element(0x808, false, 16, MEMORY_EA + 128);
    put(MFC_WrListStallAck, end + 100, 5);
    put(MFC_WrTagUpdate, end + 100, MFC_TAG_UPDATE_ALL);
    expect_stall(MFC_RdTagStat, end + 100 + 15 + LATENCY);
    expect(MFC_RdTagStat, end + 100 + 16 + LATENCY, 1u << 5 | 1u << 6);
    assert_int_equal(load32(0x1010), 20);
    assert_int_equal(w.trace.count, 3);
}

/* ---- mailboxes and signals ---- */

static void mailboxes(void **state)
{
    (void)state;
    uint32_t value = 0;
    assert_int_equal(cgt_mfc_get_mailbox_space(w.mfc), 4);
    expect_stall(SPU_RdInMbox, 0);
    for (uint32_t i = 0; i < 4; i++) {
        assert_true(cgt_mfc_send_mailbox(w.mfc, 10 + i, 100 + i));
        assert_int_equal(count(SPU_RdInMbox, 10 + i), i + 1);
    }
    assert_false(cgt_mfc_send_mailbox(w.mfc, 20, 104));
    for (uint32_t i = 0; i < 4; i++)
        expect(SPU_RdInMbox, 20, 100 + i);
    expect_stall(SPU_RdInMbox, 21);
    for (unsigned k = 0; k < 2; k++) {
        const unsigned channel = k ? SPU_WrOutIntrMbox : SPU_WrOutMbox;
        bool (*const take)(cgt_mfc *, uint64_t, uint32_t *) = k ? cgt_mfc_take_interrupt_mailbox : cgt_mfc_take_mailbox;
        assert_false(take(w.mfc, 30, &value));
        assert_int_equal(count(channel, 30), 1);
        put(channel, 30, 7 + k);
        assert_int_equal(count(channel, 30), 0);
        assert_int_equal(w.c.write(w.mfc, channel, 31, 9), CGT_CHANNEL_STALL);
        assert_int_equal(k ? cgt_mfc_get_interrupt_mailbox_count(w.mfc) : cgt_mfc_get_mailbox_count(w.mfc), 1);
        assert_true(take(w.mfc, 32, &value));
        assert_int_equal(value, 7 + k);
        put(channel, 33, 9);
    }
}

static void signals(void **state)
{
    (void)state;
    cgt_mfc_set_signal_or(w.mfc, 2, true);
    expect_stall(SPU_RdSigNotify1, 0);
    for (unsigned n = 1; n <= 2; n++) {
        cgt_mfc_send_signal(w.mfc, 5, n, 0x11);
        cgt_mfc_send_signal(w.mfc, 6, n, 0x102);
    }
    assert_int_equal(count(SPU_RdSigNotify1, 6), 1);
    expect(SPU_RdSigNotify1, 7, 0x102); /* the last one */
    expect(SPU_RdSigNotify2, 7, 0x113); /* all of them */
    expect_stall(SPU_RdSigNotify1, 8);
    expect_stall(SPU_RdSigNotify2, 8);
    cgt_mfc_send_signal(w.mfc, 9, 2, 4);
    expect(SPU_RdSigNotify2, 9, 4);      /* a read empties it */
    cgt_mfc_send_signal(w.mfc, 9, 3, 4); /* there is none: nothing happens */
}

/* by DMA: from local store at the low bits of the register's address */
static void sent_signals(void **state)
{
    (void)state;
    const cgt_ea_region region = {
        .ea = 0x3000c, .bytes = 4, .kind = CGT_EA_SIGNAL, .owner = w.mfc, .number = 1, .writable = false};
    assert_int_equal(cgt_ea_map_add(&w.map, &region), CGT_OK);
    store32(0x10c, 0xabcd);
    must_give(0, 0x10c, 0x3000c, 4, 1, MFC_SNDSIG_CMD);
    expect_stall(SPU_RdSigNotify1, LATENCY - 1);
    expect(SPU_RdSigNotify1, LATENCY, 0xabcd);
    assert_int_equal(cgt_mfc_get_counts(w.mfc)->signals, 1);
}

/* ---- decrementer and events ---- */

static void decrementer(void **state)
{
    (void)state;
    put(SPU_WrDec, 1000, 3);
    expect(SPU_RdDec, 1039, 3);
    expect(SPU_RdDec, 1040, 2);
    expect(SPU_RdDec, 1159, 0);
    expect_stall(SPU_RdEventStat, 1159);
    put(SPU_WrEventMask, 1159, MFC_DECREMENTER_EVENT);
    expect_stall(SPU_RdEventStat, 1159);
    assert_int_equal(cgt_mfc_next_event(w.mfc), 1160);
    expect(SPU_RdEventStat, 1160, MFC_DECREMENTER_EVENT);
    expect(SPU_RdDec, 1160, 0xffffffffu);
    put(SPU_WrDec, 2000, 0x80000000u); /* has the bit already */
    assert_true(cgt_mfc_next_event(w.mfc) == CGT_NO_CYCLE);
}

/* A read takes the count away, an acknowledgement the event; what is left counts again. */
static void events(void **state)
{
    (void)state;
    put(SPU_WrEventMask, 0, MFC_IN_MBOX_AVAILABLE_EVENT | MFC_SIGNAL_NOTIFY_1_EVENT);
    expect(SPU_RdEventMask, 0, MFC_IN_MBOX_AVAILABLE_EVENT | MFC_SIGNAL_NOTIFY_1_EVENT);
    cgt_mfc_send_signal(w.mfc, 1, 2, 1); /* not wanted */
    expect_stall(SPU_RdEventStat, 1);
    assert_true(cgt_mfc_send_mailbox(w.mfc, 2, 1));
    cgt_mfc_send_signal(w.mfc, 3, 1, 1);
    expect(SPU_RdEventStat, 4, MFC_IN_MBOX_AVAILABLE_EVENT | MFC_SIGNAL_NOTIFY_1_EVENT);
    expect_stall(SPU_RdEventStat, 4);
    put(SPU_WrEventAck, 5, MFC_SIGNAL_NOTIFY_1_EVENT);
    expect(SPU_RdEventStat, 5, MFC_IN_MBOX_AVAILABLE_EVENT);
    put(SPU_WrEventAck, 5, MFC_IN_MBOX_AVAILABLE_EVENT);
    expect_stall(SPU_RdEventStat, 6);
    put(SPU_WrEventMask, 7, MFC_SIGNAL_NOTIFY_2_EVENT); /* pending since cycle 1 */
    expect(SPU_RdEventStat, 7, MFC_SIGNAL_NOTIFY_2_EVENT);
}

static void events_of_dma(void **state)
{
    (void)state;
    const uint32_t wanted = MFC_TAG_STATUS_UPDATE_EVENT | MFC_LIST_STALL_NOTIFY_EVENT |
                            MFC_COMMAND_QUEUE_AVAILABLE_EVENT | MFC_OUT_MBOX_AVAILABLE_EVENT |
                            MFC_OUT_INTR_MBOX_AVAILABLE_EVENT;
    uint32_t value;
    put(SPU_WrEventMask, 0, wanted);
    set_element(0x800, true, 16, MEMORY_EA);
    must_give(0, 0x1000, 0x800, 8, 1, MFC_GETL_CMD);
    for (unsigned i = 0; i < 15; i++)
        must_give(0, 0, MEMORY_EA, 16, 2, MFC_GETF_CMD);
    put(MFC_WrTagMask, 0, 4);
    put(MFC_WrTagUpdate, 0, MFC_TAG_UPDATE_ALL);
    expect(SPU_RdEventStat, 16 + LATENCY, MFC_LIST_STALL_NOTIFY_EVENT);
    put(SPU_WrEventAck, 16 + LATENCY, wanted);
    expect(SPU_RdEventStat, 32 + LATENCY, MFC_COMMAND_QUEUE_AVAILABLE_EVENT);
    put(SPU_WrEventAck, 32 + LATENCY, wanted);
    expect(SPU_RdEventStat, 20000, MFC_TAG_STATUS_UPDATE_EVENT);
    put(SPU_WrEventAck, 20000, wanted);
    put(SPU_WrOutMbox, 20000, 1);
    put(SPU_WrOutIntrMbox, 20000, 1);
    assert_true(cgt_mfc_take_mailbox(w.mfc, 20001, &value));
    assert_true(cgt_mfc_take_interrupt_mailbox(w.mfc, 20002, &value));
    expect(SPU_RdEventStat, 20002, MFC_OUT_MBOX_AVAILABLE_EVENT | MFC_OUT_INTR_MBOX_AVAILABLE_EVENT);
}

/* ---- atomic lines ---- */

static void atomic_lines(void **state)
{
    (void)state;
    w.memory[0] = 5;
    must_give(0, 0x1000, MEMORY_EA, 128, 0, MFC_GETLLAR_CMD);
    assert_int_equal(give(1, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLC_CMD), CGT_CHANNEL_STALL); /* one at a time */
    expect_stall(MFC_RdAtomicStat, LATENCY - 1);
    expect(MFC_RdAtomicStat, LATENCY, MFC_GETLLAR_STATUS);
    assert_int_equal(load32(0x1000), 5);
    store32(0x1000, 6);
    must_give(400, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLC_CMD);
    expect(MFC_RdAtomicStat, 700, 0);
    assert_int_equal(w.memory[0], 6);
    /* the reservation is gone */
    store32(0x1000, 7);
    must_give(800, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLC_CMD);
    expect(MFC_RdAtomicStat, 1100, MFC_PUTLLC_STATUS);
    assert_int_equal(w.memory[0], 6);
    must_give(1200, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLUC_CMD);
    expect(MFC_RdAtomicStat, 1500, MFC_PUTLLUC_STATUS);
    assert_int_equal(w.memory[0], 7);
    store32(0x1000, 8);
    must_give(1600, 0x1000, MEMORY_EA, 128, 4, MFC_PUTQLLUC_CMD); /* through the queue: a tag, no atomic status */
    assert_int_equal(count(MFC_RdAtomicStat, 2000), 0);
    assert_int_equal(w.memory[0], 8);
    assert_int_equal(cgt_mfc_get_counts(w.mfc)->lost_lines, 1);
}

/* writes of others to the line, and to its neighbours */
static void lost_reservations(void **state)
{
    (void)state;
    static const struct {
        uint32_t ea, bytes;
        bool lost;
    } writes[] = {{MEMORY_EA, 128, false},     {MEMORY_EA + 124, 4, false}, {MEMORY_EA + 124, 8, true},
                  {MEMORY_EA + 128, 1, true},  {MEMORY_EA + 255, 1, true},  {MEMORY_EA + 256, 16, false},
                  {MEMORY_EA, 0x8000, true},   {MEMORY_EA + 128, 0, false}, {MEMORY_EA + 160, 16, true},
                  {MEMORY_EA + 192, 128, true}};
    put(SPU_WrEventMask, 0, MFC_LLR_LOST_EVENT);
    for (unsigned i = 0; i < TEST_COUNT(writes); i++) {
        const uint64_t cycle = 10000 * (uint64_t)(i + 1);
        must_give(cycle, 0x1000, MEMORY_EA + 128, 128, 0, MFC_GETLLAR_CMD);
        expect(MFC_RdAtomicStat, cycle + LATENCY, MFC_GETLLAR_STATUS);
        cgt_ea_map_written(&w.map, writes[i].ea, writes[i].bytes);
        assert_int_equal(count(SPU_RdEventStat, cycle + 400), writes[i].lost);
        put(SPU_WrEventAck, cycle + 400, MFC_LLR_LOST_EVENT);
        must_give(cycle + 500, 0x1000, MEMORY_EA + 128, 128, 0, MFC_PUTLLC_CMD);
        expect(MFC_RdAtomicStat, cycle + 900, writes[i].lost);
        put(SPU_WrEventAck, cycle + 900, MFC_LLR_LOST_EVENT);
    }
}

/* ---- the rest ---- */

static void other_channels(void **state)
{
    (void)state;
    put(MFC_WrMSSyncReq, 0, 0);
    assert_int_equal(count(MFC_WrMSSyncReq, 0), 1);
    expect(SPU_RdMachStat, 0, 0);
    put(SPU_WrSRR0, 0, 0x3fffc);
    expect(SPU_RdSRR0, 0, 0x3fffc);
    assert_int_equal(count(MFC_LSA, 0), 1);
    assert_int_equal(count(MFC_WrTagUpdate, 0), 1);
    assert_int_equal(count(77, 0), 0);
}

/* spu_mfcdma32 writes no upper half: it is not that of the command before */
static void no_upper_half(void **state)
{
    (void)state;
    static uint32_t far[4] = {1, 2, 3, 4};
    assert_int_equal(cgt_ea_map_add_memory(&w.map, UINT64_C(0x500000000) + MEMORY_EA, far, 4, 4, false), CGT_OK);
    w.memory[0] = 99;
    must_give(0, 0x100, UINT64_C(0x500000000) + MEMORY_EA, 16, 0, MFC_GET_CMD);
    put(MFC_LSA, 1, 0x200);
    put(MFC_EAL, 1, MEMORY_EA);
    put(MFC_Size, 1, 16);
    put(MFC_TagID, 1, 0);
    put(MFC_Cmd, 1, MFC_GET_CMD);
    cgt_mfc_advance(w.mfc, 1000);
    assert_int_equal(load32(0x100), 1);
    assert_int_equal(load32(0x200), 99);
}

static void trace_as_text(void **state)
{
    (void)state;
    char text[512];
    must_give(7, 0x1000, MEMORY_EA, 128, 31, MFC_PUTF_CMD);
    set_element(0x800, false, 32, MEMORY_EA + 256);
    must_give(8, 0x2000, 0x800, 8, 30, MFC_GETL_CMD);
    cgt_mfc_advance(w.mfc, 1000);
    FILE *const file = tmpfile();
    assert_non_null(file);
    assert_true(cgt_mfc_trace_write(&w.trace, file));
    rewind(file);
    const size_t length = fread(text, 1, sizeof text - 1, file);
    text[length] = '\0';
    fclose(file);
    assert_string_equal(text, "issued\tstarted\tfinished\tspe\tcommand\ttag\tlsa\tea\tbytes\telements\n"
                              "7\t7\t323\t3\tmfc_putf\t31\t0x1000\t0x10000\t128\t0\n"
                              "8\t8\t339\t3\tmfc_getl\t30\t0x2000\t0x10100\t32\t1\n");
    w.trace.lost = 1; /* as after a failed allocation */
    FILE *const again = tmpfile();
    assert_non_null(again);
    assert_false(cgt_mfc_trace_write(&w.trace, again));
    fclose(again);
}

/* ---- maps and settings ---- */

static void maps(void **state)
{
    (void)state;
    static uint32_t some[64];
    cgt_ea_map map;
    cgt_ea_map_init(&map);
    assert_null(cgt_ea_map_find(&map, 0));
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x1000, some, 64, 4, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x1080, some, 1, 4, true), CGT_ERROR_INVALID_ARGUMENT); /* overlaps */
    assert_int_equal(cgt_ea_map_add_memory(&map, 0xf80, some, 33, 4, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x1100, some, 8, 4, true), CGT_OK); /* right behind */
    assert_int_equal(cgt_ea_map_add_memory(&map, 0xf80, some, 32, 4, true), CGT_OK); /* right before */
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x2010, some, 4, 4, true), CGT_ERROR_INVALID_ARGUMENT); /* a line */
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x2000, some, 4, 3, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x2000, some, 4, 0, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x2000, some, 0, 4, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x2000, NULL, 4, 4, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x2000, some, UINT64_MAX / 2, 4, true), CGT_ERROR_TOO_LARGE);
    assert_int_equal(cgt_ea_map_add_memory(&map, UINT64_MAX - 127, some, 64, 4, true), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_ea_map_add_memory(&map, UINT64_MAX - 127, some, 32, 4, true), CGT_OK);
    assert_int_equal(map.regions, 4);
    assert_null(cgt_ea_map_find(&map, 0xf7f));
    assert_int_equal(cgt_ea_map_find(&map, 0xfff)->ea, 0xf80);
    assert_int_equal(cgt_ea_map_find(&map, 0x10ff)->ea, 0x1000);
    assert_int_equal(cgt_ea_map_find(&map, 0x111f)->ea, 0x1100);
    assert_null(cgt_ea_map_find(&map, 0x1120));
    assert_non_null(cgt_ea_map_find(&map, UINT64_MAX));
    for (unsigned i = 4; i < CGT_EA_MAX_REGIONS; i++)
        assert_int_equal(cgt_ea_map_add_memory(&map, 0x10000 * (uint64_t)i, some, 64, 4, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&map, 0x8000000, some, 64, 4, true), CGT_ERROR_TOO_LARGE);
}

static void settings(void **state)
{
    (void)state;
    cgt_local_store store = {.bytes = w.store, .size = 16, .order = CGT_STORE_HOST};
    cgt_mfc_timing timing = cgt_mfc_default_timing;
    cgt_mfc *mfc, *more[CGT_MAX_SPES];
    assert_int_equal(cgt_mfc_create(&w.map, 16, &store, NULL, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    assert_null(mfc);
    timing.bytes_per_cycle = 0;
    assert_int_equal(cgt_mfc_create(&w.map, 0, &store, &timing, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    timing = cgt_mfc_default_timing;
    timing.decrementer_cycles = 0;
    assert_int_equal(cgt_mfc_create(&w.map, 0, &store, &timing, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    store.size = 24;
    assert_int_equal(cgt_mfc_create(&w.map, 0, &store, NULL, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    store.size = 2 * CGT_LOCAL_STORE_BYTES;
    assert_int_equal(cgt_mfc_create(&w.map, 0, &store, NULL, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    store.size = 16;
    for (unsigned i = 1; i < CGT_MAX_SPES; i++) /* one is there */
        assert_int_equal(cgt_mfc_create(&w.map, i, &store, NULL, NULL, &more[i]), CGT_OK);
    assert_int_equal(cgt_mfc_create(&w.map, 0, &store, NULL, NULL, &mfc), CGT_ERROR_TOO_LARGE);
    for (unsigned i = 1; i < CGT_MAX_SPES; i++)
        cgt_mfc_free(more[i]);
    assert_int_equal(w.map.mfcs, 1);
    cgt_mfc_free(NULL);
}

#define WITH_MFC(test) cmocka_unit_test_setup_teardown(test, create, destroy)

int main(void)
{
    test_begin("test_mfc_channels");
    const struct CMUnitTest tests[] = {
        WITH_MFC(full_queue),     WITH_MFC(bandwidth),      WITH_MFC(tag_status),    WITH_MFC(byte_order),
        WITH_MFC(zeros),          WITH_MFC(list_of_pieces), WITH_MFC(longest_list),  WITH_MFC(stall_and_notify),
        WITH_MFC(mailboxes),      WITH_MFC(signals),        WITH_MFC(sent_signals),  WITH_MFC(decrementer),
        WITH_MFC(events),         WITH_MFC(events_of_dma),  WITH_MFC(atomic_lines),  WITH_MFC(lost_reservations),
        WITH_MFC(other_channels), WITH_MFC(no_upper_half),  WITH_MFC(trace_as_text), WITH_MFC(maps),
        WITH_MFC(settings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
