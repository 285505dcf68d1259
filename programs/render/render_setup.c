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
#include <sys/stat.h>

int render_fail(renderer *r)
{
    program_error("%s", r->error);
    return -1;
}

static int fail_frame(const renderer *r, const char *action, const char *message, cgt_result result)
{
    program_error("%s: frame %" PRIu64 ": cannot %s: %s", r->options.input, r->frame ? r->frame->number : 0, action,
                  *message ? message : cgt_get_result_string(result));
    return -1;
}

int render_fail_library(renderer *r, const char *action, cgt_result result)
{
    char message[512];
    cgt_context_get_error_message(r->context, message, sizeof message);
    return fail_frame(r, action, message, result);
}

int render_fail_picture(renderer *r, cgt_result result)
{
    char message[512];
    cgt_picture_get_error_message(r->drawing, message, sizeof message);
    return fail_frame(r, "trace", message, result);
}

static void on_log(void *user, cgt_log_level level, const char *message)
{
    static const char *const names[] = {"error", "warning", "info"};
    (void)user;
    program_error("%s: %s", level <= CGT_LOG_LEVEL_INFO ? names[level] : "log", message);
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

/* Whether types or elements are to be named, which are those of all frames. */
static int has_legend(const render_options *o)
{
    return (o->figure.picture.legend || o->figure.picture.bar) &&
           (o->figure.by == COLORING_AUTO || o->figure.by == COLORING_TYPE || o->figure.by == COLORING_ELEMENT);
}

/* How many frames must be looked at before the first is rendered: all, the first, which tells the kind and whether
 * there are types, or none. */
static uint64_t needs_frames(const render_options *o)
{
    const int measured = o->figure.by != COLORING_TYPE && o->figure.by != COLORING_PLAIN &&
                         o->figure.by != COLORING_AUTO && o->figure.by != COLORING_ELEMENT;
    if (!o->figure.has_camera || (measured && !o->figure.has_range) ||
        (o->figure.floor.is_set && !o->figure.floor.has_place))
        return o->output.survey;
    if (has_legend(o))
        return o->output.survey;
    /* the up axis depends on the kind, and meshes of glass are as dark as they are large */
    return o->figure.by == COLORING_AUTO || o->figure.by == COLORING_HEIGHT || o->figure.bounce.count;
}

/* The number of chosen frames, where it is known. A run that grows, or ends in an error, has no end before its readers
 * say so. */
static int choose_frames(renderer *r)
{
    const render_options *o = &r->options;
    const uint64_t chosen = frame_range_count(&o->range, r->survey.total);
    r->count = UINT64_MAX;
    if (!r->has_survey || !r->survey.has_total)
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

/* Looks at the first frame, which may be enough for automatic colours: 1 where it is. */
static int is_decided(const renderer *r)
{
    const survey *s = &r->survey;
    if (s->kind == CGT_TRAJECTORY_TRIANGLES && r->options.figure.bounce.count)
        return 0;
    return r->options.figure.by != COLORING_AUTO || s->kind == CGT_TRAJECTORY_TRIANGLES || s->has_element ||
           s->type_max > s->type_min;
}

/* What the automatic camera asks of the survey, before the kind of the file is known. */
static void begin_fit(renderer *r)
{
    for (int kind = 0; kind < 2; kind++) {
        render_options o = r->options;
        figure_options_axes(&o.figure, kind ? CGT_TRAJECTORY_TRIANGLES : CGT_TRAJECTORY_SPHERES);
        cgt_camera_directions_set(&r->fit[kind], o.figure.view, o.figure.up, o.figure.fov,
                                  (double)o.figure.width / (double)o.figure.height, (double)o.figure.orbit,
                                  o.figure.picture.ortho);
    }
}

/* What must be known of the input: a look at its first frame, and where that does not tell, at all. */
static int survey_input(renderer *r)
{
    render_options *o = &r->options;
    survey_plan plan = {
        .most = needs_frames(o), .count = needs_count(o), .quiet = o->quiet, .stop = r->stop, .context = r->context};
    if (plan.most == 0 && !plan.count)
        return 0;
    if (!o->figure.has_camera) {
        begin_fit(r);
        plan.fit = r->fit;
    }
    cgt_trajectory_set_follow(r->source.file, 0.0); /* the survey takes what is there */
    r->has_survey = 1;
    if (plan.most == 1 && survey_run(&r->source, &plan, &r->survey, r->error, sizeof r->error))
        return render_fail(r);
    if (plan.most == 1 && !is_decided(r))
        plan.most = o->output.survey;
    if (plan.most != 1 && survey_run(&r->source, &plan, &r->survey, r->error, sizeof r->error))
        return render_fail(r);
    cgt_trajectory_set_follow(r->source.file, o->reading.follow);
    return 0;
}

static int open_first(renderer *r)
{
    render_options *o = &r->options;
    if (o->figure.by == COLORING_VALUE &&
        !(r->formula = expression_parse(o->figure.formula, r->error, sizeof r->error)))
        return render_fail(r);
    const int with_speed = o->figure.by == COLORING_AUTO || o->figure.by == COLORING_SPEED ||
                           (r->formula && expression_uses(r->formula, "speed"));
    o->reading.keep = needs_frames(o) > 0 || needs_count(o) || with_speed; /* which read the input twice */
    o->reading.stop = stop_flag_is_set;
    o->reading.stop_user = r->stop;
    o->reading.threads = cgt_context_get_threads(r->context);
    cgt_trajectory_sort_series(o->inputs, o->input_count);
    o->input = o->inputs[0];
    if (frame_source_open(&r->source, &r->sequence, o->inputs, o->input_count, &o->reading, r->error, sizeof r->error))
        return render_fail(r);
    if (with_speed && !(r->sequence.tracker = speed_create(r->context))) {
        program_error("out of memory");
        return -1;
    }
    r->sequence.wants_kinds = has_legend(o);
    r->source.keep.most = (size_t)o->memory_mib * (1024 * 1024);
    if (frame_sequence_unwrap(&r->sequence,
                              o->figure.whole    ? UNWRAP_WHOLE
                              : o->figure.unwrap ? UNWRAP_IMAGES
                                                 : UNWRAP_NOT,
                              r->error, sizeof r->error) ||
        frame_sequence_bind(&r->sequence, r->formula, r->error, sizeof r->error))
        return render_fail(r);
    if (render_scene_open(r))
        return -1;
    if (frame_source_want_columns(&r->source, r->error, sizeof r->error))
        return render_fail(r);
    cgt_trajectory_get_origin(r->source.file, r->origin);
    render_choose_camera_origin(r);
    return survey_input(r);
}

static int open_report(renderer *r)
{
    return render_report_open(&r->report, r->options.log_file, r->error, sizeof r->error) ? render_fail(r) : 0;
}

static int open_input(renderer *r)
{
    if (make_folders(r) || open_report(r) || open_first(r))
        return -1;
    if (render_choose_bulk_origin(r)) {
        if (frame_source_rewind(&r->source, r->error, sizeof r->error))
            return render_fail(r);
        if (survey_input(r))
            return -1;
    }
    if (render_move_cameras(r))
        return -1;
    if (r->has_survey)
        figure_options_axes(&r->options.figure, r->survey.kind);
    return choose_frames(r);
}

static int choose_ambient(const renderer *r)
{
    const style_values *const s = style_get(r->options.figure.picture.style);
    return cgt_trajectory_get_mesh(r->source.file) ? s->mesh_ambient : s->ambient;
}

static int prepare_pictures(renderer *r)
{
    const render_options *o = &r->options;
    if (o->figure.picture.ambient < 0)
        r->options.figure.picture.ambient = choose_ambient(r);
    if (o->contact_sheet)
        r->sheet = contact_sheet_create(o->sheet_columns, o->sheet_rows, r->count, o->figure.width, o->figure.height);
    if (o->contact_sheet && !r->sheet) {
        program_error("out of memory for a contact sheet of pictures of %" PRIu32 "x%" PRIu32 " pixels",
                      o->figure.width, o->figure.height);
        return -1;
    }
    camera_path_at(&r->path, 0.0, &r->camera);
    render_choose_light(r);
    if (r->options.figure.floor.is_set)
        render_scene_floor(r);
    if (r->options.figure.bounce.is_set && render_bounce_create(r))
        return -1;
    return render_picture_setup(r);
}

static int create_context(renderer *r)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = r->options.threads;
    options.variant = r->options.variant;
    if (r->options.verbose)
        options.log.write = on_log;
    const cgt_result result = cgt_context_create(&options, &r->context);
    if (result) {
        char reason[256];
        cgt_context_get_error_message(r->context, reason, sizeof reason);
        program_error("cannot start the library: %s: %s", cgt_get_result_string(result), reason);
    }
    return result ? -1 : 0;
}

static int create_scene(renderer *r)
{
    const cgt_result result = cgt_scene_create(r->context, NULL, &r->scene);
    return result ? render_fail_library(r, "make a scene", result) : 0;
}

int render_check_kind(void *user, const cgt_trajectory_frame *frame)
{
    const renderer *const r = user;
    const render_options *o = &r->options;
    const int triangles = frame->kind == CGT_TRAJECTORY_TRIANGLES;
    const char *wrong = NULL;
    if (triangles && r->coloring.by == COLORING_TYPE && !frame->type)
        wrong = "--color type: the triangles of this file have no types; id, speed, height or RRGGBB will do";
    else if (triangles && (o->reading.radius > 0.0f || o->reading.wrapped))
        wrong = "--radius and --wrapped are for spheres, and this is a file of triangles";
    else if (!triangles && (o->reading.fps > 0.0 || o->reading.clip))
        wrong = "--fps and --clip are for meshes, and this is a file of spheres";
    if (wrong)
        program_error("%s: %s", o->input, wrong);
    else if (o->figure.particles.bonds && !(o->figure.particles.bond_distance > 0.0f) && !frame->bond && frame->element)
        program_error("--bonds: the file has no bonds: they are guessed by the covalent radii of its elements");
    return wrong ? -1 : 0;
}

/* The end of the chosen frames that this run may render; UINT64_MAX: where the input ends. */
static uint64_t end_of_frames(const renderer *r)
{
    const frame_range *range = &r->options.range;
    const uint64_t known = r->count > UINT64_MAX - r->begin ? UINT64_MAX : r->begin + r->count;
    const int open_end = r->options.reading.follow > 0.0 || (r->has_survey && r->survey.is_cut);
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
    if (r->options.figure.particles.trails &&
        !(r->sequence.trails = trail_history_create(r->options.figure.particles.trails))) {
        program_error("out of memory for the trails");
        return -1;
    }
    r->source.looks_ahead = 1;
    reader->source = &r->source;
    reader->coloring = r->coloring; /* its index goes along */
    r->coloring.index = NULL;
    reader->range = r->options.range;
    reader->next = r->begin;
    reader->end = end_of_frames(r);
    reader->stop = r->stop;
    reader->check = render_check_kind;
    reader->user = r;
    reader->renderer = r;
    return render_reader_start(reader);
}

/* Speeds that the colours do not show are not looked for. */
static void drop_speeds(renderer *r)
{
    if (r->coloring.by == COLORING_SPEED || (r->formula && expression_uses(r->formula, "speed")))
        return;
    speed_release(r->sequence.tracker);
    r->sequence.tracker = NULL;
}

int render_prepare(renderer *r)
{
    if (create_context(r) || open_input(r) || render_choose_colors(r))
        return -1;
    drop_speeds(r);
    return render_choose_camera(r) || create_scene(r) || prepare_pictures(r) ? -1 : 0;
}

int render_setup(renderer *r)
{
    r->summary = stdout;
    for (uint32_t i = 0; i < r->options.output_count; i++)
        if (render_output_kind(r->options.outputs[i].pattern) == OUTPUT_RAW)
            r->summary = stderr;
    if (render_prepare(r))
        return -1;
    if (r->options.cell.mode && render_cell_create(r))
        return -1;
    return start_threads(r);
}

void render_close(renderer *r)
{
    render_reader_finish(&r->reader);
    render_cell_release(r->cell);
    render_picture_close(r);
    render_bounce_release(r->bounce);
    cgt_scene_release(r->scene);
    cgt_context_release(r->context);
    contact_sheet_release(r->sheet);
    coloring_free(&r->reader.coloring);
    coloring_free(&r->coloring);
    render_scene_close(r);
    frame_source_close(&r->source);
    frame_sequence_close(&r->sequence);
    expression_free(r->formula);
    camera_keys_free(&r->options.figure.keys);
}
