/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Writing behind: finished pictures wait in a ring. Threads encode and write them as files, several at once; one more
 * thread takes them in order, for movies, raw frames and the contact sheet. A place in the ring is free again when both
 * are done, in the order of the frames. */
#ifndef RENDER_WRITER_H
#define RENDER_WRITER_H

#include <pthread.h>
#include <stdint.h>

#include "common/stop_flag.h"
#include "picture/overlay/contact_sheet.h"
#include "picture/files/image_write.h"
#include "picture/files/movie.h"
#include "render/options/render_options.h"
#include "render/render_report.h"

enum { WRITER_MOST_THREADS = 8, WRITER_SPARE = 2 }; /* places beyond one for each thread: one drawn, one in order */

/* A frame whose pictures are written. */
typedef struct writer_done {
    frame_record record;
    int counted; /* counts are set */
    render_counts counts;
    cgt_scene_statistics scene;
} writer_done;

typedef struct writer_picture {
    uint64_t chosen;          /* which of the chosen frames */
    uint8_t *rgb;             /* sRGB */
    uint8_t *alpha;           /* NULL where pictures are opaque */
    cgt_linear_pixel *pixels; /* NULL without an .exr */
    writer_done done;
    int written, streamed, failed;
} writer_picture;

typedef struct render_writer {
    const render_options *options;
    int (*on_done)(void *user, const writer_done *done); /* for each frame, one at a time; not 0: failed */
    void *user;
    contact_sheet *sheet; /* NULL: none */
    const stop_flag *stop;
    uint32_t threads;      /* that trace; so many write, within limits */
    uint64_t first_chosen; /* of the run */
    const png_text *texts; /* of each picture; needed as long as the writer */
    size_t text_count;

    movie *movies[RENDER_MAX_OUTPUTS];
    uint32_t movies_made; /* bit i: output i is there; stays when the writer is finished */
    int has_files, has_stream;
    pthread_t thread[WRITER_MOST_THREADS + 1];
    uint32_t thread_count, file_threads;
    pthread_mutex_t lock; /* of all below */
    pthread_cond_t changed;
    writer_picture ring[WRITER_MOST_THREADS + WRITER_SPARE];
    uint32_t places;
    uint64_t submitted, writing, streaming, retired; /* counts; picture i lies at i % places */
    uint64_t done;                                   /* of the retired: without a failure */
    int retiring, closing, stream_over, failed, started;
} render_writer;

/* Makes buffers, begins movies, starts threads. options to text_count are set, the rest is zero. All functions return
 * 0, or -1 with the message printed. */
int render_writer_start(render_writer *writer);

/* Waits for a place for the next picture. Returns NULL where writing has failed. Its done is to be filled by the
 * caller. */
writer_picture *render_writer_begin(render_writer *writer);

/* Hands the picture over that render_writer_begin gave last. */
void render_writer_submit(render_writer *writer);

/* Frames that are done. */
uint64_t render_writer_count_done(render_writer *writer);

/* Waits until all is written. */
int render_writer_drain(render_writer *writer);

/* Ends movies (keep: they get their names, else they are removed) and frees everything, also where it was never
 * started. */
int render_writer_finish(render_writer *writer, int keep);

/* ---- What takes pictures in order, on a thread of its own (render_stream.c) ----
 * Movies, raw frames on standard output, the contact sheet. */

/* Begins the movies: 0, or -1 with the message printed. */
int render_stream_begin(render_writer *writer);

/* The thread: until the last picture, or a failure. */
void render_stream_run(render_writer *writer);

/* Ends the movies; those that were not begun are ignored. Returns 0, or -1 with the message printed. */
int render_stream_end(render_writer *writer, int keep);

/* Of render_writer.c: the next picture in order, NULL where there is none; tells that it was taken. */
writer_picture *render_writer_next_in_order(render_writer *writer);
void render_writer_streamed(render_writer *writer, writer_picture *picture, int failed, double ms);

#endif
