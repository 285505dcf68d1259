/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of options about files and parts of runs; see option_parsers.h. */
#include "render/options/option_parsers.h"

#include <stdio.h>
#include <string.h>

#include "common/program.h"
#include "options/numbers.h"
#include "picture/files/image_write.h"
#include "picture/files/movie.h"
#include "picture/overlay/contact_sheet.h"

render_output render_output_kind(const char *pattern)
{
    if (strcmp(pattern, "-") == 0)
        return OUTPUT_RAW;
    if (movie_is_name(pattern))
        return OUTPUT_MOVIE;
    return image_format_of(pattern) != IMAGE_NONE ? OUTPUT_PICTURE : OUTPUT_NONE;
}

int parse_output(const char *text, void *to, char *error, size_t size)
{
    render_options *o = to;
    if (o->output_count == RENDER_MAX_OUTPUTS) {
        snprintf(error, size, "more than %d patterns", RENDER_MAX_OUTPUTS);
        return -1;
    }
    if (out_path_parse(&o->outputs[o->output_count], text, error, size))
        return -1;
    const render_output kind = render_output_kind(text);
    if (kind == OUTPUT_NONE) {
        snprintf(error, size,
                 "\"%s\" ends in none of .png, .exr, .jpg, .tif, .mp4, .mov, .mkv, .webm, .gif, and is not -", text);
        return -1;
    }
    if (kind == OUTPUT_MOVIE && o->outputs[o->output_count].numbered) {
        snprintf(error, size, "\"%s\": a movie has all frames and no number", text);
        return -1;
    }
    o->output_count++;
    return 0;
}

int parse_sheet(const char *text, void *to, char *error, size_t size)
{
    if (!out_path_ends_in(text, ".png")) {
        snprintf(error, size, "\"%s\" does not end in .png", text);
        return -1;
    }
    *(const char **)to = text;
    return 0;
}

/* Two whole numbers with an x between them. */
int parse_grid(const char *text, void *to, char *error, size_t size)
{
    render_options *o = to;
    char first[16];
    const char *rows = cgt_split(text, 'x', first, sizeof first);
    if (!rows) {
        snprintf(error, size, "\"%s\" is not of the form 4x3", text);
        return -1;
    }
    return cgt_read_u32(first, 1, CONTACT_SHEET_MAX_EDGE, &o->sheet_columns, error, size) ||
                   cgt_read_u32(rows, 1, CONTACT_SHEET_MAX_EDGE, &o->sheet_rows, error, size)
               ? -1
               : 0;
}

/* "2/5". */
int parse_part(const char *text, void *to, char *error, size_t size)
{
    output_options *o = to;
    char first[16];
    const char *const second = cgt_split(text, '/', first, sizeof first);
    uint32_t part, parts;
    if (!second) {
        snprintf(error, size, "\"%.80s\" is not of the form 2/5", text);
        return -1;
    }
    if (cgt_read_u32(second, 1, 1000000, &parts, error, size) || cgt_read_u32(first, 1, parts, &part, error, size))
        return -1;
    o->part = part;
    o->parts = parts;
    return 0;
}
