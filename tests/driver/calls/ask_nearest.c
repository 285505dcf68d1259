/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The nearest hit of each ray, and any: in arrays of any size and layout, one by one, and FAST. */
#include <math.h>
#include <string.h>

#include "driver/driver.h"

/* ---- arrays ---- */

#define WIDEST 5u /* words from one number, or vector, to the next */
#define WORDS (WIDEST * DRIVER_RAYS)

/* How arrays are laid out, in words: triples if vectors are wide enough, else components apart. */
typedef struct layout {
    uint32_t step, wide;
} layout;

static layout make_layout(test_random *r)
{
    const uint32_t step = random_below(r, 3) ? 1 : 1 + random_below(r, WIDEST);
    return (layout){step, random_below(r, 2) ? step : 1 + random_below(r, WIDEST)};
}

/* A stride in bytes; 0 now and then where that says the same. */
static size_t stride_of(test_random *r, uint32_t words, uint32_t without)
{
    return words == without && random_below(r, 2) ? 0 : 4 * words;
}

static float *component(float *vectors, const layout *l, uint32_t a)
{
    return vectors + (size_t)a * (l->wide >= 3 ? 1 : WORDS);
}

/* The arrays of one call: those of run->ray, or others with two strides; those that are the default for all rays may be
 * NULL. */
typedef struct ray_arrays {
    float org[3 * WORDS], dir[3 * WORDS], t_min[WORDS], t_max[WORDS];
    uint32_t id[3][WORDS];
    cgt_rays rays;
} ray_arrays;

static void copy_rays(test_random *r, const judge_ray *ray, uint32_t count, ray_arrays *to)
{
    const layout l = make_layout(r);
    to->rays = (cgt_rays){.count = count,
                          .stride = stride_of(r, l.step, 1),
                          .vector_stride = stride_of(r, l.wide, l.step),
                          .t_min = to->t_min,
                          .t_max = to->t_max,
                          .mask = to->id[0],
                          .skip_primitive = to->id[1],
                          .skip_geometry = to->id[2]};
    for (uint32_t a = 0; a < 3; a++) {
        to->rays.org[a] = component(to->org, &l, a);
        to->rays.dir[a] = component(to->dir, &l, a);
    }
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t a = 0; a < 3; a++) {
            component(to->org, &l, a)[i * l.wide] = ray[i].line.org[a];
            component(to->dir, &l, a)[i * l.wide] = ray[i].line.dir[a];
        }
        to->t_min[i * l.step] = ray[i].line.t_min;
        to->t_max[i * l.step] = ray[i].line.t_max;
        to->id[0][i * l.step] = ray[i].mask;
        to->id[1][i * l.step] = ray[i].skip_primitive;
        to->id[2][i * l.step] = ray[i].skip_geometry;
    }
}

static void omit_defaults(const judge_ray *ray, uint32_t count, cgt_rays *rays)
{
    bool t_min = false, t_max = false, mask = false, skip = false;
    for (uint32_t i = 0; i < count; i++) {
        t_min |= ray[i].line.t_min != 0 || signbit(ray[i].line.t_min); /* of FAST, t may have its sign */
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
        copy_rays(r, run->ray + from, count, &a);
    if (random_below(r, 3))
        omit_defaults(run->ray + from, count, &a.rays);
    return a.rays;
}

/* Hits in arrays with two strides; what lies between stays. */
typedef struct hit_arrays {
    layout l;
    float t[WORDS], normal[3 * WORDS], u[WORDS], v[WORDS];
    uint32_t primitive[WORDS], geometry[WORDS];
} hit_arrays;

static cgt_hits spread_hits(test_random *r, hit_arrays *h)
{
    h->l = make_layout(r);
    cgt_hits hits = {.stride = stride_of(r, h->l.step, 1),
                     .vector_stride = stride_of(r, h->l.wide, h->l.step),
                     .t = h->t,
                     .primitive = h->primitive,
                     .geometry = h->geometry,
                     .u = h->u,
                     .v = h->v};
    for (uint32_t a = 0; a < 3; a++)
        hits.normal[a] = component(h->normal, &h->l, a);
    memset(h->t, 0x77, sizeof h->t);
    memset(h->normal, 0x77, sizeof h->normal);
    return hits;
}

/* Whether only words of hits were written. */
static bool collect_hits(hit_arrays *h, uint32_t count, full_hit *to)
{
    const uint32_t odd = 0x77777777u;
    bool only = true;
    for (uint32_t i = 0; i < count; i++) {
        const size_t at = (size_t)i * h->l.step;
        to[i] = (full_hit){h->t[at], h->primitive[at], h->geometry[at], {0}, {h->u[at], h->v[at]}};
        memcpy(&h->t[at], &odd, sizeof odd);
        for (uint32_t a = 0; a < 3; a++) {
            float *const n = component(h->normal, &h->l, a) + (size_t)i * h->l.wide;
            to[i].normal[a] = *n;
            memcpy(n, &odd, sizeof odd);
        }
    }
    for (uint32_t k = 0; k < 3 * count; k++)
        only &= !memcmp(&h->normal[k], &odd, sizeof odd) && !memcmp(&h->t[k], &odd, sizeof odd);
    return only;
}

/* ---- calls ---- */

/* How a call decides: FAST may take a triangle test of the papers, which has no bound. */
typedef struct decision {
    cgt_precision precision;
    cgt_triangle_test triangle_test;
} decision;

static bool is_invalid(const truth_ray *line)
{
    float sum = 0, longest = 0;
    for (int a = 0; a < 3; a++) {
        sum += 0 * line->org[a] + 0 * line->dir[a];
        longest = fmaxf(longest, fabsf(line->dir[a]));
    }
    return sum != 0 || isnan(sum) || longest == 0 || isnan(line->t_min) || isnan(line->t_max);
}

static bool call_part(driver_run *run, uint32_t from, uint32_t count, const decision *d, full_hit *hit,
                      uint8_t *occluded)
{
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
    static hit_arrays arrays;
    test_trace_options o = driver_options(run, d->precision);
    const cgt_rays rays = make_arrays(run, from, count);
    const bool spread = random_below(&run->scene.random, 3) == 0;
    const cgt_hits hits = spread ? spread_hits(&run->scene.random, &arrays) : hit_array(hit + from);
    uint64_t found = 0, invalid = 0;
    o.triangle_test = d->triangle_test;
    o.statistics = &statistics;
    o.research_statistics = &research;
    memset(hit + from, 0x77, count * sizeof *hit);
    memset(occluded + from, 9, count);
    if (!driver_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &hits, TRACE_OPTIONS(&o)), "cgt_trace_rays"))
        return false;
    if (spread && !collect_hits(&arrays, count, hit + from))
        driver_fail(run, NULL, "cgt_trace_rays", "a word between hits is written");
    for (uint32_t i = from; i < from + count; i++) {
        found += hit[i].primitive != CGT_INVALID_ID;
        invalid += is_invalid(&run->ray[i].line);
    }
    driver_check_statistics(run, &statistics, count, found);
    if (statistics.invalid_rays != invalid)
        driver_fail(run, NULL, "statistics", "%llu invalid rays, not %llu", (unsigned long long)statistics.invalid_rays,
                    (unsigned long long)invalid);
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

/* The true hit that an answer names, with its values, or NULL. */
static const judge_hit *named_hit(const driver_run *run, uint32_t i, const full_hit *h)
{
    uint32_t at = 0;
    const int64_t k = h->primitive == CGT_INVALID_ID ? -1
                                                     : judge_next(&run->scene, &run->pool, &run->right[i], &at,
                                                                  h->geometry, h->primitive, -1, NAN);
    return k >= 0 && run->pool.hit[k].has_values ? &run->pool.hit[k] : NULL;
}

static double length_of(const float d[3])
{
    return sqrt((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2]);
}

/* FAST values, and those whose t is beyond 1e-3 of the scene, or u, v or the normal beyond 1e-3. */
static void count_fast(driver_run *run, uint32_t i, const full_hit *h)
{
    const judge_hit *const right = named_hit(run, i, h);
    double uv = 0, normal = 0;
    if (!right)
        return;
    for (int k = 0; k < 2; k++)
        uv = fmax(uv, fabs((double)h->uv[k] - (double)right->values.uv[k]));
    for (int a = 0; a < 3; a++)
        normal = fmax(normal, fabs((double)h->normal[a] - (double)right->values.normal[a]));
    const double way = fabs((double)h->t - (double)right->values.t) * length_of(run->ray[i].line.dir);
    run->count[COUNT_FAST]++;
    run->count[COUNT_FAST_OFF] += fmax(way / (double)run->scene.scale, fmax(uv, normal)) > 1e-3;
}

/* Whether a ray hardly moves along an axis. On a plane that splits a tree it visits one side, and a test of single
 * precision may find it on the triangle of the other. */
static bool runs_along_plane(const truth_ray *line)
{
    bool runs = false;
    for (int a = 0; a < 3; a++)
        runs |= (double)fabsf(line->dir[a]) <= 0x1p-20 * length_of(line->dir);
    return runs;
}

/* Whether a ray from well inside a closed mesh, and not at the begin of its range, leaves it at an edge: the watertight
 * test of single precision may leak beside vertices, where more than two triangles meet, and along planes. Far from the
 * origin t may be anything. */
static bool leaks_at_edge(driver_run *run, uint32_t i, const full_hit *h)
{
    const judge_truth *const right = &run->right[i];
    const judge_ray *const ray = &run->ray[i];
    if (!right->count || !run->scene.closed)
        return false;
    const judge_hit *const hit = &run->pool.hit[right->first];
    const double u = (double)hit->values.uv[0], v = (double)hit->values.uv[1];
    const double way = (double)hit->values.t * length_of(ray->line.dir), size = (double)run->scene.scale;
    run->count[COUNT_WATERTIGHT]++;
    if (h->primitive != CGT_INVALID_ID || hit->doubtful || ray->line.t_max < INFINITY ||
        (double)hit->values.t * (1 - 0x1p-8) < (double)ray->line.t_min || way < 0.01 * size ||
        length_of(ray->line.org) > 1024 * size || runs_along_plane(&ray->line) ||
        !judge_inside(&run->scene, ray->line.org, ray->mask, true))
        return false;
    run->count[COUNT_LEAKS]++;
    return hit->has_values && fmax(fmax(u, v), 1 - u - v) < 0.999;
}

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
        if (fast)
            count_fast(run, i, h);
        if (d->triangle_test == CGT_TRIANGLE_TEST_WATERTIGHT && leaks_at_edge(run, i, h))
            wrong = "the watertight test leaks at an edge";
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
            driver_fail(run, &run->ray[i], fast ? "cgt_trace_ray, fast" : "cgt_trace_ray",
                        "one ray is %d.%d at %a, surface %u, occluded %d, %llu hits of %llu, not %d.%d at %a as in the "
                        "array",
                        (int)got.geometry, (int)got.primitive, (double)got.t, alone.surface, any,
                        (unsigned long long)counts.hits, (unsigned long long)counts.rays, (int)hit[i].geometry,
                        (int)hit[i].primitive, (double)hit[i].t);
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
