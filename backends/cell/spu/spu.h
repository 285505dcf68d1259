/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPU: the processor of a Cell's SPE with its local store, run instruction by instruction on any host. It is
 * deterministic, and has no state outside its struct: several may run in several threads.
 *
 *   cgt_spu spu;
 *   cgt_spu_create(&spu, &memory, CGT_SPU_TIMED);
 *   cgt_spu_load_elf(&spu, bytes, size, name);                    (elf.h)
 *   cgt_spu_run(&spu, &channels, UINT64_MAX);
 *   cgt_spu_destroy(&spu);
 *
 * Byte order. The local store has the bytes of an SPU, which is big-endian, on every host: ELF sections are copied, and
 * dumps are those of the hardware. A register is four words in the host's order; word 0 is the preferred slot.
 *
 * Main memory, on the other side of a DMA, is the host program's: its words are in the host's order. So a transfer
 * keeps values, not bytes: 1 byte, a 16-bit number, or 32-bit words. This is what a native run of the same SPE program
 * sees when it copies bytes, as long as what crosses are 32-bit words; a 64-bit number crosses as two words, high
 * first. */
#ifndef CGT_CELL_SPU_H
#define CGT_CELL_SPU_H

#include <stdalign.h>
#include <stdbool.h>
#include <stddef.h>

#include <cgt/cgt.h>

#include "cell/spu/channels.h"

#define CGT_SPU_LOCAL_STORE 0x40000u /* bytes; addresses wrap around */
#define CGT_SPU_REGISTERS 128
#define CGT_SPU_MESSAGE_BYTES 200

typedef struct cgt_spu_register {
    alignas(16) uint32_t word[4];
} cgt_spu_register;

typedef enum cgt_spu_mode {
    CGT_SPU_UNTIMED, /* every instruction counts as one cycle */
    CGT_SPU_TIMED    /* cycles of the model in timing/timing.h */
} cgt_spu_mode;

struct cgt_spu_decoded; /* one instruction of the local store, decoded */
struct cgt_spu_timing;  /* pipelines and counts: timing/timing.h */
struct cgt_spu_row;     /* a form of the interpreter: execute/execute.h */

typedef struct cgt_spu {
    cgt_spu_register reg[CGT_SPU_REGISTERS];
    uint8_t *local_store;  /* CGT_SPU_LOCAL_STORE bytes in the SPU's order */
    uint32_t pc;           /* address of the next instruction, a multiple of 4 */
    uint64_t cycle;        /* the first cycle in which it may issue; may be raised between two runs, never lowered */
    uint64_t instructions; /* executed so far */
    uint32_t fpscr[4];     /* rounding and flags of doubles; floats neither obey nor change it */
    uint32_t srr0;         /* where iret goes */
    bool interrupts;       /* enabled by the program; the simulator never interrupts */
    struct cgt_spu_decoded *decoded;
    uint32_t code_low, code_high;  /* what is decoded lies within these addresses */
    struct cgt_spu_timing *timing; /* NULL: untimed */
    const struct cgt_spu_row *row; /* NULL: the fastest that this CPU runs */
    cgt_memory_hooks memory;
    char message[CGT_SPU_MESSAGE_BYTES]; /* of the last error, or "" */
} cgt_spu;

typedef enum cgt_spu_reason {
    CGT_SPU_STOPPED, /* stop or stopd; the program counter is behind it */
    CGT_SPU_HALTED,  /* heq, hgt or the like held; the program counter is behind it */
    CGT_SPU_STALLED, /* a channel stalls; the program counter is at the instruction */
    CGT_SPU_CYCLES,  /* until_cycle is reached: spu->cycle is that or more */
    CGT_SPU_ERROR    /* cgt_spu.message says what; the program counter is at the instruction */
} cgt_spu_reason;

typedef struct cgt_spu_end {
    cgt_spu_reason reason;
    uint32_t value; /* STOPPED: the code, 14 bits, 0x3fff after stopd; STALLED: the channel; else 0 */
} cgt_spu_end;

/* Makes an SPU with a local store and registers of zeros, at address 0.
 *   memory   hooks for its memory; both functions set
 * Returns CGT_OK or CGT_ERROR_OUT_OF_MEMORY: then the SPU has no memory, and destroy does nothing. */
cgt_result cgt_spu_create(cgt_spu *spu, const cgt_memory_hooks *memory, cgt_spu_mode mode);
void cgt_spu_destroy(cgt_spu *spu);

/* Runs from spu->pc until the program stops, halts, stalls or fails, or the next instruction would issue in cycle
 * until_cycle or later. Another call goes on from there; what happens, and when, does not depend on how often.
 *   channels   NULL: rdch, wrch, rchcnt and bisled are errors
 * One thread at a time may run an SPU. */
cgt_spu_end cgt_spu_run(cgt_spu *spu, const cgt_spu_channels *channels, uint64_t until_cycle);

/* The 32-bit word at an address in local store. Addresses wrap around, and lose their low two bits. */
uint32_t cgt_spu_load32(const cgt_spu *spu, uint32_t address);
void cgt_spu_store32(cgt_spu *spu, uint32_t address, uint32_t value);

/* Copy between local store and main memory, as a DMA does: a byte, a 16-bit number, or 32-bit words.
 *   size   1, 2, or a multiple of 4
 * Returns false, and copies nothing, where address + size exceeds the local store, or the size is another one. The
 * address need not be aligned; rules of the MFC are the MFC's to check. */
bool cgt_spu_copy_in(cgt_spu *spu, uint32_t address, const void *main_memory, size_t size);
bool cgt_spu_copy_out(const cgt_spu *spu, uint32_t address, void *main_memory, size_t size);

/* Must be called by whoever writes to spu->local_store itself: forgets what was decoded there. */
void cgt_spu_forget(cgt_spu *spu, uint32_t address, size_t size);

#endif
