/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cgt-view has of cgt-render: from the options and a frame to pictures, the same bytes at rest. Quick pictures
 * leave out soft light, and are smaller where they must be. One thread at a time uses a view_draw. Functions that
 * return an int give 0, or -1 with the message printed by program_error. */
#ifndef VIEW_DRAW_H
#define VIEW_DRAW_H

#include <stdio.h>

#include "common/stop_flag.h"
#include "view/view_frames.h"
#include "view/view_options.h"

typedef struct view_draw view_draw;

typedef enum view_quality {
    VIEW_PLAIN,   /* no shadows, no occlusion */
    VIEW_SHADOWS, /* hard shadows */
    VIEW_FULL     /* as cgt-render */
} view_quality;

/* Opens the input, and finds colours and camera. Takes options->render over. Returns NULL with the message printed. */
view_draw *view_draw_open(const view_options *options);

/* Ends a read that waits for more of a run; then the scene, which uses a frame's arrays; then the rest. NULL is
 * ignored. */
void view_draw_stop(view_draw *d);
void view_draw_close_scene(view_draw *d);
void view_draw_close(view_draw *d);

/* What the thread that reads frames takes over; once. */
view_frames *view_draw_start_frames(view_draw *d, size_t memory, void (*wake)(void *user), void *user);

/* The options, of which the caller changes picture.ortho alone. */
figure_options *view_draw_options(view_draw *d);

/* The camera that the options or the survey give, perspective, less the origin; and the axis that points up. */
void view_draw_first_camera(const view_draw *d, cgt_camera *camera, float up[3]);

/* The size of pictures: 1 or more pixels each. */
int view_draw_resize(view_draw *d, uint32_t width, uint32_t height);

/* Makes a frame the one that is drawn: its arrays are used in place until the next call. camera: by which lines get
 * their least thickness. */
int view_draw_set_frame(view_draw *d, const view_frame *frame, const cgt_camera *camera);

/* Whether what is drawn depends on the camera, and a picture as cgt-render's needs the call above anew. */
int view_draw_follows_camera(const view_draw *d);

/* Draws the frame: rgb gets 3 * width * height bytes. shrink: one ray for so many pixels along each edge; 1 but for
 * VIEW_PLAIN. stop: other than 0 ends it. Returns 0, 1 where it was stopped, -1. */
int view_draw_picture(view_draw *d, const cgt_camera *camera, view_quality quality, uint32_t shrink, uint8_t *rgb,
                      const stop_flag *stop);

/* The same of VIEW_FULL in steps: begins, then adds a ray to the sky and to each soft light from each of the camera's
 * hits, then as many as there are. rgb gets the picture so far. left: steps that are
 * left; 0: it is complete. After 1 it begins anew. */
int view_draw_grow(view_draw *d, const cgt_camera *camera, int begins, uint8_t *rgb, const stop_flag *stop,
                   uint32_t *left);

/* The camera that shows all of the frame from the same direction. */
int view_draw_fit(view_draw *d, cgt_camera *camera);

/* What a pixel shows. */
typedef struct view_hit {
    int is_hit;
    int is_file;      /* of the file; else a figure, or the mesh beside it */
    uint32_t element; /* its number in the file: a sphere or a triangle */
    float t;
    float place[3]; /* less the origin */
} view_hit;
int view_draw_pick(view_draw *d, const cgt_camera *camera, uint32_t x, uint32_t y, view_hit *hit);

/* Colours by what --color takes, with the range of the frame at hand. Errors leave the colours as they are; the frame
 * is to be set anew. */
int view_draw_color(view_draw *d, const view_frame *frame, const char *by);

/* Shows the spheres that meet a condition alone, an expression; "": those of the options. As above. */
int view_draw_show(view_draw *d, const view_frame *frame, const char *condition);

/* What the colours show, as --color takes it. */
const char *view_draw_color_name(const view_draw *d);

/* The command line of cgt-render that makes the picture: arguments, of which the caller frees each and the array. */
char **view_draw_command(view_draw *d, const cgt_camera *camera, const char *pattern, int *argc);

/* Draws and writes that picture to `path`, which the pattern names. */
int view_draw_write(view_draw *d, char **arguments, int argc, const view_frame *frame, const char *path);

/* Writes a camera as -c takes it, in the file's coordinates. */
void view_draw_print_camera(const view_draw *d, const cgt_camera *camera, FILE *to);

#endif
