/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The processors of a machine's ranks. mpirun binds each rank to its own; while a leader works the others sleep, and
 * its threads run on those of all. Without effect on systems other than Linux. */
#ifndef MPI_PROCESSORS_H
#define MPI_PROCESSORS_H

#include "mpi_job.h"

/* Finds the processors that the ranks may use; collective on a machine. Returns 0, or -1 without memory. */
int cgt_mpi_processors_join(cgt_mpi *m);

/* On leaders: the calling thread, and those that it starts, use all of them; the thread is bound as before. */
void cgt_mpi_take_processors(cgt_mpi *m);
void cgt_mpi_return_processors(cgt_mpi *m);

#endif
