/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What pictures say of themselves, and their set-up; see render_setup.h. */
#include "render/render_setup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_text(renderer *r, const char *key, const char *value)
{
    if (value && *value)
        r->texts[r->text_count++] = (png_text){key, value};
}

/* The settings, then the camera and the range that were found, so that the picture can be made again. */
static int describe(renderer *r)
{
    const render_options *o = &r->options;
    const char *const settings = o->settings ? o->settings : "";
    const int digits = figure_is_moved(r->figure) ? 15 : 9;
    char camera[FIGURE_CAMERA_SIZE], origin[100] = "", range[100] = "";
    if (o->no_metadata)
        return 0;
    cgt_figure_name_camera(r->figure, &r->figure->path.start, camera);
    if (!o->reading.has_origin && figure_is_moved(r->figure))
        snprintf(origin, sizeof origin, "origin = %.15g,%.15g,%.15g\n", r->figure->origin[0], r->figure->origin[1],
                 r->figure->origin[2]);
    if (!r->figure->options.has_range && r->figure->coloring.max > r->figure->coloring.min)
        snprintf(range, sizeof range, "range = %.*g,%.*g\n", digits, r->figure->coloring.min, digits,
                 r->figure->coloring.max);
    const size_t size = strlen(settings) + sizeof camera + sizeof origin + sizeof range;
    char *const text = malloc(size);
    if (!text) {
        program_error("out of memory");
        return -1;
    }
    snprintf(text, size, "%s%s%s%s%s", settings,
             r->figure->options.has_camera ? "" : "camera = ", r->figure->options.has_camera ? "" : camera, origin,
             range);
    r->settings = text;
    add_text(r, "Software", "cgt-render (libcgt " CGT_VERSION_STRING ")");
    add_text(r, "Source", o->input);
    add_text(r, "Title", r->figure->options.picture.title);
    add_text(r, "Settings", r->settings);
    return 0;
}

int render_picture_setup(renderer *r)
{
    return render_result(r, cgt_figure_open_picture(r->figure)) || describe(r) ? -1 : 0;
}
