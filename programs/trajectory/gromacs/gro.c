/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GROMACS .gro: a title (which may have the time and the step), a count, an atom on each line in fixed columns, the
 * box. Lengths are nanometres. Each number may have any count of decimals: the distance of the first two decimal points
 * is the width of all fields, velocities included (manual of GROMACS, "File formats", gro). */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/atoms/trajectory_atoms.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define NANOMETRES 0.1f /* in an Angstrom */
#define NUMBERS_BEGIN 20u

typedef struct gro_state {
    name_table names;
    uint32_t count;
    size_t width; /* of a number */
    int has_velocity;
    int has_element;
    int resid, resname, name; /* slots of the columns, 0: not wanted */
    residue_run residues;     /* of the frame */
} gro_state;

/* ---- Head --------------------------------------------------------------------------------------------------- */

/* The number after the last `key` of a title: "t= 1.5 step= 100". Returns 1 or 0. */
static int title_number(text_span title, const char *key, double *value)
{
    const size_t length = strlen(key);
    int found = 0;
    for (const char *p = title.begin; p + length <= title.end; p++) {
        const int begins_word = p == title.begin || p[-1] == ' ' || p[-1] == ',' || p[-1] == '\t';
        text_span rest = {p + length, title.end}, word;
        if (begins_word && memcmp(p, key, length) == 0 && text_word(&rest, &word)) {
            double number;
            const int is_number = field_double(word, &number) && isfinite(number);
            *value = is_number ? number : *value;
            found |= is_number;
        }
    }
    return found;
}

/* Reads title and count: 1, 0 at the end of the file, -1. */
static int read_head(cgt_trajectory *t, cgt_trajectory_frame *head)
{
    gro_state *const s = t->state;
    text_span line, word;
    double step = 0.0;
    int status = trajectory_line(t, &line);
    if (status <= 0)
        return status;
    const int is_blank = text_is_blank(line);
    head->time = NAN;
    title_number(line, "t=", &head->time);
    head->step = (int64_t)t->next;
    if (title_number(line, "step=", &step) && fabs(step) < 9e18)
        head->step = (int64_t)step;
    do
        status = trajectory_line(t, &line);
    while (status > 0 && is_blank && text_is_blank(line));
    if (status <= 0 && (status < 0 || is_blank))
        return status; /* blank lines end the file */
    if (status == 0 || !text_word(&line, &word) || !text_is_blank(line))
        return trajectory_fail(t, t->text.line, "a number of atoms was expected on the line after the title");
    return trajectory_parse_count(t, word, &s->count);
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

static int plan_columns(cgt_trajectory *t)
{
    gro_state *const s = t->state;
    s->resid = columns_add_named(t, "resid", CGT_TRAJECTORY_WHOLE);
    s->resname = columns_add_named(t, "resname", CGT_TRAJECTORY_WORD);
    s->name = columns_add_named(t, "name", CGT_TRAJECTORY_WORD);
    return s->resid < 0 || s->resname < 0 || s->name < 0 ? -1 : 1;
}

/* Takes the width of the numbers from the first atom. */
static int find_width(cgt_trajectory *t, text_span line)
{
    gro_state *const s = t->state;
    const text_span numbers = {line.begin + (text_length(line) < NUMBERS_BEGIN ? text_length(line) : NUMBERS_BEGIN),
                               line.end};
    const char *const first = memchr(numbers.begin, '.', text_length(numbers));
    const char *const second = first != NULL ? memchr(first + 1, '.', (size_t)(numbers.end - first) - 1) : NULL;
    s->width = second != NULL ? (size_t)(second - first) : 0;
    if (s->width < 3 || s->width > 40)
        return trajectory_fail(t, t->text.line, "no three coordinates with decimal points from column 21 on");
    s->has_velocity = !text_is_blank(field_at(line, NUMBERS_BEGIN + 3 * s->width, 3 * s->width));
    return 1;
}

static int read_numbers(cgt_trajectory *t, text_span line, size_t first, float *values)
{
    char quote[TEXT_QUOTE_SIZE];
    const gro_state *const s = t->state;
    for (size_t k = 0; k < 3; k++) {
        const text_span field = field_at(line, NUMBERS_BEGIN + (first + k) * s->width, s->width);
        if (!(first == 0 ? field_place(t, k, field, &values[k]) : field_float(field, &values[k])))
            return trajectory_fail(t, t->text.line, "'%s' in columns %zu to %zu is not a number",
                                   text_quote(field, quote), NUMBERS_BEGIN + (first + k) * s->width + 1,
                                   NUMBERS_BEGIN + (first + k + 1) * s->width);
    }
    return 1;
}

/* Stores the wanted columns of atom i. */
static int store_columns(cgt_trajectory *t, size_t i, text_span line, text_span residue, text_span name)
{
    const gro_state *const s = t->state;
    if (s->resid > 0 && !field_float(field_at(line, 0, 5), columns_values(t, s->resid) + i))
        return trajectory_fail(t, t->text.line, "columns 1 to 5 have no number of a residue");
    if (s->resname > 0)
        columns_store_word(t, s->resname, i, residue);
    if (s->name > 0)
        columns_store_word(t, s->name, i, name);
    return 1;
}

static int read_atom(cgt_trajectory *t, size_t i, text_span line)
{
    gro_state *const s = t->state;
    const text_span residue = field_at(line, 5, 5);
    text_span name = field_at(line, 10, 5);
    if (text_length(name) == 0)
        name = MOLECULE_UNNAMED;
    atoms_set_place(t, i, '\0');
    const uint32_t site = atoms_set_residue(t, &s->residues, i, field_at(line, 0, 10), residue, name);
    const uint32_t element = site != 0 ? site : molecule_element(t, name, residue, NAME_ANYWHERE);
    s->has_element |= element != 0;
    if (read_numbers(t, line, 0, t->store.xyzr + 4 * i) < 0 ||
        (s->has_velocity && read_numbers(t, line, 3, t->store.velocity + 3 * i) < 0))
        return -1;
    return molecule_store(t, &s->names, i, name, element, NANOMETRES) < 0 ? -1
                                                                          : store_columns(t, i, line, residue, name);
}

static int read_atoms(cgt_trajectory *t)
{
    gro_state *const s = t->state;
    s->has_element = s->has_velocity = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        text_span line;
        const int status = trajectory_line(t, &line);
        if (status <= 0)
            return status < 0 ? -1
                              : trajectory_fail(t, t->text.line,
                                                "the file ends after %" PRIu32 " of %" PRIu32 " spheres: it is cut off",
                                                i, s->count);
        if ((i == 0 && find_width(t, line) < 0) || trajectory_reserve(t, (size_t)i + 1, s->count) < 0 ||
            read_atom(t, i, line) < 0)
            return -1;
    }
    return 1;
}

/* ---- The box ------------------------------------------------------------------------------------------------ */

/* Three or nine numbers: v1(x) v2(y) v3(z) v1(y) v1(z) v2(x) v2(z) v3(x) v3(y). A box of zeros is none. */
static int read_box(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    static const int place[9] = {0, 4, 8, 1, 2, 3, 5, 6, 7};
    static const double origin[3] = {0, 0, 0};
    char quote[TEXT_QUOTE_SIZE];
    double edge[3][3] = {{0}};
    text_span line, word;
    int numbers = 0;
    if (trajectory_line_inside(t, &line, "before the box") < 0)
        return -1;
    while (text_word(&line, &word)) {
        double value;
        if (numbers == 9 || !text_double(word, &value) || !isfinite(value))
            return trajectory_fail(t, t->text.line, "'%s' is not one of the 3 or 9 numbers of a box",
                                   text_quote(word, quote));
        edge[place[numbers] / 3][place[numbers] % 3] = value;
        numbers++;
    }
    if (numbers != 3 && numbers != 9)
        return trajectory_fail(t, t->text.line, "%d numbers where the box needs 3 or 9", numbers);
    if (!t->text.has_feed) /* 3 numbers may be the first of 9 */
        trajectory_warn_open(t, t->text.line);
    if (edge[0][0] != 0.0 || edge[1][1] != 0.0 || edge[2][2] != 0.0) {
        trajectory_frame_set_box(frame, origin, (const double(*)[3])edge);
        memset(frame->periodic, 1, sizeof frame->periodic);
    }
    return 1;
}

/* ---- The format --------------------------------------------------------------------------------------------- */

static int gro_begin(cgt_trajectory *t)
{
    (void)t;
    return 1;
}

static int gro_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    gro_state *const s = t->state;
    cgt_trajectory_frame head;
    const int status = read_head(t, &head);
    if (status <= 0)
        return status;
    if (plan_columns(t) < 0 || trajectory_reserve(t, 0, s->count) < 0 || read_atoms(t) < 0)
        return -1;
    molecule_tell_guesses(t);
    trajectory_frame_fill(t, frame, s->count);
    frame->step = head.step;
    frame->time = head.time;
    frame->type = t->store.type;
    frame->element = s->has_element ? t->store.element : NULL;
    frame->velocity = s->has_velocity ? t->store.velocity : NULL;
    return read_box(t, frame);
}

const trajectory_format trajectory_format_gro = {
    .is_series = 1,
    .unit = 0.1f,
    .is_followed = 1,
    .state_size = sizeof(gro_state),
    .begin = gro_begin,
    .read = gro_read, /* no skip: names are numbered in order of appearance, so that a skipped frame must be read */
};
