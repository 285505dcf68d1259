/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every number of the timing model, with where it is from. What the simulator prints is this model's figure; it was
 * never compared with a console. Sources:
 *
 *   SDK    IBM SDK for Multicore Acceleration 3.0, Cell programming tutorial: table of pipelines and latencies, and its
 *          sections on issue rules, branches and local storage
 *   GCC    gcc 9, config/spu: spu.md (reservations), spu.c (hints)
 *   CBE    Cell Broadband Engine Programming Handbook, as remembered; not at hand when this was written
 *
 * CGT_SPU_MODEL_CLASSES: X(class, pipe, latency, source). The pipe is even or odd. The latency counts from the cycle of
 * issue to the first cycle in which an instruction that reads the result may issue.
 * CGT_SPU_MODEL_CONSTANTS: X(name, value, meaning, source). */
#ifndef CGT_CELL_MODEL_H
#define CGT_CELL_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "cell/spu/isa/isa.h"

/* clang-format off */
#define CGT_SPU_MODEL_CLASSES(X)                                                                                       \
    X(FX2,  EVEN, 2,  "SDK, GCC")                                                                                      \
    X(FX3,  EVEN, 4,  "SDK, GCC")                                                                                      \
    X(FXB,  EVEN, 4,  "SDK, GCC")                                                                                      \
    X(FP6,  EVEN, 6,  "SDK, GCC")                                                                                      \
    X(FP7,  EVEN, 7,  "SDK, GCC")                                                                                      \
    X(FPD,  EVEN, 13, "SDK, GCC")                                                                                      \
    X(NOP,  EVEN, 1,  "SDK; has no result")                                                                            \
    X(LS,   ODD,  6,  "SDK, GCC; stores and hints have no result")                                                     \
    X(SHUF, ODD,  4,  "SDK, GCC")                                                                                      \
    X(BR,   ODD,  4,  "SDK, GCC; of the link register and orx")                                                        \
    X(SPR,  ODD,  6,  "SDK; GCC has 4")                                                                                \
    X(LNOP, ODD,  1,  "SDK; has no result")

#define CGT_SPU_MODEL_CONSTANTS(X)                                                                                     \
    X(DOUBLE_STALL, 6,  "cycles behind a double-precision instruction in which nothing issues", "SDK")                 \
    X(MISPREDICT,   18, "cycles from a mispredicted branch to the next instruction", "SDK: 18 to 19")                  \
    X(HINT_READY,   11, "cycles from a hint until it is in effect; the branch waits for it", "CBE")                    \
    X(HINT_NEAREST, 8,  "instructions between a hint and its branch; with fewer it is ignored", "GCC; CBE: 4 pairs")
/* clang-format on */

enum {
#define X(name, value, meaning, source) CGT_SPU_MODEL_##name = value,
    CGT_SPU_MODEL_CONSTANTS(X)
#undef X
};

typedef struct cgt_spu_pipe {
    bool odd;
    uint8_t latency;
} cgt_spu_pipe;

#define CGT_SPU_PIPE_EVEN false
#define CGT_SPU_PIPE_ODD true

/* By cgt_spu_class. */
static const cgt_spu_pipe cgt_spu_pipes[CGT_SPU_CLASSES] = {
#define X(class, pipe, latency, source) [CGT_SPU_##class] = {CGT_SPU_PIPE_##pipe, latency},
    CGT_SPU_MODEL_CLASSES(X)
#undef X
};

#endif
