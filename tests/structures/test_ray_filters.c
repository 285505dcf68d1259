/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Masks and skipped primitives. Through every structure, closest and any hit are those of brute force over the
 * remaining primitives; a copy of a skipped primitive is found; ids of no primitive skip nothing; points against a
 * light, and frames of a camera with a mask. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/decide.h"
#include "support/suite.h"
#include "structures/scenes/structure_scenes.h"
#include "hard_cases/hard_run.h"

#define RAYS 700u
#define MOST_PARTS (2 * HARD_MOST_GEOMETRIES + 1)

/* ---- scenes: each geometry split in two with different masks, with missing ids between them ---- */

static const uint32_t mask_of[] = {0, 1, 2, 0x80000001u, 6};

typedef struct part {
    cgt_kind kind;
    cgt_spheres spheres;
    cgt_triangles triangles;
    uint32_t id, mask; /* mask as rays see it */
} part;

typedef struct subject {
    structure_scene s;
    part part[MOST_PARTS];
    uint32_t parts;
} subject;

static void add_part(subject *t, const hard_geometry *g, uint32_t first, uint32_t end)
{
    part *q = &t->part[t->parts];
    *q = (part){.id = t->parts + (t->parts > 0)}; /* id 1 does not exist */
    const uint32_t mask = mask_of[t->parts++ % TEST_COUNT(mask_of)];
    q->mask = mask ? mask : UINT32_MAX;
    if (g->triangles) {
        q->kind = CGT_KIND_TRIANGLES;
        q->triangles = (cgt_triangles){.count = end - first,
                                       .indices = cgt_uint32s(g->index[first], 0),
                                       .vertex_count = g->vertices,
                                       .vertices = cgt_floats(g->vertex[0], 0),
                                       .mask = mask};
    } else {
        q->spheres = spheres_of((const float(*)[4])g->sphere + first, end - first);
        q->spheres.mask = mask;
    }
}

static subject subject_make(structure_kind kind, uint64_t stream)
{
    subject t = {.s = structure_scene_make(kind, stream)};
    structure_rays(&t.s, RAYS);
    for (uint32_t i = 0; i < t.s.scene.geometries; i++) {
        const hard_geometry *g = &t.s.scene.geometry[i];
        const uint32_t count = g->triangles ? g->triangles : g->spheres;
        if (!count)
            continue;
        add_part(&t, g, 0, count / 2);
        add_part(&t, g, count / 2, count);
    }
    return t;
}

static cgt_scene *commit(cgt_context *context, const subject *t, const cgt_scene_options *options)
{
    cgt_scene *scene;
    uint32_t removed_id = CGT_INVALID_ID;
    const cgt_spheres nothing = {0};
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    for (uint32_t i = 0; i < t->parts; i++) {
        const part *q = &t->part[i];
        uint32_t id = CGT_INVALID_ID;
        if (i == 1)
            assert_int_equal(cgt_scene_set_spheres(scene, &removed_id, &nothing), CGT_OK);
        if (q->kind == CGT_KIND_TRIANGLES)
            assert_int_equal(cgt_scene_set_triangles(scene, &id, &q->triangles), CGT_OK);
        else
            assert_int_equal(cgt_scene_set_spheres(scene, &id, &q->spheres), CGT_OK);
        assert_int_equal(id, q->id);
    }
    if (removed_id != CGT_INVALID_ID)
        assert_int_equal(cgt_scene_remove_geometry(scene, removed_id), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static uint32_t part_count(const part *q)
{
    return q->kind == CGT_KIND_TRIANGLES ? q->triangles.count : q->spheres.count;
}

/* ---- rays ---- */

typedef struct filtered_ray {
    truth_ray ray;
    uint32_t mask, primitive, geometry;
} filtered_ray;

/* The arrays that a call provides. */
typedef enum given { GIVEN_MASK = 1, GIVEN_PRIMITIVE = 2, GIVEN_GEOMETRY = 4, GIVEN_ALL = 7 } given;

static cgt_rays rays_of(const filtered_ray *ray, uint32_t count, uint32_t what)
{
    cgt_rays r = ray_array(&ray->ray, count);
    r.stride = sizeof *ray;
    r.mask = what & GIVEN_MASK ? &ray->mask : NULL;
    r.skip_primitive = what & GIVEN_PRIMITIVE ? &ray->primitive : NULL;
    r.skip_geometry = what & GIVEN_GEOMETRY ? &ray->geometry : NULL;
    return r;
}

/* Most rays skip what they hit; the others skip another primitive, or one that does not exist. */
static void make_filters(subject *t, const cgt_scene *scene, filtered_ray *ray)
{
    static full_hit hit[RAYS];
    static const uint32_t masks[] = {UINT32_MAX, UINT32_MAX, 1, 2, 3, 4, 0, 0x80000000u};
    test_random *r = &t->s.scene.random;
    assert_int_equal(trace_array(scene, t->s.scene.ray, RAYS, hit, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        ray[i] = (filtered_ray){.ray = t->s.scene.ray[i],
                                .mask = i / 64 % 3 ? masks[random_below(r, TEST_COUNT(masks))] : UINT32_MAX,
                                .primitive = hit[i].primitive,
                                .geometry = hit[i].geometry};
        const uint32_t kind = i / 64 % 5 ? random_below(r, 12) : 12;
        if (kind == 0)
            ray[i].primitive = CGT_INVALID_ID;
        else if (kind == 1)
            ray[i].primitive = 1000000 + random_below(r, 100); /* out of range of all but the largest */
        else if (kind == 2)
            ray[i].geometry = (uint32_t[]){1, 99, CGT_INVALID_ID}[random_below(r, 3)];
        else if (kind == 3) {
            ray[i].geometry = random_below(r, MOST_PARTS);
            ray[i].primitive = random_below(r, 100);
        } else if (kind == 4)
            ray[i].ray.org[random_below(r, 3)] = (float[]){NAN, INFINITY, 0x1p60f}[random_below(r, 3)];
    }
}

static bool invalid(const truth_ray *ray)
{
    float zero = ray->t_min * 0;
    for (int a = 0; a < 3; a++)
        zero += ray->org[a] * 0 + ray->dir[a] * 0;
    return isnan(ray->t_max) || isnan(ray->t_min) || (zero != 0 && !isinf(ray->t_min)) ||
           (ray->dir[0] == 0 && ray->dir[1] == 0 && ray->dir[2] == 0);
}

/* ---- brute force over the remaining primitives ---- */

typedef struct truth_hit {
    float t;
    uint32_t primitive, geometry;
} truth_hit;

static cgt_primitive primitive_at(const part *q, uint32_t i)
{
    cgt_primitive primitive = {.kind = q->kind};
    if (q->kind == CGT_KIND_TRIANGLES) {
        const uint32_t *corner = (const uint32_t *)q->triangles.indices.data + 3 * (size_t)i;
        for (int k = 0; k < 3; k++)
            memcpy(primitive.triangle.v[k], (const float *)q->triangles.vertices.data + 3 * (size_t)corner[k],
                   sizeof primitive.triangle.v[k]);
    } else
        memcpy(&primitive.sphere, (const char *)q->spheres.centers.data + i * q->spheres.centers.stride,
               sizeof primitive.sphere);
    return primitive;
}

/* Whether a primitive is valid, by the definition in cgt.h. */
static bool is_valid(const cgt_primitive *primitive)
{
    float zero = 0;
    if (primitive->kind == CGT_KIND_SPHERES) {
        const cgt_sphere q = primitive->sphere;
        zero = q.x * 0 + q.y * 0 + q.z * 0 + q.r * 0;
        return zero == 0 && q.r >= 0;
    }
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            zero += primitive->triangle.v[k][a] * 0;
    return zero == 0;
}

static truth_hit truth_of(const subject *t, const filtered_ray *f, uint32_t what)
{
    const uint32_t mask = what & GIVEN_MASK && f->mask ? f->mask : UINT32_MAX;
    const uint32_t primitive = what & GIVEN_PRIMITIVE ? f->primitive : CGT_INVALID_ID;
    const uint32_t geometry = what & GIVEN_GEOMETRY ? f->geometry : 0;
    const float t_min = f->ray.t_min < -3e38f ? -3.4028234664e38f : f->ray.t_min;
    cgt_ray ray = {.t_min = t_min, .t_max = f->ray.t_max};
    cgt_decided_hit best = {.t = 0};
    truth_hit a = {INFINITY, CGT_INVALID_ID, CGT_INVALID_ID};
    uint64_t exact = 0;
    memcpy(ray.line.org, f->ray.org, sizeof ray.line.org);
    memcpy(ray.line.dir, f->ray.dir, sizeof ray.line.dir);
    for (uint32_t k = 0; k < t->parts && !invalid(&f->ray); k++)
        for (uint32_t i = 0; i < part_count(&t->part[k]) && (t->part[k].mask & mask); i++) {
            if (t->part[k].id == geometry && i == primitive)
                continue;
            cgt_decided_hit hit = {.primitive = primitive_at(&t->part[k], i)};
            if (!is_valid(&hit.primitive) || !cgt_decide_hit(&ray, &hit, &exact))
                continue;
            if (a.primitive == CGT_INVALID_ID || cgt_decide_order(&ray, &hit, &best, &exact) < 0) {
                best = hit;
                a = (truth_hit){(float)hit.t, i, t->part[k].id};
            }
        }
    return a;
}

/* ---- the comparison ---- */

typedef struct tally {
    uint64_t rays, hits, fast_differ, fast;
} tally;

static bool is_filtered_out(const subject *t, const filtered_ray *f, uint32_t what, const full_hit *h)
{
    const uint32_t mask = what & GIVEN_MASK && f->mask ? f->mask : UINT32_MAX;
    const uint32_t geometry = what & GIVEN_GEOMETRY ? f->geometry : 0;
    for (uint32_t k = 0; k < t->parts; k++)
        if (t->part[k].id == h->geometry && !(t->part[k].mask & mask))
            return true;
    return what & GIVEN_PRIMITIVE && h->primitive == f->primitive && h->geometry == geometry;
}

static void compare(const subject *t, const cgt_scene *scene, const filtered_ray *ray, const truth_hit *truth,
                    uint32_t count, uint32_t what, const test_trace_options *given_options, tally *sum)
{
    static full_hit hit[RAYS];
    static uint8_t occluded[RAYS];
    cgt_trace_statistics statistics;
    test_trace_options options = *given_options;
    options.statistics = &statistics;
    const cgt_rays rays = rays_of(ray, count, what);
    const cgt_hits hits = hit_array(hit);
    uint64_t found = 0, wrong = 0;
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, TRACE_OPTIONS(&options)), CGT_OK);
    for (uint32_t i = 0; i < count; i++) {
        const truth_hit got = {hit[i].t, hit[i].primitive, hit[i].geometry};
        const bool same = memcmp(&got, &truth[i], sizeof got) == 0;
        found += got.primitive != CGT_INVALID_ID;
        if (got.primitive != CGT_INVALID_ID && is_filtered_out(t, &ray[i], what, &hit[i]))
            fail_msg("%s, ray %u: hits %u.%u, which is filtered out", t->s.name, i, got.geometry, got.primitive);
        const bool decided = got.primitive == truth[i].primitive && got.geometry == truth[i].geometry;
        if (options.triangle_test == CGT_TRIANGLE_TEST_AUTO && !decided)
            fail_msg("%s, ray %u, precision %d: hits %u.%u, not %u.%u", t->s.name, i, (int)options.precision,
                     got.geometry, got.primitive, truth[i].geometry, truth[i].primitive);
        if (!same && options.precision != CGT_PRECISION_FAST)
            fail_msg("%s, ray %u: hits %u.%u at %a, not %u.%u at %a", t->s.name, i, got.geometry, got.primitive,
                     (double)got.t, truth[i].geometry, truth[i].primitive, (double)truth[i].t);
        wrong += !decided;
    }
    assert_int_equal(statistics.hits, found);
    memset(occluded, 7, sizeof occluded);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, TRACE_OPTIONS(&options)), CGT_OK);
    for (uint32_t i = 0; i < count; i++)
        if (occluded[i] != (hit[i].primitive != CGT_INVALID_ID))
            fail_msg("%s, ray %u: any hit %u, closest hit %u.%u", t->s.name, i, occluded[i], hit[i].geometry,
                     hit[i].primitive);
    assert_int_equal(statistics.hits, found);
    sum->rays += count;
    sum->hits += found;
    if (options.triangle_test != CGT_TRIANGLE_TEST_AUTO && t->s.where.reach > 0x1p-20f && t->s.where.reach < 0x1p20f) {
        sum->fast += count;
        sum->fast_differ += wrong;
    }
}

TEST(hits_are_those_of_the_remaining_primitives)
{
    static filtered_ray ray[RAYS];
    static truth_hit truth[RAYS];
    static const uint32_t what_of[] = {GIVEN_ALL, GIVEN_PRIMITIVE | GIVEN_GEOMETRY, GIVEN_MASK,
                                       GIVEN_MASK | GIVEN_PRIMITIVE, 0};
    tally sum = {0};
    cgt_context *context = context_make(1, NULL);
    for (uint32_t number = 0; number < (uint32_t)STRUCTURE_KINDS * test_between(1, 2); number++) {
        subject t = subject_make((structure_kind)(number % STRUCTURE_KINDS), 300 + number);
        const uint32_t what = what_of[number * 3 % 7 < 3 ? 0 : number % TEST_COUNT(what_of)];
        const cgt_scene_options plain = structure_in_turn(number);
        cgt_scene *scene = commit(context, &t, &plain);
        make_filters(&t, scene, ray);
        cgt_scene_release(scene);
        const uint32_t all = test_scaled(10) < 2 ? t.s.scene.rays / 4 : t.s.scene.rays; /* a sample on slow machines */
        const uint32_t count = number % 5 == 4 ? 60 : all;
        for (uint32_t i = 0; i < count; i++)
            truth[i] = truth_of(&t, &ray[i], what);
        FOR_EACH_VARIANT(variant)
        {
            cgt_context *own = context_make(1 + 2 * (number % 2), variant);
            /* a sample: every second structure, starting from number / 2, since options follow number + k */
            const uint32_t step = test_samples() ? 2 : 1;
            for (uint32_t k = test_sample_start(number / 2, step); k < TEST_STRUCTURES; k += step) {
                const cgt_scene_options made = structure_in_turn(k);
                test_trace_options options = {0};
                options.cull = (cgt_cull)((number + k) % 3);
                options.loop = (cgt_loop)((number + k) % 2 + 1);
                options.mailbox = mailbox_of((number + k) % 3);
                scene = commit(own, &t, &made);
                for (int single = 0; single < 2; single++) {
                    options.kd_traversal = single ? CGT_KD_TRAVERSAL_SINGLE : CGT_KD_TRAVERSAL_PACKET;
                    options.precision = CGT_PRECISION_EXACT;
                    options.triangle_test = CGT_TRIANGLE_TEST_AUTO;
                    compare(&t, scene, ray, truth, count, what, &options, &sum);
                    options.precision = CGT_PRECISION_FAST;
                    options.triangle_test = (cgt_triangle_test)((number + k) % 4);
                    compare(&t, scene, ray, truth, count, what, &options, &sum);
                }
                cgt_scene_release(scene);
            }
            cgt_context_release(own);
        }
        structure_scene_free(&t.s);
    }
    cgt_context_release(context);
    print_message("%llu of %llu rays hit a remaining primitive; %llu of %llu differ by tests in single precision\n",
                  (unsigned long long)sum.hits, (unsigned long long)sum.rays, (unsigned long long)sum.fast_differ,
                  (unsigned long long)sum.fast);
    assert_true(sum.hits > sum.rays / 30 && sum.fast_differ < sum.fast / 20);
}

/* ---- copies, and ids of no primitive ---- */

static uint32_t hit_of(const cgt_scene *scene, uint32_t primitive, uint32_t geometry, uint32_t mask)
{
    const float org[3] = {0, 0, 5}, dir[3] = {0, 0, -1};
    uint32_t found = 77;
    const cgt_rays rays = {.count = 1,
                           .org = {&org[0], &org[1], &org[2]},
                           .dir = {&dir[0], &dir[1], &dir[2]},
                           .mask = &mask,
                           .skip_primitive = &primitive,
                           .skip_geometry = &geometry};
    const cgt_hits hits = {.primitive = &found};
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    return found;
}

TEST(copies_are_found)
{
    const float sphere[4][4] = {{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, -9, 1}, {0, 0, 0, NAN}};
    cgt_context *context = context_make(1, NULL);
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
        const cgt_scene_options made = structure_in_turn(k);
        cgt_scene *scene = scene_of(context, &made, sphere, 4);
        assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 1), 0);
        assert_int_equal(hit_of(scene, 0, 0, 1), 1);
        assert_int_equal(hit_of(scene, 1, 0, 1), 0);
        assert_int_equal(hit_of(scene, 2, 0, 1), 0);
        assert_int_equal(hit_of(scene, 3, 0, 1), 0);
        assert_int_equal(hit_of(scene, 4, 0, 1), 0); /* beyond the last */
        assert_int_equal(hit_of(scene, CGT_INVALID_ID - 1, 0, 1), 0);
        assert_int_equal(hit_of(scene, 0, 1, 1), 0); /* no such geometry */
        assert_int_equal(hit_of(scene, 0, CGT_INVALID_ID, 1), 0);
        assert_int_equal(hit_of(scene, CGT_INVALID_ID, CGT_INVALID_ID, 1), 0);
        assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 0), 0); /* all bits */
        assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 0x80000000u), 0);
        cgt_scene_release(scene);
    }
    cgt_scene *empty = scene_of(context, NULL, NULL, 0);
    assert_int_equal(hit_of(empty, 0, 0, 1), CGT_INVALID_ID);
    cgt_scene_release(empty);
    cgt_context_release(context);
}

/* A geometry's mask is that of the last commit. */
TEST(masks_change_with_commits)
{
    const float sphere[1][4] = {{0, 0, 0, 1}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    cgt_spheres spheres = spheres_of(sphere, 1);
    assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 4), 0);
    spheres.mask = 3;
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 4), CGT_INVALID_ID);
    assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 6), 0);
    assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 0), 0); /* all bits */
    spheres.mask = 0;
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(hit_of(scene, CGT_INVALID_ID, 0, 4), 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- points against a light ---- */

TEST(lights_are_filtered_too)
{
    static filtered_ray ray[RAYS];
    static uint8_t by_rays[RAYS], by_points[RAYS];
    uint32_t occluded_points = 0, total = 0;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(2, variant);
        for (uint32_t number = 0; number < 12; number++) {
            subject t = subject_make((structure_kind)(number % STRUCTURE_COINCIDENT), 60 + number);
            const cgt_scene_options made = structure_in_turn(number);
            cgt_scene *scene = commit(context, &t, &made);
            cgt_light light = {.kind = number / 4 % 2 ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL};
            make_filters(&t, scene, ray);
            for (int a = 0; a < 3; a++)
                light.position[a] =
                    (light.kind == CGT_LIGHT_POINT ? t.s.where.middle[a] : 0) + (float)(a + 2) * t.s.where.reach;
            for (uint32_t i = 0; i < RAYS; i++) {
                ray[i].ray.t_min = 0;
                ray[i].ray.t_max = light.kind == CGT_LIGHT_POINT ? 1 : INFINITY;
                for (int a = 0; a < 3; a++)
                    ray[i].ray.dir[a] =
                        light.kind == CGT_LIGHT_POINT ? light.position[a] - ray[i].ray.org[a] : light.position[a];
            }
            const cgt_rays rays = rays_of(ray, RAYS, GIVEN_ALL);
            const cgt_points points = {.count = RAYS,
                                       .stride = sizeof *ray,
                                       .position = {rays.org[0], rays.org[1], rays.org[2]},
                                       .mask = rays.mask,
                                       .skip_primitive = rays.skip_primitive,
                                       .skip_geometry = rays.skip_geometry};
            assert_int_equal(cgt_occluded_rays(scene, &rays, by_rays, NULL), CGT_OK);
            assert_int_equal(cgt_occluded_points(scene, &light, &points, by_points, NULL), CGT_OK);
            assert_memory_equal(by_rays, by_points, RAYS);
            for (uint32_t i = 0; i < RAYS; i++)
                occluded_points += by_rays[i];
            total += RAYS;
            cgt_scene_release(scene);
            structure_scene_free(&t.s);
        }
        cgt_context_release(context);
    }
    print_message("%u of %u points occluded\n", occluded_points, total);
    assert_true(occluded_points > total / 100);
}

/* ---- cameras ---- */

#define SIDE 90u

/* A frame's pixels are its rays with the camera's mask. */
TEST(cameras_have_masks)
{
    static filtered_ray ray[SIDE * SIDE];
    static full_hit hit[SIDE * SIDE];
    static const uint32_t masks[] = {0, UINT32_MAX, 1, 2, 4, 0x80000000u, 8};
    /* every structure with every mask: on slow machines two narrow tiles instead of four */
    const bool slow = test_scaled(10) < 2;
    const uint32_t width = slow ? 70 : SIDE, height = slow ? 18 : SIDE, pixels = width * height;
    uint32_t seen = 0;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(2, variant);
        subject t = subject_make((structure_kind)SOUP_MIXED, 77);
        for (uint32_t number = 0; number < TEST_STRUCTURES * TEST_COUNT(masks); number++) {
            const cgt_scene_options made = structure_in_turn(number);
            const uint32_t mask = masks[number / TEST_STRUCTURES];
            cgt_scene *scene = commit(context, &t, &made);
            cgt_camera camera = soup_camera(&t.s.scene);
            cgt_camera_rays of;
            cgt_trace_statistics statistics;
            test_trace_options options;
            char message[160];
            planes p = planes_make(width, height);
            options = (test_trace_options){0};
            options.statistics = &statistics;
            camera.mask = mask;
            frame_trace(scene, &camera, &p, TRACE_OPTIONS(&options));
            if (made.structure == CGT_STRUCTURE_LOOSE_GRID && mask + 1 > 1)
                assert_int_equal(statistics.tiles, 0);
            assert_int_equal(cgt_camera_prepare(&camera, width, height, &of, message), CGT_OK);
            for (uint32_t i = 0; i < pixels; i++)
                ray[i] = (filtered_ray){.ray = camera_ray(&of, i % width, i / width), .mask = mask ? mask : UINT32_MAX};
            const cgt_rays rays = rays_of(ray, pixels, GIVEN_MASK);
            const cgt_hits hits = hit_array(hit);
            assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
            for (uint32_t i = 0; i < pixels; i++) {
                assert_int_equal(p.primitive[i], hit[i].primitive);
                assert_int_equal(p.geometry[i], hit[i].geometry);
                assert_true(p.t[i] == hit[i].t);
                seen += hit[i].primitive != CGT_INVALID_ID;
            }
            planes_free(&p);
            cgt_scene_release(scene);
        }
        structure_scene_free(&t.s);
        cgt_context_release(context);
    }
    print_message("%u pixels with a hit\n", seen);
    assert_true(seen > 0);
}

SEEDED_SUITE("test_ray_filters", NULL, NULL)
