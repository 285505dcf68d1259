/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Waiting without a processor: calls of MPI that wait take a whole one in most implementations. */
#ifndef MPI_WAIT_H
#define MPI_WAIT_H

#include <time.h>

enum { MPI_FIRST_SLEEP = 20000, MPI_LONGEST_SLEEP = 1000000 }; /* nanoseconds */

/* Sleeps, each time longer. */
static inline void mpi_rest(long *nanoseconds)
{
    const struct timespec time = {0, *nanoseconds};
    nanosleep(&time, NULL);
    *nanoseconds = *nanoseconds < MPI_LONGEST_SLEEP / 2 ? *nanoseconds * 2 : MPI_LONGEST_SLEEP;
}

#endif
