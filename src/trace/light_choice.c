/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See light_choice.h. */
#include "trace/light_choice.h"

#include "builders/bvh/bvh_on_demand.h"
#include "core/float_environment.h"
#include "query/tile_limits.h"

#define FEW_POINTS 256u /* fewer go through a BVH if there is one */

static uint64_t read(const _Atomic uint64_t *number) { return atomic_load_explicit(number, memory_order_relaxed); }

cgt_light_account cgt_light_account_now(const cgt_light_choice *choice)
{
    cgt_light_account a = choice->begin;
    a.tried = (double)read(&choice->tried);
    a.spent = (double)read(&choice->work);
    a.given_up = (double)read(&choice->given_up);
    return a;
}

static void begin(const cgt_scene *s, uint64_t points, cgt_light_choice *choice)
{
    const cgt_frame_record *record = &s->mutable_scene->record;
    const uint64_t left = cgt_bvh_rays_left(s);
    const double owed = s->expects_tree && left < UINT32_MAX ? 0 : CGT_LIGHT_RAY_PRICE * (double)left,
                 paid = (double)read(&record->light_excess);
    choice->begin = (cgt_light_account){.points = (double)points,
                                        .spread = cgt_light_spread((double)s->committed_scene.valid, (double)points),
                                        .price = owed > paid ? owed - paid : 0};
    atomic_store_explicit(&choice->tried, 0, memory_order_relaxed);
    atomic_store_explicit(&choice->work, 0, memory_order_relaxed);
    atomic_store_explicit(&choice->given_up, 0, memory_order_relaxed);
}

cgt_result cgt_light_choose(const cgt_scene *s, const cgt_light *light, uint64_t points, cgt_trace_settings *settings,
                            cgt_light_choice *choice)
{
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    const bool serves = cgt_tile_supports_light(&s->committed_scene, light);
    cgt_float_environment_leave(&callers);
    const cgt_result result = cgt_bvh_build_on_demand(s, serves ? 0 : points, &settings->use_bvh);
    const bool gave_up = cgt_flag_is_set(&s->mutable_scene->record.light_gave_up);
    cgt_set_flag(&cgt_whole_scene(s->mutable_scene)->record.points);
    begin(s, points, choice);
    /* a call of several tasks asks the first of them, whatever other lights gave up */
    const bool by_tree = settings->use_bvh && (points < FEW_POINTS || (gave_up && points <= CGT_RAYS_CHUNK));
    settings->light_tiles = serves && !by_tree;
    settings->light_way = !serves ? CGT_LIGHT_WAY_UNSERVED : by_tree ? CGT_LIGHT_WAY_TREE : CGT_LIGHT_WAY_TILES;
    return result;
}

/* Adds a call's excess. What calls save is taken off, but never more than calls before have spent. */
static void add_excess(_Atomic uint64_t *excess, double more)
{
    uint64_t sum = read(excess), next;
    do
        next = more < 0 && (double)sum < -more ? 0 : sum + (uint64_t)(int64_t)more;
    while (!atomic_compare_exchange_weak_explicit(excess, &sum, next, memory_order_relaxed, memory_order_relaxed));
}

void cgt_light_add_work(cgt_light_choice *choice, const cgt_scene *s, const cgt_counts *counts, uint64_t points)
{
    atomic_fetch_add_explicit(&choice->tried, points, memory_order_relaxed);
    atomic_fetch_add_explicit(&choice->work, counts->light_work * s->context->kernel->lanes / 16, memory_order_relaxed);
}

cgt_result cgt_light_settle(const cgt_scene *s, cgt_trace_settings *settings, const cgt_light_choice *choice)
{
    const cgt_light_account a = cgt_light_account_now(choice);
    cgt_frame_record *record = &s->mutable_scene->record;
    const uint64_t left = cgt_bvh_rays_left(s);
    if (!settings->light_tiles)
        return CGT_OK;
    const double excess = a.spent - a.tried * cgt_light_tree_work(&a);
    const bool leaves = a.given_up > 0 && cgt_light_gain(&a, a.points) > 0;
    add_excess(&record->light_excess, leaves ? excess / fmax(a.tried, 1) * a.points : excess);
    if (leaves || a.points >= FEW_POINTS)
        cgt_set_flag(leaves ? &record->light_gave_up : &record->light_tiles);
    if (!(a.given_up > 0))
        return CGT_OK;
    settings->light_way = CGT_LIGHT_WAY_GIVEN_UP;
    settings->light_tiles = false;
    if (settings->use_bvh)
        return CGT_OK;
    return cgt_bvh_build_on_demand(s, leaves && left ? left : CGT_LIGHT_SCATTERED_RAYS * read(&choice->given_up),
                                   &settings->use_bvh);
}
