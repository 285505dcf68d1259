/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Stands in for the machine around an SPU: channels, DMA, interrupts, stop. SPU code compiled for another processor
 * reaches it through the words of spu_channels.h and spu_mfcio.h. An emulated Cell fills a
 * cgt_spu_host and installs it in each thread that runs SPU code:
 *
 *   static const cgt_spu_host host = {.self = &machine, .read_channel = read, .write_channel = write, ...};
 *   const cgt_spu_host *before = cgt_spu_set_host(&host);
 *   run_the_program();
 *   cgt_spu_set_host(before);
 *
 * A word whose member is missing prints a message to stderr and aborts, unless the member's comment gives a default.
 *
 * No library is needed. The state of a thread is one variable that all source files of a program share; only object
 * files that use one of these words contain its symbol, a weak one. On systems other than ELF with native thread-local
 * storage, each source file has a state of its own: install the host in every file that uses the words. */
#ifndef CGT_SPU_HOST_H
#define CGT_SPU_HOST_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One MFC command, from spu_mfcdma32, spu_mfcdma64 and the mfc_* words. On an SPU it goes through the 32-bit channels
 * MFC_LSA to MFC_Cmd. Here local storage is memory of the process, so addresses are whole pointers. */
typedef struct cgt_spu_dma {
    volatile void *ls;   /* address in local storage */
    volatile void *list; /* of the first element, from mfc_putl to mfc_getlb; NULL from any other word */
    uint32_t eah, eal;   /* effective address; with a list eal is the lower half of the list's address */
    uint32_t size;       /* bytes of the transfer or of the list */
    uint32_t tag;
    uint32_t command; /* as MFC_CMD_WORD makes it */
    bool has_eah;     /* false from spu_mfcdma32, which does not write MFC_EAH */
} cgt_spu_dma;

typedef enum cgt_spu_barrier { CGT_SPU_DSYNC, CGT_SPU_SYNC, CGT_SPU_SYNC_C } cgt_spu_barrier;

/* Quadwords are four words, element 0 first. */
typedef struct cgt_spu_host {
    void *self; /* passed to each function */
    uint32_t (*read_channel)(void *self, unsigned channel);
    void (*write_channel)(void *self, unsigned channel, uint32_t value);
    uint32_t (*channel_count)(void *self, unsigned channel);
    /* NULL: read_channel and write_channel with element 0, zero in the others, as the Cell's channels are 32 bits */
    void (*read_channel_quadword)(void *self, unsigned channel, uint32_t value[4]);
    void (*write_channel_quadword)(void *self, unsigned channel, const uint32_t value[4]);
    /* NULL: write_channel in the SPU's order, MFC_LSA, MFC_EAH if it has one, MFC_EAL, MFC_Size, MFC_TagID, MFC_Cmd;
     * addresses beyond 32 bits abort */
    void (*dma)(void *self, const cgt_spu_dma *command);
    void (*set_interrupts)(void *self, bool enabled);
    uint32_t (*read_register)(void *self, unsigned number); /* special-purpose registers */
    void (*write_register)(void *self, unsigned number, uint32_t value);
    /* NULL: a register of the thread that reads back what was written to the bits that exist */
    void (*read_fpscr)(void *self, uint32_t value[4]);
    void (*write_fpscr)(void *self, const uint32_t value[4]);
    void (*synchronize)(void *self, cgt_spu_barrier kind); /* after a memory barrier; NULL: the barrier alone */
    void (*stop)(void *self, unsigned type);               /* 14 bits; the program goes on when it returns */
    void (*halt)(void *self);                              /* of spu_hcmpeq, spu_hcmpgt; NULL: a message and abort */
} cgt_spu_host;

/* ---- the state of a thread ---- */

typedef struct cgt_spu_thread {
    const cgt_spu_host *host; /* NULL: none */
    uint32_t fpscr[4];
    uint32_t reserved_tags; /* of the tag manager of spu_mfcio.h: bit n is set where tag n is reserved */
} cgt_spu_thread;

#if defined(__ELF__) && (defined(__linux__) || defined(__FreeBSD__)) && !defined(__ANDROID__)
extern __attribute__((visibility("default"))) __thread cgt_spu_thread cgt_spu_thread_state;

/* C has no definition that all source files share and that is emitted only where it is used. So the inline function
 * carries the definition: 32 zero bytes in a COMDAT section of which the linker keeps one, like a C++ inline variable.
 * Where the function is inlined more than once, .ifndef keeps the first definition. */
#define CGT_SPU_THREAD_BYTES 32
__attribute__((unused)) static inline cgt_spu_thread *cgt_spu_this_thread(void)
{
    __asm__(".ifndef cgt_spu_thread_state\n\t"
            ".pushsection .tbss.cgt_spu_thread_state,\"awTG\",%nobits,cgt_spu_thread_state,comdat\n\t"
            ".weak cgt_spu_thread_state\n\t"
            ".type cgt_spu_thread_state,%tls_object\n\t"
            ".size cgt_spu_thread_state,32\n\t"
            ".balign 16\n"
            "cgt_spu_thread_state:\n\t"
            ".zero 32\n\t"
            ".popsection\n\t"
            ".endif");
    return &cgt_spu_thread_state;
}
/* a compile error if the state outgrows the bytes above */
typedef char cgt_spu_thread_fits[sizeof(cgt_spu_thread) <= CGT_SPU_THREAD_BYTES ? 1 : -1];
#else
static __thread __attribute__((unused)) cgt_spu_thread cgt_spu_thread_state;
__attribute__((unused)) static inline cgt_spu_thread *cgt_spu_this_thread(void) { return &cgt_spu_thread_state; }
#endif

/* Sets the host of the calling thread, or removes it with NULL; returns the previous one. The host must stay valid
 * until it is replaced or the thread ends. New threads have none. */
__attribute__((unused)) static inline const cgt_spu_host *cgt_spu_set_host(const cgt_spu_host *host)
{
    cgt_spu_thread *const thread = cgt_spu_this_thread();
    const cgt_spu_host *const before = thread->host;
    thread->host = host;
    return before;
}
__attribute__((unused)) static inline const cgt_spu_host *cgt_spu_get_host(void) { return cgt_spu_this_thread()->host; }

/* ---- failure ---- */

/* NULL for a number that is no channel of the Cell */
__attribute__((unused)) static inline const char *cgt_spu_channel_name(unsigned channel)
{
    /* clang-format off */
    static const char *const name[] = {
        "SPU_RdEventStat", "SPU_WrEventMask", "SPU_WrEventAck", "SPU_RdSigNotify1", "SPU_RdSigNotify2", NULL, NULL,
        "SPU_WrDec", "SPU_RdDec", "MFC_WrMSSyncReq", NULL, "SPU_RdEventMask", "MFC_RdTagMask", "SPU_RdMachStat",
        "SPU_WrSRR0", "SPU_RdSRR0", "MFC_LSA", "MFC_EAH", "MFC_EAL", "MFC_Size", "MFC_TagID", "MFC_Cmd",
        "MFC_WrTagMask", "MFC_WrTagUpdate", "MFC_RdTagStat", "MFC_RdListStallStat", "MFC_WrListStallAck",
        "MFC_RdAtomicStat", "SPU_WrOutMbox", "SPU_RdInMbox", "SPU_WrOutIntrMbox",
    };
    /* clang-format on */
    return channel < sizeof name / sizeof name[0] ? name[channel] : NULL;
}

#define CGT_SPU_NO_CHANNEL 0xffffffffu

/* Prints which word cannot work and why, and aborts. */
__attribute__((noreturn, cold, unused)) static inline void cgt_spu_fail(const char *word, unsigned channel,
                                                                        const char *member)
{
    char number[32] = "";
    const char *name = number;
    if (channel != CGT_SPU_NO_CHANNEL) {
        name = cgt_spu_channel_name(channel);
        if (!name) {
            snprintf(number, sizeof number, "channel %u", channel);
            name = number;
        }
    }
    if (cgt_spu_get_host()) {
        fprintf(stderr, "%s(%s): the cgt_spu_host of this thread has no member %s\n", word, name, member);
    } else {
        fprintf(stderr,
                "%s(%s): this processor is no SPU and nothing stands in for one in this thread; "
                "install a cgt_spu_host by cgt_spu_set_host (spu_host.h)\n",
                word, name);
    }
    abort();
}

#ifdef __cplusplus
}
#endif

#endif
