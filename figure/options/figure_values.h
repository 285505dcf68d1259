/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of a figure's options that are more than a number. Each is an option_parser: it returns 0, or -1 with a
 * sentence in error. `to` is what option_table.c says. */
#ifndef FIGURE_VALUES_H
#define FIGURE_VALUES_H

#include "options/numbers.h"
#include "options/figure_options.h"

/* ---- values.c: values that several options have -------------------------------------------------------------- */

option_parser cgt_parse_direction; /* float[3]: three numbers, not all zero */
option_parser cgt_parse_axis;      /* float[3]: x, y or z: the unit vector */
option_parser cgt_parse_color;     /* uint8_t[3]: RRGGBB in hexadecimal, or a name such as red */
int cgt_is_color(const char *text);

/* From `least` to `most` finite numbers with commas between them; most is at most 16. *count gets how many. */
int cgt_read_numbers(const char *text, size_t least, size_t most, float *values, size_t *count, char *error,
                     size_t error_size);

/* Copies what is before the first `mark` of a text to `first`, of `room` bytes, and returns what is after it; NULL
 * where there is no mark, or too much before it. */
const char *cgt_split(const char *text, char mark, char *first, size_t room);

/* ---- picture_values.c ---------------------------------------------------------------------------------------- */

option_parser cgt_parse_size, cgt_parse_keys, cgt_parse_view, cgt_parse_coloring, cgt_parse_range; /* figure_options */
option_parser cgt_parse_samples, cgt_parse_camera, cgt_parse_colormap; /* uint32_t, camera_key, colormap * */
option_parser cgt_parse_sun, cgt_parse_lamp, cgt_parse_label;          /* picture_options */
option_parser cgt_parse_scale_bar, cgt_parse_label_text;               /* scale_bar, const char * */

/* ---- particle_values.c --------------------------------------------------------------------------------------- */

option_parser cgt_parse_show, cgt_parse_hide, cgt_parse_slice, cgt_parse_cut; /* particle_options, and the next ones */
option_parser cgt_parse_type_radius, cgt_parse_type_color, cgt_parse_type_name;
option_parser cgt_parse_formula, cgt_parse_images; /* const char *, uint32_t[3] */
option_parser cgt_parse_material;                  /* bounce_options */
option_parser cgt_parse_floor;                     /* floor_options */
option_parser cgt_parse_floor_place;               /* double[4] */

#endif
