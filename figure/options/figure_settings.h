/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What was set of a figure: names and values in the order in which they count, from which figure_options are made. */
#ifndef FIGURE_SETTINGS_H
#define FIGURE_SETTINGS_H

#include <stddef.h>

#include "options/figure_options.h"

typedef struct figure_setting {
    const char *name; /* of the row */
    char *value;      /* NULL: none */
} figure_setting;

/* All zero at first. */
typedef struct figure_settings {
    figure_setting *list;
    size_t count;
} figure_settings;

typedef enum settings_change {
    SETTINGS_SET,   /* a name's value; NULL: one without */
    SETTINGS_UNSET, /* all values of a name; NULL: of all names */
    SETTINGS_LINES  /* lines "name = value", which are checked together; the name does not count */
} settings_change;

/* A line "name = value" or "name" of settings; name "": the line is empty. */
typedef struct settings_line {
    char name[64];
    const char *value; /* in the text; NULL: none */
    size_t value_length;
} settings_line;

/* Reads a line; returns where the next one begins. */
const char *cgt_figure_settings_line(const char *line, settings_line *told);

/* Changes settings, and makes the options anew, whose texts are those of the settings. Returns 0, or -1 with a
 * sentence: nothing has changed. */
int cgt_figure_settings_change(figure_settings *s, settings_change change, const char *name, const char *value,
                               figure_options *options, char *error, size_t error_size);

/* Makes options of the settings, which could be made before; keys of the camera are the caller's to free. Returns 0, or
 * -1 with a sentence. */
int cgt_figure_settings_replay(const figure_settings *s, figure_options *options, char *error, size_t error_size);

/* Copies all settings, with their values. Returns 0, or -1 where there is no memory. */
int cgt_figure_settings_copy(const figure_settings *from, figure_settings *to);

/* Copies the values of an option, a line each, or all as a settings file; returns the length of the whole text. */
size_t cgt_figure_settings_print(const figure_settings *s, const char *name, char *text, size_t size);

void cgt_figure_settings_free(figure_settings *s);

#endif
