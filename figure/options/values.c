/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of options; see figure_values.h. */
#include "options/figure_values.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/numbers.h"

int cgt_parse_direction(const char *text, void *to, char *error, size_t error_size)
{
    float v[3];
    if (cgt_read_floats(text, 3, v, error, error_size))
        return -1;
    if (v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f) {
        snprintf(error, error_size, "0,0,0 is no direction");
        return -1;
    }
    memcpy(to, v, sizeof v);
    return 0;
}

int cgt_parse_axis(const char *text, void *to, char *error, size_t error_size)
{
    float *axis = to;
    if (strlen(text) != 1 || *text < 'x' || *text > 'z') {
        snprintf(error, error_size, "\"%s\" is not x, y or z", text);
        return -1;
    }
    for (int c = 0; c < 3; c++)
        axis[c] = *text - 'x' == c ? 1.0f : 0.0f;
    return 0;
}

typedef struct named_color {
    const char *name;
    const char *rgb;
} named_color;

/* The names are those of CSS, which people know. */
static const named_color named[] = {
    {"black", "000000"},   {"white", "ffffff"},   {"gray", "808080"},     {"grey", "808080"},   {"silver", "c0c0c0"},
    {"red", "ff0000"},     {"green", "008000"},   {"blue", "0000ff"},     {"yellow", "ffff00"}, {"cyan", "00ffff"},
    {"magenta", "ff00ff"}, {"orange", "ffa500"},  {"purple", "800080"},   {"brown", "a52a2a"},  {"pink", "ffc0cb"},
    {"gold", "ffd700"},    {"teal", "008080"},    {"navy", "000080"},     {"olive", "808000"},  {"tan", "d2b48c"},
    {"salmon", "fa8072"},  {"skyblue", "87ceeb"}, {"steelblue", "4682b4"}};

static const char *hexadecimal(const char *text)
{
    for (size_t i = 0; i < sizeof named / sizeof named[0]; i++)
        if (strcmp(text, named[i].name) == 0)
            return named[i].rgb;
    return strlen(text) == 6 && strspn(text, "0123456789abcdefABCDEF") == 6 ? text : NULL;
}

int cgt_is_color(const char *text) { return hexadecimal(text) != NULL; }

int cgt_parse_color(const char *text, void *to, char *error, size_t error_size)
{
    uint8_t *rgb = to;
    const char *digits = hexadecimal(text);
    if (!digits) {
        snprintf(error, error_size, "\"%s\" is not of the form RRGGBB, in hexadecimal, nor the name of a colour", text);
        return -1;
    }
    const unsigned long value = strtoul(digits, NULL, 16);
    for (int c = 0; c < 3; c++)
        rgb[c] = (uint8_t)(value >> (16 - 8 * c) & 255u);
    return 0;
}

int cgt_read_numbers(const char *text, size_t least, size_t most, float *values, size_t *count, char *error,
                     size_t error_size)
{
    size_t numbers = 1;
    for (const char *c = text; *c; c++)
        numbers += *c == ',';
    if (numbers < least || numbers > most) {
        snprintf(error, error_size, "\"%s\" has %zu numbers, not %zu to %zu", text, numbers, least, most);
        return -1;
    }
    if (cgt_read_floats(text, numbers, values, error, error_size))
        return -1;
    *count = numbers;
    return 0;
}

const char *cgt_split(const char *text, char mark, char *first, size_t room)
{
    const char *at = strchr(text, mark);
    if (!at || (size_t)(at - text) >= room)
        return NULL;
    memcpy(first, text, (size_t)(at - text));
    first[at - text] = '\0';
    return at + 1;
}
