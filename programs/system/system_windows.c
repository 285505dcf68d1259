/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What systems do differently, on Windows; see system.h. Names of files are those of the system's code page. */
#include "system/system.h"

#include <direct.h>
#include <errno.h>
#include <io.h>
#include <malloc.h>
#include <pthread.h>
#include <string.h>
#include <sys/stat.h>
#include <windows.h>

void system_begin(void)
{
    _fmode = _O_BINARY;
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);
    _setmode(_fileno(stderr), _O_BINARY);
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

int system_make_folder(const char *path) { return _mkdir(path); }

int system_is_separator(char c) { return c == '/' || c == '\\'; }

int system_replace(const char *from, const char *to)
{
    if (MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING))
        return 0;
    errno = GetLastError() == ERROR_ACCESS_DENIED ? EACCES : EIO;
    return -1;
}

long system_read_link(const char *path, char *target, size_t size)
{
    (void)path, (void)target, (void)size;
    return -1;
}

/* tmpfile makes its files in the root of the drive, where users may not. */
FILE *system_temporary(void)
{
    char folder[MAX_PATH + 1], name[MAX_PATH + 1];
    const DWORD length = GetTempPathA(sizeof folder, folder);
    if (length == 0 || length > MAX_PATH || !GetTempFileNameA(folder, "cgt", 0, name)) {
        errno = EACCES;
        return NULL;
    }
    const int file = _open(name, _O_RDWR | _O_BINARY | _O_TEMPORARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
    FILE *const stream = file >= 0 ? _fdopen(file, "w+b") : NULL;
    if (!stream && file >= 0)
        _close(file);
    return stream;
}

FILE *system_open_reader(system_reader *read, void *input)
{
    (void)read, (void)input;
    errno = ENOSYS;
    return NULL;
}

int system_own_path(char *path, size_t size)
{
    const DWORD length = GetModuleFileNameA(NULL, path, (DWORD)size);
    return length > 0 && length < size ? 0 : -1;
}

/* ---- Modules ------------------------------------------------------------------------------------------------ */

void *system_load(const char *file, const char *symbol, char *error, size_t error_size)
{
    (void)symbol;
    snprintf(error, error_size, "%s: there are no modules for Windows", file);
    return NULL;
}

/* ---- The machine -------------------------------------------------------------------------------------------- */

uint32_t system_cpus(void)
{
    const int cpus = pthread_num_processors_np(); /* of the process' affinity */
    return cpus > 0 ? (uint32_t)cpus : 0;
}

uint64_t system_memory(void)
{
    MEMORYSTATUSEX status = {.dwLength = sizeof status};
    return GlobalMemoryStatusEx(&status) ? status.ullTotalPhys : 0;
}

void *system_allocate_aligned(size_t alignment, size_t bytes) { return _aligned_malloc(bytes, alignment); }

void system_free_aligned(void *memory) { _aligned_free(memory); }
