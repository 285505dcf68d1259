/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small scenes with random kd-trees, and rays that are hard for ropes: in split planes, through edges and corners of
 * leaves, starting on them, with components of 0. A failure here fails the test. */
#ifndef KD_ROPE_CASES_H
#define KD_ROPE_CASES_H

#include "kd/random_tree.h"
#include "support/scenes.h"

#include "core/memory.h"

#define ROPE_MOST_OBJECTS 96u

typedef enum rope_place {
    ROPE_PLACE_ANYWHERE, /* of size about 1 */
    ROPE_PLACE_LATTICE,  /* all coordinates are small integers */
    ROPE_PLACE_PLANAR,   /* the same, in one plane perpendicular to an axis: the root has no thickness */
    ROPE_PLACES
} rope_place;

typedef struct rope_case {
    cgt_committed_scene committed_scene; /* with a tree with ropes */
    cgt_paper_structures papers;
    cgt_primitive_array array[2];
    float sphere[ROPE_MOST_OBJECTS][4];
    float vertex[3 * ROPE_MOST_OBJECTS][3];
    cgt_buffer nodes, references, leaves, triangles;
    rope_place place;
    float unit; /* the scale of all coordinates, a power of two */
} rope_case;

rope_case *rope_case_make(test_random *r, cgt_context *context, rope_place place);
void rope_case_free(rope_case *c);

/* A ray that starts in the scene or around it, with any range, but no extreme coordinates or directions. */
truth_ray rope_case_ray(test_random *r, const rope_case *c);

#endif
