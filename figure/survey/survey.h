/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Surveys of a run: what must be known of its frames before the first picture: bounds, ranges, counts. */
#ifndef SURVEY_H
#define SURVEY_H

#include <stdint.h>

#include "camera_reach.h"
#include "survey/bulk.h"
#include "sequence/frame_sequence.h"

enum { SURVEY_TYPES = 1 << 16, SURVEY_ELEMENTS = 256 }; /* that a legend may name or count */
enum { SURVEY_BINS = 4096 }; /* of speeds: the leading 13 bits of a float above 0, sixteen bins an octave */

/* The extremes of the frames' numbers, which texts leave room for. */
typedef struct survey_times {
    uint64_t number_max;
    int64_t step_min, step_max;
    double time_min, time_max; /* of those that are known; min above max where none is */
    int has_unknown;
    size_t letters; /* of a time, at most */
} survey_times;

typedef struct survey {
    uint64_t frames; /* looked at */
    uint64_t total;  /* of the file, where has_total */
    int has_total;
    int is_cut;               /* the file goes on after them, with an error */
    cgt_trajectory_kind kind; /* of the file, where frames is above 0 */
    survey_times times;
    uint64_t hidden;     /* spheres that options leave out; nothing below is theirs but types and has_element */
    uint64_t drawable;   /* valid spheres or triangles that are shown: finite, no negative radius */
    float bounds_min[3]; /* of those; min above max where there are none */
    float bounds_max[3];
    bulk bulk;               /* of their places */
    uint32_t id_min, id_max; /* indices where the file has no ids */
    uint32_t type_min, type_max;
    int has_type;    /* some frame has types */
    int has_rgb;     /* some frame has colours of given_colors.h */
    uint64_t speeds; /* known ones */
    uint64_t speed_bins[SURVEY_BINS];
    float speed_max;
    float boxless_steps[3];                    /* the longest along each axis; see speed.h */
    double box_min[3], box_max[3];             /* of all boxes with their images; min above max where there are none */
    double move_min[3], move_max[3];           /* of images: how far they are from the original, at most */
    camera_reach reach, box_reach, move_reach; /* of the primitives, of the boxes, of images from the original */
    uint64_t values, unknown_values;           /* of the first formula: finite ones, and others */
    bulk_values value_samples;                 /* of the finite ones; then their range */
    double value_min, value_max, value_least;  /* least: above 0; +infinity where there is none */
    int has_element;                           /* some sphere is a chemical element */
    /* With sequence->wants_kinds: a bit for each type, and a byte for each element by its atomic number, of spheres
     * that are shown. */
    uint8_t has_types[SURVEY_TYPES / 8], has_elements[SURVEY_ELEMENTS];
} survey;

/* Those who look at one frame together. */
typedef struct survey_team {
    const frame_sequence *sequence;
    const camera_directions *fit; /* of spheres, and of triangles; NULL: no camera is asked for */
    survey *first, *others;       /* of the first thread; of the other threads */
    cgt_context *context;
    uint32_t threads;
    uint32_t pieces; /* that the frame is cut into, at most one a thread */
} survey_team;

/* Begins a survey of the frames of a sequence.
 *   fit       of spheres, and one more of triangles: what the camera needs; NULL: nothing
 *   context   whose threads look at large frames; the survey is the same from any number */
void cgt_survey_begin(survey_team *team, const frame_sequence *sequence, const camera_directions *fit,
                      cgt_context *context, survey *result);

/* Looks at the frame that the sequence took last. */
void cgt_survey_look(survey_team *team);

/* Ends a survey, whose result has no total yet. */
void cgt_survey_end(survey_team *team);

/* The quantile `share` of the known speeds, at most a sixteenth too large and no larger than the greatest; of fewer
 * than 101 the greatest where share is 0.99 or more. 0 where none is known. */
float cgt_survey_speed_quantile(const survey *s, double share);

/* The ends of a colour map for the first formula's values, of which there are some: the 1 % and the 99 % quantile, or
 * the least and the greatest value where those are equal. logarithmic: of the values above 0, where there are any.
 * Returns whether it is the quantiles. */
int cgt_survey_value_range(const survey *s, int logarithmic, double *min, double *max);

#endif
