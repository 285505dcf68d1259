/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The colour of each sphere or triangle of a frame, or of each vertex where the value varies over triangles: an index
 * of 16 bits into a palette of linear colours, small enough to stay in cache while tiles are shaded. */
#ifndef COLORING_H
#define COLORING_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <cgt/picture.h>

#include "color/categories.h"
#include "color/color_table.h"
#include "data/expression/expression.h"
#include "data/particles.h"
#include "survey/survey.h"

typedef enum coloring_by {
    COLORING_AUTO = 0,
    COLORING_TYPE,
    COLORING_ID,
    COLORING_SPEED,
    COLORING_HEIGHT,   /* along an axis, of a sphere's centre */
    COLORING_PLAIN,    /* one colour for all */
    COLORING_ELEMENT,  /* chemical */
    COLORING_VALUE,    /* of a formula over the file's columns */
    COLORING_CATEGORY, /* the words or whole numbers of such a formula */
    COLORING_RGB       /* of given_colors.h; the palette is the frame's */
} coloring_by;

enum {
    COLORING_STEPS = 1024,             /* colours of a measured value */
    COLORING_UNKNOWN = COLORING_STEPS, /* the entry of unknown values */
    COLORING_GIVEN,                    /* the first of kinds that have a colour of their own */
    COLORING_ENTRIES = COLORING_GIVEN + PARTICLE_KINDS
};

typedef struct coloring {
    coloring_by by;                     /* not AUTO */
    int axis;                           /* of HEIGHT: 0, 1 or 2; cgt_coloring_init sets 2 */
    double min, max;                    /* values that get the map's first and last colour */
    int logarithmic;                    /* of values: 1: equal steps of colour are equal ratios; min > 0 */
    const expression *formula;          /* of VALUE and CATEGORY; bound to the frame by the caller */
    categories *categories;             /* of CATEGORY; the caller's */
    float palette[COLORING_ENTRIES][3]; /* linear */
    int64_t given[PARTICLE_KINDS];      /* kinds that have a colour of their own: other kinds share entries */
    uint32_t given_count;
    uint16_t *index; /* per sphere, triangle or vertex; never NULL after cgt_coloring_init */
    int per_vertex;  /* set by cgt_coloring_apply: index is per vertex, to be interpolated */
    size_t capacity;
} coloring;

/* Whether colours stand for kinds, which a legend names, and not for amounts. */
static inline int coloring_has_kinds(coloring_by by)
{
    return by == COLORING_TYPE || by == COLORING_ELEMENT || by == COLORING_CATEGORY;
}

/* Fills the palette. map: NULL for the first one; types have colours of their own. max may equal min. Returns 0, or
 * -1 where there is no memory. */
int cgt_coloring_init(coloring *c, coloring_by by, const cgt_colormap *map, double min, double max);

/* Puts a map of the user's own in place of the map, where colours stand for amounts. */
void cgt_coloring_set_table(coloring *c, const color_table *table);

/* Makes a colouring of PLAIN: the one colour, in sRGB from 0 to 1. */
int cgt_coloring_init_plain(coloring *c, const float srgb[3]);
void cgt_coloring_free(coloring *c);

/* The palette entry of a type, of an element by its atomic number, or of a category, by what the colours have. */
uint16_t cgt_coloring_entry_of_kind(const coloring *c, int64_t kind);

/* Gives such a kind, of PARTICLE_KINDS at most, a colour of its own, in sRGB from 0 to 1. It has another entry then:
 * before cgt_coloring_apply. */
void cgt_coloring_set_kind(coloring *c, int64_t kind, const float srgb[3]);

/* Sets index and per_vertex for a frame: speed and height of triangles are those of their vertices. speeds: those of
 * cgt_speed_next; NULL unless by is COLORING_SPEED. Returns 0, or -1 where there is no memory. */
int cgt_coloring_apply(coloring *c, const cgt_trajectory_frame *frame, const float *speeds);

/* ---- Where nobody says what the colours show (cgt_coloring_choose.c) ---- */

/* Whether spheres jump by most of the extent in one frame, as through the boundary of a box that the file does not
 * tell. */
int cgt_coloring_has_jumps(const survey *s);

/* What the colours of a surveyed run show. */
coloring_by cgt_coloring_choose(const survey *s);

/* The values at the ends of the map; they stay as they are where the survey knows of none. axis: that points up.
 * logarithmic: above 0, where that can be. */
void cgt_coloring_choose_range(const survey *s, coloring_by by, int axis, int logarithmic, const double origin[3],
                               double *min, double *max);

/* Whether the colours are those of values. */
static inline int cgt_coloring_has_range(const coloring *c)
{
    return c->by != COLORING_PLAIN && c->by != COLORING_RGB && !coloring_has_kinds(c->by);
}

/* Widens a range to one about 0. */
static inline void cgt_coloring_make_symmetric(double *min, double *max)
{
    const double most = fmax(fabs(*min), fabs(*max));
    *min = -most;
    *max = most;
}

#endif
