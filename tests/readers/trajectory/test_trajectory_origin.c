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
    for (uint32_t i = 0; x != NULL && i < plain->count; i++) /* columns are the file's own numbers */
        assert_near(x->value[i], (double)place_of(plain, i)[0], 1e-5);
}

/* All frames, twice: what a reader keeps of a frame for the next ones is moved once. */
static void compare_files(const char *path)
{
    static const double origin[3] = {1.25, -2.5, 1000.125};
    static const char *const wanted[] = {"x"};
    char error[1024];
    cgt_trajectory *const a = open_at(path, NULL), *const b = open_at(path, origin);
    assert_int_equal(told_want_columns(b, wanted, 1, error, sizeof error), 0);
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
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        compare_files(data_path(files[i]));
#ifdef CGT_HAVE_MESHES
    compare_files(scratch_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
#endif
}

/* Text in which a place is 5846925.37, -372004.25 and 1200.015625, as every format writes it. */
static const struct {
    const char *ending, *text;
} far_texts[] = {
    {".xyz", "2\n\nC 5846925.37 -372004.25 1200.015625\nC +5846925.37 -372004.25 1200.015625\n"},
    {".extxyz", "1\nProperties=pos:R:3:species:S:1\n5846925.37 -372004.25 1200.015625 C\n"},
    {".lammpstrj", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n"
                   "5846925 5846926\n-372004.5 -372004\n1200 1201\nITEM: ATOMS id type x ys z\n"
                   "1 1 5846925.37 0.5 1200.015625\n2 1 5.84692537e6 0.5 1200.015625\n"},
    {".data", "LAMMPS\n\n1 atoms\n1 atom types\n5846925 5846926 xlo xhi\n-372005 -372004 ylo yhi\n1200 1201 zlo zhi\n\n"
              "Atoms # atomic\n\n1 1 5846925.37 -372004.25 1200.015625\n"},
    {".gro", "far\n1\n    1SOL     OW    1  5846925.370000  -372004.250000     1200.015625\n1 1 1\n"},
    {".cif", "data_a\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
             "C 5846925.37 -372004.25 1200.015625\n"},
    {".poscar", "far\n1.0\n1 0 0\n0 1 0\n0 0 1\nC\n1\nCartesian\n5846925.37 -372004.25 1200.015625\n"},
    {".vtk", "# vtk DataFile Version 3.0\nfar\nASCII\nDATASET POLYDATA\nPOINTS 1 double\n"
             "5846925.37 -372004.25 1200.015625\n"},
};

TEST(text_keeps_its_digits)
{
    static const double origin[3] = {5846900.0, -372000.0, 1200.0}, place[3] = {25.37, -4.25, 0.015625};
    char error[1024];
    for (size_t i = 0; i < sizeof far_texts / sizeof far_texts[0]; i++) {
        const char *const path = scratch_text(far_texts[i].ending, far_texts[i].text);
        cgt_trajectory *const t = open_at(path, origin);
        cgt_trajectory_frame frame;
        if (told_read(t, &frame, error, sizeof error) != 1)
            fail_msg("%s", error);
        for (uint32_t k = 0; k < frame.count; k++)
            for (int c = 0; c < 3; c++)
                if (!(fabs((double)frame.xyzr[4 * k + (unsigned)c] - place[c]) < 2e-6))
                    fail_msg("%s: %.9g for %.9g", path, (double)frame.xyzr[4 * k + (unsigned)c], place[c]);
        cgt_trajectory_close(t);
    }
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
