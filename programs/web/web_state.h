/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the parts of the page's engine share. */
#ifndef WEB_STATE_H
#define WEB_STATE_H

#include <stdint.h>

#include <cgt/figure.h>

#include "playback/figure_run.h"

enum { WEB_FILES_MOST = 10000 };

/* The files that are open. */
typedef struct web_files {
    char *names; /* with ends of strings between them; those of the run, in its order, come first */
    const char *run[WEB_FILES_MOST];
    uint32_t count;
    const char *topology, *mesh; /* NULL: none */
} web_files;

typedef struct web_state {
    cgt_context *context;
    cgt_figure *figure;
    frame_source file;
    frame_sequence raw; /* its frames as they are */
    uint64_t lead, frames;
    cgt_figure_frame *shown; /* NULL: no file is open */
    cgt_camera camera;       /* of the hand */
    cgt_camera chosen;       /* the one with which it began */
    uint32_t width, height;
    uint8_t *pixels;
    char message[1024];
    char doubt[1100]; /* why the file's frames end too early, or options are left out, until it is told; "": nothing */
    char *options, *columns, *values, *told, *lines; /* of the last calls that tell them */
    web_files files, given;                          /* as they are here, and as their user names them */
} web_state;

/* The one that the page has. */
extern web_state web;

/* Sets the message and returns -1. */
int web_fail(const char *text);

/* The same with the figure's message where a call has failed, else 0. */
int web_check(cgt_result result);

/* Takes settings, lines "name = value", in place of all that are set, and reads the files anew. A camera that the hand
 * has moved stays unless they have one. What is refused changes nothing. Returns 0, or -1. */
int web_take(const char *settings);

/* How files are read; where places begin: 0 where that is the file's own origin; and what is shown. */
cgt_trajectory_options web_reading(void);
int web_get_origin(double origin[3]);
int web_has_triangles(void);
uint32_t web_frame(void);

/* web_ask.c: what was picked, and what is followed, is found in a frame that is shown from now on; ends with a run. */
void web_take_frame(void);
void web_forget_run(void);

#endif
