/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trajectories: opening files, results and messages, large dumps of LAMMPS, and the dump in examples/data. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <math.h>
#include <sys/stat.h>

#include "readers/trajectory_scratch.h"

#define HEAD(step, count) "ITEM: TIMESTEP\n" step "\nITEM: NUMBER OF ATOMS\n" count "\n"
#define BOX "ITEM: BOX BOUNDS pp pp ff\n-1 3\n0 8\n10.5 12.5\n"
#define ROWS "ITEM: ATOMS id x y z\n"

static const char DUMP[] = ".lammpstrj";

/* ---- The shipped file --------------------------------------------------------------------------------------- */

TEST(shipped_file_is_whole)
{
    cgt_trajectory *t = scratch_open(CGT_DATA_DIR "/pour2k.lammpstrj", NULL);
    uint32_t before = 0;
    cgt_trajectory_frame frame = {0};
    for (uint64_t number = 0; number < 76; number++) {
        frame = scratch_read(t);
        assert_int_equal(frame.number, number);
        assert_int_equal(frame.step, 150 * (int64_t)number);
        assert_true(number < 3 ? frame.count == 0 : frame.count >= 63);
        assert_true(frame.count >= before);
        assert_non_null(frame.xyzr);
        assert_true(frame.box_min[0] == 0.0f && frame.box_max[0] == 20.0f && frame.box_max[1] == 12.0f);
        for (uint32_t i = 0; i < frame.count; i++) {
            assert_int_equal(frame.id[i], i + 1);
            assert_true(frame.xyzr[4 * i + 3] >= 0.3f && frame.xyzr[4 * i + 3] <= 0.6f);
        }
        before = frame.count;
    }
    assert_int_equal(frame.count, 2000);
    uint32_t of_type[5] = {0};
    for (uint32_t i = 0; i < 2000; i++) {
        assert_in_range(frame.type[i], 1, 4);
        of_type[frame.type[i]]++;
    }
    for (int type = 1; type <= 4; type++)
        assert_int_equal(of_type[type], 500);
    scratch_expect_end(t);
}

TEST(shipped_file_counts_and_rewinds)
{
    char error[1024] = "";
    cgt_trajectory *t = scratch_open(CGT_DATA_DIR "/pour2k.lammpstrj", NULL);
    for (int i = 0; i < 40; i++)
        assert_int_equal(told_skip(t, error, sizeof error), 1);
    const cgt_trajectory_frame frame = scratch_read(t);
    assert_int_equal(frame.number, 40);
    assert_true(cgt_trajectory_progress(t) > 0.2 && cgt_trajectory_progress(t) < 0.8);
    float *copy = malloc(16 * (size_t)frame.count);
    assert_non_null(copy);
    memcpy(copy, frame.xyzr, 16 * (size_t)frame.count);
    uint64_t frames = 0;
    assert_int_equal(told_count_frames(t, &frames, error, sizeof error), 0);
    assert_int_equal(frames, 76);
    cgt_trajectory_frame again = {0};
    for (int i = 0; i <= 40; i++)
        again = scratch_read(t);
    assert_int_equal(again.count, frame.count);
    assert_memory_equal(copy, again.xyzr, 16 * (size_t)frame.count);
    free(copy);
}

/* ---- Counts and cuts ---------------------------------------------------------------------------------------- */

TEST(counts_grow_and_shrink)
{
    static const unsigned counts[] = {3, 10000, 0, 1, 20000, 4097};
    const char *path = scratch_path(DUMP);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (unsigned k = 0; k < 6; k++) {
        fprintf(file, HEAD("%u", "%u") "ITEM: ATOMS id x y z radius vx vy vz\n", k, counts[k]);
        for (unsigned i = 0; i < counts[k]; i++)
            fprintf(file, "%u %u %u 0.5 %u 1 %u 2\n", i + k, i, k, i % 7, i);
    }
    assert_int_equal(fclose(file), 0);
    cgt_trajectory *t = scratch_open(path, NULL);
    for (unsigned k = 0; k < 6; k++) {
        const cgt_trajectory_frame f = scratch_read(t);
        assert_int_equal(f.count, counts[k]);
        for (unsigned i = 0; i < counts[k]; i++) {
            scratch_expect_sphere(&f, i, (float)i, (float)k, 0.5f, (float)(i % 7));
            assert_true(f.id[i] == i + k && f.velocity[3 * i + 1] == (float)i);
        }
    }
    scratch_expect_end(t);
}

TEST(every_truncation_is_noticed)
{
    static const char text[] = HEAD("0", "0") BOX "ITEM: ATOMS type x y z\n" HEAD("1", "2") BOX
        "ITEM: ATOMS type x y z\n1 2 3 4\n5 6 7 8\n" HEAD("2", "1") BOX "ITEM: ATOMS type x y z\n1 2 3 4\n";
    /* The last word of each frame is one character: a cut inside a longer word could not be detected. */
    size_t ends[3];
    const char *p = text;
    for (int i = 0; i < 3; i++) {
        p = strstr(p + 1, i < 2 ? "\nITEM: TIMESTEP" : "nothing else");
        ends[i] = p != NULL ? (size_t)(p - text) + 1 : sizeof text - 1;
        p = p != NULL ? p : text;
    }
    scratch_expect_cuts(DUMP, text, 3, ends, (const uint32_t[]){0, 2, 1});
}

/* Long lines of blanks are read; endless lines are refused before they fill the memory. */
TEST(long_lines)
{
    static char text[3000000];
    const size_t head = (size_t)snprintf(text, sizeof text, "%s", HEAD("0", "1") "ITEM: ATOMS x y z\n1");
    memset(text + head, ' ', 700000);
    strcpy(text + head + 700000, "2 3\n");
    cgt_trajectory *t = scratch_open(scratch_text(DUMP, text), NULL);
    const cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 0.5f);
    memset(text + head, '7', sizeof text - 1 - head);
    scratch_expect_error(scratch_text(DUMP, text), NULL, 0, ":6: the line is longer than 1 MiB");
}

/* ---- Opening ------------------------------------------------------------------------------------------------ */

TEST(cannot_be_opened)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    scratch_expect_error("no/such/file.lammpstrj", NULL, 0, "No such file");
    scratch_expect_error("file.odd", NULL, 0, "No such file");
    scratch_expect_error(".frames", NULL, 0, "No such file");
    options.radius = -1.0f;
    scratch_expect_error(scratch_text(DUMP, ""), &options, 0, "radius");
    options.radius = NAN;
    scratch_expect_error(scratch_text(DUMP, ""), &options, 0, "radius");
    const char *folder = scratch_path(DUMP);
    assert_int_equal(unlink(folder), 0);
    assert_int_equal(mkdir(folder, 0700), 0);
    char error[1024] = "";
    cgt_trajectory *t = told_open(folder, NULL, error, sizeof error);
    assert_int_equal(rmdir(folder), 0);
    assert_null(t);
    assert_non_null(strstr(error, "directory"));
    assert_null(told_open("file.odd", NULL, NULL, 0));
    options.radius = 0.0f;
    options.topology = "no such file";
    assert_null(told_open(scratch_text(DUMP, ""), &options, error, sizeof error));
    assert_non_null(strstr(error, "no such file"));
}

/* A pipe is read like a file, but cannot be rewound. */
TEST(pipes_are_read_once)
{
    const char *path = scratch_path(DUMP);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0);
    const int pipe_end = open(path, O_RDWR); /* opened for reading and writing, so that neither side blocks */
    assert_true(pipe_end >= 0);
    const char *text = HEAD("0", "1") ROWS "1 1 2 3\n" HEAD("1", "1") ROWS "1 4 5 6\n";
    assert_int_equal(write(pipe_end, text, strlen(text)), strlen(text));
    cgt_trajectory *t = scratch_open(path, NULL);
    assert_int_equal(close(pipe_end), 0);
    cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 0.5f);
    assert_true(cgt_trajectory_progress(t) < 0);
    char error[1024] = "";
    uint64_t frames = 0;
    assert_int_equal(told_rewind(t, error, sizeof error), -1);
    assert_non_null(strstr(error, path));
    assert_int_equal(told_count_frames(t, &frames, error, sizeof error), -1);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 4, 5, 6, 0.5f);
    scratch_expect_end(t);
}

/* ---- Results and messages ----------------------------------------------------------------------------------- */

/* All calls on what could not be opened fail alike, and leave its message. */
TEST(what_is_not_opened_tells_why)
{
    static const char *const columns[] = {"x"};
    char first[300], text[300];
    double origin[3] = {1, 1, 1};
    uint64_t frames;
    cgt_trajectory *t = NULL;
    cgt_trajectory_frame frame;
    assert_int_equal(cgt_trajectory_open("/nowhere/run.xyz", NULL, &t), CGT_ERROR_FILE);
    assert_non_null(t);
    const size_t length = cgt_trajectory_get_error_message(t, first, sizeof first);
    assert_int_equal(length, strlen(first));
    assert_true(strncmp(first, "/nowhere/run.xyz: ", 18) == 0);
    assert_int_equal(cgt_trajectory_read(t, &frame), CGT_ERROR_FILE);
    assert_int_equal(cgt_trajectory_skip(t), CGT_ERROR_FILE);
    assert_int_equal(cgt_trajectory_rewind(t), CGT_ERROR_FILE);
    assert_int_equal(cgt_trajectory_count_frames(t, &frames), CGT_ERROR_FILE);
    assert_int_equal(cgt_trajectory_want_columns(t, columns, 1), CGT_ERROR_FILE);
    cgt_trajectory_set_origin(t, origin);
    cgt_trajectory_set_follow(t, 1.0);
    assert_true(!cgt_trajectory_can_rewind(t) && !cgt_trajectory_get_mesh(t) && cgt_trajectory_progress(t) < 0.0);
    assert_null(cgt_trajectory_take_warning(t));
    assert_int_equal(cgt_trajectory_get_error_message(t, text, 9), strlen(first));
    assert_string_equal(text, "/nowhere");
    cgt_trajectory_close(t);
}

/* NULL stands for what there was no memory for. */
TEST(no_memory_is_told_by_all_calls)
{
    static const char *const columns[] = {"x"};
    char text[100];
    double origin[3];
    uint64_t frames;
    cgt_trajectory_frame frame;
    assert_int_equal(cgt_trajectory_read(NULL, &frame), CGT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(cgt_trajectory_skip(NULL), CGT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(cgt_trajectory_rewind(NULL), CGT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(cgt_trajectory_count_frames(NULL, &frames), CGT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(cgt_trajectory_want_columns(NULL, columns, 1), CGT_ERROR_OUT_OF_MEMORY);
    cgt_trajectory_set_origin(NULL, origin);
    cgt_trajectory_set_follow(NULL, 1.0);
    cgt_trajectory_get_origin(NULL, origin);
    assert_true(origin[0] == 0.0 && origin[1] == 0.0 && origin[2] == 0.0);
    assert_true(!cgt_trajectory_can_rewind(NULL) && !cgt_trajectory_get_mesh(NULL));
    assert_true(cgt_trajectory_progress(NULL) < 0.0);
    assert_null((cgt_trajectory_take_warning)(NULL));
    assert_true(cgt_trajectory_get_error_message(NULL, text, sizeof text) > 0);
    scratch_note(text);
    assert_int_equal(cgt_trajectory_writer_add(NULL, NULL, 0), CGT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(cgt_trajectory_writer_add_vertices(NULL, NULL, 0), CGT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(cgt_trajectory_writer_finish(NULL), CGT_ERROR_OUT_OF_MEMORY);
    assert_true(cgt_trajectory_writer_get_error_message(NULL, text, sizeof text) > 0);
    scratch_note(text);
    cgt_trajectory_writer_close(NULL);
}

TEST(results_tell_frames_from_the_end)
{
    static const float sphere[4] = {1, 2, 3, 4};
    const char *const path = scratch_path(".frames");
    char text[300];
    uint64_t frames;
    cgt_trajectory_frame frame;
    cgt_trajectory_writer *w;
    cgt_trajectory *t;
    assert_int_equal(cgt_trajectory_writer_open(path, NULL, &w), CGT_OK);
    assert_int_equal(cgt_trajectory_writer_get_error_message(w, text, sizeof text), 0);
    assert_int_equal(cgt_trajectory_writer_add(w, sphere, 1), CGT_OK);
    assert_int_equal(cgt_trajectory_writer_finish(w), CGT_OK);
    assert_int_equal(cgt_trajectory_writer_finish(w), CGT_OK);
    assert_int_equal(cgt_trajectory_writer_add(w, sphere, 1), CGT_ERROR_FILE);
    cgt_trajectory_writer_get_error_message(w, text, sizeof text);
    assert_non_null(strstr(scratch_note(text), ": the file is complete"));
    cgt_trajectory_writer_close(w);
    assert_int_equal(cgt_trajectory_open(path, NULL, &t), CGT_OK);
    assert_int_equal(cgt_trajectory_count_frames(t, &frames), CGT_OK);
    assert_int_equal(frames, 1);
    assert_int_equal(cgt_trajectory_read(t, &frame), CGT_OK);
    assert_int_equal(cgt_trajectory_read(t, &frame), CGT_END);
    assert_int_equal(cgt_trajectory_skip(t), CGT_END);
    assert_int_equal(cgt_trajectory_get_error_message(t, text, sizeof text), 0);
    assert_int_equal(cgt_trajectory_rewind(t), CGT_OK);
    assert_int_equal(cgt_trajectory_skip(t), CGT_OK);
    cgt_trajectory_close(t);
    assert_int_equal(cgt_trajectory_writer_open("/nowhere/run.frames", NULL, &w), CGT_ERROR_FILE);
    assert_int_equal(cgt_trajectory_writer_add(w, sphere, 1), CGT_ERROR_FILE);
    assert_int_equal(cgt_trajectory_writer_finish(w), CGT_ERROR_FILE);
    cgt_trajectory_writer_get_error_message(w, text, sizeof text);
    assert_true(strncmp(text, "/nowhere/run.frames: ", 21) == 0);
    cgt_trajectory_writer_close(w);
}

SUITE(NULL, NULL)
