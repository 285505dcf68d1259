/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Programs of a few instructions whose cycles can be counted by hand: each shows one rule of the timing model
 * (backends/cell/spu/timing/issue.h). cgt-bench cell prints them; the tests compare them with the counts by hand. */
#ifndef MICRO_PROGRAMS_H
#define MICRO_PROGRAMS_H

#include "cell/spu/isa/assemble.h"
#include "cell/spu/timing/timing.h"

typedef struct micro_program {
    const char *name, *shows;
    void (*write)(cgt_spu_assembler *p);
    uint64_t cycles; /* counted by hand, from the first instruction to the stop */
} micro_program;

extern const micro_program micro_programs[];
extern const uint32_t micro_program_count;

typedef struct micro_result {
    uint64_t cycles;
    cgt_spu_counts counts;
} micro_result;

/* Runs a program on a timed SPU that was just created. Channel 29 stalls until cycle MICRO_CHANNEL_READY and then reads
 * as 7. slice: cycles of a run; the result must not depend on it. Returns false where the program does not stop. */
#define MICRO_CHANNEL_READY 100
bool micro_program_run(cgt_spu *spu, const micro_program *program, uint64_t slice, micro_result *result);

/* A loop of 24 instructions as kernels have them, run some million times: for the simulator's own speed. Returns false
 * where it does not stop. */
bool micro_kernel_run(cgt_spu *spu);

#endif
