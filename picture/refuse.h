/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What options and looks are checked by. */
#ifndef PICTURE_REFUSE_H
#define PICTURE_REFUSE_H

#include <stdarg.h>
#include <stdio.h>

#include <cgt/picture.h>

/* Writes a message; returns INVALID_ARGUMENT. */
__attribute__((format(printf, 3, 4))) static inline cgt_result picture_refuse(char *message, size_t size,
                                                                              const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(message, size, format, values);
    va_end(values);
    return CGT_ERROR_INVALID_ARGUMENT;
}

/* Whether a linear colour is within its range; NaN is not. */
static inline bool picture_is_color(const float v[3])
{
    bool within = true;
    for (int c = 0; c < 3; c++)
        within = within && v[c] >= 0.0f && v[c] <= 1e30f;
    return within;
}

#endif
