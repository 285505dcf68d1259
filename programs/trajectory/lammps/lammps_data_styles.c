/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which columns atoms have in LAMMPS data files (documentation of LAMMPS, read_data, "Atoms section"). */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/lammps/lammps_parts.h"

#include <string.h>

text_span lammps_without_comment(text_span line)
{
    const char *const mark = memchr(line.begin, '#', text_length(line));
    line.end = mark != NULL ? mark : line.end;
    text_trim(&line);
    return line;
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

const char *lammps_data_columns(trajectory *t, text_span keyword, text_span first)
{
    const char *const mark = memchr(keyword.begin, '#', text_length(keyword));
    text_span rest = {mark != NULL ? mark + 1 : keyword.end, keyword.end}, name;
    const int has_name = text_word(&rest, &name);
    const char *const guess = has_name ? NULL : guess_style(first);
    for (size_t i = 0; i < sizeof styles / sizeof styles[0]; i++) {
        if (has_name ? text_is(name, styles[i].name) : guess != NULL && strcmp(guess, styles[i].name) == 0) {
            if (!has_name)
                trajectory_warn(t, DOUBT_OLD_COLUMNS, t->text.line,
                                "the file does not tell the style of its atoms: the columns are taken for %s",
                                styles[i].columns);
            return styles[i].columns;
        }
    }
    return NULL;
}
