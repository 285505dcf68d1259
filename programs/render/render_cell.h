/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-render on an emulated Cell: the SPEs find which sphere each ray hits, the PPE t and normal of it, and the usual
 * shading makes the picture, byte for byte the one that the library's own frames give. */
#ifndef RENDER_CELL_H
#define RENDER_CELL_H

#include "render/render_setup.h"

typedef struct render_cell render_cell;

/* Makes the Cell of --cell, and reads the SPEs' program. Sets r->cell. Returns 0, or -1 with the message printed. */
int render_cell_create(renderer *r);

/* Traces and shades a frame of r->camera: building the grid is the SPEs' work, a part
 * of it. Returns 0, -1 with the message printed, 1 where a signal stopped the frame. */
int render_cell_frame(renderer *r, frame_record *record);

/* Prints what the frames took: cycles, waits, DMA, messages, doubts. NULL prints nothing. */
void render_cell_print(const render_cell *cell, FILE *to);

void render_cell_release(render_cell *cell); /* NULL does nothing */

#endif
