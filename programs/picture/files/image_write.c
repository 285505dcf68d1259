/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Writes pictures to files; see image_write.h. */
#define _POSIX_C_SOURCE 200809L
#include "picture/files/image_write.h"

#include <errno.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "common/out_file.h"
#include "common/out_path.h"
#include "picture/files/image_module.h"
#include "system/system.h"

struct image_writer {
    png_encoder *png;
};

image_format image_format_of(const char *path)
{
    static const struct {
        const char *ending;
        image_format format;
    } rows[] = {{".png", IMAGE_PNG},   {".exr", IMAGE_EXR},  {".jpg", IMAGE_JPEG},
                {".jpeg", IMAGE_JPEG}, {".tif", IMAGE_TIFF}, {".tiff", IMAGE_TIFF}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (out_path_ends_in(path, rows[i].ending))
            return rows[i].format;
    return IMAGE_NONE;
}

/* ---- The module --------------------------------------------------------------------------------------------- */

static pthread_once_t module_once = PTHREAD_ONCE_INIT;
static image_module_encode *module_encode; /* NULL: it could not be loaded */
static char module_error[400];

/* Programs carry the module's folders as their run path, in the build tree and where they are installed. The handle
 * stays open: libraries that start threads must not be unloaded. */
static void load_module(void)
{
    void *const symbol = system_load(IMAGE_MODULE_FILE, IMAGE_MODULE_SYMBOL, module_error, sizeof module_error);
    if (symbol)
        memcpy(&module_encode, &symbol, sizeof module_encode);
}

int image_format_load(image_format format, char *error, size_t error_size)
{
    if (format == IMAGE_PNG || format == IMAGE_NONE)
        return 0;
    pthread_once(&module_once, load_module);
    if (module_encode)
        return 0;
    snprintf(error, error_size, "EXR, JPEG and TIFF need OpenImageIO, and the module for it cannot be loaded: %s",
             module_error);
    return -1;
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

/* Writes all bytes to a file that exists. Returns 0 or an error number. */
static int write_bytes(const char *path, const uint8_t *bytes, size_t size)
{
    const int file = open(path, O_WRONLY | O_TRUNC | O_BINARY | O_CLOEXEC);
    int wrong = file < 0 ? errno : 0;
    while (!wrong && size > 0) {
        const ssize_t written = write(file, bytes, size);
        if (written > 0) {
            bytes += written;
            size -= (size_t)written;
        } else if (written == 0 || errno != EINTR) {
            wrong = written == 0 ? EIO : errno;
        }
    }
    if (file >= 0 && close(file) != 0 && !wrong)
        wrong = errno;
    return wrong;
}

/* Makes the bytes the file's: all of them, or the file stays as it was. */
static int replace_file(const char *path, const uint8_t *bytes, size_t size, char *error, size_t error_size)
{
    out_file file;
    const char *const temporary = out_file_begin(&file, path, error, error_size);
    if (!temporary)
        return -1;
    const int wrong = write_bytes(temporary, bytes, size);
    if (wrong)
        snprintf(error, error_size, "%s: cannot write: %s", path, strerror(wrong));
    return out_file_end(&file, !wrong, error, error_size) || wrong ? -1 : 0;
}

image_writer *image_writer_create(void)
{
    image_writer *writer = calloc(1, sizeof *writer);
    if (!writer)
        return NULL;
    writer->png = png_encoder_create();
    if (writer->png)
        return writer;
    free(writer);
    return NULL;
}

void image_writer_release(image_writer *writer)
{
    if (writer)
        png_encoder_release(writer->png);
    free(writer);
}

/* Colours and opacity side by side; NULL where there is no memory. */
static uint8_t *interleave(const image_content *image)
{
    const size_t pixels = (size_t)image->width * image->height;
    uint8_t *rgba = pixels <= SIZE_MAX / 4 ? malloc(pixels * 4) : NULL;
    for (size_t i = 0; rgba && i < pixels; i++) {
        memcpy(rgba + 4 * i, image->rgb + 3 * i, 3);
        rgba[4 * i + 3] = image->alpha[i];
    }
    return rgba;
}

static int write_png(image_writer *writer, const char *path, const image_content *image, char *error, size_t error_size)
{
    uint8_t *rgba = image->alpha ? interleave(image) : NULL;
    const png_picture picture = {image->width, image->height,    rgba ? 4 : 3, rgba ? rgba : image->rgb,
                                 image->texts, image->text_count};
    const char *wrong = "out of memory";
    size_t size = 0;
    const uint8_t *const bytes = image->alpha && !rgba ? NULL : png_encode(writer->png, &picture, &size, &wrong);
    free(rgba);
    if (bytes)
        return replace_file(path, bytes, size, error, error_size);
    snprintf(error, error_size, "%s: cannot write: %s", path, wrong);
    return -1;
}

static int write_by_module(image_format format, const char *path, const image_content *image, char *error,
                           size_t error_size)
{
    char reason[512] = "";
    unsigned char *bytes = NULL;
    size_t size = 0;
    if (image_format_load(format, reason, sizeof reason) ||
        module_encode(format, image, &bytes, &size, reason, sizeof reason)) {
        snprintf(error, error_size, "%s: cannot write: %s", path, reason);
        return -1;
    }
    const int result = replace_file(path, bytes, size, error, error_size);
    free(bytes);
    return result;
}

int image_write(image_writer *writer, const char *path, const image_content *image, char *error, size_t error_size)
{
    const image_format format = image_format_of(path);
    if (format == IMAGE_NONE) {
        snprintf(error, error_size, "%s: the ending is that of no picture", path);
        return -1;
    }
    return format == IMAGE_PNG ? write_png(writer, path, image, error, error_size)
                               : write_by_module(format, path, image, error, error_size);
}

int image_write_png(const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, char *error,
                    size_t error_size)
{
    const image_content image = {.width = width, .height = height, .rgb = rgb};
    image_writer *writer = image_writer_create();
    if (!writer) {
        snprintf(error, error_size, "%s: out of memory for the picture", path);
        return -1;
    }
    const int result = write_png(writer, path, &image, error, error_size);
    image_writer_release(writer);
    return result;
}
