/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An origin is subtracted from places and boxes in double, by all formats, and from nothing else. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

static const char *data_path(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/readers/data/%s", CGT_TESTS_DIR, name);
    return path;
}

static cgt_trajectory *open_at(const char *path, const double origin[3])
{
    char error[1024];
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.has_origin = origin != NULL;
    if (origin != NULL)
        memcpy(options.origin, origin, sizeof options.origin);
    cgt_trajectory *const t = told_open(path, &options, error, sizeof error);
    if (t == NULL)
        fail_msg("%s", error);
    return t;
}

static const float *place_of(const cgt_trajectory_frame *f, uint32_t i)
{
    return f->kind == CGT_TRAJECTORY_SPHERES ? f->xyzr + 4 * (size_t)i : f->position + 3 * (size_t)i;
}

/* `moved` is `plain` less the origin, to the rounding of either. */
static void expect_moved(const char *path, const cgt_trajectory_frame *plain, const cgt_trajectory_frame *moved,
                         const double origin[3])
{
    assert_int_equal(moved->count, plain->count);
    assert_memory_equal(moved->origin, origin, sizeof moved->origin);
    for (uint32_t i = 0; i < plain->count; i++)
        for (int c = 0; c < 3; c++) {
            const double there = (double)place_of(plain, i)[c], here = (double)place_of(moved, i)[c];
            const double rounding = 0x1p-24 * (fabs(there) + fabs(here) + fabs(origin[c]));
            if (!(fabs(here + origin[c] - there) <= rounding))
                fail_msg("%s, frame %u, %u: %g for %g", path, (unsigned)plain->number, i, here, there);
        }
    for (int c = 0; c < 3; c++) {
        const int has_box = plain->box_min[0] <= plain->box_max[0];
        assert_true(moved->box_origin[c] == plain->box_origin[c] - (has_box ? origin[c] : 0.0));
        assert_true(!has_box || fabs((double)moved->box_max[c] + origin[c] - (double)plain->box_max[c]) < 1e-4);
    }
    assert_memory_equal(moved->box_edge, plain->box_edge, sizeof plain->box_edge);
    if (plain->velocity != NULL)
        assert_memory_equal(moved->velocity, plain->velocity, 3 * sizeof(float) * plain->count);
    const cgt_trajectory_column *const x = cgt_trajectory_find_column(moved, "x");
    const float *const value = x != NULL ? x->value : NULL; /* columns are the file's own numbers */
    for (uint32_t i = 0; value != NULL && i < plain->count; i++)
        assert_near(value[i], (double)place_of(plain, i)[0], 1e-5);
}

/* All frames, twice: what a reader keeps of a frame for the next ones is moved once. wants: columns of numbers that are
 * wanted under their names are read in another way. */
static void compare_files(const char *path, size_t wants)
{
    static const double origin[3] = {1.25, -2.5, 1000.125};
    static const char *const wanted[] = {"x"};
    char error[1024];
    cgt_trajectory *const a = open_at(path, NULL), *const b = open_at(path, origin);
    assert_int_equal(told_want_columns(b, wanted, wants, error, sizeof error), 0);
    for (int round = 0; round < 2; round++) {
        cgt_trajectory_frame plain, moved;
        int status;
        unsigned frames = 0;
        while ((status = told_read(a, &plain, error, sizeof error)) == 1) {
            assert_int_equal(told_read(b, &moved, error, sizeof error), 1);
            expect_moved(path, &plain, &moved, origin);
            frames++;
        }
        assert_true(status == 0 && frames > 0);
        assert_int_equal(told_rewind(a, error, sizeof error), 0);
        assert_int_equal(told_rewind(b, error, sizeof error), 0);
    }
    cgt_trajectory_close(a);
    cgt_trajectory_close(b);
}

TEST(all_formats_subtract_it)
{
    static const char *const files[] = {"formats.bin", "formats.data", "formats.lammpstrj", "water.gro", "water.pdb",
                                        "water.dcd",   "water.xtc",    "water.trr",         "water.nc"};
    for (size_t i = 0; i < 2 * sizeof files / sizeof files[0]; i++)
        compare_files(data_path(files[i / 2]), i % 2);
#ifdef CGT_HAVE_MESHES
    compare_files(scratch_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), 1);
#endif
}

/* A .frames file has its origin in it. Readers take it unless they are told another one, which loses nothing. */
TEST(frames_carry_it)
{
    static const double origin[3] = {5846900.0, -372000.0, 0.1}, other[3] = {5846925.0, -372000.0, 0.0};
    static const float xyzr[] = {25.37f, -4.25f, 3.0f, 1.0f, -1e-3f, 2.0f, 0.0f, 0.5f};
    char error[1024];
    cgt_trajectory_frame frame;
    const char *const path = scratch_path(".frames");
    cgt_trajectory_writer *const w = told_writer_open(path, origin, error, sizeof error);
    assert_int_equal(told_writer_add(w, xyzr, 2, error, sizeof error), 0);
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    cgt_trajectory *t = open_at(path, NULL);
    assert_int_equal(told_read(t, &frame, error, sizeof error), 1);
    assert_memory_equal(frame.xyzr, xyzr, sizeof xyzr);
    assert_memory_equal(frame.origin, origin, sizeof origin);
    cgt_trajectory_set_origin(t, other);
    assert_int_equal(told_rewind(t, error, sizeof error), 0);
    assert_int_equal(told_read(t, &frame, error, sizeof error), 1);
    assert_memory_equal(frame.origin, other, sizeof other);
    assert_true(frame.xyzr[0] == (float)((double)25.37f - 25.0) && frame.xyzr[1] == -4.25f);
    assert_true(frame.xyzr[2] == 3.1f && frame.xyzr[3] == 1.0f);
    cgt_trajectory_close(t);
    unsigned char bytes[56];
    FILE *const file = fopen(path, "r+b");
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof bytes);
    for (size_t size = 24; size < 48; size++) {
        scratch_open_one = told_open(scratch_bytes(".frames", (char *)bytes, size), NULL, error, sizeof error);
        assert_null(scratch_open_one);
        assert_non_null(strstr(error, "cut off"));
    }
    bytes[31] = 0x7f; /* of the first number: NaN */
    bytes[30] = 0xff;
    assert_null(told_open(scratch_bytes(".frames", (char *)bytes, sizeof bytes), NULL, error, sizeof error));
    assert_non_null(strstr(error, "the origin in the header is not finite"));
    assert_int_equal(fclose(file), 0);
}

/* What has no result says so at the next call that has one; a wait of NaN seconds ends. */
TEST(later_origins_are_finite)
{
    static const double wrong[2][3] = {{NAN, 0.0, 0.0}, {0.0, 0.0, -INFINITY}}, right[3] = {1.0, 0.0, 0.0};
    static const uint32_t index[3] = {0, 1, 2};
    char error[1024];
    cgt_trajectory_frame frame;
    cgt_trajectory *const t = open_at(data_path("water.gro"), NULL);
    for (int k = 0; k < 2; k++) {
        cgt_trajectory_writer *w;
        cgt_trajectory_set_origin(t, wrong[k]);
        assert_int_equal(told_rewind(t, error, sizeof error), -1);
        assert_non_null(strstr(error, "the origin must be finite"));
        assert_int_equal(k ? cgt_trajectory_writer_open(scratch_path(".frames"), wrong[k], &w)
                           : cgt_trajectory_writer_open_triangles(scratch_path(".frames"), wrong[k], index, 1, &w),
                         CGT_ERROR_INVALID_ARGUMENT);
        cgt_trajectory_writer_get_error_message(w, error, sizeof error);
        assert_non_null(strstr(error, "the origin must be finite"));
        cgt_trajectory_writer_close(w);
    }
    cgt_trajectory_set_origin(t, right);
    cgt_trajectory_set_follow(t, NAN);
    assert_int_equal(told_rewind(t, error, sizeof error), 0);
    while (told_read(t, &frame, error, sizeof error) == 1)
        assert_true(frame.origin[0] == 1.0);
    cgt_trajectory_close(t);
}

TEST(origins_are_finite)
{
    char error[1024];
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.has_origin = 1;
    options.origin[1] = NAN;
    assert_null(told_open(data_path("water.gro"), &options, error, sizeof error));
    assert_non_null(strstr(error, "the origin must be finite"));
}

SUITE(NULL, NULL)
