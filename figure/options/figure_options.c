/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is not given of a figure, and what needs several options; see figure_options.h. */
#include "options/figure_options.h"

#include <stdio.h>
#include <string.h>

#include "camera/camera_path.h"
#include "options/numbers.h"

/* ---- Style --------------------------------------------------------------------------------------------------- */

static void set_default(float *value, float otherwise) { *value = *value < 0.0f ? otherwise : *value; }

/* Puts the values of the style where none were given. */
static void take_style(picture_options *o)
{
    const style_values *const s = cgt_style_get(o->style);
    o->ambient = o->ambient < 0 && !s->ambient ? 0 : o->ambient;
    o->shadows = o->shadows < 0 ? s->shadows : o->shadows;
    o->light_samples = o->light_samples < 0 ? 8 : o->light_samples;
    o->own_light = o->key >= 0.0f || o->sky >= 0.0f || o->head >= 0.0f;
    set_default(&o->key, s->key);
    set_default(&o->sky, s->sky);
    set_default(&o->head, s->head);
    set_default(&o->outline, s->outline);
    set_default(&o->light_size, 0.0f);
    set_default(&o->cue, 0.0f);
    if (!o->has_background)
        memcpy(o->background, s->background, sizeof s->background);
}

int cgt_figure_options_need_bonds(const figure_options *o)
{
    return (o->particles.bonds && !(o->particles.bond_distance > 0.0f)) || o->whole || o->unwrap;
}

int cgt_figure_option_is_of_frames(const char *name)
{
    static const char *const names[] = {"unwrap", "whole", "trails", "type-element"};
    int is_one = 0;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        is_one |= strcmp(name, names[i]) == 0;
    return is_one;
}

int cgt_picture_options_have_overlay(const picture_options *o)
{
    return o->title || o->time || o->bar || o->legend || o->axes || o->scale.is_set || *o->label;
}

int cgt_picture_options_need_drawing(const picture_options *o)
{
    return o->style != STYLE_PLAIN || o->ambient || o->shadows || o->lamp_count || o->cue > 0.0f || o->outline > 0.0f ||
           o->transparent || o->own_light;
}

/* ---- Axes ---------------------------------------------------------------------------------------------------- */

static int is_zero(const float v[3]) { return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f; }

/* From one side: front is where the automatic camera stands, nearly. From above and below the front is at the bottom of
 * the picture, at its top. */
static void look_from(figure_options *o, int axis)
{
    const int front = axis == 1 ? 2 : 1, right = 3 - axis - front;
    const float to_front = axis == 2 ? -1.0f : 1.0f;
    switch (o->side) {
    case VIEW_BY_DIRECTION: return;
    case VIEW_FRONT: o->view[front] = to_front; break;
    case VIEW_BACK: o->view[front] = -to_front; break;
    case VIEW_RIGHT: o->view[right] = 1.0f; break;
    case VIEW_LEFT: o->view[right] = -1.0f; break;
    case VIEW_TOP:
    case VIEW_BOTTOM:
        o->view[axis] = o->side == VIEW_TOP ? 1.0f : -1.0f;
        o->up[axis] = 0.0f;
        o->up[front] = o->side == VIEW_TOP ? -to_front : to_front;
        o->floor.axis = o->floor.axis ? o->floor.axis : (uint32_t)axis + 1;
        break;
    }
}

void cgt_figure_options_axes(figure_options *o, cgt_trajectory_kind kind)
{
    float *up = o->up, *view = o->view;
    const int usual = kind == CGT_TRAJECTORY_TRIANGLES ? 1 : 2;
    if (!o->vertical)
        o->vertical = 1 + (is_zero(up) ? usual : up[0] != 0.0f ? 0 : up[1] != 0.0f ? 1 : 2);
    if (is_zero(up)) {
        const int axis = usual;
        up[axis] = 1.0f;
        if (!is_zero(view) && cgt_camera_path_is_along(view, up)) {
            up[axis] = 0.0f;
            up[3 - axis] = 1.0f;
        }
    }
    const int axis = up[0] != 0.0f ? 0 : up[1] != 0.0f ? 1 : 2;
    if (is_zero(view))
        look_from(o, axis);
    if (!is_zero(view))
        return;
    view[axis] = 0.45f;
    view[(axis + 1) % 3] = axis == 2 ? 0.5f : 1.0f;
    view[(axis + 2) % 3] = axis == 2 ? -1.0f : 0.5f;
}

/* ---- All of them ---------------------------------------------------------------------------------------------- */

/* Whether a picture may have so many rays along each edge of a pixel. */
static int may_have(const figure_options *o, uint32_t samples)
{
    return (uint64_t)o->width * o->height * samples * samples <= FIGURE_MAX_PIXELS &&
           o->width <= FIGURE_MAX_EDGE / samples && o->height <= FIGURE_MAX_EDGE / samples;
}

uint32_t cgt_particle_options_layer(particle_options *o, float opacity)
{
    uint32_t layer = 0;
    if (!(opacity < 1.0f))
        return 0;
    while (layer < o->layer_count && o->layers[layer] != opacity)
        layer++;
    if (layer == CGT_PICTURE_MAX_LAYERS)
        return UINT32_MAX;
    o->layer_count += layer == o->layer_count;
    o->layers[layer] = opacity;
    return layer + 1;
}

/* Words are of categories, which the colours have or may have. */
static int check_word(const figure_options *o, const char *option, const particle_kind *kind, char *error, size_t size)
{
    if (!kind->is_word || o->by == COLORING_VALUE || o->by == COLORING_CATEGORY)
        return 0;
    return cgt_refuse(error, size,
                      "--%s: \"%.*s\" is neither a type's number nor a chemical element, and the colours are not those "
                      "of words: see --color",
                      option, (int)strcspn(kind->text, "="), kind->text);
}

static int check_words(const figure_options *o, char *error, size_t size)
{
    const particle_options *const p = &o->particles;
    for (uint32_t i = 0; i < p->color_count; i++)
        if (check_word(o, "type-color", &p->colors[i], error, size))
            return -1;
    for (uint32_t i = 0; i < p->name_count; i++)
        if (check_word(o, "type-name", &p->names[i].kind, error, size))
            return -1;
    return 0;
}

int cgt_figure_options_finish(figure_options *o, char *error, size_t size)
{
    o->floor.is_set |= o->floor.axis || o->floor.has_height || o->floor.has_place;
    if (o->floor.is_set && o->picture.shadows < 0)
        o->picture.shadows = 1; /* in all styles: what casts none seems to float */
    if (o->bounce.is_set && (o->picture.outline > 0.0f || o->picture.cue > 0.0f || o->picture.head > 0.0f))
        return cgt_refuse(error, size, "--bounces goes without --outline, --depth-cue and --head");
    take_style(&o->picture);
    if (o->logarithmic && (o->is_symmetric || (o->has_range && !(o->range_min > 0.0))))
        return cgt_refuse(error, size, "--log-scale: the range must be above 0");
    if (o->keys.count && (o->has_camera || o->orbit != 0.0f))
        return cgt_refuse(error, size, "--camera-keys and --%s exclude each other", o->has_camera ? "camera" : "orbit");
    if (o->keys.count) {
        o->has_camera = 1;
        o->camera = o->keys.key[0];
    }
    if (!o->samples)
        o->samples = may_have(o, 2) ? 2 : 1;
    if (!may_have(o, o->samples))
        return cgt_refuse(error, size, "%ux%u pixels of %ux%u rays: at most %d an edge and %llu in all", o->width,
                          o->height, o->samples, o->samples, FIGURE_MAX_EDGE, (unsigned long long)FIGURE_MAX_PIXELS);
    if (o->has_camera && (o->has_view || o->has_up || o->has_fov || o->zoom > 0.0f))
        return cgt_refuse(error, size, "--%s is for the automatic camera and excludes --%s",
                          o->has_view  ? "view"
                          : o->has_up  ? "up"
                          : o->has_fov ? "fov"
                                       : "zoom",
                          o->keys.count ? "camera-keys" : "camera");
    if (o->unwrap && o->whole)
        return cgt_refuse(error, size, "--unwrap and --whole exclude each other");
    if (o->has_view && o->has_up && !o->side && cgt_camera_path_is_along(o->view, o->up))
        return cgt_refuse(error, size, "--view: the direction must not be along the axis that points up");
    if (o->picture.label_text && !*o->picture.label)
        return cgt_refuse(error, size, "--label-text is for --label");
    if (o->bounce.count && !o->bounce.is_set)
        return cgt_refuse(error, size, "--material is for --bounces");
    if (o->bounce.is_set && o->particles.layer_count)
        return cgt_refuse(error, size, "--opacity and --bounces exclude each other: --material makes glass");
    o->particles.mesh_layer = cgt_particle_options_layer(&o->particles, o->particles.mesh_opacity);
    if (o->particles.mesh_layer == UINT32_MAX)
        return cgt_refuse(error, size, "--mesh-opacity: more than %d opacities", CGT_PICTURE_MAX_LAYERS);
    return check_words(o, error, size);
}

void cgt_figure_options_init(figure_options *o)
{
    memset(o, 0, sizeof *o);
    cgt_camera_init(&o->camera.camera);
    o->width = 1280;
    o->height = 720;
    o->fov = 30.0f;
    memcpy(o->plain, cgt_style_mesh_color, sizeof o->plain);

    picture_options *p = &o->picture;
    p->text_size = 0.03f;
    p->ambient = p->shadows = p->light_samples = -1;
    p->ambient_radius = p->light_size = p->key = p->sky = p->head = p->cue = p->outline = -1.0f;

    particle_options *d = &o->particles;
    d->radius_scale = d->arrow_scale = d->mesh_opacity = 1.0f;
    d->images[0] = d->images[1] = d->images[2] = 1;
    memcpy(d->mesh_color, (const uint8_t[]){0xb8, 0xbc, 0xc2}, sizeof d->mesh_color);
}
