/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The channel and control words where there is no SPU: the SPU compiler's names and signatures, carried out by the host
 * of the thread (spu_host.h). Without a host they abort with a message, except
 *
 *   spu_sync, spu_sync_c, spu_dsync   a memory barrier
 *   spu_mffpscr, spu_mtfpscr          a register of the thread: what was written to the bits that exist is read back.
 *                                     It starts as zero. Arithmetic words neither obey nor change it.
 *   spu_hcmpeq, spu_hcmpgt            where the comparison holds: a message and abort; else nothing
 *   __align_hint                      nothing
 *
 * Channels are 32 bits wide; the quadword words take and give element 0. */
#ifndef CGT_SPU_CHANNELS_H
#define CGT_SPU_CHANNELS_H

#include "spu_host.h"
#include "spu/spu_types.h"

/* ---- channels ---- */

#define SPU_RdEventStat 0
#define SPU_WrEventMask 1
#define SPU_WrEventAck 2
#define SPU_RdSigNotify1 3
#define SPU_RdSigNotify2 4
#define SPU_WrDec 7
#define SPU_RdDec 8
#define MFC_WrMSSyncReq 9
#define SPU_RdEventMask 11
#define MFC_RdTagMask 12
#define SPU_RdMachStat 13
#define SPU_WrSRR0 14
#define SPU_RdSRR0 15
#define MFC_LSA 16
#define MFC_EAH 17
#define MFC_EAL 18
#define MFC_Size 19
#define MFC_TagID 20
#define MFC_Cmd 21
#define MFC_WrTagMask 22
#define MFC_WrTagUpdate 23
#define MFC_RdTagStat 24
#define MFC_RdListStallStat 25
#define MFC_WrListStallAck 26
#define MFC_RdAtomicStat 27
#define SPU_WrOutMbox 28
#define SPU_RdInMbox 29
#define SPU_WrOutIntrMbox 30

/* ---- channel words ---- */

#define CGT_SPU_CONTROL static inline __attribute__((unused))

CGT_SPU_CONTROL uint32_t cgt_spu_readch(unsigned channel)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->read_channel)
        cgt_spu_fail("spu_readch", channel, "read_channel");
    return host->read_channel(host->self, channel);
}

CGT_SPU_CONTROL uint32_t cgt_spu_readchcnt(unsigned channel)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->channel_count)
        cgt_spu_fail("spu_readchcnt", channel, "channel_count");
    return host->channel_count(host->self, channel);
}

CGT_SPU_CONTROL void cgt_spu_writech(unsigned channel, uint32_t value)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->write_channel)
        cgt_spu_fail("spu_writech", channel, "write_channel");
    host->write_channel(host->self, channel, value);
}

CGT_SPU_CONTROL vec_uint4 cgt_spu_readchqw(unsigned channel)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    uint32_t word[4] = {0, 0, 0, 0};
    if (host && host->read_channel_quadword)
        host->read_channel_quadword(host->self, channel, word);
    else if (host && host->read_channel)
        word[0] = host->read_channel(host->self, channel);
    else
        cgt_spu_fail("spu_readchqw", channel, "read_channel_quadword");
    return (vec_uint4){word[0], word[1], word[2], word[3]};
}

CGT_SPU_CONTROL void cgt_spu_writechqw(unsigned channel, vec_uint4 value)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    const uint32_t word[4] = {value[0], value[1], value[2], value[3]};
    if (host && host->write_channel_quadword)
        host->write_channel_quadword(host->self, channel, word);
    else if (host && host->write_channel)
        host->write_channel(host->self, channel, word[0]);
    else
        cgt_spu_fail("spu_writechqw", channel, "write_channel_quadword");
}

#define spu_readch(channel) cgt_spu_readch(channel)
#define spu_readchcnt(channel) cgt_spu_readchcnt(channel)
#define spu_writech(channel, a) cgt_spu_writech(channel, a)
#define spu_readchqw(channel) cgt_spu_readchqw(channel)
#define spu_writechqw(channel, a) cgt_spu_writechqw(channel, (vec_uint4)(a)) /* any vector */

/* ---- MFC commands ---- */

/* the command as the SPU gives it to the MFC */
CGT_SPU_CONTROL void cgt_spu_dma_by_channels(const cgt_spu_host *host, const char *word, const cgt_spu_dma *dma)
{
    const uint64_t ls = (uintptr_t)dma->ls, list = (uintptr_t)dma->list;
    if ((ls | list) >> 32)
        cgt_spu_fail(word, MFC_LSA, "dma, and the address in local storage exceeds 32 bits");
    host->write_channel(host->self, MFC_LSA, (uint32_t)ls);
    if (dma->has_eah)
        host->write_channel(host->self, MFC_EAH, dma->eah);
    host->write_channel(host->self, MFC_EAL, dma->eal);
    host->write_channel(host->self, MFC_Size, dma->size);
    host->write_channel(host->self, MFC_TagID, dma->tag);
    host->write_channel(host->self, MFC_Cmd, dma->command);
}

CGT_SPU_CONTROL void cgt_spu_dma_start(const char *word, const cgt_spu_dma *dma)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (host && host->dma)
        host->dma(host->self, dma);
    else if (host && host->write_channel)
        cgt_spu_dma_by_channels(host, word, dma);
    else
        cgt_spu_fail(word, MFC_Cmd, "dma");
}

CGT_SPU_CONTROL void spu_mfcdma32(volatile void *ls, unsigned int ea, unsigned int size, unsigned int tagid,
                                  unsigned int cmd)
{
    const cgt_spu_dma dma = {.ls = ls, .eal = ea, .size = size, .tag = tagid, .command = cmd};
    cgt_spu_dma_start("spu_mfcdma32", &dma);
}

/* A list command given by this word itself has the lower half of the list's address in ealow, as the caller's cast
 * left it; mfc_putl and the like pass the whole address. */
CGT_SPU_CONTROL void spu_mfcdma64(volatile void *ls, unsigned int eahi, unsigned int ealow, unsigned int size,
                                  unsigned int tagid, unsigned int cmd)
{
    const cgt_spu_dma dma = {
        .ls = ls, .eah = eahi, .eal = ealow, .size = size, .tag = tagid, .command = cmd, .has_eah = true};
    cgt_spu_dma_start("spu_mfcdma64", &dma);
}

CGT_SPU_CONTROL unsigned int spu_mfcstat(unsigned int type)
{
    spu_writech(MFC_WrTagUpdate, type);
    return spu_readch(MFC_RdTagStat);
}

/* ---- interrupts and events ---- */

CGT_SPU_CONTROL void cgt_spu_set_interrupts(const char *word, bool enabled)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->set_interrupts)
        cgt_spu_fail(word, CGT_SPU_NO_CHANNEL, "set_interrupts");
    host->set_interrupts(host->self, enabled);
}

#define spu_idisable() cgt_spu_set_interrupts("spu_idisable", false)
#define spu_ienable() cgt_spu_set_interrupts("spu_ienable", true)

/* Branch and set link if external data: the function is called if an event is pending, that is, if
 * SPU_RdEventStat has a count; _d and _e also disable and enable interrupts. */
CGT_SPU_CONTROL bool cgt_spu_event_waits(const char *word)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->channel_count)
        cgt_spu_fail(word, SPU_RdEventStat, "channel_count");
    return host->channel_count(host->self, SPU_RdEventStat) != 0;
}

CGT_SPU_CONTROL void spu_bisled(void (*function)(void))
{
    if (cgt_spu_event_waits("spu_bisled"))
        function();
}

CGT_SPU_CONTROL void spu_bisled_d(void (*function)(void))
{
    if (cgt_spu_event_waits("spu_bisled_d")) {
        cgt_spu_set_interrupts("spu_bisled_d", false);
        function();
    }
}

CGT_SPU_CONTROL void spu_bisled_e(void (*function)(void))
{
    if (cgt_spu_event_waits("spu_bisled_e")) {
        cgt_spu_set_interrupts("spu_bisled_e", true);
        function();
    }
}

/* ---- registers ---- */

CGT_SPU_CONTROL uint32_t cgt_spu_mfspr(unsigned number)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->read_register)
        cgt_spu_fail("spu_mfspr", CGT_SPU_NO_CHANNEL, "read_register");
    return host->read_register(host->self, number);
}

CGT_SPU_CONTROL void cgt_spu_mtspr(unsigned number, uint32_t value)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->write_register)
        cgt_spu_fail("spu_mtspr", CGT_SPU_NO_CHANNEL, "write_register");
    host->write_register(host->self, number, value);
}

#define spu_mfspr(number) cgt_spu_mfspr(number)
#define spu_mtspr(number, a) cgt_spu_mtspr(number, a)

/* The bits of the FPSCR that exist: rounding of doubles and divide by zero in 0xf00 of words 0 and 3, the flags of
 * doubles in 0x3f00 of words 1 and 2, the flags of floats in the lowest three of each (ISA 1.2, section 9.3). */
CGT_SPU_CONTROL vec_uint4 spu_mffpscr(void)
{
    cgt_spu_thread *const thread = cgt_spu_this_thread();
    uint32_t word[4] = {thread->fpscr[0], thread->fpscr[1], thread->fpscr[2], thread->fpscr[3]};
    if (thread->host && thread->host->read_fpscr)
        thread->host->read_fpscr(thread->host->self, word);
    return (vec_uint4){word[0], word[1], word[2], word[3]};
}

CGT_SPU_CONTROL void cgt_spu_mtfpscr(vec_uint4 value)
{
    static const uint32_t exists[4] = {0x00000f07, 0x00003f07, 0x00003f07, 0x00000f07};
    cgt_spu_thread *const thread = cgt_spu_this_thread();
    for (int i = 0; i < 4; i++)
        thread->fpscr[i] = value[i] & exists[i];
    if (thread->host && thread->host->write_fpscr)
        thread->host->write_fpscr(thread->host->self, thread->fpscr);
}

#define spu_mtfpscr(a) cgt_spu_mtfpscr((vec_uint4)(a)) /* any vector */

/* ---- synchronisation, stop ---- */

CGT_SPU_CONTROL void cgt_spu_synchronize(cgt_spu_barrier kind)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    __sync_synchronize(); /* the full barrier; gcc rejects C11's fence under -fsanitize=thread */
    if (host && host->synchronize)
        host->synchronize(host->self, kind);
}

#define spu_dsync() cgt_spu_synchronize(CGT_SPU_DSYNC)
#define spu_sync() cgt_spu_synchronize(CGT_SPU_SYNC)
#define spu_sync_c() cgt_spu_synchronize(CGT_SPU_SYNC_C)

CGT_SPU_CONTROL void cgt_spu_stop(unsigned type)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host || !host->stop)
        cgt_spu_fail("spu_stop", CGT_SPU_NO_CHANNEL, "stop");
    host->stop(host->self, type & 0x3fff);
}

#define spu_stop(type) cgt_spu_stop(type)

CGT_SPU_CONTROL void cgt_spu_halt_if(bool holds, const char *word)
{
    if (!holds)
        return;
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (host && host->halt) {
        host->halt(host->self);
    } else {
        fprintf(stderr, "%s: the comparison holds, halted\n", word);
        abort();
    }
}

CGT_SPU_CONTROL void cgt_spu_hcmpeq_s32(int a, int b) { cgt_spu_halt_if(a == b, "spu_hcmpeq"); }
CGT_SPU_CONTROL void cgt_spu_hcmpeq_u32(unsigned int a, unsigned int b) { cgt_spu_halt_if(a == b, "spu_hcmpeq"); }
CGT_SPU_CONTROL void cgt_spu_hcmpgt_s32(int a, int b) { cgt_spu_halt_if(a > b, "spu_hcmpgt"); }
CGT_SPU_CONTROL void cgt_spu_hcmpgt_u32(unsigned int a, unsigned int b) { cgt_spu_halt_if(a > b, "spu_hcmpgt"); }

/* the first operand selects */
#define spu_hcmpeq(a, b) _Generic((a), int : cgt_spu_hcmpeq_s32, unsigned int : cgt_spu_hcmpeq_u32)(a, b)
#define spu_hcmpgt(a, b) _Generic((a), int : cgt_spu_hcmpgt_s32, unsigned int : cgt_spu_hcmpgt_u32)(a, b)

/* an alignment hint, useful to the SPU's compiler only */
#define __align_hint(ptr, base, offset) ((void)(ptr), (void)(base), (void)(offset))

#endif
