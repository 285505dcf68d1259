/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One frame of spheres by the grid program on 1 to 16 SPEs: the PPE sets up control blocks, hands out strips, decides
 * doubts, and reads the picture. */
#ifndef CGT_CELL_FRAME_H
#define CGT_CELL_FRAME_H

#include <cgt/research.h>

#include "cell/ppe/assignment.h"
#include "cell/ppe/light/light.h"

#define CGT_DOUBTS_HALF 1024u /* doubts of half a ring; most: 32,768 */

/* 0 is the right default of all but spes, and of one of function and elf. */
typedef struct cgt_cell_frame_options {
    unsigned spes;              /* 1 to CGT_MAX_SPES */
    cgt_spe_function *function; /* native: the program compiled for the host */
    const void *elf;            /* simulated: the program's ELF file, `elf_bytes` long */
    size_t elf_bytes;
    bool untimed; /* simulated without the timing model: faster, cycles mean nothing */
    cgt_assignment assignment;
    uint32_t share;       /* of HYBRID: percent that is fixed; 0: CGT_HYBRID_SHARE */
    bool nested;          /* three loops over cells; else one, which is faster */
    cgt_cull cull;        /* all but NONE are FRUSTUM: 16 rays are one block */
    uint32_t doubts_half; /* doubts of half a ring, a multiple of 16; 0: CGT_DOUBTS_HALF */
    bool retest; /* SPEs test a sphere again where a packet meets it in several cells; else they remember the last
                             eight that they tested (mailboxing) */
    const cgt_cell_light *light;  /* rays from the hits; NULL: none */
    uint32_t *occluded;           /* not NULL where there is a light. occluded[y * width + x], bit k: whether set k of
                                    the pixel's rays meets anything but the sphere that it starts from; 0 without a
                                    hit */
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

typedef struct cgt_cell_frame_spe {
    cgt_spe_report report;
    uint64_t cycles, idle; /* until it stopped; from there to the frame's end */
    uint64_t waits;        /* cycles in which it waited for DMA or a mailbox */
    uint32_t messages;     /* mailbox values both ways, interrupts included */
    cgt_mfc_counts counts;
    cgt_spe_waits waited; /* `waits` by what for */
} cgt_cell_frame_spe;

typedef struct cgt_cell_frame_result {
    uint64_t cycles; /* of the slowest SPE; natively without computing */
    uint64_t doubts, exact, changed;
    uint64_t light_doubts, light_pixels; /* of rays from hits; pixels whose rays the PPE has traced */
    uint32_t interrupts;                 /* halves of rings that were full */
    cgt_cell_frame_spe spe[CGT_MAX_SPES];
    char message[CGT_CELL_MESSAGE_BYTES]; /* of what went wrong, a sentence */
} cgt_cell_frame_result;

/* Traces a frame: ids[y * width + x] becomes the number of the sphere that the pixel's canonical ray hits first,
 * CGT_INVALID_ID where there is none. They are those of CGT_PRECISION_EXACT, for any options but keep_doubts; so are the
 * rays from hits, which start where an SPE's single precision finds the hit (cgt_frame_light_ray).
 * INVALID_ARGUMENT, TOO_LARGE for what does not fit, OUT_OF_MEMORY, THREADS, STOPPED where the program broke a rule;
 * result->message says it. ids are undefined then. */
cgt_result cgt_cell_frame_trace(const cgt_grid_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height,
                                const cgt_cell_frame_options *options, uint32_t *ids, cgt_cell_frame_result *result);

#endif
