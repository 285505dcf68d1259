/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options of cgt-render that say what is drawn: which spheres and how large, and what beside them. They are a child of
 * its parser. */
#ifndef PARTICLE_OPTIONS_H
#define PARTICLE_OPTIONS_H

#include <argp.h>
#include <stdint.h>

#include "picture/figures/particles.h"

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
    float bond_radius;
    int has_bond_color;
    uint8_t bond_color[3];
    const char *arrows; /* three formulas with commas between them; NULL: none */
    float arrow_scale, arrow_radius;
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

void particle_options_init(particle_options *options);

/* The parser; its input is a particle_options. */
extern const struct argp particle_options_parser;

#endif
