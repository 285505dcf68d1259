/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run; see frame_source.h. Frames that are not selected are skipped unread, unless the speeds of
 * the next one need their positions. */
#include "playback/frame_source.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/program.h"

int frame_source_open(frame_source *source, const char *const *paths, size_t count, const trajectory_options *options,
                      const frame_range *range, int with_speed, char *error, size_t error_size)
{
    memset(source, 0, sizeof *source);
    source->range = *range;
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

static int is_selected(const frame_range *range, uint64_t number)
{
    return number >= range->first && number <= range->last && (number - range->first) % range->every == 0;
}

int frame_source_bind(frame_source *source, expression *formula, char *error, size_t error_size)
{
    const char *wanted[SOURCE_FORMULAS * 16];
    size_t count = 0;
    if (!formula)
        return 0;
    if (source->formula_count == SOURCE_FORMULAS) {
        snprintf(error, error_size, "more than %d formulas", SOURCE_FORMULAS);
        return -1;
    }
    source->formulas[source->formula_count++] = formula;
    for (uint32_t i = 0; i < source->formula_count; i++) {
        size_t names;
        const char *const *name = expression_names(source->formulas[i], &names);
        for (size_t k = 0; k < names && count < sizeof wanted / sizeof wanted[0]; k++)
            wanted[count++] = name[k];
    }
    return trajectory_want_columns(source->file, wanted, count, error, error_size);
}

static int bind_formulas(frame_source *source, char *error, size_t error_size)
{
    for (uint32_t i = 0; i < source->formula_count; i++)
        if (expression_bind(source->formulas[i], &source->frame, source->speed, error, error_size))
            return -1;
    return 1;
}

/* Reads one frame and, with a tracker, its speeds. */
static int read_frame(frame_source *source, char *error, size_t error_size)
{
    const int result = trajectory_read(source->file, &source->frame, error, error_size);
    const char *warning;
    while ((warning = trajectory_take_warning(source->file)) != NULL)
        program_error("warning: %s", warning);
    source->speed = NULL;
    if (result != 1)
        return result;
    if (!source->tracker || speed_next(source->tracker, &source->frame, &source->speed, &source->speed_from) == 0)
        return bind_formulas(source, error, error_size);
    snprintf(error, error_size, "out of memory for the speeds of frame %llu", (unsigned long long)source->frame.number);
    return -1;
}

int frame_source_next(frame_source *source, char *error, size_t error_size)
{
    while (source->next <= source->range.last) {
        const uint64_t number = source->next++;
        const int selected = is_selected(&source->range, number);
        const int precedes_selected =
            source->tracker && number + 1 >= source->range.first && is_selected(&source->range, number + 1);
        const int result = selected || precedes_selected ? read_frame(source, error, error_size)
                                                         : trajectory_skip(source->file, error, error_size);
        if (result != 1 || selected)
            return result;
    }
    return 0;
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
    bulk_add(&s->bulk, sphere, sphere[3]);
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
    bulk_add(&s->bulk, vertex[0], 0.0f);
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

/* The range of the first formula, which is that of the colours. */
static void survey_values(survey *s, const frame_source *source)
{
    enum { BLOCK = 256 };
    double values[BLOCK];
    const uint32_t count = source->formula_count ? source->frame.count : 0;
    for (uint32_t first = 0; first < count; first += BLOCK) {
        const uint32_t block = count - first < BLOCK ? count - first : BLOCK;
        expression_values(source->formulas[0], first, block, values);
        for (uint32_t i = 0; i < block; i++) {
            if (!isfinite(values[i]))
                continue;
            s->values++;
            s->value_min = fmin(s->value_min, values[i]);
            s->value_max = fmax(s->value_max, values[i]);
            if (values[i] > 0.0)
                s->value_least = fmin(s->value_least, values[i]);
        }
    }
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
    for (uint32_t i = 0; frame->element && !s->has_element && i < frame->count; i++)
        s->has_element = frame->element[i] != 0;
    survey_values(s, source);
    for (uint32_t i = 0; source->speed && i < frame->count; i++) {
        uint32_t bits;
        if (!isfinite(source->speed[i]))
            continue;
        memcpy(&bits, &source->speed[i], sizeof bits);
        s->speed_bins[(bits & 0x7FFFFFFFu) >> 19]++;
        s->speeds++;
    }
}

int survey_run(frame_source *source, survey *result, int quiet, const volatile sig_atomic_t *stop, char *error,
               size_t error_size)
{
    program_progress progress;
    int state;
    memset(result, 0, sizeof *result);
    result->id_min = result->type_min = UINT32_MAX;
    result->value_min = result->value_least = INFINITY;
    result->value_max = -INFINITY;
    for (int c = 0; c < 3; c++) {
        result->bounds_min[c] = INFINITY;
        result->bounds_max[c] = -INFINITY;
    }
    program_progress_start(&progress, "reading", "frames", 0.0, quiet);
    while ((state = frame_source_next(source, error, error_size)) == 1 && !*stop) {
        survey_frame(result, source);
        program_progress_update(&progress, (double)result->frames, trajectory_progress(source->file));
    }
    program_progress_end(&progress);
    if (state == 1) {
        snprintf(error, error_size, "interrupted");
        return -1;
    }
    /* A file that is cut off, or still being written, is good for its whole frames: the error comes again after them. */
    return state < 0 && result->frames == 0 ? -1 : frame_source_rewind(source, error, error_size);
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
