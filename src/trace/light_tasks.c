/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See light_tasks.h. Tasks are neighbours in the frame or in the light's order, and the first ones tell what the others
 * take: so they come in steps of about the golden section, which shares no divisor with their number. In bands they
 * come one after another, since a task's scratch memory there goes by its running number. */
#include "trace/light_tasks.h"

#include <math.h>

#define GIVEN_UP 0xffu /* the first result of a task that tiles gave up, until it is traced otherwise */

cgt_result cgt_check_light(cgt_context *c, const cgt_light *light)
{
    const float *const p = light->position;
    for (int a = 0; a < 3; a++)
        if (!isfinite(p[a]))
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: its position is not finite");
    if ((unsigned)light->kind > CGT_LIGHT_DIRECTIONAL)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: kind %d is unknown", (int)light->kind);
    if (light->kind == CGT_LIGHT_DIRECTIONAL && cgt_is_zero(p[0]) && cgt_is_zero(p[1]) && cgt_is_zero(p[2]))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: a direction of length zero");
    return CGT_OK;
}

/* ---- a task ---- */

/* By tiles as long as these serve. Bands choose for themselves. */
static bool trace_tiles(cgt_light_tasks *tasks, uint32_t index, const cgt_rays *points, uint64_t first, uint64_t end,
                        uint8_t *occluded, cgt_counts *counts)
{
    const cgt_scene *s = tasks->scene;
    const cgt_light_account account = cgt_light_account_now(&tasks->choice);
    cgt_trace_settings settings = *tasks->settings;
    if (tasks->bands)
        return cgt_bands_trace(tasks->bands, index % tasks->bands->slots, points, tasks->light, first, end, NULL,
                               occluded, counts);
    if (cgt_light_leaves_tiles(&account))
        return false;
    settings.max_light_work = cgt_light_budget(&account, (double)(end - first));
    const bool done = s->context->kernel->trace_light(&s->committed_scene, points, tasks->light, first, end, &settings,
                                                      occluded, counts);
    cgt_light_add_work(&tasks->choice, s, counts, end - first);
    return done;
}

bool cgt_light_trace_points(cgt_light_tasks *tasks, uint32_t index, const cgt_rays *points, uint64_t first,
                            uint64_t end, uint8_t *occluded, cgt_counts *counts)
{
    const cgt_scene *s = tasks->scene;
    cgt_trace_settings settings = *tasks->settings;
    counts->given_up += tasks->again ? end - first : 0;
    if (tasks->bands || settings.light_tiles) {
        if (trace_tiles(tasks, index, points, first, end, occluded, counts))
            return true;
        atomic_fetch_add_explicit(&tasks->choice.given_up, end - first, memory_order_relaxed);
        settings.light_tiles = false;
        if (tasks->bands || !settings.use_bvh)
            return false;
        counts->given_up += end - first;
    }
    settings.max_light_work = 0;
    return s->context->kernel->trace_light(&s->committed_scene, points, tasks->light, first, end, &settings, occluded,
                                           counts);
}

/* Whether a task's points will go through a tree that is not there yet: then they need not be read before. About as
 * many as in any other task. */
static bool waits_for_tree(cgt_light_tasks *tasks)
{
    const cgt_light_account account = cgt_light_account_now(&tasks->choice);
    const bool waits =
        !tasks->bands && tasks->settings->light_tiles && !tasks->settings->use_bvh && cgt_light_leaves_tiles(&account);
    if (waits)
        atomic_fetch_add_explicit(&tasks->choice.given_up, tasks->points / tasks->count + 1, memory_order_relaxed);
    return waits;
}

static void light_task(void *argument, uint32_t number, cgt_scratch *scratch)
{
    cgt_light_tasks *tasks = argument;
    const uint32_t index = (uint32_t)((uint64_t)number * tasks->step % tasks->count);
    uint8_t *result = tasks->first_result(tasks->owner, index);
    cgt_counts counts = {.scratch = scratch};
    if (tasks->again && *result != GIVEN_UP)
        return;
    if (waits_for_tree(tasks) ||
        !tasks->trace(tasks->owner, tasks, index, &counts)) { /* the work was done, the points were not */
        counts.rays = counts.hits = counts.invalid_rays = 0;
        *result = GIVEN_UP;
    }
    cgt_trace_counter_add(tasks->counter, &counts);
}

/* ---- all tasks ---- */

static uint32_t greatest_divisor(uint32_t a, uint32_t b) { return b ? greatest_divisor(b, a % b) : a; }

static uint32_t golden_step(uint32_t count)
{
    uint32_t step = count > 2 ? (uint32_t)(0.618 * count) : 1;
    while (greatest_divisor(step, count) != 1)
        step++;
    return step;
}

static uint64_t given_up(const cgt_light_tasks *tasks)
{
    return atomic_load_explicit(&tasks->choice.given_up, memory_order_relaxed);
}

static cgt_result run_structure(cgt_light_tasks *tasks)
{
    const cgt_scene *s = tasks->scene;
    cgt_result result = cgt_light_choose(s, tasks->light, tasks->points, tasks->settings, &tasks->choice);
    if (result == CGT_OK)
        result = cgt_run_scratch_tasks(s->context, light_task, tasks, tasks->count);
    const bool had_tree = tasks->settings->use_bvh;
    if (result == CGT_OK)
        result = cgt_light_settle(s, tasks->settings, &tasks->choice);
    tasks->again = true;
    if (result == CGT_OK && given_up(tasks) && !had_tree)
        result = cgt_run_scratch_tasks(s->context, light_task, tasks, tasks->count);
    return result;
}

/* By tiles, then what these gave up through BVHs, which are built for that. Rays of one direction go through BVHs at
 * once. */
static cgt_result run_bands(cgt_light_tasks *tasks)
{
    const cgt_scene *s = tasks->scene;
    cgt_band_call call;
    const bool by_tiles = tasks->light->kind == CGT_LIGHT_POINT && s->options.structure == CGT_STRUCTURE_AUTO;
    const uint64_t most = (uint64_t)tasks->count * tasks->most;
    cgt_result result = cgt_bands_begin(s, tasks->settings, most, tasks->most, &call);
    if (result == CGT_OK)
        result = cgt_bands_build_bvh(&call, by_tiles ? 0 : most);
    call.by_tiles = by_tiles;
    tasks->bands = &call;
    atomic_store_explicit(&tasks->choice.given_up, 0, memory_order_relaxed);
    if (result == CGT_OK)
        result = cgt_bands_run(&call, light_task, tasks, tasks->count);
    if (result == CGT_OK && given_up(tasks)) {
        call.by_tiles = false;
        tasks->again = true;
        result = cgt_bands_build_bvh(&call, given_up(tasks) * CGT_LIGHT_SCATTERED_RAYS);
        if (result == CGT_OK)
            result = cgt_bands_run(&call, light_task, tasks, tasks->count);
    } else if (by_tiles)
        cgt_set_flag(&s->mutable_scene->record.light_tiles);
    cgt_bands_end(&call);
    return result;
}

cgt_result cgt_light_run(cgt_light_tasks *tasks)
{
    tasks->step = tasks->scene->in_bands ? 1 : golden_step(tasks->count);
    tasks->again = false;
    tasks->bands = NULL;
    return tasks->scene->in_bands ? run_bands(tasks) : run_structure(tasks);
}
