/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The columns of LAMMPS dumps, text and binary: what each name means, and what a row is made into. */
#ifndef LAMMPS_COLUMNS_H
#define LAMMPS_COLUMNS_H

#include "trajectory/lammps/lammps_box.h"
#include "trajectory/text/text_rows.h"

/* The first member of a format's state. */
typedef struct lammps_frame {
    row_plan plan;
    lammps_box box;
    int has_box;
    int is_binary;       /* names are stored as numbers of types */
    int flat;            /* the frame has no column z: z is 0 */
    name_table elements; /* kept when rewinding, as labels are, so that types stay the same */
    name_table labels;   /* of types */
} lammps_frame;

/* Plans the columns with these names, apart by blanks. The box must be there where they are scaled. Returns 1 or -1. */
int lammps_plan_columns(trajectory *t, text_span columns);

/* Completes a row: a row_finish. */
int lammps_finish_row(trajectory *t, row *r);

/* Copies the box, where there is one. */
void lammps_set_box(const trajectory *t, trajectory_frame *frame);

#endif
