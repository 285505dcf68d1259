/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The host (spu_host.h) of an SPE program that is compiled for this machine: its words reach the MFC of its SPE.
 * Pointers become offsets in the arena, which is the local store. */
#include <inttypes.h>

#include "cell/machine/native_internal.h"
#include "spu_channels.h"

static uint32_t read_channel(void *self, unsigned channel)
{
    cgt_native *const native = self;
    uint32_t value = 0;
    if (channel == SPU_RdMachStat) /* of the SPU, not of its MFC; the mode is never isolated */
        return native->interrupts;
    cgt_native_access(native, channel, false, &value);
    return value;
}

static void write_channel(void *self, unsigned channel, uint32_t value)
{
    cgt_native_access(self, channel, true, &value);
}

static uint32_t channel_count(void *self, unsigned channel) { return cgt_native_count(self, channel); }

/* ---- DMA ---- */

/* Commands for caches and orders of commands use no local address: any pointer will do, mostly NULL. */
static bool uses_local_address(uint32_t command)
{
    const uint32_t group = command & 0xf0;
    return group != 0x80 && group != 0xc0;
}

/* Offset in the arena. What lies just behind it is left to the MFC, whose message then is that of a simulated
 * program. */
static uint32_t local_address(cgt_native *native, const cgt_spu_dma *dma, const volatile void *pointer)
{
    const uintptr_t offset = (uintptr_t)pointer - (uintptr_t)native->arena;
    if (offset <= 2 * (uintptr_t)CGT_LOCAL_STORE_BYTES)
        return (uint32_t)offset;
    if (!uses_local_address(dma->command))
        return 0;
    cgt_native_fail(native, CGT_RULE_LOCAL_STORE,
                    "command 0x%" PRIx32 "(ea 0x%" PRIx64 ", size %" PRIu32 ", tag %" PRIu32
                    "): the address is none of the local store (cgt_spe_arena)",
                    dma->command & 0xffff, (uint64_t)dma->eah << 32 | dma->eal, dma->size, dma->tag);
}

/* A list command of spu_mfcdma64 has the lower half of the list's address alone. */
static uint32_t lower_address(cgt_native *native, const cgt_spu_dma *dma)
{
    if (dma->list)
        return local_address(native, dma, dma->list);
    const bool list = (dma->command & 0x84) == 0x04;
    return list ? dma->eal - (uint32_t)(uintptr_t)native->arena : dma->eal;
}

static void start_dma(void *self, const cgt_spu_dma *dma)
{
    cgt_native *const native = self;
    const uint32_t lsa = local_address(native, dma, dma->ls);
    const uint32_t low = lower_address(native, dma);
    write_channel(native, MFC_LSA, lsa);
    if (dma->has_eah)
        write_channel(native, MFC_EAH, dma->eah);
    write_channel(native, MFC_EAL, low);
    write_channel(native, MFC_Size, dma->size);
    write_channel(native, MFC_TagID, dma->tag);
    write_channel(native, MFC_Cmd, dma->command);
}

/* ---- control ---- */

static void set_interrupts(void *self, bool enabled) { ((cgt_native *)self)->interrupts = enabled; }

static uint32_t read_register(void *self, unsigned number)
{
    cgt_native_fail(self, CGT_RULE_WORD, "spu_mfspr(%u): there are no special registers", number);
}

static void write_register(void *self, unsigned number, uint32_t value)
{
    cgt_native_fail(self, CGT_RULE_WORD, "spu_mtspr(%u, 0x%" PRIx32 "): there are no special registers", number, value);
}

static void stop(void *self, unsigned type) { cgt_native_stop(self, type); }
static void halt(void *self) { cgt_native_fail(self, CGT_RULE_HALT, "the program halted"); }

cgt_spu_host cgt_native_host(cgt_native *native)
{
    return (cgt_spu_host){.self = native,
                          .read_channel = read_channel,
                          .write_channel = write_channel,
                          .channel_count = channel_count,
                          .dma = start_dma,
                          .set_interrupts = set_interrupts,
                          .read_register = read_register,
                          .write_register = write_register,
                          .stop = stop,
                          .halt = halt};
}
