/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures as encoders of movies take them: luma for each pixel, chroma for each block of 2x2 (4:2:0), by the matrix of
 * ITU-R BT.709 in the range of studios, 16 to 235 and 16 to 240. */
#ifndef YUV_H
#define YUV_H

#include <stddef.h>
#include <stdint.h>

/* The edges of the planes: even, so that blocks are whole. */
static inline uint32_t yuv_edge(uint32_t edge) { return edge + (edge & 1u); }

/* Bytes of the three planes, one after the other. */
size_t yuv_bytes(uint32_t width, uint32_t height);

/* Converts 3 * width * height bytes of sRGB. Where an edge is odd its last pixels are repeated. */
void yuv_from_rgb(const uint8_t *rgb, uint32_t width, uint32_t height, uint8_t *yuv);

#endif
