/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run; see frame_source.h. */
#include "playback/frame_source.h"

#include <stdio.h>
#include <string.h>

#include "common/program.h"
#include "trajectory/trajectory_status.h"

int frame_source_open(frame_source *source, frame_sequence *sequence, const char *const *paths, size_t count,
                      const cgt_trajectory_options *options, char *error, size_t error_size)
{
    memset(source, 0, sizeof *source);
    source->sequence = sequence;
    const cgt_result result = cgt_trajectory_open_series(paths, count, options, &source->file);
    if (trajectory_failed(source->file, result, error, error_size)) {
        frame_source_close(source);
        return -1;
    }
    source->follows = options && options->follow > 0.0;
    source->has_radii = options && options->radius > 0.0f;
    return 0;
}

void frame_source_close(frame_source *source)
{
    frame_keep_release(&source->keep);
    cgt_trajectory_close(source->file);
    memset(source, 0, sizeof *source);
}

int frame_source_rewind(frame_source *source, char *error, size_t error_size)
{
    cgt_frame_sequence_restart(source->sequence);
    source->next = 0;
    return frame_keep_rewind(&source->keep, source->file, error, error_size);
}

uint64_t frame_range_count(const frame_range *range, uint64_t total)
{
    const uint64_t end = total > 0 && range->last < total - 1 ? range->last + 1 : total;
    return end > range->first ? (end - 1 - range->first) / range->every + 1 : 0;
}

int frame_source_want_columns(frame_source *source, char *error, size_t error_size)
{
    const char *wanted[CGT_TRAJECTORY_MOST_COLUMNS];
    const size_t count = cgt_frame_sequence_columns(source->sequence, wanted, CGT_TRAJECTORY_MOST_COLUMNS);
    return trajectory_failed(source->file, cgt_trajectory_want_columns(source->file, wanted, count), error, error_size);
}

/* The next frame, its molecules put together. Results as those of trajectory_status. */
static int read_places(frame_source *source, cgt_trajectory_frame *frame, char *error, size_t error_size)
{
    notices told = {.count = 0};
    const char *notice;
    const int result = frame_keep_read(&source->keep, source->file, frame, error, error_size);
    if (result != 1)
        return result;
    frame->has_radius |= source->has_radii;
    const int failed = cgt_frame_sequence_place(source->sequence, frame, &told, error, error_size);
    while ((notice = cgt_notices_take(&told)) != NULL)
        program_error("%s", notice);
    return failed ? -1 : 1;
}

static int read_frame(frame_source *source, char *error, size_t error_size)
{
    const int result = read_places(source, &source->sequence->frame, error, error_size);
    const char *warning;
    while ((warning = cgt_trajectory_take_warning(source->file)) != NULL)
        program_error("warning: %s", warning);
    if (result != 1)
        return result;
    return cgt_frame_sequence_take(source->sequence, error, error_size) ? -1 : 1;
}

static int skip_frame(frame_source *source, char *error, size_t error_size)
{
    cgt_frame_sequence_skip(source->sequence);
    return frame_keep_skip(&source->keep, source->file, error, error_size);
}

/* After the first frame: finds its speeds from the second, and goes back. Returns 1, or -1 with a text. */
static int look_ahead(frame_source *source, char *error, size_t error_size)
{
    cgt_trajectory_frame second;
    source->looks_ahead = 0;
    if (!cgt_frame_sequence_looks_ahead(source->sequence) || !cgt_trajectory_can_rewind(source->file))
        return 1;
    if (read_places(source, &second, error, error_size) == 1 &&
        cgt_frame_sequence_look_ahead(source->sequence, &second, error, error_size))
        return -1;
    return frame_source_rewind(source, error, error_size) ? -1 : read_frame(source, error, error_size);
}

int frame_source_read(frame_source *source, uint64_t number, char *error, size_t error_size)
{
    int result = 1;
    while (result == 1 && source->next < number) {
        const int needed = number - source->next <= cgt_frame_sequence_lead(source->sequence);
        result = needed ? read_frame(source, error, error_size) : skip_frame(source, error, error_size);
        source->next += result == 1;
    }
    if (result == 1)
        result = read_frame(source, error, error_size);
    if (result == 1 && source->looks_ahead && source->sequence->frame.number == 0)
        result = look_ahead(source, error, error_size);
    source->next += result == 1;
    return result;
}
