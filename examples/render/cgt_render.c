/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-render: renders the moving spheres or triangles of a trajectory. Each frame: read, colour, commit (the structure
 * is built from the arrays as they are), trace with a visitor that shades each tile while it is in cache, write. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/cgt.h>

#include "common/out_file.h"
#include "common/program.h"
#include "render/render_cell.h"
#include "render/render_setup.h"

static volatile sig_atomic_t stop; /* set by the first signal: the run ends after the current frame */

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Refuses options that do not fit the kind of the file, which is known with the first frame. */
static int check_kind(const renderer *r)
{
    const render_options *o = &r->options;
    const trajectory_frame *frame = &r->source.frame;
    const int triangles = frame->kind == TRAJECTORY_TRIANGLES;
    const char *wrong = NULL;
    if (triangles && r->coloring.by == COLORING_TYPE && !frame->type)
        wrong = "--color type: the triangles of this file have no types; id, speed, height or RRGGBB will do";
    else if (triangles && (o->reading.radius > 0.0f || o->reading.wrapped))
        wrong = "--radius and --wrapped are for spheres, and this is a file of triangles";
    else if (!triangles && (o->reading.fps > 0.0 || o->reading.clip))
        wrong = "--fps and --clip are for meshes, and this is a file of spheres";
    if (wrong)
        program_error("%s: %s", o->input, wrong);
    return wrong ? -1 : 0;
}

/* The scene uses the reader's array: x, y, z, radius of each sphere. */
static cgt_result set_spheres(renderer *r, const trajectory_frame *frame)
{
    const cgt_spheres spheres = {.count = frame->count,
                                 .centers = frame->xyzr,
                                 .center_stride = 4 * sizeof(float),
                                 .radii = frame->count ? frame->xyzr + 3 : NULL,
                                 .radius_stride = 4 * sizeof(float)};
    return r->has_geometry ? cgt_scene_update_spheres(r->scene, r->geometry, &spheres)
                           : cgt_scene_add_spheres(r->scene, &spheres, &r->geometry);
}

static cgt_result set_triangles(renderer *r, const trajectory_frame *frame)
{
    const cgt_triangles triangles = {
        .count = frame->triangles, .indices = frame->index, .vertex_count = frame->count, .vertices = frame->position};
    r->job.triangle = frame->index;
    r->job.vertex_normal = frame->vertex_normal;
    return r->has_geometry ? cgt_scene_update_triangles(r->scene, r->geometry, &triangles)
                           : cgt_scene_add_triangles(r->scene, &triangles, &r->geometry);
}

static int build_frame(renderer *r, frame_record *record, cgt_scene_statistics *stats,
                       cgt_research_scene_statistics *research)
{
    const trajectory_frame *frame = &r->source.frame;
    const int triangles = frame->kind == TRAJECTORY_TRIANGLES;
    cgt_result result = triangles ? set_triangles(r, frame) : set_spheres(r, frame);
    if (result)
        return render_fail_library(r, triangles ? "take the triangles" : "take the spheres", result);
    r->has_geometry = 1;
    r->report.kind = frame->kind;
    const double begin = program_seconds();
    result = cgt_scene_commit(r->scene);
    record->build_ms = (program_seconds() - begin) * 1e3;
    if (!result)
        result = cgt_scene_get_statistics(r->scene, stats);
    if (!result)
        result = cgt_research_get_scene_statistics(r->scene, research);
    if (result)
        return render_fail_library(r, "build", result);
    record->primitives = frame_primitives(frame);
    record->skipped_not_finite = stats->skipped_not_finite;
    record->skipped_radius = stats->skipped_radius;
    record->skipped_degenerate = stats->skipped_degenerate;
    return 0;
}

/* Returns 0, -1 on an error, 1 where a signal stopped the frame: the picture is incomplete. */
static int trace_frame(renderer *r, frame_record *record, render_counts *stats)
{
    shade_job *job = &r->job;
    cgt_frame frame;
    const cgt_research_trace_options research = {.statistics = &stats->research};
    cgt_trace_options options;
    const double total = (double)r->survey.frames;
    camera_path_at(&r->path, r->has_survey ? (double)r->rendered / total : 0.0, &job->camera);
    job->index = r->coloring.index;
    job->palette = (const float(*)[3])r->coloring.palette;
    job->palette_steps = COLORING_STEPS;
    job->mix = r->coloring.per_vertex;
    shade_begin(job);
    cgt_frame_init(&frame, job->width * job->samples, job->height * job->samples);
    frame.visitor = shade_tile;
    frame.visitor_user = job;
    frame.visitor_fields = shade_fields(job);
    cgt_trace_options_init(&options);
    if (r->options.stats) {
        options.statistics = &stats->trace;
        options.research = &research;
    }
    if (r->cell)
        return render_cell_frame(r->cell, &r->source.frame, job, r->options.input, record);
    const double begin = program_seconds();
    const cgt_result result = cgt_trace_camera(r->scene, &job->camera, &frame, &options);
    record->trace_ms = (program_seconds() - begin) * 1e3;
    record->hits = atomic_load_explicit(&job->hits, memory_order_relaxed);
    if (result == CGT_ERROR_STOPPED && stop)
        return 1;
    return result ? render_fail_library(r, "trace", result) : 0;
}

static int write_frame(renderer *r, frame_record *record)
{
    const render_options *o = &r->options;
    const shade_job *job = &r->job;
    char name[4096];
    const double begin = program_seconds();
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (out_path_name(&o->outputs[i], r->rendered, name, sizeof name)) {
            program_error("%s: the name is too long", o->outputs[i].pattern);
            return -1;
        }
        const int failed = out_path_ends_in(name, ".exr")
                               ? image_write_exr(name, job->pixels, job->width, job->height, r->error, sizeof r->error)
                               : image_write_png(name, job->rgb, job->width, job->height, r->error, sizeof r->error);
        if (failed)
            return render_fail(r);
    }
    if (r->sheet)
        contact_sheet_add(r->sheet, r->rendered, r->source.frame.number, job->rgb);
    record->write_ms = (program_seconds() - begin) * 1e3;
    return 0;
}

/* Returns 0, -1 on an error, 1 where a signal stopped the frame. */
static int render_frame(renderer *r, frame_record *record)
{
    cgt_scene_statistics scene;
    render_counts traced;
    memset(&traced, 0, sizeof traced);
    if (!r->has_geometry && check_kind(r))
        return -1;
    const double begin = program_seconds();
    if (coloring_apply(&r->coloring, &r->source.frame, r->source.speed)) {
        program_error("out of memory for the colours of %" PRIu32 " primitives", frame_primitives(&r->source.frame));
        return -1;
    }
    record->color_ms = (program_seconds() - begin) * 1e3;
    record->number = r->source.frame.number;
    record->step = r->source.frame.step;
    if (!r->cell && build_frame(r, record, &scene, &traced.scene))
        return -1;
    const int result = trace_frame(r, record, &traced);
    if (result)
        return result;
    if (write_frame(r, record))
        return -1;
    if (render_report_add(&r->report, record, &scene, r->options.stats ? &traced : NULL, r->error, sizeof r->error))
        return render_fail(r);
    r->rendered++;
    return 0;
}

static int render_frames(renderer *r)
{
    program_progress progress;
    int result = 0;
    program_progress_start(&progress, "rendering", "frames", r->has_survey ? (double)r->survey.frames : 0.0,
                           r->options.quiet);
    while (result == 0 && !stop) {
        frame_record record;
        memset(&record, 0, sizeof record);
        const double begin = program_seconds();
        const int read = frame_source_next(&r->source, r->error, sizeof r->error);
        record.read_ms = (program_seconds() - begin) * 1e3;
        if (read == 0)
            break;
        result = read < 0 ? render_fail(r) : render_frame(r, &record);
        program_progress_update(&progress, (double)r->rendered,
                                r->has_survey ? -1.0 : trajectory_progress(r->source.file));
    }
    program_progress_end(&progress);
    if (result >= 0 && stop) {
        program_error("interrupted after %" PRIu64 " frames", r->rendered);
        return -1;
    }
    if (result == 0 && r->rendered == 0) {
        program_error("%s: there is no frame to render", r->options.input);
        return -1;
    }
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

static void print_summary(const renderer *r)
{
    static const char *const names[] = {"auto", "type", "id", "speed", "height", "one for all"};
    const render_options *o = &r->options;
    const cgt_camera *c = &r->path.start;
    char name[4096];
    if (r->rendered == 0)
        return;
    printf("%s: %" PRIu32 "x%" PRIu32, o->input, o->width, o->height);
    if (o->samples > 1)
        printf(", %" PRIu32 " rays a pixel", o->samples * o->samples);
    printf(", %" PRIu32 " thread%s, variant %s\n", cgt_context_get_threads(r->context),
           cgt_context_get_threads(r->context) == 1 ? "" : "s", cgt_context_get_variant(r->context));
    printf("camera            -c %.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", (double)c->eye[0],
           (double)c->eye[1], (double)c->eye[2], (double)c->target[0], (double)c->target[1], (double)c->target[2],
           (double)c->up[0], (double)c->up[1], (double)c->up[2], (double)c->fov);
    printf("colour            %s", names[r->coloring.by]);
    if (r->coloring.by != COLORING_TYPE && r->coloring.by != COLORING_PLAIN)
        printf(" from %g to %g", (double)r->coloring.min, (double)r->coloring.max);
    if (r->coloring.by == COLORING_SPEED)
        printf(", %s", r->source.speed_from == SPEED_FROM_VELOCITY ? "the file's velocities" : "by change of position");
    printf("\n");
    render_report_print(&r->report, (uint64_t)o->width * o->height * o->samples * o->samples,
                        o->output_count + (r->sheet != NULL), stdout);
    render_cell_print(r->cell, stdout);
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (out_path_name(&o->outputs[i], 0, name, sizeof name) == 0)
            printf("pictures          %s", name);
        if (r->rendered > 1 && out_path_name(&o->outputs[i], r->rendered - 1, name, sizeof name) == 0)
            printf(" to %s", name);
        printf("\n");
    }
}

static int run(renderer *r)
{
    if (render_setup(r))
        return -1;
    int result = render_frames(r);
    if (result == 0)
        result = write_contact_sheet(r);
    print_summary(r);
    if (result == 0 && r->sheet)
        printf("contact sheet     %s\n", r->options.contact_sheet);
    return result;
}

int main(int argc, char **argv)
{
    static renderer r; /* all zero, and too large for some stacks */
    program_init("cgt-render");
    render_options_parse(&r.options, argc, argv);
    r.stop = &stop;
    out_file_catch_signals(&stop);
    int result = run(&r);
    if (render_report_close(&r.report, r.error, sizeof r.error))
        result = render_fail(&r);
    render_close(&r);
    return program_exit(result ? PROGRAM_FAILED : PROGRAM_OK);
}
