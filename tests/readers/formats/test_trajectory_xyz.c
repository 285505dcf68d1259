/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * .xyz: plain and extended, elements and types, damaged files. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

static const char XYZ[] = ".xyz";

TEST(plain_elements)
{
    cgt_trajectory *t =
        scratch_open(scratch_text(XYZ, "3\nwater\nO 0 0 0\nH 0.96 0 0 0.4 extra\n h -0.24 0.93 -1e-3\n\n"
                                       "4\r\nAtoms. Timestep: 120\r\nN 1 2 3\r\nO 4 5 6\r\nC12 7 8 9\r\nUuo 1 1 1"),
                     NULL);
    cgt_trajectory_frame f = scratch_read(t);
    assert_int_equal(f.count, 3);
    assert_int_equal(f.step, 0);
    scratch_expect_sphere(&f, 0, 0, 0, 0, 1.52f);
    scratch_expect_sphere(&f, 1, 0.96f, 0, 0, 1.1f);
    scratch_expect_sphere(&f, 2, -0.24f, 0.93f, -1e-3f, 1.1f);
    assert_true(f.type[0] == 1 && f.type[1] == 2 && f.type[2] == 3);
    assert_true(f.id == NULL && f.velocity == NULL && f.box_min[0] > f.box_max[0]);
    f = scratch_read(t);
    assert_int_equal(f.step, 120);
    assert_true(f.type[0] == 4 && f.type[1] == 1 && f.type[2] == 5 && f.type[3] == 6);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 1.55f);
    scratch_expect_sphere(&f, 2, 7, 8, 9, 1.7f);
    scratch_expect_sphere(&f, 3, 1, 1, 1, 2.0f);
    scratch_expect_end(t);
}

TEST(radii_of_the_documented_elements)
{
    static const struct {
        const char *symbol;
        float radius;
    } known[] = {{"H", 1.1f}, {"C", 1.7f}, {"N", 1.55f}, {"O", 1.52f}, {"S", 1.8f}, {"P", 1.8f}, {"Fe", 2.0f}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "1\n\n%s 1 2 3\n", known[i].symbol);
        const cgt_trajectory_frame f = scratch_read(scratch_open(scratch_text(XYZ, text), NULL));
        scratch_expect_sphere(&f, 0, 1, 2, 3, known[i].radius);
    }
}

TEST(numbers_are_types)
{
    const char *path = scratch_text(XYZ, "2\n\n3 1 2 3\n0 4 5 6\n");
    cgt_trajectory_frame f = scratch_read(scratch_open(path, NULL));
    scratch_expect_sphere(&f, 0, 1, 2, 3, 0.5f);
    assert_true(f.type[0] == 3 && f.type[1] == 0);
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.radius = 0.25f;
    f = scratch_read(scratch_open(path, &options));
    scratch_expect_sphere(&f, 1, 4, 5, 6, 0.25f);
    f = scratch_read(scratch_open(scratch_text(XYZ, "1\n\nC 1 2 3\n"), &options));
    scratch_expect_sphere(&f, 0, 1, 2, 3, 0.25f);
}

TEST(extended_columns)
{
    cgt_trajectory *t = scratch_open(
        scratch_text(XYZ, "1\nLattice=\"4 0 0 1 8 0 0 0 2\" Properties=species:S:1:pos:R:3:radius:R:1:velo:R:3 "
                          "Timestep=40\nSi 1 2 3 .75 4 5 6\n"
                          "1\nProperties=\"id:I:1:force:R:3:pos:R:3:type:I:1\" Origin=\"1 1 -1\" "
                          "Lattice=\"4 0 0 0 8 0 -1 0 2\"\n9 x y z 1 2 3 7\n"
                          "1\nProperties=pos:R:3:species:S:1 Lattice=cubic\n1 2 3 C\n"
                          "0\nProperties=pos:R:3:diameter:R:1\n"
                          "1\nProperties=pos:R:3:diameter:R:1:type:S:1\n1 2 3 4 B\n"
                          "1\nProperties=species:S:1:pos:R:3:type:I:1\nN 1 2 3 77\n"),
        NULL);
    cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 0.75f);
    assert_true(f.velocity[0] == 4 && f.velocity[2] == 6 && f.type[0] == 1 && f.step == 40);
    assert_true(f.box_min[0] == 0 && f.box_max[0] == 5 && f.box_max[1] == 8 && f.box_max[2] == 2);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 0.5f);
    assert_true(f.id[0] == 9 && f.type[0] == 7 && f.velocity == NULL && f.step == 1);
    assert_true(f.box_min[0] == 0 && f.box_max[0] == 5 && f.box_min[1] == 1 && f.box_min[2] == -1);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 1.7f);
    assert_true(f.type[0] == 2 && f.box_min[0] > f.box_max[0]);
    f = scratch_read(t);
    assert_int_equal(f.count, 0);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 2);
    assert_int_equal(f.type[0], 3);
    f = scratch_read(t);
    scratch_expect_sphere(&f, 0, 1, 2, 3, 1.55f);
    assert_int_equal(f.type[0], 77);
    scratch_expect_end(t);
}

/* Spellings of the box, and the keys that ASE writes beside it. */
TEST(boxes_of_comments)
{
    static const struct {
        const char *comment;
        double edge[3], tilt; /* the diagonal, and y of the third edge */
        int8_t periodic[3];
    } cases[] = {
        {"Lattice=\"5 0 0 1 6 0 0 2 7\" Properties=species:S:1:pos:R:3 name=\"say \\\"hi\\\" = [1] {x}\" "
         "\"key with blank\"=3 flag alone virial=\"1 0 0 0 1 0 0 0 1\" e= nested=\"_JSON {\\\"a\\\": [1, 2]}\" "
         "bools=\"T F\" stress=\"nan -nan inf 0 0 0\" pbc=\"T F T\"",
         {5, 6, 7},
         2,
         {1, 0, 1}},
        {"Lattice=[[5,0,0], [0,6,0], [0,-1,7]] pbc=[T,T,F]", {5, 6, 7}, -1, {1, 1, 0}},
        {"pbc={false true 1} Lattice={5 0 0 0 6 0 0 0 7}", {5, 6, 7}, 0, {0, 1, 1}},
        {"Lattice=\"5 6 7\" pbc=F", {5, 6, 7}, 0, {0, 0, 0}},
        {"Lattice=\"5 6 7 8\" pbc", {0, 0, 0}, 0, {-1, -1, -1}},
        {"Lattice=\"1e1,2d0, 3\" pbc=\"T\"", {10, 2, 3}, 0, {1, 1, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[512];
        snprintf(text, sizeof text, "1\n%s\nO 1 2 3\n", cases[i].comment);
        const cgt_trajectory_frame f = scratch_read(scratch_open(scratch_text(XYZ, text), NULL));
        scratch_expect_sphere(&f, 0, 1, 2, 3, 1.52f);
        for (int k = 0; k < 3; k++)
            if (f.box_edge[k][k] != cases[i].edge[k] || f.periodic[k] != cases[i].periodic[k])
                fail_msg("row %zu, edge %d: %g, %d", i, k, f.box_edge[k][k], f.periodic[k]);
        assert_true(f.box_edge[2][1] == cases[i].tilt);
    }
}

/* Types are numbered over the whole file, whether its frames are read, skipped or read again. */
TEST(types_stay_the_same)
{
    cgt_trajectory *t = scratch_open(scratch_text(XYZ, "1\n\nC 1 2 3\n1\n\nH 1 2 3\n2\n\nH 1 1 1\nC 1 1 1\n"), NULL);
    char error[1024] = "";
    for (int pass = 0; pass < 2; pass++) {
        assert_int_equal(told_skip(t, error, sizeof error), 1);
        assert_int_equal(told_skip(t, error, sizeof error), 1);
        const cgt_trajectory_frame f = scratch_read(t);
        assert_int_equal(f.number, 2);
        assert_true(f.type[0] == 2 && f.type[1] == 1);
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
    }
}

TEST(empty_frames)
{
    cgt_trajectory *t = scratch_open(scratch_text(XYZ, "\n0\nnothing\n0\n\n1\nO 1 1 1\nO 2 2 2\n"), NULL);
    assert_int_equal(scratch_read(t).count, 0);
    assert_int_equal(scratch_read(t).count, 0);
    assert_int_equal(scratch_read(t).count, 1);
    scratch_expect_end(t);
    scratch_expect_end(scratch_open(scratch_text(XYZ, ""), NULL));
}

/* A comment may contain anything. */
TEST(odd_comments)
{
    static const char *const comments[] = {
        "3",          "ITEM: TIMESTEP", "Timestep: soon", "Lattice=\"1 2\"",
        "Lattice=\"", "xProperties=1",  "Timestep=",      "Lattice=\"1 0 0 0 1 0 0 0 nan\"",
    };
    for (size_t i = 0; i < sizeof comments / sizeof comments[0]; i++) {
        char text[128];
        snprintf(text, sizeof text, "1\n%s\nO 1 2 3\n", comments[i]);
        cgt_trajectory *t = scratch_open(scratch_text(XYZ, text), NULL);
        const cgt_trajectory_frame f = scratch_read(t);
        scratch_expect_sphere(&f, 0, 1, 2, 3, 1.52f);
        assert_true(f.step == 0 && f.box_min[0] > f.box_max[0]);
        scratch_expect_end(t);
    }
}

TEST(every_truncation_is_noticed)
{
    static const char text[] = "2\nfirst\nO 1 2 3\nH 4 5 6\n1\n\nO 7 8 9\n";
    const size_t first = (size_t)(strstr(text, "1\n\n") - text);
    const size_t ends[2] = {first, sizeof text - 1};
    scratch_expect_cuts(XYZ, text, 2, ends, (const uint32_t[]){2, 1});
}

TEST(damage_is_named_with_its_line)
{
    static const scratch_damage damaged[] = {
        {"three\n\n", 0, ":1: 'three' is not a number of spheres"},
        {"-1\n\n", 0, ":1: '-1' is not a number of spheres"},
        {"2 3\n\nO 1 2 3\n", 0, ":1: the number of spheres must stand alone"},
        {"99999999999\n\nO 1 2 3\n", 0, ":1: 99999999999 spheres are more than the limit"},
        {"1\n", 0, ":1: the file ends before the comment"},
        {"2\n\nO 1 2 3\n", 0, ":3: the file ends after 1 of 2 spheres"},
        {"2\n\nO 1 2 3\nH 1 2\n", 0, ":4: 3 columns where 4 are expected"},
        {"1\n\nO 1 2 3\nH 1 2 3\n", 1, ":4: the number of spheres must stand alone"},
        {"1\n\nO 1 2 z\n", 0, ":3: column 4: 'z' is not a number"},
        {"1\n\n1.5 1 2 3\n", 0, ":3: '1.5' is not the name of an element, or a type"},
        {"1\n\n4294967296 1 2 3\n", 0, ":3: '4294967296' is not the name"},
        {"1\n\nUnreasonably_long_names_of_many_sites_and_residues_and_molecules 1 2 3\n", 0,
         "the name is longer than 63"},
        {"1\nProperties=species:S:1\nO\n", 0, ":2: Properties= has no pos:R:3"},
        {"1\nProperties=pos:R:2:species:S:1\n1 2 O\n", 0, ":2: Properties=: 'pos' must be pos:R:3"},
        {"1\nProperties=pos:S:3\n1 2 3\n", 0, ":2: Properties=: 'pos' must be pos:R:3"},
        {"1\nProperties=\n1 2 3\n", 0, ":2: Properties= has no pos:R:3"},
        {"1\nProperties=pos:R\n1 2 3\n", 0, ":2: Properties= is not a list"},
        {"1\nProperties=pos::3\n1 2 3\n", 0, ":2: Properties= is not a list"},
        {"1\nProperties=a:R:0:pos:R:3\n1 2 3\n", 0, ":2: Properties= is not a list"},
        {"1\nProperties=a:R:4000:pos:R:3:b:R:4000\n1 2 3\n", 0, ":2: more than 4096 columns"},
        {"1\nProperties=a:R:99999999999:pos:R:3\n1 2 3\n", 0, ":2: Properties= is not a list"},
        {"1\nProperties=pos:R:3\n1 2 3 4\n", 0, ":3: more than the expected 3 columns: '4'"},
        {"1\nProperties=pos:R:3:id:I:1\n1 2 3 -4\n", 0, ":3: column 4: '-4' is not an id"},
    };
    scratch_expect_damage(XYZ, damaged, sizeof damaged / sizeof damaged[0]);
}

TEST(too_many_names)
{
    const char *path = scratch_path(XYZ);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "1026\n\n");
    for (int i = 0; i < 1025; i++)
        fprintf(file, "A%d 0 0 0\n", i);
    fprintf(file, "C7 1 0 0\n");
    assert_int_equal(fclose(file), 0);
    cgt_trajectory *t = scratch_open(path, NULL);
    const cgt_trajectory_frame frame = scratch_read(t);
    assert_true(frame.type[1023] == 1024 && frame.type[1024] == 1025 && frame.type[1025] == 1025);
    scratch_expect_sphere(&frame, 1024, 0, 0, 0, 2.0f);
    scratch_expect_sphere(&frame, 1025, 1, 0, 0, 1.7f);
    assert_non_null(
        strstr(cgt_trajectory_take_warning(t), ":1027: more than 1024 different names: the others share one"));
}

SUITE(NULL, NULL)
