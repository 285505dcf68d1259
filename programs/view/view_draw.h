/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The viewer's input and figure: from the command line to the first frame, and the command line that makes a picture.
 * All that is drawn is <cgt/figure.h>'s. Functions that return an int give 0, or -1 with the message printed by
 * program_error. */
#ifndef VIEW_DRAW_H
#define VIEW_DRAW_H

#include <cgt/figure.h>

#include "common/stop_flag.h"
#include "view/view_frames.h"
#include "view/view_options.h"

typedef struct view_draw {
    render_options options;
    cgt_context *context;
    cgt_figure *figure;
    frame_source source; /* until the frames are started */
    frame_sequence raw;  /* its frames as they are */
    cgt_trajectory *mesh;
    survey_walk survey;
    int has_moved; /* an origin was chosen, */
    double origin[3];
    char *shows; /* the conditions of the command line, a line each */
    stop_flag stop;
} view_draw;

/* Takes options->render over. Returns NULL with the message printed. */
view_draw *view_draw_create(const view_options *options);

/* Opens the input, and finds colours and camera; in any thread. */
int view_draw_open(view_draw *d);

/* Ends the opening, and a read that waits for more of a run; then, after both and the frames, all. NULL is ignored. */
void view_draw_stop(view_draw *d);
void view_draw_close(view_draw *d);

/* What the thread that reads frames takes over; once. */
view_frames *view_draw_start_frames(view_draw *d, size_t memory, void (*wake)(void *user), void *user);

/* After a call of the figure: prints what it tells. Returns 0, 1 where it was stopped, -1. */
int view_draw_tell(view_draw *d, cgt_result result);

/* A value of the figure, as cgt_figure_get or _get_chosen copies it; NULL with the message printed. */
typedef size_t view_draw_getter(const cgt_figure *figure, const char *name, char *text, size_t size);
char *view_draw_get(const view_draw *d, view_draw_getter *get, const char *name);

/* Whether an option is set. */
int view_draw_has(const view_draw *d, const char *name);

/* The settings of the shown frame's picture, as a settings file has them. The caller frees them; NULL with the message
 * printed. */
char *view_draw_settings(const view_draw *d);

/* view_command.c: the command line of cgt-render, and Python, that make a frame's picture. The caller frees them; NULL
 * with the message printed. */
char *view_command(const view_draw *d, const char *settings, const view_frame *frame, const char *pattern);
char *view_command_python(const view_draw *d, const char *settings, const view_frame *frame);

/* Draws and writes that picture to `path`, which the pattern names. */
int view_draw_write(view_draw *d, const char *settings, const char *path);

#endif
