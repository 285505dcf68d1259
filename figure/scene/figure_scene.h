/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The geometries of a frame of cgt-render: the file's spheres or triangles, in place where the options leave them as
 * they are, figures beside them, a mesh that stands still. */
#ifndef FIGURE_SCENE_H
#define FIGURE_SCENE_H

#include "color/coloring.h"
#include "scene/shapes.h"
#include "scene/floor.h"
#include "data/expression/label_rules.h"
#include "data/particles.h"
#include "scene/sticks.h"
#include "options/figure_options.h"

enum {
    FIGURE_BOX = COLORING_ENTRIES,
    FIGURE_BOND,
    FIGURE_ARROW,
    FIGURE_MESH,
    FIGURE_TRAIL,
    FIGURE_FLOOR,
    FIGURE_ENTRIES
};

/* The file's geometry, sticks, facets, mesh and floor; spheres and bonds of each layer. */
enum { FIGURE_LOOKS = 5 + 2 * CGT_PICTURE_MAX_LAYERS };

/* What is drawn of a frame, in arrays of its own: made by the thread that reads, while the frame's columns are
 * there. */
typedef struct frame_parts {
    particles particles; /* where the spheres are not the file's own */
    sticks sticks;
    uint64_t cut_bonds;                   /* left out at the box's outer boundary */
    uint32_t bond_begin[PARTICLE_LAYERS]; /* of the bonds of each layer: those of 8 first, of 0 last */
    uint32_t bonds, arrows; /* capsules before trails, and triangles before the box, which get no outlines */
    int8_t *rules;          /* of each sphere that is drawn: its --material, or -1. NULL: there are none */
    size_t rule_room;
    label_list labels;
    float angstrom; /* in the frame's unit; 0: unknown */
} frame_parts;

typedef struct figure_scene {
    particle_rules rules;
    label_rules labels;
    expression *show, *radius, *layer, *arrow[3]; /* NULL: not asked for */
    int selects;                                  /* spheres are copied to particles: a rule or a figure needs them */
    float palette[FIGURE_ENTRIES][3];             /* linear: that of the colouring, then those of figures */
    cgt_trajectory_frame mesh;                    /* that stands still; the caller's arrays */
    uint16_t *mesh_entries;                       /* NULL: there is none */
    floor_mesh floor;
    int has_sticks, has_facets, has_mesh, has_floor; /* their geometries are in the scene */
    uint32_t sticks_geometry, facets_geometry, mesh_geometry, floor_geometry;
    /* Of each layer from 1 on, where its geometries are in the scene. */
    int has_layer_spheres[PARTICLE_LAYERS], has_layer_bonds[PARTICLE_LAYERS];
    uint32_t layer_spheres[PARTICLE_LAYERS], layer_bonds[PARTICLE_LAYERS];
    const frame_parts *frame; /* that is drawn */
} figure_scene;

typedef struct cgt_figure cgt_figure;

/* Parses formulas, which the sequence then binds. Returns 0, or -1 with the message printed, as do the
 * others. */
int cgt_figure_scene_open(cgt_figure *figure);

/* Takes a mesh that stands still, whose arrays stay where they are; before the camera is chosen. */
int cgt_figure_scene_mesh(cgt_figure *figure, const cgt_trajectory_frame *mesh);

/* After the survey: extends its bounds by box, images and mesh. */
void cgt_figure_scene_bound(cgt_figure *figure);

/* After the colours are chosen: colours of types and figures. */
void cgt_figure_scene_color(cgt_figure *figure);

/* What the options call a type, element or category, by what the colours have; NULL: nothing. */
const char *cgt_figure_name_of(const cgt_figure *figure, int64_t number);

/* After the camera is chosen: makes the floor. */
void cgt_figure_scene_floor(cgt_figure *figure);

/* Makes the parts of a frame that was read and coloured; index: as coloring.index. For the thread that reads. Returns
 * 0, or -1 with a text. */
int cgt_figure_scene_prepare(const cgt_figure *figure, const cgt_trajectory_frame *frame, const uint16_t *index,
                             frame_parts *parts, char *error, size_t error_size);
void cgt_frame_parts_free(frame_parts *parts);

/* Hands r->frame and its parts to the library's scene. */
int cgt_figure_scene_set(cgt_figure *figure, const frame_parts *parts);

/* The mask of a layer's geometries; of layer 0, what is opaque, all bits where there are no layers. */
uint32_t cgt_figure_layer_mask(const particle_options *options, uint32_t layer);

/* Hands the transparent spheres and bonds to the scene; sets their looks, at most `count` in all then; finds what a
 * sphere of theirs is among all that are drawn: 0, or -1. */
cgt_result cgt_figure_layers_set(cgt_figure *figure);
uint32_t cgt_figure_layers_looks(const cgt_figure *figure, cgt_look *looks);
int cgt_figure_layers_find(const cgt_figure *figure, uint32_t geometry, uint32_t *primitive);

/* Whether what a ray has hit is of the file, and the number there of that sphere or triangle. */
int cgt_figure_scene_find(const cgt_figure *figure, uint32_t geometry, uint32_t primitive, uint32_t *element);

/* Whether there is more than one geometry, a floor left aside. */
int cgt_figure_scene_has_figures(const cgt_figure *figure);

/* The rule, by its number, of a sphere of a type (NULL: the file has none) and an element (the same): one that names it
 * before one for all, the last of several; -1: none. */
int cgt_bounce_rule_of(const bounce_options *options, const uint32_t *type, const uint8_t *element);

/* Sets the look of each geometry; returns how many there are, at most FIGURE_LOOKS. */
uint32_t cgt_figure_scene_looks(const cgt_figure *figure, cgt_look *looks);
void cgt_figure_scene_close(cgt_figure *figure);

#endif
