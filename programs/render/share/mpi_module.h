/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The interface of the module cgt-mpi: messages between the processes of an MPI job. It is a file of its own, which
 * cgt-render loads where mpirun started it. */
#ifndef MPI_MODULE_H
#define MPI_MODULE_H

#include <stddef.h>

#define MPI_MODULE_FILE "cgt-mpi.so"
#define MPI_MODULE_SYMBOL "cgt_mpi_start"

/* Whether a call that waits shall give up: not 0. */
typedef int link_give_up(void *user);

enum { LINK_OK = 0, LINK_GIVEN_UP = 1, LINK_ANY = -1 };

/* Any thread may call these at any time, each pair of process and tag from one thread alone. All wait without taking a
 * CPU for themselves. Results: LINK_OK, or LINK_GIVEN_UP, also where MPI fails. */
typedef struct process_link {
    int rank, size; /* this process, from 0; how many there are */
    /* Sends bytes. Large messages wait until they are asked for: size is below 2^31. */
    int (*send)(int to, int tag, const void *bytes, size_t size, link_give_up *give_up, void *user);
    /* Receives a message of at most `capacity` bytes from a process, or LINK_ANY. size, from: may be NULL. */
    int (*receive)(int from, int tag, void *bytes, size_t capacity, size_t *size, int *from_rank, link_give_up *give_up,
                   void *user);
    /* Leaves the job; waits for all. */
    void (*finish)(void);
} process_link;

/* Joins the job: 0, or -1 with a sentence. */
typedef int mpi_module_start(process_link *link, char *error, size_t error_size);

__attribute__((visibility("default"))) mpi_module_start cgt_mpi_start;

#endif
