/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The host's side of exchange.h: runs a program of an SPU in the simulator and has it transform records. What the
 * program or the simulator does wrong fails the test with a sentence. */
#ifndef SPU_PROGRAM_H
#define SPU_PROGRAM_H

#include "cell/spu/spu.h"

#include "simd/spu_quad.h"
#include "spu/exchange.h"

typedef struct spu_program {
    cgt_spu spu;
    const char *path;
    uint32_t area;       /* its address in local store */
    uint32_t inbound[2]; /* what the program will read */
    unsigned unread;     /* how many of them */
} spu_program;

/* Loads the ELF file at `path` and runs it to its first request. */
void spu_program_begin(spu_program *p, const char *path);

/* Has function `number` transform `count` records of `quads` quads each, at most EXCHANGE_QUADS together. */
void spu_program_call(spu_program *p, uint32_t number, spu_quad *record, uint32_t count, uint32_t quads);

/* Ends the program, checks that it returned 0, and releases everything. */
void spu_program_end(spu_program *p);

#endif
