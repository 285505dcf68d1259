/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Files for assimp, by stdio. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

static FILE *stream_of(struct aiFile *file) { return (FILE *)(void *)file->UserData; }

static size_t read_file(struct aiFile *file, char *bytes, size_t size, size_t count)
{
    return fread(bytes, size, count, stream_of(file));
}

static size_t write_nothing(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
    (void)file, (void)bytes, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    const off_t at = ftello(stream_of(file));
    return at < 0 ? 0 : (size_t)at;
}

static size_t size_of(struct aiFile *file)
{
    struct stat status;
    return fstat(fileno(stream_of(file)), &status) == 0 ? (size_t)status.st_size : 0;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    static const int whence[] = {SEEK_SET, SEEK_CUR, SEEK_END};
    return fseeko(stream_of(file), (off_t)offset, whence[origin]) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static void flush_nothing(struct aiFile *file) { (void)file; }

static struct aiFile *open_file(struct aiFileIO *files, const char *path, const char *mode)
{
    mesh_opened *const opened = (mesh_opened *)(void *)files->UserData;
    struct stat status;
    if (mode[0] != 'r' || !trajectory_input_is_beside(opened->t->path, path) || stat(path, &status) != 0 ||
        !S_ISREG(status.st_mode))
        return NULL;
    struct aiFile *const file = malloc(sizeof *file);
    FILE *const stream = fopen(path, "rb");
    if (file == NULL || stream == NULL) {
        free(file);
        if (stream != NULL)
            fclose(stream);
        return NULL;
    }
    opened->bytes += (uint64_t)status.st_size;
    *file = (struct aiFile){read_file, write_nothing, tell, size_of, seek, flush_nothing, (char *)(void *)stream};
    return file;
}

static void close_file(struct aiFileIO *files, struct aiFile *file)
{
    (void)files;
    fclose(stream_of(file));
    free(file);
}

struct aiFileIO mesh_files(mesh_opened *opened)
{
    return (struct aiFileIO){open_file, close_file, (char *)(void *)opened};
}
