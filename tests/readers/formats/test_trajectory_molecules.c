/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formats of molecules, case by case: what a file may have that those of other tests have not. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

static const char *word_of(const cgt_trajectory_frame *frame, const char *column, uint32_t i)
{
    const cgt_trajectory_column *const c = cgt_trajectory_find_column(frame, column);
    assert_true(c != NULL && c->value != NULL && c->kind == CGT_TRAJECTORY_WORD && c->value[i] >= 1.0f);
    return c->word[(uint32_t)c->value[i] - 1];
}

/* ---- .gro ---------------------------------------------------------------------------------------------------- */

TEST(test_gro)
{
    static const char *const names[] = {"name", "resname", "resid"};
    cgt_trajectory *t = scratch_open(
        scratch_text(".gro", "Protein in water t= 2.5 step= 1250\n4\n"
                             "    1ALA     CA    1   0.12345   1.23456  -2.34567  0.100000  0.200000  0.300000\n"
                             "    2CA      CA    2   1.00000   1.00000   1.00000  0.000000  0.000000  0.000000\n"
                             "    3SOL    HW1    3   1.00000   1.00000   1.00000  0.000000  0.000000  0.000000\n"
                             "    4NA+     NA    4   1.00000   1.00000   1.00000  0.000000  0.000000  0.000000\n"
                             "   2.00000   2.10000   2.20000   0.00000   0.00000   1.00000   0.00000   "
                             "0.50000   0.60000\n"),
        NULL);
    scratch_want(t, names, 3);
    const cgt_trajectory_frame frame = scratch_read(t);
    scratch_expect_sphere(&frame, 0, 0.12345f, 1.23456f, -2.34567f, 0.1f * 1.70f);
    static const uint8_t elements[4] = {6, 20, 1, 11};
    assert_memory_equal(frame.element, elements, 4);
    assert_true(frame.time == 2.5 && frame.step == 1250);
    assert_true(frame.velocity[1] == 0.2f);
    assert_true(frame.box_edge[1][0] == 1.0 && frame.box_edge[2][0] == 0.5 && frame.box_edge[2][1] == 0.6);
    assert_string_equal(word_of(&frame, "resname", 2), "SOL");
    assert_string_equal(word_of(&frame, "name", 2), "HW1");
    assert_true(cgt_trajectory_find_column(&frame, "resid")->value[3] == 4.0f);
    scratch_expect_end(t);
}

TEST(test_gro_errors)
{
    static const scratch_damage cases[] = {
        {"title\nmany\n", 0, ":2: 'many' is not a number of spheres"},
        {"title\n2\n    1SOL     OW    1   0.126   1.624   1.679\n", 0, ":3: the file ends after 1 of 2 spheres"},
        {"title\n1\n    1SOL     OW    1   0 1 2\n 1 1 1\n", 0, ":3: no three coordinates with decimal points"},
        {"title\n1\n    1SOL     OW    1   0.126   1.6x4   1.679\n 1 1 1\n", 0, ":3: '1.6x4' in columns 29 to 36"},
        {"title\n1\n    1SOL     OW    1   0.126   1.624   1.679\n 1 1\n", 0,
         ":4: 2 numbers where the box needs 3 or 9"},
    };
    scratch_expect_damage(".gro", cases, sizeof cases / sizeof cases[0]);
}

/* ---- .pdb ---------------------------------------------------------------------------------------------------- */

static const char pdb[] = "REMARK\n"
                          "CRYST1   10.000   20.000   30.000  90.00  90.00  60.00 P 1           1\n"
                          "MODEL        1\n"
                          "ATOM      1  CA  ALA A   1       1.000   2.000   3.000  0.50 12.50           C  \n"
                          "HETATM    2 CA    CA A   2       4.000   5.000   6.000  1.00  0.00          CA  \n"
                          "ATOM      3 HG11 VAL B   3      -1.000  -2.000  -3.000\n"
                          "ENDMDL\n"
                          "MODEL        5\n"
                          "ATOM      1  CA  ALA A   1       1.500   2.000   3.000  0.50 12.50           C  \n"
                          "ATOM  ***** FE   HEM A   2       4.000   5.000   6.000\n"
                          "ENDMDL\n"
                          "CONECT    1    3    2\n"
                          "CONECT    3    1\n"
                          "END\n";

TEST(test_pdb)
{
    static const char *const names[] = {"chain", "b_factor", "occupancy"};
    cgt_trajectory *t = scratch_open(scratch_text(".pdb", pdb), NULL);
    scratch_want(t, names, 3);
    cgt_trajectory_frame frame = scratch_read(t);
    assert_int_equal(frame.count, 3);
    scratch_expect_sphere(&frame, 0, 1, 2, 3, 1.70f);
    scratch_expect_sphere(&frame, 1, 4, 5, 6, 2.31f);
    scratch_expect_sphere(&frame, 2, -1, -2, -3, 1.10f);
    static const uint8_t elements[3] = {6, 20, 1};
    static const uint32_t bonds[4] = {0, 1, 0, 2}; /* each once, also before the file's end is read */
    assert_memory_equal(frame.element, elements, 3);
    assert_int_equal(frame.bonds, 2);
    assert_memory_equal(frame.bond, bonds, sizeof bonds);
    assert_int_equal(frame.step, 1);
    assert_true(fabs(frame.box_edge[1][0] - 10.0) < 1e-9 && frame.box_edge[2][2] == 30.0);
    assert_string_equal(word_of(&frame, "chain", 2), "B");
    assert_true(cgt_trajectory_find_column(&frame, "b_factor")->value[0] == 12.5f);
    assert_true(isnan(cgt_trajectory_find_column(&frame, "occupancy")->value[2]));
    frame = scratch_read(t);
    assert_int_equal(frame.step, 5);
    assert_int_equal(frame.element[1], 26);
    assert_int_equal(frame.id[1], 2); /* *****: counts on */
    assert_int_equal(frame.bonds, 1);
    scratch_expect_end(t);
    assert_null(cgt_trajectory_take_warning(t));
}

/* Programs of molecular dynamics write END after each frame, and no models. */
TEST(test_pdb_frames)
{
    cgt_trajectory *t =
        scratch_open(scratch_text(".pdb", "ATOM      1  O   HOH A   1       1.000   2.000   3.000\nEND\n"
                                          "ATOM      1  O   HOH A   1       2.000   2.000   3.000\n"
                                          "ATOM      2  H1  HOH A   1       2.000   2.000   3.000\n"
                                          "CONECT    1    2\n"),
                     NULL);
    cgt_trajectory_frame frame = scratch_read(t);
    assert_int_equal(frame.count, 1);
    frame = scratch_read(t);
    assert_int_equal(frame.count, 2);
    assert_int_equal(frame.bonds, 1);
    assert_non_null(strstr(cgt_trajectory_take_warning(t), "no END after the last atom"));
    scratch_expect_end(t);
    scratch_expect_error(scratch_text(".pdb", "MODEL 1\nATOM      1  O   HOH A   1       1.000   2.000   3.000\n"),
                         NULL, 0, ":2: the file ends in a model");
    scratch_expect_error(scratch_text(".pdb", "ATOM      1  O   HOH A   1       1.000   2.0y0   3.000\n"), NULL, 0,
                         ":1: '2.0y0' in columns 39 to 46 is not a coordinate");
    scratch_expect_error(scratch_text(".pdb", "3\nxyz\nC 1 2 3\n"), NULL, 0, "this is not PDB");
}

/* ---- Elements by names --------------------------------------------------------------------------------------- */

/* Residue, name, and the element that is right; a guess is told. */
static const struct {
    const char *residue, *name;
    uint8_t element;
    int is_guess;
} named_atoms[] = {
    {"HISE", "CA", 6, 0},  {"HISE", "CD2", 6, 0}, {"HISE", "NE2", 7, 0}, {"HISE", "HE2", 1, 0},  {"LYSH", "CE", 6, 0},
    {"CYS2", "SG", 16, 0}, {"HISB", "ND1", 7, 0}, {"NALA", "CA", 6, 0},  {"QLN", "NE2", 7, 0},   {"CLEU", "CD1", 6, 0},
    {"DA5", "HO5'", 1, 0}, {"RA3", "C5'", 6, 0},  {"SOL", "HW1", 1, 0},  {"TIP3", "OH2", 8, 0},  {"SOL", "MW", 0, 0},
    {"ALA", "Ca", 6, 0},   {"ALA", "1HB", 1, 0},  {"VAL", "HG11", 1, 0}, {"CA", "CA", 20, 0},    {"CAL", "CAL", 20, 0},
    {"SOD", "SOD", 11, 0}, {"NA", "NA", 11, 0},   {"NA+", "NA+", 11, 0}, {"CLA", "CLA", 17, 0},  {"CL-", "CL", 17, 0},
    {"POT", "POT", 19, 0}, {"K", "K", 19, 0},     {"ZN2", "ZN", 30, 0},  {"CES", "CES", 55, 0},  {"ION", "Cl-", 17, 0},
    {"HEM", "FE", 26, 0},  {"HEM", "NA", 7, 1},   {"HEM", "CHA", 6, 0},  {"LIG", "CLAA", 17, 1}, {"LIG", "CL1", 17, 1},
    {"LIG", "BR1", 35, 0}, {"LIG", "CAA", 6, 0},  {"LIG", "Cl1", 17, 0}, {"LIG", "C12", 6, 0},   {"DLPC", "C21", 6, 0},
    {"POPG", "P", 15, 0},  {"MSE", "SE", 34, 0},  {"MSE", "CE", 6, 0},   {"TPO", "CG2", 6, 0},   {"LIG", "OS", 8, 1},
    {"POPS", "HS", 1, 0},  {"LIG", "ca", 6, 1},   {"LIG", "F1", 9, 0},   {"LIG", "DUM", 0, 0},   {"C", "C", 6, 0},
};
enum { NAMED_ATOMS = sizeof named_atoms / sizeof named_atoms[0] };

TEST(test_elements_of_gro)
{
    for (size_t i = 0; i < NAMED_ATOMS; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "t\n2\n    1%-5s%5s    1   1.000   2.000   3.000\n    2SOL     OW    2   0.000   "
                 "0.000   0.000\n   1.0   1.0   1.0\n",
                 named_atoms[i].residue, named_atoms[i].name);
        cgt_trajectory *t = scratch_open(scratch_text(".gro", text), NULL);
        const cgt_trajectory_frame frame = scratch_read(t);
        const char *const warning = cgt_trajectory_take_warning(t);
        if (frame.element[0] != named_atoms[i].element || (warning != NULL) != named_atoms[i].is_guess)
            fail_msg("%s %s: element %u, %s", named_atoms[i].residue, named_atoms[i].name, frame.element[0],
                     warning != NULL ? warning : "no warning");
        if (warning != NULL)
            assert_non_null(strstr(warning, "1 atoms have names that are an element's symbol or the label of another"));
    }
}

/* By the columns of the name, unless the file shows that it does not keep to them. */
TEST(test_elements_of_pdb)
{
    static const struct {
        const char *first, *name, *residue;
        uint8_t element;
    } rows[] = {{" N  ", " NA ", "HEM", 7},  {" N  ", "NA  ", "ZZZ", 11}, {" N  ", " CA ", "ZZZ", 6},
                {" N  ", "CA  ", "ZZZ", 20}, {"N   ", "CA  ", "ZZZ", 6},  {"N   ", "CA  ", " CA", 20},
                {" N  ", "HG11", "ZZZ", 1},  {" N  ", "FE  ", "HEM", 26}, {" N  ", " FE ", "HEM", 26},
                {" N  ", "CLAA", "LIG", 17}, {" N  ", " CL ", "CLA", 17}, {" N  ", "CA  ", "ALA", 6},
                {" N  ", " HG1", "ZZZ", 1},  {" N  ", "1HB ", "ZZZ", 1}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "ATOM      1 %s ALA A   1       1.000   2.000   3.000\n"
                 "ATOM      2 %s %s A   2       1.000   2.000   3.000\nEND\n",
                 rows[i].first, rows[i].name, rows[i].residue);
        const cgt_trajectory_frame frame = scratch_read(scratch_open(scratch_text(".pdb", text), NULL));
        if (frame.element[0] != 7 || frame.element[1] != rows[i].element)
            fail_msg("'%s' in '%s': element %u", rows[i].name, rows[i].residue, frame.element[1]);
    }
}

/* ---- Bonds beyond atom 99,999 -------------------------------------------------------------------------------- */

/* Six atoms with these numbers, then lines of CONECT; the bonds are those of two molecules of water. */
static void expect_waters(const char *const number[6], const char *conect)
{
    static const uint32_t bonds[8] = {0, 1, 0, 2, 3, 4, 3, 5};
    char text[1024];
    size_t at = 0;
    for (int i = 0; i < 6; i++)
        at += (size_t)sprintf(text + at, "ATOM  %s  %s  SOL  3333       0.000   0.000   0.000\n", number[i],
                              i % 3 == 0 ? "OW" : "HW");
    sprintf(text + at, "%sEND\n", conect);
    const cgt_trajectory_frame frame = scratch_read(scratch_open(scratch_text(".pdb", text), NULL));
    if (frame.bonds != 4)
        fail_msg("%u bonds of %s", frame.bonds, conect);
    assert_memory_equal(frame.bond, bonds, sizeof bonds);
    for (uint32_t i = 1; i < 6; i++)
        assert_int_equal(frame.id[i], frame.id[0] + i);
}

TEST(test_conect_beyond_99999)
{
    expect_waters((const char *const[]){"99998", "99999", "A0000", "A0001", "A0002", "A0003"},
                  "CONECT9999899999A0000\nCONECTA0001A0002A0003\n");
    expect_waters((const char *const[]){"99998", "99999", "186a0", "186a1", "186a2", "186a3"},
                  "CONECT9999899999186a0\nCONECT186a1186a2186a3\n");
    expect_waters((const char *const[]){"186fe", "186ff", "18700", "18701", "18702", "18703"},
                  "CONECT186fe186ff18700\nCONECT187011870218703\n");
    assert_non_null(strstr(cgt_trajectory_take_warning(scratch_open_one), "may be decimal or hexadecimal"));
    expect_waters((const char *const[]){"99998", "99999", "    0", "    1", "    2", "    3"},
                  "CONECT9999899999100000\nCONECT100001100002100003\n");
    expect_waters((const char *const[]){"99998", "99999", "*****", "*****", "*****", "*****"},
                  "CONECT 99998 99999100000   \nCONECT100001100002100003\n");
    expect_waters((const char *const[]){"ZZZZY", "ZZZZZ", "a0000", "a0001", "a0002", "a0003"},
                  "CONECTZZZZYZZZZZa0000\nCONECTa0001a0002a0003\n");
    expect_waters((const char *const[]){"   10", "   11", "   12", "   13", "   14", "   15"},
                  "CONECT   10   11   12\nCONECT   13   14   15\n");
}

/* CONECT inside of a model is that model's own. */
TEST(test_conect_of_models)
{
#define TWO                                                                                                            \
    "ATOM      1  O   HOH A   1       1.000   2.000   3.000\nATOM      2  H   HOH A   1       1.000   2.000   3.000\n"
    cgt_trajectory *t = scratch_open(
        scratch_text(".pdb", "MODEL        1\n" TWO "CONECT    1    2\nENDMDL\nMODEL        2\n" TWO "ENDMDL\nEND\n"),
        NULL);
    assert_int_equal(scratch_read(t).bonds, 1);
    assert_int_equal(scratch_read(t).bonds, 0);
    scratch_expect_end(t);
    t = scratch_open(
        scratch_text(".pdb", "MODEL        1\n" TWO "ENDMDL\nMODEL        2\n" TWO "ENDMDL\nCONECT    1    2\nEND\n"),
        NULL);
    assert_int_equal(scratch_read(t).bonds, 1);
    assert_int_equal(scratch_read(t).bonds, 1);
}

/* ---- VASP ---------------------------------------------------------------------------------------------------- */

/* Sphere i of the first frame. */
static cgt_trajectory_frame read_vasp(const char *text, uint32_t i, float x, float y, float z, float r)
{
    const cgt_trajectory_frame frame = scratch_read(scratch_open(scratch_text("", text), NULL)); /* by its content */
    scratch_expect_sphere(&frame, i, x, y, z, r);
    return frame;
}

#define CUBE "2 0 0\n0 2 0\n0 0 2\n"

TEST(test_poscar)
{
    cgt_trajectory_frame f = read_vasp(
        "title\n2.0\n" CUBE "Si O_s\n1 2\nDirect\n0 0 0\n0.5 0.25 0 O\n0 0 0.75\n\n1 1 1\n", 1, 2, 1, 0, 1.52f);
    assert_true(f.count == 3 && f.element[0] == 14 && f.element[2] == 8 && f.type[2] == 2 && f.box_edge[1][1] == 4.0);
    assert_int_equal(f.periodic[0], 1);
    scratch_expect_end(scratch_open_one);
    read_vasp("t\n2.0\n" CUBE "Si\n1\nSelective dynamics\nCartesian\n1 0.5 0 T F T\n", 0, 2, 1, 0, 2.10f);
    read_vasp("t\n2 3 4\n" CUBE "Si\n1\nkartesisch\n1 1 1\n", 0, 2, 3, 4, 2.10f);
    f = read_vasp("t\n-64\n" CUBE "Si\n1\ndirect\n0.5 0 0\n", 0, 2, 0, 0, 2.10f); /* a volume */
    assert_true(fabs(f.box_edge[0][0] - 4.0) < 1e-12);
    f = read_vasp("Na Cl\n1\n" CUBE "1 1\nDirect\n0 0 0\n0.5 0 0\n", 1, 1, 0, 0, 1.75f); /* VASP 4 */
    assert_int_equal(f.element[0], 11);
    f = read_vasp("rock salt\n1\n" CUBE "1 1\nDirect\n0 0 0\n0.5 0 0\n", 1, 1, 0, 0, 1.0f);
    assert_true(f.element == NULL && f.type[1] == 2);
    static const scratch_damage damage[] = {
        {"t\nx\n" CUBE "1\nD\n0 0 0\n", 0, ":2: a scale"},
        {"t\n0\n" CUBE "1\nD\n0 0 0\n", 0, "is not above 0"},
        {"t\n-1\n0 0 0\n0 0 0\n0 0 0\n1\nD\n0 0 0\n", 0, "is not above 0"},
        {"t\n1\n" CUBE "Si\nx\nD\n0 0 0\n", 0, ":7: 'x' is not a number of atoms"},
        {"t\n1\n" CUBE "2\nD\n0 0 0\n", 0, "in the positions"},
        {"t\n1\n" CUBE "1\nD\n0 0 y\n", 0, ":8: a position has three numbers"},
    };
    scratch_expect_damage(".vasp", damage, sizeof damage / sizeof damage[0]);
}

/* A run of one cell, then with a header before each frame. */
TEST(test_xdatcar)
{
    read_vasp("t\n1\n" CUBE "Si\n1\nDirect configuration=     1\n0 0 0\nDirect configuration=    11\n0.5 0 0\n", 0, 0,
              0, 0, 2.10f);
    cgt_trajectory_frame f = scratch_read(scratch_open_one);
    scratch_expect_sphere(&f, 0, 1, 0, 0, 2.10f);
    assert_int_equal(f.step, 11);
    scratch_expect_end(scratch_open_one);
    read_vasp("t\n1\n" CUBE "Si\n1\nDirect configuration= 1\n0.5 0 0\nt\n2\n" CUBE
              "Si\n1\nDirect configuration= 2\n0.5 0 0\n\n",
              0, 1, 0, 0, 2.10f);
    f = scratch_read(scratch_open_one);
    scratch_expect_sphere(&f, 0, 2, 0, 0, 2.10f);
    assert_true(f.step == 2 && f.box_edge[0][0] == 4.0);
    scratch_expect_end(scratch_open_one);
}

/* ---- LAMMPS data --------------------------------------------------------------------------------------------- */

TEST(test_data_with_labels)
{
    static const char text[] = "t\n\n2 atoms\n2 atom types\n0 10 xlo xhi\n\nAtom Type Labels\n\n1 ow\n2 hw\n\n"
                               "Masses\n\nhw 1.008\now 15.9994 # O\n\nPair Coeffs # lj/cut\n\now 0.1 3.1\nhw zero\n\n"
                               "Atoms # atomic\n\n1 hw 1 2 3\n2 ow 4 5 6\n\nVelocities\n\n1 0 0 1\n2 0 0 2\n";
    cgt_trajectory *t = scratch_open(scratch_text(".data", text), NULL);
    const cgt_trajectory_frame frame = scratch_read(t);
    scratch_expect_sphere(&frame, 0, 1, 2, 3, 1.10f);
    scratch_expect_sphere(&frame, 1, 4, 5, 6, 1.52f);
    assert_true(frame.type[0] == 2 && frame.type[1] == 1 && frame.velocity[5] == 2.0f);
    scratch_expect_end(t);
}

TEST(test_data)
{
    static const char *const names[] = {"q", "mol"};
    cgt_trajectory *t = scratch_open(
        scratch_text(".data",
                     "title\n\n3 atoms # so many\n2 bonds\n2 atom types\n-1 9 xlo xhi\n0 8 ylo yhi\n0 7 zlo zhi\n\n"
                     "Masses\n\n1 15.9994 # OW\n2 1.008\n\nPair Coeffs\n\n1 0.1 3\n\n"
                     "Atoms\n\n30 1 1 -0.8 1 2 3 0 0 0\n10 1 2 0.4 2 2 3 0 0 0 # H\n20 1 2 0.4 3 2 3 0 0 1\n\n"
                     "Bonds\n\n1 1 30 10\n2 1 20 30\n"),
        NULL);
    scratch_want(t, names, 2);
    const cgt_trajectory_frame frame = scratch_read(t);
    static const uint32_t bonds[4] = {0, 1, 0, 2};
    assert_int_equal(frame.bonds, 2);
    assert_memory_equal(frame.bond, bonds, sizeof bonds);
    assert_int_equal(frame.element[0], 8);
    scratch_expect_sphere(&frame, 0, 1, 2, 3, 1.52f);
    assert_true(cgt_trajectory_find_column(&frame, "q")->value[1] == 0.4f);
    assert_non_null(strstr(cgt_trajectory_take_warning(t), "does not tell the style of its atoms"));
    scratch_expect_end(t);
    scratch_expect_error(scratch_text(".data", "t\n\n1 atoms\n\nAtoms # full\n\n1 1 1 0.5 1 2 3\n\nBonds\n\n1 1 1 2\n"),
                         NULL, 0, "a bond to atom 2, which is not there");
    scratch_expect_error(scratch_text(".data", "t\n\n1 atoms\n\nAtoms # odd\n\n1 1 1\n"), NULL, 0,
                         "the style of the atoms is not known here");
    scratch_expect_error(scratch_text(".data", "t\n\n1 atoms\n"), NULL, 0, "the file ends before the section Atoms");
}

/* ---- .vtk ---------------------------------------------------------------------------------------------------- */

TEST(test_vtk)
{
    static const char text[] =
        "# vtk DataFile Version 3.0\ngrains\nASCII\nDATASET POLYDATA\nFIELD FieldData 1\n"
        "TIME 1 1 double\n2.5\nPOINTS 2 float\n0 0 0\n1 1.5 1\nVERTICES 1 3\n2 0 1\nPOINT_DATA 2\n"
        "SCALARS radius float 1\nLOOKUP_TABLE default\n0.5 0.25\nVECTORS v double\n1 2 3 4 5 6\n"
        "FIELD attributes 2\ntype 1 2 int\n1 2\nheat 1 2 double\n300 301.5\n";
    static const char *const names[] = {"heat", "vz"};
    cgt_trajectory *t = scratch_open(scratch_text(".vtk", text), NULL);
    scratch_want(t, names, 2);
    const cgt_trajectory_frame frame = scratch_read(t);
    scratch_expect_sphere(&frame, 1, 1, 1.5f, 1, 0.25f);
    assert_true(cgt_trajectory_find_column(&frame, "heat")->value[1] == 301.5f);
    assert_true(cgt_trajectory_find_column(&frame, "vz")->value[0] == 3.0f);
    assert_true(frame.type[1] == 2 && frame.velocity[3] == 4.0f && frame.time == 2.5);
    scratch_expect_end(t);
    scratch_expect_error(scratch_text(".vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n"),
                         NULL, 0, "neither POLYDATA nor UNSTRUCTURED_GRID");
    scratch_expect_error(scratch_text(".vtk", "solid\n"), NULL, 0, "not a legacy VTK file");
}

static void put(unsigned char *bytes, size_t *at, const char *text)
{
    while (*text)
        bytes[(*at)++] = (unsigned char)*text++;
}

static void put_big(unsigned char *bytes, size_t *at, uint64_t bits, int size)
{
    for (int i = 0; i < size; i++)
        bytes[(*at)++] = (unsigned char)(bits >> (8 * (size - 1 - i)));
}

TEST(test_vtk_binary)
{
    static const char head[] = "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n";
    static const char cells[] = "\nCELLS 3 2\nOFFSETS vtktypeint64\n", list[] = "\nCONNECTIVITY vtktypeint64\n";
    static const char arrays[] = "\nPOINT_DATA 2\nSCALARS id int\nLOOKUP_TABLE default\n";
    unsigned char bytes[1024];
    size_t at = 0;
    put(bytes, &at, head);
    for (int i = 0; i < 6; i++)
        put_big(bytes, &at, i == 4 ? 0x3fc00000 : 0, 4); /* 1.5 */
    put(bytes, &at, cells);
    for (int i = 0; i < 3; i++)
        put_big(bytes, &at, 0, 8);
    put(bytes, &at, list);
    for (int i = 0; i < 2; i++)
        put_big(bytes, &at, 0, 8);
    put(bytes, &at, arrays);
    put_big(bytes, &at, 70000, 4);
    put_big(bytes, &at, 9, 4);
    const cgt_trajectory_frame frame = scratch_read(scratch_open(scratch_bytes(".vtk", bytes, at), NULL));
    scratch_expect_sphere(&frame, 1, 0, 1.5f, 0, 0.5f);
    assert_int_equal(frame.id[0], 70000);
    scratch_expect_end(scratch_open_one);
}

/* As VTK writes them: METADATA after any array, arrays of strings and bits. */
TEST(test_vtk_metadata)
{
    static const char text[] =
        "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 1.5 1 \n"
        "METADATA\nINFORMATION 0\n\nPOINT_DATA 2\nFIELD FieldData 4\nvelocity 3 2 double\n1 2 3 4 5 6 \n"
        "METADATA\nCOMPONENT_NAMES\nx\ny\nz\nINFORMATION 0\n\nlabel 1 2 string\none word\n\nflag 1 2 bit\n0 1\n"
        "radius 1 2 double\n0.5 0.25 \nMETADATA\nINFORMATION 0\n\n";
    const cgt_trajectory_frame frame = scratch_read(scratch_open(scratch_text(".vtk", text), NULL));
    scratch_expect_sphere(&frame, 1, 1, 1.5f, 1, 0.25f);
    assert_true(frame.velocity[3] == 4.0f);
    scratch_expect_end(scratch_open_one);
    scratch_expect_error(
        scratch_text(".vtk", "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 string\na\nb\nc\n"),
        NULL, 0, "points have to be numbers");
}

/* The length of a string is before it, in one to eight bytes. */
TEST(test_vtk_binary_strings)
{
    static const char head[] = "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n";
    static const char arrays[] = "\nPOINT_DATA 1\nFIELD f 3\na 1 2 string\n", last[] = "\nid 1 1 int\n";
    unsigned char bytes[1024];
    size_t at = 0;
    put(bytes, &at, head);
    for (int i = 0; i < 3; i++)
        put_big(bytes, &at, 0x3fc00000, 4);
    put(bytes, &at, arrays);
    put_big(bytes, &at, 0xc3, 1);
    put(bytes, &at, "abc");
    put_big(bytes, &at, 0x8046, 2); /* 70 */
    for (int i = 0; i < 70; i++)
        put(bytes, &at, "x");
    put(bytes, &at, "\nb 9 1 bit\n");
    put_big(bytes, &at, 0x0a80, 2);
    put(bytes, &at, last);
    put_big(bytes, &at, 70000, 4);
    const cgt_trajectory_frame frame = scratch_read(scratch_open(scratch_bytes(".vtk", bytes, at), NULL));
    assert_int_equal(frame.id[0], 70000);
    scratch_expect_end(scratch_open_one);
}

SUITE(NULL, NULL)
