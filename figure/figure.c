/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls of <cgt/figure.h>: options, a survey of frames, frames that are shown, pictures. */
#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure_state.h"
#include "options/figure_values.h"
#include "options/option_row.h"
#include "survey/origin.h"

/* ---- The figure --------------------------------------------------------------------------------------------- */

/* Forgets all that was found of frames; what was set, and the options made of it, stay. */
static void forget(cgt_figure *figure)
{
    const camera_keys keys = figure->options.keys;
    const notices untold = figure->notices;
    if (figure->is_surveying)
        cgt_survey_end(&figure->team);
    memset(&figure->options.keys, 0, sizeof keys);
    memset(&figure->notices, 0, sizeof untold);
    cgt_figure_close(figure);
    cgt_figure_data_free(&figure->data);
    cgt_frame_copy_free(&figure->copy);
    cgt_frame_parts_free(&figure->drawn);
    figure->options.keys = keys;
    figure->notices = untold;
    memset((char *)figure + offsetof(struct cgt_figure, origin), 0,
           sizeof *figure - offsetof(struct cgt_figure, origin));
}

/* The same, and the options are made anew: cameras were moved, axes and ambient rays chosen in them. */
static void begin_again(cgt_figure *figure)
{
    char ignored[FIGURE_MESSAGE_SIZE]; /* they could be made before */
    forget(figure);
    cgt_camera_keys_free(&figure->options.keys);
    cgt_figure_settings_replay(&figure->given, &figure->options, ignored, sizeof ignored);
}

/* Of figure->message; layers below tell by their sentence alone what has failed. */
static cgt_result result_of(const cgt_figure *figure)
{
    return strstr(figure->message, "out of memory") ? CGT_ERROR_OUT_OF_MEMORY : CGT_ERROR_INVALID_ARGUMENT;
}

static cgt_result fail_frame(cgt_figure *figure)
{
    begin_again(figure);
    return result_of(figure);
}

cgt_result cgt_figure_create(cgt_context *context, cgt_figure **figure)
{
    if (!figure)
        return CGT_ERROR_INVALID_ARGUMENT;
    *figure = NULL;
    cgt_figure *const made = context ? calloc(1, sizeof *made) : NULL;
    if (!made)
        return context ? CGT_ERROR_OUT_OF_MEMORY : CGT_ERROR_INVALID_ARGUMENT;
    made->context = context;
    made->source = "figure";
    made->has_origin = 1;
    *figure = made;
    return cgt_figure_unset(made, NULL);
}

void cgt_figure_release(cgt_figure *figure)
{
    if (!figure)
        return;
    forget(figure);
    cgt_camera_keys_free(&figure->options.keys);
    cgt_notices_free(&figure->notices);
    cgt_figure_settings_free(&figure->given);
    cgt_figure_data_free(&figure->mesh);
    free(figure);
}

size_t cgt_figure_get_error_message(const cgt_figure *figure, char *text, size_t size)
{
    const size_t length = strlen(figure->message);
    if (size > 0)
        snprintf(text, size, "%s", figure->message);
    return length;
}

const char *cgt_figure_take_notice(cgt_figure *figure) { return cgt_notices_take(&figure->notices); }

/* ---- Options ------------------------------------------------------------------------------------------------ */

static cgt_figure_kind kind_of(const option_row *row)
{
    switch (row->type) {
    case OPTION_FLAG:
    case OPTION_BOOL: return CGT_FIGURE_SWITCH;
    case OPTION_WORD:
    case OPTION_NAME: return CGT_FIGURE_WORD;
    case OPTION_FLOAT:
    case OPTION_DOUBLE: return CGT_FIGURE_NUMBER;
    case OPTION_U32:
    case OPTION_U64: return CGT_FIGURE_WHOLE;
    case OPTION_TEXT: return CGT_FIGURE_TEXT;
    default: break;
    }
    return row->parse == cgt_parse_color || row->parse == cgt_parse_floor    ? CGT_FIGURE_COLOR
           : row->parse == cgt_parse_formula || row->parse == cgt_parse_show ? CGT_FIGURE_FORMULA
                                                                             : CGT_FIGURE_LIST;
}

bool cgt_figure_get_option(uint32_t index, cgt_figure_option *option)
{
    const char *group = NULL;
    for (size_t i = 0; i < cgt_figure_row_count; i++) {
        const option_row *const row = &cgt_figure_rows[i];
        if (!row->name)
            group = row->help;
        if (!row->name || index-- > 0)
            continue;
        const cgt_figure_kind kind = kind_of(row);
        const int is_whole = kind == CGT_FIGURE_WHOLE;
        *option = (cgt_figure_option){.name = row->name,
                                      .group = group,
                                      .value = row->value,
                                      .help = row->help,
                                      .words = row->words,
                                      .otherwise = row->otherwise,
                                      .kind = kind,
                                      .low = is_whole ? (double)row->first : row->low,
                                      .high = is_whole ? (double)row->last : row->high,
                                      .is_optional = row->is_optional,
                                      .repeats = row->repeats};
        return true;
    }
    return false;
}

cgt_result cgt_figure_set(cgt_figure *figure, const char *name, const char *value)
{
    if (cgt_figure_settings_set(&figure->given, name, value, &figure->options, figure->message, sizeof figure->message))
        return result_of(figure);
    forget(figure);
    return CGT_OK;
}

cgt_result cgt_figure_unset(cgt_figure *figure, const char *name)
{
    if (cgt_figure_settings_unset(&figure->given, name, &figure->options, figure->message, sizeof figure->message))
        return result_of(figure);
    forget(figure);
    return CGT_OK;
}

size_t cgt_figure_get(const cgt_figure *figure, const char *name, char *text, size_t size)
{
    return cgt_figure_settings_print(&figure->given, name, text, size);
}

/* ---- A mesh that stands ------------------------------------------------------------------------------------- */

cgt_result cgt_figure_set_mesh(cgt_figure *figure, const cgt_figure_data *mesh)
{
    figure_data taken = {.blocks = 0};
    cgt_figure_data data;
    cgt_figure_column normals = {.name = "normal"};
    if (mesh && mesh->frame) { /* by its arrays */
        const cgt_trajectory_frame *const f = mesh->frame;
        normals.values = cgt_floats(f->vertex_normal, 0);
        data = (cgt_figure_data){
            .points = {f->count, cgt_floats(f->position, 0), &normals, f->vertex_normal != NULL, 0.0f},
            .triangles = {f->triangles, cgt_uint32s(f->index, 0)}};
        mesh = &data;
    }
    if (mesh && (!mesh->triangles.corners.data || !mesh->triangles.count))
        cgt_figure_fail(figure, "the mesh has no triangles");
    else if (!mesh || cgt_figure_data_take(&taken, mesh, figure->message, sizeof figure->message) == 0) {
        cgt_figure_data_free(&figure->mesh);
        figure->mesh = taken;
        begin_again(figure);
        return CGT_OK;
    }
    cgt_figure_data_free(&taken);
    return result_of(figure);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Makes the caller's data the sequence's frame, its molecules put together. */
static int place_frame(cgt_figure *figure, const cgt_figure_data *data)
{
    frame_sequence *const s = &figure->sequence;
    int endless;
    if (!data->frame && cgt_figure_data_take(&figure->data, data, figure->message, sizeof figure->message))
        return -1;
    s->frame = data->frame ? *data->frame : figure->data.frame;
    if (s->frame.number != figure->next)
        cgt_frame_sequence_restart(s);
    if (cgt_frame_sequence_place(s, &s->frame, &endless, figure->message, sizeof figure->message))
        return -1;
    if (endless)
        cgt_notices_add(&figure->notices,
                        "frame %" PRIu64 " has a molecule that is bonded to its own image: it stays as it is",
                        s->frame.number);
    return 0;
}

/* Takes it, behind the frame before. */
static int take_frame(cgt_figure *figure)
{
    figure->next = figure->sequence.frame.number + 1;
    return cgt_frame_sequence_take(&figure->sequence, figure->message, sizeof figure->message);
}

static int begin_survey(cgt_figure *figure, const cgt_figure_data *data)
{
    if (cgt_figure_open(figure))
        return -1;
    memcpy(figure->origin, data->frame ? data->frame->origin : data->origin, sizeof figure->origin);
    cgt_survey_begin(&figure->team, &figure->sequence, cgt_figure_begin_fit(figure), figure->context, &figure->survey);
    figure->has_survey = figure->is_surveying = 1;
    figure->next = UINT64_MAX;
    return 0;
}

static int look(cgt_figure *figure, const cgt_figure_data *data)
{
    frame_sequence *const s = &figure->sequence;
    if (!figure->is_surveying && begin_survey(figure, data))
        return -1;
    const int is_second = figure->next == 1;
    if (place_frame(figure, data))
        return -1;
    if (is_second && s->frame.number == 1 && cgt_frame_sequence_looks_ahead(s) &&
        cgt_frame_sequence_look_ahead(s, &s->frame, figure->message, sizeof figure->message))
        return -1;
    if (take_frame(figure))
        return -1;
    cgt_survey_look(&figure->team);
    return 0;
}

cgt_result cgt_figure_survey(cgt_figure *figure, const cgt_figure_data *data)
{
    if (figure->has_survey && !figure->is_surveying) /* it has ended */
        begin_again(figure);
    return look(figure, data) ? fail_frame(figure) : CGT_OK;
}

static void end_survey(cgt_figure *figure)
{
    if (!figure->is_surveying)
        return;
    cgt_survey_end(&figure->team);
    figure->is_surveying = 0;
    figure->survey.has_total = 1;
    figure->survey.total = figure->survey.frames;
    figure->next = UINT64_MAX;
}

bool cgt_figure_get_origin(cgt_figure *figure, double origin[3])
{
    const figure_options *const o = &figure->options;
    double more[3], eye[3], target[3];
    end_survey(figure);
    for (int c = 0; c < 3; c++) {
        eye[c] = o->camera.eye[c] - figure->origin[c];
        target[c] = o->camera.target[c] - figure->origin[c];
    }
    const int is_far = o->has_camera ? cgt_origin_of_camera(eye, target, more)
                                     : figure->has_survey && figure->survey.kind == CGT_TRAJECTORY_SPHERES &&
                                           cgt_origin_of_bulk(&figure->survey.bulk, more);
    for (int c = 0; c < 3; c++)
        origin[c] = figure->origin[c] + (is_far ? more[c] : 0.0);
    return is_far;
}

/* After the survey: all choices. */
static int settle(cgt_figure *figure)
{
    const uint32_t trails = figure->options.particles.trails;
    end_survey(figure);
    figure->is_mesh = figure->survey.kind == CGT_TRAJECTORY_TRIANGLES;
    if (cgt_figure_move_cameras(figure) || cgt_figure_choose_colors(figure) ||
        (figure->mesh.frame.triangles && cgt_figure_scene_mesh(figure, &figure->mesh.frame)) ||
        cgt_figure_choose_camera(figure) || cgt_figure_settle(figure))
        return -1;
    if (trails && !(figure->sequence.trails = cgt_trail_history_create(trails)))
        return cgt_figure_fail(figure, "out of memory for the trails");
    figure->is_settled = 1;
    return 0;
}

/* What the frame must have. */
static int check_frame(cgt_figure *figure)
{
    const cgt_trajectory_frame *const f = &figure->sequence.frame;
    if (f->kind != figure->survey.kind)
        return cgt_figure_fail(figure, "frame %" PRIu64 " is of another kind than those before it", f->number);
    if (f->kind == CGT_TRAJECTORY_TRIANGLES && figure->coloring.by == COLORING_TYPE && !f->type)
        return cgt_figure_fail(figure, "color type: the triangles have no types");
    char bonds[256] = "";
    if (!figure->has_bonds_told && cgt_figure_check_bonds(&figure->options, f, bonds, sizeof bonds))
        return cgt_figure_fail(figure, "%s", bonds);
    if (*bonds)
        cgt_notices_add(&figure->notices, "%s", bonds);
    figure->has_bonds_told = 1;
    return 0;
}

static int show(cgt_figure *figure, const cgt_figure_data *data)
{
    frame_sequence *const s = &figure->sequence;
    if (!figure->is_settled && ((!figure->has_survey && look(figure, data)) || settle(figure)))
        return -1;
    if (place_frame(figure, data) || check_frame(figure) || take_frame(figure))
        return -1;
    if (cgt_coloring_apply(&figure->coloring, &s->frame, s->speed))
        return cgt_figure_fail(figure, "out of memory for the colours");
    if (cgt_figure_scene_prepare(figure, &s->frame, figure->coloring.index, &figure->drawn, figure->message,
                                 sizeof figure->message))
        return -1;
    if (cgt_frame_copy_set(&figure->copy, &s->frame))
        return cgt_figure_fail(figure, "out of memory for a copy of frame %" PRIu64, s->frame.number);
    figure->frame = &figure->copy.frame;
    figure->speed_from = s->speed_from;
    if (cgt_figure_scene_set(figure, &figure->drawn))
        return -1;
    const cgt_result result = cgt_scene_commit(figure->scene);
    if (result)
        return cgt_figure_fail_library(figure, "build", result);
    cgt_figure_camera_at(figure, figure->frame->number, &figure->camera);
    return 0;
}

cgt_result cgt_figure_show(cgt_figure *figure, const cgt_figure_data *data)
{
    return show(figure, data) ? fail_frame(figure) : CGT_OK;
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

cgt_result cgt_figure_get_camera(const cgt_figure *figure, cgt_camera *camera)
{
    if (!figure->frame)
        return CGT_ERROR_INVALID_ARGUMENT;
    *camera = figure->camera;
    return CGT_OK;
}

cgt_result cgt_figure_draw(cgt_figure *figure, const cgt_image *image, const cgt_trace_options *options)
{
    if (!figure->frame) {
        cgt_figure_fail(figure, "nothing is shown");
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    if (!figure->drawing && cgt_figure_open_picture(figure)) {
        cgt_figure_close_picture(figure);
        return result_of(figure);
    }
    const int has_gaps = image->row_stride && image->row_stride != 3 * (size_t)figure->options.width;
    if (figure->overlay.font && (!image->bytes || image->channels == 4 || has_gaps)) {
        cgt_figure_fail(figure, "texts need an image of three channels, without gaps between its rows");
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    figure->image = *image;
    const cgt_result result = cgt_figure_trace(figure, options);
    if (result)
        cgt_picture_get_error_message(figure->drawing, figure->message, sizeof figure->message);
    return result;
}
