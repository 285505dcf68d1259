/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt_srgb_encode, inline for the loops of pixels. */
#ifndef SRGB_H
#define SRGB_H

#include <cgt/picture.h>

static inline uint8_t srgb_encode(const cgt_srgb_tables *tables, float linear)
{
    if (!(linear > 0.0f)) /* or NaN */
        return tables->encode[0];
    if (linear >= 1.0f)
        return tables->encode[CGT_SRGB_STEPS];
    return tables->encode[(int)(linear * (float)CGT_SRGB_STEPS + 0.5f)];
}

#endif
