/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See light_choice.h. The constants were measured with 16 lanes (docs/reports/light.md). */
#include "trace/light_choice.h"

#include "builders/bvh/bvh_on_demand.h"
#include "query/tile_limits.h"

/* What a point through a tree takes; single points more where the tree outgrows the caches. */
#define TREE_WORK 5u
#define PRIMS_PER_TREE_WORK 131072u
#define MOST_TREE_WORK 16u

#define RAY_WORK 64u        /* a ray pays for building 32 primitives of a tree (bvh_on_demand.h), which takes this */
#define SAMPLE_SHARE 8u     /* of the points, which speaks for all */
#define WANTED_SHARE 64u    /* the same if lights gave up tiles before the last commit */
#define SURE 2u             /* times the price: what says so earlier */
#define TASK_FACTOR 8u      /* what a task may take in trees: others take less */
#define WANTED_FACTOR 1u    /* the same if lights gave up */
#define MOST_WORK 400u      /* for each point: any other way takes less */
#define SCATTERED_POINTS 4u /* rays that count for a point that takes so much */
#define DUE_SHARE 4u        /* of the price: what says so if points that gave up need a tree */
#define FEW_POINTS 256u     /* fewer go through a BVH if there is one */

static uint64_t read(const _Atomic uint64_t *number) { return atomic_load_explicit(number, memory_order_relaxed); }

static void begin(const cgt_scene *s, cgt_light_choice *choice)
{
    const uint32_t work = TREE_WORK + 1 + s->committed_scene.valid / PRIMS_PER_TREE_WORK;
    choice->tree_work = work < MOST_TREE_WORK ? work : MOST_TREE_WORK;
    choice->price = RAY_WORK * cgt_bvh_rays_left(s);
    /* a tree that earlier rays have paid for is built as soon as points take more than it would */
    const bool is_paid = choice->price == RAY_WORK;
    choice->share = is_paid || s->light_wants_tree ? WANTED_SHARE : SAMPLE_SHARE;
    atomic_store_explicit(&choice->tried, 0, memory_order_relaxed);
    atomic_store_explicit(&choice->work, 0, memory_order_relaxed);
    atomic_store_explicit(&choice->given_up, 0, memory_order_relaxed);
}

cgt_result cgt_light_choose(const cgt_scene *s, const cgt_light *light, uint64_t points, cgt_trace_settings *settings,
                            cgt_light_choice *choice)
{
    const bool serves = cgt_tile_supports_light(&s->committed_scene, light);
    const cgt_result result = cgt_bvh_build_on_demand(s, serves ? 0 : points, &settings->use_bvh);
    const bool gave_up = atomic_load_explicit(&s->mutable_scene->light_gave_up, memory_order_relaxed);
    const bool by_tree = settings->use_bvh && (gave_up || points < FEW_POINTS);
    begin(s, choice);
    choice->points = points;
    settings->light_tiles = serves && !by_tree;
    settings->light_way = !serves ? CGT_LIGHT_WAY_UNSERVED : by_tree ? CGT_LIGHT_WAY_TREE : CGT_LIGHT_WAY_TILES;
    return result;
}

/* The work by now beyond a tree's. */
static uint64_t excess(const cgt_light_choice *choice)
{
    const uint64_t work = read(&choice->work), by_tree = read(&choice->tried) * TREE_WORK;
    return work > by_tree ? work - by_tree : 0;
}

/* The same of `points` more, if they are like those that came. */
static uint64_t expected_excess(const cgt_light_choice *choice, uint64_t points)
{
    const uint64_t tried = read(&choice->tried);
    return tried ? (uint64_t)((double)excess(choice) / (double)tried * (double)points) : 0;
}

bool cgt_light_gives_up(const cgt_light_choice *choice)
{
    const uint64_t tried = read(&choice->tried), left = choice->points > tried ? choice->points - tried : 0,
                   given_up = read(&choice->given_up);
    if (2 * given_up > tried)
        return true;
    /* What is spent is spent: the tree has to pay for itself by the points that are left. One that will be built for
     * those given up pays sooner. */
    const bool is_due = given_up && SCATTERED_POINTS * RAY_WORK * given_up >= choice->price;
    if (is_due || tried * choice->share >= choice->points)
        return expected_excess(choice, left) > (is_due ? choice->price / DUE_SHARE : choice->price);
    return choice->price && excess(choice) > choice->price * SURE / choice->share;
}

uint32_t cgt_light_budget(const cgt_light_choice *choice, uint64_t points)
{
    const bool wanted = choice->share == WANTED_SHARE;
    const double sample = (double)SURE / choice->share, own = (double)points / (double)(choice->points + 1),
                 price = (double)choice->price * (wanted || sample > own ? sample : own);
    const double work = choice->tree_work * (wanted ? WANTED_FACTOR : TASK_FACTOR) + price / (double)(points + 1);
    return work < MOST_WORK ? (uint32_t)work : MOST_WORK;
}

void cgt_light_add_work(cgt_light_choice *choice, const cgt_scene *s, const cgt_counts *counts, uint64_t points)
{
    atomic_fetch_add_explicit(&choice->tried, points, memory_order_relaxed);
    atomic_fetch_add_explicit(&choice->work, counts->light_work * s->context->kernel->lanes / 16, memory_order_relaxed);
}

cgt_result cgt_light_settle(const cgt_scene *s, cgt_trace_settings *settings, const cgt_light_choice *choice)
{
    const uint64_t given_up = read(&choice->given_up), left = cgt_bvh_rays_left(s);
    if (!settings->light_tiles)
        return CGT_OK;
    const bool builds = given_up && (cgt_light_gives_up(choice) || SCATTERED_POINTS * given_up >= left);
    if (builds)
        cgt_set_flag(&s->mutable_scene->light_gave_up);
    cgt_bvh_count_rays(s, (builds ? expected_excess(choice, choice->points) : excess(choice)) / RAY_WORK);
    if (!given_up)
        return CGT_OK;
    settings->light_way = CGT_LIGHT_WAY_GIVEN_UP;
    settings->light_tiles = false;
    if (settings->use_bvh)
        return CGT_OK;
    return cgt_bvh_build_on_demand(s, builds && left ? left : SCATTERED_POINTS * given_up, &settings->use_bvh);
}
