/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The geometries of a frame of cgt-render: the file's spheres or triangles, in place where the options leave them as
 * they are, figures beside them, a mesh that stands still. */
#ifndef RENDER_SCENE_H
#define RENDER_SCENE_H

#include "picture/color/coloring.h"
#include "picture/figures/figures.h"
#include "picture/figures/floor.h"
#include "picture/figures/particles.h"
#include "picture/figures/sticks.h"
#include "render/options/render_options.h"

enum {
    FIGURE_BOX = COLORING_ENTRIES,
    FIGURE_BOND,
    FIGURE_ARROW,
    FIGURE_MESH,
    FIGURE_TRAIL,
    FIGURE_FLOOR,
    FIGURE_ENTRIES
};

enum { RENDER_LOOKS = 5 };

/* Bits of masks: the mesh that stands among the spheres has a bit of its own, and they have all. */
enum { MASK_ALL_BUT_MESH = 1, MASK_MESH = 2 };

/* What is drawn of a frame, in arrays of its own: made by the thread that reads, while the frame's columns are
 * there. */
typedef struct frame_parts {
    particles particles; /* where the spheres are not the file's own */
    sticks sticks;
    uint32_t bonds, arrows; /* capsules before trails, and triangles before the box, which get no outlines */
    int8_t *rules;          /* of each sphere that is drawn: its --material, or -1. NULL: there are none */
    size_t rule_room;
} frame_parts;

typedef struct render_scene {
    particle_rules rules;
    expression *show, *radius, *arrow[3]; /* NULL: not asked for */
    int selects;                          /* spheres are copied to particles: a rule or a figure needs them */
    float palette[FIGURE_ENTRIES][3];     /* linear: that of the colouring, then those of figures */
    cgt_trajectory *mesh_file;            /* NULL: none */
    cgt_trajectory_frame mesh;
    uint16_t *mesh_entries;
    floor_mesh floor;
    int has_sticks, has_facets, has_mesh, has_floor; /* their geometries are in the scene */
    uint32_t sticks_geometry, facets_geometry, mesh_geometry, floor_geometry;
    const frame_parts *frame; /* that is drawn */
} render_scene;

struct renderer;

/* Parses formulas, which the sequence then binds. Returns 0, or -1 with the message printed, as do the
 * others. */
int render_scene_open(struct renderer *r);

/* After the survey: reads the mesh, and extends the survey's bounds by box, images and mesh. */
int render_scene_bound(struct renderer *r);

/* After the colours are chosen: colours of types and figures. */
void render_scene_color(struct renderer *r);

/* After the camera is chosen: makes the floor. */
void render_scene_floor(struct renderer *r);

/* Makes the parts of a frame that was read and coloured; index: as coloring.index. For the thread that reads. Returns
 * 0, or -1 with a text. */
int render_scene_prepare(const struct renderer *r, const cgt_trajectory_frame *frame, const uint16_t *index,
                         frame_parts *parts, char *error, size_t error_size);
void frame_parts_free(frame_parts *parts);

/* Hands r->frame and its parts to the library's scene. */
int render_scene_set(struct renderer *r, const frame_parts *parts);

/* Whether what a ray has hit is of the file, and the number there of that sphere or triangle. */
int render_scene_find(const struct renderer *r, uint32_t geometry, uint32_t primitive, uint32_t *element);

/* Whether there is more than one geometry, a floor left aside. */
int render_scene_has_figures(const struct renderer *r);

/* The rule, by its number, of a sphere of a type (NULL: the file has none) and an element (the same): one that names it
 * before one for all, the last of several; -1: none. */
int bounce_rule_of(const bounce_options *options, const uint32_t *type, const uint8_t *element);

/* Sets the look of each geometry; returns how many there are, at most RENDER_LOOKS. */
uint32_t render_scene_looks(const struct renderer *r, cgt_look *looks);
void render_scene_close(struct renderer *r);

#endif
