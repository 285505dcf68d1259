/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames that are kept; see frame_keep.h. */
#define _POSIX_C_SOURCE 200809L
#include "playback/frames/frame_keep.h"
#include "data/frame_copy.h"
#include "trajectory/trajectory_status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Waits for the thread. Returns whether there was one. */
static int end_ahead(frame_keep *keep)
{
    const int was_running = keep->ahead.is_running;
    if (was_running)
        pthread_join(keep->ahead.thread, NULL);
    keep->ahead.is_running = 0;
    return was_running;
}

void frame_keep_release(frame_keep *keep)
{
    end_ahead(keep);
    for (uint64_t i = 0; i < keep->room; i++) {
        free(keep->frame[i].clone);
        trajectory_store_free(&keep->frame[i].store);
    }
    free(keep->frame);
    *keep = (frame_keep){.most = keep->most};
}

void frame_keep_begin(frame_keep *keep)
{
    frame_keep_release(keep);
    keep->is_keeping = keep->most > 0;
}

void frame_keep_end(frame_keep *keep, int is_whole)
{
    end_ahead(keep);
    keep->is_keeping = 0;
    keep->is_whole = is_whole;
    keep->end = keep->next;
}

static const cgt_trajectory_frame *find(const frame_keep *keep, uint64_t number)
{
    return number < keep->room ? keep->frame[number].clone : NULL;
}

int frame_keep_has(const frame_keep *keep, const cgt_trajectory_frame *frame)
{
    const cgt_trajectory_frame *const last = find(keep, keep->next - 1);
    return last && frame->xyzr == last->xyzr && frame->position == last->position &&
           frame->vertex_normal == last->vertex_normal;
}

/* Makes the arrays of a frame those of another that can be given away. */
static void set_spheres(cgt_trajectory_frame *frame, const cgt_trajectory_frame *from)
{
    frame->xyzr = from->xyzr;
    frame->id = from->id;
    frame->type = from->type;
    frame->velocity = from->velocity;
    frame->element = from->element;
}

/* Keeps a frame that was read, as number keep->next; it is the kept one then. The first that finds no room is the
 * last. */
static void add(frame_keep *keep, cgt_trajectory *file, cgt_trajectory_frame *frame)
{
    const uint64_t at = keep->next;
    size_t bytes;
    if (at >= keep->room) {
        const uint64_t room = at + at / 2 + 64;
        kept_frame *const more = realloc(keep->frame, room * sizeof *more);
        keep->is_keeping = more != NULL;
        if (!more)
            return;
        memset(more + keep->room, 0, (room - keep->room) * sizeof *more);
        keep->frame = more;
        keep->room = room;
    }
    const size_t given = trajectory_can_give(file, frame);
    cgt_trajectory_frame rest = *frame;
    if (given)
        set_spheres(&rest, &(const cgt_trajectory_frame){.count = 0});
    cgt_trajectory_frame *const clone = cgt_frame_clone(&rest, &bytes);
    keep->is_keeping = clone && given <= keep->most - keep->bytes && bytes <= keep->most - keep->bytes - given;
    if (!keep->is_keeping) {
        free(clone);
        return;
    }
    if (given) {
        trajectory_give(file, frame, &keep->frame[at].store);
        set_spheres(clone, frame);
    }
    keep->frame[at].clone = clone;
    keep->bytes += given + bytes;
    *frame = *clone;
}

/* Moves the file to the run's next frame. Returns 1, 0 where it ends before, or -1 with a text. */
static int catch_up(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    int result = keep->is_whole && keep->next >= keep->end ? 0 : 1;
    while (result == 1 && keep->file_next < keep->next) {
        result = trajectory_status(file, cgt_trajectory_skip(file), error, error_size);
        keep->file_next += result == 1;
    }
    return result;
}

static int read_next(frame_keep *keep, cgt_trajectory *file, cgt_trajectory_frame *frame, char *error,
                     size_t error_size)
{
    int result = catch_up(keep, file, error, error_size);
    result = result == 1 ? trajectory_status(file, cgt_trajectory_read(file, frame), error, error_size) : result;
    keep->file_next += result == 1;
    if (result == 1 && keep->is_keeping)
        add(keep, file, frame);
    return result;
}

static void *read_ahead(void *user)
{
    frame_keep *const keep = user;
    frame_ahead *const a = &keep->ahead;
    a->result = read_next(keep, a->file, &a->frame, a->error, sizeof a->error);
    return NULL;
}

void frame_keep_ahead(frame_keep *keep, cgt_trajectory *file)
{
    enum { LEAST = 1 << 16 }; /* spheres, which take some 2 ms; starting a thread takes some 50 us */
    const cgt_trajectory_frame *const last = find(keep, keep->next - 1);
    if (!keep->is_keeping || keep->ahead.is_running || !last || last->count < LEAST)
        return;
    keep->ahead.file = file;
    keep->ahead.progress = cgt_trajectory_progress(file);
    keep->ahead.is_running = pthread_create(&keep->ahead.thread, NULL, read_ahead, keep) == 0;
}

double frame_keep_progress(const frame_keep *keep, const cgt_trajectory *file)
{
    return keep->ahead.is_running ? keep->ahead.progress : cgt_trajectory_progress(file);
}

int frame_keep_read(frame_keep *keep, cgt_trajectory *file, cgt_trajectory_frame *frame, char *error, size_t error_size)
{
    const int is_ahead = end_ahead(keep);
    const cgt_trajectory_frame *const kept = find(keep, keep->next);
    int result = 1;
    if (is_ahead) {
        result = keep->ahead.result;
        *frame = keep->ahead.frame;
        if (result < 0)
            snprintf(error, error_size, "%s", keep->ahead.error);
    } else if (kept) {
        *frame = *kept;
    } else {
        result = read_next(keep, file, frame, error, error_size);
    }
    keep->next += result == 1;
    return result;
}

int frame_keep_skip(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    cgt_trajectory_frame unused;
    int result = 1;
    if (keep->ahead.is_running)
        return frame_keep_read(keep, file, &unused, error, error_size);
    if (!find(keep, keep->next)) {
        result = catch_up(keep, file, error, error_size);
        result = result == 1 ? trajectory_status(file, cgt_trajectory_skip(file), error, error_size) : result;
        keep->file_next += result == 1;
    }
    keep->next += result == 1;
    return result;
}

int frame_keep_rewind(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    end_ahead(keep);
    keep->next = keep->file_next = 0;
    return trajectory_failed(file, cgt_trajectory_rewind(file), error, error_size);
}
