/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-render: renders the moving spheres or triangles of a trajectory. A thread reads frames ahead and colours them
 * (render_reader.h); here each is committed (the structure is built from the arrays as they are) and drawn
 * (cgt/picture.h); threads write the pictures behind (render_writer.h). */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/cgt.h>

#include "common/out_file.h"
#include "common/program.h"
#include "options/numbers.h"
#include "render/render_setup.h"
#include "system/process.h"

static stop_flag stop; /* set by the first signal: the run ends after the current frame */

/* ---- Frames ------------------------------------------------------------------------------------------------- */

static int build_frame(renderer *r, const frame_parts *parts, frame_record *record, cgt_scene_statistics *stats,
                       cgt_research_scene_statistics *research)
{
    const cgt_trajectory_frame *frame = r->figure->frame;
    if (render_result(r, cgt_figure_scene_set(r->figure, parts)))
        return -1;
    r->report.kind = frame->kind;
    const double begin = program_seconds();
    cgt_result result = cgt_scene_commit(r->figure->scene);
    record->build_ms = (program_seconds() - begin) * 1e3;
    if (!result)
        result = cgt_scene_get_statistics(r->figure->scene, stats);
    if (!result)
        result = cgt_research_get_scene_statistics(r->figure->scene, research);
    if (result)
        return render_result(r, cgt_figure_fail_library(r->figure, "build", result));
    record->primitives = frame_primitives(frame);
    record->skipped_not_finite = stats->skipped_not_finite;
    record->skipped_radius = stats->skipped_radius;
    record->skipped_degenerate = stats->skipped_degenerate;
    return 0;
}

/* Returns 0, -1 on an error, 1 where a signal stopped the frame: the picture is incomplete. */
static int trace_frame(renderer *r, frame_record *record, render_counts *stats)
{
    const cgt_research_trace_options research = {.statistics = &stats->research};
    cgt_trace_options options;
    cgt_figure_camera_at(r->figure, r->figure->frame->number, &r->figure->camera);
    cgt_trace_options_init(&options);
    if (r->options.stats) {
        options.statistics = &stats->trace;
        options.research = &research;
    }
    if (r->cell)
        return render_cell_frame(r, record);
    const double begin = program_seconds();
    const cgt_result result = cgt_figure_trace(r->figure, &options);
    record->trace_ms = (program_seconds() - begin) * 1e3;
    record->hits = cgt_picture_get_hits(r->figure->drawing);
    if (result == CGT_ERROR_STOPPED && stop)
        return 1;
    return render_result(r, result ? cgt_figure_fail_picture(r->figure, result) : 0);
}

/* Draws a frame that was read and hands its picture over. Returns 0, -1 on an error, 1 where a signal stopped it. */
static int render_frame(renderer *r, read_frame *read)
{
    render_counts traced;
    writer_picture *const picture = render_writer_begin(&r->writer);
    if (!picture)
        return -1;
    writer_done *const done = &picture->done;
    memset(&traced, 0, sizeof traced);
    r->figure->frame = &read->copy.frame;
    r->figure->parts.frame = &read->parts; /* a Cell takes no scene, but labels */
    r->figure->coloring.index = read->index;
    r->figure->coloring.per_vertex = read->per_vertex;
    r->figure->speed_from = read->speed_from;
    r->figure->image = (cgt_image){.bytes = picture->rgb, .alpha = picture->alpha, .linear = picture->pixels};
    picture->chosen = read->chosen;
    done->record.number = r->figure->frame->number;
    done->record.step = r->figure->frame->step;
    done->record.read_ms = read->read_ms;
    done->record.color_ms = read->color_ms;
    int result = r->cell ? 0 : build_frame(r, &read->parts, &done->record, &done->scene, &traced.scene);
    if (result == 0)
        result = trace_frame(r, &done->record, &traced);
    r->figure->coloring.index = NULL; /* the reader's */
    if (result)
        return result;
    done->counted = r->options.stats;
    done->counts = traced;
    render_writer_submit(&r->writer);
    return 0;
}

/* A frame is done: one at a time. */
static int add_to_report(void *user, const writer_done *done)
{
    renderer *const r = user;
    const uint64_t number = done->record.number;
    char error[PROGRAM_ERROR_SIZE];
    r->first_number = r->report.count == 0 || number < r->first_number ? number : r->first_number;
    r->last_number = r->report.count == 0 || number > r->last_number ? number : r->last_number;
    if (render_report_add(&r->report, &done->record, &done->scene, done->counted ? &done->counts : NULL, error,
                          sizeof error) == 0)
        return 0;
    program_error("%s", error);
    return -1;
}

static void show_progress(renderer *r)
{
    program_progress_update(&r->progress, (double)render_writer_count_done(&r->writer), -1.0);
}

static int render_frames(renderer *r)
{
    read_frame *read;
    int result = 0, taken = 1;
    while (result == 0 && !*r->stop) {
        taken = render_reader_take(&r->reader, &read);
        if (taken != 1)
            break;
        r->report.kind = read->copy.frame.kind;
        result = render_frame(r, read);
        render_reader_give_back(&r->reader);
        show_progress(r);
    }
    r->failed |= result < 0;
    return result < 0 || taken < 0 ? -1 : 0; /* taken: the input ends in an error, after whole frames */
}

/* Renders all frames and waits for their pictures. The movies and the sheet of what came before an error of the input
 * are whole. */
static int run_frames(renderer *r)
{
    program_progress_start(&r->progress, "rendering", "frames", r->count == UINT64_MAX ? 0.0 : (double)r->count,
                           r->options.quiet);
    int result = render_frames(r);
    if (render_writer_drain(&r->writer)) {
        r->failed = 1;
        result = -1;
    }
    program_progress_end(&r->progress);
    return result;
}

/* ---- After the last frame ----------------------------------------------------------------------------------- */

static int write_contact_sheet(renderer *r)
{
    uint32_t width, height;
    if (!r->sheet)
        return 0;
    const uint8_t *rgb = contact_sheet_pixels(r->sheet, &width, &height);
    if (image_write_png(r->options.contact_sheet, rgb, width, height, r->error, sizeof r->error))
        return render_fail(r);
    return 0;
}

/* With so many digits that the ends differ. */
static void print_range(double min, double max, FILE *to)
{
    const int digits = cgt_number_digits(fmax(fabs(min), fabs(max)), 0.01 * (max - min));
    fprintf(to, " from %s to %s", cgt_number(digits, min).text, cgt_number(digits, max).text);
}

/* How a range was found that the command line does not give. */
static void print_range_rule(const renderer *r, FILE *to)
{
    const survey *const s = &r->figure->survey;
    const int is_formula = r->figure->coloring.by == COLORING_VALUE;
    double min, max;
    if (r->figure->options.has_range || !r->figure->has_survey ||
        (!is_formula && r->figure->coloring.by != COLORING_SPEED))
        return;
    if (is_formula && s->value_min < s->value_max) {
        fprintf(to, ", the %s of values",
                cgt_survey_value_range(s, r->figure->options.logarithmic, &min, &max) ? "1 % and the 99 % quantile"
                                                                                      : "least and the greatest");
        print_range(s->value_min, s->value_max, to);
    } else if (is_formula) {
        fprintf(to, s->values ? ", which all values are" : ", since no value is finite");
    } else {
        fprintf(to, ", %s and the %s", r->figure->coloring.logarithmic ? "the 1 % quantile of those above 0" : "0",
                s->speeds > 100 && cgt_survey_speed_quantile(s, 0.99) > 0.0f ? "99 % quantile" : "greatest");
    }
    if (r->figure->options.is_symmetric)
        fprintf(to, ", as far below 0 as above");
    if (is_formula && s->values && s->unknown_values)
        fprintf(to, "; %" PRIu64 " more are not finite", s->unknown_values);
}

static void print_summary(const renderer *r)
{
    FILE *const to = r->summary;
    static const char *const names[] = {"auto",        "type",    "id",      "speed",   "height",
                                        "one for all", "element", "formula", "category"};
    const render_options *o = &r->options;
    char name[4096], camera[FIGURE_CAMERA_SIZE];
    if (r->report.count == 0)
        return;
    fprintf(to, "%s: %" PRIu32 "x%" PRIu32, o->input, o->figure.width, o->figure.height);
    if (o->figure.samples > 1)
        fprintf(to, ", %" PRIu32 " rays a pixel", o->figure.samples * o->figure.samples);
    fprintf(to, ", %" PRIu32 " thread%s, variant %s\n", cgt_context_get_threads(r->context),
            cgt_context_get_threads(r->context) == 1 ? "" : "s", cgt_context_get_variant(r->context));
    cgt_figure_name_camera(r->figure, &r->figure->path.start, camera);
    fprintf(to, "camera            -c %s", camera);
    fprintf(to, "colour            %s",
            r->figure->formula ? r->figure->options.formula : names[r->figure->coloring.by]);
    if (cgt_coloring_has_range(&r->figure->coloring))
        print_range(r->figure->coloring.min, r->figure->coloring.max, to);
    print_range_rule(r, to);
    if (r->figure->coloring.by == COLORING_SPEED)
        fprintf(to, ", %s",
                r->figure->speed_from == SPEED_FROM_VELOCITY ? "the file's velocities"
                                                             : "by change of position, a frame");
    fprintf(to, "\n");
    render_report_print(&r->report,
                        (uint64_t)o->figure.width * o->figure.height * o->figure.samples * o->figure.samples,
                        o->output_count + (r->sheet != NULL), to);
    render_cell_print(r->cell, to);
    for (uint32_t i = 0; i < o->output_count; i++) {
        const render_output kind = render_output_kind(o->outputs[i].pattern);
        if (kind == OUTPUT_MOVIE && !(r->writer.movies_made >> i & 1))
            continue;
        if (kind != OUTPUT_PICTURE) {
            fprintf(to, "%-18s%s\n", kind == OUTPUT_MOVIE ? "movie" : "raw frames", o->outputs[i].pattern);
            continue;
        }
        if (out_path_name(&o->outputs[i], r->first_number, name, sizeof name) == 0)
            fprintf(to, "pictures          %s", name);
        if (r->report.count > 1 && out_path_name(&o->outputs[i], r->last_number, name, sizeof name) == 0)
            fprintf(to, " to %s", name);
        fprintf(to, "\n");
    }
}

/* Movies and sheet, once all pictures are written. */
static int finish_outputs(renderer *r, int wrong)
{
    const int keep = !*r->stop && r->report.count > 0 && !r->failed;
    if (render_writer_finish(&r->writer, keep))
        wrong = -1;
    return keep && write_contact_sheet(r) ? -1 : wrong;
}

static int run(renderer *r)
{
    int result = render_setup(r);
    if (result == 0)
        result = run_frames(r);
    if (*r->stop)
        program_error("interrupted after %zu frames", r->report.count);
    result = finish_outputs(r, result);
    result = *r->stop ? -1 : result;
    if (result == 0 && r->report.count == 0) {
        program_error("%s: there is no frame to render", r->options.input);
        return -1;
    }
    print_summary(r);
    if (result == 0 && r->sheet)
        fprintf(r->summary, "contact sheet     %s\n", r->options.contact_sheet);
    return result;
}

int main(int argc, char **argv)
{
    static renderer r; /* all zero, and too large for some stacks */
    program_init("cgt-render");
    render_options_parse(&r.options, argc, argv);
    r.stop = &stop;
    r.writer.on_done = add_to_report;
    r.writer.user = &r;
    out_file_catch_signals(&stop);
    process_ignore_closed_pipes();
    int result = run(&r);
    if (render_report_close(&r.report, r.error, sizeof r.error))
        result = render_fail(&r);
    render_close(&r);
    return program_exit(result ? PROGRAM_FAILED : PROGRAM_OK);
}
