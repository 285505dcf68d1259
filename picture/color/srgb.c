/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sRGB transfer curve: light adds up linearly, while screens and PNG files are encoded. */
#include "color/srgb.h"

#include <math.h>

static float clamp_unit(float x)
{
    if (!(x > 0.0f)) /* or NaN */
        return 0.0f;
    return x < 1.0f ? x : 1.0f;
}

float cgt_srgb_to_linear(float encoded)
{
    const float x = clamp_unit(encoded);
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

float cgt_srgb_from_linear(float linear)
{
    const float x = clamp_unit(linear);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
}

void cgt_srgb_tables_init(cgt_srgb_tables *tables)
{
    for (int i = 0; i <= CGT_SRGB_STEPS; i++)
        tables->encode[i] = (uint8_t)(cgt_srgb_from_linear((float)i / (float)CGT_SRGB_STEPS) * 255.0f + 0.5f);
    for (int i = 0; i < 256; i++)
        tables->decode[i] = cgt_srgb_to_linear((float)i / 255.0f);
}

uint8_t cgt_srgb_encode(const cgt_srgb_tables *tables, float linear) { return srgb_encode(tables, linear); }
