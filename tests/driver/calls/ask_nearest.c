/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The nearest hit of each ray, and any: in arrays of any size and layout, one by one, and FAST. */
#include <math.h>
#include <string.h>

#include "driver/driver.h"

/* ---- arrays ---- */

/* The arrays of one call: those of run->ray, or each number in an array of its own; those that are the default for all
 * rays may be NULL. */
typedef struct ray_arrays {
    float number[8][DRIVER_RAYS];
    uint32_t id[3][DRIVER_RAYS];
    cgt_rays rays;
} ray_arrays;

static void copy_rays(const judge_ray *ray, uint32_t count, ray_arrays *a)
{
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 8; k++)
            memcpy(&a->number[k][i], (const char *)&ray[i].line + k * sizeof(float), sizeof(float));
        a->id[0][i] = ray[i].mask;
        a->id[1][i] = ray[i].skip_primitive;
        a->id[2][i] = ray[i].skip_geometry;
    }
    a->rays = (cgt_rays){.count = count,
                         .org = {a->number[0], a->number[1], a->number[2]},
                         .dir = {a->number[3], a->number[4], a->number[5]},
                         .t_min = a->number[6],
                         .t_max = a->number[7],
                         .mask = a->id[0],
                         .skip_primitive = a->id[1],
                         .skip_geometry = a->id[2]};
}

static void omit_defaults(const judge_ray *ray, uint32_t count, cgt_rays *rays)
{
    bool t_min = false, t_max = false, mask = false, skip = false;
    for (uint32_t i = 0; i < count; i++) {
        t_min |= ray[i].line.t_min != 0;
        t_max |= ray[i].line.t_max != INFINITY;
        mask |= ray[i].mask != 0;
        skip |= ray[i].skip_primitive != CGT_INVALID_ID;
    }
    rays->t_min = t_min ? rays->t_min : NULL;
    rays->t_max = t_max ? rays->t_max : NULL;
    rays->mask = mask ? rays->mask : NULL;
    rays->skip_primitive = skip ? rays->skip_primitive : NULL;
    rays->skip_geometry = skip ? rays->skip_geometry : NULL;
}

static cgt_rays make_arrays(driver_run *run, uint32_t from, uint32_t count)
{
    static ray_arrays a;
    test_random *const r = &run->scene.random;
    a.rays = driver_ray_array(run->ray + from, count);
    if (random_below(r, 2))
        copy_rays(run->ray + from, count, &a);
    if (random_below(r, 3))
        omit_defaults(run->ray + from, count, &a.rays);
    return a.rays;
}

/* ---- calls ---- */

/* How a call decides: FAST may take a triangle test of the papers, which has no bound. */
typedef struct decision {
    cgt_precision precision;
    cgt_triangle_test triangle_test;
} decision;

static bool call_part(driver_run *run, uint32_t from, uint32_t count, const decision *d, full_hit *hit,
                      uint8_t *occluded)
{
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
    test_trace_options o = driver_options(run, d->precision);
    const cgt_rays rays = make_arrays(run, from, count);
    const cgt_hits hits = hit_array(hit + from);
    uint64_t found = 0;
    o.triangle_test = d->triangle_test;
    o.statistics = &statistics;
    o.research_statistics = &research;
    memset(hit + from, 0x77, count * sizeof *hit);
    memset(occluded + from, 9, count);
    if (!driver_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &hits, TRACE_OPTIONS(&o)), "cgt_trace_rays"))
        return false;
    for (uint32_t i = from; i < from + count; i++)
        found += hit[i].primitive != CGT_INVALID_ID;
    driver_check_statistics(run, &statistics, count, found);
    if (research.rope_loops || research.rope_steps > research.leaves)
        driver_fail(run, NULL, "statistics", "%llu steps by ropes to %llu leaves, %llu loops",
                    (unsigned long long)research.rope_steps, (unsigned long long)research.leaves,
                    (unsigned long long)research.rope_loops);
    if (!driver_succeeds(run, cgt_occluded_rays(run->setup.scene, &rays, occluded + from, TRACE_OPTIONS(&o)),
                         "cgt_occluded_rays"))
        return false;
    for (uint32_t i = from; i < from + count && d->triangle_test != CGT_TRIANGLE_TEST_AUTO; i++)
        found += (uint64_t)(occluded[i] == 1) - (hit[i].primitive != CGT_INVALID_ID); /* either is right at an edge */
    driver_check_statistics(run, &statistics, count, found);
    return true;
}

/* All rays, in one call or in several. */
static bool call_arrays(driver_run *run, const decision *d, full_hit *hit, uint8_t *occluded)
{
    static const uint32_t sizes[] = {300, 64, 17, 16, 15, 3, 1};
    test_random *const r = &run->scene.random;
    const uint32_t size = random_below(r, 3) ? DRIVER_RAYS : sizes[random_below(r, TEST_COUNT(sizes))];
    for (uint32_t from = 0; from < run->rays; from += size)
        if (!call_part(run, from, run->rays - from < size ? run->rays - from : size, d, hit, occluded))
            return false;
    return true;
}

/* ---- answers ---- */

static void judge_hits(driver_run *run, const decision *d, const full_hit *hit, const uint8_t *occluded)
{
    const bool fast = d->precision == CGT_PRECISION_FAST, bound = d->triangle_test == CGT_TRIANGLE_TEST_AUTO;
    for (uint32_t i = 0; i < run->rays; i++) {
        const full_hit *const h = &hit[i];
        const judge_answer answer = {
            h->t, h->primitive, h->geometry, {h->normal[0], h->normal[1], h->normal[2]}, {h->uv[0], h->uv[1]}};
        const char *wrong = judge_nearest(&run->scene, &run->pool, &run->right[i], &run->ray[i], fast, &answer);
        run->count[COUNT_UNBOUNDED] += !bound;
        run->count[COUNT_UNBOUNDED_WRONG] += !bound && wrong;
        wrong = bound ? wrong : NULL;
        if (!wrong && bound && occluded[i] != (h->primitive != CGT_INVALID_ID))
            wrong = occluded[i] ? "occluded, and no hit" : "not occluded, and a hit";
        if (!wrong && !fast && run->setup.number && memcmp(h, &run->first[i], sizeof *h) != 0)
            wrong = "not the bits of the first setup";
        if (wrong)
            driver_fail(run, &run->ray[i], fast ? "cgt_trace_rays, fast" : "cgt_trace_rays", "%s: %d.%d at %a", wrong,
                        (int)h->geometry, (int)h->primitive, (double)h->t);
        if (!fast && !run->setup.number)
            run->first[i] = *h;
    }
    run->count[COUNT_ANSWERS] += 2 * run->rays;
}

/* Whether a ray alone is told the surface of a sphere or a capsule that its hit is on. */
static bool is_on_surface(const driver_run *run, uint32_t i, const cgt_hit *h)
{
    uint32_t at = 0;
    return h->primitive == CGT_INVALID_ID ? h->surface == CGT_SURFACE_NEAR
                                          : judge_next(&run->scene, &run->pool, &run->right[i], &at, h->geometry,
                                                       h->primitive, (int)h->surface, h->t) >= 0;
}

static bool ask_alone(driver_run *run, const cgt_single_ray *ray, const cgt_trace_options *options, cgt_hit *hit,
                      bool *any)
{
    memset(hit, 0x55, sizeof *hit);
    return driver_succeeds(run, cgt_trace_ray(run->setup.scene, ray, hit, options), "cgt_trace_ray") &&
           driver_succeeds(run, cgt_occluded_ray(run->setup.scene, ray, any, options), "cgt_occluded_ray");
}

/* Rays one by one have the bits and the counts of the array, with options and without, which is a way of its own. */
static void check_alone(driver_run *run, const decision *d, const full_hit *hit)
{
    const bool fast = d->precision == CGT_PRECISION_FAST;
    for (uint32_t i = random_below(&run->scene.random, 3); i < run->rays; i += 3) {
        cgt_trace_statistics counts = {.rays = 1};
        const cgt_trace_options options = {.precision = d->precision, .statistics = &counts};
        const bool without = !fast && i % 2, met = hit[i].primitive != CGT_INVALID_ID;
        cgt_single_ray single;
        cgt_hit alone;
        bool any;
        if (!driver_single(&run->ray[i], &single) || !ask_alone(run, &single, without ? NULL : &options, &alone, &any))
            continue;
        const full_hit got = full_hit_of(&alone);
        run->count[COUNT_ANSWERS] += 2;
        if (memcmp(&got, &hit[i], sizeof got) != 0 || any != met || (!fast && !is_on_surface(run, i, &alone)) ||
            counts.rays != 1 || (!without && counts.hits != met))
            driver_fail(run, &run->ray[i], "cgt_trace_ray",
                        "one ray is %d.%d at %a, surface %u, occluded %d, %llu hits of %llu, not as in the array",
                        (int)got.geometry, (int)got.primitive, (double)got.t, alone.surface, any,
                        (unsigned long long)counts.hits, (unsigned long long)counts.rays);
    }
}

/* A call that wants any set of fields has their bits, and leaves the others. */
static void check_fields(driver_run *run, const full_hit *hit)
{
    static full_hit got[DRIVER_RAYS];
    const cgt_rays rays = make_arrays(run, 0, run->rays);
    const test_trace_options o = driver_options(run, CGT_PRECISION_EXACT);
    const uint32_t fields = random_below(&run->scene.random, 32);
    cgt_hits hits = hit_array(got);
    hits.t = fields & CGT_FIELD_T ? hits.t : NULL;
    hits.primitive = fields & CGT_FIELD_PRIMITIVE ? hits.primitive : NULL;
    hits.geometry = fields & CGT_FIELD_GEOMETRY ? hits.geometry : NULL;
    for (int a = 0; a < 3; a++)
        hits.normal[a] = fields & CGT_FIELD_NORMAL ? hits.normal[a] : NULL;
    hits.u = fields & CGT_FIELD_UV ? hits.u : NULL;
    hits.v = fields & CGT_FIELD_UV ? hits.v : NULL;
    memset(got, 0x77, run->rays * sizeof *got);
    if (!driver_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &hits, TRACE_OPTIONS(&o)), "cgt_trace_rays"))
        return;
    for (uint32_t i = 0; i < run->rays; i++) {
        full_hit want;
        memset(&want, 0x77, sizeof want);
        want.t = hits.t ? hit[i].t : want.t;
        want.primitive = hits.primitive ? hit[i].primitive : want.primitive;
        want.geometry = hits.geometry ? hit[i].geometry : want.geometry;
        if (hits.normal[0])
            memcpy(want.normal, hit[i].normal, sizeof want.normal);
        if (hits.u)
            memcpy(want.uv, hit[i].uv, sizeof want.uv);
        if (memcmp(&got[i], &want, sizeof want) != 0)
            driver_fail(run, &run->ray[i], "cgt_trace_rays", "fields %u have other bits", (unsigned)fields);
    }
    run->count[COUNT_ANSWERS] += run->rays;
}

static void ask(driver_run *run)
{
    static full_hit hit[DRIVER_RAYS];
    static uint8_t occluded[DRIVER_RAYS];
    test_random *const r = &run->scene.random;
    const decision exact = {0};
    decision fast = {.precision = CGT_PRECISION_FAST};
    if (run->setup.way->papers && random_below(r, 2))
        fast.triangle_test = (cgt_triangle_test)random_below(r, 4);
    for (int k = random_below(r, 2) ? 0 : 1; k < 2; k++) {
        const decision *const d = k ? &exact : &fast;
        if (!call_arrays(run, d, hit, occluded))
            return;
        judge_hits(run, d, hit, occluded);
        if (d->triangle_test == CGT_TRIANGLE_TEST_AUTO)
            check_alone(run, d, hit);
    }
    if (random_below(r, 4) == 0)
        check_fields(run, hit);
}

const driver_call call_nearest = {NULL, ask};
