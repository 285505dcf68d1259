/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * DMA, mailboxes, signals, events and the decrementer under the names that SPU programs use. On an SPU this is the
 * compiler's own header; elsewhere the words go to the host of the thread (spu_host.h). They differ from the SPU's in
 * three ways:
 *
 *   - Addresses in local storage (ls, and the lists of mfc_putl and the like) are pointers of the process and reach the
 *     host unchanged; on an SPU they have 32 bits.
 *   - Each operand is evaluated once.
 *   - The tag manager keeps its tags per thread, as an SPU has its own. */
#ifndef CGT_SPU_MFCIO_H
#define CGT_SPU_MFCIO_H

#if defined(__SPU__) && !defined(CGT_SPU_HOST)
#include_next <spu_mfcio.h>
#else

#include <stdint.h>

#include "spu_channels.h" /* kernels, which have no channels, get it here alone */
#include "spu_intrinsics.h"

/* ---- list elements ---- */

/* In memory: two words of the host's byte order, the first with notify in its highest bit and size in its lowest 15,
 * the second eal. The SPU's compiler fills a word from its highest bit, that of a little-endian host from its lowest,
 * so the order of the members is reversed there: use designated initialisers. */
__extension__ typedef struct mfc_list_element {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    uint64_t notify : 1; /* stall after this element until mfc_write_list_stall_ack */
    uint64_t reserved : 16;
    uint64_t size : 15; /* bytes of the transfer */
#else
    uint64_t size : 15;
    uint64_t reserved : 16;
    uint64_t notify : 1;
#endif
    uint64_t eal : 32;  /* lower half of the effective address */
} mfc_list_element_t;

/* ---- sizes ---- */

#define MFC_MIN_DMA_SIZE_SHIFT 4
#define MFC_MAX_DMA_SIZE_SHIFT 14
#define MFC_MIN_DMA_SIZE (1 << MFC_MIN_DMA_SIZE_SHIFT)
#define MFC_MAX_DMA_SIZE (1 << MFC_MAX_DMA_SIZE_SHIFT)
#define MFC_MIN_DMA_SIZE_MASK (MFC_MIN_DMA_SIZE - 1)
#define MFC_MAX_DMA_SIZE_MASK (MFC_MAX_DMA_SIZE - 1)
#define MFC_MIN_DMA_LIST_ELEMENTS 1
#define MFC_MAX_DMA_LIST_ELEMENTS 2048
#define MFC_MIN_DMA_LIST_SIZE (MFC_MIN_DMA_LIST_ELEMENTS << 3)
#define MFC_MAX_DMA_LIST_SIZE (MFC_MAX_DMA_LIST_ELEMENTS << 3)

/* ---- commands: base | modifiers ---- */

#define MFC_BARRIER_ENABLE 0x01
#define MFC_FENCE_ENABLE 0x02
#define MFC_LIST_ENABLE 0x04
#define MFC_RESULT_ENABLE 0x10

#define MFC_PUT_CMD 0x20
#define MFC_PUTB_CMD 0x21
#define MFC_PUTF_CMD 0x22
#define MFC_PUTL_CMD 0x24
#define MFC_PUTLB_CMD 0x25
#define MFC_PUTLF_CMD 0x26
#define MFC_PUTR_CMD 0x30
#define MFC_PUTRB_CMD 0x31
#define MFC_PUTRF_CMD 0x32
#define MFC_PUTRL_CMD 0x34
#define MFC_PUTRLB_CMD 0x35
#define MFC_PUTRLF_CMD 0x36

#define MFC_GET_CMD 0x40
#define MFC_GETB_CMD 0x41
#define MFC_GETF_CMD 0x42
#define MFC_GETL_CMD 0x44
#define MFC_GETLB_CMD 0x45
#define MFC_GETLF_CMD 0x46

/* caches of the processor element */
#define MFC_SDCRT_CMD 0x80
#define MFC_SDCRTST_CMD 0x81
#define MFC_SDCRZ_CMD 0x89
#define MFC_SDCRST_CMD 0x8d
#define MFC_SDCRF_CMD 0x8f

#define MFC_SNDSIG_CMD 0xa0
#define MFC_SNDSIGB_CMD 0xa1
#define MFC_SNDSIGF_CMD 0xa2

/* lines of 128 bytes, atomically */
#define MFC_PUTLLUC_CMD 0xb0
#define MFC_PUTLLC_CMD 0xb4
#define MFC_PUTQLLUC_CMD 0xb8
#define MFC_GETLLAR_CMD 0xd0

#define MFC_BARRIER_CMD 0xc0
#define MFC_EIEIO_CMD 0xc8
#define MFC_SYNC_CMD 0xcc

/* transfer class, replacement class, command */
#define MFC_CMD_WORD(tid, rid, cmd) (((tid) + 0u) << 24 | ((rid) + 0u) << 16 | ((cmd) + 0u))

/* ---- values of channels ---- */

/* SPU_RdEventStat, SPU_WrEventMask, SPU_WrEventAck */
#define MFC_TAG_STATUS_UPDATE_EVENT 0x00000001
#define MFC_LIST_STALL_NOTIFY_EVENT 0x00000002
#define MFC_COMMAND_QUEUE_AVAILABLE_EVENT 0x00000008
#define MFC_IN_MBOX_AVAILABLE_EVENT 0x00000010
#define MFC_DECREMENTER_EVENT 0x00000020
#define MFC_OUT_INTR_MBOX_AVAILABLE_EVENT 0x00000040
#define MFC_OUT_MBOX_AVAILABLE_EVENT 0x00000080
#define MFC_SIGNAL_NOTIFY_2_EVENT 0x00000100
#define MFC_SIGNAL_NOTIFY_1_EVENT 0x00000200
#define MFC_LLR_LOST_EVENT 0x00000400
#define MFC_PRIV_ATTN_EVENT 0x00000800
#define MFC_MULTI_SRC_SYNC_EVENT 0x00001000

/* MFC_WrTagUpdate */
#define MFC_TAG_UPDATE_IMMEDIATE 0
#define MFC_TAG_UPDATE_ANY 1
#define MFC_TAG_UPDATE_ALL 2

/* MFC_RdAtomicStat */
#define MFC_PUTLLC_STATUS 0x00000001
#define MFC_PUTLLUC_STATUS 0x00000002
#define MFC_GETLLAR_STATUS 0x00000004

/* ---- addresses ---- */

#define mfc_ea2h(ea) ((unsigned int)((unsigned long long)(ea) >> 32))
#define mfc_ea2l(ea) ((unsigned int)(unsigned long long)(ea))
#define mfc_hl2ea(high, low) ((unsigned long long)(unsigned int)(high) << 32 | (unsigned int)(low))
#define mfc_ceil128(v) (((v) + 127) & ~127)

/* ---- DMA ---- */

CGT_SPU_CONTROL void cgt_mfc_transfer(const char *word, volatile void *ls, unsigned long long ea, unsigned size,
                                      unsigned tag, unsigned command)
{
    cgt_spu_dma dma = {0};
    dma.ls = ls;
    dma.eah = mfc_ea2h(ea);
    dma.eal = mfc_ea2l(ea);
    dma.has_eah = true;
    dma.size = size;
    dma.tag = tag;
    dma.command = command;
    cgt_spu_dma_start(word, &dma);
}

/* the lower half of the effective address is in the elements */
CGT_SPU_CONTROL void cgt_mfc_list(const char *word, volatile void *ls, unsigned long long ea, uintptr_t list,
                                  unsigned size, unsigned tag, unsigned command)
{
    cgt_spu_dma dma = {0};
    dma.ls = ls;
    dma.list = (volatile void *)list;
    dma.eah = mfc_ea2h(ea);
    dma.eal = mfc_ea2l(list);
    dma.has_eah = true;
    dma.size = size;
    dma.tag = tag;
    dma.command = command;
    cgt_spu_dma_start(word, &dma);
}

/* commands that have neither addresses nor a size */
CGT_SPU_CONTROL void cgt_mfc_order(const char *word, unsigned tag, unsigned command)
{
    cgt_spu_dma dma = {0};
    dma.tag = tag;
    dma.command = command;
    cgt_spu_dma_start(word, &dma);
}

#define CGT_MFC(word, ls, ea, size, tag, tid, rid, cmd)                                                                \
    cgt_mfc_transfer(word, ls, (unsigned long long)(ea), size, tag, MFC_CMD_WORD(tid, rid, cmd))
#define CGT_MFC_LIST(word, ls, ea, lsa, size, tag, tid, rid, cmd)                                                      \
    cgt_mfc_list(word, ls, (unsigned long long)(ea), (uintptr_t)(lsa), size, tag, MFC_CMD_WORD(tid, rid, cmd))

#define mfc_put(ls, ea, size, tag, tid, rid) CGT_MFC("mfc_put", ls, ea, size, tag, tid, rid, MFC_PUT_CMD)
#define mfc_putf(ls, ea, size, tag, tid, rid) CGT_MFC("mfc_putf", ls, ea, size, tag, tid, rid, MFC_PUTF_CMD)
#define mfc_putb(ls, ea, size, tag, tid, rid) CGT_MFC("mfc_putb", ls, ea, size, tag, tid, rid, MFC_PUTB_CMD)
#define mfc_get(ls, ea, size, tag, tid, rid) CGT_MFC("mfc_get", ls, ea, size, tag, tid, rid, MFC_GET_CMD)
#define mfc_getf(ls, ea, size, tag, tid, rid) CGT_MFC("mfc_getf", ls, ea, size, tag, tid, rid, MFC_GETF_CMD)
#define mfc_getb(ls, ea, size, tag, tid, rid) CGT_MFC("mfc_getb", ls, ea, size, tag, tid, rid, MFC_GETB_CMD)

#define mfc_putl(ls, ea, lsa, size, tag, tid, rid)                                                                     \
    CGT_MFC_LIST("mfc_putl", ls, ea, lsa, size, tag, tid, rid, MFC_PUTL_CMD)
#define mfc_putlf(ls, ea, lsa, size, tag, tid, rid)                                                                    \
    CGT_MFC_LIST("mfc_putlf", ls, ea, lsa, size, tag, tid, rid, MFC_PUTLF_CMD)
#define mfc_putlb(ls, ea, lsa, size, tag, tid, rid)                                                                    \
    CGT_MFC_LIST("mfc_putlb", ls, ea, lsa, size, tag, tid, rid, MFC_PUTLB_CMD)
#define mfc_getl(ls, ea, lsa, size, tag, tid, rid)                                                                     \
    CGT_MFC_LIST("mfc_getl", ls, ea, lsa, size, tag, tid, rid, MFC_GETL_CMD)
#define mfc_getlf(ls, ea, lsa, size, tag, tid, rid)                                                                    \
    CGT_MFC_LIST("mfc_getlf", ls, ea, lsa, size, tag, tid, rid, MFC_GETLF_CMD)
#define mfc_getlb(ls, ea, lsa, size, tag, tid, rid)                                                                    \
    CGT_MFC_LIST("mfc_getlb", ls, ea, lsa, size, tag, tid, rid, MFC_GETLB_CMD)

#define mfc_getllar(ls, ea, tid, rid) CGT_MFC("mfc_getllar", ls, ea, 128, 0, tid, rid, MFC_GETLLAR_CMD)
#define mfc_putllc(ls, ea, tid, rid) CGT_MFC("mfc_putllc", ls, ea, 128, 0, tid, rid, MFC_PUTLLC_CMD)
#define mfc_putlluc(ls, ea, tid, rid) CGT_MFC("mfc_putlluc", ls, ea, 128, 0, tid, rid, MFC_PUTLLUC_CMD)
#define mfc_putqlluc(ls, ea, tag, tid, rid) CGT_MFC("mfc_putqlluc", ls, ea, 128, tag, tid, rid, MFC_PUTQLLUC_CMD)

#define mfc_sndsig(ls, ea, tag, tid, rid) CGT_MFC("mfc_sndsig", ls, ea, 4, tag, tid, rid, MFC_SNDSIG_CMD)
#define mfc_sndsigb(ls, ea, tag, tid, rid) CGT_MFC("mfc_sndsigb", ls, ea, 4, tag, tid, rid, MFC_SNDSIGB_CMD)
#define mfc_sndsigf(ls, ea, tag, tid, rid) CGT_MFC("mfc_sndsigf", ls, ea, 4, tag, tid, rid, MFC_SNDSIGF_CMD)
#define mfc_barrier(tag) cgt_mfc_order("mfc_barrier", tag, MFC_BARRIER_CMD)
#define mfc_eieio(tag, tid, rid) cgt_mfc_order("mfc_eieio", tag, MFC_CMD_WORD(tid, rid, MFC_EIEIO_CMD))
#define mfc_sync(tag) cgt_mfc_order("mfc_sync", tag, MFC_SYNC_CMD)

#define mfc_sdcrt(ea, size, tag, tid, rid) CGT_MFC("mfc_sdcrt", 0, ea, size, tag, tid, rid, MFC_SDCRT_CMD)
#define mfc_sdcrtst(ea, size, tag, tid, rid) CGT_MFC("mfc_sdcrtst", 0, ea, size, tag, tid, rid, MFC_SDCRTST_CMD)
#define mfc_sdcrz(ea, size, tag, tid, rid) CGT_MFC("mfc_sdcrz", 0, ea, size, tag, tid, rid, MFC_SDCRZ_CMD)
#define mfc_sdcrst(ea, size, tag, tid, rid) CGT_MFC("mfc_sdcrst", 0, ea, size, tag, tid, rid, MFC_SDCRST_CMD)
#define mfc_sdcrf(ea, size, tag, tid, rid) CGT_MFC("mfc_sdcrf", 0, ea, size, tag, tid, rid, MFC_SDCRF_CMD)

/* ---- command queue, tag groups, lists, atomic commands ---- */

#define mfc_stat_cmd_queue() spu_readchcnt(MFC_Cmd)

#define mfc_write_tag_mask(mask) spu_writech(MFC_WrTagMask, mask)
#define mfc_read_tag_mask() spu_readch(MFC_RdTagMask)

#define mfc_write_tag_update(ts) spu_writech(MFC_WrTagUpdate, ts)
#define mfc_write_tag_update_immediate() mfc_write_tag_update(MFC_TAG_UPDATE_IMMEDIATE)
#define mfc_write_tag_update_any() mfc_write_tag_update(MFC_TAG_UPDATE_ANY)
#define mfc_write_tag_update_all() mfc_write_tag_update(MFC_TAG_UPDATE_ALL)
#define mfc_stat_tag_update() spu_readchcnt(MFC_WrTagUpdate)

#define mfc_read_tag_status() spu_readch(MFC_RdTagStat)
#define mfc_read_tag_status_immediate() spu_mfcstat(MFC_TAG_UPDATE_IMMEDIATE)
#define mfc_read_tag_status_any() spu_mfcstat(MFC_TAG_UPDATE_ANY)
#define mfc_read_tag_status_all() spu_mfcstat(MFC_TAG_UPDATE_ALL)
#define mfc_stat_tag_status() spu_readchcnt(MFC_RdTagStat)

#define mfc_read_list_stall_status() spu_readch(MFC_RdListStallStat)
#define mfc_stat_list_stall_status() spu_readchcnt(MFC_RdListStallStat)
#define mfc_write_list_stall_ack(tag) spu_writech(MFC_WrListStallAck, tag)

#define mfc_read_atomic_status() spu_readch(MFC_RdAtomicStat)
#define mfc_stat_atomic_status() spu_readchcnt(MFC_RdAtomicStat)

#define mfc_write_multi_src_sync_request() spu_writech(MFC_WrMSSyncReq, 0)
#define mfc_stat_multi_src_sync_request() spu_readchcnt(MFC_WrMSSyncReq)

/* ---- signals, mailboxes, decrementer, events, machine state ---- */

#define spu_read_signal1() spu_readch(SPU_RdSigNotify1)
#define spu_stat_signal1() spu_readchcnt(SPU_RdSigNotify1)
#define spu_read_signal2() spu_readch(SPU_RdSigNotify2)
#define spu_stat_signal2() spu_readchcnt(SPU_RdSigNotify2)

#define spu_read_in_mbox() spu_readch(SPU_RdInMbox)
#define spu_stat_in_mbox() spu_readchcnt(SPU_RdInMbox)
#define spu_write_out_mbox(a) spu_writech(SPU_WrOutMbox, a)
#define spu_stat_out_mbox() spu_readchcnt(SPU_WrOutMbox)
#define spu_write_out_intr_mbox(a) spu_writech(SPU_WrOutIntrMbox, a)
#define spu_stat_out_intr_mbox() spu_readchcnt(SPU_WrOutIntrMbox)

#define spu_read_decrementer() spu_readch(SPU_RdDec)
#define spu_write_decrementer(count) spu_writech(SPU_WrDec, count)

#define spu_read_event_status() spu_readch(SPU_RdEventStat)
#define spu_stat_event_status() spu_readchcnt(SPU_RdEventStat)
#define spu_write_event_mask(mask) spu_writech(SPU_WrEventMask, mask)
#define spu_write_event_ack(ack) spu_writech(SPU_WrEventAck, ack)
#define spu_read_event_mask() spu_readch(SPU_RdEventMask)

#define spu_read_machine_status() spu_readch(SPU_RdMachStat)
#define spu_write_srr0(srr0) spu_writech(SPU_WrSRR0, srr0)
#define spu_read_srr0() spu_readch(SPU_RdSRR0)

/* ---- critical sections ---- */

/* interrupts are off between begin and end in programs that define SPU_MFCIO_INTERRUPT_SAFE */

CGT_SPU_CONTROL unsigned int mfc_begin_critical_section(void)
{
#ifdef SPU_MFCIO_INTERRUPT_SAFE
    const unsigned int status = spu_read_machine_status();
    spu_idisable();
    return status;
#else
    return 0;
#endif
}

CGT_SPU_CONTROL void mfc_end_critical_section(unsigned int status)
{
#ifdef SPU_MFCIO_INTERRUPT_SAFE
    if (status & 1)
        spu_ienable();
#else
    (void)status;
#endif
}

/* ---- tag manager: which of the 32 tags are in use ---- */

#define MFC_TAG_INVALID 0xFFFFFFFF
#define MFC_TAG_VALID 0x00000000

/* count bits from bit first on; both at most 32 */
CGT_SPU_CONTROL uint32_t cgt_mfc_tag_bits(unsigned first, unsigned count)
{
    return (uint32_t)(((UINT64_C(1) << count) - 1) << first);
}

/* Reserves the lowest run of count free tags and returns its first, or MFC_TAG_INVALID where there is none. */
CGT_SPU_CONTROL unsigned int cgt_mfc_reserve_tags(unsigned int count)
{
    cgt_spu_thread *const thread = cgt_spu_this_thread();
    const unsigned room = count > 0 ? count : 1; /* an empty run begins at a free tag, too */
    if (room > 32)
        return MFC_TAG_INVALID;
    for (unsigned first = 0; first + room <= 32; first++) {
        if (!(thread->reserved_tags & cgt_mfc_tag_bits(first, room))) {
            thread->reserved_tags |= cgt_mfc_tag_bits(first, count);
            return first;
        }
    }
    return MFC_TAG_INVALID;
}

/* Releases tags. Returns MFC_TAG_INVALID and does nothing where they were not all reserved. */
CGT_SPU_CONTROL unsigned int cgt_mfc_release_tags(unsigned int first, unsigned int count)
{
    cgt_spu_thread *const thread = cgt_spu_this_thread();
    if (first > 31 || count > 32 - first)
        return MFC_TAG_INVALID;
    const uint32_t tags = cgt_mfc_tag_bits(first, count);
    if ((thread->reserved_tags & tags) != tags)
        return MFC_TAG_INVALID;
    thread->reserved_tags &= ~tags;
    return MFC_TAG_VALID;
}

#define mfc_tag_reserve() cgt_mfc_reserve_tags(1)
#define mfc_tag_release(tag) cgt_mfc_release_tags(tag, 1)
#define mfc_multi_tag_reserve(count) cgt_mfc_reserve_tags(count)
#define mfc_multi_tag_release(tag, count) cgt_mfc_release_tags(tag, count)

#endif
#endif
