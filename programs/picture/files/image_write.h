/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Writes pictures to files: PNG by png_encode.h, EXR, JPEG and TIFF by OpenImageIO, which is loaded when the first of
 * them is asked for (image_module.h).
 *
 * A picture is encoded in memory and written by common/out_file.h: PATH is either the whole picture or the previous
 * file, and a full disk is an error, not half a file. Any number of threads may write, each with a writer of its own.
 * No two may write the same path at once. */
#ifndef IMAGE_WRITE_H
#define IMAGE_WRITE_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/picture.h>

#include "picture/files/png_encode.h"

typedef enum image_format { IMAGE_NONE = 0, IMAGE_PNG, IMAGE_EXR, IMAGE_JPEG, IMAGE_TIFF } image_format;

/* A picture. First rows are at the top. An EXR has channels R, G, B (float, linear light), Z (float) and id (unsigned);
 * of transparent pictures A, too, and then colours are premultiplied, as OpenEXR has them. */
typedef struct image_content {
    uint32_t width, height;
    const uint8_t *rgb;             /* 3 * width * height bytes, sRGB: for all formats but EXR */
    const uint8_t *alpha;           /* width * height bytes, of PNG: opacity; NULL: opaque, EXR, too */
    const cgt_linear_pixel *pixels; /* width * height: for EXR */
    int quality;                    /* of JPEG, 1 to 100; 0: 92 */
    const png_text *texts; /* of PNG and, as attributes of the same names, of EXR. JPEG and TIFF have fewer: Software,
                                  and Settings as their description */
    size_t text_count;
} image_content;

/* The format that a name's ending stands for, in any case of letters: .png, .exr, .jpg, .jpeg, .tif, .tiff. */
image_format image_format_of(const char *path);

/* Loads what a format needs. Without this call the first picture does. Returns 0, or -1 with a sentence: this build, or
 * this machine, cannot write the format. */
int image_format_load(image_format format, char *error, size_t error_size);

/* The buffers of one thread. Returns NULL where there is no memory. */
typedef struct image_writer image_writer;
image_writer *image_writer_create(void);
void image_writer_release(image_writer *writer);

/* Writes a picture in the format of path's ending. Returns 0, or -1 with a text that names the path. */
int image_write(image_writer *writer, const char *path, const image_content *image, char *error, size_t error_size);

/* Writes a single PNG, with a writer made for it. rgb: 3 * width * height bytes. Results as image_write. */
int image_write_png(const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, char *error,
                    size_t error_size);

#endif
