/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The processors of a machine's ranks; see mpi_processors.h. */
#ifdef __linux__
#define _GNU_SOURCE
#include <sched.h>
#endif
#include <stdlib.h>

#include "mpi_processors.h"

#ifdef __linux__

struct mpi_processors {
    cpu_set_t all, own;
    bool known; /* of all ranks */
};

int cgt_mpi_processors_join(cgt_mpi *m)
{
    struct mpi_processors *const p = calloc(1, sizeof *p);
    cpu_set_t own, all;
    CPU_ZERO(&own);
    int known = p && sched_getaffinity(0, sizeof own, &own) == 0, all_known;
    MPI_Allreduce(&own, &all, sizeof own, MPI_BYTE, MPI_BOR, m->machine);
    MPI_Allreduce(&known, &all_known, 1, MPI_INT, MPI_MIN, m->machine);
    if (!p)
        return -1;
    *p = (struct mpi_processors){.all = all, .known = all_known};
    m->processors = p;
    return 0;
}

void cgt_mpi_take_processors(cgt_mpi *m)
{
    struct mpi_processors *const p = m->processors;
    if (m->leaders != MPI_COMM_NULL && p->known && sched_getaffinity(0, sizeof p->own, &p->own) == 0)
        sched_setaffinity(0, sizeof p->all, &p->all);
}

void cgt_mpi_return_processors(cgt_mpi *m)
{
    struct mpi_processors *const p = m->processors;
    if (m->leaders != MPI_COMM_NULL && p->known)
        sched_setaffinity(0, sizeof p->own, &p->own);
}

#else

int cgt_mpi_processors_join(cgt_mpi *m)
{
    (void)m;
    return 0;
}

void cgt_mpi_take_processors(cgt_mpi *m) { (void)m; }

void cgt_mpi_return_processors(cgt_mpi *m) { (void)m; }

#endif
