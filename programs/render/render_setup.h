/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The state of a run of cgt-render, its set-up before the first frame, and what makes its pictures. */
#ifndef RENDER_SETUP_H
#define RENDER_SETUP_H

#include <stdint.h>
#include <stdio.h>

#include <cgt/cgt.h>

#include "playback/camera/camera_path.h"
#include "common/stop_flag.h"
#include "picture/color/coloring.h"
#include "picture/overlay/contact_sheet.h"
#include "playback/survey_run.h"
#include "common/program.h"
#include "picture/files/image_write.h"
#include "render/options/render_options.h"
#include "render/stream/render_reader.h"
#include "render/render_report.h"
#include "render/render_scene.h"
#include "picture/overlay/overlay.h"
#include "render/stream/render_writer.h"
#include <cgt/picture.h>

typedef struct render_bounce render_bounce;
typedef struct render_cell render_cell;

typedef struct renderer {
    render_options options;
    const stop_flag *stop; /* not 0: a signal has come */
    frame_source source;   /* the reader's, once it has started; its sequence, too */
    frame_sequence sequence;
    double origin[3]; /* that is subtracted from the file's coordinates */
    int has_survey;
    survey survey;            /* where has_survey */
    camera_directions fit[2]; /* of the automatic camera, for spheres and for triangles */
    uint64_t begin, count;    /* of the chosen frames: the first one of this run, how many; count UINT64_MAX: unknown */
    coloring coloring;        /* its index is that of the frame that is drawn */
    expression *formula;      /* of the colours; NULL: none */
    camera_path path;
    cgt_camera camera;    /* of the frame */
    float light[3];       /* towards the first light */
    cgt_picture *drawing; /* makes the picture */
    cgt_image image;      /* of the frame: the writer's memory */
    overlay overlay;
    overlay_kind kinds[OVERLAY_MOST_KINDS]; /* of its legend */
    png_text texts[4];                      /* what pictures say of themselves */
    size_t text_count;
    char *settings;       /* of the command line and the camera, among the texts */
    contact_sheet *sheet; /* NULL: none */
    cgt_context *context;
    cgt_scene *scene;
    render_scene parts;    /* what the frames' geometries are made of */
    render_bounce *bounce; /* --bounces: makes the pictures; else NULL */
    render_cell *cell;     /* --cell: traces in place of the library; else NULL */
    int has_geometry;      /* made from the first frame, which tells the kind */
    uint32_t geometry;
    render_reader reader;
    render_writer writer;
    const cgt_trajectory_frame *frame; /* that is drawn */
    speed_source speed_from;
    render_report report;               /* the writer's threads add to it until they have ended */
    int failed;                         /* in a frame: no movie is kept */
    uint64_t first_number, last_number; /* in the input, of frames that are done */
    program_progress progress;
    FILE *summary; /* standard output, or standard error where frames go to standard output */
    char error[PROGRAM_ERROR_SIZE];
} renderer;

/* Whether an origin is subtracted from the file's coordinates. */
static inline int renderer_is_moved(const renderer *r)
{
    return r->origin[0] != 0.0 || r->origin[1] != 0.0 || r->origin[2] != 0.0;
}

/* Writes a camera as -c takes it, in the file's coordinates. */
enum { RENDERER_CAMERA_SIZE = 256 }; /* ten numbers of at most 24 letters */
void renderer_name_camera(const renderer *r, const cgt_camera *camera, char text[RENDERER_CAMERA_SIZE]);
void renderer_print_camera(const renderer *r, const cgt_camera *camera, FILE *to);

static inline const camera_directions *renderer_fit(const renderer *r)
{
    return &r->fit[r->survey.kind == CGT_TRAJECTORY_TRIANGLES];
}

/* Both print an error and return -1: the text in r->error, or the library's message about a failed action. */
int render_fail(renderer *r);
int render_fail_library(renderer *r, const char *action, cgt_result result);
int render_fail_picture(renderer *r, cgt_result result); /* the same of r->drawing */

/* Opens the input and surveys it if necessary, chooses colours and camera, makes folders, buffers and an empty scene,
 * and starts the threads that read and write. options, stop, writer.on_done and writer.user are set, the rest is zero.
 * Returns 0, or -1 with the message printed. */
int render_setup(renderer *r);

/* All of that but the Cell and the threads: for a program that reads and shows frames in its own order. The source is
 * open, at its first frame. */
int render_prepare(renderer *r);

/* Refuses options that do not fit the kind of the file's first frame; user: the renderer. Returns 0, or -1 with the
 * message printed. */
int render_check_kind(void *user, const cgt_trajectory_frame *frame);

/* The camera of the frame `number`. */
void render_camera_at(const renderer *r, uint64_t number, cgt_camera *camera);

/* The choices of render_setup (render_choices.c). An origin for a camera of the command line that looks at something
 * far off, before the survey; one for a run that lies far off, after it: 1 where the run must be surveyed again. Then
 * the cameras of the command line are moved by the origin: 0, or -1 with the message printed. */
void render_choose_camera_origin(renderer *r);
int render_choose_bulk_origin(renderer *r);
int render_move_cameras(renderer *r);

/* After the survey, in this order: what the colours show and their
 * range; the camera, and the mesh that it must show; the first light, which is over the left shoulder of the first
 * camera, and does not follow an orbit. The first two return as render_setup. */
int render_choose_colors(renderer *r);
int render_choose_camera(renderer *r);
void render_choose_light(renderer *r);

/* Frees what render_setup made, also after a failure. The writer is finished before. */
void render_close(renderer *r);

/* ---- From a committed scene to a picture (render_picture.c) ---- */

/* Chooses how pictures are made; camera, light and survey are set. Returns 0, or -1 with the message printed. */
int render_picture_setup(renderer *r);
void render_picture_close(renderer *r);

/* How the picture is made that r->path.start and r->light see; the options give its size. */
cgt_picture_options render_picture_settings(const renderer *r);

/* Draws r->scene by r->camera to r->image. Errors are those of r->drawing. */
cgt_result render_picture_trace(renderer *r, const cgt_trace_options *options);

/* The parts of that before drawing, projection and looks, which it counts, and after it. */
uint32_t render_picture_begin(renderer *r, cgt_look *looks);
void render_picture_overlay(renderer *r);

/* ---- Mirrors and glass (render_bounce.c) ----
 * The frame's spheres become two geometries, opaque ones and glass, with a material each. A file of triangles is of one
 * material. */

/* Makes r->bounce, after colours, camera and floor. Returns 0, or -1 with the message printed. */
int render_bounce_create(renderer *r);

/* Sets materials and what belongs to them. */
void render_bounce_settings(const renderer *r, cgt_picture_options *settings);

/* render_scene_set and render_scene_find of these geometries; *primitive becomes the number among all that is drawn of
 * the file. */
int render_bounce_set(renderer *r, const frame_parts *parts);
int render_bounce_find(const renderer *r, uint32_t geometry, uint32_t *primitive);

/* Sets the look of each geometry; returns how many there are. */
uint32_t render_bounce_looks(const render_bounce *bounce, cgt_look *looks);

void render_bounce_release(render_bounce *bounce); /* NULL does nothing */

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
