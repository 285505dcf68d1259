/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which way the points of a call go to a light: by tiles through the loose grid, or through a BVH.
 *
 * The choice is made at the top of a call: tiles if there is a grid that serves the light, unless a BVH is there and
 * tiles have given up before. How much work tiles take, only tracing tells. So the tasks of a call come in an order
 * that samples all of its points, and what they take goes into an account, by which light_policy.h decides after each
 * task whether the others go through a BVH, built for them if it is not there.
 *
 * What a call spends beyond a tree's work counts towards the tree for later calls, less what later calls save: so some
 * dense tiles among many small calls build no tree. Where lights gave up tiles before the last commit, a tree counts as
 * paid. */
#ifndef CGT_LIGHT_CHOICE_H
#define CGT_LIGHT_CHOICE_H

#include <stdatomic.h>

#include "dispatch/kernel.h"
#include "scene/scene.h"
#include "trace/light_policy.h"

typedef struct cgt_light_choice {
    cgt_light_account begin;                /* of the call's account */
    _Atomic uint64_t tried, work, given_up; /* what tasks add to it */
} cgt_light_choice;

/* Sets light_tiles, use_bvh and light_way of the settings, for a light with about so many points. Builds the BVH if
 * tiles do not serve and the points pay for it. */
cgt_result cgt_light_choose(const cgt_scene *s, const cgt_light *light, uint64_t points, cgt_trace_settings *settings,
                            cgt_light_choice *choice);

/* The account by now. */
cgt_light_account cgt_light_account_now(const cgt_light_choice *choice);

/* Adds what tiles took for a task. counts: of this task alone. */
void cgt_light_add_work(cgt_light_choice *choice, const cgt_scene *s, const cgt_counts *counts, uint64_t points);

/* After all tasks: counts their work towards the tree, and builds it for points that tiles gave up. */
cgt_result cgt_light_settle(const cgt_scene *s, cgt_trace_settings *settings, const cgt_light_choice *choice);

#endif
