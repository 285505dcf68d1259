/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks of options, looks and images; see picture_options.h. */
#include "picture_options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "refuse.h"

enum { MAX_EDGE = 65536, DEFAULT_LIGHT_SAMPLES = 8 };

void cgt_picture_options_init(cgt_picture_options *options)
{
    *options = (cgt_picture_options){.width = 1280, .height = 720, .antialias = 1};
    options->lighting.ambient_radius = INFINITY;
    options->lighting.light_samples = DEFAULT_LIGHT_SAMPLES;
}

static int is_in(float value, float least, float most) { return value >= least && value <= most; }

/* Divides by the largest first, so that squares of finite floats stay finite. */
static int normalize(float v[3])
{
    float largest = 0.0f, sum = 0.0f;
    for (int c = 0; c < 3; c++)
        largest = fmaxf(largest, fabsf(v[c]));
    if (!(largest > 0.0f))
        return -1;
    for (int c = 0; c < 3; c++)
        sum += v[c] / largest * (v[c] / largest);
    for (int c = 0; c < 3; c++)
        v[c] = v[c] / largest / sqrtf(sum);
    return 0;
}

static cgt_result check_light(cgt_picture_light *l, uint32_t i, char *message, size_t size)
{
    const int lamp = l->light.kind == CGT_LIGHT_POINT;
    if (!lamp && l->light.kind != CGT_LIGHT_DIRECTIONAL)
        return picture_refuse(message, size, "light %u: kind %d: neither a point nor a direction", i,
                              (int)l->light.kind);
    for (int c = 0; c < 3; c++)
        if (!isfinite(l->light.position[c]))
            return picture_refuse(message, size, "light %u: position %g: must be finite", i,
                                  (double)l->light.position[c]);
    if (!lamp && normalize(l->light.position))
        return picture_refuse(message, size, "light %u: a direction of length 0", i);
    if (!picture_is_color(l->color))
        return picture_refuse(message, size, "light %u: colour %g, %g, %g: 0 to 1e30", i, (double)l->color[0],
                              (double)l->color[1], (double)l->color[2]);
    if (!is_in(l->size, 0.0f, lamp ? 1e30f : 89.0f))
        return picture_refuse(message, size, "light %u: size %g: 0 to 1e30, of a direction at most 89 degrees", i,
                              (double)l->size);
    return CGT_OK;
}

static cgt_result check_numbers(const cgt_picture_options *o, char *message, size_t size)
{
    if (o->antialias != 1 && o->antialias != 2 && o->antialias != 4)
        return picture_refuse(message, size, "antialias %u: 1, 2 or 4", o->antialias);
    if (o->width > MAX_EDGE / o->antialias || o->height > MAX_EDGE / o->antialias)
        return picture_refuse(message, size, "%u x %u pixels: each times antialias at most %d", o->width, o->height,
                              (int)MAX_EDGE);
    if (o->work.first_row >= o->height || o->work.row_count > o->height - o->work.first_row)
        return picture_refuse(message, size, "%u rows from row %u on: there are %u", o->work.row_count,
                              o->work.first_row, o->height);
    if (o->shading != CGT_SHADING_PLAIN && o->shading != CGT_SHADING_FULL && o->shading != CGT_SHADING_BOUNCES)
        return picture_refuse(message, size, "shading %d: none of cgt_shading", (int)o->shading);
    if (o->lighting.light_count > CGT_PICTURE_MAX_LIGHTS)
        return picture_refuse(message, size, "%u lights: at most %d", o->lighting.light_count,
                              (int)CGT_PICTURE_MAX_LIGHTS);
    if (o->lighting.ambient > CGT_PICTURE_MAX_RAYS || o->lighting.light_samples > CGT_PICTURE_MAX_RAYS)
        return picture_refuse(message, size, "%u rays to the sky and %u to a light: at most %d", o->lighting.ambient,
                              o->lighting.light_samples, (int)CGT_PICTURE_MAX_RAYS);
    if (!(o->lighting.ambient_radius >= 0.0f))
        return picture_refuse(message, size, "ambient_radius %g: 0 or more", (double)o->lighting.ambient_radius);
    if (!is_in(o->lighting.sky, 0.0f, 1e30f) || !is_in(o->lighting.head, 0.0f, 1e30f))
        return picture_refuse(message, size, "sky %g, head %g: 0 to 1e30", (double)o->lighting.sky,
                              (double)o->lighting.head);
    if (!picture_is_color(o->style.background) || !picture_is_color(o->style.outline_color))
        return picture_refuse(message, size, "the colour of background or outlines: 0 to 1e30");
    if (!is_in(o->style.cue, 0.0f, 1.0f))
        return picture_refuse(message, size, "cue %g: 0 to 1", (double)o->style.cue);
    if (o->style.cue > 0.0f && !(isfinite(o->style.cue_range[0]) && isfinite(o->style.cue_range[1]) &&
                                 o->style.cue_range[0] < o->style.cue_range[1]))
        return picture_refuse(message, size, "cue from %g to %g: the first must be below the second",
                              (double)o->style.cue_range[0], (double)o->style.cue_range[1]);
    if (!is_in(o->style.outline, 0.0f, 1000.0f))
        return picture_refuse(message, size, "outline %g: 0 to 1,000 pixels", (double)o->style.outline);
    if (o->style.layer_count > CGT_PICTURE_MAX_LAYERS)
        return picture_refuse(message, size, "%u layers: at most %d", o->style.layer_count,
                              (int)CGT_PICTURE_MAX_LAYERS);
    if (o->bounces.limit > 64 || o->bounces.material_count > 256 ||
        (o->bounces.material_count && !o->bounces.materials))
        return picture_refuse(message, size,
                              "%u bounces, %u materials: at most 64 and 256, and materials must not be NULL",
                              o->bounces.limit, o->bounces.material_count);
    if (!isfinite(o->bounces.up[0]) || !isfinite(o->bounces.up[1]) || !isfinite(o->bounces.up[2]))
        return picture_refuse(message, size, "up %g, %g, %g: must be finite", (double)o->bounces.up[0],
                              (double)o->bounces.up[1], (double)o->bounces.up[2]);
    return CGT_OK;
}

static cgt_result check_layers(cgt_picture_style *s, char *message, size_t size)
{
    uint32_t taken = 0;
    for (uint32_t i = 0; i < s->layer_count; i++) {
        cgt_picture_layer *const l = &s->layers[i];
        l->opacity = l->opacity == 0.0f ? 1.0f : l->opacity;
        if (!is_in(l->opacity, 0.0f, 1.0f))
            return picture_refuse(message, size, "layer %u: opacity %g: 0 to 1", i, (double)l->opacity);
        if (!l->mask || (l->mask & taken) || (taken |= l->mask) == UINT32_MAX)
            return picture_refuse(
                message, size, "layer %u: mask %#x: it needs bits of its own, and one must be left for what is opaque",
                i, (unsigned)l->mask);
    }
    return CGT_OK;
}

cgt_result cgt_picture_check_options(const cgt_picture_options *options, cgt_picture_options *o, char *message,
                                     size_t size)
{
    cgt_picture_options defaults;
    cgt_picture_options_init(&defaults);
    *o = options ? *options : defaults;
    o->width = o->width ? o->width : defaults.width;
    o->height = o->height ? o->height : defaults.height;
    o->antialias = o->antialias ? o->antialias : defaults.antialias;
    if (!o->work.row_count && o->work.first_row < o->height)
        o->work.row_count = o->height - o->work.first_row;
    o->lighting.light_samples = o->lighting.light_samples ? o->lighting.light_samples : defaults.lighting.light_samples;
    if (o->shading == CGT_SHADING_PLAIN)
        o->style.transparent = false;
    cgt_result result = check_numbers(o, message, size);
    if (result == CGT_OK)
        result = check_layers(&o->style, message, size);
    for (uint32_t i = 0; i < o->lighting.light_count && result == CGT_OK; i++)
        result = check_light(&o->lighting.lights[i], i, message, size);
    if (result == CGT_OK && o->shading == CGT_SHADING_PLAIN && o->lighting.light_count &&
        o->lighting.lights[0].light.kind != CGT_LIGHT_DIRECTIONAL)
        result = picture_refuse(message, size, "light 0: with plain shading it must be a direction");
    return result;
}

int cgt_picture_has_default_light(const cgt_picture_options *o)
{
    return o->lighting.light_count == 0 &&
           (o->shading == CGT_SHADING_PLAIN || (o->lighting.sky == 0.0f && o->lighting.head == 0.0f));
}

void cgt_picture_set_default_light(cgt_picture_options *o, const cgt_camera *camera)
{
    cgt_picture_light *const light = &o->lighting.lights[0];
    if (!o->lighting.light_count) {
        *light = (cgt_picture_light){.light = {.kind = CGT_LIGHT_DIRECTIONAL}, .color = {0.62f, 0.62f, 0.62f}};
        light->shadows = true;
        o->lighting.light_count = 1;
        o->lighting.sky = 0.36f;
        o->lighting.head = 0.1f;
    }
    if (!camera)
        return;
    cgt_camera_get_key_light(camera, o->width, o->height, light->light.position);
    normalize(light->light.position);
}

cgt_result cgt_picture_check_image(const cgt_image *image, const cgt_picture_options *options, cgt_image *checked,
                                   char *message, size_t size)
{
    *checked = *image;
    checked->channels = image->channels ? image->channels : 3;
    if (checked->channels != 3 && checked->channels != 4)
        return picture_refuse(message, size, "image: %u channels: 3 or 4", image->channels);
    const size_t row = (size_t)options->width * checked->channels;
    checked->row_stride = image->row_stride ? image->row_stride : row;
    if (checked->row_stride < row)
        return picture_refuse(message, size, "image: a row_stride of %zu bytes: a row has %zu", image->row_stride, row);
    return CGT_OK;
}
