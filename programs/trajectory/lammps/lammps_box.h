/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The box of a LAMMPS dump. */
#ifndef LAMMPS_BOX_H
#define LAMMPS_BOX_H

#include "trajectory/trajectory_internal.h"

/* The box in LAMMPS' form: a corner and three edges. */
typedef struct lammps_box {
    double origin[3];
    double edge[3][3]; /* edge[i] is the box vector a, b or c */
    double low[3];     /* bounds of the parallelepiped */
    double high[3];
    int8_t periodic[3]; /* as in trajectory_frame */
} lammps_box;

/* Reads the three lines after "ITEM: BOX BOUNDS"; flags: what follows that, such as "pp pp ff" or "xy xz yz pp pp pp".
 * Returns 1 or -1. */
int lammps_read_box(trajectory *t, text_span flags, lammps_box *box);

/* Makes the box from the numbers of those lines: two bounds and a tilt each or, where it is general, a vector and a
 * coordinate of the corner. */
void lammps_make_box(lammps_box *box, int is_general, double lines[3][4]);

#endif
