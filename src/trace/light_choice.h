/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which way points against a light go: by tiles through the loose grid, or through a BVH. What the light sees of some
 * points gives an estimate; how much tiles really take, only trying tells. So they are tried under a budget of work for
 * each point, and what they took is remembered until the next commit, for each light and class of estimates. That they
 * wanted a tree which pays is remembered longer: it is built at once then (scene/light_history.h).
 *
 * Work is counted in tests of groups of 16, and references as some of them (CGT_LIGHT_REFERENCE_WORK). A tree costs
 * BUILD_WORK for each primitive where there is none yet, and then about TREE_WORK a point. As in renting or buying, tiles
 * may take more than that until their excess would have paid for the tree: then it is built. So no sequence of calls
 * takes much more than twice what the better way would have taken, apart from the first tries.
 *
 * Points in the order of the light (order/call_order.h) take less by either way, and a tree gains most. Their tasks come
 * in an order that takes samples of them all, so that an eighth of the points tells what the whole call would take:
 * tiles end where a tree, with its building, would take less. */
#ifndef CGT_LIGHT_CHOICE_H
#define CGT_LIGHT_CHOICE_H

#include "dispatch/kernel.h"
#include "scene/scene.h"

/* The work for each point after which tiles give a task up where they are taken to serve. */
#define CGT_LIGHT_MAX_WORK 320u

/* Whether the structure and the scene's size allow for tiles at all. */
bool cgt_light_allows_tiles(const cgt_committed_scene *s);

/* What the light sees of sampled points. */
typedef struct cgt_light_estimate {
    uint64_t points, prims;          /* of the samples that tiles serve; primitives between them and the light */
    uint32_t samples, few, unserved; /* with points; with few primitives for each; that tiles do not serve */
    bool ordered;                    /* the points are in the order of the light */
} cgt_light_estimate;

/* Adds a sample: points first to first + count - 1, at most a chunk, neighbours as they will be traced together. */
void cgt_light_estimate_add(cgt_light_estimate *e, const cgt_scene *s, const cgt_light *light, const cgt_rays *points,
                            uint64_t first, uint64_t count);

/* What the tasks of a call share. */
typedef struct cgt_light_progress {
    cgt_light_history *history;       /* of the scene */
    cgt_light_experience *experience; /* that the call adds to; NULL: none */
    bool few;                         /* by the estimate, tiles serve well */
    bool ordered;                     /* the estimate's */
    uint64_t points;                  /* of the call */
    uint32_t budget;                  /* of work, for each point, while tiles may give up; else 0 */
    uint32_t tree_work;               /* for each point, about what a BVH takes */
    _Atomic uint64_t tried, given_up; /* points */
    _Atomic uint64_t untried;         /* of those given up, without a trial */
    _Atomic uint64_t spent;           /* work of this pass */
    uint64_t allowance;               /* beyond what a tree takes: tiles end where they take more */
    uint64_t least_tried;             /* points before that is known */
} cgt_light_progress;

/* Chooses the way of `points` points, and builds the BVH where that pays. Sets light_tiles, max_light_work, use_bvh and
 * light_way of the settings. */
cgt_result cgt_light_choose(const cgt_scene *s, const cgt_light *light, const cgt_light_estimate *e, uint64_t points,
                            cgt_trace_settings *settings, cgt_light_progress *progress);

/* Chooses again after some tasks were given up: by tiles with more work, through the BVH, or by whatever is left. The
 * next pass traces what was given up. */
cgt_result cgt_light_choose_again(const cgt_scene *s, cgt_trace_settings *settings, cgt_light_progress *progress);

/* The settings of a task: with what others have met by now. */
cgt_trace_settings cgt_light_task_settings(const cgt_trace_settings *settings, const cgt_light_progress *progress);

/* Whether most points were given up by now: then a task need not try. */
bool cgt_light_is_hopeless(const cgt_light_progress *progress);

/* Remembers what a task's points took. counts: of this task alone. */
void cgt_light_remember(cgt_light_progress *progress, const cgt_scene *s, const cgt_counts *counts, uint64_t points,
                        bool done);

#endif
