/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * In place of spufs.c on systems that are not Linux: there are no real SPEs. */
#include "cell/machine/spufs.h"

#include "cell/machine/machine_internal.h"

cgt_result cgt_cell_run_spufs(cgt_cell *cell, const cgt_spufs_calls *calls, const cgt_memory_hooks *memory,
                              const cgt_spufs_program *program, cgt_ppe_function *ppe, void *user)
{
    (void)calls, (void)memory, (void)program, (void)ppe, (void)user;
    cgt_cell_fail(cell, "real SPEs need Linux");
    return CGT_ERROR_UNSUPPORTED;
}

bool cgt_spufs_send_mailbox(struct cgt_spufs *spufs, unsigned spe, uint32_t value)
{
    (void)spufs, (void)spe, (void)value;
    return false;
}

void cgt_spufs_send_signal(struct cgt_spufs *spufs, unsigned spe, unsigned number, uint32_t value)
{
    (void)spufs, (void)spe, (void)number, (void)value;
}
