/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a committed scene to a picture: what lies between cgt-render's frames and the modules that shade. */
#ifndef RENDER_PICTURE_H
#define RENDER_PICTURE_H

#include "render/render_setup.h"

/* Chooses how pictures are made; camera, light and survey are set. Returns 0, or -1 with the message printed. */
int render_picture_setup(renderer *r);
void render_picture_close(renderer *r);

/* Draws r->scene by r->camera to the pictures of r->drawing. Errors are the library's. */
cgt_result render_picture_trace(renderer *r, const cgt_trace_options *options);

/* The parts of that before drawing, projection and surfaces, and after it. */
void render_picture_begin(renderer *r);
void render_picture_overlay(renderer *r);

#endif
