/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Files of runs for a figure; see figure_run.h. */
#include "playback/figure_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"
#include "common/settings_file.h"
#include "trajectory/trajectory_status.h"

cgt_result figure_run_set(cgt_figure *figure, const char *settings)
{
    char *const text = malloc(strlen(settings) + 1);
    if (!text)
        return CGT_ERROR_OUT_OF_MEMORY;
    text[settings_copy_part(settings, 1, text)] = '\0';
    const cgt_result result = cgt_figure_set_lines(figure, text);
    free(text);
    return result;
}

int figure_run_want_all(frame_source *source, char *error, size_t error_size)
{
    const char *names[CGT_TRAJECTORY_MOST_COLUMNS];
    const cgt_trajectory_frame *const frame = &source->sequence->frame;
    size_t count = 0;
    int state = frame_source_read(source, 0, error, error_size);
    if (state != 1)
        return state;
    for (uint32_t i = 0; i < frame->columns && count < CGT_TRAJECTORY_MOST_COLUMNS; i++)
        names[count++] = frame->column[i].name;
    if (trajectory_failed(source->file, cgt_trajectory_want_columns(source->file, names, count), error, error_size))
        return -1;
    return frame_source_rewind(source, error, error_size) ? -1 : 1;
}

typedef struct looking {
    cgt_figure *figure;
    const cgt_trajectory_frame *frame;
} looking;

static int look(void *user, char *error, size_t error_size)
{
    const looking *const l = user;
    const cgt_figure_data data = {.frame = l->frame};
    if (cgt_figure_survey(l->figure, &data) == CGT_OK)
        return !cgt_figure_needs_frame(l->figure);
    cgt_figure_get_error_message(l->figure, error, error_size);
    return -1;
}

int figure_run_look(cgt_figure *figure, frame_source *source, survey_walk *walk, char *error, size_t error_size)
{
    looking user = {figure, &source->sequence->frame};
    walk->look = look;
    walk->user = &user;
    return survey_walk_run(walk, source, error, error_size);
}

/* Reads the frame `number`, at least source->next, and gives it to the figure. */
static int give(cgt_figure *figure, frame_source *source, uint64_t number, cgt_figure_frame **frame, char *error,
                size_t error_size)
{
    const cgt_figure_data data = {.frame = &source->sequence->frame};
    char text[PROGRAM_ERROR_SIZE];
    const int state = frame_source_read(source, number, error, error_size);
    if (state != 1)
        return state;
    const int failed = cgt_figure_keep(figure, &data, frame, text, sizeof text) != CGT_OK;
    if (failed)
        snprintf(error, error_size, "%s", text);
    else if (*text)
        program_error("%s", text);
    return failed ? -1 : 1;
}

int figure_run_keep(cgt_figure *figure, frame_source *source, uint64_t lead, uint64_t number, cgt_figure_frame **frame,
                    char *error, size_t error_size)
{
    uint64_t next = number > lead ? number - lead : 0;
    int state = 1;
    if (number < source->next && frame_source_rewind(source, error, error_size))
        return -1;
    if (number == 0 && source->looks_ahead && cgt_trajectory_can_rewind(source->file)) {
        source->looks_ahead = 0;
        state = give(figure, source, 0, NULL, error, error_size);
        if (state != 1)
            return state;
        give(figure, source, 1, NULL, error, error_size); /* where there is one */
        if (frame_source_rewind(source, error, error_size))
            return -1;
    }
    next = next > source->next ? next : source->next;
    for (; state == 1 && next <= number; next++)
        state = give(figure, source, next, next == number ? frame : NULL, error, error_size);
    return state;
}
