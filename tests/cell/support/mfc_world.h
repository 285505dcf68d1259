/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One MFC with a local store and memory of each unit, and short forms of what tests do with its channels. */
#ifndef MFC_WORLD_H
#define MFC_WORLD_H

#include "cell/mfc/mfc.h"
#include "spu_mfcio.h"
#include "support/test.h"

#define MEMORY_EA 0x10000u
#define BYTES_EA 0x20000u
#define HALFWORDS_EA 0x20080u
#define DOUBLES_EA 0x20100u
#define LATENCY 300u /* of cgt_mfc_default_timing; a transfer of up to 128 bytes takes 16 cycles of the bus before it */

typedef struct mfc_world {
    _Alignas(16) uint8_t store[65536];
    uint32_t memory[8192]; /* 32 KB */
    uint8_t bytes[128];
    uint16_t halfwords[64];
    uint64_t doubles[16];
    cgt_ea_map map;
    cgt_mfc_trace trace;
    cgt_mfc *mfc;
    cgt_spu_channels c;
} mfc_world;

extern mfc_world world;

/* A new world; NULL: the default timing. Another one ends with mfc_world_end. */
void mfc_world_begin(const cgt_mfc_timing *timing);
void mfc_world_end(void);

/* cmocka's setup and teardown: a new world for each test */
int mfc_world_create(void **state);
int mfc_world_destroy(void **state);

void put(unsigned channel, uint64_t cycle, uint32_t value); /* must not stall */
cgt_channel_status give(uint64_t cycle, uint32_t lsa, uint64_t ea, uint32_t size, uint32_t tag, uint32_t command);
void must_give(uint64_t cycle, uint32_t lsa, uint64_t ea, uint32_t size, uint32_t tag, uint32_t command);
void expect_stall(unsigned channel, uint64_t cycle); /* of a read, and a count of 0 */
void expect(unsigned channel, uint64_t cycle, uint32_t want);
uint32_t count(unsigned channel, uint64_t cycle);

/* words of local store */
void store32(uint32_t lsa, uint32_t value);
uint32_t load32(uint32_t lsa);
void set_element(uint32_t lsa, bool notify, uint32_t size, uint32_t eal);

#endif
