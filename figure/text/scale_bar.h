/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A bar that tells how long something is at the depth of the camera's target. */
#ifndef SCALE_BAR_H
#define SCALE_BAR_H

typedef struct scale_bar {
    int is_set;
    double length; /* in the unit, or the data's; 0: a round one that fits */
    char unit[16]; /* behind the number; "": nm or Angstrom where the data's unit is known, else none */
} scale_bar;

enum { SCALE_BAR_LABEL = 64 };

/* How much of the picture's width a bar takes at most. */
float cgt_scale_bar_share(const scale_bar *bar);

/* Finds the bar's length in pixels and its label.
 *   pixel      world units a pixel
 *   angstrom   world units an Angstrom; 0: unknown. Then a unit that is given is that of the data, and so is one that
 *              is none of those that are known
 *   most       pixels that there are for it
 * Returns 0, or -1: a length that was given is longer, or shorter than two pixels. */
int cgt_scale_bar_find(const scale_bar *bar, double pixel, double angstrom, float most, float *length,
                       char label[SCALE_BAR_LABEL]);

/* Whether a unit that was given is none of those that are known, in data whose lengths are: it is that of the data. */
int cgt_scale_bar_is_unknown(const scale_bar *bar, double angstrom);

/* The longest label that a bar may have. */
void cgt_scale_bar_longest(const scale_bar *bar, char label[SCALE_BAR_LABEL]);

#endif
