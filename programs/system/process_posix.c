/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Signals and programs on POSIX; see process.h. */
#define _GNU_SOURCE /* F_SETPIPE_SZ */
#include "system/process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { PIPE_BYTES = 1 << 20, PIPE_WAIT_MS = 100 };

/* ---- Signals ------------------------------------------------------------------------------------------------ */

static const int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
static void (*ends)(int number, int at_once);

static void on_signal(int number) { ends(number, number == SIGQUIT); }

void process_catch_ends(void (*on_end)(int number, int at_once))
{
    ends = on_end;
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

void process_ignore_closed_pipes(void) { signal(SIGPIPE, SIG_IGN); }

void process_watch_children(void) { signal(SIGCHLD, SIG_DFL); }

void process_end_by(int number)
{
    signal(number, SIG_DFL);
    raise(number);
}

_Static_assert(sizeof(sigset_t) <= sizeof(process_signals), "process.h: a set of signals is larger");

void process_hold_signals(process_signals *before)
{
    sigset_t held, mask;
    sigemptyset(&held);
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++)
        sigaddset(&held, ending_signals[i]);
    pthread_sigmask(SIG_BLOCK, &held, &mask);
    memcpy(before, &mask, sizeof mask);
}

void process_release_signals(const process_signals *before)
{
    sigset_t mask;
    memcpy(&mask, before, sizeof mask);
    pthread_sigmask(SIG_SETMASK, &mask, NULL);
}

/* ---- Programs ----------------------------------------------------------------------------------------------- */

/* In a group of its own, so that an interrupt from the terminal reaches this program alone, which decides. */
static int spawn(process_child *child, const char *const *argv, int input, int output)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t usual;
    pid_t process;
    int wrong = posix_spawn_file_actions_init(&actions);
    if (wrong)
        return wrong;
    wrong = posix_spawnattr_init(&attributes);
    if (wrong) {
        posix_spawn_file_actions_destroy(&actions);
        return wrong;
    }
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    sigaddset(&usual, SIGXFSZ);
    wrong = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    wrong = wrong ? wrong : posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    wrong = wrong ? wrong : posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    wrong =
        wrong ? wrong : posix_spawnp(&process, argv[0], &actions, &attributes, (char *const *)(uintptr_t)argv, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    child->process = wrong ? -1 : process;
    return wrong;
}

int process_start(process_child *child, const char *const *argv, FILE *messages)
{
    int ends_of_pipe[2];
    child->process = child->pipe = -1;
    if (pipe(ends_of_pipe))
        return errno;
    const int input = ends_of_pipe[0], output = ends_of_pipe[1];
    fcntl(input, F_SETFD, FD_CLOEXEC);
    fcntl(output, F_SETFD, FD_CLOEXEC);
    fcntl(fileno(messages), F_SETFD, FD_CLOEXEC); /* adddup2 gives the program a copy */
#ifdef F_SETPIPE_SZ
    fcntl(output, F_SETPIPE_SZ, PIPE_BYTES); /* fewer changes between the two; without it all works, too */
#endif
    const int wrong = spawn(child, argv, input, fileno(messages));
    close(input);
    if (wrong) {
        close(output);
        return wrong;
    }
    fcntl(output, F_SETFL, O_NONBLOCK);
    child->pipe = output;
    return 0;
}

long process_feed(process_child *child, const void *bytes, size_t size)
{
    const ssize_t written = write((int)child->pipe, bytes, size);
    if (written >= 0)
        return (long)written;
    if (errno == EINTR)
        return 0;
    if (errno != EAGAIN)
        return -1;
    struct pollfd room = {.fd = (int)child->pipe, .events = POLLOUT};
    poll(&room, 1, PIPE_WAIT_MS);
    return 0;
}

void process_close_pipe(process_child *child)
{
    if (child->pipe >= 0)
        close((int)child->pipe);
    child->pipe = -1;
}

void process_kill(process_child *child) { kill((pid_t)child->process, SIGKILL); }
void process_interrupt(process_child *child) { kill((pid_t)child->process, SIGTERM); }

int process_has_ended(process_child *child, int wait, int *code, char *reason, size_t reason_size)
{
    int status = 0;
    const pid_t ended = waitpid((pid_t)child->process, &status, wait ? 0 : WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR))
        return 0;
    *code = ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (ended < 0)
        snprintf(reason, reason_size, "how it ended is not known: %s", strerror(errno));
    else if (WIFSIGNALED(status))
        snprintf(reason, reason_size, "it was ended by a signal: %s", strsignal(WTERMSIG(status)));
    child->process = -1;
    return 1;
}
