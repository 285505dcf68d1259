/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-render for what is seen, and the picture that it makes; see view_draw.h. */
#define _POSIX_C_SOURCE 200809L
#include "view/draw/view_draw_internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"
#include "picture/files/image_write.h"

void view_draw_print_camera(const view_draw *d, const cgt_camera *camera, FILE *to)
{
    renderer_print_camera(&d->r, camera, to);
}

/* Options that the viewer gives itself, or that -c excludes. */
static int is_replaced(const char *line)
{
    static const char *const names[] = {"size",  "antialias", "camera", "view",       "up",         "fov",
                                        "color", "range",     "ortho",  "floor-axis", "floor-place"};
    const size_t length = strcspn(line, " \n");
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strlen(names[i]) == length && memcmp(line, names[i], length) == 0)
            return 1;
    return 0;
}

typedef struct command {
    char **argv;
    int argc;
    int failed;
} command;

static void add(command *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(command *c, const char *format, ...)
{
    char text[4096];
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(text, sizeof text, format, list);
    va_end(list);
    char **more = realloc(c->argv, ((size_t)c->argc + 2) * sizeof *more);
    c->argv = more ? more : c->argv;
    char *const copy = more && length >= 0 && (size_t)length < sizeof text ? strdup(text) : NULL;
    if (!copy) {
        c->failed = 1;
        return;
    }
    more[c->argc++] = copy;
    more[c->argc] = NULL;
}

/* "name = value" of the settings becomes --name=value. */
static void add_given(command *c, const char *settings)
{
    for (const char *line = settings; line && *line;) {
        const size_t length = strcspn(line, "\n"), name = strcspn(line, " \n");
        if (!is_replaced(line) && length > name + 3)
            add(c, "--%.*s=%.*s", (int)name, line, (int)(length - name - 3), line + name + 3);
        else if (!is_replaced(line))
            add(c, "--%.*s", (int)name, line);
        line += length + (line[length] == '\n');
    }
}

char **view_draw_command(view_draw *d, const cgt_camera *camera, const char *pattern, int *argc)
{
    const renderer *const r = &d->r;
    const render_options *const o = &r->options;
    const figure_options *const s = &r->figure.options;
    command c = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    if (to)
        renderer_print_camera(r, camera, to);
    const int is_printed = to && fclose(to) == 0 && size > 0;
    add(&c, "cgt-render");
    add_given(&c, d->given);
    if (is_printed)
        add(&c, "--camera=%.*s", (int)(size - 1), text);
    free(text);
    if (figure_is_moved(&r->figure) && !o->reading.has_origin)
        add(&c, "--origin=%.17g,%.17g,%.17g", r->figure.origin[0], r->figure.origin[1], r->figure.origin[2]);
    add(&c, "--size=%ux%u", s->width, s->height);
    add(&c, "--antialias=%u", s->samples);
    /* -c excludes --up, which says what height is */
    add(&c, "--%s=%s", s->by == COLORING_CATEGORY ? "category" : "color",
        r->figure.coloring.by == COLORING_HEIGHT && s->has_up ? view_draw_measured(s) : d->color);
    if (view_draw_has_range(&r->figure.coloring))
        add(&c, "--range=%.17g,%.17g", r->figure.coloring.min, r->figure.coloring.max);
    if (s->picture.ortho)
        add(&c, "--ortho");
    if (s->floor.is_set) {
        static const char *const axes[] = {"x", "y", "z", "-x", "-y", "-z"};
        const double *const at = s->floor.place;
        add(&c, "--floor-axis=%s", axes[s->floor.axis - 1]);
        add(&c, "--floor-place=%.17g,%.17g,%.17g,%.17g", at[0], at[1], at[2], at[3]);
    }
    if (*d->condition)
        add(&c, "--show=%s", d->condition);
    add(&c, "--first=%llu", (unsigned long long)r->figure.frame->number);
    add(&c, "--last=%llu", (unsigned long long)r->figure.frame->number);
    add(&c, "--output=%s", pattern);
    for (size_t i = 0; i < o->input_count; i++)
        add(&c, "%s", o->inputs[i]);
    *argc = c.argc;
    if (!c.failed && is_printed)
        return c.argv;
    program_error("out of memory for the command line");
    for (int i = 0; i < c.argc; i++)
        free(c.argv[i]);
    free(c.argv);
    return NULL;
}

/* The texts of the picture are those of the command line, its camera as single precision reads it. */
static int write_picture(view_draw *d, render_options *o, const view_frame *f, const char *path)
{
    renderer *const r = &d->r;
    image_writer *const writer = image_writer_create();
    const size_t pixels = (size_t)o->figure.width * o->figure.height;
    uint8_t *const rgb = malloc(4 * pixels);
    const stop_flag never = 0;
    int result = -1;
    d->alpha = o->figure.picture.transparent && rgb ? rgb + 3 * pixels : NULL;
    if (!writer || !rgb)
        program_error("out of memory for the picture");
    else if (cgt_camera_key_move(&o->figure.camera, r->figure.origin))
        program_error("eye and target of the camera are the same point");
    else if (view_draw_set_frame(d, f, &o->figure.camera.camera) == 0 &&
             view_draw_picture(d, &o->figure.camera.camera, VIEW_FULL, 1, rgb, &never) == 0) {
        const image_content image = {.width = o->figure.width,
                                     .height = o->figure.height,
                                     .rgb = rgb,
                                     .alpha = d->alpha,
                                     .quality = o->output.quality,
                                     .texts = r->texts,
                                     .text_count = r->text_count};
        result = image_write(writer, path, &image, r->error, sizeof r->error) ? render_fail(r) : 0;
    }
    if (writer)
        image_writer_release(writer);
    d->alpha = NULL;
    free(rgb);
    return result;
}

int view_draw_write(view_draw *d, char **arguments, int argc, const view_frame *f, const char *path)
{
    renderer *const r = &d->r;
    render_options o;
    char **const moved = malloc((size_t)argc * sizeof *moved); /* parsing moves operands to the front */
    if (!moved) {
        program_error("out of memory for the picture");
        return -1;
    }
    memcpy(moved, arguments, (size_t)argc * sizeof *moved);
    view_options_parse_render(&o, argc, moved);
    /* what the texts say is what the command line gives */
    char *const given = d->given;
    const int has[] = {r->figure.options.has_camera, r->figure.options.has_range, r->options.reading.has_origin};
    d->given = o.settings;
    r->figure.options.has_camera = 1;
    r->figure.options.has_range = o.figure.has_range;
    r->options.reading.has_origin = o.reading.has_origin;
    int result = view_draw_set_up_full(d) ? -1 : write_picture(d, &o, f, path);
    d->given = given;
    free(o.settings);
    free(moved);
    r->figure.options.has_camera = has[0];
    r->figure.options.has_range = has[1];
    r->options.reading.has_origin = has[2];
    return view_draw_set_up_full(d) ? -1 : result;
}
