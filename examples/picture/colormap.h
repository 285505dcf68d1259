/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers to colours. Measured values (speed, id) get a map that is even to the eye and readable without red-green
 * vision; kinds (types) get colours that are told apart by everyone. All colours are sRGB, 0 to 1. */
#ifndef COLORMAP_H
#define COLORMAP_H

#include <stdint.h>

typedef struct colormap colormap;

/* Returns the map of that name, or NULL. */
const colormap *colormap_find(const char *name);

/* Returns the names, ended by NULL; the first is the default. */
const char *const *colormap_names(void);

/* The colour at x: 0 the map's begin, 1 its end, clamped; NaN is taken as 0. */
void colormap_at(const colormap *map, float x, float srgb[3]);

enum { COLORMAP_TYPES = 8 }; /* colours of kinds; kinds beyond repeat them */

/* The colour of a kind. Simulators count types from 1: 1 gets the first colour. */
void colormap_type(uint32_t type, float srgb[3]);

/* The colour of what is not known: a grey that no map above holds. */
void colormap_unknown(float srgb[3]);

#endif
