/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of LAMMPS data files: keywords of sections, and which columns atoms have (documentation of LAMMPS, read_data,
 * "Atoms section"). */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/lammps/lammps_parts.h"

#include <math.h>
#include <stdio.h>
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

static int count_words(text_span line, unsigned *points)
{
    text_span word;
    int count = 0;
    *points = 0;
    while (text_word(&line, &word)) {
        if (count < 32 && memchr(word.begin, '.', text_length(word)) != NULL)
            *points |= 1u << count;
        count++;
    }
    return count;
}

/* Without a name the first row must do: three more columns may be numbers of images. Ids, molecules and types are whole
 * numbers. */
static const char *guess_style(text_span first)
{
    unsigned points;
    const int words = count_words(lammps_without_comment(first), &points);
    switch (words) {
    case 5:
    case 8: return "atomic";
    case 6:
    case 9: return points & 4u ? "charge" : "molecular";
    case 7:
    case 10: return points & 4u ? "sphere" : "full";
    default: return NULL;
    }
}

/* Whether three whole numbers, those of images, follow what the style has. */
static int has_images(text_span first, const char *columns)
{
    text_span words = lammps_without_comment(first), word;
    unsigned points;
    int count = count_words((text_span){columns, columns + strlen(columns)}, &points);
    if (count_words(words, &points) != count + 3)
        return 0;
    for (double number; text_word(&words, &word); count--)
        if (count <= 0 && (!text_double(word, &number) || number != floor(number)))
            return 0;
    return 1;
}

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

int lammps_data_columns(cgt_trajectory *t, text_span keyword, text_span first, char columns[LAMMPS_COLUMNS_SIZE])
{
    const char *const mark = memchr(keyword.begin, '#', text_length(keyword));
    text_span rest = {mark != NULL ? mark + 1 : keyword.end, keyword.end}, name;
    char quote[TEXT_QUOTE_SIZE];
    const int has_name = text_word(&rest, &name);
    if (has_name)
        name = bare_style(name);
    const char *const guess = has_name ? NULL : guess_style(first);
    for (size_t i = 0; i < sizeof styles / sizeof styles[0]; i++) {
        const data_style *const s = &styles[i];
        if (has_name ? !text_is(name, s->name) : guess == NULL || strcmp(guess, s->name) != 0)
            continue;
        if (!has_name)
            trajectory_warn(t, DOUBT_OLD_COLUMNS, t->text.line,
                            "the file does not tell the style of its atoms: the columns are taken for %s", s->columns);
        const int images = strcmp(s->name, "hybrid") != 0 && has_images(first, s->columns);
        snprintf(columns, LAMMPS_COLUMNS_SIZE, "%s%s", s->columns, images ? " ix iy iz" : "");
        return 1;
    }
    if (has_name)
        return trajectory_fail(t, t->text.line, "atoms of the style '%s' cannot be read", text_quote(name, quote));
    return trajectory_fail(t, t->text.line,
                           "the style of the atoms is not known here: write it behind the keyword, \"Atoms # full\"");
}
