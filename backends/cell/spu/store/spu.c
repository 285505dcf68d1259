/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPU's memory: its local store, from inside and from the other side of a DMA. */
#include "cell/spu/spu.h"

#include <string.h>

#include "cell/spu/isa/decoded.h"
#include "cell/spu/timing/timing.h"
#include "core/memory.h"

#define DECODED_BYTES ((CGT_SPU_WORDS + 1) * sizeof(cgt_spu_decoded))

cgt_result cgt_spu_create(cgt_spu *spu, const cgt_memory_hooks *memory, cgt_spu_mode mode)
{
    *spu = (cgt_spu){.memory = *memory, .code_low = CGT_SPU_LOCAL_STORE};
    spu->local_store = cgt_allocate(memory, CGT_SPU_LOCAL_STORE);
    spu->decoded = cgt_allocate(memory, DECODED_BYTES);
    if (mode == CGT_SPU_TIMED)
        spu->timing = cgt_allocate(memory, sizeof *spu->timing);
    if (spu->timing) /* before anything can fail: it is released then */
        cgt_spu_timing_init(spu->timing);
    if (!spu->local_store || !spu->decoded || (mode == CGT_SPU_TIMED && !spu->timing)) {
        cgt_spu_destroy(spu);
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    memset(spu->local_store, 0, CGT_SPU_LOCAL_STORE);
    memset(spu->decoded, 0, DECODED_BYTES);
    spu->decoded[CGT_SPU_WORDS].op = CGT_SPU_OP_END;
    return CGT_OK;
}

void cgt_spu_destroy(cgt_spu *spu)
{
    if (spu->timing) {
        cgt_spu_timing_release(spu->timing, &spu->memory);
        cgt_free(&spu->memory, spu->timing, sizeof *spu->timing);
    }
    cgt_free(&spu->memory, spu->decoded, DECODED_BYTES);
    cgt_free(&spu->memory, spu->local_store, CGT_SPU_LOCAL_STORE);
    spu->timing = NULL;
    spu->decoded = NULL;
    spu->local_store = NULL;
}

/* ---- words and bytes ---- */

static uint32_t load_big(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static void store_big(uint8_t *at, uint32_t value, size_t size)
{
    for (size_t i = 0; i < size; i++)
        at[i] = (uint8_t)(value >> 8 * (size - 1 - i));
}

uint32_t cgt_spu_load32(const cgt_spu *spu, uint32_t address)
{
    return load_big(spu->local_store + (address & (CGT_SPU_LOCAL_STORE - 4)));
}

void cgt_spu_store32(cgt_spu *spu, uint32_t address, uint32_t value)
{
    const uint32_t at = address & (CGT_SPU_LOCAL_STORE - 4);
    store_big(spu->local_store + at, value, 4);
    cgt_spu_forget(spu, at, 4);
}

static bool copy_is_possible(uint32_t address, size_t size)
{
    return (size <= 2 || size % 4 == 0) && address <= CGT_SPU_LOCAL_STORE && size <= CGT_SPU_LOCAL_STORE - address;
}

bool cgt_spu_copy_in(cgt_spu *spu, uint32_t address, const void *main_memory, size_t size)
{
    if (!copy_is_possible(address, size))
        return false;
    if (size == 0)
        return true;
    uint8_t *const to = spu->local_store + address;
    const uint8_t *const from = main_memory;
    if (size == 1) {
        to[0] = from[0];
    } else if (size == 2) {
        uint16_t value;
        memcpy(&value, from, 2);
        store_big(to, value, 2);
    } else {
        for (size_t i = 0; i < size; i += 4) {
            uint32_t value;
            memcpy(&value, from + i, 4);
            store_big(to + i, value, 4);
        }
    }
    cgt_spu_forget(spu, address, size);
    return true;
}

bool cgt_spu_copy_out(const cgt_spu *spu, uint32_t address, void *main_memory, size_t size)
{
    if (!copy_is_possible(address, size))
        return false;
    const uint8_t *const from = spu->local_store + address;
    uint8_t *const to = main_memory;
    if (size == 1) {
        to[0] = from[0];
    } else if (size == 2) {
        const uint16_t value = (uint16_t)(from[0] << 8 | from[1]);
        memcpy(to, &value, 2);
    } else {
        for (size_t i = 0; i < size; i += 4) {
            const uint32_t value = load_big(from + i);
            memcpy(to + i, &value, 4);
        }
    }
    return true;
}
