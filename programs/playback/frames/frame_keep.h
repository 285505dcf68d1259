/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames that were read for a survey and are kept, within a bound of memory, so that their text is parsed once. */
#ifndef FRAME_KEEP_H
#define FRAME_KEEP_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/trajectory.h>

typedef struct kept_frame {
    cgt_trajectory_frame *clone; /* NULL: not kept */
} kept_frame;

/* All zero: nothing is kept. */
typedef struct frame_keep {
    size_t most;    /* bytes that frames may take; the caller's */
    int is_keeping; /* what is read now is kept, while there is room */
    int is_whole;   /* the file ends before `end` */
    uint64_t end;
    uint64_t next, file_next; /* numbers of the next frames: of the run, and of the file, which may be behind */
    kept_frame *frame;        /* by number */
    uint64_t room;
    size_t bytes;
} frame_keep;

/* Forgets all frames, and keeps those that are read from now on; at the file's begin. */
void frame_keep_begin(frame_keep *keep);

/* Keeps no more. is_whole: the file has ended, and will not grow. */
void frame_keep_end(frame_keep *keep, int is_whole);

/* As cgt_trajectory_read, _skip and _rewind of the file, which nobody else moves. */
int frame_keep_read(frame_keep *keep, cgt_trajectory *file, cgt_trajectory_frame *frame, char *error,
                    size_t error_size);
int frame_keep_skip(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size);
int frame_keep_rewind(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size);

/* Frees all frames. */
void frame_keep_release(frame_keep *keep);

#endif
