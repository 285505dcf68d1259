/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Signals and programs on Windows; see process.h. */
#include "system/process.h"

#include <errno.h>
#include <limits.h>
#include <io.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

enum { PIPE_BYTES = 1 << 20, MOST_COMMAND = 32768 };

/* ---- Signals ------------------------------------------------------------------------------------------------ */

static const int ending_signals[] = {SIGINT, SIGTERM, SIGBREAK};
static void (*ends)(int number, int at_once);

/* Windows runs it on a thread of its own, and forgets it before each call. */
static void on_signal(int number)
{
    signal(number, on_signal);
    ends(number, 0);
}

void process_catch_ends(void (*on_end)(int number, int at_once))
{
    ends = on_end;
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++)
        signal(ending_signals[i], on_signal);
}

void process_ignore_closed_pipes(void) {}

void process_watch_children(void) {}

void process_end_by(int number) { _exit(128 + number); }

void process_hold_signals(process_signals *before) { (void)before; }

void process_release_signals(const process_signals *before) { (void)before; }

/* ---- Programs ----------------------------------------------------------------------------------------------- */

/* Adds an argument as Windows' C libraries take command lines apart: within quotes, quotes and the backslashes before
 * them behind backslashes. Returns the new length; too long: above MOST_COMMAND. */
static size_t add_argument(char *command, size_t used, const char *argument)
{
#define ADD(c) (used < MOST_COMMAND ? (void)(command[used] = (c)) : (void)0, used++)
    if (used > 0)
        ADD(' ');
    ADD('"');
    for (; *argument; argument++) {
        if (*argument == '"')
            ADD('\\');
        ADD(*argument);
        if (*argument == '\\' && (argument[strspn(argument, "\\")] == '"' || !argument[strspn(argument, "\\")]))
            ADD('\\');
    }
    ADD('"');
#undef ADD
    return used;
}

static int start(process_child *child, char *command, HANDLE input, HANDLE output)
{
    STARTUPINFOA how = {.cb = sizeof how,
                        .dwFlags = STARTF_USESTDHANDLES,
                        .hStdInput = input,
                        .hStdOutput = output,
                        .hStdError = output};
    PROCESS_INFORMATION made;
    if (!CreateProcessA(NULL, command, NULL, NULL, TRUE, CREATE_NEW_PROCESS_GROUP, NULL, NULL, &how, &made))
        return GetLastError() == ERROR_FILE_NOT_FOUND ? ENOENT : ENOEXEC;
    CloseHandle(made.hThread);
    child->process = (intptr_t)made.hProcess;
    return 0;
}

int process_start(process_child *child, const char *const *argv, FILE *messages)
{
    char *const command = malloc(MOST_COMMAND + 1);
    HANDLE input = NULL, output = NULL;
    size_t used = 0;
    child->process = child->pipe = -1;
    if (!command)
        return ENOMEM;
    for (; *argv; argv++)
        used = add_argument(command, used, *argv);
    command[used < MOST_COMMAND ? used : MOST_COMMAND] = '\0';
    int wrong = used > MOST_COMMAND ? E2BIG : CreatePipe(&input, &output, NULL, PIPE_BYTES) ? 0 : EMFILE;
    if (!wrong) {
        const HANDLE said = (HANDLE)_get_osfhandle(_fileno(messages));
        SetHandleInformation(input, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
        SetHandleInformation(said, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
        wrong = start(child, command, input, said);
        SetHandleInformation(said, HANDLE_FLAG_INHERIT, 0);
        CloseHandle(input);
    }
    if (wrong && output)
        CloseHandle(output);
    child->pipe = wrong ? -1 : (intptr_t)output;
    free(command);
    return wrong;
}

/* Waits until all is taken: pipes without names have no other way. Where the program dies the call fails. */
long process_feed(process_child *child, const void *bytes, size_t size)
{
    DWORD written = 0;
    const DWORD some = size < PIPE_BYTES ? (DWORD)size : PIPE_BYTES;
    if (WriteFile((HANDLE)child->pipe, bytes, some, &written, NULL))
        return (long)written;
    errno = EPIPE;
    return -1;
}

void process_close_pipe(process_child *child)
{
    if (child->pipe != -1)
        CloseHandle((HANDLE)child->pipe);
    child->pipe = -1;
}

void process_kill(process_child *child) { TerminateProcess((HANDLE)child->process, 1); }
void process_interrupt(process_child *child) { process_kill(child); }

int process_has_ended(process_child *child, int wait, int *code, char *reason, size_t reason_size)
{
    DWORD status = 0;
    (void)reason, (void)reason_size;
    if (WaitForSingleObject((HANDLE)child->process, wait ? INFINITE : 0) == WAIT_TIMEOUT)
        return 0;
    GetExitCodeProcess((HANDLE)child->process, &status);
    CloseHandle((HANDLE)child->process);
    *code = status <= INT_MAX ? (int)status : INT_MAX;
    child->process = -1;
    return 1;
}
