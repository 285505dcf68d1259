/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What systems do differently: files, modules, the machine. One of system_posix.c and system_windows.c is compiled. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <fcntl.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Flags of open that some systems lack, and need not have. */
#ifndef O_BINARY
#define O_BINARY 0
#endif
#ifndef O_CLOEXEC
#define O_CLOEXEC 0
#endif

/* Once, at the start of a program: bytes pass through standard input and output as they are. */
void system_begin(void);

/* ---- Files -------------------------------------------------------------------------------------------------- */

/* Makes a folder. Returns 0, or -1 with errno. */
int system_make_folder(const char *path);

int system_is_separator(char c);

/* Renames a file, in place of one that has the name. Returns 0, or -1 with errno. */
int system_replace(const char *from, const char *to);

/* The target of a symbolic link as it is written, without an end: its length, at most size; negative: no link. */
long system_read_link(const char *path, char *target, size_t size);

/* A file without a name that is gone when it is closed; NULL with errno. */
FILE *system_temporary(void);

/* As read(2). */
typedef long system_reader(void *input, char *bytes, size_t size);

/* A stream that gets its bytes by `read`, and cannot seek. NULL with errno: ENOSYS where the system has none such. */
FILE *system_open_reader(system_reader *read, void *input);

/* This program's own path. Returns 0, or -1: it is not known, or too long. */
int system_own_path(char *path, size_t size);

/* ---- Modules ------------------------------------------------------------------------------------------------ */

/* Loads a module for good and returns the address of a symbol of it; NULL with a sentence. */
void *system_load(const char *file, const char *symbol, char *error, size_t error_size);

/* ---- The machine -------------------------------------------------------------------------------------------- */

/* CPUs that this process may use; 0: not known. */
uint32_t system_cpus(void);

/* Bytes of main memory; 0: not known. */
uint64_t system_memory(void);

/* Memory for vectors: bytes are a multiple of alignment. NULL: there is none. */
void *system_allocate_aligned(size_t alignment, size_t bytes);
void system_free_aligned(void *memory);

#endif
