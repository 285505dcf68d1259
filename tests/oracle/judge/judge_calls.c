/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays and points: every call that takes them, one row each. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/hard_rays.h"
#include "oracle/judge/judge_run.h"

/* ---- reports ---- */

void judge_fail(judge_run *run, const judge_ray *ray, const char *call, const char *format, ...)
{
    va_list arguments;
    run->counts.bad++;
    if (run->scene_bad++ >= 3 || run->counts.bad_scenes > 20) /* of a scene, a few will do */
        return;
    run->counts.bad_scenes += run->scene_bad == 1;
    va_start(arguments, format);
    printf("scene %u (%s), %s: %s: ", (unsigned)run->scene.number, run->scene.family, run->setup.name, call);
    vprintf(format, arguments);
    va_end(arguments);
    if (ray)
        printf("; org %a %a %a dir %a %a %a range %a %a mask %u skips %d.%d", (double)ray->line.org[0],
               (double)ray->line.org[1], (double)ray->line.org[2], (double)ray->line.dir[0], (double)ray->line.dir[1],
               (double)ray->line.dir[2], (double)ray->line.t_min, (double)ray->line.t_max, (unsigned)ray->mask,
               (int)ray->skip_geometry, (int)ray->skip_primitive);
    printf("; again: oracle_scenes %u 1 %u, with the seed above\n", (unsigned)run->scene.number,
           (unsigned)run->scene.family_number);
    fflush(stdout);
}

bool judge_succeeds(judge_run *run, cgt_result result, const char *call)
{
    run->counts.calls++;
    if (result != CGT_OK)
        judge_fail(run, NULL, call, "%s", context_message(run->setup.context));
    return result == CGT_OK;
}

void judge_count(judge_run *run, const judge_truth *truth)
{
    bool doubtful = false;
    for (uint32_t i = 0; i < truth->count; i++)
        doubtful |= run->pool.hit[truth->first + i].doubtful;
    run->counts.rays++;
    run->counts.doubtful += doubtful;
}

/* ---- rays, and the right answers ---- */

bool judge_has_crossings(const judge_run *run) { return !run->scene.of_kind[ORACLE_CAPSULE]; }

/* Of open meshes all setups must say the same, whatever it is. */
static bool knows_inside(const judge_run *run)
{
    return judge_has_crossings(run) && (run->scene.closed || !run->scene.of_kind[ORACLE_TRIANGLE]);
}

/* Some rays are others again, in a range that ends or begins at a hit. */
static void cut_ray(judge_run *run, uint32_t i)
{
    const uint32_t from = random_below(&run->scene.random, i);
    const judge_truth *const right = &run->hits.right[from];
    if (!right->count)
        return;
    const judge_hit *at = &run->pool.hit[right->first + random_below(&run->scene.random, right->count)];
    run->ray[i] = run->ray[from];
    run->ray[i].line = hard_ray_cut(&run->scene.random, run->ray[from].line, (float)at->values.t);
}

void judge_rays_begin(judge_run *run)
{
    test_random *r = &run->scene.random;
    run->pool.count = 0;
    for (uint32_t i = 0; i < JUDGE_RAYS; i++) {
        run->ray[i] = judge_ray_make(&run->scene);
        if (i > JUDGE_RAYS / 2)
            cut_ray(run, i);
        run->hits.right[i] = judge_trace(&run->scene, &run->ray[i], JUDGE_ALL, random_below(r, 2), &run->pool);
        judge_count(run, &run->hits.right[i]);
        run->counts.hits += run->hits.right[i].count;
    }
    for (uint32_t i = 0; i < JUDGE_RAYS && judge_has_crossings(run); i++) {
        run->crossings.right[i] = judge_trace(&run->scene, &run->ray[i], JUDGE_CROSSINGS, false, &run->pool);
        judge_count(run, &run->crossings.right[i]);
        run->counts.crossings += run->crossings.right[i].count;
    }
    for (uint32_t i = 0; i < JUDGE_POINTS; i++) {
        if (i % 4)
            judge_place(&run->scene, run->point[i]);
        for (int a = 0; a < 3 && i % 4 == 0; a++)
            run->point[i][a] = i % 8 ? run->scene.scale * judge_gauss(r) : 0.5f * ((float)random_below(r, 9) - 1);
        run->point_mask[i] = random_below(r, 4) ? 0 : random_below(r, 16);
        for (int rule = 0; rule < 2 && knows_inside(run); rule++) {
            run->inside[rule][i] =
                judge_inside(&run->scene, run->point[i], run->point_mask[i], rule == CGT_INSIDE_PARITY);
            run->counts.inside += run->inside[rule][i];
            run->counts.rays++;
        }
    }
}

cgt_rays judge_ray_array(const judge_ray *r, uint32_t count)
{
    return (cgt_rays){.count = count,
                      .stride = sizeof *r,
                      .org = {&r->line.org[0], &r->line.org[1], &r->line.org[2]},
                      .dir = {&r->line.dir[0], &r->line.dir[1], &r->line.dir[2]},
                      .t_min = &r->line.t_min,
                      .t_max = &r->line.t_max,
                      .mask = &r->mask,
                      .skip_primitive = &r->skip_primitive,
                      .skip_geometry = &r->skip_geometry};
}

cgt_rays judge_asked_rays(const judge_run *run) { return judge_ray_array(run->ray, JUDGE_RAYS); }

bool judge_single(const judge_ray *ray, cgt_single_ray *single)
{
    *single = single_ray(&ray->line);
    single->mask = ray->mask;
    static cgt_hit skip; /* one ray at a time */
    skip = (cgt_hit){.primitive = ray->skip_primitive, .geometry = ray->skip_geometry};
    single->skip = ray->skip_primitive != CGT_INVALID_ID ? &skip : NULL;
    return ray->line.t_max != 0;
}

/* ---- the nearest hit, and any ---- */

/* By all hits: the first of them. */
static void judge_ray_hit(judge_run *run, uint32_t i, const full_hit *h, bool fast)
{
    const judge_answer answer = {
        h->t, h->primitive, h->geometry, {h->normal[0], h->normal[1], h->normal[2]}, {h->uv[0], h->uv[1]}};
    const char *wrong = judge_nearest(&run->scene, &run->pool, &run->hits.right[i], &run->ray[i], fast, &answer);
    run->counts.answers++;
    if (wrong)
        judge_fail(run, &run->ray[i], fast ? "cgt_trace_rays, fast" : "cgt_trace_rays", "%s: %d.%d at %a", wrong,
                   (int)h->geometry, (int)h->primitive, (double)h->t);
}

static bool is_occlusion(const judge_run *run, const judge_truth *right, uint8_t occluded)
{
    return occluded ? right->count > 0 : judge_is_end(&run->pool, right, 0);
}

static void check_alone(judge_run *run, const full_hit *hit, const uint8_t *occluded)
{
    for (uint32_t i = random_below(&run->scene.random, 3); i < JUDGE_RAYS; i += 3) {
        cgt_single_ray single;
        cgt_hit alone;
        bool any;
        if (!judge_single(&run->ray[i], &single) ||
            !judge_succeeds(run, cgt_trace_ray(run->setup.scene, &single, &alone, NULL), "cgt_trace_ray") ||
            !judge_succeeds(run, cgt_occluded_ray(run->setup.scene, &single, &any, NULL), "cgt_occluded_ray"))
            continue;
        const full_hit got = full_hit_of(&alone);
        run->counts.answers += 2;
        if (memcmp(&got, &hit[i], sizeof got) != 0 || any != occluded[i])
            judge_fail(run, &run->ray[i], "cgt_trace_ray", "one ray is %d.%d at %a, occluded %d, not as in the array",
                       (int)got.geometry, (int)got.primitive, (double)got.t, any);
    }
}

static void call_nearest(judge_run *run)
{
    full_hit hit[JUDGE_RAYS], fast[JUDGE_RAYS];
    uint8_t occluded[JUDGE_RAYS];
    const cgt_rays rays = judge_asked_rays(run);
    const cgt_hits hits = hit_array(hit), fast_hits = hit_array(fast);
    const cgt_trace_options quick = {.precision = CGT_PRECISION_FAST};
    const test_trace_options options = {.kd_traversal = run->setup.way->traversal};
    memset(occluded, 9, sizeof occluded);
    if (!judge_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &hits, TRACE_OPTIONS(&options)),
                        "cgt_trace_rays") ||
        !judge_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &fast_hits, &quick), "cgt_trace_rays") ||
        !judge_succeeds(run, cgt_occluded_rays(run->setup.scene, &rays, occluded, NULL), "cgt_occluded_rays"))
        return;
    for (uint32_t i = 0; i < JUDGE_RAYS; i++) {
        judge_ray_hit(run, i, &hit[i], false);
        judge_ray_hit(run, i, &fast[i], true);
        run->counts.answers++;
        if (!is_occlusion(run, &run->hits.right[i], occluded[i]) || occluded[i] != (hit[i].primitive != CGT_INVALID_ID))
            judge_fail(run, &run->ray[i], "cgt_occluded_rays", "%u", occluded[i]);
    }
    check_alone(run, hit, occluded);
}

/* ---- points inside ---- */

static void call_inside(judge_run *run)
{
    uint8_t inside[JUDGE_POINTS];
    const cgt_points points = {.count = JUDGE_POINTS,
                               .vector_stride = sizeof run->point[0],
                               .position = {&run->point[0][0], &run->point[0][1], &run->point[0][2]},
                               .mask = run->point_mask};
    for (int rule = 0; rule < 2; rule++) {
        const cgt_inside_options how = {.rule = (cgt_inside_rule)rule};
        memset(inside, 9, sizeof inside);
        const cgt_result result = cgt_points_inside(run->setup.scene, &points, &how, inside, NULL);
        if (!judge_has_crossings(run)) {
            if (result != CGT_ERROR_UNSUPPORTED)
                judge_fail(run, NULL, "cgt_points_inside", "capsules are not refused");
            continue;
        }
        if (!judge_succeeds(run, result, "cgt_points_inside"))
            continue;
        for (uint32_t i = 0; i < JUDGE_POINTS && knows_inside(run); i++)
            if (inside[i] != run->inside[rule][i])
                judge_fail(run, NULL, "cgt_points_inside", "rule %d: point %a %a %a mask %u is %u, not %u", rule,
                           (double)run->point[i][0], (double)run->point[i][1], (double)run->point[i][2],
                           (unsigned)run->point_mask[i], inside[i], run->inside[rule][i]);
        run->counts.answers += JUDGE_POINTS;
        if (!run->setup.number)
            memcpy(run->first_inside[rule], inside, sizeof inside);
        else if (memcmp(run->first_inside[rule], inside, sizeof inside) != 0)
            judge_fail(run, NULL, "cgt_points_inside", "not the bits of the first setup");
    }
}

/* ---- all calls ---- */

typedef void ray_call(judge_run *run);
static ray_call *const calls[] = {judge_all_hits_ask, judge_crossings_ask, call_nearest, call_inside};

/* In an order that turns with the scene: the first one may have to build a BVH. */
void judge_rays_ask(judge_run *run)
{
    for (uint32_t k = 0; k < TEST_COUNT(calls); k++)
        calls[(k + run->scene.number + run->setup.number) % TEST_COUNT(calls)](run);
}
