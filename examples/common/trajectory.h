/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trajectories of spheres, read one frame at a time from the files that simulators write:
 *   .lammpstrj  LAMMPS dump text: columns x y z, xu yu zu, xs ys zs or xsu ysu zsu; id, type, radius or diameter,
 *               vx vy vz where present; columns and count may differ from frame to frame
 *   .xyz        count, comment, then element or type and x y z on each line; or what the comment's Properties= says
 *               (extended: species, pos, radius, velo, id, type); radii by element where nothing else gives them
 *   .frames     the project's own binary, see below
 * and written as .frames: little-endian; magic "CGTFRAM1"; u32 kind (1 spheres, 2 triangles), u32 frames,
 * u32 triangles, u32 zero; for triangles u32 index[3 * triangles]; then per frame u32 count (spheres or vertices) and
 * float32 data (x y z r, or x y z). */
#ifndef TRAJECTORY_H
#define TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

typedef struct trajectory trajectory;

typedef struct trajectory_options {
    float radius;       /* world units, for files and frames without a radius; 0: 0.5, or by element in .xyz */
    int wrapped;        /* 1: prefer x y z to xu yu zu where a file has both; default 0 */
    uint64_t max_count; /* spheres that a frame may hold; default (and 0) 2^31; more is an error, so that a damaged
                           count cannot ask for all the memory */
} trajectory_options;

/* One frame. The arrays belong to the trajectory and are valid until its next read, skip, rewind or
 * close. */
typedef struct trajectory_frame {
    uint64_t number;       /* from 0 */
    int64_t step;          /* the simulator's step; the frame's number where the file has none */
    uint32_t count;        /* 0 is valid: simulations may start empty */
    const float *xyzr;     /* 4 floats each: centre and radius; values are as in the file: NaN stays NaN; a pointer
                              that is not NULL where count is 0, too */
    const uint32_t *id;    /* NULL where the file has none */
    const uint32_t *type;  /* NULL where the file has none; element names count from 1 in order of appearance */
    const float *velocity; /* 3 floats each; NULL where the file has none */
    float box_min[3];      /* the simulation box; box_min[0] > box_max[0] where the file has none */
    float box_max[3];
} trajectory_frame;

void trajectory_options_init(trajectory_options *options);

/* Opens a file by its ending: .lammpstrj or .dump, .xyz or .extxyz, .frames. options: NULL for the defaults. Returns
 * NULL on an error; error gets a text with the path (and line) in it. */
trajectory *trajectory_open(const char *path, const trajectory_options *options, char *error, size_t error_size);

/* Reads the next frame: 1 frame read, 0 end of the file, -1 error (text in error: path, line number, what). After an
 * error every call but rewind and close repeats it: a frame is whole, or it is an error. */
int trajectory_read(trajectory *t, trajectory_frame *frame, char *error, size_t error_size);

/* Goes past the next frame, with the same results. Cheap in .frames; in text the lines are counted, but the numbers of
 * the spheres may stay unread, and so may their errors. */
int trajectory_skip(trajectory *t, char *error, size_t error_size);

/* Counts the frames of the whole file, by skipping, and goes back to the first: 0, or -1 with a text. */
int trajectory_count_frames(trajectory *t, uint64_t *frames, char *error, size_t error_size);

/* Returns how much of the file has been read, 0 to 1; negative where that cannot be known (a pipe). */
double trajectory_progress(const trajectory *t);

/* Back to the first frame: 0, or -1 with a text (a pipe cannot). */
int trajectory_rewind(trajectory *t, char *error, size_t error_size);

/* Gives it all back; NULL is ignored. */
void trajectory_close(trajectory *t);

/* Writing .frames. The number of frames is filled in by close; a file without a proper close has 0 frames there, and
 * the reader refuses it. add and close return 0, or -1 with a text; close gives the writer back in either case. Close
 * NULL is ignored. */
typedef struct frames_writer frames_writer;
frames_writer *frames_writer_open(const char *path, char *error, size_t error_size);
int frames_writer_add(frames_writer *w, const float *xyzr, uint32_t count, char *error, size_t error_size);
int frames_writer_close(frames_writer *w, char *error, size_t error_size);

#endif
