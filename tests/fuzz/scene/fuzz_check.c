/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Invariants of every answer. */
#include "fuzz/scene/fuzz_check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- options ---- */

/* One of `count` values, occasionally one past them. */
static uint32_t odd_below(fuzz_model *m, uint32_t count, bool *legal)
{
    const uint8_t byte = fuzz_byte(&m->bytes);
    const uint32_t value = byte < 250 ? byte % count : byte;
    *legal &= value < count;
    return value;
}

test_trace_options fuzz_options(fuzz_model *m, bool camera, bool *legal)
{
    static const uint32_t packets[] = {0, 4, 8, 16, 0, 4, 16, 5};
    test_trace_options o = {0};
    *legal = true;
    o.precision = (cgt_precision)odd_below(m, 2, legal);
    /* the other triangle tests need FAST: otherwise few calls would be legal */
    if (o.precision == CGT_PRECISION_FAST || fuzz_below(&m->bytes, 8) == 0)
        o.triangle_test = (cgt_triangle_test)odd_below(m, 4, legal);
    o.tile = (cgt_tile_shape)odd_below(m, 3, legal);
    o.loop = (cgt_loop)odd_below(m, 3, legal);
    o.cull = (cgt_cull)odd_below(m, 4, legal);
    const uint8_t packet = fuzz_byte(&m->bytes);
    o.packet = packets[packet % 8];
    o.kd_traversal = (cgt_kd_traversal)(packet < 250 ? packet / 8 % 3 : 3);
    o.mailbox = (cgt_mailbox)fuzz_below(&m->bytes, 3);
    *legal &= packet < 250 && o.packet != 5;
    *legal &= o.triangle_test == CGT_TRIANGLE_TEST_AUTO ||
              (o.precision == CGT_PRECISION_FAST && !fuzz_has(m, CGT_KIND_CAPSULES));
    *legal &= !camera || o.tile != CGT_TILE_SHAPE_STRIP || o.packet <= 4;
    return o;
}

void fuzz_must(fuzz_model *m, cgt_result result, bool legal)
{
    FUZZ_CHECK((result == CGT_OK) == legal, "trace: %s", cgt_get_result_string(result));
    if (result != CGT_OK)
        fuzz_check_error(m, result);
}

/* ---- answers ---- */

fuzz_answers fuzz_answers_make(const truth_ray *ray, uint32_t count)
{
    fuzz_answers a = {.ray = ray, .count = count};
    full_hit **const array[] = {&a.exact, &a.other};
    for (int i = 0; i < 2; i++) {
        *array[i] = fuzz_allocate(count * sizeof **array[i]);
        memset(*array[i], 0x5a, count * sizeof **array[i]); /* a pattern, so that an unwritten answer shows */
    }
    return a;
}

void fuzz_answers_free(fuzz_answers *a)
{
    free(a->exact);
    free(a->other);
}

/* ---- hits ---- */

static bool finite3(const float v[3]) { return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]); }

bool fuzz_ray_is_invalid(const truth_ray *ray)
{
    const float *d = ray->dir;
    return !finite3(ray->org) || !finite3(d) || (d[0] == 0 && d[1] == 0 && d[2] == 0) || isnan(ray->t_min) ||
           isnan(ray->t_max);
}

static void check_miss(const full_hit *h, uint32_t i)
{
    FUZZ_CHECK(h->primitive == CGT_INVALID_ID && h->geometry == CGT_INVALID_ID, "ray %u: half a miss", i);
    FUZZ_CHECK(h->t == INFINITY, "ray %u: t %a of a miss", i, (double)h->t);
    FUZZ_CHECK(h->normal[0] == 0 && h->normal[1] == 0 && h->normal[2] == 0, "ray %u: the normal of a miss", i);
    FUZZ_CHECK(h->uv[0] == 0 && h->uv[1] == 0, "ray %u: u and v of a miss", i);
}

/* Primitives that are skipped cannot be hit. */
static bool can_be_hit(const fuzz_geometry *g, uint32_t i)
{
    const cgt_primitive p = fuzz_primitive_at(g, i);
    return fuzz_is_valid(&p);
}

/* A ray and its reported hit, for a message. */
static void describe(const fuzz_model *m, const truth_ray *ray, const full_hit *h)
{
    static const char *const kinds[] = {"sphere", "triangle", "capsule"};
    static const int numbers[] = {4, 9, 7};
    fprintf(stderr, "variant %s\norg %a %a %a\ndir %a %a %a\nrange %a %a\n", cgt_context_get_variant(m->context),
            (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0], (double)ray->dir[1],
            (double)ray->dir[2], (double)ray->t_min, (double)ray->t_max);
    fprintf(stderr, "hit %u.%u t %a u %a v %a normal %a %a %a\n", h->geometry, h->primitive, (double)h->t,
            (double)h->uv[0], (double)h->uv[1], (double)h->normal[0], (double)h->normal[1], (double)h->normal[2]);
    const fuzz_geometry *g = h->geometry < FUZZ_GEOMETRIES ? &m->geometry[h->geometry] : NULL;
    if (!g || !g->used || h->primitive >= fuzz_count(g))
        return;
    const cgt_primitive p = fuzz_primitive_at(g, h->primitive);
    fputs(kinds[g->kind], stderr);
    for (int k = 0; k < numbers[g->kind]; k++)
        fprintf(stderr, " %a", (double)(&p.sphere.x)[k]);
    fputc('\n', stderr);
}

#define HIT_CHECK(condition, ...)                                                                                      \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            describe(m, ray, h);                                                                                       \
            fuzz_fail(__FILE__, __LINE__, __VA_ARGS__);                                                                \
        }                                                                                                              \
    } while (0)

static void check_hit(const fuzz_model *m, const truth_ray *ray, const full_hit *h, uint32_t i, cgt_precision precision)
{
    const fuzz_geometry *g = h->geometry < FUZZ_GEOMETRIES ? &m->geometry[h->geometry] : NULL;
    HIT_CHECK(g && g->used, "precision %d, ray %u: hits geometry %u, which does not exist", (int)precision, i,
              h->geometry);
    HIT_CHECK(h->primitive < fuzz_count(g), "precision %d, ray %u: hits primitive %u of %u", (int)precision, i,
              h->primitive, fuzz_count(g));
    HIT_CHECK(can_be_hit(g, h->primitive), "precision %d, ray %u: hits primitive %u, which is skipped", (int)precision,
              i, h->primitive);
    HIT_CHECK(!fuzz_ray_is_invalid(ray), "precision %d, ray %u: is invalid, but hits", (int)precision, i);
    HIT_CHECK(isfinite(h->t), "precision %d, ray %u: t %a", (int)precision, i, (double)h->t);
    HIT_CHECK(ray->t_min <= h->t && h->t <= ray->t_max, "precision %d, ray %u: t %a out of range", (int)precision, i,
              (double)h->t);
    HIT_CHECK(g->kind != CGT_KIND_SPHERES || (h->uv[0] == 0 && h->uv[1] == 0),
              "precision %d, ray %u: u and v of a sphere", (int)precision, i);
    HIT_CHECK(isfinite(h->uv[0]) && isfinite(h->uv[1]), "precision %d, ray %u: u or v is not finite", (int)precision,
              i);
    HIT_CHECK(finite3(h->normal), "precision %d, ray %u: the normal is invalid", (int)precision, i);
    if (precision != CGT_PRECISION_EXACT)
        return;
    HIT_CHECK(h->uv[0] >= 0 && h->uv[1] >= 0 && h->uv[0] <= 1 && h->uv[1] <= 1, "precision %d, ray %u: u %a, v %a",
              (int)precision, i, (double)h->uv[0], (double)h->uv[1]);
}

void fuzz_check_hits(const fuzz_model *m, const fuzz_answers *a, const full_hit *hit, cgt_precision precision)
{
    for (uint32_t i = 0; i < a->count; i++) {
        if (hit[i].geometry == CGT_INVALID_ID)
            check_miss(&hit[i], i);
        else
            check_hit(m, &a->ray[i], &hit[i], i, precision);
    }
}

void fuzz_check_counts(const fuzz_answers *a, const full_hit *hit, const cgt_trace_statistics *s,
                       const cgt_research_trace_statistics *research)
{
    uint64_t hits = 0, invalid = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        hits += hit[i].geometry != CGT_INVALID_ID;
        invalid += fuzz_ray_is_invalid(&a->ray[i]);
    }
    FUZZ_CHECK(s->rays == a->count, "%llu rays counted of %u", (unsigned long long)s->rays, a->count);
    FUZZ_CHECK(s->hits == hits, "%llu hits counted of %llu", (unsigned long long)s->hits, (unsigned long long)hits);
    FUZZ_CHECK(s->invalid_rays == invalid, "%llu invalid rays counted of %llu", (unsigned long long)s->invalid_rays,
               (unsigned long long)invalid);
    FUZZ_CHECK(s->double_tests <= s->ray_tests && s->exact_tests <= s->double_tests,
               "%llu ray tests, %llu of them in double, %llu of those exact", (unsigned long long)s->ray_tests,
               (unsigned long long)s->double_tests, (unsigned long long)s->exact_tests);
    FUZZ_CHECK(research->culled <= research->cull_tests, "%llu culled of %llu", (unsigned long long)research->culled,
               (unsigned long long)research->cull_tests);
    FUZZ_CHECK(research->mailbox_skipped <= research->references, "%llu skipped of %llu references",
               (unsigned long long)research->mailbox_skipped, (unsigned long long)research->references);
    FUZZ_CHECK(!research->rope_loops && research->rope_steps <= research->leaves,
               "%llu loops, %llu rope steps of %llu leaves", (unsigned long long)research->rope_loops,
               (unsigned long long)research->rope_steps, (unsigned long long)research->leaves);
    FUZZ_CHECK(s->exact_values <= s->hits, "%llu exact values of %llu hits", (unsigned long long)s->exact_values,
               (unsigned long long)s->hits);
}

/* ---- answers against each other ---- */

static bool same_hit(const full_hit *a, const full_hit *b)
{
    return same_bits(a->t, b->t) && a->primitive == b->primitive && a->geometry == b->geometry;
}

static bool same_values(const full_hit *a, const full_hit *b)
{
    bool same = same_bits(a->uv[0], b->uv[0]) && same_bits(a->uv[1], b->uv[1]);
    for (int k = 0; k < 3; k++)
        same &= same_bits(a->normal[k], b->normal[k]);
    return same;
}

void fuzz_check_same(const fuzz_model *m, const fuzz_answers *a, cgt_precision precision_of_other)
{
    for (uint32_t i = 0; i < a->count; i++) {
        const truth_ray *ray = &a->ray[i];
        const full_hit *h = &a->exact[i], *o = &a->other[i];
        if (precision_of_other == CGT_PRECISION_FAST)
            continue;
        HIT_CHECK(same_hit(o, h), "precision %d, ray %u: by another call %u.%u at %a", (int)precision_of_other, i,
                  o->geometry, o->primitive, (double)o->t);
        HIT_CHECK(same_values(o, h), "precision %d, ray %u: by another call u %a v %a normal %a %a %a",
                  (int)precision_of_other, i, (double)o->uv[0], (double)o->uv[1], (double)o->normal[0],
                  (double)o->normal[1], (double)o->normal[2]);
    }
}

/* ---- the truth ---- */

static void add_truth(judge_scene *s, uint32_t id, const fuzz_geometry *g)
{
    judge_geometry *const to = &s->geometry[id];
    *to = (judge_geometry){.kind = (oracle_kind)g->kind, .first = s->count, .mask = fuzz_mask_of(g)};
    to->count = g->used ? fuzz_count(g) : 0;
    for (uint32_t i = 0; i < to->count; i++) {
        const cgt_primitive p = fuzz_primitive_at(g, i);
        const float *const number = &p.sphere.x;
        oracle_primitive *const q = &s->primitive[s->count++];
        *q = (oracle_primitive){.kind = to->kind, .geometry = id, .primitive = i};
        for (int k = 0; k < oracle_floats(q->kind); k++)
            q->data[k] = number[k];
    }
}

void fuzz_check_truth(const fuzz_model *m, const judge_ray *rays, uint32_t count, const full_hit *hit)
{
    static judge_scene scene;
    static judge_pool pool;
    scene.count = pool.count = 0;
    scene.geometries = FUZZ_GEOMETRIES;
    for (uint32_t id = 0; id < FUZZ_GEOMETRIES; id++)
        add_truth(&scene, id, &m->geometry[id]);
    judge_scene_measure(&scene);
    for (uint32_t i = 0; i < count; i++) {
        const full_hit *h = &hit[i];
        const truth_ray *ray = &rays[i].line;
        const judge_answer answer = {
            h->t, h->primitive, h->geometry, {h->normal[0], h->normal[1], h->normal[2]}, {h->uv[0], h->uv[1]}};
        const judge_truth right = judge_trace(&scene, &rays[i], JUDGE_NEAREST, true, &pool);
        const char *const wrong = judge_nearest(&scene, &pool, &right, &rays[i], false, &answer);
        HIT_CHECK(!wrong, "ray %u, mask %u, skips %d.%d: %s: %u.%u at %a", i, rays[i].mask, (int)rays[i].skip_geometry,
                  (int)rays[i].skip_primitive, wrong, h->geometry, h->primitive, (double)h->t);
    }
}

judge_ray fuzz_judge_ray(const truth_ray *ray)
{
    return (judge_ray){.line = *ray, .skip_primitive = CGT_INVALID_ID, .skip_geometry = CGT_INVALID_ID};
}
