/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks of options, looks and images; see picture_options.h. */
#include "picture_options.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MAX_EDGE = 65536, DEFAULT_LIGHT_SAMPLES = 8 };

static const float default_grey = 0.7f;

void cgt_picture_options_init(cgt_picture_options *options)
{
    *options = (cgt_picture_options){.width = 1280, .height = 720, .antialias = 1};
    options->ambient_radius = INFINITY;
    options->light_samples = DEFAULT_LIGHT_SAMPLES;
    options->front = 1.0f;
}

__attribute__((format(printf, 3, 4))) static cgt_result fail(char *message, size_t size, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(message, size, format, values);
    va_end(values);
    return CGT_ERROR_INVALID_ARGUMENT;
}

static int is_in(float value, float least, float most) { return value >= least && value <= most; }

static int are_positive(const float v[3])
{
    return is_in(v[0], 0.0f, 1e30f) && is_in(v[1], 0.0f, 1e30f) && is_in(v[2], 0.0f, 1e30f);
}

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
        return fail(message, size, "light %u: kind %d: neither a point nor a direction", i, (int)l->light.kind);
    for (int c = 0; c < 3; c++)
        if (!isfinite(l->light.position[c]))
            return fail(message, size, "light %u: position %g: must be finite", i, (double)l->light.position[c]);
    if (!lamp && normalize(l->light.position))
        return fail(message, size, "light %u: a direction of length 0", i);
    if (!are_positive(l->color))
        return fail(message, size, "light %u: colour %g, %g, %g: 0 to 1e30", i, (double)l->color[0],
                    (double)l->color[1], (double)l->color[2]);
    if (!is_in(l->size, 0.0f, lamp ? 1e30f : 89.0f))
        return fail(message, size, "light %u: size %g: 0 or more, of a direction at most 89 degrees", i,
                    (double)l->size);
    return CGT_OK;
}

static cgt_result check_numbers(const cgt_picture_options *o, char *message, size_t size)
{
    if (o->antialias != 1 && o->antialias != 2 && o->antialias != 4)
        return fail(message, size, "antialias %u: 1, 2 or 4", o->antialias);
    if (o->width > MAX_EDGE / o->antialias || o->height > MAX_EDGE / o->antialias)
        return fail(message, size, "%u x %u pixels: each times antialias at most %d", o->width, o->height,
                    (int)MAX_EDGE);
    if (o->first_row >= o->height || o->row_count > o->height - o->first_row)
        return fail(message, size, "%u rows from row %u on: there are %u", o->row_count, o->first_row, o->height);
    if (o->shading != CGT_SHADING_PLAIN && o->shading != CGT_SHADING_FULL && o->shading != CGT_SHADING_BOUNCES)
        return fail(message, size, "shading %d: none of cgt_shading", (int)o->shading);
    if (o->light_count > CGT_PICTURE_MAX_LIGHTS)
        return fail(message, size, "%u lights: at most %d", o->light_count, (int)CGT_PICTURE_MAX_LIGHTS);
    if (o->ambient > CGT_PICTURE_MAX_RAYS || o->light_samples > CGT_PICTURE_MAX_RAYS)
        return fail(message, size, "%u rays to the sky and %u to a light: at most %d", o->ambient, o->light_samples,
                    (int)CGT_PICTURE_MAX_RAYS);
    if (!(o->ambient_radius >= 0.0f))
        return fail(message, size, "ambient_radius %g: 0 or more", (double)o->ambient_radius);
    if (!is_in(o->sky, 0.0f, 1e30f) || !is_in(o->head, 0.0f, 1e30f))
        return fail(message, size, "sky %g, head %g: 0 to 1e30", (double)o->sky, (double)o->head);
    if (!are_positive(o->background) || !are_positive(o->outline_color))
        return fail(message, size, "the colour of background or outlines: 0 to 1e30");
    if (!is_in(o->cue, 0.0f, 1.0f))
        return fail(message, size, "cue %g: 0 to 1", (double)o->cue);
    if (o->cue > 0.0f && !(isfinite(o->cue_near) && isfinite(o->cue_far) && o->cue_near < o->cue_far))
        return fail(message, size, "cue from %g to %g: the first must be below the second", (double)o->cue_near,
                    (double)o->cue_far);
    if (!is_in(o->outline, 0.0f, 1000.0f))
        return fail(message, size, "outline %g: 0 to 1,000 pixels", (double)o->outline);
    if (!is_in(o->front, 0.0f, 1.0f))
        return fail(message, size, "front %g: 0 to 1", (double)o->front);
    if (o->bounces > 64 || o->material_count > 256 || (o->material_count && !o->materials))
        return fail(message, size, "%u bounces, %u materials: at most 64 and 256, and materials must not be NULL",
                    o->bounces, o->material_count);
    if (!isfinite(o->up[0]) || !isfinite(o->up[1]) || !isfinite(o->up[2]))
        return fail(message, size, "up %g, %g, %g: must be finite", (double)o->up[0], (double)o->up[1],
                    (double)o->up[2]);
    if (o->front < 1.0f && !o->behind_mask)
        return fail(message, size, "front %g without a behind_mask: nothing is in front", (double)o->front);
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
    if (!o->row_count && o->first_row < o->height)
        o->row_count = o->height - o->first_row;
    o->light_samples = o->light_samples ? o->light_samples : defaults.light_samples;
    o->front = o->front == 0.0f ? defaults.front : o->front;
    if (o->shading == CGT_SHADING_PLAIN)
        o->transparent = false;
    cgt_result result = check_numbers(o, message, size);
    for (uint32_t i = 0; i < o->light_count && result == CGT_OK; i++)
        result = check_light(&o->lights[i], i, message, size);
    if (result == CGT_OK && o->shading == CGT_SHADING_PLAIN && o->light_count &&
        o->lights[0].light.kind != CGT_LIGHT_DIRECTIONAL)
        result = fail(message, size, "light 0: with plain shading it must be a direction");
    return result;
}

int cgt_picture_has_default_light(const cgt_picture_options *o)
{
    return o->light_count == 0 && (o->shading == CGT_SHADING_PLAIN || (o->sky == 0.0f && o->head == 0.0f));
}

void cgt_picture_set_default_light(cgt_picture_options *o, const cgt_camera *camera)
{
    cgt_picture_light *const light = &o->lights[0];
    if (!o->light_count) {
        *light = (cgt_picture_light){.light = {.kind = CGT_LIGHT_DIRECTIONAL}, .color = {0.62f, 0.62f, 0.62f}};
        light->shadows = true;
        o->light_count = 1;
        o->sky = 0.36f;
        o->head = 0.1f;
    }
    if (!camera)
        return;
    cgt_camera_get_key_light(camera, o->width, o->height, light->light.position);
    normalize(light->light.position);
}

cgt_result cgt_picture_check_looks(const cgt_look *looks, uint32_t count, cgt_look *copies, char *message, size_t size)
{
    for (uint32_t i = 0; i <= count; i++) {
        cgt_look *const l = &copies[i];
        *l = i < count ? looks[i] : (cgt_look){0};
        if (l->index && !l->palette)
            return fail(message, size, "look %u: index without a palette", i);
        if (l->per_vertex && !l->indices)
            return fail(message, size, "look %u: per_vertex is for triangles, and there are no indices", i);
        if (l->halves && l->indices)
            return fail(message, size, "look %u: halves are for capsules, and there are indices of triangles", i);
        if (l->vertex_normals && !l->indices)
            return fail(message, size, "look %u: vertex_normals without indices", i);
        if (!are_positive(l->color))
            return fail(message, size, "look %u: colour %g, %g, %g: 0 to 1e30", i, (double)l->color[0],
                        (double)l->color[1], (double)l->color[2]);
        if (l->color[0] == 0.0f && l->color[1] == 0.0f && l->color[2] == 0.0f)
            l->color[0] = l->color[1] = l->color[2] = default_grey;
        l->per_vertex = l->per_vertex && (l->index || l->colors);
        l->halves = l->halves && (l->index || l->colors);
    }
    return CGT_OK;
}

cgt_result cgt_picture_check_image(const cgt_image *image, const cgt_picture_options *options, cgt_image *checked,
                                   char *message, size_t size)
{
    *checked = *image;
    checked->channels = image->channels ? image->channels : 3;
    if (checked->channels != 3 && checked->channels != 4)
        return fail(message, size, "image: %u channels: 3 or 4", image->channels);
    const size_t row = (size_t)options->width * checked->channels;
    checked->row_stride = image->row_stride ? image->row_stride : row;
    if (checked->row_stride < row)
        return fail(message, size, "image: a row_stride of %zu bytes: a row has %zu", image->row_stride, row);
    return CGT_OK;
}
