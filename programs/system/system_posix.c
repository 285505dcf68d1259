/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What systems do differently, on POSIX; see system.h. What Linux alone has is within #ifdef. */
#define _GNU_SOURCE      /* fopencookie, sched_getaffinity */
#define _DARWIN_C_SOURCE /* funopen */
#include "system/system.h"

#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#ifdef __linux__
#include <sched.h>
#endif

void system_begin(void) {}

/* ---- Files -------------------------------------------------------------------------------------------------- */

int system_make_folder(const char *path) { return mkdir(path, 0777); }

int system_is_separator(char c) { return c == '/'; }

int system_replace(const char *from, const char *to) { return rename(from, to); }

long system_read_link(const char *path, char *target, size_t size) { return (long)readlink(path, target, size); }

FILE *system_temporary(void) { return tmpfile(); }

typedef struct stream_source {
    system_reader *read;
    void *input;
} stream_source;

static int close_source(void *cookie)
{
    free(cookie);
    return 0;
}

#if defined(__APPLE__) || defined(__FreeBSD__) || defined(__NetBSD__) || defined(__OpenBSD__)
static int read_source(void *cookie, char *bytes, int size)
{
    const stream_source *const source = cookie;
    return (int)source->read(source->input, bytes, (size_t)size);
}

static FILE *open_source(stream_source *source) { return funopen(source, read_source, NULL, NULL, close_source); }
#else
static ssize_t read_source(void *cookie, char *bytes, size_t size)
{
    const stream_source *const source = cookie;
    return source->read(source->input, bytes, size);
}

static FILE *open_source(stream_source *source)
{
    const cookie_io_functions_t functions = {.read = read_source, .close = close_source};
    return fopencookie(source, "rb", functions);
}
#endif

FILE *system_open_reader(system_reader *read, void *input)
{
    stream_source *const source = malloc(sizeof *source);
    if (!source)
        return NULL;
    *source = (stream_source){read, input};
    FILE *const stream = open_source(source);
    if (!stream)
        free(source);
    return stream;
}

int system_own_path(char *path, size_t size)
{
    const ssize_t length = readlink("/proc/self/exe", path, size); /* Linux's; elsewhere there is no such file */
    if (length <= 0 || (size_t)length == size)
        return -1;
    path[length] = '\0';
    return 0;
}

/* ---- Modules ------------------------------------------------------------------------------------------------ */

void *system_load(const char *file, const char *symbol, char *error, size_t error_size)
{
    void *const module = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    void *const address = module ? dlsym(module, symbol) : NULL;
    if (!address)
        snprintf(error, error_size, "%s", dlerror());
    return address;
}

/* ---- The machine -------------------------------------------------------------------------------------------- */

uint32_t system_cpus(void)
{
#ifdef __linux__
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return (uint32_t)CPU_COUNT(&set);
#endif
    const long cpus = sysconf(_SC_NPROCESSORS_ONLN);
    return cpus > 0 ? (uint32_t)cpus : 0;
}

uint64_t system_memory(void)
{
#ifdef _SC_PHYS_PAGES
    const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
    return pages > 0 && bytes > 0 ? (uint64_t)pages * (uint64_t)bytes : 0;
#else
    return 0;
#endif
}

void *system_allocate_aligned(size_t alignment, size_t bytes)
{
    void *memory = NULL;
    return posix_memalign(&memory, alignment, bytes) == 0 ? memory : NULL;
}

void system_free_aligned(void *memory) { free(memory); }
