/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A Cell: 1 to 16 SPEs, each with its MFC and local store, main memory, and a PPE that feeds them. The SPEs run in one
 * of two ways, or on a real Cell (spufs.h):
 *
 *   simulated   SPUs execute instructions (cell/spu), all on the calling thread in the order of simulated time: the
 *               access of a channel, the end of a DMA and an act of the PPE happen in the order of their cycles, equal
 *               cycles in a fixed order. Every run is the same, cycles and trace included.
 *   native      the SPE's source, compiled for the host (spe_program.h), runs on a host thread per SPE. Computing takes
 *               no time of the model: each access of a channel takes a cycle, and a wait for the program's own DMA
 *               lasts as long as the model says. Different SPEs have no common time; otherwise the rules are the same.
 *
 * A program whose result depends on no order that the Cell leaves open gives the same bits both ways, and as many DMAs.
 *
 * The PPE is a function of the host that is called for one event after the other; both ways it may use main memory,
 * send mailbox values and signals. Where the SPEs are simulated each call takes cgt_cell_options.ppe_cycles.
 *
 * Threads: a cell belongs to one thread; the calls of `ppe` come on the thread that runs it. */
#ifndef CGT_MACHINE_H
#define CGT_MACHINE_H

#include "cell/machine/spe_addresses.h"
#include "cell/mfc/mfc.h"
#include "cell/spu/spu.h"

#define CGT_CELL_MESSAGE_BYTES 512

typedef struct cgt_cell cgt_cell;

/* 0 is the right default of all but spes. */
typedef struct cgt_cell_options {
    unsigned spes;                /* 1 to CGT_MAX_SPES */
    const cgt_mfc_timing *timing; /* NULL: the default; copied */
    cgt_mfc_trace *trace;         /* gets the DMA of all SPEs; NULL: none. Natively in the order in which it happens */
    uint32_t ppe_cycles;          /* of a call of the PPE's function; 0: CGT_PPE_CYCLES */
    uint64_t cycle_limit;         /* a simulated program that goes on longer is an error; 0: none */
    bool watch_buffers;           /* as cgt_mfc_watch_buffers, of all SPEs */
} cgt_cell_options;

/* What a PPE takes to serve a mailbox interrupt: a guess of the order of its interrupt latency. */
#define CGT_PPE_CYCLES 2000

/* INVALID_ARGUMENT, OUT_OF_MEMORY. */
cgt_result cgt_cell_create(const cgt_cell_options *options, cgt_cell **cell);
void cgt_cell_destroy(cgt_cell *cell); /* NULL does nothing */

/* Main memory, as cgt_ea_map_add_memory says; not while the cell runs. */
cgt_result cgt_cell_add_memory(cgt_cell *cell, uint64_t ea, void *memory, uint64_t count, uint32_t unit, bool writable);

/* The sentence about the last error: which SPE, which rule, what its arguments were. */
const char *cgt_cell_get_message(const cgt_cell *cell);

/* ---- the PPE ---- */

typedef enum cgt_ppe_event_kind {
    CGT_PPE_START,     /* once, before anything else; the SPE is 0 */
    CGT_PPE_MAILBOX,   /* an SPE wrote SPU_WrOutMbox; the value has been taken */
    CGT_PPE_INTERRUPT, /* an SPE wrote SPU_WrOutIntrMbox; the value has been taken */
    CGT_PPE_STOPPED    /* an SPE's program has ended; value: its code of 14 bits */
} cgt_ppe_event_kind;

typedef struct cgt_ppe_event {
    cgt_ppe_event_kind kind;
    unsigned spe;
    uint32_t value;
    uint64_t cycle; /* when the PPE sees it; natively 0 */
} cgt_ppe_event;

typedef void cgt_ppe_function(void *user, cgt_cell *cell, const cgt_ppe_event *event);

/* For the PPE's function. send_mailbox returns false where the mailbox has its four values already. */
bool cgt_cell_send_mailbox(cgt_cell *cell, unsigned spe, uint32_t value);
void cgt_cell_send_signal(cgt_cell *cell, unsigned spe, unsigned number, uint32_t value);

/* Reads and writes main memory that SPEs use at the same time: bytes as they lie in the host's memory. A write takes
 * reservations of its lines away. False where the bytes are not all in one region of memory that is writable. */
bool cgt_cell_read(cgt_cell *cell, uint64_t ea, void *to, size_t bytes);
bool cgt_cell_write(cgt_cell *cell, uint64_t ea, const void *from, size_t bytes);

/* Signal registers that gather values (OR) instead of keeping the last one; before a run. number is 1 or 2. */
cgt_result cgt_cell_set_signal_or(cgt_cell *cell, unsigned spe, unsigned number, bool gathers);

/* ---- running ---- */

/* A processor that a simulated SPE has: cgt_cell_unit_of makes one of a cgt_spu. */
typedef struct cgt_spe_unit {
    void *user;
    uint8_t *local_store;
    uint32_t store_bytes;
    cgt_store_order order;
    cgt_spu_end (*run)(void *user, const cgt_spu_channels *channels, uint64_t until_cycle);
    uint64_t (*get_cycle)(void *user);
    void (*raise_cycle)(void *user, uint64_t cycle); /* to a later one */
    void (*written)(void *user, uint32_t lsa, uint32_t size);
    const char *(*get_message)(void *user); /* of an error that is not the MFC's */
} cgt_spe_unit;

/* The SPU, loaded and timed or not, as the processor of an SPE. Its registers 3 to 5 get what main takes: the number of
 * the SPE, argument and environment, both of 64 bits. */
cgt_spe_unit cgt_cell_unit_of(cgt_spu *spu, unsigned spe, uint64_t argument, uint64_t environment);

/* Runs the simulated SPEs until all have stopped and their DMA has ended.
 *   unit   one for each SPE; each with its own local store
 *   ppe    NULL: mailboxes are taken and ignored
 * INVALID_ARGUMENT, OUT_OF_MEMORY; STOPPED where a program broke a rule, failed, ran into the limit, or all wait for
 * one another: the message says it. */
cgt_result cgt_cell_run_simulated(cgt_cell *cell, const cgt_spe_unit *unit, cgt_ppe_function *ppe, void *user);

/* An SPE program compiled for the host: main under a name of its own (spe_program.h). */
typedef int cgt_spe_function(unsigned long long spe, unsigned long long argument, unsigned long long environment);

typedef struct cgt_spe_program {
    cgt_spe_function *function;
    uint64_t argument, environment;
} cgt_spe_program;

/* Runs the programs, one for each SPE, on threads of their own; returns when all have ended. Arguments and errors as
 * above, and THREADS. A program ends when it returns, stops, or breaks a rule; the others end at their next access of a
 * channel then. A loop without one is not ended. */
cgt_result cgt_cell_run_native(cgt_cell *cell, const cgt_spe_program *program, cgt_ppe_function *ppe, void *user);

/* ---- after a run ---- */

/* Cycles in which an SPE waited for a channel, by what it waited for; their sum is cgt_mfc_counts.wait_cycles. Natively
 * those for its own commands alone: what others take has no length there. */
typedef struct cgt_spe_waits {
    uint64_t dma;     /* the end of its commands: MFC_RdTagStat, MFC_RdAtomicStat, MFC_RdListStallStat */
    uint64_t queue;   /* a place in the MFC's queue: MFC_Cmd */
    uint64_t mailbox; /* a value in SPU_RdInMbox; room in SPU_WrOutMbox and SPU_WrOutIntrMbox */
    uint64_t signal;  /* SPU_RdSigNotify1, SPU_RdSigNotify2 */
    uint64_t event;   /* SPU_RdEventStat, and any other channel */
} cgt_spe_waits;

typedef struct cgt_spe_result {
    bool stopped;      /* the program ended by itself */
    uint32_t code;     /* of the stop; 0x2000 + (value & 0xff) where main returned a value, as newlib does it */
    uint64_t cycle;    /* in which it ended; natively of the SPE's own time */
    cgt_mfc_rule rule; /* that it broke */
    cgt_mfc_counts counts;
    cgt_spe_waits waits;
} cgt_spe_result;

/* Of the last run; zeros where the number is out of range or nothing has run. */
cgt_spe_result cgt_cell_get_result(const cgt_cell *cell, unsigned spe);

#endif
