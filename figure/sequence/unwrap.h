/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Molecules that a periodic box has cut, put together again: spheres are moved by whole edges of the box. */
#ifndef UNWRAP_H
#define UNWRAP_H

#include <stddef.h>

#include <cgt/trajectory.h>

typedef enum unwrap_mode {
    UNWRAP_NOT = 0, /* places are those of the file */
    /* By image flags: the columns ix, iy, iz, or GSD's image. Without them spheres are followed from frame to frame,
     * from the file's first on, in which molecules are whole where their first spheres are. */
    UNWRAP_IMAGES,
    UNWRAP_WHOLE /* each molecule is whole, with the middle of its spheres in the box */
} unwrap_mode;

typedef struct unwrapping unwrapping;

/* Returns NULL where there is no memory. */
unwrapping *cgt_unwrap_create(unwrap_mode mode);
void cgt_unwrap_release(unwrapping *u); /* NULL is ignored */

/* The columns that frames must be read with, if the file has them. */
const char *const *cgt_unwrap_columns(size_t *count);

/* The next frame is the first of the run again. */
void cgt_unwrap_restart(unwrapping *u);

/* Whether spheres are followed from frame to frame: known once there was a frame; and whether no frame may be left
 * out. */
int cgt_unwrap_follows(const unwrapping *u);
int cgt_unwrap_needs_all(const unwrapping *u);

/* Moves the spheres of a frame: its xyzr becomes an array that is valid until the next call. Along edges that are not
 * periodic, or where the file's positions go on beyond the boundary, nothing moves. What image flags have moved is
 * unwrapped then. Molecules are what bonds connect; of two that are bonded, the nearest images belong together
 * (periodic_box.h). A molecule that is bonded to its own image has no end, and stays as the file has it: the first one
 * sets *endless. Places are rounded to float once more. Returns 0, or -1 with a sentence: a mesh, no box, flags that
 * end, UNWRAP_WHOLE without bonds, no memory. */
int cgt_unwrap_frame(unwrapping *u, cgt_trajectory_frame *frame, int *endless, char *error, size_t error_size);

#endif
