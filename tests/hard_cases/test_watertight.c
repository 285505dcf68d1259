/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Closed meshes do not leak: rays at points of their edges and at their vertices, from inside and from outside towards
 * an inner point; near 0, far from it, tiny and huge. Every such ray hits the surface, so a miss is a leak and no
 * reference is needed. The oracle also judges every hundredth answer. Structures take turns. */
#include "support/test.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard_cases/hard_run.h"
#include "support/scenes.h"

#define ALL_RAYS 4000000u
#define CHUNK 1024u      /* rays per call, and */
#define LEAST_CHUNK 128u /* the same where it is slow */
#define JUDGED 100u      /* the oracle judges one ray per interval */
#define BUNDLE 32u       /* rays of a common origin */
#define MOST_VARIANTS 8

typedef struct location {
    const char *name;
    hard_place place;
} location;

static const location locations[] = {{"1", HARD_HERE},
                                     {"1e-6", HARD_TINY},
                                     {"1e6", HARD_LARGE},
                                     {"2^-50", HARD_2M50},
                                     {"2^50", HARD_2P50},
                                     {"2 at (148376, 1234, -223423)", HARD_FAR},
                                     {"1e-3 at (1, 1, 1)", {1e-3, {1, 1, 1}}}};

static const uint32_t details[CLOSED_KINDS] = {
    [CLOSED_CUBE] = 4, [CLOSED_OCTAHEDRON] = 4, [CLOSED_ICOSPHERE] = 5, [CLOSED_TORUS] = 24, [CLOSED_COLUMN] = 32};

/* ---- a mesh in every variant ---- */

typedef struct subject {
    closed_mesh mesh;
    hard_scene s;
    oracle_scene oracle;
    size_t variants;
    const char *variant[MOST_VARIANTS];
    cgt_context *context[MOST_VARIANTS];
    cgt_scene *scene[MOST_VARIANTS];
    cgt_scene *fast[MOST_VARIANTS]; /* in a grid: a BVH has no FAST of its own */
} subject;

static void commit_in_all(subject *w)
{
    static uint32_t subjects;
    uint32_t turn = subjects++;
    w->variants = 0;
    FOR_EACH_VARIANT(variant)
    {
        assert_true(w->variants < MOST_VARIANTS);
        w->variant[w->variants] = variant;
        w->context[w->variants] = context_make(1, variant);
        const cgt_scene_options made = structure_in_turn(turn++), grid = {.structure = CGT_STRUCTURE_QUEUE_GRID};
        if (hard_commit_with(w->context[w->variants], &w->s, &made, &w->scene[w->variants]) != CGT_OK ||
            hard_commit_with(w->context[w->variants], &w->s, &grid, &w->fast[w->variants]) != CGT_OK)
            fail_msg("%s: %s", variant, context_message(w->context[w->variants]));
        w->variants++;
    }
    assert_true(w->variants > 0);
}

static void subject_make(subject *w, closed_kind kind, hard_place place, uint64_t stream)
{
    const double middle[3] = {0, 0, 0};
    *w = (subject){.s = {.wanted = CHUNK, .place = place, .random = random_make(stream)}};
    assert_true(closed_mesh_make(&w->mesh, kind, details[kind]));
    hard_mesh(&w->s, &w->mesh, 1, middle);
    assert_false(w->s.failed);
    const hard_geometry *g = &w->s.geometry[0];
    oracle_scene_add_triangles(&w->oracle, 0, (const float(*)[3])g->vertex, g->vertices, (const uint32_t(*)[3])g->index,
                               g->triangles);
    commit_in_all(w);
}

static void release_all(subject *w)
{
    for (size_t v = 0; v < w->variants; v++) {
        cgt_scene_release(w->scene[v]);
        cgt_scene_release(w->fast[v]);
        cgt_context_release(w->context[v]);
    }
    w->variants = 0;
}

static void subject_free(subject *w)
{
    release_all(w);
    oracle_scene_free(&w->oracle);
    hard_scene_free(&w->s);
    closed_mesh_free(&w->mesh);
}

/* ---- rays ---- */

/* A vertex, a point of an edge rounded to float, or the middle of one. */
static void edge_point(hard_scene *s, float point[3])
{
    float v[3][3];
    assert_true(hard_any_triangle(s, v));
    const int k = (int)random_below(&s->random, 3), l = (k + 1) % 3;
    const uint32_t how = random_below(&s->random, 4);
    const double share = how == 0 ? 0 : how == 1 ? 0.5 : hard_real(s, 0, 1);
    for (int a = 0; a < 3; a++)
        point[a] = (float)(v[k][a] + share * ((double)v[l][a] - v[k][a]));
}

/* Bundles of rays: half of them from inside, the others from outside through a point of an edge to a point inside. */
static void make_rays(subject *w)
{
    hard_scene *s = &w->s;
    float inside[3] = {0}, point[3], org[3];
    s->rays = 0;
    for (uint32_t n = 0; hard_wants_ray(s); n++) {
        if (n % BUNDLE == 0) {
            double p[3];
            closed_mesh_inside(&w->mesh, &s->random, p);
            hard_put(s, p, inside);
        }
        edge_point(s, point);
        if (n / BUNDLE % 2) {
            hard_aim(s, inside, point, 1);
            continue;
        }
        const double beyond = hard_real(s, 1.5, 4);
        for (int a = 0; a < 3; a++)
            org[a] = (float)(inside[a] + beyond * ((double)point[a] - inside[a]));
        hard_aim(s, org, inside, 1);
    }
    assert_false(s->failed);
}

/* ---- answers ---- */

typedef struct leaks {
    uint64_t rays, leaked, judged, fast_leaked;
} leaks;

static void fail_ray(const subject *w, size_t v, uint32_t i, const char *what)
{
    const truth_ray *ray = &w->s.ray[i];
    fail_msg("%s, %s: %s: org %a %a %a dir %a %a %a", closed_mesh_name(w->mesh.kind), w->variant[v], what,
             (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0], (double)ray->dir[1],
             (double)ray->dir[2]);
}

static void check_answers(const subject *w, size_t v, const uint32_t *primitive, leaks *sum)
{
    for (uint32_t i = 0; i < w->s.rays; i++) {
        if (primitive[i] == CGT_INVALID_ID)
            fail_ray(w, v, i, "a leak");
        if (sum->rays++ % JUDGED)
            continue;
        oracle_hit exact;
        sum->judged++;
        if (oracle_judge(&w->oracle, &w->s.ray[i], 0, primitive[i], &exact) != ORACLE_RIGHT)
            fail_ray(w, v, i, "not the closest triangle");
    }
}

static uint64_t count_misses(const uint32_t *primitive, uint32_t count)
{
    uint64_t misses = 0;
    for (uint32_t i = 0; i < count; i++)
        misses += primitive[i] == CGT_INVALID_ID;
    return misses;
}

static void trace(const subject *w, const cgt_scene *scene, uint32_t *primitive, const test_trace_options *options)
{
    const cgt_rays rays = ray_array(w->s.ray, w->s.rays);
    const cgt_hits hits = {.primitive = primitive};
    memset(primitive, 0x77, CHUNK * sizeof *primitive);
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, options ? TRACE_OPTIONS(options) : NULL), CGT_OK);
}

/* Traces rays at one mesh in one place, chunk by chunk, with the variants taking turns. */
static void check_mesh(closed_kind kind, const location *at, uint32_t rays, leaks *sum)
{
    subject w;
    uint32_t primitive[CHUNK];
    test_trace_options fast = {0};
    fast.precision = CGT_PRECISION_FAST;
    fast.triangle_test = CGT_TRIANGLE_TEST_MOLLER_TRUMBORE;
    subject_make(&w, kind, at->place, (uint64_t)kind * 100 + (uint64_t)(at - locations));
    const uint32_t least = (uint32_t)w.variants, all = rays / CHUNK + 1, chunks = all < least ? least : all;
    if (rays / chunks < CHUNK)
        w.s.wanted = rays / chunks < LEAST_CHUNK ? LEAST_CHUNK : rays / chunks;
    for (uint32_t c = 0; c < chunks; c++) {
        const size_t v = c % w.variants;
        make_rays(&w);
        trace(&w, w.scene[v], primitive, NULL);
        check_answers(&w, v, primitive, sum);
        if (at == locations) { /* where single precision has its full range */
            trace(&w, w.fast[v], primitive, &fast);
            sum->fast_leaked += count_misses(primitive, w.s.rays);
        }
    }
    subject_free(&w);
}

/* ---- tests ---- */

static void check_kind(closed_kind kind)
{
    leaks sum = {0};
    const size_t places = TEST_COUNT(locations);
    for (size_t i = 0; i < places; i++)
        check_mesh(kind, &locations[i], test_scaled(ALL_RAYS) / (uint32_t)(places * CLOSED_KINDS), &sum);
    print_message("%s: %llu rays, none leaked, %llu judged; of those near 0 FAST with Moeller-Trumbore leaks %llu\n",
                  closed_mesh_name(kind), (unsigned long long)sum.rays, (unsigned long long)sum.judged,
                  (unsigned long long)sum.fast_leaked);
    assert_true(sum.judged >= sum.rays / JUDGED);
    if (!sum.fast_leaked) /* the rays are those on which single precision leaks */
        fail_msg("%s: even single precision does not leak: the rays are not hard", closed_mesh_name(kind));
}

TEST(test_cube) { check_kind(CLOSED_CUBE); }
TEST(test_octahedron) { check_kind(CLOSED_OCTAHEDRON); }
TEST(test_icosphere) { check_kind(CLOSED_ICOSPHERE); }
TEST(test_torus) { check_kind(CLOSED_TORUS); }
TEST(test_column) { check_kind(CLOSED_COLUMN); }

/* The premise of the tests above. */
TEST(test_meshes_are_closed)
{
    for (int kind = 0; kind < CLOSED_KINDS; kind++)
        for (uint32_t detail = 3; detail < 12; detail++) {
            closed_mesh mesh;
            assert_true(closed_mesh_make(&mesh, (closed_kind)kind, detail));
            if (!closed_mesh_is_closed(&mesh))
                fail_msg("%s of detail %u is open", closed_mesh_name((closed_kind)kind), (unsigned)detail);
            mesh.triangles--;
            assert_false(closed_mesh_is_closed(&mesh));
            closed_mesh_free(&mesh);
        }
}

/* A mesh that lacks a triangle leaks, and this test detects it. */
TEST(test_open_mesh_leaks)
{
    subject w;
    uint32_t primitive[CHUNK];
    const hard_place here = HARD_HERE;
    subject_make(&w, CLOSED_ICOSPHERE, here, 7);
    release_all(&w);
    make_rays(&w); /* at edges of all triangles */
    w.s.geometry[0].triangles -= 8;
    commit_in_all(&w);
    for (size_t v = 0; v < w.variants; v++) {
        trace(&w, w.scene[v], primitive, NULL);
        const uint64_t misses = count_misses(primitive, w.s.rays);
        assert_true(misses > 0 && misses < w.s.rays / 4);
    }
    subject_free(&w);
}

SEEDED_SUITE("test_watertight", NULL, NULL)
