/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where texts lie on a picture, and what they leave to the scene. A function of the picture's size, the font and the
 * texts, so that the camera can be chosen after it. Texts are inside of the picture and do not overlap each other. What
 * has no place wraps, shrinks to 0.7 of its size, is cut short, or is left out, in this order. */
#ifndef LAYOUT_H
#define LAYOUT_H

#include <stddef.h>
#include <stdint.h>

#include "text/text.h"

/* In pixels from the upper left corner; empty: x0 is x1. */
typedef struct layout_rect {
    float x0, y0, x1, y1;
} layout_rect;

typedef enum layout_item {
    LAYOUT_TITLE = 0,
    LAYOUT_TIME,
    LAYOUT_SCALE,
    LAYOUT_BAR,
    LAYOUT_LEGEND,
    LAYOUT_AXES,
    LAYOUT_ITEMS
} layout_item;

enum { LAYOUT_LINES = 3, LAYOUT_LINE_SIZE = 256 };

/* A text in lines. */
typedef struct layout_text {
    uint32_t count;
    float size; /* of the font */
    float width;
    int is_cut;
    char line[LAYOUT_LINES][LAYOUT_LINE_SIZE];
} layout_text;

/* What there is to place. */
typedef struct layout_input {
    uint32_t width, height;   /* of the picture */
    text_font *font;          /* NULL: texts have no width */
    float size;               /* of the font, where there is room */
    const char *title;        /* NULL: none */
    float time_width;         /* 0: there is no time */
    float scale_width;        /* of a scale bar at most; 0: there is none */
    const char *bar;          /* title of the colour bar; NULL: none */
    float tick_width;         /* of the longest number at it */
    const char *legend;       /* title; NULL: there is no legend */
    const char *const *names; /* of its lines */
    uint32_t name_count;      /* those that may be shown, */
    uint32_t kind_count;      /* of so many */
    int axes;
} layout_input;

typedef struct layout {
    layout_rect rect[LAYOUT_ITEMS];
    float size[LAYOUT_ITEMS]; /* of fonts */
    uint32_t left_out, cut;   /* a bit for each item: it has no place; not all of its texts are there */
    layout_text title, bar_title, legend_title;
    layout_rect map; /* the bar without texts */
    uint32_t lines;  /* of the legend, without "and N more" */
    uint32_t rows;   /* a column */
    float column;    /* from one to the next */
    float name_width;
    /* Rectangles that are free, of which the camera takes the one in which the scene is largest. */
    layout_rect room[2];
    uint32_t rooms, chosen;
} layout;

/* In units of the font's size: the distance of texts from the edges; from line to line; of a legend's names from its
 * left, and from line to line; a colour bar's width, and its numbers' distance from it; half of what axes take. */
static const float layout_margin = 0.9f, layout_step = 1.25f, layout_indent = 1.35f, layout_row = 1.45f;
static const float layout_bar = 0.9f, layout_tick = 0.5f, layout_axes = 3.4f;

void cgt_layout_make(const layout_input *in, layout *l);

/* Copies a text, cut to a width with dots at its end where it is wider. Returns whether it was cut. */
int cgt_layout_cut(const text_font *font, const char *text, float width, char *to, size_t size);

#endif
