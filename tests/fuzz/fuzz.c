/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Code that the fuzz targets share. */
#include "fuzz/fuzz.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void fuzz_fail(const char *file, int line, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fprintf(stderr, "%s:%d: %s\n", file, line, text);
    abort();
}

void *fuzz_allocate(size_t bytes)
{
    void *const memory = malloc(bytes ? bytes : 1);
    FUZZ_CHECK(memory, "out of memory for %zu bytes", bytes);
    return memory;
}

fuzz_bytes fuzz_bytes_of(const uint8_t *data, size_t size) { return (fuzz_bytes){.at = data, .left = size}; }

uint8_t fuzz_byte(fuzz_bytes *b)
{
    if (!b->left)
        return 0;
    b->left--;
    return *b->at++;
}

uint32_t fuzz_below(fuzz_bytes *b, uint32_t count) { return fuzz_byte(b) % count; }

uint32_t fuzz_word(fuzz_bytes *b)
{
    uint32_t word = 0;
    for (int i = 0; i < 4; i++)
        word |= (uint32_t)fuzz_byte(b) << (8 * i);
    return word;
}

static const float names[] = {0.0f,      -0.0f,      INFINITY,        -INFINITY, NAN,       1.0f,       -1.0f,
                              0x1p-149f, -0x1p-149f, FLT_MIN,         -FLT_MIN,  FLT_MAX,   -FLT_MAX,   1e30f,
                              -1e30f,    1e-30f,     0x1p-126f,       0x1p-75f,  0x1p-50f,  -0x1p-50f,  0x1p50f,
                              -0x1p50f,  0x1p64f,    0x1p127f,        0x1p24f,   148376.0f, -2.2342e5f, 1.0f / 3.0f,
                              -0.1f,     1e5f,       1 + FLT_EPSILON, 0x1p-24f};

float fuzz_float(fuzz_bytes *b)
{
    const uint8_t kind = fuzz_byte(b);
    const float before = b->recent[kind % 8];
    float value;
    if (kind < 144) {
        value = ((float)kind - 72) / 4;
    } else if (kind < 192) {
        value = names[(kind - 144) % (sizeof names / sizeof names[0])];
    } else if (kind < 224) {
        const uint32_t bits = fuzz_word(b);
        memcpy(&value, &bits, sizeof value);
    } else {
        value = kind < 240 ? before : nextafterf(before, kind < 248 ? -INFINITY : INFINITY);
    }
    b->recent[b->recents++ % 8] = value;
    return value;
}

float fuzz_finite(fuzz_bytes *b)
{
    const float value = fuzz_float(b);
    return isfinite(value) ? value : 0;
}
