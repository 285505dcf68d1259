/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GROMACS .xtc and .trr: frames of XDR, all numbers big-endian (manual of GROMACS, "File formats"). An .xtc has compressed
 * coordinates; a .trr has box, coordinates, velocities and forces, as floats or doubles, each where its size says so.
 * Lengths are nanometres, times picoseconds. Neither tells what its atoms are. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/binary_reader.h"
#include "trajectory/gromacs/xdr_coordinates.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define XTC_MAGIC 1995u
#define XTC_WIDE_MAGIC 2023u /* since GROMACS 2023: lengths of 64 bits, for very many atoms */
#define TRR_MAGIC 1993u
#define PLAIN_MOST 9u    /* so few atoms are not compressed */
#define BARE_RADIUS 0.1f /* nanometres, where the options say nothing */
#define PART 65536u      /* atoms read at a time, so that memory grows with the file */

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

static const char head[] = "the header of a frame";
static const char coordinates[] = "the coordinates of a frame";

/* ---- Both --------------------------------------------------------------------------------------------------- */

static int gromacs_begin(trajectory *t)
{
    gromacs_state *const s = t->state;
    binary_begin(&s->in, t, 1);
    return 1;
}

/* Reads the number that a frame begins with: 1, 0 at the end of the file, -1. */
static int read_magic(trajectory *t, uint32_t *magic)
{
    gromacs_state *const s = t->state;
    unsigned char bytes[4];
    const int status = binary_bytes_or_end(&s->in, bytes, sizeof bytes, head);
    *magic = status > 0 ? binary_get_u32(bytes, 1) : 0;
    return status;
}

static int read_count(trajectory *t)
{
    gromacs_state *const s = t->state;
    int32_t count;
    if (binary_i32(&s->in, &count, head) < 0) {
        return -1;
    }
    if (count < 0) {
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRId32 " atoms: damaged", t->next, count);
    }
    s->count = (uint32_t)count;
    return binary_check_count(&s->in, s->count);
}

/* A number of the file's precision, 4 or 8 bytes. */
static int read_real(binary_reader *in, size_t bytes, double *value, const char *name)
{
    uint32_t bits;
    float number;
    if (bytes == 8) {
        return binary_f64(in, value, name);
    }
    if (binary_u32(in, &bits, name) < 0) {
        return -1;
    }
    memcpy(&number, &bits, sizeof number);
    *value = (double)number;
    return 1;
}

static int read_box(trajectory *t, size_t bytes)
{
    gromacs_state *const s = t->state;
    for (int i = 0; i < 9; i++) {
        if (read_real(&s->in, bytes, &s->edge[i / 3][i % 3], "the box") < 0) {
            return -1;
        }
    }
    return 1;
}

static void fill_frame(trajectory *t, trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    const gromacs_state *const s = t->state;
    for (size_t i = 0; i < s->count; i++) {
        t->store.xyzr[4 * i + 3] = t->options.radius > 0.0f ? t->options.radius : BARE_RADIUS;
    }
    trajectory_frame_fill(t, frame, s->count);
    frame->step = s->step;
    frame->time = s->time;
    frame->velocity = s->has_velocity ? t->store.velocity : NULL;
    if (s->edge[0][0] != 0.0 || s->edge[1][1] != 0.0 || s->edge[2][2] != 0.0) {
        trajectory_frame_set_box(frame, origin, s->edge);
        memset(frame->periodic, frame->box_min[0] <= frame->box_max[0] ? 1 : -1, sizeof frame->periodic);
    }
}

static void gromacs_end(trajectory *t)
{
    gromacs_state *const s = t->state;
    free(s->packed);
}

/* ---- .xtc --------------------------------------------------------------------------------------------------- */

static int damaged(trajectory *t) { return trajectory_fail(t, 0, "frame %" PRIu64 ": damaged coordinates", t->next); }

/* Reads a frame's header, box included: 1, 0 at the end of the file, -1. */
static int read_xtc_head(trajectory *t, int *is_wide)
{
    gromacs_state *const s = t->state;
    uint32_t magic;
    const int status = read_magic(t, &magic);
    if (status <= 0) {
        return status;
    }
    if (magic != XTC_MAGIC && magic != XTC_WIDE_MAGIC) {
        return trajectory_fail(t, 0, "frame %" PRIu64 ": not an .xtc frame: it does not begin with 1995", t->next);
    }
    *is_wide = magic == XTC_WIDE_MAGIC;
    uint32_t again;
    if (read_count(t) < 0 || binary_i32(&s->in, &s->step, head) < 0 || read_real(&s->in, 4, &s->time, head) < 0 ||
        read_box(t, 4) < 0 || binary_u32(&s->in, &again, head) < 0) {
        return -1;
    }
    return again == s->count ? 1 : damaged(t);
}

/* The length of the compressed bytes; they are padded to a multiple of 4. */
static int read_packed_size(trajectory *t, int is_wide, xdr_packed *packed, uint64_t *size)
{
    gromacs_state *const s = t->state;
    double precision;
    uint32_t narrow = 0;
    if (read_real(&s->in, 4, &precision, coordinates) < 0) {
        return -1;
    }
    packed->precision = (float)precision;
    for (int i = 0; i < 6; i++) {
        if (binary_i32(&s->in, i < 3 ? &packed->low[i] : &packed->high[i - 3], coordinates) < 0) {
            return -1;
        }
    }
    if (binary_i32(&s->in, &packed->small, coordinates) < 0 ||
        (is_wide ? binary_u64(&s->in, size, coordinates) : binary_u32(&s->in, &narrow, coordinates)) < 0) {
        return -1;
    }
    *size = is_wide ? *size : narrow;
    /* an atom needs at most 3 x 32 bits and a flag with its count */
    return *size <= 13 * (uint64_t)s->count + 64 ? binary_expect(&s->in, *size, coordinates) : damaged(t);
}

static int read_packed(trajectory *t, int is_wide)
{
    gromacs_state *const s = t->state;
    xdr_packed packed;
    uint64_t size = 0;
    if (read_packed_size(t, is_wide, &packed, &size) < 0 ||
        binary_blob(&s->in, &s->packed, &s->packed_capacity, (size_t)size, coordinates) < 0 ||
        binary_skip(&s->in, (4 - size % 4) % 4, coordinates) < 0 || trajectory_reserve(t, s->count, s->count) < 0) {
        return -1;
    }
    return xdr_decode(&packed, s->packed, (size_t)size, t->store.xyzr, 4, s->count) ? damaged(t) : 1;
}

/* Reads `count` vectors to an array of the store: xyzr (stride 4) or velocity. */
static int read_vectors(trajectory *t, int is_velocity, size_t bytes)
{
    gromacs_state *const s = t->state;
    if (binary_expect(&s->in, 3 * (uint64_t)bytes * s->count, coordinates) < 0) {
        return -1;
    }
    for (uint32_t i = 0; i < s->count; i++) {
        if (i % PART == 0) {
            const uint32_t part = s->count - i < PART ? s->count - i : PART;
            if (trajectory_reserve(t, (size_t)i + part, s->count) < 0) {
                return -1;
            }
        }
        float *const to = is_velocity ? t->store.velocity + 3 * (size_t)i : t->store.xyzr + 4 * (size_t)i;
        if (binary_floats(&s->in, to, 1, 3, bytes == 8, coordinates) < 0) {
            return -1;
        }
    }
    return 1;
}

static int xtc_read(trajectory *t, trajectory_frame *frame)
{
    gromacs_state *const s = t->state;
    int is_wide = 0;
    const int status = read_xtc_head(t, &is_wide);
    if (status <= 0) {
        return status;
    }
    if (trajectory_reserve(t, 0, s->count) < 0 ||
        (s->count <= PLAIN_MOST ? read_vectors(t, 0, 4) : read_packed(t, is_wide)) < 0) {
        return -1;
    }
    s->has_velocity = 0;
    fill_frame(t, frame);
    return 1;
}

static int xtc_skip(trajectory *t)
{
    gromacs_state *const s = t->state;
    xdr_packed packed;
    uint64_t size = 0;
    int is_wide = 0;
    const int status = read_xtc_head(t, &is_wide);
    if (status <= 0) {
        return status;
    }
    if (s->count <= PLAIN_MOST) {
        return binary_skip(&s->in, 12 * (uint64_t)s->count, coordinates);
    }
    return read_packed_size(t, is_wide, &packed, &size) < 0
               ? -1
               : binary_skip(&s->in, size + (4 - size % 4) % 4, coordinates);
}

static const char *const xtc_names[] = {"xtc", NULL};
static const char *const xtc_endings[] = {".xtc", NULL};

const trajectory_format trajectory_format_xtc = {
    .names = xtc_names,
    .endings = xtc_endings,
    .is_series = 1,
    .state_size = sizeof(gromacs_state),
    .begin = gromacs_begin,
    .read = xtc_read,
    .skip = xtc_skip,
    .end = gromacs_end,
};

/* ---- .trr --------------------------------------------------------------------------------------------------- */

/* The blocks of a frame, in the order of their sizes in the header. */
enum {
    TRR_INPUT,
    TRR_ENERGY,
    TRR_BOX,
    TRR_VIRIAL,
    TRR_PRESSURE,
    TRR_TOPOLOGY,
    TRR_SYMBOLS,
    TRR_X,
    TRR_V,
    TRR_F,
    TRR_BLOCKS
};

typedef struct trr_head {
    uint32_t size[TRR_BLOCKS];
    size_t real; /* bytes of a number */
} trr_head;

/* The precision follows from the size of a block whose count of numbers is known. */
static int find_precision(trajectory *t, trr_head *h)
{
    const gromacs_state *const s = t->state;
    const uint64_t numbers = 3 * (uint64_t)s->count;
    const uint64_t size = h->size[TRR_BOX] > 0 ? h->size[TRR_BOX] : h->size[TRR_X];
    const uint64_t count = h->size[TRR_BOX] > 0 ? 9 : numbers;
    h->real = size == 8 * count && size > 0 ? 8 : 4;
    for (int i = 0; i < TRR_BLOCKS; i++) {
        const uint64_t expected = i == TRR_BOX || i == TRR_VIRIAL || i == TRR_PRESSURE ? 9 * h->real
                                  : i >= TRR_X                                         ? numbers * h->real
                                                                                       : 0;
        if (h->size[i] != 0 && h->size[i] != expected) {
            return trajectory_fail(t, 0,
                                   "frame %" PRIu64 ": a block of %" PRIu32 " bytes for %" PRIu32 " atoms: damaged",
                                   t->next, h->size[i], s->count);
        }
    }
    return 1;
}

/* Reads a frame's header: 1, 0 at the end of the file, -1. */
static int read_trr_head(trajectory *t, trr_head *h)
{
    gromacs_state *const s = t->state;
    uint32_t magic, length, words;
    double lambda;
    const int status = read_magic(t, &magic);
    if (status <= 0) {
        return status;
    }
    if (magic != TRR_MAGIC) {
        return trajectory_fail(t, 0, "frame %" PRIu64 ": not a .trr frame: it does not begin with 1993", t->next);
    }
    if (binary_u32(&s->in, &length, head) < 0 || binary_u32(&s->in, &words, head) < 0) {
        return -1;
    }
    if (words > 64) {
        return trajectory_fail(t, 0, "frame %" PRIu64 ": a version of %" PRIu32 " letters: damaged", t->next, words);
    }
    if (binary_skip(&s->in, (words + 3) / 4 * 4, head) < 0) {
        return -1;
    }
    for (int i = 0; i < TRR_BLOCKS; i++) {
        if (binary_u32(&s->in, &h->size[i], head) < 0) {
            return -1;
        }
    }
    if (read_count(t) < 0 || binary_i32(&s->in, &s->step, head) < 0 || binary_u32(&s->in, &words, head) < 0 ||
        find_precision(t, h) < 0) {
        return -1;
    }
    return read_real(&s->in, h->real, &s->time, head) < 0 ? -1 : read_real(&s->in, h->real, &lambda, head);
}

/* Forces are columns of the table; the file has them after all else. */
static int read_forces(trajectory *t, const trr_head *h)
{
    static const char *const names[3] = {"fx", "fy", "fz"};
    gromacs_state *const s = t->state;
    int slot[3], is_wanted = 0;
    for (int axis = 0; axis < 3; axis++) {
        slot[axis] = columns_add_named(t, names[axis], TRAJECTORY_NUMBER);
        if (slot[axis] < 0) {
            return -1;
        }
        is_wanted |= slot[axis];
    }
    if (!is_wanted) {
        return binary_skip(&s->in, h->size[TRR_F], "the forces of a frame");
    }
    if (columns_reserve(t, s->count)) {
        return trajectory_fail(t, 0, "not enough memory for the forces");
    }
    for (uint32_t i = 0; i < s->count; i++) {
        float force[3];
        if (binary_floats(&s->in, force, 1, 3, h->real == 8, "the forces of a frame") < 0) {
            return -1;
        }
        for (int axis = 0; axis < 3; axis++) {
            if (slot[axis] > 0) {
                columns_values(t, slot[axis])[i] = force[axis];
            }
        }
    }
    return 1;
}

static int read_trr_blocks(trajectory *t, const trr_head *h)
{
    gromacs_state *const s = t->state;
    memset(s->edge, 0, sizeof s->edge);
    if ((h->size[TRR_BOX] > 0 && read_box(t, h->real) < 0) ||
        binary_skip(&s->in, (uint64_t)h->size[TRR_VIRIAL] + h->size[TRR_PRESSURE], head) < 0 ||
        trajectory_reserve(t, 0, s->count) < 0 || (h->size[TRR_X] > 0 && read_vectors(t, 0, h->real) < 0) ||
        (h->size[TRR_V] > 0 && read_vectors(t, 1, h->real) < 0)) {
        return -1;
    }
    s->has_velocity = h->size[TRR_V] > 0;
    return h->size[TRR_F] > 0 ? read_forces(t, h) : 1;
}

static int skip_trr_blocks(trajectory *t, const trr_head *h)
{
    gromacs_state *const s = t->state;
    uint64_t size = 0;
    for (int i = 0; i < TRR_BLOCKS; i++) {
        size += h->size[i];
    }
    return binary_skip(&s->in, size, coordinates);
}

/* Reads the header of the next frame that has coordinates; one may have velocities or forces alone. */
static int next_trr_head(trajectory *t, trr_head *h)
{
    const gromacs_state *const s = t->state;
    while (1) {
        const int status = read_trr_head(t, h);
        if (status <= 0 || h->size[TRR_X] > 0 || s->count == 0) {
            return status;
        }
        trajectory_warn(t, DOUBT_NO_PLACES, 0,
                        "frames without coordinates are passed over; the first is of step %" PRId32, s->step);
        if (skip_trr_blocks(t, h) < 0) {
            return -1;
        }
    }
}

static int trr_read(trajectory *t, trajectory_frame *frame)
{
    trr_head h;
    const int status = next_trr_head(t, &h);
    if (status <= 0) {
        return status;
    }
    if (read_trr_blocks(t, &h) < 0) {
        return -1;
    }
    fill_frame(t, frame);
    return 1;
}

static int trr_skip(trajectory *t)
{
    trr_head h;
    const int status = next_trr_head(t, &h);
    return status <= 0 ? status : skip_trr_blocks(t, &h);
}

static const char *const trr_names[] = {"trr", NULL};
static const char *const trr_endings[] = {".trr", NULL};

const trajectory_format trajectory_format_trr = {
    .names = trr_names,
    .endings = trr_endings,
    .is_series = 1,
    .state_size = sizeof(gromacs_state),
    .begin = gromacs_begin,
    .read = trr_read,
    .skip = trr_skip,
    .end = gromacs_end,
};
