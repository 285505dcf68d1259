/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options of cgt-render about colours of spheres and triangles; see render_options.h. */
#include <stdio.h>
#include <string.h>

#include "common/program.h"
#include "render/options/settings/option_values.h"
#include "render/options/render_options.h"

int render_options_parse_range(const char *text, render_options *o, char *error, size_t error_size)
{
    float v[2];
    if (program_parse_floats(text, 2, v, error, error_size))
        return -1;
    if (v[0] > v[1]) {
        snprintf(error, error_size, "\"%s\": the first value is above the second", text);
        return -1;
    }
    o->range_min = v[0];
    o->range_max = v[1];
    o->has_range = 1;
    return 0;
}

int render_options_parse_color(const char *text, render_options *o, char *error, size_t error_size)
{
    static const char *const names[] = {"auto", "type", "id", "speed", "height", "element"};
    static const coloring_by values[] = {COLORING_AUTO,  COLORING_TYPE,   COLORING_ID,
                                         COLORING_SPEED, COLORING_HEIGHT, COLORING_ELEMENT};
    uint8_t rgb[3];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(text, names[i]) == 0) {
            o->by = values[i];
            return 0;
        }
    if (option_is_color(text)) {
        if (option_parse_color(text, rgb, error, error_size))
            return -1;
        o->by = COLORING_PLAIN;
        for (int c = 0; c < 3; c++)
            o->plain[c] = (float)rgb[c] / 255.0f;
        return 0;
    }
    expression *formula = expression_parse(text, error, error_size);
    size_t columns = 0;
    if (!formula)
        return -1;
    expression_names(formula, &columns);
    expression_free(formula);
    if (!columns) {
        snprintf(error, error_size, "\"%s\" is neither a colour, as RRGGBB, nor a formula over columns", text);
        return -1;
    }
    o->by = COLORING_VALUE;
    o->formula = text;
    return 0;
}

int render_options_parse_colormap(const char *text, const colormap **map, char *error, size_t error_size)
{
    const colormap *found = colormap_find(text);
    if (!found) {
        snprintf(error, error_size, "there is no map \"%s\"", text);
        return -1;
    }
    *map = found;
    return 0;
}
