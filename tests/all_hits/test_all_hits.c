/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All hits through every structure, variant and number of threads: rows, visitor and single rays give the hits of every
 * primitive decided in whole numbers, in their exact order; calls that go on where others ended find what one call
 * finds; and the first hit has the bits of cgt_trace_rays. */
#include <stdlib.h>
#include <string.h>

#include "all_hits/all_hits_reference.h"
#include "hard_cases/hard_run.h"
#include "structures/scenes/band_scenes.h"
#include "structures/scenes/structure_scenes.h"
#include "support/suite.h"

#define RAYS 200u

/* ---- one ray's hits against the reference ---- */

/* What a check is about, for its message. */
typedef struct all_place {
    const cgt_scene *scene;
    const cgt_rays *rays;
    const char *name;
    uint64_t ray;
    cgt_precision precision;
} all_place;

static void check_hit(const all_place *p, const cgt_surface_hit *got, const reference_hit *want, uint32_t place)
{
    if (got->primitive != want->primitive || got->geometry != want->geometry || got->surface != (uint32_t)want->far)
        fail_msg("%s, structure %d, ray %u: hit %u: want primitive %u of %u, surface %d at %a, got %u of %u, %u at %a",
                 p->name, (int)p->scene->committed_scene.structure, (unsigned)p->ray, place, want->primitive,
                 want->geometry, want->far, (double)want->t, got->primitive, got->geometry, got->surface,
                 (double)got->t);
    if (p->precision == CGT_PRECISION_EXACT && !same_bits(got->t, want->t))
        fail_msg("%s, ray %u: hit %u at %a, not %a", p->name, (unsigned)p->ray, place, (double)got->t, (double)want->t);
}

/* ---- rows ---- */

/* Rows with all fields, hits in arrays of structs. */
typedef struct all_rows {
    cgt_surface_hit *hit;
    uint32_t count[RAYS];
    uint8_t more[RAYS];
    cgt_hit_rows rows;
} all_rows;

static void rows_make(all_rows *r, uint32_t capacity, bool more)
{
    cgt_surface_hit *h = r->hit = malloc(RAYS * capacity * sizeof *h);
    assert_non_null(h);
    memset(h, 0x55, RAYS * capacity * sizeof *h);
    r->rows = (cgt_hit_rows){.capacity = capacity,
                             .hits = {.stride = sizeof *h,
                                      .t = &h->t,
                                      .primitive = &h->primitive,
                                      .geometry = &h->geometry,
                                      .normal = {&h->normal[0], &h->normal[1], &h->normal[2]},
                                      .u = &h->u,
                                      .v = &h->v},
                             .surface = &h->surface,
                             .count = r->count,
                             .more = more ? r->more : NULL};
}

/* The first hit is that of cgt_trace_rays, all fields. */
static void check_first(const all_place *p, const cgt_surface_hit *got, const full_hit *nearest)
{
    const full_hit first = {
        got->t, got->primitive, got->geometry, {got->normal[0], got->normal[1], got->normal[2]}, {got->u, got->v}};
    if (memcmp(&first, nearest, sizeof first) != 0)
        fail_msg("%s, ray %u: first hit %u of %u at %a, nearest %u of %u at %a", p->name, (unsigned)p->ray,
                 first.primitive, first.geometry, (double)first.t, nearest->primitive, nearest->geometry,
                 (double)nearest->t);
}

/* Traces to rows, after a hit of each ray's line or from its begin, and checks them. Returns the number of hits. */
static uint32_t check_rows(all_place *p, reference_hits *want, uint32_t capacity, test_random *r)
{
    static full_hit nearest[RAYS];
    const bool goes_on = random_below(r, 3) == 0;
    const cgt_trace_options options = {.precision = p->precision};
    const cgt_hits to_nearest = hit_array(nearest);
    uint32_t after[3][RAYS], hits = 0;
    all_rows rows;
    rows_make(&rows, capacity, random_below(r, 2));
    for (uint32_t i = 0; i < p->rays->count; i++) {
        const reference_hits *w = &want[i];
        const reference_hit *h = w->count && random_below(r, 4) ? &w->hit[random_below(r, w->count)] : NULL;
        after[0][i] = h ? h->primitive : CGT_INVALID_ID;
        after[1][i] = h ? h->geometry : 0;
        after[2][i] = h ? h->far : 0;
    }
    const cgt_all_hits_options all = {
        .after_primitive = after[0], .after_geometry = after[1], .after_surface = after[2]};
    assert_int_equal(cgt_trace_all_rays(p->scene, p->rays, goes_on ? &all : NULL, &rows.rows, &options), CGT_OK);
    assert_int_equal(cgt_trace_rays(p->scene, p->rays, &to_nearest, &options), CGT_OK);
    for (uint32_t i = 0; i < p->rays->count; i++) {
        const reference_hits *w = &want[i];
        uint32_t first = 0;
        if (goes_on && after[0][i] != CGT_INVALID_ID)
            while (w->hit[first].primitive != after[0][i] || w->hit[first].geometry != after[1][i] ||
                   w->hit[first].far != after[2][i])
                first++;
        first += goes_on && after[0][i] != CGT_INVALID_ID;
        const uint32_t left = w->count - first, expected = left < capacity ? left : capacity;
        p->ray = i;
        if (rows.count[i] != expected || (rows.rows.more && rows.more[i] != (left > capacity)))
            fail_msg("%s, structure %d, ray %u: %u hits and %d more, not %u of %u", p->name,
                     (int)p->scene->committed_scene.structure, i, rows.count[i], rows.rows.more ? rows.more[i] : -1,
                     expected, left);
        for (uint32_t k = 0; k < expected; k++)
            check_hit(p, &rows.hit[i * capacity + k], &w->hit[first + k], k);
        if (expected && !first)
            check_first(p, &rows.hit[i * capacity], &nearest[i]);
        for (uint32_t k = expected; k < capacity; k++)
            assert_int_equal(rows.hit[i * capacity + k].primitive, 0x55555555);
        hits += expected;
    }
    free(rows.hit);
    return hits;
}

/* ---- visitor ---- */

typedef struct all_visit {
    const all_place *place;
    const reference_hits *want;
    uint32_t count[RAYS];
} all_visit;

static cgt_visit visit(void *user, uint64_t ray, const cgt_surface_hit *hits, uint32_t count)
{
    all_visit *v = user;
    all_place p = *v->place;
    p.ray = ray;
    if (!count || count > 64 || v->count[ray] + count > v->want[ray].count)
        fail_msg("%s, ray %u: %u hits after %u of %u", p.name, (unsigned)ray, count, v->count[ray], v->want[ray].count);
    for (uint32_t k = 0; k < count; k++)
        check_hit(&p, &hits[k], &v->want[ray].hit[v->count[ray] + k], v->count[ray] + k);
    v->count[ray] += count;
    return CGT_VISIT_CONTINUE;
}

static void check_visitor(const all_place *p, const reference_hits *want)
{
    const cgt_trace_options options = {.precision = p->precision};
    all_visit v = {.place = p, .want = want};
    assert_int_equal(cgt_visit_all_rays(p->scene, p->rays, NULL, 0, visit, &v, &options), CGT_OK);
    for (uint32_t i = 0; i < p->rays->count; i++)
        if (v.count[i] != want[i].count)
            fail_msg("%s, structure %d, ray %u: %u hits, not %u", p->name, (int)p->scene->committed_scene.structure, i,
                     v.count[i], want[i].count);
}

/* ---- single rays, a few hits at a time ---- */

static void check_single(all_place *p, const cgt_single_ray *ray, const reference_hits *want, uint32_t capacity)
{
    const cgt_trace_options options = {.precision = p->precision};
    cgt_surface_hit hit[8], last;
    cgt_all_hits_options all = {0};
    uint32_t found = 0, count;
    bool more;
    do {
        assert_int_equal(cgt_trace_all_ray(p->scene, ray, &all, hit, capacity, &count, &more, &options), CGT_OK);
        for (uint32_t k = 0; k < count && found + k < want->count; k++)
            check_hit(p, &hit[k], &want->hit[found + k], found + k);
        found += count;
        if (found > want->count || more != (found < want->count) || (more && count != capacity))
            fail_msg("%s, structure %d, ray %u: %u hits and more: %d, of %u", p->name,
                     (int)p->scene->committed_scene.structure, (unsigned)p->ray, found, more, want->count);
        last = hit[count ? count - 1 : 0];
        all = (cgt_all_hits_options){
            .after_primitive = &last.primitive, .after_geometry = &last.geometry, .after_surface = &last.surface};
    } while (more);
}

/* ---- scenes ---- */

static reference_hits *references_make(const cgt_scene *scene, const cgt_rays *rays)
{
    reference_hits *want = calloc(RAYS, sizeof *want);
    assert_non_null(want);
    for (uint32_t i = 0; i < rays->count; i++)
        reference_all_hits(scene, rays, i, &want[i]);
    return want;
}

static void references_free(reference_hits *want)
{
    for (uint32_t i = 0; i < RAYS; i++)
        free(want[i].hit);
    free(want);
}

static uint32_t check_scene(const cgt_scene *scene, const cgt_rays *rays, const char *name, reference_hits *want,
                            test_random *r)
{
    static const uint32_t capacities[] = {1, 2, 3, 4, 7, 70};
    all_place p = {.scene = scene, .rays = rays, .name = name};
    uint32_t hits = 0;
    for (int precision = 0; precision < 2; precision++) {
        p.precision = (cgt_precision)precision;
        hits += check_rows(&p, want, capacities[random_below(r, TEST_COUNT(capacities))], r);
        check_visitor(&p, want);
    }
    return hits;
}

TEST(hits_of_every_primitive_in_exact_order)
{
    uint32_t hits = 0, rounds = 0;
    FOR_EACH_VARIANT(variant)
    for (int kind = 0; kind < STRUCTURE_KINDS; kind++) {
        cgt_context *context = context_make(1 + (unsigned)kind % 3, variant);
        structure_scene s = structure_scene_make((structure_kind)kind, 4400 + (uint64_t)kind);
        test_random r = random_make(4500 + (uint64_t)kind);
        const bool large = kind == STRUCTURE_LARGE;
        structure_rays(&s, large ? 10 : RAYS);
        const cgt_rays rays = ray_array(s.scene.ray, large ? test_between(4, 10) : test_between(20, RAYS));
        reference_hits *want = NULL;
        for (uint32_t k = 0; k < TEST_STRUCTURES + 1; k++) {
            const cgt_scene_options made = k < TEST_STRUCTURES ? structure_in_turn(k) : (cgt_scene_options){0};
            cgt_scene *scene;
            assert_int_equal(hard_commit_with(context, &s.scene, &made, &scene), CGT_OK);
            assert_int_equal(cgt_scene_prepare(scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
            if (!want)
                want = references_make(scene, &rays);
            hits += check_scene(scene, &rays, s.name, want, &r);
            all_place p = {.scene = scene, .rays = &rays, .name = s.name};
            for (uint32_t i = 0; i < 6 && i < rays.count; i++) {
                p.ray = i;
                const cgt_single_ray ray = single_ray(&s.scene.ray[i]);
                check_single(&p, &ray, &want[i], 1 + random_below(&r, 8));
            }
            cgt_scene_release(scene);
            rounds++;
        }
        references_free(want);
        structure_scene_free(&s);
        cgt_context_release(context);
    }
    print_message("%u hits in %u rounds\n", hits, rounds);
    assert_true(hits > 100 * rounds);
}

TEST(hits_at_any_magnitude)
{
    static const test_scene_options every_structure[] = {{.structure = CGT_STRUCTURE_AUTO},
                                                         {.rays = CGT_RAY_KIND_INCOHERENT},
                                                         {.structure = CGT_STRUCTURE_LOOSE_GRID},
                                                         {.structure = CGT_STRUCTURE_KD}};
    uint32_t hits = 0, turn = 0;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(2, variant);
        for (uint32_t round = 0; round < (1 + test_scaled(6)) * BAND_KINDS; round++, turn++) {
            test_random r = random_make(4700 + turn);
            band_scene s =
                band_scene_make(&r, (band_kind)(round % BAND_KINDS), random_below(&r, 40), 1 + random_below(&r, 40));
            static band_rays q;
            band_rays_make(&r, &s, &q);
            cgt_rays rays = band_rays_all(&q);
            rays.count = RAYS;
            cgt_scene *scene =
                band_scene_commit(context, &every_structure[random_below(&r, TEST_COUNT(every_structure))], &s);
            reference_hits *want = references_make(scene, &rays);
            hits += check_scene(scene, &rays, scene->in_bands ? "bands" : "no bands", want, &r);
            references_free(want);
            cgt_scene_release(scene);
            band_scene_free(&s);
        }
        cgt_context_release(context);
    }
    print_message("%u hits in %u scenes\n", hits, turn);
    assert_true(hits > turn * RAYS / 10);
}

SEEDED_SUITE("test_all_hits", NULL, NULL)
