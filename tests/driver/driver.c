/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One scene by a profile: rays and their right answers, then all loads and all calls. */
#include "driver/driver.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/hard_rays.h"

/* ---- reports ---- */

void driver_fail(driver_run *run, const judge_ray *ray, const char *call, const char *format, ...)
{
    va_list arguments;
    run->bad++;
    if (run->scene_bad++ >= 3 || run->bad_scenes > 20) /* of a scene, a few will do */
        return;
    run->bad_scenes += run->scene_bad == 1;
    va_start(arguments, format);
    printf("scene %u (%s), %s: %s: ", (unsigned)run->scene.number, run->scene.family, run->setup.name, call);
    vprintf(format, arguments);
    va_end(arguments);
    if (ray)
        printf("; org %a %a %a dir %a %a %a range %a %a mask %u skips %d.%d", (double)ray->line.org[0],
               (double)ray->line.org[1], (double)ray->line.org[2], (double)ray->line.dir[0], (double)ray->line.dir[1],
               (double)ray->line.dir[2], (double)ray->line.t_min, (double)ray->line.t_max, (unsigned)ray->mask,
               (int)ray->skip_geometry, (int)ray->skip_primitive);
    printf("; again, with the seed above: hits%s %s %u 1", clusters_always() ? "_clusters" : "", run->profile->name,
           (unsigned)run->scene.number);
    if (run->family != SCENE_ANY_FAMILY)
        printf(" %u", (unsigned)run->family);
    printf("\n");
    fflush(stdout);
}

bool driver_succeeds(driver_run *run, cgt_result result, const char *call)
{
    run->count[COUNT_CALLS]++;
    if (result != CGT_OK)
        driver_fail(run, NULL, call, "%s", context_message(run->setup.context));
    return result == CGT_OK;
}

void driver_count(driver_run *run, const cgt_trace_statistics *s)
{
    run->count[COUNT_TRACED] += s->rays;
    run->count[COUNT_INVALID] += s->invalid_rays;
    run->count[COUNT_BVH] += s->bvh_rays;
    run->count[COUNT_PACKETS] += s->packets;
    run->count[COUNT_TESTS] += s->ray_tests;
    run->count[COUNT_DOUBLE] += s->double_tests;
    run->count[COUNT_EXACT] += s->exact_tests;
    run->count[COUNT_EXACT_VALUES] += s->exact_values;
}

void driver_check_statistics(driver_run *run, const cgt_trace_statistics *s, uint64_t rays, uint64_t hits)
{
    if (s->rays != rays || s->hits != hits || s->exact_tests > s->double_tests)
        driver_fail(run, NULL, "statistics", "%llu rays, %llu hits, %llu tests in double, %llu exact; %llu, %llu",
                    (unsigned long long)s->rays, (unsigned long long)s->hits, (unsigned long long)s->double_tests,
                    (unsigned long long)s->exact_tests, (unsigned long long)rays, (unsigned long long)hits);
    driver_count(run, s);
}

judge_truth driver_trace(driver_run *run, const judge_ray *ray, judge_question question, bool values)
{
    const judge_truth truth = judge_trace(&run->scene, ray, question, values, &run->pool);
    bool doubtful = false;
    for (uint32_t i = 0; i < truth.count; i++)
        doubtful |= run->pool.hit[truth.first + i].doubtful;
    run->count[COUNT_JUDGED]++;
    run->count[COUNT_DOUBTFUL] += doubtful;
    return truth;
}

bool driver_is_occluded(const driver_run *run, const judge_truth *right, uint8_t occluded)
{
    return occluded ? right->count > 0 : judge_is_end(&run->pool, right, 0);
}

bool driver_has_crossings(const driver_run *run) { return !run->scene.of_kind[ORACLE_CAPSULE]; }

/* ---- rays ---- */

cgt_rays driver_ray_array(const judge_ray *r, uint32_t count)
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

bool driver_single(const judge_ray *ray, cgt_single_ray *single)
{
    *single = single_ray(&ray->line);
    single->mask = ray->mask;
    if (ray->line.t_max == INFINITY && ray->line.org[0] < ray->line.org[1])
        single->t_max = 0;
    static cgt_hit skip; /* one ray at a time */
    skip = (cgt_hit){.primitive = ray->skip_primitive, .geometry = ray->skip_geometry};
    single->skip = ray->skip_primitive != CGT_INVALID_ID ? &skip : NULL;
    return ray->line.t_max != 0;
}

/* One of `rate`; 0: none. */
static bool is_one_of(test_random *r, uint32_t rate) { return rate && random_below(r, rate) == 0; }

void driver_filter(driver_run *run, judge_ray *ray, const judge_truth *right)
{
    static const uint32_t nothing[] = {CGT_INVALID_ID, CGT_INVALID_ID - 1, 1000000, 99};
    test_random *const r = &run->scene.random;
    if (!is_one_of(r, run->profile->skips))
        return;
    ray->skip_primitive = random_below(r, 6) ? random_below(r, 6) : nothing[random_below(r, 4)];
    ray->skip_geometry = random_below(r, 6) ? random_below(r, run->scene.geometries + 1) : nothing[random_below(r, 4)];
    if (!right || !right->count || random_below(r, 3) == 0)
        return;
    const oracle_primitive *const p = &run->scene.primitive[run->pool.hit[right->first].index];
    ray->skip_primitive = p->primitive;
    ray->skip_geometry = p->geometry;
    run->count[COUNT_SKIPPING]++;
}

/* Ends or begins the range at a hit. */
static void cut_ray(driver_run *run, judge_ray *ray, const judge_truth *right)
{
    test_random *const r = &run->scene.random;
    if (!right->count || !run->cuts || !is_one_of(r, run->profile->cuts))
        return;
    const judge_hit *at = &run->pool.hit[right->first + random_below(r, right->count)];
    ray->line = hard_ray_cut(r, ray->line, (float)at->values.t);
    run->count[COUNT_CUT]++;
}

static void judge_ray_begin(driver_run *run, uint32_t i)
{
    test_random *const r = &run->scene.random;
    const judge_question question = i < DRIVER_LISTED ? JUDGE_ALL : JUDGE_NEAREST;
    judge_ray *const ray = &run->ray[i];
    ray->mask = is_one_of(r, run->profile->masks) ? random_below(r, 16) : 0;
    run->count[COUNT_MASKED] += ray->mask != 0;
    const judge_ray before = *ray;
    const uint32_t pool = run->pool.count;
    run->right[i] = driver_trace(run, ray, question, random_below(r, 2));
    cut_ray(run, ray, &run->right[i]);
    driver_filter(run, ray, &run->right[i]);
    if (memcmp(&before, ray, sizeof before) != 0) {
        run->pool.count = pool;
        run->right[i] = driver_trace(run, ray, question, random_below(r, 2));
    }
    run->count[COUNT_HITS] += run->right[i].count;
}

/* Each family of the profile makes a part of the rays, or one makes all, so that they are of one kind. */
static void make_rays(driver_run *run)
{
    const driver_profile *const p = run->profile;
    uint32_t families = 0;
    while (families < TEST_COUNT(p->lines) && p->lines[families])
        families++;
    run->rays = 1 + p->rays / 2 + random_below(&run->scene.random, p->rays / 2);
    for (uint32_t i = 0; i < run->rays; i++)
        run->ray[i] =
            (judge_ray){.line = {.t_max = INFINITY}, .skip_primitive = CGT_INVALID_ID, .skip_geometry = CGT_INVALID_ID};
    run->cuts = random_below(&run->scene.random, 3);
    const uint32_t parts = random_below(&run->scene.random, 2) ? families : 1;
    for (uint32_t k = 0; k < parts; k++) {
        const uint32_t from = run->rays * k / parts, to = run->rays * (k + 1) / parts;
        p->lines[(k + run->scene.number) % families](&run->scene, run->ray + from, to - from);
    }
    for (uint32_t i = 0; i < run->rays; i++)
        judge_ray_begin(run, i);
}

static void make_points(driver_run *run)
{
    test_random *const r = &run->scene.random;
    for (uint32_t i = 0; i < DRIVER_POINTS; i++) {
        if (i % 4)
            line_place(&run->scene, run->point[i]);
        for (int a = 0; a < 3 && i % 4 == 0; a++)
            run->point[i][a] =
                i % 8 ? run->scene.scale * line_gauss(r) : 0.5f * run->scene.step * ((float)random_below(r, 9) - 1);
        run->point_mask[i] = random_below(r, 4) ? 0 : random_below(r, 16);
    }
}

/* ---- scenes ---- */

/* In an order that turns: the first call may have to build a BVH. */
static void ask(driver_run *run)
{
    const driver_call *const *const calls = run->profile->calls;
    uint32_t count = 0;
    while (count < TEST_COUNT(run->profile->calls) && calls[count])
        count++;
    for (uint32_t k = 0; k < count; k++)
        calls[(k + run->scene.number + run->setup.number) % count]->ask(run);
}

void driver_run_scene(driver_run *run, test_random random, uint32_t number, uint32_t family)
{
    const driver_profile *const p = run->profile;
    scene_make(&run->scene, random, p->groups, number, family, p->primitives);
    if (clusters_always() && !run->scene.of_kind[ORACLE_TRIANGLE])
        return; /* as without clusters */
    run->family = family;
    run->scene_bad = 0;
    run->pool.count = 0;
    make_rays(run);
    make_points(run);
    for (uint32_t k = 0; k < TEST_COUNT(p->calls) && p->calls[k]; k++)
        if (p->calls[k]->begin)
            p->calls[k]->begin(run);
    for (uint32_t k = 0; k < p->loads; k++) {
        run->setup.number = k;
        driver_setup_make(run);
        ask(run);
        driver_setup_free(&run->setup);
    }
    run->count[COUNT_SCENES]++;
}

driver_run *driver_run_make(const driver_profile *profile)
{
    driver_run *run = calloc(1, sizeof *run);
    if (!run || !(run->view = driver_view_make())) {
        fprintf(stderr, "no memory\n");
        exit(2);
    }
    run->profile = profile;
    return run;
}

void driver_run_free(driver_run *run)
{
    driver_contexts_free();
    free(run->view);
    free(run->pool.hit);
    free(run);
}
