/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What pictures say of themselves, and their set-up; see render_setup.h. */
#include "render/render_setup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/settings_file.h"

static void add_text(renderer *r, const char *key, const char *value)
{
    if (value && *value)
        r->texts[r->text_count++] = (png_text){key, value};
}

/* The settings, with what was chosen, so that the picture can be made again. */
static int describe(renderer *r)
{
    enum { ORIGIN_SIZE = 100 };
    const render_options *o = &r->options;
    const char *const settings = o->settings ? o->settings : "";
    const double *const origin = r->figure->origin;
    if (o->no_metadata)
        return 0;
    const size_t chosen = cgt_figure_tell_run(r->figure, NULL, 0);
    char *const text = malloc(strlen(settings) + ORIGIN_SIZE + chosen + 1);
    if (!text) {
        program_error("out of memory");
        return -1;
    }
    size_t used = settings_copy_part(settings, 0, text); /* the figure has its own */
    if (!o->reading.has_origin && figure_is_moved(r->figure))
        used +=
            (size_t)snprintf(text + used, ORIGIN_SIZE, "origin = %.15g,%.15g,%.15g\n", origin[0], origin[1], origin[2]);
    cgt_figure_tell_run(r->figure, text + used, chosen + 1);
    r->settings = settings_quote(text);
    free(text);
    if (!r->settings) {
        program_error("out of memory");
        return -1;
    }
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
