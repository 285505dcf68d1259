/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GROMACS .trr: box, coordinates, velocities and forces, as floats or doubles, each where its size in the header says
 * so. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/gromacs/gromacs_frame.h"

#include <inttypes.h>
#include <string.h>

#define TRR_MAGIC 1993u

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
static int find_precision(cgt_trajectory *t, trr_head *h)
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
        if (h->size[i] != 0 && h->size[i] != expected)
            return trajectory_fail(t, 0,
                                   "frame %" PRIu64 ": a block of %" PRIu32 " bytes for %" PRIu32 " atoms: damaged",
                                   t->next, h->size[i], s->count);
    }
    return 1;
}

/* Reads a frame's header: 1, 0 at the end of the file, -1. */
static int read_trr_head(cgt_trajectory *t, trr_head *h)
{
    gromacs_state *const s = t->state;
    uint32_t magic, length, words;
    double lambda;
    const int status = gromacs_read_magic(t, &magic);
    if (status <= 0)
        return status;
    if (magic != TRR_MAGIC)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": not a .trr frame: it does not begin with 1993", t->next);
    if (binary_u32(&s->in, &length, gromacs_head) < 0 || binary_u32(&s->in, &words, gromacs_head) < 0)
        return -1;
    if (words > 64)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": a version of %" PRIu32 " letters: damaged", t->next, words);
    if (binary_skip(&s->in, (words + 3) / 4 * 4, gromacs_head) < 0)
        return -1;
    for (int i = 0; i < TRR_BLOCKS; i++)
        if (binary_u32(&s->in, &h->size[i], gromacs_head) < 0)
            return -1;
    if (gromacs_read_count(t) < 0 || binary_i32(&s->in, &s->step, gromacs_head) < 0 ||
        binary_u32(&s->in, &words, gromacs_head) < 0 || find_precision(t, h) < 0)
        return -1;
    return gromacs_read_real(&s->in, h->real, &s->time, gromacs_head) < 0
               ? -1
               : gromacs_read_real(&s->in, h->real, &lambda, gromacs_head);
}

/* Forces are columns of the table; the file has them after all else. */
static int read_forces(cgt_trajectory *t, const trr_head *h)
{
    static const char *const names[3] = {"fx", "fy", "fz"};
    gromacs_state *const s = t->state;
    int slot[3], is_wanted = 0;
    for (int axis = 0; axis < 3; axis++) {
        slot[axis] = columns_add_named(t, names[axis], CGT_TRAJECTORY_NUMBER);
        if (slot[axis] < 0)
            return -1;
        is_wanted |= slot[axis];
    }
    if (!is_wanted)
        return binary_skip(&s->in, h->size[TRR_F], "the forces of a frame");
    if (columns_reserve(t, s->count))
        return trajectory_fail(t, 0, "not enough memory for the forces");
    for (uint32_t i = 0; i < s->count; i++) {
        double force[3];
        if (binary_reals(&s->in, force, 3, h->real == 8, "the forces of a frame") < 0)
            return -1;
        for (int axis = 0; axis < 3; axis++)
            if (slot[axis] > 0)
                columns_values(t, slot[axis])[i] = (float)force[axis];
    }
    return 1;
}

static int read_trr_blocks(cgt_trajectory *t, const trr_head *h)
{
    gromacs_state *const s = t->state;
    memset(s->edge, 0, sizeof s->edge);
    if ((h->size[TRR_BOX] > 0 && gromacs_read_box(t, h->real) < 0) ||
        binary_skip(&s->in, (uint64_t)h->size[TRR_VIRIAL] + h->size[TRR_PRESSURE], gromacs_head) < 0 ||
        trajectory_reserve(t, 0, s->count) < 0 || (h->size[TRR_X] > 0 && gromacs_read_vectors(t, 0, h->real) < 0) ||
        (h->size[TRR_V] > 0 && gromacs_read_vectors(t, 1, h->real) < 0))
        return -1;
    s->has_velocity = h->size[TRR_V] > 0;
    return h->size[TRR_F] > 0 ? read_forces(t, h) : 1;
}

static int skip_trr_blocks(cgt_trajectory *t, const trr_head *h)
{
    gromacs_state *const s = t->state;
    uint64_t size = 0;
    for (int i = 0; i < TRR_BLOCKS; i++)
        size += h->size[i];
    return binary_skip(&s->in, size, gromacs_coordinates);
}

/* Reads the header of the next frame that has coordinates; one may have velocities or forces alone. */
static int next_trr_head(cgt_trajectory *t, trr_head *h)
{
    const gromacs_state *const s = t->state;
    while (1) {
        const int status = read_trr_head(t, h);
        if (status <= 0 || h->size[TRR_X] > 0 || s->count == 0)
            return status;
        trajectory_warn(t, DOUBT_NO_PLACES, 0,
                        "frames without coordinates are passed over; the first is of step %" PRId32, s->step);
        if (skip_trr_blocks(t, h) < 0)
            return -1;
    }
}

static int trr_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    trr_head h = {.real = 4};
    const int status = next_trr_head(t, &h);
    if (status <= 0)
        return status;
    if (read_trr_blocks(t, &h) < 0)
        return -1;
    gromacs_fill_frame(t, frame);
    return 1;
}

static int trr_skip(cgt_trajectory *t)
{
    trr_head h = {.real = 4};
    const int status = next_trr_head(t, &h);
    return status <= 0 ? status : skip_trr_blocks(t, &h);
}

const trajectory_format trajectory_format_trr = {
    .is_binary = 1,
    .is_series = 1,
    .unit = 0.1f,
    .state_size = sizeof(gromacs_state),
    .begin = gromacs_begin,
    .read = trr_read,
    .skip = trr_skip,
    .end = gromacs_end,
};
