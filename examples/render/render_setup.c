/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The set-up of cgt-render; see render_setup.h. */
#include "render/render_setup.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/render_cell.h"

int render_fail(renderer *r)
{
    program_error("%s", r->error);
    return -1;
}

int render_fail_library(renderer *r, const char *action, cgt_result result)
{
    char message[512] = "";
    if (r->context)
        cgt_context_get_error_message(r->context, message, sizeof message);
    program_error("%s: frame %" PRIu64 ": cannot %s: %s", r->options.input, r->source.frame.number, action,
                  *message ? message : cgt_get_result_string(result));
    return -1;
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

/* Whether something about all frames must be known before the first is rendered. */
static int needs_survey(const render_options *o)
{
    int needs = !o->has_camera || o->orbit != 0.0f || o->contact_sheet || o->by == COLORING_AUTO;
    needs |= o->by != COLORING_TYPE && o->by != COLORING_PLAIN && !o->has_range;
    needs |= o->by == COLORING_HEIGHT; /* the up axis depends on the kind of the file */
    for (uint32_t i = 0; i < o->output_count; i++)
        needs |= !o->outputs[i].numbered;
    return needs;
}

static int check_survey(const renderer *r)
{
    const render_options *o = &r->options;
    if (r->survey.frames == 0) {
        program_error("%s: there is no frame%s", o->input,
                      o->range.first || o->range.last != UINT64_MAX - 1 ? " in the range from --first to --last" : "");
        return -1;
    }
    for (uint32_t i = 0; i < o->output_count; i++)
        if (!o->outputs[i].numbered && r->survey.frames > 1) {
            program_error("%s: the name needs a %%04d, there are %" PRIu64 " frames", o->outputs[i].pattern,
                          r->survey.frames);
            return -1;
        }
    return 0;
}

static int open_input(renderer *r)
{
    render_options *o = &r->options;
    const int with_speed = o->by == COLORING_AUTO || o->by == COLORING_SPEED;
    o->reading.keep = needs_survey(o); /* which reads the input twice */
    o->reading.stop = r->stop;
    trajectory_sort_series(o->inputs, o->input_count);
    o->input = o->inputs[0];
    if (frame_source_open(&r->source, o->inputs, o->input_count, &o->reading, &o->range, with_speed, r->error,
                          sizeof r->error))
        return render_fail(r);
    if (!needs_survey(o))
        return 0;
    trajectory_set_follow(r->source.file, 0.0); /* the survey takes what is there */
    if (survey_run(&r->source, &r->survey, o->quiet, r->stop, r->error, sizeof r->error))
        return render_fail(r);
    r->has_survey = 1;
    trajectory_set_follow(r->source.file, o->reading.follow);
    render_options_axes(&r->options, r->survey.kind);
    return check_survey(r);
}

/* What the colours show. */
static coloring_by choose_coloring(const renderer *r)
{
    const survey *s = &r->survey;
    if (r->options.by != COLORING_AUTO)
        return r->options.by;
    if (s->has_type && s->type_max > s->type_min)
        return COLORING_TYPE;
    if (s->kind == TRAJECTORY_TRIANGLES)
        return COLORING_PLAIN;
    return survey_speed_quantile(s, 1.0) > 0.0f ? COLORING_SPEED : COLORING_ID;
}

/* The values at the ends of the map, from the survey. */
static void choose_range(const renderer *r, coloring_by by, int axis, float *min, float *max)
{
    const survey *s = &r->survey;
    const float fastest = survey_speed_quantile(s, 0.99);
    if (by == COLORING_SPEED) {
        *min = 0.0f;
        *max = fastest > 0.0f ? fastest : survey_speed_quantile(s, 1.0);
    } else if (by == COLORING_ID && s->id_min <= s->id_max) {
        *min = (float)s->id_min;
        *max = (float)s->id_max;
    } else if (by == COLORING_HEIGHT && s->drawable) {
        *min = s->bounds_min[axis];
        *max = s->bounds_max[axis];
    }
}

static int choose_colors(renderer *r)
{
    const render_options *o = &r->options;
    const coloring_by by = choose_coloring(r);
    const int axis = o->up[0] != 0.0f ? 0 : o->up[1] != 0.0f ? 1 : 2;
    float min = o->range_min, max = o->range_max;
    if (!o->has_range)
        choose_range(r, by, axis, &min, &max);
    if (by != COLORING_SPEED) {
        speed_release(r->source.tracker);
        r->source.tracker = NULL;
    }
    if (by == COLORING_PLAIN ? coloring_init_plain(&r->coloring, o->plain)
                             : coloring_init(&r->coloring, by, o->map, min, max)) {
        program_error("out of memory");
        return -1;
    }
    r->coloring.axis = axis;
    return 0;
}

static int choose_camera(renderer *r)
{
    const render_options *o = &r->options;
    float min[3] = {-1.0f, -1.0f, -1.0f}, max[3] = {1.0f, 1.0f, 1.0f};
    if (o->has_camera) {
        camera_path_fixed(&r->path, &o->camera, (double)o->orbit);
        return 0;
    }
    if (r->survey.drawable) {
        memcpy(min, r->survey.bounds_min, sizeof min);
        memcpy(max, r->survey.bounds_max, sizeof max);
    }
    if (camera_path_frame(&r->path, min, max, o->view, o->up, o->fov, (double)o->width / (double)o->height,
                          (double)o->orbit) == 0)
        return 0;
    program_error("%s: the scene, from (%g, %g, %g) to (%g, %g, %g), is too large for an automatic camera: give one "
                  "with -c",
                  o->input, (double)min[0], (double)min[1], (double)min[2], (double)max[0], (double)max[1],
                  (double)max[2]);
    return -1;
}

/* The light: as given, or over the left shoulder of the first camera. It does not follow an orbit. */
static void choose_light(renderer *r)
{
    shade_job *job = &r->job;
    float light[3], length = 0.0f;
    for (int c = 0; c < 3; c++)
        light[c] = r->options.light[c];
    if (!r->options.has_light) {
        shade_begin(job); /* for the camera's axes, which are scaled */
        float right = 0.0f, up = 0.0f;
        for (int c = 0; c < 3; c++) {
            right += job->right[c] * job->right[c];
            up += job->up[c] * job->up[c];
        }
        for (int c = 0; c < 3; c++)
            light[c] = 0.70f * job->up[c] / sqrtf(up) - 0.45f * job->right[c] / sqrtf(right) - 0.55f * job->forward[c];
    }
    for (int c = 0; c < 3; c++)
        length = fmaxf(length, fabsf(light[c]));
    float sum = 0.0f;
    for (int c = 0; c < 3; c++) { /* divide by the largest, so that squares of finite floats stay finite */
        job->light[c] = light[c] / length;
        sum += job->light[c] * job->light[c];
    }
    for (int c = 0; c < 3; c++)
        job->light[c] /= sqrtf(sum);
}

static int prepare_pictures(renderer *r)
{
    const render_options *o = &r->options;
    shade_job *job = &r->job;
    const size_t pixels = (size_t)o->width * o->height; /* at most RENDER_MAX_PIXELS */
    int exr = 0;
    for (uint32_t i = 0; i < o->output_count; i++)
        exr |= out_path_ends_in(o->outputs[i].pattern, ".exr");
    srgb_tables_init(&r->tables);
    job->width = o->width;
    job->height = o->height;
    job->samples = o->samples;
    job->tables = &r->tables;
    job->stop = r->stop;
    for (int c = 0; c < 3; c++)
        job->background[c] = r->tables.decode[o->background[c]];
    job->rgb = malloc(pixels * 3);
    job->pixels = exr ? malloc(pixels * sizeof *job->pixels) : NULL;
    if (o->contact_sheet)
        r->sheet = contact_sheet_create(o->sheet_columns, o->sheet_rows, r->survey.frames, o->width, o->height);
    if (!job->rgb || (exr && !job->pixels) || (o->contact_sheet && !r->sheet)) {
        program_error("out of memory for pictures of %" PRIu32 "x%" PRIu32 " pixels", o->width, o->height);
        return -1;
    }
    camera_path_at(&r->path, 0.0, &job->camera);
    choose_light(r);
    return 0;
}

static int create_scene(renderer *r)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = r->options.threads;
    options.variant = r->options.variant;
    if (r->options.verbose)
        options.log.write = on_log;
    cgt_result result = cgt_context_create(&options, &r->context);
    if (result) {
        program_error("cannot start the library%s%s: %s", options.variant ? " with variant " : "",
                      options.variant ? options.variant : "", cgt_get_result_string(result));
        return -1;
    }
    result = cgt_scene_create(r->context, NULL, &r->scene);
    return result ? render_fail_library(r, "make a scene", result) : 0;
}

int render_setup(renderer *r)
{
    if (make_folders(r))
        return -1;
    if (render_report_open(&r->report, r->options.log_file, r->error, sizeof r->error))
        return render_fail(r);
    if (open_input(r) || choose_colors(r) || choose_camera(r) || prepare_pictures(r) || create_scene(r))
        return -1;
    if (r->options.cell.mode)
        r->cell = render_cell_create(&r->options);
    return r->options.cell.mode && !r->cell ? -1 : 0;
}

void render_close(renderer *r)
{
    render_cell_release(r->cell);
    cgt_scene_release(r->scene);
    cgt_context_release(r->context);
    contact_sheet_release(r->sheet);
    coloring_free(&r->coloring);
    free(r->job.rgb);
    free(r->job.pixels);
    frame_source_close(&r->source);
}
