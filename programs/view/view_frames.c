/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames in any order; see view_frames.h. */
#define _POSIX_C_SOURCE 200809L
#include "view/view_frames.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "common/program.h"
#include "trajectory/trajectory_status.h"

typedef struct view_slot {
    view_frame *frame; /* NULL: it is not there */
} view_slot;

struct view_frames {
    view_frames_options options;
    frame_source source; /* of the thread that reads, as the next */
    cgt_trajectory_options reading;
    pthread_t reader, counter;
    int has_reader, has_counter;
    uint64_t lead;        /* frames before one that it needs */
    int has_trails;       /* those of the frame that was read last */
    pthread_mutex_t lock; /* of all below */
    pthread_cond_t changed;
    view_slot *at; /* by number among the chosen */
    uint64_t room;
    uint64_t low, high; /* what is there lies in [low, high) */
    uint64_t wanted;
    uint64_t count; /* known */
    uint64_t end;   /* no frame from here on can be read; UINT64_MAX: not known */
    uint64_t last;  /* that was read */
    uint64_t reading_at;
    int is_reading, is_counted, closing;
    size_t bytes;
    char error[PROGRAM_ERROR_SIZE];
};

static void free_frame(view_frame *f)
{
    if (f)
        cgt_figure_frame_release(f->kept);
    free(f);
}

/* ---- What is kept ------------------------------------------------------------------------------------------- */

/* A frame that may be drawn: trails are those of the frame that was read last. */
static view_frame *find(const view_frames *f, uint64_t chosen)
{
    const int is_there = chosen < f->room && (!f->has_trails || f->last == chosen);
    return is_there ? f->at[chosen].frame : NULL;
}

static void drop(view_frames *f, uint64_t chosen)
{
    f->bytes -= f->at[chosen].frame->bytes;
    free_frame(f->at[chosen].frame);
    f->at[chosen].frame = NULL;
}

/* Makes room for `bytes` more by the frames that are farthest from the one that is wanted; those before it go first.
 * Frames between it and `reads`, the one to be read, stay. Returns whether there is room. */
static int make_room(view_frames *f, size_t bytes, uint64_t reads)
{
    while (f->low < f->high && !f->at[f->low].frame)
        f->low++;
    while (f->high > f->low && !f->at[f->high - 1].frame)
        f->high--;
    uint64_t low = f->low, high = f->high;
    while (f->bytes + bytes > f->options.memory && low < high) {
        if (low < f->wanted) {
            if (f->at[low].frame && !f->at[low].frame->pins)
                drop(f, low);
            low++;
        } else if (high - 1 > reads) {
            if (f->at[high - 1].frame && !f->at[high - 1].frame->pins)
                drop(f, high - 1);
            high--;
        } else {
            return 0;
        }
    }
    return f->bytes + bytes <= f->options.memory;
}

static int keep(view_frames *f, view_frame *frame)
{
    const uint64_t at = frame->chosen;
    if (at >= f->room) {
        const uint64_t room = at + at / 2 + 64;
        view_slot *more = realloc(f->at, room * sizeof *more);
        if (!more)
            return -1;
        memset(more + f->room, 0, (room - f->room) * sizeof *more);
        f->at = more;
        f->room = room;
    }
    if (f->at[at].frame == NULL) {
        f->at[at].frame = frame;
        f->bytes += frame->bytes;
    } else {
        free_frame(frame);
    }
    f->low = f->low < f->high && f->low < at ? f->low : at;
    f->high = f->high > at + 1 ? f->high : at + 1;
    return 0;
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

/* The next frame to read: the one that is wanted, or what follows it, but with trails. Returns 0 where there is nothing
 * to do. */
static int choose_next(view_frames *f, uint64_t *next)
{
    uint64_t k = f->wanted;
    size_t bytes = 0;
    if (k >= f->end)
        return 0;
    if (!find(f, k)) {
        *next = k;
        return 1;
    }
    bytes = f->at[k].frame->bytes;
    while (k < f->end && find(f, k))
        k++;
    if (f->has_trails || k >= f->end || !make_room(f, bytes, k))
        return 0;
    *next = k;
    return 1;
}

static int read_frame(view_frames *f, uint64_t chosen, view_frame **frame, char *error, size_t size)
{
    const uint64_t number = f->options.range.first + chosen * f->options.range.every;
    view_frame *const read = calloc(1, sizeof *read);
    cgt_figure_frame *kept = NULL;
    const int result = figure_run_keep(f->options.figure, &f->source, f->lead, number, &kept, error, size);
    if (result != 1 || !read) {
        if (!read)
            snprintf(error, size, "out of memory for frame %llu", (unsigned long long)number);
        cgt_figure_frame_release(kept);
        free(read);
        return result == 1 ? -1 : result;
    }
    *read = (view_frame){.frame = *cgt_figure_frame_get_data(kept),
                         .kept = kept,
                         .chosen = chosen,
                         .lead = f->lead,
                         .bytes = sizeof *read + cgt_figure_frame_get_bytes(kept)};
    *frame = read;
    return 1;
}

static void *read_frames(void *user)
{
    view_frames *const f = user;
    char error[PROGRAM_ERROR_SIZE] = "";
    uint64_t next;
    f->source.looks_ahead = 1;
    pthread_mutex_lock(&f->lock);
    while (!f->closing) {
        view_frame *frame = NULL;
        if (!choose_next(f, &next)) {
            pthread_cond_wait(&f->changed, &f->lock);
            continue;
        }
        f->is_reading = 1;
        f->reading_at = next;
        pthread_mutex_unlock(&f->lock);
        const int result = read_frame(f, next, &frame, error, sizeof error);
        pthread_mutex_lock(&f->lock);
        f->is_reading = 0;
        if (result == 1) {
            f->last = next;
            make_room(f, frame->bytes, next);
            if (keep(f, frame))
                free_frame(frame);
            f->count = f->count > next + 1 ? f->count : next + 1;
        } else if (!f->closing) { /* no frame follows */
            f->end = f->end < next ? f->end : next;
            f->count = f->end;
            f->is_counted = 1;
            if (result < 0)
                memcpy(f->error, error, sizeof f->error);
        }
        pthread_mutex_unlock(&f->lock);
        f->options.wake(f->options.user);
        pthread_mutex_lock(&f->lock);
    }
    pthread_mutex_unlock(&f->lock);
    return NULL;
}

/* ---- Counting ----------------------------------------------------------------------------------------------- */

static void *count_frames(void *user)
{
    view_frames *const f = user;
    cgt_trajectory *file;
    uint64_t frames = 0;
    cgt_result result = cgt_trajectory_open_series(f->options.paths, f->options.path_count, &f->reading, &file);
    int closing = 0;
    while (result == CGT_OK && !closing) {
        result = cgt_trajectory_skip(file);
        frames += result == CGT_OK;
        if (result != CGT_OK || frames % 64 == 0) {
            const uint64_t chosen = frame_range_count(&f->options.range, frames);
            pthread_mutex_lock(&f->lock);
            f->count = f->count > chosen ? f->count : chosen;
            f->is_counted |= result == CGT_END;
            if (result == CGT_END && !(f->options.reading->follow > 0.0) && chosen < f->end)
                f->end = chosen;
            closing = f->closing;
            pthread_mutex_unlock(&f->lock);
            f->options.wake(f->options.user);
        }
    }
    cgt_trajectory_close(file);
    return NULL;
}

/* What can be opened twice. */
static int are_files(const view_frames_options *o)
{
    struct stat info;
    for (size_t i = 0; i < o->path_count; i++)
        if (stat(o->paths[i], &info) || !S_ISREG(info.st_mode))
            return 0;
    return 1;
}

/* ---- Interface ---------------------------------------------------------------------------------------------- */

view_frames *view_frames_start(frame_source *source, const view_frames_options *options)
{
    view_frames *const f = calloc(1, sizeof *f);
    if (!f) {
        program_error("out of memory");
        frame_source_close(source);
        return NULL;
    }
    f->options = *options;
    f->source = *source;
    memset(source, 0, sizeof *source);
    f->has_trails = cgt_figure_get(options->figure, "trails", NULL, 0) > 0;
    f->reading = *options->reading;
    f->reading.follow = 0.0;
    f->end = options->range.last == UINT64_MAX - 1 ? UINT64_MAX : frame_range_count(&options->range, UINT64_MAX);
    if (options->total) {
        f->count = frame_range_count(&options->range, options->total);
        f->is_counted = 1;
    }
    pthread_mutex_init(&f->lock, NULL);
    pthread_cond_init(&f->changed, NULL);
    const int counts = !f->is_counted && are_files(options);
    f->has_reader = cgt_figure_begin_keep(options->figure, &f->lead) == CGT_OK &&
                    pthread_create(&f->reader, NULL, read_frames, f) == 0;
    if (!f->has_reader) {
        program_error("cannot start a thread that reads");
        view_frames_finish(f);
        return NULL;
    }
    f->has_counter = counts && pthread_create(&f->counter, NULL, count_frames, f) == 0;
    return f;
}

view_frame *view_frames_take(view_frames *f, uint64_t chosen)
{
    pthread_mutex_lock(&f->lock);
    f->wanted = chosen;
    view_frame *const frame = find(f, chosen);
    if (frame)
        frame->pins++;
    pthread_cond_broadcast(&f->changed);
    pthread_mutex_unlock(&f->lock);
    return frame;
}

void view_frames_release(view_frames *f, view_frame *frame)
{
    if (!frame)
        return;
    pthread_mutex_lock(&f->lock);
    frame->pins--;
    pthread_mutex_unlock(&f->lock);
}

void view_frames_get(view_frames *f, view_frames_state *state)
{
    pthread_mutex_lock(&f->lock);
    *state = (view_frames_state){.count = f->count < f->end ? f->count : f->end,
                                 .is_final = f->is_counted,
                                 .reading = f->reading_at,
                                 .is_reading = f->is_reading,
                                 .bytes = f->bytes};
    memcpy(state->error, f->error, sizeof state->error);
    pthread_mutex_unlock(&f->lock);
}

int view_frames_has(view_frames *f, uint64_t chosen)
{
    pthread_mutex_lock(&f->lock);
    const int has = find(f, chosen) != NULL;
    pthread_mutex_unlock(&f->lock);
    return has;
}

void view_frames_finish(view_frames *f)
{
    if (!f)
        return;
    pthread_mutex_lock(&f->lock);
    f->closing = 1;
    pthread_cond_broadcast(&f->changed);
    pthread_mutex_unlock(&f->lock);
    if (f->has_reader)
        pthread_join(f->reader, NULL);
    if (f->has_counter)
        pthread_join(f->counter, NULL);
    for (uint64_t i = 0; i < f->room; i++)
        free_frame(f->at[i].frame);
    free(f->at);
    frame_source_close(&f->source);
    free(f);
}
