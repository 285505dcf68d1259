/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Elements of a quad. */
#include "simd/spu_quad.h"

#include <stdio.h>
#include <string.h>

int spu_bits(spu_type type)
{
    static const uint8_t bits[] = {8, 8, 16, 16, 32, 32, 64, 64, 32, 64};
    return bits[type];
}

int spu_elements(spu_type type) { return 128 / spu_bits(type); }

bool spu_is_float(spu_type type) { return type == SPU_f32 || type == SPU_f64; }

uint64_t spu_get(const spu_quad *quad, spu_type type, int i)
{
    const int bytes = spu_bits(type) / 8;
    uint64_t value = 0;
    for (int k = 0; k < bytes; k++)
        value = value << 8 | quad->byte[i * bytes + k];
    return value;
}

void spu_set(spu_quad *quad, spu_type type, int i, uint64_t bits)
{
    const int bytes = spu_bits(type) / 8;
    for (int k = bytes - 1; k >= 0; k--, bits >>= 8)
        quad->byte[i * bytes + k] = (uint8_t)bits;
}

void spu_to_host(const spu_quad *quad, spu_type type, void *bytes)
{
    for (int i = 0; i < spu_elements(type); i++) {
        const uint64_t value = spu_get(quad, type, i);
        const uint8_t b = (uint8_t)value;
        const uint16_t h = (uint16_t)value;
        const uint32_t w = (uint32_t)value;
        switch (spu_bits(type)) {
        case 8: memcpy((uint8_t *)bytes + i, &b, 1); break;
        case 16: memcpy((uint8_t *)bytes + 2 * i, &h, 2); break;
        case 32: memcpy((uint8_t *)bytes + 4 * i, &w, 4); break;
        default: memcpy((uint8_t *)bytes + 8 * i, &value, 8); break;
        }
    }
}

spu_quad spu_from_host(const void *bytes, spu_type type)
{
    spu_quad quad;
    for (int i = 0; i < spu_elements(type); i++) {
        uint8_t b;
        uint16_t h;
        uint32_t w;
        uint64_t value;
        switch (spu_bits(type)) {
        case 8: value = (memcpy(&b, (const uint8_t *)bytes + i, 1), b); break;
        case 16: value = (memcpy(&h, (const uint8_t *)bytes + 2 * i, 2), h); break;
        case 32: value = (memcpy(&w, (const uint8_t *)bytes + 4 * i, 4), w); break;
        default: memcpy(&value, (const uint8_t *)bytes + 8 * i, 8); break;
        }
        spu_set(&quad, type, i, value);
    }
    return quad;
}

/* ---- text ---- */

const char *spu_text(const spu_quad *quad, spu_type type, int bytes, char text[48])
{
    const int width = spu_bits(type) / 8;
    char *at = text;
    for (int k = 0; k < bytes; k++)
        at += snprintf(at, 4, "%s%02x", k && k % width == 0 ? " " : "", quad->byte[k]);
    return text;
}
