/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What other programs write: the values that are read, and the warnings where a file can be read in two ways. */
#define _GNU_SOURCE
#include "readers/trajectory_scratch.h"

#define MOST_SPHERES 4

/* A file and its first frame; warning: part of the first warning, NULL for none. */
typedef struct reading {
    const char *text;
    const char *warning;
    uint32_t count;
    float xyzr[MOST_SPHERES][4];
    uint32_t type[MOST_SPHERES]; /* 0 in the first: the frame has no types */
} reading;

static void expect_reading(const char *ending, const reading *r)
{
    cgt_trajectory *t = scratch_open(scratch_text(ending, r->text), NULL);
    const cgt_trajectory_frame f = scratch_read(t);
    const char *warning = cgt_trajectory_take_warning(t);
    if ((warning == NULL) != (r->warning == NULL) || (warning != NULL && strstr(warning, r->warning) == NULL))
        fail_msg("%s: warning \"%s\", not \"%s\"", r->text, warning ? warning : "", r->warning ? r->warning : "");
    assert_int_equal(f.count, r->count);
    for (uint32_t i = 0; i < r->count; i++)
        scratch_expect_sphere(&f, i, r->xyzr[i][0], r->xyzr[i][1], r->xyzr[i][2], r->xyzr[i][3]);
    assert_true((f.type != NULL) == (r->type[0] != 0));
    for (uint32_t i = 0; f.type != NULL && i < r->count; i++)
        assert_int_equal(f.type[i], r->type[i]);
}

TEST(xyz_comments)
{
    /* clang-format off */
    static const reading files[] = {
        {"2\nLattice = \"9 0 0 0 9 0 0 0 9\" Properties = id:I:1:type:I:1:pos:R:3 pbc = \"T T T\"\n"
         "1 2 5.5 6.5 7.5\n2 1 1.5 2.5 3.5\n", NULL, 2, {{5.5f, 6.5f, 7.5f, 0.5f}, {1.5f, 2.5f, 3.5f, 0.5f}}, {2, 1}},
        {"1\nLattice =\"9 0 0 0 9 0 0 0 9\" Properties =species:S:1:tags:I:1:pos:R:3\nCu 7 1 2 3\n",
         NULL, 1, {{1, 2, 3, 2}}, {1}},
        {"1\nLATTICE=\"9 0 0 0 9 0 0 0 9\" PROPERTIES=species:S:1:charge:R:1:pos:R:3\nCu 9 1 2 3\n",
         NULL, 1, {{1, 2, 3, 2}}, {1}},
        {"1\nProperties=\" species:S:1:pos:R:3 \"\nCu 1 2 3\n", NULL, 1, {{1, 2, 3, 2}}, {1}},
        {"1\nnote=\"old Properties=species:S:1:pos:R:3\" Properties=pos:R:3:species:S:1\n1 2 3 C\n",
         NULL, 1, {{1, 2, 3, 1.7f}}, {1}},
        {"1\nnote='a \\' Properties=x' \"quoted key\"=[1, [2]] flag Properties=pos:R:3:species:S:1\n1 2 3 C\n",
         NULL, 1, {{1, 2, 3, 1.7f}}, {1}},
        {"1\nnote=\"never ended Properties=pos:R:3:species:S:1\n1 2 3 C\n", NULL, 1, {{1, 2, 3, 1.7f}}, {1}},
        {"2\nProperties=Z:I:1:pos:R:3\n6 1 2 3\n1 4 5 6\n", NULL, 2, {{1, 2, 3, 1.7f}, {4, 5, 6, 1.1f}}, {1, 2}},
        {"2\nProperties=pos:R:3:numbers:I:1\n1 2 3 55\n4 5 6 0\n", NULL, 2, {{1, 2, 3, 3.43f}, {4, 5, 6, 2}}, {1, 2}},
    };
    /* clang-format on */
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        expect_reading(".xyz", &files[i]);
}

TEST(xyz_names_and_numbers)
{
    /* clang-format off */
    static const reading files[] = {
        {"1\nfortran\nO  0.100000000000D+01  2.0D0 3.0d-1\n", NULL, 1, {{1, 2, 0.3f, 1.52f}}, {1}},
        {"1\nmathematica\nH\t1.5\t6.3*^-6\t2.5\t0.1\n", NULL, 1, {{1.5f, 6.3e-6f, 2.5f, 1.1f}}, {1}},
        {"\xef\xbb\xbf"
         "1\nmark of UTF-8\nC 1 2 3\n", NULL, 1, {{1, 2, 3, 1.7f}}, {1}},
        {"2\nvmd\n1HB 1 2 3\nHG11 4 5 6\n", "'1HB' is no element", 2, {{1, 2, 3, 1.1f}, {4, 5, 6, 1.1f}}, {1, 2}},
        {"3\nwater\nOW 1 2 3\nHW1 4 5 6\nHW2 4 5 6\n",
         "'OW' is no element: such names are read as labels of atoms, this one as O",
         3, {{1, 2, 3, 1.52f}, {4, 5, 6, 1.1f}, {4, 5, 6, 1.1f}}, {1, 2, 3}},
        {"2\nalpha\nN 1 2 3\nCA 4 5 6\n",
         "'CA' is read as the element Ca", 2, {{1, 2, 3, 1.55f}, {4, 5, 6, 2.31f}}, {1, 2}},
        {"1\nlong\nWater_oxygen_site_A 1 2 3\n", NULL, 1, {{1, 2, 3, 2}}, {1}},
        {"2 angstroem\ncount\nC 1 2 3\nH 4 5 6\n",
         "'angstroem' after the number of spheres", 2, {{1, 2, 3, 1.7f}, {4, 5, 6, 1.1f}}, {1, 2}},
        {"4\nheavy\nCs 0 0 0\nPb 1 0 0\nBa 2 0 0\nBi 3 0 0\n",
         NULL, 4, {{0, 0, 0, 3.43f}, {1, 0, 0, 2.02f}, {2, 0, 0, 2.68f}, {3, 0, 0, 2.07f}}, {1, 2, 3, 4}},
        {"4\nlight\nCl 0 0 0\nCL2 1 0 0\nd 2 0 0\nHg 3 0 0\n",
         NULL, 4, {{0, 0, 0, 1.75f}, {1, 0, 0, 1.75f}, {2, 0, 0, 1.1f}, {3, 0, 0, 2}}, {1, 2, 3, 4}},
    };
    /* clang-format on */
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        expect_reading(".xyz", &files[i]);
}

/* The QM9 set has frequencies, SMILES and InChI after the rows; more rows than the count are damage as before. */
TEST(xyz_lines_after_the_rows)
{
    static const char molecule[] = "1\ngdb 1\t157.7\nH\t0.5\t0.25\t-0.75\t0.1\n1341.3\t1341.4\n[H]\t[H]\nInChI=1S/H2\n";
    char text[512];
    snprintf(text, sizeof text, "%s%s", molecule, molecule);
    cgt_trajectory *t = scratch_open(scratch_text(".xyz", text), NULL);
    for (int i = 0; i < 2; i++) {
        const cgt_trajectory_frame f = scratch_read(t);
        scratch_expect_sphere(&f, 0, 0.5f, 0.25f, -0.75f, 1.1f);
    }
    scratch_expect_end(t);
    const char *warning = cgt_trajectory_take_warning(t);
    assert_true(warning != NULL && strstr(warning, ":4: lines after the rows") != NULL);
    assert_null(cgt_trajectory_take_warning(t));
    scratch_expect_error(scratch_text(".xyz", "1\n\nO 1 2 3\nH 1 2 3\n"), NULL, 1, ":4: the number of spheres");
    scratch_expect_error(scratch_text(".xyz", "1\nProperties=pos:R:3\n1 2 3\n4.5 5 6\n"), NULL, 1,
                         ":4: the number of spheres");
}

#define HEAD(box, count) "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" count "\nITEM: BOX BOUNDS " box
#define CUBE "pp pp pp\n0 10\n0 10\n0 10\n"
#define SLAB "pp pp pp\n0 10\n0 10\n-0.5 0.5\n"
#define TILTED "xy xz yz pp pp pp\n0 12 2\n0 10 0\n0 10 0\n"

TEST(lammps_columns)
{
    /* clang-format off */
    static const reading files[] = {
        {HEAD(CUBE, "2") "ITEM: ATOMS id type element x y z\n1 1 Si 1 2 3\n2 2 O 4 5 6\n",
         NULL, 2, {{1, 2, 3, 2.1f}, {4, 5, 6, 1.52f}}, {1, 2}},
        {HEAD(CUBE, "2") "ITEM: ATOMS element x y z\nO 1 2 3\nSi 4 5 6\n",
         NULL, 2, {{1, 2, 3, 1.52f}, {4, 5, 6, 2.1f}}, {1, 2}},
        {HEAD(CUBE, "1") "ITEM: ATOMS element x y z radius\nO 1 2 3 0.25\n", NULL, 1, {{1, 2, 3, 0.25f}}, {1}},
        {HEAD(SLAB, "1") "ITEM: ATOMS id type x y\n1 7 1 2\n", "there is no column z", 1, {{1, 2, 0, 0.5f}}, {7}},
        {HEAD(SLAB, "1") "ITEM: ATOMS id type xs ys\n1 7 0.5 0.25\n",
         "there is no column z", 1, {{5, 2.5f, 0, 0.5f}}, {7}},
        {HEAD(TILTED, "1") "ITEM: ATOMS id type xs ys\n1 7 0.5 0.5\n",
         "there is no column z", 1, {{6, 5, 0, 0.5f}}, {7}},
        {HEAD(CUBE, "1") "ITEM: ATOMS id type xu yu z\n1 1 1 2 3\n",
         "from the columns xu yu z", 1, {{1, 2, 3, 0.5f}}, {1}},
        {HEAD(CUBE, "1") "ITEM: ATOMS id type x ys z\n1 1 1 0.2 3\n",
         "from the columns x ys z", 1, {{1, 2, 3, 0.5f}}, {1}},
        {HEAD(CUBE, "1") "ITEM: ATOMS id type x y z radius\n1.0 1.0 1 2 3 0.7\n", NULL, 1, {{1, 2, 3, 0.7f}}, {1}},
        {HEAD(CUBE, "3") "ITEM: ATOMS type x y z\nwater 1 2 3\nion 4 5 6\nwater 7 8 9\n",
         NULL, 3, {{1, 2, 3, 0.5f}, {4, 5, 6, 0.5f}, {7, 8, 9, 0.5f}}, {1, 2, 1}},
        {HEAD(CUBE, "2") "ITEM: ATOMS typelabel x y z\nc3 1 2 3\nhc 4 5 6\n",
         NULL, 2, {{1, 2, 3, 0.5f}, {4, 5, 6, 0.5f}}, {1, 2}},
        {HEAD(CUBE, "1") "ITEM: ATOMS typelabel type x y z\nc3 5 1 2 3\n", NULL, 1, {{1, 2, 3, 0.5f}}, {5}},
    };
    /* clang-format on */
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        expect_reading(".lammpstrj", &files[i]);
    scratch_expect_error(scratch_text(".lammpstrj", HEAD(TILTED, "1") "ITEM: ATOMS xs y z\n0.1 2 3\n"), NULL, 0,
                         "in a tilted box");
}

TEST(lammps_wide_ids)
{
    static const char text[] = HEAD(CUBE, "2") "ITEM: ATOMS id type x y z\n4294967296 1 1 2 3\n5000000000 1 4 5 6\n";
    cgt_trajectory *t = scratch_open(scratch_text(".lammpstrj", text), NULL);
    const cgt_trajectory_frame f = scratch_read(t);
    assert_true(f.id[0] == 0 && f.id[1] == 705032704);
    const char *warning = cgt_trajectory_take_warning(t);
    assert_true(warning != NULL && strstr(warning, ":10: ids above 4294967295 are kept modulo 4294967296") != NULL);
}

/* Labels keep their numbers when frames are skipped. */
TEST(lammps_labels_of_skipped_frames)
{
    static const char text[] = HEAD(CUBE, "1") "ITEM: ATOMS type x y z\nwater 1 2 3\n" HEAD(
        CUBE, "1") "ITEM: ATOMS type x y z\nion 1 2 3\n" HEAD(CUBE, "1") "ITEM: ATOMS type x y z\nsalt 1 2 3\n";
    char error[1024];
    cgt_trajectory *t = scratch_open(scratch_text(".lammpstrj", text), NULL);
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    assert_int_equal(scratch_read(t).type[0], 3);
}

SUITE(NULL, NULL)
