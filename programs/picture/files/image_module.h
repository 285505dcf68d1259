/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The interface of the module cgt-image, which encodes by OpenImageIO. It is a file of its own, loaded when it is
 * needed: OpenImageIO brings 200 shared libraries, whose loading takes longer than a hundred pictures. */
#ifndef IMAGE_MODULE_H
#define IMAGE_MODULE_H

#include <stddef.h>

#include "picture/files/image_write.h"

#define IMAGE_MODULE_FILE "cgt-image.so"
#define IMAGE_MODULE_SYMBOL "cgt_image_encode"

#ifdef __cplusplus
extern "C" {
#endif

/* Encodes a picture as EXR, JPEG or TIFF. *bytes gets memory that the caller frees by free. Returns 0, or -1 with the
 * reason. Safe in several threads at once. */
typedef int image_module_encode(image_format format, const image_content *image, unsigned char **bytes, size_t *size,
                                char *error, size_t error_size);

__attribute__((visibility("default"))) image_module_encode cgt_image_encode;

#ifdef __cplusplus
}
#endif

#endif
