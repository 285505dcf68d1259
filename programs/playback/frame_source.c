/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run; see frame_source.h. */
#include "playback/frame_source.h"

#include <stdio.h>
#include <string.h>

#include "common/program.h"
#include "trajectory/trajectory_status.h"

int frame_source_open(frame_source *source, const char *const *paths, size_t count,
                      const cgt_trajectory_options *options, cgt_context *speeds, char *error, size_t error_size)
{
    memset(source, 0, sizeof *source);
    const cgt_result result = cgt_trajectory_open_series(paths, count, options, &source->file);
    if (trajectory_failed(source->file, result, error, error_size)) {
        frame_source_close(source);
        return -1;
    }
    source->follows = options && options->follow > 0.0;
    if (speeds) {
        source->tracker = speed_create(speeds);
        if (!source->tracker) {
            snprintf(error, error_size, "out of memory");
            frame_source_close(source);
            return -1;
        }
    }
    return 0;
}

void frame_source_close(frame_source *source)
{
    unwrap_release(source->unwrap);
    speed_release(source->tracker);
    trail_history_release(source->trails);
    frame_keep_release(&source->keep);
    cgt_trajectory_close(source->file);
    memset(source, 0, sizeof *source);
}

int frame_source_rewind(frame_source *source, char *error, size_t error_size)
{
    if (source->tracker)
        speed_restart(source->tracker);
    if (source->trails)
        trail_history_restart(source->trails);
    if (source->unwrap)
        unwrap_restart(source->unwrap);
    source->next = 0;
    return frame_keep_rewind(&source->keep, source->file, error, error_size);
}

uint64_t frame_range_count(const frame_range *range, uint64_t total)
{
    const uint64_t end = total > 0 && range->last < total - 1 ? range->last + 1 : total;
    return end > range->first ? (end - 1 - range->first) / range->every + 1 : 0;
}

/* The columns of all formulas, and image flags. */
static int want_columns(frame_source *source, char *error, size_t error_size)
{
    const char *wanted[CGT_TRAJECTORY_MOST_COLUMNS];
    size_t count = 0, names;
    const char *const *name = unwrap_columns(&names);
    for (size_t k = 0; k < names && source->unwrap; k++)
        wanted[count++] = name[k];
    for (uint32_t i = 0; i < source->formula_count; i++) {
        name = expression_names(source->formulas[i], &names);
        for (size_t k = 0; k < names && count < sizeof wanted / sizeof wanted[0]; k++)
            wanted[count++] = name[k];
    }
    return trajectory_failed(source->file, cgt_trajectory_want_columns(source->file, wanted, count), error, error_size);
}

int frame_source_bind(frame_source *source, expression *formula, char *error, size_t error_size)
{
    if (!formula)
        return 0;
    if (source->formula_count == SOURCE_FORMULAS) {
        snprintf(error, error_size, "more than %d formulas", SOURCE_FORMULAS);
        return -1;
    }
    source->formulas[source->formula_count++] = formula;
    return want_columns(source, error, error_size);
}

int frame_source_unwrap(frame_source *source, unwrap_mode mode, char *error, size_t error_size)
{
    if (mode == UNWRAP_NOT)
        return 0;
    source->unwrap = unwrap_create(mode);
    if (source->unwrap)
        return want_columns(source, error, error_size);
    snprintf(error, error_size, "out of memory");
    return -1;
}

static int bind_formulas(frame_source *source, char *error, size_t error_size)
{
    for (uint32_t i = 0; i < source->formula_count; i++)
        if (expression_bind(source->formulas[i], &source->frame, source->speed, error, error_size))
            return -1;
    return 1;
}

/* The next frame, its molecules put together. Results as those of trajectory_status. */
static int read_places(frame_source *source, cgt_trajectory_frame *frame, char *error, size_t error_size)
{
    int result = frame_keep_read(&source->keep, source->file, frame, error, error_size), endless = 0;
    if (result != 1 || !source->unwrap)
        return result;
    result = unwrap_frame(source->unwrap, frame, &endless, error, error_size) ? -1 : 1;
    if (endless && !source->is_endless)
        program_error("warning: frame %llu has a molecule that is bonded to its own image: it stays as it is",
                      (unsigned long long)frame->number);
    source->is_endless |= endless;
    if (unwrap_follows(source->unwrap) && !source->is_followed)
        program_error("--unwrap: no image flags: spheres are followed from frame to frame through the boundaries");
    source->is_followed |= unwrap_follows(source->unwrap);
    return result;
}

/* Reads one frame and, with a tracker, its speeds. */
static int read_frame(frame_source *source, char *error, size_t error_size)
{
    const int result = read_places(source, &source->frame, error, error_size);
    const char *warning;
    while ((warning = cgt_trajectory_take_warning(source->file)) != NULL)
        program_error("warning: %s", warning);
    source->speed = NULL;
    if (result != 1)
        return result;
    if (source->trails && source->frame.kind == CGT_TRAJECTORY_SPHERES &&
        trail_history_add(source->trails, &source->frame)) {
        snprintf(error, error_size, "out of memory for the trails of frame %llu",
                 (unsigned long long)source->frame.number);
        return -1;
    }
    if (!source->tracker || speed_next(source->tracker, &source->frame, &source->speed, &source->speed_from) == 0)
        return bind_formulas(source, error, error_size);
    snprintf(error, error_size, "out of memory for the speeds of frame %llu", (unsigned long long)source->frame.number);
    return -1;
}

/* How many frames before one must be read to know all about it. */
static uint64_t frames_before(const frame_source *source)
{
    const uint64_t speeds = source->tracker != NULL, trails = source->trails ? trail_history_length(source->trails) : 0;
    if (source->unwrap && unwrap_needs_all(source->unwrap))
        return UINT64_MAX;
    return speeds > trails ? speeds : trails;
}

static int skip_frame(frame_source *source, char *error, size_t error_size)
{
    if (source->trails)
        trail_history_restart(source->trails); /* its frames follow each other */
    return frame_keep_skip(&source->keep, source->file, error, error_size);
}

/* After the first frame: finds its speeds from the second, and goes back. Returns 1, or -1 with a text. */
static int look_ahead(frame_source *source, char *error, size_t error_size)
{
    cgt_trajectory_frame second;
    source->looks_ahead = 0;
    if (!source->tracker || source->frame.velocity || !cgt_trajectory_can_rewind(source->file))
        return 1;
    if (read_places(source, &second, error, error_size) == 1 && speed_look_ahead(source->tracker, &second)) {
        snprintf(error, error_size, "out of memory for the speeds of frame 0");
        return -1;
    }
    return frame_source_rewind(source, error, error_size) ? -1 : read_frame(source, error, error_size);
}

int frame_source_read(frame_source *source, uint64_t number, char *error, size_t error_size)
{
    int result = 1;
    while (result == 1 && source->next < number) {
        const int needed = number - source->next <= frames_before(source);
        result = needed ? read_frame(source, error, error_size) : skip_frame(source, error, error_size);
        source->next += result == 1;
    }
    if (result == 1)
        result = read_frame(source, error, error_size);
    if (result == 1 && source->looks_ahead && source->frame.number == 0)
        result = look_ahead(source, error, error_size);
    source->next += result == 1;
    return result;
}
