/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is measured between points that a user picks: a distance, an angle, a dihedral, each step from a point to the
 * nearest image of the next. */
#ifndef MEASURE_H
#define MEASURE_H

#include <stdint.h>

#include "sequence/periodic_box.h"

enum { MEASURE_MOST = 4 }; /* points */

/* Of 2 points the distance; of 3 the angle at the second, 0 to 180 degrees; of 4 the dihedral about the middle two,
 * -180 to 180 degrees, positive where the last is turned clockwise from the first, seen from the second to the third
 * (IUPAC). Returns whether there is one: points that are not finite have none, and those that within their rounding
 * coincide or lie on one line have no angle or dihedral. value is set only where there is one. */
int cgt_measure(const periodic_box *box, const float (*points)[3], uint32_t count, double *value);

#endif
