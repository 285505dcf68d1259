/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Parts of GROMACS' binary frames. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/gromacs/gromacs_frame.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define BARE_RADIUS 0.1f /* nanometres, where the options say nothing */
#define PART 1024u       /* atoms read at a time, so that memory grows with the file */

const char gromacs_head[] = "the header of a frame";
const char gromacs_coordinates[] = "the coordinates of a frame";

int gromacs_begin(cgt_trajectory *t)
{
    gromacs_state *const s = t->state;
    binary_begin(&s->in, t, 1);
    return 1;
}

/* Reads the number that a frame begins with: 1, 0 at the end of the file, -1. */
int gromacs_read_magic(cgt_trajectory *t, uint32_t *magic)
{
    gromacs_state *const s = t->state;
    unsigned char bytes[4];
    const int status = binary_bytes_or_end(&s->in, bytes, sizeof bytes, gromacs_head);
    *magic = status > 0 ? binary_get_u32(bytes, 1) : 0;
    return status;
}

int gromacs_read_count(cgt_trajectory *t)
{
    gromacs_state *const s = t->state;
    int32_t count;
    if (binary_i32(&s->in, &count, gromacs_head) < 0)
        return -1;
    if (count < 0)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRId32 " atoms: damaged", t->next, count);
    s->count = (uint32_t)count;
    return binary_check_count(&s->in, s->count);
}

/* A number of the file's precision, 4 or 8 bytes. */
int gromacs_read_real(binary_reader *in, size_t bytes, double *value, const char *name)
{
    uint32_t bits;
    float number;
    if (bytes == 8)
        return binary_f64(in, value, name);
    if (binary_u32(in, &bits, name) < 0)
        return -1;
    memcpy(&number, &bits, sizeof number);
    *value = (double)number;
    return 1;
}

int gromacs_read_box(cgt_trajectory *t, size_t bytes)
{
    gromacs_state *const s = t->state;
    for (int i = 0; i < 9; i++)
        if (gromacs_read_real(&s->in, bytes, &s->edge[i / 3][i % 3], "the box") < 0)
            return -1;
    return 1;
}

void gromacs_fill_frame(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    const gromacs_state *const s = t->state;
    for (size_t i = 0; i < s->count; i++)
        t->store.xyzr[4 * i + 3] = t->options.radius > 0.0f ? t->options.radius : BARE_RADIUS;
    trajectory_frame_fill(t, frame, s->count);
    frame->step = s->step;
    frame->time = s->time;
    frame->velocity = s->has_velocity ? t->store.velocity : NULL;
    if (s->edge[0][0] != 0.0 || s->edge[1][1] != 0.0 || s->edge[2][2] != 0.0) {
        trajectory_frame_set_box(frame, origin, s->edge);
        memset(frame->periodic, frame->box_min[0] <= frame->box_max[0] ? 1 : -1, sizeof frame->periodic);
    }
}

void gromacs_end(cgt_trajectory *t)
{
    gromacs_state *const s = t->state;
    free(s->packed);
}

/* Reads `count` vectors to an array of the store: xyzr (stride 4) or velocity. */
int gromacs_read_vectors(cgt_trajectory *t, int is_velocity, size_t bytes)
{
    gromacs_state *const s = t->state;
    if (binary_expect(&s->in, 3 * (uint64_t)bytes * s->count, gromacs_coordinates) < 0)
        return -1;
    double block[3 * PART];
    for (uint32_t done = 0; done < s->count;) {
        const uint32_t part = s->count - done < PART ? s->count - done : PART;
        if (trajectory_reserve(t, (size_t)done + part, s->count) < 0 ||
            binary_reals(&s->in, block, 3 * (size_t)part, bytes == 8, gromacs_coordinates) < 0)
            return -1;
        for (size_t i = 0; i < part; i++) {
            float *const to = is_velocity ? t->store.velocity + 3 * (done + i) : t->store.xyzr + 4 * (done + i);
            for (size_t axis = 0; axis < 3; axis++)
                to[axis] = is_velocity ? (float)block[3 * i + axis] : trajectory_place(t, axis, block[3 * i + axis]);
        }
        done += part;
    }
    return 1;
}
