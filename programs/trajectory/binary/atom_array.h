/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays with values for each atom, for formats that have one array after the other: where the values go. */
#ifndef ATOM_ARRAY_H
#define ATOM_ARRAY_H

#include "trajectory/trajectory_internal.h"

typedef enum atom_use {
    ATOM_NONE = 0,
    ATOM_PLACE,
    ATOM_VELOCITY,
    ATOM_ID,
    ATOM_TYPE,
    ATOM_RADIUS,
    ATOM_DIAMETER
} atom_use;

#define ATOM_MOST_PARTS 9u /* columns of an array */

typedef struct atom_array {
    atom_use use;   /* of the frame's fields; ATOM_NONE: columns alone */
    uint32_t parts; /* values of an atom */
    int slot[ATOM_MOST_PARTS];
    int is_wanted; /* somebody needs the values */
} atom_array;

/* Plans an array of `parts` values an atom by its name: id, type, radius, velocities and the like go to the frame, and
 * all are columns. Places are known by their use, which is set before. Returns 1, or -1: no memory. */
int atom_array_plan(cgt_trajectory *t, atom_array *a, const char *name, uint32_t parts, int is_whole);

/* Stores a value; the store has room for the atom. */
void atom_array_store(cgt_trajectory *t, const atom_array *a, size_t atom, uint32_t part, double value);

#endif
