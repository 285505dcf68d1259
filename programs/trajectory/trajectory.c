/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trajectories: reading, and the arrays of a frame. Each format has a file of its own. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/atoms/trajectory_atoms.h"
#include "trajectory/trajectory_guess.h"
#include "trajectory/trajectory_internal.h"
#include "trajectory/atoms/trajectory_sites.h"
#include "trajectory/atoms/trajectory_topology.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- For the formats ---------------------------------------------------------------------------------------- */

int trajectory_line(cgt_trajectory *t, text_span *line)
{
    const char *reason = "";
    const int status = text_reader_next(&t->text, line, &reason);
    return status < 0 ? trajectory_fail(t, t->text.line, "%s", reason) : status;
}

int trajectory_line_inside(cgt_trajectory *t, text_span *line, const char *section)
{
    const int status = trajectory_line(t, line);
    return status == 0 ? trajectory_fail(t, t->text.line, "the file ends %s: it is cut off", section) : status;
}

int trajectory_parse_count(cgt_trajectory *t, text_span word, uint32_t *count)
{
    char quote[TEXT_QUOTE_SIZE];
    uint64_t value;
    if (!text_u64(word, UINT64_MAX, &value))
        return trajectory_fail(t, t->text.line, "'%s' is not a number of spheres", text_quote(word, quote));
    if (value > t->options.max_count)
        return trajectory_fail(t, t->text.line, "%" PRIu64 " spheres are more than the limit of %" PRIu64, value,
                               t->options.max_count);
    *count = (uint32_t)value;
    return 1;
}

int trajectory_grow(void *array, size_t capacity, size_t bytes)
{
    void *old;
    memcpy(&old, array, sizeof old);
    if (capacity > SIZE_MAX / bytes)
        return -1;
    void *const larger = realloc(old, capacity * bytes);
    if (larger == NULL)
        return -1;
    memcpy(array, &larger, sizeof larger);
    return 0;
}

static int reserve_columns(cgt_trajectory *t, size_t count)
{
    return columns_reserve(t, count) == 0
               ? 1
               : trajectory_fail(t, t->text.line, "not enough memory for the columns of %zu spheres", count);
}

int trajectory_reserve(cgt_trajectory *t, size_t count, size_t expected)
{
    trajectory_store *const s = &t->store;
    if (count <= s->capacity && s->capacity > 0)
        return reserve_columns(t, count);
    size_t capacity = s->capacity > SIZE_MAX / 2 ? SIZE_MAX : 2 * s->capacity;
    capacity = capacity < 4096 ? 4096 : capacity;
    capacity = capacity < s->given ? s->given : capacity;
    capacity = capacity > expected ? expected : capacity;
    capacity = capacity < count ? count : capacity;
    capacity = capacity == 0 ? 1 : capacity;
    if (trajectory_grow(&s->xyzr, capacity, 4 * sizeof *s->xyzr) || trajectory_grow(&s->id, capacity, sizeof *s->id) ||
        trajectory_grow(&s->type, capacity, sizeof *s->type) ||
        trajectory_grow(&s->velocity, capacity, 3 * sizeof *s->velocity) ||
        trajectory_grow(&s->element, capacity, sizeof *s->element) ||
        trajectory_grow(&s->residue, capacity, sizeof *s->residue) ||
        trajectory_grow(&s->site, capacity, sizeof *s->site) || trajectory_grow(&s->place, capacity, sizeof *s->place))
        return trajectory_fail(t, t->text.line, "not enough memory for %zu spheres", capacity);
    s->capacity = capacity;
    return reserve_columns(t, count);
}

size_t trajectory_can_give(const cgt_trajectory *t, const cgt_trajectory_frame *f)
{
    enum { LEAST = 1 << 16 }; /* spheres, whose copy takes some 1 ms */
    const size_t sphere = 4 * sizeof *f->xyzr + (f->id != NULL) * sizeof *f->id + (f->type != NULL) * sizeof *f->type +
                          (f->velocity != NULL) * 3 * sizeof *f->velocity + (f->element != NULL) * sizeof *f->element;
    const int is_full = t->store.capacity - f->count <= f->count / 8; /* arrays of the largest frame are a waste */
    return t->format->gives_arrays && f->count >= LEAST && is_full ? t->store.capacity * sphere : 0;
}

void trajectory_give(cgt_trajectory *t, const cgt_trajectory_frame *f, trajectory_store *to)
{
    trajectory_store *const s = &t->store;
    trajectory_store unused = *s;
    unused.xyzr = NULL;
    unused.id = f->id != NULL ? NULL : s->id;
    unused.type = f->type != NULL ? NULL : s->type;
    unused.velocity = f->velocity != NULL ? NULL : s->velocity;
    unused.element = f->element != NULL ? NULL : s->element;
    trajectory_store_free(&unused);
    *to = (trajectory_store){.xyzr = s->xyzr,
                             .id = f->id != NULL ? s->id : NULL,
                             .type = f->type != NULL ? s->type : NULL,
                             .velocity = f->velocity != NULL ? s->velocity : NULL,
                             .element = f->element != NULL ? s->element : NULL};
    t->store = (trajectory_store){.given = s->capacity};
}

void trajectory_store_free(trajectory_store *s)
{
    free(s->xyzr);
    free(s->id);
    free(s->type);
    free(s->velocity);
    free(s->element);
    free(s->residue);
    free(s->site);
    free(s->place);
}

int trajectory_text_place(const cgt_trajectory *t, size_t axis, text_span word, float *place)
{
    double value;
    if (t->origin[axis] == 0.0)
        return text_float(word, place);
    if (!text_double(word, &value))
        return 0;
    *place = trajectory_place(t, axis, value);
    return 1;
}

void trajectory_move(const cgt_trajectory *t, size_t axis, float *value, size_t stride, size_t count)
{
    for (size_t i = 0; i < count && t->has_origin; i++)
        value[stride * i] = trajectory_place(t, axis, (double)value[stride * i]);
}

float trajectory_default_radius(const cgt_trajectory *t)
{
    return t->options.radius > 0.0f ? t->options.radius : DEFAULT_RADIUS;
}

static void fill_frame(const cgt_trajectory *t, cgt_trajectory_frame *frame, cgt_trajectory_kind kind, uint32_t count)
{
    memset(frame, 0, sizeof *frame);
    frame->number = t->next;
    frame->kind = kind;
    frame->step = (int64_t)t->next;
    frame->count = count;
    for (int axis = 0; axis < 3; axis++) {
        frame->box_min[axis] = 1.0f;
        frame->box_max[axis] = -1.0f;
        frame->periodic[axis] = -1;
    }
    frame->time = NAN;
    frame->angstrom = t->format->unit > 0.0f ? t->format->unit : 1.0f;
}

void trajectory_frame_fill(cgt_trajectory *t, cgt_trajectory_frame *frame, uint32_t count)
{
    fill_frame(t, frame, CGT_TRAJECTORY_SPHERES, count);
    frame->xyzr = t->store.xyzr;
}

void trajectory_frame_fill_triangles(cgt_trajectory *t, cgt_trajectory_frame *frame, uint32_t count, uint32_t triangles)
{
    fill_frame(t, frame, CGT_TRAJECTORY_TRIANGLES, count);
    frame->triangles = triangles;
}

/* A bound beyond a float's range stays finite. */
static float clamp_to_float(double value)
{
    return value > (double)FLT_MAX ? FLT_MAX : value < -(double)FLT_MAX ? -FLT_MAX : (float)value;
}

void trajectory_frame_set_box(cgt_trajectory_frame *frame, const double origin[3], const double edge[3][3])
{
    float box_min[3], box_max[3];
    for (int axis = 0; axis < 3; axis++) {
        double low = origin[axis], high = origin[axis];
        for (int i = 0; i < 3; i++) {
            low += fmin(0.0, edge[i][axis]);
            high += fmax(0.0, edge[i][axis]);
            if (!isfinite(edge[i][axis]))
                return;
        }
        if (!isfinite(low) || !isfinite(high))
            return;
        box_min[axis] = clamp_to_float(low);
        box_max[axis] = clamp_to_float(high);
    }
    memcpy(frame->box_min, box_min, sizeof box_min);
    memcpy(frame->box_max, box_max, sizeof box_max);
    memcpy(frame->box_origin, origin, sizeof frame->box_origin);
    memcpy(frame->box_edge, edge, sizeof frame->box_edge);
}

void trajectory_take_origin(cgt_trajectory *t, const double origin[3])
{
    memcpy(t->origin, origin, sizeof t->origin);
    t->has_origin = origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0;
}

/* The box as it is seen from the origin. */
static void move_box(const cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    double origin[3], edge[3][3];
    memcpy(frame->origin, t->origin, sizeof frame->origin);
    if (!t->has_origin || frame->box_min[0] > frame->box_max[0])
        return;
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = frame->box_origin[axis] - t->origin[axis];
    memcpy(edge, frame->box_edge, sizeof edge);
    trajectory_frame_set_box(frame, origin, (const double(*)[3])edge);
}

const cgt_trajectory_mesh *cgt_trajectory_get_mesh(const cgt_trajectory *t)
{
    return t != NULL && t->is_open && t->format->mesh != NULL ? t->format->mesh(t) : NULL;
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

/* Reads or skips (frame NULL) in the files of the series, one after the other. */
static int next_frame(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    cgt_trajectory_frame unused;
    int status = -1;
    while (!t->failed) {
        columns_begin(t);
        atoms_begin(t);
        status = frame == NULL && t->format->skip != NULL ? t->format->skip(t)
                                                          : t->format->read(t, frame != NULL ? frame : &unused);
        if (status != 0 || t->path_at + 1 >= t->path_count)
            break;
        if (trajectory_open_file(t, t->path_at + 1) < 0)
            return -1;
    }
    return status;
}

/* Nothing is seen of spheres without a size, which LAMMPS has for points among others. */
static void tell_points(cgt_trajectory *t, const cgt_trajectory_frame *frame)
{
    uint32_t points = 0;
    for (size_t i = 0; i < frame->count && frame->kind == CGT_TRAJECTORY_SPHERES && frame->has_radius; i++)
        points += frame->xyzr[4 * i + 3] == 0.0f;
    if (points > 0)
        trajectory_warn(t, DOUBT_POINTS, 0,
                        "frame %" PRIu64 ": %" PRIu32 " of %" PRIu32
                        " spheres have a radius of 0: nothing is seen of them",
                        frame->number, points, frame->count);
}

cgt_result cgt_trajectory_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    if (t == NULL || frame == NULL)
        return t == NULL ? CGT_ERROR_OUT_OF_MEMORY : CGT_ERROR_INVALID_ARGUMENT;
    int status = next_frame(t, frame);
    if (status > 0) {
        move_box(t, frame);
        sites_finish(t, frame);
        tell_points(t, frame);
    }
    status = status > 0 && t->topology != NULL ? topology_complete(t, frame) : status;
    status = status > 0 ? bonds_complete(t, frame) : status;
    status = status > 0 ? columns_finish(t, frame) : status;
    status = status > 0 ? sites_leave_out(t, frame) : status;
    if (status > 0 && t->text.is_open)
        trajectory_warn_open(t, t->text.line);
    t->next += status > 0;
    return trajectory_result(t, status);
}

cgt_result cgt_trajectory_skip(cgt_trajectory *t)
{
    if (t == NULL)
        return CGT_ERROR_OUT_OF_MEMORY;
    const int status = next_frame(t, NULL);
    t->next += status > 0;
    return trajectory_result(t, status);
}

/* Makes the trajectory what it was when it was opened: what frames left behind, such as the numbers of names, may be
 * other than what reading up to there leaves, where columns were asked for since or a frame was damaged. */
static void forget_frames(cgt_trajectory *t)
{
    t->next = 0;
    t->failed = 0;
    t->guessed = 0;
    columns_forget_words(&t->columns);
    if (t->format->keeps_state)
        return;
    if (t->format->end != NULL)
        t->format->end(t);
    memset(t->state, 0, t->format->state_size);
}

static int rewind_file(cgt_trajectory *t)
{
    char reason[256];
    const int failed = t->failed;
    if (!trajectory_is_finite(t->options.origin))
        return trajectory_fail(t, 0, "the origin must be finite");
    if (t->path_at > 0) {
        forget_frames(t);
        return trajectory_open_file(t, 0);
    }
    if (trajectory_input_rewind(&t->input, reason, sizeof reason)) {
        trajectory_fail(t, 0, "%s", reason);
        t->failed = failed; /* reading may continue if it could before */
        return -1;
    }
    t->file = t->text.file = t->input.stream;
    text_reader_restart(&t->text);
    forget_frames(t);
    return t->format->begin(t);
}

cgt_result cgt_trajectory_rewind(cgt_trajectory *t)
{
    if (t == NULL)
        return CGT_ERROR_OUT_OF_MEMORY;
    return trajectory_result(t, t->is_open ? rewind_file(t) : -1);
}

void cgt_trajectory_set_origin(cgt_trajectory *t, const double origin[3])
{
    if (t == NULL)
        return;
    t->options.has_origin = true;
    memcpy(t->options.origin, origin, sizeof t->options.origin);
    trajectory_take_origin(t, origin);
}

void cgt_trajectory_get_origin(const cgt_trajectory *t, double origin[3])
{
    static const double none[3] = {0};
    memcpy(origin, t != NULL ? t->origin : none, sizeof none);
}

bool cgt_trajectory_can_rewind(const cgt_trajectory *t)
{
    return t != NULL && t->is_open && (t->path_at > 0 || t->input.can_rewind);
}

void cgt_trajectory_set_follow(cgt_trajectory *t, double seconds)
{
    if (t == NULL)
        return;
    t->options.follow = seconds > 0.0 ? seconds : 0.0;
    t->input.follow = t->path_at + 1 == t->path_count ? t->options.follow : 0.0;
}

cgt_result cgt_trajectory_count_frames(cgt_trajectory *t, uint64_t *frames)
{
    if (t != NULL && t->failed)
        return t->error;
    cgt_result result = cgt_trajectory_rewind(t);
    while (result == CGT_OK)
        result = cgt_trajectory_skip(t);
    if (result != CGT_END)
        return result;
    *frames = t->next;
    return cgt_trajectory_rewind(t);
}

double cgt_trajectory_progress(const cgt_trajectory *t)
{
    if (t == NULL || !t->is_open)
        return -1.0;
    if (t->format->progress != NULL)
        return t->format->progress(t);
    const double share = trajectory_input_progress(&t->input, t->text.end - t->text.begin);
    return share < 0.0 ? -1.0 : ((double)t->path_at + share) / (double)t->path_count;
}
