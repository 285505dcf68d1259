/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Surveys of files; see survey_run.h. */
#include "playback/survey_run.h"

#include <stdio.h>

#include "common/program.h"

/* Looks at the frame `number`, or skips it where it is beyond those that are wanted. Results as those of
 * frame_source_read. */
static int visit(frame_source *source, const survey_plan *plan, uint64_t number, survey_team *team, char *error,
                 size_t error_size)
{
    if (number < plan->most) {
        const int state = frame_source_read(source, number, error, error_size);
        if (state == 1)
            cgt_survey_look(team);
        return state;
    }
    const int state = frame_keep_skip(&source->keep, source->file, error, error_size);
    source->next += state == 1;
    return state;
}

int survey_run(frame_source *source, const survey_plan *plan, survey *result, char *error, size_t error_size)
{
    program_progress progress;
    survey_team team;
    int state = 1;
    uint64_t number = 0;
    cgt_survey_begin(&team, source->sequence, plan->fit, plan->context, result);
    frame_keep_begin(&source->keep);
    program_progress_start(&progress, "reading", "frames", 0.0, plan->quiet);
    while (!*plan->stop && (plan->count || number < plan->most)) {
        state = visit(source, plan, number, &team, error, error_size);
        if (state != 1)
            break;
        number++;
        program_progress_update(&progress, (double)number, cgt_trajectory_progress(source->file));
    }
    program_progress_end(&progress);
    frame_keep_end(&source->keep, state == 0 && !source->follows);
    cgt_survey_end(&team);
    if (*plan->stop) {
        snprintf(error, error_size, "interrupted");
        return -1;
    }
    result->has_total = state != 1;
    result->total = number;
    result->is_cut = state < 0;
    /* A file that is cut off, or still being written, is good for its whole frames: the error comes again after
     * them. */
    return state < 0 && number == 0 ? -1 : frame_source_rewind(source, error, error_size);
}
