/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which way the points of a call go to a light: by tiles through the loose grid, or through a BVH.
 *
 * The choice is made at the top of a call: tiles if there is a grid that serves the light, unless a BVH is there and
 * tiles have given up before. How much work tiles take, only tracing tells. So the tasks of a call come in an order
 * that samples all of its points, and what tiles take is compared with what a tree would take, and with the tree's
 * price, which is 0 if it is there. Once an eighth of the points says that the call would pay for the tree, tiles end,
 * and all other points go through it. So do the points of a task that goes far beyond its share.
 *
 * What a call spends beyond a tree's work counts towards the tree for later calls, less what later calls save: so some
 * dense tiles among many small calls build no tree. Over commits, the scene remembers one bit: lights gave up tiles.
 * Then a 256th of the points is enough to tell. So a frame like the last one loses little before the tree is built, and
 * a frame that tiles serve keeps them.
 *
 * Work is counted in references and in tests of 16 rays, which take about as long. */
#ifndef CGT_LIGHT_CHOICE_H
#define CGT_LIGHT_CHOICE_H

#include <stdatomic.h>

#include "dispatch/kernel.h"
#include "scene/scene.h"

typedef struct cgt_light_choice {
    uint64_t price;               /* work beyond a tree's that pays for building it; 0: it is there, or paid */
    uint64_t points;              /* about, of the light */
    uint32_t share;               /* of the points, that speaks for all */
    bool samples;                 /* whatever other lights of the commit gave up */
    double tree_work;             /* of a point through a tree */
    _Atomic uint64_t tried, work; /* points by tiles, and what they took */
    _Atomic uint64_t given_up;    /* points */
} cgt_light_choice;

/* Sets light_tiles, use_bvh and light_way of the settings, for a light with about so many points, whose neighbours in
 * the arrays lie side by side or not. Builds the BVH if tiles do not serve and the points pay for it. */
cgt_result cgt_light_choose(const cgt_scene *s, const cgt_light *light, uint64_t points, bool neighbours,
                            cgt_trace_settings *settings, cgt_light_choice *choice);

/* Whether the points that are left had better go through the tree. */
bool cgt_light_gives_up(const cgt_light_choice *choice);

/* The work for each of its points after which a task gives up; 0: it never does. */
uint32_t cgt_light_budget(const cgt_light_choice *choice, uint64_t points);

/* Adds what tiles took for a task. counts: of this task alone. */
void cgt_light_add_work(cgt_light_choice *choice, const cgt_scene *s, const cgt_counts *counts, uint64_t points);

/* After all tasks: counts their work towards the tree, and builds it for points that tiles gave up. */
cgt_result cgt_light_settle(const cgt_scene *s, cgt_trace_settings *settings, const cgt_light_choice *choice);

#endif
