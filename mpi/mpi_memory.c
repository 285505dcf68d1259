/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory that the ranks of a machine share: the leader's, which all of them write and read. */
#include "mpi_job.h"

/* It grows by half, so that counts which creep up do not allocate each time. */
cgt_result cgt_mpi_memory_reserve(cgt_mpi *m, mpi_memory *memory, size_t bytes)
{
    int unit;
    MPI_Aint size = 0;
    cgt_result result = CGT_OK;
    if (bytes <= memory->bytes)
        return CGT_OK;
    const size_t grown = memory->bytes + memory->bytes / 2;
    bytes = bytes > grown ? bytes : grown;
    cgt_mpi_memory_free(memory);
    MPI_Comm_set_errhandler(m->machine, MPI_ERRORS_RETURN); /* there may be less memory than this */
    if (MPI_Win_allocate_shared(m->local ? 0 : (MPI_Aint)bytes, 1, MPI_INFO_NULL, m->machine, &memory->base,
                                &memory->window) != MPI_SUCCESS) {
        memory->window = MPI_WIN_NULL;
        result = cgt_mpi_fail(m, CGT_ERROR_OUT_OF_MEMORY, "%zu bytes of shared memory were refused", bytes);
    }
    MPI_Comm_set_errhandler(m->machine, MPI_ERRORS_ARE_FATAL);
    if (result != CGT_OK)
        return result;
    MPI_Win_shared_query(memory->window, 0, &size, &unit, &memory->base);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, memory->window);
    memory->bytes = bytes;
    return CGT_OK;
}

void cgt_mpi_memory_free(mpi_memory *memory)
{
    if (memory->window != MPI_WIN_NULL) {
        MPI_Win_unlock_all(memory->window);
        MPI_Win_free(&memory->window);
    }
    memory->base = NULL;
    memory->bytes = 0;
}

/* In the unified memory model, which windows of shared memory have, this and the barrier's own order are enough. */
void cgt_mpi_memory_fence(cgt_mpi *m)
{
    atomic_thread_fence(memory_order_seq_cst);
    MPI_Barrier(m->machine);
    atomic_thread_fence(memory_order_seq_cst);
}
