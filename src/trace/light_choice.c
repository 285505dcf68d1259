/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See light_choice.h. The constants were measured with 16 lanes (docs/reports/light.md). */
#include "trace/light_choice.h"

#include "builders/bvh/bvh_on_demand.h"
#include "query/tile_limits.h"

#define TREE_WORK 5.0       /* what a point through a tree takes */
#define RAY_WORK 56u        /* a ray pays for building 32 primitives of a tree (bvh_on_demand.h), which takes this */
#define SAMPLE_SHARE 8u     /* of the points, which speaks for all */
#define WANTED_SHARE 256u   /* the same if lights gave up tiles before the last commit */
#define SURE 2u             /* times the price: what says so earlier */
#define TASK_FACTOR 16u     /* what a task may take in trees: others take less */
#define WANTED_FACTOR 1u    /* the same if lights gave up */
#define MOST_WORK 400u      /* for each point: any other way takes less */
#define SCATTERED_POINTS 4u /* rays that count for a point that takes so much */
#define DUE_SHARE 4u        /* of the price: what says so if points that gave up need a tree */
#define FEW_POINTS 256u     /* fewer go through a BVH if there is one */
#define PRIMS_PER_WORK 8u   /* what calls must take beyond a tree that is there before later ones go to it at once */

/* Small scenes, whose tree is soon built, and where packets through it share nearly all of their work if neighbours
 * come together. A frame is sampled there whatever other lights gave up, and leaves tiles only if a tree spares a
 * quarter of a reference for each point: the sample may be so far off. */
#define SMALL_SCENE 8192u /* primitives, in calls of one task; larger ones are not small */
#define SMALL_SHARE 128u  /* points for each primitive, in calls of several; with fewer it is not small */
#define SMALL_TREE_WORK 0.75
#define SMALL_SAMPLE 16384u /* points, at least: the first tiles may be a frame's corners */
#define SMALL_GAIN 4u

static uint64_t read(const _Atomic uint64_t *number) { return atomic_load_explicit(number, memory_order_relaxed); }

static void begin(const cgt_scene *s, uint64_t points, bool neighbours, cgt_light_choice *choice)
{
    const uint64_t left = cgt_bvh_rays_left(s), owed = RAY_WORK * left, paid = read(&s->mutable_scene->light_excess);
    const uint64_t prims = s->committed_scene.valid;
    const bool is_one_task = points <= CGT_RAYS_CHUNK;
    const bool may_have_tree = left < UINT32_MAX; /* the structure that was asked for may have none */
    const bool is_small =
        neighbours && may_have_tree && (is_one_task ? prims < SMALL_SCENE : prims * SMALL_SHARE <= points);
    choice->points = points;
    choice->tree_work = is_small ? SMALL_TREE_WORK : TREE_WORK;
    choice->samples = is_small && !is_one_task;
    choice->price = owed > paid ? owed - paid : 0;
    /* a tree that is there, or that earlier calls have paid for, takes what takes more than it would */
    choice->share = !choice->price || s->light_wants_tree ? WANTED_SHARE : SAMPLE_SHARE;
    if (choice->samples) {
        choice->price = points / SMALL_GAIN;
        choice->share = points < SMALL_SAMPLE * SAMPLE_SHARE ? 1 + (uint32_t)points / SMALL_SAMPLE : SAMPLE_SHARE;
    }
    atomic_store_explicit(&choice->tried, 0, memory_order_relaxed);
    atomic_store_explicit(&choice->work, 0, memory_order_relaxed);
    atomic_store_explicit(&choice->given_up, 0, memory_order_relaxed);
}

cgt_result cgt_light_choose(const cgt_scene *s, const cgt_light *light, uint64_t points, bool neighbours,
                            cgt_trace_settings *settings, cgt_light_choice *choice)
{
    const bool serves = cgt_tile_supports_light(&s->committed_scene, light);
    const cgt_result result = cgt_bvh_build_on_demand(s, serves ? 0 : points, &settings->use_bvh);
    const bool gave_up = atomic_load_explicit(&s->mutable_scene->light_gave_up, memory_order_relaxed);
    begin(s, points, neighbours, choice);
    const bool by_tree = settings->use_bvh && ((gave_up && !choice->samples) || points < FEW_POINTS);
    settings->light_tiles = serves && !by_tree;
    settings->light_way = !serves ? CGT_LIGHT_WAY_UNSERVED : by_tree ? CGT_LIGHT_WAY_TREE : CGT_LIGHT_WAY_TILES;
    return result;
}

/* The work by now beyond a tree's; below 0: tiles took less. */
static int64_t excess(const cgt_light_choice *choice)
{
    return (int64_t)read(&choice->work) - (int64_t)((double)read(&choice->tried) * choice->tree_work);
}

/* The same of `points` more, if they are like those that came. */
static int64_t expected_excess(const cgt_light_choice *choice, uint64_t points)
{
    const uint64_t tried = read(&choice->tried);
    return tried ? (int64_t)((double)excess(choice) / (double)tried * (double)points) : 0;
}

/* Adds a call's excess. What calls save is taken off, but never more than calls before have spent. */
static void add_excess(cgt_scene *s, int64_t more)
{
    uint64_t sum = read(&s->light_excess), next;
    do
        next = more < 0 && sum < (uint64_t)-more ? 0 : sum + (uint64_t)more;
    while (!atomic_compare_exchange_weak_explicit(&s->light_excess, &sum, next, memory_order_relaxed,
                                                  memory_order_relaxed));
}

/* Whether points that were given up pay for the tree, so that it will be built. */
static bool is_due(const cgt_light_choice *choice)
{
    const uint64_t given_up = read(&choice->given_up);
    return given_up && SCATTERED_POINTS * RAY_WORK * given_up >= choice->price;
}

bool cgt_light_gives_up(const cgt_light_choice *choice)
{
    const uint64_t tried = read(&choice->tried), left = choice->points > tried ? choice->points - tried : 0;
    if (2 * read(&choice->given_up) > tried)
        return true;
    /* what is spent is spent: the tree has to pay for itself by the points that are left, sooner if it is due */
    if (is_due(choice) || tried * choice->share >= choice->points)
        return expected_excess(choice, left) > (int64_t)(choice->price / (is_due(choice) ? DUE_SHARE : 1));
    return choice->price && excess(choice) > (int64_t)(choice->price * SURE / choice->share);
}

uint32_t cgt_light_budget(const cgt_light_choice *choice, uint64_t points)
{
    const bool wanted = choice->share == WANTED_SHARE;
    const double sample = (double)SURE / choice->share, own = (double)points / (double)(choice->points + 1),
                 price = (double)choice->price * (wanted || sample > own ? sample : own);
    const double work = TREE_WORK * (wanted ? WANTED_FACTOR : TASK_FACTOR) + price / (double)(points + 1);
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
    const int64_t expected = expected_excess(choice, choice->points);
    const bool wants = s->light_wants_tree && given_up >= FEW_POINTS;
    const bool builds = given_up && (wants || is_due(choice) || expected > (int64_t)choice->price);
    add_excess(s->mutable_scene, builds ? expected : excess(choice));
    if (builds && (left || read(&s->light_excess) >= s->committed_scene.valid / PRIMS_PER_WORK))
        cgt_set_flag(&s->mutable_scene->light_gave_up);
    if (!given_up)
        return CGT_OK;
    settings->light_way = CGT_LIGHT_WAY_GIVEN_UP;
    settings->light_tiles = false;
    if (settings->use_bvh)
        return CGT_OK;
    return cgt_bvh_build_on_demand(s, builds && left ? left : SCATTERED_POINTS * given_up, &settings->use_bvh);
}
