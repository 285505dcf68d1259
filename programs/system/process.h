/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What systems do differently: signals, and programs that this one starts. One of process_posix.c and process_windows.c
 * is compiled. */
#ifndef PROCESS_H
#define PROCESS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* ---- Signals ------------------------------------------------------------------------------------------------ */

/* Calls on_end for each signal that asks this program to end and is not ignored. at_once: it is the one that asks to
 * end without tidying up. on_end may do what a handler of signals may. A limit on the size of files becomes an error of
 * calls. */
void process_catch_ends(void (*on_end)(int number, int at_once));

/* A pipe that its reader has closed becomes an error of the call that writes. */
void process_ignore_closed_pipes(void);

/* Lets this program learn how its children end, which nobody does where it has inherited that SIGCHLD is ignored. */
void process_watch_children(void);

/* Ends this program as the signal does where nothing handles it. */
void process_end_by(int number);

/* Keeps the signals of process_catch_ends from this thread until process_release_signals. */
typedef struct process_signals {
    uint64_t words[16]; /* as many as the system's set of signals may take */
} process_signals;
void process_hold_signals(process_signals *before);
void process_release_signals(const process_signals *before);

/* ---- Programs ----------------------------------------------------------------------------------------------- */

typedef struct process_child {
    intptr_t process; /* -1: none */
    intptr_t pipe;    /* to its standard input; -1: closed */
} process_child;

/* Starts argv[0], which is looked for where the system looks, with a pipe as standard input; what it prints goes to
 * `messages`. Interrupts from the terminal do not reach it. Returns 0, or an error number: ENOENT, there is none. */
int process_start(process_child *child, const char *const *argv, FILE *messages);

/* Writes to its input. Returns how many bytes it took, 0: none within a tenth of a second, or -1 with errno. */
long process_feed(process_child *child, const void *bytes, size_t size);

void process_close_pipe(process_child *child);
void process_kill(process_child *child);
void process_interrupt(process_child *child); /* asks it to end, where the system has such a thing */

/* Whether it has ended; wait: waits for that. *code: its exit code; -1 with a sentence in reason: it was ended by
 * something else. */
int process_has_ended(process_child *child, int wait, int *code, char *reason, size_t reason_size);

#endif
