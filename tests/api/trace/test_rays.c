/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays: layouts, default ranges, invalid rays and garbage among good ones, one by one and in arrays. Which
 * hits rays of all kinds find, tests/driver compares. */
#include "support/oracle/oracle.h"
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_RAYS 1700 /* not a multiple of a packet */

static cgt_context *context; /* of the variant under test */
static cgt_scene *scene;
static cloud spheres;
static truth_ray ray[MOST_RAYS];
static ray_hit hit[MOST_RAYS], repeated[MOST_RAYS];
static uint32_t rays_used; /* number of rays in this run */

/* Runs a test for each variant on a cloud of the given kind; structures take turns. */
static void for_each_variant(cloud_kind kind, uint32_t count, void (*test)(test_random *r))
{
    static uint32_t turn;
    FOR_EACH_VARIANT(variant)
    {
        test_random r = random_make(count + 17 * (uint64_t)kind);
        const cgt_scene_options options = structure_in_turn(turn++);
        context = context_make(2, variant);
        spheres = cloud_make(&r, kind, count);
        scene = scene_of(context, &options, (const float(*)[4])spheres.sphere, count);
        test(&r);
        cgt_scene_release(scene);
        cloud_free(&spheres);
        cgt_context_release(context);
    }
}

static void make_rays(test_random *r)
{
    for (uint32_t i = 0; i < rays_used; i++)
        ray[i] = ray_random(r, &spheres);
}

static bool same_hit(const ray_hit *a, const ray_hit *b) { return memcmp(a, b, sizeof *a) == 0; }

static void expect_no_hit(const ray_hit *h)
{
    assert_true(h->t == INFINITY && h->primitive == CGT_INVALID_ID && h->geometry == CGT_INVALID_ID);
    for (int a = 0; a < 3; a++)
        assert_true(h->normal[a] == 0);
}

static void judge(const truth_ray *rays, const ray_hit *hits, uint32_t count)
{
    oracle_scene truth = {0};
    oracle_scene_add_spheres(&truth, 0, (const float(*)[4])spheres.sphere, spheres.count);
    for (uint32_t i = 0; i < count; i++) {
        const char *wrong = oracle_check(&truth, &rays[i], hits[i].geometry, hits[i].primitive, hits[i].t);
        if (wrong)
            fail_msg("%s, ray %u: %s (sphere %u, t %a): org %a %a %a dir %a %a %a range %a %a",
                     cgt_context_get_variant(context), i, wrong, hits[i].primitive, (double)hits[i].t,
                     (double)rays[i].org[0], (double)rays[i].org[1], (double)rays[i].org[2], (double)rays[i].dir[0],
                     (double)rays[i].dir[1], (double)rays[i].dir[2], (double)rays[i].t_min, (double)rays[i].t_max);
    }
    oracle_scene_free(&truth);
}

static uint32_t count_hits(const ray_hit *hits, uint32_t count)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += hits[i].primitive != CGT_INVALID_ID;
    return sum;
}

/* ---- layouts ---- */

static void layouts_rays(test_random *r)
{
    static float soa[8][MOST_RAYS], out[4][MOST_RAYS];
    static uint32_t ids[2][MOST_RAYS];
    static struct {
        double other;
        ray_hit h;
        int more;
    } wide[MOST_RAYS];
    make_rays(r);
    rays_trace(scene, ray, rays_used, hit, NULL);
    for (uint32_t i = 0; i < rays_used; i++) {
        for (int a = 0; a < 3; a++)
            soa[a][i] = ray[i].org[a], soa[3 + a][i] = ray[i].dir[a];
        soa[6][i] = ray[i].t_min, soa[7][i] = ray[i].t_max;
    }
    for (size_t stride = 0; stride <= 4; stride += 4) {
        const cgt_rays rays = {.count = rays_used,
                               .stride = stride,
                               .org = {soa[0], soa[1], soa[2]},
                               .dir = {soa[3], soa[4], soa[5]},
                               .t_min = soa[6],
                               .t_max = soa[7]};
        const cgt_hits hits = {.stride = 4 - stride,
                               .t = out[0],
                               .primitive = ids[0],
                               .geometry = ids[1],
                               .normal = {out[1], out[2], out[3]}};
        assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
        for (uint32_t i = 0; i < rays_used; i++) {
            const ray_hit h = {out[0][i], ids[0][i], ids[1][i], {out[1][i], out[2][i], out[3][i]}};
            assert_true(same_hit(&h, &hit[i]));
        }
    }
    memset(wide, 0x11, sizeof wide);
    cgt_hits hits = hits_of(&wide[0].h);
    const cgt_rays rays = ray_array(ray, rays_used);
    hits.stride = sizeof wide[0];
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    for (uint32_t i = 0; i < rays_used; i++)
        assert_true(same_hit(&wide[i].h, &hit[i]) && wide[i].more == 0x11111111);
    hits = (cgt_hits){.primitive = ids[0]}; /* one field; the rest is not requested */
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    for (uint32_t i = 0; i < rays_used; i++)
        assert_int_equal(ids[0][i], hit[i].primitive);
    hits = (cgt_hits){0};
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
}

/* Rays and hits in arrays with two strides, in words: triples if vectors are wide enough, else components apart. */
typedef struct two_strides {
    size_t step, wide;
    float org[3 * 5 * MOST_RAYS], dir[3 * 5 * MOST_RAYS], normal[3 * 5 * MOST_RAYS];
    float t_min[5 * MOST_RAYS], t_max[5 * MOST_RAYS], t[5 * MOST_RAYS];
    uint32_t primitive[5 * MOST_RAYS], geometry[5 * MOST_RAYS];
} two_strides;

static float *component(const two_strides *s, float *vectors, int a)
{
    return vectors + (size_t)a * (s->wide >= 3 ? 1 : 5 * MOST_RAYS);
}

static void fill_two_strides(two_strides *s)
{
    for (uint32_t i = 0; i < rays_used; i++) {
        for (int a = 0; a < 3; a++) {
            component(s, s->org, a)[i * s->wide] = ray[i].org[a];
            component(s, s->dir, a)[i * s->wide] = ray[i].dir[a];
        }
        s->t_min[i * s->step] = ray[i].t_min;
        s->t_max[i * s->step] = ray[i].t_max;
    }
}

#define COMPONENTS(s, of)                                                                                              \
    {                                                                                                                  \
        component(s, (s)->of, 0), component(s, (s)->of, 1), component(s, (s)->of, 2)                                   \
    }

static void check_two_strides(two_strides *s, size_t stride, size_t vector_stride)
{
    const cgt_light light = {.position = {0.3f, 2, -1}};
    const cgt_rays structs = ray_array(ray, rays_used);
    const cgt_rays rays = {.count = rays_used,
                           .stride = stride,
                           .vector_stride = vector_stride,
                           .org = COMPONENTS(s, org),
                           .dir = COMPONENTS(s, dir),
                           .t_min = s->t_min,
                           .t_max = s->t_max};
    const cgt_hits hits = {.stride = stride,
                           .vector_stride = vector_stride,
                           .t = s->t,
                           .primitive = s->primitive,
                           .geometry = s->geometry,
                           .normal = COMPONENTS(s, normal)};
    const cgt_points near = {.count = rays_used,
                             .stride = structs.stride,
                             .position = {structs.org[0], structs.org[1], structs.org[2]},
                             .t_min = structs.t_min};
    const cgt_points apart = {.count = rays_used,
                              .stride = stride,
                              .vector_stride = vector_stride,
                              .position = COMPONENTS(s, org),
                              .t_min = s->t_min};
    uint8_t occluded[2][MOST_RAYS];
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    for (uint32_t i = 0; i < rays_used; i++) {
        ray_hit h = {.t = s->t[i * s->step], s->primitive[i * s->step], s->geometry[i * s->step], {0}};
        for (int a = 0; a < 3; a++)
            h.normal[a] = hits.normal[a][i * s->wide];
        assert_true(same_hit(&h, &hit[i]));
    }
    assert_int_equal(cgt_occluded_rays(scene, &structs, occluded[0], NULL), CGT_OK);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded[1], NULL), CGT_OK);
    assert_memory_equal(occluded[0], occluded[1], rays_used);
    assert_int_equal(cgt_occluded_points(scene, &light, &near, occluded[0], NULL), CGT_OK);
    assert_int_equal(cgt_occluded_points(scene, &light, &apart, occluded[1], NULL), CGT_OK);
    assert_memory_equal(occluded[0], occluded[1], rays_used);
}

static void two_strides_rays(test_random *r)
{
    static const size_t strides[][2] = {{0, 12}, {4, 12}, {8, 4}, {20, 0}, {4, 20}};
    static two_strides s;
    make_rays(r);
    rays_trace(scene, ray, rays_used, hit, NULL);
    for (size_t k = 0; k < TEST_COUNT(strides); k++) {
        s.step = strides[k][0] ? strides[k][0] / 4 : 1;
        s.wide = strides[k][1] ? strides[k][1] / 4 : s.step;
        fill_two_strides(&s);
        check_two_strides(&s, strides[k][0], strides[k][1]);
    }
}

TEST(vectors_have_a_stride_of_their_own) { for_each_variant(CLOUD_UNIFORM, 300, two_strides_rays); }

TEST(any_layout) { for_each_variant(CLOUD_UNIFORM, 300, layouts_rays); }

static void ranges_default_rays(test_random *r)
{
    make_rays(r);
    for (uint32_t i = 0; i < rays_used; i++)
        ray[i].t_min = 0, ray[i].t_max = INFINITY;
    rays_trace(scene, ray, rays_used, hit, NULL);
    cgt_rays rays = ray_array(ray, rays_used);
    const cgt_hits hits = hits_of(repeated);
    rays.t_min = rays.t_max = NULL;
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    assert_memory_equal(hit, repeated, rays_used * sizeof *hit);
}

TEST(ranges_default_to_all_ahead) { for_each_variant(CLOUD_UNIFORM, 100, ranges_default_rays); }

/* ---- invalid and extreme rays among good ones ---- */

static bool make_invalid(truth_ray *q, uint32_t how, float bad)
{
    switch (how) {
    case 0:
    case 1:
    case 2: q->org[how] = bad; return true;
    case 3:
    case 4:
    case 5: q->dir[how - 3] = bad; return true;
    case 6: q->dir[0] = q->dir[1] = q->dir[2] = bad == INFINITY ? 0 : -0.f; return true;
    case 7: q->t_min = NAN; return true;
    case 8: q->t_max = NAN; return true;
    default: q->t_min = 1, q->t_max = nextafterf(1, 0); return false; /* valid, and empty */
    }
}

static void invalid_rays(test_random *r)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    uint8_t occluded[MOST_RAYS];
    bool good[MOST_RAYS] = {false};
    uint32_t invalid = 0;
    make_rays(r);
    for (uint32_t i = 0; i < rays_used; i++) {
        good[i] = random_below(r, 3) != 0;
        if (!good[i])
            invalid += make_invalid(&ray[i], random_below(r, 10), bad[random_below(r, 3)]);
    }
    cgt_trace_statistics s;
    cgt_research_trace_statistics research;
    test_trace_options o = {0};
    o.statistics = &s;
    o.research_statistics = &research;
    rays_trace(scene, ray, rays_used, hit, TRACE_OPTIONS(&o));
    assert_int_equal(s.rays, rays_used);
    assert_int_equal(s.invalid_rays, invalid);
    assert_int_equal(s.hits, count_hits(hit, rays_used));
    assert_int_equal(research.packet_size, 0);
    const cgt_rays rays = ray_array(ray, rays_used);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, TRACE_OPTIONS(&o)), CGT_OK);
    assert_int_equal(s.invalid_rays, invalid);
    for (uint32_t i = 0; i < rays_used; i++) {
        if (!good[i])
            expect_no_hit(&hit[i]);
        else
            judge(&ray[i], &hit[i], 1);
        assert_int_equal(occluded[i], hit[i].primitive != CGT_INVALID_ID);
    }
    for (uint32_t i = 0; i < rays_used; i += 7) { /* one by one, without neighbours */
        rays_trace(scene, &ray[i], 1, repeated, NULL);
        assert_true(same_hit(&repeated[0], &hit[i]));
    }
}

TEST(invalid_rays_hit_nothing) { for_each_variant(CLOUD_UNIFORM, 400, invalid_rays); }

/* Arbitrary bits: no crash, no trap, and the same result for a single ray as within an array. */
static void garbage_rays(test_random *r)
{
    make_rays(r);
    for (uint32_t i = 0; i < rays_used; i++) {
        if (i % 3 == 0)
            continue;
        for (int a = 0; a < 3; a++) {
            if (random_below(r, 2))
                ray[i].org[a] = random_any_float(r);
            if (random_below(r, 2))
                ray[i].dir[a] = random_any_float(r);
        }
        if (random_below(r, 4) == 0)
            ray[i].t_min = random_any_float(r);
        if (random_below(r, 4) == 0)
            ray[i].t_max = random_any_float(r);
    }
    rays_trace(scene, ray, rays_used, hit, NULL);
    for (uint32_t i = 0; i < rays_used; i++) {
        rays_trace(scene, &ray[i], 1, repeated, NULL);
        assert_true(same_hit(&repeated[0], &hit[i]));
        if (i % 3 == 0)
            judge(&ray[i], &hit[i], 1);
        if (hit[i].primitive == CGT_INVALID_ID)
            expect_no_hit(&hit[i]);
        else
            assert_true(hit[i].primitive < spheres.count && hit[i].t >= ray[i].t_min && hit[i].t <= ray[i].t_max);
    }
}

TEST(garbage_does_no_harm)
{
    for_each_variant(CLOUD_UNIFORM, 100, garbage_rays);
    for_each_variant(CLOUD_FAR, 100, garbage_rays);
}

int main(void)
{
    test_begin("test_rays");
    rays_used = test_scaled(MOST_RAYS) < 333 ? 333 : test_scaled(MOST_RAYS);
    if (rays_used > MOST_RAYS)
        rays_used = MOST_RAYS;
    return SUITE_RUN(NULL, NULL);
}
