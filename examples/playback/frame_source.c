/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run; see frame_source.h. */
#include "playback/frame_source.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/program.h"

int frame_source_open(frame_source *source, const char *const *paths, size_t count, const trajectory_options *options,
                      int with_speed, char *error, size_t error_size)
{
    memset(source, 0, sizeof *source);
    source->file = trajectory_open_series(paths, count, options, error, error_size);
    if (!source->file)
        return -1;
    if (with_speed) {
        source->tracker = speed_create();
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
    speed_release(source->tracker);
    trajectory_close(source->file);
    memset(source, 0, sizeof *source);
}

int frame_source_rewind(frame_source *source, char *error, size_t error_size)
{
    if (source->tracker)
        speed_restart(source->tracker);
    source->next = 0;
    return trajectory_rewind(source->file, error, error_size);
}

uint64_t frame_range_count(const frame_range *range, uint64_t total)
{
    const uint64_t end = total > 0 && range->last < total - 1 ? range->last + 1 : total;
    return end > range->first ? (end - 1 - range->first) / range->every + 1 : 0;
}

/* Reads one frame and, with a tracker, its speeds. */
static int read_frame(frame_source *source, char *error, size_t error_size)
{
    const int result = trajectory_read(source->file, &source->frame, error, error_size);
    const char *warning;
    while ((warning = trajectory_take_warning(source->file)) != NULL)
        program_error("warning: %s", warning);
    source->speed = NULL;
    if (result != 1 || !source->tracker)
        return result;
    if (speed_next(source->tracker, &source->frame, &source->speed, &source->speed_from) == 0)
        return 1;
    snprintf(error, error_size, "out of memory for the speeds of frame %llu", (unsigned long long)source->frame.number);
    return -1;
}

int frame_source_read(frame_source *source, uint64_t number, char *error, size_t error_size)
{
    int result = 1;
    while (result == 1 && source->next < number) {
        const int needed = source->tracker != NULL && source->next + 1 == number;
        result = needed ? read_frame(source, error, error_size) : trajectory_skip(source->file, error, error_size);
        source->next += result == 1;
    }
    if (result == 1)
        result = read_frame(source, error, error_size);
    source->next += result == 1;
    return result;
}

static int finite_point(const float p[3]) { return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]); }

/* Extends the bounds by a box of half edge `reach` around a point. */
static void bound_point(survey *s, const float p[3], float reach)
{
    for (int c = 0; c < 3; c++) {
        s->bounds_min[c] = fminf(s->bounds_min[c], p[c] - reach);
        s->bounds_max[c] = fmaxf(s->bounds_max[c], p[c] + reach);
    }
}

static void survey_sphere(survey *s, const float sphere[4])
{
    if (!finite_point(sphere) || !isfinite(sphere[3]) || sphere[3] < 0.0f)
        return;
    s->drawable++;
    bound_point(s, sphere, sphere[3]);
}

/* Vertices that no triangle uses are invisible and do not count. */
static void survey_triangle(survey *s, const float *position, const uint32_t index[3])
{
    const float *vertex[3];
    for (int k = 0; k < 3; k++) {
        vertex[k] = position + 3 * (size_t)index[k];
        if (!finite_point(vertex[k]))
            return;
    }
    s->drawable++;
    for (int k = 0; k < 3; k++)
        bound_point(s, vertex[k], 0.0f);
}

static void survey_names(survey *s, const trajectory_frame *frame, uint32_t i)
{
    const uint32_t id = frame->id ? frame->id[i] : i;
    s->id_min = id < s->id_min ? id : s->id_min;
    s->id_max = id > s->id_max ? id : s->id_max;
    if (!frame->type)
        return;
    s->type_min = frame->type[i] < s->type_min ? frame->type[i] : s->type_min;
    s->type_max = frame->type[i] > s->type_max ? frame->type[i] : s->type_max;
}

static void survey_frame(survey *s, const frame_source *source)
{
    const trajectory_frame *frame = &source->frame;
    const uint32_t primitives = frame_primitives(frame);
    s->frames++;
    s->kind = frame->kind;
    s->has_type |= frame->type != NULL;
    for (uint32_t i = 0; i < primitives; i++) {
        survey_names(s, frame, i);
        if (frame->kind == TRAJECTORY_TRIANGLES)
            survey_triangle(s, frame->position, frame->index + 3 * (size_t)i);
        else
            survey_sphere(s, frame->xyzr + 4 * (size_t)i);
    }
    for (uint32_t i = 0; source->speed && i < frame->count; i++) {
        uint32_t bits;
        if (!isfinite(source->speed[i]))
            continue;
        memcpy(&bits, &source->speed[i], sizeof bits);
        s->speed_bins[(bits & 0x7FFFFFFFu) >> 19]++;
        s->speeds++;
    }
}

static void begin_survey(survey *s)
{
    memset(s, 0, sizeof *s);
    s->id_min = s->type_min = UINT32_MAX;
    for (int c = 0; c < 3; c++) {
        s->bounds_min[c] = INFINITY;
        s->bounds_max[c] = -INFINITY;
    }
}

enum { SURVEY_RUN = 16 }; /* consecutive frames that one part looks at: for speeds the frame before them is read, too */

/* Looks at the frame `number`, or skips it where it is another part's or beyond those that are wanted. Results as those
 * of frame_source_read. */
static int visit(frame_source *source, const survey_plan *plan, uint64_t number, survey *result, char *error,
                 size_t error_size)
{
    const int mine = plan->parts < 2 || number / SURVEY_RUN % plan->parts == plan->part;
    if (number < plan->most && mine) {
        const int state = frame_source_read(source, number, error, error_size);
        if (state == 1)
            survey_frame(result, source);
        return state;
    }
    /* the first of a run needs the positions of the frame before it */
    const uint64_t next = number + 1;
    if (source->tracker && next < plan->most && next % SURVEY_RUN == 0 &&
        (plan->parts < 2 || next / SURVEY_RUN % plan->parts == plan->part))
        return frame_source_read(source, number, error, error_size);
    const int state = trajectory_skip(source->file, error, error_size);
    source->next += state == 1;
    return state;
}

int survey_run(frame_source *source, const survey_plan *plan, survey *result, char *error, size_t error_size)
{
    program_progress progress;
    int state = 1;
    uint64_t number = 0;
    begin_survey(result);
    program_progress_start(&progress, "reading", "frames", 0.0, plan->quiet);
    while (!*plan->stop && (plan->count || number < plan->most)) {
        state = visit(source, plan, number, result, error, error_size);
        if (state != 1)
            break;
        number++;
        program_progress_update(&progress, (double)number, trajectory_progress(source->file));
    }
    program_progress_end(&progress);
    if (*plan->stop) {
        snprintf(error, error_size, "interrupted");
        return -1;
    }
    result->has_total = state != 1;
    result->total = number;
    result->is_cut = state < 0;
    result->parts = plan->parts;
    /* A file that is cut off, or still being written, is good for its whole frames: the error comes again after them. */
    return state < 0 && number == 0 ? -1 : frame_source_rewind(source, error, error_size);
}

void survey_merge(survey *sum, const survey *part)
{
    sum->frames += part->frames;
    sum->total = part->total < sum->total ? part->total : sum->total;
    sum->is_cut |= part->is_cut;
    sum->kind = part->frames ? part->kind : sum->kind;
    sum->drawable += part->drawable;
    sum->has_type |= part->has_type;
    sum->id_min = part->id_min < sum->id_min ? part->id_min : sum->id_min;
    sum->id_max = part->id_max > sum->id_max ? part->id_max : sum->id_max;
    sum->type_min = part->type_min < sum->type_min ? part->type_min : sum->type_min;
    sum->type_max = part->type_max > sum->type_max ? part->type_max : sum->type_max;
    for (int c = 0; c < 3; c++) {
        sum->bounds_min[c] = fminf(sum->bounds_min[c], part->bounds_min[c]);
        sum->bounds_max[c] = fmaxf(sum->bounds_max[c], part->bounds_max[c]);
    }
    sum->speeds += part->speeds;
    for (int bin = 0; bin < SURVEY_BINS; bin++)
        sum->speed_bins[bin] += part->speed_bins[bin];
}

float survey_speed_quantile(const survey *s, double share)
{
    uint64_t below = 0;
    for (uint32_t bin = 0; bin < SURVEY_BINS; bin++) {
        below += s->speed_bins[bin];
        if (below == 0 || (double)below < share * (double)s->speeds)
            continue;
        const uint32_t bits = ((bin + 1) << 19) - 1; /* the largest float of the bin */
        float speed;
        memcpy(&speed, &bits, sizeof speed);
        return bin ? speed : 0.0f; /* bin 0: zero and the smallest denormals */
    }
    return 0.0f;
}
