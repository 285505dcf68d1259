/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A checker of raw trees and degenerate scenes, for the tests of the kd-tree builders. */
#ifndef KD_BUILD_CASES_H
#define KD_BUILD_CASES_H

#include "papers/build/kd/kd_build.h"
#include "scene/scene.h"
#include "hard_cases/hard_run.h"
#include "support/scenes.h"

/* ---- raw trees ---- */

/* Returns NULL, or the fault of a tree, valid until the next call. Checks that nodes are reached once, splits lie
 * inside their boxes, the depth is within 8 + 1.3 log2 N, references ascend, every valid primitive is in every leaf
 * that it touches, no primitive is in a leaf that its bounds do not touch, and the cost. */
const char *raw_tree_check(const cgt_kd_raw *raw, const cgt_committed_scene *committed_scene,
                           const cgt_kd_costs *costs);

/* Hash of the tree's contents, independent of its memory layout. */
uint64_t raw_tree_hash(const cgt_kd_raw *raw);

/* ---- degenerate scenes ---- */

typedef enum degenerate_kind {
    DEGENERATE_SAME_SPHERES,   /* all the same */
    DEGENERATE_POINTS,         /* radius 0, some of them equal */
    DEGENERATE_SAME_TRIANGLES, /* all the same, not axis-aligned */
    DEGENERATE_FLOOR,          /* a regular mesh in one plane perpendicular to an axis */
    DEGENERATE_LAYERS,         /* flat, in a few planes perpendicular to each axis, +0 and -0 among them */
    DEGENERATE_LINE,           /* spheres along an axis */
    DEGENERATE_HUGE,           /* up to 2^55 */
    DEGENERATE_TINY,           /* denormal */
    DEGENERATE_WIDE,           /* from denormal to 2^55, with overlaps */
    DEGENERATE_FAN,            /* triangles that share one vertex */
    DEGENERATE_GARBAGE,        /* arbitrary bits: most are skipped */
    DEGENERATE_KINDS
} degenerate_kind;
#define DEGENERATE_NAMES                                                                                               \
    "same spheres", "points", "same triangles", "floor", "layers", "line", "huge", "tiny", "wide", "fan", "garbage"

/* Spheres or triangles; the other count is 0. */
typedef struct degenerate_scene {
    uint32_t spheres, triangles;
    float (*sphere)[4];
    float (*vertex)[3];
} degenerate_scene;

void degenerate_make(degenerate_scene *d, degenerate_kind kind, uint32_t count);
cgt_scene *degenerate_commit(cgt_context *context, const degenerate_scene *d);
void degenerate_free(degenerate_scene *d);

#endif
