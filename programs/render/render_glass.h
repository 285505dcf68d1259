/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A transparent mesh among spheres: a frame is drawn without it, then with it, and the two are mixed, so that what lies
 * behind the mesh's nearest side shines through. The mesh casts no shadows on what is seen through it. */
#ifndef RENDER_GLASS_H
#define RENDER_GLASS_H

#include "render/render_setup.h"

/* Makes r->behind where the options ask for it; the caller frees it. Returns 0, or -1 where there is no memory. */
int render_glass_setup(renderer *r);

/* Draws r->scene as draw_frame does, through r->drawing, whose surfaces and pictures are set. */
cgt_result render_glass_draw(renderer *r, const cgt_trace_options *options);

#endif
