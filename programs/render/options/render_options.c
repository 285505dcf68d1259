/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-render: what is not given, and what needs several options; see render_options.h. */
#include "render/options/render_options.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"
#include "picture/files/image_write.h"
#include "playback/camera/camera_path.h"
#include "render/options/option_parsers.h"
#include "render/options/settings_file.h"
#include "system/system.h"

/* ---- Style --------------------------------------------------------------------------------------------------- */

static void set_default(float *value, float otherwise) { *value = *value < 0.0f ? otherwise : *value; }

/* Puts the values of the style where none were given. */
static void take_style(picture_options *o)
{
    const style_values *const s = style_get(o->style);
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

int picture_options_have_overlay(const picture_options *o)
{
    return o->title || o->time || o->bar || o->legend || o->axes;
}

int picture_options_need_drawing(const picture_options *o)
{
    return o->style != STYLE_PLAIN || o->ambient || o->shadows || o->lamp_count || o->cue > 0.0f || o->outline > 0.0f ||
           o->transparent || o->own_light;
}

/* ---- Axes ---------------------------------------------------------------------------------------------------- */

static int is_zero(const float v[3]) { return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f; }

/* From one side: front is where the automatic camera stands, nearly. From above and below the front is at the bottom of
 * the picture, at its top. */
static void look_from(render_options *o, int axis)
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

void render_options_axes(render_options *options, cgt_trajectory_kind kind)
{
    float *up = options->up, *view = options->view;
    if (is_zero(up)) {
        const int axis = kind == CGT_TRAJECTORY_TRIANGLES ? 1 : 2;
        up[axis] = 1.0f;
        if (!is_zero(view) && camera_path_is_along(view, up)) {
            up[axis] = 0.0f;
            up[3 - axis] = 1.0f;
        }
    }
    const int axis = up[0] != 0.0f ? 0 : up[1] != 0.0f ? 1 : 2;
    if (is_zero(view))
        look_from(options, axis);
    if (!is_zero(view))
        return;
    view[axis] = 0.45f;
    view[(axis + 1) % 3] = axis == 2 ? 0.5f : 1.0f;
    view[(axis + 2) % 3] = axis == 2 ? -1.0f : 0.5f;
}

/* ---- The whole command line ---------------------------------------------------------------------------------- */

static int refuse(char *error, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* In MiB; 1024 where the system does not tell. */
static uint32_t quarter_of_memory(void)
{
    const uint64_t bytes = system_memory(), mib = bytes > 0 ? bytes >> 22 : 1024;
    return mib < UINT32_MAX ? (uint32_t)mib : UINT32_MAX;
}

static int refuse(char *error, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error, size, format, arguments);
    va_end(arguments);
    return -1;
}

int render_options_finish(void *options, const char **operands, size_t count, char *error, size_t size)
{
    render_options *o = options;
    o->inputs = operands;
    o->input_count = count;
    o->input = count ? operands[0] : NULL;
    o->floor.is_set |= o->floor.axis || o->floor.has_height || o->floor.has_place;
    if (o->floor.is_set && o->picture.shadows < 0)
        o->picture.shadows = 1; /* in all styles: what casts none seems to float */
    take_style(&o->picture);
    if (o->cell.mode == RENDER_CELL_NONE && o->cell.spes)
        o->cell.mode = RENDER_CELL_NATIVE;
    if (!o->input && !o->print_settings)
        return refuse(error, size, "no trajectory: give a .lammpstrj, .xyz or .frames file, or a mesh");
    if (o->no_images && o->output_count)
        return refuse(error, size, "--output and --no-images exclude each other");
    if (!o->no_images && !o->output_count && parse_output("out/frame_%04d.png", o, error, size))
        return -1;
    if (o->logarithmic && o->has_range && !(o->range_min > 0.0))
        return refuse(error, size, "--log-scale: the range must be above 0");
    for (uint32_t i = 0; i < o->output_count && o->picture.transparent; i++)
        if (image_format_of(o->outputs[i].pattern) != IMAGE_PNG && image_format_of(o->outputs[i].pattern) != IMAGE_EXR)
            return refuse(error, size, "--transparent: \"%s\" holds no opacity; .png and .exr do",
                          o->outputs[i].pattern);
    if (o->keys.count && o->orbit != 0.0f)
        return refuse(error, size, "--camera-keys and --orbit exclude each other");
    if (o->range.last < o->range.first)
        return refuse(error, size, "--last is before --first");
    if ((uint64_t)o->width * o->height * o->samples * o->samples > RENDER_MAX_PIXELS ||
        o->width > RENDER_MAX_EDGE / o->samples || o->height > RENDER_MAX_EDGE / o->samples)
        return refuse(error, size, "%ux%u pixels of %ux%u rays: at most %d an edge and %llu in all", o->width,
                      o->height, o->samples, o->samples, RENDER_MAX_EDGE, (unsigned long long)RENDER_MAX_PIXELS);
    if (o->has_camera && (o->has_view || o->has_up || o->has_fov || o->zoom > 0.0f))
        return refuse(error, size, "--view, --up, --fov and --zoom are for the automatic camera and exclude --camera");
    if (o->unwrap && o->whole)
        return refuse(error, size, "--unwrap and --whole exclude each other");
    if (o->has_view && o->has_up && !o->side && camera_path_is_along(o->view, o->up))
        return refuse(error, size, "--view: the direction must not be along the axis that points up");
    if (o->bounce.count && !o->bounce.is_set)
        return refuse(error, size, "--material is for --bounces");
    if (o->cell.mode == RENDER_CELL_NONE && (o->cell.assignment || o->cell.program))
        return refuse(error, size, "--cell-assignment and --cell-program are for --cell");
    if (o->cell.mode == RENDER_CELL_NATIVE && o->cell.program)
        return refuse(error, size, "--cell-program is for --cell sim: a native Cell has its program built in");
    return 0;
}

void render_options_init(render_options *o)
{
    memset(o, 0, sizeof *o);
    cgt_trajectory_options_init(&o->reading);
    o->reading.fps = 0.0; /* not given: the reader's default */
    cgt_camera_init(&o->camera.camera);
    o->range = (frame_range){0, UINT64_MAX - 1, 1};
    o->output.survey = UINT64_MAX;
    o->sheet_columns = 4;
    o->sheet_rows = 3;
    o->width = 1280;
    o->height = 720;
    o->samples = 1;
    o->memory_mib = quarter_of_memory();
    o->fov = 30.0f;
    memcpy(o->plain, style_mesh_color, sizeof o->plain);

    picture_options *p = &o->picture;
    p->text_size = 0.03f;
    p->ambient = p->shadows = p->light_samples = -1;
    p->ambient_radius = p->light_size = p->key = p->sky = p->head = p->cue = p->outline = -1.0f;

    particle_options *d = &o->particles;
    d->radius_scale = d->arrow_scale = d->mesh_opacity = 1.0f;
    d->images[0] = d->images[1] = d->images[2] = 1;
    memcpy(d->mesh_color, (const uint8_t[]){0xb8, 0xbc, 0xc2}, sizeof d->mesh_color);
}

void render_options_parse(render_options *options, int argc, char **argv)
{
    settings_arguments arguments;
    options_given given;
    char error[PROGRAM_ERROR_SIZE];
    render_options_init(options);
    if (settings_expand(argc, argv, &arguments, error, sizeof error)) {
        program_error("--settings: %s", error);
        exit(PROGRAM_USAGE);
    }
    options_parse(&render_option_table, options, arguments.argc, arguments.argv, &given);
    options->settings = given.settings;
    if (!options->print_settings)
        return;
    if (given.settings) {
        printf("%s", given.settings);
        options_print_others(&render_option_table, &given);
    }
    exit(program_exit(given.settings ? PROGRAM_OK : PROGRAM_FAILED));
}
