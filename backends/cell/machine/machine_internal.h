/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The state of a cell, shared by the files of this folder. */
#ifndef CGT_MACHINE_INTERNAL_H
#define CGT_MACHINE_INTERNAL_H

#include <pthread.h>

#include "cell/machine/machine.h"

/* per SPE: one value of each of its mailboxes out, and its stop; and the start */
#define CGT_PPE_MAX_EVENTS (3 * CGT_MAX_SPES + 1)

typedef enum cgt_spe_state {
    CGT_SPE_RUNS,
    CGT_SPE_WAITS, /* for a channel */
    CGT_SPE_ENDED
} cgt_spe_state;

typedef struct cgt_spe {
    cgt_mfc *mfc;
    cgt_spe_state state;
    uint64_t cycle;   /* simulated: of its next access or instruction */
    bool late;        /* simulated: its processor must be told that cycle */
    uint64_t changes; /* of the MFC when it began to wait: any other number may end the wait */
    unsigned channel; /* that it waits for */
    cgt_spe_result result;
    bool gathers[2]; /* mode of the signal registers */
} cgt_spe;

struct cgt_cell {
    cgt_cell_options options;
    cgt_mfc_timing timing;
    cgt_ea_map memory; /* of the program */
    cgt_ea_map map;    /* of a run: memory, local stores, registers */
    cgt_spe spe[CGT_MAX_SPES];
    cgt_ppe_function *ppe;
    void *user;

    /* what the PPE has not seen yet, by rising cycle */
    cgt_ppe_event event[CGT_PPE_MAX_EVENTS];
    unsigned events;
    uint64_t ppe_free; /* cycle in which it can take the next */

    struct cgt_spufs *spufs; /* real SPEs at work (spufs.c); else NULL */

    bool failed;
    char message[CGT_CELL_MESSAGE_BYTES];

    /* native: everything above, and the MFCs, are used under the lock */
    bool native;
    bool ppe_waits;
    pthread_mutex_t lock;
    pthread_cond_t changed;
};

/* Forgets an earlier run, and what it found. */
void cgt_cell_reset(cgt_cell *cell, cgt_ppe_function *ppe, void *user);

/* Sets a run up: MFCs with these stores, their regions, no events but the start. */
cgt_result cgt_cell_prepare(cgt_cell *cell, const cgt_local_store *store, cgt_ppe_function *ppe, void *user);

/* Keeps the first failure. */
void cgt_cell_fail(cgt_cell *cell, const char *format, ...) __attribute__((format(printf, 2, 3)));
void cgt_cell_fail_mfc(cgt_cell *cell, unsigned spe); /* with the MFC's own message */
void cgt_cell_fail_deadlock(cgt_cell *cell);          /* names who waits for what */

/* Counts cycles in which the SPE waited for a channel. */
void cgt_cell_add_wait(cgt_spe *spe, unsigned channel, uint64_t cycles);

void cgt_cell_post(cgt_cell *cell, cgt_ppe_event event);
cgt_ppe_event cgt_cell_take_event(cgt_cell *cell);
/* spufs.c: the PPE's calls while real SPEs run */
bool cgt_spufs_send_mailbox(struct cgt_spufs *spufs, unsigned spe, uint32_t value);
void cgt_spufs_send_signal(struct cgt_spufs *spufs, unsigned spe, unsigned number, uint32_t value);

/* Calls the PPE's function; the event's mailbox value is taken first. */
void cgt_cell_serve(cgt_cell *cell, cgt_ppe_event event);

/* the kind of event that a write of the channel is for the PPE; false for any other channel */
bool cgt_cell_event_of_channel(unsigned channel, cgt_ppe_event_kind *kind);

#endif
