/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The state of a run of cgt-render, and its set-up before the first frame. */
#ifndef RENDER_SETUP_H
#define RENDER_SETUP_H

#include <stdint.h>
#include <stdio.h>

#include <cgt/cgt.h>

#include "common/stop_flag.h"
#include "picture/overlay/contact_sheet.h"
#include "playback/figure_run.h"
#include "common/program.h"
#include "picture/files/image_write.h"
#include "figure_state.h"
#include "render/options/render_options.h"
#include "render/stream/render_reader.h"
#include "render/render_report.h"
#include "render/stream/render_writer.h"

typedef struct render_cell render_cell;

typedef struct renderer {
    render_options options; /* as they were given; those that count are figure.options */
    const stop_flag *stop;  /* not 0: a signal has come */
    frame_source source;    /* the reader's, once it has started */
    cgt_figure *figure;     /* its sequence is the reader's, once it has started */
    survey_walk survey;     /* what is known of the input */
    uint64_t begin, count;  /* of the chosen frames: the first one of this run, how many; count UINT64_MAX: unknown */
    png_text texts[4];      /* what pictures say of themselves */
    size_t text_count;
    char *settings;       /* of the command line and the camera, among the texts */
    contact_sheet *sheet; /* NULL: none */
    cgt_context *context;
    render_cell *cell; /* --cell: traces in place of the library; else NULL */
    render_reader reader;
    render_writer writer;
    render_report report;               /* the writer's threads add to it until they have ended */
    int failed;                         /* in a frame: no movie is kept */
    uint64_t first_number, last_number; /* in the input, of frames that are done */
    program_progress progress;
    FILE *summary; /* standard output, or standard error where frames go to standard output */
    char error[PROGRAM_ERROR_SIZE];
} renderer;

/* Prints an error, the text in r->error, and returns -1. */
int render_fail(renderer *r);

/* After a call of the figure, in the thread that called: prints its notices and, where the result is not 0, its
 * message. Returns the result. */
int render_result(renderer *r, int result);

/* Opens the input and surveys it if necessary, chooses colours and camera, makes folders, buffers and an empty scene,
 * and starts the threads that read and write. options, stop, writer.on_done and writer.user are set, the rest is zero.
 * Returns 0, or -1 with the message printed. */
int render_setup(renderer *r);

/* Frees what render_setup made, also after a failure. The writer is finished before. */
void render_close(renderer *r);

/* Makes figure.drawing with what lies over it, and what pictures say of themselves. Returns 0, or -1 with the message
 * printed. */
int render_picture_setup(renderer *r);

/* ---- An emulated Cell (render_cell.c) ----
 * The SPEs find which sphere each ray hits, the PPE t and normal of it, and the usual shading makes the picture, byte
 * for byte the one that the library's own frames give. */

/* Makes the Cell of --cell, and reads the SPEs' program. Sets r->cell. Returns 0, or -1 with the message printed. */
int render_cell_create(renderer *r);

/* Traces and shades a frame of r->camera: building the grid is the SPEs' work, a part of it.
 * Returns 0, -1 with the message printed, 1 where a signal stopped the frame. */
int render_cell_frame(renderer *r, frame_record *record);

/* Prints what the frames took: cycles, waits, DMA, messages, doubts. NULL prints nothing. */
void render_cell_print(const render_cell *cell, FILE *to);

void render_cell_release(render_cell *cell); /* NULL does nothing */

#endif
