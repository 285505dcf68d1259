/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Contexts of spufs at work, shared by the files spufs*.c. */
#ifndef CGT_SPUFS_INTERNAL_H
#define CGT_SPUFS_INTERNAL_H

#include "cell/machine/machine_internal.h"
#include "cell/machine/spufs.h"

typedef enum cgt_spufs_file {
    CGT_SPUFS_MEM,
    CGT_SPUFS_REGS,
    CGT_SPUFS_MBOX, /* SPU_WrOutMbox */
    CGT_SPUFS_IBOX, /* SPU_WrOutIntrMbox */
    CGT_SPUFS_WBOX, /* SPU_RdInMbox */
    CGT_SPUFS_SIGNAL1,
    CGT_SPUFS_SIGNAL2,
    CGT_SPUFS_FILES
} cgt_spufs_file;

typedef struct cgt_spufs_context {
    struct cgt_spufs *all;
    unsigned spe;
    int folder, file[CGT_SPUFS_FILES]; /* -1: not open */
    uint32_t pc;
    int status, error; /* of the run: the SPU's, or errno where that is -1 */
    uint32_t event;
    pthread_t thread;
} cgt_spufs_context;

/* Main memory at its effective addresses: whole pages. */
typedef struct cgt_spufs_memory {
    struct {
        void *at;
        size_t bytes;
    } piece[CGT_EA_MAX_REGIONS];
    unsigned pieces;
} cgt_spufs_memory;

typedef struct cgt_spufs {
    const cgt_spufs_calls *calls;
    cgt_cell *cell;
    unsigned contexts; /* made */
    cgt_spufs_context context[CGT_MAX_SPES];
    cgt_spufs_memory memory;
    int wake[2];          /* a pipe: the number of a context that has ended, a byte each */
    pthread_mutex_t gate; /* held until all threads have been started, or one was refused */
    bool closed;          /* nobody runs */
} cgt_spufs;

/* spufs_memory.c: maps the cell's memory and makes the map of the run; and back. */
cgt_result cgt_spufs_map(cgt_cell *cell, cgt_spufs_memory *memory);
void cgt_spufs_unmap(cgt_cell *cell, cgt_spufs_memory *memory);

/* spufs_context.c: a context with its program, ready to run; fails with a message in the cell. Must be closed in any
 * case, once folder and files are -1. */
cgt_result cgt_spufs_open(cgt_spufs_context *context, const cgt_memory_hooks *memory, const cgt_spufs_program *program);
void cgt_spufs_close(cgt_spufs_context *context);

/* A value out of a mailbox, into one, or to a signal register; false where there is none, no room, or an error. */
bool cgt_spufs_read(const cgt_spufs_context *context, cgt_spufs_file file, uint32_t *value);
bool cgt_spufs_write(const cgt_spufs_context *context, cgt_spufs_file file, uint32_t value);

#endif
