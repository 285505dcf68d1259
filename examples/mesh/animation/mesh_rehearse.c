/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A file is first read by a process of its own: assimp 5.2 crashes on some files (a glTF skin without matrices), ends
 * the program on others, and on a few never comes back. Then that process is gone, and there is an error instead. It
 * costs the time of reading again; files are read once per run. */
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

#define SECONDS_LEAST 60u        /* that the file may take, however small it is */
#define BYTES_PER_SECOND 500000u /* and for its size; files are read at some megabytes a second */
#define SECONDS_MOST 86400u

static unsigned seconds_for(uint64_t bytes)
{
    const uint64_t seconds = SECONDS_LEAST + bytes / BYTES_PER_SECOND;
    return (unsigned)(seconds < SECONDS_MOST ? seconds : SECONDS_MOST);
}

/* In the process of its own: reads the file and ends, in silence. */
_Noreturn static void rehearse(trajectory *t)
{
    static const int deadly[] = {SIGALRM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
    const struct rlimit no_core = {0, 0};
    for (size_t i = 0; i < sizeof deadly / sizeof deadly[0]; i++) {
        signal(deadly[i], SIG_DFL);
    }
    setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) {
        dup2(nowhere, STDERR_FILENO);
        dup2(nowhere, STDOUT_FILENO);
    }
    alarm(seconds_for(t->file_size));
    mesh_model model = {.scene = NULL};
    mesh_import_scene(t, &model);
    _exit(0); /* an error is one that the second reading will meet and word */
}

int mesh_rehearse(trajectory *t)
{
    const pid_t child = fork();
    if (child < 0) {
        return trajectory_fail(t, 0, "no process to read it with: %s", strerror(errno));
    }
    if (child == 0) {
        rehearse(t);
    }
    int status = 0;
    pid_t done;
    do {
        done = waitpid(child, &status, 0);
    } while (done < 0 && errno == EINTR);
    if (done < 0) {
        return 1; /* someone else collects this program's processes: what this one met is not known */
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
        return trajectory_fail(t, 0, "assimp did not come back from this file within %u s", seconds_for(t->file_size));
    }
    if (WIFSIGNALED(status)) {
        return trajectory_fail(t, 0, "assimp cannot read this file: it died of signal %d", WTERMSIG(status));
    }
    if (WEXITSTATUS(status) != 0) {
        return trajectory_fail(t, 0, "assimp cannot read this file: it ended with status %d", WEXITSTATUS(status));
    }
    return 1;
}
