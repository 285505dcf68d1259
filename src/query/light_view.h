/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a light sees of points, cut into cells along a Hilbert curve: directions from a point, as an octahedron unfolds
 * onto a square, or offsets across a direction. It decides the order in which points are traced, never what they
 * meet. */
#ifndef CGT_LIGHT_VIEW_H
#define CGT_LIGHT_VIEW_H

#include <stdbool.h>
#include <stdint.h>

#define CGT_VIEW_BITS 6u
#define CGT_VIEW_EDGE                                                                                                  \
    (1u << CGT_VIEW_BITS) /* cells along each axis: a group of rays of 100,000 points then lies in about one */
#define CGT_VIEW_CELLS (CGT_VIEW_EDGE * CGT_VIEW_EDGE)

/* The keys of points: their cells, or these. */
enum { CGT_VIEW_OFF = CGT_VIEW_CELLS, CGT_VIEW_INVALID, CGT_VIEW_KEYS };

typedef struct cgt_light_view {
    bool is_point;
    uint32_t main;   /* axis along which the points lie, seen from the light; the others follow in turn */
    float sign;      /* of their way along it */
    float origin[3]; /* the light, or any point */
    float slope[2];  /* of a direction */
    float low[2];    /* bounds of what is cut into cells; what lies beyond belongs to the cells at the edge */
    float scale[2];  /* cells for each unit; 0: all is one cell */
} cgt_light_view;

#endif
