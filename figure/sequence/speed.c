/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The speed of each sphere; see speed.h. */
#include "sequence/speed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "data/frame_access.h"
#include "sequence/id_match.h"
#include "sequence/periodic_box.h"

struct speed_tracker {
    cgt_context *context;
    uint32_t capacity; /* spheres that the arrays hold */
    float *speed;
    float *last_xyz; /* of the frame before: 3 floats each */
    float *xyz;      /* of the one that is being processed, where its spheres are in another order; NULL: not yet */
    id_match last;   /* its spheres */
    uint64_t last_number;
    int has_last;
    float *first;         /* speeds of the run's first frame; NULL: unknown */
    uint32_t first_count; /* spheres of it */
    float boxless[3];     /* the longest steps up to this frame, where it has no box */
};

speed_tracker *cgt_speed_create(cgt_context *context)
{
    speed_tracker *const tracker = calloc(1, sizeof *tracker);
    if (tracker)
        tracker->context = context;
    return tracker;
}

void cgt_speed_release(speed_tracker *tracker)
{
    if (!tracker)
        return;
    free(tracker->speed);
    free(tracker->last_xyz);
    free(tracker->xyz);
    free(tracker->first);
    cgt_id_match_free(&tracker->last);
    free(tracker);
}

void cgt_speed_restart(speed_tracker *tracker) { tracker->has_last = 0; }

void cgt_speed_boxless_steps(const speed_tracker *tracker, float longest[3])
{
    memcpy(longest, tracker->boxless, sizeof tracker->boxless);
}

/* Grows an array to count elements of `floats` floats; its contents stay. */
static int grow(float **array, size_t count, size_t floats)
{
    if (count > SIZE_MAX / (floats * sizeof(float)))
        return -1;
    float *grown = realloc(*array, count * floats * sizeof(float));
    if (!grown)
        return -1;
    *array = grown;
    return 0;
}

/* A frame without spheres has speeds, too: none of them is missing. */
static int reserve(speed_tracker *t, uint32_t count)
{
    const uint32_t room = count ? count : 1;
    if (room <= t->capacity)
        return 0;
    if (grow(&t->speed, room, 1) || grow(&t->last_xyz, room, 3) || (t->xyz && grow(&t->xyz, room, 3)))
        return -1;
    t->capacity = room;
    return 0;
}

/* Ids of spheres; vertices keep their indices. */
static const uint32_t *ids(const cgt_trajectory_frame *frame)
{
    return frame->kind == CGT_TRAJECTORY_TRIANGLES ? NULL : frame->id;
}

/* Takes the boundaries that a step from a to b goes through out of it. */
static void shorten(const periodic_box *box, const float *a, const float *b, double step[3])
{
    double count[3];
    const int crossed = cgt_periodic_box_crossed(box, a, b, count);
    for (int c = 0; c < 3 && crossed; c++)
        for (int e = 0; e < 3; e++)
            step[c] -= count[e] * box->edge[e][c];
}

/* Distance from a to b, the short way through boundaries. */
static inline double distance(const periodic_box *box, const float *a, const float *b)
{
    double step[3] = {(double)b[0] - (double)a[0], (double)b[1] - (double)a[1], (double)b[2] - (double)a[2]};
    if (!(fabs(step[0]) < box->near && fabs(step[1]) < box->near && fabs(step[2]) < box->near))
        shorten(box, a, b, step);
    return sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
}

/* ---- A frame, in pieces ------------------------------------------------------------------------------------- */

enum { PIECE = 1 << 16 }; /* spheres, which take some 0.5 ms; waking a thread takes some 50 us */

typedef struct speed_job {
    speed_tracker *tracker;
    const cgt_trajectory_frame *frame;
    const periodic_box *box;
    int later;           /* than the frame before */
    int is_same;         /* spheres as that frame has, in the same order */
    float *xyz;          /* where places are kept for the next frame */
    float (*boxless)[3]; /* of each piece: its longest steps; NULL where there is a box */
} speed_job;

static void note_step(float longest[3], const float *a, const float *b)
{
    for (int c = 0; c < 3; c++) {
        const float step = fabsf(b[c] - a[c]);
        longest[c] = step > longest[c] ? step : longest[c];
    }
}

static inline float from_position(const speed_job *job, float longest[3], uint32_t i)
{
    const speed_tracker *const t = job->tracker;
    const uint32_t last = job->is_same ? i
                          : job->later ? id_match_find(&t->last, ids(job->frame), job->frame->count, i)
                                       : UINT32_MAX;
    if (last == UINT32_MAX)
        return NAN;
    const float *const before = t->last_xyz + 3 * (size_t)last, *const place = frame_place(job->frame, i);
    const double moved = distance(job->box, before, place);
    if (!isfinite(moved))
        return NAN;
    if (job->boxless)
        note_step(longest, before, place);
    return (float)moved;
}

static float from_velocity(const cgt_trajectory_frame *frame, uint32_t i)
{
    const float *v = frame->velocity + 3 * (size_t)i;
    const double x = (double)v[0], y = (double)v[1], z = (double)v[2];
    const double speed = sqrt(x * x + y * y + z * z);
    return isfinite(speed) ? (float)speed : NAN;
}

/* Finds the speeds of a piece, and keeps its places for the next frame. */
static void process_piece(void *user, uint32_t piece)
{
    const speed_job *const job = user;
    const cgt_trajectory_frame *const frame = job->frame;
    float longest[3] = {0.0f, 0.0f, 0.0f}; /* not in job->boxless, whose cache lines pieces share */
    const uint32_t begin = piece * PIECE, end = frame->count - begin < PIECE ? frame->count : begin + PIECE;
    for (uint32_t i = begin; i < end; i++) {
        job->tracker->speed[i] = frame->velocity ? from_velocity(frame, i) : from_position(job, longest, i);
        memcpy(job->xyz + 3 * (size_t)i, frame_place(frame, i), 3 * sizeof(float));
    }
    if (job->boxless)
        memcpy(job->boxless[piece], longest, sizeof longest);
}

static int process(speed_tracker *t, const cgt_trajectory_frame *frame)
{
    const periodic_box box = cgt_periodic_box_of(frame);
    const uint32_t pieces = frame->count / PIECE + (frame->count % PIECE > 0);
    const int has_box = !(frame->box_min[0] > frame->box_max[0]);
    speed_job job = {.tracker = t, .frame = frame, .box = &box, .later = t->has_last && frame->number > t->last_number};
    const int is_compared = job.later && !frame->velocity;
    if (is_compared && cgt_id_match_prepare(&t->last, ids(frame), frame->count))
        return -1;
    job.is_same = is_compared && t->last.is_same;
    const int is_moved = is_compared && !job.is_same;
    if (is_moved && !t->xyz && grow(&t->xyz, (size_t)t->capacity + 1, 3))
        return -1;
    job.xyz = is_moved ? t->xyz : t->last_xyz;
    if (!has_box && pieces && !(job.boxless = calloc(pieces, sizeof *job.boxless)))
        return -1;
    cgt_context_run_tasks(t->context, process_piece, &job, pieces);
    for (uint32_t k = 0; k < pieces && job.boxless; k++)
        for (int c = 0; c < 3; c++)
            t->boxless[c] = fmaxf(t->boxless[c], job.boxless[k][c]);
    free(job.boxless);
    t->last_number = frame->number;
    t->has_last = 1;
    t->xyz = is_moved ? t->last_xyz : t->xyz;
    t->last_xyz = job.xyz;
    return job.is_same ? 0 : cgt_id_match_remember(&t->last, ids(frame), frame->count);
}

int cgt_speed_look_ahead(speed_tracker *t, const cgt_trajectory_frame *next)
{
    const periodic_box box = cgt_periodic_box_of(next);
    const uint32_t count = t->last.count;
    if (grow(&t->first, (size_t)count + 1, 1) || cgt_id_match_prepare(&t->last, ids(next), next->count))
        return -1;
    t->first_count = count;
    for (uint32_t i = 0; i < count; i++)
        t->first[i] = NAN;
    for (uint32_t i = 0; i < next->count && next->number > t->last_number; i++) {
        const uint32_t last = id_match_find(&t->last, ids(next), next->count, i);
        const double moved =
            last == UINT32_MAX ? NAN : distance(&box, t->last_xyz + 3 * (size_t)last, frame_place(next, i));
        if (isfinite(moved))
            t->first[last] = (float)moved;
    }
    return 0;
}

int cgt_speed_next(speed_tracker *tracker, const cgt_trajectory_frame *frame, const float **speeds,
                   speed_source *source)
{
    *speeds = NULL;
    *source = frame->velocity ? SPEED_FROM_VELOCITY : SPEED_FROM_POSITIONS;
    memset(tracker->boxless, 0, sizeof tracker->boxless);
    if (reserve(tracker, frame->count) || process(tracker, frame))
        return -1;
    if (!frame->velocity && frame->number == 0 && frame->count && tracker->first &&
        frame->count == tracker->first_count)
        memcpy(tracker->speed, tracker->first, frame->count * sizeof *tracker->speed);
    *speeds = tracker->speed;
    return 0;
}
