/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Files that other programs wrote: all formats have the same run in them. Cut off at every byte they give their whole
 * frames, and nothing else without a warning. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

static const char *data_path(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/readers/data/%s", CGT_TESTS_DIR, name);
    return path;
}

/* ---- water.* ------------------------------------------------------------------------------------------------- */

typedef struct water_file {
    const char *name;
    double unit; /* of a nanometre */
    float radius[2];
    int has_element, has_time;
} water_file;

static const water_file water_files[] = {
    {"water.gro", 1.0, {0.152f, 0.110f}, 1, 1}, {"water.pdb", 10.0, {1.52f, 1.10f}, 1, 0},
    {"water.dcd", 10.0, {1.0f, 1.0f}, 0, 0},    {"water.xtc", 1.0, {0.1f, 0.1f}, 0, 1},
    {"water.trr", 1.0, {0.1f, 0.1f}, 0, 1},     {"water.nc", 10.0, {1.0f, 1.0f}, 0, 1},
};
enum { WATER_FILES = sizeof water_files / sizeof water_files[0] };

static void expect_water(const water_file *w, const cgt_trajectory_frame *frame, unsigned number)
{
    static const double part[3][3] = {{0, 0, 0}, {0.096, 0, 0}, {-0.024, 0.093, 0}};
    assert_int_equal(frame->count, 12);
    for (unsigned i = 0; i < 12; i++) {
        const double molecule = i / 3;
        const double place[3] = {0.3 * molecule, 0.1 * molecule, 0.2 + 0.05 * number};
        for (int axis = 0; axis < 3; axis++) {
            const double wanted = w->unit * (place[axis] + part[i % 3][axis]);
            if (!(fabs((double)frame->xyzr[4 * i + (unsigned)axis] - wanted) <= 1e-6 * w->unit))
                fail_msg("%s, frame %u, atom %u: %g, not %g", w->name, number, i,
                         (double)frame->xyzr[4 * i + (unsigned)axis], wanted);
        }
        assert_true(fabsf(frame->xyzr[4 * i + 3] - w->radius[i % 3 > 0]) < 1e-6f);
        assert_true(!w->has_element || frame->element[i] == (i % 3 == 0 ? 8 : 1));
    }
    assert_true(w->has_element == (frame->element != NULL));
    assert_true(!w->has_time || frame->time == 2.0 * number);
    /* MDTraj's .pdb repeats the first cell */
    const double edge = w->unit * (1.5 + (strstr(w->name, ".pdb") != NULL ? 0.0 : 0.01 * number));
    const double angle = 80.0 * 3.14159265358979 / 180.0;
    assert_true(fabs(frame->box_edge[0][0] - edge) < 1e-5 * w->unit);
    assert_true(fabs(frame->box_edge[2][0] - edge * cos(angle)) < 2e-5 * w->unit);
    assert_int_equal(frame->periodic[2], 1);
}

TEST(test_water)
{
    for (size_t i = 0; i < WATER_FILES; i++) {
        uint64_t frames = 0;
        char error[1024] = "";
        cgt_trajectory *t = scratch_open(data_path(water_files[i].name), NULL);
        for (int pass = 0; pass < 2; pass++) { /* and again after going back */
            for (unsigned number = 0; number < 3; number++) {
                const cgt_trajectory_frame frame = scratch_read(t);
                expect_water(&water_files[i], &frame, number);
            }
            scratch_expect_end(t);
            if (told_count_frames(t, &frames, error, sizeof error))
                fail_msg("%s", error);
            assert_int_equal(frames, 3);
        }
        /* the second frame after skipping the first */
        assert_int_equal(told_skip(t, error, sizeof error), 1);
        const cgt_trajectory_frame frame = scratch_read(t);
        expect_water(&water_files[i], &frame, 1);
        if (cgt_trajectory_take_warning(t) != NULL)
            fail_msg("%s: a warning", water_files[i].name);
    }
}

#ifndef _WIN32 /* there binary formats have to be files */
/* Standard input cannot seek, as a pipe. */
TEST(test_stream)
{
    static const char *const formats[WATER_FILES] = {"gro", "pdb", "dcd", "xtc", "trr", "netcdf"};
    const int saved = dup(STDIN_FILENO);
    for (size_t i = 0; i < WATER_FILES; i++) {
        cgt_trajectory_options options;
        cgt_trajectory_options_init(&options);
        options.format = formats[i];
        assert_non_null(freopen(data_path(water_files[i].name), "rb", stdin));
        cgt_trajectory *t = scratch_open("-", &options);
        for (unsigned number = 0; number < 3; number++) {
            const cgt_trajectory_frame frame = scratch_read(t);
            expect_water(&water_files[i], &frame, number);
        }
        scratch_expect_end(t);
    }
    dup2(saved, STDIN_FILENO);
    close(saved);
}
#endif

/* ---- formats.* ----------------------------------------------------------------------------------------------- */

#define MOST_FRAMES 4
#define MOST_ATOMS 16

typedef struct whole_run {
    unsigned frames;
    uint32_t count[MOST_FRAMES];
    float xyzr[MOST_FRAMES][4 * MOST_ATOMS];
} whole_run;

static whole_run read_run(const char *path)
{
    whole_run w = {0};
    cgt_trajectory *t = scratch_open(path, NULL);
    cgt_trajectory_frame frame;
    char error[1024];
    while (told_read(t, &frame, error, sizeof error) == 1) {
        assert_true(w.frames < MOST_FRAMES && frame.count <= MOST_ATOMS);
        w.count[w.frames] = frame.count;
        memcpy(w.xyzr[w.frames++], frame.xyzr, 16 * (size_t)frame.count);
    }
    return w;
}

static void expect_column(const cgt_trajectory_frame *a, const cgt_trajectory_frame *b, const char *name)
{
    const cgt_trajectory_column *const left = cgt_trajectory_find_column(a, name);
    const cgt_trajectory_column *const right = cgt_trajectory_find_column(b, name);
    if (left == NULL || right == NULL || left->value == NULL || right->value == NULL) {
        fail_msg("no column %s", name);
        return;
    }
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(fabsf(left->value[i] - right->value[i]) <= 1e-6f * fabsf(left->value[i]));
}

/* The text has nine digits of each number. */
TEST(test_lammps_binary)
{
    static const char *const names[] = {"c_ke", "vx", "id"};
    char error[1024];
    cgt_trajectory *text = scratch_open(data_path("formats.lammpstrj"), NULL);
    scratch_open_one = NULL;
    cgt_trajectory *binary = scratch_open(data_path("formats.bin"), NULL);
    assert_int_equal(told_want_columns(text, names, 3, error, sizeof error), 0);
    assert_int_equal(told_want_columns(binary, names, 3, error, sizeof error), 0);
    for (int number = 0; number < 3; number++) {
        cgt_trajectory_frame a, b;
        assert_int_equal(told_read(text, &a, error, sizeof error), 1);
        assert_int_equal(told_read(binary, &b, error, sizeof error), 1);
        assert_int_equal(a.step, b.step);
        assert_int_equal(b.step, 5 * number);
        assert_memory_equal(a.box_edge, b.box_edge, sizeof a.box_edge);
        assert_memory_equal(a.periodic, b.periodic, sizeof a.periodic);
        assert_memory_equal(a.type, b.type, 4 * a.count);
        for (uint32_t i = 0; i < 4 * a.count; i++)
            assert_true(i % 4 == 3 || fabsf(a.xyzr[i] - b.xyzr[i]) <= 1e-6f * fabsf(a.xyzr[i]));
        for (size_t i = 0; i < 3; i++)
            expect_column(&a, &b, names[i]);
    }
    cgt_trajectory_close(text);
    scratch_expect_end(binary);
}

/* dump atom: scaled coordinates in a tilted box. */
TEST(test_lammps_atom)
{
    char path[1024];
    snprintf(path, sizeof path, "%s", data_path("formats_atom.bin"));
    const whole_run text = read_run(data_path("formats.lammpstrj")), atom = read_run(path);
    assert_int_equal(atom.frames, 3);
    for (unsigned i = 0; i < 4 * 8; i++)
        assert_true(i % 4 == 3 || fabsf(text.xyzr[2][i] - atom.xyzr[2][i]) < 1e-5f);
}

/* ---- Cut off at every byte ------------------------------------------------------------------------------------ */

static int is_frame(const whole_run *w, unsigned number, const cgt_trajectory_frame *frame)
{
    return number < w->frames && frame->count == w->count[number] &&
           memcmp(frame->xyzr, w->xyzr[number], 16 * (size_t)frame->count) == 0;
}

/* Reads what is left, and returns the number of frames without a warning. */
static unsigned expect_cut(const whole_run *w, const char *path, size_t size)
{
    char error[1024] = "";
    cgt_trajectory_frame frame;
    unsigned read = 0;
    int status = -1;
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = told_open(path, NULL, error, sizeof error);
    while (scratch_open_one != NULL && (status = told_read(scratch_open_one, &frame, error, sizeof error)) == 1) {
        const int has_warning = cgt_trajectory_take_warning(scratch_open_one) != NULL;
        if (!has_warning && !is_frame(w, read, &frame))
            fail_msg("%s cut after %zu bytes: frame %u differs, without a warning", path, size, read);
        read += !has_warning;
    }
    if (status < 0 && strncmp(error, path, strlen(path)) != 0)
        fail_msg("the error \"%s\" does not begin with its path", error);
    return read;
}

TEST(test_cuts)
{
    static const char *const names[] = {"water.gro", "water.pdb",   "water.dcd",        "water.xtc",   "water.trr",
                                        "water.nc",  "formats.bin", "formats_atom.bin", "formats.data"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        static char bytes[65536];
        FILE *file = fopen(data_path(names[i]), "rb");
        assert_non_null(file);
        const size_t size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        const whole_run whole = read_run(data_path(names[i]));
        assert_true(whole.frames >= 1);
        const char *path = scratch_path(strrchr(names[i], '.'));
        scratch_fill(path, bytes, size);
        unsigned last = whole.frames;
        for (size_t length = size - 1; length > 0; length--) {
            assert_int_equal(truncate(path, (off_t)length), 0);
            const unsigned frames = expect_cut(&whole, path, length);
            if (frames > last || frames + 1 < last)
                fail_msg("%s: %u frames of %zu bytes, but %u of more", names[i], frames, length, last);
            last = frames;
        }
        assert_int_equal(last, 0);
    }
}

/* ---- netCDF's count of frames ------------------------------------------------------------------------------- */

/* The header of a run that was killed lags behind: its frames are read all the same, but no part of one. */
TEST(test_netcdf_header_that_lags)
{
    static unsigned char bytes[65536];
    FILE *file = fopen(data_path("water.nc"), "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    for (unsigned char told = 0; told < 3; told++) {
        bytes[7] = told;
        cgt_trajectory *t = scratch_open(scratch_bytes(".nc", bytes, size), NULL);
        for (unsigned number = 0; number < 3; number++) {
            const cgt_trajectory_frame frame = scratch_read(t);
            expect_water(&water_files[5], &frame, number);
        }
        scratch_expect_end(t);
        assert_non_null(strstr(cgt_trajectory_take_warning(t), "the file has more: they are read"));
        t = scratch_open(scratch_bytes(".nc", bytes, size - 1), NULL);
        for (unsigned number = 0; number < 2; number++)
            scratch_read(t);
        scratch_expect_end(t);
    }
}

/* Frames 1 2 3 and 4 5 6 of an atom, times 1 and 2, whose dimension "frame" has the length 2; by scipy.io. */
/* clang-format off */
static const unsigned char fixed_frames[] = {
    0x43, 0x44, 0x46, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x0a, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00,
    0x00, 0x05, 0x66, 0x72, 0x61, 0x6d, 0x65, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x04,
    0x61, 0x74, 0x6f, 0x6d, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x07, 0x73, 0x70, 0x61, 0x74, 0x69, 0x61,
    0x6c, 0x00, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x0c, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x0b,
    0x43, 0x6f, 0x6e, 0x76, 0x65, 0x6e, 0x74, 0x69, 0x6f, 0x6e, 0x73, 0x00, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00,
    0x00, 0x05, 0x41, 0x4d, 0x42, 0x45, 0x52, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x0b, 0x00, 0x00, 0x00, 0x02,
    0x00, 0x00, 0x00, 0x0b, 0x63, 0x6f, 0x6f, 0x72, 0x64, 0x69, 0x6e, 0x61, 0x74, 0x65, 0x73, 0x00, 0x00, 0x00,
    0x00, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x05, 0x00, 0x00, 0x00, 0x18, 0x00, 0x00, 0x00, 0xc4, 0x00, 0x00,
    0x00, 0x04, 0x74, 0x69, 0x6d, 0x65, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x05, 0x00, 0x00, 0x00, 0x08, 0x00, 0x00, 0x00, 0xdc, 0x3f, 0x80,
    0x00, 0x00, 0x40, 0x00, 0x00, 0x00, 0x40, 0x40, 0x00, 0x00, 0x40, 0x80, 0x00, 0x00, 0x40, 0xa0, 0x00, 0x00,
    0x40, 0xc0, 0x00, 0x00, 0x3f, 0x80, 0x00, 0x00, 0x40, 0x00, 0x00, 0x00,
};
/* clang-format on */

TEST(test_netcdf_of_fixed_frames)
{
    cgt_trajectory *t = scratch_open(scratch_bytes(".nc", fixed_frames, sizeof fixed_frames), NULL);
    char error[1024];
    for (int pass = 0; pass < 2; pass++) {
        for (unsigned number = 0; number < 2; number++) {
            const float x = 3.0f * (float)number;
            const cgt_trajectory_frame frame = scratch_read(t);
            scratch_expect_sphere(&frame, 0, x + 1, x + 2, x + 3, 1.0f);
            assert_true(frame.time == number + 1.0);
        }
        scratch_expect_end(t);
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
    }
    for (size_t size = 0; size < sizeof fixed_frames; size++) { /* of one that is cut no frame is whole */
        cgt_trajectory_frame frame;
        t = told_open(scratch_bytes(".nc", fixed_frames, size), NULL, error, sizeof error);
        while (t != NULL && told_read(t, &frame, error, sizeof error) > 0)
            assert_true(frame.number == 0);
        cgt_trajectory_close(t);
    }
}

SUITE(NULL, NULL)
