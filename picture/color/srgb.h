/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt_srgb_encode, inline for the loops of pixels. */
#ifndef SRGB_H
#define SRGB_H

#include <cgt/picture.h>

/* The element of cgt_srgb_tables.encode, without branches; of NaN the first. */
static inline int srgb_step(float linear)
{
    const float above = linear > 0.0f ? linear : 0.0f;
    return (int)((above < 1.0f ? above : 1.0f) * (float)CGT_SRGB_STEPS + 0.5f);
}

static inline uint8_t srgb_encode(const cgt_srgb_tables *tables, float linear)
{
    return tables->encode[srgb_step(linear)];
}

#endif
