/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The channels of DMA, one by one: what each gives, when it stalls, and when the stall ends, by cycles counted from the
 * constants of the model. */
#include <string.h>

#include "cell/support/mfc_world.h"

#define SUITE_SETUP mfc_world_create
#define SUITE_TEARDOWN mfc_world_destroy
#include "support/suite.h"

/* ---- queue ---- */

/* Sixteen commands fit; the seventeenth stalls until the first has ended. The bus carries one after the other. */
TEST(full_queue)
{
    assert_int_equal(count(MFC_Cmd, 0), 16);
    for (uint32_t i = 0; i < 16; i++) {
        must_give(0, 128 * i, MEMORY_EA + 128 * i, 128, i, MFC_GET_CMD);
        assert_int_equal(count(MFC_Cmd, 0), 15 - i);
    }
    const uint32_t first_end = 16 + LATENCY;
    assert_int_equal(give(1, 0x1000, MEMORY_EA, 128, 16, MFC_GET_CMD), CGT_CHANNEL_STALL);
    assert_int_equal(world.c.write(world.mfc, MFC_Cmd, first_end - 1, MFC_GET_CMD), CGT_CHANNEL_STALL);
    assert_int_equal(cgt_mfc_next_event(world.mfc), first_end);
    assert_int_equal(world.c.write(world.mfc, MFC_Cmd, first_end, MFC_GET_CMD), CGT_CHANNEL_DONE);
    assert_int_equal(cgt_mfc_get_counts(world.mfc)->queue_stalls, 1);
    assert_int_equal(cgt_mfc_get_counts(world.mfc)->gets, 17);
    cgt_mfc_advance(world.mfc, 10000);
    assert_false(cgt_mfc_is_busy(world.mfc));
    assert_int_equal(count(MFC_Cmd, 10000), 16);
    assert_int_equal(world.trace.record[15].finished, 16 * 16 + LATENCY);
    assert_int_equal(world.trace.record[16].finished, first_end + 16 + LATENCY);
}

/* bytes_per_cycle, and nothing moves before the end */
TEST(bandwidth)
{
    const uint32_t end = 16384 / 8 + LATENCY;
    world.memory[4095] = 0x01020304;
    must_give(0, 0x4000, MEMORY_EA, 16384, 0, MFC_GET_CMD);
    cgt_mfc_advance(world.mfc, end - 1);
    assert_int_equal(load32(0x7ffc), 0);
    cgt_mfc_advance(world.mfc, end);
    assert_int_equal(load32(0x7ffc), 0x01020304);
    assert_int_equal(cgt_mfc_get_counts(world.mfc)->bytes_in, 16384);
}

/* ---- tags ---- */

TEST(tag_status)
{
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
TEST(byte_order)
{
    world.bytes[5] = 0x51;
    world.halfwords[3] = 0x6162;
    world.memory[1] = 0x71727374;
    world.doubles[1] = UINT64_C(0x8182838485868788);
    must_give(0, 0x105, BYTES_EA + 5, 1, 0, MFC_GET_CMD);
    must_give(0, 0x206, HALFWORDS_EA + 6, 2, 0, MFC_GET_CMD);
    must_give(0, 0x304, MEMORY_EA + 4, 4, 0, MFC_GET_CMD);
    must_give(0, 0x408, DOUBLES_EA + 8, 8, 0, MFC_GET_CMD);
    must_give(0, 0x500, HALFWORDS_EA, 16, 0, MFC_GET_CMD);
    cgt_mfc_advance(world.mfc, 1000);
    assert_int_equal(world.store[0x105], 0x51);
    assert_memory_equal(world.store + 0x206, "\x61\x62", 2);
    assert_memory_equal(world.store + 0x304, "\x71\x72\x73\x74", 4);
    assert_memory_equal(world.store + 0x408, "\x81\x82\x83\x84\x85\x86\x87\x88", 8);
    assert_memory_equal(world.store + 0x500, "\0\0\0\0\0\0\x61\x62\0", 9);
    must_give(1000, 0x105, BYTES_EA + 21, 1, 0, MFC_PUT_CMD);
    must_give(1000, 0x206, HALFWORDS_EA + 22, 2, 0, MFC_PUT_CMD);
    must_give(1000, 0x304, MEMORY_EA + 20, 4, 0, MFC_PUT_CMD);
    must_give(1000, 0x408, DOUBLES_EA + 24, 8, 0, MFC_PUT_CMD);
    cgt_mfc_advance(world.mfc, 2000);
    assert_int_equal(world.bytes[21], 0x51);
    assert_int_equal(world.halfwords[11], 0x6162);
    assert_int_equal(world.memory[5], 0x71727374);
    assert_true(world.doubles[3] == UINT64_C(0x8182838485868788));
}

/* sdcrz */
TEST(zeros)
{
    memset(world.memory, 0xff, sizeof world.memory);
    must_give(0, 0, MEMORY_EA + 128, 256, 0, MFC_SDCRZ_CMD);
    must_give(0, 0, MEMORY_EA + 4096, 256, 0, MFC_SDCRF_CMD);
    cgt_mfc_advance(world.mfc, 1000);
    for (unsigned i = 0; i < 8192; i++)
        assert_int_equal(world.memory[i], i >= 32 && i < 96 ? 0 : 0xffffffff);
}

/* ---- lists ---- */

/* The data of each element begins at the next quadword, with the low four bits of its effective address. */
TEST(list_of_pieces)
{
    for (uint32_t i = 0; i < 8192; i++)
        world.memory[i] = i;
    set_element(0x800, false, 48, MEMORY_EA + 4 * 100);
    set_element(0x808, false, 4, MEMORY_EA + 4 * 203);
    set_element(0x810, false, 0, 1);
    set_element(0x818, false, 8, MEMORY_EA + 4 * 302);
    set_element(0x820, false, 16, MEMORY_EA + 4 * 400);
    must_give(0, 0x1000, 0x800, 40, 2, MFC_GETL_CMD);
    cgt_mfc_advance(world.mfc, 1000);
    for (uint32_t i = 0; i < 12; i++)
        assert_int_equal(load32(0x1000 + 4 * i), 100 + i);
    assert_int_equal(load32(0x103c), 203);
    assert_int_equal(load32(0x1048), 302);
    assert_int_equal(load32(0x104c), 303);
    assert_int_equal(load32(0x1050), 400);
    assert_int_equal(load32(0x105c), 403);
    assert_int_equal(load32(0x1030) | load32(0x1034) | load32(0x1038) | load32(0x1040) | load32(0x1044), 0);
    const cgt_mfc_counts *const counts = cgt_mfc_get_counts(world.mfc);
    assert_true(counts->gets == 1 && counts->lists == 1 && counts->elements == 5 && counts->bytes_in == 76);
    /* five elements occupy the bus as a line each */
    assert_int_equal(world.trace.record[0].finished, 5 * 16 + LATENCY);
    assert_int_equal(world.trace.record[0].bytes, 76);
    assert_int_equal(world.trace.record[0].elements, 5);
    assert_int_equal(world.trace.record[0].ea, MEMORY_EA + 400);
}

/* 2,048 elements of one quadword, there and back */
TEST(longest_list)
{
    for (uint32_t i = 0; i < 2048; i++) {
        world.memory[4 * i] = i;
        set_element(0x8000 + 8 * i, false, 16, MEMORY_EA + 16 * (2047 - i));
    }
    must_give(0, 0, 0x8000, 16384, 0, MFC_GETL_CMD);
    must_give(0, 0, 0x8000, 16384, 0, MFC_PUTLB_CMD);
    cgt_mfc_advance(world.mfc, 1000000);
    for (uint32_t i = 0; i < 2048; i++) {
        assert_int_equal(load32(16 * i), 2047 - i);
        assert_int_equal(world.memory[4 * i], i);
    }
    assert_int_equal(cgt_mfc_get_counts(world.mfc)->elements, 4096);
}

/* A list stops behind an element that notifies, and takes the rest as it is when it goes on. */
TEST(stall_and_notify)
{
    const uint32_t end = 16 + LATENCY;
    world.memory[0] = 10;
    world.memory[32] = 20;
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
    assert_int_equal(world.trace.count, 3);
}

/* One whose last element notifies ends when it goes on. */
TEST(last_element_notifies)
{
    world.memory[0] = 10;
    set_element(0x800, true, 16, MEMORY_EA);
    set_element(0x808, false, 16, 0xdead0000); /* not of the list */
    must_give(0, 0x1000, 0x800, 8, 5, MFC_GETL_CMD);
    expect(MFC_RdListStallStat, 1000, 1u << 5);
    put(MFC_WrTagMask, 1000, 1u << 5);
    put(MFC_WrTagUpdate, 1000, MFC_TAG_UPDATE_IMMEDIATE);
    expect(MFC_RdTagStat, 1000, 0);
    put(MFC_WrListStallAck, 1000, 5);
    put(MFC_WrTagUpdate, 1000, MFC_TAG_UPDATE_ALL);
    expect(MFC_RdTagStat, 3000, 1u << 5);
    assert_int_equal(load32(0x1000), 10);
    assert_int_equal(cgt_mfc_get_counts(world.mfc)->elements, 1);
}

/* ---- the rest ---- */

TEST(other_channels)
{
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
TEST(no_upper_half)
{
    static uint32_t far[4] = {1, 2, 3, 4};
    assert_int_equal(cgt_ea_map_add_memory(&world.map, UINT64_C(0x500000000) + MEMORY_EA, far, 4, 4, false), CGT_OK);
    world.memory[0] = 99;
    must_give(0, 0x100, UINT64_C(0x500000000) + MEMORY_EA, 16, 0, MFC_GET_CMD);
    put(MFC_LSA, 1, 0x200);
    put(MFC_EAL, 1, MEMORY_EA);
    put(MFC_Size, 1, 16);
    put(MFC_TagID, 1, 0);
    put(MFC_Cmd, 1, MFC_GET_CMD);
    cgt_mfc_advance(world.mfc, 1000);
    assert_int_equal(load32(0x100), 1);
    assert_int_equal(load32(0x200), 99);
}

static void expect_record(const cgt_mfc_record *r, const cgt_mfc_record *want)
{
    assert_true(r->issued == want->issued && r->started == want->started && r->finished == want->finished);
    assert_true(r->spe == want->spe && r->tag == want->tag && r->lsa == want->lsa && r->ea == want->ea);
    assert_true(r->bytes == want->bytes && r->elements == want->elements);
    assert_string_equal(r->command, want->command);
}

TEST(records)
{
    must_give(7, 0x1000, MEMORY_EA, 128, 31, MFC_PUTF_CMD);
    set_element(0x800, false, 32, MEMORY_EA + 256);
    must_give(8, 0x2000, 0x800, 8, 30, MFC_GETL_CMD);
    cgt_mfc_advance(world.mfc, 1000);
    assert_int_equal(world.trace.count, 2);
    expect_record(&world.trace.record[0], &(cgt_mfc_record){.issued = 7,
                                                            .started = 7,
                                                            .finished = 323,
                                                            .spe = 3,
                                                            .command = "mfc_putf",
                                                            .tag = 31,
                                                            .lsa = 0x1000,
                                                            .ea = MEMORY_EA,
                                                            .bytes = 128});
    expect_record(&world.trace.record[1], &(cgt_mfc_record){.issued = 8,
                                                            .started = 8,
                                                            .finished = 339,
                                                            .spe = 3,
                                                            .command = "mfc_getl",
                                                            .tag = 30,
                                                            .lsa = 0x2000,
                                                            .ea = MEMORY_EA + 256,
                                                            .bytes = 32,
                                                            .elements = 1});
}

SEEDED_SUITE("test_mfc_channels", NULL, NULL)
