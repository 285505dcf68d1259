/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GROMACS .xtc: box and compressed coordinates. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/gromacs/gromacs_frame.h"

#include <inttypes.h>

#define XTC_MAGIC 1995u
#define XTC_WIDE_MAGIC 2023u /* since GROMACS 2023: lengths of 64 bits, for very many atoms */
#define PLAIN_MOST 9u        /* so few atoms are not compressed */

static int damaged(cgt_trajectory *t)
{
    return trajectory_fail(t, 0, "frame %" PRIu64 ": damaged coordinates", t->next);
}

/* Reads a frame's header, box included: 1, 0 at the end of the file, -1. */
static int read_xtc_head(cgt_trajectory *t, int *is_wide)
{
    gromacs_state *const s = t->state;
    uint32_t magic;
    const int status = gromacs_read_magic(t, &magic);
    if (status <= 0)
        return status;
    if (magic != XTC_MAGIC && magic != XTC_WIDE_MAGIC)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": not an .xtc frame: it does not begin with 1995", t->next);
    *is_wide = magic == XTC_WIDE_MAGIC;
    uint32_t again;
    if (gromacs_read_count(t) < 0 || binary_i32(&s->in, &s->step, gromacs_head) < 0 ||
        gromacs_read_real(&s->in, 4, &s->time, gromacs_head) < 0 || gromacs_read_box(t, 4) < 0 ||
        binary_u32(&s->in, &again, gromacs_head) < 0)
        return -1;
    return again == s->count ? 1 : damaged(t);
}

/* The length of the compressed bytes; they are padded to a multiple of 4. */
static int read_packed_size(cgt_trajectory *t, int is_wide, xdr_packed *packed, uint64_t *size)
{
    gromacs_state *const s = t->state;
    double precision;
    uint32_t narrow = 0;
    if (gromacs_read_real(&s->in, 4, &precision, gromacs_coordinates) < 0)
        return -1;
    packed->precision = (float)precision;
    for (int i = 0; i < 6; i++)
        if (binary_i32(&s->in, i < 3 ? &packed->low[i] : &packed->high[i - 3], gromacs_coordinates) < 0)
            return -1;
    if (binary_i32(&s->in, &packed->small, gromacs_coordinates) < 0 ||
        (is_wide ? binary_u64(&s->in, size, gromacs_coordinates) : binary_u32(&s->in, &narrow, gromacs_coordinates)) <
            0)
        return -1;
    *size = is_wide ? *size : narrow;
    /* an atom needs at least a bit, and at most 3 x 32 bits and a flag with its count */
    const int is_likely = s->count / 8 <= *size && *size <= 13 * (uint64_t)s->count + 64;
    return is_likely ? binary_expect(&s->in, *size, gromacs_coordinates) : damaged(t);
}

static int read_packed(cgt_trajectory *t, int is_wide)
{
    gromacs_state *const s = t->state;
    xdr_packed packed;
    uint64_t size = 0;
    if (read_packed_size(t, is_wide, &packed, &size) < 0 ||
        binary_blob(&s->in, &s->packed, &s->packed_capacity, (size_t)size, gromacs_coordinates) < 0 ||
        binary_skip(&s->in, (4 - size % 4) % 4, gromacs_coordinates) < 0 ||
        trajectory_reserve(t, s->count, s->count) < 0)
        return -1;
    if (xdr_decode(&packed, s->packed, (size_t)size, t->store.xyzr, 4, s->count))
        return damaged(t);
    for (size_t axis = 0; axis < 3; axis++)
        trajectory_move(t, axis, t->store.xyzr + axis, 4, s->count);
    return 1;
}

static int xtc_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    gromacs_state *const s = t->state;
    int is_wide = 0;
    const int status = read_xtc_head(t, &is_wide);
    if (status <= 0)
        return status;
    if (trajectory_reserve(t, 0, s->count) < 0 ||
        (s->count <= PLAIN_MOST ? gromacs_read_vectors(t, 0, 4) : read_packed(t, is_wide)) < 0)
        return -1;
    s->has_velocity = 0;
    gromacs_fill_frame(t, frame);
    return 1;
}

static int xtc_skip(cgt_trajectory *t)
{
    gromacs_state *const s = t->state;
    xdr_packed packed;
    uint64_t size = 0;
    int is_wide = 0;
    const int status = read_xtc_head(t, &is_wide);
    if (status <= 0)
        return status;
    if (s->count <= PLAIN_MOST)
        return binary_skip(&s->in, 12 * (uint64_t)s->count, gromacs_coordinates);
    return read_packed_size(t, is_wide, &packed, &size) < 0
               ? -1
               : binary_skip(&s->in, size + (4 - size % 4) % 4, gromacs_coordinates);
}

const trajectory_format trajectory_format_xtc = {
    .is_binary = 1,
    .is_series = 1,
    .unit = 0.1f,
    .state_size = sizeof(gromacs_state),
    .begin = gromacs_begin,
    .read = xtc_read,
    .skip = xtc_skip,
    .end = gromacs_end,
};
