/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A frame at work, whatever its program: the PPE sets up control blocks, hands out pieces of work (strips, envelopes),
 * reads doubts, and collects reports. What a program's frame adds is a table of functions.
 *
 * A frame of a program begins with a cgt_cell_frame, so that these functions find the rest. */
#ifndef CGT_FRAME_RUN_H
#define CGT_FRAME_RUN_H

#include "cell/ppe/camera_tables.h"
#include "cell/ppe/doubts.h"
#include "cell/ppe/frame.h"

typedef struct cgt_cell_frame cgt_cell_frame;

/* Memory of the host, and where SPEs see it. */
typedef struct cgt_frame_region {
    uint64_t ea;
    const void *memory;
    uint64_t bytes; /* 0: there is none */
    bool writable;
} cgt_frame_region;

typedef struct cgt_frame_program {
    bool has_phases;    /* all SPEs meet at a barrier between phases, and each phase assigns all pieces anew */
    const char *pieces; /* what it hands out */
    cgt_result (*map)(cgt_cell_frame *f);                          /* its memory: cgt_frame_map */
    void (*fill_control)(cgt_cell_frame *f, uint32_t spe);         /* the SPE's block, from f->share[spe] */
    void (*take_doubt)(cgt_cell_frame *f, const cgt_doubt *doubt); /* NULL: cgt_doubts_add */
    /* Of an SPE that is not done: the error, with a sentence. */
    cgt_result (*explain)(const cgt_cell_frame *f, uint32_t spe, char message[CGT_CELL_MESSAGE_BYTES]);
    /* When all doubts are there: decides what is open, and writes the output. */
    cgt_result (*finish)(cgt_cell_frame *f, cgt_cell_frame_result *result);
} cgt_frame_program;

struct cgt_cell_frame {
    const cgt_frame_program *program;
    const cgt_cell_frame_options *options;
    const cgt_memory_hooks *memory;
    cgt_camera_tables tables;
    cgt_doubts doubts;
    cgt_control_block share[CGT_MAX_SPES]; /* first, strips, step, and the mailbox flag of each SPE */
    cgt_cell_report report[CGT_MAX_SPES];
    cgt_assigner assigner;
    cgt_cell *cell;
    cgt_doubt *ring; /* of each SPE: two halves of `half` doubts */
    size_t ring_bytes, nearest_bytes;
    uint32_t half, interrupts, waiting; /* waiting: SPEs at the barrier */
    bool broken;                        /* the program does not keep the protocol */
};

/* What is wrong with the options; NULL: nothing. */
const char *cgt_frame_check_options(const cgt_cell_frame_options *options);

/* Makes the camera's tables. program, options and memory of *f are set. Errors of cgt_camera_tables_init; in any case
 * the frame wants cgt_frame_release. */
cgt_result cgt_frame_begin(cgt_cell_frame *f, const cgt_camera *camera, uint32_t width, uint32_t height,
                           char message[CGT_CELL_MESSAGE_BYTES]);

/* Runs the program on `pieces` pieces, decides its doubts about objects of a scene, and fills the result. */
cgt_result cgt_frame_run(cgt_cell_frame *f, uint32_t pieces, cgt_doubts_object *get, const void *scene,
                         cgt_cell_frame_result *result);

void cgt_frame_release(cgt_cell_frame *f);

/* INVALID_ARGUMENT with the sentence. */
cgt_result cgt_frame_refuse(cgt_cell_frame_result *result, const char *sentence);

/* Allocates, fills with `byte`, and says what is wrong where there is no memory; NULL then. */
void *cgt_frame_allocate(const cgt_cell_frame *f, size_t bytes, int byte, char message[CGT_CELL_MESSAGE_BYTES]);

cgt_result cgt_frame_map(cgt_cell_frame *f, const cgt_frame_region *region, size_t regions);

/* frame_spes.c: runs the SPEs natively, simulated, or on a real Cell, as the options say. */
cgt_result cgt_frame_run_spes(cgt_cell_frame *f, cgt_ppe_function *ppe, char message[CGT_CELL_MESSAGE_BYTES]);

#endif
