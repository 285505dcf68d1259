/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-render. */
#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "picture/coloring.h"
#include "playback/frame_source.h"
#include "common/out_path.h"
#include "render/render_cell_options.h"

enum { RENDER_MAX_OUTPUTS = 4, RENDER_MAX_EDGE = 65536 };

/* Limit of pixels in a picture: with buffers of up to 23 bytes each, about 6 GB. */
#define RENDER_MAX_PIXELS ((uint64_t)1 << 28)

typedef struct render_options {
    const char *input; /* the first */
    const char **inputs;
    size_t input_count;
    trajectory_options reading; /* fps 0 and clip NULL: not given */
    frame_range range;

    out_path outputs[RENDER_MAX_OUTPUTS]; /* .png or .exr each */
    uint32_t output_count;                /* 0 with --no-images */
    const char *contact_sheet;            /* NULL: none */
    uint32_t sheet_columns, sheet_rows;
    const char *log_file; /* NULL: none */

    uint32_t width, height;
    uint32_t samples; /* 1, 2, 4: edge of the block of rays per pixel */
    int has_camera;
    cgt_camera camera;         /* where has_camera */
    float view[3], up[3], fov; /* of the automatic camera; all zero: chosen by render_options_axes */
    float orbit;               /* degrees over the run */
    int has_light;
    float light[3];        /* towards the light, not normalised; where has_light */
    uint8_t background[3]; /* sRGB */

    coloring_by by;
    float plain[3]; /* sRGB, 0 to 1: the one colour of COLORING_PLAIN */
    const colormap *map;
    int has_range;
    float range_min, range_max; /* of the colours; where has_range */

    uint32_t threads;    /* 0: one per CPU */
    const char *variant; /* NULL: chosen */
    int stats, quiet, verbose;
    render_cell_options cell;
} render_options;

/* Parses the command line. Ends the program on --help, --version (PROGRAM_OK) and errors (PROGRAM_USAGE). */
void render_options_parse(render_options *options, int argc, char **argv);

/* Chooses up and view where the command line does not: up is z for spheres, as in simulators, and y for triangles, as
 * in modelling programs; another axis where that is the view. The view is from the side and slightly above. */
void render_options_axes(render_options *options, trajectory_kind kind);

#endif
