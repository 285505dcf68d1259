/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which of a frame's spheres are drawn, how large, and how often: formulas that hide or size them, radii by type or
 * element, periodic images. */
#ifndef PARTICLES_H
#define PARTICLES_H

#include <stddef.h>
#include <stdint.h>

#include "data/expression/expression.h"

enum { PARTICLE_KINDS = 32, PARTICLE_LAYERS = 9, PARTICLE_LAYER_STEP = 16 };

typedef struct particle_kind {
    int is_element; /* kind is an atomic number, else a type */
    int is_word;    /* it is neither, but the word of a category */
    uint32_t kind;
    const char *text; /* as it was given, up to a '=' */
    float value[3];   /* a radius, or a colour in sRGB from 0 to 1 */
} particle_kind;

typedef struct particle_rules {
    const expression *show;   /* spheres of value 0 or NaN are left out; NULL: none */
    const expression *layer;  /* whose value mod PARTICLE_LAYER_STEP is a sphere's layer; NULL: all are opaque */
    const expression *radius; /* NULL: those of the file. One that is negative or NaN leaves the sphere out */
    float radius_scale;       /* of all radii; above 0 */
    particle_kind radii[PARTICLE_KINDS]; /* before the formula and the file */
    uint32_t radius_count;
    uint32_t images[3]; /* copies along each edge of the box, the original included: 1 or more */
} particle_rules;

/* The spheres to draw, in arrays that are kept from frame to frame. */
typedef struct particles {
    uint32_t count;
    float *xyzr;      /* 4 each */
    uint16_t *index;  /* entry of the palette */
    uint32_t *source; /* number in the file */
    uint8_t *layer;   /* 0: opaque; NULL: all are */
    size_t capacity;
    uint32_t dropped, points;            /* by the formula of radii: left out, and of radius 0; without images */
    uint32_t begin[PARTICLE_LAYERS + 1]; /* of each layer, and their end; after cgt_particles_sort */
} particles;

/* The radii of the spheres from `first` on, by the rules. */
void cgt_particle_radii(const particle_rules *rules, const cgt_trajectory_frame *frame, uint32_t first, uint32_t count,
                        float *radius);

/* Whether the rules leave every frame as it is. */
int cgt_particle_rules_are_empty(const particle_rules *rules);

/* Applies the rules to a frame of spheres whose formulas are bound; index: palette entries of the frame's spheres.
 * Returns 0, or -1 with a sentence: images without a box, more than 2^31 spheres, no memory. */
int cgt_particles_select(particles *p, const particle_rules *rules, const cgt_trajectory_frame *frame,
                         const uint16_t *index, char *error, size_t error_size);

/* Puts the spheres in the order of their layers, else as they were. Returns 0, or -1: no memory. */
int cgt_particles_sort(particles *p);
void cgt_particles_free(particles *p);

#endif
