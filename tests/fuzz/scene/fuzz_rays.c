/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays: closest hit and any hit, with any options and strides, masks and skipped primitives, judged by whole
 * numbers. That variants and structures agree, the target `hits` asks. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "driver/driver.h"
#include "fuzz/scene/fuzz_check.h"

#define MOST_RAYS 40u

/* ---- rays that are worth it ---- */

/* A vertex, a point of an edge, of a sphere, of a capsule or its axis; any point if the scene is empty. */
static void any_target(fuzz_model *m, float p[3])
{
    const fuzz_geometry *g = &m->geometry[fuzz_below(&m->bytes, FUZZ_GEOMETRIES)];
    const uint8_t which = fuzz_byte(&m->bytes);
    const uint32_t count = g->used && fuzz_indices_are_good(g) ? fuzz_count(g) : 0;
    if (!count) {
        for (int k = 0; k < 3; k++)
            p[k] = fuzz_float(&m->bytes);
        return;
    }
    const cgt_primitive aim = fuzz_primitive_at(g, which % count);
    const uint8_t how = fuzz_byte(&m->bytes);
    const float at = (float)(how / 9 % 5) / 4;
    const float(*const v)[3] = aim.triangle.v;
    for (int k = 0; k < 3; k++)
        p[k] = aim.kind == CGT_KIND_TRIANGLES  ? v[how % 3][k] + at * (v[how / 3 % 3][k] - v[how % 3][k])
               : aim.kind == CGT_KIND_CAPSULES ? aim.capsule.p[k] + at * (aim.capsule.q[k] - aim.capsule.p[k])
                                               : (&aim.sphere.x)[k];
    if (aim.kind != CGT_KIND_TRIANGLES && how % 4 < 3) {
        const float r = aim.kind == CGT_KIND_SPHERES ? aim.sphere.r : aim.capsule.r;
        p[how % 4] += how & 4 ? r : -r;
    }
}

truth_ray fuzz_any_ray(fuzz_model *m, const truth_ray *before)
{
    const uint8_t kind = fuzz_byte(&m->bytes);
    truth_ray ray = *before;
    if (kind % 8 == 0) { /* a neighbour of the last ray */
        ray.dir[kind / 8 % 3] = nextafterf(ray.dir[kind / 8 % 3], kind & 128 ? INFINITY : -INFINITY);
        return ray;
    }
    if (kind % 8 == 1)
        any_target(m, ray.org);
    for (int k = 0; k < 3 && kind % 8 > 4; k++)
        ray.org[k] = fuzz_float(&m->bytes);
    float target[3];
    any_target(m, target);
    for (int k = 0; k < 3; k++)
        ray.dir[k] = kind % 8 == 7 ? fuzz_float(&m->bytes) : target[k] - ray.org[k];
    return ray;
}

/* ranges: bit 0: t_min may be other than 0, bit 1: t_max may be other than infinity */
static uint32_t make_rays(fuzz_model *m, uint32_t ranges, truth_ray ray[MOST_RAYS])
{
    const uint32_t count = fuzz_below(&m->bytes, MOST_RAYS + 1);
    truth_ray last = {.org = {0, 0, 4}, .dir = {0, 0, -1}, .t_max = INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        last = fuzz_any_ray(m, &last);
        last.t_min = ranges & 1 ? fuzz_float(&m->bytes) : 0;
        last.t_max = ranges & 2 ? fuzz_float(&m->bytes) : INFINITY;
        ray[i] = last;
    }
    return count;
}

/* ---- arrays of any stride, each a block that ends with its last element ---- */

#define INPUTS 8
#define OUTPUTS 8

typedef struct arrays {
    size_t stride, vector_stride; /* as passed to the call: 0 for 4, and for stride */
    uint32_t count;
    char *block[INPUTS];
} arrays;

static arrays make_arrays(fuzz_model *m, uint32_t count)
{
    static const size_t strides[] = {0, 4, 8, 12, 20, 32};
    const uint32_t number = fuzz_below(&m->bytes, 36);
    arrays a = {.stride = strides[number % 6], .vector_stride = strides[number / 6], .count = count};
    const size_t widest = a.stride > a.vector_stride ? a.stride : a.vector_stride;
    const size_t bytes = count ? (count - 1) * (widest ? widest : 4) + 4 : 0;
    for (int i = 0; i < INPUTS; i++)
        a.block[i] = memset(fuzz_allocate(bytes), 0xcd, bytes);
    return a;
}

static void free_arrays(arrays *a)
{
    for (int i = 0; i < INPUTS; i++)
        free(a->block[i]);
}

static size_t step_of(const arrays *a, bool vector)
{
    return vector && a->vector_stride ? a->vector_stride : a->stride ? a->stride : 4;
}

static char *element(const arrays *a, int array, bool vector, uint32_t i)
{
    return a->block[array] + i * step_of(a, vector);
}

static cgt_rays rays_in(const arrays *a, const truth_ray *ray, uint32_t ranges)
{
    for (uint32_t i = 0; i < a->count; i++)
        for (int k = 0; k < INPUTS; k++)
            memcpy(element(a, k, k < 6, i), (const float *)(const void *)&ray[i] + k, sizeof(float));
    const float *at[INPUTS];
    for (int k = 0; k < INPUTS; k++)
        at[k] = (const float *)(const void *)a->block[k];
    return (cgt_rays){.count = a->count,
                      .stride = a->stride,
                      .vector_stride = a->vector_stride,
                      .org = {at[0], at[1], at[2]},
                      .dir = {at[3], at[4], at[5]},
                      .t_min = ranges & 1 ? at[6] : NULL,
                      .t_max = ranges & 2 ? at[7] : NULL};
}

/* The arrays in the order of full_hit; only those of the requested fields are passed. */
static cgt_hits hits_in(const arrays *a, uint32_t fields)
{
    void *at[OUTPUTS];
    const uint32_t of[OUTPUTS] = {CGT_FIELD_T,      CGT_FIELD_PRIMITIVE, CGT_FIELD_GEOMETRY, CGT_FIELD_NORMAL,
                                  CGT_FIELD_NORMAL, CGT_FIELD_NORMAL,    CGT_FIELD_UV,       CGT_FIELD_UV};
    for (int k = 0; k < OUTPUTS; k++)
        at[k] = fields & of[k] ? a->block[k] : NULL;
    return (cgt_hits){.stride = a->stride,
                      .vector_stride = a->vector_stride,
                      .t = at[0],
                      .primitive = at[1],
                      .geometry = at[2],
                      .normal = {at[3], at[4], at[5]},
                      .u = at[6],
                      .v = at[7]};
}

/* Copies the answers from the arrays; fields that were not requested come from `like`. Nothing else may be written. */
static void take_hits(const arrays *a, uint32_t fields, const full_hit *like, full_hit *hit)
{
    const cgt_hits h = hits_in(a, fields);
    const void *const at[OUTPUTS] = {h.t, h.primitive, h.geometry, h.normal[0], h.normal[1], h.normal[2], h.u, h.v};
    for (uint32_t i = 0; i < a->count; i++)
        hit[i] = like[i];
    for (int k = 0; k < OUTPUTS; k++)
        for (uint32_t i = 0; i < a->count; i++) {
            const bool normal = k >= 3 && k < 6;
            const char *from = element(a, k, normal, i);
            if (at[k])
                memcpy((float *)(void *)&hit[i] + k, from, sizeof(float));
            for (size_t gap = at[k] ? 4 : 0; gap < (i + 1 < a->count ? step_of(a, normal) : 4); gap++)
                FUZZ_CHECK((uint8_t)from[gap] == 0xcd, "hits: a byte between the elements is written");
        }
}

/* ---- calls ---- */

static void trace_defaults(fuzz_model *m, const fuzz_answers *a)
{
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
    test_trace_options o = {0};
    o.statistics = &statistics;
    o.research_statistics = &research;
    FUZZ_MUST(m, trace_array(m->scene, a->ray, a->count, a->exact, TRACE_OPTIONS(&o)), true);
    fuzz_check_hits(m, a, a->exact, o.precision);
    fuzz_check_counts(a, a->exact, &statistics, &research);
}

static void judge_defaults(const fuzz_model *m, const fuzz_answers *a)
{
    judge_ray ray[MOST_RAYS];
    for (uint32_t i = 0; i < a->count; i++)
        ray[i] = fuzz_judge_ray(&a->ray[i]);
    fuzz_check_truth(m, ray, a->count, a->exact);
}

static void check_any_hit(fuzz_model *m, const fuzz_answers *a, const cgt_rays *rays, const test_trace_options *o)
{
    uint8_t *occluded = memset(fuzz_allocate(a->count), 0x77, a->count);
    FUZZ_MUST(m, cgt_occluded_rays(m->scene, rays, occluded, TRACE_OPTIONS(o)), true);
    for (uint32_t i = 0; i < a->count; i++)
        FUZZ_CHECK(occluded[i] == (a->other[i].geometry != CGT_INVALID_ID),
                   "ray %u: any hit says %u, closest hit %u.%u", i, occluded[i], a->other[i].geometry,
                   a->other[i].primitive);
    fuzz_check_counts(a, a->other, o->statistics, o->research_statistics);
    free(occluded);
}

/* ---- masks and ignored primitives ---- */

/* What a ray sees, chosen by its own bits: no input bytes are consumed. */
static judge_ray filtered_ray(const truth_ray *line, uint32_t i, const full_hit *exact)
{
    static const uint32_t masks[] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, 1, 2, 3, 0x80000000u, 0};
    judge_ray ray = {*line, 0, exact->primitive, exact->geometry};
    uint32_t hash = i, word;
    for (int k = 0; k < 6; k++) {
        memcpy(&word, (const float *)(const void *)line + k, sizeof word);
        hash = (hash ^ word) * 0x9e3779b1u;
        hash ^= hash >> 15;
    }
    ray.mask = masks[hash & 7];
    if ((hash >> 3 & 3) == 0)
        ray.skip_primitive = (hash >> 5 & 7) == 7 ? CGT_INVALID_ID - 1 : hash >> 5 & 15;
    if ((hash >> 9 & 3) == 0)
        ray.skip_geometry = (hash >> 11 & 7) == 7 ? CGT_INVALID_ID : hash >> 11 & 7;
    return ray;
}

static void trace_filtered(fuzz_model *m, const fuzz_answers *a, const cgt_trace_options *o)
{
    judge_ray ray[MOST_RAYS] = {{.mask = 0}};
    full_hit hit[MOST_RAYS];
    uint8_t occluded[MOST_RAYS];
    for (uint32_t i = 0; i < a->count; i++)
        ray[i] = filtered_ray(&a->ray[i], i, &a->exact[i]);
    const cgt_rays rays = driver_ray_array(ray, a->count);
    const cgt_hits hits = hit_array(hit);
    FUZZ_MUST(m, cgt_trace_rays(m->scene, &rays, &hits, o), true);
    FUZZ_MUST(m, cgt_occluded_rays(m->scene, &rays, occluded, o), true);
    for (uint32_t i = 0; i < a->count; i++)
        FUZZ_CHECK(occluded[i] == (hit[i].primitive != CGT_INVALID_ID), "ray %u, filtered: any hit says %u", i,
                   occluded[i]);
    fuzz_check_hits(m, a, hit, o->precision);
    if (o->precision != CGT_PRECISION_FAST)
        fuzz_check_truth(m, ray, a->count, hit);
}

/* ---- all of it ---- */

static void trace_other(fuzz_model *m, const fuzz_answers *a, uint32_t ranges)
{
    bool legal;
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
    test_trace_options o = fuzz_options(m, false, &legal);
    o.statistics = &statistics;
    o.research_statistics = &research;
    const uint32_t fields = o.precision == CGT_PRECISION_FAST ? 31 : fuzz_below(&m->bytes, 32);
    arrays in = make_arrays(m, a->count), out = make_arrays(m, a->count);
    const cgt_rays rays = rays_in(&in, a->ray, ranges);
    const cgt_hits hits = hits_in(&out, fields);
    FUZZ_MUST(m, cgt_trace_rays(m->scene, &rays, &hits, TRACE_OPTIONS(&o)), legal);
    if (legal) {
        take_hits(&out, fields, a->exact, a->other);
        fuzz_check_hits(m, a, a->other, o.precision);
        fuzz_check_counts(a, a->other, &statistics, &research);
        fuzz_check_same(m, a, o.precision);
        check_any_hit(m, a, &rays, &o);
        trace_filtered(m, a, TRACE_OPTIONS(&o));
    }
    free_arrays(&in);
    free_arrays(&out);
}

void fuzz_trace_rays(fuzz_model *m)
{
    truth_ray ray[MOST_RAYS];
    const uint8_t how = fuzz_byte(&m->bytes);
    const uint32_t ranges = how % 8 < 4 ? 0 : how % 4, count = make_rays(m, ranges, ray);
    fuzz_answers a = fuzz_answers_make(ray, count);
    if (!m->committed) {
        const cgt_result result = trace_array(m->scene, ray, count, a.exact, NULL);
        FUZZ_CHECK(result == CGT_ERROR_NOT_COMMITTED, "trace: %s", cgt_get_result_string(result));
        fuzz_check_error(m, result);
    } else {
        trace_defaults(m, &a);
        trace_other(m, &a, ranges);
        judge_defaults(m, &a);
    }
    fuzz_answers_free(&a);
}
