/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules through the public calls: every form of their arrays gives the same bits, every call agrees with arrays of
 * rays, which the oracles judge; what the structures refuse and the commit skips or refuses. */
#include <cgt/all_hits.h>
#include <cgt/bounces.h>

#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define POINTS 400u
#define CAPSULES 900u
#define TYPES 4u
#define RAYS 600u
#define WIDTH 70u
#define HEIGHT 50u

static const double far_origin[3] = {1e9, -3e8 + 0.1, 7e6}, no_origin[3] = {0, 0, 0};

#pragma pack(push, 1)
typedef struct packed_point {
    char name;
    float x[3];
} packed_point;

typedef struct packed_pair {
    uint8_t type;
    uint32_t index[2];
} packed_pair;
#pragma pack(pop)

/* The same capsules in each form. */
typedef struct capsule_arrays {
    double x[POINTS][3], table_double[TYPES], radius_double[CAPSULES], end_double[2][CAPSULES][3];
    float plain[POINTS][5], table[TYPES], radius[CAPSULES], end[2 * CAPSULES][3]; /* what the library must see */
    uint32_t index[CAPSULES][2], type32[CAPSULES];
    uint16_t index16[CAPSULES][2], type16[CAPSULES];
    packed_point point[POINTS];
    packed_pair pair[CAPSULES];
} capsule_arrays;

static capsule_arrays *make_arrays(const double origin[3])
{
    capsule_arrays *s = calloc(1, sizeof *s);
    test_random r = random_make(11);
    assert_non_null(s);
    for (uint32_t k = 0; k < TYPES; k++) {
        s->table_double[k] = (double)random_float(&r, 0.02f, 0.2f) * (1 + 0x1p-25); /* not a float */
        s->table[k] = (float)s->table_double[k];
    }
    for (uint32_t i = 0; i < POINTS; i++)
        for (int a = 0; a < 3; a++) {
            s->x[i][a] = origin[a] + (double)random_float(&r, -3, 3) / 3 * 3.0000001;
            s->plain[i][a] = s->point[i].x[a] = (float)(s->x[i][a] - origin[a]);
        }
    for (uint32_t i = 0; i < CAPSULES; i++) {
        const uint32_t type = random_below(&r, TYPES);
        for (uint32_t k = 0; k < 2; k++) { /* a few of length 0 */
            const uint32_t j = k && i % 50 == 0 ? s->index[i][0] : random_below(&r, POINTS);
            s->index[i][k] = s->index16[i][k] = s->pair[i].index[k] = j;
            memcpy(s->end[2 * i + k], s->plain[j], sizeof s->end[0]);
            memcpy(s->end_double[k][i], s->x[j], sizeof s->x[j]);
        }
        s->type32[i] = s->type16[i] = s->pair[i].type = (uint8_t)type;
        s->radius[i] = s->table[type];
        s->radius_double[i] = s->table_double[type];
    }
    return s;
}

#define FORMS 8u
#define FORMS_IN_PLACE 2u /* the first ones */
#define FORMS_OF_FLOATS 5u

static cgt_capsules describe(const capsule_arrays *s, uint32_t form, const double origin[3])
{
    cgt_capsules d = {.count = CAPSULES, .vertex_count = POINTS, .radii = cgt_floats(s->table, 0), .type_count = TYPES};
    memcpy(d.origin, origin, sizeof d.origin);
    switch (form) {
    case 0:
        d.vertices = cgt_floats(s->plain[0], 0), d.vertices.stride = sizeof s->plain[0];
        d.indices = cgt_uint32s(s->index[0], 0), d.radii = cgt_floats(s->radius, 0);
        return d;
    case 1: /* ends side by side */
        d.vertices = cgt_floats(s->end[0], 0), d.vertex_count = 2 * CAPSULES, d.radii = cgt_floats(s->radius, 0);
        return d;
    case 2: /* two arrays in one */
        d.vertices = cgt_floats(s->end[0], 0), d.ends = cgt_floats(s->end[1], 0),
        d.vertices.stride = d.ends.stride = 2 * sizeof s->end[0];
        d.vertex_count = CAPSULES, d.types = cgt_uint32s(s->type32, 0);
        return d;
    case 3:
        d.vertices = cgt_floats(s->plain[0], 0), d.vertices.stride = sizeof s->plain[0];
        d.indices = cgt_uint16s(s->index16[0], 0), d.types = cgt_uint16s(s->type16, 0);
        return d;
    case 4: /* nothing is aligned */
        d.vertices = cgt_floats((const float *)(const void *)((const char *)s->point + offsetof(packed_point, x)), 0);
        d.vertices.stride = sizeof *s->point;
        d.indices =
            cgt_uint32s((const uint32_t *)(const void *)((const char *)s->pair + offsetof(packed_pair, index)), 0);
        d.types = cgt_uint8s(&s->pair[0].type, 0), d.indices.stride = d.types.stride = sizeof *s->pair;
        return d;
    case 5:
        d.vertices = cgt_doubles(s->x[0], 0), d.indices = cgt_uint32s(s->index[0], 0), d.radii = cgt_floats(NULL, 0),
        d.radii = cgt_doubles(s->radius_double, 0);
        return d;
    case 6:
        d.vertices = cgt_doubles(s->end_double[0][0], 0), d.ends = cgt_doubles(s->end_double[1][0], 0),
        d.vertex_count = CAPSULES;
        d.radii = cgt_floats(NULL, 0), d.radii = cgt_doubles(s->table_double, 0),
        d.types = cgt_uint8s(&s->pair[0].type, 0), d.types.stride = sizeof *s->pair;
        return d;
    default:
        d.vertices = cgt_doubles(s->x[0], 0), d.indices = cgt_uint16s(s->index16[0], 0),
        d.types = cgt_uint32s(s->type32, 0);
        return d;
    }
}

static cgt_scene *scene_of_capsules(cgt_context *context, const cgt_scene_options *options, const cgt_capsules *q)
{
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(scene, NULL, q), CGT_OK);
    if (cgt_scene_commit(scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    return scene;
}

static cgt_scene_statistics statistics_of(const cgt_scene *scene)
{
    cgt_scene_statistics s;
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    return s;
}

static void random_rays(truth_ray rays[RAYS])
{
    test_random r = random_make(12);
    for (uint32_t i = 0; i < RAYS; i++) {
        rays[i] = (truth_ray){.t_max = INFINITY};
        for (int a = 0; a < 3; a++)
            rays[i].org[a] = random_float(&r, -5, 5);
        random_direction(&r, rays[i].dir);
    }
}

TEST(capsules_of_every_form)
{
    static full_hit expected[RAYS], hit[RAYS];
    static truth_ray rays[RAYS];
    random_rays(rays);
    for (uint32_t round = 0; round < 2; round++) {
        cgt_context *context = context_make(1 + round, NULL);
        const double *origin = round ? far_origin : no_origin;
        uint32_t hits = 0;
        for (uint32_t form = 0; form < FORMS; form++) {
            capsule_arrays *s = make_arrays(origin); /* floats have no origin left */
            const cgt_capsules q = describe(s, form, form < FORMS_OF_FLOATS ? no_origin : origin);
            cgt_scene *scene = scene_of_capsules(context, NULL, &q);
            const cgt_scene_statistics st = statistics_of(scene);
            assert_true(st.capsules == CAPSULES && st.primitives == CAPSULES && !st.spheres && !st.triangles);
            assert_int_equal(st.copied_bytes, form < FORMS_IN_PLACE ? 0 : CAPSULES * 32);
            assert_int_equal(st.structure, CGT_STRUCTURE_LOOSE_GRID);
            if (form >= FORMS_IN_PLACE)
                memset(s, 0xff, sizeof *s);
            assert_int_equal(trace_array(scene, rays, RAYS, form ? hit : expected, NULL), CGT_OK);
            if (form && memcmp(hit, expected, sizeof hit) != 0)
                fail_msg("form %u: other hits", form);
            for (uint32_t i = 0; !form && i < RAYS; i++)
                hits += expected[i].primitive != CGT_INVALID_ID;
            cgt_scene_release(scene);
            free(s);
        }
        assert_true(hits > RAYS / 4);
        cgt_context_release(context);
    }
}

/* ---- every call ---- */

/* Spheres, triangles and capsules about each other. */
typedef struct mixed_scene {
    capsule_arrays *arrays;
    float sphere[100][4], vertex[300][3];
    cgt_scene *scene;
} mixed_scene;

static mixed_scene *make_mixed(cgt_context *context)
{
    mixed_scene *m = calloc(1, sizeof *m);
    test_random r = random_make(13);
    assert_non_null(m);
    m->arrays = make_arrays(no_origin);
    for (uint32_t i = 0; i < 100; i++)
        for (uint32_t k = 0; k < 4; k++)
            m->sphere[i][k] = k == 3 ? 0.3f : random_float(&r, -3, 3);
    for (uint32_t i = 0; i < 300; i++)
        for (int a = 0; a < 3; a++)
            m->vertex[i][a] = (i % 3 ? m->vertex[i - 1][a] : 0) + random_float(&r, i % 3 ? -1 : -3, i % 3 ? 1 : 3);
    const cgt_triangles triangles = {
        .count = 100, .vertex_count = 300, .vertices = cgt_floats(m->vertex[0], 0), .mask = 2};
    cgt_capsules capsules = describe(m->arrays, 0, no_origin);
    cgt_spheres spheres = spheres_of((const float(*)[4])m->sphere, 100);
    capsules.mask = 4;
    capsules.count = 300;
    spheres.mask = 1;
    assert_int_equal(cgt_scene_create(context, NULL, &m->scene), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(m->scene, NULL, &capsules), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(m->scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(m->scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(m->scene), CGT_OK);
    return m;
}

static void free_mixed(mixed_scene *m)
{
    cgt_scene_release(m->scene);
    free(m->arrays);
    free(m);
}

/* The frame's planes, its shadows and its occlusion against rays, points and rays one by one. */
static void check_frame(const mixed_scene *m, cgt_precision precision, cgt_light light)
{
    const uint32_t pixels = WIDTH * HEIGHT;
    const cgt_trace_options options = {.precision = precision};
    planes p = planes_make(WIDTH, HEIGHT);
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 9;
    frame_trace(m->scene, &camera, &p, &options);
    truth_ray *rays = frame_rays(&camera, WIDTH, HEIGHT);
    full_hit *hit = calloc(pixels, sizeof *hit);
    uint8_t *occluded = calloc(4, pixels), *rays_occluded = occluded + pixels;
    float *lit[3], *visibility = calloc(4 * (size_t)pixels, sizeof *visibility);
    uint32_t by_geometry[3] = {0};
    assert_true(rays && hit && occluded && visibility);
    cgt_frame frame = frame_of(&p);
    cgt_trace_statistics statistics;
    const cgt_trace_options counting = {.precision = precision, .statistics = &statistics};
    assert_int_equal(cgt_occluded_frame(m->scene, &camera, &frame, &light, 1, NULL, occluded, &counting), CGT_OK);
    assert_true(statistics.tiles > 0); /* before there is a BVH */
    assert_int_equal(trace_array(m->scene, rays, pixels, hit, &options), CGT_OK);
    for (int a = 0; a < 3; a++)
        lit[a] = visibility + (size_t)(a + 1) * pixels;
    for (uint32_t i = 0; i < pixels; i++) {
        const full_hit *h = &hit[i];
        const float normal[3] = {p.normal[0][i], p.normal[1][i], p.normal[2][i]};
        if (h->primitive != p.primitive[i] || h->geometry != p.geometry[i] || h->t != p.t[i] ||
            memcmp(normal, h->normal, sizeof normal) != 0)
            fail_msg("pixel %u: %u of %u at %a, its ray %u of %u at %a", i, p.primitive[i], p.geometry[i],
                     (double)p.t[i], h->primitive, h->geometry, (double)h->t);
        if (h->geometry != CGT_INVALID_ID)
            by_geometry[h->geometry]++;
        for (int a = 0; a < 3; a++)
            lit[a][i] = rays[i].org[a] + h->t * rays[i].dir[a];
    }
    assert_true(by_geometry[0] > pixels / 20 && by_geometry[1] > pixels / 50 && by_geometry[2] > pixels / 50);
    const cgt_points points = {.count = pixels,
                               .position = {lit[0], lit[1], lit[2]},
                               .skip_primitive = p.primitive,
                               .skip_geometry = p.geometry};
    assert_int_equal(cgt_occluded_points(m->scene, &light, &points, rays_occluded, &options), CGT_OK);
    uint32_t dark = 0;
    for (uint32_t i = 0; i < pixels; i++) {
        bool one = false;
        const cgt_hit lies_on = {.primitive = p.primitive[i], .geometry = p.geometry[i]};
        cgt_single_ray ray = {.t_max = light.kind == CGT_LIGHT_POINT ? 1 : INFINITY, .skip = &lies_on};
        for (int a = 0; a < 3; a++) {
            ray.org[a] = lit[a][i];
            ray.dir[a] = light.position[a] - (light.kind == CGT_LIGHT_POINT ? lit[a][i] : 0);
        }
        if (p.primitive[i] != CGT_INVALID_ID)
            assert_int_equal(cgt_occluded_ray(m->scene, &ray, &one, NULL), CGT_OK);
        if (occluded[i] != one || rays_occluded[i] != one)
            fail_msg("pixel %u: occluded %d in the frame, %d as a point, %d alone", i, occluded[i], rays_occluded[i],
                     one);
        dark += one;
    }
    assert_true(dark > pixels / 10);
    assert_int_equal(cgt_ambient_occlusion(m->scene, &camera, &frame, NULL, visibility, &options), CGT_OK);
    double sum = 0;
    for (uint32_t i = 0; i < pixels; i++) {
        assert_true(visibility[i] >= 0 && visibility[i] <= 1);
        sum += (double)visibility[i] / pixels;
    }
    assert_true(sum > 0.3 && sum < 0.95);
    free(rays);
    free(hit);
    free(occluded);
    free(visibility);
    planes_free(&p);
}

TEST(every_call_agrees)
{
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant); /* with two, the first point to give up may come first */
        mixed_scene *m = make_mixed(context);
        check_frame(m, CGT_PRECISION_EXACT, (cgt_light){.position = {4, 5, 6}});
        free_mixed(m);
        m = make_mixed(context);
        check_frame(m, CGT_PRECISION_FAST, (cgt_light){.kind = CGT_LIGHT_DIRECTIONAL, .position = {4, 5, 6}});
        free_mixed(m);
        cgt_context_release(context);
    }
}

/* A lamp 2^-20 below a capsule, whose rays to the floor it does not meet: single precision alone cannot tell. */
TEST(lamps_before_capsules)
{
    static const float end[2][3] = {{-1, 0, 2}, {1, 0, 2}};
    static const float corner[3][3] = {{-40, -40, 0}, {40, -40, 0}, {0, 80, 0}};
    const cgt_capsules q = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0), .radius = 0.5f};
    const cgt_triangles floor = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(corner[0], 0)};
    const cgt_light light = {.kind = CGT_LIGHT_POINT, .position = {0, 0, 1.5f - 0x1p-20f}};
    const cgt_camera camera = {.eye = {0, -9, 6}, .up = {0, 0, 1}};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_of_capsules(context, NULL, &q);
        planes p = planes_make(WIDTH, HEIGHT);
        static uint8_t occluded[WIDTH * HEIGHT];
        cgt_trace_statistics statistics;
        const cgt_trace_options options = {.statistics = &statistics};
        uint32_t lit = 0;
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &floor), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        frame_trace(scene, &camera, &p, NULL);
        const cgt_frame frame = frame_of(&p);
        assert_int_equal(cgt_occluded_frame(scene, &camera, &frame, &light, 1, NULL, occluded, &options), CGT_OK);
        assert_true(statistics.tiles > 0);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            assert_true(p.geometry[i] != 1 || !occluded[i]);
            lit += p.geometry[i] == 1;
        }
        assert_true(lit > WIDTH * HEIGHT / 3);
        planes_free(&p);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* A ray into a capsule of glass leaves it at its other side, whose values are those of all hits. */
TEST(rays_bounce_inside)
{
    static truth_ray rays[RAYS], inside[RAYS];
    static full_hit hit[RAYS], again[RAYS];
    static float skip_t[RAYS];
    static uint32_t primitive[RAYS], geometry[RAYS];
    cgt_context *context = context_make(2, NULL);
    mixed_scene *m = make_mixed(context);
    random_rays(rays);
    assert_int_equal(trace_array(m->scene, rays, RAYS, hit, NULL), CGT_OK);
    memcpy(inside, rays, sizeof rays);
    const cgt_rays given = ray_array(rays, RAYS);
    const cgt_hits hits = hit_array(hit);
    const cgt_bounced_rays to = {.stride = sizeof *inside,
                                 .org = {&inside[0].org[0], &inside[0].org[1], &inside[0].org[2]},
                                 .dir = {&inside[0].dir[0], &inside[0].dir[1], &inside[0].dir[2]},
                                 .t_min = &inside[0].t_min,
                                 .t_max = &inside[0].t_max};
    cgt_bounced_rays ids = to;
    float scratch[7][RAYS];
    ids = (cgt_bounced_rays){.org = {scratch[0], scratch[1], scratch[2]},
                             .dir = {scratch[3], scratch[4], scratch[5]},
                             .t_max = scratch[6],
                             .skip_primitive = primitive,
                             .skip_geometry = geometry};
    /* the same index on both sides: rays go on as they came */
    const cgt_media media = {.inside = 1};
    assert_int_equal(cgt_bounce_rays(m->scene, &given, &hits, &media, NULL, NULL, &to, NULL), CGT_OK);
    assert_int_equal(cgt_bounce_rays(m->scene, &given, &hits, &media, NULL, NULL, &ids, NULL), CGT_OK);
    const cgt_rays next = {.count = RAYS,
                           .org = {scratch[0], scratch[1], scratch[2]},
                           .dir = {scratch[3], scratch[4], scratch[5]},
                           .t_max = scratch[6],
                           .skip_primitive = primitive,
                           .skip_geometry = geometry};
    const cgt_hits found = hit_array(again);
    assert_int_equal(cgt_trace_bounced_rays(m->scene, &next, &found, NULL), CGT_OK);
    uint32_t left = 0;
    for (uint32_t i = 0; i < RAYS; i++) {
        if (hit[i].geometry != 0 || again[i].geometry != 0 || again[i].primitive != hit[i].primitive)
            continue;
        /* the far surface of that capsule along the same line */
        const cgt_single_ray line = {.org = {rays[i].org[0], rays[i].org[1], rays[i].org[2]},
                                     .dir = {rays[i].dir[0], rays[i].dir[1], rays[i].dir[2]},
                                     .mask = 4};
        cgt_hit all[64];
        uint32_t count, k = 0;
        bool more;
        assert_int_equal(cgt_trace_all_ray(m->scene, &line, NULL, all, 64, &count, &more, NULL), CGT_OK);
        while (k < count && (all[k].primitive != hit[i].primitive || all[k].surface != CGT_SURFACE_FAR))
            k++;
        if (k == count)
            continue; /* an origin inside, or a touch */
        skip_t[i] = all[k].t - hit[i].t;
        if (hit[i].t > 0 && inside[i].t_max < INFINITY && all[0].surface == CGT_SURFACE_NEAR && skip_t[i] > 1e-3f) {
            assert_true(fabsf(again[i].t - skip_t[i]) < 1e-4f);
            assert_true(fabsf(again[i].uv[0] - all[k].u) < 1e-3f && again[i].uv[1] == 0);
            for (int a = 0; a < 3; a++)
                assert_true(fabsf(again[i].normal[a] - all[k].normal[a]) < 1e-2f);
            left++;
        }
    }
    print_message("%u rays left their capsule\n", left);
    assert_true(left > 30);
    free_mixed(m);
    cgt_context_release(context);
}

/* ---- what is refused, skipped, counted ---- */

TEST(crossings_are_refused)
{
    static const float end[2][3] = {{0, 0, 0}, {1, 0, 0}};
    const cgt_capsules q = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0), .radius = 1};
    const cgt_single_ray ray = {.org = {0, 0, 5}, .dir = {0, 0, -1}};
    const cgt_points points = {.count = 1, .position = {&end[0][0], &end[0][1], &end[0][2]}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    cgt_hit hit[2];
    uint32_t count = 9;
    uint8_t inside = 9;
    const cgt_all_hits_options crossings = {.crossings = true};
    assert_int_equal(cgt_trace_all_ray(scene, &ray, &crossings, hit, 2, &count, NULL, NULL), CGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(context_message(context), "capsules"));
    assert_int_equal(cgt_points_inside(scene, &points, NULL, &inside, NULL), CGT_ERROR_UNSUPPORTED);
    assert_true(count == 9 && inside == 9);
    assert_int_equal(cgt_trace_all_ray(scene, &ray, NULL, hit, 2, &count, NULL, NULL), CGT_OK);
    assert_true(count == 2 && hit[0].t == 4 && hit[1].t == 6 && hit[0].surface == CGT_SURFACE_NEAR &&
                hit[1].surface == CGT_SURFACE_FAR && hit[0].normal[2] == 1 && hit[1].normal[2] == -1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static void expect_refusal(cgt_scene *scene, cgt_context *context, cgt_result result, const char *word)
{
    assert_int_equal(cgt_scene_commit(scene), result);
    if (!strstr(context_message(context), word))
        fail_msg("\"%s\" does not mention %s", context_message(context), word);
}

TEST(structures_without_capsules)
{
    static const float end[2][3] = {{0, 0, 0}, {1, 0, 0}};
    const cgt_capsules q = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0), .radius = 1};
    cgt_context *context = context_make(1, NULL);
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
        const cgt_scene_options options = structure_in_turn(k);
        const bool holds =
            options.structure == CGT_STRUCTURE_BVH || options.structure == CGT_STRUCTURE_LOOSE_GRID ||
            (options.structure == CGT_STRUCTURE_AUTO && (!options.research || !options.research->resolution[0]));
        cgt_scene *scene;
        assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &q), CGT_OK);
        if (holds)
            assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        else
            expect_refusal(scene, context, CGT_ERROR_UNSUPPORTED, "1 capsules");
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

TEST(triangle_tests_are_refused)
{
    static const float end[2][3] = {{0, 0, 0}, {1, 0, 0}};
    const cgt_capsules q = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0), .radius = 1};
    static float t[16], normal[3][16];
    const cgt_frame frame = {.width = 4, .height = 4, .t = t, .normal = {normal[0], normal[1], normal[2]}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    cgt_research_trace_options research = {.triangle_test = CGT_TRIANGLE_TEST_ACCELERATED};
    const cgt_trace_options options = {.precision = CGT_PRECISION_FAST, .research = &research};
    assert_int_equal(cgt_trace_camera(scene, &(cgt_camera){0}, &frame, &options), CGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(context_message(context), "capsules"));
    research.triangle_test = CGT_TRIANGLE_TEST_AUTO;
    assert_int_equal(cgt_trace_camera(scene, &(cgt_camera){0}, &frame, &options), CGT_OK);
    assert_true(t[10] > 3.9f && t[10] < 4.2f);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(bad_indices_and_types)
{
    static const float vertex[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, radii[2] = {1, 2};
    static const uint32_t index[3][2] = {{0, 1}, {1, 2}, {2, 3}};
    static const uint16_t index16[3][2] = {{0, 1}, {1, 4}, {2, 0}};
    static const uint64_t index64[3][2] = {{0, 1}, {0x100000001, 2}, {2, 3}}; /* 1, if the upper half is lost */
    static const uint8_t type[3] = {0, 1, 2};
    static const int64_t type64[3] = {1, -1, 0};
    const cgt_capsules given[] = {{.count = 3,
                                   .indices = cgt_uint32s(index[0], 0),
                                   .vertex_count = 3,
                                   .vertices = cgt_floats(vertex[0], 0),
                                   .radius = 1},
                                  {.count = 3,
                                   .indices = cgt_uint16s(index16[0], 0),
                                   .vertex_count = 3,
                                   .vertices = cgt_floats(vertex[0], 0),
                                   .radius = 1},
                                  {.count = 3,
                                   .indices = cgt_uint64s(index64[0], 0),
                                   .vertex_count = 3,
                                   .vertices = cgt_floats(vertex[0], 0),
                                   .radius = 1},
                                  {.count = 3,
                                   .indices = cgt_uint32s(index[0], 0),
                                   .vertex_count = 4,
                                   .vertices = cgt_floats(vertex[0], 0),
                                   .radii = cgt_floats(radii, 0),
                                   .types = cgt_uint8s(type, 0),
                                   .type_count = 2},
                                  {.count = 3,
                                   .indices = cgt_uint32s(index[0], 0),
                                   .vertex_count = 4,
                                   .vertices = cgt_floats(vertex[0], 0),
                                   .radii = cgt_floats(radii, 0),
                                   .types = cgt_int64s(type64, 0),
                                   .type_count = 2}};
    static const char *const words[] = {
        "capsule 2 has index 3, but there are 3 vertices", "capsule 1 has index 4, but there are 3 vertices",
        "capsule 1 has index 4294967297, but there are 3 vertices", "capsule 2 has type 2, but there are 2 types",
        "capsule 1 has type 18446744073709551615, but there are 2 types"};
    static const float four[4][3] = {{0}};
    cgt_context *context = context_make(1, NULL);
    for (uint32_t k = 0; k < 3; k++) {
        cgt_capsules q = given[k];
        cgt_scene *scene;
        if (k == 2)
            q.vertices = cgt_floats(four[0], 0);
        assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &q), CGT_OK);
        expect_refusal(scene, context, CGT_ERROR_INVALID_ARGUMENT, words[k]);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

TEST(skipped_capsules_are_counted)
{
    static const float end[8][3] = {{0, 0, 0}, {1, 0, 0},        {NAN, 0, 0}, {0, 0, 0},
                                    {0, 0, 0}, {0, INFINITY, 0}, {5, 0, 0},   {6, 0, 0}};
    static const float radius[4] = {1, 1, 1, -1};
    const cgt_capsules q = {
        .count = 4, .vertex_count = 8, .vertices = cgt_floats(end[0], 0), .radii = cgt_floats(radius, 0)};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    const cgt_scene_statistics s = statistics_of(scene);
    assert_true(s.skipped_not_finite == 2 && s.skipped_radius == 1 && s.skipped_degenerate == 0);
    for (int a = 0; a < 3; a++) {
        assert_true(s.bounds_min[a] <= -1 && s.bounds_min[a] > -1.001f);
        assert_true(s.bounds_max[a] >= (a ? 1 : 2) && s.bounds_max[a] < (a ? 1 : 2) + 0.001f);
    }
    const ray_hit hit = ray_trace(scene, (truth_ray){{0.5f, 0, 5}, {0, 0, -1}, 0, INFINITY});
    assert_true(hit.t == 4 && hit.primitive == 0);
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &(cgt_spheres){0}), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "geometry 0 is one of capsules"));
    assert_int_equal(cgt_scene_set_capsules(scene, &(uint32_t){0}, &(cgt_capsules){0}), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK); /* nothing is left */
    assert_int_equal(ray_trace(scene, (truth_ray){{0.5f, 0, 5}, {0, 0, -1}, 0, INFINITY}).primitive, CGT_INVALID_ID);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Frame after frame nothing is allocated, and AUTO keeps the grid. */
TEST(capsules_move)
{
    unsigned allocations = 0;
    cgt_context *context = context_counting(&allocations);
    capsule_arrays *s = make_arrays(far_origin);
    const float sphere[1][4] = {{0, 0, 0, 1}};
    const cgt_spheres spheres = spheres_of(sphere, 1);
    const cgt_capsules q = describe(s, 6, far_origin);
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    for (int frame = 0; frame < 4; frame++) {
        const unsigned before = allocations;
        for (uint32_t i = 0; i < CAPSULES; i++)
            s->end_double[frame % 2][i][frame % 3] += 0.01;
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_true(frame < 2 || allocations == before);
        assert_int_equal(statistics_of(scene).structure, CGT_STRUCTURE_LOOSE_GRID);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    free(s);
}

SEEDED_SUITE("test_capsules", NULL, NULL)
