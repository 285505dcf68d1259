/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Joining and leaving a job of several processes; see render_share.h. */
#define _POSIX_C_SOURCE 200809L
#include "render/share/render_share.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "common/program.h"
#include "render/share/share_messages.h"
#include "system/process.h"
#include "system/system.h"

/* ---- Joining ------------------------------------------------------------------------------------------------ */

/* The number of processes, as the launchers of MPI tell it by the environment; 1 where none did. */
static long count_processes(void)
{
    static const char *const names[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"};
    long most = 1;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const char *const text = getenv(names[i]);
        const long number = text ? strtol(text, NULL, 10) : 1;
        most = number > most ? number : most;
    }
    return most;
}

int share_stopped(void *user) { return *((render_share *)user)->stop != 0; }

int share_send_message(render_share *s, const share_message *message)
{
    return s->link.send(0, TAG_CONTROL, message, sizeof *message, share_stopped, s);
}

/* Errors and warnings of other ranks go to rank 0, which prints each line once: all processes find the same faults in
 * one file. */
static int on_error(void *user, const char *text)
{
    static char last[8][PROGRAM_ERROR_SIZE]; /* under program_error's lock */
    static unsigned count;
    render_share *const s = user;
    if (s->link.rank > 0) {
        share_message message = {.event = EVENT_TEXT};
        snprintf(message.text, sizeof message.text, "%s", text);
        return !*s->stop && share_send_message(s, &message) == LINK_OK;
    }
    for (unsigned i = 0; i < count && i < 8; i++)
        if (strcmp(last[i], text) == 0)
            return 1;
    snprintf(last[count++ % 8], sizeof last[0], "%s", text);
    return 0;
}

static stop_flag *caught;
static stop_flag launcher_ends; /* the job */

static void on_continue(void) { *caught = launcher_ends = 1; }

/* Where a process of a job dies, Open MPI's launcher, the parent of each other process, sends SIGCONT, and a second
 * later SIGTERM and at once SIGKILL. So the first of them is the time to tell which frames are missing, and to remove
 * files that are not whole. */
static void watch_launcher(render_share *s)
{
    caught = s->stop;
    if (getenv("OMPI_COMM_WORLD_SIZE"))
        process_catch_continue(on_continue);
}

static int load_link(render_share *s)
{
    char error[PROGRAM_ERROR_SIZE];
    mpi_module_start *start = NULL;
    /* global: parts that MPI loads by itself look for its symbols there */
    void *const symbol = system_load(MPI_MODULE_FILE, 1, MPI_MODULE_SYMBOL, error, sizeof error);
    if (!symbol) {
        program_error(
            "mpirun started this program, and the module for MPI cannot be loaded: %s. To have it, install MPI "
            "(Debian: libopenmpi-dev), then run cmake and build again; --part 1/3 needs no MPI",
            error);
        return -1;
    }
    memcpy(&start, &symbol, sizeof start);
    if (start(&s->link, error, sizeof error) == 0)
        return 0;
    program_error("%s", error);
    return -1;
}

int share_join(render_share *s)
{
    s->link.rank = 0;
    s->link.size = 1;
    s->end = UINT64_MAX;
    pthread_mutex_init(&s->lock, NULL);
    pthread_cond_init(&s->changed, NULL);
    if (count_processes() < 2)
        return 0;
    if (load_link(s))
        return -1;
    if (s->link.size < 2)
        return 0;
    watch_launcher(s);
    program_set_error_sink(on_error, s);
    if (s->link.rank > 0)
        return 0;
    s->has_server = pthread_create(&s->server, NULL, share_serve, s) == 0;
    if (!s->has_server)
        program_error("cannot start a thread");
    return s->has_server ? 0 : -1;
}

void share_await_end(void)
{
    const struct timespec step = {0, 10000000};
    for (int i = 0; i < 1000 && launcher_ends; i++)
        nanosleep(&step, NULL);
}

void share_close(render_share *s)
{
    if (s->link.size > 1)
        program_set_error_sink(NULL, NULL);
    free(s->grants);
    s->grants = NULL;
}

int share_agree(render_share *s, int wrong, survey *found)
{
    if (s->link.size < 2)
        return wrong ? -1 : 0;
    share_status *const status = calloc(2, sizeof *status);
    int result = -1;
    if (!status) {
        program_error("out of memory");
        return -1;
    }
    char host[sizeof status->host];
    system_host_name(host, sizeof host);
    status[0].wrong = wrong != 0;
    status[0].first = getpid();
    memcpy(status[0].host, host, sizeof host);
    if (found)
        status[0].survey = *found;
    if (s->link.rank > 0) {
        if (s->link.send(0, TAG_AGREE, &status[0], sizeof *status, share_stopped, s) == LINK_OK &&
            s->link.receive(0, TAG_AGREED, &status[0], sizeof *status, NULL, NULL, share_stopped, s) == LINK_OK)
            result = 0;
        s->first_pid = result == 0 && strcmp(status[0].host, host) == 0 ? (int)status[0].first : 0;
    } else {
        result = 0;
        for (int rank = 1; rank < s->link.size && result == 0; rank++) {
            result =
                s->link.receive(rank, TAG_AGREE, &status[1], sizeof *status, NULL, NULL, share_stopped, s) ? -1 : 0;
            status[0].wrong |= status[1].wrong;
            if (found)
                survey_merge(&status[0].survey, &status[1].survey);
        }
        for (int rank = 1; rank < s->link.size && result == 0; rank++)
            result = s->link.send(rank, TAG_AGREED, &status[0], sizeof *status, share_stopped, s) ? -1 : 0;
    }
    if (found)
        *found = status[0].survey;
    result = result || status[0].wrong ? -1 : 0;
    free(status);
    return result;
}

/* ---- Leaving ------------------------------------------------------------------------------------------------ */

/* Waits until the others have left: 0, or -1 after a signal. */
static int wait_for_others(render_share *s, void (*on_wait)(void *user))
{
    pthread_mutex_lock(&s->lock);
    while (s->left < s->link.size - 1 && !*s->stop) {
        share_wait_for_change(s);
        pthread_mutex_unlock(&s->lock);
        if (on_wait)
            on_wait(s->user);
        pthread_mutex_lock(&s->lock);
    }
    const int all = s->left == s->link.size - 1;
    pthread_mutex_unlock(&s->lock);
    return all ? 0 : -1;
}

int share_leave(render_share *s, int result, void (*on_wait)(void *user))
{
    int wrong = result != 0;
    if (s->link.size < 2)
        return wrong || share_has_failed(s) ? -1 : 0;
    if (s->link.rank > 0) {
        if (*s->stop) /* messages that were given up are still MPI's, and their memory is gone */
            return -1;
        const share_message message = {.event = EVENT_LEFT, .wrong = wrong};
        if (share_send_message(s, &message) != LINK_OK ||
            s->link.receive(0, TAG_RESULT, &wrong, sizeof wrong, NULL, NULL, share_stopped, s) != LINK_OK)
            return -1; /* without leaving in order: the job is being ended */
    } else if (s->has_server) {
        const int gone = wait_for_others(s, on_wait);
        pthread_join(s->server, NULL);
        s->has_server = 0;
        if (gone)
            return -1;
        wrong |= s->wrong || share_has_failed(s);
        for (int rank = 1; rank < s->link.size; rank++)
            if (s->link.send(rank, TAG_RESULT, &wrong, sizeof wrong, share_stopped, s) != LINK_OK)
                return -1;
    } else {
        return -1; /* MPI ends the job */
    }
    program_set_error_sink(NULL, NULL);
    s->link.finish();
    return wrong ? -1 : 0;
}
