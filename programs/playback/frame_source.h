/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run: those selected from a trajectory, for a sequence that finds what belongs to them. */
#ifndef FRAME_SOURCE_H
#define FRAME_SOURCE_H

#include <stddef.h>
#include <stdint.h>

#include "sequence/frame_sequence.h"
#include "playback/frames/frame_keep.h"
#include <cgt/trajectory.h>

/* Every `every`th frame from first to last, both included, counted from 0. */
typedef struct frame_range {
    uint64_t first, last, every;
} frame_range;

/* How many frames a range chooses of the first `total`. */
uint64_t frame_range_count(const frame_range *range, uint64_t total);

typedef struct frame_source {
    cgt_trajectory *file;
    frame_sequence *sequence; /* that takes each frame; the caller's */
    int follows;              /* more may come at its end */
    int has_radii;            /* --radius: those of frames are no longer a format's */
    frame_keep keep;          /* frames of the survey; keep.most is the caller's */
    int looks_ahead; /* the first frame has the speeds towards the second, where the input can be read again; the
                                 caller's, set once a survey is done */
    uint64_t next;   /* number of the file's next frame */
} frame_source;

/* Opens a file, or the files of a run in their order, whose frames the sequence will take. Returns 0, or -1 with a
 * text. */
int frame_source_open(frame_source *source, frame_sequence *sequence, const char *const *paths, size_t count,
                      const cgt_trajectory_options *options, char *error, size_t error_size);

/* Has the columns read that the sequence asks for. Returns 0, or -1 with a text. */
int frame_source_want_columns(frame_source *source, char *error, size_t error_size);

/* Reads the frame `number`, at least source->next. Those before it are skipped unread, unless the speeds of this one
 * need the positions of the one before, or its trails those of several. Returns 1, 0 where the file ends before, or -1
 * with a text. */
int frame_source_read(frame_source *source, uint64_t number, char *error, size_t error_size);

/* Goes back to the start: 0, or -1 with a text. */
int frame_source_rewind(frame_source *source, char *error, size_t error_size);

/* Frees everything but the sequence. A source that was never opened is all zero and may be closed. */
void frame_source_close(frame_source *source);

#endif
