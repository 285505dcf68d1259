/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The arrays of a frame of spheres. They are the trajectory's until the next frame is read, or are given away to who
 * keeps the frame, who copies nothing then. */
#ifndef TRAJECTORY_STORE_H
#define TRAJECTORY_STORE_H

#include <cgt/trajectory.h>

typedef struct trajectory_store {
    size_t capacity; /* spheres */
    size_t given;    /* of the arrays that were given away last: what the next frame likely takes */
    float *xyzr;
    uint32_t *id;
    uint32_t *type;
    float *velocity;
    uint8_t *element;
    uint32_t *residue;            /* of atoms in residues; see trajectory_atoms.h */
    uint8_t *site;                /* 1 for what is no atom, where the frame has sites */
    char *place;                  /* of atoms at alternate places */
    int has_residues, has_places; /* of the frame */
} trajectory_store;

/* The bytes of xyzr, id, type, velocity and element of the frame that was read last, where they can be given away and
 * are worth it; else 0. */
size_t trajectory_can_give(const cgt_trajectory *t, const cgt_trajectory_frame *frame);

/* Gives them away: the frame's pointers stay as long as this store. */
void trajectory_give(cgt_trajectory *t, const cgt_trajectory_frame *frame, trajectory_store *to);

void trajectory_store_free(trajectory_store *s);

#endif
