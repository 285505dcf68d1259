/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours that the data have: of each particle three columns, linear. Their names have blanks, so that no column of a
 * file is one. */
#ifndef GIVEN_COLORS_H
#define GIVEN_COLORS_H

#include "color/coloring.h"

#define RGB_COLUMNS                                                                                                    \
    {                                                                                                                  \
        "rgb r", "rgb g", "rgb b"                                                                                      \
    }

int cgt_coloring_has_given(const cgt_trajectory_frame *frame);

/* Makes palette and index of a colouring show them; it has room for as many. Where there are more different ones than
 * the palette holds, near ones share an entry. All are unknown where a frame lacks the columns. */
void cgt_coloring_give(coloring *c, const cgt_trajectory_frame *frame);

#endif
