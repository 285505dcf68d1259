/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Files of runs for a figure that finds all of frames itself: the source's sequence is all zero, and takes them as they
 * are. */
#ifndef FIGURE_RUN_H
#define FIGURE_RUN_H

#include <cgt/figure.h>

#include "playback/survey_walk.h"

/* Sets the options of lines, as cgt_figure_set_lines, but leaves out those that are not the figure's. */
cgt_result figure_run_set(cgt_figure *figure, const char *settings);

/* Has all columns of the file read, at its first frame, which becomes that of the sequence. Returns 1, 0 where there is
 * no frame, or -1 with a text. */
int figure_run_want_all(frame_source *source, char *error, size_t error_size);

/* Has the figure look at frames by a walk, whose look is set here, as long as it needs them. Returns 0, or -1 with a
 * text. */
int figure_run_look(cgt_figure *figure, frame_source *source, survey_walk *walk, char *error, size_t error_size);

/* Keeps the frame `number`, after the `lead` before it; those before are skipped unread. source->looks_ahead: the first
 * frame has the speeds towards the second, where the input can be read again. Returns 1, 0 where the file ends before,
 * or -1 with a text. */
int figure_run_keep(cgt_figure *figure, frame_source *source, uint64_t lead, uint64_t number, cgt_figure_frame **frame,
                    char *error, size_t error_size);

/* Whether it has something to show: runs may begin with empty frames, and a door opens at the first that is none. */
static inline int figure_run_shows(const cgt_figure_frame *frame)
{
    return frame_primitives(cgt_figure_frame_get_data(frame)) > 0;
}

#endif
