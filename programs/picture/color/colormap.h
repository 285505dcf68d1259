/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Maps numbers to colours. Measured values (speed, id) use a perceptually uniform map that is readable without
 * red-green vision; kinds (types) use colours that everyone can tell apart. All colours are sRGB, 0 to 1. */
#ifndef COLORMAP_H
#define COLORMAP_H

#include <stdint.h>

typedef struct colormap colormap;

/* Returns the map of that name, or NULL. */
const colormap *colormap_find(const char *name);

/* Returns the names, ended by NULL; the first is the default. */
const char *const *colormap_names(void);

/* The colour at x: 0 is the start of the map, 1 its end; clamped, NaN counts as 0. */
void colormap_at(const colormap *map, float x, float srgb[3]);

enum { COLORMAP_TYPES = 8 }; /* colours of kinds; kinds beyond repeat them */

/* The colour of a kind. Simulators count types from 1: 1 gets the first colour. */
void colormap_type(uint32_t type, float srgb[3]);

/* The colour of unknown values: a grey that no map above contains. */
void colormap_unknown(float srgb[3]);

#endif
