/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * LD_PRELOAD=libcgt_cpus.so CGT_TEST_CPUS=N command: the command finds N processors, so that what shares work among all
 * of them is tested as on larger machines. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

long sysconf(int name)
{
    long (*next)(int);
    void *const symbol = dlsym(RTLD_NEXT, "sysconf");
    const char *const cpus = getenv("CGT_TEST_CPUS");
    if (name == _SC_NPROCESSORS_ONLN && cpus)
        return strtol(cpus, NULL, 10);
    memcpy(&next, &symbol, sizeof next);
    return next(name);
}
