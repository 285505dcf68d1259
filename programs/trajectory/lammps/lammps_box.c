/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The box of a LAMMPS dump: orthogonal, tilted, or three vectors of any direction. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/lammps/lammps_parts.h"

#include <math.h>
#include <string.h>

/* Reads one line of `count` finite numbers. */
static int read_numbers(cgt_trajectory *t, int count, double *values)
{
    text_span line, word;
    char quote[TEXT_QUOTE_SIZE];
    if (trajectory_line_inside(t, &line, "in the box bounds") < 0)
        return -1;
    for (int i = 0; i < count; i++) {
        if (!text_word(&line, &word))
            return trajectory_fail(t, t->text.line, "%d numbers where the box bounds need %d", i, count);
        if (!text_double(word, &values[i]) || !isfinite(values[i]))
            return trajectory_fail(t, t->text.line, "'%s' is not a bound of a box", text_quote(word, quote));
    }
    if (!text_is_blank(line))
        return trajectory_fail(t, t->text.line, "more than the %d numbers of the box bounds", count);
    return 1;
}

/* The file has the bounds of the parallelepiped; its corner and lengths follow from them and the tilt. */
static void box_from_bounds(lammps_box *box, double bounds[3][4])
{
    const double xy = bounds[0][2], xz = bounds[1][2], yz = bounds[2][2];
    const double below[3] = {fmin(fmin(0.0, xy), fmin(xz, xy + xz)), fmin(0.0, yz), 0.0};
    const double above[3] = {fmax(fmax(0.0, xy), fmax(xz, xy + xz)), fmax(0.0, yz), 0.0};
    const double tilt[3][3] = {{0, 0, 0}, {xy, 0, 0}, {xz, yz, 0}};
    memcpy(box->edge, tilt, sizeof tilt);
    for (int i = 0; i < 3; i++) {
        box->origin[i] = bounds[i][0] - below[i];
        box->edge[i][i] = (bounds[i][1] - above[i]) - box->origin[i];
    }
}

/* A general box: each line has a box vector and one coordinate of the corner. */
static void box_from_vectors(lammps_box *box, double lines[3][4])
{
    for (int i = 0; i < 3; i++) {
        memcpy(box->edge[i], lines[i], sizeof box->edge[i]);
        box->origin[i] = lines[i][3];
    }
}

/* The last three words tell of each edge's two ends: p periodic, f, s and m not. */
static void read_periodic(text_span flags, int8_t periodic[3])
{
    text_span word;
    memset(periodic, -1, 3);
    while (text_word(&flags, &word)) {
        if (text_length(word) == 2 && strchr("pfsm", word.begin[0]) != NULL && strchr("pfsm", word.begin[1]) != NULL) {
            periodic[0] = periodic[1];
            periodic[1] = periodic[2];
            periodic[2] = word.begin[0] == 'p' && word.begin[1] == 'p';
        }
    }
}

void lammps_make_box(lammps_box *box, int is_general, double lines[3][4])
{
    if (is_general)
        box_from_vectors(box, lines);
    else
        box_from_bounds(box, lines);
}

/* flags: what follows "ITEM: BOX BOUNDS", such as "pp pp ff" or "xy xz yz pp pp pp". */
int lammps_read_box(cgt_trajectory *t, text_span flags, lammps_box *box)
{
    text_span word;
    read_periodic(flags, box->periodic);
    text_word(&flags, &word);
    const int general = text_is(word, "abc");
    const int tilted = text_is(word, "xy");
    const int numbers = general ? 4 : tilted ? 3 : 2;
    double lines[3][4] = {{0}};
    for (int i = 0; i < 3; i++) {
        if (read_numbers(t, numbers, lines[i]) < 0)
            return -1;
        if (!general && lines[i][0] > lines[i][1])
            return trajectory_fail(t, t->text.line, "the lower bound of the box is above the upper one");
    }
    lammps_make_box(box, general, lines);
    return 1;
}
