/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What .xtc and .trr have in common: XDR, all numbers big-endian (manual of GROMACS, "File formats"). Lengths are
 * nanometres, times picoseconds. Neither tells what its atoms are. */
#ifndef GROMACS_FRAME_H
#define GROMACS_FRAME_H

#include "trajectory/binary/binary_reader.h"

typedef struct gromacs_state {
    binary_reader in;
    uint32_t count;
    int32_t step;
    double time;
    double edge[3][3];
    int has_velocity;
    unsigned char *packed;
    size_t packed_capacity;
} gromacs_state;

/* Names for messages. */
extern const char gromacs_head[];
extern const char gromacs_coordinates[];

int gromacs_begin(cgt_trajectory *t);
void gromacs_end(cgt_trajectory *t);

/* Reads the number that a frame begins with: 1, 0 at the end of the file, -1. */
int gromacs_read_magic(cgt_trajectory *t, uint32_t *magic);

/* Each reads its part and returns 1 or -1. bytes: of a number, 4 or 8. */
int gromacs_read_count(cgt_trajectory *t);
int gromacs_read_real(binary_reader *in, size_t bytes, double *value, const char *name);
int gromacs_read_box(cgt_trajectory *t, size_t bytes);

/* Reads `count` vectors to an array of the store: xyzr (stride 4) or velocity. */
int gromacs_read_vectors(cgt_trajectory *t, int is_velocity, size_t bytes);

void gromacs_fill_frame(cgt_trajectory *t, cgt_trajectory_frame *frame);

/* ---- The compressed coordinates of .xtc (xdr_coordinates.c) ---- */

/* What stands before the compressed bytes. */
typedef struct xdr_packed {
    float precision; /* coordinates are whole numbers divided by it */
    int32_t low[3], high[3];
    int32_t small; /* index of the first size of small differences */
} xdr_packed;

/* Decodes `count` coordinates to x, y and z of values, `stride` apart. Returns 0, or -1: the bytes are damaged. */
int xdr_decode(const xdr_packed *packed, const unsigned char *bytes, size_t size, float *values, size_t stride,
               uint32_t count);

#endif
