/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Output files that are whole or not there; see out_file.h. */
#define _POSIX_C_SOURCE 200809L
#include "common/out_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define MOST_LINKS 40 /* one after the other, as the system's own limit */

/* Static, since a signal's handler may read nothing that is freed. */
static char temporary[OUT_FILE_PATH_SIZE + 16];
static volatile sig_atomic_t temporary_exists;
static volatile sig_atomic_t *stop_flag;

/* ---- Signals ------------------------------------------------------------------------------------------------ */

static const int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

static void remove_and_end(int number)
{
    if (temporary_exists) {
        unlink(temporary);
    }
    signal(number, SIG_DFL);
    raise(number);
}

static void on_signal(int number)
{
    if (stop_flag == NULL || *stop_flag || number == SIGQUIT) {
        remove_and_end(number);
        return;
    }
    *stop_flag = 1;
}

void out_file_catch_signals(volatile sig_atomic_t *stop)
{
    stop_flag = stop;
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++) {
        struct sigaction action;
        if (sigaction(ending_signals[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN) {
            memset(&action, 0, sizeof action);
            action.sa_handler = on_signal;
            sigemptyset(&action.sa_mask);
            sigaction(ending_signals[i], &action, NULL);
        }
    }
    signal(SIGXFSZ, SIG_IGN);
}

/* Creates the file of the template in `temporary`. Signals wait meanwhile: the handler must know the name of what
 * exists. */
static int create_temporary(void)
{
    sigset_t blocked, before;
    sigemptyset(&blocked);
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++) {
        sigaddset(&blocked, ending_signals[i]);
    }
    sigprocmask(SIG_BLOCK, &blocked, &before);
    const int descriptor = mkstemp(temporary);
    const int mkstemp_errno = errno;
    temporary_exists = descriptor >= 0;
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (descriptor < 0) {
        return mkstemp_errno;
    }
    close(descriptor);
    return 0;
}

/* ---- Names -------------------------------------------------------------------------------------------------- */

static const char too_long[] = "the name is too long";

/* Replaces a link by what it names. Returns 1, 0 where path is no link, or -1: too long. */
static int follow_link(char *path, size_t size)
{
    char link[OUT_FILE_PATH_SIZE];
    const ssize_t length = readlink(path, link, sizeof link);
    if (length < 0) {
        return 0;
    }
    const char *slash = strrchr(path, '/');
    const size_t folder = link[0] == '/' || slash == NULL ? 0 : (size_t)(slash - path) + 1;
    if ((size_t)length == sizeof link || folder + (size_t)length >= size) {
        return -1;
    }
    memcpy(path + folder, link, (size_t)length);
    path[folder + (size_t)length] = '\0';
    return 1;
}

/* Finds target and mode. Links are followed one by one, so that one whose file does not exist yet works, too. Returns
 * NULL or what is wrong. */
static const char *find_target(out_file *file, const char *name)
{
    struct stat status;
    if (strlen(name) >= sizeof file->target) {
        return too_long;
    }
    strcpy(file->target, name);
    int followed = 1;
    for (int links = 0; followed > 0; links++) {
        followed = links < MOST_LINKS ? follow_link(file->target, sizeof file->target) : -1;
    }
    if (followed < 0) {
        return "the symbolic links are too many or too long";
    }
    if (stat(file->target, &status) == 0) {
        file->mode = (unsigned)status.st_mode & 07777u;
        return S_ISREG(status.st_mode) ? NULL : "not a regular file";
    }
    const mode_t mask = umask(0);
    umask(mask);
    file->mode = 0666u & ~(unsigned)mask;
    return NULL;
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

static void set_error(char *error, size_t error_size, const char *name, const char *reason)
{
    if (error != NULL && error_size > 0) {
        snprintf(error, error_size, "%.700s: cannot write: %s", name, reason);
    }
}

const char *out_file_begin(out_file *file, const char *name, char *error, size_t error_size)
{
    const char *wrong = find_target(file, name);
    if (wrong == NULL) {
        snprintf(temporary, sizeof temporary, "%s.part.XXXXXX", file->target);
        const int refused = create_temporary();
        wrong = refused ? strerror(refused) : NULL;
    }
    if (wrong != NULL) {
        set_error(error, error_size, name, wrong);
        return NULL;
    }
    return temporary;
}

int out_file_end(out_file *file, int keep, char *error, size_t error_size)
{
    int result = 0;
    if (keep && (chmod(temporary, (mode_t)file->mode) != 0 || rename(temporary, file->target) != 0)) {
        set_error(error, error_size, file->target, strerror(errno));
        result = -1;
    }
    if (!keep || result != 0) {
        unlink(temporary);
    }
    temporary_exists = 0;
    return result;
}
