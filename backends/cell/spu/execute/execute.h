/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The interpreter, compiled once per row of cmake/variants.cmake that has its own form of the exact words
 * (simd/spu/spu_exact.h). All give the same bits; run.c takes the fastest one that the CPU runs. */
#ifndef CGT_CELL_EXECUTE_H
#define CGT_CELL_EXECUTE_H

#include "cell/spu/spu.h"

typedef cgt_spu_end cgt_spu_execute_fn(cgt_spu *spu, const cgt_spu_channels *channels, uint64_t until_cycle);

typedef struct cgt_spu_row {
    const char *name;
    cgt_spu_execute_fn *execute;
    bool (*runs)(void);
} cgt_spu_row;

/* The rows of this build, slowest first; ends with a name of NULL. cgt_spu_run is the last of them that runs. */
extern const cgt_spu_row cgt_spu_rows[];

#define CGT_SPU_JOIN_(name, row) name##_##row
#define CGT_SPU_JOIN(name, row) CGT_SPU_JOIN_(name, row)

#endif
