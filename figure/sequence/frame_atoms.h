/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What makes spheres atoms where the data do not tell: elements by type, their radii, and bonds by covalent radii. */
#ifndef FRAME_ATOMS_H
#define FRAME_ATOMS_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/trajectory.h>

enum { FRAME_ATOM_TYPES = 128 };

typedef struct atom_type {
    uint32_t type;
    uint8_t element; /* atomic number */
} atom_type;

/* All zero at first: frames stay as they are. */
typedef struct frame_atoms {
    atom_type type[FRAME_ATOM_TYPES]; /* that are elements; the last of several for a type counts */
    uint32_t types;
    int wants_bonds; /* those of frames with elements that have none are guessed */
    /* Of the frame that was completed last. */
    size_t room, bond_room;
    uint8_t *element;
    float *xyzr;
    uint32_t *bond;
    uint32_t bonds;
} frame_atoms;

/* Says what is asked for. */
void cgt_frame_atoms_set(frame_atoms *a, const atom_type *type, uint32_t types, int wants_bonds);

/* Completes a frame of spheres, which then has arrays of this. Returns 0, or -1 with a sentence: it has no types, or
 * there is no memory. */
int cgt_frame_atoms_complete(frame_atoms *a, cgt_trajectory_frame *frame, char *error, size_t error_size);

void cgt_frame_atoms_free(frame_atoms *a);

#endif
