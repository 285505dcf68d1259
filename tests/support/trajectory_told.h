/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls of cgt/trajectory.h with their messages: tests look at both. What could not be opened is closed again. Each
 * returns 1 and 0 as there is a frame or an end, what has no frames 0, and -1 with the message. */
#ifndef TRAJECTORY_TOLD_H
#define TRAJECTORY_TOLD_H

#include "trajectory/trajectory_status.h"

static inline cgt_trajectory *told_opened(cgt_trajectory *t, cgt_result result, char *error, size_t size)
{
    if (trajectory_failed(t, result, error, size) == 0)
        return t;
    cgt_trajectory_close(t);
    return NULL;
}

static inline cgt_trajectory *told_open(const char *path, const cgt_trajectory_options *options, char *error,
                                        size_t size)
{
    cgt_trajectory *t;
    const cgt_result result = cgt_trajectory_open(path, options, &t);
    return told_opened(t, result, error, size);
}

static inline cgt_trajectory *told_open_series(const char *const *paths, size_t count,
                                               const cgt_trajectory_options *options, char *error, size_t size)
{
    cgt_trajectory *t;
    const cgt_result result = cgt_trajectory_open_series(paths, count, options, &t);
    return told_opened(t, result, error, size);
}

static inline int told_read(cgt_trajectory *t, cgt_trajectory_frame *frame, char *error, size_t size)
{
    return trajectory_status(t, cgt_trajectory_read(t, frame), error, size);
}

static inline int told_skip(cgt_trajectory *t, char *error, size_t size)
{
    return trajectory_status(t, cgt_trajectory_skip(t), error, size);
}

static inline int told_rewind(cgt_trajectory *t, char *error, size_t size)
{
    return trajectory_failed(t, cgt_trajectory_rewind(t), error, size);
}

static inline int told_count_frames(cgt_trajectory *t, uint64_t *frames, char *error, size_t size)
{
    return trajectory_failed(t, cgt_trajectory_count_frames(t, frames), error, size);
}

static inline int told_want_columns(cgt_trajectory *t, const char *const *names, size_t count, char *error, size_t size)
{
    return trajectory_failed(t, cgt_trajectory_want_columns(t, names, count), error, size);
}

static inline int told_writer_failure(const cgt_trajectory_writer *w, cgt_result result, char *error, size_t size)
{
    if (result == CGT_OK)
        return 0;
    cgt_trajectory_writer_get_error_message(w, error, size);
    return -1;
}

static inline cgt_trajectory_writer *told_writer_opened(cgt_trajectory_writer *w, cgt_result result, char *error,
                                                        size_t size)
{
    if (told_writer_failure(w, result, error, size) == 0)
        return w;
    cgt_trajectory_writer_close(w);
    return NULL;
}

static inline cgt_trajectory_writer *told_writer_open(const char *path, const double origin[3], char *error,
                                                      size_t size)
{
    cgt_trajectory_writer *w;
    const cgt_result result = cgt_trajectory_writer_open(path, origin, &w);
    return told_writer_opened(w, result, error, size);
}

static inline cgt_trajectory_writer *told_writer_open_triangles(const char *path, const double origin[3],
                                                                const uint32_t *index, uint32_t triangles, char *error,
                                                                size_t size)
{
    cgt_trajectory_writer *w;
    const cgt_result result = cgt_trajectory_writer_open_triangles(path, origin, index, triangles, &w);
    return told_writer_opened(w, result, error, size);
}

static inline int told_writer_add(cgt_trajectory_writer *w, const float *xyzr, uint32_t count, char *error, size_t size)
{
    return told_writer_failure(w, cgt_trajectory_writer_add(w, xyzr, count), error, size);
}

static inline int told_writer_add_vertices(cgt_trajectory_writer *w, const float *xyz, uint32_t count, char *error,
                                           size_t size)
{
    return told_writer_failure(w, cgt_trajectory_writer_add_vertices(w, xyz, count), error, size);
}

/* Completes the file, and closes the writer in any case; NULL is ignored. */
static inline int told_writer_close(cgt_trajectory_writer *w, char *error, size_t size)
{
    const int failed = w ? told_writer_failure(w, cgt_trajectory_writer_finish(w), error, size) : 0;
    cgt_trajectory_writer_close(w);
    return failed;
}

#endif
