/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours of chemical elements. */
#ifndef ELEMENT_COLORS_H
#define ELEMENT_COLORS_H

#include <stdint.h>

/* The colour of an element by its atomic number, sRGB from 0 to 1; of 0 and of numbers beyond the table a light
 * pink. */
void element_color(uint32_t number, float srgb[3]);

#endif
