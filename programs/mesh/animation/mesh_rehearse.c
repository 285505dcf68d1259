/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A file is first read by a child process: assimp 5.2 crashes on some files (a glTF skin without matrices), aborts on
 * others, and never returns from a few. Then the child dies, and the program reports an error. The price is reading
 * twice; files are read once per run. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <assimp/cimport.h>

#define SECONDS_LEAST 60u        /* granted to any file, however small */
#define BYTES_PER_SECOND 500000u /* granted for its size; files are read at some megabytes a second */
#define SECONDS_MOST 86400u

static unsigned seconds_for(uint64_t bytes)
{
    const uint64_t seconds = SECONDS_LEAST + bytes / BYTES_PER_SECOND;
    return (unsigned)(seconds < SECONDS_MOST ? seconds : SECONDS_MOST);
}

/* The child: reads the file and exits silently. */
_Noreturn static void rehearse(cgt_trajectory *t)
{
    static const int fatal[] = {SIGALRM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
    const struct rlimit no_core = {0, 0};
    for (size_t i = 0; i < sizeof fatal / sizeof fatal[0]; i++)
        signal(fatal[i], SIG_DFL);
    setrlimit(RLIMIT_CORE, &no_core);
    const int null_device = open("/dev/null", O_WRONLY);
    if (null_device >= 0) {
        dup2(null_device, STDERR_FILENO);
        dup2(null_device, STDOUT_FILENO);
    }
    alarm(seconds_for(t->file_size));
    mesh_model model = {.scene = NULL};
    mesh_import_scene(t, &model);
    _exit(0); /* the second reading will find and report any error */
}

int mesh_rehearse(cgt_trajectory *t)
{
    const pid_t child = fork();
    if (child < 0)
        return trajectory_fail(t, 0, "no process to read it with: %s", strerror(errno));
    if (child == 0)
        rehearse(t);
    int status = 0;
    pid_t waited;
    do {
        waited = waitpid(child, &status, 0);
    } while (waited < 0 && errno == EINTR);
    if (waited < 0)
        return 1; /* the program that reads ignores or collects its child processes: the outcome is unknown */
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return trajectory_fail(t, 0, "assimp did not come back from this file within %u s", seconds_for(t->file_size));
    if (WIFSIGNALED(status))
        return trajectory_fail(t, 0, "assimp cannot read this file: it died of signal %d", WTERMSIG(status));
    if (WEXITSTATUS(status) != 0)
        return trajectory_fail(t, 0, "assimp cannot read this file: it ended with status %d", WEXITSTATUS(status));
    return 1;
}
