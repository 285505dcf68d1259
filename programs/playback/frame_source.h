/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run: those selected from a trajectory, with the speeds of their spheres or vertices. And a survey of
 * them, for what must be known before the first picture: bounds, ranges, counts. */
#ifndef FRAME_SOURCE_H
#define FRAME_SOURCE_H

#include <stddef.h>
#include <stdint.h>

#include "camera_reach.h"
#include "common/stop_flag.h"
#include "picture/figures/expression.h"
#include "picture/figures/particles.h"
#include "picture/figures/trail_history.h"
#include "playback/bulk.h"
#include "playback/camera/camera_path.h"
#include "playback/frame_access.h"
#include "playback/frames/frame_keep.h"
#include "playback/periodic/unwrap.h"
#include "playback/speed.h"
#include <cgt/trajectory.h>

/* Every `every`th frame from first to last, both included, counted from 0. */
typedef struct frame_range {
    uint64_t first, last, every;
} frame_range;

enum { SOURCE_FORMULAS = 8 };
/* How many frames a range chooses of the first `total`. */
uint64_t frame_range_count(const frame_range *range, uint64_t total);

typedef struct frame_source {
    cgt_trajectory *file;
    int follows;            /* more may come at its end */
    frame_keep keep;        /* frames of the survey; keep.most is the caller's */
    unwrapping *unwrap;     /* of each frame that is read; NULL: places are those of the file */
    int is_endless;         /* a molecule without end was told */
    speed_tracker *tracker; /* NULL: no speeds */
    trail_history *trails;  /* places in the frames before; NULL: none; may be set once a survey is done */
    int looks_ahead;        /* the first frame has the speeds towards the second, where the input can be read again; the
                               caller's, set once a survey is done */
    uint64_t next;          /* number of the file's next frame */
    cgt_trajectory_frame frame; /* the one that was read last */
    const float *speed;         /* per sphere or vertex, NaN where unknown; NULL without speeds */
    speed_source speed_from;
    /* Formulas that are bound to each frame that is read; the caller's, set after opening. */
    expression *formulas[SOURCE_FORMULAS];
    uint32_t formula_count;
    int wants_kinds;             /* the survey tells which types and elements are shown; the caller's */
    const particle_rules *rules; /* of what is drawn, for the survey; NULL: all as it is; the caller's */
} frame_source;

/* Adds a formula to those that are bound to each frame, and has its columns read. NULL is ignored. Returns 0, or -1
 * with a text. */
int frame_source_bind(frame_source *source, expression *formula, char *error, size_t error_size);

/* Puts the molecules of all frames together that are read from now on. UNWRAP_NOT is ignored. Returns 0, or -1 with a
 * text. */
int frame_source_unwrap(frame_source *source, unwrap_mode mode, char *error, size_t error_size);

/* Opens a file, or the files of a run in their order. speeds: the context whose threads find them; NULL: none are
 * wanted. Returns 0, or -1 with a text. */
int frame_source_open(frame_source *source, const char *const *paths, size_t count,
                      const cgt_trajectory_options *options, cgt_context *speeds, char *error, size_t error_size);

/* Reads the frame `number`, at least source->next. Those before it are skipped unread, unless the speeds of this one
 * need the positions of the one before, or its trails those of several. Returns 1, 0 where the file ends before, or -1
 * with a text. */
int frame_source_read(frame_source *source, uint64_t number, char *error, size_t error_size);

/* Goes back to the start: 0, or -1 with a text. */
int frame_source_rewind(frame_source *source, char *error, size_t error_size);

/* Frees everything. A source that was never opened is all zero and may be closed. */
void frame_source_close(frame_source *source);

enum { SURVEY_KINDS = 1024 }; /* types and elements that a legend may name; higher types are not told apart */
enum { SURVEY_BINS = 4096 };  /* of speeds: the leading 13 bits of a float above 0, sixteen bins an octave */

typedef struct survey {
    uint64_t frames; /* looked at */
    uint64_t total;  /* of the file, where has_total */
    int has_total;
    int is_cut;               /* the file goes on after them, with an error */
    cgt_trajectory_kind kind; /* of the file, where frames is above 0 */
    uint64_t drawable;        /* valid spheres or triangles in all of them: finite, no negative radius */
    float bounds_min[3];      /* of those; min above max where there are none */
    float bounds_max[3];
    bulk bulk;               /* of their places */
    uint32_t id_min, id_max; /* indices where the file has no ids */
    uint32_t type_min, type_max;
    int has_type;    /* some frame has types */
    uint64_t speeds; /* known ones */
    uint64_t speed_bins[SURVEY_BINS];
    float boxless_steps[3];                    /* the longest along each axis; see speed.h */
    double box_min[3], box_max[3];             /* of all boxes with their images; min above max where there are none */
    double move_min[3], move_max[3];           /* of images: how far they are from the original, at most */
    camera_reach reach, box_reach, move_reach; /* of the primitives, of the boxes, of images from the original */
    uint64_t values, unknown_values;           /* of the first formula: finite ones, and others */
    bulk_values value_samples;                 /* of the finite ones; then their range */
    double value_min, value_max, value_least;  /* least: above 0; +infinity where there is none */
    int has_element;                           /* some sphere is a chemical element */
    /* With source->wants_kinds: 1 for each type, and each element by its atomic number, of spheres that are shown. */
    uint8_t has_types[SURVEY_KINDS], has_elements[SURVEY_KINDS];
} survey;

/* What a survey does. */
typedef struct survey_plan {
    uint64_t most;                /* looks at the first frames alone, this many */
    int count;                    /* counts the frames up to the file's end in any case */
    int quiet;                    /* no progress on the terminal */
    const stop_flag *stop;        /* not 0: ends the survey with an error */
    cgt_context *context;         /* whose threads look at large frames; the survey is the same from any number */
    const camera_directions *fit; /* of spheres, and one more of triangles: what the camera needs; NULL: nothing */
} survey_plan;

/* Reads the frames of a file and goes back to the start. Where an error follows some whole frames it surveys those, and
 * reading them again ends in the error. Returns 0, or -1 with a text. */
int survey_run(frame_source *source, const survey_plan *plan, survey *result, char *error, size_t error_size);

/* The quantile `share` of the known speeds, at most a sixteenth too large; 0 where none is known. */
float survey_speed_quantile(const survey *s, double share);

/* The ends of a colour map for the first formula's values, of which there are some: the 1 % and the 99 % quantile, or
 * the least and the greatest value where those are equal. logarithmic: of the values above 0, where there are any.
 * Returns whether it is the quantiles. */
int survey_value_range(const survey *s, int logarithmic, double *min, double *max);

#endif
