/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A real Cell: the third way to run a cgt_cell. Each SPE is a context of Linux's SPU file system, spufs: a folder whose
 * files are local store, registers and mailboxes (Documentation: spufs(7), spu_create(2), spu_run(2)). The programs are
 * those that are simulated, the PPE's function is the same, and so are its calls.
 *
 * DMA of a real SPE goes to the process' own addresses. So main memory is mapped at the effective addresses that the
 * program chose, filled before the run, and copied back after it where it is writable.
 *
 * Differs from the emulated ways: nothing is counted, no cycles, no DMA; a broken rule is what hardware makes of it, an
 * event with a sentence where it raises one; SPEs that wait for one another wait for ever. The outbound mailbox cannot
 * be waited for: it is looked at every millisecond, and with every interrupt; the other SPEs' local stores and signals
 * (CGT_SPE_EA) are at no addresses, so programs that send to them do not run.
 *
 * Never run on a Cell. Tests put a machine of their own behind the two system calls. */
#ifndef CGT_SPUFS_H
#define CGT_SPUFS_H

#include "cell/machine/machine.h"

/* The two system calls. Both return -1 and set errno on an error. */
typedef struct cgt_spufs_calls {
    void *user;
    /* A new context; the folder, open. Its files: mem, regs, mbox, ibox, wbox, signal1, signal2,
     * signal1_type, signal2_type. Closing it ends the context. */
    int (*create)(void *user, unsigned spe);
    /* Runs the context from *pc until it stops, which is *pc then; returns the SPU's status. event: bits of an
     * error. */
    int (*run)(void *user, int folder, uint32_t *pc, uint32_t *event);
} cgt_spufs_calls;

/* Linux's calls, with contexts below /spu. ENOSYS where there are none, as on all but PowerPC. */
extern const cgt_spufs_calls cgt_spufs_linux;

typedef struct cgt_spufs_program {
    const void *elf; /* of the program, as for a simulated SPU */
    size_t elf_bytes;
    uint64_t argument, environment;
} cgt_spufs_program;

/* Runs the programs, one for each SPE, on the real ones; returns when all have stopped.
 *   calls    NULL: Linux's
 *   memory   for what the run needs, both functions set
 * INVALID_ARGUMENT for a bad program or addresses that this process cannot map; UNSUPPORTED where there are no SPEs;
 * OUT_OF_MEMORY, THREADS; STOPPED where a program failed. The message says it. After a run of programs that stopped,
 * cgt_cell_get_result has their codes, and zeros in all else. */
cgt_result cgt_cell_run_spufs(cgt_cell *cell, const cgt_spufs_calls *calls, const cgt_memory_hooks *memory,
                              const cgt_spufs_program *program, cgt_ppe_function *ppe, void *user);

#endif
