/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The set-up of cgt-render; see render_setup.h. */
#define _POSIX_C_SOURCE 200809L
#include "render/render_setup.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/render_input.h"

int render_fail(renderer *r)
{
    program_error("%s", r->error);
    return -1;
}

int render_result(renderer *r, int result)
{
    const char *notice;
    while ((notice = cgt_notices_take(&r->figure.notices)) != NULL)
        program_error("%s", notice);
    if (result)
        program_error("%s", r->figure.message);
    return result;
}

static int make_folders(renderer *r)
{
    const render_options *o = &r->options;
    char name[4096];
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (render_output_kind(o->outputs[i].pattern) == OUTPUT_RAW)
            continue;
        if (out_path_name(&o->outputs[i], 0, name, sizeof name)) {
            program_error("%s: the name is too long", o->outputs[i].pattern);
            return -1;
        }
        if (out_path_make_folder(name, r->error, sizeof r->error))
            return render_fail(r);
    }
    if ((o->contact_sheet && out_path_make_folder(o->contact_sheet, r->error, sizeof r->error)) ||
        (o->log_file && out_path_make_folder(o->log_file, r->error, sizeof r->error)))
        return render_fail(r);
    return 0;
}

/* Whether an output or the camera's path needs the number of frames. */
static int needs_count(const render_options *o)
{
    int needs = o->figure.orbit != 0.0f || o->contact_sheet || o->output.parts > 1;
    for (uint32_t i = 0; i < o->output_count; i++)
        needs |= !o->outputs[i].numbered && render_output_kind(o->outputs[i].pattern) == OUTPUT_PICTURE;
    return needs;
}

/* The number of chosen frames, where it is known. A run that grows, or ends in an error, has no end before its readers
 * say so. */
static int choose_frames(renderer *r)
{
    const render_options *o = &r->options;
    const uint64_t chosen = frame_range_count(&o->range, r->figure.survey.total);
    r->count = UINT64_MAX;
    if (!r->figure.has_survey || !r->figure.survey.has_total)
        return 0;
    if (chosen == 0) {
        program_error("%s: there is no frame%s", o->input,
                      o->range.first || o->range.last != UINT64_MAX - 1 ? " in the range from --first to --last" : "");
        return -1;
    }
    for (uint32_t i = 0; i < o->output_count; i++)
        if (!o->outputs[i].numbered && render_output_kind(o->outputs[i].pattern) == OUTPUT_PICTURE && chosen > 1) {
            program_error("%s: the name needs a %%04d, there are %" PRIu64 " frames", o->outputs[i].pattern, chosen);
            return -1;
        }
    r->count = chosen;
    if (o->output.parts > 1) { /* part * chosen / parts, without a product that could overflow */
        const uint64_t parts = o->output.parts, part = o->output.part;
        const uint64_t whole = chosen / parts, rest = chosen % parts;
        r->begin = whole * (part - 1) + rest * (part - 1) / parts;
        r->count = whole * part + rest * part / parts - r->begin;
        if (r->count == 0) {
            program_error("%s: part %" PRIu64 " of %" PRIu64 " of %" PRIu64 " frames has none", o->input, part, parts,
                          chosen);
            return -1;
        }
    }
    return 0;
}

/* What must be known of the input: a look at its first frame, and where that does not tell, at all. */
static int survey_input(renderer *r)
{
    render_options *o = &r->options;
    cgt_figure *const figure = &r->figure;
    survey_plan plan = {.most = cgt_figure_needs_frames(figure, o->output.survey),
                        .count = needs_count(o),
                        .quiet = o->quiet,
                        .stop = r->stop,
                        .context = r->context};
    if (plan.most == 0 && !plan.count)
        return 0;
    plan.fit = cgt_figure_begin_fit(figure);
    cgt_trajectory_set_follow(r->source.file, 0.0); /* the survey takes what is there */
    figure->has_survey = 1;
    if (plan.most == 1 && survey_run(&r->source, &plan, &figure->survey, r->error, sizeof r->error))
        return render_fail(r);
    if (plan.most == 1 && !cgt_figure_is_decided(figure))
        plan.most = o->output.survey;
    if (plan.most != 1 && survey_run(&r->source, &plan, &figure->survey, r->error, sizeof r->error))
        return render_fail(r);
    cgt_trajectory_set_follow(r->source.file, o->reading.follow);
    return 0;
}

static int open_figure(renderer *r)
{
    cgt_figure *const figure = &r->figure;
    figure->options = r->options.figure;
    figure->context = r->context;
    figure->stop = stop_flag_is_set;
    figure->stop_user = r->stop;
    figure->has_origin = r->options.reading.has_origin;
    return render_result(r, cgt_figure_open(figure));
}

static int open_first(renderer *r)
{
    render_options *o = &r->options;
    if (open_figure(r))
        return -1;
    render_choose_reading(o, r->context,
                          cgt_figure_needs_frames(&r->figure, o->output.survey) > 0 || needs_count(o) ||
                              r->figure.sequence.tracker,
                          r->stop);
    r->figure.source = o->input;
    if (frame_source_open(&r->source, &r->figure.sequence, o->inputs, o->input_count, &o->reading, r->error,
                          sizeof r->error))
        return render_fail(r);
    r->source.keep.most = (size_t)o->memory_mib * (1024 * 1024);
    if (frame_source_want_columns(&r->source, r->error, sizeof r->error))
        return render_fail(r);
    cgt_trajectory_get_origin(r->source.file, r->figure.origin);
    if (cgt_figure_choose_camera_origin(&r->figure))
        cgt_trajectory_set_origin(r->source.file, r->figure.origin);
    render_result(r, 0);
    return survey_input(r);
}

/* The mesh's first frame, which stays as long as the file is open. */
static int open_mesh(renderer *r)
{
    cgt_trajectory_frame mesh;
    if (!r->options.mesh)
        return 0;
    if (render_read_mesh(&r->options, r->figure.origin, &r->mesh, &mesh))
        return -1;
    return render_result(r, cgt_figure_scene_mesh(&r->figure, &mesh));
}

static int open_report(renderer *r)
{
    return render_report_open(&r->report, r->options.log_file, r->error, sizeof r->error) ? render_fail(r) : 0;
}

static int open_input(renderer *r)
{
    if (make_folders(r) || open_report(r) || open_first(r))
        return -1;
    if (cgt_figure_choose_bulk_origin(&r->figure)) {
        cgt_trajectory_set_origin(r->source.file, r->figure.origin);
        render_result(r, 0);
        if (frame_source_rewind(&r->source, r->error, sizeof r->error))
            return render_fail(r);
        if (survey_input(r))
            return -1;
    }
    if (render_result(r, cgt_figure_move_cameras(&r->figure)))
        return -1;
    return choose_frames(r);
}

static int prepare_pictures(renderer *r)
{
    const render_options *o = &r->options;
    if (o->figure.bounce.is_set && o->cell.mode) {
        program_error("--bounces and --cell exclude each other");
        return -1;
    }
    if (o->figure.bounce.is_set && o->stats) {
        program_error("--stats counts the camera's rays, and with --bounces those are the fewest");
        return -1;
    }
    if (o->contact_sheet)
        r->sheet = contact_sheet_create(o->sheet_columns, o->sheet_rows, r->count, o->figure.width, o->figure.height);
    if (o->contact_sheet && !r->sheet) {
        program_error("out of memory for a contact sheet of pictures of %" PRIu32 "x%" PRIu32 " pixels",
                      o->figure.width, o->figure.height);
        return -1;
    }
    return render_picture_setup(r);
}

/* Refuses options that do not fit the kind of the file's first frame; user: the renderer. */
static int check_kind(void *user, const cgt_trajectory_frame *frame)
{
    const renderer *const r = user;
    const render_options *o = &r->options;
    const int is_wrong =
        frame->kind == CGT_TRAJECTORY_TRIANGLES && r->figure.coloring.by == COLORING_TYPE && !frame->type;
    if (is_wrong)
        program_error("%s: --color type: the triangles of this file have no types; id, speed, height or RRGGBB will do",
                      o->input);
    if (is_wrong || render_check_reading(o, frame->kind))
        return -1;
    char bonds[256];
    const int failed = cgt_figure_check_bonds(&o->figure, frame, bonds, sizeof bonds);
    if (*bonds)
        program_error("%s", bonds);
    return failed;
}

/* The end of the chosen frames that this run may render; UINT64_MAX: where the input ends. */
static uint64_t end_of_frames(const renderer *r)
{
    const frame_range *range = &r->options.range;
    const uint64_t known = r->count > UINT64_MAX - r->begin ? UINT64_MAX : r->begin + r->count;
    const int open_end = r->options.reading.follow > 0.0 || (r->figure.has_survey && r->figure.survey.is_cut);
    const int last_part = r->options.output.part == r->options.output.parts;
    const uint64_t end = open_end && last_part ? UINT64_MAX : known;
    /* --last holds where nobody knows how many frames there are, too */
    const uint64_t limit = range->last == UINT64_MAX - 1 ? UINT64_MAX : frame_range_count(range, UINT64_MAX);
    return end < limit ? end : limit;
}

/* The threads that read and write. */
static int start_threads(renderer *r)
{
    render_reader *const reader = &r->reader;
    render_writer *const writer = &r->writer;
    writer->options = &r->options;
    writer->sheet = r->sheet;
    writer->stop = r->stop;
    writer->threads = cgt_context_get_threads(r->context);
    writer->first_chosen = r->begin;
    writer->texts = r->texts;
    writer->text_count = r->text_count;
    if (render_writer_start(writer))
        return -1;
    if (r->figure.options.particles.trails &&
        !(r->figure.sequence.trails = cgt_trail_history_create(r->figure.options.particles.trails))) {
        program_error("out of memory for the trails");
        return -1;
    }
    r->source.looks_ahead = 1;
    reader->source = &r->source;
    reader->coloring = r->figure.coloring; /* its index goes along */
    r->figure.coloring.index = NULL;
    reader->range = r->options.range;
    reader->next = r->begin;
    reader->end = end_of_frames(r);
    reader->stop = r->stop;
    reader->check = check_kind;
    reader->user = r;
    reader->figure = &r->figure;
    return render_reader_start(reader);
}

int render_setup(renderer *r)
{
    r->summary = stdout;
    for (uint32_t i = 0; i < r->options.output_count; i++)
        if (render_output_kind(r->options.outputs[i].pattern) == OUTPUT_RAW)
            r->summary = stderr;
    cgt_figure *const figure = &r->figure;
    if (render_create_context(&r->options, &r->context) || open_input(r) ||
        render_result(r, cgt_figure_choose_colors(figure)) || open_mesh(r) ||
        render_result(r, cgt_figure_choose_camera(figure)) || render_result(r, cgt_figure_settle(figure)) ||
        prepare_pictures(r))
        return -1;
    if (r->options.cell.mode && render_cell_create(r))
        return -1;
    return start_threads(r);
}

void render_close(renderer *r)
{
    render_reader_finish(&r->reader);
    render_cell_release(r->cell);
    free(r->settings);
    free(r->options.settings);
    cgt_coloring_free(&r->reader.coloring);
    frame_source_close(&r->source);
    cgt_figure_close(&r->figure);
    cgt_trajectory_close(r->mesh);
    cgt_context_release(r->context);
    contact_sheet_release(r->sheet);
}
