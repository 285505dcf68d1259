/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against a light, in orders that tiles like or not, and their rays as an array. */
#include <math.h>
#include <string.h>

#include "driver/calls/view.h"

/* ---- points ---- */

/* In what order points come. */
typedef enum lit_order {
    LIT_ANYHOW, /* beside the one before, at a surface, or anywhere */
    LIT_SHEET,  /* neighbours side by side */
    LIT_PLACES, /* those of the primitives, in their order */
    LIT_ORDERS
} lit_order;

/* A sheet through the scene, a little bent. */
typedef struct lit_sheet {
    float side[2][3];
    uint32_t columns;
} lit_sheet;

static lit_sheet make_sheet(driver_run *run, const driver_view *w)
{
    test_random *const r = &run->scene.random;
    const float size = run->scene.scale * (random_below(r, 3) ? 2 : random_log(r, 0.01f, 2));
    lit_sheet s = {.columns = 1 + (uint32_t)sqrtf((float)w->lit)};
    for (int k = 0; k < 2; k++) {
        random_direction(r, s.side[k]);
        for (int a = 0; a < 3; a++)
            s.side[k][a] *= size;
    }
    return s;
}

static void place_on_sheet(const driver_run *run, const lit_sheet *s, uint32_t i, float p[3])
{
    const float x = (float)(i % s->columns) / (float)s->columns - 0.5f,
                y = (float)(i / s->columns) / (float)s->columns - 0.5f;
    for (int a = 0; a < 3; a++)
        p[a] = run->scene.middle[a] + x * s->side[0][a] + y * s->side[1][a] + 0.05f * sinf(5 * x) * s->side[0][a];
}

static void place_anyhow(driver_run *run, const driver_view *w, uint32_t i, float p[3])
{
    test_random *const r = &run->scene.random;
    if (i < DRIVER_POINTS)
        memcpy(p, run->point[i], 3 * sizeof *p);
    else if (i % 64 && random_below(r, 2))
        for (int a = 0; a < 3; a++)
            p[a] = w->to_lit[i - 1].line.org[a] + 1e-3f * run->scene.scale * random_float(r, -1, 1);
    else
        line_place(&run->scene, p);
}

/* A few are none, and some have no range. */
static void spoil(driver_run *run, const driver_view *w, uint32_t i, float p[3])
{
    static const float odd[] = {NAN, INFINITY, -INFINITY, 0x1p60f, -0x1p100f, 0x1p-140f};
    test_random *const r = &run->scene.random;
    if (i % 90 == 89)
        p[random_below(r, 3)] = odd[random_below(r, TEST_COUNT(odd))];
    if (i % 200 == 60)
        memcpy(p, w->light[0].position, 3 * sizeof *p);
}

static void shuffle(test_random *r, judge_ray *ray, uint32_t count)
{
    for (uint32_t i = count; i > 1; i--) {
        const uint32_t k = random_below(r, i);
        const judge_ray last = ray[i - 1];
        ray[i - 1] = ray[k];
        ray[k] = last;
    }
}

static void make_points(driver_run *run, driver_view *w)
{
    test_random *const r = &run->scene.random;
    const lit_order order = driver_samples(run) ? (lit_order)random_below(r, LIT_ORDERS) : LIT_ANYHOW;
    const lit_sheet sheet = make_sheet(run, w);
    const uint32_t from = random_below(r, 1 + run->scene.count);
    const bool spoils = order == LIT_ANYHOW || random_below(r, 4) == 0;
    for (uint32_t i = 0; i < w->lit; i++) {
        float p[3];
        if (order == LIT_SHEET)
            place_on_sheet(run, &sheet, i, p);
        else if (order == LIT_PLACES && run->scene.count)
            memcpy(p, run->scene.primitive[(from + i) % run->scene.count].data, sizeof p);
        else
            place_anyhow(run, w, i, p);
        if (spoils)
            spoil(run, w, i, p);
        w->to_lit[i] = driver_ray_to(&w->light[0], p);
    }
    if (order != LIT_ANYHOW && random_below(r, 5) == 0)
        shuffle(r, w->to_lit, w->lit);
}

void driver_points_begin(driver_run *run, driver_view *w)
{
    test_random *const r = &run->scene.random;
    const uint32_t most = run->profile->lit > DRIVER_POINTS ? run->profile->lit - DRIVER_POINTS : 0;
    w->lit = DRIVER_POINTS + (most && random_below(r, 2) ? most : random_below(r, 1 + most));
    w->lit_ranges = driver_samples(run) ? random_below(r, 4) == 0 : random_below(r, 2);
    w->lit_every = driver_every(run, w->lit, run->profile->pixels ? DRIVER_SAMPLE : DRIVER_LIT_SAMPLE);
    w->lit_masks = run->profile->masks && random_below(r, 4) == 0;
    w->lit_skips = run->profile->skips && random_below(r, 4);
    make_points(run, w);
    for (uint32_t i = 0; i < w->lit; i++) {
        judge_ray *const ray = &w->to_lit[i];
        if (w->lit_ranges && i % 3 == 0)
            ray->line.t_min = random_float(r, -0.5f, 0.5f);
        if (w->lit_ranges && i % 5 == 0)
            ray->line.t_max = random_below(r, 4) ? random_float(r, 0, 2) : -1;
        if (w->lit_masks)
            ray->mask = run->point_mask[i % DRIVER_POINTS];
        if (w->lit_skips)
            driver_filter(run, ray, NULL);
    }
}

/* ---- what they skip ---- */

/* Points skip what they meet, or their neighbours do; or a primitive of the geometry before, or a number that would be
 * it behind the last one of that. */
static void skip_hit(driver_run *run, judge_ray *ray, const full_hit *hit, uint32_t way)
{
    ray->skip_primitive = CGT_INVALID_ID;
    ray->skip_geometry = 0;
    if (hit->primitive == CGT_INVALID_ID)
        return;
    run->count[COUNT_SKIPPING]++;
    ray->skip_geometry = hit->geometry;
    ray->skip_primitive = hit->primitive;
    if (way < 2 || !hit->geometry)
        return;
    const uint32_t count = run->scene.geometry[--ray->skip_geometry].count;
    ray->skip_primitive =
        count && random_below(&run->scene.random, 2) ? random_below(&run->scene.random, count) : count + hit->primitive;
}

/* Point by point, by turns of 64, so that vectors agree, or in one way. */
static void skip_hits(driver_run *run, driver_view *w)
{
    static full_hit hit[DRIVER_LIT];
    test_random *const r = &run->scene.random;
    const cgt_rays rays = driver_ray_array(w->to_lit, w->lit);
    const cgt_hits hits = hit_array(hit);
    const uint32_t turn = (uint32_t[]){1, 64, DRIVER_LIT, DRIVER_LIT}[random_below(r, 4)];
    if (!driver_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &hits, NULL), "cgt_trace_rays"))
        return;
    uint32_t way = 0;
    for (uint32_t i = 0; i < w->lit; i++) {
        if (i % turn == 0)
            way = turn == DRIVER_LIT && random_below(r, 2) ? 2 : random_below(r, 5);
        if (way < 3)
            skip_hit(run, &w->to_lit[i], &hit[way == 1 && i ? i - 1 : i], way);
    }
}

/* Some ranges end at what is met, or a few steps of a float beside that. */
static void end_at_hits(driver_run *run, driver_view *w)
{
    static full_hit hit[DRIVER_LIT];
    test_random *const r = &run->scene.random;
    const cgt_rays rays = driver_ray_array(w->to_lit, w->lit);
    const cgt_hits hits = hit_array(hit);
    if (!driver_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &hits, NULL), "cgt_trace_rays"))
        return;
    for (uint32_t i = random_below(r, 5); i < w->lit; i += 1 + random_below(r, 8))
        if (hit[i].primitive != CGT_INVALID_ID)
            w->to_lit[i].line.t_max = hit[i].t * (1 + ((float)random_below(r, 17) - 8) * 0x1p-23f);
}

/* ---- answers ---- */

static void find_shadows(driver_run *run, driver_view *w)
{
    if (w->lit_ranges)
        end_at_hits(run, w);
    if (w->lit_skips && driver_samples(run) && random_below(&run->scene.random, 6))
        skip_hits(run, w);
    for (uint32_t i = 0; i < w->lit; i++)
        if (driver_is_one_of(w->lit_every, i))
            w->lit_shadow[i] = driver_trace(run, &w->to_lit[i], JUDGE_SHADOW, false);
}

/* In arrays of their own, without gaps. */
typedef struct dense_points {
    float at[3][DRIVER_LIT], t_min[DRIVER_LIT], t_max[DRIVER_LIT];
    uint32_t mask[DRIVER_LIT], primitive[DRIVER_LIT], geometry[DRIVER_LIT];
} dense_points;

static cgt_points copy_points(const driver_view *w, uint32_t count, dense_points *to)
{
    for (uint32_t i = 0; i < count; i++) {
        const judge_ray *const r = &w->to_lit[i];
        for (int a = 0; a < 3; a++)
            to->at[a][i] = r->line.org[a];
        to->t_min[i] = r->line.t_min;
        to->t_max[i] = r->line.t_max;
        to->mask[i] = r->mask;
        to->primitive[i] = r->skip_primitive;
        to->geometry[i] = r->skip_geometry;
    }
    return (cgt_points){
        count, 0, 0, {to->at[0], to->at[1], to->at[2]}, to->t_min, to->t_max, to->mask, to->primitive, to->geometry};
}

/* As they are, with positions as triples, or dense. */
static cgt_points points_of(driver_run *run, const driver_view *w, uint32_t count)
{
    static float place[3 * DRIVER_LIT];
    static dense_points dense;
    const judge_ray *const r = w->to_lit;
    const uint32_t how = random_below(&run->scene.random, 3);
    const float *const p = how ? r->line.org : place;
    for (uint32_t i = 0; i < count && !how; i++)
        memcpy(place + 3 * i, r[i].line.org, 3 * sizeof *place);
    cgt_points points = {.count = count,
                         .stride = sizeof *r,
                         .vector_stride = how ? 0 : 3 * sizeof *place,
                         .position = {p, p + 1, p + 2},
                         .t_min = &r->line.t_min,
                         .t_max = &r->line.t_max,
                         .mask = &r->mask,
                         .skip_primitive = &r->skip_primitive,
                         .skip_geometry = &r->skip_geometry};
    if (how == 2)
        points = copy_points(w, count, &dense);
    points.t_min = w->lit_ranges ? points.t_min : NULL;
    points.t_max = w->lit_ranges ? points.t_max : NULL;
    points.mask = w->lit_masks ? points.mask : NULL;
    points.skip_primitive = w->lit_skips ? points.skip_primitive : NULL;
    points.skip_geometry = w->lit_skips ? points.skip_geometry : NULL;
    return points;
}

/* As rays, too: a point that is its light's place has none. */
void driver_points_ask(driver_run *run, driver_view *w)
{
    static uint8_t occluded[DRIVER_LIT + 1], by_rays[DRIVER_LIT];
    if (!run->setup.number)
        find_shadows(run, w);
    const judge_ray *const r = w->to_lit;
    const uint32_t count = random_below(&run->scene.random, 4) ? w->lit : 1 + random_below(&run->scene.random, w->lit);
    const cgt_points points = points_of(run, w, count);
    const cgt_rays rays = driver_ray_array(r, count);
    cgt_trace_statistics statistics[2];
    test_trace_options o = driver_options(run, (cgt_precision)random_below(&run->scene.random, 2));
    uint64_t hits = 0;
    memset(occluded, 9, sizeof occluded);
    memset(by_rays, 0x5a, sizeof by_rays);
    o.statistics = &statistics[0];
    if (!driver_succeeds(run, cgt_occluded_points(run->setup.scene, &w->light[0], &points, occluded, TRACE_OPTIONS(&o)),
                         "cgt_occluded_points"))
        return;
    o.statistics = &statistics[1];
    if (!driver_succeeds(run, cgt_occluded_rays(run->setup.scene, &rays, by_rays, TRACE_OPTIONS(&o)),
                         "cgt_occluded_rays"))
        return;
    run->count[COUNT_ANSWERS] += 2 * count;
    for (uint32_t i = 0; i < count; i++) {
        hits += occluded[i] == 1;
        if ((driver_is_one_of(w->lit_every, i) && !driver_is_occluded(run, &w->lit_shadow[i], occluded[i])) ||
            by_rays[i] != occluded[i])
            driver_fail(run, &w->to_lit[i], "cgt_occluded_points", "%u, its ray %u", occluded[i], by_rays[i]);
    }
    if (occluded[count] != 9 || statistics[0].invalid_rays != statistics[1].invalid_rays)
        driver_fail(run, NULL, "cgt_occluded_points", "one too many, or %llu invalid, of its rays %llu",
                    (unsigned long long)statistics[0].invalid_rays, (unsigned long long)statistics[1].invalid_rays);
    driver_check_statistics(run, &statistics[0], count, hits);
    run->count[COUNT_LIT] += count;
    run->count[COUNT_LIT_OCCLUDED] += hits;
    run->count[COUNT_LIT_TILES] += statistics[0].tiles;
}

static void begin(driver_run *run)
{
    driver_shadows_begin(run, run->view);
    driver_points_begin(run, run->view);
}

static void ask(driver_run *run) { driver_points_ask(run, run->view); }

const driver_call call_points = {begin, ask};
