/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a timed SPU knows beside its state: when registers are ready, which hint is in effect, and where the cycles
 * went. model.h has the numbers, issue.h the rules. */
#ifndef CGT_CELL_TIMING_H
#define CGT_CELL_TIMING_H

#include "cell/spu/isa/decoded.h"
#include "cell/spu/spu.h"

/* Each cycle has one cause, so their sum is the number of cycles. */
typedef enum cgt_spu_cause {
    CGT_SPU_DUAL,       /* two instructions issued */
    CGT_SPU_SINGLE,     /* one issued */
    CGT_SPU_DEPENDENCY, /* none: an operand was not ready */
    CGT_SPU_DOUBLE,     /* none: behind a double-precision instruction */
    CGT_SPU_MISPREDICT, /* none: behind a mispredicted branch */
    CGT_SPU_HINT_WAIT,  /* none: a branch waited for its hint */
    CGT_SPU_CHANNEL,    /* none: a channel stalled */
    CGT_SPU_CAUSES
} cgt_spu_cause;

extern const char *const cgt_spu_cause_names[CGT_SPU_CAUSES];

typedef struct cgt_spu_counts {
    uint64_t instructions;
    uint64_t mispredicts;
    uint64_t classes
        [CGT_SPU_CLASSES]; /* instructions of each class (isa.h); those of BR are branches but for orx, stop, sync */
    uint64_t cycles[CGT_SPU_CAUSES];
} cgt_spu_counts;

#define CGT_SPU_NAME_BYTES 64

/* A function, as the symbols of the ELF file have it. */
typedef struct cgt_spu_function {
    char name[CGT_SPU_NAME_BYTES]; /* cut to fit */
    uint32_t address, size;        /* in bytes */
    cgt_spu_counts counts;
} cgt_spu_function;

typedef struct cgt_spu_timing {
    uint64_t ready[CGT_SPU_REGISTERS + 2]; /* first cycle in which a reader may issue */
    bool pair_open;                        /* the next instruction may issue in the same cycle as the last one */
    uint32_t hint_branch, hint_target;     /* addresses; no hint: hint_branch is 1 */
    uint64_t hint_cycle, hint_instruction; /* its cycle; the number of the instruction behind it */
    uint64_t next_cycle;                   /* cgt_spu.cycle as the last run left it */
    uint32_t low, size;                    /* the addresses that `counts` is for */
    cgt_spu_counts *counts, *last;         /* of the function that runs; of the last instruction */
    cgt_spu_counts other;                  /* of all that is in no function */
    cgt_spu_function *function;            /* in the order of addresses, without overlap */
    uint32_t functions;
} cgt_spu_timing;

void cgt_spu_timing_init(cgt_spu_timing *timing);
void cgt_spu_timing_release(cgt_spu_timing *timing, const cgt_memory_hooks *memory);

/* Takes a copy of the functions, in any order; one that begins within another is dropped. Counts start at zero.
 * Returns CGT_OK or CGT_ERROR_OUT_OF_MEMORY: then there are no functions. */
cgt_result cgt_spu_timing_set_functions(cgt_spu_timing *timing, const cgt_memory_hooks *memory,
                                        const cgt_spu_function *function, uint32_t functions);

/* Sets the counts that belong to an address. */
void cgt_spu_timing_enter(cgt_spu_timing *timing, uint32_t address);

/* All counts since the start, or since the functions were set. */
cgt_spu_counts cgt_spu_timing_total(const cgt_spu_timing *timing);
uint64_t cgt_spu_counts_cycles(const cgt_spu_counts *counts);

#endif
