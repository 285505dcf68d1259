/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trajectories of spheres or of triangles, read one frame at a time from the files that simulators and modellers write:
 * a library of its own, cgt-trajectory, which needs nothing of libcgt. In outline
 * (tests/repository/consumer/print_frames.c is a whole program):
 *
 *   cgt_trajectory_open("run.lammpstrj", NULL, &t);
 *   while ((result = cgt_trajectory_read(t, &frame)) == CGT_OK)
 *       draw(frame.xyzr, frame.count);             valid until the next read
 *   if (result != CGT_END)
 *       cgt_trajectory_get_error_message(t, text, sizeof text);
 *   cgt_trajectory_close(t);
 *
 * Formats of spheres, by the names that cgt_trajectory_options.format takes
 *   lammps         LAMMPS dump text: columns x y z, xu yu zu, xs ys zs or xsu ysu zsu; id, type, radius or diameter,
 *                  vx vy vz where present; columns and count may differ from frame to frame
 *   lammps-binary  LAMMPS dump binary: the same columns
 *   lammps-data    LAMMPS data: one frame; bonds; elements by their masses
 *   xyz            count, comment, then element or type and x y z on each line; or the columns given by Properties=
 *                  (extended: species, pos, radius, velo, id, type); radii by element unless given
 *   gro            GROMACS: elements by names, velocities where present
 *   xtc, trr       GROMACS: positions; velocities and forces of trr
 *   pdb            a frame for each model; elements; bonds of CONECT (all: all_bonds)
 *   mmcif          the same without bonds; small molecules and crystals with all atoms of the cell
 *   dcd            CHARMM, NAMD, X-PLOR: positions, in either byte order
 *   netcdf         Amber's netCDF (classic): positions, velocities, other arrays as columns
 *   gsd            HOOMD-blue: positions, types, diameters, velocities, bonds; other arrays as columns
 *   vasp           POSCAR, CONTCAR, XDATCAR: elements, cell, positions in fractions or lengths
 *   vtk            legacy VTK points: POLYDATA, UNSTRUCTURED_GRID; triangles where all cells are faces; one frame a
 *                  file
 *   psf, prmtop,   topologies alone: names, charges, masses, bonds; of .top also from the files that it includes,
 *   top            beside it, in GMXLIB and where GROMACS has its force fields
 *   frames         the project's own binary, below; triangles, too
 *
 * Meshes are .obj, .ply, .gltf, .dae, .x, .ifc and whatever else assimp reads: all meshes of the file as one, moved by
 * its nodes, bones and animation clips. They are a part of their own: the library is not linked to assimp, it loads it
 * with the first mesh. A build without this part, or a machine without assimp, refuses meshes with a sentence.
 *
 * .frames is little-endian: magic "CGTFRAM1"; u32 kind (1 spheres, 2 triangles), u32 frames, u32 triangles, u32
 * has_origin (0 or 1); with it float64 origin[3], to be added to all places; for triangles u32 index[3 * triangles];
 * then per frame u32 count (spheres or vertices) and float32 data (x y z r, or x y z).
 *
 * Conventions of every call
 *   Lengths   are those of the file; radii by element are in Angstrom, in nanometres for GROMACS.
 *   Errors    CGT_ERROR_FILE for all that is wrong with a file, its path or what is asked of it, OUT_OF_MEMORY. The
 *             message is an English sentence that begins with the path (and the line). What could not be opened is
 *             there, too: it has the message, which every call repeats, and is closed like any other. NULL is what
 *             there was no memory for; all calls take it.
 *   Memory    follows what was read, never what a file claims. What a call returns belongs to the trajectory.
 *   NULL      is allowed only where a text below says so; 0 is the right default of every field.
 *   Threads   One thread at a time uses a trajectory or a writer; any number of them may be in use at once. Meshes
 *             that assimp reads are opened one after the other.
 *   Processes Before a mesh is read, a child process (fork) tries to: assimp crashes on some files. */
#ifndef CGT_TRAJECTORY_H
#define CGT_TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/cgt.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An open file, or a series of files. */
typedef struct cgt_trajectory cgt_trajectory;

typedef enum cgt_trajectory_kind {
    CGT_TRAJECTORY_SPHERES = 1, /* as in .frames */
    CGT_TRAJECTORY_TRIANGLES
} cgt_trajectory_kind;

typedef struct cgt_trajectory_options {
    /* World units, for files and frames without a radius; 0: by element where there are some, else 1 Angstrom in
     * formats of molecular dynamics, else 0.5. */
    float radius;
    bool wrapped; /* prefer x y z to xu yu zu where a file has both */
    /* Limit of spheres, vertices or triangles in a frame; 0 (default): 2^31; more is an error, so that a damaged
     * count cannot exhaust memory. */
    uint64_t max_count;
    double fps; /* meshes with animation: frames per second of the clip; 0 (default): 30 */
    /* Meshes: name of the animation clip, or its number from 0; NULL (default): the first; copied. */
    const char *clip;
    /* Name of the format, whatever the file's name; NULL (default): by the ending, else by the first bytes; used
     * while opening. */
    const char *format;
    double follow;                  /* text: seconds to wait at the end for more, of a run that is being written */
    bool (*stop)(const void *user); /* asked while waiting: true ends it; NULL (default): none */
    const void *stop_user;          /* passed to stop */
    /* Path of a file whose first frame tells what the spheres are, for those that do not: elements, types, radii, ids,
     * bonds, and columns that hold at all times, such as charges, masses and names; used while opening; NULL (default):
     * none. */
    const char *topology;
    uint32_t threads; /* that read large frames of text; 0 (default): 1; the result is the same for any number */
    /* What a pipe or standard input delivers is kept in a temporary file, so that cgt_trajectory_rewind works. */
    bool keep;
    /* Frames have all bonds: those that a file does not list are guessed by covalent radii, where it has elements;
     * bond_source of the frame tells. false (default): those that are listed. */
    bool all_bonds;
    /* Frames have atoms alone: spheres that are none by their names, residues or masses (virtual sites, lone pairs,
     * dummies, ghosts) are left out, and a warning counts them. false (default): they are there, small, and have 1 in
     * the column site, which frames without them do not have. */
    bool leave_out_sites;
    bool no_limit; /* reads files that unpack or expand to more than 1 GiB and 500 times their size */
    /* `origin` is subtracted from all places and boxes, in double, before they are rounded to float; false (default):
     * that of a .frames file, else none. */
    bool has_origin;
    double origin[3]; /* finite */
} cgt_trajectory_options;

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Where the bonds of a frame come from. */
typedef enum cgt_trajectory_bond_source {
    CGT_TRAJECTORY_BONDS_UNKNOWN = 0, /* the file lists none, and none can be or were to be guessed */
    CGT_TRAJECTORY_BONDS_LISTED,      /* by the file, or its topology */
    CGT_TRAJECTORY_BONDS_GUESSED,     /* by covalent radii: the file lists none */
    CGT_TRAJECTORY_BONDS_BOTH         /* the file lists some, as .pdb does those of ligands; the others are guessed */
} cgt_trajectory_bond_source;

/* What the values of a column are. */
typedef enum cgt_trajectory_column_kind {
    CGT_TRAJECTORY_NUMBER = 1, /* numbers */
    CGT_TRAJECTORY_WHOLE,      /* whole numbers (true and false are 1 and 0), exact below 2^24 */
    CGT_TRAJECTORY_WORD        /* words: the values number up to 1024 of them from 1 in order of appearance; 0: none */
} cgt_trajectory_column_kind;

/* A column of a frame, under its name in the file. Where a file has vectors, each part is a column: velocities are vx,
 * vy, vz and forces fx, fy, fz in all formats, other vectors are name_x, name_y, name_z, longer lists name_1,
 * name_2... */
typedef struct cgt_trajectory_column {
    const char *name;
    cgt_trajectory_column_kind kind;
    const float *value;     /* one each sphere or vertex; NULL where cgt_trajectory_want_columns did not name it */
    uint32_t words;         /* of columns of words that were asked for: so many different ones up to this frame */
    const char (*word)[64]; /* value v means word[v - 1] */
} cgt_trajectory_column;

/* One frame. The arrays are valid until the next read, skip, rewind or close of the trajectory; values of columns also
 * end with cgt_trajectory_want_columns. cgt_spheres takes xyzr as it is: centers = cgt_floats(xyzr, 16), radii =
 * cgt_floats(xyzr + 3, 16). */
typedef struct cgt_trajectory_frame {
    uint64_t number;          /* from 0 */
    cgt_trajectory_kind kind; /* the same in all frames of a file */
    int64_t step;             /* the simulator's step; the frame's number where the file has none */
    uint32_t count;           /* spheres, or vertices; 0 is valid: simulations may start empty */
    /* 4 floats each: centre and radius; values as in the file, less the origin: NaN stays NaN; not NULL even where
     * count is 0; NULL in files of triangles. */
    const float *xyzr;
    /* Files of triangles; NULL and 0 in those of spheres. index and triangles are the same in all frames of a file. */
    uint32_t triangles;
    const uint32_t *index; /* 3 each, all below count */
    const float *position; /* 3 floats a vertex */
    /* 3 floats a vertex, of any length, for shading; NULL where the file has none, and 0, 0, 0 at a vertex without
     * one where others have one. */
    const float *vertex_normal;
    const uint32_t *id;    /* NULL where the file has none */
    const uint32_t *type;  /* NULL where the file has none; element names count from 1 in order of appearance */
    const float *velocity; /* 3 floats each; NULL where the file has none */
    double origin[3];      /* was subtracted: places and box of the file are those of the frame and this */
    float box_min[3];      /* the simulation box; box_min[0] > box_max[0] where the file has none */
    float box_max[3];
    /* The same box by a corner and its three edges a, b and c, which need not be along the axes; all 0 where the file
     * has none. */
    double box_origin[3];
    double box_edge[3][3];
    int8_t periodic[3];     /* along each edge: 1 periodic, 0 not, -1 unknown: files tell it, deny it or are silent */
    bool unwrapped[3];      /* along each edge: the file says that positions go on beyond the boundary */
    double time;            /* in the file's unit; NaN where it has none */
    bool has_radius;        /* the file has a radius of each sphere */
    float angstrom;         /* an Angstrom in the file's unit, where it has elements */
    const uint8_t *element; /* atomic numbers, 0 where the name is no element; NULL where the file has no elements */
    uint32_t bonds;         /* once each */
    const uint32_t *bond;   /* 2 spheres each, both below count; NULL where there are none */
    /* The same in all frames of a run; UNKNOWN may come later where frames have no elements. A frame whose bonds are
     * known may have none. */
    cgt_trajectory_bond_source bond_source;
    /* All columns that the file has for its spheres or vertices, those included that have fields above. */
    uint32_t columns;
    const cgt_trajectory_column *column;
} cgt_trajectory_frame;

/* ---- Reading ------------------------------------------------------------------------------------------------ */

/* Fills in the defaults. */
CGT_API void cgt_trajectory_options_init(cgt_trajectory_options *options);

/* Opens a file.
 *   path      its ending tells the format, or that it is a mesh; one more such as .gz or .zst is left out first.
 *             Compression (gzip, Zstandard, xz, bzip2, LZ4) is told by the first bytes, and read where the build has
 *             libarchive. "-": standard input
 *   options   NULL: the defaults; needed during the call only, but stop_user as long as the trajectory is open
 *   t         gets the trajectory; on an error, one that has the message */
CGT_API cgt_result cgt_trajectory_open(const char *path, const cgt_trajectory_options *options, cgt_trajectory **t);

/* The same for `count` files that follow each other in a run, in the order given; each may be compressed; not .frames.
 * The format is that of the first. Frames are counted through. */
CGT_API cgt_result cgt_trajectory_open_series(const char *const *paths, size_t count,
                                              const cgt_trajectory_options *options, cgt_trajectory **t);

/* Copies the message of the last call that failed on this trajectory, as cgt_context_get_error_message does. */
CGT_API size_t cgt_trajectory_get_error_message(const cgt_trajectory *t, char *text, size_t size);

/* Sorts paths as a run has them: numbers in them by their values, dump.9.gz before dump.10.gz. */
CGT_API void cgt_trajectory_sort_series(const char **paths, size_t count);

/* Changes options->follow of a file that was opened with it above 0, NaN and less than 0 to 0; call
 * cgt_trajectory_rewind before the next read. */
CGT_API void cgt_trajectory_set_follow(cgt_trajectory *t, double seconds);

/* Changes options->origin, or gets the one that counts; call cgt_trajectory_rewind before the next read, which refuses
 * one that is not finite. */
CGT_API void cgt_trajectory_set_origin(cgt_trajectory *t, const double origin[3]);
CGT_API void cgt_trajectory_get_origin(const cgt_trajectory *t, double origin[3]);

/* Whether cgt_trajectory_rewind can go back; it cannot in a pipe that is not kept. */
CGT_API bool cgt_trajectory_can_rewind(const cgt_trajectory *t);

/* Reads the next frame; CGT_END: there is none. After an error every call that has a result but rewind and close
 * repeats it, also those that count frames or ask for columns: a frame is whole, or it is an error. */
CGT_API cgt_result cgt_trajectory_read(cgt_trajectory *t, cgt_trajectory_frame *frame);

/* Says which columns the next frames are read with, by the names in cgt_trajectory_frame.column; others keep value NULL
 * and cost nothing. Replaces what was said before; names are copied; a name that no frame has is no error.
 * Errors: OUT_OF_MEMORY, FILE (more than CGT_TRAJECTORY_MOST_COLUMNS). */
#define CGT_TRAJECTORY_MOST_COLUMNS 256
CGT_API cgt_result cgt_trajectory_want_columns(cgt_trajectory *t, const char *const *names, size_t count);

/* Returns the frame's column of this name, or NULL. */
CGT_API const cgt_trajectory_column *cgt_trajectory_find_column(const cgt_trajectory_frame *frame, const char *name);

/* Returns the next thing that is doubtful about the frames read so far, each kind once for a file; NULL where there is
 * nothing new. The text names the path (and line) and is valid until t is closed. Programs tell it and go on: where two
 * readings of a file are possible, it says which was taken. A text whose last line has no line feed may be whole, since
 * editors and scripts write such files, or cut off inside its last number, which then reads as another one. */
CGT_API const char *cgt_trajectory_take_warning(cgt_trajectory *t);

/* Skips the next frame, with the same results. The frames after it are what they are where it is read, bit by bit:
 * words that it has keep their places in the order of appearance, and what later frames take from it (below) is read.
 * Cheap in .frames; in text the lines are counted. Numbers may stay unread, and so may their errors. */
CGT_API cgt_result cgt_trajectory_skip(cgt_trajectory *t);

/* Counts the frames of the file by skipping, and goes back to the first. */
CGT_API cgt_result cgt_trajectory_count_frames(cgt_trajectory *t, uint64_t *frames);

/* Returns the share of the file that has been read, 0 to 1; negative where it is unknown (a pipe). */
CGT_API double cgt_trajectory_progress(const cgt_trajectory *t);

/* Goes back to the first frame; a pipe cannot. From there on all is as after opening, with the
 * columns that are wanted now, wherever reading was and whether it had failed: the same frames, bit by bit. Only
 * warnings are not told again. A frame takes from those before it what the format says, and no more: the numbers of
 * names and words; the cell of CRYST1 of .pdb and of the header of XDATCAR up to the next one; fixed atoms of .dcd;
 * what a frame of .gsd lacks is that of its first. */
CGT_API cgt_result cgt_trajectory_rewind(cgt_trajectory *t);

/* Frees everything; NULL is ignored. */
CGT_API void cgt_trajectory_close(cgt_trajectory *t);

/* ---- Meshes ------------------------------------------------------------------------------------------------- */

/* What a mesh file holds, and what of it the frames lack. */
typedef struct cgt_trajectory_mesh {
    uint32_t meshes;         /* of the file */
    uint32_t instances;      /* meshes with triangles, counted once per node that refers to them */
    uint32_t bones;          /* that some vertex follows, once per mesh */
    uint32_t clips;          /* of animation */
    uint32_t unshown;        /* meshes that no node refers to: left out */
    uint64_t points, lines;  /* left out: they have no area */
    uint64_t lost_triangles; /* left out: self-intersecting polygons that cannot be cut into triangles */
    uint64_t degenerate;     /* triangles with two equal corners: kept; the library skips and counts them */
    uint64_t unused;         /* vertices that no triangle uses: left out */
    uint32_t still_channels; /* channels that move single vertices (morph targets): not played */
    uint32_t warnings;       /* from assimp */
    char warning[256];       /* the first of them; "" for none */
} cgt_trajectory_mesh;

/* Returns what the file of a mesh holds, valid until t is closed; NULL for other files. */
CGT_API const cgt_trajectory_mesh *cgt_trajectory_get_mesh(const cgt_trajectory *t);

/* ---- Writing ------------------------------------------------------------------------------------------------ */

/* Writes .frames. It ends with cgt_trajectory_writer_finish, which fills in the number of frames: a file without that
 * has 0 frames there, and the reader refuses it. After an error every call but close repeats it. */
typedef struct cgt_trajectory_writer cgt_trajectory_writer;

/* Opens a file of spheres.
 *   origin   was subtracted from all places; NULL: nothing
 *   writer   gets the writer; on an error, one that has the message */
CGT_API cgt_result cgt_trajectory_writer_open(const char *path, const double origin[3], cgt_trajectory_writer **writer);

/* The same for triangles.
 *   index   3 * triangles numbers of vertices, copied */
CGT_API cgt_result cgt_trajectory_writer_open_triangles(const char *path, const double origin[3], const uint32_t *index,
                                                        uint32_t triangles, cgt_trajectory_writer **writer);

/* Copies the message of the last call that failed on this writer, as cgt_context_get_error_message does. */
CGT_API size_t cgt_trajectory_writer_get_error_message(const cgt_trajectory_writer *writer, char *text, size_t size);

/* Add a frame: 4 floats a sphere, x y z r, or 3 a vertex. Each refuses a file of the other kind, and vertices that are
 * fewer than the index needs. */
CGT_API cgt_result cgt_trajectory_writer_add(cgt_trajectory_writer *writer, const float *xyzr, uint32_t count);
CGT_API cgt_result cgt_trajectory_writer_add_vertices(cgt_trajectory_writer *writer, const float *xyz, uint32_t count);

/* Completes the file; then the writer can only be closed. */
CGT_API cgt_result cgt_trajectory_writer_finish(cgt_trajectory_writer *writer);

/* Frees everything; NULL is ignored. */
CGT_API void cgt_trajectory_writer_close(cgt_trajectory_writer *writer);

#ifdef __cplusplus
}
#endif

#endif
