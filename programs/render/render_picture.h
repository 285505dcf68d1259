/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a committed scene to a picture: what lies between cgt-render's frames and the modules that shade. */
#ifndef RENDER_PICTURE_H
#define RENDER_PICTURE_H

#include "render/render_setup.h"

/* Chooses how pictures are made; camera, light, survey and r->job are set. Returns 0, or -1 with the message printed. */
int render_picture_setup(renderer *r);
void render_picture_close(renderer *r);

/* Traces and shades r->scene by r->job's camera and surface into r->job's rgb and pixels. Errors are the library's. */
cgt_result render_picture_trace(renderer *r, const cgt_trace_options *options);

/* The parts of that where tiles come from elsewhere: before the first tile for shade_tile, and after the last. */
void render_picture_begin_tiles(renderer *r);
void render_picture_overlay(renderer *r);

/* The rays of the last frame that hit something. */
uint64_t render_picture_hits(const renderer *r);

#endif
