/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where trajectories come from: names, compressed files, series, pipes, files that grow. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <time.h>

#include "common/stop_flag.h"
#include "readers/trajectory_scratch.h"
#include "trajectory/trajectory_input.h"

static const char plain[] = "1\nfirst\nC 1 2 3\n1\nsecond\nO 4 5 6\n";

static void expect_plain(cgt_trajectory *t)
{
    cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 1.7f);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 4, 5, 6, 1.52f);
    scratch_expect_end(t);
}

static cgt_trajectory_options named(const char *format)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.format = format;
    return options;
}

TEST(any_name_with_a_format)
{
    static const char *const formats[] = {"xyz", "XYZ", "extxyz"};
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const cgt_trajectory_options options = named(formats[i]);
        expect_plain(scratch_open(scratch_text(".100.txt", plain), &options));
    }
    static const char *const wrong[] = {"", "odd", "xyz.gz", "a name that is much longer than any of an ending"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const cgt_trajectory_options options = named(wrong[i]);
        scratch_expect_error(scratch_text(".xyz", plain), &options, 0, "the format is not one of lammps, ");
    }
    const cgt_trajectory_options lammps = named("lammps");
    scratch_expect_error(scratch_text(".xyz", plain), &lammps, 0, ":1: '1' is not a section");
}

/* ---- Compressed files --------------------------------------------------------------------------------------- */

/* The text above, by gzip, zstd, xz and bzip2. */
/* clang-format off */
static const unsigned char by_gzip[] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x03, 0x33, 0xe4, 0x4a, 0xcb, 0x2c, 0x2a, 0x2e, 0xe1,
    0x72, 0x56, 0x30, 0x54, 0x30, 0x52, 0x30, 0xe6, 0x32, 0xe4, 0x2a, 0x4e, 0x4d, 0xce, 0xcf, 0x4b, 0xe1, 0xf2,
    0x57, 0x30, 0x51, 0x30, 0x55, 0x30, 0xe3, 0x02, 0x00, 0x3a, 0x61, 0x83, 0xf4, 0x21, 0x00, 0x00, 0x00,
};
static const unsigned char by_zstd[] = {
    0x28, 0xb5, 0x2f, 0xfd, 0x24, 0x21, 0x09, 0x01, 0x00, 0x31, 0x0a, 0x66, 0x69, 0x72, 0x73, 0x74, 0x0a, 0x43,
    0x20, 0x31, 0x20, 0x32, 0x20, 0x33, 0x0a, 0x31, 0x0a, 0x73, 0x65, 0x63, 0x6f, 0x6e, 0x64, 0x0a, 0x4f, 0x20,
    0x34, 0x20, 0x35, 0x20, 0x36, 0x0a, 0x08, 0x03, 0xc7, 0x14,
};
static const unsigned char by_xz[] = {
    0xfd, 0x37, 0x7a, 0x58, 0x5a, 0x00, 0x00, 0x04, 0xe6, 0xd6, 0xb4, 0x46, 0x02, 0x00, 0x21, 0x01, 0x16, 0x00,
    0x00, 0x00, 0x74, 0x2f, 0xe5, 0xa3, 0x01, 0x00, 0x20, 0x31, 0x0a, 0x66, 0x69, 0x72, 0x73, 0x74, 0x0a, 0x43,
    0x20, 0x31, 0x20, 0x32, 0x20, 0x33, 0x0a, 0x31, 0x0a, 0x73, 0x65, 0x63, 0x6f, 0x6e, 0x64, 0x0a, 0x4f, 0x20,
    0x34, 0x20, 0x35, 0x20, 0x36, 0x0a, 0x00, 0x00, 0x00, 0x00, 0x2e, 0xda, 0x04, 0xb5, 0xad, 0x27, 0x8c, 0x0f,
    0x00, 0x01, 0x39, 0x21, 0xcf, 0x28, 0x6b, 0x62, 0x1f, 0xb6, 0xf3, 0x7d, 0x01, 0x00, 0x00, 0x00, 0x00, 0x04,
    0x59, 0x5a,
};
static const unsigned char by_bzip2[] = {
    0x42, 0x5a, 0x68, 0x39, 0x31, 0x41, 0x59, 0x26, 0x53, 0x59, 0xbf, 0xae, 0x5a, 0x89, 0x00, 0x00, 0x06, 0x5d,
    0x80, 0x00, 0x10, 0x40, 0x00, 0x3f, 0x00, 0x08, 0x00, 0x8f, 0x21, 0x9c, 0x00, 0x20, 0x00, 0x31, 0x4c, 0x26,
    0x9a, 0x03, 0x4c, 0x41, 0xa9, 0xa0, 0xd0, 0xc8, 0x34, 0xc9, 0x7b, 0x46, 0x8c, 0x21, 0x61, 0x51, 0x50, 0x28,
    0x91, 0x0d, 0xb4, 0x51, 0x9f, 0xcf, 0x58, 0x3f, 0x8b, 0xb9, 0x22, 0x9c, 0x28, 0x48, 0x5f, 0xd7, 0x2d, 0x44,
    0x80,
};
/* clang-format on */

static const struct {
    const char *ending;
    const unsigned char *bytes;
    size_t size;
} packed[] = {{".xyz.gz", by_gzip, sizeof by_gzip},
              {".xyz.zst", by_zstd, sizeof by_zstd},
              {".xyz.xz", by_xz, sizeof by_xz},
              {".xyz.bz2", by_bzip2, sizeof by_bzip2},
              {".xyz", by_gzip, sizeof by_gzip}};
enum { PACKED = sizeof packed / sizeof packed[0] };

#ifdef CGT_HAVE_ARCHIVE
TEST(compressed_files)
{
    for (size_t i = 0; i < PACKED; i++) {
        char error[1024];
        cgt_trajectory *t = scratch_open(scratch_bytes(packed[i].ending, packed[i].bytes, packed[i].size), NULL);
        for (int pass = 0; pass < 3; pass++) {
            expect_plain(t);
            assert_true(cgt_trajectory_progress(t) == 1.0);
            assert_int_equal(told_rewind(t, error, sizeof error), 0);
        }
    }
}

/* A cut is an error, after whole frames; never other numbers, never an end of the file. */
TEST(compressed_files_that_are_cut)
{
    for (size_t i = 0; i < PACKED; i++) {
        for (size_t size = 6; size + 8 < packed[i].size; size++) {
            char error[1024] = "";
            cgt_trajectory_frame f;
            unsigned frames = 0;
            int status;
            cgt_trajectory *t = scratch_open(scratch_bytes(packed[i].ending, packed[i].bytes, size), NULL);
            while ((status = told_read(t, &f, error, sizeof error)) == 1) {
                scratch_expect_sphere(&f, 0, frames ? 4 : 1, frames ? 5 : 2, frames ? 6 : 3, frames ? 1.52f : 1.7f);
                frames++;
            }
            if (status == 0 && frames < 2)
                fail_msg("%s cut after %zu bytes: the end after %u frames", packed[i].ending, size, frames);
        }
    }
}

/* gzip around what lrzip, grzip and lzop write, and gzip around gzip: one layer is unpacked, and nothing started. */
/* clang-format off */
static const unsigned char around_lrzip[] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0xf3, 0x09, 0x8a, 0xf2, 0x64, 0x60, 0x4b, 0x24,
    0x12, 0x00, 0x00, 0x52, 0x33, 0xac, 0x74, 0x2e, 0x00, 0x00, 0x00,
};
static const unsigned char around_grzip[] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x73, 0x0f, 0x8a, 0xca, 0x2c, 0xf0, 0xf4, 0x64,
    0x60, 0x62, 0xb1, 0xd2, 0x4c, 0x24, 0x12, 0x00, 0x00, 0x85, 0xe8, 0x56, 0x69, 0x34, 0x00, 0x00, 0x00,
};
static const unsigned char around_lzop[] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0xeb, 0xf4, 0x89, 0xf2, 0x67, 0xe0, 0xe5, 0x92,
    0xe2, 0x4a, 0x24, 0x12, 0x00, 0x00, 0x17, 0xa4, 0xc9, 0xd6, 0x31, 0x00, 0x00, 0x00,
};
static const unsigned char by_gzip_twice[] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x93, 0xef, 0xe6, 0x60, 0x00, 0x01, 0x26, 0x66,
    0xe3, 0x27, 0x5e, 0xa7, 0x75, 0xb4, 0xf4, 0x1e, 0x16, 0x85, 0x19, 0x84, 0x18, 0x04, 0x19, 0x3c, 0x63, 0x62,
    0x68, 0xef, 0x97, 0xfc, 0x23, 0x00, 0x94, 0x03, 0x00, 0xf9, 0x1b, 0x62, 0x6d, 0x24, 0x00, 0x00, 0x00,
};
/* clang-format on */

TEST(no_program_is_started)
{
    static const char *const programs[] = {"lrzip", "grzip", "lzop"};
    const struct {
        const unsigned char *bytes;
        size_t size;
    } files[] = {{around_lrzip, sizeof around_lrzip},
                 {around_grzip, sizeof around_grzip},
                 {around_lzop, sizeof around_lzop},
                 {by_gzip_twice, sizeof by_gzip_twice}};
    char folder[224], path[256], mark[256], text[512], search[4096];
    const char *const now = getenv("PATH"), *const before = now ? now : "", *const scratch = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/cgt-test-XXXXXX", scratch ? scratch : P_tmpdir);
    assert_non_null(mkdtemp(folder));
    snprintf(mark, sizeof mark, "%s/ran", folder);
    snprintf(text, sizeof text, "#!/bin/sh\n: >%s\nprintf '1\\nc\\nH 0 0 0\\n'\n", mark);
    for (size_t i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, programs[i]);
        scratch_fill(path, text, strlen(text));
        assert_int_equal(chmod(path, 0700), 0);
    }
    snprintf(search, sizeof search, "%s:%s", folder, before);
    char *const kept = strdup(before);
    assert_int_equal(setenv("PATH", search, 1), 0);
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        scratch_expect_error(scratch_bytes(".xyz.gz", files[i].bytes, files[i].size), NULL, 0,
                             i < 3 ? ":1: " : "compressed twice");
    assert_int_equal(setenv("PATH", kept, 1), 0);
    free(kept);
    const int ran = access(mark, F_OK) == 0;
    unlink(mark);
    for (size_t i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, programs[i]);
        unlink(path);
    }
    rmdir(folder);
    assert_false(ran);
}

TEST(compressed_frames)
{
    const cgt_trajectory_options options = named("frames");
    scratch_expect_error(scratch_bytes(".gz", by_gzip, sizeof by_gzip), &options, 0, "not a .frames file");
}
#else
TEST(compressed_files)
{
    for (size_t i = 0; i < PACKED; i++)
        scratch_expect_error(scratch_bytes(packed[i].ending, packed[i].bytes, packed[i].size), NULL, 0,
                             "which this build cannot read: it has no libarchive");
}
#endif

/* Names that tell nothing: the first bytes do, of a pipe as well. */
TEST(formats_by_their_first_bytes)
{
    scratch_expect_error(scratch_text(".melt", "odd\n"), NULL, 0, "the first bytes are those of no format");
    scratch_expect_end(scratch_open(scratch_text("", ""), NULL)); /* no frames, whatever the format */
#ifdef CGT_HAVE_ARCHIVE
    char error[1024] = "";
    cgt_trajectory *t = scratch_open(scratch_bytes(".melt.gz", by_gzip, sizeof by_gzip), NULL);
    expect_plain(t);
    assert_int_equal(told_rewind(t, error, sizeof error), 0);
    expect_plain(t);
#endif
    int ends[2];
    for (int keep = 0; keep < 2; keep++) {
        char path[32];
        cgt_trajectory_options options;
        cgt_trajectory_options_init(&options);
        options.keep = keep;
        assert_int_equal(pipe(ends), 0);
        assert_int_equal(write(ends[1], plain, sizeof plain - 1), sizeof plain - 1);
        close(ends[1]);
        snprintf(path, sizeof path, "/dev/fd/%d", ends[0]);
        expect_plain(scratch_open(path, &options));
        if (keep) {
            assert_int_equal(told_rewind(scratch_open_one, path, sizeof path), 0);
            expect_plain(scratch_open_one);
        }
        close(ends[0]);
    }
}

/* ---- What a file may do ------------------------------------------------------------------------------------- */

TEST(small_files_that_become_large)
{
    const uint64_t gib = (uint64_t)1 << 30;
    assert_false(trajectory_input_is_blown_up(1, gib));
    assert_true(trajectory_input_is_blown_up(1, gib + 1));
    assert_true(trajectory_input_is_blown_up(gib / 500 - 1, gib + 500));
    assert_false(trajectory_input_is_blown_up(gib / 500 + 1, gib + 500));
}

TEST(names_in_a_file_stay_beside_it)
{
    static const struct {
        const char *input, *path;
        int is_beside;
    } rows[] = {{"a/b.obj", "a/b.obj", 1},     {"a/b.obj", "a/c.mtl", 1},       {"a/b.obj", "a/d/..c.mtl", 1},
                {"a/b.obj", "a/../c.mtl", 0},  {"a/b.obj", "a/d/../c.mtl", 0},  {"a/b.obj", "c.mtl", 0},
                {"a/b.obj", "/etc/passwd", 0}, {"a/b.obj", "a//etc/passwd", 0}, {"../b.obj", "../b.obj", 1},
                {"../b.obj", "../c.mtl", 1},   {"../b.obj", "../../c.mtl", 0},  {"b.obj", "c.mtl", 1},
                {"b.obj", "../c.mtl", 0},      {"b.obj", "/c.mtl", 0},          {"/b.obj", "/etc/passwd", 1},
                {"/a/b.obj", "/ab.obj", 0},    {"a/b.obj", "a/c/..", 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (trajectory_input_is_beside(rows[i].input, rows[i].path) != rows[i].is_beside)
            fail_msg("%s names %s: not %d", rows[i].input, rows[i].path, rows[i].is_beside);
}

/* ---- Series ------------------------------------------------------------------------------------------------- */

TEST(names_in_order)
{
    const char *paths[] = {"b2",        "a/dump.10.gz", "a/dump.9.gz", "a/dump.0100", "b",
                           "a/dump.99", "a/dump.9",     "b02",         "b1x"};
    static const char *const wanted[] = {"a/dump.9", "a/dump.9.gz", "a/dump.10.gz", "a/dump.99", "a/dump.0100",
                                         "b",        "b1x",         "b02",          "b2"};
    const size_t count = sizeof paths / sizeof paths[0];
    cgt_trajectory_sort_series(paths, count);
    for (size_t i = 0; i < count; i++)
        assert_string_equal(paths[i], wanted[i]);
}

TEST(files_in_series)
{
    char error[1024];
    uint64_t frames;
    const char *paths[3];
    paths[0] = scratch_text(".xyz", "1\n\nC 1 2 3\n2\nlast\nH 1 2 3\nO 4 5 6\n");
    paths[1] = scratch_text(".xyz", "");
    paths[2] = scratch_text(".xyz", "1\n\nO 4 5 6");
    cgt_trajectory_close(scratch_open_one);
    cgt_trajectory *t = scratch_open_one = told_open_series(paths, 3, NULL, error, sizeof error);
    assert_non_null(t);
    assert_int_equal(told_count_frames(t, &frames, error, sizeof error), 0);
    assert_int_equal(frames, 3);
    for (int pass = 0; pass < 2; pass++) {
        cgt_trajectory_frame f = scratch_read(t);
        scratch_expect_sphere(&f, 0, 1, 2, 3, 1.7f);
        assert_int_equal(scratch_read(t).count, 2);
        f = scratch_read(t);
        assert_int_equal(f.number, 2);
        assert_int_equal(f.type[0], 3); /* types are numbered through */
        scratch_expect_end(t);
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
    }
    scratch_fill(paths[1], "1\n\nC 1 2", 8);
    cgt_trajectory_frame f;
    scratch_read(t);
    scratch_read(t);
    assert_int_equal(told_read(t, &f, error, sizeof error), -1);
    assert_true(strncmp(error, paths[1], strlen(paths[1])) == 0);
}

TEST(series_that_are_refused)
{
    char error[1024];
    const char *text = scratch_text(".xyz", plain);
    const struct {
        const char *paths[2];
        const char *what;
    } wrong[] = {{{text, "no/such/file.xyz"}, "no/such/file.xyz: No such file"},
                 {{text, "a.lammpstrj"}, "a.lammpstrj: not of the format"},
                 {{"a.frames", "b.frames"}, "files of this format cannot be read as a series"},
                 {{text, "-"}, "standard input cannot be one of several"}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_null(told_open_series(wrong[i].paths, 2, NULL, error, sizeof error));
        if (strstr(error, wrong[i].what) == NULL)
            fail_msg("\"%s\" lacks \"%s\"", error, wrong[i].what);
    }
    assert_null(told_open_series(NULL, 0, NULL, error, sizeof error));
    assert_non_null(strstr(error, "no file is given"));
}

/* ---- Pipes and files that grow ------------------------------------------------------------------------------ */

/* With keep a pipe can be read again, also from the middle. */
TEST(pipes_that_are_kept)
{
    char error[1024];
    const char *path = scratch_path(".xyz");
    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0);
    const int pipe_end = open(path, O_RDWR);
    assert_true(pipe_end >= 0);
    assert_int_equal(write(pipe_end, plain, sizeof plain - 1), sizeof plain - 1);
    cgt_trajectory_options options = named(NULL);
    options.keep = 1;
    cgt_trajectory *t = scratch_open(path, &options);
    assert_int_equal(close(pipe_end), 0);
    scratch_read(t);
    for (int pass = 0; pass < 3; pass++) {
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
        expect_plain(t);
    }
}

static void pause_briefly(void)
{
    const struct timespec pause = {0, 150000000};
    nanosleep(&pause, NULL);
}

/* Writes the rest of the text in two pieces, the first of which ends inside a number. */
static void *grow_file(void *argument)
{
    const char *const path = argument;
    static const char *const pieces[] = {"O 4 5 6", "00.5\n"};
    for (int i = 0; i < 2; i++) {
        pause_briefly();
        FILE *file = fopen(path, "a");
        if (file == NULL)
            return NULL;
        fputs(pieces[i], file);
        fclose(file);
    }
    return NULL;
}

TEST(files_that_grow)
{
    static const char start[] = "1\n\nC 1 2 3\n1\n\n";
    stop_flag stop = 0;
    char error[1024];
    const char *path = scratch_text(".xyz", start);
    cgt_trajectory_options options = named(NULL);
    options.follow = 20.0;
    options.stop = stop_flag_is_set;
    options.stop_user = &stop;
    cgt_trajectory *t = scratch_open(path, &options);
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, grow_file, (void *)path), 0);
    scratch_read(t);
    const cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 4, 5, 600.5f, 1.52f);
    assert_int_equal(pthread_join(thread, NULL), 0);
    stop = 1; /* ends the waiting at once */
    scratch_expect_end(t);
    assert_int_equal(told_rewind(t, error, sizeof error), 0);
    scratch_read(t);
    scratch_read(t);
    scratch_expect_end(t);
    options.follow = -1.0;
    scratch_expect_error(path, &options, 0, "the seconds to wait");
}

/* A file that another run writes anew while it is followed: what was there comes whole, then an error, at once. One
 * that is replaced is read to its own end. */
TEST(files_that_are_cut_or_replaced)
{
    static const char start[] = "1\n\nC 1 2 3\n1\n\nC 4 5 6\n", again[] = "1\n\nC 7 8 9\n";
    for (int kind = 0; kind < 3; kind++) {
        stop_flag stop = 0;
        char error[1024];
        const char *const path = scratch_text(".xyz", start);
        cgt_trajectory_options options = named(NULL);
        options.follow = 20.0;
        options.stop = stop_flag_is_set;
        options.stop_user = &stop;
        cgt_trajectory *const t = scratch_open(path, &options);
        cgt_trajectory_frame f = scratch_read(t);
        scratch_expect_sphere(&f, 0, 1, 2, 3, 1.7f);
        f = scratch_read(t);
        scratch_expect_sphere(&f, 0, 4, 5, 6, 1.7f);
        if (kind == 2) {
            char other[4200];
            snprintf(other, sizeof other, "%s.new", path);
            FILE *const file = fopen(other, "w");
            assert_true(file && fputs(again, file) >= 0 && !fclose(file) && !rename(other, path));
            stop = 1;
            scratch_expect_end(t);
            continue;
        }
        FILE *const file = fopen(path, "w"); /* cut to nothing; then shorter than before */
        assert_true(file && (kind == 0 || fputs(again, file) >= 0) && !fclose(file));
        assert_int_equal(told_read(t, &f, error, sizeof error), -1);
        assert_non_null(strstr(error, "became shorter while it was followed"));
    }
}

SUITE(NULL, NULL)
