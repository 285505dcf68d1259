/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * POSCAR and CONTCAR (one frame) and XDATCAR (a run) of VASP, as its wiki describes them: a title; a scale, which is
 * the volume of the cell where it is negative, or three, one for each axis; three edges; names of species, which VASP 4
 * does not write; how many atoms each has; perhaps "Selective dynamics"; "Direct" or "Cartesian"; the positions. What
 * follows them in a CONTCAR (velocities, predictors) is not read. A run goes on with "Direct configuration= N", or with
 * a whole header where the cell changes. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/molecule_atom.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define MOST_SPECIES 256u
#define SYMBOL 4u        /* bytes, the zero included */
#define BARE_RADIUS 1.0f /* Angstrom, of atoms without an element */

typedef struct vasp_state {
    name_table names;
    double edge[3][3], scale[3];
    uint32_t species;
    uint32_t count[MOST_SPECIES];
    char symbol[MOST_SPECIES][SYMBOL]; /* "": not told */
    uint32_t atoms;
    int is_run, was_read, is_cartesian;
    int64_t step;
} vasp_state;

/* ---- Header ------------------------------------------------------------------------------------------------- */

/* Reads the numbers that a line begins with, at most 3. Returns how many there are. */
static int take_numbers(text_span line, double values[3])
{
    text_span word;
    int count = 0;
    while (count < 3 && text_word(&line, &word) && text_double(word, &values[count]) && isfinite(values[count]))
        count++;
    return count;
}

static int read_cell(cgt_trajectory *t)
{
    vasp_state *const s = t->state;
    text_span line;
    if (trajectory_line_inside(t, &line, "before the scale") < 0)
        return -1;
    const int scales = take_numbers(line, s->scale);
    if (scales != 1 && scales != 3)
        return trajectory_fail(t, t->text.line, "a scale, or three, was expected on the second line");
    for (int i = 0; i < 3; i++) {
        if (trajectory_line_inside(t, &line, "before the edges of the cell") < 0)
            return -1;
        if (take_numbers(line, s->edge[i]) != 3)
            return trajectory_fail(t, t->text.line, "an edge of the cell has three numbers");
    }
    if (scales == 1) {
        double(*const e)[3] = s->edge;
        const double volume = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                              e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                              e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
        const double scale = s->scale[0] < 0.0 ? cbrt(-s->scale[0] / fabs(volume)) : s->scale[0];
        s->scale[0] = s->scale[1] = s->scale[2] = scale;
    }
    for (int i = 0; i < 9; i++)
        s->edge[i / 3][i % 3] *= s->scale[i % 3];
    for (int i = 0; i < 3; i++)
        if (!(s->scale[i] > 0.0 && isfinite(s->scale[i])))
            return trajectory_fail(t, t->text.line, "the scale of the cell is not above 0");
    return 1;
}

/* The symbols of a line, each perhaps with the name of its potential: "Fe_pv", "O/1a2b3c". Returns how many there are,
 * 0 where one is no element. */
static uint32_t take_symbols(vasp_state *s, text_span line)
{
    text_span word;
    uint32_t count = 0;
    while (count < MOST_SPECIES && text_word(&line, &word)) {
        element_reading reading;
        size_t length = 0;
        while (length < text_length(word) && word.begin[length] != '_' && word.begin[length] != '/')
            length++;
        const uint32_t element = element_find((text_span){word.begin, word.begin + length}, &reading);
        if (length > 2 || (reading != ELEMENT_SYMBOL && reading != ELEMENT_EITHER))
            return 0;
        strcpy(s->symbol[count++], element_symbol(element));
    }
    return count;
}

/* Names and counts of the species; VASP 4 has the names in the title, if at all. */
static int read_species(cgt_trajectory *t, uint32_t titled)
{
    vasp_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    text_span line, word;
    uint32_t named = titled;
    if (trajectory_line_inside(t, &line, "before the numbers of atoms") < 0)
        return -1;
    text_span rest = line;
    uint64_t number;
    if (text_word(&rest, &word) && !text_u64(word, UINT64_MAX, &number)) {
        named = take_symbols(s, line);
        if (trajectory_line_inside(t, &line, "before the numbers of atoms") < 0)
            return -1;
    }
    uint64_t atoms = 0;
    for (s->species = 0; s->species < MOST_SPECIES && text_word(&line, &word); s->species++) {
        if (s->species > 0 && !text_u64(word, UINT64_MAX, &number)) /* a remark */
            break;
        if (!text_u64(word, UINT64_MAX, &number))
            return trajectory_fail(t, t->text.line, "'%s' is not a number of atoms", text_quote(word, quote));
        if (trajectory_parse_count(t, word, &s->count[s->species]) < 0)
            return -1;
        atoms += s->count[s->species];
    }
    if (s->species == MOST_SPECIES && text_word(&line, &word) && text_u64(word, UINT64_MAX, &number))
        return trajectory_fail(t, t->text.line, "more than %u species", MOST_SPECIES);
    if (s->species == 0)
        return trajectory_fail(t, t->text.line, "numbers of atoms were expected");
    if (atoms > t->options.max_count)
        return trajectory_fail(t, t->text.line, "%" PRIu64 " atoms are more than the limit of %" PRIu64, atoms,
                               t->options.max_count);
    s->atoms = (uint32_t)atoms;
    for (uint32_t i = 0; i < s->species && named != s->species; i++)
        s->symbol[i][0] = '\0';
    return 1;
}

/* Reads a header, whose title is `title`. */
static int read_head(cgt_trajectory *t, text_span title)
{
    vasp_state *const s = t->state;
    const uint32_t titled = take_symbols(s, title);
    return read_cell(t) < 0 ? -1 : read_species(t, titled);
}

/* Whether a line is "Direct configuration= 7", and its number. */
static int is_configuration(text_span line, int64_t *step)
{
    static const char word[] = "configuration=";
    const size_t length = sizeof word - 1;
    for (const char *p = line.begin; p + length <= line.end; p++) {
        if (memcmp(p, word, length) == 0) {
            text_span number = {p + length, line.end};
            text_trim(&number);
            if (!text_i64(number, step))
                *step = 0;
            return 1;
        }
    }
    return 0;
}

/* Reads up to the positions: 1, 0 at the end of the file, -1. */
static int begin_frame(cgt_trajectory *t)
{
    vasp_state *const s = t->state;
    text_span line;
    int status = trajectory_line(t, &line);
    while (status > 0 && s->is_run && text_is_blank(line))
        status = trajectory_line(t, &line);
    if (status <= 0)
        return status;
    if (!s->is_run || !is_configuration(line, &s->step)) {
        if (read_head(t, line) < 0 || trajectory_line_inside(t, &line, "before the positions") < 0)
            return -1;
        text_trim(&line);
        const int is_selective = line.begin < line.end && (*line.begin == 'S' || *line.begin == 's');
        if (is_selective && trajectory_line_inside(t, &line, "before the positions") < 0)
            return -1;
        s->is_run = is_configuration(line, &s->step);
    }
    text_trim(&line);
    s->is_cartesian = line.begin < line.end && strchr("CcKk", *line.begin) != NULL;
    return 1;
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

static int read_atom(cgt_trajectory *t, uint32_t i, uint32_t species)
{
    vasp_state *const s = t->state;
    text_span line;
    double p[3];
    if (trajectory_line_inside(t, &line, "in the positions") < 0 || trajectory_reserve(t, (size_t)i + 1, s->atoms) < 0)
        return -1;
    if (take_numbers(line, p) != 3)
        return trajectory_fail(t, t->text.line, "a position has three numbers");
    for (size_t k = 0; k < 3; k++)
        t->store.xyzr[4 * (size_t)i + k] = trajectory_place(
            t, k,
            s->is_cartesian ? s->scale[k] * p[k] : p[0] * s->edge[0][k] + p[1] * s->edge[1][k] + p[2] * s->edge[2][k]);
    const char *const symbol = s->symbol[species];
    if (*symbol != '\0') {
        element_reading reading;
        const text_span name = {symbol, symbol + strlen(symbol)};
        return molecule_store(t, &s->names, i, name, element_find(name, &reading), 1.0f);
    }
    t->store.type[i] = species + 1;
    t->store.element[i] = 0;
    t->store.xyzr[4 * (size_t)i + 3] = t->options.radius > 0.0f ? t->options.radius : BARE_RADIUS;
    return 1;
}

/* ---- The format --------------------------------------------------------------------------------------------- */

static int vasp_begin(cgt_trajectory *t)
{
    vasp_state *const s = t->state;
    s->is_run = s->was_read = 0;
    return 1;
}

static int vasp_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    vasp_state *const s = t->state;
    if (s->was_read && !s->is_run)
        return 0;
    s->step = (int64_t)t->next;
    const int status = begin_frame(t);
    if (status <= 0)
        return status;
    uint32_t i = 0;
    if (trajectory_reserve(t, 0, s->atoms) < 0)
        return -1;
    for (uint32_t species = 0; species < s->species; species++)
        for (uint32_t k = 0; k < s->count[species]; k++)
            if (read_atom(t, i++, species) < 0)
                return -1;
    if (!t->text.has_feed)
        trajectory_warn_open(t, t->text.line);
    s->was_read = 1;
    trajectory_frame_fill(t, frame, s->atoms);
    frame->step = s->step;
    frame->type = t->store.type;
    frame->element = s->symbol[0][0] != '\0' ? t->store.element : NULL;
    trajectory_frame_set_box(frame, origin, (const double(*)[3])s->edge);
    memset(frame->periodic, 1, sizeof frame->periodic);
    return 1;
}

const trajectory_format trajectory_format_vasp = {
    .is_series = 1,
    .is_followed = 1,
    .state_size = sizeof(vasp_state),
    .begin = vasp_begin,
    .read = vasp_read, /* no skip: names are numbered in order of appearance */
};
