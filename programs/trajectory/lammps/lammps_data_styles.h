/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The styles of atoms in LAMMPS data files. */
#ifndef LAMMPS_DATA_STYLES_H
#define LAMMPS_DATA_STYLES_H

#include "trajectory/trajectory_internal.h"

/* A line up to its comment, without blanks at the ends. */
text_span lammps_without_comment(text_span line);

/* The columns of the atoms, apart by blanks: by the style behind the keyword ("Atoms # full") or, with a warning, by
 * the first row. NULL: neither is known. */
const char *lammps_data_columns(trajectory *t, text_span keyword, text_span first);

#endif
