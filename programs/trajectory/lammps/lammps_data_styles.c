/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of LAMMPS data files: keywords of sections, and which columns atoms have (documentation of LAMMPS,
 * read_data, "Atoms section"). */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/lammps/lammps_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

text_span lammps_without_comment(text_span line)
{
    const char *const mark = memchr(line.begin, '#', text_length(line));
    line.end = mark != NULL ? mark : line.end;
    text_trim(&line);
    return line;
}

int lammps_is_keyword(text_span line, int is_first)
{
    static const char *const known[] = {"Atoms",     "Velocities", "Masses", "Bonds",     "Angles", "Dihedrals",
                                        "Impropers", "Ellipsoids", "Lines",  "Triangles", "Bodies"};
    text_span rest = lammps_without_comment(line), last = rest, word;
    int has_number = 0;
    double number;
    if (rest.begin == rest.end ||
        !((*rest.begin >= 'A' && *rest.begin <= 'Z') || (*rest.begin >= 'a' && *rest.begin <= 'z')))
        return 0;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (text_is(rest, known[i]))
            return 1;
    while (text_word(&rest, &word)) {
        has_number |= text_double(word, &number);
        last = word;
    }
    return text_is(last, "Coeffs") || text_is(last, "Labels") || (!has_number && !is_first);
}

typedef struct data_style {
    const char *name;
    const char *columns;
} data_style;

static const data_style styles[] = {
    {"atomic", "id type x y z"},
    {"charge", "id type q x y z"},
    {"bond", "id mol type x y z"},
    {"angle", "id mol type x y z"},
    {"molecular", "id mol type x y z"},
    {"full", "id mol type q x y z"},
    {"sphere", "id type diameter density x y z"},
    {"dipole", "id type q x y z mux muy muz"},
    {"ellipsoid", "id type ellipsoidflag density x y z"},
    {"line", "id mol type lineflag density x y z"},
    {"tri", "id mol type triangleflag density x y z"},
    {"body", "id type bodyflag mass x y z"},
    {"bpm/sphere", "id mol type diameter density x y z"},
    {"electron", "id type q spin eradius x y z"},
    {"peri", "id type volume density x y z"},
    {"dpd", "id type theta x y z"},
    {"edpd", "id type edpd_temp edpd_cv x y z"},
    {"mdpd", "id type rho x y z"},
    {"sph", "id type rho esph cv x y z"},
    {"spin", "id type x y z spx spy spz sp"},
    {"hybrid", "id type x y z"},
};

static text_span span_of(const char *text) { return (text_span){text, text + strlen(text)}; }

static int count_words(text_span line)
{
    text_span word;
    int count = 0;
    while (text_word(&line, &word))
        count++;
    return count;
}

/* ---- What the rows tell ------------------------------------------------------------------------------------- */

/* So many bytes of the rows are looked at, some hundred rows, however few of them a pipe has delivered. */
#define PEEKED 32768u

/* Copies the next lines: whole ones, or the beginning of a long one. rows: PEEKED + 1 bytes. Returns 1 or -1. */
static int peek_rows(cgt_trajectory *t, char *rows)
{
    const text_reader *const r = &t->text;
    const char *reason = "";
    text_span whole;
    if (text_reader_lines(&t->text, PEEKED, PEEKED, &whole, &reason) < 0)
        return trajectory_fail(t, r->line, "%s", reason);
    const size_t held = r->end - r->begin;
    size_t size = held < PEEKED ? held : PEEKED;
    memcpy(rows, r->data + r->begin, size);
    if (held > PEEKED || !r->at_end) {
        size_t end = size;
        while (end > 0 && rows[end - 1] != '\n')
            end--;
        size = end > 0 ? end : size;
    }
    rows[size] = '\0';
    return 1;
}

/* Takes the next row from the front, without its comment: 1, 0 at a blank line and at the end. */
static int take_row(text_span *rows, text_span *line)
{
    const char *const feed = memchr(rows->begin, '\n', text_length(*rows));
    *line = lammps_without_comment((text_span){rows->begin, feed != NULL ? feed : rows->end});
    rows->begin = feed != NULL ? feed + 1 : rows->end;
    return line->begin < line->end;
}

static int is_number(text_span word, uint64_t types)
{
    double number;
    (void)types;
    return text_double(word, &number);
}

/* Numbers of images, which a program may write with a point. */
static int is_integer(text_span word, uint64_t types)
{
    double number;
    (void)types;
    return text_double(word, &number) && number == floor(number);
}

static int is_molecule(text_span word, uint64_t types)
{
    uint64_t number;
    (void)types;
    return text_u64(word, UINT64_MAX, &number);
}

/* Types are numbered from 1, and have no sign; or they are labels. */
static int is_type(text_span word, uint64_t types)
{
    uint64_t number;
    if (!is_number(word, types))
        return 1;
    return *word.begin != '+' && text_u64(word, types > 0 ? types : UINT32_MAX, &number) && number > 0;
}

/* Whether word `at` of each row is of a kind. */
static int all_are(text_span rows, int at, int (*is_kind)(text_span word, uint64_t types), uint64_t types)
{
    text_span line, word = {NULL, NULL};
    while (take_row(&rows, &line)) {
        for (int i = 0; i <= at; i++)
            if (!text_word(&line, &word))
                return 0;
        if (!is_kind(word, types))
            return 0;
    }
    return 1;
}

static int count_columns(text_span rows)
{
    text_span first;
    return take_row(&rows, &first) ? count_words(first) : 0;
}

/* Whether three whole numbers, those of images, follow so many columns. */
static int has_images(text_span rows, int columns)
{
    if (count_columns(rows) != columns + 3)
        return 0;
    for (int i = 0; i < 3; i++)
        if (!all_are(rows, columns + i, is_integer, 0))
            return 0;
    return 1;
}

/* Without a name the rows must do. Ids, molecules and types are whole numbers, but so may charges and diameters be:
 * they are told from types by the number of types. Where all may be types, they are. */
static const char *guess_style(text_span rows, uint64_t types)
{
    int columns = count_columns(rows);
    columns -= columns > 7 && has_images(rows, columns - 3) ? 3 : 0;
    const int has_molecule = all_are(rows, 1, is_molecule, types) && all_are(rows, 2, is_type, types);
    const int has_value = all_are(rows, 1, is_type, types) && all_are(rows, 2, is_number, types);
    const int is_bare = !has_molecule && (has_value || !all_are(rows, 2, is_molecule, types));
    switch (columns) {
    case 5: return "atomic";
    case 6: return is_bare ? "charge" : "molecular";
    case 7: return is_bare ? "sphere" : "full";
    default: return NULL;
    }
}

/* ---- Styles ------------------------------------------------------------------------------------------------- */

/* A style without the suffix of its accelerated form: bpm/sphere has none. */
static text_span bare_style(text_span name)
{
    static const char *const suffixes[] = {"/kk", "/kk/host", "/kk/device", "/omp", "/gpu", "/intel", "/opt"};
    for (size_t i = 0; i < sizeof suffixes / sizeof suffixes[0]; i++) {
        const size_t length = strlen(suffixes[i]);
        if (text_length(name) > length && memcmp(name.end - length, suffixes[i], length) == 0)
            return (text_span){name.begin, name.end - length};
    }
    return name;
}

static const data_style *find_style(text_span name)
{
    for (size_t i = 0; i < sizeof styles / sizeof styles[0]; i++)
        if (text_is(name, styles[i].name))
            return &styles[i];
    return NULL;
}

/* Density and mass are two names of one column: LAMMPS has either from the other. */
static int has_column(text_span columns, text_span column)
{
    text_span word;
    while (text_word(&columns, &word)) {
        const int is_mass = text_is(word, "density") || text_is(word, "mass");
        if ((text_length(word) == text_length(column) && memcmp(word.begin, column.begin, text_length(word)) == 0) ||
            (is_mass && (text_is(column, "density") || text_is(column, "mass"))))
            return 1;
    }
    return 0;
}

/* The columns of several styles: those of all, then each style's own, none twice. Returns 1, or 0 where a name is not
 * known, or the rows have others: LAMMPS before 2020 repeated columns. */
static int hybrid_columns(text_span names, text_span rows, char columns[LAMMPS_COLUMNS_SIZE])
{
    const data_style *const hybrid = find_style(span_of("hybrid"));
    text_span name, column;
    size_t length = (size_t)snprintf(columns, LAMMPS_COLUMNS_SIZE, "%s", hybrid->columns);
    while (text_word(&names, &name)) {
        const data_style *const s = find_style(bare_style(name));
        if (s == NULL || s == hybrid)
            return 0;
        for (text_span rest = span_of(s->columns); text_word(&rest, &column);) {
            if (has_column(span_of(columns), column))
                continue;
            length += (size_t)snprintf(columns + length, LAMMPS_COLUMNS_SIZE - length, " %.*s",
                                       (int)text_length(column), column.begin);
            if (length >= LAMMPS_COLUMNS_SIZE)
                return 0;
        }
    }
    const int count = count_words(span_of(columns));
    return count_columns(rows) == count || has_images(rows, count);
}

/* Adds the images, where the rows have them. */
static int end_columns(text_span rows, char columns[LAMMPS_COLUMNS_SIZE])
{
    const size_t length = strlen(columns);
    if (has_images(rows, count_words(span_of(columns))))
        snprintf(columns + length, LAMMPS_COLUMNS_SIZE - length, " ix iy iz");
    return 1;
}

/* style: the words behind the mark. */
static int find_columns(cgt_trajectory *t, text_span style, text_span rows, uint64_t types,
                        char columns[LAMMPS_COLUMNS_SIZE])
{
    char quote[TEXT_QUOTE_SIZE];
    text_span name;
    const int has_name = text_word(&style, &name);
    const data_style *s = has_name ? find_style(bare_style(name)) : NULL;
    if (s != NULL && strcmp(s->name, "hybrid") == 0) {
        if (hybrid_columns(style, rows, columns) && !text_is_blank(style))
            return end_columns(rows, columns);
        snprintf(columns, LAMMPS_COLUMNS_SIZE, "%s", s->columns);
        if (count_columns(rows) > count_words(span_of(columns)))
            trajectory_warn(t, DOUBT_OLD_COLUMNS, t->text.line,
                            "the columns of hybrid atoms behind x y z are not known and not read: name the sub-styles "
                            "in their order, \"Atoms # hybrid sphere bond\"");
        return 1;
    }
    if (s == NULL) {
        const char *const guess = guess_style(rows, types);
        if (guess == NULL && has_name)
            return trajectory_fail(t, t->text.line, "atoms of the style '%s' cannot be read", text_quote(name, quote));
        if (guess == NULL)
            return trajectory_fail(
                t, t->text.line,
                "the style of the atoms is not known here: write it behind the keyword, \"Atoms # full\"");
        s = find_style(span_of(guess));
        if (has_name)
            trajectory_warn(t, DOUBT_OLD_COLUMNS, t->text.line,
                            "the style '%s' of the atoms is not known: the columns are taken for %s",
                            text_quote(name, quote), s->columns);
        else
            trajectory_warn(t, DOUBT_OLD_COLUMNS, t->text.line,
                            "the file does not tell the style of its atoms: the columns are taken for %s", s->columns);
    }
    snprintf(columns, LAMMPS_COLUMNS_SIZE, "%s", s->columns);
    return end_columns(rows, columns);
}

int lammps_data_columns(cgt_trajectory *t, text_span keyword, uint64_t types, char columns[LAMMPS_COLUMNS_SIZE])
{
    const char *const mark = memchr(keyword.begin, '#', text_length(keyword));
    const text_span style = {mark != NULL ? mark + 1 : keyword.end, keyword.end};
    char *const rows = malloc(PEEKED + 1);
    if (rows == NULL)
        return trajectory_fail(t, t->text.line, "not enough memory for the first rows of atoms");
    text_span first;
    int status = peek_rows(t, rows);
    if (status > 0)
        status = trajectory_line_inside(t, &first, "before the atoms");
    if (status > 0)
        status = find_columns(t, style, span_of(rows), types, columns);
    if (status > 0)
        text_reader_back(&t->text);
    free(rows);
    return status;
}
