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
    while ((notice = cgt_figure_take_notice(r->figure)) != NULL)
        program_error("%s", notice);
    if (result)
        program_error("%s", r->figure->message);
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
    const uint64_t chosen = frame_range_count(&o->range, r->survey.total);
    r->count = UINT64_MAX;
    if (!r->survey.has_total)
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

static int open_figure(renderer *r)
{
    const cgt_result result = cgt_figure_create(r->context, &r->figure);
    if (result || !r->options.settings) {
        program_error("out of memory");
        return -1;
    }
    cgt_figure_set_stop(r->figure, stop_flag_is_set, r->stop);
    return render_result(r, figure_run_set(r->figure, r->options.settings) || cgt_figure_open(r->figure) ? -1 : 0);
}

static int open_source(renderer *r)
{
    render_options *o = &r->options;
    render_choose_reading(o, r->context,
                          cgt_figure_needs_frames(r->figure, o->output.survey) > 0 || needs_count(o) ||
                              r->figure->sequence.tracker,
                          r->stop);
    cgt_figure_set_source(r->figure, o->input);
    if (frame_source_open(&r->source, &r->figure->sequence, o->inputs, o->input_count, &o->reading, r->error,
                          sizeof r->error))
        return render_fail(r);
    r->source.keep.most = render_memory(o);
    return frame_source_want_columns(&r->source, r->error, sizeof r->error) ? render_fail(r) : 0;
}

/* A mesh that stands still, less the frames' origin. */
static int set_mesh(renderer *r, const double origin[3])
{
    cgt_trajectory *file = NULL;
    cgt_trajectory_frame frame;
    const cgt_figure_data mesh = {.frame = &frame};
    int failed = r->options.mesh && render_read_mesh(&r->options, origin, &file, &frame);
    if (!failed && file)
        failed = render_result(r, cgt_figure_set_mesh(r->figure, &mesh) ? -1 : 0);
    cgt_trajectory_close(file);
    return failed;
}

/* What must be known of the input: a look at its first frame, and where that does not tell, at all. */
static int survey_input(renderer *r)
{
    const render_options *const o = &r->options;
    frame_sequence raw = {.unwrap = NULL}; /* the figure takes the frames */
    const int looks = cgt_figure_needs_frames(r->figure, o->output.survey) > 0;
    r->survey = (survey_walk){
        .most = looks ? o->output.survey : 0, .count = needs_count(o), .quiet = o->quiet, .stop = r->stop};
    if (!looks && !r->survey.count)
        return 0;
    cgt_trajectory_set_follow(r->source.file, 0.0); /* it takes what is there */
    r->source.sequence = &raw;
    const int failed = figure_run_look(r->figure, &r->source, &r->survey, r->error, sizeof r->error);
    r->source.sequence = &r->figure->sequence;
    cgt_frame_sequence_restart(r->source.sequence);
    cgt_trajectory_set_follow(r->source.file, o->reading.follow);
    render_result(r, 0);
    return failed ? render_fail(r) : 0;
}

static int open_report(renderer *r)
{
    return render_report_open(&r->report, r->options.log_file, r->error, sizeof r->error) ? render_fail(r) : 0;
}

/* Again, where all lies far from 0. */
static int open_input(renderer *r)
{
    double origin[3];
    if (make_folders(r) || open_report(r) || open_figure(r) || open_source(r))
        return -1;
    cgt_trajectory_get_origin(r->source.file, origin);
    for (int has_origin = r->options.reading.has_origin;; has_origin = 1) {
        if (set_mesh(r, origin) || survey_input(r))
            return -1;
        memcpy(r->figure->origin, origin, sizeof origin); /* also where nothing was looked at */
        if (has_origin || !cgt_figure_get_origin(r->figure, origin))
            break;
        cgt_trajectory_set_origin(r->source.file, origin);
        render_result(r, 0);
        if (frame_source_rewind(&r->source, r->error, sizeof r->error))
            return render_fail(r);
    }
    if (choose_frames(r) || render_result(r, cgt_figure_open(r->figure)) ||
        render_result(r, cgt_figure_choose(r->figure, NULL)))
        return -1;
    r->figure->survey.has_total = r->survey.has_total; /* an orbit is over all */
    r->figure->survey.total = r->survey.total;
    return 0;
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
        frame->kind == CGT_TRAJECTORY_TRIANGLES && r->figure->coloring.by == COLORING_TYPE && !frame->type;
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
    const int open_end = r->options.reading.follow > 0.0 || r->survey.is_cut;
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
    r->source.looks_ahead = 1;
    reader->source = &r->source;
    reader->coloring = r->figure->coloring; /* its index goes along */
    r->figure->coloring.index = NULL;
    reader->range = r->options.range;
    reader->next = r->begin;
    reader->end = end_of_frames(r);
    reader->stop = r->stop;
    reader->check = check_kind;
    reader->user = r;
    reader->figure = r->figure;
    return render_reader_start(reader);
}

int render_setup(renderer *r)
{
    r->summary = stdout;
    for (uint32_t i = 0; i < r->options.output_count; i++)
        if (render_output_kind(r->options.outputs[i].pattern) == OUTPUT_RAW)
            r->summary = stderr;
    if (render_create_context(&r->options, &r->context) || open_input(r) || prepare_pictures(r))
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
    cgt_figure_release(r->figure);
    cgt_context_release(r->context);
    contact_sheet_release(r->sheet);
}
