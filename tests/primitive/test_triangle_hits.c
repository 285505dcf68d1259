/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a hit on a triangle returns: t, u, v, the normal and ids, each only if requested; ties; any hit. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/oracle/oracle.h"
#include "primitive/triangle_scenes.h"

enum { COUNT = 80, RAYS = 1024 };

static triangle given[COUNT];
static truth_ray ray[RAYS];
static full_hit expected[RAYS], hit[RAYS];

static cgt_scene *make_scene(cgt_context *context, uint64_t stream)
{
    test_random r = random_make(stream);
    random_triangles(&r, 0.8f, given, COUNT);
    random_rays(&r, ray, RAYS);
    return scene_of_triangles(context, NULL, (const triangle *)given, COUNT);
}

/* ---- values ---- */

/* The hit is (1 - u - v) v0 + u v1 + v v2, and org + t dir; the normal is that of (v1 - v0) x (v2 - v0). */
static void check_meaning(const full_hit *h, const truth_ray *of, const triangle q)
{
    const double u = h->uv[0], v = h->uv[1];
    double e[2][3], n[3], dot = 0, length = 0, own = 0;
    assert_true(u >= 0 && v >= 0 && u + v <= 1 + 0x1p-22);
    for (int a = 0; a < 3; a++) {
        const double p = (1 - u - v) * q[0][a] + u * q[1][a] + v * q[2][a];
        assert_true(fabs(p - (of->org[a] + (double)h->t * of->dir[a])) < 1e-5);
        for (int k = 0; k < 2; k++)
            e[k][a] = (double)q[k + 1][a] - q[0][a];
    }
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        n[a] = e[0][b] * e[1][c] - e[0][c] * e[1][b];
        dot += n[a] * h->normal[a];
        own += (double)h->normal[a] * h->normal[a];
        length += n[a] * n[a];
    }
    assert_true(fabs(sqrt(own) - 1) < 0x1p-22);
    assert_true(dot / sqrt(length) > 1 - 1e-6);
}

static void hits_mean_what_is_documented(void **state)
{
    (void)state;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        uint64_t front = 0, back = 0;
        for (uint32_t round = 0; round < 2 + test_scaled(10); round++) {
            cgt_scene *scene = make_scene(context, round);
            for (int precision = 0; precision <= CGT_PRECISION_EXACT; precision++) {
                const cgt_trace_options options = with_precision((cgt_precision)precision);
                if (precision == CGT_PRECISION_FAST)
                    continue;
                trace_all(scene, ray, RAYS, hit, &options);
                for (int i = 0; i < RAYS; i++) {
                    if (hit[i].primitive == CGT_INVALID_ID)
                        continue;
                    check_meaning(&hit[i], &ray[i], (const float(*)[3])given[hit[i].primitive]);
                    const float towards = hit[i].normal[0] * ray[i].dir[0] + hit[i].normal[1] * ray[i].dir[1] +
                                          hit[i].normal[2] * ray[i].dir[2];
                    ++*(towards < 0 ? &front : &back);
                }
            }
            cgt_scene_release(scene);
        }
        assert_true(front > 200 && back > 200); /* both sides are hit */
        cgt_context_release(context);
    }
}

static void exact_values_are_within_an_ulp(void **state)
{
    (void)state;
    cgt_context *context = context_make(1, NULL);
    const cgt_trace_options exact = with_precision(CGT_PRECISION_EXACT);
    double t = 0, uv = 0, normal = 0;
    for (uint32_t round = 0; round < 2 + test_scaled(15); round++) {
        cgt_scene *scene = make_scene(context, 100 + round);
        oracle_scene truth = {0};
        oracle_scene_add_triangles(&truth, 0, (const float(*)[3])given[0], 3 * COUNT, NULL, COUNT);
        trace_all(scene, ray, RAYS, hit, &exact);
        for (int i = 0; i < RAYS; i++) {
            oracle_hit of;
            assert_int_equal(oracle_judge(&truth, &ray[i], hit[i].geometry, hit[i].primitive, &of), ORACLE_RIGHT);
            if (of.index == ORACLE_NONE)
                continue;
            t = fmax(t, oracle_ulp(of.t, hit[i].t));
            for (int k = 0; k < 2; k++)
                uv = fmax(uv, oracle_ulp(of.uv[k], hit[i].uv[k]));
            for (int a = 0; a < 3; a++)
                normal = fmax(normal, oracle_ulp(of.normal[a], hit[i].normal[a]));
        }
        oracle_scene_free(&truth);
        cgt_scene_release(scene);
    }
    print_message("EXACT: t within %.4f ulp, u and v %.4f, components of the normal %.4f\n", t, uv, normal);
    assert_true(t <= 0.51 && uv <= 1 && normal <= 1);
    cgt_context_release(context);
}

/* ---- requested fields ---- */

static void any_set_of_fields(void **state)
{
    (void)state;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = make_scene(context, 200);
        trace_all(scene, ray, RAYS, expected, NULL);
        for (unsigned fields = 0; fields < 32; fields++) {
            const cgt_rays rays = ray_array(ray, RAYS);
            cgt_hits hits = hit_array(hit);
            memset(hit, 0x77, sizeof hit);
            hits.t = fields & CGT_FIELD_T ? hits.t : NULL;
            hits.primitive = fields & CGT_FIELD_PRIMITIVE ? hits.primitive : NULL;
            hits.geometry = fields & CGT_FIELD_GEOMETRY ? hits.geometry : NULL;
            for (int a = 0; a < 3; a++)
                hits.normal[a] = fields & CGT_FIELD_NORMAL ? hits.normal[a] : NULL;
            hits.u = fields & CGT_FIELD_UV ? hits.u : NULL;
            hits.v = fields & CGT_FIELD_UV ? hits.v : NULL;
            assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
            for (int i = 0; i < RAYS; i++) {
                full_hit want;
                memset(&want, 0x77, sizeof want);
                want.t = fields & CGT_FIELD_T ? expected[i].t : want.t;
                want.primitive = fields & CGT_FIELD_PRIMITIVE ? expected[i].primitive : want.primitive;
                want.geometry = fields & CGT_FIELD_GEOMETRY ? expected[i].geometry : want.geometry;
                if (fields & CGT_FIELD_NORMAL)
                    memcpy(want.normal, expected[i].normal, sizeof want.normal);
                if (fields & CGT_FIELD_UV)
                    memcpy(want.uv, expected[i].uv, sizeof want.uv);
                assert_memory_equal(&hit[i], &want, sizeof want);
            }
        }
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

enum { WIDTH = 150, HEIGHT = 90 };

typedef struct picture {
    float uv[2][HEIGHT][WIDTH];
    uint32_t geometry[HEIGHT][WIDTH];
} picture;

static cgt_visit keep_tile(void *user, const cgt_tile *tile)
{
    picture *p = user;
    if (!tile->u || !tile->v || !tile->geometry || tile->t || tile->primitive || tile->normal[0])
        return 1; /* only requested planes */
    for (uint32_t j = 0; j < tile->height; j++)
        for (uint32_t i = 0; i < tile->width; i++) {
            const size_t at = j * tile->row_stride + i;
            p->uv[0][tile->y + j][tile->x + i] = tile->u[at];
            p->uv[1][tile->y + j][tile->x + i] = tile->v[at];
            p->geometry[tile->y + j][tile->x + i] = tile->geometry[at];
        }
    return 0;
}

static void frames_carry_u_and_v(void **state)
{
    (void)state;
    static picture whole, tiles;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(2, variant);
        cgt_scene *scene = make_scene(context, 201);
        cgt_camera camera;
        cgt_frame frame;
        uint32_t hits = 0;
        cgt_camera_init(&camera);
        cgt_frame_init(&frame, WIDTH, HEIGHT);
        memset(&whole, 0x77, sizeof whole);
        memset(&tiles, 0x33, sizeof tiles);
        frame.u = whole.uv[0][0];
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_ERROR_INVALID_ARGUMENT);
        frame.v = whole.uv[1][0];
        frame.geometry = whole.geometry[0];
        frame.visitor = keep_tile;
        frame.visitor_user = &tiles;
        frame.visitor_fields = CGT_FIELD_UV | CGT_FIELD_GEOMETRY;
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
        assert_memory_equal(&whole, &tiles, sizeof whole);
        for (int j = 0; j < HEIGHT; j++)
            for (int i = 0; i < WIDTH; i++) {
                const float u = whole.uv[0][j][i], v = whole.uv[1][j][i];
                const bool is_hit = whole.geometry[j][i] != CGT_INVALID_ID;
                assert_true(is_hit ? u >= 0 && v >= 0 && u + v < 1.000001f : u == 0 && v == 0);
                hits += is_hit;
            }
        assert_true(hits > WIDTH * HEIGHT / 20);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

static void spheres_among_triangles_have_no_uv(void **state)
{
    (void)state;
    static const float sphere[1][4] = {{0, 0, 0, 1}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context, 202);
    assert_int_equal(scene_add_spheres(scene, sphere, 1), 1);
    scene_commit(context, scene);
    trace_all(scene, ray, RAYS, hit, NULL);
    uint32_t of_kind[2] = {0, 0};
    for (int i = 0; i < RAYS; i++) {
        if (hit[i].geometry == CGT_INVALID_ID)
            continue;
        of_kind[hit[i].geometry]++;
        if (hit[i].geometry == 1)
            assert_true(hit[i].uv[0] == 0 && hit[i].uv[1] == 0);
    }
    assert_true(of_kind[0] > 50 && of_kind[1] > 50);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context, 203);
    const cgt_rays rays = ray_array(ray, RAYS);
    const cgt_result bad = CGT_ERROR_INVALID_ARGUMENT;
    for (int v = 0; v < 2; v++) {
        cgt_hits hits = hit_array(hit);
        *(v ? &hits.u : &hits.v) = NULL;
        assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), bad);
        assert_non_null(strstr(context_message(context), "u and v"));
    }
    for (int precision = -1; precision < 5; precision++)
        for (int test = -1; test < 5; test++) {
            cgt_trace_options options = with_precision((cgt_precision)precision);
            const cgt_research_trace_options research = {.triangle_test = (cgt_triangle_test)test};
            options.research = &research;
            const bool known = precision >= 0 && precision <= CGT_PRECISION_EXACT && test >= 0 &&
                               test <= CGT_TRIANGLE_TEST_ACCELERATED;
            const bool good = known && (test == CGT_TRIANGLE_TEST_AUTO || precision == CGT_PRECISION_FAST);
            assert_int_equal(trace_array(scene, ray, RAYS, hit, &options), good ? CGT_OK : bad);
            if (!known)
                assert_non_null(strstr(context_message(context), "unknown"));
            else if (!good)
                assert_non_null(strstr(context_message(context), "FAST"));
        }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- ties, and rays that share a plane ---- */

/* Every triangle three times, in two geometries, each with another corner first: with equal t the lowest ids win. */
static void the_lowest_ids_win(void **state)
{
    (void)state;
    static triangle rotated[2 * COUNT];
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = make_scene(context, 300);
        uint64_t order = 0;
        for (int i = 0; i < RAYS; i++) /* also at edges and vertices, where neighbours tie */
            for (int a = 0; a < 3 && i % 2; a++)
                ray[i].dir[a] = given[i % COUNT][i % 3][a] - ray[i].org[a];
        trace_all(scene, ray, RAYS, expected, NULL);
        cgt_scene_release(scene);
        for (uint32_t i = 0; i < 2 * COUNT; i++)
            for (uint32_t k = 0; k < 3; k++)
                memcpy(rotated[i][k], given[i % COUNT][(k + i) % 3], sizeof rotated[i][k]);
        for (int first = 0; first < 2; first++) {
            scene = scene_begin(context);
            if (first)
                scene_add_triangles(scene, (const triangle *)given, COUNT);
            scene_add_triangles(scene, (const triangle *)rotated, 2 * COUNT);
            if (!first)
                scene_add_triangles(scene, (const triangle *)given, COUNT);
            scene_commit(context, scene);
            trace_all(scene, ray, RAYS, hit, NULL);
            for (int i = 0; i < RAYS; i++) {
                assert_int_equal(hit[i].geometry, expected[i].geometry == CGT_INVALID_ID ? CGT_INVALID_ID : 0);
                assert_int_equal(hit[i].primitive, expected[i].primitive);
                assert_true(same_bits(hit[i].t, expected[i].t));
                order += hit[i].geometry == 0;
            }
            cgt_scene_release(scene);
        }
        assert_true(order > 200);
        cgt_context_release(context);
    }
}

static void rays_in_a_triangles_plane_miss(void **state)
{
    (void)state;
    static const triangle t = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    static const truth_ray in_plane[] = {
        {{-1, 1, 0}, {1, 0, 0}, 0, INFINITY},        {{-1, 0, 0}, {1, 0, 0}, 0, INFINITY}, /* along an edge */
        {{1, 1, 0}, {-1, -1, 0}, 0, INFINITY},       {{-1, 1, 0}, {1, 0, -0.f}, -INFINITY, INFINITY},
        {{-1, 1, 1}, {1, 0, 0}, 0, INFINITY}, /* next to the triangle */
        {{-1, 1, 0x1p-149f}, {1, 0, 0}, 0, INFINITY}};
    static const truth_ray through[] = {{{1, 1, 1}, {0, 0, -1}, 0, INFINITY},
                                        {{0, 0, 1}, {0, 0, -1}, 0, INFINITY}, /* a vertex */
                                        {{2, 0, -1}, {0, 0, 3}, 0, INFINITY}, /* an edge */
                                        {{2, 2, 1}, {0, 0, -1}, 0, INFINITY},
                                        {{1, 1, 0}, {0, 0, -1}, 0, INFINITY}, /* from the edge */
                                        {{-1, 1, 0x1p-149f}, {1, 0, -0x1p-149f}, 0, INFINITY},
                                        {{1, 1, -1}, {0, 0, -1}, -INFINITY, INFINITY}};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_of_triangles(context, NULL, &t, 1);
        trace_all(scene, in_plane, TEST_COUNT(in_plane), hit, NULL);
        assert_int_equal(hits_in(hit, TEST_COUNT(in_plane)), 0);
        trace_all(scene, through, TEST_COUNT(through), hit, NULL);
        assert_int_equal(hits_in(hit, TEST_COUNT(through)), TEST_COUNT(through));
        assert_true(hit[4].t == 0 && hit[5].t == 1 && hit[6].t == -1);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* ---- any hit ---- */

static void occluded_if_a_closest_hit_exists(void **state)
{
    (void)state;
    static uint8_t occluded[RAYS];
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        for (uint32_t round = 0; round < 1 + test_scaled(8); round++) {
            cgt_scene *scene = make_scene(context, 400 + round);
            cgt_trace_statistics s;
            cgt_trace_options options = with_precision(round % 2 ? CGT_PRECISION_EXACT : CGT_PRECISION_ROBUST);
            options.statistics = &s;
            trace_all(scene, ray, RAYS, hit, &options);
            for (int i = 0; i < RAYS; i++) /* ranges that end at the hit, or just before */
                if (hit[i].geometry != CGT_INVALID_ID && i % 3)
                    ray[i].t_max = i % 3 == 1 ? hit[i].t : nextafterf(hit[i].t, -INFINITY);
            trace_all(scene, ray, RAYS, hit, &options);
            const cgt_rays rays = ray_array(ray, RAYS);
            assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, &options), CGT_OK);
            for (int i = 0; i < RAYS; i++)
                assert_int_equal(occluded[i], hit[i].geometry != CGT_INVALID_ID);
            assert_int_equal(s.hits, hits_in(hit, RAYS));
            assert_int_equal(s.rays, RAYS);
            cgt_scene_release(scene);
        }
        cgt_context_release(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_mean_what_is_documented),
        cmocka_unit_test(exact_values_are_within_an_ulp),
        cmocka_unit_test(any_set_of_fields),
        cmocka_unit_test(frames_carry_u_and_v),
        cmocka_unit_test(spheres_among_triangles_have_no_uv),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(the_lowest_ids_win),
        cmocka_unit_test(rays_in_a_triangles_plane_miss),
        cmocka_unit_test(occluded_if_a_closest_hit_exists),
    };
    test_begin("test_triangle_hits");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
