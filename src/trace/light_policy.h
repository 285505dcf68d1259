/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tiles or a tree for points against a light, as a function of counted work alone: no clock, no scene. Work is counted
 * in references and in tests of 16 rays by tiles, which take about as long.
 *
 * The constants are prices, measured with 16 lanes (docs/reports/light.md): what a point takes through a tree, whose
 * packets hold as many primitives across as points lie between them, and what building one takes. */
#ifndef CGT_LIGHT_POLICY_H
#define CGT_LIGHT_POLICY_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "dispatch/kernel.h"

#define CGT_LIGHT_TREE_LEAST 0.8    /* of a point among many that share all */
#define CGT_LIGHT_TREE_APART 3.5    /* more, where there are as many primitives as points */
#define CGT_LIGHT_TREE_MOST 8.0     /* of a point that shares nothing */
#define CGT_LIGHT_RAY_PRICE 40.0    /* a ray pays so much of a tree's price (builders/bvh/bvh_on_demand.h) */
#define CGT_LIGHT_POINT_MOST 400u   /* of a point by tiles: one ray at a time through the grid takes less */
#define CGT_LIGHT_SCATTERED_RAYS 4u /* that count for a point which tiles gave up */

/* A call's points against a light. */
typedef struct cgt_light_account {
    double points;   /* of the call, about */
    double spread;   /* primitives of the scene for each point */
    double price;    /* of a tree that is not there, less what earlier calls took beyond it; 0: there, paid, expected */
    double tried;    /* points by tiles */
    double spent;    /* work that they took */
    double given_up; /* points of them that have no answer, and wait for a tree */
} cgt_light_account;

/* The spread of a call's points. Those of one task may be a piece of a picture, whose other points come in other calls:
 * then the picture has about as many as there are primitives. */
static inline double cgt_light_spread(double prims, double points)
{
    const double spread = prims / (points + 1);
    return points <= CGT_RAYS_CHUNK ? fmin(spread, 1.5) : spread;
}

/* What a point takes through a tree. */
static inline double cgt_light_tree_work(const cgt_light_account *a)
{
    const double work = CGT_LIGHT_TREE_LEAST + CGT_LIGHT_TREE_APART * sqrt(a->spread);
    return fmin(work, CGT_LIGHT_TREE_MOST);
}

/* What building a tree for `points` of the call saves, if they are like those tried: what is spent is spent. An eighth
 * of the points speaks for all, fewer for as much less. A tree has to spare a quarter: its work is known no better. */
static inline double cgt_light_gain(const cgt_light_account *a, double points)
{
    const double tree = cgt_light_tree_work(a), excess = a->spent - a->tried * tree;
    const double wait = 4 * CGT_LIGHT_RAY_PRICE * a->given_up; /* these take as long as four rays without a tree */
    return excess * points / fmax(fmax(a->tried, a->points / 8), 1) - points * tree / 4 -
           (wait >= a->price ? 0 : a->price);
}

/* Whether the points that are left had better go through a tree. */
static inline bool cgt_light_leaves_tiles(const cgt_light_account *a)
{
    return a->tried > 0 && cgt_light_gain(a, fmax(a->points - a->tried, 0)) > 0;
}

/* The work for each of a task's points at which tiles give it up, which is soon if a tree costs nothing. Else other
 * tasks may take far less, and an eighth of the tree's price is what a sample may take. */
static inline uint32_t cgt_light_budget(const cgt_light_account *a, double points)
{
    const double work = cgt_light_tree_work(a) * (a->price > 0 ? 8 : 2) + a->price / 8 / (points + 1);
    return work < CGT_LIGHT_POINT_MOST ? (uint32_t)work + 1 : CGT_LIGHT_POINT_MOST;
}

#endif
