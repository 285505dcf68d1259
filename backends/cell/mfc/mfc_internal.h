/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The state of an MFC, shared by the files of this folder. */
#ifndef CGT_MFC_INTERNAL_H
#define CGT_MFC_INTERNAL_H

#include "cell/mfc/mfc.h"

/* ---- commands ---- */

typedef enum cgt_mfc_kind {
    CGT_MFC_GET,
    CGT_MFC_PUT,
    CGT_MFC_SIGNAL,
    CGT_MFC_CACHE,   /* a hint to caches: checked, moves nothing */
    CGT_MFC_ZERO,    /* sdcrz: zeros in memory */
    CGT_MFC_ORDER,   /* mfc_eieio, mfc_sync: order the commands of a tag */
    CGT_MFC_BARRIER, /* mfc_barrier: orders all */
    CGT_MFC_LINE,    /* putqlluc: a line, through the queue */
    CGT_MFC_ATOMIC   /* getllar, putllc, putlluc: not through the queue */
} cgt_mfc_kind;

/* a row of the table of commands */
typedef struct cgt_mfc_operation {
    uint32_t opcode;
    const char *name; /* the word that gives it */
    cgt_mfc_kind kind;
    bool list, fence, barrier;
} cgt_mfc_operation;

/* NULL for none */
const cgt_mfc_operation *cgt_mfc_find_operation(uint32_t opcode);

typedef enum cgt_mfc_state {
    CGT_MFC_WAITS, /* behind others, or for the acknowledgement's return to work */
    CGT_MFC_RUNS,  /* ends at `finished` */
    CGT_MFC_STALLS /* a list that waits for its acknowledgement */
} cgt_mfc_state;

typedef struct cgt_mfc_command {
    const cgt_mfc_operation *operation;
    uint32_t lsa, size, tag; /* size: of the transfer or of the list */
    uint64_t ea;             /* of a list only its upper half counts */
    uint32_t list;           /* local address of the first element */
    uint32_t done, end;      /* bytes of the list: moved, and to be moved by the part under way */
    uint32_t list_lsa;       /* local address of the next element's data */
    cgt_mfc_state state;
    uint64_t issued, started, finished;
    uint64_t number; /* commands of this MFC before it */
} cgt_mfc_command;

/* A put for whose tag the program has not waited yet. */
typedef struct cgt_mfc_source {
    cgt_mfc_command command;
    uint64_t sum;                 /* of its bytes, when it was given */
    bool done;                    /* a tag status that the program is going to read tells of it */
    bool ordered_in_tag, ordered; /* commands of its tag, or any, that are given now come after it */
} cgt_mfc_source;

#define CGT_MFC_SOURCES 32 /* of more the oldest one is forgotten */

typedef struct cgt_mfc_element {
    bool notify;
    uint32_t size, eal;
} cgt_mfc_element;

/* ---- the rest ---- */

typedef struct cgt_mfc_mailbox {
    uint32_t value[CGT_IN_MAILBOX];
    unsigned count;
} cgt_mfc_mailbox;

typedef struct cgt_mfc_signal {
    uint32_t value;
    bool pending, gathers;
} cgt_mfc_signal;

struct cgt_mfc {
    cgt_ea_map *map;
    unsigned spe;
    cgt_local_store store;
    cgt_mfc_timing timing;
    cgt_mfc_trace *trace;
    cgt_mfc_counts counts;
    uint64_t now;     /* the latest cycle that it was told */
    uint64_t changes; /* cgt_mfc_get_changes */
    cgt_mfc_rule rule;
    char message[CGT_MFC_MESSAGE_BYTES];

    /* commands */
    cgt_mfc_command parameters;           /* what the channels 16 to 20 have got */
    cgt_mfc_command queue[CGT_MFC_QUEUE]; /* in the order given */
    unsigned queued;
    uint64_t commands;   /* so far */
    uint64_t bus_free;   /* cycle from which the SPE's bus is free */
    bool queue_was_full; /* a write of MFC_Cmd has stalled, and is counted */

    /* buffers.c */
    bool watches;
    unsigned sources;
    cgt_mfc_source source[CGT_MFC_SOURCES];

    /* tag groups and lists */
    uint32_t tag_mask;
    enum { CGT_TAG_UPDATE_NONE, CGT_TAG_UPDATE_WAITS, CGT_TAG_UPDATE_READY } tag_update;
    uint32_t tag_condition; /* what was written to MFC_WrTagUpdate */
    uint32_t tag_status;
    uint32_t stalled_tags; /* of lists that stalled since MFC_RdListStallStat was read */

    /* atomic commands */
    cgt_mfc_command atomic;
    bool atomic_runs, atomic_ready;
    uint32_t atomic_status;
    struct {
        uint64_t ea;
        bool valid;
    } reservation;

    /* mailboxes, signals, decrementer, events */
    cgt_mfc_mailbox in, out, interrupt;
    cgt_mfc_signal signal[2];
    uint32_t decrementer; /* as written at decrementer_start */
    uint64_t decrementer_start;
    uint64_t decrementer_event;  /* cycle in which it becomes negative; CGT_NO_CYCLE */
    uint32_t events, event_mask; /* pending, wanted */
    bool event_counts;           /* SPU_RdEventStat has a count */
    uint32_t srr0;
};

/* dma/rules.c: each check fails the MFC and returns false where a rule is broken. */
bool cgt_mfc_check_command(cgt_mfc *mfc, const cgt_mfc_command *c);
bool cgt_mfc_check_element(cgt_mfc *mfc, const cgt_mfc_command *c, const cgt_mfc_element *e, uint32_t lsa);
void cgt_mfc_fail_command(cgt_mfc *mfc, const cgt_mfc_command *c, cgt_mfc_rule rule, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* dma/move.c: bytes, once checked */
void cgt_mfc_move(cgt_mfc *mfc, bool to_memory, uint32_t lsa, uint64_t ea, uint32_t size);
void cgt_mfc_zero(cgt_mfc *mfc, uint64_t ea, uint32_t size);
uint32_t cgt_mfc_load32(const cgt_mfc *mfc, uint32_t lsa);

/* dma/list.c: begins and ends the part of a list up to the next stall. begin gives the bytes that the bus carries;
 * false where an element breaks a rule. end returns whether the list stalls. */
bool cgt_mfc_begin_list(cgt_mfc *mfc, cgt_mfc_command *c, uint64_t *bus_bytes);
bool cgt_mfc_end_list(cgt_mfc *mfc, cgt_mfc_command *c, cgt_mfc_record *record);
cgt_channel_status cgt_mfc_acknowledge_list(cgt_mfc *mfc, uint32_t tag);

/* dma/queue.c */
void cgt_mfc_enqueue(cgt_mfc *mfc, const cgt_mfc_command *c);
void cgt_mfc_start_commands(cgt_mfc *mfc);
uint64_t cgt_mfc_delay(const cgt_mfc *mfc, uint64_t number);
uint32_t cgt_mfc_busy_tags(const cgt_mfc *mfc);
void cgt_mfc_update_tags(cgt_mfc *mfc);

/* dma/buffers.c: a command is given; tags are found idle; the program reads that. The first and the last fail the MFC
 * and return false where a buffer is used too early. */
bool cgt_mfc_watch_command(cgt_mfc *mfc, const cgt_mfc_command *c);
void cgt_mfc_watch_tags(cgt_mfc *mfc, uint32_t idle);
bool cgt_mfc_watch_status(cgt_mfc *mfc);

/* dma/atomic.c */
void cgt_mfc_begin_atomic(cgt_mfc *mfc, const cgt_mfc_command *c);
void cgt_mfc_end_atomic(cgt_mfc *mfc);
void cgt_mfc_lose_reservation(cgt_mfc *mfc);

/* mfc_events.c */
void cgt_mfc_raise(cgt_mfc *mfc, uint32_t events);
uint32_t cgt_mfc_read_decrementer(const cgt_mfc *mfc);
void cgt_mfc_write_decrementer(cgt_mfc *mfc, uint32_t value);
void cgt_mfc_write_event_mask(cgt_mfc *mfc, uint32_t mask);
void cgt_mfc_acknowledge_events(cgt_mfc *mfc, uint32_t events);

/* mfc_mailboxes.c; what another SPE sends has no time of this one */
void cgt_mfc_set_signal(cgt_mfc *mfc, unsigned number, uint32_t value);
cgt_channel_status cgt_mfc_read_mailbox(cgt_mfc *mfc, uint32_t *value);
cgt_channel_status cgt_mfc_write_mailbox(cgt_mfc *mfc, cgt_mfc_mailbox *box, uint32_t value);
cgt_channel_status cgt_mfc_read_signal(cgt_mfc *mfc, unsigned number, uint32_t *value);

/* mfc_trace.c */
void cgt_mfc_trace_add(cgt_mfc *mfc, const cgt_mfc_record *record);

#endif
