/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Replaces image_write.cpp in a cgt-render without the image library: no picture can be written. */
#include "picture/image_write.h"

#include <stdio.h>

int image_write_png(const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, char *error,
                    size_t error_size)
{
    (void)rgb;
    snprintf(error, error_size, "%s: no image library for %u x %u pixels", path, width, height);
    return -1;
}

int image_write_exr(const char *path, const image_pixel *pixels, uint32_t width, uint32_t height, char *error,
                    size_t error_size)
{
    (void)pixels;
    return image_write_png(path, NULL, width, height, error, error_size);
}
