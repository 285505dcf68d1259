/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the readers of LAMMPS share: boxes; columns of dumps, text and binary, what each name means and what a row is
 * made into; the styles of atoms in data files. */
#ifndef LAMMPS_PARTS_H
#define LAMMPS_PARTS_H

#include "trajectory/text/text_rows.h"

/* ---- lammps_box.c ---- */

/* The box in LAMMPS' form: a corner and three edges. */
typedef struct lammps_box {
    double origin[3];
    double edge[3][3];  /* edge[i] is the box vector a, b or c */
    int8_t periodic[3]; /* as in cgt_trajectory_frame */
} lammps_box;

/* Reads the three lines after "ITEM: BOX BOUNDS"; flags: what follows that, such as "pp pp ff" or "xy xz yz pp pp pp".
 * Returns 1 or -1. */
int lammps_read_box(cgt_trajectory *t, text_span flags, lammps_box *box);

/* Makes the box from the numbers of those lines: two bounds and a tilt each or, where it is general, a vector and a
 * coordinate of the corner. */
void lammps_make_box(lammps_box *box, int is_general, double lines[3][4]);

/* ---- lammps_columns.c ---- */

/* The first member of a format's state. */
typedef struct lammps_frame {
    row_plan plan;
    lammps_box box;
    int has_box;
    int is_binary;     /* names are stored as numbers of types */
    int flat;          /* the frame has no column z: z is 0 */
    bool unwrapped[3]; /* as in cgt_trajectory_frame */
    name_table elements;
    name_table labels; /* of types */
} lammps_frame;

/* Plans the columns with these names, apart by blanks. The box must be there where they are scaled. Returns 1 or -1. */
int lammps_plan_columns(cgt_trajectory *t, text_span columns);

/* Completes a row: a row_finish. */
int lammps_finish_row(cgt_trajectory *t, row *r);

/* Copies the box, where there is one. */
void lammps_set_box(const cgt_trajectory *t, cgt_trajectory_frame *frame);

/* ---- lammps_data_styles.c ---- */

/* A line up to its comment, without blanks at the ends. */
text_span lammps_without_comment(text_span line);

/* Whether a line is the keyword of a section, which blanks may stand before (TopoTools writes one). It begins with a
 * letter. So may rows, with the label of a type, but they have numbers, or stand right below a keyword: is_first. */
int lammps_is_keyword(text_span line, int is_first);

/* The columns of the atoms, apart by blanks: by the style behind the keyword ("Atoms # full") or, with a warning, by
 * the next rows, which also tell whether image flags follow. types: of atoms, by the header; 0: not told. Returns 1 or
 * -1. */
enum { LAMMPS_HEADING_SIZE = 256, LAMMPS_COLUMNS_SIZE = 256 };
int lammps_data_columns(cgt_trajectory *t, text_span keyword, uint64_t types, char columns[LAMMPS_COLUMNS_SIZE]);

#endif
