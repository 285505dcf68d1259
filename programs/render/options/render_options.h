/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-render. */
#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "picture/color/coloring.h"
#include "playback/camera_keys.h"
#include "playback/frame_source.h"
#include "common/out_path.h"
#include "render/options/output_options.h"
#include "render/options/particle_options.h"
#include "render/options/picture_options.h"
#include "render/options/bounce_options.h"
#include "render/options/render_cell_options.h"

enum { RENDER_MAX_OUTPUTS = 4, RENDER_MAX_EDGE = 65536 };

/* Limit of pixels in a picture: with buffers of up to 28 bytes each, about 6 GB. */
#define RENDER_MAX_PIXELS ((uint64_t)1 << 28)

typedef struct render_options {
    const char *input; /* the first */
    const char **inputs;
    size_t input_count;
    trajectory_options reading; /* fps 0 and clip NULL: not given */
    frame_range range;

    out_path outputs[RENDER_MAX_OUTPUTS]; /* of a render_output_kind each */
    uint32_t output_count;                /* 0 with --no-images */
    output_options output;
    const char *contact_sheet; /* NULL: none */
    uint32_t sheet_columns, sheet_rows;
    const char *log_file; /* NULL: none */

    uint32_t width, height;
    uint32_t samples; /* 1, 2, 4: edge of the block of rays per pixel */
    int has_camera;
    cgt_camera camera;         /* where has_camera */
    float view[3], up[3], fov; /* of the automatic camera; all zero: chosen by render_options_axes */
    camera_keys keys;          /* count 0: none; else has_camera, and camera is the first */
    float orbit;               /* degrees over the run */
    int has_light;
    float light[3]; /* towards the first light, not normalised; where has_light */
    picture_options picture;
    char *settings; /* the command line as a settings file; NULL where memory ran out */
    particle_options particles;

    coloring_by by;
    const char *formula; /* of COLORING_VALUE */
    int logarithmic;
    float plain[3]; /* sRGB, 0 to 1: the one colour of COLORING_PLAIN */
    const colormap *map;
    int has_range;
    float range_min, range_max; /* of the colours; where has_range */

    uint32_t threads;    /* 0: one per CPU */
    const char *variant; /* NULL: chosen */
    int stats, quiet, verbose;
    render_cell_options cell;
    bounce_options bounce;
} render_options;

typedef enum render_output { OUTPUT_NONE = 0, OUTPUT_PICTURE, OUTPUT_MOVIE, OUTPUT_RAW } render_output;

/* What a name stands for: a picture for each frame, a movie, or - for raw frames on standard output. */
render_output render_output_kind(const char *pattern);

/* Parses the command line. Ends the program on --help, --version (PROGRAM_OK) and errors (PROGRAM_USAGE). */
void render_options_parse(render_options *options, int argc, char **argv);

/* --range, --color, --colormap (color_options.c). They return 0, or -1 with a sentence. */
int render_options_parse_range(const char *text, render_options *o, char *error, size_t error_size);
int render_options_parse_color(const char *text, render_options *o, char *error, size_t error_size);
int render_options_parse_colormap(const char *text, const colormap **map, char *error, size_t error_size);

/* Chooses up and view where the command line does not: up is z for spheres, as in simulators, and y for triangles, as
 * in modelling programs; another axis where that is the view. The view is from the side and slightly above. */
void render_options_axes(render_options *options, trajectory_kind kind);

#endif
