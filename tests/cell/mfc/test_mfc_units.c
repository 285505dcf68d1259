/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Mailboxes, signals, events, the decrementer, atomic lines, and the map of addresses. */
#include <string.h>

#include "cell/support/mfc_world.h"

#define SUITE_SETUP mfc_world_create
#define SUITE_TEARDOWN mfc_world_destroy
#include "support/suite.h"

/* ---- mailboxes and signals ---- */

TEST(mailboxes)
{
    uint32_t value = 0;
    expect_stall(SPU_RdInMbox, 0);
    for (uint32_t i = 0; i < 4; i++) {
        assert_true(cgt_mfc_send_mailbox(world.mfc, 10 + i, 100 + i));
        assert_int_equal(count(SPU_RdInMbox, 10 + i), i + 1);
    }
    assert_false(cgt_mfc_send_mailbox(world.mfc, 20, 104));
    for (uint32_t i = 0; i < 4; i++)
        expect(SPU_RdInMbox, 20, 100 + i);
    expect_stall(SPU_RdInMbox, 21);
    for (unsigned k = 0; k < 2; k++) {
        const unsigned channel = k ? SPU_WrOutIntrMbox : SPU_WrOutMbox;
        bool (*const take)(cgt_mfc *, uint64_t, uint32_t *) = k ? cgt_mfc_take_interrupt_mailbox : cgt_mfc_take_mailbox;
        assert_false(take(world.mfc, 30, &value));
        assert_int_equal(count(channel, 30), 1);
        put(channel, 30, 7 + k);
        assert_int_equal(count(channel, 30), 0);
        assert_int_equal(world.c.write(world.mfc, channel, 31, 9), CGT_CHANNEL_STALL);
        assert_true(take(world.mfc, 32, &value));
        assert_int_equal(value, 7 + k);
        put(channel, 33, 9);
    }
}

TEST(signals)
{
    cgt_mfc_set_signal_or(world.mfc, 2, true);
    expect_stall(SPU_RdSigNotify1, 0);
    for (unsigned n = 1; n <= 2; n++) {
        cgt_mfc_send_signal(world.mfc, 5, n, 0x11);
        cgt_mfc_send_signal(world.mfc, 6, n, 0x102);
    }
    assert_int_equal(count(SPU_RdSigNotify1, 6), 1);
    expect(SPU_RdSigNotify1, 7, 0x102); /* the last one */
    expect(SPU_RdSigNotify2, 7, 0x113); /* all of them */
    expect_stall(SPU_RdSigNotify1, 8);
    expect_stall(SPU_RdSigNotify2, 8);
    cgt_mfc_send_signal(world.mfc, 9, 2, 4);
    expect(SPU_RdSigNotify2, 9, 4);          /* a read empties it */
    cgt_mfc_send_signal(world.mfc, 9, 3, 4); /* there is none: nothing happens */
}

/* by DMA: from local store at the low bits of the register's address */
TEST(sent_signals)
{
    const cgt_ea_region region = {
        .ea = 0x3000c, .bytes = 4, .kind = CGT_EA_SIGNAL, .owner = world.mfc, .number = 1, .writable = false};
    assert_int_equal(cgt_ea_map_add(&world.map, &region), CGT_OK);
    store32(0x10c, 0xabcd);
    must_give(0, 0x10c, 0x3000c, 4, 1, MFC_SNDSIG_CMD);
    expect_stall(SPU_RdSigNotify1, LATENCY - 1);
    expect(SPU_RdSigNotify1, LATENCY, 0xabcd);
    assert_int_equal(cgt_mfc_get_counts(world.mfc)->signals, 1);
}

/* ---- decrementer and events ---- */

TEST(decrementer)
{
    put(SPU_WrDec, 1000, 3);
    expect(SPU_RdDec, 1039, 3);
    expect(SPU_RdDec, 1040, 2);
    expect(SPU_RdDec, 1159, 0);
    expect_stall(SPU_RdEventStat, 1159);
    put(SPU_WrEventMask, 1159, MFC_DECREMENTER_EVENT);
    expect_stall(SPU_RdEventStat, 1159);
    assert_int_equal(cgt_mfc_next_event(world.mfc), 1160);
    expect(SPU_RdEventStat, 1160, MFC_DECREMENTER_EVENT);
    expect(SPU_RdDec, 1160, 0xffffffffu);
    put(SPU_WrDec, 2000, 0x80000000u); /* has the bit already */
    assert_true(cgt_mfc_next_event(world.mfc) == CGT_NO_CYCLE);
}

/* A read takes the count away, an acknowledgement the event; what is left counts again. */
TEST(events)
{
    put(SPU_WrEventMask, 0, MFC_IN_MBOX_AVAILABLE_EVENT | MFC_SIGNAL_NOTIFY_1_EVENT);
    expect(SPU_RdEventMask, 0, MFC_IN_MBOX_AVAILABLE_EVENT | MFC_SIGNAL_NOTIFY_1_EVENT);
    cgt_mfc_send_signal(world.mfc, 1, 2, 1); /* not wanted */
    expect_stall(SPU_RdEventStat, 1);
    assert_true(cgt_mfc_send_mailbox(world.mfc, 2, 1));
    cgt_mfc_send_signal(world.mfc, 3, 1, 1);
    expect(SPU_RdEventStat, 4, MFC_IN_MBOX_AVAILABLE_EVENT | MFC_SIGNAL_NOTIFY_1_EVENT);
    expect_stall(SPU_RdEventStat, 4);
    put(SPU_WrEventAck, 5, MFC_SIGNAL_NOTIFY_1_EVENT);
    expect(SPU_RdEventStat, 5, MFC_IN_MBOX_AVAILABLE_EVENT);
    put(SPU_WrEventAck, 5, MFC_IN_MBOX_AVAILABLE_EVENT);
    expect_stall(SPU_RdEventStat, 6);
    put(SPU_WrEventMask, 7, MFC_SIGNAL_NOTIFY_2_EVENT); /* pending since cycle 1 */
    expect(SPU_RdEventStat, 7, MFC_SIGNAL_NOTIFY_2_EVENT);
}

TEST(events_of_dma)
{
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
    assert_true(cgt_mfc_take_mailbox(world.mfc, 20001, &value));
    assert_true(cgt_mfc_take_interrupt_mailbox(world.mfc, 20002, &value));
    expect(SPU_RdEventStat, 20002, MFC_OUT_MBOX_AVAILABLE_EVENT | MFC_OUT_INTR_MBOX_AVAILABLE_EVENT);
}

/* ---- atomic lines ---- */

TEST(atomic_lines)
{
    world.memory[0] = 5;
    must_give(0, 0x1000, MEMORY_EA, 128, 0, MFC_GETLLAR_CMD);
    assert_int_equal(give(1, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLC_CMD), CGT_CHANNEL_STALL); /* one at a time */
    expect_stall(MFC_RdAtomicStat, LATENCY - 1);
    expect(MFC_RdAtomicStat, LATENCY, MFC_GETLLAR_STATUS);
    assert_int_equal(load32(0x1000), 5);
    store32(0x1000, 6);
    must_give(400, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLC_CMD);
    expect(MFC_RdAtomicStat, 700, 0);
    assert_int_equal(world.memory[0], 6);
    /* the reservation is gone */
    store32(0x1000, 7);
    must_give(800, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLC_CMD);
    expect(MFC_RdAtomicStat, 1100, MFC_PUTLLC_STATUS);
    assert_int_equal(world.memory[0], 6);
    must_give(1200, 0x1000, MEMORY_EA, 128, 0, MFC_PUTLLUC_CMD);
    expect(MFC_RdAtomicStat, 1500, MFC_PUTLLUC_STATUS);
    assert_int_equal(world.memory[0], 7);
    store32(0x1000, 8);
    must_give(1600, 0x1000, MEMORY_EA, 128, 4, MFC_PUTQLLUC_CMD); /* through the queue: a tag, no atomic status */
    assert_int_equal(count(MFC_RdAtomicStat, 2000), 0);
    assert_int_equal(world.memory[0], 8);
    /* a reservation is of one line */
    must_give(2000, 0x1000, MEMORY_EA, 128, 0, MFC_GETLLAR_CMD);
    expect(MFC_RdAtomicStat, 2300, MFC_GETLLAR_STATUS);
    must_give(2400, 0x1000, MEMORY_EA + 128, 128, 0, MFC_PUTLLC_CMD);
    expect(MFC_RdAtomicStat, 2700, MFC_PUTLLC_STATUS);
    assert_int_equal(world.memory[32], 0);
    assert_int_equal(cgt_mfc_get_counts(world.mfc)->lost_lines, 2);
}

/* writes of others to the line, and to its neighbours */
TEST(lost_reservations)
{
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
        cgt_ea_map_written(&world.map, writes[i].ea, writes[i].bytes);
        assert_int_equal(count(SPU_RdEventStat, cycle + 400), writes[i].lost);
        put(SPU_WrEventAck, cycle + 400, MFC_LLR_LOST_EVENT);
        must_give(cycle + 500, 0x1000, MEMORY_EA + 128, 128, 0, MFC_PUTLLC_CMD);
        expect(MFC_RdAtomicStat, cycle + 900, writes[i].lost);
        put(SPU_WrEventAck, cycle + 900, MFC_LLR_LOST_EVENT);
    }
}

/* ---- maps and settings ---- */

TEST(maps)
{
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

TEST(settings)
{
    cgt_local_store store = {.bytes = world.store, .size = 16, .order = CGT_STORE_HOST};
    cgt_mfc_timing timing = cgt_mfc_default_timing;
    cgt_mfc *mfc, *more[CGT_MAX_SPES];
    assert_int_equal(cgt_mfc_create(&world.map, 16, &store, NULL, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    assert_null(mfc);
    timing.bytes_per_cycle = 0;
    assert_int_equal(cgt_mfc_create(&world.map, 0, &store, &timing, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    timing = cgt_mfc_default_timing;
    timing.decrementer_cycles = 0;
    assert_int_equal(cgt_mfc_create(&world.map, 0, &store, &timing, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    store.size = 24;
    assert_int_equal(cgt_mfc_create(&world.map, 0, &store, NULL, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    store.size = 2 * CGT_LOCAL_STORE_BYTES;
    assert_int_equal(cgt_mfc_create(&world.map, 0, &store, NULL, NULL, &mfc), CGT_ERROR_INVALID_ARGUMENT);
    store.size = 16;
    for (unsigned i = 1; i < CGT_MAX_SPES; i++) /* one is there */
        assert_int_equal(cgt_mfc_create(&world.map, i, &store, NULL, NULL, &more[i]), CGT_OK);
    assert_int_equal(cgt_mfc_create(&world.map, 0, &store, NULL, NULL, &mfc), CGT_ERROR_TOO_LARGE);
    for (unsigned i = 1; i < CGT_MAX_SPES; i++)
        cgt_mfc_free(more[i]);
    assert_int_equal(world.map.mfcs, 1);
    cgt_mfc_free(NULL);
}

SEEDED_SUITE("test_mfc_units", NULL, NULL)
