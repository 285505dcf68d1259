/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ranks and leaders, and what all of them are told of an error. */
#define _POSIX_C_SOURCE 200809L
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "mpi_job.h"
#include "mpi_processors.h"

enum { FIRST_SLEEP = 20000, LONGEST_SLEEP = 1000000 }; /* nanoseconds */
enum { MOST_EXCHANGE = 1 << 30, DEFAULT_EXCHANGE = 1 << 26 };

/* ---- Errors -------------------------------------------------------------------------------------------------- */

cgt_result cgt_mpi_fail(cgt_mpi *m, cgt_result result, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(m->message, sizeof m->message, format, values);
    va_end(values);
    return result;
}

cgt_result cgt_mpi_fail_context(cgt_mpi *m, cgt_result result)
{
    cgt_context_get_error_message(m->context, m->message, sizeof m->message);
    return result;
}

/* Sleeps, each time longer: calls of MPI that wait take a whole processor in most implementations. */
static void rest(long *nanoseconds)
{
    const struct timespec time = {0, *nanoseconds};
    nanosleep(&time, NULL);
    *nanoseconds = *nanoseconds < LONGEST_SLEEP / 2 ? *nanoseconds * 2 : LONGEST_SLEEP;
}

cgt_result cgt_mpi_agree(cgt_mpi *m, cgt_result result)
{
    struct {
        int result;
        char message[MESSAGE_SIZE];
    } told = {.result = (int)result};
    const int own = result == CGT_OK ? INT32_MAX : m->rank;
    int first = INT32_MAX, done = 0;
    MPI_Request request;
    MPI_Iallreduce(&own, &first, 1, MPI_INT, MPI_MIN, m->ranks, &request);
    for (long sleep = FIRST_SLEEP;;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done)
            break;
        rest(&sleep);
    }
    /* NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): the request is tested until it is done */
    if (first == INT32_MAX)
        return CGT_OK;
    if (first == m->rank)
        snprintf(told.message, sizeof told.message, "rank %d: %.*s", first, MESSAGE_SIZE - 24, m->message);
    MPI_Bcast(&told, sizeof told, MPI_BYTE, first, m->ranks);
    memcpy(m->message, told.message, sizeof m->message);
    return (cgt_result)told.result;
}

size_t cgt_mpi_get_error_message(const cgt_mpi *m, char *text, size_t size)
{
    const char *const message = m ? m->message : "out of memory for a job";
    if (text && size)
        snprintf(text, size, "%s", message);
    return strlen(message);
}

/* ---- Joining ------------------------------------------------------------------------------------------------- */

/* Ranks, machines and leaders. */
static void split_ranks(cgt_mpi *m, MPI_Comm ranks, uint32_t ranks_per_leader)
{
    MPI_Comm machine;
    MPI_Comm_dup(ranks, &m->ranks);
    MPI_Comm_set_errhandler(m->ranks, MPI_ERRORS_ARE_FATAL);
    MPI_Comm_rank(m->ranks, &m->rank);
    MPI_Comm_split_type(m->ranks, MPI_COMM_TYPE_SHARED, m->rank, MPI_INFO_NULL, &machine);
    MPI_Comm_rank(machine, &m->local);
    MPI_Comm_split(machine, ranks_per_leader ? m->local / (int)ranks_per_leader : 0, m->rank, &m->machine);
    MPI_Comm_free(&machine);
    MPI_Comm_rank(m->machine, &m->local);
    MPI_Comm_size(m->machine, &m->locals);
    MPI_Comm_split(m->ranks, m->local == 0 ? 0 : MPI_UNDEFINED, m->rank, &m->leaders);
    if (m->leaders != MPI_COMM_NULL) {
        MPI_Comm_size(m->leaders, &m->leader_count);
        MPI_Comm_rank(m->leaders, &m->leader);
    }
    MPI_Bcast(&m->leader_count, 1, MPI_INT, 0, m->machine);
}

/* Memory and the context; collective on a machine. */
static cgt_result make_parts(cgt_mpi *m, const cgt_mpi_options *options)
{
    const size_t leaders = (size_t)m->leader_count;
    cgt_context_options context = {.threads = 1};
    const bool joined = cgt_mpi_processors_join(m) == 0;
    m->elements = calloc(leaders, sizeof *m->elements);
    m->bytes = calloc(leaders, sizeof *m->bytes);
    m->places = calloc(leaders, sizeof *m->places);
    if (!joined || !m->elements || !m->bytes || !m->places)
        return cgt_mpi_fail(m, CGT_ERROR_OUT_OF_MEMORY, "out of memory");
    if (m->leaders != MPI_COMM_NULL && options)
        context = options->context;
    else if (m->leaders != MPI_COMM_NULL)
        cgt_context_options_init(&context);
    cgt_mpi_take_processors(m);
    const cgt_result result = cgt_context_create(&context, &m->context);
    cgt_mpi_return_processors(m);
    return result == CGT_OK ? result : cgt_mpi_fail_context(m, result);
}

/* What is wrong with the communicator, or NULL. */
static const char *check_communicator(MPI_Comm ranks)
{
    int started = 0, inter = 0;
    MPI_Initialized(&started);
    if (!started)
        return "cgt_mpi_create comes after MPI_Init";
    if (ranks == MPI_COMM_NULL)
        return "cgt_mpi_create: MPI_COMM_NULL";
    MPI_Comm_test_inter(ranks, &inter);
    return inter ? "cgt_mpi_create: a communicator of two groups" : NULL;
}

/* All but the message. */
static void release_parts(cgt_mpi *m)
{
    cgt_picture_release(m->picture);
    cgt_scene_release(m->scene);
    cgt_context_release(m->context);
    for (uint32_t i = 0; i < m->room; i++) {
        cgt_mpi_memory_free(&m->geometry[i].primitives.memory);
        cgt_mpi_memory_free(&m->geometry[i].vertices.memory);
    }
    cgt_mpi_memory_free(&m->exchange);
    if (m->leaders != MPI_COMM_NULL)
        MPI_Comm_free(&m->leaders);
    MPI_Comm_free(&m->machine);
    MPI_Comm_free(&m->ranks);
    free(m->geometry);
    free(m->looks);
    free(m->elements);
    free(m->bytes);
    free(m->places);
    free(m->processors);
}

cgt_result cgt_mpi_create(MPI_Comm ranks, const cgt_mpi_options *options, cgt_mpi **mpi)
{
    int missing, any_missing;
    uint64_t shared[2] = {0, 0};
    if (!mpi)
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_mpi *const m = *mpi = calloc(1, sizeof *m);
    const char *const wrong = check_communicator(ranks);
    if (m)
        m->failed = true;
    if (wrong)
        return m ? cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "%s", wrong) : CGT_ERROR_OUT_OF_MEMORY;
    missing = m == NULL;
    MPI_Allreduce(&missing, &any_missing, 1, MPI_INT, MPI_MAX, ranks);
    if (any_missing || !m)
        return m ? cgt_mpi_fail(m, CGT_ERROR_OUT_OF_MEMORY, "out of memory") : CGT_ERROR_OUT_OF_MEMORY;
    if (options) {
        shared[0] = options->ranks_per_leader;
        shared[1] = options->exchange_bytes;
    }
    MPI_Bcast(shared, 2, MPI_UINT64_T, 0, ranks);
    m->exchange.window = MPI_WIN_NULL;
    m->exchange_bytes = shared[1] ? (size_t)shared[1] : DEFAULT_EXCHANGE;
    split_ranks(m, ranks, shared[0] < INT32_MAX ? (uint32_t)shared[0] : INT32_MAX);
    cgt_result result = make_parts(m, options);
    if (result == CGT_OK && m->exchange_bytes > MOST_EXCHANGE)
        result = cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "exchange_bytes %zu: at most %d", m->exchange_bytes,
                              (int)MOST_EXCHANGE);
    result = cgt_mpi_agree(m, result);
    m->failed = result != CGT_OK;
    if (m->failed)
        release_parts(m);
    return result;
}

void cgt_mpi_release(cgt_mpi *m)
{
    if (m && !m->failed)
        release_parts(m);
    free(m);
}
