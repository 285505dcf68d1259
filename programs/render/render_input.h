/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cgt-render and cgt-view open alike, by their options. */
#ifndef RENDER_INPUT_H
#define RENDER_INPUT_H

#include "common/stop_flag.h"
#include "render/options/render_options.h"

/* Makes the library's context. Returns 0, or -1 with the message printed. */
int render_create_context(const render_options *options, cgt_context **context);

/* Puts the files in their order, and completes how they are read. stop: not 0 ends the waiting for more of a run. */
void render_choose_reading(render_options *options, const cgt_context *context, int reads_twice, const stop_flag *stop);

/* Reads the first frame of the mesh that stands still, less an origin; it stays as long as its file, which the caller
 * closes in any case, is open. Returns 0, or -1 with the message printed. */
int render_read_mesh(const render_options *options, const double origin[3], cgt_trajectory **file,
                     cgt_trajectory_frame *mesh);

/* Refuses options of reading that do not fit what the file has. Returns 0, or -1 with the message printed. */
int render_check_reading(const render_options *options, cgt_trajectory_kind kind);

#endif
