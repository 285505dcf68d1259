/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks of what the caller hands over. */
#ifndef PICTURE_OPTIONS_H
#define PICTURE_OPTIONS_H

#include <stddef.h>

#include <cgt/picture.h>

/* Copies options with the defaults in place of zeros, and directions of unit length; but for the light that stands for
 * none: see cgt_picture_set_default_light. Returns CGT_OK, or an error with a sentence. */
cgt_result cgt_picture_check_options(const cgt_picture_options *options, cgt_picture_options *checked, char *message,
                                     size_t size);

/* Whether the light is that of each camera; sets it. */
int cgt_picture_has_default_light(const cgt_picture_options *options);
void cgt_picture_set_default_light(cgt_picture_options *options, const cgt_camera *camera);

/* The same for an image. */
cgt_result cgt_picture_check_image(const cgt_image *image, const cgt_picture_options *options, cgt_image *checked,
                                   char *message, size_t size);

#endif
