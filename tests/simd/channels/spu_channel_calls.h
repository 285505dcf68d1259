/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every constant and every function macro of spu_mfcio.h with its required result, in literal values: the numbers of
 * the Cell's channels and MFC commands as the SPU compiler's headers of GCC 9 define them. It includes nothing and uses
 * only the names, so that the SPU's own compiler reads it too. */
#ifndef SPU_CHANNEL_CALLS_H
#define SPU_CHANNEL_CALLS_H

/* clang-format off */

/* X(name, value): 28 channels */
#define SPU_CHANNEL_NUMBERS(X)                                                                                         \
    X(SPU_RdEventStat, 0) X(SPU_WrEventMask, 1) X(SPU_WrEventAck, 2) X(SPU_RdSigNotify1, 3) X(SPU_RdSigNotify2, 4)     \
    X(SPU_WrDec, 7) X(SPU_RdDec, 8) X(MFC_WrMSSyncReq, 9) X(SPU_RdEventMask, 11) X(MFC_RdTagMask, 12)                  \
    X(SPU_RdMachStat, 13) X(SPU_WrSRR0, 14) X(SPU_RdSRR0, 15) X(MFC_LSA, 16) X(MFC_EAH, 17) X(MFC_EAL, 18)             \
    X(MFC_Size, 19) X(MFC_TagID, 20) X(MFC_Cmd, 21) X(MFC_WrTagMask, 22) X(MFC_WrTagUpdate, 23) X(MFC_RdTagStat, 24)   \
    X(MFC_RdListStallStat, 25) X(MFC_WrListStallAck, 26) X(MFC_RdAtomicStat, 27) X(SPU_WrOutMbox, 28)                  \
    X(SPU_RdInMbox, 29) X(SPU_WrOutIntrMbox, 30)

/* X(name, value): 7 classes of doubles */
#define SPU_SPECIAL_VALUES(X)                                                                                          \
    X(SPU_SV_NEG_DENORM, 1) X(SPU_SV_POS_DENORM, 2) X(SPU_SV_NEG_ZERO, 4) X(SPU_SV_POS_ZERO, 8)                        \
    X(SPU_SV_NEG_INFINITY, 16) X(SPU_SV_POS_INFINITY, 32) X(SPU_SV_NAN, 64)

/* X(name, value): the constants of spu_mfcio.h */
#define SPU_MFCIO_CONSTANTS(X)                                                                                         \
    X(MFC_MIN_DMA_SIZE_SHIFT, 4) X(MFC_MAX_DMA_SIZE_SHIFT, 14) X(MFC_MIN_DMA_SIZE, 16) X(MFC_MAX_DMA_SIZE, 16384)      \
    X(MFC_MIN_DMA_SIZE_MASK, 15) X(MFC_MAX_DMA_SIZE_MASK, 16383) X(MFC_MIN_DMA_LIST_ELEMENTS, 1)                       \
    X(MFC_MAX_DMA_LIST_ELEMENTS, 2048) X(MFC_MIN_DMA_LIST_SIZE, 8) X(MFC_MAX_DMA_LIST_SIZE, 16384)                     \
    X(MFC_BARRIER_ENABLE, 0x01) X(MFC_FENCE_ENABLE, 0x02) X(MFC_LIST_ENABLE, 0x04) X(MFC_RESULT_ENABLE, 0x10)          \
    X(MFC_PUT_CMD, 0x20) X(MFC_PUTB_CMD, 0x21) X(MFC_PUTF_CMD, 0x22)                                                   \
    X(MFC_PUTL_CMD, 0x24) X(MFC_PUTLB_CMD, 0x25) X(MFC_PUTLF_CMD, 0x26)                                                \
    X(MFC_PUTR_CMD, 0x30) X(MFC_PUTRB_CMD, 0x31) X(MFC_PUTRF_CMD, 0x32)                                                \
    X(MFC_PUTRL_CMD, 0x34) X(MFC_PUTRLB_CMD, 0x35) X(MFC_PUTRLF_CMD, 0x36)                                             \
    X(MFC_GET_CMD, 0x40) X(MFC_GETB_CMD, 0x41) X(MFC_GETF_CMD, 0x42)                                                   \
    X(MFC_GETL_CMD, 0x44) X(MFC_GETLB_CMD, 0x45) X(MFC_GETLF_CMD, 0x46)                                                \
    X(MFC_SDCRT_CMD, 0x80) X(MFC_SDCRTST_CMD, 0x81) X(MFC_SDCRZ_CMD, 0x89) X(MFC_SDCRST_CMD, 0x8d)                     \
    X(MFC_SDCRF_CMD, 0x8f) X(MFC_SNDSIG_CMD, 0xa0) X(MFC_SNDSIGB_CMD, 0xa1) X(MFC_SNDSIGF_CMD, 0xa2)                   \
    X(MFC_PUTLLUC_CMD, 0xb0) X(MFC_PUTLLC_CMD, 0xb4) X(MFC_PUTQLLUC_CMD, 0xb8) X(MFC_GETLLAR_CMD, 0xd0)                \
    X(MFC_BARRIER_CMD, 0xc0) X(MFC_EIEIO_CMD, 0xc8) X(MFC_SYNC_CMD, 0xcc)                                              \
    X(MFC_TAG_STATUS_UPDATE_EVENT, 0x1) X(MFC_LIST_STALL_NOTIFY_EVENT, 0x2) X(MFC_COMMAND_QUEUE_AVAILABLE_EVENT, 0x8)  \
    X(MFC_IN_MBOX_AVAILABLE_EVENT, 0x10) X(MFC_DECREMENTER_EVENT, 0x20) X(MFC_OUT_INTR_MBOX_AVAILABLE_EVENT, 0x40)     \
    X(MFC_OUT_MBOX_AVAILABLE_EVENT, 0x80) X(MFC_SIGNAL_NOTIFY_2_EVENT, 0x100) X(MFC_SIGNAL_NOTIFY_1_EVENT, 0x200)      \
    X(MFC_LLR_LOST_EVENT, 0x400) X(MFC_PRIV_ATTN_EVENT, 0x800) X(MFC_MULTI_SRC_SYNC_EVENT, 0x1000)                     \
    X(MFC_TAG_UPDATE_IMMEDIATE, 0) X(MFC_TAG_UPDATE_ANY, 1) X(MFC_TAG_UPDATE_ALL, 2)                                   \
    X(MFC_PUTLLC_STATUS, 1) X(MFC_PUTLLUC_STATUS, 2) X(MFC_GETLLAR_STATUS, 4)                                          \
    X(MFC_TAG_INVALID, 0xffffffffu) X(MFC_TAG_VALID, 0)                                                                \
    X(MFC_CMD_WORD(0, 0, 0), 0) X(MFC_CMD_WORD(1, 2, 0x46), 0x01020046) X(MFC_CMD_WORD(0x7f, 0xff, 0xd0), 0x7fff00d0)  \
    X(mfc_ea2h(0x0123456789abcdefull), 0x01234567u) X(mfc_ea2l(0x0123456789abcdefull), 0x89abcdefu)                    \
    X(mfc_ea2h(0x89abcdefu), 0u) X(mfc_ea2l(0x89abcdefu), 0x89abcdefu)                                                 \
    X(mfc_ceil128(0), 0) X(mfc_ceil128(1), 128) X(mfc_ceil128(128), 128) X(mfc_ceil128(129u), 256u)

/* X(name, call, channel): one read */
#define SPU_CHANNEL_READS(X)                                                                                           \
    X(r0, mfc_read_tag_mask(), 12) X(r1, mfc_read_tag_status(), 24) X(r2, mfc_read_list_stall_status(), 25)            \
    X(r3, mfc_read_atomic_status(), 27) X(r4, spu_read_signal1(), 3) X(r5, spu_read_signal2(), 4)                      \
    X(r6, spu_read_in_mbox(), 29) X(r7, spu_read_decrementer(), 8) X(r8, spu_read_event_status(), 0)                   \
    X(r9, spu_read_event_mask(), 11) X(r10, spu_read_machine_status(), 13) X(r11, spu_read_srr0(), 15)                 \
    X(r12, spu_readch(SPU_RdInMbox), 29) X(r13, spu_readch(74), 74)

/* X(name, call, channel): one count */
#define SPU_CHANNEL_COUNTS(X)                                                                                          \
    X(c0, mfc_stat_cmd_queue(), 21) X(c1, mfc_stat_tag_update(), 23) X(c2, mfc_stat_tag_status(), 24)                  \
    X(c3, mfc_stat_list_stall_status(), 25) X(c4, mfc_stat_atomic_status(), 27)                                        \
    X(c5, mfc_stat_multi_src_sync_request(), 9) X(c6, spu_stat_signal1(), 3) X(c7, spu_stat_signal2(), 4)              \
    X(c8, spu_stat_in_mbox(), 29) X(c9, spu_stat_out_mbox(), 28) X(c10, spu_stat_out_intr_mbox(), 30)                  \
    X(c11, spu_stat_event_status(), 0) X(c12, spu_readchcnt(MFC_Cmd), 21)

/* X(name, call, channel, value): one write */
#define SPU_CHANNEL_WRITES(X)                                                                                          \
    X(w0, mfc_write_tag_mask(0x80000001), 22, 0x80000001u) X(w1, mfc_write_tag_update(7), 23, 7u)                      \
    X(w2, mfc_write_tag_update_immediate(), 23, 0u) X(w3, mfc_write_tag_update_any(), 23, 1u)                          \
    X(w4, mfc_write_tag_update_all(), 23, 2u) X(w5, mfc_write_list_stall_ack(9), 26, 9u)                               \
    X(w6, mfc_write_multi_src_sync_request(), 9, 0u) X(w7, spu_write_out_mbox(0xdeadbeef), 28, 0xdeadbeefu)            \
    X(w8, spu_write_out_intr_mbox(-1), 30, 0xffffffffu) X(w9, spu_write_decrementer(0x7fffffff), 7, 0x7fffffffu)       \
    X(w10, spu_write_event_mask(0x20), 1, 0x20u) X(w11, spu_write_event_ack(0x10), 2, 0x10u)                           \
    X(w12, spu_write_srr0(0x3fffc), 14, 0x3fffcu) X(w13, spu_writech(MFC_LSA, 0x12345678), 16, 0x12345678u)

/* X(name, call, update): a write of the tag update, then a read of the tag status */
#define SPU_CHANNEL_STATUSES(X)                                                                                        \
    X(s0, mfc_read_tag_status_immediate(), 0u) X(s1, mfc_read_tag_status_any(), 1u)                                    \
    X(s2, mfc_read_tag_status_all(), 2u) X(s3, spu_mfcstat(MFC_TAG_UPDATE_ALL), 2u) X(s4, spu_mfcstat(5), 5u)

/* X(name, call, lsa, eah, eal, size, tag, command): one MFC command. The calls use LS, EA and LIST, which the including
 * file defines: two local addresses, of which NONE is neither, and an effective address of 64 bits. */
#define SPU_MFC_CALLS(X, LS, EA, LIST, NONE, EAH, EAL, LISTL)                                                          \
    X(d0, mfc_put(LS, EA, 128, 3, 1, 2), LS, EAH, EAL, 128, 3, 0x01020020)                                             \
    X(d1, mfc_putf(LS, EA, 16, 31, 0, 0), LS, EAH, EAL, 16, 31, 0x22)                                                  \
    X(d2, mfc_putb(LS, EA, 1, 0, 255, 0), LS, EAH, EAL, 1, 0, 0xff000021)                                              \
    X(d3, mfc_get(LS, EA, 16384, 7, 0, 0), LS, EAH, EAL, 16384, 7, 0x40)                                               \
    X(d4, mfc_getf(LS, EA, 8, 8, 0, 255), LS, EAH, EAL, 8, 8, 0x00ff0042)                                              \
    X(d5, mfc_getb(LS, EA, 4, 9, 3, 4), LS, EAH, EAL, 4, 9, 0x03040041)                                                \
    X(d6, mfc_putl(LS, EA, LIST, 64, 1, 1, 1), LS, EAH, LISTL, 64, 1, 0x01010024)                                      \
    X(d7, mfc_putlf(LS, EA, LIST, 8, 2, 0, 0), LS, EAH, LISTL, 8, 2, 0x26)                                             \
    X(d8, mfc_putlb(LS, EA, LIST, 16, 3, 0, 0), LS, EAH, LISTL, 16, 3, 0x25)                                           \
    X(d9, mfc_getl(LS, EA, LIST, 16384, 4, 5, 6), LS, EAH, LISTL, 16384, 4, 0x05060044)                                \
    X(d10, mfc_getlf(LS, EA, LIST, 32, 5, 0, 0), LS, EAH, LISTL, 32, 5, 0x46)                                          \
    X(d11, mfc_getlb(LS, EA, LIST, 24, 6, 0, 0), LS, EAH, LISTL, 24, 6, 0x45)                                          \
    X(d12, mfc_getllar(LS, EA, 0, 0), LS, EAH, EAL, 128, 0, 0xd0)                                                      \
    X(d13, mfc_putllc(LS, EA, 1, 0), LS, EAH, EAL, 128, 0, 0x010000b4)                                                 \
    X(d14, mfc_putlluc(LS, EA, 0, 1), LS, EAH, EAL, 128, 0, 0x000100b0)                                                \
    X(d15, mfc_putqlluc(LS, EA, 12, 0, 0), LS, EAH, EAL, 128, 12, 0xb8)                                                \
    X(d16, mfc_sndsig(LS, EA, 13, 0, 0), LS, EAH, EAL, 4, 13, 0xa0)                                                    \
    X(d17, mfc_sndsigb(LS, EA, 14, 0, 0), LS, EAH, EAL, 4, 14, 0xa1)                                                   \
    X(d18, mfc_sndsigf(LS, EA, 15, 2, 2), LS, EAH, EAL, 4, 15, 0x020200a2)                                             \
    X(d19, mfc_sdcrt(EA, 4096, 16, 0, 0), NONE, EAH, EAL, 4096, 16, 0x80)                                              \
    X(d20, mfc_sdcrtst(EA, 4096, 17, 0, 0), NONE, EAH, EAL, 4096, 17, 0x81)                                            \
    X(d21, mfc_sdcrz(EA, 4096, 18, 0, 0), NONE, EAH, EAL, 4096, 18, 0x89)                                              \
    X(d22, mfc_sdcrst(EA, 4096, 19, 0, 0), NONE, EAH, EAL, 4096, 19, 0x8d)                                             \
    X(d23, mfc_sdcrf(EA, 4096, 20, 1, 1), NONE, EAH, EAL, 4096, 20, 0x0101008f)                                        \
    X(d24, spu_mfcdma64(LS, EAH, EAL, 48, 21, 0x61), LS, EAH, EAL, 48, 21, 0x61)

/* X(name, call, lsa, eal, size, tag, command): commands without the upper half of an effective address */
#define SPU_MFC_CALLS_32(X, LS, EAL, NONE)                                                                             \
    X(e0, mfc_barrier(22), NONE, 0, 0, 22, 0xc0)                                                                       \
    X(e1, mfc_eieio(23, 1, 2), NONE, 0, 0, 23, 0x010200c8)                                                             \
    X(e2, mfc_sync(24), NONE, 0, 0, 24, 0xcc)                                                                          \
    X(e3, spu_mfcdma32(LS, EAL, 80, 25, 0x40), LS, EAL, 80, 25, 0x40)

/* clang-format on */

#endif
