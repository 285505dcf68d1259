/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The crystal of a CIF: its cell, and its symmetry, which makes all atoms of the cell of those that are listed in
 * fractions of it. */
#ifndef CIF_CRYSTAL_H
#define CIF_CRYSTAL_H

#include "trajectory/trajectory_internal.h"

#define CRYSTAL_MOST_CENTRINGS 64   /* of a magnetic group in a supercell */
#define CRYSTAL_MOST_OPERATIONS 192 /* of any space group, with all faces of the cell centred */

typedef struct cif_operation {
    double turn[3][3], shift[3];
} cif_operation;

typedef struct cif_crystal {
    double length[3], angle[3];
    int has_cell;                         /* some of them are given */
    char group[64], hall[64], number[64]; /* the space group by names and number, "" where none is given */
    int is_magnetic;                      /* it is */
    char unread[64];                      /* a tag that tells of symmetry, and is not read; "": none */
    uint32_t operations, centrings;
    double centring[CRYSTAL_MOST_CENTRINGS][3];
    cif_operation operation[CRYSTAL_MOST_OPERATIONS];
    double (*place)[3]; /* of each listed atom, in fractions of the cell */
    size_t capacity;
} cif_crystal;

/* Forgets all but the memory. */
void cif_crystal_clear(cif_crystal *c);

/* Takes a tag, in small letters and with underscores for points, with its value. Others are no matter. */
void cif_crystal_take(cif_crystal *c, const char *tag, text_span value);

/* Reads an operation; a fourth part, +1 or -1, is what it does to magnetic moments. Returns NULL, or a sentence. */
const char *cif_crystal_read_operation(cif_operation *o, text_span text);

/* Adds an operation such as "-x+1/2, y-z, z". Returns NULL, or a sentence. */
const char *cif_crystal_add_operation(cif_crystal *c, text_span text);

/* The same for a centring of a magnetic group, and adds the operations with all centrings: NULL, or a sentence. */
const char *cif_crystal_add_centring(cif_crystal *c, text_span text);
const char *cif_crystal_center(cif_crystal *c);

/* Whether a tag names a group, in whatever notation: _symmetry_space_group_name_Hall, _space_group_name_H-M_ref,
 * _space_group_magn.name_BNS, _space_group.IT_number. */
int cif_crystal_names_group(const char *tag);

/* Notes a tag of a loop that is not read. */
void cif_crystal_note(cif_crystal *c, const char *tag);

/* Whether all symmetry that the file tells of is listed as operations; *what gets a group or a tag, where it is not:
 * x, y, z alone is none. */
int cif_crystal_is_listed(const cif_crystal *c, const char **what);

/* Takes the operations from the tables of space groups where the file lists none. Returns whether that is done. */
int cif_crystal_apply_group(cif_crystal *c, const double edge[3][3]);

/* Whether a listed atom is an image of another one of its element: then the file has them all. */
int cif_crystal_lists_images(const cgt_trajectory *t, const cif_crystal *c, const double edge[3][3], uint32_t count);

/* Makes room for the place of atom i. Returns 0, or -1: no memory. */
int cif_crystal_reserve(cif_crystal *c, size_t i);

/* A number, which may have its error behind it: 10.5(2). Returns 1, or 0. */
int cif_number(text_span text, double *value);

/* The edges of the cell: 1, or 0 where there is none. */
int cif_crystal_cell(const cif_crystal *c, double edge[3][3]);

/* Makes positions of the places of the first *count atoms in the store, and appends their images; all lie in the cell.
 * An image as near as 0.1 to the atom or another image is the same: the atom lies on an element of symmetry. slot:
 * `slots` columns whose values images share. Returns 1 or -1; *count gets the number of all. */
int cif_crystal_fill(cgt_trajectory *t, const cif_crystal *c, const int *slot, int slots, uint32_t *count);

#endif
