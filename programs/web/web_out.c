/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the page gives away: pictures of any size, those of a run or of an orbit one after the other, and settings; and
 * settings that it takes. */
#define _POSIX_C_SOURCE 200809L
#include <emscripten.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/camera_path.h"
#include "common/picture_lines.h"
#include "common/settings_file.h"
#include "figure_state.h"
#include "web/web_state.h"

/* ---- Settings ----------------------------------------------------------------------------------------------- */

/* Settings as the figure has them, by which the picture that is shown is made; "": no file is open. To be freed; NULL:
 * no memory. */
static char *get_chosen(void)
{
    if (web.shown)
        cgt_figure_set_camera(web.figure, &web.camera);
    const size_t length = web.shown ? cgt_figure_get_chosen(web.figure, NULL, NULL, 0) : 0;
    char *const text = calloc(length + 1, 1);
    if (text && length)
        cgt_figure_get_chosen(web.figure, NULL, text, length + 1);
    return text;
}

/* Those settings as a file has them. */
EMSCRIPTEN_KEEPALIVE const char *web_settings(void)
{
    char *const chosen = get_chosen();
    free(web.told);
    web.told = chosen ? settings_quote(chosen) : NULL;
    free(chosen);
    return web.told;
}

/* Those settings with files that are options of cgt-render; NULL: no memory. */
static char *settings_with_files(void)
{
    const web_files *const f = &web.given;
    char *const chosen = get_chosen();
    char *text = NULL;
    size_t size = 0;
    FILE *const to = chosen ? open_memstream(&text, &size) : NULL;
    if (to && f->topology)
        fprintf(to, "topology = %s\n", f->topology);
    if (to && f->mesh)
        fprintf(to, "mesh = %s\n", f->mesh);
    if (to)
        fputs(chosen, to);
    free(chosen);
    if (to && fclose(to) == 0)
        return text;
    free(text);
    return NULL;
}

static char *tell_lines(char *(*tell)(const picture_lines *p))
{
    cgt_trajectory_options reading = web_reading();
    double origin[3];
    char *const settings = settings_with_files();
    reading.topology = web.given.topology;
    reading.all_bonds = reading.leave_out_sites = !web_has_triangles();
    const picture_lines p = {.settings = settings,
                             .inputs = web.given.run,
                             .input_count = web.given.count,
                             .mesh = web.given.mesh,
                             .reading = &reading,
                             .origin = web_get_origin(origin) ? origin : NULL,
                             .number = web_frame(),
                             .lead = web.lead,
                             .output = "picture.png"};
    free(web.lines);
    web.lines = settings && web.shown ? tell(&p) : NULL;
    free(settings);
    return web.lines;
}

/* The command line of cgt-render, and Python, that make the picture that is shown; NULL: no memory, or no file is
 * open. */
EMSCRIPTEN_KEEPALIVE const char *web_command(void) { return tell_lines(picture_lines_command); }
EMSCRIPTEN_KEEPALIVE const char *web_python(void) { return tell_lines(picture_lines_python); }

/* Takes the options of a settings file, but for the size, in place of all that are set. What is refused changes
 * nothing. Returns 0, or -1; the message names options that are not the page's, "": none. */
EMSCRIPTEN_KEEPALIVE int web_load(const char *path)
{
    char left_out[256], size[32], why[sizeof web.message];
    char *const lines = settings_read_figure(path, 1, left_out, sizeof left_out, why, sizeof why);
    char *text = NULL;
    size_t length = 0;
    FILE *const to = lines ? open_memstream(&text, &length) : NULL;
    snprintf(size, sizeof size, "%ux%u", (unsigned)web.width, (unsigned)web.height);
    if (to)
        fprintf(to, "size = %s\n%s", size, lines);
    const int has_text = to && fclose(to) == 0;
    const int failed = lines && !has_text ? web_fail("out of memory for options") : has_text ? web_take(text) : -1;
    if (!lines)
        memcpy(web.message, why, sizeof why);
    else if (!failed && *left_out)
        snprintf(web.message, sizeof web.message, "left out, since the page has no such options: %s", left_out);
    else if (!failed)
        web.message[0] = '\0';
    free(text);
    free(lines);
    return failed;
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

static struct {
    camera_path path;
    uint8_t *rgb;
} series;

/* Begins pictures of the size that is set, during which the camera of the hand goes around its target once by so many
 * degrees. Returns 0, or -1. */
EMSCRIPTEN_KEEPALIVE int web_begin_series(double degrees)
{
    free(series.rgb);
    series.rgb = malloc(3 * (size_t)web.width * web.height);
    if (!series.rgb)
        return web_fail("out of memory for the picture");
    if (!web.shown)
        return web_fail("no file is open");
    cgt_camera_path_fixed(&series.path, &web.camera, degrees);
    return web_check(cgt_figure_set_camera(web.figure, &web.camera)); /* the light stays where it is then */
}

/* Begins the picture at a share of the way around. Returns 0, or -1. */
EMSCRIPTEN_KEEPALIVE int web_begin_picture(double share)
{
    cgt_camera_path_at(&series.path, share, &web.figure->camera);
    return web_check(cgt_figure_begin(web.figure));
}

/* Adds a step of light. Returns how many are left, or -1. */
EMSCRIPTEN_KEEPALIVE int web_step_picture(void)
{
    uint32_t left;
    return web_check(cgt_figure_step(web.figure, 1, &left)) ? -1 : (int)left;
}

/* Its bytes, four a pixel; NULL: it failed. */
EMSCRIPTEN_KEEPALIVE const uint8_t *web_read_picture(void)
{
    const cgt_image image = {.bytes = web.pixels, .channels = 4};
    return web_check(cgt_figure_read(web.figure, &image)) ? NULL : web.pixels;
}

/* Writes it as a PNG file. Returns 0, or -1. */
EMSCRIPTEN_KEEPALIVE int web_write_picture(const char *path)
{
    const cgt_image image = {.bytes = series.rgb};
    if (web_check(cgt_figure_read(web.figure, &image)))
        return -1;
    return cgt_write_png(path, &image, web.width, web.height) ? web_fail("out of memory for the picture") : 0;
}

/* After the last picture. */
EMSCRIPTEN_KEEPALIVE void web_end_series(void)
{
    free(series.rgb);
    series.rgb = NULL;
    if (web.shown)
        cgt_figure_set_camera(web.figure, &web.camera);
}
