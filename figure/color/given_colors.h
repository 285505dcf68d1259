/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours that the data have, a column rgb. */
#ifndef GIVEN_COLORS_H
#define GIVEN_COLORS_H

#include "color/coloring.h"

/* Makes a colouring's palette and index show `count` linear colours, in place of what it was applied to; it has room for
 * as many. Where there are more different ones than the palette holds, near ones share an entry. */
void cgt_coloring_give(coloring *c, const float *color, uint32_t count);

#endif
