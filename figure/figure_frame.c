/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames that are kept, and options that change while one of them is shown; see figure_state.h. */
#include "figure_state.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/numbers.h"
#include "options/option_row.h"

/* ---- Keeping ------------------------------------------------------------------------------------------------ */

static int open_keeping(cgt_figure *figure)
{
    frame_keeping *const k = &figure->keeping;
    frame_sequence *const s = &k->sequence;
    const uint32_t trails = figure->options.particles.trails;
    k->next = UINT64_MAX;
    s->is_endless = figure->sequence.is_endless; /* what the survey has told */
    s->is_followed = figure->sequence.is_followed;
    s->tracker = cgt_speed_create(figure->context); /* colours may change to speeds */
    s->trails = trails ? cgt_trail_history_create(trails) : NULL;
    cgt_frame_atoms_set(&s->atoms, figure->options.particles.types, figure->options.particles.type_count,
                        cgt_figure_options_need_bonds(&figure->options));
    k->is_on = s->tracker && (s->trails || !trails);
    if (k->is_on &&
        !cgt_frame_sequence_unwrap(s, cgt_figure_unwraps(&figure->options), figure->message, sizeof figure->message))
        return 0;
    cgt_frame_sequence_close(s);
    k->is_on = 0;
    return cgt_figure_fail(figure, "out of memory for the frames");
}

cgt_result cgt_figure_begin_keep(cgt_figure *figure, uint64_t *lead)
{
    if (!figure->keeping.is_on && open_keeping(figure))
        return cgt_figure_result(figure);
    if (figure->has_survey && !figure->is_settled && cgt_figure_choose(figure, NULL)) {
        cgt_figure_begin_again(figure);
        return cgt_figure_result(figure);
    }
    *lead = cgt_frame_sequence_lead(&figure->keeping.sequence);
    return CGT_OK;
}

static cgt_figure_frame *copy_frame(const frame_sequence *s)
{
    const size_t speed_bytes = s->speed ? s->frame.count * sizeof(float) : 0;
    cgt_figure_frame *const f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    f->data = cgt_frame_clone(&s->frame, &f->bytes);
    f->speed = s->speed ? malloc(speed_bytes + 1) : NULL;
    if (!f->data || (s->speed && !f->speed)) {
        cgt_figure_frame_release(f);
        return NULL;
    }
    if (speed_bytes)
        memcpy(f->speed, s->speed, speed_bytes);
    f->speed_from = s->speed_from;
    f->bytes += sizeof *f + speed_bytes;
    return f;
}

/* Takes a frame behind the one before; the second tells the speeds of the first, for when that comes again. */
static int take(frame_keeping *k, const cgt_figure_data *data, notices *told, char *text, size_t size)
{
    frame_sequence *const s = &k->sequence;
    if (!data->frame && cgt_figure_data_take(&k->data, data, text, size))
        return -1;
    s->frame = data->frame ? *data->frame : k->data.frame;
    if (s->frame.number != k->next)
        cgt_frame_sequence_restart(s);
    const int is_second = s->frame.number == 1 && k->next == 1;
    k->next = UINT64_MAX;
    if (cgt_frame_sequence_place(s, &s->frame, told, text, size) ||
        (is_second && cgt_frame_sequence_looks_ahead(s) && cgt_frame_sequence_look_ahead(s, &s->frame, text, size)) ||
        cgt_frame_sequence_take(s, text, size))
        return -1;
    k->next = s->frame.number + 1;
    return 0;
}

cgt_result cgt_figure_keep(cgt_figure *figure, const cgt_figure_data *data, cgt_figure_frame **frame, char *text,
                           size_t size)
{
    frame_keeping *const k = &figure->keeping;
    notices told = {.count = 0};
    const char *notice;
    char why[FIGURE_MESSAGE_SIZE]; /* not that of the figure, which another thread may call */
    size_t used = 0;
    if (frame)
        *frame = NULL;
    if (size)
        *text = '\0';
    int failed = !k->is_on || take(k, data, &told, why, sizeof why);
    if (!k->is_on)
        snprintf(why, sizeof why, "cgt_figure_begin_keep comes first");
    while ((notice = cgt_notices_take(&told)) != NULL)
        if (!failed && used < size)
            used += (size_t)snprintf(text + used, size - used, used ? "; %s" : "%s", notice);
    if (!failed && frame && !(*frame = copy_frame(&k->sequence))) {
        failed = 1;
        snprintf(why, sizeof why, "out of memory for frame %llu", (unsigned long long)k->sequence.frame.number);
    }
    if (!failed)
        return CGT_OK;
    if (size)
        snprintf(text, size, "%s", why);
    return cgt_tells_of_memory(why) ? CGT_ERROR_OUT_OF_MEMORY : CGT_ERROR_INVALID_ARGUMENT;
}

size_t cgt_figure_frame_get_bytes(const cgt_figure_frame *frame) { return frame->bytes; }
const struct cgt_trajectory_frame *cgt_figure_frame_get_data(const cgt_figure_frame *frame) { return frame->data; }

void cgt_figure_frame_release(cgt_figure_frame *frame)
{
    if (!frame)
        return;
    if (frame->shown_by)
        cgt_figure_unshow(frame->shown_by);
    free(frame->data);
    free(frame->speed);
    free(frame);
}

/* ---- Showing ------------------------------------------------------------------------------------------------ */

void cgt_figure_unshow(cgt_figure *figure)
{
    if (!figure->shown)
        return;
    figure->shown->shown_by = NULL;
    figure->shown = NULL;
    cgt_figure_clear(figure);
}

void cgt_figure_clear(cgt_figure *figure)
{
    figure_scene *const s = &figure->parts;
    figure->frame = NULL;
    cgt_scene_release(figure->scene);
    cgt_figure_bounce_release(figure->bounce);
    figure->scene = NULL;
    figure->bounce = NULL;
    figure->has_begun = 0;
    figure->has_geometry = s->has_sticks = s->has_facets = s->has_mesh = s->has_floor = 0;
    memset(s->has_layer_spheres, 0, sizeof s->has_layer_spheres);
    memset(s->has_layer_bonds, 0, sizeof s->has_layer_bonds);
}

/* The frame becomes the sequence's, with what belongs to it. Its bonds are guessed here where they were not asked for
 * when it was kept. */
static int take_kept(cgt_figure *figure, const cgt_figure_frame *frame)
{
    frame_sequence *const s = &figure->sequence;
    s->frame = *frame->data;
    s->speed = frame->speed;
    s->speed_from = frame->speed_from;
    if (s->atoms.wants_bonds && s->frame.bond_source == CGT_TRAJECTORY_BONDS_UNKNOWN &&
        cgt_frame_atoms_complete(&s->atoms, &s->frame, figure->message, sizeof figure->message))
        return -1;
    return cgt_frame_sequence_bind_all(s, figure->message, sizeof figure->message);
}

static void survey_kept(cgt_figure *figure)
{
    survey *const s = &figure->survey;
    const uint64_t total = figure->has_survey ? s->total : 1;
    survey_team team;
    cgt_survey_begin(&team, &figure->sequence, cgt_figure_begin_fit(figure), figure->context, s);
    cgt_survey_look(&team);
    cgt_survey_end(&team);
    s->has_total = 1;
    s->total = total;
    figure->has_survey = 1;
}

static int settle_by(cgt_figure *figure, const cgt_figure_frame *frame)
{
    if (!figure->has_survey) {
        if (cgt_figure_open(figure))
            return -1;
        memcpy(figure->origin, frame->data->origin, sizeof figure->origin);
        if (take_kept(figure, frame))
            return -1;
        survey_kept(figure);
    }
    return cgt_figure_choose(figure, NULL);
}

/* Trails are of the figure's own frames. */
static int check_trails(cgt_figure *figure)
{
    if (!figure->options.particles.trails || figure->keeping.sequence.trails)
        return 0;
    return cgt_figure_fail(figure, "trails: another figure has kept the frame, and this one none before it");
}

static int show_kept(cgt_figure *figure, cgt_figure_frame *frame)
{
    if (!figure->is_settled && settle_by(figure, frame)) {
        cgt_figure_begin_again(figure);
        return -1;
    }
    if (frame->shown_by && frame->shown_by != figure)
        cgt_figure_unshow(frame->shown_by); /* the frame knows one figure alone */
    if (figure->shown)
        figure->shown->shown_by = NULL;
    figure->shown = frame;
    frame->shown_by = figure;
    if (check_trails(figure) || take_kept(figure, frame) || cgt_figure_check_frame(figure) ||
        cgt_figure_build(figure, 1)) {
        cgt_figure_unshow(figure);
        return -1;
    }
    return 0;
}

cgt_result cgt_figure_show_frame(cgt_figure *figure, cgt_figure_frame *frame)
{
    return show_kept(figure, frame) ? cgt_figure_result(figure) : CGT_OK;
}

/* ---- Other options ------------------------------------------------------------------------------------------ */

/* What changes: the option of a name, or those of lines; both NULL: all options. */
typedef struct changed_options {
    const char *name, *lines;
} changed_options;

/* Whether a name is among those of a list with blanks around them. */
static int is_among(const char *name, const char *list)
{
    char word[32];
    snprintf(word, sizeof word, " %.24s ", name);
    return strstr(list, word) != NULL;
}

/* Whether one of the options is among those of such a list. */
static int are_among(const changed_options *changed, const char *list)
{
    const char *line = changed->lines;
    settings_line l;
    int is_one = changed->name ? is_among(changed->name, list) : !line;
    while (line && *line) {
        line = cgt_figure_settings_line(line, &l);
        is_one |= is_among(l.name, list);
    }
    return is_one;
}

/* Options that change how the scene is drawn, and not the scene. */
static int is_of_picture(const cgt_figure *figure, const char *name, const figure_options *next)
{
    const option_row *const row = name ? cgt_figure_find_row(name) : NULL;
    const size_t first = offsetof(figure_options, picture), end = first + sizeof figure->options.picture;
    if (!row || is_among(name, " label label-text ") || figure->options.bounce.is_set ||
        (cgt_figure_wants_kinds(next) && !figure->sequence.wants_kinds))
        return 0;
    return (row->at >= first && row->at < end) || is_among(name, " size antialias light ");
}

/* Takes over those options; all texts are those of `next`. */
static int change_picture(cgt_figure *figure, figure_options *next)
{
    figure_options *const o = &figure->options;
    const int has_other_edges = memcmp(o->picture.background, next->picture.background, 3) != 0;
    o->picture = next->picture;
    o->particles = next->particles;
    o->formula = next->formula;
    o->width = next->width;
    o->height = next->height;
    o->samples = next->samples;
    o->has_light = next->has_light;
    memcpy(o->light, next->light, sizeof o->light);
    cgt_camera_keys_free(&next->keys);
    cgt_figure_choose_ambient(figure);
    cgt_camera_path_at(&figure->path, 0.0, &figure->camera);
    cgt_figure_choose_light(figure);
    if (figure->frame)
        cgt_figure_camera_at(figure, figure->frame->number, &figure->camera);
    if (has_other_edges)
        cgt_figure_scene_color(figure);
    figure->has_moved = 1;
    cgt_figure_close_picture(figure);
    return cgt_figure_open_picture(figure);
}

/* Makes all anew, from the shown frame where it was not found before. */
static int change_all(cgt_figure *figure, figure_options *next, const figure_found *was)
{
    cgt_figure_unmake(figure);
    if (!was->keeps_colors)
        cgt_categories_free(&figure->categories);
    figure->options = *next;
    memset(&next->keys, 0, sizeof next->keys);
    if (cgt_figure_open(figure) || (figure->shown && take_kept(figure, figure->shown)))
        return -1;
    if (!was->keeps_colors || !was->keeps_camera || (figure->sequence.wants_kinds && !was->has_kinds) ||
        (figure->sequence.wants_kinds && figure->sequence.categories && !figure->categories.shown.count))
        survey_kept(figure);
    figure->survey.times = was->times;
    if (was->has_kinds) {
        memcpy(figure->survey.has_types, was->has_types, sizeof was->has_types);
        memcpy(figure->survey.has_elements, was->has_elements, sizeof was->has_elements);
    }
    if (cgt_figure_choose(figure, was))
        return -1;
    if (figure->shown && (cgt_figure_check_frame(figure) || cgt_figure_build(figure, 1)))
        return -1;
    return cgt_figure_open_picture(figure);
}

static void find_kept(const cgt_figure *figure, const changed_options *changed, figure_found *was)
{
    const int is_of_camera = are_among(changed, " camera camera-keys orbit view up fov zoom ");
    const int is_of_colors = are_among(changed, " color category range log-scale ") ||
                             (is_of_camera && figure->coloring.by == COLORING_HEIGHT);
    *was = (figure_found){.keeps_colors = !is_of_colors,
                          .keeps_camera = !is_of_camera,
                          .keeps_floor = !are_among(changed, " floor floor-axis floor-height floor-place "),
                          .has_kinds = figure->sequence.wants_kinds,
                          .by = figure->coloring.by,
                          .min = figure->coloring.min,
                          .max = figure->coloring.max,
                          .path = figure->path,
                          .floor = figure->options.floor,
                          .times = figure->survey.times};
    was->keeps_floor &= was->floor.is_set;
    memcpy(was->bounds_min, figure->survey.bounds_min, sizeof was->bounds_min);
    memcpy(was->bounds_max, figure->survey.bounds_max, sizeof was->bounds_max);
    memcpy(was->has_types, figure->survey.has_types, sizeof was->has_types);
    memcpy(was->has_elements, figure->survey.has_elements, sizeof was->has_elements);
}

static int has_other_types(const figure_options *o, const figure_options *next)
{
    const particle_options *const a = &o->particles, *const b = &next->particles;
    int differs = a->type_count != b->type_count;
    for (uint32_t i = 0; i < a->type_count && !differs; i++)
        differs = a->types[i].type != b->types[i].type || a->types[i].element != b->types[i].element;
    return differs;
}

/* Frames that are kept stay as they were taken. */
static int check_keeping(cgt_figure *figure, const figure_options *next)
{
    const figure_options *const o = &figure->options;
    const char *const name = cgt_figure_unwraps(o) != cgt_figure_unwraps(next)
                                 ? (o->whole || next->whole ? "whole" : "unwrap")
                             : o->particles.trails != next->particles.trails ? "trails"
                             : has_other_types(o, next)                      ? "type-element"
                                                                             : NULL;
    return name ? cgt_figure_fail(figure, "%s: the frames that are kept were taken otherwise", name) : 0;
}

/* Has the figure follow the options `next`; where it cannot, those of its settings again. */
static int follow(cgt_figure *figure, const changed_options *changed, figure_options *next)
{
    char ignored[FIGURE_MESSAGE_SIZE], why[FIGURE_MESSAGE_SIZE];
    figure_found was;
    find_kept(figure, changed, &was);
    const int is_small = is_of_picture(figure, changed->name, next), had_hand = figure->has_hand;
    if (!figure->is_settled || (!is_small && !figure->shown && !(was.keeps_colors && was.keeps_camera))) {
        cgt_figure_forget(figure); /* nothing was chosen, or there is no frame to find it by */
        cgt_camera_keys_free(&figure->options.keys);
        figure->options = *next;
        memset(&next->keys, 0, sizeof next->keys);
        return 0;
    }
    figure->has_hand = had_hand && was.keeps_camera;
    if ((is_small ? change_picture(figure, next) : change_all(figure, next, &was)) == 0)
        return 0;
    const cgt_result failure = figure->failure;
    memcpy(why, figure->message, sizeof why);
    cgt_camera_keys_free(&next->keys);
    figure->has_hand = had_hand;
    if (!was.keeps_colors)
        cgt_categories_free(&figure->categories); /* of what failed */
    was.keeps_colors = was.keeps_camera = was.keeps_floor = was.has_kinds = 1;
    if (cgt_figure_settings_replay(&figure->given, next, ignored, sizeof ignored) ||
        (is_small ? change_picture(figure, next) : change_all(figure, next, &was)))
        cgt_figure_begin_again(figure);
    memcpy(figure->message, why, sizeof why);
    figure->failure = failure;
    return -1;
}

cgt_result cgt_figure_change(cgt_figure *figure, settings_change change, const char *name, const char *value)
{
    const changed_options changed = {name, change == SETTINGS_LINES ? value : NULL};
    figure_settings next = {.count = 0};
    figure_options *const options = calloc(1, sizeof *options); /* too large for some stacks */
    int failed = 1;
    if (!options || cgt_figure_settings_copy(&figure->given, &next))
        cgt_figure_fail(figure, "out of memory for options");
    else if (cgt_figure_settings_change(&next, change, name, value, options, figure->message, sizeof figure->message) ==
             0)
        failed = check_keeping(figure, options) || follow(figure, &changed, options);
    if (!failed) {
        const figure_settings before = figure->given;
        figure->given = next;
        next = before;
    }
    cgt_figure_settings_free(&next);
    if (options)
        cgt_camera_keys_free(&options->keys);
    free(options);
    return failed ? cgt_figure_result(figure) : CGT_OK;
}
