/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt_srgb_encode for the loops of pixels: inline, by a table of all steps. */
#ifndef SRGB_H
#define SRGB_H

#include <cgt/color.h>

enum { SRGB_STEPS = 8192 }; /* of linear light; the curve is steep near black: fewer would skip codes */

typedef struct srgb_table {
    uint8_t code[SRGB_STEPS + 1];
} srgb_table;

void cgt_srgb_table_init(srgb_table *table);

/* The step of a linear value, without branches; of NaN the first. */
static inline int srgb_step(float linear)
{
    const float above = linear > 0.0f ? linear : 0.0f;
    return (int)((above < 1.0f ? above : 1.0f) * (float)SRGB_STEPS + 0.5f);
}

static inline uint8_t srgb_encode(const srgb_table *table, float linear) { return table->code[srgb_step(linear)]; }

#endif
