/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of cgt-render with mirrors and glass: the frame's spheres become two geometries, opaque ones and glass, with
 * a material each, and Whitted's tracing (whitted/whitted.h) makes the picture. A file of triangles is of one
 * material. */
#ifndef RENDER_BOUNCE_H
#define RENDER_BOUNCE_H

#include "render/render_setup.h"

typedef struct render_bounce render_bounce;

/* Makes r->bounce, after colours, camera and r->drawing, which has the lights. Returns 0, or -1 with the message
 * printed. */
int render_bounce_create(renderer *r);

/* Hands the frame at hand to the library's scene, in place of render_scene_set. Returns 0, or -1 with the message
 * printed.
 */
int render_bounce_set(renderer *r, const frame_parts *parts);

/* Traces the committed scene to the pictures of r->drawing. Errors are the library's. */
cgt_result render_bounce_trace(renderer *r);

void render_bounce_release(render_bounce *bounce); /* NULL does nothing */

#endif
