/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scratch files for the tests of the trajectory readers, and expectations about whole files.
 * Files lie in TMPDIR, on Windows in TEMP; scratch_teardown removes them, after a failed test as well. */
#ifndef TRAJECTORY_SCRATCH_H
#define TRAJECTORY_SCRATCH_H

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cgt/trajectory.h>

#include "support/trajectory_told.h"

#define SUITE_TEARDOWN scratch_teardown /* after each test */
#include "support/suite.h"

/* What the readers say, a line each, to the file that CGT_TEST_MESSAGES names: tests/readers/messages.sh looks whether
 * the tests bring out every sentence. */
static inline const char *scratch_note(const char *text)
{
    const char *const path = getenv("CGT_TEST_MESSAGES");
    FILE *const file = path != NULL && text != NULL && *text != '\0' ? fopen(path, "a") : NULL;
    if (file != NULL) {
        fprintf(file, "%s\n", text);
        fclose(file);
    }
    return text;
}

static inline int scratch_note_status(int status, const char *error)
{
    scratch_note(status < 0 ? error : NULL);
    return status;
}

static inline cgt_trajectory *scratch_note_open(cgt_trajectory *t, const char *error)
{
    scratch_note(t == NULL ? error : NULL);
    return t;
}

static inline cgt_trajectory_writer *scratch_note_writer(cgt_trajectory_writer *w, const char *error)
{
    scratch_note(w == NULL ? error : NULL);
    return w;
}

static inline void scratch_close(cgt_trajectory *t)
{
    while (t != NULL && scratch_note(cgt_trajectory_take_warning(t)) != NULL)
        continue;
    cgt_trajectory_close(t);
}

#define told_open(path, options, error, size) scratch_note_open((told_open)(path, options, error, size), error)
#define told_open_series(paths, count, options, error, size)                                                           \
    scratch_note_open((told_open_series)(paths, count, options, error, size), error)
#define told_read(t, frame, error, size) scratch_note_status((told_read)(t, frame, error, size), error)
#define told_skip(t, error, size) scratch_note_status((told_skip)(t, error, size), error)
#define told_rewind(t, error, size) scratch_note_status((told_rewind)(t, error, size), error)
#define told_want_columns(t, names, count, error, size)                                                                \
    scratch_note_status((told_want_columns)(t, names, count, error, size), error)
#define told_writer_add(w, xyzr, count, error, size)                                                                   \
    scratch_note_status((told_writer_add)(w, xyzr, count, error, size), error)
#define told_writer_add_vertices(w, xyz, count, error, size)                                                           \
    scratch_note_status((told_writer_add_vertices)(w, xyz, count, error, size), error)
#define told_writer_open(path, origin, error, size)                                                                    \
    scratch_note_writer((told_writer_open)(path, origin, error, size), error)
#define told_writer_open_triangles(path, origin, index, triangles, error, size)                                        \
    scratch_note_writer((told_writer_open_triangles)(path, origin, index, triangles, error, size), error)
#define cgt_trajectory_take_warning(t) scratch_note((cgt_trajectory_take_warning)(t))
#define cgt_trajectory_close(t) scratch_close(t)

#define SCRATCH_MOST 8
static char scratch_paths[SCRATCH_MOST][512];
static int scratch_count;
static cgt_trajectory *scratch_open_one; /* closed by the teardown */

static int scratch_teardown(void **state)
{
    (void)state;
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = NULL;
    for (int i = 0; i < scratch_count; i++)
        unlink(scratch_paths[i]);
    scratch_count = 0;
    return 0;
}

/* Makes an empty file with the given ending and returns its path. Tests that need many reuse files in turn. */
static inline const char *scratch_path(const char *ending)
{
    if (scratch_count == SCRATCH_MOST)
        scratch_teardown(NULL);
    char *path = scratch_paths[scratch_count];
    static unsigned number;
    int descriptor;
    const char *folder = getenv("TMPDIR");
    if (folder == NULL)
        folder = getenv("TEMP");
    do {
        snprintf(path, sizeof scratch_paths[0], "%s/cgt-test-%ld-%u%s", folder != NULL ? folder : P_tmpdir,
                 (long)getpid(), number++, ending);
        descriptor = open(path, O_CREAT | O_EXCL | O_RDWR, 0600);
    } while (descriptor < 0 && errno == EEXIST);
    assert_true(descriptor >= 0);
    close(descriptor);
    scratch_count++;
    return path;
}

/* In place of the file that is there: some file systems write one that was cut to nothing to the disk when it is
 * closed, which took most of the time of tests with many files. */
static inline void scratch_fill(const char *path, const void *bytes, size_t size)
{
    unlink(path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline const char *scratch_bytes(const char *ending, const void *bytes, size_t size)
{
    const char *path = scratch_path(ending);
    scratch_fill(path, bytes, size);
    return path;
}

static inline const char *scratch_text(const char *ending, const char *text)
{
    return scratch_bytes(ending, text, strlen(text));
}

/* Opens a file; fails the test on an error. */
static inline cgt_trajectory *scratch_open(const char *path, const cgt_trajectory_options *options)
{
    char error[1024] = "";
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = told_open(path, options, error, sizeof error);
    if (scratch_open_one == NULL)
        fail_msg("not opened: %s", error);
    return scratch_open_one;
}

/* Names columns that later frames have to hold. */
static inline void scratch_want(cgt_trajectory *t, const char *const *names, size_t count)
{
    char error[1024] = "";
    assert_int_equal(told_want_columns(t, names, count, error, sizeof error), 0);
}

/* Reads a frame; fails the test without one. */
static inline cgt_trajectory_frame scratch_read(cgt_trajectory *t)
{
    char error[1024] = "";
    cgt_trajectory_frame frame;
    const int got = told_read(t, &frame, error, sizeof error);
    if (got != 1)
        fail_msg("no frame: %d %s", got, error);
    return frame;
}

static inline void scratch_expect_end(cgt_trajectory *t)
{
    char error[1024] = "";
    cgt_trajectory_frame frame;
    assert_int_equal(told_read(t, &frame, error, sizeof error), 0);
    assert_int_equal(told_read(t, &frame, error, sizeof error), 0);
}

static inline void scratch_expect_sphere(const cgt_trajectory_frame *frame, uint32_t i, float x, float y, float z,
                                         float r)
{
    const float wanted[4] = {x, y, z, r};
    assert_true(i < frame->count);
    for (int k = 0; k < 4; k++) {
        if (frame->xyzr[4 * i + (uint32_t)k] != wanted[k])
            fail_msg("sphere %u, value %d: %.9g, not %.9g", i, k, (double)frame->xyzr[4 * i + (uint32_t)k],
                     (double)wanted[k]);
    }
}

/* After `frames` complete frames, or already when opened, the file is refused with a message that begins with its path
 * and contains `what`; a repeated call gives the same message. */
static inline void scratch_expect_error(const char *path, const cgt_trajectory_options *options, unsigned frames,
                                        const char *what)
{
    char error[1024] = "", again[1024] = "";
    cgt_trajectory_frame frame;
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = told_open(path, options, error, sizeof error);
    cgt_trajectory *t = scratch_open_one;
    if (t != NULL) {
        for (unsigned i = 0; i < frames; i++)
            scratch_read(t);
        if (told_read(t, &frame, error, sizeof error) != -1)
            fail_msg("no error where \"%s\" was expected", what);
        assert_int_equal(told_read(t, &frame, again, sizeof again), -1);
        assert_string_equal(error, again);
        assert_int_equal(told_skip(t, again, sizeof again), -1);
    }
    if (strncmp(error, path, strlen(path)) != 0 || strstr(error + strlen(path), what) == NULL)
        fail_msg("the error \"%s\" lacks its path or \"%s\"", error, what);
}

/* Cut off after each byte in turn: whole frames are read, then the end where nothing is missing, else an error. ends:
 * of each frame, its line feed included; steps count from 0. */
static inline void scratch_expect_cuts(const char *ending, const char *text, unsigned frames, const size_t *ends,
                                       const uint32_t *counts)
{
    const char *path = scratch_path(ending);
    for (size_t size = 0; size <= strlen(text); size++) {
        unsigned whole = 0; /* with or without its last line feed */
        while (whole < frames && size + 1 >= ends[whole])
            whole++;
        const int clean = size == 0 || (whole > 0 && size <= ends[whole - 1]);
        scratch_fill(path, text, size);
        if (!clean) {
            scratch_expect_error(path, NULL, whole, ":");
            continue;
        }
        cgt_trajectory *t = scratch_open(path, NULL);
        for (unsigned i = 0; i < whole; i++) {
            const cgt_trajectory_frame f = scratch_read(t);
            assert_true(f.step == i && f.count == counts[i]);
        }
        scratch_expect_end(t);
    }
}

/* ---- .frames, byte by byte ----------------------------------------------------------------------------------- */

static inline void scratch_put_u32(unsigned char *bytes, size_t at, uint32_t value)
{
    for (size_t i = 0; i < 4; i++)
        bytes[at + i] = (unsigned char)(value >> (8 * i));
}

/* A value that makes a file invalid at this offset, and the error after `frames` frames. */
typedef struct scratch_change {
    size_t at;
    uint32_t value;
    unsigned frames;
    const char *what;
} scratch_change;

/* Each change by itself makes a valid .frames file invalid. */
static inline void scratch_expect_errors(const unsigned char *good, size_t size, const scratch_change *changes,
                                         size_t count)
{
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    for (size_t i = 0; i < count; i++) {
        memcpy(bytes, good, size);
        scratch_put_u32(bytes, changes[i].at, changes[i].value);
        scratch_expect_error(scratch_bytes(".frames", bytes, size), NULL, changes[i].frames, changes[i].what);
    }
    free(bytes);
}

#endif
