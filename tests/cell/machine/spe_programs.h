/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small SPE programs, each twice: in C (spe_squares.c ...), and by hand as instructions of an SPU (spe_assembled.c).
 * Both give the same DMA commands in the same order. By the SPU's own compiler in the suite spu.
 *
 *   squares   argument: address of 256 floats for each SPE, which become their squares. Sends the number of the SPE by
 *             its mailbox, and stops with 0x2007.
 *   counter   argument: address of a line, whose first word it raises COUNTER_ROUNDS times, by getllar and putllc.
 *   strips    argument: address of rows of 32 words. Takes numbers of rows from its mailbox until STRIPS_END; to each
 *             word of the row it adds the row's number; sends the number when the row has been written.
 *   ring      argument: how many SPEs. A word goes from local store to local store, and grows by one in each; signals
 *             tell the next. Returns the word. */
#ifndef SPE_PROGRAMS_H
#define SPE_PROGRAMS_H

#include "cell/machine/machine.h"
#include "cell/machine/spe_constants.h"
#include "cell/spu/isa/assemble.h"

cgt_spe_function squares, counter, strips;

void assemble_squares(cgt_spu_assembler *p);
void assemble_counter(cgt_spu_assembler *p);
void assemble_strips(cgt_spu_assembler *p);

cgt_spe_function ring; /* not assembled */

#endif
