/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What may be said of a figure, by topic. picture_values.c and particle_values.c read values that are more than a
 * number, figure_options.c puts in what is not given and checks what needs several of them. */
#ifndef FIGURE_OPTIONS_H
#define FIGURE_OPTIONS_H

#include <stdint.h>

#include <cgt/picture.h>
#include <cgt/trajectory.h>

#include "color/coloring.h"
#include "data/particles.h"
#include "sequence/frame_atoms.h"
#include "text/scale_bar.h"
#include "style.h"
#include "camera/camera_keys.h"

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
    scale_bar scale;
    char label[2048];       /* a formula: spheres that have labels; "": none */
    const char *label_text; /* of these; NULL: ids, or indices */
    const char *font;       /* file; NULL: found */
    float text_size;        /* share of the picture's height */
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
    atom_type types[FRAME_ATOM_TYPES]; /* that are elements */
    uint32_t type_count;
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
    uint8_t mesh_color[3];
    float mesh_opacity; /* above 0, to 1 */
    /* What is transparent is in layers, by opacity: layer k from 1 has layers[k - 1], 0 is opaque. */
    char opacity[2048]; /* a formula for particle_rules.layer; "": all are opaque */
    uint32_t opacity_count;
    uint32_t layer_count;
    float layers[CGT_PICTURE_MAX_LAYERS];
    int has_bond_layer; /* else bonds are as transparent as their ends */
    uint32_t bond_layer, mesh_layer;
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

/* ---- All ----------------------------------------------------------------------------------------------------- */

enum { FIGURE_MAX_EDGE = 65536 };

/* Limit of pixels in a picture: with buffers of up to 28 bytes each, about 6 GB. */
#define FIGURE_MAX_PIXELS ((uint64_t)1 << 28)

typedef struct figure_options {
    uint32_t width, height;
    uint32_t samples; /* 1, 2, 4: edge of the block of rays per pixel; 0 until finished: automatic */
    int has_camera;
    camera_key camera;         /* where has_camera */
    float zoom;                /* of the automatic camera; 0: not given */
    float view[3], up[3], fov; /* of the automatic camera; all zero: chosen by cgt_figure_options_axes */
    view_side side;            /* in place of view */
    int vertical;              /* the number of the data's axis that points up, from 1, whatever the camera's up is;
                                  0: not yet chosen */
    int has_view, has_up, has_fov;
    camera_keys keys; /* count 0: none; else has_camera, and camera is the first */
    float orbit;      /* degrees over the run */
    int has_light;
    float light[3]; /* towards the first light, not normalised; where has_light */
    picture_options picture;
    particle_options particles;
    bounce_options bounce;
    floor_options floor;
    int unwrap, whole; /* molecules */

    coloring_by by;
    const char *formula; /* of COLORING_VALUE and COLORING_CATEGORY */
    int is_name;         /* the former is a name alone, which may be that of a column of words */
    int logarithmic;
    float plain[3]; /* sRGB, 0 to 1: the one colour of COLORING_PLAIN */
    const cgt_colormap *map;
    color_table own_map; /* count above 0: in place of the map */
    int has_range;
    double range_min, range_max; /* of the colours; where has_range */
    int is_symmetric;            /* else the range that is found is made one about 0 */
} figure_options;

/* Fills in the defaults. */
void cgt_figure_options_init(figure_options *o);

/* Puts in what belongs to others that are given, and checks what needs several. Returns 0, or -1 with a sentence. */
int cgt_figure_options_finish(figure_options *o, char *error, size_t size);

/* Chooses up and view where no option does: up is z for spheres, as in simulators, and y for triangles, as
 * in modelling programs; another axis where that is the view. The view is from the side and slightly above. Heights are
 * along the axis that points up before a view along it takes another one. */
void cgt_figure_options_axes(figure_options *o, cgt_trajectory_kind kind);

/* The layer of an opacity above 0, which is made where there is none; UINT32_MAX: there is no room for it. */
uint32_t cgt_particle_options_layer(particle_options *options, float opacity);

/* Whether all bonds of frames are asked for, guessed ones, too. */
int cgt_figure_options_need_bonds(const figure_options *o);

/* Whether an option is one by which frames are taken: those that are kept stay as they were, and another value needs
 * them anew. */
int cgt_figure_option_is_of_frames(const char *name);

/* Whether anything lies over the picture. */
int cgt_picture_options_have_overlay(const picture_options *options);

/* Whether the settings need more than shading in the camera's tiles. */
int cgt_picture_options_need_drawing(const picture_options *options);

#endif
