/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What lies over a picture: title, time, colour bar or legend, axes. */
#ifndef OVERLAY_H
#define OVERLAY_H

#include <stdint.h>

#include "text/canvas.h"
#include "color/coloring.h"
#include "text/layout.h"
#include "text/scale_bar.h"
#include "text/text.h"

enum { OVERLAY_MOST_KINDS = 24 }; /* of a legend: a last line says how many more there are */

/* A line of a legend: a swatch and a name. */
typedef struct overlay_kind {
    float color[3]; /* linear */
    char name[64];
} overlay_kind;

/* A frame's numbers, and the directions of its camera: unit vectors to the right, up, and into the picture. */
typedef struct overlay_frame {
    uint64_t number;
    int64_t step;
    double time; /* NaN: unknown, {time} is "-" */
    float right[3], up[3], forward[3];
    double pixel;    /* world units a pixel, at the camera's target */
    double angstrom; /* world units an Angstrom; 0: unknown */
} overlay_frame;

typedef struct overlay {
    text_font *font;   /* NULL: there is no text */
    float size;        /* of the font, in pixels */
    float color[3];    /* linear, of text and ticks */
    const char *title; /* NULL: none */
    const char
        *time; /* with {time}, {step}, {frame}; "": "t = {time}", of frames without one "step {step}"; NULL: none */
    /* Numbers keep the width of the widest of the run, so that what is around them stands still: frames that have the
     * extremes, and the most letters of {time}. */
    overlay_frame extreme[4];
    uint32_t extremes;
    size_t time_letters;
    const char *bar; /* title of the colour bar, "" for none; NULL: no bar */
    const coloring *coloring;
    const char *legend;        /* title of the legend, "" for none; NULL: no legend */
    const overlay_kind *kinds; /* of the legend, from above */
    uint32_t kind_count;
    int axes;
    scale_bar scale;
    layout layout;
} overlay;

/* Finds places for all of it on pictures of a size: the layout. */
void cgt_overlay_place(overlay *o, uint32_t width, uint32_t height);

/* Draws it where it was placed. Returns 0, or -1: the length of a scale bar is no length for the picture. */
int cgt_overlay_draw(const overlay *o, const canvas *c, const overlay_frame *frame);

/* Replaces {time}, {time:.2f} with so many decimals, {step} and {frame}; text is cut to size. */
void cgt_overlay_format(const char *format, const overlay_frame *frame, char *text, size_t size);

/* Whether a text that was given asks for the time of a frame that has none. */
int cgt_overlay_lacks_time(const overlay *o, const overlay_frame *frame);

/* Ticks from min to max, min < max, rising: multiples of 1, 2 or 5 times a power of ten; with logarithmic, 0 < min,
 * such numbers themselves. An end that is one up to a float's rounding has a tick. Returns how many, at most `most`,
 * which is 2 to 30. */
uint32_t cgt_overlay_ticks(double min, double max, int logarithmic, double *ticks, uint32_t most);

#endif
