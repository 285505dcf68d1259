/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A finished picture that lines, discs, rectangles and text are drawn on. Coverage blends linear light. Depths
 * and primitives of linear pixels stay those of what lies below. */
#ifndef CANVAS_H
#define CANVAS_H

#include <stdint.h>

#include <cgt/picture.h>

typedef struct canvas {
    uint32_t width, height;
    cgt_image image;
} canvas;

/* Blends a pixel to a linear colour by its coverage, 0 to 1; nothing outside of the picture. */
void cgt_canvas_blend(const canvas *c, int32_t x, int32_t y, const float color[3], float coverage);

/* Places are in pixels from the upper left corner. A line has round ends; a disc is a line of no length. */
void cgt_canvas_line(const canvas *c, const float a[2], const float b[2], float width, const float color[3]);
void cgt_canvas_fill(const canvas *c, float x, float y, float width, float height, const float color[3]);

#endif
