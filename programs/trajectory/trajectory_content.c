/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formats by their first bytes: a signature, a keyword that begins the file, or the shape of the first lines. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_content.h"

#include <string.h>

#define MOST_LINES 40

typedef struct content {
    const char *bytes;
    size_t size, lines;
    text_span line[MOST_LINES]; /* the first ones, without their line feeds */
} content;

static int has_bytes(const content *c, size_t at, const void *bytes, size_t size)
{
    return c->size >= at + size && memcmp(c->bytes + at, bytes, size) == 0;
}

static const trajectory_format *find_signature(const content *c)
{
    static const struct {
        size_t at, size;
        const char *bytes;
        const trajectory_format *format;
    } signatures[] = {{0, 8, "CGTFRAM1", &trajectory_format_frames},
                      {0, 8, "\xdf\x65\xdf\x65\xdf\x65\xdf\x65", &trajectory_format_gsd},
                      {0, 4, "CDF\1", &trajectory_format_netcdf},
                      {0, 4, "CDF\2", &trajectory_format_netcdf},
                      {0, 4, "CDF\5", &trajectory_format_netcdf},
                      {0, 4, "\x89HDF", &trajectory_format_netcdf}, /* which tells what to do */
                      {4, 4, "CORD", &trajectory_format_dcd},
                      {8, 4, "CORD", &trajectory_format_dcd},
                      {0, 4, "\0\0\x07\xcb", &trajectory_format_xtc},
                      {0, 4, "\0\0\x07\xe7", &trajectory_format_xtc},
                      {0, 4, "\0\0\x07\xc9", &trajectory_format_trr},
                      {8, 8, "DUMPATOM", &trajectory_format_lammps_binary},
                      {8, 8, "DUMPCUST", &trajectory_format_lammps_binary},
                      {0, 5, "ITEM:", &trajectory_format_lammps},
                      {0, 22, "# vtk DataFile Version", &trajectory_format_vtk},
                      {0, 4, "PSF ", &trajectory_format_psf},
                      {0, 4, "PSF\n", &trajectory_format_psf},
                      {0, 8, "%VERSION", &trajectory_format_prmtop},
                      {0, 6, "HEADER", &trajectory_format_pdb},
                      {0, 6, "CRYST1", &trajectory_format_pdb},
                      {0, 6, "REMARK", &trajectory_format_pdb},
                      {0, 6, "MODEL ", &trajectory_format_pdb},
                      {0, 6, "ATOM  ", &trajectory_format_pdb},
                      {0, 6, "HETATM", &trajectory_format_pdb}};
    for (size_t i = 0; i < sizeof signatures / sizeof signatures[0]; i++)
        if (has_bytes(c, signatures[i].at, signatures[i].bytes, signatures[i].size))
            return signatures[i].format;
    return NULL;
}

/* How many words of a line follow each other that are numbers, after `skip` others. */
static size_t count_numbers(text_span line, size_t skip)
{
    text_span word;
    double number;
    size_t count = 0;
    while (text_word(&line, &word)) {
        if (skip > 0) {
            skip--;
            continue;
        }
        if (!text_double(word, &number))
            break;
        count++;
    }
    return count;
}

static int is_count(text_span line)
{
    text_span word;
    uint64_t number;
    return text_word(&line, &word) && text_u64(word, UINT32_MAX, &number) && text_is_blank(line);
}

/* Three numbers from column 21 on, with points at one distance. */
static int is_gro_row(text_span line)
{
    const char *point[3] = {line.begin + (text_length(line) > 20 ? 19 : text_length(line))};
    for (int i = 0; i < 3; i++) {
        const char *const from = i == 0 ? point[0] : point[i - 1] + 1;
        point[i] = from < line.end ? memchr(from, '.', (size_t)(line.end - from)) : NULL;
        if (point[i] == NULL)
            return 0;
    }
    return point[1] - point[0] == point[2] - point[1];
}

static int ends_with(text_span line, const char *word)
{
    text_trim(&line);
    const size_t length = strlen(word);
    return text_length(line) >= length && memcmp(line.end - length, word, length) == 0;
}

/* Comments and "#include", then "[ moleculetype ]" or another section. */
static int is_gromacs_topology(const content *c)
{
    int includes = 0;
    for (size_t i = 0; i < c->lines; i++) {
        text_span line = c->line[i], word;
        text_trim(&line);
        if (text_begins(line, "[") && memchr(line.begin, ']', text_length(line)) != NULL)
            return 1;
        includes |= text_begins(line, "#include");
        if (!text_word(&line, &word) || *word.begin == ';' || *word.begin == '#')
            continue;
        return 0;
    }
    return includes;
}

static const trajectory_format *find_shape(const content *c)
{
    const text_span *const line = c->line;
    size_t first = 0;
    while (first < c->lines && (text_is_blank(line[first]) || *line[first].begin == '#'))
        first++;
    if (first < c->lines && text_begins(line[first], "data_"))
        return &trajectory_format_mmcif;
    if (c->lines > 6 && (count_numbers(line[1], 0) == 1 || count_numbers(line[1], 0) == 3) &&
        count_numbers(line[2], 0) == 3 && count_numbers(line[3], 0) == 3 && count_numbers(line[4], 0) == 3 &&
        !text_is_blank(line[5]) && !ends_with(line[1], "hi"))
        return &trajectory_format_vasp;
    if (c->lines > 2 && is_count(line[0]) && count_numbers(line[2], 1) >= 3)
        return &trajectory_format_xyz;
    if (c->lines > 2 && is_count(line[1]) && is_gro_row(line[2]))
        return &trajectory_format_gro;
    for (size_t i = 1; i < c->lines; i++)
        if (count_numbers(line[i], 0) == 1 && ends_with(line[i], " atoms"))
            return &trajectory_format_lammps_data;
    return is_gromacs_topology(c) ? &trajectory_format_top : NULL;
}

const trajectory_format *trajectory_find_content(const char *bytes, size_t size)
{
    content c = {.bytes = bytes, .size = size};
    const char *const end = bytes + size;
    while (bytes < end && c.lines < MOST_LINES) {
        const char *const feed = memchr(bytes, '\n', (size_t)(end - bytes));
        c.line[c.lines++] = (text_span){bytes, feed != NULL ? feed : end};
        bytes = feed != NULL ? feed + 1 : end;
    }
    const trajectory_format *const found = find_signature(&c);
    return found != NULL ? found : find_shape(&c);
}

const trajectory_format *trajectory_find_signature(const char *bytes, size_t size)
{
    const content c = {.bytes = bytes, .size = size};
    const trajectory_format *const found = find_signature(&c);
    return found != &trajectory_format_pdb ? found : NULL; /* such words may begin the title of another format */
}
