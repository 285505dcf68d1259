/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The way of points against a light: estimated, tried, remembered. */
#include "trace/light_choice.h"

#include <string.h>

#include "builders/bvh/bvh_on_demand.h"

/* The primitives that a tile may have to test for each point so that it needs no trial. Measured. */
#define FEW_PRIMS 16u

#define BUILD_WORK 3u /* about what a BVH's building takes for each primitive */
/* About what a point through a BVH takes that has neighbours; others take several times as much, and by tiles far
 * more. Measured. */
#define TREE_WORK 16u
#define SMALL_TREE_WORK 24u /* in scenes of few primitives, where tiles seldom take much */
#define SMALL_PRIMS 8192u
/* The same of points in the light's order, all of which have neighbours. Measured. */
#define ORDERED_TREE_WORK 12u
#define ORDERED_SHARE 8u   /* of the points, that tells what the others take */
#define ORDERED_BUDGET 8u  /* what a task may take, in averages of what tiles may take */
#define LEAST_TRIED 1024u  /* points, for a trial: fewer share little */
#define TRIAL_SHARE 8u     /* of what a tree costs, which a trial may take at most */
#define RETRY_FACTOR 2u    /* by which the budget grows from pass to pass */
#define APART_WORK 6u      /* of what is traced outside of tiles, for a reference or a test */
#define RETRY_SHARE 2u     /* of what a tree costs, which a retry may take at most */
#define LEAST_BUDGET 64u   /* of a trial */
#define TABLE_TRIAL 16384u /* references for which tables were asked: fewer tell little */
#define TABLE_KEEPS 0.8    /* a larger share that they keep, and they are made late, where a chunk meets much */
/* bvh_on_demand.c counts rays: a primitive's share of the building pays for 1/32 of one. */
#define RAY_WORK (32u * BUILD_WORK)
#define SCATTERED_POINTS 4u /* rays that count for a point that tiles gave up although few primitives were expected */

/* ---- the estimate ---- */

bool cgt_light_allows_tiles(const cgt_committed_scene *s)
{
    return s->loose.levels && s->valid && !s->brute_force && s->scale <= 0x1p60f && s->scale >= 0x1p-60f;
}

void cgt_light_estimate_add(cgt_light_estimate *e, const cgt_scene *s, const cgt_light *light, const cgt_rays *points,
                            uint64_t first, uint64_t count)
{
    if (!count)
        return;
    e->samples++;
    const uint64_t prims =
        cgt_light_allows_tiles(&s->committed_scene)
            ? s->context->kernel->light_prims(&s->committed_scene, points, light, first, first + count)
            : UINT32_MAX;
    if (prims == UINT32_MAX) {
        e->unserved++;
        return;
    }
    e->few += prims <= FEW_PRIMS * count;
    e->points += count;
    e->prims += prims;
}

/* ---- memory ---- */

static uint32_t hash_light(const cgt_light *light)
{
    uint32_t word[3], hash = (uint32_t)light->kind;
    memcpy(word, light->position, sizeof word);
    for (int a = 0; a < 3; a++)
        hash = (hash ^ word[a]) * 0x9e3779b1u;
    return hash >> 28;
}
_Static_assert(CGT_LIGHT_HASHES == 16, "four bits of the hash");

/* Few primitives, up to four times as many, and so on. */
static uint32_t estimate_class(const cgt_light_estimate *e)
{
    uint32_t k = 0;
    for (uint64_t limit = FEW_PRIMS * e->points; k + 1 < CGT_LIGHT_ESTIMATES && e->prims > limit; limit *= 4)
        k++;
    return k;
}

void cgt_light_remember(cgt_light_progress *progress, const cgt_scene *s, const cgt_counts *counts, uint64_t points,
                        bool done)
{
    const uint64_t lanes = s->context->kernel->lanes;
    const uint64_t counted = CGT_LIGHT_REFERENCE_WORK * counts->references + counts->ray_tests / lanes +
                             (APART_WORK - 1) * counts->apart_work;
    const uint64_t work = counted * lanes / 16;
    cgt_light_experience *x = progress->experience;
    if (x && counts->table_read) {
        atomic_fetch_add_explicit(&x->table_read, counts->table_read, memory_order_relaxed);
        atomic_fetch_add_explicit(&x->table_kept, counts->table_kept, memory_order_relaxed);
        cgt_set_flag(&progress->history->used);
    }
    if (!progress->budget || !points)
        return;
    atomic_fetch_add_explicit(&progress->tried, points, memory_order_relaxed);
    atomic_fetch_add_explicit(&progress->spent, work, memory_order_relaxed);
    atomic_fetch_add_explicit(&x->work, work, memory_order_relaxed);
    /* a task that was given up has traced part of its points: at least the budget for each */
    const uint64_t traced = done ? points : work / progress->budget;
    atomic_fetch_add_explicit(&x->points, traced, memory_order_relaxed);
    if (progress->ordered) {
        atomic_fetch_add_explicit(&progress->history->ordered.work, work, memory_order_relaxed);
        atomic_fetch_add_explicit(&progress->history->ordered.points, traced, memory_order_relaxed);
    }
    cgt_set_flag(&progress->history->used);
}

cgt_trace_settings cgt_light_task_settings(const cgt_trace_settings *settings, const cgt_light_progress *progress)
{
    const cgt_light_experience *x = progress->experience;
    cgt_trace_settings of_task = *settings;
    if (!settings->light_tiles || !x)
        return of_task;
    const uint64_t read = atomic_load_explicit(&x->table_read, memory_order_relaxed),
                   kept = atomic_load_explicit(&x->table_kept, memory_order_relaxed);
    of_task.light_tables = read >= TABLE_TRIAL && (double)kept < TABLE_KEEPS * (double)read;
    return of_task;
}

bool cgt_light_is_hopeless(const cgt_light_progress *progress)
{
    const uint64_t tried = atomic_load_explicit(&progress->tried, memory_order_relaxed);
    if (!progress->budget || tried < progress->least_tried)
        return false;
    const uint64_t spent = atomic_load_explicit(&progress->spent, memory_order_relaxed);
    const uint64_t allowance = progress->ordered ? tried * progress->allowance / progress->points : progress->allowance;
    return spent > allowance + progress->tree_work * tried ||
           2 * atomic_load_explicit(&progress->given_up, memory_order_relaxed) > tried;
}

/* ---- choices ---- */

/* The work that a tree's building takes. */
static uint64_t build_work(const cgt_scene *s) { return (uint64_t)BUILD_WORK * s->committed_scene.valid; }

/* What a point through a BVH takes. */
static uint32_t tree_work(const cgt_scene *s)
{
    return s->committed_scene.valid < SMALL_PRIMS ? SMALL_TREE_WORK : TREE_WORK;
}

/* As many rays as ask for a BVH where the excess has paid for it. Where the grid has regions, other ways are slow, too. */
static uint64_t rays_of_excess(const cgt_scene *s, uint64_t excess)
{
    if (s->committed_scene.loose.regions)
        return excess / RAY_WORK;
    return excess >= build_work(s) ? s->committed_scene.valid : 0;
}

/* The budget of a first trial: a share of what a tree would cost, where one is missing. */
static uint32_t trial_budget(const cgt_scene *s, uint64_t points, bool has_tree)
{
    if (has_tree)
        return 2 * tree_work(s);
    const uint64_t share = build_work(s) / TRIAL_SHARE / (points ? points : 1);
    return share < LEAST_BUDGET ? LEAST_BUDGET : share > CGT_LIGHT_MAX_WORK ? CGT_LIGHT_MAX_WORK : (uint32_t)share;
}

/* The work of a point by tiles up to which they serve. */
static uint64_t work_limit(const cgt_scene *s, bool has_tree, const cgt_light_progress *progress)
{
    if (!progress->ordered)
        return has_tree ? progress->tree_work : CGT_LIGHT_MAX_WORK;
    return progress->tree_work + (has_tree ? 0 : build_work(s) / progress->points);
}

/* Where there is a tree: whether tiles are worth a trial on points in order. What they took of other lights tells, or
 * else the estimate, which is less than what they meet. */
static bool tiles_may_serve(const cgt_light_estimate *e, uint64_t limit, const cgt_light_progress *progress)
{
    const cgt_light_experience *all = &progress->history->ordered;
    const uint64_t points = atomic_load_explicit(&all->points, memory_order_relaxed);
    const uint64_t work = atomic_load_explicit(&all->work, memory_order_relaxed);
    return points ? work <= limit * points : CGT_LIGHT_REFERENCE_WORK * e->prims <= limit * e->points;
}

/* When tiles end: a task by its budget, and all by what a tree would take. */
static void bound_tiles(const cgt_scene *s, uint64_t limit, bool has_tree, cgt_light_progress *progress)
{
    progress->allowance = has_tree ? progress->tree_work * CGT_RAYS_CHUNK : build_work(s);
    progress->least_tried = 0;
    if (!progress->ordered)
        return;
    const uint64_t most = limit * ORDERED_BUDGET;
    const uint32_t bounded = most < LEAST_BUDGET         ? LEAST_BUDGET
                             : most > CGT_LIGHT_MAX_WORK ? CGT_LIGHT_MAX_WORK
                                                         : (uint32_t)most;
    progress->budget = progress->budget ? bounded : 0;
    progress->allowance = has_tree ? 0 : build_work(s);
    progress->least_tried = progress->points / ORDERED_SHARE;
}

/* Tiles as the estimate and earlier calls speak for them. */
static void choose_tiles(const cgt_scene *s, const cgt_light_estimate *e, uint64_t points, cgt_trace_settings *settings,
                         cgt_light_progress *progress)
{
    const uint64_t tried = atomic_load_explicit(&progress->experience->points, memory_order_relaxed);
    const uint64_t work = atomic_load_explicit(&progress->experience->work, memory_order_relaxed);
    const bool may_give_up = s->options.structure == CGT_STRUCTURE_AUTO;
    const uint64_t limit = work_limit(s, settings->use_bvh, progress);
    if (tried && may_give_up) {
        settings->light_tiles = work <= limit * tried;
        settings->light_way = settings->light_tiles ? CGT_LIGHT_WAY_REMEMBERED : CGT_LIGHT_WAY_REMEMBERED_WORK;
        progress->budget = settings->light_tiles ? CGT_LIGHT_MAX_WORK : 0;
    } else {
        const bool hopes = !progress->ordered || !settings->use_bvh || tiles_may_serve(e, limit, progress);
        const bool tries = may_give_up && hopes && points >= LEAST_TRIED;
        settings->light_tiles = (progress->few && (hopes || !may_give_up)) || tries;
        settings->light_way = progress->few ? CGT_LIGHT_WAY_FEW : tries ? CGT_LIGHT_WAY_TRIED : CGT_LIGHT_WAY_MANY;
        progress->budget = !may_give_up    ? 0
                           : progress->few ? CGT_LIGHT_MAX_WORK
                           : tries         ? trial_budget(s, points, settings->use_bvh)
                                           : 0;
    }
    bound_tiles(s, limit, settings->use_bvh, progress);
    settings->max_light_work = progress->budget;
}

static void begin_pass(cgt_light_progress *progress)
{
    atomic_store_explicit(&progress->tried, 0, memory_order_relaxed);
    atomic_store_explicit(&progress->given_up, 0, memory_order_relaxed);
    atomic_store_explicit(&progress->untried, 0, memory_order_relaxed);
    atomic_store_explicit(&progress->spent, 0, memory_order_relaxed);
}

/* Counts points that go through the BVH instead of tiles. */
static void count_tree_points(cgt_light_progress *progress, uint64_t points)
{
    atomic_fetch_add_explicit(&progress->experience->tree_points, points, memory_order_relaxed);
    cgt_set_flag(&progress->history->used);
}

cgt_result cgt_light_choose(const cgt_scene *s, const cgt_light *light, const cgt_light_estimate *e, uint64_t points,
                            cgt_trace_settings *settings, cgt_light_progress *progress)
{
    cgt_light_history *history = &s->mutable_scene->light_history;
    const bool serves = 2 * e->unserved < e->samples;
    progress->history = history;
    progress->ordered = e->ordered && points;
    progress->points = points;
    progress->tree_work = progress->ordered ? ORDERED_TREE_WORK : tree_work(s);
    atomic_store_explicit(&history->build_work, build_work(s), memory_order_relaxed);
    atomic_store_explicit(&history->tree_work, tree_work(s), memory_order_relaxed);
    progress->budget = 0;
    progress->few = 2 * e->few > e->samples;
    begin_pass(progress);
    settings->light_tiles = false;
    settings->max_light_work = 0;
    settings->light_way = CGT_LIGHT_WAY_UNSERVED;
    if (serves) {
        progress->experience = &history->of[hash_light(light)][progress->few ? 0 : estimate_class(e)];
        const bool wants_tree = s->options.structure == CGT_STRUCTURE_AUTO &&
                                atomic_load_explicit(&progress->experience->wants_tree, memory_order_relaxed);
        const uint64_t rays =
            wants_tree ? s->committed_scene.valid : rays_of_excess(s, cgt_light_history_excess(history));
        const cgt_result result = cgt_bvh_build_on_demand(s, rays, &settings->use_bvh);
        if (result != CGT_OK)
            return result;
        if (wants_tree && settings->use_bvh) {
            settings->light_way = CGT_LIGHT_WAY_REMEMBERED_WORK;
            count_tree_points(progress, points);
            return CGT_OK;
        }
        choose_tiles(s, e, points, settings, progress);
        if (settings->light_tiles)
            return CGT_OK;
    }
    const uint64_t rays = serves && progress->few ? points * SCATTERED_POINTS : points;
    const cgt_result result = cgt_bvh_build_on_demand(s, rays, &settings->use_bvh);
    settings->light_tiles = serves && (progress->few || progress->ordered) && !settings->use_bvh; /* with any work */
    if (serves && settings->use_bvh)
        count_tree_points(progress, points);
    return result;
}

/* What tiles will probably take for what was given up, beyond a tree: up to `next` for each point that was tried, and as
 * much as others took for each that was not. */
static uint64_t expect_excess(const cgt_light_progress *progress, uint64_t next)
{
    const uint64_t tried = atomic_load_explicit(&progress->tried, memory_order_relaxed),
                   spent = atomic_load_explicit(&progress->spent, memory_order_relaxed),
                   given_up = atomic_load_explicit(&progress->given_up, memory_order_relaxed),
                   untried = atomic_load_explicit(&progress->untried, memory_order_relaxed);
    const uint64_t mean = tried ? spent / tried : next, tree = progress->tree_work;
    return next * (given_up - untried) + (mean > tree ? (mean - tree) * untried : 0);
}

cgt_result cgt_light_choose_again(const cgt_scene *s, cgt_trace_settings *settings, cgt_light_progress *progress)
{
    const uint64_t given_up = atomic_load_explicit(&progress->given_up, memory_order_relaxed);
    const uint64_t next = (uint64_t)progress->budget * RETRY_FACTOR;
    const uint64_t expected = expect_excess(progress, next);
    /* more work for what remains may cost less than a tree */
    const bool retries = progress->budget && !progress->ordered && !settings->use_bvh && given_up >= LEAST_TRIED &&
                         expected <= build_work(s) / RETRY_SHARE;
    const uint64_t rays = retries                              ? expected / RAY_WORK
                          : progress->few || progress->ordered ? given_up * SCATTERED_POINTS
                                                               : given_up;
    const cgt_result result = cgt_bvh_build_on_demand(s, rays, &settings->use_bvh);
    begin_pass(progress);
    settings->light_way = CGT_LIGHT_WAY_GIVEN_UP;
    if (retries && !settings->use_bvh) {
        progress->budget = settings->max_light_work = (uint32_t)next;
        return result;
    }
    settings->light_tiles = (progress->few || progress->ordered) && !settings->use_bvh;
    if (settings->use_bvh)
        count_tree_points(progress, given_up);
    progress->budget = settings->max_light_work = 0;
    return result;
}
