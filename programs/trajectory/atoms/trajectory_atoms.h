/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the atoms of a frame belong to, as far as files of molecules tell: residues and alternate places. It decides on
 * bonds that are guessed. */
#ifndef TRAJECTORY_ATOMS_H
#define TRAJECTORY_ATOMS_H

#include "trajectory/trajectory_internal.h"

/* The residues and places of atoms in the order of a file. */
typedef struct residue_run {
    char key[48];    /* of the last atom's residue: whatever differs between residues */
    uint32_t number; /* of residues so far */
    int is_standard; /* the last one */
    char name[8];    /* of the last atom */
} residue_run;

/* A residue that is an amino acid, a nucleotide or water, whose bonds no file needs to list: store.residue is twice
 * its number, and one more where it is such. */
#define RESIDUE_IS_STANDARD(residue) ((residue)&1u)
#define RESIDUE_NUMBER(residue) ((residue) >> 1)

/* Before a frame: nothing is known. */
void atoms_begin(cgt_trajectory *t);

/* Stores the residue of atom i. key: bytes that are other ones in the next residue; residue: its name. Returns the mark
 * of trajectory_sites.h for the atom's name, or 0. Atom 0 begins the run anew. */
uint32_t atoms_set_residue(cgt_trajectory *t, residue_run *run, size_t i, text_span key, text_span residue,
                           text_span name);

/* Stores the mark of the place of atom i, one of several that the atom may have; '\0': it has no other. */
void atoms_set_place(cgt_trajectory *t, size_t i, char mark);

#endif
