/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPE program that runs on a thread of the host. */
#ifndef CGT_NATIVE_INTERNAL_H
#define CGT_NATIVE_INTERNAL_H

#include <setjmp.h>

#include "cell/machine/machine_internal.h"
#include "spu_host.h"

typedef struct cgt_native {
    uint8_t *arena; /* first: spe_program.h reads it here */
    cgt_cell *cell;
    unsigned spe;
    const cgt_spe_program *program;
    cgt_spu_channels channels;
    cgt_spu_host host;
    uint64_t clock; /* cycle of its last access */
    bool interrupts;
    bool stopped; /* by itself, with the code */
    uint32_t code;
    jmp_buf end; /* out of the program */
    pthread_t thread;
} cgt_native;

/* native_host.c: the words of spu_channels.h and spu_mfcio.h on the MFC */
cgt_spu_host cgt_native_host(cgt_native *native);

/* native.c: an access of a channel; leaves the program where it may not go on. writes: value is read, else it is
 * set. */
void cgt_native_access(cgt_native *native, unsigned channel, bool writes, uint32_t *value);
uint32_t cgt_native_count(cgt_native *native, unsigned channel);
__attribute__((noreturn)) void cgt_native_stop(cgt_native *native, uint32_t code);
__attribute__((noreturn, format(printf, 3, 4))) void cgt_native_fail(cgt_native *native, cgt_mfc_rule rule,
                                                                     const char *format, ...);

#endif
