/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Walks along the files of a run; see survey_walk.h. */
#include "playback/survey_walk.h"

#include <stdio.h>

#include "common/program.h"

/* The frame `number` is read, or skipped where it is beyond those that are wanted. Results as those of
 * frame_source_read. */
static int visit(frame_source *source, uint64_t number, int is_wanted, char *error, size_t error_size)
{
    if (is_wanted)
        return frame_source_read(source, number, error, error_size);
    const int state = frame_keep_skip(&source->keep, source->file, error, error_size);
    source->next += state == 1;
    return state;
}

int survey_walk_run(survey_walk *walk, frame_source *source, char *error, size_t error_size)
{
    program_progress progress;
    uint64_t most = walk->most;
    int state = 1, wrong = 0;
    walk->frames = walk->total = 0;
    frame_keep_begin(&source->keep);
    program_progress_start(&progress, "reading", "frames", 0.0, walk->quiet);
    while (!*walk->stop && (walk->count || walk->total < most)) {
        state = visit(source, walk->total, walk->total < most, error, error_size);
        if (state != 1)
            break;
        /* After the first frame all others are wanted. */
        if (walk->total > 0 && walk->total + 1 < most)
            frame_keep_ahead(&source->keep, source->file);
        const int looked = walk->total < most ? walk->look(walk->user, error, error_size) : 0;
        wrong = looked < 0;
        if (wrong)
            break;
        walk->frames += walk->total < most;
        walk->total++;
        most = looked ? walk->total : most;
        program_progress_update(&progress, (double)walk->total, frame_keep_progress(&source->keep, source->file));
    }
    program_progress_end(&progress);
    frame_keep_end(&source->keep, state == 0 && !source->follows);
    walk->has_total = state != 1;
    walk->is_cut = state < 0;
    if (*walk->stop)
        snprintf(error, error_size, "interrupted");
    /* A file that is cut off, or still being written, is good for its whole frames: the error comes again after
     * them. */
    if (*walk->stop || wrong || (state < 0 && walk->total == 0))
        return -1;
    return frame_source_rewind(source, error, error_size);
}
