/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Crossings of closed meshes by rays aimed exactly at edges and vertices: their number and their sides are those of the
 * winding number, which a judge finds by arithmetic of its own (crossing_cases.h). Points inside likewise. */
#include <cgt/all_hits.h>

#include <stdlib.h>
#include <string.h>

#include "all_hits/crossing_cases.h"
#include "support/scenes.h"
#include "support/suite.h"

#define RAYS 64u
#define ROW 3u

/* ---- a mesh with its rays ---- */

typedef struct crossing_case {
    crossing_mesh mesh;
    float (*vertex)[3];
    float org[3][RAYS], dir[3][RAYS], t_min[RAYS];
    int winding[RAYS];
    bool known[RAYS];
    cgt_rays rays;
} crossing_case;

/* In units of 2^exponent. Half of the t_min are minus infinity: the whole line is crossed. */
static void case_make(crossing_case *c, closed_kind kind, crossing_shape shape, int exponent, test_random *r)
{
    *c = (crossing_case){.vertex = NULL};
    assert_true(crossing_mesh_make(&c->mesh, kind, shape, r));
    c->vertex = malloc(3 * c->mesh.triangles * sizeof *c->vertex);
    assert_non_null(c->vertex);
    for (uint32_t i = 0; i < 9 * c->mesh.triangles; i++)
        c->vertex[i / 3][i % 3] = ldexpf((float)c->mesh.corner[i / 9][i / 3 % 3][i % 3], exponent);
    for (uint32_t i = 0; i < RAYS; i++) {
        const crossing_ray ray = crossing_ray_make(&c->mesh, r);
        for (int a = 0; a < 3; a++) {
            c->org[a][i] = ldexpf((float)ray.org[a], exponent);
            c->dir[a][i] = (float)ray.dir[a];
        }
        c->known[i] = crossing_winding(&c->mesh, ray.org, r, &c->winding[i]);
        c->t_min[i] = random_below(r, 4) ? 0 : -INFINITY;
        if (c->t_min[i] < 0)
            c->winding[i] = 0, c->known[i] = true;
    }
    c->rays = (cgt_rays){.count = RAYS,
                         .org = {c->org[0], c->org[1], c->org[2]},
                         .dir = {c->dir[0], c->dir[1], c->dir[2]},
                         .t_min = c->t_min};
}

static void case_free(crossing_case *c)
{
    crossing_mesh_free(&c->mesh);
    free(c->vertex);
}

static cgt_scene *scene_of_case(cgt_context *context, const cgt_scene_options *options, const crossing_case *c)
{
    const cgt_triangles triangles = {
        .count = c->mesh.triangles, .vertices = cgt_floats(c->vertex[0], 0), .vertex_count = 3 * c->mesh.triangles};
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* ---- crossings ---- */

/* What a visitor has seen of each ray. */
typedef struct crossing_sums {
    int count[RAYS], sum[RAYS];
    cgt_hit first[RAYS][ROW];
} crossing_sums;

static cgt_visit add_hits(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    crossing_sums *s = user;
    for (uint32_t k = 0; k < count; k++) {
        if (s->count[ray] < (int)ROW)
            s->first[ray][s->count[ray]] = hits[k];
        s->count[ray]++;
        s->sum[ray] += hits[k].surface == CGT_SURFACE_FAR ? 1 : -1;
    }
    return CGT_VISIT_CONTINUE;
}

/* Rays whose crossings are judged, and those whose parity or sum is wrong. */
typedef struct crossing_tally {
    uint64_t rays, on_surface, wrong;
} crossing_tally;

static void count_rays(const cgt_scene *scene, const crossing_case *c, crossing_sums *s, crossing_tally *tally)
{
    const cgt_all_hits_options all = {.crossings = true};
    memset(s, 0, sizeof *s);
    assert_int_equal(cgt_visit_all_rays(scene, &c->rays, &all, 0, add_hits, s, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        tally->rays += c->known[i];
        tally->on_surface += !c->known[i];
        const bool wrong = c->known[i] && (s->sum[i] != c->winding[i] || (s->count[i] - c->winding[i]) % 2);
        if (wrong && !tally->wrong++)
            print_message("%s, shape %d: ray %u from %a, %a, %a along %a, %a, %a: %d crossings, sum %d, winding %d\n",
                          closed_mesh_name(c->mesh.kind), (int)c->mesh.shape, i, (double)c->org[0][i],
                          (double)c->org[1][i], (double)c->org[2][i], (double)c->dir[0][i], (double)c->dir[1][i],
                          (double)c->dir[2][i], s->count[i], s->sum[i], c->winding[i]);
    }
}

/* Rows have what the visitor has seen; calls that go on after a crossing find the next one. */
static void check_rows(const cgt_scene *scene, const crossing_case *c, const crossing_sums *s)
{
    uint32_t primitive[RAYS * ROW], surface[RAYS * ROW], count[RAYS], next[RAYS], next_count[RAYS];
    uint8_t more[RAYS];
    const cgt_hit_rows rows = {
        .capacity = ROW, .hits = {.primitive = primitive}, .surface = surface, .count = count, .more = more};
    cgt_all_hits_options all = {.crossings = true};
    assert_int_equal(cgt_trace_all_rays(scene, &c->rays, &all, &rows, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        assert_int_equal(count[i], s->count[i] < (int)ROW ? s->count[i] : (int)ROW);
        assert_int_equal(more[i], s->count[i] > (int)ROW);
        for (uint32_t k = 0; k < count[i]; k++) {
            assert_int_equal(primitive[ROW * i + k], s->first[i][k].primitive);
            assert_int_equal(surface[ROW * i + k], s->first[i][k].surface);
        }
        primitive[ROW * i] = count[i] ? primitive[ROW * i] : CGT_INVALID_ID;
    }
    all.after_primitive = primitive;
    all.after_surface = surface;
    all.after_stride = ROW * sizeof *primitive;
    const cgt_hit_rows next_rows = {.capacity = 1, .hits = {.primitive = next}, .count = next_count};
    assert_int_equal(cgt_trace_all_rays(scene, &c->rays, &all, &next_rows, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        if (!s->count[i])
            continue;
        assert_int_equal(next_count[i], s->count[i] > 1);
        if (next_count[i])
            assert_int_equal(next[i], s->first[i][1].primitive);
    }
}

/* ---- points ---- */

static void check_inside(const cgt_scene *scene, const crossing_case *c)
{
    const cgt_points points = {.count = RAYS, .position = {c->org[0], c->org[1], c->org[2]}};
    uint8_t inside[2][RAYS];
    for (int rule = 0; rule < 2; rule++) {
        const cgt_inside_options how = {.rule = (cgt_inside_rule)rule};
        assert_int_equal(cgt_points_inside(scene, &points, &how, inside[rule], NULL), CGT_OK);
    }
    for (uint32_t i = 0; i < RAYS; i++) {
        if (!c->known[i] || c->t_min[i] < 0)
            continue;
        assert_int_equal(inside[CGT_INSIDE_PARITY][i], c->winding[i] % 2 != 0);
        assert_int_equal(inside[CGT_INSIDE_WINDING][i], c->winding[i] != 0);
    }
}

/* ---- aimed rays through every structure ---- */

TEST(aimed_rays)
{
    static const int exponents[] = {0, 0, 100, -100, -149};
    static crossing_sums sums;
    const uint32_t each = CLOSED_KINDS * CROSSING_SHAPES, scaled = test_scaled(400),
                   cases = scaled > each ? scaled : each;
    crossing_tally tally = {0};
    test_random r = random_make(440);
    if (!CROSSING_JUDGE) {
        print_message("no integers of 128 bits: no judge\n");
        return;
    }
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(2, variant);
        for (uint32_t i = 0; i < cases; i++) {
            crossing_case c;
            const test_way *way = way_in_turn(i % 3 ? WAY_EACH : WAY_CHOSEN, i);
            case_make(&c, (closed_kind)(i % CLOSED_KINDS), (crossing_shape)(i / CLOSED_KINDS % CROSSING_SHAPES),
                      exponents[random_below(&r, TEST_COUNT(exponents))], &r);
            cgt_scene *scene = scene_of_case(context, SCENE_OPTIONS(&way->scene), &c);
            count_rays(scene, &c, &sums, &tally);
            if (i % 4 == 0)
                check_rows(scene, &c, &sums);
            check_inside(scene, &c);
            cgt_scene_release(scene);
            case_free(&c);
        }
        cgt_context_release(context);
    }
    print_message("%llu rays judged, %llu not: from the surface of fine meshes; %llu wrong\n",
                  (unsigned long long)tally.rays, (unsigned long long)tally.on_surface,
                  (unsigned long long)tally.wrong);
    assert_int_equal(tally.wrong, 0);
    assert_true(tally.rays > 2 * tally.on_surface);
}

SEEDED_SUITE("test_crossings", NULL, NULL)
