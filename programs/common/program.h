/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the programs share: exit codes, errors, progress. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/cgt.h>

/* Exit codes of every program. */
enum {
    PROGRAM_OK = 0,
    PROGRAM_FAILED = 1, /* something went wrong at run time: a file, memory, a damaged input */
    PROGRAM_USAGE = 2   /* the command line is wrong; nothing was done */
};

#define PROGRAM_ERROR_SIZE 1024 /* enough for a path, a line number and a sentence */

/* First call of main. name: "cgt-render"; must stay valid. */
void program_init(const char *name);
const char *program_name(void);

/* Prints "NAME: text" and a line feed to standard error, ending a progress bar that is on the terminal's line. Control
 * characters of the text become question marks. Any thread may call it. */
void program_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Where program_error's texts go: sink returns 1 where it took the text, which is then not printed. NULL (default): to
 * standard error. A sink is not called by two threads at once. */
typedef int program_error_sink(void *user, const char *text);
void program_set_error_sink(program_error_sink *sink, void *user);

/* Flushes standard output and returns `code`; PROGRAM_FAILED with a message where the output could not be written
 * (a full disk, a closed pipe) and code was PROGRAM_OK. Last call of main. */
int program_exit(int code);

/* Where progress goes in place of standard error: "reading  34 %, 12 frames, 3.4/s, 00:12 left", about ten times a
 * second, also where it is quiet; "": it ended. */
typedef void program_progress_sink(void *user, const char *text);
void program_set_progress_sink(program_progress_sink *sink, void *user);

/* Progress on standard error: one line that is rewritten on a terminal, a plain line about every five seconds
 * elsewhere. Start, then update at any rate (output is limited), then end. */
typedef struct program_progress {
    const char *activity; /* "rendering" */
    const char *unit;     /* "frames" */
    double total;         /* `done` at the end; 0: not known */
    double start;         /* seconds */
    double last;          /* seconds, of the last line written */
    int terminal;
    int quiet; /* writes nothing */
    program_progress_sink *sink;
    void *user;
} program_progress;

void program_progress_start(program_progress *p, const char *activity, const char *unit, double total, int quiet);

/* done: units finished, for the count and the rate. share: 0 to 1, the completed part of the work, for the bar and
 * the remaining time; negative: done / total. */
void program_progress_update(program_progress *p, double done, double share);

/* Clears the bar from the terminal. */
void program_progress_end(program_progress *p);

/* Seconds of a monotonic clock. */
double program_seconds(void);

#endif
