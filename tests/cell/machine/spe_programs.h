/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small SPE programs, each twice: in C for the host (spe_programs.c), and by hand as instructions of an SPU
 * (spe_assembled.c). Both give the same DMA commands in the same order.
 *
 *   squares   argument: address of 256 floats for each SPE, which become their squares. Sends the number of the SPE by
 *             its mailbox, and stops with 0x2007.
 *   counter   argument: address of a line, whose first word it raises COUNTER_ROUNDS times, by getllar and putllc.
 *   strips    argument: address of rows of 32 words. Takes numbers of rows from its mailbox until STRIPS_END; to each word
 *             of the row it adds the row's number; sends the number when the row has been written. */
#ifndef SPE_PROGRAMS_H
#define SPE_PROGRAMS_H

#include "cell/machine/machine.h"
#include "cell/spu/isa/assemble.h"

#define SQUARES_FLOATS 256
#define COUNTER_ROUNDS 25
#define STRIPS_END 0xffffffffu

cgt_spe_function squares, counter, strips;

void assemble_squares(cgt_spu_assembler *p);
void assemble_counter(cgt_spu_assembler *p);
void assemble_strips(cgt_spu_assembler *p);

/* native only: passes a token from SPE to SPE by signals, and copies from store to store */
cgt_spe_function ring;
#define RING_ROUNDS 10

#endif
