/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One MFC to test. */
#include "cell/support/mfc_world.h"

#include <string.h>

mfc_world world;

void mfc_world_begin(const cgt_mfc_timing *timing)
{
    const cgt_local_store store = {.bytes = world.store, .size = sizeof world.store, .order = CGT_STORE_BIG_ENDIAN};
    memset(&world, 0, sizeof world);
    cgt_ea_map_init(&world.map);
    cgt_mfc_trace_init(&world.trace);
    assert_int_equal(cgt_ea_map_add_memory(&world.map, MEMORY_EA, world.memory, 8192, 4, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&world.map, BYTES_EA, world.bytes, 128, 1, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&world.map, HALFWORDS_EA, world.halfwords, 64, 2, true), CGT_OK);
    assert_int_equal(cgt_ea_map_add_memory(&world.map, DOUBLES_EA, world.doubles, 16, 8, true), CGT_OK);
    assert_int_equal(cgt_mfc_create(&world.map, 3, &store, timing, &world.trace, &world.mfc), CGT_OK);
    world.c = cgt_mfc_get_channels(world.mfc);
}

void mfc_world_end(void)
{
    cgt_mfc_free(world.mfc);
    cgt_mfc_trace_free(&world.trace);
}

int mfc_world_create(void **state)
{
    (void)state;
    mfc_world_begin(NULL);
    return 0;
}

int mfc_world_destroy(void **state)
{
    (void)state;
    mfc_world_end();
    return 0;
}

/* ---- short forms ---- */

void put(unsigned channel, uint64_t cycle, uint32_t value)
{
    assert_int_equal(world.c.write(world.mfc, channel, cycle, value), CGT_CHANNEL_DONE);
}

cgt_channel_status give(uint64_t cycle, uint32_t lsa, uint64_t ea, uint32_t size, uint32_t tag, uint32_t command)
{
    put(MFC_LSA, cycle, lsa);
    put(MFC_EAH, cycle, mfc_ea2h(ea));
    put(MFC_EAL, cycle, mfc_ea2l(ea));
    put(MFC_Size, cycle, size);
    put(MFC_TagID, cycle, tag);
    return world.c.write(world.mfc, MFC_Cmd, cycle, command);
}

void must_give(uint64_t cycle, uint32_t lsa, uint64_t ea, uint32_t size, uint32_t tag, uint32_t command)
{
    assert_int_equal(give(cycle, lsa, ea, size, tag, command), CGT_CHANNEL_DONE);
}

void expect_stall(unsigned channel, uint64_t cycle)
{
    uint32_t value = 0;
    assert_int_equal(world.c.read(world.mfc, channel, cycle, &value), CGT_CHANNEL_STALL);
    assert_int_equal(world.c.count(world.mfc, channel, cycle), 0);
}

void expect(unsigned channel, uint64_t cycle, uint32_t want)
{
    uint32_t value = ~want;
    assert_int_equal(world.c.read(world.mfc, channel, cycle, &value), CGT_CHANNEL_DONE);
    assert_int_equal(value, want);
}

uint32_t count(unsigned channel, uint64_t cycle) { return world.c.count(world.mfc, channel, cycle); }

void store32(uint32_t lsa, uint32_t value)
{
    for (unsigned i = 0; i < 4; i++)
        world.store[lsa + i] = (uint8_t)(value >> (24 - 8 * i));
}

uint32_t load32(uint32_t lsa)
{
    const uint8_t *const b = world.store + lsa;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

void set_element(uint32_t lsa, bool notify, uint32_t size, uint32_t eal)
{
    store32(lsa, (uint32_t)notify << 31 | size);
    store32(lsa + 4, eal);
}
