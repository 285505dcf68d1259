/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of options about pictures, cameras, colours and light; see figure_values.h. */
#include "options/figure_values.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/expression/label_rules.h"
#include "options/numbers.h"
#include <cgt/picture.h>

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

int cgt_parse_size(const char *text, void *to, char *error, size_t size)
{
    figure_options *o = to;
    return cgt_read_size(text, &o->width, &o->height, error, size);
}

int cgt_parse_samples(const char *text, void *to, char *error, size_t size)
{
    uint32_t n;
    if (cgt_read_u32(text, 1, 4, &n, error, size))
        return -1;
    if (n == 3) {
        snprintf(error, size, "3 is not 1, 2 or 4");
        return -1;
    }
    *(uint32_t *)to = n;
    return 0;
}

/* ---- Camera -------------------------------------------------------------------------------------------------- */

int cgt_parse_camera(const char *text, void *to, char *error, size_t size)
{
    camera_key *const key = to;
    return cgt_read_far_camera(text, &key->camera, key->eye, key->target, error, size);
}

int cgt_parse_keys(const char *text, void *to, char *error, size_t size)
{
    figure_options *o = to;
    cgt_camera_keys_free(&o->keys);
    return cgt_camera_keys_read(&o->keys, text, error, size);
}

int cgt_parse_view(const char *text, void *to, char *error, size_t size)
{
    figure_options *o = to;
    const int side = cgt_find_word(VIEW_SIDES, text);
    o->side = side < 0 ? VIEW_BY_DIRECTION : (view_side)(VIEW_FRONT + side);
    memset(o->view, 0, sizeof o->view);
    return side < 0 ? cgt_parse_direction(text, o->view, error, size) : 0;
}

/* ---- Colours and light --------------------------------------------------------------------------------------- */

int cgt_parse_range(const char *text, void *to, char *error, size_t size)
{
    figure_options *o = to;
    double v[2];
    o->is_symmetric = strcmp(text, "symmetric") == 0;
    o->has_range = 0;
    if (o->is_symmetric)
        return 0;
    if (cgt_read_doubles(text, 2, v, error, size))
        return -1;
    if (v[0] > v[1]) {
        snprintf(error, size, "\"%s\": the first value is above the second", text);
        return -1;
    }
    o->range_min = v[0];
    o->range_max = v[1];
    o->has_range = 1;
    return 0;
}

int cgt_parse_coloring(const char *text, void *to, char *error, size_t size)
{
    figure_options *o = to;
    static const char *const names[] = {"auto", "type", "id", "speed", "height", "element"};
    static const coloring_by values[] = {COLORING_AUTO,  COLORING_TYPE,   COLORING_ID,
                                         COLORING_SPEED, COLORING_HEIGHT, COLORING_ELEMENT};
    uint8_t rgb[3];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(text, names[i]) == 0) {
            o->by = values[i];
            return 0;
        }
    if (cgt_is_color(text)) {
        if (cgt_parse_color(text, rgb, error, size))
            return -1;
        o->by = COLORING_PLAIN;
        for (int c = 0; c < 3; c++)
            o->plain[c] = (float)rgb[c] / 255.0f;
        return 0;
    }
    expression *formula = cgt_expression_parse(text, error, size);
    size_t columns = 0;
    if (!formula)
        return -1;
    cgt_expression_names(formula, &columns);
    o->is_name = cgt_expression_is_name(formula);
    cgt_expression_free(formula);
    if (!columns) {
        snprintf(error, size, "\"%s\" is neither a colour, as RRGGBB, nor a formula over columns", text);
        return -1;
    }
    o->by = COLORING_VALUE;
    o->formula = text;
    return 0;
}

int cgt_parse_category(const char *text, void *to, char *error, size_t size)
{
    figure_options *o = to;
    o->by = COLORING_CATEGORY;
    return cgt_parse_formula(text, &o->formula, error, size);
}

int cgt_parse_colormap(const char *text, void *to, char *error, size_t size)
{
    figure_options *const o = to;
    const cgt_colormap *const found = cgt_find_colormap(text);
    if (!found && strpbrk(text, "./\\"))
        return cgt_color_table_read(&o->own_map, text, error, size);
    if (found) {
        o->map = found;
        o->own_map.count = 0;
        return 0;
    }
    char names[200] = "";
    for (const char *const *name = cgt_get_colormap_names(); *name; name++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", *names ? ", " : "", *name);
    return cgt_refuse(error, size,
                      "there is no map \"%s\": %s, one of these with _r, reversed, or a file, whose name has a dot or "
                      "a slash",
                      text, names);
}

/* x,y,z, then strength, then colour. */
static int add_lamp(const char *text, cgt_light_kind kind, picture_options *o, char *error, size_t size)
{
    char numbers[256];
    float v[4] = {0.0f, 0.0f, 0.0f, 0.4f};
    uint8_t rgb[3] = {255, 255, 255};
    size_t count, commas = 0;
    if (o->lamp_count == CGT_PICTURE_MAX_LIGHTS - 1) {
        snprintf(error, size, "more than %d lights beside the first", CGT_PICTURE_MAX_LIGHTS - 1);
        return -1;
    }
    if (strlen(text) >= sizeof numbers) {
        snprintf(error, size, "the text is too long");
        return -1;
    }
    strcpy(numbers, text);
    for (char *c = numbers; *c; c++)
        if (*c == ',' && ++commas == 4) {
            *c = '\0';
            if (cgt_parse_color(c + 1, rgb, error, size))
                return -1;
            break;
        }
    char *after = numbers;
    if (cgt_read_numbers(numbers, 3, 4, v, &count, error, size))
        return -1;
    if (v[3] < 0.0f || v[3] > 100.0f || (kind == CGT_LIGHT_DIRECTIONAL && !v[0] && !v[1] && !v[2])) {
        snprintf(error, size, "\"%s\": a strength is 0 to 100, and 0,0,0 is no direction", text);
        return -1;
    }
    picture_lamp *lamp = &o->lamps[o->lamp_count++];
    lamp->kind = kind;
    lamp->strength = v[3];
    for (int c = 0; c < 3; c++) {
        lamp->place[c] = v[c];
        lamp->at[c] = cgt_scan_double(after + (c > 0), &after);
        lamp->color[c] = cgt_srgb_to_linear((float)rgb[c] / 255.0f);
    }
    return 0;
}

int cgt_parse_sun(const char *text, void *to, char *error, size_t size)
{
    return add_lamp(text, CGT_LIGHT_DIRECTIONAL, to, error, size);
}

int cgt_parse_lamp(const char *text, void *to, char *error, size_t size)
{
    return add_lamp(text, CGT_LIGHT_POINT, to, error, size);
}

/* ---- Texts --------------------------------------------------------------------------------------------------- */

/* A length, a unit, or both with a comma between them. */
int cgt_parse_scale_bar(const char *text, void *to, char *error, size_t size)
{
    char number[64];
    scale_bar bar = {.is_set = 1};
    const char *unit = cgt_split(text, ',', number, sizeof number);
    if (!unit && (*text == '.' || *text == '-' || *text == '+' || (*text >= '0' && *text <= '9'))) {
        snprintf(number, sizeof number, "%s", text);
        unit = "";
    } else if (!unit) {
        number[0] = '\0';
        unit = text;
    } else if (!*unit) {
        return cgt_refuse(error, size, "\"%s\": there is no unit after the comma", text);
    }
    if (strlen(unit) >= sizeof bar.unit)
        return cgt_refuse(error, size, "\"%s\": a unit has at most %zu bytes", unit, sizeof bar.unit - 1);
    if (*number && cgt_read_doubles(number, 1, &bar.length, error, size))
        return -1;
    if (*number && !(bar.length > 0.0))
        return cgt_refuse(error, size, "the length must be above 0");
    strcpy(bar.unit, unit);
    *(scale_bar *)to = bar;
    return 0;
}

/* Adds spheres to those that have labels. */
int cgt_parse_label(const char *text, void *to, char *error, size_t size)
{
    picture_options *const o = to;
    const size_t used = strlen(o->label);
    expression *const formula = cgt_expression_parse(text, error, size);
    if (!formula)
        return -1;
    cgt_expression_free(formula);
    const int length = snprintf(o->label + used, sizeof o->label - used, "%s(%s)", used ? " || " : "", text);
    if (length >= 0 && (size_t)length < sizeof o->label - used)
        return 0;
    o->label[used] = '\0';
    return cgt_refuse(error, size, "the conditions are too long together");
}

int cgt_parse_label_text(const char *text, void *to, char *error, size_t size)
{
    label_rules rules = {.which = NULL};
    const int result = cgt_label_rules_split(&rules, text, error, size);
    cgt_label_rules_free(&rules);
    *(const char **)to = text;
    return result;
}
