/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the readers share.
 *   trajectory   an open file: its format, its lines, the arrays of the last frame
 *   format       a row of functions, one for each kind of file
 *   store        the arrays of a frame; they grow with the data that was read, never with what a file claims */
#ifndef TRAJECTORY_INTERNAL_H
#define TRAJECTORY_INTERNAL_H

#include <math.h>

#include <cgt/trajectory.h>
#include "trajectory/atoms/trajectory_bonds.h"
#include "trajectory/trajectory_columns.h"
#include "trajectory/trajectory_formats.h"
#include "trajectory/trajectory_input.h"
#include "trajectory/trajectory_store.h"
#include "trajectory/text/text_reader.h"

#define DEFAULT_RADIUS 0.5f

/* What may be doubtful about a file; each is told once, with the first line where it shows. */
typedef enum trajectory_doubt {
    DOUBT_OPEN_LINE,      /* the last line has no line feed */
    DOUBT_COUNT_WORDS,    /* .xyz: words after the count */
    DOUBT_TAIL,           /* .xyz: lines after the rows */
    DOUBT_LABEL,          /* a name that is no element's symbol is read as an atom's label */
    DOUBT_SYMBOL,         /* a name may be a symbol or a label */
    DOUBT_WIDE_IDS,       /* ids of more than 32 bits */
    DOUBT_FLAT,           /* no column z */
    DOUBT_MIXED_COLUMNS,  /* x, y and z come from different forms of positions */
    DOUBT_INTERPOLATION,  /* glTF: keys that are played as straight lines, or not at all */
    DOUBT_FRAMES,         /* the header says more frames than the file has */
    DOUBT_OLD_COLUMNS,    /* columns without names, known by their number */
    DOUBT_NO_PLACES,      /* .trr: frames without coordinates */
    DOUBT_NO_END,         /* .pdb: no END */
    DOUBT_MORPH,          /* glTF: weights of morph targets that are not zero */
    DOUBT_NAMES,          /* more names than types are numbered */
    DOUBT_LATE_BONDS,     /* .pdb: bonds after the models that have them, in a pipe */
    DOUBT_HEX,            /* .pdb: numbers of bonds that may be decimal or hexadecimal */
    DOUBT_CELL,           /* .dcd: a cell that may be a matrix or cosines */
    DOUBT_SYMMETRY,       /* .cif: a space group without its operations */
    DOUBT_DISORDER,       /* .cif: atoms that are there in part */
    DOUBT_SITES,          /* spheres that are no atoms are left out */
    DOUBT_SPECIES,        /* POSCAR, masses of .data: atoms without an element */
    DOUBT_POINTS,         /* spheres of radius 0 */
    DOUBT_SHAPES,         /* shapes that are drawn as others, or not at all */
    DOUBT_LOST,           /* .cif: atoms without coordinates */
    DOUBT_NO_IDS,         /* .cif: atoms without a number */
    DOUBT_INCLUDES,       /* .top: files that were not found */
    DOUBT_WORDS,          /* words that a column has no room for */
    DOUBT_TOPOLOGY_ORDER, /* ids that do not tell which atom of the topology a sphere is */
    DOUBT_ROWS,           /* .data: more rows of atoms than the header counts */
    DOUBT_LATTICE,        /* .xyz: a box that cannot be read */
    DOUBTS
} trajectory_doubt;

#define TRAJECTORY_WIDE_IDS "ids above 4294967295 are kept modulo 4294967296"

/* A reader: what differs from file to file. The readers of spheres are listed in trajectory_formats.h. A function
 * returns 1 done, 0 end of the file, -1 error through trajectory_fail; what is not set is as the comment says. */
typedef struct trajectory_format {
    int is_series;    /* several files may follow each other in a run */
    int lacks_places; /* it tells what atoms are, and is read as a topology alone */
    int lists_some;   /* bonds that it lists may be a part of all; else they are all, where there are any */
    int is_followed;  /* may be read while it is written */
    int is_binary;    /* it reads t->file, not lines alone */
    int gives_arrays; /* a frame's spheres are in the store alone, written anew for each: it may be given away */
    int keeps_state;  /* t->state stays when rewinding, and with it the triangles of all frames: begin sets the rest */
    float unit;       /* an Angstrom in the file's unit; 0: the same */
    /* Bytes of the format's own state, t->state: zero at first and after rewinding; it stays from file to file of a
     * series, and from frame to frame. A frame may take from it what the file says of all frames, and the numbers of
     * names, which must be the same whether the frames before it were read or skipped; nothing else. */
    size_t state_size;
    int (*begin)(cgt_trajectory *t); /* after opening a file and after rewinding: 1 or -1 */
    int (*read)(cgt_trajectory *t, cgt_trajectory_frame *frame);
    int (*skip)(cgt_trajectory *t); /* NULL: reads */
    void (*end)(cgt_trajectory *t); /* frees what state points to, also before rewinding; NULL: nothing to free */
    double (*progress)(const cgt_trajectory *t); /* NULL: by file position */
    /* Of meshes alone. */
    int (*knows)(const char *ending); /* whether it has this ending, ".obj" */
    const cgt_trajectory_mesh *(*mesh)(const cgt_trajectory *t);
} trajectory_format;

struct cgt_trajectory {
    const trajectory_format *format;
    int is_named;    /* the options name the format */
    int is_topology; /* of another file */
    int is_open;     /* else all calls repeat why it could not be opened */
    trajectory_input input;
    FILE *file;   /* the input's stream */
    char **paths; /* of the series, path_count of them */
    size_t path_count, path_at;
    const char *path; /* of the open file */
    cgt_trajectory_options options;
    uint64_t file_size; /* bytes; 0 where the file is not a regular one */
    int regular;        /* the file's size is known, and file can seek */
    text_reader text;
    trajectory_store store;
    trajectory_columns columns;           /* of the last frame */
    struct trajectory_topology *topology; /* NULL: none */
    uint32_t sites;                       /* of the frame: what is no atom */
    bond_list bonds;                      /* of the last frame, where some were guessed */
    uint64_t next;                        /* number of the next frame */
    int failed;                           /* every call repeats the error in message */
    cgt_result error;                     /* of the message */
    char message[1024];
    unsigned doubts; /* 1 << doubt of each that has come up */
    unsigned told;   /* of each that cgt_trajectory_take_warning has returned */
    char warning[DOUBTS][1024];
    void *state;                      /* state_size bytes, zero at first */
    double origin[3];                 /* that counts: of the options, or of a .frames file */
    int has_origin;                   /* it is not 0 */
    uint32_t guessed;                 /* atoms whose names may be an element's symbol or a label */
    char guess[TEXT_QUOTE_SIZE + 80]; /* the first of them */
};

#define TRAJECTORY_DECLARE(format, name, names, told, known) extern const trajectory_format trajectory_format_##format;
TRAJECTORY_READERS(TRAJECTORY_DECLARE, TRAJECTORY_DECLARE)
extern const trajectory_format trajectory_format_mesh; /* without assimp: refuses meshes */

/* Opens the topology of another file. */
cgt_result trajectory_open_topology(const char *path, const cgt_trajectory_options *options, cgt_trajectory **t);

/* Opens a file of the series in place of the one that is open. Returns 1 or -1. */
int trajectory_open_file(cgt_trajectory *t, size_t number);

/* Notes an error, "path:line: text" or "path: text" where line is 0. Returns -1. */
int trajectory_fail(cgt_trajectory *t, uint64_t line, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Notes a doubt, once for each kind; line: as above. */
void trajectory_warn(cgt_trajectory *t, trajectory_doubt doubt, uint64_t line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Notes an error of another path, or one after which reading can go on. Returns -1. */
int trajectory_refuse(cgt_trajectory *t, const char *path, cgt_result result, const char *reason);

/* The result of a call: status is 1, 0 at the end, or -1 with an error noted. */
static inline cgt_result trajectory_result(const cgt_trajectory *t, int status)
{
    return status > 0 ? CGT_OK : status == 0 ? CGT_END : t->error;
}

/* Notes that there are more names than types of spheres. */
void trajectory_warn_names(cgt_trajectory *t, uint64_t line);

/* Notes that the file ends without a line feed; line: as above. */
void trajectory_warn_open(cgt_trajectory *t, uint64_t line);

/* The next line: 1, 0 at the end, -1 error noted. */
int trajectory_line(cgt_trajectory *t, text_span *line);

/* The next line of a frame that has begun: 1, or -1 where the file ends. section: "in the box bounds". */
int trajectory_line_inside(cgt_trajectory *t, text_span *line, const char *section);

/* A frame's count, checked against the options. Returns 1 or -1. */
int trajectory_parse_count(cgt_trajectory *t, text_span word, uint32_t *count);

/* Grows *array, a pointer to an array, to `capacity` elements of `bytes` bytes each. Returns 0, or -1: no memory, the
 * array is unchanged. */
int trajectory_grow(void *array, size_t capacity, size_t bytes);

/* Makes room for `count` spheres, and for more to save growing again, but not beyond `expected`. All arrays exist
 * afterwards, those of wanted columns too, even for 0. Returns 1 or -1. */
int trajectory_reserve(cgt_trajectory *t, size_t count, size_t expected);

/* Every place of a frame is made of a double by this, or moved by trajectory_move where the file has floats, so that
 * the origin is subtracted before rounding. */
static inline float trajectory_place(const cgt_trajectory *t, size_t axis, double value)
{
    return (float)(value - t->origin[axis]);
}

static inline int trajectory_is_finite(const double origin[3])
{
    return isfinite(origin[0]) && isfinite(origin[1]) && isfinite(origin[2]);
}

/* Makes this origin the one that counts. */
void trajectory_take_origin(cgt_trajectory *t, const double origin[3]);

/* Makes a place of a word: 1, or 0 where it is no number. Without an origin a word is rounded once. */
int trajectory_text_place(const cgt_trajectory *t, size_t axis, text_span word, float *place);

/* Moves numbers along one axis that are as the file has them; stride: floats from one to the next. */
void trajectory_move(const cgt_trajectory *t, size_t axis, float *value, size_t stride, size_t count);

/* The radius of spheres that have none: as the options say, or 0.5. */
float trajectory_default_radius(const cgt_trajectory *t);

/* Sets all fields for a frame of `count` spheres in the store with nothing optional in it. */
void trajectory_frame_fill(cgt_trajectory *t, cgt_trajectory_frame *frame, uint32_t count);

/* The same for triangles: no spheres; the caller sets index, position and the like. */
void trajectory_frame_fill_triangles(cgt_trajectory *t, cgt_trajectory_frame *frame, uint32_t count,
                                     uint32_t triangles);

/* Sets the box by its corner and edges, with the bounds around it. Numbers that are not finite: no box. */
void trajectory_frame_set_box(cgt_trajectory_frame *frame, const double origin[3], const double edge[3][3]);

#endif
