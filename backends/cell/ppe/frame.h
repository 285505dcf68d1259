/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What frames by any program have in common: how they run on 1 to 16 SPEs, and what comes back. The programs' own
 * options, and the calls, are in grid/grid_frame.h and kd/kd_frame.h. */
#ifndef CGT_CELL_FRAME_H
#define CGT_CELL_FRAME_H

#include <cgt/research.h>

#include "cell/image/kd_image.h"
#include "cell/ppe/assignment.h"

#define CGT_DOUBTS_HALF 1024u /* doubts of half a ring; most: 32,768 */

struct cgt_spufs_calls;

/* 0 is the right default of all but spes, and of one of function and elf. */
typedef struct cgt_cell_frame_options {
    unsigned spes;              /* 1 to CGT_MAX_SPES */
    cgt_spe_function *function; /* native: the program compiled for the host */
    const void *elf;            /* simulated: the program's ELF file, `elf_bytes` long */
    size_t elf_bytes;
    bool untimed; /* simulated without the timing model: faster, cycles mean nothing */
    cgt_assignment assignment;
    uint32_t share;               /* of HYBRID: percent that is fixed; 0: CGT_HYBRID_SHARE */
    uint32_t doubts_half;         /* doubts of half a ring, a multiple of 16; 0: CGT_DOUBTS_HALF */
    bool keep_doubts;             /* leave the SPEs' ids as they are: not exact */
    uint32_t ppe_cycles;          /* cgt_cell_options */
    uint64_t cycle_limit;         /* the same */
    const cgt_mfc_timing *timing; /* the same */
    void (*inspect)(void *user, unsigned spe, const cgt_spu *spu); /* after a simulated run; NULL: nothing */
    void *user;
    /* `elf` runs on the SPEs of a real Cell (cell/machine/spufs.h), by these calls; NULL: Linux's */
    bool real;
    const struct cgt_spufs_calls *spufs;
} cgt_cell_frame_options;

/* What an SPE reports, by its program. Both begin with state, value and doubts. */
typedef union cgt_cell_report {
    cgt_spe_report grid;
    cgt_kd_report kd;
} cgt_cell_report;

typedef struct cgt_cell_frame_spe {
    cgt_cell_report report;
    uint64_t cycles, idle; /* until it stopped; from there to the frame's end */
    uint64_t waits;        /* cycles in which it waited for DMA or a mailbox */
    uint32_t messages;     /* mailbox values both ways, interrupts included */
    cgt_mfc_counts counts;
    cgt_spe_waits waited; /* `waits` by what for */
} cgt_cell_frame_spe;

typedef struct cgt_cell_frame_result {
    uint64_t cycles; /* of the slowest SPE; natively without computing */
    uint64_t doubts, exact, changed;
    uint64_t light_doubts,
        light_pixels;    /* of the grid program's rays from hits; pixels whose rays the PPE has traced */
    uint32_t interrupts; /* halves of rings that were full */
    cgt_cell_frame_spe spe[CGT_MAX_SPES];
    char message[CGT_CELL_MESSAGE_BYTES]; /* of what went wrong, a sentence */
} cgt_cell_frame_result;

#endif
