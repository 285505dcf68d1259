/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The colour of each sphere of a frame, as an index of 16 bits into a palette of linear colours: small enough to stay
 * in cache while tiles are shaded. */
#ifndef COLORING_H
#define COLORING_H

#include <stddef.h>
#include <stdint.h>

#include "colormap.h"
#include "trajectory.h"

typedef enum coloring_by { COLORING_AUTO = 0, COLORING_TYPE, COLORING_ID, COLORING_SPEED } coloring_by;

enum {
    COLORING_STEPS = 1024,             /* colours of a measured value */
    COLORING_UNKNOWN = COLORING_STEPS, /* the entry of what is not known */
    COLORING_ENTRIES
};

typedef struct coloring {
    coloring_by by;                     /* not AUTO */
    float min, max;                     /* values that get the map's first and last colour */
    float palette[COLORING_ENTRIES][3]; /* linear */
    uint16_t *index;                    /* per sphere; never NULL after coloring_init */
    size_t capacity;
} coloring;

/* Fills the palette. map: NULL for the first one; types have colours of their own. max may equal min. Returns 0, or
 * -1 where there is no memory. */
int coloring_init(coloring *c, coloring_by by, const colormap *map, float min, float max);
void coloring_free(coloring *c);

/* Sets index for the spheres of frame. speeds: as speed_next gives them; NULL unless by is COLORING_SPEED. Returns 0,
 * or -1 where there is no memory. */
int coloring_apply(coloring *c, const trajectory_frame *frame, const float *speeds);

#endif
