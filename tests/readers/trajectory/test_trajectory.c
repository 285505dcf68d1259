/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trajectories: opening files, LAMMPS dumps, and the dump in examples/data. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <math.h>
#include <sys/stat.h>

#include "readers/trajectory_scratch.h"

#define HEAD(step, count) "ITEM: TIMESTEP\n" step "\nITEM: NUMBER OF ATOMS\n" count "\n"
#define BOX "ITEM: BOX BOUNDS pp pp ff\n-1 3\n0 8\n10.5 12.5\n"

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

/* File texts below have one line of the file per literal where that is more readable. */
/* clang-format off */

/* ---- Columns and boxes -------------------------------------------------------------------------------------- */

TEST(columns_in_any_order_and_changing)
{
    cgt_trajectory *t = scratch_open(
        scratch_text(DUMP,
                     HEAD("7", "2") BOX "ITEM: ATOMS z q x id radius y type vz vx vy \n"
                                        "3 junk 1 11 .25 2 5 9 7 8 \n-6e0\t- 4 12 +1.5 5. 6 0 -1 1e-3\n"
                     HEAD("9", "1") "ITEM: ATOMS diameter x y z\n3 1 2 4\n"
                     HEAD("9", "1") "ITEM: ATOMS radius diameter x y z\n3 1 1 2 4\n"
                     HEAD("-3", "1") "ITEM: ATOMS x y z vx vy\n1 2 4 5 6\n"),
        NULL);
    cgt_trajectory_frame f = scratch_read(t);
    assert_int_equal(f.count, 2);
    assert_int_equal(f.step, 7);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 0.25f);
    scratch_expect_sphere(&f, 1, 4, 5, -6, 1.5f);
    assert_int_equal(f.id[1], 12);
    assert_int_equal(f.type[0], 5);
    assert_true(f.velocity[0] == 7 && f.velocity[1] == 8 && f.velocity[2] == 9 && f.velocity[4] == 1e-3f);
    assert_true(f.box_min[0] == -1 && f.box_max[0] == 3 && f.box_min[2] == 10.5f && f.box_max[2] == 12.5f);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 4, 1.5f);
    assert_true(f.id == NULL && f.type == NULL && f.velocity == NULL);
    assert_true(f.box_min[0] > f.box_max[0]);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 4, 3);
    f = scratch_read(t);
    assert_int_equal(f.step, -3);
    assert_null(f.velocity);
    scratch_expect_end(t);
}

TEST(wrapped_or_smooth_as_asked)
{
    const char *path =
        scratch_text(DUMP,
                     HEAD("0", "1") BOX "ITEM: ATOMS x y z xu yu zu xs ys zs xsu ysu zsu\n"
                                        "1 2 3 4 5 6 0.5 0.5 0.5 0.25 0.25 0.25\n"
                     HEAD("1", "1") BOX "ITEM: ATOMS x y z xu yu xsu ysu zsu\n1 2 3 4 5 .5 .5 1\n"
                     HEAD("2", "1") BOX "ITEM: ATOMS xs ys zs xu yu zu\n0.5 0.5 0.5 4 5 6\n");
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    cgt_trajectory *t = scratch_open(path, &options);
    cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 4, 5, 6, 0.5f);
    assert_true(f.unwrapped[0] == 1 && f.unwrapped[1] == 1 && f.unwrapped[2] == 1);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 4, 12.5f, 0.5f);
    assert_true(f.unwrapped[0] == 1 && f.unwrapped[1] == 1 && f.unwrapped[2] == 1);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 4, 5, 6, 0.5f);
    options.wrapped = 1;
    options.radius = 2;
    t = scratch_open(path, &options);
    for (int i = 0; i < 2; i++) {
        f = scratch_read(t);
        scratch_expect_sphere(&f, 0, 1, 2, 3, 2);
        assert_true(f.unwrapped[0] == 0 && f.unwrapped[1] == 0 && f.unwrapped[2] == 0);
    }
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 4, 11.5f, 2);
}

TEST(scaled_coordinates_use_the_box)
{
    cgt_trajectory *t = scratch_open(
        scratch_text(DUMP,
                     HEAD("0", "2") BOX "ITEM: ATOMS xs ys zs radius\n0 0 0 1\n0.25 0.5 1.5 1\n"
                     /* corner 0, 0, 0, lengths 4, 8, 2, tilts xy = 1, xz = -2, yz = 3: bounds as LAMMPS widens them */
                     HEAD("1", "2") "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-2 5 1\n0 11 -2\n0 2 3\n"
                                    "ITEM: ATOMS xsu ysu zsu radius\n0 0 0 1\n0.5 0.5 0.5 1\n"
                     HEAD("2", "1") "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-3 4 -1\n0 11 -2\n0 2 3\n"
                                    "ITEM: ATOMS xs ys zs radius\n0.5 0.5 0.5 1\n"
                     HEAD("3", "1") "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 7 1\n-3 8 2\n0 2 -3\n"
                                    "ITEM: ATOMS xs ys zs radius\n0.5 0.5 0.5 1\n"
                     HEAD("4", "1") "ITEM: BOX BOUNDS abc origin pp pp pp\n0 2 0 10\n-4 0 0 20\n0 0 8 30\n"
                                    "ITEM: ATOMS xs ys zs radius\n0.5 0.25 0.75 1\n"),
        NULL);
    cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_sphere(&f, 0, -1, 0, 10.5f, 1);
    scratch_expect_sphere(&f, 1, 0, 4, 13.5f, 1);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 0, 0, 0, 1);
    scratch_expect_sphere(&f, 1, 1.5f, 5.5f, 1, 1);
    assert_true(f.box_min[0] == -2 && f.box_max[0] == 5 && f.box_max[1] == 11);
    f = scratch_read(t); /* xy = -1 and xz = -2: their sum tells how far down the box reaches */
    scratch_expect_sphere(&f, 0, 0.5f, 5.5f, 1, 1);
    f = scratch_read(t); /* all signs changed: and how far up */
    scratch_expect_sphere(&f, 0, 3.5f, 2.5f, 1, 1);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 9, 21, 36, 1);
    assert_true(f.box_min[0] == 6 && f.box_max[0] == 10 && f.box_max[1] == 22 && f.box_max[2] == 38);
}

/* ---- Counts, lines, values ---------------------------------------------------------------------------------- */

TEST(empty_frames_and_files)
{
    cgt_trajectory *t = scratch_open(
        scratch_text(DUMP,
                     HEAD("0", "0") BOX "ITEM: ATOMS id x y z \n"
                     HEAD("1", "1") "ITEM: ATOMS x y z\n1 2 3\n"
                     HEAD("2", "0") "ITEM: ATOMS x y z"),
        NULL);
    cgt_trajectory_frame f = scratch_read(t);
    assert_int_equal(f.count, 0);
    assert_true(f.xyzr != NULL && f.id != NULL);
    f = scratch_read(t);
    assert_int_equal(f.count, 1);
    f = scratch_read(t);
    assert_int_equal(f.count, 0);
    assert_int_equal(f.number, 2);
    scratch_expect_end(t);
    scratch_expect_end(scratch_open(scratch_text(DUMP, ""), NULL));
    scratch_expect_end(scratch_open(scratch_text(DUMP, "\n \r\n"), NULL));
}

TEST(other_systems_lines)
{
    cgt_trajectory *t = scratch_open(
        scratch_text(DUMP, "ITEM: UNITS\r\nlj\r\nITEM: TIME\r\n0.5\r\nITEM: TIMESTEP\r\n10\r\nITEM: NUMBER OF ATOMS\r\n"
                           "1\r\nITEM: BOX BOUNDS\r\n0 1\r\n0 1\r\n0 1\r\nITEM: ATOMS x y radius z\r\n1 2 3 4\r\n\r\n\n"
                           "ITEM: TIME\n1\n" HEAD("20", "1") "ITEM: ATOMS x y z type\n5 6 7 8"),
        NULL);
    cgt_trajectory_frame f = scratch_read(t);
    assert_int_equal(f.step, 10);
    scratch_expect_sphere(&f, 0, 1, 2, 4, 3);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 5, 6, 7, 0.5f);
    assert_int_equal(f.type[0], 8);
    scratch_expect_end(t);
}

TEST(values_pass_as_they_are)
{
    cgt_trajectory *t = scratch_open(
        scratch_text(DUMP, HEAD("0", "3") "ITEM: ATOMS x y z radius\nnan -inf inf -2\n-nan 1e39 -1e-60 0\n1e-45 "
                                          "16777217 0.1 nan\n"),
        NULL);
    const cgt_trajectory_frame f = scratch_read(t);
    assert_int_equal(f.count, 3);
    const float *v = f.xyzr;
    assert_true(isnan(v[0]) && v[1] == -INFINITY && v[2] == INFINITY && v[3] == -2.0f);
    assert_true(isnan(v[4]) && v[5] == INFINITY && v[6] == 0.0f && signbit(v[6]) && v[7] == 0.0f);
    assert_true(v[8] == 1e-45f && v[9] == 16777216.0f && v[10] == 0.1f && isnan(v[11]));
}

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

/* ---- Damage ------------------------------------------------------------------------------------------------- */

TEST(every_truncation_is_noticed)
{
    static const char text[] = HEAD("0", "0") BOX "ITEM: ATOMS type x y z\n"
                               HEAD("1", "2") BOX "ITEM: ATOMS type x y z\n1 2 3 4\n5 6 7 8\n"
                               HEAD("2", "1") BOX "ITEM: ATOMS type x y z\n1 2 3 4\n";
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

#define ROWS "ITEM: ATOMS id x y z\n"
static const scratch_damage damaged_texts[] = {
    {HEAD("0", "2") ROWS "1 1 2 3\n2 1 2\n", 0, ":7: 3 columns where 4 are expected"},
    {HEAD("0", "2") ROWS "1 1 2 3\n\n2 1 2 3\n", 0, ":7: 0 columns"},
    {HEAD("0", "1") ROWS "1 1 2 3 4\n", 0, ":6: more than the expected 4 columns: '4'"},
    {HEAD("0", "1") ROWS "1 1 2 x3\n", 0, ":6: column 4: 'x3' is not a number"},
    {HEAD("0", "1") ROWS "1 1 2.3.4 3\n", 0, ":6: column 3"},
    {HEAD("0", "1") ROWS "1 0x10 2 3\n", 0, ":6: column 2"},
    {HEAD("0", "1") ROWS "1 1 1e 3\n", 0, ":6: column 3"},
    {HEAD("0", "1") ROWS "1 1 - 3\n", 0, ":6: column 3"},
    {HEAD("0", "1") ROWS "-1 1 2 3\n", 0, ":6: column 1: '-1' is not an id"},
    {HEAD("0", "1") ROWS "18446744073709551616 1 2 3\n", 0, ":6: column 1"},
    {HEAD("0", "1") ROWS "1.5 1 2 3\n", 0, ":6: column 1"},
    {HEAD("0", "1") "ITEM: ATOMS type x y z\n1.5 1 2 3\n", 0, ":6: column 1: '1.5' is not a type"},
    {HEAD("0", "2") ROWS "1 1 2 3\n" HEAD("1", "1") ROWS "1 1 2 3\n", 0, ":7: a new section after 1 of 2"},
    {HEAD("0", "1") ROWS "1 1 2 3\n2 1 2 3\n", 1, ":7: '2 1 2 3' is not a section"},
    {HEAD("0", "1") "ITEM: ATOMS id x z\n1 1 2\n", 0, ":5: no columns x y z"},
    {HEAD("0", "1") "ITEM: ATOMS\n1 1 2\n", 0, ":5: no columns x y z"},
    {HEAD("0", "1") "ITEM: ATOMS xs ys zs\n1 1 2\n", 0, ":5: scaled coordinates without"},
    {HEAD("0", "-1") ROWS, 0, ":4: '-1' is not a number of spheres"},
    {HEAD("0", "1.0") ROWS, 0, ":4: '1.0' is not a number of spheres"},
    {HEAD("0", "18446744073709551616") ROWS, 0, ":4: '18446744073709551616' is not a number"},
    {HEAD("0", "18446744073709551615") ROWS, 0, ":4: 18446744073709551615 spheres are more than the limit"},
    {HEAD("0", "2147483649") ROWS, 0, ":4: 2147483649 spheres are more than the limit of 2147483648"},
    {HEAD("0", "2000000000") ROWS "1 1 2 3\n", 0, ":6: the file ends after 1 of 2000000000 spheres"},
    {HEAD("0", "") ROWS, 0, ":4: one value"},
    {HEAD("0 1", "1") ROWS, 0, ":2: one value"},
    {HEAD("9223372036854775808", "1") ROWS, 0, ":2: '9223372036854775808' is not a time step"},
    {HEAD("zero", "1") ROWS, 0, ":2: 'zero' is not a time step"},
    {"ITEM: NUMBER OF ATOMS\n0\n" ROWS, 0, ":3: ITEM: ATOMS without TIMESTEP"},
    {"ITEM: TIMESTEP\n0\n" ROWS, 0, ":3: ITEM: ATOMS without NUMBER OF ATOMS"},
    {HEAD("0", "2") "ITEM: NUMBER OF ATOMS\n1\n" ROWS "1 1 2 3\n", 0, ":5: the frame before this line"},
    {"ITEM: TIMESTEP\n0\n" BOX BOX ROWS, 0, ":7: the frame before this line has no ITEM: ATOMS"},
    {HEAD("0", "1") HEAD("1", "1") ROWS "1 1 2 3\n", 0, ":5: the frame before this line has no ITEM: ATOMS"},
    {"ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS pp pp pp\n0 1\n0\n0 1\n", 0, ":5: 1 numbers where the box bounds need 2"},
    {"ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1 0\n0 1\n", 0, ":5: more than the 2 numbers"},
    {"ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS xy xz yz\n0 1 0\n0 1\n0 1\n", 0, ":5: 2 numbers where the box bounds need 3"},
    {"ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 nan\n0 1\n", 0, ":5: 'nan' is not a bound"},
    {"ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS pp pp pp\n0 1\n1 0\n0 1\n", 0, ":5: the lower bound"},
    {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n0\n", 0, ":3: 'ITEM: NUMBER OF ENTRIES' is not a section"},
    {"ITEM: TIMESTEPS\n0\n", 0, ":1: 'ITEM: TIMESTEPS' is not a section"},
    {"\x7f\x45LF\x02", 0, ":1: '?ELF?' is not a section"},
    {"\n\n3\n", 0, ":3: '3' is not a section"},
};

/* clang-format on */
TEST(damage_is_named_with_its_line)
{
    scratch_expect_damage(DUMP, damaged_texts, sizeof damaged_texts / sizeof damaged_texts[0]);
}

TEST(zero_bytes_are_no_numbers)
{
    static const char text[] = HEAD("0", "1") ROWS "1 1 2\0 3\n";
    scratch_expect_error(scratch_bytes(DUMP, text, sizeof text - 1), NULL, 0, ":6: column 3: '2?' is not a number");
}

TEST(limits_hold)
{
    const char *text = HEAD("0", "2") ROWS "1 1 2 3\n2 1 2 3\n" HEAD("1", "3") ROWS "1 1 2 3\n2 1 2 3\n3 1 2 3\n";
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.max_count = 2;
    scratch_expect_error(scratch_text(DUMP, text), &options, 1, ":11: 3 spheres are more than the limit of 2");
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
}

TEST(endings_of_any_case)
{
    scratch_expect_end(scratch_open(scratch_text(".LAMMPSTRJ", ""), NULL));
    scratch_expect_end(scratch_open(scratch_text(".dump", ""), NULL));
    scratch_expect_end(scratch_open(scratch_text(".XYZ", ""), NULL));
    scratch_expect_end(scratch_open(scratch_text(".extxyz", ""), NULL));
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

/* Rewinding clears an error: the frames before it can be read again. */
TEST(rewinding_after_an_error)
{
    const char *path = scratch_text(DUMP, HEAD("5", "1") ROWS "1 1 2 3\n" HEAD("6", "1") ROWS "1 1 2\n");
    scratch_expect_error(path, NULL, 1, ":12: 3 columns");
    char error[1024] = "";
    assert_int_equal(told_rewind(scratch_open_one, error, sizeof error), 0);
    const cgt_trajectory_frame f = scratch_read(scratch_open_one);
    assert_int_equal(f.number, 0);
    assert_int_equal(f.step, 5);
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
