/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Writes pictures to files through OpenImageIO: the C interface of image_write.cpp (OpenImageIO needs C++).
 *
 * A picture is encoded in memory, written by common/out_file.h: PATH is either the whole picture or the
 * previous file, and a full disk is an error, not half a file. No function here is safe to call for the same path
 * from two threads at once. */
#ifndef IMAGE_WRITE_H
#define IMAGE_WRITE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A pixel of an EXR: channels R, G, B (float, linear light), Z (float) and id (unsigned). */
typedef struct image_pixel {
    float r, g, b;
    float z;     /* depth along the camera's axis; +infinity for the background */
    uint32_t id; /* primitive; 4294967295 for the background */
} image_pixel;

/* Writes an 8-bit PNG from rgb, 3 * width * height bytes, sRGB, first row at the top. Returns 0, or -1 with a text
 * that names the path. */
int image_write_png(const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, char *error,
                    size_t error_size);

/* Writes an EXR, zip-compressed, from width * height pixels, first row at the top. Results as image_write_png. */
int image_write_exr(const char *path, const image_pixel *pixels, uint32_t width, uint32_t height, char *error,
                    size_t error_size);

#ifdef __cplusplus
}
#endif

#endif
