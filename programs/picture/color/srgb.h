/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sRGB transfer curve (IEC 61966-2-1), both ways. Light adds up linearly, while screens and PNG files are encoded:
 * shading and averaging use linear values, palettes and 8-bit pixels are sRGB. */
#ifndef SRGB_H
#define SRGB_H

#include <stdint.h>

/* The curve itself, for 0 to 1; values outside are clamped, NaN becomes 0. */
float srgb_to_linear(float encoded);
float srgb_from_linear(float linear);

enum { SRGB_STEPS = 8192 }; /* the curve is steep near black: fewer would skip codes */

/* Tables for pixels: made once, then read by any thread. */
typedef struct srgb_tables {
    uint8_t encode[SRGB_STEPS + 1]; /* of i / SRGB_STEPS, linear: never more than one code off the curve */
    float decode[256];              /* of code i, exact */
} srgb_tables;

void srgb_tables_init(srgb_tables *tables);

/* Returns the code of a linear value; clamped, NaN becomes 0. */
static inline uint8_t srgb_encode(const srgb_tables *tables, float linear)
{
    if (!(linear > 0.0f))
        return tables->encode[0];
    if (linear >= 1.0f)
        return tables->encode[SRGB_STEPS];
    return tables->encode[(int)(linear * (float)SRGB_STEPS + 0.5f)];
}

#endif
