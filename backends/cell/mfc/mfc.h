/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A memory flow controller: what stands between an SPU and the rest of a Cell. It has the SPU's channels 0 to 30: DMA
 * commands in a queue of 16, with lists, fences, barriers and tag groups; atomic lines; mailboxes; signals; events; the
 * decrementer. The same code serves a simulated SPU and an SPE program compiled for the host.
 *
 * Sources: Cell Broadband Engine Architecture and the SDK 3.0 texts that describe its channels and commands.
 * Departures:
 *   - A broken rule ends the program with a sentence. Hardware raises an interrupt, transfers something else (a local
 *     address wraps at 256 KB), or stalls for ever.
 *   - The SPU's own queue alone: there is no proxy queue, in which a PPE gives commands.
 *   - SPU_RdMachStat is 0, and MFC_WrMSSyncReq has nothing to wait for.
 *   - A command's bytes move all at once, when it is finished.
 *
 * Order: commands wait where a fence or barrier says so, and begin in the order of the queue. What is not ordered by
 * fence, barrier or wait may finish in any order; cgt_mfc_timing.jitter makes use of it.
 *
 * Time: each call has the cycle of the access. It never goes back. What is due by then happens first.
 *
 * Threads: one at a time for all MFCs of a map. */
#ifndef CGT_MFC_H
#define CGT_MFC_H

#include <stdio.h>

#include "cell/mfc/ea_map.h"
#include "cell/spu/channels.h"

#define CGT_LOCAL_STORE_BYTES 262144
#define CGT_MFC_QUEUE 16
#define CGT_IN_MAILBOX 4
#define CGT_MFC_MESSAGE_BYTES 256
#define CGT_NO_CYCLE UINT64_MAX

/* ---- settings ---- */

/* The byte order of a local store. */
typedef enum cgt_store_order {
    CGT_STORE_BIG_ENDIAN, /* the SPU's: a simulated one */
    CGT_STORE_HOST        /* elements as the host has them: a program compiled for it */
} cgt_store_order;

typedef struct cgt_local_store {
    uint8_t *bytes;
    uint32_t size; /* a multiple of 16, at most CGT_LOCAL_STORE_BYTES */
    cgt_store_order order;
    void (*written)(void *user, uint32_t lsa, uint32_t size); /* told after each change by DMA; NULL: nobody */
    void *user;
} cgt_local_store;

/* The model of time, in cycles of the SPU. The defaults and their sources are in mfc_timing.c. */
typedef struct cgt_mfc_timing {
    uint32_t latency;                /* from a transfer's last bus cycle to its end */
    uint32_t bytes_per_cycle;        /* of one SPE; at least 1 */
    uint32_t memory_bytes_per_cycle; /* of the port that all SPEs share; 0: no limit */
    uint32_t least_bytes;            /* what the shortest transfer occupies the bus for */
    uint32_t atomic_latency;         /* of getllar, putllc, putlluc */
    uint32_t signal_latency;         /* of sndsig */
    uint32_t decrementer_cycles;     /* per step of the decrementer; at least 1 */
    uint32_t jitter; /* a pseudo-random delay of up to so many cycles for each command: unordered commands overtake */
    uint32_t jitter_seed; /* each seed gives another order, the same one each time */
} cgt_mfc_timing;

extern const cgt_mfc_timing cgt_mfc_default_timing;

/* What a program may break. Each has a name, which begins the message (cgt_mfc_rule_name). */
typedef enum cgt_mfc_rule {
    CGT_RULE_NONE,
    CGT_RULE_COMMAND,          /* no such MFC command */
    CGT_RULE_TAG,              /* above 31 */
    CGT_RULE_SIZE,             /* none of 1, 2, 4, 8, 16 n up to 16 KB */
    CGT_RULE_ALIGNMENT,        /* an address is no multiple of the size, or of 16 from 16 bytes on; of 128 for lines */
    CGT_RULE_LOW_BITS,         /* local and effective address differ in their lowest four bits */
    CGT_RULE_LOCAL_STORE,      /* beyond the end of local store, or outside of it */
    CGT_RULE_ADDRESS,          /* no memory at this effective address */
    CGT_RULE_BOUNDS,           /* beyond the end of the region */
    CGT_RULE_READ_ONLY,        /* a write to memory that is not writable */
    CGT_RULE_UNIT,             /* a part of an element of the region */
    CGT_RULE_REGISTER,         /* a transfer to a signal register, or a signal to what is none */
    CGT_RULE_LIST_SIZE,        /* of a list: no multiple of 8 from 8 to 16 KB */
    CGT_RULE_LIST_ADDRESS,     /* of a list: no multiple of 8, or beyond local store */
    CGT_RULE_LIST_CROSSING,    /* an element crosses a multiple of 4 GB */
    CGT_RULE_LIST_ACKNOWLEDGE, /* no list of this tag has stalled */
    CGT_RULE_TAG_UPDATE,       /* MFC_WrTagUpdate: none of 0, 1, 2 */
    CGT_RULE_TAG_STATUS,       /* MFC_RdTagStat without MFC_WrTagUpdate before it */
    CGT_RULE_ATOMIC_STATUS,    /* MFC_RdAtomicStat without an atomic command before it */
    CGT_RULE_CHANNEL,          /* no such channel, or it has the other direction */
    CGT_RULE_HALT,             /* the program halted: spu_hcmpeq, spu_hcmpgt, an instruction that failed */
    CGT_RULE_BUFFER,           /* a write to what a put may still send; see cgt_mfc_watch_buffers */
    CGT_RULE_WORD,             /* a word that no MFC carries out: interrupts, special registers */
    CGT_RULE_DEADLOCK,         /* all wait for one another */
    CGT_RULES
} cgt_mfc_rule;

const char *cgt_mfc_rule_name(cgt_mfc_rule rule);

/* ---- what it tells ---- */

/* One command, when it has finished; a list with stalls gives one record for each part. */
typedef struct cgt_mfc_record {
    uint64_t issued, started, finished; /* cycles */
    unsigned spe;
    const char *command; /* "mfc_get" ... */
    uint32_t tag, lsa;
    uint64_t ea;       /* of a list: of its first element */
    uint32_t bytes;    /* of all elements */
    uint32_t elements; /* of a list; 0: no list */
} cgt_mfc_record;

/* The records of one or more MFCs. */
typedef struct cgt_mfc_trace {
    cgt_mfc_record *record;
    size_t count, capacity;
    size_t lost; /* records for which there was no memory */
} cgt_mfc_trace;

void cgt_mfc_trace_init(cgt_mfc_trace *trace);
void cgt_mfc_trace_free(cgt_mfc_trace *trace);

typedef struct cgt_mfc_counts {
    uint64_t gets, puts, lists, elements, atomics, signals, orders; /* commands given; of lists, elements moved */
    uint64_t bytes_in, bytes_out;                                   /* moved */
    uint64_t lost_lines;                                            /* putllc that failed */
    uint64_t queue_stalls; /* commands that found the queue full; atomic ones have none, and wait for the one before */
    uint64_t wait_cycles;  /* in which the program waited for a channel; counted by who runs it */
} cgt_mfc_counts;

/* ---- an MFC ---- */

typedef struct cgt_mfc cgt_mfc;

/* Makes an MFC and puts it into the map's list.
 *   spe      its number, 0 to CGT_MAX_SPES - 1, for messages and the trace
 *   store    its local store; bytes stay valid and in place
 *   timing   NULL: the default
 *   trace    gets a record of each command; NULL: none
 * OUT_OF_MEMORY; INVALID_ARGUMENT for a store or a timing out of range; TOO_LARGE beyond CGT_MAX_SPES in a map. */
cgt_result cgt_mfc_create(cgt_ea_map *map, unsigned spe, const cgt_local_store *store, const cgt_mfc_timing *timing,
                          cgt_mfc_trace *trace, cgt_mfc **mfc);

/* Removes it from the map's list. NULL does nothing. Signal regions of it must not be used any more. */
void cgt_mfc_free(cgt_mfc *mfc);

/* From now on it is an error to write to the bytes of a put before its tag was waited for (dma/buffers.c). */
void cgt_mfc_watch_buffers(cgt_mfc *mfc);

/* The channels, for an SPU. user is the MFC. A read or write that cannot be done yet returns STALL and changes nothing;
 * it is to be repeated at a later cycle. ERROR: cgt_mfc_get_error has the reason; the MFC does nothing more. count is 0
 * after an error. */
cgt_spu_channels cgt_mfc_get_channels(cgt_mfc *mfc);

/* The first rule that was broken, and the sentence: rule, command, arguments. NONE and "" before. */
cgt_mfc_rule cgt_mfc_get_error(const cgt_mfc *mfc, const char **message);
const cgt_mfc_counts *cgt_mfc_get_counts(const cgt_mfc *mfc);
/* for who runs the program: adds cycles in which it waited for a channel */
void cgt_mfc_add_wait(cgt_mfc *mfc, uint64_t cycles);

/* ---- time ---- */

/* The cycle of the next thing that this MFC does by itself; CGT_NO_CYCLE: nothing. */
uint64_t cgt_mfc_next_event(const cgt_mfc *mfc);

/* Does what is due up to and including the cycle. */
void cgt_mfc_advance(cgt_mfc *mfc, uint64_t cycle);

/* A number that grows when anything changes that a stalled program may wait for. */
uint64_t cgt_mfc_get_changes(const cgt_mfc *mfc);

/* Whether commands are in the queue or an atomic command is under way. */
bool cgt_mfc_is_busy(const cgt_mfc *mfc);

/* ---- the PPE's side ---- */

/* Each has the cycle of the access. A mailbox that is full takes nothing; an empty one gives nothing: false. */
bool cgt_mfc_send_mailbox(cgt_mfc *mfc, uint64_t cycle, uint32_t value);
bool cgt_mfc_take_mailbox(cgt_mfc *mfc, uint64_t cycle, uint32_t *value);
bool cgt_mfc_take_interrupt_mailbox(cgt_mfc *mfc, uint64_t cycle, uint32_t *value);

/* Signal register 1 or 2: in OR mode values gather until the program reads them, else the last one stays. */
void cgt_mfc_send_signal(cgt_mfc *mfc, uint64_t cycle, unsigned number, uint32_t value);
void cgt_mfc_set_signal_or(cgt_mfc *mfc, unsigned number, bool gathers);

/* Ends the MFC's work with an error of who runs the program. */
void cgt_mfc_fail(cgt_mfc *mfc, cgt_mfc_rule rule, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
