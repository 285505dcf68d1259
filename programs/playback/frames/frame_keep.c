/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames that are kept; see frame_keep.h. */
#include "playback/frames/frame_keep.h"
#include "data/frame_copy.h"
#include "trajectory/trajectory_status.h"

#include <stdlib.h>
#include <string.h>

void frame_keep_release(frame_keep *keep)
{
    for (uint64_t i = 0; i < keep->room; i++)
        free(keep->frame[i].clone);
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
    keep->is_keeping = 0;
    keep->is_whole = is_whole;
    keep->end = keep->next;
}

static const cgt_trajectory_frame *find(const frame_keep *keep)
{
    return keep->next < keep->room ? keep->frame[keep->next].clone : NULL;
}

/* Keeps a frame, as number keep->next. The first that finds no room is the last. */
static void add(frame_keep *keep, const cgt_trajectory_frame *frame)
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
    cgt_trajectory_frame *const clone = cgt_frame_clone(frame, &bytes);
    keep->is_keeping = clone && bytes <= keep->most - keep->bytes;
    if (keep->is_keeping) {
        keep->frame[at].clone = clone;
        keep->bytes += bytes;
    } else {
        free(clone);
    }
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

int frame_keep_read(frame_keep *keep, cgt_trajectory *file, cgt_trajectory_frame *frame, char *error, size_t error_size)
{
    const cgt_trajectory_frame *const kept = find(keep);
    int result = 1;
    if (kept) {
        *frame = *kept;
    } else {
        result = catch_up(keep, file, error, error_size);
        result = result == 1 ? trajectory_status(file, cgt_trajectory_read(file, frame), error, error_size) : result;
        keep->file_next += result == 1;
        if (result == 1 && keep->is_keeping)
            add(keep, frame);
    }
    keep->next += result == 1;
    return result;
}

int frame_keep_skip(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    int result = 1;
    if (!find(keep)) {
        result = catch_up(keep, file, error, error_size);
        result = result == 1 ? trajectory_status(file, cgt_trajectory_skip(file), error, error_size) : result;
        keep->file_next += result == 1;
    }
    keep->next += result == 1;
    return result;
}

int frame_keep_rewind(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    keep->next = keep->file_next = 0;
    return trajectory_failed(file, cgt_trajectory_rewind(file), error, error_size);
}
