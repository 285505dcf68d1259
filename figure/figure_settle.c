/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is chosen before the first picture, where no option says it: origin, colours, camera, light; see
 * figure_state.h. */
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "survey/origin.h"
#include "figure_state.h"
#include "options/numbers.h"

/* ---- Failures ----------------------------------------------------------------------------------------------- */

int cgt_figure_fail(cgt_figure *figure, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(figure->message, sizeof figure->message, format, arguments);
    va_end(arguments);
    figure->failure = cgt_tells_of_memory(format) ? CGT_ERROR_OUT_OF_MEMORY : CGT_ERROR_INVALID_ARGUMENT;
    return -1;
}

static int fail_frame(cgt_figure *figure, const char *action, const char *message, cgt_result result)
{
    cgt_figure_fail(figure, "%s: frame %" PRIu64 ": cannot %s: %s", figure->source,
                    figure->frame ? figure->frame->number : 0, action,
                    *message ? message : cgt_get_result_string(result));
    figure->failure = result;
    return -1;
}

int cgt_figure_fail_library(cgt_figure *figure, const char *action, cgt_result result)
{
    char message[512];
    cgt_context_get_error_message(figure->context, message, sizeof message);
    return fail_frame(figure, action, message, result);
}

int cgt_figure_fail_picture(cgt_figure *figure, cgt_result result)
{
    char message[512];
    cgt_picture_get_error_message(figure->drawing, message, sizeof message);
    return fail_frame(figure, "trace", message, result);
}

/* ---- What must be known ------------------------------------------------------------------------------------- */

/* Whether the colours may turn out to be those of words. */
static int may_have_words(const figure_options *o) { return o->by == COLORING_VALUE && o->is_name; }

int cgt_figure_wants_kinds(const figure_options *o)
{
    return (o->picture.legend || o->picture.bar) &&
           (o->by == COLORING_AUTO || coloring_has_kinds(o->by) || may_have_words(o));
}

unwrap_mode cgt_figure_unwraps(const figure_options *o)
{
    return o->whole ? UNWRAP_WHOLE : o->unwrap ? UNWRAP_IMAGES : UNWRAP_NOT;
}

/* Of the colours, or of what is drawn. */
static int formulas_use_speed(const frame_sequence *s)
{
    int uses = 0;
    for (uint32_t i = 0; i < s->formula_count; i++)
        uses |= cgt_expression_uses(s->formulas[i], "speed");
    return uses;
}

int cgt_figure_open(cgt_figure *figure)
{
    const figure_options *o = &figure->options;
    frame_sequence *const sequence = &figure->sequence;
    if (figure->is_open)
        return 0;
    figure->is_open = 1;
    if ((o->by == COLORING_VALUE || o->by == COLORING_CATEGORY) &&
        !(figure->formula = cgt_expression_parse(o->formula, figure->message, sizeof figure->message)))
        return -1;
    cgt_frame_atoms_set(&sequence->atoms, o->particles.types, o->particles.type_count,
                        cgt_figure_options_need_bonds(o));
    sequence->wants_kinds = cgt_figure_wants_kinds(o);
    figure->categories.takes_numbers = o->by == COLORING_CATEGORY;
    sequence->categories = o->by == COLORING_CATEGORY || may_have_words(o) ? &figure->categories : NULL;
    if (cgt_frame_sequence_unwrap(sequence, cgt_figure_unwraps(o), figure->message, sizeof figure->message) ||
        cgt_frame_sequence_bind(sequence, figure->formula, figure->message, sizeof figure->message) ||
        cgt_figure_scene_open(figure))
        return -1;
    if ((o->by == COLORING_AUTO || o->by == COLORING_SPEED || formulas_use_speed(sequence)) &&
        !(sequence->tracker = cgt_speed_create(figure->context)))
        return cgt_figure_fail(figure, "out of memory");
    return 0;
}

uint64_t cgt_figure_needs_frames(const cgt_figure *figure, uint64_t most)
{
    const figure_options *o = &figure->options;
    const int is_measured = o->by != COLORING_PLAIN && o->by != COLORING_AUTO && !coloring_has_kinds(o->by);
    if (!o->has_camera || (is_measured && !may_have_words(o) && !o->has_range) ||
        (o->floor.is_set && !o->floor.has_place) || cgt_figure_wants_kinds(o))
        return most;
    /* up axis, sky and ambient rays depend on the kind, and meshes of glass are as dark as they are large */
    return o->by == COLORING_AUTO || o->by == COLORING_HEIGHT || o->by == COLORING_CATEGORY || may_have_words(o) ||
           o->bounce.is_set || o->picture.ambient < 0;
}

int cgt_figure_is_decided(const cgt_figure *figure)
{
    const survey *s = &figure->survey;
    if (s->kind == CGT_TRAJECTORY_TRIANGLES && figure->options.bounce.count)
        return 0;
    if (may_have_words(&figure->options))
        return figure->categories.has_words || figure->options.has_range;
    return figure->options.by != COLORING_AUTO || s->kind == CGT_TRAJECTORY_TRIANGLES || s->has_element ||
           s->type_max > s->type_min;
}

const camera_directions *cgt_figure_begin_fit(cgt_figure *figure)
{
    if (figure->options.has_camera)
        return NULL;
    for (int kind = 0; kind < 2; kind++) {
        figure_options o = figure->options;
        cgt_figure_options_axes(&o, kind ? CGT_TRAJECTORY_TRIANGLES : CGT_TRAJECTORY_SPHERES);
        cgt_camera_directions_set(&figure->fit[kind], o.view, o.up, o.fov, (double)o.width / (double)o.height,
                                  (double)o.orbit, o.picture.ortho);
        if (cgt_picture_options_have_overlay(&o.picture) && !o.picture.ortho)
            cgt_camera_directions_add_plain(&figure->fit[kind]);
    }
    return figure->fit;
}

/* ---- Origin ------------------------------------------------------------------------------------------------- */

int cgt_figure_move_cameras(cgt_figure *figure)
{
    figure_options *const o = &figure->options;
    int same = o->has_camera && cgt_camera_key_move(&o->camera, figure->origin);
    for (size_t k = 0; k < o->keys.count; k++)
        same |= cgt_camera_key_move(&o->keys.key[k], figure->origin);
    if (same)
        return cgt_figure_fail(
            figure, "eye and target of the camera are the same point in single precision: an --origin near them helps");
    if (figure->has_survey)
        cgt_figure_options_axes(o, figure->survey.kind);
    return 0;
}

void cgt_figure_name_camera(const cgt_figure *figure, const cgt_camera *camera, char text[FIGURE_CAMERA_SIZE])
{
    const int digits = figure_is_moved(figure) ? 15 : 9;
    size_t used = 0;
    for (int c = 0; c < 10; c++) {
        const double value = c < 3   ? (double)camera->eye[c] + figure->origin[c]
                             : c < 6 ? (double)camera->target[c - 3] + figure->origin[c - 3]
                             : c < 9 ? (double)camera->up[c - 6]
                                     : (double)camera->fov;
        used += (size_t)snprintf(text + used, FIGURE_CAMERA_SIZE - used, "%s%c",
                                 cgt_number(c < 6 ? digits : 9, value).text, c < 9 ? ',' : '\n');
    }
}

/* ---- Colours ------------------------------------------------------------------------------------------------ */

/* What the survey must know of categories. */
static int check_categories(cgt_figure *figure)
{
    const categories *const c = &figure->categories;
    if (figure->survey.kind == CGT_TRAJECTORY_TRIANGLES)
        return cgt_figure_fail(figure, "--%s: categories are of spheres, and these are triangles",
                               figure->options.by == COLORING_CATEGORY ? "category" : "color");
    if (c->has_fraction && !c->has_words)
        return cgt_figure_fail(figure,
                               "--category: \"%s\" has the value %s: it takes whole numbers, as floor() makes them, or "
                               "words; --color shows amounts",
                               figure->options.formula, cgt_number(6, c->fraction).text);
    return c->failed ? cgt_figure_fail(figure, "out of memory for the categories") : 0;
}

/* Chooses all but what is told of kinds. */
static int set_colors(cgt_figure *figure)
{
    const figure_options *o = &figure->options;
    const int is_words = may_have_words(o) && figure->categories.has_words;
    const coloring_by by = is_words                 ? COLORING_CATEGORY
                           : o->by == COLORING_AUTO ? cgt_coloring_choose(&figure->survey)
                                                    : o->by;
    if (by == COLORING_CATEGORY && check_categories(figure))
        return -1;
    const int axis = o->vertical ? o->vertical - 1 : 2;
    double min = o->range_min, max = o->range_max;
    if (!o->has_range)
        cgt_coloring_choose_range(&figure->survey, by, axis, o->logarithmic, figure->origin, &min, &max);
    if (o->is_symmetric)
        cgt_coloring_make_symmetric(&min, &max);
    if (!figure_is_moved(figure)) { /* near 0 single precision does, and is what settings are printed in */
        min = (double)(float)min;
        max = (double)(float)max;
    }
    if (is_words)
        min = max = 0.0;
    const int is_chosen = o->by == COLORING_AUTO && by == COLORING_ID;
    if ((is_chosen || by == COLORING_SPEED) && cgt_coloring_has_jumps(&figure->survey))
        cgt_notices_add(&figure->notices,
                        "spheres move by more than half of the run's extent in one frame, as through the boundary of a "
                        "periodic box, but the file has no box: %s",
                        is_chosen ? "colours are not chosen by speed" : "speeds may be false");
    if (by == COLORING_PLAIN ? cgt_coloring_init_plain(&figure->coloring, o->plain)
                             : cgt_coloring_init(&figure->coloring, by, o->map, min, max))
        return cgt_figure_fail(figure, "out of memory");
    if (o->own_map.count)
        cgt_coloring_set_table(&figure->coloring, &o->own_map);
    figure->coloring.axis = axis;
    figure->coloring.formula = figure->formula;
    figure->coloring.categories = &figure->categories;
    const int has_range = cgt_coloring_has_range(&figure->coloring);
    figure->coloring.logarithmic = o->logarithmic && has_range && min > 0.0;
    cgt_figure_scene_color(figure);
    if (o->logarithmic && !has_range)
        cgt_notices_add(&figure->notices, "--log-scale: the colours are not those of values: there is no scale");
    else if (o->logarithmic && !figure->coloring.logarithmic)
        cgt_notices_add(&figure->notices, "--log-scale: the range begins at %s, not above 0: the scale is linear",
                        cgt_number(6, min).text);
    return 0;
}

int cgt_figure_choose_colors(cgt_figure *figure)
{
    const survey *const s = &figure->survey;
    const coloring_by by = figure->options.by;
    if (set_colors(figure))
        return -1;
    if (figure->has_survey && s->drawable &&
        ((by == COLORING_ELEMENT && !s->has_element) || (by == COLORING_TYPE && !s->has_type)))
        cgt_notices_add(&figure->notices, "--color: the data have no %s: all have one colour",
                        by == COLORING_TYPE ? "types" : "chemical elements");
    return 0;
}

/* Nothing is told twice. */
int cgt_figure_keep_colors(cgt_figure *figure, const figure_found *was)
{
    figure_options *const o = &figure->options;
    const coloring_by by = o->by;
    const int has_range = o->has_range;
    const double range[2] = {o->range_min, o->range_max};
    o->by = was->by;
    o->has_range = 1;
    o->range_min = was->min;
    o->range_max = was->max;
    const int failed = set_colors(figure);
    o->by = by;
    o->has_range = has_range;
    o->range_min = range[0];
    o->range_max = range[1];
    return failed;
}

/* ---- Bonds -------------------------------------------------------------------------------------------------- */

int cgt_figure_check_bonds(const figure_options *o, const cgt_trajectory_frame *frame, char *text, size_t size)
{
    const char *const asks = o->particles.bonds && !(o->particles.bond_distance > 0.0f) ? "--bonds"
                             : o->whole                                                 ? "--whole"
                             : o->unwrap                                                ? "--unwrap"
                                                                                        : NULL;
    *text = '\0';
    if (!asks || frame->kind == CGT_TRAJECTORY_TRIANGLES)
        return 0;
    if (frame->bond_source == CGT_TRAJECTORY_BONDS_UNKNOWN && strcmp(asks, "--bonds") == 0) {
        snprintf(text, size, "--bonds: the file has no bonds; give the longest distance of two that are bonded%s",
                 frame->type ? ", or the elements of its types by --type-element" : "");
        return -1;
    }
    if (frame->bond_source == CGT_TRAJECTORY_BONDS_GUESSED)
        snprintf(text, size, "%s: the file has no bonds: they are guessed by the covalent radii of its elements", asks);
    if (frame->bond_source == CGT_TRAJECTORY_BONDS_BOTH)
        snprintf(text, size, "%s: the file lists some bonds: the others are guessed by covalent radii", asks);
    return 0;
}

/* ---- Camera and light --------------------------------------------------------------------------------------- */

enum { BOUNDS_SIZE = 256 };

/* "from (0, 0, 0) to (1, 1, 1)", in the file's coordinates. */
static void write_bounds(const cgt_figure *figure, const float min[3], const float max[3], char text[BOUNDS_SIZE])
{
    const int digits = figure_is_moved(figure) ? 15 : 6;
    const double *const o = figure->origin;
    const double at[6] = {o[0] + (double)min[0], o[1] + (double)min[1], o[2] + (double)min[2],
                          o[0] + (double)max[0], o[1] + (double)max[1], o[2] + (double)max[2]};
    snprintf(text, BOUNDS_SIZE, "from (%s, %s, %s) to (%s, %s, %s)", cgt_number(digits, at[0]).text,
             cgt_number(digits, at[1]).text, cgt_number(digits, at[2]).text, cgt_number(digits, at[3]).text,
             cgt_number(digits, at[4]).text, cgt_number(digits, at[5]).text);
}

/* What the camera must show of a bulk: all within its bounds where that is among the samples, else the bounds. */
static void narrow_reach(survey *s, const camera_directions *fit)
{
    const bulk *const b = &s->bulk;
    camera_reach within;
    cgt_camera_reach_clear(&within);
    if (b->count < b->seen)
        cgt_camera_reach_add_box(&within, fit, s->bounds_min, s->bounds_max);
    for (uint32_t i = 0; i < b->count && b->count == b->seen; i++) {
        const float *const p = b->sample[i].place;
        const double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
        int is_inside = 1;
        for (int c = 0; c < 3; c++)
            is_inside &= p[c] - p[3] >= s->bounds_min[c] && p[c] + p[3] <= s->bounds_max[c];
        if (is_inside)
            cgt_camera_reach_add(&within, fit, place, (double)p[3]);
    }
    for (uint32_t k = 0; k < fit->count; k++)
        s->reach.along[k] = fmin(s->reach.along[k], within.along[k]);
}

/* The camera, and what depends on the scene's size, follow the bulk: one primitive that has flown off must not make all
 * others a dot. */
static void follow_bulk(cgt_figure *figure)
{
    survey *s = &figure->survey;
    int narrowed;
    const float was_min[3] = {s->bounds_min[0], s->bounds_min[1], s->bounds_min[2]};
    const float was_max[3] = {s->bounds_max[0], s->bounds_max[1], s->bounds_max[2]};
    const uint64_t outside = cgt_bulk_narrow(&s->bulk, s->bounds_min, s->bounds_max, &narrowed);
    if (narrowed)
        narrow_reach(s, figure_fit(figure));
    if (!narrowed || figure->options.has_camera)
        return;
    char bounds[2][BOUNDS_SIZE];
    write_bounds(figure, s->bounds_min, s->bounds_max, bounds[0]);
    write_bounds(figure, was_min, was_max, bounds[1]);
    cgt_notices_add(&figure->notices,
                    "the camera follows the bulk, %s, and leaves out about %" PRIu64 " of %" PRIu64
                    " %s%s of the run, which reaches %s",
                    bounds[0], outside, s->drawable, s->hidden ? "shown " : "",
                    s->kind == CGT_TRAJECTORY_TRIANGLES ? "triangles" : "spheres", bounds[1]);
}

/* The automatic camera shows the scene where texts leave room for it. Returns 0, 1 where floats cannot hold it, or -1.
 */
static int fit_camera(cgt_figure *figure)
{
    const survey *const s = &figure->survey;
    const camera_directions *const fit = figure_fit(figure);
    layout *const l = &figure->overlay.layout;
    camera_room rooms[sizeof l->room / sizeof l->room[0]];
    if (!cgt_picture_options_have_overlay(&figure->options.picture))
        return cgt_camera_path_fit(&figure->path, fit, &s->reach, s->bounds_min, s->bounds_max) ? 1 : 0;
    if (cgt_figure_choose_overlay(figure))
        return -1;
    for (uint32_t i = 0; i < l->rooms; i++) {
        const layout_rect *const r = &l->room[i];
        rooms[i] = cgt_camera_room_between(r->x0, r->y0, r->x1, r->y1, figure->options.width, figure->options.height);
    }
    return cgt_camera_path_fit_room(&figure->path, fit, &s->reach, s->bounds_min, s->bounds_max, rooms, l->rooms,
                                    &l->chosen)
               ? 1
               : 0;
}

int cgt_figure_choose_camera(cgt_figure *figure)
{
    const figure_options *o = &figure->options;
    const camera_directions *const fit = figure_fit(figure);
    survey *const s = &figure->survey;
    if (s->drawable)
        follow_bulk(figure);
    if (o->has_camera) {
        cgt_camera_path_fixed(&figure->path, &o->camera.camera, (double)o->orbit);
        cgt_figure_scene_bound(figure);
        return 0;
    }
    cgt_figure_scene_bound(figure);
    if (!s->drawable) {
        if (s->hidden)
            cgt_notices_add(&figure->notices, "--show, --hide, --slice and --cut leave out all spheres of the run");
        for (int c = 0; c < 3; c++) {
            s->bounds_min[c] = -1.0f;
            s->bounds_max[c] = 1.0f;
        }
        cgt_camera_reach_add_box(&s->reach, fit, s->bounds_min, s->bounds_max);
    }
    const int result = fit_camera(figure);
    if (result < 0)
        return -1;
    if (result == 0) {
        if (o->zoom > 0.0f)
            cgt_camera_path_zoom(&figure->path, o->zoom);
        return 0;
    }
    char bounds[BOUNDS_SIZE];
    write_bounds(figure, s->bounds_min, s->bounds_max, bounds);
    return cgt_figure_fail(figure, "%s: the scene, %s, is too large for an automatic camera: give one with -c",
                           figure->source, bounds);
}

void cgt_figure_choose_light(cgt_figure *figure)
{
    const figure_options *o = &figure->options;
    if (o->has_light)
        memcpy(figure->light, o->light, sizeof figure->light);
    else
        cgt_camera_get_key_light(&figure->camera, o->width, o->height, figure->light);
}

void cgt_figure_camera_at(const cgt_figure *figure, uint64_t number, cgt_camera *camera)
{
    const double share = figure->survey.has_total ? (double)number / (double)figure->survey.total : 0.0;
    if (figure->has_hand)
        *camera = figure->hand;
    else if (figure->options.keys.count)
        cgt_camera_keys_at(&figure->options.keys, number, camera);
    else
        cgt_camera_path_at(&figure->path, share, camera);
}

void cgt_figure_take_hand(cgt_figure *figure)
{
    cgt_camera_path_fixed(&figure->path, &figure->hand, 0.0);
    figure->camera = figure->hand;
    cgt_figure_choose_light(figure);
}

/* ---- All that is left ---------------------------------------------------------------------------------------- */

/* Speeds that neither the colours show nor a formula has are not looked for. */
static void drop_speeds(cgt_figure *figure)
{
    if (figure->coloring.by == COLORING_SPEED || formulas_use_speed(&figure->sequence))
        return;
    cgt_speed_release(figure->sequence.tracker);
    figure->sequence.tracker = NULL;
}

void cgt_figure_choose_ambient(cgt_figure *figure)
{
    picture_options *const o = &figure->options.picture;
    const style_values *const s = cgt_style_get(o->style);
    if (o->ambient < 0)
        o->ambient =
            figure->has_survey && figure->survey.kind == CGT_TRAJECTORY_TRIANGLES ? s->mesh_ambient : s->ambient;
}

int cgt_figure_make_scene(cgt_figure *figure)
{
    const cgt_result result = cgt_scene_create(figure->context, NULL, &figure->scene);
    if (result)
        return cgt_figure_fail_library(figure, "make a scene", result);
    return figure->options.bounce.is_set ? cgt_figure_bounce_create(figure) : 0;
}

int cgt_figure_settle(cgt_figure *figure)
{
    figure_options *const o = &figure->options;
    drop_speeds(figure);
    const int rays = (int)(o->samples * o->samples), is_first = !figure->shown;
    if (is_first && o->picture.ambient > 0 && o->picture.ambient < rays)
        cgt_notices_add(&figure->notices, "--ambient: each of a pixel's %d rays asks once: as with %d", rays, rays);
    if (is_first)
        cgt_figure_tell_unused(figure);
    cgt_figure_choose_ambient(figure);
    cgt_camera_path_at(&figure->path, 0.0, &figure->camera);
    cgt_figure_choose_light(figure);
    if (o->floor.is_set)
        cgt_figure_scene_floor(figure);
    return cgt_figure_make_scene(figure);
}

void cgt_figure_unmake(cgt_figure *figure)
{
    cgt_figure_close_picture(figure);
    cgt_figure_bounce_release(figure->bounce);
    cgt_scene_release(figure->scene);
    cgt_coloring_free(&figure->coloring);
    cgt_figure_scene_close(figure);
    cgt_frame_sequence_close(&figure->sequence);
    cgt_expression_free(figure->formula);
    cgt_camera_keys_free(&figure->options.keys);
    memset(&figure->coloring, 0, sizeof figure->coloring);
    memset(&figure->parts, 0, sizeof figure->parts);
    figure->bounce = NULL;
    figure->scene = NULL;
    figure->formula = NULL;
    figure->frame = NULL;
    figure->has_geometry = figure->has_bonds_told = figure->is_open = 0;
}

void cgt_figure_close(cgt_figure *figure)
{
    cgt_figure_unmake(figure);
    cgt_categories_free(&figure->categories);
    cgt_notices_free(&figure->notices);
}
