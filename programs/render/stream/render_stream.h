/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What takes pictures in order: movies, raw frames on standard output, the contact sheet; on other ranks the message to
 * rank 0. Runs on a thread of the writer. */
#ifndef RENDER_STREAM_H
#define RENDER_STREAM_H

#include "render/stream/render_writer.h"

/* Begins the movies: 0, or -1 with the message printed. */
int render_stream_begin(render_writer *writer);

/* The thread: until the last picture, or a failure. */
void render_stream_run(render_writer *writer);

/* Ends the movies; those that were not begun are ignored. Returns 0, or -1 with the message printed. */
int render_stream_end(render_writer *writer, int keep);

/* Of render_writer.c: the next picture of this process in order, NULL where there is none; tells that it was taken; a
 * failure without a picture. */
writer_picture *render_writer_next_in_order(render_writer *writer);
void render_writer_streamed(render_writer *writer, writer_picture *picture, int failed, double ms);
void render_writer_fail(render_writer *writer);

#endif
