/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours of libcgt-picture: maps for values, colours of types and elements, and the sRGB curve between the codes of
 * screens and files, and light, which adds up linearly. Calls here need no object, and any thread may make them. */
#ifndef CGT_COLOR_H
#define CGT_COLOR_H

#include <stdint.h>

#include <cgt/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the names of the colour maps, ended by NULL: readable without red-green vision, and perceptually uniform but
 * for coolwarm. The first, "viridis", is the default. coolwarm, vik and berlin diverge from a neutral middle, the last
 * from a dark one, for values about 0; romaO and vikO end as they begin, for phases and angles. */
CGT_API const char *const *cgt_get_colormap_names(void);

typedef struct cgt_colormap cgt_colormap;

/* Returns the map of a name, NULL: the first; or NULL if there is none of that name. A name with "_r" behind it is the
 * map from its end to its start. It is valid forever. */
CGT_API const cgt_colormap *cgt_find_colormap(const char *name);

/* Gets the colour of a map at x, from 0, its start, to 1, its end; others are clamped, NaN counts as 0.
 *   srgb   gets sRGB, 0 to 1, as in the next three */
CGT_API void cgt_get_map_color(const cgt_colormap *map, float x, float srgb[3]);

/* Gets the colour of a kind, from 1, such as LAMMPS' types: 8 colours that everyone can tell apart and 8 more, again
 * and again. */
CGT_API void cgt_get_type_color(uint32_t type, float srgb[3]);

/* Gets the colour of an element by its atomic number, Jmol's; of 0 and of numbers beyond 109 a light pink. */
CGT_API void cgt_get_element_color(uint32_t number, float srgb[3]);

/* Gets the colour of unknown values: a grey that no map contains. */
CGT_API void cgt_get_unknown_color(float srgb[3]);

/* The sRGB transfer curve (IEC 61966-2-1), both ways; values outside 0 to 1 are clamped, NaN becomes 0. */
CGT_API float cgt_srgb_to_linear(float encoded);
CGT_API float cgt_srgb_from_linear(float linear);

/* The same for the codes of pixels, by tables. Encoding is never more than one code off the curve, and gives back what
 * decoding has made of a code. */
CGT_API uint8_t cgt_srgb_encode(float linear);
CGT_API float cgt_srgb_decode(uint8_t code);

#ifdef __cplusplus
}
#endif

#endif
