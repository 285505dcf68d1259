/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Waiting without a processor: calls of MPI that wait take a whole one in most implementations. */
#ifndef MPI_WAIT_H
#define MPI_WAIT_H

#include <time.h>

enum { FIRST_SLEEP = 20000, LONGEST_SLEEP = 1000000 }; /* nanoseconds */

/* Sleeps, each time longer. */
static inline void mpi_rest(long *nanoseconds)
{
    const struct timespec time = {0, *nanoseconds};
    nanosleep(&time, NULL);
    *nanoseconds = *nanoseconds < LONGEST_SLEEP / 2 ? *nanoseconds * 2 : LONGEST_SLEEP;
}

#endif
