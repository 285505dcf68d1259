/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Columns under their names, elements, time, and the box by its edges. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

static const char dump[] = "ITEM: TIME\n2.5\n"
                           "ITEM: TIMESTEP\n100\n"
                           "ITEM: NUMBER OF ATOMS\n2\n"
                           "ITEM: BOX BOUNDS xy xz yz pp ff pp\n0 12 2\n0 10 0\n-1 9 0\n"
                           "ITEM: ATOMS id type element x y z vx vy vz c_pe f_ave[2] fx\n"
                           "7 1 O 1 2 3 4 5 6 -1.25 0.5 8\n"
                           "9 2 H 2 3 4 0 0 1 3e-2 1e10 -8\n";

static void expect_column(const cgt_trajectory_frame *frame, const char *name, cgt_trajectory_column_kind kind,
                          float first, float second)
{
    const cgt_trajectory_column *const column = cgt_trajectory_find_column(frame, name);
    if (column == NULL || column->value == NULL) {
        fail_msg("no column %s", name);
        return;
    }
    assert_int_equal(column->kind, kind);
    if (column->value[0] != first || column->value[1] != second)
        fail_msg("column %s: %g %g, not %g %g", name, (double)column->value[0], (double)column->value[1], (double)first,
                 (double)second);
}

TEST(test_lammps)
{
    static const char *const names[] = {"c_pe", "f_ave[2]", "x", "element", "id", "type", "vz", "radius", "absent"};
    cgt_trajectory *t = scratch_open(scratch_text(".dump", dump), NULL);
    scratch_want(t, names, sizeof names / sizeof names[0]);
    const cgt_trajectory_frame frame = scratch_read(t);
    expect_column(&frame, "c_pe", CGT_TRAJECTORY_NUMBER, -1.25f, 3e-2f);
    expect_column(&frame, "f_ave[2]", CGT_TRAJECTORY_NUMBER, 0.5f, 1e10f);
    expect_column(&frame, "x", CGT_TRAJECTORY_NUMBER, 1.0f, 2.0f);
    expect_column(&frame, "vz", CGT_TRAJECTORY_NUMBER, 6.0f, 1.0f);
    expect_column(&frame, "id", CGT_TRAJECTORY_WHOLE, 7.0f, 9.0f);
    expect_column(&frame, "type", CGT_TRAJECTORY_WHOLE, 1.0f, 2.0f);
    expect_column(&frame, "radius", CGT_TRAJECTORY_NUMBER, 1.52f, 1.10f);
    expect_column(&frame, "element", CGT_TRAJECTORY_WORD, 1.0f, 2.0f);
    const cgt_trajectory_column *const element = cgt_trajectory_find_column(&frame, "element");
    assert_int_equal(element->words, 2);
    assert_string_equal(element->word[0], "O");
    assert_string_equal(element->word[1], "H");
    /* listed, but not asked for */
    assert_non_null(cgt_trajectory_find_column(&frame, "fx"));
    assert_null(cgt_trajectory_find_column(&frame, "fx")->value);
    assert_null(cgt_trajectory_find_column(&frame, "absent"));
    assert_int_equal(frame.columns, 13);
    assert_int_equal(frame.element[0], 8);
    assert_int_equal(frame.element[1], 1);
    scratch_expect_end(t);
}

TEST(test_box)
{
    const cgt_trajectory_frame frame = scratch_read(scratch_open(scratch_text(".dump", dump), NULL));
    static const double edge[3][3] = {{10, 0, 0}, {2, 10, 0}, {0, 0, 10}}, origin[3] = {0, 0, -1};
    static const int8_t periodic[3] = {1, 0, 1};
    assert_memory_equal(frame.box_edge, edge, sizeof edge);
    assert_memory_equal(frame.box_origin, origin, sizeof origin);
    assert_memory_equal(frame.periodic, periodic, sizeof periodic);
    assert_true(frame.time == 2.5);
}

TEST(test_xyz)
{
    static const char *const names[] = {"fx", "fz", "q", "dipole_y", "fixed", "residue", "stress_4", "vx", "species"};
    cgt_trajectory *t = scratch_open(
        scratch_text(".xyz",
                     "2\nLattice=\"5 0 0 1 6 0 0 0 7\" pbc=\"T F T\" Time=0.25 Properties=species:S:1:pos:R:3:forces:"
                     "R:3:q:R:1:dipole:R:3:fixed:L:1:residue:S:1:stress:R:4:velo:R:3\n"
                     "C 0 0 0 1 2 3 0.5 4 5 6 T ALA 1 2 3 4 7 8 9\nX 1 1 1 3 2 1 -0.5 6 -5 4 F GLY 4 3 2 1 9 8 7\n"),
        NULL);
    scratch_want(t, names, sizeof names / sizeof names[0]);
    const cgt_trajectory_frame frame = scratch_read(t);
    expect_column(&frame, "fx", CGT_TRAJECTORY_NUMBER, 1.0f, 3.0f);
    expect_column(&frame, "fz", CGT_TRAJECTORY_NUMBER, 3.0f, 1.0f);
    expect_column(&frame, "q", CGT_TRAJECTORY_NUMBER, 0.5f, -0.5f);
    expect_column(&frame, "dipole_y", CGT_TRAJECTORY_NUMBER, 5.0f, -5.0f);
    expect_column(&frame, "fixed", CGT_TRAJECTORY_WHOLE, 1.0f, 0.0f);
    expect_column(&frame, "residue", CGT_TRAJECTORY_WORD, 1.0f, 2.0f);
    expect_column(&frame, "stress_4", CGT_TRAJECTORY_NUMBER, 4.0f, 1.0f);
    expect_column(&frame, "vx", CGT_TRAJECTORY_NUMBER, 7.0f, 9.0f);
    assert_int_equal(frame.element[0], 6);
    assert_int_equal(frame.element[1], 0);
    assert_true(frame.time == 0.25);
    assert_true(frame.box_edge[1][0] == 1.0 && frame.box_edge[1][1] == 6.0 && frame.box_max[0] == 6.0f);
    assert_true(frame.periodic[0] == 1 && frame.periodic[1] == 0 && frame.periodic[2] == 1);
}

/* A number of no use does no harm until it is asked for. */
TEST(test_bad_value)
{
    static const char text[] = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x y z q\n1 2 3 nonsense\n";
    static const char *const names[] = {"q"};
    const char *path = scratch_text(".dump", text);
    scratch_read(scratch_open(path, NULL));
    cgt_trajectory *t = scratch_open(path, NULL);
    scratch_want(t, names, 1);
    char error[1024] = "";
    cgt_trajectory_frame frame;
    assert_int_equal(told_read(t, &frame, error, sizeof error), -1);
    assert_non_null(strstr(error, "column 4: 'nonsense' is not a number"));
}

/* Columns may change from frame to frame, and frames without atoms have columns, too. */
TEST(test_change)
{
    static const char text[] =
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: ATOMS x y z q\n"
        "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS q x y z q\n5 0 0 0 6\n7 0 0 0 8\n"
        "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x y z\n1 1 1\n";
    static const char *const names[] = {"q"};
    cgt_trajectory *t = scratch_open(scratch_text(".dump", text), NULL);
    scratch_want(t, names, 1);
    cgt_trajectory_frame frame = scratch_read(t);
    assert_non_null(cgt_trajectory_find_column(&frame, "q")->value);
    frame = scratch_read(t);
    expect_column(&frame, "q", CGT_TRAJECTORY_NUMBER, 5.0f, 7.0f);
    frame = scratch_read(t);
    assert_null(cgt_trajectory_find_column(&frame, "q"));
    assert_true(isnan(frame.time));
    assert_null(frame.element);
    assert_null(frame.bond);
    assert_true(frame.periodic[0] == -1);
}

TEST(test_too_many)
{
    char error[1024] = "";
    static const char *names[CGT_TRAJECTORY_MOST_COLUMNS + 1];
    cgt_trajectory *t = scratch_open(scratch_text(".dump", dump), NULL);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        names[i] = "q";
    assert_int_equal(told_want_columns(t, names, CGT_TRAJECTORY_MOST_COLUMNS + 1, error, sizeof error), -1);
    assert_non_null(strstr(error, "256 columns"));
    scratch_want(t, names, CGT_TRAJECTORY_MOST_COLUMNS);
    scratch_read(t);
}

SUITE(NULL, NULL)
