/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-render on an emulated Cell: the SPEs find which sphere each ray hits, the PPE t and normal of it, and the usual
 * shading makes the picture, byte for byte the one that the library's own frames give. */
#ifndef RENDER_CELL_H
#define RENDER_CELL_H

#include <stdio.h>

#include "picture/shade.h"
#include "render/render_options.h"
#include "render/render_report.h"
#include "trajectory/trajectory.h"

typedef struct render_cell render_cell;

/* Makes the Cell of --cell, and reads the SPEs' program. Returns NULL with the message printed. */
render_cell *render_cell_create(const render_options *options);

/* Traces and shades a frame of the job, which is begun (shade_begin), and sets what the record says of spheres, hits and
 * tracing: building the grid is the SPEs' work, a part of it. input: the file's name, for messages. Returns 0, -1 with the
 * message printed, 1 where job->stop stopped the frame. */
int render_cell_frame(render_cell *cell, const trajectory_frame *frame, shade_job *job, const char *input,
                      frame_record *record);

/* Prints what the frames took: cycles, waits, DMA, messages, doubts. NULL prints nothing. */
void render_cell_print(const render_cell *cell, FILE *to);

void render_cell_release(render_cell *cell); /* NULL does nothing */

#endif
