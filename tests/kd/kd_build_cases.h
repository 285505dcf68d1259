/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the test of the kd-tree builders needs: a checker of raw trees, and degenerate scenes. */
#ifndef KD_BUILD_CASES_H
#define KD_BUILD_CASES_H

#include "builders/kd/kd_build.h"
#include "scene/scene.h"
#include "hard_cases/hard_run.h"
#include "support/scenes.h"

/* ---- raw trees ---- */

/* NULL, or what is wrong with a tree, until the next call: nodes reached once, splits inside their boxes, depth within
 * 8 + 1.3 log2 N, references ascending, every valid object in every leaf that it touches, no object in a leaf that its
 * bounds do not touch, the cost. */
const char *raw_tree_check(const cgt_kd_raw *raw, const cgt_committed_scene *committed_scene,
                           const cgt_kd_costs *costs);

/* Of all that the tree means, wherever it lies. */
uint64_t raw_tree_hash(const cgt_kd_raw *raw);

/* ---- degenerate scenes ---- */

typedef enum degenerate_kind {
    DEGENERATE_SAME_SPHERES,   /* all the same */
    DEGENERATE_POINTS,         /* radius 0, some of them the same */
    DEGENERATE_SAME_TRIANGLES, /* all the same, slanted */
    DEGENERATE_FLOOR,          /* all in one plane across an axis, a regular net */
    DEGENERATE_LAYERS,         /* flat, in a few planes across each axis, zero of either sign among them */
    DEGENERATE_LINE,           /* spheres along an axis */
    DEGENERATE_HUGE,           /* up to 2^55 */
    DEGENERATE_TINY,           /* denormal */
    DEGENERATE_WIDE,           /* from denormal to 2^55, with overlaps */
    DEGENERATE_FAN,            /* triangles with one vertex in common */
    DEGENERATE_GARBAGE,        /* any bits: most are skipped */
    DEGENERATE_KINDS
} degenerate_kind;
#define DEGENERATE_NAMES                                                                                               \
    "same spheres", "points", "same triangles", "floor", "layers", "line", "huge", "tiny", "wide", "fan", "garbage"

/* Spheres or triangles, the others are 0. */
typedef struct degenerate_scene {
    uint32_t spheres, triangles;
    float (*sphere)[4];
    float (*vertex)[3];
} degenerate_scene;

void degenerate_make(degenerate_scene *d, degenerate_kind kind, uint32_t count);
cgt_scene *degenerate_commit(cgt_context *context, const degenerate_scene *d);
void degenerate_free(degenerate_scene *d);

#endif
