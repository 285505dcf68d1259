/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Van der Waals radii of the main group: M. Mantina, A. C. Chamberlin, R. Valero, C. J. Cramer, D. G. Truhlar,
 * "Consistent van der Waals Radii for the Whole Main Group", J. Phys. Chem. A 113 (2009), 5806-5812, table 12. */
#ifndef ELEMENT_RADII_H
#define ELEMENT_RADII_H

#include "data/molecule/element_symbols.h"

#define ELEMENT_DEFAULT_RADIUS 2.0f /* Angstrom: elements missing from the table, and names that are no elements */

/* The radius in Angstrom of an element by its number. */
static inline float element_radius(uint32_t number)
{
    /* in order of atomic numbers; 0: not in the paper */
    static const float radii[ELEMENTS] = {
        1.10f, 1.40f, 1.81f, 1.53f, 1.92f, 1.70f, 1.55f, 1.52f, 1.47f, 1.54f, 2.27f, 1.73f, 1.84f, 2.10f, 1.80f,
        1.80f, 1.75f, 1.88f, 2.75f, 2.31f, 0,     0,     0,     0,     0,     0,     0,     0,     0,     0,
        1.87f, 2.11f, 1.85f, 1.90f, 1.83f, 2.02f, 3.03f, 2.49f, 0,     0,     0,     0,     0,     0,     0,
        0,     0,     0,     1.93f, 2.17f, 2.06f, 2.06f, 1.98f, 2.16f, 3.43f, 2.68f, 0,     0,     0,     0,
        0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,
        0,     0,     0,     0,     0,     1.96f, 2.02f, 2.07f, 1.97f, 2.02f, 2.20f, 3.48f, 2.83f, 0,     0,
        0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,
        0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0,     0};
    const float radius = number > 0 && number <= ELEMENTS ? radii[number - 1] : 0.0f;
    return radius > 0.0f ? radius : ELEMENT_DEFAULT_RADIUS;
}

#endif
