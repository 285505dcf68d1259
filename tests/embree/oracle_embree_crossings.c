/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Crossings of closed meshes beside the ways that users of Embree take, in its robust mode: a filter that counts every
 * hit and refuses it, and a loop that goes on at the next float behind each hit. Rays are aimed exactly at edges and
 * vertices; a judge of its own knows their winding numbers (crossing_cases.h). Crossings must all be right. */
#include <cgt/all_hits.h>

#include <math.h>
#include <stdio.h>

#include "all_hits/crossing_cases.h"
#include "embree/embree_scene.h"
#include "support/scenes.h"
#include "support/suite.h"

#define RAYS 256u
#define MOST_HITS 100000

enum { CROSSINGS, FILTER, RESTART, WAYS };
static const char *const way_name[WAYS] = {"libcgt's crossings", "Embree's filter", "Embree, from hit to hit"};
static const char *const shape_name[] = {"fine", "thin"};

/* Rays whose hits are as many as the crossings, fewer, or more; and those whose parity is wrong. */
typedef struct tally {
    uint64_t rays, right, fewer, more, wrong_parity;
} tally;

typedef struct counting {
    struct RTCIntersectContext context; /* first: Embree hands out its address */
    int hits;
} counting;

static void count_hit(const struct RTCFilterFunctionNArguments *f)
{
    ((counting *)(void *)f->context)->hits++;
    f->valid[0] = 0;
}

/* Intersects once; returns whether a hit was kept. */
static bool intersect(RTCScene scene, counting *c, const truth_ray *ray, float *t)
{
    struct RTCRayHit query = embree_query(ray, *t, INFINITY);
    rtcIntersect1(scene, &c->context, &query);
    *t = query.ray.tfar;
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

static int count_by_filter(RTCScene scene, const truth_ray *ray)
{
    counting c = {.hits = 0};
    float t = 0;
    rtcInitIntersectContext(&c.context);
    c.context.filter = count_hit;
    assert_false(intersect(scene, &c, ray, &t));
    return c.hits;
}

static int count_by_restart(RTCScene scene, const truth_ray *ray)
{
    counting c = {.hits = 0};
    float t = 0;
    rtcInitIntersectContext(&c.context);
    for (; c.hits < MOST_HITS && intersect(scene, &c, ray, &t); c.hits++)
        t = nextafterf(t, INFINITY);
    return c.hits;
}

static void count_crossings(cgt_context *context, const hard_scene *s, int count[])
{
    const cgt_all_hits_options all = {.crossings = true};
    const cgt_triangles triangles = {.count = s->geometry[0].triangles,
                                     .indices = cgt_uint32s(s->geometry[0].index[0], 0),
                                     .vertices = cgt_floats(s->geometry[0].vertex[0], 0),
                                     .vertex_count = s->geometry[0].vertices};
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    for (uint32_t i = 0; i < s->rays; i++) {
        static cgt_hit hits[1000];
        cgt_single_ray ray = {.mask = UINT32_MAX};
        uint32_t hits_found;
        bool more;
        for (int a = 0; a < 3; a++) {
            ray.org[a] = s->ray[i].org[a];
            ray.dir[a] = s->ray[i].dir[a];
        }
        assert_int_equal(
            cgt_trace_all_ray(scene, &ray, &all, hits, (uint32_t)TEST_COUNT(hits), &hits_found, &more, NULL), CGT_OK);
        assert_false(more);
        count[i] = (int)hits_found;
    }
    cgt_scene_release(scene);
}

static void add(tally *t, int hits, int crossings, int winding)
{
    const bool odd = (hits - winding) % 2 != 0;
    t->rays++;
    t->right += hits == crossings;
    t->fewer += hits < crossings;
    t->more += hits > crossings;
    t->wrong_parity += odd;
}

/* A mesh as a hard scene, and rays that are aimed at it and whose winding numbers are known. */
static void make_case(const crossing_mesh *mesh, hard_scene *s, int winding[RAYS], test_random *r)
{
    *s = (hard_scene){.wanted = RAYS, .place = {.scale = 1}, .random = *r};
    hard_new_geometry(s);
    for (uint32_t i = 0; i < mesh->triangles; i++) {
        float v[3][3];
        for (int k = 0; k < 9; k++)
            v[k / 3][k % 3] = (float)mesh->corner[i][k / 3][k % 3];
        hard_raw_triangle(s, (const float(*)[3])v);
    }
    while (s->rays < RAYS && !s->failed) {
        const crossing_ray aimed = crossing_ray_make(mesh, r);
        truth_ray ray = {.t_max = INFINITY};
        for (int a = 0; a < 3; a++) {
            ray.org[a] = (float)aimed.org[a];
            ray.dir[a] = (float)aimed.dir[a];
        }
        if (crossing_winding(mesh, aimed.org, r, &winding[s->rays]))
            hard_raw_ray(s, &ray);
    }
    assert_false(s->failed);
}

static void count_shape(crossing_shape shape, tally sum[WAYS])
{
    test_random r = random_make(45 + (uint64_t)shape);
    cgt_context *context = context_make(1, NULL);
    for (uint32_t i = 0; i < test_scaled(16); i++) {
        crossing_mesh mesh;
        hard_scene s;
        embree_scene scene;
        int winding[RAYS], count[WAYS][RAYS];
        assert_true(crossing_mesh_make(&mesh, (closed_kind)(i % CLOSED_KINDS), shape, &r));
        make_case(&mesh, &s, winding, &r);
        count_crossings(context, &s, count[CROSSINGS]);
        assert_true(embree_scene_make(&s, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION, &scene));
        for (uint32_t k = 0; k < RAYS; k++) {
            count[FILTER][k] = count_by_filter(scene.triangles, &s.ray[k]);
            count[RESTART][k] = count_by_restart(scene.triangles, &s.ray[k]);
            for (int way = 0; way < WAYS; way++)
                add(&sum[way], count[way][k], count[CROSSINGS][k], winding[k]);
        }
        embree_scene_free(&scene);
        hard_scene_free(&s);
        crossing_mesh_free(&mesh);
    }
    cgt_context_release(context);
}

TEST(crossings_beside_embree)
{
    if (!CROSSING_JUDGE) {
        print_message("no integers of 128 bits: no judge\n");
        return;
    }
    printf("| meshes | way | rays | as many | fewer | more | wrong parity |\n|---|---|---|---|---|---|---|\n");
    for (int shape = CROSSING_FINE; shape <= CROSSING_THIN; shape++) {
        tally sum[WAYS] = {{0}};
        count_shape((crossing_shape)shape, sum);
        for (int way = 0; way < WAYS; way++)
            printf("| %s | %s | %llu | %llu | %llu | %llu | %llu |\n", shape_name[shape], way_name[way],
                   (unsigned long long)sum[way].rays, (unsigned long long)sum[way].right,
                   (unsigned long long)sum[way].fewer, (unsigned long long)sum[way].more,
                   (unsigned long long)sum[way].wrong_parity);
        assert_int_equal(sum[CROSSINGS].wrong_parity, 0);
        assert_true(sum[CROSSINGS].right >= test_scaled(16) * RAYS);
        assert_true(sum[FILTER].wrong_parity > 0); /* or rays are not aimed at anything */
    }
}

static int begin(void **state)
{
    (void)state;
    return embree_begin() ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    embree_end();
    return 0;
}

SEEDED_SUITE("oracle_embree_crossings", begin, end)
