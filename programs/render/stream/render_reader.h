/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reading ahead: a thread reads the chosen frames, finds speeds and colours, and keeps a copy of what drawing
 * takes, while the frame before is drawn. */
#ifndef RENDER_READER_H
#define RENDER_READER_H

#include <pthread.h>
#include <stdint.h>

#include "common/program.h"
#include "common/stop_flag.h"
#include "color/coloring.h"
#include "data/frame_copy.h"
#include "playback/frame_source.h"
#include "scene/figure_scene.h"

/* A frame that was read. */
typedef struct read_frame {
    frame_copy copy;
    uint64_t chosen;       /* which of the chosen frames */
    uint16_t *index;       /* as coloring.index */
    size_t index_capacity; /* as coloring.capacity */
    int per_vertex;        /* as coloring.per_vertex */
    frame_parts parts;     /* what is drawn of it */
    speed_source speed_from;
    double read_ms, color_ms;
    int busy; /* read, and not given back; under the reader's lock */
} read_frame;

/* Copies: one is drawn, the others wait; one more frame is inside the trajectory. Of large frames there is one copy,
 * since memory counts there, and the time of copying does not. */
enum { READ_AHEAD = 2, READ_LARGE = 1 << 23 /* bytes */ };

typedef struct render_reader {
    frame_source *source; /* the thread's own from start to finish */
    coloring coloring;    /* the thread's own; its index becomes the frame's when it is copied */
    frame_range range;
    uint64_t next, end; /* of the chosen frames: the thread's own; UINT64_MAX: where the input ends */
    const stop_flag *stop;
    const cgt_figure *figure; /* whose options say what is drawn */
    int (*check)(void *user,
                 const cgt_trajectory_frame *frame); /* of the first frame; not 0: refused, message printed */
    void *user;

    pthread_t thread;
    int has_thread;
    pthread_mutex_t lock; /* of all below */
    pthread_cond_t changed;
    read_frame frames[READ_AHEAD];
    uint64_t read, taken, given_back; /* counts */
    int place[READ_AHEAD];            /* where frame i lies, at i % READ_AHEAD */
    int ended, closing;
    int failed; /* after the frames that were read; error has the text, "" where it is printed */
    char error[PROGRAM_ERROR_SIZE];
} render_reader;

/* Starts the thread. source to user are set, the rest is zero; coloring's index is given to the reader. Returns 0, or
 * -1 with the message printed. */
int render_reader_start(render_reader *reader);

/* Waits for the next frame: 1, 0 after the last one, -1 on an error, whose message is printed. */
int render_reader_take(render_reader *reader, read_frame **frame);

/* The frame that was taken last is drawn; its arrays may be written. */
void render_reader_give_back(render_reader *reader);

/* Ends the thread and frees the memory, also where it was never started. */
void render_reader_finish(render_reader *reader);

#endif
