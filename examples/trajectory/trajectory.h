/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trajectories of spheres or of triangles, read one frame at a time from the files that simulators and modellers write:
 *   .lammpstrj  LAMMPS dump text: columns x y z, xu yu zu, xs ys zs or xsu ysu zsu; id, type, radius or diameter,
 *               vx vy vz where present; columns and count may differ from frame to frame
 *   .xyz        count, comment, then element or type and x y z on each line; or what the comment's Properties= says
 *               (extended: species, pos, radius, velo, id, type); radii by element where nothing else gives them
 *   .frames     the project's own binary, see below
 *   meshes      .obj, .ply, .gltf, .dae, .x, .ifc and whatever else assimp reads: all meshes of the file as one, moved
 *               by its nodes, bones and animation clips (only where the build has assimp)
 * and written as .frames: little-endian; magic "CGTFRAM1"; u32 kind (1 spheres, 2 triangles), u32 frames,
 * u32 triangles, u32 zero; for triangles u32 index[3 * triangles]; then per frame u32 count (spheres or vertices) and
 * float32 data (x y z r, or x y z). */
#ifndef TRAJECTORY_H
#define TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

typedef struct trajectory trajectory;

typedef enum trajectory_kind { TRAJECTORY_SPHERES = 1, TRAJECTORY_TRIANGLES = 2 } trajectory_kind; /* as in .frames */

typedef struct trajectory_options {
    float radius;       /* world units, for files and frames without a radius; 0: 0.5, or by element in .xyz */
    int wrapped;        /* 1: prefer x y z to xu yu zu where a file has both; default 0 */
    uint64_t max_count; /* spheres, vertices or triangles that a frame may hold; default (and 0) 2^31; more is an
                           error, so that a damaged count cannot ask for all the memory */
    double fps;         /* meshes with animation: frames per second of the clip; default (and 0) 30 */
    const char *clip;   /* meshes: name of the animation clip, or its number from 0; NULL (default): the first;
                           copied */
} trajectory_options;

/* One frame. The arrays belong to the trajectory and are valid until its next read, skip, rewind or
 * close. */
typedef struct trajectory_frame {
    uint64_t number;      /* from 0 */
    trajectory_kind kind; /* the same in all frames of a file */
    int64_t step;         /* the simulator's step; the frame's number where the file has none */
    uint32_t count;       /* spheres, or vertices; 0 is valid: simulations may start empty */
    const float *xyzr;    /* 4 floats each: centre and radius; values are as in the file: NaN stays NaN; a pointer
                              that is not NULL where count is 0, too; NULL in files of triangles */
    /* Files of triangles; NULL and 0 in those of spheres. index and triangles are the same in all frames of a file. */
    uint32_t triangles;
    const uint32_t *index;      /* 3 each, all below count */
    const float *position;      /* 3 floats a vertex */
    const float *vertex_normal; /* 3 floats a vertex, of any length, for shading; NULL where the file has none, and
                                   0, 0, 0 at a vertex that has none where others have */
    const uint32_t *id;         /* NULL where the file has none */
    const uint32_t *type;       /* NULL where the file has none; element names count from 1 in order of appearance */
    const float *velocity;      /* 3 floats each; NULL where the file has none */
    float box_min[3];           /* the simulation box; box_min[0] > box_max[0] where the file has none */
    float box_max[3];
} trajectory_frame;

void trajectory_options_init(trajectory_options *options);

/* Opens a file by its ending: .lammpstrj or .dump, .xyz or .extxyz, .frames, or that of a mesh. options: NULL for the
 * defaults. Returns NULL on an error; error gets a text with the path (and line) in it. */
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

/* What a mesh file holds, and what of it is not in the frames. */
typedef struct trajectory_mesh {
    uint32_t meshes;         /* of the file */
    uint32_t instances;      /* meshes with triangles, counted once per node that shows them */
    uint32_t bones;          /* that some vertex follows, counted once per mesh */
    uint32_t clips;          /* of animation */
    uint32_t unshown;        /* meshes that no node shows: left out */
    uint64_t points, lines;  /* left out: they have no area */
    uint64_t lost_triangles; /* left out: parts of polygons that cross themselves and cannot be cut into triangles */
    uint64_t degenerate;     /* triangles with two equal corners: kept, for the library skips and counts them */
    uint64_t unused;         /* vertices of the file that no triangle has: left out */
    uint32_t still_channels; /* of the clip, that move single vertices (morph targets): not played */
    uint32_t warnings;       /* of assimp while it read */
    char warning[256];       /* the first of them; "" for none */
} trajectory_mesh;

/* Returns what the file of a mesh holds, valid as long as t; NULL for other files. */
const trajectory_mesh *trajectory_get_mesh(const trajectory *t);

/* Gives it all back; NULL is ignored. */
void trajectory_close(trajectory *t);

/* Writing .frames. The number of frames is filled in by close; a file without a proper close has 0 frames there, and
 * the reader refuses it. add and close return 0, or -1 with a text; close gives the writer back in either case. Close
 * NULL is ignored. */
typedef struct frames_writer frames_writer;
frames_writer *frames_writer_open(const char *path, char *error, size_t error_size);
int frames_writer_add(frames_writer *w, const float *xyzr, uint32_t count, char *error, size_t error_size);

/* The same for triangles: index holds 3 * triangles numbers, copied; add_vertices takes 3 floats a vertex, and refuses
 * a frame with fewer vertices than the index needs. Each add refuses a file of the other kind. */
frames_writer *frames_writer_open_triangles(const char *path, const uint32_t *index, uint32_t triangles, char *error,
                                            size_t error_size);
int frames_writer_add_vertices(frames_writer *w, const float *xyz, uint32_t count, char *error, size_t error_size);
int frames_writer_close(frames_writer *w, char *error, size_t error_size);

#endif
