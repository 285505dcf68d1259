/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls of <cgt/figure.h>: options, a survey of frames, frames that are shown, pictures. */
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure_state.h"
#include "options/figure_values.h"
#include "options/numbers.h"
#include "options/option_row.h"
#include "survey/origin.h"

/* ---- The figure --------------------------------------------------------------------------------------------- */

void cgt_figure_forget(cgt_figure *figure)
{
    const camera_keys keys = figure->options.keys;
    const frame_sequence told = {.is_endless = figure->sequence.is_endless,
                                 .is_followed = figure->sequence.is_followed};
    const notices untold = figure->notices;
    if (figure->is_surveying)
        cgt_survey_end(&figure->team);
    if (figure->shown)
        figure->shown->shown_by = NULL;
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
    figure->sequence = told; /* once is enough */
}

void cgt_figure_begin_again(cgt_figure *figure)
{
    char ignored[FIGURE_MESSAGE_SIZE]; /* they could be made before */
    cgt_figure_forget(figure);
    cgt_camera_keys_free(&figure->options.keys);
    cgt_figure_settings_replay(&figure->given, &figure->options, ignored, sizeof ignored);
}

cgt_result cgt_figure_result(cgt_figure *figure)
{
    const cgt_result told = figure->failure;
    figure->failure = CGT_OK;
    return told ? told : cgt_tells_of_memory(figure->message) ? CGT_ERROR_OUT_OF_MEMORY : CGT_ERROR_INVALID_ARGUMENT;
}

static cgt_result fail_frame(cgt_figure *figure)
{
    cgt_figure_begin_again(figure);
    return cgt_figure_result(figure);
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
    *figure = made;
    return cgt_figure_unset(made, NULL);
}

void cgt_figure_release(cgt_figure *figure)
{
    if (!figure)
        return;
    cgt_figure_forget(figure);
    cgt_camera_keys_free(&figure->options.keys);
    cgt_notices_free(&figure->notices);
    cgt_figure_settings_free(&figure->given);
    cgt_figure_data_free(&figure->mesh);
    cgt_frame_sequence_close(&figure->keeping.sequence);
    cgt_figure_data_free(&figure->keeping.data);
    free(figure);
}

size_t cgt_figure_get_error_message(const cgt_figure *figure, char *text, size_t size)
{
    const size_t length = strlen(figure->message);
    if (size > 0)
        snprintf(text, size, "%s", figure->message);
    return length;
}

void cgt_figure_set_source(cgt_figure *figure, const char *name) { figure->source = name; }

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
    if (row->parse == cgt_parse_color || row->parse == cgt_parse_floor)
        return CGT_FIGURE_COLOR;
    if (row->parse == cgt_parse_label_text)
        return CGT_FIGURE_TEXT;
    return row->parse == cgt_parse_formula || row->parse == cgt_parse_show || row->parse == cgt_parse_label
               ? CGT_FIGURE_FORMULA
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

static cgt_result change(cgt_figure *figure, settings_change change, const char *name, const char *value)
{
    if (figure->keeping.is_on)
        return cgt_figure_change(figure, change, name, value);
    if (cgt_figure_settings_change(&figure->given, change, name, value, &figure->options, figure->message,
                                   sizeof figure->message))
        return cgt_figure_result(figure);
    cgt_figure_forget(figure);
    return CGT_OK;
}

cgt_result cgt_figure_set(cgt_figure *figure, const char *name, const char *value)
{
    return change(figure, SETTINGS_SET, name, value);
}

cgt_result cgt_figure_unset(cgt_figure *figure, const char *name) { return change(figure, SETTINGS_UNSET, name, NULL); }

cgt_result cgt_figure_set_lines(cgt_figure *figure, const char *settings)
{
    return change(figure, SETTINGS_LINES, NULL, settings);
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
        cgt_figure_begin_again(figure);
        return CGT_OK;
    }
    cgt_figure_data_free(&taken);
    return cgt_figure_result(figure);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Makes the caller's data the sequence's frame, its molecules put together. */
static int place_frame(cgt_figure *figure, const cgt_figure_data *data)
{
    frame_sequence *const s = &figure->sequence;
    if (!data->frame && cgt_figure_data_take(&figure->data, data, figure->message, sizeof figure->message))
        return -1;
    s->frame = data->frame ? *data->frame : figure->data.frame;
    if (s->frame.number != figure->next)
        cgt_frame_sequence_restart(s);
    return cgt_frame_sequence_place(s, &s->frame, &figure->notices, figure->message, sizeof figure->message);
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
        cgt_figure_begin_again(figure);
    if (!look(figure, data))
        return CGT_OK;
    figure->next = UINT64_MAX;
    return figure->is_surveying && figure->survey.frames ? cgt_figure_result(figure) : fail_frame(figure);
}

bool cgt_figure_needs_frame(const cgt_figure *figure)
{
    const uint64_t all = UINT64_MAX, looked = figure->is_surveying ? figure->survey.frames : 0;
    const uint64_t needed = cgt_figure_needs_frames(figure, all);
    return looked == 0 || needed == all || (needed == 1 && (looked > 1 || !cgt_figure_is_decided(figure)));
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
    char text[300];
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
    if (is_far) {
        cgt_origin_tell(origin, o->has_camera ? "the camera looks at places" : "the spheres are", text, sizeof text);
        cgt_notices_add(&figure->notices, "%s", text);
    }
    return is_far;
}

int cgt_figure_choose(cgt_figure *figure, const figure_found *was)
{
    const uint32_t trails = figure->options.particles.trails;
    floor_options *const floor = &figure->options.floor;
    const int keeps_floor = was && was->keeps_floor && floor->is_set;
    end_survey(figure);
    if (cgt_figure_move_cameras(figure) ||
        (was && was->keeps_colors ? cgt_figure_keep_colors(figure, was) : cgt_figure_choose_colors(figure)))
        return -1;
    if (figure->keeping.is_on && cgt_coloring_has_range(&figure->coloring) &&
        !(figure->coloring.max > figure->coloring.min)) /* so that settings can tell it */
        figure->coloring.max = figure->coloring.min + fmax(1.0, fabs(figure->coloring.min));
    if (figure->mesh.frame.triangles && cgt_figure_scene_mesh(figure, &figure->mesh.frame))
        return -1;
    if (was && was->keeps_camera)
        figure->path = was->path;
    else if (cgt_figure_choose_camera(figure))
        return -1;
    if (keeps_floor) {
        *floor = was->floor;
        floor->has_place = 1; /* the one that was chosen */
    }
    if (was) {
        memcpy(figure->survey.bounds_min, was->bounds_min, sizeof was->bounds_min);
        memcpy(figure->survey.bounds_max, was->bounds_max, sizeof was->bounds_max);
    }
    if (cgt_figure_settle(figure))
        return -1;
    if (keeps_floor)
        floor->has_place = was->floor.has_place;
    if (trails && !(figure->sequence.trails = cgt_trail_history_create(trails)))
        return cgt_figure_fail(figure, "out of memory for the trails");
    if (figure->has_hand)
        cgt_figure_take_hand(figure);
    figure->is_settled = 1;
    return 0;
}

int cgt_figure_check_frame(cgt_figure *figure)
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

int cgt_figure_build(cgt_figure *figure, int is_kept)
{
    const frame_sequence *const s = &figure->sequence;
    figure->has_begun = 0;
    if (!figure->scene && cgt_figure_make_scene(figure))
        return -1;
    if (cgt_coloring_apply(&figure->coloring, &s->frame, s->speed))
        return cgt_figure_fail(figure, "out of memory for the colours");
    if (cgt_figure_scene_prepare(figure, &s->frame, figure->coloring.index, &figure->drawn, figure->message,
                                 sizeof figure->message))
        return -1;
    if (!is_kept && (cgt_frame_copy_set(&figure->copy, &s->frame) || cgt_frame_copy_index(&figure->copy)))
        return cgt_figure_fail(figure, "out of memory for a copy of frame %" PRIu64, s->frame.number);
    figure->frame = is_kept ? &s->frame : &figure->copy.frame;
    figure->speed_from = s->speed_from;
    if (cgt_figure_scene_set(figure, &figure->drawn))
        return -1;
    const cgt_result result = cgt_scene_commit(figure->scene);
    if (result)
        return cgt_figure_fail_library(figure, "build", result);
    cgt_figure_camera_at(figure, figure->frame->number, &figure->camera);
    figure->has_moved = 0;
    return 0;
}

static int show(cgt_figure *figure, const cgt_figure_data *data)
{
    cgt_figure_unshow(figure);
    if (!figure->is_settled && ((!figure->has_survey && look(figure, data)) || cgt_figure_choose(figure, NULL)))
        return -1;
    return place_frame(figure, data) || cgt_figure_check_frame(figure) || take_frame(figure) ||
                   cgt_figure_build(figure, 0)
               ? -1
               : 0;
}

cgt_result cgt_figure_show(cgt_figure *figure, const cgt_figure_data *data)
{
    const int had_survey = figure->has_survey;
    if (!show(figure, data))
        return CGT_OK;
    const int is_other = figure->sequence.frame.kind != figure->survey.kind; /* it begins a run of its own */
    if (!had_survey || !figure->is_settled || is_other)                      /* all that was found is of this frame */
        return fail_frame(figure);
    cgt_figure_clear(figure);
    figure->next = UINT64_MAX;
    return cgt_figure_result(figure);
}

/* ---- Cameras ------------------------------------------------------------------------------------------------ */

cgt_result cgt_figure_get_camera(const cgt_figure *figure, cgt_camera *camera)
{
    if (!figure->is_settled)
        return CGT_ERROR_INVALID_ARGUMENT;
    *camera = figure->camera;
    return CGT_OK;
}

cgt_result cgt_figure_get_up(const cgt_figure *figure, float up[3])
{
    if (!figure->is_settled)
        return CGT_ERROR_INVALID_ARGUMENT;
    const float *const axis = figure->options.up;
    memcpy(up, axis[0] != 0.0f || axis[1] != 0.0f || axis[2] != 0.0f ? axis : figure->camera.up, 3 * sizeof *up);
    return CGT_OK;
}
