/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options of cgt-render: those of its figure, and its own. option_table.c has them all; output_parsers.c and
 * figure_values.h read values that are more than a number, render_options.c puts in what is not given and checks what
 * needs several of them. */
#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "common/out_path.h"
#include "playback/frame_source.h"
#include "options/figure_options.h"

/* ---- Movies and parts of runs -------------------------------------------------------------------------------- */

typedef struct output_options {
    double rate;          /* of movies, frames a second; 0: not given */
    int quality;          /* of movies and JPEG: 1 to 100; 0: not given */
    const char *preset;   /* of x264; NULL: not given */
    uint32_t part, parts; /* renders part `part` of `parts`, from 1; 0, 0: all */
    uint64_t survey;      /* frames to look at before the first is rendered; UINT64_MAX: all */
} output_options;

/* ---- An emulated Cell ---------------------------------------------------------------------------------------- */

typedef enum render_cell_mode {
    RENDER_CELL_NONE = 0, /* the library traces */
    RENDER_CELL_NATIVE,   /* the SPEs' program compiled for this machine, a thread an SPE */
    RENDER_CELL_SIM,      /* the program that an SPU's compiler made, instruction by instruction */
    RENDER_CELL_REAL      /* the same on SPEs of this machine */
} render_cell_mode;

/* Who traces which strip. */
#define RENDER_CELL_ASSIGNMENTS "interleaved static dynamic hybrid"

typedef struct render_cell_options {
    render_cell_mode mode;
    uint32_t spes;       /* 1 to 16; 0: six, as a PlayStation 3 has them */
    uint32_t assignment; /* the number of one of RENDER_CELL_ASSIGNMENTS */
    const char *program; /* SIM, REAL: the ELF file; NULL: the one beside the installed files */
} render_cell_options;

/* ---- All ----------------------------------------------------------------------------------------------------- */

enum { RENDER_MAX_OUTPUTS = 4 };

typedef struct render_options {
    const char *input; /* the first */
    const char **inputs;
    size_t input_count;
    cgt_trajectory_options reading; /* fps 0 and clip NULL: not given */
    frame_range range;

    out_path outputs[RENDER_MAX_OUTPUTS]; /* of a render_output_kind each */
    uint32_t output_count;                /* 0 with --no-images */
    output_options output;
    const char *contact_sheet; /* NULL: none */
    uint32_t sheet_columns, sheet_rows;
    int no_images;
    const char *log_file; /* NULL: none */

    figure_options figure;
    int no_metadata;           /* pictures do not say how they were made */
    const char *mesh;          /* file; NULL: none */
    const char *settings_file; /* read by now */
    int print_settings;
    char *settings; /* the command line as a settings file; NULL where memory ran out */

    uint32_t threads;    /* 0: one per CPU */
    uint32_t memory_mib; /* that frames may take which are kept */
    const char *variant; /* NULL: chosen */
    int stats, quiet, verbose;
    render_cell_options cell;
} render_options;

typedef enum render_output { OUTPUT_NONE = 0, OUTPUT_PICTURE, OUTPUT_MOVIE, OUTPUT_RAW } render_output;

/* What a name stands for: a picture for each frame, a movie, or - for raw frames on standard output. */
render_output render_output_kind(const char *pattern);

/* Fills in the defaults. */
void render_options_init(render_options *options);

/* Parses the command line, with the files of --settings. Ends the program on --help, --version (PROGRAM_OK) and errors
 * (PROGRAM_USAGE). */
void render_options_parse(render_options *options, int argc, char **argv);

/* memory_mib in bytes, as far as there are addresses. */
static inline size_t render_memory(const render_options *o)
{
    const uint64_t bytes = (uint64_t)o->memory_mib << 20;
    return bytes < SIZE_MAX ? (size_t)bytes : SIZE_MAX;
}

#endif
