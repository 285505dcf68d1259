/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is drawn beside a frame's spheres: the edges of its box, bonds, arrows of vectors, trails. */
#ifndef SHAPES_H
#define SHAPES_H

#include <stddef.h>
#include <stdint.h>

#include "data/particles.h"
#include "sequence/trail_history.h"
#include "scene/sticks.h"

/* The box: its twelve edges as cylinders, with balls at the corners. images: copies along each edge, as of
 * particle_rules: the outline of all of them together. Returns 0, or -1 where the frame has no box. */
int cgt_shapes_add_box(sticks *s, const cgt_trajectory_frame *frame, const uint32_t images[3], float radius,
                       uint16_t entry);

/* Bonds between spheres that are drawn; each half has the palette entry of its sphere, or `entry` where that is not
 * negative. */
typedef struct bond_rules {
    float distance; /* spheres so near are bonded; 0: the frame's bonds */
    float radius;
    int32_t entry;      /* -1: the spheres' */
    uint32_t images[3]; /* of particle_rules, by which the spheres were selected */
    /* Of layers: only the bonds of one are added, which a bond has from its more transparent end, or all have from
     * `layer` where that is not negative. */
    const float *opacity; /* by layer; NULL: there are no layers */
    uint32_t only;
    int32_t layer;
    uint64_t *cut; /* counts bonds that are left out at the outer boundary; NULL: nobody asks */
} bond_rules;

/* Adds bonds of one frame, which may have none. A bond of the frame that goes through a periodic boundary, as
 * periodic_box.h tells, is drawn between the images of its spheres, and left out at the outer boundary. So are guessed
 * bonds of a small cell to more images than one. Returns 0, or -1 with a sentence: no memory. */
int cgt_shapes_add_bonds(sticks *s, const bond_rules *rules, const cgt_trajectory_frame *frame,
                         const particles *spheres, char *error, size_t error_size);

/* Arrows from the centres of the spheres that are drawn. vector: three formulas, bound to the frame; scale: world units
 * per unit of the vectors; radius: of the shafts. Shorter arrows than 4 radii are thinner in proportion. */
void cgt_shapes_add_arrows(sticks *s, const expression *const vector[3], float scale, float radius,
                           const particles *spheres, int32_t entry);

/* Places in all trails of a frame, at most: each is some 150 bytes of capsules and of the structure over them. */
enum { SHAPES_MOST_PLACES = 1 << 22 };

/* Trails of the spheres that are drawn, with the palette entry of each or with `entry` where that is not negative. */
typedef struct trail_rules {
    const trail_history *history; /* the frame is its newest */
    float radius;                 /* at the sphere; 0: a fifth of the sphere's. It shrinks to 15 % of that at the end */
    int32_t entry;                /* -1: the spheres' */
} trail_rules;

/* Adds the trails of one frame: capsules through the spheres' places in the frames before. Where a sphere has gone
 * through a periodic boundary from one frame to the next, as periodic_box.h tells, its trail is broken. What a sphere
 * hides is left out. Returns 0, or -1 with a sentence: no memory, more than SHAPES_MOST_PLACES. */
int cgt_shapes_add_trails(sticks *s, const trail_rules *rules, const cgt_trajectory_frame *frame,
                          const particles *spheres, char *error, size_t error_size);

#endif
