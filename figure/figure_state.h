/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A figure: options and a run's frames on one side, pictures on the other. It reads no files and prints nothing.
 * In the order of a run: cgt_figure_open; frames taken by its sequence and looked at for its survey; the choices of
 * figure_settle.c; then for each frame cgt_figure_scene_prepare, _set, a commit, and a picture. figure.c does all that
 * for its caller; figure_frame.c for frames that are kept, which may be shown by other options without a new survey.
 * Functions that return an int give 0, or -1 with a sentence in figure->message, unless they say otherwise. */
#ifndef FIGURE_STATE_H
#define FIGURE_STATE_H

#include <stdint.h>

#include <cgt/figure.h>

#include "color/coloring.h"
#include "data/figure_data.h"
#include "data/frame_copy.h"
#include "text/overlay.h"
#include "camera/camera_path.h"
#include "sequence/frame_sequence.h"
#include "survey/survey.h"
#include "scene/figure_scene.h"
#include "notices.h"
#include "options/figure_options.h"
#include "options/figure_settings.h"

typedef struct figure_bounce figure_bounce;

enum { FIGURE_MESSAGE_SIZE = 1024 };

/* Frames on their way to be kept; of the thread that keeps them. */
typedef struct frame_keeping {
    int is_on;
    frame_sequence sequence;
    uint64_t next; /* number of the frame that follows the last one */
    figure_data data;
} frame_keeping;

struct cgt_figure_frame {
    cgt_trajectory_frame *data; /* with all its arrays */
    float *speed;               /* as frame_sequence.speed */
    speed_source speed_from;
    size_t bytes;
    cgt_figure *shown_by; /* the figure that draws it; NULL: none */
};

struct cgt_figure {
    /* What the caller sets; what it points to outlives the figure. */
    figure_options options;
    const char *source;             /* how messages call the data, such as a path */
    cgt_context *context;           /* of the scene */
    bool (*stop)(const void *user); /* asked while a picture is made; NULL: nothing is */
    const void *stop_user;
    figure_settings given; /* what <cgt/figure.h> made the options from */
    figure_data mesh;      /* that stands still; without triangles: there is none */
    notices notices;       /* what a user should read */
    char message[FIGURE_MESSAGE_SIZE];
    cgt_result failure; /* what cgt_figure_fail and its like have told; CGT_OK: a layer below wrote the message */
    int has_hand;
    cgt_camera hand; /* of all frames, in place of that of the options; where has_hand */
    frame_keeping keeping;

    /* What is known of the data and found of frames; all zero at first. */
    double origin[3]; /* that is subtracted from the data */

    frame_sequence sequence;
    int has_survey;
    survey survey;            /* where has_survey */
    camera_directions fit[2]; /* of the automatic camera, for spheres and for triangles */

    coloring coloring;     /* its index is that of the frame that is drawn */
    expression *formula;   /* of the colours; NULL: none */
    categories categories; /* of that formula */
    camera_path path;
    cgt_camera camera; /* of the frame */
    float light[3];    /* towards the first light */

    cgt_scene *scene;
    figure_scene parts;    /* what the frames' geometries are made of */
    figure_bounce *bounce; /* mirrors and glass; else NULL */
    int has_geometry;      /* made from the first frame, which tells the kind */
    uint32_t geometry;
    const cgt_trajectory_frame *frame; /* that is drawn */
    speed_source speed_from;

    cgt_picture *drawing;                     /* makes the picture */
    cgt_picture *quick[CGT_FIGURE_QUALITIES]; /* those of less quality */
    uint8_t *small;                           /* a picture of fewer pixels */
    cgt_image image;                          /* of the frame: the caller's memory */
    overlay overlay;
    overlay_kind kinds[OVERLAY_MOST_KINDS]; /* of its legend */
    /* What is wrong with them, or with options, was told. */
    int has_scale_told, has_labels_told, has_time_told, has_unit_told, has_radii_told, has_cut_told, has_unused_told;

    /* Of <cgt/figure.h> alone. */
    int is_open, is_settled, is_surveying, has_bonds_told;
    int has_begun;           /* drawing has a picture of the scene as it is, */
    cgt_camera begun;        /* by this camera */
    survey_team team;        /* while is_surveying */
    uint64_t next;           /* number of the frame that follows the last one */
    figure_data data;        /* the frame at hand, of the caller's columns */
    frame_copy copy;         /* the places of the shown frame, */
    frame_parts drawn;       /* and what is drawn of it */
    cgt_figure_frame *shown; /* the frame, where it is a kept one */
    int has_moved;           /* the camera, by which lines have their thickness */
};

/* What was found of a run, and stays where options change that do not concern it. */
typedef struct figure_found {
    int keeps_colors, keeps_camera, keeps_floor, has_kinds;
    coloring_by by;
    double min, max;
    camera_path path;
    floor_options floor;
    float bounds_min[3], bounds_max[3];
    survey_times times;
    uint8_t has_types[SURVEY_TYPES / 8], has_elements[SURVEY_ELEMENTS];
} figure_found;

/* Whether an origin is subtracted from the data's coordinates. */
static inline int figure_is_moved(const cgt_figure *figure)
{
    return figure->origin[0] != 0.0 || figure->origin[1] != 0.0 || figure->origin[2] != 0.0;
}

static inline const camera_directions *figure_fit(const cgt_figure *figure)
{
    return &figure->fit[figure->survey.kind == CGT_TRAJECTORY_TRIANGLES];
}

/* All return -1: a sentence, of memory or of what is wrong; the library's message about an action that has failed, of
 * the context or of figure->drawing. */
int cgt_figure_fail(cgt_figure *figure, const char *format, ...) __attribute__((format(printf, 2, 3)));
int cgt_figure_fail_library(cgt_figure *figure, const char *action, cgt_result result);
int cgt_figure_fail_picture(cgt_figure *figure, cgt_result result);

/* The result of what has failed, once; layers below tell by the beginning of their sentence alone whether it was
 * memory. Every call of <cgt/figure.h> that fails ends with it. */
cgt_result cgt_figure_result(cgt_figure *figure);

/* After the survey, which it ends: all choices. was: what stays of those before; NULL: nothing. */
int cgt_figure_choose(cgt_figure *figure, const figure_found *was);

/* What the sequence's frame must have. */
int cgt_figure_check_frame(cgt_figure *figure);

/* Has the sequence's frame drawn, whose arrays are copied; or stay where they are until another one is drawn. */
int cgt_figure_build(cgt_figure *figure, int is_kept);

/* Takes a kept frame's arrays out of the scene. Then the same of any frame's: nothing is shown. */
void cgt_figure_unshow(cgt_figure *figure);
void cgt_figure_clear(cgt_figure *figure);

/* Forgets all that was found of frames; what was set, and the options made of it, stay. Then the same, and the options
 * are made anew: cameras were moved, axes and ambient rays chosen in them. */
void cgt_figure_forget(cgt_figure *figure);
void cgt_figure_begin_again(cgt_figure *figure);

/* The calls that change options, where frames are kept (figure_frame.c). */
cgt_result cgt_figure_change(cgt_figure *figure, settings_change change, const char *name, const char *value);

/* ---- Before the first picture (figure_settle.c) ---- */

/* Parses formulas, and makes what the sequence needs, once; options and context are set, all else is zero. */
int cgt_figure_open(cgt_figure *figure);

/* How many frames must be looked at before the first picture: `most`, if those of the run; the first, which tells the
 * kind and whether there are types; or none. */
uint64_t cgt_figure_needs_frames(const cgt_figure *figure, uint64_t most);

unwrap_mode cgt_figure_unwraps(const figure_options *o);

/* Whether types or elements are to be named, which are those of all frames. */
int cgt_figure_wants_kinds(const figure_options *o);

/* Whether the first frame, which was looked at alone, is enough for automatic colours. */
int cgt_figure_is_decided(const cgt_figure *figure);

/* What the automatic camera asks of the survey, before the kind of the data is known: figure->fit, or NULL. */
const camera_directions *cgt_figure_begin_fit(cgt_figure *figure);

/* Moves the cameras of the options by the origin, and chooses up and view. */
int cgt_figure_move_cameras(cgt_figure *figure);

/* After that, in this order: what the colours show and their range; the camera. */
int cgt_figure_choose_colors(cgt_figure *figure);
int cgt_figure_keep_colors(cgt_figure *figure, const figure_found *was);

/* Writes where the bonds of a run come from, by its first frame, where options ask and it is not the file alone: "" if
 * there is nothing to tell. Returns -1 if --bonds has none. */
int cgt_figure_check_bonds(const figure_options *o, const cgt_trajectory_frame *frame, char *text, size_t size);
int cgt_figure_choose_camera(cgt_figure *figure);

/* Tells once of options that were given and change nothing. */
void cgt_figure_tell_unused(cgt_figure *figure);

/* The rest: ambient rays, the first light, which is over the left shoulder of the first camera and does not follow an
 * orbit, floor, an empty scene, mirrors and glass. */
int cgt_figure_settle(cgt_figure *figure);
int cgt_figure_make_scene(cgt_figure *figure); /* the last two of these */
void cgt_figure_choose_ambient(cgt_figure *figure);
void cgt_figure_choose_light(cgt_figure *figure);

/* The camera of the hand becomes that of all frames, and what depends on it. */
void cgt_figure_take_hand(cgt_figure *figure);

/* The camera of the frame `number`. */
void cgt_figure_camera_at(const cgt_figure *figure, uint64_t number, cgt_camera *camera);

/* Writes a camera as the option camera takes it, in the data's coordinates. */
enum { FIGURE_CAMERA_SIZE = 256 }; /* ten numbers of at most 24 letters */
void cgt_figure_name_camera(const cgt_figure *figure, const cgt_camera *camera, char text[FIGURE_CAMERA_SIZE]);

/* As cgt_figure_get_chosen of all settings, but those of a run's pictures, whose camera may move (figure_tell.c). */
size_t cgt_figure_tell_run(const cgt_figure *figure, char *text, size_t size);

/* Ends all that was made by options, but neither survey nor path. */
void cgt_figure_unmake(cgt_figure *figure);

/* Frees all but context and options' texts, also after a failure. */
void cgt_figure_close(cgt_figure *figure);

/* ---- From a committed scene to a picture (figure_draw.c) ---- */

/* Chooses texts and their places, for the options' size, unless they are chosen: colours and survey are set. */
int cgt_figure_choose_overlay(cgt_figure *figure);

/* Chooses how pictures are made: drawing and overlay; camera, light and survey are set. */
int cgt_figure_open_picture(cgt_figure *figure);
void cgt_figure_close_picture(cgt_figure *figure);

/* How the picture is made that path.start and light see; the options give its size. Camera keys have the depths of
 * figure->camera, which changes by frames. */
cgt_picture_options cgt_figure_get_settings(const cgt_figure *figure);

/* Draws the scene by figure->camera to figure->image. Errors are those of figure->drawing. */
cgt_result cgt_figure_trace(cgt_figure *figure, const cgt_trace_options *options);

/* The parts of that before drawing, projection and looks, which it counts, and after it. */
uint32_t cgt_figure_begin_picture(cgt_figure *figure, cgt_look *looks);
void cgt_figure_draw_overlay(cgt_figure *figure);

/* ---- Mirrors and glass (figure_bounce.c) ----
 * The frame's spheres become two geometries, opaque ones and glass, with a material each. A file of triangles is of one
 * material. */

/* Makes figure->bounce, after colours, camera and floor. */
int cgt_figure_bounce_create(cgt_figure *figure);

/* Sets materials and what belongs to them. */
void cgt_figure_bounce_settings(const cgt_figure *figure, cgt_picture_options *settings);

/* cgt_figure_scene_set and _find of these geometries; *primitive becomes the number among all that is drawn of the
 * data. */
int cgt_figure_bounce_set(cgt_figure *figure, const frame_parts *parts);
int cgt_figure_bounce_find(const cgt_figure *figure, uint32_t geometry, uint32_t *primitive);

/* Sets the look of each geometry; returns how many there are. */
uint32_t cgt_figure_bounce_looks(const figure_bounce *bounce, cgt_look *looks);

void cgt_figure_bounce_release(figure_bounce *bounce); /* NULL does nothing */

#endif
