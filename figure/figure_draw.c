/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of a figure; see figure_state.h. cgt/picture.h makes them from what is chosen here. */
#include "figure_state.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/molecule/element_symbols.h"
#include "options/numbers.h"
#include "text/labels.h"

static void set_first_light(const cgt_figure *figure, cgt_picture_light *light)
{
    const picture_options *o = &figure->options.picture;
    *light = (cgt_picture_light){.light = {.kind = CGT_LIGHT_DIRECTIONAL}, .shadows = o->shadows > 0.0f};
    light->size = o->light_size;
    for (int c = 0; c < 3; c++) {
        light->light.position[c] = figure->light[c];
        light->color[c] = o->key;
    }
}

static void set_lamp(const cgt_figure *figure, const picture_lamp *lamp, cgt_picture_light *light)
{
    const picture_options *const o = &figure->options.picture;
    *light = (cgt_picture_light){.light = {.kind = lamp->kind}, .shadows = o->shadows > 0.0f, .size = o->light_size};
    for (int c = 0; c < 3; c++) {
        light->color[c] = lamp->strength * lamp->color[c];
        light->light.position[c] =
            lamp->kind == CGT_LIGHT_DIRECTIONAL ? lamp->place[c] : (float)(lamp->at[c] - figure->origin[c]);
    }
}

cgt_picture_options cgt_figure_get_settings(const cgt_figure *figure)
{
    const picture_options *o = &figure->options.picture;
    cgt_picture_options s = {
        .width = figure->options.width, .height = figure->options.height, .antialias = figure->options.samples};
    const int is_full = cgt_picture_options_need_drawing(o) || cgt_figure_scene_has_figures(figure) ||
                        figure->options.floor.is_set || figure->options.particles.layer_count;
    s.shading = figure->options.bounce.is_set ? CGT_SHADING_BOUNCES : is_full ? CGT_SHADING_FULL : CGT_SHADING_PLAIN;
    s.lighting.ambient = (uint32_t)o->ambient;
    s.lighting.ambient_radius =
        o->ambient_radius < 0.0f ? cgt_style_ambient_radius(&figure->path.start) : o->ambient_radius;
    s.lighting.light_samples = (uint32_t)o->light_samples;
    set_first_light(figure, &s.lighting.lights[s.lighting.light_count++]);
    for (uint32_t i = 0; i < o->lamp_count; i++)
        set_lamp(figure, &o->lamps[i], &s.lighting.lights[s.lighting.light_count++]);
    s.lighting.sky = o->sky;
    s.lighting.head = o->head;
    s.style.transparent = o->transparent;
    s.style.cue = o->cue;
    const cgt_camera *const camera = figure->options.keys.count ? &figure->camera : &figure->path.start;
    const float middle = cgt_style_distance(camera), reach = 0.6f * cgt_style_shown_height(camera);
    s.style.cue_range[0] = fmaxf(0.0f, middle - reach);
    s.style.cue_range[1] = middle + reach;
    s.style.outline = o->outline;
    for (int c = 0; c < 3; c++) {
        s.style.background[c] = cgt_srgb_decode(o->background[c]);
        s.style.outline_color[c] = 0.01f;
    }
    s.style.layer_count = figure->options.particles.layer_count;
    for (uint32_t k = 0; k < s.style.layer_count; k++)
        s.style.layers[k] = (cgt_picture_layer){cgt_figure_layer_mask(&figure->options.particles, k + 1),
                                                figure->options.particles.layers[k]};
    if (figure->bounce)
        cgt_figure_bounce_settings(figure, &s);
    s.work.stop = figure->stop;
    s.work.stop_user = figure->stop_user;
    return s;
}

/* The orthographic camera shows what the perspective one shows at its target. */
static void set_projection(const cgt_figure *figure, cgt_camera *camera)
{
    if (!figure->options.picture.ortho)
        return;
    camera->projection = CGT_PROJECTION_ORTHOGRAPHIC;
    camera->height = cgt_style_shown_height(camera);
}

/* ---- Overlay ------------------------------------------------------------------------------------------------ */

static void name_kind(const cgt_figure *figure, int64_t kind, char *name, size_t size)
{
    const char *const given = cgt_figure_name_of(figure, kind);
    if (given)
        snprintf(name, size, "%s", given);
    else if (figure->coloring.by == COLORING_CATEGORY)
        cgt_categories_name(&figure->categories, kind, name, size);
    else if (figure->coloring.by == COLORING_TYPE)
        snprintf(name, size, "type %" PRId64, kind);
    else
        snprintf(name, size, "%s", kind ? element_symbol((uint32_t)kind) : "others");
}

static void add_kind(cgt_figure *figure, int64_t kind)
{
    overlay *const v = &figure->overlay;
    if (v->kind_count < OVERLAY_MOST_KINDS) {
        overlay_kind *const line = &figure->kinds[v->kind_count];
        memcpy(line->color, figure->coloring.palette[cgt_coloring_entry_of_kind(&figure->coloring, kind)],
               sizeof line->color);
        name_kind(figure, kind, line->name, sizeof line->name);
    }
    v->kind_count++;
}

/* Types, elements and categories in the order of their numbers; spheres that are no element or have no word come
 * last. */
static void choose_legend(cgt_figure *figure)
{
    const picture_options *o = &figure->options.picture;
    const int is_element = figure->coloring.by == COLORING_ELEMENT;
    const survey *const s = &figure->survey;
    overlay *v = &figure->overlay;
    v->legend = o->legend ? o->legend : o->bar;
    v->kinds = figure->kinds;
    if (figure->coloring.by == COLORING_CATEGORY) {
        int64_t *const kinds = v->legend ? cgt_categories_sort(&figure->categories) : NULL;
        for (size_t i = 0; kinds && i < figure->categories.shown.count; i++)
            add_kind(figure, kinds[i]);
        free(kinds);
        return;
    }
    for (uint32_t i = 1; i <= SURVEY_ELEMENTS && v->legend && is_element; i++)
        if (s->has_elements[i % SURVEY_ELEMENTS])
            add_kind(figure, i % SURVEY_ELEMENTS);
    for (uint32_t i = 0; i < SURVEY_TYPES && v->legend && !is_element; i++)
        if (s->has_types[i / 8] >> i % 8 & 1)
            add_kind(figure, i);
    if (v->legend && !is_element && s->type_max >= SURVEY_TYPES)
        cgt_notices_add(&figure->notices, "--legend: types from %d on are not counted", SURVEY_TYPES);
}

static void choose_bar(cgt_figure *figure)
{
    const picture_options *o = &figure->options.picture;
    figure->overlay.bar = o->bar;
    if (o->bar && !(figure->coloring.max > figure->coloring.min))
        cgt_notices_add(&figure->notices,
                        "--colorbar: the colours are those of neither types nor values of some range: there is no bar");
    if (o->legend)
        cgt_notices_add(
            &figure->notices,
            "--legend: the colours are those of neither types, elements nor categories: there is no legend");
}

/* Tells what no font has: it would be empty boxes. */
static void check_glyphs(cgt_figure *figure)
{
    const overlay *v = &figure->overlay;
    const char *texts[4 + OVERLAY_MOST_KINDS] = {v->title, v->time, v->bar, v->legend};
    char missing[64] = "";
    uint32_t first = 0, count = 4;
    for (uint32_t i = 0; i < v->kind_count && count < 4 + OVERLAY_MOST_KINDS; i++)
        texts[count++] = v->kinds[i].name;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t code = texts[i] ? cgt_text_find_missing(v->font, texts[i], missing, sizeof missing) : 0;
        first = first ? first : code;
    }
    if (first)
        cgt_notices_add(&figure->notices,
                        "no font is found for %s: boxes stand in their place; --font takes another one, and 'fc-list "
                        ":charset=%" PRIx32 "' tells which have them",
                        missing, first);
}

/* Frames with the extremes of all that were looked at: with their times, and where some are unknown without. */
static void choose_extremes(cgt_figure *figure)
{
    const survey *const s = &figure->survey;
    const survey_times *const t = &s->times;
    const uint64_t last = s->has_total && s->total ? s->total - 1 : t->number_max;
    overlay *const v = &figure->overlay;
    v->time_letters = t->letters;
    for (int known = 0; known < 2 && s->frames; known++)
        for (int end = 0; end < 2 && (known ? t->time_min <= t->time_max : t->has_unknown); end++)
            v->extreme[v->extremes++] = (overlay_frame){.number = end ? last : 0,
                                                        .step = end ? t->step_max : t->step_min,
                                                        .time = !known ? NAN
                                                                : end  ? t->time_max
                                                                       : t->time_min};
}

/* Tells what found no place. */
static void tell_layout(cgt_figure *figure)
{
    static const char *const names[LAYOUT_ITEMS] = {"title", "time", "scale-bar", "colorbar", "legend", "axes"};
    const layout *const l = &figure->overlay.layout;
    for (int i = 0; i < LAYOUT_ITEMS; i++)
        if (l->left_out >> i & 1u)
            cgt_notices_add(&figure->notices, "--%s: there is no room for it in %" PRIu32 "x%" PRIu32 " pixels",
                            names[i], figure->options.width, figure->options.height);
        else if (l->cut >> i & 1u)
            cgt_notices_add(&figure->notices, "--%s: it is too long, and cut short", names[i]);
}

int cgt_figure_choose_overlay(cgt_figure *figure)
{
    const picture_options *o = &figure->options.picture;
    const uint8_t *back = o->background;
    overlay *v = &figure->overlay;
    if (v->font || !cgt_picture_options_have_overlay(o))
        return 0;
    v->size = fmaxf(8.0f, o->text_size * (float)figure->options.height);
    v->font = cgt_text_open(o->font, v->size, figure->message, sizeof figure->message);
    if (!v->font)
        return -1;
    v->title = o->title;
    v->time = o->time;
    v->axes = o->axes;
    v->scale = o->scale;
    v->coloring = &figure->coloring;
    if (coloring_has_kinds(figure->coloring.by))
        choose_legend(figure);
    else
        choose_bar(figure);
    check_glyphs(figure);
    const float grey = back[0] + back[1] + back[2] > 384 ? 0.01f : 0.85f; /* dark on light, light on dark */
    for (int c = 0; c < 3; c++)
        v->color[c] = grey;
    choose_extremes(figure);
    cgt_overlay_place(v, figure->options.width, figure->options.height);
    tell_layout(figure);
    return 0;
}

/* Half of the height that the camera shows, at a depth. */
static double half_height(const cgt_camera *camera, double depth)
{
    const double pi = 3.14159265358979323846;
    return camera->projection == CGT_PROJECTION_ORTHOGRAPHIC ? 0.5 * (double)camera->height
                                                             : depth * tan((double)camera->fov * pi / 360.0);
}

static double get_depth(const cgt_camera *camera, const overlay_frame *frame, const float p[3], double at[2])
{
    double depth = 0.0;
    at[0] = at[1] = 0.0;
    for (int c = 0; c < 3; c++) {
        const double from = (double)p[c] - (double)camera->eye[c];
        at[0] += from * (double)frame->right[c];
        at[1] += from * (double)frame->up[c];
        depth += from * (double)frame->forward[c];
    }
    return depth;
}

/* At the places where the camera sees what they name. Tells once what has none. */
static void draw_labels(cgt_figure *figure, const canvas *c, const overlay_frame *frame)
{
    const label_list *const from = &figure->parts.frame->labels;
    text_label labels[LABELS_MOST];
    uint32_t count = 0;
    for (uint32_t i = 0; i < from->count; i++) {
        const particle_label *const l = &from->list[i];
        double at[2];
        const double depth = get_depth(&figure->camera, frame, l->place, at);
        const double scale = 0.5 * (double)c->height / half_height(&figure->camera, depth);
        if (depth > 0.0)
            labels[count++] = (text_label){(float)(0.5 * (double)c->width + scale * at[0]),
                                           (float)(0.5 * (double)c->height - scale * at[1]),
                                           (float)(scale * (double)l->radius), (float)depth, l->text};
    }
    const uint32_t dropped = cgt_labels_draw(&figure->overlay, c, labels, count);
    if (figure->has_labels_told || (!dropped && from->matched <= LABELS_MOST))
        return;
    figure->has_labels_told = 1;
    if (from->matched > LABELS_MOST)
        cgt_notices_add(&figure->notices, "--label: the first %d of %" PRIu64 " spheres have labels", LABELS_MOST,
                        from->matched);
    if (dropped)
        cgt_notices_add(&figure->notices,
                        "--label: in frame %" PRIu64 " there is no room for %" PRIu32 " of %" PRIu32 " labels",
                        figure->frame->number, dropped, count);
}

void cgt_figure_draw_overlay(cgt_figure *figure)
{
    const canvas c = {figure->options.width, figure->options.height, figure->image};
    overlay_frame frame = {.number = figure->frame->number,
                           .step = figure->frame->step,
                           .time = figure->frame->time,
                           .angstrom = (double)figure->parts.frame->angstrom};
    double middle[2];
    if (!figure->overlay.font)
        return;
    cgt_camera_get_axes(&figure->camera, frame.right, frame.up, frame.forward);
    const double depth = get_depth(&figure->camera, &frame, figure->camera.target, middle);
    frame.pixel = 2.0 * half_height(&figure->camera, depth) / (double)c.height;
    if (!figure->has_time_told && cgt_overlay_lacks_time(&figure->overlay, &frame)) {
        figure->has_time_told = 1;
        cgt_notices_add(&figure->notices,
                        "--time: frame %" PRIu64 " has no time, - stands in its place; {step} is the step",
                        figure->frame->number);
    }
    if (!figure->has_unit_told && cgt_scale_bar_is_unknown(&figure->overlay.scale, frame.angstrom)) {
        figure->has_unit_told = 1;
        cgt_notices_add(
            &figure->notices,
            "--scale-bar: \"%s\" is none of the units fm, pm, Angstrom, nm, um, mm, cm, m: the bar is so long "
            "in the data's own unit, %s Angstrom",
            figure->overlay.scale.unit, cgt_number(6, 1.0 / frame.angstrom).text);
    }
    if (figure->parts.frame->labels.count) {
        draw_labels(figure, &c, &frame);
    } else if (*figure->options.picture.label && !figure->has_labels_told) {
        figure->has_labels_told = 1;
        cgt_notices_add(&figure->notices, "--label: in frame %" PRIu64 " the formula holds for no sphere that is shown",
                        figure->frame->number);
    }
    if (cgt_overlay_draw(&figure->overlay, &c, &frame) && !figure->has_scale_told) {
        figure->has_scale_told = 1;
        cgt_notices_add(&figure->notices,
                        "--scale-bar: in frame %" PRIu64
                        " this length is above 0.4 of the picture's width, or below two "
                        "pixels: there is no bar",
                        figure->frame->number);
    }
}

/* ---- Pictures -------------------------------------------------------------------------------------------------- */

int cgt_figure_open_picture(cgt_figure *figure)
{
    if (cgt_figure_choose_overlay(figure))
        return -1;
    const cgt_picture_options settings = cgt_figure_get_settings(figure);
    const cgt_result result = cgt_picture_create(figure->context, &settings, &figure->drawing);
    if (result == CGT_ERROR_OUT_OF_MEMORY)
        return cgt_figure_fail(figure,
                               "out of memory for the planes of %" PRIu32 "x%" PRIu32 " rays: --style plain takes none",
                               settings.width * settings.antialias, settings.height * settings.antialias);
    if (result) {
        char reason[256];
        cgt_picture_get_error_message(figure->drawing, reason, sizeof reason);
        cgt_figure_fail(figure, "cannot make pictures: %s", reason);
        figure->failure = result;
        return -1;
    }
    return 0;
}

void cgt_figure_close_picture(cgt_figure *figure)
{
    cgt_picture_release(figure->drawing);
    figure->drawing = NULL;
    figure->has_begun = 0;
    for (int i = 0; i < CGT_FIGURE_QUALITIES; i++) {
        cgt_picture_release(figure->quick[i]);
        figure->quick[i] = NULL;
    }
    free(figure->small);
    figure->small = NULL;
    cgt_text_close(figure->overlay.font);
    memset(&figure->overlay, 0, sizeof figure->overlay);
}

uint32_t cgt_figure_begin_picture(cgt_figure *figure, cgt_look *looks)
{
    set_projection(figure, &figure->camera);
    return figure->bounce ? cgt_figure_bounce_looks(figure->bounce, looks) : cgt_figure_scene_looks(figure, looks);
}

cgt_result cgt_figure_trace(cgt_figure *figure, const cgt_trace_options *options)
{
    cgt_look looks[FIGURE_LOOKS];
    const uint32_t count = cgt_figure_begin_picture(figure, looks);
    cgt_result result = CGT_OK;
    if (figure->options.keys.count && figure->options.picture.cue > 0.0f) { /* depths of this frame's camera */
        const cgt_picture_options settings = cgt_figure_get_settings(figure);
        result = cgt_picture_set_options(figure->drawing, &settings);
    }
    if (result == CGT_OK)
        result =
            cgt_picture_draw(figure->drawing, figure->scene, &figure->camera, looks, count, &figure->image, options);
    if (result == CGT_OK)
        cgt_figure_draw_overlay(figure);
    return result;
}
