/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Walks along the files of a run, for surveys. */
#ifndef SURVEY_RUN_H
#define SURVEY_RUN_H

#include "common/stop_flag.h"
#include "playback/frame_source.h"

/* A walk along the frames of a file, from the first on. */
typedef struct survey_walk {
    uint64_t most;         /* looks at the first frames alone, this many, */
    int count;             /* and counts the frames up to the file's end in any case */
    int quiet;             /* no progress on the terminal */
    const stop_flag *stop; /* not 0: ends the walk with an error */
    int (*look)(void *user, char *error, size_t error_size); /* at the frame of the source's sequence: 0; 1: no other
                                                                one is needed; -1 with a text */
    void *user;
    /* Found: */
    uint64_t frames, total; /* looked at; of the file, where has_total */
    int has_total;
    int is_cut; /* the file goes on after them, with an error, whose text is there */
} survey_walk;

/* Walks, and goes back to the start. Where an error follows some whole frames those were looked at, and reading them
 * again ends in the error. Returns 0, or -1 with a text. */
int survey_walk_run(survey_walk *walk, frame_source *source, char *error, size_t error_size);

#endif
