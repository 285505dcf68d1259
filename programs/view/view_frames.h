/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run in any order: a thread reads what is wanted and then what follows, and what was read is kept
 * within a bound of memory. A second thread counts the frames. */
#ifndef VIEW_FRAMES_H
#define VIEW_FRAMES_H

#include <stddef.h>
#include <stdint.h>

#include "playback/figure_run.h"

typedef struct view_frame {
    cgt_trajectory_frame frame; /* with the arrays of: */
    cgt_figure_frame *kept;     /* for the figure */
    uint64_t chosen;            /* which of the chosen frames */
    uint64_t lead;              /* frames of the file before it that belong to its picture */
    size_t bytes;
    int pins;
} view_frame;

typedef struct view_frames view_frames;

typedef struct view_frames_options {
    cgt_figure *figure;       /* that keeps the frames, after its survey; in a thread of its own */
    const char *const *paths; /* of the run, and how they are read: for the count */
    size_t path_count;
    const cgt_trajectory_options *reading; /* lives as long as the frames */
    frame_range range;
    size_t memory;            /* bytes */
    uint64_t total;           /* frames of the file; 0: unknown */
    void (*wake)(void *user); /* something has changed; any thread */
    void *user;
} view_frames_options;

/* Takes the source over, which is open, at its first frame, and reads all columns. Returns NULL with the message
 * printed. */
view_frames *view_frames_start(frame_source *source, const view_frames_options *options);

/* Says which frame is wanted, and gives it where it is there, until view_frames_release; else NULL. */
view_frame *view_frames_take(view_frames *f, uint64_t chosen);
void view_frames_release(view_frames *f, view_frame *frame);

/* What is known of the run. */
typedef struct view_frames_state {
    uint64_t count;   /* chosen frames known so far */
    int is_final;     /* there are no more */
    uint64_t reading; /* the frame that is read, where is_reading */
    int is_reading;
    size_t bytes;
    char error[1024]; /* why no frame follows; "": none */
} view_frames_state;
void view_frames_get(view_frames *f, view_frames_state *state);

/* Whether a frame is in memory. */
int view_frames_has(view_frames *f, uint64_t chosen);

/* Waits for both threads: the stop of the source's options is to end a read that waits for more of a run. */
void view_frames_finish(view_frames *f);

#endif
