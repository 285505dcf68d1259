/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colour maps from files; see color_table.h. */
#include "color/color_table.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/numbers.h"

enum { MOST_COLORS = 4096, MOST_LINES = 1000000 };

typedef struct table_file {
    float (*rgb)[3];
    uint32_t count;
    int is_hexadecimal; /* as the first colour is */
    float largest;
} table_file;

static const char blanks[] = " \t\r\n,";

/* RRGGBB, with or without a '#' before it. Returns whether it is one. */
static int read_hexadecimal(const char *text, float rgb[3])
{
    const char *const digits = text + (*text == '#');
    const size_t length = strspn(digits, "0123456789abcdefABCDEF");
    if (length != 6 || digits[6 + strspn(digits + 6, blanks)] != '\0')
        return 0;
    const unsigned long value = strtoul(digits, NULL, 16);
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(value >> (16 - 8 * c) & 255u);
    return 1;
}

static int read_numbers(const char *text, float rgb[3])
{
    char *end;
    for (int c = 0; c < 3; c++) {
        rgb[c] = cgt_scan_float(text, &end);
        if (end == text || !(rgb[c] >= 0.0f && rgb[c] <= 255.0f))
            return 0;
        text = end + strspn(end, blanks);
        if (c < 2 && text == end)
            return 0;
    }
    return *text == '\0';
}

/* Adds the colour of a line, which may have none. Returns 0, or -1 with a reason. */
static int add_line(table_file *file, const char *line, char *reason, size_t size)
{
    const char *const text = line + strspn(line, blanks);
    float rgb[3];
    const int is_hexadecimal = read_hexadecimal(text, rgb);
    if (*text == '\0' || (*text == '#' && !is_hexadecimal))
        return 0;
    if (!is_hexadecimal && !read_numbers(text, rgb))
        return cgt_refuse(reason, size, "\"%.*s\" is no colour: three numbers from 0 to 1 or from 0 to 255, or RRGGBB",
                          (int)(strcspn(text, "\r\n") < 60 ? strcspn(text, "\r\n") : 60), text);
    if (file->count == MOST_COLORS)
        return cgt_refuse(reason, size, "there are more than %d colours", MOST_COLORS);
    if (file->count && is_hexadecimal != file->is_hexadecimal)
        return cgt_refuse(reason, size, "some colours are numbers, and others RRGGBB");
    file->is_hexadecimal = is_hexadecimal;
    for (int c = 0; c < 3; c++) {
        file->rgb[file->count][c] = rgb[c];
        file->largest = rgb[c] > file->largest ? rgb[c] : file->largest;
    }
    file->count++;
    return 0;
}

/* Between two colours of the file. */
static void set_table(color_table *table, const table_file *file)
{
    const float scale = file->is_hexadecimal || file->largest > 1.0f ? 1.0f : 255.0f;
    table->count = file->count < COLOR_TABLE_MOST ? file->count : COLOR_TABLE_MOST;
    const uint32_t last = table->count > 1 ? table->count - 1 : 1;
    for (uint32_t i = 0; i < table->count; i++) {
        const uint64_t at = (uint64_t)i * (file->count - 1), whole = at / last;
        const float f = (float)(at % last) / (float)last;
        for (int c = 0; c < 3; c++) {
            const float next = whole + 1 < file->count ? file->rgb[whole + 1][c] : 0.0f;
            table->srgb[i][c] = (uint8_t)(scale * ((1.0f - f) * file->rgb[whole][c] + f * next) + 0.5f);
        }
    }
}

/* Reads the lines. Returns 0, or -1 with a sentence. */
static int read_lines(table_file *table, FILE *file, const char *path, char *error, size_t error_size)
{
    char line[1024], reason[256];
    unsigned number = 0;
    int failed = 0;
    while (!failed && fgets(line, sizeof line, file)) {
        const int has_mark = ++number == 1 && strncmp(line, "\xEF\xBB\xBF", 3) == 0; /* of UTF-8 */
        failed = number > MOST_LINES ? cgt_refuse(reason, sizeof reason, "there are more than %d lines", MOST_LINES)
                                     : add_line(table, has_mark ? line + 3 : line, reason, sizeof reason);
    }
    if (failed)
        return cgt_refuse(error, error_size, "%s:%u: %s", path, number, reason);
    if (ferror(file))
        return cgt_refuse(error, error_size, "%s: cannot read", path);
    if (table->count < 2)
        return cgt_refuse(error, error_size, "%s: a map has two colours or more, a line each", path);
    return 0;
}

int cgt_color_table_read(color_table *table, const char *path, char *error, size_t error_size)
{
    table_file read = {.rgb = malloc(MOST_COLORS * sizeof *read.rgb)};
    FILE *const file = fopen(path, "r");
    int failed = 0;
    if (!file)
        failed = cgt_refuse(error, error_size, "%s: %s", path, strerror(errno));
    else if (!read.rgb)
        failed = cgt_refuse(error, error_size, "out of memory");
    else
        failed = read_lines(&read, file, path, error, error_size);
    if (!failed)
        set_table(table, &read);
    if (file)
        fclose(file);
    free(read.rgb);
    return failed;
}

void cgt_color_table_get(const color_table *table, float x, float srgb[3])
{
    const float last = (float)(table->count - 1), at = x > 0.0f ? (x < 1.0f ? x : 1.0f) * last : 0.0f;
    const uint32_t k = at < last ? (uint32_t)at : table->count - 2;
    const float f = at - (float)k;
    for (int c = 0; c < 3; c++)
        srgb[c] = ((1.0f - f) * (float)table->srgb[k][c] + f * (float)table->srgb[k + 1][c]) / 255.0f;
}
