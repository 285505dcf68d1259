/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * DCD, as CHARMM, NAMD and X-PLOR write it: records of Fortran, each between two markers that tell its length (4 bytes,
 * in files of some compilers 8), in either byte order. A header (counts, steps, flags), a title, the number of atoms,
 * the atoms that move where others are fixed; then for each frame the unit cell, where the header says so, and all x,
 * all y, all z. Fixed atoms are in the first frame alone. Lengths are Angstrom; times are told in picoseconds, where
 * the unit of the step is known. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/binary_reader.h"
#include "trajectory/molecule/molecule_atom.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BARE_RADIUS 1.0f /* Angstrom, where the options say nothing */
#define HEADER_BYTES 84u
#define PART 65536u     /* moving atoms that memory grows by, with the file */
#define BLOCK 2048u     /* numbers read at a time */
#define AKMA 0.04888821 /* picoseconds in CHARMM's unit of time */

/* The numbers of the header that matter, by their places. */
enum {
    AT_FRAMES = 0,
    AT_START = 1,
    AT_EVERY = 2,
    AT_FIXED = 8,
    AT_DELTA = 9,
    AT_CELL = 10,
    AT_FOURTH = 11,
    AT_VERSION = 19
};

static const char coordinates[] = "the coordinates of a frame";

typedef struct dcd_state {
    binary_reader in;
    uint64_t at;     /* frames of this file so far */
    unsigned marker; /* bytes of a record's marker */
    uint32_t atoms;
    uint32_t moving; /* atoms of a frame but the first */
    uint32_t *index; /* of those, from 0; NULL: all move */
    float *first;    /* the store's xyzr after the first frame, where not all atoms move */
    uint32_t frames; /* that the header says; 0: unknown */
    int32_t start, every;
    double delta; /* of a step, in picoseconds; 0: unknown */
    int has_cell, has_fourth, has_matrix;
    uint64_t made; /* bytes of all frames so far */
} dcd_state;

/* ---- Records ------------------------------------------------------------------------------------------------ */

static uint64_t marker_value(const dcd_state *s, const unsigned char *bytes)
{
    return s->marker == 8 ? binary_get_u64(bytes, s->in.is_big) : binary_get_u32(bytes, s->in.is_big);
}

/* Reads the marker before a record: 1, 0 where the file ends before it, -1. */
static int begin_record_or_end(dcd_state *s, uint64_t *size, const char *name)
{
    unsigned char bytes[8];
    const int status = binary_bytes_or_end(&s->in, bytes, s->marker, name);
    if (status > 0)
        *size = marker_value(s, bytes);
    return status;
}

/* Reads the marker before a record of a known size. */
static int begin_record(dcd_state *s, uint64_t expected, const char *name)
{
    cgt_trajectory *const t = s->in.t;
    unsigned char bytes[8];
    if (binary_bytes(&s->in, bytes, s->marker, name) < 0)
        return -1;
    const uint64_t size = marker_value(s, bytes);
    if (size != expected)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %s has %" PRIu64 " bytes where %" PRIu64 " are expected",
                               t->next, name, size, expected);
    return binary_expect(&s->in, expected + s->marker, name);
}

static int end_record(dcd_state *s, uint64_t size, const char *name)
{
    cgt_trajectory *const t = s->in.t;
    unsigned char bytes[8];
    if (binary_bytes(&s->in, bytes, s->marker, name) < 0)
        return -1;
    if (marker_value(s, bytes) != size)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the length after %s differs from that before it", t->next,
                               name);
    return 1;
}

/* ---- Header ------------------------------------------------------------------------------------------------- */

/* Byte order and markers follow from the first record, which has 84 bytes and begins with CORD. */
static int find_layout(cgt_trajectory *t)
{
    dcd_state *const s = t->state;
    unsigned char bytes[8];
    if (binary_bytes(&s->in, bytes, 4, "the header") < 0)
        return -1;
    const uint32_t little = binary_get_u32(bytes, 0), big = binary_get_u32(bytes, 1);
    if (little != HEADER_BYTES && big != HEADER_BYTES && little != 0)
        return trajectory_fail(t, 0, "not a DCD file: it does not begin with a record of 84 bytes");
    s->in.is_big = big == HEADER_BYTES;
    s->marker = 4;
    if (binary_bytes(&s->in, bytes + 4, 4, "the header") < 0)
        return -1;
    /* bytes 4 to 7 are CORD, or the other half of a marker of 8 bytes */
    const int is_long = binary_get_u64(bytes, 0) == HEADER_BYTES || binary_get_u64(bytes, 1) == HEADER_BYTES;
    if (is_long) {
        s->marker = 8;
        s->in.is_big = binary_get_u64(bytes, 1) == HEADER_BYTES;
        if (binary_bytes(&s->in, bytes + 4, 4, "the header") < 0)
            return -1;
    }
    if (memcmp(bytes + 4, "VELD", 4) == 0)
        return trajectory_fail(t, 0, "a DCD file of velocities has no positions");
    return memcmp(bytes + 4, "CORD", 4) == 0 ? 1 : trajectory_fail(t, 0, "not a DCD file: the header has no CORD");
}

static int32_t header_number(const dcd_state *s, const unsigned char *header, int place)
{
    const uint32_t bits = binary_get_u32(header + 4 * place, s->in.is_big);
    int32_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static int read_header(cgt_trajectory *t, int32_t *fixed)
{
    dcd_state *const s = t->state;
    unsigned char header[HEADER_BYTES - 4];
    if (find_layout(t) < 0 || binary_bytes(&s->in, header, sizeof header, "the header") < 0 ||
        end_record(s, HEADER_BYTES, "the header") < 0)
        return -1;
    const int32_t version = header_number(s, header, AT_VERSION);
    const int is_charmm = version != 0;
    const int32_t frames = header_number(s, header, AT_FRAMES);
    s->frames = frames > 0 ? (uint32_t)frames : 0;
    s->start = header_number(s, header, AT_START);
    s->every = header_number(s, header, AT_EVERY);
    *fixed = header_number(s, header, AT_FIXED);
    /* X-PLOR's step is a double in the place of CHARMM's step and flag */
    const double delta = is_charmm ? (double)binary_get_f32(header + 4 * AT_DELTA, s->in.is_big)
                                   : binary_get_f64(header + 4 * AT_DELTA, s->in.is_big);
    s->delta = isfinite(delta) ? AKMA * delta : 0.0;
    s->has_cell = is_charmm && header_number(s, header, AT_CELL) != 0;
    s->has_fourth = is_charmm && header_number(s, header, AT_FOURTH) == 1;
    s->has_matrix = version >= 22 && version != 24;
    return 1;
}

/* LAMMPS writes the length of its step in the units of its run, which no number tells. */
static int read_title(cgt_trajectory *t)
{
    static const char of_lammps[] = "Written by LAMMPS";
    dcd_state *const s = t->state;
    char begin[4 + sizeof of_lammps - 1] = ""; /* how many lines there are, and the first of them */
    uint64_t size;
    const int status = begin_record_or_end(s, &size, "the title");
    if (status <= 0)
        return status < 0 ? -1 : trajectory_fail(t, 0, "the file ends in the header: it is cut off");
    const size_t known = size < sizeof begin ? (size_t)size : sizeof begin;
    if (binary_bytes(&s->in, begin, known, "the title") < 0 || binary_skip(&s->in, size - known, "the title") < 0)
        return -1;
    if (memcmp(begin + 4, of_lammps, sizeof of_lammps - 1) == 0)
        s->delta = 0.0;
    return end_record(s, size, "the title");
}

/* Reads which atoms move. */
static int read_moving(cgt_trajectory *t)
{
    dcd_state *const s = t->state;
    static const char name[] = "the list of moving atoms";
    const uint64_t size = 4 * (uint64_t)s->moving;
    if (begin_record(s, size, name) < 0)
        return -1;
    if (s->moving == 0 && trajectory_grow(&s->index, 1, sizeof *s->index))
        return trajectory_fail(t, 0, "not enough memory");
    for (uint32_t i = 0; i < s->moving; i++) {
        uint32_t number;
        if (i % PART == 0 && trajectory_grow(&s->index, (size_t)i + PART, sizeof *s->index))
            return trajectory_fail(t, 0, "not enough memory for %" PRIu32 " moving atoms", s->moving);
        if (binary_u32(&s->in, &number, name) < 0)
            return -1;
        if (number == 0 || number > s->atoms)
            return trajectory_fail(t, 0, "moving atom %" PRIu32 " is not one of %" PRIu32, number, s->atoms);
        s->index[i] = number - 1;
    }
    return end_record(s, size, name);
}

static int dcd_begin(cgt_trajectory *t)
{
    dcd_state *const s = t->state;
    int32_t fixed = 0, atoms = 0;
    binary_begin(&s->in, t, 0);
    s->at = s->made = 0;
    free(s->index);
    s->index = NULL;
    if (read_header(t, &fixed) < 0 || read_title(t) < 0 || begin_record(s, 4, "the number of atoms") < 0 ||
        binary_i32(&s->in, &atoms, "the number of atoms") < 0 || end_record(s, 4, "the number of atoms") < 0)
        return -1;
    if (atoms < 0 || fixed < 0 || fixed > atoms)
        return trajectory_fail(t, 0, "%" PRId32 " atoms, %" PRId32 " of them fixed: the header is damaged", atoms,
                               fixed);
    s->atoms = (uint32_t)atoms;
    s->moving = (uint32_t)(atoms - fixed);
    if (binary_check_count(&s->in, s->atoms) < 0)
        return -1;
    return fixed > 0 ? read_moving(t) : 1;
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* The cell is A, gamma, B, beta, alpha, C: angles in degrees, or their cosines (NAMD). CHARMM from version 22 on writes
 * the lower triangle of a symmetric matrix in the same place, whose rows are the edges as the atoms lie in them. The
 * version tells, but 24 is what most other programs write: there, a matrix shows where its shears are no angles. */
static void set_cell(cgt_trajectory *t, cgt_trajectory_frame *frame, const double cell[6])
{
    static const double origin[3] = {0, 0, 0};
    const dcd_state *const s = t->state;
    const double length[3] = {cell[0], cell[2], cell[5]};
    double angle[3] = {cell[4], cell[3], cell[1]}, edge[3][3];
    const int are_small = fabs(angle[0]) <= 1.0 && fabs(angle[1]) <= 1.0 && fabs(angle[2]) <= 1.0;
    if (s->has_matrix && are_small && (angle[0] != 0.0 || angle[1] != 0.0 || angle[2] != 0.0))
        trajectory_warn(t, DOUBT_CELL, 0,
                        "frame %" PRIu64
                        ": the cell is read as CHARMM's matrix, nearly at right angles; its numbers may "
                        "be the cosines of another program that claims to be CHARMM",
                        t->next);
    for (int i = 0; i < 3 && are_small; i++)
        angle[i] = angle[i] == 0.0 ? 90.0 : acos(angle[i]) * 180.0 / 3.14159265358979323846;
    if (s->has_matrix || !molecule_cell(length, angle, edge)) {
        const double matrix[3][3] = {
            {cell[0], cell[1], cell[3]}, {cell[1], cell[2], cell[4]}, {cell[3], cell[4], cell[5]}};
        if (!(cell[0] > 0.0 && cell[2] > 0.0 && cell[5] > 0.0))
            return;
        memcpy(edge, matrix, sizeof edge);
    }
    trajectory_frame_set_box(frame, origin, (const double(*)[3])edge);
    memset(frame->periodic, frame->box_min[0] <= frame->box_max[0] ? 1 : -1, sizeof frame->periodic);
}

/* Reads all numbers of an axis, after the record's first marker. */
static int read_axis(cgt_trajectory *t, uint32_t count, const uint32_t *index, size_t axis)
{
    dcd_state *const s = t->state;
    double block[BLOCK];
    for (uint32_t done = 0; done < count;) {
        const uint32_t part = count - done < BLOCK ? count - done : BLOCK;
        if ((index == NULL && trajectory_reserve(t, (size_t)done + part, count) < 0) ||
            binary_reals(&s->in, block, part, 0, coordinates) < 0)
            return -1;
        for (size_t i = 0; i < part; i++) {
            const size_t atom = index != NULL ? index[done + i] : done + i;
            t->store.xyzr[4 * atom + axis] = trajectory_place(t, axis, block[i]);
        }
        done += part;
    }
    return end_record(s, 4 * (uint64_t)count, coordinates);
}

/* Reads the marker that a frame begins with: 1, 0 after the last frame, -1. */
static int begin_frame(cgt_trajectory *t, uint64_t expected)
{
    dcd_state *const s = t->state;
    uint64_t size;
    const int status = begin_record_or_end(s, &size, "a frame");
    if (status == 0 && t->next < s->frames && t->path_count == 1)
        trajectory_warn(t, DOUBT_FRAMES, 0, "the header says %" PRIu32 " frames, the file ends after %" PRIu64,
                        s->frames, t->next);
    if (status > 0 && size != expected)
        return trajectory_fail(
            t, 0, "frame %" PRIu64 ": the first record has %" PRIu64 " bytes where %" PRIu64 " are expected", t->next,
            size, expected);
    s->made += status > 0 ? 16 * (uint64_t)s->atoms : 0;
    if (!t->options.no_limit && trajectory_input_is_blown_up(s->in.read, s->made))
        return trajectory_fail(t, 0, "frame %" PRIu64 ": with its fixed atoms the file becomes " INPUT_BLOWN_UP,
                               t->next, INPUT_MOST_TIMES);
    return status;
}

static int read_cell(cgt_trajectory *t, double cell[6])
{
    dcd_state *const s = t->state;
    for (int i = 0; i < 6; i++)
        if (binary_f64(&s->in, &cell[i], "the unit cell") < 0)
            return -1;
    return end_record(s, 48, "the unit cell");
}

/* Reads x, y and z. has_begun: the first marker of x was read. */
static int read_places(cgt_trajectory *t, uint32_t count, const uint32_t *index, int has_begun)
{
    dcd_state *const s = t->state;
    const uint64_t size = 4 * (uint64_t)count;
    for (size_t axis = 0; axis < 3; axis++)
        if (((axis > 0 || !has_begun) && begin_record(s, size, coordinates) < 0) ||
            read_axis(t, count, index, axis) < 0)
            return -1;
    if (!s->has_fourth)
        return 1;
    static const char name[] = "the fourth coordinate";
    return begin_record(s, size, name) < 0 || binary_skip(&s->in, size, name) < 0 ? -1 : end_record(s, size, name);
}

static void set_time(const cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    const dcd_state *const s = t->state;
    if (s->every > 0) {
        frame->step = (int64_t)s->start + (int64_t)s->at * s->every;
        frame->time = s->delta > 0.0 ? s->delta * (double)frame->step : NAN;
    }
}

/* The first record of a frame is the cell or x; its marker tells that there is a frame. */
static int dcd_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    dcd_state *const s = t->state;
    const uint32_t *const index = s->at > 0 ? s->index : NULL;
    const uint32_t count = index != NULL ? s->moving : s->atoms;
    double cell[6] = {0};
    const int status = begin_frame(t, s->has_cell ? 48 : 4 * (uint64_t)count);
    if (status <= 0)
        return status;
    if ((s->has_cell && read_cell(t, cell) < 0) || binary_expect(&s->in, 12 * (uint64_t)count, coordinates) < 0 ||
        trajectory_reserve(t, 0, s->atoms) < 0)
        return -1;
    if (index != NULL) /* the store may have been moved together since (sites_leave_out) */
        memcpy(t->store.xyzr, s->first, 4 * sizeof *s->first * (size_t)s->atoms);
    if (read_places(t, count, index, !s->has_cell) < 0)
        return -1;
    if (index == NULL && s->index != NULL) {
        if (trajectory_grow(&s->first, s->atoms, 4 * sizeof *s->first))
            return trajectory_fail(t, 0, "not enough memory for the fixed atoms");
        memcpy(s->first, t->store.xyzr, 4 * sizeof *s->first * (size_t)s->atoms);
    }
    for (size_t i = 0; i < s->atoms; i++)
        t->store.xyzr[4 * i + 3] = t->options.radius > 0.0f ? t->options.radius : BARE_RADIUS;
    trajectory_frame_fill(t, frame, s->atoms);
    set_time(t, frame);
    if (s->has_cell)
        set_cell(t, frame, cell);
    s->at++;
    return 1;
}

/* The first frame is read for its fixed atoms. */
static int dcd_skip(cgt_trajectory *t)
{
    dcd_state *const s = t->state;
    cgt_trajectory_frame frame;
    const uint64_t size = 4 * (uint64_t)(s->index != NULL ? s->moving : s->atoms);
    if (s->at == 0 && s->index != NULL)
        return dcd_read(t, &frame);
    const int status = begin_frame(t, s->has_cell ? 48 : size);
    if (status <= 0)
        return status;
    const unsigned records = 3u + (unsigned)s->has_cell + (unsigned)s->has_fourth;
    for (unsigned i = 0; i < records; i++) {
        const uint64_t bytes = i == 0 && s->has_cell ? 48 : size;
        if ((i > 0 && begin_record(s, bytes, coordinates) < 0) || binary_skip(&s->in, bytes, coordinates) < 0 ||
            end_record(s, bytes, coordinates) < 0)
            return -1;
    }
    s->at++;
    return 1;
}

static void dcd_end(cgt_trajectory *t)
{
    dcd_state *const s = t->state;
    free(s->index);
    free(s->first);
}

const trajectory_format trajectory_format_dcd = {
    .is_binary = 1,
    .is_series = 1,
    .state_size = sizeof(dcd_state),
    .begin = dcd_begin,
    .read = dcd_read,
    .skip = dcd_skip,
    .end = dcd_end,
};
