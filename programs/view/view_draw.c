/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The viewer's input and figure; see view_draw.h. */
#define _POSIX_C_SOURCE 200809L
#include "view/view_draw.h"

#include <stdlib.h>
#include <sys/stat.h>

#include "common/program.h"
#include "render/render_input.h"

static int fail(const char *sentence)
{
    program_error("%s", sentence);
    return -1;
}

int view_draw_tell(view_draw *d, cgt_result result)
{
    const char *notice;
    char text[PROGRAM_ERROR_SIZE];
    while ((notice = cgt_figure_take_notice(d->figure)) != NULL)
        program_error("%s", notice);
    if (result == CGT_OK || result == CGT_ERROR_STOPPED)
        return result == CGT_OK ? 0 : 1;
    cgt_figure_get_error_message(d->figure, text, sizeof text);
    return fail(text);
}

char *view_draw_get(const view_draw *d, view_draw_getter *get, const char *name)
{
    const size_t size = get(d->figure, name, NULL, 0) + 1;
    char *const text = malloc(size);
    if (text)
        get(d->figure, name, text, size);
    else
        program_error("out of memory");
    return text;
}

int view_draw_has(const view_draw *d, const char *name) { return cgt_figure_get(d->figure, name, NULL, 0) > 0; }

/* ---- Opening ------------------------------------------------------------------------------------------------ */

/* All frames of small files, and where a legend names what any frame has, a floor lies below all, glass is as dark as
 * the run is large; else the first few: the window is to open at once. */
static uint64_t choose_survey(const render_options *o)
{
    const uint64_t few = 4;
    const off_t small = 32 << 20; /* bytes */
    off_t bytes = 0;
    struct stat info;
    if (o->output.survey != VIEW_SURVEY_AUTO)
        return o->output.survey;
    if (o->figure.picture.legend || o->figure.picture.bar || o->figure.floor.is_set || o->figure.bounce.is_set)
        return UINT64_MAX;
    for (size_t i = 0; i < o->input_count; i++)
        bytes += stat(o->inputs[i], &info) == 0 && S_ISREG(info.st_mode) ? info.st_size : small + 1;
    return bytes <= small ? UINT64_MAX : few;
}

static int open_input(view_draw *d)
{
    render_options *const o = &d->options;
    char error[PROGRAM_ERROR_SIZE];
    render_choose_reading(o, d->context, 1, &d->stop);
    cgt_figure_set_source(d->figure, o->input);
    if (frame_source_open(&d->source, &d->raw, o->inputs, o->input_count, &o->reading, error, sizeof error))
        return fail(error);
    d->source.keep.most = render_memory(o);
    cgt_trajectory_get_origin(d->source.file, d->origin);
    const int state = figure_run_want_all(&d->source, error, sizeof error);
    if (state < 0)
        return fail(error);
    return state ? render_check_reading(o, d->raw.frame.kind) : 0;
}

static int set_mesh(view_draw *d)
{
    cgt_trajectory_frame frame;
    const cgt_figure_data mesh = {.frame = &frame};
    if (!d->options.mesh)
        return 0;
    cgt_trajectory_close(d->mesh);
    d->mesh = NULL;
    if (render_read_mesh(&d->options, d->origin, &d->mesh, &frame))
        return -1;
    return view_draw_tell(d, cgt_figure_set_mesh(d->figure, &mesh));
}

/* Again, where all lies far from 0. */
static int survey_input(view_draw *d)
{
    const render_options *const o = &d->options;
    char error[PROGRAM_ERROR_SIZE];
    d->survey = (survey_walk){.most = choose_survey(o), .quiet = o->quiet, .stop = &d->stop};
    for (;;) {
        if (set_mesh(d))
            return -1;
        cgt_trajectory_set_follow(d->source.file, 0.0); /* the survey takes what is there */
        const int failed = figure_run_look(d->figure, &d->source, &d->survey, error, sizeof error);
        cgt_trajectory_set_follow(d->source.file, o->reading.follow);
        view_draw_tell(d, CGT_OK);
        if (failed)
            return fail(error);
        if (o->reading.has_origin || d->has_moved || !cgt_figure_get_origin(d->figure, d->origin))
            break;
        d->has_moved = 1;
        view_draw_tell(d, CGT_OK);
        cgt_trajectory_set_origin(d->source.file, d->origin);
        if (frame_source_rewind(&d->source, error, sizeof error))
            return fail(error);
    }
    if (!d->survey.has_total || frame_range_count(&o->range, d->survey.total))
        return 0;
    program_error("%s: there is no frame%s", o->input,
                  o->range.first || o->range.last != UINT64_MAX - 1 ? " in the range from --first to --last" : "");
    return -1;
}

view_draw *view_draw_create(const view_options *options)
{
    view_draw *const d = calloc(1, sizeof *d);
    if (d)
        d->options = options->render;
    else
        program_error("out of memory");
    return d;
}

int view_draw_open(view_draw *d)
{
    uint64_t lead;
    return render_create_context(&d->options, &d->context) == 0 &&
                   cgt_figure_create(d->context, &d->figure) == CGT_OK &&
                   view_draw_tell(d, figure_run_set(d->figure, d->options.settings)) == 0 && open_input(d) == 0 &&
                   survey_input(d) == 0 && view_draw_tell(d, cgt_figure_begin_keep(d->figure, &lead)) == 0 &&
                   (d->shows = view_draw_get(d, cgt_figure_get, "show")) != NULL
               ? 0
               : -1;
}

void view_draw_stop(view_draw *d)
{
    if (d)
        d->stop = 1;
}

void view_draw_close(view_draw *d)
{
    if (!d)
        return;
    frame_source_close(&d->source);
    cgt_trajectory_close(d->mesh);
    cgt_figure_release(d->figure);
    cgt_context_release(d->context);
    free(d->options.settings);
    free(d->shows);
    free(d);
}

view_frames *view_draw_start_frames(view_draw *d, size_t memory, void (*wake)(void *user), void *user)
{
    const render_options *const o = &d->options;
    const view_frames_options options = {.figure = d->figure,
                                         .paths = o->inputs,
                                         .path_count = o->input_count,
                                         .reading = &o->reading,
                                         .range = o->range,
                                         .memory = memory,
                                         .total = d->survey.has_total ? d->survey.total : 0,
                                         .wake = wake,
                                         .user = user};
    return view_frames_start(&d->source, &options);
}
