/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The module cgt-mpi; see mpi_module.h. One lock is held for each call of MPI, so that MPI_THREAD_SERIALIZED is enough,
 * and no call waits inside MPI, where implementations take a whole CPU: calls test, and sleep in between. */
#define _POSIX_C_SOURCE 200809L
#include "render/share/mpi_module.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include <mpi.h>

#include "mpi_wait.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* Waits for a request. What is given up is cancelled where MPI can; its memory may be written later where it cannot, so
 * the program ends after that. */
static int wait_for(MPI_Request *request, MPI_Status *status, link_give_up *give_up, void *user)
{
    long sleep = FIRST_SLEEP;
    for (;;) {
        int done = 0;
        pthread_mutex_lock(&lock);
        const int result = MPI_Test(request, &done, status);
        pthread_mutex_unlock(&lock);
        if (result != MPI_SUCCESS)
            return LINK_GIVEN_UP;
        if (done)
            return LINK_OK;
        if (give_up && give_up(user))
            return LINK_GIVEN_UP;
        mpi_rest(&sleep);
    }
}

static int send(int to, int tag, const void *bytes, size_t size, link_give_up *give_up, void *user)
{
    MPI_Request request;
    MPI_Status status;
    pthread_mutex_lock(&lock);
    const int result = MPI_Isend(bytes, (int)size, MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
    pthread_mutex_unlock(&lock);
    /* NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): wait_for tests it until it is done */
    return result == MPI_SUCCESS ? wait_for(&request, &status, give_up, user) : LINK_GIVEN_UP;
}

static int receive(int from, int tag, void *bytes, size_t capacity, size_t *size, int *from_rank, link_give_up *give_up,
                   void *user)
{
    MPI_Request request;
    MPI_Message message;
    MPI_Status status;
    long sleep = FIRST_SLEEP;
    for (int found = 0; !found;) {
        pthread_mutex_lock(&lock);
        int wrong =
            MPI_Improbe(from == LINK_ANY ? MPI_ANY_SOURCE : from, tag, MPI_COMM_WORLD, &found, &message, &status);
        if (wrong == MPI_SUCCESS && found)
            wrong = MPI_Imrecv(bytes, (int)capacity, MPI_BYTE, &message, &request);
        pthread_mutex_unlock(&lock);
        if (wrong != MPI_SUCCESS)
            return LINK_GIVEN_UP;
        if (found)
            break;
        if (give_up && give_up(user))
            return LINK_GIVEN_UP;
        mpi_rest(&sleep);
    }
    const int result = wait_for(&request, &status, give_up, user);
    int count = 0;
    if (result == LINK_OK)
        MPI_Get_count(&status, MPI_BYTE, &count);
    if (size)
        *size = (size_t)count;
    if (from_rank)
        *from_rank = status.MPI_SOURCE;
    return result;
}

static void finish(void)
{
    MPI_Request request;
    MPI_Status status;
    pthread_mutex_lock(&lock);
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    pthread_mutex_unlock(&lock);
    wait_for(&request, &status, NULL, NULL);
    MPI_Finalize();
}

int cgt_mpi_start(process_link *link, char *error, size_t error_size)
{
    int provided = 0;
    /* Open MPI's default copies large messages out of the sender's memory, and ends the receiver where the sender has
     * died, before it can tell which frames are missing. */
    setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS ||
        provided < MPI_THREAD_SERIALIZED) {
        snprintf(error, error_size, "this MPI does not let threads take turns");
        return -1;
    }
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &link->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &link->size);
    link->send = send;
    link->receive = receive;
    link->finish = finish;
    return 0;
}
