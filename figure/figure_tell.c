/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls of <cgt/figure.h> that tell of the shown frame: what a pixel shows, what a particle is, what was chosen. */
#include "figure_state.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "data/molecule/element_symbols.h"
#include "options/numbers.h"

/* ---- Pixels ------------------------------------------------------------------------------------------------- */

cgt_result cgt_figure_pick(cgt_figure *figure, uint32_t x, uint32_t y, cgt_figure_hit *hit)
{
    const cgt_camera *const camera = &figure->camera;
    cgt_look looks[FIGURE_LOOKS];
    cgt_single_ray ray = {.t_min = camera->t_min, .t_max = camera->t_max, .mask = camera->mask};
    cgt_hit found;
    *hit = (cgt_figure_hit){.is_hit = false};
    if (!figure->frame) {
        cgt_figure_fail(figure, "nothing is shown");
        return cgt_figure_result(figure);
    }
    cgt_figure_begin_picture(figure, looks); /* the projection */
    cgt_result result =
        cgt_camera_get_ray(camera, figure->options.width, figure->options.height, x, y, ray.org, ray.dir);
    if (!result)
        result = cgt_trace_ray(figure->scene, &ray, &found, NULL);
    if (result) {
        cgt_figure_fail_library(figure, "pick", result);
        return cgt_figure_result(figure);
    }
    hit->is_hit = found.primitive != CGT_INVALID_ID;
    hit->t = found.t;
    for (int c = 0; c < 3 && hit->is_hit; c++)
        hit->place[c] = ray.org[c] + found.t * ray.dir[c];
    hit->is_data = hit->is_hit && cgt_figure_scene_find(figure, found.geometry, found.primitive, &hit->element);
    return CGT_OK;
}

/* ---- Lines -------------------------------------------------------------------------------------------------- */

/* A text that may be longer than its room. */
typedef struct lines {
    char *text;
    size_t size, length;
} lines;

static void add(lines *l, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(lines *l, const char *format, ...)
{
    const size_t room = l->length < l->size ? l->size - l->length : 0;
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(room ? l->text + l->length : NULL, room, format, list);
    va_end(list);
    l->length += length > 0 ? (size_t)length : 0;
}

/* ---- Particles ---------------------------------------------------------------------------------------------- */

/* Columns that have a line of their own. */
static int is_told(const char *name)
{
    static const char *const names[] = {"id", "type", "x", "y", "z", "radius"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(names[i], name) == 0)
            return 1;
    return 0;
}

static void tell_columns(const cgt_trajectory_frame *f, uint32_t k, lines *l)
{
    for (uint32_t i = 0; i < f->columns; i++) {
        const cgt_trajectory_column *const c = &f->column[i];
        if (!c->value || is_told(c->name))
            continue;
        const float value = c->value[k];
        if (c->kind == CGT_TRAJECTORY_WORD && c->word && value >= 1.0f && value <= (float)c->words)
            add(l, "%s  %s\n", c->name, c->word[(uint32_t)value - 1]);
        else
            add(l, "%s  %s\n", c->name, cgt_number(7, (double)value).text);
    }
}

static void tell_sphere(const cgt_figure *figure, uint32_t k, lines *l)
{
    const cgt_trajectory_frame *const f = figure->frame;
    const int digits = figure_is_moved(figure) ? 15 : 7; /* what the numbers have */
    const float *const s = f->xyzr + 4 * (size_t)k;
    add(l, "sphere %" PRIu32, k);
    if (f->id)
        add(l, ", id %" PRIu32, f->id[k]);
    if (f->type)
        add(l, ", type %" PRIu32, f->type[k]);
    if (f->element && f->element[k])
        add(l, ", %s", element_symbol(f->element[k]));
    add(l, "\nat  ");
    for (int c = 0; c < 3; c++)
        add(l, "%s%s", cgt_number(digits, f->origin[c] + (double)s[c]).text, c < 2 ? ", " : "\n");
    add(l, "radius  %s\n", cgt_number(6, (double)s[3]).text);
    tell_columns(f, k, l);
    const float *const speed = figure->shown ? figure->shown->speed : NULL;
    if (speed && isfinite(speed[k]))
        add(l, "speed  %s\n", cgt_number(6, (double)speed[k]).text);
}

size_t cgt_figure_describe(const cgt_figure *figure, uint32_t element, char *text, size_t size)
{
    const cgt_trajectory_frame *const f = figure->frame;
    lines l = {text, size, 0};
    if (size)
        *text = '\0';
    if (!f || element >= frame_primitives(f))
        return 0;
    if (f->kind == CGT_TRAJECTORY_SPHERES) {
        tell_sphere(figure, element, &l);
    } else {
        const uint32_t *const corner = f->index + 3 * (size_t)element;
        add(&l, "triangle %" PRIu32 ", vertices %" PRIu32 ", %" PRIu32 ", %" PRIu32 "\n", element, corner[0], corner[1],
            corner[2]);
    }
    return l.length;
}

/* ---- What was chosen ---------------------------------------------------------------------------------------- */

/* Options that are written by what was chosen, or that a given camera excludes. In settings of a run its camera moves
 * on. */
static int is_replaced(const char *name, int is_run)
{
    static const char names[] =
        " size antialias camera view up fov zoom color category range log-scale floor-axis floor-place ";
    char word[32];
    snprintf(word, sizeof word, " %.24s ", name);
    return strstr(names, word) != NULL || (!is_run && strstr(" camera-keys orbit ", word));
}

/* What the colours show, as the option color takes it. */
static void tell_color(const cgt_figure *figure, lines *l)
{
    static const char *const names[] = {"auto", "type", "id", "speed", "height", "", "element", "", "", "auto"};
    static const char *const axes[] = {"x", "y", "z"};
    const figure_options *const o = &figure->options;
    const coloring *const c = &figure->coloring;
    const int usual_axis = figure->survey.kind == CGT_TRAJECTORY_TRIANGLES ? 1 : 2;
    if (c->by == COLORING_VALUE || c->by == COLORING_CATEGORY)
        add(l, "%s", o->formula);
    else if (c->by == COLORING_HEIGHT && c->axis != usual_axis) /* a camera excludes what says another one */
        add(l, "%s", axes[c->axis]);
    else if (c->by != COLORING_PLAIN)
        add(l, "%s", names[c->by]);
    else
        for (int k = 0; k < 3; k++)
            add(l, "%02x", (unsigned)(o->plain[k] * 255.0f + 0.5f));
}

static void tell_numbers(const double *values, int count, lines *l)
{
    for (int i = 0; i < count; i++)
        add(l, i ? ",%s" : "%s", cgt_number(17, values[i]).text);
}

/* A value in its line, where the caller asks for it. */
static int begins(const char *wanted, const char *name, lines *l)
{
    if (wanted && strcmp(wanted, name) != 0)
        return 0;
    if (!wanted)
        add(l, "%s = ", name);
    return 1;
}

/* What follows the first camera of a run that moves, where that which is told alone would choose otherwise. */
static void tell_first_camera(const cgt_figure *figure, const cgt_camera *told, const char *name, lines *l)
{
    const figure_options *const o = &figure->options;
    const float radius = cgt_style_ambient_radius(&figure->path.start);
    float light[3];
    cgt_camera_get_key_light(told, o->width, o->height, light);
    const int is_lit = !o->has_light && memcmp(light, figure->light, sizeof light) != 0;
    const int is_dark = o->picture.ambient > 0 && o->picture.ambient_radius < 0.0f;
    if ((name || is_lit) && begins(name, "light", l))
        add(l, "%s,%s,%s\n", cgt_number(9, (double)figure->light[0]).text, cgt_number(9, (double)figure->light[1]).text,
            cgt_number(9, (double)figure->light[2]).text);
    if (!name && is_dark && radius != cgt_style_ambient_radius(told))
        add(l, "ambient-radius = %s\n", cgt_number(9, (double)radius).text);
}

static size_t tell_chosen(const cgt_figure *figure, const char *name, int is_run, char *text, size_t size)
{
    static const char *const axes[] = {"x", "y", "z", "-x", "-y", "-z"};
    const figure_options *const o = &figure->options;
    char camera[FIGURE_CAMERA_SIZE];
    cgt_camera perspective = is_run ? figure->path.start : figure->camera;
    lines l = {text, size, 0};
    if (size)
        *text = '\0';
    if (!figure->is_settled)
        return 0;
    for (size_t i = 0; i < figure->given.count && !name; i++) {
        const figure_setting *const s = &figure->given.list[i];
        if (!is_replaced(s->name, is_run))
            add(&l, s->value ? "%s = %s\n" : "%s\n", s->name, s->value);
    }
    perspective.projection = CGT_PROJECTION_PERSPECTIVE;
    cgt_figure_name_camera(figure, &perspective, camera);
    if (!(is_run && o->keys.count) && begins(name, "camera", &l))
        add(&l, "%s", camera);
    if (begins(name, "size", &l))
        add(&l, "%" PRIu32 "x%" PRIu32 "\n", o->width, o->height);
    if (begins(name, "antialias", &l))
        add(&l, "%" PRIu32 "\n", o->samples);
    if (!is_run)
        tell_first_camera(figure, &perspective, name, &l);
    if (begins(name, o->by == COLORING_CATEGORY ? "category" : "color", &l)) {
        tell_color(figure, &l);
        add(&l, "\n");
    }
    if (cgt_coloring_has_range(&figure->coloring) && begins(name, "range", &l)) {
        const double range[2] = {figure->coloring.min, figure->coloring.max};
        tell_numbers(range, 2, &l);
        add(&l, "\n");
    }
    if (figure->coloring.logarithmic && !name)
        add(&l, "log-scale\n");
    if (o->floor.is_set && begins(name, "floor-axis", &l))
        add(&l, "%s\n", axes[o->floor.axis - 1]);
    if (o->floor.is_set && begins(name, "floor-place", &l)) {
        tell_numbers(o->floor.place, 4, &l);
        add(&l, "\n");
    }
    return l.length;
}

size_t cgt_figure_get_chosen(const cgt_figure *figure, const char *name, char *text, size_t size)
{
    return tell_chosen(figure, name, 0, text, size);
}

size_t cgt_figure_tell_run(const cgt_figure *figure, char *text, size_t size)
{
    return tell_chosen(figure, NULL, 1, text, size);
}
