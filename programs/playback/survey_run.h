/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Surveys of files. */
#ifndef SURVEY_RUN_H
#define SURVEY_RUN_H

#include "common/stop_flag.h"
#include "playback/frame_source.h"
#include "survey/survey.h"

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

#endif
