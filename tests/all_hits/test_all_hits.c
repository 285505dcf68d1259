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

static void check_hit(const all_place *p, const cgt_hit *got, const reference_hit *want, uint32_t place)
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
    cgt_hit *hit;
    uint32_t count[RAYS];
    uint8_t more[RAYS];
    cgt_hit_rows rows;
} all_rows;

static void rows_make(all_rows *r, uint32_t capacity, bool more)
{
    cgt_hit *h = r->hit = malloc(RAYS * capacity * sizeof *h);
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
static void check_first(const all_place *p, const cgt_hit *got, const full_hit *nearest)
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

/* All fields of rows have the bits that another structure gave. */
static void check_bits(const all_place *p, uint32_t capacity, all_rows *first)
{
    const cgt_trace_options options = {.precision = p->precision};
    all_rows rows;
    rows_make(&rows, capacity, true);
    memset(rows.count, 0, sizeof rows.count);
    memset(rows.more, 0, sizeof rows.more);
    assert_int_equal(cgt_trace_all_rays(p->scene, p->rays, NULL, &rows.rows, &options), CGT_OK);
    if (!first->hit) {
        *first = rows;
        return;
    }
    const size_t bytes = RAYS * capacity * sizeof *rows.hit;
    if (memcmp(first->hit, rows.hit, bytes) != 0 || memcmp(first->count, rows.count, sizeof rows.count) != 0 ||
        memcmp(first->more, rows.more, sizeof rows.more) != 0)
        fail_msg("%s, structure %d, precision %d: other bits", p->name, (int)p->scene->committed_scene.structure,
                 (int)p->precision);
    free(rows.hit);
}

/* ---- visitor ---- */

typedef struct all_visit {
    const all_place *place;
    const reference_hits *want;
    uint32_t count[RAYS];
} all_visit;

static cgt_visit visit(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
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
    cgt_hit hit[8], last;
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

/* The bits of a scene's first structure, of the first variant: those of all others. */
static void check_all_bits(const cgt_scene *scene, const cgt_rays *rays, const char *name, all_rows first[2])
{
    all_place p = {.scene = scene, .rays = rays, .name = name};
    for (int precision = 0; precision < 2; precision++) {
        p.precision = (cgt_precision)precision;
        check_bits(&p, 5, &first[precision]);
    }
}

TEST(hits_of_every_primitive_in_exact_order)
{
    static all_rows first[STRUCTURE_KINDS][2];
    const uint32_t step = test_samples() ? 4 : 1;
    uint32_t hits = 0, traced = 0;
    FOR_EACH_VARIANT(variant)
    for (int kind = 0; kind < STRUCTURE_KINDS; kind++) {
        cgt_context *context = context_make(1 + (unsigned)kind % 3, variant);
        structure_scene s = structure_scene_make((structure_kind)kind, 4400 + (uint64_t)kind);
        test_random r = random_make(4500 + (uint64_t)kind);
        const bool large = kind == STRUCTURE_LARGE;
        structure_rays(&s, large ? 10 : RAYS);
        const cgt_rays rays = ray_array(s.scene.ray, large ? test_between(4, 10) : test_between(20, RAYS));
        reference_hits *want = NULL;
        for (uint32_t k = test_sample_start((uint32_t)kind, step); k < TEST_STRUCTURES + 1; k += step) {
            const cgt_scene_options made = k < TEST_STRUCTURES ? structure_in_turn(k) : (cgt_scene_options){0};
            cgt_scene *scene;
            assert_int_equal(hard_commit_with(context, &s.scene, &made, &scene), CGT_OK);
            assert_int_equal(cgt_scene_prepare(scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
            if (!want)
                want = references_make(scene, &rays);
            hits += check_scene(scene, &rays, s.name, want, &r);
            check_all_bits(scene, &rays, s.name, first[kind]);
            all_place p = {.scene = scene, .rays = &rays, .name = s.name};
            for (uint32_t i = 0; i < 6 && i < rays.count; i++) {
                p.ray = i;
                const cgt_single_ray ray = single_ray(&s.scene.ray[i]);
                check_single(&p, &ray, &want[i], 1 + random_below(&r, 8));
            }
            cgt_scene_release(scene);
            traced += 2 * (uint32_t)rays.count; /* in two precisions */
        }
        references_free(want);
        structure_scene_free(&s);
        cgt_context_release(context);
    }
    for (int kind = 0; kind < STRUCTURE_KINDS; kind++)
        for (int precision = 0; precision < 2; precision++)
            free(first[kind][precision].hit);
    print_message("%u hits of %u rays\n", hits, traced);
    assert_true(hits > traced / 5);
}

/* Ranges that begin or end at hits, or right beside them. */
TEST(ranges_end_at_hits)
{
    uint32_t hits = 0, rounds = 0;
    FOR_EACH_VARIANT(variant)
    for (int kind = 0; kind < STRUCTURE_COINCIDENT; kind++) {
        cgt_context *context = context_make(1, variant);
        structure_scene s = structure_scene_make((structure_kind)kind, 4600 + (uint64_t)kind);
        test_random r = random_make(4650 + (uint64_t)kind);
        structure_rays(&s, 60);
        const cgt_rays rays = ray_array(s.scene.ray, 60);
        for (int k = 0; k < 2; k++) {
            const cgt_scene_options made = {.structure = k ? CGT_STRUCTURE_LOOSE_GRID : CGT_STRUCTURE_BVH};
            cgt_scene *scene;
            assert_int_equal(hard_commit_with(context, &s.scene, &made, &scene), CGT_OK);
            for (uint32_t i = 0; i < rays.count; i++) {
                s.scene.ray[i].t_min = -INFINITY;
                s.scene.ray[i].t_max = INFINITY;
            }
            reference_hits *want = references_make(scene, &rays);
            for (uint32_t i = 0; i < rays.count; i++) {
                const float t = want[i].count ? want[i].hit[random_below(&r, want[i].count)].t : 0;
                float *end = random_below(&r, 2) ? &s.scene.ray[i].t_min : &s.scene.ray[i].t_max;
                *end = random_below(&r, 3) ? nextafterf(t, random_below(&r, 2) ? INFINITY : -INFINITY) : t;
            }
            references_free(want);
            want = references_make(scene, &rays);
            hits += check_scene(scene, &rays, s.name, want, &r);
            references_free(want);
            cgt_scene_release(scene);
            rounds++;
        }
        structure_scene_free(&s);
        cgt_context_release(context);
    }
    print_message("%u hits in %u rounds\n", hits, rounds);
    assert_true(hits > 30 * rounds);
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

/* ---- capsules ---- */

#define CAPSULES 60u

typedef struct capsule_cloud {
    float end[2 * CAPSULES][3], radius[CAPSULES];
} capsule_cloud;

/* In a scene: on a lattice or anywhere, some with ends that they share, some of them strays for bands. */
static void capsules_make(test_random *r, const cloud *where, bool lattice, bool strays, capsule_cloud *c)
{
    for (uint32_t i = 0; i < 2 * CAPSULES; i++) {
        const float scale = strays && i % 20 >= 18 ? 0x1p60f : 1;
        for (int a = 0; a < 3; a++) {
            const float x = random_float(r, -1, 1);
            c->end[i][a] = (where->middle[a] + where->reach * (lattice ? rintf(8 * x) / 8 : x)) * scale;
        }
        if (i % 6 == 2)
            memcpy(c->end[i], c->end[i - 1], sizeof c->end[i]);
        c->radius[i / 2] = where->reach * scale * (lattice ? 0.125f : random_float(r, 0, 0.2f));
    }
}

TEST(capsules_among_others)
{
    static capsule_cloud c;
    uint32_t hits = 0, traced = 0, bands = 0;
    FOR_EACH_VARIANT(variant)
    for (int kind = 0; kind < STRUCTURE_COINCIDENT; kind++) {
        cgt_context *context = context_make(1 + (unsigned)kind % 3, variant);
        structure_scene s = structure_scene_make((structure_kind)kind, 4900 + (uint64_t)kind);
        test_random r = random_make(4950 + (uint64_t)kind);
        const cgt_capsules capsules = {.count = CAPSULES,
                                       .vertex_count = 2 * CAPSULES,
                                       .vertices = cgt_floats(c.end[0], 0),
                                       .radii = cgt_floats(c.radius, 0)};
        const cgt_scene_options made = {.rays = (cgt_ray_kind)(kind % 2)};
        cgt_scene *scene;
        capsules_make(&r, &s.where, kind % 2, kind % 4 == 3, &c);
        structure_rays(&s, 60);
        for (uint32_t i = 0; i < 60; i += 2) { /* at an end, or between both */
            const uint32_t q = random_below(&r, CAPSULES);
            for (int a = 0; a < 3; a++)
                s.scene.ray[i].dir[a] =
                    (i % 4 ? c.end[2 * q][a] : 0.5f * (c.end[2 * q][a] + c.end[2 * q + 1][a])) - s.scene.ray[i].org[a];
        }
        const cgt_rays rays = ray_array(s.scene.ray, 60);
        assert_int_equal(hard_commit_with(context, &s.scene, &made, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &capsules), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        reference_hits *want = references_make(scene, &rays);
        hits += check_scene(scene, &rays, s.name, want, &r);
        all_place p = {.scene = scene, .rays = &rays, .name = s.name};
        for (uint32_t i = 0; i < 10; i++) {
            const cgt_single_ray ray = single_ray(&s.scene.ray[i]);
            p.ray = i;
            check_single(&p, &ray, &want[i], 1 + random_below(&r, 8));
        }
        references_free(want);
        bands += scene->in_bands;
        traced += 2 * (uint32_t)rays.count;
        cgt_scene_release(scene);
        structure_scene_free(&s);
        cgt_context_release(context);
    }
    print_message("%u hits of %u rays, %u scenes in bands\n", hits, traced, bands);
    assert_true(hits > traced && bands > 2);
}

/* ---- hard cases ---- */

typedef enum hard_kind {
    HARD_FAN,        /* triangles around a vertex, rays through it and along their edges */
    HARD_COPIES,     /* copies of a triangle and of a sphere */
    HARD_CONCENTRIC, /* spheres around the origin, rays that touch them, and points */
    HARD_ROW,        /* spheres that touch one another along a ray */
    HARD_KINDS
} hard_kind;

#define HARD_COUNT 90u /* of a kind: more than a list, or a band's, holds */
#define HARD_RAYS 30u

static const char *const hard_name[HARD_KINDS] = {"fan", "copies", "concentric", "row"};

static hard_scene hard_make(hard_kind kind, double scale)
{
    hard_scene s = {.place = {.scale = scale}, .random = random_make(4800 + (uint64_t)kind), .wanted = HARD_RAYS};
    static const double here[3] = {0, 0, 0}, triangle[3][3] = {{-4, -4, 1}, {8, -4, 1}, {-4, 8, 1}};
    for (uint32_t i = 0; i < HARD_COUNT; i++) {
        const double x = i, next = i + 1.;
        const double blade[3][3] = {{0, 0, 0}, {8 * (x - 45), 300, (double)(i % 3) - 1}, {8 * (next - 45), 300, 1}};
        const double along[3] = {2 * x, 0, 0};
        if (kind == HARD_FAN || kind == HARD_COPIES)
            hard_triangle(&s, kind == HARD_FAN ? blade : triangle);
        else
            hard_sphere(&s, kind == HARD_ROW ? along : here, kind == HARD_ROW ? 1 : x);
    }
    hard_new_geometry(&s);
    for (uint32_t i = 0; i < HARD_COUNT && kind == HARD_COPIES; i++)
        hard_sphere(&s, here, 2);
    for (uint32_t i = 0; hard_wants_ray(&s); i++) {
        const double at = 3 * i % HARD_COUNT, turned = i % 4 ? 0 : 1;
        const double org[3] = {kind == HARD_ROW          ? -300
                               : kind == HARD_CONCENTRIC ? at
                                                         : turned,
                               0, kind == HARD_ROW ? 0 : -300};
        const float dir[3] = {kind == HARD_ROW ? 3 : 0, 0, kind == HARD_ROW ? 0 : 2},
                    aimed[3] = {-(float)turned, 0, 300};
        hard_ray(&s, org, kind == HARD_FAN ? aimed : dir);
    }
    assert_false(s.failed);
    return s;
}

/* A line at distance x from the middle of spheres of radii 0 to 89 enters and leaves those that are larger, and touches
 * the one that is equal, once. */
static void check_concentric(const reference_hits *want, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(want[i].count, 2 * (HARD_COUNT - 1 - 3 * i % HARD_COUNT) + 1);
}

TEST(hard_cases)
{
    static const double scales[] = {1, 0x1p-30, 0x1p-100, 0x1p50};
    const uint32_t step = test_samples() ? 4 : 1, used = test_between(8, HARD_RAYS);
    uint32_t hits = 0;
    for (int kind = 0; kind < HARD_KINDS; kind++)
        for (size_t k = 0; k < TEST_COUNT(scales); k++) {
            hard_scene s = hard_make((hard_kind)kind, scales[k]);
            test_random r = random_make(4850 + (uint64_t)kind * 8 + k);
            for (uint32_t i = 0; i < s.rays; i++) /* all of the line, half of the time */
                s.ray[i].t_min = i % 2 ? -INFINITY : 0;
            const cgt_rays rays = ray_array(s.ray, used);
            reference_hits *want = NULL;
            all_rows first[2] = {{0}};
            FOR_EACH_VARIANT(variant)
            {
                cgt_context *context = context_make(1 + random_below(&r, 3), variant);
                for (uint32_t w = test_sample_start((uint32_t)k, step); w < TEST_STRUCTURES; w += step) {
                    const cgt_scene_options made = structure_in_turn(w);
                    cgt_scene *scene;
                    assert_int_equal(hard_commit_with(context, &s, &made, &scene), CGT_OK);
                    if (!want)
                        want = references_make(scene, &rays);
                    hits += check_scene(scene, &rays, hard_name[kind], want, &r);
                    check_all_bits(scene, &rays, hard_name[kind], first);
                    all_place p = {.scene = scene, .rays = &rays, .name = hard_name[kind]};
                    for (uint32_t i = 0; i < 4; i++) {
                        p.ray = random_below(&r, used);
                        const cgt_single_ray ray = single_ray(&s.ray[p.ray]);
                        check_single(&p, &ray, &want[p.ray], 1 + random_below(&r, 8));
                    }
                    cgt_scene_release(scene);
                }
                cgt_context_release(context);
            }
            if (kind == HARD_CONCENTRIC)
                check_concentric(want, used);
            free(first[0].hit);
            free(first[1].hit);
            references_free(want);
            hard_scene_free(&s);
        }
    print_message("%u hits\n", hits);
    assert_true(hits > 1600 * used / step);
}

/* ---- values of far surfaces ---- */

/* A far surface has the bits that cgt_trace_rays gives a ray that begins behind the near one. */
TEST(far_surfaces_as_nearest_hits)
{
    test_random r = random_make(4900);
    cgt_context *context = context_make(1, NULL);
    uint32_t compared = 0;
    for (uint32_t round = 0; round < test_scaled(400); round++) {
        float sphere[1][4];
        for (int a = 0; a < 3; a++)
            sphere[0][a] = random_float(&r, -1, 1);
        sphere[0][3] = random_log(&r, 1e-3f, 3);
        cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])sphere, 1);
        for (int i = 0; i < 20; i++) {
            cgt_single_ray ray = {.t_min = -INFINITY, .t_max = INFINITY};
            float to[3];
            random_direction(&r, to);
            for (int a = 0; a < 3; a++) {
                ray.org[a] = random_float(&r, -3, 3);
                ray.dir[a] = sphere[0][a] + to[a] * sphere[0][3] * random_float(&r, 0, 1) - ray.org[a];
            }
            for (int precision = 0; precision < 2; precision++) {
                const cgt_trace_options options = {.precision = (cgt_precision)precision};
                cgt_hit hit[2];
                cgt_hit nearest;
                cgt_single_ray behind = ray;
                uint32_t count;
                assert_int_equal(cgt_trace_all_ray(scene, &ray, NULL, hit, 2, &count, NULL, &options), CGT_OK);
                if (count < 2)
                    continue;
                behind.t_min = nextafterf(hit[0].t, INFINITY);
                assert_int_equal(cgt_trace_ray(scene, &behind, &nearest, &options), CGT_OK);
                if (precision && nearest.t == hit[0].t)
                    continue; /* the near one, whose t is less exact */
                if (hit[1].t < behind.t_min)
                    continue;
                compared++;
                const cgt_hit far = {.t = hit[1].t,
                                     .primitive = hit[1].primitive,
                                     .geometry = hit[1].geometry,
                                     .surface = CGT_SURFACE_FAR,
                                     .normal = {hit[1].normal[0], hit[1].normal[1], hit[1].normal[2]}};
                if (!precision)
                    assert_memory_equal(&far, &nearest, sizeof far);
                else if (nearest.t > hit[0].t * (1 + 1e-3f))
                    assert_memory_equal(&far, &nearest, sizeof far);
            }
        }
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
    print_message("%u far surfaces\n", compared);
    assert_true(compared > test_scaled(400) * 10);
}

/* ---- calls ---- */

static cgt_visit stop_at_once(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    (void)ray, (void)hits, (void)count;
    ++*(unsigned *)user;
    return CGT_VISIT_STOP;
}

TEST(a_visitor_stops_the_trace)
{
    static const float sphere[1][4] = {{0, 0, 0, 1}}, zero[8] = {0}, one[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    const cgt_rays rays = {.count = 8, .org = {zero, zero, zero}, .dir = {one, one, zero}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    unsigned visits = 0;
    assert_int_equal(cgt_visit_all_rays(scene, &rays, NULL, 0, stop_at_once, &visits, NULL), CGT_ERROR_STOPPED);
    assert_int_equal(visits, 1);
    assert_non_null(strstr(context_message(context), "stopped"));
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* A hit to go on after that is none: the ray is invalid, and no other one is. */
TEST(after_no_hit)
{
    const float sphere[4][4] = {{0, 0, 0, 1}, {0, 0, 5, 1}, {9, 9, 9, 1}, {0, 0, NAN, 1}};
    const float beside[9] = {5, 5, 3, 6, 5, 3, 5, 6, 3}; /* a triangle whose plane the ray meets */
    const cgt_triangles triangles = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(beside, 0)};
    const uint32_t cases[][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 1},         {CGT_INVALID_ID, 7, 7},
                                 {2, 0, 0}, {3, 0, 0}, {4, 0, 0},         {0, 1, 0},
                                 {0, 2, 0}, {0, 0, 2}, {1, 0, UINT32_MAX}};
    const uint32_t hits[] = {3, 2, 0, 4};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 4);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    const cgt_single_ray ray = {.org = {0, 0, -9}, .dir = {0, 0, 1}};
    for (size_t k = 0; k < TEST_COUNT(cases); k++) {
        const cgt_all_hits_options all = {
            .after_primitive = &cases[k][0], .after_geometry = &cases[k][1], .after_surface = &cases[k][2]};
        cgt_trace_statistics statistics;
        const cgt_trace_options options = {.statistics = &statistics};
        cgt_hit hit[8];
        uint32_t count = 77;
        bool more = true;
        assert_int_equal(cgt_trace_all_ray(scene, &ray, &all, hit, 8, &count, &more, &options), CGT_OK);
        const bool valid = k < TEST_COUNT(hits);
        assert_int_equal(count, valid ? hits[k] : 0);
        assert_int_equal(more, false);
        assert_true(statistics.rays == 1 && statistics.invalid_rays == !valid && statistics.hits == count);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_all_hits", NULL, NULL)
