/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What files of molecules share: fields of fixed columns, elements of atoms by their names in residues, boxes by
 * lengths and angles. */
#ifndef MOLECULE_ATOM_H
#define MOLECULE_ATOM_H

#include "trajectory/trajectory_internal.h"

/* The type of an atom without a name. */
static const char molecule_unnamed[] = "X";
#define MOLECULE_UNNAMED ((text_span){molecule_unnamed, &molecule_unnamed[1]})

/* The bytes [begin, begin + width) of a line, as far as it has them, without blanks at the ends. */
text_span field_at(text_span line, size_t begin, size_t width);

/* Numbers of a field, which another may touch: 1, or 0. */
int field_float(text_span field, float *value);
int field_double(text_span field, double *value);
int field_place(const cgt_trajectory *t, size_t axis, text_span field, float *place); /* as trajectory_text_place */

/* What the place of a name tells: in .pdb a symbol of two letters begins in column 13, one of one letter in 14. */
typedef enum name_place { NAME_ANYWHERE, NAME_OF_SYMBOL, NAME_OF_LABEL } name_place;

/* The atomic number of an atom by its name in a residue; 0: none. A residue of the same name is an ion, as are those
 * that force fields name; two letters are a symbol where the second is small, or the place says so, or where they are
 * no label that molecules have (FE, CL); else the first one counts, as in all amino acids, nucleotides and water.
 * Names that may be read in two ways are counted. */
uint32_t molecule_element(cgt_trajectory *t, text_span name, text_span residue, name_place place);

/* Tells how many names of the frames so far were guessed, once. */
void molecule_tell_guesses(cgt_trajectory *t);

/* Stores element, type (numbered by name) and radius of sphere i. unit: of the file's lengths in one Angstrom, 0.1
 * where it has nanometres. Returns 1 or -1. */
int molecule_store(cgt_trajectory *t, name_table *names, size_t i, text_span name, uint32_t element, float unit);

/* The edges of a box of lengths a, b, c and angles alpha, beta, gamma in degrees; a is along x, b in the plane of x and
 * y. Returns 1, or 0 where there is no such box. */
int molecule_cell(const double length[3], const double angle[3], double edge[3][3]);

#endif
