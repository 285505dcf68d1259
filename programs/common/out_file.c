/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Output files that are whole or not there; see out_file.h. */
#define _POSIX_C_SOURCE 200809L
#include "common/out_file.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "system/process.h"
#include "system/system.h"

#define MOST_LINKS 40 /* one after the other, as the system's own limit */

enum { SLOT_FREE, SLOT_TAKEN, SLOT_EXISTS };

/* Static, since a signal's handler may read nothing that is freed. */
static struct {
    char name[OUT_FILE_PATH_SIZE + 16];
    atomic_int state; /* SLOT_EXISTS: the handler removes the file */
} temporaries[OUT_FILE_MOST];
static atomic_int creating; /* threads that create a temporary file now */
static atomic_int ending;   /* a signal ends the program: no file is created any more */
static stop_flag *caught;

/* ---- Signals ------------------------------------------------------------------------------------------------ */

/* Waits for threads that are between creating a file and telling so: a millisecond, again and again for at most a
 * second. The thread that handles the signal is none of them, since it blocks signals meanwhile. */
static void remove_and_end(int number)
{
    const struct timespec millisecond = {0, 1000000};
    atomic_store(&ending, 1);
    for (int wait = 0; wait < 1000 && atomic_load(&creating) > 0; wait++)
        nanosleep(&millisecond, NULL);
    for (int i = 0; i < OUT_FILE_MOST; i++)
        if (atomic_load(&temporaries[i].state) == SLOT_EXISTS)
            unlink(temporaries[i].name);
    process_end_by(number);
}

static void on_end(int number, int at_once)
{
    if (caught == NULL || *caught || at_once) {
        remove_and_end(number);
        return;
    }
    *caught = 1;
}

void out_file_catch_signals(stop_flag *stop)
{
    caught = stop;
    process_catch_ends(on_end);
}

/* Creates the file of the template in a slot. Signals wait meanwhile: the handler must know the name of what exists.
 * Returns 0 or an error number. */
static int create_temporary(int slot)
{
    process_signals before;
    int error = EINTR;
    process_hold_signals(&before);
    atomic_fetch_add(&creating, 1);
    if (!atomic_load(&ending)) {
        const int descriptor = mkstemp(temporaries[slot].name);
        error = descriptor < 0 ? errno : 0;
        if (descriptor >= 0) {
            atomic_store(&temporaries[slot].state, SLOT_EXISTS);
            close(descriptor);
        }
    }
    atomic_fetch_sub(&creating, 1);
    process_release_signals(&before);
    return error;
}

/* Returns a slot that no other file has, or -1. */
static int take_slot(void)
{
    for (int i = 0; i < OUT_FILE_MOST; i++) {
        int expected = SLOT_FREE;
        if (atomic_compare_exchange_strong(&temporaries[i].state, &expected, SLOT_TAKEN))
            return i;
    }
    return -1;
}

/* ---- Names -------------------------------------------------------------------------------------------------- */

static const char too_long[] = "the name is too long";

/* Replaces a link by what it names. Returns 1, 0 where path is no link, or -1: too long. */
static int follow_link(char *path, size_t size)
{
    char link[OUT_FILE_PATH_SIZE];
    const long length = system_read_link(path, link, sizeof link);
    if (length < 0)
        return 0;
    const char *slash = strrchr(path, '/');
    const size_t folder = link[0] == '/' || slash == NULL ? 0 : (size_t)(slash - path) + 1;
    if ((size_t)length == sizeof link || folder + (size_t)length >= size)
        return -1;
    memcpy(path + folder, link, (size_t)length);
    path[folder + (size_t)length] = '\0';
    return 1;
}

static mode_t mask; /* of the process */
static pthread_once_t mask_once = PTHREAD_ONCE_INIT;

/* Once, since the mask can only be read by setting another one for a moment. */
static void read_mask(void)
{
    mask = umask(0);
    umask(mask);
}

/* Finds target and mode. Links are followed one by one, so that one whose file does not exist yet works, too. Returns
 * NULL or what is wrong. */
static const char *find_target(out_file *file, const char *name)
{
    struct stat status;
    if (strlen(name) >= sizeof file->target)
        return too_long;
    strcpy(file->target, name);
    int followed = 1;
    for (int links = 0; followed > 0; links++)
        followed = links < MOST_LINKS ? follow_link(file->target, sizeof file->target) : -1;
    if (followed < 0)
        return "the symbolic links are too many or too long";
    if (stat(file->target, &status) == 0) {
        file->mode = (unsigned)status.st_mode & 07777u;
        if (!S_ISREG(status.st_mode))
            return "not a regular file";
        /* a name may be given to another file where the file itself must not be written: that would go unnoticed */
        return access(file->target, W_OK) == 0 ? NULL : strerror(errno);
    }
    pthread_once(&mask_once, read_mask);
    file->mode = 0666u & ~(unsigned)mask;
    return NULL;
}

/* The temporary file's name: the target's and an ending. A long one is cut, so that it is a name, too. */
static void name_temporary(const char *target, char *temporary, size_t size)
{
    enum { MOST_KEPT = 255 - 12 }; /* bytes of a name, without the ending */
    const char *slash = strrchr(target, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - target) + 1 : 0, length = strlen(target + folder);
    const size_t kept = folder + (length < MOST_KEPT ? length : MOST_KEPT);
    snprintf(temporary, size, "%.*s.part.XXXXXX", (int)kept, target);
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

static void set_error(char *error, size_t error_size, const char *name, const char *reason)
{
    if (error != NULL && error_size > 0)
        snprintf(error, error_size, "%.700s: cannot write: %s", name, reason);
}

const char *out_file_begin(out_file *file, const char *name, char *error, size_t error_size)
{
    const char *wrong = find_target(file, name);
    file->slot = wrong == NULL ? take_slot() : -1;
    if (wrong == NULL && file->slot < 0)
        wrong = "too many files are being written";
    if (wrong == NULL) {
        char *const temporary = temporaries[file->slot].name;
        name_temporary(file->target, temporary, sizeof temporaries[0].name);
        const int refused = create_temporary(file->slot);
        if (!refused)
            return temporary;
        wrong = strerror(refused);
        atomic_store(&temporaries[file->slot].state, SLOT_FREE);
    }
    set_error(error, error_size, name, wrong);
    return NULL;
}

int out_file_end(out_file *file, int keep, char *error, size_t error_size)
{
    const char *const temporary = temporaries[file->slot].name;
    int result = 0;
    if (keep && (chmod(temporary, (mode_t)file->mode) != 0 || system_replace(temporary, file->target) != 0)) {
        set_error(error, error_size, file->target, strerror(errno));
        result = -1;
    }
    if (!keep || result != 0)
        unlink(temporary);
    atomic_store(&temporaries[file->slot].state, SLOT_FREE);
    return result;
}
