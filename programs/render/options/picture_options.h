/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options of cgt-render that say how a picture looks: style, light, drawing. They are a child of its parser. */
#ifndef PICTURE_OPTIONS_H
#define PICTURE_OPTIONS_H

#include <argp.h>
#include <stdint.h>

#include <cgt/cgt.h>

#include "picture/draw/draw.h"

typedef enum picture_style { STYLE_SOFT = 0, STYLE_PAPER, STYLE_PLAIN } picture_style;

typedef struct picture_lamp {
    cgt_light_kind kind;
    float place[3]; /* or the direction towards the light, not normalised */
    float strength;
    float color[3]; /* linear */
} picture_lamp;

/* What was not given has a negative number, or NULL, until picture_options_finish puts in that of the style. */
typedef struct picture_options {
    picture_style style;
    float ambient, ambient_radius; /* rays; world units, 0: any distance. -1: a share of the scene's size */
    float shadows;                 /* 0 or 1: of all lights */
    float light_size, light_samples;
    float key, sky, head; /* strengths of the first light, of the sky, of the light from the eye */
    int own_light;        /* one of those three was given */
    uint32_t lamp_count;
    picture_lamp lamps[DRAW_MAX_LIGHTS - 1]; /* beside the first light */
    float cue, outline;
    uint8_t background[3]; /* sRGB */
    int has_background;
    int transparent;
    int ortho;
    const char *title, *time; /* texts; NULL: none; time "": by what the file has */
    const char *bar;          /* title of the colour bar; NULL: no bar */
    const char *legend;       /* title of the legend of types or elements; NULL: none */
    int axes;
    int no_metadata;  /* pictures do not say how they were made */
    const char *font; /* file; NULL: found */
    float text_size;  /* share of the picture's height */
} picture_options;

/* Sets all to "not given". */
void picture_options_init(picture_options *options);

/* The parser; its input is a picture_options. */
extern const struct argp picture_options_parser;

/* Puts the style's values where none were given. */
void picture_options_finish(picture_options *options);

/* Whether anything lies over the picture. */
int picture_options_have_overlay(const picture_options *options);

/* Whether the settings need more than shading in the camera's tiles. */
int picture_options_need_drawing(const picture_options *options);

#endif
