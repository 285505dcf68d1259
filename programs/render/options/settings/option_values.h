/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of options of cgt-render that several of them take. Parsers return 0, or -1 with a sentence in error, and then
 * change none of their results, as those of common/program.h. */
#ifndef OPTION_VALUES_H
#define OPTION_VALUES_H

#include <stddef.h>
#include <stdint.h>

/* A direction: three numbers, not all zero. */
int option_parse_direction(const char *text, float direction[3], char *error, size_t error_size);

/* x, y or z: sets the unit vector. */
int option_parse_axis(const char *text, float axis[3], char *error, size_t error_size);

/* A colour: RRGGBB in hexadecimal, or a name such as red. */
int option_is_color(const char *text);
int option_parse_color(const char *text, uint8_t rgb[3], char *error, size_t error_size);

/* From `least` to `most` finite numbers with commas between them; most is at most 16. *count gets how many. */
int option_parse_numbers(const char *text, size_t least, size_t most, float *values, size_t *count, char *error,
                         size_t error_size);

#endif
