/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Writes .frames. The number of frames is known only at the end, so it is 0 until close fills it in: an incomplete file
 * cannot pass for a whole one. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include <cgt/trajectory.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAMES_AT 12 /* offset of the number of frames */
#define CHUNK 4096u  /* numbers encoded in one step */

struct cgt_trajectory_writer {
    FILE *file;
    char *path;
    cgt_trajectory_kind kind;
    uint32_t needed; /* vertices that the index refers to */
    uint32_t frames;
    int is_finished;
    cgt_result error; /* CGT_OK: none */
    char message[1024];
};

static int fail(cgt_trajectory_writer *w, cgt_result result, const char *path, const char *reason)
{
    if (w->error == CGT_OK) { /* the first error is the cause of the others */
        snprintf(w->message, sizeof w->message, "%.700s: %s", path, reason);
        w->error = result;
    }
    return -1;
}

static int refuse(cgt_trajectory_writer *w, const char *reason) { return fail(w, CGT_ERROR_FILE, w->path, reason); }

static int fail_errno(cgt_trajectory_writer *w) { return refuse(w, strerror(errno != 0 ? errno : EIO)); }

size_t cgt_trajectory_writer_get_error_message(const cgt_trajectory_writer *w, char *text, size_t size)
{
    const char *const message = w != NULL ? w->message : "not enough memory for a writer";
    if (text != NULL && size > 0)
        snprintf(text, size, "%s", message);
    return strlen(message);
}

static void u32_to_bytes(uint32_t value, unsigned char *bytes)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(value >> (8 * i));
}

static int write_bytes(cgt_trajectory_writer *w, const void *bytes, size_t size)
{
    errno = 0;
    return fwrite(bytes, 1, size, w->file) == size ? 0 : fail_errno(w);
}

static int write_u32(cgt_trajectory_writer *w, uint32_t value)
{
    unsigned char bytes[4];
    u32_to_bytes(value, bytes);
    return write_bytes(w, bytes, sizeof bytes);
}

/* Writes 32-bit numbers, floats or integers. */
static int write_numbers(cgt_trajectory_writer *w, const void *values, size_t count)
{
    unsigned char bytes[4 * CHUNK];
    for (size_t done = 0; done < count;) {
        const size_t part = count - done < CHUNK ? count - done : CHUNK;
        for (size_t i = 0; i < part; i++) {
            uint32_t bits;
            memcpy(&bits, (const unsigned char *)values + 4 * (done + i), sizeof bits);
            u32_to_bytes(bits, bytes + 4 * i);
        }
        if (write_bytes(w, bytes, 4 * part))
            return -1;
        done += part;
    }
    return 0;
}

/* Opens the file and writes the header. */
static int start(cgt_trajectory_writer *w, const double origin[3], uint32_t triangles)
{
    static const double nowhere[3];
    const uint32_t has_origin = origin != NULL && memcmp(origin, nowhere, sizeof nowhere) != 0;
    for (int axis = 0; axis < 3 && has_origin; axis++)
        if (!isfinite(origin[axis]))
            return fail(w, CGT_ERROR_INVALID_ARGUMENT, w->path, "the origin must be finite");
    errno = 0;
    w->file = fopen(w->path, "wb");
    if (w->file == NULL)
        return fail_errno(w);
    if (fseeko(w->file, 0, SEEK_CUR) != 0)
        return refuse(w, "cannot hold .frames: the number of frames has to be written at the end, into the header");
    if (write_bytes(w, "CGTFRAM1", 8) || write_u32(w, (uint32_t)w->kind) || write_u32(w, 0) ||
        write_u32(w, triangles) || write_u32(w, has_origin))
        return -1;
    for (int axis = 0; axis < 3 && has_origin; axis++) {
        uint64_t bits;
        memcpy(&bits, &origin[axis], sizeof bits);
        if (write_u32(w, (uint32_t)bits) || write_u32(w, (uint32_t)(bits >> 32)))
            return -1;
    }
    return 0;
}

/* Sets the number of vertices that the index needs. */
static int check_index(cgt_trajectory_writer *w, const uint32_t *index, uint32_t triangles)
{
    for (size_t i = 0; i < 3 * (size_t)triangles; i++) {
        if (index[i] == UINT32_MAX)
            return refuse(w, "an index of a triangle is out of range");
        w->needed = index[i] >= w->needed ? index[i] + 1 : w->needed;
    }
    return 0;
}

static cgt_result open_writer(const char *path, cgt_trajectory_kind kind, const double origin[3], const uint32_t *index,
                              uint32_t triangles, cgt_trajectory_writer **writer)
{
    cgt_trajectory_writer *w = *writer = calloc(1, sizeof *w);
    if (w == NULL)
        return CGT_ERROR_OUT_OF_MEMORY;
    w->kind = kind;
    w->path = strdup(path);
    if (w->path == NULL)
        fail(w, CGT_ERROR_OUT_OF_MEMORY, path, "not enough memory");
    else if (check_index(w, index, triangles) == 0 && start(w, origin, triangles) == 0)
        write_numbers(w, index, 3 * (size_t)triangles);
    return w->error;
}

cgt_result cgt_trajectory_writer_open(const char *path, const double origin[3], cgt_trajectory_writer **w)
{
    return open_writer(path, CGT_TRAJECTORY_SPHERES, origin, NULL, 0, w);
}

cgt_result cgt_trajectory_writer_open_triangles(const char *path, const double origin[3], const uint32_t *index,
                                                uint32_t triangles, cgt_trajectory_writer **w)
{
    return open_writer(path, CGT_TRAJECTORY_TRIANGLES, origin, index, triangles, w);
}

/* Adds a frame of `count` items of `floats` numbers each. */
static cgt_result add_frame(cgt_trajectory_writer *w, cgt_trajectory_kind kind, const float *values, size_t floats,
                            uint32_t count)
{
    if (w == NULL)
        return CGT_ERROR_OUT_OF_MEMORY;
    if (w->error != CGT_OK)
        return w->error;
    if (w->is_finished)
        refuse(w, "the file is complete");
    else if (kind != w->kind)
        refuse(w, w->kind == CGT_TRAJECTORY_SPHERES ? "a file of spheres cannot hold vertices"
                                                    : "a file of triangles cannot hold spheres");
    else if (count < w->needed)
        refuse(w, "a frame has fewer vertices than its triangles need");
    else if (w->frames == UINT32_MAX)
        refuse(w, "more than 4294967295 frames");
    else if (write_u32(w, count) == 0 && write_numbers(w, values, floats * count) == 0)
        w->frames++;
    return w->error;
}

cgt_result cgt_trajectory_writer_add(cgt_trajectory_writer *w, const float *xyzr, uint32_t count)
{
    return add_frame(w, CGT_TRAJECTORY_SPHERES, xyzr, 4, count);
}

cgt_result cgt_trajectory_writer_add_vertices(cgt_trajectory_writer *w, const float *xyz, uint32_t count)
{
    return add_frame(w, CGT_TRAJECTORY_TRIANGLES, xyz, 3, count);
}

cgt_result cgt_trajectory_writer_finish(cgt_trajectory_writer *w)
{
    if (w == NULL)
        return CGT_ERROR_OUT_OF_MEMORY;
    if (w->error != CGT_OK || w->is_finished)
        return w->error;
    errno = 0;
    if (fseeko(w->file, FRAMES_AT, SEEK_SET) != 0)
        fail_errno(w);
    else
        write_u32(w, w->frames);
    errno = 0;
    if (fclose(w->file) != 0)
        fail_errno(w);
    w->file = NULL;
    w->is_finished = 1;
    return w->error;
}

void cgt_trajectory_writer_close(cgt_trajectory_writer *w)
{
    if (w == NULL)
        return;
    if (w->file != NULL)
        fclose(w->file);
    free(w->path);
    free(w);
}
