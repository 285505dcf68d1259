/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A colour map of the user's own: a file with a colour a line, from the map's start to its end, as red, green and blue
 * from 0 to 1, or from 0 to 255 where any number of the file is above 1, or as RRGGBB in hexadecimal. Numbers have
 * blanks or commas between them. A line of '#' and anything but six hexadecimal digits is a remark. */
#ifndef COLOR_TABLE_H
#define COLOR_TABLE_H

#include <stddef.h>
#include <stdint.h>

enum { COLOR_TABLE_MOST = 256 }; /* colours: what a file has more is between two of these */

typedef struct color_table {
    uint32_t count; /* 0: there is none */
    uint8_t srgb[COLOR_TABLE_MOST][3];
} color_table;

/* Returns 0, or -1 with a sentence that names the file and the line; then the table is as it was. */
int cgt_color_table_read(color_table *table, const char *path, char *error, size_t error_size);

/* The colour at x, from 0 to 1, in sRGB from 0 to 1. */
void cgt_color_table_get(const color_table *table, float x, float srgb[3]);

#endif
