/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * CIF: mmCIF of macromolecules, and small molecules and crystals with their symmetry. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

static const char *word_of(const cgt_trajectory_frame *frame, const char *column, uint32_t i)
{
    const cgt_trajectory_column *const c = cgt_trajectory_find_column(frame, column);
    assert_true(c != NULL && c->value != NULL && c->kind == CGT_TRAJECTORY_WORD && c->value[i] >= 1.0f);
    return c->word[(uint32_t)c->value[i] - 1];
}

/* ---- mmCIF --------------------------------------------------------------------------------------------------- */

TEST(test_mmcif)
{
    static const char *const names[] = {"name", "chain"};
    cgt_trajectory *t = scratch_open(
        scratch_text(".cif", "data_1ABC\n# a comment\n_cell.length_a 10.0(1)\n_cell.length_b 20\n_cell.length_c 30\n"
                             "_cell.angle_alpha 90\n_cell.angle_beta 90\n_cell.angle_gamma 90\n"
                             "_struct.title\n;several\nlines\n;\n"
                             "loop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
                             "_atom_site.label_asym_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
                             "_atom_site.auth_asym_id\n_atom_site.pdbx_PDB_model_num\n"
                             "1 C CA A 1.0 2.0 3.0(2) X 1\n2 O \"O5'\" A 1.5 2.5\n3.5 X 1\n"
                             "1 C CA A 1.25 2.0 3.0 X 2\n"
                             "#\nloop_\n_other.a\n_other.b\n1 'two words' 3 4\n"),
        NULL);
    scratch_want(t, names, 2);
    cgt_trajectory_frame frame = scratch_read(t);
    assert_int_equal(frame.count, 2);
    scratch_expect_sphere(&frame, 0, 1, 2, 3, 1.70f);
    scratch_expect_sphere(&frame, 1, 1.5f, 2.5f, 3.5f, 1.52f);
    assert_string_equal(word_of(&frame, "name", 1), "O5'");
    assert_string_equal(word_of(&frame, "chain", 1), "X");
    assert_true(frame.box_edge[0][0] == 10.0 && frame.box_edge[1][0] == 0.0);
    frame = scratch_read(t);
    assert_int_equal(frame.count, 1);
    scratch_expect_sphere(&frame, 0, 1.25f, 2, 3, 1.70f);
    scratch_expect_end(t);
    scratch_expect_error(scratch_text(".cif", "data_x\nloop_\n_atom_site.id\n_atom_site.Cartn_x\n1 2\n"), NULL, 0,
                         ":5: _atom_site has not all of Cartn_x, Cartn_y, Cartn_z");
    scratch_expect_error(scratch_text(".cif", "data_x\n_cell.length_a 10\n"), NULL, 0,
                         "no _atom_site with the coordinates of atoms");
}

/* ---- mmCIF without loop -------------------------------------------------------------------------------------- */

TEST(test_mmcif_of_one_atom)
{
    static const char text[] = "data_x\n_cell.length_a 10\n_atom_site.id 7\n_atom_site.type_symbol ZN\n"
                               "_atom_site.auth_seq_id 5\n_atom_site.label_seq_id 6\n"
                               "_atom_site.label_atom_id ZN\n_atom_site.Cartn_x 1.5\n_atom_site.Cartn_y 2.5(1)\n"
                               "_atom_site.Cartn_z\n3.5\n_other.a b\n";
    static const char *const names[] = {"resid"};
    cgt_trajectory *t = scratch_open(scratch_text(".cif", text), NULL);
    scratch_want(t, names, 1);
    const cgt_trajectory_frame frame = scratch_read(t);
    scratch_expect_sphere(&frame, 0, 1.5f, 2.5f, 3.5f, 2.0f);
    assert_true(cgt_trajectory_find_column(&frame, "resid")->value[0] == 5.0f);
    assert_true(frame.count == 1 && frame.element[0] == 30 && frame.id[0] == 7);
    scratch_expect_end(t);
    scratch_expect_error(scratch_text(".cif", "data_x\n_atom_site.id 7\n_atom_site.Cartn_x 1\n"), NULL, 0,
                         "_atom_site has not all of Cartn_x, Cartn_y, Cartn_z");
    scratch_expect_error(scratch_text(".cif", "data_x\n_atom_site.id\nloop_\n"), NULL, 0,
                         "the tag _atom_site.id has no value");
}

/* ---- Crystals ------------------------------------------------------------------------------------------------ */

#define CELL                                                                                                           \
    "_cell_length_a 4.5937(1)\n_cell_length_b 4.5937\n_cell_length_c 2.9587(2)\n"                                      \
    "_cell_angle_alpha 90\n_cell_angle_beta 90.0\n_cell_angle_gamma 90.00(0)\n"
#define CUBE                                                                                                           \
    "_cell_length_a 10\n_cell_length_b 10\n_cell_length_c 10\n"                                                        \
    "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n"
#define OPERATIONS "loop_\n_space_group_symop_operation_xyz\n"
#define ATOMS                                                                                                          \
    "loop_\n_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n_atom_site_fract_y\n"                        \
    "_atom_site_fract_z\n_atom_site_occupancy\n"

/* Rutile, P 42/m n m: both atoms lie on elements of symmetry. The atoms come before symmetry and cell, other loops of
 * _atom_site after them. */
TEST(test_rutile)
{
    static const char text[] =
        "#\\#CIF_1.1\ndata_global\n_audit_creation_method 'by hand'\ndata_rutile\n" ATOMS
        "Ti1 Ti4+ 0 0.0 0 1\nO1 O2- 0.3053(2) 0.3053(2) .0 1.0(1)\n"
        "loop_\n_atom_site_aniso_label\n_atom_site_aniso_U_11\nTi1 0.1\nO1 0.2\n"
        "loop_\n_symmetry_equiv_pos_site_id\n_symmetry_equiv_pos_as_xyz\n"
        "1 'x, y, z'\n2 -X,-Y,Z\n3 '1/2-y, x+1/2, z+0.5'\n4 y+1/2,1/2-x,1/2+z\n5 1/2-x,1/2+y,.5-z\n6 "
        "1/2+x,1/2-y,1/2-z\n"
        "7 y,x,-z\n8 -y,-x,-z\n9 -x,-y,-z\n10 x,y,-z\n11 1/2+y,1/2-x,1/2-z\n12 1/2-y,1/2+x,1/2-z\n"
        "13 1/2+x,1/2-y,1/2+z\n14 1/2-x,1/2+y,1/2+z\n15 -y,-x,z\n16 +y,+x,z\n" CELL;
    static const double titanium[2][3] = {{0, 0, 0}, {0.5, 0.5, 0.5}};
    static const double oxygen[4][3] = {
        {0.3053, 0.3053, 0}, {0.6947, 0.6947, 0}, {0.1947, 0.8053, 0.5}, {0.8053, 0.1947, 0.5}};
    static const char *const names[] = {"name"};
    cgt_trajectory *t = scratch_open(scratch_text(".cif", text), NULL);
    scratch_want(t, names, 1);
    const cgt_trajectory_frame frame = scratch_read(t);
    assert_int_equal(frame.count, 6);
    assert_true(frame.id == NULL && frame.periodic[0] == 1 && frame.box_edge[2][2] == 2.9587);
    unsigned found = 0;
    for (uint32_t i = 0; i < 6; i++) {
        const int is_oxygen = frame.element[i] == 8;
        assert_string_equal(word_of(&frame, "name", i), is_oxygen ? "O1" : "Ti1");
        assert_true(frame.xyzr[4 * i + 3] == (is_oxygen ? 1.52f : 2.0f));
        for (unsigned k = 0; k < (is_oxygen ? 4u : 2u); k++) {
            const double *const place = is_oxygen ? oxygen[k] : titanium[k];
            if (fabs((double)frame.xyzr[4 * i] - 4.5937 * place[0]) < 1e-6 &&
                fabs((double)frame.xyzr[4 * i + 1] - 4.5937 * place[1]) < 1e-6 &&
                fabs((double)frame.xyzr[4 * i + 2] - 2.9587 * place[2]) < 1e-6)
                found |= 1u << (is_oxygen ? 2 + k : k);
        }
    }
    assert_int_equal(found, 63);
    assert_null(cgt_trajectory_take_warning(t));
    scratch_expect_end(t);
}

/* Operations and places, and how many atoms there are. */
TEST(test_special_positions)
{
    static const struct {
        const char *operations, *place;
        uint32_t count;
    } cases[] = {
        {"x,y,z -y,x-y,z -x+y,-x,z", "0.333 0.667 0.25", 1}, /* as files round thirds */
        {"x,y,z -y,x-y,z -x+y,-x,z", "0.300 0.667 0.25", 3},
        {"x,y,z -x,-y,-z", "0.5 1.0 -1e-17", 1},
        {"x,y,z -x,-y,-z", "0.504 0 0", 1}, /* 0.08 from its image */
        {"x,y,z -x,-y,-z", "0.506 0 0", 2}, /* 0.12 */
        {"x,y,z 2*x-x,y,z+1/3", "0 0 0", 2},
        {"-x,-y,-z", "0.1 0.2 0.3", 2}, /* the atom itself is there in any case */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1024];
        snprintf(text, sizeof text, "data_x\n" CUBE OPERATIONS "%s\n" ATOMS "C1 C %s 1\n", cases[i].operations,
                 cases[i].place);
        cgt_trajectory *t = scratch_open(scratch_text(".cif", text), NULL);
        const cgt_trajectory_frame frame = scratch_read(t);
        if (frame.count != cases[i].count)
            fail_msg("row %zu: %u atoms", i, frame.count);
        for (uint32_t k = 0; k < 3 * frame.count; k++)
            assert_true(frame.xyzr[4 * (k / 3) + k % 3] >= 0.0f && frame.xyzr[4 * (k / 3) + k % 3] < 10.0f);
    }
}

/* Each block is a frame with a cell and a symmetry of its own; blocks without atoms are none. */
TEST(test_blocks)
{
    static const char text[] = "data_a\n" CUBE "_space_group_symop_operation_xyz x,y,z\n" ATOMS "C1 C 0.1 0.2 0.3 1\n"
                               "data_b\n_cell_length_a 5\ndata_c\n" CELL OPERATIONS "x,y,z\n-x,-y,z\n" ATOMS
                               "C1 C 0.5 0.25 0.5 1\ndata_d\n" CUBE ATOMS "C1 C 0.5 0.25 0.5 1\n";
    cgt_trajectory *t = scratch_open(scratch_text(".cif", text), NULL);
    cgt_trajectory_frame frame = scratch_read(t);
    scratch_expect_sphere(&frame, 0, 1, 2, 3, 1.70f);
    assert_true(frame.count == 1 && frame.box_edge[0][0] == 10.0);
    frame = scratch_read(t);
    assert_true(frame.count == 2 && frame.box_edge[0][0] == 4.5937);
    frame = scratch_read(t);
    assert_true(frame.count == 1 && frame.box_edge[0][0] == 10.0);
    scratch_expect_end(t);
}

/* What is told of a crystal. */
TEST(test_crystal_warnings)
{
    static const struct {
        const char *text, *warning;
    } cases[] = {
        {"_symmetry_space_group_name_H-M 'F m -3 m'\n" ATOMS "C C 0 0 0 1\n",
         "the space group is 'F m -3 m', but its operations are not listed: only the listed atoms"},
        {"_space_group_IT_number 225\n_symmetry_equiv_pos_as_xyz ?\n" ATOMS "C C 0 0 0 1\n", "group is '225'"},
        {"_symmetry_space_group_name_H-M 'P 1'\n" ATOMS "C C 0 0 0 1\n", NULL},
        {"_space_group_IT_number 2\n" OPERATIONS "x,y,z\n-x,-y,-z\n" ATOMS "C C 0 0 0 1\n", NULL},
        {ATOMS "C C 0 0 0 1\nC C .1 0 0 0.5(1)\n", "1 of 2 listed atoms are there in part"},
        {ATOMS "C C 0 0 0 1\nH H ? ? ? 1\n", "1 atoms without coordinates are left out"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1024];
        snprintf(text, sizeof text, "data_x\n" CUBE "%s", cases[i].text);
        cgt_trajectory *t = scratch_open(scratch_text(".cif", text), NULL);
        scratch_read(t);
        const char *const warning = cgt_trajectory_take_warning(t);
        if (cases[i].warning == NULL ? warning != NULL : warning == NULL || strstr(warning, cases[i].warning) == NULL)
            fail_msg("row %zu: %s", i, warning != NULL ? warning : "no warning");
    }
}

TEST(test_crystal_errors)
{
    static const scratch_damage cases[] = {
        {"data_x\n" ATOMS "C C 0 0 0 1\n", 0, "fractions of the cell, but the file has no cell"},
        {"data_x\n" CUBE "loop_\n_atom_site_label\n_atom_site_fract_x\nC 0\n", 0, "nor of fract_x, fract_y, fract_z"},
        {"data_x\n" CUBE ATOMS "C C 0 0 x 1\n", 0, ":15: 'x' is not a coordinate"},
        {"data_x\n" CUBE ATOMS "C C 0 0\n", 0, ":15: 4 of 6 values of a row: the file is cut off"},
        {"data_x\n" CUBE OPERATIONS "x,y,z,\n", 0, ":10: 'x,y,z,': not an operation of symmetry"},
        {"data_x\n" CUBE OPERATIONS "x,y\n", 0, "'x,y': not an operation"},
        {"data_x\n" CUBE OPERATIONS "x,y,1/2\n", 0, "'x,y,1/2': not an operation"},
        {"data_x\n" CUBE OPERATIONS "x,y,1/0+z\n", 0, "'x,y,1/0+z': not an operation"},
        {"data_x\n" CUBE OPERATIONS "x,y,2*+z\n", 0, "'x,y,2*+z': not an operation"},
        {"data_x\n" CUBE OPERATIONS "x,y,z+w\n", 0, "'x,y,z+w': not an operation"},
        {"data_x\n" CUBE OPERATIONS "x,y,2z\n", 0, "'x,y,2z': not an operation"}, /* no cell goes into itself so */
    };
    scratch_expect_damage(".cif", cases, sizeof cases / sizeof cases[0]);
    static char text[4096] = "data_x\n" CUBE OPERATIONS;
    for (int i = 0; i < 193; i++)
        strcat(text, "x,y,z\n");
    scratch_expect_error(scratch_text(".cif", text), NULL, 0,
                         ":202: 'x,y,z': more operations of symmetry than the 192");
    static const cgt_trajectory_options few = {.max_count = 1};
    scratch_expect_error(scratch_text(".cif", "data_x\n" CUBE OPERATIONS "x,y,z\n-x,y,z\n" ATOMS "C C 0.1 0 0 1\n"),
                         &few, 0, "with their images more spheres than the limit of 1");
}

SUITE(NULL, NULL)
