/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options of cgt-render, by topic. option_table.c has them all; picture_parsers.c and particle_parsers.c read
 * values that are more than a number, render_options.c puts in what is not given and checks what needs several of
 * them. */
#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include <stdint.h>

#include <cgt/cgt.h>

#include "common/out_path.h"
#include "picture/color/coloring.h"
#include "picture/figures/particles.h"
#include "picture/style.h"
#include "playback/camera/camera_keys.h"
#include "playback/frame_source.h"
#include <cgt/picture.h>

/* ---- Movies and parts of runs -------------------------------------------------------------------------------- */

typedef struct output_options {
    double rate;          /* of movies, frames a second; 0: not given */
    int quality;          /* of movies and JPEG: 1 to 100; 0: not given */
    const char *preset;   /* of x264; NULL: not given */
    uint32_t part, parts; /* renders part `part` of `parts`, from 1; 0, 0: all */
    uint64_t survey;      /* frames to look at before the first is rendered; UINT64_MAX: all */
} output_options;

/* ---- Style, light, drawing ----------------------------------------------------------------------------------- */

typedef struct picture_lamp {
    cgt_light_kind kind;
    float place[3]; /* or the direction towards the light, not normalised */
    double at[3];   /* the place before an origin is subtracted */
    float strength;
    float color[3]; /* linear */
} picture_lamp;

/* What was not given has a negative number, or NULL, until that of the style is put in. */
typedef struct picture_options {
    picture_style style;
    int ambient;          /* rays; negative: in soft and paper until the input is open */
    float ambient_radius; /* world units, 0: any distance. -1: a share of the scene's size */
    int shadows;          /* 0 or 1: of all lights */
    float light_size;
    int light_samples;
    float key, sky, head; /* strengths of the first light, of the sky, of the light from the eye */
    int own_light;        /* one of those three was given */
    uint32_t lamp_count;
    picture_lamp lamps[CGT_PICTURE_MAX_LIGHTS - 1]; /* beside the first light */
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

/* ---- What is drawn ------------------------------------------------------------------------------------------- */

/* What a legend calls a type or an element. */
typedef struct particle_name {
    particle_kind kind;
    const char *name;
} particle_name;

typedef struct particle_options {
    char show[2048];    /* a formula; "": all. --hide, --slice and --cut are parts of it */
    const char *radius; /* a formula; NULL: none */
    float radius_scale;
    particle_kind radii[PARTICLE_KINDS], colors[PARTICLE_KINDS];
    uint32_t radius_count, color_count;
    particle_name names[PARTICLE_KINDS];
    uint32_t name_count;
    uint32_t images[3];
    int box;
    float box_radius; /* 0: by the box's size */
    int bonds;
    float bond_distance; /* 0: the file's bonds */
    float bond_radius;   /* 0: by the spheres */
    int has_bond_color;
    uint8_t bond_color[3];
    const char *arrows;              /* three formulas with commas between them; NULL: none */
    float arrow_scale, arrow_radius; /* radius: as of bonds */
    int has_arrow_color;
    uint8_t arrow_color[3];
    uint32_t trails;    /* frames before that trails reach back to; 0: none */
    float trail_radius; /* 0: by the spheres' */
    int has_trail_color;
    uint8_t trail_color[3];
    const char *mesh; /* file; NULL: none */
    uint8_t mesh_color[3];
    float mesh_opacity; /* above 0, to 1 */
} particle_options;

/* ---- Mirrors and glass --------------------------------------------------------------------------------------- */

enum { BOUNCE_MATERIALS = PARTICLE_KINDS };

/* The material of a type, of an element, or of all that no other names. */
typedef struct bounce_material {
    int is_all, is_element;
    uint32_t kind; /* a type, or an atomic number */
    cgt_material_kind material;
    float index;       /* of refraction */
    uint32_t priority; /* of glass that overlaps: cgt_material */
} bounce_material;

typedef struct bounce_options {
    int is_set; /* --bounces was given */
    uint32_t bounces;
    bounce_material materials[BOUNCE_MATERIALS];
    uint32_t count;
} bounce_options;

/* ---- A view --------------------------------------------------------------------------------------------------- */

typedef enum view_side {
    VIEW_BY_DIRECTION = 0,
    VIEW_FRONT,
    VIEW_BACK,
    VIEW_RIGHT,
    VIEW_LEFT,
    VIEW_TOP,
    VIEW_BOTTOM
} view_side;

#define VIEW_SIDES "front back right left top bottom"

/* ---- A floor ------------------------------------------------------------------------------------------------- */

#define FLOOR_AXES "x y z -x -y -z"

typedef struct floor_options {
    int is_set;
    int has_color;
    uint8_t color[3]; /* sRGB */
    uint32_t axis;    /* the number of one of FLOOR_AXES from 1; 0: that nearest to the camera's up */
    int has_height;
    double height; /* along that axis of the file; else below the lowest of the run */
    int has_place;
    double place[4]; /* its middle in the file, and the extent of what stands on it; else those of the run */
} floor_options;

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

enum { RENDER_MAX_OUTPUTS = 4, RENDER_MAX_EDGE = 65536 };

/* Limit of pixels in a picture: with buffers of up to 28 bytes each, about 6 GB. */
#define RENDER_MAX_PIXELS ((uint64_t)1 << 28)

typedef struct render_options {
    const char *input; /* the first */
    const char **inputs;
    size_t input_count;
    cgt_trajectory_options reading; /* fps 0 and clip NULL: not given */
    int unwrap, whole;
    frame_range range;

    out_path outputs[RENDER_MAX_OUTPUTS]; /* of a render_output_kind each */
    uint32_t output_count;                /* 0 with --no-images */
    output_options output;
    const char *contact_sheet; /* NULL: none */
    uint32_t sheet_columns, sheet_rows;
    int no_images;
    const char *log_file; /* NULL: none */

    uint32_t width, height;
    uint32_t samples; /* 1, 2, 4: edge of the block of rays per pixel */
    int has_camera;
    camera_key camera;         /* where has_camera */
    float zoom;                /* of the automatic camera; 0: not given */
    float view[3], up[3], fov; /* of the automatic camera; all zero: chosen by render_options_axes */
    view_side side;            /* in place of view */
    int has_view, has_up, has_fov;
    camera_keys keys; /* count 0: none; else has_camera, and camera is the first */
    float orbit;      /* degrees over the run */
    int has_light;
    float light[3]; /* towards the first light, not normalised; where has_light */
    picture_options picture;
    const char *settings_file; /* read by now */
    int print_settings;
    char *settings; /* the command line as a settings file; NULL where memory ran out */
    particle_options particles;

    coloring_by by;
    const char *formula; /* of COLORING_VALUE */
    int logarithmic;
    float plain[3]; /* sRGB, 0 to 1: the one colour of COLORING_PLAIN */
    const cgt_colormap *map;
    int has_range;
    double range_min, range_max; /* of the colours; where has_range */

    uint32_t threads;    /* 0: one per CPU */
    uint32_t memory_mib; /* that frames may take which are kept */
    const char *variant; /* NULL: chosen */
    int stats, quiet, verbose;
    render_cell_options cell;
    bounce_options bounce;
    floor_options floor;
} render_options;

typedef enum render_output { OUTPUT_NONE = 0, OUTPUT_PICTURE, OUTPUT_MOVIE, OUTPUT_RAW } render_output;

/* What a name stands for: a picture for each frame, a movie, or - for raw frames on standard output. */
render_output render_output_kind(const char *pattern);

/* Fills in the defaults. */
void render_options_init(render_options *options);

/* Parses the command line, with the files of --settings. Ends the program on --help, --version (PROGRAM_OK) and errors
 * (PROGRAM_USAGE). */
void render_options_parse(render_options *options, int argc, char **argv);

/* Chooses up and view where the command line does not: up is z for spheres, as in simulators, and y for triangles, as
 * in modelling programs; another axis where that is the view. The view is from the side and slightly above. */
void render_options_axes(render_options *options, cgt_trajectory_kind kind);

/* Whether anything lies over the picture. */
int picture_options_have_overlay(const picture_options *options);

/* Whether the settings need more than shading in the camera's tiles. */
int picture_options_need_drawing(const picture_options *options);

#endif
