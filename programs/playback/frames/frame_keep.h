/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames that were read for a survey and are kept, within a bound of memory, so that their text is parsed once. While
 * one is looked at the next may be read. */
#ifndef FRAME_KEEP_H
#define FRAME_KEEP_H

#include <pthread.h>
#include <stddef.h>
#include <stdint.h>

#include "common/program.h"
#include "trajectory/trajectory_store.h"
#include <cgt/trajectory.h>

typedef struct kept_frame {
    cgt_trajectory_frame *clone; /* NULL: not kept */
    trajectory_store store;      /* its arrays of spheres, where the reader gave them away */
} kept_frame;

/* The next frame, while a thread reads it. */
typedef struct frame_ahead {
    int is_running; /* the thread, whose all below is; and the file, and the rest of what keeps frames */
    pthread_t thread;
    cgt_trajectory *file;
    cgt_trajectory_frame frame;
    int result; /* as frame_keep_read */
    char error[PROGRAM_ERROR_SIZE];
    double progress; /* of the file before: the caller's */
} frame_ahead;

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
    frame_ahead ahead;
} frame_keep;

/* Forgets all frames, and keeps those that are read from now on; at the file's begin. */
void frame_keep_begin(frame_keep *keep);

/* Keeps no more. is_whole: the file has ended, and will not grow. */
void frame_keep_end(frame_keep *keep, int is_whole);

/* Has a thread read the next frame, which will be asked for, where the one before is large and kept. Until one of the
 * calls below only this may be asked of the file: */
void frame_keep_ahead(frame_keep *keep, cgt_trajectory *file);
double frame_keep_progress(const frame_keep *keep, const cgt_trajectory *file); /* as cgt_trajectory_progress */

/* As cgt_trajectory_read, _skip and _rewind of the file, which nobody else moves. */
int frame_keep_read(frame_keep *keep, cgt_trajectory *file, cgt_trajectory_frame *frame, char *error,
                    size_t error_size);
int frame_keep_skip(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size);
int frame_keep_rewind(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size);

/* Whether the places and normals of a frame are those of the one that was read last, which is kept. */
int frame_keep_has(const frame_keep *keep, const cgt_trajectory_frame *frame);

/* Frees all frames. */
void frame_keep_release(frame_keep *keep);

#endif
